// SPDX-License-Identifier: Apache-2.0
#include "touching.h"

namespace ps::brushes {

void exchangeHeat(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, bool cools,
                  const HeatValues& values, api::TouchSink& sink) {
  touchAlong(context, samples, values.falloff, sink, [&](const api::StrokeSample& sample, api::Touch& touch) {
    touch.power = (cools ? -1 : 1) * values.power * sample.pressure;
    touch.limit = values.limit;
  });
}

}  // namespace ps::brushes
