// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <phasesketch/types.h>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// The one table of the numbers that particles show. Colours, their legend and menus, probes, recordings, snapshots, the
// check of a project and the help of the command line follow from it. Another field of ours is a row in
// particlefield.cpp; a plugin's is its declaration.
namespace ps {

class ParticleStore;
class PluginRegistry;
struct Snapshot;

/// A number that every particle has.
struct ParticleField {
  std::string name{};               ///< in files and on the command line; a plugin's begins with its id
  std::string label{};              ///< "Specific enthalpy"
  std::string unit{};               ///< SI; "1" for a pure number
  std::string help{};               ///< a sentence; may be empty
  double minimum = 0, maximum = 0;  ///< ends of its scale; equal: as far as its values go
  double least = 0;                 ///< a scale that is found reaches at least so far
  bool classes = false;             ///< its values are names in order: they have no mean
  bool bodies = false;              ///< and those names are the scene's: of its bodies and taps
  bool inner = false;               ///< what matters lies within a liquid, where a surface would hide it
  /// Of ours, where it is not read as it lies in the store.
  double (*inStore)(const ParticleStore& store, size_t particle) = nullptr;
  /// Of those that every snapshot has, asked for or not.
  float (*inSnapshot)(const Snapshot& snapshot, size_t particle) = nullptr;
  api::FieldType type = api::FieldType::Float32;  ///< in the store

  bool hasScale() const { return minimum < maximum; }
};
using FieldPtr = std::shared_ptr<const ParticleField>;

/// What a probe can measure: something of matter as a whole, or of a field of its particles.
struct Quantity {
  enum class Of { Mean, Least, Most };
  std::string key, label, unit;  ///< "temperature_max", "Highest temperature", SI
  bool mean = false;             ///< of something that each particle has: a wave can be looked for in it
  FieldPtr field{};              ///< nullptr: of matter as a whole
  Of of = Of::Mean;              ///< the field
};

/// Fields: ours, in the order in which menus show them; then those that plugins declare with a label, ascending by
/// plugin. And what probes measure: each field's mean under its name, its ends with "_min" and "_max" behind it; of
/// classes nothing.
class ParticleFields {
 public:
  ParticleFields();  ///< ours alone
  explicit ParticleFields(const PluginRegistry& plugins);
  const std::vector<FieldPtr>& all() const { return m_all; }
  FieldPtr find(std::string_view name) const;  ///< nullptr: there is none
  std::vector<std::string> names() const;

  const std::vector<Quantity>& quantities() const { return m_quantities; }
  const Quantity* quantity(std::string_view key) const;  ///< nullptr: there is none
  std::vector<std::string> quantityNames() const;
  /// SI: "K", "kg", "1" for counts; "" for what is no quantity.
  std::string unitOf(std::string_view quantity) const;

 private:
  void add(FieldPtr field);
  std::vector<FieldPtr> m_all;
  std::vector<Quantity> m_quantities;
};

/// Whether a quantity is one of force or torque: on a body or a wall as a whole.
bool isForce(std::string_view quantity);

/// Phases as files name them, by api::Phase.
inline constexpr std::array<const char*, 5> kPhaseNames{"solid", "melting", "liquid", "boiling", "gas"};

/// What colours may mean: the matter itself ("material"), and each field.
inline constexpr const char* kMatterColour = "material";
std::vector<std::string> colourNames(const ParticleFields& fields);

/// A field of particles as they are now. Good until the store changes.
class StoredField {
 public:
  StoredField(const ParticleField& field, const ParticleStore& store);
  explicit operator bool() const { return m_inStore || m_data; }  ///< false: nothing in the scene keeps it
  double operator[](size_t particle) const;

 private:
  const ParticleStore& m_store;
  double (*m_inStore)(const ParticleStore&, size_t);
  api::FieldType m_type;
  const void* m_data;
};

/// By name: one that no snapshot is without.
bool everySnapshotHas(std::string_view name);

/// A field in a snapshot, by name. Good as long as the snapshot is.
class ShownField {
 public:
  ShownField(const Snapshot& snapshot, std::string_view name);
  explicit operator bool() const { return m_field != nullptr; }  ///< false: the snapshot has none of that name
  const ParticleField& field() const { return *m_field; }
  float operator[](size_t particle) const {
    return m_values ? m_values[particle] : m_field->inSnapshot(m_snapshot, particle);
  }

 private:
  const Snapshot& m_snapshot;
  const ParticleField* m_field = nullptr;
  const float* m_values = nullptr;
};

}  // namespace ps
