// SPDX-License-Identifier: Apache-2.0
// Partners of a particle that exchanges heat, and sums over them, beside the plainest way to compute the same.
#include "core/solver/heat/heatpairkernels.h"
#include "core/solver/solver.h"
#include "tests/shared/random.h"

#include <QTest>

#include <cmath>
#include <limits>
#include <set>

namespace {

constexpr double kSupport = 0.04;

template <class Call>
void onEachInstructionSet(Call&& call) {
  for (const std::string& name : ps::availableInstructionSets()) {
    ps::setInstructionSet(name);
    call(name);
  }
  ps::setInstructionSet("");
}

/// Particles around the first, every third of another material, and slots for a whole number of vectors.
struct Cloud {
  explicit Cloud(size_t count) {
    ps::testing::Random random(count);
    const auto some = [&](double low, double size) { return static_cast<float>(random.next(low, size)); };
    for (size_t k = 0; k <= count; ++k) {
      at.push_back({some(2, 0.08), some(-1, 0.08), some(0, 0.08), 0});
      volume.push_back(some(6e-6, 4e-6));
      if (k > 0) list.push_back(static_cast<uint32_t>(k));
    }
    at[0] = {2.04f, -0.96f, 0.04f, 0};
    if (count > 1) at[2] = at[0];  // two in one place
    slots = (count + 15) / 16 * 16;
  }
  std::vector<ps::api::Float4> at;
  std::vector<float> volume;
  std::vector<uint32_t> list;
  size_t slots;
};

class TstHeatKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void partnersAreFoundAndSummed_data() {
    QTest::addColumn<int>("neighbours");
    QTest::addColumn<int>("shape");
    for (const int neighbours : {0, 1, 15, 16, 40, 111}) {
      QTest::addRow("%d, spline", neighbours) << neighbours << 0;
      QTest::addRow("%d, Wendland", neighbours) << neighbours << 1;
    }
  }
  void partnersAreFoundAndSummed() {
    QFETCH(int, neighbours);
    QFETCH(int, shape);
    const auto kernelShape = shape == 0 ? ps::KernelShape::CubicSpline : ps::KernelShape::WendlandC2;
    const Cloud cloud(static_cast<size_t>(neighbours));
    const ps::Kernel plain(kernelShape, kSupport);
    const ps::HeatKernel kernel(kernelShape, kSupport);
    const float limit = static_cast<float>(kSupport * kSupport), least = 1e-12f * limit;
    std::vector<uint32_t> expected;
    std::vector<float> squares;
    for (const uint32_t j : cloud.list) {
      const ps::api::Float4 &a = cloud.at[0], &b = cloud.at[j];
      const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z, r2 = std::max(x * x + y * y + z * z, least);
      if (r2 < limit) expected.push_back(j), squares.push_back(r2);
    }
    std::set<std::pair<float, float>> sums;
    onEachInstructionSet([&](const std::string& name) {
      std::vector<uint32_t> found(cloud.slots);
      std::vector<float> square(cloud.slots);
      const size_t count = ps::findHeatPartners(cloud.at.data(), 0, cloud.list.data(), cloud.list.size(), limit, least,
                                                found.data(), square.data());
      QVERIFY2(count == expected.size() && std::equal(expected.begin(), expected.end(), found.begin()) &&
                   std::equal(squares.begin(), squares.end(), square.begin()),
               name.c_str());
      // Own ones at the front, others at the back; what lies between is no particle.
      std::vector<uint32_t> partner(cloud.slots, ~0u);
      std::vector<float> r2(cloud.slots, std::numeric_limits<float>::quiet_NaN()), value(r2), slope(r2);
      const auto end = static_cast<uint32_t>(cloud.slots);
      ps::HeatSlots slots{0, 0, end, end};
      for (size_t k = 0; k < count; ++k) {
        const uint32_t slot = found[k] % 3 != 0 ? slots.same++ : --slots.other;
        partner[slot] = found[k], r2[slot] = square[k];
      }
      const ps::HeatSums got =
          ps::sumHeatSlots(kernel, slots, partner.data(), cloud.volume.data(), r2.data(), value.data(), slope.data());
      double moment = 0, filled = 0;
      for (uint32_t k = 0; k < end; ++k) {
        if (k >= slots.same && k < slots.other) continue;
        const double r = std::sqrt(double{r2[k]}), w = plain.value(r), f = -plain.gradient(r);
        const double v = double{cloud.volume[partner[k]]};
        moment += v * f * double{r2[k]};
        filled += v * w;
        // Single precision: some roundings of what is subtracted near the edge of the support.
        QVERIFY2(std::abs(double{value[k]} - w) < 2e-6 * plain.value(0), name.c_str());
        if (r > 1e-3 * kSupport)
          QVERIFY2(std::abs(double{slope[k]} - f) * r < 1e-5 * plain.value(0) / kSupport, name.c_str());
      }
      QVERIFY2(std::abs(double{got.moment} - moment) < 1e-5 && std::abs(double{got.filled} - filled) < 1e-5,
               name.c_str());
      sums.insert({got.moment, got.filled});
    });
    QCOMPARE(sums.size(), size_t{1});
  }
};

}  // namespace

QTEST_APPLESS_MAIN(TstHeatKernels)
#include "tst_heatkernels.moc"
