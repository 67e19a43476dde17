// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/surfaceboxes.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace ps {

void SurfaceBoxes::find(const SurfaceSurroundings& around, const api::NeighbourView& lists,
                        std::span<SurfaceBox> boxes) {
  constexpr double kRounding = 1.0001;  // of single precision
  ++m_time;
  look(around.store);
  const double reach = boxReach() * around.spacing;
  const auto square = static_cast<float>(kRounding * reach * reach);
  const NearNeighbours neighbours(around.store, lists);
  m_room.resize(std::max(m_room.size(), chunkCount(boxes.size(), grain::kNeighbours)));
  forChunks(boxes.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    std::vector<uint32_t>& room = m_room[first / grain::kNeighbours];
    for (size_t b = first; b < last; ++b) {
      const uint32_t i = boxes[b].particle;
      const std::span<const uint32_t> near = neighbours.of(i, square, room);
      if (holds(around, near, i)) {
        boxes[b] = m_kept[i].box;
        m_kept[i].time = m_time;
      } else {
        boxes[b] = surfaceBoxOf(around, near, i);
        keep(around, near, boxes[b]);
      }
    }
  });
}

void SurfaceBoxes::look(const ParticleStore& store) {
  const bool same = m_last.size() == store.size();
  if (!same) {
    m_last.assign(store.size(), {});
    m_kept.assign(store.size(), {});
    m_changed.assign(store.size(), 1);
  }
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const Seen now{store.position()[i], store.id()[i], store.body()[i], store.motion()[i]};
      m_changed[i] = same && now == m_last[i] ? 0 : 1;
      m_last[i] = now;
    }
  });
}

/// Those that are near now were within reach before, as neither they nor the particle have moved: as many are the same.
bool SurfaceBoxes::holds(const SurfaceSurroundings& around, std::span<const uint32_t> near, uint32_t particle) const {
  const Kept& kept = m_kept[particle];
  if (kept.time + 1 != m_time || kept.neighbours == 0 || kept.neighbours != near.size() || m_changed[particle] != 0)
    return false;
  if (kept.open != around.surface.open(particle)) return false;
  // How much is filled follows from temperatures too; it says where a turned cube's front is, and nothing else.
  if (kept.box.turned && (kept.filled != around.filled[particle] || kept.area != around.surface.area(particle)))
    return false;
  return std::none_of(near.begin(), near.end(), [&](uint32_t j) { return m_changed[j] != 0; });
}

void SurfaceBoxes::keep(const SurfaceSurroundings& around, std::span<const uint32_t> near, const SurfaceBox& box) {
  const uint32_t i = box.particle, neighbours = box.asksTemperature ? 0 : static_cast<uint32_t>(near.size());
  m_kept[i] = {box, around.surface.open(i), around.surface.area(i), around.filled[i], neighbours, m_time};
}

}  // namespace ps
