// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/solidcontact.h"

#include "core/base/parallelarrays.h"
#include "core/solver/contact/handover.h"
#include "core/solver/contact/nearneighbours.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
/// Round contacts of one particle usually lean apart, so half of them may act at full strength. Those of a face lie
/// side by side.
constexpr int kRelaxation = 2;
/// A lattice that is struck hard folds into itself: where it is squeezed along every axis to this share of its spacing,
/// or to less along some, its structure may no longer keep others away.
constexpr double kCrowded = 0.9;
constexpr float kRound = -1;  ///< in place of a face's distance: none is looked for

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

bool sameLattice(const StructureGraph& graph, uint32_t i, uint32_t j) {
  constexpr size_t kAxialTies = 6;
  if (graph.tied(i, j)) return true;
  const size_t ties = graph.ties(i);
  if (ties == 0 || ties > kAxialTies || graph.groupBegin[i + 1] != graph.groupBegin[i]) return false;
  for (uint32_t k = graph.begin[i]; k < graph.begin[i + 1]; ++k) {
    if (graph.partner[k] != j && graph.tied(graph.partner[k], j)) return true;
  }
  return false;
}

void SolidContact::configure(const SolverSettings& settings, std::span<const BakedMaterial> materials) {
  m_spacing = settings.spacing;
  m_diameter = kContactDiameter * m_spacing;
  m_reach = m_diameter + kSkinSpacings * m_spacing;
  m_faceReach = std::hypot(kFaceDistance, kFaceWidth) * m_spacing + kSkinSpacings * m_spacing;
  m_surface.configure(m_spacing);
  m_fixed.clear();
  m_crowded = latticeNeighbours((settings.supportRatio + kSkinSpacings) / kCrowded);
  m_friction.clear();
  for (const BakedMaterial& m : materials) {
    m_friction.push_back({static_cast<float>(m.scalar(propertyIndex("friction_static"))),
                          static_cast<float>(m.scalar(propertyIndex("friction_kinetic")))});
  }
}

void SolidContact::refresh(const ParticleStore& store, const Neighbours& neighbours, ConstraintSystem& constraints,
                           std::span<const uint32_t> pieceOf, std::span<const uint8_t> rigid) {
  m_any = false;
  m_squeezedShare = 0;
  const api::Motion* motion = store.motion();
  findIndices(store.size(), m_solids, [&](size_t i) { return motion[i] == api::Motion::Solid; });
  if (m_solids.empty()) return;
  const StructureGraph& graph = constraints.graph(store.size());
  findKinds(store, neighbours, graph, rigid);
  findPairs(store, neighbours, graph, pieceOf);
  addMirrored(chunkCount(m_solids.size(), grain::kNeighbours), store.size());
  size_t squeezed = 0;
  for (Chunk& chunk : m_chunks) {
    m_any = m_any || !chunk.who.empty();
    squeezed += chunk.squeezed;
  }
  forChunks(m_chunks.size(), 1, [&](size_t first, size_t last) {
    for (size_t c = first; c < last; ++c) markRound(m_chunks[c], pieceOf);
  });
  findSurfaces(store, neighbours, graph);
  m_loose.resize(store.size());
  forChunks(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_loose[i] = graph.isFree(static_cast<uint32_t>(i)) ? 1 : 0;
  });
  assignAll(m_couple, store.size(), api::Float4{0, 0, 0, 0});
  m_squeezedShare = static_cast<double>(squeezed) / static_cast<double>(m_solids.size());
  assignAll(m_contacts, store.size() + 1, uint8_t{1});
}

/// Particles of one piece are round to each other.
void SolidContact::markRound(Chunk& chunk, std::span<const uint32_t> pieceOf) {
  chunk.facing.assign(chunk.other.size(), {0, 0, 0, 0});
  for (size_t k = 0; k < chunk.who.size(); ++k) {
    const uint32_t piece = pieceOf[chunk.who[k]];
    if (piece == ConstraintSystem::kNoPiece) continue;
    for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
      if (piece == pieceOf[chunk.other[q]]) chunk.facing[q].w = kRound;
    }
  }
}

void SolidContact::findKinds(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph,
                             std::span<const uint8_t> rigid) {
  const api::NeighbourView view = neighbours.view();
  m_kinds.resize(store.size());
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const auto i = static_cast<uint32_t>(k);
      const api::Motion motion = store.motion()[i];
      const bool enclosed = graph.ties(i) >= kEnclosed, free = graph.isFree(i);
      const bool moves = motion == api::Motion::Solid && store.velocity()[i].w > 0 && rigid[i] == 0;
      uint8_t kind = 0;
      if (api::holds(motion) && rigid[i] == 0) kind |= kTouches;
      if (motion == api::Motion::Static || !free) kind |= kOfLattice;
      if (moves) kind |= kMoves;
      if (enclosed) kind |= kInside;
      if (enclosed && view.last[i] - view.begin[i] <= m_crowded) kind |= kShut;
      m_kinds[i] = kind;
    }
  });
}

/// What each open particle may touch, by chunks of m_solids.
void SolidContact::findPairs(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph,
                             std::span<const uint32_t> pieceOf) {
  const NearNeighbours near(store, neighbours);
  m_chunks.resize(std::max(m_chunks.size(), chunkCount(m_solids.size(), grain::kNeighbours)));
  for (Chunk& chunk : m_chunks) {
    chunk.who.clear();
    chunk.other.clear();
    chunk.mirrored.clear();
    chunk.squeezed = 0;
  }
  forChunks(m_solids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    Chunk& chunk = m_chunks[first / grain::kNeighbours];
    chunk.begin.assign(1, 0);
    chunk.other.clear();
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_solids[k];
      if ((m_kinds[i] & kShut) != 0 || (m_kinds[i] & kMoves) == 0) continue;
      const size_t before = chunk.other.size();
      findPairsOf(i, store, neighbours.built(), graph, pieceOf, near, chunk);
      if (chunk.other.size() == before) continue;
      if ((m_kinds[i] & kInside) != 0) ++chunk.squeezed;
      chunk.who.push_back(i);
      chunk.begin.push_back(static_cast<uint32_t>(chunk.other.size()));
    }
    chunk.correction.resize(chunk.who.size());
  });
}

void SolidContact::findPairsOf(uint32_t i, const ParticleStore& store, std::span<const api::Float4> at,
                               const StructureGraph& graph, std::span<const uint32_t> pieceOf,
                               const NearNeighbours& near, Chunk& chunk) const {
  const float roundReach2 = static_cast<float>(m_reach * m_reach),
              faceReach2 = static_cast<float>(m_faceReach * m_faceReach);
  const uint8_t* kinds = m_kinds.data();
  const uint32_t *pieces = pieceOf.data(), piece = pieces[i];
  const api::Float4* points = at.data();
  const Period& period = store.period();
  const bool tied = piece != ConstraintSystem::kNoPiece, periodic = period.any(),
             ofLattice = (kinds[i] & kOfLattice) != 0;
  for (const uint32_t j : near.of(i, std::max(roundReach2, faceReach2), chunk.near)) {
    if ((kinds[j] & kTouches) == 0) continue;
    float x = points[i].x - points[j].x, y = points[i].y - points[j].y, z = points[i].z - points[j].z;
    if (periodic) period.shorten(x, y, z);
    const float distance2 = x * x + y * y + z * z;
    const bool together = tied && pieces[j] == piece;
    const bool lattices = !together && (ofLattice || (kinds[j] & kOfLattice) != 0);
    if (!(distance2 < (lattices ? faceReach2 : roundReach2)) || (together && graph.tied(i, j))) continue;
    chunk.other.push_back(j);
    if ((kinds[j] & (kMoves | kShut)) == (kMoves | kShut)) chunk.mirrored.push_back({j, i});
  }
}

/// What an open particle meets inside of a lattice feels it too: each of a pair moves its own share.
void SolidContact::addMirrored(size_t chunks, size_t particles) {
  size_t count = 0;
  for (size_t c = 0; c < chunks; ++c) count += m_chunks[c].mirrored.size();
  if (count == 0) return;
  m_place.assign(particles + 1, 0);
  for (size_t c = 0; c < chunks; ++c) {
    for (const auto& [i, j] : m_chunks[c].mirrored) ++m_place[i + size_t{1}];
  }
  for (size_t i = 0; i < particles; ++i) m_place[i + 1] += m_place[i];
  m_mirrored.resize(count);
  for (size_t c = 0; c < chunks; ++c) {  // those of a particle stay in order of who met it
    for (const auto& [i, j] : m_chunks[c].mirrored) m_mirrored[m_place[i]++] = j;
  }
  Chunk* chunk = nullptr;
  uint32_t begin = 0;
  for (uint32_t i = 0; i < particles; begin = m_place[i++]) {
    if (m_place[i] == begin) continue;
    if (!chunk || chunk->who.size() == grain::kNeighbours) {
      if (chunks == m_chunks.size()) m_chunks.emplace_back();
      chunk = &m_chunks[chunks++];
      chunk->begin.assign(1, 0);
    }
    chunk->who.push_back(i);
    chunk->other.insert(chunk->other.end(), m_mirrored.begin() + begin, m_mirrored.begin() + m_place[i]);
    chunk->begin.push_back(static_cast<uint32_t>(chunk->other.size()));
    chunk->correction.resize(chunk->who.size());
  }
}

/// What belongs to no lattice is round, and so are all of one piece to each other.
void SolidContact::findSurfaces(const ParticleStore& store, const Neighbours& neighbours, const StructureGraph& graph) {
  m_surface.clear(store.size());
  const auto isStatic = [&](uint32_t i) { return store.motion()[i] == api::Motion::Static; };
  const auto add = [&](uint32_t i, bool round) {
    if (isStatic(i) || (!round && (m_kinds[i] & kOfLattice) != 0)) m_surface.add(i);
  };
  for (const Chunk& chunk : m_chunks) {
    for (size_t k = 0; k < chunk.who.size(); ++k) {
      for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
        const bool round = chunk.facing[q].w == kRound;
        add(chunk.who[k], round);
        add(chunk.other[q], round);
      }
    }
  }
  m_fixed.refresh(store, neighbours.built());
  const auto mayKeep = [&](uint32_t i) { return isStatic(i) && graph.isFree(i); };
  m_surface.find(
      store, neighbours,
      [&](uint32_t i, uint32_t j) { return (isStatic(i) && isStatic(j)) || sameLattice(graph, i, j); },
      [&](uint32_t i, LatticeSurface::Own& own) { return mayKeep(i) && m_fixed.recall(i, own); });
  m_normals.resize(m_surface.size());
  m_stood.assign(m_surface.size(), 0);
  m_isKept.assign(m_surface.size(), 0);
  for (size_t slot = 0; slot < m_surface.size(); ++slot) {
    const uint32_t i = m_surface.whoIs(slot);
    if (!mayKeep(i)) continue;
    m_isKept[slot] = 1;
    if (!m_fixed.knows(i)) m_fixed.keep(i, m_surface.own(slot));
    const LatticeSurface::Normal* normal = m_fixed.normalOf(i);
    if (normal == nullptr) continue;
    m_normals[slot] = *normal;
    m_stood[slot] = 1;
  }
}

void SolidContact::begin(ParticleStore& store) {
  if (!m_any) return;
  everywhere([&](Chunk& chunk, size_t k) { m_couple[chunk.who[k]] = {0, 0, 0, 0}; });
  if (m_surface.size() > 0) findNormals(store);
  handOver(store);
}

/// Along what the pairs meet that are not round.
void SolidContact::findNormals(const ParticleStore& store) {
  forChunks(m_surface.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t slot = first; slot < last; ++slot) {
      const uint32_t i = m_surface.whoIs(slot);
      const bool still = m_surface.isStill(store, i);
      if (!still || m_stood[slot] == 0) m_normals[slot] = m_surface.normalOf(store, i);
      if (still && m_stood[slot] == 0 && m_isKept[slot] != 0) m_fixed.keepNormal(i, m_normals[slot]);
      m_stood[slot] = still ? 1 : 0;
    }
  });
  const auto normalOf = [&](uint32_t i) {
    return m_surface.has(i) ? m_normals[m_surface.slotOf(i)] : LatticeSurface::Normal{};
  };
  everywhere([&](Chunk& chunk, size_t k) {
    for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
      if (chunk.facing[q].w == kRound) continue;
      const LatticeSurface::Normal own = normalOf(chunk.who[k]), other = normalOf(chunk.other[q]);
      chunk.facing[q] = {0, 0, 0, 0};
      const Vector3 line = vectorOf(store.separation(chunk.who[k], chunk.other[q]));
      if (own.neighbours + other.neighbours == 0 || !(line.squaredNorm() > 0)) continue;
      const LatticeSurface::Facing facing = m_surface.facing(store, chunk.other[q], own, other, line);
      if (facing.face)
        chunk.facing[q] = float4Of(facing.normal, static_cast<float>(kFaceDistance * m_spacing + facing.lift));
    }
  });
}

/// Particles that have just frozen are handed the deepest overlap that they have with what is not of their piece.
void SolidContact::handOver(ParticleStore& store) {
  const float perSpacing = static_cast<float>(1 / m_spacing);
  float* offset = store.compression();
  everywhere([&](Chunk& chunk, size_t k) {
    float& own = offset[chunk.who[k]];
    if (own != handover::kUnknownOverlap) return;
    own = 0;
    for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
      if (chunk.facing[q].w == kRound) continue;
      own = std::max(own, perSpacing * overlapOf(store, chunk, k, q).depth);
    }
  });
}

SolidContact::Touch SolidContact::touchOf(const ParticleStore& store, const Chunk& chunk, size_t k, size_t q) const {
  Touch touch = overlapOf(store, chunk, k, q);
  if (!(touch.depth > 0) || chunk.facing[q].w == kRound) return touch;
  const float allowed = static_cast<float>(m_spacing) * handover::allowedOverlap(store, chunk.who[k], chunk.other[q]);
  touch.depth = std::max(0.0f, touch.depth - allowed);
  return touch;
}

SolidContact::Touch SolidContact::overlapOf(const ParticleStore& store, const Chunk& chunk, size_t k, size_t q) const {
  const api::Float4 line = store.separation(chunk.who[k], chunk.other[q]), face = chunk.facing[q];
  const float square = line.x * line.x + line.y * line.y + line.z * line.z;
  if (face.w > 0) {
    const float along = line.x * face.x + line.y * face.y + line.z * face.z, depth = face.w - along;
    const float width = static_cast<float>(kFaceWidth * m_spacing);
    // What a face does not reach any more has left it, or is under it.
    const bool beside = square - along * along > width * width;
    return {face.x, face.y, face.z, beside ? 0 : std::max(0.0f, depth), true};
  }
  const float diameter = static_cast<float>(m_diameter);
  if (!(square < diameter * diameter) || !(square > 0)) return {0, 0, 0, 0, false};
  const float distance = std::sqrt(square);
  return {line.x / distance, line.y / distance, line.z / distance, diameter - distance, false};
}

size_t SolidContact::touching(const ParticleStore& store, const Chunk& chunk, size_t k) const {
  size_t count = 0;
  for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) count += touchOf(store, chunk, k, q).depth > 0 ? 1 : 0;
  return count;
}

api::Float4 SolidContact::correctionOf(const ParticleStore& store, Chunk& chunk, size_t k) {
  const uint32_t i = chunk.who[k];
  const api::Float4 *position = store.position(), *previous = store.previous(), *velocity = store.velocity();
  const api::Float4 a = position[i], aFrom = previous[i];
  const auto frictionOf = [&](uint32_t p) {
    return store.material()[p] < m_friction.size() ? m_friction[store.material()[p]] : Friction{0, 0};
  };
  api::Float4 sum{0, 0, 0, 0};
  api::Float4& turn = m_couple[i];
  for (uint32_t q = chunk.begin[k]; q < chunk.begin[k + 1]; ++q) {
    const uint32_t j = chunk.other[q];
    const api::Float4 b = position[j], bFrom = previous[j];
    const auto [nx, ny, nz, depth, face] = touchOf(store, chunk, k, q);
    if (!(depth > 0)) continue;
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
    const int relaxation = face ? 1 : kRelaxation, contacts = std::max({m_contacts[i], m_contacts[j], uint8_t{1}});
    const float share = velocity[i].w / (velocity[i].w + velocity[j].w) * static_cast<float>(relaxation) /
                        static_cast<float>(std::max(contacts, relaxation));
    const float x = share * (depth * nx - hold * tx), y = share * (depth * ny - hold * ty),
                z = share * (depth * nz - hold * tz);
    sum.x += x, sum.y += y, sum.z += z;
    if (velocity[j].w > 0 && m_loose[i] == 0) {  // acts between the two, not at i
      const api::Float4 line = store.separation(i, j);
      const float mass = (m_loose[j] != 0 ? -1.0f : -0.5f) * store.mass()[i];
      turn.x += mass * (line.y * z - line.z * y), turn.y += mass * (line.z * x - line.x * z),
          turn.z += mass * (line.x * y - line.y * x);
    }
    if (velocity[j].w > 0) continue;
    const Vector3 moved = double{store.mass()[i]} * Vector3{x, y, z};
    chunk.fromFixed += moved;
    m_reactions->add(static_cast<size_t>(&chunk - m_chunks.data()), m_reactions->ofBody(store.body()[j]), vectorOf(a),
                     -m_reactions->perStep() * moved);
  }
  return sum;
}

void SolidContact::project(ParticleStore& store) {
  if (!m_any) return;
  everywhere([&](Chunk& chunk, size_t k) {
    m_contacts[chunk.who[k]] = static_cast<uint8_t>(std::min<size_t>(255, touching(store, chunk, k)));
  });
  m_reactions->start(m_chunks.size());
  everywhere([&](Chunk& chunk, size_t k) { chunk.correction[k] = correctionOf(store, chunk, k); });
  m_reactions->finish();
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
