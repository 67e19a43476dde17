// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace ps {

class Engine;

/// Particles with all their fields, by name: what an undone erasure puts back.
struct ParticleCopy {
  struct Field {
    std::string name;
    api::FieldType type = api::FieldType::Float32;
    std::vector<std::byte> bytes;  ///< one entry per particle, as in the store
  };
  std::vector<uint32_t> ids;
  std::vector<Field> fields;
};

/// Copies live particles; ids already gone are left out. Engine thread.
ParticleCopy copyParticles(Engine& engine, const std::vector<uint32_t>& ids);
/// Puts particles back where they were taken with every field but the id; returns their new ids. Engine thread.
std::vector<uint32_t> restoreParticles(Engine& engine, const ParticleCopy& copy);

}  // namespace ps
