// SPDX-License-Identifier: Apache-2.0
#include "core/base/bytepacker.h"

#include <zstd.h>

namespace ps {

void BytePacker::planes(const char* data, size_t size, size_t width) {
  const size_t start = m_bytes.size(), count = size / width;
  m_bytes.resize(start + size);
  for (size_t p = 0; p < width; ++p) {
    for (size_t i = 0; i < count; ++i) m_bytes[start + p * count + i] = data[i * width + p];
  }
  for (size_t i = count * width; i < size; ++i) m_bytes[start + i] = data[i];
}

void ByteUnpacker::words(char* to, const char* planes, size_t size, size_t width) {
  const size_t count = size / width;
  for (size_t p = 0; p < width; ++p) {
    for (size_t i = 0; i < count; ++i) to[i * width + p] = planes[p * count + i];
  }
  for (size_t i = count * width; i < size; ++i) to[i] = planes[i];
}

std::string squeezed(std::string_view raw, int level) {
  std::string packed(ZSTD_compressBound(raw.size()), '\0');
  const size_t size = ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), level);
  if (ZSTD_isError(size)) throw Error(std::string("a frame could not be packed: ") + ZSTD_getErrorName(size));
  packed.resize(size);
  return packed;
}

std::optional<std::string> unsqueezed(std::string_view packed, uint64_t size) {
  if (ZSTD_getFrameContentSize(packed.data(), packed.size()) != size) return std::nullopt;
  std::string raw(size, '\0');
  const size_t got = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) || got != size) return std::nullopt;
  return raw;
}

}  // namespace ps
