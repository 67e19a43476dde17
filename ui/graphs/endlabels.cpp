// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/endlabels.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kPitch = 15, kHeight = 16, kGap = 5;                  // px, of one label and between name and value
constexpr double kDot = 3, kMark = 11, kBetween = 8, kNarrowest = 48;  // px, of columns: before a name, between them

QColor ground() {
  QColor colour = Theme::current()[Token::Field];
  colour.setAlphaF(0.75F);
  return colour;
}

void paintDot(QPainter& painter, const QPointF& at, int series) {
  painter.setPen(Qt::NoPen);
  painter.setBrush(Theme::current().series(series));
  painter.drawEllipse(at, kDot, kDot);
}

double widthOf(const EndLabel& label) {
  return textWidth(label.name, Theme::font(TextRole::Small)) + kGap + label.valueWidth;
}

/// The value ends where the longest one would.
void paintLabel(QPainter& painter, const QRectF& rect, const QString& name, const QString& value) {
  const QFont font = Theme::font(TextRole::Small);
  const QColor ink = Theme::current()[Token::Text];
  painter.fillRect(rect.adjusted(-2, 1, 2, -1), ground());
  paintText(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, name, font, ink);
  paintText(painter, rect, Qt::AlignRight | Qt::AlignVCenter, value, font, ink);
}

/// Each at its line's end or as little below it as keeps the texts apart.
void keepApart(std::vector<EndLabel>& labels, const QRectF& room) {
  for (EndLabel& label : labels) label.top = label.end.y() - kHeight / 2;
  std::sort(labels.begin(), labels.end(), [](const EndLabel& a, const EndLabel& b) { return a.top < b.top; });
  for (size_t i = 0; i < labels.size(); ++i)
    labels[i].top = std::max(labels[i].top, i == 0 ? room.top() : labels[i - 1].top + kPitch);
  for (size_t i = labels.size(); i-- > 0;)
    labels[i].top =
        std::min(labels[i].top, i + 1 == labels.size() ? room.bottom() - kHeight : labels[i + 1].top - kPitch);
}

/// In as few columns as there must be, at the right, where lines end.
bool paintColumns(QPainter& painter, const std::vector<EndLabel>& labels, const QRectF& room,
                  std::vector<QRectF>& taken) {
  if (room.height() < kHeight) return false;
  const QFont font = Theme::font(TextRole::Small);
  const size_t rows = 1 + static_cast<size_t>((room.height() - kHeight) / kPitch);
  double widest = 0;
  for (const EndLabel& label : labels) widest = std::max(widest, kMark + widthOf(label) + kBetween);
  const auto most = static_cast<size_t>(std::max(1.0, room.width() / kNarrowest));
  const size_t columns = std::min(most, (labels.size() + rows - 1) / rows);
  const double wide = std::min(widest, room.width() / static_cast<double>(columns));
  const bool values = wide >= widest;
  const size_t shown = labels.size() > rows * columns ? rows * columns - 1 : labels.size();
  bool whole = shown == labels.size();
  const double left = room.right() - wide * static_cast<double>(columns);
  const auto place = [&](size_t k) {
    return QRectF(left + wide * static_cast<double>(k / rows), room.top() + kPitch * static_cast<double>(k % rows),
                  wide - kBetween, kHeight);
  };
  for (size_t k = 0; k < shown; ++k) {
    taken.push_back(place(k));
    const QRectF rect = place(k).adjusted(kMark, 0, 0, 0);
    paintLabel(painter, rect.adjusted(-kMark, 0, 0, 0), {}, {});
    paintDot(painter, {rect.left() - kMark + kDot, rect.center().y()}, labels[k].series);
    paintText(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, labels[k].name, font, Theme::current()[Token::Text]);
    if (values)
      paintText(painter, rect, Qt::AlignRight | Qt::AlignVCenter, labels[k].value, font, Theme::current()[Token::Text]);
    whole = whole && textWidth(labels[k].name, font) <= rect.width();
  }
  if (shown < labels.size()) {
    taken.push_back(place(shown));
    paintLabel(painter, place(shown), QStringLiteral("+%1").arg(labels.size() - shown), {});
  }
  return whole;
}

}  // namespace

bool paintEndLabels(QPainter& painter, std::vector<EndLabel> labels, const QRectF& room,
                    const std::function<double(double, double)>& leftOf, std::vector<QRectF>& taken) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const EndLabel& label : labels) paintDot(painter, label.end, label.series);
  if (labels.empty()) return true;
  // They may come a pixel nearer to what is above.
  if (room.height() + 1 < kHeight + kPitch * static_cast<double>(labels.size() - 1))
    return paintColumns(painter, labels, room, taken);
  keepApart(labels, room);
  for (const EndLabel& label : labels) {
    const double width = widthOf(label);
    taken.emplace_back(leftOf(label.end.x(), width), label.top, width + 1, kHeight);
    paintLabel(painter, taken.back(), label.name, label.value);
  }
  return true;
}

}  // namespace ps
