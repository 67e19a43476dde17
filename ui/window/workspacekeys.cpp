// SPDX-License-Identifier: Apache-2.0
#include "ui/window/workspacekeys.h"

#include "ui/window/actions.h"

#include <QtCore/QVariant>
#include <QtGui/QAction>

namespace ps {
namespace {

using Keys = QList<QKeySequence>;
constexpr const char *kHere = "keysInSketch", *kElsewhere = "keysElsewhere", *kAlways = "keysAlways";

const char* nameOf(KeysIn where) { return where == KeysIn::Sketch ? kHere : kElsewhere; }

Keys listOf(const QAction& action, const char* name) { return action.property(name).value<Keys>(); }

/// An action that says nothing of workspaces has its keys in all of them.
Keys alwaysOf(const QAction& action) {
  return action.property(kAlways).isValid() ? listOf(action, kAlways) : action.shortcuts();
}

}  // namespace

void addKeys(QAction& action, KeysIn where, const QList<QKeySequence>& keys) {
  action.setProperty(kAlways, QVariant::fromValue(alwaysOf(action)));
  action.setProperty(nameOf(where), QVariant::fromValue(keys));
}

QList<QKeySequence> keysIn(const QAction& action, KeysIn where) {
  return listOf(action, nameOf(where)) + alwaysOf(action);
}

QList<QKeySequence> allKeys(const QAction& action) {
  return listOf(action, kHere) + listOf(action, kElsewhere) + alwaysOf(action);
}

QStringList keyTexts(const QAction& action) {
  QStringList texts;
  const auto add = [&texts](const Keys& keys, const QString& text) {
    for (const QKeySequence& key : keys) texts << text.arg(key.toString(QKeySequence::NativeText));
  };
  add(listOf(action, kHere), QStringLiteral("%1 in Sketch"));
  add(listOf(action, kElsewhere), QStringLiteral("%1 outside Sketch"));
  add(alwaysOf(action), QStringLiteral("%1"));
  return texts;
}

void useKeys(const Actions& actions, KeysIn where) {
  for (QAction* action : actions.all()) {
    if (action->property(kAlways).isValid()) action->setShortcuts(keysIn(*action, where));
  }
}

}  // namespace ps
