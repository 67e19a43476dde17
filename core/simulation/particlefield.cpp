// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/particlefield.h"

#include "core/particles/particlestore.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/measure.h"
#include "core/simulation/snapshot.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ps {
namespace {

double speedOf(const ParticleStore& s, size_t i) { return std::sqrt(squaredSpeed(s.velocity()[i])); }

/// Mass over the volume that it has at rest, and by how much it is denser than that.
double densityOf(const ParticleStore& s, size_t i) {
  const double volume = double{s.position()[i].w};
  return volume > 0 ? double{s.mass()[i]} / volume * (1 + double{s.densityError()[i]}) : 0;
}

/// Colours for bodies are few: the ninth has the first one's.
constexpr uint32_t kBodyColours = 8;

std::vector<ParticleField> ownRows() {
  return {
      {.name = "temperature",
       .label = "Temperature",
       .unit = "K",
       .inStore = [](const ParticleStore& s, size_t i) { return s.temperature()[i]; },
       .inSnapshot = [](const Snapshot& s, size_t i) { return s.temperature[i]; }},
      {.name = "phase",
       .label = "Phase",
       .unit = "1",
       .maximum = 4,
       .classes = true,
       .inStore = [](const ParticleStore& s, size_t i) { return static_cast<double>(s.phase()[i]); },
       .inSnapshot = [](const Snapshot& s, size_t i) { return static_cast<float>(s.phase[i]); }},
      {.name = "speed",
       .label = "Speed",
       .unit = "m/s",
       .least = 0.05,  // slower than that everything counts as at rest
       .inStore = speedOf,
       .inSnapshot = [](const Snapshot& s, size_t i) { return s.speed[i]; }},
      {.name = "density_error",
       .label = "Density error",
       .unit = "1",
       .help = "how much denser liquid is than it should be",
       .minimum = -0.05,
       .maximum = 0.05,
       .inner = true,
       .inStore = [](const ParticleStore& s, size_t i) { return double{s.densityError()[i]}; },
       .inSnapshot = [](const Snapshot& s, size_t i) { return s.densityError[i]; }},
      {.name = "density", .label = "Density", .unit = "kg/m³", .inner = true, .inStore = densityOf},
      {.name = "pressure",
       .label = "Pressure",
       .unit = "Pa",
       .help = "of liquid and vapour above the air's, by what keeps them from being compressed; the mean of a frame",
       .inner = true,
       .inStore = [](const ParticleStore& s, size_t i) { return double{s.pressure()[i]}; }},
      {.name = "solid_fraction",
       .label = "Solid share",
       .unit = "1",
       .maximum = 1,
       .inStore = [](const ParticleStore& s, size_t i) { return double{s.solidFraction()[i]}; }},
      {.name = "liquid_fraction",
       .label = "Liquid share",
       .unit = "1",
       .maximum = 1,
       .inStore = [](const ParticleStore& s, size_t i) { return double{s.liquidFraction()[i]}; }},
      {.name = "gas_fraction",
       .label = "Vapour share",
       .unit = "1",
       .maximum = 1,
       .inStore = [](const ParticleStore& s, size_t i) { return double{s.gasFraction()[i]}; },
       .inSnapshot = [](const Snapshot& s, size_t i) { return s.gasFraction[i]; }},
      {.name = "body",
       .label = "Body",
       .unit = "1",
       .help = "which body it was made by; colours come again after eight",
       .maximum = kBodyColours - 1,
       .classes = true,
       .bodies = true,
       .inStore = [](const ParticleStore& s, size_t i) { return static_cast<double>(s.body()[i] % kBodyColours); },
       .inSnapshot = [](const Snapshot& s, size_t i) { return static_cast<float>(s.body[i] % kBodyColours); }},
  };
}

const std::vector<FieldPtr>& ownFields() {
  static const std::vector<FieldPtr> all = [] {
    std::vector<FieldPtr> list;
    for (ParticleField& row : ownRows()) list.push_back(std::make_shared<const ParticleField>(std::move(row)));
    return list;
  }();
  return all;
}

Quantity mean(const char* key, const char* label, const char* unit) { return {key, label, unit, true}; }

/// What is not of a field.
std::vector<Quantity> wholeQuantities() {
  std::vector<Quantity> all{
      {"mass", "Mass", "kg"},
      {"count", "Particles", "1"},
      {"pieces", "Pieces of solid matter", "1"},
      {"solid_mass", "Solid mass", "kg"},
      {"melting_mass", "Melting mass", "kg"},
      {"liquid_mass", "Liquid mass", "kg"},
      {"boiling_mass", "Boiling mass", "kg"},
      {"gas_mass", "Gas mass", "kg"},
      mean("height", "Mean height", "m"),
      {"height_max", "Highest point", "m"},
      {"thermal_energy", "Thermal energy", "J"},
      {"kinetic_energy", "Kinetic energy", "J"},
      mean("compression", "Mean compression", "1"),
      {"compression_max", "Highest compression", "1"},
      {"outside", "Particles beyond a wall", "1"},
      {"gap", "Distance to other bodies", "m"},
  };
  for (const std::string axis : {"x", "y", "z"}) {
    const auto add = [&](const std::string& key, const std::string& end, const std::string& label, const char* unit,
                         bool isMean = false) {
      all.push_back({key + "_" + axis + end, label + " along " + axis, unit, isMean});
    };
    add("position", "", "Mean place", "m", true);
    add("position", "_min", "Lowest place", "m");
    add("position", "_max", "Highest place", "m");
    add("extent", "", "Length", "m");
    add("front", "", "Front", "m");
    add("velocity", "", "Mean velocity", "m/s", true);
    add("velocity", "_min", "Lowest velocity", "m/s");
    add("velocity", "_max", "Highest velocity", "m/s");
    add("momentum", "", "Momentum", "kg·m/s");
    all.push_back({"angular_momentum_" + axis, "Angular momentum about " + axis, "kg·m²/s"});
    add("force", "", "Force", "N");
    all.push_back({"torque_" + axis, "Torque about " + axis, "N·m"});
    all.push_back({"spin_" + axis, "Spin about " + axis, "rad/s"});
  }
  return all;
}

/// "Mean specific enthalpy": a label within a phrase.
std::string phrase(const char* before, std::string label) {
  const bool word = label.size() > 1 && label[1] >= 'a' && label[1] <= 'z';  // no "pH", no "XSPH share"
  if (word && label[0] >= 'A' && label[0] <= 'Z') label[0] = static_cast<char>(label[0] - 'A' + 'a');
  return before + (" " + label);
}

auto named(const std::vector<FieldPtr>& fields, std::string_view name) {
  return std::find_if(fields.begin(), fields.end(), [&](const FieldPtr& field) { return field->name == name; });
}

}  // namespace

ParticleFields::ParticleFields() : m_quantities(wholeQuantities()) {
  for (const FieldPtr& field : ownFields()) add(field);
}

void ParticleFields::add(FieldPtr field) {
  if (!field->classes) {
    using Of = Quantity::Of;
    for (const auto& [of, words, end] : {std::tuple{Of::Mean, "Mean", ""}, std::tuple{Of::Least, "Lowest", "_min"},
                                         std::tuple{Of::Most, "Highest", "_max"}})
      m_quantities.push_back({field->name + end, phrase(words, field->label), field->unit, of == Of::Mean, field, of});
  }
  m_all.push_back(std::move(field));
}

ParticleFields::ParticleFields(const PluginRegistry& plugins) : ParticleFields() {
  for (const api::FieldDeclaration& f : plugins.fields()) {
    if (!*f.label || find(f.name)) continue;  // plugins of the program share some
    ParticleField field{.name = f.name, .label = f.label, .unit = *f.unit ? f.unit : "1", .help = f.help};
    field.minimum = f.minimum, field.maximum = f.maximum;
    field.type = f.type;
    add(std::make_shared<const ParticleField>(std::move(field)));
  }
}

FieldPtr ParticleFields::find(std::string_view name) const {
  const auto found = named(m_all, name);
  return found == m_all.end() ? nullptr : *found;
}

std::vector<std::string> ParticleFields::names() const {
  std::vector<std::string> all;
  for (const FieldPtr& field : m_all) all.push_back(field->name);
  return all;
}

bool isForce(std::string_view quantity) { return quantity.starts_with("force_") || quantity.starts_with("torque_"); }

std::vector<std::string> colourNames(const ParticleFields& fields) {
  std::vector<std::string> all = fields.names();
  all.insert(all.begin(), kMatterColour);
  return all;
}

const Quantity* ParticleFields::quantity(std::string_view key) const {
  const auto found =
      std::find_if(m_quantities.begin(), m_quantities.end(), [&](const Quantity& q) { return q.key == key; });
  return found == m_quantities.end() ? nullptr : &*found;
}

std::vector<std::string> ParticleFields::quantityNames() const {
  std::vector<std::string> all;
  for (const Quantity& q : m_quantities) all.push_back(q.key);
  return all;
}

std::string ParticleFields::unitOf(std::string_view key) const {
  const Quantity* found = quantity(key);
  return found ? found->unit : "";
}

StoredField::StoredField(const ParticleField& field, const ParticleStore& store)
    : m_store(store),
      m_inStore(field.inStore),
      m_type(field.type),
      m_data(m_inStore ? nullptr : store.read(field.name.c_str(), field.type)) {}

double StoredField::operator[](size_t i) const {
  if (m_inStore) return m_inStore(m_store, i);
  switch (m_type) {
    case api::FieldType::Float32:
      return static_cast<const float*>(m_data)[i];
    case api::FieldType::Float64:
      return static_cast<const double*>(m_data)[i];
    case api::FieldType::UInt8:
      return static_cast<const uint8_t*>(m_data)[i];
    case api::FieldType::UInt32:
      return static_cast<const uint32_t*>(m_data)[i];
    case api::FieldType::Float4:
      break;  // is none that is shown
  }
  return 0;
}

bool everySnapshotHas(std::string_view name) {
  const auto own = named(ownFields(), name);
  return own != ownFields().end() && (*own)->inSnapshot;
}

ShownField::ShownField(const Snapshot& snapshot, std::string_view name) : m_snapshot(snapshot) {
  for (const FieldValues& shown : snapshot.fields) {
    if (shown.field->name != name) continue;
    m_field = shown.field.get();
    m_values = shown.values.data();
    return;
  }
  if (everySnapshotHas(name)) m_field = named(ownFields(), name)->get();
}

}  // namespace ps
