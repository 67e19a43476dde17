// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/cellgrid.h"
#include "core/particles/reactions.h"
#include "core/solver/contact/solidcontact.h"
#include "core/solver/contact/wallplane.h"

namespace ps {

/// Impacts of single solid particles (members of rigid bodies are left to RigidContact) with each other, with static
/// ones and with walls. At the start of a substep each pair's spheres are swept along their relative way, exactly:
/// whatever would pass through another one between two positions waits where they meet, and when velocities are known
/// the pair parts at `restitution` times the speed at which it met (Mueller et al. 2020, section 3.6), along the normal
/// of the face where two lattices meet, as in SolidContact: along the line of centres a smooth belt that goes a good
/// part of a spacing in a substep would carry what lies on it. Pairs take the larger restitution of their materials,
/// walls that of what meets them. What meets more slowly than gravity pulls in two substeps does not bounce. What waits
/// loses up to a substep of its way, never of its velocity. Found on all threads; taken one by one, in order of time:
/// they are few. It cannot do: find what a particle would hit after its first impact of a substep, where that is not
/// static.
class Impacts {
 public:
  static constexpr uint32_t kNone = ~0u;
  struct Impact {
    uint32_t a, b, plane;  ///< two particles, or one and a wall
    double time;           ///< share of the substep
    Vector3 normal;        ///< towards a
    double approach;       ///< m/s, below 0
    double restitution;
    bool crosses;  ///< fast enough to pass through
    bool loose;    ///< neither is tied to anything
  };
  /// Who hangs together: `pieceOf` as ConstraintSystem::pieces() has it, 1 in `rigid` for members of rigid bodies.
  struct Structure {
    ConstraintSystem& constraints;
    std::span<const uint32_t> pieceOf;
    std::span<const uint8_t> rigid;
  };
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 std::span<const BakedMaterial> materials);
  /// When positions have been predicted: stops those that would pass through each other. Lists may be those of the last
  /// substep: they tell lattices, whose particles stay neighbours.
  void sweep(ParticleStore& store, const Neighbours& neighbours, const Structure& structure);
  /// When lists are fresh: finds all other impacts of the substep.
  void collect(const ParticleStore& store, const SolidContact& contact, ConstraintSystem& constraints,
               std::span<const uint8_t> rigid);
  /// Those of the substep, in order of time, when they have been collected.
  std::span<Impact> found() { return m_impacts; }
  /// When velocities are known.
  void bounce(ParticleStore& store);
  /// What walls and fixed particles gave in bounce(), kg m/s.
  ExternalImpulse& externalImpulse() { return m_externalImpulse; }
  /// Where walls and fixed particles are told what they get.
  void tell(Reactions& reactions) { m_reactions = &reactions; }

 private:
  struct Stop {
    uint32_t particle;
    Vector3 left;  ///< m/s, share of the velocity that it has not travelled at
  };
  double restitutionOf(const ParticleStore& store, uint32_t i) const;
  double wayOf(const ParticleStore& store, uint32_t i) const;  ///< m, in this substep
  bool isFast(const ParticleStore& store, uint32_t i) const;
  void findWalls(const ParticleStore& store, std::span<const uint8_t> rigid);
  void findImpacts(const ParticleStore& store, std::span<const uint8_t> rigid, uint32_t plane, size_t first,
                   size_t last, std::vector<Impact>& found) const;
  double fastestSolid(const ParticleStore& store, size_t first, size_t last) const;
  void findFast(const ParticleStore& store, const Neighbours& neighbours, const Structure& structure);
  double findSolids(const ParticleStore& store, const Structure& structure);
  void turnToFaces(const ParticleStore& store, const Neighbours& neighbours, const Structure& structure, size_t chunks);
  void startChunks(size_t count);
  void takeChunks(size_t count);
  bool test(const ParticleStore& store, const StructureGraph& graph, uint32_t i, uint32_t j, const api::Float4& face,
            Impact& impact) const;
  double timeOf(const Vector3& line, const Vector3& way, const api::Float4& face) const;
  void sortByTime(const ParticleStore& store);
  void keepFirst(const ParticleStore& store);
  void stop(ParticleStore& store, uint32_t i);
  void bookOutside(const ParticleStore& store, const Impact& impact, const Vector3& impulse);

  double m_dt = 0, m_diameter = 0, m_spacing = 0, m_slowest = 0;
  Vector3 m_gravity;
  std::vector<WallFace> m_walls;      ///< half a spacing before them
  std::vector<double> m_restitution;  ///< by material
  std::vector<Impact> m_impacts;
  std::vector<std::vector<Impact>> m_found;  ///< by chunk of what is looked through
  std::vector<Stop> m_stops;
  ExternalImpulse m_externalImpulse;
  Reactions* m_reactions = &Reactions::none();
  std::vector<uint32_t> m_solids;  ///< that may be met in passing
  std::vector<double> m_ways;      ///< of them, m
  std::vector<double> m_longest;   ///< way by chunk of particles, m
  CellGrid m_grid;                 ///< of m_solids
  LatticeSurface m_surface;        ///< of fast pairs that meet
  std::vector<double> m_first;     ///< by particle: time of its first impact; 2: none
};

}  // namespace ps
