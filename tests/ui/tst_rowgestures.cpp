// SPDX-License-Identifier: Apache-2.0
// A row under the hand: its states, drags, wheel and keys.
#include "tests/ui/rowtesting.h"
#include "ui/theme/theme.h"

#include <QtWidgets/QLineEdit>

using namespace ps;
using namespace ps::testing;

class TestRowGestures : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void everyStateIsReached_data();
  void everyStateIsReached();
  void aDragIsOneGesture();
  void dragFollowsThePointer();
  void shiftIsFineAndAltSnaps();
  void escRestoresADrag();
  void clickThenDoubleClickIsOneGesture();
  void doubleClickResetsEveryKind_data();
  void doubleClickResetsEveryKind();
  void arrowsStep();
  void wheelNeedsFocus();
  void singleKeysStayGlobalAfterAClick();
  void sliderIsItsOwnInverse();
};

void TestRowGestures::everyStateIsReached_data() {
  QTest::addColumn<int>("state");
  for (const auto& [name, state] : kStates) QTest::newRow(name) << static_cast<int>(state);
}

/// Each state can be had, is reported, and looks different from a row at rest.
void TestRowGestures::everyStateIsReached() {
  QFETCH(int, state);
  const auto wanted = static_cast<RowState>(state);
  ParameterRow row(model("conductivity"));
  show(row);
  rest(row);
  const QImage atRest = row.grab().toImage();
  QVERIFY(!row.has(wanted));
  reach(row, wanted);
  QTRY_VERIFY(row.has(wanted));
  QVERIFY(row.grab().toImage() != atRest);
}

void TestRowGestures::aDragIsOneGesture() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  Listener listener(row);
  drag(row, onSlider(row, 0.2), onSlider(row, 0.7));
  QVERIFY2(listener.sequence.startsWith("BL") && !listener.sequence.contains('E'), qPrintable(listener.sequence));
  QVERIFY(listener.sequence.count('L') >= 5);  // live: each move acts at once
  const double held = row.number();
  row.setValue(300.0);  // an answer from outside must not fight the hand
  QCOMPARE(row.number(), held);
  QTest::mouseRelease(&row, Qt::LeftButton, {}, onSlider(row, 0.7));
  QTRY_COMPARE(listener.sequence.count('E'), 1);
  QCOMPARE(listener.sequence.count('B'), 1);
  QVERIFY(listener.sequence.endsWith('E'));
  QCOMPARE(listener.last, row.number());
  row.setValue(300.0);
  QCOMPARE(row.number(), 300.0);
}

void TestRowGestures::dragFollowsThePointer() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  drag(row, onSlider(row, 0.1), onSlider(row, 0.5));
  // 350 K over the track; a pixel of it is the tolerance.
  QVERIFY(std::abs(row.number() - (223.15 + 0.5 * 350)) <= 350.0 / row.sliderRect().width());
  // Whole tenths of a degree Celsius, so that digits do not run wild.
  const double shown = (row.number() - 273.15) * 10;
  QVERIFY(std::abs(shown - std::round(shown)) < 1e-6);
  drag(row, onSlider(row, 0.5), QPoint(5000, 10));
  QCOMPARE(row.number(), 573.15);  // ends at the soft limit
}

void TestRowGestures::shiftIsFineAndAltSnaps() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  row.setValue(valueAtPosition(row.model().declaration, 0.5));
  const QPoint middle = onSlider(row, 0.5);
  const double before = row.number(), perPixel = 350.0 / row.sliderRect().width();
  drag(row, middle, middle + QPoint(20, 0), Qt::ShiftModifier);
  QVERIFY(std::abs(row.number() - before - 2 * perPixel) < 0.2 * perPixel);  // a tenth of 20 pixels
  QTest::mouseRelease(&row, Qt::LeftButton, {}, middle);
  drag(row, onSlider(row, 0.2), onSlider(row, 0.62), Qt::AltModifier);
  const double shown = (row.number() - 273.15) / 10;  // 350 / 20 = 17.5: steps of 10 °C
  QVERIFY2(std::abs(shown - std::round(shown)) < 1e-9, qPrintable(QString::number(row.number() - 273.15)));
}

void TestRowGestures::escRestoresADrag() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  Listener listener(row);
  drag(row, onSlider(row, 0.2), onSlider(row, 0.9));
  QVERIFY(row.isChanged());
  QTest::keyClick(&row, Qt::Key_Escape);
  QCOMPARE(row.number(), 293.15);
  QVERIFY(listener.sequence.endsWith("LE"));
  QMouseEvent move(QEvent::MouseMove, QPointF(onSlider(row, 0.5)), QPointF(), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&row, &move);  // the button is still down
  QCOMPARE(row.number(), 293.15);
  QTest::mouseRelease(&row, Qt::LeftButton, {}, onSlider(row, 0.5));
  QTest::qWait(kSettleMilliseconds + 50);
  QCOMPARE(listener.sequence.count('E'), 1);
}

void TestRowGestures::clickThenDoubleClickIsOneGesture() {
  ParameterRow row(model("plate_temperature"));
  row.setValue(400.0);
  show(row);
  Listener listener(row);
  QTest::mouseDClick(&row, Qt::LeftButton, {}, onSlider(row, 0.95));
  QTRY_COMPARE(listener.sequence.count('E'), 1);
  QCOMPARE(listener.sequence.count('B'), 1);
  QCOMPARE(row.number(), 293.15);
}

void TestRowGestures::doubleClickResetsEveryKind_data() {
  QTest::addColumn<QByteArray>("key");
  for (const auto& declaration : kList) QTest::newRow(declaration.key) << QByteArray(declaration.key);
}

void TestRowGestures::doubleClickResetsEveryKind() {
  QFETCH(QByteArray, key);
  ParameterRow row(model(key.constData()));
  show(row);
  const api::ParameterDeclaration& d = row.model().declaration;
  row.setValue(valueOfNumber(d, d.kind == api::ParameterKind::Toggle   ? 0
                                : d.kind == api::ParameterKind::Choice ? 2
                                                                       : 3));
  QVERIFY(row.isChanged());
  Listener listener(row);
  QTest::mouseDClick(&row, Qt::LeftButton, {}, row.labelRect().center());
  QVERIFY(!row.isChanged());
  QCOMPARE(listener.sequence, QStringLiteral("BLE"));
}

void TestRowGestures::arrowsStep() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  row.setFocus(Qt::TabFocusReason);
  Listener listener(row);
  QTest::keyClick(&row, Qt::Key_Up);
  QTest::keyClick(&row, Qt::Key_Up);
  QVERIFY(std::abs(row.number() - 297.15) < 1e-9);  // 350 / 100 made round: 2 K
  QTest::keyClick(&row, Qt::Key_Down, Qt::ShiftModifier);
  QVERIFY(std::abs(row.number() - 296.95) < 1e-9);
  QTRY_COMPARE(listener.sequence, QStringLiteral("BLLLE"));  // keys in a row are one gesture
  ParameterRow whole(model("substeps"));
  show(whole);
  whole.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&whole, Qt::Key_Up);
  QCOMPARE(whole.number(), 5.0);
}

void TestRowGestures::wheelNeedsFocus() {
  ParameterRow row(model("plate_temperature"));
  QWidget other;
  show(row);
  row.clearFocus();
  Listener listener(row);
  wheel(row, onSlider(row, 0.5), 120);
  QCOMPARE(listener.sequence, QString());
  row.setFocus(Qt::TabFocusReason);
  QTRY_VERIFY(row.hasFocus());
  wheel(row, onSlider(row, 0.5), 120);
  wheel(row, onSlider(row, 0.5), 60);  // half a step waits for its other half
  wheel(row, onSlider(row, 0.5), 60);
  QTRY_COMPARE(listener.sequence, QStringLiteral("BLLE"));
}

/// After a drag with the mouse, 1 is still "view from the front"; after Tab it begins to type.
void TestRowGestures::singleKeysStayGlobalAfterAClick() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  QTest::mouseClick(&row, Qt::LeftButton, {}, onSlider(row, 0.4));
  row.setFocus(Qt::MouseFocusReason);
  QKeyEvent ask(QEvent::ShortcutOverride, Qt::Key_1, Qt::NoModifier, QStringLiteral("1"));
  ask.ignore();
  QApplication::sendEvent(&row, &ask);
  QVERIFY(!ask.isAccepted());
  row.clearFocus();
  row.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&row, Qt::Key_1);
  QVERIFY(row.has(RowState::Editing));
  QCOMPARE(row.findChild<QLineEdit*>()->text(), QStringLiteral("1"));
}

void TestRowGestures::sliderIsItsOwnInverse() {
  for (const auto& d : kList) {
    if (d.kind == api::ParameterKind::Toggle || d.kind == api::ParameterKind::Choice) continue;
    for (const double position : {0.0, 0.1, 0.5, 0.93, 1.0}) {
      // Logarithm and power round a few times each.
      QVERIFY(std::abs(sliderPosition(d, valueAtPosition(d, position)) - position) < 1e-12);
    }
    QCOMPARE(sliderPosition(d, d.minimum - 1e6), 0.0);
    QCOMPARE(sliderPosition(d, d.maximum * 10), 1.0);
    QVERIFY(stepped(d, valueAtPosition(d, 0.5), 1, false) > valueAtPosition(d, 0.5));
  }
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestRowGestures test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_rowgestures.moc"
