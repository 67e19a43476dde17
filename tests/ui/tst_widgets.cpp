// SPDX-License-Identifier: Apache-2.0
#include "tests/shared/germannumbers.h"
#include "tests/ui/rowtesting.h"
#include "ui/theme/theme.h"

#include <QtGui/QAccessible>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

using namespace ps;
using namespace ps::testing;

class TestWidgets : public QObject {
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
  void typingActsOnEnter_data();
  void typingActsOnEnter();
  void typedNonsenseLeavesTheValue();
  void untouchedTypingChangesNothing();
  void ctrlClickTypes();
  void tabGoesOn();
  void arrowsStep();
  void wheelNeedsFocus();
  void singleKeysStayGlobalAfterAClick();
  void toggleAndChoiceAct();
  void mixedRowsScale();
  void derivedRowsLeadToTheirSource();
  void curvesAskForTheirEditor();
  void sliderIsItsOwnInverse();
  void limitsStandUnderTheRow();
  void rowsAreAccessible_data();
  void rowsAreAccessible();
};

void TestWidgets::everyStateIsReached_data() {
  QTest::addColumn<int>("state");
  for (const auto& [name, state] :
       std::initializer_list<std::pair<const char*, RowState>>{{"hover", RowState::Hover},
                                                               {"focus", RowState::Focus},
                                                               {"disabled", RowState::Disabled},
                                                               {"mixed", RowState::Mixed},
                                                               {"out of range", RowState::OutOfRange},
                                                               {"changed", RowState::Changed},
                                                               {"curve", RowState::Curve},
                                                               {"derived", RowState::Derived},
                                                               {"limited", RowState::Limited},
                                                               {"error", RowState::Error},
                                                               {"editing", RowState::Editing},
                                                               {"dragging", RowState::Dragging}}) {
    QTest::newRow(name) << static_cast<int>(state);
  }
}

/// Each state can be had, is reported, and looks different from a row at rest.
void TestWidgets::everyStateIsReached() {
  QFETCH(int, state);
  const auto wanted = static_cast<RowState>(state);
  ParameterRow row(model("conductivity"));
  show(row);
  row.clearFocus();
  QHoverEvent leave(QEvent::HoverLeave, QPointF(-1, -1), QPointF(-1, -1), QPointF(20, 10));
  QApplication::sendEvent(&row, &leave);  // the pointer may stand anywhere
  const QImage atRest = row.grab().toImage();
  QVERIFY(!row.has(wanted));
  switch (wanted) {
    case RowState::Hover: {
      QHoverEvent enter(QEvent::HoverEnter, QPointF(20, 10), QPointF(20, 10), QPointF(-1, -1));
      QApplication::sendEvent(&row, &enter);
      break;
    }
    case RowState::Focus:
      row.setFocus(Qt::TabFocusReason);
      break;
    case RowState::Disabled:
      row.setDisabledReason(QStringLiteral("The plugin is missing."));
      break;
    case RowState::Mixed:
      row.setMixed(true);
      break;
    case RowState::OutOfRange:
      QVERIFY(row.enter(QStringLiteral("400")));
      break;
    case RowState::Changed:
      QVERIFY(row.enter(QStringLiteral("3")));
      break;
    case RowState::Curve: {
      Response curve;
      curve.kind = Response::Kind::Curve;
      curve.points = {{250, 2}, {270, 3}};
      row.setValue(curve);
      break;
    }
    case RowState::Derived:
      row.setDerivedFrom(QStringLiteral("from pressure"));
      break;
    case RowState::Limited:
      row.setLimit(QStringLiteral("The solver reaches **1**."), 1);
      break;
    case RowState::Error:
      QVERIFY(!row.enter(QStringLiteral("-3")));
      break;
    case RowState::Editing:
      row.startTyping();
      break;
    case RowState::Dragging:
      QTest::mousePress(&row, Qt::LeftButton, {}, onSlider(row, 0.8));
      break;
  }
  QTRY_VERIFY(row.has(wanted));
  QVERIFY(row.grab().toImage() != atRest);
}

void TestWidgets::aDragIsOneGesture() {
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

void TestWidgets::dragFollowsThePointer() {
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

void TestWidgets::shiftIsFineAndAltSnaps() {
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

void TestWidgets::escRestoresADrag() {
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

void TestWidgets::clickThenDoubleClickIsOneGesture() {
  ParameterRow row(model("plate_temperature"));
  row.setValue(400.0);
  show(row);
  Listener listener(row);
  QTest::mouseDClick(&row, Qt::LeftButton, {}, onSlider(row, 0.95));
  QTRY_COMPARE(listener.sequence.count('E'), 1);
  QCOMPARE(listener.sequence.count('B'), 1);
  QCOMPARE(row.number(), 293.15);
}

void TestWidgets::doubleClickResetsEveryKind_data() {
  QTest::addColumn<QByteArray>("key");
  for (const auto& declaration : kList) QTest::newRow(declaration.key) << QByteArray(declaration.key);
}

void TestWidgets::doubleClickResetsEveryKind() {
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

void TestWidgets::typingActsOnEnter_data() {
  QTest::addColumn<QByteArray>("key");
  QTest::addColumn<QString>("text");
  QTest::addColumn<double>("value");
  QTest::newRow("bare") << QByteArray("plate_temperature") << "120" << 393.15;
  QTest::newRow("unit") << QByteArray("plate_temperature") << "25 °C" << 298.15;
  QTest::newRow("other unit") << QByteArray("plate_temperature") << "300 K" << 300.0;
  QTest::newRow("comma") << QByteArray("conductivity") << "1,5" << 1.5;
  QTest::newRow("point") << QByteArray("conductivity") << "1.5" << 1.5;
  QTest::newRow("quotient") << QByteArray("conductivity") << "1/3" << 1.0 / 3;
  QTest::newRow("factor") << QByteArray("conductivity") << "*2" << 4.4;
  QTest::newRow("beyond the soft range") << QByteArray("plate_temperature") << "900" << 1173.15;
  QTest::newRow("prefix") << QByteArray("youngs_modulus") << "42 MPa" << 4.2e7;
  QTest::newRow("whole") << QByteArray("substeps") << "12" << 12.0;
}

/// Key by key through the line edit, in a program and a C library that speak German.
void TestWidgets::typingActsOnEnter() {
  QFETCH(QByteArray, key);
  QFETCH(QString, text);
  QFETCH(double, value);
  const GermanNumbers german;
  if (!german.problem().isEmpty()) QSKIP(qPrintable(german.problem()));
  ParameterRow row(model(key.constData()));
  show(row);
  Listener listener(row);
  QTest::mouseClick(&row, Qt::LeftButton, {}, row.fieldRect().center());
  auto* edit = row.findChild<QLineEdit*>();
  QVERIFY(edit && edit->hasSelectedText());
  QTest::keyClicks(edit, text);
  QCOMPARE(listener.sequence, QString());  // nothing before Enter
  QTest::keyClick(edit, Qt::Key_Return);
  QVERIFY(std::abs(row.number() - value) <= 1e-12 * value);
  QCOMPARE(listener.sequence, QStringLiteral("BLE"));
  QVERIFY(!row.has(RowState::Editing));
}

void TestWidgets::typedNonsenseLeavesTheValue() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  Listener listener(row);
  row.startTyping();
  auto* edit = row.findChild<QLineEdit*>();
  for (const char* text : {"hot", "25 m", "9999", "-400"}) {
    edit->selectAll();
    QTest::keyClicks(edit, QString::fromUtf8(text));
    QTest::keyClick(edit, Qt::Key_Return);
    QVERIFY2(row.has(RowState::Error) && row.has(RowState::Editing), text);
    QCOMPARE(row.number(), 293.15);
  }
  auto* note = row.findChild<QLabel*>(QStringLiteral("psError"));
  QVERIFY(note && note->text().contains(QStringLiteral("at least")));
  QTest::keyClick(edit, Qt::Key_Escape);
  QVERIFY(!row.has(RowState::Error) && !row.has(RowState::Editing));
  QCOMPARE(listener.sequence, QString());
}

void TestWidgets::untouchedTypingChangesNothing() {
  ParameterRow row(model("plate_temperature"));
  row.setValue(293.123456789);  // the field shows four digits of it
  show(row);
  Listener listener(row);
  row.startTyping();
  QTest::keyClick(row.findChild<QLineEdit*>(), Qt::Key_Return);
  QCOMPARE(row.number(), 293.123456789);
  QCOMPARE(listener.sequence, QString());
}

void TestWidgets::ctrlClickTypes() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  Listener listener(row);
  QTest::mouseClick(&row, Qt::LeftButton, Qt::ControlModifier, onSlider(row, 0.9));
  QVERIFY(row.has(RowState::Editing));
  QCOMPARE(listener.sequence, QString());
}

void TestWidgets::tabGoesOn() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 600);
  show(panel);
  ParameterRow* row = panel.row(QStringLiteral("plate_temperature"));
  row->startTyping();
  auto* edit = row->findChild<QLineEdit*>();
  QTest::keyClicks(edit, QStringLiteral("30"));
  QTest::keyClick(edit, Qt::Key_Tab);
  QCOMPARE(row->number(), 303.15);
  QTRY_VERIFY(panel.row(QStringLiteral("conductivity"))->hasFocus());
}

void TestWidgets::arrowsStep() {
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

void TestWidgets::wheelNeedsFocus() {
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
void TestWidgets::singleKeysStayGlobalAfterAClick() {
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

void TestWidgets::toggleAndChoiceAct() {
  ParameterRow toggle(model("gravity_on"));
  show(toggle);
  Listener told(toggle);
  QTest::mouseClick(&toggle, Qt::LeftButton, {}, QPoint(toggle.fieldRect().right() - 15, 13));
  QCOMPARE(told.sequence, QStringLiteral("BLE"));
  QCOMPARE(std::get<bool>(toggle.model().value), false);
  QCOMPARE(toggle.valueText(), QStringLiteral("off"));
  ParameterRow choice(model("kernel"));
  show(choice);
  Listener chosen(choice);
  QTest::mouseClick(&choice, Qt::LeftButton, {}, QPoint(choice.fieldRect().right() - 8, 13));  // the last segment
  QCOMPARE(std::get<std::string>(choice.model().value), std::string("poly_6"));
  QCOMPARE(choice.valueText(), QStringLiteral("Poly 6"));
  choice.setFocus(Qt::TabFocusReason);
  QTest::keyClick(&choice, Qt::Key_Up);
  QCOMPARE(std::get<std::string>(choice.model().value), std::string("wendland_c2"));
  QCOMPARE(chosen.sequence, QStringLiteral("BLEBLE"));
}

void TestWidgets::mixedRowsScale() {
  ParameterRow row(model("conductivity"));
  row.setMixed(true);
  show(row);
  QCOMPARE(row.valueText(), QStringLiteral("—"));
  Listener listener(row);
  QSignalSpy scaled(&row, &ParameterRow::scaled);
  QVERIFY(row.enter(QStringLiteral("*2")));
  QCOMPARE(scaled.count(), 1);
  QCOMPARE(scaled[0][1].toDouble(), 2.0);
  QCOMPARE(listener.sequence, QString());
  QVERIFY(row.enter(QStringLiteral("3")));  // sets all
  QVERIFY(!row.has(RowState::Mixed));
  QCOMPARE(listener.sequence, QStringLiteral("BLE"));
}

void TestWidgets::derivedRowsLeadToTheirSource() {
  ParameterRow row(model("plate_temperature"));
  row.setDerivedFrom(QStringLiteral("from pressure"));
  show(row);
  QSignalSpy asked(&row, &ParameterRow::sourceRequested);
  Listener listener(row);
  QTest::mouseClick(&row, Qt::LeftButton, {}, row.fieldRect().center());
  QCOMPARE(asked.count(), 1);
  QVERIFY(!row.has(RowState::Editing));
  QVERIFY(!row.enter(QStringLiteral("5")));
  QCOMPARE(listener.sequence, QString());
}

void TestWidgets::curvesAskForTheirEditor() {
  RowModel start = model("conductivity");
  Response curve;
  curve.kind = Response::Kind::Curve;
  curve.points = {{250, 2}, {350, 3}};
  start.value = start.defaultValue = curve;
  start.temperature = 300;
  ParameterRow row(start);
  show(row);
  QCOMPARE(row.valueText(), QStringLiteral("2.50 W/(m·K)"));  // at the operating point
  QSignalSpy asked(&row, &ParameterRow::curveRequested);
  QTest::mouseClick(&row, Qt::LeftButton, {}, row.sliderRect().center());
  QCOMPARE(asked.count(), 1);
  QVERIFY(!row.isChanged());
  QVERIFY(row.enter(QStringLiteral("*2")));
  QCOMPARE(std::get<Response>(row.model().value).points[1].y, 6.0);
  row.reset();
  QVERIFY(std::get<Response>(row.model().value) == curve);
}

void TestWidgets::sliderIsItsOwnInverse() {
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

void TestWidgets::limitsStandUnderTheRow() {
  ParameterRow row(model("youngs_modulus"));
  show(row);
  QCOMPARE(row.height(), kRowHeight);
  row.setLimit(QStringLiteral("At 8 substeps the solver reaches **42 MPa**; the ice moves a little softer than real. "
                              "[Use 24 substeps](solver/substeps=24)"),
               4.2e7);
  auto* note = row.findChild<QLabel*>(QStringLiteral("psLimit"));
  QVERIFY(note);
  QVERIFY(row.height() > kRowHeight + 30);
  QVERIFY(row.rect().contains(note->geometry()));
  QVERIFY(note->height() >= note->heightForWidth(note->width()));
  QSignalSpy clicked(&row, &ParameterRow::linkActivated);
  Q_EMIT note->linkActivated(QStringLiteral("solver/substeps=24"));
  QCOMPARE(clicked[0][1].toString(), QStringLiteral("solver/substeps=24"));
  QVERIFY(note->text().contains(QStringLiteral("href=\"solver/substeps=24\"")));
  row.setLimit({});
  QCOMPARE(row.height(), kRowHeight);
}

void TestWidgets::rowsAreAccessible_data() {
  QTest::addColumn<QByteArray>("key");
  QTest::addColumn<int>("role");
  QTest::addColumn<QString>("value");
  QTest::newRow("number") << QByteArray("plate_temperature") << int(QAccessible::Slider) << "20.0 °C";
  QTest::newRow("response") << QByteArray("conductivity") << int(QAccessible::Slider) << "2.20 W/(m·K)";
  QTest::newRow("integer") << QByteArray("substeps") << int(QAccessible::Slider) << "4";
  QTest::newRow("toggle") << QByteArray("gravity_on") << int(QAccessible::CheckBox) << "on";
  QTest::newRow("choice") << QByteArray("kernel") << int(QAccessible::ComboBox) << "Cubic spline";
}

void TestWidgets::rowsAreAccessible() {
  QFETCH(QByteArray, key);
  QFETCH(int, role);
  QFETCH(QString, value);
  ParameterRow row(model(key.constData()));
  QAccessibleInterface* face = QAccessible::queryAccessibleInterface(&row);
  QVERIFY(face);
  QCOMPARE(int(face->role()), role);
  QCOMPARE(face->text(QAccessible::Name), QString::fromUtf8(row.model().declaration.label));
  QCOMPARE(face->text(QAccessible::Value), value);
  QCOMPARE(face->text(QAccessible::Description), QString::fromUtf8(row.model().declaration.help));
  QAccessibleValueInterface* number = face->valueInterface();
  QVERIFY(number);
  QCOMPARE(number->currentValue().toDouble(), row.number());
  QVERIFY(number->maximumValue().toDouble() > number->minimumValue().toDouble());
  Listener listener(row);
  number->setCurrentValue(role == QAccessible::CheckBox ? 0.0 : number->maximumValue().toDouble());
  QCOMPARE(listener.sequence, QStringLiteral("BLE"));
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestWidgets test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_widgets.moc"
