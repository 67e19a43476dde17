// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/density.h"

#include "core/base/parallelarrays.h"
#include "core/base/room.h"
#include "core/particles/mostaround.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace ps {
namespace {

constexpr size_t kSpare = 16;
constexpr float kFarAway = 1e8f;
/// Regularisation of the denominator in 1/spacing^2: only keeps it from zero.
constexpr float kEpsilon = 1e-6f;
/// Bounds of a solid particle's volume in the density sum, in rest volumes. A free surface has 1.45; particles that
/// are all alone would claim three times their volume.
constexpr float kSolidLeast = 1, kSolidMost = 1.45f;
/// Boundary particles may lie denser than the fluid (several layers, a sampled mesh).
constexpr float kStaticLeast = 0.1f, kStaticMost = 1.6f;
/// One Jacobi step alone must be gentler, or resting liquid boils.
constexpr double kSingleStepRelaxation = 0.4;

bool isFluid(api::Motion m) { return m == api::Motion::Liquid || m == api::Motion::Gas; }

bool isInside(const api::Float4& p, const Bounds& bounds) {
  const api::Double3 &low = bounds.minimum, &high = bounds.maximum;
  const double x = p.x, y = p.y, z = p.z;
  return x >= low.x && x <= high.x && y >= low.y && y <= high.y && z >= low.z && z <= high.z;
}

/// Inverse masses that are about, ascending from the 0 of what does not move; none of them means anything where there
/// are more than volumes can tell.
struct Kinds {
  std::array<float, DensityWeights::kKinds> inverseMass{};
  uint32_t count = 1;
  bool tooMany = false;

  uint32_t indexOf(float value) const {
    uint32_t kind = 0;
    while (kind < count && inverseMass[kind] != value) ++kind;
    return kind;
  }
  void add(float value) {
    if (tooMany || indexOf(value) < count) return;
    tooMany = count == DensityWeights::kKinds;
    if (tooMany) return;
    uint32_t k = count++;
    for (; inverseMass[k - 1] > value; --k) inverseMass[k] = inverseMass[k - 1];  // the first one is 0
    inverseMass[k] = value;
  }
};

Kinds kindsOf(const ParticleStore& store) {
  Kinds kinds;
  const api::Float4* velocity = store.velocity();
  float former = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    if (velocity[i].w == former) continue;
    former = velocity[i].w;
    kinds.add(former);
  }
  return kinds;
}

}  // namespace

void DensityStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                             const FixedShapes& shapes) {
  m_shapes = &shapes;
  m_settings = settings;
  m_support = settings.spacing * settings.supportRatio;
  m_scale = Kernel(settings.kernel, m_support).value(0);  // w(0) = 1 for both shapes
  m_walls.configure(settings, walls, shapes);
  m_film.configure(settings, m_walls.walls());
}

PairLists DensityStage::lists(const ParticleStore& store, const Neighbours& neighbours) const {
  const api::NeighbourView view = neighbours.view();
  const float inverseSquare = static_cast<float>(1 / (m_support * m_support));
  return {view.begin, view.last, view.end, view.index, m_settings.kernel, inverseSquare, store.period(), view.slots};
}

void DensityStage::refresh(const ParticleStore& store, const Neighbours& neighbours) {
  const size_t n = store.size();
  for (std::vector<api::Float4>* v : {&m_points, &m_multipliers}) v->resize(n + kSpare);
  m_carried.resize(n);
  m_volume.resize(n + kSpare);
  m_weights = {};
  const api::Motion* motion = store.motion();
  const api::Float4 *position = store.position(), *velocity = store.velocity();
  forChunks(n, grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_volume[i] = m_shapes->isShaped(i) ? 0 : position[i].w;
  });
  findIndices(n, m_fluid, [&](size_t i) { return isFluid(motion[i]) && velocity[i].w > 0; });
  const api::Float4 dummy{kFarAway, kFarAway, kFarAway, 0};
  m_points[n] = m_multipliers[n] = dummy;
  m_volume[n] = 0;
  refreshLists(store, neighbours);
  if (m_fluid.empty()) return;
  const PairLists pairs = lists(store, neighbours);
  solidVolumes(store, pairs, api::Motion::Solid, kSolidLeast, kSolidMost);
  solidVolumes(store, pairs, api::Motion::Static, kStaticLeast, kStaticMost);
  weigh(store);
}

/// Volumes times the kernel's factor, and the weights of the denominator.
void DensityStage::weigh(const ParticleStore& store) {
  const api::Float4* velocity = store.velocity();
  const Kinds kinds = kindsOf(store);
  const float scale = static_cast<float>(m_scale);
  m_weights = {};
  m_weight.resize(kinds.tooMany ? store.size() + kSpare : 0);
  if (kinds.tooMany) {
    m_weights.each = m_weight.data();
    m_weight[store.size()] = 0;
  } else {
    std::copy(kinds.inverseMass.begin(), kinds.inverseMass.end(), m_weights.inverseMass);
  }
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const float volume = m_volume[i] * scale, inverseMass = velocity[i].w;
      m_volume[i] = volume;
      if (kinds.tooMany)
        m_weight[i] = inverseMass * volume * volume;
      else
        m_volume[i] = DensityWeights::marked(volume, kinds.indexOf(inverseMass));
    }
  });
}

void DensityStage::refreshLists(const ParticleStore& store, const Neighbours& neighbours) {
  const size_t n = store.size();
  assignAll(m_touched, n + kSpare, uint8_t{0});
  m_wet.clear();
  m_watched.clear();
  m_touchesFixed = false;
  m_nearKnown = false;
  m_walls.refresh(neighbours.built());
  assignAll(m_isFluid, n, uint8_t{0});
  forChunks(m_fluid.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_isFluid[m_fluid[k]] = 1;
  });
  if (m_fluid.empty()) return;
  findTouched(neighbours);
  const api::Motion* motion = store.motion();
  const api::Float4* velocity = store.velocity();
  findIndices(n, m_wet,
              [&](size_t i) { return m_touched[i] != 0 && velocity[i].w > 0 && motion[i] == api::Motion::Solid; });
  m_touchesFixed = anyChunk(n, grain::kNumbers, [&](size_t first, size_t last) {
    bool fixed = false;
    for (size_t i = first; i < last; ++i) fixed = fixed || (m_touched[i] != 0 && !(velocity[i].w > 0));
    return fixed;
  });
  if (m_touchesFixed && m_reactions->any()) {
    findIndices(n, m_watched, [&](size_t i) {
      return m_touched[i] != 0 && !(velocity[i].w > 0) && m_reactions->ofBody(store.body()[i]) != Reactions::kNone;
    });
  }
  m_film.refresh(store, neighbours, m_wet);
}

/// What has fluid in its list.
void DensityStage::findTouched(const Neighbours& neighbours) {
  const MostAround fluids(neighbours.grid(), m_isFluid, m_cellHasFluid);
  const api::NeighbourView view = neighbours.view();
  forChunks(m_isFluid.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    MostAround around = fluids;
    for (size_t i = first; i < last; ++i) {
      if (m_isFluid[i] != 0 || around.at(i) == 0) continue;
      const auto isFluid = [&](uint32_t j) { return m_isFluid[j] != 0; };
      m_touched[i] = std::any_of(view.index + view.begin[i], view.index + view.last[i], isFluid) ? 1 : 0;
    }
  });
}

void DensityStage::solidVolumes(const ParticleStore& store, const PairLists& pairs, api::Motion motion, float least,
                                float most) {
  // Only those near fluid matter.
  const api::Motion* motions = store.motion();
  const auto counts = [&](size_t i) { return motions[i] == motion && !m_shapes->isShaped(i); };
  findIndices(store.size(), m_some, [&](size_t i) { return counts(i) && m_touched[i] != 0; });
  if (m_some.empty()) return;
  const api::Float4* position = store.position();
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i)
      m_points[i] = {position[i].x, position[i].y, position[i].z, counts(i) ? 1.0f : 0.0f};
  });
  m_sums.resize(std::max(m_sums.size(), m_some.size()));
  const float scale = static_cast<float>(m_scale);
  forChunks(m_some.size(), grain::kPairs, [&](size_t first, size_t last) {
    sumDensity(pairs, m_points.data(), m_weights, m_some.data(), first, last, m_sums.data());
    for (size_t k = first; k < last; ++k) {
      const float own = position[m_some[k]].w;
      m_volume[m_some[k]] = std::clamp(1 / (scale * (1 + m_sums[k].excess)), least * own, most * own);
    }
  });
}

void DensityStage::loadPoints(const ParticleStore& store) {
  const api::Float4* position = store.position();
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      m_points[i] = {position[i].x, position[i].y, position[i].z, m_volume[i]};
      if (m_isFluid[i] == 0) m_multipliers[i] = {position[i].x, position[i].y, position[i].z, 0};
    }
  });
}

void DensityStage::makeRoom() {
  const size_t fluids = m_fluid.size() + kSpare;
  m_sums.resize(std::max(m_sums.size(), fluids));
  m_squares.resize(fluids);
  m_constraints.resize(fluids);
  if (m_shapes->any()) m_ofShapes.resize(fluids);
}

/// By the near lists, which `findNear` finds on the way, in the lists that hold all.
void DensityStage::multipliers(const ParticleStore& store, const PairLists& pairs, float relaxation, bool findNear,
                               size_t first, size_t last) {
  const uint32_t* const fluid = m_fluid.data();
  float* const slopes = m_near.pairs().value.data();
  if (findNear) {
    sumDensityFindingNear(pairs, m_points.data(), m_weights, m_near.room(), fluid, first, last, m_sums.data(),
                          m_squares.data(), slopes);
  } else {
    sumDensity(pairs, m_points.data(), m_weights, fluid, first, last, m_sums.data(), m_squares.data(), slopes);
  }
  const float epsilon = kEpsilon / static_cast<float>(m_settings.spacing * m_settings.spacing);
  const HalfSpaces::Sum* const ofShapes = m_walls.sumShapes(m_points.data(), fluid, first, last, m_ofShapes);
  solveConstraints({relaxation, epsilon, pairs.inverseSupportSquared},
                   {m_points.data(), store.velocity(), store.compression(), ofShapes}, m_walls, fluid, first, last,
                   m_sums.data(), m_squares.data(), m_constraints.data(), m_multipliers.data());
}

/// What a gap takes off the corrections of a particle, m kg (TrappedFilm).
Vector3 DensityStage::inFilm(const ParticleStore& store, const PairLists& pairs, uint32_t i, float lambda) const {
  const HalfSpaces::Sum walls = m_walls.of(i, m_points[i]);
  const double ofWalls = double{m_film.yieldOf(i) * lambda} * Vector3{walls.x, walls.y, walls.z}.dot(m_film.up());
  return m_film.correctionOf(store, {pairs, m_volume.data(), m_multipliers.data()}, i) - ofWalls * m_film.up();
}

/// Fluids come first: their slopes are known.
void DensityStage::sumMoves(const PairLists& near, size_t first, size_t last) {
  const size_t fluids = std::clamp(m_fluid.size(), first, last);
  sumMultipliers(near, m_multipliers.data(), m_some.data(), first, fluids, m_moves.data(), m_near.pairs().value.data());
  sumMultipliers(near, m_multipliers.data(), m_some.data(), fluids, last, m_moves.data(), nullptr);
}

/// The same of all that move, in m kg; nullptr where there is no film.
const api::Float4* DensityStage::movesInFilm(const ParticleStore& store, const PairLists& pairs, size_t first,
                                             size_t last) {
  if (!m_film.any()) return nullptr;
  for (size_t k = first; k < last; ++k) {
    const uint32_t i = m_some[k];
    m_movesInFilm[k] = {};
    if (m_film.concerns(i)) m_movesInFilm[k] = float4Of(inFilm(store, pairs, i, m_multipliers[i].w), 0);
  }
  return m_movesInFilm.data();
}

void DensityStage::move(ParticleStore& store, const PairLists& pairs, size_t first, size_t last) {
  const MoveRule rule{m_chebyshev, pairs.inverseSupportSquared};
  MoveFields fields{store.position(), m_carried.data(), store.velocity(), m_volume.data(), store.mass(), nullptr};
  if (m_multiplierSum.size() >= store.size()) fields.multiplierSum = m_multiplierSum.data();
  const api::Float4* const inFilm = movesInFilm(store, pairs, first, last);
  const uint32_t* const which = m_some.data();
  const size_t fluids = std::clamp(m_fluid.size(), first, last), chunk = first / grain::kPairs;
  const api::Double3 ofFluids =
      applyMoves(rule, fields, which, first, fluids, m_moves.data(), m_constraints.data(), inFilm);
  const api::Double3 ofSolids = applyMoves(rule, fields, which, fluids, last, m_moves.data(), nullptr, inFilm);
  m_moved.add(chunk, 1, vectorOf(ofFluids) + vectorOf(ofSolids));
}

/// For fluids, whose near lists are yet to be found, and wet solids; both are `m_some` from now on.
void DensityStage::startNear(const ParticleStore& store, const PairLists& pairs) {
  assignBoth<uint32_t>(m_some, m_fluid, m_wet);
  m_near.start(pairs, store.size());
  m_near.find(pairs, m_points.data(), m_wet);
  m_nearKnown = true;
}

void DensityStage::project(ParticleStore& store, const Neighbours& neighbours, int iteration) {
  if (m_fluid.empty()) return;
  const PairLists pairs = lists(store, neighbours);
  const double wanted = m_settings.relaxation;
  const float relaxation =
      static_cast<float>(m_settings.iterations == 1 ? std::min(wanted, kSingleStepRelaxation) : wanted);
  loadPoints(store);
  if (iteration == 0) startNear(store, pairs);
  const PairLists near = m_near.lists(pairs);
  // x_k+1 = x_k-1 + w (x_k + jacobi - x_k-1), with w = 1 for two steps, then 2/(2 - rho^2), then 4/(4 - rho^2 w).
  const float rho2 = static_cast<float>(m_settings.chebyshevRadius * m_settings.chebyshevRadius);
  if (iteration < 2 || m_settings.densitySolver == DensitySolver::Jacobi)
    m_chebyshev = 1;
  else
    m_chebyshev = iteration == 2 ? 2 / (2 - rho2) : 4 / (4 - rho2 * m_chebyshev);
  const size_t fluids = m_fluid.size(), moving = fluids + m_wet.size();
  makeRoom();
  m_moves.resize(moving);
  m_movesInFilm.resize(m_film.any() ? moving : 0);
  forChunks(fluids, grain::kPairs, [&](size_t first, size_t last) {
    multipliers(store, iteration == 0 ? pairs : near, relaxation, iteration == 0, first, last);
  });
  m_moved.start(chunkCount(moving, grain::kPairs));
  forChunks(moving, grain::kPairs, [&](size_t first, size_t last) {
    sumMoves(near, first, last);
    move(store, pairs, first, last);
  });
  if (m_touchesFixed || m_walls.any()) m_externalImpulse.add(m_moved.total());
  tellWalls(store);
  tellFixed(store, pairs);
}

/// What walls and fixed bodies get by the opposite of what their half spaces gave to the density of particles.
void DensityStage::tellWalls(const ParticleStore& store) {
  if (!m_reactions->watchesWalls() && !(m_shapes->any() && m_reactions->watchesBodies())) return;
  m_reactions->start(chunkCount(m_fluid.size(), grain::kParticles));
  forChunks(m_fluid.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_fluid[k];
      const float multiplier = m_carried[i].w;
      if (multiplier == 0) continue;
      m_walls.forSlopes(i, m_points[i], [&](const WallPlane& p, const HalfSpaces::Owner& owner, float slope) {
        const double moved = double{multiplier} * slope;
        Vector3 given = -m_reactions->perStep() * moved * Vector3(p.x, p.y, p.z);
        if (m_film.concerns(i)) given -= double{m_film.yieldOf(i)} * given.dot(m_film.up()) * m_film.up();
        m_reactions->add(first / grain::kParticles, owner.slotIn(*m_reactions), vectorOf(store.position()[i]), given);
      });
    }
  });
  m_reactions->finish();
}

/// What fixed particles would be moved by, times their mass, if they could: pairs move by equal and opposite amounts.
void DensityStage::tellFixed(const ParticleStore& store, const PairLists& pairs) {
  if (m_watched.empty()) return;
  for (const uint32_t i : m_fluid) m_multipliers[i].w = m_carried[i].w;
  m_watchedMoves.resize(m_watched.size());
  m_reactions->start(chunkCount(m_watched.size(), grain::kPairs));
  forChunks(m_watched.size(), grain::kPairs, [&](size_t first, size_t last) {
    sumMultipliers(pairs, m_multipliers.data(), m_watched.data(), first, last, m_watchedMoves.data());
    for (size_t k = first; k < last; ++k) {
      const uint32_t j = m_watched[k];
      Vector3 moved = double{m_volume[j]} * double{pairs.inverseSupportSquared} * vectorOf(m_watchedMoves[k]);
      if (m_film.concerns(j)) moved += m_film.correctionOf(store, {pairs, m_volume.data(), m_multipliers.data()}, j);
      m_reactions->add(first / grain::kPairs, m_reactions->ofBody(store.body()[j]), vectorOf(store.position()[j]),
                       m_reactions->perStep() * moved);
    }
  });
  m_reactions->finish();
}

DensityError DensityStage::measure(ParticleStore& store, const Neighbours& neighbours, const Bounds& bounds) {
  float *error = store.densityError(), *pressure = store.pressure();
  forChunks(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) error[i] = pressure[i] = 0;
  });
  const size_t fluids = m_fluid.size();
  if (fluids == 0) return {};
  loadPoints(store);
  const PairLists pairs = lists(store, neighbours);
  if (!m_nearKnown) {  // else those of the last substep
    startNear(store, pairs);
    m_near.find(pairs, m_points.data(), m_fluid);
  }
  const PairLists near = m_near.lists(pairs);
  m_multiplierSum.resize(store.size() + kSpare);
  forChunks(fluids, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_multipliers[m_fluid[k]].w = m_multiplierSum[m_fluid[k]];
  });
  const double dt = m_settings.dt / m_settings.substeps, perSubstep = 1 / (dt * dt * m_settings.substeps);
  m_compression.resize(fluids);
  m_errors.assign(chunkCount(fluids, grain::kPairs), {});
  forChunks(fluids, grain::kPairs, [&](size_t first, size_t last) {
    sumCompression(near, m_points.data(), m_multipliers.data(), m_fluid.data(), first, last, m_compression.data());
    DensityError& part = m_errors[first / grain::kPairs];
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_fluid[k];
      const CompressionSums& sums = m_compression[k];
      const HalfSpaces::Compression walls = m_walls.compressionOf(i, m_points[i]);
      const double own = sums.byVolumes + walls.byVolumes, volume = store.position()[i].w;
      const double work = 0.5 * (own * double{m_multiplierSum[i]} + double{m_volume[i]} * sums.byMultipliers);
      if (volume > 0) pressure[i] = static_cast<float>(-perSubstep * work / volume);
      error[i] = m_volume[i] + sums.excess - 1 + walls.excess;
      if (store.motion()[i] != api::Motion::Liquid || !isInside(store.position()[i], bounds)) continue;
      const double c = std::max(0.0f, error[i]);
      part.mean += c;
      part.max = std::max(part.max, c);
      ++part.liquids;
    }
  });
  DensityError result;
  for (const DensityError& part : m_errors) {
    result.mean += part.mean;
    result.max = std::max(result.max, part.max);
    result.liquids += part.liquids;
  }
  if (result.liquids > 0) result.mean /= static_cast<double>(result.liquids);
  return result;
}

void DensityStage::handOver(ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> melted) {
  if (melted.empty()) return;
  loadPoints(store);
  const PairLists pairs = lists(store, neighbours);
  m_sums.resize(std::max(m_sums.size(), melted.size()));
  forChunks(melted.size(), grain::kPairs, [&](size_t first, size_t last) {
    sumDensity(pairs, m_points.data(), m_weights, melted.data(), first, last, m_sums.data());
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = melted[k];
      const float walls = m_walls.of(i, m_points[i]).excess;
      store.compression()[i] = std::max(0.0f, m_volume[i] + m_sums[k].excess - 1 + walls);
    }
  });
}

}  // namespace ps
