// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/geometry/particlesurface.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

using namespace ps;

namespace {

constexpr double kSpacing = 0.02;
const float kRadius = static_cast<float>(kSpacing * std::cbrt(0.75 / std::numbers::pi));

/// A lattice of so many spheres whose matter begins at `low`.
void addBlock(std::vector<api::Float4>& spheres, std::array<int, 3> count, std::array<double, 3> low) {
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) {
        const auto at = [&](size_t a, int k) { return static_cast<float>(low[a] + (k + 0.5) * kSpacing); };
        spheres.push_back({at(0, x), at(1, y), at(2, z), kRadius});
      }
    }
  }
}

ParticleSurface around(const std::vector<api::Float4>& spheres, double cell = kSpacing / 2) {
  return surfaceAround(spheres, std::vector<float>(spheres.size(), 300), cell);
}

double volumeOf(const ParticleSurface& surface) {
  double six = 0;
  for (const auto& [i, j, k] : surface.triangles) {
    const auto &a = surface.points[i], &b = surface.points[j], &c = surface.points[k];
    const auto d = [](const std::array<float, 3>& p, size_t n) { return static_cast<double>(p[n]); };
    six += d(a, 0) * (d(b, 1) * d(c, 2) - d(b, 2) * d(c, 1)) + d(a, 1) * (d(b, 2) * d(c, 0) - d(b, 0) * d(c, 2)) +
           d(a, 2) * (d(b, 0) * d(c, 1) - d(b, 1) * d(c, 0));
  }
  return six / 6;
}

/// Every edge is gone along as often one way as the other.
bool isClosed(const ParticleSurface& surface) {
  std::map<std::pair<uint32_t, uint32_t>, int> ways;
  for (const auto& t : surface.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      ways[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(ways.begin(), ways.end(), [](const auto& edge) { return edge.second == 0; });
}

}  // namespace

class TestParticleSurface : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aBlockKeepsItsVolume();
  void aBallKeepsItsVolume();
  void aFaceLiesWhereMatterEnds();
  void aLoneSphereIsOne();
  void nothingStandsBetweenTwoBodies();
  void blocksOfTheLatticeMeet();
  void numbersGoAlong();
  void theSameBitsForAnyNumberOfThreads();
  void whatIsNoPlaceIsLeftOut();
  void itCanBeCancelled();
  void itAsksWhileMatterIsSorted();
};

/// Rounded edges cost volume, 8.5 % as measured; nothing is added outside.
void TestParticleSurface::aBlockKeepsItsVolume() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {10, 10, 10}, {-0.1, 0, -0.05});
  const ParticleSurface surface = around(spheres);
  QVERIFY(isClosed(surface));
  const double share = volumeOf(surface) / std::pow(10 * kSpacing, 3);
  qInfo("volume of a block of 10 x 10 x 10: %.4f of its own, %zu triangles", share, surface.triangles.size());
  QVERIFY(share > 0.91 && share < 0.95);
}

/// What is curved loses a tenth of a spacing, 3.7 % as measured.
void TestParticleSurface::aBallKeepsItsVolume() {
  std::vector<api::Float4> lattice, spheres;
  constexpr double kBall = 8 * kSpacing;
  addBlock(lattice, {18, 18, 18}, {-9 * kSpacing, -9 * kSpacing, -9 * kSpacing});
  for (const api::Float4& s : lattice)
    if (std::hypot(double{s.x}, double{s.y}, double{s.z}) < kBall) spheres.push_back(s);
  const ParticleSurface surface = around(spheres);
  QVERIFY(isClosed(surface));
  const double share = volumeOf(surface) / (static_cast<double>(spheres.size()) * std::pow(kSpacing, 3));
  qInfo("volume of a ball of 16 across: %.4f of its matter", share);
  QVERIFY(std::abs(share - 1) < 0.04);
  // All normals point outwards.
  for (size_t i = 0; i < surface.points.size(); ++i) {
    const auto &p = surface.points[i], &n = surface.normals[i];
    QVERIFY(p[0] * n[0] + p[1] * n[1] + p[2] * n[2] > 0);
    QVERIFY(std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-4F);
  }
}

/// Half a spacing above the centres of the uppermost layer, flat to a tenth of a spacing.
void TestParticleSurface::aFaceLiesWhereMatterEnds() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {20, 8, 20}, {-0.2, -0.16, -0.2});
  size_t seen = 0;
  double farthest = 0;
  for (const auto& p : around(spheres).points) {
    if (std::abs(p[0]) > 0.1F || std::abs(p[2]) > 0.1F || p[1] < -0.08F) continue;
    farthest = std::max(farthest, std::abs(double{p[1]}));
    ++seen;
  }
  QVERIFY(seen > 100);
  qInfo("a flat face: off by %.3f spacings at most", farthest / kSpacing);
  QVERIFY(farthest < 0.1 * kSpacing);
}

/// The radius of a drop of one particle, to what half a spacing resolves.
void TestParticleSurface::aLoneSphereIsOne() {
  const ParticleSurface surface = around({{0.005F, 0.5F, 0.003F, kRadius}}, kSpacing / 8);
  QVERIFY(isClosed(surface));
  const double share = volumeOf(surface) / std::pow(kSpacing, 3);
  QVERIFY2(std::abs(share - 1) < 0.05, qPrintable(QString::number(share)));
}

/// Where the mean of the centres would lie in the middle, 1.5 spacings from the nearest.
void TestParticleSurface::nothingStandsBetweenTwoBodies() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {6, 6, 6}, {0, 0, 0});
  addBlock(spheres, {6, 6, 6}, {0, 8 * kSpacing, 0});
  const ParticleSurface surface = around(spheres);
  QVERIFY(isClosed(surface));
  for (const auto& p : surface.points)
    QVERIFY2(p[1] < 6.3 * kSpacing || p[1] > 7.7 * kSpacing, qPrintable(QString::number(p[1] / kSpacing)));
}

/// Wherever the body lies, also across the origin and far off, its surface has no seams.
void TestParticleSurface::blocksOfTheLatticeMeet() {
  for (const double at : {-3.0, -0.071, 0.0, 0.0413, 70.0}) {
    std::vector<api::Float4> spheres;
    addBlock(spheres, {9, 5, 12}, {at, -at, at / 2});
    const ParticleSurface surface = around(spheres);
    QVERIFY(isClosed(surface));
    QVERIFY(volumeOf(surface) > 0.85 * 9 * 5 * 12 * std::pow(kSpacing, 3));
  }
}

void TestParticleSurface::numbersGoAlong() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {6, 6, 6}, {0, 0, 0});
  const size_t half = spheres.size();
  addBlock(spheres, {6, 6, 6}, {0.5, 0, 0});
  std::vector<float> values(half, 280);
  values.resize(spheres.size(), 350);
  const ParticleSurface surface = surfaceAround(spheres, values, kSpacing / 2);
  QCOMPARE(surface.values.size(), surface.points.size());
  for (size_t i = 0; i < surface.points.size(); ++i)
    QVERIFY(std::abs(surface.values[i] - (surface.points[i][0] < 0.3F ? 280 : 350)) < 1e-3F);
}

void TestParticleSurface::theSameBitsForAnyNumberOfThreads() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {15, 11, 9}, {-0.1, -0.1, -0.1});
  for (size_t i = 0; i < spheres.size(); ++i) spheres[i].x += 0.003F * std::sin(static_cast<float>(7 * i));
  setThreadCount(1);
  const ParticleSurface one = around(spheres);
  setThreadCount(4);
  const ParticleSurface four = around(spheres);
  setThreadCount(0);
  QVERIFY(!one.points.empty());
  QVERIFY(one.points == four.points && one.normals == four.normals && one.values == four.values &&
          one.triangles == four.triangles);
}

void TestParticleSurface::whatIsNoPlaceIsLeftOut() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {5, 5, 5}, {0, 0, 0});
  const ParticleSurface plain = around(spheres);
  const float none = std::numeric_limits<float>::quiet_NaN();
  spheres.insert(spheres.end(), {{none, 0, 0, kRadius}, {0, 1e30F, 0, kRadius}, {0, 0, 0, 0}, {0, 0, 0, none}});
  QVERIFY(around(spheres).points == plain.points);
  QVERIFY(around({}).triangles.empty());
}

void TestParticleSurface::itCanBeCancelled() {
  std::vector<api::Float4> spheres;
  addBlock(spheres, {9, 9, 9}, {0, 0, 0});
  Progress progress;
  const ProgressScope scope(&progress);
  progress.cancel();
  QVERIFY_EXCEPTION_THROWN(around(spheres), Cancelled);
}

/// Of a large scene that alone takes longer than whoever gives it up should wait. Counted are questions, not time: so
/// many spheres in so few blocks that these ask twice in all.
void TestParticleSurface::itAsksWhileMatterIsSorted() {
  class Asked final : public Progress {
   public:
    explicit Asked(size_t last) : m_last(last) {}
    size_t count = 0;

   private:
    void advanced(size_t) override {
      if (++count == m_last) cancel();
    }
    size_t m_last;
  };
  constexpr int kSide = 40;  // of a cube a tenth as wide as one of as much matter
  constexpr size_t kSlices = (size_t{kSide} * kSide * kSide + kProgressSlice - 1) / kProgressSlice;
  std::vector<api::Float4> spheres;
  addBlock(spheres, {kSide, kSide, kSide}, {0, 0, 0});
  for (api::Float4& s : spheres) s = {0.1F * s.x, 0.1F * s.y, 0.1F * s.z, s.w};
  const auto asked = [&](size_t last) {
    Asked progress(last);
    const ProgressScope scope(&progress);
    around(spheres);
    return progress.count;
  };
  const size_t all = asked(0);
  QVERIFY2(all > 2 * kSlices + 2, qPrintable(QString::number(all)));
  for (size_t last = 1; last <= all; ++last) QVERIFY_EXCEPTION_THROWN(asked(last), Cancelled);
}

QTEST_APPLESS_MAIN(TestParticleSurface)
#include "tst_particlesurface.moc"
