// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/stroketool.h"

#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/scenelink.h"
#include "ui/theme/numbers.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace ps {
namespace {

constexpr const char* kBonds = "bonds";

const SceneMaterial* sceneMaterial(const Project& project, const std::string& id) {
  for (const SceneMaterial& material : project.materials) {
    if (material.id == id) return &material;
  }
  return project.materials.empty() ? nullptr : &project.materials.front();
}

/// A body that takes more of the same matter: sketched, free, of one material at one temperature.
bool takesMore(const Body& body, const std::string& material, double temperature, const SketchGrid& grid) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  return voxels && !body.locked && body.visible && voxels->palette.size() == 1 && voxels->origin == grid.origin &&
         voxels->spacing == grid.spacing && voxels->palette[0].material == material &&
         voxels->palette[0].temperature == temperature;
}

}  // namespace

void StrokeTool::attach(Document* document, SceneLink* link) {
  m_document = document;
  m_link = link;
  m_record.reset();
}

double StrokeTool::spacing() const {
  return numberOf(m_document->project().solver.parameters, solverParameters(), "particle_spacing");
}

StrokeSetup StrokeTool::setup(const BrushSettings& brush) const {
  StrokeSetup s;
  s.grid.spacing = spacing();
  // Cells stand on the level y = 0, half a spacing above it.
  s.grid.origin = {s.grid.spacing / 2, s.grid.spacing / 2, s.grid.spacing / 2};
  s.radius = brush.radius;
  if (m_document->plugins()) s.parameters = numbersOf({}, m_document->plugins()->parameters(brush.shape));
  return s;
}

Vector3 StrokeTool::extent(const BrushSettings& brush) const {
  const api::BrushPlugin* plugin =
      m_document && m_document->plugins() ? m_document->plugins()->brush(brush.shape) : nullptr;
  if (!plugin) return {brush.radius, brush.radius, brush.radius};
  const StrokeSetup s = setup(brush);
  const api::StrokeContext context{s.grid.spacing,
                                   {s.grid.origin[0], s.grid.origin[1], s.grid.origin[2]},
                                   s.radius,
                                   {0, 1, 0},
                                   {s.parameters.data(), s.parameters.size()}};
  const api::Double3 e = plugin->extent(context);
  return {e.x, e.y, e.z};
}

Body StrokeTool::paintedBody(const BrushSettings& brush, int& palette) const {
  const Project& project = m_document->project();
  const SceneMaterial* material = sceneMaterial(project, brush.material);
  palette = 0;
  for (const Body& body : project.bodies) {
    if (takesMore(body, material->id, brush.temperature, m_setup.grid)) return body;
  }
  Body body;
  body.id = m_document->freeBodyId("sketch-" + material->id);
  const std::string label = material->label.empty() ? material->id : material->label;
  body.name = "Sketched " + label;
  body.name[9] = static_cast<char>(std::tolower(static_cast<unsigned char>(body.name[9])));
  body.material = material->id;
  body.parameters.values["temperature"] = brush.temperature;
  VoxelShape voxels;
  voxels.origin = m_setup.grid.origin;
  voxels.spacing = m_setup.grid.spacing;
  voxels.palette.push_back({material->id, brush.temperature, {}});
  body.shape = voxels;
  const Value melts = valueAt(project, m_document->plugins(), {Owner::Material, material->id, "melting_temperature"});
  const auto* melting = std::get_if<double>(&melts);
  const bool solid = melting && brush.temperature < *melting;
  if (solid && m_document->plugins()->constraint(kBonds)) body.constraints.push_back({kBonds, {}, {}});
  return body;
}

QString StrokeTool::whyNot(const BrushSettings& brush, bool erase, const Snapshot& now) const {
  if (!m_document || !m_document->plugins()) return QStringLiteral("Plugins are still being loaded.");
  if (!m_document->plugins()->brush(brush.shape)) {
    return QStringLiteral("The brush “%1” is not installed. See Plugins.").arg(QString::fromStdString(brush.shape));
  }
  if (!erase && m_document->project().materials.empty()) {
    return QStringLiteral("The scene has no material to draw with. Add one under Materials.");
  }
  if (now.spacing > 0 && now.spacing != spacing()) {
    return QStringLiteral("The particle spacing of %1 acts at the next reset. Press Home first, or undo the change.")
        .arg(lengthText(spacing()));
  }
  const Vector3 half = extent(brush);
  const double cells = 8 * half[0] * half[1] * half[2] / std::pow(spacing(), 3);
  if (cells > kMaximumStamp) {
    return QStringLiteral(
               "One stamp of this brush would hold up to %1 particles, more than can be drawn at a time. "
               "Make the brush smaller, or the particle spacing larger.")
        .arg(formatFixed(cells));
  }
  return {};
}

QString StrokeTool::begin(const BrushSettings& brush, bool erase, const Snapshot& now, const Vector3& point) {
  if (const QString problem = whyNot(brush, erase, now); !problem.isEmpty()) return problem;
  m_brush = brush;
  m_atStart = now.stats.frame == 0;
  m_setup = setup(brush);
  m_resampler = std::make_unique<StrokeResampler>(m_setup.grid.spacing);
  m_cells = {};
  m_record = std::make_shared<StrokeRecord>();
  m_record->erase = erase;
  m_record->lattice.origin = m_setup.grid.origin;
  m_record->lattice.spacing = m_setup.grid.spacing;
  m_stroke = {};
  m_stroke.brush = brush.shape;
  m_stroke.erase = erase;
  m_stroke.radius = brush.radius;
  if (!erase) {
    m_body = std::make_shared<const Body>(paintedBody(brush, m_record->palette));
    m_record->body = m_body->id;
    m_stroke.palette = m_record->palette;
  }
  return move(point, 0);
}

QString StrokeTool::move(const Vector3& point, double seconds) {
  if (!m_record) return {};
  m_stroke.samples.push_back({point[0], point[1], point[2], 1, seconds});
  return guarded([&] { feed(m_resampler->add({{point[0], point[1], point[2]}, 1, seconds})); });
}

template <class Work>
QString StrokeTool::guarded(Work work) const {
  try {
    work();
    return {};
  } catch (const std::exception& error) {
    return QString::fromUtf8(error.what());
  } catch (...) {  // a brush is somebody else's code
    return QStringLiteral("The brush “%1” failed and did not say why. See Plugins.")
        .arg(QString::fromStdString(m_brush.shape));
  }
}

bool StrokeTool::isInside(const api::Cell& cell) const {
  const Environment& environment = m_document->project().environment;
  const Vector3 c = m_setup.grid.centreOf(cell);
  const double radius = 0.49 * m_setup.grid.spacing;
  for (size_t i = 0; i < 3; ++i) {
    if (c[i] < environment.boundsMinimum[i] + radius || c[i] > environment.boundsMaximum[i] - radius) return false;
  }
  for (const SceneWall& wall : environment.walls) {
    if ((c - wall.point).dot(wall.normal) < radius * wall.normal.norm()) return false;
  }
  return true;
}

void StrokeTool::feed(const std::vector<api::StrokeSample>& samples) {
  const api::BrushPlugin* plugin = m_document->plugins()->brush(m_brush.shape);
  if (samples.empty() || !plugin) return;
  const StrokeEdits edits = applyBrush(*plugin, m_setup, api::EditKind::Add, samples);
  std::vector<api::Cell> fresh;
  for (const api::Cell& cell : edits.added.cells()) {
    if (!m_cells.contains(cell) && (m_record->erase || isInside(cell))) fresh.push_back(cell);
  }
  if (fresh.empty()) return;
  m_cells.add(fresh);
  const std::vector<std::array<int, 3>> cells = CellSet(fresh).indices();
  if (m_record->erase) {
    m_link->erase(*m_record, cells);
  } else {
    m_link->paint(*m_record, m_body, cells);
  }
}

void StrokeTool::collectErasure(StrokeRecord& record) const {
  const Project& project = m_document->project();
  for (size_t i = 0; i < project.bodies.size(); ++i) {
    if (project.bodies[i].locked) continue;
    auto edit = eraseEdit(project.bodies[i], i, record.lattice, record.cells);
    if (edit) record.edits.push_back(std::move(*edit));
  }
}

void StrokeTool::finish() {
  if (!m_record) return;
  guarded([&] { feed(m_resampler->finish()); });  // what came so far stays
  const std::shared_ptr<StrokeRecord> record = std::move(m_record);
  m_record.reset();
  if (m_cells.empty()) return;
  record->cells = m_cells.indices();
  const Project& project = m_document->project();
  if (!record->erase) {
    const auto free = freeAtStart(project, m_body->id, record->lattice, record->cells);
    record->edits.push_back(paintEdit(project, *m_body, free, record->palette, m_stroke));
  } else if (m_atStart) {
    // Before the first step matter stands where its body put it, so that the bodies themselves can be carved.
    collectErasure(*record);
  }
  m_document->addStroke(record);
}

void StrokeTool::cancel() {
  if (!m_record) return;
  const std::shared_ptr<StrokeRecord> record = std::move(m_record);
  m_record.reset();
  record->cells = m_cells.indices();
  if (!m_cells.empty()) m_link->cancel(record);
}

}  // namespace ps
