// SPDX-License-Identifier: Apache-2.0
// The kernels over pairs, against plain loops in double precision over all pairs, and against themselves for every
// instruction set.
#include "core/solver/solver.h"
#include "tests/shared/pairscene.h"

#include <QTest>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>

using namespace ps;
using scenes::PairScene;

namespace {

constexpr int kSide = 9;  // the box of the periodic rows is as long as four search radii
/// Of the sum of the terms' sizes, each times its condition: reciprocal roots, and so q, are good to 7e-7, powers up to
/// the fourth are taken of 1 - q, and some thirty terms are rounded to 6e-8 each.
constexpr double kTolerance = 3e-6;

/// A pair as a plain loop sees it.
struct Pair {
  size_t i, j;
  double x, y, z, q;  ///< m, from j to i; q = r/R
  double weight;      ///< w(q)
  double slope;       ///< w'(q)
  double slopeOverQ;
  double condition() const { return 1 / (1 - q); }  ///< of 1 - q
};

/// A sum over pairs, and by what its error is measured: what its terms are in size, each times its condition.
struct Sum {
  double value = 0, size = 0;
  void add(const Pair& pair, double term) { add(pair, term, std::abs(term)); }
  /// A term that is itself a sum, of parts of the size `parts` in all.
  void add(const Pair& pair, double term, double parts) { value += term, size += pair.condition() * parts; }
};

void forPairs(const PairScene& scene, size_t i, const std::function<void(const Pair&)>& body) {
  const ParticleStore& store = scene.store();
  const Kernel kernel(scene.shape(), PairScene::kSupport);
  for (size_t j = 0; j < store.size(); ++j) {
    if (j == i) continue;
    const api::Float4 d = store.separation(i, j);
    const double x = double{d.x}, y = double{d.y}, z = double{d.z}, r = std::sqrt(x * x + y * y + z * z);
    const double q = r / PairScene::kSupport;
    if (q >= 1) continue;
    const double overQ = slopeOverQ(scene.shape(), q);
    body({i, j, x, y, z, q, kernel.value(r) / scene.scale(), overQ * q, overQ});
  }
}

/// (1 - q)2 (1 + 1/q).
double stressWeight(double q) { return (1 - q) * (1 - q) * (1 + 1 / q); }

double meanOfFluids(double a, double b) { return a >= 0 && b >= 0 ? (a + b) / 2 : std::max({0.0, a, b}); }

void compare(float value, const Sum& expected, const char* what) {
  const double error = std::abs(double{value} - expected.value);
  QVERIFY2(error <= kTolerance * expected.size, qPrintable(QStringLiteral("%1: %2 instead of %3 within %4")
                                                               .arg(QLatin1String(what))
                                                               .arg(value, 0, 'g', 9)
                                                               .arg(expected.value, 0, 'g', 9)
                                                               .arg(kTolerance * expected.size, 0, 'g', 4)));
}

void compare(const api::Float4& value, const std::array<Sum, 3>& expected, const char* what) {
  compare(value.x, expected[0], what);
  compare(value.y, expected[1], what);
  compare(value.z, expected[2], what);
}

/// What all kernels give for one scene.
struct Results {
  std::vector<DensitySums> density, densityByKind, densityOfOneKind, densityAlone, densityFindingNear;
  std::vector<float> squares, squaresByKind, squaresOfOneKind, squaresFindingNear;
  std::vector<api::Float4> multipliers, multipliersBySlopes, viscosity, viscosityOfOne, diagonal, offDiagonal, stress;
  std::vector<CompressionSums> compression;
  std::vector<float> coefficients, shear, nearSlopes, expectedNearSlopes;
  std::vector<uint32_t> near, nearByDensity;  ///< each particle's list, then how long it is
};

constexpr float kFactor = 3.0f;
constexpr float kOneCoefficient = 0.07f;
constexpr float kNearShare = 0.5f;  ///< of the squared support
constexpr std::array<float, DensityWeights::kKinds> kInverseMasses{0, 100, 127, 1000};

uint32_t kindOf(size_t i, uint32_t kinds) { return static_cast<uint32_t>(i % kinds); }

/// Points whose volumes say a kind.
std::vector<api::Float4> marked(const PairScene& scene, uint32_t kinds) {
  std::vector<api::Float4> points = scene.points;
  for (size_t i = 0; i < scene.store().size(); ++i) points[i].w = DensityWeights::marked(points[i].w, kindOf(i, kinds));
  return points;
}

DensityWeights weightsOf(uint32_t kinds) {
  DensityWeights weights;
  std::copy_n(kInverseMasses.begin(), kinds, weights.inverseMass);
  return weights;
}

std::vector<float> densityWeights(const PairScene& scene) {
  std::vector<float> weight(scene.points.size(), 0);
  for (size_t i = 0; i < scene.store().size(); ++i)
    weight[i] = scene.store().velocity()[i].w * scene.points[i].w * scene.points[i].w;
  return weight;
}

Results runAll(const PairScene& scene) {
  const PairLists lists = scene.lists();
  const size_t count = scene.which.size();
  const uint32_t* which = scene.which.data();
  const std::vector<float> weight = densityWeights(scene);
  const std::vector<api::Float4> byKind = marked(scene, DensityWeights::kKinds), ofOneKind = marked(scene, 2);
  DensityWeights each;
  each.each = weight.data();
  std::vector<float> slopes(scene.slots());
  const auto dummy = static_cast<uint32_t>(scene.store().size());
  std::vector<uint32_t> lastOf(dummy), index(scene.slots()), lastByDensity(dummy), indexByDensity(scene.slots());
  std::vector<float> nearSlopes(scene.slots());
  const NearRoom room{kNearShare, dummy, lastOf.data(), index.data()};
  const NearRoom roomOfDensity{kNearShare, dummy, lastByDensity.data(), indexByDensity.data()};
  Results r;
  for (auto* sums : {&r.density, &r.densityByKind, &r.densityOfOneKind, &r.densityAlone, &r.densityFindingNear})
    sums->resize(count);
  for (auto* sums : {&r.squares, &r.squaresByKind, &r.squaresOfOneKind, &r.squaresFindingNear}) sums->resize(count);
  r.compression.resize(count);
  for (auto* sums : {&r.multipliers, &r.multipliersBySlopes, &r.viscosity, &r.viscosityOfOne, &r.diagonal,
                     &r.offDiagonal, &r.stress})
    sums->resize(count);
  r.shear.resize(count);
  r.coefficients.resize(scene.slots(), 0);
  // In two parts, as chunks of a loop would.
  const std::array<std::array<size_t, 2>, 2> parts{{{0, count / 3}, {count / 3, count}}};
  for (const auto& [first, last] : parts) {
    sumDensity(lists, scene.points.data(), each, which, first, last, r.density.data(), r.squares.data(), slopes.data());
    sumDensity(lists, byKind.data(), weightsOf(DensityWeights::kKinds), which, first, last, r.densityByKind.data(),
               r.squaresByKind.data());
    sumDensity(lists, ofOneKind.data(), weightsOf(2), which, first, last, r.densityOfOneKind.data(),
               r.squaresOfOneKind.data());
    sumDensity(lists, scene.points.data(), each, which, first, last, r.densityAlone.data());
    sumDensityFindingNear(lists, scene.points.data(), each, roomOfDensity, which, first, last,
                          r.densityFindingNear.data(), r.squaresFindingNear.data(), nearSlopes.data());
    sumMultipliers(lists, scene.points.data(), which, first, last, r.multipliers.data());
    sumMultipliers(lists, scene.points.data(), which, first, last, r.multipliersBySlopes.data(), slopes.data());
    sumCompression(lists, scene.points.data(), scene.multipliers.data(), which, first, last, r.compression.data());
    findNear(lists, scene.points.data(), room, which, first, last);
    sumViscosity(lists, scene.store().position(), scene.store().velocity(), kOneCoefficient, which, first, last,
                 r.viscosityOfOne.data());
    sumViscosity(lists, scene.store().position(), scene.store().velocity(), scene.coefficient.data(), which, first,
                 last, r.viscosity.data());
    stressCoefficients(lists, scene.stressField(), kFactor, which, first, last, r.coefficients.data(),
                       r.diagonal.data(), r.offDiagonal.data());
    sumStress(lists, scene.points.data(), r.coefficients.data(), scene.vectors.data(), which, first, last,
              r.stress.data());
    sumShear(lists, scene.points.data(), scene.vectors.data(), which, first, last, r.shear.data());
  }
  for (size_t k = 0; k < count; ++k) {
    const uint32_t i = which[k], begin = lists.begin[i], end = lists.end[i];
    r.near.insert(r.near.end(), index.begin() + begin, index.begin() + lastOf[i]);
    r.near.push_back(lastOf[i] - begin);
    r.nearByDensity.insert(r.nearByDensity.end(), indexByDensity.begin() + begin,
                           indexByDensity.begin() + lastByDensity[i]);
    r.nearByDensity.push_back(lastByDensity[i] - begin);
    for (uint32_t near = begin, q = begin; near < lastByDensity[i]; ++near, ++q) {
      while (lists.index[q] != indexByDensity[near]) ++q;
      r.expectedNearSlopes.push_back(slopes[q]);
      r.nearSlopes.push_back(nearSlopes[near]);
    }
    // What fills the list up is far and has no slope.
    for (uint32_t q = lastByDensity[i]; q < end && q % 16 != 0; ++q) {
      r.expectedNearSlopes.push_back(indexByDensity[q] == dummy ? 0.0f : 1.0f);
      r.nearSlopes.push_back(nearSlopes[q]);
    }
  }
  return r;
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

}  // namespace

class TestPairKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void density_data() { scenesToTest(); }
  void density();
  void near_data() { scenesToTest(); }
  void near();
  void viscosity_data() { scenesToTest(); }
  void viscosity();
  void stress_data() { scenesToTest(); }
  void stress();
  void everyInstructionSetGivesTheSameBits_data() { scenesToTest(); }
  void everyInstructionSetGivesTheSameBits();

 private:
  static void scenesToTest() {
    QTest::addColumn<int>("shape");
    QTest::addColumn<bool>("periodic");
    QTest::newRow("cubic spline") << static_cast<int>(KernelShape::CubicSpline) << false;
    QTest::newRow("Wendland") << static_cast<int>(KernelShape::WendlandC2) << false;
    QTest::newRow("cubic spline, periodic") << static_cast<int>(KernelShape::CubicSpline) << true;
    QTest::newRow("Wendland, periodic") << static_cast<int>(KernelShape::WendlandC2) << true;
  }
};

void TestPairKernels::density() {
  QFETCH(const int, shape);
  QFETCH(const bool, periodic);
  const PairScene scene(kSide, static_cast<KernelShape>(shape), periodic);
  const Results r = runAll(scene);
  for (size_t k = 0; k < scene.which.size(); ++k) {
    Sum excess, squares, byKind, ofOneKind, compression, byMultipliers;
    std::array<Sum, 3> gradient;
    forPairs(scene, scene.which[k], [&](const Pair& p) {
      const double volume = double{scene.points[p.j].w}, square = volume * volume * p.slope * p.slope;
      excess.add(p, volume * p.weight);
      squares.add(p, double{scene.store().velocity()[p.j].w} * square);
      byKind.add(p, double{kInverseMasses[kindOf(p.j, DensityWeights::kKinds)]} * square);
      ofOneKind.add(p, double{kInverseMasses[kindOf(p.j, 2)]} * square);
      compression.add(p, -volume * p.slope * p.q / 3);
      byMultipliers.add(p, -double{scene.multipliers[p.j].w} * p.slope * p.q / 3);
      const double f = volume * p.slopeOverQ;
      gradient[0].add(p, f * p.x), gradient[1].add(p, f * p.y), gradient[2].add(p, f * p.z);
    });
    const auto gradientOf = [](const DensitySums& sums) { return api::Float4{sums.x, sums.y, sums.z, 0}; };
    for (const auto* sums :
         {&r.density, &r.densityByKind, &r.densityOfOneKind, &r.densityAlone, &r.densityFindingNear}) {
      compare((*sums)[k].excess, excess, "excess");
      compare(gradientOf((*sums)[k]), gradient, "gradient");
    }
    compare(r.squares[k], squares, "squares");
    compare(r.squaresFindingNear[k], squares, "squares beside near lists");
    compare(r.squaresByKind[k], byKind, "squares by kind");
    compare(r.squaresOfOneKind[k], ofOneKind, "squares of one kind");
    compare(r.multipliers[k], gradient, "multipliers");
    compare(r.multipliersBySlopes[k], gradient, "multipliers by known slopes");
    compare(r.compression[k].excess, excess, "excess of compression");
    compare(r.compression[k].byVolumes, compression, "compression");
    compare(r.compression[k].byMultipliers, byMultipliers, "compression of multipliers");
  }
}

/// All that are near, in the order of the list, and none that is clearly farther.
void TestPairKernels::near() {
  QFETCH(const int, shape);
  QFETCH(const bool, periodic);
  const PairScene scene(kSide, static_cast<KernelShape>(shape), periodic);
  const Results r = runAll(scene);
  const PairLists lists = scene.lists();
  size_t at = 0;
  for (const uint32_t i : scene.which) {
    std::vector<uint32_t> expected;
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
      const api::Float4 d = scene.store().separation(i, lists.index[q]);
      const double q2 = (double{d.x} * double{d.x} + double{d.y} * double{d.y} + double{d.z} * double{d.z}) *
                        double{lists.inverseSupportSquared};
      if (q2 < double{kNearShare}) expected.push_back(lists.index[q]);
    }
    QVERIFY(at + expected.size() < r.near.size());
    QVERIFY2(std::equal(expected.begin(), expected.end(), r.near.begin() + static_cast<std::ptrdiff_t>(at)),
             qPrintable(QString::number(i)));
    QCOMPARE(size_t{r.near[at + expected.size()]}, expected.size());
    at += expected.size() + 1;
  }
  QCOMPARE(at, r.near.size());
  QVERIFY(r.nearByDensity == r.near);
  QVERIFY(sameBits(r.nearSlopes, r.expectedNearSlopes));
}

void TestPairKernels::viscosity() {
  QFETCH(const int, shape);
  QFETCH(const bool, periodic);
  const PairScene scene(kSide, static_cast<KernelShape>(shape), periodic);
  const Results r = runAll(scene);
  const api::Float4 *x = scene.store().position(), *v = scene.store().velocity();
  for (size_t k = 0; k < scene.which.size(); ++k) {
    std::array<Sum, 3> sums, ofOne;
    forPairs(scene, scene.which[k], [&](const Pair& p) {
      const double wi = double{v[p.i].w}, wj = double{v[p.j].w};
      const double c = meanOfFluids(double{scene.coefficient[p.i]}, double{scene.coefficient[p.j]});
      const double mass = wi / ((wi + wj) / 2);
      const double f = (double{x[p.i].w} + double{x[p.j].w}) / 2 * mass * p.weight;
      const std::array<double, 3> change{double{v[p.j].x} - double{v[p.i].x}, double{v[p.j].y} - double{v[p.i].y},
                                         double{v[p.j].z} - double{v[p.i].z}};
      for (size_t a = 0; a < 3; ++a) {
        sums[a].add(p, c * f * change[a]);
        ofOne[a].add(p, double{kOneCoefficient} * f * change[a]);
      }
    });
    compare(r.viscosityOfOne[k], ofOne, "viscosity of one coefficient");
    compare(r.viscosity[k], sums, "viscosity");
  }
}

void TestPairKernels::stress() {
  QFETCH(const int, shape);
  QFETCH(const bool, periodic);
  const PairScene scene(kSide, static_cast<KernelShape>(shape), periodic);
  const Results r = runAll(scene);
  for (size_t k = 0; k < scene.which.size(); ++k) {
    std::array<Sum, 3> diagonal, offDiagonal, stress;
    Sum shear;
    forPairs(scene, scene.which[k], [&](const Pair& p) {
      const double mean = meanOfFluids(double{scene.coefficient[p.i]}, double{scene.coefficient[p.j]});
      const double counts = std::max(double{scene.viscous[p.i]}, double{scene.viscous[p.j]});
      const double weight = stressWeight(p.q);
      const double c =
          double{kFactor} * double{scene.points[p.i].w} * double{scene.points[p.j].w} * mean * counts * weight;
      diagonal[0].add(p, c * p.x * p.x), diagonal[1].add(p, c * p.y * p.y), diagonal[2].add(p, c * p.z * p.z);
      offDiagonal[0].add(p, c * p.x * p.y), offDiagonal[1].add(p, c * p.x * p.z), offDiagonal[2].add(p, c * p.y * p.z);
      const api::Float4 &a = scene.vectors[p.i], &b = scene.vectors[p.j];
      const double dx = p.x * (double{a.x} - double{b.x}), dy = p.y * (double{a.y} - double{b.y}),
                   dz = p.z * (double{a.z} - double{b.z});
      const double along = dx + dy + dz, size = std::abs(dx) + std::abs(dy) + std::abs(dz);
      stress[0].add(p, c * p.x * along, std::abs(c * p.x) * size);
      stress[1].add(p, c * p.y * along, std::abs(c * p.y) * size);
      stress[2].add(p, c * p.z * along, std::abs(c * p.z) * size);
      const double volume = double{scene.points[p.j].w};
      shear.add(p, volume * weight * along * along, volume * weight * size * size);
    });
    compare(r.diagonal[k], diagonal, "diagonal");
    compare(r.offDiagonal[k], offDiagonal, "off the diagonal");
    compare(r.stress[k], stress, "stress");
    compare(r.shear[k], shear, "shear");
  }
}

void TestPairKernels::everyInstructionSetGivesTheSameBits() {
  QFETCH(const int, shape);
  QFETCH(const bool, periodic);
  const PairScene scene(kSide, static_cast<KernelShape>(shape), periodic);
  const std::vector<std::string> sets = availableInstructionSets();
  if (sets.size() < 2) QSKIP("this machine knows one instruction set only");
  const Results best = runAll(scene);
  for (const std::string& name : sets) {
    setInstructionSet(name);
    const Results r = runAll(scene);
    setInstructionSet("");
    QVERIFY2(sameBits(r.density, best.density) && sameBits(r.densityByKind, best.densityByKind) &&
                 sameBits(r.densityOfOneKind, best.densityOfOneKind) && sameBits(r.densityAlone, best.densityAlone) &&
                 sameBits(r.densityFindingNear, best.densityFindingNear),
             name.c_str());
    QVERIFY2(sameBits(r.squares, best.squares) && sameBits(r.squaresByKind, best.squaresByKind) &&
                 sameBits(r.squaresOfOneKind, best.squaresOfOneKind) &&
                 sameBits(r.squaresFindingNear, best.squaresFindingNear) && r.near == best.near &&
                 r.nearByDensity == best.nearByDensity && sameBits(r.nearSlopes, best.nearSlopes),
             name.c_str());
    QVERIFY2(sameBits(r.multipliers, best.multipliers) && sameBits(r.multipliersBySlopes, best.multipliersBySlopes) &&
                 sameBits(r.compression, best.compression),
             name.c_str());
    QVERIFY2(sameBits(r.viscosity, best.viscosity) && sameBits(r.viscosityOfOne, best.viscosityOfOne), name.c_str());
    QVERIFY2(sameBits(r.coefficients, best.coefficients) && sameBits(r.diagonal, best.diagonal) &&
                 sameBits(r.offDiagonal, best.offDiagonal) && sameBits(r.stress, best.stress) &&
                 sameBits(r.shear, best.shear),
             name.c_str());
  }
}

QTEST_APPLESS_MAIN(TestPairKernels)
#include "tst_pairkernels.moc"
