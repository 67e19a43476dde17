// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/grouplists.h"

#include "core/base/parallelarrays.h"
#include "core/base/progress.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <utility>

namespace ps {

GroupLists::GroupLists(size_t values, size_t memberValues) : m_values(values), m_memberValues(memberValues) {}

void GroupLists::clear() { *this = GroupLists(m_values.size(), m_memberValues.size()); }

void GroupLists::fill(Batch& batch, size_t first, size_t last) {
  for (size_t v = 0; v < m_values.size(); ++v) batch.values[v] = m_values[v].data() + first;
  for (size_t v = 0; v < m_memberValues.size(); ++v) batch.memberValues[v] = m_memberValues[v].data();
  batch.view = {last - first,        m_begin.data() + first,    m_particles.data(),
                batch.values.data(), batch.memberValues.data(), m_changed.data() + first};
}

void GroupLists::apply(const Edits& edits, std::span<const uint32_t> body) {
  if (edits.empty()) return;
  std::vector<Source> sources;
  sources.reserve(count() + edits.ends.size());
  for (size_t g = 0; g < count(); ++g) {
    if (edits.removed.empty() || edits.removed[g] == 0)
      sources.push_back({members(g), m_begin[g], static_cast<uint32_t>(g), m_body[g], false});
  }
  for (size_t g = 0, begin = 0; g < edits.ends.size(); begin = edits.ends[g++]) {
    const std::span particles(edits.particles.data() + begin, edits.ends[g] - begin);
    sources.push_back({particles, begin, static_cast<uint32_t>(g), body[particles[0]], true});
  }
  arrange(sources, edits, body.size());
}

void GroupLists::bodiesChanged(std::span<const uint32_t> body) {
  std::vector<Source> sources;
  for (size_t g = 0; g < count(); ++g)
    sources.push_back({members(g), m_begin[g], static_cast<uint32_t>(g), body[m_particles[m_begin[g]]], false});
  arrange(sources, {}, body.size());
}

/// Puts groups in order of colour and of body.
void GroupLists::arrange(const std::vector<Source>& sources, const Edits& edits, size_t particles) {
  std::vector<size_t> colourOf(sources.size()), order(sources.size());
  const size_t colours = colourAll(sources, particles, colourOf);
  for (size_t s = 0; s < order.size(); ++s) order[s] = s;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return colourOf[a] != colourOf[b] ? colourOf[a] < colourOf[b] : sources[a].body < sources[b].body;
  });
  GroupLists made(m_values.size(), m_memberValues.size());
  made.m_colourStart.assign(colours + 1, 0);
  for (const size_t s : order) {
    const Source& source = sources[s];
    ++made.m_colourStart[colourOf[s] + 1];
    made.m_begin.push_back(made.m_begin.back() + source.particles.size());
    made.m_changed.push_back(source.added ? uint8_t{0} : m_changed[source.group]);
    made.m_body.push_back(source.body);
    for (size_t v = 0; v < m_values.size(); ++v)
      made.m_values[v].push_back(source.added ? edits.values[source.group * m_values.size() + v]
                                              : m_values[v][source.group]);
  }
  for (size_t c = 0; c < colours; ++c) made.m_colourStart[c + 1] += made.m_colourStart[c];
  made.m_particles = std::move(m_spareParticles);
  made.m_memberValues.swap(m_spareValues);
  made.m_memberValues.resize(m_memberValues.size());
  made.copyMembers(*this, sources, order, edits);
  made.m_spareParticles.swap(m_particles);
  made.m_spareValues.swap(m_memberValues);
  *this = std::move(made);
  if (!t_progress) return;  // of a scene in the making: there may be millions of them
  m_spareParticles = {};
  m_spareValues.clear();
}

/// The first colour that no group with one of its particles has.
size_t GroupLists::colourAll(const std::vector<Source>& sources, size_t particles, std::vector<size_t>& colourOf) {
  if (sources.empty()) return 0;
  if (!anyShared(sources, particles)) return 1;  // as of rigid bodies
  std::vector<std::vector<uint64_t>> used;       // [word of 64 colours][particle]
  size_t colours = 0;
  for (size_t s = 0; s < sources.size(); ++s) {
    advance(0);
    for (size_t word = 0;; ++word) {
      if (word == used.size()) used.emplace_back(particles, 0);
      uint64_t inUse = 0;
      for (const uint32_t i : sources[s].particles) inUse |= used[word][i];
      if (inUse == ~uint64_t{0}) continue;
      const size_t bit = static_cast<size_t>(std::countr_one(inUse));
      for (const uint32_t i : sources[s].particles) used[word][i] |= uint64_t{1} << bit;
      colourOf[s] = 64 * word + bit;
      break;
    }
    colours = std::max(colours, colourOf[s] + 1);
  }
  return colours;
}

bool GroupLists::anyShared(const std::vector<Source>& sources, size_t particles) {
  std::vector<size_t> begin{0};
  for (const Source& source : sources) begin.push_back(begin.back() + source.particles.size());
  if (begin.back() > particles) return true;
  std::vector<uint8_t> seen(particles, 0);
  return anyChunk(begin.back(), grain::kNumbers, [&](size_t first, size_t last) {
    bool shared = false;
    eachFlatPart(begin, first, last, [&](size_t s, size_t from, size_t to) {
      for (size_t k = from; k < to; ++k) {
        std::atomic_ref<uint8_t> mark(seen[sources[s].particles[k]]);
        shared = mark.exchange(1, std::memory_order_relaxed) != 0 || shared;
      }
    });
    return shared;
  });
}

/// From where they were, row by row or column by column.
void GroupLists::copyMembers(const GroupLists& old, const std::vector<Source>& sources, std::span<const size_t> order,
                             const Edits& edits) {
  const size_t total = m_begin.back(), columns = m_memberValues.size();
  lengthen(m_particles, total);
  for (auto& column : m_memberValues) lengthen(column, total);
  const auto copy = [&](size_t g, size_t from, size_t to) {
    const Source& source = sources[order[g]];
    const size_t place = m_begin[g] + from, n = to - from, before = source.from + from;
    std::copy_n(source.particles.data() + from, n, m_particles.data() + place);
    for (size_t v = 0; v < columns; ++v) {
      float* column = m_memberValues[v].data() + place;
      if (!source.added) {
        std::copy_n(old.m_memberValues[v].data() + before, n, column);
        continue;
      }
      const float* rows = edits.memberValues.data() + before * columns + v;
      for (size_t k = 0; k < n; ++k) column[k] = rows[k * columns];
    }
  };
  const auto copyAll = [&](size_t begin, size_t end) {
    forChunks(end - begin, grain::kNumbers,
              [&](size_t first, size_t last) { eachFlatPart(m_begin, begin + first, begin + last, copy); });
  };
  if (!t_progress) return copyAll(0, total);
  // What is added is told twice, as what is coloured and what is put in order.
  inSlices(0, edits.particles.size(), [](size_t, size_t) {});
  inSlices(0, total, copyAll);
}

void GroupLists::renumber(std::span<const uint32_t> newIndex) {
  size_t place = 0, group = 0, start = 0, g = 0;
  for (size_t c = 0; c < colours(); ++c) {
    for (; g < m_colourStart[c + 1]; ++g) {
      const size_t first = start, last = m_begin[g + 1], before = place;
      start = last;
      for (size_t k = first; k < last; ++k) {
        const uint32_t index = newIndex[m_particles[k]];
        if (index == kGone) continue;
        m_particles[place] = index;
        for (auto& column : m_memberValues) column[place] = column[k];
        ++place;
      }
      if (place == before) continue;
      m_changed[group] = m_changed[g] != 0 || place - before < last - first ? 1 : 0;
      m_body[group] = m_body[g];
      for (auto& column : m_values) column[group] = column[g];
      m_begin[++group] = place;
    }
    m_colourStart[c + 1] = group;  // never beyond g
  }
  m_particles.resize(place);
  m_begin.resize(group + 1);
  m_changed.resize(group);
  m_body.resize(group);
  for (auto& column : m_values) column.resize(group);
  for (auto& column : m_memberValues) column.resize(place);
}

void GroupLists::noteChanges(std::span<const uint8_t> marked) {
  for (size_t g = 0; g < count(); ++g) {
    const std::span<const uint32_t> all = members(g);
    if (std::any_of(all.begin(), all.end(), [&](uint32_t i) { return marked[i] != 0; })) m_changed[g] = 1;
  }
}

SplitGroups GroupLists::splitBy(const ParticleStore& store, const Edits& edits) const {
  SplitGroups split;
  const auto idsOf = [&](std::span<const uint32_t> indices) {
    std::vector<uint32_t> ids;
    for (const uint32_t i : indices) ids.push_back(store.id()[i]);
    return ids;
  };
  for (size_t g = 0; g < edits.removed.size(); ++g) {
    if (edits.removed[g] == 0) continue;
    CopiedGroup copied{idsOf(members(g)), {}, {}, {}};
    for (const auto& column : m_values) copied.values.push_back(column[g]);
    for (size_t k = m_begin[g]; k < m_begin[g + 1]; ++k) {
      for (const auto& column : m_memberValues) copied.memberValues.push_back(column[k]);
    }
    split.before.push_back(std::move(copied));
  }
  for (size_t g = 0, begin = 0; g < edits.ends.size(); begin = edits.ends[g++])
    split.after.push_back(idsOf(std::span(edits.particles).subspan(begin, edits.ends[g] - begin)));
  return split;
}

/// A group comes back where all that came of it is still what it was: where somebody has melted or frozen since, its
/// pieces stay, or else they would be tied twice.
void GroupLists::rejoin(const ParticleStore& store, const SplitGroups& split) {
  if (split.before.empty()) return;
  const auto sorted = [](std::vector<uint32_t> ids) {
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  std::map<std::vector<uint32_t>, size_t> present;  // by sorted ids
  for (size_t g = 0; g < count(); ++g) {
    std::vector<uint32_t> ids;
    for (const uint32_t i : members(g)) ids.push_back(store.id()[i]);
    present[sorted(std::move(ids))] = g;
  }
  Edits edits;
  edits.removed.assign(count(), 0);
  for (const CopiedGroup& copied : split.before) {
    std::vector<uint32_t> indices;
    for (const uint32_t id : copied.id) indices.push_back(static_cast<uint32_t>(store.indexOf(id)));
    bool whole = std::all_of(indices.begin(), indices.end(), [&](uint32_t i) { return i < store.size(); });
    const std::vector<uint32_t> all = sorted(copied.id);
    std::vector<size_t> pieces;
    for (const std::vector<uint32_t>& after : split.after) {
      const std::vector<uint32_t> ids = sorted(after);
      if (!std::includes(all.begin(), all.end(), ids.begin(), ids.end())) continue;
      const auto found = present.find(ids);
      whole = whole && found != present.end();
      if (whole) pieces.push_back(found->second);
    }
    if (!whole) continue;
    for (const size_t g : pieces) edits.removed[g] = 1;
    edits.particles.insert(edits.particles.end(), indices.begin(), indices.end());
    edits.ends.push_back(edits.particles.size());
    edits.values.insert(edits.values.end(), copied.values.begin(), copied.values.end());
    edits.memberValues.insert(edits.memberValues.end(), copied.memberValues.begin(), copied.memberValues.end());
  }
  apply(edits, {store.body(), store.size()});
}

std::vector<CopiedGroup> GroupLists::copy(const ParticleStore& store, std::span<const uint32_t> ascending) const {
  std::vector<CopiedGroup> copies;
  for (size_t g = 0; g < count(); ++g) {
    CopiedGroup copied;
    bool any = false;
    for (const uint32_t i : members(g)) {
      const bool extracted = std::binary_search(ascending.begin(), ascending.end(), i);
      copied.id.push_back(store.id()[i]);
      copied.extracted.push_back(extracted ? 1 : 0);
      any = any || extracted;
    }
    if (!any) continue;
    for (const auto& column : m_values) copied.values.push_back(column[g]);
    for (size_t k = m_begin[g]; k < m_begin[g + 1]; ++k) {
      for (const auto& column : m_memberValues) copied.memberValues.push_back(column[k]);
    }
    copies.push_back(std::move(copied));
  }
  return copies;
}

size_t GroupLists::homeOf(std::span<const uint8_t> companion) const {
  size_t home = count(), most = 0;
  for (size_t g = 0; g < count(); ++g) {
    size_t held = 0;
    for (const uint32_t i : members(g)) held += companion[i];
    // Of equals the smaller one: the rest of the group itself, not another that overlaps it.
    if (held == 0 || held < most || (held == most && members(g).size() >= members(home).size())) continue;
    home = g, most = held;
  }
  return home;
}

std::vector<uint8_t> GroupLists::putBack(const ParticleStore& store, std::span<const CopiedGroup> copies) {
  std::vector<uint8_t> isBack(store.size(), 0), companion;
  for (const CopiedGroup& copied : copies) {
    companion.assign(store.size(), 0);
    std::vector<uint32_t> index(copied.id.size());
    for (size_t k = 0; k < index.size(); ++k) {
      index[k] = static_cast<uint32_t>(store.indexOf(copied.id[k]));
      if (index[k] < store.size()) (copied.extracted[k] != 0 ? isBack : companion)[index[k]] = 1;
    }
    const size_t home = homeOf(companion);
    const bool alone = home == count();
    Edits edits;
    if (!alone) {
      edits.removed.assign(count(), 0);
      edits.removed[home] = 1;
      for (size_t k = m_begin[home]; k < m_begin[home + 1]; ++k) {
        edits.particles.push_back(m_particles[k]);
        for (const auto& column : m_memberValues) edits.memberValues.push_back(column[k]);
      }
      for (const auto& column : m_values) edits.values.push_back(column[home]);
    } else {
      edits.values = copied.values;
    }
    for (size_t k = 0; k < index.size(); ++k) {
      if (index[k] >= store.size() || (!alone && copied.extracted[k] == 0)) continue;
      edits.particles.push_back(index[k]);
      const float* row = copied.memberValues.data() + k * m_memberValues.size();
      edits.memberValues.insert(edits.memberValues.end(), row, row + m_memberValues.size());
    }
    if (edits.particles.empty()) continue;
    edits.ends.push_back(edits.particles.size());
    apply(edits, {store.body(), store.size()});
  }
  std::vector<uint8_t> returned(m_particles.size(), 0);
  for (size_t g = 0; g < count(); ++g) {
    for (size_t k = m_begin[g]; k < m_begin[g + 1]; ++k) {
      returned[k] = isBack[m_particles[k]];
      if (returned[k] != 0) m_changed[g] = 1;
    }
  }
  return returned;
}

}  // namespace ps
