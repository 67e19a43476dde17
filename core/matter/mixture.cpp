// SPDX-License-Identifier: Apache-2.0
#include "core/matter/mixture.h"

#include "core/matter/mixedphases.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace ps {
namespace {

constexpr double kReference = 293.15;  // K, at which volumes are counted and numbers are read

/// How much of the second part, counted in four ways.
struct Shares {
  double mass, moles, solidVolume, liquidVolume;
};

double meanOf(double a, double b, double second) { return (1 - second) * a + second * b; }

/// Lichtenecker's and Arrhenius' mean: that of the logarithms. 0 where one is 0.
double logarithmicMean(double a, double b, double second) {
  return a > 0 && b > 0 ? std::exp(meanOf(std::log(a), std::log(b), second)) : 0;
}

double harmonicMean(double a, double b, double second) { return a > 0 && b > 0 ? 1 / meanOf(1 / a, 1 / b, second) : 0; }

double linearLight(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
double displayed(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

using Combine = double (*)(double, double, const Shares&);

double byMass(double a, double b, const Shares& s) { return meanOf(a, b, s.mass); }
double byVolume(double a, double b, const Shares& s) { return meanOf(a, b, s.solidVolume); }
double byLiquidVolume(double a, double b, const Shares& s) { return meanOf(a, b, s.liquidVolume); }
double harmonicByMass(double a, double b, const Shares& s) { return harmonicMean(a, b, s.mass); }
double logByVolume(double a, double b, const Shares& s) { return logarithmicMean(a, b, s.solidVolume); }
double logByLiquidVolume(double a, double b, const Shares& s) { return logarithmicMean(a, b, s.liquidVolume); }
double logByMoles(double a, double b, const Shares& s) { return logarithmicMean(a, b, s.moles); }
double lightByVolume(double a, double b, const Shares& s) {
  return a == b ? a : displayed(meanOf(linearLight(a), linearLight(b), s.solidVolume));
}
double bothDo(double a, double b, const Shares&) { return std::min(a, b); }
double hill(double a, double b, const Shares& s) {
  return 0.5 * (meanOf(a, b, s.solidVolume) + harmonicMean(a, b, s.solidVolume));
}

constexpr const char* kByVolume = "mean by volume";
constexpr const char* kVolumes = "volumes add up: 1/ρ = Σ w/ρ";
constexpr const char* kByMass = "mean by mass: heat adds up";
constexpr const char* kLichtenecker = "logarithmic mean by volume (Lichtenecker 1926)";
constexpr const char* kLight = "mean by volume of linear light";

struct Rule {
  const char *key, *words;
  Combine combine;  ///< nullptr: see mixedPhases()
};
constexpr Rule kRules[] = {
    {"density_solid", kVolumes, harmonicByMass},
    {"density_liquid", kVolumes, harmonicByMass},
    {"expansion_linear", kByVolume, byVolume},
    {"expansion_volumetric", kByVolume, byLiquidVolume},
    {"heat_capacity_solid", kByMass, byMass},
    {"heat_capacity_liquid", kByMass, byMass},
    {"heat_capacity_gas", kByMass, byMass},
    {"conductivity_solid", kLichtenecker, logByVolume},
    {"conductivity_liquid", kLichtenecker, logByLiquidVolume},
    {"conductivity_gas", "logarithmic mean by moles, the volumes of gases", logByMoles},
    {"viscosity", "logarithmic mean by moles (Arrhenius 1887; Grunberg & Nissan 1949 without interaction)", logByMoles},
    {"yield_stress", kByVolume, byLiquidVolume},
    {"youngs_modulus", "mean of Voigt's and Reuss' bounds by volume (Hill 1952)", hill},
    {"poisson_ratio", kByVolume, byVolume},
    {"friction_static", kByVolume, byVolume},
    {"friction_kinetic", kByVolume, byVolume},
    {"restitution", kByVolume, byVolume},
    {"emissivity", kByVolume, byVolume},
    {"clearness", kByVolume, byVolume},
    {"melt_break_fraction", kByVolume, byVolume},
    {"freeze_bond_fraction", kByVolume, byVolume},
    {"bond_radius", kByVolume, byVolume},
    {"gas_volume_factor", "mean by mass", byMass},
    {"sinters", "where both do", bothDo},
    {"color_red", kLight, lightByVolume},
    {"color_green", kLight, lightByVolume},
    {"color_blue", kLight, lightByVolume},
    {"molar_mass", "moles add up: 1/M = Σ w/M; none where one is unknown", harmonicByMass},
    {"melting_temperature", "middle between solidus and liquidus of ideal solutions", nullptr},
    {"solidus",
     "ideal solid and liquid solutions (Seltz 1934), widened by the parts' own ranges; by mass where a molar "
     "mass is unknown",
     nullptr},
    {"liquidus",
     "ideal solid and liquid solutions (Seltz 1934), widened by the parts' own ranges; by mass where a "
     "molar mass is unknown",
     nullptr},
    {"latent_heat_fusion", "sum by mass, each carried to the mixture's melting point (Kirchhoff 1858)", nullptr},
    {"melting_slope", "mean by mass of what melts", nullptr},
    {"boiling_temperature",
     "where the pressures of the vapours add up to 1 atm (Raoult 1887); by mass where a molar "
     "mass is unknown",
     nullptr},
    {"latent_heat_vaporization", "sum by mass, each carried to the mixture's boiling point (Kirchhoff 1858)", nullptr},
    {"critical_temperature", "mean by moles (Kay 1936) of what boils", nullptr},
    {"triple_temperature", "none: a mixture has no single triple point", nullptr},
    {"triple_pressure", "none: a mixture has no single triple point", nullptr},
    {"latent_heat_sublimation", "none: it belongs to the triple point", nullptr},
};

const Rule* ruleOf(std::string_view key) {
  const auto* found = std::find_if(std::begin(kRules), std::end(kRules), [&](const Rule& r) { return key == r.key; });
  return found == std::end(kRules) ? nullptr : found;
}

double volumeShare(const Material& first, const Material& second, double mass, const char* density) {
  const double a = (1 - mass) / valueOf(first, density, kReference), b = mass / valueOf(second, density, kReference);
  return b / (a + b);
}

Shares sharesOf(const Material& first, const Material& second, double mass) {
  return {mass, moleShare(first, second, mass), volumeShare(first, second, mass, "density_solid"),
          volumeShare(first, second, mass, "density_liquid")};
}

/// A property of both over temperature, combined; what a part's law gives is first held within the property's range, as
/// tables hold it.
class Pair {
 public:
  Pair(const Material& first, const Material& second, const Rule& rule, const Shares& shares)
      : m_first(first),
        m_second(second),
        m_rule(rule),
        m_shares(shares),
        m_range(propertyCatalogue()[static_cast<size_t>(propertyIndex(rule.key))]) {}

  double at(double kelvin) const {
    return m_rule.combine(held(valueOf(m_first, m_rule.key, kelvin)), held(valueOf(m_second, m_rule.key, kelvin)),
                          m_shares);
  }

  Response response() const {
    std::set<double> knots;
    bool varies = false;
    for (const Material* part : {&m_first, &m_second}) {
      const auto found = part->properties.find(m_rule.key);
      if (found == part->properties.end() || found->second.kind == Response::Kind::Constant) continue;
      varies = true;
      addKnots(found->second, knots);
    }
    if (!varies) return at(kReference);
    Response out;
    out.kind = Response::Kind::Curve;
    double last = *knots.begin();
    out.points.push_back({last, at(last)});
    for (const double next : knots) {
      if (next - last < kLeastStep) continue;
      refine(out.points, last, next, kHalvings);
      last = next;
    }
    return out;
  }

 private:
  static constexpr double kLeastStep = 1e-3;  // K
  static constexpr double kBend = 0.02;       // by which a middle may lie off the straight line
  static constexpr int kPieces = 12, kHalvings = 5;

  double held(double value) const {
    return value > m_range.hardMinimum ? std::min(value, m_range.hardMaximum) : m_range.hardMinimum;
  }

  void addKnots(const Response& response, std::set<double>& knots) const {
    for (size_t i = 0; i < response.points.size(); ++i) {
      const double x = response.points[i].x;
      knots.insert(x);
      if (i > 0 && response.points[i - 1].toNext == ToNext::Step) knots.insert(x - 2 * kLeastStep);
    }
    if (response.kind != Response::Kind::Law) return;
    const auto [low, high] = temperaturesOf(m_first, m_second);
    for (int k = 0; k <= kPieces; ++k) knots.insert(low + (high - low) * k / kPieces);
  }

  /// Points after `from` up to `to`, so close that the curve is nearly straight between them.
  void refine(std::vector<CurvePoint>& points, double from, double to, int halvings) const {
    const double middle = 0.5 * (from + to), straight = 0.5 * (at(from) + at(to)), value = at(middle);
    if (halvings > 0 && std::abs(straight - value) > kBend * std::abs(value)) {
      refine(points, from, middle, halvings - 1);
      refine(points, middle, to, halvings - 1);
    } else {
      points.push_back({to, at(to)});
    }
  }

  const Material &m_first, &m_second;
  const Rule& m_rule;
  const Shares& m_shares;
  const api::ParameterDeclaration& m_range;
};

std::string nameOf(const Material& material) { return material.label.empty() ? material.id : material.label; }

/// Solid at any temperature: it neither melts nor is stated to be a liquid.
bool staysSolid(const Material& material) {
  return valueOf(material, "melting_temperature", kReference) <= 0 && !material.properties.contains("viscosity");
}

std::string whyNot(const Material& one, const Material& other) {
  const PhaseDiagram diagram = phaseDiagramOf(one);
  if (diagram.sublimesAtReference())
    return nameOf(one) + " turns from solid to gas under the air's usual pressure: no liquid can be mixed with it.";
  if (staysSolid(one) && !staysSolid(other))
    return nameOf(one) + " stays solid at any temperature and " + nameOf(other) +
           " does not: together they would be grains in a liquid, which are two materials.";
  if (diagram.boilingPoint0 > 0 && diagram.boilingPoint0 <= valueOf(other, "melting_temperature", kReference))
    return nameOf(one) + " boils before " + nameOf(other) + " melts: they are never liquid together.";
  return {};
}

}  // namespace

std::string_view mixtureRule(std::string_view key) {
  const Rule* rule = ruleOf(key);
  return rule ? std::string_view(rule->words) : std::string_view();
}

Material mixed(const Material& first, const Material& second, double share) {
  Material out;
  if (share <= 0 || share >= 1) {
    const Material& whole = share <= 0 ? first : second;
    out.properties = whole.properties;
    out.provenance = whole.provenance;
    out.adheresTo = whole.adheresTo;
    return out;
  }
  const Shares shares = sharesOf(first, second, share);
  for (const Rule& rule : kRules) {
    if (!first.properties.contains(rule.key) && !second.properties.contains(rule.key)) continue;
    if (rule.combine) out.properties[rule.key] = Pair(first, second, rule, shares).response();
  }
  for (const auto& [key, value] : mixedPhases(first, second, share)) out.properties[key] = value;
  for (const auto& [key, value] : out.properties)
    out.provenance[key] = {"of a mixture: " + std::string(mixtureRule(key)), 'C'};
  out.adheresTo = first.adheresTo;
  for (const std::string& id : second.adheresTo) {
    if (std::find(out.adheresTo.begin(), out.adheresTo.end(), id) == out.adheresTo.end()) out.adheresTo.push_back(id);
  }
  return out;
}

std::string whyNoMixture(const Material& first, const Material& second, double share) {
  if (!(share >= 0 && share <= 1)) return "The share must be from 0 to 1.";
  if (share == 0 || share == 1) return {};
  if (std::string why = whyNot(first, second); !why.empty()) return why;
  if (std::string why = whyNot(second, first); !why.empty()) return why;
  const Material out = mixed(first, second, share);
  if (valueOf(out, "melting_temperature", kReference) > 0 && !(valueOf(out, "latent_heat_fusion", kReference) > 0))
    return "Melting would take up no heat at the mixture's melting point, so far from those of its parts.";
  const std::string problem = problemOf(out);
  return problem.empty() ? problem : "What comes of them is no material: " + problem + ".";
}

}  // namespace ps
