// SPDX-License-Identifier: Apache-2.0
#include "ui/window/dialogrow.h"

#include <QtWidgets/QDialog>
#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLabel>

#include <algorithm>

namespace ps {

void addDialogRow(QGridLayout& grid, const QString& label, QWidget* field, const QString& tip) {
  auto* words = new QLabel(label);
  words->setTextFormat(Qt::PlainText);
  words->setBuddy(field);
  words->setToolTip(tip);
  field->setToolTip(tip);
  field->setAccessibleName(label);
  const int line = grid.rowCount();
  grid.addWidget(words, line, 0);
  grid.addWidget(field, line, 1);
}

void focusDialogRow(const QWidget& dialog, const QString& label) {
  if (label.isEmpty()) return;
  const auto takes = [](const QWidget* field) { return field->focusPolicy() & Qt::TabFocus; };
  for (QWidget* field : dialog.findChildren<QWidget*>()) {
    if (field->accessibleName() != label) continue;
    QList<QWidget*> parts = field->findChildren<QWidget*>();  // buttons of a row that has several
    parts.prepend(field);
    const auto first = std::find_if(parts.begin(), parts.end(), takes);
    if (first == parts.end()) continue;
    (*first)->setFocus(Qt::OtherFocusReason);
    return;
  }
}

void bringUp(QDialog& dialog) {
  dialog.show();
  dialog.raise();
  dialog.activateWindow();
}

QDialog* bringUp(QWidget& window, const QString& name, const std::function<QDialog*()>& make) {
  const QList<QDialog*> all = window.findChildren<QDialog*>(name);
  // One that was closed just now may still be there.
  const auto open = std::find_if(all.begin(), all.end(), [](const QDialog* one) { return one->isVisible(); });
  QDialog* dialog = open == all.end() ? make() : *open;
  if (!dialog) return nullptr;
  dialog->setObjectName(name);
  bringUp(*dialog);
  return dialog;
}

}  // namespace ps
