// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/rawclient.h"
#include "tests/vr/rawevents.h"
#include "tests/vr/scriptedrun.h"

#include <QElapsedTimer>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <cmath>

using ps::eventsOf;
using ps::HeadlessContext;
using ps::passFrame;
using ps::RawClient;
using ps::ScriptedRun;
using ps::vr::check;
using ps::vr::structure;

/// What the scripted runtime has beyond what the program asks of it by now, and its scripts.
class OpenXrRuntimeTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context.release(); }

  void quadsAndDepthsAreTold();
  void linearPicturesAreEncoded();
  void unendedFrameIsDiscarded();
  void refreshRateIsChosen();
  void hiddenMeshIsTurnedRight();
  void jointsAreWhereTheHandIs();
  void recentringMovesTheOrigin();
  void lostEventsAreTold();
  void framesMayLastAsLongAsTheySay();
  void documentedScriptIsRead();
  void badScriptsAreRefused_data();
  void badScriptsAreRefused();

 private:
  HeadlessContext m_context{nullptr};
};

void OpenXrRuntimeTest::quadsAndDepthsAreTold() {
  const ScriptedRun run;
  {
    RawClient client(m_context, {XR_KHR_COMPOSITION_LAYER_DEPTH_EXTENSION_NAME});
    client.frames(3);
    const XrSwapchain colour = client.swapchain(), depth = client.swapchain(GL_DEPTH_COMPONENT32F);
    const XrTime time = client.begin();
    client.show(colour);
    client.show(depth);
    RawClient::Projection projection = client.projection(colour);
    auto info = structure<XrCompositionLayerDepthInfoKHR>(XR_TYPE_COMPOSITION_LAYER_DEPTH_INFO_KHR);
    info.subImage = {depth, {{0, 0}, {16, 16}}, 0};
    info.maxDepth = 1;
    info.nearZ = 0.5f;
    info.farZ = 8;
    projection.views[1].next = &info;
    QCOMPARE(client.end(time, projection.header()), XR_SUCCESS);

    auto quad = structure<XrCompositionLayerQuad>(XR_TYPE_COMPOSITION_LAYER_QUAD);
    quad.space = client.session().floor();
    quad.subImage = {colour, {{4, 0}, {8, 16}}, 0};
    quad.pose = {{0, 0, 0, 1}, {0, 1, -2}};
    quad.size = {0.5f, 0.25f};
    QCOMPARE(client.end(client.begin(), reinterpret_cast<const XrCompositionLayerBaseHeader*>(&quad)), XR_SUCCESS);
  }
  m_context.release();
  QVERIFY(run.lines("violation").empty());
  const auto frames = run.lines("layers");
  const auto& views = frames[3]["layers"][0]["views"];
  QVERIFY(!views[0].contains("depth"));
  QCOMPARE(views[1]["depth"]["far"].get<double>(), 8.0);
  const auto& quad = frames[4]["layers"][0];
  QCOMPARE(quad["type"].get<std::string>(), std::string("quad"));
  QCOMPARE(quad["rect"].get<std::vector<int>>(), (std::vector<int>{4, 0, 8, 16}));
  QCOMPARE(quad["size"].get<std::vector<double>>(), (std::vector<double>{0.5, 0.25}));
}

void OpenXrRuntimeTest::linearPicturesAreEncoded() {
  const ScriptedRun run(R"({"pictures": [3]})");
  {
    RawClient client(m_context);
    client.frames(3);
    const XrSwapchain swapchain = client.swapchain(GL_RGBA16F);
    const XrTime time = client.begin();
    auto image = structure<XrSwapchainImageOpenGLKHR>(XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR);
    std::array<XrSwapchainImageOpenGLKHR, 3> images{image, image, image};
    uint32_t count = 0;
    check(
        xrEnumerateSwapchainImages(swapchain, 3, &count, reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())),
        "xrEnumerateSwapchainImages");
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, images[0].image, 0);
    glClearColor(0.5f, 0, 2, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    client.show(swapchain);
    QCOMPARE(client.end(time, client.projection(swapchain).header()), XR_SUCCESS);
    GLint bound = 0;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    QCOMPARE(static_cast<GLuint>(bound), framebuffer);
    glDeleteFramebuffers(1, &framebuffer);
  }
  m_context.release();
  // IEC 61966-2-1: half of the light is 188 of 255; more than all of it is cut.
  QCOMPARE(run.picture(3, 1).pixelColor(8, 8), QColor(188, 0, 255));
}

void OpenXrRuntimeTest::unendedFrameIsDiscarded() {
  const ScriptedRun run;
  {
    RawClient client(m_context);
    client.frames(1);
    client.begin();
    auto state = structure<XrFrameState>(XR_TYPE_FRAME_STATE);
    QCOMPARE(xrWaitFrame(client.handle(), nullptr, &state), XR_SUCCESS);
    QCOMPARE(xrBeginFrame(client.handle(), nullptr), XR_FRAME_DISCARDED);
    QCOMPARE(client.end(state.predictedDisplayTime, nullptr), XR_SUCCESS);
  }
  m_context.release();
  QVERIFY(run.lines("violation").empty());
}

void OpenXrRuntimeTest::refreshRateIsChosen() {
  const ScriptedRun run;
  {
    RawClient client(m_context, {XR_FB_DISPLAY_REFRESH_RATE_EXTENSION_NAME});
    const auto request = client.runtime().function<PFN_xrRequestDisplayRefreshRateFB>("xrRequestDisplayRefreshRateFB");
    client.frames(3);
    QCOMPARE(request(client.handle(), 1), XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB);
    QCOMPARE(request(client.handle(), 120), XR_SUCCESS);
    const auto events =
        eventsOf<XrEventDataDisplayRefreshRateChangedFB>(client, XR_TYPE_EVENT_DATA_DISPLAY_REFRESH_RATE_CHANGED_FB);
    QCOMPARE(events.size(), size_t{1});
    QCOMPARE(events[0].toDisplayRefreshRate, 120.0f);
    const XrTime first = client.begin();
    client.end(first, nullptr);
    const XrTime second = client.begin();
    client.end(second, nullptr);
    QCOMPARE(second - first, XrDuration{8'333'333});
  }
  m_context.release();
}

void OpenXrRuntimeTest::hiddenMeshIsTurnedRight() {
  const ScriptedRun run;
  {
    RawClient client(m_context, {XR_KHR_VISIBILITY_MASK_EXTENSION_NAME});
    const auto get = client.runtime().function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR");
    auto mask = structure<XrVisibilityMaskKHR>(XR_TYPE_VISIBILITY_MASK_KHR);
    const auto ask = [&] {
      return get(client.handle(), XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, 0,
                 XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR, &mask);
    };
    QCOMPARE(ask(), XR_SUCCESS);
    std::vector<XrVector2f> places(mask.vertexCountOutput);
    std::vector<uint32_t> indices(mask.indexCountOutput);
    mask.vertices = places.data();
    mask.indices = indices.data();
    mask.vertexCapacityInput = mask.vertexCountOutput;
    mask.indexCapacityInput = mask.indexCountOutput;
    QCOMPARE(ask(), XR_SUCCESS);
    QCOMPARE(indices.size(), size_t{12});
    for (size_t i = 0; i < indices.size(); i += 3) {
      const XrVector2f &a = places[indices[i]], &b = places[indices[i + 1]], &c = places[indices[i + 2]];
      QVERIFY((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0);  // counter-clockwise
      QVERIFY(std::abs(a.x) <= 1.001f && std::abs(a.y) <= 1.001f);         // tan(45 degrees)
    }
  }
  m_context.release();
}

/// A hand is where it aims from, in the floor's space; whoever asks for it wrongly hears of it.
void OpenXrRuntimeTest::jointsAreWhereTheHandIs() {
  const ScriptedRun run(R"({"keys": [{"frame": 0, "right": {"aim": [1, 1, -1], "joints": "point"}}]})");
  {
    RawClient client(m_context, {XR_EXT_HAND_TRACKING_EXTENSION_NAME});
    const auto create = client.runtime().function<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT");
    const auto locate = client.runtime().function<PFN_xrLocateHandJointsEXT>("xrLocateHandJointsEXT");
    auto info = structure<XrHandTrackerCreateInfoEXT>(XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
    std::array<XrHandTrackerEXT, 2> trackers{};
    QCOMPARE(create(client.handle(), &info, &trackers[0]), XR_ERROR_VALIDATION_FAILURE);  // of no hand
    for (const XrHandEXT hand : {XR_HAND_LEFT_EXT, XR_HAND_RIGHT_EXT}) {
      info.hand = hand;
      QCOMPARE(create(client.handle(), &info, &trackers[hand - XR_HAND_LEFT_EXT]), XR_SUCCESS);
    }
    client.frames(2);
    auto where = structure<XrHandJointsLocateInfoEXT>(XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT);
    where.baseSpace = client.session().floor();
    where.time = client.begin();
    std::array<XrHandJointLocationEXT, XR_HAND_JOINT_COUNT_EXT> joints{};
    auto all = structure<XrHandJointLocationsEXT>(XR_TYPE_HAND_JOINT_LOCATIONS_EXT);
    all.jointLocations = joints.data();
    all.jointCount = 3;
    QCOMPARE(locate(trackers[1], &where, &all), XR_ERROR_VALIDATION_FAILURE);
    all.jointCount = XR_HAND_JOINT_COUNT_EXT;
    QCOMPARE(locate(trackers[0], &where, &all), XR_SUCCESS);
    QVERIFY(!all.isActive && joints[0].locationFlags == 0);
    QCOMPARE(locate(trackers[1], &where, &all), XR_SUCCESS);
    QVERIFY(all.isActive);
    const XrVector3f &palm = joints[XR_HAND_JOINT_PALM_EXT].pose.position,
                     &tip = joints[XR_HAND_JOINT_INDEX_TIP_EXT].pose.position;
    QVERIFY(std::abs(palm.x - 1) < 1e-5f && std::abs(palm.y - 1) < 1e-5f && std::abs(palm.z + 1) < 1e-5f);
    QVERIFY(std::abs(tip.x - 0.975f) < 1e-5f && std::abs(tip.y - 1) < 1e-5f && std::abs(tip.z + 1.13f) < 1e-5f);
    client.end(where.time, nullptr);
    const auto destroy = client.runtime().function<PFN_xrDestroyHandTrackerEXT>("xrDestroyHandTrackerEXT");
    QCOMPARE(destroy(trackers[0]), XR_SUCCESS);
    QCOMPARE(locate(trackers[0], &where, &all), XR_ERROR_HANDLE_INVALID);
  }
  m_context.release();
  QCOMPARE(run.lines("violation").size(), size_t{3});
}

void OpenXrRuntimeTest::recentringMovesTheOrigin() {
  const ScriptedRun run(R"({"events": [{"frame": 4, "recentre": [1, 1.6, 0]}]})");
  {
    RawClient client(m_context);
    auto info = structure<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_LOCAL;
    info.poseInReferenceSpace.orientation.w = 1;
    XrSpace local = XR_NULL_HANDLE, stage = XR_NULL_HANDLE;
    check(xrCreateReferenceSpace(client.handle(), &info, &local), "local");
    info.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_STAGE;
    check(xrCreateReferenceSpace(client.handle(), &info, &stage), "stage");
    client.frames(4);
    passFrame(client);
    const auto events =
        eventsOf<XrEventDataReferenceSpaceChangePending>(client, XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING);
    QCOMPARE(events.size(), size_t{1});
    QCOMPARE(events[0].poseInPreviousSpace.position.x, 1.0f);
    auto location = structure<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    check(xrLocateSpace(local, stage, events[0].changeTime, &location), "locate");
    QCOMPARE(location.pose.position.x, 1.0f);
  }
  m_context.release();
}

void OpenXrRuntimeTest::lostEventsAreTold() {
  const ScriptedRun run(R"({"events": [{"frame": 3, "events_lost": 7}]})");
  {
    RawClient client(m_context);
    client.frames(3);
    passFrame(client);
    const auto events = eventsOf<XrEventDataEventsLost>(client, XR_TYPE_EVENT_DATA_EVENTS_LOST);
    QCOMPARE(events.size(), size_t{1});
    QCOMPARE(events[0].lostEventCount, 7u);
  }
  m_context.release();
}

void OpenXrRuntimeTest::framesMayLastAsLongAsTheySay() {
  const ScriptedRun run(R"({"real_time": true, "period": 0.05})");
  {
    RawClient client(m_context);
    client.frames(1);
    QElapsedTimer timer;
    timer.start();
    client.frames(4);
    QVERIFY2(timer.elapsed() >= 150, qPrintable(QString::number(timer.elapsed())));  // ms; three whole frames at least
  }
  m_context.release();
}

void OpenXrRuntimeTest::documentedScriptIsRead() {
  QFile page(PS_SOURCE_DIR "/tests/vr/runtime/README.md");
  QVERIFY(page.open(QFile::ReadOnly));
  const QString text = QString::fromUtf8(page.readAll());
  const QString begin = "```json\n";
  const qsizetype start = text.indexOf(begin) + begin.size();
  const ScriptedRun run(text.mid(start, text.indexOf("```", start) - start).toStdString());
  const ps::vr::Runtime runtime({});
  QVERIFY(run.lines("script").empty());
}

void OpenXrRuntimeTest::badScriptsAreRefused_data() {
  QTest::addColumn<QString>("script");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const char* script, const char* says) {
    QTest::newRow(name) << script << says;
  };
  row("no JSON", "{", "script.json");
  row("a list", "[]", "must be an object");
  row("unknown key", R"({"frames": 3})", "/frames: no such key");
  row("unknown profile", R"({"profile": "/interaction_profiles/a/b"})", "/profile: no such interaction profile");
  row("unknown event", R"({"events": [{"frame": 1, "explode": true}]})", "/events/0: says nothing that can happen");
  row("unknown part of an event", R"({"events": [{"frame": 1, "state": "IDLE", "loud": 1}]})",
      "/events/0/loud: no such");
  row("unknown state", R"({"events": [{"state": "READY"}]})", "/events/0/state: no such state");
  row("unknown result", R"({"events": [{"fail": "xrEndFrame", "result": "XR_OOPS"}]})", "/events/0/result: must be");
  row("short pose", R"({"keys": [{"frame": 0, "head": [1, 2]}]})", "/keys/0/head: must be x, y, z");
  row("skewed pose", R"({"keys": [{"frame": 0, "head": [1, 2, 3, 0, 0, 0, 0.5]}]})", "/keys/0/head: its quaternion");
  row("word for a number", R"({"keys": [{"frame": "one"}]})", "/keys/0/frame: must be a number");
  row("unknown part of a hand", R"({"keys": [{"frame": 0, "left": {"thumb": 1}}]})", "/keys/0/left/thumb: no such key");
  row("unknown format", R"({"formats": ["RGB565"]})", "/formats: no such format");
  row("unknown extension", R"({"extensions": ["XR_A_b"]})", "/extensions: cannot be offered");
}

void OpenXrRuntimeTest::badScriptsAreRefused() {
  QFETCH(QString, script);
  QFETCH(QString, says);
  const ScriptedRun run(script.toStdString());
  QVERIFY_EXCEPTION_THROWN(ps::vr::Runtime({}), ps::Error);
  const auto told = run.texts("script");
  QVERIFY(!told.empty());
  QVERIFY2(told[0].find(says.toStdString()) != std::string::npos, told[0].c_str());
}

QTEST_GUILESS_MAIN(OpenXrRuntimeTest)
#include "tst_openxrruntime.moc"
