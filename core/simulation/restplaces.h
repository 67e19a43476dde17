// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// Where the particles of sketches were made, by their ids: in m on the lattice, where their body is drawn on it,
/// before it was turned. What becomes of a particle later changes nothing of it. A value; copies share what they hold.
class RestPlaces {
 public:
  using Place = std::array<float, 3>;
  /// `ids` ascend, and none of them is known.
  void add(std::span<const uint32_t> ids, std::span<const Place> places);
  /// Their body is drawn elsewhere on its lattice by now, this far off, in m. `ids` ascend; those that are not known
  /// are left out.
  void shift(std::span<const uint32_t> ids, const Vector3& way);
  /// Nothing: it is no particle of a sketch, or its state knew nothing of where it was made.
  std::optional<Vector3> of(uint32_t id) const;
  bool empty() const { return m_runs.empty(); }

  void save(StateWriter& writer) const;  ///< nothing at all where it is empty
  /// What a state knows, which may be nothing. Throws InputError for what is damaged.
  static RestPlaces read(const StateReader& reader);

 private:
  /// Particles of consecutive ids.
  struct Run {
    uint32_t first = 0;
    std::shared_ptr<const std::vector<Place>> places;
    uint32_t end() const { return first + static_cast<uint32_t>(places->size()); }
  };
  std::vector<Run> m_runs;  ///< by their ids
};

}  // namespace ps
