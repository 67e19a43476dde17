// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/strokehandles.h"

#include "ui/document/document.h"
#include "ui/theme/numbers.h"
#include "ui/tools/aim.h"
#include "ui/tools/toolbox.h"

#include <algorithm>
#include <utility>

namespace ps {

bool StrokeHandles::isOn() const { return m_box.stroke().has_value(); }

std::optional<Gizmo> StrokeHandles::gizmo() const {
  const std::optional<Wire> wire = m_box.strokeWire();
  if (!wire || wire->lines.empty()) return std::nullopt;
  Vector3 low = wire->lines.front().first, high = low;
  for (const auto& [from, to] : wire->lines) {
    low = low.cwiseMin(from).cwiseMin(to);
    high = high.cwiseMax(from).cwiseMax(to);
  }
  return Gizmo{Gizmo::Kind::Move, (low + high) / 2};
}

void StrokeHandles::hover(const Pointer& pointer) {
  const auto shown = gizmo();
  m_hovered = shown ? partAt(*shown, pointer) : std::nullopt;
}

bool StrokeHandles::press(const Pointer& pointer) {
  hover(pointer);
  const auto shown = gizmo();
  if (!shown || !m_hovered) return false;
  m_grip.emplace(*shown, *m_hovered, pointer);
  m_dragged = {};
  m_pressed = pointer;
  m_pressed->scene = nullptr;  // its memory is not held meanwhile
  m_begun = m_box.document().changeCount();
  return true;
}

void StrokeHandles::drag(const Pointer& pointer) {
  if (!m_grip || (m_pressed && !wandered(*m_pressed, pointer))) return;
  m_pressed.reset();
  const Snapping& snap = m_box.handles().snap;
  const bool snaps = snap.on != (pointer.control || pointer.alt);
  m_dragged = m_grip->drag(pointer, snaps ? (snap.move > 0 ? snap.move : m_box.spacing()) : 0);
}

void StrokeHandles::release() {
  if (!std::exchange(m_grip, std::nullopt)) return;
  const std::optional<ChosenStroke> stroke = m_box.stroke();
  const bool isSame = m_box.document().changeCount() == m_begun;  // else another one may have its number
  if (stroke && isSame && m_dragged.way.norm() > 0) Q_EMIT m_box.strokeMoved(*stroke, m_dragged.way);
}

bool StrokeHandles::cancel() { return std::exchange(m_grip, std::nullopt).has_value(); }

void StrokeHandles::show(ToolPicture& picture) const {
  GizmoPicture shown;
  shown.gizmo = gizmo();
  shown.hovered = m_hovered;
  if (m_grip) {
    Gizmo held = m_grip->gizmo();
    held.centre += m_dragged.way;
    shown.gizmo = held;
    shown.active = m_grip->part();
    shown.value = formatPrefixed(m_dragged.way.norm(), QStringLiteral("m"));
    if (std::optional<Wire> there = m_box.strokeWire()) {
      for (auto& [from, to] : there->lines) from += m_dragged.way, to += m_dragged.way;
      there->dashed = true;
      picture.wires.push_back(std::move(*there));
    }
  }
  if (m_hovered || m_grip) picture.pointer = PointerShape::Take;
  picture.gizmo = std::move(shown);
}

}  // namespace ps
