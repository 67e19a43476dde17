// SPDX-License-Identifier: Apache-2.0
#include "ui/window/handleactions.h"

#include "core/scene/declare.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/preferences.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/tools/gizmotool.h"
#include "ui/tools/toolbox.h"
#include "ui/window/actions.h"
#include "ui/window/dialogrow.h"
#include "ui/window/notices.h"

#include <QtGui/QAction>
#include <QtGui/QActionGroup>
#include <QtGui/QCursor>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QWidgetAction>

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

struct StepRow {
  api::ParameterDeclaration amount;
  double Snapping::*member;
};
constexpr api::ParameterDeclaration step(const char* label, const char* unit, double usual, double least, double most,
                                         const char* help) {
  return declare::number({"step", label, "", unit}, {usual, least, most, least, most}, {"", help, "", ""});
}
constexpr StepRow kSteps[] = {
    {declare::leastMeans("spacing", step("Moves by", "m", 0, 0, 1e3, "A length; “spacing” is that of the particles.")),
     &Snapping::move},
    {step("Turns by", "°", 15, 0.01, 180, "An angle."), &Snapping::turn},
    {step("Scales by", "", 0.1, 0.001, 10, "A share of the size."), &Snapping::scale},
};
QString textOf(const api::ParameterDeclaration& amount, double value) {
  const QString unit = QString::fromUtf8(amount.unit);
  if (standsForNone(amount, value)) return QString::fromUtf8(amount.leastWord);
  const UnitPrefix prefix = unit == QStringLiteral("m") ? prefixFor(value) : UnitPrefix{};
  return formatQuantity(value / prefix.factor, prefix.symbol + unit);
}
constexpr int kFieldWidth = 90, kMargin = 12;  // px

}  // namespace

HandleActions::HandleActions(Toolbox& tools, const Actions& actions, Notices& notices, QObject* parent)
    : QObject(parent), m_tools(tools), m_actions(actions), m_notices(notices), m_pivotGroup(new QActionGroup(this)) {
  connect(&tools, &Toolbox::handlesChanged, this, &HandleActions::show);
}

void HandleActions::addTo(QMenu* edit) {
  addPivots(edit);
  addSnapping(edit);
  show();
}

void HandleActions::addPivots(QMenu* edit) {
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
}

void HandleActions::addSnapping(QMenu* edit) {
  m_snapping = edit->addMenu(QStringLiteral("Snapping"));
  m_snapping->setToolTipsVisible(true);
  const auto toggle = [this](const char* id, const char* text, const QList<QKeySequence>& keys,
                             bool Snapping::*member) {
    QAction* action =
        m_actions.add(m_snapping, QString::fromLatin1(id), QString::fromLatin1(text), keys, [this, member] {
          HandleSettings settings = m_tools.handles();
          settings.snap.*member = !(settings.snap.*member);
          choose(settings);
        });
    action->setCheckable(true);
    return action;
  };
  m_snap =
      toggle("edit.snap", "Snap the handles to steps", {QKeySequence(QString::fromLatin1(kSnapKey))}, &Snapping::on);
  m_snap->setToolTip(QStringLiteral("The handles go by steps; with Ctrl or Alt held, freely (%1)")
                         .arg(m_snap->shortcut().toString(QKeySequence::NativeText)));
  m_snap->setProperty(kWords, QStringLiteral("steps grid moves turns scales by angle"));
  m_snap->setIcon(icon(QStringLiteral("snap")));
  m_snap->setIconVisibleInMenu(false);
  m_surfaces = toggle("edit.snap.surfaces", "Snap to surfaces", {}, &Snapping::surfaces);
  m_surfaces->setToolTip(
      QStringLiteral("What is moved by steps comes to stand on the body that is below it, or the floor."));
  m_snapping->addSeparator();
  addSteps();
}

void HandleActions::addSteps() {
  auto* form = new QWidget;
  auto* grid = new QGridLayout(form);
  grid->setContentsMargins(kMargin, kMargin / 2, kMargin, kMargin / 2);
  for (size_t k = 0; k < std::size(kSteps); ++k) {
    auto* field = new QLineEdit;
    field->setFixedWidth(kFieldWidth);
    addDialogRow(*grid, QString::fromUtf8(kSteps[k].amount.label), field, QString::fromUtf8(kSteps[k].amount.help));
    connect(field, &QLineEdit::editingFinished, this, [this, k] { take(k); });
    m_steps.push_back(field);
  }
  auto* steps = new QWidgetAction(m_snapping);
  steps->setDefaultWidget(form);
  m_snapping->addAction(steps);
}

/// A step that is none, or out of range, is told of, and the one before stays in force.
void HandleActions::take(size_t step) {
  QLineEdit& field = *m_steps[step];
  if (!field.isModified()) return;
  field.setModified(false);
  const api::ParameterDeclaration& amount = kSteps[step].amount;
  HandleSettings settings = m_tools.handles();
  double& value = settings.snap.*kSteps[step].member;
  const Typed typed = parseTyped(field.text(), amount, value);
  const QString problem = typed.problem.isEmpty() ? refusal(amount, typed.value) : typed.problem;
  if (problem.isEmpty()) value = typed.value;
  m_notices.refuse(QStringLiteral("The step stays as it is."), problem);
  choose(settings);
  show();
}

void HandleActions::choose(const HandleSettings& settings) {
  m_tools.setHandles(settings);
  preferences::setHandles(settings);
}

void HandleActions::show() {
  const HandleSettings& settings = m_tools.handles();
  if (!m_surfaces) return;
  m_pivotGroup->actions()[static_cast<qsizetype>(settings.pivot)]->setChecked(true);
  m_snap->setChecked(settings.snap.on);
  m_surfaces->setChecked(settings.snap.surfaces);
  for (size_t k = 0; k < m_steps.size(); ++k)
    m_steps[k]->setText(textOf(kSteps[k].amount, settings.snap.*kSteps[k].member));
}

}  // namespace ps
