// SPDX-License-Identifier: Apache-2.0
#include "ui/window/windowlayout.h"

#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/theme/theme.h"
#include "ui/timeline/timeline.h"
#include "ui/viewport/viewport.h"
#include "ui/window/brushbar.h"
#include "ui/window/dock.h"
#include "ui/window/docklayouts.h"
#include "ui/window/paneltable.h"

#include <QtCore/QPointer>
#include <QtCore/QSettings>
#include <QtCore/QTimer>
#include <QtGui/QScreen>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QApplication>
#include <QtWidgets/QLayout>
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
constexpr const char *kWorkspace = "window/workspace", *kPages = "window/pages/", *kFolded = "window/folded/";
constexpr const char *kChanged = "window/changed/", *kRows = "window/rows";
const QString kOutliner = QStringLiteral("Outliner"), kMaterials = QStringLiteral("Materials");
constexpr std::pair<Workspace, const char*> kStates[] = {{Workspace::Scene, "window/state"},
                                                         {Workspace::Tune, "window/tune"},
                                                         {Workspace::Film, "window/film"},
                                                         {Workspace::Sketch, "window/sketch"}};
constexpr int kStateVersion = 4;
const QString kBrush = QStringLiteral("Brush"), kInspector = QStringLiteral("dock.inspector"),
              kTransport = QStringLiteral("dock.transport"), kBrushes = QStringLiteral("dock.brushes");

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

/// The button by which a panel shows only what differs from its default.
QAbstractButton* changedOf(const ParameterPanel& panel) {
  return panel.findChild<QAbstractButton*>(QStringLiteral("psChanged"));
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
  // Bars of buttons have neither title nor choice.
  Dock* transport = dock(kTransport);
  for (Dock* bar : {transport, dock(kBrushes)}) {
    bar->setTitleBarWidget(new QWidget);
    bar->setFeatures(QDockWidget::NoDockWidgetFeatures);
  }
  dock(kBrushes)->setFixedWidth(BrushBar::kWidth);
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

size_t WindowLayout::indexOf(const Dock* dock) const {
  return static_cast<size_t>(std::find(m_docks.begin(), m_docks.end(), dock) - m_docks.begin());
}

void WindowLayout::showPage(const QString& title) {
  Dock* holder = dockOf(title);
  if (!holder) return;
  if (shows(indexOf(holder)) || !holder->isHidden())
    holder->showPage(title);
  else
    holder->choosePage(title);  // to show and hide it would leave the window as wide as both together
}

void WindowLayout::openPage(const QString& title) {
  if (offersPage(title))
    dockOf(title)->showPage(title);
  else
    showPage(title);
}

void WindowLayout::turnTo(const QString& title) {
  Dock* holder = dockOf(title);
  if (!holder) return;
  if (holder->isHidden())
    holder->choosePage(title);
  else
    holder->showPage(title);
}

bool WindowLayout::offersPage(const QString& title) const {
  const Dock* holder = dockOf(title);
  return holder && offers(indexOf(holder));
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
  if (Dock* holder = dockOf(title)) holder->setPageTitle(title, shown);
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

bool WindowLayout::shows(size_t dock) const {
  if (m_joined && m_docks[dock] == m_docks[1]) return false;
  return ps::shows(dockTable()[dock], m_workspace);
}

bool WindowLayout::offers(size_t dock) const {
  if (m_joined && m_docks[dock] == m_docks[1]) return false;
  return ps::offers(dockTable()[dock], m_workspace);
}

QByteArray WindowLayout::stateNow() const {
  if (m_full) return m_beforeFull;
  return m_waiting.isEmpty() ? m_window.saveState(kStateVersion) : m_waiting;
}

void WindowLayout::setWorkspace(Workspace workspace) {
  if (workspace == m_workspace) return;
  // Who fills the window with the scene may draw there. The others are nothing without their docks.
  const auto hasScene = [](Workspace one) { return one == Workspace::Scene || one == Workspace::Sketch; };
  if (!hasScene(workspace) || !hasScene(m_workspace)) setFullViewport(false);
  const QPointer<QWidget> held = QApplication::focusWidget();
  m_left[m_workspace] = stateNow();
  m_leftWidth[m_workspace] = m_window.width();
  m_waiting.clear();
  m_workspace = workspace;
  fitToWorkspace();
  if (m_full) {
    m_beforeFull = m_left[workspace];
  } else {
    // What goes is hidden first: for a moment there would be room for neither.
    for (size_t i = 0; i < m_docks.size(); ++i) {
      if (!shows(i)) m_docks[i]->hide();
    }
    restoreOrLay(m_left[workspace]);
    m_window.layout()->activate();  // at once: what is in hand stands under the pointer
  }
  // What is gone leaves its keys to the view, and not to a field that is next in line.
  if (m_view && held && !held->isVisible()) m_view->setFocus(Qt::OtherFocusReason);
  Q_EMIT workspaceChanged();
}

void WindowLayout::fitToWorkspace() {
  const bool sketches = m_workspace == Workspace::Sketch;
  dock(kInspector)->movePage(kBrush, sketches ? 0 : -1);
  if (auto* timeline = dock(kTransport)->findChild<Timeline*>()) timeline->setSlim(sketches);
}

/// Docks of this workspace as they were left, unless nobody arranged them and they were left in a window of another
/// width; else as they are by default.
void WindowLayout::restoreOrLay(const QByteArray& state) {
  const DockColumn& now = dockColumn(m_window.width());
  const auto left = m_leftWidth.find(m_workspace);
  const bool sameWidth = left == m_leftWidth.end() || &dockColumn(left->second) == &now;
  const bool fits = isOwn() || (sameWidth && (m_workspace != Workspace::Scene || m_joined == now.joined));
  if (state.isEmpty() || !fits || !restoreDocks(state)) lay();
}

/// Those of this workspace, as a state has them; it may be from before there were some of the docks.
bool WindowLayout::restoreDocks(const QByteArray& state) {
  const bool restored = m_window.restoreState(state, kStateVersion);
  for (size_t i = 0; i < m_docks.size(); ++i) {
    if (!offers(i)) m_docks[i]->hide();
  }
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

void WindowLayout::restore() {
  if (!m_options.remember) return;
  const QSettings settings;
  if (!m_options.themeAsked) m_options.dark = settings.value(QLatin1String(kTheme), m_options.dark).toBool();
  if (m_options.dark != Theme::current().dark()) Theme::apply(*qApp, m_options.dark);
  if (settings.contains(QLatin1String(kGeometry))) restoreWindow(settings);
  for (const auto& [workspace, key] : kStates) {
    if (workspace == m_workspace) continue;
    m_left[workspace] = settings.value(QLatin1String(key)).toByteArray();
    if (m_waitingSize.isValid()) m_leftWidth[workspace] = m_waitingSize.width();
  }
  if (m_view) restoreView(*m_view, settings);
}

/// Older programs kept no workspace: it was Scene that they opened in.
void WindowLayout::restoreWindow(const QSettings& settings) {
  m_window.restoreGeometry(settings.value(QLatin1String(kGeometry)).toByteArray());
  m_own = settings.value(QLatin1String(kOwn), ~0).toInt();  // from before it was noted: nobody can tell
  setJoined(settings.value(QLatin1String(kJoined), false).toBool());
  const QString left = settings.value(QLatin1String(kWorkspace)).toString();
  const auto* was = std::find_if(std::begin(kStates), std::end(kStates),
                                 [&](const auto& state) { return left == QLatin1String(state.second); });
  if (was == std::end(kStates)) was = std::begin(kStates);
  m_workspace = was->first;
  fitToWorkspace();
  const QByteArray state = settings.value(QLatin1String(was->second)).toByteArray();
  m_sizeAtShow = !restoreDocks(state);
  m_waitingSize = settings.value(QLatin1String(kSize)).toSize();
  if (!m_sizeAtShow) m_waiting = state;
  if (m_workspace == Workspace::Scene) return;
  if (m_sizeAtShow) lay();
  Q_EMIT workspaceChanged();
}

void WindowLayout::restorePages() {
  if (!m_options.remember) return;
  const QSettings settings;
  for (Dock* dock : m_docks) dock->choosePage(settings.value(QLatin1String(kPages) + dock->objectName()).toString());
  for (const auto& [title, panel] : rowPanels()) {
    for (const QString& group : settings.value(QLatin1String(kFolded) + title).toStringList())
      panel->setGroupFolded(group, true);
    panel->setChangedOnly(settings.value(QLatin1String(kChanged) + title, false).toBool());
  }
  if (auto* outliner = m_window.findChild<Outliner*>())
    outliner->fold(settings.value(QLatin1String(kRows)).toStringList());
}

std::map<QString, ParameterPanel*> WindowLayout::rowPanels() const {
  std::map<QString, ParameterPanel*> panels;
  for (const PanelRow& row : panelTable()) {
    const QString title = QString::fromLatin1(row.title);
    QWidget* page = dockOf(title) ? dockOf(title)->page(title) : nullptr;
    auto* panel = qobject_cast<ParameterPanel*>(page);
    if (page && !panel) panel = page->findChild<ParameterPanel*>();
    if (panel) panels[title] = panel;
  }
  return panels;
}

void WindowLayout::save() const {
  if (!m_options.remember) return;
  QSettings settings;
  if (!m_options.themeAsked) settings.setValue(QLatin1String(kTheme), m_options.dark);
  settings.setValue(QLatin1String(kGeometry), m_window.saveGeometry());
  std::map<Workspace, QByteArray> states = m_left;
  const bool waits = !m_waiting.isEmpty();  // it was hardly open
  states[m_workspace] = stateNow();
  settings.setValue(QLatin1String(kSize), waits ? m_waitingSize : m_window.size());
  settings.setValue(QLatin1String(kOwn), m_own);
  settings.setValue(QLatin1String(kJoined), m_joined);
  for (const auto& [workspace, key] : kStates) {
    settings.setValue(QLatin1String(key), states[workspace]);
    if (workspace == m_workspace) settings.setValue(QLatin1String(kWorkspace), QLatin1String(key));
  }
  for (const Dock* dock : m_docks) settings.setValue(QLatin1String(kPages) + dock->objectName(), dock->currentPage());
  for (const auto& [title, panel] : rowPanels()) {
    settings.setValue(QLatin1String(kFolded) + title, panel->foldedGroups());
    settings.setValue(QLatin1String(kChanged) + title, changedOf(*panel)->isChecked());
  }
  if (const auto* outliner = m_window.findChild<Outliner*>())
    settings.setValue(QLatin1String(kRows), outliner->folded());
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
  if (on) m_beforeFull = stateNow(), m_leftWidth[m_workspace] = m_window.width();
  m_waiting.clear();
  m_full = on;
  for (size_t i = 0; i < m_docks.size(); ++i) m_docks[i]->setVisible(!on && shows(i));
  if (!on) restoreOrLay(m_beforeFull);
}

/// A window that was maximised has the size that its docks were left for only some time after it is shown; sizes that
/// do not fit before would be cut.
void WindowLayout::onResized(int widthBefore) {
  if (m_window.isVisible() && takeWaiting()) return;
  if (widthBefore >= 0 && &dockColumn(widthBefore) != &dockColumn(m_window.width())) fitColumn();
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
  const bool joined = dockColumn(m_window.width()).joined;
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
