// SPDX-License-Identifier: Apache-2.0
// A cup is sketched in the air and made rigid, water is sketched into it, an ice cube beside it is grabbed, dropped in
// and heated until it melts; two undos; and what is saved then is what is there, and goes on as it would have.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "tests/ui/gizmohands.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/tools/tooltable.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>

#include <cmath>

using namespace ps;

namespace {

constexpr double kRadius = 0.1, kHeight = 0.16;  // m, of the cup
constexpr int kRun = 120000;                     // ms that a part of the story may take

}  // namespace

class TestSketchedCup : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    open();
    session().pause();
    QTest::keyClick(m_window.get(), Qt::Key_N, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot() && session().snapshot()->position.empty(), kLong);
    session().pause();
    view()->show(StandardView::Scene);
    QCOMPARE(document().setParameter({Owner::Solver, "", "thermal_time_scale"}, 100.0), QString());
  }
  void cleanupTestCase() { m_window.reset(); }

  /// Wall and bottom are one body, which stands still as it is drawn.
  void aCupIsSketchedAndMadeRigid() {
    choose("aluminium");
    key(Qt::Key_B);
    key(Qt::Key_L);
    const double half = m_window->tools().spacing() / 2;
    BrushSettings brush = m_window->tools().brush();
    brush.radius = kRadius;
    brush.temperature = 293.15;
    brush.drawOn = DrawOn::AcrossZ;
    brush.planeAt = 0;
    m_window->tools().setBrush(brush);
    shape("tube");
    strokeTo({{0, 0.1, 0}, {0, 0.1 + kHeight, 0}});
    m_cup = document().project().bodies.back().id;
    brush.drawOn = DrawOn::Level;
    brush.planeAt = 0.1 - half;
    m_window->tools().setBrush(brush);
    shape("disc");
    strokeTo({{0, 0.1, 0}, {0.001, 0.1, 0}});
    QCOMPARE(document().project().bodies.size(), size_t{1});
    QVERIFY(placesOf(m_cup).size() > 200);
    ParameterRow* holds = row(Owner::Body, m_cup, kStructureKey);
    QVERIFY(holds);
    holds->setFocus();
    const auto structure = [&] {
      const auto& constraints = document().body(m_cup)->constraints;
      return constraints.empty() ? std::string() : constraints.front().plugin;
    };
    for (int k = 0; k < 9 && structure() != "rigid"; ++k) QTest::keyClick(holds, Qt::Key_Up);
    for (int k = 0; k < 9 && structure() != "rigid"; ++k) QTest::keyClick(holds, Qt::Key_Down);
    QCOMPARE(structure(), std::string("rigid"));
    // It acts at once at 0 s: what was drawn before is made anew.
    QTRY_VERIFY_WITH_TIMEOUT(!session().appliesAtOnce() || !placesOf(m_cup).empty(), kLong);
    picture(QStringLiteral("cup.png"));
  }

  /// Both are made real, and what was poured stays in the cup.
  void waterIsSketchedIntoIt() {
    choose("water");
    BrushSettings brush = m_window->tools().brush();
    brush.radius = 0.04;
    brush.temperature = 290;
    brush.drawOn = DrawOn::AcrossZ;
    brush.planeAt = 0;
    m_window->tools().setBrush(brush);
    key(Qt::Key_B);
    shape("sphere");
    strokeTo({{0, 0.16, 0}, {0, 0.21, 0}});
    m_water = document().project().bodies.back().id;
    QVERIFY(m_water != m_cup);
    const size_t count = placesOf(m_water).size();
    QVERIFY2(count > 30, qPrintable(QString::number(count)));
    const double start = meanOf(m_cup).y();
    playOn(0.3);
    QVERIFY(std::abs(meanOf(m_cup).y() - start) < 1e-6);  // still held
    key(Qt::Key_Return);
    playOn(1.5);
    QVERIFY2(meanOf(m_cup).y() < start - 0.05, qPrintable(QString::number(meanOf(m_cup).y())));  // it has come down
    picture(QStringLiteral("cup-with-water.png"));
    QVERIFY2(inCup(m_water) >= 0.95 * count, qPrintable(QString::number(inCup(m_water))));
  }

  /// Sketched beside the cup while it all goes on, taken by hand, and let go above the cup.
  void anIceCubeIsDroppedIn() {
    key(Qt::Key_B);
    key(Qt::Key_L);  // live from now on
    BrushSettings brush = m_window->tools().brush();
    QVERIFY(!brush.held);
    brush.radius = 0.03;
    brush.temperature = 263;
    brush.drawOn = DrawOn::AcrossZ;
    m_window->tools().setBrush(brush);
    shape("cube");
    strokeTo({{0.3, 0.05, 0}, {0.301, 0.05, 0}});
    m_ice = document().project().bodies.back().id;
    QVERIFY(m_ice != m_water);
    m_iceCount = placesOf(m_ice).size();
    QVERIFY(m_iceCount > 8);
    playOn(0.3);
    view()->setFocus();
    key(Qt::Key_G);
    session().play();
    const Vector3 at = meanOf(m_ice);
    QVERIFY(hold({at, {0.3, 0.4, 0}, {0.15, 0.45, 0}, {0, 0.4, 0}}));
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(meanOf(m_ice).x()) < 0.04 && meanOf(m_ice).y() > 0.3, kRun);
    letGo({0, 0.4, 0});
    playOn(1);
    picture(QStringLiteral("cup-with-ice.png"));
    QVERIFY2(inCup(m_ice) == m_iceCount, qPrintable(QString::number(inCup(m_ice))));
  }

  /// From above, where the hand meets what is in the cup, and not its wall. It melts, and does not boil.
  void itIsHeatedUntilItMelts() {
    view()->show(StandardView::Top);
    key(Qt::Key_H);
    BrushSettings brush = m_window->tools().brush();
    brush.radius = 0.1;
    brush.parameters["heat"].values = {{"power", 5000.0}, {"limit", 340.0}};
    m_window->tools().setBrush(brush);
    session().play();
    QVERIFY(hold({meanOf(m_ice)}));
    QTRY_VERIFY_WITH_TIMEOUT(liquidOf(m_ice) == m_iceCount, kRun);
    letGo(meanOf(m_ice));
    session().pause();
    QVERIFY(document().undoStack().undoText().contains(QStringLiteral("Heat")));
    picture(QStringLiteral("cup-with-melted-ice.png"));
  }

  /// The heat goes back to where it came from, and then the ice cube.
  void twoUndosAndASavedState() {
    const double heated = heaters();
    QVERIFY(heated > 0);
    key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY2(std::abs(heaters()) < 1e-3 * heated, qPrintable(QString::number(heaters() / heated)));
    QCOMPARE(placesOf(m_ice).size(), m_iceCount);
    key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(placesOf(m_ice).empty());
    QVERIFY(!document().body(m_ice));
    const QString file = m_folder.filePath(QStringLiteral("cup.json"));
    QAction* save = m_window->action(QStringLiteral("file.saveState"));
    hands::answerDialog(file);
    save->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(file) && !document().isDirty(), kLong);
    PluginRegistry plugins;
    const Project saved = loadProject(file.toStdString(), plugins).project;
    QVERIFY(saved.state);
    Engine reopened(saved, plugins);
    QVERIFY2(reopened.remarks().empty(), reopened.remarks().empty() ? "" : reopened.remarks().front().c_str());
    QCOMPARE(reopened.particles().size(), idsNow(session()).size());
    QCOMPARE(reopened.stateHash(), onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stateHash(); }));
    QCOMPARE(saved.bodies.size(), size_t{2});  // cup and water
    for (int frame = 0; frame < 10; ++frame) {
      reopened.step();
      key(Qt::Key_Right);
    }
    QTRY_VERIFY_WITH_TIMEOUT(frameNow() == reopened.solver().frame(), kLong);
    QCOMPARE(onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stateHash(); }), reopened.stateHash());
  }

 private:
  void key(Qt::Key which, Qt::KeyboardModifiers modifiers = {}) {
    QApplication::setActiveWindow(m_window.get());
    view()->setFocus();
    QTest::keyClick(view(), which, modifiers);
  }
  void choose(const char* material) {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    const QRect tile = panel->tileOf(material);
    QVERIFY2(!tile.isEmpty(), material);
    QTest::mouseClick(panel, Qt::LeftButton, {}, tile.center());
    QCOMPARE(m_window->selection().material(), std::string(material));
  }
  void shape(const char* brush) {
    QAction* action = m_window->action(QStringLiteral("sketch.shape.") + QString::fromLatin1(brush));
    QVERIFY2(action, brush);
    action->trigger();
    QCOMPARE(m_window->tools().brush().shape, std::string(brush));
  }
  void pointTo(const Vector3& place) {
    const QPointF at = hands::pixelOf(*view(), place);
    QMouseEvent event(QEvent::MouseMove, at, view()->mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(view(), &event);
  }
  /// Through places, in small steps.
  void strokeTo(const std::vector<Vector3>& places) {
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    QTest::mousePress(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), places.front()));
    for (size_t k = 1; k < places.size(); ++k) {
      for (int step = 1; step <= 8; ++step) pointTo(places[k - 1] + step / 8.0 * (places[k] - places[k - 1]));
    }
    QTest::mouseRelease(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), places.back()));
  }
  /// Pressed, and led through places slowly while the scene runs.
  bool hold(const std::vector<Vector3>& places) {
    if (!QTest::qWaitFor([&] { return view()->snapshot() != nullptr; }, kLong)) return false;
    QTest::mousePress(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), places.front()));
    for (size_t k = 1; k < places.size(); ++k) {
      for (int step = 1; step <= 20; ++step) {
        pointTo(places[k - 1] + step / 20.0 * (places[k] - places[k - 1]));
        const uint64_t frame = frameNow();
        if (!QTest::qWaitFor([&] { return frameNow() > frame + 1; }, kLong)) return false;
      }
    }
    return true;
  }
  void letGo(const Vector3& place) { QTest::mouseRelease(view(), Qt::LeftButton, {}, hands::pixelOf(*view(), place)); }
  ParameterRow* row(Owner owner, const std::string& id, const char* parameter) {
    const Address address{owner, id, parameter};
    QApplication::processEvents();
    if (!m_window->revealParameter(address, false)) return nullptr;
    QApplication::processEvents();
    return m_window->inspector().panelFor(address)->row(QString::fromStdString(address.text()));
  }
  void playOn(double seconds) {
    const double until = timeNow() + seconds;
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(timeNow() >= until, kRun);
    session().pause();
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
  }
  double timeNow() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().time(); });
  }
  uint64_t frameNow() {
    return onEngine<uint64_t>(session(), [](Engine& engine) { return engine.solver().frame(); });
  }
  double heaters() {
    return onEngine<double>(session(), [](Engine& engine) { return engine.solver().heatLedger().heaters; });
  }
  std::vector<Vector3> placesOf(const std::string& id) {
    return onEngine<std::vector<Vector3>>(session(), [id](Engine& engine) {
      std::vector<Vector3> places;
      const ParticleStore& store = engine.particles();
      for (size_t i = 0; i < store.size(); ++i)
        if (engine.bodyIds()[store.body()[i]] == id) places.push_back(vectorOf(store.position()[i]));
      return places;
    });
  }
  size_t liquidOf(const std::string& id) {
    return onEngine<size_t>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      size_t count = 0;
      for (size_t i = 0; i < store.size(); ++i)
        count += engine.bodyIds()[store.body()[i]] == id && store.motion()[i] == api::Motion::Liquid ? 1 : 0;
      return count;
    });
  }
  Vector3 meanOf(const std::string& id) {
    Vector3 sum(0, 0, 0);
    const std::vector<Vector3> places = placesOf(id);
    for (const Vector3& place : places) sum += place;
    return sum / static_cast<double>(std::max<size_t>(places.size(), 1));
  }
  /// How much of a body is within the cup's wall and above its bottom.
  size_t inCup(const std::string& id) {
    const Vector3 cup = meanOf(m_cup);
    size_t count = 0;
    for (const Vector3& p : placesOf(id)) {
      const double across = std::hypot(p.x() - cup.x(), p.z() - cup.z());
      count += across < kRadius && std::abs(p.y() - cup.y()) < kHeight ? 1 : 0;
    }
    return count;
  }

  QTemporaryDir m_folder;
  std::string m_cup, m_water, m_ice;
  size_t m_iceCount = 0;
};

QTEST_MAIN(TestSketchedCup)
#include "tst_sketchedcup.moc"
