// SPDX-License-Identifier: Apache-2.0
#pragma once

class QAction;

namespace ps {

class History;

/// Undo and redo what the history holds: the actions say what that is, and, where there is nothing, why.
void followHistory(QAction* undo, QAction* redo, History& history);

}  // namespace ps
