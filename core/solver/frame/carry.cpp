// SPDX-License-Identifier: Apache-2.0
// A body is taken by hand to another place while the scene runs. Its velocities go on about their mean, which stays:
// a thing that falls falls on downwards, however it is turned, and one that spins spins about its own axis. A tool,
// which is fixed, is led there through what is in its way.
#include "core/solver/frame/solverimpl.h"
#include "core/solver/truesurface.h"

#include <optional>

namespace ps {
namespace {

/// kg m/s over kg, of those that go and can move.
Vector3 meanVelocity(const ParticleStore& store, std::span<const uint8_t> goes) {
  Vector3 momentum;
  double mass = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    if (goes[i] == 0 || store.velocity()[i].w == 0) continue;
    momentum += double{store.mass()[i]} * vectorOf(store.velocity()[i]);
    mass += double{store.mass()[i]};
  }
  return mass > 0 ? Vector3(momentum / mass) : Vector3(Vector3::Zero());
}

/// m, mean of the places of those that go, each in the image that is nearest to the first of them. Not by mass: a
/// document knows where a body of several materials is, but not how heavy its parts are.
Vector3 centreOf(const ParticleStore& store, std::span<const uint8_t> goes) {
  std::optional<Vector3> first;
  Vector3 sum;
  double count = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    if (goes[i] == 0) continue;
    const Vector3 place = vectorOf(store.position()[i]);
    if (!first) first = place;
    api::Float4 way = float4Of(place - *first, 0);
    store.period().shorten(way.x, way.y, way.z);
    sum += vectorOf(way);
    ++count;
  }
  return count > 0 ? Vector3(*first + sum / count) : Vector3(Vector3::Zero());
}

}  // namespace

void Solver::lead(uint32_t body, const Quaternion& turn, const Vector3& way) {
  m->configure();
  std::vector<uint8_t> goes(m->store.size());
  bool any = false;
  for (size_t i = 0; i < m->store.size(); ++i) {
    goes[i] = m->store.body()[i] == body && m->store.motion()[i] == api::Motion::Static ? 1 : 0;
    any = any || goes[i] != 0;
  }
  if (any) m->motion.follow(body, centreOf(m->store, goes), turn, way, m->store);
}

double Solver::leadLeft(uint32_t body) const { return m->motion.leftOf(body); }

void Solver::carry(uint32_t body, const Quaternion& turn, const Vector3& way) {
  m->configure();
  ParticleStore& store = m->store;
  std::vector<uint8_t> goes(store.size());
  for (size_t i = 0; i < store.size(); ++i) goes[i] = store.body()[i] == body ? 1 : 0;
  RigidMove move{turn, way};
  const Vector3 centre = centreOf(store, goes);
  if (move.turns()) move.shift += centre - turn * centre;
  // What lies across a face of a periodic box turns as one.
  const auto nearest = [&](api::Float4& place) {
    if (!move.turns() || !store.period().any()) return;
    api::Float4 from = float4Of(vectorOf(place) - centre, 0);
    store.period().shorten(from.x, from.y, from.z);
    assignTo(place, centre + vectorOf(from));
  };
  if (move.isNothing()) return;
  m->constraints.takeAlong(store, goes);
  const Vector3 mean = meanVelocity(store, goes), push = mean - move.turn * mean;
  auto* surface = static_cast<api::Float4*>(store.find(field::kTrueSurface, api::FieldType::Float4));
  for (size_t i = 0; i < store.size(); ++i) {
    if (goes[i] == 0) continue;
    api::Float4 &place = store.position()[i], &previous = store.previous()[i], &velocity = store.velocity()[i];
    nearest(place), nearest(previous);
    assignTo(place, move.of(vectorOf(place)));
    assignTo(previous, move.of(vectorOf(previous)));
    if (move.turns()) assignTo(velocity, move.turn * vectorOf(velocity) + (velocity.w > 0 ? push : Vector3::Zero()));
    if (surface) assignTo(surface[i], move.turn * vectorOf(surface[i]));
  }
  const auto& q = move.turn.coeffs();
  m->constraints.carry(store, goes, {{q[0], q[1], q[2], q[3]}, double3Of(move.shift), double3Of(push)});
  m->motion.carry(body, move);
  m->rebound.forget(store, goes);
  m->reordered = m->structureChanged = true;
  m->lastGoodValid = false;
}

}  // namespace ps
