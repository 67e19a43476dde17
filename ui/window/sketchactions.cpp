// SPDX-License-Identifier: Apache-2.0
#include "ui/window/sketchactions.h"

#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/session/session.h"
#include "ui/tools/toolbox.h"
#include "ui/tools/tooltable.h"
#include "ui/window/actions.h"

#include <QtGui/QAction>
#include <QtWidgets/QMenu>

#include <algorithm>

namespace ps {

void SketchActions::makeMenu(QMenu* menu) {
  for (const ToolRow& row : toolTable()) {
    m_actions.add(menu, QStringLiteral("sketch.") + QString::fromLatin1(row.id), QString::fromLatin1(row.name),
                  {QKeySequence(QString::fromLatin1(row.key))}, [this, id = row.id] { m_tools.activate(id); });
  }
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("sketch.smaller"), QStringLiteral("Smaller brush"),
                {QKeySequence(QStringLiteral("["))}, [this] { m_tools.stepBrush(-1); });
  m_actions.add(menu, QStringLiteral("sketch.larger"), QStringLiteral("Larger brush"),
                {QKeySequence(QStringLiteral("]"))}, [this] { m_tools.stepBrush(1); });
  m_actions.add(menu, QStringLiteral("sketch.shape"), QStringLiteral("Next brush shape"),
                {QKeySequence(QStringLiteral("N"))}, [this] { m_tools.nextShape(); });
  m_actions.add(menu, QStringLiteral("sketch.mirror"), QStringLiteral("Mirror"), {QKeySequence(QStringLiteral("M"))},
                [this] {
                  BrushSettings brush = m_tools.brush();
                  brush.symmetry.mirror = brush.symmetry.mirror == "none" ? "x" : "none";
                  m_tools.setBrush(brush);
                });
  m_shapes = menu->addMenu(QStringLiteral("Brush shape"));
  m_shapes->setEnabled(false);
}

/// The key that a brush asks for, where nothing else has it.
QList<QKeySequence> SketchActions::keysOf(const std::string& brush) const {
  const PluginInfo* info = m_session.plugins()->info(brush);
  if (!info || info->key.empty()) return {};
  const QKeySequence key(QString::fromStdString(info->key));
  const QList<QAction*> all = m_actions.all();
  const bool taken =
      std::any_of(all.begin(), all.end(), [&](const QAction* action) { return action->shortcuts().contains(key); });
  return taken ? QList<QKeySequence>{} : QList<QKeySequence>{key};
}

void SketchActions::addBrushes() {
  const PluginRegistry* plugins = m_session.plugins();
  for (const std::string& id : plugins->ids(PluginKind::Brush)) {
    m_actions.add(m_shapes, QStringLiteral("sketch.shape.") + QString::fromStdString(id),
                  QStringLiteral("Brush shape: %1").arg(pluginLabel(plugins, id)), keysOf(id), [this, id] {
                    if (!m_tools.tool().usesBrush()) m_tools.activate(kBrushTool);
                    m_tools.takeBrush(id);
                  });
  }
  m_shapes->setEnabled(!m_shapes->isEmpty());
}

}  // namespace ps
