// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <utility>
#include <vector>

namespace ps {

class MainWindow;

/// Property of an action whose text changes: what it is called in a list.
inline constexpr const char* kPlainText = "plainText";

struct ShortcutGroup {
  QString title;                                   ///< a menu, or what the mouse does in the view
  std::vector<std::pair<QString, QString>> lines;  ///< keys, what they do
};
/// Every key and gesture, from the window's actions and the view's tools.
std::vector<ShortcutGroup> shortcutGroups(MainWindow& window);
/// Shows the list in a window of its own, one per main window; it stays open beside the work.
void openShortcuts(MainWindow& window);

}  // namespace ps
