// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/impacts.h"

#include "core/base/parallelarrays.h"
#include "core/solver/contact/nearwalls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace ps {
namespace {

/// Ways in spacings: who goes farther in a substep is looked for beyond the pairs that contact knows; a pair that comes
/// closer by more may pass through itself.
constexpr double kFast = 0.2, kCrossing = 0.4;
constexpr double kNever = 2;  ///< as a time
/// By which a bound in single precision may fall short, as a share of it.
constexpr double kRounding = 1e-4;
constexpr api::Float4 kRound{0, 0, 0, 0};
/// Passes over all impacts of a substep, for those that share a particle.
constexpr int kPasses = 4;

}  // namespace

void Impacts::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                        std::span<const BakedMaterial> materials) {
  m_dt = settings.dt / settings.substeps;
  m_spacing = settings.spacing;
  m_diameter = kContactDiameter * settings.spacing;
  m_gravity = vectorOf(settings.gravity);
  m_surface.configure(m_spacing);
  m_slowest = 2 * m_gravity.norm() * m_dt;
  findContactFaces(walls, settings.spacing, m_walls);
  m_restitution.clear();
  for (const BakedMaterial& m : materials) m_restitution.push_back(m.scalar(propertyIndex("restitution")));
}

double Impacts::restitutionOf(const ParticleStore& store, uint32_t i) const {
  const uint32_t material = store.material()[i];
  return material < m_restitution.size() ? m_restitution[material] : 0;
}

void Impacts::sweep(ParticleStore& store, const Neighbours& neighbours, const Structure& structure) {
  m_impacts.clear();
  m_stops.clear();
  findFast(store, neighbours, structure);
  if (m_impacts.empty()) return;
  sortByTime(store);
  keepFirst(store);
  for (const Impact& k : m_impacts) {
    if (!k.crosses) continue;
    for (const uint32_t i : {k.a, k.b}) {
      if (store.velocity()[i].w > 0 && m_first[i] <= 1) stop(store, i);
    }
  }
}

/// Leaves a particle where it meets the first other one; bounce() gives back the rest of its velocity.
void Impacts::stop(ParticleStore& store, uint32_t i) {
  const double remaining = 1 - m_first[i];
  m_first[i] = 2;
  const api::Float4 v = store.velocity()[i];
  const Vector3 left = remaining * vectorOf(v);
  m_stops.push_back({i, left});
  addTo(store.position()[i], -m_dt * left);
}

void Impacts::collect(const ParticleStore& store, const SolidContact& contact, ConstraintSystem& constraints,
                      std::span<const uint8_t> rigid) {
  const StructureGraph& graph = constraints.graph(store.size());
  startChunks(contact.pairChunks());
  contact.forPairs([&](size_t chunk, uint32_t i, uint32_t j, const api::Float4& face) {
    Impact impact;
    if (test(store, graph, i, j, face, impact) && !impact.crosses) m_found[chunk].push_back(impact);
  });
  takeChunks(contact.pairChunks());
  findWalls(store, rigid);
  if (!m_impacts.empty()) sortByTime(store);
}

void Impacts::startChunks(size_t count) {
  m_found.resize(std::max(m_found.size(), count));
  for (size_t c = 0; c < count; ++c) m_found[c].clear();
}

/// In order of chunks, for any number of threads.
void Impacts::takeChunks(size_t count) {
  for (size_t c = 0; c < count; ++c) m_impacts.insert(m_impacts.end(), m_found[c].begin(), m_found[c].end());
}

/// A pair may have been found twice; what it says is the same.
void Impacts::sortByTime(const ParticleStore& store) {
  const auto key = [&](const Impact& k) {
    const uint32_t a = store.id()[k.a], b = k.b == kNone ? kNone : store.id()[k.b];
    return std::tuple(k.time, std::min(a, b), std::max(a, b), k.plane);
  };
  std::sort(m_impacts.begin(), m_impacts.end(), [&](const Impact& x, const Impact& y) { return key(x) < key(y); });
  m_impacts.erase(std::unique(m_impacts.begin(), m_impacts.end(),
                              [&](const Impact& x, const Impact& y) { return key(x) == key(y); }),
                  m_impacts.end());
}

/// What a fast particle would have met behind its first impact it does not meet.
void Impacts::keepFirst(const ParticleStore& store) {
  assignAll(m_first, store.size(), 2.0);
  for (const Impact& k : m_impacts) {
    if (!k.crosses) continue;
    for (const uint32_t i : {k.a, k.b}) m_first[i] = std::min(m_first[i], k.time);
  }
  const auto firstOf = [&](uint32_t i, double time) { return isFast(store, i) && time <= m_first[i]; };
  std::erase_if(m_impacts,
                [&](const Impact& k) { return k.crosses && !firstOf(k.a, k.time) && !firstOf(k.b, k.time); });
}

double Impacts::wayOf(const ParticleStore& store, uint32_t i) const {
  const Vector3 v = vectorOf(store.velocity()[i]);
  return m_dt * v.norm();
}

bool Impacts::isFast(const ParticleStore& store, uint32_t i) const { return wayOf(store, i) > kFast * m_spacing; }

/// By chunks: most of them are far from all walls, or at rest.
void Impacts::findWalls(const ParticleStore& store, std::span<const uint8_t> rigid) {
  if (m_walls.empty()) return;
  const size_t chunks = chunkCount(store.size(), grain::kParticles);
  startChunks(chunks);
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    std::vector<Impact>& found = m_found[first / grain::kParticles];
    const double fastest = fastestSolid(store, first, last);
    if (fastest <= m_slowest) return;
    const PlaceBox box = PlaceBox::around({store.previous() + first, last - first});
    for (uint32_t plane = 0; plane < m_walls.size(); ++plane) {
      const double reach = fastest * m_dt + kRounding * m_spacing;
      if (!(box.leastHeight(m_walls[plane]) > reach)) findImpacts(store, rigid, plane, first, last, found);
    }
  });
  takeChunks(chunks);
}

void Impacts::findImpacts(const ParticleStore& store, std::span<const uint8_t> rigid, uint32_t plane, size_t first,
                          size_t last, std::vector<Impact>& found) const {
  const WallFace& face = m_walls[plane];
  Plane p = face.plane();
  for (size_t k = first; k < last; ++k) {
    const auto i = static_cast<uint32_t>(k);
    if (store.motion()[i] != api::Motion::Solid || rigid[i] != 0 || !(store.velocity()[i].w > 0)) continue;
    if (face.isCurved()) {  // it meets the plane that touches it there
      const Vector3 from = vectorOf(store.previous()[i]), way = m_dt * vectorOf(store.velocity()[i]);
      const std::optional<double> met = face.meets(from, way);
      if (!met || *met > 1) continue;
      p = face.at(from + *met * way);
    }
    const double approach = vectorOf(store.velocity()[i]).dot(p.normal);
    if (!(approach < -m_slowest)) continue;
    const double gap = std::max(0.0, p.heightOf(vectorOf(store.previous()[i])));
    const double time = gap / (-approach * m_dt);
    if (time > 1) continue;
    // Gravity has acted for `time` of the substep when it touches, not for all of it.
    const double met = approach - (1 - time) * m_dt * m_gravity.dot(p.normal);
    found.push_back({i, kNone, plane, time, p.normal, met, restitutionOf(store, i), false, false});
  }
}

/// m/s, of what holds together or is fixed, or a hair more; beyond all bounds where one is no number.
double Impacts::fastestSolid(const ParticleStore& store, size_t first, size_t last) const {
  const api::Motion* motion = store.motion();
  const api::Float4* velocity = store.velocity();
  float fastest = 0;
  bool numbers = true;
  for (size_t i = first; i < last; ++i) {
    const api::Float4& v = velocity[i];
    const float square = api::holds(motion[i]) ? v.x * v.x + v.y * v.y + v.z * v.z : 0.0f;
    fastest = std::max(fastest, square);
    numbers = numbers && square < std::numeric_limits<float>::infinity();
  }
  return numbers ? (1 + kRounding) * std::sqrt(double{fastest}) : std::numeric_limits<double>::infinity();
}

/// When two meet that go `way` past each other, as a share of it: spheres, or along a face's normal. Above 1: not on
/// it.
double Impacts::timeOf(const Vector3& line, const Vector3& way, const api::Float4& face) const {
  if (face.w > 0) {
    const Vector3 normal = vectorOf(face);
    const double gap = line.dot(normal) - double{face.w}, closing = -way.dot(normal);
    return closing > 0 ? std::max(0.0, gap / closing) : kNever;
  }
  const double along = line.dot(way), way2 = way.squaredNorm(), gap = line.squaredNorm() - m_diameter * m_diameter;
  if (!(along < 0) || !(way2 > 0)) return kNever;
  if (!(gap > 0)) return 0;
  const double discriminant = along * along - way2 * gap;
  return discriminant < 0 ? kNever : (-along - std::sqrt(discriminant)) / way2;
}

/// Sweeps i and j along their relative way; `face` as in SolidContact::forPairs().
bool Impacts::test(const ParticleStore& store, const StructureGraph& graph, uint32_t i, uint32_t j,
                   const api::Float4& face, Impact& impact) const {
  const api::Float4 &vi = store.velocity()[i], &vj = store.velocity()[j];
  const Vector3 speed = vectorOf(vi) - vectorOf(vj), way = m_dt * speed;
  // Where they were: the predicted line, and the way back.
  const Vector3 at = vectorOf(store.previous()[i]) - vectorOf(store.previous()[j]);
  float x = static_cast<float>(at.x()), y = static_cast<float>(at.y()), z = static_cast<float>(at.z());
  store.period().shorten(x, y, z);
  const Vector3 line{x, y, z};
  const double time = timeOf(line, way, face);
  if (time > 1) return false;
  const Vector3 touch = line + time * way;
  const double length = touch.norm();
  if (!(length > 0)) return false;
  impact.normal = touch / length;
  if (face.w > 0) {
    impact.normal = vectorOf(face);
    const Vector3 beside = touch - touch.dot(impact.normal) * impact.normal;
    if (!(beside.norm() < kFaceWidth * m_spacing)) return false;
  }
  impact.approach = speed.dot(impact.normal);
  if (vj.w == 0) impact.approach -= (1 - time) * m_dt * m_gravity.dot(impact.normal);
  if (!(impact.approach < -m_slowest)) return false;
  if (graph.tied(i, j)) return false;
  impact.a = i, impact.b = j, impact.plane = kNone, impact.time = time;
  impact.restitution = std::max(restitutionOf(store, i), restitutionOf(store, j));
  impact.crosses = -impact.approach * m_dt > kCrossing * m_spacing;
  impact.loose = graph.isFree(i) && graph.isFree(j);
  return true;
}

/// Those of fast pairs that m_found has as spheres meet along the faces of their lattices, as SolidContact has it.
void Impacts::turnToFaces(const ParticleStore& store, const Neighbours& neighbours, const Structure& structure,
                          size_t chunks) {
  const StructureGraph& graph = structure.constraints.graph(store.size());
  const std::span<const uint32_t> pieceOf = structure.pieceOf;
  const auto isStatic = [&](uint32_t i) { return store.motion()[i] == api::Motion::Static; };
  const auto isGrain = [&](uint32_t i) { return graph.isFree(i) && !isStatic(i); };
  const auto isRound = [&](const Impact& k) {
    const bool together = pieceOf[k.a] != ConstraintSystem::kNoPiece && pieceOf[k.a] == pieceOf[k.b];
    return together || isGrain(k.a) || isGrain(k.b);
  };
  m_surface.clear(0);
  for (size_t c = 0; c < chunks; ++c) {
    for (const Impact& k : m_found[c]) {
      if (isRound(k)) continue;
      if (m_surface.size() == 0) m_surface.clear(store.size());
      m_surface.add(k.a);
      m_surface.add(k.b);
    }
  }
  if (m_surface.size() == 0) return;
  m_surface.find(store, neighbours,
                 [&](uint32_t p, uint32_t q) { return (isStatic(p) && isStatic(q)) || sameLattice(graph, p, q); });
  const auto faceOf = [&](const Impact& k) {
    if (isRound(k)) return kRound;
    const LatticeSurface::Normal a = m_surface.normalOf(store, k.a), b = m_surface.normalOf(store, k.b);
    if (a.neighbours + b.neighbours == 0) return kRound;
    const LatticeSurface::Facing facing = m_surface.facing(a, b, m_diameter * k.normal);
    return facing.face ? float4Of(facing.normal, static_cast<float>(kFaceDistance * m_spacing + facing.lift)) : kRound;
  };
  forChunks(chunks, 1, [&](size_t first, size_t last) {
    for (size_t c = first; c < last; ++c) {
      size_t stays = 0;
      for (Impact k : m_found[c]) {
        const auto face = faceOf(k);
        if (!(face.w > 0) || test(store, graph, k.a, k.b, face, k)) m_found[c][stays++] = k;
      }
      m_found[c].resize(stays);
    }
  });
}

/// All solids that may be met in passing, and their ways; returns the longest way, m.
double Impacts::findSolids(const ParticleStore& store, const Structure& structure) {
  const StructureGraph& graph = structure.constraints.graph(store.size());
  const auto mayMeet = [&](size_t i) { return api::holds(store.motion()[i]) && structure.rigid[i] == 0; };
  m_longest.assign(chunkCount(store.size(), grain::kParticles), 0);
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    double& longest = m_longest[first / grain::kParticles];
    for (size_t i = first; i < last; ++i) {
      if (!mayMeet(i)) continue;
      const double way = wayOf(store, static_cast<uint32_t>(i));
      if (std::isfinite(way)) longest = std::max(longest, way);
    }
  });
  // Only what is not enclosed by its own structure can be met in passing.
  findIndices(store.size(), m_solids,
              [&](size_t i) { return mayMeet(i) && graph.ties(static_cast<uint32_t>(i)) < SolidContact::kEnclosed; });
  m_ways.resize(m_solids.size());
  forChunks(m_solids.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_ways[k] = wayOf(store, m_solids[k]);
  });
  return m_longest.empty() ? 0 : *std::max_element(m_longest.begin(), m_longest.end());
}

/// Pairs of fast particles, from a grid of the places where the substep began.
void Impacts::findFast(const ParticleStore& store, const Neighbours& neighbours, const Structure& structure) {
  const bool any = anyChunk(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    return fastestSolid(store, first, last) * m_dt > kFast * m_spacing;
  });
  if (!any) return;
  const double longest = findSolids(store, structure);
  if (!(longest > kFast * m_spacing)) return;
  const StructureGraph& graph = structure.constraints.graph(store.size());
  const auto placeOf = [&](size_t k) {
    const api::Float4& p = store.previous()[m_solids[k]];
    return store.period().wrapped({p.x, p.y, p.z});
  };
  // The cells are as wide as the longest way needs.
  m_grid.sort(m_solids.size(), 2 * longest + m_diameter, store.period(), placeOf);
  const size_t chunks = chunkCount(m_solids.size(), grain::kNeighbours);
  startChunks(chunks);
  forChunks(m_solids.size(), grain::kNeighbours, [&](size_t from, size_t to) {
    std::vector<Impact>& found = m_found[from / grain::kNeighbours];
    for (size_t k = from; k < to; ++k) {
      if (!(m_ways[k] > kFast * m_spacing) || !std::isfinite(m_ways[k])) continue;
      m_grid.around(placeOf(k), [&](uint32_t first, uint32_t last) {
        for (const uint32_t other : m_grid.order().subspan(first, last - first)) {
          // A pair of two fast ones is asked by the first of them.
          if (other == k || (m_ways[other] > kFast * m_spacing && other < k)) continue;
          uint32_t i = m_solids[k], j = m_solids[other];
          if (store.velocity()[i].w == 0) std::swap(i, j);
          Impact impact;
          if (store.velocity()[i].w > 0 && test(store, graph, i, j, kRound, impact)) found.push_back(impact);
        }
      });
    }
  });
  turnToFaces(store, neighbours, structure, chunks);
  takeChunks(chunks);
}

/// Impulse in kg m/s that a wall or a fixed particle gave.
void Impacts::bookOutside(const ParticleStore& store, const Impact& k, const Vector3& impulse) {
  m_externalImpulse.add(impulse);
  const int slot = k.b == kNone ? m_reactions->ofWall(k.plane) : m_reactions->ofBody(store.body()[k.b]);
  m_reactions->add(slot, vectorOf(store.position()[k.a]), -impulse);
}

void Impacts::bounce(ParticleStore& store) {
  for (const Stop& s : m_stops) addTo(store.velocity()[s.particle], s.left);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const Impact& k : m_impacts) {
      api::Float4& va = store.velocity()[k.a];
      Vector3 speed = vectorOf(va);
      double weights = va.w;
      if (k.b != kNone) speed -= vectorOf(store.velocity()[k.b]), weights += double{store.velocity()[k.b].w};
      const double change = -k.restitution * k.approach - speed.dot(k.normal);
      // Speed that only the removal of an overlap gave is taken out; what ties or another impact gave is theirs.
      if (change < 0 && (pass > 0 || !k.loose)) continue;
      const Vector3 impulse = change / weights * k.normal;
      addTo(va, double{va.w} * impulse);
      if (k.b == kNone || store.velocity()[k.b].w == 0) bookOutside(store, k, impulse);
      if (k.b != kNone) addTo(store.velocity()[k.b], -double{store.velocity()[k.b].w} * impulse);
    }
  }
}

}  // namespace ps
