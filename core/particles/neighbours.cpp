// SPDX-License-Identifier: Apache-2.0
#include "core/particles/neighbours.h"

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/statestream.h"
#include "core/particles/neighbourkernels.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

constexpr size_t kSpareSlots = 16;

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
  if (!m_grid.sorted()) {
    store.permute(m_grid.order());
    m_grid.reorder();
  }
  searchLists(placesOf(store), store.period());
}

void Neighbours::build(const ParticleStore& store) {
  assignCells(placesOf(store), store.period());
  searchLists(placesOf(store), store.period());
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
  searchLists(built, store.period());
}

void Neighbours::searchLists(std::span<const api::Float4> position, const Period& period) {
  const size_t n = position.size();
  m_cellOfSlot.resize(n);
  for (std::vector<float>* v : {&m_x, &m_y, &m_z}) v->resize(n + kSpareSlots);
  forChunks(n, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t slot = first; slot < last; ++slot) {
      const size_t i = indexOf(slot);
      const api::Double3 p = period.wrapped({position[i].x, position[i].y, position[i].z});
      m_x[slot] = static_cast<float>(p.x);
      m_y[slot] = static_cast<float>(p.y);
      m_z[slot] = static_cast<float>(p.z);
      m_cellOfSlot[slot] = m_grid.cellOfEach()[i];
    }
  });
  advance(n);
  const double radius = m_support + m_skin;
  const SearchGrid grid{m_x.data(),
                        m_y.data(),
                        m_z.data(),
                        m_cellOfSlot.data(),
                        m_grid.starts().data(),
                        {m_grid.cells(0), m_grid.cells(1), m_grid.cells(2)},
                        static_cast<float>(radius * radius),
                        {period.length(0), period.length(1), period.length(2)}};
  const size_t chunks = chunkCount(n, grain::kNeighbours);
  if (m_chunks.size() < chunks) m_chunks.resize(chunks);
  m_counts.resize(n);
  Progress* const progress = t_progress;  // of this thread; others help it
  const auto search = [&](size_t first, size_t last) {
    if (progress) progress->advance(last - first);
    Chunk& chunk = m_chunks[first / grain::kNeighbours];
    searchSlots(grid, first, last, m_counts.data() + first, chunk.found);
  };
  parallelFor(n, grain::kNeighbours, std::cref(search));
  layOutLists(n);
  const auto write = [&](size_t first, size_t last) {
    writeLists(m_chunks[first / grain::kNeighbours].found.data(), first, last);
  };
  parallelFor(n, grain::kNeighbours, std::cref(write));
  m_built.resize(n);
  if (position.data() != m_built.data()) {
    forChunks(n, grain::kNumbers, [&](size_t first, size_t last) {
      std::copy(position.begin() + static_cast<ptrdiff_t>(first), position.begin() + static_cast<ptrdiff_t>(last),
                m_built.begin() + static_cast<ptrdiff_t>(first));
    });
  }
}

void Neighbours::layOutLists(size_t count) {
  m_begin.resize(count);
  m_last.resize(count);
  m_end.resize(count);
  for (size_t slot = 0; slot < count; ++slot) m_last[indexOf(slot)] = m_counts[slot];
  uint32_t next = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t found = m_last[i];
    m_begin[i] = next;
    m_last[i] = next + found;
    next += static_cast<uint32_t>((found + kListPad - 1) / kListPad * kListPad);
    m_end[i] = next;
  }
  m_index.resize(next);
}

void Neighbours::writeLists(const uint32_t* found, size_t firstSlot, size_t lastSlot) {
  const uint32_t dummy = static_cast<uint32_t>(m_begin.size());
  for (size_t slot = firstSlot; slot < lastSlot; found += m_counts[slot++]) {
    const size_t i = indexOf(slot), count = m_counts[slot];
    uint32_t *out = m_index.data() + m_begin[i], *last = m_index.data() + m_last[i];
    if (m_grid.sorted()) {
      std::copy(found, found + count, out);
    } else {
      for (size_t k = 0; k < count; ++k) out[k] = m_grid.order()[found[k]];
    }
    std::fill(last, m_index.data() + m_end[i], dummy);
  }
}

bool Neighbours::stale(const ParticleStore& store) const {
  const size_t n = store.size();
  if (m_built.size() != n) return true;
  const api::Float4* position = store.position();
  return anyChunk(n, grain::kNumbers, [&](size_t first, size_t last) {
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
  return {m_begin.data(), m_last.data(), m_end.data(), m_index.data(), static_cast<float>(m_support + m_skin)};
}

}  // namespace ps
