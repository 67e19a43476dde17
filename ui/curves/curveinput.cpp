// SPDX-License-Identifier: Apache-2.0
#include "core/math/responseedit.h"
#include "ui/curves/curveview.h"
#include "ui/theme/reach.h"

#include <QtCore/QMimeData>
#include <QtGui/QDropEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QWheelEvent>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kGrip = 9;                          // px around a point
constexpr double kFine = 0.1;                        // of the pointer's way
constexpr double kNudge = 4;                         // px of an arrow
constexpr double kLeastSpan = 0.1, kMostSpan = 2e4;  // K

}  // namespace

/// Held within what the property's declaration takes.
double CurveView::bounded(double value) const {
  const api::ParameterDeclaration& d = m_target.declaration();
  const double held = std::clamp(value, d.hardMinimum, d.hardMaximum);
  const bool whole = d.kind == api::ParameterKind::Toggle || d.kind == api::ParameterKind::Integer;
  return whole ? std::round(held) : held;
}

int CurveView::pointAt(const QMouseEvent& event) const {
  if (m_shown.kind != Response::Kind::Curve) return -1;
  int best = -1;
  const double reach = reachOf(event, kGrip);
  double nearest = reach * reach;
  for (size_t i = 0; i < m_shown.points.size(); ++i) {
    const QPointF way = at(m_shown.points[i].x, m_shown.points[i].y) - event.position();
    if (const double square = QPointF::dotProduct(way, way); square <= nearest) {
      nearest = square;
      best = static_cast<int>(i);
    }
  }
  return best;
}

void CurveView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return QWidget::mousePressEvent(event);
  const Grip grip = gripAt(*event);
  if (grip == Grip::None || grip == Grip::Point) m_target.choosePoint(pointAt(*event));
  if (grip == Grip::None) return;
  const QString what = grip == Grip::Point ? QStringLiteral("Move point of %1") : QStringLiteral("Slope of %1");
  m_target.begin(what.arg(m_target.title()));
  m_grip = grip;
  m_before = m_shown;
  m_from = event->position();
  m_start = handleAt(grip == Grip::After).value_or(m_from);
  m_way = {};
}

void CurveView::mouseMoveEvent(QMouseEvent* event) {
  if (m_grip != Grip::None) return dragTo(event->position(), event->modifiers());
  setCursor(gripAt(*event) != Grip::None ? Qt::OpenHandCursor : Qt::CrossCursor);
}

/// The point goes as far as the pointer has since the last event, so that Shift may come and go on the way.
void CurveView::dragTo(const QPointF& position, Qt::KeyboardModifiers modifiers) {
  const double share = modifiers & Qt::ShiftModifier ? kFine : 1;
  m_way += (position - m_from) * share;
  m_from = position;
  const auto index = static_cast<size_t>(std::max(0, m_target.point()));
  if (index >= m_before.points.size()) return;
  if (m_grip != Grip::Point) return turnTo(m_start + m_way, modifiers & Qt::ControlModifier);
  const CurvePoint start = m_before.points[index];
  const QPointF to = at(start.x, start.y) + m_way;
  const double x = std::max(m_target.leastX(), kelvinAt(to.x()));
  const double kelvin = modifiers & Qt::ControlModifier ? start.x
                        : modifiers & Qt::ShiftModifier ? x
                                                        : m_target.snapped(x);
  const double value = bounded(valueAt(to.y()));
  Response next = m_before;
  if (modifiers & Qt::AltModifier) {
    const bool scales = logarithmic() && start.y > 0;
    const double coldest = m_target.leastX() - m_before.points.front().x;
    next = shifted(m_before, std::max(kelvin - start.x, coldest), scales ? 0 : value - start.y,
                   scales ? value / start.y : 1);
    for (CurvePoint& p : next.points) p.y = bounded(p.y);
  } else {
    movePoint(next, index, {kelvin, value});
  }
  m_target.set(next);
}

void CurveView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) dropDrag(true);
}

void CurveView::dropDrag(bool keep) {
  if (m_grip == Grip::None) return;
  m_grip = Grip::None;
  if (!keep) m_target.set(m_before);
  m_target.end();
}

void CurveView::dragEnterEvent(QDragEnterEvent* event) {
  if (draggedMaterial(*event->mimeData()) && !m_target.track()) event->acceptProposedAction();
}

void CurveView::dropEvent(QDropEvent* event) {
  const auto other = draggedMaterial(*event->mimeData());
  if (!other || other->id.empty()) return;  // of a body that is of none
  event->acceptProposedAction();
  m_target.compare(*other, true);
}

/// No release comes to what is hidden: the document's gesture would stay open.
void CurveView::hideEvent(QHideEvent*) { dropDrag(true); }

void CurveView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !plot().contains(event->position())) return;
  if (pointAt(*event) >= 0) return;
  const double kelvin = m_target.snapped(kelvinAt(event->position().x()));
  const double value = m_shown.at(kelvin);
  // On the curve means on it: where the pointer is far from it a point would bend the curve unasked.
  if (std::abs(at(kelvin, value).y() - event->position().y()) <= 2 * reachOf(*event, kGrip)) addAt(kelvin, value);
}

/// What is no curve yet becomes one, through its values at both ends of the axis.
void CurveView::addAt(double kelvin, double value) {
  Response next = m_shown;
  if (next.kind != Response::Kind::Curve) next = asPoints(m_shown, m_first, m_last, logarithmic());
  if (!addPoint(next, {kelvin, bounded(value)})) return;
  if (!m_target.set(next, QStringLiteral("Add point to %1").arg(m_target.title()))) return;
  const auto place = std::find_if(next.points.begin(), next.points.end(), [&](const auto& p) { return p.x == kelvin; });
  m_target.choosePoint(static_cast<int>(place - next.points.begin()));
}

void CurveView::removeChosen() {
  const int index = m_target.point();
  if (index < 0 || m_grip != Grip::None || m_shown.points.size() < 2) return;
  Response next = m_shown;
  removePoint(next, static_cast<size_t>(index));
  m_target.set(next, QStringLiteral("Remove point of %1").arg(m_target.title()));
}

void CurveView::nudge(double x, double y, bool fine) {
  const int index = m_target.point();
  if (index < 0 || m_grip != Grip::None) return;
  const CurvePoint p = m_shown.points[static_cast<size_t>(index)];
  const QPointF to = at(p.x, p.y) + QPointF(x, y) * kNudge * (fine ? kFine : 1);
  Response next = m_shown;
  movePoint(next, static_cast<size_t>(index),
            {x == 0 ? p.x : std::max(m_target.leastX(), kelvinAt(to.x())), y == 0 ? p.y : bounded(valueAt(to.y()))});
  m_target.set(next, QStringLiteral("Move point of %1").arg(m_target.title()));
}

/// Not while another point is held.
void CurveView::walk(int index) {
  if (m_grip == Grip::None) m_target.choosePoint(index);
}

void CurveView::wheelEvent(QWheelEvent* event) {
  const double factor = std::pow(0.85, event->angleDelta().y() / 120.0);
  const QPointF from = event->position();
  if (event->modifiers() & Qt::ShiftModifier || from.x() < plot().left()) {
    const double fixed = level(valueAt(from.y()));
    m_low = fixed + (m_low - fixed) * factor;
    m_high = fixed + (m_high - fixed) * factor;
  } else {
    const double fixed = kelvinAt(from.x()), span = (m_last - m_first) * factor;
    if (span < kLeastSpan || span > kMostSpan) return;
    m_first = std::max(m_target.leastX(), fixed + (m_first - fixed) * factor);
    m_last = fixed + (m_last - fixed) * factor;
  }
  event->accept();
  showParticles();
}

void CurveView::keyPressEvent(QKeyEvent* event) {
  const bool fine = event->modifiers() & Qt::ShiftModifier;
  const int last = m_shown.kind == Response::Kind::Curve ? static_cast<int>(m_shown.points.size()) - 1 : -1;
  switch (event->key()) {
    case Qt::Key_F:
      return fit();
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      return removeChosen();
    case Qt::Key_Escape:
      return m_grip != Grip::None ? dropDrag(false) : m_target.choosePoint(-1);
    case Qt::Key_Left:
      return nudge(-1, 0, fine);
    case Qt::Key_Right:
      return nudge(1, 0, fine);
    case Qt::Key_Up:
      return nudge(0, -1, fine);
    case Qt::Key_Down:
      return nudge(0, 1, fine);
    case Qt::Key_PageDown:
      return walk(std::min(m_target.point() + 1, last));
    case Qt::Key_PageUp:
      return walk(std::max(m_target.point() - 1, std::min(0, last)));
    default:
      QWidget::keyPressEvent(event);
  }
}

/// The window's shortcuts leave these keys to a view that has the focus.
bool CurveView::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto* key = static_cast<QKeyEvent*>(event);
    static constexpr int kOwn[] = {Qt::Key_F,  Qt::Key_Delete, Qt::Key_Backspace, Qt::Key_Escape, Qt::Key_Left,
                                   Qt::Key_Up, Qt::Key_Down,   Qt::Key_Right,     Qt::Key_PageUp, Qt::Key_PageDown};
    const bool plain = !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier));
    if (plain && std::find(std::begin(kOwn), std::end(kOwn), key->key()) != std::end(kOwn)) {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

}  // namespace ps
