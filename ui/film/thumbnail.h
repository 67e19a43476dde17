// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

class QImage;

namespace ps {

/// A picture of a scene, small, as Project::thumbnail has it: the middle of it, 320 × 180 pixels.
std::string thumbnailOf(const QImage& picture);

}  // namespace ps
