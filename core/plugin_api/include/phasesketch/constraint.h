// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/plugin.h>

#define PHASESKETCH_CONSTRAINT_IID "org.phasesketch.Constraint/1"

namespace ps::api {

/// Structural constraints carry `arity` particles each, and `values` floats of their own (rest length, lambda, ...).
/// Neighbour constraints have no lists: they gather over neighbours and write their own particle's correction.
struct ConstraintTraits {
  enum class Form : uint32_t { Structural, Neighbour };
  Form form;
  uint32_t arity;                 ///< structural: 2 .. 4
  List<FieldDeclaration> values;  ///< structural: per-constraint values, Float32 each
  List<FieldDeclaration> fields;  ///< per-particle fields, made by the host, zero at birth
};

struct ConstraintContext {
  double dt;       ///< s: substep when projecting, frame in topology()
  double spacing;  ///< m, particle_spacing
  double supportRadius;
  Double3 gravity;
  uint32_t substep, iteration;
  Span<const double> parameters;  ///< in the order of parameters()
  Span<const MaterialView* const> materials;
};

/// A run of constraints that share no particle (one colour): project them in any order, or all at once.
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

/// Something that the model could not deliver at the chosen step.
class LimitSink {
 public:
  virtual void limit(const char* what, double asked, double delivered, const char* unit) = 0;

 protected:
  ~LimitSink() = default;
};

class ConstraintPlugin : public Plugin {
 public:
  virtual ConstraintTraits traits() const = 0;

  // Structural. All of these may throw.
  /// Makes the constraints of newly created particles `members` (ascending indices).
  virtual void build(const ConstraintContext&, const ParticleView&, const NeighbourView&,
                     Span<const uint32_t> /*members*/, ConstraintSink&) const {}
  /// Once per substep and batch, before the first iteration: resets multipliers, refreshes rest values.
  virtual void predict(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const {}
  /// One Gauss-Seidel pass over the batch: moves particles by inverse mass.
  virtual void project(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const {}
  /// Once per substep, after velocities follow from positions.
  virtual void deriveVelocities(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const {}
  /// Once per frame, after heat: may remove constraints of `all` and add new ones.
  virtual void topology(const ConstraintContext&, const ParticleView&, const NeighbourView&,
                        const ConstraintBatch& /*all*/, ConstraintSink&) const {}
  /// Elastic energy of the batch in J.
  virtual double energy(const ConstraintContext&, const ParticleView&, const ConstraintBatch&) const { return 0; }
  /// What the solver cannot deliver with this step.
  virtual void limits(const ConstraintContext&, const ParticleView&, LimitSink&) const {}

  // Neighbour-based. May throw.
  /// Writes correction[i] (x, y, z in m) for i in [first, last); reads any particle, moves none.
  virtual void gather(const ConstraintContext&, const ParticleView&, const NeighbourView&, size_t /*first*/,
                      size_t /*last*/, Float4* /*correction*/) const {}
};

}  // namespace ps::api
