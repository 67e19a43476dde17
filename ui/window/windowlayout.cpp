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
constexpr const char* kStudio = "view/studio";
constexpr const char *kSize = "window/size", *kOwn = "window/own", *kJoined = "window/joined";
const QString kOutliner = QStringLiteral("Outliner"), kMaterials = QStringLiteral("Materials");
constexpr std::pair<Workspace, const char*> kStates[] = {
    {Workspace::Scene, "window/state"}, {Workspace::Tune, "window/tune"}, {Workspace::Film, "window/film"}};
constexpr int kStateVersion = 4;

/// A column of the layout table: pixels of docks in windows of at least a width.
struct Column {
  int from;
  bool joined;  ///< outliner and materials are pages of one dock
  int left, right, outliner, materials, graphs, curve, curveGraphs, points;
};
constexpr Column kColumns[] = {{0, true, 204, 352, 270, 140, 182, 400, 150, 400},
                               {1500, false, 236, 392, 380, 252, 206, 520, 206, 500},
                               {2200, false, 300, 460, 520, 252, 288, 760, 288, 640}};

const Column& columnOf(int width) {
  return *std::find_if(std::rbegin(kColumns), std::rend(kColumns) - 1,
                       [width](const Column& column) { return width >= column.from; });
}

QString keyOf(const OverlayRow& row) { return QStringLiteral("view/") + QLatin1String(row.key); }

void restoreView(Viewport& view, const QSettings& settings) {
  OverlayChoice shown;
  for (const OverlayRow& row : kOverlayRows) shown.*row.on = settings.value(keyOf(row), shown.*row.on).toBool();
  view.setOverlays(shown);
  const QString studio = settings.value(QLatin1String(kStudio)).toString();
  for (const StudioRow& row : kStudioRows) {
    if (studio == QLatin1String(row.key)) view.setStudio(row.studio);
  }
}

void saveView(const Viewport& view, QSettings& settings) {
  for (const OverlayRow& row : kOverlayRows) settings.setValue(keyOf(row), view.overlays().*row.on);
  for (const StudioRow& row : kStudioRows) {
    if (view.studio() == row.studio) settings.setValue(QLatin1String(kStudio), QLatin1String(row.key));
  }
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
    connect(dock, &QDockWidget::topLevelChanged, this, [this](bool dragged) {
      if (dragged) setOwn();
    });
  }
  m_window.installEventFilter(this);
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

Dock* WindowLayout::dockOf(const QString& page) const {
  const auto found = std::find_if(m_docks.begin(), m_docks.end(), [&](Dock* d) { return d->hasPage(page); });
  return found == m_docks.end() ? nullptr : *found;
}

void WindowLayout::showPage(const QString& title) {
  Dock* holder = dockOf(title);
  if (!holder) return;
  if (shows(static_cast<size_t>(std::find(m_docks.begin(), m_docks.end(), holder) - m_docks.begin())))
    holder->showPage(title);
  else
    holder->choosePage(title);  // to show and hide it would leave the window as wide as both together
}

bool WindowLayout::isShown(size_t dock) const {
  if (m_joined && m_docks[dock] == m_docks[1])
    return m_docks[0]->isVisibleTo(&m_window) && m_docks[0]->currentPage() == kMaterials;
  return m_docks[dock]->isVisibleTo(&m_window);
}

void WindowLayout::setDockShown(size_t dock, bool on) {
  setFullViewport(false);
  setOwn();
  if (m_joined && m_docks[dock] == m_docks[1]) {
    m_docks[0]->setVisible(true);
    m_docks[0]->choosePage(on ? kMaterials : kOutliner);
  } else {
    m_docks[dock]->setVisible(on);
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
  m_own = 0;
  m_waiting.clear();
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
  if (m_joined && m_docks[dock] == m_docks[1]) return false;
  const std::vector<Workspace>& in = dockTable()[dock].workspaces;
  return std::find(in.begin(), in.end(), m_workspace) != in.end();
}

void WindowLayout::setWorkspace(Workspace workspace) {
  if (workspace == m_workspace) return;
  setFullViewport(false);
  m_left[m_workspace] = m_waiting.isEmpty() ? m_window.saveState(kStateVersion) : m_waiting;
  m_waiting.clear();
  m_workspace = workspace;
  // What goes is hidden first: for a moment there would be room for neither.
  for (size_t i = 0; i < m_docks.size(); ++i) {
    if (!shows(i)) m_docks[i]->hide();
  }
  const auto left = m_left.find(workspace);
  const bool fits = workspace != Workspace::Scene || isOwn() || m_joined == columnOf(m_window.width()).joined;
  if (left == m_left.end() || !fits || !restoreDocks(left->second)) lay();
}

/// Those of this workspace, as a state has them.
bool WindowLayout::restoreDocks(const QByteArray& state) {
  const bool restored = m_window.restoreState(state, kStateVersion);
  if (m_joined) m_docks[1]->hide();
  return restored;
}

/// Outliner and materials as pages of one dock, where there is no room for one above the other.
void WindowLayout::setJoined(bool joined) {
  if (joined == m_joined) return;
  m_joined = joined;
  Dock *outliner = m_docks[0], *materials = m_docks[1];
  if (joined) {
    materials->hide();
    outliner->addPage(kMaterials, materials->takePage(kMaterials));
  } else {
    materials->addPage(kMaterials, outliner->takePage(kMaterials));
  }
}

void WindowLayout::joinMaterials(bool joined) {
  if (joined == m_joined) return;
  setJoined(joined);
  if (m_workspace != Workspace::Scene) return;
  if (!joined) m_window.splitDockWidget(m_docks[0], m_docks[1], Qt::Vertical);
  m_docks[1]->setVisible(!joined);
  sizeDocks();
}

bool WindowLayout::isOwn() const { return m_own & (1 << static_cast<int>(m_workspace)); }

/// From here on the docks of this workspace stay as somebody arranged them, whatever size the window gets.
void WindowLayout::setOwn() {
  m_own |= 1 << static_cast<int>(m_workspace);
  m_waiting.clear();
}

/// A separator was dragged where docks have other sizes after it than before.
bool WindowLayout::eventFilter(QObject* watched, QEvent* event) {
  const auto sizes = [this] {
    std::vector<QSize> all;
    for (const Dock* dock : m_docks) all.push_back(dock->isVisible() ? dock->size() : QSize());
    return all;
  };
  if (event->type() == QEvent::MouseButtonPress) m_pressed = sizes();
  if (event->type() == QEvent::MouseButtonRelease && !m_pressed.empty() && std::exchange(m_pressed, {}) != sizes())
    setOwn();
  return QObject::eventFilter(watched, event);
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
  setJoined(columnOf(m_window.width()).joined);
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
  if (!m_joined) m_window.splitDockWidget(m_docks[0], m_docks[1], Qt::Vertical);
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
  if (!m_joined) m_window.resizeDocks({m_docks[0], m_docks[1]}, {column.outliner, column.materials}, Qt::Vertical);
  m_window.resizeDocks({m_docks[3], m_docks[4]}, {column.graphs, 40}, Qt::Vertical);
}

void WindowLayout::restore() {
  if (!m_options.remember) return;
  const QSettings settings;
  if (!m_options.themeAsked) m_options.dark = settings.value(QLatin1String(kTheme), m_options.dark).toBool();
  if (m_options.dark != Theme::current().dark()) Theme::apply(*qApp, m_options.dark);
  if (settings.contains(QLatin1String(kGeometry))) {
    m_window.restoreGeometry(settings.value(QLatin1String(kGeometry)).toByteArray());
    m_own = settings.value(QLatin1String(kOwn), ~0).toInt();  // from before it was noted: nobody can tell
    setJoined(settings.value(QLatin1String(kJoined), false).toBool());
    const QByteArray state = settings.value(QLatin1String(kStates[0].second)).toByteArray();
    m_sizeAtShow = !restoreDocks(state);
    m_waitingSize = settings.value(QLatin1String(kSize)).toSize();
    if (!m_sizeAtShow) m_waiting = state;
  }
  for (const auto& [workspace, key] : kStates) {
    if (workspace != Workspace::Scene) m_left[workspace] = settings.value(QLatin1String(key)).toByteArray();
  }
  if (m_view) restoreView(*m_view, settings);
}

void WindowLayout::save() const {
  if (!m_options.remember) return;
  QSettings settings;
  if (!m_options.themeAsked) settings.setValue(QLatin1String(kTheme), m_options.dark);
  settings.setValue(QLatin1String(kGeometry), m_window.saveGeometry());
  std::map<Workspace, QByteArray> states = m_left;
  const bool waits = !m_waiting.isEmpty();  // it was hardly open
  states[m_workspace] = m_full ? m_beforeFull : waits ? m_waiting : m_window.saveState(kStateVersion);
  settings.setValue(QLatin1String(kSize), waits ? m_waitingSize : m_window.size());
  settings.setValue(QLatin1String(kOwn), m_own);
  settings.setValue(QLatin1String(kJoined), m_joined);
  for (const auto& [workspace, key] : kStates) settings.setValue(QLatin1String(key), states[workspace]);
  if (m_view) saveView(*m_view, settings);
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
  if (on) m_beforeFull = m_waiting.isEmpty() ? m_window.saveState(kStateVersion) : m_waiting;
  m_waiting.clear();
  m_full = on;
  for (size_t i = 0; i < m_docks.size(); ++i) m_docks[i]->setVisible(!on && shows(i));
  if (!on) restoreDocks(m_beforeFull);
}

/// A window that was maximised has the size that its docks were left for only some time after it is shown; sizes that
/// do not fit before would be cut.
void WindowLayout::onResized(int widthBefore) {
  if (m_window.isVisible() && takeWaiting()) return;
  if (widthBefore >= 0 && &columnOf(widthBefore) != &columnOf(m_window.width())) fitColumn();
}

bool WindowLayout::takeWaiting() {
  if (m_waiting.isEmpty() || m_window.size() != m_waitingSize) return false;
  QTimer::singleShot(0, this, [this] {
    if (!m_waiting.isEmpty()) restoreDocks(std::exchange(m_waiting, {}));
  });
  return true;
}

/// Nothing that somebody arranged moves.
void WindowLayout::fitColumn() {
  if (isOwn() || m_full) return;
  const bool joined = columnOf(m_window.width()).joined;
  if (m_workspace == Workspace::Scene && joined != m_joined)
    joinMaterials(joined);
  else
    sizeDocks();
}

/// Sizes given before the window is laid out are not kept.
void WindowLayout::onShown() {
  if (m_sizeAtShow) QTimer::singleShot(0, this, &WindowLayout::fitColumn);
  m_sizeAtShow = false;
  takeWaiting();
}

}  // namespace ps
