// SPDX-License-Identifier: Apache-2.0
#include "ui/window/viewmenu.h"

#include "ui/window/mainwindow.h"

#include <QtGui/QAction>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

void add(const MainWindow& window, QMenu* to, const QString& name) {
  if (QAction* action = window.action(name)) to->addAction(action);
}

QMenu* newMenu(MainWindow& window) {
  auto* menu = new QMenu(&window);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  return menu;
}

}  // namespace

void openViewMenu(MainWindow& window, const QPoint& global) {
  QMenu* menu = newMenu(window);
  add(window, menu, QStringLiteral("view.frame"));
  add(window, menu, QStringLiteral("view.frameAll"));
  QMenu* views = menu->addMenu(QStringLiteral("Look from"));
  for (int i = 1; i <= 9; ++i) add(window, views, QStringLiteral("view.look%1").arg(i));
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  for (int i = 1; i <= 5; ++i) add(window, colours, QStringLiteral("view.colour%1").arg(i));
  menu->popup(global);
}

void openItemMenu(MainWindow& window, const QPoint& global, bool port) {
  QMenu* menu = newMenu(window);
  add(window, menu, QStringLiteral("edit.rename"));
  for (const char* name : {"edit.visible", "edit.locked"}) {
    if (!port) add(window, menu, QString::fromLatin1(name));
  }
  add(window, menu, QStringLiteral("view.frame"));
  menu->addSeparator();
  for (const char* name : {"edit.duplicate", "edit.delete"}) add(window, menu, QString::fromLatin1(name));
  menu->popup(global);
}

}  // namespace ps
