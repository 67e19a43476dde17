// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QList>
#include <QtCore/QStringList>
#include <QtGui/QKeySequence>

class QAction;

namespace ps {

class Actions;

/// Where an action has keys: digits look from somewhere, but in Sketch they take materials.
enum class KeysIn { Sketch, Elsewhere };

/// Keys that an action has there alone, before those that it has in all workspaces. From useKeys() on they act.
void addKeys(QAction& action, KeysIn where, const QList<QKeySequence>& keys);
QList<QKeySequence> keysIn(const QAction& action, KeysIn where);
QList<QKeySequence> allKeys(const QAction& action);  ///< in any workspace
/// As a list of keys has them: "Alt+1", "1 outside Sketch".
QStringList keyTexts(const QAction& action);
void useKeys(const Actions& actions, KeysIn where);

}  // namespace ps
