// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/livestroke.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/scene/group.h"
#include "core/scene/pose.h"
#include "core/scene/shownname.h"
#include "core/sketch/symmetry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/freename.h"
#include "ui/session/scenelink.h"
#include "ui/session/selection.h"
#include "ui/theme/numbers.h"
#include "ui/tools/brushcall.h"
#include "ui/tools/goingon.h"
#include "ui/tools/strokethread.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace ps {
namespace {

const SceneMaterial* sceneMaterial(const Project& project, const std::string& id) {
  for (const SceneMaterial& material : project.materials) {
    if (material.id == id) return &material;
  }
  return project.materials.empty() ? nullptr : &project.materials.front();
}

}  // namespace

LiveStroke::LiveStroke(Toolbox& box) : m_box(box) {
  QObject::connect(&m_looks, &QTimer::timeout, &m_looks, [this] { watch(); });
}

StrokeSetup strokeSetup(const BrushSettings& brush, const PluginRegistry& plugins, double spacing, const Vector3& up) {
  StrokeSetup s;
  s.grid.spacing = spacing;
  // Cells stand on the level y = 0, half a spacing above it.
  s.grid.origin = {s.grid.spacing / 2, s.grid.spacing / 2, s.grid.spacing / 2};
  s.radius = brush.radius;
  s.up = up;
  if (brush.symmetry.turns > 1 || brush.symmetry.mirror != "none") s.symmetry = brush.symmetry;
  s.parameters = numbersOf(brush.shapeParameters(), plugins.parameters(brush.shape));
  return s;
}

/// One that there is, or a new one; the record says what of it is drawn, and how it stands.
Body LiveStroke::paintedBody(const Snapshot& now, const Vector3& point, const std::string& id) {
  const BrushSettings& brush = m_brush;
  const Document& document = m_box.document();
  const Project& project = document.project();
  const SceneMaterial* material = sceneMaterial(project, id);
  const Vector3 reach = m_box.stamp(m_setup.up).first + Vector3::Constant(m_setup.grid.spacing);
  const auto found = goingOnAt(document, now, point, reach, material->id, brush, m_setup);
  m_goesOn = found.has_value();
  if (found) {
    m_record->palette = found->palette;
    m_record->way = found->way;
    Body body = *found->body;
    auto& palette = std::get<VoxelShape>(body.shape).palette;
    if (static_cast<size_t>(found->palette) == palette.size()) palette.push_back({material->id, brush.temperature, {}});
    return body;
  }
  Body body;
  body.id = m_box.document().freeBodyId("sketch-" + material->id);
  const std::string& label = shownName(*material);
  std::set<std::string> names;
  for (const Body& other : project.bodies) names.insert(other.name);
  body.name = "Sketched " + label;
  body.name[9] = static_cast<char>(std::tolower(static_cast<unsigned char>(body.name[9])));
  body.name = freeName(body.name, names);
  body.material = material->id;
  body.parameters.values["temperature"] = brush.temperature;
  if (brush.held) body.parameters.values["held"] = true;
  VoxelShape voxels;
  voxels.origin = m_setup.grid.origin;
  voxels.spacing = m_setup.grid.spacing;
  voxels.palette.push_back({material->id, brush.temperature, {}});
  body.shape = voxels;
  become(body, brush.becomes, project, *document.plugins(), brush.temperature);
  return body;
}

namespace {

/// One that has failed stands under Plugins with what it said, and comes back with the program.
QString whyNoBrush(const PluginRegistry& plugins, const std::string& id) {
  for (const PluginInfo& info : plugins.plugins()) {
    if (info.id != id || info.state == PluginInfo::State::Loaded) continue;
    return QStringLiteral("The brush “%1” is put aside: %2. Choose another brush.")
        .arg(QString::fromStdString(info.label), QString::fromStdString(info.problem));
  }
  return QStringLiteral("The brush “%1” is not installed. See Plugins.").arg(QString::fromStdString(id));
}

}  // namespace

QString LiveStroke::whyNot(bool erase, const Snapshot& now, const Vector3& up) const {
  const PluginRegistry* plugins = m_box.document().plugins();
  if (!plugins || !m_box.link()) return QStringLiteral("Plugins are still being loaded.");
  const BrushSettings& brush = m_box.brush();
  if (!plugins->brush(brush.shape)) return whyNoBrush(*plugins, brush.shape);
  if (!erase && m_box.document().project().materials.empty()) {
    return QStringLiteral("The scene has no material to draw with. Add one under Materials.");
  }
  if (!erase && !m_box.reworks()) {
    const Project& project = m_box.document().project();
    const QString problem = whyNotBecome(project, *plugins, sceneMaterial(project, brush.material)->id, brush.becomes);
    if (!problem.isEmpty()) return problem;
  }
  if (now.spacing > 0 && now.spacing != m_box.spacing()) {
    return QStringLiteral(
               "The particle spacing of %1 acts once back at the start. Press Home first, or undo the change.")
        .arg(lengthText(m_box.spacing()));
  }
  if (m_box.stampsShape() && !m_box.shape() && m_box.fillsShape())
    return QStringLiteral("“%1” is still being filled with particles.").arg(QString::fromStdString(m_box.shapeName()));
  if (m_box.stampsShape() && !m_box.shape())
    return QStringLiteral("No body is selected to be stamped. Select one, or click one with Alt.");
  const Vector3 half = m_box.stamp(up).first;
  const double copies = static_cast<double>(imagesOf(brush.symmetry).size());
  const double cells = copies * 8 * half[0] * half[1] * half[2] / std::pow(m_box.spacing(), 3);
  if (cells > kMaximumStamp) {
    return QStringLiteral(
               "One stamp of this brush%1 would hold up to %2 particles, more than can be drawn at a time. "
               "Make the brush smaller%3, or the particle spacing larger.")
        .arg(copies > 1 ? QStringLiteral(" and its copies") : QString(), formatFixed(cells),
             copies > 1 ? QStringLiteral(" or the copies fewer") : QString());
  }
  return {};
}

QString LiveStroke::begin(bool erase, const Snapshot& now, const Vector3& point, const Vector3& up, const Held& held) {
  m_erasedNothing = false;
  if (const QString problem = whyNot(erase, now, up); !problem.isEmpty()) return problem;
  m_brush = m_box.brush();
  m_atStart = now.stats.frame == 0;
  m_setup = strokeSetup(m_brush, *m_box.document().plugins(), m_box.spacing(), up);
  m_up = up;
  m_cells = {};
  m_problem.clear();
  m_filled.clear();
  m_smooths = false;
  m_met = Met::Nothing;
  m_record = std::make_shared<StrokeRecord>();
  m_record->erase = erase;
  m_record->lattice.origin = m_setup.grid.origin;
  m_record->lattice.spacing = m_setup.grid.spacing;
  m_stroke = {};
  m_pieces.clear();
  m_stroke.brush = m_brush.shape;
  m_stroke.parameters = m_brush.shapeParameters();
  m_stroke.erase = erase;
  m_stroke.radius = m_brush.radius;
  m_stroke.up = up;
  m_stroke.symmetry = m_setup.symmetry;
  if (m_box.stampsShape()) {
    m_stroke.stamp = m_box.shape();
    m_setup.stamp = stampCells(*m_stroke.stamp);
  }
  // What the brush does decides, not what its metadata say.
  const api::BrushPlugin& plugin = *m_box.document().plugins()->brush(m_brush.shape);
  m_kind = kindOf(plugin, erase);
  if (m_kind == api::EditKind::Paint) {
    m_record->material = sceneMaterial(m_box.document().project(), m_brush.material)->id;
  } else if (m_kind == api::EditKind::Colour) {
    m_record->material = colourOf(plugin, m_setup);
  } else if (m_kind == api::EditKind::Smooth) {
    if (const QString problem = whyNoSmoothing(now, point); !problem.isEmpty()) {
      m_record.reset();
      return problem;
    }
  } else if (!erase) {
    m_body = std::make_shared<const Body>(paintedBody(now, point, m_brush.material));
    m_record->body = m_body->id;
    m_stroke.palette = m_record->palette;
    drawOn(std::get<VoxelShape>(m_body->shape), m_record->way);
  }
  start();
  move(point, 0, held);
  return {};
}

QString LiveStroke::whatFlows() const {
  const Document& document = m_box.document();
  if (!m_record || m_record->body.empty()) return {};
  return ps::whatFlows(document.project(), *document.plugins(), m_body->material, m_brush.becomes, m_brush.temperature);
}

/// Its brush begins to work, for what is to come.
void LiveStroke::start() {
  StrokeScene scene{m_box.document().project().environment, {}};
  if (m_kind == api::EditKind::Fill) scene.isFree = freePlaces();
  // One look for all of it: what it draws itself is none of what it goes by, and it is drawn again from the same.
  if (m_box.link()) m_sight.show(m_box.link()->scene());
  m_setup.matterWithin = m_sight.matterWithin();
  const api::BrushPlugin& plugin = *m_box.document().plugins()->brush(m_brush.shape);
  // Called from the stroke's thread, which may have been left by the time that this one looks.
  const auto thread = std::make_shared<std::weak_ptr<StrokeThread>>();
  m_thread = std::make_shared<StrokeThread>(
      std::make_unique<StrokeMaker>(m_brush.shape, plugin, m_setup, m_stroke.erase, std::move(scene)), [this, thread] {
        QMetaObject::invokeMethod(
            &m_looks,
            [this, thread] {
              if (m_thread && m_thread == thread->lock()) note(guarded([this] { take(); }));
            },
            Qt::QueuedConnection);
      });
  *thread = m_thread;
  m_idleLooks = 0;
  m_looks.start(kBrushLook);
}

/// What is drawn is drawn as if the sketch stood where it once was, however it stands now.
void LiveStroke::drawOn(const VoxelShape& sketch, const RigidMove& way) {
  m_setup.grid = gridOf(sketch);
  if (!way.isNothing()) m_setup.grid.pose = way.after(m_setup.grid.pose);
  m_record->lattice = latticeOf(sketch);
  m_setup.up = m_setup.grid.pose.inverse().turn * m_setup.up;
  m_stroke.up = m_setup.up;
}

/// Of a hand over a turned sketch, in the sketch's own directions.
Vector3 LiveStroke::ownTurn(const Vector3& turn) const {
  if (turn.isZero(0) || m_setup.grid.pose.isNothing()) return turn;
  const Matrix3 inScene = turnMatrix(turn) * strokeAxes(m_up);
  return turnBetween(strokeAxes(m_setup.up), m_setup.grid.pose.inverse().turn.toRotationMatrix() * inScene);
}

void LiveStroke::move(const Vector3& point, double seconds, const Held& held) {
  if (!m_record) return;
  const Vector3 own = m_setup.grid.pose.isNothing() ? point : m_setup.grid.pose.inverse().of(point);
  const Vector3 turn = ownTurn(held.turn);
  m_stroke.samples.push_back({own[0], own[1], own[2], held.pressure, seconds, turn[0], turn[1], turn[2]});
  m_thread->add({double3Of(own), held.pressure, seconds, {}, {}, double3Of(turn)});
}

/// What is said of it.
QString LiveStroke::putAside(const char* why) {
  m_box.putAside(m_brush.shape, why);
  return QStringLiteral("The brush “%1” failed: %2. It is put aside until the program starts again; see Plugins.")
      .arg(QString::fromStdString(m_brush.shape), QString::fromUtf8(why));
}

QString LiveStroke::guarded(const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const BrushFault& fault) {
    if (m_thread) m_thread->leave();
    cancel();
    return putAside(fault.what());
  } catch (const std::exception& error) {
    return QString::fromUtf8(error.what());
  }
}

/// What goes wrong while it is being drawn: whoever draws ends it, where it came to.
void LiveStroke::note(const QString& problem) {
  if (problem.isEmpty() || !m_problem.isEmpty()) return;
  m_problem = problem;
  if (m_onTrouble) m_onTrouble();
}

bool LiveStroke::stands() const {
  if (!m_record || m_kind == api::EditKind::Colour) return true;
  if (m_kind == api::EditKind::Smooth) return m_box.document().body(m_body->id) != nullptr;
  if (m_record->erase) return true;
  const Project& project = m_box.document().project();
  const auto has = [&](const std::string& id) {
    return std::any_of(project.materials.begin(), project.materials.end(),
                       [&](const SceneMaterial& material) { return material.id == id; });
  };
  if (m_kind == api::EditKind::Paint) return has(m_record->material);
  const bool isThere = m_box.document().body(m_body->id) != nullptr;
  const auto& palette = std::get<VoxelShape>(m_body->shape).palette;
  return (isThere || !m_goesOn) && has(palette.at(static_cast<size_t>(m_record->palette)).material);
}

/// Cells that have come go to the engine.
void LiveStroke::take() {
  if (!stands()) throw Error("The body that it goes on with, or its material, was deleted meanwhile.");
  const std::vector<api::Cell> fresh = m_thread->take();
  if (fresh.empty()) return;
  m_cells.add(fresh);
  if (m_kind == api::EditKind::Smooth) return smooth(fresh);
  const std::vector<std::array<int, 3>> cells = CellSet(fresh).indices();
  if (m_record->erase) {
    meet(fresh);
    m_box.link()->erase(*m_record, cells);
  } else if (m_kind == api::EditKind::Add || m_kind == api::EditKind::Fill) {
    m_box.link()->paint(*m_record, m_body, cells);
  } else {
    m_box.link()->repaint(*m_record, cells);
  }
}

/// A brush that has been at it for too many looks is given up.
void LiveStroke::watch() {
  if (!m_thread) return m_looks.stop();
  if (m_ends && m_thread->isIdle()) return m_onEnd();
  if (m_ends) tellOfEnd();
  m_idleLooks = m_thread->asksBrush() && m_waits == m_thread->places() ? m_idleLooks + 1 : 0;
  m_waits = m_thread->places();
  if (m_idleLooks < kBrushLooks) return;
  m_thread->leave();
  note(guarded([] { throw BrushFault(kNotBack); }));
}

std::vector<VoxelShape::Stroke> LiveStroke::pieces() const {
  std::vector<VoxelShape::Stroke> strokes = m_pieces;
  if (!m_stroke.samples.empty()) strokes.push_back(m_stroke);
  return strokes;
}

void LiveStroke::collectPaint(StrokeRecord& record) const {
  const Project& project = m_box.document().project();
  for (size_t i = 0; i < project.bodies.size(); ++i) {
    if (project.bodies[i].locked) continue;
    for (SceneEdit& edit : repaintEdits(project.bodies[i], i, record.lattice, record.cells, record.material, pieces()))
      record.edits.push_back(std::move(edit));
  }
}

void LiveStroke::lift() {
  if (!m_record) return;
  m_thread->lift();
  m_pieces.push_back(m_stroke);
  m_stroke.samples.clear();
}

QString LiveStroke::finish() {
  m_kept = m_erasedNothing = false;
  stopEnding();
  if (!m_record) return std::exchange(m_problem, {});
  m_thread->lift();
  const QString problem = guarded([this] {
    if (!m_thread->wait()) throw BrushFault(kNotBack);
    take();
    take();  // what went wrong after that
  });
  if (!problem.isEmpty()) m_problem = problem;
  if (m_record && m_problem.isEmpty() && m_cells.empty() && m_thread->leavesScene())
    m_problem = QStringLiteral("It lies outside of the scene, or in its walls.");
  if (m_record && !m_problem.isEmpty()) forgetBeyond(m_thread->places());
  m_thread.reset();
  m_sight.show(nullptr);
  const bool isLost = !stands();
  if (m_record && m_problem.isEmpty() && !isLost) m_problem = whyNothingErased();
  m_kept = m_record && !isLost && !m_erasedNothing && !m_cells.empty();
  if (isLost || m_erasedNothing)
    cancel();  // gives back what came into its way unseen
  else if (m_record)
    keep();  // what came so far stays, unless the brush failed
  return std::exchange(m_problem, {});
}

/// Places that nothing has been drawn from are none of the stroke's: it would be drawn farther again.
void LiveStroke::forgetBeyond(size_t places) {
  const auto cut = [&](VoxelShape::Stroke& stroke) {
    stroke.samples.resize(std::min(places, stroke.samples.size()));
    places -= stroke.samples.size();
  };
  std::for_each(m_pieces.begin(), m_pieces.end(), cut);
  std::erase_if(m_pieces, [](const VoxelShape::Stroke& piece) { return piece.samples.empty(); });
  cut(m_stroke);
}

/// What came to a body that has moved may lie outside of the scene, or in its walls, where the body begins.
std::vector<std::array<int, 3>> LiveStroke::cellsAtStart(const StrokeRecord& record) const {
  std::vector<std::array<int, 3>> cells = record.cells;
  if (record.way.isNothing()) return cells;
  const Environment& environment = m_box.document().project().environment;
  const SketchGrid grid = gridOf(record.lattice);
  std::erase_if(cells, [&](const auto& c) { return !isInScene(environment, grid, {c[0], c[1], c[2]}); });
  return cells;
}

void LiveStroke::keep() {
  const std::shared_ptr<StrokeRecord> record = std::move(m_record);
  m_record.reset();
  if (m_cells.empty()) return;
  if (m_smooths) return keepSmoothing(record);
  record->cells = m_cells.indices();
  const Project& project = m_box.document().project();
  if (!record->material.empty()) {
    if (m_atStart) collectPaint(*record);
  } else if (!record->erase) {
    const auto free = freeAtStart(project, m_body->id, record->lattice, cellsAtStart(*record));
    record->onlyNow = !m_atStart && free.empty();
    record->edits.push_back(paintEdit(project, *m_body, free, record->palette, m_stroke));
    if (const auto* edit = std::get_if<CellsEdit>(&record->edits.back()))
      record->palette = edit->strokes.front().palette;
  } else if (m_atStart) {
    // Before the first step matter stands where its body put it, so that the bodies themselves can be carved.
    collectErasure(*record);
  }
  m_box.document().addStroke(record, groupOfSelection());
}

/// Of all that is selected, where it is one; "": none.
std::string LiveStroke::groupOfSelection() const {
  const std::vector<SelectedItem>& items = m_box.selection().items();
  const auto isIn = [](const SceneGroup& group, const SelectedItem& item) {
    const std::optional<Address> thing = thingOf(item);
    return thing && std::find(group.members.begin(), group.members.end(), memberOf(thing->owner, thing->id)) !=
                        group.members.end();
  };
  for (const SceneGroup& group : livingGroups(m_box.document().project())) {
    const auto inThis = [&](const SelectedItem& item) { return isIn(group, item); };
    if (!items.empty() && std::all_of(items.begin(), items.end(), inThis)) return group.id;
  }
  return {};
}

void LiveStroke::cancel() {
  stopEnding();
  const bool isBack = !m_thread || m_thread->drop();
  m_thread.reset();
  m_sight.show(nullptr);
  if (!isBack) m_box.refuse(QStringLiteral("Nothing was drawn."), putAside(kNotBack));
  if (!m_record) return;
  const std::shared_ptr<StrokeRecord> record = std::move(m_record);
  m_record.reset();
  if (!m_smooths) record->cells = m_cells.indices();
  if (m_cells.empty() || !m_box.link()) return;
  m_box.link()->cancel(record);
  for (const auto& [palette, filled] : m_filled) m_box.link()->cancel(filled);
  m_filled.clear();
}

}  // namespace ps
