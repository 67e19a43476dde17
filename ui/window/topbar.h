// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtWidgets/QWidget>

class QAction;
class QMenuBar;
class QTabBar;
class QToolButton;

namespace ps {

/// Logo and menus, workspaces in the middle, undo, redo, the search field and VR on the right, which says so in words
/// where the bar is wide; 36 pixels.
class TopBar : public QWidget {
  Q_OBJECT
 public:
  TopBar(QAction* undo, QAction* redo, QAction* search, QAction* headset, QWidget* parent = nullptr);
  QMenuBar* menus() const { return m_menus; }
  QTabBar* workspaces() const { return m_workspaces; }
  QWidget* searchField() const { return m_search; }
  QToolButton* headset() const { return m_headset; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  QMenuBar* m_menus;
  QTabBar* m_workspaces;
  QWidget* m_search;
  QToolButton* m_headset;
};

}  // namespace ps
