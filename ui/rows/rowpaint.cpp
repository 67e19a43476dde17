// SPDX-License-Identifier: Apache-2.0
#include "ui/rows/parameterrow_p.h"
#include "ui/rows/rowvalue.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kTrack = 4, kHandleWidth = 8, kHandleHeight = 12;
constexpr int kSegmentHeight = 20, kSegmentPadding = 8, kSegmentGap = 3;

/// Temperatures that a sparkline spans, in K: a curve's points, or 100 K around the operating point.
std::pair<double, double> sparklineRange(const Response& response, double temperature) {
  if (response.kind == Response::Kind::Curve && response.points.size() > 1) {
    return {response.points.front().x, response.points.back().x};
  }
  return {std::max(1.0, temperature - 100), temperature + 100};
}

void hatch(QPainter& painter, const QRectF& rect, const QColor& colour) {
  painter.save();
  painter.setClipRect(rect);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colour, 1.5));
  for (double x = rect.left() - rect.height(); x < rect.right() + rect.height(); x += 5) {
    painter.drawLine(QPointF(x, rect.bottom() + 1), QPointF(x + rect.height() + 2, rect.top() - 1));
  }
  painter.restore();
}

/// A label that is too long for its column stands in two smaller lines where these are whole: rows stay as high.
void paintLabel(QPainter& painter, const QRectF& rect, const QString& label, const QColor& colour) {
  const QFont normal = Theme::font(TextRole::Normal), small = Theme::font(TextRole::Small);
  const QLatin1Char gap(' ');
  const bool fits = textWidth(label, normal) <= rect.width() + 0.5;
  double least = rect.width();
  qsizetype at = -1;
  for (qsizetype space = fits ? -1 : label.indexOf(gap); space > 0; space = label.indexOf(gap, space + 1)) {
    const double widest = std::max(textWidth(label.left(space), small), textWidth(label.mid(space + 1), small));
    if (widest > least) continue;
    least = widest;
    at = space;
  }
  if (at < 0) return paintText(painter, rect, Qt::AlignLeft | Qt::AlignVCenter, label, normal, colour);
  const QRectF line(rect.left(), rect.top(), rect.width(), rect.height() / 2);
  paintText(painter, line, Qt::AlignLeft | Qt::AlignVCenter, label.left(at), small, colour);
  paintText(painter, line.translated(0, line.height()), Qt::AlignLeft | Qt::AlignVCenter, label.mid(at + 1), small,
            colour);
}

/// Of several of which some are on: no knob.
void paintMixedSwitch(QPainter& painter, const QRectF& rect, bool enabled) {
  const Theme& theme = Theme::current();
  paintBox(painter, rect, theme[enabled ? Token::ControlEdge : Token::Line2], QColor(), rect.height() / 2);
  paintText(painter, rect, Qt::AlignCenter, QStringLiteral("—"), Theme::font(TextRole::Medium),
            theme[enabled ? Token::Panel : Token::Disabled]);
}

}  // namespace

double ParameterRow::Private::handleX() const {
  const QRectF track = q->sliderRect();
  return track.left() + track.width() * sliderPosition(declaration(), q->number());
}

QRect ParameterRow::Private::curveRect() const {
  const QRect field = q->fieldRect();
  return {field.right() + 5, (kRowHeight - 16) / 2, 16, 16};
}

QRect ParameterRow::Private::targetOf(const QRect& mark) const {
  const int left = std::min(mark.center().x() - kRowHeight / 2, q->width() - kRowHeight);
  return {std::max(left, q->fieldRect().right() + 1), 0, kRowHeight, kRowHeight};
}

QRect ParameterRow::Private::switchRect() const {
  return {q->fieldRect().right() + 1 - 34, (kRowHeight - 16) / 2, 28, 16};
}

QStringList ParameterRow::Private::choiceTexts() const {
  QStringList texts = choiceNames(declaration());
  if (model.choiceLabels.size() == texts.size()) return model.choiceLabels;
  for (QString& text : texts) text = choiceLabel(text);
  return texts;
}

std::vector<QRect> ParameterRow::Private::segments() const {
  const QFont font = Theme::font(TextRole::Small);
  const QStringList names = choiceTexts();
  std::vector<int> widths;
  int total = -kSegmentGap;
  for (const QString& name : names) {
    widths.push_back(static_cast<int>(std::ceil(textWidth(name, font))) + 2 * kSegmentPadding);
    total += widths.back() + kSegmentGap;
  }
  const int right = q->fieldRect().right() + 1;
  const QString label = QString::fromUtf8(declaration().label);
  const int labelEnd = kRowLeft + static_cast<int>(std::ceil(textWidth(label, Theme::font(TextRole::Normal)))) + 8;
  if (model.mixed || names.size() > 4 || right - total < labelEnd) return {};  // mixed: the button says "—"
  std::vector<QRect> rects;
  for (int x = right - total; const int width : widths) {
    rects.emplace_back(x, (kRowHeight - kSegmentHeight) / 2, width, kSegmentHeight);
    x += width + kSegmentGap;
  }
  return rects;
}

QRect ParameterRow::Private::choiceRect() const {
  const std::vector<QRect> rects = segments();
  if (!rects.empty()) return rects.front().united(rects.back());
  const int right = q->fieldRect().right() + 1;
  int width = kFieldWidth;
  for (const QString& name : choiceTexts()) {
    width = std::max(width, static_cast<int>(textWidth(name, Theme::font(TextRole::Normal))) + 34);
  }
  width = std::min(width, right - kRowLeft - 90);
  return {right - width, (kRowHeight - kFieldHeight) / 2, width, kFieldHeight};
}

void ParameterRow::Private::paint(QPainter& painter) const {
  paintLeft(painter);
  paintKey(painter);
  const auto kind = declaration().kind;
  if (kind == api::ParameterKind::Toggle) {
    const QRectF rect = switchRect();
    if (model.mixed)
      paintMixedSwitch(painter, rect, isEditable());
    else
      paintSwitch(painter, rect, q->number() != 0, isEditable());
    if (q->hasFocus()) paintFocusRing(painter, rect.adjusted(-3, -3, 3, 3), 11);
    return;
  }
  if (kind == api::ParameterKind::Choice) {
    paintChoice(painter);
    return;
  }
  if (!model.derivedFrom.isEmpty()) {
    const double left = kRowLeft + q->wantedLabelWidth() + 4;
    const QRectF rect(left, 0, q->fieldRect().left() - 1 - left, kRowHeight);
    paintText(painter, rect, Qt::AlignRight | Qt::AlignVCenter, model.derivedFrom, Theme::font(TextRole::Normal),
              Theme::current()[Token::Info]);
  } else if (showsCurve()) {
    paintSparkline(painter);
  } else {
    paintSlider(painter);
  }
  paintField(painter);
}

void ParameterRow::Private::paintLeft(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const bool disabled = !model.disabledReason.isEmpty();
  const bool changed = q->isChanged() && !disabled;
  if (changed) paintBox(painter, QRectF(5, (kRowHeight - 14) / 2.0, 3, 14), theme[Token::Accent], QColor(), 1);
  const Token token = disabled ? Token::Disabled : changed || (hover && isEditable()) ? Token::Text : Token::Text2;
  paintLabel(painter, q->labelRect(), QString::fromUtf8(declaration().label), theme[token]);
  const double source = textWidth(model.derivedFrom, Theme::font(TextRole::Normal));
  if (drawsSymbol() && q->fieldRect().left() - 1 - source > q->sliderRect().left() - 6) {
    paintSymbol(painter, QRectF(q->sliderRect().left() - symbolRoom(), 0, symbolRoom(), kRowHeight),
                QString::fromUtf8(declaration().symbol), theme[disabled ? Token::Disabled : Token::Muted]);
  }
}

void ParameterRow::Private::paintSlider(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QRectF area = q->sliderRect();
  const double middle = kRowHeight / 2.0;
  const QRectF track(area.left(), middle - kTrack / 2, area.width(), kTrack);
  const bool enabled = isEditable(), handle = enabled && !model.mixed;
  paintBox(painter, track, theme[Token::Track], enabled ? theme[Token::TrackEdge] : theme[Token::Disabled], kTrack / 2);
  if (handle) {
    const QRectF filled(track.topLeft(), QPointF(handleX(), track.bottom()));
    if (filled.width() > 0.5) paintBox(painter, filled, theme[Token::SliderFill], QColor(), kTrack / 2);
  }
  if (std::isfinite(delivered)) {
    const double from = area.left() + area.width() * sliderPosition(declaration(), delivered);
    hatch(painter, QRectF(QPointF(from, track.top()), track.bottomRight()), theme[Token::Warning]);
  }
  if (enabled && !isCurve(model.defaultValue)) {
    const double standard = numberOfValue(declaration(), model.defaultValue, model.temperature);
    const double x = area.left() + area.width() * sliderPosition(declaration(), standard);
    paintVerticalLine(painter, x - 0.5, middle + 6, middle + 10, theme[Token::Muted]);
  }
  if (!handle) return;
  const QRectF knob(snapped(painter, handleX() - kHandleWidth / 2), middle - kHandleHeight / 2, kHandleWidth,
                    kHandleHeight);
  paintBox(painter, knob, theme[dragging ? Token::Accent : Token::Handle], theme[Token::HandleEdge], 3);
}

void ParameterRow::Private::paintSparkline(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const Response& response = std::get<Response>(model.value);
  const QRectF box = QRectF(q->sliderRect()).adjusted(0, 3, 0, -3);
  const bool enabled = model.disabledReason.isEmpty();
  paintBox(painter, box, theme[Token::Field], theme[hover ? Token::FieldEdgeHover : Token::FieldEdge], 3);
  const auto [cold, hot] = sparklineRange(response, model.temperature);
  const int samples = std::max(2, static_cast<int>(box.width()) - 2);
  std::vector<double> values;
  values.reserve(static_cast<size_t>(samples));
  for (int i = 0; i < samples; ++i) values.push_back(response.at(cold + (hot - cold) * i / (samples - 1)));
  const bool logarithmic =
      declaration().scale == api::Scale::Logarithmic && *std::min_element(values.begin(), values.end()) > 0;
  const auto level = [logarithmic](double value) { return logarithmic ? std::log(value) : value; };
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = level(*least), span = level(*most) - low;
  const auto point = [&, cold = cold, hot = hot](double kelvin, double value) {
    const double t = span > 0 ? (level(value) - low) / span : 0.5;
    return QPointF(box.left() + 1 + (box.width() - 2) * (kelvin - cold) / (hot - cold),
                   box.bottom() - 3.5 - (box.height() - 7) * t);
  };
  QPainterPath path;
  for (int i = 0; i < samples; ++i) {
    const QPointF next = point(cold + (hot - cold) * i / (samples - 1), values[static_cast<size_t>(i)]);
    if (i == 0)
      path.moveTo(next);
    else
      path.lineTo(next);
  }
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(
      QPen(theme[enabled ? Token::Curve : Token::Disabled], 1.35, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
  const double now = std::clamp(model.temperature, cold, hot);
  const QPointF dot = point(now, std::clamp(response.at(now), *least, *most));
  if (enabled) {
    paintVerticalLine(painter, dot.x() - 0.5, box.top() + 2, box.bottom() - 2, theme[Token::ControlEdge]);
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme[Token::Text]);
    painter.drawEllipse(dot, 2.5, 2.5);
  }
  painter.restore();
  // In a narrow panel there is room for one of the two.
  if (model.keyMark == KeyMark::None || !curveRect().intersects(q->keyRect()))
    paintIcon(painter, QRectF(curveRect()).adjusted(2, 2, -2, -2), QStringLiteral("curve"),
              theme[enabled ? Token::Curve : Token::Disabled]);
}

void ParameterRow::Private::paintField(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QRectF field = q->fieldRect();
  const bool disabled = !model.disabledReason.isEmpty(), derived = !model.derivedFrom.isEmpty();
  const bool wrong = q->has(RowState::Error), warning = q->has(RowState::OutOfRange) || q->has(RowState::Limited);
  const bool focus = q->hasFocus() || edit;
  if (!derived) {
    const Token edge = wrong                ? Token::Error
                       : warning            ? Token::Warning
                       : hover && !disabled ? Token::FieldEdgeHover
                                            : Token::FieldEdge;
    paintBox(painter, field, theme[wrong ? Token::ErrorGround : Token::Field], theme[edge], 4);
    if (focus)
      paintBox(painter, field.adjusted(-1, -1, 1, 1), QColor(), theme[wrong ? Token::Error : Token::Accent], 5, 2);
  }
  if (edit) return;
  const Token token = disabled ? Token::Disabled : wrong ? Token::Error : warning ? Token::Warning : Token::Text;
  const QFont font = Theme::font(TextRole::Medium), unitFont = Theme::font(TextRole::Normal);
  const auto [value, unit] = fieldText();
  // Value and unit meet at a common line in all rows; a long value or a long unit moves it as far as it must.
  double valueRight = field.left() + kValueRight;
  valueRight = std::min(valueRight, field.right() - 6 - (kUnitLeft - kValueRight) - textWidth(unit, unitFont));
  valueRight = std::max(valueRight, field.left() + kFieldLeft + textWidth(value, font));
  paintText(painter, QRectF(QPointF(field.left() + 4, field.top()), QPointF(valueRight, field.bottom())),
            Qt::AlignRight | Qt::AlignVCenter, value, font, theme[token]);
  const double unitLeft = valueRight + kUnitLeft - kValueRight;
  paintText(painter, QRectF(QPointF(unitLeft, field.top()), QPointF(field.right() - kFieldRight, field.bottom())),
            Qt::AlignLeft | Qt::AlignVCenter, unit, unitFont, theme[disabled ? Token::Disabled : Token::Muted]);
}

void ParameterRow::Private::paintChoice(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const bool enabled = isEditable();
  const int chosen = static_cast<int>(q->number());
  const QStringList names = choiceTexts();
  const std::vector<QRect> rects = segments();
  for (size_t i = 0; i < rects.size(); ++i) {
    const bool on = static_cast<int>(i) == chosen;
    paintBox(painter, rects[i], theme[on ? Token::Selection : Token::Raised], on ? QColor() : theme[Token::RaisedEdge],
             4);
    paintText(painter, rects[i], Qt::AlignCenter, names[static_cast<qsizetype>(i)], Theme::font(TextRole::Small),
              theme[!enabled ? Token::Disabled
                    : on     ? Token::Text
                             : Token::Text2]);
  }
  if (rects.empty()) {
    const QRectF button = choiceRect();
    paintBox(painter, button, theme[hover && enabled ? Token::Hover : Token::Raised], theme[Token::RaisedEdge], 4);
    paintText(painter, button.adjusted(8, 0, -22, 0), Qt::AlignLeft | Qt::AlignVCenter, q->valueText(),
              Theme::font(TextRole::Normal), theme[enabled ? Token::Text : Token::Disabled]);
    paintIcon(painter, QRectF(button.right() - 18, button.center().y() - 7, 14, 14), QStringLiteral("chevron-down"),
              theme[enabled ? Token::Text2 : Token::Disabled]);
  }
  if (q->hasFocus()) paintFocusRing(painter, QRectF(choiceRect()).adjusted(-2, -2, 2, 2), 6);
}

}  // namespace ps
