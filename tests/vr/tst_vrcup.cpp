// SPDX-License-Identifier: Apache-2.0
// The story of the cup in the headset, in one stay: it is sketched, rigid, with the right hand while the left one takes
// some of its rim away, and water is sketched into it; an ice cube is sketched beside it, taken by the grip, dropped in
// and heated until it melts; two undos. What the desktop has then, and saves, is what is there, and both eyes see it.
#include "tests/ui/cupstory.h"
#include "tests/vr/vrstory.h"

#include <cmath>

using namespace ps;

namespace {

const Vector3 kRest(-0.4, 0.4, 0);  // m, of a left hand that does nothing
// About the middle of the cup this holds all that is in it, wherever the ice floats: m. What it gives, W, up to so many
// K, at which nothing boils, melts the ice in about a second of the scene; this long is given to it.
constexpr double kAllOfTheCup = 0.15, kPower = 20000, kWarm = 340, kMelts = 6;

}  // namespace

class VrCupTest : public VrStory<CupStory<PanelsTest>> {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { emptyScene(); }
  void init() { goesOnFromSuccess(); }
  void cleanup() { notesFailure(); }
  void cleanupTestCase() {
    leaveAtLast();
    m_window.reset();
  }

  void aCupIsSketchedWhileTheOtherHandErases();
  void itIsFilled();
  void anIceCubeIsTakenAndDroppedIn();
  void itIsHeatedUntilItMelts();
  void twoUndos();
  void theDesktopHasExactlyThat();

 private:
  /// The cube, and swings no more.
  void isCarriedTo(const Vector3& place) {
    const auto away = [&] { return (meanOf(m_ice) - place).norm(); };
    QTRY_VERIFY2_WITH_TIMEOUT(away() < 0.02, qPrintable(QString::number(away())), kRun);
    passes(0.5);
    QVERIFY2(away() < 0.02, qPrintable(QString::number(away())));
  }

  Vector3 m_above{0, 0, 0};  ///< m, of the cup
};

void VrCupTest::aCupIsSketchedWhileTheOtherHandErases() {
  enters(kRest, {0.4, 0.4, 0});
  choose("aluminium");
  becomes("rigid");
  brush("tube", kCupRadius, 293.15, true);
  const Vector3 foot(0, 0.1, 0), rim(0, 0.1 + kCupHeight, 0);
  const int before = steps();
  next(left(0, kRest) + right(0, foot) + right(20, foot, kPulled) + right(60, rim, kLetGo));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before + 1, kLong);
  m_cup = document().project().bodies.back().id;
  const size_t wall = placesOf(m_cup).size();
  QVERIFY2(wall > 200, qPrintable(QString::number(wall)));
  // The bottom with one hand, and a lip out of the rim with the other one, in the same frames.
  brush("disc", kCupRadius, 293.15, true);
  const double half = m_window->tools().spacing() / 2;
  const Vector3 lip(-kCupRadius, kCupHeight + 0.1 - 3 * half, 0), bottom(0, 0.1 - half, 0);
  next(left(0, lip, kLetGo) + right(0, bottom, kLetGo) + left(20, lip, kPulled) + right(20, bottom, kPulled) +
       left(40, lip, kLetGo) + right(40, bottom, kLetGo));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before + 3, kLong);
  QCOMPARE(document().project().bodies.size(), size_t{1});
  const std::vector<Vector3> places = placesOf(m_cup);
  const auto rimOf = [&](double side) {
    return std::count_if(places.begin(), places.end(), [&](const Vector3& p) {
      return side * p.x() > kCupRadius / 2 && p.y() > lip.y() - 2 * kCupRadius / 5;
    });
  };
  const auto bottomCells = std::count_if(places.begin(), places.end(), [&](const Vector3& p) {
    return std::abs(p.y() - bottom.y()) < half && std::hypot(p.x(), p.z()) < kCupRadius / 2;
  });
  QVERIFY2(rimOf(-1) < rimOf(1) && bottomCells > 12,
           qPrintable(QStringLiteral("%1 %2 %3").arg(rimOf(-1)).arg(rimOf(1)).arg(bottomCells)));
}

void VrCupTest::itIsFilled() {
  const auto& held = document().body(m_cup)->constraints;
  QCOMPARE(held.size(), size_t{1});
  QCOMPARE(held.front().plugin, std::string("rigid"));
  choose("water");
  becomes(kBecomesOfItself);
  brush("sphere", 0.04, 290, true);
  const Vector3 low(0, 0.16, 0), high(0, 0.19, 0), away(0.4, 0.3, 0);
  const int before = steps();
  next(left(0, kRest) + right(0, low, kLetGo) + right(20, low, kPulled) + right(40, high, kLetGo) + right(60, away));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before + 1, kLong);
  m_water = document().project().bodies.back().id;
  QVERIFY(m_water != m_cup);
  const size_t count = placesOf(m_water).size();
  QVERIFY2(count > 30, qPrintable(QString::number(count)));
  const double start = meanOf(m_cup).y();
  makeRealAndPlay(kRest, right(0, away));  // both
  QTRY_VERIFY_WITH_TIMEOUT(timeNow() > 1.5, kRun);
  QVERIFY2(meanOf(m_cup).y() < start - 0.05, qPrintable(QString::number(meanOf(m_cup).y())));
  QVERIFY2(inCup(m_water) >= 0.95 * count, qPrintable(QString::number(inCup(m_water))));
}

/// While it all goes on. The grip takes it, whatever brush the hand has.
void VrCupTest::anIceCubeIsTakenAndDroppedIn() {
  brush("cube", 0.03, 263, false);
  const Vector3 at(0.22, 0.05, 0);  // the scene ends at 0.3
  const int before = steps();
  next(left(0, kRest) + right(0, at, kLetGo) + right(10, at, kPulled) + right(14, at, kLetGo) +
       right(20, {0.22, 0.3, 0}));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before + 1, kLong);
  m_ice = document().project().bodies.back().id;
  QVERIFY(m_ice != m_water);
  m_iceCount = placesOf(m_ice).size();
  QVERIFY(m_iceCount > 8);
  const double drawn = timeNow();
  QTRY_VERIFY_WITH_TIMEOUT(timeNow() > drawn + 0.4, kRun);
  const Vector3 lies = meanOf(m_ice), cup = meanOf(m_cup);
  m_above = {cup.x(), 0.4, cup.z()};
  // Up, and only then across: neither the hand nor time waits for the other on a busy machine.
  const Vector3 up(0.22, 0.4, 0);
  next(right(0, {0.22, 0.3, 0}) + right(20, lies) + right(30, lies, kHolds) + right(130, up));
  isCarriedTo(up);
  if (QTest::currentTestFailed()) return;
  next(right(0, up, kHolds) + right(130, m_above));
  isCarriedTo(m_above);
  if (QTest::currentTestFailed()) return;
  next(right(0, m_above, kHolds) + right(5, m_above, kHoldsNothing) + right(30, {0.4, 0.4, 0}));
  const double dropped = timeNow();
  QTRY_VERIFY_WITH_TIMEOUT(timeNow() > dropped + 1, kRun);
  QVERIFY2(inCup(m_ice) == m_iceCount, qPrintable(QString::number(inCup(m_ice))));
  QCOMPARE(steps(), before + 1);  // what is carried is no step: the timeline goes back
}

/// Time stands while the brush is chosen, or the water would melt it.
void VrCupTest::itIsHeatedUntilItMelts() {
  presses("Play or pause");
  QTRY_VERIFY_WITH_TIMEOUT(!session().playing(), kLong);
  QVERIFY(liquidOf(m_ice) < m_iceCount);
  heatBrush(kAllOfTheCup, kPower, kWarm);
  const int before = steps();
  const Vector3 cup = meanOf(m_cup);
  presses("Play or pause");
  QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  QVERIFY2(heatsAt(cup, kPower, m_above, kRest), "the brush misses the cup");
  QVERIFY2(comesWithin(kMelts, [&] { return liquidOf(m_ice) == m_iceCount; }),
           qPrintable(QStringLiteral("%1 of %2 are liquid").arg(liquidOf(m_ice)).arg(m_iceCount)));
  next(right(0, cup, kPulled) + right(5, cup, kLetGo) + right(20, {0.4, 0.4, 0}));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before + 1, kLong);
  QVERIFY(document().undoStack().undoText().contains(QStringLiteral("Heat")));
}

/// By the right hand's first button; the left one stops time before.
void VrCupTest::twoUndos() {
  const double heated = heaters();
  QVERIFY(heated > 0);
  const int before = steps();
  const Vector3 off(0.4, 0.4, 0);
  next(left(0, kRest) + right(0, off) + left(5, kRest, clicked("x")) + left(10, kRest, clicked("x", false)));
  QTRY_VERIFY_WITH_TIMEOUT(!session().playing(), kLong);
  next(left(0, kRest) + right(0, off) + right(5, off, clicked("a")) + right(10, off, clicked("a", false)));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before - 1, kLong);
  QTRY_VERIFY_WITH_TIMEOUT(std::abs(heaters()) < 1e-3 * heated, kLong);
  QCOMPARE(placesOf(m_ice).size(), m_iceCount);
  next(left(0, kRest) + right(0, off) + right(5, off, clicked("a")) + right(10, off, clicked("a", false)));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before - 2, kLong);
  QTRY_VERIFY_WITH_TIMEOUT(placesOf(m_ice).empty(), kLong);
  QVERIFY(!document().body(m_ice));
}

/// Both eyes see what the view draws from there, and the file holds it.
void VrCupTest::theDesktopHasExactlyThat() {
  leavesAsEyesSawIt(QStringLiteral("vr-cup.png"));
  savedIsWhatIsThere(2);  // cup and water
}

QTEST_MAIN(VrCupTest)
#include "tst_vrcup.moc"
