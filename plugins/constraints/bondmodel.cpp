// SPDX-License-Identifier: Apache-2.0
#include "bondmodel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintBatch;
using api::ConstraintContext;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;

/// At creation: axial and face-diagonal neighbours of a cubic lattice, 1 and 1.414 spacings away.
constexpr float kLatticeRadius = 1.5f;
/// The axial ones alone.
constexpr float kAxialRadius = 1.2f;
/// Two dry pieces touch when their particles are closer than this, in spacings.
constexpr float kDryRadius = 1.05f;
constexpr double kStiffnessOfModulus = 0.4;  // k/(E dx) of 18 neighbours; of 6 it is 1
constexpr float kLeastStiffness = 1e-20f;    // N/m, keeps the compliance finite
/// Set while a particle is fluid, cleared when it has found partners: only what was liquid joins.
constexpr const char* kThawed = "bonds.thawed";

constexpr api::ParameterDeclaration kParameters[] = {
    {"bond_max", "Bonds per particle", "n", "", api::ParameterKind::Integer, api::Scale::Linear, 18, 6, 32, 1, 64, "",
     1, 0, "", "Structure", "How many neighbours a freezing particle may bond with.",
     "6 brittle like wet sand, 12 firm, 18 as firm as a block made whole",
     "cubic lattice: 6 axial and 12 diagonal neighbours"},
    {"damping", "Bond damping", "τ", "s", api::ParameterKind::Number, api::Scale::Linear, 0, 0, 0.02, 0, 1, "ms", 1000,
     0, "", "Structure", "Inner friction: how long a bond resists a change of its length. Quiets rattling solids.",
     "0 rings, 5 ms dull like wax, 20 ms like dough",
     "Macklin et al. 2016, eq. 26, with beta = damping times stiffness"},
    {"max_stiffness_ratio", "Stiffness the step may resolve", "s", "", api::ParameterKind::Number,
     api::Scale::Logarithmic, 100, 1, 10000, 0.01, 1e6, "", 1, 0, "", "Structure",
     "Largest k dt²/m of a bond. Beyond about 100 more stiffness only makes the solver work harder: the block looks "
     "the "
     "same, and takes more iterations to come to rest.",
     "100 at 4 substeps of 4 iterations", "Macklin et al. 2019"},
    {"neighbours", "Neighbours at the start", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 1, 0, 1, "",
     1, 0, "eighteen|six", "Structure",
     "Which neighbours of its lattice a particle is tied to when the body is made: the nearest and those across a "
     "face's diagonal, or the nearest alone, which gives way to shear without resistance.",
     "eighteen for solids; six for rods, chains and textbook lattices", ""},
    {"across_materials", "Ties different materials", "", "", api::ParameterKind::Toggle, api::Scale::Linear, 0, 0, 1, 0,
     1, "", 1, 0, "", "Structure",
     "Whether a body of several materials is one piece, as if they were welded where they touch at the start.",
     "on: a strip of two metals", ""},
    {"spring_stiffness", "Stiffness of a bond", "k", "N/m", api::ParameterKind::Number, api::Scale::Linear, 0, 0, 1e6,
     0, 1e15, "", 1, 0, "", "Springs",
     "Stiffness of every bond, in place of the one that follows from Young's modulus; 0 takes Young's modulus.",
     "0 for matter, 1000 N/m for a mattress's spring", ""},
    {"rest_ratio", "Length of a bond at rest", "", "", api::ParameterKind::Number, api::Scale::Linear, 1, 0.5, 1.5,
     0.01, 10, "", 1, 0, "", "Springs",
     "Length of a bond at rest as a share of the distance at which it is made at the start: below 1 the body is drawn "
     "tight, above 1 it is squeezed.",
     "1 at rest, 0.99 a taut string", ""},
    {"reference_temperature", "Temperature of the lengths at rest", "T_ref", "K", api::ParameterKind::Number,
     api::Scale::Linear, 0, 0, 773.15, 0, 1e4, "", 1, 0, "", "Springs",
     "At which temperature the bonds made at the start have their lengths: a body that starts warmer expands at once. "
     "0 takes the temperature at which each of them is made.",
     "0 for matter at ease; 293.15 K for a strip of metal cast at 20 °C", ""},
    {"solver", "Method", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 1, 0, 1, "", 1, 0, "xpbd|pbd",
     "Legacy",
     "Extended position-based dynamics follows stiffness in N/m whatever the step. The classic method, kept for "
     "comparison, takes a share of the error in each iteration: its stiffness grows with iterations and substeps.",
     "xpbd; pbd shows why the extended method was made", "Müller et al. 2007; Macklin et al. 2016"},
    {"pbd_stiffness", "Share per iteration", "k", "", api::ParameterKind::Number, api::Scale::Linear, 0.5, 0, 1, 0, 1,
     "", 1, 0, "", "Legacy", "Share of a bond's error that the classic method takes out in one iteration.",
     "0.1 soft, 1 as stiff as the iterations allow", "Müller et al. 2007"},
};

constexpr api::FieldDeclaration kValues[] = {
    {"rest_length", "m", "Length at rest when the bond was made", api::FieldType::Float32},
    {"reference_volume", "m³", "Sum of both rest volumes when the bond was made", api::FieldType::Float32},
    {"multiplier", "N·s²", "XPBD multiplier of the substep", api::FieldType::Float32},
    {"length", "m", "Length at rest at the present volumes", api::FieldType::Float32},
    {"compliance", "m/N", "Inverse stiffness at the present temperature", api::FieldType::Float32},
};

constexpr api::FieldDeclaration kFields[] = {
    {kThawed, "", "1 while the particle has been fluid since its last bond", api::FieldType::UInt8},
};

/// Cube root of a ratio near 1 by two steps of Halley's method: the same bits everywhere, 1e-6 exact from 0.4 to 2.5.
float cubeRoot(float s) {
  float y = 1 + (s - 1) / 3;
  for (int k = 0; k < 3; ++k) {
    const float y3 = y * y * y;
    y *= (y3 + 2 * s) / (2 * y3 + s);
  }
  return y;
}

float distanceSquared(const ParticleView& p, uint32_t i, uint32_t j) {
  const api::Float4 d = api::separation(p, i, j);
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

bool holds(Motion m) { return m == Motion::Solid || m == Motion::Static; }

/// Young's modulus over a range of temperatures, sampled once per batch: a property is too slow for the inner loop.
class ModulusTable {
 public:
  ModulusTable(const api::MaterialView& material, double low, double high) : m_low(low) {
    const bool narrow = !(high - low > 0.25);
    m_perKelvin = narrow ? 0 : (kSamples - 1) / (high - low);
    for (int k = 0; k < kSamples; ++k) {
      const double t = narrow ? low : low + k / m_perKelvin;
      m_values[static_cast<size_t>(k)] = narrow && k > 0 ? m_values[0] : material.property("youngs_modulus", t);
    }
  }
  double at(double temperature) const {
    const double s = std::clamp((temperature - m_low) * m_perKelvin, 0.0, kSamples - 1.001);
    const size_t k = static_cast<size_t>(s);
    return m_values[k] + (s - static_cast<double>(k)) * (m_values[k + 1] - m_values[k]);
  }

 private:
  static constexpr int kSamples = 16;
  std::array<double, kSamples> m_values{};
  double m_low, m_perKelvin = 0;
};

struct Range {
  double low = 1e30, high = -1e30;
  void include(double t) { low = std::min(low, t), high = std::max(high, t); }
  bool empty() const { return low > high; }
};

std::vector<ModulusTable> modulusTables(const ConstraintContext& context, const ParticleView& particles,
                                        const ConstraintBatch& batch) {
  std::vector<Range> ranges(context.materials.size);
  for (size_t k = 0; k < 2 * batch.count; ++k) {
    const uint32_t i = batch.particles[k];
    ranges[particles.material[i]].include(particles.temperature[i]);
  }
  std::vector<ModulusTable> tables;
  tables.reserve(ranges.size());
  for (size_t m = 0; m < ranges.size(); ++m) {
    const Range r = ranges[m].empty() ? Range{273.15, 273.15} : ranges[m];
    tables.emplace_back(*context.materials[m], r.low, r.high);
  }
  return tables;
}

bool isSet(const ConstraintContext& context, BondModel::Parameter parameter) {
  return context.parameters[parameter] > 0.5;
}

/// k/(E dx) of the lattice that the body is made of.
double stiffnessOfModulus(const ConstraintContext& context) {
  return isSet(context, BondModel::kNeighbours) ? 1 : kStiffnessOfModulus;
}

/// k in N/m that the step resolves for a pair of inverse masses.
double stiffnessLimit(const ConstraintContext& context, double inverseMasses) {
  return context.parameters[BondModel::kStiffnessRatio] * 2 / (inverseMasses * context.dt * context.dt);
}

struct Candidate {
  float distanceSquared;
  uint32_t lowId, highId, i, j;
};

bool nearer(const Candidate& a, const Candidate& b) {
  if (a.distanceSquared != b.distanceSquared) return a.distanceSquared < b.distanceSquared;
  return a.lowId != b.lowId ? a.lowId < b.lowId : a.highId < b.highId;
}

/// What topology() needs to know of each material.
struct JoinRule {
  float freezeFraction, radius;
  bool sinters;
};

std::vector<JoinRule> joinRules(const ConstraintContext& context) {
  std::vector<JoinRule> rules;
  for (const api::MaterialView* m : context.materials) {
    const double temperature = m->caloric().meltingPoint0;
    rules.push_back({static_cast<float>(m->property("freeze_bond_fraction", temperature)),
                     static_cast<float>(m->property("bond_radius", temperature) * context.spacing),
                     m->property("sinters", temperature) > 0.5});
  }
  return rules;
}

std::vector<Candidate> findCandidates(const ConstraintContext& context, const ParticleView& p,
                                      const NeighbourView& lists, const uint8_t* thawed) {
  const std::vector<JoinRule> rules = joinRules(context);
  const float dry = kDryRadius * static_cast<float>(context.spacing);
  std::vector<Candidate> result;
  for (uint32_t i = 0; i < p.count; ++i) {
    if (p.motion[i] != Motion::Solid) continue;
    const JoinRule& rule = rules[p.material[i]];
    const bool fresh = thawed[i] != 0;
    if ((!fresh && !rule.sinters) || p.solidFraction[i] < rule.freezeFraction) continue;
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
      const uint32_t j = lists.index[q];
      if (!fresh && p.body[i] == p.body[j]) continue;  // dry pieces join only across bodies
      if (p.motion[j] != Motion::Solid || p.material[j] != p.material[i] || p.solidFraction[j] < rule.freezeFraction)
        continue;
      // Each pair once: by the fresh one, or by the lower of two alike.
      const bool alike = (thawed[j] != 0) == fresh;
      if (alike ? j < i : !fresh) continue;
      const float d2 = distanceSquared(p, i, j), reach = fresh ? rule.radius : dry;
      if (d2 < reach * reach) result.push_back({d2, std::min(p.id[i], p.id[j]), std::max(p.id[i], p.id[j]), i, j});
    }
  }
  std::sort(result.begin(), result.end(), nearer);
  return result;
}

/// `ratio`: of the length at rest to the distance; `volume`: m³, of both particles, at which it has that length.
void addBond(const ParticleView& p, uint32_t i, uint32_t j, float ratio, float volume, api::ConstraintSink& sink) {
  const uint32_t pair[2] = {i, j};
  const float length = ratio * std::sqrt(distanceSquared(p, i, j));
  const float values[BondModel::kValueCount] = {length, volume, 0, length, 0};
  sink.add(pair, values);
}

float presentVolume(const ParticleView& p, uint32_t i, uint32_t j) { return p.position[i].w + p.position[j].w; }

/// m³ of a solid particle at the temperature of reference.
float referenceVolume(const ConstraintContext& context, const ParticleView& p, uint32_t i) {
  const double reference = context.parameters[BondModel::kReferenceTemperature];
  if (!(reference > 0)) return p.position[i].w;
  const api::MaterialView& material = *context.materials[p.material[i]];
  return static_cast<float>(double{p.position[i].w} * material.property("density_solid", p.temperature[i]) /
                            material.property("density_solid", reference));
}

}  // namespace

const char* BondModel::label() const noexcept { return "Bonds"; }

const char* BondModel::help() const noexcept {
  return "Holds a solid together with springs between each particle and its 18 nearest (extended position-based "
         "dynamics, "
         "Macklin et al. 2016). Their stiffness follows Young's modulus at the particles' temperature, their length "
         "the "
         "particles' volume. They break where matter melts and form again where it freezes. Poisson's ratio is always "
         "1/4; "
         "nothing breaks by force; very stiff matter is as stiff as the substeps can resolve.";
}

api::ParameterList BondModel::parameters() const noexcept { return api::listOf(kParameters); }

api::ConstraintTraits BondModel::traits() const noexcept {
  return {api::ConstraintTraits::Form::Structural, 2, api::listOf(kValues), api::listOf(kFields)};
}

void BondModel::build(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                      api::Span<const uint32_t> members, api::ConstraintSink& sink) const {
  std::vector<uint8_t> isMember(p.count, 0);
  for (const uint32_t i : members) isMember[i] = 1;
  const float reach = isSet(context, kNeighbours) ? kAxialRadius : kLatticeRadius;
  const float radius = reach * static_cast<float>(context.spacing);
  const float ratio = static_cast<float>(context.parameters[kRestRatio]);
  const bool across = isSet(context, kAcross);
  for (const uint32_t i : members) {
    if (p.motion[i] != Motion::Solid) continue;
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
      const uint32_t j = lists.index[q];
      // New matter ties to its own, and to what is there already of the same body.
      if (isMember[j] != 0 ? j < i : p.body[j] != p.body[i]) continue;
      if (!holds(p.motion[j]) || (!across && p.material[j] != p.material[i])) continue;
      if (!(distanceSquared(p, i, j) < radius * radius)) continue;
      addBond(p, i, j, ratio, referenceVolume(context, p, i) + referenceVolume(context, p, j), sink);
    }
  }
}

void BondModel::predict(const ConstraintContext& context, const ParticleView& p, const ConstraintBatch& batch) const {
  std::fill(batch.values[kMultiplier], batch.values[kMultiplier] + batch.count, 0.0f);
  if (context.substep != 0) return;  // volumes and temperatures change once a frame
  const std::vector<ModulusTable> tables = modulusTables(context, p, batch);
  const double given = context.parameters[kSpringStiffness], ofModulus = stiffnessOfModulus(context);
  for (size_t k = 0; k < batch.count; ++k) {
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    const float volumes = (p.position[i].w + p.position[j].w) / batch.values[kReferenceVolume][k];
    batch.values[kLength][k] = batch.values[kRestLength][k] * cubeRoot(volumes);
    const double ei = tables[p.material[i]].at(p.temperature[i]), ej = tables[p.material[j]].at(p.temperature[j]);
    const double modulus = ei + ej > 0 ? 2 * ei * ej / (ei + ej) : 0;
    const double inverseMasses = double{p.velocity[i].w} + double{p.velocity[j].w};
    double stiffness = given > 0 ? given : ofModulus * modulus * context.spacing;
    if (inverseMasses > 0) stiffness = std::min(stiffness, stiffnessLimit(context, inverseMasses));
    batch.values[kCompliance][k] = 1 / std::max(static_cast<float>(stiffness), kLeastStiffness);
  }
}

void BondModel::project(const ConstraintContext& context, const ParticleView& p, const ConstraintBatch& batch) const {
  const bool classic = isSet(context, kSolver);
  const float share = static_cast<float>(context.parameters[kPbdStiffness]);
  const float perDt2 = static_cast<float>(1 / (context.dt * context.dt));
  const float damping = static_cast<float>(context.parameters[kDamping] / context.dt);
  float* multiplier = batch.values[kMultiplier];
  const float *length = batch.values[kLength], *compliance = batch.values[kCompliance];
  for (size_t k = 0; k < batch.count; ++k) {
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    api::Float4 &a = p.position[i], &b = p.position[j];
    const float wa = p.velocity[i].w, wb = p.velocity[j].w;
    const auto [x, y, z, unused] = api::separation(p, i, j);
    const float distance = std::sqrt(x * x + y * y + z * z);
    if (!(distance > 0) || !(wa + wb > 0)) continue;
    if (classic) {
      const float s = -share * (distance - length[k]) / ((wa + wb) * distance), sa = s * wa, sb = s * wb;
      a.x += sa * x, a.y += sa * y, a.z += sa * z;
      b.x -= sb * x, b.y -= sb * y, b.z -= sb * z;
      continue;
    }
    const float softness = compliance[k] * perDt2;
    float error = distance - length[k] + softness * multiplier[k];
    if (damping > 0) {
      const api::Float4 &aFrom = p.previous[i], &bFrom = p.previous[j];
      error += damping / distance *
               (x * ((a.x - aFrom.x) - (b.x - bFrom.x)) + y * ((a.y - aFrom.y) - (b.y - bFrom.y)) +
                z * ((a.z - aFrom.z) - (b.z - bFrom.z)));
    }
    const float change = -error / ((1 + damping) * (wa + wb) + softness);
    multiplier[k] += change;
    const float s = change / distance, sa = s * wa, sb = s * wb;
    a.x += sa * x, a.y += sa * y, a.z += sa * z;
    b.x -= sb * x, b.y -= sb * y, b.z -= sb * z;
  }
}

void BondModel::topology(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                         const ConstraintBatch& all, api::ConstraintSink& sink) const {
  auto* thawed = static_cast<uint8_t*>(p.fields->find(kThawed, api::FieldType::UInt8));
  for (size_t i = 0; i < p.count; ++i) {
    if (!holds(p.motion[i])) thawed[i] = 1;
  }
  for (size_t k = 0; k < all.count; ++k) {
    if (!holds(p.motion[all.particles[2 * k]]) || !holds(p.motion[all.particles[2 * k + 1]])) sink.remove(k);
  }
  const std::vector<Candidate> candidates = findCandidates(context, p, lists, thawed);
  if (candidates.empty()) return;
  std::vector<uint32_t> degree(p.count, 0);
  for (size_t k = 0; k < all.count; ++k) {
    const uint32_t i = all.particles[2 * k], j = all.particles[2 * k + 1];
    if (!holds(p.motion[i]) || !holds(p.motion[j])) continue;
    ++degree[i], ++degree[j];
  }
  const auto most = [&](uint32_t i) { return static_cast<uint32_t>(context.parametersOf(p.body[i])[kBondMax]); };
  for (const Candidate& c : candidates) {
    if (degree[c.i] >= most(c.i) || degree[c.j] >= most(c.j)) continue;
    addBond(p, c.i, c.j, 1, presentVolume(p, c.i, c.j), sink);
    ++degree[c.i], ++degree[c.j];
  }
  for (const Candidate& c : candidates) {
    if (degree[c.i] > 0) thawed[c.i] = 0;
    if (degree[c.j] > 0) thawed[c.j] = 0;
  }
}

double BondModel::energy(const ConstraintContext&, const ParticleView& p, const ConstraintBatch& batch) const {
  double sum = 0;
  for (size_t k = 0; k < batch.count; ++k) {
    if (!(batch.values[kCompliance][k] > 0)) continue;
    const double distance = std::sqrt(double{distanceSquared(p, batch.particles[2 * k], batch.particles[2 * k + 1])});
    const double stretch = distance - double{batch.values[kLength][k]};
    sum += 0.5 * stretch * stretch / double{batch.values[kCompliance][k]};
  }
  return sum;
}

void BondModel::limits(const ConstraintContext& context, const ParticleView& p, api::LimitSink& sink) const {
  struct Used {
    Range temperature;
    double inverseMass = 0;  ///< of the lightest solid particle, 1/kg
  };
  std::vector<Used> used(context.materials.size);
  for (size_t i = 0; i < p.count; ++i) {
    if (p.motion[i] != Motion::Solid || p.body[i] != context.body || p.material[i] >= used.size()) continue;
    used[p.material[i]].temperature.include(p.temperature[i]);
    used[p.material[i]].inverseMass = std::max(used[p.material[i]].inverseMass, double{p.velocity[i].w});
  }
  if (isSet(context, kSolver)) return;  // the classic method promises no stiffness
  const double given = context.parameters[kSpringStiffness];
  for (size_t m = 0; m < used.size(); ++m) {
    if (used[m].temperature.empty() || !(used[m].inverseMass > 0)) continue;
    const double most = stiffnessLimit(context, 2 * used[m].inverseMass);
    if (given > 0) {
      if (given > most) sink.limit("bonds.spring_stiffness", given, most, "N/m");
      continue;
    }
    const api::MaterialView& material = *context.materials[m];
    const double asked = std::max(material.property("youngs_modulus", used[m].temperature.low),
                                  material.property("youngs_modulus", used[m].temperature.high));
    const double delivered = most / (stiffnessOfModulus(context) * context.spacing);
    const std::string what = std::string(material.id()) + ".youngs_modulus";
    if (asked > delivered) sink.limit(what.c_str(), asked, delivered, "Pa");
  }
}

}  // namespace ps::constraint
