// SPDX-License-Identifier: Apache-2.0
// The loops that a step spends its time in, one by one, on one thread, for each instruction set of this machine:
// nanoseconds per pair, and per particle for the search.
//
//   kernels [--benchmark_filter=density] [--benchmark_repetitions=5] ...     as Google Benchmark has it
#include "core/base/parallel.h"
#include "core/solver/solver.h"
#include "tests/shared/pairscene.h"

#include <benchmark/benchmark.h>

#include <functional>
#include <string>

using namespace ps;
using scenes::PairScene;

namespace {

constexpr int kSide = 27;  // 19,683 particles: more than a core's own cache holds, as in a scene

/// All particles as which[], and room for what any kernel gives.
struct Work {
  PairScene scene;
  PairLists lists;
  std::vector<uint32_t> which;
  std::vector<float> weight, coefficients, scalars, slopes;
  std::vector<DensitySums> density;
  std::vector<api::Float4> first, second;
  size_t pairs = 0;

  explicit Work(KernelShape shape, bool periodic) : scene(kSide, shape, periodic), lists(scene.lists()) {
    const size_t count = scene.store().size();
    weight.resize(count + 1, 0);
    for (size_t i = 0; i < count; ++i) {
      which.push_back(static_cast<uint32_t>(i));
      weight[i] = scene.store().velocity()[i].w * scene.points[i].w * scene.points[i].w;
      pairs += lists.last[i] - lists.begin[i];
    }
    coefficients.resize(scene.slots()), slopes.resize(scene.slots());
    scalars.resize(count), density.resize(count), first.resize(count), second.resize(count);
  }
  void densityOfEach() {
    DensityWeights weights;
    weights.each = weight.data();
    sumDensity(lists, scene.points.data(), weights, which.data(), 0, which.size(), density.data(), scalars.data(),
               slopes.data());
  }
  void densityOfOne() {
    DensityWeights weights;
    weights.inverseMass[1] = 1;
    sumDensity(lists, scene.points.data(), weights, which.data(), 0, which.size(), density.data(), scalars.data(),
               slopes.data());
  }
  void multipliers() {
    sumMultipliers(lists, scene.points.data(), which.data(), 0, which.size(), first.data(), slopes.data());
  }
  void viscosity() {
    sumViscosity(lists, scene.store().position(), scene.store().velocity(), scene.coefficient.data(), which.data(), 0,
                 which.size(), first.data());
  }
  void stressWeights() {
    stressCoefficients(lists, scene.stressField(), 1, which.data(), 0, which.size(), coefficients.data(), first.data(),
                       second.data());
  }
  void stress() {
    sumStress(lists, scene.points.data(), coefficients.data(), scene.vectors.data(), which.data(), 0, which.size(),
              first.data());
  }
  void shear() {
    sumShear(lists, scene.points.data(), scene.vectors.data(), which.data(), 0, which.size(), scalars.data());
  }
  void search() { scene.neighbours().build(scene.store()); }
};

/// Seconds of one run divided by `number`.
void tell(benchmark::State& state, const char* of, size_t number) {
  state.counters[of] = benchmark::Counter(static_cast<double>(number),
                                          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void add(const std::string& name, const std::string& set, KernelShape shape, bool periodic, void (Work::*kernel)(),
         bool ofPairs = true) {
  benchmark::RegisterBenchmark((name + "/" + set).c_str(), [=](benchmark::State& state) {
    setInstructionSet(set);
    Work work(shape, periodic);
    for (auto run : state) {
      (work.*kernel)();
      benchmark::ClobberMemory();
    }
    if (ofPairs)
      tell(state, "s/pair", work.pairs);
    else
      tell(state, "s/particle", work.which.size());
    setInstructionSet("");
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  setThreadCount(1);
  for (const std::string& set : availableInstructionSets()) {
    constexpr KernelShape kSpline = KernelShape::CubicSpline, kWendland = KernelShape::WendlandC2;
    add("neighbours", set, kSpline, false, &Work::search, false);
    add("density", set, kSpline, false, &Work::densityOfOne);
    add("density_mixed", set, kSpline, false, &Work::densityOfEach);
    add("density_periodic", set, kSpline, true, &Work::densityOfOne);
    add("density_wendland", set, kWendland, false, &Work::densityOfOne);
    add("multipliers", set, kSpline, false, &Work::multipliers);
    add("viscosity", set, kSpline, false, &Work::viscosity);
    add("stress_coefficients", set, kSpline, false, &Work::stressWeights);
    add("stress", set, kSpline, false, &Work::stress);
    add("shear", set, kSpline, false, &Work::shear);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
