// SPDX-License-Identifier: Apache-2.0
#include "core/solver/implicitviscosity.h"

#include "core/solver/chunks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr size_t kGrain = 128;
constexpr size_t kSpare = 16;
constexpr float kFarAway = 1e8f;
constexpr size_t kIntervals = 256;
/// nu dt/dx2 that the iteration is asked for at most. Its length hardly depends on it (35 iterations at most for a
/// column of 24 particles, 64 for one of 48, from 1e2 to 1e5), but beyond this float32 and the tolerance hide the flow.
constexpr double kReach = 1e4;
/// Squared relative change of velocity that float32 cannot tell from none.
constexpr double kRounding = 1e-13;
/// Iterations that are always done: a guess that just meets the tolerance would be taken substep after substep, and its
/// error would add up to a slope that creeps where it should stand.
constexpr int kLeast = 2;
constexpr const char* kField = "viscous_change";

api::Float4 times(const SymmetricBlock& m, const api::Float4& v) {
  return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
          m.xz * v.x + m.yz * v.y + m.zz * v.z, 0};
}

double dot(const api::Float4& a, const api::Float4& b) {
  return double{a.x} * double{b.x} + double{a.y} * double{b.y} + double{a.z} * double{b.z};
}

/// Of a positive definite matrix, by cofactors.
SymmetricBlock inverseOf(const SymmetricBlock& m) {
  const double xx = m.xx, yy = m.yy, zz = m.zz, xy = m.xy, xz = m.xz, yz = m.yz;
  const double a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - xz * yy;
  const double s = 1 / (xx * a + xy * b + xz * c);
  return {static_cast<float>(s * a),
          static_cast<float>(s * (xx * zz - xz * xz)),
          static_cast<float>(s * (xx * yy - xy * xy)),
          static_cast<float>(s * b),
          static_cast<float>(s * c),
          static_cast<float>(s * (xy * xz - xx * yz))};
}

}  // namespace

template <class Body>
void ImplicitViscosity::forSegments(const Body& body) {
  forChunks(m_segments.size(), 1, [&](size_t first, size_t last) {
    for (size_t s = first; s < last; ++s) body(s);
  });
}

void ImplicitViscosity::configure(const SolverSettings& settings, const std::vector<Wall>& walls) {
  m_settings = settings;
  m_dirty = true;
  m_planes.clear();
  for (const Wall& w : walls) {
    if (!w.noSlip) continue;
    m_planes.push_back({static_cast<float>(w.normal.x), static_cast<float>(w.normal.y), static_cast<float>(w.normal.z),
                        static_cast<float>(w.offset)});
  }
  const double support = settings.spacing * settings.supportRatio;
  if (m_support == support) return;
  m_support = support;
  // What half a space beyond a distance d resists, per volume and viscosity, to a velocity that goes to zero at d:
  // 10 int G x (x) x z/d dV, G = a g/R7. The angle is integrated in closed form, u = d/r: (1 - u2)2/8 along the plane,
  // (1 - u4)/4 across it. Kept times d; with q = r/R it has no unit but 1/m.
  m_wallTable.assign(kIntervals + 1, {0, 0});
  constexpr int kSteps = 200;
  for (size_t k = 0; k < kIntervals; ++k) {
    const double d = static_cast<double>(k) / kIntervals, step = (1 - d) / kSteps;
    double along = 0, across = 0;
    for (int n = 0; n < kSteps; ++n) {
      const double q = d + (n + 0.5) * step, u2 = d * d / (q * q), a = 1 - q;
      const double weight =
          20 * std::numbers::pi * kStressNormalisation / support * step * a * a * (1 + 1 / q) * (q * q * q * q * q);
      along += weight * (1 - u2) * (1 - u2) / 8;
      across += weight * (1 - u2 * u2) / 4;
    }
    m_wallTable[k] = {static_cast<float>(along), static_cast<float>(across)};
  }
}

double ImplicitViscosity::greatestViscosity() const {
  return kReach * m_settings.spacing * m_settings.spacing * m_settings.substeps / m_settings.dt;
}

void ImplicitViscosity::rest() {
  m_active = false;
  m_dirty = true;
  m_iterations = 0;
  m_residual = 0;
}

ImplicitViscosity::Role ImplicitViscosity::roleOf(const ParticleStore& store, std::span<const float> viscous,
                                                  size_t i) const {
  if (viscous[i] > 0) return Role::Viscous;
  const api::Motion motion = store.motion()[i];
  if (motion == api::Motion::Gas) return Role::None;
  return store.velocity()[i].w > 0 ? Role::Free : Role::Fixed;
}

void ImplicitViscosity::refresh(ParticleStore& store, std::span<const float> viscous) {
  m_active = true;
  m_iterations = 0;
  m_residual = 0;
  store.declare(kField, api::FieldType::Float4, "m/s", "Change of velocity by implicit viscosity in the last substep");
  const size_t n = store.size();
  m_viscous.assign(viscous.begin(), viscous.end());
  if (m_roles.size() != n) m_dirty = true;
  m_roles.resize(n);
  for (size_t i = 0; i < n; ++i) {
    const Role role = roleOf(store, viscous, i);
    m_dirty = m_dirty || role != m_roles[i];
    m_roles[i] = role;
  }
}

void ImplicitViscosity::flood(uint32_t seed, const api::NeighbourView& view, bool& anchored) {
  m_stack.assign(1, seed);
  m_found[seed] = 1;
  while (!m_stack.empty()) {
    const uint32_t i = m_stack.back();
    m_stack.pop_back();
    m_rows.push_back(i);
    const bool own = m_roles[i] == Role::Viscous;
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      const Role role = m_roles[j];
      if (role == Role::None || (!own && role != Role::Viscous)) continue;
      anchored = anchored || role == Role::Fixed;
      if (role == Role::Fixed || m_found[j] != 0) continue;
      m_found[j] = 1;
      m_stack.push_back(j);
    }
  }
}

void ImplicitViscosity::findGroups(const ParticleStore& store, const Neighbours& neighbours) {
  m_dirty = false;
  m_rows.clear();
  m_groups.clear();
  m_segments.clear();
  m_found.assign(store.size(), 0);
  const api::NeighbourView view = neighbours.view();
  for (size_t i = 0; i < store.size(); ++i) {
    if (m_roles[i] != Role::Viscous || m_found[i] != 0) continue;
    const size_t begin = m_rows.size();
    Group group;
    flood(static_cast<uint32_t>(i), view, group.anchored);
    std::sort(m_rows.begin() + static_cast<std::ptrdiff_t>(begin), m_rows.end());
    group.firstSegment = static_cast<uint32_t>(m_segments.size());
    for (size_t first = begin; first < m_rows.size(); first += kGrain) {
      m_segments.push_back({static_cast<uint32_t>(m_groups.size()), static_cast<uint32_t>(first),
                            static_cast<uint32_t>(std::min(first + kGrain, m_rows.size()))});
    }
    group.lastSegment = static_cast<uint32_t>(m_segments.size());
    m_groups.push_back(group);
  }
  const size_t rows = m_rows.size();
  for (std::vector<api::Float4>* v : {&m_diagonal, &m_offDiagonal, &m_change, &m_rest, &m_preconditioned, &m_product}) {
    v->resize(rows);
  }
  m_own.resize(rows);
  m_inverse.resize(rows);
  m_shear.resize(rows);
  m_sums.resize(m_segments.size());
  m_partial.resize(m_segments.size());
}

void ImplicitViscosity::loadPoints(const ParticleStore& store, const DensityStage& density) {
  const size_t n = store.size();
  m_points.resize(n + kSpare);
  m_direction.resize(n + kSpare);
  const api::Float4* position = store.position();
  const std::span<const float> volume = density.volumes();
  forChunks(n, 4 * kGrain, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      m_points[i] = {position[i].x, position[i].y, position[i].z, m_roles[i] == Role::None ? 0 : volume[i]};
    }
  });
  m_points[n] = {kFarAway, kFarAway, kFarAway, 0};
  m_direction[n] = {0, 0, 0, 0};
}

bool ImplicitViscosity::addWalls(const api::Float4& at, float weight, SymmetricBlock& block) const {
  const float nearest = static_cast<float>(0.5 * m_settings.spacing), support = static_cast<float>(m_support);
  bool touched = false;
  for (const Plane& p : m_planes) {
    const float distance = std::max(nearest, p.x * at.x + p.y * at.y + p.z * at.z - p.offset);
    if (distance >= support) continue;
    touched = true;
    const float s = distance / support * static_cast<float>(kIntervals);
    const size_t k = std::min(static_cast<size_t>(s), kIntervals - 1);
    const float f = s - static_cast<float>(k);
    const auto &a = m_wallTable[k], &b = m_wallTable[k + 1];
    const float along = weight / distance * (a[0] + f * (b[0] - a[0]));
    const float across = weight / distance * (a[1] + f * (b[1] - a[1])) - along;
    block.xx += along + across * p.x * p.x, block.yy += along + across * p.y * p.y;
    block.zz += along + across * p.z * p.z, block.xy += across * p.x * p.y;
    block.xz += across * p.x * p.z, block.yz += across * p.y * p.z;
  }
  return touched;
}

void ImplicitViscosity::assemble(const ParticleStore& store, const PairLists& lists, double scale,
                                 const float* viscosity) {
  const size_t n = store.size();
  m_coefficient.resize(n > 0 ? lists.end[n - 1] : 0);
  const double dt = m_settings.dt / m_settings.substeps;
  const float factor = static_cast<float>(10 * dt * kStressNormalisation / (std::pow(m_support, 7) * scale * scale));
  const StressField field{m_points.data(), viscosity, m_viscous.data()};
  forSegments([&](size_t s) {
    const Segment& segment = m_segments[s];
    stressCoefficients(lists, field, factor, m_rows.data(), segment.first, segment.last, m_coefficient.data(),
                       m_diagonal.data(), m_offDiagonal.data());
    bool touched = false;
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = m_rows[k];
      const float mass = store.mass()[i];
      SymmetricBlock own{mass, mass, mass, 0, 0, 0};
      if (m_roles[i] == Role::Viscous) {
        const double volume = double{m_points[i].w} / scale;
        touched = addWalls(m_points[i], static_cast<float>(dt * volume * viscosity[i]), own) || touched;
      }
      m_own[k] = own;
      const api::Float4 &d = m_diagonal[k], &o = m_offDiagonal[k];
      m_inverse[k] = inverseOf({own.xx + d.x, own.yy + d.y, own.zz + d.z, own.xy + o.x, own.xz + o.y, own.yz + o.z});
    }
    m_partial[s][0] = touched ? 1 : 0;
  });
}

/// Mass, centre and inertia of each group that no boundary touches.
void ImplicitViscosity::measureGroups(const ParticleStore& store) {
  for (Group& group : m_groups) {
    group.closed = !group.anchored;
    for (size_t s = group.firstSegment; s < group.lastSegment; ++s) group.closed &= m_partial[s][0] == 0;
  }
  forSegments([&](size_t s) {
    const Segment& segment = m_segments[s];
    if (!m_groups[segment.group].closed) return;
    Sums sums{};
    for (size_t k = segment.first; k < segment.last; ++k) {
      const api::Float4& p = store.position()[m_rows[k]];
      const double m = store.mass()[m_rows[k]], x = p.x, y = p.y, z = p.z;
      const double terms[10] = {m,         m * x,     m * y,     m * z,     m * x * x,
                                m * y * y, m * z * z, m * x * y, m * x * z, m * y * z};
      for (size_t a = 0; a < 10; ++a) sums[a] += terms[a];
    }
    m_sums[s] = sums;
  });
  for (Group& group : m_groups) {
    if (!group.closed) continue;
    Sums t{};
    for (size_t s = group.firstSegment; s < group.lastSegment; ++s) {
      for (size_t a = 0; a < 10; ++a) t[a] += m_sums[s][a];
    }
    group.mass = t[0];
    group.center = {t[1] / t[0], t[2] / t[0], t[3] / t[0]};
    const auto [x, y, z] = group.center;
    const double xx = t[4] - t[0] * x * x, yy = t[5] - t[0] * y * y, zz = t[6] - t[0] * z * z;
    const double xy = t[7] - t[0] * x * y, xz = t[8] - t[0] * x * z, yz = t[9] - t[0] * y * z;
    // A group in a line has no inertia about it, and no angular momentum either.
    const double floor = 1e-9 * (xx + yy + zz + t[0] * m_settings.spacing * m_settings.spacing);
    const double a = yy + zz + floor, b = xx + zz + floor, c = xx + yy + floor;
    const double m00 = b * c - yz * yz, m01 = xy * c + xz * yz, m02 = xy * yz + xz * b;
    const double s = 1 / (a * m00 - xy * m01 - xz * m02);
    group.inverseInertia = {s * m00,
                            s * m01,
                            s * m02,
                            s * m01,
                            s * (a * c - xz * xz),
                            s * (a * yz + xy * xz),
                            s * m02,
                            s * (a * yz + xy * xz),
                            s * (a * b - xy * xy)};
  }
}

void ImplicitViscosity::addMomenta(const ParticleStore& store, const api::Float4* vectors, size_t segment) {
  const Segment& range = m_segments[segment];
  const Group& group = m_groups[range.group];
  if (!group.closed) return;
  Sums sums{};
  for (size_t k = range.first; k < range.last; ++k) {
    const api::Float4& p = store.position()[m_rows[k]];
    const double m = store.mass()[m_rows[k]];
    const double x = p.x - group.center[0], y = p.y - group.center[1], z = p.z - group.center[2];
    const double vx = m * vectors[k].x, vy = m * vectors[k].y, vz = m * vectors[k].z;
    sums[0] += vx, sums[1] += vy, sums[2] += vz;
    sums[3] += y * vz - z * vy, sums[4] += z * vx - x * vz, sums[5] += x * vy - y * vx;
  }
  m_sums[segment] = sums;
}

void ImplicitViscosity::reduceMomenta() {
  for (Group& group : m_groups) {
    if (!group.closed) continue;
    std::array<double, 6> t{};
    for (size_t s = group.firstSegment; s < group.lastSegment; ++s) {
      for (size_t a = 0; a < 6; ++a) t[a] += m_sums[s][a];
    }
    const auto& inverse = group.inverseInertia;
    for (size_t a = 0; a < 3; ++a) {
      group.linear[a] = t[a] / group.mass;
      group.angular[a] = inverse[3 * a] * t[3] + inverse[3 * a + 1] * t[4] + inverse[3 * a + 2] * t[5];
    }
  }
}

api::Float4 ImplicitViscosity::withoutRigidMotion(const ParticleStore& store, const Group& group, uint32_t i,
                                                  api::Float4 v) const {
  if (!group.closed) return v;
  const api::Float4& p = store.position()[i];
  const double x = p.x - group.center[0], y = p.y - group.center[1], z = p.z - group.center[2];
  const auto& w = group.angular;
  return {static_cast<float>(v.x - group.linear[0] - (w[1] * z - w[2] * y)),
          static_cast<float>(v.y - group.linear[1] - (w[2] * x - w[0] * z)),
          static_cast<float>(v.z - group.linear[2] - (w[0] * y - w[1] * x)), 0};
}

double ImplicitViscosity::sum(size_t which) const {
  double total = 0;
  for (const auto& partial : m_partial) total += partial[which];
  return total;
}

void ImplicitViscosity::multiply(const ParticleStore& store, const PairLists& lists, size_t first, size_t last,
                                 float massShare) {
  sumStress(lists, m_points.data(), m_coefficient.data(), m_direction.data(), m_rows.data(), first, last,
            m_product.data());
  for (size_t k = first; k < last; ++k) {
    const uint32_t i = m_rows[k];
    const float less = (1 - massShare) * store.mass()[i];
    const api::Float4 &u = m_direction[i], own = times(m_own[k], u);
    m_product[k].x += own.x - less * u.x;
    m_product[k].y += own.y - less * u.y;
    m_product[k].z += own.z - less * u.z;
  }
}

/// Right side b = -dt K v*, the first guess and its residual.
void ImplicitViscosity::start(ParticleStore& store, const PairLists& lists, const api::Float4* guess) {
  const size_t n = store.size();
  const api::Float4* velocity = store.velocity();
  forChunks(n, 4 * kGrain, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_direction[i] = velocity[i];
  });
  forSegments([&](size_t s) {
    const Segment& segment = m_segments[s];
    multiply(store, lists, segment.first, segment.last, 0);
    double reference = 0, rounding = 0;
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = m_rows[k];
      const api::Float4& q = m_product[k];
      m_rest[k] = {-q.x, -q.y, -q.z, 0};
      reference += dot(q, times(m_inverse[k], q));
      const double v2 = dot(velocity[i], velocity[i]);
      rounding += v2 * (double{m_diagonal[k].x} + m_diagonal[k].y + m_diagonal[k].z + store.mass()[i]);
      m_change[k] = guess[i];
    }
    m_partial[s] = {reference, rounding};
    addMomenta(store, m_change.data(), s);
  });
  reduceMomenta();
  m_reference = sum(0);
  const double tolerance = m_settings.viscosityTolerance;
  m_target = std::max(tolerance * tolerance * m_reference, kRounding * sum(1));
  std::fill(m_direction.begin(), m_direction.end(), api::Float4{0, 0, 0, 0});
  forSegments([&](size_t s) {
    const Segment& segment = m_segments[s];
    for (size_t k = segment.first; k < segment.last; ++k) {
      m_change[k] = withoutRigidMotion(store, m_groups[segment.group], m_rows[k], m_change[k]);
      m_direction[m_rows[k]] = m_change[k];
    }
  });
}

void ImplicitViscosity::iterate(const ParticleStore& store, const PairLists& lists) {
  // A step of length 1 along the guess turns b into the residual; afterwards the usual recurrence.
  double step = 1, before = 0;
  int iteration = 0;
  for (;; ++iteration) {
    forSegments([&](size_t s) {
      const Segment& segment = m_segments[s];
      multiply(store, lists, segment.first, segment.last, 1);
      double curvature = 0;
      for (size_t k = segment.first; k < segment.last; ++k) curvature += dot(m_direction[m_rows[k]], m_product[k]);
      m_partial[s][0] = curvature;
    });
    if (iteration > 0) {
      const double curvature = sum(0);
      if (!(curvature > 0)) break;
      step = before / curvature;
    }
    const float alpha = static_cast<float>(step);
    forSegments([&](size_t s) {
      const Segment& segment = m_segments[s];
      double square = 0;
      for (size_t k = segment.first; k < segment.last; ++k) {
        const api::Float4 &q = m_product[k], &p = m_direction[m_rows[k]];
        api::Float4 &r = m_rest[k], &x = m_change[k];
        r = {r.x - alpha * q.x, r.y - alpha * q.y, r.z - alpha * q.z, 0};
        if (iteration > 0) x = {x.x + alpha * p.x, x.y + alpha * p.y, x.z + alpha * p.z, 0};
        m_preconditioned[k] = times(m_inverse[k], r);
        square += dot(r, m_preconditioned[k]);
      }
      m_partial[s][1] = square;
      addMomenta(store, m_preconditioned.data(), s);
    });
    m_residualSquare = sum(1);
    if ((m_residualSquare <= m_target && iteration >= kLeast) || iteration >= m_settings.viscosityIterations) break;
    reduceMomenta();
    const float beta = iteration > 0 ? static_cast<float>(m_residualSquare / before) : 0;
    before = m_residualSquare;
    forSegments([&](size_t s) {
      const Segment& segment = m_segments[s];
      for (size_t k = segment.first; k < segment.last; ++k) {
        const api::Float4 z = withoutRigidMotion(store, m_groups[segment.group], m_rows[k], m_preconditioned[k]);
        api::Float4& p = m_direction[m_rows[k]];
        p = {z.x + beta * p.x, z.y + beta * p.y, z.z + beta * p.z, 0};
      }
    });
  }
  m_iterations = std::max(m_iterations, iteration);
}

void ImplicitViscosity::apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density,
                              const float* viscosity) {
  if (!m_active || m_roles.size() != store.size()) return;
  if (m_dirty) findGroups(store, neighbours);
  auto* field = static_cast<api::Float4*>(store.find(kField, api::FieldType::Float4));
  if (m_rows.empty() || !field) return;
  const PairLists lists = density.lists(neighbours);
  loadPoints(store, density);
  assemble(store, lists, density.kernelScale(), viscosity);
  measureGroups(store);
  start(store, lists, field);
  iterate(store, lists);
  if (m_residualSquare > m_target) {
    m_residual = std::max(m_residual, std::sqrt(m_residualSquare / m_reference));
  }
  api::Float4* velocity = store.velocity();
  forSegments([&](size_t s) {
    for (size_t k = m_segments[s].first; k < m_segments[s].last; ++k) {
      const uint32_t i = m_rows[k];
      const api::Float4& x = m_change[k];
      velocity[i].x += x.x, velocity[i].y += x.y, velocity[i].z += x.z;
      field[i] = x;
    }
  });
}

void ImplicitViscosity::shearRates(const ParticleStore& store, const Neighbours& neighbours,
                                   const DensityStage& density, std::vector<float>& rates) {
  if (!m_active || m_roles.size() != store.size()) return;
  if (m_dirty) findGroups(store, neighbours);
  rates.resize(store.size() + kSpare, 0.0f);
  loadPoints(store, density);
  const PairLists lists = density.lists(neighbours);
  const api::Float4* velocity = store.velocity();
  const float scale = static_cast<float>(5 * kStressNormalisation / (std::pow(m_support, 7) * density.kernelScale()));
  forSegments([&](size_t s) {
    const Segment& segment = m_segments[s];
    sumShear(lists, m_points.data(), velocity, m_rows.data(), segment.first, segment.last, m_shear.data());
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = m_rows[k];
      if (m_roles[i] != Role::Viscous) continue;
      SymmetricBlock wall{0, 0, 0, 0, 0, 0};
      addWalls(m_points[i], 0.5f, wall);
      rates[i] = std::sqrt(scale * m_shear[k] + static_cast<float>(dot(velocity[i], times(wall, velocity[i]))));
    }
  });
}

}  // namespace ps
