// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/raygrid.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kMostCells = 1 << 22;  ///< beyond it cells grow
constexpr double kFar = 1e30;
/// Spacings from the outermost centres to the grid's faces: the cubes of a lattice along its axes fill a cell each.
constexpr double kMargin = 1.5;
constexpr double kHalf = 0.5;        ///< spacings from a cube's centre to a bare face
constexpr double kOverlap = 0.55;    ///< to one that is not: no ray slips between two cubes of a bent lattice
constexpr double kRound = 0.92;      ///< spacings squared: around a cube of 0.55 to each side
constexpr double kInserted = 0.499;  ///< by which a cube is put into cells, so that rounding fills no second one

}  // namespace

void RayGrid::build(const ParticleStore& store, std::span<const SurfaceBox> boxes, std::span<const uint32_t> boxOf,
                    double spacing) {
  m_spacing = spacing;
  m_boxes = boxes;
  m_boxOf = boxOf;
  span(store);
  m_first.assign(static_cast<size_t>(m_count[0]) * static_cast<size_t>(m_count[1]) * static_cast<size_t>(m_count[2]),
                 kNone);
  m_filled.assign(m_first.size() / 64 + 1, 0);
  m_entries.clear();
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] != api::Motion::Gas) insert(store, static_cast<uint32_t>(i));
  }
}

/// The box around all matter, or the period; and its cells.
void RayGrid::span(const ParticleStore& store) {
  const Period& period = store.period();
  for (size_t a = 0; a < 3; ++a) m_low[a] = kFar, m_high[a] = -kFar;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] == api::Motion::Gas) continue;
    const api::Float4& x = store.position()[i];
    const double at[3] = {x.x, x.y, x.z};
    for (size_t a = 0; a < 3; ++a) m_low[a] = std::min(m_low[a], at[a]), m_high[a] = std::max(m_high[a], at[a]);
  }
  double size[3], volume = 1;
  for (size_t a = 0; a < 3; ++a) {
    m_repeats[a] = period.length(a) > 0;
    if (m_repeats[a]) {
      m_low[a] = period.low(a);
      m_high[a] = m_low[a] + double{period.length(a)};
    } else {
      m_low[a] -= kMargin * m_spacing;
      m_high[a] += kMargin * m_spacing;
    }
    size[a] = std::max(m_high[a] - m_low[a], m_spacing);
    volume *= size[a];
  }
  double wanted = m_spacing;
  while (volume / (wanted * wanted * wanted) > kMostCells) wanted *= 1.26;
  for (size_t a = 0; a < 3; ++a) {
    m_count[a] = std::max(1, static_cast<int>(size[a] / wanted + 0.01));
    m_edge[a] = size[a] / m_count[a];
    m_perEdge[a] = m_count[a] / size[a];
  }
  m_repeating = m_repeats[0] || m_repeats[1] || m_repeats[2];
  m_stride[1] = static_cast<size_t>(m_count[0]);
  m_stride[2] = m_stride[1] * static_cast<size_t>(m_count[1]);
}

void RayGrid::insert(const ParticleStore& store, uint32_t particle) {
  const api::Float4& x = store.position()[particle];
  const double at[3] = {x.x, x.y, x.z};
  const uint32_t own = m_boxOf[particle];
  int from[3], to[3];
  for (size_t a = 0; a < 3; ++a) {
    double half = 0;
    if (own != kNone) {
      for (const auto& axis : m_boxes[own].axes) half += std::abs(double{axis[a]});
      half *= kInserted * m_spacing;
    }
    const double c = m_repeats[a] ? store.period().wrapped(at[a], a) : at[a];
    from[a] = static_cast<int>(std::floor((c - half - m_low[a]) / m_edge[a]));
    to[a] = static_cast<int>(std::floor((c + half - m_low[a]) / m_edge[a]));
    if (!m_repeats[a]) from[a] = std::max(from[a], 0), to[a] = std::min(to[a], m_count[a] - 1);
  }
  const auto turned = [&](int c, size_t a) { return m_repeats[a] ? (c % m_count[a] + m_count[a]) % m_count[a] : c; };
  for (int z = from[2]; z <= to[2]; ++z) {
    for (int y = from[1]; y <= to[1]; ++y) {
      for (int c = from[0]; c <= to[0]; ++c) {
        const int cell[3] = {turned(c, 0), turned(y, 1), turned(z, 2)};
        const size_t index = indexOf(cell);
        m_filled[index / 64] |= uint64_t{1} << (index % 64);
        uint32_t& first = m_first[index];
        m_entries.push_back({particle, first});
        first = static_cast<uint32_t>(m_entries.size() - 1);
      }
    }
  }
}

bool RayGrid::begin(const Vector3& from, const Vector3& way, double longest, Walk& walk) const {
  double enter = 0, leave = longest, inverse[3];
  for (size_t a = 0; a < 3; ++a) {  // where the ray is within the box
    inverse[a] = way[a] == 0 ? kFar : 1 / way[a];
    if (m_repeats[a]) continue;
    if (way[a] == 0) {
      if (from[a] < m_low[a] || from[a] > m_high[a]) return false;
      continue;
    }
    const double one = (m_low[a] - from[a]) * inverse[a], other = (m_high[a] - from[a]) * inverse[a];
    enter = std::max(enter, std::min(one, other));
    leave = std::min(leave, std::max(one, other));
  }
  // Along a period that nothing closes a ray may go on for ever.
  leave = std::min(leave, 8 * (m_high[0] - m_low[0] + m_high[1] - m_low[1] + m_high[2] - m_low[2]));
  if (!(enter < leave)) return false;
  walk.at = enter;
  walk.leave = leave;
  for (size_t a = 0; a < 3; ++a) {
    const double at = (from[a] + enter * way[a] - m_low[a]) * m_perEdge[a];
    const int towardsZero = static_cast<int>(at), floor = towardsZero - (towardsZero > at ? 1 : 0);
    walk.cell[a] = m_repeats[a] ? floor : std::clamp(floor, 0, m_count[a] - 1);
    walk.step[a] = way[a] > 0 ? 1 : -1;
    walk.each[a] = way[a] == 0 ? kFar : m_edge[a] * std::abs(inverse[a]);
    const double border = m_low[a] + m_edge[a] * (walk.cell[a] + (walk.step[a] > 0 ? 1 : 0));
    walk.next[a] = way[a] == 0 ? kFar : (border - from[a]) * inverse[a];
    if (m_repeats[a]) walk.cell[a] = (walk.cell[a] % m_count[a] + m_count[a]) % m_count[a];
  }
  walk.index = indexOf(walk.cell);
  return true;
}

bool RayGrid::meets(const ParticleStore& store, uint32_t particle, const Vector3& from, const Vector3& way, double at,
                    Hit& hit) const {
  const api::Float4& x = store.position()[particle];
  Vector3 off = {from.x() + at * way.x() - double{x.x}, from.y() + at * way.y() - double{x.y},
                 from.z() + at * way.z() - double{x.z}};
  for (size_t a = 0; m_repeating && a < 3; ++a) {
    if (!m_repeats[a]) continue;
    const double length = m_high[a] - m_low[a];
    off[a] -= length * std::floor(off[a] / length + 0.5);
  }
  const double along = off.dot(way), square = off.squaredNorm(), reach = kRound * m_spacing * m_spacing;
  if (square - along * along > reach || (along > 0 && square > reach)) return false;
  const uint32_t own = m_boxOf[particle];
  double o[3] = {off.x(), off.y(), off.z()}, v[3] = {way.x(), way.y(), way.z()};
  double low[3], high[3];
  for (size_t a = 0; a < 3; ++a) low[a] = -kHalf * m_spacing, high[a] = kHalf * m_spacing;
  if (own != kNone) {
    const SurfaceBox& box = m_boxes[own];
    for (size_t a = 0; a < 3; ++a) {
      const Vector3 axis = box.axis(a);
      o[a] = off.dot(axis), v[a] = way.dot(axis);
      high[a] = (box.isBare(2 * a) ? kHalf : kOverlap) * m_spacing;
      low[a] = -(box.isBare(2 * a + 1) ? kHalf : kOverlap) * m_spacing;
    }
    if (box.isBare(0)) high[0] = double{box.height} * m_spacing;
  }
  double enter = -kFar, leave = kFar;
  int face = -1;
  for (size_t a = 0; a < 3; ++a) {
    if (std::abs(v[a]) < 1e-12) {
      if (o[a] < low[a] || o[a] > high[a]) return false;
      continue;
    }
    const double inverse = 1 / v[a], toLow = (low[a] - o[a]) * inverse, toHigh = (high[a] - o[a]) * inverse;
    const double one = std::min(toLow, toHigh);
    face = one > enter ? static_cast<int>(2 * a + (v[a] > 0 ? 1 : 0)) : face;
    enter = std::max(enter, one);
    leave = std::min(leave, std::max(toLow, toHigh));
  }
  if (!(enter < leave) || !(at + leave > 0)) return false;
  const bool within = at + enter <= 0;
  hit.particle = particle;
  hit.face = own == kNone || within ? -1 : face;
  hit.distance = std::max(0.0, at + enter);
  return true;
}

}  // namespace ps
