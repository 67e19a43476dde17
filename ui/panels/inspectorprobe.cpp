// SPDX-License-Identifier: Apache-2.0
// A probe in the inspector: what it measures, of which matter, where.
#include "core/simulation/probeparameters.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/rowmodels.h"
#include "ui/session/session.h"

#include <algorithm>

namespace ps {

void Inspector::setProbe(const std::string& id) {
  m_probeId = id;
  rebuildBody();
}

void Inspector::showProbeHeader(const Probe& probe) {
  const Quantity* quantity = m_session.fields().quantity(probe.quantity);
  const QString what = QString::fromStdString(quantity ? quantity->label : probe.quantity);
  m_body->setHeader(nameOf(probe), QStringLiteral("Probe · ") + what.left(1).toLower() + what.mid(1));
}

bool Inspector::rebuildProbe() {
  const Probe* probe = m_document.probe(m_probeId);
  if (!probe) return false;
  showProbeHeader(*probe);
  std::vector<RowModel> rows;
  const Address any{Owner::Probe, probe->id, ""};
  const api::ParameterList list = declarationsOf(m_document.project(), m_document.plugins(), any);
  for (size_t i = 0; i < list.count; ++i) {
    if (auto row = rowModelOf(m_document, {Owner::Probe, probe->id, list[i].key})) rows.push_back(std::move(*row));
  }
  m_body->setModel(std::move(rows));
  m_notes.show();
  return true;
}

void Inspector::onProbe(const std::string& id) {
  const Probe* probe = m_document.probe(id);
  if (id == m_probeId) {
    if (!probe || m_body->rows().empty())
      rebuildBody();
    else
      showProbeHeader(*probe);
  }
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
  m_notes.show();
}

}  // namespace ps
