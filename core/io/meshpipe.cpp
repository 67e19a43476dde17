// SPDX-License-Identifier: Apache-2.0
#include "core/io/meshpipe.h"

#include "core/base/utf8.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>

namespace ps {
namespace {

struct Head {
  char magic[4] = {'P', 'S', 'M', '1'};
  uint32_t problem = 0;  ///< letters that follow, in place of a mesh
  double metresPerUnit = 0;
  uint64_t points = 0, triangles = 0;
};

struct Share {
  char magic[4] = {'P', 'S', 'M', '%'};
  float share = 0;
};

bool writeAll(int descriptor, const void* data, size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = ::write(descriptor, at, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += count;
    size -= static_cast<size_t>(count);
  }
  return true;
}

template <class T>
bool writeAll(int descriptor, const std::vector<T>& values) {
  return writeAll(descriptor, values.data(), std::span(values).size_bytes());
}

template <class T>
const char* take(std::vector<T>& values, uint64_t count, const char* from) {
  values.resize(count);
  std::memcpy(values.data(), from, count * sizeof(T));
  return from + count * sizeof(T);
}

constexpr size_t kMostSaid = 240;  ///< bytes

}  // namespace

bool writeShare(int descriptor, float share) {
  Share told;
  told.share = share;
  return writeAll(descriptor, &told, sizeof told);
}

std::optional<double> takeShare(std::string& bytes) {
  std::optional<double> last;
  const Share wanted;
  Share told;
  size_t taken = 0;
  for (; bytes.size() - taken >= sizeof told; taken += sizeof told) {
    std::memcpy(&told, bytes.data() + taken, sizeof told);
    if (std::memcmp(told.magic, wanted.magic, sizeof told.magic) != 0) break;
    if (told.share >= 0 && told.share <= 1) last = double{told.share};
  }
  bytes.erase(0, taken);
  return last;
}

bool writeMesh(int descriptor, const MeshFile& file, const std::string& problem) {
  Head head;
  head.problem = static_cast<uint32_t>(problem.size());
  head.metresPerUnit = file.metresPerUnit;
  if (problem.empty()) head.points = file.mesh.points.size(), head.triangles = file.mesh.triangles.size();
  if (!writeAll(descriptor, &head, sizeof head)) return false;
  if (!problem.empty()) return writeAll(descriptor, problem.data(), problem.size());
  return writeAll(descriptor, file.mesh.points) && writeAll(descriptor, file.mesh.triangles);
}

MeshFile meshFrom(const std::string& bytes) {
  Head head;
  const Head wanted;
  if (bytes.size() >= sizeof head) std::memcpy(&head, bytes.data(), sizeof head);
  constexpr size_t kTriple = 3 * sizeof(uint32_t);
  const uint64_t rest = bytes.size() - std::min(bytes.size(), sizeof head);
  if (bytes.size() < sizeof head || std::memcmp(head.magic, wanted.magic, sizeof head.magic) != 0 ||
      head.points > rest / kTriple || head.triangles > rest / kTriple ||
      rest != head.problem + kTriple * (head.points + head.triangles))
    throw Error("the process that reads meshes has told nonsense");
  const char* at = bytes.data() + sizeof head;
  // Readers quote what they stumble over, which may be the file.
  if (head.problem > 0) throw InputError(shownText({at, head.problem}, kMostSaid));
  MeshFile file;
  file.metresPerUnit = head.metresPerUnit;
  at = take(file.mesh.points, head.points, at);
  take(file.mesh.triangles, head.triangles, at);
  return file;
}

}  // namespace ps
