// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/livescene.h"

#include "ui/vr/handmodel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps::vr {
namespace {

constexpr double kLongest = 0.2;            // s: after a longer wait nobody expects that it is made up for
constexpr double kHeld = 0.5, kIdle = 0.1;  // of a grip's way, and of a trigger's
constexpr double kPushed = 0.7;             // of a stick's
constexpr double kTurn = std::numbers::pi / 6;

Vector3 tipOf(const HandPose& aim) { return aim.position + aim.orientation * Vector3(0, 0, -kTip); }

/// Whether one lies so shortly before the other that matter is seen to move from there.
bool leadsTo(const SnapshotPtr& before, const SnapshotPtr& now) {
  return before && now && before->revision == now->revision && before->stats.time < now->stats.time;
}

}  // namespace

std::array<std::optional<Vibration>, 2> LiveScene::prepare(const HeadsetFrame& frame) {
  take(m_link->shown(), frame);
  carry(frame);
  turn(frame);
  m_panels.follow(frame, *m_view);
  tellHands(frame);
  showHands(frame);
  static const Snapshot kEmpty;
  const double now = share(frame);
  if (m_prepared != m_view->picture || m_share != now) {
    const HeadsetView& view = *m_view;
    m_renderer.prepare(view.matter ? *view.matter : kEmpty, m_before.get(), now, view.scene, view.look);
    m_prepared = view.picture;
    m_share = now;
  }
  return feel();
}

/// While neither draws: then a grip means the opposite of what the brush does.
void LiveScene::carry(const HeadsetFrame& frame) {
  const auto& [left, right] = frame.hands;
  const auto pulls = [](const HandInput& hand) { return hand.grip && hand.hold > kHeld && hand.draw < kIdle; };
  const auto holds = [](const HandInput& hand) { return hand.grip && hand.hold > kHeld; };
  if (!(m_carrying ? holds(left) && holds(right) : pulls(left) && pulls(right))) {
    m_carrying.reset();
    return;
  }
  const std::array<Vector3, 2> hands{left.grip->position, right.grip->position};
  if (!m_carrying) m_carrying = Carrying{m_stand, hands};
  m_stand = carried(m_carrying->from, m_carrying->hands, hands);
}

/// By steps, which the eyes bear better than a turn. The scene goes round the other way than its wearer.
void LiveScene::turn(const HeadsetFrame& frame) {
  const HandInput& hand = frame.hands[frame.hands[kLeft].pad ? kLeft : kRight];
  const bool aside = std::abs(hand.steerX) > kPushed && std::abs(hand.steerX) > std::abs(hand.steerY);
  const bool asked = aside && (!hand.pad || hand.steerPressed);
  if (asked && !m_turns && !m_carrying)
    m_stand = turned(m_stand, frame.head.position, hand.steerX > 0 ? kTurn : -kTurn);
  m_turns = asked;
}

void LiveScene::tellHands(const HeadsetFrame& frame) {
  HandsSeen seen;
  seen.seconds = frame.time;
  for (const size_t hand : {kLeft, kRight}) {
    const HandInput& input = frame.hands[hand];
    HandsSeen::Hand& told = seen.hands[hand];
    told.input = input;
    told.holds = input.hold > kHeld && !m_carrying;
    told.panel = m_carrying ? std::nullopt : m_panels.pointed(hand);
    if (m_carrying || m_panels.takes(hand)) told.input.draw = 0;
    if (!input.aim) continue;
    told.tip = m_stand.toScene(tipOf(*input.aim));
    const Quaternion turned = m_stand.toScene(*input.aim).orientation;
    told.up = turned * Vector3::UnitY();
    told.forward = turned * Vector3(0, 0, -1);
  }
  m_link->tell(seen);
}

void LiveScene::showHands(const HeadsetFrame& frame) {
  m_props.opaque.clear();
  m_props.clear.clear();
  m_props.panels.clear();
  for (const size_t hand : {kLeft, kRight}) {
    const std::optional<HandPose>& aim = frame.hands[hand].aim;
    if (!aim) continue;
    const BrushVolume& brush = m_view->brushes[hand];
    addWand(m_props, m_stand.toScene(*aim), 1 / m_stand.scale, brush.colour, m_view->look.dark);
    if (m_carrying) continue;
    if (const auto hit = m_panels.hit(hand))
      addBeam(m_props, m_stand.toScene(*aim), 1 / m_stand.scale, (*hit - aim->position).norm(), m_view->accent);
    else if (!m_panels.takes(hand))
      addVolume(m_props, m_stand.toScene(tipOf(*aim)), brush);
  }
  m_panels.addTo(m_props, m_stand, *m_view);
  m_renderer.show(m_props);
}

/// A tick for each stroke that began, and for what is pointed at on panels.
std::array<std::optional<Vibration>, 2> LiveScene::feel() {
  std::array<std::optional<Vibration>, 2> felt;
  for (const size_t hand : {kLeft, kRight}) {
    if (m_view->ticks[hand] > m_felt[hand]) felt[hand] = Vibration{};
    m_felt[hand] = m_view->ticks[hand];
  }
  return felt;
}

void LiveScene::take(std::shared_ptr<const HeadsetView> view, const HeadsetFrame& frame) {
  if (!view || view == m_view) return;
  if (view->matter != m_view->matter) {
    const bool moves = view->goesOn && leadsTo(m_view->matter, view->matter);
    m_before = moves ? m_view->matter : nullptr;
    m_lasts = moves ? std::min(frame.time - m_came, kLongest) : 0;
    m_came = frame.time;
  }
  if (m_view->project == 0) m_felt = view->ticks;  // those of earlier stays
  if (view->project != m_view->project) m_stand = standBefore(frame.head, view->box);
  m_view = std::move(view);
}

double LiveScene::share(const HeadsetFrame& frame) const {
  if (!m_before || m_lasts <= 0) return 1;
  return std::clamp((frame.time + frame.period - m_came) / m_lasts, 0.0, 1.0);
}

void LiveScene::draw(size_t, const Eye& view, const RenderTarget& target) {
  m_renderer.draw(m_stand.toScene(view), target);
}

}  // namespace ps::vr
