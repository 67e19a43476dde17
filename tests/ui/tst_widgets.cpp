// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphview.h"
#include "ui/graphs/phasestackview.h"
#include "ui/graphs/sampleseries.h"
#include "ui/panels/parameterpanel.h"
#include "ui/panels/parameterrow_p.h"
#include "ui/panels/rowvalue.h"
#include "ui/theme/theme.h"

#include <QtCore/QBuffer>
#include <QtCore/QElapsedTimer>
#include <QtCore/QLocale>
#include <QtGui/QAccessible>
#include <QtGui/QWheelEvent>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <clocale>
#include <cmath>
#include <limits>
#include <random>

using namespace ps;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr api::ParameterDeclaration kList[] = {
    {"plate_temperature", "Plate temperature", "T_w", "K", api::ParameterKind::Number, api::Scale::Linear, 293.15, 223.15,
     573.15, 1, 3000, "°C", 1, -273.15, "", "Heat", "How hot the floor is held.", "kitchen plate 180", "none"},
    {"youngs_modulus", "Young's modulus", "E", "Pa", api::ParameterKind::Response, api::Scale::Logarithmic, 9.3e9, 1e3, 1e11,
     0, 1e13, "GPa", 1e-9, 0, "", "Mechanics", "Stiffness.", "ice 9.3, rubber 0.01", "Petrovic 2003"},
    {"substeps", "Substeps", "n", "", api::ParameterKind::Integer, api::Scale::Linear, 4, 1, 32, 1, 1000, "", 1, 0, "",
     "Mechanics", "Steps within a frame.", "", ""},
    {"gravity_on", "Gravity", "", "", api::ParameterKind::Toggle, api::Scale::Linear, 1, 0, 1, 0, 1, "", 1, 0, "", "Mechanics",
     "Whether things fall.", "", ""},
    {"kernel", "Kernel", "", "", api::ParameterKind::Choice, api::Scale::Linear, 0, 0, 2, 0, 2, "", 1, 0,
     "cubic_spline|wendland_c2|poly_6", "Mechanics", "Shape of a particle's influence.", "", ""},
    {"conductivity", "Conductivity", "k_s", "W/(m·K)", api::ParameterKind::Response, api::Scale::Linear, 2.2, 0.1, 5, 0, 1e4,
     "", 1, 0, "", "Heat", "How well heat passes.", "copper 400", "CRC 97th"}};

api::ParameterList list() { return api::listOf(kList); }

RowModel model(const char* key) {
  for (RowModel& row : rowModels(list(), {})) {
    if (row.key == QLatin1String(key)) return std::move(row);
  }
  qFatal("no such key");
}

/// What a row told: "B" Begin, "L" Live, "E" End, and the last number.
struct Listener {
  QString sequence;
  double last = kNaN;
  explicit Listener(ParameterRow& row) {
    QObject::connect(&row, &ParameterRow::editingStarted, &row, [this](const QString&, const Value&) { sequence += 'B'; });
    QObject::connect(&row, &ParameterRow::valueEdited, &row, [this, &row](const QString&, const Value& value) {
      sequence += 'L';
      last = numberOfValue(row.model().declaration, value, 293.15);
    });
    QObject::connect(&row, &ParameterRow::editingFinished, &row, [this, &row](const QString&, const Value& value) {
      sequence += 'E';
      last = numberOfValue(row.model().declaration, value, 293.15);
    });
  }
};

void show(QWidget& widget, int width = 392) {
  widget.resize(width, widget.height());
  widget.show();
  QVERIFY(QTest::qWaitForWindowExposed(&widget));
  widget.activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(&widget));
}

QPoint onSlider(const ParameterRow& row, double position) {
  const QRect track = row.sliderRect();
  return {track.left() + static_cast<int>(std::lround(track.width() * position)), track.center().y()};
}

void drag(ParameterRow& row, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = Qt::NoModifier, int steps = 8) {
  QTest::mousePress(&row, Qt::LeftButton, modifiers, from);
  for (int i = 1; i <= steps; ++i) {
    const QPointF at = QPointF(from) + (QPointF(to) - QPointF(from)) * i / steps;
    QMouseEvent move(QEvent::MouseMove, at, row.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, modifiers);
    QApplication::sendEvent(&row, &move);
  }
}

void wheel(QWidget& widget, QPointF at, int delta) {
  QWheelEvent event(at, widget.mapToGlobal(at), {}, {0, delta}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

}  // namespace

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
  void panelGroupsAndFilters();
  void panelCountsChanges();
  void pinnedRowsFollowTheirOriginals();
  void panelKeepsFoldsOverAModel();
  void changedMeansOtherThanTheMaterial();
  void emptyPanelHasItsSentence();
  void noTextIsCut_data();
  void noTextIsCut();
  void ticksAreNice_data();
  void ticksAreNice();
  void noSpikeIsLost();
  void joinedSamplesKeepExtremes();
  void graphPaintsASpike();
  void graphZoomsPansAndFits();
  void graphSeeks();
  void csvHasEverySample();
  void stackAddsUp();
  void paintingIsFast();
};

void TestWidgets::everyStateIsReached_data() {
  QTest::addColumn<int>("state");
  for (const auto& [name, state] : std::initializer_list<std::pair<const char*, RowState>>{
           {"hover", RowState::Hover}, {"focus", RowState::Focus}, {"disabled", RowState::Disabled}, {"mixed", RowState::Mixed},
           {"out of range", RowState::OutOfRange}, {"changed", RowState::Changed}, {"curve", RowState::Curve},
           {"derived", RowState::Derived}, {"limited", RowState::Limited}, {"error", RowState::Error},
           {"editing", RowState::Editing}, {"dragging", RowState::Dragging}}) {
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
    case RowState::Focus: row.setFocus(Qt::TabFocusReason); break;
    case RowState::Disabled: row.setDisabledReason(QStringLiteral("The plugin is missing.")); break;
    case RowState::Mixed: row.setMixed(true); break;
    case RowState::OutOfRange: QVERIFY(row.enter(QStringLiteral("400"))); break;
    case RowState::Changed: QVERIFY(row.enter(QStringLiteral("3"))); break;
    case RowState::Curve: {
      Response curve;
      curve.kind = Response::Kind::Curve;
      curve.points = {{250, 2}, {270, 3}};
      row.setValue(curve);
      break;
    }
    case RowState::Derived: row.setDerivedFrom(QStringLiteral("from pressure")); break;
    case RowState::Limited: row.setLimit(QStringLiteral("The solver reaches **1**."), 1); break;
    case RowState::Error: QVERIFY(!row.enter(QStringLiteral("-3"))); break;
    case RowState::Editing: row.startTyping(); break;
    case RowState::Dragging: QTest::mousePress(&row, Qt::LeftButton, {}, onSlider(row, 0.8)); break;
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
  QMouseEvent move(QEvent::MouseMove, QPointF(onSlider(row, 0.5)), QPointF(), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
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
  row.setValue(valueOfNumber(d, d.kind == api::ParameterKind::Toggle ? 0 : d.kind == api::ParameterKind::Choice ? 2 : 3));
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
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
  ParameterRow row(model(key.constData()));
  show(row);
  Listener listener(row);
  QTest::mouseClick(&row, Qt::LeftButton, {}, row.fieldRect().center());
  auto* edit = row.findChild<QLineEdit*>();
  QVERIFY(edit && edit->hasSelectedText());
  QTest::keyClicks(edit, text);
  QCOMPARE(listener.sequence, QString());  // nothing before Enter
  QTest::keyClick(edit, Qt::Key_Return);
  std::setlocale(LC_NUMERIC, "C");
  QLocale::setDefault(QLocale::c());
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
                              "[Use 24 substeps](solver/substeps=24)"), 4.2e7);
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

void TestWidgets::panelGroupsAndFilters() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(392, 600);
  show(panel);
  const auto shown = [&panel] {
    QStringList keys;
    for (const ParameterRow* row : panel.rows()) {
      if (panel.isRowShown(row)) keys << row->key();
    }
    return keys.join(QLatin1Char(' '));
  };
  // Groups in the order in which they first appear: all of Heat, then Mechanics.
  QCOMPARE(shown(), QStringLiteral("plate_temperature conductivity youngs_modulus substeps gravity_on kernel"));
  panel.setFilter(QStringLiteral("TEMP"));
  QCOMPARE(shown(), QStringLiteral("plate_temperature"));
  panel.setGroupFolded(QStringLiteral("Heat"), true);
  QCOMPARE(shown(), QStringLiteral("plate_temperature"));  // what is searched for is not hidden by a fold
  panel.setFilter({});
  QCOMPARE(shown(), QStringLiteral("youngs_modulus substeps gravity_on kernel"));
  panel.setFilter(QStringLiteral("xyzzy"));
  QCOMPARE(shown(), QString());
  bool said = false;
  for (const QLabel* label : panel.findChildren<QLabel*>()) said |= label->isVisible() && label->text().contains(QStringLiteral("xyzzy"));
  QVERIFY(said);
  QVERIFY(panel.reveal(QStringLiteral("conductivity")));
  QVERIFY(panel.isRowShown(panel.row(QStringLiteral("conductivity"))));
  QTRY_VERIFY(panel.row(QStringLiteral("conductivity"))->hasFocus());
  QVERIFY(!panel.reveal(QStringLiteral("nothing")));
}

void TestWidgets::panelCountsChanges() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  QCOMPARE(panel.changedCount(), 0);
  QList<Edit> edits;
  connect(&panel, &ParameterPanel::edited, &panel, [&edits](const QString&, const Value&, Edit edit) { edits << edit; });
  panel.row(QStringLiteral("conductivity"))->enter(QStringLiteral("3"));
  QCOMPARE(edits, (QList<Edit>{Edit::Begin, Edit::Live, Edit::End}));
  QCOMPARE(panel.changedCount(), 1);
  panel.setChangedOnly(true);
  QVERIFY(panel.isRowShown(panel.row(QStringLiteral("conductivity"))));
  QVERIFY(!panel.isRowShown(panel.row(QStringLiteral("substeps"))));
  panel.setValue(QStringLiteral("conductivity"), Response(2.2));
  QCOMPARE(panel.changedCount(), 0);
  QCOMPARE(edits.size(), 3);  // what comes from outside is not told back
}

void TestWidgets::pinnedRowsFollowTheirOriginals() {
  std::vector<RowModel> rows = rowModels(list(), {});
  RowModel pinned = rows[0];
  pinned.pinned = true;
  rows.push_back(pinned);
  ParameterPanel panel;
  panel.setModel(rows);
  const std::vector<ParameterRow*> all = panel.rows();
  QCOMPARE(all[0]->key(), all[1]->key());  // "Try these" stands on top
  all[0]->enter(QStringLiteral("50"));
  QCOMPARE(all[1]->number(), 323.15);
  QCOMPARE(panel.changedCount(), 1);
}

void TestWidgets::panelKeepsFoldsOverAModel() {
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.setGroupFolded(QStringLiteral("Heat"), true);
  panel.setModel(rowModels(list(), {}, {}, QStringLiteral("material/wax/")));
  QVERIFY(!panel.isRowShown(panel.row(QStringLiteral("material/wax/conductivity"))));
  QVERIFY(panel.isRowShown(panel.row(QStringLiteral("material/wax/substeps"))));
}

void TestWidgets::changedMeansOtherThanTheMaterial() {
  ParameterSet base, own;
  base.values["conductivity"] = Response(0.6);
  ParameterRow row(rowModels(list(), own, base)[5]);
  QCOMPARE(row.number(), 0.6);  // what is not set has the material's value, not the catalogue's
  QVERIFY(!row.isChanged());
  row.enter(QStringLiteral("2.2"));
  QVERIFY(row.isChanged());
  row.reset();
  QCOMPARE(row.number(), 0.6);
  QVERIFY(sameValue(Value(0.6), Value(Response(0.6))));
}

void TestWidgets::emptyPanelHasItsSentence() {
  ParameterPanel panel;
  panel.resize(392, 300);
  show(panel);
  bool said = false;
  for (const QLabel* label : panel.findChildren<QLabel*>()) {
    said |= label->isVisible() && label->text() == QStringLiteral("Select something, or press Ctrl+K");
  }
  QVERIFY(said);
}

void TestWidgets::noTextIsCut_data() {
  QTest::addColumn<int>("width");
  QTest::addColumn<bool>("symbols");
  QTest::newRow("1280") << 332 << false;
  QTest::newRow("1600") << 392 << true;
  QTest::newRow("2560") << 460 << true;
}

/// Labels are whole at every size of the window; where room is short, symbols go first.
void TestWidgets::noTextIsCut() {
  QFETCH(int, width);
  QFETCH(bool, symbols);
  ParameterPanel panel;
  panel.setModel(rowModels(list(), {}));
  panel.resize(width, 600);
  show(panel, width);
  for (const ParameterRow* row : panel.rows()) {
    QVERIFY2(row->labelRect().width() >= row->wantedLabelWidth() - 3, qPrintable(row->key()));
    QVERIFY(row->fieldRect().right() < row->width());
    QVERIFY(row->sliderRect().width() >= kMinimumSlider);
  }
  const ParameterRow* row = panel.row(QStringLiteral("conductivity"));
  QCOMPARE(row->sliderRect().left() - row->labelRect().right() > kSymbolWidth - 2, symbols);
}

void TestWidgets::ticksAreNice_data() {
  QTest::addColumn<double>("low");
  QTest::addColumn<double>("high");
  QTest::addColumn<int>("most");
  QTest::addColumn<double>("step");
  QTest::addColumn<int>("decimals");
  QTest::newRow("minute") << 0.0 << 60.0 << 7 << 10.0 << 0;
  QTest::newRow("celsius") << -14.0 << 130.0 << 3 << 50.0 << 0;
  QTest::newRow("tenths") << 0.0 << 1.0 << 5 << 0.25 << 2;
  QTest::newRow("small") << 0.0 << 3e-6 << 4 << 1e-6 << 6;
  QTest::newRow("large") << 0.0 << 7e6 << 4 << 2e6 << 0;
}

void TestWidgets::ticksAreNice() {
  QFETCH(double, low);
  QFETCH(double, high);
  QFETCH(int, most);
  QFETCH(double, step);
  QFETCH(int, decimals);
  const Ticks ticks = niceTicks(low, high, most);
  QVERIFY2(std::abs(ticks.step - step) < 1e-9 * step, qPrintable(QString::number(ticks.step)));
  QCOMPARE(ticks.decimals, decimals);
  QVERIFY(ticks.count >= 1 && ticks.count <= most);
  QVERIFY(ticks.first >= low - 1e-9 * step && ticks.at(ticks.count - 1) <= high + 1e-9 * step);
  QCOMPARE(niceTicks(1, 1, 5).count, 0);
  QCOMPARE(niceTicks(0, kNaN, 5).count, 0);
}

/// Extents of random ranges agree with a plain walk over all samples.
void TestWidgets::noSpikeIsLost() {
  std::mt19937 random(7);
  GraphView graph;
  const int series = graph.addSeries(QStringLiteral("a"));
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) {
    values.push_back(static_cast<double>(random() % 1000) / 1000 + (random() % 997 == 0 ? 50 : 0));
    graph.append(series, i / 60.0, values.back());
  }
  for (int trial = 0; trial < 500; ++trial) {
    size_t first = random() % values.size(), last = random() % values.size();
    if (first > last) std::swap(first, last);
    ++last;
    const auto [low, high] = std::minmax_element(values.begin() + static_cast<ptrdiff_t>(first), values.begin() + static_cast<ptrdiff_t>(last));
    // Half a sample before the first and the last: the range is half open.
    const auto extent = graph.extent(series, (static_cast<double>(first) - 0.5) / 60, (static_cast<double>(last) - 0.5) / 60);
    QCOMPARE(extent.first, *low);
    QCOMPARE(extent.second, *high);
  }
}

/// Past the capacity neighbours are joined; memory stays bounded and every extreme stays.
void TestWidgets::joinedSamplesKeepExtremes() {
  SampleSeries series;
  const size_t count = 3 * SampleSeries::kCapacity;
  for (size_t i = 0; i < count; ++i) {
    const bool spike = i == 12345 || i == count - 777;
    series.append(static_cast<double>(i), i == 500000 ? kNaN : spike ? 99 : i == 300001 ? -99 : std::sin(static_cast<double>(i)));
  }
  QVERIFY(series.size() <= SampleSeries::kCapacity);
  const auto all = series.extent(0, series.size());
  QCOMPARE(all.high, 99.0);
  QCOMPARE(all.low, -99.0);
  const auto early = series.extent(series.indexAt(12000), series.indexAt(13000));
  QCOMPARE(early.high, 99.0);
  const auto calm = series.extent(series.indexAt(20000), series.indexAt(290000));
  QVERIFY(calm.high <= 1 && calm.low >= -1);
  QCOMPARE(series.lastValue(), std::sin(static_cast<double>(count - 1)));
  series.append(5, 1000);  // earlier than the last: ignored
  QCOMPARE(series.extent(0, series.size()).high, 99.0);
}

/// One sample among 20,000 that is 40 times higher than the others reaches the top of the picture.
void TestWidgets::graphPaintsASpike() {
  GraphView graph;
  const int series = graph.addSeries(QStringLiteral("a"));
  for (int i = 0; i < 20000; ++i) graph.append(series, i / 60.0, i == 9876 ? 40 : 0);
  graph.resize(500, 150);
  const QImage image = graph.grab().toImage();
  const QColor colour = Theme::current().series(0);
  const QRectF plot = graph.plotRect();
  const double ratio = image.devicePixelRatio();
  const int x = static_cast<int>((plot.left() + plot.width() * 9876.0 / 20000) * ratio);
  int reached = image.height();
  for (int y = 0; y < image.height(); ++y) {
    for (int i = -2; i <= 2; ++i) {
      const QColor pixel = image.pixelColor(x + i, y);
      if (std::abs(pixel.blue() - colour.blue()) < 60 && std::abs(pixel.red() - colour.red()) < 60) reached = std::min(reached, y);
    }
  }
  // The scale leaves 12 % of the span below and a fifth above the data.
  QVERIFY2(reached < (plot.top() + 0.25 * plot.height()) * ratio, qPrintable(QString::number(reached)));
}

void TestWidgets::graphZoomsPansAndFits() {
  GraphView graph;
  const int series = graph.addSeries(QStringLiteral("a"));
  for (int i = 0; i <= 600; ++i) graph.append(series, i / 10.0, i);
  graph.setDuration(90);
  graph.resize(500, 150);
  show(graph, 500);
  QCOMPARE(graph.timeRange(), (std::pair<double, double>{0, 90}));
  QSignalSpy told(&graph, &TimePlot::timeRangeChanged);
  const QPointF middle = graph.plotRect().center();
  wheel(graph, middle, 120);
  QVERIFY(!graph.isFitted());
  QVERIFY(std::abs(graph.timeRange().second - graph.timeRange().first - 72) < 1e-9);  // 0.8 of 90
  QVERIFY(std::abs((graph.timeRange().second + graph.timeRange().first) / 2 - 45) < 0.2);  // about the pointer, to a pixel
  const double before = graph.timeRange().first;
  QTest::mousePress(&graph, Qt::LeftButton, {}, middle.toPoint());
  const QPointF to = middle + QPointF(50, 0);
  QMouseEvent move(QEvent::MouseMove, to, graph.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&graph, &move);
  QTest::mouseRelease(&graph, Qt::LeftButton, {}, to.toPoint());
  const double perPixel = 72 / graph.plotRect().width();
  QVERIFY(std::abs(graph.timeRange().first - (before - 50 * perPixel)) < perPixel);
  QCOMPARE(told.count(), 2);
  QTest::mouseDClick(&graph, Qt::LeftButton, {}, middle.toPoint());
  QVERIFY(graph.isFitted());
  QCOMPARE(graph.timeRange().second, 90.0);
  graph.append(series, 120, 1);
  QCOMPARE(graph.timeRange().second, 120.0);  // the fitted range grows with the data
}

void TestWidgets::graphSeeks() {
  GraphView graph;
  graph.append(graph.addSeries(QStringLiteral("a")), 0, 1);
  graph.setDuration(60);
  graph.resize(500, 150);
  show(graph, 500);
  QSignalSpy asked(&graph, &TimePlot::seekRequested);
  QTest::mouseClick(&graph, Qt::LeftButton, {}, graph.plotRect().center().toPoint());
  QCOMPARE(asked.count(), 1);
  QVERIFY(std::abs(asked[0][0].toDouble() - 30) < 60 / graph.plotRect().width());
}

void TestWidgets::csvHasEverySample() {
  GraphView graph;
  const int a = graph.addSeries(QStringLiteral("Ice, core"), QStringLiteral("°C")), b = graph.addSeries(QStringLiteral("b"));
  graph.append(a, 0, -9.5);
  graph.append(a, 0.1, kNaN);
  graph.append(b, 0.1, 2);
  graph.append(a, 0.3, 1.0 / 3);
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  QBuffer buffer;
  QVERIFY(buffer.open(QIODevice::WriteOnly));
  QVERIFY(graph.exportCsv(buffer));
  std::setlocale(LC_NUMERIC, "C");
  QCOMPARE(QString::fromUtf8(buffer.data()),
           QStringLiteral("time_s,\"Ice, core[°C]\",b\n0,-9.5,\n0.1,,2\n0.3,0.3333333333333333,\n"));
}

void TestWidgets::stackAddsUp() {
  PhaseStackView stack;
  stack.append(0, {1.0, 0, 0, 0, 0});
  stack.append(10, {0.25, 0.05, 0.5, 0.0, 0.2});
  QCOMPARE(stack.sampleCount(), size_t{2});
  stack.resize(400, 200);
  const QImage image = stack.grab().toImage();
  const QRectF plot = stack.plotRect();
  const double ratio = image.devicePixelRatio();
  // Just before the end, from the bottom up: solid to 0.25 of the total, then melting, liquid, gas.
  const auto at = [&](double share) {
    const double y = plot.bottom() - plot.height() * share / 1.06;
    return image.pixelColor(static_cast<int>((plot.left() + 0.3 * plot.width()) * ratio), static_cast<int>(y * ratio));
  };
  // At 0.3 of the run solid is 0.775, liquid from 0.79 to 0.94 of the total.
  QCOMPARE(at(0.4), QColor(0x3A, 0x63, 0xB8));
  QCOMPARE(at(0.87), QColor(0x45, 0xC4, 0xB8));
  QCOMPARE(at(0.97), QColor(0xF5, 0xF1, 0xE6));
  QBuffer buffer;
  QVERIFY(buffer.open(QIODevice::WriteOnly));
  QVERIFY(stack.exportCsv(buffer));
  QVERIFY(buffer.data().startsWith("time_s,solid[kg],melting[kg],liquid[kg],boiling[kg],gas[kg]\n0,1,0,0,0,0\n10,0.25,"));
}

/// 20,000 samples in three lines: the aim is 4 ms on the reference machine; ten times that catches a walk over all samples
/// on a slow one.
void TestWidgets::paintingIsFast() {
  GraphView graph;
  for (int s = 0; s < 3; ++s) {
    const int series = graph.addSeries(QString::number(s));
    for (int i = 0; i < 20000; ++i) graph.append(series, i / 60.0, s + std::sin(i * 0.37));
  }
  graph.resize(560, 140);
  QImage image(560, 140, QImage::Format_ARGB32_Premultiplied);
  graph.render(&image);
  QElapsedTimer timer;
  timer.start();
  constexpr int kFrames = 20;
  for (int i = 0; i < kFrames; ++i) graph.render(&image);
  const double milliseconds = static_cast<double>(timer.nsecsElapsed()) / 1e6 / kFrames;
  qInfo("a graph of 3 x 20,000 samples is painted in %.2f ms", milliseconds);
  QVERIFY(milliseconds < 40);
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme::apply(application, true);
  TestWidgets test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_widgets.moc"
