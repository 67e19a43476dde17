// SPDX-License-Identifier: Apache-2.0
#include "ui/window/windowlayout.h"

#include "ui/theme/theme.h"
#include "ui/timeline/timeline.h"
#include "ui/viewport/viewport.h"
#include "ui/window/dock.h"
#include "ui/window/paneltable.h"

#include <QtCore/QSettings>
#include <QtCore/QTimer>
#include <QtGui/QScreen>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMainWindow>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace ps {
namespace {

constexpr const char* kTheme = "look/dark";
constexpr const char* kGeometry = "window/geometry";
constexpr const char* kHint = "view/hint";
constexpr std::pair<Workspace, const char*> kStates[] = {
    {Workspace::Scene, "window/state"}, {Workspace::Tune, "window/tune"}, {Workspace::Film, "window/film"}};
constexpr int kStateVersion = 4;

/// A column of the layout table: pixels of docks in windows of at least a width.
struct Column {
  int from, left, right, outliner, materials, graphs, curve, curveGraphs, points;
};
constexpr Column kColumns[] = {{0, 204, 352, 270, 140, 182, 400, 150, 400},
                               {1500, 236, 392, 380, 252, 206, 520, 206, 500},
                               {2200, 300, 460, 520, 252, 288, 760, 288, 640}};

const Column& columnOf(int width) {
  return *std::find_if(std::rbegin(kColumns), std::rend(kColumns) - 1,
                       [width](const Column& column) { return width >= column.from; });
}

}  // namespace

WindowLayout::WindowLayout(QMainWindow& window, const Options& options)
    : QObject(&window), m_window(window), m_options(options) {}

void WindowLayout::makeDocks(const PanelContext& context) {
  m_view = context.view;
  m_window.setCorner(Qt::TopRightCorner, Qt::RightDockWidgetArea);
  m_window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  m_window.setCorner(Qt::TopLeftCorner, Qt::LeftDockWidgetArea);
  m_window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  m_window.setDockOptions(QMainWindow::AllowNestedDocks | QMainWindow::AllowTabbedDocks);
  for (const DockRow& row : dockTable()) {
    const QString name = QString::fromLatin1(row.name), first = QString::fromLatin1(row.first);
    auto* dock = new Dock(name, QString::fromLatin1(row.title), &m_window);
    for (const PanelRow& panel : panelTable()) {
      if (name == QLatin1String(panel.dock)) dock->addPage(QString::fromLatin1(panel.title), panel.make(context));
    }
    if (!first.isEmpty()) dock->showPage(first);
    m_docks.push_back(dock);
  }
  // The bar of buttons has neither title nor choice.
  Dock* transport = dock(QStringLiteral("dock.transport"));
  transport->setTitleBarWidget(new QWidget);
  transport->setFeatures(QDockWidget::NoDockWidgetFeatures);
  if (auto* timeline = transport->findChild<Timeline*>()) {
    transport->setFixedHeight(timeline->height());
    connect(timeline, &Timeline::heightChanged, transport,
            [transport](int height) { transport->setFixedHeight(height); });
  }
}

Dock* WindowLayout::dock(const QString& name) const {
  const auto found = std::find_if(m_docks.begin(), m_docks.end(), [&](Dock* d) { return d->objectName() == name; });
  return found == m_docks.end() ? nullptr : *found;
}

void WindowLayout::showPage(const QString& title) {
  for (const PanelRow& row : panelTable()) {
    if (title != QLatin1String(row.title)) continue;
    Dock* holder = dock(QString::fromLatin1(row.dock));
    const auto index = static_cast<size_t>(std::find(m_docks.begin(), m_docks.end(), holder) - m_docks.begin());
    if (shows(index))
      holder->showPage(title);
    else
      holder->choosePage(title);  // to show and hide it would leave the window as wide as both together
  }
}

void WindowLayout::setPageTitle(const QString& title, const QString& shown) {
  std::map<QString, int> pages;  // so far, by dock
  for (const PanelRow& row : panelTable()) {
    const QString name = QString::fromLatin1(row.dock);
    const int page = pages[name]++;
    if (title == QLatin1String(row.title)) dock(name)->setPageTitle(page, shown);
  }
}

void WindowLayout::applyDefault() {
  setFullViewport(false);
  const QSize screen = m_window.screen() ? m_window.screen()->availableSize() : QSize(1600, 1000);
  if (!m_window.testAttribute(Qt::WA_Resized))
    m_window.resize(screen.width() >= 1700 && screen.height() >= 1050 ? QSize(1600, 1000) : QSize(1280, 800));
  m_left.clear();
  lay();
}

void WindowLayout::lay() {
  switch (m_workspace) {
    case Workspace::Scene:
      return layScene();
    case Workspace::Tune:
      return layTune();
    case Workspace::Film:
      return layFilm();
  }
}

bool WindowLayout::shows(size_t dock) const {
  const std::vector<Workspace>& in = dockTable()[dock].workspaces;
  return std::find(in.begin(), in.end(), m_workspace) != in.end();
}

void WindowLayout::setWorkspace(Workspace workspace) {
  if (workspace == m_workspace) return;
  setFullViewport(false);
  m_left[m_workspace] = m_window.saveState(kStateVersion);
  m_workspace = workspace;
  // What goes is hidden first: for a moment there would be room for neither.
  for (size_t i = 0; i < m_docks.size(); ++i) {
    if (!shows(i)) m_docks[i]->hide();
  }
  const auto left = m_left.find(workspace);
  if (left == m_left.end() || !m_window.restoreState(left->second, kStateVersion)) lay();
}

/// Docks move while they are hidden: those in sight would ask for room that they need nowhere.
void WindowLayout::putAway() {
  for (Dock* dock : m_docks) {
    dock->setFloating(false);
    dock->hide();
  }
}

void WindowLayout::showDocks() {
  for (size_t i = 0; i < m_docks.size(); ++i) m_docks[i]->setVisible(shows(i));
  sizeDocks();
}

void WindowLayout::layScene() {
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  // All have a place, so that a saved state says of each that it is hidden.
  for (size_t i = 0; i < m_docks.size(); ++i) {
    if (!shows(i)) m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[i]);
  }
  putAway();
  m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[0]);
  m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[2]);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[3]);
  m_window.splitDockWidget(m_docks[0], m_docks[1], Qt::Vertical);
  m_window.splitDockWidget(m_docks[3], m_docks[4], Qt::Vertical);
  showDocks();
}

/// The curve takes the middle, over graphs and transport; the view stands on the right, over the points.
void WindowLayout::layTune() {
  Dock *responses = m_docks[5], *curve = m_docks[6], *points = m_docks[7];
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  m_window.addDockWidget(Qt::LeftDockWidgetArea, responses);
  m_window.splitDockWidget(responses, curve, Qt::Horizontal);
  m_window.splitDockWidget(curve, m_docks[3], Qt::Vertical);
  m_window.splitDockWidget(m_docks[3], m_docks[4], Qt::Vertical);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, points);
  showDocks();
}

/// The view takes what there is, over the transport.
void WindowLayout::layFilm() {
  putAway();
  m_window.setCorner(Qt::BottomLeftCorner, Qt::BottomDockWidgetArea);
  m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[8]);
  m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[4]);
  showDocks();
}

void WindowLayout::sizeDocks() {
  const Column& column = columnOf(m_window.width());
  if (m_workspace == Workspace::Tune) {
    const int list = column.left, preview = 480;
    m_window.resizeDocks({m_docks[5], m_docks[6]}, {list, m_window.width() - list - preview}, Qt::Horizontal);
    m_window.resizeDocks({m_docks[6], m_docks[3], m_docks[4]}, {column.curve, column.curveGraphs, 40}, Qt::Vertical);
    m_window.resizeDocks({m_docks[7]}, {column.points}, Qt::Vertical);
    return;
  }
  if (m_workspace == Workspace::Film) return m_window.resizeDocks({m_docks[8]}, {column.right}, Qt::Horizontal);
  m_window.resizeDocks({m_docks[0], m_docks[2]}, {column.left, column.right}, Qt::Horizontal);
  m_window.resizeDocks({m_docks[0], m_docks[1]}, {column.outliner, column.materials}, Qt::Vertical);
  m_window.resizeDocks({m_docks[3], m_docks[4]}, {column.graphs, 40}, Qt::Vertical);
}

void WindowLayout::restore() {
  if (!m_options.remember) return;
  const QSettings settings;
  if (!m_options.themeAsked) m_options.dark = settings.value(QLatin1String(kTheme), m_options.dark).toBool();
  if (m_options.dark != Theme::current().dark()) Theme::apply(*qApp, m_options.dark);
  if (settings.contains(QLatin1String(kGeometry))) {
    m_window.restoreGeometry(settings.value(QLatin1String(kGeometry)).toByteArray());
    const QByteArray state = settings.value(QLatin1String(kStates[0].second)).toByteArray();
    m_sizeAtShow = !m_window.restoreState(state, kStateVersion);
  }
  for (const auto& [workspace, key] : kStates) {
    if (workspace != Workspace::Scene) m_left[workspace] = settings.value(QLatin1String(key)).toByteArray();
  }
  if (m_view) m_view->setHintShown(settings.value(QLatin1String(kHint), true).toBool());
}

void WindowLayout::save() const {
  if (!m_options.remember) return;
  QSettings settings;
  if (!m_options.themeAsked) settings.setValue(QLatin1String(kTheme), m_options.dark);
  settings.setValue(QLatin1String(kGeometry), m_window.saveGeometry());
  std::map<Workspace, QByteArray> states = m_left;
  states[m_workspace] = m_full ? m_beforeFull : m_window.saveState(kStateVersion);
  for (const auto& [workspace, key] : kStates) settings.setValue(QLatin1String(key), states[workspace]);
  if (m_view) settings.setValue(QLatin1String(kHint), m_view->hintShown());
}

void WindowLayout::setDark(bool dark) {
  if (dark == m_options.dark) return;
  m_options.dark = dark;
  m_options.themeAsked = false;
  Theme::apply(*qApp, dark);
  if (m_options.remember) QSettings().setValue(QLatin1String(kTheme), dark);
  Q_EMIT themeChanged();
  for (QWidget* widget : m_window.findChildren<QWidget*>()) widget->update();
}

void WindowLayout::setFullViewport(bool on) {
  if (on == m_full) return;
  if (on) m_beforeFull = m_window.saveState(kStateVersion);
  m_full = on;
  for (size_t i = 0; i < m_docks.size(); ++i) m_docks[i]->setVisible(!on && shows(i));
  if (!on) m_window.restoreState(m_beforeFull, kStateVersion);
}

void WindowLayout::onResized(int widthBefore) {
  if (widthBefore >= 0 && &columnOf(widthBefore) != &columnOf(m_window.width())) sizeDocks();
}

/// Sizes given before the window is laid out are not kept.
void WindowLayout::onShown() {
  if (m_sizeAtShow) QTimer::singleShot(0, this, &WindowLayout::sizeDocks);
  m_sizeAtShow = false;
}

}  // namespace ps
