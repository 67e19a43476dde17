// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

namespace ps::vr {

/// How finely the eyes' pictures are drawn, by steps: coarser where most frames of a second or more took longer than
/// they last, finer again where none did for some seconds and all could take twice as long. What is soft in them goes
/// first, then their pixels. So a heavy scene costs sharpness, never the head's motion.
class Detail {
 public:
  /// What a frame took of the processor's time or the graphics card's, whichever is longer, and how long it lasts; s.
  void note(double cost, double period);
  /// Pixels along a side, of those that the headset asks for.
  double scale() const { return kSteps[m_step].scale; }
  int coarser() const { return kSteps[m_step].coarser; }  ///< as RenderTarget has it

 private:
  struct Step {
    double scale;
    int coarser;
  };
  static constexpr Step kSteps[] = {{1, 0}, {1, 1}, {0.85, 1}, {0.7, 2}, {0.6, 2}, {0.5, 2}};
  size_t m_step = 0;
  int m_frames = 0, m_late = 0, m_quick = 0;
};

}  // namespace ps::vr
