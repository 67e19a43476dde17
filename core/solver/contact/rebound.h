// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/contact/impacts.h"
#include "core/solver/contact/inertia.h"
#include "core/solver/contact/rigidcontact.h"

#include <string>
#include <tuple>
#include <vector>

namespace ps {

class PieceLists;
class StateReader;
class StateWriter;

/// Restitution of soft bodies. Their constraints are solved implicitly, which takes the energy of an impact out while
/// its wave goes through the body (the bounce of the particles that touch is lost among their neighbours), so that what
/// is asked for has to be given to the body as a whole: every piece that hangs together, by bonds or clusters.
///
/// An impact lasts from the first touch until the piece is pushed no more: its structure may be squeezed and come back
/// meanwhile. All that touches in this time remembers the normal speed at which it would have met when the impact began
/// (Mueller et al. 2020, "Detailed rigid body simulation with XPBD", eq. 34, with speeds from before the positions were
/// solved, and over the substeps that the impact takes instead of one). At its end impulses at the places of touch,
/// with the response of a rigid body, bring each of them to `restitution` times that speed, once: projected
/// Gauss-Seidel, none pulls, friction within the cone. Structure that comes back faster than that in the mean is held
/// back, as long as the two touch. What two pieces exchange is opposite and acts at one place, so that linear and
/// angular momentum stay, and no impulse leaves the two more kinetic energy than they had when they met. What meets
/// more slowly than gravity pulls in two substeps does not bounce.
///
/// It cannot do: what an impact leaves of the shape (a body that has lost or gained more than a third of its mean
/// square radius has not rebounded, and gets nothing); impacts of less than a piece, as of the tip of a long soft beam,
/// which the whole of it answers for; sheets, ropes, and what hangs on something fixed (Impacts lets their particles
/// bounce one by one). Rigid bodies have RigidContact among themselves; with soft ones they meet here.
class Rebound {
 public:
  /// Who hangs together, as ConstraintSystem::findPieces() has it, and what rigid bodies touch. Lists of pieces live
  /// until refresh().
  struct Structure {
    const ConstraintSystem& constraints;
    std::span<const uint32_t> pieceOf;
    const PieceLists& pieces;
    const RigidContact& rigid;
  };
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 std::span<const BakedMaterial> materials);
  /// After a new order or a new structure.
  void refresh() { m_stale = true; }
  /// When the impacts of a substep are known and before positions are solved: takes over those of pieces.
  void meet(const ParticleStore& store, const Structure& structure, Impacts& impacts);
  /// When velocities are known.
  void part(ParticleStore& store, const Structure& structure);
  /// What walls and fixed particles gave in part(), kg m/s.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }
  /// What the last impacts of each material have not delivered: by nine tenths, that is.
  void limits(std::vector<Limit>& out) const;
  /// Impacts end in which something that has been carried away takes part: `goes` by particle.
  void forget(const ParticleStore& store, std::span<const uint8_t> goes);
  void save(StateWriter& writer) const;
  void restore(const StateReader& reader);

 private:
  static constexpr uint32_t kNone = ~0u;
  /// Of a piece: velocity of its centre, m/s, and rad/s.
  struct Motion {
    Vector3 velocity, spin;
  };
  struct Piece {
    std::span<const uint32_t> members;
    bool whole = true;      ///< free, not thin, and either soft or one rigid body
    uint32_t body = kNone;  ///< of RigidContact
    uint64_t readAt = 0;    ///< when what follows was read
    MassSpread spread;
    double kinetic = 0;     ///< J, of its particles
    Motion before, motion;  ///< without the impulses of part(), and with them
  };
  /// Two pieces, or one and what is fixed, from when they meet until they part. Ids are those of particles; what is
  /// found by them is no state.
  struct Encounter {
    uint32_t idA = kNone, idB = kNone;    ///< a member of each; kNone: walls and what is fixed
    uint32_t steps = 0, settled = 0;      ///< substeps that it has lasted; 1 when all have been given their speeds
    double kinetic = 0;                   ///< J, when it began, seen from what is fixed
    double gyrationA = 0, gyrationB = 0;  ///< m2, mean square radius, then
    double speed = 0;                     ///< m/s, the mean normal speed of all that touches, in the last substep
    Motion a, b;                          ///< when it began
    uint32_t pieceA = kNone, pieceB = kNone;
  };
  struct Touch {
    uint32_t encounter = 0;
    uint32_t idA = kNone, idB = kNone, plane = kNone;
    Vector3 normal;                                      ///< towards a
    double approach = 0, restitution = 0, friction = 0;  ///< m/s, below 0
    uint32_t a = kNone, b = kNone;                       ///< particles
    Vector3 armA, armB;                                  ///< m, from the centres to the place of touch
    Vector3 outside;                                     ///< m/s, of what is fixed
    double mass = 0, impulse = 0;                        ///< kg, generalised; kg m/s
    Vector3 rub;                                         ///< kg m/s
    double wanted() const { return -restitution * approach; }
    auto key() const { return std::tuple(encounter, idA, idB, plane); }
  };
  template <class AnEncounter, class Visit>
  static void eachNumber(AnEncounter& encounter, Visit&& visit);
  void findPieces(const ParticleStore& store, const Structure& structure);
  void findAgain(const ParticleStore& store);
  uint32_t wholePieceOf(uint32_t particle) const {
    const uint32_t piece = particle == kNone ? kNone : m_pieceOf[particle];
    return piece != kNone && m_pieces[piece].whole ? piece : kNone;
  }
  void read(const ParticleStore& store, uint32_t piece);
  void place(const ParticleStore& store, Touch& touch) const;
  Vector3 velocityOf(const Touch& touch, const Motion& a, const Motion& b) const;
  Vector3 velocityOf(const Touch& touch) const;
  double responseOf(const Touch& touch, const Vector3& along) const;
  void give(const Touch& touch, const Vector3& impulse);
  double kineticOf(const Encounter& encounter, const Vector3& frame) const;
  bool isMet(const Touch& touch) const;
  uint32_t encounterOf(const ParticleStore& store, Touch& touch);
  void add(const ParticleStore& store, const Impacts::Impact& impact, size_t known);
  void addRigid(const ParticleStore& store, const RigidContact& rigid, size_t known);
  void sortTouches();
  bool keptShape(const Encounter& encounter) const;
  bool touches(const ParticleStore& store, const Touch& touch) const;
  void solve(std::span<Touch> touches);
  void holdBack(std::span<Touch> touches);
  void takeGain(const Encounter& encounter, std::span<Touch> touches, const Vector3& frame);
  void hand(ParticleStore& store, uint32_t piece);
  void settle(ParticleStore& store, const Encounter& encounter, std::span<Touch> touches, bool again);
  void note(const ParticleStore& store, std::span<const Touch> touches);
  bool goOn(ParticleStore& store, Encounter& encounter, std::span<Touch> touches);

  double m_dt = 0, m_spacing = 0, m_slowest = 0;
  Vector3 m_gravity;
  std::vector<WallFace> m_walls, m_wallsBefore;
  /// Of a material; delivered as the last impact had it.
  struct Bounce {
    std::string id;
    double friction = 0, restitution = 0, asked = 0, delivered = 0;
  };
  std::vector<double> m_wallFriction;
  std::vector<Bounce> m_materials;
  bool m_stale = true, m_anySoft = false;
  uint64_t m_now = 0;  ///< counts the times when velocities have changed
  std::vector<uint32_t> m_pieceOf;
  std::vector<uint8_t> m_broken;  ///< of findPieces(): by piece, 1 where it is no whole
  std::vector<Piece> m_pieces;
  std::vector<Encounter> m_encounters;
  std::vector<Touch> m_touches;  ///< by encounter
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
};

}  // namespace ps
