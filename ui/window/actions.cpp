// SPDX-License-Identifier: Apache-2.0
#include "ui/window/actions.h"

#include "ui/theme/plaintext.h"
#include "ui/window/entrytext.h"

#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <utility>

namespace ps {

QString cleanText(const QAction& action) {
  const QString whole = action.property(kWholeName).toString();
  return whole.isEmpty() ? fromButtonText(action.text()) : whole;
}

QAction* Actions::add(QMenu* menu, const QString& name, const QString& text, const QList<QKeySequence>& keys,
                      Act act) const {
  auto* action = adopt(new QAction(asButtonText(text)), name, keys);
  if (act) QObject::connect(action, &QAction::triggered, action, [act = std::move(act)] { act(); });
  if (menu) menu->addAction(action);
  return action;
}

QAction* Actions::adopt(QAction* action, const QString& name, const QList<QKeySequence>& keys) const {
  action->setParent(&m_window);
  action->setObjectName(name);
  action->setShortcuts(keys);
  m_window.addAction(action);
  return action;
}

QAction* Actions::find(const QString& name) const {
  return m_window.findChild<QAction*>(name, Qt::FindDirectChildrenOnly);
}

QList<QAction*> Actions::all() const { return m_window.findChildren<QAction*>(Qt::FindDirectChildrenOnly); }

}  // namespace ps
