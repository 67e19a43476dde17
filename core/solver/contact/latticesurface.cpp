// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/latticesurface.h"

#include "core/base/parallelarrays.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// How far from one plane the neighbours in a layer one particle thick may lie, in spacings.
constexpr double kSheet = 0.3;
/// Fewer neighbours make no surface: that is a line.
constexpr size_t kLeast = 3;
/// How far tangent planes of a known shape are blended, in spacings.
constexpr double kBlend = 1.5;
/// More neighbours than a lattice has: a known surface decides.
constexpr uint32_t kFlattest = 64;

}  // namespace

void LatticeSurface::clear(size_t particles) {
  assignAll(m_slot, particles, kNone);
  m_who.clear();
  m_own.clear();
}

LatticeSurface::Normal LatticeSurface::normalOf(const ParticleStore& store, uint32_t i) const {
  if (isTrue(store, i)) return {vectorOf(m_true[i]), kFlattest, false, double{m_true[i].w} - 0.5 * m_spacing};
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

/// Of what stands at `line` m from j.
LatticeSurface::Facing LatticeSurface::onShape(const ParticleStore& store, uint32_t j, const Vector3& line) const {
  const double reach2 = kBlend * kBlend * m_spacing * m_spacing;
  Vector3 normal;
  double height = 0, weights = 0;
  const auto add = [&](uint32_t k, const Vector3& toPlace) {
    const Vector3 n = vectorOf(m_true[k]), above = toPlace - double{m_true[k].w} * n;  // from the surface beside k
    const double share = 1 - above.squaredNorm() / reach2;
    if (!(share > 0)) return;
    const double weight = share * share;
    normal += weight * n;
    height += weight * above.dot(n);
    weights += weight;
  };
  add(j, line);
  if (m_slot[j] != kNone) {
    const Own& own = m_own[m_slot[j]];
    for (size_t k = 0; k < own.count; ++k) {
      if (isTrue(store, own.particles[k]))
        add(own.particles[k], line + vectorOf(store.separation(j, own.particles[k])));
    }
  }
  const double size = normal.norm(), length = line.norm();
  if (!(size > 0.1 * weights) || !(weights > 0)) return {line / length};
  normal /= size;
  const double along = line.dot(normal);
  if (!(along > kFacing * length)) return {line / length};
  // They touch half a spacing above the surface.
  const double lift = along - height / weights - 0.5 * m_spacing;
  const bool beside = !((line - along * normal).squaredNorm() < kFaceWidth * kFaceWidth * m_spacing * m_spacing);
  return {normal, true, beside, lift};
}

LatticeSurface::Facing LatticeSurface::facing(const Normal& i, const Normal& j, const Vector3& line) const {
  const double length = line.norm();
  const Vector3 ofI = i.twoSided && i.normal.dot(line) > 0 ? Vector3(-i.normal) : i.normal,
                ofJ = j.twoSided && j.normal.dot(line) < 0 ? Vector3(-j.normal) : j.normal;
  // A face decides, the flatter one of two. Edges and corners of equal lattices that meet face to face lean evenly to
  // both sides; else they are round.
  Vector3 normal;
  const double lift = j.neighbours > i.neighbours ? j.lift : i.lift;
  if (i.neighbours == j.neighbours)
    normal = ofJ - ofI;
  else if (std::max(i.neighbours, j.neighbours) >= kFaceNeighbours)
    normal = j.neighbours > i.neighbours ? ofJ : Vector3(-ofI);
  const double size = normal.norm();
  if (size > 0.1) normal /= size;
  const double along = line.dot(normal);
  if (!(size > 0.1) || !(along > kFacing * length)) return {line / length};
  const Vector3 beside = line - along * normal;
  return {normal, true, !(beside.squaredNorm() < kFaceWidth * kFaceWidth * m_spacing * m_spacing), lift};
}

}  // namespace ps
