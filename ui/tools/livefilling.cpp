// SPDX-License-Identifier: Apache-2.0
// The part of LiveStroke that lets hollows run full.
#include "core/sketch/flooding.h"
#include "ui/document/document.h"
#include "ui/session/scenelink.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <iterator>

namespace ps {

/// Of hidden bodies too. Matter that comes into a place later keeps it as well: the engine fills what is free by then.
void LiveStroke::noteOccupied(const Snapshot& now) {
  const SnapshotPtr all = m_box.link()->scene();
  const Snapshot& scene = all ? *all : now;
  m_occupied.emplace(0.9 * m_setup.grid.spacing, scene.position.size());
  for (const api::Float4& place : scene.position) m_occupied->add({place.x, place.y, place.z});
}

CellSet LiveStroke::floodedFrom(const CellSet& seeds) const {
  const Environment& environment = m_box.document().project().environment;
  return flooded(m_setup.grid, seeds, m_cells, environment.gravity, [&](const SketchGrid& grid, const CellSet& cells) {
    std::vector<api::Cell> free;
    std::copy_if(cells.cells().begin(), cells.cells().end(), std::back_inserter(free), [&](const api::Cell& cell) {
      return isInScene(environment, grid, cell) && m_occupied->isFree(double3Of(grid.centreOf(cell)));
    });
    return CellSet(free);
  });
}

}  // namespace ps
