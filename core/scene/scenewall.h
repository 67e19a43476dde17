// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/wallface.h"
#include "core/scene/project.h"

#include <string>

namespace ps {

/// The face of a wall, as its place and its parameters shape, matter and radius say; its normal must not be zero.
WallFace faceOf(const SceneWall& wall);
/// What a wall's parameter `shape` calls a form.
const std::string& shapeOf(WallForm form);

}  // namespace ps
