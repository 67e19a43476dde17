// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/stroke.h"

#include "core/base/error.h"
#include "core/base/shorttext.h"
#include "core/scene/coat.h"
#include "core/scene/scenewall.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace ps {
namespace {

double distance(const api::Double3& a, const api::Double3& b) { return std::hypot(b.x - a.x, b.y - a.y, b.z - a.z); }

bool finite(const api::StrokeSample& s) {
  return std::isfinite(s.position.x) && std::isfinite(s.position.y) && std::isfinite(s.position.z) &&
         std::isfinite(s.pressure) && std::isfinite(s.time) && vectorOf(s.turn).allFinite();
}

constexpr double kNoTurn = 1e-9;  // rad

Quaternion quaternionOf(const api::Double3& turn) {
  const Vector3 v = vectorOf(turn);
  const double angle = v.norm();
  if (!(angle > kNoTurn)) return Quaternion::Identity();
  return Quaternion(Eigen::AngleAxisd(angle, Vector3(v / angle)));
}

Vector3 turnOf(const Quaternion& turned) {
  const Eigen::AngleAxisd turn(turned);
  return turn.angle() > kNoTurn ? Vector3(turn.angle() * turn.axis()) : Vector3(Vector3::Zero());
}

/// By the shorter way (Shoemake 1985).
api::Double3 turnBetween(const api::Double3& a, const api::Double3& b, double t) {
  if (a.x == b.x && a.y == b.y && a.z == b.z) return a;
  return double3Of(turnOf(quaternionOf(a).slerp(t, quaternionOf(b))));
}

/// Unit vector from one place to another one.
api::Double3 directionOf(const api::Double3& a, const api::Double3& b) {
  const double length = distance(a, b);
  return {(b.x - a.x) / length, (b.y - a.y) / length, (b.z - a.z) / length};
}

/// On the way from `a` to `b`, which are not at one place.
api::StrokeSample between(const api::StrokeSample& a, const api::StrokeSample& b, double t) {
  return {{std::lerp(a.position.x, b.position.x, t), std::lerp(a.position.y, b.position.y, t),
           std::lerp(a.position.z, b.position.z, t)},
          std::lerp(a.pressure, b.pressure, t),
          std::lerp(a.time, b.time, t),
          directionOf(a.position, b.position),
          b.velocity,
          turnBetween(a.turn, b.turn, t),
          std::lerp(a.way, b.way, t)};
}

constexpr double kSmoothed = 0.05;  // s, over which the speed of a hand is a mean

/// m/s, of a hand that has come from one place to the next.
api::Double3 velocityAt(const api::StrokeSample& before, const api::StrokeSample& here) {
  const double passed = here.time - before.time;
  if (!(passed > 0)) return before.velocity;
  const Vector3 was = vectorOf(before.velocity);
  const Vector3 now = (vectorOf(here.position) - vectorOf(before.position)) / passed;
  return double3Of(was + (1 - std::exp(-passed / kSmoothed)) * (now - was));
}

[[noreturn]] void refuseCells() {
  throw InputError("The stroke covers more than " + std::to_string(kMaxStrokeCells) +
                   " cells: use a smaller brush or a larger particle spacing");
}

constexpr std::array kKinds{api::EditKind::Add,    api::EditKind::Remove, api::EditKind::Paint,
                            api::EditKind::Smooth, api::EditKind::Fill,   api::EditKind::Colour};

}  // namespace

std::vector<api::StrokeSample> interpolateStroke(const api::StrokeSample& from, const api::StrokeSample& to,
                                                 double spacing) {
  const double count = std::ceil(distance(from.position, to.position) / spacing);
  std::vector<api::StrokeSample> samples;
  for (double i = 1; i < count; ++i) samples.push_back(between(from, to, i / count));
  if (count > 0) samples.push_back(between(from, to, 1));
  return samples;
}

StrokeResampler::StrokeResampler(double spacing) : m_spacing(spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing)) throw InputError("A stroke needs a spacing above 0 m");
}

std::vector<api::StrokeSample> StrokeResampler::add(const api::StrokeSample& raw) {
  std::vector<api::StrokeSample> dense;
  add(raw, dense);
  return dense;
}

void StrokeResampler::add(const api::StrokeSample& raw, std::vector<api::StrokeSample>& dense) {
  if (!finite(raw)) return;
  if (!m_last) {
    m_last = raw;
    m_last->direction = m_last->velocity = {0, 0, 0};
    m_last->way = 0;
    m_sinceLast = 0;
    dense.push_back(*m_last);
    return;
  }
  const double length = distance(m_last->position, raw.position);
  api::StrokeSample here = raw;
  here.way = m_last->way + length;
  here.velocity = velocityAt(*m_last, raw);
  const double first = m_spacing - m_sinceLast;  // arc length from m_last to the next dense sample
  double placed = 0;
  for (; first + placed * m_spacing <= length; ++placed) {
    if (placed > static_cast<double>(kMaxStrokeCells)) throw Error("The stroke is too long for its particle spacing");
    dense.push_back(between(*m_last, here, (first + placed * m_spacing) / length));
  }
  m_sinceLast = placed > 0 ? length - (first + (placed - 1) * m_spacing) : m_sinceLast + length;
  const api::Double3 direction = length > 0 ? directionOf(m_last->position, raw.position) : m_last->direction;
  m_last = here;
  m_last->direction = direction;
}

std::vector<api::StrokeSample> StrokeResampler::finish() {
  std::vector<api::StrokeSample> dense;
  // A millionth of a cell apart is the same point: rounding leaves such rests at the end of a whole number of steps.
  if (m_last && m_sinceLast > 1e-6 * m_spacing) dense.push_back(*m_last);
  m_last.reset();
  m_sinceLast = 0;
  return dense;
}

std::vector<api::StrokeSample> resampleStroke(std::span<const api::StrokeSample> raw, double spacing) {
  StrokeResampler resampler(spacing);
  std::vector<api::StrokeSample> dense;
  for (const api::StrokeSample& sample : raw) resampler.add(sample, dense);
  const std::vector<api::StrokeSample> end = resampler.finish();
  dense.insert(dense.end(), end.begin(), end.end());
  return dense;
}

Matrix3 strokeAxes(const Vector3& away) {
  const Vector3 up = away.norm() > 0 ? Vector3(away.normalized()) : Vector3(0, 1, 0);
  const Vector3 helper = std::abs(up.x()) < 0.9 ? Vector3(1, 0, 0) : Vector3(0, 1, 0);
  Matrix3 axes;
  axes.col(0) = (helper - helper.dot(up) * up).normalized();
  axes.col(1) = up;
  axes.col(2) = Vector3(axes.col(0)).cross(up);
  return axes;
}

Vector3 turnBetween(const Matrix3& from, const Matrix3& to) {
  return turnOf(Quaternion(Matrix3(to * from.transpose())).normalized());
}

Matrix3 turnMatrix(const Vector3& turn) { return quaternionOf(double3Of(turn)).toRotationMatrix(); }

api::StrokeContext contextOf(const StrokeSetup& setup) {
  const Matrix3 axes = strokeAxes(setup.up);
  api::StrokeContext context{setup.grid.spacing,
                             double3Of(setup.grid.origin),
                             setup.radius,
                             double3Of(axes.col(1)),
                             double3Of(axes.col(0)),
                             double3Of(axes.col(2)),
                             {setup.parameters.data(), setup.parameters.size()},
                             double3Of(setup.look)};
  if (!setup.stamp) return context;
  const StampCells& stamp = *setup.stamp;
  context.shape = {stamp.cells.data(), stamp.cells.size()};
  context.shapeSpacing = stamp.spacing;
  context.shapeMiddle = double3Of(stamp.middle);
  context.shapeHalf = double3Of(stamp.half);
  // A body stands on what is drawn on as it does on the floor.
  const Matrix3 lattice = axes * stamp.axes;
  context.shapeX = double3Of(lattice.col(0));
  context.shapeY = double3Of(lattice.col(1));
  context.shapeZ = double3Of(lattice.col(2));
  return context;
}

void askBrush(const api::BrushPlugin& brush, const StrokeSetup& setup, std::span<const api::StrokeSample> samples,
              const BrushCall& call, BrushRoom& room) {
  const api::StrokeContext own = contextOf(setup);
  if (room.images.empty()) room.images = imagesOf(setup.symmetry.value_or(VoxelShape::Symmetry{}));
  for (const SketchImage& image : room.images) {
    room.copies.assign(samples.begin(), samples.end());
    putInto(room.copies, image);
    api::StrokeContext context = imageOf(own, image);
    const std::optional<SeenMatter> seen = seenBy(brush, setup, context, room.copies);
    const api::NearMatter matter = seen ? seen->view() : api::NearMatter{};
    if (seen) context.matter = &matter;
    try {
      call(context, api::listOf(room.copies.data(), room.copies.size()));
    } catch (const Error&) {  // of what collects its answer
      throw;
    } catch (const std::exception& error) {
      throw BrushFault(shortText(error.what()));
    } catch (...) {
      throw BrushFault("it threw something that is no std::exception");
    }
  }
}

void BrushRun::submit(api::EditKind kind, api::Span<const api::Cell> cells) {
  if (cells.size > kMaxStrokeCells) refuseCells();
  if (!cells.data && cells.size > 0) throw BrushFault("it submitted cells by a null pointer");
  if (kind > api::EditKind::Colour) throw BrushFault("it submitted cells for an edit that there is not");
  if (kind != m_kind) flush();
  m_kind = kind;
  m_pending.insert(m_pending.end(), cells.begin(), cells.end());
  constexpr size_t kPiece = size_t{1} << 18;
  if (m_pending.size() > kPiece) flush();
}

/// Cells are merged in large pieces: a brush submits the same cells again for every sample.
void BrushRun::flush() {
  putInOrder(m_pending);
  m_edits.of(m_kind).addOrdered(m_pending);
  size_t all = 0;
  for (const api::EditKind kind : kKinds) {
    CellSet& cells = m_edits.of(kind);
    if (kind != m_kind && !cells.empty()) cells.removeOrdered(m_pending);
    all += cells.size();
  }
  m_pending.clear();
  if (all > kMaxStrokeCells) refuseCells();
}

StrokeEdits& BrushRun::apply(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                             std::span<const api::StrokeSample> samples) {
  for (const api::EditKind each : kKinds) m_edits.of(each).clear();
  m_pending.clear();
  m_kind = kind;
  const auto call = [&](const api::StrokeContext& context, const api::List<api::StrokeSample>& copies) {
    brush.stroke(context, kind, copies, *this);
  };
  askBrush(brush, setup, samples, std::cref(call), m_room);
  flush();
  return m_edits;
}

StrokeEdits applyBrush(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                       std::span<const api::StrokeSample> samples) {
  BrushRun run;
  return std::move(run.apply(brush, setup, kind, samples));
}

void applyBrush(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                std::span<const api::StrokeSample> samples, CellSet& cells) {
  const StrokeEdits edits = applyBrush(brush, setup, kind, samples);
  cells.remove(edits.removed.cells());
  cells.add(edits.added.cells());
}

bool isInScene(const Environment& environment, const SketchGrid& grid, const api::Cell& cell) {
  const Vector3 c = grid.centreOf(cell);
  const double radius = 0.49 * grid.spacing;
  for (int i = 0; i < 3; ++i) {
    if (c[i] < environment.boundsMinimum[i] + radius || c[i] > environment.boundsMaximum[i] - radius) return false;
  }
  return std::none_of(environment.walls.begin(), environment.walls.end(), [&](const SceneWall& wall) {
    const WallFace face = faceOf(wall);
    if (face.isCurved()) return face.heightOf(c) < radius;
    return (c - wall.point).dot(wall.normal) < radius * wall.normal.norm();
  });
}

api::EditKind kindOf(const api::BrushPlugin& brush, bool erase) {
  if (erase) return api::EditKind::Remove;
  if (brush.extension(api::kSmoothsMatter)) return api::EditKind::Smooth;
  if (brush.extension(api::kFillsHollows)) return api::EditKind::Fill;
  if (brush.extension(api::kColoursMatter)) return api::EditKind::Colour;
  return brush.extension(api::kPaintsMatter) ? api::EditKind::Paint : api::EditKind::Add;
}

std::string colourOf(const api::BrushPlugin& brush, const StrokeSetup& setup) {
  const auto* colours = static_cast<const api::ColourBrush*>(brush.extension(api::kColoursMatter));
  return colours ? colourCoat(vectorOf(colours->colour(contextOf(setup)))) : kNoColour;
}

StrokeSetup setupOf(const api::BrushPlugin& brush, const VoxelShape::Stroke& stroke, const SketchGrid& grid) {
  return {grid,
          stroke.radius,
          stroke.up,
          numbersOf(stroke.parameters, brush.parameters()),
          stroke.symmetry,
          {0, 0, 0},
          stroke.stamp ? stampCells(*stroke.stamp) : nullptr,
          {}};
}

StrokeEdits replayStroke(const api::BrushPlugin& brush, const VoxelShape::Stroke& stroke, const SketchGrid& grid,
                         const MatterWithin& matterWithin) {
  std::vector<api::StrokeSample> raw;
  raw.reserve(stroke.samples.size());
  for (const auto& s : stroke.samples) raw.push_back({{s[0], s[1], s[2]}, s[3], s[4], {}, {}, {s[5], s[6], s[7]}});
  StrokeSetup setup = setupOf(brush, stroke, grid);
  setup.matterWithin = matterWithin;
  return applyBrush(brush, setup, kindOf(brush, stroke.erase), resampleStroke(raw, grid.spacing));
}

}  // namespace ps
