// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <string>
#include <variant>
#include <vector>

namespace ps {

/// What one field is of all particles.
struct ParticleColumn {
  std::string name, unit;  ///< SI; "1" for a pure number
  std::variant<std::vector<float>, std::vector<uint32_t>> values;
  std::vector<std::string> names;  ///< of whole numbers that stand for something: by number
};

/// A frame's particles as a table, ascending by id.
struct ParticleTable {
  std::vector<api::Float4> position;  ///< m; w: radius of the volume at rest
  std::vector<ParticleColumn> columns;
};

/// With the columns of these names, in the order of columnNames(); all where there are none. Throws
/// Cancelled.
ParticleTable tableOf(const Snapshot& snapshot, const std::vector<std::string>& wanted);
/// Whole numbers first: id, body, material, phase, motion, then radius, and each field that the snapshot has.
std::vector<std::string> columnNames(const Snapshot& snapshot);

}  // namespace ps
