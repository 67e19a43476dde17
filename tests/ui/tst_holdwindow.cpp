// SPDX-License-Identifier: Apache-2.0
// What is sketched is held in the air until it is made real, while all else in the window goes on.
#include "core/scene/pose.h"
#include "samplewindow.h"
#include "ui/tools/tooltable.h"

#include <QtGui/QAction>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>

#include <algorithm>
#include <tuple>

using namespace ps;

class TestHoldWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    beginInTheView();
    BrushSettings brush = m_window->tools().brush();
    brush.drawOn = DrawOn::Level;
    brush.planeAt = 0.45;
    brush.temperature = 260;
    brush.held = false;
    m_window->tools().setBrush(brush);
  }
  void cleanupTestCase() { m_window.reset(); }

  void enterLetsGoOfWhatIsHeld() {
    QVERIFY(!makeReal()->isEnabled() && !button()->isVisible());
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    QVERIFY(m_window->tools().brush().held);
    const std::string id = drawn();
    QVERIFY(std::get<bool>(document().value({Owner::Body, id, "held"})));
    QVERIFY(makeReal()->isEnabled() && button()->isVisible());
    QVERIFY(view()->rect().contains(button()->geometry()));
    const double height = heightOf(id);
    playOn(0.3);
    QCOMPARE(heightOf(id), height);
    QVERIFY(session().snapshot()->stats.time > 0.2);  // all else goes on
    picture(QStringLiteral("held.png"));
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY(!makeReal()->isEnabled() && !button()->isVisible());
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("make it real"));
    playOn(0.1);
    const double fallen = heightOf(id);
    QVERIFY2(fallen < height - 0.02, qPrintable(QString::number(height - fallen)));
    document().undoStack().undo();
    playOn(0.1);
    QCOMPARE(heightOf(id), fallen);  // where it is by then
    document().undoStack().redo();
    playOn(0.1);
    QVERIFY(heightOf(id) < fallen);
  }

  void whatIsDrawnFreeIsAnotherBody() {
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    const std::string held = drawn();
    QTest::keyClick(view(), Qt::Key_L);
    const std::string free = drawn();
    QVERIFY(held != free);
    QVERIFY(!std::get<bool>(document().value({Owner::Body, free, "held"})));
  }

  void theButtonDoesTheSameAndAResetBeginsWithIt() {
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    const std::string id = drawn();
    toTheStart();
    const double height = heightOf(id);
    playOn(0.1);
    QCOMPARE(heightOf(id), height);
    QTest::mouseClick(button(), Qt::LeftButton);
    playOn(0.1);
    QVERIFY(heightOf(id) < height);
  }

  /// Elsewhere Enter is what it always is.
  void enterInARowMakesNothingReal() {
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    drawn();
    QLineEdit field(m_window.get());
    field.show();
    field.setFocus();
    QTRY_VERIFY(field.hasFocus());
    QTest::keyClick(&field, Qt::Key_Return);
    QVERIFY(makeReal()->isEnabled());
  }

  /// Two lumps of one sketch become two bodies by the menu, in one step; then there is nothing more to separate.
  void whatIsApartIsSeparated() {
    Body lumps = twoLumps(260);
    lumps.constraints.push_back({"bonds", {}, {}});
    const std::string id = document().addBody(lumps);
    const size_t before = document().project().bodies.size();
    const auto steps = document().undoStack().position();
    QAction* separate = m_window->action(QStringLiteral("sketch.separate"));
    QVERIFY(separate);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
    QCOMPARE(document().undoStack().position(), steps + 1);
    QVERIFY(document().undoStack().undoText().contains(QStringLiteral("separating")));
    QCOMPARE(std::get<VoxelShape>(document().body(id)->shape).runs.size(), size_t{9});
    document().undoStack().undo();
    QCOMPARE(document().project().bodies.size(), before);
    document().undoStack().redo();
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
    QCOMPARE(document().project().bodies.size(), before + 1);
  }

  /// Matter that was made before its sketch was scaled has none of the cells that the sketch has now: Home first.
  void aSketchOfAnotherSizeIsSeparatedAfterHome() {
    const std::string id = document().addBody(twoLumps(260));
    const size_t before = document().project().bodies.size();
    playOn(0.1);
    Placement larger;
    larger.bodies.push_back(scaled(*document().body(id), Vector3::Constant(1.5)));
    document().place(larger, QStringLiteral("scaling"));
    QAction* separate = m_window->action(QStringLiteral("sketch.separate"));
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
    QVERIFY2(refused[0][1].toString().contains(QStringLiteral("Home")), qPrintable(refused[0][1].toString()));
    QCOMPARE(document().project().bodies.size(), before);
    toTheStart();
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
  }

  /// What flows is left alone where nobody has chosen it.
  void dropsAreSeparatedWhereTheyAreChosen() {
    Body drops = twoLumps(290);
    drops.parameters.values["held"] = false;
    const std::string id = document().addBody(drops);
    const size_t before = document().project().bodies.size();
    QAction* separate = m_window->action(QStringLiteral("sketch.separate"));
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().clear();
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
    QCOMPARE(document().project().bodies.size(), before);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
  }

 private:
  /// Three cells wide each, five apart.
  Body twoLumps(double temperature) {
    Body lumps;
    lumps.id = lumps.name = "lumps";
    lumps.material = document().project().materials[0].id;
    lumps.parameters.values["temperature"] = temperature;
    lumps.parameters.values["held"] = true;
    VoxelShape shape;
    shape.spacing = m_window->tools().spacing();
    shape.origin = {0, 0.6, 0};
    shape.palette.push_back({lumps.material, temperature, {}});
    for (const int x : {0, 8}) {
      for (int k = 0; k < 9; ++k) shape.runs.push_back({x, k % 3, k / 3, 3, 0});
    }
    std::sort(shape.runs.begin(), shape.runs.end(), [](const VoxelShape::Run& a, const VoxelShape::Run& b) {
      return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x);
    });
    lumps.shape = shape;
    return lumps;
  }
  QAction* makeReal() { return m_window->action(QStringLiteral("sketch.real")); }
  QPushButton* button() {
    for (QPushButton* one : view()->findChildren<QPushButton*>())
      if (one->accessibleName() == QStringLiteral("Make it real")) return one;
    return nullptr;
  }
  /// A short stroke in the air; the id of the body that it made.
  std::string drawn() {
    stroke(view()->rect().center() - QPoint(30, 60), {60, 0}, true);
    return document().project().bodies.back().id;
  }
  void playOn(double seconds) {
    const double until = timeNow() + seconds;
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(timeNow() >= until, kLong);
    session().pause();
  }
  double timeNow() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().time(); });
  }
  double heightOf(const std::string& id) {
    return onEngine<double>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      double sum = 0;
      size_t count = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] != id) continue;
        sum += double{store.position()[i].y};
        ++count;
      }
      return sum / static_cast<double>(std::max<size_t>(count, 1));
    });
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestHoldWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_holdwindow.moc"
