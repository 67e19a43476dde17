// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/panelheader.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <utility>

namespace ps {
namespace {

constexpr int kLeft = 12, kRight = 10, kTop = 10, kSwatch = 40;
constexpr int kName = 20, kSubtitle = 18, kDetail = 16;  ///< heights of the lines

}  // namespace

PanelHeader::PanelHeader(QWidget* parent) : QWidget(parent) {
  // Not fixed: a layout would then hold it to the height of its hint, whatever its width.
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Minimum);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
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
  updateGeometry();
  update();
}

PanelHeader::Captions PanelHeader::captionsIn(int width) const {
  const double room = width - kLeft - kRight - (m_swatch ? kSwatch + kLeft : 0);
  const auto whole = [room](const QString& text, TextRole role) {
    return textWidth(text, Theme::font(role)) <= room ? text : QString();
  };
  return {whole(m_subtitle, TextRole::Normal), whole(m_detail, TextRole::Small)};
}

int PanelHeader::heightForWidth(int width) const {
  const Captions captions = captionsIn(width);
  return kTop + kName + (captions.subtitle.isEmpty() ? 0 : kSubtitle) + (captions.detail.isEmpty() ? 0 : kDetail);
}

QSize PanelHeader::sizeHint() const { return {300, heightForWidth(std::max(width(), 300))}; }

void PanelHeader::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  double left = kLeft;
  if (m_swatch) {
    const double side = std::min<double>(kSwatch, height() - kTop), edge = side / 9;  // a swatch leaves its edge free
    m_swatch(painter,
             QRectF(left + 1, kTop + (height() - kTop - side) / 2, side, side).adjusted(-edge, -edge, edge, edge));
    left += side + kLeft;
  }
  const Captions captions = captionsIn(width());
  double top = kTop;
  const auto line = [&](const QString& text, int height, TextRole role, Token colour) {
    if (text.isEmpty()) return;
    paintText(painter, QRectF(left, top, width() - left - kRight, height), Qt::AlignLeft | Qt::AlignVCenter, text,
              Theme::font(role), theme[colour]);
    top += height;
  };
  line(m_name, kName, TextRole::Heading, Token::Text);
  line(captions.subtitle, kSubtitle - 1, TextRole::Normal, Token::Text2);
  line(captions.detail, kDetail, TextRole::Small, Token::Muted);
}

}  // namespace ps
