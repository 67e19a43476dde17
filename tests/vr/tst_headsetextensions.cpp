// SPDX-License-Identifier: Apache-2.0
// What the program does with extensions of OpenXR that a headset offers, and that it does without those that it does
// not.
#include "tests/vr/scriptedrun.h"
#include "tests/vr/stay.h"

#include <QTest>

#include <cmath>

using namespace ps;

class HeadsetExtensionsTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { m_context.release(); }

  void nearestRateIsChosen_data();
  void nearestRateIsChosen();
  void anotherRateIsNoticed();
  void rateThatIsRefusedIsLeft();
  void nothingOfThemIsNeeded();

 private:
  HeadlessContext m_context{nullptr};
};

void HeadsetExtensionsTest::nearestRateIsChosen_data() {
  QTest::addColumn<QString>("offered");
  QTest::addColumn<double>("first");   // Hz
  QTest::addColumn<double>("wanted");  // Hz
  QTest::newRow("90 Hz") << "72, 90, 120" << 72.0 << 90.0;
  QTest::newRow("below") << "60, 80, 120" << 60.0 << 80.0;
  QTest::newRow("above") << "50, 100, 144" << 144.0 << 100.0;
  QTest::newRow("it is so") << "72, 90, 120" << 90.0 << 90.0;
  QTest::newRow("the only one") << "72" << 72.0 << 72.0;
  QTest::newRow("none") << "" << 72.0 << 72.0;
}

void HeadsetExtensionsTest::nearestRateIsChosen() {
  QFETCH(QString, offered);
  QFETCH(double, first);
  QFETCH(double, wanted);
  const QString script = QStringLiteral(R"({"period": %1, "refresh_rates": [%2]})");
  const ScriptedRun run(script.arg(QString::number(1 / first, 'g', 12), offered).toStdString());
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.ending && !stay.ending->failed);
  QVERIFY(run.lines("violation").empty());
  QVERIFY2(std::abs(stay.hertz - wanted) < 1e-3, qPrintable(QString::number(stay.hertz)));
  QCOMPARE(run.lines("refresh_rate").size(), size_t(first == wanted ? 0 : 1));
  QVERIFY(stay.record.frames.size() >= 20);
  QVERIFY(std::abs(stay.record.frames[10].period - 1 / wanted) < 1e-6);
}

/// Its wearer, or the headset that gets warm, chooses another one: that is known, and asked for no more.
void HeadsetExtensionsTest::anotherRateIsNoticed() {
  const ScriptedRun run(R"({"period": 0.0111111111, "events": [{"frame": 9, "refresh_rate": 72}]})");
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(run.lines("violation").empty());
  QVERIFY2(std::abs(stay.hertz - 72) < 1e-3, qPrintable(QString::number(stay.hertz)));
  QCOMPARE(run.lines("refresh_rate").size(), size_t{1});
}

void HeadsetExtensionsTest::rateThatIsRefusedIsLeft() {
  const ScriptedRun run(R"({"period": 0.0138888889, "events": [
      {"fail": "xrRequestDisplayRefreshRateFB", "result": "XR_ERROR_DISPLAY_REFRESH_RATE_UNSUPPORTED_FB"}]})");
  const Stay stay = stayInHeadset(m_context);
  QVERIFY(stay.ending && !stay.ending->failed);
  QVERIFY(std::abs(stay.hertz - 72) < 1e-3);
}

/// With OpenGL alone the pictures are the same.
void HeadsetExtensionsTest::nothingOfThemIsNeeded() {
  const std::string view = R"("view": {"width": 64, "height": 48}, "pictures": [8])";
  std::array<QImage, 2> seen;
  for (const bool all : {false, true}) {
    const std::string few = R"(, "extensions": ["XR_KHR_opengl_enable", "XR_MNDX_egl_enable"])";
    const ScriptedRun run("{" + view + (all ? "" : few) + "}");
    const Stay stay = stayInHeadset(m_context);
    QVERIFY(stay.ending && !stay.ending->failed);
    QVERIFY(run.lines("violation").empty());
    QCOMPARE(stay.hertz > 0, all);
    seen[all] = run.picture(8, 0);
  }
  QVERIFY(!seen[0].isNull());
  QCOMPARE(seen[0], seen[1]);
}

QTEST_MAIN(HeadsetExtensionsTest)
#include "tst_headsetextensions.moc"
