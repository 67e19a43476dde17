// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/response.h"
#include "core/matter/phasediagram.h"
#include <phasesketch/views.h>

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ps {

/// The catalogue of material properties: key, label, unit, range, help, example, declared once and used by panels,
/// JSON, plugins and tests. Keys: density_solid, density_liquid, heat_capacity_{solid,liquid,gas},
/// conductivity_{solid,liquid,gas}, melting_temperature, solidus, liquidus, latent_heat_fusion, boiling_temperature,
/// latent_heat_vaporization, molar_mass, triple_temperature, triple_pressure, latent_heat_sublimation,
/// critical_temperature, melting_slope, expansion_linear, expansion_volumetric, youngs_modulus, poisson_ratio,
/// viscosity, yield_stress, friction_static, friction_kinetic, restitution, melt_break_fraction, freeze_bond_fraction,
/// bond_radius, emissivity, gas_volume_factor, sinters, color_red/green/blue (sRGB 0..1, how the editor draws it).
api::ParameterList propertyCatalogue();
/// Index into the catalogue, or -1.
int propertyIndex(std::string_view key);

struct Provenance {
  std::string source;
  char grade = 'C';  ///< 'A' reference data, 'B' handbook, 'C' representative
};

/// A material as a plain value: every property of the catalogue, by key. Absent ones take the catalogue's default.
struct Material {
  std::string id, label;
  std::map<std::string, Response> properties;
  std::map<std::string, Provenance> provenance;
  /// Ids of materials that it holds on to when one of the two freezes: ice to wood, wax to its wick. Either of the two
  /// may name the other.
  std::vector<std::string> adheresTo{};
};

/// A property at a temperature in K, the catalogue's default where the material leaves it out; NaN for an unknown key.
double valueOf(const Material& material, std::string_view key, double temperature);
PhaseDiagram phaseDiagramOf(const Material& material);

/// What single ranges cannot see: relations between properties (solidus <= liquidus, boiling above melting, ...), and
/// laws that leave their property's range where its phase exists.
/// "" or what is wrong, beginning with the key at fault.
std::string problemOf(const Material& material);

/// Whether the phase that a property speaks of exists at a temperature in K, at 1 atm; what never melts may be born
/// either way.
bool existsAt(const Material& material, std::string_view key, double temperature);

/// Where a curve or law leaves its property's range, and the table has the end of the range instead.
struct HeldRange {
  int property;     ///< index into the catalogue
  double from, to;  ///< K, to a kelvin or two; 0 and infinity where the table ends
  double used;      ///< in the property's unit
  bool contains(double temperature) const { return temperature >= from && temperature <= to; }
  /// Of two temperatures in it the one that is farther from where the range is left.
  double farther(double one, double other) const { return from > 0 ? std::max(one, other) : std::min(one, other); }
};

/// A material baked for hot loops at one ambient pressure.
class BakedMaterial final : public api::MaterialView {
 public:
  /// `pressure` in Pa. Temperatures are tabulated from 1 K to 3000 K or past the boiling point, whichever is more, and
  /// values are held within the catalogue's hard range.
  BakedMaterial(const Material& material, double pressure);
  const char* id() const noexcept override { return m_id.c_str(); }
  const api::Caloric& caloric() const noexcept override { return m_caloric; }
  double property(const char* key, double temperature) const noexcept override;
  bool adheresTo(const api::MaterialView& other) const noexcept override;

  /// Density in kg/m3 of the mixture of fractions at a temperature in K; vapour counts as gas_volume_factor times the
  /// liquid's volume (a parcel, not its real volume, which is some 1600 times the liquid's).
  double restDensity(double temperature, double solid, double liquid, double gas) const;
  /// kg/m3 with vapour counted as the liquid that it came from: the volume that conducts heat. `solid` is the solid
  /// fraction, the rest counts as liquid.
  double condensedDensity(double temperature, double solid) const;
  double conductivity(double temperature, double solid, double liquid, double gas) const;  ///< W/(m K)
  /// Kirchhoff transform in W/m: integral of k dT from the point where melting begins, k of the phase stable at each
  /// temperature; within a melting range k goes linearly from the solid's to the liquid's.
  double kirchhoff(double temperature) const;
  double youngsModulus(double temperature) const;  ///< Pa
  double viscosity(double temperature) const;      ///< Pa s, liquid
  double yieldStress(double temperature) const;    ///< Pa, liquid; 0: flows under any stress
  /// Where tables have other values than the material says; of a viscosity not above its most: a glass at rest.
  std::span<const HeldRange> heldRanges() const;
  double scalar(int propertyIndex) const { return m_scalars[static_cast<size_t>(propertyIndex)]; }

 private:
  struct Tables;
  std::string m_id;
  std::vector<std::string> m_adheresTo;
  api::Caloric m_caloric{};
  std::vector<double> m_scalars;
  std::shared_ptr<const Tables> m_tables;
};

}  // namespace ps
