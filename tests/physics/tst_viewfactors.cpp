// SPDX-License-Identifier: Apache-2.0
// What surfaces of particles radiate at each other, against view factors in closed form (Howell, A Catalog of Radiation
// Configuration Factors; Siegel & Howell, Thermal Radiation Heat Transfer).
//
// Faces of a lattice are the surfaces themselves, so that what is left is chance: a share F of N rays is found to
// sqrt((1 - F) / (F N)). With N of 60,000 and more over the frames of a run and F of 0.02 and more, two standard
// deviations are 6 % at most and mostly below 2 %; rays drawn from an even sequence scatter less. 5 % is asked for,
// where nothing else is said.
#include "heatscene.h"

#include <QtTest/QTest>

#include <numbers>

namespace {

using heattest::Scene;

constexpr double kSigma = 5.670374419e-8;
constexpr double kHot = 800, kCold = 10;  ///< K

heattest::Matter metal() {
  heattest::Matter matter;
  matter.conductivitySolid = matter.conductivityLiquid = 1e-4;  // where bodies touch
  return matter;
}

/// Bodies of one temperature each, that exchange nothing but radiation with each other and with a sky of 0 K.
class Bodies {
 public:
  Scene scene;

  uint32_t material(double emissivity) {
    ps::Material m = heattest::materialOf(metal());
    m.properties["emissivity"] = emissivity;
    scene.addMaterial(m);
    return static_cast<uint32_t>(scene.materials.size() - 1);
  }
  /// Corner and size in spacings.
  uint32_t box(std::array<int, 3> corner, std::array<int, 3> size, double kelvin, uint32_t material) {
    const size_t first = scene.store.size();
    scene.addBox(corner, size, material);
    join(first, kelvin, m_count);
    return m_count++;
  }
  /// One body of what was added since `first`.
  void join(size_t first, double kelvin, uint32_t body) {
    for (size_t i = first; i < scene.store.size(); ++i) scene.store.body()[i] = body;
    m_kelvin.resize(scene.store.size(), kelvin);
  }
  /// Watts into a body, mean of the frames: others' rays in each.
  double power(uint32_t body, int frames = 16) {
    scene.thermal.radiation = true;
    scene.thermal.surroundingsTemperature = 0;
    scene.start([&](size_t i) { return m_kelvin[i]; });
    const double before = energy(body), all = scene.heat.energy(scene.store), step = 1e-3;
    for (int k = 0; k < frames; ++k) scene.heat.advance(scene.store, scene.neighbours, step, static_cast<uint64_t>(k));
    m_open = std::abs(scene.heat.energy(scene.store) - all - scene.heat.ledger().net()) / std::abs(all);
    return (energy(body) - before) / (frames * step);
  }
  /// What of the balance is open after power().
  double open() const { return m_open; }
  void turn(const ps::Matrix3& by, const ps::Vector3& about) {
    for (size_t i = 0; i < scene.store.size(); ++i) {
      ps::api::Float4& x = scene.store.position()[i];
      ps::assignTo(x, about + by * (ps::vectorOf(x) - about));
    }
  }

 private:
  double energy(uint32_t body) {
    double sum = 0;
    for (size_t i = 0; i < scene.store.size(); ++i) {
      if (scene.store.body()[i] == body) sum += double{scene.store.mass()[i]} * scene.enthalpyField()[i];
    }
    return sum;
  }
  std::vector<double> m_kelvin;
  uint32_t m_count = 0;
  double m_open = 0;
};

/// Two equal squares of side a, c apart (C-11).
double facing(double a, double c) {
  const double x = a / c, one = 1 + x * x;
  return 2 / (std::numbers::pi * x * x) *
         (0.5 * std::log(one * one / (1 + 2 * x * x)) + 2 * x * std::sqrt(one) * std::atan(x / std::sqrt(one)) -
          2 * x * std::atan(x));
}
/// Two rectangles of width w and height h at a right angle, with a common edge of length 1 (C-14).
double atRightAngle(double w, double h) {
  const double ww = w * w, hh = h * h, both = ww + hh, root = std::sqrt(both);
  const double product = (1 + ww) * (1 + hh) / (1 + both) * std::pow(ww * (1 + both) / ((1 + ww) * both), ww) *
                         std::pow(hh * (1 + both) / ((1 + hh) * both), hh);
  return (w * std::atan(1 / w) + h * std::atan(1 / h) - root * std::atan(1 / root) + 0.25 * std::log(product)) /
         (std::numbers::pi * w);
}

double between(double hot, double cold) { return kSigma * (std::pow(hot, 4) - std::pow(cold, 4)); }

void check(double found, double expected, double tolerance) {
  qInfo("%g of %g W, %+.1f %%", found, expected, 100 * (found / expected - 1));
  QVERIFY2(std::abs(found / expected - 1) < tolerance, qPrintable(QString::number(found / expected)));
}

/// Rotation of 1 in 3, 2 and 6 parts, to no axis of the lattice.
ps::Matrix3 oblique() {
  ps::Matrix3 m;
  m << 2.0 / 7, 3.0 / 7, 6.0 / 7, 3.0 / 7, -6.0 / 7, 2.0 / 7, 6.0 / 7, 2.0 / 7, -3.0 / 7;
  return m;
}

}  // namespace

class TestViewFactors : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// So many that each gets fewer rays in a frame than it has faces: those take turns, and none is left out. Twelve
  /// spacings apart the others stand before 2 % of each.
  void grainsRadiateFromAllFaces() {
    constexpr int kSide = 48, kApart = 12;
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    for (int k = 0; k < kSide * kSide; ++k)
      bodies.scene.addBox({kApart * (k % kSide), 0, kApart * (k / kSide)}, {1, 1, 1}, black);
    bodies.join(0, kHot, 0);
    const double dx = bodies.scene.spacing;
    check(bodies.power(0), -kSide * kSide * 6 * dx * dx * between(kHot, 0), 0.05);
  }

  void squaresFaceToFace_data() {
    QTest::addColumn<int>("side");
    QTest::addColumn<int>("gap");
    QTest::addColumn<bool>("turned");
    for (const auto& [side, gap] :
         {std::pair{5, 3}, {5, 10}, {10, 2}, {10, 5}, {10, 10}, {10, 20}, {20, 5}, {20, 20}}) {
      QTest::newRow(qPrintable(QString("%1 at %2").arg(side).arg(gap))) << side << gap << false;
    }
    QTest::newRow("10 at 10, turned") << 10 << 10 << true;
    QTest::newRow("20 at 20, turned") << 20 << 20 << true;
  }
  void squaresFaceToFace() {
    QFETCH(int, side);
    QFETCH(int, gap);
    QFETCH(bool, turned);
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    bodies.box({0, 0, 0}, {side, 2, side}, kHot, black);
    const uint32_t cold = bodies.box({0, 2 + gap, 0}, {side, 2, side}, kCold, black);
    if (turned) bodies.turn(oblique(), {0.1, 0.2, 0.3});
    const double a = side * bodies.scene.spacing;
    check(bodies.power(cold, side < 10 ? 64 : 16), a * a * facing(side, gap) * between(kHot, kCold), 0.05);
    QVERIFY2(bodies.open() < 1e-12, qPrintable(QString::number(bodies.open())));
  }

  void plateOfOneLayer() {
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    bodies.box({0, 0, 0}, {10, 1, 10}, kHot, black);
    const uint32_t cold = bodies.box({0, 11, 0}, {10, 1, 10}, kCold, black);
    const double a = 10 * bodies.scene.spacing;
    check(bodies.power(cold), a * a * facing(1, 1) * between(kHot, kCold), 0.05);
  }

  void squaresAtARightAngle_data() {
    QTest::addColumn<int>("side");
    for (const int side : {5, 10, 20}) QTest::newRow(qPrintable(QString::number(side))) << side;
  }
  void squaresAtARightAngle() {
    // They meet along an edge, and so do their narrow sides of two spacings on the other side of it.
    QFETCH(int, side);
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    bodies.box({0, -2, 0}, {side, 2, side}, kHot, black);
    const uint32_t cold = bodies.box({-2, 0, 0}, {2, side, side}, kCold, black);
    const double a = side * bodies.scene.spacing, w = 2.0 / side;
    check(bodies.power(cold, side < 10 ? 64 : 16),
          a * a * (atRightAngle(1, 1) + w * atRightAngle(w, w)) * between(kHot, kCold), 0.05);
  }

  void whatStandsBetweenTakesItsShare() {
    // A wide plate halfway between two squares that covers one half of what lies between: of the lines from one to the
    // other those with x1 + x2 > 0 are cut, which is half by symmetry. Its thickness of one spacing, of 10 between the
    // squares, cuts some more: those that pass beside its edge within half a spacing above or below, a twentieth.
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    bodies.box({-10, -2, -10}, {20, 2, 20}, kHot, black);
    const uint32_t cold = bodies.box({-10, 21, -10}, {20, 2, 20}, kCold, black);
    bodies.box({0, 10, -30}, {30, 1, 60}, kCold, black);
    const double a = 20 * bodies.scene.spacing;
    check(bodies.power(cold), 0.5 * 0.975 * a * a * facing(20, 21) * between(kHot, kCold), 0.05);
  }

  void greyBodyInAGreyShell_data() {
    QTest::addColumn<double>("inner");
    QTest::addColumn<double>("outer");
    QTest::newRow("black") << 1.0 << 1.0;
    QTest::newRow("grey") << 0.5 << 0.5;
    QTest::newRow("bright shell") << 0.9 << 0.2;
  }
  void greyBodyInAGreyShell() {
    // A convex body sees nothing but the shell: sigma A1 (T2^4 - T1^4)/(1/e1 + A1/A2 (1/e2 - 1)), where what leaves a
    // surface leaves all of it alike; in corners it does not. 5 %.
    QFETCH(double, inner);
    QFETCH(double, outer);
    Bodies bodies;
    const uint32_t own = bodies.material(inner), around = bodies.material(outer);
    const uint32_t cube = bodies.box({7, 7, 7}, {6, 6, 6}, kCold, own);
    const size_t first = bodies.scene.store.size();
    const auto slab = [&](std::array<int, 3> corner, std::array<int, 3> size) {
      bodies.scene.addBox(corner, size, around);
    };
    const int n = 20;
    slab({0, 0, 0}, {n, 2, n}), slab({0, n - 2, 0}, {n, 2, n});
    slab({0, 2, 0}, {n, n - 4, 2}), slab({0, 2, n - 2}, {n, n - 4, 2});
    slab({0, 2, 2}, {2, n - 4, n - 4}), slab({n - 2, 2, 2}, {2, n - 4, n - 4});
    bodies.join(first, kHot, cube + 1);
    const double dx = bodies.scene.spacing, area = 6 * 36 * dx * dx, ratio = 36.0 / 256;
    check(bodies.power(cube), area * between(kHot, kCold) / (1 / inner + ratio * (1 / outer - 1)), 0.05);
  }

  void greySquaresUnderAColdSky() {
    // What each of two squares sends back is partly lost beside the other: e^2 F/(1 - (1 - e)^2 F^2).
    Bodies bodies;
    const uint32_t grey = bodies.material(0.5);
    bodies.box({0, 0, 0}, {10, 2, 10}, kHot, grey);
    const uint32_t cold = bodies.box({0, 7, 0}, {10, 2, 10}, kCold, grey);
    const double a = 10 * bodies.scene.spacing, f = facing(10, 5);
    check(bodies.power(cold, 32), a * a * 0.25 * f / (1 - 0.25 * f * f) * between(kHot, kCold), 0.05);
  }

  void aBallRadiatesAsARoundOneDoes() {
    // Steps of the lattice see each other: by Cauchy's theorem the rest is four times the mean shadow, that of a ball
    // of the same volume but for the roughness, a part of a spacing in 8. 10 %.
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    const double radius = 8;
    for (int z = -8; z < 8; ++z) {
      for (int y = -8; y < 8; ++y) {
        const double half = std::sqrt(std::max(0.0, radius * radius - (y + 0.5) * (y + 0.5) - (z + 0.5) * (z + 0.5)));
        const int width = static_cast<int>(std::lround(half));
        if (width > 0) bodies.scene.addBox({-width, y, z}, {2 * width, 1, 1}, black);
      }
    }
    bodies.join(0, kHot, 0);
    const double r = radius * bodies.scene.spacing;
    check(-bodies.power(0), 4 * std::numbers::pi * r * r * between(kHot, 0), 0.1);
  }

  void gapsNarrowerThanAParticleAreTold() {
    // Of two spacings, of none, and of 0.6 between two bodies; between two that are equally warm nothing is lost.
    const auto told = [](double gap, double kelvin) {
      Bodies bodies;
      const uint32_t black = bodies.material(1);
      bodies.box({0, 0, 0}, {6, 2, 6}, kHot, black);
      const size_t first = bodies.scene.store.size();
      const uint32_t other = bodies.box({0, 2, 0}, {6, 2, 6}, kelvin, black);
      for (size_t i = first; i < bodies.scene.store.size(); ++i)
        bodies.scene.store.position()[i].y += static_cast<float>(gap * bodies.scene.spacing);
      bodies.power(other, 1);
      return bodies.scene.heat.narrowestGap() / bodies.scene.spacing;
    };
    QCOMPARE(told(2, kCold), 0.0);
    QCOMPARE(told(0, kCold), 0.0);
    QCOMPARE(told(0.6, kHot), 0.0);
    QVERIFY(std::abs(told(0.6, kCold) - 0.6) < 1e-3);
  }

  /// What is kept while nothing has changed is what would be found anew, to the bit, whatever happens in between.
  void boxesAreKeptAsTheyWouldBeFound() {
    Bodies bodies;
    const uint32_t black = bodies.material(1);
    bodies.box({0, 0, 0}, {5, 5, 5}, kHot, black);
    bodies.box({0, 8, 0}, {5, 2, 5}, kCold, black);
    const uint32_t stray = static_cast<uint32_t>(bodies.scene.store.size());
    bodies.box({2, 6, 2}, {1, 1, 1}, kCold, black);
    Scene& scene = bodies.scene;
    scene.start([](size_t) { return kHot; });
    const double dx = scene.spacing;
    std::vector<float> filled(scene.store.size(), 0.7f);
    ps::SurfaceBoxes kept;
    const auto differ = [&](const char* what) {
      scene.neighbours.build(scene.store);
      ps::OpenSurface surface;
      surface.measure(scene.store, scene.neighbours.view(), filled, {}, dx, {});
      const ps::SurfaceSurroundings around{scene.store, {}, surface, filled, {}, dx};
      std::vector<ps::SurfaceBox> old(scene.store.size()), anew;
      for (size_t i = 0; i < old.size(); ++i) old[i].particle = static_cast<uint32_t>(i);
      anew = old;
      kept.find(around, scene.neighbours.view(), old);
      ps::SurfaceBoxes().find(around, scene.neighbours.view(), anew);
      for (size_t i = 0; i < old.size(); ++i) {
        const ps::SurfaceBox &a = old[i], &b = anew[i];
        QVERIFY2(a.axes == b.axes && a.bare == b.bare && a.turned == b.turned && a.particle == b.particle &&
                     a.height == b.height && a.area == b.area && a.gap == b.gap,
                 what);
      }
    };
    const auto moveTo = [&](double x, double y, double z) {
      ps::assignTo(scene.store.position()[stray], ps::Vector3(x * dx, y * dx, z * dx));
    };
    differ("at first");
    differ("at rest");
    moveTo(2.5, 5.6, 2.5), differ("one lies on a face");
    differ("and stays there");
    moveTo(7, 5.6, 2.5), differ("it has left in one leap");
    moveTo(5.5, 4.5, 2.5), differ("it lies at an edge");
    filled[2] = filled[stray] = 0.8f, differ("less of the space is filled");
    moveTo(2.5, 6.2, 2.5), differ("it is a gap away from both");
    scene.store.temperature()[stray] = kCold, differ("and cold");
    scene.store.body()[stray] = 0, differ("and of a body with one of them");
    scene.store.motion()[stray] = ps::api::Motion::Gas, differ("and vapour");
    moveTo(9, 9, 9), differ("alone");
    scene.store.motion()[stray] = ps::api::Motion::Solid;
    moveTo(2.5, 5.6, 2.5), differ("and back, where it has been before");
  }

  void heatGoesFromHotToColdAlone() {
    // Two bodies as warm as the sky beside a colder third: both only lose, the third only gains, in every frame.
    Bodies bodies;
    const uint32_t black = bodies.material(1), grey = bodies.material(0.4);
    bodies.box({0, 0, 0}, {10, 2, 10}, 700, black);
    bodies.box({3, 5, 2}, {4, 3, 5}, 700, grey);
    const uint32_t cold = bodies.box({0, 12, 0}, {10, 2, 10}, 400, grey);
    Scene& scene = bodies.scene;
    scene.thermal.radiation = true;
    scene.thermal.surroundingsTemperature = 700;
    scene.start([&](size_t i) { return scene.store.body()[i] == cold ? 400.0 : 700.0; });
    for (uint64_t frame = 0; frame < 16; ++frame) {
      scene.heat.advance(scene.store, scene.neighbours, 0.01, frame);
      for (size_t i = 0; i < scene.store.size(); ++i) {
        const double t = scene.store.temperature()[i];
        QVERIFY2(t >= 400 - 1e-9 && t <= 700 + 1e-9, qPrintable(QString::number(t)));
      }
    }
    QVERIFY(scene.heat.ledger().radiation > 0);
  }
};

QTEST_APPLESS_MAIN(TestViewFactors)
#include "tst_viewfactors.moc"
