// SPDX-License-Identifier: Apache-2.0
#include "ui/window/handleactions.h"

#include "ui/session/preferences.h"
#include "ui/tools/gizmotool.h"
#include "ui/tools/toolbox.h"
#include "ui/window/actions.h"

#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtGui/QCursor>
#include <QtWidgets/QMenu>

#include <iterator>

namespace ps {
namespace {

/// In the order of Pivot.
struct PivotRow {
  const char *id, *text, *tip;
};
constexpr PivotRow kPivots[] = {
    {"middle", "Pivot: common middle", "All that is selected goes about the middle of it."},
    {"each", "Pivot: each its own middle", "Each thing turns and is scaled by itself, where it is."},
    {"last", "Pivot: the one selected last", "All goes about what was selected last; the handles stand there."},
    {"origin", "Pivot: origin of the scene", "All turns about the place 0, 0, 0, and is scaled to and from it."},
};

}  // namespace

HandleActions::HandleActions(Toolbox& tools, const Actions& actions, QObject* parent)
    : QObject(parent), m_tools(tools), m_actions(actions), m_pivotGroup(new QActionGroup(this)) {
  connect(&tools, &Toolbox::handlesChanged, this, &HandleActions::show);
}

void HandleActions::addTo(QMenu* edit) {
  m_actions.add(edit, QStringLiteral("edit.pivot"), QStringLiteral("Pivot of the handles…"),
                {QKeySequence(QString::fromLatin1(kPivotKey))}, [this] { m_pivots->popup(QCursor::pos()); });
  m_pivots = edit->addMenu(QStringLiteral("Pivot"));
  m_pivots->setToolTipsVisible(true);
  for (size_t k = 0; k < std::size(kPivots); ++k) {
    const PivotRow& row = kPivots[k];
    QAction* action = m_actions.add(m_pivots, QStringLiteral("edit.pivot.") + QString::fromLatin1(row.id),
                                    QString::fromLatin1(row.text), {}, [this, k] {
                                      HandleSettings settings = m_tools.handles();
                                      settings.pivot = static_cast<Pivot>(k);
                                      choose(settings);
                                    });
    action->setToolTip(QString::fromLatin1(row.tip));
    action->setCheckable(true);
    m_pivotGroup->addAction(action);
  }
  show();
}

void HandleActions::choose(const HandleSettings& settings) {
  m_tools.setHandles(settings);
  preferences::setHandles(settings);
}

void HandleActions::show() {
  const QList<QAction*> pivots = m_pivotGroup->actions();
  if (!pivots.empty()) pivots[static_cast<qsizetype>(m_tools.handles().pivot)]->setChecked(true);
}

}  // namespace ps
