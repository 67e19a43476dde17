// SPDX-License-Identifier: Apache-2.0
#include "core/particles/neighbours.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statestream.h"
#include "core/particles/neighbourkernels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

namespace ps {
namespace {

constexpr size_t kSpareSlots = 16;
/// Of what was needed, one part in so many is kept spare.
constexpr size_t kSpareShare = 32;
/// Rooms that chunks have left may be one part in so many of what all need.
constexpr size_t kMostEmpty = 4;

/// Entries of a list that is made anew in its place; a longer one is made with those of its chunk.
constexpr uint32_t kLongestRenewed = 1024;
/// Share of all that stand still from which on lists are looked at that need not be made.
constexpr double kLeastStanding = 0.25;

constexpr const char* kBuiltBlock = "neighbours/built";

std::span<const api::Float4> placesOf(const ParticleStore& store) { return {store.position(), store.size()}; }

}  // namespace

void Neighbours::configure(double support, double skin) {
  m_support = support;
  m_skin = skin;
  m_built.clear();
}

void Neighbours::assignCells(std::span<const api::Float4> position, const Period& period) {
  m_grid.sort(position.size(), (m_support + m_skin) * kCellMargin, period, [&](size_t i) {
    return period.wrapped({position[i].x, position[i].y, position[i].z});
  });
}

void Neighbours::sortAndBuild(ParticleStore& store) {
  assignCells(placesOf(store), store.period());
  m_lastOrder.assign(m_grid.order().begin(), m_grid.order().end());
  if (!m_grid.sorted()) {
    store.permute(m_grid.order());
    m_grid.reorder();
    m_built.clear();  // of another order
  }
  makeLists(placesOf(store), store.period());
}

void Neighbours::build(const ParticleStore& store) {
  assignCells(placesOf(store), store.period());
  makeLists(placesOf(store), store.period());
}

void Neighbours::buildOf(const ParticleStore& store, size_t first) {
  const size_t n = store.size();
  if (searchesAll(n - first, n)) return build(store);
  assignCells(placesOf(store), store.period());
  m_built.clear();
  loadSlots(placesOf(store), store.period());
  for (std::vector<uint32_t>* v : {&m_begin, &m_last, &m_end}) v->assign(n, 0);
  m_slots = 0;
  std::vector<uint32_t> which(n - first);
  std::iota(which.begin(), which.end(), static_cast<uint32_t>(first));
  searchEach(searchGrid(store.period()), which);
  std::vector<uint8_t> isNear(first, 0);
  for (size_t i = first; i < n; ++i)
    for (uint32_t q = m_begin[i]; q < m_last[i]; ++q)
      if (m_index[q] < first) isNear[m_index[q]] = 1;
  findIndices(first, which, [&](size_t i) { return isNear[i] != 0; });
  searchEach(searchGrid(store.period()), which);
}

/// Behind what there is. Each is searched twice: how much room it needs is not known from the last time, and what is
/// known of chunks is kept for the lists of all.
void Neighbours::searchEach(const SearchGrid& grid, std::span<const uint32_t> which) {
  std::vector<Room> rooms(which.size());
  Progress* progress = t_progress;  // of this thread; others help it
  const auto search = [&](size_t k) {
    const size_t i = which[k];
    return searchLists(
        grid, i, i + 1,
        {rooms[k].first, rooms[k].count, m_index.data(), m_begin.data(), m_last.data(), m_end.data(), dummy()});
  };
  forChunks(which.size(), grain::kNeighbours, [&](size_t begin, size_t end) {
    if (progress) progress->advance(end - begin);
    for (size_t k = begin; k < end; ++k) rooms[k].count = static_cast<uint32_t>(search(k));
  });
  for (Room& room : rooms) room = takeRoom(room.count);
  makeRoom(true);
  forChunks(which.size(), grain::kNeighbours, [&](size_t begin, size_t end) {
    for (size_t k = begin; k < end; ++k) search(k);
  });
}

void Neighbours::save(StateWriter& writer, bool valid) const {
  const std::span<const api::Float4> built(m_built.data(), valid ? m_built.size() : 0);
  writer.open(kBuiltBlock, StateType::Float4, built.size());
  writer.put(built.data(), built.size_bytes());
  writer.close();
}

void Neighbours::restore(const StateReader& reader, const ParticleStore& store) {
  m_built.clear();
  const size_t count = reader.count(kBuiltBlock);
  if (count == 0) return;
  std::vector<api::Float4> built(store.size());
  reader.read(kBuiltBlock, StateType::Float4, built.data(), built.size());
  assignCells(built, store.period());
  makeLists(built, store.period());
}

void Neighbours::loadSlots(std::span<const api::Float4> position, const Period& period) {
  const size_t n = position.size();
  m_slotOf.resize(n);
  for (std::vector<float>* v : {&m_x, &m_y, &m_z}) v->resize(n + kSpareSlots);
  forChunks(n, grain::kParticles, [&](size_t first, size_t last) {
    for (size_t slot = first; slot < last; ++slot) {
      const size_t i = m_grid.order()[slot];
      const api::Double3 p = period.wrapped({position[i].x, position[i].y, position[i].z});
      m_x[slot] = static_cast<float>(p.x);
      m_y[slot] = static_cast<float>(p.y);
      m_z[slot] = static_cast<float>(p.z);
      m_slotOf[i] = static_cast<uint32_t>(slot);
    }
  });
}

/// Chunks get room for what they needed the last time and a little more; of one that is new nothing is known yet.
void Neighbours::layOut(size_t chunks) {
  m_needs.resize(chunks, 0);
  m_rooms.resize(chunks);
  m_slots = 0;
  for (size_t c = 0; c < chunks; ++c) giveRoom(c, m_needs[c] + m_needs[c] / kSpareShare);
  makeRoom(false);
}

/// At the end, for so many entries.
void Neighbours::giveRoom(size_t chunk, size_t entries) {
  m_rooms[chunk] = takeRoom((entries + kListPad - 1) / kListPad * kListPad);
}

Neighbours::Room Neighbours::takeRoom(size_t entries) {
  const Room room{static_cast<uint32_t>(m_slots), static_cast<uint32_t>(entries)};
  m_slots += entries;
  if (m_slots <= std::numeric_limits<uint32_t>::max() - kListPad) return room;
  m_needs.clear();  // they say nothing of matter that has been mended
  throw Error("particles have more neighbours than lists can hold (" + std::to_string(m_slots / 1000000) +
              " million): make the particle spacing larger, or look for matter that has been pressed together");
}

/// Lists that are there already stay where they are, if they are to be kept. Room is not given back: it would be zeroed
/// when it is wanted again.
void Neighbours::makeRoom(bool keepLists) {
  const size_t size = m_slots + kListPad;
  if (size <= m_index.size()) return;
  if (!keepLists) RoomVector<uint32_t>().swap(m_index);  // before there are the next ones; {} would keep its memory
  RoomVector<uint32_t> next(size + size / kSpareShare);
  forChunks(m_index.size(), kRoomChunk, [&](size_t first, size_t last) {
    std::copy(m_index.data() + first, m_index.data() + last, next.data() + first);
  });
  zeroFrom(next, m_index.size());
  m_index.swap(next);
}

/// What has found too little room gets as much as it has turned out to need. False where all have found enough.
bool Neighbours::giveMoreRoom() {
  m_short.assign(m_rooms.size(), 0);
  bool any = false;
  for (size_t c = 0; c < m_rooms.size(); ++c) {
    if (m_needs[c] <= m_rooms[c].count) continue;
    giveRoom(c, m_needs[c]);
    m_short[c] = 1;
    any = true;
  }
  if (any) makeRoom(true);
  return any;
}

/// Lists are of indices in order of cells: where all around stand as they stood, and cells meet where they met, they
/// come out the same, however many cells the box has.
void Neighbours::findStirred(std::span<const api::Float4> position, const Period& period) {
  m_stirred.clear();
  const size_t n = position.size();
  const std::array<double, 4> cells = {m_grid.perMetre(0), m_grid.low(0), m_grid.low(1), m_grid.low(2)};
  const bool sameCells = cells == m_cells && !period.any();
  m_cells = cells;
  if (m_built.size() != n || !sameCells || n == 0) return;
  const auto stands = [&](size_t i) {
    const api::Float4 &a = position[i], &b = m_built[i];
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  const double standing = parallelSum(n, grain::kNumbers, [&](size_t first, size_t last) {
    size_t count = 0;
    for (size_t i = first; i < last; ++i) count += stands(i) ? 1 : 0;
    return static_cast<double>(count);
  });
  if (standing < kLeastStanding * static_cast<double>(n)) return;
  m_stirred.assign(m_grid.cell(0, 0, m_grid.cells(2)), 0);
  const auto stir = [&](const api::Float4& p) {
    const int at[3] = {m_grid.along(p.x, 0), m_grid.along(p.y, 1), m_grid.along(p.z, 2)};
    for (int z = std::max(at[2] - 1, 0); z <= std::min(at[2] + 1, m_grid.cells(2) - 1); ++z) {
      for (int y = std::max(at[1] - 1, 0); y <= std::min(at[1] + 1, m_grid.cells(1) - 1); ++y) {
        for (int x = std::max(at[0] - 1, 0); x <= std::min(at[0] + 1, m_grid.cells(0) - 1); ++x) {
          const std::atomic_ref cell(m_stirred[m_grid.cell(x, y, z)]);
          if (cell.load(std::memory_order_relaxed) == 0) cell.store(1, std::memory_order_relaxed);
        }
      }
    }
  };
  forChunks(n, grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (stands(i)) continue;
      stir(position[i]);
      stir(m_built[i]);
    }
  });
}

/// Makes the lists of a chunk anew where somebody has moved, each in the place that it has. False where one of them has
/// become too long for that.
bool Neighbours::renew(const SearchGrid& grid, size_t first, size_t last) {
  std::array<uint32_t, kLongestRenewed> list;
  const Room& chunk = m_rooms[first / grain::kNeighbours];
  const std::span<const uint32_t> cellOf = m_grid.cellOfEach();
  for (size_t i = first; i < last; ++i) {
    if (m_stirred[cellOf[i]] == 0) continue;
    const uint32_t begin = m_begin[i], end = i + 1 < last ? m_begin[i + 1] : chunk.first + chunk.count;
    const ListRoom room{0, kLongestRenewed, list.data(), m_begin.data(), m_last.data(), m_end.data(), dummy()};
    if (searchLists(grid, i, i + 1, room) > kLongestRenewed || m_end[i] > end - begin) return false;
    std::copy(list.begin(), list.begin() + m_end[i], m_index.begin() + begin);
    m_begin[i] = begin;
    m_last[i] += begin;
    m_end[i] += begin;
  }
  return true;
}

SearchGrid Neighbours::searchGrid(const Period& period) const {
  const double radius = m_support + m_skin;
  return {m_x.data(),
          m_y.data(),
          m_z.data(),
          m_grid.order().data(),
          m_slotOf.data(),
          m_grid.cellOfEach().data(),
          m_grid.starts().data(),
          {m_grid.cells(0), m_grid.cells(1), m_grid.cells(2)},
          {m_grid.low(0), m_grid.low(1), m_grid.low(2)},
          {m_grid.perMetre(0), m_grid.perMetre(1), m_grid.perMetre(2)},
          static_cast<float>(radius * radius),
          {period.length(0), period.length(1), period.length(2)}};
}

void Neighbours::makeLists(std::span<const api::Float4> position, const Period& period) {
  const size_t n = position.size();
  findStirred(position, period);
  m_built.clear();  // there are no lists until all are whole
  loadSlots(position, period);
  advance(n);
  const SearchGrid grid = searchGrid(period);
  for (std::vector<uint32_t>* v : {&m_begin, &m_last, &m_end}) v->resize(n);
  Progress* progress = t_progress;  // of this thread; others help it
  bool all = true;
  const auto search = [&](size_t first, size_t last) {
    if (progress) progress->advance(last - first);
    const size_t c = first / grain::kNeighbours;
    if (all ? !m_stirred.empty() && renew(grid, first, last) : m_short[c] == 0) return;
    const ListRoom room{m_rooms[c].first, m_rooms[c].count, m_index.data(), m_begin.data(),
                        m_last.data(),    m_end.data(),     dummy()};
    m_needs[c] = static_cast<uint32_t>(searchLists(grid, first, last, room));
  };
  // What outgrew its room has left it empty.
  const size_t needed = std::accumulate(m_needs.begin(), m_needs.end(), size_t{0});
  if (m_slots > needed + needed / kMostEmpty + kListPad * m_rooms.size()) m_stirred.clear();
  if (m_stirred.empty()) layOut(chunkCount(n, grain::kNeighbours));
  forChunks(n, grain::kNeighbours, search);
  progress = nullptr;
  all = false;
  if (giveMoreRoom()) forChunks(n, grain::kNeighbours, search);
  m_built.resize(n);
  forChunks(n, grain::kParticles, [&](size_t first, size_t last) {
    std::copy(position.begin() + static_cast<ptrdiff_t>(first), position.begin() + static_cast<ptrdiff_t>(last),
              m_built.begin() + static_cast<ptrdiff_t>(first));
  });
}

bool Neighbours::stale(const ParticleStore& store) const {
  const size_t n = store.size();
  if (m_built.size() != n) return true;
  const api::Float4* position = store.position();
  return anyChunk(n, grain::kParticles, [&](size_t first, size_t last) {
    float most = 0;
    for (size_t i = first; i < last; ++i) {
      const float x = position[i].x - m_built[i].x, y = position[i].y - m_built[i].y, z = position[i].z - m_built[i].z;
      const float d2 = x * x + y * y + z * z;
      most = d2 > most ? d2 : most;
    }
    return double{most} > 0.25 * m_skin * m_skin;
  });
}

api::NeighbourView Neighbours::view() const {
  return {m_begin.data(), m_last.data(), m_end.data(), m_index.data(), static_cast<float>(m_support + m_skin), m_slots};
}

}  // namespace ps
