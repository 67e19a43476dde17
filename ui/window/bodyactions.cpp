// SPDX-License-Identifier: Apache-2.0
#include "ui/window/bodyactions.h"

#include "core/base/digits.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/knowncount.h"
#include "core/scene/pose.h"
#include "core/scene/solidform.h"
#include "core/simulation/declared.h"
#include "core/simulation/snapshot.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/freename.h"
#include "ui/document/wallside.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/window/actions.h"
#include "ui/window/entrytext.h"
#include "ui/window/filenames.h"
#include "ui/window/noticebar.h"
#include "ui/window/notices.h"
#include "ui/window/solidrows.h"

#include <phasesketch/thin.h>

#include <QtCore/QFileInfo>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace ps {
namespace {

using Kind = SolidForm::Kind;
struct UnitRow {
  const char *key, *name;
};
constexpr UnitRow kUnits[] = {{"m", "metres"}, {"cm", "centimetres"}, {"mm", "millimetres"}, {"in", "inches"}};
constexpr double kOfScene = 0.2;      ///< size of a new solid, of the scene's narrower side
constexpr double kToolOfScene = 0.4;  ///< length of a new tool, likewise
constexpr double kOverRoom = 1.25;    ///< of the scene's room, what a mesh whose unit is not known may be
constexpr const char* kTopic = MeshQueue::kTopic;
constexpr const char* kMeshes =
    "Meshes (*.obj *.stl *.ply *.gltf *.glb *.fbx *.3mf *.dae *.3ds *.off *.x3d *.blend);;All files (*)";

/// m, the highest that stands or lies within a column about the middle of the scene now, but for one body.
double topOf(const Snapshot* now, const std::string& without, const Vector3& middle, const Vector3& size,
             double floor) {
  double top = floor;
  for (size_t i = 0; now && i < now->position.size(); ++i) {
    if (now->motion[i] == api::Motion::Gas) continue;
    if (!without.empty() && (*now->bodyIds)[now->body[i]] == without) continue;
    const api::Float4& p = now->position[i];
    if (std::abs(p.x - middle[0]) <= size[0] / 2 + p.w && std::abs(p.z - middle[2]) <= size[2] / 2 + p.w)
      top = std::max(top, double{p.y} + p.w);
  }
  return top;
}

/// The first plugin that makes cloth or ropes of what is one particle thick.
std::optional<std::pair<std::string, const api::ThinMatter*>> thinStructure(const PluginRegistry& plugins,
                                                                            const char* capability) {
  for (const std::string& id : plugins.ids(PluginKind::Constraint)) {
    const api::ConstraintPlugin* plugin = plugins.constraint(id);
    const void* thin = plugin ? plugin->extension(capability) : nullptr;
    if (thin) return std::pair(id, static_cast<const api::ThinMatter*>(thin));
  }
  return std::nullopt;
}

/// The scene's material of an installed one, which it gets where it has none; "" where that is not installed.
std::string sceneMaterial(Document& document, const std::string& base) {
  return document.plugins()->material(base) ? document.addMaterial(base) : std::string();
}

/// Whether what is made of a material of the scene stands at a temperature.
bool isSolid(const Document& document, const std::string& id, double kelvin) {
  const std::vector<SceneMaterial>& all = document.project().materials;
  const auto at = std::find_if(all.begin(), all.end(), [&](const SceneMaterial& m) { return m.id == id; });
  const Material* base = at == all.end() ? nullptr : document.plugins()->material(at->base);
  return base && kelvin < phaseDiagramOf(*base).meltingPoint0;
}

SolidShape& solidOf(Body& body) { return std::get<SolidShape>(body.shape); }

/// What was done to a mesh when it was read, after a space; "" for nothing.
QString doneTo(const Body& body) {
  const auto& mesh = std::get<SolidShape>(body.shape).mesh;
  const size_t done = mesh ? mesh->origin.rfind(": ") : std::string::npos;
  if (done == std::string::npos) return {};
  return QStringLiteral(" When it was read: %1.").arg(QString::fromStdString(mesh->origin.substr(done + 2)));
}

void scale(SolidShape& solid, double factor) {
  const Vector3 size = SolidForm(solid).size() * factor;
  for (size_t a = 0; a < 3; ++a) solid.parameters.values[std::string("size_") + "xyz"[a]] = size[a];
}

QString sizeText(const Vector3& size) {
  return QStringLiteral("%1 × %2 × %3 m").arg(formatNumber(size[0]), formatNumber(size[1]), formatNumber(size[2]));
}

/// m, level, of the room that the scene gives.
double narrowSide(const Document& document) {
  const Room room = roomOf(document.project().environment);
  const Vector3 wide = room.maximum - room.minimum;
  return std::min(wide.x(), wide.z());
}

double spacingOf(const Document& document) {
  return numberOf(document.project().solver.parameters, solverParameters(), "particle_spacing");
}

/// Of a body that is not there yet, or of one that has just come.
QString countText(const Body& body, const Document& document) {
  if (const auto known = knownCount(body, spacingOf(document)))
    return ps::countText(static_cast<size_t>(*known), QStringLiteral("particle"), QStringLiteral("particles"));
  return particlesAhead(particleCount(body, spacingOf(document)));
}

/// What went with a body that has come back at once, with the curves of its probes. It has another id by now: no id is
/// given twice.
void bringBack(Document& document, const std::string& body, const std::vector<Track>& tracks, std::vector<Probe> probes,
               const std::optional<std::vector<Graph>>& graphs) {
  for (const Track& track : tracks) {
    auto address = Address::parse(track.parameter);
    if (!address || document.track(*address)) continue;
    address->id = body;
    document.setKeys({{*address, track.keys}}, {});
  }
  for (Probe& probe : probes) {
    if (document.probe(probe.id)) continue;
    probe.body = body;
    document.addProbe(std::move(probe));
  }
  if (!graphs) return;  // they go by the probes
  for (const Graph& graph : *graphs) {
    if (graph.kind != Graph::Kind::Time) continue;
    const std::vector<Graph> now = document.graphs();
    const auto same = std::find_if(now.begin(), now.end(), [&](const Graph& each) { return each.id == graph.id; });
    for (const std::string& source : graph.series) {
      if (same == now.end() || std::find(same->series.begin(), same->series.end(), source) != same->series.end())
        continue;
      document.plot(graph.id, source);
    }
  }
}

}  // namespace

BodyActions::BodyActions(Session& session, Selection& selection, const Actions& actions, Notices& notices,
                         QObject* parent)
    : QObject(parent),
      m_session(session),
      m_selection(selection),
      m_actions(actions),
      m_notices(notices),
      m_meshes(session, notices) {
  connect(&session, &Session::ready, this, [this] {
    for (QAction* action : m_adding) action->setEnabled(true);
  });
  connect(&m_meshes, &MeshQueue::reading, this, &BodyActions::reading);
  connect(&m_meshes, &MeshQueue::failed, this, &BodyActions::onUnread);
  connect(&m_meshes, &MeshQueue::ended, this, &BodyActions::onAllRead);
  connect(
      &m_meshes, &MeshQueue::read, this,
      [this](const MeshQueue::File& file, const std::shared_ptr<ImportedMesh>& imported) { onRead(file, *imported); });
  connect(&session.document(), &Document::changed, this, [this] {
    if (m_asked.empty() || m_session.document().body(m_asked)) return;
    m_asked.clear();
    m_notices.bar().close(QString::fromLatin1(kTopic));
  });
}

void BodyActions::makeMenu(QMenu* menu, QMenu* walls) {
  for (const SolidRow& row : solidRows()) {
    const QString name = QString::fromLatin1(row.name);
    QAction* action =
        m_actions.add(menu, QStringLiteral("add.") + QString::fromStdString(idOf(row)),
                      QStringLiteral("Add body: %1").arg(name.toLower()), {}, [this, &row] { addSolid(row); });
    sayInMenu(*action, name);
    action->setProperty(kWords, QString::fromLatin1(row.words));
    m_adding.push_back(action);
  }
  connect(menu, &QMenu::aboutToShow, this, &BodyActions::showCounts);
  menu->addSeparator();
  menu->addMenu(walls);
  makeToolMenu(menu->addMenu(QStringLiteral("Tool")));
  menu->addSeparator();
  m_adding.push_back(m_actions.add(menu, QStringLiteral("add.mesh"), QStringLiteral("Import mesh…"),
                                   {QKeySequence(QStringLiteral("Ctrl+I"))}, [this] { chooseMesh(MeshUse::Matter); }));
  m_adding.back()->setToolTip(
      QStringLiteral("Makes a body of a file of another program: OBJ, STL, PLY, glTF, FBX, 3MF and others."));
  menu->setToolTipsVisible(true);
  showCounts();
  for (QAction* action : m_adding) action->setEnabled(m_session.isReady());
}

void BodyActions::addToWallMenu(QMenu* menu) {
  QAction* action = m_actions.add(menu, QStringLiteral("sketch.wall.mesh"), QStringLiteral("Add wall: from a mesh…"),
                                  {}, [this] { chooseMesh(MeshUse::Wall); });
  sayInMenu(*action, QStringLiteral("From a mesh…"));
  action->setToolTip(QStringLiteral("A body of the mesh's surface that is held in place: a tank, a ground, a mould."));
  action->setEnabled(m_session.isReady());
  m_adding.push_back(action);
}

void BodyActions::makeToolMenu(QMenu* menu) {
  for (const ToolForm& form : toolForms()) {
    QAction* action = m_actions.add(menu, QStringLiteral("add.tool.") + QString::fromLatin1(form.id),
                                    QStringLiteral("Add tool: %1").arg(QString::fromLatin1(form.name).toLower()), {},
                                    [this, &form] { addTool(form); });
    sayInMenu(*action, QString::fromLatin1(form.name));
    action->setToolTip(QStringLiteral("%1 Take it in hand with A.").arg(QString::fromLatin1(form.use)));
    m_adding.push_back(action);
  }
  menu->setToolTipsVisible(true);
}

bool BodyActions::isMesh(const QString& path) {
  const QString ending = QStringLiteral("*.") + QFileInfo(path).suffix().toLower();
  const QString meshes = QString::fromLatin1(kMeshes);
  const qsizetype open = meshes.indexOf(QLatin1Char('(')) + 1, close = meshes.indexOf(QLatin1Char(')'));
  return meshes.mid(open, close - open).split(QLatin1Char(' ')).contains(ending);
}

void BodyActions::chooseMesh(MeshUse use) {
  const QString path =
      fileToRead(&m_actions.window(),
                 use == MeshUse::Wall ? QStringLiteral("A wall from a mesh") : QStringLiteral("Import a mesh"),
                 folderBeside(m_session), QString::fromLatin1(kMeshes));
  if (!path.isEmpty()) importMeshes({path}, use);
}

/// How many particles each would be, before it is chosen.
void BodyActions::showCounts() {
  for (size_t k = 0; k < solidRows().size(); ++k) {
    const SolidRow& row = solidRows()[k];
    const QString count = countText(newSolid(row), m_session.document());
    if (row.held > 0) {
      m_adding[k]->setToolTip(
          QStringLiteral("Keeps %1 and heats what stands on it. On the floor in the middle of the scene, or above what "
                         "is there; %2.")
              .arg(formatValue(*findDeclaration(bodyParameters(), "held_temperature"), row.held), count));
    } else {
      m_adding[k]->setToolTip(QStringLiteral("Above what is in the middle of the scene; %1.").arg(count));
    }
  }
}

void BodyActions::addSolid(const SolidRow& row) {
  Document& document = m_session.document();
  Body body = newSolid(row);
  document.undoStack().beginMacro(QStringLiteral("adding %1").arg(QString::fromLatin1(row.name)));
  const bool sheet = row.kind == Kind::Sheet;
  if (sheet || row.kind == Kind::Rope) {
    if (const auto thin = thinStructure(*document.plugins(), sheet ? api::kHoldsSheets : api::kHoldsLines)) {
      body.constraints.push_back({thin->first, {}, {}});
      body.material = sceneMaterial(document, thin->second->material);
    }
  }
  // A bowl of what is liquid would run away.
  const double kelvin = numberOf(body.parameters, bodyParameters(), "temperature");
  if (row.kind == Kind::Bowl && !isSolid(document, m_selection.material(), kelvin))
    body.material = sceneMaterial(document, lastToMelt(*document.plugins()));
  if (row.held > 0) body.material = sceneMaterial(document, bestConductor(*document.plugins(), row.held));
  add(std::move(body));
  document.undoStack().endMacro();
}

void BodyActions::addTool(const ToolForm& form) {
  Document& document = m_session.document();
  Body body = toolBody(form.kind, toDigits(kToolOfScene * narrowSide(document), 2), spacingOf(document));
  document.undoStack().beginMacro(QStringLiteral("adding %1").arg(QString::fromLatin1(form.name)));
  body.material = sceneMaterial(document, lastToMelt(*document.plugins()));
  add(std::move(body));
  document.undoStack().endMacro();
}

/// A fifth of the scene wide, or as its row has it.
Body BodyActions::newSolid(const SolidRow& row) const {
  const Document& document = m_session.document();
  return solidBody(row, toDigits(kOfScene * narrowSide(document), 2), spacingOf(document));
}

/// Of a mesh that does not say its unit: the first one in which it has room in the scene, or nearly, in m; its body is
/// then of that size. Where it has none, the last.
double BodyActions::scaledToFit(Body& body, const ImportedMesh& imported) const {
  const Room room = roomOf(m_session.document().project().environment);
  const Vector3 wide = kOverRoom * (room.maximum - room.minimum);
  const Vector3 size = SolidForm(solidOf(body)).size() / imported.metresPerUnit;
  double metres = 1;
  for (const char* unit : {"m", "cm", "mm"}) {
    metres = *metresPer(unit);
    if (((size * metres).array() < wide.array()).all()) break;
  }
  scale(solidOf(body), metres / imported.metresPerUnit);
  return metres;
}

/// m, above all in a column about the middle of the scene but one body: matter as it is, and what has just come.
double BodyActions::heightFree(const Vector3& middle, const Vector3& size, const std::string& without) const {
  const Project& project = m_session.document().project();
  const SnapshotPtr now = m_session.newest();
  double top = topOf(now.get(), without, middle, size, roomOf(project.environment).minimum[1]);
  const auto known = [&](const std::string& id) {
    return now && now->bodyIds && std::find(now->bodyIds->begin(), now->bodyIds->end(), id) != now->bodyIds->end();
  };
  for (const Body& body : project.bodies) {
    if (body.id == without || known(body.id)) continue;
    const BodyBounds box = boundsOf(body);
    const Vector3 apart = (box.middle() - middle).cwiseAbs() - 0.5 * (box.size() + size);
    if (apart.x() <= 0 && apart.z() <= 0) top = std::max(top, box.maximum.y());
  }
  return top;
}

/// Above what is there but `without`, and within the scene where that is high enough. Returns its id.
std::string BodyActions::add(Body body, const std::string& without) {
  Document& document = m_session.document();
  const Room room = roomOf(document.project().environment);
  const SolidForm form(solidOf(body));
  const Vector3 middle = (room.minimum + room.maximum) / 2;
  const double spacing = spacingOf(document);
  const double floor = room.minimum[1], top = heightFree(middle, form.size(), without);
  const double lowest = floor + form.size()[1] / 2, highest = room.maximum[1] - form.size()[1] / 2;
  auto& values = solidOf(body).parameters.values;
  values["position_x"] = middle[0];
  values["position_y"] = std::max(lowest, std::min(highest, lowest + (top > floor ? top - floor + spacing : 0)));
  values["position_z"] = middle[2];
  std::set<std::string> names;
  for (const Body& other : document.project().bodies) names.insert(shownName(other));
  body.name = freeName(body.name, names);
  document.undoStack().beginMacro(QStringLiteral("adding %1").arg(QString::fromStdString(body.name)));
  if (body.material.empty()) body.material = m_selection.material();
  if (body.material.empty()) body.material = document.addMaterial(document.plugins()->standard(PluginKind::Material));
  const Value melts =
      valueAt(document.project(), document.plugins(), {Owner::Material, body.material, "melting_temperature"});
  const auto* melting = std::get_if<double>(&melts);
  const std::string structure = frozenStructure(*document.plugins());
  const bool fixed = toggleOf(body.parameters, bodyParameters(), "fixed");
  if (body.constraints.empty() && !fixed && melting &&
      numberOf(body.parameters, bodyParameters(), "temperature") < *melting && !structure.empty())
    body.constraints.push_back({structure, {}, {}});
  const std::string id = document.addBody(std::move(body));
  document.undoStack().endMacro();
  m_selection.selectBody(id);
  Q_EMIT rowWanted({Owner::Body, id, kBodyMaterialKey});  // the first row: what it is made of, then its shape
  return id;
}

void BodyActions::onUnread(const MeshQueue::File& file, const QString& problem) {
  m_session.log().add(MessageLevel::Error, file.name(),
                      QStringLiteral("Nothing was imported. %1").arg(sentence(problem)));
}

void BodyActions::onRead(const MeshQueue::File& file, const ImportedMesh& imported) {
  Document& document = m_session.document();
  const bool wall = file.use == MeshUse::Wall;
  Body body = wall ? wallOf(imported) : bodyOf(imported);
  const double unit = imported.unitIsOfFile ? imported.metresPerUnit : scaledToFit(body, imported);
  document.undoStack().beginMacro(QStringLiteral("adding %1").arg(QString::fromStdString(body.name)));
  if (wall) body.material = sceneMaterial(document, lastToMelt(*document.plugins()));
  const std::string id = add(std::move(body));
  document.undoStack().endMacro();
  m_session.log().add(MessageLevel::Ok, file.name(),
                      QStringLiteral("Imported %1. %2 triangles, %3.")
                          .arg(QString::fromStdString(imported.mesh->origin))
                          .arg(imported.facts.triangles)
                          .arg(imported.facts.closed() ? QStringLiteral("closed")
                               : wall                  ? QStringLiteral("open")
                                                       : QStringLiteral("open; filled where it encloses most")));
  if (m_meshes.outcome().wanted > 1) {
    if (!imported.unitIsOfFile) m_meshes.noteGuess(QString::fromStdString(document.body(id)->name));
  } else if (imported.unitIsOfFile) {
    showImported(id);
  } else {
    askUnit(id, unit);
  }
}

/// What became of several, or why the only one is not there.
void BodyActions::onAllRead() {
  const MeshQueue::Outcome outcome = m_meshes.outcome();
  const QStringList& guessed = outcome.guessed;
  const auto unread = static_cast<int>(outcome.unread.size()), come = outcome.wanted - unread;
  if (outcome.wanted == 1 && unread == 0) return;
  constexpr int kMost = 2;
  QStringList text;
  for (const auto& [name, why] : outcome.unread) {
    if (text.size() < kMost) text << (outcome.wanted == 1 ? why : QStringLiteral("“%1”: %2").arg(name, why));
  }
  if (unread > kMost) text << QStringLiteral("Messages says why %1 more are not.").arg(unread - kMost);
  if (guessed.size() == 1)
    text << QStringLiteral("“%1” does not say its unit: its rows of size set another.").arg(guessed.front());
  if (guessed.size() > 1)
    text << QStringLiteral("%1 of them do not say their units: their rows of size set others.").arg(guessed.size());
  const QString title = outcome.wanted == 1 ? QStringLiteral("“%1” was not imported.").arg(outcome.unread[0].first)
                        : come == 0         ? QStringLiteral("None of %1 meshes was imported.").arg(unread)
                        : unread == 0
                            ? QStringLiteral("%1 meshes are in the scene.").arg(come)
                            : QStringLiteral("%1 of %2 meshes are in the scene.").arg(come).arg(outcome.wanted);
  std::vector<NoticeBar::Button> buttons;
  if (unread > 0)
    buttons.push_back({QStringLiteral("Import another…"), [this, use = outcome.use] { chooseMesh(use); }});
  m_notices.bar().show(QString::fromLatin1(kTopic), unread > 0 ? MessageLevel::Error : MessageLevel::Info, title,
                       text.join(QLatin1Char(' ')), std::move(buttons));
}

void BodyActions::showImported(const std::string& id) {
  const Body* body = m_session.document().body(id);
  if (!body) return;
  m_asked = id;
  m_notices.bar().show(QString::fromLatin1(kTopic), MessageLevel::Info,
                       QStringLiteral("“%1” is in the scene.").arg(QString::fromStdString(body->name)),
                       QStringLiteral("%1, %2.").arg(sizeText(SolidForm(std::get<SolidShape>(body->shape)).size()),
                                                     countText(*body, m_session.document())) +
                           doneTo(*body),
                       {{QStringLiteral("Remove"), [this, id] { m_session.document().removeBody(id); }}});
}

/// The file does not say what its numbers mean: one unit was taken, and others are a click away.
void BodyActions::askUnit(const std::string& id, double metresPerUnit) {
  const Body* body = m_session.document().body(id);
  if (!body) return;
  m_asked = id;
  std::vector<NoticeBar::Button> buttons;
  QString taken;
  for (const UnitRow& unit : kUnits) {
    const double metres = *metresPer(unit.key);
    if (metres == metresPerUnit) {
      taken = QString::fromLatin1(unit.name);
      continue;
    }
    buttons.push_back({QStringLiteral("In %1").arg(QString::fromLatin1(unit.key)),
                       [this, id, metresPerUnit, metres] { setUnit(id, metresPerUnit, metres); }});
  }
  const QString size = sizeText(SolidForm(std::get<SolidShape>(body->shape)).size());
  m_notices.bar().show(
      QString::fromLatin1(kTopic), MessageLevel::Info,
      QStringLiteral("“%1” does not say its unit.").arg(QString::fromStdString(body->name)),
      QStringLiteral("In %1 it is %2, %3.").arg(taken, size, countText(*body, m_session.document())) + doneTo(*body),
      std::move(buttons));
}

/// The body comes anew, in one step: its matter of the other size goes.
void BodyActions::setUnit(std::string id, double from, double to) {
  Document& document = m_session.document();
  const Body* present = document.body(id);
  m_notices.bar().close(QString::fromLatin1(kTopic));
  if (!present || !std::holds_alternative<SolidShape>(present->shape)) return;
  if (present->locked) {
    m_notices.refuse(QStringLiteral("The unit stays as it was."),
                     QStringLiteral("The body is locked. Unlock it first."));
    return;
  }
  Body body = *present;
  scale(solidOf(body), to / from);
  const std::vector<Track> tracks = document.project().tracks;
  const std::vector<Probe> probes = document.project().probes;
  const std::optional<std::vector<Graph>> graphs = document.project().graphs;
  document.undoStack().beginMacro(QStringLiteral("unit of %1").arg(QString::fromStdString(body.name)));
  document.removeBody(id);
  const std::string anew = add(std::move(body), id);
  bringBack(document, anew, tracks, probes, graphs);
  document.undoStack().endMacro();
  askUnit(anew, to);
}

}  // namespace ps
