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

QString nothingCalled(const QString& wanted, const QString& among) {
  const QString where = among.isEmpty() ? QString() : QStringLiteral(" among “%1”").arg(among.toHtmlEscaped());
  return QStringLiteral("Nothing called “%1”%2. <a href=\"clear\">Clear filter</a>")
      .arg(wanted.trimmed().toHtmlEscaped(), where);
}

NothingFound::NothingFound(QLineEdit& search) : m_search(search) {
  setTextFormat(Qt::RichText);
  setAlignment(Qt::AlignTop | Qt::AlignLeft);
  setWordWrap(true);
  hide();
  connect(this, &QLabel::linkActivated, &search, [&search] {
    search.clear();
    search.setFocus(Qt::OtherFocusReason);
  });
}

void NothingFound::standFor(QWidget& list, bool any, const QString& among) {
  const bool said = !any && !m_search.text().trimmed().isEmpty();
  setText(nothingCalled(m_search.text(), among));
  setVisible(said);
  list.setVisible(!said);
}

}  // namespace ps
