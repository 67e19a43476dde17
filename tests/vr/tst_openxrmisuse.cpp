// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/rawclient.h"
#include "tests/vr/scriptedrun.h"

#include <QTest>

#include <functional>
#include <thread>

using ps::HeadlessContext;
using ps::RawClient;
using ps::ScriptedRun;
using ps::vr::structure;

namespace {

constexpr const char* kVive = "htc/vive_controller";

/// A call that the specification forbids, after whatever leads to it.
struct Misuse {
  const char* name;
  std::function<XrResult(RawClient&)> call;
  XrResult result;
  const char* says;  ///< in the log
};

XrResult waitFrame(RawClient& client) {
  auto state = structure<XrFrameState>(XR_TYPE_FRAME_STATE);
  return xrWaitFrame(client.handle(), nullptr, &state);
}

XrResult waitImage(XrSwapchain swapchain) {
  const auto wait = structure<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  return xrWaitSwapchainImage(swapchain, &wait);
}

XrResult toPath(RawClient& client, const char* text) {
  XrPath path = XR_NULL_PATH;
  return xrStringToPath(client.runtime().instance(), text, &path);
}

// A frame with a layer that `change` has spoilt.
template <class Change>
std::function<XrResult(RawClient&)> frameWith(Change change) {
  return [change](RawClient& client) {
    client.frames(3);
    const XrTime time = client.begin();
    const XrSwapchain swapchain = client.swapchain();
    client.show(swapchain);
    RawClient::Projection projection = client.projection(swapchain);
    change(projection);
    return client.end(time, projection.header());
  };
}

std::vector<Misuse> frameMisuses() {
  return {
      {"a frame is begun and nobody waited",
       [](RawClient& c) {
         c.frames(1);
         return xrBeginFrame(c.handle(), nullptr);
       },
       XR_ERROR_CALL_ORDER_INVALID, "xrBeginFrame() without xrWaitFrame()"},
      {"a frame ends that did not begin",
       [](RawClient& c) {
         c.frames(1);
         return c.end(1, nullptr);
       },
       XR_ERROR_CALL_ORDER_INVALID, "xrEndFrame() without xrBeginFrame()"},
      {"waiting twice",
       [](RawClient& c) {
         c.frames(1);
         waitFrame(c);
         return waitFrame(c);
       },
       XR_ERROR_RUNTIME_FAILURE, "nobody begins the frame before"},
      {"waiting before the session runs", waitFrame, XR_ERROR_SESSION_NOT_RUNNING, "does not run"},
      {"beginning the session twice",
       [](RawClient& c) {
         c.frames(1);
         auto info = structure<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
         info.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
         return xrBeginSession(c.handle(), &info);
       },
       XR_ERROR_SESSION_RUNNING, "runs already"},
      {"ending the session unasked",
       [](RawClient& c) {
         c.frames(3);
         return xrEndSession(c.handle());
       },
       XR_ERROR_SESSION_NOT_STOPPING, "is not STOPPING"},
      {"leaving what does not run", [](RawClient& c) { return xrRequestExitSession(c.handle()); },
       XR_ERROR_SESSION_NOT_RUNNING, "does not run"},
  };
}

std::vector<Misuse> timeMisuses() {
  return {
      {"a frame at no time",
       [](RawClient& c) {
         c.frames(1);
         c.begin();
         return c.end(0, nullptr);
       },
       XR_ERROR_TIME_INVALID, "time of display is none"},
      {"a frame at a time that nobody predicted",
       [](RawClient& c) {
         c.frames(1);
         return c.end(c.begin() + 1, nullptr);
       },
       XR_SUCCESS, "not one that was predicted"},
      {"two sessions",
       [](RawClient& c) {
         auto info = structure<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
         info.systemId = c.runtime().system();
         XrSession second = XR_NULL_HANDLE;
         return xrCreateSession(c.runtime().instance(), &info, &second);
       },
       XR_ERROR_LIMIT_REACHED, "there is a session already"},
  };
}

std::vector<Misuse> layerMisuses() {
  return {
      {"a layer without a picture",
       [](RawClient& c) {
         c.frames(3);
         const XrTime time = c.begin();
         return c.end(time, c.projection(c.swapchain()).header());
       },
       XR_ERROR_LAYER_INVALID, "without a released image"},
      {"a layer that reaches out of its picture",
       frameWith([](auto& p) { p.views[1].subImage.imageRect.offset.x = 1; }), XR_ERROR_SWAPCHAIN_RECT_INVALID,
       "reaches out"},
      {"a layer turned by no rotation", frameWith([](auto& p) { p.views[0].pose.orientation.w = 0; }),
       XR_ERROR_POSE_INVALID, "not the length 1"},
      {"a layer for one eye", frameWith([](auto& p) { p.layer.viewCount = 1; }), XR_ERROR_VALIDATION_FAILURE,
       "has two views"},
      {"a layer of a slice that is not there", frameWith([](auto& p) { p.views[0].subImage.imageArrayIndex = 1; }),
       XR_ERROR_VALIDATION_FAILURE, "slice is none"},
      {"a layer in no space", frameWith([](auto& p) { p.layer.space = XR_NULL_HANDLE; }), XR_ERROR_HANDLE_INVALID,
       "nothing that exists"},
      {"a layer of no known kind", frameWith([](auto& p) { p.layer.type = XR_TYPE_COMPOSITION_LAYER_CUBE_KHR; }),
       XR_ERROR_LAYER_INVALID, "XR_TYPE_COMPOSITION_LAYER_CUBE_KHR"},
  };
}

std::vector<Misuse> imageMisuses() {
  return {
      {"an image is waited for that nobody acquired", [](RawClient& c) { return waitImage(c.swapchain()); },
       XR_ERROR_CALL_ORDER_INVALID, "no image is acquired"},
      {"an image is released that nobody acquired",
       [](RawClient& c) { return xrReleaseSwapchainImage(c.swapchain(), nullptr); }, XR_ERROR_CALL_ORDER_INVALID,
       "no image is acquired"},
      {"an image is released before it was waited for",
       [](RawClient& c) {
         const XrSwapchain swapchain = c.swapchain();
         uint32_t index = 0;
         xrAcquireSwapchainImage(swapchain, nullptr, &index);
         return xrReleaseSwapchainImage(swapchain, nullptr);
       },
       XR_ERROR_CALL_ORDER_INVALID, "before it was waited for"},
      {"more images than there are",
       [](RawClient& c) {
         const XrSwapchain swapchain = c.swapchain();
         uint32_t index = 0;
         for (int i = 0; i < 3; ++i) xrAcquireSwapchainImage(swapchain, nullptr, &index);
         return xrAcquireSwapchainImage(swapchain, nullptr, &index);
       },
       XR_ERROR_CALL_ORDER_INVALID, "all images are acquired"},
      {"a format that is not offered",
       [](RawClient& c) {
         try {
           c.swapchain(1);
         } catch (const ps::vr::Failure& failure) {
           return failure.result();
         }
         return XR_SUCCESS;
       },
       XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "not among those"},
      {"a swapchain that is gone",
       [](RawClient& c) {
         const XrSwapchain swapchain = c.swapchain();
         xrDestroySwapchain(swapchain);
         return waitImage(swapchain);
       },
       XR_ERROR_HANDLE_INVALID, "nothing that exists"},
  };
}

std::vector<Misuse> bindingMisuses() {
  constexpr auto kFloat = XR_ACTION_TYPE_FLOAT_INPUT;
  return {
      {"a path without a slash", [](RawClient& c) { return toPath(c, "user/hand/left"); }, XR_ERROR_PATH_FORMAT_INVALID,
       "is no path"},
      {"a path in capitals", [](RawClient& c) { return toPath(c, "/user/Hand"); }, XR_ERROR_PATH_FORMAT_INVALID,
       "is no path"},
      {"a path of dots", [](RawClient& c) { return toPath(c, "/user/../hand"); }, XR_ERROR_PATH_FORMAT_INVALID,
       "is no path"},
      {"a part that the controller has not",
       [](RawClient& c) {
         return c.suggest(kVive, c.action(c.actionSet(), "a", kFloat), "/user/hand/left/input/thumbstick/x");
       },
       XR_ERROR_PATH_UNSUPPORTED, "no such part"},
      {"a part of the other hand",
       [](RawClient& c) {
         return c.suggest("oculus/touch_controller", c.action(c.actionSet(), "a", kFloat),
                          "/user/hand/right/input/x/click");
       },
       XR_ERROR_PATH_UNSUPPORTED, "no such part"},
      {"a controller that nobody knows",
       [](RawClient& c) {
         return c.suggest("acme/stick", c.action(c.actionSet(), "a", kFloat), "/user/hand/left/input/a/click");
       },
       XR_ERROR_PATH_UNSUPPORTED, "is no interaction profile"},
      {"a controller whose extension is not enabled",
       [](RawClient& c) {
         return c.suggest("hp/mixed_reality_controller", c.action(c.actionSet(), "a", kFloat),
                          "/user/hand/left/input/squeeze/value");
       },
       XR_ERROR_PATH_UNSUPPORTED, "extension was not enabled"},
      {"a number from a pose",
       [](RawClient& c) {
         return c.suggest(kVive, c.action(c.actionSet(), "a", kFloat), "/user/hand/left/input/grip/pose");
       },
       XR_ERROR_PATH_UNSUPPORTED, "another kind"},
  };
}

std::vector<Misuse> actionMisuses() {
  constexpr auto kFloat = XR_ACTION_TYPE_FLOAT_INPUT;
  return {
      {"reading actions that are not attached", [](RawClient& c) { return c.sync({c.actionSet()}); },
       XR_ERROR_ACTIONSET_NOT_ATTACHED, "no action set is attached"},
      {"reading a set that is not attached",
       [](RawClient& c) {
         c.attach({c.actionSet("one")});
         return c.sync({c.actionSet("two")});
       },
       XR_ERROR_ACTIONSET_NOT_ATTACHED, "not attached to the session"},
      {"attaching twice",
       [](RawClient& c) {
         c.attach({c.actionSet("one")});
         return c.attach({c.actionSet("two")});
       },
       XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "attached once"},
      {"bindings after attaching",
       [](RawClient& c) {
         const XrActionSet set = c.actionSet();
         const XrAction action = c.action(set, "a", kFloat);
         c.attach({set});
         return c.suggest(kVive, action, "/user/hand/left/input/trigger/value");
       },
       XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "before the action set"},
      {"a number read as a button",
       [](RawClient& c) {
         const XrActionSet set = c.actionSet();
         const XrAction action = c.action(set, "a", kFloat);
         c.attach({set});
         const XrActionStateGetInfo info = c.stateInfo(action);
         auto state = structure<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
         return xrGetActionStateBoolean(c.handle(), &info, &state);
       },
       XR_ERROR_ACTION_TYPE_MISMATCH, "another type"},
      {"a hand that the action does not know",
       [](RawClient& c) {
         const XrActionSet set = c.actionSet();
         const XrAction action = c.action(set, "a", kFloat, false);
         c.attach({set});
         const XrActionStateGetInfo info = c.stateInfo(action, "/user/hand/left");
         auto state = structure<XrActionStateFloat>(XR_TYPE_ACTION_STATE_FLOAT);
         return xrGetActionStateFloat(c.handle(), &info, &state);
       },
       XR_ERROR_PATH_UNSUPPORTED, "does not declare it"},
  };
}

std::vector<Misuse> otherMisuses() {
  return {
      {"trembling too much",
       [](RawClient& c) {
         const XrActionSet set = c.actionSet();
         auto info = structure<XrHapticActionInfo>(XR_TYPE_HAPTIC_ACTION_INFO);
         info.action = c.action(set, "a", XR_ACTION_TYPE_VIBRATION_OUTPUT);
         c.attach({set});
         auto haptic = structure<XrHapticVibration>(XR_TYPE_HAPTIC_VIBRATION);
         haptic.amplitude = 2;
         haptic.duration = 1;
         return xrApplyHapticFeedback(c.handle(), &info, reinterpret_cast<const XrHapticBaseHeader*>(&haptic));
       },
       XR_ERROR_VALIDATION_FAILURE, "0 to 1"},
      {"places at no time",
       [](RawClient& c) {
         auto location = structure<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
         return xrLocateSpace(c.session().floor(), c.session().floor(), 0, &location);
       },
       XR_ERROR_TIME_INVALID, "must be positive"},
      {"a list without room",
       [](RawClient& c) {
         XrReferenceSpaceType type{};
         uint32_t count = 0;
         return xrEnumerateReferenceSpaces(c.handle(), 1, &count, &type);
       },
       XR_ERROR_SIZE_INSUFFICIENT, "no room for all"},
  };
}

}  // namespace

/// Whether the scripted runtime finds what breaks OpenXR's specification, answers it as that says, and tells.
class OpenXrMisuseTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase();
  void misuseIsFound_data();
  void misuseIsFound();
  void contextOfAnotherThreadIsFound();
  void requirementsMustBeAskedFor();
  void namesMustDiffer();

 private:
  HeadlessContext m_context{nullptr};
  std::vector<Misuse> m_misuses;
};

void OpenXrMisuseTest::initTestCase() {
  m_context.release();
  for (const auto& some : {frameMisuses(), timeMisuses(), layerMisuses(), imageMisuses(), bindingMisuses(),
                           actionMisuses(), otherMisuses()})
    m_misuses.insert(m_misuses.end(), some.begin(), some.end());
}

void OpenXrMisuseTest::misuseIsFound_data() {
  QTest::addColumn<size_t>("index");
  for (size_t i = 0; i < m_misuses.size(); ++i) QTest::newRow(m_misuses[i].name) << i;
}

void OpenXrMisuseTest::misuseIsFound() {
  QFETCH(size_t, index);
  const Misuse& misuse = m_misuses[index];
  const ScriptedRun run;
  {
    RawClient client(m_context);
    QCOMPARE(misuse.call(client), misuse.result);
  }
  m_context.release();
  const auto violations = run.texts("violation");
  QCOMPARE(violations.size(), size_t{1});
  QVERIFY2(violations[0].find(misuse.says) != std::string::npos, violations[0].c_str());
}

void OpenXrMisuseTest::contextOfAnotherThreadIsFound() {
  const ScriptedRun run;
  {
    RawClient client(m_context);
    const XrSwapchain swapchain = client.swapchain();
    XrResult result = XR_SUCCESS;
    std::thread([&] { result = xrDestroySwapchain(swapchain); }).join();  // the context is current on this thread
    QCOMPARE(result, XR_ERROR_RUNTIME_FAILURE);
    m_context.release();
    std::thread([&] { result = xrDestroySwapchain(swapchain); }).join();
    QCOMPARE(result, XR_SUCCESS);
    m_context.makeCurrent();
  }
  m_context.release();
  QCOMPARE(run.texts("violation"),
           std::vector<std::string>{"the session's OpenGL context is current on another thread"});
}

void OpenXrMisuseTest::requirementsMustBeAskedFor() {
  const ScriptedRun run;
  ps::vr::Runtime runtime({});
  auto info = structure<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
  info.systemId = runtime.system();
  XrSession session = XR_NULL_HANDLE;
  QCOMPARE(xrCreateSession(runtime.instance(), &info, &session), XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING);
}

void OpenXrMisuseTest::namesMustDiffer() {
  const ScriptedRun run;
  {
    RawClient client(m_context);
    const XrActionSet set = client.actionSet("one");
    client.action(set, "a", XR_ACTION_TYPE_BOOLEAN_INPUT);
    QVERIFY_EXCEPTION_THROWN(client.action(set, "a", XR_ACTION_TYPE_BOOLEAN_INPUT), ps::vr::Failure);
    QVERIFY_EXCEPTION_THROWN(client.action(set, "", XR_ACTION_TYPE_BOOLEAN_INPUT), ps::vr::Failure);
    QVERIFY_EXCEPTION_THROWN(client.action(set, "A b", XR_ACTION_TYPE_BOOLEAN_INPUT), ps::vr::Failure);
    QVERIFY_EXCEPTION_THROWN(client.actionSet("one"), ps::vr::Failure);
  }
  m_context.release();
  std::vector<std::string> results;
  for (const auto& line : run.lines("violation")) results.push_back(line["result"]);
  QCOMPARE(results, (std::vector<std::string>{"XR_ERROR_NAME_DUPLICATED", "XR_ERROR_NAME_INVALID",
                                              "XR_ERROR_PATH_FORMAT_INVALID", "XR_ERROR_NAME_DUPLICATED"}));
}

QTEST_GUILESS_MAIN(OpenXrMisuseTest)
#include "tst_openxrmisuse.moc"
