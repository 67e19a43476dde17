// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include "ui/render/renderer.h"

#include <array>
#include <utility>

namespace ps {

/// A picture with storage of its own, as a headset's runtime has it, or a window; of the context that is current.
struct Plate {
  Plate(GLenum format, int width, int height) : size{width, height} {
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  }
  ~Plate() {
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
  }
  Plate(const Plate&) = delete;
  Plate& operator=(const Plate&) = delete;

  /// One colour of the left half, another one of the right.
  void fill(const std::array<int, 3>& left, const std::array<int, 3>& right) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glEnable(GL_SCISSOR_TEST);
    for (const auto& [colour, x] : {std::pair{left, 0}, {right, size.width / 2}}) {
      glScissor(x, 0, size.width / 2, size.height);
      glClearColor(float(colour[0]) / 255, float(colour[1]) / 255, float(colour[2]) / 255, 1);
      glClear(GL_COLOR_BUFFER_BIT);
    }
    glDisable(GL_SCISSOR_TEST);
  }
  std::array<int, 3> at(int x, int y) const {
    std::array<uint8_t, 4> pixel{};
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    return {pixel[0], pixel[1], pixel[2]};
  }
  GLuint texture = 0, framebuffer = 0;
  PictureSize size;
};

}  // namespace ps
