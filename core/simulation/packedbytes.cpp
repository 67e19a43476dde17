// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/packedbytes.h"

#include "core/base/bytepacker.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/storedfile.h"

#include <optional>
#include <utility>

namespace ps {
namespace {

constexpr int kLevel = 1;  // zstd: the fastest of the plain ones, for a thread beside the solver

uint64_t checksumOf(const std::string& bytes) {
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

}  // namespace

PackedBytes::PackedBytes(const std::string& raw, ByteCount count) : m_count(std::move(count)) {
  auto bytes = std::make_shared<std::string>(squeezed(raw, kLevel));
  bytes->shrink_to_fit();
  m_place.size = bytes->size();
  m_place.raw = raw.size();
  m_place.checksum = checksumOf(*bytes);
  m_bytes = std::move(bytes);
  m_count->memory += m_place.size;
}

PackedBytes::~PackedBytes() {
  if (m_bytes) m_count->memory -= m_place.size;
  if (!m_own) return;
  m_own->release(m_place.at, m_place.size);
  m_count->disk -= StoredFile::room(m_place.size);
}

std::string PackedBytes::packed() const {
  Place place;
  {
    const std::lock_guard lock(m_mutex);
    if (m_bytes) return *m_bytes;
    place = m_place;
  }
  std::string bytes = place.file->read(place.at, place.size);
  if (checksumOf(bytes) != place.checksum) throw InputError("the bytes are not what was written; the file is damaged");
  return bytes;
}

std::string PackedBytes::unpacked() const {
  std::optional<std::string> raw = unsqueezed(packed(), m_place.raw);
  if (!raw) throw InputError("the data are broken; record again");
  return std::move(*raw);
}

size_t PackedBytes::inMemory() const {
  const std::lock_guard lock(m_mutex);
  return m_bytes ? m_place.size : 0;
}

size_t PackedBytes::kept() const {
  const std::lock_guard lock(m_mutex);
  return m_bytes || m_own ? m_place.size : 0;
}

void PackedBytes::moveTo(const std::shared_ptr<StoredFile>& file) const {
  std::shared_ptr<const std::string> bytes;
  {
    const std::lock_guard lock(m_mutex);
    bytes = m_bytes;
  }
  if (!bytes) return;
  const uint64_t at = file->append(*bytes);
  const std::lock_guard lock(m_mutex);
  m_place.file = m_own = file;
  m_place.at = at;
  m_bytes = nullptr;
  m_count->memory -= m_place.size;
  m_count->disk += StoredFile::room(m_place.size);
}

}  // namespace ps
