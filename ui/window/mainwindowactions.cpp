// SPDX-License-Identifier: Apache-2.0
// Menus, keys and the command palette: every action is declared once here.
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/wallside.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/phasestackview.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/pluginpage.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/documentfiles.h"
#include "ui/theme/numbers.h"
#include "ui/viewport/viewport.h"
#include "ui/window/dock.h"
#include "ui/window/mainwindow.h"
#include "ui/window/shortcutswindow.h"
#include "ui/window/topbar.h"
#include "ui/window/viewportpane.h"

#include <QtCore/QFileInfo>
#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtGui/QKeyEvent>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QAbstractItemView>
#include <QtWidgets/QApplication>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QMenu>
#include <QtWidgets/QMenuBar>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QTabBar>

#include <set>

namespace ps {
namespace {

constexpr const char* kReplaces = "replacesScene";  ///< of actions: see PaletteEntry::replaces

QString cleanText(const QAction& action) { return action.text().remove(QLatin1Char('&')); }

QString valueText(const Value& value, const api::ParameterDeclaration& declaration) {
  if (const auto* number = std::get_if<double>(&value)) return formatValue(declaration, *number);
  if (const auto* toggle = std::get_if<bool>(&value)) return *toggle ? QStringLiteral("on") : QStringLiteral("off");
  if (const auto* choice = std::get_if<std::string>(&value)) return choiceLabel(QString::fromStdString(*choice));
  return formatValue(declaration, std::get<Response>(value).at(293.15));
}

/// Whether a key is for a widget that has the focus rather than for the window: Space presses buttons, arrows walk.
bool takesKey(const QObject* widget, int key) {
  switch (key) {
    case Qt::Key_Delete:
      // Deletes where what is selected can be seen to be: in the outliner and in the view.
      return widget == QApplication::focusWidget() && !qobject_cast<const Viewport*>(widget) &&
             !qobject_cast<const Outliner*>(widget->parent());
    case Qt::Key_Space:
      return qobject_cast<const QAbstractButton*>(widget) || qobject_cast<const QComboBox*>(widget);
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
      if (qobject_cast<const QTabBar*>(widget) || qobject_cast<const QMenuBar*>(widget) ||
          qobject_cast<const MaterialsPanel*>(widget))
        return true;
      [[fallthrough]];
    case Qt::Key_Home:
    case Qt::Key_End:
      return qobject_cast<const QAbstractItemView*>(widget) || qobject_cast<const QComboBox*>(widget);
    default:
      return false;
  }
}

}  // namespace

QAction* MainWindow::action(const QString& name) const { return findChild<QAction*>(name, Qt::FindDirectChildrenOnly); }

QAction* MainWindow::add(QMenu* menu, const QString& name, const QString& text, const QList<QKeySequence>& keys,
                         Act act) {
  auto* action = new QAction(text, this);
  action->setObjectName(name);
  action->setShortcuts(keys);
  if (act) connect(action, &QAction::triggered, this, [act = std::move(act)] { act(); });
  addAction(action);
  if (menu) menu->addAction(action);
  return action;
}

void MainWindow::makeActions() {
  QUndoStack& undo = m_session->document().undoStack();
  const auto adopt = [this](QAction* action, const char* name, const QList<QKeySequence>& keys) {
    action->setParent(this);
    action->setProperty(kPlainText, cleanText(*action));  // its text goes on to say what is undone
    action->setObjectName(QString::fromLatin1(name));
    action->setShortcuts(keys);
    addAction(action);
    return action;
  };
  QAction* undoAction =
      adopt(undo.createUndoAction(this, QStringLiteral("Undo")), "edit.undo", {QKeySequence(QStringLiteral("Ctrl+Z"))});
  QAction* redoAction = adopt(undo.createRedoAction(this, QStringLiteral("Redo")), "edit.redo",
                              {QKeySequence(QStringLiteral("Ctrl+Shift+Z")), QKeySequence(QStringLiteral("Ctrl+Y"))});
  QAction* search = add(nullptr, QStringLiteral("edit.search"), QStringLiteral("Search or command…"),
                        {QKeySequence(QStringLiteral("Ctrl+K"))}, [this] { openPalette(); });
  m_top = new TopBar(undoAction, redoAction, search);
  setMenuWidget(m_top);
  makeFileMenu();
  makeEditMenu();
  makeViewMenu();
  makeSimulationMenu();
  makeSketchMenu();
  makeHelpMenu();
  for (const char* name : {"Scene", "Sketch"}) m_top->workspaces()->addTab(QString::fromLatin1(name));
  connect(m_top->workspaces(), &QTabBar::currentChanged, this, &MainWindow::setWorkspace);
  add(nullptr, QStringLiteral("view.workspace"), QStringLiteral("Next workspace"),
      {QKeySequence(QStringLiteral("Ctrl+Tab"))}, [this] {
        QTabBar* tabs = m_top->workspaces();
        tabs->setCurrentIndex((tabs->currentIndex() + 1) % tabs->count());
      });
}

void MainWindow::makeFileMenu() {
  QMenu* menu = m_top->menus()->addMenu(QStringLiteral("File"));
  add(menu, QStringLiteral("file.new"), QStringLiteral("New scene"), {QKeySequence(QStringLiteral("Ctrl+N"))},
      [this] { m_session->files().newProject(); });
  add(menu, QStringLiteral("file.open"), QStringLiteral("Open…"), {QKeySequence(QStringLiteral("Ctrl+O"))},
      [this] { chooseOpen(); });
  m_recent = menu->addMenu(QStringLiteral("Open recent"));
  connect(m_recent, &QMenu::aboutToShow, this, &MainWindow::fillRecent);
  if (!m_options.sample.isEmpty()) {
    add(menu, QStringLiteral("file.sample"), QStringLiteral("Open sample “Ice on a hot plate”"), {},
        [this] { openFile(m_options.sample); });
  }
  add(menu, QStringLiteral("file.restore"), QStringLiteral("Restore unsaved work…"), {}, [this] { offerRestore(); });
  connect(menu, &QMenu::aboutToShow, this, &MainWindow::updateRestore);
  menu->addSeparator();
  add(menu, QStringLiteral("file.save"), QStringLiteral("Save"), {QKeySequence(QStringLiteral("Ctrl+S"))},
      [this] { save(); });
  add(menu, QStringLiteral("file.saveAs"), QStringLiteral("Save as…"), {QKeySequence(QStringLiteral("Ctrl+Shift+S"))},
      [this] { chooseSave(); });
  menu->addSeparator();
  add(menu, QStringLiteral("file.picture"), QStringLiteral("Save picture of the scene…"), {},
      [this] { exportPicture(); });
  add(menu, QStringLiteral("file.csv"), QStringLiteral("Export all frames as CSV…"), {}, [this] { exportCsv(); });
  menu->addSeparator();
  add(menu, QStringLiteral("file.quit"), QStringLiteral("Quit"), {QKeySequence(QStringLiteral("Ctrl+Q"))},
      [this] { close(); });
  for (const char* name : {"file.new", "file.open", "file.sample", "file.restore"}) {
    if (QAction* replacing = action(QString::fromLatin1(name))) replacing->setProperty(kReplaces, true);
  }
  setFilesEnabled(false);
}

void MainWindow::setFilesEnabled(bool on) {
  for (const char* name : {"file.new", "file.open", "file.sample", "file.save", "file.saveAs"}) {
    if (QAction* needed = action(QString::fromLatin1(name))) needed->setEnabled(on);
  }
  m_recent->setEnabled(on);
}

void MainWindow::updateRestore() { action(QStringLiteral("file.restore"))->setEnabled(!unsavedWork().empty()); }

void MainWindow::fillRecent() {
  m_recent->clear();
  const QStringList recent = DocumentFiles::recent();
  for (const QString& path : recent) {
    m_recent->addAction(QFileInfo(path).completeBaseName() + QStringLiteral("  ·  ") + QFileInfo(path).path(), this,
                        [this, path] { openFile(path); });
  }
  if (recent.isEmpty()) m_recent->addAction(QStringLiteral("No recent files"))->setEnabled(false);
}

void MainWindow::makeEditMenu() {
  QMenu* menu = m_top->menus()->addMenu(QStringLiteral("Edit"));
  menu->addAction(action(QStringLiteral("edit.undo")));
  menu->addAction(action(QStringLiteral("edit.redo")));
  menu->addSeparator();
  add(menu, QStringLiteral("edit.rename"), QStringLiteral("Rename"), {QKeySequence(QStringLiteral("F2"))},
      [this] { m_outliner->renameSelected(); });
  add(menu, QStringLiteral("edit.visible"), QStringLiteral("Show or hide body"), {},
      [this] { m_outliner->toggleVisible(); });
  add(menu, QStringLiteral("edit.locked"), QStringLiteral("Lock body"), {}, [this] { m_outliner->toggleLocked(); });
  add(menu, QStringLiteral("edit.duplicate"), QStringLiteral("Duplicate"), {QKeySequence(QStringLiteral("Ctrl+D"))},
      [this] { duplicateSelected(); });
  add(menu, QStringLiteral("edit.delete"), QStringLiteral("Delete"), {QKeySequence(Qt::Key_Delete)},
      [this] { deleteSelected(); });
  menu->addSeparator();
  menu->addAction(action(QStringLiteral("edit.search")));
}

void MainWindow::duplicateSelected() {
  Document& document = m_session->document();
  if (const auto port = m_outliner->selectedPort()) {
    if (const auto copy = document.duplicatePort(*port)) selectPort(*copy);
  } else {
    refuse(QStringLiteral("Nothing was copied."), document.duplicateBody(m_outliner->selectedBody()));
  }
}

void MainWindow::deleteSelected() {
  Document& document = m_session->document();
  if (const auto port = m_outliner->selectedPort()) {
    document.removePort(*port);
  } else if (const auto [kind, id] = m_outliner->selected(); kind == OutlineKind::Wall) {
    document.removeWall(id);
  } else {
    refuse(QStringLiteral("Nothing was deleted."), document.removeBody(m_outliner->selectedBody()));
  }
}

void MainWindow::addWalls(const std::vector<std::string>& sides) {
  Document& document = m_session->document();
  const QString problem = document.addWalls(sides);
  refuse(QStringLiteral("No wall was added."), problem);
  if (!problem.isEmpty()) return;
  const std::string id = document.project().environment.walls.back().id;
  m_outliner->select(OutlineKind::Wall, id);
  onOutlinerSelection(OutlineKind::Wall, id);
}

void MainWindow::makeViewMenu() {
  QMenu* menu = m_top->menus()->addMenu(QStringLiteral("View"));
  const auto viewAct = [this](auto act) {
    return [this, act] {
      if (Viewport* view = viewport()) act(*view);
    };
  };
  add(menu, QStringLiteral("view.frame"), QStringLiteral("Frame selection"), {QKeySequence(QStringLiteral("F"))},
      viewAct([](Viewport& v) { v.frameSelection(); }));
  add(menu, QStringLiteral("view.frameAll"), QStringLiteral("Frame all"), {QKeySequence(QStringLiteral("Shift+F"))},
      viewAct([](Viewport& v) { v.frameAll(); }));
  QMenu* views = menu->addMenu(QStringLiteral("Look from"));
  const char* const names[] = {
      "Front", "Right", "Top", "Back", "Left", "Bottom", "Orthographic lens on or off", "Scene camera", "Last view"};
  for (int i = 0; i < 9; ++i) {
    add(views, QStringLiteral("view.look%1").arg(i + 1), QString::fromLatin1(names[i]),
        {QKeySequence(QString::number(i + 1)), QKeySequence(QStringLiteral("Alt+%1").arg(i + 1))},
        viewAct([i](Viewport& v) { v.show(static_cast<StandardView>(i + 1)); }));
  }
  QMenu* colours = menu->addMenu(QStringLiteral("Colour"));
  const char* const colourNames[] = {"Matter", "Temperature", "Phase", "Speed", "Density error"};
  for (int i = 0; i < 5; ++i) {
    add(colours, QStringLiteral("view.colour%1").arg(i + 1), QString::fromLatin1(colourNames[i]),
        {QKeySequence(QStringLiteral("Ctrl+%1").arg(i + 1))}, [this, i] { setColour(i); });
  }
  menu->addSeparator();
  auto* themes = new QActionGroup(this);
  for (const bool dark : {true, false}) {
    QAction* theme =
        add(menu, dark ? QStringLiteral("view.dark") : QStringLiteral("view.light"),
            dark ? QStringLiteral("Dark theme") : QStringLiteral("Light theme"), {}, [this, dark] { setDark(dark); });
    theme->setCheckable(true);
    themes->addAction(theme);
  }
  connect(menu, &QMenu::aboutToShow, this, &MainWindow::checkTheme);
  menu->addSeparator();
  add(menu, QStringLiteral("view.full"), QStringLiteral("Full viewport"), {QKeySequence(QStringLiteral("F11"))},
      [this] { setFullViewport(!m_fullViewport); });
  add(menu, QStringLiteral("view.layout"), QStringLiteral("Default layout"), {}, [this] {
    setFullViewport(false);
    applyDefaultLayout();
  });
  add(menu, QStringLiteral("view.hint"), QStringLiteral("Show hints"), {},
      viewAct([](Viewport& v) { v.setHintShown(!v.hintShown()); }));
}

void MainWindow::checkTheme() {
  action(m_dark ? QStringLiteral("view.dark") : QStringLiteral("view.light"))->setChecked(true);
}

void MainWindow::makeSimulationMenu() {
  QMenu* menu = m_top->menus()->addMenu(QStringLiteral("Simulation"));
  add(menu, QStringLiteral("simulation.play"), QStringLiteral("Play or pause"), {QKeySequence(Qt::Key_Space)},
      [this] { m_session->playPause(); });
  add(menu, QStringLiteral("simulation.step"), QStringLiteral("One frame"), {QKeySequence(Qt::Key_Right)},
      [this] { m_session->step(); });
  add(menu, QStringLiteral("simulation.reset"), QStringLiteral("Back to the start"), {QKeySequence(Qt::Key_Home)},
      [this] { m_session->reset(); });
  add(menu, QStringLiteral("simulation.now"), QStringLiteral("Graphs up to now"), {QKeySequence(Qt::Key_End)}, [this] {
    m_graphs->temperatures()->fit();
    m_graphs->phases()->fit();
  });
}

void MainWindow::makeSketchMenu() {
  QMenu* menu = m_top->menus()->addMenu(QStringLiteral("Sketch"));
  add(menu, QStringLiteral("sketch.select"), QStringLiteral("Select and orbit"), {QKeySequence(QStringLiteral("Q"))},
      [this] { setTool(ViewTool::Select); });
  add(menu, QStringLiteral("sketch.brush"), QStringLiteral("Brush"), {QKeySequence(QStringLiteral("B"))},
      [this] { setTool(ViewTool::Brush); });
  add(menu, QStringLiteral("sketch.erase"), QStringLiteral("Erase"), {QKeySequence(QStringLiteral("E"))},
      [this] { setTool(ViewTool::Erase); });
  add(menu, QStringLiteral("sketch.tap"), QStringLiteral("Place a tap"), {QKeySequence(QStringLiteral("T"))},
      [this] { setTool(ViewTool::Tap); });
  add(menu, QStringLiteral("sketch.drain"), QStringLiteral("Place a drain"), {QKeySequence(QStringLiteral("D"))},
      [this] { setTool(ViewTool::Drain); });
  QMenu* walls = menu->addMenu(QStringLiteral("Add wall"));
  for (const WallSide& side : kWallSides) {
    const QString id = QString::fromLatin1(side.id);
    add(walls, QStringLiteral("sketch.wall.") + id,
        QStringLiteral("Add wall: %1").arg(QString::fromLatin1(side.name).toLower()), {},
        [this, side] { addWalls({side.id}); });
  }
  walls->addSeparator();
  add(walls, QStringLiteral("sketch.walls"), QStringLiteral("Add walls: all four sides"), {},
      [this] { addWalls(kUprightSides); });
  menu->addSeparator();
  add(menu, QStringLiteral("sketch.smaller"), QStringLiteral("Smaller brush"), {QKeySequence(QStringLiteral("["))},
      [this] { stepBrush(-1); });
  add(menu, QStringLiteral("sketch.larger"), QStringLiteral("Larger brush"), {QKeySequence(QStringLiteral("]"))},
      [this] { stepBrush(1); });
}

void MainWindow::makeHelpMenu() {
  QMenu* menu = m_top->menus()->addMenu(QStringLiteral("Help"));
  add(menu, QStringLiteral("help.shortcuts"), QStringLiteral("Keyboard shortcuts"),
      {QKeySequence(QStringLiteral("F1"))}, [this] { openShortcuts(*this); });
  add(menu, QStringLiteral("help.plugins"), QStringLiteral("Plugins"), {}, [this] {
    m_plugins->refresh();
    m_centre->setCurrentWidget(m_plugins);
  });
  add(menu, QStringLiteral("help.messages"), QStringLiteral("Messages"), {},
      [this] { m_bottom->showPage(QStringLiteral("Messages")); });
  add(menu, QStringLiteral("help.about"), QStringLiteral("About PhaseSketch"), {}, [this] {
    showMessage(MessageLevel::Info, QStringLiteral("PhaseSketch " PS_VERSION),
                QStringLiteral("Matter that melts, boils and freezes, sketched and set loose. Apache-2.0."));
    m_bottom->showPage(QStringLiteral("Messages"));
  });
}

void MainWindow::setWorkspace(int index) {
  m_centre->setCurrentWidget(m_pane);
  setTool(index == 1 ? ViewTool::Brush : ViewTool::Select);
}

void MainWindow::setTool(ViewTool tool) {
  Viewport* view = viewport();
  if (!view) return;
  if (view->tool() != tool) view->setTool(tool);  // comes back here by toolChanged()
  m_pane->setTool(tool);
  const bool sketching = draws(tool);
  const QSignalBlocker quiet(m_top->workspaces());
  m_top->workspaces()->setCurrentIndex(sketching ? 1 : 0);
  const bool shown = m_right->currentPage() == QLatin1String("Brush");
  if (sketching && !shown) m_right->showPage(QStringLiteral("Brush"));
  if (!sketching && shown) m_right->showPage(QStringLiteral("Material"));
}

void MainWindow::setColour(int index) {
  m_session->document().setColour(colourName(static_cast<ColourBy>(index)));
  m_pane->setColour(static_cast<ColourBy>(index));
}

void MainWindow::stepBrush(int direction) {
  Viewport* view = viewport();
  if (!view) return;
  BrushSettings brush = view->brush();
  brush.radius = direction > 0 ? largerBrush(brush.radius) : smallerBrush(brush.radius);
  view->setBrush(brush);
}

std::vector<PaletteEntry> MainWindow::paletteEntries() {
  updateRestore();
  std::vector<PaletteEntry> entries;
  const QList<QAction*> actions = findChildren<QAction*>(Qt::FindDirectChildrenOnly);
  for (QAction* action : actions) {
    if (action->objectName().isEmpty() || !action->objectName().contains(QLatin1Char('.')) || !action->isEnabled() ||
        action->text().isEmpty())
      continue;
    QString where = action->objectName().section(QLatin1Char('.'), 0, 0);
    where = where.left(1).toUpper() + where.mid(1);
    entries.push_back({cleanText(*action),
                       where,
                       action->shortcut().toString(QKeySequence::NativeText),
                       {},
                       [action] { action->trigger(); },
                       action->property(kReplaces).toBool()});
  }
  Document& document = m_session->document();
  for (const Address& address : allAddresses(document.project(), document.plugins())) {
    const auto* declaration = document.declaration(address);
    if (!declaration) continue;
    const QString label = QString::fromUtf8(declaration->label);
    entries.push_back({awayLabel(document.project(), address, label), ownerLabel(document.project(), address),
                       valueText(document.value(address), *declaration),
                       QString::fromUtf8(declaration->group) + QLatin1Char(' ') +
                           QString::fromStdString(address.text()).replace(QLatin1Char('_'), QLatin1Char(' ')),
                       [this, address] { revealParameter(address); }});
  }
  if (const PluginRegistry* plugins = m_session->plugins()) {
    std::set<std::string> present;
    for (const SceneMaterial& material : document.project().materials) present.insert(material.base);
    for (const std::string& base : plugins->ids(PluginKind::Material)) {
      if (present.count(base)) continue;
      const std::string& label = plugins->material(base)->label;
      entries.push_back({QStringLiteral("Add material %1").arg(QString::fromStdString(label.empty() ? base : label)),
                         QStringLiteral("Materials"),
                         {},
                         QString::fromStdString(base),
                         [this, base] { m_materials->addInstalled(base); }});
    }
  }
  return entries;
}

void MainWindow::openPalette() { m_palette->open(paletteEntries()); }

void MainWindow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    if (Viewport* view = viewport(); view && view->cancelGesture()) return;
    if (showsPlugins()) {
      m_centre->setCurrentWidget(m_pane);
    } else if (m_fullViewport) {
      setFullViewport(false);
    } else {
      setTool(ViewTool::Select);
    }
    return;
  }
  QMainWindow::keyPressEvent(event);
}

/// Single keys belong to the widget that can use them (letters to text fields: Qt does that). Tab in the viewport goes
/// to the other workspace; Shift+Tab leaves it.
bool MainWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    if (plain && event->type() == QEvent::ShortcutOverride && takesKey(watched, key->key())) {
      event->accept();
      return true;
    }
    if (plain && event->type() == QEvent::KeyPress && key->key() == Qt::Key_Tab && watched == viewport()) {
      action(QStringLiteral("view.workspace"))->trigger();
      return true;
    }
  }
  return QMainWindow::eventFilter(watched, event);
}

}  // namespace ps
