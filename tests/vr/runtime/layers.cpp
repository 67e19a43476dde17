// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/layers.h"

#include "tests/vr/runtime/limits.h"
#include "tests/vr/runtime/names.h"

#include <cmath>

namespace ps::scripted {
namespace {

using nlohmann::json;

const Swapchain& check(Session& session, const XrSwapchainSubImage& image) {
  const Swapchain& swapchain = session.swapchains.at(image.swapchain);
  require(swapchain.released.has_value(), XR_ERROR_LAYER_INVALID, "a layer shows a swapchain without a released image");
  const XrRect2Di& rect = image.imageRect;
  require(rect.extent.width > 0 && rect.extent.height > 0 && rect.offset.x >= 0 && rect.offset.y >= 0 &&
              int64_t{rect.offset.x} + rect.extent.width <= int64_t{swapchain.info.width} &&
              int64_t{rect.offset.y} + rect.extent.height <= int64_t{swapchain.info.height},
          XR_ERROR_SWAPCHAIN_RECT_INVALID, "a layer's rectangle is empty or reaches out of the image");
  require(image.imageArrayIndex < swapchain.info.arraySize, XR_ERROR_VALIDATION_FAILURE,
          "a layer's slice is none of its swapchain");
  return swapchain;
}

void check(const XrPosef& pose) {
  require(isUnit(pose.orientation), XR_ERROR_POSE_INVALID, "a layer's quaternion has not the length 1");
}

json describe(const XrPosef& pose) {
  const auto& [x, y, z] = pose.position;
  const auto& q = pose.orientation;
  return json::array({x, y, z, q.x, q.y, q.z, q.w});
}

json describe(const XrSwapchainSubImage& image, const Swapchain& swapchain) {
  const XrRect2Di& rect = image.imageRect;
  return {{"image", *swapchain.released},
          {"slice", image.imageArrayIndex},
          {"rect", {rect.offset.x, rect.offset.y, rect.extent.width, rect.extent.height}}};
}

bool isDepth(int64_t format) { return format == GL_DEPTH_COMPONENT24 || format == GL_DEPTH_COMPONENT32F; }

json readDepth(Instance& instance, const XrCompositionLayerDepthInfoKHR& depth) {
  require(has(instance, XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME), XR_ERROR_VALIDATION_FAILURE,
          "a layer has a depth, and XR_KHR_composition_layer_depth was not enabled");
  const Swapchain& swapchain = check(*instance.session, depth.subImage);
  require(isDepth(swapchain.info.format), XR_ERROR_VALIDATION_FAILURE, "a layer's depth is a picture of colours");
  require(depth.minDepth >= 0 && depth.maxDepth <= 1 && depth.minDepth < depth.maxDepth && depth.nearZ >= 0 &&
              depth.farZ >= 0 && depth.nearZ != depth.farZ,
          XR_ERROR_VALIDATION_FAILURE, "a layer's range of depths is none");
  json text = describe(depth.subImage, swapchain);
  text["near"] = depth.nearZ;
  text["far"] = std::isfinite(depth.farZ) ? json(depth.farZ) : json("infinite");
  return text;
}

json readView(Instance& instance, const XrCompositionLayerProjectionView& view) {
  typed(&view, XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
  const Swapchain& swapchain = check(*instance.session, view.subImage);
  require(!isDepth(swapchain.info.format), XR_ERROR_LAYER_INVALID, "a layer shows a picture of depths");
  check(view.pose);
  json text = describe(view.subImage, swapchain);
  text["pose"] = describe(view.pose);
  text["fov"] = {view.fov.angleLeft, view.fov.angleRight, view.fov.angleUp, view.fov.angleDown};
  const auto* depth = chained<XrCompositionLayerDepthInfoKHR>(view.next, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
  if (depth) text["depth"] = readDepth(instance, *depth);
  return text;
}

json readProjection(Instance& instance, const XrCompositionLayerProjection& layer) {
  instance.session->spaces.at(layer.space);
  require(layer.viewCount == kEyes && layer.views, XR_ERROR_VALIDATION_FAILURE, "a projection layer has two views");
  json views = json::array();
  for (uint32_t i = 0; i < layer.viewCount; ++i) views.push_back(readView(instance, layer.views[i]));
  return {{"type", "projection"}, {"views", views}};
}

json readQuad(Instance& instance, const XrCompositionLayerQuad& layer) {
  instance.session->spaces.at(layer.space);
  check(layer.pose);
  json text = describe(layer.subImage, check(*instance.session, layer.subImage));
  text["type"] = "quad";
  text["pose"] = describe(layer.pose);
  text["size"] = {layer.size.width, layer.size.height};
  return text;
}

}  // namespace

json readLayers(Instance& instance, const XrFrameEndInfo& info) {
  json layers = json::array();
  require(info.layerCount == 0 || info.layers, XR_ERROR_LAYER_INVALID, "the list of layers is missing");
  for (uint32_t i = 0; i < info.layerCount; ++i) {
    const XrCompositionLayerBaseHeader* layer = info.layers[i];
    require(layer != nullptr, XR_ERROR_LAYER_INVALID, "a layer is missing");
    if (layer->type == XR_TYPE_COMPOSITION_LAYER_PROJECTION) {
      layers.push_back(readProjection(instance, *reinterpret_cast<const XrCompositionLayerProjection*>(layer)));
    } else if (layer->type == XR_TYPE_COMPOSITION_LAYER_QUAD) {
      layers.push_back(readQuad(instance, *reinterpret_cast<const XrCompositionLayerQuad*>(layer)));
    } else {
      throw Refusal(XR_ERROR_LAYER_INVALID, "this runtime has no layers of the type " + nameOf(layer->type));
    }
  }
  return layers;
}

}  // namespace ps::scripted
