// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"
#include "core/solver/report.h"

#include <vector>

namespace ps {

/// Who gives mechanical energy to what moves, or takes it: kinetic energy and that of weight, -m g x, are summed anew
/// whenever another stage has had its turn. Within a substep, while only positions change, velocities are those that
/// the positions ask for, (x - x_old)/dt, as position-based dynamics takes them at its end; all parts of a frame
/// add up to what it gained, to rounding. Angular momentum, about the origin, is read with it.
///
/// Costs a pass over all particles for every stage and iteration, and is made only where somebody asks for it. It
/// cannot do: tell apart what constraints store and give back from what they lose; friction from inelastic contact,
/// which are one projection.
class Balance {
 public:
  using Part = MechanicalRecord::Part;

  void watch(bool on) { m_on = on; }
  bool isOn() const { return m_on; }

  /// When a frame begins, before anything moves.
  void begin(const ParticleStore& store, const Vector3& gravity);
  /// What has changed since the last call is this part's; `perStep` is 1/dt in 1/s while positions tell velocities, and
  /// 0 while velocities do.
  void mark(const ParticleStore& store, Part part, double perStep);
  /// `external`: kg m2/s from walls and what is fixed in this frame.
  MechanicalRecord end(const Vector3& external);

 private:
  struct Sums {
    double kinetic = 0, potential = 0;  ///< J
    Vector3 angular;                    ///< kg m2/s
  };
  Sums read(const ParticleStore& store, double perStep);

  bool m_on = false;
  Vector3 m_gravity;  ///< m/s2
  Sums m_last;
  MechanicalRecord m_record;
  Vector3 m_external;  ///< kg m2/s, of gravity and air
  std::vector<Sums> m_partial;
};

}  // namespace ps
