// SPDX-License-Identifier: Apache-2.0
#include "core/base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

namespace ps {
namespace {

/// "" for what cannot be read.
std::string textOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The number at the beginning, behind blanks. Nothing for "max", and for what is no number.
std::optional<double> leadingNumber(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && number >= 0 ? std::optional(number) : std::nullopt;
}

/// Behind `key` at the start of a line.
std::optional<double> numberAfter(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    if (text.starts_with(key)) return leadingNumber(text.substr(key.size()));
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  return std::nullopt;
}

/// Names of the files of one version of control groups.
struct GroupFiles {
  const char *folder, *limit, *used, *idle;  ///< idle: what the group's caches could give back
};
constexpr GroupFiles kVersion1{"/sys/fs/cgroup/memory", "/memory.limit_in_bytes", "/memory.usage_in_bytes",
                               "total_inactive_file "};
constexpr GroupFiles kVersion2{"/sys/fs/cgroup", "/memory.max", "/memory.current", "inactive_file "};

/// What a group and those around it leave. Within a container the path may lead nowhere: the container's own group then
/// lies at the top.
double leftByGroups(const std::string& root, std::string path, const GroupFiles& files) {
  double left = std::numeric_limits<double>::infinity();
  for (;;) {
    const std::string group = root + files.folder + path;
    const auto limit = leadingNumber(textOf(group + files.limit)), used = leadingNumber(textOf(group + files.used));
    if (limit && used) {
      const double idle = numberAfter(textOf(group + "/memory.stat"), files.idle).value_or(0);
      left = std::min(left, *limit - std::max(0.0, *used - idle));
    }
    if (path.empty()) return left;
    path.resize(path.find_last_of('/'));
  }
}

double leftByGroups(const std::string& root) {
  double left = std::numeric_limits<double>::infinity();
  const std::string text = textOf(root + "/proc/self/cgroup");
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos || line.substr(second + 1, 1) != "/") continue;
    const std::string_view controllers = line.substr(first + 1, second - first - 1);
    std::string path(line.substr(second + 1));
    if (path == "/") path.clear();
    if (controllers.empty()) left = std::min(left, leftByGroups(root, path, kVersion2));
    if (controllers == "memory") left = std::min(left, leftByGroups(root, path, kVersion1));
  }
  return left;
}

/// Of the program's address space.
double leftByLimit(double addresses) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(limit.rlim_cur) - addresses;
}

}  // namespace

Memory memoryNow(const std::string& root) {
  Memory memory;
  constexpr double kKilobyte = 1024;
  const std::string machine = textOf(root + "/proc/meminfo"), program = textOf(root + "/proc/self/status");
  if (const auto available = numberAfter(machine, "MemAvailable:")) memory.free = *available * kKilobyte;
  memory.own = numberAfter(program, "VmRSS:").value_or(0) * kKilobyte;
  memory.free = std::min(memory.free, leftByGroups(root));
  if (const auto addresses = numberAfter(program, "VmSize:"))
    memory.free = std::min(memory.free, leftByLimit(*addresses * kKilobyte));
  memory.free = std::max(0.0, memory.free);
  return memory;
}

std::string memoryText(double bytes) {
  const bool large = bytes >= 995e6;
  const double amount = std::max(1.0, bytes / (large ? 1e9 : 1e6));
  const double step = std::pow(10, std::floor(std::log10(amount)) - 1);
  const double rounded = std::round(amount / step) * step;
  char text[32];
  std::to_chars_result end = rounded < 10 ? std::to_chars(text, std::end(text), rounded, std::chars_format::fixed, 1)
                                          : std::to_chars(text, std::end(text), rounded, std::chars_format::fixed, 0);
  return std::string(text, end.ptr) + (large ? " GB" : " MB");
}

}  // namespace ps
