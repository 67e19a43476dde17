// SPDX-License-Identifier: Apache-2.0
#include "core/base/hash.h"

#include <cstdio>
#include <cstring>

namespace ps {

void Hash::add(const void* bytes, size_t count) {
  constexpr uint64_t kPrime = 1099511628211ull;
  const char* p = static_cast<const char*>(bytes);
  for (; count > 0;) {
    const size_t n = count < 8 ? count : 8;
    uint64_t word = 0;
    std::memcpy(&word, p, n);
    m_state = (m_state ^ word) * kPrime;
    m_state ^= m_state >> 29;  // FNV over words alone mixes the upper bytes too little
    p += n;
    count -= n;
  }
}

std::string hashText(uint64_t hash) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

}  // namespace ps
