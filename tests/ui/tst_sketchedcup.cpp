// SPDX-License-Identifier: Apache-2.0
// A cup is sketched in the air and made rigid, water is sketched into it, an ice cube beside it is grabbed, dropped in
// and heated until it melts; two undos; and what is saved then is what is there, and goes on as it would have.
#include "tests/ui/cupstory.h"
#include "tests/ui/gizmohands.h"
#include "ui/tools/tooltable.h"

#include <cmath>

using namespace ps;

class TestSketchedCup : public CupStory<SampleWindowTest> {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { emptyScene(); }
  void cleanupTestCase() { m_window.reset(); }

  /// Wall and bottom are one body, which stands still as it is drawn.
  void aCupIsSketchedAndMadeRigid() {
    choose("aluminium");
    key(Qt::Key_B);
    key(Qt::Key_L);
    const double half = m_window->tools().spacing() / 2;
    BrushSettings brush = m_window->tools().brush();
    brush.radius = kCupRadius;
    brush.temperature = 293.15;
    brush.drawOn = DrawOn::AcrossZ;
    brush.planeAt = 0;
    m_window->tools().setBrush(brush);
    shape("tube");
    strokeTo({{0, 0.1, 0}, {0, 0.1 + kCupHeight, 0}});
    m_cup = document().project().bodies.back().id;
    brush.drawOn = DrawOn::Level;
    brush.planeAt = 0.1 - half;
    m_window->tools().setBrush(brush);
    shape("disc");
    strokeTo({{0, 0.1, 0}, {0.001, 0.1, 0}});
    QCOMPARE(document().project().bodies.size(), size_t{1});
    QVERIFY(placesOf(m_cup).size() > 200);
    makeRigid(m_cup);
    picture(QStringLiteral("cup.png"));
  }

  /// Both are made real, and what was poured stays in the cup.
  void waterIsSketchedIntoIt() {
    choose("water");
    BrushSettings brush = m_window->tools().brush();
    brush.radius = 0.04;
    brush.temperature = 290;
    brush.drawOn = DrawOn::AcrossZ;
    brush.planeAt = 0;
    m_window->tools().setBrush(brush);
    key(Qt::Key_B);
    shape("sphere");
    strokeTo({{0, 0.16, 0}, {0, 0.21, 0}});
    m_water = document().project().bodies.back().id;
    QVERIFY(m_water != m_cup);
    const size_t count = placesOf(m_water).size();
    QVERIFY2(count > 30, qPrintable(QString::number(count)));
    const double start = meanOf(m_cup).y();
    playOn(0.3);
    QVERIFY(std::abs(meanOf(m_cup).y() - start) < 1e-6);  // still held
    key(Qt::Key_Return);
    playOn(1.5);
    QVERIFY2(meanOf(m_cup).y() < start - 0.05, qPrintable(QString::number(meanOf(m_cup).y())));  // it has come down
    picture(QStringLiteral("cup-with-water.png"));
    QVERIFY2(inCup(m_water) >= 0.95 * count, qPrintable(QString::number(inCup(m_water))));
  }

  /// Sketched beside the cup while it all goes on, taken by hand, and let go above the cup.
  void anIceCubeIsDroppedIn() {
    key(Qt::Key_B);
    key(Qt::Key_L);  // live from now on
    BrushSettings brush = m_window->tools().brush();
    QVERIFY(!brush.held);
    brush.radius = 0.03;
    brush.temperature = 263;
    brush.drawOn = DrawOn::AcrossZ;
    m_window->tools().setBrush(brush);
    shape("cube");
    strokeTo({{0.3, 0.05, 0}, {0.301, 0.05, 0}});
    m_ice = document().project().bodies.back().id;
    QVERIFY(m_ice != m_water);
    m_iceCount = placesOf(m_ice).size();
    QVERIFY(m_iceCount > 8);
    playOn(0.3);
    view()->setFocus();
    key(Qt::Key_G);
    session().play();
    const Vector3 at = meanOf(m_ice);
    QVERIFY(hold({at, {0.3, 0.4, 0}, {0.15, 0.45, 0}, {0, 0.4, 0}}));
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(meanOf(m_ice).x()) < 0.04 && meanOf(m_ice).y() > 0.3, kRun);
    letGo({0, 0.4, 0});
    playOn(1);
    picture(QStringLiteral("cup-with-ice.png"));
    QVERIFY2(inCup(m_ice) == m_iceCount, qPrintable(QString::number(inCup(m_ice))));
  }

  /// From above, where the hand meets what is in the cup, and not its wall. It melts, and does not boil.
  void itIsHeatedUntilItMelts() {
    view()->show(StandardView::Top);
    key(Qt::Key_H);
    BrushSettings brush = m_window->tools().brush();
    brush.radius = 0.1;
    brush.parameters["heat"].values = {{"power", 5000.0}, {"limit", 340.0}};
    m_window->tools().setBrush(brush);
    session().play();
    QVERIFY(hold({meanOf(m_ice)}));
    QTRY_VERIFY_WITH_TIMEOUT(liquidOf(m_ice) == m_iceCount, kRun);
    letGo(meanOf(m_ice));
    session().pause();
    QVERIFY(document().undoStack().undoText().contains(QStringLiteral("Heat")));
    picture(QStringLiteral("cup-with-melted-ice.png"));
  }

  /// The heat goes back to where it came from, and then the ice cube.
  void twoUndosAndASavedState() {
    const double heated = heaters();
    QVERIFY(heated > 0);
    key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY2(std::abs(heaters()) < 1e-3 * heated, qPrintable(QString::number(heaters() / heated)));
    QCOMPARE(placesOf(m_ice).size(), m_iceCount);
    key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(placesOf(m_ice).empty());
    QVERIFY(!document().body(m_ice));
    savedIsWhatIsThere(2);  // cup and water
  }

 private:
  /// By the keys of its row. It acts at once at 0 s: what was drawn before is made anew.
  void makeRigid(const std::string& id) {
    ParameterRow* holds = row(Owner::Body, id, kStructureKey);
    QVERIFY(holds);
    holds->setFocus();
    const auto structure = [&] {
      const auto& constraints = document().body(id)->constraints;
      return constraints.empty() ? std::string() : constraints.front().plugin;
    };
    for (int k = 0; k < 9 && structure() != "rigid"; ++k) QTest::keyClick(holds, Qt::Key_Up);
    for (int k = 0; k < 9 && structure() != "rigid"; ++k) QTest::keyClick(holds, Qt::Key_Down);
    QCOMPARE(structure(), std::string("rigid"));
    QTRY_VERIFY_WITH_TIMEOUT(!session().appliesAtOnce() || !placesOf(id).empty(), kLong);
  }
  void pointTo(const Vector3& place) {
    const QPointF at = hands::pixelOf(*view(), place);
    QMouseEvent event(QEvent::MouseMove, at, view()->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(view(), &event);
  }
  /// Through places, in small steps.
  void strokeTo(const std::vector<Vector3>& places) {
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    QTest::mousePress(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), places.front()));
    for (size_t k = 1; k < places.size(); ++k) {
      for (int step = 1; step <= 8; ++step) pointTo(places[k - 1] + step / 8.0 * (places[k] - places[k - 1]));
    }
    QTest::mouseRelease(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), places.back()));
  }
  /// Pressed, and led through places slowly while the scene runs.
  bool hold(const std::vector<Vector3>& places) {
    if (!QTest::qWaitFor([&] { return view()->snapshot() != nullptr; }, kLong)) return false;
    QTest::mousePress(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), places.front()));
    for (size_t k = 1; k < places.size(); ++k) {
      for (int step = 1; step <= 20; ++step) {
        pointTo(places[k - 1] + step / 20.0 * (places[k] - places[k - 1]));
        const uint64_t frame = frameNow();
        if (!QTest::qWaitFor([&] { return frameNow() > frame + 1; }, kLong)) return false;
      }
    }
    return true;
  }
  void letGo(const Vector3& place) { QTest::mouseRelease(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), place)); }
};

QTEST_MAIN(TestSketchedCup)
#include "tst_sketchedcup.moc"
