// SPDX-License-Identifier: Apache-2.0
#include "core/particles/reactions.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace ps {

Reactions& Reactions::none() {
  static Reactions nobody;
  return nobody;
}

void Reactions::watch(std::span<const uint32_t> walls, std::span<const uint32_t> bodies, bool all) {
  m_slots = 0;
  const auto number = [&](std::span<const uint32_t> watched, std::vector<int>& slots) {
    slots.clear();
    for (const uint32_t index : watched) {
      if (index >= slots.size()) slots.resize(index + size_t{1}, kNone);
      if (slots[index] == kNone) slots[index] = static_cast<int>(m_slots++);
    }
  };
  number(walls, m_ofWall);
  number(bodies, m_ofBody);
  m_rest = all ? static_cast<int>(m_slots++) : kNone;
  m_sum.assign(m_slots, {});
}

void Reactions::clear() { std::fill(m_sum.begin(), m_sum.end(), Wrench{}); }

Wrench Reactions::total() const {
  Wrench total;
  for (const Wrench& sum : m_sum) {
    total.force += sum.force;
    total.torque += sum.torque;
  }
  return total;
}

void Reactions::start(size_t chunks) {
  if (any()) m_partial.assign(chunks * m_slots, {});
}

void Reactions::finish() {
  for (size_t k = 0; any() && k < m_partial.size(); ++k) add(static_cast<int>(k % m_slots), m_partial[k]);
}

void Reactions::add(int slot, const Wrench& wrench) {
  if (slot == kNone) return;
  Wrench& sum = m_sum[static_cast<size_t>(slot)];
  sum.force += wrench.force;
  sum.torque += wrench.torque;
}

void Reactions::put(Wrench& wrench, const Vector3& place, const Vector3& impulse) {
  wrench.force += impulse;
  wrench.torque += place.cross(impulse);
}

}  // namespace ps
