// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/packedbytes.h"
#include "core/simulation/snapshot.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

// Frames of a run, small: to be looked at, not to go on from. Why the particles are in the order of their ids: the
// solver sorts them by place now and then, and what belongs to whom would change with it. Why frames share a key frame:
// most of them differ from one a quarter of a second before in little, so that what is kept are differences, and these
// are mostly zeros where matter stands still. Places, radii and temperatures are kept in 65,536 steps of the range of
// the key frame with a margin; what leaves it makes a new one.
namespace ps {

/// A range in 65,536 steps.
struct Steps {
  float low = 0, step = 0;
  uint16_t of(float value) const;
  float value(uint16_t level) const { return low + step * static_cast<float>(level); }
  bool holds(float value) const { return value >= low && value <= low + step * 65535.0F; }
};

/// What neighbouring frames have in common.
struct FrameKey {
  Snapshot look;  ///< without particles: spacing, period, names, colours
  uint64_t number = 0;
  std::array<Steps, 5> ranges;  ///< x, y, z, radius in m, temperature in K
  std::shared_ptr<const PackedBytes> data;
};

/// One frame: what it amounts to, and its particles, packed.
struct PackedFrame {
  FrameStats stats;
  StepFlags flags = 0;
  std::vector<Limit> limits;
  std::vector<std::shared_ptr<const ParticleField>> fields;
  std::shared_ptr<const FrameKey> key;
  std::shared_ptr<const PackedBytes> data;

  size_t bytes() const;  ///< beside what is counted by itself
  /// A snapshot as the frame's was, to half a step of each value, particles ascending by id. Throws InputError for data
  /// that no frame has.
  SnapshotPtr snapshot(uint64_t revision) const;
};

/// What a frame keeps of its particles in whole numbers.
struct FrameLevels {
  std::vector<uint32_t> id, body, material;
  std::array<std::vector<uint16_t>, 5> level;  ///< as FrameKey::ranges
  std::vector<uint8_t> phase, motion;
};

/// Packs frame after frame of a run. Not for two threads at a time.
class FramePacker {
 public:
  static constexpr uint64_t kKeyInterval = 16;  ///< frames

  explicit FramePacker(ByteCount count) : m_count(std::move(count)) {}
  PackedFrame pack(const Snapshot& snapshot);

 private:
  void sort(const Snapshot& snapshot);
  bool fitsKey(const Snapshot& snapshot) const;
  void takeLevels(const Snapshot& snapshot, const std::array<Steps, 5>& ranges);
  void makeKey(const Snapshot& snapshot);

  ByteCount m_count;
  std::vector<uint32_t> m_ids, m_order;  ///< as they came last, and the way through them
  FrameLevels m_now, m_keyLevels;
  std::shared_ptr<const FrameKey> m_key;
};

}  // namespace ps
