// SPDX-License-Identifier: Apache-2.0
// Probes in the inspector, in the place of bodies: what they measure, of which matter, where; likewise several walls,
// taps or drains.
#include "core/simulation/probeparameters.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/rowmodels.h"
#include "ui/session/session.h"

#include <algorithm>

namespace ps {

void Inspector::showThingsHeader() {
  if (showCount()) return;
  const Address& thing = shown().back();
  const Probe* probe = thing.owner == Owner::Probe ? m_document.probe(thing.id) : nullptr;
  const QString name = ownerLabel(m_document.project(), thing);
  const Quantity* quantity = probe ? m_session.fields().quantity(probe->quantity) : nullptr;
  const QString what = QString::fromStdString(quantity ? quantity->label : probe ? probe->quantity : std::string());
  m_body->setHeader(name, probe ? QStringLiteral("Probe · ") + what.left(1).toLower() + what.mid(1) : QString());
}

bool Inspector::rebuildThings() {
  if (m_things.empty() || &shown() != &m_things) return false;
  showThingsHeader();
  std::vector<RowModel> rows;
  const Address& any = m_things.back();
  const api::ParameterList list = declarationsOf(m_document.project(), m_document.plugins(), any);
  for (size_t i = 0; i < list.count; ++i) {
    if (auto row = rowModelOf(m_document, {any.owner, any.id, list[i].key})) rows.push_back(std::move(*row));
  }
  shareRows(rows, m_things);
  m_body->setModel(std::move(rows));
  m_notes.show();
  showTracks();
  return true;
}

void Inspector::onProbe(const std::string& id) {
  const Probe* probe = m_document.probe(id);
  const Address thing{Owner::Probe, id, ""};
  const bool last = !m_things.empty() && m_things.back() == thing;
  const bool among = std::find(m_things.begin(), m_things.end(), thing) != m_things.end();
  if (last && (!probe || m_body->rows().empty()))
    rebuildBody();
  else if (among && &shown() == &m_things)
    showThingsHeader();
  const std::string prefix = Address{Owner::Probe, id, ""}.prefix();
  const QString start = QString::fromStdString(prefix);
  const std::vector<std::string>& pins = m_document.project().view.pinned;
  const std::vector<ParameterRow*> rows = m_material->rows();
  const bool pinned =
      std::any_of(pins.begin(), pins.end(), [&](const std::string& pin) { return pin.starts_with(prefix); });
  const bool shown =
      std::any_of(rows.begin(), rows.end(), [&](const ParameterRow* row) { return row->key().startsWith(start); });
  if (shown != (probe && pinned)) rebuildMaterial();  // it came or went
  for (ParameterPanel* panel : panels()) {
    for (ParameterRow* row : panel->rows()) {
      const auto address = Address::parse(row->key().toStdString());
      if (!address || address->owner != Owner::Probe || address->id != id) continue;
      row->setValue(m_document.value(*address));
      row->setDisabledReason(idleText(m_document, *address));
    }
  }
  for (const ParameterRow* row : among ? m_body->rows() : std::vector<ParameterRow*>{})
    m_body->setMixed(row->key(), isMixed(*Address::parse(row->key().toStdString())));
  m_notes.show();
}

}  // namespace ps
