// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/period.h"

#include <phasesketch/brush.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace ps {

struct StrokeSetup;

/// Matter as a brush gets to see it: lists of one length, see api::NearMatter.
struct SeenMatter {
  std::vector<api::Float4> position;
  std::vector<float> temperature, speed;
  std::vector<api::Phase> phase;
  std::vector<api::Motion> motion;
  std::vector<uint32_t> body, material;
  api::NearMatter view() const;
};

/// What lies within a radius (m) of a place of the scene. Asked by the thread that asks the brush.
using MatterWithin = std::function<SeenMatter(const Vector3& centre, double radius)>;

/// A place of the scene, m, or where space repeats itself the image of it that is nearest to a centre.
Vector3 imageNear(const Period& period, const Vector3& place, const Vector3& centre);

/// m, the farthest that a brush may see.
inline constexpr double kFarthestSeen = 10;

/// What a brush sees from places of the hand, as the setup's lattice lies. nullopt: it goes by no matter, or nobody
/// knows the scene. Throws BrushFault for a reach that it may not have.
std::optional<SeenMatter> seenBy(const api::BrushPlugin& brush, const StrokeSetup& setup,
                                 const api::StrokeContext& context, std::span<const api::StrokeSample> samples);

}  // namespace ps
