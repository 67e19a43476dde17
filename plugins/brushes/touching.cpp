// SPDX-License-Identifier: Apache-2.0
#include "touching.h"

#include "vectors.h"

namespace ps::brushes {
namespace {

/// Of unit vectors: a hand that goes straight away from who looks has no blade.
constexpr double kAlongLook = 1e-3;

}  // namespace

void exchangeHeat(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, bool cools,
                  const HeatValues& values, api::TouchSink& sink) {
  touchAlong(context, samples, values.falloff, sink, [&](const api::StrokeSample& sample, api::Touch& touch) {
    touch.power = (cools ? -1 : 1) * values.power * sample.pressure;
    touch.limit = values.limit;
  });
}

void cutAlong(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, bool whole,
              api::TouchSink& sink) {
  for (size_t k = 0; k < samples.count; ++k) {
    const api::StrokeSample sample = samples.at(k);
    api::Touch touch;
    touch.kind = api::TouchKind::Cut;
    touch.centre = sample.position;
    touch.radius = context.radius;
    const api::Double3 across = cross(sample.direction, norm(context.look) > 0 ? context.look : context.up);
    if (!whole && !(norm(across) > kAlongLook)) continue;
    if (!whole) touch.normal = unit(across);
    sink.submit({&touch, 1, sizeof touch});
  }
}

void weldAlong(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, api::TouchSink& sink) {
  for (size_t k = 0; k < samples.count; ++k) {
    api::Touch touch;
    touch.kind = api::TouchKind::Weld;
    touch.centre = samples.at(k).position;
    touch.radius = context.radius;
    sink.submit({&touch, 1, sizeof touch});
  }
}

}  // namespace ps::brushes
