// SPDX-License-Identifier: Apache-2.0
// The workspace Tune as hands use it: curve, points, laws, in the real window.
#include "core/io/projectio.h"
#include "core/simulation/engine.h"
#include "tests/ui/curvewindow.h"
#include "ui/curves/matterdiagram.h"
#include "ui/curves/responselist.h"
#include "ui/panels/inspector.h"
#include "ui/session/selection.h"
#include "ui/window/dock.h"

#include <QtGui/QAccessible>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QTableWidget>

#include <cmath>
#include <numeric>

using namespace ps;

class TestCurves : public CurveWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { openTune(); }
  void init() { tuneFromTheStart(); }

  /// Each edit is a step; undone and done again, the project is the same to the byte.
  void everyEditIsAStepThereAndBack() {
    const auto text = [this] { return writeProject(document().project()); };
    std::vector<std::string> states{text()};
    const auto step = [&](const char* what) {
      QVERIFY2(text() != states.back(), what);
      states.push_back(text());
      QVERIFY2(document().undoStack().index() == static_cast<int>(states.size()) - 1, what);
    };
    const Response law = response();
    pages().sample();
    step("sampled");
    for (double t = response().points.front().x; t <= response().points.back().x; t += 1)
      QVERIFY(std::abs(std::log(response().at(t) / law.at(t))) < 1.01 * kLawTolerance);
    drag(2, {0, -30});
    step("dragged");
    const size_t before = response().points.size();  // the last are the farthest apart
    const double kelvin = 0.5 * (response().points[before - 2].x + response().points[before - 1].x);
    const QPoint on = curve().at(kelvin, response().at(kelvin)).toPoint();
    QTest::mouseDClick(&curve(), Qt::LeftButton, {}, on);
    step("added");
    QCOMPARE(response().points.size(), before + 1);
    QCOMPARE(curves().point(), static_cast<int>(before) - 1);
    QTest::keyClick(&curve(), Qt::Key_Delete);
    step("deleted");
    QCOMPARE(response().points.size(), before);
    pages().fitNearest();
    step("fitted");
    QVERIFY(response().kind == Response::Kind::Law);
    pages().chooseKind("arrhenius");
    step("another law");
    QCOMPARE(response().law, std::string("arrhenius"));
    pages().chooseKind("constant");
    step("constant");
    QVERIFY(response().kind == Response::Kind::Constant);
    pages().chooseKind("points");
    step("points of the constant");
    QCOMPARE(response().points.size(), size_t{2});
    History& stack = document().undoStack();
    for (size_t k = states.size(); k-- > 1;) {
      QCOMPARE(text(), states[k]);
      stack.undo();
    }
    QCOMPARE(text(), states[0]);
    for (size_t k = 1; k < states.size(); ++k) {
      stack.redo();
      QCOMPARE(text(), states[k]);
    }
  }

  void aLawGoesThroughAPointOfZero() {
    curves().choose({Owner::Material, "water", "yield_stress"});
    QVERIFY(curves().set(curveThrough({{260, 0}, {310, 3}, {350, 5}}), QStringLiteral("Points")));
    pages().fitNearest();
    QVERIFY(response().kind == Response::Kind::Law);
    QCOMPARE(response().law, std::string("linear"));  // no other law can be 0
  }

  void modifiersOfADrag() {
    threePoints();
    const Response start = response();
    drag(1, {40, -40}, Qt::ControlModifier);
    QCOMPARE(response().points[1].x, start.points[1].x);  // up alone
    QVERIFY(response().points[1].y > start.points[1].y);
    document().undoStack().undo();
    drag(1, {40, 0}, Qt::ShiftModifier);
    const QPointF fine = curve().at(response().points[1].x, response().points[1].y);
    const QPointF from = curve().at(start.points[1].x, start.points[1].y);
    QVERIFY(std::abs(fine.x() - from.x() - 4) < 0.01);  // a tenth of the way
    document().undoStack().undo();
    drag(1, {0, -30}, Qt::AltModifier);
    const double factor = response().points[1].y / start.points[1].y;
    QVERIFY(factor > 1.01);
    for (size_t i = 0; i < 3; ++i)  // all by one factor: the axis is logarithmic
      QVERIFY(std::abs(response().points[i].y / start.points[i].y / factor - 1) < 1e-9);
    document().undoStack().undo();
    drag(0, {2000, 0});
    QVERIFY(response().points[0].x < start.points[1].x);  // not past its neighbour
    QCOMPARE(QString::fromStdString(response().problem()), QString());
  }

  void escapeTakesADragBack() {
    threePoints();
    const std::string before = writeProject(document().project());
    const int index = document().undoStack().index();
    const QPoint from = place(1);
    QTest::mousePress(&curve(), Qt::LeftButton, {}, from);
    QTest::mouseMove(&curve(), from + QPoint(20, 20));
    QVERIFY(writeProject(document().project()) != before);
    QTest::keyClick(&curve(), Qt::Key_Escape);
    QCOMPARE(writeProject(document().project()), before);
    QTest::mouseRelease(&curve(), Qt::LeftButton, {}, from);
    QCOMPARE(document().undoStack().index(), index);
  }

  void aDragEndsWhereTheCurveIsHidden() {
    threePoints();
    const int index = document().undoStack().index();
    const QPoint from = place(1);
    QTest::mousePress(&curve(), Qt::LeftButton, {}, from);
    QTest::mouseMove(&curve(), from + QPoint(20, 20));
    QTest::keyClick(&curve(), Qt::Key_PageDown);
    QCOMPARE(curves().point(), 1);  // it is held
    m_window->showWorkspace(MainWindow::kSceneTab);
    const Address gravity{Owner::Scene, "", "gravity"};
    for (const double g : {5.0, 6.0}) QCOMPARE(document().setParameter(gravity, g), QString());
    QCOMPARE(document().undoStack().index(), index + 3);  // the drag, and two steps of their own
    m_window->showWorkspace(MainWindow::kTuneTab);
    QTest::mouseRelease(&curve(), Qt::LeftButton, {}, from + QPoint(20, 20));
    QCOMPARE(document().undoStack().index(), index + 3);
  }

  void whatIsDraggedActsOnRunningMatter() {
    threePoints();
    session().play();
    const uint64_t began = session().newest()->stats.frame;
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > began, kLong);
    const auto baked = [this] {
      return onEngine<double>(session(), [](Engine& engine) { return engine.solver().materials()[0].viscosity(300); });
    };
    const double before = baked();
    QTest::mousePress(&curve(), Qt::LeftButton, {}, place(1));
    QTest::mouseMove(&curve(), place(1) + QPoint(0, -30));
    QVERIFY(baked() > 1.01 * before);  // while the button is down
    const uint64_t acted = session().newest()->stats.frame;
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > acted, kLong);  // and the run goes on by it
    QTest::mouseRelease(&curve(), Qt::LeftButton, {}, place(1));
    QVERIFY(session().playing());
  }

  /// While the run goes on, of all particles of the material.
  void theHistogramFollows() {
    QTRY_VERIFY_WITH_TIMEOUT(curve().particles().count > 0, kLong);
    const std::vector<size_t> before = curve().particles().bins;
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(curve().particles().bins != before, kLong);
    const MaterialNow& now = curve().particles();
    QCOMPARE(now.count, session().snapshot()->id.size());  // the scene has no other matter
    QCOMPARE(std::accumulate(now.bins.begin(), now.bins.end(), size_t{0}), now.within);
    QVERIFY(now.within > 0 && now.within <= now.count);
  }

  void keysWalkAndNudge() {
    threePoints();
    QTest::keyClick(&curve(), Qt::Key_PageDown);
    QCOMPARE(curves().point(), 0);
    QTest::keyClick(&curve(), Qt::Key_PageDown);
    QCOMPARE(curves().point(), 1);
    const CurvePoint start = response().points[1];
    QTest::keyClick(&curve(), Qt::Key_Right);
    QVERIFY(response().points[1].x > start.x);
    QCOMPARE(response().points[1].y, start.y);
    QTest::keyClick(&curve(), Qt::Key_Up);
    QVERIFY(response().points[1].y > start.y);
    QAccessibleInterface* access = QAccessible::queryAccessibleInterface(&curve());
    QVERIFY(access->text(QAccessible::Name).contains(QStringLiteral("Viscosity")));
    QVERIFY(access->text(QAccessible::Value).startsWith(QStringLiteral("Point 2 of 3")));
    const uint64_t frame = session().snapshot()->stats.frame;
    QTest::keyClick(&curve(), Qt::Key_Escape);
    QCOMPARE(curves().point(), -1);
    QCOMPARE(session().snapshot()->stats.frame, frame);  // the arrow was the curve's, not the simulation's
  }

  void numbersAreTyped() {
    threePoints();
    curves().choosePoint(1);
    auto* panel = m_window->findChild<CurvePanel*>();
    type(panel->temperatureField(), QStringLiteral("300 K"));
    QVERIFY(std::abs(response().points[1].x - 300) < 1e-9);
    type(panel->valueField(), QStringLiteral("*2"));
    QVERIFY(std::abs(response().points[1].y - 0.002) < 1e-12);
    const std::string before = writeProject(document().project());
    type(panel->valueField(), QStringLiteral("much"));
    QCOMPARE(writeProject(document().project()), before);
    pages().table()->item(0, 1)->setText(QStringLiteral("0.003 Pa·s"));
    QVERIFY(std::abs(response().points[0].y - 0.003) < 1e-12);
  }

  void theSmallCurveOfARowOpensTune() {
    threePoints(kConductivity);
    m_window->showWorkspace(MainWindow::kSceneTab);
    QVERIFY(!curve().isVisible());
    QVERIFY(m_window->revealParameter(kConductivity, false));
    ParameterRow* row = m_window->inspector().materialPanel()->row(QString::fromStdString(kConductivity.text()));
    QVERIFY(row);
    QTest::mouseClick(row, Qt::LeftButton, {}, row->sliderRect().center());
    QCOMPARE(m_window->workspaceTab(), MainWindow::kTuneTab);
    QVERIFY(curve().isVisible());
    QCOMPARE(curves().address(), kConductivity);
    QCOMPARE(document().undoStack().index(), 1);  // the click scaled nothing
  }

  void workspacesKeepTheirDocks() {
    const auto shown = [this](const char* name) {
      return m_window->layoutOfDocks().dock(QString::fromLatin1(name))->isVisible();
    };
    QVERIFY(shown("dock.curve") && shown("dock.points") && shown("dock.responses") && !shown("dock.inspector"));
    m_window->selection().selectBody("ice");  // its page does not come between
    QVERIFY(!shown("dock.inspector"));
    QTest::keyClick(m_window.get(), Qt::Key_Tab, Qt::ControlModifier);
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSketchTab);
    QVERIFY(!shown("dock.curve") && shown("dock.inspector") && m_window->tools().tool().usesBrush());
    QTest::keyClick(m_window.get(), Qt::Key_Tab, Qt::ControlModifier);
    QCOMPARE(m_window->workspaceTab(), MainWindow::kFilmTab);
    QVERIFY(shown("dock.film") && !shown("dock.inspector") && !shown("dock.graphs"));
    QTest::keyClick(m_window.get(), Qt::Key_Tab, Qt::ControlModifier);
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSceneTab);
    m_window->layoutOfDocks().dock(QStringLiteral("dock.graphs"))->hide();
    m_window->showWorkspace(MainWindow::kTuneTab);
    QVERIFY(shown("dock.graphs"));
    m_window->showWorkspace(MainWindow::kSceneTab);
    QVERIFY(!shown("dock.graphs"));
    m_window->layoutOfDocks().applyDefault();
    QVERIFY(shown("dock.graphs"));
    m_window->showWorkspace(MainWindow::kTuneTab);
    QVERIFY(m_window->revealParameter(kViscosity));
    QCOMPARE(m_window->workspaceTab(), MainWindow::kSceneTab);
  }

  void theHistogramCountsEveryParticleOnce() {
    const SnapshotPtr snapshot = session().snapshot();
    const auto all = static_cast<size_t>(std::count(snapshot->material.begin(), snapshot->material.end(), 0u));
    const MaterialNow now = curves().now(200, 600);
    QVERIFY(all > 100);
    QCOMPARE(now.count, all);
    QCOMPARE(now.within, all);
    QCOMPARE(std::accumulate(now.bins.begin(), now.bins.end(), size_t{0}), all);
    QVERIFY(std::abs(now.mean - 263.15) < 0.01);  // the block as it starts
    const auto bin = static_cast<size_t>((263.15 - 200) / 400 * MaterialNow::kBins);
    QCOMPARE(now.bins[bin], all);
    QVERIFY(!now.marked);
    m_window->selection().mark(snapshot->revision, snapshot->id[5]);
    QVERIFY(curves().now(200, 600).marked.has_value());
    QVERIFY(curve().particles().marked.has_value());  // although nothing runs
  }

  void whatWasHiddenShowsWhatIs() {
    m_window->showWorkspace(MainWindow::kSceneTab);
    const uint64_t wanted = session().snapshot()->stats.frame + 5;
    for (int k = 0; k < 5; ++k) session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame >= wanted, kLong);
    QVERIFY(curve().particles().mean != curves().now(0, 1).mean);
    m_window->showWorkspace(MainWindow::kTuneTab);
    QCOMPARE(curve().particles().mean, curves().now(0, 1).mean);
  }

  void diagramsFollowTheMaterial() {
    const auto diagram = [this](const char* title) {
      m_window->layoutOfDocks().showPage(QString::fromLatin1(title));
      for (auto* found : m_window->findChildren<MatterDiagram*>()) {
        if (found->isVisible()) return found;
      }
      return static_cast<MatterDiagram*>(nullptr);
    };
    MatterDiagram* heating = diagram("Heating curve");
    QVERIFY(heating);
    QCOMPARE(heating->summary(), QStringLiteral("solid 100 %"));
    const auto plateau = [heating] { return heating->corners()[2].enthalpy - heating->corners()[1].enthalpy; };
    const double before = plateau();
    const Address latent{Owner::Material, "water", "latent_heat_fusion"};
    const double heat = responseOf(document().value(latent)).at(300);
    QVERIFY(std::abs(before - heat) < 1e-6 * heat);
    QCOMPARE(document().setParameter(latent, 2 * heat), QString());
    QVERIFY(std::abs(plateau() - 2 * heat) < 1e-6 * heat);
    shoot("heating");
    MatterDiagram* phases = diagram("Phase diagram");
    QVERIFY(phases && phases != heating);
    shoot("phases");
    m_window->layoutOfDocks().showPage(QStringLiteral("Graphs"));
  }

  /// Ice is stiffer than a step can follow: so says its row, and so does the curve.
  void whatTheSolverDoesNotFollowIsMarked() {
    curves().choose({Owner::Material, "water", "youngs_modulus"});
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(!session().snapshot()->limits.empty(), kLong);
    const auto most = curves().delivered();
    QVERIFY(most && *most > 0 && *most < response().at(263));
    curve().fit();
    QVERIFY(curve().at(263, *most).y() < curve().plot().bottom());  // in sight
    shoot("limit");
  }

  void theWheelZoomsAroundThePointer() {
    const QPointF at = curve().plot().center();
    const double kelvin = curve().kelvinAt(at.x()), span = curve().kelvinAt(at.x() + 100) - kelvin;
    QWheelEvent wheel(at, curve().mapToGlobal(at), {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&curve(), &wheel);
    QVERIFY(std::abs(curve().kelvinAt(at.x()) - kelvin) < 1e-9);
    QVERIFY(curve().kelvinAt(at.x() + 100) - kelvin < 0.9 * span);
    QTest::keyClick(&curve(), Qt::Key_F);
    QVERIFY(std::abs(curve().kelvinAt(at.x() + 100) - curve().kelvinAt(at.x()) - span) < 1e-9);
  }

  void theCurveIsDrawnWhereItsValuesAre() {
    threePoints();
    const QImage picture = curve().grab().toImage();
    const QColor line = Theme::current()[Token::Curve];
    for (const double kelvin : {290.0, 300.0, 325.0, 340.0}) {
      const QPoint at = (curve().at(kelvin, response().at(kelvin)) * picture.devicePixelRatio()).toPoint();
      int nearest = 1000;  // of a pixel and those around it: the line is a little wider than two
      for (int k = 0; k < 9; ++k) {
        const QColor drawn = picture.pixelColor(at + QPoint(k % 3 - 1, k / 3 - 1));
        nearest = std::min(nearest, std::abs(drawn.red() - line.red()) + std::abs(drawn.blue() - line.blue()));
      }
      QVERIFY2(nearest < 60, qPrintable(QString::number(nearest)));
    }
  }

  void pictures() {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    const std::string iron = document().addMaterial("ethanol");
    m_window->selection().setMaterial("water");
    QCOMPARE(curves().material(), std::string("water"));
    auto* list = m_window->findChild<ResponseList*>();
    QCOMPARE(list->others()->count(), 1);
    list->others()->item(0)->setCheckState(Qt::Checked);
    QVERIFY(curves().compared().contains({iron}));
    pages().sample();
    curves().choosePoint(4);
    QVERIFY(curves().ghost().has_value() || response().kind == Response::Kind::Curve);
    if (folder.isEmpty()) return;
    for (const bool dark : {true, false}) {
      m_window->setDark(dark);
      m_window->resize(1600, 1000);
      QTest::qWait(400);
      m_window->grab().save(folder + (dark ? QStringLiteral("/tune-dark.png") : QStringLiteral("/tune-light.png")));
    }
    m_window->setDark(true);
    m_window->resize(1280, 800);
  }
};

QTEST_MAIN(TestCurves)
#include "tst_curves.moc"
