// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/bytepacker.h"
#include "core/simulation/packedframe.h"

#include <cstdint>
#include <string>

// What the blocks of a recording hold before their packed bytes; private to this room.
namespace ps::recording {

inline constexpr char kFileMark[] = "PSRECORD", kBlockMark[] = "PSBLOCK.";
inline constexpr size_t kMark = 8;
inline constexpr uint64_t kMaximumHeader = uint64_t{64} << 20;  ///< bytes

enum class Kind : uint32_t { Run = 1, Document, Names, Probes, Key, Frame, State, Edits, Part };

/// As it lies in the file, little-endian; its head follows, then what is packed.
struct BlockHead {
  char mark[kMark];
  uint32_t kind = 0, headBytes = 0;
  uint64_t packed = 0, raw = 0;  ///< bytes of what follows the head, and of what they unpack to
  uint64_t packedSum = 0;        ///< hash of the former
  uint64_t headSum = 0;          ///< hash of all this up to here and of the head
};
static_assert(sizeof(BlockHead) == 48);
uint64_t headSumOf(const BlockHead& block, const std::string& head);

inline constexpr uint32_t kNone = 0xFFFFFFFF;

struct RunHead {
  uint64_t number = 1;
  double apart = 0;
  std::string name{};
  std::vector<uint32_t> shared;  ///< blocks of states and frames that are its own too
};
struct StateHead {
  uint64_t frame = 0, edits = 0;
  uint32_t document = kNone, names = kNone;  ///< blocks
};
/// Numbers of blocks that particles lean on.
struct PartHead {
  uint32_t key = kNone, left = kNone, right = kNone;
};
/// Those that a frame needs.
struct FrameParts {
  uint32_t part = kNone, probes = kNone;
};

std::string headOf(const RunHead& run);
std::string headOf(const StateHead& state);
std::string headOf(const FrameKey& key);
std::string headOf(const PartHead& part);
std::string headOf(const PackedFrame& frame, const FrameParts& parts);

// Each throws InputError for what none of those above has written.
RunHead readRun(const std::string& head, const std::string& where);
StateHead readState(const std::string& head, const std::string& where);
FrameKey readKey(const std::string& head, const std::string& where);
PartHead readPart(const std::string& head, const std::string& where);
PackedFrame readFrame(const std::string& head, const std::string& where, FrameParts& parts);

}  // namespace ps::recording
