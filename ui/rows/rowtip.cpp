// SPDX-License-Identifier: Apache-2.0
#include "core/scene/quantitygroup.h"
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowcommands.h"
#include "ui/rows/rowvalue.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtCore/QPointer>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QCursor>
#include <QtWidgets/QMenu>

#include <functional>
#include <string_view>

namespace ps {
namespace {

QString line(const char* head, const QString& text) {
  if (text.isEmpty()) return {};
  return QStringLiteral("<div style=\"margin-top:3px\"><span style=\"color:%1\">%2</span> %3</div>")
      .arg(Theme::current()[Token::Muted].name(), QLatin1String(head), text.toHtmlEscaped());
}

/// What a probe may measure, which is more than a screen is high. The group of what is chosen is marked, too.
void addInGroups(QMenu& menu, const QStringList& names, const std::function<bool(qsizetype)>& isChosen,
                 const std::function<void(QMenu&, qsizetype)>& add) {
  for (const std::string_view title : quantityGroups()) {
    QMenu* group = nullptr;
    for (qsizetype i = 0; i < names.size(); ++i) {
      if (quantityGroup(names[i].toStdString()) != title) continue;
      if (!group) group = menu.addMenu(QString::fromUtf8(title.data(), static_cast<qsizetype>(title.size())));
      add(*group, i);
      if (!isChosen(i)) continue;
      group->menuAction()->setCheckable(true);
      group->menuAction()->setChecked(true);
    }
  }
}

}  // namespace

QString ParameterRow::Private::toolTipText() const {
  const api::ParameterDeclaration& p = declaration();
  const QString unit = displayUnit(p);
  QString text = QStringLiteral("<div><b>%1</b></div>").arg(QString::fromUtf8(p.label).toHtmlEscaped());
  if (!model.disabledReason.isEmpty()) text += line("", model.disabledReason);
  text += line("", QString::fromUtf8(p.help ? p.help : ""));
  for (const QString& rule : model.rules)
    if (rule != model.disabledReason) text += line("", rule);
  if (isNumeric() && p.maximum > p.minimum) {
    text += line("Range", QStringLiteral("%1 to %2").arg(formatBound(p, p.minimum), formatBound(p, p.maximum)));
  }
  if (q->has(RowState::OutOfRange)) {
    text += line("", QStringLiteral("The value lies beyond the slider. It is allowed and acts, typed values may reach "
                                    "from %1 to %2.")
                         .arg(formatBound(p, p.hardMinimum), formatBound(p, p.hardMaximum)));
  }
  if (!isCurve(model.defaultValue) && isNumeric()) {
    text += line("Default", formatValue(p, numberOfValue(p, model.defaultValue, model.temperature)));
  }
  if (showsCurve()) text += line("Shown at", temperatureText(model.temperature, 1));
  if (showsCurve() && isEditable()) {
    text += line("", model.mixed ? QStringLiteral("Drag sideways to scale each one's curve.")
                                 : QStringLiteral("Drag sideways to scale the curve. A number that is typed takes its "
                                                  "place, *2 doubles it."));
  }
  if (model.mixed && isNumeric() && isEditable()) {
    text += line("", QStringLiteral("Values differ here. A number that is typed is set for all; *2 doubles each, +10 "
                                    "adds 10 to each."));
  }
  text += line("Key", keyText());
  text += line("Example", QString::fromUtf8(p.example ? p.example : ""));
  const bool ofDefault = !model.source.isEmpty() && q->isChanged();
  text += line(ofDefault ? "Default from" : "Source",
               !model.source.isEmpty() ? model.source : QString::fromUtf8(p.source ? p.source : ""));
  return text;
}

void ParameterRow::Private::openChoiceMenu() {
  const QPointer<QMenu> menu(new QMenu(q));
  const QStringList names = choiceTexts();
  const auto isChosen = [&](qsizetype i) { return !model.mixed && static_cast<qsizetype>(q->number()) == i; };
  const auto add = [&](QMenu& to, qsizetype i) {
    QAction* action = to.addAction(asButtonText(names[i]));
    action->setCheckable(true);
    action->setChecked(isChosen(i));
    action->setData(static_cast<int>(i));
  };
  if (QLatin1String(declaration().key) == QLatin1String("quantity")) {
    addInGroups(*menu, choiceNames(declaration()), isChosen, add);
  } else {
    for (qsizetype i = 0; i < names.size(); ++i) add(*menu, i);
  }
  const QRect rect = choiceRect();
  menu->setMinimumWidth(rect.width());
  const QAction* chosen = menu->exec(q->mapToGlobal(rect.bottomLeft() + QPoint(0, 2)));
  if (!menu) return;  // the row went while its menu was open
  menu->deleteLater();
  if (chosen) choose(chosen->data().toInt());
}

void ParameterRow::Private::openContextMenu(const QContextMenuEvent& event) {
  const QPoint global = event.globalPos();
  const bool byKey = event.reason() == QContextMenuEvent::Keyboard;
  const QPointer<QMenu> menu(new QMenu(q));
  const auto may = [this](RowCommand command) { return whyNot(*q, command).isEmpty(); };
  const auto add = [&menu](RowCommand command) {
    QAction* action = menu->addAction(textOf(command));
    action->setData(static_cast<int>(command));
    return action;
  };
  add(RowCommand::Copy);
  add(RowCommand::Paste)->setEnabled(may(RowCommand::Paste));
  add(RowCommand::Reset)->setEnabled(may(RowCommand::Reset));
  if (may(RowCommand::MakeConstant)) add(RowCommand::MakeConstant);
  menu->addSeparator();
  if (may(RowCommand::Pin))
    add(RowCommand::Pin)
        ->setText(model.isPinned ? QStringLiteral("Remove from “Try these”") : QStringLiteral("Pin to “Try these”"));
  if (may(RowCommand::Plot)) add(RowCommand::Plot);
  addKeyEntries(menu);
  menu->addSeparator();
  add(RowCommand::Explain);
  const QAction* chosen = menu->exec(global);
  if (!menu) return;  // the row went while its menu was open
  menu->deleteLater();
  if (!chosen || !chosen->data().isValid()) return;  // keys have their own
  // A tip beneath the pointer is taken away by it.
  perform(*q, static_cast<RowCommand>(chosen->data().toInt()), byKey ? global : QCursor::pos());
}

void ParameterRow::contextMenuEvent(QContextMenuEvent* event) { d->openContextMenu(*event); }

}  // namespace ps
