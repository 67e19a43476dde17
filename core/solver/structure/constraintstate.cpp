// SPDX-License-Identifier: Apache-2.0
// What constraints and groups carry from one frame to the next. Runs follow from lists and bodies, and which colours a
// particle has and which constraints there are already from the lists.
#include "core/base/statestream.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <cstdio>

namespace ps {
namespace {

/// "constraints.3", without an allocation.
class Room {
 public:
  explicit Room(size_t set) {
    const int length = std::snprintf(m_name.data(), m_name.size(), "constraints.%zu", set);
    m_view = {m_name.data(), static_cast<size_t>(length)};
  }
  operator std::string_view() const { return m_view; }

 private:
  std::array<char, 40> m_name{};
  std::string_view m_view;
};

void saveColumns(StateWriter& writer, StateName name, std::span<const std::vector<float>> columns, size_t rows) {
  writer.open(name, StateType::Float32, columns.size() * rows);
  for (const std::vector<float>& column : columns) writer.put(column.data(), rows * sizeof(float));
  writer.close();
}

void restoreColumns(const StateReader& reader, StateName name, std::span<std::vector<float>> columns, size_t rows) {
  StateRuns<float> values(reader, name);
  for (std::vector<float>& column : columns) {
    const std::span<const float> run = values.next(rows);
    column.assign(run.begin(), run.end());
  }
  values.done();
}

void saveStarts(StateWriter& writer, StateName name, const std::vector<size_t>& starts) {
  writer.open(name, StateType::UInt64, starts.size());
  for (const size_t start : starts) writer.put(uint64_t{start});
  writer.close();
}

/// From 0, ascending, to `end`.
std::vector<size_t> restoreStarts(const StateReader& reader, StateName name, size_t end) {
  const std::vector<uint64_t> read = reader.array<uint64_t>(name);
  if (read.empty() || read.front() != 0 || read.back() != end || !std::is_sorted(read.begin(), read.end()))
    StateReader::fail(name, "does not cut its list into pieces");
  return {read.begin(), read.end()};
}

std::vector<uint32_t> restoreIndices(const StateReader& reader, StateName name, size_t particles) {
  std::vector<uint32_t> read = reader.array<uint32_t>(name);
  if (std::any_of(read.begin(), read.end(), [&](uint32_t i) { return i >= particles; }))
    StateReader::fail(name, "names a particle that there is not");
  return read;
}

/// What runs at the same time shares no particle: `color(k)` of the place k.
template <class ColourOf>
void requireApart(StateName name, std::span<const uint32_t> particles, size_t count, ColourOf&& colourOf) {
  std::vector<size_t> last(count, 0);
  for (size_t k = 0; k < particles.size(); ++k) {
    size_t& colour = last[particles[k]];
    const size_t now = colourOf(k) + 1;
    if (colour == now) StateReader::fail(name, "names a particle twice in one colour");
    colour = now;
  }
}

}  // namespace

void GroupLists::save(StateWriter& writer, std::string_view room) const {
  saveStarts(writer, {room, "begin"}, m_begin);
  saveStarts(writer, {room, "colours"}, m_colourStart);
  writer.array({room, "particles"}, m_particles);
  writer.array({room, "body"}, m_body);
  writer.array({room, "changed"}, m_changed);
  saveColumns(writer, {room, "values"}, m_values, count());
  saveColumns(writer, {room, "member_values"}, m_memberValues, m_particles.size());
}

void GroupLists::restore(const StateReader& reader, std::string_view room, size_t particles) {
  m_particles = restoreIndices(reader, {room, "particles"}, particles);
  m_begin = restoreStarts(reader, {room, "begin"}, m_particles.size());
  for (size_t g = 0; g < count(); ++g) {
    if (m_begin[g] == m_begin[g + 1]) StateReader::fail({room, "begin"}, "has a group without members");
  }
  m_colourStart = restoreStarts(reader, {room, "colours"}, count());
  m_body = reader.array<uint32_t>({room, "body"}, count(), 1);
  m_changed = reader.array<uint8_t>({room, "changed"}, count(), 1);
  restoreColumns(reader, {room, "values"}, m_values, count());
  restoreColumns(reader, {room, "member_values"}, m_memberValues, m_particles.size());
  size_t group = 0, colour = 0;
  requireApart({room, "particles"}, m_particles, particles, [&](size_t k) {
    while (k >= m_begin[group + 1]) ++group;
    while (group >= m_colourStart[colour + 1]) ++colour;
    return colour;
  });
}

void ConstraintSystem::saveParameters(StateWriter& writer, std::string_view room, const Set& set) {
  size_t count = 0;
  for (const std::vector<double>& own : set.bodyParameters) count += own.size();
  writer.open({room, "parameter_counts"}, StateType::UInt32, set.bodyParameters.size());
  for (const std::vector<double>& own : set.bodyParameters) writer.put(static_cast<uint32_t>(own.size()));
  writer.close();
  writer.open({room, "parameters"}, StateType::Float64, count);
  for (const std::vector<double>& own : set.bodyParameters) writer.put(own.data(), own.size() * sizeof(double));
  writer.close();
}

void ConstraintSystem::restoreParameters(const StateReader& reader, std::string_view room, Set& set) {
  const std::vector<uint32_t> counts = reader.array<uint32_t>({room, "parameter_counts"});
  StateRuns<double> all(reader, {room, "parameters"});
  set.bodyParameters.resize(std::max({set.bodyParameters.size(), counts.size(), set.used.size()}));
  for (size_t body = 0; body < counts.size(); ++body) {
    const std::span<const double> saved = all.next(counts[body]);
    if (!saved.empty() && saved.size() != set.parameters.size() && saved.size() != set.plugin->parameters().count)
      StateReader::fail({room, "parameter_counts"}, "is not that of the plugin's parameters");
    std::vector<double>& own = set.bodyParameters[body];
    if (own.empty()) own.assign(saved.begin(), saved.end());
  }
  all.done();
  refreshParameters(set);
}

void ConstraintSystem::save(StateWriter& writer) const {
  writer.texts("constraints/sets", m_sets.size(), [&](size_t s) -> const std::string& { return m_sets[s].name; });
  writer.open("constraints/put_aside", StateType::UInt8, m_sets.size());
  for (const Set& set : m_sets) writer.put(static_cast<uint8_t>(set.disabled ? 1 : 0));
  writer.close();
  for (size_t s = 0; s < m_sets.size(); ++s) {
    const Set& set = m_sets[s];
    const Room room(s);
    writer.array({room, "used"}, set.used);
    saveParameters(writer, room, set);
    if (set.groups) set.groups->save(writer, room);
    if (!set.structural) continue;
    writer.array({room, "particles"}, set.particles);
    saveStarts(writer, {room, "colours"}, set.colourStart);
    saveColumns(writer, {room, "values"}, set.values, set.count);
  }
  if (!m_cuts.empty()) writer.array("constraints/cuts", m_cuts.pairs());
}

void ConstraintSystem::restoreLists(const StateReader& reader, std::string_view room, Set& set,
                                    const ParticleStore& store) {
  set.particles = restoreIndices(reader, {room, "particles"}, store.size());
  if (set.particles.size() % set.arity != 0)
    StateReader::fail({room, "particles"}, "is not cut into " + std::to_string(set.arity) + " particles each");
  set.count = set.particles.size() / set.arity;
  set.colourStart = restoreStarts(reader, {room, "colours"}, set.count);
  restoreColumns(reader, {room, "values"}, set.values, set.count);
  set.runs.clear();
  for (size_t colour = 0; colour + 1 < set.colourStart.size(); ++colour) {
    for (size_t k = set.colourStart[colour]; k < set.colourStart[colour + 1]; ++k) {
      const uint32_t body = store.body()[set.particles[k * set.arity]];
      if (k == set.colourStart[colour] || body != set.runs.back().body) set.runs.push_back({k, body});
    }
  }
  advance(0);
  size_t colour = 0;
  requireApart({room, "particles"}, set.particles, store.size(), [&](size_t k) {
    while (k / set.arity >= set.colourStart[colour + 1]) ++colour;
    return colour;
  });
  set.coloursInUse.clear();
  set.keys.clear();
  set.lookedUp = false;
}

void ConstraintSystem::restore(const StateReader& reader, const ParticleStore& store) {
  const std::vector<std::string> names = reader.texts("constraints/sets");
  const std::vector<uint8_t> aside = reader.array<uint8_t>("constraints/put_aside", names.size(), 1);
  for (size_t s = 0; s < names.size(); ++s) {
    if (s >= m_sets.size() || m_sets[s].name != names[s])
      StateReader::fail("constraints/sets", "has '" + names[s] + "', which is missing here");
  }
  for (size_t s = 0; s < names.size(); ++s) {
    Set& set = m_sets[s];
    const Room room(s);
    set.used = reader.array<uint8_t>({room, "used"});
    restoreParameters(reader, room, set);
    advance(0);
    if (set.groups) set.groups->restore(reader, room, store.size());
    if (set.structural) restoreLists(reader, room, set, store);
    if (set.disabled) dropAll(set);
    set.disabled = set.disabled || aside[s] != 0;
  }
  restoreThin();
  m_cuts = Cuts(reader.has("constraints/cuts") ? reader.array<uint64_t>("constraints/cuts") : std::vector<uint64_t>{});
  forgetMembers();
  m_graphValid = false;
}

void ConstraintSystem::restoreThin() {
  m_thin.clear();
  for (const Set& set : m_sets) {
    m_thin.resize(std::max(m_thin.size(), set.used.size()), 0);
    for (size_t body = 0; set.thin && body < set.used.size(); ++body) m_thin[body] |= set.used[body];
  }
}

void ConstraintSystem::lookUp(Set& set, const ParticleStore& store) const {
  if (set.lookedUp) return;
  set.lookedUp = true;
  for (size_t colour = 0; colour + 1 < set.colourStart.size(); ++colour) {
    if (colour / 64 >= set.coloursInUse.size()) set.coloursInUse.emplace_back();
    std::vector<uint64_t>& used = set.coloursInUse[colour / 64];
    for (size_t k = set.colourStart[colour]; k < set.colourStart[colour + 1]; ++k) {
      const uint32_t* particles = set.particles.data() + k * set.arity;
      set.keys.insert(keyOf(set, store, particles));
      for (size_t a = 0; a < set.arity; ++a) {
        const uint32_t id = store.id()[particles[a]];
        if (id >= used.size()) used.resize(id + size_t{1} + used.size() / 2, 0);
        used[id] |= uint64_t{1} << (colour % 64);
      }
    }
  }
}

}  // namespace ps
