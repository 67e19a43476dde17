// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/density.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
constexpr double kHandOverTime = 0.1;  // s

bool isFluid(api::Motion m) { return m == api::Motion::Liquid || m == api::Motion::Gas; }

bool isInside(const api::Float4& p, const Bounds& bounds) {
  const api::Double3 &low = bounds.minimum, &high = bounds.maximum;
  const double x = p.x, y = p.y, z = p.z;
  return x >= low.x && x <= high.x && y >= low.y && y <= high.y && z >= low.z && z <= high.z;
}

}  // namespace

HalfSpaceTable::HalfSpaceTable(const Kernel& kernel) : m_values(kIntervals + 1) {
  // Over a plane at distance z the kernel integrates to A(z) = 2 pi int_z^R r W dr; beyond d there is int_d^R A dz.
  constexpr int kSteps = 16;  // of Simpson's rule per interval
  const double support = kernel.supportRadius(), step = support / (kIntervals * kSteps);
  const auto integrand = [&](double r) { return 2 * std::numbers::pi * r * kernel.value(r); };
  double area = 0, share = 0;
  m_values[kIntervals] = {0, 0};
  for (int k = kIntervals * kSteps; k > 0; --k) {
    const double high = k * step, low = (k - 1) * step, middle = 0.5 * (high + low), quarter = 0.5 * (middle + high);
    const double upperHalf = step / 12 * (integrand(middle) + 4 * integrand(quarter) + integrand(high));
    const double whole = step / 6 * (integrand(low) + 4 * integrand(middle) + integrand(high));
    share += step / 6 * (area + 4 * (area + upperHalf) + area + whole);
    area += whole;
    if ((k - 1) % kSteps == 0)
      m_values[static_cast<size_t>((k - 1) / kSteps)] = {static_cast<float>(share), static_cast<float>(-area)};
  }
  m_perMetre = static_cast<float>(kIntervals / support);
}

HalfSpaceTable::Value HalfSpaceTable::at(float distance) const {
  const float s = std::max(0.0f, distance) * m_perMetre;
  if (!(s < kIntervals)) return {0, 0};
  const size_t k = static_cast<size_t>(s);
  const float f = s - static_cast<float>(k);
  const Value &a = m_values[k], &b = m_values[k + 1];
  return {a.share + f * (b.share - a.share), a.slope + f * (b.slope - a.slope)};
}

void DensityStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  const bool newKernel = m_halfSpaceKernel != settings.kernel || m_support != settings.spacing * settings.supportRatio;
  m_settings = settings;
  m_planes.clear();
  for (const Wall& w : walls) m_planes.emplace_back(w);
  m_film.configure(settings, m_planes);
  if (!newKernel && m_scale > 0) return;
  m_halfSpaceKernel = settings.kernel;
  m_support = settings.spacing * settings.supportRatio;
  const Kernel kernel(settings.kernel, m_support);
  m_scale = kernel.value(0);  // w(0) = 1 for both shapes
  m_halfSpace = HalfSpaceTable(kernel);
}

PairLists DensityStage::lists(const ParticleStore& store, const Neighbours& neighbours) const {
  const api::NeighbourView view = neighbours.view();
  const float inverseSquare = static_cast<float>(1 / (m_support * m_support));
  return {view.begin, view.last, view.end, view.index, m_settings.kernel, inverseSquare, store.period()};
}

void DensityStage::refresh(const ParticleStore& store, const Neighbours& neighbours) {
  const size_t n = store.size();
  for (std::vector<api::Float4>* v : {&m_points, &m_multipliers}) v->resize(n + kSpare);
  m_carried.resize(n);
  m_carriedMultiplier.resize(n);
  m_volume.resize(n + kSpare);
  m_weight.resize(n + kSpare);
  m_fluid.clear();
  const api::Motion* motion = store.motion();
  const api::Float4 *position = store.position(), *velocity = store.velocity();
  for (size_t i = 0; i < n; ++i) {
    m_volume[i] = position[i].w;
    if (isFluid(motion[i]) && velocity[i].w > 0) m_fluid.push_back(static_cast<uint32_t>(i));
  }
  const api::Float4 dummy{kFarAway, kFarAway, kFarAway, 0};
  m_points[n] = m_multipliers[n] = dummy;
  m_volume[n] = m_weight[n] = 0;
  refreshLists(store, neighbours);
  if (m_fluid.empty()) return;
  const PairLists pairs = lists(store, neighbours);
  solidVolumes(store, pairs, api::Motion::Solid, kSolidLeast, kSolidMost);
  solidVolumes(store, pairs, api::Motion::Static, kStaticLeast, kStaticMost);
  const float scale = static_cast<float>(m_scale);
  for (size_t i = 0; i < n; ++i) {
    m_volume[i] *= scale;
    m_weight[i] = velocity[i].w * m_volume[i] * m_volume[i];
  }
}

void DensityStage::refreshLists(const ParticleStore& store, const Neighbours& neighbours) {
  const size_t n = store.size();
  const api::NeighbourView view = neighbours.view();
  m_touched.assign(n + kSpare, 0);
  m_wet.clear();
  m_watched.clear();
  m_touchesFixed = false;
  if (m_fluid.empty()) return;
  m_isFluid.assign(n, 0);
  for (const uint32_t i : m_fluid) m_isFluid[i] = 1;
  // Few fluid particles tell their neighbours; of many, each of the others looks for one, all at once.
  if (8 * m_fluid.size() < n) {
    for (const uint32_t i : m_fluid) {
      for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) m_touched[view.index[q]] = 1;
    }
    for (const uint32_t i : m_fluid) m_touched[i] = 0;
  } else {
    forChunks(n, grain::kPairs, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) {
        if (m_isFluid[i] != 0) continue;
        for (uint32_t q = view.begin[i]; q < view.last[i] && m_touched[i] == 0; ++q)
          m_touched[i] = m_isFluid[view.index[q]];
      }
    });
  }
  const api::Motion* motion = store.motion();
  for (size_t i = 0; i < n; ++i) {
    const bool moves = store.velocity()[i].w > 0;
    m_touchesFixed = m_touchesFixed || (m_touched[i] != 0 && !moves);
    if (m_touched[i] != 0 && !moves && m_reactions->ofBody(store.body()[i]) != Reactions::kNone)
      m_watched.push_back(static_cast<uint32_t>(i));
    if (m_touched[i] != 0 && moves && motion[i] == api::Motion::Solid) m_wet.push_back(static_cast<uint32_t>(i));
  }
  m_film.refresh(store, neighbours, m_wet);
}

void DensityStage::solidVolumes(const ParticleStore& store, const PairLists& pairs, api::Motion motion, float least,
                                float most) {
  // Only those near fluid matter.
  m_some.clear();
  const api::Motion* motions = store.motion();
  for (size_t i = 0; i < store.size(); ++i) {
    if (motions[i] == motion && m_touched[i] != 0) m_some.push_back(static_cast<uint32_t>(i));
  }
  if (m_some.empty()) return;
  const api::Float4* position = store.position();
  for (size_t i = 0; i < store.size(); ++i) {
    m_points[i] = {position[i].x, position[i].y, position[i].z, motions[i] == motion ? 1.0f : 0.0f};
  }
  m_sums.resize(std::max(m_sums.size(), m_some.size()));
  const float scale = static_cast<float>(m_scale);
  forChunks(m_some.size(), grain::kPairs, [&](size_t first, size_t last) {
    sumDensity(pairs, m_points.data(), m_weight.data(), m_some.data(), first, last, m_sums.data());
    for (size_t k = first; k < last; ++k) {
      const float own = position[m_some[k]].w;
      m_volume[m_some[k]] = std::clamp(1 / (scale * (1 + m_sums[k].excess)), least * own, most * own);
    }
  });
}

void DensityStage::loadPoints(const ParticleStore& store) {
  const api::Float4* position = store.position();
  forChunks(store.size(), grain::kPairs, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      m_points[i] = {position[i].x, position[i].y, position[i].z, m_volume[i]};
      m_multipliers[i] = {position[i].x, position[i].y, position[i].z, 0};
    }
  });
}

float DensityStage::addWalls(const api::Float4& at, Constraint& gradient) const {
  const float nearest = static_cast<float>(0.5 * m_settings.spacing), support = static_cast<float>(m_support);
  float excess = 0;
  for (const WallPlane& p : m_planes) {
    const float distance = p.heightOf(at);
    if (distance >= support) continue;
    const HalfSpaceTable::Value value = m_halfSpace.at(std::max(nearest, distance));
    excess += value.share;
    gradient.x += p.x * value.slope;
    gradient.y += p.y * value.slope;
    gradient.z += p.z * value.slope;
  }
  return excess;
}

void DensityStage::multipliers(const ParticleStore& store, const PairLists& pairs, float relaxation, size_t first,
                               size_t last) {
  sumDensity(pairs, m_points.data(), m_weight.data(), m_fluid.data(), first, last, m_sums.data());
  const float perR2 = pairs.inverseSupportSquared;
  const float epsilon = kEpsilon / static_cast<float>(m_settings.spacing * m_settings.spacing);
  for (size_t k = first; k < last; ++k) {
    const uint32_t i = m_fluid[k];
    const DensitySums& s = m_sums[k];
    const float inverseMass = store.velocity()[i].w;
    Constraint c{s.x * perR2, s.y * perR2, s.z * perR2, 0};
    m_excess[k] = m_volume[i] + s.excess - 1 + addWalls(m_points[i], c);
    const float active = m_excess[k] - store.compression()[i];
    if (active > 0) {
      const float own = c.x * c.x + c.y * c.y + c.z * c.z;
      c.lambda = -relaxation * active / (inverseMass * (own + epsilon) + s.squares * perR2);
    }
    m_constraints[k] = c;
    m_multipliers[i].w = c.lambda;
  }
}

/// What a gap takes off the corrections of a particle, m kg (TrappedFilm).
Vector3 DensityStage::inFilm(const ParticleStore& store, const PairLists& pairs, uint32_t i, float lambda) const {
  Constraint walls{};
  addWalls(m_points[i], walls);
  const double ofWalls = double{m_film.yieldOf(i) * lambda} * Vector3{walls.x, walls.y, walls.z}.dot(m_film.up());
  return m_film.correctionOf(store, {pairs, m_volume.data(), m_multipliers.data()}, i) - ofWalls * m_film.up();
}

void DensityStage::move(ParticleStore& store, const PairLists& pairs, float chebyshev, size_t first, size_t last) {
  const size_t fluids = m_fluid.size();
  sumMultipliers(pairs, m_multipliers.data(), m_some.data(), first, last, m_moves.data());
  api::Float4* position = store.position();
  for (size_t k = first; k < last; ++k) {
    const uint32_t i = m_some[k];
    const float inverseMass = store.velocity()[i].w, others = inverseMass * m_volume[i] * pairs.inverseSupportSquared;
    float dx = others * m_moves[k].x, dy = others * m_moves[k].y, dz = others * m_moves[k].z;
    api::Float4& x = position[i];
    if (k < fluids) {
      const Constraint& c = m_constraints[k];
      const float own = inverseMass * c.lambda;
      dx += own * c.x, dy += own * c.y, dz += own * c.z;
    }
    if (m_film.concerns(i)) {
      const Vector3 off = double{inverseMass} * inFilm(store, pairs, i, m_multipliers[i].w);
      dx += static_cast<float>(off.x()), dy += static_cast<float>(off.y()), dz += static_cast<float>(off.z());
    }
    // Only what density did is carried on, not what walls and structure did between two iterations, and by the same
    // factors for fluids and solids: so the semi-iteration keeps momentum, and ice feels the lift that water gives.
    api::Float4& carried = m_carried[i];
    if (chebyshev != 1) {
      dx = chebyshev * dx + (chebyshev - 1) * carried.x;
      dy = chebyshev * dy + (chebyshev - 1) * carried.y;
      dz = chebyshev * dz + (chebyshev - 1) * carried.z;
    }
    carried = {dx, dy, dz, 0};
    x.x += dx, x.y += dy, x.z += dz;
    m_moved.add(first / grain::kPairs, store.mass()[i], {dx, dy, dz});
  }
}

void DensityStage::project(ParticleStore& store, const Neighbours& neighbours, int iteration) {
  if (m_fluid.empty()) return;
  const PairLists pairs = lists(store, neighbours);
  const double wanted = m_settings.relaxation;
  const float relaxation =
      static_cast<float>(m_settings.iterations == 1 ? std::min(wanted, kSingleStepRelaxation) : wanted);
  loadPoints(store);
  // x_k+1 = x_k-1 + w (x_k + jacobi - x_k-1), with w = 1 for two steps, then 2/(2 - rho^2), then 4/(4 - rho^2 w).
  const float rho2 = static_cast<float>(m_settings.chebyshevRadius * m_settings.chebyshevRadius);
  if (iteration < 2 || m_settings.densitySolver == DensitySolver::Jacobi)
    m_chebyshev = 1;
  else
    m_chebyshev = iteration == 2 ? 2 / (2 - rho2) : 4 / (4 - rho2 * m_chebyshev);
  const size_t fluids = m_fluid.size(), moving = fluids + m_wet.size();
  m_sums.resize(std::max(m_sums.size(), fluids));
  m_constraints.resize(fluids);
  m_excess.resize(fluids);
  m_moves.resize(moving);
  m_some.assign(m_fluid.begin(), m_fluid.end());
  m_some.insert(m_some.end(), m_wet.begin(), m_wet.end());
  forChunks(fluids, grain::kPairs,
            [&](size_t first, size_t last) { multipliers(store, pairs, relaxation, first, last); });
  m_moved.start(chunkCount(moving, grain::kPairs));
  forChunks(moving, grain::kPairs, [&](size_t first, size_t last) { move(store, pairs, m_chebyshev, first, last); });
  if (m_touchesFixed || !m_planes.empty()) m_externalImpulse.add(m_moved.total());
  carryMultipliers();
  tellWalls(store);
  tellFixed(store, pairs);
}

/// As places are carried on from one iteration to the next, so are the multipliers that moved them.
void DensityStage::carryMultipliers() {
  const float w = m_chebyshev;
  forChunks(m_fluid.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_fluid[k];
      float& carried = m_carriedMultiplier[i];
      carried = w == 1 ? m_constraints[k].lambda : w * m_constraints[k].lambda + (w - 1) * carried;
      if (i < m_multiplierSum.size()) m_multiplierSum[i] += carried;
    }
  });
}

/// What walls get by the opposite of what their half spaces gave to the density of particles.
void DensityStage::tellWalls(const ParticleStore& store) {
  if (!m_reactions->watchesWalls()) return;
  const float nearest = static_cast<float>(0.5 * m_settings.spacing), support = static_cast<float>(m_support);
  m_reactions->start(chunkCount(m_fluid.size(), grain::kParticles));
  forChunks(m_fluid.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_fluid[k];
      for (size_t w = 0; w < m_planes.size(); ++w) {
        const WallPlane& p = m_planes[w];
        const float distance = p.heightOf(m_points[i]);
        if (distance >= support || m_carriedMultiplier[i] == 0) continue;
        const double moved = double{m_carriedMultiplier[i]} * m_halfSpace.at(std::max(nearest, distance)).slope;
        Vector3 given = -m_reactions->perStep() * moved * Vector3(p.x, p.y, p.z);
        if (m_film.concerns(i)) given -= double{m_film.yieldOf(i)} * given.dot(m_film.up()) * m_film.up();
        m_reactions->add(first / grain::kParticles, m_reactions->ofWall(w), vectorOf(store.position()[i]), given);
      }
    }
  });
  m_reactions->finish();
}

/// What fixed particles would be moved by, times their mass, if they could: pairs move by equal and opposite amounts.
void DensityStage::tellFixed(const ParticleStore& store, const PairLists& pairs) {
  if (m_watched.empty()) return;
  for (const uint32_t i : m_fluid) m_multipliers[i].w = m_carriedMultiplier[i];
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

void DensityStage::writePressure(ParticleStore& store, const PairLists& pairs) {
  const size_t fluids = m_fluid.size();
  m_compression.resize(2 * fluids);
  for (const uint32_t i : m_fluid) m_multipliers[i].w = i < m_multiplierSum.size() ? m_multiplierSum[i] : 0;
  const double dt = m_settings.dt / m_settings.substeps, perSubstep = 1 / (dt * dt * m_settings.substeps);
  const float nearest = static_cast<float>(0.5 * m_settings.spacing), support = static_cast<float>(m_support);
  forChunks(fluids, grain::kPairs, [&](size_t first, size_t last) {
    float* byOthers = m_compression.data() + fluids;
    sumCompression(pairs, m_points.data(), m_fluid.data(), first, last, m_compression.data());
    sumCompression(pairs, m_multipliers.data(), m_fluid.data(), first, last, byOthers);
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = m_fluid[k];
      double own = m_compression[k];
      for (const WallPlane& p : m_planes) {
        const float distance = std::max(nearest, p.heightOf(m_points[i]));
        if (distance >= support) continue;
        const HalfSpaceTable::Value value = m_halfSpace.at(distance);
        own += double{value.share} - double{distance} * value.slope / 3;
      }
      const double volume = store.position()[i].w;
      const double work = 0.5 * (own * double{m_multipliers[i].w} + double{m_volume[i]} * byOthers[k]);
      if (volume > 0) store.pressure()[i] = static_cast<float>(-perSubstep * work / volume);
    }
  });
}

DensityError DensityStage::measure(ParticleStore& store, const Neighbours& neighbours, const Bounds& bounds) {
  float *error = store.densityError(), *lambda = store.lambda();
  std::fill(error, error + store.size(), 0.0f);
  std::fill(lambda, lambda + store.size(), 0.0f);
  std::fill(store.pressure(), store.pressure() + store.size(), 0.0f);
  const size_t fluids = m_fluid.size();
  if (fluids == 0) return {};
  loadPoints(store);
  m_sums.resize(std::max(m_sums.size(), fluids));
  m_constraints.resize(fluids);
  m_excess.resize(fluids);
  const PairLists pairs = lists(store, neighbours);
  forChunks(fluids, grain::kPairs, [&](size_t first, size_t last) {
    multipliers(store, pairs, static_cast<float>(m_settings.relaxation), first, last);
  });
  writePressure(store, pairs);
  DensityError result;
  for (size_t k = 0; k < fluids; ++k) {
    const uint32_t i = m_fluid[k];
    error[i] = m_excess[k];
    lambda[i] = m_constraints[k].lambda;
    if (store.motion()[i] != api::Motion::Liquid || !isInside(store.position()[i], bounds)) continue;
    const double c = std::max(0.0f, m_excess[k]);
    result.mean += c;
    result.max = std::max(result.max, c);
    ++result.liquids;
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
    sumDensity(pairs, m_points.data(), m_weight.data(), melted.data(), first, last, m_sums.data());
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = melted[k];
      Constraint unused{};
      store.compression()[i] = std::max(0.0f, m_volume[i] + m_sums[k].excess - 1 + addWalls(m_points[i], unused));
    }
  });
}

void DensityStage::decayCompression(ParticleStore& store, double dt) const {
  const float factor = static_cast<float>(1 / (1 + dt / kHandOverTime));
  float* offset = store.compression();
  for (const uint32_t i : m_fluid) offset[i] = offset[i] < 1e-5f ? 0 : offset[i] * factor;
}

}  // namespace ps
