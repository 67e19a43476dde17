// SPDX-License-Identifier: Apache-2.0
#include "core/scene/pose.h"

#include "core/scene/solidform.h"
#include "core/scene/turnedbox.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ps {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr double kNowhere = 1e-9;    // m
constexpr double kLeastCell = 5e-4;  // m, that a file may say
constexpr double kLargestCell = 10;  // m

std::string key(const char* what, size_t axis) { return std::string(what) + "_" + kAxes[axis]; }

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

void setPose(VoxelShape& voxels, const RigidMove& pose) {
  voxels.rotation = anglesOf(pose.turn.toRotationMatrix());
  voxels.shift = pose.shift;
  // Turned back to where it was drawn, it goes by whole cells again.
  if (voxels.rotation == Vector3::Zero() && voxels.shift.norm() < kNowhere) voxels.shift.setZero();
}

/// Of a sketch's cells as they were drawn; of one without cells a point.
BodyBounds drawnBounds(const VoxelShape& voxels) {
  if (voxels.runs.empty()) return {voxels.origin, voxels.origin};
  Vector3 low = Vector3::Constant(HUGE_VAL), high = -low;
  for (const VoxelShape::Run& run : voxels.runs) {
    low = low.cwiseMin(Vector3(run.x, run.y, run.z));
    high = high.cwiseMax(Vector3(run.x + run.length - 1, run.y, run.z));
  }
  const Vector3 half = Vector3::Constant(0.5);
  return {voxels.origin + voxels.spacing * (low - half), voxels.origin + voxels.spacing * (high + half)};
}

/// All that is long in a sketch in the ratio that its cells' edges become `spacing` m, about the middle of what was
/// drawn, which goes by `way` m.
void resize(VoxelShape& voxels, double spacing, const Vector3& way) {
  const double factor = spacing / voxels.spacing;
  const Vector3 middle = drawnBounds(voxels).middle();
  const auto gone = [&](const Vector3& p) -> Vector3 { return middle + way + factor * (p - middle); };
  voxels.origin = gone(voxels.origin);
  voxels.spacing = spacing;
  for (VoxelShape::Stroke& stroke : voxels.strokes) {
    stroke.radius *= factor;
    if (stroke.symmetry) stroke.symmetry->centre = gone(stroke.symmetry->centre);
    if (stroke.stamp) stroke.stamp->spacing *= factor;
    for (auto& sample : stroke.samples) {
      const Vector3 place = gone({sample[0], sample[1], sample[2]});
      std::copy_n(place.data(), 3, sample.begin());
    }
  }
}

/// The edge of its cells when a sketch becomes so much larger, as far as files can say what it was drawn with, m.
double possibleSpacing(const VoxelShape& voxels, double factor) {
  double least = voxels.spacing, most = voxels.spacing;
  for (const VoxelShape::Stroke& stroke : voxels.strokes) {
    if (!stroke.stamp) continue;
    least = std::min(least, stroke.stamp->spacing);
    most = std::max(most, stroke.stamp->spacing);
  }
  // Where stamps are finer by more than files' range allows, the largest counts.
  return voxels.spacing * std::min(std::max(factor, kLeastCell / least), kLargestCell / most);
}

/// Of factors along three axes, for what stays in proportion.
double greatestChange(const Vector3& factors) {
  Eigen::Index axis = 0;
  (factors - Vector3::Ones()).cwiseAbs().maxCoeff(&axis);
  return factors[axis];
}

void carryPins(Body& body, const RigidMove& move) {
  for (Region& pin : body.pins) {
    const BodyBounds box = carriedBounds({pin.minimum, pin.maximum}, move);
    pin.minimum = box.minimum, pin.maximum = box.maximum;
  }
}

/// Around points that are taken along.
struct CarriedBounds {
  RigidMove move;
  BodyBounds box{Vector3::Constant(HUGE_VAL), Vector3::Constant(-HUGE_VAL)};
  void add(const Vector3& point) {
    const Vector3 p = move.of(point);
    box = {box.minimum.cwiseMin(p), box.maximum.cwiseMax(p)};
  }
};

/// The shift from one sketch to the other where they were drawn of the same cells; in m.
std::optional<Vector3> shiftBetween(const VoxelShape& before, const VoxelShape& after) {
  if (before.runs.size() != after.runs.size() || before.spacing != after.spacing) return std::nullopt;
  if (before.runs.empty()) return after.origin - before.origin;
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
  const RigidMove pose = poseOf(voxels);
  if (pose.isNothing()) return drawnBounds(voxels);
  // Around its particles, whichever way their cells are turned.
  CarriedBounds carried{pose};
  if (voxels.runs.empty()) carried.add(voxels.origin);
  for (const VoxelShape::Run& run : voxels.runs) {
    for (const int x : {run.x, run.x + run.length - 1})
      carried.add(voxels.origin + voxels.spacing * Vector3(x, run.y, run.z));
  }
  const Vector3 half = Vector3::Constant(voxels.runs.empty() ? 0 : voxels.spacing / 2);
  return {carried.box.minimum - half, carried.box.maximum + half};
}

BodyBounds carriedBounds(const BodyBounds& box, const RigidMove& move) {
  CarriedBounds carried{move};
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 p;
    for (int a = 0; a < 3; ++a) p[a] = (corner >> a & 1) != 0 ? box.maximum[a] : box.minimum[a];
    carried.add(p);
  }
  return carried.box;
}

Vector3 pivotOf(const Body& body) {
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) return SolidForm(*solid).middle();
  // Of a sketch that is turned the same point of it, however it stands.
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  return voxels ? poseOf(*voxels).of(drawnBounds(*voxels).middle()) : boundsOf(body).middle();
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
  return poseOf(*voxels).of(voxels->origin + voxels->spacing / cells * sum);
}

RigidMove poseOf(const VoxelShape& voxels) {
  if (voxels.rotation == Vector3::Zero()) return {Quaternion::Identity(), voxels.shift};
  return {turnOf(voxels.rotation), voxels.shift};
}

VoxelShape latticeOf(const VoxelShape& voxels) {
  VoxelShape lattice;
  lattice.origin = voxels.origin, lattice.spacing = voxels.spacing;
  lattice.rotation = voxels.rotation, lattice.shift = voxels.shift;
  return lattice;
}

void carryLattice(VoxelShape& lattice, const RigidMove& move) {
  if (!move.turns() && poseOf(lattice).isNothing())
    lattice.origin += move.shift;
  else
    setPose(lattice, move.after(poseOf(lattice)));
}

RigidMove possibleMove(const Body& body, const RigidMove& wanted) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  if (!voxels || wanted.turns() || !poseOf(*voxels).isNothing()) return wanted;
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
    if (!move.turns() && poseOf(voxels).isNothing())
      moveCells(voxels, cellsOf(voxels, move.shift));
    else
      setPose(voxels, move.after(poseOf(voxels)));
  }
  carryPins(body, move);
  if (move.turns()) body.temperatureGradient = move.turn * body.temperatureGradient;
  return body;
}

Body scaled(Body body, const Vector3& factors, const Vector3& shift) {
  const RigidMove move{Quaternion::Identity(), shift};
  if (auto* voxels = std::get_if<VoxelShape>(&body.shape)) {
    // Its cells are no longer the scene's: it need not go by whole ones.
    const Vector3 way = poseOf(*voxels).turn.conjugate() * shift;
    resize(*voxels, possibleSpacing(*voxels, greatestChange(factors)), way);
    carryPins(body, move);
    return body;
  }
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
  return moved(std::move(body), move);
}

Body sizedAs(Body body, const Body& other) {
  if (auto* voxels = std::get_if<VoxelShape>(&body.shape)) {
    const auto* wanted = std::get_if<VoxelShape>(&other.shape);
    if (wanted && wanted->spacing != voxels->spacing) resize(*voxels, wanted->spacing, Vector3::Zero());
    return body;
  }
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
    const auto &from = std::get<VoxelShape>(before.shape), &to = std::get<VoxelShape>(after.shape);
    const auto shift = shiftBetween(from, to);
    if (!shift) return std::nullopt;
    if (from.rotation == to.rotation)
      move.shift = poseOf(to).turn * *shift + (to.shift - from.shift);
    else
      move = poseOf(to).after({Quaternion::Identity(), *shift}).after(poseOf(from).inverse());
  }
  return move.isNothing() ? std::nullopt : std::optional(move);
}

}  // namespace ps
