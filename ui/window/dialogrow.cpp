// SPDX-License-Identifier: Apache-2.0
#include "ui/window/dialogrow.h"

#include <QtWidgets/QGridLayout>
#include <QtWidgets/QLabel>

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
  for (QWidget* field : dialog.findChildren<QWidget*>()) {
    if (field->accessibleName() == label && field->focusPolicy() != Qt::NoFocus)
      return field->setFocus(Qt::OtherFocusReason);
  }
}

}  // namespace ps
