// SPDX-License-Identifier: Apache-2.0
#include "ui/document/particlecopy.h"

#include "core/simulation/engine.h"

#include <cstring>
#include <map>
#include <tuple>

namespace ps {
namespace {

size_t sizeOf(api::FieldType type) {
  switch (type) {
    case api::FieldType::Float32:
    case api::FieldType::UInt32:
      return 4;
    case api::FieldType::Float64:
      return 8;
    case api::FieldType::UInt8:
      return 1;
    case api::FieldType::Float4:
      return 16;
  }
  return 0;
}

template <class T>
T valueOf(const ParticleCopy& copy, const char* name, size_t index) {
  T value{};
  for (const ParticleCopy::Field& field : copy.fields) {
    if (field.name == name) std::memcpy(&value, field.bytes.data() + index * sizeof(T), sizeof(T));
  }
  return value;
}

/// Particles that one Spawn can make: of one body, material, and way of moving.
using Group = std::tuple<uint32_t, uint32_t, bool>;

std::map<Group, std::vector<size_t>> groupsOf(const ParticleCopy& copy) {
  std::map<Group, std::vector<size_t>> groups;
  for (size_t i = 0; i < copy.ids.size(); ++i) {
    groups[{valueOf<uint32_t>(copy, field::kBody, i), valueOf<uint32_t>(copy, field::kMaterial, i),
            valueOf<api::Motion>(copy, field::kMotion, i) == api::Motion::Static}]
        .push_back(i);
  }
  return groups;
}

}  // namespace

ParticleCopy copyParticles(Engine& engine, const std::vector<uint32_t>& ids) {
  const ParticleStore& store = engine.solver().particles();
  ParticleCopy copy;
  std::vector<size_t> rows;
  for (const uint32_t id : ids) {
    const size_t row = store.indexOf(id);
    if (row >= store.size()) continue;
    rows.push_back(row);
    copy.ids.push_back(id);
  }
  for (const ParticleStore::FieldInfo& info : store.fields()) {
    const auto* data = static_cast<const std::byte*>(store.find(info.name.c_str(), info.type));
    const size_t size = sizeOf(info.type);
    ParticleCopy::Field field{info.name, info.type, std::vector<std::byte>(rows.size() * size)};
    for (size_t i = 0; i < rows.size(); ++i) std::memcpy(field.bytes.data() + i * size, data + rows[i] * size, size);
    copy.fields.push_back(std::move(field));
  }
  return copy;
}

std::vector<uint32_t> restoreParticles(Engine& engine, const ParticleCopy& copy) {
  std::vector<uint32_t> born;
  for (const auto& [group, rows] : groupsOf(copy)) {
    Spawn spawn;
    std::tie(spawn.body, spawn.material, spawn.fixed) = group;
    spawn.temperature = valueOf<double>(copy, field::kTemperature, rows.front());
    spawn.phase = valueOf<api::Phase>(copy, field::kPhase, rows.front());
    for (const size_t row : rows) {
      const auto p = valueOf<api::Float4>(copy, field::kPosition, row);
      spawn.position.push_back({p.x, p.y, p.z});
    }
    const std::vector<uint32_t> ids = engine.solver().spawn(spawn);
    ParticleStore& store = engine.solver().particles();
    for (const ParticleCopy::Field& field : copy.fields) {
      if (field.name == field::kId) continue;
      auto* data = static_cast<std::byte*>(store.find(field.name.c_str(), field.type));
      const size_t size = sizeOf(field.type);
      for (size_t k = 0; data && k < ids.size() && k < rows.size(); ++k) {
        std::memcpy(data + store.indexOf(ids[k]) * size, field.bytes.data() + rows[k] * size, size);
      }
    }
    born.insert(born.end(), ids.begin(), ids.end());
  }
  return born;
}

}  // namespace ps
