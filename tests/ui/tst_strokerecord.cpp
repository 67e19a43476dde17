// SPDX-License-Identifier: Apache-2.0
// What strokes change in a document: cells added, carved, and taken to another spacing.
#include "core/geometry/solidfill.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/sketch/cellset.h"
#include "tests/shared/scenes.h"
#include "ui/document/document.h"

#include <QtTest/QTest>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

Project smallScene() { return scenes::iceOnPlate(5, 370); }

std::vector<std::array<int, 3>> cube(int side, int x, int y, int z) {
  std::vector<std::array<int, 3>> cells;
  cells.reserve(static_cast<size_t>(side * side * side));
  for (int k = 0; k < side * side * side; ++k)
    cells.push_back({x + k % side, y + k / side % side, z + k / side / side});
  return cells;
}

VoxelShape lattice() {
  VoxelShape shape;
  shape.origin = {0.015, 0.015, 0.015};
  shape.spacing = 0.03;
  return shape;
}

Body drops() {
  Body body;
  body.id = body.name = "drops";
  body.material = "water";
  VoxelShape voxels = lattice();
  voxels.palette.push_back({"water", 293.15, {}});
  body.shape = voxels;
  return body;
}

int cellCount(const Body& body) {
  int cells = 0;
  for (const VoxelShape::Run& run : std::get<VoxelShape>(body.shape).runs) cells += run.length;
  return cells;
}

}  // namespace

class TestStrokeRecord : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }

  void carvingAtTheStartStays() {
    Project project = smallScene();
    const Body box = project.bodies[0];
    const auto first = eraseEdit(box, 0, lattice(), cube(3, -1, 0, -1));
    QVERIFY(first && std::holds_alternative<BodyEdit>(*first));  // a box becomes cells
    applyEdits(project, {*first}, true);
    const int left = cellCount(project.bodies[0]);
    QVERIFY(left < 125 && left >= 125 - 27);
    auto taken = takenCells(*first, 0.03);
    QCOMPARE(taken.size(), size_t{1});
    QCOMPARE(static_cast<int>(taken[0].size()), 125 - left);

    const auto second = eraseEdit(project.bodies[0], 0, lattice(), cube(3, -1, 2, -1));
    QVERIFY(second && std::holds_alternative<CellsEdit>(*second));  // cells lose cells
    applyEdits(project, {*second}, true);
    QVERIFY(cellCount(project.bodies[0]) < left);
    taken = takenCells(*second, 0.03);
    QCOMPARE(static_cast<int>(taken[0].size()), left - cellCount(project.bodies[0]));
    QVERIFY(!eraseEdit(project.bodies[0], 0, lattice(), cube(3, -1, 0, -1)));  // nothing is there any more
    QVERIFY(!eraseEdit(box, 0, lattice(), cube(3, 200, 0, 0)));
    const auto all = eraseEdit(project.bodies[0], 0, lattice(), cube(20, -10, -2, -10));
    QVERIFY(all && !std::get<BodyEdit>(*all).after);

    applyEdits(project, {*second}, false);
    QCOMPARE(cellCount(project.bodies[0]), left);
    applyEdits(project, {*first}, false);
    QVERIFY(std::get<BoxShape>(project.bodies[0].shape) == std::get<BoxShape>(box.shape));
  }

  /// A sketch that is turned loses the cells whose centres lie in what was erased, and keeps where the stroke went on
  /// its own lattice: drawn again there it takes the same place.
  void carvingWhatWasTurned() {
    Body body = drops();
    auto& shape = std::get<VoxelShape>(body.shape);
    CellSet solid;
    std::vector<api::Cell> filled;
    for (const auto& [x, y, z] : cube(6, 0, 0, 0)) filled.push_back({x, y, z});
    solid.add(filled);
    shape.runs = encodeRuns(solid, 0);
    shape.strokes.emplace_back().brush = "sphere";
    const RigidMove move{Quaternion(Eigen::AngleAxisd(0.8, Vector3(1, 1, 0.3).normalized())), {0.1, 0.4, 0}};
    body = moved(body, move);
    const auto& turned = std::get<VoxelShape>(body.shape);
    const SketchGrid grid = gridOf(turned), straight = gridOf(lattice());
    const api::Cell middle = straight.cellAt(grid.centreOf({1, 2, 1}));
    const auto erased = cube(3, middle.x - 1, middle.y - 1, middle.z - 1);
    VoxelShape::Stroke stroke;
    stroke.brush = "sphere";
    stroke.erase = true;
    stroke.up = {0, 0, 1};
    stroke.samples = {{0.1, 0.5, 0.02, 1, 0}};
    stroke.symmetry.emplace().mirror = "x";
    stroke.symmetry->turns = 2;
    const auto edit = eraseEdit(body, 0, lattice(), erased, {stroke});
    QVERIFY(edit);
    const auto& cells = std::get<CellsEdit>(*edit);
    CellSet wanted;
    std::vector<api::Cell> inside;
    for (const auto& [x, y, z] : erased) inside.push_back({x, y, z});
    wanted.add(inside);
    const CellSet taken = VoxelCanvas(cells.cells).cells();
    for (const api::Cell& cell : filled)
      QCOMPARE(taken.contains(cell), wanted.contains(straight.cellAt(grid.centreOf(cell))));
    QVERIFY(taken.size() > 15 && taken.size() < 40);
    QCOMPARE(cells.strokes.size(), size_t{4});  // its copies by symmetry, each by itself
    for (const VoxelShape::Stroke& part : cells.strokes) {
      QVERIFY(!part.symmetry);
      const Vector3 place = move.of({part.samples[0][0], part.samples[0][1], part.samples[0][2]});
      QVERIFY((place.cwiseAbs() - Vector3(0.1, 0.5, 0.02)).norm() < 1e-9);
      QVERIFY((move.turn * part.up - Vector3(0, 0, 1)).norm() < 1e-9 ||
              (move.turn * part.up + Vector3(0, 0, 1)).norm() < 1e-9);
    }
  }

  /// A stroke into a body that is there keeps what it adds, and nothing of the strokes before it.
  void strokesKeepWhatTheyAdd() {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(smallScene(), {});
    Body body = drops();
    VoxelShape::Stroke drawn;
    drawn.samples.resize(1000);
    std::vector<std::string> states{writeProject(document.project())};
    for (int n = 0; n < 4; ++n) {
      auto stroke = std::make_shared<StrokeRecord>();
      stroke->lattice = lattice();
      stroke->body = body.id;
      stroke->cells = cube(3, 2 * n, 12, 0);  // each overlaps the one before by a third
      stroke->edits.push_back(paintEdit(document.project(), body, stroke->cells, 0, drawn));
      if (n > 0) {
        const auto& edit = std::get<CellsEdit>(stroke->edits[0]);
        int cells = 0;
        for (const VoxelShape::Run& run : edit.cells) cells += run.length;
        QCOMPARE(cells, 18);
      }
      document.addStroke(stroke);
      states.push_back(writeProject(document.project()));
    }
    QCOMPARE(cellCount(*document.body("drops")), 27 + 3 * 18);
    QCOMPARE(std::get<VoxelShape>(document.body("drops")->shape).strokes.size(), size_t{4});
    for (size_t n = states.size() - 1; n-- > 0;) {
      document.undoStack().undo();
      QCOMPARE(QString::fromStdString(writeProject(document.project())), QString::fromStdString(states[n]));
    }
    for (size_t n = 1; n < states.size(); ++n) {
      document.undoStack().redo();
      QCOMPARE(QString::fromStdString(writeProject(document.project())), QString::fromStdString(states[n]));
    }
  }

  /// A sketch drawn at 30 mm, carved and counted at 15 mm: eight cells for each.
  void sketchesTakeAnotherSpacing() {
    Body body = drops();
    std::get<VoxelShape>(body.shape).runs = {{0, 0, 0, 2, 0}};
    const Body fine = asVoxels(body, 0.015);
    const auto& voxels = std::get<VoxelShape>(fine.shape);
    QCOMPARE(cellCount(fine), 16);
    QCOMPARE(voxels.spacing, 0.015);
    for (const double x : voxels.origin) QVERIFY(std::abs(x - 0.0075) < 1e-15);  // the corner stays at 0
    VoxelShape eraser = voxels;
    const auto edit = eraseEdit(body, 0, eraser, {{0, 0, 0}});
    QVERIFY(edit);
    QCOMPARE(cellCount(*std::get<BodyEdit>(*edit).after), 15);
  }

  /// A solid that is turned becomes cells along its own axes: those that fill it.
  void turnedSolidsKeepTheirAxes() {
    Body body = drops();
    SolidShape solid;
    for (const auto& [key, value] : {std::pair("size_x", 0.3),
                                     {"size_y", 0.09},
                                     {"size_z", 0.15},
                                     {"rotation_x", 20.0},
                                     {"rotation_z", 30.0},
                                     {"position_x", 0.2},
                                     {"position_y", 0.4}})
      solid.parameters.values[key] = value;
    solid.parameters.values["kind"] = std::string("block");
    body.shape = solid;
    const std::vector<api::Double3> fills = latticePlaces(solid, 0.03);
    const Body cells = asVoxels(body, 0.03);
    const SketchGrid grid = gridOf(std::get<VoxelShape>(cells.shape));
    std::vector<Vector3> centres;
    for (const VoxelShape::Run& run : std::get<VoxelShape>(cells.shape).runs)
      for (int k = 0; k < run.length; ++k) centres.push_back(grid.centreOf({run.x + k, run.y, run.z}));
    QCOMPARE(centres.size(), size_t{150});
    QCOMPARE(fills.size(), centres.size());
    for (size_t i = 0; i < fills.size(); ++i) QVERIFY((vectorOf(fills[i]) - centres[i]).norm() < 1e-12);
    // Painted in part, the rest is what it was.
    VoxelShape here = lattice();
    const auto painted = repaintEdits(body, 0, here, cube(4, 4, 11, -2), "iron");
    QCOMPARE(painted.size(), size_t{2});
    QCOMPARE(cellCount(*std::get<BodyEdit>(painted[0]).after), 150);
    QVERIFY(std::get<VoxelShape>(std::get<BodyEdit>(painted[0]).after->shape).runs ==
            std::get<VoxelShape>(cells.shape).runs);
  }

  /// A box becomes cells first; undo makes it a box again. Of what is of the material already there is nothing to do.
  void paintIsTakenBackToTheLetter() {
    Project project = smallScene();
    const std::string before = writeProject(project);
    const auto edits = repaintEdits(project.bodies[0], 0, lattice(), cube(3, -1, 0, -1), "iron");
    QCOMPARE(edits.size(), size_t{2});
    QVERIFY(std::holds_alternative<BodyEdit>(edits[0]) && std::holds_alternative<RepaintEdit>(edits[1]));
    applyEdits(project, edits, true);
    QCOMPARE(cellCount(project.bodies[0]), 125);
    const std::string once = writeProject(project);
    QVERIFY(repaintEdits(project.bodies[0], 0, lattice(), cube(3, -1, 0, -1), "iron").empty());
    const auto more = repaintEdits(project.bodies[0], 0, lattice(), cube(3, -1, 1, -1), "water");
    QCOMPARE(more.size(), size_t{1});
    QVERIFY(std::get<RepaintEdit>(more[0]).cells.added.empty());  // that entry is there
    QVERIFY(takenCells(more[0], 0.03).empty());
    applyEdits(project, more, true);
    applyEdits(project, more, false);
    QCOMPARE(QString::fromStdString(writeProject(project)), QString::fromStdString(once));
    applyEdits(project, edits, false);
    QCOMPARE(QString::fromStdString(writeProject(project)), QString::fromStdString(before));
    QVERIFY(repaintEdits(project.bodies[0], 0, lattice(), cube(3, 200, 0, 0), "iron").empty());
  }

  void sketchedMatterLeavesRoomForBodies() {
    const Project project = smallScene();
    const auto inside = freeAtStart(project, "new", lattice(), cube(3, -1, 0, -1));
    const auto outside = freeAtStart(project, "new", lattice(), cube(3, 6, 0, 0));
    QVERIFY(inside.empty());
    QCOMPARE(outside.size(), size_t{27});
    QCOMPARE(freeAtStart(project, "ice", lattice(), cube(3, -1, 0, -1)).size(), size_t{27});  // its own matter
    // Cell by cell as by the distances to all centres.
    Project sketched = project;
    Body body = drops();
    std::get<VoxelShape>(body.shape).origin = {0.021, 0.018, 0.012};
    std::get<VoxelShape>(body.shape).runs = {{0, 5, 0, 4, 0}, {-3, 6, 1, 2, 0}};
    sketched.bodies.push_back(body);
    std::vector<std::array<double, 3>> centres;
    for (const Body& other : sketched.bodies) {
      const Body cells = asVoxels(other, 0.03);
      const auto& voxels = std::get<VoxelShape>(cells.shape);
      for (const VoxelShape::Run& run : voxels.runs) {
        for (int k = 0; k < run.length; ++k)
          centres.push_back({voxels.origin[0] + (run.x + k) * 0.03, voxels.origin[1] + run.y * 0.03,
                             voxels.origin[2] + run.z * 0.03});
      }
    }
    const auto all = cube(14, -7, 0, -7);
    std::vector<std::array<int, 3>> expected;
    for (const auto& c : all) {
      const bool taken = std::any_of(centres.begin(), centres.end(), [&](const auto& p) {
        return std::hypot(p[0] - 0.015 - c[0] * 0.03, p[1] - 0.015 - c[1] * 0.03, p[2] - 0.015 - c[2] * 0.03) <
               0.9 * 0.03;
      });
      if (!taken) expected.push_back(c);
    }
    QVERIFY(expected.size() > 100 && expected.size() < all.size() - 100);
    QVERIFY(freeAtStart(sketched, "new", lattice(), all) == expected);
  }

 private:
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_GUILESS_MAIN(TestStrokeRecord)
#include "tst_strokerecord.moc"
