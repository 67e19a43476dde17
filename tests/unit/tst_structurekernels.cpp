// SPDX-License-Identifier: Apache-2.0
// What structure is computed by, beside the plainest way to compute the same.
#include "plugins/constraints/rigidpieces.h"

#include <QTest>

#include <random>

using ps::constraint::piecesOf;
using ps::constraint::Vector;

namespace {

/// Each pair asked.
std::vector<std::vector<size_t>> plainPieces(const std::vector<Vector>& points, double radius) {
  ps::constraint::DisjointSets sets(points.size());
  for (size_t a = 0; a < points.size(); ++a) {
    for (size_t b = a + 1; b < points.size(); ++b) {
      const Vector d = points[a] - points[b];
      if (dot(d, d) < radius * radius) sets.unite(a, b);
    }
  }
  return sets.sets();
}

/// In [low, low + size).
double number(std::mt19937& engine, double low, double size) { return low + size * (engine() / 4294967296.0); }

class TstStructureKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void piecesAreThoseOfEachPairAsked_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<double>("size");
    QTest::addColumn<double>("radius");
    QTest::newRow("none") << 0 << 1.0 << 0.1;
    QTest::newRow("one") << 1 << 1.0 << 0.1;
    QTest::newRow("few far apart") << 40 << 1e6 << 0.1;
    QTest::newRow("many pieces") << 500 << 1.0 << 0.1;
    QTest::newRow("some pieces") << 500 << 1.0 << 0.15;
    QTest::newRow("all within one cell") << 60 << 0.01 << 0.5;
  }
  void piecesAreThoseOfEachPairAsked() {
    QFETCH(int, count);
    QFETCH(double, size);
    QFETCH(double, radius);
    std::mt19937 engine(7);
    std::vector<Vector> points;
    for (int k = 0; k < count; ++k) {
      const double x = number(engine, -0.3, size), y = number(engine, 2, size), z = number(engine, 0, size);
      points.push_back({x, y, z});
    }
    QCOMPARE(piecesOf(points, radius), plainPieces(points, radius));
  }
  void aLatticeWithAGapFallsApart() {
    // Steps of 1 and 1.414 hang together below 1.5, those of 1.732 and more do not.
    std::vector<Vector> points;
    for (int x = 0; x < 12; ++x) {
      for (int y = 0; y < 5; ++y) {
        for (int z = 0; z < 5; ++z) {
          if (x != 6) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
        }
      }
    }
    const auto pieces = piecesOf(points, 1.5);
    QCOMPARE(pieces.size(), size_t{2});
    QCOMPARE(pieces[0].size(), size_t{150});
    QCOMPARE(pieces[1].size(), size_t{125});
  }
};

}  // namespace

QTEST_GUILESS_MAIN(TstStructureKernels)
#include "tst_structurekernels.moc"
