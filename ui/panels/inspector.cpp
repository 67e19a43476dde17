// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/inspector.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"

#include <algorithm>

namespace ps {
namespace {

constexpr qint64 kReadInterval = 200;  // ms between two readings: means go through all particles

/// Which kinds of heat at a wall a row of it belongs to.
struct WallRow {
  const char* key;
  std::initializer_list<const char*> heats;
  const char* first;  ///< what to do for it to act
};
const WallRow kWallRows[] = {
    {"temperature", {"fixed_temperature", "convective"}, "Set its heat to a fixed temperature or to convective first."},
    {"heat_flux", {"fixed_flux"}, "Set its heat to a fixed flux first."},
    {"convection", {"convective"}, "Set its heat to convective first."},
    {"emissivity", {"fixed_temperature", "convective"}, "Set its heat to a fixed temperature or to convective first."},
    {"film_coefficient", {"fixed_temperature"}, "Set its heat to a fixed temperature first."},
};

QString whyWallIdle(const Project& project, const Address& address) {
  const ParameterSet* set = findSet(project, address);
  if (!set) return {};
  const std::string heat = choiceOf(*set, wallParameters(), "heat");
  for (const WallRow& row : kWallRows) {
    if (address.key != row.key || std::find(row.heats.begin(), row.heats.end(), heat) != row.heats.end()) continue;
    const char* now = heat == "adiabatic"           ? "The wall lets no heat through. "
                      : heat == "fixed_temperature" ? "The wall is held at a temperature. "
                      : heat == "fixed_flux"        ? "The wall gives a fixed flux of heat. "
                                                    : "A fluid behind the wall gives and takes its heat. ";
    return QString::fromUtf8(now) + QString::fromUtf8(row.first);
  }
  return {};
}

/// "" or why a value of this address does nothing as the scene is.
QString whyIdle(const Project& project, const Address& address) {
  if (address.owner == Owner::Body && address.key.starts_with("motion_")) {
    const ParameterSet* set = findSet(project, address);
    if (!set || toggleOf(*set, bodyParameters(), "fixed")) return {};
    return QStringLiteral("Only a body that is held in place moves by itself. Hold it in place first.");
  }
  if (address.owner == Owner::Environment && address.key == "surroundings_temperature") {
    if (toggleOf(project.environment.parameters, environmentParameters(), "radiation")) return {};
    return QStringLiteral("Nothing radiates heat here. Switch heat radiation on first.");
  }
  return address.owner == Owner::Wall ? whyWallIdle(project, address) : QString();
}

/// The material that a row belongs to; "" for other rows.
std::string materialOf(const QString& key) {
  const auto address = Address::parse(key.toStdString());
  return address && address->owner == Owner::Material ? address->id : std::string();
}

QString sourceText(const Provenance& provenance) {
  const char* grade = provenance.grade == 'A'   ? "reference data, grade A"
                      : provenance.grade == 'B' ? "handbook data, grade B"
                                                : "typical value, grade C";
  const QString from = QString::fromStdString(provenance.source);
  return (from.isEmpty() ? from : from + QStringLiteral("; ")) + QLatin1String(grade);
}

QString gradeText(const PluginRegistry* plugins, const std::string& base) {
  const Material* material = plugins ? plugins->material(base) : nullptr;
  if (!material || material->provenance.empty()) return {};
  char worst = 'A';
  for (const auto& [key, provenance] : material->provenance) worst = std::max(worst, provenance.grade);
  if (worst == 'A') return QStringLiteral("Reference data, grade A");
  return worst == 'B' ? QStringLiteral("Handbook data, grade B")
                      : QStringLiteral("Reference, handbook and typical data");
}

}  // namespace

Inspector::Inspector(Session& session, Selection& selection, QObject* parent)
    : QObject(parent),
      m_session(session),
      m_document(session.document()),
      m_body(new ParameterPanel),
      m_material(new ParameterPanel),
      m_scene(new ParameterPanel),
      m_solver(new ParameterPanel) {
  for (ParameterPanel* panel : panels()) connectPanel(panel);
  m_body->setEmptyText(QStringLiteral("Select something, or press Ctrl+K"));
  m_material->setEmptyText(QStringLiteral("Select something, or press Ctrl+K"));
  connect(&m_document, &Document::changed, this, &Inspector::onChanged);
  connect(&session, &Session::valuesDue, this, [this] {
    const SnapshotPtr snapshot = m_session.snapshot();
    if (!snapshot || (m_sinceRead.isValid() && m_sinceRead.elapsed() < kReadInterval)) return;
    m_sinceRead.start();
    setSnapshot(*snapshot);
  });
  connect(&selection, &Selection::changed, this, [this, &selection] {
    if (!selection.empty()) setBody(selection.body());
  });
  connect(&selection, &Selection::materialChanged, this, [this, &selection] { setMaterial(selection.material()); });
}

void Inspector::connectPanel(ParameterPanel* panel) {
  connect(panel, &ParameterPanel::edited, this, &Inspector::onEdited);
  connect(panel, &ParameterPanel::scaled, this, &Inspector::onScaled);
  connect(panel, &ParameterPanel::linkActivated, this, &Inspector::onLink);
  connect(panel, &ParameterPanel::pinToggled, this,
          [this](const QString& key, bool pinned) { m_document.setPinned(key.toStdString(), pinned); });
}

const char* Inspector::keep(const QString& text) { return m_texts.insert(text.toStdString()).first->c_str(); }

void Inspector::onEdited(const QString& key, const Value& value, Edit edit) {
  const auto address = Address::parse(key.toStdString());
  if (!address) return;
  if (edit == Edit::Begin) {
    m_document.beginGesture();
    return;
  }
  if (edit == Edit::End) {
    // Every value has come as Live; an undo may have happened since, so that the row asks what holds now.
    m_document.endGesture();
    for (ParameterPanel* panel : panels()) panel->setValue(key, m_document.value(*address));
    return;
  }
  const QString problem = m_document.setParameter(*address, value);
  for (ParameterPanel* panel : panels()) panel->setError(key, problem);
}

void Inspector::onScaled(const QString& key, double factor) {
  const auto address = Address::parse(key.toStdString());
  const api::ParameterDeclaration* declaration = address ? m_document.declaration(*address) : nullptr;
  const Value value = address ? m_document.value(*address) : Value(0.0);
  if (!declaration || !std::holds_alternative<double>(value)) return;
  m_document.setParameter(*address, scaledValue(*declaration, std::get<double>(value), factor));
}

/// Links of notes say what they set: "solver/substeps=8".
void Inspector::onLink(const QString&, const QString& link) {
  const qsizetype equals = link.indexOf(QLatin1Char('='));
  const auto address = Address::parse(link.left(equals).toStdString());
  const auto number = parseNumber(link.mid(equals + 1));
  if (equals > 0 && address && number) m_document.setParameter(*address, *number);
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
    row.disabledReason = whyIdle(m_document.project(), any);
    rows.push_back(std::move(row));
  }
}

/// The row of one address; nothing where it has no declaration or no owner.
std::optional<RowModel> Inspector::rowOf(const Address& address) const {
  const api::ParameterDeclaration* declaration = m_document.declaration(address);
  if (!declaration || (address.owner != Owner::Scene && !findSet(m_document.project(), address))) return std::nullopt;
  RowModel row;
  row.key = QString::fromStdString(address.text());
  row.declaration = *declaration;
  row.value = m_document.value(address);
  row.defaultValue = m_document.defaultValue(address);
  row.disabledReason = whyIdle(m_document.project(), address);
  row.choiceLabels = choiceLabels(m_document.project(), m_document.plugins(), address, row.declaration);
  return row;
}

void Inspector::addPinned(std::vector<RowModel>& rows) {
  std::vector<RowModel> pinned;
  const Project& project = m_document.project();
  for (const std::string& text : project.view.pinned) {
    const auto address = Address::parse(text);
    std::optional<RowModel> row = address ? rowOf(*address) : std::nullopt;
    if (!row) continue;
    QString label = awayLabel(project, *address, QString::fromUtf8(row->declaration.label));
    // Of another material than the panel's: its name tells the two apart. It may be long and stands last.
    if (address->owner == Owner::Material && address->id != m_materialId)
      label += QStringLiteral(" · ") + ownerLabel(project, *address);
    row->declaration.label = keep(label);
    row->pinned = true;
    pinned.push_back(std::move(*row));
  }
  rows.insert(rows.begin(), std::make_move_iterator(pinned.begin()), std::make_move_iterator(pinned.end()));
}

void Inspector::rebuildBody() {
  const Body* body = m_document.body(m_bodyId);
  std::vector<RowModel> rows;
  if (!body) {
    m_body->setHeader({}, {});
    m_body->setModel({});
    return;
  }
  const bool sketched = std::holds_alternative<VoxelShape>(body->shape);
  QString matter = QString::fromStdString(body->material);
  for (const SceneMaterial& material : m_document.project().materials) {
    if (material.id == body->material && !material.label.empty()) matter = QString::fromStdString(material.label);
  }
  m_body->setHeader(QString::fromStdString(body->name),
                    matter + (sketched ? QStringLiteral(" · sketched") : QStringLiteral(" · block")));
  if (auto material = rowOf({Owner::Body, body->id, kBodyMaterialKey})) rows.push_back(std::move(*material));
  addRows(rows, {Owner::Body, body->id, ""}, bodyParameters());
  const api::ParameterList motion = bodyMotionParameters();
  for (size_t i = 0; i < motion.count; ++i) {
    if (auto row = rowOf({Owner::Body, body->id, motion[i].key})) rows.push_back(std::move(*row));
  }
  if (auto structure = rowOf({Owner::Body, body->id, kStructureKey})) rows.push_back(std::move(*structure));
  const api::ParameterList declared =
      declarationsOf(m_document.project(), m_document.plugins(), {Owner::Body, body->id, ""});
  for (size_t i = 0; i < declared.count; ++i) {
    if (pluginBehind(declared[i].key, kNeighbourKey).empty()) continue;
    if (auto row = rowOf({Owner::Body, body->id, declared[i].key})) rows.push_back(std::move(*row));
  }
  for (const BodyConstraint& constraint : body->constraints) {
    const Address any{Owner::Constraint, body->id, "", constraint.plugin};
    const api::ConstraintPlugin* plugin =
        m_document.plugins() ? m_document.plugins()->constraint(constraint.plugin) : nullptr;
    if (plugin)
      addRows(rows, any, m_document.plugins()->parameters(constraint.plugin), QString::fromUtf8(plugin->label()));
  }
  m_body->setModel(std::move(rows));
  showLimits();
}

void Inspector::rebuildMaterial() {
  const Project& project = m_document.project();
  const auto found = std::find_if(project.materials.begin(), project.materials.end(),
                                  [&](const SceneMaterial& m) { return m.id == m_materialId; });
  const auto material =
      found == project.materials.end() && !project.materials.empty() ? project.materials.begin() : found;
  std::vector<RowModel> rows;
  if (material == project.materials.end()) {
    m_material->setHeader({}, {});
    m_material->setModel({});
    return;
  }
  m_materialId = material->id;
  const PluginRegistry* plugins = m_document.plugins();
  const bool missing = plugins && !plugins->material(material->base);
  showMaterialHeader();
  const Address any{Owner::Material, material->id, ""};
  addRows(rows, any, propertyCatalogue(), {}, materialDefaults(project, plugins, material->id));
  if (const api::MaterialPlugin* plugin = plugins ? plugins->materialPlugin(material->base) : nullptr) {
    addRows(rows, any, plugins->parameters(material->base), QString::fromUtf8(plugin->label()));
  }
  for (const SceneMaterial& other : project.materials) {
    if (auto row = rowOf({Owner::Material, material->id, kAdheresKey + other.id})) rows.push_back(std::move(*row));
  }
  addPinned(rows);
  if (missing) {
    const QString own = QStringLiteral("material/%1/").arg(QString::fromStdString(material->id));
    for (RowModel& row : rows) {
      if (!row.key.startsWith(own)) continue;
      row.disabledReason =
          QStringLiteral("The material's plugin is not installed. Values are kept as they stand in the file.");
    }
  }
  for (RowModel& row : rows) {
    const std::string owner = materialOf(row.key);
    row.temperature = temperatureOf(owner);
    row.source = sourceOf(owner, row.declaration.key);
  }
  m_material->setModel(std::move(rows));
  showLimits();
}

/// Where the installed material's figure comes from; "" where nothing says so.
QString Inspector::sourceOf(const std::string& material, const char* key) const {
  const std::vector<SceneMaterial>& all = m_document.project().materials;
  const auto owner = std::find_if(all.begin(), all.end(), [&](const SceneMaterial& m) { return m.id == material; });
  const PluginRegistry* plugins = m_document.plugins();
  const Material* installed = owner != all.end() && plugins ? plugins->material(owner->base) : nullptr;
  if (!installed) return {};
  const auto from = installed->provenance.find(key);
  return from == installed->provenance.end() ? QString() : sourceText(from->second);
}

void Inspector::showMaterialHeader() {
  const Project& project = m_document.project();
  const auto material = std::find_if(project.materials.begin(), project.materials.end(),
                                     [&](const SceneMaterial& m) { return m.id == m_materialId; });
  if (material == project.materials.end()) return;
  const PluginRegistry* plugins = m_document.plugins();
  const bool missing = plugins && !plugins->material(material->base);
  QStringList bodies;
  for (const Body& body : project.bodies) {
    if (body.material == material->id) bodies << QString::fromStdString(body.name);
  }
  for (const Emitter& emitter : project.emitters) {
    if (emitter.material == material->id) bodies << ownerLabel(project, {Owner::Emitter, emitter.id, "speed"});
  }
  m_grade = gradeText(plugins, material->base);
  m_material->setHeader(QString::fromStdString(material->label.empty() ? material->id : material->label),
                        missing
                            ? QStringLiteral("Plugin “%1” is not installed").arg(QString::fromStdString(material->base))
                            : bodies.join(QStringLiteral(", ")),
                        materialDetail(), colourOf(project, plugins, material->id));
}

QString Inspector::materialDetail() const {
  const QString at = QStringLiteral("At %1 °C").arg(formatFixed(temperatureOf(m_materialId) - 273.15, 1));
  return m_grade.isEmpty() ? at : at + QStringLiteral(" · ") + m_grade;
}

double Inspector::temperatureOf(const std::string& material) const {
  const auto mean = m_mean.find(material);
  return mean == m_mean.end() ? m_sceneMean : mean->second;
}

double Inspector::ambientTemperature() const {
  return numberOf(m_document.project().environment.parameters, environmentParameters(), "ambient_temperature");
}

void Inspector::showTemperatures(const Snapshot& snapshot) {
  // The engine keeps a material that the document has lost until the next reset: places differ, ids do not.
  const std::vector<std::string>& ids = snapshot.materialIds;
  std::vector<double> sums(ids.size()), counts(ids.size());
  for (size_t i = 0; i < snapshot.material.size(); ++i) {
    const size_t material = snapshot.material[i];
    if (material >= sums.size()) continue;  // no snapshot of an engine
    sums[material] += static_cast<double>(snapshot.temperature[i]);
    ++counts[material];
  }
  m_sceneMean = snapshot.stats.temperatureMean > 0 ? snapshot.stats.temperatureMean : ambientTemperature();
  m_mean.clear();
  for (size_t k = 0; k < ids.size(); ++k) {
    if (counts[k] > 0) m_mean[ids[k]] = sums[k] / counts[k];
  }
  for (ParameterRow* row : m_material->rows()) row->setTemperature(temperatureOf(materialOf(row->key())));
  if (!m_materialId.empty()) m_material->setHeaderDetail(materialDetail());
}

void Inspector::rebuildScene() {
  const Project& project = m_document.project();
  std::vector<RowModel> rows;
  if (auto gravity = rowOf({Owner::Scene, "", "gravity"})) rows.push_back(std::move(*gravity));
  addRows(rows, {Owner::Environment, "", ""}, environmentParameters());
  const auto named = [&](Owner owner, const auto& items, api::ParameterList list) {
    for (const auto& item : items)
      addRows(rows, {owner, item.id, ""}, list, QString::fromStdString(item.name.empty() ? item.id : item.name));
  };
  named(Owner::Emitter, project.emitters, emitterParameters());
  named(Owner::Sink, project.sinks, sinkParameters());
  named(Owner::Wall, project.environment.walls, wallParameters());
  showSceneHeader();
  m_scene->setModel(std::move(rows));
  showLimits();
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
  if (auto choice = rowOf({Owner::Scene, "", "thermal_model"})) rows.push_back(std::move(*choice));
  addRows(rows, {Owner::Solver, "", ""}, solverParameters());
  const std::string& id = m_document.project().solver.thermalModel;
  const api::ThermalPlugin* model = m_document.plugins() ? m_document.plugins()->thermal(id) : nullptr;
  if (model)
    addRows(rows, {Owner::Thermal, "", ""}, m_document.plugins()->parameters(id), QString::fromUtf8(model->label()));
  const api::ParameterList scene = declarationsOf(m_document.project(), m_document.plugins(), {Owner::Scene, "", ""});
  for (size_t i = 0; i < scene.count; ++i) {
    const std::string source = pluginBehind(scene[i].key, kHeatSourceKey);
    if (source.empty()) continue;
    if (auto row = rowOf({Owner::Scene, "", scene[i].key})) rows.push_back(std::move(*row));
    addRows(rows, {Owner::HeatSource, source, ""}, m_document.plugins()->parameters(source),
            QString::fromUtf8(scene[i].label));
  }
  m_solver->setHeader(QStringLiteral("Solver"), model ? QStringLiteral("Heat by ") + QString::fromUtf8(model->label())
                                                      : QStringLiteral("No heat"));
  m_solver->setModel(std::move(rows));
  showLimits();
}

void Inspector::rebuild() {
  rebuildBody();
  rebuildMaterial();
  rebuildScene();
  rebuildSolver();
}

void Inspector::setBody(const std::string& id) {
  m_bodyId = id;
  rebuildBody();
}

void Inspector::setMaterial(const std::string& id) {
  if (id == m_materialId) return;
  m_materialId = id;
  rebuildMaterial();
}

/// Rows that are pinned offer to be taken out of "Try these", in whichever panel they stand.
void Inspector::markPinned() {
  QStringList keys;
  for (const std::string& key : m_document.project().view.pinned) keys << QString::fromStdString(key);
  for (ParameterPanel* panel : panels()) panel->setPinned(keys);
}

/// Other rows of the owner, which may have come to act or ceased to.
void Inspector::refreshIdle(const Address& address, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const Address other{address.owner, address.id, key, address.plugin};
    const QString why = whyIdle(m_document.project(), other);
    for (ParameterPanel* panel : panels()) panel->setDisabledReason(QString::fromStdString(other.text()), why);
  }
}

void Inspector::onChanged(const ChangeEvent& event) {
  if (const auto* parameter = std::get_if<ParameterChanged>(&event)) {
    const Address& address = parameter->address;
    const QString key = QString::fromStdString(address.text());
    for (ParameterPanel* panel : panels()) panel->setValue(key, m_document.value(address));
    if (address.owner == Owner::Scene && address.key == "thermal_model") rebuildSolver();
    if (address.owner == Owner::Wall && address.key == "heat")
      refreshIdle(address, {"temperature", "heat_flux", "convection", "emissivity", "film_coefficient"});
    if (address.owner == Owner::Environment && address.key == "radiation")
      refreshIdle(address, {"surroundings_temperature"});
    if (address.owner == Owner::Body && address.key == "fixed") refreshIdle(address, {"motion_start", "motion_stop"});
    if (address.owner == Owner::Material && propertyIndex(address.key) < 0) refreshProperties(address.id);
  } else if (std::holds_alternative<ProjectOpened>(event)) {
    m_bodyId = m_document.project().bodies.empty() ? std::string() : m_document.project().bodies.front().id;
    m_materialId.clear();
    m_limited.clear();
    m_limits.clear();
    m_mean.clear();
    m_sceneMean = ambientTemperature();  // what was measured belongs to the project before
    markPinned();
    rebuild();
  } else if (std::holds_alternative<BodyChanged>(event) || std::holds_alternative<StrokeChanged>(event)) {
    rebuildBody();
    showSceneHeader();
    showMaterialHeader();
  } else if (const auto* port = std::get_if<PortChanged>(&event)) {
    if (!port->moved) rebuildScene();
    showMaterialHeader();
  } else if (std::holds_alternative<WallsChanged>(event)) {
    rebuildScene();
    rebuildMaterial();  // one of its rows may be pinned
  } else if (std::holds_alternative<MaterialsChanged>(event)) {
    rebuildMaterial();
  } else if (std::holds_alternative<PinsChanged>(event)) {
    markPinned();
    rebuildMaterial();
  }
}

/// A material plugin's own parameter changed: every property may have another default, and another value where none is
/// set.
void Inspector::refreshProperties(const std::string& material) {
  const ParameterSet defaults = materialDefaults(m_document.project(), m_document.plugins(), material);
  const ParameterSet* own = findSet(m_document.project(), {Owner::Material, material, propertyCatalogue()[0].key});
  if (!own) return;
  for (const RowModel& row : rowModels(propertyCatalogue(), *own, defaults,
                                       QStringLiteral("material/%1/").arg(QString::fromStdString(material)))) {
    m_material->setDefaultValue(row.key, row.defaultValue);
    m_material->setValue(row.key, row.value);
  }
}

void Inspector::setSnapshot(const Snapshot& snapshot) {
  showTemperatures(snapshot);
  m_limits = snapshot.limits;
  m_limitBodies = snapshot.bodyIds;
  showLimits();
}

/// Said anew each time: the substeps change what is reached, and rows may have been made anew.
void Inspector::showLimits() {
  std::set<QString> limited;
  for (const Limit& limit : m_limits) {
    const auto address = limitAddress(limit, m_limitBodies.get());
    if (!address) continue;
    const QString key = QString::fromStdString(address->text());
    limited.insert(key);
    const double substeps = numberOf(m_document.project().solver.parameters, solverParameters(), "substeps");
    const QString text =
        limitText(limit, m_document.declaration(*address)) +
        QStringLiteral(". [Use %1 substeps](solver/substeps=%1) to come closer").arg(static_cast<int>(substeps) * 2);
    for (ParameterPanel* panel : panels()) panel->setLimit(key, text, limit.delivered);
  }
  for (const QString& key : m_limited) {
    if (limited.count(key)) continue;
    for (ParameterPanel* panel : panels()) panel->setLimit(key, {});
  }
  m_limited = std::move(limited);
}

ParameterPanel* Inspector::panelFor(const Address& address) {
  if (address.owner == Owner::Material) {
    setMaterial(address.id);
    return m_material;
  }
  if (address.owner == Owner::Body || address.owner == Owner::Constraint) {
    setBody(address.id);
    return m_body;
  }
  const bool ofSolver = address.owner == Owner::Solver || address.owner == Owner::Thermal ||
                        (address.owner == Owner::Scene && address.key == "thermal_model");
  return ofSolver ? m_solver : m_scene;
}

}  // namespace ps
