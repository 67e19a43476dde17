// SPDX-License-Identifier: Apache-2.0
#include "core/base/statestream.h"

#include "core/base/error.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ps {
namespace {

static_assert(std::endian::native == std::endian::little, "streams are written as memory lies");

constexpr char kMagic[8] = {'P', 'S', 's', 't', 'a', 't', 'e', '\n'};
constexpr uint32_t kFormat = 1;
constexpr size_t kLongestName = 4096;
constexpr size_t kCopiedAtOnce = 1 << 15;

struct StreamHead {
  char magic[8];
  uint32_t format, reserved;
};
struct BlockHead {
  uint32_t nameBytes;
  uint16_t type, version;
  uint64_t count, bytes;
};
static_assert(sizeof(StreamHead) == 16 && sizeof(BlockHead) == 24);

struct TypeRow {
  StateType type;
  size_t size;
  const char* name;
};
constexpr TypeRow kTypes[] = {{StateType::UInt8, 1, "uint8"},     {StateType::UInt32, 4, "uint32"},
                              {StateType::UInt64, 8, "uint64"},   {StateType::Float32, 4, "float32"},
                              {StateType::Float64, 8, "float64"}, {StateType::Float4, 16, "float4"},
                              {StateType::Text, 1, "text"}};

const TypeRow* rowOf(StateType type) {
  for (const TypeRow& row : kTypes) {
    if (row.type == type) return &row;
  }
  return nullptr;
}

uint64_t padded(uint64_t bytes) { return (bytes + 7) / 8 * 8; }

}  // namespace

size_t sizeOf(StateType type) {
  const TypeRow* row = rowOf(type);
  return row ? row->size : 0;
}

const char* stateTypeName(StateType type) {
  const TypeRow* row = rowOf(type);
  return row ? row->name : "";
}

StateType stateTypeNamed(std::string_view name) {
  for (const TypeRow& row : kTypes) {
    if (name == row.name) return row.type;
  }
  return StateType::End;
}

std::string StateName::text() const {
  std::string whole(room);
  if (!room.empty()) whole += '/';
  whole += item;
  return whole;
}

StateWriter::StateWriter(StateSink& sink) : m_sink(sink) {
  StreamHead head{};
  std::memcpy(head.magic, kMagic, sizeof kMagic);
  head.format = kFormat;
  m_sink.add(&head, sizeof head);
}

void StateBuffer::copy(std::byte* to, const std::byte* from, size_t count) {
  forChunks(count, kCopiedAtOnce,
            [&](size_t first, size_t last) { std::memcpy(to + first, from + first, last - first); });
}

void StateBuffer::add(const void* bytes, size_t count) {
  if (count == 0) return;
  if (m_size + count > m_capacity) {
    const size_t capacity = std::max(m_size + count, m_capacity + m_capacity / 4);
    auto larger = std::make_unique_for_overwrite<std::byte[]>(capacity);
    copy(larger.get(), m_bytes.get(), m_size);
    m_bytes = std::move(larger);
    m_capacity = capacity;
  }
  copy(m_bytes.get() + m_size, static_cast<const std::byte*>(bytes), count);
  m_size += count;
}

void StateWriter::openBytes(StateName name, StateType type, uint64_t count, uint64_t bytes, uint16_t version) {
  if (m_left != 0) throw Error("a state block was opened inside of another");
  const size_t slash = name.room.empty() ? 0 : 1, length = name.room.size() + slash + name.item.size();
  const BlockHead head{static_cast<uint32_t>(length), static_cast<uint16_t>(type), version, count, bytes};
  m_sink.add(&head, sizeof head);
  m_left = length;
  put(name.room.data(), name.room.size());
  put("/", slash);
  put(name.item.data(), name.item.size());
  pad();
  m_left = bytes;
}

void StateWriter::open(StateName name, StateType type, uint64_t count, uint16_t version) {
  openBytes(name, type, count, count * sizeOf(type), version);
}

void StateWriter::put(const void* bytes, size_t count) {
  if (count > m_left) throw Error("a state block was given more than it has announced");
  if (count == 0) return;
  m_left -= count;
  const std::byte* from = static_cast<const std::byte*>(bytes);
  if (m_carried > 0) {
    const size_t some = std::min(count, m_carry.size() - m_carried);
    std::memcpy(m_carry.data() + m_carried, from, some);
    m_carried += some;
    from += some;
    count -= some;
    if (m_carried < m_carry.size()) return;
    m_sink.add(m_carry.data(), m_carry.size());
    m_carried = 0;
  }
  const size_t whole = count / 8 * 8;
  if (whole > 0) m_sink.add(from, whole);
  m_carried = count - whole;
  if (m_carried > 0) std::memcpy(m_carry.data(), from + whole, m_carried);
}

void StateWriter::pad() {
  if (m_carried == 0) return;
  std::memset(m_carry.data() + m_carried, 0, m_carry.size() - m_carried);
  m_sink.add(m_carry.data(), m_carry.size());
  m_carried = 0;
}

void StateWriter::close() {
  if (m_left != 0) throw Error("a state block was given less than it has announced");
  pad();
}

void StateWriter::finish() {
  openBytes(StateName(""), StateType::End, 0, 0, 0);
  close();
}

void StateReader::fail(StateName name, const std::string& what) {
  throw InputError("state block '" + name.text() + "': " + what);
}

StateReader::StateReader(std::span<const std::byte> stream) {
  size_t at = 0;
  const auto next = [&](uint64_t count) {
    if (count > stream.size() - at) throw InputError("the state is cut off");
    const std::span<const std::byte> bytes = stream.subspan(at, static_cast<size_t>(count));
    at += static_cast<size_t>(count);
    return bytes;
  };
  StreamHead head{};
  if (stream.size() < sizeof head || std::memcmp(stream.data(), kMagic, sizeof kMagic) != 0)
    throw InputError("this is no saved state");
  std::memcpy(&head, next(sizeof head).data(), sizeof head);
  if (head.format != kFormat) {
    throw InputError("the state is of format " + std::to_string(head.format) + ", and this program reads format " +
                     std::to_string(kFormat));
  }
  for (;;) {
    BlockHead block{};
    std::memcpy(&block, next(sizeof block).data(), sizeof block);
    const auto type = static_cast<StateType>(block.type);
    if (type == StateType::End) break;
    if (block.nameBytes == 0 || block.nameBytes > kLongestName)
      throw InputError("the state has a block without a name");
    const std::span<const std::byte> name = next(padded(block.nameBytes));
    Block known{
        std::string(reinterpret_cast<const char*>(name.data()), block.nameBytes), type, block.version, block.count, {}};
    const TypeRow* const row = rowOf(type);
    if (!row) fail(known.name, "is of an unknown type");
    if (block.bytes > stream.size() - at) fail(known.name, "is cut off");
    const bool sized = type == StateType::Text ? block.count <= block.bytes / sizeof(uint32_t)
                                               : block.count == block.bytes / row->size && block.bytes % row->size == 0;
    if (!sized) {
      fail(known.name, "says that it has " + std::to_string(block.count) + " elements in " +
                           std::to_string(block.bytes) + " bytes");
    }
    known.bytes = next(padded(block.bytes)).first(static_cast<size_t>(block.bytes));
    if (!m_byName.emplace(known.name, m_blocks.size()).second) fail(known.name, "stands twice");
    m_blocks.push_back(std::move(known));
  }
  if (at != stream.size()) throw InputError("the state goes on behind its end");
  m_read.resize(m_blocks.size());
}

const StateReader::Block* StateReader::find(StateName name) const {
  const auto found = m_byName.find(name.text());
  return found == m_byName.end() ? nullptr : &m_blocks[found->second];
}

std::vector<std::string> StateReader::unread() const {
  std::vector<std::string> names;
  for (size_t k = 0; k < m_blocks.size(); ++k) {
    if (!m_read[k]) names.push_back(m_blocks[k].name);
  }
  return names;
}

size_t StateReader::count(StateName name) const { return static_cast<size_t>(found(name).count); }

const StateReader::Block& StateReader::found(StateName name) const {
  const Block* block = find(name);
  if (!block) fail(name, "is missing");
  m_read[static_cast<size_t>(block - m_blocks.data())] = 1;
  return *block;
}

const StateReader::Block& StateReader::require(StateName name, StateType type, uint16_t newest) const {
  const Block& block = found(name);
  if (block.type != type)
    fail(name, std::string("has elements of type ") + stateTypeName(block.type) + ", not " + stateTypeName(type));
  if (block.version > newest || block.version == 0) {
    fail(name,
         "is of version " + std::to_string(block.version) + ", and this program reads up to " + std::to_string(newest));
  }
  return block;
}

void StateReader::requireCount(const Block& block, size_t count) {
  if (block.count != count)
    fail(block.name, "has " + std::to_string(block.count) + " elements, not " + std::to_string(count));
}

void StateReader::copy(const Block& block, void* to) {
  if (!block.bytes.empty()) std::memcpy(to, block.bytes.data(), block.bytes.size());
}

void StateReader::read(StateName name, StateType type, void* to, size_t count, uint16_t newest) const {
  const Block& block = require(name, type, newest);
  requireCount(block, count);
  copy(block, to);
}

std::vector<std::string> StateReader::texts(StateName name, uint16_t newest) const {
  const Block& block = require(name, StateType::Text, newest);
  std::vector<std::string> values;
  size_t at = 0;
  for (uint64_t k = 0; k < block.count; ++k) {
    uint32_t length = 0;
    if (block.bytes.size() - at < sizeof length) fail(name, "is cut off");
    std::memcpy(&length, block.bytes.data() + at, sizeof length);
    at += sizeof length;
    if (block.bytes.size() - at < length) fail(name, "is cut off");
    values.emplace_back(reinterpret_cast<const char*>(block.bytes.data() + at), length);
    at += length;
  }
  if (at != block.bytes.size()) fail(name, "goes on behind its end");
  return values;
}

}  // namespace ps
