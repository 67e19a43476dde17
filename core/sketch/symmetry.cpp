// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/symmetry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

SketchImage about(const Matrix3& turn, const Vector3& centre) { return {turn, centre - turn * centre}; }

/// An axis about which something turns: in a mirror it turns the other way round.
Vector3 turned(const SketchImage& image, const Vector3& turn) {
  return turn.isZero(0) ? turn : Vector3(image.turn.determinant() * (image.turn * turn));
}

}  // namespace

std::vector<SketchImage> imagesOf(const VoxelShape::Symmetry& symmetry) {
  const int turns = std::clamp(symmetry.turns, 1, kMostTurns);
  std::vector<SketchImage> images;
  for (int k = 0; k < turns; ++k) {
    const double angle = 2 * std::numbers::pi * k / turns, c = std::cos(angle), s = std::sin(angle);
    Matrix3 turn;
    turn << c, 0, s, 0, 1, 0, -s, 0, c;
    images.push_back(about(k == 0 ? Matrix3(Matrix3::Identity()) : turn, symmetry.centre));
  }
  const size_t axis = std::string("xyz").find(symmetry.mirror);
  if (symmetry.mirror.size() != 1 || axis == std::string::npos) return images;
  Matrix3 mirror = Matrix3::Identity();
  mirror(static_cast<int>(axis), static_cast<int>(axis)) = -1;
  for (size_t k = 0; k < static_cast<size_t>(turns); ++k)
    images.push_back(about(Matrix3(mirror * images[k].turn), symmetry.centre));
  return images;
}

std::vector<api::StrokeSample> imageOf(std::vector<api::StrokeSample> samples, const SketchImage& image) {
  putInto(samples, image);
  return samples;
}

void putInto(std::span<api::StrokeSample> samples, const SketchImage& image) {
  for (api::StrokeSample& sample : samples) {
    sample.position = double3Of(image.of(vectorOf(sample.position)));
    sample.direction = double3Of(image.turn * vectorOf(sample.direction));
    sample.velocity = double3Of(image.turn * vectorOf(sample.velocity));
    sample.turn = double3Of(turned(image, vectorOf(sample.turn)));
  }
}

std::vector<VoxelShape::Stroke> carried(const VoxelShape::Stroke& stroke, const RigidMove& move) {
  const VoxelShape::Symmetry none;
  const bool apart = stroke.symmetry && move.turns();
  std::vector<VoxelShape::Stroke> parts;
  for (const SketchImage& image : imagesOf(apart ? *stroke.symmetry : none)) {
    VoxelShape::Stroke part = stroke;
    if (apart) part.symmetry.reset();
    if (part.symmetry) part.symmetry->centre += move.shift;
    part.up = move.turn * (image.turn * stroke.up);
    for (auto& sample : part.samples) {
      const Vector3 place = move.of(image.of({sample[0], sample[1], sample[2]}));
      const Vector3 turn = move.turn * turned(image, {sample[5], sample[6], sample[7]});
      for (size_t a = 0; a < 3; ++a) {
        sample[a] = place[static_cast<Eigen::Index>(a)];
        sample[5 + a] = turn[static_cast<Eigen::Index>(a)];
      }
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

api::StrokeContext imageOf(api::StrokeContext context, const SketchImage& image) {
  for (api::Double3* axis :
       {&context.up, &context.side, &context.front, &context.look, &context.shapeX, &context.shapeY, &context.shapeZ})
    *axis = double3Of(image.turn * vectorOf(*axis));
  return context;
}

}  // namespace ps
