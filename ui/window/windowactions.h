// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>

#include <cstddef>

class QMenu;

namespace ps {

class Actions;
class MainWindow;

/// What of the window is in sight: the menu Window, with its workspaces, its docks, and where the keys go.
class WindowActions : public QObject {
  Q_OBJECT
 public:
  WindowActions(MainWindow& window, const Actions& actions, QMenu* menu);

 private:
  void addWorkspaces(QMenu* menu);
  void addDocks(QMenu* menu);
  void addFocus(QMenu* menu);
  void toggle(size_t dock);
  void refresh();  ///< the check marks
  MainWindow& m_window;
  const Actions& m_actions;
};

}  // namespace ps
