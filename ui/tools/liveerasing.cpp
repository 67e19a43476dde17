// SPDX-License-Identifier: Apache-2.0
// What an erasing stroke takes, and whether that is anything.
#include "core/simulation/snapshot.h"
#include "ui/document/document.h"
#include "ui/session/scenelink.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/toolbox.h"

namespace ps {
namespace {

/// Places in cells, and in those that are up to `margin` beside them.
class Reach {
 public:
  Reach(const SketchGrid& grid, const std::vector<api::Cell>& cells, int margin)
      : m_grid(grid), m_cells(cells), m_margin(margin), m_low(grid.centreOf(cells.front())), m_high(m_low) {
    for (const api::Cell& cell : cells) {
      m_low = m_low.cwiseMin(grid.centreOf(cell));
      m_high = m_high.cwiseMax(grid.centreOf(cell));
    }
    // However they are turned: half a diagonal is less than an edge.
    const Vector3 most = Vector3::Constant((1 + 2 * margin) * grid.spacing);
    m_low -= most;
    m_high += most;
  }
  bool has(const Vector3& place) const {
    // Most of a scene is far from a stroke, and turning each place into its cell would take far longer.
    if ((place.array() < m_low.array()).any() || (place.array() > m_high.array()).any()) return false;
    const api::Cell cell = m_grid.cellAt(place);
    for (int x = -m_margin; x <= m_margin; ++x) {
      for (int y = -m_margin; y <= m_margin; ++y) {
        for (int z = -m_margin; z <= m_margin; ++z) {
          if (m_cells.contains({cell.x + x, cell.y + y, cell.z + z})) return true;
        }
      }
    }
    return false;
  }

 private:
  const SketchGrid& m_grid;
  CellSet m_cells;
  int m_margin;
  Vector3 m_low, m_high;
};

}  // namespace

/// Asked before the engine takes what is in these cells. While time passes matter is elsewhere by then: what is beside
/// them counts too.
void LiveStroke::meet(const std::vector<api::Cell>& fresh) {
  if (m_met == Met::Matter) return;
  const SnapshotPtr scene = m_box.link()->scene();
  if (!scene) m_met = Met::Matter;  // there may be some
  if (!scene || fresh.empty()) return;
  const Reach reach(m_setup.grid, fresh, m_box.link()->runs() ? 1 : 0);
  for (size_t i = 0; i < scene->position.size(); ++i) {
    if (!reach.has(vectorOf(scene->position[i]))) continue;
    const bool isNamed = scene->bodyIds && i < scene->body.size() && scene->body[i] < scene->bodyIds->size();
    const Body* body = isNamed ? m_box.document().body((*scene->bodyIds)[scene->body[i]]) : nullptr;
    m_met = body && body->locked ? Met::Locked : Met::Matter;
    if (m_met == Met::Matter) return;
  }
}

/// "" where it took something. At the start the bodies say so as well: what was drawn there just now may not be seen
/// yet.
QString LiveStroke::whyNothingErased() {
  if (!m_record->erase || m_cells.empty() || m_met == Met::Matter) return {};
  if (m_atStart) {
    StrokeRecord taken;
    taken.lattice = m_record->lattice;
    taken.cells = m_cells.indices();
    collectErasure(taken);
    if (!taken.edits.empty()) return {};
  }
  m_erasedNothing = true;
  return m_met == Met::Locked ? QStringLiteral("What is there is locked.")
                              : QStringLiteral("Nothing is there to erase.");
}

void LiveStroke::collectErasure(StrokeRecord& record) const {
  const Project& project = m_box.document().project();
  const std::vector<VoxelShape::Stroke> strokes = pieces();
  for (size_t i = 0; i < project.bodies.size(); ++i) {
    if (project.bodies[i].locked) continue;
    auto edit = eraseEdit(project.bodies[i], i, record.lattice, record.cells, strokes);
    if (edit) record.edits.push_back(std::move(*edit));
  }
}

}  // namespace ps
