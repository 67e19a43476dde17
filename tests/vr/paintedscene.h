// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <epoxy/gl.h>

#include "ui/vr/headset.h"

#include <functional>
#include <string>
#include <vector>

namespace ps {

/// What a stay in the headset has seen and drawn. Written by the headset's thread until the stay has ended.
struct SceneRecord {
  struct Drawn {
    size_t eye;
    Eye view;
    PictureSize size;
  };
  std::vector<vr::HeadsetFrame> frames;
  std::vector<Drawn> drawn;
};

/// Paints each eye in a colour of its own with a block in its lower left corner, and notes what it is told.
class PaintedScene : public vr::HeadsetScene {
 public:
  /// before(frame's number from 0) is called first in each, and says what the hands shall feel.
  using Before = std::function<std::array<std::optional<vr::Vibration>, 2>(size_t)>;
  PaintedScene(SceneRecord& record, Before before) : m_record(record), m_before(std::move(before)) {}

  std::array<std::optional<vr::Vibration>, 2> prepare(const vr::HeadsetFrame& frame) override {
    m_record.frames.push_back(frame);
    return m_before(m_record.frames.size() - 1);
  }
  void draw(size_t eye, const Eye& view, const RenderTarget& target) override {
    m_record.drawn.push_back({eye, view, target.size});
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    fill(kGround[eye]);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, kBlockWidth, kBlockHeight);
    fill(kBlock);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  }

  using Colour = std::array<int, 3>;  ///< sRGB, 0..255
  static constexpr Colour kGround[2] = {{200, 30, 7}, {11, 60, 180}}, kBlock = {128, 255, 64};
  static constexpr int kBlockWidth = 5, kBlockHeight = 3;  ///< pixels

 private:
  static void fill(const Colour& colour) {
    glClearColor(float(colour[0]) / 255, float(colour[1]) / 255, float(colour[2]) / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT);
  }

  SceneRecord& m_record;
  Before m_before;
};

}  // namespace ps
