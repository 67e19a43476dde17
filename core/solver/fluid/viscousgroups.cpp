// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/viscousgroups.h"

#include "core/base/parallel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

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
    Sums sums;
    for (size_t k = segment.first; k < segment.last; ++k) {
      const Vector3 p = vectorOf(store.position()[m_rows[k]]);
      const double m = store.mass()[m_rows[k]];
      sums.mass += m;
      sums.first += m * p;
      sums.second += m * p * p.transpose();
    }
    m_sums[s] = sums;
  });
  for (Group& group : m_groups) {
    if (group.closed) measureInertia(group, spacing, !store.period().any());
  }
}

void ViscousGroups::measureInertia(Group& group, double spacing, bool turns) const {
  Sums sums;
  for (size_t s = group.firstSegment; s < group.lastSegment; ++s) {
    sums.mass += m_sums[s].mass;
    sums.first += m_sums[s].first;
    sums.second += m_sums[s].second;
  }
  group.mass = sums.mass;
  group.center = sums.first / sums.mass;
  group.inverseInertia.setZero();
  if (!turns) return;
  const Matrix3 moments = sums.second - sums.mass * group.center * group.center.transpose();
  // A group in a line has no inertia about it, and no angular momentum either.
  const double floor = 1e-9 * (moments.trace() + sums.mass * spacing * spacing);
  const Matrix3 inertia = (moments.trace() + floor) * Matrix3::Identity() - moments;
  group.inverseInertia = inertia.inverse();
}

void ViscousGroups::addMomenta(const ParticleStore& store, const api::Float4* vectors, size_t segment) {
  const Segment& range = m_segments[segment];
  const Group& group = m_groups[range.group];
  if (!group.closed) return;
  Vector3 linear, angular;
  for (size_t k = range.first; k < range.last; ++k) {
    const Vector3 arm = vectorOf(store.position()[m_rows[k]]) - group.center;
    const Vector3 momentum = double{store.mass()[m_rows[k]]} * vectorOf(vectors[k]);
    linear += momentum;
    angular += arm.cross(momentum);
  }
  m_sums[segment].first = linear;
  m_sums[segment].angular = angular;
}

void ViscousGroups::reduceMomenta() {
  for (Group& group : m_groups) {
    if (!group.closed) continue;
    Vector3 linear, angular;
    for (size_t s = group.firstSegment; s < group.lastSegment; ++s) {
      linear += m_sums[s].first;
      angular += m_sums[s].angular;
    }
    group.linear = linear / group.mass;
    group.angular = group.inverseInertia * angular;
  }
}

api::Float4 ViscousGroups::without(const ParticleStore& store, uint32_t index, uint32_t i, const api::Float4& v) const {
  const Group& group = m_groups[index];
  if (!group.closed) return v;
  const Vector3 arm = vectorOf(store.position()[i]) - group.center;
  return float4Of(vectorOf(v) - group.linear - group.angular.cross(arm), 0);
}

}  // namespace ps
