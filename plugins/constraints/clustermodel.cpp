// SPDX-License-Identifier: Apache-2.0
#include "clustermodel.h"

#include "clusterbuilder.h"
#include "clusterkernels.h"
#include "clustershape.h"
#include "rigidpieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace ps::constraint {
namespace {

using api::atReset;
using api::ConstraintContext;
using api::GroupBatch;
using api::Motion;
using api::NeighbourView;
using api::ParameterKind;
using api::ParticleView;
using api::related;
using api::Scale;

constexpr const char* kSource = "Mueller et al. 2005; Rivers & James 2007";

constexpr api::ParameterDeclaration kParameters[] = {
    atReset({"radius", "Radius of a cluster", "R", "", ParameterKind::Number, Scale::Linear, 2.5, 1.5, 5, 1.2, 20, "×",
             1, 0, "", "Structure",
             "In particle spacings. Larger clusters carry a push farther in one step and cost more; smaller ones "
             "follow finer bulges.",
             "2.5 jelly, 4 a firm rubber ball", kSource}),
    atReset(related("should be < radius", {"spacing", "Distance of clusters", "D", "", ParameterKind::Number,
                                           Scale::Linear, 2, 1, 4, 0.5, 20, "×", 1, 0, "", "Structure",
                                           "In particle spacings, from one cluster's centre to the next. Less than the "
                                           "radius, so that they overlap and hold together.",
                                           "2 for a radius of 2.5", kSource})),
    {"damping", "Inner friction", "τ", "s", ParameterKind::Number, Scale::Linear, 0.002, 0, 0.05, 0, 1, "ms", 1000, 0,
     "", "Structure", "How long the shape resists a change: quiets wobbling, not falling or turning.",
     "0 wobbles on, 2 ms jelly, 20 ms dough", "Macklin et al. 2016, eq. 26"},
    {"max_stiffness_ratio", "Stiffness the step may resolve", "s", "", ParameterKind::Number, Scale::Logarithmic, 100,
     1, 10000, 0.01, 1e6, "", 1, 0, "", "Structure",
     "Largest k dt²/m of a member's spring. Beyond about 100 more stiffness only makes the solver work harder.",
     "100 at 4 substeps of 4 iterations", "Macklin et al. 2019"},
};

constexpr api::FieldType kFloat = api::FieldType::Float32;
constexpr api::FieldDeclaration kValues[] = {
    {"rotation_x", "", "Rotation from the undeformed shape, unit quaternion, x", kFloat},
    {"rotation_y", "", "Rotation, y", kFloat},
    {"rotation_z", "", "Rotation, z", kFloat},
    {"rotation_w", "", "Rotation, w", kFloat},
    {"volume", "m³", "Volume that the cluster answers for", kFloat},
    {"scale", "", "Size against the undeformed shape", kFloat},
    {"kappa", "1/s²", "Stiffness per mass of its members' springs", kFloat},
    {"held", "", "1 where a member cannot move", kFloat},
    {"mass", "kg", "Mass", kFloat},
    {"mass_rest", "kg", "Mass, what single precision leaves of it", kFloat},
    {"rest_centre_x", "m", "Centre of mass of the undeformed shape, x", kFloat},
    {"rest_centre_x_rest", "m", "Centre, x, what single precision leaves of it", kFloat},
    {"rest_centre_y", "m", "Centre, y", kFloat},
    {"rest_centre_y_rest", "m", "Centre, y, what is left", kFloat},
    {"rest_centre_z", "m", "Centre, z", kFloat},
    {"rest_centre_z_rest", "m", "Centre, z, what is left", kFloat},
};
constexpr api::FieldDeclaration kMemberValues[] = {
    {"rest_x", "m", "Place in the undeformed shape, x", kFloat},
    {"rest_y", "m", "Place in the undeformed shape, y", kFloat},
    {"rest_z", "m", "Place in the undeformed shape, z", kFloat},
    {"rest_volume", "m³", "Rest volume when it joined", kFloat},
    {"displacement_x", "m", "XPBD multiplier of the substep over the mass, x", kFloat},
    {"displacement_y", "m", "XPBD multiplier over the mass, y", kFloat},
    {"displacement_z", "m", "XPBD multiplier over the mass, z", kFloat},
    {"way_x", "m", "Way that its velocity took it in the substep, x", kFloat},
    {"way_y", "m", "Way, y", kFloat},
    {"way_z", "m", "Way, z", kFloat},
    {"mass", "kg", "Mass", kFloat},
};

/// Young's modulus in Pa of a cluster's members, at their mean temperature; of several materials the mean by volume.
double modulusOf(const ConstraintContext& context, const ParticleView& p, const GroupBatch& batch, size_t g) {
  double temperature = 0, modulus = 0, volume = 0;
  for (size_t k = batch.begin[g]; k < batch.begin[g + 1]; ++k) temperature += p.temperature[batch.particles[k]];
  temperature /= static_cast<double>(batch.begin[g + 1] - batch.begin[g]);
  uint32_t known = ~0u;
  double ofKnown = 0;
  for (size_t k = batch.begin[g]; k < batch.begin[g + 1]; ++k) {
    const uint32_t i = batch.particles[k];
    if (p.material[i] != known) {
      known = p.material[i];
      ofKnown = context.materials[known]->property("youngs_modulus", temperature);
    }
    modulus += double{p.position[i].w} * ofKnown;
    volume += double{p.position[i].w};
  }
  return volume > 0 ? modulus / volume : 0;
}

ClusterMembers membersOf(const GroupBatch& batch, size_t g) {
  const size_t first = batch.begin[g];
  const auto of = [&](ClusterModel::MemberValue v) { return batch.memberValues[v] + first; };
  return {batch.particles + first,
          batch.begin[g + 1] - first,
          {of(ClusterModel::kRestX), of(ClusterModel::kRestY), of(ClusterModel::kRestZ)},
          {of(ClusterModel::kDisplacementX), of(ClusterModel::kDisplacementY), of(ClusterModel::kDisplacementZ)},
          {of(ClusterModel::kWayX), of(ClusterModel::kWayY), of(ClusterModel::kWayZ)},
          of(ClusterModel::kMemberMass),
          batch.values[ClusterModel::kHeld][g] != 0};
}

/// visit(first, members, count) for some clusters of a batch at a time.
template <class Visit>
void forSome(const GroupBatch& batch, Visit&& visit) {
  std::array<ClusterMembers, kClusterLanes> members;
  for (size_t first = 0; first < batch.count; first += kClusterLanes) {
    const size_t count = std::min(kClusterLanes, batch.count - first);
    for (size_t k = 0; k < count; ++k) members[k] = membersOf(batch, first + k);
    visit(first, members.data(), count);
  }
}

}  // namespace

ClusterModel::ClusterModel()
    : Described({"Soft clusters",
                 "Makes a solid soft: many overlapping clusters, each of which pulls its particles back to the shape "
                 "they had (shape matching, Mueller et al. 2005; extended position-based dynamics, Macklin et al. "
                 "2016). As stiff as the material's Young's modulus says, with Poisson's ratio 0: it does not bulge "
                 "when squeezed. It always returns to its shape and never breaks by force; what melts leaves it for "
                 "good, and is held by bonds when it freezes again. For jelly and rubber; bonds suit stiffer matter.",
                 api::listOf(kParameters)}) {}

const void* ClusterModel::extension(const char* name) const noexcept {
  if (std::string_view(name) == api::kGroupPoses) return static_cast<const api::GroupPoses*>(this);
  return std::string_view(name) == api::kStructureCount ? static_cast<const api::StructureCount*>(this) : nullptr;
}

/// A sphere of the radius holds a particle's clusters, one in each cube of their distance.
double ClusterModel::perParticle(api::Span<const double> parameters) const noexcept {
  const double radius = parameters[kRadius], step = std::min(parameters[kSpacing], radius);
  return std::max(1.0, 4 * std::numbers::pi / 3 * radius * radius * radius / (step * step * step));
}

bool ClusterModel::traits(api::GroupTraits* out) const noexcept {
  return api::fill(out, {.values = api::listOf(kValues), .memberValues = api::listOf(kMemberValues)});
}

void ClusterModel::build(const ConstraintContext& context, const ParticleView& p, const NeighbourView&,
                         api::Span<const uint32_t> members, const GroupBatch& all, api::GroupSink& sink) const {
  findClusters(context, p, members, all, sink);
}

void ClusterModel::predict(const ConstraintContext& context, const api::MovableParticles& particles,
                           const GroupBatch& batch) const {
  const ParticleView& p = particles;
  const double most = context.parameters[kStiffnessRatio] / (context.dt * context.dt);
  if (batch.count == 0) return;
  const size_t first = batch.begin[0], last = batch.begin[batch.count];  // of all clusters, one after the other
  const auto from = [&](MemberValue v) { return batch.memberValues[v] + first; };
  for (const MemberValue v : {kDisplacementX, kDisplacementY, kDisplacementZ}) std::fill_n(from(v), last - first, 0.0f);
  findWays(p, batch.particles + first, last - first, {from(kWayX), from(kWayY), from(kWayZ)});
  if (context.substep != 0) return;  // volumes and temperatures change once a frame
  for (size_t g = 0; g < batch.count; ++g) {
    ClusterConstants::find(p, batch, g).keep(batch, g);
    const ClusterShape shape(p, batch, g);
    batch.values[kScale][g] = static_cast<float>(shape.scaleOfVolumes());
    const double moment = shape.restMoment();
    const double kappa = moment > 0 ? modulusOf(context, p, batch, g) * batch.values[kVolume][g] / moment : 0;
    batch.values[kKappa][g] = static_cast<float>(std::min(kappa, most));
  }
}

void ClusterModel::project(const ConstraintContext& context, const api::MovableParticles& particles,
                           const GroupBatch& batch) const {
  const double friction = context.parameters[kDamping] / context.dt;
  ClusterScratches scratch;
  ClusterSums sums;
  ClusterFits fits;
  std::array<ClusterPull, kClusterLanes> pulls;
  forSome(batch, [&](size_t first, const ClusterMembers* members, size_t count) {
    sumMembers(particles, members, count, friction > 0, scratch, sums);
    fits.find(batch, first, count, sums);
    for (size_t k = 0; k < count; ++k) {
      ClusterPull& pull = pulls[k];
      const double kappa = double{batch.values[kKappa][first + k]};
      pull.softness = kappa > 0 ? 1 / (kappa * context.dt * context.dt) : -1;
      pull.friction = friction;
      pull.turned = fits.turned(k);
      const Vector origin = laneOf(sums.origin, k), centre = fits.centre(k);
      pull.offset = origin + fits.offset(k);
      if (!(friction > 0)) continue;
      // The way of each member without the rigid motion of the whole.
      const Vector shift = laneOf(sums.shift, k);
      pull.centre = origin + centre;
      pull.shift = 1 / fits.mass(k) * shift;
      pull.turning =
          symmetricInverse(inertiaOf(sums, k, fits.mass(k))) * (laneOf(sums.turning, k) - cross(centre, shift));
    }
    pullMembers(particles, members, count, pulls.data(), scratch);
  });
}

void ClusterModel::deriveVelocities(const ConstraintContext& context, const api::MovableParticles& particles,
                                    const GroupBatch& batch) const {
  // The substep ends with v = (x - previous)/dt. The cluster moved each member by its displacement, across the way that
  // its velocity had taken it: that cost the angular momentum sum m way x displacement/dt. Its pulls, taken where the
  // members are now, should not turn it either. It gets the rigid turn that has what was lost.
  ClusterScratches scratch;
  ClusterTurns turns;
  forSome(batch, [&](size_t first, const ClusterMembers* members, size_t count) {
    sumTurns(particles, members, count, scratch, turns);
    for (size_t k = 0; k < count; ++k) {
      if (!(turns.moved[k] > 0) || members[k].held) continue;
      const double mass = massOf(batch, first + k);
      const Vector spin = symmetricInverse(inertiaOf(turns.sums, k, mass)) * (1 / context.dt * laneOf(turns.lost, k));
      turnMembers(particles, members[k], 1 / mass * laneOf(turns.sums.place, k) + laneOf(turns.sums.origin, k), spin,
                  scratch[k]);
    }
  });
}

void ClusterModel::topology(const ConstraintContext& context, const ParticleView& p, const NeighbourView&,
                            const GroupBatch& all, api::GroupSink& sink) const {
  for (size_t g = 0; g < all.count; ++g) {
    std::vector<size_t> kept;
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) {
      if (holds(p.motion[all.particles[k]])) kept.push_back(k);
    }
    const size_t before = all.begin[g + 1] - all.begin[g];
    if (kept.size() == before && all.changed[g] == 0) continue;
    const ClusterShape shape(p, all, g);
    std::vector<Vector> rest;
    double volume = 0;  // that its members had
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) volume += double{all.memberValues[kRestVolume][k]};
    rest.reserve(kept.size());
    for (const size_t k : kept) rest.push_back(shape.rest(k));
    const auto parted = [&](size_t a, size_t b) {
      return context.cuts && context.cuts->between(all.particles[kept[a]], all.particles[kept[b]]);
    };
    const std::vector<std::vector<size_t>> pieces = piecesOf(rest, NewCluster::kReach * context.spacing, parted);
    if (pieces.size() == 1 && kept.size() == before && before >= NewCluster::kLeastMembers) continue;
    sink.remove(g);
    for (const std::vector<size_t>& piece : pieces) {
      if (piece.size() < NewCluster::kLeastMembers) continue;
      NewCluster cluster;
      double held = 0;
      for (const size_t member : piece) {
        const size_t k = kept[member];
        cluster.add(all.particles[k], shape.rest(k), all.memberValues[kRestVolume][k]);
        held += double{all.memberValues[kRestVolume][k]};
      }
      cluster.emit(shape.rotation(), all.values[kVolume][g] * held / volume, all.values[kScale][g], sink);
    }
  }
}

void ClusterModel::restoreMembers(const ConstraintContext&, const api::MovableParticles& particles,
                                  const GroupBatch& all, const uint8_t* returned) const {
  const ParticleView& p = particles;
  for (size_t g = 0; g < all.count; ++g) {
    const uint8_t *first = returned + all.begin[g], *last = returned + all.begin[g + 1];
    const auto back = std::count(first, last, uint8_t{1});
    if (back == 0 || back == last - first) continue;
    ClusterShape shape(p, all, g);
    shape.fit(returned);
    for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) {
      if (returned[k] == 0) continue;
      setVector(particles.position[all.particles[k]], shape.goal(k));
      setVector(particles.velocity[all.particles[k]], shape.meanVelocity(returned));
    }
  }
}

void ClusterModel::carry(const ConstraintContext&, const api::MovableParticles&, const GroupBatch& all,
                         const uint8_t* carried, const api::Carrying& carrying) const {
  const Quaternion turn{carrying.turn[0], carrying.turn[1], carrying.turn[2], carrying.turn[3]};
  for (size_t g = 0; g < all.count; ++g) {
    const auto value = [&](Value v) -> float& { return all.values[v][g]; };
    if (carried[g] == 0) continue;
    const Quaternion q =
        normalised(turn * Quaternion{value(kRotationX), value(kRotationY), value(kRotationZ), value(kRotationW)});
    value(kRotationX) = static_cast<float>(q.x), value(kRotationY) = static_cast<float>(q.y);
    value(kRotationZ) = static_cast<float>(q.z), value(kRotationW) = static_cast<float>(q.w);
  }
}

double ClusterModel::energy(const ConstraintContext&, const ParticleView& p, const GroupBatch& batch) const {
  double sum = 0;
  for (size_t g = 0; g < batch.count; ++g) {
    ClusterShape shape(p, batch, g);
    shape.fit();
    for (size_t k = batch.begin[g]; k < batch.begin[g + 1]; ++k) {
      const Vector error = vectorOf(p.position[batch.particles[k]]) - shape.goal(k);
      sum += 0.5 * batch.values[kKappa][g] * p.mass[batch.particles[k]] * dot(error, error);
    }
  }
  return sum;
}

void ClusterModel::limits(const ConstraintContext& context, const ParticleView& p, api::LimitSink& sink) const {
  // A cluster of radius R deep inside has sum m r²/3 = m R²/5 of its mass m, shared as often as its volume.
  const double radius = context.parameters[kRadius] * context.spacing,
               step = std::min(context.parameters[kSpacing] * context.spacing, radius);
  const double shares = std::max(1.0, 4.18879 * radius * radius * radius / (step * step * step));
  const double most = context.parameters[kStiffnessRatio] / (context.dt * context.dt) * radius * radius / 5 * shares;
  std::vector<double> asked(context.materials.size, 0), density(context.materials.size, 0);
  for (size_t i = 0; i < p.count; ++i) {
    if (p.body[i] != context.body || p.motion[i] != Motion::Solid) continue;
    const double modulus = context.materials[p.material[i]]->property("youngs_modulus", p.temperature[i]);
    if (modulus <= asked[p.material[i]]) continue;
    asked[p.material[i]] = modulus;
    density[p.material[i]] = double{p.mass[i]} / double{p.position[i].w};
  }
  for (size_t m = 0; m < asked.size(); ++m) {
    const std::string what = std::string(context.materials[m]->id()) + ".youngs_modulus";
    if (asked[m] > most * density[m]) sink.limit(what.c_str(), asked[m], most * density[m], "Pa");
  }
}

}  // namespace ps::constraint
