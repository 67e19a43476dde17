// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/port.h"
#include "ui/render/camera.h"

#include <QtCore/QPointF>
#include <QtCore/QSizeF>

#include <optional>
#include <variant>
#include <vector>

class QPainter;

namespace ps {

/// How emitters and sinks look over the picture: a mouth as a disc with an arrow along the jet, a sink as a box of
/// wire. Pure: no widget, no document. Places in logical pixels of a picture of `size`.

/// A part of an emitter or a sink that can be dragged.
struct PortHandle {
  enum class Part { Whole, Tip, Corner };
  Port port;
  Part part = Part::Whole;
  int corner = 0;          ///< bit a set: at the maximum of axis a
  Vector3 place{0, 0, 0};  ///< m, where it is
  bool operator==(const PortHandle&) const = default;
};

/// A picture and what is marked in it.
struct PortView {
  const std::vector<Emitter>* emitters = nullptr;
  const std::vector<Sink>* sinks = nullptr;
  Camera camera;
  QSizeF size;
  std::optional<Port> selected, hovered;
};

/// Where the arrow of a jet ends, m: two widths of the mouth away, and far enough to be seen.
Vector3 arrowTip(const Emitter& emitter, const Camera& camera, double height);
Vector3 cornerOf(const Sink& sink, int corner);
/// What the pointer can take hold of; tips and corners of the selected one only.
std::optional<PortHandle> handleAt(const PortView& view, const QPointF& position);
void paintPorts(QPainter& painter, const PortView& view);

// What a drag of a handle to a place in m gives.
Emitter dragged(Emitter emitter, const PortHandle& handle, const Vector3& to);
/// `least`: shortest edge, m.
Sink dragged(Sink sink, const PortHandle& handle, const Vector3& to, double least);

}  // namespace ps
