// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/neighbours.h"
#include "core/solver/fluid/pairkernels.h"
#include "tests/shared/random.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

// What kernels over pairs are tested and measured on: a disordered block of two liquids, some of it at rest or solid.
namespace ps::scenes {

/// `side`^3 particles on a lattice of 20 mm, each moved by up to a fifth of that, and what the kernels read of them.
/// Every array has the dummy that pads the lists at its end.
class PairScene {
 public:
  static constexpr double kSpacing = 0.02, kSupport = 2 * kSpacing, kSkin = 0.2 * kSpacing;

  PairScene(int side, KernelShape shape, bool periodic) : m_shape(shape) {
    const double edge = side * kSpacing;
    if (periodic) m_store.setPeriod(Period({0, 0, 0}, {edge, edge, edge}, {true, false, true}));
    testing::Random random(11);
    const auto within = [&](double most) { return static_cast<float>(most * (2 * random.next() - 1)); };
    const auto cell = [&](int k) { return (k + 0.5) * kSpacing; };
    size_t i = m_store.add(static_cast<size_t>(side) * side * side);
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x, ++i) {
          const double volume = kSpacing * kSpacing * kSpacing * (1 + 0.1 * random.next());
          m_store.position()[i] = {static_cast<float>(cell(x)) + within(kSpacing / 5),
                                   static_cast<float>(cell(y)) + within(kSpacing / 5),
                                   static_cast<float>(cell(z)) + within(kSpacing / 5), static_cast<float>(volume)};
          const double density = i % 3 == 0 ? 789 : 1000;
          m_store.mass()[i] = static_cast<float>(density * volume);
          const float inverseMass = i % 11 == 0 ? 0 : 1 / m_store.mass()[i];  // one in eleven does not move
          m_store.velocity()[i] = {within(1), within(1), within(1), inverseMass};
        }
      }
    }
    m_neighbours.configure(kSupport, kSkin);
    m_neighbours.sortAndBuild(m_store);
    const size_t count = m_store.size();
    const double factor = scale();
    for (size_t k = 0; k <= count; ++k) {
      const bool dummy = k == count, fluid = k % 7 != 0;
      api::Float4 point = m_store.position()[k];
      point.w = dummy ? 0 : static_cast<float>(factor * double{point.w});
      points.push_back(point);
      multipliers.push_back({point.x, point.y, point.z, dummy ? 0 : within(1)});
      vectors.push_back(dummy ? api::Float4{} : api::Float4{within(1), within(1), within(1), 0});
      coefficient.push_back(dummy ? 0 : fluid ? 0.05f + static_cast<float>(0.1 * random.next()) : -1.0f);
      viscous.push_back(!dummy && k % 2 == 0 ? 1.0f : 0.0f);
      if (!dummy && k % 3 != 1 && m_store.velocity()[k].w > 0) which.push_back(static_cast<uint32_t>(k));
    }
  }

  const ParticleStore& store() const { return m_store; }
  Neighbours& neighbours() { return m_neighbours; }
  KernelShape shape() const { return m_shape; }
  /// 1/m3: W = scale() w.
  double scale() const {
    const double share = m_shape == KernelShape::CubicSpline ? 8 : 10.5;
    return share / (std::numbers::pi * kSupport * kSupport * kSupport);
  }
  PairLists lists() const {
    const api::NeighbourView view = m_neighbours.view();
    return {view.begin,       view.last, view.end, view.index, m_shape, static_cast<float>(1 / (kSupport * kSupport)),
            m_store.period(), view.slots};
  }
  StressField stressField() const { return {points.data(), coefficient.data(), viscous.data()}; }
  size_t slots() const { return lists().slots; }

  std::vector<api::Float4> points;       ///< position in m; w: volume times scale()
  std::vector<api::Float4> multipliers;  ///< position in m; w: any
  std::vector<api::Float4> vectors;      ///< any
  std::vector<float> coefficient;        ///< of viscosity; negative for what is no fluid
  std::vector<float> viscous;            ///< 1 for particles of the implicit stage
  std::vector<uint32_t> which;           ///< two of three of those that move

 private:
  KernelShape m_shape;
  ParticleStore m_store;
  Neighbours m_neighbours;
};

}  // namespace ps::scenes
