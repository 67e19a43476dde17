// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/framelevels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ps {
namespace {

constexpr int kZero = 32768;  // level of zero among roots

/// Differences of 16 bits, small ones of both signs as small numbers.
std::vector<uint16_t> differences(const std::vector<uint16_t>& is, const std::vector<uint16_t>& expected) {
  std::vector<uint16_t> all(is.size());
  for (size_t i = 0; i < is.size(); ++i) {
    const auto d = static_cast<int16_t>(static_cast<uint16_t>(is[i] - expected[i]));
    all[i] = static_cast<uint16_t>(static_cast<uint16_t>(d) << 1U) ^ static_cast<uint16_t>(d < 0 ? 0xFFFFU : 0U);
  }
  return all;
}
void addDifferences(std::vector<uint16_t>& expected, const std::vector<uint16_t>& all) {
  for (size_t i = 0; i < expected.size(); ++i) {
    const uint16_t c = all[i];
    const auto d = static_cast<uint16_t>((c >> 1U) ^ ((c & 1U) ? 0xFFFFU : 0U));
    expected[i] = static_cast<uint16_t>(expected[i] + d);
  }
}

/// Nothing where nothing is other.
template <class T>
void packWhereOther(BytePacker& packer, const std::vector<T>& is, const std::vector<T>& expected) {
  const bool other = is != expected;
  packer.value(static_cast<uint8_t>(other));
  if (!other) return;
  std::vector<T> changes(is.size());
  for (size_t i = 0; i < is.size(); ++i) changes[i] = static_cast<T>(is[i] ^ expected[i]);
  packer.array(changes, changes.size());
}
template <class T>
void unpackWhereOther(ByteUnpacker& unpacker, std::vector<T>& expected) {
  if (!unpacker.value<uint8_t>()) return;
  std::vector<T> changes;
  unpacker.array(changes, expected.size());
  for (size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<T>(expected[i] ^ changes[i]);
}

}  // namespace

Steps Steps::between(float low, float high, float least) { return {low, std::max((high - low) / kMost, least), 0}; }

Steps Steps::rootsOf(float most) { return {0, most / (kRoots * kRoots), 1}; }

uint16_t Steps::of(float value) const {
  if (!(step > 0)) return roots ? kZero : 0;
  if (roots) {
    const float root = std::min(std::sqrt(std::abs(value) / step), kRoots);
    const long steps = std::isfinite(root) ? std::lround(root) : 0;
    return static_cast<uint16_t>(kZero + (value < 0 ? -steps : steps));
  }
  if (!(value > low)) return 0;  // not a number, too
  return static_cast<uint16_t>(std::lround(std::min((value - low) / step, kMost)));
}

float Steps::value(uint16_t level) const {
  if (!roots) return low + step * static_cast<float>(level);
  const auto root = static_cast<float>(level - kZero);
  return root * std::abs(root) * step;
}

bool Steps::holds(float value) const {
  if (roots) return std::abs(value) <= step * kRoots * kRoots;
  return value >= low && value <= low + step * kMost;
}

size_t FrameLevels::bytes() const {
  size_t sum = id->size() * sizeof(*id)[0];
  for (const auto& all : numbers) sum += all.size() * sizeof all[0];
  for (const auto& all : names) sum += all.size() * sizeof all[0];
  return sum + phase.size() + motion.size() + (body.size() + material.size()) * sizeof body[0];
}

void packAll(BytePacker& packer, const FrameLevels& levels) {
  const size_t n = levels.id->size();
  packer.value(uint64_t{n});
  std::vector<uint32_t> gaps(n);
  std::adjacent_difference(levels.id->begin(), levels.id->end(), gaps.begin());
  packer.array(gaps, n);
  for (const auto& all : levels.numbers) packer.array(all, n);
  packer.array(levels.phase, n);
  packer.array(levels.motion, n);
  packer.array(levels.body, n);
  packer.array(levels.material, n);
  for (const auto& all : levels.names) packer.array(all, n);
}

FrameLevels unpackAll(ByteUnpacker& unpacker, size_t numbers, size_t names) {
  const auto n = static_cast<size_t>(unpacker.value<uint64_t>());
  FrameLevels levels;
  std::vector<uint32_t> id;
  unpacker.array(id, n);
  std::partial_sum(id.begin(), id.end(), id.begin());
  levels.id = std::make_shared<const std::vector<uint32_t>>(std::move(id));
  levels.numbers.resize(numbers);
  for (auto& all : levels.numbers) unpacker.array(all, n);
  unpacker.array(levels.phase, n);
  unpacker.array(levels.motion, n);
  unpacker.array(levels.body, n);
  unpacker.array(levels.material, n);
  levels.names.resize(names);
  for (auto& all : levels.names) unpacker.array(all, n);
  unpacker.finish();
  return levels;
}

FrameLevels between(const FrameLevels& left, const FrameLevels& right) {
  FrameLevels middle = left;
  for (size_t k = 0; k < middle.numbers.size(); ++k) {
    std::vector<uint16_t>& all = middle.numbers[k];
    for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<uint16_t>((all[i] + right.numbers[k][i]) / 2);
  }
  return middle;
}

void packChanges(BytePacker& packer, const FrameLevels& expected, const FrameLevels& is) {
  for (size_t k = 0; k < is.numbers.size(); ++k)
    packer.array(differences(is.numbers[k], expected.numbers[k]), is.numbers[k].size());
  packWhereOther(packer, is.phase, expected.phase);
  packWhereOther(packer, is.motion, expected.motion);
  packWhereOther(packer, is.body, expected.body);
  packWhereOther(packer, is.material, expected.material);
  for (size_t k = 0; k < is.names.size(); ++k) packWhereOther(packer, is.names[k], expected.names[k]);
}

void unpackChanges(ByteUnpacker& unpacker, FrameLevels& expected) {
  std::vector<uint16_t> changes;
  for (auto& all : expected.numbers) {
    unpacker.array(changes, all.size());
    addDifferences(all, changes);
  }
  unpackWhereOther(unpacker, expected.phase);
  unpackWhereOther(unpacker, expected.motion);
  unpackWhereOther(unpacker, expected.body);
  unpackWhereOther(unpacker, expected.material);
  for (auto& all : expected.names) unpackWhereOther(unpacker, all);
  unpacker.finish();
}

}  // namespace ps
