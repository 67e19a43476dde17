// SPDX-License-Identifier: Apache-2.0
#include "ui/window/paletteentries.h"

#include "core/matter/material.h"
#include "core/matter/phasebands.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/document/presets.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/pluginpage.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/documentfiles.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/dialogrow.h"
#include "ui/window/dock.h"
#include "ui/window/favouritebrushes.h"
#include "ui/window/libraryactions.h"
#include "ui/window/mainwindow.h"
#include "ui/window/palettemenus.h"
#include "ui/window/paneltable.h"
#include "ui/window/preferenceswindow.h"
#include "ui/window/projectwindow.h"
#include "ui/window/welcome.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QPointer>
#include <QtCore/QRegularExpression>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace ps {
namespace {

using Entries = std::vector<PaletteEntry>;
constexpr const char* kLoading = "Plugins are still being loaded";

/// What stands beside a title: the first of these that the title does not say itself.
QString beside(const QString& title, const QStringList& places) {
  const auto said = [&](const QString& place) {
    return (QLatin1Char(' ') + title).contains(QLatin1Char(' ') + place, Qt::CaseInsensitive);
  };
  const auto place = std::find_if_not(places.begin(), places.end(), said);
  return place == places.end() ? QString() : *place;
}

/// What a thing with rows is; "" where there is one of its kind only.
QString kindOf(Owner owner) {
  switch (owner) {
    case Owner::Wall:
      return QStringLiteral("Wall");
    case Owner::Emitter:
      return QStringLiteral("Tap");
    case Owner::Sink:
      return QStringLiteral("Drain");
    case Owner::Body:
    case Owner::Constraint:
    case Owner::Shape:
      return QStringLiteral("Body");
    case Owner::Probe:
      return QStringLiteral("Probe");
    case Owner::HeatSource:
      return QStringLiteral("Heat source");
    default:
      return {};
  }
}

QString valueText(Document& document, const Address& address, const api::ParameterDeclaration& declaration) {
  const Value value = document.value(address);
  if (const auto* number = std::get_if<double>(&value)) return formatValue(declaration, *number);
  if (const auto* toggle = std::get_if<bool>(&value)) return *toggle ? QStringLiteral("on") : QStringLiteral("off");
  if (const auto* choice = std::get_if<std::string>(&value)) {
    const QStringList labels = choiceLabels(document.project(), document.plugins(), address, declaration);
    const auto index = choiceNames(declaration).indexOf(QString::fromStdString(*choice));
    return index < 0 || labels.isEmpty() ? choiceLabel(QString::fromStdString(*choice)) : labels[index];
  }
  return formatValue(declaration, std::get<Response>(value).at(kRoom));
}

/// Why an action that is disabled is so.
QString whyNot(const QAction& action, bool ready) {
  static constexpr std::pair<const char*, const char*> kReasons[] = {
      {"edit.redo", "Nothing to redo"},
      {"sketch.real", "Nothing is held"},
      {"view.section", "Nothing is cut open: press X"},
      {"window.full", "The welcome page is shown"},
      {"file.restore", "No unsaved work waits"},
      {"file.removeState", "The project holds no saved state"},
      {"simulation.state", "The project holds no saved state"},
      {"file.checkEnd", "This is no copy that was made for sharing"}};
  if (!ready) return QString::fromLatin1(kLoading);
  if (const QString why = action.property(kWhyNot).toString(); !why.isEmpty()) return why;
  for (const auto& [name, reason] : kReasons) {
    if (action.objectName().startsWith(QLatin1String(name))) return QString::fromLatin1(reason);
  }
  return QStringLiteral("Not possible at present");
}

/// Help has all words, so that it comes behind what is called by some of them.
void addActions(Entries& entries, MainWindow& window, const Actions& actions, bool help) {
  const bool ready = window.session().isReady();
  for (QAction* action : actions.all()) {
    if (!action->objectName().contains(QLatin1Char('.')) || action->text().isEmpty()) continue;
    if (action->objectName().startsWith(QLatin1String("help.")) != help) continue;
    QString where = action->objectName().section(QLatin1Char('.'), 0, 0);
    where = where.left(1).toUpper() + where.mid(1);
    const QString title = cleanText(*action);
    entries.push_back({title, beside(title, {where}), action->shortcut().toString(QKeySequence::NativeText),
                       action->property(kWords).toString(), [action] { action->trigger(); },
                       action->property(kReplaces).toBool(), action->isEnabled() ? QString() : whyNot(*action, ready)});
  }
}

void addParameters(Entries& entries, MainWindow& window) {
  Document& document = window.session().document();
  const Project& project = document.project();
  std::vector<Address> addresses = allAddresses(project, document.plugins());
  for (const Probe& probe : project.probes) {  // no values of the scene, and rows all the same
    const api::ParameterList list = declarationsOf(project, document.plugins(), {Owner::Probe, probe.id, ""});
    for (size_t i = 0; i < list.count; ++i) addresses.push_back({Owner::Probe, probe.id, list[i].key});
  }
  for (const Address& address : addresses) {
    const auto* declaration = document.declaration(address);
    if (!declaration) continue;
    const QString title = awayLabel(document.project(), address, QString::fromUtf8(declaration->label));
    const QString kind = kindOf(address.owner), group = QString::fromUtf8(declaration->group);
    const QString owner = kind.isEmpty() ? ownerLabel(document.project(), address) : kind;
    entries.push_back(
        {title, beside(title, {owner, group}), valueText(document, address, *declaration),
         group + QLatin1Char(' ') + QString::fromStdString(address.text()).replace(QLatin1Char('_'), QLatin1Char(' ')),
         [&window, address] { window.revealParameter(address); }});
  }
}

/// Selected, and seen: there is no view on the welcome page, and no outliner in Tune and Film.
void showThing(MainWindow& window, const SelectedItem& item) {
  window.welcome().leave();
  if (window.workspaceTab() != MainWindow::kSketchTab) window.showWorkspace(MainWindow::kSceneTab);
  window.selection().select(item.kind, item.id);
  if (Viewport* view = window.viewport()) view->frameSelection();
}

void addThings(Entries& entries, MainWindow& window) {
  const auto add = [&](const auto& items, OutlineKind kind) {
    for (const auto& item : items) {
      const SelectedItem thing{kind, item.id};
      const auto address = thingOf(thing);  // of a group there is none
      const QString name = nameOf(item), what = address ? kindOf(address->owner) : QStringLiteral("Group");
      entries.push_back({name,
                         beside(name, {what, QStringLiteral("In the scene")}),
                         {},
                         QString::fromStdString(item.id),
                         [&window, thing] { showThing(window, thing); }});
    }
  };
  const Project& project = window.session().document().project();
  add(project.groups, OutlineKind::Group);
  add(project.bodies, OutlineKind::Body);
  add(project.emitters, OutlineKind::Emitter);
  add(project.sinks, OutlineKind::Sink);
  add(project.environment.walls, OutlineKind::Wall);
  add(project.probes, OutlineKind::Probe);
  for (const Body& body : project.bodies) {
    for (size_t k = 0; k < body.pins.size(); ++k) {
      const SelectedItem pin{OutlineKind::Pin, PinAddress{body.id, k}.text()};
      entries.push_back({QStringLiteral("Pin %1 of %2").arg(k + 1).arg(nameOf(body)),
                         QStringLiteral("In the scene"),
                         {},
                         QStringLiteral("holds"),
                         [&window, pin] { showThing(window, pin); }});
    }
  }
}

/// What the menu of files lists, without what is gone.
void addRecent(Entries& entries, MainWindow& window) {
  const bool ready = window.session().isReady();
  for (const QString& path : DocumentFiles::recent()) {
    const QFileInfo file(path);
    const QString title = QStringLiteral("Open recent: ") + file.completeBaseName();
    const QString folder = QDir::toNativeSeparators(file.path());
    entries.push_back({title,
                       beside(title, {folder}),
                       {},
                       {},
                       [&window, path] { window.openFile(path); },
                       true,
                       ready ? QString() : QString::fromLatin1(kLoading)});
  }
}

void addFavourites(Entries& entries, MainWindow& window) {
  for (const FavouriteBrush& favourite : window.favourites().all())
    entries.push_back(
        {favourite.name, QStringLiteral("Favourite brushes"), {}, QStringLiteral("brush"), [&window, favourite] {
           window.welcome().leave();
           window.favourites().take(favourite);
         }});
  for (const ReadyBrush& ready : window.favourites().ready())
    entries.push_back(
        {ready.name, QStringLiteral("Ready brushes"), {}, QStringLiteral("brush ") + ready.about, [&window, ready] {
           window.welcome().leave();
           window.favourites().take(ready);
         }});
}

void revealBrush(MainWindow& window, BrushPanel& panel, const QString& key) {
  window.welcome().leave();
  if (!window.tools().tool().usesBrush()) window.tools().activate(kBrushTool);
  window.layoutOfDocks().showPage(QStringLiteral("Brush"));
  panel.setFilter({});
  panel.setChangedOnly(false);
  panel.reveal(key);
}

void addBrush(Entries& entries, MainWindow& window) {
  auto* panel = window.findChild<BrushPanel*>();
  if (!panel) return;
  for (const ParameterRow* row : panel->rows()) {
    const QString label = QString::fromUtf8(row->model().declaration.label);
    const QString group = QString::fromUtf8(row->model().declaration.group);
    entries.push_back({label, beside(label, {QStringLiteral("Brush"), group}), row->valueText(), group,
                       [&window, panel, key = row->key()] { revealBrush(window, *panel, key); }});
  }
}

void addDialogs(Entries& entries, MainWindow& window) {
  for (const DialogRow& row : preferenceRows())
    entries.push_back({row.label, QStringLiteral("Preferences"), {}, row.words, [&window, label = row.label] {
                         openPreferences(window, label);
                       }});
  for (const DialogRow& row : projectRows())
    entries.push_back({row.label, QStringLiteral("Project properties"), {}, row.words, [&window, label = row.label] {
                         openProjectProperties(window, label);
                       }});
}

/// In sight, in another workspace where this one has no place for it.
void showPage(MainWindow& window, const QString& title) {
  window.welcome().leave();
  WindowLayout& layout = window.layoutOfDocks();
  if (!layout.dockOf(title)) return;
  for (const auto tab : {MainWindow::kSceneTab, MainWindow::kTuneTab, MainWindow::kFilmTab, MainWindow::kSketchTab}) {
    if (layout.offersPage(title)) break;
    window.showWorkspace(tab);
  }
  layout.openPage(title);
}

/// A title without the key that may stand behind it: "One frame (→)".
QString withoutKey(QString title) {
  static const QRegularExpression kKey(QStringLiteral(" \\([^()]+\\)$"));
  return title.remove(kKey);
}

/// What the palette does already. What an action does needs no button beside it, wherever that stands; of two buttons
/// of one name each may do something else in its place. A thing or a row of the same name is something else.
struct Known {
  std::set<QString> actions;
  std::set<std::pair<QString, QString>> buttons;  ///< title and place
};

/// Its menu where a press opens one: a click alone does nothing there.
void press(QAbstractButton& button) {
  auto* tool = qobject_cast<QToolButton*>(&button);
  if (tool && tool->menu())
    QTimer::singleShot(0, tool, &QToolButton::showMenu);  // it has a loop of its own
  else
    button.click();
}

/// It scrolls tabs, or chooses what is shown of a list.
bool isForLooking(const QAbstractButton& button) {
  return qobject_cast<QTabBar*>(button.parentWidget()) || button.objectName() == QStringLiteral("psChip") ||
         button.objectName() == QStringLiteral("psChanged");
}

/// What can be done by a button of this page alone; it is in sight when it is pressed. `show(where)`, or in a header
/// what the button is for.
void addButtons(Entries& entries, Known& known, QWidget& page, const QString& where,
                const std::function<void(const QString&)>& show) {
  for (QAbstractButton* button : page.findChildren<QAbstractButton*>()) {
    if (isForLooking(*button)) continue;
    // What stands on a button may be what is chosen there, or as much of a path as there is room for.
    const QString name = button->accessibleName(), title = name.isEmpty() ? fromButtonText(button->text()) : name;
    const QString own = button->property(kForPage).toString(), at = own.isEmpty() ? where : own;
    const QString place = beside(title, {at});
    if (title.isEmpty() || known.actions.count(withoutKey(title)) || !known.buttons.emplace(title, place).second)
      continue;
    const bool seen = button->isVisibleTo(&page) || !own.isEmpty();  // it comes with what it is for
    entries.push_back({title,
                       place,
                       {},
                       button->toolTip(),
                       [show, at, button = QPointer(button)] {
                         show(at);
                         if (button) press(*button);
                       },
                       false,
                       button->isEnabled() && seen ? QString() : QStringLiteral("Not possible at present")});
  }
}

void addPages(Entries& entries, Known& known, MainWindow& window, const Actions& actions) {
  const auto showTitled = [&window](const QString& title) { showPage(window, title); };
  for (const DockRow& row : dockTable()) {
    const Dock* dock = window.layoutOfDocks().dock(QString::fromLatin1(row.name));
    addButtons(entries, known, *dock->titleBarWidget(), QString::fromLatin1(row.title), showTitled);
  }
  for (const PanelRow& row : panelTable()) {
    const QString title = QString::fromLatin1(row.title);
    const Dock* dock = window.layoutOfDocks().dockOf(title);
    if (QWidget* page = dock ? dock->page(title) : nullptr) addButtons(entries, known, *page, title, showTitled);
  }
  addButtons(entries, known, *window.library().page(), QStringLiteral("Materials of the library"),
             [open = actions.find(QStringLiteral("add.library"))](const QString&) { open->trigger(); });
  addButtons(entries, known, *window.pluginPage(), QStringLiteral("Plugins"),
             [open = actions.find(QStringLiteral("help.plugins"))](const QString&) { open->trigger(); });
  addContextMenus(entries, window, showTitled);
}

QString wordsOf(const std::string& id, const std::vector<std::string>& tags) {
  QString words = QString::fromStdString(id);
  for (const std::string& tag : tags) words += QLatin1Char(' ') + QString::fromStdString(tag);
  return words;
}

/// The scene's, the installed ones that it has not, and all presets.
void addMaterials(Entries& entries, MainWindow& window) {
  Session& session = window.session();
  Selection& selection = window.selection();
  const PluginRegistry* plugins = session.plugins();
  if (!plugins) return;
  const auto title = [](const QString& label) { return QStringLiteral("Add material %1").arg(label); };
  std::map<std::string, QString> words;  // by id
  for (const PluginInfo& info : plugins->plugins()) {
    if (info.kind == PluginKind::Material) words[info.id] = wordsOf(info.id, info.tags);
  }
  std::set<std::string> present;
  for (const SceneMaterial& material : session.document().project().materials) {
    present.insert(material.base);
    entries.push_back({QString::fromStdString(shownName(material)),
                       QStringLiteral("Material"),
                       {},
                       wordsOf(material.id, material.tags) + QLatin1Char(' ') + words[material.base],
                       [&selection, id = material.id] { selection.pickMaterial(id); }});
  }
  for (const std::string& base : plugins->ids(PluginKind::Material)) {
    if (present.count(base)) continue;
    const std::string& label = plugins->material(base)->label;
    entries.push_back({title(QString::fromStdString(label.empty() ? base : label)),
                       QStringLiteral("Installed"),
                       {},
                       words[base],
                       [&session, &selection, base] { selection.pickMaterial(session.document().addMaterial(base)); }});
  }
  for (const LibraryEntry& entry : window.library().library().entries()) {
    if (entry.file.isEmpty()) continue;
    entries.push_back({title(entry.label),
                       QStringLiteral("Presets"),
                       {},
                       entry.about + QLatin1Char(' ') + entry.tags.join(QLatin1Char(' ')),
                       [&session, &selection, material = entry.material] {
                         selection.pickMaterial(addPreset(session.document(), material));
                       }});
  }
}

}  // namespace

std::vector<PaletteEntry> paletteEntries(MainWindow& window, const Actions& actions) {
  Entries entries;
  addActions(entries, window, actions, false);
  Known known;
  for (const PaletteEntry& entry : entries) known.actions.insert(entry.title);
  addParameters(entries, window);
  addMaterials(entries, window);
  addThings(entries, window);
  addRecent(entries, window);
  addBrush(entries, window);
  addFavourites(entries, window);
  addDialogs(entries, window);
  addPages(entries, known, window, actions);
  addActions(entries, window, actions, true);
  return entries;
}

}  // namespace ps
