// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/opensurface.h"

#include "core/base/parallelarrays.h"
#include "core/base/statestream.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Sum of V W from which on a particle lies inside. In disorder many on the surface come near 1; those inside are soon
/// covered anyway.
constexpr float kInside = 1.1f;
constexpr double kCone = 0.7313537;  ///< cosine of 43 degrees
constexpr float kReach = 2;          ///< spacings to a neighbour that covers
constexpr double kBesideWall = 1;    ///< spacings to a wall that covers
/// A wall covers what lies below its level as a layer of neighbours would, with a hair's breadth for rounding.
constexpr double kBelowLevel = -0.05;

/// For directions to neighbours, in cells of the six faces of a cube: the directions that such a neighbour covers. Odd,
/// so that neighbours along an axis meet the middle of a cell.
constexpr int kCells = 33;
using CoverTable = std::vector<uint64_t>;

size_t cellOf(float x, float y, float z) {
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  float major = x, u = y, v = z;
  size_t face = 0;
  if (ay > ax && ay >= az) {
    major = y, u = x, v = z;
    face = 2;
  } else if (az > ax) {
    major = z, u = x, v = y;
    face = 4;
  }
  if (major < 0) ++face;
  const float scale = 0.5f * kCells / std::abs(major);
  const auto cell = [&](float w) {
    return static_cast<size_t>(std::clamp(static_cast<int>(w * scale + 0.5f * kCells), 0, kCells - 1));
  };
  return (face * kCells + cell(u)) * kCells + cell(v);
}

CoverTable makeTable() {
  CoverTable table(6 * kCells * kCells);
  for (size_t face = 0; face < 6; ++face) {
    for (size_t iu = 0; iu < kCells; ++iu) {
      for (size_t iv = 0; iv < kCells; ++iv) {
        const double major = face % 2 == 0 ? 1 : -1;
        const double u = (2 * static_cast<double>(iu) + 1) / kCells - 1,
                     v = (2 * static_cast<double>(iv) + 1) / kCells - 1;
        const double length = std::sqrt(1 + u * u + v * v);
        double n[3] = {major, u, v};
        if (face / 2 == 1) n[0] = u, n[1] = major, n[2] = v;
        if (face / 2 == 2) n[0] = u, n[1] = v, n[2] = major;
        uint64_t covered = 0;
        for (size_t d = 0; d < OpenSurface::kDirections; ++d) {
          const auto& way = OpenSurface::directions()[d];
          const double along = (n[0] * double{way[0]} + n[1] * double{way[1]} + n[2] * double{way[2]}) / length;
          if (along > kCone) covered |= uint64_t{1} << d;
        }
        table[(face * kCells + iu) * kCells + iv] = covered;
      }
    }
  }
  return table;
}

const CoverTable& coverTable() {
  static const CoverTable table = makeTable();
  return table;
}

}  // namespace

const std::array<std::array<float, 3>, OpenSurface::kDirections>& OpenSurface::directions() {
  static const auto list = [] {
    std::array<std::array<float, 3>, kDirections> ways{};
    // Cosine and sine of the golden angle, turned step by step: the C library's may differ in their last bit.
    constexpr double kCosine = -0.7373688780783197, kSine = 0.6754902942615238;
    double c = 1, s = 0;
    for (size_t d = 0; d < kDirections; ++d) {
      const double z = 1 - (2 * static_cast<double>(d) + 1) / kDirections, r = std::sqrt(1 - z * z);
      ways[d] = {static_cast<float>(r * c), static_cast<float>(r * s), static_cast<float>(z)};
      const double turned = c * kCosine - s * kSine;
      s = s * kCosine + c * kSine;
      c = turned;
    }
    return ways;
  }();
  return list;
}

/// The directions that lead behind a plane with that normal.
uint64_t OpenSurface::behind(const api::Double3& n) {
  uint64_t behind = 0;
  for (size_t d = 0; d < kDirections; ++d) {
    const auto& way = directions()[d];
    if (n.x * double{way[0]} + n.y * double{way[1]} + n.z * double{way[2]} < kBelowLevel) behind |= uint64_t{1} << d;
  }
  return behind;
}

void OpenSurface::measure(const ParticleStore& store, const api::NeighbourView& lists, std::span<const float> filled,
                          std::span<const Wall> walls, double spacing, std::span<const double> scaledArea) {
  m_spacing = spacing;
  m_unit = 6 * spacing * spacing / kDirections;
  m_open.resize(store.size());
  assignAll(m_scale, store.size(), 1.0f);
  m_behindWall.assign(walls.size(), 0);
  for (size_t w = 0; w < walls.size(); ++w) m_behindWall[w] = behind(walls[w].normal);
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    store.period().any() ? cover<true>(store, lists, filled, walls, first, last)
                         : cover<false>(store, lists, filled, walls, first, last);
  });
  assignAll(m_id, std::span(store.id(), store.size()));
  if (std::any_of(scaledArea.begin(), scaledArea.end(), [](double area) { return area > 0; }))
    scaleToBodies(store, scaledArea);
}

bool OpenSurface::fits(const ParticleStore& store) const {
  return m_id.size() == store.size() && std::equal(m_id.begin(), m_id.end(), store.id());
}

void OpenSurface::save(StateWriter& writer, const ParticleStore& store) const {
  const size_t count = fits(store) ? m_id.size() : 0;
  writer.array("heat/open_directions", std::span<const uint64_t>(m_open.data(), count));
  writer.array("heat/area_scale", std::span<const float>(m_scale.data(), count));
  writer.array("heat/area_unit", std::span<const double>(&m_unit, count > 0 ? 1 : 0));
}

void OpenSurface::restore(const StateReader& reader, const ParticleStore& store) {
  forget();
  m_open = reader.array<uint64_t>("heat/open_directions");
  m_scale = reader.array<float>("heat/area_scale", m_open.size(), 1);
  const std::vector<double> unit = reader.array<double>("heat/area_unit", m_open.empty() ? 0 : 1, 1);
  if (m_open.empty()) return;
  if (m_open.size() != store.size()) StateReader::fail("heat/open_directions", "is not that of all particles");
  m_unit = unit[0];
  assignAll(m_id, std::span(store.id(), store.size()));
}

template <bool kPeriodic>
void OpenSurface::cover(const ParticleStore& store, const api::NeighbourView& lists, std::span<const float> filled,
                        std::span<const Wall> walls, size_t first, size_t last) {
  const CoverTable& table = coverTable();
  const api::Float4* x = store.position();
  const api::Motion* motion = store.motion();
  const Period& period = store.period();
  const auto dx = static_cast<float>(m_spacing);
  const float reach = kReach * kReach * dx * dx * 1.0001f, tiny = 1e-8f * dx * dx;
  for (size_t i = first; i < last; ++i) {
    m_open[i] = 0;
    if (motion[i] == api::Motion::Gas || filled[i] >= kInside) continue;
    uint64_t covered = 0;
    for (size_t w = 0; w < walls.size(); ++w) {
      if (!(heightOver(walls[w], x[i]) < kBesideWall * m_spacing)) continue;
      covered |= walls[w].form == WallForm::Plane ? m_behindWall[w]
                                                  : behind(double3Of(faceOf(walls[w]).at(vectorOf(x[i])).normal));
    }
    for (uint32_t k = lists.begin[i]; k < lists.last[i] && ~covered != 0; ++k) {
      const uint32_t j = lists.index[k];
      float a = x[j].x - x[i].x, b = x[j].y - x[i].y, c = x[j].z - x[i].z;
      if constexpr (kPeriodic) a = period.shortest(a, 0), b = period.shortest(b, 1), c = period.shortest(c, 2);
      const float square = a * a + b * b + c * c;
      if (square > reach || square < tiny || motion[j] == api::Motion::Gas) continue;
      covered |= table[cellOf(a, b, c)];
    }
    m_open[i] = ~covered;
  }
}

void OpenSurface::scaleToBodies(const ParticleStore& store, std::span<const double> scaledArea) {
  m_found.assign(scaledArea.size(), 0);
  const uint32_t* body = store.body();
  for (size_t i = 0; i < store.size(); ++i) {
    if (body[i] < m_found.size()) m_found[body[i]] += area(i);
  }
  for (size_t i = 0; i < store.size(); ++i) {
    const uint32_t b = body[i];
    if (b < m_found.size() && scaledArea[b] > 0 && m_found[b] > 0)
      m_scale[i] = static_cast<float>(scaledArea[b] / m_found[b]);
  }
}

}  // namespace ps
