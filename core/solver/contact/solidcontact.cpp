// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/solidcontact.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
/// Contacts of one particle usually lean apart, so half of them may act at full strength.
constexpr int kRelaxation = 2;
/// A lattice that is struck hard folds into itself: where it is squeezed along every axis to this share of its spacing,
/// or to less along some, its structure may no longer keep others away.
constexpr double kCrowded = 0.9;

/// Points of a cubic lattice around one of them, up to a distance in spacings.
uint32_t latticeNeighbours(double distance) {
  const int n = static_cast<int>(distance);
  uint32_t count = 0;
  for (int x = -n; x <= n; ++x) {
    for (int y = -n; y <= n; ++y) {
      for (int z = -n; z <= n; ++z) count += x * x + y * y + z * z <= distance * distance ? 1 : 0;
    }
  }
  return count - 1;
}

}  // namespace

void SolidContact::configure(const SolverSettings& settings, std::span<const BakedMaterial> materials) {
  m_diameter = kContactDiameter * settings.spacing;
  m_reach = m_diameter + kSkinSpacings * settings.spacing;
  m_crowded = latticeNeighbours((settings.supportRatio + kSkinSpacings) / kCrowded);
  m_friction.clear();
  for (const BakedMaterial& m : materials) {
    m_friction.push_back({static_cast<float>(m.scalar(propertyIndex("friction_static"))),
                          static_cast<float>(m.scalar(propertyIndex("friction_kinetic")))});
  }
}

void SolidContact::refresh(const ParticleStore& store, const Neighbours& neighbours, ConstraintSystem& constraints,
                           std::span<const uint8_t> rigid) {
  m_any = false;
  m_squeezedShare = 0;
  m_solids.clear();
  const api::Motion* motion = store.motion();
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (motion[i] == api::Motion::Solid) m_solids.push_back(i);
  }
  if (m_solids.empty()) return;
  const std::span<const api::Float4> at = neighbours.built();
  const StructureGraph& graph = constraints.graph(store.size());
  const api::NeighbourView view = neighbours.view();
  const float reach2 = static_cast<float>(m_reach * m_reach);
  const size_t chunks = chunkCount(m_solids.size(), grain::kNeighbours);
  m_chunks.resize(std::max(m_chunks.size(), chunks + 1));
  for (Chunk& chunk : m_chunks) {
    chunk.who.clear();
    chunk.mirrored.clear();
    chunk.squeezed = 0;
  }
  const auto isEnclosed = [&](uint32_t i) { return graph.ties(i) >= kEnclosed; };
  const auto isShut = [&](uint32_t i) { return isEnclosed(i) && view.last[i] - view.begin[i] <= m_crowded; };
  forChunks(m_solids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    Chunk& chunk = m_chunks[first / grain::kNeighbours];
    chunk.begin.assign(1, 0);
    chunk.other.clear();
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_solids[k];
      if (isShut(i) || rigid[i] != 0 || store.velocity()[i].w == 0) continue;
      const size_t before = chunk.other.size();
      for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
        const uint32_t j = view.index[q];
        if (!api::holds(motion[j]) || rigid[j] != 0) continue;
        float x = at[i].x - at[j].x, y = at[i].y - at[j].y, z = at[i].z - at[j].z;
        store.period().shorten(x, y, z);
        if (!(x * x + y * y + z * z < reach2) || graph.tied(i, j)) continue;
        chunk.other.push_back(j);
        if (motion[j] == api::Motion::Solid && store.velocity()[j].w > 0 && isShut(j)) chunk.mirrored.push_back({j, i});
      }
      if (chunk.other.size() == before) continue;
      if (isEnclosed(i)) ++chunk.squeezed;
      chunk.who.push_back(i);
      chunk.begin.push_back(static_cast<uint32_t>(chunk.other.size()));
    }
    chunk.correction.resize(chunk.who.size());
  });
  addMirrored(chunks);
  size_t squeezed = 0;
  for (const Chunk& chunk : m_chunks) {
    m_any = m_any || !chunk.who.empty();
    squeezed += chunk.squeezed;
  }
  m_squeezedShare = static_cast<double>(squeezed) / static_cast<double>(m_solids.size());
  m_contacts.assign(store.size() + 1, 1);
}

/// What an open particle meets inside of a lattice feels it too: each of a pair moves its own share.
void SolidContact::addMirrored(size_t chunks) {
  Chunk& last = m_chunks[chunks];
  for (size_t c = 0; c < chunks; ++c)
    last.mirrored.insert(last.mirrored.end(), m_chunks[c].mirrored.begin(), m_chunks[c].mirrored.end());
  std::sort(last.mirrored.begin(), last.mirrored.end());
  last.begin.assign(1, 0);
  last.other.clear();
  for (const auto& [i, j] : last.mirrored) {
    if (last.who.empty() || last.who.back() != i) {
      last.who.push_back(i);
      last.begin.push_back(last.begin.back());
    }
    last.other.push_back(j);
    ++last.begin.back();
  }
  last.correction.resize(last.who.size());
}

size_t SolidContact::touching(const ParticleStore& store, const Chunk& chunk, size_t k) const {
  const float diameter2 = static_cast<float>(m_diameter * m_diameter);
  size_t count = 0;
  for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
    const api::Float4 d = store.separation(chunk.who[k], chunk.other[q]);
    count += d.x * d.x + d.y * d.y + d.z * d.z < diameter2 ? 1 : 0;
  }
  return count;
}

api::Float4 SolidContact::correctionOf(const ParticleStore& store, Chunk& chunk, size_t k) const {
  const uint32_t i = chunk.who[k];
  const api::Float4 *position = store.position(), *previous = store.previous(), *velocity = store.velocity();
  const api::Float4 a = position[i], aFrom = previous[i];
  const float diameter = static_cast<float>(m_diameter);
  const auto frictionOf = [&](uint32_t p) {
    return store.material()[p] < m_friction.size() ? m_friction[store.material()[p]] : Friction{0, 0};
  };
  api::Float4 sum{0, 0, 0, 0};
  for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
    const uint32_t j = chunk.other[q];
    const api::Float4 b = position[j], bFrom = previous[j];
    auto [nx, ny, nz, unused] = store.separation(i, j);
    const float distance = std::sqrt(nx * nx + ny * ny + nz * nz), depth = diameter - distance;
    if (!(depth > 0) || !(distance > 0)) continue;
    nx /= distance, ny /= distance, nz /= distance;
    // Tangential way of the pair since the start of the substep, held back up to friction times depth.
    float tx = (a.x - aFrom.x) - (b.x - bFrom.x), ty = (a.y - aFrom.y) - (b.y - bFrom.y),
          tz = (a.z - aFrom.z) - (b.z - bFrom.z);
    const float along = tx * nx + ty * ny + tz * nz;
    tx -= along * nx, ty -= along * ny, tz -= along * nz;
    const float way = std::sqrt(tx * tx + ty * ty + tz * tz);
    const Friction fi = frictionOf(i), fj = frictionOf(j);
    const float staticFriction = 0.5f * (fi.staticFriction + fj.staticFriction) * depth,
                kineticFriction = 0.5f * (fi.kineticFriction + fj.kineticFriction) * depth;
    const float hold = way > staticFriction ? std::min(1.0f, kineticFriction / way) : 1;
    const float share = velocity[i].w / (velocity[i].w + velocity[j].w) * kRelaxation /
                        static_cast<float>(std::max({m_contacts[i], m_contacts[j], uint8_t{kRelaxation}}));
    const float x = share * (depth * nx - hold * tx), y = share * (depth * ny - hold * ty),
                z = share * (depth * nz - hold * tz);
    sum.x += x, sum.y += y, sum.z += z;
    if (velocity[j].w == 0) chunk.fromFixed += double{store.mass()[i]} * Vector3{x, y, z};
  }
  return sum;
}

void SolidContact::project(ParticleStore& store) {
  if (!m_any) return;
  const auto everywhere = [&](auto&& body) {
    forChunks(m_chunks.size(), 1, [&](size_t first, size_t last) {
      for (size_t c = first; c < last; ++c) {
        for (size_t k = 0; k < m_chunks[c].who.size(); ++k) body(m_chunks[c], k);
      }
    });
  };
  everywhere([&](Chunk& chunk, size_t k) {
    m_contacts[chunk.who[k]] = static_cast<uint8_t>(std::min<size_t>(255, touching(store, chunk, k)));
  });
  everywhere([&](Chunk& chunk, size_t k) { chunk.correction[k] = correctionOf(store, chunk, k); });
  everywhere([&](Chunk& chunk, size_t k) {
    api::Float4& x = store.position()[chunk.who[k]];
    x.x += chunk.correction[k].x, x.y += chunk.correction[k].y, x.z += chunk.correction[k].z;
  });
  for (Chunk& chunk : m_chunks) {
    m_externalImpulse.add(chunk.fromFixed);
    chunk.fromFixed = {};
  }
}

}  // namespace ps
