// SPDX-License-Identifier: Apache-2.0
#include "ui/window/handlenote.h"

#include "ui/document/document.h"
#include "ui/session/selection.h"
#include "ui/tools/toolbox.h"
#include "ui/window/statusline.h"

#include <optional>
#include <utility>

namespace ps {

HandleNote::HandleNote(Toolbox& tools, StatusLine& status) : QObject(&status), m_tools(tools), m_status(status) {
  connect(&tools, &Toolbox::toolChanged, this, &HandleNote::follow);
  connect(&tools, &Toolbox::strokeChosen, this, &HandleNote::follow);
  connect(&tools.selection(), &Selection::changed, this, &HandleNote::follow);
  connect(&tools.document(), &Document::changed, this, &HandleNote::follow);
}

void HandleNote::follow() {
  const Tool& tool = m_tools.tool();
  const std::optional<GizmoPicture> gizmo = tool.usesHandles() ? tool.picture().gizmo : std::nullopt;
  const QString now = gizmo && !gizmo->gizmo && !gizmo->note.isEmpty() ? gizmo->note + QLatin1Char('.') : QString();
  if (now == m_told) return;
  const QString before = std::exchange(m_told, now);
  if (!now.isEmpty() || m_status.state().note == before) m_status.say(now);
}

}  // namespace ps
