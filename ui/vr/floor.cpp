// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/floor.h"

#include <algorithm>

namespace ps::vr {
namespace {

// XR_EXT_local_floor is younger than Debian 12's headers.
constexpr auto kLocalFloor = static_cast<XrReferenceSpaceType>(1000426000);
constexpr float kEyeHeight = 1.6f;  // m above a floor of which the headset knows nothing

}  // namespace

Floor::Floor(const Runtime& runtime, XrSession session) {
  const auto offered = listed<XrReferenceSpaceType>(
      "xrEnumerateReferenceSpaces", [&](auto... room) { return xrEnumerateReferenceSpaces(session, room...); });
  const auto has = [&](XrReferenceSpaceType type) {
    return std::find(offered.begin(), offered.end(), type) != offered.end();
  };
  auto info = structure<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
  info.poseInReferenceSpace.orientation.w = 1;
  if (runtime.has(kExtension) && has(kLocalFloor))
    m_type = kLocalFloor;
  else if (has(XR_REFERENCE_SPACE_TYPE_STAGE))
    m_type = XR_REFERENCE_SPACE_TYPE_STAGE;
  else
    info.poseInReferenceSpace.position.y = -kEyeHeight;
  info.referenceSpaceType = m_type;
  check(xrCreateReferenceSpace(session, &info, &m_space), "xrCreateReferenceSpace");
}

}  // namespace ps::vr
