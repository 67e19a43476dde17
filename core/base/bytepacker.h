// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// Arrays as bytes that pack well. They are cut into byte planes first (all lowest bytes, all second ones, ...): what is
// alike in neighbouring numbers then stands together.
namespace ps {

/// Bytes of the words that elements of T are made of.
template <class T>
constexpr size_t planeWidth() {
  if (sizeof(T) % 4 == 0) return 4;
  return sizeof(T) == 2 ? 2 : 1;
}

/// Appends plain values.
class BytePacker {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    m_bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  /// Throws Error where there are not `count` of them.
  template <class T>
  void array(const std::vector<T>& values, size_t count) {
    if (values.size() != count) throw Error("recording: arrays of a snapshot differ in length");
    planes(reinterpret_cast<const char*>(values.data()), count * sizeof(T), planeWidth<T>());
  }
  /// What is left of the last whole word follows as it is.
  void planes(const char* data, size_t size, size_t width);
  void text(const std::string& words) {
    value(static_cast<uint32_t>(words.size()));
    m_bytes += words;
  }
  const std::string& bytes() const { return m_bytes; }

 private:
  std::string m_bytes;
};

/// Reads them back; every read is checked against what is left. The bytes must outlive it.
class ByteUnpacker {
 public:
  ByteUnpacker(const std::string& bytes, std::string where) : m_bytes(bytes), m_where(std::move(where)) {}
  template <class T>
  T value() {
    T v;
    std::memcpy(&v, next(sizeof v), sizeof v);
    return v;
  }
  template <class T>
  void array(std::vector<T>& values, size_t count) {
    if (count > m_bytes.size()) fail();
    const char* from = next(count * sizeof(T));
    values.resize(count);
    words(reinterpret_cast<char*>(values.data()), from, count * sizeof(T), planeWidth<T>());
  }
  std::string text() {
    const auto size = value<uint32_t>();
    return {next(size), size};
  }
  bool atEnd() const { return m_at == m_bytes.size(); }
  /// Throws where something is left.
  void finish() const {
    if (m_at != m_bytes.size()) fail();
  }
  /// Throws InputError.
  [[noreturn]] void fail() const { throw InputError(m_where + "the frame's data are broken; record again"); }

  static void words(char* to, const char* planes, size_t size, size_t width);

 private:
  const char* next(size_t count) {
    if (count > m_bytes.size() - m_at) fail();
    const char* data = m_bytes.data() + m_at;
    m_at += count;
    return data;
  }
  const std::string& m_bytes;
  std::string m_where;
  size_t m_at = 0;
};

/// By zstd. Throws Error where it cannot.
std::string squeezed(std::string_view raw, int level);
/// Exactly `size` bytes; nothing where that is not what was squeezed.
std::optional<std::string> unsqueezed(std::string_view packed, uint64_t size);

}  // namespace ps
