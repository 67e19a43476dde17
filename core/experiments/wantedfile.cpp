// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/wantedfile.h"

#include "core/base/error.h"
#include "core/io/textfile.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace ps {
namespace {

constexpr size_t kMostBytes = 64 * 1024 * 1024;

/// The two cells of a line; nothing where it has another number of them, or its quotes do not close.
std::optional<std::pair<std::string, std::string>> cellsOf(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted || cells.size() != 2) return std::nullopt;
  return std::pair{cells[0], cells[1]};
}

double numberIn(const std::string& cell, const std::string& place) {
  double value = 0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (problem == std::errc() && end == cell.data() + cell.size() && std::isfinite(value)) return value;
  throw InputError(place + "'" + cell + "' is no number");
}

}  // namespace

FitTask readWanted(const std::string& path) {
  const std::string text = readFile(path, kMostBytes);
  FitTask task;
  size_t number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    begin = end + 1;
    const std::string place = path + ":" + std::to_string(++number) + ": ";
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    const auto cells = cellsOf(line);
    if (!cells) throw InputError(place + "must have two cells, a time and a value");
    if (task.column.empty()) {
      if (cells->first != "time_s" || cells->second.empty())
        throw InputError(place + "must be the titles time_s and that of one column of simulate's --probes");
      task.column = cells->second;
      continue;
    }
    const double time = numberIn(cells->first, place);
    if (cells->second.empty()) continue;
    if (!task.wanted.time.empty() && time <= task.wanted.time.back())
      throw InputError(place + "must come after the row before it");
    task.wanted.time.push_back(time);
    task.wanted.value.push_back(numberIn(cells->second, place));
  }
  if (task.wanted.time.empty()) throw InputError(path + ": holds no point of a wanted curve");
  return task;
}

}  // namespace ps
