// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/viscousgroups.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace ps {
namespace {
constexpr size_t kSegment = 128;
}  // namespace

void ViscousGroups::flood(uint32_t seed, std::span<const Role> roles, const api::NeighbourView& view, bool& anchored) {
  m_stack.assign(1, seed);
  m_found[seed] = 1;
  while (!m_stack.empty()) {
    const uint32_t i = m_stack.back();
    m_stack.pop_back();
    m_rows.push_back(i);
    const bool own = roles[i] == Role::Viscous;
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      const Role role = roles[j];
      if (role == Role::None || (!own && role != Role::Viscous)) continue;
      anchored = anchored || role == Role::Fixed;
      if (role == Role::Fixed || m_found[j] != 0) continue;
      m_found[j] = 1;
      m_stack.push_back(j);
    }
  }
}

void ViscousGroups::find(std::span<const Role> roles, const api::NeighbourView& view) {
  m_rows.clear();
  m_groups.clear();
  m_segments.clear();
  m_found.assign(roles.size(), 0);
  for (size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] != Role::Viscous || m_found[i] != 0) continue;
    const size_t begin = m_rows.size();
    Group group;
    flood(static_cast<uint32_t>(i), roles, view, group.anchored);
    std::sort(m_rows.begin() + static_cast<std::ptrdiff_t>(begin), m_rows.end());
    group.firstSegment = static_cast<uint32_t>(m_segments.size());
    for (size_t first = begin; first < m_rows.size(); first += kSegment) {
      m_segments.push_back({static_cast<uint32_t>(m_groups.size()), static_cast<uint32_t>(first),
                            static_cast<uint32_t>(std::min(first + kSegment, m_rows.size()))});
    }
    group.lastSegment = static_cast<uint32_t>(m_segments.size());
    m_groups.push_back(group);
  }
  m_sums.resize(m_segments.size());
}

void ViscousGroups::measure(const ParticleStore& store, std::span<const uint8_t> touched, double spacing) {
  for (Group& group : m_groups) {
    group.closed = !group.anchored;
    for (size_t s = group.firstSegment; s < group.lastSegment; ++s) group.closed = group.closed && touched[s] == 0;
  }
  forChunks(m_segments.size(), 1, [&](size_t s, size_t) {
    const Segment& segment = m_segments[s];
    if (!m_groups[segment.group].closed) return;
    Sums sums{};
    for (size_t k = segment.first; k < segment.last; ++k) {
      const api::Float4& p = store.position()[m_rows[k]];
      const double m = store.mass()[m_rows[k]], x = p.x, y = p.y, z = p.z;
      const Sums terms{m, m * x, m * y, m * z, m * x * x, m * y * y, m * z * z, m * x * y, m * x * z, m * y * z};
      for (size_t a = 0; a < 10; ++a) sums[a] += terms[a];
    }
    m_sums[s] = sums;
  });
  for (Group& group : m_groups) {
    if (group.closed) measureInertia(group, spacing, !store.period().any());
  }
}

void ViscousGroups::measureInertia(Group& group, double spacing, bool turns) const {
  Sums t{};
  for (size_t s = group.firstSegment; s < group.lastSegment; ++s) {
    for (size_t a = 0; a < 10; ++a) t[a] += m_sums[s][a];
  }
  group.mass = t[0];
  group.center = {t[1] / t[0], t[2] / t[0], t[3] / t[0]};
  group.inverseInertia = {};
  if (!turns) return;
  const auto [x, y, z] = group.center;
  const double xx = t[4] - t[0] * x * x, yy = t[5] - t[0] * y * y, zz = t[6] - t[0] * z * z;
  const double xy = t[7] - t[0] * x * y, xz = t[8] - t[0] * x * z, yz = t[9] - t[0] * y * z;
  // A group in a line has no inertia about it, and no angular momentum either.
  const double floor = 1e-9 * (xx + yy + zz + t[0] * spacing * spacing);
  const double a = yy + zz + floor, b = xx + zz + floor, c = xx + yy + floor;
  const double m00 = b * c - yz * yz, m01 = xy * c + xz * yz, m02 = xy * yz + xz * b;
  const double m11 = a * c - xz * xz, m12 = a * yz + xy * xz, m22 = a * b - xy * xy;
  const double s = 1 / (a * m00 - xy * m01 - xz * m02);
  group.inverseInertia = {s * m00, s * m01, s * m02, s * m01, s * m11, s * m12, s * m02, s * m12, s * m22};
}

void ViscousGroups::addMomenta(const ParticleStore& store, const api::Float4* vectors, size_t segment) {
  const Segment& range = m_segments[segment];
  const Group& group = m_groups[range.group];
  if (!group.closed) return;
  Sums sums{};
  for (size_t k = range.first; k < range.last; ++k) {
    const api::Float4& p = store.position()[m_rows[k]];
    const double m = store.mass()[m_rows[k]];
    const double x = p.x - group.center[0], y = p.y - group.center[1], z = p.z - group.center[2];
    const double vx = m * vectors[k].x, vy = m * vectors[k].y, vz = m * vectors[k].z;
    sums[0] += vx, sums[1] += vy, sums[2] += vz;
    sums[3] += y * vz - z * vy, sums[4] += z * vx - x * vz, sums[5] += x * vy - y * vx;
  }
  m_sums[segment] = sums;
}

void ViscousGroups::reduceMomenta() {
  for (Group& group : m_groups) {
    if (!group.closed) continue;
    std::array<double, 6> t{};
    for (size_t s = group.firstSegment; s < group.lastSegment; ++s) {
      for (size_t a = 0; a < 6; ++a) t[a] += m_sums[s][a];
    }
    const auto& inverse = group.inverseInertia;
    for (size_t a = 0; a < 3; ++a) {
      group.linear[a] = t[a] / group.mass;
      group.angular[a] = inverse[3 * a] * t[3] + inverse[3 * a + 1] * t[4] + inverse[3 * a + 2] * t[5];
    }
  }
}

api::Float4 ViscousGroups::without(const ParticleStore& store, uint32_t index, uint32_t i, const api::Float4& v) const {
  const Group& group = m_groups[index];
  if (!group.closed) return v;
  const api::Float4& p = store.position()[i];
  const double x = p.x - group.center[0], y = p.y - group.center[1], z = p.z - group.center[2];
  const auto& w = group.angular;
  return {static_cast<float>(v.x - group.linear[0] - (w[1] * z - w[2] * y)),
          static_cast<float>(v.y - group.linear[1] - (w[2] * x - w[0] * z)),
          static_cast<float>(v.z - group.linear[2] - (w[0] * y - w[1] * x)), 0};
}

}  // namespace ps
