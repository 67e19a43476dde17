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

/// "" where there is none that may become of something else: matter of a tap is the tap's, and a locked body stays.
std::string Viewport::bodyForMaterial(const QPointF& position) const {
  const Pointer pointer = pointerAt(position, {});
  const auto hit = m_now && m_now->bodyIds ? pickParticle(*m_now, pointer.ray) : std::nullopt;
  if (!hit) return {};
  const uint32_t body = m_now->body[*hit];
  const Body* found = body < m_now->bodyIds->size() ? m_document.body((*m_now->bodyIds)[body]) : nullptr;
  return found && !found->locked ? found->id : std::string();
}

void Viewport::setDropTarget(const std::string& body) {
  if (body == m_dropTarget) return;
  m_dropTarget = body;
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
  setDropTarget(bodyForMaterial(event->position()));
  event->setAccepted(!m_dropTarget.empty());
}

void Viewport::dragLeaveEvent(QDragLeaveEvent* /*event*/) { setDropTarget({}); }

void Viewport::dropEvent(QDropEvent* event) {
  const std::string body = bodyForMaterial(event->position());
  setDropTarget({});
  event->setAccepted(giveMaterial(m_document, body, *event->mimeData()));
}

}  // namespace ps
