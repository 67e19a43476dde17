// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/surfacebox.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr double kShell = 1.2;                   ///< spacings to the neighbours that show how a lattice lies
constexpr size_t kMostInShell = 6;               ///< of a simple cubic lattice
constexpr double kAlong = 0.94, kAcross = 0.34;  ///< cosines within 20 degrees of an axis, and of what crosses it
constexpr double kReach = 2;                     ///< spacings to what may lie before a face
constexpr double kNearest = 0.3, kFarthest = 1.5, kAside = 0.75;  ///< spacings, where it lies before the face
constexpr double kGap = 0.5;        ///< spacings from which on two bodies do not just lie on each other
constexpr double kConducts = 0.98;  ///< spacings up to which heat conducts across a gap
constexpr double kAlike = 1;        ///< K
constexpr double kBesideWall = 1, kFacing = 0.7;
constexpr double kSlope = 0.66;  ///< mean open direction's length from which on a surface counts as plane
constexpr double kLowest = 0.1, kHighest = 0.55;  ///< spacings to a turned cube's front
constexpr double kCap = 0.82;  ///< cosine of the directions about a face that tell whether it is bare

/// In order of index.
struct Shell {
  std::array<Vector3, kMostInShell> way;
  std::array<uint32_t, kMostInShell> who;
  size_t count = 0;
  void add(uint32_t particle, const Vector3& unit) {
    size_t k = count++;
    for (; k > 0 && who[k - 1] > particle; --k) who[k] = who[k - 1], way[k] = way[k - 1];
    who[k] = particle, way[k] = unit;
  }
};

using Near = std::span<const uint32_t>;

template <class Visit>
void forNeighbours(const SurfaceSurroundings& around, Near near, uint32_t i, double reach, const Visit& visit) {
  const ParticleStore& store = around.store;
  const double square = reach * reach * around.spacing * around.spacing;
  for (const uint32_t j : near) {
    if (store.motion()[j] == api::Motion::Gas) continue;
    const Vector3 r = vectorOf(store.separation(j, i));
    const double distance = r.squaredNorm();
    if (distance < square && distance > 0) visit(j, r, distance);
  }
}

/// Mean of what lies along an axis or against it.
Vector3 refined(const Shell& shell, const Vector3& axis) {
  Vector3 sum = Vector3::Zero();
  for (size_t k = 0; k < shell.count; ++k) {
    const double along = axis.dot(shell.way[k]);
    if (std::abs(along) > kAlong) sum += along > 0 ? shell.way[k] : Vector3(-shell.way[k]);
  }
  return sum.normalized();
}

/// Unit vector across another, of the coordinate axes the one that crosses it most.
Vector3 across(const Vector3& axis) {
  size_t least = 0;
  for (size_t a = 1; a < 3; ++a) {
    if (std::abs(axis[a]) < std::abs(axis[least])) least = a;
  }
  Vector3 unit = Vector3::Zero();
  unit[least] = 1;
  return (unit - axis.dot(unit) * axis).normalized();
}

void setAxes(SurfaceBox& box, const Vector3& first, const Vector3& second) {
  const Vector3 all[3] = {first, second, first.cross(second)};
  for (size_t a = 0; a < 3; ++a) {
    for (size_t c = 0; c < 3; ++c) box.axes[a][c] = static_cast<float>(all[a][c]);
  }
}

/// Turns the box with the body's neighbours, if all of them lie along three axes.
bool findLattice(const SurfaceSurroundings& around, Near near, SurfaceBox& box) {
  const uint32_t i = box.particle;
  const uint32_t* body = around.store.body();
  Shell shell;
  bool crowded = false;
  forNeighbours(around, near, i, kShell, [&](uint32_t j, const Vector3& r, double square) {
    if (body[j] != body[i]) return;
    if (shell.count == kMostInShell)
      crowded = true;
    else
      shell.add(j, r / std::sqrt(square));
  });
  if (crowded) return false;
  if (shell.count == 0) {
    setAxes(box, Vector3::UnitX(), Vector3::UnitY());
    return true;
  }
  const Vector3 first = refined(shell, shell.way[0]);
  Vector3 second = across(first);
  for (size_t k = 0; k < shell.count; ++k) {
    if (!(std::abs(first.dot(shell.way[k])) < kAcross)) continue;
    const Vector3 mean = refined(shell, shell.way[k]);
    second = (mean - first.dot(mean) * first).normalized();
    break;
  }
  setAxes(box, first, second);
  for (size_t k = 0; k < shell.count; ++k) {
    double most = 0;
    for (size_t a = 0; a < 3; ++a) most = std::max(most, std::abs(box.axis(a).dot(shell.way[k])));
    if (!(most > kAlong)) return false;
  }
  return true;
}

/// What lies nearest before a face.
struct Opposite {
  double height = 1e30;  ///< m over the centre
  uint32_t particle = 0;
};

/// Notes the gap between a face and what lies before it.
void noteGap(const SurfaceSurroundings& around, const Opposite& opposite, SurfaceBox& box) {
  const ParticleStore& store = around.store;
  const double gap = opposite.height - around.spacing;
  const uint32_t i = box.particle, j = opposite.particle;
  if (gap < kGap * around.spacing || gap > kConducts * around.spacing || store.body()[j] == store.body()[i]) return;
  box.asksTemperature = true;
  if (std::abs(store.temperature()[j] - store.temperature()[i]) < kAlike) return;
  if (box.gap == 0 || gap < double{box.gap}) box.gap = static_cast<float>(gap);
}

void findBareFaces(const SurfaceSurroundings& around, Near near, SurfaceBox& box) {
  const double dx = around.spacing;
  std::array<Opposite, 6> opposite;
  forNeighbours(around, near, box.particle, kReach, [&](uint32_t j, const Vector3& r, double square) {
    for (size_t a = 0; a < 3; ++a) {
      const double height = box.axis(a).dot(r), h = std::abs(height);
      if (!(h > kNearest * dx && square - h * h < kAside * kAside * dx * dx)) continue;
      Opposite& here = opposite[2 * a + (height > 0 ? 0 : 1)];
      if (h < here.height || (h == here.height && j < here.particle)) here = {h, j};
    }
  });
  unsigned closed = 0;
  for (size_t face = 0; face < 6; ++face) {
    if (opposite[face].height < kFarthest * dx) closed |= 1u << face;
    noteGap(around, opposite[face], box);
  }
  const Vector3 x = vectorOf(around.store.position()[box.particle]);
  for (const Wall& wall : around.walls) {
    const Plane plane = faceOf(wall).at(x);
    const Vector3& normal = plane.normal;
    if (plane.heightOf(x) >= kBesideWall * dx) continue;
    for (size_t face = 0; face < 6; ++face) {
      if (normal.dot(box.normal(face)) < -kFacing) closed |= 1u << face;
    }
  }
  box.bare = static_cast<uint8_t>(~closed & 0x3f);
  box.area = static_cast<float>(std::popcount(box.bare) * dx * dx);
}

Vector3 directionOf(size_t d) {
  const auto& way = OpenSurface::directions()[d];
  return {way[0], way[1], way[2]};
}

/// Whether most directions about a normal are open.
bool isOpen(uint64_t open, const Vector3& normal) {
  int all = 0, free = 0;
  for (size_t d = 0; d < OpenSurface::kDirections; ++d) {
    if (!(normal.dot(directionOf(d)) > kCap)) continue;
    ++all;
    free += (open >> d & 1) != 0;
  }
  return 2 * free > all;
}

struct Opening {
  Vector3 normal;  ///< mean of the open directions
  double length;   ///< of that mean: 0.8 and more before a plane, in whatever position, 0.6 at an edge
};

Opening openingOf(uint64_t open) {
  Vector3 mean = Vector3::Zero();
  for (size_t d = 0; d < OpenSurface::kDirections; ++d) {
    if ((open >> d & 1) != 0) mean += directionOf(d);
  }
  const double length = mean.norm();
  if (!(length > 1e-3)) return {Vector3::UnitX(), 0};
  return {mean / length, length / std::popcount(open)};
}

void turn(const SurfaceSurroundings& around, const Vector3& normal, SurfaceBox& box) {
  setAxes(box, normal, across(normal));
  box.turned = true;
  box.bare = 1;
  box.height = static_cast<float>(around.level.heightOf(double{around.filled[box.particle]}));
}

/// Makes the step of a slope or a ball the piece of plane that it stands for.
void smooth(const SurfaceSurroundings& around, SurfaceBox& box) {
  const int faces = std::popcount(box.bare);
  const uint64_t open = around.surface.open(box.particle);
  if (faces < 2 || open == 0) return;
  const Opening opening = openingOf(open);
  if (opening.length < kSlope) return;
  // The steps of a plane show A |n_a| across each axis.
  double sum = 0;
  for (size_t a = 0; a < 3; ++a) sum += std::abs(box.axis(a).dot(opening.normal));
  turn(around, opening.normal, box);
  box.area = static_cast<float>(faces * around.spacing * around.spacing / sum);
}

void faceOpenDirections(const SurfaceSurroundings& around, SurfaceBox& box) {
  const uint64_t open = around.surface.open(box.particle);
  const Opening opening = openingOf(open);
  turn(around, opening.normal, box);
  if (open == 0) box.bare = 0;
  if (opening.length < kSlope) {
    for (size_t face = 1; face < 6; ++face) {
      if (isOpen(open, box.normal(face))) box.bare = static_cast<uint8_t>(box.bare | 1u << face);
    }
  }
  box.area = static_cast<float>(around.surface.area(box.particle));
}

}  // namespace

Vector3 SurfaceBox::meanNormal() const {
  Vector3 sum = Vector3::Zero();
  for (size_t face = 0; face < 6; ++face) {
    if (isBare(face)) sum += normal(face);
  }
  return sum;
}

SurfaceLevel SurfaceLevel::of(const Kernel& kernel, double spacing) {
  const int reach = static_cast<int>(kernel.supportRadius() / spacing);
  double flat = 0, oblique = 0;
  for (int z = -reach; z <= reach; ++z) {
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double w = kernel.value(spacing * std::sqrt(x * x + y * y + z * z)) * spacing * spacing * spacing;
        if (y <= 0) flat += w;
        if (x + y <= 0) oblique += w;
      }
    }
  }
  return {flat, (0.5 - 0.25 * std::numbers::sqrt2) / (flat - oblique)};
}

double SurfaceLevel::heightOf(double filled) const {
  return std::clamp(0.5 + slope * (filled - flat), kLowest, kHighest);
}

SurfaceBox surfaceBoxOf(const SurfaceSurroundings& around, Near near, uint32_t particle) {
  SurfaceBox box;
  box.particle = particle;
  if (findLattice(around, near, box)) {
    findBareFaces(around, near, box);
    smooth(around, box);
  } else {
    faceOpenDirections(around, box);
  }
  return box;
}

double boxReach() { return kReach; }

}  // namespace ps
