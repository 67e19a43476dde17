// SPDX-License-Identifier: Apache-2.0
#include "ui/window/mainwindow.h"
#include "ui/window/bodyactions.h"

#include "core/plugin_host/registry.h"
#include "ui/curves/curvetarget.h"
#include "ui/document/document.h"
#include "ui/fitting/fitpanel.h"
#include "ui/graphs/graphspanel.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/messagespage.h"
#include "ui/panels/outliner.h"
#include "ui/panels/pluginpage.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/resuming.h"
#include "ui/session/runwork.h"
#include "ui/session/selection.h"
#include "ui/session/wording.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/units.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/transport.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/viewport/viewport.h"
#include "ui/window/coarsenote.h"
#include "ui/window/dock.h"
#include "ui/window/droppedfiles.h"
#include "ui/window/editactions.h"
#include "ui/window/favouritebrushes.h"
#include "ui/window/fileactions.h"
#include "ui/window/handleactions.h"
#include "ui/window/handlenote.h"
#include "ui/window/handparting.h"
#include "ui/window/keyroute.h"
#include "ui/window/libraryactions.h"
#include "ui/window/loosematter.h"
#include "ui/window/makerealbutton.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"
#include "ui/window/openingnote.h"
#include "ui/window/pagechooser.h"
#include "ui/window/paletteentries.h"
#include "ui/window/paneltable.h"
#include "ui/window/preferenceswindow.h"
#include "ui/window/projectwindow.h"
#include "ui/window/restoreoffer.h"
#include "ui/window/shortcutswindow.h"
#include "ui/window/sketchactions.h"
#include "ui/window/statusline.h"
#include "ui/window/thingactions.h"
#include "ui/window/topbar.h"
#include "ui/window/tour.h"
#include "ui/window/undoactions.h"
#include "ui/window/viewactions.h"
#include "ui/window/viewportpane.h"
#include "ui/window/vrmode.h"
#include "ui/window/waysout.h"
#include "ui/window/welcome.h"
#include "ui/window/windowactions.h"
#include "ui/window/windowlook.h"
#include "ui/window/workspacekeys.h"

#include <QtCore/QFileInfo>
#include <QtCore/QMimeData>
#include <QtGui/QAction>
#include <QtGui/QDropEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QResizeEvent>
#include <QtWidgets/QApplication>
#include <QtWidgets/QDialog>
#include <QtWidgets/QDockWidget>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolBar>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

constexpr Workspace kWorkspaceOf[] = {Workspace::Scene, Workspace::Tune, Workspace::Sketch, Workspace::Film};  // by tab

/// The menu of what can be added, for who looks for it where what is added is listed.
void offerInHeader(Dock& outliner, QMenu* adding) {
  QToolButton* button =
      outliner.addAction(QStringLiteral("plus"), QStringLiteral("Add to the scene"), QStringLiteral("Outliner"));
  QObject::connect(button, &QToolButton::clicked, adding,
                   [button, adding] { adding->popup(button->mapToGlobal(QPoint(0, button->height()))); });
}

}  // namespace

MainWindow::MainWindow(const Options& options)
    : m_options(options),
      m_session(std::make_unique<Session>(options.session)),
      m_selection(std::make_unique<Selection>(m_session->document())),
      m_resuming(std::make_unique<Resuming>(*m_session, *m_selection)),
      m_tools(std::make_unique<Toolbox>(m_session->document(), *m_selection)) {
  setObjectName(QStringLiteral("psWindow"));
  if (options.restore) setTemperatureUnit(preferences::temperatures());
  setAcceptDrops(true);
  setContextMenuPolicy(Qt::NoContextMenu);
  connect(m_session.get(), &Session::ready, this, &MainWindow::onReady);  // before the first file is opened
  m_inspector = new Inspector(*m_session, *m_selection, this);
  makeTopBar();
  makeMiddle();
  m_layout = new WindowLayout(*this, {options.restore, options.dark, options.themeAsked});
  m_curves = new CurveTarget(*m_session, *m_selection, this);
  m_layout->makeDocks({*m_session, *m_selection, *m_tools, *m_inspector, *m_curves, viewport()});
  m_notices = new Notices(*m_session, *notice(), m_actions, this);
  m_restore = new RestoreOffer(*m_session, *m_notices, options.restore, this);
  m_files = new FileActions(*m_session, m_actions, *m_notices, *m_restore,
                            {options.project, options.sample, options.samples, options.exitOnBadProject}, this);
  m_pages = new PageChooser(*m_selection, *m_tools, *m_inspector, *m_layout, this);
  makeMenus();
  m_welcome =
      new Welcome({*m_session, m_actions, *m_files, *m_restore, *m_layout, *m_centre, *m_pane, *m_top, viewport()},
                  options.samples, this);
  m_palette = new CommandPalette(this);
  m_tour = new Tour(*this);
  m_waysOut = new WaysOut(
      {*m_session, *m_notices, m_actions, *m_inspector, *m_centre, *m_plugins, findChild<MessagesPage*>()}, this);
  connectParts();
  m_vr = std::make_unique<VrMode>(
      VrMode::Parts{*m_session, viewport(), *m_tools, *m_notices, *m_status, *m_curves, m_actions});
  connect(m_vr.get(), &VrMode::wayOutWanted, m_waysOut, &WaysOut::follow);
  connect(m_vr.get(), &VrMode::refused, m_notices, &Notices::refuse);
  m_layout->applyDefault();
  m_layout->restore();
  const auto* left = std::find(std::begin(kWorkspaceOf), std::end(kWorkspaceOf), m_layout->workspace());
  showWorkspace(static_cast<WorkspaceTab>(left - std::begin(kWorkspaceOf)));
  m_layout->restorePages();
  if (options.restore) takeToolAgain(*m_tools);
  qApp->installEventFilter(this);
  updateTitle();
}

/// What follows the session goes before it.
MainWindow::~MainWindow() {
  qApp->removeEventFilter(this);
  m_vr.reset();
  qDeleteAll(findChildren<QDialog*>(QString(), Qt::FindDirectChildrenOnly));  // they take what was typed when they go
  m_welcome->endPictures();
  m_session->disconnect(this);
  m_session->document().disconnect(this);
  delete takeCentralWidget();
  qDeleteAll(findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly));
  delete findChild<QToolBar*>(QStringLiteral("psStatusBar"), Qt::FindDirectChildrenOnly);
}

Viewport* MainWindow::viewport() const { return m_pane->viewport(); }
NoticeBar* MainWindow::notice() const { return m_pane->notice(); }
Outliner* MainWindow::outliner() const { return findChild<Outliner*>(); }
GraphsPanel* MainWindow::graphs() const { return findChild<GraphsPanel*>(); }
Transport* MainWindow::transport() const { return findChild<Transport*>(); }
bool MainWindow::showsPlugins() const { return m_centre->currentWidget() == m_plugins; }
void MainWindow::openFile(const QString& path) { m_files->open(path); }
void MainWindow::saveTo(const QString& path) { m_files->saveTo(path); }
bool MainWindow::revealParameter(const Address& address, bool focus) {
  m_welcome->leave();
  // The others have no rows.
  if (workspaceTab() != kSketchTab) showWorkspace(kSceneTab);
  return m_pages->reveal(address, focus);
}

void MainWindow::makeTopBar() {
  const auto adopt = [this](QAction* action, const char* name, const QList<QKeySequence>& keys) {
    action->setProperty(kPlainText, cleanText(*action));  // its text goes on to say what is undone
    return m_actions.adopt(action, QString::fromLatin1(name), keys);
  };
  QAction* undoAction =
      adopt(new QAction(QStringLiteral("Undo"), this), "edit.undo", {QKeySequence(QStringLiteral("Ctrl+Z"))});
  QAction* redoAction = adopt(new QAction(QStringLiteral("Redo"), this), "edit.redo",
                              {QKeySequence(QStringLiteral("Ctrl+Shift+Z")), QKeySequence(QStringLiteral("Ctrl+Y"))});
  followHistory(undoAction, redoAction, m_session->document().undoStack());
  QAction* search =
      m_actions.add(nullptr, QStringLiteral("edit.search"), QStringLiteral("Search or command…"),
                    {QKeySequence(QStringLiteral("Ctrl+K"))}, [this] { m_palette->open(paletteEntries()); });
  QAction* headset = m_actions.add(nullptr, QStringLiteral("simulation.vr"), QStringLiteral("VR mode"),
                                   {QKeySequence(QStringLiteral("Ctrl+Shift+V"))}, {});
  m_top = new TopBar(undoAction, redoAction, search, headset);
  setMenuWidget(m_top);
  QTabBar* workspaces = m_top->workspaces();
  for (const char* name : kWorkspaces) workspaces->addTab(QString::fromLatin1(name));
  connect(workspaces, &QTabBar::currentChanged, this, [this](int index) {
    m_centre->setCurrentWidget(m_pane);
    m_tools->activate(index == kSketchTab ? kBrushTool : kSelectTool);  // docks take what its buttons leave
    m_layout->setWorkspace(kWorkspaceOf[index]);
  });
  connect(m_tools.get(), &Toolbox::toolChanged, this, &MainWindow::onTool);
}

MainWindow::WorkspaceTab MainWindow::workspaceTab() const {
  return static_cast<WorkspaceTab>(m_top->workspaces()->currentIndex());
}

void MainWindow::showWorkspace(WorkspaceTab tab) { m_top->workspaces()->setCurrentIndex(tab); }

/// A brush is held in Sketch alone; what else is taken in hand leaves Tune and Film as they are.
void MainWindow::onTool() {
  m_welcome->leave();
  const bool draws = m_tools->tool().usesBrush();
  if (draws == (workspaceTab() == kSketchTab)) return;
  const QSignalBlocker quiet(m_top->workspaces());
  showWorkspace(draws ? kSketchTab : kSceneTab);
  m_layout->setWorkspace(draws ? Workspace::Sketch : Workspace::Scene);
}

void MainWindow::makeMiddle() {
  m_centre = new QStackedWidget;
  m_pane = new ViewportPane(*m_session, *m_selection, *m_tools);
  m_plugins = new PluginPage(*m_session);
  m_centre->addWidget(m_pane);
  m_centre->addWidget(m_plugins);
  roundCorners(*m_centre);
  setCentralWidget(m_centre);
  // The status line spans the window below all docks.
  m_status = new StatusLine(*m_session, viewport());
  auto* bar = new QToolBar;
  bar->setObjectName(QStringLiteral("psStatusBar"));
  bar->setMovable(false);
  bar->setFloatable(false);
  bar->addWidget(m_status);
  bar->toggleViewAction()->setVisible(false);
  addToolBar(Qt::BottomToolBarArea, bar);
}

void MainWindow::makeMenus() {
  QMenuBar* bar = m_top->menus();
  m_edit = std::make_unique<EditActions>(*m_session, *m_selection, *outliner(), *m_inspector, m_actions, *m_notices);
  m_views = std::make_unique<ViewActions>(*m_session, viewport(), *m_layout, m_actions);
  m_bodies = new BodyActions(*m_session, *m_selection, m_actions, *m_notices, this);
  new LooseMatter(*m_session, *m_notices, this);
  m_sketch = std::make_unique<SketchActions>(*m_session, *m_tools, m_actions);
  QMenu* file = bar->addMenu(QStringLiteral("File"));
  m_files->makeMenu(file, viewport());
  QMenu* edit = bar->addMenu(QStringLiteral("Edit"));
  m_edit->makeMenu(edit);
  m_things =
      std::make_unique<ThingActions>(*m_session, *m_selection, *findChild<MaterialsPanel*>(), m_actions, *m_notices);
  m_things->makeMenu(edit);
  m_things->makeArrangeMenu(edit->addMenu(QStringLiteral("Arrange")));
  auto* handles = new HandleActions(*m_tools, m_actions, *m_notices, this);
  handles->addTo(edit);
  m_pane->showHandles(*handles);
  m_actions.add(edit, QStringLiteral("edit.project"), QStringLiteral("Project properties…"), {},
                [this] { openProjectProperties(*this); });
  m_actions.add(edit, QStringLiteral("edit.preferences"), QStringLiteral("Preferences…"),
                {QKeySequence(QStringLiteral("Ctrl+,"))}, [this] { openPreferences(*this); });
  QMenu* adding = bar->addMenu(QStringLiteral("Add"));
  auto* walls = new QMenu(QStringLiteral("Wall"), adding);
  m_edit->makeWallMenu(walls);
  m_bodies->makeMenu(adding, walls);
  m_bodies->addToWallMenu(walls);
  file->insertAction(m_actions.find(QStringLiteral("file.restore")), m_actions.find(QStringLiteral("add.mesh")));
  m_library =
      new LibraryActions(*m_session, *m_selection, m_actions, *m_notices, *m_centre, *m_pane, m_options.presets, this);
  m_library->addTo(adding);
  m_views->makeMenu(bar->addMenu(QStringLiteral("View")));
  m_pane->showLook(m_views->look());
  makeSimulationMenu(bar->addMenu(QStringLiteral("Simulation")));
  QMenu* sketch = bar->addMenu(QStringLiteral("Sketch"));
  m_sketch->makeMenu(sketch);
  new HandParting(
      *m_session, *m_selection, *m_notices, *m_actions.find(QStringLiteral("sketch.separate")),
      [this](const std::string& body) { return m_sketch->hasOtherCells(body); }, this);
  adding->addSeparator();
  for (const char* name : {"sketch.tap", "sketch.drain", "edit.probe", "edit.probeAll"})
    adding->addAction(m_actions.find(QString::fromLatin1(name)));
  offerInHeader(*m_layout->dock(QStringLiteral("dock.outliner")), adding);
  m_favourites = new FavouriteBrushes(*m_session, *m_selection, *m_tools, m_actions, *m_notices, this);
  m_favourites->addTo(sketch);
  m_pane->showFavourites(m_favourites->menu());
  if (viewport()) new MakeRealButton(*m_sketch->makeReal(), *viewport());
  new WindowActions(*this, m_actions, bar->addMenu(QStringLiteral("Window")));
  makeHelpMenu(bar->addMenu(QStringLiteral("Help")));
  const auto useKeysOfWorkspace = [this] {
    useKeys(m_actions, m_layout->workspace() == Workspace::Sketch ? KeysIn::Sketch : KeysIn::Elsewhere);
  };
  connect(m_layout, &WindowLayout::workspaceChanged, this, useKeysOfWorkspace);
  useKeysOfWorkspace();
}

void MainWindow::makeSimulationMenu(QMenu* menu) {
  m_actions.add(menu, QStringLiteral("simulation.play"), QStringLiteral("Play or pause"), {QKeySequence(Qt::Key_Space)},
                [this] { m_session->playPause(); });
  m_actions.add(menu, QStringLiteral("simulation.step"), QStringLiteral("One frame"), {QKeySequence(Qt::Key_Right)},
                [this] { m_session->step(); });
  m_actions.add(menu, QStringLiteral("simulation.back"), QStringLiteral("One recorded frame back"),
                {QKeySequence(Qt::Key_Left)}, [this] { m_session->recorded().step(-1); });
  m_actions.add(menu, QStringLiteral("simulation.nextMark"), QStringLiteral("Next key or marker of the recorded part"),
                {QKeySequence(Qt::SHIFT | Qt::Key_Right)}, [this] { m_session->recorded().stepToMark(true); });
  m_actions.add(menu, QStringLiteral("simulation.previousMark"),
                QStringLiteral("Previous key or marker of the recorded part"), {QKeySequence(Qt::SHIFT | Qt::Key_Left)},
                [this] { m_session->recorded().stepToMark(false); });
  m_actions.add(menu, QStringLiteral("simulation.continue"), QStringLiteral("Continue from the recorded frame shown"),
                {}, [this] { m_session->recorded().continueFromHere(); });
  m_actions.add(menu, QStringLiteral("simulation.marker"), QStringLiteral("Add marker"),
                {QKeySequence(QStringLiteral("Shift+M"))},
                [this] { m_session->document().addMarker(m_session->now()); });
  m_actions.add(menu, QStringLiteral("simulation.ghost"), QStringLiteral("Ghost of an earlier run on or off"), {},
                [this] {
                  RecordedView& recorded = m_session->recorded();
                  m_notices->refuse(QStringLiteral("No ghost is shown."), recorded.setGhost(!recorded.hasGhost()));
                });
  m_actions.add(menu, QStringLiteral("simulation.reset"), QStringLiteral("Back to the start"),
                {QKeySequence(Qt::Key_Home)}, [this] { m_session->reset(); });
  m_actions.add(menu, QStringLiteral("simulation.state"), QStringLiteral("Back to the saved state"),
                {QKeySequence(Qt::SHIFT | Qt::Key_Home)}, [this] { m_session->returnToState(); });
  m_actions.add(menu, QStringLiteral("simulation.now"), QStringLiteral("Newest state, graphs up to now"),
                {QKeySequence(Qt::Key_End)}, [this] {
                  m_session->recorded().showNewest();
                  graphs()->fit();
                });
  menu->addSeparator();
  m_sketch->addGravity(menu);
  menu->addSeparator();
  menu->addAction(m_actions.find(QStringLiteral("simulation.vr")));
  m_actions.add(menu, QStringLiteral("simulation.tryVr"), QStringLiteral("Try VR without a headset"), {}, {});
  m_actions.add(menu, QStringLiteral("simulation.mirror"), QStringLiteral("Show what the headset shows"), {}, {});
}

/// In the header of the dock, beside the graphs alone.
void MainWindow::connectGraphs() {
  Dock* dock = m_layout->dock(QStringLiteral("dock.graphs"));
  QToolButton* button =
      dock->addAction(QStringLiteral("plus"), QStringLiteral("Add a graph"), QStringLiteral("Graphs"));
  connect(button, &QToolButton::clicked, this, [this, button] {
    QMenu* menu = graphs()->makeMenu({});
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->popup(button->mapToGlobal(QPoint(0, button->height())));
  });
  QToolButton* save = dock->addAction(QStringLiteral("download"), QStringLiteral("Export all frames as CSV…"));
  connect(save, &QToolButton::clicked, m_files, &FileActions::exportCsv);
  connect(graphs(), &GraphsPanel::exportRequested, this, [this](const QString& id, const QString& ending) {
    m_files->exportGraph(*graphs(), id.toStdString(), ending);
  });
  keepLook(*m_resuming, *m_session, *graphs(), *m_tools, viewport());
}

void MainWindow::connectParts() {
  connectFiles();
  connectTools();
  connectPanels();
  connectGraphs();
  connectMessages();
  if (viewport()) connectView(*viewport());
}

void MainWindow::connectFiles() {
  connect(&m_session->document(), &Document::changed, this, [this](const ChangeEvent& event) {
    updateTitle();
    if (std::holds_alternative<AboutChanged>(event)) outliner()->rebuild();
  });
  new OpeningNote(m_session->files(), *m_status, this);
  connect(&m_session->files(), &DocumentFiles::opened, this, &MainWindow::updateTitle);
  // Its selection has turned to pages.
  connect(&m_session->files(), &DocumentFiles::opened, m_layout, &WindowLayout::restorePages, Qt::SingleShotConnection);
  connect(&m_session->files(), &DocumentFiles::saved, this, &MainWindow::updateTitle);
  connect(&m_session->files(), &DocumentFiles::saved, outliner(), &Outliner::rebuild);  // the file names the scene
  connect(m_session.get(), &Session::projectShown, this, [this] {
    if (m_session->isBroken() && m_options.exitOnBadProject) {
      Q_EMIT startFailed(notice()->text());
    } else {
      Q_EMIT projectShown();
    }
  });
  connect(m_files, &FileActions::startFailed, this, &MainWindow::startFailed);
}

void MainWindow::connectTools() {
  connect(m_bodies, &BodyActions::reading, m_status, &StatusLine::setWork);
  connect(m_tools.get(), &Toolbox::working, m_status, &StatusLine::setWork);
  connect(m_bodies, &BodyActions::rowWanted, this, [this](const Address& address) { revealParameter(address, false); });
  connect(m_tools.get(), &Toolbox::refused, m_notices, &Notices::refuseTool);
  for (const auto signal : {&Toolbox::brushChanged, &Toolbox::toolChanged})
    connect(m_tools.get(), signal, m_notices, &Notices::toolChanged);
  connect(m_tools.get(), &Toolbox::brushFailed, this, [this](const QString& brush, const QString& problem) {
    m_session->plugins()->fault(brush.toStdString(), problem.toStdString());
    m_plugins->refresh();
  });
  connect(m_sketch.get(), &SketchActions::shapeTaken, this, [this] { m_layout->turnTo(QStringLiteral("Brush")); });
}

void MainWindow::connectPanels() {
  connect(m_inspector, &Inspector::keyRefused, m_notices, &Notices::refuse);
  connect(findChild<KeyRows*>(), &KeyRows::refused, m_notices, &Notices::refuse);
  connect(findChild<KeyRows*>(), &KeyRows::hint, m_status, [this](const QString& text) { m_status->say(text); });
  connect(findChild<KeyRows*>(), &KeyRows::curveWanted, this, [this](const Address& address) {
    m_curves->chooseTrack(address);
    showWorkspace(kTuneTab);
  });
  connect(m_inspector, &Inspector::curveWanted, this, [this](const Address& address) {
    m_curves->choose(address);
    showWorkspace(kTuneTab);
  });
  connect(m_layout, &WindowLayout::themeChanged, m_inspector, &Inspector::rebuild);
  connect(m_layout, &WindowLayout::themeChanged, outliner(), &Outliner::rebuild);
  connect(outliner(), &Outliner::menuRequested, this, [this](const QPoint& global) { m_edit->openItemMenu(global); });
  connect(findChild<BrushPanel*>(), &ParameterPanel::linkActivated, this, [this](const QString&, const QString& link) {
    if (const auto address = Address::parse(link.toStdString())) revealParameter(*address);
  });
  connect(m_plugins, &PluginPage::closeRequested, this, [this] { m_centre->setCurrentWidget(m_pane); });
}

/// What is said, and where it leads.
void MainWindow::connectMessages() {
  connect(m_notices, &Notices::rowWanted, this, [this](const Address& address) { revealParameter(address); });
  const auto* coarse = new CoarseNote(*m_tools, *m_status, this);
  new HandleNote(*m_tools, *m_status);
  connect(m_status, &StatusLine::noteClicked, this, [this, coarse](const QString& parameter) {
    const auto address = Address::parse(coarse->leadsTo(parameter).toStdString());
    if (!address || !revealParameter(*address)) openPage(QStringLiteral("Messages"));
  });
  connect(&m_session->log(), &MessageLog::changed, this, [this] {
    const int unseen = m_session->log().unseen();
    m_layout->setPageTitle(QStringLiteral("Messages"),
                           unseen > 0 ? QStringLiteral("Messages %1").arg(unseen) : QStringLiteral("Messages"));
  });
}

void MainWindow::connectView(Viewport& view) {
  connect(m_sketch.get(), &SketchActions::shapeTaken, &view, [&view] { view.setFocus(Qt::OtherFocusReason); });
  connect(m_sketch.get(), &SketchActions::planeWanted, &view,
          [this, &view](bool acrossView) { m_tools->layPlane(view.pointerNow(), acrossView); });
  connect(&view, &Viewport::viewMenuRequested, this, [this](const QPoint& global) { m_views->openViewMenu(global); });
  connect(&view, &Viewport::glFailed, this, [this](const QString& problem) {
    m_session->log().add(MessageLevel::Error, QStringLiteral("Scene view"),
                         QStringLiteral("Nothing can be drawn. %1").arg(sentence(problem)));
  });
}

void MainWindow::onReady() {
  m_tools->attach(m_session->link());
  m_sketch->addBrushes();
  showPluginProblems();
  if (Viewport* view = viewport(); view && !m_welcome->shown()) view->setFocus(Qt::OtherFocusReason);
}

void MainWindow::showPluginProblems() {
  const auto& plugins = m_session->plugins()->plugins();
  const auto broken = std::count_if(plugins.begin(), plugins.end(),
                                    [](const PluginInfo& p) { return p.state != PluginInfo::State::Loaded; });
  if (broken == 0) return;
  notice()->show(QStringLiteral("plugins"), MessageLevel::Warning,
                 broken == 1 ? QStringLiteral("One plugin was not loaded.")
                             : QStringLiteral("%1 plugins were not loaded.").arg(broken),
                 QStringLiteral("Everything else works."),
                 {{QStringLiteral("Show plugins"), [this] { m_centre->setCurrentWidget(m_plugins); }}});
}

std::vector<PaletteEntry> MainWindow::paletteEntries() {
  m_files->updateRestore();
  return ps::paletteEntries(*this, m_actions);
}

void MainWindow::updateTitle() {
  const Document& document = m_session->document();
  const QString file = document.path().isEmpty() ? document.title() : QFileInfo(document.path()).fileName();
  const auto literal = [](QString text) {  // Qt's mark for unsaved changes must not come from a name
    return text.replace(QStringLiteral("[*]"), QStringLiteral("[*][*]"));
  };
  QString title = literal(file) + QStringLiteral("[*]");
  const QString own = QString::fromStdString(document.project().title);
  if (!own.isEmpty() && own != file) title += QStringLiteral(" – ") + literal(own);
  setWindowTitle(title + QStringLiteral(" – PhaseSketch"));
  setWindowModified(document.isDirty());
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  event->acceptProposedAction();
  const DroppedFiles files(event->mimeData()->urls());
  if (!files.meshes.isEmpty() || !files.problems.isEmpty()) {  // told of over the scene
    m_welcome->leave();
    m_centre->setCurrentWidget(m_pane);
  }
  const bool any = !files.meshes.isEmpty() || !files.project.isEmpty();
  m_notices->refuse(any ? QStringLiteral("Not all files were taken.") : QStringLiteral("No file was taken."),
                    files.problems);
  if (!files.meshes.isEmpty()) m_bodies->importMeshes(files.meshes);
  if (!files.project.isEmpty()) openFile(files.project);
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  m_layout->onResized(event->oldSize().isValid() ? event->oldSize().width() : -1);
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  m_layout->onShown();
}

/// Closing asks nothing: unsaved work is kept as a copy. Only when there can be no copy does the window stay, once.
void MainWindow::closeEvent(QCloseEvent* event) {
  m_layout->save();
  if (m_options.restore) keepTool(*m_tools);
  m_welcome->keepPicture();
  m_vr->leave();  // what is in a hand there ends, and is part of the copy
  const QString problem = m_session->close();
  const Document& document = m_session->document();
  if (!problem.isEmpty() && document.isDirty() && m_warnedAt != document.changeCount()) {
    m_warnedAt = document.changeCount();
    event->ignore();
    const QString more = QStringLiteral("Your work is kept in memory; closing once more gives it up.");
    m_session->log().add(MessageLevel::Error, document.title(),
                         QStringLiteral("Not saved. %1 %2").arg(sentence(problem), more));
    m_files->showNotSaved(problem, more);
    return;
  }
  QMainWindow::closeEvent(event);
}

bool MainWindow::cancelLongWork() {
  if (findChild<OpeningNote*>()->cancel()) return true;
  if (m_notices->cancelMaking() || m_bodies->cancelReading()) return true;
  if (m_session->work().cancel() || m_session->recordings().cancelTold()) return true;
  auto* fitting = findChild<FitPanel*>();
  return fitting && fitting->cancel();
}

void MainWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() != Qt::Key_Escape) {
    // Nothing else wanted it: it is meant to let go of what is held, and there is none.
    const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (enter && leadsTab(QApplication::focusWidget()) && !m_sketch->makeReal()->isEnabled())
      m_status->say(QStringLiteral("Nothing is held. Hold what is drawn (L) keeps what you draw until Enter."));
    QMainWindow::keyPressEvent(event);
  } else if (m_tour->running()) {
    m_tour->end();
  } else if (Viewport* view = viewport(); view && view->cancelGesture()) {
    return;
  } else if (m_welcome->shown()) {
    m_welcome->leave();
  } else if (m_centre->currentWidget() != m_pane) {
    m_centre->setCurrentWidget(m_pane);
  } else if (cancelLongWork()) {
    return;
  } else if (m_layout->fullViewport()) {
    m_layout->setFullViewport(false);
  } else if (m_tools->active() == kSelectTool && view && view->endSection()) {
    return;
  } else if (view && !view->hasFocus()) {  // before the tool: who was at a row goes on with it
    if (auto* field = qobject_cast<QLineEdit*>(QApplication::focusWidget())) {
      while (field->isUndoAvailable()) field->undo();  // to leave it would take what was typed
      field->setModified(false);
    }
    view->setFocus(Qt::OtherFocusReason);
  } else if (m_tools->active() != kSelectTool) {
    m_tools->activate(kSelectTool);
  } else {
    m_selection->clear();
  }
}

/// Single keys belong to the widget that can use them (letters to text fields: Qt does that). Tab in the viewport goes
/// between Scene and Sketch; Shift+Tab and F6 leave it.
bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    if (plain && event->type() == QEvent::ShortcutOverride && takesKey(watched, key->key())) {
      event->accept();
      return true;
    }
    if (plain && event->type() == QEvent::KeyPress && key->key() == Qt::Key_Tab && leadsTab(watched)) {
      showWorkspace(workspaceTab() == kSketchTab ? kSceneTab : kSketchTab);
      return true;
    }
  }
  return QMainWindow::eventFilter(watched, event);
}

}  // namespace ps
