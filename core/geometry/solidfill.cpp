// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/solidfill.h"

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/geometry/meshrepair.h"
#include "core/geometry/meshwinding.h"
#include "core/geometry/solidfacets.h"
#include "core/geometry/solidpacking.h"
#include "core/geometry/solidsurface.h"
#include "core/math/meshnearest.h"
#include "core/scene/solidform.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>

namespace ps {
namespace {

/// Cells up to which all ways to lay the lattice are tried; of meshes fewer, whose cells cost more.
constexpr double kSmall = 100'000, kSmallMesh = 4000;
constexpr double kInside = 0.5;    ///< of a winding number
constexpr double kLayer = 1.0001;  ///< of a layer's thickness: cells on both its faces lie in it
/// How far lattices stretch, per axis: second neighbours stay out of the reach of bonds, and those across a face stay
/// in it (1.7 spacings).
constexpr double kLeastStretch = 0.9, kMostStretch = 1.12;

/// The tree of the mesh that was asked about last is kept: its body is filled again and again.
std::shared_ptr<const MeshWinding> windingOf(const std::shared_ptr<const SceneMesh>& mesh) {
  static std::mutex mutex;
  static std::weak_ptr<const SceneMesh> lastMesh;
  static std::shared_ptr<const MeshWinding> last;
  const std::lock_guard lock(mutex);
  if (lastMesh.lock() != mesh || !last) {
    last = std::make_shared<const MeshWinding>(*mesh);
    lastMesh = mesh;
  }
  return last;
}

/// Cells of a box whose centres a test holds to be inside, row by row on all threads.
template <class Inside>
std::vector<std::array<int, 3>> cellsWithin(const std::array<int, 3>& count, const Inside& inside) {
  const size_t rows = static_cast<size_t>(count[1]) * static_cast<size_t>(count[2]);
  std::vector<std::vector<int>> found(rows);
  Progress* progress = t_progress;  // of this thread; others help it
  forChunks(rows, 1, [&](size_t first, size_t last) {
    for (size_t row = first; row < last; ++row) {
      if (progress) progress->advance(0);
      const int y = static_cast<int>(row) % count[1], z = static_cast<int>(row) / count[1];
      for (int x = 0; x < count[0]; ++x) {
        if (inside(x, y, z)) found[row].push_back(x);
      }
    }
  });
  std::vector<std::array<int, 3>> cells;
  for (size_t row = 0; row < rows; ++row) {
    advance(found[row].size());
    for (const int x : found[row])
      cells.push_back({x, static_cast<int>(row) % count[1], static_cast<int>(row) / count[1]});
  }
  return cells;
}

/// Of an extent, with a face in the middle (an even number of cells) or a cell (an odd one): as many as reach into it.
int layersOf(double extent, double spacing, bool even) {
  const double half = 0.5 * extent / spacing;
  if (even) return 2 * std::max(1, static_cast<int>(std::floor(half + 0.5)));
  return 2 * static_cast<int>(std::floor(half)) + 1;
}

/// Of so many cells about the solid's middle, those whose centres a test holds to be inside.
template <class Inside>
SolidCells filledBy(double spacing, const std::array<int, 3>& count, const Inside& inside) {
  // Halves of whole numbers are exact, so that both sides of the middle get the same answer.
  const Vector3 half = 0.5 * Vector3(count[0] - 1, count[1] - 1, count[2] - 1);
  return {-spacing * half,
          cellsWithin(count, [&](int x, int y, int z) { return inside(spacing * (Vector3(x, y, z) - half)); }),
          {1, 1, 1}};
}

SolidCells orMiddle(SolidCells filled) {
  return filled.cells.empty() ? SolidCells{{0, 0, 0}, {{0, 0, 0}}, {1, 1, 1}} : std::move(filled);
}

double within(double stretch) { return std::clamp(stretch, kLeastStretch, kMostStretch); }

/// Whole layers, as many as come closest.
SolidCells filledBlock(Vector3 size, double spacing, bool thin) {
  if (thin) size[1] = spacing;
  std::array<int, 3> count;
  for (size_t a = 0; a < 3; ++a) count[a] = static_cast<int>(layersAlong(size[a], spacing));
  SolidCells filled = filledBy(spacing, count, [](const Vector3&) { return true; });
  for (size_t a = 0; a < 3; ++a) filled.stretch[a] = within(size[a] / (count[a] * spacing));
  return filled;
}

/// The last few, since the same bodies are asked about by the scene, its panels and brushes.
template <class Fill>
class KnownFills {
 public:
  std::optional<Fill> find(const SolidShape& shape, double spacing) {
    const std::lock_guard lock(m_mutex);
    for (const Known& known : m_known) {
      if (known.spacing == spacing && known.shape == shape) return known.fill;
    }
    return std::nullopt;
  }
  void add(const SolidShape& shape, double spacing, const Fill& fill, size_t size) {
    if (size > kMostCells) return;
    const std::lock_guard lock(m_mutex);
    if (m_known.size() == kMostFills) m_known.pop_front();
    m_known.push_back({shape, spacing, fill});
  }

 private:
  static constexpr size_t kMostFills = 16, kMostCells = 250'000;
  struct Known {
    SolidShape shape;
    double spacing;
    Fill fill;
  };
  std::mutex m_mutex;
  std::deque<Known> m_known;
};

}  // namespace

SolidShape withoutPose(SolidShape shape) {
  std::erase_if(shape.parameters.values, [](const auto& value) {
    return value.first.starts_with("position_") || value.first.starts_with("rotation_");
  });
  return shape;
}

SolidInside::SolidInside(const SolidShape& shape, double layer)
    : m_form(std::make_unique<const SolidForm>(shape)), m_halfLayer(kLayer * layer / 2) {
  if (m_form->kind() != SolidForm::Kind::Mesh || !shape.mesh || shape.mesh->triangles.empty()) return;
  if (m_form->isHollow() && layer > 0) {
    m_skin = std::make_unique<const MeshNearest>(facetsOf(*shape.mesh, m_form->size()));
    return;
  }
  m_winding = windingOf(shape.mesh);
  const MeshBounds bounds = boundsOf(*shape.mesh);
  m_meshMiddle = (bounds.minimum + bounds.maximum) / 2;
  const Vector3 extent = bounds.maximum - bounds.minimum;
  m_toMesh = extent.cwiseQuotient(m_form->size());
}

SolidInside::~SolidInside() = default;

bool SolidInside::holds(const Vector3& own) const {
  if (m_skin) return m_skin->within(m_halfLayer, own).has_value();
  if (!m_winding) return m_form->holds(own);
  if ((own.cwiseAbs().array() > 0.5 * m_form->size().array()).any()) return false;
  return m_winding->at(m_meshMiddle + own.cwiseProduct(m_toMesh)) > kInside;
}

namespace {

/// m, along its own axes, how wide the box is in which its particles lie: half a layer of a surface lies outside.
Vector3 reachOf(const SolidForm& form, double spacing) {
  return form.isHollow() ? Vector3(form.size() + Vector3::Constant(spacing)) : form.size();
}

/// As fillSolid(), without looking whether it is known.
SolidCells newFill(const SolidShape& shape, double spacing) {
  const SolidInside solid(shape, spacing);
  const Vector3 size = reachOf(solid.form(), spacing);
  const SolidForm::Kind kind = solid.form().kind();
  if (kind == SolidForm::Kind::Block || kind == SolidForm::Kind::Sheet)
    return filledBlock(size, spacing, kind == SolidForm::Kind::Sheet);
  const double wanted = solid.form().volume(spacing) / (spacing * spacing * spacing);
  const double small = kind == SolidForm::Kind::Mesh ? kSmallMesh : kSmall;
  SolidCells best;
  double missed = HUGE_VAL;
  for (int way = 0; way < 8; ++way) {
    std::array<int, 3> count;
    bool suits = true;
    for (size_t a = 0; a < 3; ++a) {
      const bool even = (way >> a & 1) != 0;
      count[a] = layersOf(size[a], spacing, even);
      suits = suits && even == (std::lround(size[a] / spacing) % 2 == 0);
    }
    if (wanted > small && !suits) continue;
    SolidCells one = filledBy(spacing, count, [&](const Vector3& own) { return solid.holds(own); });
    const double miss = std::abs(static_cast<double>(one.cells.size()) - wanted);
    if (one.cells.empty() || miss >= missed) continue;
    missed = miss;
    best = std::move(one);
  }
  best = orMiddle(std::move(best));
  // Of an open mesh nobody knows the volume; steps of a single layer do not tell its area.
  if (solid.form().isHollow() || (shape.mesh && !factsOf(*shape.mesh).closed())) return best;
  best.stretch = Vector3::Constant(within(std::cbrt(wanted / static_cast<double>(best.cells.size()))));
  return best;
}

}  // namespace

SolidCells fillSolid(const SolidShape& shape, double spacing) {
  static KnownFills<SolidCells> known;
  const SolidShape upright = withoutPose(shape);
  if (std::optional<SolidCells> fill = known.find(upright, spacing)) return std::move(*fill);
  SolidCells fill = newFill(upright, spacing);
  known.add(upright, spacing, fill, fill.cells.size());
  return fill;
}

namespace {

/// m, along the solid's own axes.
std::vector<Vector3> ownPlaces(const SolidCells& filled, double spacing) {
  std::vector<Vector3> places;
  places.reserve(filled.cells.size());
  for (const auto& [x, y, z] : filled.cells)
    places.push_back(filled.stretch.cwiseProduct(filled.first + spacing * Vector3(x, y, z)));
  return places;
}

std::vector<api::Double3> inScene(const SolidForm& form, const std::vector<Vector3>& own) {
  std::vector<api::Double3> places;
  places.reserve(own.size());
  for (const Vector3& place : own) places.push_back(double3Of(form.toScene(place)));
  return places;
}

/// Along a rope from its first point to its last one, as near to a spacing from each other as whole steps allow; m,
/// along its own axes.
std::vector<Vector3> alongRope(const SolidForm& rope, double spacing) {
  const std::vector<Vector3>& points = rope.points();
  const double length = rope.volume(1);
  const auto steps = static_cast<int>(std::max(1.0, std::round(length / spacing)));
  std::vector<Vector3> places;
  size_t next = 1;
  double before = 0;  // m, from the rope's begin to the point before `next`
  for (int k = 0; k <= steps; ++k) {
    const double at = length * k / steps;
    double line = (points[next] - points[next - 1]).norm();
    while (next + 1 < points.size() && at > before + line) {
      before += line;
      ++next;
      line = (points[next] - points[next - 1]).norm();
    }
    const double share = line > 0 ? std::min(1.0, (at - before) / line) : 0;
    places.push_back(points[next - 1] + share * (points[next] - points[next - 1]));
  }
  return places;
}

/// As packSolid(), without packing again what is known.
std::vector<Vector3> packedPlaces(const SolidShape& shape, double spacing, const SolidCells& filled, double volume) {
  static KnownFills<std::vector<Vector3>> known;
  const SolidShape upright = withoutPose(shape);
  if (std::optional<std::vector<Vector3>> places = known.find(upright, spacing)) return std::move(*places);
  std::vector<Vector3> places = packSolid(SolidSurface(upright), ownPlaces(filled, spacing), volume);
  known.add(upright, spacing, places, places.size());
  return places;
}

}  // namespace

/// A block's lattice lies even as it is, and so do sheets and ropes.
bool isPacked(const SolidShape& shape, bool fixed) {
  const auto choice = [&](const char* key) { return choiceOf(shape.parameters, solidParameters(), key); };
  const std::string fill = choice("fill");
  return (fill == "relaxed" || (fixed && fill == "automatic")) && choice("kind") != "block" &&
         !SolidForm(shape).isOneLayer();
}

SolidMatter solidMatter(const SolidShape& shape, double spacing, bool fixed) {
  if (const SolidForm form(shape); form.kind() == SolidForm::Kind::Rope) {
    const std::vector<Vector3> along = alongRope(form, spacing);
    const double cell = spacing * spacing * spacing, each = form.volume(spacing) / static_cast<double>(along.size());
    return {inScene(form, along), std::max(each, kLeastStretch * cell), false};
  }
  const SolidCells filled = fillSolid(shape, spacing);
  const double volume = filled.stretch.prod() * spacing * spacing * spacing;
  const bool packed = isPacked(shape, fixed);
  return {inScene(SolidForm(shape), packed ? packedPlaces(shape, spacing, filled, volume) : ownPlaces(filled, spacing)),
          volume, packed};
}

std::vector<api::Double3> latticePlaces(const SolidShape& shape, double spacing) {
  const SolidForm form(shape);
  if (form.kind() == SolidForm::Kind::Rope) return inScene(form, alongRope(form, spacing));
  return inScene(form, ownPlaces(fillSolid(shape, spacing), spacing));
}

}  // namespace ps
