// SPDX-License-Identifier: Apache-2.0
#include "core/math/kernels.h"
#include "core/solver/fluid/density.h"

#include <QTest>

#include <cmath>
#include <numbers>

using ps::Kernel;
using ps::KernelShape;

namespace {
constexpr double kSpacing = 0.02;  // m

void addRows() {
  QTest::addColumn<int>("shape");
  QTest::addColumn<double>("ratio");
  for (const double ratio : {2.0, 2.5, 3.0, 4.0}) {
    QTest::addRow("cubic spline, %.1f spacings", ratio) << static_cast<int>(KernelShape::CubicSpline) << ratio;
    QTest::addRow("Wendland C2, %.1f spacings", ratio) << static_cast<int>(KernelShape::WendlandC2) << ratio;
  }
}

template <class Function>
double simpson(double from, double to, int steps, Function f) {
  const double h = (to - from) / steps;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double a = from + k * h;
    sum += h / 6 * (f(a) + 4 * f(a + h / 2) + f(a + h));
  }
  return sum;
}
}  // namespace

class TestKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void areNormalised_data() { addRows(); }
  void areNormalised() {
    QFETCH(int, shape);
    QFETCH(double, ratio);
    const Kernel k(static_cast<KernelShape>(shape), ratio * kSpacing);
    const double volume =
        simpson(0, k.supportRadius(), 400, [&](double r) { return 4 * std::numbers::pi * r * r * k.value(r); });
    QVERIFY(std::abs(volume - 1) < 1e-9);  // piecewise polynomials: Simpson's rule is nearly exact
  }

  void arePositiveAndFall_data() { addRows(); }
  void arePositiveAndFall() {
    QFETCH(int, shape);
    QFETCH(double, ratio);
    const Kernel k(static_cast<KernelShape>(shape), ratio * kSpacing);
    const double scale = k.value(0);
    for (int i = 0; i < 1000; ++i) {
      const double r = k.supportRadius() * i / 1000;
      QVERIFY(k.value(r) > 0);
      QVERIFY(k.gradient(r) < 0);
      const double step = 1e-6 * k.supportRadius();
      if (i == 0) continue;
      // F = W'/r against a central difference: second order, so 1e-5 of the kernel's own scale is generous.
      const double difference = (k.value(r + step) - k.value(r - step)) / (2 * step * r);
      QVERIFY(std::abs(k.gradient(r) - difference) < 1e-5 * scale / (k.supportRadius() * r));
    }
    QCOMPARE(k.value(k.supportRadius()), 0.0);
    QCOMPARE(k.gradient(2 * k.supportRadius()), 0.0);
  }

  void gradientsOfALatticeAddUpToZero_data() { addRows(); }
  void gradientsOfALatticeAddUpToZero() {
    QFETCH(int, shape);
    QFETCH(double, ratio);
    const Kernel k(static_cast<KernelShape>(shape), ratio * kSpacing);
    double sum[3] = {0, 0, 0}, absolute = 0, density = 0;
    for (int x = -5; x <= 5; ++x) {
      for (int y = -5; y <= 5; ++y) {
        for (int z = -5; z <= 5; ++z) {
          const double p[3] = {x * kSpacing, y * kSpacing, z * kSpacing};
          const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), f = r > 0 ? k.gradient(r) : 0;
          for (int a = 0; a < 3; ++a) sum[a] += f * p[a], absolute += std::abs(f * p[a]);
          density += k.value(r) * kSpacing * kSpacing * kSpacing;
        }
      }
    }
    for (const double s : sum) QVERIFY(std::abs(s) < 1e-12 * absolute);
    // A lattice is not a continuum: 2 neighbours deep, both kernels are within 6 % of one.
    QVERIFY(std::abs(density - 1) < 0.06);
  }

  void halfSpacesTakeTheirShare_data() { addRows(); }
  void halfSpacesTakeTheirShare() {
    QFETCH(int, shape);
    QFETCH(double, ratio);
    const Kernel k(static_cast<KernelShape>(shape), ratio * kSpacing);
    const ps::HalfSpaceTable table(k);
    const float support = static_cast<float>(k.supportRadius());
    QVERIFY(std::abs(table.at(0).share - 0.5f) < 1e-6f);
    QCOMPARE(table.at(support).share, 0.0f);
    QCOMPARE(table.at(2 * support).slope, 0.0f);
    for (int i = 1; i < 100; ++i) {
      const float d = support * static_cast<float>(i) / 100, step = support / 200;
      const float difference = (table.at(d + step).share - table.at(d - step).share) / (2 * step);
      QVERIFY(table.at(d).share > 0 && table.at(d).slope < 0);
      // Differences over 1/200 of the support: error of second order, 1e-3 of the largest slope (about 1.4/support).
      QVERIFY(std::abs(table.at(d).slope - difference) < 2e-3f / support);
    }
  }
};

QTEST_APPLESS_MAIN(TestKernels)
#include "tst_kernels.moc"
