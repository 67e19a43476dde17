// SPDX-License-Identifier: Apache-2.0
#include "ui/session/selection.h"

#include "ui/document/document.h"
#include "ui/document/pinaddress.h"

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

template <class Wanted>
void transfer(std::vector<SelectedItem>& from, std::vector<SelectedItem>& to, const Wanted& wanted) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(to), wanted);
  std::erase_if(from, wanted);
}

}  // namespace

std::optional<Address> thingOf(const SelectedItem& item) {
  switch (item.kind) {
    case OutlineKind::Body:
      return Address{Owner::Body, item.id, ""};
    case OutlineKind::Emitter:
      return Address{Owner::Emitter, item.id, ""};
    case OutlineKind::Sink:
      return Address{Owner::Sink, item.id, ""};
    case OutlineKind::Wall:
      return Address{Owner::Wall, item.id, ""};
    case OutlineKind::Probe:
      return Address{Owner::Probe, item.id, ""};
    case OutlineKind::Pin:
      if (const auto pin = PinAddress::parse(item.id)) return Address{Owner::Body, pin->body, ""};
      return std::nullopt;
    default:
      return std::nullopt;
  }
}

Selection::Selection(Document& document, QObject* parent) : QObject(parent), m_document(document) {
  connect(&document, &Document::changed, this, &Selection::onChanged);
}

bool Selection::has(OutlineKind kind, const std::string& id) const {
  return std::find(m_items.begin(), m_items.end(), SelectedItem{kind, id}) != m_items.end();
}

std::vector<std::string> Selection::bodies() const {
  std::vector<std::string> ids;
  for (const SelectedItem& item : m_items) {
    if (item.kind == OutlineKind::Body) ids.push_back(item.id);
  }
  return ids;
}

std::string Selection::body() const { return kind() == OutlineKind::Body ? id() : std::string(); }

std::optional<Port> Selection::port() const {
  if (kind() != OutlineKind::Emitter && kind() != OutlineKind::Sink) return std::nullopt;
  return Port{kind() == OutlineKind::Sink, id()};
}

void Selection::select(OutlineKind kind, const std::string& id) { selectAll({{kind, id}}); }

void Selection::toggle(OutlineKind kind, const std::string& id) {
  std::vector<SelectedItem> items = m_items;
  if (std::erase(items, SelectedItem{kind, id}) == 0) items.push_back({kind, id});
  selectAll(std::move(items));
}

void Selection::selectAll(std::vector<SelectedItem> items) {
  if (items.empty()) {
    clear();
    return;
  }
  if (items != m_items) m_marked.reset();
  m_items = std::move(items);
  m_gone.clear();
  if (const Body* body = m_document.body(this->body())) setMaterial(body->material);
  Q_EMIT changed();
}

void Selection::restore(const std::vector<SelectedItem>& items, const std::string& material) {
  std::vector<SelectedItem> left;
  std::copy_if(items.begin(), items.end(), std::back_inserter(left),
               [this](const SelectedItem& item) { return isThere(item); });
  selectAll(std::move(left));
  if (hasMaterial(material)) setMaterial(material);
}

bool Selection::hasMaterial(const std::string& id) const {
  const std::vector<SceneMaterial>& materials = m_document.project().materials;
  return std::any_of(materials.begin(), materials.end(),
                     [&](const SceneMaterial& material) { return material.id == id; });
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
  if (m_items.empty()) return;
  m_items.clear();
  Q_EMIT changed();
}

void Selection::setMaterial(const std::string& id) {
  std::vector<std::string> alone;
  if (!id.empty()) alone.push_back(id);
  if (alone == m_materials) return;
  std::erase(m_formerMaterials, material());
  m_formerMaterials.push_back(material());
  m_materials = std::move(alone);
  Q_EMIT materialChanged();
}

void Selection::toggleMaterial(const std::string& id) {
  if (m_materials == std::vector<std::string>{id}) return;
  if (std::erase(m_materials, id) == 0) m_materials.push_back(id);
  Q_EMIT materialChanged();
  Q_EMIT materialPicked();
}

/// Of those that were chosen the latest that is there, or the first of all.
std::string Selection::latestMaterial() const {
  const auto latest = std::find_if(m_formerMaterials.rbegin(), m_formerMaterials.rend(),
                                   [this](const std::string& id) { return hasMaterial(id); });
  if (latest != m_formerMaterials.rend()) return *latest;
  const std::vector<SceneMaterial>& materials = m_document.project().materials;
  return materials.empty() ? std::string() : materials.front().id;
}

void Selection::pickMaterial(const std::string& id) {
  setMaterial(id);
  Q_EMIT materialPicked();
}

bool Selection::isThere(const SelectedItem& item) const {
  switch (item.kind) {
    case OutlineKind::Body:
      return m_document.body(item.id) != nullptr;
    case OutlineKind::Emitter:
      return m_document.emitter(item.id) != nullptr;
    case OutlineKind::Sink:
      return m_document.sink(item.id) != nullptr;
    case OutlineKind::Wall:
      return m_document.wall(item.id) != nullptr;
    case OutlineKind::Probe:
      return m_document.probe(item.id) != nullptr;
    case OutlineKind::Pin:
      return findPin(m_document.project(), item.id) != nullptr;
    default:
      return true;
  }
}

void Selection::onChanged(const ChangeEvent& event) {
  const bool opened = std::holds_alternative<ProjectOpened>(event);
  std::vector<SelectedItem> left = m_items, gone = m_gone;
  if (opened) left.clear(), gone.clear();
  transfer(left, gone, [this](const SelectedItem& item) { return !isThere(item); });
  transfer(gone, left, [this](const SelectedItem& item) { return isThere(item); });
  if (opened || left != m_items) selectAll(std::move(left));
  m_gone = std::move(gone);
  if (!opened && !std::holds_alternative<MaterialsChanged>(event)) return;
  std::vector<std::string> kept = m_materials;
  if (opened) kept.clear(), m_formerMaterials.clear();
  std::erase_if(kept, [this](const std::string& id) { return !hasMaterial(id); });
  const std::string latest = latestMaterial();
  if (kept.empty() && !latest.empty()) kept.push_back(latest);
  if (kept == m_materials) return;
  m_materials = std::move(kept);
  Q_EMIT materialChanged();
}

}  // namespace ps
