// SPDX-License-Identifier: Apache-2.0
// What is sketched is held in the air until it is made real, while all else in the window goes on.
#include "core/io/projectio.h"
#include "core/scene/pose.h"
#include "samplewindow.h"
#include "ui/panels/outliner.h"
#include "ui/session/preferences.h"
#include "ui/session/worker.h"
#include "ui/tools/livestroke.h"
#include "ui/tools/livetouch.h"
#include "ui/tools/tooltable.h"
#include "ui/window/statusline.h"

#include <QtGui/QAction>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QPushButton>

#include <algorithm>
#include <future>
#include <memory>
#include <tuple>

using namespace ps;

class TestHoldWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    beginInTheView();
    BrushSettings brush = m_window->tools().brush();
    brush.drawOn = DrawOn::Level;
    brush.planeAt = 0.45;
    brush.temperature = 260;
    brush.held = false;
    m_window->tools().setBrush(brush);
  }
  void cleanupTestCase() { m_window.reset(); }

  void enterLetsGoOfWhatIsHeld() {
    QVERIFY(!makeReal()->isEnabled() && !button()->isVisible());
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    QVERIFY(m_window->tools().brush().held);
    const std::string id = drawn();
    QVERIFY(std::get<bool>(document().value({Owner::Body, id, "held"})));
    QVERIFY(makeReal()->isEnabled() && button()->isVisible());
    QVERIFY(view()->rect().contains(button()->geometry()));
    const double height = heightOf(id);
    playOn(0.3);
    QCOMPARE(heightOf(id), height);
    QVERIFY(session().snapshot()->stats.time > 0.2);  // all else goes on
    picture(QStringLiteral("held.png"));
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY(!makeReal()->isEnabled() && !button()->isVisible());
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("make it real"));
    playOn(0.1);
    const double fallen = heightOf(id);
    QVERIFY2(fallen < height - 0.02, qPrintable(QString::number(height - fallen)));
    document().undoStack().undo();
    playOn(0.1);
    QCOMPARE(heightOf(id), fallen);  // where it is by then
    document().undoStack().redo();
    playOn(0.1);
    QVERIFY(heightOf(id) < fallen);
  }

  void whatIsDrawnFreeIsAnotherBody() {
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    const std::string held = drawn();
    QTest::keyClick(view(), Qt::Key_L);
    const std::string free = drawn();
    QVERIFY(held != free);
    QVERIFY(!std::get<bool>(document().value({Owner::Body, free, "held"})));
  }

  void theButtonDoesTheSameAndAResetBeginsWithIt() {
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    const std::string id = drawn();
    toTheStart();
    const double height = heightOf(id);
    playOn(0.1);
    QCOMPARE(heightOf(id), height);
    QTest::mouseClick(button(), Qt::LeftButton);
    playOn(0.1);
    QVERIFY(heightOf(id) < height);
  }

  /// A key that does nothing looks broken.
  void enterSaysThatNothingIsHeld() {
    StatusLine& status = *m_window->findChild<StatusLine*>();
    status.say({});
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY2(status.state().note.startsWith(QStringLiteral("Nothing is held.")), qPrintable(status.state().note));
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    drawn();
    status.say({});
    QTest::keyClick(view(), Qt::Key_Enter);
    QVERIFY(!status.state().note.startsWith(QStringLiteral("Nothing is held.")));
    QLineEdit field(m_window.get());
    field.show();
    field.setFocus();
    QTRY_VERIFY(field.hasFocus());
    QTest::keyClick(&field, Qt::Key_Return);
    QVERIFY(!status.state().note.startsWith(QStringLiteral("Nothing is held.")));
  }

  /// Elsewhere Enter is what it always is.
  void enterInARowMakesNothingReal() {
    QTest::keyClick(view(), Qt::Key_B);
    QTest::keyClick(view(), Qt::Key_L);
    drawn();
    QLineEdit field(m_window.get());
    field.show();
    field.setFocus();
    QTRY_VERIFY(field.hasFocus());
    QTest::keyClick(&field, Qt::Key_Return);
    QVERIFY(makeReal()->isEnabled());
  }

  /// Two lumps of one sketch become two bodies by the menu, in one step; then there is nothing more to separate.
  void whatIsApartIsSeparated() {
    Body lumps = twoLumps(260);
    lumps.constraints.push_back({"bonds", {}, {}});
    const std::string id = document().addBody(lumps);
    const size_t before = document().project().bodies.size();
    const auto steps = document().undoStack().position();
    QAction* separate = m_window->action(QStringLiteral("sketch.separate"));
    QVERIFY(separate);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
    QCOMPARE(document().undoStack().position(), steps + 1);
    QVERIFY(document().undoStack().undoText().contains(QStringLiteral("separating")));
    QCOMPARE(std::get<VoxelShape>(document().body(id)->shape).runs.size(), size_t{9});
    document().undoStack().undo();
    QCOMPARE(document().project().bodies.size(), before);
    document().undoStack().redo();
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
    QCOMPARE(document().project().bodies.size(), before + 1);
  }

  void separatingHoldsNothingUp_data() {
    QTest::addColumn<bool>("locked");
    QTest::newRow("two bodies") << false;
    QTest::newRow("locked meanwhile") << true;
  }

  /// Neither the run nor the window waits while pieces are told apart; what is locked until then stays whole.
  void separatingHoldsNothingUp() {
    QFETCH(bool, locked);
    Body lumps = twoLumps(260);
    lumps.constraints.push_back({"bonds", {}, {}});
    const std::string id = document().addBody(lumps);
    const size_t before = document().project().bodies.size();
    const auto gate = std::make_shared<std::promise<void>>();
    session().worker().run([open = std::make_shared<std::future<void>>(gate->get_future())] { open->wait(); });
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().selectBody(id);
    m_window->action(QStringLiteral("sketch.separate"))->trigger();
    playOn(0.1);
    QCOMPARE(document().project().bodies.size(), before);
    document().setLocked({{Owner::Body, id, ""}}, locked);
    gate->set_value();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), locked ? 1 : 0, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + (locked ? 0 : 1), kLong);
  }

  /// Matter that was made before its sketch was scaled has none of the cells that the sketch has now: Home first.
  void aSketchOfAnotherSizeIsSeparatedAfterHome() {
    const std::string id = document().addBody(twoLumps(260));
    const size_t before = document().project().bodies.size();
    playOn(0.1);
    Placement larger;
    larger.bodies.push_back(scaled(*document().body(id), Vector3::Constant(1.5)));
    document().place(larger, QStringLiteral("scaling"));
    QAction* separate = m_window->action(QStringLiteral("sketch.separate"));
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
    QVERIFY2(refused[0][1].toString().contains(QStringLiteral("Home")), qPrintable(refused[0][1].toString()));
    QCOMPARE(document().project().bodies.size(), before);
    toTheStart();
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
  }

  /// What flows is left alone where nobody has chosen it.
  void dropsAreSeparatedWhereTheyAreChosen() {
    Body drops = twoLumps(290);
    drops.parameters.values["held"] = false;
    const std::string id = document().addBody(drops);
    const size_t before = document().project().bodies.size();
    QAction* separate = m_window->action(QStringLiteral("sketch.separate"));
    QSignalSpy refused(&m_window->tools(), &Toolbox::refused);
    m_window->tools().selection().clear();
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
    QCOMPARE(document().project().bodies.size(), before);
    m_window->tools().selection().selectBody(id);
    separate->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
  }

  /// Where a sketch is selected, the menu of its row has it; where a block is, it has not.
  void theRowOfASketchOffersSeparating() {
    const std::string id = document().addBody(twoLumps(260));
    const auto offers = [this](const std::string& body) {
      m_window->tools().selection().selectBody(body);
      Q_EMIT m_window->outliner()->menuRequested(m_window->mapToGlobal(QPoint(80, 200)));
      QWidget* menu = QApplication::activePopupWidget();
      const bool has = menu && menu->actions().contains(m_window->action(QStringLiteral("sketch.separate")));
      if (menu) menu->close();
      return has;
    };
    QVERIFY(offers(id));
    QVERIFY(!offers("ice"));
  }

  void whatAHandErasesThroughBecomesBodies_data() {
    QTest::addColumn<bool>("runs");
    QTest::newRow("paused at the start") << false;
    QTest::newRow("while it runs") << true;
  }

  /// The stroke's step, then one that makes the smaller piece a body: saved and opened they are two, and undone one
  /// after the other all is as it was.
  void whatAHandErasesThroughBecomesBodies() {
    QFETCH(bool, runs);
    const std::string id = add(bar(true));
    const size_t bodies = document().project().bodies.size(), all = count(id);
    const std::string before = writeProject(document().project());
    const int64_t steps = document().undoStack().position();
    if (runs) {
      playOn(0.1);
      session().play();
    }
    erase({{0.07, 0.58, 0.03}, {0.07, 0.68, 0.03}});
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), bodies + 1, kLong);
    session().pause();
    QCOMPARE(document().undoStack().position(), steps + 2);
    QVERIFY(document().undoStack().undoText().contains(QStringLiteral("separating")));
    const Body other = document().project().bodies.back();
    QCOMPARE(document().body(id)->name, std::string("Bar"));
    QCOMPARE(other.name, std::string("Bar 2"));
    QTRY_VERIFY_WITH_TIMEOUT(count(other.id) > 8 && count(id) > count(other.id), kLong);
    QVERIFY(count(id) + count(other.id) < all);
    opensAsItIs(other.id);
    const std::string text = writeProject(document().project());
    document().undoStack().undo();
    QCOMPARE(document().project().bodies.size(), bodies);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("erasing stroke"));
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    QTRY_COMPARE_WITH_TIMEOUT(count(id), all, kLong);
    document().undoStack().redo();
    document().undoStack().redo();
    QCOMPARE(writeProject(document().project()), text);
    QTRY_VERIFY_WITH_TIMEOUT(count(other.id) > 8, kLong);
  }

  /// Without a gap, where nothing falls: as long as time passes the brush cuts.
  void whatAHandCutsThroughBecomesBodies() {
    QCOMPARE(document().setParameter({Owner::Scene, "", "gravity"}, 0.0), QString());
    const std::string id = add(bar(false));
    const size_t bodies = document().project().bodies.size(), all = count(id);
    const int64_t steps = document().undoStack().position();
    session().play();
    cut(0.08);
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), bodies + 1, kLong);
    session().pause();
    QCOMPARE(document().undoStack().position(), steps + 2);
    const std::string other = document().project().bodies.back().id;
    QTRY_COMPARE_WITH_TIMEOUT(count(id) + count(other), all, kLong);
    QVERIFY(count(other) > 8 && count(id) > count(other));
    document().undoStack().undo();
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("Cut matter"));
    document().undoStack().undo();
    QTRY_COMPARE_WITH_TIMEOUT(count(id), all, kLong);
  }

  /// Also where no frame comes for longer than a scene that has stopped is waited for.
  void whatIsCutInASlowSceneBecomesBodies() {
    QCOMPARE(document().setParameter({Owner::Scene, "", "gravity"}, 0.0), QString());
    add(bar(false));
    const size_t bodies = document().project().bodies.size();
    session().play();
    const auto gate = std::make_shared<std::promise<void>>();
    session().engine()->ask(
        [open = std::make_shared<std::future<void>>(gate->get_future())](const Engine&) { open->wait(); });
    cut(0.08);
    QTest::qWait(1500);
    QCOMPARE(document().project().bodies.size(), bodies);
    gate->set_value();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), bodies + 1, kLong);
    session().pause();
  }

  /// What was apart before a hand came stays one body, and a crumb stays with what it was of; all does where nobody
  /// wants it otherwise.
  void whatAHandDidNotPartStaysABody() {
    Body lumps = twoLumps(260);
    lumps.constraints.push_back({"bonds", {}, {}});
    std::get<VoxelShape>(lumps.shape).origin = {0.01, 0.61, -0.19};
    add(lumps);
    add(bar(true));
    const size_t bodies = document().project().bodies.size();
    const int64_t steps = document().undoStack().position();
    erase({{-0.02, 0.58, -0.17}, {-0.02, 0.68, -0.17}});  // a side of a lump
    erase({Vector3(0.15, 0.675, 0.03)});                  // the upper third of the bar's end, then what held the rest
    erase({{0.11, 0.58, 0.03}, {0.11, 0.68, 0.03}});
    QTest::qWait(1000);
    QCOMPARE(document().undoStack().position(), steps + 3);
    preferences::setPiecesBecomeBodies(false);
    erase({{-0.05, 0.58, 0.03}, {-0.05, 0.68, 0.03}});
    QTest::qWait(1000);
    preferences::setPiecesBecomeBodies(true);
    QCOMPARE(document().undoStack().position(), steps + 4);
    QCOMPARE(document().project().bodies.size(), bodies);
  }

  /// A comb without its back.
  void manyPiecesAreToldOf() {
    add(comb());
    const size_t bodies = document().project().bodies.size();
    std::vector<Vector3> back;
    for (int k = 0; k <= 16; ++k) back.push_back({-0.32 + 0.04 * k, 0.62, 0.01});
    erase(back);
    const auto told = [this] { return m_window->notice()->text().contains(QStringLiteral("“Comb” is in 22 pieces.")); };
    QTRY_VERIFY_WITH_TIMEOUT(told(), kLong);
    QCOMPARE(document().project().bodies.size(), bodies);
    QPushButton* separate = noticeButton(*m_window, QStringLiteral("Separate pieces"));
    QVERIFY(separate);
    separate->click();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), bodies + 21, kLong);
    QVERIFY(!told());
  }

 private:
  /// In the scene by now, paused at the start.
  std::string add(const Body& body) {
    const std::string id = document().addBody(body);
    toTheStart();
    return id;
  }
  /// Saved and opened by others.
  void opensAsItIs(const std::string& id) {
    const std::string text = writeProject(document().project());
    const Project opened = parseProject(text, "what was written", *session().plugins()).project;
    QCOMPARE(writeProject(opened), text);
    const Engine engine(opened, *session().plugins());
    QCOMPARE(std::count(engine.bodyIds().begin(), engine.bodyIds().end(), id), ptrdiff_t{1});
  }
  size_t count(const std::string& id) {
    return onEngine<size_t>(session(), [id](Engine& engine) {
      const std::vector<std::string>& ids = engine.bodyIds();
      const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
      const uint32_t* first = engine.particles().body();
      return static_cast<size_t>(std::count(first, first + engine.particles().size(), index));
    });
  }
  /// With a cube of three cells.
  void erase(const std::vector<Vector3>& way) {
    Toolbox& tools = m_window->tools();
    tools.takeBrush("cube");
    BrushSettings settings = tools.brush();
    settings.radius = 0.035;
    settings.symmetry = {};
    tools.setBrush(settings);
    LiveStroke stroke(tools);
    QCOMPARE(stroke.begin(true, *session().newest(), way.front(), {0, 1, 0}, 1.0), QString());
    for (size_t k = 1; k < way.size(); ++k) stroke.move(way[k], 0.05 * static_cast<double>(k), 1.0);
    QCOMPARE(stroke.finish(), QString());
  }
  /// Across x, seen from above.
  void cut(double x) {
    Toolbox& tools = m_window->tools();
    tools.takeBrush("cut");
    BrushSettings settings = tools.brush();
    settings.radius = 0.15;
    tools.setBrush(settings);
    LiveTouch touch(tools, [](const QString&) {});
    QCOMPARE(touch.begin(settings, false, {x, 0.63, 0.12}, {0, 1, 0}, {0, -1, 0}, 1.0), QString());
    for (int k = 1; k <= 8; ++k) {
      QTest::qWait(20);
      QCOMPARE(touch.move({x, 0.63, 0.12 - 0.03 * k}, 0.02 * k, 1.0), QString());
    }
    QCOMPARE(touch.finish(), QString());
    tools.takeBrush("cube");
  }
  /// Of ice, 15 cells long, three wide and high.
  Body bar(bool held) {
    std::vector<VoxelShape::Run> runs;
    for (int k = 0; k < 9; ++k) runs.push_back({-7, k % 3, k / 3, 15, 0});
    return sketched("Bar", std::move(runs), held);
  }
  /// Eleven teeth to either side of a back that runs along x.
  Body comb() {
    std::vector<VoxelShape::Run> runs;
    for (int z = -8; z <= 8; ++z) {
      for (int y = 0; y < 2; ++y) {
        if (z == 0) runs.push_back({-15, y, z, 31, 0});
        for (int x = -15; x <= 15 && z != 0; x += 3) runs.push_back({x, y, z, 1, 0});
      }
    }
    return sketched("Comb", std::move(runs), true);
  }
  /// On the lattice that brushes have here.
  Body sketched(const std::string& name, std::vector<VoxelShape::Run> runs, bool held) {
    Body body = twoLumps(260);
    body.id = "parted";
    body.name = name;
    body.constraints.push_back({"bonds", {}, {}});
    body.parameters.values["held"] = held;
    auto& voxels = std::get<VoxelShape>(body.shape);
    voxels.origin = {0.01, 0.61, 0.01};
    voxels.runs = std::move(runs);
    return body;
  }
  /// Three cells wide each, five apart.
  Body twoLumps(double temperature) {
    Body lumps;
    lumps.id = lumps.name = "lumps";
    lumps.material = document().project().materials[0].id;
    lumps.parameters.values["temperature"] = temperature;
    lumps.parameters.values["held"] = true;
    VoxelShape shape;
    shape.spacing = m_window->tools().spacing();
    shape.origin = {0, 0.6, 0};
    shape.palette.push_back({lumps.material, temperature, {}});
    for (const int x : {0, 8}) {
      for (int k = 0; k < 9; ++k) shape.runs.push_back({x, k % 3, k / 3, 3, 0});
    }
    std::sort(shape.runs.begin(), shape.runs.end(), [](const VoxelShape::Run& a, const VoxelShape::Run& b) {
      return std::tuple(a.z, a.y, a.x) < std::tuple(b.z, b.y, b.x);
    });
    lumps.shape = shape;
    return lumps;
  }
  QAction* makeReal() { return m_window->action(QStringLiteral("sketch.real")); }
  QPushButton* button() {
    for (QPushButton* one : view()->findChildren<QPushButton*>())
      if (one->accessibleName() == QStringLiteral("Make it real")) return one;
    return nullptr;
  }
  /// A short stroke in the air; the id of the body that it made.
  std::string drawn() {
    stroke(view()->rect().center() - QPoint(30, 60), {60, 0}, true);
    return document().project().bodies.back().id;
  }
  void playOn(double seconds) {
    const double until = timeNow() + seconds;
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(timeNow() >= until, kLong);
    session().pause();
  }
  double timeNow() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().time(); });
  }
  double heightOf(const std::string& id) {
    return onEngine<double>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      double sum = 0;
      size_t count = 0;
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] != id) continue;
        sum += double{store.position()[i].y};
        ++count;
      }
      return sum / static_cast<double>(std::max<size_t>(count, 1));
    });
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestHoldWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_holdwindow.moc"
