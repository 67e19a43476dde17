// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/panelheader.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <utility>

namespace ps {

PanelHeader::PanelHeader(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void PanelHeader::setTexts(const QString& name, const QString& subtitle, const QString& detail) {
  if (name == m_name && subtitle == m_subtitle && detail == m_detail) return;
  m_name = name;
  m_subtitle = subtitle;
  m_detail = detail;
  setAccessibleName(name);
  setAccessibleDescription(subtitle);
  QStringList lines{name, subtitle, detail};
  lines.removeAll(QString());
  setToolTip(lines.join(QLatin1Char('\n')));  // not all of it may find room
  updateGeometry();
  update();
}

void PanelHeader::setSwatch(SwatchPainter painter) {
  m_swatch = std::move(painter);
  update();
}

QSize PanelHeader::sizeHint() const {
  return {300, 10 + 20 + (m_subtitle.isEmpty() ? 0 : 18) + (m_detail.isEmpty() ? 0 : 16)};
}

void PanelHeader::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  double left = 12;
  if (m_swatch) {
    const double side = std::min(40.0, height() - 10.0), edge = side / 9;  // a swatch leaves its edge free
    m_swatch(painter, QRectF(left + 1, 10 + (height() - 10 - side) / 2, side, side).adjusted(-edge, -edge, edge, edge));
    left = 12 + side + 12;
  }
  const QRectF area(left, 10, width() - left - 10, height());
  const int align = Qt::AlignLeft | Qt::AlignVCenter;
  paintText(painter, QRectF(area.left(), 10, area.width(), 20), align, m_name, Theme::font(TextRole::Heading),
            theme[Token::Text]);
  paintText(painter, QRectF(area.left(), 30, area.width(), 17), align, m_subtitle, Theme::font(TextRole::Normal),
            theme[Token::Text2]);
  paintText(painter, QRectF(area.left(), m_subtitle.isEmpty() ? 30 : 47, area.width(), 16), align, m_detail,
            Theme::font(TextRole::Small), theme[Token::Muted]);
}

}  // namespace ps
