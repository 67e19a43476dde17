// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/framelevels.h"
#include "core/simulation/packedbytes.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

// Frames of a run, small: to be looked at, not to go on from. Why the particles are in the order of their ids: the
// solver sorts them by place now and then, and what belongs to whom would change with it. Why frames lean on others:
// matter goes on as it went, so that most of a frame is half way between one a little earlier and one a little later,
// and what is kept is how it differs from that. How fine numbers are is said in FramePacker; what leaves the ranges of
// a key frame makes a new one.
namespace ps {

/// What neighbouring frames have in common.
struct FrameKey {
  Snapshot look;  ///< without particles: spacing, period, names, colours
  uint64_t number = 0;
  std::vector<Steps> ranges;  ///< x, y, z, radius in m, temperature in K, speed, density error, gas share, fields
  std::vector<std::shared_ptr<const ParticleField>> fields;
  /// Of their own that particles have, see colourNumber(); packed with the material, by colourLevel().
  std::vector<uint32_t> colours;
  std::shared_ptr<const PackedBytes> data;
};

/// One number for a material and a colour, which change as seldom as each other: that of the material where there is
/// none of its own, and as many further on for each of the key's colours as it has materials.
uint32_t colourLevel(const FrameKey& key, uint32_t material, uint32_t colour);

/// The particles of one frame.
struct FramePart {
  static constexpr uint32_t kDeepest = 7;  ///< between two multiples of FramePacker::kSpan

  std::shared_ptr<const FrameKey> key;
  /// As one would expect it: half way between these; as the left one; as the key where there is none.
  std::shared_ptr<const FramePart> left, right;
  uint32_t depth = 0;  ///< of parts that it leans on
  std::shared_ptr<const PackedBytes> data;

  /// Takes its own bytes, its key's, and those of all that it leans on; some of them twice.
  template <class Visit>
  void eachBytes(const Visit& visit) const {
    visit(key->data);
    if (left) left->eachBytes(visit);
    if (right) right->eachBytes(visit);
    visit(data);
  }
};

/// One frame: what it amounts to, and its particles.
struct PackedFrame {
  FrameStats stats;
  StepFlags flags = 0;
  std::vector<Limit> limits;
  std::shared_ptr<const FramePart> part;

  size_t bytes() const;  ///< beside what is packed
};

/// Makes snapshots again, and keeps what frames next to each other lean on. For any thread.
class FrameUnpacker {
 public:
  /// As the frame's was, to half a step of each value, particles ascending by id. Throws InputError for data that no
  /// frame has.
  SnapshotPtr snapshot(const PackedFrame& frame, uint64_t revision) const;

 private:
  using Levels = std::shared_ptr<const FrameLevels>;
  template <class Of, class Make>
  Levels known(const std::shared_ptr<const Of>& of, const Make& make) const;
  void keep(const std::shared_ptr<const void>& of, const Levels& levels) const;
  Levels levelsOf(const std::shared_ptr<const FrameKey>& key) const;
  Levels levelsOf(const std::shared_ptr<const FramePart>& part) const;

  mutable std::mutex m_mutex;
  mutable std::deque<std::pair<std::weak_ptr<const void>, Levels>> m_known;  ///< the last one first
};

/// Packs frame after frame of a run. Not for two threads at a time.
///
/// Places are kept in steps of a hundredth of the spacing, radii of 1/256 of the largest, temperatures of 1/20 K, or
/// coarser: none finer than the 65,536th part of the range of the key frame with its margin. Speed, density error and
/// gas share are kept in steps of their root, 255 from zero to the largest; fields of plugins and those that were asked
/// for in 4,096 steps of their range.
class FramePacker {
 public:
  static constexpr uint64_t kKeyInterval = 32;  ///< frames
  /// The last frame of a key, and those whose numbers are multiples of this, lean on the key alone, those between on
  /// the two around them. Less where particles are many: what is open is held unpacked.
  static constexpr uint64_t kSpan = 8;

  struct Packed {
    PackedFrame frame;
    std::vector<PackedFrame> anew;  ///< frames before it, smaller; each after those that it leans on
  };

  explicit FramePacker(ByteCount count) : m_count(std::move(count)) {}
  Packed pack(const Snapshot& snapshot);
  /// Whether any before the last one may yet be packed anew.
  bool open() const { return m_open.size() > 1; }

 private:
  struct Open {
    PackedFrame frame;
    FrameLevels levels;
  };
  void sort(const Snapshot& snapshot);
  bool fitsKey(const Snapshot& snapshot) const;
  FrameLevels levelsOf(const Snapshot& snapshot) const;
  void makeKey(const Snapshot& snapshot);
  std::shared_ptr<const FramePart> part(const FrameLevels& levels, const Open* left, const Open* right) const;
  void close(std::vector<PackedFrame>& anew);
  void packBetween(size_t left, size_t right, std::vector<PackedFrame>& anew);

  ByteCount m_count;
  std::vector<uint32_t> m_ids, m_order;  ///< as they came last, and the way through them
  std::shared_ptr<const std::vector<uint32_t>> m_sorted;
  std::shared_ptr<const FrameKey> m_key;
  FrameLevels m_keyLevels;
  std::vector<Open> m_open;  ///< from the last one that nothing will change
};

}  // namespace ps
