// SPDX-License-Identifier: Apache-2.0
// What the host carries of the bonds' pulls, and what stiffness is not delivered.
#include "bondstiffness.h"
#include "convergence.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintBatch;
using api::ConstraintContext;
using api::Motion;
using api::ParticleView;

/// What of a material a body is made of.
struct Used {
  Range temperature;
  double inverseMass = 0;  ///< of the lightest solid particle, 1/kg
  double layers = 0;       ///< along the longest side of the body
  double thinnest = 0;     ///< likewise along its shortest, as it stands
  bool loose = false;      ///< whether any of it is held by nothing
};

std::vector<Used> usedBy(const ConstraintContext& context, const ParticleView& p) {
  std::vector<Used> used(context.materials.size);
  std::array<Range, 3> sides;
  for (size_t i = 0; i < p.count; ++i) {
    if (p.motion[i] != Motion::Solid || p.body[i] != context.body || p.material[i] >= used.size()) continue;
    used[p.material[i]].temperature.include(p.temperature[i]);
    used[p.material[i]].inverseMass = std::max(used[p.material[i]].inverseMass, double{p.velocity[i].w});
    if (!context.held || context.held[i] == 0) used[p.material[i]].loose = true;
    sides[0].include(double{p.position[i].x});
    sides[1].include(double{p.position[i].y});
    sides[2].include(double{p.position[i].z});
  }
  double longest = 0, shortest = 1e30;
  for (const Range& side : sides) {
    longest = std::max(longest, side.high - side.low);
    shortest = std::min(shortest, side.high - side.low);
  }
  for (Used& u : used) {
    u.layers = longest / context.spacing;
    u.thinnest = shortest / context.spacing + 1;
  }
  return used;
}

/// Share of Young's modulus with which a lattice of so few layers bends, as cantilevers of 20 to 30 particles showed:
/// what it lacks at its surface is made up for along the axes, but not all of its second moment. Three layers are a
/// fifth short and four a ninth, which is not told; what lies aslant counts as thick.
double bendingShare(double layers, double length) {
  constexpr double kShort = 3;  // layers long for each across: what is no beam does not bend
  if (length < kShort * layers) return 1;
  return layers < 1.5 ? 0.2 : layers < 2.5 ? 0.61 : 1;
}

}  // namespace

void BondModel::linearise(const ConstraintContext& context, const ParticleView& p, const ConstraintBatch& batch,
                          float* pull, float* stiffness) const {
  const float damping = static_cast<float>(context.parameters[kDamping] / context.dt);
  for (size_t k = 0; k < batch.count; ++k) {
    pull[k] = stiffness[k] = 0;
    if (!(batch.values[kCarried][k] > 0)) continue;
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    const auto [x, y, z, unused] = api::separation(p, i, j);
    const float distance = std::sqrt(x * x + y * y + z * z), perMetre = 1 / batch.values[kCompliance][k];
    if (!(distance > 0)) continue;
    const api::Float4 &a = p.position[i], &b = p.position[j], &aFrom = p.previous[i], &bFrom = p.previous[j];
    const float change = x * ((a.x - aFrom.x) - (b.x - bFrom.x)) + y * ((a.y - aFrom.y) - (b.y - bFrom.y)) +
                         z * ((a.z - aFrom.z) - (b.z - bFrom.z));
    pull[k] = -perMetre * (distance - batch.values[kLength][k] + damping / distance * change);
    stiffness[k] = perMetre * (1 + damping);
  }
}

void BondModel::limits(const ConstraintContext& context, const ParticleView& p, api::LimitSink& sink) const {
  if (isSet(context, kSolver)) return;  // the classic method promises no stiffness
  const std::vector<Used> used = usedBy(context, p);
  const double chosen = context.parameters[kSpringStiffness],
               perModulus = stiffnessOfModulus(context) * context.spacing;
  for (size_t m = 0; m < used.size(); ++m) {
    if (used[m].temperature.empty() || !(used[m].inverseMass > 0)) continue;
    const api::MaterialView& material = *context.materials[m];
    const double modulus = std::max(material.property("youngs_modulus", used[m].temperature.low),
                                    material.property("youngs_modulus", used[m].temperature.high));
    const double asked = chosen > 0 ? chosen : perModulus * modulus;
    const double followed = std::min(asked, stiffnessLimit(context, 2 * used[m].inverseMass));
    const double bending = chosen > 0 ? 1 : bendingShare(used[m].thinnest, used[m].layers);
    if (followed == asked && !used[m].loose && bending == 1) continue;
    const double ratio = followed * used[m].inverseMass * context.dt * context.dt;
    const double passed = followed == asked && !used[m].loose ? 1  // what is held is solved as a whole
                                                              : deliveredShare(ratio, context.passes, used[m].layers);
    const double delivered = followed * std::min(passed, bending);
    if (!(delivered < kToldBelow * asked)) continue;
    const std::string what = std::string(material.id()) + ".youngs_modulus";
    if (chosen > 0)
      sink.limit("bonds.spring_stiffness", asked, delivered, "N/m");
    else
      sink.limit(what.c_str(), modulus, delivered / perModulus, "Pa");
  }
}

}  // namespace ps::constraint
