// SPDX-License-Identifier: Apache-2.0
// The record of a run under a hand, in the real window: dragged over, stepped through, gone on from.
#include "core/io/projectio.h"
#include "core/simulation/engine.h"
#include "core/simulation/runrecord.h"
#include "tests/ui/hands.h"
#include "tests/ui/recordhands.h"
#include "tests/ui/samplewindow.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/messagelog.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/plaintext.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/runlines.h"
#include "ui/timeline/transport.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"

#include <QtCore/QElapsedTimer>
#include <QtGui/QImage>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

#include <cmath>
#include <map>

using namespace ps;

namespace {

constexpr uint64_t kFrames = 12;
const Address kFloor{Owner::Wall, "floor", "temperature"};

}  // namespace

class TestRecordedView : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    QVERIFY(m_window);
    session().pause();
  }
  /// A dozen frames, and what each was to the bit.
  void init() {
    backToTheStart();
    setSpeed("1×");
    m_hashes.clear();
    m_hashes[0] = hash();
    for (uint64_t frame = 1; frame <= kFrames; ++frame) {
      m_hashes[frame] = step();
    }
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames, kLong);
    QVERIFY(!session().recorded().isActive());
    transport().setDuration(0.4);  // a frame is then some thirty pixels wide
  }

  void aDragShowsWhatWasRecorded() {
    session().play();
    drag(4);
    QVERIFY(!session().playing());
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{4}, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    QVERIFY(session().recorded().isActive());
    QTRY_COMPARE_WITH_TIMEOUT(transport().timeText(), clockText(4.0 / 60), kLong);
    const SnapshotPtr newest = session().newest();
    QCOMPARE(transport().durationText(), QStringLiteral("Recorded, up to %1").arg(clockText(newest->stats.time)));
    QVERIFY(transport().continueButton()->isVisible());
    QCOMPARE(session().snapshot()->id.size(), newest->id.size());
    QCOMPARE(session().snapshot()->revision, newest->revision);
    picture("tst_recordedview_frame.png");
    // Past the recorded part is the newest state.
    QTest::mouseClick(&transport(), Qt::LeftButton, {}, {transport().width() - 2, transport().height() - 2});
    QTRY_VERIFY(!session().recorded().isActive());
    QCOMPARE(session().snapshot(), session().newest());
    QVERIFY(!transport().continueButton()->isVisible());
    QVERIFY(transport().durationText().startsWith(QStringLiteral("/ 00:00")));
  }

  void whatIsRecordedPlaysAndThenTheRunGoesOn() {
    setSpeed("0.1×");
    drag(3);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{3}, kLong);
    QElapsedTimer since;
    since.start();
    trigger("simulation.play");
    QVERIFY(session().playing());
    QTRY_VERIFY_WITH_TIMEOUT(shownFrame() > 4, kLong);
    QVERIFY(static_cast<double>(shownFrame() - 3) <= static_cast<double>(since.elapsed()) / 1000 * 0.1 * 60 + 1);
    QVERIFY(session().recorded().isActive());
    trigger("simulation.play");
    QVERIFY(!session().playing() && session().recorded().isActive());
    QCOMPARE(session().newest()->stats.frame, kFrames);  // nothing was simulated
    setSpeed("4×");
    trigger("simulation.play");
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > kFrames, kLong);
    QVERIFY(session().playing() && !session().recorded().isActive());
    session().pause();
  }

  void aLoopBeginsAgain() {
    transport().loopButton()->click();
    setSpeed("4×");
    trigger("simulation.play");
    int begun = 0;
    uint64_t last = kFrames;
    const QObject here;  // the transport goes on listening
    connect(&session().recorded(), &RecordedView::changed, &here, [&] {
      if (shownFrame() < last) ++begun;
      last = shownFrame();
    });
    QTRY_VERIFY_WITH_TIMEOUT(begun > 2, kLong);
    QVERIFY(disconnect(&session().recorded(), &RecordedView::changed, &here, nullptr));
    QVERIFY(session().playing());
    QCOMPARE(session().newest()->stats.frame, kFrames);
    transport().loopButton()->click();  // the run then goes on
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > kFrames, kLong);
    session().pause();
  }

  void theRunKeepsToItsSpeed() {
    setSpeed("0.1×");
    QElapsedTimer since;
    since.start();
    trigger("simulation.play");
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > kFrames + 2, kLong);
    QVERIFY(static_cast<double>(session().newest()->stats.frame - kFrames) <=
            static_cast<double>(since.elapsed()) / 1000 * 0.1 * 60 + 1);
    session().pause();
  }

  void keysStepThroughIt() {
    trigger("simulation.back");
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames - 1, kLong);
    trigger("simulation.back");
    trigger("simulation.back");
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames - 3, kLong);
    trigger("simulation.step");  // of the record: the engine stands
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames - 2, kLong);
    QCOMPARE(session().newest()->stats.frame, kFrames);
    trigger("simulation.previousMark");
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{0}, kLong);
    trigger("simulation.back");  // there is none
    QCOMPARE(shownFrame(), uint64_t{0});
    QCOMPARE(document().putKey(kFloor, 5.0 / 60, 400), QString());
    trigger("simulation.nextMark");
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{5}, kLong);
    trigger("simulation.now");
    QVERIFY(!session().recorded().isActive());
    trigger("simulation.back");
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames - 1, kLong);
    trigger("simulation.step");
    QTRY_VERIFY_WITH_TIMEOUT(!session().recorded().isActive(), kLong);
    trigger("simulation.step");
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, kFrames + 1, kLong);
  }

  /// What tracks say, what graphs mark, and the ruler of the keys.
  void valuesAndGraphsFollow() {
    QCOMPARE(document().putKey(kFloor, 0, 400), QString());
    QCOMPARE(document().putKey(kFloor, 0.2, 500), QString());
    auto* rows = m_window->findChild<KeyRows*>();
    QTRY_VERIFY_WITH_TIMEOUT(rows->isVisible(), kLong);
    // A pixel of the ruler is some frames here.
    const QPoint at(static_cast<int>(std::lround(rows->xOf(6.0 / 60))), KeyRows::kRuler / 2);
    const uint64_t frame = session().engine()->recording().frameAt(rows->secondsAt(at.x())).value();
    QVERIFY(frame > 0 && frame < kFrames);
    QTest::mouseClick(rows, Qt::LeftButton, {}, at);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), frame, kLong);
    const double floor = 400 + 100 * session().snapshot()->stats.time / 0.2;
    QVERIFY(std::abs(std::get<double>(session().valueNow(kFloor)) - floor) < 1e-9);
    QTRY_COMPARE_WITH_TIMEOUT(m_window->graphs()->valuesIn("K")->presentTime(), session().snapshot()->stats.time,
                              kLong);
    picture("tst_recordedview_keys.png");
    auto* plot = m_window->graphs()->valuesIn("K");
    plot->setRange(0, 0.2);
    plot->grab();  // its axes find their room
    // A click in a graph shows the frame of that time, and graph, clock, bar and ruler all stand there.
    const QRectF area = plot->plotRect();
    const QPoint there = (area.topLeft() + QPointF(0.75 * area.width(), area.height() / 2)).toPoint();
    const double clicked = 0.2 * (there.x() - area.left()) / area.width();
    const uint64_t sought = session().engine()->recording().frameAt(clicked).value();
    QVERIFY(sought != frame);
    QTest::mouseClick(plot, Qt::LeftButton, {}, there);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), sought, kLong);
    QVERIFY(session().recorded().isActive());
    const double shown = session().snapshot()->stats.time;
    QTRY_COMPARE_WITH_TIMEOUT(plot->presentTime(), shown, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(transport().timeText(), clockText(shown), kLong);
    const QPoint onBar = transport().placeOf(shown);
    QVERIFY(std::abs(columnOf(transport(), onBar.y(), Token::Accent) - onBar.x()) < 1.5);
    QVERIFY(std::abs(columnOf(*rows, KeyRows::kRuler - 3, Token::SliderFill) - rows->xOf(shown)) < 1.5);
    session().recorded().showNewest();
    QTRY_COMPARE_WITH_TIMEOUT(m_window->graphs()->valuesIn("K")->presentTime(), session().newest()->stats.time, kLong);
  }

  void theRunGoesOnFromAFrame() {
    drag(5);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{5}, kLong);
    const uint64_t revision = session().newest()->revision;
    QTest::mouseClick(transport().continueButton(), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->revision != revision, kLong);
    session().pause();
    const uint64_t now = hash();
    const uint64_t frame = session().newest()->stats.frame;
    QVERIFY(frame >= 5);
    while (session().newest()->stats.frame < kFrames) {
      step();
    }
    if (frame <= kFrames) QCOMPARE(now, m_hashes[frame]);
    if (session().newest()->stats.frame == kFrames) QCOMPARE(hash(), m_hashes[kFrames]);
    QTRY_VERIFY_WITH_TIMEOUT(!session().recorded().isActive(), kLong);
    QTRY_COMPARE_WITH_TIMEOUT(session().log().messages().back().text,
                              QStringLiteral("The run goes on from %1. As it was, up to %2, it is kept as run 1.")
                                  .arg(clockText(5.0 / 60), clockText(kFrames / 60.0)),
                              kLong);
  }

  /// Gone back, another floor, and the first run again; then the second is deleted.
  void anEarlierRunIsTakenUpAndDeleted() {
    const int height = transport().height();
    const int steps = document().undoStack().count();
    drag(5);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{5}, kLong);
    QTest::mouseClick(transport().continueButton(), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(session().recorded().earlier().size(), size_t{1}, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(!session().recorded().isActive(), kLong);  // the window has heard of it
    session().pause();
    const RunRecord::EarlierRun first = session().recorded().earlier().front();
    QCOMPARE(first.number, uint64_t{1});
    QCOMPARE(first.apart, 5.0 / 60);
    QCOMPARE(first.to, static_cast<double>(kFrames) / 60);
    QTRY_VERIFY_WITH_TIMEOUT(transport().height() > height, kLong);
    // Its curves stand beside those of the run that goes on, until they are not wanted.
    const auto compared = [this] {
      size_t samples = 0;
      for (const GraphView* view : m_window->findChildren<GraphView*>()) {
        if (view->seriesCount() > 0) samples = std::max(samples, view->otherCount(0));
      }
      return samples;
    };
    QTRY_COMPARE_WITH_TIMEOUT(compared(), static_cast<size_t>(kFrames + 1), kLong);
    picture("tst_recordedview_runs.png");
    choose(1, "Compare in graphs");
    QCOMPARE(compared(), size_t{0});
    choose(1, "Compare in graphs");
    QTRY_COMPARE_WITH_TIMEOUT(compared(), static_cast<size_t>(kFrames + 1), kLong);
    choose(1, "Go on with it");
    QTRY_COMPARE_WITH_TIMEOUT(session().log().messages().back().text,
                              QStringLiteral("Run 1 goes on from its end; the one before is kept as run 2."), kLong);
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, kFrames, kLong);
    session().engine()->recording().settle();
    QCOMPARE(session().recorded().extent().last, kFrames);
    QCOMPARE(session().engine()->history(0).size(), static_cast<size_t>(kFrames + 1));
    drag(8);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{8}, kLong);
    QCOMPARE(onEngine<uint64_t>(session(),
                                [this](Engine&) {
                                  const auto point = session().engine()->recording().restorePoint(8);
                                  return point ? replayed(*point, *session().plugins())->stateHash() : 0;
                                }),
             m_hashes[8]);
    QCOMPARE(session().recorded().earlier().front().number, uint64_t{2});
    choose(2, "Delete");
    QVERIFY(session().recorded().earlier().empty());
    QCOMPARE(compared(), size_t{0});
    QTRY_COMPARE_WITH_TIMEOUT(transport().height(), height, kLong);
    QCOMPARE(document().undoStack().count(), steps);  // time is no edit
  }

  /// Gone back under another floor: what was stands in the scene as a ghost, at each time that is shown.
  void anEarlierRunIsAGhost() {
    trigger("simulation.ghost");  // there is none
    QVERIFY(!session().recorded().hasGhost());
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("There is no earlier run")));
    branchAt(5);
    const auto shows = [this](uint64_t frame) {
      const SnapshotPtr ghost = session().recorded().ghost();
      return frame == 0 ? !ghost : ghost && ghost->stats.frame == frame;
    };
    trigger("simulation.ghost");
    QVERIFY(session().recorded().hasGhost());
    while (session().newest()->stats.frame < kFrames) {
      step();
    }
    session().engine()->recording().settle();
    QTRY_VERIFY_WITH_TIMEOUT(shows(kFrames), kLong);
    QCOMPARE(session().recorded().ghost()->id.size(), session().newest()->id.size());
    picture("tst_recordedview_ghost.png");
    drag(8);
    QTRY_VERIFY_WITH_TIMEOUT(shows(8), kLong);
    drag(3);  // where both were one
    QTRY_VERIFY_WITH_TIMEOUT(shows(0), kLong);
    drag(8);
    QTRY_VERIFY_WITH_TIMEOUT(shows(8), kLong);
    session().recorded().showNewest();
    step();  // beyond its end
    QTRY_VERIFY_WITH_TIMEOUT(shows(0), kLong);
    drag(8);
    QTRY_VERIFY_WITH_TIMEOUT(shows(8), kLong);
    choose(1, "Show as a ghost");
    QVERIFY(shows(0) && !session().recorded().hasGhost());
    choose(1, "Show as a ghost");
    QTRY_VERIFY_WITH_TIMEOUT(shows(8), kLong);
    choose(1, "Delete");
    QVERIFY(shows(0));
    QVERIFY(!session().recorded().compared());
  }

  /// Under a hotter floor: what that makes of each curve is a curve too, saved with its graph and exported.
  void whatARunDiffersInIsACurve() {
    QCOMPARE(document().setParameter(kFloor, 900.0), QString());
    branchAt(5);
    while (session().newest()->stats.frame < kFrames) {
      step();
    }
    GraphView* view = m_window->graphs()->valuesIn("K");
    QTRY_VERIFY_WITH_TIMEOUT(!session().recorded().comparedStats().empty() && view->sampleCount(0) > kFrames, kLong);
    const std::string id = document().graphs().front().id, before = writeProject(document().project());
    const auto toggle = [&] {
      const std::unique_ptr<QMenu> menu(m_window->graphs()->makeMenu(id));
      for (QAction* action : menu->actions()) {
        if (action->text() == QStringLiteral("Difference from the compared run")) action->trigger();
      }
    };
    const auto timeOf = [this](uint64_t frame) { return session().engine()->history(frame).front().time; };
    const double end = timeOf(kFrames);
    QVERIFY(std::isnan(view->differenceAt(0, end)));
    const size_t axes = view->axes().size();
    toggle();
    QVERIFY(document().graphs().front().difference);
    QVERIFY(writeProject(document().project()).find("\"difference\": true") != std::string::npos);
    const FrameStats own = session().engine()->history(kFrames).front(),
                     other = session().recorded().comparedStats().back();
    QCOMPARE(own.frame, other.frame);
    const double difference = own.temperatureMean - other.temperatureMean;
    QVERIFY2(difference > 1e-3, qPrintable(QString::number(difference)));
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(view->differenceAt(0, end) - difference) < 1e-6, kLong);
    QCOMPARE(view->differenceAt(0, timeOf(3)), 0.0);  // both were one
    QCOMPARE(view->axes().size(), 2 * axes);
    step();  // beyond the end of the other
    QTRY_VERIFY_WITH_TIMEOUT(view->sampleCount(0) > kFrames + 1, kLong);
    QVERIFY(std::isnan(view->differenceAt(0, timeOf(kFrames + 1))));
    picture("tst_recordedview_difference.png");
    const QList<QByteArray> rows = m_window->graphs()->exported(id, QStringLiteral("csv")).trimmed().split('\n');
    QVERIFY(rows.front().startsWith(
        "time_s,Mean temperature [K],Mean temperature [K] in Run 1,Mean temperature [K] less Run 1"));
    QCOMPARE(rows.size(), qsizetype{kFrames + 3});
    QVERIFY(std::abs(rows[kFrames + 1].split(',')[3].toDouble() - difference) < 1e-9);
    QVERIFY(rows.back().split(',')[2].isEmpty() && rows.back().split(',')[3].isEmpty());
    const std::string with = writeProject(document().project());
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    QCOMPARE(view->axes().size(), axes);
    document().undoStack().redo();
    QCOMPARE(writeProject(document().project()), with);
  }

  /// By its row's menu: what it was, whenever it was changed, also in the run before a branch and after scrubbing.
  void aPlottedParameterIsWhatActed() {
    const std::string before = writeProject(document().project());
    const double own = std::get<double>(document().value(kFloor)), hot = 600;
    QCOMPARE(document().setParameter(kFloor, hot), QString());
    for (uint64_t frame = kFrames; frame < kFrames + 3; ++frame) step();
    ParameterRow* row = nullptr;
    for (ParameterRow* one : m_window->findChildren<ParameterRow*>()) {
      if (one->key().toStdString() == kFloor.text()) row = one;
    }
    QVERIFY(row);
    Q_EMIT row->plotRequested(row->key());
    QCOMPARE(document().graphs().back().series, (std::vector<std::string>{"parameter/" + kFloor.text()}));
    auto* view = qobject_cast<GraphView*>(m_window->graphs()->plot(document().graphs().back().id));
    QVERIFY(view);
    const auto shows = [&](uint64_t frame, double kelvin) {
      const double time = session().engine()->history(frame).front().time;
      return std::abs(view->extent(0, time - 1e-4, time + 1e-4).first - (kelvin - 273.15)) < 1e-9;
    };
    QTRY_VERIFY_WITH_TIMEOUT(view->sampleCount(0) == kFrames + 4, kLong);
    QVERIFY(shows(0, own) && shows(kFrames - 1, own) && shows(kFrames, hot) && shows(kFrames + 3, hot));
    QCOMPARE(document().setParameter(kFloor, 500.0), QString());
    step();
    QTRY_VERIFY_WITH_TIMEOUT(view->sampleCount(0) == kFrames + 5, kLong);
    QVERIFY(shows(kFrames + 4, 500) && shows(kFrames + 2, hot));
    picture("tst_recordedview_parameter.png");
    branchAt(5);  // edits stay: what is set holds from there on
    QTRY_VERIFY_WITH_TIMEOUT(view->otherCount(0) > kFrames && shows(4, own) && shows(6, 500), kLong);
    const QList<QByteArray> rows =
        m_window->graphs()->exported(document().graphs().back().id, QStringLiteral("csv")).split('\n');
    QCOMPARE(rows[7].split(',')[1].toDouble(), 500.0);
    QCOMPARE(rows[7].split(',')[2].toDouble(), own);
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  /// Two runs side by side, each called what a hand calls it.
  void earlierRunsHaveNames() {
    branchAt(5);
    branchAt(3);
    RunLines* lines = transport().runs();
    QTRY_COMPARE_WITH_TIMEOUT(lines->height(), 2 * RunLines::kPitch, kLong);
    QVERIFY(!lines->rowOf(1).intersects(lines->rowOf(2)));
    m_window->activateWindow();
    const auto name = [&](uint64_t run, const QString& text, Qt::Key end) {
      auto* line = lines->findChild<QLineEdit*>();
      QVERIFY(line);
      QVERIFY(lines->rowOf(run).intersects(line->geometry()));
      QTest::keyClicks(line, text);
      QTest::keyClick(line, end);
      QTRY_VERIFY_WITH_TIMEOUT(!lines->findChild<QLineEdit*>(), kLong);
    };
    QTest::mouseClick(lines, Qt::LeftButton, {}, lines->rowOf(1).center());
    QCOMPARE(lines->chosen(), std::optional<uint64_t>(1));
    QTest::keyClick(lines, Qt::Key_F2);
    name(1, QStringLiteral("as it was"), Qt::Key_Return);
    QTest::mouseDClick(lines, Qt::LeftButton, {}, lines->rowOf(2).center());
    name(2, QStringLiteral("other"), Qt::Key_Escape);
    QCOMPARE(session().recorded().runName(1), QStringLiteral("as it was"));
    QCOMPARE(session().recorded().runName(2), QStringLiteral("Run 2"));
    choose(2, "Rename");
    name(2, QStringLiteral("R&D, <b>hot</b>"), Qt::Key_Return);
    QCOMPARE(session().recorded().runName(2), QStringLiteral("R&D, <b>hot</b>"));
    QMenu menu;
    transport().fillMenu(menu);
    QVERIFY(fromButtonText(menu.actions().front()->text()).startsWith(QStringLiteral("as it was, 00:00")));
    // What is compared is called so too, and a name goes with its run.
    session().recorded().compare(2);
    QTRY_VERIFY_WITH_TIMEOUT(!session().recorded().comparedStats().empty(), kLong);
    QCOMPARE(m_window->graphs()->valuesIn("K")->otherRun(), QStringLiteral("R&D, <b>hot</b>"));
    picture("tst_recordedview_names.png");
    session().recorded().goOnWith(1);
    QTRY_COMPARE_WITH_TIMEOUT(session().recorded().earlier().front().number, uint64_t{3}, kLong);
    // The one that was left is compared, wherever it stands among the others.
    QTRY_COMPARE_WITH_TIMEOUT(session().recorded().compared(), std::optional<uint64_t>(3), kLong);
    QTRY_VERIFY_WITH_TIMEOUT(!session().engine()->making(), kLong);
    session().recorded().goOnWith(3);
    QTRY_COMPARE_WITH_TIMEOUT(session().recorded().runName(1), QStringLiteral("as it was"), kLong);
    QTRY_VERIFY_WITH_TIMEOUT(!session().engine()->making(), kLong);
  }

  /// A run that was clicked or named has the focus, and the transport its keys.
  void keysGoToTheTransportFromARun() {
    branchAt(5);
    RunLines* lines = transport().runs();
    QTRY_VERIFY_WITH_TIMEOUT(lines->isVisible(), kLong);
    m_window->activateWindow();
    const uint64_t run = session().recorded().earlier().front().number;
    const auto keysAct = [this] {
      QWidget* focus = QApplication::focusWidget();
      QVERIFY(focus);
      session().pause();
      QTest::keyClick(focus, Qt::Key_Space);
      QVERIFY(session().playing());
      QTest::keyClick(focus, Qt::Key_Space);
      QVERIFY(!session().playing());
    };
    QTest::mouseClick(lines, Qt::LeftButton, {}, lines->rowOf(run).center());
    keysAct();
    QTest::keyClick(lines, Qt::Key_F2);
    auto* line = lines->findChild<QLineEdit*>();
    QVERIFY(line && QApplication::focusWidget() == line);
    QTest::keyClick(line, Qt::Key_Return);
    QTRY_VERIFY_WITH_TIMEOUT(!lines->findChild<QLineEdit*>(), kLong);
    QCOMPARE(QApplication::focusWidget(), lines);
    keysAct();
    const uint64_t revision = session().snapshot()->revision;
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Home);
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision || session().snapshot()->stats.frame == 0,
                             kLong);
  }

  /// Four have lines; the older ones are reached from those, and from the transport, and are called and deleted there.
  void runsWithoutALineAreNamedAndDeleted() {
    for (const uint64_t frame : {5, 5, 4, 4, 3}) {
      branchAt(frame);
      QVERIFY(!transport().continueButton()->isVisible());
    }
    RunLines* lines = transport().runs();
    QTRY_COMPARE_WITH_TIMEOUT(lines->height(), RunLines::kMost * RunLines::kPitch, kLong);
    QVERIFY(lines->rowOf(1).isEmpty() && !lines->rowOf(2).isEmpty());
    const QString title = QStringLiteral("Run 1, %1 to %2").arg(clockText(3.0 / 60), clockText(kFrames / 60.0));
    m_window->activateWindow();
    hands::chooseAt(*lines, lines->rowOf(3).center(), {QStringLiteral("Older runs"), title, QStringLiteral("Rename")});
    auto* line = lines->findChild<QLineEdit*>();
    QVERIFY(line && line->text() == QStringLiteral("Run 1"));
    QTest::keyClicks(line, QStringLiteral("the first"));
    picture("tst_recordedview_older.png");
    QTest::keyClick(line, Qt::Key_Return);
    QCOMPARE(session().recorded().runName(1), QStringLiteral("the first"));
    session().recorded().renameRun(1, {});
    choose(1, "Delete");
    QCOMPARE(session().recorded().earlier().size(), size_t{4});
    QCOMPARE(session().recorded().earlier().front().number, uint64_t{2});
  }

  /// A value acts where the run stands, not at the moment that is shown: that is said once for each change.
  void aChangeBesideARecordedMomentSaysWhereItActs() {
    StatusLine* line = m_window->statusLine();
    const double before = std::get<double>(document().value(kFloor));
    QCOMPARE(document().setParameter(kFloor, before + 1), QString());
    QVERIFY2(!line->state().note.contains(QStringLiteral("where the run stands")), qPrintable(line->state().note));
    drag(4);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{4}, kLong);
    const QString told = QStringLiteral(
                             "It acts where the run stands, at %1; what is recorded stays as it was. "
                             "Continue from here runs on from %2 with it.")
                             .arg(clockText(kFrames / 60.0), clockText(4.0 / 60));
    document().beginGesture();
    QCOMPARE(document().setParameter(kFloor, before + 2), QString());
    QCOMPARE(line->state().note, told);
    line->say(QStringLiteral("Something else."));
    QCOMPARE(document().setParameter(kFloor, before + 3), QString());  // of the same drag
    QCOMPARE(line->state().note, QStringLiteral("Something else."));
    document().endGesture();
    QCOMPARE(document().setParameter(kFloor, before + 4), QString());
    QCOMPARE(line->state().note, told);
    session().recorded().showNewest();
    QVERIFY(line->state().note != told);
    drag(4);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{4}, kLong);
    QCOMPARE(document().putKey(kFloor, 4.0 / 60, 400), QString());
    QCOMPARE(line->state().note, told);
    session().recorded().showNewest();
  }

  /// Who works on matter sees it as it stands.
  void aStrokeShowsTheNewestState() {
    drag(2);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{2}, kLong);
    document().undoStack().beginMacro(QStringLiteral("nothing"));
    document().undoStack().endMacro();
    QVERIFY(session().recorded().isActive());
    document().removeBody(document().project().bodies.front().id);
    QVERIFY(!session().recorded().isActive());
    document().undoStack().undo();
  }

  void aResetBeginsAnew() {
    drag(2);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{2}, kLong);
    toTheStart();
    QVERIFY(!session().recorded().isActive());
    session().engine()->recording().settle();
    QCOMPARE(session().recorded().extent().frames, size_t{1});
  }

 private:
  uint64_t hash() { return hands::hashNow(session()); }
  uint64_t step() { return hands::stepKept(session()); }
  uint64_t shownFrame() { return session().snapshot()->stats.frame; }
  Transport& transport() { return *m_window->transport(); }
  /// Middle of what has a colour in a row of pixels, logical pixels; NaN: nothing has.
  static double columnOf(QWidget& widget, int row, Token token) {
    const double ratio = widget.devicePixelRatioF();
    const QImage image = widget.grab().toImage().convertToFormat(QImage::Format_RGB32);
    double sum = 0, count = 0;
    for (int x = 0; x < image.width(); ++x) {
      if (image.pixelColor(x, static_cast<int>(row * ratio)) == Theme::current()[token]) sum += x + 0.5, ++count;
    }
    return sum / count / ratio;
  }
  void branchAt(uint64_t frame) { hands::branchAt(*m_window, frame, 6); }
  void trigger(const char* id) { m_window->action(QLatin1String(id))->trigger(); }
  void choose(int run, const char* what) {
    QMenu menu;
    transport().fillMenu(menu);
    for (QAction* entry : menu.actions()) {
      if (!entry->menu() || !entry->text().startsWith(QStringLiteral("Run %1,").arg(run))) continue;
      for (QAction* action : entry->menu()->actions()) {
        if (action->text() == QLatin1String(what)) action->trigger();
      }
    }
  }
  void setSpeed(const char* text) {
    for (QAction* action : transport().speedButton()->menu()->actions()) {
      if (action->text() == QString::fromUtf8(text)) action->trigger();
    }
    QCOMPARE(transport().speedButton()->text(), QString::fromUtf8(text));
  }
  void drag(uint64_t frame) { hands::scrubTo(transport(), frame); }
  std::map<uint64_t, uint64_t> m_hashes;
};

QTEST_MAIN(TestRecordedView)
#include "tst_recordedview.moc"
