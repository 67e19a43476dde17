// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/wallface.h"
#include "core/scene/project.h"

namespace ps {

/// The face of a wall, as its place and its parameters shape, matter and radius say; its normal must not be zero.
WallFace faceOf(const SceneWall& wall);

}  // namespace ps
