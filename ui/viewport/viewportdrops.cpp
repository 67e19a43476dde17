// SPDX-License-Identifier: Apache-2.0
// Materials that are dropped on bodies in the viewport. What else is dragged there is the window's.
#include "ui/document/document.h"
#include "ui/render/camera.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/session.h"
#include "ui/viewport/viewport.h"

#include <QtCore/QMimeData>
#include <QtGui/QDropEvent>

namespace ps {

/// Whose it is, Body::id or Emitter::id; "" where there is none.
std::string Viewport::matterAt(const QPointF& position) const {
  const Pointer pointer = pointerAt(position, {});
  const auto hit = m_now && m_now->bodyIds ? pickParticle(*m_now, pointer.ray, pointer.section) : std::nullopt;
  if (!hit) return {};
  const uint32_t body = m_now->body[*hit];
  return body < m_now->bodyIds->size() ? (*m_now->bodyIds)[body] : std::string();
}

void Viewport::aimDrop(const QPointF& position) {
  const std::string matter = matterAt(position);
  const QString why = whyNoMaterial(m_document, matter);
  const size_t takers = takersOf(m_document, m_selection, matter).size();
  const std::string target = why.isEmpty() ? matter : std::string();
  const QString note = takers > 1 ? QStringLiteral("All %1 bodies that are selected become of it.").arg(takers) : why;
  if (target == m_dropTarget && note == m_dropNote) return;
  m_dropTarget = target;
  m_dropNote = note;
  requestPaint();
}

void Viewport::endDrop() {
  m_dropTarget.clear();
  m_dropNote.clear();
  requestPaint();
}

void Viewport::dragEnterEvent(QDragEnterEvent* event) {
  if (carriesMaterial(*event->mimeData())) {
    event->acceptProposedAction();
  } else {
    event->ignore();
  }
}

void Viewport::dragMoveEvent(QDragMoveEvent* event) {
  aimDrop(event->position());
  event->setAccepted(!m_dropTarget.empty());
}

void Viewport::dragLeaveEvent(QDragLeaveEvent* /*event*/) { endDrop(); }

void Viewport::dropEvent(QDropEvent* event) {
  const std::vector<std::string> takers = takersOf(m_document, m_selection, matterAt(event->position()));
  endDrop();
  event->setAccepted(giveMaterial(m_document, takers, *event->mimeData()));
}

}  // namespace ps
