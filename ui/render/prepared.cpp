// SPDX-License-Identifier: Apache-2.0
#include "ui/render/prepared.h"

#include "ui/render/colourmap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>
#include <utility>

namespace ps::render {
namespace {

void join(Extent& into, const Extent& other) {
  for (size_t k = 0; k < 3; ++k) {
    into.minimum[k] = std::min(into.minimum[k], other.minimum[k]);
    into.maximum[k] = std::max(into.maximum[k], other.maximum[k]);
  }
}

}  // namespace

const Vector3 kKeyLight = Vector3(-0.34, 0.86, 0.40).normalized();

FrameUniforms::Matrix uniformOf(const Matrix4& a) {
  FrameUniforms::Matrix out;
  std::transform(a.data(), a.data() + 16, out.begin(), [](double v) { return static_cast<float>(v); });
  return out;
}

void Prepared::fill(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene,
                    const Look& how) {
  look = how;
  if (!ShownField(now, look.colour)) look.colour = kMatterColour;
  data = look.colour != kMatterColour;
  time = static_cast<float>(std::fmod(now.stats.time, 3600));  // so that a float stays precise in long runs
  furnish(scene.environment);
  guides.clear();
  for (const GuideLine& line : look.guides) addEdge(guides, line.from, line.to, line.opacity);
  collect(now, previous, blend);
  placeContactMap();
  fitShadow();
  ready = true;
}

void Prepared::show(const Props& what) {
  props = what;
  propsExtent = extentOf(props.opaque);
}

void Prepared::takeProps(Prepared& other) {
  std::swap(props, other.props);
  std::swap(propsExtent, other.propsExtent);
}

void Prepared::furnish(const Environment& environment) {
  const bool sameLook = m_dark == look.dark && m_section == look.section;
  if (m_furnished && sameLook && sameFurniture(*m_furnished, environment)) return;
  furniture = buildFurniture(environment, look.dark, look.section);
  static std::atomic<uint64_t> last = 0;
  furnitureRevision = ++last;
  m_furnished = environment;
  m_dark = look.dark;
  m_section = look.section;
}

void Prepared::collect(const Snapshot& now, const Snapshot* previous, double blend) {
  InstanceRequest request;
  request.now = &now;
  request.previous = previous;
  request.blend = static_cast<float>(blend);
  request.colour = look.colour;
  request.meltingPoint = look.meltingPoint;
  request.minimum = look.rangeMinimum;
  request.maximum = look.rangeMaximum;
  if (look.rangeMinimum == look.rangeMaximum)
    std::tie(request.minimum, request.maximum) = colourRange(now, look.colour);
  const ShownField shown(now, look.colour);
  request.surfaces = !shown || !shown.field().inner;
  request.steam = look.vapour.value_or(sceneColour(look.dark, "steam"));
  for (const uint32_t body : look.outline ? look.outline->bodies : std::vector<uint32_t>{}) {
    request.outlined.resize(std::max<size_t>(request.outlined.size(), body + size_t{1}));
    request.outlined[body] = 1;
  }
  if (look.ghost) request.ghost = look.ghost->matter.get();
  request.section = look.section;
  collectInstances(request, instances);
}

void Prepared::placeContactMap() {
  for (size_t k = 0; k < 2; ++k) {
    const float half = std::max(furniture.half[k], 1e-4f) * 1.1f;
    contact.corner[k] = furniture.centre[k] - half;
    contact.size[k] = 2 * half;
  }
  contact.floor = furniture.floor;
  fillContactMap(instances, contact);
}

/// Fits the shadow picture around what casts, from the light's side, and reaches down to the ground.
void Prepared::fitShadow() {
  Extent casters = instances.sphereExtent;
  if (instances.dense) join(casters, instances.liquidExtent);
  if (casters.empty()) casters.add(0, 0, 0, 1);
  casters.minimum[1] = std::min(casters.minimum[1], furniture.ground);
  const Vector3 right = Vector3::UnitY().cross(kKeyLight).normalized();
  Matrix3 axes;
  axes << right.transpose(), kKeyLight.cross(right).transpose(), -kKeyLight.transpose();
  Vector3 low = Vector3::Constant(1e30), high = -low;
  for (const Vector3& p : casters.corners()) {
    const Vector3 along = axes * p;
    low = low.cwiseMin(along), high = high.cwiseMax(along);
  }
  const Vector3 scale = 2 * (high - low).cwiseMax(1e-6).cwiseInverse();
  Matrix4 clip = Matrix4::Identity(), half = 0.5 * Matrix4::Identity();
  clip.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  clip.topRightCorner<3, 1>() = -scale.cwiseProduct(high + low) / 2;
  half.col(3) << 0.5, 0.5, 0.5, 1;
  shadowScale = {static_cast<float>(scale.x()), static_cast<float>(scale.y())};
  toLight = uniformOf(clip);
  shadow = uniformOf(half * clip);
}

}  // namespace ps::render
