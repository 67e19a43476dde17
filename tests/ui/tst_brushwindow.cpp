// SPDX-License-Identifier: Apache-2.0
// Gestures around the brush in the window: its size, the matter that it takes, and the other end of a pen.
#include "samplewindow.h"
#include "ui/session/selection.h"
#include "ui/tools/tooltable.h"

#include <QtGui/QPointingDevice>
#include <QtGui/QTabletEvent>

#include <algorithm>
#include <cmath>

using namespace ps;

class TestBrushWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    document().addMaterial("iron");
    document().undoStack().clear();
  }
  void init() {
    backToTheStart();
    m_window->tools().activate(kBrushTool);
    QVERIFY(m_window->tools().tool().usesBrush());
  }
  void cleanup() { m_window->tools().setMouse(MousePreset::PhaseSketch); }
  void cleanupTestCase() { m_window.reset(); }

  void aDragMakesTheBrushLarger_data() {
    QTest::addColumn<int>("preset");
    QTest::addColumn<Qt::KeyboardModifiers>("keys");
    QTest::newRow("PhaseSketch") << static_cast<int>(MousePreset::PhaseSketch) << Qt::KeyboardModifiers(Qt::ALT);
    QTest::newRow("Blender") << static_cast<int>(MousePreset::Blender) << Qt::KeyboardModifiers(Qt::ALT);
    QTest::newRow("Maya, whose Alt with the right button is the view's")
        << static_cast<int>(MousePreset::Maya) << Qt::KeyboardModifiers(Qt::SHIFT);
    QTest::newRow("CAD") << static_cast<int>(MousePreset::Cad) << Qt::KeyboardModifiers(Qt::ALT);
  }
  void aDragMakesTheBrushLarger() {
    QFETCH(int, preset);
    QFETCH(Qt::KeyboardModifiers, keys);
    m_window->tools().setMouse(static_cast<MousePreset>(preset));
    const double before = m_window->tools().brush().radius;
    const Camera camera = view()->navigator().camera();
    press(Qt::RightButton, keys, kMiddle);
    move({60, 0}, Qt::RightButton, keys);
    const double larger = m_window->tools().brush().radius;
    QVERIFY2(std::abs(larger / before - std::sqrt(2)) < 1e-6, qPrintable(QString::number(larger / before)));
    move({-60, 0}, Qt::RightButton, keys);
    QVERIFY(m_window->tools().brush().radius < before);
    move({100000, 0}, Qt::RightButton, keys);
    QCOMPARE(m_window->tools().brush().radius, kBrushMaximum);
    QVERIFY(view()->cancelGesture());
    QCOMPARE(m_window->tools().brush().radius, before);
    release(Qt::RightButton, keys);
    QCOMPARE(document().undoStack().count(), 0);
    QCOMPARE(view()->navigator().camera().distance, camera.distance);
    QCOMPARE(view()->navigator().camera().azimuth, camera.azimuth);
  }

  void altAndAClickTakeTheMatterThatIsThere() {
    m_window->selection().pickMaterial("iron");
    QCOMPARE(m_window->tools().brush().material, std::string("iron"));
    QTest::mouseClick(view(), Qt::LeftButton, Qt::AltModifier, view()->rect().center());
    QCOMPARE(m_window->tools().brush().material, std::string("water"));
    QCOMPARE(document().undoStack().count(), 0);  // nothing was drawn
  }

  void theOtherEndOfAPenErases() {
    const size_t before = idsNow(session()).size();
    pen(QPointingDevice::PointerType::Eraser, 0.7);
    stroke(view()->rect().center() - QPoint(40, 0), {80, 0}, true);
    const size_t left = idsNow(session()).size();
    QVERIFY2(left < before, qPrintable(QString::number(left)));
    document().undoStack().undo();
    QCOMPARE(idsNow(session()).size(), before);
    // The mouse that is taken up afterwards draws, with full pressure.
    pen(QPointingDevice::PointerType::Eraser, 0);
    QTest::qWait(300);
    stroke(view()->rect().center() - QPoint(40, 0), {80, 0}, true);
    QVERIFY(idsNow(session()).size() > before);
    const Body& body = document().project().bodies.back();
    const auto& strokes = std::get<VoxelShape>(body.shape).strokes;
    QCOMPARE(strokes.back().samples.front()[3], 1.0);
  }

 private:
  static constexpr QPoint kMiddle{0, 0};  // of the view
  QPoint at(const QPoint& from) { return view()->rect().center() + from; }
  void press(Qt::MouseButton button, Qt::KeyboardModifiers keys, const QPoint& from) {
    QTest::mousePress(view(), button, keys, at(from));
  }
  void move(const QPoint& to, Qt::MouseButton button, Qt::KeyboardModifiers keys) {
    QMouseEvent event(QEvent::MouseMove, at(to), view()->mapToGlobal(at(to)), Qt::NoButton, button, keys);
    QApplication::sendEvent(view(), &event);
  }
  void release(Qt::MouseButton button, Qt::KeyboardModifiers keys) {
    QTest::mouseRelease(view(), button, keys, at(kMiddle));
  }
  /// What a pen says before the mouse's event that Qt makes of it.
  void pen(QPointingDevice::PointerType end, double pressure) {
    static const QPointingDevice eraser(QStringLiteral("eraser"), 17, QInputDevice::DeviceType::Stylus, end,
                                        QInputDevice::Capability::Pressure, 1, 1);
    const bool presses = pressure > 0;
    QTabletEvent event(presses ? QEvent::TabletPress : QEvent::TabletMove, &eraser, at(kMiddle),
                       view()->mapToGlobal(at(kMiddle)), pressure, 0, 0, 0, 0, 0, Qt::NoModifier,
                       presses ? Qt::LeftButton : Qt::NoButton, presses ? Qt::LeftButton : Qt::NoButton);
    QApplication::sendEvent(view(), &event);
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestBrushWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_brushwindow.moc"
