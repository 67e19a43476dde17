// SPDX-License-Identifier: Apache-2.0
#pragma once

class QObject;

namespace ps {

/// Whether a key is for a widget that has the focus rather than for the window: Space presses buttons, arrows walk.
bool takesKey(const QObject* widget, int key);
/// Whether Tab there goes between Scene and Sketch rather than to the next widget.
bool leadsTab(const QObject* widget);

}  // namespace ps
