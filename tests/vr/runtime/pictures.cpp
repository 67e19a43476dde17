// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/layers.h"
#include "tests/vr/runtime/limits.h"

#include <QImage>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ps::scripted {
namespace {

/// Reads a texture through a framebuffer of its own, and leaves the client's state as it was.
class TextureReader {
 public:
  TextureReader(GLuint texture, const XrSwapchainSubImage& image, bool array) {
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &m_framebuffer);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &m_buffer);
    for (size_t i = 0; i < std::size(kPacking); ++i) glGetIntegerv(kPacking[i], &m_packing[i]);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (const GLenum name : kPacking) glPixelStorei(name, name == GL_PACK_ALIGNMENT ? 1 : 0);
    glGenFramebuffers(1, &m_own);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_own);
    if (array) {
      glFramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0,
                                static_cast<GLint>(image.imageArrayIndex));
    } else {
      glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    }
    glReadBuffer(GL_COLOR_ATTACHMENT0);
  }
  ~TextureReader() {
    for (size_t i = 0; i < std::size(kPacking); ++i) glPixelStorei(kPacking[i], m_packing[i]);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(m_buffer));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(m_framebuffer));
    glDeleteFramebuffers(1, &m_own);
  }
  TextureReader(const TextureReader&) = delete;
  TextureReader& operator=(const TextureReader&) = delete;

  void read(const XrRect2Di& rect, GLenum type, void* pixels) const {
    glReadPixels(rect.offset.x, rect.offset.y, rect.extent.width, rect.extent.height, GL_RGBA, type, pixels);
  }

 private:
  static constexpr GLenum kPacking[] = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS};
  GLint m_framebuffer = 0, m_buffer = 0, m_packing[std::size(kPacking)]{};
  GLuint m_own = 0;
};

/// The same of depths.
class DepthReader {
 public:
  explicit DepthReader(GLuint texture) {
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &m_framebuffer);
    glGenFramebuffers(1, &m_own);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_own);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
    glReadBuffer(GL_NONE);
  }
  ~DepthReader() {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(m_framebuffer));
    glDeleteFramebuffers(1, &m_own);
  }
  DepthReader(const DepthReader&) = delete;
  DepthReader& operator=(const DepthReader&) = delete;

 private:
  GLint m_framebuffer = 0;
  GLuint m_own = 0;
};

// IEC 61966-2-1.
uint8_t encoded(float linear) {
  const float bounded = std::clamp(linear, 0.0f, 1.0f);
  const float value = bounded <= 0.0031308f ? 12.92f * bounded : 1.055f * std::pow(bounded, 1 / 2.4f) - 0.055f;
  return static_cast<uint8_t>(std::lround(255 * value));
}

QImage pictureOf(const Swapchain& swapchain, const XrSwapchainSubImage& image) {
  const XrRect2Di& rect = image.imageRect;
  const TextureReader reader(swapchain.textures[*swapchain.released], image, swapchain.info.arraySize > 1);
  QImage picture(rect.extent.width, rect.extent.height, QImage::Format_RGBA8888);
  if (swapchain.info.format == GL_SRGB8_ALPHA8) {
    reader.read(rect, GL_UNSIGNED_BYTE, picture.bits());
  } else {
    std::vector<float> linear(size_t(4) * size_t(rect.extent.width) * size_t(rect.extent.height));
    reader.read(rect, GL_FLOAT, linear.data());
    std::transform(linear.begin(), linear.end(), picture.bits(), encoded);
  }
  return picture.mirrored(false, true).convertToFormat(QImage::Format_RGB888);  // OpenGL's first row is the lowest
}

/// 0 nearest, 65535 farthest.
QImage depthsOf(const Swapchain& swapchain, const XrRect2Di& rect) {
  const DepthReader reader(swapchain.textures[*swapchain.released]);
  std::vector<float> depths(size_t(rect.extent.width) * size_t(rect.extent.height));
  glReadPixels(rect.offset.x, rect.offset.y, rect.extent.width, rect.extent.height, GL_DEPTH_COMPONENT, GL_FLOAT,
               depths.data());
  QImage picture(rect.extent.width, rect.extent.height, QImage::Format_Grayscale16);
  for (int y = 0; y < picture.height(); ++y) {
    auto* line = reinterpret_cast<uint16_t*>(picture.scanLine(picture.height() - 1 - y));
    for (int x = 0; x < picture.width(); ++x)
      line[x] = static_cast<uint16_t>(std::lround(65535 * depths[size_t(y) * size_t(picture.width()) + size_t(x)]));
  }
  return picture;
}

}  // namespace

void takePictures(Instance& instance, const XrFrameEndInfo& info, int64_t frame) {
  const char* folder = std::getenv("PS_XR_PICTURES");
  if (!folder) return;
  const CurrentContext current(instance.session->graphics);
  for (uint32_t i = 0; i < info.layerCount; ++i) {
    if (info.layers[i]->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION) continue;
    const auto& layer = *reinterpret_cast<const XrCompositionLayerProjection*>(info.layers[i]);
    for (size_t eye = 0; eye < kEyes; ++eye) {
      const XrSwapchainSubImage& image = layer.views[eye].subImage;
      const std::string name =
          std::string(folder) + "/frame" + std::to_string(frame) + (eye == 0 ? "-left.png" : "-right.png");
      const bool saved =
          pictureOf(instance.session->swapchains.at(image.swapchain), image).save(QString::fromStdString(name), "PNG");
      const auto* depth =
          chained<XrCompositionLayerDepthInfoKHR>(layer.views[eye].next, XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
      if (depth)
        depthsOf(instance.session->swapchains.at(depth->subImage.swapchain), depth->subImage.imageRect)
            .save(QString::fromStdString(name.substr(0, name.size() - 4) + "-depth.png"), "PNG");
      instance.log.write({{"picture", name}, {"saved", saved}, {"frame", frame}});
    }
    return;
  }
}

}  // namespace ps::scripted
