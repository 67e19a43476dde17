// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/tools/tool.h"

#include <QtCore/QSizeF>

class QPainter;

namespace ps {

/// Outlines of walls and pins over a picture of `size`, in logical pixels.
void paintWires(QPainter& painter, const std::vector<Wire>& wires, const Camera& camera, const QSizeF& size);
/// Marks at what is held where it is.
void paintPins(QPainter& painter, const std::vector<Vector3>& places, const Camera& camera, const QSizeF& size);

}  // namespace ps
