// SPDX-License-Identifier: Apache-2.0
// Newton's method on rotations as in rotation.cpp, operation by operation; a lane that is done keeps its rotation.
#include "rotationkernels.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rotationkernels.cpp"
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ps::constraint {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
constexpr size_t kLanes = HWY_MIN(HWY_LANES(double), 8);

HWY_INLINE V set(double v) { return hn::Set(D(), v); }
HWY_INLINE V plus(V a, V b) { return hn::Add(a, b); }
HWY_INLINE V minus(V a, V b) { return hn::Sub(a, b); }
HWY_INLINE V times(V a, V b) { return hn::Mul(a, b); }
HWY_INLINE M finite(V v) { return hn::Lt(v, set(std::numeric_limits<double>::infinity())); }

struct V3 {
  V x, y, z;
};
HWY_INLINE V3 scaled(V s, V3 a) { return {times(s, a.x), times(s, a.y), times(s, a.z)}; }
HWY_INLINE V dot(V3 a, V3 b) { return plus(plus(times(a.x, b.x), times(a.y, b.y)), times(a.z, b.z)); }
HWY_INLINE V3 chosen(M mask, V3 yes, V3 no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}

struct Turn {
  V x, y, z, w;
};
HWY_INLINE Turn chosen(M mask, Turn yes, Turn no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z),
          hn::IfThenElse(mask, yes.w, no.w)};
}
HWY_INLINE Turn product(Turn a, Turn b) {
  return {minus(plus(plus(times(a.w, b.x), times(a.x, b.w)), times(a.y, b.z)), times(a.z, b.y)),
          plus(plus(minus(times(a.w, b.y), times(a.x, b.z)), times(a.y, b.w)), times(a.z, b.x)),
          plus(minus(plus(times(a.w, b.z), times(a.x, b.y)), times(a.y, b.x)), times(a.z, b.w)),
          minus(minus(minus(times(a.w, b.w), times(a.x, b.x)), times(a.y, b.y)), times(a.z, b.z))};
}
HWY_INLINE Turn normalised(Turn q) {
  const V length2 = plus(plus(plus(times(q.x, q.x), times(q.y, q.y)), times(q.z, q.z)), times(q.w, q.w));
  const M has = hn::And(hn::Gt(length2, set(1e-30)), finite(length2));
  const V s = hn::Div(set(1), hn::Sqrt(length2)), none = hn::Zero(D());
  return chosen(has, {times(s, q.x), times(s, q.y), times(s, q.z), times(s, q.w)}, {none, none, none, set(1)});
}

/// 1 - s/n * rest
HWY_INLINE V series(V s, double n, V rest) { return minus(set(1), times(times(s, set(1 / n)), rest)); }

HWY_INLINE Turn exponential(V3 v) {
  constexpr int kMost = 40;
  const V square = dot(v, v), one = set(1);
  V scale = set(0.5), angle2 = times(set(0.25), square), halvings = hn::Zero(D());
  int most = 0;
  for (; most < kMost; ++most) {
    const M large = hn::Gt(angle2, set(0.01));
    if (hn::AllFalse(D(), large)) break;
    scale = hn::IfThenElse(large, times(scale, set(0.5)), scale);
    angle2 = hn::IfThenElse(large, times(angle2, set(0.25)), angle2);
    halvings = hn::IfThenElse(large, plus(halvings, one), halvings);
  }
  const V s = times(times(scale, scale), square);
  const V sine = times(scale, series(s, 6, series(s, 20, series(s, 42, minus(one, times(s, set(1.0 / 72)))))));
  const V cosine = series(s, 2, series(s, 12, series(s, 30, minus(one, times(s, set(1.0 / 56))))));
  Turn q{times(sine, v.x), times(sine, v.y), times(sine, v.z), cosine};
  for (int k = 0; k < most; ++k) q = chosen(hn::Gt(halvings, set(k)), product(q, q), q);
  return normalised(q);
}

struct Symmetric {
  V xx, yy, zz, xy, xz, yz;
};

HWY_INLINE M solve(const Symmetric& h, V3 g, V3& x) {
  constexpr double kSafe = 1e-4;
  const V zero = hn::Zero(D());
  const V a = minus(times(h.yy, h.zz), times(h.yz, h.yz)), b = minus(times(h.xz, h.yz), times(h.xy, h.zz)),
          c = minus(times(h.xy, h.yz), times(h.xz, h.yy)), minor = minus(times(h.xx, h.yy), times(h.xy, h.xy)),
          e = minus(times(h.xy, h.xz), times(h.xx, h.yz)), f = minus(times(h.xx, h.zz), times(h.xz, h.xz));
  const V determinant = dot({h.xx, h.xy, h.xz}, {a, b, c}), sum = plus(plus(h.xx, h.yy), h.zz);
  const V least = times(times(times(set(kSafe), sum), sum), sum);
  x = scaled(hn::Div(set(1), determinant), {dot({a, b, c}, g), dot({b, f, e}, g), dot({c, e, minor}, g)});
  return hn::And(hn::And(hn::Gt(sum, zero), hn::Gt(h.xx, zero)),
                 hn::And(hn::Gt(minor, zero), hn::Gt(determinant, least)));
}

HWY_INLINE M solveDamped(Symmetric h, V3 g, V3& x) {
  constexpr double kFloor = 0.02;
  const V xy = hn::Abs(h.xy), xz = hn::Abs(h.xz), yz = hn::Abs(h.yz);
  const V lowest = hn::Min(hn::Min(minus(minus(h.xx, xy), xz), minus(minus(h.yy, xy), yz)), minus(minus(h.zz, xz), yz));
  const V size = plus(plus(plus(hn::Abs(h.xx), hn::Abs(h.yy)), hn::Abs(h.zz)), hn::Abs(lowest));
  const V more = plus(hn::Max(hn::Zero(D()), hn::Neg(lowest)), times(set(kFloor), size));
  h.xx = plus(h.xx, more), h.yy = plus(h.yy, more), h.zz = plus(h.zz, more);
  return solve(h, g, x);
}

/// Columns of what the scalar method calls r: rows of the rotation.
struct Rows {
  V3 row[3];
};
HWY_INLINE Rows rowsOf(Turn q) {
  const V xx = times(q.x, q.x), yy = times(q.y, q.y), zz = times(q.z, q.z), xy = times(q.x, q.y), xz = times(q.x, q.z),
          yz = times(q.y, q.z), wx = times(q.w, q.x), wy = times(q.w, q.y), wz = times(q.w, q.z), one = set(1),
          two = set(2);
  return {{{minus(one, times(two, plus(yy, zz))), times(two, minus(xy, wz)), times(two, plus(xz, wy))},
           {times(two, plus(xy, wz)), minus(one, times(two, plus(xx, zz))), times(two, minus(yz, wx))},
           {times(two, minus(xz, wy)), times(two, plus(yz, wx)), minus(one, times(two, plus(xx, yy)))}}};
}

HWY_INLINE Turn rotationOf(const V3* a, Turn q, double exact) {
  constexpr int kMost = 60;
  const V half = set(-0.5);
  M open = hn::Eq(half, half);
  for (int k = 0; k < kMost; ++k) {
    const Rows r = rowsOf(q);
    V3 m[3];
    for (size_t i = 0; i < 3; ++i) m[i] = {dot(r.row[0], a[i]), dot(r.row[1], a[i]), dot(r.row[2], a[i])};
    const V trace = plus(plus(m[0].x, m[1].y), m[2].z);
    const V3 slope{minus(m[2].y, m[1].z), minus(m[0].z, m[2].x), minus(m[1].x, m[0].y)};
    const Symmetric curvature{minus(trace, m[0].x),
                              minus(trace, m[1].y),
                              minus(trace, m[2].z),
                              times(half, plus(m[0].y, m[1].x)),
                              times(half, plus(m[0].z, m[2].x)),
                              times(half, plus(m[1].z, m[2].y))};
    V3 turn, damped;
    const M whole = solve(curvature, slope, turn);
    M solved = whole;
    if (!hn::AllTrue(D(), whole)) {
      const M others = solveDamped(curvature, slope, damped);
      turn = chosen(whole, turn, damped);
      solved = hn::Or(solved, others);
    }
    const V angle2 = dot(turn, turn);
    open = hn::And(hn::And(open, solved), hn::And(hn::Gt(angle2, set(exact * exact)), finite(angle2)));
    if (hn::AllFalse(D(), open)) break;
    const M wide = hn::Gt(angle2, set(1));
    turn = chosen(wide, scaled(hn::Div(set(1), hn::Sqrt(angle2)), turn), turn);
    // What is done, or is no number, would keep others turning in exponential().
    const V none = hn::Zero(D());
    turn = chosen(open, turn, {none, none, none});
    q = chosen(open, normalised(product(exponential(turn), q)), q);
    open = hn::AndNot(hn::And(whole, hn::Lt(angle2, set(kLastTurn * exact))), open);
    if (hn::AllFalse(D(), open)) break;
  }
  return q;
}

HWY_INLINE V3 loadVector(const ShapeVectors& v, size_t lane) {
  const D d;
  return {hn::Load(d, v[0].data() + lane), hn::Load(d, v[1].data() + lane), hn::Load(d, v[2].data() + lane)};
}
HWY_INLINE void storeVector(V3 v, ShapeVectors& to, size_t lane) {
  const D d;
  hn::Store(v.x, d, to[0].data() + lane), hn::Store(v.y, d, to[1].data() + lane);
  hn::Store(v.z, d, to[2].data() + lane);
}

void FitShapes(ShapeFits& fits, size_t count, double exact) {
  const D d;
  for (size_t lane = 0; lane < count; lane += kLanes) {
    const V3 centre = loadVector(fits.centre, lane), restCentre = loadVector(fits.restCentre, lane);
    // Beyond the last shape stands a unit matrix, of which nothing remains to be found.
    const M one = hn::FirstN(d, count - lane);
    const V along[3] = {centre.x, centre.y, centre.z};
    V3 rows[3];
    for (size_t i = 0; i < 3; ++i) {
      const V3 about = loadVector(fits.moments[i], lane), gone = scaled(along[i], restCentre);
      rows[i] = chosen(one, {minus(about.x, gone.x), minus(about.y, gone.y), minus(about.z, gone.z)},
                       {set(i == 0), set(i == 1), set(i == 2)});
    }
    const auto part = [&](size_t k) HWY_ATTR { return hn::Load(d, fits.rotation[k].data() + lane); };
    const V none = hn::Zero(d);
    const Turn from = chosen(one, {part(0), part(1), part(2), part(3)}, {none, none, none, set(1)});
    const Turn found = rotationOf(rows, normalised(from), exact);
    const V parts[4] = {found.x, found.y, found.z, found.w};
    for (size_t k = 0; k < 4; ++k) hn::Store(parts[k], d, fits.rotation[k].data() + lane);
    const Rows r = rowsOf(found);
    const V scale = hn::Load(d, fits.scale.data() + lane);
    const V3 turned[3] = {scaled(scale, r.row[0]), scaled(scale, r.row[1]), scaled(scale, r.row[2])};
    for (size_t i = 0; i < 3; ++i) storeVector(turned[i], fits.moments[i], lane);
    storeVector({minus(centre.x, dot(turned[0], restCentre)), minus(centre.y, dot(turned[1], restCentre)),
                 minus(centre.z, dot(turned[2], restCentre))},
                fits.offset, lane);
  }
}

void FindRotations(const Matrix* a, Quaternion* q, size_t count, double exact) {
  const D d;
  for (size_t first = 0; first < count; first += kLanes) {
    alignas(64) double number[13][kLanes];
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const size_t k = HWY_MIN(first + lane, count - 1);
      for (size_t row = 0; row < 3; ++row) {
        const Vector& v = a[k].row[row];
        number[3 * row][lane] = v.x, number[3 * row + 1][lane] = v.y, number[3 * row + 2][lane] = v.z;
      }
      number[9][lane] = q[k].x, number[10][lane] = q[k].y, number[11][lane] = q[k].z, number[12][lane] = q[k].w;
    }
    const auto at = [&](size_t n) HWY_ATTR { return hn::Load(d, number[n]); };
    const V3 rows[3] = {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, {at(6), at(7), at(8)}};
    const Turn found = rotationOf(rows, {at(9), at(10), at(11), at(12)}, exact);
    hn::Store(found.x, d, number[9]), hn::Store(found.y, d, number[10]);
    hn::Store(found.z, d, number[11]), hn::Store(found.w, d, number[12]);
    for (size_t lane = 0; lane < kLanes && first + lane < count; ++lane)
      q[first + lane] = {number[9][lane], number[10][lane], number[11][lane], number[12][lane]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace ps::constraint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps::constraint {
namespace {
HWY_EXPORT(FindRotations);
HWY_EXPORT(FitShapes);
}  // namespace

void findRotations(const Matrix* a, Quaternion* q, size_t count, double exact) {
  if (count > 0) HWY_DYNAMIC_DISPATCH(FindRotations)(a, q, count, exact);
}

void fitShapes(ShapeFits& fits, size_t count, double exact) { HWY_DYNAMIC_DISPATCH(FitShapes)(fits, count, exact); }

}  // namespace ps::constraint
#endif
