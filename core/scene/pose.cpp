// SPDX-License-Identifier: Apache-2.0
#include "core/scene/pose.h"

#include "core/scene/solidform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kUpright = 1 - 1e-12;  // sine of the turn about y from which those about x and z are one

std::string key(const char* what, size_t axis) { return std::string(what) + "_" + kAxes[axis]; }

double tidy(double degrees) { return std::round(degrees * 1e9) / 1e9 + 0.0; }

void place(SolidShape& solid, const char* what, const Vector3& values) {
  const api::ParameterList list = solidParameters();
  for (size_t a = 0; a < 3; ++a) {
    const std::string name = key(what, a);
    const auto axis = static_cast<Eigen::Index>(a);
    if (values[axis] == findDeclaration(list, name)->defaultValue)
      solid.parameters.values.erase(name);
    else
      solid.parameters.values[name] = values[axis];
  }
}

/// Degrees about x, then y, then z, of a turn.
Vector3 anglesOf(const Matrix3& m) {
  const double sine = std::clamp(-m(2, 0), -1.0, 1.0);
  if (std::abs(sine) > kUpright)
    return {0, tidy(std::copysign(90, sine)), tidy(kDegrees * std::atan2(-m(0, 1), m(1, 1)))};
  return {tidy(kDegrees * std::atan2(m(2, 1), m(2, 2))), tidy(kDegrees * std::asin(sine)),
          tidy(kDegrees * std::atan2(m(1, 0), m(0, 0)))};
}

std::array<int, 3> cellsOf(const VoxelShape& voxels, const Vector3& shift) {
  std::array<int, 3> cells{};
  for (size_t a = 0; a < 3; ++a)
    cells[a] = static_cast<int>(std::lround(shift[static_cast<Eigen::Index>(a)] / voxels.spacing));
  return cells;
}

void moveCells(VoxelShape& voxels, const std::array<int, 3>& cells) {
  for (VoxelShape::Run& run : voxels.runs) run.x += cells[0], run.y += cells[1], run.z += cells[2];
  for (VoxelShape::Stroke& stroke : voxels.strokes) {
    for (size_t a = 0; a < 3; ++a) {
      const double way = cells[a] * voxels.spacing;
      for (auto& sample : stroke.samples) sample[a] += way;
      if (stroke.symmetry) stroke.symmetry->centre[static_cast<Eigen::Index>(a)] += way;
    }
  }
}

Region around(const Region& region, const RigidMove& move) {
  Region box = region;
  box.minimum.setConstant(HUGE_VAL), box.maximum.setConstant(-HUGE_VAL);
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 p;
    for (int a = 0; a < 3; ++a) p[a] = (corner >> a & 1) != 0 ? region.maximum[a] : region.minimum[a];
    p = move.of(p);
    box.minimum = box.minimum.cwiseMin(p), box.maximum = box.maximum.cwiseMax(p);
  }
  return box;
}

/// The shift from one sketch to the other where they are of the same cells; in m.
std::optional<Vector3> shiftBetween(const VoxelShape& before, const VoxelShape& after) {
  if (before.runs.empty() || before.runs.size() != after.runs.size() || before.spacing != after.spacing)
    return std::nullopt;
  const VoxelShape::Run &from = before.runs.front(), &to = after.runs.front();
  const std::array<int, 3> way{to.x - from.x, to.y - from.y, to.z - from.z};
  VoxelShape gone;
  gone.runs = before.runs;
  moveCells(gone, way);
  if (gone.runs != after.runs) return std::nullopt;
  return after.origin - before.origin + before.spacing * Vector3(way[0], way[1], way[2]);
}

SolidShape solidOf(const BoxShape& box) {
  SolidShape solid;
  solid.parameters.values["kind"] = std::string("block");
  place(solid, "size", box.size);
  place(solid, "position", box.center);
  solid.unknown = box.unknown;
  return solid;
}

/// The shape of either kind of block as the solid one; of another solid its own.
std::optional<SolidShape> solidIn(const Body& body) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) return solidOf(*box);
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  return solid ? std::optional(*solid) : std::nullopt;
}

/// Whether two solids are the same but for where they are.
bool sameForm(SolidShape a, SolidShape b) {
  for (SolidShape* solid : {&a, &b}) {
    for (const char* what : {"position", "rotation"}) place(*solid, what, Vector3::Zero());
  }
  return a == b;
}

}  // namespace

BodyBounds boundsOf(const Body& body) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return {box->center - box->size / 2, box->center + box->size / 2};
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const SolidForm form(*solid);
    return {form.middle() - form.extent() / 2, form.middle() + form.extent() / 2};
  }
  const auto& voxels = std::get<VoxelShape>(body.shape);
  if (voxels.runs.empty()) return {voxels.origin, voxels.origin};
  Vector3 low = Vector3::Constant(HUGE_VAL), high = -low;
  for (const VoxelShape::Run& run : voxels.runs) {
    low = low.cwiseMin(Vector3(run.x, run.y, run.z));
    high = high.cwiseMax(Vector3(run.x + run.length - 1, run.y, run.z));
  }
  const Vector3 half = Vector3::Constant(0.5);
  return {voxels.origin + voxels.spacing * (low - half), voxels.origin + voxels.spacing * (high + half)};
}

Vector3 pivotOf(const Body& body) {
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  return solid ? SolidForm(*solid).middle() : boundsOf(body).middle();
}

Vector3 centroidOf(const Body& body) {
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const SolidForm form(*solid);
    return form.toScene(form.centroid());
  }
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  if (!voxels || voxels->runs.empty()) return pivotOf(body);
  Vector3 sum;
  double cells = 0;
  for (const VoxelShape::Run& run : voxels->runs) {
    sum += run.length * Vector3(run.x + 0.5 * (run.length - 1), run.y, run.z);
    cells += run.length;
  }
  return voxels->origin + voxels->spacing / cells * sum;
}

std::string whyNotTurned(const Body& body) {
  return std::holds_alternative<VoxelShape>(body.shape) ? "what is sketched stands along the axes of its cells" : "";
}

std::string whyNotScaled(const Body& body) {
  return std::holds_alternative<VoxelShape>(body.shape) ? "what is sketched keeps its cells; draw more of it" : "";
}

RigidMove possibleMove(const Body& body, const RigidMove& wanted) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  if (!voxels) return wanted;
  const std::array<int, 3> cells = cellsOf(*voxels, wanted.shift);
  return {Quaternion::Identity(), voxels->spacing * Vector3(cells[0], cells[1], cells[2])};
}

Body moved(Body body, const RigidMove& move) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape); box && move.turns()) body.shape = solidOf(BoxShape(*box));
  if (auto* box = std::get_if<BoxShape>(&body.shape)) {
    box->center += move.shift;
  } else if (auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const SolidForm form(*solid);
    place(*solid, "position", move.of(form.middle()));
    if (move.turns()) place(*solid, "rotation", anglesOf(move.turn.toRotationMatrix() * form.axes()));
  } else {
    auto& voxels = std::get<VoxelShape>(body.shape);
    moveCells(voxels, cellsOf(voxels, move.shift));
  }
  for (Region& pin : body.pins) pin = around(pin, move);
  if (move.turns()) body.temperatureGradient = move.turn * body.temperatureGradient;
  return body;
}

Body scaled(Body body, const Vector3& factors) {
  if (auto* box = std::get_if<BoxShape>(&body.shape)) {
    box->size = box->size.cwiseProduct(factors);
  } else if (auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const api::ParameterList list = solidParameters();
    const double wall = numberOf(solid->parameters, list, "wall");
    place(*solid, "size", SolidForm(*solid).size().cwiseProduct(factors));
    const SolidForm::Kind kind = SolidForm(*solid).kind();
    const bool isWalled = kind == SolidForm::Kind::Tube || kind == SolidForm::Kind::Bowl;
    if (isWalled && factors == Vector3::Constant(factors[0])) solid->parameters.values["wall"] = wall * factors[0];
  }
  return body;
}

Body sizedAs(Body body, const Body& other) {
  const std::optional<SolidShape> own = solidIn(body), wanted = solidIn(other);
  if (!own || !wanted || sameForm(*own, *wanted)) return body;
  SolidShape sized = *wanted;
  place(sized, "position", SolidForm(*own).middle());
  for (size_t a = 0; a < 3; ++a) {
    const std::string turn = key("rotation", a);
    sized.parameters.values.erase(turn);
    if (const auto set = own->parameters.values.find(turn); set != own->parameters.values.end())
      sized.parameters.values[turn] = set->second;
  }
  body.shape = std::move(sized);
  return body;
}

std::optional<RigidMove> moveBetween(const Body& before, const Body& after) {
  RigidMove move;
  if (const auto solid = solidIn(before), other = solidIn(after); solid || other) {
    if (!solid || !other || !sameForm(*solid, *other)) return std::nullopt;
    const SolidForm from(*solid), to(*other);
    const Matrix3 turn = to.axes() * from.axes().transpose();
    if (to.axes() != from.axes()) move.turn = Quaternion(turn).normalized();
    move.shift = move.turns() ? Vector3(to.middle() - move.turn * from.middle()) : Vector3(to.middle() - from.middle());
  } else {
    const auto shift = shiftBetween(std::get<VoxelShape>(before.shape), std::get<VoxelShape>(after.shape));
    if (!shift) return std::nullopt;
    move.shift = *shift;
  }
  return move.isNothing() ? std::nullopt : std::optional(move);
}

}  // namespace ps
