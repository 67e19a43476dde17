// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/measuretool.h"

#include "ui/document/document.h"
#include "ui/render/camera.h"
#include "ui/theme/numbers.h"
#include "ui/tools/surface.h"
#include "ui/tools/toolbox.h"

namespace ps {
namespace {

/// As far from `from` as the place is along the axis that leads nearest to it.
Vector3 alongAnAxis(const Vector3& from, const Vector3& to) {
  Eigen::Index axis = 0;
  (to - from).cwiseAbs().maxCoeff(&axis);
  Vector3 way(0, 0, 0);
  way[axis] = (to - from)[axis];
  return from + way;
}

}  // namespace

std::optional<MeasureTool::End> MeasureTool::endAt(const Pointer& pointer) const {
  const auto surface = surfaceUnder(pointer, box().document().project().environment);
  if (!surface) return std::nullopt;
  End end{surface->point, std::nullopt};
  const auto hit = pointer.scene ? pickParticle(*pointer.scene, pointer.ray, pointer.section) : std::nullopt;
  if (hit) end.temperature = static_cast<double>(pointer.scene->temperature[*hit]);
  return end;
}

bool MeasureTool::press(const Pointer& pointer) {
  m_from = endAt(pointer);
  m_begun = box().document().changeCount();
  m_to.reset();
  m_dragged = true;
  return true;
}

void MeasureTool::drag(const Pointer& pointer) {
  const std::optional<End> end = endAt(pointer);
  if (!m_from || !end) return;
  m_to = pointer.shift ? End{alongAnAxis(m_from->place, end->place), std::nullopt} : *end;
}

bool MeasureTool::cancel() {
  const bool some = m_to.has_value() || m_dragged;
  m_from.reset();
  m_to.reset();
  m_dragged = false;
  return some;
}

bool MeasureTool::measures() const { return m_from && m_to && box().document().had(m_begun); }

QString MeasureTool::text() const {
  if (!measures()) return {};
  const Vector3 way = m_to->place - m_from->place;
  QStringList parts{lengthText(way.norm())};
  QStringList along;
  const char* const axes[] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a) {
    if (std::abs(way[a]) > 1e-6) along << QString::fromLatin1(axes[a]) + u' ' + lengthText(std::abs(way[a]));
  }
  if (along.size() > 1) parts << along.join(QStringLiteral(" · "));
  if (m_from->temperature && m_to->temperature)
    parts << QStringLiteral("ΔT ") + formatQuantity(*m_to->temperature - *m_from->temperature, QStringLiteral("K"), 3);
  return parts.join(QStringLiteral("   "));
}

ToolPicture MeasureTool::picture() const {
  ToolPicture picture;
  picture.pointer = PointerShape::Cross;
  if (!measures()) return picture;
  picture.wires.push_back({{{m_from->place, m_to->place}}, true, false, false});
  // By way of the scene's axes, where it lies along none of them.
  Wire legs;
  legs.dashed = true;
  Vector3 at = m_from->place;
  for (const int axis : {0, 2, 1}) {
    Vector3 next = at;
    next[axis] = m_to->place[axis];
    if ((next - at).norm() > 1e-6) legs.lines.emplace_back(at, next);
    at = next;
  }
  if (legs.lines.size() > 1) picture.wires.push_back(std::move(legs));
  picture.tag = SceneTag{m_to->place, {}, text()};
  return picture;
}

QString MeasureTool::words() const {
  const QString told = text();
  return told.isEmpty() ? QStringLiteral("Ruler") : QStringLiteral("Ruler, ") + told;
}

std::vector<Gesture> MeasureTool::gestures() const {
  return {{QStringLiteral("Drag"), QStringLiteral("Measure from one place to another, and how much warmer it is there"),
           QStringLiteral("measure")},
          {QStringLiteral("Shift"), QStringLiteral("Along the axis that leads nearest to it"),
           QStringLiteral("along an axis")}};
}

}  // namespace ps
