// SPDX-License-Identifier: Apache-2.0
#include "ui/render/instances.h"

#include "core/base/parallel.h"
#include "ui/render/colourmap.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ps::render {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;
constexpr size_t kGrain = 4096;

// Index in the previous snapshot by index in this one; empty when both have the same order.
std::vector<uint32_t> matchById(const Snapshot& now, const Snapshot& previous) {
  if (now.id == previous.id) return {};
  std::vector<std::pair<uint32_t, uint32_t>> old(previous.id.size());
  for (size_t i = 0; i < old.size(); ++i) old[i] = {previous.id[i], static_cast<uint32_t>(i)};
  std::sort(old.begin(), old.end());
  std::vector<uint32_t> match(now.id.size(), kNone);
  for (size_t i = 0; i < match.size(); ++i) {
    const auto found = std::lower_bound(old.begin(), old.end(), std::pair<uint32_t, uint32_t>{now.id[i], 0});
    if (found != old.end() && found->first == now.id[i]) match[i] = found->second;
  }
  return match;
}

float luma(const Colour& c) { return 0.299f * c[0] + 0.587f * c[1] + 0.114f * c[2]; }

Colour towardsWhite(const Colour& c, float amount) {
  return {c[0] + (1 - c[0]) * amount, c[1] + (1 - c[1]) * amount, c[2] + (1 - c[2]) * amount};
}

// The three states of one material look different: frozen matter scatters light, foam is white.
Colour materialColour(const Snapshot& s, size_t i) {
  const size_t material = s.material[i];
  const Colour own = material < s.materialColour.size() ? s.materialColour[material] : Colour{0.6f, 0.6f, 0.6f};
  switch (s.motion[i]) {
    case api::Motion::Static: return own;
    case api::Motion::Solid: return towardsWhite(own, (s.phase[i] == api::Phase::Solid ? 0.62f : 0.34f) * luma(own));
    case api::Motion::Liquid: return towardsWhite(own, 0.7f * std::clamp(s.gasFraction[i], 0.f, 1.f));
    case api::Motion::Gas: break;
  }
  return own;
}

Kind kindOf(const InstanceRequest& request, size_t i) {
  const Snapshot& s = *request.now;
  if (s.motion[i] == api::Motion::Static) return Kind::Matte;
  if (request.colour != ColourBy::Material) return Kind::Plain;
  return s.phase[i] == api::Phase::Solid ? Kind::Clear : Kind::Wet;
}

// Everything that does not depend on the order in which particles are drawn.
class Evaluator {
 public:
  explicit Evaluator(const InstanceRequest& request)
      : m_request(request),
        m_table(request.colour, request.minimum, request.maximum, request.meltingPoint),
        m_previous(usable(request) ? request.previous : nullptr),
        m_blend(std::clamp(request.blend, 0.f, 1.f)) {
    if (m_previous) m_match = matchById(*request.now, *m_previous);
  }

  Instance at(size_t i) const {
    const Snapshot& s = *m_request.now;
    const size_t old = !m_previous ? kNone : m_match.empty() ? i : m_match[i];
    const auto mix = [&](float now, float before) { return before + (now - before) * m_blend; };
    api::Float4 p = s.position[i];
    if (old != kNone) {
      const api::Float4& q = m_previous->position[old];
      p = {mix(p.x, q.x), mix(p.y, q.y), mix(p.z, q.z), mix(p.w, q.w)};
    }
    const auto blended = [&](const std::vector<float> Snapshot::*field) {
      const float value = (s.*field)[i];
      return old == kNone ? value : mix(value, (m_previous->*field)[old]);
    };
    const Colour c = colourOf(i, blended);
    return {p.x, p.y, p.z, p.w, c[0], c[1], c[2], 0};
  }

 private:
  static bool usable(const InstanceRequest& request) {
    return request.previous && request.previous != request.now && request.blend < 1 &&
           request.previous->revision == request.now->revision;
  }

  template <class Blended>
  Colour colourOf(size_t i, const Blended& blended) const {
    const Snapshot& s = *m_request.now;
    switch (m_request.colour) {
      case ColourBy::Temperature: return m_table.at(blended(&Snapshot::temperature));
      case ColourBy::Speed: return m_table.at(blended(&Snapshot::speed));
      case ColourBy::DensityError: return m_table.at(blended(&Snapshot::densityError));
      case ColourBy::Phase: return m_table.at(static_cast<float>(s.phase[i]));
      case ColourBy::Material: break;
    }
    return s.motion[i] == api::Motion::Gas ? m_request.steam : materialColour(s, i);
  }

  const InstanceRequest& m_request;
  ColourTable m_table;
  const Snapshot* m_previous;
  float m_blend;
  std::vector<uint32_t> m_match;
};

// Nearest first, by counting into slices: hidden fragments then fail the depth test before they are shaded.
void sortAlong(const std::array<float, 3>& forward, std::vector<Instance>& list) {
  constexpr size_t kSlices = 512;
  if (list.size() < 2 || (forward[0] == 0 && forward[1] == 0 && forward[2] == 0)) return;
  std::vector<float> depth(list.size());
  for (size_t i = 0; i < list.size(); ++i)
    depth[i] = list[i].x * forward[0] + list[i].y * forward[1] + list[i].z * forward[2];
  const auto [low, high] = std::minmax_element(depth.begin(), depth.end());
  const float first = *low, scale = static_cast<float>(kSlices - 1) / std::max(*high - *low, 1e-9f);
  std::array<size_t, kSlices + 1> start{};
  const auto slice = [&](size_t i) { return static_cast<size_t>(std::max(0.f, (depth[i] - first) * scale)); };
  for (size_t i = 0; i < list.size(); ++i) ++start[std::min(slice(i), kSlices - 1) + 1];
  for (size_t k = 1; k <= kSlices; ++k) start[k] += start[k - 1];
  std::vector<Instance> sorted(list.size());
  for (size_t i = 0; i < list.size(); ++i) sorted[start[std::min(slice(i), kSlices - 1)]++] = list[i];
  list.swap(sorted);
}

// Leaves out spheres whose 26 neighbouring cells, a diameter wide, all hold others: at least one more layer hides them.
void dropBuried(const Extent& extent, float radius, std::vector<Instance>& list) {
  constexpr size_t kMost = 1u << 24;
  std::array<size_t, 3> cells{};
  const float cell = 2 * radius;
  double total = 1;
  for (size_t k = 0; k < 3; ++k) {
    const float count = (extent.maximum[k] - extent.minimum[k]) / cell + 3;
    total *= static_cast<double>(count);
    cells[k] = static_cast<size_t>(std::min(count, 1e6f));
  }
  if (list.size() < 1000 || total > static_cast<double>(kMost)) return;
  const auto cellOf = [&](const Instance& p) {
    const auto along = [&](float v, size_t k) { return static_cast<size_t>((v - extent.minimum[k]) / cell) + 1; };
    return (along(p.z, 2) * cells[1] + along(p.y, 1)) * cells[0] + along(p.x, 0);
  };
  std::vector<char> full(cells[0] * cells[1] * cells[2] + 1), buried(full.size());
  for (const Instance& p : list)
    if (p.radius > 0.7f * radius) full[cellOf(p)] = 1;
  const size_t row = cells[0], layer = cells[0] * cells[1];
  for (size_t at = layer + row + 1; at + layer + row + 1 < full.size(); ++at) {
    if (!full[at] || !full[at - 1] || !full[at + 1]) continue;
    bool all = true;
    for (const size_t base : {at - layer - row, at - layer, at - layer + row, at - row, at + row, at + layer - row,
                              at + layer, at + layer + row})
      all = all && full[base - 1] && full[base] && full[base + 1];
    buried[at] = all;
  }
  std::erase_if(list, [&](const Instance& p) { return buried[cellOf(p)] != 0; });
}

void blur(std::vector<float>& grid, int radius) {
  constexpr int n = ContactMap::kCells;
  std::vector<float> line(n);
  for (int pass = 0; pass < 4; ++pass) {
    const int along = pass % 2 ? n : 1, across = pass % 2 ? 1 : n;
    for (int row = 0; row < n; ++row) {
      for (int i = 0; i < n; ++i) {
        float sum = 0;
        for (int k = std::max(0, i - radius); k <= std::min(n - 1, i + radius); ++k)
          sum += grid[static_cast<size_t>(row * across + k * along)];
        line[static_cast<size_t>(i)] = sum / static_cast<float>(2 * radius + 1);
      }
      for (int i = 0; i < n; ++i) grid[static_cast<size_t>(row * across + i * along)] = line[static_cast<size_t>(i)];
    }
  }
}

}  // namespace

void Extent::add(float x, float y, float z, float radius) {
  const std::array<float, 3> p{x, y, z};
  for (size_t k = 0; k < 3; ++k) {
    minimum[k] = std::min(minimum[k], p[k] - radius);
    maximum[k] = std::max(maximum[k], p[k] + radius);
  }
}

void collectInstances(const InstanceRequest& request, Instances& out) {
  const Snapshot& s = *request.now;
  const size_t count = s.position.size();
  const Evaluator evaluator(request);
  std::vector<Instance> all(count);
  parallelFor(count, kGrain, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) all[i] = evaluator.at(i);
  });

  std::vector<Instance> spheres, liquids, vapours;
  const bool data = request.colour != ColourBy::Material;
  double radii = 0;
  size_t counted = 0;
  for (size_t i = 0; i < count; ++i) {
    Instance& p = all[i];
    if (!std::isfinite(p.x + p.y + p.z + p.radius) || p.radius <= 0) continue;
    const api::Motion motion = s.motion[i];
    if (motion == api::Motion::Gas) {
      p.extra = static_cast<float>(s.id[i] % 4096) * 0.731f;
      vapours.push_back(p);
      if (!data) continue;
      p.radius *= 0.40f;  // the parcel's point of data inside its cloud
      p.extra = static_cast<float>(Kind::Plain);
      spheres.push_back(p);
      continue;
    }
    if (motion != api::Motion::Static) {
      radii += static_cast<double>(p.radius);
      ++counted;
    }
    p.extra = static_cast<float>(kindOf(request, i));
    (motion == api::Motion::Liquid && request.surfaces ? liquids : spheres).push_back(p);
  }
  if (counted) out.radius = static_cast<float>(radii / static_cast<double>(counted));
  out.sphereExtent = out.liquidExtent = out.vapourExtent = {};
  for (const Instance& p : spheres) out.sphereExtent.add(p.x, p.y, p.z, p.radius);
  if (request.dropBuried) dropBuried(out.sphereExtent, out.radius, spheres);
  sortAlong(request.forward, spheres);
  sortAlong(request.forward, liquids);
  for (const Instance& p : liquids) out.liquidExtent.add(p.x, p.y, p.z, p.radius * 1.6f);
  for (const Instance& p : vapours) out.vapourExtent.add(p.x, p.y, p.z, p.radius * 8);
  out.spheres = spheres.size();
  out.liquids = liquids.size();
  out.vapours = vapours.size();
  out.particles.swap(spheres);
  out.particles.insert(out.particles.end(), liquids.begin(), liquids.end());
  out.particles.insert(out.particles.end(), vapours.begin(), vapours.end());
}

void fillContactMap(const Instances& instances, bool clear, ContactMap& map) {
  constexpr int n = ContactMap::kCells;
  constexpr size_t kCount = static_cast<size_t>(n * n);
  std::vector<float> close(kCount), wide(kCount);
  std::array<std::vector<float>, 3> colour;
  for (auto& channel : colour) channel.assign(kCount, 0);
  const float cell = map.size[0] * map.size[1] / static_cast<float>(n * n);
  const float reach = instances.radius * 3, tall = 0.18f * std::max(map.size[0], map.size[1]);
  for (size_t i = 0; i < instances.spheres + instances.liquids; ++i) {
    const Instance& p = instances.particles[i];
    const int x = static_cast<int>(std::floor((p.x - map.corner[0]) / map.size[0] * n));
    const int z = static_cast<int>(std::floor((p.z - map.corner[1]) / map.size[1] * n));
    const float height = p.y - p.radius - map.floor;
    if (x < 0 || z < 0 || x >= n || z >= n || height < -2 * p.radius) continue;
    const size_t at = static_cast<size_t>(z * n + x);
    const float share = 3.14f * p.radius * p.radius / cell * (i >= instances.spheres && clear ? 0.3f : 1);
    const float w = share * std::exp(-std::max(0.f, height) / reach);
    close[at] += w;
    wide[at] += share * std::exp(-std::max(0.f, height) / tall) * 0.35f;
    const float weight = w + 0.05f * share;
    colour[0][at] += p.red * weight, colour[1][at] += p.green * weight, colour[2][at] += p.blue * weight;
  }
  std::vector<float> weights(close);
  for (size_t i = 0; i < kCount; ++i) weights[i] += 0.05f / 0.35f * wide[i];
  blur(close, 1);
  blur(wide, 4);
  blur(weights, 4);
  for (auto& channel : colour) blur(channel, 4);
  map.texels.assign(kCount * 4, 0);
  for (size_t i = 0; i < kCount; ++i) {
    const float cover = 1 - std::exp(-0.8f * close[i] - 0.75f * wide[i]);
    for (size_t k = 0; k < 3; ++k)
      map.texels[i * 4 + k] =
          static_cast<uint8_t>(255 * std::clamp(colour[k][i] / std::max(weights[i], 1e-5f), 0.f, 1.f));
    map.texels[i * 4 + 3] = static_cast<uint8_t>(255 * std::clamp(cover, 0.f, 1.f));
  }
}

}  // namespace ps::render
