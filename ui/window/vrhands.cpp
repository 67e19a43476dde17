// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrhands.h"

#include "ui/document/document.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/session/session.h"
#include "ui/theme/theme.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/vrfeel.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <variant>

namespace ps {
namespace {

using vr::kLeft, vr::kRight;

constexpr double kPushed = 0.7;    // of a stick's way, or from the middle of a pad
constexpr double kRepeats = 0.15;  // s, while it stays there
constexpr double kLong = 0.5;      // s
constexpr const char* kGrabBrush = "grab";
constexpr double kTurned = 0.05;  // about rad, after which a brush is shown turned

/// Whether a hand does the opposite of what the brush is called: it erases.
bool isOpposite(const vr::HandRoles& roles, size_t hand, bool holds) { return (hand == roles.other()) != holds; }

}  // namespace

VrHands::VrHands(Session& session, Toolbox& tools)
    : m_session(session),
      m_tools(tools),
      m_brushes{HandBrush(tools), HandBrush(tools)},
      m_grabs{HandBrush(tools, kGrabBrush), HandBrush(tools, kGrabBrush)},
      m_held{HandTool(tools), HandTool(tools)} {
  connect(&session.document(), &Document::changed, this, &VrHands::onChanged);
  connect(&session.document().undoStack(), &History::undoing, this, [this] {
    if (!ends()) finishStrokes();
  });
}

/// What changes in the document is the end of a stroke of these hands.
bool VrHands::ends() const {
  return m_ends || std::any_of(m_brushes.begin(), m_brushes.end(), [](const HandBrush& b) { return b.finishes(); });
}

/// A stroke in the making is not lost by what another hand does, or who sits at the desktop: it ends where something
/// comes, goes, parts or becomes another that it may lie on, and otherwise goes on. Only what it builds on may be gone.
void VrHands::onChanged(const ChangeEvent& event) {
  if (ends()) return;
  const auto* body = std::get_if<BodyChanged>(&event);
  const auto* stroke = std::get_if<StrokeChanged>(&event);
  const auto* value = std::get_if<ParameterChanged>(&event);
  const bool materials = std::holds_alternative<MaterialsChanged>(event);
  const bool lost = std::holds_alternative<ProjectOpened>(event) || (stroke && !stroke->done);
  const bool gone = materials || (body && !m_session.document().body(body->id));
  const bool edited = gone || body || stroke || std::holds_alternative<BodyParted>(event) ||
                      (value && (value->address.owner == Owner::Solver || value->address.owner == Owner::Body)) ||
                      std::holds_alternative<PortChanged>(event) || std::holds_alternative<WallsChanged>(event);
  for (HandBrush& brush : m_brushes)
    if (lost || (gone && !brush.stands())) brush.cancel();
  if (lost || gone) {
    for (HandBrush& grab : m_grabs) grab.cancel();
    for (HandTool& held : m_held) held.letGo();
  }
  m_edited = m_edited || (edited && !lost);  // it may be under way
}

void VrHands::finishStrokes() {
  m_edited = false;
  m_ends = true;
  for (HandBrush& brush : m_brushes) brush.finish();
  for (HandTool& held : m_held) held.letGo();
  m_ends = false;
}

void VrHands::act(const vr::HandsSeen& seen, const SnapshotPtr& scene) {
  if (m_edited) finishStrokes();
  for (const size_t hand : {kLeft, kRight}) {
    draw(hand, seen, scene);
    press(hand, seen.roles, seen.hands[hand].input, seen.seconds);
    const vr::HandsSeen::Hand &now = seen.hands[hand], &before = m_seen.hands[hand];
    m_changed = m_changed || now.holds != before.holds || (now.up - m_described[hand]).norm() > kTurned;
  }
  const vr::HandsSeen::Hand& main = seen.hands[seen.roles.main];
  if (!main.panel) choose(main.input, seen.seconds);  // else it scrolls there
  m_seen = seen;
}

void VrHands::draw(size_t hand, const vr::HandsSeen& seen, const SnapshotPtr& scene) {
  const vr::HandsSeen::Hand& now = seen.hands[hand];
  HandBrush& brush = m_brushes[hand];
  const uint64_t begun = brush.begun();
  HandInScene there{now.tip, now.up, now.forward, now.input.draw, now.holds, seen.seconds};
  m_ends = true;
  if (lead(hand, there, seen.carries, scene) || grab(hand, there, scene))
    there.pressure = 0;  // it has no brush meanwhile
  there.opposite = isOpposite(seen.roles, hand, now.holds);
  const bool heated = brush.heats();
  brush.follow(there, scene);
  m_ends = false;
  m_changed = m_changed || brush.begun() != begun || heated || brush.heats();
}

/// A grip takes what is at hand. With the trigger it turns the brush round, whichever comes first. Whether the hand
/// holds something.
bool VrHands::lead(size_t hand, const HandInScene& there, bool carries, const SnapshotPtr& scene) {
  HandTool& held = m_held[hand];
  const bool holds = m_seen.hands[hand].holds, pulls = there.pressure > 0;
  if (held.active() && pulls && there.seconds - held.since() < kLong) {
    held.putBack();
  } else if (held.active() && carries && there.seconds - held.since() < kLong) {
    held.putBack();  // this grip was the first of the two that carry the scene
  } else if (held.active() && !there.opposite) {
    held.letGo();
  } else if (held.active()) {
    held.follow(there);
    m_changed = true;
  } else if (there.opposite && !holds && !pulls && held.take(there, scene, m_session.playing())) {
    ++m_taken[hand];
  }
  return held.active();
}

/// What is free is carried while time passes: before that there is nothing that would bear it.
bool VrHands::grab(size_t hand, HandInScene there, const SnapshotPtr& scene) {
  HandBrush& grab = m_grabs[hand];
  const bool begins = there.opposite && !m_seen.hands[hand].holds && there.pressure == 0;
  const bool meant = grab.active() ? there.pressure == 0 : begins && m_session.playing() && meets(there, scene);
  there.pressure = there.opposite && meant ? 1 : 0;
  there.opposite = false;
  const uint64_t begun = grab.begun();
  grab.follow(there, scene);
  m_taken[hand] += grab.begun() - begun;
  m_changed = m_changed || grab.begun() != begun;
  return grab.active();
}

/// Whether there is matter within the hand's brush.
bool VrHands::meets(const HandInScene& there, const SnapshotPtr& scene) const {
  const double reach = m_tools.brush().radius + m_tools.spacing();
  return there.place && scene && std::any_of(scene->position.begin(), scene->position.end(), [&](const auto& p) {
           return (vectorOf(p) - *there.place).squaredNorm() < reach * reach;
         });
}

/// First and second button. Hands with pads have one for both: for half a second it is the second. A hand that is out
/// of sight meanwhile has not let go of it.
std::pair<bool, bool> VrHands::pressed(size_t hand, const vr::HandInput& now, double seconds) {
  const vr::HandInput& before = m_seen.hands[hand].input;
  const bool second = now.second && !before.second;
  std::optional<double>& since = m_firstSince[hand];
  if (!now.pad || !now.grip) since.reset();
  if (!now.pad) return {now.first && !before.first, second};
  if (now.first && !before.first) since = seconds;
  if (since && now.first && seconds - *since >= kLong) {
    since.reset();
    return {false, true};
  }
  return {!now.first && std::exchange(since, std::nullopt).has_value(), second};
}

void VrHands::press(size_t hand, const vr::HandRoles& roles, const vr::HandInput& now, double seconds) {
  const auto [first, second] = pressed(hand, now, seconds);
  if (hand == roles.other()) {
    if (first) m_session.playPause();
    if (second) Q_EMIT realWanted();
  } else {
    if (first) m_session.document().undoStack().undo();
    if (second) Q_EMIT boardWanted();
  }
}

/// Sticks are pushed for the size, and pressed for the next material; of a pad the middle is pressed for that, its top
/// and bottom for the size, its sides for the shape.
void VrHands::choose(const vr::HandInput& now, double seconds) {
  const bool pressed = now.steerPressed && !m_seen.hands[m_seen.roles.main].input.steerPressed;
  const bool upright = std::abs(now.steerY) > std::abs(now.steerX);
  const double push = std::max(std::abs(now.steerX), std::abs(now.steerY));
  const bool pushed = push > kPushed;
  if (now.pad ? !now.steerPressed : push < kPushed / 2) m_stepped.reset();
  if (pushed && upright && (!now.pad || now.steerPressed)) {
    step(now.steerY > 0 ? 1 : -1, seconds);
  } else if (pressed && now.pad && pushed) {
    m_tools.stepShape(now.steerX > 0 ? 1 : -1);
  } else if (pressed && !pushed) {
    m_tools.stepMaterial(1);
  }
}

void VrHands::step(int direction, double seconds) {
  if (m_stepped && seconds < *m_stepped + kRepeats) return;
  m_stepped = seconds;
  m_tools.stepBrush(direction);
}

void VrHands::letGo() {
  finishStrokes();
  for (HandBrush& grab : m_grabs) grab.finish();
  m_seen = {};
  m_stepped.reset();
  m_firstSince = {};
}

/// Of what is drawn; what is taken away has none.
std::array<float, 3> VrHands::colour(size_t hand, const vr::HandRoles& roles, const Snapshot* scene) const {
  const auto channels = [](const QColor& c) { return std::array<float, 3>{c.redF(), c.greenF(), c.blueF()}; };
  const Theme& theme = Theme::current();
  if (m_tools.touchesMatter()) return channels(theme[Token::Accent]);
  const bool erases = m_tools.active() == kEraseTool;
  if (isOpposite(roles, hand, m_seen.hands[hand].holds) != erases) return channels(theme[Token::Error]);
  for (size_t k = 0; scene && k < std::min(scene->materialIds.size(), scene->materialLook.size()); ++k) {
    const auto [red, green, blue, clearness] = scene->materialLook[k];
    const std::string& wanted = m_tools.brush().material;
    if (wanted.empty() || scene->materialIds[k] == wanted) return {red, green, blue};
  }
  return channels(theme[Token::Accent]);
}

/// Of the body that it leads, or of the matter that it heats or cools, carries, pushes or stirs. While no time passes
/// nothing pulls at a hand.
vr::Feeling VrHands::feeling(size_t hand, const Snapshot* scene) const {
  if (!scene) return {};
  if (m_held[hand].active()) {
    const std::string& body = m_held[hand].body();
    const auto found = std::find_if(scene->tools.begin(), scene->tools.end(),
                                    [&](const ToolContact& contact) { return contact.body == body; });
    return found == scene->tools.end() ? vr::Feeling{} : feelingOf(*found);
  }
  const std::optional<Vector3>& tip = m_seen.hands[hand].tip;
  const double effort = m_brushes[hand].effort(*scene) + m_grabs[hand].effort(*scene);
  const vr::Feeling force = m_session.playing() ? feelingOfEffort(effort) : vr::Feeling{};
  const bool heats = tip && m_brushes[hand].heats();
  return heats ? stronger(feelingOf(*scene, *tip, m_tools.brush().radius), force) : force;
}

void VrHands::describe(vr::HeadsetView& view) {
  m_changed = false;
  view.vibration = preferences::vibration() / 100.0;
  view.roles = {preferences::leftHanded() ? kLeft : kRight, preferences::oneHanded()};
  view.raised = preferences::seatedHeight() / 100.0;
  for (const size_t hand : {kLeft, kRight}) {
    m_described[hand] = m_seen.hands[hand].up;
    vr::BrushVolume& brush = view.brushes[hand];
    std::tie(brush.half, brush.box) = m_tools.stamp(m_described[hand]);
    brush.form = m_tools.form(m_described[hand]);
    brush.colour = colour(hand, view.roles, view.matter.get());
    view.ticks[hand] = m_brushes[hand].begun() + m_taken[hand];
    view.felt[hand] = feeling(hand, view.matter.get());
    view.felt[hand].strength *= view.vibration;
    view.keeps[hand] = m_held[hand].active() || m_grabs[hand].active();
  }
}

}  // namespace ps
