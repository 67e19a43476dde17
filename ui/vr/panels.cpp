// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/panels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ps::vr {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kOverHand = 0.12, kTilt = 35 * kDegree;  // of the palette: m from the palm, and from upright
constexpr double kPinnedAway = 0.15, kPinnedUp = 0.05;    // m, of a pinned one from the hand that then points at it
constexpr double kHandAway = 0.5;                         // m, of a hand from the eyes
constexpr double kFacing = 0.55, kStillFacing = 0.4;      // cosine between the palm and the way to the eyes
constexpr double kAway = 0.75, kBelow = 15 * kDegree;     // of the board: m from the eyes, and from their level
constexpr double kFarBoard = 1.5, kAhead = 0.6;           // m, and cosine of an angle: it is out of sight beyond
constexpr std::array<double, kBoards> kAside{0, -44 * kDegree, 44 * kDegree};  // to the left: a board is 41 wide
constexpr double kBesideHand = 0.05;                                           // m, of labels
constexpr double kBeforePanel = 0.006;                                         // m, of a popup
constexpr double kEdge = 0.026;  // tangent of 1.5 degrees, by which a beam may leave what it is on
constexpr double kAnywhere = 3;  // likewise, while it presses; of a tip, m
constexpr double kNear = 0.03, kThrough = 0.002, kBack = 0.01;  // m of a tip from a panel
constexpr double kDraws = 0.12, kDrawn = 0.06;                  // of a trigger's way, as HandBrush takes it
constexpr double kPull = 0.5, kLetGo = 0.3;                     // of a trigger's way

/// Upright but for a tilt, its front towards a place.
Quaternion facing(const Vector3& from, const Vector3& to, double tilt) {
  const double heading = std::atan2(to.x() - from.x(), to.z() - from.z());
  return Quaternion(Eigen::AngleAxisd(heading, Vector3::UnitY()) * Eigen::AngleAxisd(-tilt, Vector3::UnitX()));
}

/// Likewise, and leaning as far as that is above or below it.
Quaternion turnedTo(const Vector3& from, const Vector3& to) {
  const Vector3 way = to - from;
  return facing(from, to, std::atan2(way.y(), std::hypot(way.x(), way.z())));
}

}  // namespace

Vector3 Panels::Place::at(double x, double y) const {
  return pose.position + pose.orientation * Vector3((x - 0.5) * width, (0.5 - y) * height, 0);
}

Vector3 Panels::Place::own(const Vector3& room) const { return pose.orientation.conjugate() * (room - pose.position); }

bool Panels::Place::holds(const Vector3& own, double edge) const {
  return std::abs(own.x()) < width / 2 + edge && std::abs(own.y()) < height / 2 + edge;
}

void Panels::follow(const HeadsetFrame& frame, const HeadsetView& view, bool busy) {
  m_head = frame.head.position;
  if (std::exchange(m_roles, view.roles) != view.roles || frame.recentred) m_pinned.reset();
  if (frame.recentred) m_boards.fill({});  // they come before the wearer as the scene does
  placePalette(frame, view.panels[kPalette]);
  for (size_t board = 0; board < kBoards; ++board) placeBoard(board, frame, view);
  for (const size_t hand : {kLeft, kRight}) carry(hand, frame.hands[hand], view, busy);
  placePopup(view);
  for (const size_t hand : {kLeft, kRight}) {
    point(hand, frame.hands[hand]);
    placeLabels(hand, frame.hands[hand], view.labels[hand]);
  }
}

void Panels::placePalette(const HeadsetFrame& frame, const PanelView& palette) {
  const bool was = m_places[kPalette].has_value() && !m_pinned;
  m_places[kPalette].reset();
  if (!palette.image) return;
  pinPalette(frame);
  const size_t hand = m_roles.other();
  if (m_pinned) {
    // Where it stands farther than a palette over a hand, it is as much larger.
    const double size = std::max(1.0, m_pinnedFrom / kHandAway);
    m_places[kPalette] = Place{*m_pinned, size * palette.width, size * palette.height};
  } else if (!m_roles.alone && palmFaces(frame, hand, was)) {
    const Vector3 middle =
        frame.hands[hand].grip->position + Vector3(0, kOverHand + palette.height / 2 * std::cos(kTilt), 0);
    m_places[kPalette] = Place{{middle, facing(middle, m_head, kTilt)}, palette.width, palette.height};
  }
}

/// A hand that is alone points at what it has brought: that has to stay behind.
void Panels::pinPalette(const HeadsetFrame& frame) {
  for (const size_t hand : {kLeft, kRight}) {
    const bool byPalm = m_roles.alone && hand == m_roles.main;
    const Asks did = m_asks[hand];
    m_asks[hand] = {frame.hands[hand].menu, byPalm && palmFaces(frame, hand, did.byPalm)};
    const bool asks = (m_asks[hand].byMenu && !did.byMenu) || (m_asks[hand].byPalm && !did.byPalm);
    if (!asks || !frame.hands[hand].grip) continue;
    if (std::exchange(m_pinned, std::nullopt)) continue;
    m_pinned = atWrist(*frame.hands[hand].grip);
    m_pinnedFrom = (m_pinned->position - m_head).norm();
  }
}

/// OpenXR: of a left hand, x leads away from the palm, of a right one into it.
bool Panels::palmFaces(const HeadsetFrame& frame, size_t hand, bool did) const {
  const std::optional<HandPose>& palm = frame.hands[hand].grip;
  if (!palm) return false;
  const Vector3 toEyes = (m_head - palm->position).normalized();
  const Vector3 out = palm->orientation * Vector3(hand == kLeft ? 1 : -1, 0, 0);
  return out.dot(toEyes) >= (did ? kStillFacing : kFacing);
}

/// Beyond the hand, as its wearer sees it, so that it can be pointed at from there.
HandPose Panels::atWrist(const HandPose& palm) const {
  Vector3 beyond = palm.position - m_head;
  beyond.y() = 0;
  const Vector3 middle =
      palm.position + Vector3(0, kPinnedUp, 0) + kPinnedAway * beyond / std::max(beyond.norm(), 1e-3);
  return {middle, facing(middle, m_head, kTilt)};
}

bool Panels::isBoardAhead(const HandPose& head, size_t board) const {
  const std::optional<Place>& place = m_places.at(kBoard + board);
  if (!place) return true;
  const Vector3 way = place->pose.position - head.position;
  return way.norm() < kFarBoard && way.normalized().dot(head.orientation * Vector3(0, 0, -1)) > kAhead;
}

/// It stays where it was brought, or put down.
void Panels::placeBoard(size_t board, const HeadsetFrame& frame, const HeadsetView& view) {
  const PanelView& shown = view.panels[kBoard + board];
  std::optional<HandPose>& stands = m_boards[board];
  m_places[kBoard + board].reset();
  if (!shown.image) return;
  if (!stands || m_brought[board] != view.brought[board]) {
    m_brought[board] = view.brought[board];
    const Vector3 looks = frame.head.orientation * Vector3(0, 0, -1);
    const double heading = std::atan2(-looks.x(), -looks.z()) + kAside[board], level = kAway * std::cos(kBelow);
    HandPose pose;
    pose.position = m_head + Vector3(-level * std::sin(heading), -kAway * std::sin(kBelow), -level * std::cos(heading));
    pose.orientation = facing(pose.position, m_head, kBelow);
    stands = pose;
  }
  m_places[kBoard + board] = Place{*stands, shown.width, shown.height};
}

/// Where a board that it carries is put away meanwhile, nothing is taken before the grip is let go, nor it again. Where
/// both grips carry the scene, it stays where it is by then.
void Panels::carry(size_t hand, const HandInput& input, const HeadsetView& view, bool busy) {
  const bool held = std::exchange(m_holds[hand], input.hold > kPull);
  std::optional<Carried>& carried = m_carried[hand];
  if (!m_holds[hand] || busy) return carried.reset();
  if (carried && !m_places[carried->panel]) carried->isGone = true;
  if (!input.aim) return;
  if (!held) takeBoard(hand, *input.aim, view);
  if (!carried || carried->isGone) return;
  const Vector3 at = input.aim->position + input.aim->orientation * Vector3(0, 0, -carried->along);
  HandPose& pose = *m_boards[carried->panel - kBoard];
  pose.orientation = turnedTo(at, m_head);
  pose.position = at - pose.orientation * carried->own;
  m_places[carried->panel]->pose = pose;
}

/// Of a header that it points at and does not press.
void Panels::takeBoard(size_t hand, const HandPose& aim, const HeadsetView& view) {
  const std::optional<PanelPoint>& point = m_pointed[hand];
  if (!point || point->pressed || !m_places[point->panel]) return;
  const double header = view.panels[point->panel].header;
  if (header <= 0 || point->y > header) return;
  const std::optional<Carried>& other = m_carried[1 - hand];
  if (other && !other->isGone && other->panel == point->panel) return;
  const double along = point->tip ? kTip : point->depth;
  const Vector3 at = aim.position + aim.orientation * Vector3(0, 0, -along);
  m_carried[hand] = Carried{point->panel, m_places[point->panel]->own(at), along};
}

void Panels::placePopup(const HeadsetView& view) {
  const PanelView& popup = view.panels[kPopup];
  m_places[kPopup].reset();
  if (!popup.image || !m_places[popup.on]) return;
  Place place = *m_places[popup.on];
  const double size = place.width / view.panels[popup.on].width;
  place.pose.position += place.pose.orientation * Vector3(size * popup.right, -size * popup.down, kBeforePanel);
  place.width = size * popup.width;
  place.height = size * popup.height;
  m_places[kPopup] = place;
}

/// Upright before the eyes, on the outer side of the hand, so that neither hides what the hand does.
void Panels::placeLabels(size_t hand, const HandInput& input, const PanelView& labels) {
  m_labels[hand].reset();
  if (!input.grip || !labels.image) return;
  const Vector3 at = input.grip->position;
  const Quaternion front = turnedTo(at, m_head);
  const double aside = (hand == kLeft ? -1 : 1) * (kBesideHand + labels.width / 2);
  m_labels[hand] = Place{{at + front * Vector3(aside, 0, 0), front}, labels.width, labels.height};
}

void Panels::point(size_t hand, const HandInput& input) {
  std::optional<PanelPoint>& now = m_pointed[hand];
  const std::optional<PanelPoint> before = std::exchange(now, std::nullopt);
  // A trigger stays what it was pulled for, also while nobody knows where the hand is.
  if (input.draw < (m_draws[hand] ? kDrawn : kLetGo)) m_draws[hand] = m_presses[hand] = false;
  if (!input.aim || m_draws[hand]) return;
  if (before && before->pressed && m_places[before->panel]) {
    now = before->tip ? tipOn(before->panel, *input.aim, kAnywhere) : beamOn(before->panel, *input.aim, kAnywhere);
    if (now) now->pressed = now->tip ? now->depth < kBack : m_presses[hand];
    return;
  }
  now = pointAnew(hand, *input.aim, before);
  const bool anew = !m_presses[hand] && input.draw > kPull;
  if (!now) {
    m_draws[hand] = !m_presses[hand] && input.draw > kDraws;
    return;
  }
  m_presses[hand] = m_presses[hand] || anew;
  if (now->tip)
    now->pressed = before && before->tip && now->depth < kThrough && before->depth >= kThrough;
  else
    now->pressed = anew;
}

/// A tip is nearer than any beam; of beams the first panel that one meets.
std::optional<PanelPoint> Panels::pointAnew(size_t hand, const HandPose& aim,
                                            const std::optional<PanelPoint>& before) const {
  std::optional<PanelPoint> beam;
  for (size_t panel = kPanels; panel-- > 0;) {
    const bool own = panel == kPalette && hand == m_roles.other() && !m_pinned;  // at which a hand does not point
    if (!m_places[panel] || own) continue;
    const bool was = before && before->panel == panel;
    if (auto tip = tipOn(panel, aim, was ? kBack : 0)) return tip;
    const auto one = beamOn(panel, aim, was ? kEdge : 0);
    if (one && (!beam || one->depth < beam->depth)) beam = one;
  }
  return beam;
}

/// `edge`: m by which it may be beside the panel.
std::optional<PanelPoint> Panels::tipOn(size_t panel, const HandPose& aim, double edge) const {
  const Place& place = *m_places[panel];
  const Vector3 tip = place.own(aim.position + aim.orientation * Vector3(0, 0, -kTip));
  if (!(tip.z() < kNear && tip.z() > -(edge > kNear ? edge : kNear)) || !place.holds(tip, edge)) return std::nullopt;
  return PanelPoint{panel, tip.x() / place.width + 0.5, 0.5 - tip.y() / place.height, tip.z(), true, false};
}

/// `edge`: by which it may miss the panel, tangent of an angle.
std::optional<PanelPoint> Panels::beamOn(size_t panel, const HandPose& aim, double edge) const {
  const Place& place = *m_places[panel];
  const Vector3 from = place.own(aim.position);
  const Vector3 way = place.pose.orientation.conjugate() * (aim.orientation * Vector3(0, 0, -1));
  if (!(from.z() > 0 && way.z() < 0)) return std::nullopt;
  const double length = -from.z() / way.z();
  const Vector3 at = from + length * way;
  if (!place.holds(at, edge * length)) return std::nullopt;
  return PanelPoint{panel, at.x() / place.width + 0.5, 0.5 - at.y() / place.height, length, false, false};
}

bool Panels::isNear(const Vector3& place, double metres) const {
  return std::any_of(m_places.begin(), m_places.end(), [&](const std::optional<Place>& panel) {
    if (!panel) return false;
    const Vector3 own = panel->own(place), half(panel->width / 2, panel->height / 2, 0);
    return (own - own.cwiseMax(-half).cwiseMin(half)).norm() < metres;
  });
}

std::optional<double> Panels::ahead(const HandPose& aim) const {
  std::optional<double> nearest;
  for (size_t panel = 0; panel < kPanels; ++panel) {
    const auto beam = m_places[panel] ? beamOn(panel, aim, 0) : std::nullopt;
    if (beam && (!nearest || beam->depth < *nearest)) nearest = beam->depth;
  }
  return nearest;
}

std::optional<Vector3> Panels::hit(size_t hand) const {
  const std::optional<PanelPoint>& pointed = m_pointed.at(hand);
  if (!pointed || pointed->tip || !m_places[pointed->panel]) return std::nullopt;
  return m_places[pointed->panel]->at(pointed->x, pointed->y);
}

/// The farthest first.
void Panels::addTo(Props& props, const Stand& stand, const HeadsetView& view) const {
  std::vector<std::pair<double, Panel>> seen;
  const auto add = [&](const Place& place, const Place& far, const PanelView& of) {
    const auto corner = [&](double x, double y) { return stand.toScene(place.at(x, y)); };
    seen.push_back(
        {(far.pose.position - m_head).norm(), {{corner(0, 1), corner(1, 1), corner(1, 0), corner(0, 0)}, of.image}});
  };
  for (size_t panel = 0; panel < kPanels; ++panel) {
    if (!m_places[panel]) continue;
    // A popup lies over the one that it came from, wherever on it.
    const std::optional<Place>& under = m_places[view.panels[panel].on];
    add(*m_places[panel], panel == kPopup && under ? *under : *m_places[panel], view.panels[panel]);
  }
  for (const size_t hand : {kLeft, kRight})
    if (m_labels[hand]) add(*m_labels[hand], *m_labels[hand], view.labels[hand]);
  std::stable_sort(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [away, panel] : seen) props.panels.push_back(std::move(panel));
}

}  // namespace ps::vr
