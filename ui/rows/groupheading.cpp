// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/groupheading.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>

namespace ps {

GroupHeading::GroupHeading(const QString& title, QWidget* parent) : QWidget(parent), m_title(title) {
  setAttribute(Qt::WA_Hover);
  setFocusPolicy(Qt::TabFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(title);
}

void GroupHeading::setCount(const QString& count) {
  m_count = count;
  update();
}

void GroupHeading::setFolded(bool folded) {
  if (folded == m_folded) return;
  m_folded = folded;
  setAccessibleDescription(folded ? QStringLiteral("folded") : QString());
  update();
}

void GroupHeading::toggle() {
  setFolded(!m_folded);
  Q_EMIT foldedChanged(m_folded);
}

bool GroupHeading::event(QEvent* event) {
  if (event->type() == QEvent::HoverEnter || event->type() == QEvent::HoverLeave) {
    m_hover = event->type() == QEvent::HoverEnter;
    update();
  }
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Space || key == Qt::Key_Left || key == Qt::Key_Right) {
      event->accept();
      return true;
    }
  }
  return QWidget::event(event);
}

void GroupHeading::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  paintHorizontalLine(painter, 0, width(), 0, theme[Token::Line]);
  const QRectF row(0, 1, width(), height() - 1);
  paintIcon(painter, QRectF(6, row.center().y() - 6, 12, 12),
            m_folded ? QStringLiteral("chevron-right") : QStringLiteral("chevron-down"),
            theme[m_hover ? Token::Text : Token::Text2]);
  QFont title = Theme::font(TextRole::Normal);
  title.setWeight(QFont::DemiBold);
  paintText(painter, QRectF(22, row.top(), width() - 40, row.height()), Qt::AlignLeft | Qt::AlignVCenter, m_title,
            title, theme[Token::Text]);
  const double right = 22 + textWidth(m_title, title) + 6;
  const QRectF rest(right, row.top(), width() - right - 12, row.height());
  const QFont font = Theme::font(TextRole::Normal);
  if (textWidth(m_count, font) <= rest.width())  // whole or not at all
    paintText(painter, rest, Qt::AlignLeft | Qt::AlignVCenter, m_count, font, theme[Token::Muted]);
  if (hasFocus()) paintFocusRing(painter, row.adjusted(3, 2, -3, -2), 4);
}

void GroupHeading::mousePressEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton) toggle();
}

void GroupHeading::keyPressEvent(QKeyEvent* event) {
  const int key = event->key();
  const bool folds = key == Qt::Key_Left ? !m_folded : key == Qt::Key_Right ? m_folded : false;
  if (folds || key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Space)
    toggle();
  else
    QWidget::keyPressEvent(event);
}

}  // namespace ps
