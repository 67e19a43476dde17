// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/rowcommands.h"

#include "ui/rows/parameterpanel.h"
#include "ui/rows/rowvalue.h"

#include <QtCore/QMetaMethod>
#include <QtCore/QTimer>
#include <QtGui/QClipboard>
#include <QtGui/QGuiApplication>
#include <QtGui/QHelpEvent>
#include <QtWidgets/QApplication>

namespace ps {
namespace {

using api::ParameterKind;

constexpr const char* kToNext = "To the next key";
constexpr NamedRowCommand kCommands[] = {
    {RowCommand::Copy, "copy", "Copy value"},
    {RowCommand::Paste, "paste", "Paste value"},
    {RowCommand::Reset, "reset", "Reset"},
    {RowCommand::MakeConstant, "constant", "Make constant"},
    {RowCommand::Pin, "pin", "Pin to “Try these”, or remove from there"},
    {RowCommand::Plot, "plot", "Plot"},
    {RowCommand::HoldToNext, "hold", "Hold its value", kToNext},
    {RowCommand::LineToNext, "line", "Straight line", kToNext},
    {RowCommand::CurveToNext, "curve", "Smooth curve", kToNext},
    {RowCommand::RemoveKeys, "keys", "Remove all keys"},
    {RowCommand::Explain, "explain", "Explain"},
};

constexpr int kMenuGone = 100;  ///< ms after which a closed menu's events have come

QString clipboardText() { return QGuiApplication::clipboard()->text().trimmed(); }

QString whyNotEdited(const RowModel& model) {
  if (!model.disabledReason.isEmpty()) return model.disabledReason;
  return model.derivedFrom.isEmpty() ? QString() : QStringLiteral("It is computed %1.").arg(model.derivedFrom);
}

QString whyNotPasted(const RowModel& model) {
  if (const QString why = whyNotEdited(model); !why.isEmpty()) return why;
  const ParameterKind kind = model.declaration.kind;
  if (kind == ParameterKind::Toggle || kind == ParameterKind::Choice) return QStringLiteral("Only numbers are pasted.");
  return clipboardText().isEmpty() ? QStringLiteral("The clipboard holds no text.") : QString();
}

QString whyNotConstant(const RowModel& model) {
  if (const QString why = whyNotEdited(model); !why.isEmpty()) return why;
  if (!isCurve(model.value)) return QStringLiteral("It is no curve.");
  return model.mixed ? QStringLiteral("Values differ here.") : QString();
}

/// A graph has the values of numbers and switches over time.
QString whyNotPlotted(const RowModel& model) {
  if (model.kept) return QStringLiteral("Its plugin is not installed.");
  const ParameterKind kind = model.declaration.kind;
  if (kind == ParameterKind::Response) return QStringLiteral("It may depend on temperature: Tune shows its curve.");
  return kind == ParameterKind::Choice ? QStringLiteral("Only numbers and switches are plotted.") : QString();
}

QString whyNoWay(const RowModel& model) {
  if (model.keyMark == KeyMark::None) return QStringLiteral("It has no keys.");
  if (const QString why = whyNotEdited(model); !why.isEmpty()) return why;
  if (isCurve(model.value)) return QStringLiteral("Points of its curve go by keys: the timeline has them.");
  if (model.declaration.kind == ParameterKind::Toggle) return QStringLiteral("A switch holds its value in any case.");
  return model.mixed ? QStringLiteral("Values differ here.") : QString();
}

/// Once the menu's events are over: those that it leaves behind (the pointer's return, the focus) take a tip away.
void explain(ParameterRow& row, const QPoint& global) {
  QTimer::singleShot(kMenuGone, &row, [&row, global] {
    QHelpEvent asked(QEvent::ToolTip, row.mapFromGlobal(global), global);
    QApplication::sendEvent(&row, &asked);
  });
}

}  // namespace

std::span<const NamedRowCommand> rowCommands() { return kCommands; }

QString textOf(RowCommand command) {
  for (const NamedRowCommand& each : kCommands) {
    if (each.command == command) return QString::fromUtf8(each.text);
  }
  return {};
}

std::optional<ToNext> wayOf(RowCommand command) {
  switch (command) {
    case RowCommand::HoldToNext:
      return ToNext::Step;
    case RowCommand::LineToNext:
      return ToNext::Linear;
    case RowCommand::CurveToNext:
      return ToNext::Smooth;
    default:
      return std::nullopt;
  }
}

bool ParameterRow::isServed(RowCommand command) const {
  if (wayOf(command)) return isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::wayChosen));
  switch (command) {
    case RowCommand::Pin:
      return isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::pinToggled));
    case RowCommand::Plot:
      return isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::plotRequested));
    case RowCommand::RemoveKeys:
      return isSignalConnected(QMetaMethod::fromSignal(&ParameterRow::keysRemoved));
    default:
      return true;
  }
}

QString whyNot(const ParameterRow& row, RowCommand command) {
  const RowModel& model = row.model();
  if (!row.isServed(command)) return QStringLiteral("It is no value of the scene.");
  if (wayOf(command)) return whyNoWay(model);
  switch (command) {
    case RowCommand::Paste:
      return whyNotPasted(model);
    case RowCommand::Reset:
      if (const QString why = whyNotEdited(model); !why.isEmpty()) return why;
      return row.isChanged() || model.together ? QString() : QStringLiteral("It has its default value.");
    case RowCommand::MakeConstant:
      return whyNotConstant(model);
    case RowCommand::Pin:
      return model.kept && !model.isPinned ? QStringLiteral("Its plugin is not installed.") : QString();
    case RowCommand::Plot:
      return whyNotPlotted(model);
    case RowCommand::RemoveKeys:
      return model.keyMark == KeyMark::None ? QStringLiteral("It has no keys.") : QString();
    default:
      break;
  }
  return {};
}

ParameterRow* rowAtHand(std::span<ParameterPanel* const> panels) {
  ParameterRow* focused = nullptr;
  for (const ParameterPanel* panel : panels) {
    if (!panel->isVisible()) continue;
    for (ParameterRow* row : panel->rows()) {
      if (row->isHovered()) return row;
      if (row->hasFocus()) focused = row;
    }
  }
  return focused;
}

void perform(ParameterRow& row, RowCommand command, const QPoint& global) {
  if (const auto way = wayOf(command)) return row.wayChosen(row.key(), *way);
  switch (command) {
    case RowCommand::Copy:
      return QGuiApplication::clipboard()->setText(row.valueText());
    case RowCommand::Paste:
      row.enter(clipboardText());
      return;
    case RowCommand::Reset:
      return row.reset();
    case RowCommand::MakeConstant:
      row.enterNumber(row.number());
      return;
    case RowCommand::Pin:
      return row.pinToggled(row.key(), !row.model().isPinned);
    case RowCommand::Plot:
      return row.plotRequested(row.key());
    case RowCommand::RemoveKeys:
      return row.keysRemoved(row.key());
    case RowCommand::Explain:
      return explain(row, global);
    default:
      break;
  }
}

}  // namespace ps
