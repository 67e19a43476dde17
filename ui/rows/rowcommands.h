// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

class QPoint;

namespace ps {

class ParameterRow;

/// What a row's menu and Ctrl+K do with it.
enum class RowCommand { Copy, Paste, Reset, MakeConstant, Pin, Plot, RemoveKeys, Explain };

/// "" or a sentence that says why it may not be done with this row.
QString whyNot(const ParameterRow& row, RowCommand command);
/// Does what whyNot() has nothing against. An explanation comes at `global`.
void perform(ParameterRow& row, RowCommand command, const QPoint& global);

}  // namespace ps
