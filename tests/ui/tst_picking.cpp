// SPDX-License-Identifier: Apache-2.0
// What has no matter is picked where it is seen: walls, and pins, which are put elsewhere by the handles.
#include "core/scene/pose.h"
#include "core/scene/scenewall.h"
#include "core/scene/turnedbox.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/document/wallside.h"
#include "ui/session/selection.h"
#include "ui/tools/aim.h"
#include "ui/tools/arrange.h"
#include "ui/tools/picking.h"
#include "ui/tools/placing.h"
#include "ui/tools/porthandles.h"
#include "ui/tools/selecttool.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <QtTest/QTest>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

using namespace ps;

namespace {

const SelectedItem kRope{OutlineKind::Body, "rope"}, kPin{OutlineKind::Pin, "rope/1"};
const SelectedItem kFloor{OutlineKind::Wall, "floor"}, kSide{OutlineKind::Wall, "side"};

/// From above and in front, at a place of the scene.
Pointer at(const Vector3& place) {
  Pointer pointer;
  pointer.ray.origin = Vector3(0.1, 1, 1);
  pointer.ray.direction = (place - pointer.ray.origin).normalized();
  return pointer;
}

/// A body with two pins over a floor, beside an upright wall.
Project scene() {
  Project project;
  Environment& around = project.environment;
  around.boundsMinimum = Vector3(-0.5, 0, -0.5), around.boundsMaximum = Vector3(0.5, 1, 0.5);
  SceneWall floor, side;
  floor.id = "floor", floor.normal = Vector3(0, 2, 0);
  side.id = "side", side.point = Vector3(-0.5, 0, 0), side.normal = Vector3(1, 0, 0);
  around.walls = {floor, side};
  Body rope;
  rope.id = "rope";
  Region left, right;
  left.minimum = Vector3(-0.3, 0.5, 0), left.maximum = Vector3(-0.2, 0.6, 0.1);
  right.minimum = Vector3(0.2, 0.5, 0), right.maximum = Vector3(0.3, 0.6, 0.1);
  rope.pins = {left, right};
  project.bodies = {rope};
  return project;
}

Body blockAt(const std::string& id, const Vector3& place) {
  Body body;
  body.id = id;
  SolidShape solid;
  solid.parameters.values = {
      {"kind", std::string("block")}, {"position_x", place.x()}, {"position_y", place.y()}, {"position_z", place.z()}};
  body.shape = solid;
  return body;
}

std::optional<SelectedItem> picked(const Project& project, const std::vector<SelectedItem>& selected,
                                   const Vector3& place) {
  const auto pick = pickAt(project, selected, at(place));
  return pick ? std::optional(pick->item) : std::nullopt;
}

}  // namespace

class TestPicking : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    m_document = std::make_unique<Document>();
    m_document->open(scene(), {});
    m_selection = std::make_unique<Selection>(*m_document);
  }

  /// A floor by its face, a side by its edges alone: one looks through it.
  void wallsArePickedAsTheyAreDrawn() {
    const Project project = scene();
    QVERIFY(picked(project, {}, {0.3, 0, 0.2}) == kFloor);
    QVERIFY(!picked(project, {}, {3, 0, 0.2}));
    const Lines edges = wallLines(project.environment, 1);
    QCOMPARE(edges.size(), size_t{4});
    double highest = 0;
    for (const auto& [from, to] : edges) highest = std::max({highest, from.y(), to.y()});
    const Vector3 inside(-0.5, highest / 2, 0);
    QVERIFY(highest > 0 && picked(project, {}, inside) != kSide);
    const auto edge = pickAt(project, {}, at({-0.5, highest / 2, 0.5}));
    QVERIFY(edge && edge->item == kSide && edge->byLine);
  }

  /// A side is picked at what is drawn of its edges: not along the floor, nor where they fade, nor beside them, nor
  /// where matter hides them.
  void sidesArePickedAtWhatIsSeenOfTheirEdges() {
    Project project = scene();
    double highest = 0;
    for (const auto& [from, to] : wallLines(project.environment, 1)) highest = std::max({highest, from.y(), to.y()});
    const auto upright = [](double height) { return Vector3(-0.5, height, 0.5); };
    QVERIFY(picked(project, {}, upright(0.3 * highest)) == kSide);
    QVERIFY(picked(project, {}, upright(0.9 * highest)) != kSide);  // faded
    QVERIFY(picked(project, {}, {-0.5, highest, 0}) != kSide);
    Project alone = project;
    alone.environment.walls = {project.environment.walls[1]};
    QVERIFY(!picked(alone, {}, {-0.5, 0, 0}));
    QVERIFY(picked(alone, {}, upright(0.3 * highest)) == kSide);
    const Vector3 place = upright(0.3 * highest), eye = at(place).ray.origin, way = place - eye;
    const Vector3 right = way.cross(Vector3(0, 1, 0)).normalized();
    const auto beside = [&](double units, const SnapshotPtr& scene) {
      Pointer pointer = at(place + units * at(place).fineness * way.norm() * right);
      pointer.scene = scene;
      const auto pick = pickAt(alone, {}, pointer);
      return pick && pick->item == kSide && pick->byLine;
    };
    QVERIFY(beside(3, nullptr) && beside(-3, nullptr));
    QVERIFY(!beside(6, nullptr) && !beside(-6, nullptr));
    // A ball over the edge, which the ray itself just misses.
    for (const double share : {0.5, 1.5}) {
      auto ball = std::make_shared<Snapshot>();
      ball->spacing = 0.02;
      const Vector3 centre = eye + share * way - 0.0095 * right;
      ball->position = {
          {static_cast<float>(centre.x()), static_cast<float>(centre.y()), static_cast<float>(centre.z()), 0.01f}};
      QCOMPARE(beside(3, ball), share > 1);  // behind it hides nothing
    }
  }

  /// Curved walls by their rings and lines; planes do not end at them, and no plate is looked for.
  void curvedWallsArePickedByTheirLines() {
    Project project = scene();
    const size_t edges = wallLines(project.environment, 0).size();
    for (const char* shape : {"cylinder", "sphere"}) {
      SceneWall wall;
      wall.id = shape, wall.point = Vector3(0, 0.3, 0);
      wall.parameters.values = {{"shape", std::string(shape)}, {"radius", 0.2}};
      project.environment.walls.push_back(wall);
    }
    QCOMPARE(wallLines(project.environment, 0).size(), edges);
    const WallFace pipe = faceOf(project.environment.walls[2]);
    for (const size_t k : {size_t{2}, size_t{3}}) {
      const Lines lines = wallLines(project.environment, k);
      QVERIFY(lines.size() > 40);
      for (const auto& [from, to] : lines)
        QVERIFY(std::abs(faceOf(project.environment.walls[k]).heightOf(from)) < 1e-9 && to.y() > -1e-9);
      const auto pick = pickAt(project, {}, at(lines.back().first));
      QVERIFY(pick && pick->byLine);
      QCOMPARE(pick->item.id, project.environment.walls[k].id);
    }
    QVERIFY(pipe.form() == WallForm::Cylinder && wallLines(project.environment, 2)[0].first.y() == 0);  // on the floor
    QVERIFY(picked(project, {}, {0.3, 0, 0.2}) == kFloor);
    // Planes hide most of one that is around them all; once it is selected, it is shown.
    project.environment.walls[3].parameters.values["radius"] = 2.0;
    QVERIFY(wallLines(project.environment, 3, true).size() > wallLines(project.environment, 3).size());
  }

  /// Added, moved, made wider and turned: a step each, and back.
  void curvedWallsAreAddedAndPlaced() {
    Project things;
    things.environment.walls = {roundWall(WallForm::Cylinder, m_document->project())};
    const SelectedItem pipe{OutlineKind::Wall, m_document->insertThings(things, QStringLiteral("adding")).walls[0].id};
    const auto face = [&] { return faceOf(*m_document->wall(pipe.id)); };
    QVERIFY(face().isInside() && face().form() == WallForm::Cylinder);
    for (const double x : {-0.5, 0.5}) QVERIFY(face().heightOf({x, 0.5, 0.5}) > -1e-9);  // it pushes no body
    const double radius = face().radius();
    const Placeable one = placeable(*m_document, {pipe}, Gizmo::Kind::Scale, {});
    QCOMPARE(one.items.size(), size_t{1});
    QVERIFY(placeable(*m_document, {kFloor}, Gizmo::Kind::Scale, {}).items.empty());
    m_document->place(stretched(placementOf(*m_document, one), {1, 3, 0.5}), QStringLiteral("scaling"));
    QVERIFY(std::abs(face().radius() - radius / 2) < 1e-12);  // along its axis it has no end
    m_document->place(shifted(placementOf(*m_document, one), {0.1, 0, 0}), QStringLiteral("moving"));
    const Quaternion quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3(1, 0, 0)));
    m_document->place(turned(placementOf(*m_document, one), {}, face().centre(), quarter), QStringLiteral("turning"));
    QVERIFY((face().axis() - Vector3(0, 0, 1)).norm() < 1e-12);
    QCOMPARE(m_document->undoStack().count(), 4);
    for (int step = 0; step < 3; ++step) m_document->undoStack().undo();
    QCOMPARE(face().radius(), radius);
    QVERIFY(face().axis() == Vector3(0, 1, 0));
    m_document->undoStack().undo();
    QVERIFY(!m_document->wall(pipe.id));
  }

  /// Pins show while their body is selected, or one of them; they come before a wall behind them.
  void pinsArePickedOfWhatIsSelected() {
    Project project = scene();
    const Vector3 corner = project.bodies[0].pins[1].maximum;
    QVERIFY(picked(project, {}, corner) != kPin);
    QVERIFY(picked(project, {kRope}, corner) == kPin);
    QVERIFY(picked(project, {{OutlineKind::Pin, "rope/0"}}, corner) == kPin);
    project.bodies[0].visible = false;
    QVERIFY(picked(project, {kRope}, corner) != kPin);
  }

  void addressesNamePinsThatAreThere() {
    const Project project = scene();
    QVERIFY(findPin(project, "rope/1") == &project.bodies[0].pins[1]);
    for (const char* none : {"rope/2", "rope", "rope/", "rope/1x", "rope/-1", "cord/0", ""})
      QVERIFY2(!findPin(project, none), none);
  }

  /// One step each, that pin alone; with its body it goes as that does.
  void handlesPutPinsElsewhere() {
    const Region first = pins()[0], second = pins()[1];
    const Placeable one = placeable(*m_document, {kPin}, Gizmo::Kind::Move, {});
    QCOMPARE(one.items.size(), size_t{1});
    QVERIFY((one.middle() - 0.5 * (second.minimum + second.maximum)).norm() < 1e-12);
    m_document->place(shifted(placementOf(*m_document, one), {0, 0.1, 0}), QStringLiteral("moving"));
    QCOMPARE(m_document->undoStack().count(), 1);
    QVERIFY((pins()[1].minimum - second.minimum - Vector3(0, 0.1, 0)).norm() < 1e-12);
    QVERIFY(pins()[0].minimum == first.minimum);
    m_document->undoStack().undo();
    QVERIFY(pins()[1].minimum == second.minimum && pins()[1].maximum == second.maximum);
    m_document->place(stretched(placementOf(*m_document, one), {2, 1, 1}), QStringLiteral("scaling"));
    QVERIFY(std::abs(pins()[1].maximum.x() - pins()[1].minimum.x() - 0.2) < 1e-12);
    QVERIFY(placeable(*m_document, {kPin}, Gizmo::Kind::Rotate, {}).items.empty());
    const Placeable both = placeable(*m_document, {kRope, kPin}, Gizmo::Kind::Move, {});
    QVERIFY(std::none_of(both.items.begin(), both.items.end(),
                         [](const auto& item) { return item.first.kind == OutlineKind::Pin; }));
  }

  /// A drain is turned about its middle and stretched along its own edges; each is one step.
  void drainsAreTurnedAndStretched() {
    Project project = scene();
    Sink drain;
    drain.id = "drain", drain.minimum = Vector3(-0.2, 0, -0.1), drain.maximum = Vector3(0.2, 0.1, 0.1);
    project.sinks = {drain};
    m_document->open(project, {});
    const std::vector<SelectedItem> items{{OutlineKind::Sink, "drain"}};
    const Placeable alone = placeable(*m_document, items, Gizmo::Kind::Rotate, {});
    QVERIFY(alone.items.size() == 1 && alone.note.isEmpty());
    const auto box = [&] { return TurnedBox(*m_document->sink("drain")); };
    const auto turn = [&](double degrees) {
      const Quaternion slope(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vector3(0, 0, 1)));
      const Placement before = placementOf(*m_document, alone);
      m_document->place(turned(before, {}, std::nullopt, slope), QStringLiteral("turning"));
    };
    turn(30);
    QCOMPARE(m_document->undoStack().count(), 1);
    const Vector3 along(std::cos(std::numbers::pi / 6), 0.5, 0);
    QVERIFY(std::abs(std::get<double>(m_document->sink("drain")->parameters.values.at("rotation_z")) - 30) < 1e-9);
    QVERIFY(box().contains(box().middle() + 0.19 * along));
    QVERIFY(!box().contains(box().middle() + Vector3(0.19, 0, 0)));
    const Placeable edges = placeable(*m_document, items, Gizmo::Kind::Scale, {});
    QVERIFY(edges.along && (edges.axes.col(0) - along).norm() < 1e-9);
    m_document->place(stretched(placementOf(*m_document, edges), {2, 1, 1}), QStringLiteral("scaling"));
    QVERIFY((box().size() - Vector3(0.8, 0.1, 0.2)).norm() < 1e-9);
    turn(60);  // it lies along the axes again, to the last digit, and has gone a quarter round all the same
    QVERIFY((box().bounds().size() - Vector3(0.1, 0.8, 0.2)).norm() < 1e-9);
    QVERIFY(m_document->sink("drain")->parameters.values.at("rotation_z") == Value(90.0));
    QVERIFY(box().axes() == (Matrix3() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished());
    turn(270);  // once round
    QVERIFY(!box().isTurned() && !m_document->sink("drain")->parameters.values.contains("rotation_z"));
    while (m_document->undoStack().canUndo()) m_document->undoStack().undo();
    QVERIFY(m_document->sink("drain")->minimum == drain.minimum && !box().isTurned());
  }

  /// By right angles they go on in a circle, as anything that is turned, and not in a line.
  void copiesOfATurnedDrainGoRound() {
    const Quaternion quarter(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3(0, 0, 1)));
    Sink drain;
    drain.id = "drain", drain.minimum = Vector3(-0.2, 0, -0.1), drain.maximum = Vector3(0.2, 0.1, 0.1);
    Placement first;
    first.sinks = {drain};
    Placement before = first, now = shifted(turned(first, {}, std::nullopt, quarter), {0.3, 0.1, 0});
    const auto box = [](const Placement& things) { return TurnedBox(things.sinks.front()); };
    Vector3 way = box(now).middle() - box(before).middle();
    for (int k = 2; k <= 4; ++k) {
      const Placement next = continued(before, now);
      way = quarter * way;
      QVERIFY((box(next).middle() - box(now).middle() - way).norm() < 1e-12);
      QVERIFY((box(next).axes() - quarter * box(now).axes()).norm() < 1e-12);
      before = now, now = next;
    }
    QVERIFY((box(now).middle() - box(first).middle()).norm() < 1e-12 && !box(now).isTurned());
  }

  /// The corner opposite to the one that is dragged stays, of a drain that is turned too.
  void aTurnedDrainIsDraggedByItsCorner() {
    Sink drain;
    drain.minimum = Vector3(-0.2, 0, -0.1), drain.maximum = Vector3(0.2, 0.1, 0.1);
    drain.parameters.values["rotation_z"] = 30.0;
    const Vector3 from = cornerOf(drain, 7), opposite = cornerOf(drain, 0), way(0.05, 0.07, 0.02);
    const Sink larger = dragged(drain, {{true, ""}, PortHandle::Part::Corner, 7, from}, from + way, 0.01);
    QVERIFY((cornerOf(larger, 7) - from - way).norm() < 1e-12 && (cornerOf(larger, 0) - opposite).norm() < 1e-12);
  }

  /// Of a tap that pours down: an arm along its jet does nothing.
  void aMouthIsScaledAcrossItsJet() {
    Project project = scene();
    Emitter tap;
    tap.id = "tap", tap.parameters.values["diameter"] = 0.04;
    project.emitters = {tap};
    m_document->open(project, {});
    const Placeable one = placeable(*m_document, {{OutlineKind::Emitter, "tap"}}, Gizmo::Kind::Scale, {});
    QVERIFY(one.note.isEmpty());
    const auto width = [&](const Vector3& factors) {
      return numberOf(stretched(placementOf(*m_document, one), factors).emitters[0].parameters, emitterParameters(),
                      "diameter");
    };
    QCOMPARE(width({1, 3, 1}), 0.04);
    QCOMPARE(width({2, 1, 1}), 0.08);
    QCOMPARE(width({3, 3, 3}), 0.12);
    QCOMPARE(width({1e9, 1, 1}), findDeclaration(emitterParameters(), "diameter")->hardMaximum);
    m_document->place(stretched(placementOf(*m_document, one), {2, 1, 1}), QStringLiteral("scaling"));
    QCOMPARE(m_document->undoStack().count(), 1);
    m_document->undoStack().undo();
    QCOMPARE(std::get<double>(m_document->emitter("tap")->parameters.values.at("diameter")), 0.04);
  }

  /// Turned and scaled about the middle of all, each about its own, about the last one, or about the scene's origin.
  void handlesGoAboutAPivot() {
    const Vector3 atA(0.1, 0.3, 0), atB(0.3, 0.3, 0);
    Project project = scene();
    project.bodies = {blockAt("a", atA), blockAt("b", atB)};
    m_document->open(project, {});
    const std::vector<SelectedItem> items{{OutlineKind::Body, "a"}, {OutlineKind::Body, "b"}};
    const Placeable both = placeable(*m_document, items, Gizmo::Kind::Rotate, {});
    const Vector3 middle(0.2, 0.3, 0);
    const auto stands = [&](Pivot pivot, const Vector3& at, Gizmo::Kind kind = Gizmo::Kind::Rotate) {
      return (both.centre(kind, pivot) - at).norm() < 1e-12;
    };
    QVERIFY(stands(Pivot::Middle, middle) && stands(Pivot::Each, middle) && stands(Pivot::Last, atB));
    QVERIFY(stands(Pivot::Origin, {0, 0, 0}) && stands(Pivot::Origin, middle, Gizmo::Kind::Move));
    const Placement before = placementOf(*m_document, both);
    const auto are = [](const Placement& things, const Vector3& a, const Vector3& b) {
      return (pivotOf(things.bodies[0]) - a).norm() < 1e-9 && (pivotOf(things.bodies[1]) - b).norm() < 1e-9;
    };
    const Quaternion half(Eigen::AngleAxisd(std::numbers::pi, Vector3(0, 0, 1)));
    QVERIFY(are(turned(before, {}, std::nullopt, half), atA, atB));
    QVERIFY(are(turned(before, {}, middle, half), atB, atA));
    QVERIFY(are(turned(before, {}, atB, half), {0.5, 0.3, 0}, atB));
    QVERIFY(are(stretched(before, {2, 2, 2}), atA, atB));
    const Placement apart = stretched(before, {2, 2, 2}, {}, {middle, Matrix3::Identity()});
    QVERIFY(are(apart, {0, 0.3, 0}, {0.4, 0.3, 0}));
    for (const Body& body : apart.bodies) QVERIFY((boundsOf(body).size() - Vector3::Constant(0.2)).norm() < 1e-9);
    // Sizes and places are one step; what a listener is told carries the matter along.
    std::vector<Vector3> ways;
    const QObject scope;
    QObject::connect(m_document.get(), &Document::changed, &scope, [&](const ChangeEvent& event) {
      const auto* body = std::get_if<BodyChanged>(&event);
      if (body && body->move) ways.push_back(body->move->shift);
    });
    m_document->place(apart, QStringLiteral("scaling"));
    QCOMPARE(ways.size(), size_t{2});
    QVERIFY((ways[0] - Vector3(-0.1, 0, 0)).norm() < 1e-9 && (ways[1] - Vector3(0.1, 0, 0)).norm() < 1e-9);
    QCOMPARE(m_document->undoStack().count(), 1);
    m_document->undoStack().undo();
    for (size_t k = 0; k < 2; ++k) QVERIFY(m_document->project().bodies[k].shape == project.bodies[k].shape);
  }

  /// What a section cuts away is neither clicked nor framed nor drawn on: what lies behind it is.
  void whatIsCutAwayIsNotPicked() {
    auto scene = std::make_shared<Snapshot>();
    scene->spacing = 0.02;
    scene->bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"shell", "rope"});
    for (const uint32_t body : {0u, 1u}) {  // the shell's sheet is nearer
      for (int i = -5; i <= 5; ++i) {
        for (int j = -5; j <= 5; ++j) {
          scene->position.push_back(
              {0.02f * static_cast<float>(i), 0.3f + 0.02f * static_cast<float>(j), body == 0 ? 0.2f : 0.0f, 0.0125f});
          scene->body.push_back(body);
          scene->id.push_back(static_cast<uint32_t>(scene->id.size()));
        }
      }
    }
    Project project = m_document->project();
    Body shell = project.bodies[0];
    shell.id = "shell", shell.pins.clear();
    project.bodies.push_back(shell);
    SceneWall lid;
    lid.id = "lid", lid.point = Vector3(0, 0.6, 0), lid.normal = Vector3(0, -1, 0);
    project.environment.walls.push_back(lid);
    m_document->open(project, {});
    Toolbox tools(*m_document, *m_selection);
    SelectTool tool(tools);
    Pointer pointer;
    pointer.ray = {{0, 0.3, 1}, {0, 0, -1}};
    pointer.scene = scene;
    tool.click(pointer);
    QVERIFY(m_selection->has(OutlineKind::Body, "shell"));
    pointer.section = Section{{Vector3(0, 0, -1), -0.1}};
    tool.click(pointer);
    QVERIFY(m_selection->has(OutlineKind::Body, "rope") && !m_selection->has(OutlineKind::Body, "shell"));
    const auto surface = surfaceUnder(pointer, project.environment);
    QVERIFY(surface && std::abs(surface->point.z() - 0.0125) < 1e-6);
    // Framed: both lie in it, and one of them is shown.
    Pointer from = pointer, to = pointer;
    from.ray.direction = Vector3(-0.3, -0.3, -1).normalized();
    to.ray.direction = Vector3(0.3, 0.3, -1).normalized();
    from.control = to.control = true;
    QVERIFY(tool.press(from));
    tool.drag(to);
    tool.release(to);
    QVERIFY(m_selection->has(OutlineKind::Body, "rope") && !m_selection->has(OutlineKind::Body, "shell"));
    // A lid by its face from below, until it is cut away.
    const SelectedItem kLid{OutlineKind::Wall, "lid"};
    Pointer below;
    below.ray = {{0.3, 0.1, 0.3}, {0, 1, 0}};
    const auto whole = pickAt(project, {}, below);
    QVERIFY(whole && whole->item == kLid);
    below.section = Section{{Vector3(0, -1, 0), -0.5}};
    QVERIFY(!pickAt(project, {}, below));
    // A floor stays.
    Pointer down = at({0.3, 0, 0.2});
    down.section = pointer.section;
    const auto floor = pickAt(project, {}, down);
    QVERIFY(floor && floor->item == kFloor);
  }

  /// A frame takes pins that show, and walls that lie in it as a whole, but not what hands are to leave alone.
  void aFrameTakesWallsAndPins() {
    Project project = scene();
    SceneWall ball;
    ball.id = "ball", ball.point = Vector3(0, 0.4, 0);
    ball.parameters.values = {{"shape", std::string("sphere")}, {"radius", 0.05}, {"matter", std::string("outside")}};
    project.environment.walls.push_back(ball);
    m_document->open(project, {});
    Toolbox tools(*m_document, *m_selection);
    SelectTool tool(tools);
    const auto frame = [&](double reach) {
      Pointer from, to;
      from.ray = {{0, 0.45, 3}, Vector3(-reach, -reach, -1).normalized()};
      to.ray = {{0, 0.45, 3}, Vector3(reach, reach, -1).normalized()};
      from.control = to.control = true;
      QVERIFY(tool.press(from));
      tool.drag(to);
      tool.release(to);
    };
    frame(0.15);
    QVERIFY(m_selection->items() == (std::vector<SelectedItem>{{OutlineKind::Wall, "ball"}}));
    m_selection->select(OutlineKind::Body, "rope");  // its pins show
    frame(0.15);
    QVERIFY(m_selection->has(OutlineKind::Wall, "ball") && m_selection->has(OutlineKind::Pin, "rope/0") &&
            m_selection->has(OutlineKind::Pin, "rope/1") && !m_selection->has(OutlineKind::Wall, "side"));
    frame(0.01);  // the ball does not lie in it as a whole, nor the pins with their middles
    QVERIFY(m_selection->empty());
    frame(0.3);
    QVERIFY(m_selection->has(OutlineKind::Wall, "side"));
    m_document->setLocked({{Owner::Wall, "ball", ""}, {Owner::Body, "rope", ""}}, true);
    m_selection->select(OutlineKind::Body, "rope");
    frame(0.15);
    QVERIFY(m_selection->empty());
  }

  /// Far from the middle of a wide view too its edges are those of the picture.
  void aFrameIsUprightAtTheEdgeOfAWideView() {
    const Vector3 eye(0, 0.45, 3);
    Project project = scene();
    const auto add = [&](const char* id, double x, double y) {
      const Vector3 place = eye + Vector3(x, y, -1), half = Vector3::Constant(0.001);
      Probe probe;
      probe.id = id, probe.quantity = "temperature", probe.region = Region{place - half, place + half};
      project.probes.push_back(probe);
    };
    add("in", 0.82, 0.18), add("above", 0.82, 0.21), add("left", 0.79, 0.18), add("right", 1.18, -0.19);
    m_document->open(project, {});
    Toolbox tools(*m_document, *m_selection);
    SelectTool tool(tools);
    const std::vector<SelectedItem> both{{OutlineKind::Probe, "in"}, {OutlineKind::Probe, "right"}};
    for (const bool back : {false, true}) {
      Pointer from, to;
      from.ray = {eye, Vector3(0.8, -0.2, -1).normalized()};
      to.ray = {eye, Vector3(1.2, 0.2, -1).normalized()};
      if (back) std::swap(from.ray, to.ray);
      from.control = to.control = true;
      QVERIFY(tool.press(from));
      tool.drag(to);
      tool.release(to);
      QVERIFY(m_selection->items() == both);
    }
    // Straight down, where forward says hardly which way the view is turned.
    Pointer down;
    down.ray.origin = Vector3(0, 2, 0);
    down.forward = Vector3(-1e-17, -1, 0);  // turned by a quarter: right is -z
    const auto seen = inPicture(down, Vector3(0, 0, -1));
    QVERIFY(seen && std::abs(seen->x - 0.5) < 1e-12 && std::abs(seen->y) < 1e-12);
  }

  /// Nor is a tap in front of the section, unless it is the one that is selected.
  void aTapThatIsCutAwayIsNotTakenHoldOf() {
    Emitter tap;
    tap.id = "tap", tap.point = Vector3(0, 0.3, 0.2);
    const std::vector<Emitter> taps{tap};
    Pointer pointer;
    pointer.ray = {{0, 0.3, 1}, {0, 0, -1}};
    PortSet ports{&taps, nullptr, {}};
    QVERIFY(handleAt(ports, pointer));
    ports.section = Section{{Vector3(0, 0, -1), -0.1}};
    QVERIFY(!handleAt(ports, pointer));
    ports.selected = Port{false, "tap"};
    QVERIFY(handleAt(ports, pointer));
    ports.selected.reset();
    ports.section = Section{{Vector3(0, 0, 1), 0.1}};
    QVERIFY(handleAt(ports, pointer));
  }

  /// What is hidden or locked is looked through, and hands leave what is locked where it is.
  void whatIsHiddenOrLockedIsNotPicked() {
    Project project = scene();
    const Vector3 onFloor(0.3, 0, 0.2);
    SceneWall& floor = project.environment.walls[0];
    floor.locked = true;
    QVERIFY(!picked(project, {}, onFloor));
    floor.locked = floor.visible = false;
    QVERIFY(!picked(project, {}, onFloor));
    floor.visible = true;
    QVERIFY(picked(project, {}, onFloor) == kFloor);
    std::vector<Emitter> taps(1);
    taps[0].id = "tap", taps[0].point = Vector3(0, 0.3, 0.2);
    Pointer pointer;
    pointer.ray = {{0, 0.3, 1}, {0, 0, -1}};
    const PortSet ports{&taps, nullptr, {}};
    QVERIFY(handleAt(ports, pointer));
    taps[0].locked = true;
    QVERIFY(!handleAt(ports, pointer));
    taps[0].locked = taps[0].visible = false;
    QVERIFY(!handleAt(ports, pointer));
    const Address wall{Owner::Wall, "floor", ""};
    m_document->setLocked({wall, {Owner::Body, "rope", ""}, {Owner::Sink, "gone", ""}}, true);
    QCOMPARE(m_document->undoStack().undoText(), QStringLiteral("locking 2 things"));
    const Placeable held = placeable(*m_document, {kFloor, kPin}, Gizmo::Kind::Move, {});
    QVERIFY(held.items.empty() && held.note.contains(QStringLiteral("locked")));
    m_document->undoStack().undo();
    QVERIFY(!m_document->marks(wall)->locked);
    QCOMPARE(placeable(*m_document, {kFloor, kPin}, Gizmo::Kind::Move, {}).items.size(), size_t{2});
  }

  /// By the tool: a click on a floor selects it, on nothing nothing; what is selected is outlined.
  void aClickSelects() {
    Toolbox tools(*m_document, *m_selection);
    SelectTool tool(tools);
    tool.click(at({0.3, 0, 0.2}));
    QVERIFY(m_selection->has(OutlineKind::Wall, "floor"));
    QCOMPARE(tool.picture().wires.size(), size_t{1});
    QVERIFY(tool.picture().wires[0].selected);
    m_selection->select(OutlineKind::Body, "rope");
    QCOMPARE(tool.picture().wires.size(), size_t{2});
    Pointer adding = at(pins()[1].maximum);
    tool.hover(adding);
    QVERIFY(tool.picture().wires[1].hovered && !tool.picture().wires[0].hovered);
    tool.click(adding);
    QVERIFY(m_selection->has(OutlineKind::Pin, "rope/1") && !m_selection->has(OutlineKind::Body, "rope"));
    tool.click(at({3, 0, 0.2}));
    QVERIFY(m_selection->empty());
    // Matter of a body that is locked is nothing to hands.
    auto matter = std::make_shared<Snapshot>();
    matter->position = {{0.3f, 0.5f, 0.2f, 1e-6f}};
    matter->body = {0};
    matter->id = {0};
    matter->material = {0};
    matter->bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"rope"});
    Pointer above = at({0.3, 0.5, 0.2});
    above.scene = matter;
    tool.click(above);
    QVERIFY(m_selection->has(OutlineKind::Body, "rope"));
    m_document->setLocked({{Owner::Body, "rope", ""}}, true);
    tool.click(above);
    QVERIFY(!m_selection->has(OutlineKind::Body, "rope"));
    m_document->undoStack().undo();
  }

  /// By its edges, in a frame, and by the handles; a probe of matter wherever it is has no place.
  void boxesOfProbesArePickedAndPlaced() {
    const SelectedItem kBox{OutlineKind::Probe, "box"};
    const Vector3 low(0.1, 0.2, 0), high(0.3, 0.4, 0.2), middle = 0.5 * (low + high);
    Project project = scene();
    Probe box, matter;
    box.id = "box", box.quantity = "temperature", box.region = Region{low, high};
    matter.id = "matter", matter.quantity = "temperature";
    project.probes = {matter, box};
    QVERIFY(picked(project, {}, high) == kBox);
    QVERIFY(picked(project, {}, middle) != kBox);
    m_document->open(project, {});
    Toolbox tools(*m_document, *m_selection);
    SelectTool tool(tools);
    tool.hover(at(high));
    QCOMPARE(tool.picture().wires.size(), size_t{1});
    QVERIFY(tool.picture().wires[0].hovered && tool.picture().wires[0].dashed);
    tool.click(at(high));
    QVERIFY(m_selection->items() == std::vector<SelectedItem>{kBox});
    QVERIFY(tool.picture().wires[0].selected);
    Pointer from, to;
    from.ray = to.ray = {{0, 0.3, 1}, {0, 0, -1}};
    from.ray.direction = Vector3(-0.3, -0.3, -1).normalized();
    to.ray.direction = Vector3(0.3, 0.3, -1).normalized();
    from.control = to.control = true;
    m_selection->clear();
    QVERIFY(tool.press(from));
    tool.drag(to);
    tool.release(to);
    QVERIFY(m_selection->items() == std::vector<SelectedItem>{kBox});
    const auto region = [&] { return *m_document->probe("box")->region; };
    tools.activate("scale");
    QVERIFY(tools.tool().press(at(middle)));
    QVERIFY(tools.tool().type(QStringLiteral("2")) && tools.tool().type(QString::fromLatin1(kEnter)));
    QVERIFY((region().maximum - region().minimum - 2 * (high - low)).norm() < 1e-12);
    QVERIFY((0.5 * (region().maximum + region().minimum) - middle).norm() < 1e-12);
    tools.activate("move");
    QVERIFY(tools.tool().press(at(middle + Vector3(0.06, 0, 0))));
    QVERIFY(tools.tool().type(QStringLiteral("0.05")) && tools.tool().type(QString::fromLatin1(kEnter)));
    QVERIFY((0.5 * (region().maximum + region().minimum) - middle - Vector3(0.05, 0, 0)).norm() < 1e-12);
    QCOMPARE(m_document->undoStack().count(), 2);
    m_document->undoStack().undo();
    m_document->undoStack().undo();
    QVERIFY(region().minimum == low && region().maximum == high);
  }

  /// On matter a box is taken only by an edge that the pointer is on; in the air from somewhat farther.
  void aBoxWithinABodyIsTakenByItsEdgeAlone() {
    Project project = scene();
    Probe box;
    box.id = "box", box.quantity = "temperature", box.region = Region{{0.1, 0.2, 0}, {0.3, 0.4, 0.2}};
    project.probes = {box};
    const Vector3 place(0.1, 0.3, 0.2), eye = at(place).ray.origin, way = place - eye;  // on an upright edge
    auto body = std::make_shared<Snapshot>();
    body->spacing = 0.2;
    const Vector3 centre = eye + 0.5 * way;
    body->position = {
        {static_cast<float>(centre.x()), static_cast<float>(centre.y()), static_cast<float>(centre.z()), 0.1f}};
    const auto takes = [&](double units, const SnapshotPtr& matter) {
      const Vector3 right = way.cross(Vector3(0, 1, 0)).normalized();
      Pointer pointer = at(place - units * at(place).fineness * way.norm() * right);
      pointer.scene = matter;
      const auto pick = pickAt(project, {}, pointer);
      return pick && pick->item == SelectedItem{OutlineKind::Probe, "box"};
    };
    QVERIFY(takes(1, nullptr) && takes(6, nullptr) && !takes(9, nullptr));
    QVERIFY(takes(1, body) && !takes(6, body));
  }

 private:
  const std::vector<Region>& pins() const { return m_document->project().bodies[0].pins; }
  std::unique_ptr<Document> m_document;
  std::unique_ptr<Selection> m_selection;
};

QTEST_GUILESS_MAIN(TestPicking)
#include "tst_picking.moc"
