// SPDX-License-Identifier: Apache-2.0
#include "ui/window/undoactions.h"

#include "ui/document/history.h"
#include "ui/theme/plaintext.h"
#include "ui/window/actions.h"

#include <QtGui/QAction>

namespace ps {
namespace {

QString whyNoUndo(const History& history) {
  const int64_t gone = history.letGoSteps();
  if (gone == 0) return QStringLiteral("Nothing to undo");
  const QString most = QStringLiteral("%1 MiB").arg(history.limit() >> 20);
  return (gone == 1 ? QStringLiteral("The step before this one was let go: undo keeps at most %2 (Edit > Preferences)")
                    : QStringLiteral("The %1 steps before this one were let go: undo keeps at most %2 (Edit > "
                                     "Preferences)")
                          .arg(gone))
      .arg(most);
}

}  // namespace

void followHistory(QAction* undo, QAction* redo, History& history) {
  QObject::connect(undo, &QAction::triggered, &history, &History::undo);
  QObject::connect(redo, &QAction::triggered, &history, &History::redo);
  const auto tell = [&history, undo, redo] {
    undo->setEnabled(history.canUndo());
    redo->setEnabled(history.canRedo());
    undo->setText(asButtonText(QStringLiteral("Undo ") + history.undoText()).trimmed());
    redo->setText(asButtonText(QStringLiteral("Redo ") + history.redoText()).trimmed());
    const QString why = history.canUndo() ? QString() : whyNoUndo(history);
    undo->setProperty(kWhyNot, why);
    undo->setToolTip(why);  // where there is none, its text
  };
  QObject::connect(&history, &History::indexChanged, undo, tell);
  QObject::connect(&history, &History::canUndoChanged, undo, tell);  // while a step is put together
  tell();
}

}  // namespace ps
