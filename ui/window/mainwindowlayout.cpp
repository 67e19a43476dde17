// SPDX-License-Identifier: Apache-2.0
// Docks of the window, their sizes, the theme, and what is remembered between sessions.
#include "core/simulation/engine.h"
#include "ui/document/document.h"
#include "ui/graphs/energypanel.h"
#include "ui/graphs/graphspanel.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/messagespage.h"
#include "ui/panels/pluginpage.h"
#include "ui/theme/theme.h"
#include "ui/timeline/transport.h"
#include "ui/viewport/viewport.h"
#include "ui/window/dock.h"
#include "ui/window/mainwindow.h"
#include "ui/window/statusline.h"
#include "ui/window/topbar.h"
#include "ui/window/viewportpane.h"

#include <QtCore/QSettings>
#include <QtGui/QResizeEvent>
#include <QtGui/QScreen>
#include <QtWidgets/QApplication>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QToolBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

namespace ps {
namespace {

constexpr const char* kTheme = "look/dark";
constexpr const char* kGeometry = "window/geometry";
constexpr const char* kState = "window/state";
constexpr const char* kHint = "view/hint";
constexpr int kStateVersion = 2;
constexpr int kWide = 1500;  // from here on the wide column of the layout table

}  // namespace

void MainWindow::makeDocks() {
  Document& document = m_session->document();
  setCorner(Qt::TopRightCorner, Qt::RightDockWidgetArea);
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  setCorner(Qt::TopLeftCorner, Qt::LeftDockWidgetArea);
  setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  setDockOptions(QMainWindow::AllowNestedDocks | QMainWindow::AllowTabbedDocks);

  m_centre = new QStackedWidget;
  m_pane = new ViewportPane;
  m_plugins = new PluginPage;
  m_centre->addWidget(m_pane);
  m_centre->addWidget(m_plugins);

  m_left = new Dock(QStringLiteral("dock.outliner"), QStringLiteral("Outliner"), this);
  m_outliner = new Outliner(document);
  m_left->addPage(QStringLiteral("Outliner"), m_outliner);
  m_materialsDock = new Dock(QStringLiteral("dock.materials"), QStringLiteral("Materials"), this);
  m_materials = new MaterialsPanel(document);
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(m_materials);
  connect(m_materials, &MaterialsPanel::revealed, scroll, [scroll](const QRect& tile) {
    scroll->ensureVisible(tile.center().x(), tile.center().y(), 0, tile.height() / 2);
  });
  m_materialsDock->addPage(QStringLiteral("Materials"), scroll);

  m_right = new Dock(QStringLiteral("dock.inspector"), QStringLiteral("Inspector"), this);
  m_brush = new BrushPanel(document);
  m_right->addPage(QStringLiteral("Body"), m_inspector->bodyPanel());
  m_right->addPage(QStringLiteral("Material"), m_inspector->materialPanel());
  m_right->addPage(QStringLiteral("Scene"), m_inspector->scenePanel());
  m_right->addPage(QStringLiteral("Solver"), m_inspector->solverPanel());
  m_right->addPage(QStringLiteral("Brush"), m_brush);
  m_right->showPage(QStringLiteral("Material"));

  m_bottom = new Dock(QStringLiteral("dock.graphs"), QStringLiteral("Graphs"), this);
  m_graphs = new GraphsPanel;
  m_energy = new EnergyPanel;
  m_bottom->addPage(QStringLiteral("Graphs"), m_graphs);
  m_bottom->addPage(QStringLiteral("Energy"), m_energy);
  m_messagesPage = m_bottom->addPage(QStringLiteral("Messages"), new MessagesPage(m_session->log()));
  QToolButton* save = m_bottom->addAction(QStringLiteral("download"), QStringLiteral("Export all frames as CSV…"));
  connect(save, &QToolButton::clicked, this, &MainWindow::exportCsv);

  m_transportDock = new Dock(QStringLiteral("dock.transport"), QStringLiteral("Transport"), this);
  m_transport = new Transport;
  m_transportDock->setTitleBarWidget(new QWidget);
  m_transportDock->setWidget(m_transport);
  m_transportDock->setFeatures(QDockWidget::NoDockWidgetFeatures);

  m_status = new StatusLine;
  auto* middle = new QWidget;
  auto* column = new QVBoxLayout(middle);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(m_centre);
  setCentralWidget(middle);
  // The status line spans the window below all docks.
  auto* bar = new QToolBar;
  bar->setObjectName(QStringLiteral("psStatusBar"));
  bar->setMovable(false);
  bar->setFloatable(false);
  bar->addWidget(m_status);
  bar->toggleViewAction()->setVisible(false);
  addToolBar(Qt::BottomToolBarArea, bar);
}

void MainWindow::applyDefaultLayout() {
  const QSize screen = this->screen() ? this->screen()->availableSize() : QSize(1600, 1000);
  if (!testAttribute(Qt::WA_Resized))
    resize(screen.width() >= 1700 && screen.height() >= 1050 ? QSize(1600, 1000) : QSize(1280, 800));
  for (Dock* dock : {m_left, m_materialsDock, m_right, m_bottom, m_transportDock}) {
    dock->setFloating(false);
    dock->setVisible(true);
  }
  addDockWidget(Qt::LeftDockWidgetArea, m_left);
  addDockWidget(Qt::RightDockWidgetArea, m_right);
  addDockWidget(Qt::BottomDockWidgetArea, m_bottom);
  splitDockWidget(m_left, m_materialsDock, Qt::Vertical);
  splitDockWidget(m_bottom, m_transportDock, Qt::Vertical);
  sizeDocks();
}

void MainWindow::sizeDocks() {
  const bool wide = width() >= kWide;
  resizeDocks({m_left, m_right}, {wide ? 236 : 204, wide ? 392 : 332}, Qt::Horizontal);
  resizeDocks({m_left, m_materialsDock}, {wide ? 380 : 270, wide ? 252 : 140}, Qt::Vertical);
  resizeDocks({m_bottom, m_transportDock}, {wide ? 206 : 182, 40}, Qt::Vertical);
}

void MainWindow::restoreWindow() {
  const QSettings settings;
  if (!m_options.themeAsked) m_dark = settings.value(QLatin1String(kTheme), m_dark).toBool();
  if (m_dark != Theme::current().dark()) Theme::apply(*qApp, m_dark);
  if (settings.contains(QLatin1String(kGeometry))) {
    restoreGeometry(settings.value(QLatin1String(kGeometry)).toByteArray());
    m_sizeAtShow = !restoreState(settings.value(QLatin1String(kState)).toByteArray(), kStateVersion);
  }
  if (Viewport* view = viewport()) view->setHintShown(settings.value(QLatin1String(kHint), true).toBool());
}

void MainWindow::saveWindow() const {
  if (!m_options.restore) return;
  QSettings settings;
  if (!m_options.themeAsked) settings.setValue(QLatin1String(kTheme), m_dark);
  settings.setValue(QLatin1String(kGeometry), saveGeometry());
  settings.setValue(QLatin1String(kState), m_fullViewport ? m_beforeFull : saveState(kStateVersion));
  if (const Viewport* view = viewport()) settings.setValue(QLatin1String(kHint), view->hintShown());
}

void MainWindow::setDark(bool dark) {
  if (dark == m_dark) return;
  m_dark = dark;
  m_options.themeAsked = false;
  Theme::apply(*qApp, dark);
  if (m_options.restore) QSettings().setValue(QLatin1String(kTheme), dark);
  m_inspector->rebuild();
  m_outliner->rebuild();
  for (QWidget* widget : findChildren<QWidget*>()) widget->update();
}

void MainWindow::setFullViewport(bool on) {
  if (on == m_fullViewport) return;
  if (on) m_beforeFull = saveState(kStateVersion);
  m_fullViewport = on;
  for (Dock* dock : {m_left, m_materialsDock, m_right, m_bottom, m_transportDock}) dock->setVisible(!on);
  if (!on) restoreState(m_beforeFull, kStateVersion);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  const bool was = event->oldSize().width() >= kWide, wide = width() >= kWide;
  if (was == wide || !event->oldSize().isValid()) return;
  sizeDocks();
}

/// Sizes given before the window is laid out are not kept.
void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (m_sizeAtShow) QTimer::singleShot(0, this, &MainWindow::sizeDocks);
  m_sizeAtShow = false;
}

}  // namespace ps
