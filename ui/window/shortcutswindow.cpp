// SPDX-License-Identifier: Apache-2.0
#include "ui/window/shortcutswindow.h"

#include "ui/graphs/plot.h"
#include "ui/timeline/timeline.h"
#include "ui/tools/navigation.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/actions.h"
#include "ui/window/dialogrow.h"
#include "ui/window/mainwindow.h"
#include "ui/window/workspacekeys.h"

#include <QtGui/QAction>
#include <QtWidgets/QDialog>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QTreeWidget>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

const QString kName = QStringLiteral("psShortcuts");

/// "Look from: Front": a submenu's entries mean little without its title.
QString nameOf(const QAction& action, const QString& menu) {
  const QString plain = action.property(kPlainText).toString();
  if (!plain.isEmpty()) return plain;
  const QString text = cleanText(action).remove(QStringLiteral("…"));
  QString submenu;
  for (const QObject* owner : action.associatedObjects()) {
    const auto* in = qobject_cast<const QMenu*>(owner);
    if (in && in->title() == menu) return text;  // whichever other menus offer it
    if (in) submenu = in->title() + QStringLiteral(": ");
  }
  return submenu + text;
}

ShortcutGroup menuGroup(const MainWindow& window, const QString& title) {
  ShortcutGroup group{title, {}};
  const QString prefix = title.toLower() + QLatin1Char('.');
  for (const QAction* action : window.findChildren<QAction*>(Qt::FindDirectChildrenOnly)) {
    const QStringList keys = keyTexts(*action);
    if (!action->objectName().startsWith(prefix) || keys.isEmpty()) continue;
    group.lines.emplace_back(keys.join(QStringLiteral(", ")), nameOf(*action, title));
  }
  return group;
}

/// What the buttons do with a tool in hand, and what they do with any.
ShortcutGroup toolGroup(const ToolRow& row, const Tool& tool) {
  ShortcutGroup group{QString::fromLatin1(row.page), {}};
  for (const Gesture& gesture : tool.gestures()) group.lines.emplace_back(gesture.keys, gesture.does);
  for (const Gesture& gesture : viewGestures(tool)) group.lines.emplace_back(gesture.keys, gesture.does);
  return group;
}

void fill(QTreeWidget& list, MainWindow& window) {
  list.clear();
  for (const ShortcutGroup& group : shortcutGroups(window)) {
    auto* head = new QTreeWidgetItem(&list, {group.title});
    head->setFirstColumnSpanned(true);
    QFont bold = list.font();
    bold.setWeight(QFont::DemiBold);
    head->setFont(0, bold);
    for (const auto& [keys, does] : group.lines) new QTreeWidgetItem(head, {does, keys});
  }
  list.expandAll();
}

QDialog* makeList(MainWindow& window) {
  auto* dialog = new QDialog(&window);
  dialog->setWindowTitle(QStringLiteral("Keyboard shortcuts"));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  auto* list = new QTreeWidget;
  list->setAccessibleName(dialog->windowTitle());
  list->setColumnCount(2);
  list->setHeaderHidden(true);
  list->setRootIsDecorated(false);
  list->setAllColumnsShowFocus(true);
  list->setSelectionMode(QAbstractItemView::SingleSelection);
  fill(*list, window);
  QObject::connect(&window.tools(), &Toolbox::mouseChanged, list, [list, &window] { fill(*list, window); });
  list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  list->header()->setStretchLastSection(false);
  list->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  auto* column = new QVBoxLayout(dialog);
  column->setContentsMargins(8, 8, 8, 8);
  column->addWidget(list);
  dialog->resize(520, 640);
  return dialog;
}

}  // namespace

std::vector<ShortcutGroup> shortcutGroups(MainWindow& window) {
  std::vector<ShortcutGroup> groups;
  const auto* bar = window.findChild<QMenuBar*>();
  for (const QAction* menu : bar->actions()) {
    ShortcutGroup group = menuGroup(window, menu->text().remove(QLatin1Char('&')));
    if (!group.lines.empty()) groups.push_back(std::move(group));
  }
  groups.push_back({QStringLiteral("In a graph"), {}});
  for (const auto& [keys, does] : Plot::gestures()) groups.back().lines.emplace_back(keys, does);
  groups.push_back({QStringLiteral("In the timeline"), {}});
  for (const auto& [keys, does] : Timeline::gestures()) groups.back().lines.emplace_back(keys, does);
  for (const ToolRow& row : toolTable()) groups.push_back(toolGroup(row, window.tools().tool(row.id)));
  return groups;
}

void openShortcuts(MainWindow& window) {
  bringUp(window, kName, [&window] { return makeList(window); });
}

}  // namespace ps
