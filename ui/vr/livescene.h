// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/headset.h"
#include "ui/vr/headsetlink.h"
#include "ui/vr/moving.h"
#include "ui/vr/panels.h"
#include "ui/vr/preparing.h"

#include <vector>

namespace ps::vr {

/// The editor's scene, as a table before whoever wears the headset. Matter moves from each picture of it to the next in
/// the time that lay between their comings, on the headset's clock: its frames go on while the solver works, and while
/// a picture of the matter is prepared, for the next frame.
class LiveScene : public HeadsetScene {
 public:
  /// With the headset's context current. Throws Error.
  explicit LiveScene(std::shared_ptr<HeadsetLink> link) : m_link(std::move(link)) {}

  std::array<std::optional<Vibration>, 2> prepare(const HeadsetFrame& frame) override;
  void draw(size_t eye, const Eye& view, const RenderTarget& target) override;
  /// m along where a hand would point from a place in the room, to the first panel of the last frame.
  std::optional<double> panelAhead(const HandPose& aim) const { return m_panels.ahead(aim); }
  bool carriesPanel(size_t hand) const { return m_panels.carries(hand); }
  bool hasDepth() const override { return true; }
  void drawDepth(size_t eye, const Eye& view, const RenderTarget& target) override;
  /// As Renderer::timePasses().
  void timePasses(std::vector<PassTime>* times) { m_renderer.timePasses(times); }

 private:
  void take(std::shared_ptr<const HeadsetView> view, const HeadsetFrame& frame);
  void prepareMatter(const HeadsetFrame& frame);
  double share(double seconds) const;
  void tellHands(const HeadsetFrame& frame);
  void showHands(const HeadsetFrame& frame);
  void showHand(size_t hand, const HandInput& input, const std::array<float, 3>& colour);
  std::array<std::optional<Vibration>, 2> feel();

  std::shared_ptr<HeadsetLink> m_link;
  Renderer m_renderer;
  std::shared_ptr<const HeadsetView> m_view = std::make_shared<HeadsetView>();
  SnapshotPtr m_before;
  double m_came = 0, m_lasts = 0;  ///< s: when the matter did, and how long it takes to get there from that before
  Moving m_moving;
  std::array<uint64_t, 2> m_felt{};  ///< ticks
  std::array<bool, 2> m_holds{};     ///< their grips are pressed
  std::array<bool, 2> m_carries{};   ///< panels, as was felt
  Panels m_panels;
  Props m_props;             ///< kept for its memory
  size_t m_panelsThere = 0;  ///< of those in it: the others are before the eye
  /// What is being prepared, or was last: while only head and hands move, it stays.
  uint64_t m_prepared = 0;
  double m_share = -1;   ///< nothing yet
  bool m_shows = false;  ///< something was prepared
  Preparing m_preparing;
};

}  // namespace ps::vr
