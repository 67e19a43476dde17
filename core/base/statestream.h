// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/hash.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Why one stream for all: whatever carries something from one frame to the next writes it here, under a name, and reads
// it back by the same name. The state hash is the hash of these very bytes, roll-back, checkpoints and files are the
// bytes themselves: nothing can be hashed and not saved, nor saved and not hashed.
//
// A stream is little-endian: a head (magic, format), then blocks (head, name, elements), then a block without a name or
// a type, which tells a whole stream from one that was cut off. Everything begins at a multiple of eight bytes. There
// is no compression inside: who wants it small packs it.
namespace ps {

enum class StateType : uint16_t { End = 0, UInt8, UInt32, UInt64, Float32, Float64, Float4, Text };
/// Bytes of one element; 1 for texts, which are counted by their strings and have a length each.
size_t sizeOf(StateType type);
/// "float32"; "" for a type that is none.
const char* stateTypeName(StateType type);
/// StateType::End for a name that is none.
StateType stateTypeNamed(std::string_view name);

/// Name of a block: "particles/count", or a room and an item of it. Lives no longer than its parts.
struct StateName {
  StateName(const char* whole) : item(whole) {}
  StateName(std::string_view whole) : item(whole) {}
  StateName(const std::string& whole) : item(whole) {}
  StateName(std::string_view r, std::string_view i) : room(r), item(i) {}
  std::string text() const;  ///< "room/item"
  std::string_view room, item;
};

/// What a writer's bytes go to: always a multiple of eight at a time.
class StateSink {
 public:
  virtual ~StateSink() = default;
  virtual void add(const void* bytes, size_t count) = 0;
};

/// Keeps them; cleared, it keeps its memory.
class StateBuffer final : public StateSink {
 public:
  StateBuffer() = default;
  StateBuffer(StateBuffer&& other) noexcept { swap(other); }
  StateBuffer& operator=(StateBuffer&& other) noexcept {
    StateBuffer taken(std::move(other));
    swap(taken);
    return *this;
  }
  void add(const void* bytes, size_t count) override;
  void clear() { m_size = 0; }
  std::span<const std::byte> bytes() const { return {m_bytes.get(), m_size}; }

 private:
  void swap(StateBuffer& other) noexcept {
    m_bytes.swap(other.m_bytes);
    std::swap(m_size, other.m_size);
    std::swap(m_capacity, other.m_capacity);
  }
  /// Several threads share what is long.
  static void copy(std::byte* to, const std::byte* from, size_t count);

  std::unique_ptr<std::byte[]> m_bytes;
  size_t m_size = 0, m_capacity = 0;
};

/// Keeps their hash alone; equal to Hash over the whole of a StateBuffer.
class StateHash final : public StateSink {
 public:
  void add(const void* bytes, size_t count) override { m_hash.add(bytes, count); }
  uint64_t value() const { return m_hash.value(); }

 private:
  Hash m_hash;
};

template <class T>
constexpr StateType stateTypeOf();
template <>
constexpr StateType stateTypeOf<uint8_t>() {
  return StateType::UInt8;
}
template <>
constexpr StateType stateTypeOf<uint32_t>() {
  return StateType::UInt32;
}
template <>
constexpr StateType stateTypeOf<uint64_t>() {
  return StateType::UInt64;
}
template <>
constexpr StateType stateTypeOf<float>() {
  return StateType::Float32;
}
template <>
constexpr StateType stateTypeOf<double>() {
  return StateType::Float64;
}

/// A block as it lies in a stream.
struct StateBlock {
  std::string name;
  StateType type = StateType::End;
  uint16_t version = 0;
  uint64_t count = 0;  ///< elements; strings of a text
  std::span<const std::byte> bytes;
};

/// Writes blocks; allocates nothing itself. Throws ps::Error where a block is given more or fewer bytes than it has
/// announced: that is a mistake of the program.
class StateWriter {
 public:
  explicit StateWriter(StateSink& sink);

  template <class T>
  void array(StateName name, std::span<const T> values, uint16_t version = 1) {
    open(name, stateTypeOf<T>(), values.size(), version);
    put(values.data(), values.size_bytes());
    close();
  }
  template <class T>
  void array(StateName name, const std::vector<T>& values, uint16_t version = 1) {
    array(name, std::span<const T>(values), version);
  }
  template <class T>
  void value(StateName name, const T& one, uint16_t version = 1) {
    array(name, std::span<const T>(&one, 1), version);
  }
  /// `textOf(k)` returns the k-th string.
  template <class TextOf>
  void texts(StateName name, size_t count, TextOf&& textOf, uint16_t version = 1) {
    uint64_t bytes = 0;
    for (size_t k = 0; k < count; ++k) bytes += sizeof(uint32_t) + std::string_view(textOf(k)).size();
    openBytes(name, StateType::Text, count, bytes, version);
    for (size_t k = 0; k < count; ++k) {
      const std::string_view text = textOf(k);
      put(static_cast<uint32_t>(text.size()));
      put(text.data(), text.size());
    }
    close();
  }
  void texts(StateName name, std::span<const std::string> values, uint16_t version = 1) {
    texts(
        name, values.size(), [&](size_t k) -> const std::string& { return values[k]; }, version);
  }

  /// As another stream has it.
  void block(const StateBlock& whole) {
    openBytes(whole.name, whole.type, whole.count, whole.bytes.size(), whole.version);
    put(whole.bytes.data(), whole.bytes.size());
    close();
  }
  /// A block whose elements come piece by piece.
  void open(StateName name, StateType type, uint64_t count, uint16_t version = 1);
  void put(const void* bytes, size_t count);
  template <class T>
  void put(const T& value) {
    put(&value, sizeof value);
  }
  void close();

  /// Once, at the end.
  void finish();

 private:
  void openBytes(StateName name, StateType type, uint64_t count, uint64_t bytes, uint16_t version);
  void pad();

  StateSink& m_sink;
  uint64_t m_left = 0;  ///< bytes that the open block still misses
  std::array<std::byte, 8> m_carry{};
  size_t m_carried = 0;
};

/// All that a part saves.
template <class Part>
void saveTo(StateSink& sink, const Part& part) {
  StateWriter writer(sink);
  part.save(writer);
  writer.finish();
}
template <class Part>
uint64_t savedHash(const Part& part) {
  StateHash hash;
  saveTo(hash, part);
  return hash.value();
}

/// Reads a stream in memory, which must outlive it. Everything is checked before it is believed: any bytes whatever
/// give either a value or an InputError that names the block and what is wrong with it. Blocks that nobody asks for are
/// passed over, and known by unread().
class StateReader {
 public:
  using Block = StateBlock;

  /// Throws InputError for what is no stream, is of a newer format, or is damaged.
  explicit StateReader(std::span<const std::byte> stream);

  const std::vector<Block>& blocks() const { return m_blocks; }  ///< in order of the stream
  bool has(StateName name) const { return find(name) != nullptr; }
  /// Names of blocks whose elements nobody has read. Not for two threads at a time.
  std::vector<std::string> unread() const;
  /// Elements of a block, which counts as read; throws InputError where it is missing.
  size_t count(StateName name) const;

  /// All of these throw InputError when the block is missing, of another type, or of a version beyond `newest`.
  template <class T>
  std::vector<T> array(StateName name, uint16_t newest = 1) const {
    const Block& block = require(name, stateTypeOf<T>(), newest);
    std::vector<T> values(block.count);
    copy(block, values.data());
    return values;
  }
  /// As array(), of exactly `count` elements.
  template <class T>
  std::vector<T> array(StateName name, size_t count, uint16_t newest) const {
    requireCount(require(name, stateTypeOf<T>(), newest), count);
    return array<T>(name, newest);
  }
  /// Exactly `count` elements into memory of the reader's own.
  void read(StateName name, StateType type, void* to, size_t count, uint16_t newest = 1) const;
  template <class T>
  T value(StateName name, uint16_t newest = 1) const {
    T one{};
    read(name, stateTypeOf<T>(), &one, 1, newest);
    return one;
  }
  std::vector<std::string> texts(StateName name, uint16_t newest = 1) const;

  /// "state block 'name': what".
  [[noreturn]] static void fail(StateName name, const std::string& what);

 private:
  const Block* find(StateName name) const;
  const Block& found(StateName name) const;  ///< and marked as read
  const Block& require(StateName name, StateType type, uint16_t newest) const;
  static void requireCount(const Block& block, size_t count);
  static void copy(const Block& block, void* to);

  std::vector<Block> m_blocks;
  mutable std::vector<uint8_t> m_read;  ///< 1 for blocks that were asked for, by index
  std::map<std::string, size_t, std::less<>> m_byName;
};

/// Hands out the elements of one array run by run, where several parts share a block.
template <class T>
class StateRuns {
 public:
  StateRuns(const StateReader& reader, StateName name) : m_name(name.text()), m_values(reader.array<T>(name)) {}
  /// The next `count`; throws InputError where fewer are left.
  std::span<const T> next(size_t count) {
    if (count > m_values.size() - m_next)
      StateReader::fail(m_name, "has " + std::to_string(m_values.size()) + " elements, too few");
    const std::span<const T> run(m_values.data() + m_next, count);
    m_next += count;
    return run;
  }
  /// Throws InputError where some are left.
  void done() const {
    if (m_next != m_values.size())
      StateReader::fail(
          m_name, "has " + std::to_string(m_values.size()) + " elements where " + std::to_string(m_next) + " are told");
  }

 private:
  std::string m_name;
  std::vector<T> m_values;
  size_t m_next = 0;
};

}  // namespace ps
