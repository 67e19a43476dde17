// SPDX-License-Identifier: Apache-2.0
#include "ui/window/editactions.h"

#include "core/scene/scenewall.h"
#include "core/simulation/graphsource.h"
#include "core/simulation/rules.h"
#include "core/simulation/snapshot.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/wallside.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/rowcommands.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/window/actions.h"
#include "ui/window/entrytext.h"
#include "ui/window/notices.h"

#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

namespace ps {
namespace {

/// The middle third of a body as it is shown, along each axis, and no less than has particles in it; nothing where
/// there is no matter of it, as in the hole of a ring.
std::optional<Region> coreOf(const Snapshot* shown, const std::string& body) {
  if (!shown || !shown->bodyIds) return std::nullopt;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Vector3 low = Vector3::Constant(kNone), high = Vector3::Constant(-kNone);
  double radius = 0;
  std::vector<Vector3> places;
  for (size_t i = 0; i < shown->position.size(); ++i) {
    const size_t of = shown->body[i];
    if (of >= shown->bodyIds->size() || (*shown->bodyIds)[of] != body || shown->motion[i] == api::Motion::Gas) continue;
    places.push_back(vectorOf(shown->position[i]));
    low = low.cwiseMin(places.back());
    high = high.cwiseMax(places.back());
    radius = std::max(radius, static_cast<double>(shown->position[i].w));
  }
  if (places.empty()) return std::nullopt;
  const Vector3 middle = 0.5 * (low + high);
  // Of two layers neither lies in the third between them.
  const Vector3 half = ((high - low) / 6).cwiseMax(1.1 * radius);
  Region core;
  core.minimum = middle - half;
  core.maximum = middle + half;
  if (std::none_of(places.begin(), places.end(), [&](const Vector3& place) { return core.contains(place); }))
    return std::nullopt;
  return core;
}

}  // namespace

EditActions::EditActions(Session& session, Selection& selection, Outliner& outliner, Inspector& inspector,
                         const Actions& actions, Notices& notices)
    : m_session(session),
      m_document(session.document()),
      m_selection(selection),
      m_outliner(outliner),
      m_inspector(inspector),
      m_actions(actions),
      m_notices(notices) {}

void EditActions::makeMenu(QMenu* menu) {
  menu->addAction(m_actions.find(QStringLiteral("edit.undo")));
  menu->addAction(m_actions.find(QStringLiteral("edit.redo")));
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("edit.rename"), QStringLiteral("Rename"), {QKeySequence(QStringLiteral("F2"))},
                [this] { m_outliner.renameSelected(); });
  m_actions.add(menu, QStringLiteral("edit.visible"), QStringLiteral("Show or hide"), {},
                [this] { m_outliner.toggleVisible(); });
  m_actions.add(menu, QStringLiteral("edit.locked"), QStringLiteral("Lock or unlock"), {},
                [this] { m_outliner.toggleLocked(); });
  makeProbeEntries(menu);
  m_actions.add(menu, QStringLiteral("edit.key"), QStringLiteral("Set or remove a key"), {QKeySequence(Qt::Key_K)},
                [this] {
                  if (ParameterRow* row = orRefused(m_inspector.rowAtHand(), QStringLiteral("No key was set.")))
                    row->toggleKey();
                });
  addRowCommands();
  menu->addSeparator();
  menu->addAction(m_actions.find(QStringLiteral("edit.search")));
}

void EditActions::makeProbeEntries(QMenu* menu) {
  QAction* probe =
      m_actions.add(menu, QStringLiteral("edit.probe"), QStringLiteral("Add probe"), {}, [this] { addProbe(false); });
  probe->setToolTip(
      QStringLiteral("Measures the temperature in the middle of the body that is selected, of all of it where that is "
                     "empty, or of all matter; its rows have its box and other quantities. Of a wall that has a "
                     "temperature it plots that."));
  QAction* all = m_actions.add(menu, QStringLiteral("edit.probeAll"), QStringLiteral("Add probe of all of it"), {},
                               [this] { addProbe(true); });
  all->setToolTip(QStringLiteral("Of the whole body or tap that is selected, or of all matter."));
}

ParameterRow* EditActions::orRefused(ParameterRow* row, const QString& refusal) {
  m_notices.refuse(refusal, row ? QString() : QStringLiteral("Point at the row of a parameter."));
  return row;
}

/// What the menu of a row has, for Ctrl+K: no menu of the window has rows. Those of the brush have one, too.
void EditActions::addRowCommands() {
  const auto lower = [](const char* text) {
    const QString whole = QString::fromUtf8(text);
    return whole.left(1).toLower() + whole.mid(1);
  };
  for (const NamedRowCommand& each : rowCommands()) {
    QString title = QStringLiteral("Row: ");
    if (*each.menu) title += lower(each.menu) + QStringLiteral(": ");
    m_actions.add(nullptr, QStringLiteral("edit.row.") + QLatin1String(each.name), title + lower(each.text), {},
                  [this, command = each.command] { performAtHand(command); });
  }
}

void EditActions::performAtHand(RowCommand command) {
  const QString refusal = QStringLiteral("Nothing was done.");
  ParameterRow* row = orRefused(rowAtHand(m_actions.window().findChildren<ParameterPanel*>()), refusal);
  if (!row) return;
  const QString why = whyNot(*row, command);
  m_notices.refuse(refusal, why);
  if (why.isEmpty()) perform(*row, command, row->mapToGlobal(row->labelRect().bottomLeft()));
}

void EditActions::makeWallMenu(QMenu* menu) {
  const auto add = [&](const QString& id, const char* whole, const QString& name, const Actions::Act& act) {
    sayInMenu(*m_actions.add(menu, id, QString::fromLatin1(whole).arg(name.toLower()), {}, act), name);
  };
  for (const WallSide& side : kWallSides)
    add(QStringLiteral("sketch.wall.") + QString::fromLatin1(side.id), "Add wall: %1", QString::fromLatin1(side.name),
        [this, side] { addWalls({side.id}); });
  menu->addSeparator();
  for (const WallForm form : {WallForm::Cylinder, WallForm::Sphere}) {
    const QString shape = QString::fromStdString(shapeOf(form));
    add(QStringLiteral("sketch.wall.") + shape, "Add wall: %1", shape, [this, form] { addRoundWall(form); });
  }
  menu->addSeparator();
  add(QStringLiteral("sketch.walls"), "Add walls: %1", QStringLiteral("All four sides"),
      [this] { addWalls(kUprightSides); });
}

void EditActions::openItemMenu(const QPoint& global) const {
  auto* menu = new QMenu(&m_actions.window());
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [&](const char* name) { menu->addAction(m_actions.find(QString::fromLatin1(name))); };
  const bool body = !m_selection.body().empty(), placed = body || m_selection.port();
  const OutlineKind kind = m_selection.kind();
  if (placed || kind == OutlineKind::Probe || kind == OutlineKind::Wall || kind == OutlineKind::Pin) {
    if (kind != OutlineKind::Pin) {
      add("edit.rename");
      add("edit.visible");
      add("edit.locked");
    }
    if (body) {
      add("edit.isolate");
      add("edit.pin");
    }
    if (placed) add("view.frame");
    menu->addSeparator();
    for (const char* name : {"edit.cut", "edit.copy", "edit.paste", "edit.duplicate", "edit.delete"}) add(name);
    if (const Body* sketch = body ? m_document.body(m_selection.body()) : nullptr;
        sketch && std::holds_alternative<VoxelShape>(sketch->shape))
      add("sketch.separate");
    menu->addSeparator();
    if (kind != OutlineKind::Probe && kind != OutlineKind::Pin) {
      add("edit.group");
      add("edit.ungroup");
      menu->addSeparator();
    }
  }
  add("edit.probe");
  if (placed) add("edit.probeAll");
  menu->popup(global);
}

/// Of the body or tap that is selected, or of all matter; what it measures is chosen in its rows. What most probes are
/// for is how warm a body is inside: of one it begins in its middle.
void EditActions::addProbe(bool whole) {
  if (!whole && plotWall()) return;
  Probe probe;
  probe.quantity = "temperature";
  const auto port = m_selection.port();
  probe.body = port && !port->sink ? port->id : m_selection.body();
  if (!probe.body.empty()) {
    const Owner owner = port ? Owner::Emitter : Owner::Body;
    probe.name = ownerLabel(m_document.project(), {owner, probe.body, ""}).toStdString();
    const SnapshotPtr shown = m_session.snapshot();
    if (!whole && !port) probe.region = coreOf(shown.get(), probe.body);
    if (probe.region) probe.name += ", core";
    // Where this matter stood at the start, which the box would mean, nobody knows later.
    if (probe.region && shown->stats.time > 0) probe.regionWhen = Probe::kNow;
  }
  m_selection.select(OutlineKind::Probe, m_document.addProbe(std::move(probe)));
}

/// A wall holds no matter that a probe would see: its temperature is its own parameter. It comes beside other curves of
/// temperature.
bool EditActions::plotWall() {
  const Address address{Owner::Wall, m_selection.id(), "temperature"};
  const Project& project = m_document.project();
  if (m_selection.kind() != OutlineKind::Wall || !m_document.declaration(address)) return false;
  if (!idleReason(project, m_document.plugins(), address).empty()) return false;
  const std::string source = parameterSource(address);
  const auto known = [&](const std::string& name) {
    return GraphSource(name, project, m_session.fields(), m_document.plugins());
  };
  std::string beside;
  bool plotted = false;
  for (const Graph& graph : m_document.graphs()) {
    if (graph.kind != Graph::Kind::Time) continue;
    for (const std::string& name : graph.series) {
      plotted = plotted || name == source;
      if (beside.empty() && known(name).unit() == known(source).unit()) beside = graph.id;
    }
  }
  m_notices.refuse(QStringLiteral("Nothing was added."),
                   plotted ? QStringLiteral("The temperature of this wall is plotted already.") : QString());
  if (!plotted) m_document.plot(beside, source);
  return true;
}

void EditActions::addRoundWall(WallForm form) {
  Project things;
  things.environment.walls = {roundWall(form, m_document.project())};
  const QString title = QStringLiteral("adding %1").arg(nameOf(things.environment.walls[0]));
  m_selection.select(OutlineKind::Wall, m_document.insertThings(std::move(things), title).walls.front().id);
}

void EditActions::addWalls(const std::vector<std::string>& sides) {
  const QString problem = m_document.addWalls(sides);
  m_notices.refuse(QStringLiteral("No wall was added."), problem);
  if (problem.isEmpty()) m_selection.select(OutlineKind::Wall, m_document.project().environment.walls.back().id);
}

}  // namespace ps
