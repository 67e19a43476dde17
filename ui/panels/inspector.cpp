// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/inspector.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/graphsource.h"
#include "core/simulation/rules.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/keptrows.h"
#include "ui/panels/rowmodels.h"
#include "ui/panels/wayout.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/units.h"

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

void append(std::vector<RowModel>& rows, std::vector<RowModel> more) {
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Not so what is kept of a plugin that is missing.
bool isDeclared(const Document& document, const QString& key) {
  const auto address = Address::parse(key.toStdString());
  return address && document.declaration(*address);
}

}  // namespace

Inspector::Inspector(Session& session, Selection& selection, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_document(session.document()),
      m_selection(selection),
      m_body(new ParameterPanel),
      m_material(new ParameterPanel),
      m_scene(new ParameterPanel),
      m_solver(new ParameterPanel),
      m_notes(m_document, panels()) {
  for (ParameterPanel* panel : panels()) connectPanel(panel);
  m_body->setEmptyText(QStringLiteral("Select something, or press Ctrl+K"));
  m_material->setEmptyText(QStringLiteral("Select something, or press Ctrl+K"));
  connect(&m_document, &Document::changed, this, &Inspector::onChanged);
  connect(&session, &Session::totalsDue, this, [this] {
    if (const SnapshotPtr snapshot = m_session.snapshot()) setSnapshot(*snapshot);
  });
  connect(&session, &Session::valuesDue, this, [this] {
    if (now() != m_shownAt) showTracks();
  });
  connect(&session, &Session::happened, this, [this](const EngineEvent& event) {
    m_notes.setNothingWaits(m_session.appliesAtOnce());
    m_notes.hear(event);
  });
  connect(&session.swatches(), &Swatches::arrived, m_material, &ParameterPanel::updateHeader);
  connect(&selection, &Selection::changed, this, &Inspector::showSelected);
  connect(&selection, &Selection::materialChanged, this, [this, &selection] { setMaterials(selection.materials()); });
  if (!session.isReady()) return;
  onChanged(ProjectOpened{});  // made later than the project came
  showSelected();
  setMaterials(selection.materials());
}

void Inspector::connectPanel(ParameterPanel* panel) {
  connect(panel, &ParameterPanel::edited, this,
          [this, panel](const QString& key, const Value& value, Edit edit) { onEdited(key, value, edit, panel); });
  connect(panel, &ParameterPanel::scaled, this,
          [this, panel](const QString& key, double factor, double added) { onScaled(key, factor, added, panel); });
  connect(panel, &ParameterPanel::resetAsked, this, [this, panel](const QString& key) { onReset(key, panel); });
  connect(panel, &ParameterPanel::takenBack, &m_document, &Document::takeGestureBack);
  connect(panel, &ParameterPanel::linkActivated, this, &Inspector::onLink);
  connect(panel, &ParameterPanel::pinToggled, this, [this](const QString& key, bool pinned) {
    if (!pinned || isDeclared(m_document, key)) m_document.setPinned(key.toStdString(), pinned);
  });
  connect(panel, &ParameterPanel::plotRequested, this, [this](const QString& key) {
    const auto address = Address::parse(key.toStdString());
    if (!address || !isDeclared(m_document, key)) return;
    // Of a probe what it measures is meant.
    m_document.plot({}, address->owner == Owner::Probe ? probeSource(address->id) : parameterSource(*address));
  });
  connect(panel, &ParameterPanel::curveRequested, this, [this](const QString& key) {
    if (const auto address = Address::parse(key.toStdString())) Q_EMIT curveWanted(*address);
  });
  connect(panel, &ParameterPanel::keyToggled, this, &Inspector::onKey);
  connect(panel, &ParameterPanel::wayChosen, this, &Inspector::onWay);
  connect(panel, &ParameterPanel::keysRemoved, this, [this](const QString& key) {
    if (const auto address = Address::parse(key.toStdString())) m_document.removeTrack(*address);
  });
}

const char* Inspector::keep(const QString& text) { return m_texts.insert(text.toStdString()).first->c_str(); }

void Inspector::onEdited(const QString& key, const Value& value, Edit edit, const ParameterPanel* panel) {
  const auto address = Address::parse(key.toStdString());
  if (!address) return;
  if (edit == Edit::Begin) {
    m_editedAt = now();
    m_editedFrom.clear();
    for (const Address& one : addressesOf(*address, panel)) m_editedFrom.emplace_back(one, m_document.value(one));
    m_document.beginGesture();
    return;
  }
  if (edit == Edit::End) {
    // Every value has come as Live; an undo may have happened since, so that the row asks what holds now.
    m_document.endGesture();
    m_editedAt.reset();
    m_editedFrom.clear();
    for (ParameterPanel* each : panels()) each->setValue(key, m_session.valueNow(*address));
    refreshMixed(*address);
    return;
  }
  showProblem(key, setAll(addressesOf(*address, panel), value));
}

/// Links of notes say what they set: "solver/substeps=8"; or that the scene is to be reset.
void Inspector::onLink(const QString&, const QString& link) {
  if (wayout::isWayOut(link)) return Q_EMIT wayOutWanted(link);
  if (link == QLatin1String(RowNotes::kReset)) {
    m_session.reset();
    return;
  }
  const qsizetype equals = link.indexOf(QLatin1Char('='));
  const auto address = Address::parse(link.left(equals).toStdString());
  if (equals <= 0 || !address) return;
  if (const auto number = parseNumber(link.mid(equals + 1)))
    m_document.setParameter(*address, *number);
  else
    m_document.setParameter(*address, link.mid(equals + 1).toStdString());  // one of several choices
}

void Inspector::addRows(std::vector<RowModel>& rows, Address any, api::ParameterList list, const QString& group,
                        const ParameterSet& defaults) {
  if (list.count == 0) return;
  any.key = list[0].key;
  const ParameterSet* set = findSet(m_document.project(), any);
  if (!set) return;
  for (RowModel& row : rowModels(list, *set, defaults, QString::fromStdString(any.prefix()))) {
    if (!group.isEmpty()) row.declaration.group = keep(group);
    any.key = row.declaration.key;
    row.choiceLabels = choiceLabels(m_document.project(), m_document.plugins(), any, row.declaration);
    addRules(row, m_document, any);
    rows.push_back(std::move(row));
  }
}

void Inspector::addPinned(std::vector<RowModel>& rows) {
  std::vector<RowModel> pinned;
  const Project& project = m_document.project();
  for (const std::string& text : project.view.pinned) {
    const auto address = Address::parse(text);
    std::optional<RowModel> row = address ? rowModelOf(m_document, *address) : std::nullopt;
    if (!row) continue;
    QString label = awayLabel(project, *address, QString::fromUtf8(row->declaration.label));
    // Of another material than the panel's: its name tells the two apart. It may be long and stands last.
    if (address->owner == Owner::Material && address->id != material())
      label += QStringLiteral(" · ") + ownerLabel(project, *address);
    row->declaration.label = keep(label);
    row->pinned = true;
    pinned.push_back(std::move(*row));
  }
  rows.insert(rows.begin(), std::make_move_iterator(pinned.begin()), std::make_move_iterator(pinned.end()));
}

void Inspector::rebuildBody() {
  if (rebuildThings()) return;
  const Body* body = m_bodies.empty() ? nullptr : m_document.body(m_bodies.back().id);
  std::vector<RowModel> rows;
  if (!body) {
    m_body->setHeader({}, {});
    m_body->setModel({});
    return;
  }
  constexpr const char* kShapes[] = {"block", "sketched"};
  const auto* solid = std::get_if<SolidShape>(&body->shape);
  const std::string shape =
      solid ? choiceOf(solid->parameters, solidParameters(), "kind") : kShapes[body->shape.index()];
  QString matter = QString::fromStdString(body->material);
  for (const SceneMaterial& material : m_document.project().materials) {
    if (material.id == body->material && !material.label.empty()) matter = QString::fromStdString(material.label);
  }
  if (!showCount())
    m_body->setHeader(nameOf(*body), matter + QStringLiteral(" · ") + QString::fromStdString(shape), countOfBodies());
  if (auto material = rowModelOf(m_document, {Owner::Body, body->id, kBodyMaterialKey}))
    rows.push_back(std::move(*material));
  if (solid) {
    addRows(rows, {Owner::Shape, body->id, ""}, solidParameters());
    // A rope's many rows are of no use to others.
    if (SolidForm(*solid).kind() != SolidForm::Kind::Rope)
      std::erase_if(rows, [](const RowModel& row) { return std::string_view(row.declaration.group) == "Points"; });
  }
  addRows(rows, {Owner::Body, body->id, ""}, bodyParameters());
  const api::ParameterList motion = bodyMotionParameters();
  for (size_t i = 0; i < motion.count; ++i) {
    if (auto row = rowModelOf(m_document, {Owner::Body, body->id, motion[i].key})) rows.push_back(std::move(*row));
  }
  if (auto structure = rowModelOf(m_document, {Owner::Body, body->id, kStructureKey}))
    rows.push_back(std::move(*structure));
  const api::ParameterList declared =
      declarationsOf(m_document.project(), m_document.plugins(), {Owner::Body, body->id, ""});
  for (size_t i = 0; i < declared.count; ++i) {
    if (pluginBehind(declared[i].key, kNeighbourKey).empty()) continue;
    if (auto row = rowModelOf(m_document, {Owner::Body, body->id, declared[i].key})) rows.push_back(std::move(*row));
  }
  for (const BodyConstraint& constraint : body->constraints) {
    const Address any{Owner::Constraint, body->id, "", constraint.plugin};
    const api::ConstraintPlugin* plugin =
        m_document.plugins() ? m_document.plugins()->constraint(constraint.plugin) : nullptr;
    if (plugin)
      addRows(rows, any, m_document.plugins()->parameters(constraint.plugin), QString::fromUtf8(plugin->label()));
    else if (m_document.plugins())
      append(rows, keptRows(constraint.parameters, constraint.unknown, "", any, constraint.plugin));
  }
  shareRows(rows, shown());
  m_body->setModel(std::move(rows));
  m_notes.show();
  showTracks();
}

double Inspector::ambientTemperature() const {
  return numberOf(m_document.project().environment.parameters, environmentParameters(), "ambient_temperature");
}

void Inspector::rebuildScene() {
  const Project& project = m_document.project();
  std::vector<RowModel> rows;
  if (auto gravity = rowModelOf(m_document, {Owner::Scene, "", "gravity"})) rows.push_back(std::move(*gravity));
  addRows(rows, {Owner::Environment, "", ""}, environmentParameters());
  const auto named = [&](Owner owner, const auto& items, api::ParameterList list) {
    for (const auto& item : items) addRows(rows, {owner, item.id, ""}, list, nameOf(item));
  };
  named(Owner::Emitter, project.emitters, emitterParameters());
  named(Owner::Sink, project.sinks, sinkParameters());
  named(Owner::Wall, project.environment.walls, wallParameters());
  showSceneHeader();
  m_scene->setModel(std::move(rows));
  m_notes.show();
  showTracks();
}

void Inspector::showSceneHeader() {
  const Project& project = m_document.project();
  m_scene->setHeader(m_document.title(),
                     countText(project.bodies.size(), QStringLiteral("body"), QStringLiteral("bodies")) +
                         QStringLiteral(", ") +
                         countText(project.environment.walls.size(), QStringLiteral("wall"), QStringLiteral("walls")));
}

void Inspector::rebuildSolver() {
  std::vector<RowModel> rows;
  if (auto choice = rowModelOf(m_document, {Owner::Scene, "", "thermal_model"})) rows.push_back(std::move(*choice));
  addRows(rows, {Owner::Solver, "", ""}, solverParameters());
  const SolverOptions& solver = m_document.project().solver;
  const std::string& id = solver.thermalModel;
  const api::ThermalPlugin* model = m_document.plugins() ? m_document.plugins()->thermal(id) : nullptr;
  if (model)
    addRows(rows, {Owner::Thermal, "", ""}, m_document.plugins()->parameters(id), QString::fromUtf8(model->label()));
  else if (m_document.plugins() && !id.empty())
    append(rows, keptRows(solver.thermalParameters, solver.unknown, "thermal", {Owner::Thermal, "", ""}, id));
  const api::ParameterList scene = declarationsOf(m_document.project(), m_document.plugins(), {Owner::Scene, "", ""});
  for (size_t i = 0; i < scene.count; ++i) {
    const std::string source = pluginBehind(scene[i].key, kHeatSourceKey);
    if (source.empty()) continue;
    if (auto row = rowModelOf(m_document, {Owner::Scene, "", scene[i].key})) rows.push_back(std::move(*row));
    addRows(rows, {Owner::HeatSource, source, ""}, m_document.plugins()->parameters(source),
            QString::fromUtf8(scene[i].label));
  }
  for (const UsedHeatSource& source : solver.heatSources) {
    if (m_document.plugins() && !m_document.plugins()->heatSource(source.plugin))
      append(rows,
             keptRows(source.parameters, source.unknown, "", {Owner::HeatSource, source.plugin, ""}, source.plugin));
  }
  m_solver->setHeader(QStringLiteral("Solver"), model ? QStringLiteral("Heat by ") + QString::fromUtf8(model->label())
                                                      : QStringLiteral("No heat"));
  m_solver->setModel(std::move(rows));
  m_notes.show();
  showTracks();
}

void Inspector::rebuild() {
  rebuildBody();
  rebuildMaterial();
  rebuildScene();
  rebuildSolver();
}

/// Rows that are pinned offer to be taken out of "Try these", in whichever panel they stand.
void Inspector::markPinned() {
  QStringList keys;
  for (const std::string& key : m_document.project().view.pinned) keys << QString::fromStdString(key);
  for (ParameterPanel* panel : panels()) panel->setPinned(keys);
}

/// Rows that may have come to act or ceased to.
void Inspector::refreshIdle(const Address& changed) {
  for (ParameterPanel* panel : panels()) {
    for (ParameterRow* row : panel->rows()) {
      const auto own = Address::parse(row->key().toStdString());
      if (own && mayEnable(row->model().declaration, *own, changed)) row->setDisabledReason(idleText(m_document, *own));
    }
  }
}

void Inspector::note(const ParameterChanged& change) {
  // The panels may not have heard of the last reset yet: what is set from now on waits for another one.
  if (const SnapshotPtr snapshot = m_session.snapshot()) m_notes.setRun(snapshot->revision);
  m_notes.setNothingWaits(m_session.appliesAtOnce());
  m_notes.onChanged(change);
}

void Inspector::onChanged(const ChangeEvent& event) {
  if (const auto* parameter = std::get_if<ParameterChanged>(&event)) {
    const Address& address = parameter->address;
    const QString key = QString::fromStdString(address.text());
    for (ParameterPanel* panel : panels()) panel->setValue(key, m_document.value(address));
    if (address.owner == Owner::Scene && address.key == "thermal_model") rebuildSolver();
    refreshMixed(address);
    if (address.owner == Owner::Shape && address.key == "kind") rebuildBody();
    if (address.owner == Owner::Shape && address.key.starts_with("rotation_")) showEdges(address.id);
    refreshIdle(address);
    if (address.owner == Owner::Shape || address.owner == Owner::Solver) countSoon();
    note(*parameter);
    if (address.owner == Owner::Material && propertyIndex(address.key) < 0) refreshProperties(address.id);
    if (address.owner == Owner::Material && address.id == material()) showMaterialHeader();
  } else if (std::holds_alternative<ProjectOpened>(event)) {
    m_things.clear();
    m_bodies.clear();
    if (!m_document.project().bodies.empty())
      m_bodies.push_back({Owner::Body, m_document.project().bodies.front().id, ""});
    m_materials.clear();
    m_notes.clear();
    m_mean.clear();
    m_sceneMean = ambientTemperature();  // what was measured belongs to the project before
    markPinned();
    rebuild();
  } else if (const auto* body = std::get_if<BodyChanged>(&event); body && body->move) {
    showPlace(body->id);
    countSoon();
  } else if (std::holds_alternative<BodyChanged>(event) || std::holds_alternative<StrokeChanged>(event)) {
    rebuildBody();
    if (const auto* changed = std::get_if<BodyChanged>(&event)) {
      for (const ParameterChanged& part : changed->composition) note(part);
    }
    showSceneHeader();
    showMaterialHeader();
  } else if (const auto* probe = std::get_if<ProbesChanged>(&event)) {
    onProbe(probe->id);
  } else if (const auto* port = std::get_if<PortChanged>(&event)) {
    if (!port->moved) rebuildScene();
    if (!port->moved && !m_things.empty()) rebuildBody();
    showMaterialHeader();
  } else if (const auto* walls = std::get_if<WallsChanged>(&event)) {
    if (walls->moved) return;
    rebuildScene();
    if (!m_things.empty()) rebuildBody();
    rebuildMaterial();  // one of its rows may be pinned
  } else if (std::holds_alternative<MaterialsChanged>(event)) {
    rebuildMaterial();
    rebuildBody();  // what it is made of may be called something else
  } else if (std::holds_alternative<TracksChanged>(event)) {
    showTracks();
  } else if (std::holds_alternative<PinsChanged>(event)) {
    markPinned();
    rebuildMaterial();
  } else if (std::holds_alternative<FileChanged>(event) || std::holds_alternative<AboutChanged>(event)) {
    showSceneHeader();  // the project is called after both
  }
}

void Inspector::setSnapshot(const Snapshot& snapshot) {
  showTemperatures(snapshot);
  m_notes.setNothingWaits(m_session.appliesAtOnce());
  m_notes.setSnapshot(snapshot);
}

}  // namespace ps
