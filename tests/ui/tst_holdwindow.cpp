// SPDX-License-Identifier: Apache-2.0
// What is sketched is held in the air until it is made real, while all else in the window goes on.
#include "samplewindow.h"
#include "ui/tools/tooltable.h"

#include <QtGui/QAction>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>

#include <algorithm>

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

 private:
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
