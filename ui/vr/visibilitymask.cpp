// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/visibilitymask.h"

#include <vector>

namespace ps::vr {

VisibilityMask::VisibilityMask(const Runtime& runtime, XrSession session) : m_session(session) {
  if (!runtime.has(kExtension)) return;
  m_maskOf = runtime.function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR");
  for (uint32_t eye = 0; eye < m_hidden.size(); ++eye) fetch(eye);
}

/// Where more is amiss than the mask, the next call says so.
void VisibilityMask::fetch(uint32_t eye) {
  m_hidden[eye].reset();
  auto mask = structure<XrVisibilityMaskKHR>(XR_TYPE_VISIBILITY_MASK_KHR);
  const auto ask = [&] {
    return XR_SUCCEEDED(m_maskOf(m_session, XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, eye,
                                 XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask));
  };
  if (!ask() || mask.vertexCountOutput == 0 || mask.indexCountOutput == 0) return;
  std::vector<XrVector2f> corners(mask.vertexCapacityInput = mask.vertexCountOutput);
  std::vector<uint32_t> order(mask.indexCapacityInput = mask.indexCountOutput);
  mask.vertices = corners.data();
  mask.indices = order.data();
  if (!ask()) return;
  auto triangles = std::make_shared<HiddenTriangles>();
  for (const uint32_t index : order) {
    if (index >= corners.size()) return;  // that is no mask
    triangles->push_back({corners[index].x, corners[index].y});
  }
  m_hidden[eye] = std::move(triangles);
}

void VisibilityMask::notice(const XrEventDataBuffer& event) {
  if (!m_maskOf || event.type != XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR) return;
  const auto& change = reinterpret_cast<const XrEventDataVisibilityMaskChangedKHR&>(event);
  if (change.session == m_session && change.viewIndex < m_hidden.size()) fetch(change.viewIndex);
}

}  // namespace ps::vr
