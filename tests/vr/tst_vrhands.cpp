// SPDX-License-Identifier: Apache-2.0
// Hands in the headset: what they draw, erase, heat and carry in the editor's scene.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/project.h"
#include "core/scene/solidform.h"
#include "core/sketch/cellset.h"
#include "tests/ui/hands.h"
#include "tests/vr/panelhands.h"
#include "ui/document/declared.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"
#include "ui/vr/simulatedroom.h"
#include "ui/window/vrfeel.h"
#include "ui/window/vrhands.h"
#include "ui/window/vrpanels.h"
#include "ui/window/vrwithout.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace ps;

namespace {

/// Around a body's cells, m.
Box boxOfCells(const Body& body) {
  const auto& voxels = std::get<VoxelShape>(body.shape);
  Box box{Vector3::Constant(1e9), Vector3::Constant(-1e9)};
  for (const VoxelShape::Run& run : voxels.runs)
    for (const int x : {run.x, run.x + run.length - 1}) {
      const Vector3 p =
          Vector3(voxels.origin[0], voxels.origin[1], voxels.origin[2]) + voxels.spacing * Vector3(x, run.y, run.z);
      box = {box.first.cwiseMin(p), box.second.cwiseMax(p)};
    }
  return box;
}

/// Of the upper ones of an eye's picture, where no hand is: what their pixels have, on the average.
double lightOfCorners(const QImage& picture) {
  constexpr int kCorner = 16;
  double all = picture.isNull() ? 1e9 : 0;
  for (int y = 0; y < kCorner; ++y)
    for (int x = 0; x < kCorner; ++x)
      for (const int column : {x, picture.width() - 1 - x}) {
        const QColor colour = picture.pixelColor(column, y);
        all += colour.red() + colour.green() + colour.blue();
      }
  return all / (2 * kCorner * kCorner);
}

constexpr const char* kVive = "/interaction_profiles/htc/vive_controller";
constexpr int kShortly = 5, kForLong = 40;  // frames of 20 ms, that a button is pressed

}  // namespace

class VrHandsTest : public VrWindowTest {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    backToTheStart();
    m_window->tools().takeBrush("sphere");
    m_before = document().project().bodies.size();
  }
  void cleanup() {
    leaveAtLast();
    view()->setUpdatesEnabled(true);
    session().setSpeed(1);
    session().pause();
    preferences::setLeftHanded(false);
    preferences::setSeatedHeight(0);
  }
  void cleanupTestCase() { m_window.reset(); }

  void aTriggerDrawsAStrokeThatAButtonTakesBack();
  void aStrokeOutlivesEdits();
  void strokesEndWhereBodiesPartAndGo_data();
  void strokesEndWhereBodiesPartAndGo();
  void bothHandsDrawAtOnce();
  void aHandThatErasesPartsABody();
  void aHandThatErasesNothingLeavesNoStep();
  void oneHandErases_data();
  void oneHandErases();
  void preferencesActAtOnce();
  void aHandHeatsWhileTheSceneRuns_data();
  void aHandHeatsWhileTheSceneRuns();
  void heatIsFeltByHowSteepItIsAndWhatItMelts();
  void aGripLeadsABodyAndFeelsWhatPressesOnIt();
  void aStrokeOutlivesItsHeadset();
  void aHeadsetTakenOffEndsItsStroke();
  void buttonsPlayAndChoose();
  void handsCarryTheScene();
  void bothGripsCarryWhatTheEyesSee();
  void sticksAndPadsTurnTheWearerAndTakeThemThere_data();
  void sticksAndPadsTurnTheWearerAndTakeThemThere();
  void aVivePadChooses_data();
  void aVivePadChooses();
  void aPushAnewIsASizeAtOnce();
  void aViveMenuHasTwoMeanings_data();
  void aViveMenuHasTwoMeanings();
  void whatIsLetGoInMotionFliesOn();
  void bothHandsStretchWhatIsSoft();
  void everyBrushWorksInEitherHand_data();
  void everyBrushWorksInEitherHand();
  void aTriggerMovesMatter_data();
  void aTriggerMovesMatter();
  void handsAreSeen();
  void handsOfTheMouseAreWhereItPoints();
  void mouseDrawsWithoutAHeadset();

 private:
  size_t bodies() { return document().project().bodies.size(); }
  int steps() { return document().undoStack().index(); }
  /// Both eyes saw in a frame of the script what the view draws where the scene stands so. Their headset was left.
  void sawFrom(const ScriptedRun& run, int frame, const vr::Stand& stand, const QString& name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    for (const bool right : {false, true}) {
      const QImage picture = run.picture(frame, right);
      if (!folder.isEmpty()) picture.save(folder + QLatin1Char('/') + name + (right ? "-right.png" : "-left.png"));
      seesWhatTheViewDraws(picture, right, stand);
    }
  }
  static void eitherMainHand() {
    QTest::addColumn<bool>("leftHanded");
    QTest::newRow("right-handed") << false;
    QTest::newRow("left-handed") << true;
  }
  /// A wand of the Vive rests beside the scene, presses something for so many frames, and rests again.
  void wand(ScriptedRun& run, const char* hand, int frames, const QString& inputs) {
    const QString rests = QStringLiteral(
        R"(, "active": true, "/input/trackpad/x": 0, "/input/trackpad/y": 0, "/input/trackpad/click": false,
           "/input/menu/click": false)");
    const vr::Stand s = stand();
    const Vector3 at(std::string(hand) == "left" ? -0.3 : 0.3, 0.7, 0.2);
    run.goOn(withProfile(vrScript({}, tipKey(0, hand, s, at, rests) + tipKey(5, hand, s, at, inputs) +
                                          tipKey(5 + frames, hand, s, at, rests)),
                         kVive));
  }
  /// A small block of ice that stays where it is: nothing pulls it, and heat is as slow as it really is.
  std::string addFloatingBlock(const Vector3& at) {
    document().setParameter({Owner::Scene, "", "gravity"}, 0.0);
    document().setParameter({Owner::Solver, "", "thermal_time_scale"}, 1.0);
    Body block = document().project().bodies.front();
    block.id = block.name = "floating";
    BoxShape box;
    box.center = at;
    box.size = Vector3::Constant(0.08);
    block.shape = box;
    const std::string id = document().addBody(block);
    const size_t all = idsNow(session()).size();  // who asks the engine has it show the scene anew
    const auto shows = [&] {
      const SnapshotPtr shown = session().snapshot();
      return shown->position.size() == all && view()->snapshot() == shown;
    };
    [&] { QTRY_VERIFY_WITH_TIMEOUT(shows(), kLong); }();
    return id;
  }
  /// A hollow cube of ice in the air, of so many cells from its middle to its sides, which are three cells thick.
  std::string addHollow(int half) {
    const std::string id = addFloatingBlock({0, 0.6, 0});
    Body hollow = *document().body(id);
    document().undoStack().undo();
    VoxelShape cells;
    cells.spacing = m_window->tools().spacing();
    cells.origin = Vector3::Constant(cells.spacing / 2);
    cells.palette = {{"water", 263.15}};
    const int middle = static_cast<int>(0.6 / cells.spacing), hole = half - 3;
    for (int z = -half; z <= half; ++z)
      for (int y = -half; y <= half; ++y)
        for (int x = -half; x <= half; ++x)
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) > hole) cells.runs.push_back({x, middle + y, z, 1, 0});
    cells.runs = VoxelCanvas(cells.runs).runs();  // as edits leave them
    hollow.shape = cells;
    return document().addBody(hollow);
  }
  /// A bar of jelly along x, 0.3 m long, that floats as that does, and soon comes to rest.
  std::string addJelly(const Vector3& middle) {
    const std::string jelly = document().addMaterial("jelly");
    Body bar = *document().body(addFloatingBlock(middle));
    document().undoStack().undo();
    bar.material = jelly;
    bar.parameters.values["temperature"] = 293.15;
    ParameterSet soft;
    soft.values["damping"] = 0.05;  // s
    bar.constraints = {{"clusters", soft, {}}};
    BoxShape box;
    box.center = middle;
    box.size = {0.3, 0.06, 0.06};
    bar.shape = box;
    return document().addBody(bar);
  }
  /// m, from the first to the last of its particles along x.
  double lengthOf(const std::string& id) {
    return onEngine<double>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      double low = 1e9, high = -1e9;
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] != id) continue;
        low = std::min(low, vectorOf(store.position()[i]).x());
        high = std::max(high, vectorOf(store.position()[i]).x());
      }
      return high - low;
    });
  }
  /// m/s, of the body's fastest particle.
  double fastestOf(const std::string& id) {
    return onEngine<double>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      double fastest = 0;
      for (size_t i = 0; i < store.size(); ++i)
        if (engine.bodyIds()[store.body()[i]] == id) fastest = std::max(fastest, vectorOf(store.velocity()[i]).norm());
      return fastest;
    });
  }
  void drawsAndIsUndone(size_t hand, const Vector3& from, const Vector3& way);
  void touchesWhatIsThere(size_t hand, const std::string& id);
  void actAt(VrHands& hands, vr::HandsSeen& seen, size_t hand, const Vector3& place, double pulled);
  struct Motion {
    Vector3 place{0, 0, 0}, velocity{0, 0, 0};  ///< m and m/s, of its particles on the average
    double turns = 0;                           ///< rad/s about the vertical through there
    size_t count = 0;
  };
  Motion motionOf(const std::string& id) {
    return onEngine<Motion>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      std::vector<std::pair<Vector3, Vector3>> all;
      Motion motion;
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] != id) continue;
        all.emplace_back(vectorOf(store.position()[i]), vectorOf(store.velocity()[i]));
        motion.place += all.back().first;
        motion.velocity += all.back().second;
      }
      motion.count = all.size();
      if (all.empty()) return motion;
      motion.place /= static_cast<double>(all.size());
      motion.velocity /= static_cast<double>(all.size());
      double turned = 0, spread = 0;
      for (const auto& [place, velocity] : all) {
        const Vector3 way = place - motion.place;
        turned += way.cross(velocity).y();
        spread += way.x() * way.x() + way.z() * way.z();
      }
      motion.turns = spread > 0 ? turned / spread : 0;
      return motion;
    });
  }
  size_t m_before = 0;
};

/// Half a metre up and 0.3 m along, above the block; 20 mm are a cell.
void VrHandsTest::aTriggerDrawsAStrokeThatAButtonTakesBack() {
  const vr::Stand s = stand();
  const Vector3 from(-0.15, 0.5, 0.1), to(0.15, 0.5, 0.1);
  const std::set<uint32_t> before = idsNow(session());
  const ScriptedRun run(vrScript({}, tipKey(5, "right", s, from, {}) + tipKey(20, "right", s, from, kPulled) +
                                         tipKey(50, "right", s, to, kLetGo) +
                                         tipKey(200, "right", s, to, clicked("a"))));
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QVERIFY2(vr().frames() < 200, "the button came first");
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("brush stroke"));
  QCOMPARE(bodies(), m_before + 1);
  const Body& drawn = document().project().bodies.back();
  QCOMPARE(drawn.material, std::string("water"));
  const auto [low, high] = boxOfCells(drawn);
  const double radius = m_window->tools().brush().radius, cell = 0.02;
  QVERIFY(std::abs(low.x() - (from.x() - radius)) < 2 * cell && std::abs(high.x() - (to.x() + radius)) < 2 * cell);
  QVERIFY(std::abs((low.y() + high.y()) / 2 - 0.5) < cell && std::abs((low.z() + high.z()) / 2 - 0.1) < cell);
  QVERIFY(idsNow(session()).size() > before.size() + 50);
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 0, kLong);
  QCOMPARE(bodies(), m_before);
  QTRY_VERIFY_WITH_TIMEOUT(idsNow(session()) == before, kLong);
  leave();
  const auto felt = run.lines("haptic");
  QCOMPARE(felt.size(), size_t{1});
  QCOMPARE(felt[0]["haptic"].get<std::string>(), std::string("/user/hand/right/output/haptic"));
  QVERIFY(run.lines("violation").empty());
}

/// What somebody else sets meanwhile does not end it; what is undone is the stroke, which can be redone.
void VrHandsTest::aStrokeOutlivesEdits() {
  const vr::Stand s = stand();
  const Vector3 from(-0.15, 0.5, 0.1), to(0.15, 0.5, 0.1);
  const auto draws = [&](const Vector3& begins, const Vector3& ends) {
    return vrScript({}, tipKey(5, "right", s, begins, kLetGo) + tipKey(20, "right", s, begins, kPulled) +
                            tipKey(120, "right", s, ends, kPulled) + tipKey(130, "right", s, ends, kLetGo));
  };
  ScriptedRun run(draws(from, to));
  enter();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 50, kLong);
  QVERIFY(vr().frames() < 110);
  QVERIFY(document().setParameter({Owner::Material, "water", "viscosity"}, 0.002).isEmpty());
  QCOMPARE(steps(), 1);
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 2, kLong);
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("brush stroke"));
  const auto [low, high] = boxOfCells(document().project().bodies.back());
  QVERIFY(low.x() < from.x() && high.x() > to.x());
  const Vector3 above(0, 0.15, 0);
  const uint64_t began = vr().frames();
  run.goOn(draws(from + above, to + above));
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > began + 60, kLong);
  document().undoStack().undo();
  QCOMPARE(steps(), 2);
  QCOMPARE(document().undoStack().redoText(), QStringLiteral("brush stroke"));
  QCOMPARE(bodies(), m_before + 1);
  document().undoStack().redo();
  QCOMPARE(steps(), 3);
  leave();
  QCOMPARE(steps(), 3);
  QVERIFY(run.lines("violation").empty());
  while (document().undoStack().canUndo()) document().undoStack().undo();
}

void VrHandsTest::strokesEndWhereBodiesPartAndGo_data() {
  QTest::addColumn<bool>("onTheBar");
  QTest::addColumn<QString>("edit");
  QTest::addColumn<bool>("kept");
  QTest::newRow("elsewhere, as a body parts") << false << "part" << true;
  QTest::newRow("elsewhere, as a body goes") << false << "remove" << true;
  QTest::newRow("elsewhere, as a material comes") << false << "material" << true;
  QTest::newRow("on what parts") << true << "part" << true;
  QTest::newRow("on what goes") << true << "remove" << false;
}

/// As far as it came, as a step of its own after what the desktop did; without what it goes on with there is nothing
/// left to keep. A bar in the air, of two pieces, is what parts and goes.
void VrHandsTest::strokesEndWhereBodiesPartAndGo() {
  QFETCH(bool, onTheBar);
  QFETCH(QString, edit);
  QFETCH(bool, kept);
  Toolbox& tools = m_window->tools();
  const BrushSettings chosen = tools.brush();
  const double spacing = tools.spacing();
  Body bar;
  bar.id = "bar", bar.material = "water";
  bar.constraints.push_back({"bonds", {}, {}});
  VoxelShape cells;
  cells.origin = Vector3::Constant(spacing / 2);
  cells.spacing = spacing;
  cells.palette = {{"water", chosen.temperature}};
  cells.runs = {{-6, 30, 0, 3, 0}, {2, 30, 0, 3, 0}};
  bar.shape = cells;
  const std::string id = document().addBody(bar);
  const size_t all = idsNow(session()).size();
  QTRY_VERIFY_WITH_TIMEOUT(session().newest()->position.size() == all, kLong);
  const std::string before = writeProject(document().project());
  const int begun = steps();

  VrHands hands(session(), tools);
  vr::HandsSeen seen;
  const auto acts = [&](const Vector3& tip, double pulled) {
    seen.seconds += 0.02;
    seen.hands[vr::kRight].tip = tip;
    seen.hands[vr::kRight].input.draw = pulled;
    hands.act(seen, session().newest());
  };
  const Vector3 from = onTheBar ? Vector3(-5.5 * spacing, 30.5 * spacing, spacing / 2) : Vector3(-0.2, 0.45, -0.2);
  acts(from, 0);
  for (int k = 0; k < 5; ++k) acts(from + Vector3(0, 0, 0.02 * k), 1);
  QCOMPARE(steps(), begun);
  QTRY_VERIFY_WITH_TIMEOUT(idsNow(session()).size() > all, kLong);
  if (edit == QStringLiteral("part")) {
    QCOMPARE(document().partBody(id, {{{2, 30, 0}, {3, 30, 0}, {4, 30, 0}}}).size(), size_t{1});
  } else if (edit == QStringLiteral("remove")) {
    QCOMPARE(document().removeBody(id), QString());
  } else {
    document().addMaterial("iron");
  }
  const int edited = steps();
  QCOMPARE(edited, begun + 1);
  acts(from + Vector3(0, 0, 0.1), 1);
  acts(from + Vector3(0, 0, 0.12), 0);
  QCOMPARE(steps(), edited + (kept ? 1 : 0));
  if (kept) {
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("brush stroke"));
    const Body& drawn = onTheBar ? *document().body(id) : document().project().bodies.back();
    const auto [low, high] = boxOfCells(drawn);
    QVERIFY(low.z() < from.z() - spacing && high.z() > from.z() + 0.08);
    QVERIFY(high.x() < 2 * spacing);  // the other piece is none of it
    document().undoStack().undo();
  }
  document().undoStack().undo();
  QCOMPARE(writeProject(document().project()), before);
  QTRY_COMPARE_WITH_TIMEOUT(idsNow(session()).size(), all, kLong);
}

/// The left one with its grip held: it draws then, as the right one erases.
void VrHandsTest::bothHandsDrawAtOnce() {
  const vr::Stand s = stand();
  const Vector3 left(-0.2, 0.6, 0), right(0.2, 0.6, 0), way(0, 0, 0.2);
  const ScriptedRun run(
      vrScript({}, tipKey(5, "left", s, left, {}) + tipKey(5, "right", s, right, {}) +
                       tipKey(20, "left", s, left, kPulledHeld) + tipKey(20, "right", s, right, kPulled) +
                       tipKey(40, "left", s, left + way, kLetGoHeld) + tipKey(50, "right", s, right + way, kLetGo)));
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 2, kLong);
  QCOMPARE(bodies(), m_before + 2);
  leave();
  const auto drawn = [&](double x) {
    const auto [low, high] = boxOfCells(document().project().bodies.back());
    return std::abs((low.x() + high.x()) / 2 - x) < 0.02 && high.z() > 0.2;
  };
  QVERIFY(drawn(right.x()));
  document().undoStack().undo();
  QVERIFY(drawn(left.x()));
  document().undoStack().undo();
  QCOMPARE(bodies(), m_before);
}

/// Through a bar in the air: its smaller piece is a body then, which undo takes back before the stroke.
void VrHandsTest::aHandThatErasesPartsABody() {
  Toolbox& tools = m_window->tools();
  tools.takeBrush("cube");
  BrushSettings cube = tools.brush();
  const double radius = std::exchange(cube.radius, 0.035), spacing = tools.spacing();
  tools.setBrush(cube);
  Body bar;
  bar.id = "bar", bar.material = "water";
  bar.constraints.push_back({"bonds", {}, {}});
  bar.parameters.values["temperature"] = 260.0;
  VoxelShape cells;
  cells.origin = Vector3::Constant(spacing / 2);
  cells.spacing = spacing;
  cells.palette = {{"water", 260}};
  for (int k = 0; k < 4; ++k) cells.runs.push_back({-8, 30 + k % 2, k / 2, 17, 0});
  bar.shape = cells;
  document().addBody(bar);
  const size_t all = idsNow(session()).size();
  QTRY_VERIFY_WITH_TIMEOUT(session().newest()->position.size() == all, kLong);
  const std::string before = writeProject(document().project());
  const int begun = steps();

  VrHands hands(session(), tools);
  vr::HandsSeen seen;
  const auto at = [&](int k) -> Vector3 { return spacing * Vector3(4.5, 29 + k, 1); };
  actAt(hands, seen, vr::kLeft, at(0), 0);
  for (int k = 0; k < 5; ++k) actAt(hands, seen, vr::kLeft, at(k), 1);
  actAt(hands, seen, vr::kLeft, at(4), 0);
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("erasing stroke"));
  QTRY_COMPARE_WITH_TIMEOUT(bodies(), m_before + 2, kLong);
  QCOMPARE(steps(), begun + 2);
  document().undoStack().undo();
  QCOMPARE(bodies(), m_before + 1);
  document().undoStack().undo();
  QCOMPARE(writeProject(document().project()), before);
  cube.radius = radius;
  tools.setBrush(cube);
}

/// In the air, which is said.
void VrHandsTest::aHandThatErasesNothingLeavesNoStep() {
  Toolbox& tools = m_window->tools();
  tools.takeBrush("cube");
  QSignalSpy refused(&tools, &Toolbox::refused);
  const int begun = steps();
  const size_t all = idsNow(session()).size();
  VrHands hands(session(), tools);
  vr::HandsSeen seen;
  const Vector3 from(-0.2, 0.42, -0.2);
  actAt(hands, seen, vr::kLeft, from, 0);
  for (int k = 0; k <= 4; ++k) actAt(hands, seen, vr::kLeft, from + Vector3(0.03 * k, 0, 0), 1);
  actAt(hands, seen, vr::kLeft, from + Vector3(0.12, 0, 0), 0);
  QTRY_COMPARE_WITH_TIMEOUT(refused.count(), 1, kLong);
  QCOMPARE(refused[0][0].toString(), QStringLiteral("The matter stays as it is."));
  QCOMPARE(refused[0][1].toString(), QStringLiteral("Nothing is there to erase."));
  QCOMPARE(steps(), begun);
  QCOMPARE(idsNow(session()).size(), all);
}

void VrHandsTest::oneHandErases_data() {
  QTest::addColumn<bool>("leftHanded");
  QTest::addColumn<QString>("hand");
  QTest::addColumn<bool>("held");
  QTest::newRow("the left one") << false << QStringLiteral("left") << false;
  QTest::newRow("the right one with its grip") << false << QStringLiteral("right") << true;
  QTest::newRow("the right one of a left-handed wearer") << true << QStringLiteral("right") << false;
  QTest::newRow("the left one of theirs with its grip") << true << QStringLiteral("left") << true;
}

/// The other one, or the main one that holds.
void VrHandsTest::oneHandErases() {
  QFETCH(bool, leftHanded);
  QFETCH(QString, hand);
  QFETCH(bool, held);
  preferences::setLeftHanded(leftHanded);
  const QByteArray name = hand.toLatin1();
  const vr::Stand s = stand();
  const Vector3 at(0.15, 0.28, 0.15);  // a corner of the block
  const size_t before = idsNow(session()).size();
  const ScriptedRun run(vrScript({}, tipKey(5, name.constData(), s, at, {}) +
                                         tipKey(20, name.constData(), s, at, held ? kPulledHeld : kPulled) +
                                         tipKey(40, name.constData(), s, at, held ? kLetGoHeld : kLetGo)));
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("erasing stroke"));
  QVERIFY(idsNow(session()).size() + 30 < before);
  leave();
  document().undoStack().undo();
  QTRY_COMPARE_WITH_TIMEOUT(idsNow(session()).size(), before, kLong);
}

/// From the next frames on: the left hand draws and undoes then, and the scene stands 0.3 m lower.
void VrHandsTest::preferencesActAtOnce() {
  const vr::Stand s = stand();
  const Vector3 at(0, 0.45, 0.1);
  ScriptedRun run(vrScript({}, tipKey(5, "left", s, at, {})));
  enter();
  preferences::setLeftHanded(true);
  preferences::setSeatedHeight(30);
  QTest::qWait(600);  // it is looked at five times a second
  run.goOn(vrScript(
      {}, tipKey(0, "left", s, at, kLetGo) + tipKey(10, "left", s, at, kPulled) + tipKey(30, "left", s, at, kLetGo)));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("brush stroke"));
  const auto [low, high] = boxOfCells(document().project().bodies.back());
  const double middle = (low.y() + high.y()) / 2, wanted = at.y() + 0.3 / s.scale;
  QVERIFY2(std::abs(middle - wanted) < 0.02, qPrintable(QString::number(middle)));
  run.goOn(vrScript({}, tipKey(0, "left", s, at, {}) + tipKey(5, "left", s, at, clicked("x"))));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 0, kLong);
  QVERIFY(!session().playing());
  leave();
  QVERIFY(run.lines("violation").empty());
}

void VrHandsTest::aHandHeatsWhileTheSceneRuns_data() {
  QTest::addColumn<int>("vibration");  // %
  QTest::newRow("felt") << 60;
  QTest::newRow("not felt") << 0;
}

void VrHandsTest::aHandHeatsWhileTheSceneRuns() {
  QFETCH(int, vibration);
  preferences::setVibration(vibration);
  const vr::Stand s = stand();
  const Vector3 at(0, 0.28, 0);
  m_window->tools().takeBrush("heat");
  const ScriptedRun run(vrScript(
      {}, tipKey(5, "right", s, at, {}) + tipKey(20, "right", s, at, kPulled) + tipKey(60, "right", s, at, kLetGo)));
  session().play();
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QCOMPARE(document().undoStack().undoText(), QStringLiteral("Heat matter"));
  QCOMPARE(bodies(), m_before);
  const uint64_t ended = vr().frames();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > ended + 20, kLong);
  leave();
  session().pause();
  preferences::setVibration(60);
  // A tick is none of it: that has no frequency of its own.
  size_t felt = 0;
  for (const auto& line : run.lines("haptic")) {
    if (line.value("frequency", 0.0) == 0) continue;
    ++felt;
    QCOMPARE(line["haptic"].get<std::string>(), std::string("/user/hand/right/output/haptic"));
    QVERIFY(line["frequency"] == 40 || line["frequency"] == 160);
    QVERIFY(line["amplitude"] > 0.02 && line["amplitude"] <= 0.6001);
    QVERIFY(line["frame"].get<int>() >= 20 && line["frame"].get<uint64_t>() < ended + 10);
  }
  QCOMPARE(felt > 0, vibration > 0);
}

/// A cube of matter that gets warmer along x by 1000 K/m: 63 % of the strongest. The plane through it is held level
/// where matter is thin, by a thousandth of its spread.
void VrHandsTest::heatIsFeltByHowSteepItIsAndWhatItMelts() {
  Snapshot scene;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) {
        scene.position.push_back({0.01f * float(x), 0.01f * float(y), 0.01f * float(z), 0.005f});
        scene.temperature.push_back(300 + 10 * float(x));
        scene.phase.push_back(x < 0 ? api::Phase::Melting : api::Phase::Solid);
      }
  const Vector3 middle(0, 0, 0), away(1, 0, 0);
  QVERIFY(std::abs(steepnessAt(scene, middle, 0.04) - 1000) < 10);
  QVERIFY(std::abs(changingAt(scene, middle, 0.1) - 3.0 / 7) < 1e-9);
  QCOMPARE(steepnessAt(scene, away, 0.1), 0.0);
  QCOMPARE(changingAt(scene, away, 0.1), 0.0);
  QCOMPARE(feelingOf(scene, away, 0.1).strength, 0.0);
  const double clear = 1 - std::exp(-1.0);
  const vr::Feeling melting = feelingOf(scene, middle, 0.1);  // three sevenths of it: more than it is steep
  QCOMPARE(melting.frequency, 160.0);
  QVERIFY(std::abs(melting.strength - (1 - std::exp(-3.0 / 7 / 0.25))) < 1e-9);
  std::fill(scene.phase.begin(), scene.phase.end(), api::Phase::Solid);
  const vr::Feeling steep = feelingOf(scene, middle, 0.04);
  QCOMPARE(steep.frequency, 40.0);
  QVERIFY(std::abs(steep.strength - clear) < 0.005);
  // In a sheet it is as steep as along it.
  Snapshot sheet;
  for (size_t i = 0; i < scene.position.size(); ++i) {
    if (scene.position[i].y != 0) continue;
    sheet.position.push_back(scene.position[i]);
    sheet.temperature.push_back(scene.temperature[i]);
    sheet.phase.push_back(api::Phase::Solid);
  }
  QVERIFY(std::abs(steepnessAt(sheet, middle, 0.04) - 1000) < 10);
  std::fill(sheet.temperature.begin(), sheet.temperature.end(), 300.f);
  QCOMPARE(feelingOf(sheet, middle, 0.04).strength, 0.0);
  // Of a body that is led.
  ToolContact contact;
  QCOMPARE(feelingOf(contact).strength, 0.0);
  contact.force = {0, -5, 0};
  QVERIFY(std::abs(feelingOf(contact).strength - clear) < 1e-9 && feelingOf(contact).frequency == 80);
  contact.gradient = -2000;
  QVERIFY(std::abs(feelingOf(contact).strength - (1 - std::exp(-2.0))) < 1e-9 && feelingOf(contact).frequency == 40);
  contact.latent = 60;
  QVERIFY(std::abs(feelingOf(contact).strength - (1 - std::exp(-3.0))) < 1e-9 && feelingOf(contact).frequency == 160);
}

/// A plate is taken above the block, led down onto it, and turned with the hand; let go it stands there, and one step
/// of undo takes it back. Where the trigger comes at once it is erasing that was meant.
void VrHandsTest::aGripLeadsABodyAndFeelsWhatPressesOnIt() {
  const vr::Stand s = stand();
  const Vector3 from(0, 0.55, 0), to(0, 0.24, 0);
  Body plate;
  plate.id = "plate", plate.material = "water";
  plate.parameters.values["fixed"] = true;
  SolidShape shape;
  shape.parameters.values = {
      {"kind", std::string("block")}, {"size_x", 0.2}, {"size_y", 0.04}, {"size_z", 0.2}, {"position_y", from.y()}};
  plate.shape = shape;
  const std::string id = document().addBody(plate);
  const int before = steps();
  QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->position.size() == idsNow(session()).size(), kLong);
  const auto middle = [&] { return SolidForm(std::get<SolidShape>(document().body(id)->shape)).middle(); };
  {
    const ScriptedRun run(vrScript({}, tipKey(5, "right", s, from, kHoldsNothing) +
                                           tipKey(20, "right", s, from, kHolds) + tipKey(110, "right", s, to, kHolds) +
                                           tipKey(180, "right", s, to, kHoldsNothing)));
    session().play();
    action()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(m_window->selection().items(), (std::vector<SelectedItem>{{OutlineKind::Body, id}}),
                              kLong);
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 195, kLong);
    leave();
    session().pause();
    QVERIFY2(steps() == before + 1, qPrintable(QString::number(steps()) + document().undoStack().undoText()));
    QVERIFY2((middle() - to).norm() < 0.005, qPrintable(QString::number(middle().y())));
    // A tick is none of it: that has no frequency of its own.
    const auto felt = run.lines("haptic");
    QVERIFY(std::any_of(felt.begin(), felt.end(), [](const auto& line) {
      return line.value("frequency", 0.0) > 0 && line.value("amplitude", 0.0) > 0.02;
    }));
    document().undoStack().undo();
    QVERIFY((middle() - from).norm() < 1e-6);
  }
  {
    const ScriptedRun run(vrScript({}, tipKey(5, "right", s, from, {}) + tipKey(20, "right", s, from, kLetGoHeld) +
                                           tipKey(25, "right", s, from, kPulledHeld) +
                                           tipKey(60, "right", s, from, kLetGo)));
    action()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(document().undoStack().undoText() == QStringLiteral("erasing stroke"), kLong);
    leave();
    QVERIFY((middle() - from).norm() < 1e-6);
  }
}

/// Its runtime dies in the middle of it: what was drawn so far is one step, and can be saved.
void VrHandsTest::aStrokeOutlivesItsHeadset() {
  const vr::Stand s = stand();
  const Vector3 from(-0.15, 0.5, 0), to(0.15, 0.5, 0);
  {
    const ScriptedRun run(vrScript(
        QStringLiteral(R"(, "events": [{"frame": 40, "dies": "XR_ERROR_INSTANCE_LOST"}])"),
        tipKey(5, "right", s, from, {}) + tipKey(20, "right", s, from, kPulled) + tipKey(60, "right", s, to, kLetGo)));
    action()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!vr().active(), kLong);
  }
  QVERIFY(status().contains(QStringLiteral("has stopped")));
  QCOMPARE(steps(), 1);
  QCOMPARE(bodies(), m_before + 1);
  const Project read = readProject(writeProject(document().project()), "vr", *session().plugins()).project;
  QCOMPARE(read.bodies.size(), m_before + 1);
  const ScriptedRun again(vrScript());
  enter();
  leave();
  QVERIFY(again.lines("haptic").empty());  // nothing of what was
}

void VrHandsTest::aHeadsetTakenOffEndsItsStroke() {
  const vr::Stand s = stand();
  const Vector3 from(-0.15, 0.5, 0), to(0.15, 0.5, 0);
  const ScriptedRun run(vrScript(
      QStringLiteral(R"(, "events": [{"frame": 40, "state": "IDLE"}])"),
      tipKey(5, "right", s, from, {}) + tipKey(20, "right", s, from, kPulled) + tipKey(60, "right", s, to, {})));
  action()->trigger();
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QVERIFY(vr().active());
  leave();
}

void VrHandsTest::buttonsPlayAndChoose() {
  const double radius = m_window->tools().brush().radius;
  const vr::Stand s = stand();
  const ScriptedRun run(vrScript(
      {}, tipKey(10, "left", s, {0, 0.6, 0}, clicked("x")) + tipKey(20, "left", s, {0, 0.6, 0}, clicked("x", false)) +
              tipKey(30, "right", s, {0, 0.6, 0}, QStringLiteral(R"(, "/input/thumbstick/y": 1)")) +
              tipKey(34, "right", s, {0, 0.6, 0}, QStringLiteral(R"(, "/input/thumbstick/y": 0)"))));
  action()->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  QTRY_VERIFY_WITH_TIMEOUT(m_window->tools().brush().radius > radius, kLong);
  leave();
  session().pause();
  BrushSettings brush = m_window->tools().brush();
  brush.radius = radius;
  m_window->tools().setBrush(brush);
}

void VrHandsTest::handsCarryTheScene() {
  const vr::Stand before = stand();
  const std::array<Vector3, 2> from{Vector3(-0.2, 1, -0.3), Vector3(0.2, 1.1, -0.4)};
  const std::array<Vector3, 2> to{Vector3(0.1, 0.9, -0.2), Vector3(0.3, 1.3, -1.0)};
  const vr::Stand after = vr::carried(before, from, to);
  // What lies between the hands stays between them; both turn and stretch it, as far as that leaves it upright.
  const Vector3 middle = (from[0] + from[1]) / 2;
  QVERIFY((after.toRoom(before.toScene(middle)) - (to[0] + to[1]) / 2).norm() < 1e-9);
  QVERIFY(std::abs(after.scale / before.scale - (to[1] - to[0]).norm() / (from[1] - from[0]).norm()) < 1e-9);
  const Vector3 was = after.toRoom(before.toScene(from[1])) - after.toRoom(before.toScene(from[0]));
  const Vector3 is = to[1] - to[0];
  QVERIFY(std::abs(std::atan2(was.x(), was.z()) - std::atan2(is.x(), is.z())) < 1e-9);
  // An eye sees a place of the scene where it would see it in the room.
  const Eye eye = eyeThrough(Matrix4::Identity(), -1, 1, -1, 1, 0.03, 100);
  const Vector3 room(0.2, -0.3, -1.5);
  const auto there = project(eye, 200, 200, room), here = project(after.toScene(eye), 200, 200, after.toScene(room));
  QVERIFY(there && here && (there->head<2>() - here->head<2>()).norm() < 1e-6);
  QVERIFY((after.toScene(after.toRoom(room)) - room).norm() < 1e-9);
}

/// In the headset, by the grips of both hands from where they come together; let go it stays so.
void VrHandsTest::bothGripsCarryWhatTheEyesSee() {
  const std::array<Vector3, 2> from{Vector3(-0.15, 1.1, -0.2), Vector3(0.25, 1.1, -0.2)};
  const std::array<Vector3, 2> to{Vector3(-0.1, 1.15, -0.3), Vector3(0.38, 1.15, -0.15)};
  const vr::Stand after = vr::carried(stand(), from, to);
  QVERIFY(after.scale > 1.2 * stand().scale && after.turn < stand().turn - 0.2);
  const auto both = [](int frame, const std::array<Vector3, 2>& places, const QString& inputs) {
    return key(frame, "left", {places[vr::kLeft], Quaternion::Identity()}, inputs) +
           key(frame, "right", {places[vr::kRight], Quaternion::Identity()}, inputs);
  };
  const ScriptedRun run(vrScript(QStringLiteral(R"(, "pictures": [110])"),
                                 both(5, from, kHoldsNothing) + both(20, from, kHolds) + both(30, from, kHolds) +
                                     both(60, to, kHolds) + both(70, to, kHolds) + both(75, to, kHoldsNothing) +
                                     awayFrom(80)));
  action()->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 112, kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
  QCOMPARE(steps(), 0);
  QCOMPARE(bodies(), m_before);
  sawFrom(run, 110, after, QStringLiteral("vr-carried"));
}

void VrHandsTest::sticksAndPadsTurnTheWearerAndTakeThemThere_data() {
  QTest::addColumn<QString>("profile");
  QTest::addColumn<QString>("turns");  // a hand
  QTest::addColumn<QString>("aside");
  QTest::addColumn<QString>("forward");
  QTest::addColumn<QString>("rests");
  QTest::newRow("sticks") << kTouch << "right"
                          << R"(, "/input/thumbstick/x": 1)"
                          << R"(, "/input/thumbstick/y": 1)"
                          << R"(, "/input/thumbstick/x": 0, "/input/thumbstick/y": 0)";
  QTest::newRow("pads") << kVive << "left"
                        << R"(, "/input/trackpad/x": 1, "/input/trackpad/click": true)"
                        << R"(, "/input/trackpad/y": 1, "/input/trackpad/click": true)"
                        << R"(, "/input/trackpad/x": 0, "/input/trackpad/y": 0, "/input/trackpad/click": false)";
}

/// By 30 degrees to the right, where they are; and then to where the left hand points on the floor.
void VrHandsTest::sticksAndPadsTurnTheWearerAndTakeThemThere() {
  QFETCH(QString, profile);
  QFETCH(QString, turns);
  QFETCH(QString, aside);
  QFETCH(QString, forward);
  QFETCH(QString, rests);
  const Vector3 goal(-0.2, 0, 0.3), way = goal - scriptHead().position;
  const vr::Stand turned = vr::turned(stand(), scriptHead().position, std::numbers::pi / 6);
  vr::Stand there = turned;
  there.roomPlace -= Vector3(way.x(), 0, way.z());
  const vr::HandPose left = pointing({0, 1.1, 0}, goal), right{{0.3, 1.1, -0.2}, Quaternion::Identity()};
  const QByteArray turning = turns.toLatin1();
  const vr::HandPose& hand = turns == QStringLiteral("left") ? left : right;
  const ScriptedRun run(withProfile(
      vrScript(QStringLiteral(R"(, "pictures": [20, 22, 24, 26, 60, 130])"),
               key(5, "left", left, rests) + key(5, "right", right, rests) + key(20, turning.constData(), hand, aside) +
                   key(26, turning.constData(), hand, rests) + awayFrom(30) + key(65, "left", left, rests) +
                   key(80, "left", left, forward) + key(95, "left", left, rests) + awayFrom(100)),
      profile));
  const double radius = m_window->tools().brush().radius;
  action()->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 132, kLong);
  leave();
  QVERIFY(run.lines("violation").empty());
  QCOMPARE(m_window->tools().brush().radius, radius);
  QCOMPARE(m_window->tools().brush().shape, std::string("sphere"));
  // While it turned, the picture's corners were darker, by half or so, than they are from there afterwards.
  for (const bool eye : {false, true}) {
    double darkest = 1e9;
    for (const int frame : {20, 22, 24, 26}) darkest = std::min(darkest, lightOfCorners(run.picture(frame, eye)));
    const double still = lightOfCorners(run.picture(60, eye));
    QVERIFY2(darkest < 0.85 * still, qPrintable(QStringLiteral("%1 of %2").arg(darkest).arg(still)));
  }
  sawFrom(run, 60, turned, QStringLiteral("vr-turned"));
  sawFrom(run, 130, there, QStringLiteral("vr-gone"));
}

/// What stays pushed gives the brush a size after the other, with time between them; what is let go and pushed again,
/// by another wearer too, whose clock begins anew, does so at once.
void VrHandsTest::aPushAnewIsASizeAtOnce() {
  VrHands hands(session(), m_window->tools());
  const BrushSettings usual = m_window->tools().brush();
  double size = usual.radius;
  const auto grows = [&](double seconds, double push) {
    vr::HandsSeen seen;
    seen.seconds = seconds;
    seen.hands[seen.roles.main].input.steerY = static_cast<float>(push);
    hands.act(seen, session().newest());
    const double before = std::exchange(size, m_window->tools().brush().radius);
    return size > before;
  };
  QVERIFY(grows(10, 1));
  QVERIFY(!grows(10.05, 1));
  QVERIFY(grows(10.2, 1));
  QVERIFY(!grows(10.22, 0));
  QVERIFY(grows(10.24, 1));
  hands.letGo();
  QVERIFY(grows(10.26, 1));
  QVERIFY(!grows(10.28, 0.45) && !grows(10.3, 1));  // a thumb that trembles
  m_window->tools().setBrush(usual);
}

void VrHandsTest::aVivePadChooses_data() { eitherMainHand(); }

/// Of the hand that draws: its middle takes the next material, its top and bottom the size, its sides the shape.
void VrHandsTest::aVivePadChooses() {
  QFETCH(bool, leftHanded);
  preferences::setLeftHanded(leftHanded);
  const std::string iron = document().addMaterial("iron");
  for (const std::string& material : {iron, std::string("water")}) m_window->selection().setMaterial(material);
  const auto brush = [&] { return m_window->tools().brush(); };
  const BrushSettings before = brush();
  QCOMPARE(before.material, std::string("water"));
  ScriptedRun run(withProfile(vrScript({}, awayFrom(1)), kVive));
  enter();
  const auto pad = [&](double x, double y) {
    wand(run, leftHanded ? "left" : "right", kShortly,
         QStringLiteral(R"(, "/input/trackpad/x": %1, "/input/trackpad/y": %2, "/input/trackpad/click": true)")
             .arg(QString::number(x), QString::number(y)));
  };
  pad(0.1, 0.1);
  QTRY_COMPARE_WITH_TIMEOUT(brush().material, iron, kLong);
  pad(-0.1, 0);
  QTRY_COMPARE_WITH_TIMEOUT(brush().material, std::string("water"), kLong);
  pad(0.1, 0.9);
  QTRY_VERIFY_WITH_TIMEOUT(brush().radius > 1.01 * before.radius, kLong);
  pad(0.1, -0.9);
  QTRY_VERIFY_WITH_TIMEOUT(brush().radius < 1.01 * before.radius, kLong);
  pad(0.9, 0.1);
  QTRY_VERIFY_WITH_TIMEOUT(brush().shape != before.shape, kLong);
  pad(-0.9, 0.1);
  QTRY_COMPARE_WITH_TIMEOUT(brush().shape, before.shape, kLong);
  QCOMPARE(brush().material, before.material);
  leave();
  QVERIFY(run.lines("violation").empty());
  m_window->tools().setBrush(before);
}

void VrHandsTest::aViveMenuHasTwoMeanings_data() { eitherMainHand(); }

/// That of the hand that draws undoes, and held for long brings the board, or puts it away; that of the other one plays
/// and pauses, and held for long makes real what is held.
void VrHandsTest::aViveMenuHasTwoMeanings() {
  QFETCH(bool, leftHanded);
  preferences::setLeftHanded(leftHanded);
  const char* const main = leftHanded ? "left" : "right";
  const char* const other = leftHanded ? "right" : "left";
  const Address held{Owner::Body, "ice", "held"};
  QCOMPARE(document().setParameter(held, true), QString());
  const int before = steps();
  ScriptedRun run(withProfile(vrScript({}, awayFrom(1)), kVive));
  enter();
  const auto menu = [&](const char* hand, int frames) { wand(run, hand, frames, clicked("menu")); };
  menu(other, kForLong);
  QTRY_COMPARE_WITH_TIMEOUT(document().value(held), Value(false), kLong);
  QCOMPARE(steps(), before + 1);
  QVERIFY(!session().playing());
  menu(other, kShortly);
  QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  menu(other, kShortly);
  QTRY_VERIFY_WITH_TIMEOUT(!session().playing(), kLong);
  menu(main, kForLong);
  QTRY_VERIFY_WITH_TIMEOUT(vr().panels()->widget(vr::kBoard), kLong);
  const uint64_t after = vr().frames() + kForLong;  // it is let go by then
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > after, kLong);
  QCOMPARE(steps(), before + 1);
  menu(main, kForLong);
  QTRY_VERIFY_WITH_TIMEOUT(!vr().panels()->widget(vr::kBoard), kLong);
  menu(main, kShortly);
  QTRY_COMPARE_WITH_TIMEOUT(steps(), before, kLong);
  QCOMPARE(document().value(held), Value(true));
  leave();
  QVERIFY(run.lines("violation").empty());
}

/// As fast as the hand was. Time goes slowly, so that each of its frames sees the hand where it is by then: half of the
/// way to it is what is held goes in a frame, so that it is as fast as the hand after a few.
void VrHandsTest::whatIsLetGoInMotionFliesOn() {
  constexpr int kFrames = 30;
  const Vector3 from(-0.2, 0.6, 0.1), speed(0.4, 0.06, 0);  // m, m/s
  const std::string id = addFloatingBlock(from);
  QVERIFY(motionOf(id).count > 30);
  VrHands hands(session(), m_window->tools());
  view()->setUpdatesEnabled(false);  // nor does it wait for a picture
  session().setSpeed(0.05);
  session().play();
  QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  const auto time = [&] { return session().newest()->stats.time; };
  const auto nextFrame = [&] {
    const uint64_t frame = session().newest()->stats.frame;
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > frame, kLong);
  };
  vr::HandsSeen seen;
  const auto acts = [&](const Vector3& tip, bool holds) {
    seen.seconds = time();
    seen.hands[vr::kRight].tip = tip;
    seen.hands[vr::kRight].holds = holds;
    hands.act(seen, session().newest());
  };
  nextFrame();
  acts(from, false);
  const double began = time();
  for (int frame = 0; frame < kFrames; ++frame) {
    acts(from + (time() - began) * speed, true);
    nextFrame();
  }
  vr::HeadsetView told;
  told.matter = session().newest();
  hands.describe(told);
  QVERIFY(told.keeps[vr::kRight] && told.felt[vr::kRight].frequency == 80 && told.felt[vr::kRight].strength > 0);
  QVERIFY(told.felt[vr::kLeft].strength == 0);
  acts(from + (time() - began) * speed, false);
  hands.describe(told);
  QVERIFY(!told.keeps[vr::kRight] && told.felt[vr::kRight].strength == 0);
  for (int frame = 0; frame < 3; ++frame) nextFrame();
  const Motion thrown = motionOf(id);
  session().pause();
  QVERIFY2(
      (thrown.velocity - speed).norm() < 0.3 * speed.norm(),
      qPrintable(
          QStringLiteral("%1 %2 %3 m/s").arg(thrown.velocity.x()).arg(thrown.velocity.y()).arg(thrown.velocity.z())));
  QVERIFY(thrown.place.x() > from.x() + 0.15);
  QCOMPARE(bodies(), m_before + 1);
}

/// Taken by its ends with the grips of both, as they part; let go, after hands that rest, it has the length again that
/// it had. None of it is a step.
void VrHandsTest::bothHandsStretchWhatIsSoft() {
  constexpr int kPulls = 40, kStays = 15;                 // frames; the latter are longer than a throw is measured
  constexpr double kEnd = 0.11, kPull = 0.05, kRest = 1;  // m, of each hand, and s
  const Vector3 middle(0, 0.6, 0.1);
  const std::string id = addJelly(middle);
  const size_t all = idsNow(session()).size();
  QTRY_VERIFY_WITH_TIMEOUT(session().newest()->position.size() == all, kLong);
  const int before = steps();
  const size_t count = motionOf(id).count;
  const double length = lengthOf(id);
  QVERIFY2(std::abs(length - 0.28) < 0.021, qPrintable(QString::number(length)));
  VrHands hands(session(), m_window->tools());
  view()->setUpdatesEnabled(false);  // time does not wait for pictures
  session().play();
  QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
  const auto time = [&] { return session().newest()->stats.time; };
  const auto nextFrame = [&] {
    const uint64_t frame = session().newest()->stats.frame;
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > frame, kLong);
  };
  vr::HandsSeen seen;
  const auto acts = [&](double apart, bool hold) {
    seen.seconds = time();
    for (const size_t hand : {vr::kLeft, vr::kRight}) {
      seen.hands[hand].tip = middle + Vector3((hand == vr::kLeft ? -1 : 1) * (kEnd + apart), 0, 0);
      seen.hands[hand].holds = hold;
    }
    hands.act(seen, session().newest());
  };
  nextFrame();
  acts(0, false);
  acts(0, true);
  vr::HeadsetView told;
  hands.describe(told);
  QVERIFY(told.keeps[vr::kLeft] && told.keeps[vr::kRight]);
  for (int frame = 1; frame <= kPulls + kStays; ++frame) {
    acts(kPull * std::min(1.0, double(frame) / kPulls), true);
    nextFrame();
  }
  const double stretched = lengthOf(id);
  QVERIFY2(stretched > length + kPull && stretched < length + 3 * kPull, qPrintable(QString::number(stretched)));
  acts(kPull, false);
  const double then = time();
  QTRY_VERIFY_WITH_TIMEOUT(time() > then + kRest, kLong);
  const double after = lengthOf(id);
  session().pause();
  QVERIFY2(std::abs(after - length) < 0.2 * kPull, qPrintable(QString::number(after)));
  QCOMPARE(steps(), before);
  QCOMPARE(motionOf(id).count, count);
}

void VrHandsTest::everyBrushWorksInEitherHand_data() {
  QTest::addColumn<QString>("brush");
  const std::vector<std::string> brushes = idsByLabel(*session().plugins(), PluginKind::Brush);
  QVERIFY(brushes.size() > 15);
  for (const std::string& brush : brushes) QTest::newRow(brush.c_str()) << QString::fromStdString(brush);
}

/// Of the right hand, and of the left one of a left-handed wearer: what draws makes one step, in the air, in the hollow
/// or on its sides, as it is meant for; what touches matter makes one, or moves it.
void VrHandsTest::everyBrushWorksInEitherHand() {
  QFETCH(QString, brush);
  constexpr int kHalf = 4;
  Toolbox& tools = m_window->tools();
  const BrushSettings chosen = tools.brush();
  const std::string id = addHollow(kHalf), iron = document().addMaterial("iron");
  m_window->selection().selectBody(id);  // what a stamp stamps
  m_window->selection().setMaterial(iron);
  tools.takeBrush(brush.toStdString());
  QCOMPARE(tools.brush().shape, brush.toStdString());
  QTRY_VERIFY_WITH_TIMEOUT(!tools.stampsShape() || tools.shape(), kLong);
  const size_t all = idsNow(session()).size();
  QTRY_VERIFY_WITH_TIMEOUT(session().newest()->position.size() == all, kLong);
  QSignalSpy refused(&tools, &Toolbox::refused);
  const double spacing = tools.spacing();
  const Vector3 middle = motionOf(id).place;
  const api::BrushPlugin* plugin = session().plugins()->brush(brush.toStdString());
  for (const size_t hand : {vr::kRight, vr::kLeft}) {
    if (tools.touchesMatter())
      touchesWhatIsThere(hand, id);
    else if (tools.reworks())
      drawsAndIsUndone(hand, middle + Vector3::Constant(kHalf * spacing), Vector3(0, -0.04, 0));
    else if (plugin->extension(api::kFillsHollows))
      drawsAndIsUndone(hand, middle, Vector3(0, spacing, 0));
    else
      drawsAndIsUndone(hand, {-0.2, 0.42, -0.2}, {0.12, 0, 0});
    const QString why = refused.isEmpty() ? QString() : refused.first()[1].toString();
    QVERIFY2(why.isEmpty(), qPrintable(why));
    if (QTest::currentTestFailed()) break;
  }
  session().pause();
  tools.setBrush(chosen);
}

/// A moment later the hand is there, with its trigger so far pulled.
void VrHandsTest::actAt(VrHands& hands, vr::HandsSeen& seen, size_t hand, const Vector3& place, double pulled) {
  seen.seconds += 0.02;
  seen.hands[hand].tip = place;
  seen.hands[hand].input.draw = pulled;
  hands.act(seen, session().newest());
}

void VrHandsTest::drawsAndIsUndone(size_t hand, const Vector3& from, const Vector3& way) {
  constexpr int kParts = 8;
  const std::string before = writeProject(document().project());
  const size_t all = idsNow(session()).size();
  const int begun = steps();
  VrHands hands(session(), m_window->tools());
  vr::HandsSeen seen;
  seen.roles.main = hand;
  const auto acts = [&](double share, double pulled) { actAt(hands, seen, hand, from + share * way, pulled); };
  acts(0, 0);
  for (int part = 0; part <= kParts; ++part) acts(double(part) / kParts, 1);
  acts(1, 0);
  QTRY_COMPARE_WITH_TIMEOUT(steps(), begun + 1, kLong);  // what fills takes its time
  QVERIFY(writeProject(document().project()) != before);
  document().undoStack().undo();
  QCOMPARE(steps(), begun);
  QCOMPARE(writeProject(document().project()), before);
  QTest::qWait(50);  // where the scene is made anew
  QTRY_COMPARE_WITH_TIMEOUT(idsNow(session()).size(), all, kLong);
}

/// Upwards along a side of the cube, while time passes.
void VrHandsTest::touchesWhatIsThere(size_t hand, const std::string& id) {
  constexpr int kFrames = 10;
  session().pause();
  toTheStart();
  const int begun = steps();
  const Vector3 from = motionOf(id).place + Vector3(0.07, -0.03, 0), way(0, 0.06, 0);
  QVERIFY(fastestOf(id) < 1e-3);
  VrHands hands(session(), m_window->tools());
  vr::HandsSeen seen;
  seen.roles.main = hand;
  const auto acts = [&](double share, double pulled) { actAt(hands, seen, hand, from + share * way, pulled); };
  acts(0, 0);
  session().play();
  QTRY_VERIFY_WITH_TIMEOUT(session().playing() && session().newest()->stats.frame > 0, kLong);
  double fastest = 0;
  for (int frame = 1; frame <= kFrames; ++frame) {
    acts(double(frame) / kFrames, 1);
    const uint64_t now = session().newest()->stats.frame;
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > now, kLong);
    fastest = std::max(fastest, fastestOf(id));
  }
  acts(1, 0);
  vr::HeadsetView told;
  hands.describe(told);
  QCOMPARE(told.ticks[hand], uint64_t{1});
  session().pause();
  QVERIFY2(steps() == begun + 1 || (steps() == begun && fastest > 0.01), qPrintable(QString::number(fastest)));
  if (steps() == begun) return;
  QVERIFY(document().undoStack().undoText().contains(QStringLiteral("matter")));
  document().undoStack().undo();
  QCOMPARE(steps(), begun);
}

void VrHandsTest::aTriggerMovesMatter_data() {
  QTest::addColumn<QString>("brush");
  QTest::newRow("pushed along") << QStringLiteral("push");
  QTest::newRow("stirred") << QStringLiteral("stir");
}

/// By the hand in the headset, while the scene runs, and felt there; none of it is a step.
void VrHandsTest::aTriggerMovesMatter() {
  QFETCH(QString, brush);
  const bool stirs = brush == QStringLiteral("stir");
  const Vector3 at(-0.1, 0.6, 0.1), way(stirs ? 0 : 0.2, 0, 0);
  const std::string id = addFloatingBlock(at);
  m_window->tools().takeBrush(brush.toStdString());
  QVERIFY(m_window->tools().touchesMatter());
  const vr::Stand s = stand();
  const int before = steps();
  ScriptedRun run(vrScript({}, tipKey(1, "right", s, at, kLetGo)));
  session().play();
  enter();
  run.goOn(vrScript({}, tipKey(0, "right", s, at, kLetGo) + tipKey(10, "right", s, at, kPulled) +
                            tipKey(50, "right", s, at + way, kPulled) + tipKey(80, "right", s, at + way, kLetGo)));
  // The first turns on and on, the other one goes as far as a wall.
  const auto moved = [&] {
    const Motion motion = motionOf(id);
    return stirs ? motion.turns > 0.5 : motion.place.x() > at.x() + 0.05;
  };
  QTRY_VERIFY_WITH_TIMEOUT(moved(), kLong);
  const uint64_t after = vr().frames() + 90;
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > after, kLong);
  leave();
  session().pause();
  QCOMPARE(steps(), before);
  QVERIFY(run.lines("violation").empty());
  const auto felt = run.lines("haptic");
  QVERIFY(std::any_of(felt.begin(), felt.end(), [](const auto& line) {
    return line.value("frequency", 0.0) == 80 && line.value("amplitude", 0.0) > 0.02;
  }));
}

/// A wand in either hand, with the brush about its tip, where the hands are: the picture is another one there than
/// without them.
void VrHandsTest::handsAreSeen() {
  constexpr int kWide = 512;
  const vr::Stand s = stand();
  const std::array<Vector3, 2> tips{Vector3(-0.16, 0.45, 0.25), Vector3(0.16, 0.4, 0.25)};
  const QString there = QStringLiteral(R"(, "active": true)");
  const std::string text =
      vrScript(QStringLiteral(R"(, "pictures": [15, 40])"),
               kHandsAway + tipKey(20, "left", s, tips[0], there) + tipKey(20, "right", s, tips[1], there));
  const ScriptedRun run(
      QString::fromStdString(text).replace(QString::number(kSide), QString::number(kWide)).toStdString());
  action()->trigger();
  vr().panels()->showLabels(false);
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 42, kLong);
  leave();
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  for (const bool right : {false, true}) {
    const QImage without = run.picture(15, right), with = run.picture(40, right);
    if (!folder.isEmpty()) with.save(folder + (right ? "/hands-right.png" : "/hands-left.png"));
    const auto apart = [&](const Vector3& room) {
      const auto at = project(scriptEye(right), kWide, kWide, room);
      if (!at) return -1;
      const QPoint pixel(int(at->x()), int(at->y()));
      const QColor a = without.pixelColor(pixel), b = with.pixelColor(pixel);
      return std::abs(a.red() - b.red()) + std::abs(a.green() - b.green()) + std::abs(a.blue() - b.blue());
    };
    for (const Vector3& tip : tips) {
      const Vector3 room = s.toRoom(tip);
      QVERIFY(apart(room + Vector3(0, 0, 0.10)) > 30);            // the wand
      QVERIFY(apart(room + Vector3(0, 0.03, 0)) > 3);             // the ball about its tip
      QVERIFY(std::abs(apart(room + Vector3(0, 0.12, 0))) <= 6);  // nothing: dither, and haze
    }
  }
}

/// The point of the wand is seen under the pointer, at the length of an arm; the other hand is left where it was.
void VrHandsTest::handsOfTheMouseAreWhereItPoints() {
  vr::SimulatedRoom room;
  const double aspect = 1.5;
  room.turn(0.4, 0.1);
  room.walk({0.1, -0.2, 0.3});
  room.point(0.5, -0.25);
  const vr::HeadsetFrame frame = room.frame(1, aspect);
  const auto tipOf = [](const vr::HandInput& hand) -> Vector3 {
    return hand.aim->position + hand.aim->orientation * Vector3(0, 0, -vr::kTip);
  };
  const auto seen = project(room.eye(aspect), 300, 200, tipOf(frame.hands[vr::kRight]));
  QVERIFY(seen && std::abs(seen->x() - 225) < 1e-6 && std::abs(seen->y() - 125) < 1e-6);
  QVERIFY(std::abs((tipOf(frame.hands[vr::kRight]) - frame.head.position).norm() - 0.55) < 1e-9);
  QVERIFY((frame.head.position - placeOf(room.eye(aspect))).norm() < 1e-9);
  // Rolled, it points there still, and its upper side leans to its wearer's right.
  room.roll(0.5);
  const vr::HandPose rolled = *room.frame(1.5, aspect).hands[vr::kRight].aim;
  const vr::HandPose level = *frame.hands[vr::kRight].aim;
  QVERIFY((rolled.position - level.position).norm() < 1e-9);
  QVERIFY((rolled.orientation * Vector3::UnitZ() - level.orientation * Vector3::UnitZ()).norm() < 1e-9);
  const Vector3 upper = level.orientation.conjugate() * (rolled.orientation * Vector3::UnitY());
  QVERIFY((upper - Vector3(std::sin(0.5), std::cos(0.5), 0)).norm() < 1e-9);
  room.level();
  QVERIFY(room.frame(1.5, aspect).hands[vr::kRight].aim->orientation.angularDistance(level.orientation) < 1e-9);
  room.useOther();
  room.point(-0.5, 0);
  const vr::HeadsetFrame other = room.frame(2, aspect);
  QCOMPARE(tipOf(other.hands[vr::kRight]), tipOf(frame.hands[vr::kRight]));
  QVERIFY(tipOf(other.hands[vr::kLeft]) != tipOf(frame.hands[vr::kLeft]));
  room.give({vr::kLeft, false});
  QCOMPARE(room.used(), vr::kLeft);
  const vr::HandPose palm = *room.frame(3, aspect).hands[vr::kRight].grip;
  QVERIFY(palm.position.x() > 0.2);
  QVERIFY((palm.orientation * Vector3(-1, 0, 0)).dot((frame.head.position - palm.position).normalized()) > 0.99);
}

void VrHandsTest::mouseDrawsWithoutAHeadset() {
  QAction* without = m_window->action(QStringLiteral("simulation.tryVr"));
  without->trigger();
  QVERIFY(without->isChecked() && !action()->isChecked());
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 2, kLong);
  QVERIFY(status().contains(QStringLiteral("Trying VR")));
  VrWithout& window = *vr().window();
  const QPoint middle(window.width() / 2, window.height() / 3);
  hands::pull(window, middle, {0, 0});  // the pointer comes there
  const auto frames = [&](uint64_t more) {
    const uint64_t from = vr().frames();
    QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > from + more, kLong);
  };
  frames(3);
  while (document().undoStack().canUndo()) document().undoStack().undo();
  QTest::mousePress(&window, Qt::LeftButton, {}, middle);
  frames(3);
  for (int k = 1; k <= 5; ++k) {
    hands::move(window, middle + QPointF(12 * k, 0));
    frames(1);
  }
  const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
  if (!folder.isEmpty()) window.grabFramebuffer().save(folder + "/without.png");
  QTest::mouseRelease(&window, Qt::LeftButton, {}, middle + QPoint(60, 0));
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 1, kLong);
  QCOMPARE(bodies(), m_before + 1);
  QTest::keyPress(&window, Qt::Key_U);
  QTRY_COMPARE_WITH_TIMEOUT(steps(), 0, kLong);
  QTest::keyRelease(&window, Qt::Key_U);
  // X rolls the hand on and on; R makes real.
  const auto upper = [&]() -> Vector3 { return window.room().input(vr::kRight).aim->orientation * Vector3::UnitY(); };
  const Vector3 level = upper();
  QTest::keyPress(&window, Qt::Key_X);
  QTRY_VERIFY_WITH_TIMEOUT(upper().dot(level) < 0.9, kLong);
  QTest::keyPress(&window, Qt::Key_C);
  QTRY_VERIFY_WITH_TIMEOUT(upper().dot(level) > 1 - 1e-9, kLong);
  QTest::keyRelease(&window, Qt::Key_C);
  QTest::keyRelease(&window, Qt::Key_X);
  const Address held{Owner::Body, "ice", "held"};
  QCOMPARE(document().setParameter(held, true), QString());
  QTest::keyPress(&window, Qt::Key_R);
  QTRY_COMPARE_WITH_TIMEOUT(document().value(held), Value(false), kLong);
  QTest::keyRelease(&window, Qt::Key_R);
  QTest::keyClick(&window, Qt::Key_Escape);
  QVERIFY(!vr().active() && !without->isChecked());
  without->trigger();  // and again, until it is asked to end here
  QTRY_VERIFY_WITH_TIMEOUT(vr().frames() > 1, kLong);
  without->trigger();
  QVERIFY(!vr().active() && !status().contains(QStringLiteral("VR")));
}

QTEST_MAIN(VrHandsTest)
#include "tst_vrhands.moc"
