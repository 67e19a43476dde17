// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/closing.h"
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/limits.h"

#include <algorithm>

namespace ps::scripted {
namespace {

void check(const Instance& instance, const XrSwapchainCreateInfo& info) {
  const auto& formats = instance.script.formats;
  require(std::find(formats.begin(), formats.end(), info.format) != formats.end(),
          XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "that format was not among those that were listed");
  require(info.width > 0 && info.height > 0 && info.width <= kMaximumPixels && info.height <= kMaximumPixels,
          XR_ERROR_VALIDATION_FAILURE, "a swapchain's sides are 1 to 4096 pixels");
  require(info.sampleCount == 1 && info.mipCount >= 1 && info.arraySize >= 1, XR_ERROR_VALIDATION_FAILURE,
          "a swapchain has one sample, and at least one level and one slice");
  require(info.faceCount == 1, XR_ERROR_FEATURE_UNSUPPORTED, "this runtime has no cubes");
  require((info.createFlags & XR_SWAPCHAIN_CREATE_PROTECTED_CONTENT_BIT) == 0, XR_ERROR_FEATURE_UNSUPPORTED,
          "this runtime has no protected pictures");
}

void makeTextures(Instance& instance, Swapchain& swapchain) {
  const XrSwapchainCreateInfo& info = swapchain.info;
  const bool array = info.arraySize > 1;
  const GLenum target = array ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  const bool once = (info.createFlags & XR_SWAPCHAIN_CREATE_STATIC_IMAGE_BIT) != 0;
  const auto format = static_cast<GLenum>(info.format);
  const auto width = static_cast<GLsizei>(info.width), height = static_cast<GLsizei>(info.height);
  const auto levels = static_cast<GLsizei>(info.mipCount);
  GLint bound = 0;
  glGetIntegerv(array ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D, &bound);
  swapchain.textures.resize(once ? 1 : kImages);
  glGenTextures(static_cast<GLsizei>(swapchain.textures.size()), swapchain.textures.data());
  for (const GLuint texture : swapchain.textures) {
    glBindTexture(target, texture);
    if (array) {
      glTexStorage3D(target, levels, format, width, height, static_cast<GLsizei>(info.arraySize));
    } else {
      glTexStorage2D(target, levels, format, width, height);
    }
  }
  glBindTexture(target, static_cast<GLuint>(bound));
  instance.texturesAlive += swapchain.textures.size();
}

Swapchain& open(Instance& instance, XrSwapchain handle) { return openSession(instance).swapchains.at(handle); }

}  // namespace

void deleteTextures(Instance& instance, Swapchain& swapchain) {
  glDeleteTextures(static_cast<GLsizei>(swapchain.textures.size()), swapchain.textures.data());
  instance.texturesAlive -= swapchain.textures.size();
  swapchain.textures.clear();
}

XrResult enumerateSwapchainFormats(Instance& instance, XrSession handle, uint32_t capacity, uint32_t* count,
                                   int64_t* formats) {
  sessionOf(instance, handle);
  return enumerate(instance.script.formats, capacity, count, formats);
}

XrResult createSwapchain(Instance& instance, XrSession handle, const XrSwapchainCreateInfo* info, XrSwapchain* made) {
  Session& session = sessionOf(instance, handle);
  check(instance, typed(info, XR_TYPE_SWAPCHAIN_CREATE_INFO));
  wanted(made);
  const CurrentContext current(session.graphics);
  Swapchain swapchain;
  swapchain.info = *info;
  swapchain.info.next = nullptr;
  makeTextures(instance, swapchain);
  *made = session.swapchains.add(std::move(swapchain));
  instance.log.write({{"swapchain", "created"},
                      {"format", info->format},
                      {"width", info->width},
                      {"height", info->height},
                      {"slices", info->arraySize}});
  return XR_SUCCESS;
}

XrResult destroySwapchain(Instance& instance, XrSwapchain handle) {
  Swapchain& swapchain = open(instance, handle);
  {
    const CurrentContext current(instance.session->graphics);
    deleteTextures(instance, swapchain);
  }
  instance.session->swapchains.erase(handle);
  instance.log.write({{"swapchain", "destroyed"}});
  return XR_SUCCESS;
}

XrResult enumerateSwapchainImages(Instance& instance, XrSwapchain handle, uint32_t capacity, uint32_t* count,
                                  XrSwapchainImageBaseHeader* images) {
  const Swapchain& swapchain = open(instance, handle);
  auto* list = reinterpret_cast<XrSwapchainImageOpenGLKHR*>(images);
  return enumerate(swapchain.textures.size(), capacity, count, list, [&](size_t i, XrSwapchainImageOpenGLKHR& image) {
    typed(&image, XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR).image = swapchain.textures[i];
  });
}

XrResult acquireSwapchainImage(Instance& instance, XrSwapchain handle, const XrSwapchainImageAcquireInfo* info,
                               uint32_t* index) {
  if (info) typed(info, XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO);
  Swapchain& swapchain = open(instance, handle);
  const auto images = static_cast<uint32_t>(swapchain.textures.size());
  require(swapchain.acquired.size() < images, XR_ERROR_CALL_ORDER_INVALID, "all images are acquired already");
  require(images > 1 || !swapchain.released, XR_ERROR_CALL_ORDER_INVALID, "a static image is acquired once");
  wanted(index) = swapchain.next;
  swapchain.acquired.push_back(swapchain.next);
  swapchain.next = (swapchain.next + 1) % images;
  return XR_SUCCESS;
}

XrResult waitSwapchainImage(Instance& instance, XrSwapchain handle, const XrSwapchainImageWaitInfo* info) {
  typed(info, XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  Swapchain& swapchain = open(instance, handle);
  require(!swapchain.acquired.empty(), XR_ERROR_CALL_ORDER_INVALID, "no image is acquired that could be waited for");
  require(!swapchain.waited, XR_ERROR_CALL_ORDER_INVALID, "the image was waited for already, and is not released");
  swapchain.waited = true;
  return XR_SUCCESS;
}

XrResult releaseSwapchainImage(Instance& instance, XrSwapchain handle, const XrSwapchainImageReleaseInfo* info) {
  if (info) typed(info, XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO);
  Swapchain& swapchain = open(instance, handle);
  require(!swapchain.acquired.empty(), XR_ERROR_CALL_ORDER_INVALID, "no image is acquired that could be released");
  require(swapchain.waited, XR_ERROR_CALL_ORDER_INVALID, "the image is released before it was waited for");
  swapchain.released = swapchain.acquired.front();
  swapchain.acquired.pop_front();
  swapchain.waited = false;
  return XR_SUCCESS;
}

}  // namespace ps::scripted
