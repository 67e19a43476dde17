// SPDX-License-Identifier: Apache-2.0
// What the window has for those who are new to it: the menu Help, the first page, a tour.
#include "ui/document/document.h"
#include "ui/panels/pluginpage.h"
#include "ui/session/messagelog.h"
#include "ui/session/preferences.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"
#include "ui/window/dock.h"
#include "ui/window/help.h"
#include "ui/window/mainwindow.h"
#include "ui/window/notices.h"
#include "ui/window/shortcutswindow.h"
#include "ui/window/topbar.h"
#include "ui/window/tour.h"
#include "ui/window/viewportpane.h"
#include "ui/window/welcome.h"

#include <QtGui/QAction>
#include <QtWidgets/QMenu>
#include <QtWidgets/QStackedWidget>

namespace ps {

void MainWindow::start() {
  m_session->start();
  if (m_options.restore) {
    m_tools->setMouse(preferences::mouse());
    m_tools->setHandles(preferences::handles());
  }
  if (!m_options.restore || !m_options.project.isEmpty()) return;
  m_welcome->showAtStart();
  connect(m_tour, &Tour::ended, this, [] { preferences::setTourDone(); });
  if (preferences::isFirstStart() && !preferences::tourDone())
    connect(this, &MainWindow::projectShown, this, &MainWindow::startTour, Qt::SingleShotConnection);
}
void MainWindow::makeHelpMenu(QMenu* menu) {
  m_actions.add(menu, QStringLiteral("help.welcome"), QStringLiteral("Welcome"), {}, [this] { m_welcome->show(); });
  m_help = new Help(*this, m_actions);
  m_help->makeMenu(menu);
  m_actions.add(menu, QStringLiteral("help.tour"), QStringLiteral("Tour of five steps"), {}, [this] { startTour(); });
  m_actions.add(menu, QStringLiteral("help.shortcuts"), QStringLiteral("Keyboard shortcuts"),
                {QKeySequence(QStringLiteral("Shift+F1"))}, [this] { openShortcuts(*this); });
  m_actions.add(menu, QStringLiteral("help.plugins"), QStringLiteral("Plugins"), {}, [this] {
    m_plugins->refresh();
    m_centre->setCurrentWidget(m_plugins);
  });
  m_actions.add(menu, QStringLiteral("help.messages"), QStringLiteral("Messages"), {},
                [this] { openPage(QStringLiteral("Messages")); });
  m_actions.add(menu, QStringLiteral("help.about"), QStringLiteral("About PhaseSketch"), {}, [this] {
    m_notices->message(MessageLevel::Info, QStringLiteral("PhaseSketch " PS_VERSION),
                       QStringLiteral("Matter that melts, boils and freezes, sketched and set loose. Apache-2.0."));
    openPage(QStringLiteral("Messages"));
  });
}

void MainWindow::openPage(const QString& title) {
  if (!m_layout->offersPage(title)) showWorkspace(kSceneTab);
  m_layout->openPage(title);
}

void MainWindow::startTour() {
  m_welcome->leave();
  m_centre->setCurrentWidget(m_pane);
  showWorkspace(kSceneTab);
  m_layout->setFullViewport(false);
  QWidget* view = viewport() ? static_cast<QWidget*>(viewport()) : m_pane;
  const QString runs = m_session->playing() ? QStringLiteral("It is running. ") : QStringLiteral("Space runs it. ");
  const bool pinned = !m_session->document().project().view.pinned.empty();
  m_tour->start(
      {{view, QStringLiteral("Turn the scene"), runs + howToLook(m_tools->mouse())},
       {inspectorDock(), QStringLiteral("Change it while it runs"),
        QStringLiteral("Drag a slider%1: it acts on the next frame. A double-click puts it back, Ctrl+Z undoes any "
                       "step.")
            .arg(pinned ? QStringLiteral(" under “Try these”") : QString())},
       {m_layout->dock(QStringLiteral("dock.transport")), QStringLiteral("Look back"),
        QStringLiteral(
            "Space pauses, Home goes back to the start. Drag in the bar to see any moment again, and continue "
            "from there.")},
       {m_pane->toolBar(), QStringLiteral("Sketch matter"),
        QStringLiteral("Press B and drag in the view: what you draw is matter at once, of the material that is chosen. "
                       "Esc goes back to looking.")},
       {m_top->searchField(), QStringLiteral("Find anything"),
        QStringLiteral("Ctrl+K finds every command, value, sample and page of help. F1 explains what is under the "
                       "pointer.")}});
}

}  // namespace ps
