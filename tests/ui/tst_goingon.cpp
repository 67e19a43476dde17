// SPDX-License-Identifier: Apache-2.0
// Sketched bodies that are edited again: after they fell, turned and melted in part, with other matter, and when they
// have come apart.
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/scene/pose.h"
#include "core/simulation/bodypieces.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/restplaces.h"
#include "core/simulation/standing.h"
#include "core/sketch/cellset.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/document/placement.h"
#include "ui/document/redrawing.h"
#include "ui/tools/favouritebrush.h"
#include "ui/tools/livestroke.h"

#include <QtTest/QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;
constexpr double kIce = 263.15;

}  // namespace

class TestGoingOn : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() { open(empty()); }
  void cleanup() { close(); }

  /// A bar falls onto a hot floor, turning, and melts in part. A thread is drawn from it outwards: it lies where the
  /// hand went, on the bar's own lattice as it lies there, and the document draws the same body from its strokes.
  void aStrokeLandsOnWhatMovedTurnedAndHalfMelted() {
    const std::string bar = barThatHasMelted();
    const Snapshot before = *now();
    const Body body = *m_document->body(bar);
    const auto& drawn = std::get<VoxelShape>(body.shape);
    const auto stands = standingNear(before, 0, {}, solidTop(before), 0.1);
    QVERIFY(stands && stands->turn.angularDistance(Quaternion::Identity()) > 0.3);
    brush("particle", kIce);
    const std::vector<Vector3> way = along(solidTop(before), {0.02, 0.17, 0.05});
    draw(way);
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    const auto& after = std::get<VoxelShape>(m_document->body(bar)->shape);
    QCOMPARE(after.strokes.size(), drawn.strokes.size() + 1);
    QVERIFY(after.origin == drawn.origin && after.rotation == drawn.rotation && after.shift == drawn.shift);
    const Snapshot landed = *now();
    const std::vector<RestPair> fresh = freshPairs(before, landed);
    QVERIFY2(fresh.size() >= 5, qPrintable(QString::number(fresh.size())));
    // How the new matter lies: its places are turned as the bar is, and each within half a spacing along its axes.
    const RigidMove lies = bestMove(fresh, stands->turn);
    QVERIFY((lies.of({0, 0, 0}) - stands->of({0, 0, 0})).norm() < 1e-3);
    QVERIFY(lies.turn.angularDistance(stands->turn) < 1e-3);
    double most = 0, farthest = 0;
    for (const RestPair& one : fresh) {
      const Vector3 hand = nearestOn(way, one.place);
      most = std::max(most, (stands->turn.conjugate() * (one.place - hand)).cwiseAbs().maxCoeff());
      farthest = std::max(farthest, (hand - way.front()).norm());
    }
    QVERIFY2(most <= 0.5 * kSpacing + 1e-5, qPrintable(QString::number(most / kSpacing)));
    QVERIFY((way.back() - way.front()).norm() - farthest < kSpacing);
    QVERIFY(redrawnIn(m_document->project(), bar, after, kSpacing, *m_plugins).runs == after.runs);
  }

  /// Saved and reopened the text is the same; undo takes the matter of the stroke alone, redo brings it back where it
  /// was; back at the start its cells are the body's.
  void suchAStrokeIsSavedUndoneAndRedone() {
    const std::string bar = barThatHasMelted();
    const size_t whole = count();
    const int cells = cellCount(bar);
    const std::string before = writeProject(m_document->project());
    brush("particle", kIce);
    draw(along(solidTop(*now()), {0.02, 0.17, 0.05}));
    const size_t more = count();
    QVERIFY(more > whole);
    const std::string text = writeProject(m_document->project());
    QVERIFY(text != before);
    QCOMPARE(writeProject(parseProject(text, "what was written", *m_plugins).project), text);
    const auto places = [this] {
      std::map<uint32_t, std::array<float, 3>> all;
      const SnapshotPtr scene = now();
      for (size_t i = 0; i < scene->id.size(); ++i)
        all[scene->id[i]] = {scene->position[i].x, scene->position[i].y, scene->position[i].z};
      return all;
    };
    const auto drawn = places();
    m_document->undoStack().undo();
    QCOMPARE(count(), whole);
    QCOMPARE(writeProject(m_document->project()), before);
    m_document->undoStack().redo();
    QCOMPARE(count(), more);
    QCOMPARE(writeProject(m_document->project()), text);
    QVERIFY(places() == drawn);
    m_link->reset();
    QCOMPARE(static_cast<int>(count()), cellCount(bar));
    m_document->undoStack().undo();
    QCOMPARE(static_cast<int>(count()), cells);
    m_document->undoStack().redo();
    QCOMPARE(static_cast<int>(count()), cellCount(bar));
  }

  /// From the state that a project holds it goes on with the body as well.
  void aReopenedStateKnowsHowItsBodiesStand() {
    const std::string bar = barThatHasMelted();
    Project kept = m_document->project();
    kept.state = tests::onEngine<std::shared_ptr<const ProjectState>>(*m_engine, [&](Engine& engine) {
      StateBuffer stream;
      saveTo(stream, engine);
      return projectState(stream.bytes(), kept.bodies);
    });
    const std::string text = writeProject(kept);
    close();
    open(parseProject(text, "what was written", *m_plugins).project);
    QTRY_VERIFY(m_engine->snapshot() && m_engine->snapshot()->stats.frame > 0);
    const size_t whole = count();
    brush("particle", kIce);
    draw(along(solidTop(*now()), {0.02, 0.17, 0.05}));
    QVERIFY(count() > whole);
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    QCOMPARE(std::get<VoxelShape>(m_document->body(bar)->shape).strokes.size(), size_t{2});
  }

  /// With copies by symmetry, far off, and of what is locked, a body of its own begins.
  void otherStrokesBeginBodies() {
    const std::string bar = barThatHasMelted();
    const Vector3 top = solidTop(*now());
    brush("particle", kIce);
    draw(along(top + Vector3(0, 0.2, 0), {0.1, 0, 0}));
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    BrushSettings mirrored = m_tools->brush();
    mirrored.symmetry.mirror = "x";
    m_tools->setBrush(mirrored);
    draw(along(top, {0.02, 0.1, 0.05}));
    QCOMPARE(m_document->project().bodies.size(), size_t{3});
    m_document->undoStack().undo();
    brush("particle", kIce);
    m_document->setLocked({{Owner::Body, bar, ""}}, true);
    draw(along(top, {0, 0.1, 0}));
    QCOMPARE(m_document->project().bodies.size(), size_t{3});
  }

  /// Iron goes on with ice, where the brush joins them: one body, of two materials, with the mass of each; in its file,
  /// undone and redone; and after it has moved. Without it iron is a body of its own.
  void aBodyIsOfSeveralMaterials() {
    const std::string bar = drawBar();
    const size_t ice = count();
    brush("cube", 293.15, "iron");
    draw({{0.1, 0.42, 0}, {0.1, 0.6, 0}});
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    m_document->undoStack().undo();
    const std::string before = writeProject(m_document->project());
    joins(true);
    draw({{0.1, 0.42, 0}, {0.1, 0.6, 0}});
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    const auto voxels = [&]() -> const VoxelShape& { return std::get<VoxelShape>(m_document->body(bar)->shape); };
    QCOMPARE(voxels().palette.size(), size_t{2});
    QCOMPARE(voxels().palette[1].material, std::string("iron"));
    QCOMPARE(voxels().strokes.back().palette, 1);
    const size_t iron = count() - ice;
    QVERIFY(iron > 20);
    massesAre(ice, iron);
    const std::string text = writeProject(m_document->project());
    QCOMPARE(writeProject(parseProject(text, "what was written", *m_plugins).project), text);
    m_document->undoStack().undo();
    QCOMPARE(count(), ice);
    QCOMPARE(writeProject(m_document->project()), before);
    m_document->undoStack().redo();
    QCOMPARE(count(), ice + iron);
    QCOMPARE(writeProject(m_document->project()), text);
    m_link->reset();
    massesAre(ice, iron);
    // Once more of it takes the same entry, wherever the body has gone.
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.25; });
    const SnapshotPtr fallen = now();
    draw(along(solidTop(*fallen), {0, 0.1, 0}));
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    QCOMPARE(voxels().palette.size(), size_t{2});
    QVERIFY(count() > ice + iron);
    massesAre(ice, count() - ice);
  }

  /// The row is kept with a favourite brush; without one that says anything it is off.
  void theBrushKeepsWhetherItJoins() {
    QVERIFY(!BrushSettings().joins);
    brush("cube", 293.15);
    joins(true);
    FavouriteBrush kept = favouriteOf(m_tools->brush(), *m_plugins, m_document->project());
    kept.name = QStringLiteral("handle");
    const std::vector<FavouriteBrush> read = favouritesOf(textOf({kept}), *m_plugins);
    QCOMPARE(read.size(), size_t{1});
    QVERIFY(read[0].brush.joins);
  }

  /// A bar whose middle is erased is two pieces: one step makes two bodies of them, at the start with the cells of
  /// each; undo makes them one again.
  void piecesBecomeBodies() {
    const std::string bar = drawBar();
    m_document->setParameter({Owner::Body, bar, "heating_power"}, 100.0);
    QCOMPARE(pieces(bar).size(), size_t{1});
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    eraseMiddle(bar);
    const size_t left = count();
    const auto found = pieces(bar);
    QCOMPARE(found.size(), size_t{2});
    QVERIFY(found[0].size() >= found[1].size() && found[1].size() > 30);
    QVERIFY(found[0].size() + found[1].size() == left);
    const std::string before = writeProject(m_document->project());
    const auto ids = m_document->partBody(bar, {found[1]});
    QCOMPARE(ids.size(), size_t{1});
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    QCOMPARE(ofBody(bar), found[0].size());
    QCOMPARE(ofBody(ids[0]), found[1].size());
    QCOMPARE(count(), left);
    const double power = powerOf(bar), share = powerOf(ids[0]);
    QVERIFY(share > 0 && std::abs(power + share - 100) < 1e-9);
    const std::string text = writeProject(m_document->project());
    QCOMPARE(writeProject(parseProject(text, "what was written", *m_plugins).project), text);
    m_document->undoStack().undo();
    QCOMPARE(writeProject(m_document->project()), before);
    QCOMPARE(ofBody(bar), left);
    m_document->undoStack().redo();
    QCOMPARE(writeProject(m_document->project()), text);
    QCOMPARE(ofBody(ids[0]), found[1].size());
    // It goes on, held together as before, each by itself; and from a state as it would have.
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.3; });
    QCOMPARE(pieces(bar).size(), size_t{1});
    QCOMPARE(pieces(ids[0]).size(), size_t{1});
    QVERIFY(goesOnFromItsState());
    m_link->reset();
    QCOMPARE(static_cast<int>(ofBody(bar)), cellCount(bar));
    QCOMPARE(static_cast<int>(ofBody(ids[0])), cellCount(ids[0]));
  }

  /// Where particles stand twice as far apart as the cells that were drawn, each takes all of its cells along.
  void coarseMatterTakesItsCellsAlong() {
    const std::string bar = drawBar();
    eraseMiddle(bar);
    m_document->setParameter({Owner::Solver, "", "particle_spacing"}, 2 * kSpacing);
    m_link->reset();
    const auto found = pieces(bar);
    QCOMPARE(found.size(), size_t{2});
    const auto beyond = [this](const std::string& id, bool right) {
      const auto& voxels = std::get<VoxelShape>(m_document->body(id)->shape);
      int cells = 0;
      for (const VoxelShape::Run& run : voxels.runs) {
        for (int x = run.x; x < run.x + run.length; ++x)
          cells += (voxels.origin.x() + x * voxels.spacing > 0.03) == right ? 1 : 0;
      }
      return cells;
    };
    const int left = beyond(bar, false), right = beyond(bar, true);
    QVERIFY(left > 100 && right > 100);
    const auto ids = m_document->partBody(bar, {found[1]});
    QCOMPARE(ids.size(), size_t{1});
    // All but what stands for no particle at the faces, where a cell of two may be missing along each axis.
    const bool isRight = beyond(ids[0], true) > 0;
    QCOMPARE(beyond(ids[0], !isRight), 0);
    const int taken = beyond(ids[0], isRight), all = isRight ? right : left;
    QVERIFY2(taken > 0.4 * all, qPrintable(QStringLiteral("%1 of %2").arg(taken).arg(all)));
  }

  /// The same in another run, where nobody knows particles by their ids: by what they were made of.
  void partingIsRedoneInAnotherRun() {
    const std::string bar = drawBar();
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    eraseMiddle(bar);
    const auto found = pieces(bar);
    QCOMPARE(found.size(), size_t{2});
    const auto ids = m_document->partBody(bar, {found[1]});
    m_document->undoStack().undo();
    m_link->reset();
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    const size_t all = ofBody(bar);
    m_document->undoStack().redo();
    QCOMPARE(ofBody(ids[0]), found[1].size());
    QCOMPARE(ofBody(bar) + ofBody(ids[0]), all);
  }

  /// Wherever a hand has put a sketch, its pieces are of the cells that it has there.
  void piecesOfWhatWasPutElsewhereBecomeBodies() {
    const std::string bar = drawBar();
    const Vector3 way = put(bar, {-0.1, 0.1, 0.05});
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    eraseMiddle(bar, 0.03 + way.x());
    const auto found = pieces(bar);
    QCOMPARE(found.size(), size_t{2});
    const int whole = cellCount(bar);
    const auto ids = m_document->partBody(bar, {found[1]});
    QCOMPARE(ids.size(), size_t{1});
    QCOMPARE(static_cast<size_t>(cellCount(ids[0])), found[1].size());
    QCOMPARE(cellCount(bar) + cellCount(ids[0]), whole);
    QCOMPARE(ofBody(ids[0]), found[1].size());
  }

  /// And a stroke that goes on with it is kept beside the cells that it has there, not where they once were.
  void aStrokeOnWhatWasPutElsewhereIsKeptThere() {
    const std::string bar = drawBar();
    const Vector3 way = put(bar, {-0.1, 0.1, 0.05});
    QVERIFY(way.y() > 0.05);
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    const auto highest = [&] {
      int top = std::numeric_limits<int>::min();
      for (const VoxelShape::Run& run : std::get<VoxelShape>(m_document->body(bar)->shape).runs)
        top = std::max(top, run.y);
      return top;
    };
    const int before = highest();
    brush("particle", kIce);
    draw(along(solidTop(*now()), {0, 0.12, 0}));
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    QCOMPARE(highest(), before + 4);
    m_document->undoStack().undo();
    m_document->undoStack().undo();  // where it was drawn, as its matter knows again
    draw(along(solidTop(*now()), {0, 0.12, 0}));
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    QCOMPARE(highest(), before + 4 - static_cast<int>(std::lround(way.y() / kSpacing)));
  }

  /// Made anew, a scene knows what of its pieces a stroke has made: undone step by step while it runs, nothing is left.
  void whatAStrokeMadeOfPiecesIsUndoneInAnotherRun() {
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() && m_engine->snapshot()->bodyIds; }, 20000));
    const size_t before = count();
    const std::string bar = drawBar();
    const size_t whole = count();
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    eraseMiddle(bar);
    const auto found = pieces(bar);
    QCOMPARE(found.size(), size_t{2});
    m_document->partBody(bar, {found[1]});
    m_link->reset();
    QCOMPARE(count(), whole);
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    m_document->undoStack().undo();  // the pieces
    QCOMPARE(ofBody(bar), whole);
    m_document->undoStack().undo();  // what was erased in the run before
    m_document->undoStack().undo();  // the bar
    QCOMPARE(count(), before);
  }

  /// Strokes go with what they drew; the first body keeps all, and draws them again without what others hold.
  void strokesGoWithTheirPieces() {
    const std::string bar = drawBar();
    brush("cube", kIce);
    draw({{0.3, 0.4, 0}, {0.3, 0.5, 0}});
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    playUntil([](const Snapshot& scene) { return scene.stats.time > 0.1; });
    eraseMiddle(bar);
    const auto found = pieces(bar);
    QCOMPARE(found.size(), size_t{2});
    const auto ids = m_document->partBody(bar, {found[1]});
    const auto& first = std::get<VoxelShape>(m_document->body(bar)->shape);
    const auto& second = std::get<VoxelShape>(m_document->body(ids[0])->shape);
    QCOMPARE(first.strokes.size(), size_t{2});
    QCOMPARE(second.strokes.size(), size_t{1});
    QVERIFY(redrawnIn(m_document->project(), bar, first, kSpacing, *m_plugins).runs == first.runs);
    QVERIFY(redrawnIn(m_document->project(), ids[0], second, kSpacing, *m_plugins).runs == second.runs);
  }

  /// By the mouse as by a hand: with the body goes what was being drawn on it, and undo brings back the body alone.
  void aBodyThatGoesTakesWhatIsDrawnOnIt() {
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() && m_engine->snapshot()->bodyIds; }, 20000));
    const size_t without = count();
    const std::string bar = drawBar();
    const size_t whole = count();
    const std::string before = writeProject(m_document->project());
    brush("cube", kIce);
    LiveStroke stroke(*m_tools);
    QCOMPARE(stroke.begin(false, *now(), {0, 0.42, 0}, {0, 1, 0}, 1.0), QString());
    stroke.move({0, 0.6, 0}, 0.1, 1.0);
    QTRY_VERIFY(count() > whole);
    QCOMPARE(m_document->removeBody(bar), QString());
    QCOMPARE(count(), without);
    stroke.move({0, 0.7, 0}, 0.2, 1.0);
    QVERIFY(stroke.finish().contains(QStringLiteral("was deleted meanwhile")));
    QVERIFY(!stroke.active() && !stroke.kept());
    QVERIFY(m_document->project().bodies.empty());
    QCOMPARE(count(), without);
    m_document->undoStack().undo();
    QCOMPARE(writeProject(m_document->project()), before);
    QCOMPARE(count(), whole);
    m_link->reset();
    QCOMPARE(count(), whole);
  }

  /// And with it goes what is being erased of it: a stroke that is given up brings back nothing of a body that has
  /// gone, which comes back whole, with all that ties it. One that goes on has erased what it had.
  void aBodyThatGoesTakesWhatIsErasedOfIt() {
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() && m_engine->snapshot()->bodyIds; }, 20000));
    const size_t without = count();
    const std::string bar = drawBar();
    const size_t whole = count(), tied = ties();
    const std::string before = writeProject(m_document->project());
    take("cube", 0.05);
    const auto erase = [&](LiveStroke& stroke) {
      QCOMPARE(stroke.begin(true, *now(), {0.04, 0.4, 0}, {0, 1, 0}, 1.0), QString());
      stroke.move({0.07, 0.4, 0}, 0.1, 1.0);
      QTRY_VERIFY(count() < whole);
    };
    LiveStroke givenUp(*m_tools), kept(*m_tools);
    erase(givenUp);
    QCOMPARE(m_document->removeBody(bar), QString());
    QCOMPARE(count(), without);
    givenUp.cancel();
    QCOMPARE(count(), without);
    m_document->undoStack().undo();
    QCOMPARE(writeProject(m_document->project()), before);
    QCOMPARE(count(), whole);
    QCOMPARE(ties(), tied);

    erase(kept);
    QCOMPARE(m_document->removeBody(bar), QString());
    QCOMPARE(count(), without);
    m_document->undoStack().undo();
    QVERIFY(count() < whole);
    QCOMPARE(kept.finish(), QString());
    QVERIFY(cellCount(bar) < static_cast<int>(whole - without));
    QTRY_COMPARE(count(), without + static_cast<size_t>(cellCount(bar)));
    m_document->undoStack().undo();
    QCOMPARE(writeProject(m_document->project()), before);
    QTRY_COMPARE(count(), whole);
  }

 private:
  static Project empty() {
    Project project = scenes::iceOnPlate(5, 420, 2500);
    project.bodies.clear();
    project.probes.clear();
    project.environment = scenes::tray(0.9, 1.2);
    ParameterSet& floor = project.environment.walls[0].parameters;
    floor.values["heat"] = std::string("fixed_temperature");
    floor.values["temperature"] = 420.0;
    SceneMaterial iron;
    iron.id = iron.base = "iron";
    iron.label = "Iron";
    project.materials.push_back(iron);
    return project;
  }
  SnapshotPtr now() {
    return tests::onEngine<SnapshotPtr>(*m_engine, [](Engine& engine) { return engine.snapshot(); });
  }
  size_t count() { return now()->id.size(); }
  size_t ties() {
    return tests::onEngine<size_t>(*m_engine, [](Engine& engine) { return engine.solver().constraintCount(); });
  }
  size_t ofBody(const std::string& id) {
    const SnapshotPtr scene = now();
    size_t own = 0;
    for (const uint32_t body : scene->body) own += (*scene->bodyIds)[body] == id ? 1 : 0;
    return own;
  }
  int cellCount(const std::string& id) const {
    int cells = 0;
    for (const VoxelShape::Run& run : std::get<VoxelShape>(m_document->body(id)->shape).runs) cells += run.length;
    return cells;
  }
  double powerOf(const std::string& id) const {
    return std::get<double>(m_document->value({Owner::Body, id, "heating_power"}));
  }
  std::vector<CellIndices> pieces(const std::string& id) {
    return tests::onEngine<std::vector<CellIndices>>(
        *m_engine, [body = *m_document->body(id)](Engine& engine) { return piecesOf(tiedScene(engine), body); });
  }
  void brush(const char* shape, double temperature, const char* material = "water") {
    take(shape, 0.06);
    BrushSettings brush = m_tools->brush();
    brush.temperature = temperature;
    brush.material = material;
    brush.becomes = kBecomesOfItself;
    brush.symmetry = {};
    m_tools->setBrush(brush);
  }
  void joins(bool on) {
    BrushSettings brush = m_tools->brush();
    brush.joins = on;
    m_tools->setBrush(brush);
  }
  static std::vector<Vector3> along(const Vector3& from, const Vector3& way) {
    std::vector<Vector3> places;
    for (int k = 0; k <= 8; ++k) places.push_back(from + k / 8.0 * way);
    return places;
  }
  void draw(const std::vector<Vector3>& way) {
    LiveStroke stroke(*m_tools);
    QCOMPARE(stroke.begin(false, *now(), way.front(), {0, 1, 0}, 1.0), QString());
    for (size_t k = 1; k < way.size(); ++k) stroke.move(way[k], 0.05 * static_cast<double>(k), 1.0);
    QCOMPARE(stroke.finish(), QString());
    now();
    QCoreApplication::processEvents();
  }
  /// Of ice, level, 0.4 m up, 0.48 m long.
  std::string drawBar() {
    if (!QTest::qWaitFor([&] { return m_engine->snapshot() && m_engine->snapshot()->bodyIds; }, 20000)) return {};
    brush("cube", kIce);
    draw({{-0.18, 0.4, 0}, {0.3, 0.4, 0}});
    return m_document->project().bodies.empty() ? std::string() : m_document->project().bodies.front().id;
  }
  /// Where it is drawn by now, from where it was: by whole cells.
  Vector3 put(const std::string& id, const Vector3& way) {
    const RigidMove move = possibleMove(*m_document->body(id), {Quaternion::Identity(), way});
    Placement there;
    there.bodies.push_back(moved(*m_document->body(id), move));
    m_document->place(there, QStringLiteral("moving"));
    return move.shift;
  }
  void playUntil(const std::function<bool(const Snapshot&)>& done) {
    m_engine->play();
    QVERIFY(QTest::qWaitFor([&] { return done(*m_engine->snapshot()); }, 240000));
    m_engine->pause();
    now();
  }
  static double liquidShare(const Snapshot& scene) {
    const auto liquid = std::count(scene.motion.begin(), scene.motion.end(), api::Motion::Liquid);
    return static_cast<double>(liquid) / static_cast<double>(std::max<size_t>(1, scene.motion.size()));
  }
  std::string barThatHasMelted() {
    const std::string bar = drawBar();
    m_document->setParameter({Owner::Body, bar, "spin_y"}, 3.0);
    m_document->setParameter({Owner::Body, bar, "spin_z"}, 1.0);
    m_link->reset();
    playUntil([](const Snapshot& scene) { return liquidShare(scene) > 0.35; });
    return bar;
  }
  /// The solid particle that stands highest.
  static Vector3 solidTop(const Snapshot& scene) {
    Vector3 top(0, -1, 0);
    for (size_t i = 0; i < scene.position.size(); ++i) {
      const Vector3 place = vectorOf(scene.position[i]);
      if (scene.motion[i] == api::Motion::Solid && place.y() > top.y()) top = place;
    }
    return top;
  }
  static std::vector<RestPair> freshPairs(const Snapshot& before, const Snapshot& after) {
    const std::set<uint32_t> known(before.id.begin(), before.id.end());
    std::vector<RestPair> pairs;
    for (size_t i = 0; i < after.id.size(); ++i) {
      if (!known.contains(after.id[i])) pairs.push_back({*after.rest->of(after.id[i]), vectorOf(after.position[i])});
    }
    return pairs;
  }
  static Vector3 nearestOn(const std::vector<Vector3>& way, const Vector3& place) {
    const Vector3 arm = way.back() - way.front();
    const double share = std::clamp((place - way.front()).dot(arm) / arm.squaredNorm(), 0.0, 1.0);
    return way.front() + share * arm;
  }
  /// kg, of the particles of each material, against their densities (ice 917, iron 7870) within what those differ by at
  /// these temperatures.
  void massesAre(size_t ice, size_t iron) {
    const double cell = kSpacing * kSpacing * kSpacing;
    const auto masses = tests::onEngine<std::map<uint32_t, std::pair<size_t, double>>>(*m_engine, [](Engine& engine) {
      std::map<uint32_t, std::pair<size_t, double>> all;
      const ParticleStore& store = engine.particles();
      for (size_t i = 0; i < store.size(); ++i) {
        auto& [number, mass] = all[store.material()[i]];
        ++number, mass += double{store.mass()[i]};
      }
      return all;
    });
    QCOMPARE(masses.size(), size_t{2});
    QCOMPARE(masses.at(0).first, ice);
    QCOMPARE(masses.at(1).first, iron);
    const double iceDensity = masses.at(0).second / (static_cast<double>(ice) * cell);
    const double ironDensity = masses.at(1).second / (static_cast<double>(iron) * cell);
    QVERIFY2(std::abs(iceDensity / 917 - 1) < 0.02, qPrintable(QString::number(iceDensity)));
    QVERIFY2(std::abs(ironDensity / 7870 - 1) < 0.02, qPrintable(QString::number(ironDensity)));
  }
  /// A slice through its matter, across its length as it was drawn.
  void eraseMiddle(const std::string& id, double middleX = 0.03) {
    const SnapshotPtr scene = now();
    std::vector<Vector3> middle;
    for (size_t i = 0; i < scene->id.size(); ++i) {
      const Vector3 rest = *scene->rest->of(scene->id[i]);
      if (std::abs(rest.x() - middleX) < 0.05) middle.push_back(vectorOf(scene->position[i]));
    }
    QVERIFY(!middle.empty());
    brush("particle", kIce);
    BrushSettings wide = m_tools->brush();
    wide.shape = "cube";
    wide.radius = 0.05;
    m_tools->setBrush(wide);
    Vector3 low = middle.front(), high = low;
    for (const Vector3& place : middle) low = low.cwiseMin(place), high = high.cwiseMax(place);
    LiveStroke stroke(*m_tools);
    const Vector3 centre = (low + high) / 2;
    QCOMPARE(stroke.begin(true, *scene, Vector3(centre.x(), low.y(), low.z()), {0, 1, 0}, 1.0), QString());
    double seconds = 0;
    for (double y = low.y(); y <= high.y() + 0.03; y += 0.03) {
      stroke.move({centre.x(), y, low.z()}, seconds += 0.05, 1.0);
      stroke.move({centre.x(), y, high.z()}, seconds += 0.05, 1.0);
    }
    QCOMPARE(stroke.finish(), QString());
    now();
    QCoreApplication::processEvents();
    QVERIFY(!id.empty() && count() < scene->id.size());
  }
  /// Ten frames on, from here and from what is saved here, to one hash.
  bool goesOnFromItsState() {
    const Project document = m_document->project();
    return tests::onEngine<bool>(*m_engine, [&, this](Engine& engine) {
      StateBuffer stream;
      saveTo(stream, engine);
      Engine other(document, *m_plugins, StateReader(stream.bytes()));
      if (other.stateHash() != engine.stateHash()) return false;
      for (int frame = 0; frame < 10; ++frame) engine.step(), other.step();
      return other.stateHash() == engine.stateHash();
    });
  }
};

QTEST_GUILESS_MAIN(TestGoingOn)
#include "tst_goingon.moc"
