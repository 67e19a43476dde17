// SPDX-License-Identifier: Apache-2.0
#include "core/solver/frame/forcemeter.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace ps {

bool ForceMeter::watch(std::span<const uint32_t> walls, std::span<const uint32_t> bodies) {
  if (std::equal(walls.begin(), walls.end(), m_walls.begin(), m_walls.end()) &&
      std::equal(bodies.begin(), bodies.end(), m_bodies.begin(), m_bodies.end()))
    return false;
  m_walls.assign(walls.begin(), walls.end());
  m_bodies.assign(bodies.begin(), bodies.end());
  start();
  return true;
}

bool ForceMeter::watchAll(bool all) {
  if (all == m_all) return false;
  m_all = all;
  start();
  return true;
}

void ForceMeter::start() {
  m_reactions.watch(m_walls, m_bodies, m_all);
  const size_t slots = m_reactions.slots();
  m_before.assign(slots, {});
  m_after.assign(slots, {});
  m_forces.assign(slots, {});
  for (std::vector<Wrench>& ties : m_ties) ties.assign(slots, {});
  m_anchor.clear();
  m_measured = false;
}

Wrench ForceMeter::given() const {
  const Wrench total = m_reactions.total();
  return {-total.force, -total.torque};
}

std::optional<Wrench> ForceMeter::of(int slot) const {
  return slot == m_reactions.rest() || slot == Reactions::kNone || !m_measured
             ? std::nullopt
             : std::optional(m_forces[static_cast<size_t>(slot)]);
}

void ForceMeter::read(const ParticleStore& store, std::vector<Motion>& motions) const {
  std::fill(motions.begin(), motions.end(), Motion{});
  for (size_t i = 0; m_reactions.watchesBodies() && i < store.size(); ++i) {
    const int slot = m_reactions.ofBody(store.body()[i]);
    if (slot == Reactions::kNone || slot == m_reactions.rest() || store.velocity()[i].w == 0) continue;
    Motion& motion = motions[static_cast<size_t>(slot)];
    const double mass = store.mass()[i];
    const Vector3 place = vectorOf(store.position()[i]), momentum = mass * vectorOf(store.velocity()[i]);
    motion.momentum.force += momentum;
    motion.momentum.torque += place.cross(momentum);
    motion.mass += mass;
    motion.moment += mass * place;
  }
}

void ForceMeter::begin(const ParticleStore& store) {
  if (!m_reactions.any()) return;
  m_reactions.clear();
  read(store, m_before);
}

void ForceMeter::end(const ParticleStore& store, const Vector3& gravity, double dt) {
  if (!m_reactions.any()) return;
  read(store, m_after);
  for (size_t slot = 0; slot < m_forces.size(); ++slot) {
    const Motion &before = m_before[slot], &after = m_after[slot];
    const Wrench& given = m_reactions.sum(static_cast<int>(slot));
    const Vector3 moment = 0.5 * (before.moment + after.moment);
    m_forces[slot].force = (after.momentum.force - before.momentum.force + given.force) / dt - after.mass * gravity;
    m_forces[slot].torque =
        (after.momentum.torque - before.momentum.torque + given.torque) / dt - moment.cross(gravity);
  }
  m_measured = true;
}

void ForceMeter::findAnchors(const ParticleStore& store, std::span<const uint32_t> pieceOf,
                             std::span<const uint32_t> hanging) {
  m_anchor.clear();
  if (!m_reactions.watchesBodies() || hanging.empty()) return;
  constexpr uint32_t kOpen = ~0u, kSeveral = ~0u - 1;
  std::vector<uint32_t> bodyOf(store.size(), kOpen);  // by piece
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.velocity()[i].w > 0 || pieceOf[i] >= bodyOf.size()) continue;
    uint32_t& body = bodyOf[pieceOf[i]];
    body = body == kOpen || body == store.body()[i] ? store.body()[i] : kSeveral;
  }
  for (const uint32_t i : hanging)
    m_anchor.push_back(pieceOf[i] < bodyOf.size() ? m_reactions.ofBody(bodyOf[pieceOf[i]]) : Reactions::kNone);
}

void ForceMeter::readTies(const ParticleStore& store, std::span<const uint32_t> hanging, double perStep) {
  std::vector<Wrench>& ties = m_ties[1];
  std::fill(ties.begin(), ties.end(), Wrench{});
  for (size_t k = 0; k < hanging.size(); ++k) {
    if (m_anchor[k] == Reactions::kNone) continue;
    const uint32_t i = hanging[k];
    const Vector3 place = vectorOf(store.position()[i]);
    const Vector3 rate =
        perStep > 0 ? Vector3(perStep * (place - vectorOf(store.previous()[i]))) : vectorOf(store.velocity()[i]);
    Wrench& sum = ties[static_cast<size_t>(m_anchor[k])];
    sum.force += double{store.mass()[i]} * rate;
    sum.torque += double{store.mass()[i]} * place.cross(rate);
  }
}

void ForceMeter::beforeTies(const ParticleStore& store, std::span<const uint32_t> hanging, double perStep) {
  if (m_anchor.size() != hanging.size() || hanging.empty()) return;
  readTies(store, hanging, perStep);
  std::swap(m_ties[0], m_ties[1]);
}

void ForceMeter::afterTies(const ParticleStore& store, std::span<const uint32_t> hanging, double perStep) {
  if (m_anchor.size() != hanging.size() || hanging.empty()) return;
  readTies(store, hanging, perStep);
  for (size_t slot = 0; slot < m_forces.size(); ++slot) {
    const Wrench &before = m_ties[0][slot], &after = m_ties[1][slot];
    m_reactions.add(static_cast<int>(slot), {before.force - after.force, before.torque - after.torque});
  }
}

}  // namespace ps
