// SPDX-License-Identifier: Apache-2.0
// What no lens shows is not drawn, where the headset says what that is.
#include "tests/vr/vrwindow.h"

#include <QImage>

#include <algorithm>
#include <array>

using namespace ps;

namespace {

constexpr int kCorner = 64;  // pixels along both sides of a corner that are hidden together with a tile around them

/// Pixels from the nearest corner of the picture, along both its sides.
int fromCorner(int x, int y) { return std::min(x, kSide - 1 - x) + std::min(y, kSide - 1 - y); }

bool isBlack(const QImage& picture, int x, int y) { return (picture.pixel(x, y) & 0xffffff) == 0; }

}  // namespace

class VrMaskTest : public VrWindowTest {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanup() { leaveAtLast(); }
  void cleanupTestCase() { m_window.reset(); }

  void cornersThatAreHiddenAreLeftOut();
  void anotherMaskIsNoticed();
  void whoGivesNoneIsDrawnForAsAWhole_data();
  void whoGivesNoneIsDrawnForAsAWhole();

 private:
  /// Of both eyes, in two frames.
  using Pictures = std::array<std::array<QImage, 2>, 2>;
  Pictures seen(const QString& more);
};

VrMaskTest::Pictures VrMaskTest::seen(const QString& more) {
  constexpr int kFirst = 40, kSecond = 90;
  const ScriptedRun run(
      vrScript(QStringLiteral(R"(, "pictures": [%1, %2])").arg(kFirst).arg(kSecond) + more, kHandsAway));
  Pictures pictures;
  [&] {
    enter();
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > kSecond + 4, kLong);
    leave();
    QVERIFY(run.lines("violation").empty());
  }();
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    pictures[0][eye] = run.picture(kFirst, eye);
    pictures[1][eye] = run.picture(kSecond, eye);
    if (!folder.isEmpty()) pictures[0][eye].save(folder + QStringLiteral("/vr-mask-%1.png").arg(eye));
  }
  return pictures;
}

/// All but a tile beside their edges, and nothing else: that is as without a mask.
void VrMaskTest::cornersThatAreHiddenAreLeftOut() {
  const Pictures masked = seen(QStringLiteral(R"(, "hidden_corners": 1)"));
  const Pictures whole = seen(QStringLiteral(R"(, "hidden_corners": 0)"));
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    const QImage &mask = masked[0][eye], &all = whole[0][eye];
    QCOMPARE(mask.size(), QSize(kSide, kSide));
    QVERIFY(!all.isNull());
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const int away = fromCorner(x, y);
        QVERIFY(!isBlack(all, x, y));
        if (away < kCorner - 16)
          QVERIFY2(isBlack(mask, x, y), qPrintable(QStringLiteral("%1, %2").arg(x).arg(y)));
        else if (away > kCorner + 64)
          QVERIFY2(mask.pixel(x, y) == all.pixel(x, y), qPrintable(QStringLiteral("%1, %2").arg(x).arg(y)));
      }
  }
}

/// As when its wearer moves the lenses.
void VrMaskTest::anotherMaskIsNoticed() {
  const Pictures pictures =
      seen(QStringLiteral(R"(, "hidden_corners": 0, "events": [{"frame": 60, "hidden_corners": 1}])"));
  for (const size_t eye : {size_t{0}, size_t{1}}) {
    QVERIFY(!isBlack(pictures[0][eye], 2, 2) && !isBlack(pictures[0][eye], kSide - 3, kSide - 3));
    QVERIFY(isBlack(pictures[1][eye], 2, 2) && isBlack(pictures[1][eye], kSide - 3, kSide - 3));
    QVERIFY(!isBlack(pictures[1][eye], kSide / 2, 2));
  }
}

void VrMaskTest::whoGivesNoneIsDrawnForAsAWhole_data() {
  QTest::addColumn<QString>("more");
  QTest::newRow("without the extension") << R"(, "extensions": ["XR_KHR_opengl_enable"])";
  QTest::newRow("where it is refused")
      << R"(, "events": [{"fail": "xrGetVisibilityMaskKHR", "result": "XR_ERROR_RUNTIME_FAILURE"}])";
  QTest::newRow("where it is refused the second time")
      << R"(, "events": [{"fail": "xrGetVisibilityMaskKHR", "result": "XR_ERROR_SIZE_INSUFFICIENT", "after": 1}])";
}

void VrMaskTest::whoGivesNoneIsDrawnForAsAWhole() {
  QFETCH(QString, more);
  const Pictures pictures = seen(QStringLiteral(R"(, "hidden_corners": 1)") + more);
  QVERIFY(!pictures[0][0].isNull() && !isBlack(pictures[0][0], 2, 2) && !isBlack(pictures[0][1], 2, 2));
}

QTEST_MAIN(VrMaskTest)
#include "tst_vrmask.moc"
