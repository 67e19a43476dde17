// SPDX-License-Identifier: Apache-2.0
// Matter is made of another material by hand while the scene runs, and of its own again by undo.
#include "core/base/error.h"
#include "core/matter/stablephase.h"
#include "core/solver/contact/handover.h"
#include "core/solver/frame/solverimpl.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace ps {
namespace {

/// A field of the store beside what two copies of the same particles have of it.
struct Difference {
  std::byte* now;
  const std::byte *before, *after;
  size_t bytes;  ///< of one particle
  bool isAfter(size_t i, size_t k) const { return std::memcmp(now + i * bytes, after + k * bytes, bytes) == 0; }
  void giveBack(size_t i, size_t k) const { std::memcpy(now + i * bytes, before + k * bytes, bytes); }
};

/// But for place and velocity, which go on: of these, painting changes the room that is filled and the mass.
std::vector<Difference> differences(ParticleStore& store, const PaintedMatter& painted) {
  std::vector<Difference> list;
  for (const ParticleStore::FieldInfo& info : store.fields()) {
    const auto before = painted.before.fields.find(info.name), after = painted.after.fields.find(info.name);
    const bool goesOn = info.name == field::kPosition || info.name == field::kPrevious || info.name == field::kVelocity;
    if (goesOn || before == painted.before.fields.end() || after == painted.after.fields.end()) continue;
    const size_t bytes = before->second.size() / painted.before.id.size();
    auto* now = static_cast<std::byte*>(store.find(info.name.c_str(), info.type));
    if (now && before->second != after->second)
      list.push_back({now, before->second.data(), after->second.data(), bytes});
  }
  return list;
}

template <class T>
T valueOf(const CopiedParticles& copies, const char* field, size_t k) {
  return reinterpret_cast<const T*>(copies.fields.at(field).data())[k];
}

}  // namespace

void Solver::Impl::startAnew(std::span<const uint32_t> indices, std::span<const float> mass) {
  const double cell = settings.spacing * settings.spacing * settings.spacing;
  for (const uint32_t i : indices) {
    store.phase()[i] = stablePhase(materials[store.material()[i]].caloric(), store.temperature()[i]);
    setShares(store, i, store.phase()[i]);
  }
  heat.initialise(store, indices);
  for (size_t k = 0; k < indices.size(); ++k) {
    const uint32_t i = indices[k];
    const double room = store.motion()[i] == api::Motion::Gas ? cell : store.position()[i].w;
    const bool stays = store.velocity()[i].w == 0;
    store.mass()[i] = mass[k] > 0 ? mass[k] : static_cast<float>(phase.restDensity(store, i) * room);
    const api::Motion before = store.motion()[i];
    phase.initialise(store, i, i + size_t{1}, false);
    // What is handed over to a solid and to a fluid are not the same: see handover.h.
    const bool holds = store.motion()[i] == api::Motion::Solid;
    if (holds != (before == api::Motion::Solid)) store.compression()[i] = holds ? handover::kUnknownOverlap : 0;
    if (stays) store.velocity()[i].w = 0;
  }
}

PaintedMatter Solver::paint(std::span<const uint32_t> ids, uint32_t material) {
  if (material >= m->materials.size()) throw Error("particles of a material that is not in the table");
  m->configure();
  ParticleStore& store = m->store;
  std::vector<uint32_t> indices = store.indicesOf(ids);
  std::erase_if(indices, [&](uint32_t i) { return store.material()[i] == material; });
  if (indices.empty()) return {};
  const double energy = m->heat.energy(store);
  PaintedMatter painted{store.copy(indices), {}, material, m->books(), {}};
  for (const uint32_t i : indices) store.material()[i] = material;
  m->startAnew(indices, std::vector<float>(indices.size(), 0));
  m->matterChanged(energy, false);
  painted.after = store.copy(indices);
  painted.booksAfter = m->books();
  return painted;
}

void Solver::unpaint(const PaintedMatter& painted) {
  if (painted.before.id.empty()) return;
  m->configure();
  ParticleStore& store = m->store;
  const double energy = m->heat.energy(store);
  const std::vector<Difference> fields = differences(store, painted);
  std::vector<std::pair<uint32_t, size_t>> changed;  // particle, place in the copies
  size_t restored = 0;
  for (size_t k = 0; k < painted.before.id.size(); ++k) {
    const size_t i = store.indexOf(painted.before.id[k]);
    if (i >= store.size() || store.material()[i] != painted.material) continue;
    if (!std::all_of(fields.begin(), fields.end(), [&](const Difference& f) { return f.isAfter(i, k); })) {
      changed.emplace_back(static_cast<uint32_t>(i), k);
      continue;
    }
    for (const Difference& f : fields) f.giveBack(i, k);
    store.position()[i].w = valueOf<api::Float4>(painted.before, field::kPosition, k).w;
    if (store.velocity()[i].w > 0) store.velocity()[i].w = 1 / store.mass()[i];
    ++restored;
  }
  std::sort(changed.begin(), changed.end());
  std::vector<uint32_t> indices;
  std::vector<float> mass;
  for (const auto& [i, k] : changed) {
    store.material()[i] = valueOf<uint32_t>(painted.before, field::kMaterial, k);
    indices.push_back(i);
    mass.push_back(valueOf<float>(painted.before, field::kMass, k));
  }
  m->startAnew(indices, mass);
  const bool exact = restored == painted.before.id.size() && m->books() == painted.booksAfter;
  m->matterChanged(energy, false);
  if (!exact) return;
  m->heat.setLedger(painted.booksBefore.ledger);
  m->energyOffset = painted.booksBefore.offset;
}

}  // namespace ps
