// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/scene/project.h"

#include <phasesketch/brush.h>

#include <span>
#include <vector>

namespace ps {

/// Where a copy of a stroke lies: turned or mirrored about a point.
struct SketchImage {
  Matrix3 turn = Matrix3::Identity();  ///< orthogonal
  Vector3 shift{0, 0, 0};              ///< m
  Vector3 of(const Vector3& place) const { return turn * place + shift; }
};

/// All copies that are drawn at once, the stroke itself first: `turns` of them about the upright axis, and each in the
/// mirror too. Fewer than one turn counts as one, more than kMostTurns as those.
std::vector<SketchImage> imagesOf(const VoxelShape::Symmetry& symmetry);

/// The samples as they lie in a copy.
std::vector<api::StrokeSample> imageOf(std::vector<api::StrokeSample> samples, const SketchImage& image);
void putInto(std::span<api::StrokeSample> samples, const SketchImage& image);

/// A stroke as it is after a move of what it is drawn on. Where that is turned each of its copies is a stroke of its
/// own, since mirrors and axes stand along the scene's.
std::vector<VoxelShape::Stroke> carried(const VoxelShape::Stroke& stroke, const RigidMove& move);

/// What a brush knows of the stroke, as it lies there.
api::StrokeContext imageOf(api::StrokeContext context, const SketchImage& image);

}  // namespace ps
