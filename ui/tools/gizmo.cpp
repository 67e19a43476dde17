// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/gizmo.h"

#include "ui/tools/aim.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

using Part = GizmoPart::Kind;

constexpr double kReach = 6;                // units of fineness around a line that take hold of it
constexpr double kMiddle = 9;               // around the middle
constexpr double kInner = 0.2;              // share of an arm that is left free around the middle
constexpr double kNear = 0.3, kFar = 0.48;  // ends of a plane's face, shares of an arm
constexpr double kAlongView = 0.97;         // cosine from which an arm points at the viewer
constexpr double kEdgeOn = 0.12;            // sine below which a plane or ring is seen from its edge
constexpr int kPoints = 64;                 // of a ring
constexpr double kLeastFactor = 0.01;

/// The axes across one.
std::pair<Vector3, Vector3> across(const Gizmo& gizmo, int axis) {
  return {gizmo.axes.col((axis + 1) % 3), gizmo.axes.col((axis + 2) % 3)};
}

double snapped(double value, double step) { return step > 0 ? step * std::round(value / step) : value; }

bool inside(const Pointer& pointer, const std::vector<Vector3>& face) {
  bool in = false;
  for (size_t i = 0; i < face.size(); ++i) {
    const auto a = aimTo(pointer, face[i]), b = aimTo(pointer, face[(i + 1) % face.size()]);
    if (!a || !b) return false;
    if ((a->y > 0) != (b->y > 0) && a->x - a->y * (b->x - a->x) / (b->y - a->y) > 0) in = !in;
  }
  return in;
}

double distanceTo(const Pointer& pointer, const GizmoShape& shape) {
  double least = HUGE_VAL;
  for (const auto& [a, b] : shape.lines) least = std::min(least, aimDistance(pointer, a, b));
  return least;
}

/// Of a ring, the half that is turned to the viewer: the other one lies behind what it turns.
GizmoShape ringOf(const Gizmo& gizmo, int axis, double arm, const Vector3& forward) {
  GizmoShape shape;
  const auto [u, v] = across(gizmo, axis);
  const auto at = [&, u = u, v = v](int k) -> Vector3 {
    const double angle = 2 * std::numbers::pi * k / kPoints;
    return std::cos(angle) * u + std::sin(angle) * v;
  };
  for (int k = 0; k < kPoints; ++k) {
    const Vector3 a = at(k), b = at(k + 1);
    if ((a + b).dot(forward) < 0.1) shape.lines.emplace_back(gizmo.centre + arm * a, gizmo.centre + arm * b);
  }
  return shape;
}

}  // namespace

double armOf(const Pointer& pointer, const Vector3& centre) {
  return kGizmoArm * pointer.fineness * std::max(1e-6, (centre - pointer.ray.origin).dot(pointer.forward));
}

GizmoShape shapeOf(const Gizmo& gizmo, const GizmoPart& part, double arm, const Vector3& forward) {
  if (part.kind == Part::Ring) return ringOf(gizmo, part.axis, arm, forward);
  GizmoShape shape;
  if (part.kind == Part::Arm) {
    const Vector3 axis = gizmo.axes.col(part.axis);
    shape.tip = gizmo.centre + arm * axis;
    shape.lines.emplace_back(gizmo.centre + kInner * arm * axis, *shape.tip);
  } else if (part.kind == Part::Plane) {
    const auto [u, v] = across(gizmo, part.axis);
    for (const auto& [a, b] : {std::pair(kNear, kNear), {kFar, kNear}, {kFar, kFar}, {kNear, kFar}})
      shape.face.push_back(gizmo.centre + arm * (a * u + b * v));
    for (size_t k = 0; k < 4; ++k) shape.lines.emplace_back(shape.face[k], shape.face[(k + 1) % 4]);
  } else {
    shape.lines.emplace_back(gizmo.centre, gizmo.centre);
  }
  return shape;
}

std::vector<GizmoPart> partsOf(const Gizmo& gizmo, const Vector3& forward) {
  std::vector<GizmoPart> parts;
  const bool turns = gizmo.kind == Gizmo::Kind::Rotate;
  if (!turns) parts.push_back({Part::Middle, 0});
  for (int axis = 0; axis < 3; ++axis) {
    const double facing = std::abs(gizmo.axes.col(axis).dot(forward));
    if (gizmo.kind == Gizmo::Kind::Move && facing > kEdgeOn) parts.push_back({Part::Plane, axis});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double facing = std::abs(gizmo.axes.col(axis).dot(forward));
    const bool stretches = gizmo.kind == Gizmo::Kind::Scale && !gizmo.along;
    if (turns || (!stretches && facing < kAlongView)) parts.push_back({turns ? Part::Ring : Part::Arm, axis});
  }
  return parts;
}

std::optional<GizmoPart> partAt(const Gizmo& gizmo, const Pointer& pointer) {
  const double arm = armOf(pointer, gizmo.centre);
  std::optional<GizmoPart> nearest;
  double least = HUGE_VAL;
  for (const GizmoPart& part : partsOf(gizmo, pointer.forward)) {
    const GizmoShape shape = shapeOf(gizmo, part, arm, pointer.forward);
    if (part.kind == Part::Middle && distanceTo(pointer, shape) < kMiddle) return part;
    if (!shape.face.empty() && inside(pointer, shape.face)) return part;
    const double away = distanceTo(pointer, shape);
    if (part.kind != Part::Middle && away < kReach && away < least) nearest = part, least = away;
  }
  return nearest;
}

GizmoGrip::GizmoGrip(const Gizmo& gizmo, const GizmoPart& part, const Pointer& pressed)
    : m_gizmo(gizmo), m_part(part), m_pressed(pressed), m_arm(armOf(pressed, gizmo.centre)) {
  m_pressed.scene = nullptr;  // its memory is not held meanwhile
  if (part.kind == Part::Arm) m_from = along(pressed.ray);
  m_last = onPlane(pressed.ray).value_or(gizmo.centre);
}

/// m along the arm, where it comes nearest to the ray.
double GizmoGrip::along(const Ray& ray) const {
  const Vector3 axis = m_gizmo.axes.col(m_part.axis), d = ray.direction.normalized(), w = m_gizmo.centre - ray.origin;
  const double b = axis.dot(d), square = 1 - b * b;
  return square > 1e-9 ? (b * d.dot(w) - axis.dot(w)) / square : 0;
}

/// Where a ray meets the plane that the handle moves on: its own, where that is not seen from its edge.
std::optional<Vector3> GizmoGrip::onPlane(const Ray& ray) const {
  const bool own = m_part.kind == Part::Plane || m_part.kind == Part::Ring;
  const Vector3 normal = own ? Vector3(m_gizmo.axes.col(m_part.axis)) : m_pressed.forward;
  const bool edge = std::abs(normal.dot(m_pressed.forward)) < kEdgeOn;
  return meet(ray, {m_gizmo.centre, edge ? m_pressed.forward : normal});
}

double GizmoGrip::raw(const Pointer& to) {
  const double fine = to.shift ? 0.1 : 1;
  if (m_part.kind == Part::Arm) {
    const double now = along(to.ray);
    if (m_gizmo.kind == Gizmo::Kind::Move) return fine * (now - m_from);
    return 1 + fine * ((std::abs(m_from) > 0.05 * m_arm ? now / m_from : 1 + (now - m_from) / m_arm) - 1);
  }
  if (m_part.kind == Part::Middle) {
    const auto a = aimTo(m_pressed, m_gizmo.centre), b = aimTo(to, m_gizmo.centre);
    return a && b ? 1 + fine * ((a->x - b->x) + (a->y - b->y)) / kGizmoArm : 1;
  }
  const auto now = onPlane(to.ray);
  if (!now) return m_turned;
  const Vector3 axis = m_gizmo.axes.col(m_part.axis), before = m_last - m_gizmo.centre, after = *now - m_gizmo.centre;
  if (std::abs(axis.dot(m_pressed.forward)) < kEdgeOn) {  // seen from its edge: it rolls along the view
    const Vector3 tangent = axis.cross(-m_pressed.forward).normalized();
    m_turned += fine * (*now - m_last).dot(tangent) / m_arm;
  } else {
    m_turned += fine * std::atan2(axis.dot(before.cross(after)), before.dot(after));
  }
  m_last = *now;
  return m_turned;
}

GizmoDrag GizmoGrip::drag(const Pointer& to, double step) {
  if (hasAmount()) {
    return exactly(snapped(raw(to), step));
  }
  GizmoDrag dragged;
  const auto from = onPlane(m_pressed.ray), now = onPlane(to.ray);
  if (!from || !now) return dragged;
  dragged.way = (to.shift ? 0.1 : 1) * (*now - *from);
  if (step <= 0) return dragged;
  Vector3 own = m_gizmo.axes.transpose() * dragged.way;
  for (double& c : own) c = snapped(c, step);
  dragged.way = m_gizmo.axes * own;
  return dragged;
}

GizmoDrag GizmoGrip::exactly(double amount) const {
  GizmoDrag dragged;
  dragged.amount = amount;
  if (m_gizmo.kind == Gizmo::Kind::Move) dragged.way = amount * m_gizmo.axes.col(m_part.axis);
  if (m_gizmo.kind != Gizmo::Kind::Scale) return dragged;
  dragged.amount = std::max(kLeastFactor, amount);
  if (m_part.kind == Part::Middle)
    dragged.factors.setConstant(dragged.amount);
  else
    dragged.factors[m_part.axis] = dragged.amount;
  return dragged;
}

bool GizmoGrip::hasAmount() const {
  return m_part.kind == Part::Arm || m_part.kind == Part::Ring || m_gizmo.kind == Gizmo::Kind::Scale;
}

}  // namespace ps
