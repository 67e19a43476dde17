// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ps {

enum class StateType : uint16_t;
class StateBuffer;
class StateReader;

/// A block of a state stream as text, for a file that people can read and compare: the bytes of its elements in planes
/// (all first bytes, then all second ones, which compress far better), zstd, base64.
struct PackedBlock {
  std::string name;
  std::string type;                                 ///< stateTypeName()
  int version = 1;                                  ///< 1..65535
  uint64_t count = 0;                               ///< elements; strings of a text
  std::string data;                                 ///< "" where there are none
  std::shared_ptr<const nlohmann::json> unknown{};  ///< keys of a file that this version does not know
};

/// What all blocks of a packed state may come to, unpacked: 1.7 million particles of 600 bytes.
inline constexpr size_t kMostPackedBytes = size_t{1} << 30;

/// Elements of an array, whose bytes these are. Throws Error where they cannot be packed.
PackedBlock packBlock(const std::string& name, StateType type, uint64_t count, std::span<const std::byte> bytes);
/// The blocks of a stream, in its order. Throws Error for more than kMostPackedBytes.
std::vector<PackedBlock> packState(const StateReader& state);
/// Bytes of one block's elements. Throws InputError saying what is wrong with it: no base64, no zstd, another size than
/// its type and count say, more than `most` bytes, which are then never allocated.
std::vector<std::byte> unpackBlock(const PackedBlock& block, size_t most);
/// The stream again. Throws InputError "state block 'name': what".
StateBuffer unpackState(std::span<const PackedBlock> blocks);

}  // namespace ps
