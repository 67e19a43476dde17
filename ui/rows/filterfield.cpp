// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/filterfield.h"

#include "ui/theme/icon.h"
#include "ui/theme/theme.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>

namespace ps {

FilterField::FilterField(QWidget* parent, const QString& icon) : QLineEdit(parent), m_icon(icon) {
  setObjectName(QStringLiteral("psFilter"));
  setAccessibleName(QStringLiteral("Filter"));
  setTextMargins(23, 0, 0, 0);
}

void FilterField::paintEvent(QPaintEvent* event) {
  QLineEdit::paintEvent(event);
  QPainter painter(this);
  paintIcon(painter, QRectF(9, (height() - 16) / 2.0, 16, 16), m_icon, Theme::current()[Token::Text2]);
}

void FilterField::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape && !text().isEmpty())
    clear();
  else
    QLineEdit::keyPressEvent(event);
}

}  // namespace ps
