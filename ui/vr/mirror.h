// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

namespace ps::vr {

/// An eye's picture for whoever looks on in a window: the headset's thread copies one where somebody wants it, the
/// window draws it. Both have contexts of their own, which share objects. Neither waits for the other, nor for what
/// the other has left to the graphics card: there are three pictures, of which one is free, and who comes while the
/// other is at it does without. On the whole a copied picture costs the headset one copy of the pixels that the window
/// shows.
class Mirror {
 public:
  Mirror();
  ~Mirror();
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;

  /// The headset's thread: copies of the lower left part of a texture (RGBA8, sRGB or not) that a picture fills what
  /// was in the window's proportions when it drew last, or all of it.
  void offer(uint32_t texture, const PictureSize& size);
  /// There too, at last: nothing comes any more.
  void close();

  /// The window's thread: the next picture shall be copied.
  void want() { m_wanted = true; }
  /// There too: draws the newest picture that is done over all of a framebuffer, in its proportions, cut where it is
  /// too wide or too high. False where it was drawn last, or there is none: nothing is changed then. `again`: also
  /// where it was.
  bool draw(uint32_t framebuffer, const PictureSize& size, bool again);
  uint64_t drawn() const { return m_drawn; }  ///< the number of that one, from 1; 0: none

 private:
  struct Slot;
  struct Slots;
  Slot* freeSlot();
  Slot* newestDone();

  std::mutex m_mutex;  ///< over all but what is atomic
  std::unique_ptr<Slots> m_slots;
  PictureSize m_window{0, 0};  ///< that was drawn to last
  std::atomic<bool> m_wanted = false;
  std::atomic<uint64_t> m_drawn = 0;
  uint64_t m_number = 0;
  bool m_closed = false;
};

}  // namespace ps::vr
