// SPDX-License-Identifier: Apache-2.0
// What a row takes and tells: typing, toggles and choices, notes, assistive technology.
#include "tests/shared/localnumbers.h"
#include "tests/ui/paintedtexts.h"
#include "tests/ui/rowtesting.h"
#include "ui/theme/theme.h"

#include <QtGui/QAccessible>
#include <QtGui/QImage>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

using namespace ps;
using namespace ps::testing;

class TestRowEntry : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void typingActsOnEnter_data();
  void typingActsOnEnter();
  void typedNonsenseLeavesTheValue();
  void anErrorGoesWithTheTextThatItIsAbout();
  void choicesReadAsNames();
  void untouchedTypingChangesNothing();
  void ctrlClickTypes();
  void tabGoesOn();
  void toggleAndChoiceAct();
  void mixedRowsScale();
  void mixedRowsSayDash_data();
  void mixedRowsSayDash();
  void longLabelsStandInTwoLines();
  void derivedRowsLeadToTheirSource();
  void curvesAskForTheirEditor();
  void curvesAreScaledAndReplaced();
  void numbersAreInTheUnitThatIsShown();
  void noHandWhereNothingHappens();
  void limitsStandUnderTheRow();
  void rowsAreAccessible_data();
  void rowsAreAccessible();
};

void TestRowEntry::typingActsOnEnter_data() {
  QTest::addColumn<QString>("locale");
  QTest::addColumn<QByteArray>("key");
  QTest::addColumn<QString>("text");
  QTest::addColumn<double>("value");
  for (const char* name : kNumberLocales) {
    const QString locale = QString::fromLatin1(name);
    const auto row = [&](const char* what) -> QTestData& {
      return QTest::newRow(qPrintable(QStringLiteral("%1, %2").arg(QLatin1String(what), locale))) << locale;
    };
    row("bare") << QByteArray("plate_temperature") << "120" << 393.15;
    row("unit") << QByteArray("plate_temperature") << "25 °C" << 298.15;
    row("other unit") << QByteArray("plate_temperature") << "300 K" << 300.0;
    row("comma") << QByteArray("conductivity") << "1,5" << 1.5;
    row("point") << QByteArray("conductivity") << "1.5" << 1.5;
    row("quotient") << QByteArray("conductivity") << "1/3" << 1.0 / 3;
    row("factor") << QByteArray("conductivity") << "*2" << 4.4;
    row("beyond the soft range") << QByteArray("plate_temperature") << "900" << 1173.15;
    row("prefix") << QByteArray("youngs_modulus") << "42 MPa" << 4.2e7;
    row("whole") << QByteArray("substeps") << "12" << 12.0;
  }
}

/// Key by key through the line edit, in a program and a C library that speak German, and English.
void TestRowEntry::typingActsOnEnter() {
  QFETCH(QString, locale);
  QFETCH(QByteArray, key);
  QFETCH(QString, text);
  QFETCH(double, value);
  const LocalNumbers local(locale);
  QVERIFY2(local.problem().isEmpty(), qPrintable(local.problem()));
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

void TestRowEntry::typedNonsenseLeavesTheValue() {
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

void TestRowEntry::anErrorGoesWithTheTextThatItIsAbout() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  row.startTyping();
  auto* edit = row.findChild<QLineEdit*>();
  for (const bool undo : {true, false}) {
    edit->selectAll();
    QTest::keyClicks(edit, QStringLiteral("99999"));
    QTest::keyClick(edit, Qt::Key_Return);
    QVERIFY(row.has(RowState::Error));
    if (undo) {
      edit->undo();
    } else {
      QTest::keyClick(edit, Qt::Key_Backspace);
    }
    QVERIFY(row.has(RowState::Editing) && !row.has(RowState::Error));
  }
}

void TestRowEntry::choicesReadAsNames() {
  QCOMPARE(choiceLabel(QStringLiteral("wendland_c2")), QStringLiteral("Wendland C2"));
  QCOMPARE(choiceLabel(QStringLiteral("cubic_spline")), QStringLiteral("Cubic spline"));
  QCOMPARE(choiceLabel(QStringLiteral("xpbd")), QStringLiteral("XPBD"));
  QCOMPARE(choiceLabel(QStringLiteral("poly_6")), QStringLiteral("Poly 6"));
}

void TestRowEntry::untouchedTypingChangesNothing() {
  ParameterRow row(model("plate_temperature"));
  row.setValue(293.123456789);  // the field shows four digits of it
  show(row);
  Listener listener(row);
  row.startTyping();
  QTest::keyClick(row.findChild<QLineEdit*>(), Qt::Key_Return);
  QCOMPARE(row.number(), 293.123456789);
  QCOMPARE(listener.sequence, QString());
}

void TestRowEntry::ctrlClickTypes() {
  ParameterRow row(model("plate_temperature"));
  show(row);
  Listener listener(row);
  QTest::mouseClick(&row, Qt::LeftButton, Qt::ControlModifier, onSlider(row, 0.9));
  QVERIFY(row.has(RowState::Editing));
  QCOMPARE(listener.sequence, QString());
}

void TestRowEntry::tabGoesOn() {
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

void TestRowEntry::toggleAndChoiceAct() {
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

void TestRowEntry::mixedRowsScale() {
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

void TestRowEntry::mixedRowsSayDash_data() {
  QTest::addColumn<QByteArray>("key");
  for (const char* key : {"plate_temperature", "conductivity", "substeps", "gravity_on", "kernel"})
    QTest::newRow(key) << QByteArray(key);
}

/// Above one another where one line would be cut; the row is as high as others.
void TestRowEntry::longLabelsStandInTwoLines() {
  RowModel wordy = model("conductivity");
  wordy.declaration.label = "Air drag of drops and solids";
  ParameterRow row(wordy);
  show(row);
  const auto label = [&row] {
    QList<PaintedText> lines;
    for (const PaintedText& painted : paintedBy(row)) {
      if (painted.at.x() < row.labelRect().right() &&
          QStringLiteral("Air drag of drops and solids").contains(painted.text))
        lines << painted;
    }
    return lines;
  };
  const int height = row.height();
  row.resize(460, height);
  QCOMPARE(label().size(), 1);
  row.resize(300, height);
  const QList<PaintedText> lines = label();
  QCOMPARE(lines.size(), 2);
  QCOMPARE(lines[0].text + QLatin1Char(' ') + lines[1].text, QStringLiteral("Air drag of drops and solids"));
  QVERIFY(lines[0].place.bottom() <= lines[1].place.top() + 4 && lines[1].at.y() < row.height());  // px
  for (const PaintedText& line : lines) QVERIFY(line.place.right() <= row.labelRect().right() + 2);
  QCOMPARE(row.height(), height);
}

/// "—" is what stands there, no value and nothing that is chosen, until one is set for all.
void TestRowEntry::mixedRowsSayDash() {
  QFETCH(QByteArray, key);
  ParameterRow row(model(key.constData()));
  show(row);
  const auto texts = [&row] {
    QStringList all;
    for (const PaintedText& painted : paintedBy(row)) all << painted.text;
    return all;
  };
  QVERIFY(!texts().contains(QStringLiteral("—")));
  const Value before = row.model().value;
  const QImage single = row.grab().toImage();
  row.setMixed(true);
  QVERIFY2(texts().contains(QStringLiteral("—")), qPrintable(texts().join(QLatin1Char('|'))));
  QCOMPARE(row.valueText(), QStringLiteral("—"));
  QVERIFY(row.grab().toImage() != single);
  row.setValue(before);
  row.setMixed(false);
  QVERIFY(row.grab().toImage() == single);
}

void TestRowEntry::derivedRowsLeadToTheirSource() {
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

void TestRowEntry::curvesAskForTheirEditor() {
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
  QTest::mouseMove(&row, row.sliderRect().center());
  QTRY_COMPARE(row.cursor().shape(), Qt::PointingHandCursor);
  QVERIFY(row.enter(QStringLiteral("*2")));
  QCOMPARE(std::get<Response>(row.model().value).points[1].y, 6.0);
  row.reset();
  QVERIFY(std::get<Response>(row.model().value) == curve);
}

/// Where nobody answers a click, the pointer does not promise that somebody will.
void TestRowEntry::noHandWhereNothingHappens() {
  std::vector<RowModel> rows = rowModels(list(), {});
  Response curve;
  curve.kind = Response::Kind::Curve;
  curve.points = {{250, 2}, {350, 3}};
  for (RowModel& row : rows) {
    if (row.key == QLatin1String("conductivity")) row.value = curve;
    if (row.key == QLatin1String("plate_temperature")) row.derivedFrom = QStringLiteral("from pressure");
  }
  ParameterPanel panel;
  panel.setModel(rows);
  panel.resize(392, 600);
  show(panel);
  for (const char* key : {"conductivity", "plate_temperature"}) {
    ParameterRow* row = panel.row(QLatin1String(key));
    QTest::mouseMove(row, row->fieldRect().center());
    QTest::mouseMove(row, row->sliderRect().center());
    QTest::qWait(20);
    QCOMPARE(row->cursor().shape(), row->model().derivedFrom.isEmpty() ? Qt::SizeHorCursor : Qt::ArrowCursor);
  }
}

/// "3.97 kPa·s" stands in a field whose numbers are in mPa·s otherwise: 4 means 4 kPa·s then.
void TestRowEntry::numbersAreInTheUnitThatIsShown() {
  RowModel start = model("youngs_modulus");
  start.declaration.unit = "Pa·s";
  start.declaration.displayUnit = "mPa·s";
  start.declaration.displayScale = 1e3;
  start.value = 3970.0;
  ParameterRow row(start);
  show(row);
  row.startTyping();
  auto* edit = row.findChild<QLineEdit*>();
  QVERIFY(edit);
  QCOMPARE(edit->text(), QString::fromUtf8("3.97 kPa·s"));
  QTest::keyClicks(edit, QStringLiteral("4"));  // all of it is selected
  QTest::keyClick(edit, Qt::Key_Return);
  QCOMPARE(row.number(), 4000.0);
  QVERIFY(row.enter(QStringLiteral("5")));  // nothing is being typed: in the displayed unit
  QCOMPARE(row.number(), 5e-3);
}

/// Without an editor, too: a drag scales all of it, a number takes its place.
void TestRowEntry::curvesAreScaledAndReplaced() {
  RowModel start = model("conductivity");
  Response curve;
  curve.kind = Response::Kind::Curve;
  curve.points = {{250, 2}, {350, 3}};
  start.value = start.defaultValue = curve;
  ParameterRow row(start);
  show(row);
  const Listener listener(row);
  const QPoint from = row.sliderRect().center(), to = from + QPoint(row.sliderRect().width() / 5, 0);
  QTest::mousePress(&row, Qt::LeftButton, {}, from);
  QTest::mouseMove(&row, to);
  QTest::mouseRelease(&row, Qt::LeftButton, {}, to);
  row.finishEditing();
  const double factor = std::pow(10.0, double(to.x() - from.x()) / row.sliderRect().width());
  const Response scaled = std::get<Response>(row.model().value);
  QVERIFY(std::abs(scaled.points[0].y / (2 * factor) - 1) < 0.005);  // three digits
  QVERIFY(std::abs(scaled.points[1].y - 1.5 * scaled.points[0].y) < 1e-12);
  QCOMPARE(listener.sequence, QStringLiteral("BLE"));
  QTest::mouseDClick(&row, Qt::LeftButton, {}, from);
  QVERIFY(!row.isChanged());
  QTest::mousePress(&row, Qt::LeftButton, {}, from);
  QTest::mouseMove(&row, from + QPoint(2, 0));  // a click of a hand that is not quite still
  QTest::mouseRelease(&row, Qt::LeftButton, {}, from + QPoint(2, 0));
  row.finishEditing();
  QVERIFY(!row.isChanged());
  QVERIFY(!row.enter(QStringLiteral("*-1")));
  QTest::mouseClick(&row, Qt::LeftButton, {}, row.fieldRect().center());
  auto* edit = row.findChild<QLineEdit*>();
  QVERIFY(edit);
  QTest::keyClicks(edit, QStringLiteral("5"));
  QTest::keyClick(edit, Qt::Key_Return);
  QCOMPARE(row.number(), 5.0);
  QVERIFY(!row.has(RowState::Curve));
}

void TestRowEntry::limitsStandUnderTheRow() {
  ParameterRow row(model("youngs_modulus"));
  show(row);
  QCOMPARE(row.height(), kRowHeight);
  row.setLimit(QStringLiteral("At 8 substeps the solver reaches 42 MPa; the ice moves a little softer than real. "
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

void TestRowEntry::rowsAreAccessible_data() {
  QTest::addColumn<QByteArray>("key");
  QTest::addColumn<int>("role");
  QTest::addColumn<QString>("value");
  QTest::newRow("number") << QByteArray("plate_temperature") << int(QAccessible::Slider) << "20.0 °C";
  QTest::newRow("response") << QByteArray("conductivity") << int(QAccessible::Slider) << "2.20 W/(m·K)";
  QTest::newRow("integer") << QByteArray("substeps") << int(QAccessible::Slider) << "4";
  QTest::newRow("toggle") << QByteArray("gravity_on") << int(QAccessible::CheckBox) << "on";
  QTest::newRow("choice") << QByteArray("kernel") << int(QAccessible::ComboBox) << "Cubic spline";
}

void TestRowEntry::rowsAreAccessible() {
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
  TestRowEntry test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_rowentry.moc"
