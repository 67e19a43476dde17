// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/tools/tool.h"

#include <QtCore/QRectF>
#include <QtCore/QSizeF>
#include <QtCore/QString>

#include <utility>

class QPainter;

namespace ps {

/// Handles over a picture: arms, faces and rings in the colours of the axes; while one is dragged it alone with its
/// number in a field. Places in logical pixels of a picture of `size`, over the uppermost `top` of which lies something
/// else: what is to be read stands below that.
void paintGizmo(QPainter& painter, const GizmoPicture& picture, const Camera& camera, const QSizeF& size,
                double top = 0);
/// A sentence at the top: what cannot be done with what is dragged, and why.
void paintNote(QPainter& painter, const QString& note, const QSizeF& size, double top = 0);
/// A frame that is drawn between two places.
void paintFrame(QPainter& painter, const std::pair<Vector3, Vector3>& corners, const Camera& camera,
                const QSizeF& size);
/// The field with the number of what is dragged, as it was painted; empty: there is none.
QRectF gizmoField(const GizmoPicture& picture, const Camera& camera, const QSizeF& size, double top = 0);

}  // namespace ps
