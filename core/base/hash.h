// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

namespace ps {

/// 64-bit FNV-1a over 8-byte words; for state hashes, not for secrets. Equal bytes in equal order give equal hashes on
/// every machine of one byte order (all that are supported are little-endian).
class Hash {
 public:
  void add(const void* bytes, size_t count);
  template <class T>
  void add(const T& value) {
    add(&value, sizeof value);
  }
  uint64_t value() const { return m_state; }

 private:
  uint64_t m_state = 14695981039346656037ull;
};

/// A hash as reports and file names show it: 16 hexadecimal digits.
std::string hashText(uint64_t hash);

}  // namespace ps
