// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "tests/vr/faults.h"
#include "tests/vr/scriptedrun.h"
#include "tests/vr/stay.h"
#include "ui/vr/detail.h"
#include "ui/vr/moving.h"

#include <QElapsedTimer>
#include <QTest>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

using ps::HeadlessContext;
using ps::PaintedScene;
using ps::ScriptedRun;
using ps::Stay;
using ps::stayInHeadset;
using ps::Vector3;

namespace {

constexpr double kSingle = 1e-5;  // m, rad: the runtime reckons in single precision

QByteArray joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : " ") + text;
  return QByteArray::fromStdString(all);
}

bool near(const Vector3& a, const Vector3& b, double tolerance = kSingle) { return (a - b).norm() <= tolerance; }

}  // namespace

/// The program's part of VR against the scripted runtime, through the real loader.
class HeadsetTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context.release(); }

  void entersAndLeaves();
  void eyesShowWhatWasDrawn();
  void eyesAreWhereTheHeadWillBe();
  void controllersAreUnderstood_data();
  void controllersAreUnderstood();
  void handsAreWhereTheyWillBe();
  void handsAreTakenAtTheirTime();
  void vibrationsReachTheHand();
  void focusLostLeavesThePicture();
  void takenOffIsNotTheEnd();
  void recentringIsTold_data();
  void recentringIsTold();
  void floorIsFound_data();
  void floorIsFound();
  void everyFaultEndsInASentence_data();
  void everyFaultEndsInASentence();
  void noRuntimeIsSaid();
  void contextThatIsTakenIsSaid();
  void sceneThatThrowsEndsTheStay();
  void fiftyStaysLeakNothing();
  void aRuntimeThatHangsIsLeft_data();
  void aRuntimeThatHangsIsLeft();
  void lateFramesCostSharpness();
  void lateHeadsetsShowSmallerPictures();
  void theOtherHandTakesItsWearerThere();
  void aBareHandPointsAndPinches();
  void gripsCarryUnlessAHandHasSomething();
  void aLoneHandGoesAndScales();
  void theEdgeIsDimmedWhileTheWearerMoves();
  void aRuntimeMayTakeTheContext();
  void aLeftHandedWearerGoesWithTheRight();

 private:
  HeadlessContext m_context{nullptr};
};

void HeadsetTest::entersAndLeaves() {
  const ScriptedRun run;
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.ending.has_value());
  QVERIFY2(!stay.ending->failed && stay.ending->sentence.empty(), stay.ending->sentence.c_str());
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  QCOMPARE(joined(run.texts("state")), QByteArray("IDLE READY SYNCHRONIZED VISIBLE FOCUSED VISIBLE SYNCHRONIZED "
                                                  "STOPPING IDLE EXITING"));
  QCOMPARE(joined(run.texts("session")), QByteArray("created begun ended destroyed"));
  QVERIFY(stay.frames >= 20);
  QCOMPARE(run.lines("layers").size(), stay.frames);
  QCOMPARE(stay.record.drawn.size(), 2 * stay.record.frames.size());
  // Two frames pass before there is something to show: after the first it is in step, after the second visible.
  const auto frames = run.lines("layers");
  QVERIFY(frames[0]["layers"].empty() && frames[1]["layers"].empty());
  QCOMPARE(frames[2]["layers"][0]["type"].get<std::string>(), std::string("projection"));
  QCOMPARE(frames[2]["layers"][0]["views"].size(), size_t{2});
}

void HeadsetTest::eyesShowWhatWasDrawn() {
  const ScriptedRun run(R"({"view": {"width": 64, "height": 48}, "pictures": [5]})");
  const Stay stay = stayInHeadset(m_context);
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    const QImage picture = run.picture(5, eye);
    QCOMPARE(picture.size(), QSize(64, 48));
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const bool block = x < PaintedScene::kBlockWidth && y >= picture.height() - PaintedScene::kBlockHeight;
        const auto& [r, g, b] = block ? PaintedScene::kBlock : PaintedScene::kGround[eye];
        QCOMPARE(picture.pixelColor(x, y), QColor(r, g, b));
      }
  }
  QVERIFY(run.picture(4, 0).isNull());
}

void HeadsetTest::eyesAreWhereTheHeadWillBe() {
  // Turned by 90 degrees to the left, the left eye is behind (z) of the right one, and the head moves along x.
  const ScriptedRun run(R"({"view": {"eye_distance": 0.06},
                            "keys": [{"frame": 0, "head": [0, 1.5, 0, 0, 0.70710678, 0, 0.70710678]},
                                     {"frame": 100, "head": [1, 1.5, 0, 0, 0.70710678, 0, 0.70710678]}]})");
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(!stay.record.frames.empty());
  for (size_t i = 0; i < stay.record.drawn.size(); ++i) {
    const auto& [eye, view, size] = stay.record.drawn[i];
    const size_t shown = i / 2;
    const double frame = double(shown) + 2;  // the first two are not shown
    QCOMPARE(eye, i % 2);
    const Vector3 wanted(frame / 100, 1.5, eye == 0 ? 0.03 : -0.03);
    QVERIFY2(near(ps::placeOf(view), wanted), qPrintable(QString::number(i)));
    QCOMPARE(size.width, 512);
  }
}

void HeadsetTest::controllersAreUnderstood_data() {
  QTest::addColumn<QString>("profile");
  QTest::addColumn<QString>("left");
  QTest::addColumn<QString>("right");
  QTest::addColumn<QString>("leftInput");
  QTest::addColumn<QString>("rightInput");
  const auto row = [](const char* name, const char* profile, const char* left, const char* right, const char* leftInput,
                      const char* rightInput) {
    QTest::newRow(name) << QString("/interaction_profiles/") + profile << left << right << leftInput << rightInput;
  };
  row("simple", "khr/simple_controller", R"({"/input/select/click": true})", R"({"/input/menu/click": true})", "draw 1",
      "menu");
  row("simple, the left one", "khr/simple_controller", R"({"/input/menu/click": true})",
      R"({"/input/select/click": true})", "menu", "draw 1");
  row("Vive", "htc/vive_controller", R"({"/input/trigger/value": 0.25, "/input/squeeze/click": true})",
      R"({"/input/trackpad/x": -0.5, "/input/trackpad/y": 0.75, "/input/trackpad/click": true, "/input/menu/click": true})",
      "draw 0.25 hold 1", "steer -0.5 0.75 pressed first");
  row("Touch", "oculus/touch_controller", R"({"/input/x/click": true, "/input/squeeze/value": 0.5})",
      R"({"/input/b/click": true, "/input/thumbstick/x": 1, "/input/trigger/value": 0.75})", "hold 0.5 first",
      "draw 0.75 steer 1 0 second");
  // What a hand around it touches is no grip.
  row("Index", "valve/index_controller",
      R"({"/input/a/click": true, "/input/trigger/value": 1, "/input/squeeze/value": 1})",
      R"({"/input/b/click": true, "/input/thumbstick/y": -1, "/input/thumbstick/click": true})", "draw 1 first",
      "steer 0 -1 pressed second");
  row("Index, gripped", "valve/index_controller", R"({"/input/squeeze/value": 1, "/input/squeeze/force": 0.75})",
      R"({"/input/squeeze/force": 0.5})", "hold 0.75", "hold 0.5");
  row("Windows", "microsoft/motion_controller", R"({"/input/trackpad/click": true, "/input/squeeze/click": true})",
      R"({"/input/menu/click": true, "/input/thumbstick/x": -1, "/input/thumbstick/y": 0.5})", "hold 1 first",
      "steer -1 0.5 second");
  row("HP", "hp/mixed_reality_controller", R"({"/input/x/click": true, "/input/squeeze/value": 0.5})",
      R"({"/input/b/click": true, "/input/trigger/value": 0.75})", "hold 0.5 first", "draw 0.75 second");
  row("Odyssey", "samsung/odyssey_controller", R"({"/input/trackpad/click": true, "/input/squeeze/click": true})",
      R"({"/input/menu/click": true, "/input/thumbstick/x": -1})", "hold 1 first", "steer -1 0 second");
  for (const auto& [name, profile] : {std::pair{"Touch Pro", "facebook/touch_controller_pro"},
                                      {"Touch Plus", "meta/touch_controller_plus"},
                                      {"Pico Neo 3", "bytedance/pico_neo3_controller"},
                                      {"Pico 4", "bytedance/pico4_controller"}})
    row(name, profile, R"({"/input/x/click": true, "/input/squeeze/value": 0.5})",
        R"({"/input/b/click": true, "/input/thumbstick/x": 1, "/input/trigger/value": 0.75})", "hold 0.5 first",
        "draw 0.75 steer 1 0 second");
  row("Focus 3", "htc/vive_focus3_controller", R"({"/input/y/click": true, "/input/squeeze/click": true})",
      R"({"/input/a/click": true, "/input/thumbstick/x": 1})", "hold 1 second", "steer 1 0 first");
  row("Cosmos", "htc/vive_cosmos_controller", R"({"/input/y/click": true, "/input/squeeze/click": true})",
      R"({"/input/a/click": true, "/input/thumbstick/x": 1})", "hold 1 second", "steer 1 0 first");
  row("hands, as Microsoft has them", "microsoft/hand_interaction", R"({"/input/select/value": 0.75})",
      R"({"/input/squeeze/value": 1})", "draw 0.75", "hold 1");
  row("hands", "ext/hand_interaction_ext", R"({"/input/pinch_ext/value": 0.75})",
      R"({"/input/pinch_ext/value": 0.25, "/input/grasp_ext/value": 1})", "draw 0.75", "draw 0.25 hold 1");
}

static QString inWords(const ps::vr::HandInput& input) {
  QStringList words;
  if (input.draw != 0) words << QString("draw %1").arg(input.draw);
  if (input.hold != 0) words << QString("hold %1").arg(input.hold);
  if (input.steerX != 0 || input.steerY != 0) words << QString("steer %1 %2").arg(input.steerX).arg(input.steerY);
  if (input.steerPressed) words << "pressed";
  if (input.first) words << "first";
  if (input.second) words << "second";
  if (input.menu) words << "menu";
  return words.join(' ');
}

void HeadsetTest::controllersAreUnderstood() {
  QFETCH(QString, profile);
  QFETCH(QString, left);
  QFETCH(QString, right);
  QFETCH(QString, leftInput);
  QFETCH(QString, rightInput);
  const QString script = R"({"profile": "%1", "keys": [{"frame": 8, "left": %2, "right": %3}]})";
  const ScriptedRun run(script.arg(profile, left, right).toStdString());
  const Stay stay = stayInHeadset(m_context);
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  QVERIFY(stay.record.frames.size() >= 20);
  QCOMPARE(inWords(stay.record.frames[4].hands[0]), QString());
  QCOMPARE(inWords(stay.record.frames[18].hands[0]), leftInput);
  QVERIFY(stay.record.frames[18].hands[0].aim && stay.record.frames[18].hands[1].grip);
  QCOMPARE(inWords(stay.record.frames[18].hands[1]), rightInput);
}

void HeadsetTest::handsAreWhereTheyWillBe() {
  // 90 frames a second, 0.9 m in 90 frames. The aim stands 0.1 m before the grip's start, and points up.
  const ScriptedRun run(R"({"keys": [
      {"frame": 0, "right": {"grip": [0, 1, 0], "aim": [0, 1, -0.1, 0.70710678, 0, 0, 0.70710678]}},
      {"frame": 90, "right": {"grip": [0.9, 1, 0]}}]})");
  const Stay stay = stayInHeadset(m_context);
  const auto& frames = stay.record.frames;
  QVERIFY(frames.size() >= 20);
  for (size_t i = 4; i < 20; ++i) {
    const auto& hand = frames[i].hands[ps::vr::kRight];
    QVERIFY(frames[i].focused && hand.grip && hand.aim);
    QVERIFY(near(hand.grip->position, {0.01 * double(i + 2), 1, 0}));
    QVERIFY(near(hand.aim->position, {0, 1, -0.1}));
    QVERIFY(near(hand.aim->orientation * Vector3(0, 0, -1), {0, 1, 0}));
    QVERIFY(std::abs(frames[i].time - frames[i - 1].time - frames[i].period) < 1e-9);
  }
}

void HeadsetTest::handsAreTakenAtTheirTime() {
  const ScriptedRun run(R"({"keys": [{"frame": 8, "left": {"active": false}},
                                     {"frame": 14, "left": {"active": true}}]})");
  const Stay stay = stayInHeadset(m_context);
  const auto& frames = stay.record.frames;
  QVERIFY(frames.size() >= 20);
  for (size_t i = 2; i < 20; ++i) {  // frame i + 2 of the clock
    QCOMPARE(frames[i].hands[ps::vr::kLeft].grip.has_value(), i + 2 < 8 || i + 2 >= 14);
    QVERIFY(frames[i].hands[ps::vr::kRight].grip.has_value());
  }
  QCOMPARE(run.lines("profiles").size(), size_t{3});
}

void HeadsetTest::vibrationsReachTheHand() {
  const ScriptedRun run;
  ps::StayPlan plan;
  plan.before = [](size_t frame) {
    std::array<std::optional<ps::vr::Vibration>, 2> feel;
    if (frame == 10) feel[ps::vr::kRight] = ps::vr::Vibration{0.25, 160, 0.02};
    return feel;
  };
  stayInHeadset(m_context, plan);
  const auto felt = run.lines("haptic");
  QCOMPARE(felt.size(), size_t{1});
  QCOMPARE(felt[0]["haptic"].get<std::string>(), std::string("/user/hand/right/output/haptic"));
  QCOMPARE(felt[0]["amplitude"].get<double>(), 0.25);
  QCOMPARE(felt[0]["frequency"].get<double>(), 160.0);
  QVERIFY(std::abs(felt[0]["duration"].get<double>() - 0.02) < 1e-9);
  QCOMPARE(felt[0]["frame"].get<int>(), 12);
}

void HeadsetTest::focusLostLeavesThePicture() {
  const ScriptedRun run(R"({"events": [{"frame": 8, "state": "VISIBLE"}, {"frame": 14, "state": "FOCUSED"}]})");
  const Stay stay = stayInHeadset(m_context);
  const auto& frames = stay.record.frames;
  QVERIFY(frames.size() >= 20);
  // An event of frame 8 is read after frame 8, and drawn with from 9 on; 15 frames later likewise.
  QVERIFY(frames[4].focused && frames[4].hands[0].grip);
  QVERIFY(!frames[8].focused && !frames[8].hands[0].grip && !frames[8].hands[1].grip);
  QVERIFY(frames[18].focused && frames[18].hands[0].grip);
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  QVERIFY(!stay.ending->failed);
}

void HeadsetTest::takenOffIsNotTheEnd() {
  const ScriptedRun run(R"({"events": [{"frame": 8, "state": "IDLE"}, {"frame": 30, "state": "FOCUSED"}]})");
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.ending && !stay.ending->failed);
  QCOMPARE(joined(run.texts("session")), QByteArray("created begun ended begun ended destroyed"));
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  QVERIFY(stay.record.frames.size() >= 20);
}

void HeadsetTest::recentringIsTold_data() {
  QTest::addColumn<QString>("extension");
  QTest::addColumn<bool>("stage");
  QTest::newRow("the floor below where one stands") << R"(, "XR_EXT_local_floor")" << true;
  QTest::newRow("the stage, which stays") << "" << true;
  QTest::newRow("none") << "" << false;
}

/// Once. In that frame no hand is seen; what it holds it has to let go before it does anything again.
void HeadsetTest::recentringIsTold() {
  QFETCH(QString, extension);
  QFETCH(bool, stage);
  const QString script = R"({"extensions": ["XR_KHR_opengl_enable", "XR_MNDX_egl_enable"%1], "stage": %2,
                             "profile": "/interaction_profiles/oculus/touch_controller",
                             "events": [{"frame": 8, "recentre": [2, 1.2, 0]}],
                             "keys": [{"frame": 0, "right": {"grip": [0.2, 1.2, -0.4], "/input/squeeze/value": 1,
                                                             "/input/trigger/value": 1}},
                                      {"frame": 12, "right": {"/input/squeeze/value": 0, "/input/trigger/value": 0}},
                                      {"frame": 14, "right": {"/input/trigger/value": 1}}]})";
  const ScriptedRun run(script.arg(extension, stage ? "true" : "false").toStdString());
  const Stay stay = stayInHeadset(m_context);
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  const auto& frames = stay.record.frames;
  const auto isTold = [](const ps::vr::HeadsetFrame& frame) { return frame.recentred; };
  QCOMPARE(std::count_if(frames.begin(), frames.end(), isTold), std::ptrdiff_t{1});
  const auto told = std::find_if(frames.begin(), frames.end(), isTold);
  QVERIFY(told - frames.begin() > 4 && frames.end() - told > 8);
  const auto right = [](const ps::vr::HeadsetFrame& frame) { return frame.hands[ps::vr::kRight]; };
  const auto isSeen = [&](const ps::vr::HeadsetFrame& frame) { return right(frame).grip && right(frame).aim; };
  const auto doesNothing = [&](const ps::vr::HeadsetFrame& frame) {
    return right(frame).draw == 0 && right(frame).hold == 0;
  };
  QVERIFY(isSeen(*(told - 1)) && right(*(told - 1)).draw > 0.9 && right(*(told - 1)).hold > 0.9);
  QVERIFY(!isSeen(*told) && !right(*told).grip && doesNothing(*told));
  QVERIFY(isSeen(*(told + 1)) && doesNothing(*(told + 1)));
  QVERIFY(isSeen(*(told + 7)) && right(*(told + 7)).draw > 0.9);
}

void HeadsetTest::floorIsFound_data() {
  QTest::addColumn<QString>("extension");
  QTest::addColumn<bool>("stage");
  QTest::addColumn<double>("x");
  QTest::addColumn<double>("y");
  QTest::newRow("the floor below where one stands") << R"(, "XR_EXT_local_floor")" << true << 0.5 << 1.0;
  QTest::newRow("without a stage") << R"(, "XR_EXT_local_floor")" << false << 0.5 << 1.0;
  QTest::newRow("the stage") << "" << true << 2.5 << 1.0;
  // The eyes are at 1.2 m, and are taken to be at 1.6.
  QTest::newRow("none") << "" << false << 0.5 << 1.4;
}

void HeadsetTest::floorIsFound() {
  QFETCH(QString, extension);
  QFETCH(bool, stage);
  QFETCH(double, x);
  QFETCH(double, y);
  // The place where one sits is 2 m to the side in the stage.
  const QString script = R"({"extensions": ["XR_KHR_opengl_enable", "XR_MNDX_egl_enable"%1], "stage": %2,
                             "events": [{"recentre": [2, 1.2, 0]}],
                             "keys": [{"frame": 0, "left": {"grip": [2.5, 1, 0]}}]})";
  const ScriptedRun run(script.arg(extension, stage ? "true" : "false").toStdString());
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.record.frames.size() >= 20);
  QVERIFY(near(stay.record.frames[10].hands[0].grip->position, {x, y, 0}));
}

void HeadsetTest::everyFaultEndsInASentence_data() {
  ps::addFaultRows();
  QTest::newRow("software does not start")
      << R"({"events": [{"fail": "xrCreateInstance", "result": "XR_ERROR_RUNTIME_UNAVAILABLE"}]})"
      << "No OpenXR runtime runs";
  QTest::newRow("no EGL") << R"({"extensions": ["XR_KHR_opengl_enable"]})"
                          << "takes no pictures of EGL";
}

void HeadsetTest::everyFaultEndsInASentence() {
  QFETCH(QString, script);
  QFETCH(QString, sentence);
  m_context.makeCurrent();
  const size_t before = ps::countGlObjects();
  m_context.release();
  {
    const ScriptedRun run(script.toStdString());
    ps::StayPlan plan;
    plan.leaveAfter = 60;
    const Stay stay = stayInHeadset(m_context, plan);
    QVERIFY(stay.ending.has_value());
    QCOMPARE(stay.ending->failed, !sentence.isEmpty());
    const QString said = QString::fromStdString(stay.ending->sentence);
    QVERIFY2(said.contains(sentence), qPrintable(said));
    if (stay.ending->failed) QVERIFY2(said.endsWith('.') && said[0].isUpper(), qPrintable(said));
    QCOMPARE(joined(run.texts("violation")), QByteArray());
    const auto ends = run.lines("textures");
    if (!ends.empty()) QCOMPARE(ends.back()["textures"].get<int>(), 0);
  }
  m_context.makeCurrent();
  QCOMPARE(ps::countGlObjects(), before);
  m_context.release();
  const ScriptedRun again;
  const Stay stay = stayInHeadset(m_context);
  QVERIFY2(stay.ending && !stay.ending->failed, stay.ending ? stay.ending->sentence.c_str() : "no end");
  QVERIFY(stay.record.frames.size() >= 20);
}

void HeadsetTest::noRuntimeIsSaid() {
  const ScriptedRun run;
  qputenv("XR_RUNTIME_JSON", run.file("none.json").toUtf8());
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.ending && stay.ending->failed);
  QVERIFY2(stay.ending->sentence.find("No OpenXR runtime runs here") == 0, stay.ending->sentence.c_str());
}

void HeadsetTest::contextThatIsTakenIsSaid() {
  const ScriptedRun run;
  m_context.makeCurrent();  // on this thread, not on the headset's
  const Stay stay = stayInHeadset(m_context);
  m_context.release();
  QVERIFY(stay.ending && stay.ending->failed);
  QVERIFY2(stay.ending->sentence.find("OpenGL") != std::string::npos, stay.ending->sentence.c_str());
  QVERIFY(run.lines("session").empty());
}

void HeadsetTest::sceneThatThrowsEndsTheStay() {
  const ScriptedRun run;
  ps::StayPlan plan;
  plan.before = [](size_t frame) -> std::array<std::optional<ps::vr::Vibration>, 2> {
    if (frame == 5) throw ps::Error("The driver has no memory left.");
    return {};
  };
  const Stay stay = stayInHeadset(m_context, plan);
  QVERIFY(stay.ending && stay.ending->failed);
  QCOMPARE(stay.ending->sentence, std::string("The driver has no memory left."));
  QCOMPARE(run.lines("textures").back()["textures"].get<int>(), 0);
}

void HeadsetTest::fiftyStaysLeakNothing() {
  const ScriptedRun run(R"({"view": {"width": 64, "height": 64}})");
  ps::StayPlan plan;
  plan.leaveAfter = 3;
  stayInHeadset(m_context, plan);
  m_context.makeCurrent();
  const size_t objects = ps::countGlObjects(), threads = ps::countThreads();
  m_context.release();
  for (int i = 0; i < 50; ++i) {
    const Stay stay = stayInHeadset(m_context, plan);
    QVERIFY(stay.ending && !stay.ending->failed);
  }
  m_context.makeCurrent();
  QCOMPARE(ps::countGlObjects(), objects);
  QCOMPARE(ps::countThreads(), threads);
  m_context.release();
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  QCOMPARE(run.lines("textures").size(), size_t{51});
}

void HeadsetTest::aRuntimeThatHangsIsLeft_data() {
  QTest::addColumn<QString>("in");
  QTest::addColumn<int>("frames");
  // Frame 10 comes by the eleventh call of the first.
  QTest::newRow("waiting") << "xrWaitFrame" << 11;
  QTest::newRow("submitting") << "xrEndFrame" << 10;
  QTest::newRow("listening") << "xrPollEvent" << 11;
  QTest::newRow("drawing") << "xrAcquireSwapchainImage" << 10;
}

/// For longer than anybody waits: it is said, whoever leaves is not kept, and what it had goes when
/// it comes back after all.
void HeadsetTest::aRuntimeThatHangsIsLeft() {
  QFETCH(QString, in);
  QFETCH(int, frames);
  const ScriptedRun run(QStringLiteral(R"({"view": {"width": 64, "height": 64}, "events": [)"
                                       R"({"frame": 10, "hangs": "%1", "milliseconds": 12000}]})")
                            .arg(in)
                            .toStdString());
  const auto context = std::make_shared<HeadlessContext>(nullptr);
  context->release();
  const size_t threads = ps::countThreads();
  // What its thread may yet use after this test has gone on.
  const auto record = std::make_shared<ps::SceneRecord>();
  ps::vr::HeadsetSetup setup;
  setup.makeCurrent = [context] { context->makeCurrent(); };
  setup.release = [context] { context->release(); };
  setup.makeScene = [record] {
    return std::make_unique<PaintedScene>(*record,
                                          [](size_t) { return std::array<std::optional<ps::vr::Vibration>, 2>{}; });
  };
  QElapsedTimer left;
  {
    ps::vr::Headset headset(setup);
    QTRY_VERIFY_WITH_TIMEOUT(headset.frames() == uint64_t(frames) && !headset.answers(), 20000);
    QVERIFY(!headset.ending());  // it may come back
    left.start();
    headset.leave();
    QTRY_VERIFY_WITH_TIMEOUT(headset.ending(), 3000);
    QVERIFY(headset.ending()->failed);
    QVERIFY2(headset.ending()->sentence.find("did not answer") != std::string::npos,
             headset.ending()->sentence.c_str());
  }
  QVERIFY2(left.elapsed() < 3500, qPrintable(QString::number(left.elapsed())));
  QTRY_COMPARE_WITH_TIMEOUT(ps::countThreads(), threads, 20000);
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  QCOMPARE(run.lines("textures").back()["textures"].get<int>(), 0);
  const ScriptedRun again;
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.ending && !stay.ending->failed);
}

/// A few late ones do not count, most of a second does; it comes back where there is time for twice as much.
void HeadsetTest::lateFramesCostSharpness() {
  constexpr double kPeriod = 1.0 / 90;
  ps::vr::Detail detail;
  const auto frames = [&](int count, double share) {
    for (int i = 0; i < count; ++i) detail.note(share * kPeriod, kPeriod);
  };
  for (int i = 0; i < 30; ++i) frames(20, 0.8), frames(10, 1.5);
  QCOMPARE(detail.scale(), 1.0);
  ps::vr::Detail late;
  for (int i = 0; i < 95; ++i) late.note(1.2 * kPeriod, kPeriod);
  QCOMPARE(late.scale(), 1.0);
  QCOMPARE(late.coarser(), 0);
  late.note(1.2 * kPeriod, kPeriod);
  QCOMPARE(late.coarser(), 1);
  QCOMPARE(late.scale(), 1.0);  // what is soft goes first
  for (int i = 0; i < 96; ++i) late.note(1.2 * kPeriod, kPeriod);
  QCOMPARE(late.scale(), 0.85);
  for (int i = 0; i < 1000; ++i) late.note(1.2 * kPeriod, kPeriod);
  QCOMPARE(late.scale(), 0.5);
  QCOMPARE(late.coarser(), ps::kSoftSteps);
  for (int i = 0; i < 2000; ++i) late.note(0.8 * kPeriod, kPeriod);
  QCOMPARE(late.scale(), 0.5);  // in time, but with nothing to spare
  for (int i = 0; i < 450; ++i) late.note(0.4 * kPeriod, kPeriod);
  QCOMPARE(late.scale(), 0.6);
}

/// A scene that takes 15 ms of 10: the layers name a smaller part of each picture, and that is what was drawn.
void HeadsetTest::lateHeadsetsShowSmallerPictures() {
  const ScriptedRun run(R"({"real_time": true, "period": 0.01, "view": {"width": 100, "height": 80}})");
  ps::StayPlan plan;
  plan.leaveAfter = 240;
  plan.before = [](size_t) -> std::array<std::optional<ps::vr::Vibration>, 2> {
    std::this_thread::sleep_for(std::chrono::milliseconds(15));
    return {};
  };
  const Stay stay = stayInHeadset(m_context, plan);
  QVERIFY(stay.ending && !stay.ending->failed);
  QCOMPARE(joined(run.texts("violation")), QByteArray());
  const auto& drawn = stay.record.drawn;
  QCOMPARE(drawn.front().size.width, 100);
  QCOMPARE(drawn.back().size.width, 85);
  QCOMPARE(drawn.back().size.height, 68);
}

/// The stick forward shows where; let go, what was there is below the head, and nothing else about the scene has
/// changed.
void HeadsetTest::theOtherHandTakesItsWearerThere() {
  ps::vr::Moving moving;
  ps::vr::HeadsetFrame frame;
  frame.period = 0.01;
  frame.head.position = {0.2, 1.6, 0.1};
  ps::vr::HandInput& left = frame.hands[ps::vr::kLeft];
  left.aim = ps::vr::HandPose{{0, 1, 0}, ps::Quaternion(Eigen::AngleAxisd(-M_PI / 4, Vector3::UnitX()))};
  left.steerY = 1;
  moving.follow(frame);
  QVERIFY(moving.goal() && near(*moving.goal(), {0, 0, -1}, 1e-12));
  const Vector3 there = moving.stand().toScene(*moving.goal());
  left.steerY = 0;
  moving.follow(frame);
  QVERIFY(!moving.goal() && moving.dims());
  QVERIFY(near(moving.stand().toRoom(there), {0.2, 0, 0.1}, 1e-12));
  QCOMPARE(moving.stand().scale, 1.0);
  // Up into the air there is nowhere to go.
  left.aim->orientation = ps::Quaternion(Eigen::AngleAxisd(M_PI / 4, Vector3::UnitX()));
  left.steerY = 1;
  const Vector3 stood = moving.stand().toRoom(Vector3::Zero());
  moving.follow(frame);
  left.steerY = 0;
  for (int i = 0; i < 20; ++i) moving.follow(frame);
  QVERIFY(!moving.dims());
  QCOMPARE(moving.stand().toRoom(Vector3::Zero()), stood);
}

/// It points, and then pinches; opened instead, or after a while, it stays. Its pinch draws nothing.
void HeadsetTest::aBareHandPointsAndPinches() {
  using ps::vr::kLeft;
  ps::vr::Moving moving;
  ps::vr::HeadsetFrame frame;
  frame.period = 0.01;
  frame.head.position = {0.2, 1.6, 0.1};
  ps::vr::HandInput& left = frame.hands[kLeft];
  left.aim = ps::vr::HandPose{{0, 1, 0}, ps::Quaternion(Eigen::AngleAxisd(-M_PI / 4, Vector3::UnitX()))};
  const auto after = [&](double seconds, bool points, double pinch) {
    frame.time += seconds;
    left.points = points;
    left.draw = pinch;
    moving.follow(frame);
  };
  after(0.01, true, 0);
  QVERIFY(moving.goal() && near(*moving.goal(), {0, 0, -1}, 1e-12) && moving.takes(kLeft));
  left.aim->orientation = ps::Quaternion(Eigen::AngleAxisd(-M_PI / 3, Vector3::UnitX()));  // the index comes down
  after(0.1, false, 0.3);
  QVERIFY(moving.goal() && near(*moving.goal(), {0, 0, -1}, 1e-12));
  const Vector3 there = moving.stand().toScene(*moving.goal());
  after(0.1, false, 1);
  QVERIFY(!moving.goal() && moving.dims() && moving.takes(kLeft));
  QVERIFY(near(moving.stand().toRoom(there), {0.2, 0, 0.1}, 1e-12));
  after(0.1, false, 1);
  QVERIFY(moving.takes(kLeft));  // the same pinch
  after(0.1, false, 0);
  QVERIFY(!moving.takes(kLeft));
  const Vector3 stood = moving.stand().toRoom(Vector3::Zero());
  after(0.1, true, 0);
  after(0.1, false, 0);
  QVERIFY(moving.goal());
  after(0.7, false, 0);
  QVERIFY(!moving.goal() && !moving.takes(kLeft));
  after(0.1, false, 1);
  QVERIFY(!moving.takes(kLeft) && !moving.takes(ps::vr::kRight));
  QCOMPARE(moving.stand().toRoom(Vector3::Zero()), stood);
}

/// Both grips carry the scene where they came together, or with empty hands; afterwards each has to be let go first. A
/// scene that came beyond the scales that hands reach does not jump.
void HeadsetTest::gripsCarryUnlessAHandHasSomething() {
  using ps::vr::kLeft, ps::vr::kRight;
  const std::array<bool, 2> empty{}, keepsLeft{true, false};
  const auto after = [](ps::vr::Moving& moving, ps::vr::HeadsetFrame& frame, double left, double right,
                        const std::array<bool, 2>& keeps) {
    frame.time += 0.1;
    for (const size_t hand : {kLeft, kRight}) {
      frame.hands[hand].grip = ps::vr::HandPose{{hand == kLeft ? -0.2 : 0.2, 1, 0}, ps::Quaternion::Identity()};
      frame.hands[hand].hold = hand == kLeft ? left : right;
    }
    moving.follow(frame, {}, false, keeps);
  };
  ps::vr::HeadsetFrame frame;
  ps::vr::Moving moving;
  after(moving, frame, 1, 0, empty);
  after(moving, frame, 1, 1, keepsLeft);
  QVERIFY(moving.carries());  // what it took just now is put back
  after(moving, frame, 1, 0, empty);
  QVERIFY(!moving.carries() && moving.usesGrip(kLeft) && !moving.usesGrip(kRight));
  after(moving, frame, 0, 0, empty);
  QVERIFY(!moving.usesGrip(kLeft));
  for (int k = 0; k < 5; ++k) after(moving, frame, 1, 0, keepsLeft);
  after(moving, frame, 1, 1, keepsLeft);
  QVERIFY(!moving.carries() && !moving.usesGrip(kRight));
  after(moving, frame, 0, 0, empty);
  for (int k = 0; k < 5; ++k) after(moving, frame, 1, 0, empty);
  after(moving, frame, 1, 1, empty);
  QVERIFY(moving.carries());
  ps::vr::Stand wide;
  wide.scale = 0.01;
  const std::array<Vector3, 2> hands{Vector3(-0.2, 1, 0), Vector3(0.2, 1, 0)};
  QCOMPARE(ps::vr::carried(wide, hands, hands).scale, 0.01);
  const std::array<Vector3, 2> apart{Vector3(-4, 1, 0), Vector3(4, 1, 0)}, near{Vector3(-0.1, 1, 0), hands[1]};
  QVERIFY(std::abs(ps::vr::carried(wide, hands, apart).scale - 0.2) < 1e-12);
  QCOMPARE(ps::vr::carried(wide, hands, near).scale, 0.01);
}

/// By its stick, with its grip pressed: to where it points, and the scene larger or smaller about it. Without the grip
/// the stick is the brush's, and turns.
void HeadsetTest::aLoneHandGoesAndScales() {
  using ps::vr::kRight;
  const ps::vr::HandRoles roles{kRight, true};
  ps::vr::Moving moving;
  ps::vr::HeadsetFrame frame;
  frame.head.position = {0.2, 1.6, 0.1};
  ps::vr::HandInput& hand = frame.hands[kRight];
  hand.grip = hand.aim = ps::vr::HandPose{{0, 1, 0}, ps::Quaternion(Eigen::AngleAxisd(-M_PI / 4, Vector3::UnitX()))};
  const auto after = [&](double hold, double right, double forward, bool busy = false) {
    frame.time += 0.01;
    hand.hold = hold;
    hand.steerX = right;
    hand.steerY = forward;
    moving.follow(frame, roles, busy);
  };
  after(0, 0, 1);
  QVERIFY(!moving.goal() && !moving.steers(kRight, hand));
  after(1, 0, 1);
  QVERIFY(moving.goal() && near(*moving.goal(), {0, 0, -1}, 1e-12) && moving.steers(kRight, hand));
  const Vector3 there = moving.stand().toScene(*moving.goal());
  after(1, 0, 0);
  QVERIFY(near(moving.stand().toRoom(there), {0.2, 0, 0.1}, 1e-12));
  const Vector3 held = moving.stand().toScene(hand.grip->position);
  const double scale = moving.stand().scale;
  for (const double aside : {1.0, 1.0, 0.0, 1.0, 0.0}) after(1, aside, 0);
  QVERIFY(std::abs(moving.stand().scale / scale - 1.25 * 1.25) < 1e-9 && moving.stand().turn == 0);
  QVERIFY(near(moving.stand().toRoom(held), hand.grip->position, 1e-9));
  for (const double aside : {-1.0, 0.0, -1.0, 0.0}) after(1, aside, 0);
  QVERIFY(std::abs(moving.stand().scale / scale - 1) < 1e-9);
  // Where it points at a panel the stick is that panel's.
  for (const double aside : {1.0, 0.0, -1.0, 0.0}) after(1, aside, 0, true);
  after(1, 0, 1, true);
  QVERIFY(std::abs(moving.stand().scale / scale - 1) < 1e-9 && !moving.goal());
  after(1, 0, 0);
  after(0, 1, 0);
  QVERIFY(std::abs(std::abs(moving.stand().turn) - M_PI / 6) < 1e-12);
}

/// By 60 % at its corners and not at all in its middle, before both eyes, and for as long as one moves: a step by the
/// stick lasts for 0.15 s.
void HeadsetTest::theEdgeIsDimmedWhileTheWearerMoves() {
  using ps::vr::kLeft, ps::vr::kRight;
  ps::vr::Moving moving;
  ps::vr::HeadsetFrame frame;
  frame.period = 0.02;
  frame.head.position = {0.2, 1.6, 0.1};
  const auto panels = [&] {
    ps::Props props;
    moving.addTo(props, frame, {});
    return props.panels;
  };
  const auto after = [&](double right) {
    frame.hands[kRight].steerX = right;
    moving.follow(frame);
    return panels().size();
  };
  QCOMPARE(after(0), size_t{0});
  QCOMPARE(after(1), size_t{1});
  const ps::Panel panel = panels().front();
  const auto alpha = [&](double x, double y) {
    const auto at = [](double share, int side) { return static_cast<int>(share * (side - 1)); };
    const int width = panel.image->width;
    return int(panel.image->pixels[size_t(4 * (at(y, panel.image->height) * width + at(x, width)) + 3)]);
  };
  for (const double end : {0.0, 1.0}) QCOMPARE(alpha(end, 1 - end), 153);
  QCOMPARE(alpha(0.5, 0.5), 0);
  QVERIFY(alpha(0.75, 0.5) > 0 && alpha(0.75, 0.5) < alpha(0.95, 0.5));
  // Upright before the eyes, and as wide as they see: by 63 degrees to each side.
  Vector3 middle(0, 0, 0);
  for (const Vector3& corner : panel.corners) middle += moving.stand().toRoom(corner) / 4;
  const Vector3 lowerLeft = moving.stand().toRoom(panel.corners[0]);
  QVERIFY(near(middle - frame.head.position, {0, 0, -0.3}, 1e-9));
  QVERIFY(near(lowerLeft - middle, {-0.6, -0.6, 0}, 1e-9));
  int frames = 1;  // the stick is let go by the next one
  for (; frames < 20 && after(0) > 0; ++frames) {
  }
  QCOMPARE(frames, 8);
  // Both grips carry: as long as they do.
  for (const size_t hand : {kLeft, kRight}) {
    frame.hands[hand].grip = ps::vr::HandPose{{hand == kLeft ? -0.2 : 0.2, 1, 0}, ps::Quaternion::Identity()};
    frame.hands[hand].hold = 1;
  }
  for (int k = 0; k < 20; ++k) QCOMPARE(after(0), size_t{1});
}

/// Whatever the runtime leaves current: pictures come all the same.
void HeadsetTest::aRuntimeMayTakeTheContext() {
  for (const char* function : {"xrBeginFrame", "xrAcquireSwapchainImage", "xrWaitSwapchainImage", "xrEndFrame"}) {
    const QString script = R"({"view": {"width": 64, "height": 48}, "pictures": [8],
                               "events": [{"frame": 2, "steals_context": "%1"}]})";
    const ScriptedRun run(script.arg(function).toStdString());
    const Stay stay = stayInHeadset(m_context);
    QVERIFY2(stay.ending && !stay.ending->failed, function);
    QVERIFY(run.lines("violation").empty());
    const QImage picture = run.picture(8, 0);
    const auto& [r, g, b] = PaintedScene::kGround[0];
    QVERIFY2(!picture.isNull() && picture.pixelColor(picture.width() - 1, 0) == QColor(r, g, b), function);
  }
}

/// By the stick of the right hand, which is the other one then; the left one turns, as the palette's buttons do.
void HeadsetTest::aLeftHandedWearerGoesWithTheRight() {
  using ps::vr::kLeft, ps::vr::kRight;
  const ps::vr::HandRoles roles{kLeft, false};
  ps::vr::Moving moving;
  ps::vr::HeadsetFrame frame;
  frame.head.position = {0.2, 1.6, 0.1};
  frame.hands[kRight].aim = ps::vr::HandPose{{0, 1, 0}, ps::Quaternion(Eigen::AngleAxisd(-M_PI / 4, Vector3::UnitX()))};
  frame.hands[kRight].steerY = 1;
  moving.follow(frame, roles);
  QVERIFY(moving.goal() && near(*moving.goal(), {0, 0, -1}, 1e-12));
  const Vector3 there = moving.stand().toScene(*moving.goal());
  frame.hands[kRight].steerY = 0;
  moving.follow(frame, roles);
  QVERIFY(near(moving.stand().toRoom(there), {0.2, 0, 0.1}, 1e-12));
  ps::vr::Moving asked = moving;
  asked.turnBy(2, frame.head.position);
  for (const double aside : {1.0, 0.0, 1.0, 0.0}) {
    frame.hands[kLeft].steerX = aside;
    moving.follow(frame, roles);
  }
  QVERIFY(std::abs(moving.stand().turn - M_PI / 3) < 1e-12 && moving.dims());
  QVERIFY(near(asked.stand().toRoom(there), moving.stand().toRoom(there), 1e-12));
}

QTEST_GUILESS_MAIN(HeadsetTest)
#include "tst_headset.moc"
