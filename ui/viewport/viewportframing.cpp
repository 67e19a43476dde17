// SPDX-License-Identifier: Apache-2.0
// What the viewport is brought before: all, or what is selected.
#include "core/scene/turnedbox.h"
#include "ui/document/document.h"
#include "ui/document/pinaddress.h"
#include "ui/render/framing.h"
#include "ui/session/selection.h"
#include "ui/viewport/viewport.h"

namespace ps {
namespace {

Box aroundBox(const Sink& sink) {
  const BodyBounds around = TurnedBox(sink).bounds();
  return {around.minimum, around.maximum};
}

}  // namespace

/// Around all bodies, taps, drains, pins and regions of probes that are selected.
std::optional<Box> Viewport::boxOfSelection() const {
  std::optional<Box> all;
  const auto add = [&](const std::optional<Box>& box) {
    if (!box) return;
    if (!all) all = box;
    all->first = all->first.cwiseMin(box->first);
    all->second = all->second.cwiseMax(box->second);
  };
  const std::vector<std::optional<Box>> bodies = m_now ? boxesOfBodies(*m_now) : std::vector<std::optional<Box>>{};
  for (size_t k = 0; k < bodies.size(); ++k) {
    if (m_selection.has(OutlineKind::Body, (*m_now->bodyIds)[k])) add(bodies[k]);
  }
  for (const SelectedItem& item : m_selection.items()) {
    if (item.kind == OutlineKind::Emitter || item.kind == OutlineKind::Sink)
      add(boxAround({item.kind == OutlineKind::Sink, item.id}));
    const Region* pin = item.kind == OutlineKind::Pin ? findPin(m_document.project(), item.id) : nullptr;
    if (pin) add(Box(pin->minimum, pin->maximum));
    const Probe* probe = item.kind == OutlineKind::Probe ? m_document.probe(item.id) : nullptr;
    if (probe && probe->region) add(Box(probe->region->minimum, probe->region->maximum));
  }
  return all;
}

void Viewport::frameSelection() {
  const auto box = boxOfSelection();
  if (!box) {
    if (m_selection.body().empty() && !m_selection.port()) frameAll();
    return;
  }
  m_navigator.setSize(size());
  m_navigator.frame(*box);
  storeView();
  update();
}

void Viewport::frameAll() {
  m_navigator.setSize(size());
  m_navigator.frame(boxOfAll());
  storeView();
  update();
}

std::optional<std::pair<Vector3, Vector3>> Viewport::boxAround(const Port& port) const {
  if (const Sink* sink = port.sink ? m_document.sink(port.id) : nullptr) return aroundBox(*sink);
  const Emitter* emitter = port.sink ? nullptr : m_document.emitter(port.id);
  if (!emitter) return std::nullopt;
  const double reach = 3 * numberOf(emitter->parameters, emitterParameters(), "diameter");
  const Vector3 around = Vector3::Constant(reach);
  return std::pair<Vector3, Vector3>(emitter->point - around, emitter->point + around);
}

}  // namespace ps
