// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <phasesketch/brush.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

// What a hand does to the matter within a ball. Sums go through particles in their order, so that they are the same for
// any number of threads.
namespace ps {

class Engine;
class ParticleStore;

/// What the contact of a hand in matter is called among those of tools (ToolContact::body), by the key of its commands.
/// No body is called so. Its force, N, is along x: how hard the hand works has no direction.
std::string contactOf(uint64_t key);
/// Whether its numbers can be done.
bool canBe(const api::Touch& touch);

/// Particles within a ball, by their places in the store.
struct Reached {
  std::vector<uint32_t> rows;
  std::vector<double> weights;  ///< kg, mass by falloff
  double total = 0;             ///< kg
};
/// Among whom hands look for what they reach.
struct Reachable {
  std::vector<uint32_t> rows;     ///< ascending, by their places in the store
  std::vector<uint8_t> isSpared;  ///< 1 for bodies that are left out, by the index that particles carry
};
/// All that any of some touches can reach, and others. Why: each of them then looks through few, of a scene of many.
Reachable reachable(const Engine& engine, std::span<const api::Touch> touches, std::vector<uint8_t> isSpared);
/// Of those that a touch is among.
Reached reach(const Engine& engine, const api::Touch& touch, const Reachable& among);
/// 1 for those of the engine's bodies that are among some, by the same index.
std::vector<uint8_t> flagged(const Engine& engine, const std::vector<std::string>& bodies);

/// Adds J that a Heat gives in so many s of thermal time to what particles get.
void addHeat(const Engine& engine, const api::Touch& touch, double seconds, const Reachable& among,
             std::vector<double>& joules);
/// Adds m/s by which a Push changes velocities in so many s.
void addPush(const Engine& engine, const api::Touch& touch, double seconds, const Reachable& among,
             std::vector<Vector3>& change);
/// m, of a particle from the middle of a ball; in a periodic box to the nearest image.
Vector3 offsetOf(const ParticleStore& store, size_t row, const api::Double3& centre);
/// A vector of m/s, but no longer than `most`.
Vector3 atMost(const Vector3& change, double most);

}  // namespace ps
