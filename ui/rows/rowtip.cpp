// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowvalue.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/theme/units.h"

#include <QtCore/QMetaMethod>
#include <QtCore/QPointer>
#include <QtCore/QTimer>
#include <QtGui/QClipboard>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QCursor>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QMenu>

namespace ps {
namespace {

constexpr int kMenuGone = 100;  ///< ms after which a closed menu's events have come

QString line(const char* head, const QString& text) {
  if (text.isEmpty()) return {};
  return QStringLiteral("<div style=\"margin-top:3px\"><span style=\"color:%1\">%2</span> %3</div>")
      .arg(Theme::current()[Token::Muted].name(), QLatin1String(head), text.toHtmlEscaped());
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
  for (qsizetype i = 0; i < names.size(); ++i) {
    QAction* action = menu->addAction(asButtonText(names[i]));
    action->setCheckable(true);
    action->setChecked(!model.mixed && static_cast<qsizetype>(q->number()) == i);
    action->setData(static_cast<int>(i));
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
  QAction* copy = menu->addAction(QStringLiteral("Copy value"));
  QAction* paste = menu->addAction(QStringLiteral("Paste value"));
  paste->setEnabled(isEditable() && isNumeric() && !QGuiApplication::clipboard()->text().isEmpty());
  QAction* resetAction = menu->addAction(QStringLiteral("Reset"));
  resetAction->setEnabled(isEditable() && (q->isChanged() || model.together));
  QAction* constant =
      showsCurve() && isEditable() && !model.mixed ? menu->addAction(QStringLiteral("Make constant")) : nullptr;
  menu->addSeparator();
  const auto offered = [this](const QMetaMethod& signal) { return q->isSignalConnected(signal); };
  QAction* pin = nullptr;
  QAction* plot = nullptr;
  if ((!model.kept || model.isPinned) && offered(QMetaMethod::fromSignal(&ParameterRow::pinToggled))) {
    pin = menu->addAction(model.isPinned ? QStringLiteral("Remove from “Try these”")
                                         : QStringLiteral("Pin to “Try these”"));
  }
  const bool plots =
      !model.kept && ((isNumeric() && !showsCurve()) || declaration().kind == api::ParameterKind::Toggle);
  if (plots && offered(QMetaMethod::fromSignal(&ParameterRow::plotRequested)))
    plot = menu->addAction(QStringLiteral("Plot"));
  addKeyEntries(menu);
  menu->addSeparator();
  QAction* explain = menu->addAction(QStringLiteral("Explain"));
  const QAction* chosen = menu->exec(global);
  if (!menu) return;  // the row went while its menu was open
  menu->deleteLater();
  if (!chosen) return;
  if (chosen == copy)
    QGuiApplication::clipboard()->setText(q->valueText());
  else if (chosen == paste)
    q->enter(QGuiApplication::clipboard()->text().trimmed());
  else if (chosen == resetAction)
    q->reset();
  else if (chosen == constant)
    single(valueOfNumber(declaration(), q->number()));
  else if (chosen == pin)
    Q_EMIT q->pinToggled(model.key, !model.isPinned);
  else if (chosen == plot)
    Q_EMIT q->plotRequested(model.key);
  else if (chosen == explain)
    this->explain(byKey ? global : QCursor::pos());  // a tip beneath the pointer is taken away by it
}

/// Once the menu's events are over: those that it leaves behind (the pointer's return, the focus) take a tip away.
void ParameterRow::Private::explain(const QPoint& global) {
  QTimer::singleShot(kMenuGone, q, [this, global] { showRichTip(global, toolTipText(), q); });
}

void ParameterRow::contextMenuEvent(QContextMenuEvent* event) { d->openContextMenu(*event); }

}  // namespace ps
