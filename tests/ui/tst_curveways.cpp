// SPDX-License-Identifier: Apache-2.0
// How a curve goes between its points, as hands choose it in the workspace Tune.
#include "core/io/projectio.h"
#include "tests/ui/curvewindow.h"
#include "ui/curves/curvechecks.h"
#include "ui/curves/pointtable.h"
#include "ui/curves/responselist.h"
#include "ui/panels/materialspanel.h"
#include "ui/session/selection.h"
#include "ui/session/sourcemime.h"

#include <QtGui/QClipboard>
#include <QtWidgets/QComboBox>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTableWidget>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>
#include <set>

using namespace ps;

class TestCurveWays : public CurveWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { openTune(); }
  void init() { tuneFromTheStart(); }

  /// The way between points: of all by the box, of one in the table, and slopes by a handle or a number.
  void waysBetweenPointsAreChosen() {
    threePoints();
    auto* panel = m_window->findChild<CurvePanel*>();
    QComboBox* between = panel->between();
    const auto choose = [between](Between way) {
      between->setCurrentIndex(static_cast<int>(way));
      Q_EMIT between->activated(static_cast<int>(way));
    };
    const std::string before = writeProject(document().project());
    const int index = document().undoStack().index();
    QCOMPARE(between->currentText(), QStringLiteral("Monotone"));
    choose(Between::Linear);
    QVERIFY(std::abs(response().at(295) - 0.00125) < 1e-15);
    QCOMPARE(pages().table()->item(1, 2)->text(), QStringLiteral("Linear"));
    QCOMPARE(document().undoStack().index(), index + 1);
    QVERIFY(!curve().handleAt(true));
    // No smooth piece meets a point: it has no slope, and says why it takes none.
    curves().choosePoint(1);
    QVERIFY(panel->slopeField()->isVisible() && panel->slopeField()->text().isEmpty());
    const std::string linear = writeProject(document().project());
    type(panel->slopeField(), QStringLiteral("-0.01"));
    QCOMPARE(writeProject(document().project()), linear);
    QCOMPARE(document().undoStack().index(), index + 1);
    QVERIFY2(panel->noteText().startsWith(QStringLiteral("No smooth piece meets this point")),
             qPrintable(panel->noteText()));
    QVERIFY(panel->slopeField()->text().isEmpty());
    chooseInTable(0, Between::Step);
    QCOMPARE(response().at(309.9), 0.0015);
    QCOMPARE(between->currentIndex(), -1);  // mixed
    choose(Between::Monotone);
    QCOMPARE(writeProject(document().project()), before);
    curves().choosePoint(1);
    QVERIFY(curve().handleAt(true) && curve().handleAt(false));
    QVERIFY(panel->slopeField()->isVisible());
    type(panel->slopeField(), QStringLiteral("-0.01"));  // decades per K
    const double slope = -0.01 * 0.001 * std::log(10.0);
    QVERIFY(std::abs(*response().points[1].slopeAfter / slope - 1) < 1e-9);
    QVERIFY(std::abs(*response().points[1].slopeBefore / slope - 1) < 1e-9);
    QCOMPARE(pages().table()->item(0, 2)->text(), QStringLiteral("Stated slopes"));
    type(panel->slopeField(), QStringLiteral("steep"));
    QVERIFY(std::abs(*response().points[1].slopeAfter / slope - 1) < 1e-9);
    type(panel->slopeField(), {});
    QCOMPARE(writeProject(document().project()), before);
  }

  void aHandleTurnsTheCurveAtItsPoint() {
    threePoints();
    curves().choosePoint(1);
    const int index = document().undoStack().index();
    const QPointF centre = curve().at(310, 0.001);
    const auto turn = [&](bool after, const QPoint& way, Qt::KeyboardModifiers modifiers = {}) {
      pull(curve().handleAt(after).value().toPoint(), way, modifiers);
    };
    const double slope = slopeAfter(response().points, 1);
    turn(true, {0, 20});
    QCOMPARE(document().undoStack().index(), index + 1);
    QVERIFY(*response().points[1].slopeAfter < slope);
    QCOMPARE(response().points[1].slopeBefore, response().points[1].slopeAfter);
    QCOMPARE(response().points[1].y, 0.001);
    const QPointF way = *curve().handleAt(true) - centre, other = *curve().handleAt(false) - centre;
    QVERIFY(std::abs(way.x() + other.x()) < 1e-6 && std::abs(way.y() + other.y()) < 1e-6);  // in one line
    const double kept = *response().points[1].slopeAfter;
    turn(false, {0, -20}, Qt::ControlModifier);  // one side alone
    QCOMPARE(response().points[1].slopeAfter, std::optional(kept));
    QVERIFY(*response().points[1].slopeBefore != kept);
    const std::string before = writeProject(document().project());
    QTest::mousePress(&curve(), Qt::LeftButton, {}, curve().handleAt(true)->toPoint());
    QTest::mouseMove(&curve(), curve().handleAt(true)->toPoint() + QPoint(0, 30));
    QTest::keyClick(&curve(), Qt::Key_Escape);
    QCOMPARE(writeProject(document().project()), before);
    QTest::mouseRelease(&curve(), Qt::LeftButton);
    shoot("handles");
  }

  /// A point that is typed out of sight is in sight at once, and one in sight leaves the view as it is.
  void aTypedValueStaysInSight() {
    threePoints();
    curves().choosePoint(1);
    auto* panel = m_window->findChild<CurvePanel*>();
    const QPoint first = place(0);
    type(panel->valueField(), QStringLiteral("*1.1"));
    QVERIFY(std::abs(response().points[1].y - 0.0011) < 1e-9);
    QCOMPARE(place(0), first);
    type(panel->valueField(), QStringLiteral("*10000"));
    QVERIFY(std::abs(response().points[1].y - 11) < 1e-6);
    QVERIFY(place(0) != first);
    for (const size_t k : {size_t{0}, size_t{1}, size_t{2}}) QVERIFY(curve().plot().contains(place(k)));
  }

  /// Slopes that lead where the property cannot be are refused with a sentence, and the last ones stay.
  void slopesThatOvershootAreRefused() {
    curves().choose({Owner::Material, "water", "yield_stress"});
    QVERIFY(curves().set(curveThrough({{260, 1}, {310, 1}}), QStringLiteral("Points")));
    QSignalSpy refused(&curves(), &CurveTarget::refused);
    Response steep = response();
    stateSlope(steep, 0, -1);
    QVERIFY(!curves().set(steep, QStringLiteral("Slope")));
    QVERIFY(refused.last()[0].toString().contains(QStringLiteral("where the slopes of its points lead")));
    QVERIFY(!response().points[0].slopeAfter);
  }

  /// A table that was copied takes the place of all points; what is no table changes nothing and says why.
  void aTableIsPasted() {
    threePoints();
    const int index = document().undoStack().index();
    QGuiApplication::clipboard()->setText(
        QStringLiteral("T [K]\tmu [Pa s]\r\n280\t1.4e-3\r\n300\t0,9e-3\r\n340\t0.5e-3\r\n"));
    pages().paste();
    QCOMPARE(document().undoStack().index(), index + 1);
    QCOMPARE(response().points.size(), size_t{3});
    QVERIFY(std::abs(response().points[1].x - 300) < 1e-9);
    QVERIFY(pages().noteText().contains(QStringLiteral("3 points")));
    const std::string before = writeProject(document().project());
    for (const auto& [text, part] : {std::pair("words", "two columns"), std::pair("1 2\n1 3", "Two rows are at"),
                                     std::pair("10 0.001\n20 much", "Row 2"), std::pair("20 -5\n30 1", "at least")}) {
      QGuiApplication::clipboard()->setText(QString::fromLatin1(text));
      pages().paste();
      QCOMPARE(writeProject(document().project()), before);
      QVERIFY2(pages().noteText().contains(QString::fromLatin1(part)), qPrintable(pages().noteText()));
    }
  }

  void columnsAndUnitsAreRead_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("tabs and points") << QStringLiteral("0\t1.5\n20\t2.5");
    QTest::newRow("semicolons and commas") << QStringLiteral("0;1,5\n20;2,5\n");
    QTest::newRow("spaces") << QStringLiteral("  0   1.5\n\n 20\t 2.5 ");
    QTest::newRow("commas between") << QStringLiteral("0,1.5\n20,2.5");
    QTest::newRow("commas and spaces") << QStringLiteral("0, 1.5\n20, 2.5");
    QTest::newRow("out of order") << QStringLiteral("20\t2.5\n0\t1.5");
    QTest::newRow("headings") << QStringLiteral("Temperature\tValue\n0\t1.5\n20\t2.5");
    QTest::newRow("kelvin in the heading") << QStringLiteral("T/K;k\n273.15;1,5\n293.15;2,5");
    QTest::newRow("units in the cells") << QStringLiteral("0 °C\t1.5\n293.15 K\t2.5");
  }
  void columnsAndUnitsAreRead() {
    QFETCH(QString, text);
    curves().choose(kConductivity);
    const PastedTable table = readTable(text, temperatureDeclaration(), curves().declaration());
    QCOMPARE(table.problem, QString());
    QCOMPARE(table.points.size(), size_t{2});
    QVERIFY(std::abs(table.points[0].x - 273.15) < 1e-9 && std::abs(table.points[1].x - 293.15) < 1e-9);
    QCOMPARE(table.points[0].y, 1.5);
    QCOMPARE(table.points[1].y, 2.5);
  }

  void pointsAreThinnedOut() {
    std::vector<CurvePoint> many;
    for (int k = 0; k <= 40; ++k) many.push_back({270.0 + 2 * k, 1e-3 * std::exp(-k / 15.0)});
    QVERIFY(curves().set(curveThrough(many), QStringLiteral("Points")));
    const Response dense = response();
    pages().toleranceField()->setText(QStringLiteral("0"));
    pages().thinOut();
    QVERIFY(response() == dense);
    pages().toleranceField()->setText(QStringLiteral("0,5 %"));
    const int index = document().undoStack().index();
    pages().thinOut();
    QCOMPARE(document().undoStack().index(), index + 1);
    QVERIFY(response().points.size() < 10);
    for (double t = 270; t <= 350; t += 0.5) QVERIFY(std::abs(response().at(t) / dense.at(t) - 1) < 0.0051);
    QVERIFY2(pages().noteText().contains(QStringLiteral("of 41 points are left")), qPrintable(pages().noteText()));
  }

  void checksSayHowTheCurveGoes() {
    const auto said = [this](const QString& part) {
      const auto checks = checksOf(curves());
      return std::any_of(checks.begin(), checks.end(), [&](const CurveCheck& c) { return c.text.contains(part); });
    };
    threePoints();
    QVERIFY(said(QStringLiteral("Falls with temperature everywhere")));
    QVERIFY(said(QStringLiteral("All values are usual ones")));
    QVERIFY(said(QStringLiteral("particles lie beyond its points")));  // the ice is at 263 K
    QVERIFY(curves().set(curveThrough({{250, 1e-3}, {300, 1e4}, {350, 1}}), QStringLiteral("Points")));
    QVERIFY(said(QStringLiteral("Rises up to 26.")));
    QVERIFY(said(QStringLiteral("is above what is usual")));
    QVERIFY(said(QStringLiteral("All particles lie between its points")));
    curves().choose({Owner::Material, "water", "youngs_modulus"});
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(curves().delivered().has_value(), kLong);
    QVERIFY(said(QStringLiteral("The solver follows 0 % of the particles")));
    QVERIFY(said(QStringLiteral("as far as the solver follows")));
    QVERIFY(m_window->findChild<CurveChecks*>()->isVisible());
  }

  void aDroppedMaterialIsDrawnBesideIt() {
    const std::string other = document().addMaterial("ethanol");
    m_window->selection().setMaterial("water");
    auto* list = m_window->findChild<ResponseList*>()->others();
    QCOMPARE(list->item(0)->checkState(), Qt::Unchecked);
    QMimeData data;
    data.setData(QLatin1String(kMaterialMime), QByteArray::fromStdString(other));
    QVERIFY(hands::drop(curve(), data));
    QVERIFY(curves().compared().contains({other}));
    QCOMPARE(list->item(0)->checkState(), Qt::Checked);
    list->item(0)->setCheckState(Qt::Unchecked);
    QVERIFY(curves().compared().empty());
    QMimeData text;
    text.setText(QStringLiteral("water"));
    QVERIFY(!hands::drop(curve(), text));
  }

  /// What is installed alone is drawn beside it without coming into the scene; when it comes, it is the same curve.
  void aDroppedMaterialThatIsOnlyInstalledIsDrawnBesideIt() {
    const std::string before = writeProject(document().project());
    const QImage alone = curve().grab().toImage();
    QMimeData data;
    data.setData(QLatin1String(kInstalledMime), "ethanol");
    QVERIFY(hands::drop(curve(), data));
    QVERIFY(curves().compared().contains({"ethanol", true}));
    QCOMPARE(writeProject(document().project()), before);
    QVERIFY(curve().grab().toImage() != alone);
    const Response installed = curves().otherResponse({"ethanol", true});
    QVERIFY(std::abs(installed.at(298) / 1.07e-3 - 1) < 0.05);  // Pa s, CRC Handbook
    auto* list = m_window->findChild<ResponseList*>()->others();
    QCOMPARE(list->count(), 1);
    QCOMPARE(list->item(0)->text(), QStringLiteral("Ethanol"));
    shoot("installed");
    list->item(0)->setCheckState(Qt::Unchecked);
    QVERIFY(curves().compared().empty());
    QCOMPARE(curve().grab().toImage(), alone);
    list->item(0)->setCheckState(Qt::Checked);
    const std::string own = document().addMaterial("ethanol");
    QCOMPARE(curves().compared(), (std::set<OtherMaterial>{{own}}));
    QCOMPARE(list->count(), 1);
    QVERIFY(curves().otherResponse({own}) == installed);
    curves().compare({own}, false);
  }

  /// By the menu below the list, or dropped there.
  void whatIsInstalledIsAddedToTheList() {
    auto* list = m_window->findChild<ResponseList*>();
    QMenu* menu = list->addButton()->menu();
    QVERIFY(list->addButton()->isVisible() && !hands::entryOf(*menu, {QStringLiteral("Water")}));
    QAction* ethanol = hands::entryOf(*menu, {QStringLiteral("Ethanol")});
    QVERIFY(ethanol);
    ethanol->trigger();
    QCOMPARE(curves().compared(), (std::set<OtherMaterial>{{"ethanol", true}}));
    QVERIFY(!hands::entryOf(*menu, {QStringLiteral("Ethanol")}));
    QMimeData data;
    data.setData(QLatin1String(kInstalledMime), "iron");
    QVERIFY(hands::drop(*list, data));
    QCOMPARE(list->others()->count(), 2);
    QCOMPARE(list->others()->item(1)->checkState(), Qt::Checked);
    shoot("compare-with");
    for (int row = 0; row < 2; ++row) list->others()->item(row)->setCheckState(Qt::Unchecked);
    QVERIFY(curves().compared().empty() && !document().undoStack().canUndo());
  }

  /// As the material that it is of; its own curve is there already.
  void aDroppedBodyIsItsMaterial() {
    const QModelIndex ice = hands::outlined(*m_window, OutlineKind::Body, "ice");
    QVERIFY(ice.isValid() && (ice.flags() & Qt::ItemIsDragEnabled));
    const std::unique_ptr<QMimeData> data = hands::dragged(ice);
    QVERIFY(!data->hasFormat(QLatin1String(kSourceMime)));
    QVERIFY(hands::drop(curve(), *data));
    QVERIFY(curves().compared().empty());
    QCOMPARE(m_window->findChild<CurvePanel*>()->noteText(), QStringLiteral("This is the curve of Water already."));
    m_window->selection().setMaterial(document().addMaterial("ethanol"));
    QVERIFY(hands::drop(curve(), *data));
    QCOMPARE(curves().compared(), (std::set<OtherMaterial>{{"water"}}));
    curves().compare({"water"}, false);
  }

  /// The mean of the particles, or what is selected: a probe of temperature, a particle.
  void theMarkIsOfWhatIsSelected() {
    const auto who = [this] { return curves().mark(curves().now(200, 600)).value_or(CurveMark{}).who; };
    QVERIFY(who().startsWith(QStringLiteral("Mean of its particles")));
    const std::vector<Probe>& probes = document().project().probes;
    const auto found =
        std::find_if(probes.begin(), probes.end(), [](const Probe& p) { return p.quantity == "temperature"; });
    QVERIFY(found != probes.end());
    const Probe& probe = *found;
    m_window->selection().select(OutlineKind::Probe, probe.id);
    QCOMPARE(who(), QString::fromStdString(probe.name) + QStringLiteral(", now"));
    QVERIFY(std::abs(curves().mark(curves().now(200, 600))->x - 263.15) < 0.01);
    m_window->selection().clear();
    m_window->selection().mark(session().snapshot()->revision, session().snapshot()->id[5]);
    QVERIFY(who().startsWith(QStringLiteral("Selected particle")));
  }

  /// At the start all is ice: what is of the liquid says so.
  void aPhaseThatIsNotThereIsSaid() {
    const auto* list = m_window->findChild<ResponseList*>()->list();
    QStringList texts;
    for (int i = 0; i < list->count(); ++i)
      texts << list->item(i)->data(Qt::DisplayRole).toString() + QLatin1Char(':') +
                   list->item(i)->data(Qt::UserRole + 1).toString();
    const auto row = [&](const QString& name) { return texts.filter(name).join(QLatin1Char(' ')); };
    QVERIFY2(row(QStringLiteral("Viscosity")).contains(QStringLiteral("no liquid now")),
             qPrintable(texts.join(QLatin1Char('\n'))));
    QVERIFY(row(QStringLiteral("vapour")).contains(QStringLiteral("no gas now")));
    QVERIFY(!row(QStringLiteral("Density, solid")).contains(QStringLiteral("now")));
  }

 private:
  /// Through the menu that a click on the cell opens.
  void chooseInTable(int row, Between way) {
    QTableWidget* table = pages().table();
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, table->visualItemRect(table->item(row, 2)).center());
    auto* menu = pages().findChild<QMenu*>();
    QVERIFY(menu);
    menu->actions()[static_cast<int>(way)]->trigger();
    menu->close();
  }
};

QTEST_MAIN(TestCurveWays)
#include "tst_curveways.moc"
