// SPDX-License-Identifier: Apache-2.0
#include "clusterbuilder.h"

#include "rigidpieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ps::constraint {

using Model = ClusterModel;

void NewCluster::add(uint32_t particle, Vector rest, float volume) {
  particles.push_back(particle);
  for (const double c : {rest.x, rest.y, rest.z}) memberValues.push_back(static_cast<float>(c));
  memberValues.push_back(volume);
  memberValues.insert(memberValues.end(), Model::kMemberValueCount - Model::kDisplacementX, 0.0f);
}

void NewCluster::emit(Quaternion q, double volume, float scale, api::GroupSink& sink) const {
  float values[Model::kValueCount] = {};
  const double parts[] = {q.x, q.y, q.z, q.w, volume};
  for (size_t v = 0; v < std::size(parts); ++v) values[Model::kRotationX + v] = static_cast<float>(parts[v]);
  values[Model::kScale] = scale;
  sink.add(particles.data(), particles.size(), values, memberValues.data());
}

namespace {

using api::ConstraintContext;
using api::GroupBatch;
using api::Motion;
using api::ParticleView;

class Builder {
 public:
  Builder(const ConstraintContext& context, const ParticleView& p, api::Span<const uint32_t> members)
      : m_p(p),
        m_radius(context.parameters[ClusterModel::kRadius] * context.spacing),
        m_step(std::min(context.parameters[ClusterModel::kSpacing] * context.spacing, m_radius)),
        m_reach(NewCluster::kReach * context.spacing),
        m_members(members.size),
        m_isNew(p.count, 0),
        m_membership(p.count, 0) {
    for (const uint32_t i : members) m_isNew[i] = p.motion[i] == Motion::Solid ? 1 : 0;
    for (uint32_t i = 0; i < p.count; ++i) {
      if (p.body[i] == context.body && holds(p.motion[i])) m_body.push_back(i);
    }
  }
  void count(const GroupBatch& all) {
    for (size_t g = 0; g < all.count; ++g) {
      for (size_t k = all.begin[g]; k < all.begin[g + 1]; ++k) ++m_membership[all.particles[k]];
    }
  }
  void find(api::GroupSink& sink) {
    if (m_body.empty()) return;
    sortByCell(sink);
    Vector low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
    for (const uint32_t i : m_body) {
      if (m_isNew[i] == 0) continue;
      const Vector x = vectorOf(m_p.position[i]);
      low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
      high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
    }
    if (low.x > high.x) return;
    // As many points along each side as keep them no farther apart than asked, in the middle of it.
    const auto points = [&](double side) { return static_cast<int>(std::floor(side / m_step + 0.999)) + 1; };
    const std::array<int, 3> n{points(high.x - low.x), points(high.y - low.y), points(high.z - low.z)};
    const auto place = [&](double a, double b, int k, int of) {
      return of == 1 ? 0.5 * (a + b) : a + (b - a) * k / (of - 1);
    };
    for (int z = 0; z < n[2]; ++z) {
      for (int y = 0; y < n[1]; ++y) {
        for (int x = 0; x < n[0]; ++x) {
          around({place(low.x, high.x, x, n[0]), place(low.y, high.y, y, n[1]), place(low.z, high.z, z, n[2])});
        }
        const size_t rows = size_t{1} * n[1] * n[2], row = size_t{1} * z * n[1] + y;
        sink.advance(m_members * (row + 1) / rows - m_members * row / rows);
      }
    }
    for (const uint32_t i : m_body) {
      if (m_isNew[i] != 0 && m_membership[i] == 0) around(vectorOf(m_p.position[i]));
    }
  }
  void emit(api::GroupSink& sink) const {
    for (const std::vector<uint32_t>& found : m_found) {
      NewCluster cluster;
      double volume = 0;
      const Vector origin = vectorOf(m_p.position[found[0]]);
      for (const uint32_t i : found) {
        const float own = m_p.position[i].w;
        cluster.add(i, vectorOf(m_p.position[i]) - origin, own);
        volume += double{own} / m_membership[i];
      }
      cluster.emit({}, volume, 1, sink);
    }
  }

 private:
  using Cell = std::array<int64_t, 3>;
  Cell cellOf(Vector x) const {
    const auto along = [&](double c) { return static_cast<int64_t>(std::floor(c / m_radius)); };
    return {along(x.x), along(x.y), along(x.z)};
  }
  /// In runs that are then merged, so that nobody who gives it up waits for all of it.
  void sortByCell(api::GroupSink& sink) {
    constexpr size_t kRun = size_t{1} << 16;
    const auto at = [&](size_t k) {
      return m_cells.begin() + static_cast<std::ptrdiff_t>(std::min(k, m_cells.size()));
    };
    m_cells.reserve(m_body.size());
    for (const uint32_t i : m_body) m_cells.push_back({cellOf(vectorOf(m_p.position[i])), i});
    for (size_t k = 0; k < m_cells.size(); k += kRun) {
      std::sort(at(k), at(k + kRun));
      sink.advance(0);
    }
    for (size_t run = kRun; run < m_cells.size(); run *= 2) {
      for (size_t k = 0; k < m_cells.size(); k += 2 * run) {
        std::inplace_merge(at(k), at(k + run), at(k + 2 * run));
        sink.advance(0);
      }
    }
  }
  void around(Vector centre) {
    std::vector<uint32_t> near;
    bool anyNew = false;
    const Cell middle = cellOf(centre);
    for (int64_t x = middle[0] - 1; x <= middle[0] + 1; ++x) {
      for (int64_t y = middle[1] - 1; y <= middle[1] + 1; ++y) {
        // The three cells of a row along z lie one after the other.
        auto entry = std::lower_bound(m_cells.begin(), m_cells.end(), std::pair{Cell{x, y, middle[2] - 1}, 0u});
        for (; entry != m_cells.end() && entry->first <= Cell{x, y, middle[2] + 1}; ++entry) {
          const Vector d = vectorOf(m_p.position[entry->second]) - centre;
          if (dot(d, d) > m_radius * m_radius * (1 + 1e-6)) continue;
          near.push_back(entry->second);
          anyNew = anyNew || m_isNew[entry->second] != 0;
        }
      }
    }
    if (!anyNew) return;
    std::sort(near.begin(), near.end());
    std::vector<Vector> places;
    places.reserve(near.size());
    for (const uint32_t i : near) places.push_back(vectorOf(m_p.position[i]));
    for (const std::vector<size_t>& piece : piecesOf(places, m_reach)) {
      if (piece.size() < NewCluster::kLeastMembers) continue;
      std::vector<uint32_t>& found = m_found.emplace_back();
      for (const size_t k : piece) {
        found.push_back(near[k]);
        ++m_membership[near[k]];
      }
    }
  }

  const ParticleView& m_p;
  double m_radius, m_step, m_reach;
  size_t m_members;  ///< newly created
  std::vector<uint8_t> m_isNew;
  std::vector<uint32_t> m_membership, m_body;
  std::vector<std::pair<Cell, uint32_t>> m_cells;
  std::vector<std::vector<uint32_t>> m_found;
};

}  // namespace

void findClusters(const ConstraintContext& context, const ParticleView& particles, api::Span<const uint32_t> members,
                  const GroupBatch& all, api::GroupSink& sink) {
  Builder builder(context, particles, members);
  builder.count(all);
  builder.find(sink);
  builder.emit(sink);
}

}  // namespace ps::constraint
