// SPDX-License-Identifier: Apache-2.0
#pragma once

class QPoint;

namespace ps {

class MainWindow;

/// The menu of the scene's view, at a place of the screen: frame, look from, colour. The window's own actions, with
/// their keys.
void openViewMenu(MainWindow& window, const QPoint& global);
/// The menu of the selected body, likewise.
void openBodyMenu(MainWindow& window, const QPoint& global);

}  // namespace ps
