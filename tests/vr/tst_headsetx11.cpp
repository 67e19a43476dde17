// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/faults.h"
#include "tests/vr/scriptedrun.h"
#include "tests/vr/stay.h"
#include "tests/vr/windowcontext.h"
#include "ui/vr/runtime.h"

#include <QTest>

#include <optional>

using ps::ScriptedRun;
using ps::Stay;

/// The headset with the OpenGL of an X window, as the editor has it; and, between the program and the runtime, the
/// layer core_validation of those who write the specification. Debian 12's knows no binding of EGL, and is older than
/// the extension for the floor below where one stands.
class HeadsetX11Test : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context.emplace(); }
  void cleanupTestCase() { m_context.reset(); }

  void windowsContextIsShared();
  void validationIsSilent_data();
  void validationIsSilent();
  void validationIsSilentOfFaults_data() { ps::addFaultRows(); }
  void validationIsSilentOfFaults();

 private:
  Stay enter(const ps::StayPlan& plan = {}) {
    return stayInHeadset([&] { m_context->makeCurrent(); }, [&] { m_context->release(); }, plan);
  }
  static void misuse() {
    ps::vr::Runtime runtime({});
    auto info = ps::vr::structure<XrSystemGetInfo>(XR_TYPE_SESSION_CREATE_INFO);  // not its type
    XrSystemId system = XR_NULL_SYSTEM_ID;
    QCOMPARE(xrGetSystem(runtime.instance(), &info, &system), XR_ERROR_VALIDATION_FAILURE);
  }

  std::optional<ps::WindowContext> m_context;
};

void HeadsetX11Test::windowsContextIsShared() {
  const ScriptedRun run(R"({"pictures": [8]})");
  const Stay stay = enter();
  QVERIFY(stay.ending.has_value());
  QVERIFY2(!stay.ending->failed, stay.ending->sentence.c_str());
  QVERIFY(run.lines("violation").empty());
  QCOMPARE(run.lines("binding")[0]["binding"].get<std::string>(), std::string("xlib"));
  const auto& [r, g, b] = ps::PaintedScene::kGround[1];
  QCOMPARE(run.picture(8, 1).pixelColor(100, 100), QColor(r, g, b));
}

void HeadsetX11Test::validationIsSilent_data() {
  QTest::addColumn<QString>("events");
  QTest::newRow("a stay") << "";
  QTest::newRow("another rate") << R"({"frame": 9, "refresh_rate": 120})";
  QTest::newRow("a headset taken off and on") << R"({"frame": 8, "state": "IDLE"}, {"frame": 30, "state": "FOCUSED"})";
  QTest::newRow("focus lost") << R"({"frame": 8, "state": "VISIBLE"}, {"frame": 14, "state": "FOCUSED"})";
  QTest::newRow("left in the headset's menu") << R"({"frame": 9, "state": "EXITING"})";
  QTest::newRow("a session that is lost") << R"({"frame": 9, "state": "LOSS_PENDING"})";
  QTest::newRow("a runtime that dies") << R"({"frame": 9, "dies": "XR_ERROR_INSTANCE_LOST"})";
  QTest::newRow("another controller") << R"({"frame": 9, "profile": "/interaction_profiles/htc/vive_controller"})";
}

void HeadsetX11Test::validationIsSilent() {
  QFETCH(QString, events);
  const QString script =
      R"({"extensions": ["XR_KHR_opengl_enable", "XR_FB_display_refresh_rate"], "view": {"width": 64, "height": 64},
                             "events": [%1]})";
  ScriptedRun run(script.arg(events).toStdString());
  ps::StayPlan plan;
  plan.before = [](size_t) {
    const ps::vr::Vibration shortest{0.5, 0, 0};
    return std::array<std::optional<ps::vr::Vibration>, 2>{shortest, shortest};
  };
  const Stay stay = enter(plan);
  QVERIFY(stay.ending.has_value());
  QVERIFY2(stay.frames > 5, stay.ending->sentence.c_str());
  QCOMPARE(run.said(), QByteArray());
  QVERIFY(run.lines("violation").empty());
  misuse();  // it does listen
  QVERIFY(run.said().contains("VUID-XrSystemGetInfo-type-type"));
  run.forgive();
}

/// What fails is put away as the specification has it, wherever it failed.
void HeadsetX11Test::validationIsSilentOfFaults() {
  QFETCH(QString, script);
  QFETCH(QString, sentence);
  const ScriptedRun run(script.toStdString());
  ps::StayPlan plan;
  plan.leaveAfter = 60;
  const Stay stay = enter(plan);
  QVERIFY(stay.ending.has_value());
  QCOMPARE(stay.ending->failed, !sentence.isEmpty());
  QVERIFY2(stay.ending->sentence.find(sentence.toStdString()) != std::string::npos, stay.ending->sentence.c_str());
  QCOMPARE(run.said(), QByteArray());
  QVERIFY(run.lines("violation").empty());
}

QTEST_MAIN(HeadsetX11Test)
#include "tst_headsetx11.moc"
