// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/livescene.h"

#include "ui/vr/handmodel.h"
#include "ui/vr/posedhand.h"
#include "ui/vr/suggestions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace ps::vr {
namespace {

constexpr double kLongest = 0.2;             // s: after a longer wait nobody expects that it is made up for
constexpr double kHeld = 0.5, kLetGo = 0.3;  // of a grip's way, apart so that a tremor lets nothing go
constexpr double kNearPanel = 0.3;           // m, of a hand that points at one

Vector3 tipOf(const HandPose& aim) { return aim.position + aim.orientation * Vector3(0, 0, -kTip); }

/// How the scene stands at first.
Stand firstStand(const HandPose& head, const HeadsetView& view) {
  Stand stand = standBefore(head, view.box);
  stand.roomPlace.y() -= view.raised;
  return stand;
}

/// Whether one lies so shortly before the other that matter is seen to move from there.
bool leadsTo(const SnapshotPtr& before, const SnapshotPtr& now) {
  return before && now && before->revision == now->revision && before->stats.time < now->stats.time;
}

}  // namespace

std::array<std::optional<Vibration>, 2> LiveScene::prepare(const HeadsetFrame& seen) {
  HeadsetFrame frame = seen;
  for (const size_t hand : {kLeft, kRight}) {
    double& hold = frame.hands[hand].hold;
    m_holds[hand] = hold > (m_holds[hand] ? kLetGo : kHeld);
    hold = m_holds[hand] ? 1 : 0;
  }
  take(m_link->shown(), frame);
  if (frame.recentred && m_view->project != 0) m_moving.place(firstStand(frame.head, *m_view));
  std::array<bool, 2> keeps = m_view->keeps;
  for (const size_t hand : {kLeft, kRight}) keeps[hand] = keeps[hand] || m_panels.carries(hand);
  m_moving.follow(frame, m_view->roles, m_panels.takes(m_view->roles.goes()), keeps);
  m_panels.follow(frame, *m_view, m_moving.carries());
  tellHands(frame);
  showHands(frame);
  prepareMatter(frame);
  m_renderer.show(m_props);  // at last: the card has its matter by then, and begins with that
  return feel();
}

/// For the next frame, but for the first picture of all.
void LiveScene::prepareMatter(const HeadsetFrame& frame) {
  m_shows = m_preparing.handTo(m_renderer) || m_shows;
  const double next = share(frame.time + 2 * frame.period);
  if (m_preparing.idle() && (m_prepared != m_view->picture || m_share != next)) {
    m_preparing.begin({m_view, m_before, next});
    m_prepared = m_view->picture;
    m_share = next;
  }
  if (m_shows) return;
  m_preparing.wait();
  m_shows = m_preparing.handTo(m_renderer);
}

void LiveScene::tellHands(const HeadsetFrame& frame) {
  HandsSeen seen;
  seen.seconds = frame.time;
  seen.carries = m_moving.carries();
  seen.scale = m_moving.stand().scale;
  for (size_t board = 0; board < kBoards; ++board) seen.boardAhead[board] = m_panels.isBoardAhead(frame.head, board);
  seen.roles = m_view->roles;
  for (const size_t hand : {kLeft, kRight}) {
    const HandInput& input = frame.hands[hand];
    HandsSeen::Hand& told = seen.hands[hand];
    told.input = input;
    told.input.joints.reset();  // they are for the eye alone
    told.holds = input.hold > kHeld && !m_moving.usesGrip(hand) && !m_panels.carries(hand);
    told.panel = m_moving.carries() ? std::nullopt : m_panels.pointed(hand);
    if (m_moving.carries() || m_moving.takes(hand) || m_panels.takes(hand)) told.input.draw = 0;
    if (m_moving.steers(hand, input) && !told.panel) told.input.steerX = told.input.steerY = 0;
    if (!input.aim) continue;
    told.tip = m_moving.stand().toScene(tipOf(*input.aim));
    const Quaternion turned = m_moving.stand().toScene(*input.aim).orientation;
    told.up = turned * Vector3::UnitY();
    told.forward = turned * Vector3(0, 0, -1);
  }
  m_link->tell(seen);
}

/// By its joints, or as what it does holds them where nobody tells; else what it holds.
void LiveScene::showHand(size_t hand, const HandInput& input, const std::array<float, 3>& colour) {
  const Stand& stand = m_moving.stand();
  const HandColours colours{colour, m_view->look.dark};
  std::optional<HandJoints> joints = input.joints;
  if (!joints && input.bare && input.grip)
    joints = posedJoints(hand, *input.grip, shapeOf(input, m_panels.isNear(input.grip->position, kNearPanel)));
  if (!joints)
    return addController(m_props, stand.toScene(*input.aim), 1 / stand.scale, colours, partsOf(input.profile, hand));
  for (HandJoint& joint : *joints) joint = {stand.toScene(joint.position), joint.radius / stand.scale};
  addHand(m_props, *joints, colours);
}

void LiveScene::showHands(const HeadsetFrame& frame) {
  m_props.opaque.clear();
  m_props.clear.clear();
  m_props.panels.clear();
  for (const size_t hand : {kLeft, kRight}) {
    const std::optional<HandPose>& aim = frame.hands[hand].aim;
    if (!aim) continue;
    const BrushVolume& brush = m_view->brushes[hand];
    showHand(hand, frame.hands[hand], brush.colour);
    if (m_moving.carries()) continue;
    if (const auto hit = m_panels.hit(hand))
      addBeam(m_props, m_moving.stand().toScene(*aim), 1 / m_moving.stand().scale, (*hit - aim->position).norm(),
              m_view->accent);
    else if (!m_panels.takes(hand) && !m_moving.takes(hand))
      addVolume(m_props, m_moving.stand().toScene(tipOf(*aim)), brush);
  }
  if (m_link->handsWanted()) m_link->showHands(std::make_shared<Props>(Props{m_props.opaque, m_props.clear, {}}));
  m_panels.addTo(m_props, m_moving.stand(), *m_view);
  m_panelsThere = m_props.panels.size();
  m_moving.addTo(m_props, frame, m_view->accent);
}

/// A tick for each stroke that began, for what is pointed at on panels, and for a panel that is taken; a rumble for as
/// long as matter is felt.
std::array<std::optional<Vibration>, 2> LiveScene::feel() {
  std::array<std::optional<Vibration>, 2> felt;
  for (const size_t hand : {kLeft, kRight}) {
    constexpr double kLeast = 0.02, kFrames = 0.025;  // of the strongest; s, over two frames
    const auto& [strength, frequency] = m_view->felt[hand];
    if (strength > kLeast) felt[hand] = Vibration{strength, frequency, kFrames};
    Vibration tick;
    tick.amplitude *= m_view->vibration;
    const bool carried = std::exchange(m_carries[hand], m_panels.carries(hand));
    const bool ticks = m_view->ticks[hand] > m_felt[hand] || (m_carries[hand] && !carried);
    if (ticks && tick.amplitude > 0) felt[hand] = tick;
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
  const bool anew = view->project != m_view->project;
  Stand stand = anew ? firstStand(frame.head, *view) : m_moving.stand();
  if (!anew) stand.roomPlace.y() -= view->raised - m_view->raised;
  if (anew || view->raised != m_view->raised) m_moving.place(stand);
  if (m_view->project != 0 && view->turns != m_view->turns)
    m_moving.turnBy(view->turns - m_view->turns, frame.head.position);
  m_view = std::move(view);
}

double LiveScene::share(double seconds) const {
  if (!m_before || m_lasts <= 0) return 1;
  return std::clamp((seconds - m_came) / m_lasts, 0.0, 1.0);
}

void LiveScene::drawDepth(size_t, const Eye&, const RenderTarget& target) {
  m_renderer.drawDepth(target, m_panelsThere);
}

void LiveScene::draw(size_t, const Eye& view, const RenderTarget& target) {
  m_renderer.draw(m_moving.stand().toScene(view), target);
}

}  // namespace ps::vr
