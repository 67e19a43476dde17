// SPDX-License-Identifier: Apache-2.0
// Graphs and probes by hands in the real window: made, dropped, split, read with cursors, zoomed, written to files;
// each undone and redone to the same project.
#include "core/io/projectio.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/graphs/distributionview.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/stackview.h"
#include "ui/panels/inspector.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/rowcommands.h"
#include "ui/session/selection.h"
#include "ui/window/dock.h"

#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtGui/QWheelEvent>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <cmath>
#include <iterator>

using namespace ps;

class TestGraphsWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    session().pause();
  }
  void init() {
    while (document().undoStack().canUndo()) document().undoStack().undo();
    document().undoStack().clear();
    for (Plot* plot : graphs()->plots()) {
      plot->fit();
      plot->setReading(0, {});
      plot->setReading(1, {});
    }
  }
  void cleanupTestCase() { m_window.reset(); }

  void aProbeIsDroppedOnAGraph() {
    const std::string before = json();
    GraphView* view = graphs()->valuesIn("K");
    const int lines = view->seriesCount();
    // What the outliner hands out for its row.
    const QModelIndex row = hands::outlined(*m_window, OutlineKind::Probe, "ice_mass");
    QVERIFY(row.isValid() && (row.flags() & Qt::ItemIsDragEnabled));
    const std::unique_ptr<QMimeData> data = hands::dragged(row);
    QVERIFY(hands::drop(*view, *data));
    QCOMPARE(view->seriesCount(), lines + 1);
    QCOMPARE(view->axes().size(), size_t{2});  // grams beside degrees
    QCOMPARE(view->axes()[1].unit, QStringLiteral("g"));
    QCOMPARE(document().project().graphs->front().series.back(), std::string("probe/ice_mass"));
    QVERIFY(hands::drop(*view, *data));  // it is there already
    QCOMPARE(document().undoStack().count(), 1);
    QTRY_VERIFY_WITH_TIMEOUT(view->sampleCount(lines) == view->sampleCount(0), kLong);
    picture("graphs-two-axes.png");
    undoneAndRedone(before);
    // On a stack it gets a graph of its own.
    QVERIFY(hands::drop(*graphs()->phases(), *data));
    QCOMPARE(graphs()->plots().size(), size_t{3});
  }

  /// By the menu of any of its rows: what it measures.
  void aRowOfAProbePlotsIt() {
    m_window->selection().select(OutlineKind::Probe, "ice_mass");
    ParameterRow* row = nullptr;
    for (ParameterRow* one : m_window->findChildren<ParameterRow*>()) {
      if (one->isVisible() && one->key().startsWith(QStringLiteral("probe/ice_mass/"))) row = one;
    }
    QVERIFY(row && whyNot(*row, RowCommand::Plot).isEmpty());
    const size_t before = document().graphs().size();
    perform(*row, RowCommand::Plot, {});
    QCOMPARE(document().graphs().size(), before + 1);
    QCOMPARE(document().graphs().back().series, (std::vector<std::string>{"probe/ice_mass"}));
    document().undoStack().undo();
  }

  void graphsAreAddedSplitMovedAndRemoved() {
    const std::string before = json();
    choose(first(), {"Split: below it", "Histogram of a field"});
    QCOMPARE(graphs()->plots().size(), size_t{3});
    auto* view = qobject_cast<DistributionView*>(graphs()->plots()[1]);
    QVERIFY(view && view->isVisibleTo(graphs()));
    QTRY_VERIFY(view->geometry().top() > graphs()->plots()[0]->geometry().bottom());
    QCOMPARE(view->geometry().left(), graphs()->plots()[0]->geometry().left());
    QCOMPARE(view->title(), QStringLiteral("Particles by temperature"));
    undoneAndRedone(before);
    const std::string id = document().graphs()[1].id;
    choose(id, {"Field", "Speed"});
    QCOMPARE(document().graphs()[1].field, std::string("speed"));
    choose(id, {"Move on"});
    QCOMPARE(document().graphs()[2].id, id);
    choose(id, {"Remove graph"});
    QCOMPARE(graphs()->plots().size(), size_t{2});
    choose({}, {"Add graph", "Profile along an axis"});
    QCOMPARE(document().graphs().back().kind, Graph::Kind::Profile);
    QTRY_VERIFY_WITH_TIMEOUT(!graphs()->plots().back()->summary().contains(QStringLiteral("Press")), kLong);
    undoneAndRedone(before);
    while (!document().graphs().empty()) choose(first(), {"Remove graph"});
    QVERIFY(graphs()->plots().empty() && document().project().graphs->empty());
    undoneAndRedone(before);
    QTRY_VERIFY(document().graphs().empty());
  }

  /// A pluginless field of a distribution comes with the snapshots as soon as a graph is of it.
  void aProfileShowsAFieldThatNothingElseAskedFor() {
    choose(first(), {"Split: beside it", "Profile along an axis"});
    choose(document().graphs()[1].id, {"Field", "Density"});
    Plot* view = graphs()->plots()[1];
    QTRY_VERIFY_WITH_TIMEOUT(view->summary().contains(QStringLiteral("kg/m³")), kLong);
    picture("graphs-profile.png");
    const QByteArray csv = graphs()->exported(document().graphs()[1].id, QStringLiteral("csv"));
    QVERIFY2(csv.startsWith("from y_m,to y_m,particles,mean Density [kg/m³]"), csv.constData());
    QCOMPARE(csv.count('\n'), static_cast<qsizetype>(DistributionView::kBins) + 1);
  }

  void aQuantityIsPlottedByTheMenu() {
    const std::string before = json();
    const size_t probes = document().project().probes.size();
    // Ctrl+K has the menu of every graph: whose they are is listed when it is asked for.
    const std::unique_ptr<QMenu> menu(graphs()->makeMenu(first()));
    for (const QMenu* list : menu->findChildren<QMenu*>())
      QVERIFY(list->title() != QStringLiteral("Body") || list->isEmpty());
    choose(first(), {"Plot", "Body", "Ice block", "Motion", "Highest speed"});
    QCOMPARE(document().project().probes.size(), probes + 1);
    const Probe made = document().project().probes.back();
    QCOMPARE(made.quantity, std::string("speed_max"));
    QCOMPARE(made.body, std::string("ice"));
    QCOMPARE(QString::fromStdString(made.name), QStringLiteral("Ice block highest speed"));
    QCOMPARE(document().graphs().front().series.back(), "probe/" + made.id);
    QCOMPARE(document().undoStack().count(), 1);
    session().step();
    GraphView* view = graphs()->valuesIn("K");
    QTRY_VERIFY_WITH_TIMEOUT(view->summary().contains(QStringLiteral("m/s")), kLong);
    undoneAndRedone(before);
    // Deleted, it takes its curve along.
    const std::string with = json();
    m_window->selection().select(OutlineKind::Probe, made.id);
    m_window->action(QStringLiteral("edit.delete"))->trigger();
    QVERIFY(!document().probe(made.id) && m_window->selection().empty());
    QVERIFY(document().graphs().front().series.back() != "probe/" + made.id);
    document().undoStack().undo();
    QCOMPARE(json(), with);
  }

  /// Of a wall in one list, of the solver by groups; what has curves over temperature is not offered.
  void aParameterIsPlottedByTheMenu_data() {
    QTest::addColumn<QStringList>("path");
    QTest::addColumn<QString>("source");
    QTest::newRow("wall") << QStringList{"Plot", "Parameter", "Hot plate", "Temperature"} << "wall/floor/temperature";
    QTest::newRow("body") << QStringList{"Plot", "Parameter", "Ice block", "Heat", "Heating power"}
                          << "body/ice/heating_power";
    QTest::newRow("scene") << QStringList{"Plot", "Parameter", "Scene", "Gravity"} << "scene/gravity";
    QTest::newRow("solver") << QStringList{"Plot", "Parameter", "Solver", "Time", "Substeps"} << "solver/substeps";
  }
  void aParameterIsPlottedByTheMenu() {
    QFETCH(QStringList, path);
    QFETCH(QString, source);
    const std::string before = json();
    choose(first(), path);
    QCOMPARE(QString::fromStdString(document().graphs().front().series.back()), QStringLiteral("parameter/") + source);
    QCOMPARE(document().undoStack().count(), 1);
    QTRY_VERIFY_WITH_TIMEOUT(graphs()->valuesIn("K")->sampleCount(graphs()->valuesIn("K")->seriesCount() - 1) > 0,
                             kLong);
    undoneAndRedone(before);
    const std::unique_ptr<QMenu> menu(graphs()->makeMenu(first()));
    QVERIFY(!hands::entryOf(*menu, {"Plot", "Parameter", "Water", "Viscosity"}));
  }

  /// Ninety of them are no list: the row has groups, of which none is higher than a low window.
  void quantitiesOfAProbeStandInGroups() {
    m_window->selection().select(OutlineKind::Probe, "ice_mass");
    ParameterRow* row = m_window->inspector().bodyPanel()->row(QStringLiteral("probe/ice_mass/quantity"));
    QVERIFY(row);
    QStringList groups, marked;
    size_t offered = 0;
    qsizetype most = 0;
    QTimer::singleShot(0, row, [&] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      QVERIFY(menu);
      for (const QAction* action : menu->actions()) {
        groups << action->text();
        if (action->isChecked()) marked << action->text();
        if (!action->menu()) continue;
        offered += static_cast<size_t>(action->menu()->actions().size());
        most = std::max(most, action->menu()->actions().size());
      }
      QAction* speed = hands::entryOf(*menu, {"Motion", "Highest speed"});
      QVERIFY(speed);
      menu->close();
    });
    row->setFocus();
    QTest::keyClick(row, Qt::Key_Return);
    QVERIFY2(groups.contains(QStringLiteral("Temperature")) && groups.size() < 12,
             qPrintable(groups.join(QStringLiteral(", "))));
    QCOMPARE(marked, QStringList{QStringLiteral("Mass and particles")});
    QCOMPARE(offered, session().fields().quantities().size());
    QVERIFY2(most < 25, qPrintable(QString::number(most)));
  }

  /// A third of it along each axis, in a box of which it sees the body alone: in one step.
  void aProbeOfABodyBeginsInItsMiddle() {
    const std::string before = json();
    const SnapshotPtr shown = session().snapshot();
    Vector3 low = Vector3::Constant(1e9), high = -low;
    for (size_t i = 0; i < shown->position.size(); ++i) {
      if ((*shown->bodyIds)[shown->body[i]] != "ice" || shown->motion[i] == api::Motion::Gas) continue;
      low = low.cwiseMin(vectorOf(shown->position[i]));
      high = high.cwiseMax(vectorOf(shown->position[i]));
    }
    m_window->selection().select(OutlineKind::Body, "ice");
    m_window->action(QStringLiteral("edit.probe"))->trigger();
    const Probe* probe = document().probe(m_window->selection().id());
    QVERIFY(probe && probe->region);
    QCOMPARE(probe->body, std::string("ice"));
    QCOMPARE(probe->quantity, std::string("temperature"));
    QCOMPARE(probe->name, std::string("Ice block, core"));
    const Vector3 size = probe->region->maximum - probe->region->minimum;
    QVERIFY((0.5 * (probe->region->maximum + probe->region->minimum) - 0.5 * (low + high)).norm() < 1e-6);
    for (int axis = 0; axis < 3; ++axis)
      QVERIFY(size[axis] > 0.32 * (high - low)[axis] && size[axis] < 0.6 * (high - low)[axis]);
    QCOMPARE(document().undoStack().count(), 1);
    undoneAndRedone(before);
  }

  /// Of a ring the middle is empty: its probe sees all of it.
  void aProbeOfARingSeesAllOfIt() {
    m_window->action(QStringLiteral("add.torus"))->trigger();
    const std::string ring = document().project().bodies.back().id;
    const auto isThere = [&] {
      const SnapshotPtr shown = session().snapshot();
      return std::any_of(shown->body.begin(), shown->body.end(),
                         [&](uint32_t body) { return (*shown->bodyIds)[body] == ring; });
    };
    QTRY_VERIFY_WITH_TIMEOUT(isThere(), kLong);
    m_window->selection().select(OutlineKind::Body, ring);
    m_window->action(QStringLiteral("edit.probe"))->trigger();
    const Probe* probe = document().probe(m_window->selection().id());
    QVERIFY(probe && !probe->region);
    QCOMPARE(probe->body, ring);
  }

  /// At the start its box means what stands in it then; later that would be other matter, and what is in it now counts.
  void aProbeOfTheMiddleActsWhereTheBodyIs() {
    toTheStart();
    const auto made = [this] {
      m_window->selection().select(OutlineKind::Body, "ice");
      m_window->action(QStringLiteral("edit.probe"))->trigger();
      return document().probe(m_window->selection().id());
    };
    QCOMPARE(made()->regionWhen, std::string(Probe::kAtStart));
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.time > 0, kLong);
    const Probe* later = made();
    QCOMPARE(later->regionWhen, std::string(Probe::kNow));
    const std::string id = later->id;
    QTRY_VERIFY_WITH_TIMEOUT(
        session().snapshot()->stats.measured && session().snapshot()->stats.measured->back().id == id, kLong);
    QVERIFY(session().snapshot()->stats.probes.back() > 200);  // K, of ice: something is in the box
    toTheStart();
  }

  /// Beside the other temperatures, and once: a wall holds no matter that a probe would see.
  void theTemperatureOfAWallIsPlotted() {
    const std::string before = json();
    const size_t probes = document().project().probes.size(), count = graphs()->plots().size();
    m_window->selection().select(OutlineKind::Wall, "floor");
    m_window->action(QStringLiteral("edit.probe"))->trigger();
    QCOMPARE(document().project().probes.size(), probes);
    QCOMPARE(graphs()->plots().size(), count);
    QCOMPARE(document().graphs().front().series.back(), std::string("parameter/wall/floor/temperature"));
    QCOMPARE(document().undoStack().count(), 1);
    m_window->action(QStringLiteral("edit.probe"))->trigger();
    QCOMPARE(document().undoStack().count(), 1);
    QVERIFY(m_window->notice()->isVisible());
    undoneAndRedone(before);
    // One that lets no heat through has none.
    QCOMPARE(document().setParameter({Owner::Wall, "floor", "heat"}, std::string("adiabatic")), QString());
    m_window->action(QStringLiteral("edit.probe"))->trigger();
    QCOMPARE(document().project().probes.size(), probes + 1);
  }

  void aProbeIsMadeAndEditedInItsRows() {
    const std::string before = json();
    m_window->selection().select(OutlineKind::Body, "ice");
    m_window->action(QStringLiteral("edit.probeAll"))->trigger();
    const std::string id = m_window->selection().id();
    QCOMPARE(m_window->selection().kind(), OutlineKind::Probe);
    QCOMPARE(document().probe(id)->body, std::string("ice"));
    ParameterPanel* panel = m_window->inspector().bodyPanel();
    QVERIFY(panel->isVisible());
    const QString key = QStringLiteral("probe/%1/").arg(QString::fromStdString(id));
    QVERIFY(panel->row(key + QStringLiteral("quantity")) && panel->row(key + QStringLiteral("box_min_y")));
    QVERIFY(!panel->row(key + QStringLiteral("box_min_y"))->model().disabledReason.isEmpty());
    const auto set = [&](const char* what, const Value& value) {
      return document().setParameter({Owner::Probe, id, what}, value);
    };
    QCOMPARE(set("quantity", std::string("speed_max")), QString());
    QCOMPARE(set("in_box", true), QString());
    QVERIFY(panel->row(key + QStringLiteral("box_min_y"))->model().disabledReason.isEmpty());
    // A drag is one step.
    const int steps = document().undoStack().count();
    document().beginGesture();
    for (const double y : {0.01, 0.02, 0.03}) QCOMPARE(set("box_min_y", y), QString());
    document().endGesture();
    QCOMPARE(document().undoStack().count(), steps + 1);
    QVERIFY(set("box_max_y", 0.0).contains(QStringLiteral("must be")));
    QVERIFY(set("wall", std::string("no such")).contains(QStringLiteral("must be")));
    // A wall and the force on it are one choice, and one step.
    QCOMPARE(set("wall", std::string("floor")), QString());
    QCOMPARE(document().undoStack().count(), steps + 2);
    QCOMPARE(document().probe(id)->quantity, std::string("force_y"));
    QVERIFY(document().probe(id)->body.empty() && !document().probe(id)->region);
    QCOMPARE(std::get<std::string>(panel->row(key + QStringLiteral("quantity"))->model().value),
             std::string("force_y"));
    QVERIFY(set("phase", std::string("liquid")).contains(QStringLiteral("as a whole")));
    picture("graphs-probe.png");
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.measured->back().id == id, kLong);
    undoneAndRedone(before);
    document().renameProbe(id, QStringLiteral("Rim"));
    QTRY_VERIFY(hands::outlined(*m_window, OutlineKind::Probe, id).data().toString().startsWith(QStringLiteral("Rim")));
  }

  void aPinnedRowFollowsItsProbe() {
    const std::string address = "probe/ice_mass/quantity";
    ParameterPanel* panel = m_window->inspector().materialPanel();
    const auto row = [&] { return panel->row(QString::fromStdString(address)); };
    document().setPinned(address, true);
    QVERIFY(row());
    QCOMPARE(document().setParameter(*Address::parse(address), std::string("speed_max")), QString());
    QCOMPARE(std::get<std::string>(row()->model().value), std::string("speed_max"));
    document().removeProbe("ice_mass");
    QVERIFY(!row());
    document().undoStack().undo();
    QVERIFY(row());
  }

  /// Before the first frame matter stands where it began: nothing waits.
  void aBoxOfTheStartActsAtOnceAtTheStart() {
    toTheStart();
    QVERIFY(session().snapshot()->stats.time == 0 && !session().snapshot()->knowsStart);
    for (const auto& [key, value] : {std::pair<const char*, Value>("in_box", true),
                                     std::pair<const char*, Value>("box_when", std::string(Probe::kAtStart))})
      QCOMPARE(document().setParameter({Owner::Probe, "ice_mass", key}, value), QString());
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->knowsStart, kLong);
    const auto& probes = document().project().probes;
    const auto place = std::find_if(probes.begin(), probes.end(), [](const Probe& p) { return p.id == "ice_mass"; });
    const auto index = static_cast<size_t>(place - probes.begin());
    QVERIFY(session().snapshot()->stats.probes.at(index) > 0);
    toTheStart();  // noted then, it sees the same
    QVERIFY(session().snapshot()->stats.probes.at(index) > 0);
  }

  /// Later nobody has noted where matter stood at the start, unless a probe asked for it then.
  void aBoxOfTheStartWaitsForTheReset() {
    toTheStart();
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.time > 0, kLong);
    m_window->selection().select(OutlineKind::Probe, "ice_mass");
    const auto set = [&](const char* key, const Value& value) {
      return document().setParameter({Owner::Probe, "ice_mass", key}, value);
    };
    const auto note = [&] {
      const auto* row = m_window->inspector().bodyPanel()->row(QStringLiteral("probe/ice_mass/box_when"));
      const auto* label = row->findChild<QLabel*>(QStringLiteral("psLimit"));
      return label ? label->text() : QString();
    };
    QCOMPARE(set("in_box", true), QString());
    QCOMPARE(note(), QString());
    QCOMPARE(set("box_when", std::string(Probe::kAtStart)), QString());
    QVERIFY2(note().startsWith(QStringLiteral("Acts once back at the start. ")), qPrintable(note()));
    toTheStart();
    QTRY_COMPARE_WITH_TIMEOUT(note(), QString(), kLong);
  }

  void aGraphIsRenamedInItsPlace() {
    const std::string before = json(), id = first();
    const auto edit = [&](const QString& text, Qt::Key last) {
      choose(id, {"Rename"});
      auto* line = graphs()->plot(id)->findChild<QLineEdit*>();
      QVERIFY(line && line->hasFocus());
      line->setText(text);
      QTest::keyClick(line, last);
      QTRY_VERIFY(!graphs()->plot(id)->findChild<QLineEdit*>());
    };
    edit(QStringLiteral("Ice & water"), Qt::Key_Escape);
    QCOMPARE(json(), before);
    edit(QStringLiteral("Ice & water"), Qt::Key_Return);
    QCOMPARE(graphs()->plot(id)->title(), QStringLiteral("Ice & water"));
    QCOMPARE(document().undoStack().count(), 1);
    undoneAndRedone(before);
  }

  void aProbeIsCopied() {
    const size_t probes = document().project().probes.size();
    m_window->selection().select(OutlineKind::Probe, "ice_mass");
    m_window->action(QStringLiteral("edit.duplicate"))->trigger();
    QCOMPARE(document().project().probes.size(), probes + 1);
    QCOMPARE(m_window->selection().id(), std::string("ice_mass-2"));
    QCOMPARE(document().project().probes.back().quantity, std::string("solid_mass"));
    document().undoStack().undo();
    QVERIFY(m_window->selection().empty());
  }

  void cursorsMeasureWhatLiesBetween() {
    run(40);
    GraphView* view = graphs()->valuesIn("K");
    view->setRange(0, session().now());
    view->setFocus();
    QTRY_VERIFY(view->hasFocus());
    const QRectF plot = view->plotRect();
    QTest::mouseMove(view, (plot.topLeft() + QPointF(0.2 * plot.width(), 30)).toPoint());
    QTest::keyClick(view, Qt::Key_1);
    QVERIFY(view->measured().empty());
    QTest::mouseMove(view, (plot.topLeft() + QPointF(0.8 * plot.width(), 30)).toPoint());
    QTest::keyClick(view, Qt::Key_2);
    QVERIFY(std::abs(*view->reading(1) - *view->reading(0) - 0.6 * session().now()) < 0.02 * session().now());
    QVERIFY(!view->measured().empty());
    QVERIFY2(view->measured()[1].value.contains(QStringLiteral("°C/s")) &&
                 view->measured()[1].value.contains(QStringLiteral("°C·s")),
             qPrintable(view->measured()[1].value));
    const QRegularExpression change(QStringLiteral("^−?[0-9.]+ °C · "));
    QVERIFY2(view->measured()[1].value.contains(change), qPrintable(view->measured()[1].value));
    // Held at its line, B is dragged; an arrow moves it by a pixel.
    const QPointF at(plot.left() + 0.8 * plot.width(), plot.center().y());
    QTest::mousePress(view, Qt::LeftButton, {}, at.toPoint());
    hands::move(*view, at - QPointF(50, 0));
    QTest::mouseRelease(view, Qt::LeftButton, {}, (at - QPointF(50, 0)).toPoint());
    const double perPixel = session().now() / plot.width(), dragged = *view->reading(1);
    QVERIFY(std::abs(dragged - (0.8 * session().now() - 50 * perPixel)) < 2 * perPixel);
    QTest::keyClick(view, Qt::Key_Left);
    QVERIFY(std::abs(dragged - perPixel - *view->reading(1)) < 0.01 * perPixel);
    picture("graphs-cursors.png");
    QTest::keyClick(view, Qt::Key_Escape);
    QVERIFY(!view->reading(0) && view->measured().empty());
    // The stack of heat knows what is expected: what came in.
    choose(first(), {"Split: beside it", "Heat and its balance"});
    Plot* energy = graphs()->plots()[1];
    energy->setReading(0, 0.0);
    energy->setReading(1, session().now());
    QTRY_VERIFY(energy->measured().size() > 3);
    QCOMPARE(energy->measured().back().name, QStringLiteral("balance open by"));
    picture("graphs-energy.png");
  }

  void valuesAndTimesAreZoomed() {
    run(10);
    GraphView* view = graphs()->valuesIn("K");
    view->grab();
    const double low = view->axes()[0].low(), high = view->axes()[0].high();
    wheel(*view, Qt::ControlModifier);
    view->grab();
    QVERIFY(std::abs((view->axes()[0].high() - view->axes()[0].low()) / (high - low) - 0.8) < 1e-6);
    QVERIFY(view->isFitted());
    const double before = view->axes()[0].low();
    const QPointF middle = view->plotRect().center();
    QTest::mousePress(view, Qt::LeftButton, {}, middle.toPoint());
    hands::move(*view, middle + QPointF(0, 20));
    QTest::mouseRelease(view, Qt::LeftButton, {}, (middle + QPointF(0, 20)).toPoint());
    view->grab();
    QVERIFY(view->axes()[0].low() > before);  // values go along with the hand
    wheel(*view, Qt::NoModifier);
    QVERIFY(!view->isFitted() && !graphs()->phases()->isFitted());  // all go by one time axis
    QTest::mouseDClick(view, Qt::LeftButton, {}, middle.toPoint());
    QVERIFY(view->isFitted() && graphs()->phases()->isFitted() && !view->axes()[0].zoom);
    choose(first(), {"Logarithmic"});
    QVERIFY(view->axes()[0].logarithmic && document().graphs().front().logarithmic);
  }

  void graphsAreExported_data() {
    QTest::addColumn<QString>("ending");
    QTest::addColumn<QByteArray>("begins");
    QTest::newRow("png") << "png" << QByteArray("\x89PNG");
    QTest::newRow("svg") << "svg" << QByteArray("<?xml");
    QTest::newRow("csv") << "csv" << QByteArray("time_s,Mean temperature [K],Ice core [K]\n0,");
  }

  void graphsAreExported() {
    QFETCH(QString, ending);
    QFETCH(QByteArray, begins);
    run(2);
    const QString path = m_folder.filePath(QStringLiteral("graph.") + ending);
    hands::answerDialog(path);
    choose(first(), {QStringLiteral("Export as %1…").arg(ending.toUpper())});
    QFile file(path);
    QTRY_VERIFY_WITH_TIMEOUT(file.exists() && file.size() > 0, kLong);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray bytes = file.readAll();
    QVERIFY2(bytes.startsWith(begins), bytes.left(80).constData());
    if (ending == QStringLiteral("svg")) QVERIFY(bytes.contains("<polyline") || bytes.contains("<path"));
  }

  void aPathThatCannotBeWrittenIsTold() {
    hands::answerDialog(m_folder.filePath(QStringLiteral("no/such/folder/graph.csv")));
    choose(first(), {"Export as CSV…"});
    QTRY_VERIFY2_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("no/such/folder")),
                              qPrintable(m_window->notice()->text()), kLong);
    QVERIFY(m_window->notice()->isVisible());
  }

  /// Ctrl+K has what a button in a header does for a page that is not shown, and what an action does once.
  void buttonsOfHeadersAreFound() {
    m_window->openPage(QStringLiteral("Messages"));
    const auto entries = m_window->paletteEntries();
    const auto called = [&](const char* title) {
      std::vector<PaletteEntry> found;
      std::copy_if(entries.begin(), entries.end(), std::back_inserter(found),
                   [&](const PaletteEntry& entry) { return entry.title == QString::fromUtf8(title); });
      return found;
    };
    QCOMPARE(called("Export all frames as CSV…").size(), size_t{1});
    QCOMPARE(called("Back to the start").size(), size_t{1});
    QVERIFY(called("Back to the start (Home)").empty());
    QVERIFY(std::any_of(entries.begin(), entries.end(), [](const PaletteEntry& entry) {
      return entry.title == QStringLiteral("Where") && entry.where == QStringLiteral("Film");
    }));
    QVERIFY(std::none_of(entries.begin(), entries.end(),
                         [](const PaletteEntry& entry) { return entry.title.startsWith(QStringLiteral("Changed")); }));
    const auto add = called("Add a graph");
    QCOMPARE(add.size(), size_t{1});
    QCOMPARE(add[0].whyNot, QString());
    add[0].run();
    QCOMPARE(m_window->layoutOfDocks().dock(QStringLiteral("dock.graphs"))->currentPage(), QStringLiteral("Graphs"));
    QTRY_VERIFY(QApplication::activePopupWidget());
    QApplication::activePopupWidget()->close();
  }

 private:
  GraphsPanel* graphs() { return m_window->graphs(); }
  std::string first() { return document().graphs().front().id; }
  std::string json() { return writeProject(document().project()); }
  void run(int frames) {
    const uint64_t wanted = session().snapshot()->stats.frame + static_cast<uint64_t>(frames);
    for (int k = 0; k < frames; ++k) session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame >= wanted, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(graphs()->valuesIn("K")->sampleCount(0) > wanted, kLong);
  }
  /// Back to the project as it was, and forward again to the one that it is.
  void undoneAndRedone(const std::string& before) {
    const std::string now = json();
    QVERIFY(now != before);
    const int steps = document().undoStack().index();
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(json(), before);
    while (document().undoStack().index() < steps) document().undoStack().redo();
    QCOMPARE(json(), now);
  }
  /// The entry of a graph's menu at the end of a path of titles.
  void choose(const std::string& id, const QStringList& path) {
    const std::unique_ptr<QMenu> menu(graphs()->makeMenu(id));
    QAction* entry = hands::entryOf(*menu, path);
    QVERIFY2(entry, qPrintable(path.join(QStringLiteral(" > "))));
    entry->trigger();
  }
  static void wheel(Plot& on, Qt::KeyboardModifiers modifiers) {
    const QPointF at = on.plotRect().center();
    QWheelEvent event(at, on.mapToGlobal(at), {}, {0, 120}, Qt::NoButton, modifiers, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&on, &event);
  }
  QTemporaryDir m_folder;
};

int main(int argc, char** argv) {
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  requestViewFormat();
  QApplication application(argc, argv);
  TestGraphsWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_graphswindow.moc"
