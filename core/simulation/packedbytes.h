// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

namespace ps {

class StoredFile;

/// How many packed bytes are kept, by what counts with it, over all threads.
struct KeptBytes {
  std::atomic<size_t> memory{0}, disk{0};
};
using ByteCount = std::shared_ptr<KeptBytes>;

/// Bytes by zstd, in memory or in a file; counted as long as they live. For any thread.
class PackedBytes {
 public:
  /// Where they lie in a file that somebody has written.
  struct Place {
    std::shared_ptr<const StoredFile> file;
    uint64_t at = 0, size = 0;
    uint64_t raw = 0;  ///< bytes, unpacked
    uint64_t checksum = 0;
  };
  PackedBytes(const std::string& raw, ByteCount count);
  explicit PackedBytes(Place place) : m_place(std::move(place)) {}  ///< counts nothing
  ~PackedBytes();
  PackedBytes(const PackedBytes&) = delete;
  PackedBytes& operator=(const PackedBytes&) = delete;

  std::string unpacked() const;  ///< throws InputError where memory or file was damaged
  std::string packed() const;    ///< likewise
  uint64_t size() const { return m_place.size; }
  uint64_t rawSize() const { return m_place.raw; }
  uint64_t checksum() const { return m_place.checksum; }
  size_t inMemory() const;  ///< bytes; 0: they are in a file
  size_t kept() const;      ///< bytes in memory or in a file of ours; 0: in somebody else's
  /// Into a file of ours. Throws Error where the disk is full, and they stay in memory.
  void moveTo(const std::shared_ptr<StoredFile>& file) const;

 private:
  mutable std::mutex m_mutex;
  mutable std::shared_ptr<const std::string> m_bytes;  ///< nullptr: they are in the file
  mutable Place m_place;
  mutable std::shared_ptr<StoredFile> m_own;  ///< the same file, where it is ours to free
  ByteCount m_count;
};

}  // namespace ps
