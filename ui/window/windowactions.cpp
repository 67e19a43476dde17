// SPDX-License-Identifier: Apache-2.0
#include "ui/window/windowactions.h"

#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/dock.h"
#include "ui/window/focuskeeper.h"
#include "ui/window/mainwindow.h"
#include "ui/window/paneltable.h"
#include "ui/window/welcome.h"
#include "ui/window/windowlayout.h"

#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

using Tab = MainWindow::WorkspaceTab;
constexpr auto& kWorkspaces = MainWindow::kWorkspaces;

QString workspaceAction(const char* name) { return QStringLiteral("window.workspace") + QLatin1String(name); }

QString dockAction(const DockRow& row) { return QStringLiteral("window.") + QLatin1String(row.name); }

/// The one to go to for a dock that the present one has not.
Tab tabOf(Workspace workspace) {
  switch (workspace) {
    case Workspace::Tune:
      return MainWindow::kTuneTab;
    case Workspace::Film:
      return MainWindow::kFilmTab;
    case Workspace::Sketch:
      return MainWindow::kSketchTab;
    case Workspace::Scene:
      break;
  }
  return MainWindow::kSceneTab;
}

}  // namespace

WindowActions::WindowActions(MainWindow& window, const Actions& actions, QMenu* menu)
    : QObject(&window), m_window(window), m_actions(actions) {
  addWorkspaces(menu);
  menu->addSeparator();
  addDocks(menu);
  menu->addSeparator();
  WindowLayout& layout = m_window.layoutOfDocks();
  QAction* full = m_actions.add(menu, QStringLiteral("window.full"), QStringLiteral("Full viewport"),
                                {QKeySequence(QStringLiteral("F11"))},
                                [&layout] { layout.setFullViewport(!layout.fullViewport()); });
  full->setCheckable(true);
  m_actions.add(menu, QStringLiteral("window.layout"), QStringLiteral("Default layout"), {},
                [&layout] { layout.applyDefault(); });
  menu->addSeparator();
  addFocus(menu);
  connect(menu, &QMenu::aboutToShow, this, &WindowActions::refresh);
}

void WindowActions::addWorkspaces(QMenu* menu) {
  auto* group = new QActionGroup(this);
  for (size_t k = 0; k < kWorkspaces.size(); ++k) {
    QAction* action = m_actions.add(menu, workspaceAction(kWorkspaces[k]),
                                    QStringLiteral("Workspace ") + QLatin1String(kWorkspaces[k]), {}, [this, k] {
                                      m_window.welcome().leave();
                                      m_window.showWorkspace(static_cast<Tab>(k));
                                    });
    action->setCheckable(true);
    group->addAction(action);
  }
  m_actions.add(menu, QStringLiteral("window.workspace"), QStringLiteral("Next workspace"),
                {QKeySequence(QStringLiteral("Ctrl+Tab"))}, [this] {
                  const int next = (m_window.workspaceTab() + 1) % static_cast<int>(kWorkspaces.size());
                  m_window.showWorkspace(static_cast<Tab>(next));
                });
}

void WindowActions::addDocks(QMenu* menu) {
  for (size_t k = 0; k < dockTable().size(); ++k) {
    const DockRow& row = dockTable()[k];
    QAction* action =
        m_actions.add(menu, dockAction(row), QStringLiteral("Show ") + QString::fromLatin1(row.title).toLower(), {},
                      [this, k] { toggle(k); });
    action->setProperty(kWords, QStringLiteral("hide panel dock"));
    action->setCheckable(true);
  }
}

/// One that this workspace has not is shown in the one that has it.
void WindowActions::toggle(size_t dock) {
  m_window.welcome().leave();
  WindowLayout& layout = m_window.layoutOfDocks();
  const DockRow& row = dockTable()[dock];
  const bool here = offers(row, layout.workspace());
  if (!here) m_window.showWorkspace(tabOf(row.workspaces.front()));
  layout.setDockShown(dock, !here || !layout.isShown(dock));
  refresh();
}

void WindowActions::refresh() {
  const WindowLayout& layout = m_window.layoutOfDocks();
  for (size_t k = 0; k < dockTable().size(); ++k)
    m_actions.find(dockAction(dockTable()[k]))->setChecked(layout.isShown(k));
  for (size_t k = 0; k < kWorkspaces.size(); ++k)
    m_actions.find(workspaceAction(kWorkspaces[k]))->setChecked(m_window.workspaceTab() == static_cast<Tab>(k));
  m_actions.find(QStringLiteral("window.full"))->setChecked(layout.fullViewport());
}

void WindowActions::addFocus(QMenu* menu) {
  auto* focus = new FocusKeeper(m_window, m_window.viewport(), [this] { return m_window.layoutOfDocks().docks(); });
  m_actions.add(menu, QStringLiteral("window.nextPart"), QStringLiteral("Keys to the next panel"),
                {QKeySequence(QStringLiteral("F6"))}, [focus] { focus->step(true); });
  m_actions.add(menu, QStringLiteral("window.previousPart"), QStringLiteral("Keys to the panel before"),
                {QKeySequence(QStringLiteral("Shift+F6"))}, [focus] { focus->step(false); });
}

}  // namespace ps
