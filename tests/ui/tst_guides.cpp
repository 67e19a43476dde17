// SPDX-License-Identifier: Apache-2.0
// Planes at any pose to draw on, and what strokes snap to.
#include "core/scene/pose.h"
#include "core/sketch/stroke.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/tools/guides.h"
#include "ui/tools/surface.h"

#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <cmath>
#include <numbers>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03, kDegree = std::numbers::pi / 180;

/// A block of matter whose upper side goes through a point across a normal, its lattice along the scene's axes.
SnapshotPtr slope(const Vector3& point, const Vector3& normal) {
  auto scene = std::make_shared<Snapshot>();
  scene->spacing = kSpacing;
  for (int z = -12; z <= 12; ++z) {
    for (int y = -12; y <= 12; ++y) {
      for (int x = -12; x <= 12; ++x) {
        const Vector3 place = point + kSpacing * Vector3(x, y, z);
        if ((place - point).dot(normal) > -kSpacing / 2) continue;
        scene->position.push_back(float4Of(place, static_cast<float>(0.62 * kSpacing)));
        scene->id.push_back(static_cast<uint32_t>(scene->id.size()));
        scene->body.push_back(0);
      }
    }
  }
  return scene;
}

}  // namespace

class TestGuides : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    Project project = scenes::iceOnPlate(3, 370);
    project.environment = scenes::tray(0.6, 1.2);
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
    take("particle", 0.02);
  }
  void cleanup() { close(); }

  void anglesSayTheNormal_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("z");
    QTest::addColumn<double>("tilt");
    QTest::addColumn<double>("heading");
    QTest::newRow("level") << 0.0 << 2.0 << 0.0 << 0.0 << 0.0;
    QTest::newRow("from below") << 0.0 << -1.0 << 0.0 << 180.0 << 0.0;
    QTest::newRow("to the front") << 0.0 << 1.0 << 1.0 << 45.0 << 0.0;
    QTest::newRow("to the right") << 1.0 << 0.0 << 0.0 << 90.0 << 90.0;
    QTest::newRow("to the left, overhanging") << -1.0 << -1.0 << 0.0 << 135.0 << -90.0;
  }
  void anglesSayTheNormal() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, z);
    const FreePlane plane = FreePlane::across({1, 2, 3}, {x, y, z});
    QTEST(plane.tilt / kDegree, "tilt");
    QTEST(plane.heading / kDegree, "heading");
    QVERIFY((plane.normal() - Vector3(x, y, z).normalized()).norm() < 1e-12);
  }

  /// By numbers: strokes lie on it, whichever side is seen, and its grid with them, within the scene.
  void strokesLieOnAPlaneAtAnyPose() {
    set("draw_on", std::string("plane"));
    set("plane_y", 0.4);
    set("plane_tilt", 30 * kDegree);
    set("plane_heading", -20 * kDegree);
    const FreePlane plane = m_tools->brush().plane;
    const Vector3 across = strokeAxes(plane.normal()).col(0), down = strokeAxes(plane.normal()).col(2);
    draw({plane.point, plane.point + 0.2 * across, plane.point + 0.2 * across + 0.1 * down});
    const VoxelShape::Stroke& stroke = sketch().strokes.at(0);
    QVERIFY((stroke.up - plane.normal()).norm() < 1e-12);
    for (const auto& s : stroke.samples)
      QVERIFY(std::abs((Vector3(s[0], s[1], s[2]) - plane.point).dot(plane.normal())) < 1e-9);
    const Environment& environment = m_document->project().environment;
    const std::vector<GuideLine> lines = guideLines(m_tools->brush(), environment);
    QVERIFY(lines.size() > 10);
    for (const GuideLine& line : lines) {
      for (const Vector3& end : {line.from, line.to}) {
        QVERIFY(std::abs((end - plane.point).dot(plane.normal())) < 1e-9);
        QVERIFY(((end - environment.boundsMinimum).array() > -1e-9).all() &&
                ((end - environment.boundsMaximum).array() < 1e-9).all());
      }
    }
    Pointer below = at(plane.point);
    below.ray.origin = plane.point - Vector3(0, 0.3, -0.05);
    below.ray.direction = (plane.point - below.ray.origin).normalized();
    QVERIFY((planeFor(m_tools->brush(), below)->normal + plane.normal()).norm() < 1e-12);
  }

  /// As the matter under the pointer slopes, whatever its lattice, so far above it that the brush stands on it.
  void aPlaneIsLaidOnWhatIsThere_data() {
    QTest::addColumn<double>("tilt");
    QTest::addColumn<double>("heading");
    for (const double tilt : {0.0, 12.0, 30.0, 45.0}) QTest::addRow("%g degrees", tilt) << tilt << 25.0;
  }
  void aPlaneIsLaidOnWhatIsThere() {
    QFETCH(double, tilt);
    QFETCH(double, heading);
    const FreePlane wanted{{0, 0.4, 0}, tilt * kDegree, heading * kDegree};
    Pointer pointer = at(wanted.point);
    pointer.scene = slope(wanted.point, wanted.normal());
    m_tools->activate("select");
    m_tools->layPlane(pointer, false);
    QCOMPARE(m_tools->active(), std::string(kBrushTool));
    const BrushSettings& brush = m_tools->brush();
    QCOMPARE(brush.drawOn, DrawOn::Plane);
    // Steps of a lattice are half a spacing high, over the five spacings that are looked at.
    const double off = std::acos(std::min(1.0, brush.plane.normal().dot(wanted.normal())));
    QVERIFY2(off < 3 * kDegree, qPrintable(QString::number(off / kDegree)));
    const double height = (brush.plane.point - wanted.point).dot(wanted.normal());
    const double half = m_tools->stamp(brush.plane.normal()).first.cwiseProduct(brush.plane.normal()).norm();
    QVERIFY2(std::abs(height - half) < kSpacing, qPrintable(QString::number(height)));
  }

  void aPlaneIsLaidAcrossTheView() {
    Pointer pointer = at({0, 0.3, 0});
    pointer.target = {0.1, 0.2, 0};
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    m_tools->layPlane(pointer, true);
    QVERIFY(refused.count() == 1 && refused[0][1].toString().isEmpty());  // closes what was refused before
    QVERIFY((m_tools->brush().plane.normal() + pointer.forward).norm() < 1e-12);
    QCOMPARE(m_tools->brush().plane.point, pointer.target);
    // It stays when the view turns; in the air there is no surface to lay one on.
    pointer.ray.direction = Vector3(0, 1, -1).normalized();
    m_tools->layPlane(pointer, false);
    QVERIFY(refused.count() == 2 && !refused[1][1].toString().isEmpty());
    QCOMPARE(m_tools->brush().plane.point, pointer.target);
  }

  void placesSnapToTheGrid() {
    set("draw_on", std::string("level"));
    set("plane_at", 0.31);
    set("snap_to", std::string("grid"));
    set("grid", 0.05);
    draw({{0.012, 0.31, 0.02}, {0.063, 0.31, 0.04}, {0.11, 0.31, 0.09}});
    for (const auto& s : sketch().strokes.at(0).samples) {
      for (const size_t a : {0u, 2u}) QVERIFY(std::abs(std::remainder(s[a], 0.05)) < 1e-9);
      QVERIFY(std::abs(s[1] - 0.31) < 1e-9);
    }
    QVERIFY((end(0) - Vector3(0.1, 0.31, 0.1)).norm() < 1e-9);
    QVERIFY(m_tools->tool().words().contains(QStringLiteral("on the grid")));
    QVERIFY(!m_tools->tool().picture().wires.empty());
    // Not while Shift is held.
    Pointer shifted = at({0.012, 0.31, 0.02});
    shifted.shift = true;
    m_tools->tool().hover(shifted);
    QVERIFY((m_tools->tool().picture().cursor->centre - Vector3(0.012, 0.31, 0.02)).norm() < 1e-9);
  }

  /// A stroke begins at the end of an earlier one and ends on its way, seen from anywhere and off its own plane.
  void placesSnapToStrokes() {
    set("draw_on", std::string("level"));
    set("plane_at", 0.3);
    draw({{-0.2, 0.3, 0}, {0.2, 0.3, 0}});
    const Vector3 first = begin(0), last = end(0);
    set("plane_at", 0.1);
    set("snap_to", std::string("ends"));
    set("snap_within", 0.02);
    Pointer near = at(last + Vector3(0, 0.01, 0)), middle = at((first + last) / 2), aside = at({0.1, 0.1, 0.3});
    Tool& tool = m_tools->tool();
    tool.hover(middle);  // no end is near
    QVERIFY(std::abs(tool.picture().cursor->centre.y() - 0.1) < 1e-9);
    tool.hover(near);
    QVERIFY((tool.picture().cursor->centre - last).norm() < 1e-9);
    QVERIFY(tool.words().contains(QStringLiteral("at the end of a stroke")));
    tool.press(near);
    tool.drag(aside);
    set("snap_to", std::string("strokes"));
    tool.drag(middle);
    tool.release(middle);
    const Body& body = m_document->project().bodies.back();
    const VoxelShape::Stroke& second = std::get<VoxelShape>(body.shape).strokes.back();
    QVERIFY((placeOf(second.samples.front()) - last).norm() < 1e-9);
    // From where it began it goes on at that height.
    QVERIFY(std::abs(placeOf(second.samples[1]).y() - last.y()) < 1e-9);
    QVERIFY((placeOf(second.samples.back()) - (first + last) / 2).norm() < 1e-6);
    // Of a body that has been moved, its strokes have too; of a hidden one they are not there.
    BrushSettings brush = m_tools->brush();
    brush.snapTo = SnapTo::Ends;
    Project project = m_document->project();
    project.bodies.resize(2);
    project.bodies[1] = moved(project.bodies[1], {Quaternion(Eigen::AngleAxisd(1, Vector3(0, 1, 0))), {0, 0.1, 0}});
    const RigidMove pose = poseOf(std::get<VoxelShape>(project.bodies[1].shape));
    const auto snap = strokeSnap(brush, project, at(pose.of(last)).ray);
    QVERIFY(snap && snap->end && (snap->place - pose.of(last)).norm() < 1e-6);
    project.bodies[1].visible = false;
    QVERIFY(!strokeSnap(brush, project, at(pose.of(last)).ray));
  }

  /// Favourites and panels go by the declared rows.
  void rowsComeBack() {
    BrushSettings brush = m_tools->brush();
    brush.drawOn = DrawOn::Plane;
    brush.plane = {{0.1, 0.2, -0.3}, 0.5, -1.5};
    brush.snapTo = SnapTo::Ends;
    brush.snapWithin = 0.011;
    brush.grid = 0.02;
    BrushSettings again = m_tools->brush();
    for (const auto& [key, value] : valuesOf(brush).values) setValueOf(again, key, value);
    QVERIFY(again == brush);
  }

 private:
  void set(const std::string& key, const Value& value) {
    BrushSettings brush = m_tools->brush();
    setValueOf(brush, key, value);
    m_tools->setBrush(brush);
  }
  void draw(const std::vector<Vector3>& places) {
    Tool& tool = m_tools->tool();
    QVERIFY(tool.press(at(places.front())));
    for (size_t k = 1; k < places.size(); ++k) tool.drag(at(places[k]));
    tool.release(at(places.back()));
  }
  static Vector3 placeOf(const std::array<double, 8>& sample) { return {sample[0], sample[1], sample[2]}; }
  const VoxelShape& sketch() const { return std::get<VoxelShape>(m_document->project().bodies.back().shape); }
  Vector3 begin(size_t stroke) const { return placeOf(sketch().strokes.at(stroke).samples.front()); }
  Vector3 end(size_t stroke) const { return placeOf(sketch().strokes.at(stroke).samples.back()); }
};

QTEST_GUILESS_MAIN(TestGuides)
#include "tst_guides.moc"
