// SPDX-License-Identifier: Apache-2.0
#pragma once

class QPoint;

namespace ps {

class MainWindow;

/// The menu of the scene's view, at a place of the screen: frame, look from, colour. The window's own actions, with
/// their keys.
void openViewMenu(MainWindow& window, const QPoint& global);
/// The menu of the selected body, or of the selected tap or drain, likewise.
void openItemMenu(MainWindow& window, const QPoint& global, bool port);

}  // namespace ps
