// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ps {

/// Impulse and its moment about the origin, kg m/s and kg m2/s; or their rates, N and N m.
struct Wrench {
  Vector3 force, torque;
};

/// What walls and the fixed particles of bodies get from all that moves, as far as somebody watches them: stages tell
/// each impulse as they give its opposite to matter. In a loop over chunks one sum for each chunk, added in order, so
/// that threads have no part in it, and in cache lines of its own, so that they do not wait for each other.
class Reactions {
 public:
  /// For stages that nobody listens to.
  static Reactions& none();

  /// By index, of those that are to be measured alone; with `all` the rest of them together as well.
  void watch(std::span<const uint32_t> walls, std::span<const uint32_t> bodies, bool all);
  size_t slots() const { return m_slots; }
  bool any() const { return m_slots > 0; }
  bool watchesWalls() const { return !m_ofWall.empty() || m_rest != kNone; }
  bool watchesBodies() const { return !m_ofBody.empty() || m_rest != kNone; }
  /// kNone for those that nobody watches: what is said of them is not heard.
  static constexpr int kNone = -1;
  int ofWall(size_t wall) const { return slotOf(m_ofWall, wall); }
  int ofBody(uint32_t body) const { return slotOf(m_ofBody, body); }
  /// Of those that are not measured alone; kNone: not watched.
  int rest() const { return m_rest; }

  /// Everything is 0 again.
  void clear();
  void setStep(double dt) { m_perStep = 1 / dt; }  ///< s, of a substep
  double perStep() const { return m_perStep; }     ///< 1/s: times a displacement in kg m it is an impulse

  /// Begins and ends a loop over so many chunks.
  void start(size_t chunks);
  void finish();
  /// Impulse in kg m/s on a wall or body, at a place in m; within a loop.
  void add(size_t chunk, int slot, const Vector3& place, const Vector3& impulse) {
    if (slot != kNone) put(m_partial[chunk * m_slots + static_cast<size_t>(slot)], place, impulse);
  }
  /// The same outside of loops.
  void add(int slot, const Vector3& place, const Vector3& impulse) {
    if (slot != kNone) put(m_sum[static_cast<size_t>(slot)], place, impulse);
  }
  void add(int slot, const Wrench& wrench);
  /// Since clear().
  const Wrench& sum(int slot) const { return m_sum[static_cast<size_t>(slot)]; }
  /// Of all that is watched.
  Wrench total() const;

 private:
  int slotOf(const std::vector<int>& slots, size_t index) const {
    return index < slots.size() && slots[index] != kNone ? slots[index] : m_rest;
  }
  static void put(Wrench& wrench, const Vector3& place, const Vector3& impulse);

  size_t m_slots = 0;
  int m_rest = kNone;
  std::vector<int> m_ofWall, m_ofBody;
  struct alignas(64) Partial : Wrench {};
  std::vector<Wrench> m_sum;
  std::vector<Partial> m_partial;
  double m_perStep = 0;
};

}  // namespace ps
