// SPDX-License-Identifier: Apache-2.0
#include "core/particles/particlestore.h"

#include "core/base/error.h"
#include "core/base/hash.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace ps {
namespace {

constexpr size_t kAlignment = 64;
constexpr size_t kSpareEntries = 16;  // behind size(): the dummy, and room for whole vectors

/// Where the dummy particle lies, m: far from everything, and its distance squared still fits a float.
constexpr float kFarAway = 1e8f;

std::byte* allocateZeroed(size_t count) {
  void* bytes = ::operator new[](count, std::align_val_t(kAlignment));
  std::memset(bytes, 0, count);
  return static_cast<std::byte*>(bytes);
}

size_t sizeOf(api::FieldType type) {
  switch (type) {
    case api::FieldType::Float32:
      return 4;
    case api::FieldType::Float64:
      return 8;
    case api::FieldType::UInt8:
      return 1;
    case api::FieldType::UInt32:
      return 4;
    case api::FieldType::Float4:
      return 16;
  }
  throw Error("a particle field of an unknown type");
}

}  // namespace

void ParticleStore::AlignedDelete::operator()(std::byte* p) const {
  ::operator delete[](p, std::align_val_t(kAlignment));
}

struct ParticleStore::Field {
  FieldInfo info;
  size_t elementSize = 0;
  std::unique_ptr<std::byte[], AlignedDelete> data;
};

namespace {

/// Copies elements of one size by index: out[k] = in[order[k]].
template <class T>
void gather(const std::byte* in, std::byte* out, std::span<const uint32_t> order) {
  const T* from = reinterpret_cast<const T*>(in);
  T* to = reinterpret_cast<T*>(out);
  for (size_t k = 0; k < order.size(); ++k) to[k] = from[order[k]];
}

void gatherBySize(size_t elementSize, const std::byte* in, std::byte* out, std::span<const uint32_t> order) {
  switch (elementSize) {
    case 1:
      return gather<uint8_t>(in, out, order);
    case 4:
      return gather<uint32_t>(in, out, order);
    case 8:
      return gather<uint64_t>(in, out, order);
    default:
      return gather<api::Float4>(in, out, order);
  }
}

}  // namespace

ParticleStore::ParticleStore() {
  using enum api::FieldType;
  declare(field::kPosition, Float4, "m", "Position; fourth component: rest volume in m³");
  declare(field::kPrevious, Float4, "m", "Position at the start of the substep");
  declare(field::kVelocity, Float4, "m/s", "Velocity; fourth component: inverse mass in 1/kg");
  declare(field::kMass, Float32, "kg", "Mass, constant for life");
  declare(field::kId, UInt32, "", "Number of the particle, stable for life");
  declare(field::kMaterial, UInt32, "", "Index into the material table");
  declare(field::kBody, UInt32, "", "Index of the body that it was made by");
  declare(field::kPhase, UInt8, "", "Solid, melting, liquid, boiling or gas");
  declare(field::kMotion, UInt8, "", "How it moves: held by structure, liquid, gas, as prescribed");
  declare(field::kTemperature, Float64, "K", "Temperature");
  declare(field::kSolidFraction, Float32, "", "Share of the mass that is solid");
  declare(field::kLiquidFraction, Float32, "", "Share of the mass that is liquid");
  declare(field::kGasFraction, Float32, "", "Share of the mass that is vapour");
  declare(field::kCompression, Float32, "", "Compression handed over when the solid melted");
  declare(field::kLambda, Float32, "J", "Multiplier of the density constraint");
  declare(field::kDensityError, Float32, "", "Relative excess density of the last iteration");
  m_ownFields = m_fields.size();
}

ParticleStore::~ParticleStore() = default;
ParticleStore::ParticleStore(ParticleStore&&) noexcept = default;
ParticleStore& ParticleStore::operator=(ParticleStore&&) noexcept = default;

void ParticleStore::declare(std::string_view name, api::FieldType type, std::string_view unit, std::string_view help) {
  for (const auto& f : m_fields) {
    if (f->info.name != name) continue;
    if (f->info.type != type) throw Error("particle field '" + f->info.name + "' is declared with two different types");
    return;
  }
  auto f = std::make_unique<Field>();
  f->info = {std::string(name), std::string(unit), std::string(help), type};
  f->elementSize = sizeOf(type);
  f->data.reset(allocateZeroed((m_capacity + kSpareEntries) * f->elementSize));
  m_fields.push_back(std::move(f));
  refreshPointers();
  writeDummy();
}

std::vector<ParticleStore::FieldInfo> ParticleStore::fields() const {
  std::vector<FieldInfo> result;
  result.reserve(m_fields.size());
  for (const auto& f : m_fields) result.push_back(f->info);
  return result;
}

void* ParticleStore::find(const char* name, api::FieldType type) const noexcept {
  const std::string_view wanted(name);
  for (const auto& f : m_fields) {
    if (f->info.type == type && f->info.name == wanted) return f->data.get();
  }
  return nullptr;
}

void* ParticleStore::write(const char* name, api::FieldType type) const noexcept {
  const std::string_view wanted(name);
  for (size_t k = m_ownFields; k < m_fields.size(); ++k) {
    if (m_fields[k]->info.type == type && m_fields[k]->info.name == wanted) return m_fields[k]->data.get();
  }
  return nullptr;
}

void ParticleStore::refreshPointers() {
  const auto set = [this](auto*& pointer, const char* name, api::FieldType type) {
    pointer = static_cast<std::remove_reference_t<decltype(pointer)>>(find(name, type));
  };
  using enum api::FieldType;
  set(m_position, field::kPosition, Float4);
  set(m_previous, field::kPrevious, Float4);
  set(m_velocity, field::kVelocity, Float4);
  set(m_mass, field::kMass, Float32);
  set(m_id, field::kId, UInt32);
  set(m_material, field::kMaterial, UInt32);
  set(m_body, field::kBody, UInt32);
  set(m_phase, field::kPhase, UInt8);
  set(m_motion, field::kMotion, UInt8);
  set(m_temperature, field::kTemperature, Float64);
  set(m_solidFraction, field::kSolidFraction, Float32);
  set(m_liquidFraction, field::kLiquidFraction, Float32);
  set(m_gasFraction, field::kGasFraction, Float32);
  set(m_compression, field::kCompression, Float32);
  set(m_lambda, field::kLambda, Float32);
  set(m_densityError, field::kDensityError, Float32);
}

void ParticleStore::writeDummy() {
  for (const auto& f : m_fields) {
    std::memset(f->data.get() + m_size * f->elementSize, 0, kSpareEntries * f->elementSize);
  }
  for (api::Float4* points : {m_position, m_previous}) {
    if (points != nullptr) points[m_size] = {kFarAway, kFarAway, kFarAway, 0};
  }
}

size_t ParticleStore::add(size_t count) {
  const size_t first = m_size, needed = m_size + count;
  if (needed > m_capacity) {
    m_capacity = std::max(needed, m_capacity + m_capacity / 2);
    for (const auto& f : m_fields) {
      std::byte* grown = allocateZeroed((m_capacity + kSpareEntries) * f->elementSize);
      std::memcpy(grown, f->data.get(), m_size * f->elementSize);
      f->data.reset(grown);
    }
    refreshPointers();
  }
  for (const auto& f : m_fields) std::memset(f->data.get() + first * f->elementSize, 0, count * f->elementSize);
  m_size = needed;
  m_indexOfId.resize(m_nextId + count);
  for (size_t i = first; i < needed; ++i) {
    m_id[i] = m_nextId++;
    m_indexOfId[m_id[i]] = static_cast<uint32_t>(i);
  }
  writeDummy();
  return first;
}

void ParticleStore::remove(std::span<const uint32_t> ascending) {
  if (ascending.empty()) return;
  constexpr uint32_t kGone = ~0u;
  for (const uint32_t i : ascending) m_indexOfId[m_id[i]] = kGone;
  for (const auto& f : m_fields) {
    std::byte* data = f->data.get();
    const size_t element = f->elementSize;
    size_t to = ascending[0];
    for (size_t k = 0; k < ascending.size(); ++k) {  // close the gap behind each removed particle
      const size_t from = ascending[k] + size_t{1}, end = k + 1 < ascending.size() ? ascending[k + 1] : m_size;
      std::memmove(data + to * element, data + from * element, (end - from) * element);
      to += end - from;
    }
  }
  m_size -= ascending.size();
  for (size_t i = ascending[0]; i < m_size; ++i) m_indexOfId[m_id[i]] = static_cast<uint32_t>(i);
  writeDummy();
}

CopiedParticles ParticleStore::copy(std::span<const uint32_t> indices) const {
  CopiedParticles copies;
  for (const uint32_t i : indices) copies.id.push_back(m_id[i]);
  for (const auto& f : m_fields) {
    std::vector<std::byte>& bytes = copies.fields[f->info.name];
    bytes.resize(indices.size() * f->elementSize);
    for (size_t k = 0; k < indices.size(); ++k) {
      std::memcpy(bytes.data() + k * f->elementSize, f->data.get() + indices[k] * f->elementSize, f->elementSize);
    }
  }
  return copies;
}

size_t ParticleStore::putBack(const CopiedParticles& copies) {
  for (const uint32_t id : copies.id) {
    if (id >= m_nextId || indexOf(id) < m_size) throw Error("a particle cannot be put back: its number is in use");
  }
  const uint32_t nextId = m_nextId;
  const size_t first = add(copies.id.size());
  m_nextId = nextId;
  m_indexOfId.resize(nextId);
  for (const auto& f : m_fields) {
    const auto found = copies.fields.find(f->info.name);
    if (found == copies.fields.end() || found->second.size() != copies.id.size() * f->elementSize) continue;
    std::memcpy(f->data.get() + first * f->elementSize, found->second.data(), found->second.size());
  }
  for (size_t k = 0; k < copies.id.size(); ++k) {
    m_id[first + k] = copies.id[k];
    m_indexOfId[copies.id[k]] = static_cast<uint32_t>(first + k);
  }
  return first;
}

void ParticleStore::permute(std::span<const uint32_t> order) {
  if (order.size() != m_size) throw Error("a permutation of particles must name each of them once");
  if (m_scratchBytes < m_size * sizeof(api::Float4)) {
    m_scratchBytes = m_capacity * sizeof(api::Float4);
    m_scratch.reset(allocateZeroed(m_scratchBytes));
  }
  for (const auto& f : m_fields) {
    gatherBySize(f->elementSize, f->data.get(), m_scratch.get(), order);
    std::memcpy(f->data.get(), m_scratch.get(), m_size * f->elementSize);
  }
  for (size_t i = 0; i < m_size; ++i) m_indexOfId[m_id[i]] = static_cast<uint32_t>(i);
}

void ParticleStore::copyFrom(const ParticleStore& other) {
  bool same = m_fields.size() == other.m_fields.size() && m_capacity == other.m_capacity;
  for (size_t k = 0; same && k < m_fields.size(); ++k) same = m_fields[k]->info.name == other.m_fields[k]->info.name;
  if (!same) {
    m_fields.clear();
    m_capacity = other.m_capacity;
    for (const auto& f : other.m_fields) {
      auto copy = std::make_unique<Field>();
      copy->info = f->info;
      copy->elementSize = f->elementSize;
      copy->data.reset(allocateZeroed((m_capacity + kSpareEntries) * f->elementSize));
      m_fields.push_back(std::move(copy));
    }
    refreshPointers();
  }
  m_size = other.m_size;
  m_nextId = other.m_nextId;
  m_indexOfId.assign(other.m_indexOfId.begin(), other.m_indexOfId.end());
  for (size_t k = 0; k < m_fields.size(); ++k) {
    std::memcpy(m_fields[k]->data.get(), other.m_fields[k]->data.get(),
                (m_size + kSpareEntries) * m_fields[k]->elementSize);
  }
}

size_t ParticleStore::indexOf(uint32_t id) const {
  return id < m_indexOfId.size() && m_indexOfId[id] < m_size && m_id[m_indexOfId[id]] == id ? m_indexOfId[id] : m_size;
}

api::ParticleView ParticleStore::view() const {
  return {m_size,           m_position,    m_previous,    m_velocity,
          m_mass,           m_id,          m_material,    m_body,
          m_phase,          m_motion,      m_temperature, m_solidFraction,
          m_liquidFraction, m_gasFraction, this,          {m_period.length(0), m_period.length(1), m_period.length(2)}};
}

void ParticleStore::addTo(Hash& hash) const {
  std::vector<const Field*> byName;
  for (const auto& f : m_fields) byName.push_back(f.get());
  std::sort(byName.begin(), byName.end(), [](const Field* a, const Field* b) { return a->info.name < b->info.name; });
  std::vector<uint32_t> order(m_size);
  for (size_t i = 0; i < m_size; ++i) order[i] = static_cast<uint32_t>(i);
  std::sort(order.begin(), order.end(), [this](uint32_t a, uint32_t b) { return m_id[a] < m_id[b]; });
  std::vector<api::Float4> sorted(m_size + 1);
  for (const Field* f : byName) {
    std::byte* bytes = reinterpret_cast<std::byte*>(sorted.data());
    gatherBySize(f->elementSize, f->data.get(), bytes, order);
    hash.add(f->info.name.data(), f->info.name.size());
    hash.add(bytes, m_size * f->elementSize);
  }
}

}  // namespace ps
