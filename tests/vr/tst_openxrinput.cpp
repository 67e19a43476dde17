// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/rawclient.h"
#include "tests/vr/rawevents.h"
#include "tests/vr/scriptedrun.h"

#include <QTest>

#include <cmath>

using ps::eventsOf;
using ps::HeadlessContext;
using ps::passFrame;
using ps::RawClient;
using ps::ScriptedRun;
using ps::vr::check;
using ps::vr::structure;

namespace {

constexpr const char* kVive = "htc/vive_controller";

float numberOf(RawClient& client, XrAction action, const std::string& hand = {}) {
  const XrActionStateGetInfo info = client.stateInfo(action, hand);
  auto state = structure<XrActionStateFloat>(XR_TYPE_ACTION_STATE_FLOAT);
  check(xrGetActionStateFloat(client.handle(), &info, &state), "xrGetActionStateFloat");
  return state.isActive ? state.currentState : -9;
}

XrActionStateBoolean buttonOf(RawClient& client, XrAction action, const std::string& hand = {}) {
  const XrActionStateGetInfo info = client.stateInfo(action, hand);
  auto state = structure<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
  check(xrGetActionStateBoolean(client.handle(), &info, &state), "xrGetActionStateBoolean");
  return state;
}

}  // namespace

/// What the scripted runtime makes of a controller's parts, beyond what the program asks of it by now.
class OpenXrInputTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context.release(); }

  void buttonsComeFromNumbers();
  void changesAreToldOnce();
  void handsAreCombined();
  void higherPriorityTakesThePart();
  void controllerMayBeChanged();
  void turningHasASpeed();

 private:
  HeadlessContext m_context{nullptr};
};

void OpenXrInputTest::buttonsComeFromNumbers() {
  const ScriptedRun run(R"({"profile": "/interaction_profiles/htc/vive_controller", "keys": [
      {"frame": 4, "left": {"/input/trigger/value": 0.4, "/input/menu/click": true}},
      {"frame": 5, "left": {"/input/trigger/value": 0.6}}]})");
  {
    RawClient client(m_context);
    const XrActionSet set = client.actionSet();
    const XrAction button = client.action(set, "button", XR_ACTION_TYPE_BOOLEAN_INPUT);
    QCOMPARE(client.suggest(kVive, button, "/user/hand/left/input/trigger"), XR_SUCCESS);
    QCOMPARE(client.attach({set}), XR_SUCCESS);
    client.frames(5);
    QCOMPARE(client.sync({set}), XR_SUCCESS);
    QVERIFY(buttonOf(client, button).isActive && !buttonOf(client, button).currentState);
    QVERIFY(!buttonOf(client, button, "/user/hand/right").isActive);
    client.frames(1);
    client.sync({set});
    QVERIFY(buttonOf(client, button).currentState);
  }
  m_context.release();
  QVERIFY(run.lines("violation").empty());
}

void OpenXrInputTest::changesAreToldOnce() {
  const ScriptedRun run(R"({"keys": [{"frame": 4, "left": {"/input/select/click": true}}]})");
  {
    RawClient client(m_context);
    const XrActionSet set = client.actionSet();
    const XrAction button = client.action(set, "button", XR_ACTION_TYPE_BOOLEAN_INPUT);
    client.suggest("khr/simple_controller", button, "/user/hand/left/input/select/click");
    client.attach({set});
    client.frames(4);
    client.sync({set});
    QVERIFY(!buttonOf(client, button).changedSinceLastSync);
    const XrTime time = client.begin();
    client.sync({set});
    const XrActionStateBoolean pressed = buttonOf(client, button);
    QVERIFY(pressed.changedSinceLastSync && pressed.currentState);
    QCOMPARE(pressed.lastChangeTime, time);
    client.sync({set});
    QVERIFY(!buttonOf(client, button).changedSinceLastSync);
    client.sync({});  // the set is not active
    QVERIFY(!buttonOf(client, button).isActive);
    client.end(time, nullptr);
  }
  m_context.release();
}

void OpenXrInputTest::handsAreCombined() {
  const ScriptedRun run(R"({"profile": "/interaction_profiles/htc/vive_controller", "keys": [
      {"frame": 0, "left": {"/input/trigger/value": 0.25}, "right": {"/input/trigger/value": 0.75}}]})");
  {
    RawClient client(m_context);
    const XrActionSet set = client.actionSet();
    const XrAction left = client.action(set, "trigger", XR_ACTION_TYPE_FLOAT_INPUT);
    const XrPath parts[] = {client.runtime().path("/user/hand/left/input/trigger/value"),
                            client.runtime().path("/user/hand/right/input/trigger/value")};
    const XrActionSuggestedBinding bindings[] = {{left, parts[0]}, {left, parts[1]}};
    auto info = structure<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    info.interactionProfile = client.runtime().path("/interaction_profiles/htc/vive_controller");
    info.countSuggestedBindings = 2;
    info.suggestedBindings = bindings;
    QCOMPARE(xrSuggestInteractionProfileBindings(client.runtime().instance(), &info), XR_SUCCESS);
    client.attach({set});
    client.frames(4);
    client.sync({set});
    QCOMPARE(numberOf(client, left, "/user/hand/left"), 0.25f);
    QCOMPARE(numberOf(client, left, "/user/hand/right"), 0.75f);
    QCOMPARE(numberOf(client, left), 0.75f);
    auto sources = structure<XrBoundSourcesForActionEnumerateInfo>(XR_TYPE_BOUND_SOURCES_FOR_ACTION_ENUMERATE_INFO);
    sources.action = left;
    uint32_t count = 0;
    std::array<XrPath, 2> paths{};
    QCOMPARE(xrEnumerateBoundSourcesForAction(client.handle(), &sources, 2, &count, paths.data()), XR_SUCCESS);
    QCOMPARE(count, 2u);
    QCOMPARE(paths[1], parts[1]);
  }
  m_context.release();
}

void OpenXrInputTest::higherPriorityTakesThePart() {
  const ScriptedRun run(R"({"profile": "/interaction_profiles/htc/vive_controller", "keys": [
      {"frame": 0, "left": {"/input/trigger/value": 0.5}}]})");
  {
    RawClient client(m_context);
    const XrActionSet low = client.actionSet("low", 1), high = client.actionSet("high", 2);
    const XrAction below = client.action(low, "a", XR_ACTION_TYPE_FLOAT_INPUT);
    const XrAction above = client.action(high, "a", XR_ACTION_TYPE_FLOAT_INPUT);
    const XrPath part = client.runtime().path("/user/hand/left/input/trigger/value");
    const XrActionSuggestedBinding bindings[] = {{below, part}, {above, part}};
    auto info = structure<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    info.interactionProfile = client.runtime().path("/interaction_profiles/htc/vive_controller");
    info.countSuggestedBindings = 2;
    info.suggestedBindings = bindings;
    check(xrSuggestInteractionProfileBindings(client.runtime().instance(), &info), "suggest");
    client.attach({low, high});
    client.frames(4);
    client.sync({low, high});
    QCOMPARE(numberOf(client, below), -9.0f);
    QCOMPARE(numberOf(client, above), 0.5f);
    client.sync({low});
    QCOMPARE(numberOf(client, below), 0.5f);
  }
  m_context.release();
}

void OpenXrInputTest::controllerMayBeChanged() {
  const ScriptedRun run(R"({"events": [
      {"frame": 5, "profile": "/interaction_profiles/htc/vive_controller", "hand": "right"}]})");
  {
    RawClient client(m_context);
    const XrActionSet set = client.actionSet();
    const XrAction button = client.action(set, "button", XR_ACTION_TYPE_BOOLEAN_INPUT);
    client.suggest("khr/simple_controller", button, "/user/hand/right/input/select/click");
    client.suggest(kVive, button, "/user/hand/right/input/menu/click");
    client.attach({set});
    const auto profile = [&] {
      auto state = structure<XrInteractionProfileState>(XR_TYPE_INTERACTION_PROFILE_STATE);
      check(xrGetCurrentInteractionProfile(client.handle(), client.runtime().path("/user/hand/right"), &state),
            "profile");
      return state.interactionProfile;
    };
    client.frames(4);
    client.sync({set});
    QCOMPARE(profile(), client.runtime().path("/interaction_profiles/khr/simple_controller"));
    client.frames(1);
    eventsOf<XrEventDataInteractionProfileChanged>(client, XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED);
    passFrame(client);
    client.sync({set});
    const auto events =
        eventsOf<XrEventDataInteractionProfileChanged>(client, XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED);
    QCOMPARE(events.size(), size_t{1});
    QCOMPARE(events[0].session, client.handle());
    QCOMPARE(profile(), client.runtime().path("/interaction_profiles/htc/vive_controller"));
  }
  m_context.release();
  QVERIFY(run.lines("violation").empty());
}

void OpenXrInputTest::turningHasASpeed() {
  // A quarter of a turn about y in 90 frames of 1/90 s.
  const ScriptedRun run(R"({"keys": [
      {"frame": 0, "left": {"grip": [0, 1, 0]}},
      {"frame": 90, "left": {"grip": [0, 1, 0, 0, 0.70710678, 0, 0.70710678]}}]})");
  {
    RawClient client(m_context);
    const XrActionSet set = client.actionSet();
    const XrAction pose = client.action(set, "pose", XR_ACTION_TYPE_POSE_INPUT);
    client.suggest("khr/simple_controller", pose, "/user/hand/left/input/grip/pose");
    client.attach({set});
    auto info = structure<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = pose;
    info.poseInActionSpace.orientation.w = 1;
    XrSpace space = XR_NULL_HANDLE;
    check(xrCreateActionSpace(client.handle(), &info, &space), "space");
    client.frames(10);
    client.sync({set});
    auto velocity = structure<XrSpaceVelocity>(XR_TYPE_SPACE_VELOCITY);
    auto location = structure<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    location.next = &velocity;
    const XrTime time = client.begin();
    check(xrLocateSpace(space, client.session().floor(), time, &location), "locate");
    client.end(time, nullptr);
    QVERIFY(velocity.velocityFlags & XR_SPACE_VELOCITY_ANGULAR_VALID_BIT);
    // Single precision turns differ by 1e-7 over 1/180 s.
    QVERIFY2(std::abs(double(velocity.angularVelocity.y) - M_PI / 2) < 1e-3,
             qPrintable(QString::number(velocity.angularVelocity.y)));
  }
  m_context.release();
}

QTEST_GUILESS_MAIN(OpenXrInputTest)
#include "tst_openxrinput.moc"
