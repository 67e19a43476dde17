// SPDX-License-Identifier: Apache-2.0
#include "ui/window/coarsenote.h"

#include "ui/document/document.h"
#include "ui/document/strokerecord.h"
#include "ui/panels/brushpanel.h"
#include "ui/tools/coarsebrush.h"
#include "ui/tools/toolbox.h"
#include "ui/window/statusline.h"

namespace ps {

CoarseNote::CoarseNote(Toolbox& tools, StatusLine& status, QObject* parent)
    : QObject(parent), m_tools(tools), m_status(status) {
  connect(&tools.document(), &Document::changed, this, &CoarseNote::onChanged);
}

QString CoarseNote::leadsTo(const QString& address) const {
  const bool isThis = !m_told.isEmpty() && m_status.state().note == m_told;
  return isThis ? QString::fromLatin1(BrushPanel::kSpacing) : address;
}

void CoarseNote::onChanged(const ChangeEvent& event) {
  const auto* parameter = std::get_if<ParameterChanged>(&event);
  const bool spaced = parameter && parameter->address.text() == BrushPanel::kSpacing;
  if (spaced || std::holds_alternative<ProjectOpened>(event)) m_told.clear();
  const auto* stroke = std::get_if<StrokeChanged>(&event);
  const PluginRegistry* plugins = m_tools.document().plugins();
  if (!stroke || !stroke->done || !stroke->live || stroke->stroke->body.empty() || !m_told.isEmpty() || !plugins)
    return;
  const std::vector<Coarseness> coarse = coarsenessOf(m_tools.brush(), *plugins, m_tools.spacing());
  if (coarse.empty()) return;
  m_told = coarse.front().text + QStringLiteral(" Click here for the spacing.");
  m_status.say(m_told);
}

}  // namespace ps
