// SPDX-License-Identifier: Apache-2.0
#include "core/export/particlecolumns.h"

#include "core/base/progress.h"
#include "core/simulation/particlefield.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace ps {
namespace {

/// A column by its row: how its values are read off a snapshot.
struct Source {
  std::string name, unit = "1";
  std::function<float(size_t)> number{};
  std::function<uint32_t(size_t)> whole{};
  std::vector<std::string> names{};
};

std::vector<Source> sourcesOf(const Snapshot& s) {
  std::vector<Source> all;
  all.push_back({.name = "id", .whole = [&s](size_t i) { return s.id[i]; }});
  all.push_back({.name = "body",
                 .whole = [&s](size_t i) { return s.body[i]; },
                 .names = s.bodyIds ? *s.bodyIds : std::vector<std::string>()});
  all.push_back({.name = "material", .whole = [&s](size_t i) { return s.material[i]; }, .names = s.materialIds});
  all.push_back({.name = "phase",
                 .whole = [&s](size_t i) { return static_cast<uint32_t>(s.phase[i]); },
                 .names = {kPhaseNames.begin(), kPhaseNames.end()}});
  all.push_back({.name = "motion",
                 .whole = [&s](size_t i) { return static_cast<uint32_t>(s.motion[i]); },
                 .names = {"solid", "liquid", "gas", "fixed"}});
  all.push_back({.name = "radius", .unit = "m", .number = [&s](size_t i) { return s.position[i].w; }});
  std::vector<std::string> fields = ParticleFields().names();
  for (const FieldValues& more : s.fields) fields.push_back(more.field->name);
  for (const std::string& name : fields) {
    const ShownField shown(s, name);
    const auto is = [&](const Source& source) { return source.name == name; };
    if (!shown || std::any_of(all.begin(), all.end(), is)) continue;
    all.push_back({.name = name, .unit = shown.field().unit, .number = [shown](size_t i) { return shown[i]; }});
  }
  return all;
}

}  // namespace

std::vector<std::string> columnNames(const Snapshot& snapshot) {
  std::vector<std::string> names;
  for (const Source& source : sourcesOf(snapshot)) names.push_back(source.name);
  return names;
}

ParticleTable tableOf(const Snapshot& snapshot, const std::vector<std::string>& wanted) {
  std::vector<size_t> order(snapshot.position.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return snapshot.id[a] < snapshot.id[b]; });
  ParticleTable table;
  table.position.reserve(order.size());
  for (const size_t i : order) table.position.push_back(snapshot.position[i]);
  for (Source& source : sourcesOf(snapshot)) {
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), source.name) == wanted.end()) continue;
    ParticleColumn column{source.name, source.unit, {}, std::move(source.names)};
    const auto fill = [&](auto values, const auto& read) {
      values.reserve(order.size());
      for (const size_t i : order) values.push_back(read(i));
      column.values = std::move(values);
    };
    if (source.whole)
      fill(std::vector<uint32_t>(), source.whole);
    else
      fill(std::vector<float>(), source.number);
    table.columns.push_back(std::move(column));
    advance(0);  // a million particles take a while
  }
  return table;
}

}  // namespace ps
