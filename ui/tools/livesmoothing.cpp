// SPDX-License-Identifier: Apache-2.0
// The part of LiveStroke that rounds what is drawn.
#include "core/scene/pose.h"
#include "core/sketch/smoothing.h"
#include "ui/document/document.h"
#include "ui/session/scenelink.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ps {

/// "", and the sketch that has matter under the stamp is in hand, or why there is nothing to be rounded.
QString LiveStroke::whyNoSmoothing(const Snapshot& now, const Vector3& point) {
  if (!m_atStart) return QStringLiteral("What is drawn is smoothed before the first step. Press Home first.");
  const double reach = m_brush.radius + m_setup.grid.spacing;
  double least = reach * reach;
  m_body.reset();
  for (size_t i = 0; i < now.position.size() && now.bodyIds; ++i) {
    const double away = (vectorOf(now.position[i]) - point).squaredNorm();
    if (!(away < least) || now.body[i] >= now.bodyIds->size()) continue;
    const Body* body = m_box.document().body((*now.bodyIds)[now.body[i]]);
    const auto* voxels = body ? std::get_if<VoxelShape>(&body->shape) : nullptr;
    if (!voxels || body->locked || !body->visible || voxels->spacing != m_setup.grid.spacing) continue;
    least = away;
    if (!m_body || m_body->id != body->id) m_body = std::make_shared<const Body>(*body);
  }
  if (!m_body) return QStringLiteral("Only what was drawn can be smoothed, and is not locked: nothing of it is here.");
  const auto& voxels = std::get<VoxelShape>(m_body->shape);
  if (m_setup.symmetry && !poseOf(voxels).isNothing())
    return QStringLiteral(
        "This sketch was turned: its mirror no longer stands along the scene. Smooth without a mirror and copies.");
  m_canvas = VoxelCanvas(voxels.runs);
  drawOn(voxels);
  m_record->erase = m_smooths = true;
  return {};
}

void LiveStroke::smooth(const std::vector<api::Cell>& fresh) {
  const Environment& environment = m_box.document().project().environment;
  const auto append = [&](StrokeRecord& record, const CellSet& cells) {
    const auto indices = cells.indices();
    record.cells.insert(record.cells.end(), indices.begin(), indices.end());
    return indices;
  };
  const Smoothed change = smoothed(m_canvas, CellSet(fresh));
  if (!change.emptied.empty()) m_box.link()->erase(*m_record, append(*m_record, change.emptied));
  for (const auto& [palette, cells] : change.filled) {
    std::vector<api::Cell> room;
    std::copy_if(cells.cells().begin(), cells.cells().end(), std::back_inserter(room),
                 [&](const api::Cell& cell) { return isInScene(environment, m_setup.grid, cell); });
    if (room.empty()) continue;
    std::shared_ptr<StrokeRecord>& filled = m_filled[palette];
    if (!filled) {
      filled = std::make_shared<StrokeRecord>();
      filled->lattice = m_record->lattice;
      filled->body = m_body->id;
      filled->palette = palette;
    }
    m_box.link()->paint(*filled, m_body, append(*filled, CellSet(room)));
  }
}

/// Both parts of it are one step, and its strokes are noted with the first of them.
void LiveStroke::keepSmoothing(const std::shared_ptr<StrokeRecord>& emptied) {
  const Project& project = m_box.document().project();
  const auto body =
      std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& one) { return one.id == m_body->id; });
  if (body == project.bodies.end()) {  // another hand has taken all of it
    m_box.link()->cancel(emptied);
    for (const auto& [palette, filled] : std::exchange(m_filled, {})) m_box.link()->cancel(filled);
    return;
  }
  const auto index = static_cast<size_t>(body - project.bodies.begin());
  std::vector<VoxelShape::Stroke> strokes;
  if (!std::get<VoxelShape>(body->shape).strokes.empty()) strokes = pieces();
  std::vector<std::shared_ptr<StrokeRecord>> parts;
  if (!emptied->cells.empty()) {
    auto edit = eraseEdit(*body, index, emptied->lattice, emptied->cells, std::exchange(strokes, {}));
    if (edit) emptied->edits.push_back(std::move(*edit));
    parts.push_back(emptied);
  }
  for (const auto& [palette, filled] : m_filled) {
    const auto free = freeAtStart(project, body->id, filled->lattice, filled->cells);
    SceneEdit edit = paintEdit(project, *m_body, free, palette, m_stroke);
    std::get<CellsEdit>(edit).strokes = std::exchange(strokes, {});
    filled->edits.push_back(std::move(edit));
    parts.push_back(filled);
  }
  m_filled.clear();
  if (!parts.empty()) m_box.document().addStrokes(parts, QStringLiteral("smoothing stroke"));
}

}  // namespace ps
