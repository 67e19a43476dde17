// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/nearmatter.h"

#include "core/sketch/stroke.h"

#include <algorithm>
#include <string>

namespace ps {
namespace {

/// Calls something with each list.
template <class Work>
void forLists(SeenMatter& matter, Work&& work) {
  work(matter.position), work(matter.temperature), work(matter.speed), work(matter.phase);
  work(matter.motion), work(matter.body), work(matter.material);
}

template <class Wanted>
void keepIf(SeenMatter& matter, Wanted&& wanted) {
  size_t kept = 0;
  for (size_t i = 0; i < matter.position.size(); ++i) {
    if (!wanted(vectorOf(matter.position[i]))) continue;
    forLists(matter, [&](auto& values) { values[kept] = values[i]; });
    ++kept;
  }
  forLists(matter, [&](auto& values) { values.resize(kept); });
}

}  // namespace

api::NearMatter SeenMatter::view() const {
  return {position.size(), position.data(), temperature.data(), speed.data(),
          phase.data(),    motion.data(),   body.data(),        material.data()};
}

Vector3 imageNear(const Period& period, const Vector3& place, const Vector3& centre) {
  if (!period.any()) return place;
  api::Float4 away = float4Of(place - centre, 0);
  period.shorten(away.x, away.y, away.z);
  return centre + vectorOf(away);
}

std::optional<SeenMatter> seenBy(const api::BrushPlugin& brush, const StrokeSetup& setup,
                                 const api::StrokeContext& context, std::span<const api::StrokeSample> samples) {
  const auto* seeing = static_cast<const api::SeeingBrush*>(brush.extension(api::kSeesMatter));
  if (!seeing || !setup.matterWithin || samples.empty()) return std::nullopt;
  const double reach = seeing->reach(context);
  if (!(reach >= 0 && reach <= kFarthestSeen))
    throw BrushFault("it asks to see matter within what is no distance of 0 to " +
                     std::to_string(static_cast<int>(kFarthestSeen)) + " m");
  Vector3 low = vectorOf(samples.front().position), high = low;
  for (const api::StrokeSample& sample : samples) {
    low = low.cwiseMin(vectorOf(sample.position));
    high = high.cwiseMax(vectorOf(sample.position));
  }
  const RigidMove& pose = setup.grid.pose;
  const Vector3 middle = (low + high) / 2;
  SeenMatter seen =
      setup.matterWithin(pose.isNothing() ? middle : Vector3(pose.of(middle)), reach + (high - low).norm() / 2);
  if (!pose.isNothing()) {
    const RigidMove back = pose.inverse();
    for (api::Float4& place : seen.position) place = float4Of(back.of(vectorOf(place)), place.w);
  }
  keepIf(seen, [&](const Vector3& place) {
    return std::any_of(samples.begin(), samples.end(), [&](const api::StrokeSample& sample) {
      return (place - vectorOf(sample.position)).squaredNorm() <= reach * reach;
    });
  });
  return seen;
}

}  // namespace ps
