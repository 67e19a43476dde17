// SPDX-License-Identifier: Apache-2.0
#include "ui/window/editactions.h"

#include "core/scene/scenewall.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/wallside.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/rowcommands.h"
#include "ui/session/selection.h"
#include "ui/window/actions.h"
#include "ui/window/entrytext.h"
#include "ui/window/notices.h"

#include <QtGui/QAction>
#include <QtWidgets/QMainWindow>
#include <QtWidgets/QMenu>

namespace ps {

void EditActions::makeMenu(QMenu* menu) {
  menu->addAction(m_actions.find(QStringLiteral("edit.undo")));
  menu->addAction(m_actions.find(QStringLiteral("edit.redo")));
  menu->addSeparator();
  m_actions.add(menu, QStringLiteral("edit.rename"), QStringLiteral("Rename"), {QKeySequence(QStringLiteral("F2"))},
                [this] { m_outliner.renameSelected(); });
  m_actions.add(menu, QStringLiteral("edit.visible"), QStringLiteral("Show or hide"), {},
                [this] { m_outliner.toggleVisible(); });
  m_actions.add(menu, QStringLiteral("edit.locked"), QStringLiteral("Lock or unlock"), {},
                [this] { m_outliner.toggleLocked(); });
  m_actions.add(menu, QStringLiteral("edit.probe"), QStringLiteral("Add probe"), {}, [this] { addProbe(); });
  m_actions.add(menu, QStringLiteral("edit.key"), QStringLiteral("Set or remove a key"), {QKeySequence(Qt::Key_K)},
                [this] {
                  if (ParameterRow* row = orRefused(m_inspector.rowAtHand(), QStringLiteral("No key was set.")))
                    row->toggleKey();
                });
  addRowCommands();
  menu->addSeparator();
  menu->addAction(m_actions.find(QStringLiteral("edit.search")));
}

ParameterRow* EditActions::orRefused(ParameterRow* row, const QString& refusal) {
  m_notices.refuse(refusal, row ? QString() : QStringLiteral("Point at the row of a parameter."));
  return row;
}

/// What the menu of a row has, for Ctrl+K: no menu of the window has rows. Those of the brush have one, too.
void EditActions::addRowCommands() {
  const auto lower = [](const char* text) {
    const QString whole = QString::fromUtf8(text);
    return whole.left(1).toLower() + whole.mid(1);
  };
  for (const NamedRowCommand& each : rowCommands()) {
    QString title = QStringLiteral("Row: ");
    if (*each.menu) title += lower(each.menu) + QStringLiteral(": ");
    m_actions.add(nullptr, QStringLiteral("edit.row.") + QLatin1String(each.name), title + lower(each.text), {},
                  [this, command = each.command] { performAtHand(command); });
  }
}

void EditActions::performAtHand(RowCommand command) {
  const QString refusal = QStringLiteral("Nothing was done.");
  ParameterRow* row = orRefused(rowAtHand(m_actions.window().findChildren<ParameterPanel*>()), refusal);
  if (!row) return;
  const QString why = whyNot(*row, command);
  m_notices.refuse(refusal, why);
  if (why.isEmpty()) perform(*row, command, row->mapToGlobal(row->labelRect().bottomLeft()));
}

void EditActions::makeWallMenu(QMenu* menu) {
  const auto add = [&](const QString& id, const char* whole, const QString& name, const Actions::Act& act) {
    sayInMenu(*m_actions.add(menu, id, QString::fromLatin1(whole).arg(name.toLower()), {}, act), name);
  };
  for (const WallSide& side : kWallSides)
    add(QStringLiteral("sketch.wall.") + QString::fromLatin1(side.id), "Add wall: %1", QString::fromLatin1(side.name),
        [this, side] { addWalls({side.id}); });
  menu->addSeparator();
  for (const WallForm form : {WallForm::Cylinder, WallForm::Sphere}) {
    const QString shape = QString::fromStdString(shapeOf(form));
    add(QStringLiteral("sketch.wall.") + shape, "Add wall: %1", shape, [this, form] { addRoundWall(form); });
  }
  menu->addSeparator();
  add(QStringLiteral("sketch.walls"), "Add walls: %1", QStringLiteral("All four sides"),
      [this] { addWalls(kUprightSides); });
}

void EditActions::openItemMenu(const QPoint& global) const {
  auto* menu = new QMenu(&m_actions.window());
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const auto add = [&](const char* name) { menu->addAction(m_actions.find(QString::fromLatin1(name))); };
  const bool body = !m_selection.body().empty(), placed = body || m_selection.port();
  const OutlineKind kind = m_selection.kind();
  if (placed || kind == OutlineKind::Probe || kind == OutlineKind::Wall || kind == OutlineKind::Pin) {
    if (kind != OutlineKind::Pin) {
      add("edit.rename");
      add("edit.visible");
      add("edit.locked");
    }
    if (body) {
      add("edit.isolate");
      add("edit.pin");
    }
    if (placed) add("view.frame");
    menu->addSeparator();
    for (const char* name : {"edit.cut", "edit.copy", "edit.paste", "edit.duplicate", "edit.delete"}) add(name);
    menu->addSeparator();
    if (kind != OutlineKind::Probe && kind != OutlineKind::Pin) {
      add("edit.group");
      add("edit.ungroup");
      menu->addSeparator();
    }
  }
  add("edit.probe");
  menu->popup(global);
}

/// Of the body or tap that is selected, or of all matter; what it measures is chosen in its rows.
void EditActions::addProbe() {
  Probe probe;
  probe.quantity = "temperature";
  const auto port = m_selection.port();
  probe.body = port && !port->sink ? port->id : m_selection.body();
  if (!probe.body.empty()) {
    const Owner owner = port ? Owner::Emitter : Owner::Body;
    probe.name = ownerLabel(m_document.project(), {owner, probe.body, ""}).toStdString();
  }
  m_selection.select(OutlineKind::Probe, m_document.addProbe(std::move(probe)));
}

void EditActions::addRoundWall(WallForm form) {
  Project things;
  things.environment.walls = {roundWall(form, m_document.project())};
  const QString title = QStringLiteral("adding %1").arg(nameOf(things.environment.walls[0]));
  m_selection.select(OutlineKind::Wall, m_document.insertThings(std::move(things), title).walls.front().id);
}

void EditActions::addWalls(const std::vector<std::string>& sides) {
  const QString problem = m_document.addWalls(sides);
  m_notices.refuse(QStringLiteral("No wall was added."), problem);
  if (problem.isEmpty()) m_selection.select(OutlineKind::Wall, m_document.project().environment.walls.back().id);
}

}  // namespace ps
