// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/handletool.h"

#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/tools/aim.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

#include <utility>

namespace ps {

std::optional<PortHandle> HandleTool::handleUnder(const Pointer& pointer) const {
  const Project& project = box().document().project();
  return handleAt({&project.emitters, &project.sinks, box().selection().port(), pointer.section}, pointer);
}

void HandleTool::hover(const Pointer& pointer) { m_hovered = handleUnder(pointer); }

bool HandleTool::press(const Pointer& pointer) {
  const auto handle = handleUnder(pointer);
  if (!handle) return false;
  Document& document = box().document();
  m_grip = Grip{*handle, Emitter{}, pointer};
  m_grip->pressed.scene = nullptr;  // its memory is not held meanwhile
  if (handle->port.sink) {
    m_grip->before = *document.sink(handle->port.id);
  } else {
    m_grip->before = *document.emitter(handle->port.id);
  }
  m_grip->begun = document.changeCount();
  document.beginGesture();
  box().selection().select(handle->port);
  return true;
}

void HandleTool::drag(const Pointer& pointer) {
  if (!m_grip || (!m_grip->moved && !wandered(m_grip->pressed, pointer))) return;
  m_grip->moved = true;
  const PortHandle& handle = m_grip->handle;
  const Vector3& forward = m_grip->pressed.forward;
  const bool whole = handle.part == PortHandle::Part::Whole, upright = whole && pointer.shift;
  const DrawingPlane plane = upright ? uprightThrough(handle.place, forward)
                             : whole ? drawingPlaneFor(handle.place, forward)
                                     : DrawingPlane{handle.place, forward};
  const auto from = meet(m_grip->pressed.ray, plane), to = meet(pointer.ray, plane);
  if (!from || !to) return;
  Vector3 target = handle.place + (*to - *from);
  if (upright) target = Vector3(handle.place.x(), target.y(), handle.place.z());
  Document& document = box().document();
  const QString title = (whole                                     ? QStringLiteral("moving %1")
                         : handle.part == PortHandle::Part::Corner ? QStringLiteral("size of %1")
                                                                   : QStringLiteral("direction of %1"))
                            .arg(document.portName(handle.port));
  if (const auto* emitter = std::get_if<Emitter>(&m_grip->before)) {
    document.editEmitter(dragged(*emitter, handle, target), title);
  } else {
    document.editSink(dragged(std::get<Sink>(m_grip->before), handle, target, shownSpacing(pointer, box().spacing())),
                      title);
  }
}

void HandleTool::release(const Pointer&) { end(true); }

bool HandleTool::cancel() {
  const bool busy = m_grip.has_value();
  end(false);
  return busy;
}

void HandleTool::end(bool keep) {
  if (!m_grip) return;
  const Grip grip = *std::exchange(m_grip, {});
  Document& document = box().document();
  // Another project may have taken the place of the one that it began in, with things of the same ids.
  if (!keep && grip.moved && document.had(grip.begun)) {
    if (const auto* emitter = std::get_if<Emitter>(&grip.before)) {
      document.editEmitter(*emitter, {});
    } else {
      document.editSink(std::get<Sink>(grip.before), {});
    }
  }
  document.endGesture();
}

ToolPicture HandleTool::picture() const {
  ToolPicture picture;
  if (!m_hovered) return picture;
  picture.hovered = m_hovered->port;
  picture.pointer = m_hovered->part == PortHandle::Part::Whole ? PointerShape::Move : PointerShape::Take;
  return picture;
}

QString HandleTool::words() const { return QStringLiteral("Move taps and drains"); }

std::vector<Gesture> HandleTool::gestures() const {
  return {{QStringLiteral("Drag a tap or drain"),
           QStringLiteral("Move it; with Shift up and down; its knobs turn or stretch it"),
           {}}};
}

}  // namespace ps
