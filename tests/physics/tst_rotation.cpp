// SPDX-License-Identifier: Apache-2.0
// The rotational part of a matrix, which holds rigid bodies and clusters together.
#include "rotation.h"

#include <QTest>

using namespace ps::constraint;

namespace {

Matrix diagonal(double x, double y, double z) { return {{Vector{x, 0, 0}, Vector{0, y, 0}, Vector{0, 0, z}}}; }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c;
  for (size_t i = 0; i < 3; ++i) c.row[i] = transposedTimes(b, a.row[i]);
  return c;
}

Matrix transposed(const Matrix& m) { return {{m.column(0), m.column(1), m.column(2)}}; }

double angleBetween(Quaternion a, Quaternion b) {
  const Vector v = logarithm(a * conjugate(b));
  return std::sqrt(dot(v, v));
}

}  // namespace

class TestRotation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// A = R S with a symmetric S that stretches along skew axes: R comes back, whatever the start.
  void stretchIsTakenAway_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("z");
    QTest::newRow("evenly") << 1.0 << 1.0 << 1.0;
    QTest::newRow("unevenly") << 1.0 << 0.5 << 2.0;
    QTest::newRow("to a splinter") << 1.0 << 0.05 << 0.02;
    QTest::newRow("flat") << 1.0 << 0.7 << 0.0;
    QTest::newRow("inside out") << 1.0 << 0.8 << -0.3;
    QTest::newRow("far too large") << 1e12 << 2e12 << 3e12;
  }
  void stretchIsTakenAway() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, z);
    const Matrix axes = matrixOf(exponential({0.3, -0.7, 0.4}));
    const Matrix stretch = product(product(axes, diagonal(x, y, z)), transposed(axes));
    for (const Vector turn : {Vector{0, 0, 0}, Vector{1e-4, 0, 2e-4}, Vector{0.5, -1, 0.2}, Vector{0, 2.5, 0.4}}) {
      const Quaternion wanted = exponential(turn);
      const Matrix a = product(matrixOf(wanted), stretch);
      for (const Vector away :
           {Vector{0, 0, 0}, Vector{0.01, 0, 0}, Vector{-0.4, 0.3, 0.5}, Vector{1, 1.2, -1}, Vector{0, 0, 3.12}}) {
        const Quaternion found = rotationOf(a, exponential(away) * wanted);
        const double error = angleBetween(found, wanted);
        QVERIFY2(error < 1e-10, qPrintable(QString::number(error)));
      }
    }
  }

  /// A row of particles says nothing about a turn about itself: it stays as it was.
  void aLineKeepsItsTwist() {
    Matrix line;
    const Vector to{0, 1, 0}, from{1, 0, 0};
    addOuter(line, 2.5, to, from);
    const Quaternion quarter = exponential({0, 0, std::acos(0.0)});
    for (const double twist : {0.0, 0.3, 1.1}) {
      const Quaternion start = exponential({twist, 0, 0});
      const Quaternion found = rotationOf(line, start);
      const Vector mapped = matrixOf(found) * from;
      QVERIFY(dot(mapped - to, mapped - to) < 1e-20);
      QVERIFY2(angleBetween(found, quarter * start) < 1e-9, qPrintable(QString::number(angleBetween(found, start))));
    }
  }

  void aPointStaysAsItWas() {
    const Quaternion start = exponential({0.2, 0.4, -0.1});
    QVERIFY(angleBetween(rotationOf(Matrix{}, start), start) < 1e-14);
  }
};

QTEST_APPLESS_MAIN(TestRotation)
#include "tst_rotation.moc"
