// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/bytepacker.h"

#include <cstdint>
#include <memory>
#include <vector>

// The numbers of particles in whole steps, and what packs well of them: how they differ from what one would expect.
namespace ps {

/// A range in at most 65,536 steps, even ones; or, about zero, steps whose width grows with the root of the value, so
/// that what is small is told as well as what is large.
struct Steps {
  static constexpr float kMost = 65535;
  static constexpr float kRoots = 255;  ///< steps of roots on either side of zero

  float low = 0, step = 0;
  uint32_t roots = 0;  ///< whether they are such

  static Steps between(float low, float high, float least);  ///< no finer than `least`
  static Steps rootsOf(float most);                          ///< from -most to most
  uint16_t of(float value) const;
  float value(uint16_t level) const;
  bool holds(float value) const;
};

/// Particles ascending by id.
struct FrameLevels {
  std::shared_ptr<const std::vector<uint32_t>> id;
  std::vector<std::vector<uint16_t>> numbers;
  std::vector<uint8_t> phase, motion;
  std::vector<uint32_t> body, material;
  std::vector<std::vector<uint32_t>> names;  ///< floats that are no numbers, as their bits

  size_t bytes() const;
};

void packAll(BytePacker& packer, const FrameLevels& levels);
/// Throws InputError for what that has not written, of so many arrays.
FrameLevels unpackAll(ByteUnpacker& unpacker, size_t numbers, size_t names);

/// Half way between two frames of the same particles; names as in the first.
FrameLevels between(const FrameLevels& left, const FrameLevels& right);
void packChanges(BytePacker& packer, const FrameLevels& expected, const FrameLevels& is);
/// Makes what is of what was expected. Throws InputError for what that has not written.
void unpackChanges(ByteUnpacker& unpacker, FrameLevels& expected);

}  // namespace ps
