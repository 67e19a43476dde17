// SPDX-License-Identifier: Apache-2.0
#include "ui/window/windowlook.h"

#include "ui/document/document.h"
#include "ui/graphs/graphspanel.h"
#include "ui/session/resuming.h"
#include "ui/session/session.h"
#include "ui/tools/favouritebrush.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/viewport/viewport.h"

#include <QtCore/QPointer>
#include <QtCore/QSettings>

namespace ps {
namespace {
constexpr const char* kTool = "window/tool";
}  // namespace

void keepLook(Resuming& resuming, Session& session, GraphsPanel& graphs, Toolbox& tools, Viewport* view) {
  const auto add = [panel = QPointer(&graphs), seen = QPointer(view), &tools](LastLook& look) {
    if (panel) look.graphs = panel->looks();
    if (seen) look.legend = seen->ownLegendRange();
    look.brush = textOf(tools.brush());
  };
  const auto show = [panel = QPointer(&graphs), seen = QPointer(view), &tools, &session](const LastLook& look) {
    if (panel) panel->setLooks(look.graphs);
    if (seen && look.legend) seen->setLegendRange(*look.legend);
    if (!session.plugins()) return;
    tools.setBrush(brushOf(look.brush, tools.brush(), *session.plugins(), session.document().project()));
  };
  resuming.setLook(add, show);
}

void keepTool(const Toolbox& tools) {
  QSettings().setValue(QLatin1String(kTool), QString::fromStdString(tools.active()));
}

/// What draws belongs to Sketch, and all else elsewhere.
void takeToolAgain(Toolbox& tools) {
  const std::string left = QSettings().value(QLatin1String(kTool)).toString().toStdString();
  if (toolRow(left) && tools.tool(left).usesBrush() == tools.tool().usesBrush()) tools.activate(left);
}

}  // namespace ps
