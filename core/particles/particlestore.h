// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/period.h"

#include <phasesketch/views.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// Names of the fields that core itself keeps (types in brackets). All are sorted, hashed, put in snapshots alike.
namespace field {
inline constexpr const char* kPosition = "position";               ///< Float4: m; w: rest volume, m3
inline constexpr const char* kPrevious = "previous";               ///< Float4: m, start of the substep
inline constexpr const char* kVelocity = "velocity";               ///< Float4: m/s; w: inverse mass, 1/kg
inline constexpr const char* kMass = "mass";                       ///< Float32: kg
inline constexpr const char* kId = "id";                           ///< UInt32
inline constexpr const char* kMaterial = "material";               ///< UInt32: index into the material table
inline constexpr const char* kBody = "body";                       ///< UInt32: index of the body it was made by
inline constexpr const char* kPhase = "phase";                     ///< UInt8: api::Phase
inline constexpr const char* kMotion = "motion";                   ///< UInt8: api::Motion
inline constexpr const char* kTemperature = "temperature";         ///< Float64: K
inline constexpr const char* kSolidFraction = "solid_fraction";    ///< Float32
inline constexpr const char* kLiquidFraction = "liquid_fraction";  ///< Float32
inline constexpr const char* kGasFraction = "gas_fraction";        ///< Float32
inline constexpr const char* kCompression = "compression_offset";  ///< Float32: see core/solver/contact/handover.h
inline constexpr const char* kDensityError = "density_error";      ///< Float32: C of the last iteration
inline constexpr const char* kPressure = "pressure";               ///< Float32: Pa, mean of the last frame
}  // namespace field

/// Particles outside a store: what undo keeps of what was erased.
struct CopiedParticles {
  std::vector<uint32_t> id;
  std::map<std::string, std::vector<std::byte>> fields;  ///< by name, one element per particle
};

/// Particles as structure of arrays: a registry of named, typed fields. Every array is 64-byte aligned and has at least
/// 16 entries more than size(): entry size() is a dummy far away with zero volume, for padded neighbour lists.
/// Adding or removing particles may move the arrays; indices change when the store is sorted, ids never.
class ParticleStore final : public api::FieldAccess {
 public:
  ParticleStore();
  ~ParticleStore();
  ParticleStore(ParticleStore&&) noexcept;
  ParticleStore& operator=(ParticleStore&&) noexcept;

  size_t size() const { return m_size; }

  /// Adds a field, zero for all particles; the same declaration again does nothing.
  /// Throws ps::Error for another type under a known name.
  void declare(std::string_view name, api::FieldType type, std::string_view unit = "", std::string_view help = "");
  struct FieldInfo {
    std::string name, unit, help;
    api::FieldType type;
  };
  /// In order of declaration.
  std::vector<FieldInfo> fields() const;
  void* find(const char* name, api::FieldType type) noexcept;
  const void* read(const char* name, api::FieldType type) const noexcept override;
  void* write(const char* name, api::FieldType type) const noexcept override;

  /// How the space around the particles repeats itself; open at first.
  const Period& period() const { return m_period; }
  void setPeriod(const Period& period) { m_period = period; }
  /// From particle j to particle i, of the nearest images of the two; in m, w is 0.
  api::Float4 separation(size_t i, size_t j) const {
    const api::Float4 &a = m_position[i], &b = m_position[j];
    api::Float4 d{a.x - b.x, a.y - b.y, a.z - b.z, 0};
    m_period.shorten(d.x, d.y, d.z);
    return d;
  }
  /// Position of a particle in m, or of its image within the periodic box.
  api::Double3 wrappedPosition(size_t i) const {
    return m_period.wrapped({m_position[i].x, m_position[i].y, m_position[i].z});
  }

  /// What a store holds may be changed by whoever may change the store.
  api::Float4* position() { return m_position; }
  api::Float4* previous() { return m_previous; }
  api::Float4* velocity() { return m_velocity; }
  float* mass() { return m_mass; }
  uint32_t* id() { return m_id; }
  uint32_t* material() { return m_material; }
  uint32_t* body() { return m_body; }
  api::Phase* phase() { return m_phase; }
  api::Motion* motion() { return m_motion; }
  double* temperature() { return m_temperature; }
  float* solidFraction() { return m_solidFraction; }
  float* liquidFraction() { return m_liquidFraction; }
  float* gasFraction() { return m_gasFraction; }
  float* compression() { return m_compression; }
  float* densityError() { return m_densityError; }
  float* pressure() { return m_pressure; }
  const api::Float4* position() const { return m_position; }
  const api::Float4* previous() const { return m_previous; }
  const api::Float4* velocity() const { return m_velocity; }
  const float* mass() const { return m_mass; }
  const uint32_t* id() const { return m_id; }
  const uint32_t* material() const { return m_material; }
  const uint32_t* body() const { return m_body; }
  const api::Phase* phase() const { return m_phase; }
  const api::Motion* motion() const { return m_motion; }
  const double* temperature() const { return m_temperature; }
  const float* solidFraction() const { return m_solidFraction; }
  const float* liquidFraction() const { return m_liquidFraction; }
  const float* gasFraction() const { return m_gasFraction; }
  const float* compression() const { return m_compression; }
  const float* densityError() const { return m_densityError; }
  const float* pressure() const { return m_pressure; }

  /// Appends `count` particles with all fields zero and fresh ids; returns the index of the first.
  size_t add(size_t count);
  /// Removes the particles at these ascending indices, keeping the order of the others.
  void remove(std::span<const uint32_t> ascending);
  /// Copies of particles with every field, in the order given.
  CopiedParticles copy(std::span<const uint32_t> indices) const;
  /// Appends copies under their old ids, which must not be alive; returns the index of the first. Fields declared since
  /// are zero, fields gone since are dropped. Throws ps::Error for an id that is alive or was never given.
  size_t putBack(const CopiedParticles& copies);
  /// Reorders all fields: new[k] = old[order[k]].
  void permute(std::span<const uint32_t> order);
  /// Index of a particle by its id, or size() when it is gone.
  size_t indexOf(uint32_t id) const;
  /// Ascending, each once, without those that are gone.
  std::vector<uint32_t> indicesOf(std::span<const uint32_t> ids) const;

  api::ParticleView view() const;
  /// All fields in order of declaration, particles in the order that they stand in: sums depend on it.
  void save(StateWriter& writer) const;
  /// Becomes the store that was saved, ids included, with the space around as it is here. Fields that were not saved
  /// are zero and come last. Throws InputError for what cannot be a store, which is then not to be used any more.
  void restore(const StateReader& reader);

 private:
  struct Field;
  void refreshPointers();
  void writeDummy();
  void readFields(const StateReader& reader);
  void indexIds();
  void checkValues() const;

  std::vector<std::unique_ptr<Field>> m_fields;  ///< core's own first
  struct AlignedDelete {
    void operator()(std::byte* p) const;
  };
  std::unique_ptr<std::byte[], AlignedDelete> m_scratch;
  size_t m_scratchBytes = 0;
  Period m_period;
  std::vector<uint32_t> m_indexOfId;
  size_t m_size = 0, m_capacity = 0;
  uint32_t m_nextId = 0;
  api::Float4 *m_position = nullptr, *m_previous = nullptr, *m_velocity = nullptr;
  float* m_mass = nullptr;
  uint32_t *m_id = nullptr, *m_material = nullptr, *m_body = nullptr;
  api::Phase* m_phase = nullptr;
  api::Motion* m_motion = nullptr;
  double* m_temperature = nullptr;
  float *m_solidFraction = nullptr, *m_liquidFraction = nullptr, *m_gasFraction = nullptr, *m_compression = nullptr,
        *m_densityError = nullptr, *m_pressure = nullptr;
};

}  // namespace ps
