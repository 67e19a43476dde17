// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"
#include "core/solver/report.h"

#include <memory>
#include <vector>

namespace ps {

/// What making and tying a particle weigh against placing it or finding its neighbours, of a thread's progress.
inline constexpr double kMakingWeight = 2, kTyingWeight = 4;

enum class Hold : uint8_t { AsItIs, Free, Held };

/// Particles to be born: one entry per particle.
struct Spawn {
  std::vector<api::Double3> position;  ///< m
  std::vector<api::Double3> velocity;  ///< m/s; empty: at rest
  uint32_t material = 0;               ///< index into the material table
  uint32_t body = 0;
  double temperature = 293.15;  ///< K
  double volume = 0;            ///< m3, of each at birth; 0: of a cell of the lattice
  api::Phase phase = api::Phase::Liquid;
  std::vector<double> temperatures;  ///< K, one each; empty: `temperature` for all
  std::vector<api::Phase> phases;    ///< one each; empty: `phase` for all
  bool fixed = false;                ///< static boundary particles: they go on at their velocity, or as
                                     ///< setMotion() says, whatever they meet
  /// Matter on its way in, or kept where it is: its neighbours feel it as what it is, but it goes on at its velocity,
  /// if it has one, whatever it meets, until Solver::release() or hold() lets it go.
  bool held = false;
  bool packed = false;                   ///< it lies in disorder: see Solver::settle()
  std::vector<uint32_t> constraintSets;  ///< built over the new particles
};

struct CopiedConstraints;

/// Matter outside a solver, with every field and the structure that held it; opaque to its keeper.
struct ExtractedMatter {
  CopiedParticles particles;
  std::shared_ptr<const CopiedConstraints> constraints;
};

/// Where a hand cuts: ties that go through a disc, or, without a normal, that have a part within a ball.
struct Blade {
  Vector3 centre;  ///< m
  double radius;   ///< m
  Vector3 normal;  ///< unit vector, or zero
  bool isDisc() const { return normal.squaredNorm() > 0; }
};

/// Ties that a hand broke or made, by the ids of particles; opaque to its keeper.
struct TieChange {
  bool made = false;
  std::vector<uint64_t> cuts;  ///< pairs that it parted, or that are parted no more: see Cuts
  std::shared_ptr<const CopiedConstraints> ties;
  bool empty() const { return cuts.empty() && !ties; }
};

/// What particles were before they were made of another material, and after; opaque to its keeper.
struct PaintedMatter {
  CopiedParticles before, after;
  uint32_t material = 0;  ///< that they became
  struct Books {
    HeatLedger ledger;
    double offset = 0;  ///< J, of the energy balance
    bool operator==(const Books&) const = default;
  } booksBefore, booksAfter;
};

}  // namespace ps
