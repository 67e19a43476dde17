// SPDX-License-Identifier: Apache-2.0
// Pairs are measured between nearest images, so that a particle may lie in any of them. It is brought back all the same
// for the sake of single precision: what is free whenever particles are sorted, what is tied together as one and only
// when it has gone far, so that plugins find their particles at home in one image.
#include "core/solver/frame/solverimpl.h"

#include <cmath>
#include <numeric>

namespace ps {
namespace {

/// Boxes that something may lie away from its own, at the cost of two bits of position.
constexpr double kFarImages = 4;

struct Images {
  double x, y, z;
};

Images imagesOf(const ParticleStore& store, size_t i) {
  const api::Float4& p = store.position()[i];
  return {store.period().imageOf(p.x, 0), store.period().imageOf(p.y, 1), store.period().imageOf(p.z, 2)};
}

void moveBack(ParticleStore& store, size_t i, const Images& by) {
  const Period& period = store.period();
  for (api::Float4* place : {store.position() + i, store.previous() + i}) {
    place->x = static_cast<float>(double{place->x} - by.x * double{period.length(0)});
    place->y = static_cast<float>(double{place->y} - by.y * double{period.length(1)});
    place->z = static_cast<float>(double{place->z} - by.z * double{period.length(2)});
  }
}

bool movesNot(const ParticleStore& store, size_t i) {
  const api::Float4& v = store.velocity()[i];
  return v.w == 0 && v.x == 0 && v.y == 0 && v.z == 0;
}

}  // namespace

bool Solver::Impl::strayed() const {
  for (size_t i = 0; i < store.size(); ++i) {
    if (movesNot(store, i)) continue;
    const Images by = imagesOf(store, i);
    if (std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}) > kFarImages) return true;
  }
  return false;
}

void Solver::Impl::wrapIntoPeriod() {
  const StructureGraph& graph = constraints.graph(store.size());
  bool far = false;
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (movesNot(store, i)) continue;
    const Images by = imagesOf(store, i);
    if (by.x == 0 && by.y == 0 && by.z == 0) continue;
    if (graph.isFree(i))
      moveBack(store, i, by);
    else
      far = far || std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}) > kFarImages;
  }
  if (far) bringPiecesHome(graph);
}

void Solver::Impl::bringPiecesHome(const StructureGraph& graph) {
  const size_t n = store.size();
  std::vector<uint32_t> parent(n), firstOf;
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto unite = [&](uint32_t i, uint32_t j) {
    const uint32_t a = find(i), b = find(j);
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t k = graph.begin[i]; k < graph.begin[i + 1]; ++k) unite(i, graph.partner[k]);
    for (uint32_t k = graph.groupBegin[i]; k < graph.groupBegin[i + 1]; ++k) {
      if (graph.group[k] >= firstOf.size()) firstOf.resize(graph.group[k] + size_t{1}, static_cast<uint32_t>(n));
      uint32_t& first = firstOf[graph.group[k]];
      if (first == n) first = i;
      unite(i, first);
    }
  }
  // The lowest id leads its piece; what hangs on something that stands still is not moved.
  std::vector<uint32_t> leader(n, static_cast<uint32_t>(n));
  std::vector<uint8_t> held(n, 0);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t piece = find(i);
    if (leader[piece] == n || store.id()[i] < store.id()[leader[piece]]) leader[piece] = i;
    if (movesNot(store, i)) held[piece] = 1;
  }
  std::vector<Images> by(n);
  for (uint32_t i = 0; i < n; ++i) by[i] = imagesOf(store, leader[find(i)]);
  for (uint32_t i = 0; i < n; ++i) {
    if (!graph.isFree(i) && held[find(i)] == 0) moveBack(store, i, by[i]);
  }
}

}  // namespace ps
