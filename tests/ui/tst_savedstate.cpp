// SPDX-License-Identifier: Apache-2.0
// Projects that hold a state, in the editor: kept, opened, left for the start and come back to, removed.
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/scene/pose.h"
#include "core/simulation/projectstate.h"
#include "samplewindow.h"
#include "tests/shared/scenes.h"
#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/scenelink.h"
#include "ui/timeline/transport.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"

#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

#include <clocale>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};
constexpr uint64_t kKept = 7;

uint64_t frameOf(Session& session) {
  return onEngine<uint64_t>(session, [](Engine& engine) { return engine.solver().frame(); });
}

uint64_t hashAfter(Session& session, int frames) {
  return onEngine<uint64_t>(session, [frames](Engine& engine) {
    for (int frame = 0; frame < frames; ++frame) engine.step();
    return engine.stateHash();
  });
}

size_t countOf(Session& session) { return idsNow(session).size(); }

}  // namespace

class TestSavedState : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { QVERIFY(m_directory.isValid()); }
  void init() {
    m_path = m_directory.filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(5, 370), m_path.toStdString());
    open();
  }
  void cleanup() { m_window.reset(); }

  void keptByTheMenuItOpensThereAndGoesOn() {
    const uint64_t expected = hashAfter(session(), 30);
    keep(30);
    QVERIFY(!document().isDirty());
    QCOMPARE(document().project().state->frame, uint64_t{30});
    const uint64_t later = hashAfter(session(), 60);
    open();
    QVERIFY(!session().playing());
    QCOMPARE(hashAfter(session(), 0), expected);
    QTRY_COMPARE(m_window->transport()->timeText(), QStringLiteral("00:00.50"));
    QVERIFY(!document().isDirty());
    QCOMPARE(hashAfter(session(), 60), later);
    // Home leads to the start, and the project goes on holding its state.
    session().reset();
    QCOMPARE(frameOf(session()), uint64_t{0});
    Engine start(scenes::iceOnPlate(5, 370), *session().plugins());
    QCOMPARE(hashAfter(session(), 0), start.stateHash());
    action("simulation.state")->trigger();
    QCOMPARE(hashAfter(session(), 0), expected);
    action("simulation.reset")->trigger();
    QCOMPARE(frameOf(session()), uint64_t{0});
  }

  void theTransportSaysWhereHomeLeads() {
    auto* home = m_window->transport()->findChild<QToolButton*>();
    QCOMPARE(home->toolTip(), QStringLiteral("Back to the start (Home)"));
    for (const char* name : {"simulation.state", "file.removeState"}) QVERIFY2(!action(name)->isEnabled(), name);
    hashAfter(session(), kKept);
    keep(kKept);
    QCOMPARE(home->toolTip(),
             QStringLiteral("Back to the start (Home)\nThe project opens at its saved state, 00:00.11 (Shift+Home)"));
    for (const char* name : {"simulation.state", "file.removeState"}) QVERIFY2(action(name)->isEnabled(), name);
    QVERIFY(action("file.saveState")->toolTip().contains(QStringLiteral("Home")));
  }

  void removingAndKeepingAreStepsOfUndo() {
    hashAfter(session(), kKept);
    keep(kKept);
    action("file.removeState")->trigger();
    QVERIFY(!document().project().state && document().isDirty());
    QCOMPARE(frameOf(session()), kKept);  // the scene goes on as it stands
    document().undoStack().undo();
    QVERIFY(document().project().state && !document().isDirty());
    document().undoStack().redo();
    save();
    QVERIFY(!read().state);
    open();
    QCOMPARE(document().project().state, nullptr);
  }

  /// What a scene takes while it runs leaves the state fitting; bodies of other shapes do not.
  void saveKeepsAStateThatFits() {
    hashAfter(session(), kKept);
    keep(kKept);
    QCOMPARE(document().setParameter(kFloor, 350.0), QString());
    hashAfter(session(), 3);
    save();
    QVERIFY(read().state);
    QCOMPARE(read().state->frame, kKept);

    document().addBody(moved(*document().body("ice"), {Quaternion::Identity(), {0, 0.2, 0}}));
    save();
    QVERIFY(!read().state);
    QTRY_COMPARE(m_window->notice()->topic(), QStringLiteral("state"));
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("Saved without the state")));
    document().undoStack().undo();
    save();
    QVERIFY(read().state);  // nothing was lost
    QCOMPARE(m_window->notice()->topic(), QString());
  }

  void whatDoesNotFitOpensAtItsStartAndSaysSo() {
    hashAfter(session(), kKept);
    keep(kKept);
    Project project = read();
    std::get<BoxShape>(project.bodies[0].shape).size.y() *= 2;
    saveProject(project, m_path.toStdString());
    open();
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("open"), kLong);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("the body 'ice' has another shape by now")),
             qPrintable(m_window->notice()->text()));
    QVERIFY(session().playing());
    QVERIFY(document().project().state);
    session().pause();
    const uint64_t before = frameOf(session());
    action("simulation.state")->trigger();  // refused, and said so
    QCOMPARE(frameOf(session()), before);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("That change could not be made")),
                             kLong);
  }

  /// After a return to the state nothing is known of what strokes before it took: undoing one fills the gap again, and
  /// touches nothing else.
  void strokesBeforeAReturnTouchNoOtherMatter() {
    const size_t whole = countOf(session());
    const auto stroke = std::make_shared<StrokeRecord>();
    stroke->erase = true;
    stroke->lattice.spacing = 0.03;
    stroke->lattice.origin = {0, 0.015, 0};
    for (int k = 0; k < 27; ++k) stroke->cells.push_back({k % 3 - 1, k / 3 % 3 + 2, k / 9 - 1});
    session().link()->erase(*stroke, stroke->cells);
    stroke->edits.push_back(*eraseEdit(*document().body("ice"), 0, stroke->lattice, stroke->cells));
    document().addStroke(stroke);
    const size_t carved = countOf(session());
    QVERIFY(carved < whole);
    keep(0);
    hashAfter(session(), 5);
    action("simulation.state")->trigger();
    const std::set<uint32_t> there = idsNow(session());
    QCOMPARE(there.size(), carved);
    document().undoStack().undo();  // keeping the state
    document().undoStack().undo();  // the stroke
    const std::set<uint32_t> after = idsNow(session());
    QCOMPARE(after.size(), whole);
    QVERIFY(std::includes(after.begin(), after.end(), there.begin(), there.end()));
  }

  /// What was painted before the state was kept is known after a return to it, however far matter has moved.
  void undoAfterAReturnTakesWhatTheStrokeMade() {
    const std::set<uint32_t> ice = idsNow(session());
    paint(5);
    const std::set<uint32_t> first = idsNow(session());
    paint(8);
    const std::set<uint32_t> both = idsNow(session());
    QVERIFY(ice.size() < first.size() && first.size() < both.size());
    hashAfter(session(), 5);
    keep(5);
    session().reset();
    hashAfter(session(), 5);
    action("simulation.state")->trigger();
    QCOMPARE(idsNow(session()), both);
    document().undoStack().undo();  // keeping the state
    document().undoStack().undo();
    QCOMPARE(idsNow(session()), first);
    document().undoStack().undo();
    QCOMPARE(idsNow(session()), ice);
    document().undoStack().redo();
    QCOMPARE(idsNow(session()), first);
  }

  /// What a tap has poured is of no scene without the tap.
  void aStateWithoutItsTapDoesNotFit() {
    Emitter tap;
    tap.material = document().project().materials[0].id;
    tap.point = {0, 0.6, 0};
    const Port port = document().addEmitter(tap);
    hashAfter(session(), 30);
    keep(30);
    QVERIFY(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stats().flow.poured.count; }) > 0);
    document().removePort(port);
    save();
    QVERIFY(!read().state);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("The state has matter of 'tap', which has gone.")),
             qPrintable(m_window->notice()->text()));
    document().undoStack().undo();
    save();
    QVERIFY(read().state);
  }

  /// Whatever keeps a project from opening at its state is said when it is saved, not when it is opened.
  void saveSaysThatTheModelOfHeatIsAnother() {
    hashAfter(session(), kKept);
    keep(kKept);
    QCOMPARE(document().setParameter({Owner::Scene, "", "thermal_model"}, std::string("thesis_latent")), QString());
    save();
    QVERIFY(!read().state);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("The state is of the thermal model 'enthalpy'")),
             qPrintable(m_window->notice()->text()));
    document().undoStack().undo();
    save();
    QVERIFY(read().state);
  }

  /// What no project holds is told when it is saved, and how to keep it.
  void whatOnlyTheRunHoldsIsTold() {
    const auto told = [&] { return m_window->notice()->topic() == QLatin1String("state"); };
    hashAfter(session(), kKept);
    paint(8);  // its body is in the project
    save();
    QVERIFY(!told());
    const auto stroke = std::make_shared<StrokeRecord>();
    stroke->erase = true;
    stroke->lattice.spacing = 0.03;
    stroke->lattice.origin = {0, 0.015, 0};
    stroke->cells = {{0, 1, 0}};
    session().link()->erase(*stroke, stroke->cells);
    document().addStroke(stroke);
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->erasedOrPainted.size(), size_t{1}, kLong);
    save();
    QVERIFY(told());
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("one stroke")), qPrintable(m_window->notice()->text()));
    keep(kKept);
    QVERIFY(!told());
    action("file.removeState")->trigger();
    save();
    QVERIFY(told());
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->erasedOrPainted.empty(), kLong);
    save();  // at the start it is gone
    QVERIFY(!told());
    session().link()->erase(*stroke, stroke->cells);  // what there is at 0 s
    save();
    QVERIFY(!told());
  }

  /// What was drawn meanwhile stays at the start; what was erased does not, and no word would make that look lost.
  void homeTellsOfWhatBelongsToTheRun() {
    const auto note = [this] { return m_window->findChild<StatusLine*>()->state().note; };
    const auto home = [this] {
      action("simulation.reset")->trigger();
      QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, uint64_t{0}, kLong);
    };
    hashAfter(session(), kKept);
    paint(8);
    home();
    QVERIFY2(!note().contains(QStringLiteral("belong")), qPrintable(note()));
    hashAfter(session(), kKept);
    std::vector<std::shared_ptr<StrokeRecord>> strokes;
    for (const int x : {0, 1}) {
      const auto stroke = strokes.emplace_back(std::make_shared<StrokeRecord>());
      stroke->erase = true;
      stroke->lattice.spacing = 0.03;
      stroke->lattice.origin = {0, 0.015, 0};
      stroke->cells = {{x, 1, 0}};
      session().link()->erase(*stroke, stroke->cells);
      document().addStroke(stroke);
    }
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->erasedOrPainted.size(), size_t{2}, kLong);
    home();
    QVERIFY2(note().startsWith(QStringLiteral("2 edits made while it ran belong to that run: the start is as it was.")),
             qPrintable(note()));
    QCOMPARE(session().log().messages().back().text, note());
  }

  void aStateOfAProjectThatHasGoneIsDropped() {
    hashAfter(session(), kKept);
    QSignalSpy kept(&session(), &Session::stateKept);
    session().keepState();
    document().open(scenes::iceOnPlate(4, 360), {}, false, false);
    QCOMPARE(countOf(session()), size_t{64});
    QTest::qWait(300);
    QVERIFY(!document().project().state && kept.isEmpty() && !document().isDirty());
  }

 private:
  Session& session() { return m_window->session(); }
  Document& document() { return session().document(); }
  QAction* action(const char* name) { return m_window->action(QString::fromLatin1(name)); }

  /// A new window on the file, paused; at the start where it holds no state.
  void open() {
    m_window.reset();
    MainWindow::Options options;
    options.project = m_path;
    options.sample = kSample;
    options.restore = false;
    options.session.autosave = false;
    m_window = std::make_unique<MainWindow>(options);
    m_window->resize(1100, 700);
    m_window->show();
    QSignalSpy shown(m_window.get(), &MainWindow::projectShown);
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    m_window->start();
    QVERIFY(shown.wait(kLong));
    if (document().project().state) return;
    session().pause();
    session().reset();
    QCOMPARE(frameOf(session()), uint64_t{0});
  }
  void keep(uint64_t frame) {
    QSignalSpy saved(&session().files(), &DocumentFiles::saved);
    action("file.saveState")->trigger();
    QVERIFY(saved.wait(kLong));
    QVERIFY(document().project().state);
    QCOMPARE(document().project().state->frame, frame);
  }
  /// Eight cells of a sketched body, from the column `x` on, as the brush draws them.
  void paint(int x) {
    const Project& project = document().project();
    const auto stroke = std::make_shared<StrokeRecord>();
    stroke->body = "sketch";
    stroke->lattice.spacing = 0.03;
    stroke->lattice.origin = {0.015, 0.015, 0.015};
    for (int k = 0; k < 8; ++k) stroke->cells.push_back({x + k % 2, k / 2 % 2, k / 4});
    Body body;
    body.id = body.name = stroke->body;
    body.material = project.materials[0].id;
    VoxelShape voxels = stroke->lattice;
    voxels.palette.push_back({body.material, 293.15, {}});
    body.shape = voxels;
    if (const Body* known = document().body(body.id)) body = *known;
    session().link()->paint(*stroke, std::make_shared<const Body>(body), stroke->cells);
    stroke->edits.push_back(paintEdit(project, body, stroke->cells, 0, {}));
    document().addStroke(stroke);
  }
  void save() {
    QSignalSpy saved(&session().files(), &DocumentFiles::saved);
    action("file.save")->trigger();
    QVERIFY(saved.wait(kLong));
  }
  Project read() { return loadProject(m_path.toStdString(), *session().plugins()).project; }

  QTemporaryDir m_directory;
  QString m_path;
  std::unique_ptr<MainWindow> m_window;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("tst_savedstate"));
  QApplication::setOrganizationName(QStringLiteral("phasesketch"));
  std::setlocale(LC_NUMERIC, "C");
  Theme::apply(application, true);
  TestSavedState test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_savedstate.moc"
