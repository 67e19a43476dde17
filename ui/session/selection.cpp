// SPDX-License-Identifier: Apache-2.0
#include "ui/session/selection.h"

#include "ui/document/document.h"

#include <algorithm>

namespace ps {

Selection::Selection(Document& document, QObject* parent) : QObject(parent), m_document(document) {
  connect(&document, &Document::changed, this, &Selection::onChanged);
}

std::string Selection::body() const { return m_any && m_kind == OutlineKind::Body ? m_id : std::string(); }

std::optional<Port> Selection::port() const {
  if (!m_any || (m_kind != OutlineKind::Emitter && m_kind != OutlineKind::Sink)) return std::nullopt;
  return Port{m_kind == OutlineKind::Sink, m_id};
}

void Selection::select(OutlineKind kind, const std::string& id) {
  if (!m_any || kind != m_kind || id != m_id) m_marked.reset();
  m_any = true;
  m_kind = kind;
  m_id = id;
  if (const Body* body = m_document.body(this->body())) setMaterial(body->material);
  Q_EMIT changed();
}

void Selection::selectBody(const std::string& id) {
  if (id.empty()) {
    clear();
  } else {
    select(OutlineKind::Body, id);
  }
}

void Selection::mark(uint64_t revision, uint32_t particle) {
  m_marked = {revision, particle};
  Q_EMIT changed();
}

void Selection::clear() {
  m_marked.reset();
  if (!m_any) return;
  m_any = false;
  m_kind = OutlineKind::Scene;
  m_id.clear();
  Q_EMIT changed();
}

void Selection::setMaterial(const std::string& id) {
  if (id == m_material) return;
  m_material = id;
  Q_EMIT materialChanged();
}

void Selection::pickMaterial(const std::string& id) {
  setMaterial(id);
  Q_EMIT materialPicked();
}

bool Selection::isThere() const {
  switch (m_kind) {
    case OutlineKind::Body:
      return m_document.body(m_id) != nullptr;
    case OutlineKind::Emitter:
      return m_document.emitter(m_id) != nullptr;
    case OutlineKind::Sink:
      return m_document.sink(m_id) != nullptr;
    case OutlineKind::Wall:
      return m_document.wall(m_id) != nullptr;
    case OutlineKind::Probe:
      return m_document.probe(m_id) != nullptr;
    default:
      return true;
  }
}

void Selection::onChanged(const ChangeEvent& event) {
  const bool opened = std::holds_alternative<ProjectOpened>(event);
  if (opened || !isThere()) clear();
  if (!opened && !std::holds_alternative<MaterialsChanged>(event)) return;
  const std::vector<SceneMaterial>& materials = m_document.project().materials;
  const bool known = std::any_of(materials.begin(), materials.end(),
                                 [&](const SceneMaterial& material) { return material.id == m_material; });
  if (opened || !known) setMaterial(materials.empty() ? std::string() : materials.front().id);
}

}  // namespace ps
