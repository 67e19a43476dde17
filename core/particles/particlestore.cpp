// SPDX-License-Identifier: Apache-2.0
#include "core/particles/particlestore.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/particles/colourfield.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace ps {
namespace {

constexpr size_t kAlignment = 64;
constexpr size_t kSpareEntries = 16;  // behind size(): the dummy, and room for whole vectors

/// Where the dummy particle lies, m: far from everything, and its distance squared still fits a float.
constexpr float kFarAway = 1e8f;

/// Numbers that particles may have had: what is read from a file may ask for no more memory than these need.
constexpr uint32_t kMostIds = 1u << 28;
constexpr const char* kFieldRoom = "field";  // of state blocks

struct OwnField {
  const char* name;
  api::FieldType type;
  const char *unit, *help;
};
constexpr OwnField kOwnFields[] = {
    {field::kPosition, api::FieldType::Float4, "m", "Position; fourth component: rest volume in m³"},
    {field::kPrevious, api::FieldType::Float4, "m", "Position at the start of the substep"},
    {field::kVelocity, api::FieldType::Float4, "m/s", "Velocity; fourth component: inverse mass in 1/kg"},
    {field::kMass, api::FieldType::Float32, "kg", "Mass, constant for life"},
    {field::kId, api::FieldType::UInt32, "", "Number of the particle, stable for life"},
    {field::kMaterial, api::FieldType::UInt32, "", "Index into the material table"},
    {field::kBody, api::FieldType::UInt32, "", "Index of the body that it was made by"},
    {field::kPhase, api::FieldType::UInt8, "", "Solid, melting, liquid, boiling or gas"},
    {field::kMotion, api::FieldType::UInt8, "", "How it moves: held by structure, liquid, gas, as prescribed"},
    {field::kTemperature, api::FieldType::Float64, "K", "Temperature"},
    {field::kSolidFraction, api::FieldType::Float32, "", "Share of the mass that is solid"},
    {field::kLiquidFraction, api::FieldType::Float32, "", "Share of the mass that is liquid"},
    {field::kGasFraction, api::FieldType::Float32, "", "Share of the mass that is vapour"},
    {field::kCompression, api::FieldType::Float32, "",
     "Handed over when it melted: compression; when it froze: overlap, in spacings, -1 until it is known"},
    {field::kDensityError, api::FieldType::Float32, "", "Relative excess density at the end of the frame"},
    {field::kPressure, api::FieldType::Float32, "Pa", "Pressure of liquid and vapour, mean of the last frame"},
};

/// What earlier versions kept, and states of theirs hold.
constexpr std::string_view kFormerFields[] = {"lambda"};

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

StateType stateTypeOf(api::FieldType type) {
  switch (type) {
    case api::FieldType::Float32:
      return StateType::Float32;
    case api::FieldType::Float64:
      return StateType::Float64;
    case api::FieldType::UInt8:
      return StateType::UInt8;
    case api::FieldType::UInt32:
      return StateType::UInt32;
    case api::FieldType::Float4:
      return StateType::Float4;
  }
  throw Error("a particle field of an unknown type");
}

api::FieldType fieldTypeOf(const StateReader::Block& block) {
  for (const auto type : {api::FieldType::Float32, api::FieldType::Float64, api::FieldType::UInt8,
                          api::FieldType::UInt32, api::FieldType::Float4}) {
    if (stateTypeOf(type) == block.type) return type;
  }
  StateReader::fail(block.name, "is of a type that fields do not have");
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

/// Elements [first, last) of `out`.
void gatherBySize(size_t elementSize, const std::byte* in, std::byte* out, std::span<const uint32_t> whole,
                  size_t first, size_t last) {
  const std::span<const uint32_t> order = whole.subspan(first, last - first);
  out += first * elementSize;
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
  for (const OwnField& f : kOwnFields) declare(f.name, f.type, f.unit, f.help);
}

ParticleStore::~ParticleStore() = default;
ParticleStore::ParticleStore(ParticleStore&&) noexcept = default;
ParticleStore& ParticleStore::operator=(ParticleStore&&) noexcept = default;

void ParticleStore::declare(std::string_view name, api::FieldType type, std::string_view unit, std::string_view help) {
  for (const auto& f : m_fields) {
    if (f->info.name != name) continue;
    if (f->info.type != type) throw Error("particle field '" + f->info.name + "' is declared with two different types");
    if (f->info.help.empty()) f->info.unit = unit, f->info.help = help;  // known from a saved state alone
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

void* ParticleStore::find(const char* name, api::FieldType type) noexcept {
  return const_cast<void*>(read(name, type));  // the store's own
}

const void* ParticleStore::read(const char* name, api::FieldType type) const noexcept {
  const std::string_view wanted(name);
  for (const auto& f : m_fields) {
    if (f->info.type == type && f->info.name == wanted) return f->data.get();
  }
  return nullptr;
}

void* ParticleStore::write(const char* name, api::FieldType type) const noexcept {
  const std::string_view wanted(name);
  for (size_t k = std::size(kOwnFields); k < m_fields.size(); ++k) {
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
  set(m_pressure, field::kPressure, Float32);
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
    const size_t bytes = f->elementSize;
    std::byte *const data = f->data.get(), *const scratch = m_scratch.get();
    forChunks(m_size, grain::kNumbers,
              [&](size_t first, size_t last) { gatherBySize(bytes, data, scratch, order, first, last); });
    forChunks(m_size, grain::kNumbers, [&](size_t first, size_t last) {
      std::memcpy(data + first * bytes, scratch + first * bytes, (last - first) * bytes);
    });
  }
  forChunks(m_size, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_indexOfId[m_id[i]] = static_cast<uint32_t>(i);
  });
}

size_t ParticleStore::indexOf(uint32_t id) const {
  return id < m_indexOfId.size() && m_indexOfId[id] < m_size && m_id[m_indexOfId[id]] == id ? m_indexOfId[id] : m_size;
}

std::vector<uint32_t> ParticleStore::indicesOf(std::span<const uint32_t> ids) const {
  std::vector<uint32_t> indices;
  for (const uint32_t id : ids) {
    if (const size_t i = indexOf(id); i < m_size) indices.push_back(static_cast<uint32_t>(i));
  }
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

api::ParticleView ParticleStore::view() const {
  return {m_size,           m_position,    m_previous,    m_velocity,
          m_mass,           m_id,          m_material,    m_body,
          m_phase,          m_motion,      m_temperature, m_solidFraction,
          m_liquidFraction, m_gasFraction, this,          {m_period.length(0), m_period.length(1), m_period.length(2)}};
}

void ParticleStore::save(StateWriter& writer) const {
  writer.value("particles/count", uint64_t{m_size});
  writer.value("particles/next_id", m_nextId);
  for (const auto& f : m_fields) {
    const std::byte* first = f->data.get();
    const auto isZero = [](std::byte value) { return value == std::byte{0}; };
    if (f->info.name == kColourField && std::all_of(first, first + m_size * f->elementSize, isZero)) continue;
    writer.open({kFieldRoom, f->info.name}, stateTypeOf(f->info.type), m_size);
    writer.put(f->data.get(), m_size * f->elementSize);
    writer.close();
  }
}

void ParticleStore::restore(const StateReader& reader) {
  const auto count = reader.value<uint64_t>("particles/count");
  const auto nextId = reader.value<uint32_t>("particles/next_id");
  if (nextId > kMostIds) StateReader::fail("particles/next_id", "is beyond " + std::to_string(kMostIds));
  if (count > nextId) StateReader::fail("particles/count", "is more than there were numbers given");
  m_size = static_cast<size_t>(count);
  m_nextId = nextId;
  if (m_size > m_capacity) {
    m_capacity = m_size;
    for (const auto& f : m_fields) f->data.reset(allocateZeroed((m_capacity + kSpareEntries) * f->elementSize));
  }
  readFields(reader);
  refreshPointers();
  writeDummy();
  checkValues();
  indexIds();
}

/// Fields take the order that they were saved in; those that were not are zero, behind them.
void ParticleStore::readFields(const StateReader& reader) {
  for (const OwnField& own : kOwnFields) {
    if (!reader.has({kFieldRoom, own.name})) StateReader::fail({kFieldRoom, own.name}, "is missing");
  }
  std::vector<std::unique_ptr<Field>> former = std::move(m_fields);
  m_fields.clear();
  const std::string room = StateName(kFieldRoom, "").text();
  for (const StateReader::Block& block : reader.blocks()) {
    if (!block.name.starts_with(room)) continue;
    const std::string name = block.name.substr(room.size());
    if (std::find(std::begin(kFormerFields), std::end(kFormerFields), name) != std::end(kFormerFields)) continue;
    const api::FieldType type = fieldTypeOf(block);
    auto known = std::find_if(former.begin(), former.end(), [&](const auto& f) { return f && f->info.name == name; });
    if (known != former.end()) {
      if ((*known)->info.type != type) StateReader::fail(block.name, "is of another type than here");
      m_fields.push_back(std::move(*known));
    } else {
      auto fresh = std::make_unique<Field>();
      fresh->info = {name, {}, {}, type};
      fresh->elementSize = sizeOf(type);
      fresh->data.reset(allocateZeroed((m_capacity + kSpareEntries) * fresh->elementSize));
      m_fields.push_back(std::move(fresh));
    }
    reader.read(block.name, block.type, m_fields.back()->data.get(), m_size);
  }
  for (size_t k = 0; k < std::size(kOwnFields); ++k) {
    if (m_fields[k]->info.name != kOwnFields[k].name)
      StateReader::fail({kFieldRoom, m_fields[k]->info.name}, "stands before fields of the program");
  }
  for (auto& f : former) {
    if (!f) continue;
    std::memset(f->data.get(), 0, m_size * f->elementSize);
    m_fields.push_back(std::move(f));
  }
}

void ParticleStore::checkValues() const {
  for (size_t i = 0; i < m_size; ++i) {
    if (m_phase[i] > api::Phase::Gas) StateReader::fail({kFieldRoom, field::kPhase}, "has a phase that there is not");
    if (m_motion[i] > api::Motion::Static)
      StateReader::fail({kFieldRoom, field::kMotion}, "has a motion that there is not");
  }
}

void ParticleStore::indexIds() {
  constexpr uint32_t kGone = ~0u;
  m_indexOfId.assign(m_nextId, kGone);
  for (size_t i = 0; i < m_size; ++i) {
    if (m_id[i] >= m_nextId) StateReader::fail({kFieldRoom, field::kId}, "has a number that was never given");
    if (m_indexOfId[m_id[i]] != kGone) StateReader::fail({kFieldRoom, field::kId}, "has a number twice");
    m_indexOfId[m_id[i]] = static_cast<uint32_t>(i);
  }
}

}  // namespace ps
