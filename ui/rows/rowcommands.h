// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QString>

#include <optional>
#include <span>

class QPoint;

namespace ps {

class ParameterPanel;
class ParameterRow;

/// What a row's menu and Ctrl+K do with it.
enum class RowCommand {
  Copy,
  Paste,
  Reset,
  MakeConstant,
  Pin,
  Plot,
  HoldToNext,
  LineToNext,
  CurveToNext,
  RemoveKeys,
  Explain
};

struct NamedRowCommand {
  RowCommand command;
  const char* name;  ///< of its action, "edit.row.copy"
  const char* text;
  const char* menu = "";  ///< which it stands in, of the row's menu; "": in that itself
};
/// All, in the order of a row's menu.
std::span<const NamedRowCommand> rowCommands();
QString textOf(RowCommand command);
/// The way to the next key that it chooses; nothing: it chooses none.
std::optional<ToNext> wayOf(RowCommand command);

/// "" or a sentence that says why it may not be done with this row.
QString whyNot(const ParameterRow& row, RowCommand command);
/// Of panels that are shown: the row under the pointer, or else the one that has the focus; nullptr: there is none.
ParameterRow* rowAtHand(std::span<ParameterPanel* const> panels);
/// Does what whyNot() has nothing against. An explanation comes at `global`.
void perform(ParameterRow& row, RowCommand command, const QPoint& global);

}  // namespace ps
