// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/contact/nearneighbours.h"
#include "core/solver/heat/surfacebox.h"

#include <cstdint>
#include <vector>

namespace ps {

/// Boxes of many particles, frame by frame. Moulds, ladles and floors stand still: a box is kept from frame to frame
/// while nothing has changed that it was found from. It is the one that would be found anew, to the bit, so that what
/// is kept is no state.
class SurfaceBoxes {
 public:
  /// Walls or numbers have changed.
  void forget() { m_last.clear(); }
  /// Finds again the boxes of `boxes`, whose particles are given.
  void find(const SurfaceSurroundings& around, const api::NeighbourView& lists, std::span<SurfaceBox> boxes);

 private:
  /// What others saw of a particle in the last frame.
  struct Seen {
    api::Float4 at;
    uint32_t id = 0, body = 0;
    api::Motion motion = api::Motion::Gas;
    bool operator==(const Seen& other) const {
      return at.x == other.at.x && at.y == other.at.y && at.z == other.at.z && id == other.id && body == other.body &&
             motion == other.motion;
    }
  };
  /// A box, and what it was found from beside what its neighbours are.
  struct Kept {
    SurfaceBox box;
    uint64_t open = 0;
    double area = 0;  ///< m2
    float filled = 0;
    uint32_t neighbours = 0;  ///< within reach; 0: none, or it changes by itself
    uint64_t time = 0;        ///< of m_time, when it was found or held last
  };
  void look(const ParticleStore& store);
  bool holds(const SurfaceSurroundings& around, std::span<const uint32_t> near, uint32_t particle) const;
  void keep(const SurfaceSurroundings& around, std::span<const uint32_t> near, const SurfaceBox& box);

  uint64_t m_time = 0;                        ///< calls of find()
  std::vector<Seen> m_last;                   ///< by particle
  std::vector<Kept> m_kept;                   ///< by particle
  std::vector<uint8_t> m_changed;             ///< by particle: is not what it was in the last frame
  std::vector<std::vector<uint32_t>> m_room;  ///< by chunk
};

}  // namespace ps
