// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/particles/particlestore.h"
#include "core/solver/motion.h"

#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// Moves fixed particles of bodies as their motions prescribe, whatever they meet. Each body has a frame, a centre and
/// a turn in double precision, and its particles keep their places in it: however long it turns, its shape stays that
/// of the start to the rounding of a position. Only products, sums and square roots: the same bits on every machine.
class PrescribedMotion {
 public:
  /// The first motion that is none at rest gives the body a frame, and its fixed particles their places in it; further
  /// ones say how it goes on from where it is.
  void set(uint32_t body, const BodyMotion& motion, ParticleStore& store);
  /// New particles of bodies that have a frame take their places in it, and its velocity at `time` (s).
  void adopt(ParticleStore& store, size_t first, size_t last, double time) const;
  /// Matter that was away has missed the way of its frame, and stands at its place in it again; what was taken before
  /// there was a frame, at the place that it would have been given.
  void putBack(ParticleStore& store, size_t first, size_t last) const;
  /// Whether a body is on its way at some time of the next `dt` s.
  bool movesWithin(double time, double dt) const;
  /// Moves the frames on through a substep of `dt` s that begins at `time`.
  void advance(const Period& period, double time, double dt);
  /// Positions and velocities of the particles first..last-1 that have a place in a frame, in the image nearest to
  /// their previous positions. A body that is on its way for a part of the substep has that part of its velocity.
  void lead(ParticleStore& store, size_t first, size_t last) const;
  /// The body's frame goes there, and all that has a place in it with the next substep; so does where a hand leads it.
  void carry(uint32_t body, const RigidMove& move);
  /// A hand leads the body farther than it was to go until now: turned about its centre of mass, which is at `centre`
  /// m now, and which goes by `way` m. That comes on top of its own motion. See startFrame().
  void follow(uint32_t body, const Vector3& centre, const Quaternion& turn, const Vector3& way, ParticleStore& store);
  /// m that what is led by a hand goes in the next frame, of all its particles the one that goes farthest: half of what
  /// is left of its way, or as much as a hand goes at kFastestHand in `dt` s. The speed of a hand is known from where
  /// it was at a few times only; this smooths it.
  double nextWay(double dt) const;
  /// When a frame begins: it goes so far, at an even speed, and no farther than `most` m.
  void startFrame(int substeps, double dt, double most);
  /// m that are left of the way that a hand leads the body, at most of all its particles.
  double leftOf(uint32_t body) const;
  void save(StateWriter& writer) const;
  /// After the store. Motions are those that were saved; set() says otherwise.
  void restore(const StateReader& reader, const ParticleStore& store);

 private:
  /// What is left of the way that a hand leads a frame.
  struct Lead {
    Vector3 way;                               ///< m, of the frame's centre
    Quaternion turn = Quaternion::Identity();  ///< of unit length
    double radius = 0;                         ///< m, farthest place from the centre
    bool any() const { return way != Vector3::Zero() || turn.vec() != Vector3::Zero(); }
    double longest() const { return way.norm() + 2 * radius * turn.vec().norm(); }
  };
  /// The part of it in this frame; what of it is still to come.
  struct LeadPart {
    Vector3 way;
    Quaternion turn = Quaternion::Identity();
    int substeps = 0;
    bool arrives = false;
  };
  struct Frame {
    BodyMotion motion;
    Vector3 centre, origin;                    ///< m, now and when the frame was made
    Quaternion turn = Quaternion::Identity();  ///< of unit length
    Matrix3 axes;                              ///< the same as a matrix
    Vector3 velocity, spin;                    ///< m/s and rad/s, of the last substep
    Lead lead;
    LeadPart part;  ///< no state: of the frame that is under way
    bool exists = false;
  };
  void makeFrame(uint32_t body, const BodyMotion& motion, ParticleStore& store);
  static double wayOf(const Frame& frame, double dt);
  static void stepLead(Frame& frame, double dt);
  template <class Frames, class Visit>
  static void eachNumber(Frames& frames, Visit&& visit);
  template <class Frames, class Visit>
  static void eachLead(Frames& frames, Visit&& visit);
  const Frame* frameOf(const ParticleStore& store, size_t i) const;

  std::vector<Frame> m_frames;  ///< by index of the body
};

}  // namespace ps
