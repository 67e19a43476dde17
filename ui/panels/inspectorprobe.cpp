// SPDX-License-Identifier: Apache-2.0
// A probe in the inspector: what it measures, of which matter, where.
#include "core/simulation/probeparameters.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/rowmodels.h"
#include "ui/session/session.h"

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
  return true;
}

void Inspector::onProbe(const std::string& id) {
  if (id != m_probeId) return;
  const Probe* probe = m_document.probe(id);
  if (!probe || m_body->rows().empty()) {
    rebuildBody();
    return;
  }
  showProbeHeader(*probe);
  for (ParameterRow* row : m_body->rows()) {
    const auto address = Address::parse(row->key().toStdString());
    if (!address) continue;
    m_body->setValue(row->key(), m_document.value(*address));
    row->setDisabledReason(idleText(m_document, *address));
  }
}

}  // namespace ps
