// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/framing.h"
#include "ui/render/renderer.h"
#include "ui/vr/handinput.h"

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace ps {
struct StampForm;
}

namespace ps::vr {

/// What a dab of a brush fills about its middle, along the scene's axes.
struct BrushVolume {
  Vector3 half{0, 0, 0};                    ///< m
  bool box = false;                         ///< all of that, or the ball in it
  std::array<float, 3> colour{};            ///< sRGB
  std::shared_ptr<const StampForm> form{};  ///< what it fills of it; nullptr: the box or the ball
};

inline constexpr size_t kBoards = 3;  ///< the first bears what is asked for, the others what is set beside it
/// Panels of the interface: the later ones lie over the earlier ones.
enum PanelIndex : size_t { kPalette, kBoard, kPopup = kBoard + kBoards, kPanels };

struct PanelView {
  std::shared_ptr<const PanelImage> image;  ///< nullptr: it is not there
  double width = 0, height = 0;             ///< m
  size_t on = kBoard;                       ///< of a popup: that it came from
  double right = 0, down = 0;               ///< m, of a popup: of its middle from that of the other
  double header = 0;                        ///< share of its height, from its upper edge, by which a grip takes it
};

/// Where a hand points at a panel.
struct PanelPoint {
  size_t panel = kPalette;
  double x = 0, y = 0;  ///< 0..1 right and down from its upper left corner; beyond while it presses
  double depth = 0;     ///< m, from the panel to the tip, or along the beam
  bool tip = false;     ///< with the wand's tip; otherwise by its beam
  bool pressed = false;
};

/// What hands do at a time, where the scene stands by then.
struct HandsSeen {
  struct Hand {
    std::optional<Vector3> tip;  ///< m, in the scene; nothing while nobody knows where the hand is
    Vector3 up{0, 1, 0};         ///< a unit vector: the hand's own
    Vector3 forward{0, 0, -1};   ///< likewise, along which it points
    bool holds = false;          ///< its grip is pressed, and does not carry the scene, nor has since it was
    std::optional<PanelPoint> panel;
    HandInput input;  ///< in the room; a trigger that is a panel's business is not pulled
  };
  double seconds = 0;  ///< on the headset's clock
  std::array<Hand, 2> hands;
  bool carries = false;                                    ///< both grips carry the scene
  double scale = 1;                                        ///< m of the room for each of the scene
  std::array<bool, kBoards> boardAhead{true, true, true};  ///< a board is before the wearer's eyes, or put away
  HandRoles roles;                                         ///< as the view had them
};

/// What a hand feels for as long as it does.
struct Feeling {
  double strength = 0;    ///< 0..1
  double frequency = 80;  ///< Hz
};

/// What the editor shows at a time.
struct HeadsetView {
  SnapshotPtr matter;   ///< nullptr: nothing yet
  bool goesOn = false;  ///< from the matter before: what is seen moves from there
  RenderScene scene;
  Look look;
  uint64_t picture = 0;                ///< another one where any of those above may be another
  uint64_t project = 0;                ///< with another one the scene is set before its wearer anew
  std::array<BrushVolume, 2> brushes;  ///< at the tips of the hands
  std::array<uint64_t, 2> ticks{};     ///< of strokes that they have begun, and of what they point at: each is felt
  std::array<Feeling, 2> felt{};       ///< of what they lead, and of matter that they heat or cool
  std::array<bool, 2> keeps{};         ///< what they have in them: a body that they lead, or matter that they carry
  double vibration = 1;                ///< share of what can be felt that its wearer wants
  std::array<PanelView, kPanels> panels;
  std::array<PanelView, 2> labels;          ///< of what the hands hold, beside them
  std::array<uint64_t, kBoards> brought{};  ///< with another one a board is set before its wearer anew
  HandRoles roles;
  double raised = 0;              ///< m, by which the scene stands lower than before one who sits
  int64_t turns = 0;              ///< by 30 degrees that were asked for so far, to the right less those to the left
  std::array<float, 3> accent{};  ///< sRGB, of beams
  Box box;                        ///< m, around all that there is to see of the project when it came
};

/// Between the interface's thread and the headset's. What is handed over nobody changes any more; neither waits for
/// longer than it takes to copy a pointer or a few numbers.
class HeadsetLink {
 public:
  void show(std::shared_ptr<const HeadsetView> view) {
    const std::lock_guard lock(m_mutex);
    m_view.swap(view);  // the one before goes after the lock
  }
  std::shared_ptr<const HeadsetView> shown() const {
    const std::lock_guard lock(m_mutex);
    return m_view;
  }

  /// Hands, and what is in them, as the scene's own views show them to whoever looks on: copied once for each time that
  /// somebody wants them.
  void wantHands() { m_wantsHands = true; }
  bool handsWanted() const { return m_wantsHands; }
  void showHands(std::shared_ptr<const Props> hands) {
    m_wantsHands = false;
    const std::lock_guard lock(m_mutex);
    m_shownHands.swap(hands);
  }
  /// nullptr: none since they were taken last.
  std::shared_ptr<const Props> takeShownHands() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_shownHands, nullptr);
  }

  /// In the order in which they were told. Where nobody takes them for seconds, what happened meanwhile is left out.
  void tell(const HandsSeen& hands) {
    const std::lock_guard lock(m_mutex);
    if (m_hands.size() == kMost) m_hands.pop_back();
    m_hands.push_back(hands);
  }
  std::vector<HandsSeen> takeHands() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_hands, {});
  }

 private:
  static constexpr size_t kMost = 400;
  mutable std::mutex m_mutex;
  std::vector<HandsSeen> m_hands;
  std::shared_ptr<const HeadsetView> m_view;
  std::shared_ptr<const Props> m_shownHands;
  std::atomic<bool> m_wantsHands = false;
};

}  // namespace ps::vr
