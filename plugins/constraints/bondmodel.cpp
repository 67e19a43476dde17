// SPDX-License-Identifier: Apache-2.0
#include "bondmodel.h"

#include "bondstiffness.h"
#include "convergence.h"
#include "joining.h"
#include "pairprojection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace ps::constraint {
namespace {

using api::actingWhen;
using api::atReset;
using api::ConstraintBatch;
using api::ConstraintContext;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;

/// At creation: axial and face-diagonal neighbours of a cubic lattice, 1 and 1.414 spacings away.
constexpr float kLatticeRadius = 1.5f;
constexpr float kLeastStiffness = 1e-20f;  // N/m, keeps the compliance finite
constexpr double kRounding = 0.999;        // below any mean of moduli, however it is rounded

constexpr api::ParameterDeclaration kParameters[] = {
    {"bond_max", "Bonds per particle", "n", "", api::ParameterKind::Integer, api::Scale::Linear, 18, 6, 32, 1, 64, "",
     1, 0, "", "Structure", "How many neighbours a freezing particle may bond with.",
     "6 brittle like wet sand, 12 firm, 18 as firm as a block made whole",
     "cubic lattice: 6 axial and 12 diagonal neighbours"},
    actingWhen("solver = xpbd",
               {"damping", "Bond damping", "τ", "s", api::ParameterKind::Number, api::Scale::Linear, 0, 0, 0.02, 0, 1,
                "ms", 1000, 0, "", "Structure",
                "Inner friction: how long a bond resists a change of its length. Quiets rattling solids.",
                "0 rings, 5 ms dull like wax, 20 ms like dough",
                "Macklin et al. 2016, eq. 26, with beta = damping times stiffness"}),
    actingWhen("solver = xpbd",
               {"max_stiffness_ratio", "Stiffness the step may resolve", "s", "", api::ParameterKind::Number,
                api::Scale::Logarithmic, 100, 1, 10000, 0.01, 1e6, "", 1, 0, "", "Structure",
                "Largest k dt²/m of a bond. Beyond about 100 more stiffness only makes the solver work harder: the "
                "block looks the same, and takes more iterations to come to rest.",
                "100 at 4 substeps of 4 iterations", "Macklin et al. 2019"}),
    atReset(
        {"neighbours", "Neighbours at the start", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 1, 0, 1,
         "", 1, 0, "eighteen|six", "Structure",
         "Which neighbours of its lattice a particle is tied to when the body is made: the nearest and those across a "
         "face's diagonal, or the nearest alone, which gives way to shear without resistance.",
         "eighteen for solids; six for rods, chains and textbook lattices", ""}),
    atReset({"across_materials", "Ties different materials", "", "", api::ParameterKind::Toggle, api::Scale::Linear, 0,
             0, 1, 0, 1, "", 1, 0, "", "Structure",
             "Whether a body of several materials is one piece, as if they were welded where they touch at the start.",
             "on: a strip of two metals", ""}),
    {"spring_stiffness", "Stiffness of a bond", "k", "N/m", api::ParameterKind::Number, api::Scale::Linear, 0, 0, 1e6,
     0, 1e15, "", 1, 0, "", "Springs",
     "Stiffness of every bond, in place of the one that follows from Young's modulus; 0 takes Young's modulus.",
     "0 for matter, 1000 N/m for a mattress's spring", ""},
    atReset({"rest_ratio", "Length of a bond at rest", "", "", api::ParameterKind::Number, api::Scale::Linear, 1, 0.5,
             1.5, 0.01, 10, "", 1, 0, "", "Springs",
             "Length of a bond at rest as a share of the distance at which it is made at the start: below 1 the body "
             "is drawn tight, above 1 it is squeezed.",
             "1 at rest, 0.99 a taut string", ""}),
    atReset({"reference_temperature", "Temperature at rest", "T_ref", "K", api::ParameterKind::Number,
             api::Scale::Linear, 0, 0, 773.15, 0, 1e4, "", 1, 0, "", "Springs",
             "At which temperature the bonds made at the start have their lengths at rest: a body that starts warmer "
             "expands "
             "at once. 0 takes the temperature at which each of them is made.",
             "0 for matter at ease; 293.15 K for a strip of metal cast at 20 °C", ""}),
    {"solver", "Method", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 1, 0, 1, "", 1, 0, "xpbd|pbd",
     "Legacy",
     "Extended position-based dynamics follows stiffness in N/m whatever the step. The classic method, kept for "
     "comparison, takes a share of the error in each iteration: its stiffness grows with iterations and substeps.",
     "xpbd; pbd shows why the extended method was made", "Müller et al. 2007; Macklin et al. 2016"},
    actingWhen("solver = pbd", {"pbd_stiffness", "Share per iteration", "k", "", api::ParameterKind::Number,
                                api::Scale::Linear, 0.5, 0, 1, 0, 1, "", 1, 0, "", "Legacy",
                                "Share of a bond's error that the classic method takes out in one iteration.",
                                "0.1 soft, 1 as stiff as the iterations allow", "Müller et al. 2007"}),
    {"bond_rule", "Rule of melting and freezing", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 1, 0, 1,
     "", 1, 0, "default|thesis_alg5", "Legacy",
     "The thesis's solid manager, kept for comparison: a bond breaks only when both its ends have begun to melt, and "
     "what is freezing ties itself to whatever solid lies within 1.1 spacings, of any material, at most four times.",
     "default; thesis_alg5 drags molten drops along and welds what touches", "algorithm 5 of the 2020 thesis"},
    {"stiffness_law", "Law of stiffness", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 1, 0, 1, "", 1,
     0, "material|thesis_sigmoid", "Legacy",
     "Where Young's modulus comes from: the material's own at the present temperature, or, kept for comparison, the "
     "material's at the temperature at which a bond has its length, times the thesis's 2/(1 + exp(dT/s)), dT the "
     "warming since and s the row below.",
     "material; thesis_sigmoid is twice as stiff in the cold and soft a few kelvin warmer",
     "equation 4.5 of the 2020 thesis"},
    actingWhen(
        "stiffness_law = thesis_sigmoid",
        {"stiffness_softening", "Softens over", "s", "K", api::ParameterKind::Number, api::Scale::Logarithmic, 1, 0.1,
         100, 1e-3, 1e4, "", 1, 0, "", "Legacy", "Warming over which the thesis's law of stiffness takes effect.",
         "1 K as printed in the thesis, 30 K for wax", "equation 4.5 of the 2020 thesis"}),
};

constexpr api::FieldDeclaration kValues[] = {
    {"rest_length", "m", "Length at rest when the bond was made", api::FieldType::Float32},
    {"reference_volume", "m³", "Sum of both rest volumes when the bond was made", api::FieldType::Float32},
    {"multiplier", "N·s²", "XPBD multiplier of the substep", api::FieldType::Float32},
    {"length", "m", "Length at rest at the present volumes", api::FieldType::Float32},
    {"compliance", "m/N", "Inverse stiffness at the present temperature", api::FieldType::Float32},
    {"temperature", "K", "At which it has its length at rest", api::FieldType::Float32},
    {"carried", "", "1 where passes alone would not deliver its stiffness", api::FieldType::Float32},
};

constexpr const char* kTiesField = BondModel::kTiesField;
constexpr api::FieldDeclaration kFields[] = {
    kJoiningFields[0],
    kJoiningFields[1],
    {kTiesField, "", "How many bonds the particle has", api::FieldType::UInt8},
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
  double least() const { return *std::min_element(m_values.begin(), m_values.end()); }

 private:
  static constexpr int kSamples = 16;
  std::array<double, kSamples> m_values{};
  double m_low, m_perKelvin = 0;
};

std::vector<ModulusTable> modulusTables(const ConstraintContext& context, const ParticleView& particles,
                                        const ConstraintBatch& batch) {
  std::vector<Range> ranges(context.materials.size);
  const float* made = batch.values[BondModel::kTemperature];
  for (size_t k = 0; k < 2 * batch.count;) {  // from one change of material to the next, in registers
    const uint32_t material = particles.material[batch.particles[k]];
    Range own = ranges[material];
    for (; k < 2 * batch.count && particles.material[batch.particles[k]] == material; ++k) {
      own.include(particles.temperature[batch.particles[k]]);
      own.include(double{made[k / 2]});
    }
    ranges[material] = own;
  }
  std::vector<ModulusTable> tables;
  tables.reserve(ranges.size());
  for (size_t m = 0; m < ranges.size(); ++m) {
    const Range r = ranges[m].empty() ? Range{273.15, 273.15} : ranges[m];
    tables.emplace_back(*context.materials[m], r.low, r.high);
  }
  return tables;
}

/// Lengths at rest, by the volumes of the ends: cube roots of what lies side by side, which compilers make vectors of.
void findLengths(const ParticleView& p, const ConstraintBatch& batch) {
  const uint32_t* ends = batch.particles;
  const float *rest = batch.values[BondModel::kRestLength], *reference = batch.values[BondModel::kReferenceVolume];
  float* length = batch.values[BondModel::kLength];
  for (size_t k = 0; k < batch.count; ++k) length[k] = p.position[ends[2 * k]].w + p.position[ends[2 * k + 1]].w;
  constexpr size_t kTogether = 8;
  size_t k = 0;
  for (; k + kTogether <= batch.count; k += kTogether) {
    float root[kTogether];
    for (size_t q = 0; q < kTogether; ++q) root[q] = cubeRoot(length[k + q] / reference[k + q]);
    for (size_t q = 0; q < kTogether; ++q) length[k + q] = rest[k + q] * root[q];
  }
  for (; k < batch.count; ++k) length[k] = rest[k] * cubeRoot(length[k] / reference[k]);
}

/// e to the power of x, the same bits everywhere: by the series, exact to 1e-15, of what is left beside a power of two.
double exponential(double x) {
  x = std::clamp(x, -600.0, 600.0);
  const double twos = std::floor(x * std::numbers::log2e + 0.5), remainder = x - twos * std::numbers::ln2;
  double sum = 1;
  for (int k = 14; k > 0; --k) sum = 1 + sum * remainder / k;
  return std::ldexp(sum, static_cast<int>(twos));
}

/// The thesis's share of the modulus that is left after a warming, equation 4.5.
double thesisShare(double warming, double softening) { return 2 / (1 + exponential(warming / softening)); }

/// m³ of a solid particle at the temperature of reference.
float referenceVolume(const ConstraintContext& context, const ParticleView& p, uint32_t i) {
  const double reference = context.parameters[BondModel::kReferenceTemperature];
  if (!(reference > 0)) return p.position[i].w;
  const api::MaterialView& material = *context.materials[p.material[i]];
  return static_cast<float>(double{p.position[i].w} * material.property("density_solid", p.temperature[i]) /
                            material.property("density_solid", reference));
}

/// Takes a share of each bond's error (Mueller et al. 2007).
void projectClassic(const ConstraintContext& context, const api::MovableParticles& particles,
                    const ConstraintBatch& batch) {
  const ParticleView& p = particles;
  const float share = static_cast<float>(context.parameters[BondModel::kPbdStiffness]);
  const float* length = batch.values[BondModel::kLength];
  for (size_t k = 0; k < batch.count; ++k) {
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    api::Float4 &a = particles.position[i], &b = particles.position[j];
    const float wa = p.velocity[i].w, wb = p.velocity[j].w;
    const auto [x, y, z, unused] = api::separation(p, i, j);
    const float distance = std::sqrt(x * x + y * y + z * z);
    if (!(distance > 0) || !(wa + wb > 0)) continue;
    const float s = -share * (distance - length[k]) / ((wa + wb) * distance), sa = s * wa, sb = s * wb;
    a.x += sa * x, a.y += sa * y, a.z += sa * z;
    b.x -= sb * x, b.y -= sb * y, b.z -= sb * z;
  }
}

}  // namespace

BondModel::BondModel()
    : Described(
          {"Bonds",
           "Holds a solid together with springs between each particle and its 18 nearest (extended position-based "
           "dynamics, Macklin et al. 2016). Their stiffness follows Young's modulus at the particles' temperature, "
           "their length the particles' volume. They break where matter melts and form again where it freezes: with "
           "matter of its own kind, or of one that either material says it holds on to (adheres_to). Dry pieces join "
           "only where their material sinters, as ice does. Bonds also take back what has melted out of cloth, ropes "
           "and soft bodies, and what was liquid from the start. Poisson's ratio is always 1/4; nothing breaks by "
           "force; very stiff matter is as stiff as the substeps can resolve.",
           api::listOf(kParameters)}) {}

bool BondModel::traits(api::StructuralTraits* out) const noexcept {
  return api::fill(out, {.arity = 2, .values = api::listOf(kValues), .fields = api::listOf(kFields)});
}

void BondModel::addBond(const ParticleView& p, uint32_t i, uint32_t j, const Length& length,
                        api::ConstraintSink& sink) {
  const uint32_t pair[2] = {i, j};
  const float rest = length.ratio * std::sqrt(distanceSquared(p, i, j));
  const double now = 0.5 * (p.temperature[i] + p.temperature[j]);
  const auto temperature = static_cast<float>(length.temperature > 0 ? length.temperature : now);
  const float values[kValueCount] = {rest, length.volume, 0, rest, 0, temperature, 0};
  sink.add(pair, values);
}

const void* BondModel::extension(const char* name) const noexcept {
  if (std::string_view(name) == api::kStructureCount) return static_cast<const api::StructureCount*>(this);
  if (std::string_view(name) == api::kSpringTies) return static_cast<const api::SpringTies*>(this);
  if (std::string_view(name) == api::kWeldsMatter) return static_cast<const api::Welding*>(this);
  return std::string_view(name) == api::kHoldsFrozen ? this : nullptr;
}

/// Each bond is that of two particles.
double BondModel::perParticle(api::Span<const double> parameters) const noexcept {
  constexpr double kEighteen = 9, kSix = 3;
  return parameters[kNeighbours] > 0.5 ? kSix : kEighteen;
}

void BondModel::build(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                      api::Span<const uint32_t> members, api::ConstraintSink& sink) const {
  std::vector<uint8_t> isMember(p.count, 0);
  for (const uint32_t i : members) isMember[i] = 1;
  const Joining joining(context, p);
  for (const uint32_t i : members) joining.setKeeper(i, Keeper::Bonds);
  const float reach = isSet(context, kNeighbours) ? kAxialRadius : kLatticeRadius;
  const float radius = reach * static_cast<float>(context.spacing);
  const float ratio = static_cast<float>(context.parameters[kRestRatio]);
  const bool across = isSet(context, kAcross);
  auto* ties = static_cast<uint8_t*>(p.fields->write(kTiesField, api::FieldType::UInt8));
  for (const uint32_t i : members) {
    if (p.motion[i] != Motion::Solid) continue;
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
      const uint32_t j = lists.index[q];
      // New matter ties to its own, and to what is there already of the same body.
      if (isMember[j] != 0 ? j < i : p.body[j] != p.body[i]) continue;
      if (!holds(p.motion[j]) || (!across && p.material[j] != p.material[i])) continue;
      if (!(distanceSquared(p, i, j) < radius * radius)) continue;
      const Length length{ratio, referenceVolume(context, p, i) + referenceVolume(context, p, j),
                          context.parameters[kReferenceTemperature]};
      addBond(p, i, j, length, sink);
      ++ties[i], ++ties[j];
    }
  }
}

/// As far as bonds of a lattice reach, so that one that is whole gets no others. Rigid bodies hold their own.
void BondModel::weld(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                     api::Span<const uint32_t> members, api::ConstraintSink& sink) const {
  const Joining joining(context, p);
  std::vector<uint8_t> isMember(p.count, 0);
  for (const uint32_t i : members) isMember[i] = 1;
  for (const uint32_t i : members) {
    const bool axial = context.parametersOf(p.body[i])[kNeighbours] > 0.5;
    const float radius = (axial ? kAxialRadius : kLatticeRadius) * static_cast<float>(context.spacing);
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
      const uint32_t j = lists.index[q];
      if (j < i || isMember[j] == 0 || (joining.isRigid(i) && joining.isRigid(j))) continue;
      if (!(distanceSquared(p, i, j) < radius * radius)) continue;
      addBond(p, i, j, {1, p.position[i].w + p.position[j].w, 0}, sink);
    }
  }
}

void BondModel::predict(const ConstraintContext& context, const ParticleView& p, const ConstraintBatch& batch) const {
  if (context.substep == 0) refresh(context, p, batch);  // volumes and temperatures change once a frame
  for (size_t k = 0; k < batch.count; ++k) {
    if (!(batch.values[kCarried][k] > 0)) batch.values[kMultiplier][k] = 0;
  }
}

void BondModel::refresh(const ConstraintContext& context, const ParticleView& p, const ConstraintBatch& batch) {
  findLengths(p, batch);
  const Surface surface(context, p);
  const std::vector<ModulusTable> tables = modulusTables(context, p, batch);
  const double chosen = context.parameters[kSpringStiffness], ofModulus = stiffnessOfModulus(context);
  const bool thesis = isSet(context, kStiffnessLaw), held = context.held && !isSet(context, kSolver);
  const double softening = context.parameters[kSoftening];
  // Of most solids any bond is stiffer than a step resolves: no modulus is looked up for those.
  double leastModulus = tables.empty() ? 0 : tables[0].least();
  for (const ModulusTable& table : tables) leastModulus = std::min(leastModulus, table.least());
  const double leastAsked = thesis || chosen > 0 ? 0 : kRounding * ofModulus * leastModulus * context.spacing;
  const auto askedOf = [&](size_t k, uint32_t i, uint32_t j) {
    const double made = double{batch.values[kTemperature][k]};
    const auto modulusOf = [&](uint32_t of) {
      const ModulusTable& table = tables[p.material[of]];
      return thesis ? table.at(made) * thesisShare(p.temperature[of] - made, softening) : table.at(p.temperature[of]);
    };
    const double ei = modulusOf(i), ej = modulusOf(j);
    return ofModulus * (ei + ej > 0 ? 2 * ei * ej / (ei + ej) : 0) * context.spacing;
  };
  const float* length = batch.values[kRestLength];
  for (size_t k = 0; k < batch.count; ++k) {
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    const double inverseMasses = double{p.velocity[i].w} + double{p.velocity[j].w};
    const bool limited = inverseMasses > 0;
    const double limit = limited ? stiffnessLimit(context, inverseMasses) : 0;
    const bool beyond = limited && leastAsked > limit;
    const double asked = beyond ? leastAsked : chosen > 0 ? chosen : askedOf(k, i, j), most = limited ? limit : asked;
    const double surplus = chosen > 0 ? 1 : surface.factor(i, j, length[k]);
    const double stiffness = surplus * std::min(asked, most);
    const double ratio = stiffness * inverseMasses / 2 * context.dt * context.dt;
    const bool carried = held && context.held[i] != 0 && asked < most && needsCarrying(ratio, context.passes);
    batch.values[kCarried][k] = carried ? 1 : 0;
    batch.values[kCompliance][k] = 1 / std::max(static_cast<float>(stiffness), kLeastStiffness);
  }
}

void BondModel::project(const ConstraintContext& context, const api::MovableParticles& particles,
                        const ConstraintBatch& batch) const {
  if (isSet(context, kSolver)) return projectClassic(context, particles, batch);
  const Pairs pairs{batch.count, batch.particles, batch.values[kLength], batch.values[kMultiplier],
                    static_cast<float>(context.parameters[kDamping] / context.dt)};
  projectPairs(particles, pairs,
               BondSoftness{batch.values[kCompliance], static_cast<float>(1 / (context.dt * context.dt))});
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

}  // namespace ps::constraint
