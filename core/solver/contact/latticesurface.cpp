// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/latticesurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// How far from one plane the neighbours in a layer one particle thick may lie, in spacings.
constexpr double kSheet = 0.3;
/// Fewer neighbours make no surface: that is a line.
constexpr size_t kLeast = 3;

}  // namespace

void LatticeSurface::clear(size_t particles) {
  m_slot.assign(particles, kNone);
  m_who.clear();
  m_own.clear();
}

LatticeSurface::Normal LatticeSurface::normalOf(const ParticleStore& store, uint32_t i) const {
  const Own& own = m_own[m_slot[i]];
  if (own.count < kLeast) return {};
  std::array<Vector3, kMostOwn> lines;  // from each neighbour
  Vector3 sum;
  for (size_t k = 0; k < own.count; ++k) {
    lines[k] = vectorOf(store.separation(i, own.particles[k]));
    sum += lines[k];
  }
  const auto all = std::span(lines).first(own.count);
  // A layer one particle thick: all neighbours lie in one plane.
  Vector3 across;
  double largest = 0;
  for (const Vector3& line : all) {
    const Vector3 normal = lines[0].cross(line);
    const double square = normal.squaredNorm();
    if (square > largest) across = normal, largest = square;
  }
  if (const double size = std::sqrt(largest); size > 0.5 * m_spacing * m_spacing) {
    across /= size;
    const bool sheet = std::all_of(
        all.begin(), all.end(), [&](const Vector3& line) { return std::abs(line.dot(across)) < kSheet * m_spacing; });
    if (sheet) return {across, kFaceNeighbours, true};
  }
  const double length = sum.norm();
  // Inside a lattice the neighbours cancel: there is no face.
  if (!(length > 0.5 * m_spacing)) return {};
  return {sum / length, own.count, false};
}

LatticeSurface::Facing LatticeSurface::facing(const Normal& i, const Normal& j, const Vector3& line) const {
  const double length = line.norm();
  const Vector3 ofI = i.twoSided && i.normal.dot(line) > 0 ? Vector3(-i.normal) : i.normal,
                ofJ = j.twoSided && j.normal.dot(line) < 0 ? Vector3(-j.normal) : j.normal;
  // A face decides, the flatter one of two. Edges and corners of equal lattices that meet face to face lean evenly to
  // both sides; else they are round.
  Vector3 normal;
  if (i.neighbours == j.neighbours)
    normal = ofJ - ofI;
  else if (std::max(i.neighbours, j.neighbours) >= kFaceNeighbours)
    normal = j.neighbours > i.neighbours ? ofJ : Vector3(-ofI);
  const double size = normal.norm();
  if (size > 0.1) normal /= size;
  const double along = line.dot(normal);
  if (!(size > 0.1) || !(along > kFacing * length)) return {line / length};
  const Vector3 beside = line - along * normal;
  return {normal, true, !(beside.squaredNorm() < kFaceWidth * kFaceWidth * m_spacing * m_spacing)};
}

}  // namespace ps
