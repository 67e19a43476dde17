// SPDX-License-Identifier: Apache-2.0
// Faces of walls: heights, tangent planes, where ways meet them, and what is behind them of a kernel.
#include "core/math/halfspace.h"
#include "core/math/wallface.h"

#include <Eigen/Geometry>
#include <QTest>

#include <cmath>
#include <numbers>

using ps::Vector3;
using ps::WallFace;

namespace {

constexpr double kRounding = 1e-12;

/// About an axis along z through (1, 2, 0), or the centre (1, 2, 3); of 2 m.
WallFace faceOf(const QString& form, bool inside) {
  const Vector3 centre(1, 2, 3);
  return form == QStringLiteral("sphere") ? WallFace::sphere(centre, 2, inside)
                                          : WallFace::cylinder(centre, Vector3(0, 0, 1), 2, inside);
}

void addRows() {
  QTest::addColumn<QString>("form");
  QTest::addColumn<bool>("inside");
  for (const char* form : {"cylinder", "sphere"}) {
    QTest::addRow("in a %s", form) << QString::fromLatin1(form) << true;
    QTest::addRow("around a %s", form) << QString::fromLatin1(form) << false;
  }
}

/// Share of the kernel behind a face from a place d before it, summed over cells: their faces are rough by 1 in some
/// hundred of a layer.
double sumBehind(const WallFace& face, const ps::Kernel& kernel, const Vector3& place) {
  constexpr int kCells = 60;
  const double cell = kernel.supportRadius() / kCells;
  double sum = 0;
  for (int x = -kCells; x < kCells; ++x) {
    for (int y = -kCells; y < kCells; ++y) {
      for (int z = -kCells; z < kCells; ++z) {
        const Vector3 apart = cell * Vector3(x + 0.5, y + 0.5, z + 0.5);
        // What a cell has behind the face: all, nothing, or its part by height.
        const double behind = std::clamp(0.5 - face.heightOf(place + apart) / cell, 0.0, 1.0);
        sum += behind * kernel.value(apart.norm()) * cell * cell * cell;
      }
    }
  }
  return sum;
}

}  // namespace

class TestWallFace : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void tangentPlanesHaveTheHeightOfTheFace_data() { addRows(); }
  void tangentPlanesHaveTheHeightOfTheFace() {
    QFETCH(QString, form);
    QFETCH(bool, inside);
    const WallFace face = faceOf(form, inside);
    for (const Vector3& place : {Vector3(2, 2, 3), Vector3(1, -1, 3.5), Vector3(1, 2, 3)}) {
      const ps::Plane plane = face.at(place);
      QVERIFY(std::abs(plane.normal.norm() - 1) < kRounding);
      QVERIFY(std::abs(plane.heightOf(place) - face.heightOf(place)) < kRounding);
      const Vector3 nearest = place - face.heightOf(place) * plane.normal;
      QVERIFY(std::abs(face.heightOf(nearest)) < kRounding);
    }
    QVERIFY(std::abs(face.heightOf({2, 2, 3}) - (inside ? 1 : -1)) < kRounding);
    const WallFace before = face.before(0.25);
    QVERIFY(std::abs(before.heightOf({2, 2, 3}) - face.heightOf({2, 2, 3}) + 0.25) < kRounding);
  }

  void waysMeetFaces_data() { addRows(); }
  void waysMeetFaces() {
    QFETCH(QString, form);
    QFETCH(bool, inside);
    const WallFace face = faceOf(form, inside);
    const Vector3 way(0.8, 0.1, 0.2);
    const Vector3 from = inside ? Vector3(0.5, 2.5, 3) : Vector3(-3, 1.5, 2.5);
    const auto met = face.meets(from, way);
    QVERIFY(met && *met > 0);
    QVERIFY2(std::abs(face.heightOf(from + *met * way)) < kRounding, qPrintable(QString::number(*met)));
    QVERIFY(face.heightOf(from + 0.99 * *met * way) > 0);
    QVERIFY(face.heightOf(from + 1.01 * *met * way) < 0);
    // From behind and farther in, at once; from behind and out of it, not, or where it comes to the other side.
    const Vector3 behind = inside ? Vector3(4, 2, 3) : Vector3(0, 2, 3);
    QCOMPARE(face.meets(behind, Vector3(inside ? 1 : 0.1, 0, 0)).value_or(-1), 0.0);
    QVERIFY(!face.meets(from, inside ? Vector3(0, 0, 0) : Vector3(-1, 0, 0)));
    if (!inside) QVERIFY(!face.meets({-3, 4.5, 3}, Vector3(1, 0, 0)));
  }

  void whatIsBehindCurvedFacesCounts_data() { addRows(); }
  /// Of a sphere exactly, of a cylinder to first order: of a radius of five supports the second is a hundredth of what
  /// bending does, which is a tenth of the share.
  void whatIsBehindCurvedFacesCounts() {
    QFETCH(QString, form);
    QFETCH(bool, inside);
    const bool sphere = form == QStringLiteral("sphere");
    const ps::Kernel kernel(ps::KernelShape::CubicSpline, 0.4);
    const WallFace face = faceOf(form, inside);
    const ps::HalfSpaceTable table(kernel, {inside ? 2.0 : -2.0, sphere ? 1 : 0.5}), plane(kernel);
    for (const double distance : {0.05, 0.1, 0.2}) {
      const Vector3 place(1 + (inside ? 2 - distance : 2 + distance), 2, 3);
      const double counted = sumBehind(face, kernel, place);
      const double flat = sumBehind(WallFace(face.at(place)), kernel, place);
      const auto d = static_cast<float>(distance);
      const double bent = double{table.at(d).share} - double{plane.at(d).share};
      QVERIFY(std::abs(bent) > 1e-4);
      QVERIFY2(std::abs(bent / (counted - flat) - 1) < 0.06,
               qPrintable(QStringLiteral("%1: %2 for %3").arg(distance).arg(bent).arg(counted - flat)));
    }
  }

  void slopesAreThoseOfShares_data() { addRows(); }
  void slopesAreThoseOfShares() {
    QFETCH(QString, form);
    QFETCH(bool, inside);
    const ps::Kernel kernel(ps::KernelShape::CubicSpline, 0.4);
    const ps::HalfSpaceTable table(kernel, {inside ? 1.0 : -1.0, form == QStringLiteral("sphere") ? 1 : 0.5});
    const auto support = static_cast<float>(kernel.supportRadius());
    for (int i = 1; i < 100; ++i) {
      const float d = support * static_cast<float>(i) / 100, step = support / 200;
      const float difference = (table.at(d + step).share - table.at(d - step).share) / (2 * step);
      // As of a plane: tst_kernels.
      QVERIFY2(std::abs(table.at(d).slope - difference) < 2e-3f / support, qPrintable(QString::number(d)));
    }
  }
};

QTEST_APPLESS_MAIN(TestWallFace)
#include "tst_wallface.moc"
