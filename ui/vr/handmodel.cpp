// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/handmodel.h"

#include "core/sketch/stampform.h"
#include "ui/render/colourmap.h"
#include "ui/render/uniforms.h"
#include "ui/vr/barehand.h"
#include "ui/vr/suggestions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace ps::vr {
namespace {

using Colour = std::array<float, 3>;

constexpr int kSides = 20, kBoneSides = 8;
constexpr double kThinnest = 0.2;  // of the wrist, where a runtime tells no radius
constexpr float kOpacity = 0.22f;  // of a brush's volume, seen straight on

constexpr double kBack = 0.015;                            // m over the wand's axis, of what thumbs reach
constexpr double kRing = 0.046, kRingTube = 0.0038;        // m
constexpr double kRingTilt = 50 * std::numbers::pi / 180;  // forward, from across the wand
const Vector3 kRingPlace(0, 0.022, 0.018);                 // m

MeshVertex corner(const Vector3& place, const Vector3& normal, const Colour& c, float fourth) {
  return {render::floats(place), render::floats(normal), {c[0], c[1], c[2], fourth}};
}

/// Of a body turned about its axis.
struct Ring {
  double along, radius;  ///< m
};

/// The band between two rings about the hand's z, smooth around.
void addBand(std::vector<MeshVertex>& out, const HandPose& hand, double scale, const Ring& a, const Ring& b,
             const Colour& colour, int sides = kSides) {
  const auto at = [&](const Ring& ring, double angle) -> Vector3 {
    const Vector3 own(ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.along);
    return hand.position + scale * (hand.orientation * own);
  };
  // Outwards, across the band's slope.
  const double rise = a.radius - b.radius, run = b.along - a.along;
  const auto normal = [&](double angle) -> Vector3 {
    return hand.orientation * Vector3(run * std::cos(angle), run * std::sin(angle), rise).normalized();
  };
  for (int k = 0; k < sides; ++k) {
    const double p = 2 * std::numbers::pi * k / sides, q = 2 * std::numbers::pi * (k + 1) / sides;
    const MeshVertex corners[] = {corner(at(a, p), normal(p), colour, 0), corner(at(a, q), normal(q), colour, 0),
                                  corner(at(b, q), normal(q), colour, 0), corner(at(b, p), normal(p), colour, 0)};
    for (const int i : {0, 1, 2, 0, 2, 3}) out.push_back(corners[i]);
  }
}

/// `rows`: half of its columns; `fourth`: as in MeshVertex::material.
void addBall(std::vector<MeshVertex>& out, const Vector3& centre, const Vector3& half, const Colour& colour, int rows,
             float fourth) {
  const int columns = 2 * rows;
  const auto at = [&](int row, int column) {
    const double up = std::numbers::pi * (0.5 - double(row) / rows), around = 2 * std::numbers::pi * column / columns;
    const Vector3 unit(std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around));
    return corner(centre + unit.cwiseProduct(half), unit.cwiseQuotient(half).normalized(), colour, fourth);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const MeshVertex corners[] = {at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)};
      for (const int i : {0, 1, 2, 0, 2, 3}) out.push_back(corners[i]);
    }
}

void addBox(std::vector<MeshVertex>& out, const Vector3& centre, const Vector3& half, const Colour& colour) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vector3 normal = Vector3::Zero(), u = Vector3::Zero(), v = Vector3::Zero();
      normal[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = 1;
      const auto at = [&](double x, double y) {
        return corner(centre + (normal + x * u + y * v).cwiseProduct(half), normal, colour, kOpacity);
      };
      const MeshVertex corners[] = {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)};
      for (const int i : {0, 1, 2, 0, 2, 3}) out.push_back(corners[i]);
    }
}

void addForm(std::vector<MeshVertex>& out, const Vector3& centre, const StampForm& form, const Colour& colour) {
  for (const StampForm::Face& face : form.faces) {
    const std::array<Vector3, 4> around = form.corners(face);
    for (const size_t i : {0, 1, 2, 0, 2, 3})
      out.push_back(corner(centre + around[i], form.normal(face), colour, kOpacity));
  }
}

/// A disc on the wand's back, so far along it and aside.
void addDisc(std::vector<MeshVertex>& out, const HandPose& hand, double scale, const Vector3& at, const Ring& top,
             const Colour& colour) {
  const HandPose up{hand.position + scale * (hand.orientation * at),
                    hand.orientation * Quaternion::FromTwoVectors(Vector3::UnitZ(), Vector3::UnitY())};
  addBand(out, up, scale, {0, top.radius}, top, colour);
  addBand(out, up, scale, top, {top.along, 0}, colour);
}

void addRing(std::vector<MeshVertex>& out, const HandPose& hand, double scale, const Colour& colour) {
  constexpr int kParts = 28;
  const auto at = [](int part) -> Vector3 {
    const double angle = 2 * std::numbers::pi * part / kParts, up = kRing * std::sin(angle);
    return kRingPlace + Vector3(kRing * std::cos(angle), up * std::cos(kRingTilt), -up * std::sin(kRingTilt));
  };
  for (int part = 0; part < kParts; ++part) {
    const Vector3 from = at(part), way = at(part + 1) - from;
    const HandPose along{hand.position + scale * (hand.orientation * from),
                         hand.orientation * Quaternion::FromTwoVectors(Vector3::UnitZ(), way)};
    addBand(out, along, scale, {0, kRingTube}, {way.norm(), kRingTube}, colour, kBoneSides);
  }
}

}  // namespace

void addController(Props& props, const HandPose& hand, double scale, const HandColours& colours,
                   const ControllerParts& parts) {
  const Colour body = render::sceneColour(colours.dark, "rim"), ring = render::sceneColour(colours.dark, "foot");
  constexpr Ring kRings[] = {{0.115, 0},      {0.112, 0.010},  {0.100, 0.014},  {0.020, 0.018},    {0.012, 0.0185},
                             {-0.004, 0.017}, {-0.012, 0.009}, {-kTip, 0.0012}, {-kTip - 0.001, 0}};
  const Colour* bands[] = {&body, &body, &body, &ring, &body, &body, &colours.tip, &colours.tip};
  for (size_t i = 0; i + 1 < std::size(kRings); ++i)
    addBand(props.opaque, hand, scale, kRings[i + 1], kRings[i], *bands[i]);
  if (parts.ring) addRing(props.opaque, hand, scale, body);
  if (parts.pad) addDisc(props.opaque, hand, scale, {0, kBack, 0.045}, {0.006, 0.017}, ring);
  if (parts.stick) {
    addDisc(props.opaque, hand, scale, {0, kBack, 0.028}, {0.010, 0.004}, body);
    addDisc(props.opaque, hand, scale, {0, kBack + 0.010, 0.028}, {0.003, 0.008}, ring);
  }
  for (int button = 0; button < parts.buttons; ++button) {
    const double aside = parts.buttons > 1 ? 0.006 * (2 * button - 1) : 0;
    addDisc(props.opaque, hand, scale, {aside, kBack, parts.pad ? 0.072 : 0.05}, {0.0045, 0.0045}, ring);
  }
}

void addHand(Props& props, const HandJoints& joints, const HandColours& colours) {
  constexpr size_t kFingers[] = {2, 6, 11, 16, 21, kJoints};  // their first joints; the thumb has one less
  const Colour skin = render::sceneColour(colours.dark, "rim");
  const auto radius = [&](size_t joint) { return std::max(joints[joint].radius, kThinnest * joints[1].radius); };
  const auto bone = [&](size_t a, size_t b) {
    const Vector3 way = joints[b].position - joints[a].position;
    const HandPose pose{joints[a].position, Quaternion::FromTwoVectors(Vector3::UnitZ(), way)};
    addBand(props.opaque, pose, 1, {0, radius(a)}, {way.norm(), radius(b)}, skin, kBoneSides);
  };
  for (size_t finger = 0; finger + 1 < std::size(kFingers); ++finger) {
    bone(kWristJoint, kFingers[finger]);
    for (size_t joint = kFingers[finger]; joint + 1 < kFingers[finger + 1]; ++joint) bone(joint, joint + 1);
    if (finger > 1) bone(kFingers[finger - 1] + 1, kFingers[finger] + 1);  // from knuckle to knuckle
  }
  for (size_t joint = kWristJoint; joint < kJoints; ++joint)
    addBall(props.opaque, joints[joint].position, Vector3::Constant(radius(joint)),
            joint == kIndexTip ? colours.tip : skin, kBoneSides / 2, 0);
}

void addBeam(Props& props, const HandPose& hand, double scale, double length, const Colour& colour) {
  const Ring rings[] = {
      {-kTip, 0.003}, {0.004 - length, 0.001}, {0.004 - length, 0.005}, {0.001 - length, 0.005}, {0.001 - length, 0}};
  for (size_t i = 0; i + 1 < std::size(rings); ++i) addBand(props.opaque, hand, scale, rings[i + 1], rings[i], colour);
}

void addVolume(Props& props, const Vector3& centre, const BrushVolume& brush) {
  if ((brush.half.array() <= 0).any()) return;
  if (brush.form)
    addForm(props.clear, centre, *brush.form, brush.colour);
  else if (brush.box)
    addBox(props.clear, centre, brush.half, brush.colour);
  else
    addBall(props.clear, centre, brush.half, brush.colour, 12, kOpacity);
}

}  // namespace ps::vr
