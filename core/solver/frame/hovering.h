// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/contact/wallplane.h"
#include "core/solver/fluid/density.h"
#include "core/solver/report.h"
#include "core/solver/structure/constraintsystem.h"
#include "core/solver/structure/piecelists.h"

#include <span>
#include <vector>

namespace ps {

/// Watches for what should sink and does not: at rest the particles of a liquid lie in order, and hold up what is some
/// tenths denser and a few spacings large (TrappedFilm says how much).
///
/// A piece hangs when in a second it has gone less than a twentieth of the way that it would sink in that time, though
/// it is denser than the liquid around, wet on all sides (a boat is not, nor is what is hollow), free to move, and
/// nothing stands below it within a spacing. How fast it would sink: sqrt(e g L), L the edge of a cube of its volume
/// and e its excess of density, or in a thick liquid a twentieth of Stokes's e rho g L2/(18 mu), which leaves room for
/// walls. It says nothing of single grains, sheets and lines, of what hangs on something fixed, in liquids whose yield
/// stress may hold it, and in a stream that may carry it up.
///
/// It only looks: what it knows is no state, and begins anew when matter is brought back.
class Hovering {
 public:
  struct Matter {
    const ParticleStore& store;
    const Neighbours& neighbours;
    std::span<const uint32_t> pieceOf;
    const PieceLists& pieces;
    std::span<const uint32_t> wetSolids, hanging;
    std::span<const uint8_t> thinBodies;
  };
  void configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                 std::span<const BakedMaterial> materials);
  /// At the end of a frame.
  void observe(const Matter& matter);
  /// Of each material what hangs most against its weight: asked is its density, delivered the liquid's.
  void limits(std::vector<Limit>& out) const;

 private:
  static constexpr uint32_t kNone = ~0u;
  /// A piece with liquid around it, as the frame ended.
  struct Piece {
    size_t list = 0;                              ///< of its members
    uint32_t id = kNone, material = 0;            ///< the least of its particles; of the first one
    bool free = true;                             ///< moves by itself
    double mass = 0, volume = 0, moment = 0;      ///< kg, m3, kg m
    double seconds = 0, start = 0, farthest = 0;  ///< of the present watch: s, height at its beginning and way, m
    double solid = 0, liquid = 0;                 ///< kg/m3, of one that hangs
    double height() const { return moment / mass; }
  };
  /// What lies around a piece.
  struct Around {
    void add(const Around& other);
    double liquid = 0, density = 0, rise = 0, viscosity = 0;  ///< neighbours, and sums over them
    double yieldStress = 0;                                   ///< Pa, the most of them
    size_t members = 0, dry = 0;
    bool stands = false;  ///< on something
  };
  /// As many members of a piece as a chunk holds.
  struct Run {
    size_t piece;
    std::span<const uint32_t> members;
  };
  void findPieces(const Matter& matter);
  void remember();
  void add(const Matter& matter, const Run& run, Piece& piece) const;
  Around around(const Matter& matter, std::span<const uint32_t> members);
  void judge(const Matter& matter, Piece& piece);
  void lookAround(const Matter& matter, uint32_t i, Around& around) const;
  double wallShare(const api::Float4& at) const;

  SolverSettings m_settings;
  std::span<const BakedMaterial> m_materials;
  std::vector<WallSurface> m_walls;
  Kernel m_kernel{KernelShape::CubicSpline, 1};
  HalfSpaceTable m_halfSpace;
  Vector3 m_up;  ///< zero without gravity
  double m_gravity = 0;
  std::vector<uint8_t> m_isWet;           ///< by piece of the structure
  std::vector<uint8_t> m_hangs;           ///< by particle
  std::vector<Piece> m_pieces, m_former;  ///< of this frame, and of the one before
  std::vector<Run> m_runs;
  std::vector<Piece> m_parts;    ///< of runs
  std::vector<Around> m_around;  ///< of chunks of a piece
};

}  // namespace ps
