// SPDX-License-Identifier: Apache-2.0
// Tools driven by rays, without a widget: what mouse, pen and hands would do with them.
#include "core/base/callee.h"
#include "core/scene/pose.h"
#include "core/sketch/stroke.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/document/redrawing.h"
#include "ui/tools/aim.h"
#include "ui/tools/gizmo.h"
#include "ui/tools/guides.h"

#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <cmath>
#include <memory>
#include <optional>
#include <set>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;

/// From above and in front, at a place of the scene.
Pointer aimed(const Vector3& place, const SnapshotPtr& scene = nullptr) {
  Pointer pointer;
  pointer.ray.origin = Vector3(0, 1, 1);
  pointer.ray.direction = (place - pointer.ray.origin).normalized();
  pointer.forward = Vector3(0, -1, -1).normalized();
  pointer.target = Vector3(0, 0, 0);
  pointer.scene = scene;
  return pointer;
}

}  // namespace

class TestTools : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    Project project = scenes::iceOnPlate(5, 370);
    project.environment = scenes::tray(0.6, 1.2);
    open(project);
  }

  void cleanup() {
    close();
    m_fixture.reset();
  }

  void theTableIsWhole() {
    std::set<std::string> ids, keys;
    for (const ToolRow& row : toolTable()) {
      QVERIFY(ids.insert(row.id).second && keys.insert(row.key).second);
      m_tools->activate(row.id);
      QCOMPARE(m_tools->active(), std::string(row.id));
      QVERIFY(!m_tools->tool().words().isEmpty() && !m_tools->tool().gestures().empty());
    }
    m_tools->activate("hammer");
    QCOMPARE(m_tools->active(), std::string(toolTable().back().id));
  }

  /// Its arms are as long to the eye from near and far, and a drag along one goes just as far in the scene.
  void handlesAreDraggedByRays() {
    m_selection->selectBody("ice");
    m_tools->activate("move");
    const Vector3 before = pivotOf(*m_document->body("ice"));
    Pointer pointer = aimed(before);
    Tool& tool = m_tools->tool();
    tool.hover(pointer);
    const Gizmo gizmo = tool.picture().gizmo->gizmo.value();
    QVERIFY((gizmo.centre - before).norm() < 1e-12);
    const auto tipSeen = [&](double nearer) {
      Pointer from = pointer;
      from.ray.origin = before - nearer * 1.4 * pointer.forward;
      from.ray.direction = pointer.forward;
      const double arm = armOf(from, gizmo.centre);
      const Vector3 across = gizmo.axes.col(0);
      return std::hypot(aimTo(from, gizmo.centre + arm * across)->x, aimTo(from, gizmo.centre + arm * across)->y);
    };
    QVERIFY(std::abs(tipSeen(1) - kGizmoArm) < 1e-6 && std::abs(tipSeen(4) - kGizmoArm) < 1e-6);
    const double arm = armOf(pointer, gizmo.centre);
    const Vector3 grip = gizmo.centre + Vector3(0.8 * arm, 0, 0);
    QVERIFY(tool.press(aimed(grip)));
    QCOMPARE(tool.picture().gizmo->active, (std::optional(GizmoPart{GizmoPart::Kind::Arm, 0})));
    tool.drag(aimed(grip + Vector3(0.11, 0, 0)));
    QVERIFY((pivotOf(*m_document->body("ice")) - before - Vector3(0.11, 0, 0)).norm() < 1e-9);
    Pointer stepped = aimed(grip + Vector3(0.11, 0, 0));
    stepped.control = true;
    tool.drag(stepped);
    QVERIFY((pivotOf(*m_document->body("ice")) - before - Vector3(4 * kSpacing, 0, 0)).norm() < 1e-9);
    QVERIFY(!tool.takesText(QStringLiteral("x")) && tool.takesText(QStringLiteral("4")));
    QVERIFY(tool.cancel());
    QCOMPARE(pivotOf(*m_document->body("ice")), before);
    QCOMPARE(m_document->undoStack().count(), 0);
    m_document->setLocked({{Owner::Body, "ice", ""}}, true);
    QVERIFY(!tool.picture().gizmo->gizmo && tool.picture().gizmo->note.contains(QStringLiteral("locked")));
  }

  /// By the steps that are set, all the time or while a key is held.
  void handlesGoBySteps() {
    m_selection->selectBody("ice");
    m_tools->activate("move");
    const Vector3 before = pivotOf(*m_document->body("ice")), grip = before + Vector3(0.06, 0, 0);
    const auto way = [&](bool key) {
      Tool& tool = m_tools->tool();
      Pointer to = aimed(grip + Vector3(0.043, 0, 0));
      to.control = key;
      if (!tool.press(aimed(grip))) return -1.0;
      tool.drag(to);
      const double gone = (pivotOf(*m_document->body("ice")) - before).x();
      tool.cancel();
      return gone;
    };
    HandleSettings settings;
    const auto set = [&](bool on, double move) {
      settings.snap.on = on;
      settings.snap.move = move;
      m_tools->setHandles(settings);
    };
    QVERIFY(std::abs(way(false) - 0.043) < 1e-9 && std::abs(way(true) - kSpacing) < 1e-9);
    set(true, 0);
    QVERIFY(std::abs(way(false) - kSpacing) < 1e-9 && std::abs(way(true) - 0.043) < 1e-9);
    set(true, 0.01);
    QVERIFY(std::abs(way(false) - 0.04) < 1e-9);
    settings.snap.turn = 45;
    m_tools->setHandles(settings);
    m_tools->activate("rotate");
    const double arm = armOf(aimed(before), before), degree = std::acos(-1.0) / 180;
    const auto onRing = [&](double angle) {  // about y, from z towards x
      return aimed(before + arm * Vector3(std::sin(angle * degree), 0, std::cos(angle * degree)));
    };
    QVERIFY(m_tools->tool().press(onRing(20)));
    QCOMPARE(m_tools->tool().picture().gizmo->active, (std::optional(GizmoPart{GizmoPart::Kind::Ring, 1})));
    m_tools->tool().drag(onRing(70));
    m_tools->tool().release(onRing(70));
    QVERIFY(std::abs(std::get<double>(m_document->value({Owner::Shape, "ice", "rotation_y"})) - 45) < 1e-6);
  }

  /// Onto what is below: another body, and the floor again.
  void movesLandOnWhatIsBelow() {
    m_document->addBody(scenes::block("table", 4, kSpacing, {0.21, 2 * kSpacing, 0}, 263));
    m_selection->selectBody("ice");
    m_tools->activate("move");
    HandleSettings settings;
    settings.snap.on = settings.snap.surfaces = true;
    settings.snap.move = 0.05;
    m_tools->setHandles(settings);
    const Vector3 before = pivotOf(*m_document->body("ice"));
    const auto pull = [&](double far) {
      const Vector3 grip = pivotOf(*m_document->body("ice")) + Vector3(0.06, 0, 0);
      if (!m_tools->tool().press(aimed(grip))) return false;
      m_tools->tool().drag(aimed(grip + Vector3(far, 0, 0)));
      m_tools->tool().release(aimed(grip + Vector3(far, 0, 0)));
      return true;
    };
    QVERIFY(pull(0.2));
    QVERIFY((pivotOf(*m_document->body("ice")) - before - Vector3(0.2, 4 * kSpacing, 0)).norm() < 1e-9);
    QVERIFY(pull(-0.2));
    QVERIFY((pivotOf(*m_document->body("ice")) - before).norm() < 1e-9);
  }

  void aBrushThatFailsIsPutAside_data() {
    QTest::addColumn<QString>("behaviour");
    QTest::addColumn<QString>("words");
    QTest::newRow("throws") << "throwing_brush"
                            << "no more paint";
    QTest::newRow("throws a number") << "odd_brush"
                                     << "no std::exception";
    QTest::newRow("gives a null pointer") << "null_brush"
                                          << "null pointer";
    QTest::newRow("does not come back") << "endless_brush"
                                        << "it does not come back";
  }
  /// At the second sample: what was drawn by then goes with the stroke.
  void aBrushThatFailsIsPutAside() {
    QFETCH(QString, behaviour);
    QFETCH(QString, words);
    withFixture(behaviour);
    connect(m_tools.get(), &Toolbox::brushFailed, this, [this](const QString& brush, const QString& problem) {
      m_fixture->fault(brush.toStdString(), problem.toStdString());
    });
    m_tools->activate("brush");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    QTRY_VERIFY(m_engine->snapshot());
    const size_t particles = m_engine->snapshot()->id.size();
    const SnapshotPtr now = m_engine->snapshot();
    Pointer pointer = aimed({0.15, 0, 0.15}, now);
    m_tools->tool().press(pointer);
    QCOMPARE(refused.count(), 0);
    pointer = aimed({0.2, 0, 0.2}, now);
    pointer.seconds = 0.1;
    m_tools->tool().drag(pointer);
    QTRY_COMPARE(refused.count(), 1);  // the window does not wait for it
    const QString why = refused.front()[1].toString();
    QVERIFY2(why.contains(QStringLiteral("fixture.brush")) && why.contains(words), qPrintable(why));
    m_tools->tool().release(pointer);
    QCOMPARE(m_document->undoStack().count(), 0);
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
    m_engine->reset();
    QTRY_VERIFY(m_engine->snapshot()->revision != now->revision);
    QCOMPARE(m_engine->snapshot()->id.size(), particles);
    QVERIFY(!m_fixture->brush("fixture.brush"));
    QCOMPARE(m_tools->brush().shape, m_fixture->standard(PluginKind::Brush));
    qputenv("PS_LET_GO", "1");  // what it gives now is dropped
    QTRY_VERIFY(ongoingCalls().empty());
    qunsetenv("PS_LET_GO");
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// It is asked how large it is before anything is drawn.
  void aBrushThatDoesNotSayItsSizeIsPutAside() {
    withFixture(QStringLiteral("endless_extent"));
    QSignalSpy failed(m_tools.get(), &Toolbox::brushFailed);
    QCOMPARE(m_tools->stamp().first, Vector3(Vector3::Constant(m_tools->brush().radius)));
    QVERIFY(failed.wait());
    QCOMPARE(failed.front()[0].toString(), QStringLiteral("fixture.brush"));
    QCOMPARE(m_tools->brush().shape, m_fixture->standard(PluginKind::Brush));
    qputenv("PS_LET_GO", "1");
    QTRY_VERIFY(ongoingCalls().empty());
    qunsetenv("PS_LET_GO");
  }

  /// It thinks for as long as it wants to: the pointer goes on, and what it gives comes then.
  void aSlowBrushDoesNotStopTheWindow() {
    withFixture(QStringLiteral("endless_brush"));
    m_tools->activate("brush");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    QTRY_VERIFY(m_engine->snapshot());
    const SnapshotPtr now = m_engine->snapshot();
    Pointer pointer = aimed({0.16, 0, 0.16}, now);
    m_tools->tool().press(pointer);
    for (const double way : {0.05, 0.1, 0.15}) {
      pointer = aimed({0.16 + way, 0, 0.16}, now);
      pointer.seconds = way;
      m_tools->tool().drag(pointer);  // while the brush has not come back
    }
    QTRY_VERIFY(!ongoingCalls().empty());
    qputenv("PS_LET_GO", "1");
    m_tools->tool().release(pointer);
    qunsetenv("PS_LET_GO");
    QCOMPARE(refused.count(), 0);
    QCOMPARE(m_document->undoStack().count(), 1);
    // A cell for each spacing of the way.
    const auto* drawn = std::get_if<VoxelShape>(&m_document->project().bodies.back().shape);
    QVERIFY(drawn);
    QVERIFY(VoxelCanvas(drawn->runs).cells().cells().size() >= static_cast<size_t>(std::lround(0.15 / kSpacing)));
  }

  /// It draws beside the ice and not beyond, and so it does when the sketch is drawn again from its strokes.
  void aBrushSeesTheMatterWithinItsReach() {
    withFixture(QStringLiteral("seeing_brush"));
    BrushSettings brush = m_tools->brush();
    brush.drawOn = DrawOn::Level;
    brush.planeAt = 0.03;
    brush.temperature = 263;  // as cold as what it goes by, and yet its own stroke is none of that
    m_tools->setBrush(brush);
    m_tools->activate("brush");
    QTRY_VERIFY(m_engine->snapshot());
    const double side = 2.5 * kSpacing;  // of the ice
    const Vector3 begin(0.003, brush.planeAt, side + kSpacing);
    m_tools->tool().press(aimed(begin, m_engine->snapshot()));
    for (int k = 1; k <= 20; ++k) {
      Pointer pointer = aimed(begin + Vector3(0.02 * k, 0, 0), m_engine->snapshot());
      pointer.seconds = 0.02 * k;
      m_tools->tool().drag(pointer);
    }
    m_tools->tool().release(aimed(begin, m_engine->snapshot()));
    QCOMPARE(m_document->undoStack().count(), 1);
    const Body& body = m_document->project().bodies.back();
    const auto& drawn = std::get<VoxelShape>(body.shape);
    const CellSet cells = VoxelCanvas(drawn.runs).cells();
    double farthest = 0;
    for (const api::Cell& cell : cells.cells()) farthest = std::max(farthest, gridOf(drawn).centreOf(cell).x());
    // The last particle of the ice stands half a spacing within its side; a cell's middle is half a spacing off.
    QVERIFY2(farthest > side && farthest < side + 2 * kSpacing, qPrintable(QString::number(farthest)));
    const VoxelShape again = redrawnIn(m_document->project(), body.id, drawn, kSpacing, *m_fixture);
    QVERIFY(VoxelCanvas(again.runs).cells() == cells);
    // Where space repeats itself every 0.45 m, the end of the stroke, 0.4 m away, lies beside the ice as well.
    Project periodic = m_document->project();
    periodic.environment.periodic[0] = true;
    periodic.environment.boundsMinimum.x() = -0.03, periodic.environment.boundsMaximum.x() = 0.42;
    const VoxelShape both = redrawnIn(periodic, body.id, drawn, kSpacing, *m_fixture);
    QVERIFY(VoxelCanvas(both.runs).size() > cells.size());
  }

  /// The last sample waits for the end of the stroke: what fails there is told as well.
  void aBrushThatFailsAtTheEndIsTold() {
    withFixture(QStringLiteral("throwing_brush"));
    m_tools->activate("brush");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    QTRY_VERIFY(m_engine->snapshot());
    const SnapshotPtr now = m_engine->snapshot();
    Pointer pointer = aimed({0.15, 0, 0.15}, now);
    m_tools->tool().press(pointer);
    pointer = aimed({0.15 + 1e-4, 0, 0.15}, now);  // less than a sample's way
    pointer.seconds = 0.1;
    m_tools->tool().drag(pointer);
    QVERIFY2(refused.isEmpty(), qPrintable(refused.value(0).value(1).toString()));
    m_tools->tool().release(pointer);
    QCOMPARE(refused.count(), 1);
    QVERIFY(refused.front()[1].toString().contains(QStringLiteral("no more paint")));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  void theBrushIsTheStandardOneAndEachIsReached() {
    QCOMPARE(m_tools->brush().shape, m_plugins->standard(PluginKind::Brush));
    std::set<std::string> seen;
    for (size_t i = 0; i < m_plugins->ids(PluginKind::Brush).size(); ++i) {
      seen.insert(m_tools->brush().shape);
      m_tools->stepShape(1);
    }
    QCOMPARE(seen.size(), m_plugins->ids(PluginKind::Brush).size());
    QCOMPARE(m_tools->brush().shape, m_plugins->standard(PluginKind::Brush));
  }

  void theCursorIsTheBrushsOwn() {
    setBrush("sphere");
    QVERIFY(!m_tools->stamp().second);
    QCOMPARE(m_tools->stamp().first.x(), 0.05);
    setBrush("cube", "rotation", M_PI / 4);
    QVERIFY(m_tools->stamp().second);
    // Turned by 45 degrees, a cube is wider by the root of two.
    QVERIFY(std::abs(m_tools->stamp().first.x() - 0.05 * std::sqrt(2)) < 1e-12);
    QVERIFY(std::abs(m_tools->stamp().first.y() - 0.05) < 1e-12);
  }

  void aStrokeKeepsTheBrushsParameters() {
    setBrush("cube", "rotation", M_PI / 4);
    m_tools->activate(kBrushTool);
    Tool& tool = m_tools->tool();
    tool.hover(aimed({0.1, 0, 0.15}));
    QVERIFY(tool.picture().cursor && tool.picture().cursor->box && !tool.picture().cursor->erase);
    QVERIFY(tool.press(aimed({0.1, 0, 0.15})));
    tool.drag(aimed({0.14, 0, 0.15}));
    tool.release(aimed({0.14, 0, 0.15}));
    QCOMPARE(m_document->undoStack().count(), 1);
    QCOMPARE(m_document->project().bodies.size(), size_t{2});
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies.back().shape);
    QCOMPARE(voxels.strokes.size(), size_t{1});
    QCOMPARE(voxels.strokes[0].brush, std::string("cube"));
    QCOMPARE(std::get<double>(voxels.strokes[0].parameters.values.at("rotation")), M_PI / 4);
    // Drawn again from what was saved, the same cells come.
    const SketchGrid grid{voxels.origin, voxels.spacing};
    const StrokeEdits again = replayStroke(*m_plugins->brush("cube"), voxels.strokes[0], grid);
    size_t cells = 0;
    for (const VoxelShape::Run& run : voxels.runs) cells += static_cast<size_t>(run.length);
    QCOMPARE(again.added.size(), cells);
    m_document->undoStack().undo();
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
  }

  void strokesLieOnAPlaneInTheAir() {
    setBrush("particle");
    setGuide("draw_on", std::string("level"));
    setGuide("plane_at", 0.31);
    draw({{0.1, 0.31, 0.1}, {0.2, 0.31, 0.1}});
    const auto& drawn = sketch();
    for (const VoxelShape::Run& run : drawn.runs) QCOMPARE(run.y, int(std::floor(0.31 / kSpacing)));
    QCOMPARE(drawn.strokes[0].up, Vector3(0, 1, 0));  // seen from above
    // From below the horizon no level plane is met: nothing is drawn, and nothing is said.
    Pointer up = aimed({0.1, 0.31, 0.1});
    up.ray.direction.y() = std::abs(up.ray.direction.y());
    m_tools->tool().hover(up);
    QVERIFY(!m_tools->tool().picture().cursor);
    setGuide("draw_on", std::string("across_z"));
    setGuide("plane_at", 0.05);
    draw({{0.1, 0.2, 0.05}, {0.1, 0.3, 0.05}});
    for (const VoxelShape::Run& run : sketch().runs) QCOMPARE(run.z, 1);
    QCOMPARE(sketch().strokes[0].up, Vector3(0, 0, 1));
  }

  void shiftDrawsStraight() {
    setBrush("particle");
    setGuide("draw_on", std::string("level"));
    setGuide("plane_at", 0.3);
    m_tools->activate(kBrushTool);
    Tool& tool = m_tools->tool();
    const auto held = [](const Vector3& place) {
      Pointer pointer = aimed(place);
      pointer.shift = true;
      return pointer;
    };
    QVERIFY(tool.press(held({0, 0.3, 0})));
    for (int k = 1; k <= 20; ++k) tool.drag(held({0.012 * k, 0.3, 0.02 * std::sin(k)}));
    tool.release(held({0.24, 0.3, 0}));
    for (const VoxelShape::Run& run : sketch().runs) QCOMPARE(run.z, 0);
    QVERIFY(sketch().runs[0].length >= 8);
  }

  void aSteadyHandTrailsBehind() {
    setBrush("particle");
    setGuide("draw_on", std::string("level"));
    setGuide("steady", 0.1);
    draw({{0, 0, 0}, {0.05, 0, 0.05}, {0.3, 0, 0}});
    const auto& samples = sketch().strokes[0].samples;
    QCOMPARE(samples[1][0], samples[0][0]);             // the line was slack
    QVERIFY(std::abs(samples.back()[0] - 0.2) < 1e-9);  // 0.1 m behind
    QVERIFY(std::abs(samples.back()[2]) < 1e-9);        // and nothing of the tremor
  }

  void aMirrorDrawsBothSidesAndIsKept() {
    setBrush("sphere");
    setGuide("mirror", std::string("x"));
    draw({{0.2, 0, 0.15}, {0.2, 0, 0.2}});
    const auto& shape = sketch();
    QVERIFY(shape.strokes[0].symmetry && shape.strokes[0].symmetry->mirror == "x");
    int left = 0, right = 0;
    for (const VoxelShape::Run& run : shape.runs) (run.x < 0 ? left : right) += run.length;
    QVERIFY(left > 0);
    QCOMPARE(left, right);
    const StrokeEdits again =
        replayStroke(*m_plugins->brush("sphere"), shape.strokes[0], {shape.origin, shape.spacing});
    QCOMPARE(int(again.added.size()), left + right);
    QVERIFY(!guideLines(m_tools->brush(), m_document->project().environment).empty());
    m_document->undoStack().undo();
    QCOMPARE(m_document->project().bodies.size(), size_t{1});
  }

  /// What is drawn apart can be selected and moved by itself; a stroke that begins on another one goes on with it.
  void strokesApartAreBodiesOfTheirOwn() {
    setBrush("particle");
    draw({{0.1, 0, 0.15}, {0.14, 0, 0.15}});
    draw({{-0.1, 0, 0.15}, {-0.14, 0, 0.15}});
    const std::vector<Body>& bodies = m_document->project().bodies;
    QCOMPARE(bodies.size(), size_t{3});
    QVERIFY(bodies[1].id != bodies[2].id && bodies[1].name != bodies[2].name);
    const auto scene = std::make_shared<Snapshot>();
    scene->bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{bodies[1].id});
    scene->spacing = kSpacing;
    const auto& first = std::get<VoxelShape>(bodies[1].shape);
    const VoxelShape::Run run = first.runs[0];
    const Vector3 centre = SketchGrid{first.origin, first.spacing}.centreOf({run.x, run.y, run.z});
    scene->position = {{float(centre.x()), float(centre.y()), float(centre.z()), float(kSpacing / 2)}};
    scene->body = {0};
    scene->motion = {api::Motion::Liquid};
    scene->id = {1};
    draw({centre, centre + Vector3(0, 0, 0.1)}, scene);
    QCOMPARE(bodies.size(), size_t{3});
    QCOMPARE(std::get<VoxelShape>(bodies[1].shape).strokes.size(), size_t{2});
    // Where it has moved away from, another one begins.
    scene->position[0].y += 0.3F;
    draw({centre + Vector3(0, 0.3, 0), centre + Vector3(0, 0.3, 0.1)}, scene);
    QCOMPARE(bodies.size(), size_t{4});
  }

  /// A stroke that begins on a sketch that was turned goes on with it, on its lattice, and lands where the hand was.
  void strokesGoOnWithWhatWasTurned() {
    setBrush("particle");
    draw({{0.1, 0, 0.15}, {0.14, 0, 0.15}});
    const std::vector<Body>& bodies = m_document->project().bodies;
    Placement turned;
    turned.bodies.push_back(
        moved(bodies[1], {Quaternion(Eigen::AngleAxisd(0.6, Vector3(1, 2, 0.5).normalized())), {0.02, 0.3, 0.01}}));
    m_document->place(turned, {});
    const VoxelShape before = sketch();
    const SketchGrid grid = gridOf(before);
    const Vector3 centre = grid.centreOf({before.runs[0].x, before.runs[0].y, before.runs[0].z});
    const auto scene = std::make_shared<Snapshot>();
    scene->bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{bodies[1].id});
    scene->spacing = kSpacing;
    scene->position = {{float(centre.x()), float(centre.y()), float(centre.z()), float(kSpacing / 2)}};
    scene->body = {0};
    scene->motion = {api::Motion::Liquid};
    scene->id = {1};
    setGuide("draw_on", std::string("level"));
    setGuide("plane_at", centre.y());
    const Vector3 end = centre + Vector3(0.05, 0, 0.1);
    draw({centre, end}, scene);
    QCOMPARE(bodies.size(), size_t{2});
    const VoxelShape& after = sketch();
    QCOMPARE(after.strokes.size(), size_t{2});
    QVERIFY(after.origin == before.origin && after.rotation == before.rotation && after.shift == before.shift);
    // Each new cell holds a point of the hand's way; so the farthest are half a cell's diagonal from it.
    const Vector3 along = (end - centre).normalized();
    CellSet added = VoxelCanvas(after.runs).cells();
    added.remove(VoxelCanvas(before.runs).cells().cells());
    QVERIFY(added.size() >= 5);
    double farthest = 0;
    for (const api::Cell& cell : added.cells()) {
      const Vector3 away = grid.centreOf(cell) - centre;
      const double far = std::clamp(along.dot(away), 0.0, (end - centre).norm());
      QVERIFY((away - far * along).norm() <= std::sqrt(3) / 2 * kSpacing + 1e-9);
      farthest = std::max(farthest, far);
    }
    QVERIFY((end - centre).norm() - farthest < kSpacing);
    // Drawn again from what is saved, the same cells come.
    const StrokeEdits again =
        replayStroke(*m_plugins->brush("particle"), after.strokes[1], {after.origin, after.spacing});
    CellSet missing = added;
    missing.remove(again.added.cells());
    QVERIFY(missing.empty());
    // What is drawn in a mirror stands along the scene: it is a body of its own.
    setGuide("mirror", std::string("x"));
    draw({centre, end}, scene);
    QCOMPARE(bodies.size(), size_t{3});
  }

  /// Bodies that are begun join the group of what is selected, as one step; a stroke that goes on with one does not.
  void strokesJoinTheGroupThatIsSelected() {
    setBrush("particle");
    draw({{0.1, 0, 0.15}, {0.14, 0, 0.15}});
    const std::string first = m_document->project().bodies.back().id;
    const std::string group = m_document->addGroup({"body/" + first});
    m_selection->selectBody(first);
    const int steps = m_document->undoStack().index();
    draw({{-0.1, 0, 0.15}, {-0.14, 0, 0.15}});
    const std::string second = m_document->project().bodies.back().id;
    QVERIFY(first != second);
    QCOMPARE(m_document->undoStack().index(), steps + 1);
    QCOMPARE(m_document->order().groups.size(), size_t{1});
    QCOMPARE(m_document->order().groups[0].members, (std::vector<std::string>{"body/" + first, "body/" + second}));
    m_document->undoStack().undo();
    QVERIFY(!m_document->body(second));
    QCOMPARE(m_document->order().groups[0].members, (std::vector<std::string>{"body/" + first}));
    m_document->undoStack().redo();
    QCOMPARE(m_document->order().groups[0].members.size(), size_t{2});
    m_selection->selectBody("ice");  // which is in none
    draw({{-0.1, 0, -0.15}, {-0.14, 0, -0.15}});
    QCOMPARE(m_document->order().groups[0].members.size(), size_t{2});
  }

  /// On the floor, along an axis with Shift; it changes nothing, and Esc takes it away.
  void aRulerTellsLengths() {
    m_tools->activate("ruler");
    Tool& tool = m_tools->tool();
    QVERIFY(tool.press(aimed({-0.1, 0, 0.25})));
    Pointer to = aimed({0.2, 0, 0.21});
    tool.drag(to);
    tool.release(to);
    ToolPicture picture = tool.picture();
    QVERIFY(picture.tag && picture.wires.size() == 2);
    QVERIFY2(picture.tag->value.contains(lengthText(std::hypot(0.3, 0.04))), qPrintable(picture.tag->value));
    QVERIFY(picture.tag->value.contains(QStringLiteral("x ") + lengthText(0.3)));
    QVERIFY(picture.tag->value.contains(QStringLiteral("z ") + lengthText(0.04)));
    QVERIFY(!picture.tag->value.contains(QStringLiteral("ΔT")));
    to.shift = true;
    tool.press(aimed({-0.1, 0, 0.25}));
    tool.drag(to);
    tool.release(to);
    picture = tool.picture();
    QVERIFY((picture.tag->place - Vector3(0.2, 0, 0.25)).norm() < 1e-9);
    QCOMPARE(picture.tag->value, lengthText(0.3));
    QCOMPARE(picture.wires.size(), size_t{1});
    QVERIFY(tool.words().contains(lengthText(0.3)));
    // Between matter it says how much warmer it is.
    const auto scene = std::make_shared<Snapshot>();
    scene->spacing = kSpacing;
    for (int k = 0; k < 2; ++k) {
      scene->position.push_back({0.2F * float(k), 0.4F, 0, float(kSpacing)});
      scene->temperature.push_back(300.0F + 25.0F * float(k));
      scene->body.push_back(0);
      scene->motion.push_back(api::Motion::Liquid);
      scene->id.push_back(uint32_t(k));
    }
    tool.press(aimed({0, 0.4, 0}, scene));
    tool.drag(aimed({0.2, 0.4, 0}, scene));
    tool.release(aimed({0.2, 0.4, 0}, scene));
    QVERIFY2(tool.picture().tag->value.contains(QStringLiteral("ΔT 25 K")), qPrintable(tool.picture().tag->value));
    QVERIFY(tool.cancel() && !tool.picture().tag && !tool.cancel());
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// Its shadow lies on the matter below it, and on the floor beside that.
  void theCursorsShadowLiesOnWhatIsBelow() {
    const auto scene = std::make_shared<Snapshot>();
    scene->spacing = kSpacing;
    for (int k = 0; k < 8; ++k) scene->position.push_back({0.1F + 0.03F * float(k), 0.3F, 0, float(kSpacing / 2)});
    setBrush("sphere");
    m_tools->activate(kBrushTool);
    Tool& tool = m_tools->tool();
    tool.hover(aimed({0.19, 0.3, 0}, scene));
    const BrushCursor above = *tool.picture().cursor;
    QVERIFY2(std::abs(above.floor - 0.3 - kSpacing / 2) < 0.01, qPrintable(QString::number(above.floor)));
    QVERIFY(above.centre.y() > above.floor);
    tool.hover(aimed({-0.2, 0, 0}, scene));
    QCOMPARE(tool.picture().cursor->floor, 0.0);
    tool.press(aimed({0.19, 0.3, 0}, scene));
    QCOMPARE(tool.picture().cursor->floor, above.floor);
    tool.drag(aimed({-0.2, 0.3, 0}, scene));  // and past its end
    QCOMPARE(tool.picture().cursor->floor, 0.0);
    tool.cancel();
  }

  /// A sweep that begins beside the matter takes what comes under it, at its depth and not below its own hole.
  void anEraserTakesWhatIsUnderIt() {
    const auto scene = std::make_shared<Snapshot>();
    scene->bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"ice"});
    scene->spacing = kSpacing;
    for (int k = 0; k < 8; ++k) {
      scene->position.push_back({0.1F + 0.03F * float(k), 0.3F, 0, float(kSpacing / 2)});
      scene->body.push_back(0);
      scene->motion.push_back(api::Motion::Liquid);
      scene->id.push_back(uint32_t(k));
    }
    setBrush("sphere");
    m_tools->activate("erase");
    Tool& tool = m_tools->tool();
    tool.press(aimed({-0.1, 0, 0}, scene));  // on the floor
    tool.drag(aimed({0.1, 0.3, 0}, scene));
    const auto shown = [&] { return tool.picture().cursor->centre; };
    QVERIFY(std::abs(shown().y() - 0.31) < 0.02);  // on the row's surface
    const auto rest = std::make_shared<Snapshot>(*scene);
    rest->position.erase(rest->position.begin(), rest->position.begin() + 4);
    rest->body.resize(4);
    tool.drag(aimed({0.13, 0.3, 0}, rest));  // where it has just erased
    QVERIFY(std::abs(shown().y() - 0.31) < 0.02);
    tool.release(aimed({0.13, 0.3, 0}, rest));
  }

  void pressureReachesTheBrush() {
    setBrush("sphere");
    m_tools->activate(kBrushTool);
    Pointer light = aimed({0.1, 0, 0.15});
    light.pressure = 0.2;
    m_tools->tool().press(light);
    m_tools->tool().release(light);
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies.back().shape);
    QCOMPARE(voxels.strokes[0].samples[0][3], 0.2);
  }

  void aStrokeCanBeGivenUp() {
    setBrush("sphere");
    m_tools->activate(kBrushTool);
    m_tools->tool().press(aimed({0.1, 0, 0.15}));
    QVERIFY(m_tools->tool().cancel());
    QVERIFY(!m_tools->tool().cancel());
    m_tools->tool().release(aimed({0.1, 0, 0.15}));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  void controlTurnsABrushIntoAnEraser() {
    setBrush("sphere");
    Pointer pointer = aimed({0.1, 0, 0.15});
    pointer.control = true;
    m_tools->activate(kBrushTool);
    m_tools->tool().hover(pointer);
    QVERIFY(m_tools->tool().picture().cursor->erase);
    m_tools->activate("erase");
    m_tools->tool().hover(pointer);
    QVERIFY(!m_tools->tool().picture().cursor->erase);
  }

  void aBrushThatIsNotThereSaysSo() {
    setBrush("org.example.gone");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    m_tools->activate(kBrushTool);
    m_tools->tool().press(aimed({0.1, 0, 0.15}));
    QCOMPARE(refused.count(), 1);
    QVERIFY(refused[0][1].toString().contains(QStringLiteral("org.example.gone")));
    QCOMPARE(m_document->undoStack().count(), 0);
  }

  /// It is installed, and failed: its button says what it said, and what to do.
  void aBrushThatWasPutAsideSaysSo() {
    PluginRegistry plugins;
    m_document->setPlugins(&plugins);
    setBrush("cube");
    plugins.fault("cube", "no more paint");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    m_tools->activate(kBrushTool);
    m_tools->tool().press(aimed({0.1, 0, 0.15}));
    QCOMPARE(refused.count(), 1);
    const QString why = refused[0][1].toString();
    QVERIFY2(why.contains(QStringLiteral("is put aside")) && why.contains(QStringLiteral("no more paint")) &&
                 why.contains(QStringLiteral("until the program starts again")),
             qPrintable(why));
    QVERIFY(!why.contains(QStringLiteral("not installed")));
    cleanup();  // the plugins go before the document does
  }

  void aTapIsPlacedOnWhatIsUnderTheRay() {
    m_tools->activate("tap");
    m_tools->tool().hover(aimed({0.1, 0, 0.1}));
    QCOMPARE(m_tools->tool().picture().emitters.size(), size_t{1});
    m_tools->tool().press(aimed({0.1, 0, 0.1}));
    m_tools->tool().release(aimed({0.1, 0, 0.1}));
    QCOMPARE(m_document->project().emitters.size(), size_t{1});
    const Emitter& tap = m_document->project().emitters.front();
    QVERIFY((tap.point - Vector3(0.1, kSpacing / 2, 0.1)).norm() < 1e-12);
    QCOMPARE(tap.direction.y(), 1.0);
    QCOMPARE(m_tools->active(), std::string(kSelectTool));
    QCOMPARE(m_selection->port(), (Port{false, tap.id}));
    m_document->undoStack().undo();
    QVERIFY(!m_selection->port());  // what is gone is not selected
  }

  void aTapThatIsDraggedUpPoursDown() {
    m_tools->activate("tap");
    m_tools->tool().press(aimed({0.1, 0, 0.1}));
    m_tools->tool().drag(aimed({0.1, 0.2, 0.1}));
    m_tools->tool().release(aimed({0.1, 0.2, 0.1}));
    const Emitter& tap = m_document->project().emitters.front();
    QVERIFY((tap.point - Vector3(0.1, 0.2, 0.1)).norm() < 1e-9);
    QCOMPARE(tap.direction.y(), -1.0);
  }

  void aDrainGrowsWithTheDrag() {
    m_tools->activate("drain");
    m_tools->tool().press(aimed({0, 0, 0.1}));
    m_tools->tool().drag(aimed({0.2, 0, 0.1}));
    m_tools->tool().release(aimed({0.2, 0, 0.1}));
    const Sink& drain = m_document->project().sinks.front();
    QVERIFY(std::abs(drain.maximum.x() - drain.minimum.x() - 0.4) < 1e-9);
    QVERIFY(std::abs(drain.minimum.y()) < 1e-12);
  }

  void aHandleMovesInOneStepAndBack() {
    Emitter tap;
    tap.id = "tap";
    tap.material = "water";
    tap.point = Vector3(0, 0.3, 0);
    m_document->addEmitter(tap);
    const int steps = m_document->undoStack().count();
    m_tools->activate(kSelectTool);
    Tool& tool = m_tools->tool();
    tool.hover(aimed(tap.point));
    QCOMPARE(tool.picture().pointer, PointerShape::Move);
    QVERIFY(tool.press(aimed(tap.point)));
    tool.drag(aimed({0.1, 0.3, 0}));
    tool.drag(aimed({0.15, 0.3, 0}));
    QVERIFY(std::abs(m_document->project().emitters[0].point.x() - 0.15) < 1e-9);
    QVERIFY(tool.cancel());
    QVERIFY((m_document->project().emitters[0].point - tap.point).norm() < 1e-12);
    QCOMPARE(m_document->undoStack().count(), steps);
    QVERIFY(tool.press(aimed(tap.point)));
    tool.drag(aimed({0.15, 0.3, 0}));
    tool.release(aimed({0.15, 0.3, 0}));
    QCOMPARE(m_document->undoStack().count(), steps + 1);
    // Where there is no handle, nothing is taken, and the view may turn.
    QVERIFY(!tool.press(aimed({-0.3, 0, 0.3})) && tool.turnsView());
  }

  void aClickSelectsWhatTheRayHits() {
    const auto scene = std::make_shared<Snapshot>();
    scene->bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"ice"});
    scene->revision = 7;
    scene->position = {{0, 0, 0, 0.02F}};
    scene->body = {0};
    scene->motion = {api::Motion::Liquid};
    scene->id = {42};
    m_tools->tool().click(aimed({0, 0, 0}, scene));
    QCOMPARE(m_selection->body(), std::string("ice"));
    QCOMPARE(m_selection->marked(), (std::pair<uint64_t, uint32_t>{7, 42}));
    m_tools->tool().click(aimed({0.2, 0, 0}, scene));  // the floor
    QVERIFY(!m_selection->marked());
    QVERIFY(m_selection->items().size() == 1 && m_selection->items().front().kind == OutlineKind::Wall);
    m_tools->tool().click(aimed({0.2, 2, 0}, scene));  // the sky
    QVERIFY(m_selection->empty() && !m_selection->marked());
  }

 private:
  /// A brush that behaves so, in hand.
  void withFixture(const QString& behaviour) {
    m_fixture = fixtureNamed(behaviour, QStringLiteral("fixture_brush.so"));
    m_document->setPlugins(m_fixture.get());
    BrushSettings brush = m_tools->brush();
    brush.shape = "fixture.brush";
    m_tools->setBrush(brush);
  }
  void setGuide(const std::string& key, const Value& value) {
    BrushSettings brush = m_tools->brush();
    setValueOf(brush, key, value);
    QCOMPARE(valuesOf(brush).values.at(key), value);
    m_tools->setBrush(brush);
  }
  /// One stroke along places.
  void draw(const std::vector<Vector3>& places, const SnapshotPtr& scene = nullptr) {
    m_tools->activate(kBrushTool);
    QVERIFY(m_tools->tool().press(aimed(places.front(), scene)));
    for (size_t k = 1; k < places.size(); ++k) m_tools->tool().drag(aimed(places[k], scene));
    m_tools->tool().release(aimed(places.back(), scene));
  }
  const VoxelShape& sketch() const { return std::get<VoxelShape>(m_document->project().bodies.back().shape); }
  void setBrush(const std::string& shape, const std::string& key = {}, double value = 0) {
    BrushSettings brush = m_tools->brush();
    brush.shape = shape;
    brush.radius = 0.05;
    brush.temperature = 293.15;
    if (!key.empty()) brush.parameters[shape].values[key] = value;
    m_tools->setBrush(brush);
  }

  std::unique_ptr<PluginRegistry> m_fixture;  ///< with which the document goes on
};

QTEST_GUILESS_MAIN(TestTools)
#include "tst_tools.moc"
