// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QAction;
class QMenuBar;
class QTabBar;

namespace ps {

/// Logo and menus, workspaces in the middle, undo, redo, the search field and VR on the right; 36 pixels.
class TopBar : public QWidget {
  Q_OBJECT
 public:
  TopBar(QAction* undo, QAction* redo, QAction* search, QAction* headset, QWidget* parent = nullptr);
  QMenuBar* menus() const { return m_menus; }
  QTabBar* workspaces() const { return m_workspaces; }
  QWidget* searchField() const { return m_search; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QMenuBar* m_menus;
  QTabBar* m_workspaces;
  QWidget* m_search;
};

}  // namespace ps
