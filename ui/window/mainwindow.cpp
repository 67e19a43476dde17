// SPDX-License-Identifier: Apache-2.0
#include "ui/window/mainwindow.h"

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/simulation/engine.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/wallside.h"
#include "ui/graphs/energypanel.h"
#include "ui/graphs/graphspanel.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/pluginpage.h"
#include "ui/session/documentfiles.h"
#include "ui/session/wording.h"
#include "ui/theme/theme.h"
#include "ui/timeline/transport.h"
#include "ui/window/dock.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"
#include "ui/window/topbar.h"
#include "ui/window/viewmenu.h"
#include "ui/window/viewportpane.h"

#include <QtGui/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr int kSlowInterval = 66;  // ms: values at 15 Hz
}  // namespace

MainWindow::MainWindow(const Options& options)
    : m_options(options), m_session(std::make_unique<Session>(options.session)), m_dark(options.dark) {
  setObjectName(QStringLiteral("psWindow"));
  setAcceptDrops(true);
  setContextMenuPolicy(Qt::NoContextMenu);
  m_inspector = new Inspector(m_session->document(), this);
  makeActions();
  makeDocks();
  m_palette = new CommandPalette(this);
  connectSession();
  connectPanels();
  applyDefaultLayout();
  if (options.restore) restoreWindow();
  m_slow.setInterval(kSlowInterval);
  m_slow.setSingleShot(true);
  connect(&m_slow, &QTimer::timeout, this, &MainWindow::refreshSlow);
  qApp->installEventFilter(this);
  updateTitle();
  refreshStatus();
}

MainWindow::~MainWindow() {
  qApp->removeEventFilter(this);
  if (Viewport* view = viewport()) view->attach(nullptr, nullptr, nullptr);
  m_plugins->setRegistry(nullptr);
  m_session->disconnect(this);
  m_session->document().disconnect(this);
  m_session->log().disconnect();
}

Viewport* MainWindow::viewport() const { return m_pane->viewport(); }
NoticeBar* MainWindow::notice() const { return m_pane->notice(); }
bool MainWindow::showsPlugins() const { return m_centre->currentWidget() == m_plugins; }

void MainWindow::start() {
  m_opening = true;
  m_session->start();
}

void MainWindow::connectSession() {
  connect(m_session.get(), &Session::ready, this, &MainWindow::onReady);
  connect(m_session.get(), &Session::snapshotArrived, this, &MainWindow::onSnapshot);
  connect(m_session.get(), &Session::playingChanged, this, [this] {
    m_transport->setPlaying(m_session->playing());
    refreshStatus();
  });
  connect(&m_session->document(), &Document::changed, this, &MainWindow::onChanged);
  DocumentFiles& files = m_session->files();
  connect(&files, &DocumentFiles::opened, this, &MainWindow::onOpened);
  connect(&files, &DocumentFiles::openFailed, this, &MainWindow::onOpenFailed);
  connect(&files, &DocumentFiles::saveFailed, this, &MainWindow::onSaveFailed);
  connect(&files, &DocumentFiles::saved, this, &MainWindow::onSaved);
  connectAutosave();
  connect(&m_session->log(), &MessageLog::changed, this, [this] {
    const int unseen = m_session->log().unseen();
    m_bottom->setPageTitle(m_messagesPage,
                           unseen > 0 ? QStringLiteral("Messages %1").arg(unseen) : QStringLiteral("Messages"));
  });
}

void MainWindow::connectPanels() {
  connect(m_transport, &Transport::playRequested, m_session.get(), &Session::playPause);
  connect(m_transport, &Transport::stepRequested, m_session.get(), &Session::step);
  connect(m_transport, &Transport::resetRequested, m_session.get(), &Session::reset);
  connect(m_outliner, &Outliner::selectionChanged, this, &MainWindow::onOutlinerSelection);
  connect(m_outliner, &Outliner::menuRequested, this,
          [this](const QPoint& global) { openItemMenu(*this, global, m_outliner->selectedPort().has_value()); });
  connect(m_materials, &MaterialsPanel::picked, this, [this](const std::string& id) {
    m_inspector->setMaterial(id);
    if (Viewport* view = viewport()) {
      BrushSettings brush = view->brush();
      brush.material = id;
      view->setBrush(brush);
      if (view->tool() == ViewTool::Select) m_right->showPage(QStringLiteral("Material"));
    }
  });
  connect(m_pane, &ViewportPane::colourPicked, this, [this](ColourBy colour) { setColour(static_cast<int>(colour)); });
  connect(m_pane, &ViewportPane::toolPicked, this, &MainWindow::setTool);
  connect(m_pane, &ViewportPane::radiusStepped, this, &MainWindow::stepBrush);
  connect(m_pane, &ViewportPane::frameRequested, this, [this] {
    if (Viewport* view = viewport()) view->frameAll();
  });
  connect(m_plugins, &PluginPage::closeRequested, this, [this] { m_centre->setCurrentWidget(m_pane); });
  connect(m_status, &StatusLine::noteClicked, this, [this] {
    if (!m_noteAddress || !revealParameter(*m_noteAddress)) m_bottom->showPage(QStringLiteral("Messages"));
  });
  Viewport* view = viewport();
  if (!view) return;
  const auto setBrush = [view](const BrushSettings& brush) { view->setBrush(brush); };
  connect(m_brush, &BrushPanel::brushEdited, view, setBrush);
  connect(m_pane, &ViewportPane::shapePicked, this, [view](const std::string& shape) {
    BrushSettings brush = view->brush();
    brush.shape = shape;
    view->setBrush(brush);
  });
  connect(view, &Viewport::brushChanged, this, [this, view] {
    m_pane->setBrush(view->brush());
    m_brush->setBrush(view->brush());
    if (!view->brush().material.empty()) m_materials->setCurrent(view->brush().material);
  });
  m_pane->setBrush(view->brush());
  connect(view, &Viewport::bodyPicked, this, &MainWindow::selectBody);
  connect(view, &Viewport::portPicked, this, &MainWindow::selectPort);
  connect(view, &Viewport::placingRefused, this,
          [this](const QString& why) { refuse(QStringLiteral("Nothing was placed."), why); });
  connect(view, &Viewport::toolChanged, this, &MainWindow::setTool);
  connect(view, &Viewport::viewMenuRequested, this, [this](const QPoint& global) { openViewMenu(*this, global); });
  connect(view, &Viewport::strokeRefused, this, [this](const QString& why) {
    notice()->show(QStringLiteral("stroke"), MessageLevel::Warning, QStringLiteral("Nothing was drawn."), why);
    m_session->log().add(MessageLevel::Warning, QStringLiteral("Brush"), why);
  });
  connect(view, &Viewport::glReady, this, [this](const QString& text) {
    m_graphicsText = text;
    refreshStatus();
  });
  connect(view, &Viewport::glFailed, this, [this](const QString& problem) {
    m_session->log().add(MessageLevel::Error, QStringLiteral("Scene view"), problem);
  });
}

void MainWindow::onReady() {
  setFilesEnabled(true);
  m_plugins->setRegistry(m_session->plugins());
  m_transport->setReady(true);
  if (Viewport* view = viewport()) view->attach(&m_session->document(), m_session->engine(), m_session->link());
  const auto& plugins = m_session->plugins()->plugins();
  const auto broken = std::count_if(plugins.begin(), plugins.end(),
                                    [](const PluginInfo& p) { return p.state != PluginInfo::State::Loaded; });
  if (broken > 0) {
    notice()->show(QStringLiteral("plugins"), MessageLevel::Warning,
                   broken == 1 ? QStringLiteral("One plugin was not loaded.")
                               : QStringLiteral("%1 plugins were not loaded.").arg(broken),
                   QStringLiteral("Everything else works."),
                   {{QStringLiteral("Show plugins"), [this] { m_centre->setCurrentWidget(m_plugins); }}});
  }
  refreshStatus();
  if (Viewport* view = viewport()) view->setFocus(Qt::OtherFocusReason);
  openFirst();
}

void MainWindow::onChanged(const ChangeEvent& event) {
  m_inspector->onChanged(event);
  if (std::holds_alternative<ProjectOpened>(event)) {
    onProjectOpened();
  } else if (const auto* parameter = std::get_if<ParameterChanged>(&event)) {
    const Owner owner = parameter->address.owner;
    if (owner == Owner::Wall || owner == Owner::Environment) m_outliner->rebuild();
    if (owner == Owner::Material) m_materials->rebuild();
    if (owner == Owner::Material || owner == Owner::Environment) updateTransitions();
    m_transport->setTimeScale(
        numberOf(m_session->document().project().solver.parameters, solverParameters(), "thermal_time_scale"));
    if (Viewport* view = viewport(); view && owner == Owner::Wall) view->bodiesChanged();
  } else if (std::holds_alternative<BodyChanged>(event) || std::holds_alternative<StrokeChanged>(event)) {
    m_outliner->rebuild();
    if (Viewport* view = viewport()) {
      view->setSelectedBody(m_outliner->selectedBody());  // it may be gone
      view->bodiesChanged();
    }
  } else if (const auto* port = std::get_if<PortChanged>(&event)) {
    if (!port->moved) m_outliner->rebuild();
    if (Viewport* view = viewport()) view->setSelectedPort(m_outliner->selectedPort());  // it may be gone
  } else if (std::holds_alternative<WallsChanged>(event)) {
    m_outliner->rebuild();
    if (Viewport* view = viewport()) view->bodiesChanged();
  } else if (std::holds_alternative<MaterialsChanged>(event)) {
    m_materials->rebuild();
    useCurrentMaterial();
    updateTransitions();
  } else if (std::holds_alternative<ViewChanged>(event)) {
    m_pane->setColour(colourByName(m_session->document().project().view.colour));
  }
  updateTitle();
}

void MainWindow::onProjectOpened() {
  const Project& project = m_session->document().project();
  m_opening = true;
  m_before = m_revision;
  m_historyRead = 0;
  m_outliner->rebuild();
  m_materials->rebuild();
  m_transport->setDuration(project.duration);
  m_transport->setTimeScale(numberOf(project.solver.parameters, solverParameters(), "thermal_time_scale"));
  m_transport->setSnapshot(nullptr);
  m_energy->clear();
  m_energy->setDuration(project.duration);
  m_graphs->setProject(project);
  updateTransitions();
  m_pane->setColour(colourByName(project.view.colour));
  if (Viewport* view = viewport()) view->projectOpened();
  useCurrentMaterial();
  m_brush->setBrush(viewport() ? viewport()->brush() : BrushSettings{});
}

void MainWindow::useCurrentMaterial() {
  Viewport* view = viewport();
  if (!view) return;
  BrushSettings brush = view->brush();
  brush.material = m_materials->current();
  view->setBrush(brush);
}

/// Where the scene's first material changes phase at the air's pressure: marks in the legend, lines in the graph.
void MainWindow::updateTransitions() {
  if (!m_session->plugins()) return;
  const Project& project = m_session->document().project();
  double melts = std::nan(""), boils = std::nan("");
  try {
    const std::vector<Material> materials = compileMaterials(project, *m_session->plugins());
    if (!materials.empty()) {
      const BakedMaterial baked(materials.front(),
                                numberOf(project.environment.parameters, environmentParameters(), "ambient_pressure"));
      if (baked.caloric().melts) melts = baked.caloric().meltingPoint;
      boils = baked.caloric().boilingPoint;
    }
  } catch (const Error&) {
    // Contradicting values: the engine says so; there are no marks.
  }
  m_graphs->setTransitions(melts, boils);
  if (Viewport* view = viewport()) view->setTransitions(std::isfinite(melts) ? melts : 273.15, boils);
}

void MainWindow::onSnapshot() {
  if (!m_slow.isActive()) m_slow.start();
  const SnapshotPtr snapshot = m_session->snapshot();
  if (!snapshot) return;
  if (Viewport* view = viewport()) view->snapshotArrived();
  if (snapshot->revision != m_revision) {
    m_revision = snapshot->revision;
    m_historyRead = 0;
    m_graphs->clear();
    m_energy->clear();
  }
  if (m_opening && m_revision != m_before) {
    if (m_session->isBroken() && m_options.exitOnBadProject) return refreshSlow();  // the event that says why ends it
    m_opening = false;
    refreshSlow();
    Q_EMIT projectShown();
  }
}

void MainWindow::appendHistory() {
  // The frame read last comes again: the scene may have been edited since, and its newer values replace the older ones.
  const size_t from = m_historyRead > 0 ? m_historyRead - 1 : 0;
  const std::vector<FrameStats> fresh = m_session->engine()->history(from);
  m_historyRead = from + fresh.size();
  for (const FrameStats& stats : fresh) {
    m_graphs->append(stats);
    m_energy->append(stats);
  }
}

void MainWindow::refreshSlow() {
  for (const EngineEvent& event : m_session->engine()->events(m_eventsRead)) {
    m_eventsRead = event.number + 1;
    showFailure(event);
  }
  const SnapshotPtr snapshot = m_session->snapshot();
  if (!snapshot) return;
  appendHistory();
  m_transport->setSnapshot(snapshot);
  if (!m_sinceSlow.isValid() || m_sinceSlow.elapsed() > 200) {
    m_sinceSlow.start();
    m_outliner->setSnapshot(snapshot);
    m_inspector->setSnapshot(*snapshot);
  }
  m_transport->setPlaying(m_session->playing());
  refreshStatus();
}

void MainWindow::showFailure(const EngineEvent& event) {
  if (event.kind == EngineEvent::Kind::Settled) {
    notice()->close(QStringLiteral("step"));
    return;
  }
  if (event.kind == EngineEvent::Kind::NotOpened) {
    const QString problem = QString::fromStdString(event.message);
    if (m_opening && m_options.exitOnBadProject) {
      Q_EMIT startFailed(problem);
    } else {
      showBroken(problem);
    }
    return;
  }
  if (event.flags & static_cast<StepFlags>(StepFlag::PluginFault)) m_plugins->refresh();
  const FailureText failure = failureText(event);
  const auto level =
      event.kind == EngineEvent::Kind::Stopped || (event.flags & static_cast<StepFlags>(StepFlag::NotFinite))
          ? MessageLevel::Error
          : MessageLevel::Warning;
  const QString text = failure.title + QLatin1Char(' ') + failure.text;
  m_session->log().add(level, QStringLiteral("Simulation"), text);
  if (notice()->isVisible() && notice()->text() == text) return;  // one of its buttons may be under the pointer
  std::vector<NoticeBar::Button> buttons;
  // Matter runs off without any edit to blame.
  if (failure.lost)
    buttons.push_back({QStringLiteral("Add sides"), [this] { addWalls(kUprightSides); }});
  else if (m_session->document().undoStack().canUndo())
    buttons.push_back({QStringLiteral("Undo"), [this] { m_session->document().undoStack().undo(); }});
  buttons.push_back({QStringLiteral("Reset"), [this] { m_session->reset(); }});
  notice()->show(QStringLiteral("step"), level, failure.title, failure.text, std::move(buttons));
}

void MainWindow::showBroken(const QString& problem) {
  const QString title = QStringLiteral("“%1” cannot run as it is.").arg(m_session->document().title());
  const QString text = sentence(problem) + QStringLiteral(" It is built anew with each change.");
  std::vector<NoticeBar::Button> buttons;
  if (m_session->document().undoStack().canUndo())
    buttons.push_back({QStringLiteral("Undo"), [this] { m_session->document().undoStack().undo(); }});
  buttons.push_back({QStringLiteral("Open another…"), [this] { chooseOpen(); }});
  notice()->show(QStringLiteral("step"), MessageLevel::Error, title, text, std::move(buttons));
  m_session->log().add(MessageLevel::Error, QStringLiteral("Simulation"), title + QLatin1Char(' ') + text);
}

void MainWindow::refreshStatus() {
  StatusLine::State state;
  state.ready = m_session->isReady();
  state.playing = m_session->playing();
  state.snapshot = m_session->snapshot();
  state.failed = m_session->isBroken() ||
                 (state.snapshot && (state.snapshot->flags & static_cast<StepFlags>(StepFlag::NotFinite)));
  state.realTime = m_session->engine() ? m_session->engine()->realTimeFactor() : 0;
  state.drawMilliseconds = viewport() ? viewport()->drawMilliseconds() : 0;
  state.graphics = m_graphicsText;
  state.file = m_session->document().isDirty() && m_fileText.isEmpty() ? QStringLiteral("Not saved") : m_fileText;
  if (state.snapshot && !state.snapshot->limits.empty()) {
    // One that no row can show comes first.
    const std::vector<Limit>& limits = state.snapshot->limits;
    const auto addressOf = [&](const Limit& limit) { return limitAddress(limit, state.snapshot->bodyIds.get()); };
    const auto lonely =
        std::find_if(limits.begin(), limits.end(), [&](const Limit& limit) { return !addressOf(limit); });
    const Limit& first = lonely == limits.end() ? limits.front() : *lonely;
    m_noteAddress = addressOf(first);
    const size_t count = limits.size();
    state.note = (count == 1 ? QStringLiteral("1 note: ") : QStringLiteral("%1 notes: ").arg(count)) +
                 limitNote(first, m_noteAddress ? m_session->document().declaration(*m_noteAddress) : nullptr);
  }
  m_status->setState(state);
}

void MainWindow::refuse(const QString& title, const QString& why) {
  if (why.isEmpty()) {
    notice()->close(QStringLiteral("refused"));
  } else {
    notice()->show(QStringLiteral("refused"), MessageLevel::Warning, title, why);
    m_session->log().add(MessageLevel::Warning, QStringLiteral("Scene"), title + QLatin1Char(' ') + why);
  }
}

void MainWindow::selectBody(const std::string& id) {
  if (id.empty()) {
    m_outliner->selectNothing();
    if (Viewport* view = viewport()) view->setSelectedPort({});
    return;
  }
  m_outliner->select(OutlineKind::Body, id);
  onOutlinerSelection(OutlineKind::Body, id);
}

void MainWindow::selectPort(const Port& port) {
  m_outliner->select(port.sink ? OutlineKind::Sink : OutlineKind::Emitter, port.id);
  onOutlinerSelection(port.sink ? OutlineKind::Sink : OutlineKind::Emitter, port.id);
}

void MainWindow::onOutlinerSelection(OutlineKind kind, const std::string& id) {
  if (Viewport* view = viewport()) {
    view->setSelectedBody(kind == OutlineKind::Body ? id : std::string());
    view->setSelectedPort(m_outliner->selectedPort());
  }
  m_inspector->setBody(kind == OutlineKind::Body ? id : std::string());
  if (kind == OutlineKind::Body) {
    if (const Body* body = m_session->document().body(id)) {
      m_inspector->setMaterial(body->material);
      m_materials->setCurrent(body->material);
    }
    if (m_right->currentPage() != QLatin1String("Material")) m_right->showPage(QStringLiteral("Body"));
  } else if (kind == OutlineKind::Emitter) {
    revealParameter({Owner::Emitter, id, "speed"}, false);
  } else if (kind == OutlineKind::Sink) {
    revealParameter({Owner::Sink, id, "open"}, false);
  } else if (kind == OutlineKind::Wall) {
    revealParameter({Owner::Wall, id, "heat"}, false);  // the outliner keeps the focus: arrows walk on
  } else if (kind == OutlineKind::Environment || kind == OutlineKind::Scene) {
    m_right->showPage(QStringLiteral("Scene"));
  } else {
    m_bottom->showPage(QStringLiteral("Graphs"));
  }
}

bool MainWindow::revealParameter(const Address& address, bool focus) {
  ParameterPanel* panel = m_inspector->panelFor(address);
  if (!panel) return false;
  const QString page = panel == m_inspector->bodyPanel()       ? QStringLiteral("Body")
                       : panel == m_inspector->materialPanel() ? QStringLiteral("Material")
                       : panel == m_inspector->scenePanel()    ? QStringLiteral("Scene")
                                                               : QStringLiteral("Solver");
  m_right->showPage(page);
  panel->setFilter({});
  panel->setChangedOnly(false);
  return panel->reveal(QString::fromStdString(address.text()), focus);
}

void MainWindow::showMessage(MessageLevel level, const QString& where, const QString& text) {
  m_session->log().add(level, where, text);
  if (level == MessageLevel::Error || level == MessageLevel::Warning) notice()->show(where, level, where, text);
}

}  // namespace ps
