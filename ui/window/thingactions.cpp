// SPDX-License-Identifier: Apache-2.0
#include "ui/window/thingactions.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/scene/group.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/freename.h"
#include "ui/panels/materialspanel.h"
#include "ui/session/excerpt.h"
#include "ui/session/pinexcerpt.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/tools/placing.h"
#include "ui/window/actions.h"
#include "ui/window/notices.h"

#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace ps {
namespace {

QKeySequence keys(const char* text) { return QKeySequence(QString::fromLatin1(text)); }

/// "Ice block", "3 things".
QString whatOf(const Project& things) {
  const Placement all = thingsOf(things);
  const size_t count = itemsOf(all).size();
  if (count == 0 && !things.materials.empty()) return QString::fromStdString(things.materials.front().label);
  if (count != 1) return QStringLiteral("%1 things").arg(count);
  return !all.bodies.empty()     ? nameOf(all.bodies[0])
         : !all.emitters.empty() ? nameOf(all.emitters[0])
         : !all.sinks.empty()    ? nameOf(all.sinks[0])
         : !all.walls.empty()    ? nameOf(all.walls[0])
                                 : nameOf(all.probes[0]);
}

/// As a group names it; "" for what is in none.
std::string memberOf(const SelectedItem& item) {
  const auto thing = thingOf(item);
  const bool canBe = thing && item.kind != OutlineKind::Pin;
  return canBe ? ps::memberOf(thing->owner, item.id) : std::string();
}

/// None is called as another one is.
void nameApart(Project& things, const Project& scene) {
  const auto each = [](auto& items, const auto& there) {
    std::set<std::string> taken;
    for (const auto& item : there) taken.insert(shownName(item));
    for (auto& item : items) {
      const std::string name = freeName(shownName(item), taken);
      if (name != shownName(item)) item.name = name;
      taken.insert(name);
    }
  };
  each(things.bodies, scene.bodies);
  each(things.emitters, scene.emitters);
  each(things.sinks, scene.sinks);
  each(things.environment.walls, scene.environment.walls);
  each(things.probes, scene.probes);
}

void unlock(Project& things) {
  const auto each = [](auto& items) {
    for (auto& item : items) item.locked = false;
  };
  each(things.bodies);
  each(things.emitters);
  each(things.sinks);
  each(things.environment.walls);
  each(things.probes);
}

/// All that can be hidden.
std::vector<Address> addressesOf(const Project& project) {
  std::vector<Address> things;
  const auto each = [&](Owner owner, const auto& items) {
    for (const auto& item : items) things.push_back({owner, item.id, ""});
  };
  each(Owner::Body, project.bodies);
  each(Owner::Emitter, project.emitters);
  each(Owner::Sink, project.sinks);
  each(Owner::Wall, project.environment.walls);
  each(Owner::Probe, project.probes);
  return things;
}

/// Those of the same ids, as they are now.
Placement standing(const Document& document, Placement things) {
  const auto each = [](auto& items, const auto& find) {
    for (auto& item : items) {
      if (const auto* now = find(item.id)) item = *now;
    }
  };
  each(things.bodies, [&](const std::string& id) { return document.body(id); });
  each(things.emitters, [&](const std::string& id) { return document.emitter(id); });
  each(things.sinks, [&](const std::string& id) { return document.sink(id); });
  each(things.walls, [&](const std::string& id) { return document.wall(id); });
  each(things.probes, [&](const std::string& id) { return document.probe(id); });
  return things;
}

void place(Project& things, const Placement& as) {
  things.bodies = as.bodies;
  things.emitters = as.emitters;
  things.sinks = as.sinks;
  things.environment.walls = as.walls;
  things.probes = as.probes;
}

}  // namespace

ThingActions::ThingActions(Session& session, Selection& selection, const MaterialsPanel& materials,
                           const Actions& actions, Notices& notices)
    : m_session(session),
      m_selection(selection),
      m_materials(materials),
      m_actions(actions),
      m_notices(notices),
      m_pins(session.document(), selection, notices) {
  QObject::connect(&selection, &Selection::changed, &m_watch, [this] {
    if (m_copies && m_selection.items() != itemsOf(m_copies->made)) m_copies.reset();
  });
}

void ThingActions::makeMenu(QMenu* menu) {
  menu->setToolTipsVisible(true);
  m_actions.add(menu, QStringLiteral("edit.cut"), QStringLiteral("Cut"), {keys("Ctrl+X")}, [this] {
    if (copy()) remove("cutting %1");
  });
  m_actions.add(menu, QStringLiteral("edit.copy"), QStringLiteral("Copy"), {keys("Ctrl+C")}, [this] { copy(); });
  m_actions.add(menu, QStringLiteral("edit.paste"), QStringLiteral("Paste"), {keys("Ctrl+V")}, [this] { paste(); });
  QAction* copies = m_actions.add(menu, QStringLiteral("edit.duplicate"), QStringLiteral("Duplicate"), {keys("Ctrl+D")},
                                  [this] { duplicate(); });
  copies->setToolTip(QStringLiteral(
      "The copy stands beside all that is there, and is selected. Move or turn it: the next copy of it goes "
      "on by as much, as long as it stays selected."));
  copies->setProperty(kWords, QStringLiteral("duplicate again with offset repeat copies in a row or circle"));
  m_actions.add(menu, QStringLiteral("edit.delete"), QStringLiteral("Delete"), {QKeySequence(Qt::Key_Delete)},
                [this] { remove("deletion of %1"); });
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("edit.group"), QStringLiteral("Group"), {keys("Ctrl+G")}, [this] { group(); });
  m_actions.add(menu, QStringLiteral("edit.ungroup"), QStringLiteral("Ungroup"), {keys("Ctrl+Shift+G")},
                [this] { ungroup(); });
  m_actions.add(menu, QStringLiteral("edit.isolate"), QStringLiteral("Show alone, or all again"), {},
                [this] { isolate(); });
  QAction* pin =
      m_actions.add(menu, QStringLiteral("edit.pin"), QStringLiteral("Add pin"), {}, [this] { m_pins.add(); });
  pin->setToolTip(QStringLiteral("A box that holds what stands in it at the start, once back there."));
}

void ThingActions::makeArrangeMenu(QMenu* menu) {
  constexpr const char* kSides[3][3] = {{"left (x)", "middle (x)", "right (x)"},
                                        {"bottom (y)", "middle (y)", "top (y)"},
                                        {"back (z)", "middle (z)", "front (z)"}};
  constexpr const char* kIds[3][3] = {
      {"left", "middle_x", "right"}, {"bottom", "middle_y", "top"}, {"back", "middle_z", "front"}};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 3; ++side) {
      m_actions.add(menu, QStringLiteral("arrange.align.") + QString::fromLatin1(kIds[axis][side]),
                    QStringLiteral("Align: %1").arg(QString::fromLatin1(kSides[axis][side])), {}, [this, axis, side] {
                      arrange(QStringLiteral("aligning %1"), [=](Placement things, const MatterBoxes& boxes) {
                        return aligned(std::move(things), boxes, axis, static_cast<Side>(side));
                      });
                    });
    }
  }
  menu->addSeparator();
  for (int axis = 0; axis < 3; ++axis) {
    const QChar letter = "xyz"[axis];
    m_actions.add(menu, QStringLiteral("arrange.distribute.") + letter,
                  QStringLiteral("Distribute: equal gaps along %1").arg(letter), {}, [this, axis] {
                    arrange(QStringLiteral("distributing %1"), [=](Placement things, const MatterBoxes& boxes) {
                      return distributed(std::move(things), boxes, axis);
                    });
                  });
  }
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("arrange.drop"), QStringLiteral("Drop to the floor"), {}, [this] { drop(); });
}

void ThingActions::drop() {
  QString note;
  for (const SelectedItem& item : m_selection.items()) {
    const SceneWall* wall = item.kind == OutlineKind::Wall ? m_session.document().wall(item.id) : nullptr;
    if (wall && note.isEmpty()) note = QStringLiteral("“%1”: a wall stays where it is put").arg(nameOf(*wall));
  }
  const auto change = [this](Placement things, const MatterBoxes& boxes) {
    return dropped(m_session.document().project(), std::move(things), boxes);
  };
  arrange(QStringLiteral("dropping %1"), change, note);
}

MatterBoxes ThingActions::matter() const { return matterBoxesOf(m_session.snapshot().get()); }

/// Their panel has the focus: the chosen ones are meant, not what is selected.
bool ThingActions::ofMaterials() const {
  return m_materials.isAncestorOf(QApplication::focusWidget()) || &m_materials == QApplication::focusWidget();
}

Project ThingActions::excerpt() const {
  const Project& project = m_session.document().project();
  return ofMaterials() ? excerptOfMaterials(project, m_selection.materials()) : excerptOf(project, m_selection.items());
}

/// Of what has a place.
QString ThingActions::selectedName() const {
  if (m_pins.alone()) return m_pins.name();
  const auto& items = m_selection.items();
  return items.size() == 1 ? whatOf(excerptOf(m_session.document().project(), items))
                           : QStringLiteral("%1 things").arg(items.size());
}

bool ThingActions::copy() {
  if (m_pins.alone() && !ofMaterials()) {
    QGuiApplication::clipboard()->setText(QString::fromStdString(m_pins.copied()));
    return true;
  }
  const Project things = excerpt();
  if (isEmpty(things)) {
    m_notices.refuse(QStringLiteral("Nothing was copied."),
                     QStringLiteral("Select a body, tap, drain, wall, pin, probe or material first."));
    return false;
  }
  QGuiApplication::clipboard()->setText(QString::fromStdString(textOf(things)));
  return true;
}

void ThingActions::paste() {
  const QString refusal = QStringLiteral("Nothing was pasted.");
  const std::string text = QGuiApplication::clipboard()->text().toStdString();
  const PluginRegistry* plugins = m_session.plugins();
  if (!plugins || m_pins.paste(text)) return;
  if (text.find('{') == std::string::npos) {
    m_notices.refuse(refusal, QStringLiteral("The clipboard holds no part of a project."));
    return;
  }
  Project things;
  try {
    things = excerptIn(text, *plugins);
  } catch (const std::exception& error) {
    m_notices.refuse(refusal, QStringLiteral("The clipboard holds no part of a project: %1.")
                                  .arg(QString::fromUtf8(error.what()).section(QStringLiteral(": "), 1)));
    return;
  }
  if (isEmpty(things)) {
    m_notices.refuse(refusal, QStringLiteral("The project in the clipboard holds nothing."));
    return;
  }
  insert(std::move(things), QStringLiteral("pasting %1"), refusal, Where::IfFree);
}

void ThingActions::duplicate() {
  if (ofMaterials()) {
    m_notices.refuse(
        QStringLiteral("Nothing was copied."),
        QStringLiteral("The scene has the same material once. Click in the view to copy what is selected."));
    return;
  }
  if (m_pins.alone()) return m_pins.duplicate();
  const Document& document = m_session.document();
  Project things = excerptOf(document.project(), m_selection.items());
  if (isEmpty(things)) return;
  Copies copies{thingsOf(things), {}, false};
  if (m_copies) {
    const Placement now = standing(document, m_copies->made);
    const Placement next = continued(m_copies->from, now);
    // Where the way on leads out of the scene it begins anew.
    copies.goOn = (m_copies->goOn || standElsewhere(m_copies->made, now)) && wayTo(next, Where::Here);
    if (copies.goOn) {
      copies.from = now;
      place(things, next);
    }
  }
  copies.made = insert(std::move(things), QStringLiteral("copy of %1"), QStringLiteral("Nothing was copied."),
                       copies.goOn ? Where::Here : Where::Beside);
  if (!copies.made.empty()) m_copies = std::move(copies);
}

std::optional<Vector3> ThingActions::wayTo(const Placement& things, Where where) const {
  const Project& project = m_session.document().project();
  const Vector3 none = Vector3::Zero();
  if (where == Where::Beside || (where == Where::IfFree && overlapsAny(project, things, matter())))
    return wayToFreeRoom(project, things, matter());
  const auto box = where == Where::Here ? boundsOf(things, {}) : std::nullopt;
  const Environment& scene = project.environment;
  for (int a = 0; box && a < 3; ++a) {
    const double at = box->middle()[a];
    if (!scene.periodic[static_cast<size_t>(a)] && (at < scene.boundsMinimum[a] || at > scene.boundsMaximum[a]))
      return std::nullopt;
  }
  return none;
}

/// As far as there is room for them, and selected: what has come.
Placement ThingActions::insert(Project things, const QString& title, const QString& refusal, Where where) {
  Document& document = m_session.document();
  const QString what = whatOf(things);
  nameApart(things, document.project());
  const Placement as = thingsOf(things);
  const std::optional<Vector3> way = wayTo(as, where);
  if (!way) {
    m_notices.refuseUntilEdited(refusal, QStringLiteral("There is no room in the scene for %1.").arg(what));
    return {};
  }
  place(things, shifted(as, *way));
  unlock(things);
  const uint64_t before = document.changeCount();
  const Placement come = document.insertThings(std::move(things), title.arg(what));
  const bool had = document.changeCount() == before;
  m_notices.refuse(refusal, had ? QStringLiteral("The scene has %1 already.").arg(what) : QString());
  if (!come.empty()) m_selection.selectAll(itemsOf(come));
  return come;
}

/// What something is of stays, and is told of.
void ThingActions::removeMaterials(const char* title) {
  Document& document = m_session.document();
  QString problem;
  std::vector<std::string> gone;
  for (const std::string& id : m_selection.materials()) {
    const QString why = document.whyMaterialStays(id);
    if (why.isEmpty())
      gone.push_back(id);
    else
      problem = QStringLiteral("%1.").arg(why);
  }
  m_notices.refuse(gone.empty() ? QStringLiteral("Nothing was deleted.") : QStringLiteral("Not all was deleted."),
                   problem);
  if (gone.empty()) return;
  const QString what = whatOf(excerptOfMaterials(document.project(), gone));
  document.undoStack().beginMacro(QString::fromLatin1(title).arg(what));
  for (const std::string& id : gone) document.removeMaterial(id);
  document.undoStack().endMacro();
}

/// What is locked stays, a body with its pins, and is told of.
void ThingActions::remove(const char* title) {
  if (ofMaterials()) return removeMaterials(title);
  Document& document = m_session.document();
  std::vector<SelectedItem> items = m_selection.items();
  QString problem;
  std::erase_if(items, [&](const SelectedItem& item) {
    const auto thing = thingOf(item);
    const auto marks = thing ? document.marks(*thing) : std::nullopt;
    if (!marks || !marks->locked) return false;
    problem = QStringLiteral("“%1” is locked. Unlock it first.").arg(ownerLabel(document.project(), *thing));
    return true;
  });
  m_notices.refuse(items.empty() ? QStringLiteral("Nothing was deleted.") : QStringLiteral("Not all was deleted."),
                   problem);
  const Project things = excerptOf(document.project(), items);
  Placement held;
  held.pins = withoutPins(document.project(), items);
  if (isEmpty(things) && held.pins.empty()) return;
  const QString what = isEmpty(things)     ? m_pins.name()
                       : held.pins.empty() ? whatOf(things)
                                           : QStringLiteral("%1 things").arg(items.size());
  const QString words = QString::fromLatin1(title).arg(what);
  document.undoStack().beginMacro(words);
  if (!held.pins.empty()) {
    m_pins.selectTheirBodies();  // another pin takes the number of one that goes
    document.place(std::move(held), words);
  }
  for (const SelectedItem& item : items) {
    if (item.kind == OutlineKind::Body) document.removeBody(item.id);
    if (item.kind == OutlineKind::Emitter) document.removePort({false, item.id});
    if (item.kind == OutlineKind::Sink) document.removePort({true, item.id});
    if (item.kind == OutlineKind::Wall) document.removeWall(item.id);
    if (item.kind == OutlineKind::Probe) document.removeProbe(item.id);
  }
  document.undoStack().endMacro();
}

void ThingActions::group() {
  std::vector<std::string> members;
  for (const SelectedItem& item : m_selection.items()) {
    if (const std::string member = memberOf(item); !member.empty()) members.push_back(member);
  }
  if (members.empty()) {
    m_notices.refuse(QStringLiteral("Nothing was grouped."),
                     QStringLiteral("Select bodies, taps, drains, walls or probes first."));
    return;
  }
  m_session.document().addGroup(std::move(members));
}

/// The groups of what is selected.
void ThingActions::ungroup() {
  std::vector<std::string> ids;
  for (const SceneGroup& group : livingGroups(m_session.document().project())) {
    const bool any = std::any_of(m_selection.items().begin(), m_selection.items().end(), [&](const SelectedItem& item) {
      return std::find(group.members.begin(), group.members.end(), memberOf(item)) != group.members.end();
    });
    if (any) ids.push_back(group.id);
  }
  if (!ids.empty()) m_session.document().removeGroups(ids);
}

/// All that is not selected is hidden; where it is already, all is shown. Pins show with their body.
void ThingActions::isolate() {
  Document& document = m_session.document();
  std::vector<Address> chosen, others, all = addressesOf(document.project());
  for (const SelectedItem& item : m_selection.items()) {
    if (const auto thing = thingOf(item)) chosen.push_back(*thing);
  }
  std::copy_if(all.begin(), all.end(), std::back_inserter(others),
               [&](const Address& thing) { return std::find(chosen.begin(), chosen.end(), thing) == chosen.end(); });
  const bool alone =
      std::none_of(others.begin(), others.end(), [&](const Address& thing) { return document.marks(thing)->visible; });
  if (chosen.empty() || alone) return document.setVisible(all, true);
  document.undoStack().beginMacro(QStringLiteral("showing %1 alone").arg(selectedName()));
  document.setVisible(others, false);
  document.setVisible(chosen, true);
  document.undoStack().endMacro();
}

/// What takes no part is told of.
void ThingActions::arrange(const QString& title, const std::function<Placement(Placement, const MatterBoxes&)>& change,
                           const QString& note) {
  Document& document = m_session.document();
  const Placeable things = placeable(document, m_selection.items(), Gizmo::Kind::Move, {});
  const Placement after = change(placementOf(document, things), matter());
  QStringList left;
  for (const QString& each : {things.note, note}) {
    if (!each.isEmpty()) left << each;
  }
  const QString why = left.isEmpty() ? QString() : left.join(QStringLiteral("; ")) + QLatin1Char('.');
  if (after.empty()) {
    m_notices.refuse(QStringLiteral("Nothing was moved."),
                     why.isEmpty() ? QStringLiteral("Select more than that first.") : why);
    return;
  }
  m_notices.refuse(QStringLiteral("Not all was moved."), why);
  document.place(after, title.arg(selectedName()));
}

}  // namespace ps
