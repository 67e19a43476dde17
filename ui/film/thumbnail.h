// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

class QImage;

namespace ps {

/// A picture of a scene, small, as Project::thumbnail has it: the middle of it, 320 × 180 pixels.
std::string thumbnailOf(const QImage& picture);
/// What that holds, at most 1024 pixels in each direction; null where it is anything else.
QImage pictureOf(const std::string& thumbnail);

}  // namespace ps
