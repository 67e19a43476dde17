// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/implicitviscosity.h"

#include "core/base/parallelarrays.h"
#include "core/base/room.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

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
/// Drag along a wall, in that of a velocity that goes on linearly to zero there. Films bend: their layers, taken as
/// straight, feel less than the slope at the wall. With this films of 2, 3, 4, 6 and 10 layers flow 1.11, 1.09, 1.06,
/// 1.01 and 0.99 times as fast as they should, without it 1.25, 1.17, 1.12, 1.06 and 1.01.
constexpr double kBent = 1.2;
/// Drag on a pair of liquid and solid, in that of two particles of liquid: the surface lies halfway between them, where
/// the liquid's velocity is the solid's, and goes on linearly beyond. Channels between fixed layers, 3, 4, 6, 8 and 12
/// layers wide, pass 1.08, 1.08, 1.03, 1.00 and 0.97 of what they should; 1.72, 1.58, 1.40, 1.31 and 1.15 where liquid
/// is held at the centres.
constexpr float kHalfway = 2;
constexpr const char* kField = "viscous_change";

/// Not std::pow, whose last bit differs between C libraries.
double seventhPower(double x) { return x * x * x * x * x * x * x; }

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
  forChunks(m_groups.segments().size(), 1, [&](size_t s, size_t) { body(s, m_groups.segments()[s]); });
}

void ImplicitViscosity::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                                  const FixedShapes& shapes) {
  m_shapes = &shapes;
  m_settings = settings;
  m_dirty = true;
  m_held.clear();
  m_wallOf.clear();
  for (size_t w = 0; w < walls.size(); ++w) {
    if (!walls[w].noSlip) continue;
    m_held.emplace_back(walls[w]);
    m_wallOf.push_back(w);
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
    m_wallTable[k] = {static_cast<float>(kBent * along), static_cast<float>(across)};
  }
}

double ImplicitViscosity::greatestViscosity() const {
  return kReach * m_settings.spacing * m_settings.spacing * m_settings.substeps / m_settings.dt;
}

void ImplicitViscosity::deactivate() {
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
  assignAll(m_viscous, viscous);
  if (m_roles.size() != n) m_dirty = true;
  m_roles.resize(n);
  for (size_t i = 0; i < n; ++i) {
    const Role role = roleOf(store, viscous, i);
    m_dirty = m_dirty || role != m_roles[i];
    m_roles[i] = role;
  }
}

void ImplicitViscosity::findGroups(const Neighbours& neighbours) {
  m_dirty = false;
  m_groups.find(m_roles, neighbours.view());
  const size_t rows = m_groups.rows().size(), segments = m_groups.segments().size();
  for (std::vector<api::Float4>* v : {&m_diagonal, &m_offDiagonal, &m_change, &m_rest, &m_preconditioned, &m_product}) {
    v->resize(rows);
  }
  m_own.resize(rows);
  m_drag.resize(rows);
  m_inverse.resize(rows);
  m_shear.resize(rows);
  m_touched.resize(segments);
  m_partial.resize(segments);
}

void ImplicitViscosity::loadPoints(const ParticleStore& store, const DensityStage& density) {
  const size_t n = store.size();
  m_points.resize(n + kSpare);
  m_direction.resize(n + kSpare);
  const api::Float4* position = store.position();
  const std::span<const float> volume = density.volumes();
  forChunks(n, grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const float share = m_roles[i] == Role::None ? 0 : api::holds(store.motion()[i]) ? kHalfway : 1;
      m_points[i] = {position[i].x, position[i].y, position[i].z, share * volume[i]};
    }
  });
  m_points[n] = {kFarAway, kFarAway, kFarAway, 0};
  m_direction[n] = {0, 0, 0, 0};
}

bool ImplicitViscosity::addWall(const WallPlane& p, const api::Float4& at, float weight, SymmetricBlock& block) const {
  const float nearest = static_cast<float>(0.5 * m_settings.spacing), support = static_cast<float>(m_support);
  const float distance = std::max(nearest, p.heightOf(at));
  if (distance >= support) return false;
  const float s = distance / support * static_cast<float>(kIntervals);
  const size_t k = std::min(static_cast<size_t>(s), kIntervals - 1);
  const float f = s - static_cast<float>(k);
  const auto &a = m_wallTable[k], &b = m_wallTable[k + 1];
  const float along = weight / distance * (a[0] + f * (b[0] - a[0]));
  const float across = weight / distance * (a[1] + f * (b[1] - a[1])) - along;
  block.xx += along + across * p.x * p.x, block.yy += along + across * p.y * p.y;
  block.zz += along + across * p.z * p.z, block.xy += across * p.x * p.y;
  block.xz += across * p.x * p.z, block.yz += across * p.y * p.z;
  return true;
}

template <class Visit>
void ImplicitViscosity::forPlanes(uint32_t i, Visit&& visit) const {
  constexpr api::Float4 kStill{0, 0, 0, 0};
  for (size_t w = 0; w < m_held.size(); ++w) visit(m_held[w].at(m_points[i]), kStill, m_reactions->ofWall(m_wallOf[w]));
  const double rate = m_settings.substeps / m_settings.dt;
  for (const FixedShapes::Near& face : m_shapes->near(i)) {
    api::Float4 velocity = kStill;
    if (m_shapes->moves()) velocity = float4Of(rate * m_shapes->wayOf(face.body, vectorOf(m_points[i])), 0);
    visit(face.plane, velocity, m_reactions->ofBody(face.body));
  }
}

bool ImplicitViscosity::addWalls(uint32_t i, float weight, SymmetricBlock& block, api::Float4& drag) const {
  bool touched = false;
  forPlanes(i, [&](const WallPlane& p, const api::Float4& velocity, int) {
    SymmetricBlock own{0, 0, 0, 0, 0, 0};
    if (!addWall(p, m_points[i], weight, own)) return;
    touched = true;
    block.xx += own.xx, block.yy += own.yy, block.zz += own.zz;
    block.xy += own.xy, block.xz += own.xz, block.yz += own.yz;
    const api::Float4 d = times(own, velocity);
    drag.x += d.x, drag.y += d.y, drag.z += d.z;
  });
  return touched;
}

/// What walls and fixed particles get of the velocities that the last apply() left.
void ImplicitViscosity::tellHeld(const ParticleStore& store, const PairLists& lists, const float* viscosity,
                                 double scale) {
  if (!m_reactions->any() || !held()) return;
  const double dt = m_settings.dt / m_settings.substeps;
  m_reactions->start(m_groups.segments().size());
  forSegments([&](size_t s, const Segment& segment) {
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = row(k);
      if (m_roles[i] != Role::Viscous) continue;
      const Vector3 place = vectorOf(store.position()[i]), velocity = vectorOf(store.velocity()[i]);
      const auto weight = static_cast<float>(dt * double{m_points[i].w} / scale * viscosity[i]);
      forPlanes(i, [&](const WallPlane& p, const api::Float4& of, int slot) {
        SymmetricBlock block{0, 0, 0, 0, 0, 0};
        const api::Float4& v = store.velocity()[i];
        if (slot != Reactions::kNone && addWall(p, m_points[i], weight, block))
          m_reactions->add(s, slot, place, vectorOf(times(block, {v.x - of.x, v.y - of.y, v.z - of.z, 0})));
      });
      for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
        const uint32_t j = lists.index[q];
        if (m_roles[j] != Role::Fixed) continue;
        const Vector3 line = vectorOf(store.separation(i, j));
        const double along = line.dot(velocity - vectorOf(store.velocity()[j]));
        m_reactions->add(s, m_reactions->ofBody(store.body()[j]), vectorOf(store.position()[j]),
                         double{m_coefficient[q]} * along * line);
      }
    }
  });
  m_reactions->finish();
}

void ImplicitViscosity::assemble(const ParticleStore& store, const PairLists& lists, double scale,
                                 const float* viscosity) {
  makeRoomFor(m_coefficient, lists.slots);
  const double dt = m_settings.dt / m_settings.substeps;
  const float factor = static_cast<float>(10 * dt * kStressNormalisation / (seventhPower(m_support) * scale * scale));
  const StressField field{m_points.data(), viscosity, m_viscous.data()};
  forSegments([&](size_t s, const Segment& segment) {
    stressCoefficients(lists, field, factor, m_groups.rows().data(), segment.first, segment.last, m_coefficient.data(),
                       m_diagonal.data(), m_offDiagonal.data());
    bool touched = false;
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = row(k);
      const float mass = store.mass()[i];
      SymmetricBlock own{mass, mass, mass, 0, 0, 0};
      m_drag[k] = {0, 0, 0, 0};
      if (m_roles[i] == Role::Viscous) {
        const double volume = double{m_points[i].w} / scale;
        touched = addWalls(i, static_cast<float>(dt * volume * viscosity[i]), own, m_drag[k]) || touched;
      }
      m_own[k] = own;
      const api::Float4 &d = m_diagonal[k], &o = m_offDiagonal[k];
      m_inverse[k] = inverseOf({own.xx + d.x, own.yy + d.y, own.zz + d.z, own.xy + o.x, own.xz + o.y, own.yz + o.z});
    }
    m_touched[s] = touched ? 1 : 0;
  });
}

double ImplicitViscosity::sum(size_t which) const {
  double total = 0;
  for (const auto& partial : m_partial) total += partial[which];
  return total;
}

void ImplicitViscosity::multiply(const ParticleStore& store, const PairLists& lists, size_t first, size_t last,
                                 float massShare) {
  sumStress(lists, m_points.data(), m_coefficient.data(), m_direction.data(), m_groups.rows().data(), first, last,
            m_product.data());
  for (size_t k = first; k < last; ++k) {
    const uint32_t i = row(k);
    const float less = (1 - massShare) * store.mass()[i];
    const api::Float4 &u = m_direction[i], own = times(m_own[k], u);
    m_product[k].x += own.x - less * u.x;
    m_product[k].y += own.y - less * u.y;
    m_product[k].z += own.z - less * u.z;
  }
}

/// Right side b = -dt K v*, where surfaces that move count by how fast v* is beside them; the first guess and its
/// residual.
void ImplicitViscosity::start(ParticleStore& store, const PairLists& lists, const api::Float4* guess) {
  const size_t n = store.size();
  const api::Float4* velocity = store.velocity();
  forChunks(n, grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_direction[i] = velocity[i];
  });
  forSegments([&](size_t s, const Segment& segment) {
    multiply(store, lists, segment.first, segment.last, 0);
    double reference = 0, rounding = 0;
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = row(k);
      api::Float4 &q = m_product[k], &drag = m_drag[k];
      q = {q.x - drag.x, q.y - drag.y, q.z - drag.z, 0};
      m_rest[k] = {-q.x, -q.y, -q.z, 0};
      reference += dot(q, times(m_inverse[k], q));
      const double v2 = dot(velocity[i], velocity[i]);
      rounding += v2 * (double{m_diagonal[k].x} + m_diagonal[k].y + m_diagonal[k].z + store.mass()[i]);
      m_change[k] = guess[i];
    }
    m_partial[s] = {reference, rounding};
    m_groups.addMomenta(store, m_change.data(), s);
  });
  m_groups.reduceMomenta();
  m_reference = sum(0);
  const double tolerance = m_settings.viscosityTolerance;
  m_target = std::max(tolerance * tolerance * m_reference, kRounding * sum(1));
  std::fill(m_direction.begin(), m_direction.end(), api::Float4{0, 0, 0, 0});
  forSegments([&](size_t, const Segment& segment) {
    for (size_t k = segment.first; k < segment.last; ++k) {
      m_change[k] = m_groups.without(store, segment.group, row(k), m_change[k]);
      m_direction[row(k)] = m_change[k];
    }
  });
}

/// p . A p, and A p in m_product.
double ImplicitViscosity::curvature(const ParticleStore& store, const PairLists& lists) {
  forSegments([&](size_t s, const Segment& segment) {
    multiply(store, lists, segment.first, segment.last, 1);
    double along = 0;
    for (size_t k = segment.first; k < segment.last; ++k) along += dot(m_direction[row(k)], m_product[k]);
    m_partial[s][0] = along;
  });
  return sum(0);
}

/// Takes `step` of A p from the rest and of p to the change; returns rest . D^-1 rest.
double ImplicitViscosity::advance(const ParticleStore& store, float step, bool change) {
  forSegments([&](size_t s, const Segment& segment) {
    double square = 0;
    for (size_t k = segment.first; k < segment.last; ++k) {
      const api::Float4 &q = m_product[k], &p = m_direction[row(k)];
      api::Float4 &r = m_rest[k], &x = m_change[k];
      r = {r.x - step * q.x, r.y - step * q.y, r.z - step * q.z, 0};
      if (change) x = {x.x + step * p.x, x.y + step * p.y, x.z + step * p.z, 0};
      m_preconditioned[k] = times(m_inverse[k], r);
      square += dot(r, m_preconditioned[k]);
    }
    m_partial[s][1] = square;
    m_groups.addMomenta(store, m_preconditioned.data(), s);
  });
  m_groups.reduceMomenta();
  return sum(1);
}

void ImplicitViscosity::redirect(const ParticleStore& store, float keep) {
  forSegments([&](size_t, const Segment& segment) {
    for (size_t k = segment.first; k < segment.last; ++k) {
      const api::Float4 z = m_groups.without(store, segment.group, row(k), m_preconditioned[k]);
      api::Float4& p = m_direction[row(k)];
      p = {z.x + keep * p.x, z.y + keep * p.y, z.z + keep * p.z, 0};
    }
  });
}

void ImplicitViscosity::iterate(const ParticleStore& store, const PairLists& lists) {
  // A step of length 1 along the guess turns b into the residual.
  curvature(store, lists);
  m_residualSquare = advance(store, 1, false);
  redirect(store, 0);
  int iteration = 0;
  while (iteration < m_settings.viscosityIterations && (m_residualSquare > m_target || iteration < kLeast)) {
    const double along = curvature(store, lists);
    if (!(along > 0)) break;
    const double before = m_residualSquare;
    m_residualSquare = advance(store, static_cast<float>(before / along), true);
    redirect(store, static_cast<float>(m_residualSquare / before));
    ++iteration;
  }
  m_iterations = std::max(m_iterations, iteration);
}

void ImplicitViscosity::apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density,
                              const float* viscosity) {
  if (!m_active || m_roles.size() != store.size()) return;
  if (m_dirty) findGroups(neighbours);
  auto* field = static_cast<api::Float4*>(store.find(kField, api::FieldType::Float4));
  if (m_groups.rows().empty() || !field) return;
  const PairLists lists = density.lists(store, neighbours);
  loadPoints(store, density);
  assemble(store, lists, density.kernelScale(), viscosity);
  m_groups.measure(store, m_touched, m_settings.spacing);
  start(store, lists, field);
  iterate(store, lists);
  if (m_residualSquare > m_target) {
    m_residual = std::max(m_residual, std::sqrt(m_residualSquare / m_reference));
  }
  api::Float4* velocity = store.velocity();
  forSegments([&](size_t, const Segment& segment) {
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = row(k);
      const api::Float4& x = m_change[k];
      velocity[i].x += x.x, velocity[i].y += x.y, velocity[i].z += x.z;
      field[i] = x;
    }
  });
  tellHeld(store, lists, viscosity, density.kernelScale());
}

void ImplicitViscosity::shearRates(const ParticleStore& store, const Neighbours& neighbours,
                                   const DensityStage& density, std::vector<float>& rates) {
  if (!m_active || m_roles.size() != store.size()) return;
  if (m_dirty) findGroups(neighbours);
  rates.resize(store.size() + kSpare, 0.0f);
  loadPoints(store, density);
  const PairLists lists = density.lists(store, neighbours);
  const api::Float4* velocity = store.velocity();
  const float scale = static_cast<float>(5 * kStressNormalisation / (seventhPower(m_support) * density.kernelScale()));
  forSegments([&](size_t, const Segment& segment) {
    sumShear(lists, m_points.data(), velocity, m_groups.rows().data(), segment.first, segment.last, m_shear.data());
    for (size_t k = segment.first; k < segment.last; ++k) {
      const uint32_t i = row(k);
      if (m_roles[i] != Role::Viscous) continue;
      double wall = 0;
      forPlanes(i, [&](const WallPlane& p, const api::Float4& of, int) {
        SymmetricBlock block{0, 0, 0, 0, 0, 0};
        const api::Float4& own = velocity[i];
        const api::Float4 v{own.x - of.x, own.y - of.y, own.z - of.z, 0};
        if (addWall(p, m_points[i], 0.5f, block)) wall += dot(v, times(block, v));
      });
      rates[i] = std::sqrt(scale * m_shear[k] + static_cast<float>(wall));
    }
  });
}

}  // namespace ps
