// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/tools/porthandles.h"

#include <QtCore/QSizeF>

class QPainter;

namespace ps {

/// How emitters and sinks look over a picture: a mouth as a disc with an arrow along the jet, a sink as a box of wire.
/// Places in logical pixels of a picture of `size`.
struct PortView {
  PortSet ports;
  Camera camera;
  QSizeF size;
  std::optional<Port> hovered;
};
void paintPorts(QPainter& painter, const PortView& view);
/// m, of the shortest jet that such a picture shows of an emitter at this place.
double leastJet(const Camera& camera, double height, const Vector3& place);

}  // namespace ps
