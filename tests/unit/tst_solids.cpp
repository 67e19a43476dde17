// SPDX-License-Identifier: Apache-2.0
// Solids: their volumes against formulas, how lattices fill them, meshes and what they wind around, and their files.
#include "core/base/parallel.h"
#include "core/geometry/meshrepair.h"
#include "core/geometry/meshwinding.h"
#include "core/geometry/solidfacets.h"
#include "core/geometry/solidfill.h"
#include "core/geometry/solidpacking.h"
#include "core/geometry/solidsurface.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/engine.h"
#include "core/simulation/filling.h"
#include "core/solver/solver.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace ps;

namespace {

constexpr double kPi = std::numbers::pi;

SolidShape solidOf(const char* kind, const Vector3& size, double wall = 0.04) {
  SolidShape solid;
  auto& values = solid.parameters.values;
  values["kind"] = std::string(kind);
  values["size_x"] = size[0], values["size_y"] = size[1], values["size_z"] = size[2];
  values["wall"] = wall;
  return solid;
}

/// A ball of radius 0.1 m, of so many rings of triangles; `open`: without its upper half.
SceneMesh ballMesh(int rings, bool open = false) {
  SceneMesh mesh;
  mesh.id = "ball";
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double u = kPi * i / rings, v = 2 * kPi * j / around;
      mesh.points.push_back({static_cast<float>(0.1 * std::sin(u) * std::cos(v)),
                             static_cast<float>(-0.1 * std::cos(u)),
                             static_cast<float>(0.1 * std::sin(u) * std::sin(v))});
    }
  }
  for (int i = 0; i < (open ? rings / 2 : rings); ++i) {
    for (int j = 0; j < around; ++j) {
      const auto at = [&](int row, int column) { return static_cast<uint32_t>(row * around + column % around); };
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

SolidShape meshSolid(SceneMesh mesh, const Vector3& size) {
  SolidShape solid = solidOf("mesh", size);
  solid.meshId = mesh.id;
  solid.mesh = std::make_shared<const SceneMesh>(std::move(mesh));
  return solid;
}

double filled(const SolidShape& solid, double spacing) {
  const SolidMatter matter = solidMatter(solid, spacing, false);
  return static_cast<double>(matter.places.size()) * matter.volume;
}

std::vector<Vector3> latticeOf(const SolidShape& solid, double spacing) {
  std::vector<Vector3> places;
  for (const api::Double3& p : latticePlaces(solid, spacing)) places.push_back(vectorOf(p));
  return places;
}

Project projectOf(const SolidShape& solid, double spacing) {
  Project project;
  SceneMaterial water;
  water.id = water.base = "water";
  project.materials.push_back(water);
  Body body;
  body.id = "solid";
  body.material = "water";
  body.shape = solid;
  project.bodies.push_back(body);
  project.solver.parameters.values["particle_spacing"] = spacing;
  return project;
}

}  // namespace

class TstSolids : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void volumesAreThoseOfFormulas_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<double>("x");  // m, sizes
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("z");
    QTest::addColumn<double>("volume");  // m3
    const auto row = [](const char* kind, double x, double y, double z, double volume) {
      QTest::newRow(kind) << QString(kind) << x << y << z << volume;
    };
    row("block", 0.1, 0.2, 0.3, 0.006);
    row("ellipsoid", 0.2, 0.2, 0.2, 4.0 / 3 * kPi * 1e-3);
    row("cylinder", 0.2, 0.3, 0.1, kPi / 4 * 0.2 * 0.3 * 0.1);
    row("cone", 0.2, 0.3, 0.2, kPi / 3 * 0.01 * 0.3);
    row("capsule", 0.1, 0.3, 0.1, kPi * 0.0025 * 0.2 + 4.0 / 3 * kPi * 0.05 * 0.05 * 0.05);
    row("torus", 0.5, 0.1, 0.5, 2 * kPi * kPi * 0.2 * 0.05 * 0.05);
    row("tube", 0.2, 0.3, 0.2, kPi * (0.01 - 0.0036) * 0.3);
    row("bowl", 0.2, 0.1, 0.2, 2 * kPi / 3 * (1e-3 - 0.06 * 0.06 * 0.06));
  }
  void volumesAreThoseOfFormulas() {
    QFETCH(QString, kind);
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, z);
    QFETCH(double, volume);
    const SolidShape solid = solidOf(kind.toLatin1(), {x, y, z});
    const double told = SolidForm(solid).volume();
    QVERIFY2(std::abs(told / volume - 1) < 1e-9, qPrintable(QString::number(told / volume, 'g', 12)));
    // The lattice is stretched until it has the solid's volume, up to rounding, and hardly so where it is fine: some
    // forty cells lie across, and the surface's share of them, at random, is a few thousandths.
    const double spacing = std::cbrt(volume) / 40, share = filled(solid, spacing) / volume;
    QVERIFY2(std::abs(share - 1) < 1e-9, qPrintable(QString::number(share, 'g', 12)));
    QVERIFY((fillSolid(solid, spacing).stretch - Vector3(1, 1, 1)).cwiseAbs().maxCoeff() < 0.005);
  }

  /// Whatever the lattice, what it fills is symmetrical, and few cells need less than three hundredths of stretch.
  void smallSolidsHaveTheRightVolume() {
    for (const double cells : {5.0, 6.5, 8.0, 11.0}) {
      const SolidShape ball = solidOf("ellipsoid", Vector3::Constant(0.1));
      const double share = filled(ball, 0.1 / cells) / SolidForm(ball).volume();
      QVERIFY2(std::abs(share - 1) < 1e-9, qPrintable(QString::number(share, 'g', 12)));
      QVERIFY(std::abs(fillSolid(ball, 0.1 / cells).stretch[0] - 1) < 0.03);
      Vector3 sum;
      for (const api::Double3& p : latticePlaces(ball, 0.1 / cells)) sum += vectorOf(p);
      QVERIFY(sum.norm() < 1e-9);
    }
    QCOMPARE(fillSolid(solidOf("torus", {0.01, 0.001, 0.01}), 0.1).cells.size(), size_t{1});  // never nothing
  }

  /// Blocks have whole layers, which are stretched along each axis on its own, as far as bonds allow.
  void blocksHaveTheRightVolume() {
    const SolidCells exact = fillSolid(solidOf("block", {0.1, 0.057, 0.104}), 0.01);
    QVERIFY((exact.stretch - Vector3(1, 0.95, 1.04)).norm() < 1e-9);
    QCOMPARE(exact.cells.size(), size_t{600});
    QCOMPARE(fillSolid(solidOf("block", {0.1, 0.002, 0.1}), 0.01).stretch[1], 0.9);
    QCOMPARE(fillSolid(solidOf("block", {0.1, 0.014, 0.1}), 0.01).stretch[1], 1.12);
  }

  /// Ten cells across, with a wall of one, two or three of them: the volume is right, and its middle where a formula
  /// has it.
  void smallBowlsHaveTheRightVolume() {
    constexpr double kSpacing = 0.01, kRadius = 5 * kSpacing;
    for (const double wall : {0.01, 0.02, 0.03}) {
      for (const char* fill : {"lattice", "relaxed"}) {
        SolidShape bowl = solidOf("bowl", {2 * kRadius, kRadius, 2 * kRadius}, wall);
        bowl.parameters.values["fill"] = std::string(fill);
        const double inner = kRadius - wall, cubes = std::pow(kRadius, 3) - std::pow(inner, 3);
        const double share = filled(bowl, kSpacing) / (2 * kPi / 3 * cubes);
        QVERIFY2(std::abs(share - 1) < 5e-3, qPrintable(QString("%1 %2: %3").arg(wall).arg(fill).arg(share)));
        const Vector3 middle = SolidForm(bowl).centroid();
        const double wanted = kRadius / 2 - 3.0 / 8 * (std::pow(kRadius, 4) - std::pow(inner, 4)) / cubes;
        QVERIFY((middle - Vector3(0, wanted, 0)).norm() < 1e-12);
        Vector3 sum;
        const std::vector<api::Double3> places = solidMatter(bowl, kSpacing, false).places;
        for (const api::Double3& p : places) sum += vectorOf(p) / static_cast<double>(places.size());
        QVERIFY2((sum - SolidForm(bowl).toScene(middle)).norm() < 0.3 * kSpacing, qPrintable(QString::number(sum[1])));
      }
    }
    // A wall as thick as half its width leaves no room: half a ball.
    const SolidForm full(solidOf("bowl", {0.1, 0.05, 0.1}, 0.05));
    QVERIFY(std::abs(full.volume() / (2 * kPi / 3 * std::pow(0.05, 3)) - 1) < 1e-12);
    QVERIFY(full.holds({0, 0.02, 0}) && !full.holds({0.04, -0.02, 0}));
  }

  /// The distance is that along the normal to the surface, and grows as fast as one goes along it.
  void surfacesAreTrue_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<double>("x");  // m, sizes
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("z");
    const auto row = [](const char* name, const char* kind, double x, double y, double z) {
      QTest::newRow(name) << QString(kind) << x << y << z;
    };
    row("block", "block", 0.1, 0.2, 0.15);
    row("ball", "ellipsoid", 0.2, 0.2, 0.2);
    row("ellipsoid", "ellipsoid", 0.2, 0.05, 0.12);
    row("cylinder", "cylinder", 0.2, 0.1, 0.2);
    row("cone", "cone", 0.2, 0.3, 0.2);
    row("capsule", "capsule", 0.1, 0.3, 0.1);
    row("low capsule", "capsule", 0.2, 0.1, 0.15);
    row("torus", "torus", 0.2, 0.05, 0.2);
    row("tube", "tube", 0.2, 0.1, 0.2);
    row("bowl", "bowl", 0.2, 0.1, 0.2);
    row("deep bowl", "bowl", 0.16, 0.18, 0.16);
    row("bowl without room", "bowl", 0.2, 0.02, 0.2);
    row("oval bowl", "bowl", 0.2, 0.08, 0.15);
    row("oval cylinder", "cylinder", 0.2, 0.1, 0.12);
    row("oval cone", "cone", 0.12, 0.2, 0.2);
    row("oval capsule", "capsule", 0.1, 0.3, 0.16);
    row("oval torus", "torus", 0.2, 0.04, 0.12);
    row("oval tube", "tube", 0.2, 0.1, 0.15);
    row("mesh", "mesh", 0.2, 0.1, 0.15);
  }
  void surfacesAreTrue() {
    QFETCH(QString, kind);
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, z);
    SolidShape solid = solidOf(kind.toLatin1(), {x, y, z}, 0.02);
    if (kind == "mesh") solid = meshSolid(ballMesh(24), {x, y, z});
    const SolidSurface surface(solid);
    const SolidInside inside(solid);
    constexpr double kStep = 1e-6, kFacets = 1e-4;
    const MeshNearest facets(facetsOf(solid, kFacets));
    int creases = 0;
    for (int k = 0; k < 500; ++k) {
      const double r = 0.2 * (k + 0.5) / 500, a = 2.4 * k, h = std::cos(1.7 * k);
      const Vector3 p = r * Vector3(std::sqrt(1 - h * h) * std::cos(a), h, std::sqrt(1 - h * h) * std::sin(a));
      const SolidSurface::Near near = surface.at(p);
      QCOMPARE(near.distance < 0, inside.holds(p));
      QVERIFY(std::abs(near.normal.norm() - 1) < 1e-9);
      // Facets lie within their error of it, and where the surface has facets itself, of those.
      const MeshNearest::Hit hit = facets.at(p);
      const double toFacet = std::sqrt(hit.squared);
      QVERIFY2(std::abs(toFacet - std::abs(near.distance)) < 3 * kFacets, qPrintable(QString::number(toFacet)));
      if (toFacet > 3 * kFacets) QCOMPARE((p - hit.place).dot(hit.normal) < 0, near.distance < 0);
      // There it is on the surface.
      QVERIFY(std::abs(surface.at(p - near.distance * near.normal).distance) < 1e-8);
      const double rise = (surface.at(p + kStep * near.normal).distance - near.distance) / kStep;
      creases += std::abs(rise - 1) < 1e-3 ? 0 : 1;  // where two sides are as near
    }
    QVERIFY2(creases <= 2, qPrintable(QString::number(creases)));
  }

  /// A hollow mesh is its surface, one particle thick: about as many particles as cells of its area, each within half a
  /// spacing of it, and no gap that a particle goes through. Open meshes are so too.
  void hollowMeshesAreTheirSurface_data() {
    QTest::addColumn<bool>("open");
    QTest::addColumn<double>("turn");
    QTest::newRow("ball") << false << 0.0;
    QTest::newRow("half a ball") << true << 0.0;
    QTest::newRow("half a ball, turned") << true << 35.0;
  }
  void hollowMeshesAreTheirSurface() {
    QFETCH(bool, open);
    QFETCH(double, turn);
    constexpr double kSpacing = 0.01, kRadius = 0.1;
    SolidShape solid = meshSolid(ballMesh(48, open), {0.2, 0.2, 0.2});
    solid.parameters.values["inside"] = std::string("hollow");
    solid.parameters.values["rotation_z"] = turn;
    QVERIFY(!isPacked(solid, true));
    const SolidForm form(solid);
    const double area = (open ? 2 : 4) * kPi * kRadius * kRadius;
    QVERIFY(std::abs(form.volume(kSpacing) / (area * kSpacing) - 1) < 0.005);  // facets are within the ball
    const Vector3 centre = form.middle();
    const std::vector<api::Double3> places = solidMatter(solid, kSpacing, false).places;
    QVERIFY(std::abs(static_cast<double>(places.size()) * kSpacing * kSpacing / area - 1) < 0.15);
    for (const api::Double3& place : places) {
      const double out = (vectorOf(place) - centre).norm();
      QVERIFY2(std::abs(out - kRadius) < 0.52 * kSpacing, qPrintable(QString::number(out)));
    }
    for (int k = 0; k < 2000; ++k) {  // places on the surface, evenly
      const double h = (k + 0.5) / 2000, y = open ? -h : 1 - 2 * h, a = 2.399963 * k, r = std::sqrt(1 - y * y);
      if (open && h < 0.1) continue;  // the rim
      const Vector3 at = centre + form.axes() * (kRadius * Vector3(r * std::cos(a), y, r * std::sin(a)));
      double nearest = 1;
      for (const api::Double3& place : places) nearest = std::min(nearest, (vectorOf(place) - at).norm());
      QVERIFY2(nearest < kSpacing, qPrintable(QString::number(nearest)));
    }
    // What brushes and counts go by, without a layer, is what it encloses.
    QVERIFY(SolidInside(solid).holds({0, -0.01, 0}));
    QVERIFY(!SolidInside(solid, kSpacing).holds({0, 0.02, 0}));
  }

  /// A packed solid has the lattice's matter, all of it inside, nobody too near to another, and it hugs the surface: of
  /// a lattice the outermost particles lie anywhere between the surface and a spacing below it.
  void packingHugsTheSurface_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<double>("y");  // m
    QTest::newRow("ball") << QString("ellipsoid") << 0.1;
    QTest::newRow("cylinder") << QString("cylinder") << 0.1;
    QTest::newRow("pointed cone") << QString("cone") << 0.2;
    QTest::newRow("ring") << QString("torus") << 0.04;
    QTest::newRow("bowl") << QString("bowl") << 0.05;
    QTest::newRow("mesh") << QString("mesh") << 0.1;
  }
  void packingHugsTheSurface() {
    QFETCH(QString, kind);
    QFETCH(double, y);
    constexpr double kSpacing = 0.01;
    SolidShape solid = solidOf(kind.toLatin1(), {0.1, y, 0.1}, 0.02);
    if (kind == "mesh") solid = meshSolid(ballMesh(24), {0.1, y, 0.1});
    const SolidMatter loose = solidMatter(solid, kSpacing, false), held = solidMatter(solid, kSpacing, true);
    QVERIFY(!loose.packed && held.packed);  // automatic packs what other solids slide on
    const size_t count = loose.places.size();
    solid.parameters.values["fill"] = std::string("relaxed");
    const auto pack = [&](int threads) {
      setThreadCount(threads);
      return packSolid(SolidSurface(solid), latticeOf(solid, kSpacing), std::pow(kSpacing, 3));
    };
    const std::vector<Vector3> packed = pack(1), again = pack(4);
    setThreadCount(0);
    QCOMPARE(packed.size(), count);
    QVERIFY(packed == again);
    const SolidSurface surface(solid);
    double outermost = 1, sum = 0;  // spacings below the surface
    int skin = 0;
    for (size_t i = 0; i < packed.size(); ++i) {
      const double depth = -surface.at(packed[i]).distance / kSpacing;
      outermost = std::min(outermost, depth);
      if (depth < 0.75) sum += depth, ++skin;
      for (size_t j = 0; j < i; ++j) QVERIFY((packed[i] - packed[j]).norm() > 0.45 * kSpacing);
    }
    QVERIFY2(outermost > 0, qPrintable(QString::number(outermost)));
    QVERIFY2(std::abs(sum / skin - 0.45) < 0.1, qPrintable(QString::number(sum / skin)));
    QCOMPARE(held.places.size(), count);
    QCOMPARE(solidMatter(solid, kSpacing, false).places.size(), count);
  }

  void sheetsAndRopesAreOneParticleThick() {
    constexpr double kSpacing = 0.01;
    SolidShape sheet = solidOf("sheet", {0.1, 0.3, 0.204});
    sheet.parameters.values["rotation_x"] = 90.0;
    sheet.parameters.values["held"] = std::string("start");
    const SolidMatter cloth = solidMatter(sheet, kSpacing, false);
    QCOMPARE(cloth.places.size(), size_t{200});
    QVERIFY(std::abs(200 * cloth.volume / (0.1 * 0.204 * kSpacing) - 1) < 1e-9);
    for (const api::Double3& p : cloth.places) QVERIFY(std::abs(p.z) < 1e-12);  // it stands
    SolidShape rope = solidOf("rope", {0.1, 0.01, 0.1});
    auto& values = rope.parameters.values;
    values["points"] = 3.0;
    values["point_3_x"] = 0.1, values["point_3_y"] = -0.154;
    values["position_y"] = 0.5;
    values["held"] = std::string("ends");
    const std::vector<api::Double3> line = solidMatter(rope, kSpacing, false).places;
    QCOMPARE(line.size(), size_t{36});  // 35 steps of 0.354 m
    QVERIFY((vectorOf(line.front()) - Vector3(-0.1, 0.5, 0)).norm() < 1e-9);
    QVERIFY((vectorOf(line.back()) - Vector3(0.1, 0.346, 0)).norm() < 1e-9);
    for (size_t k = 1; k < line.size(); ++k)  // across the bend it is nearer
      QVERIFY((vectorOf(line[k]) - vectorOf(line[k - 1])).norm() < 1.12 * kSpacing);
    PluginRegistry plugins;
    for (const auto& [solid, held] : {std::pair(sheet, 10), std::pair(rope, 2)}) {
      const Engine engine(projectOf(solid, kSpacing), plugins);
      const ParticleStore& store = engine.solver().particles();
      QCOMPARE(std::count(store.motion(), store.motion() + store.size(), api::Motion::Static), held);
      QVERIFY(std::abs(fillingOf(projectOf(solid, kSpacing).bodies[0], kSpacing).filled /
                           (particleCount(projectOf(solid, kSpacing).bodies[0], kSpacing) * std::pow(kSpacing, 3)) -
                       1) < 0.03);
    }
  }

  void aTurnedSolidIsTheSameMatterElsewhere() {
    SolidShape solid = solidOf("cone", {0.1, 0.3, 0.1});
    const std::vector<api::Double3> upright = latticePlaces(solid, 0.01);
    auto& values = solid.parameters.values;
    values["rotation_z"] = 90.0;
    values["position_x"] = 0.5;
    const std::vector<api::Double3> lying = latticePlaces(solid, 0.01);
    QCOMPARE(lying.size(), upright.size());
    for (size_t i = 0; i < lying.size(); ++i) {  // about z by 90 degrees: x becomes y, y becomes -x
      QVERIFY(std::abs(lying[i].x - (0.5 - upright[i].y)) < 1e-12);
      QVERIFY(std::abs(lying[i].y - upright[i].x) < 1e-12);
    }
    QVERIFY((SolidForm(solid).extent() - Vector3(0.3, 0.1, 0.1)).norm() < 1e-12);
  }

  void windingTellsInsideFromOutside() {
    SceneMesh mesh = ballMesh(32);
    repair(mesh);
    const MeshWinding winding(mesh);
    for (int k = 0; k < 200; ++k) {  // a spiral through all of space around it
      const double r = 0.3 * (k + 0.5) / 200, a = 2.4 * k, h = std::cos(1.7 * k);
      const Vector3 p = r * Vector3(std::sqrt(1 - h * h) * std::cos(a), h, std::sqrt(1 - h * h) * std::sin(a));
      if (std::abs(r - 0.1) < 0.002) continue;  // among its facets
      const double wanted = r < 0.1 ? 1 : 0;
      // 0.05: what the paper's figure 8 shows of dipoles at twice their radius.
      QVERIFY2(std::abs(winding.at(p) - wanted) < 0.05, qPrintable(QString("%1 m: %2").arg(r).arg(winding.at(p))));
    }
    // The lower half of a ball: in the middle of its opening half of all directions see it.
    SceneMesh half = ballMesh(32, true);
    repair(half);
    QVERIFY(!factsOf(half).closed());
    const MeshWinding open(half);
    QVERIFY(std::abs(open.at({0, 0, 0}) - 0.5) < 0.02);
    QVERIFY(open.at({0, -0.06, 0}) > 0.6);
    QVERIFY(open.at({0, 0.06, 0}) < 0.4);
  }

  void meshesAreMended() {
    SceneMesh mesh = ballMesh(16);
    // Every triangle with corners of its own, two of them without an area, all of them seen from inside.
    SceneMesh soup;
    for (const auto& t : mesh.triangles) {
      const auto first = static_cast<uint32_t>(soup.points.size());
      for (const uint32_t i : t) soup.points.push_back(mesh.points[i]);
      soup.triangles.push_back({first, first + 2, first + 1});
    }
    soup.points.push_back({7, 7, 7});
    soup.triangles.push_back({0, 0, 1});
    const MeshRepair done = repair(soup);
    QVERIFY(done.turned && done.left > 0 && done.joined > 1000);
    const MeshFacts facts = factsOf(soup);
    QVERIFY(facts.closed());
    QVERIFY(signedVolume(soup) > 0);
    QCOMPARE(soup.points.size(), size_t{15 * 32 + 2});
    QCOMPARE(facts.triangles, size_t{2 * 15 * 32});
    // Sixteen frusta of pyramids over polygons of 32 corners; points are in single precision.
    double wanted = 0;
    const auto polygon = [](int ring) {
      return 16 * std::pow(0.1 * std::sin(kPi * ring / 16), 2) * std::sin(kPi / 16);
    };
    for (int i = 0; i < 16; ++i) {
      const double a = polygon(i), b = polygon(i + 1);
      wanted += 0.1 * (std::cos(kPi * i / 16) - std::cos(kPi * (i + 1) / 16)) / 3 * (a + b + std::sqrt(a * b));
    }
    QVERIFY(std::abs(facts.volume / wanted - 1) < 1e-6);
    SceneMesh broken = ballMesh(4);
    broken.points[3][1] = std::numeric_limits<float>::quiet_NaN();
    QVERIFY_THROWS_EXCEPTION(InputError, repair(broken));
    broken = ballMesh(4);
    broken.triangles[3][1] = 4000;
    QVERIFY_THROWS_EXCEPTION(InputError, repair(broken));
  }

  void aMeshIsFilledAtAnySize() {
    SceneMesh mesh = ballMesh(48);
    repair(mesh);
    const SolidShape solid = meshSolid(mesh, {0.2, 0.4, 0.1});
    const double volume = SolidForm(solid).volume();
    QVERIFY(std::abs(volume / (kPi / 6 * 0.008) - 1) < 0.01);
    QVERIFY(std::abs(filled(solid, 0.008) / volume - 1) < 0.01);
    // An open one fills to the plane of its rim, which a winding number of a half finds.
    SceneMesh half = ballMesh(32, true);
    repair(half);
    const double share = filled(meshSolid(half, {0.2, 0.1, 0.2}), 0.005) / (2.0 / 3 * kPi * 1e-3);
    QVERIFY2(share > 0.9 && share < 1.05, qPrintable(QString::number(share)));
  }

  void solidsOutliveAFile() {
    PluginRegistry plugins;
    SceneMesh mesh = ballMesh(8);
    repair(mesh);
    Project project = projectOf(meshSolid(mesh, {0.2, 0.2, 0.2}), 0.02);
    Body twin = project.bodies[0];
    twin.id = "twin";
    std::get<SolidShape>(twin.shape).parameters.values["position_x"] = 0.5;
    project.bodies.push_back(twin);
    const std::string text = writeProject(project);
    QCOMPARE(text.find("\"triangles\""), text.rfind("\"triangles\""));  // one mesh for both
    const Project again = parseProject(text, "solids.json", plugins).project;
    const auto& first = std::get<SolidShape>(again.bodies[0].shape);
    QVERIFY(first.mesh && first.mesh == std::get<SolidShape>(again.bodies[1].shape).mesh);
    QVERIFY(first.mesh->points == mesh.points && first.mesh->triangles == mesh.triangles);
    QCOMPARE(writeProject(again), text);
    const Engine engine(again, plugins);
    QCOMPARE(engine.solver().particles().size(), 2 * fillSolid(first, 0.02).cells.size());
  }

  void brokenMeshesNameTheirPlace() {
    PluginRegistry plugins;
    SceneMesh mesh = ballMesh(8);
    repair(mesh);
    const std::string text = writeProject(projectOf(meshSolid(mesh, {0.2, 0.2, 0.2}), 0.02));
    const auto problem = [&](const std::string& edit) -> std::string {
      try {
        parseProject(text, "p.json", plugins, {edit});
      } catch (const InputError& error) {
        return error.what();
      }
      return {};
    };
    QVERIFY(problem("meshes/ball/points/data=AAAA").find("p.json:/meshes/0/points") == 0);
    QVERIFY(problem("meshes/ball/triangles/count=7").find("p.json:/meshes/0/triangles") == 0);
    QVERIFY(problem("bodies/solid/shape/solid/mesh=cube").find("p.json:/bodies/0/shape/solid/mesh") == 0);
    QVERIFY(problem("bodies/solid/shape/solid/size_x=0").find("p.json:/bodies/0/shape/solid/size_x") == 0);
    QVERIFY(problem("bodies/solid/shape/solid/kind=egg").find("p.json:/bodies/0/shape/solid/kind") == 0);
    QVERIFY(problem("bodies/solid/shape/solid/size_x=0.1").empty());
  }
};

QTEST_GUILESS_MAIN(TstSolids)
#include "tst_solids.moc"
