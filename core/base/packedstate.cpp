// SPDX-License-Identifier: Apache-2.0
#include "core/base/packedstate.h"

#include "core/base/base64.h"
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/base/statestream.h"

#include <zstd.h>

namespace ps {
namespace {

constexpr int kLevel = 3;

/// Bytes of the words that elements are made of: a Float4 is four of them.
size_t wordOf(StateType type) { return type == StateType::Float4 ? 4 : sizeOf(type); }

/// Bytes of rows by columns, column after column: words of `columns` bytes become planes, and planes words again where
/// rows and columns change places.
std::vector<std::byte> transposed(std::span<const std::byte> bytes, size_t rows, size_t columns) {
  std::vector<std::byte> out(bytes.size());
  for (size_t column = 0; column < columns; ++column) {
    for (size_t row = 0; row < rows; ++row) out[column * rows + row] = bytes[row * columns + column];
  }
  return out;
}

}  // namespace

PackedBlock packBlock(const std::string& name, StateType type, uint64_t count, std::span<const std::byte> bytes) {
  PackedBlock packed{name, stateTypeName(type), 1, count, {}, {}};
  if (bytes.empty()) return packed;
  const size_t word = wordOf(type);
  const std::vector<std::byte> planes = transposed(bytes, bytes.size() / word, word);
  std::vector<std::byte> small(ZSTD_compressBound(planes.size()));
  const size_t size = ZSTD_compress(small.data(), small.size(), planes.data(), planes.size(), kLevel);
  if (ZSTD_isError(size)) throw Error("state block '" + name + "': " + ZSTD_getErrorName(size));
  packed.data = toBase64(std::span(small).first(size));
  return packed;
}

std::vector<PackedBlock> packState(const StateReader& state) {
  std::vector<PackedBlock> packed;
  size_t total = 0;
  for (const StateReader::Block& block : state.blocks()) {
    total += block.bytes.size();
    if (total > kMostPackedBytes) {
      throw Error("the state is larger than the " + std::to_string(kMostPackedBytes >> 20) +
                  " MiB that a project may hold; phasesketch-cli simulate --save-state writes a file of its own");
    }
    packed.push_back(packBlock(block.name, block.type, block.count, block.bytes));
    packed.back().version = block.version;
  }
  return packed;
}

std::vector<std::byte> unpackBlock(const PackedBlock& block, size_t most) {
  const StateType type = stateTypeNamed(block.type);
  if (type == StateType::End) throw InputError("is of the type '" + block.type + "', which there is not");
  const auto expected =
      std::to_string(block.count) + (type == StateType::Text ? " texts" : " elements of " + block.type);
  const auto wrongSize = [&](uint64_t size) {
    return InputError("holds " + std::to_string(size) + " bytes, which are not " + expected);
  };
  const auto fits = [&](uint64_t size) {
    if (type == StateType::Text) return block.count <= size / sizeof(uint32_t);
    return block.count == size / sizeOf(type) && size % sizeOf(type) == 0;
  };
  if (block.data.empty()) {
    if (!fits(0)) throw wrongSize(0);
    return {};
  }
  const auto small = fromBase64(block.data);
  if (!small) throw InputError("is no base64, or is cut off");
  const unsigned long long size = ZSTD_getFrameContentSize(small->data(), small->size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN)
    throw InputError("is no zstd frame that says its size");
  if (!fits(size)) throw wrongSize(size);
  if (size > most) throw InputError("would take " + std::to_string(size) + " bytes, more than a state may have");
  advance(0);
  std::vector<std::byte> planes(static_cast<size_t>(size));
  const size_t got = ZSTD_decompress(planes.data(), planes.size(), small->data(), small->size());
  if (ZSTD_isError(got) || got != planes.size()) throw InputError("is damaged, or is cut off: zstd cannot unpack it");
  advance(0);
  const size_t word = wordOf(type);
  return transposed(planes, word, planes.size() / word);
}

StateBuffer unpackState(std::span<const PackedBlock> blocks) {
  StateBuffer buffer;
  StateWriter writer(buffer);
  size_t left = kMostPackedBytes;
  for (const PackedBlock& packed : blocks) {
    std::vector<std::byte> bytes;
    try {
      bytes = unpackBlock(packed, left);
    } catch (const InputError& problem) {
      StateReader::fail(packed.name, problem.what());
    }
    advance(1);
    left -= bytes.size();
    writer.block(
        {packed.name, stateTypeNamed(packed.type), static_cast<uint16_t>(packed.version), packed.count, bytes});
  }
  writer.finish();
  return buffer;
}

}  // namespace ps
