// SPDX-License-Identifier: Apache-2.0
#include "spray.h"

#include "stamping.h"
#include "vectors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace {

using namespace ps::brushes;

constexpr double kFlow = 0.03, kFalloff = 0.5;
constexpr ps::api::ParameterDeclaration kParameters[] = {
    {"flow", "Flow", "", "", ps::api::ParameterKind::Number, ps::api::Scale::Logarithmic, kFlow, 0.002, 0.5, 0.001, 1,
     "%", 100, 0, "", "Brush",
     "Share of the cells in reach that a hand which passes by fills for each particle spacing of its way; a light "
     "touch of the pen fills fewer.",
     "1 % a few drops, 20 % nearly full at once", ""},
    {"falloff", "Falloff", "", "", ps::api::ParameterKind::Number, ps::api::Scale::Linear, kFalloff, 0, 1, 0, 1, "%",
     100, 0, "", "Brush", "How much less falls at the rim than in the middle.",
     "0 % as much everywhere, 100 % nothing at the rim", ""},
};

/// Mixes all bits of a number into all of another one (the finaliser of SplitMix64; Steele, Lea & Flood 2014).
uint64_t mixed(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// 0 .. 1 by the cell and the sample alone: a stroke that is drawn again falls as it fell.
double chanceOf(const ps::api::Cell& cell, uint64_t seed) {
  uint64_t h = mixed(seed + static_cast<uint32_t>(cell.x) + 0x9e3779b97f4a7c15ULL);
  h = mixed(h + static_cast<uint32_t>(cell.y));
  h = mixed(h + static_cast<uint32_t>(cell.z));
  return static_cast<double>(h >> 11) * 0x1p-53;
}

uint64_t seedOf(const ps::api::StrokeSample& sample) {
  const double numbers[] = {sample.position.x, sample.position.y, sample.position.z, sample.time};
  uint64_t seed = 0;
  for (const double number : numbers) seed = mixed(seed ^ std::bit_cast<uint64_t>(number));
  return seed;
}

}  // namespace

SprayBrush::SprayBrush()
    : Described({"Spray",
                 "Scatters single particles around the stroke, more with every pass. It knows the lattice only, not "
                 "what stands in the way; occupied cells are left as they are.",
                 ps::api::listOf(kParameters)}) {}

void SprayBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                        const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const double flow = parameter(context, 0, kFlow), falloff = parameter(context, 1, kFalloff);
  const double squared = context.radius * context.radius;
  const auto inReach = [&](const Double3& d) { return dot(d, d) <= squared; };
  std::vector<ps::api::Cell>& cells = roomForCells();
  for (size_t s = 0; s < samples.count; ++s) {
    const ps::api::StrokeSample sample = samples.at(s);
    const uint64_t seed = seedOf(sample);
    cells.clear();
    stamp(context, sample.position, {context.radius, context.radius, context.radius}, inReach, cells);
    std::erase_if(cells, [&](const ps::api::Cell& cell) {
      const Double3 d{cell.x * context.spacing + context.origin.x - sample.position.x,
                      cell.y * context.spacing + context.origin.y - sample.position.y,
                      cell.z * context.spacing + context.origin.z - sample.position.z};
      const double share = 1 - falloff * std::min(1.0, dot(d, d) / squared);
      return chanceOf(cell, seed) >= flow * share * std::clamp(sample.pressure, 0.0, 1.0);
    });
    sink.submit(kind, {cells.data(), cells.size()});
  }
}

ps::api::Double3 SprayBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}
