// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/plugin.h>

// What holds particles together or moves them, in three forms: ties of 2 to 4 particles (StructuralPlugin), groups of
// any number (GroupPlugin), and corrections gathered over neighbours (NeighbourPlugin). All three are of kind
// "constraint".
#define PHASESKETCH_STRUCTURAL_IID "org.phasesketch.StructuralConstraint/0.9"
#define PHASESKETCH_GROUP_IID "org.phasesketch.GroupConstraint/0.9"
#define PHASESKETCH_NEIGHBOUR_IID "org.phasesketch.NeighbourConstraint/0.9"

namespace ps::api {

/// Capability of structure that takes in matter of any body that has frozen and that nothing else takes back:
/// extension(kHoldsFrozen) is not nullptr. Scenes whose matter melts use the first such plugin that is installed.
inline constexpr const char* kHoldsFrozen = "holds_frozen";

/// Capability of structure whose amount hangs on its parameters: extension(kStructureCount) is its StructureCount. The
/// host asks it before a scene is made, to see whether it fits the memory; without it each particle counts as tied to
/// the 18 nearest of a lattice, or as a member of one group.
inline constexpr const char* kStructureCount = "structure_count";
class StructureCount {
 public:
  /// Ties per particle deep inside a body, or groups that such a particle is a member of; `parameters` as a body has
  /// them. Called from any thread.
  virtual double perParticle(Span<const double> parameters) const noexcept = 0;

 protected:
  ~StructureCount() = default;
};

/// Between whom a hand has cut, while both stay solid: nothing joins them again by itself.
struct CutView {
  const uint32_t* begin;    ///< partners of particle i: partner[begin[i]] .. partner[begin[i + 1] - 1]
  const uint32_t* partner;  ///< indices
  /// Whether a particle lies at a cut.
  bool at(uint32_t i) const { return begin[i + 1] > begin[i]; }
  bool between(uint32_t i, uint32_t j) const {
    for (uint32_t k = begin[i]; k < begin[i + 1]; ++k) {
      if (partner[k] == j) return true;
    }
    return false;
  }
};

struct ConstraintContext {
  double dt;       ///< s: substep when projecting, frame in topology()
  double spacing;  ///< m, particle_spacing
  double supportRadius;
  Double3 gravity;
  uint32_t substep, iteration;
  /// In the order of parameters(), as the body has them that the batch belongs to: constraints belong to the body of
  /// their first particle. Calls that reach the constraints of all bodies get the defaults: see parametersOf().
  Span<const double> parameters;
  Span<const MaterialView* const> materials;
  uint32_t body = kNoBody;  ///< index of that body, as in ParticleView::body
  uint32_t passes = 1;      ///< of project() over ties in a substep
  Span<const Span<const double>> bodyParameters{};
  double time = 0;  ///< s of the scene, at the start of the frame
  /// Of each particle: 1 where ties connect it with something fixed, so that the host carries the pulls of SpringTies;
  /// nullptr where it carries none.
  const uint8_t* held = nullptr;
  const CutView* cuts = nullptr;  ///< in topology(); nullptr where nothing is cut
  /// In a topology() of its own, between two frames, the pairs that are cut no more by a weld or by undo: groups that
  /// still touch by them are one again. Else nullptr.
  const CutView* healed = nullptr;
  static constexpr uint32_t kNoBody = ~0u;
  /// Parameters of any body, by its index; the defaults of one that does not use this plugin.
  Span<const double> parametersOf(uint32_t index) const {
    return index < bodyParameters.size ? bodyParameters[index] : parameters;
  }
};

/// Something that the model could not deliver at the chosen step.
class LimitSink {
 public:
  virtual void limit(const char* what, double asked, double delivered, const char* unit) = 0;

 protected:
  ~LimitSink() = default;
};

/// What the three forms share.
class ConstraintPlugin : public Plugin {
 public:
  /// What the solver cannot deliver for the particles of `context.body` with this step; asked for each body that uses
  /// the plugin. `what` is "MATERIAL.property", or "PLUGIN.parameter" for a parameter of its own. May throw.
  virtual void limits(const ConstraintContext&, const ParticleView&, LimitSink&) const {}
};

// Structural: `arity` particles each, and `values` floats of their own (rest length, multiplier, ...).

class SpringTies;

/// Capability of structure of two particles each whose ties are springs: extension(kSpringTies) is its SpringTies. The
/// host then carries their pulls through what is held by something fixed before it calls project().
inline constexpr const char* kSpringTies = "spring_ties";

struct StructuralTraits {
  size_t structSize = sizeof(StructuralTraits);
  uint32_t arity = 2;  ///< 2 .. 4
  /// 1 for what makes sheets and lines one particle thick: liquid is kept off their particles.
  uint32_t thin = 0;
  List<FieldDeclaration> values{};  ///< values of each, at most 16, Float32
  List<FieldDeclaration> fields{};  ///< per-particle fields, made by the host, zero at birth
};

/// A run of constraints of one body that share no particle (one colour): project them in any order, or all at once.
struct ConstraintBatch {
  size_t count;
  const uint32_t* particles;  ///< arity * count indices
  float* const* values;       ///< [declared value][constraint]
};

/// Takes new constraints while building or in topology().
class ConstraintSink {
 public:
  /// `particles`: arity indices; `values`: one per declared value. A duplicate (same set of particles) is ignored.
  virtual void add(const uint32_t* particles, const float* values) = 0;
  /// Removes constraint `k` of the batch given to topology().
  virtual void remove(size_t k) = 0;

 protected:
  ~ConstraintSink() = default;
};

/// All of these may throw.
class StructuralPlugin : public ConstraintPlugin {
 public:
  /// False when there is nothing to tell, which refuses the plugin: `return fill(out, {...});`
  virtual bool traits(StructuralTraits* out) const = 0;
  /// Makes the constraints of newly created particles `members`, ascending; they and those near them have lists.
  virtual void build(const ConstraintContext&, const ParticleView&, const NeighbourView&, Span<const uint32_t> members,
                     ConstraintSink&) const = 0;
  /// Once per substep and batch, before the first iteration: resets multipliers, refreshes rest values.
  virtual void predict(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const {}
  /// One Gauss-Seidel pass over the batch: moves particles by inverse mass.
  virtual void project(const ConstraintContext&, const MovableParticles&, const ConstraintBatch&) const = 0;
  /// Once per substep, after velocities follow from positions.
  virtual void deriveVelocities(const ConstraintContext&, const MovableParticles&, const ConstraintBatch&) const {}
  /// Once per frame, after heat: may remove constraints of `all`, those of every body, and add new ones.
  virtual void topology(const ConstraintContext&, const ParticleView&, const NeighbourView&,
                        const ConstraintBatch& /*all*/, ConstraintSink&) const {}
  /// Elastic energy of the batch in J.
  virtual double energy(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const { return 0; }
};

/// Capability of structure of ties that joins what a hand welds: extension(kWeldsMatter) is its Welding.
inline constexpr const char* kWeldsMatter = "welds_matter";

/// See kWeldsMatter.
class Welding {
 public:
  /// Between two frames: ties those of `members` (ascending indices of solid or fixed particles, all of bodies that use
  /// the plugin) to each other that touch, at rest as they stand. May throw.
  virtual void weld(const ConstraintContext&, const ParticleView&, const NeighbourView&, Span<const uint32_t> members,
                    ConstraintSink&) const = 0;

 protected:
  ~Welding() = default;
};

/// See kSpringTies.
class SpringTies {
 public:
  /// Which of the declared values is the XPBD multiplier: the impulse of a substep times dt, N s², positive where a tie
  /// pushes its particles apart.
  virtual size_t multiplier() const noexcept = 0;
  /// Once per substep, after predict(): pull[k], in N, of constraint k on its first particle, away from the second, at
  /// the places that they have, and by how much it falls per metre that they move apart. A stiffness of 0 leaves it to
  /// project() alone, as where context.held is not 1. predict() sets the multipliers of these to 0 and keeps the
  /// others, from which the host begins; project() then finds those that the host has found.
  virtual void linearise(const ConstraintContext&, const ParticleView&, const ConstraintBatch&, float* pull,
                         float* stiffness) const = 0;

 protected:
  ~SpringTies() = default;
};

/// Capability of structure of groups whose values say where a group is or how it goes: extension(kGroupPoses) is its
/// GroupPoses.
inline constexpr const char* kGroupPoses = "group_poses";

/// Where the host has carried particles from one place to another: what was at p is at turn p + shift, what went at v
/// goes at turn v + push.
struct Carrying {
  double turn[4];  ///< unit quaternion: x, y, z, w
  Double3 shift;   ///< m
  Double3 push;    ///< m/s
};

// Groups: any number of particles together; `values` belong to the group, `memberValues` to each of its members (a
// place in the undeformed shape, a weight, ...).

struct GroupTraits {
  size_t structSize = sizeof(GroupTraits);
  /// 1 when members keep their distances. Contact and friction then act on the group as one body, which moves by its
  /// mass and its inertia, in place of particle by particle.
  uint32_t rigid = 0;
  uint32_t thin = 0;                      ///< as of StructuralTraits
  List<FieldDeclaration> values{};        ///< of each group, at most 16, Float32
  List<FieldDeclaration> memberValues{};  ///< of each member, at most 16, Float32
  List<FieldDeclaration> fields{};        ///< per-particle fields, made by the host, zero at birth
};

/// A run of groups of one body that share no particle: project them in any order, or all at once. The members of group
/// g are particles[begin[g]] .. particles[begin[g + 1] - 1], in the order in which they were added.
struct GroupBatch {
  size_t count;
  const size_t* begin;         ///< count + 1 places in `particles` and in the arrays of `memberValues`
  const uint32_t* particles;   ///< indices
  float* const* values;        ///< [declared value][group]
  float* const* memberValues;  ///< [declared member value][place]
  /// 1 where members were erased or cut apart, or undo took that back, since the last topology(): what is left may have
  /// fallen apart.
  const uint8_t* changed;
};

/// Takes new groups while building or in topology().
class GroupSink {
 public:
  /// `particles`: `count` indices, none twice. `values`: one per declared value. `memberValues`: for each member in
  /// turn one per declared member value.
  virtual void add(const uint32_t* particles, size_t count, const float* values, const float* memberValues) = 0;
  /// Removes group `g` of the batch given to the call; its particles live on.
  virtual void remove(size_t g) = 0;
  /// So many more of the new particles have been looked at. A search that takes longer than some milliseconds says so
  /// as it goes on: the host shows it, and throws where its user has cancelled, which is to pass through the plugin.
  virtual void advance(size_t members) = 0;

 protected:
  ~GroupSink() = default;
};

/// All of these may throw.
class GroupPlugin : public ConstraintPlugin {
 public:
  /// False when there is nothing to tell, which refuses the plugin: `return fill(out, {...});`
  virtual bool traits(GroupTraits* out) const = 0;
  /// Makes the groups of newly created particles `members` (ascending indices); may replace groups of `all`, so that
  /// matter added to a body joins it. Lists are as in StructuralPlugin::build().
  virtual void build(const ConstraintContext&, const ParticleView&, const NeighbourView&, Span<const uint32_t> members,
                     const GroupBatch& all, GroupSink&) const = 0;
  /// Once per substep and batch, before the first iteration; the particles have moved by their velocities already.
  virtual void predict(const ConstraintContext&, const MovableParticles&, const GroupBatch&) const {}
  /// Once per iteration, after structure, density and contact of single particles, before contact of rigid bodies.
  virtual void project(const ConstraintContext&, const MovableParticles&, const GroupBatch&) const = 0;
  /// Once per substep, after velocities follow from positions, v = (x - previous)/dt, and viscosity has changed them.
  /// May move the group's particles for the last time.
  virtual void deriveVelocities(const ConstraintContext&, const MovableParticles&, const GroupBatch&) const {}
  /// Once per frame, after heat: may remove groups of `all`, those of every body, and add new ones.
  virtual void topology(const ConstraintContext&, const ParticleView&, const NeighbourView&, const GroupBatch& /*all*/,
                        GroupSink&) const {}
  /// When undo has put members back into groups whose others may have moved on: puts them in their places.
  /// `returned[place]` is 1 for those that came back.
  virtual void restoreMembers(const ConstraintContext&, const MovableParticles&, const GroupBatch& /*all*/,
                              const uint8_t* /*returned*/) const {}
  /// Elastic energy of the batch in J.
  virtual double energy(const ConstraintContext&, const ParticleView&, const GroupBatch&) const { return 0; }
};

/// See kGroupPoses.
class GroupPoses {
 public:
  /// Between two frames, when the host has carried all members of the groups `g` of `all` for which carried[g] is 1,
  /// but for those that cannot move: their values follow, and where places are made of them, those. May throw.
  virtual void carry(const ConstraintContext&, const MovableParticles&, const GroupBatch& all, const uint8_t* carried,
                     const Carrying&) const = 0;

 protected:
  ~GroupPoses() = default;
};

// Neighbours: no lists; each particle gathers its own correction.

struct NeighbourTraits {
  size_t structSize = sizeof(NeighbourTraits);
  List<FieldDeclaration> fields{};  ///< per-particle fields, made by the host, zero at birth
};

class NeighbourPlugin : public ConstraintPlugin {
 public:
  /// False when there is nothing to tell, which refuses the plugin: `return fill(out, {...});`
  virtual bool traits(NeighbourTraits* out) const = 0;
  /// Once per iteration: adds to correction[k] (x, y, z in m, zero at first) how far particle members[k] moves. Members
  /// are particles of all bodies that use the plugin, by ascending index; parametersOf(particles.body[i]) are those of
  /// a particle's body. Reads any particle; called with parts of the list from several threads at once. What cannot
  /// move stays where it is. May throw.
  virtual void gather(const ConstraintContext&, const ParticleView&, const NeighbourView&, Span<const uint32_t> members,
                      Float4* correction) const = 0;
};

}  // namespace ps::api
