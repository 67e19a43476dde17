// SPDX-License-Identifier: Apache-2.0
#include "ui/window/viewmenu.h"

#include "ui/window/mainwindow.h"

#include <QtGui/QAction>
#include <QtWidgets/QMenu>

namespace ps {

void openViewMenu(MainWindow& window, const QPoint& global) {
  auto* menu = new QMenu(&window);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [&window](QMenu* to, const QString& name) {
    if (QAction* action = window.action(name)) to->addAction(action);
  };
  add(menu, QStringLiteral("view.frame"));
  add(menu, QStringLiteral("view.frameAll"));
  QMenu* views = menu->addMenu(QStringLiteral("Look from"));
  for (int i = 1; i <= 9; ++i) add(views, QStringLiteral("view.look%1").arg(i));
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  for (int i = 1; i <= 5; ++i) add(colours, QStringLiteral("view.colour%1").arg(i));
  menu->popup(global);
}

}  // namespace ps
