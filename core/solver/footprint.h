// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <span>

namespace ps {

/// Structure that a plugin gives matter: ties of `arity` particles, or memberships in groups.
struct StructureFootprint {
  double perParticle = 0;          ///< ties that begin at a particle, or groups that it is a member of
  size_t arity = 0;                ///< of ties; 0: groups
  size_t values = 0;               ///< floats of each tie or membership
  double groupsPerMembership = 0;  ///< 1 over the members of a group
  size_t groupValues = 0;          ///< floats of each group
};

/// What decides how much memory a particle takes.
struct MatterFootprint {
  double neighbours = 0;  ///< in its list
  double fieldBytes = 0;  ///< of the fields that plugins keep of it
  double walls = 0;       ///< of the scene
  bool heat = false;      ///< flows, by a thermal model
  bool radiation = false;
  bool pairLaw = false;  ///< heat flows by the model's own law of pairs
  bool dry = false;      ///< nothing in its scene can flow
  bool thick = false;    ///< may be a liquid that the implicit viscosity moves
  std::span<const StructureFootprint> structures{};
};

/// Mean number of neighbours within `reach` spacings on a lattice of so many layers along each axis.
double latticeNeighbours(const std::array<double, 3>& layers, double reach);
/// Mean number of neighbours that a particle of such a body may come to have in its list: matter that was a sheet or a
/// line stays one while it is solid, what flows may pile up and is as dense as a liquid then. `reach` in spacings.
double listedNeighbours(const std::array<double, 3>& layers, double reach, bool keepsShape);

/// Bytes that a particle takes in a solver that has run for a while, all stages at work and the last good frame kept,
/// and in the snapshots that show it. Lists have grown by then as vectors grow.
double bytesPerParticle(const MatterFootprint& matter);
/// Bytes that a scene takes whatever is in it: tables of materials, grids of rays.
double bytesPerScene(size_t materials, bool radiation);

}  // namespace ps
