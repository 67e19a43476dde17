// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/vr/ending.h"
#include "ui/vr/handinput.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

namespace ps::vr {

class Mirror;

/// A frame as it is about to be drawn.
struct HeadsetFrame {
  double time = 0;                 ///< s, when it will be shown, on a clock that only goes on
  double period = 0;               ///< s, between frames
  HandPose head;                   ///< between the eyes; -z points where they look
  std::array<HandInput, 2> hands;  ///< left and right, as they will be then
  bool focused = false;            ///< hands act; otherwise a menu of the headset lies over the picture
  /// The wearer has asked the headset to take where they are for its middle: from now on the room may be another one.
  /// In this frame no hand is seen, and none pulls or grips before it has let go.
  bool recentred = false;
};

/// What is seen in the headset, on its thread and with its OpenGL context current, from the first call to the last.
class HeadsetScene {
 public:
  virtual ~HeadsetScene() = default;
  /// Once a frame, before its eyes are drawn; says what either hand shall feel.
  virtual std::array<std::optional<Vibration>, 2> prepare(const HeadsetFrame& frame) = 0;
  virtual void draw(size_t eye, const Eye& view, const RenderTarget& target) = 0;
  /// Whether it knows how far what it draws is.
  virtual bool hasDepth() const { return false; }
  /// Of the eye that was drawn last, into the depth of a target: 0 at the near plane, 1 at the far one.
  virtual void drawDepth(size_t, const Eye&, const RenderTarget&) {}
};

/// What a frame took, s.
struct FrameCost {
  double processor = 0;  ///< from when the runtime let it begin to when it had it, without waits for pictures
  double whole = 0;      ///< the same with them
  double card = 0;       ///< of the newest frame that the graphics card has told of
};

struct HeadsetSetup {
  /// Of an OpenGL context that the headset's thread has for itself, and that shares with the others' what it shows.
  std::function<void()> makeCurrent, release;
  std::function<std::unique_ptr<HeadsetScene>()> makeScene;
  std::shared_ptr<Mirror> mirror;                            ///< gets the left eye's pictures; nullptr: nobody looks on
  double nearPlane = 0.03, farPlane = 100;                   ///< m
  std::function<void(const FrameCost&)> measured = nullptr;  ///< is told of each frame that shows something, there
};

/// A stay in the headset, from when it is made. The frames have a thread of their own, which the runtime's
/// xrWaitFrame() paces: that waits for as long as the headset likes, and nobody else must. The thread owns everything
/// of OpenXR, so that nothing of it needs a lock; others ask for the ending, and to leave. Whatever fails, in OpenXR,
/// in OpenGL or in the scene, ends the stay with a sentence, and a new one can be made. So does a runtime that keeps
/// the thread for good: that is left to itself then, with all that it needs (what the setup's functions have is
/// theirs), and puts it away where it ever comes back.
class Headset {
 public:
  explicit Headset(HeadsetSetup setup);
  ~Headset();  ///< leaves, and waits until it has, for seconds at most where the runtime does not answer
  Headset(const Headset&) = delete;
  Headset& operator=(const Headset&) = delete;

  void leave();
  /// Nothing while it lasts.
  std::optional<Ending> ending() const;
  bool answers() const;     ///< false: the runtime has kept the thread for seconds
  uint64_t frames() const;  ///< that were submitted
  /// Pixels along a side of the eyes' pictures, of those that the headset asks for: fewer while frames come late.
  double detail() const;
  int coarser() const;  ///< steps by which what is soft in them is, likewise; as RenderTarget has it
  /// Pictures a second that it shows; 0: it does not say.
  double hertz() const;
  enum class Worn { Off, BehindMenu, On };
  /// Off: it shows nothing, and lies on the table perhaps. BehindMenu: one of its own lies over the picture.
  Worn worn() const;
  bool sees(size_t hand) const;  ///< where a hand is

 private:
  struct Stay;
  class Loop;
  std::shared_ptr<Stay> m_stay;
  std::thread m_thread;
};

}  // namespace ps::vr
