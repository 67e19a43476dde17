// SPDX-License-Identifier: Apache-2.0
// How high particles are over a wall, a vector at a time.
// Included once for each instruction set: no guard of its own but Highway's.
#if defined(PS_WALLHEIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PS_WALLHEIGHTS_INL_H
#undef PS_WALLHEIGHTS_INL_H
#else
#define PS_WALLHEIGHTS_INL_H
#endif

#include "core/particles/float4lanes-inl.h"
#include "core/solver/contact/wallplane.h"

HWY_BEFORE_NAMESPACE();
namespace ps {
namespace HWY_NAMESPACE {

/// A normal for each lane, and m over the face.
struct LaneHeights {
  V x, y, z, height;
};

HWY_INLINE LaneHeights overWall(const WallSurface& wall, const Vectors4& at) {
  const D d;
  if (!wall.isCurved()) {
    const WallPlane& p = wall.plane;
    const V nx = hn::Set(d, p.x), ny = hn::Set(d, p.y), nz = hn::Set(d, p.z);
    const V along = hn::Add(hn::Add(hn::Mul(nx, at.x), hn::Mul(ny, at.y)), hn::Mul(nz, at.z));
    return {nx, ny, nz, hn::Sub(along, hn::Set(d, p.offset))};
  }
  const V ax = hn::Set(d, wall.axisX), ay = hn::Set(d, wall.axisY), az = hn::Set(d, wall.axisZ);
  const V x = hn::Sub(at.x, hn::Set(d, wall.centreX)), y = hn::Sub(at.y, hn::Set(d, wall.centreY)),
          z = hn::Sub(at.z, hn::Set(d, wall.centreZ));
  const V along = hn::Add(hn::Add(hn::Mul(ax, x), hn::Mul(ay, y)), hn::Mul(az, z));
  const V a = hn::Sub(x, hn::Mul(along, ax)), b = hn::Sub(y, hn::Mul(along, ay)), c = hn::Sub(z, hn::Mul(along, az));
  const V out = hn::Sqrt(hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(c, c)));
  const V side = hn::Set(d, wall.side), unit = hn::Div(side, hn::Max(out, hn::Set(d, 1e-20f)));
  return {hn::Mul(unit, a), hn::Mul(unit, b), hn::Mul(unit, c), hn::Mul(side, hn::Sub(out, hn::Set(d, wall.radius)))};
}

}  // namespace HWY_NAMESPACE
}  // namespace ps
HWY_AFTER_NAMESPACE();
#endif
