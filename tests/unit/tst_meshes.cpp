// SPDX-License-Identifier: Apache-2.0
// Triangles alone: what is nearest on them, and fewer of them.
#include "core/geometry/meshreduce.h"
#include "core/geometry/meshrepair.h"
#include "core/geometry/solidfacets.h"

#include <QTest>

#include <cmath>
#include <numbers>

using namespace ps;

namespace {

constexpr double kPi = std::numbers::pi, kRadius = 0.1;

SolidShape solidOf(const char* kind, double size) {
  SolidShape solid;
  solid.parameters.values["kind"] = std::string(kind);
  for (const char* key : {"size_x", "size_y", "size_z"}) solid.parameters.values[key] = size;
  return solid;
}

/// Of some hundred thousand triangles.
SceneMesh ball() {
  SceneMesh mesh;
  for (const MeshNearest::Triangle& t : facetsAround(SolidForm(solidOf("ellipsoid", 2 * kRadius)), 384, 192)) {
    const auto first = static_cast<uint32_t>(mesh.points.size());
    for (const Vector3& p : t)
      mesh.points.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  repair(mesh);
  return mesh;
}

}  // namespace

class TstMeshes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// The nearest place of a box that lies over planes: first its nearer face, then one beside it.
  void nearestPlacesMayHaveToLieOverPlanes() {
    const MeshNearest box(facetsOf(solidOf("block", 2), 0.01));
    const Vector3 place(0.5, 0.3, 0.9);
    const auto first = box.within(1, place);
    QVERIFY(first && std::abs(first->squared - 0.01) < 1e-12);
    QVERIFY((first->normal - Vector3(0, 0, 1)).norm() < 1e-12);
    std::vector<Plane> over{{{0, 0, -1}, -0.95}};  // below the face
    const auto second = box.within(1, place, over);
    QVERIFY(second && (second->place - Vector3(1, 0.3, 0.9)).norm() < 1e-12);
    over.push_back({{-1, 0, 0}, -0.8});
    const auto third = box.within(1, place, over);
    QVERIFY(third && (third->place - Vector3(0.5, 1, 0.9)).norm() < 1e-12);
    QVERIFY(!box.within(0.6, place, over));
  }

  void meshesAreReduced() {
    const SceneMesh whole = ball();
    const MeshFacts before = factsOf(whole);
    QVERIFY(before.triangles > 140'000);
    for (const size_t most : {size_t{20'000}, size_t{5000}}) {
      SceneMesh mesh = whole, again = whole;
      const MeshReduction done = reduce(mesh, most);
      const MeshFacts after = factsOf(mesh);
      QCOMPARE(done.from, before.triangles);
      QCOMPARE(done.to, after.triangles);
      QVERIFY(after.closed() && after.triangles <= most && after.triangles > most / 2);
      QVERIFY(std::abs(after.volume / before.volume - 1) <= kKeptVolume);
      // Of so many triangles on a ball each is flat over about this much: edge^2/(8 R).
      const double edge2 = 4 * kPi * 0.01 / static_cast<double>(after.triangles) * 4 / std::sqrt(3.0);
      QVERIFY2(done.error < 3 * edge2 / 0.8, qPrintable(QString::number(done.error)));
      reduce(again, most);
      QVERIFY(mesh.points == again.points && mesh.triangles == again.triangles);
    }
    // A thousand triangles are not enough to keep a ball's volume: more are left.
    SceneMesh mesh = whole;
    reduce(mesh, 1000);
    QVERIFY(std::abs(factsOf(mesh).volume / before.volume - 1) <= kKeptVolume);
    QVERIFY(!reduce(mesh, 1'000'000).any());
  }
};

QTEST_GUILESS_MAIN(TstMeshes)
#include "tst_meshes.moc"
