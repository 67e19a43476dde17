// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/impulse.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/latticesurface.h"
#include "core/solver/contact/nearwalls.h"
#include "core/solver/contact/wallplane.h"
#include "core/solver/structure/constraintsystem.h"

namespace ps {

class StateReader;
class StateWriter;

/// Contact of rigid bodies with walls, with each other, and with other solid and static particles. A contact acts on
/// the body as a whole, by its generalised inverse mass 1/M + (r x n).I^-1 (r x n) (Mueller et al. 2020, eq. 2):
/// projecting member by member and matching the shape afterwards creeps down a slope. Per substep every contact adds up
/// its normal impulse, which stays positive, and its friction, which stays within the cone: the static one, or the
/// kinetic one of a contact that slid at the end of the last substep. While two stick, what friction could not take
/// back in one substep is asked for in those after it, so that a stack does not creep by what iterations leave over.
/// Projected Gauss-Seidel, started from the impulses of the last substep, serial, in an order scattered by the
/// particles' ids, so that threads have no part in it: contacts are few.
///
/// What strikes something is solved before, over velocities: all impulses of bodies that may touch each other with the
/// places and the inertia of one instant, the one when the first of them meet. It parts again with its restitution,
/// rubs within the cone, and nobody pulls (Moreau 1988; Stewart and Trinkle 1996). Projection would turn a body to
/// remove the overlap, which changes its energy or its angular momentum. What projection has given all the same is
/// solved again in that way afterwards, so that speed which only the removal of an overlap gave is taken out. What
/// iterations leave of energy that nobody had is taken from the impulses of those who touch.
///
/// Particles are spheres, but where a face of the lattice takes part its own normal is used, so that layers do not
/// interlock. A box therefore tips as if its base were one spacing narrower, and an edge of it is round. It cannot do:
/// stop a body that crosses another moving one within one substep; several strikes one after the other within one
/// substep, which are taken as one; keep the angular momentum of bodies that slide on each other better than by some
/// percent of what they exchange.
class RigidContact {
 public:
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 std::span<const BakedMaterial> materials);
  /// Which particles belong to a rigid body (1), by index: other contact leaves them alone.
  std::span<const uint8_t> members() const { return m_isMember; }
  bool any() const { return !m_bodies.empty(); }
  /// Which rigid body a particle belongs to, ~0 for none.
  std::span<const uint32_t> bodyOf() const { return m_bodyOf; }
  /// After begin(): visit(member, particle, normal towards the member, distance at rest in m, restitution) for what
  /// bodies and particles of none that can move come near of each other, faster than gravity pulls in two substeps.
  template <class Visit>
  void forFree(Visit&& visit) const {
    for (const Contact& c : m_contacts) {
      if (c.active && c.b.inverseMass > 0 && c.approach < -m_slowest)
        visit(c.a.particle, c.b.particle, c.normal, c.distance, c.restitution);
    }
  }
  /// After a new order or a new structure: who belongs to which body.
  void refreshBodies(const ParticleStore& store, const ConstraintSystem& constraints);
  /// After new lists or a new structure: which contacts may come about as long as the lists hold, by the positions that
  /// they were made for.
  void refreshContacts(const ParticleStore& store, const Neighbours& neighbours, ConstraintSystem& constraints);
  /// What contacts bore, by the particles that meet: refreshContacts() finds the same ones again.
  void save(StateWriter& writer) const;
  void restore(const StateReader& reader);
  /// When positions have been predicted along straight lines, and before bodies turn: what would strike a body, a wall
  /// or fixed matter in this substep bounces before it moves, so that no removal of an overlap turns it, which would
  /// change its energy or its angular momentum.
  void strike(ParticleStore& store);
  /// Once per substep, when positions have been predicted.
  void begin(const ParticleStore& store);
  /// Moves bodies, and single particles that touch them, out of each other.
  void project(ParticleStore& store);
  /// Moves each body back by the longest of its members' ways in `held` (SweptClamp): it stops at a layer of static
  /// particles that it would have crossed, however fast it is.
  /// Returns what it moved, kg m.
  Vector3 hold(ParticleStore& store, std::span<const api::Float4> held, std::span<const uint32_t> heldBy) const;
  /// Moves bodies back that walls could not hold: led bodies may press harder than any contact, and a wall gives way
  /// last. Returns what it moved, kg m.
  Vector3 keepInside(ParticleStore& store) const;
  /// Restitution, when velocities are known.
  void bounce(ParticleStore& store);
  /// What walls and fixed particles gave to bodies in this substep up to now: by contact in kg m, in bounce() in kg
  /// m/s.
  Vector3 pushed() const;
  /// Tells walls and fixed bodies of what pushed() returns.
  void tellPushed(const ParticleStore& store) const;
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

 private:
  static constexpr uint32_t kNone = ~0u;
  /// What is farther from a wall than this, in spacings, is not yet its contact.
  static constexpr double kOpen = 1;
  /// What a body creeps in one substep, in spacings: more is motion, and to ask that back would push.
  static constexpr double kCreep = 1e-4;
  struct BodyMotion {
    Vector3 velocity;  ///< m/s
    Vector3 angular;   ///< kg m2/s, about the centre
  };
  struct Body {
    std::vector<uint32_t> members;
    double inverseMass = 0;  ///< 1/kg
    Matrix3 inverseInertia;  ///< 1/(kg m2), about the centre
    Vector3 centre;          ///< m
    Vector3 shift, turn;  ///< m, rad: what contacts did since positions were read; m/s, rad/s in strike() and bounce()
    Vector3 markedShift, markedTurn;  ///< m, rad: these, as the last pass over contacts left them
    double reach2 = 0;                ///< m2, of the place of contact that is farthest from the centre
    Vector3 turned;                   ///< rad, since the start of the substep, when positions were read
    Vector3 pushed, twisted;          ///< kg m, kg m2: impulses of this substep, and their moments about the centre
    BodyMotion before;                ///< as the substep began, before contacts
    uint32_t island = 0;              ///< the least of bodies that may touch each other, in strike() and bounce()
    Vector3 late;                     ///< kg m, way that impulses have not given since they came late in the substep
    double time = 0;                  ///< of an island, when it is struck, as a share of the substep
    bool struck = false;              ///< an island, in strike()
    double workBefore = 0, workChange = 0;  ///< J, of the impulses in an island, likewise
    bool touched = false, hasContacts = false;
  };
  /// One side of a contact: a point of a body, a free particle, or nothing that moves.
  struct Side {
    uint32_t particle = kNone, body = kNone;
    double inverseMass = 0;  ///< 1/kg of a free particle
    Vector3 start{};         ///< m, the particle when positions were read
    Vector3 velocity{};      ///< m/s, of a particle of no body, before contacts, as the substep began
    Vector3 arm{};           ///< m, from the body's centre to the place of contact
  };
  /// What an impulse does to a side: how far its place of contact moves along it, times its length (for a unit vector
  /// the generalised inverse mass, 1/kg), and how the body turns.
  struct Response {
    double inverseMass = 0;
    Vector3 turn;
  };
  struct Contact {
    Side a, b;
    Response ofA, ofB;  ///< along the normal
    uint32_t plane = kNone;
    uint64_t key = 0;  ///< the same for the two, whatever their indices
    double staticFriction = 0, kineticFriction = 0, restitution = 0;
    Vector3 normal;                                    ///< from b to a
    double distance = 0;                               ///< m, along the normal at rest; for a plane its offset
    double gap = 0;                                    ///< m, when positions were read
    Vector3 way;                                       ///< m, of a against b since the start of the substep, likewise
    double mass = 0;                                   ///< kg, generalised, along the normal; 0: not known
    bool active = false, met = false, slides = false;  ///< met: overlapped at some time of the substep
    double push = 0;                                   ///< kg m, summed over the substep
    Vector3 rub;                                       ///< kg m
    bool yields = false;                               ///< friction is all that the cone allows
    Vector3 left;            ///< m, tangential way in the substep that friction has not taken back
    Vector3 drift;           ///< m, the sum of it since the two began to stick
    double approach = 0;     ///< m/s, normal speed before the substep
    bool strikes = false;    ///< in this substep, by strike()
    bool takesPart = false;  ///< in the speeds that are being solved
    Vector3 before;          ///< m/s, of a against b without impulses, in strike() and bounce()
    double wanted = 0;       ///< m/s, the least normal speed after, likewise
    double impulse = 0;      ///< kg m/s, along the normal, likewise
    Vector3 friction;        ///< kg m/s, likewise
  };
  /// A contact as the substep began, in m.
  struct Meeting {
    Vector3 place;        ///< of particle a
    Vector3 wayOfA, way;  ///< in a substep without contact: of a, and of a against b
    Vector3 line, image;  ///< from b's nearest image to a, from b to that image
    double gap = 0;
  };
  /// What tells whether an active contact touches: the sweeps ask far more often than there is something to do.
  struct Open {
    Contact* contact;
    Vector3 normal, leverA, leverB;  ///< arm x normal of each side
    double gap;
    uint32_t bodyA, bodyB;
  };

  static void place(ParticleStore& store, Body& body);
  static Vector3 shift(ParticleStore& store, const Body& body, const Vector3& way);
  Vector3 takeBack(ParticleStore& store, const Body& body) const;
  struct Box {
    Vector3 low, high;  ///< m
  };
  static Box boxOf(const Body& body, const api::Float4* points);
  static bool isClear(const WallFace& wall, const Box& box, double depth);
  struct Deepest {
    double depth = 0;
    Vector3 normal;
    void operator+=(const Deepest& other) {
      if (other.depth > depth) *this = other;
    }
  };
  static Deepest depthOf(const WallFace& wall, const Body& body, const api::Float4* points);
  Vector3 movedBy(const ParticleStore& store, const Side& side) const;
  Vector3 readSide(const ParticleStore& store, Side& side, const Vector3& place) const;
  Response responseOf(const Side& side, const Vector3& impulse) const;
  void push(ParticleStore& store, const Side& side, const Vector3& impulse, double size, const Response& response);
  void push(ParticleStore& store, const Side& side, const Vector3& impulse);
  /// Two that may touch, without what contact is told by: small enough to be sorted.
  struct Candidate {
    uint64_t scattered, key;
    uint32_t a, b;   ///< particles; b kNone: a plane
    uint32_t plane;  ///< kNone: b
  };
  static Candidate candidateOf(uint32_t a, uint32_t b, uint32_t plane, uint64_t key);
  WallSet wallsNear(std::span<const api::Float4> places) const;
  void findCandidates(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph);
  Contact contactOf(const ParticleStore& store, const Candidate& candidate) const;
  Contact planeContactOf(const ParticleStore& store, const Candidate& candidate) const;
  void sortCandidates();
  void findSurfaces(const ParticleStore& store, const Neighbours& neighbours);
  void keepImpulses();
  template <class AContact, class Visit>
  static void eachNumber(AContact& contact, Visit&& visit);
  template <class T, size_t Each, class Put>
  void saveEach(StateWriter& writer, const char* name, const Put& put) const;
  void orient(const ParticleStore& store, Contact& contact) const;
  /// By the wall where it is nearest to a place; a plane is the same everywhere.
  void faceWall(const api::Float4& place, Contact& contact) const;
  void remember(Contact& contact) const;
  static double slideOf(const Contact& contact, const Vector3& speed);
  double gapOf(const ParticleStore& store, const Open& open) const;
  double solve(ParticleStore& store, Contact& contact, double gap);
  void resume(ParticleStore& store);
  void markPlaces();
  double moveSinceMark();
  void beginContact(const ParticleStore& store, Contact& contact) const;
  void readPlaces(const ParticleStore& store);
  void readPlace(const ParticleStore& store, Open& open) const;
  void readResponse(Contact& contact) const;
  static void readMasses(const ParticleStore& store, Body& body, const api::Float4* points);
  Vector3 velocityOf(const ParticleStore& store, const Side& side) const;
  Vector3 velocityOf(const ParticleStore& store, const Contact& contact) const;
  Vector3 velocityBefore(const Side& side) const;
  void give(ParticleStore& store, const Side& side, const Vector3& impulse);
  void give(ParticleStore& store, const Contact& contact, const Vector3& impulse);
  void findIslands();
  void gatherTaking();
  double solveSpeed(ParticleStore& store, Contact& contact);
  void solveSpeeds(ParticleStore& store);
  void takeGainedEnergy(ParticleStore& store);
  bool isStruck(const ParticleStore& store, Contact& contact) const;
  Meeting meetingOf(const ParticleStore& store, const Contact& contact) const;
  static double timeOf(const Meeting& meeting, const Contact& contact);
  void readStart(const ParticleStore& store, Contact& contact);
  void readApproaches(ParticleStore& store);
  static Vector3 centreOf(const ParticleStore& store, const Body& body, const api::Float4* points);
  static BodyMotion motionOf(const ParticleStore& store, const Body& body, const Vector3& centre,
                             const api::Float4* points);
  static double gapAt(const Contact& contact, const api::Float4* points) {
    return vectorOf(points[contact.a.particle]).dot(contact.normal) - contact.distance;
  }
  static void readCentre(const ParticleStore& store, Body& body);

  static bool isOutside(const Contact& contact) { return contact.b.body == kNone && !(contact.b.inverseMass > 0); }

  int slotOf(const ParticleStore& store, const Contact& contact) const;
  void bookOutside(const ParticleStore& store, const Contact& contact, const Vector3& impulse);

  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
  bool m_resume = false;  ///< the substep's first pass is to come
  double m_spacing = 0, m_dt = 0, m_slowest = 0;
  Vector3 m_gravity;
  std::vector<WallFace> m_walls;       ///< half a spacing before them
  std::vector<double> m_wallFriction;  ///< theirs
  struct Rub {
    double staticFriction, kineticFriction, bounce;
  };
  std::vector<Rub> m_materials;
  std::vector<uint8_t> m_isMember;
  std::vector<uint32_t> m_bodyOf;
  std::vector<uint32_t> m_rank;         ///< 1 + body of what holds its shape, kNone where it has none, 0 of others
  std::vector<uint32_t> m_highestRank;  ///< by cell
  std::vector<Body> m_bodies;
  std::vector<Contact> m_contacts, m_former;  ///< by scattered key
  static constexpr size_t kBuckets = 64, kBucketShift = 58;
  using Buckets = std::array<uint32_t, kBuckets>;
  std::vector<std::vector<Candidate>> m_candidatesOf;  ///< by chunk of particles
  std::vector<Buckets> m_bucketsOf;                    ///< how many of them fall into each, then where the next goes
  std::vector<Candidate> m_candidates;
  std::vector<Open> m_open;        ///< in the same order
  std::vector<uint32_t> m_some;    ///< of the contacts, ascending, while they are looked for
  std::vector<Contact*> m_taking;  ///< those that take part in the speeds that are being solved, in the same order
  LatticeSurface m_surface;        ///< of those that may touch others
};

}  // namespace ps
