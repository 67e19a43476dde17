// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/curveview.h"

#include "core/math/responseedit.h"
#include "ui/graphs/timeplot.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtWidgets/QAccessibleWidget>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr double kLeft = 58, kTop = 12, kRight = 16, kHistogram = 44, kAxis = 22, kGap = 6;
constexpr double kPoint = 4.5, kMarker = 6;
constexpr double kLeastSpan = 0.5;     // decades of a logarithmic axis
constexpr double kWholeDecades = 2.5;  // on an axis of more than these nothing between them has a line

class CurveAccessible final : public QAccessibleWidget {
 public:
  explicit CurveAccessible(CurveView* view) : QAccessibleWidget(view, QAccessible::Chart) {}
  QString text(QAccessible::Text kind) const override {
    if (kind == QAccessible::Value) return static_cast<const CurveView*>(widget())->summary();
    return QAccessibleWidget::text(kind);
  }
};

QAccessibleInterface* makeAccessible(const QString& /*className*/, QObject* object) {
  auto* view = qobject_cast<CurveView*>(object);
  return view ? new CurveAccessible(view) : nullptr;
}

void installAccessibility() {
  static const bool installed = (QAccessible::installFactory(makeAccessible), true);
  (void)installed;
}

void hatch(QPainter& painter, const QRectF& rect, const QColor& colour) {
  painter.save();
  painter.setClipRect(rect, Qt::IntersectClip);
  painter.setPen(QPen(colour, 1));
  for (double x = rect.left() - rect.height(); x < rect.right(); x += 8)
    painter.drawLine(QPointF(x, rect.bottom()), QPointF(x + rect.height(), rect.top()));
  painter.restore();
}

QColor faint(QColor colour, double share) {
  colour.setAlphaF(static_cast<float>(share));
  return colour;
}

QString power(int exponent) {
  static const QString kRaised = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text = QStringLiteral("10");
  if (exponent < 0) text += QChar(0x207B);
  for (const QChar digit : QString::number(std::abs(exponent))) text += kRaised[digit.digitValue()];
  return text;
}

}  // namespace

CurveView::CurveView(CurveTarget& target, QWidget* parent) : QWidget(parent), m_target(target) {
  installAccessibility();
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAcceptDrops(true);
  setAccessibleName(QStringLiteral("Curve"));
  const auto take = [this] {
    m_shown = m_target.response();
    setAccessibleName(m_target.title() + QLatin1Char(' ') + m_target.subtitle());
    showParticles();
    fit();
  };
  connect(&target, &CurveTarget::targetChanged, this, [this, take] {
    dropDrag(true);
    take();
  });
  connect(&target, &CurveTarget::responseChanged, this, [this] {
    const Response before = std::exchange(m_shown, m_target.response());
    if (m_grip == Grip::None && (m_shown.kind != before.kind || hasLeft(before))) fit();
    update();
  });
  connect(&target, &CurveTarget::pointChanged, this, [this] { update(); });
  if (target.isKnown()) take();
}

bool CurveView::logarithmic() const { return m_target.declaration().scale == api::Scale::Logarithmic; }

double CurveView::level(double value) const {
  const double shown = toDisplay(m_target.declaration(), value);
  return logarithmic() ? std::log10(std::max(shown, 1e-300)) : shown;
}

double CurveView::ofLevel(double level) const {
  return fromDisplay(m_target.declaration(), logarithmic() ? std::pow(10.0, level) : level);
}

QRectF CurveView::plot() const {
  return QRectF(kLeft, kTop, std::max(40.0, width() - kLeft - kRight),
                std::max(40.0, height() - kTop - kAxis - (m_target.track() ? 0 : kHistogram) - kGap));
}

QRectF CurveView::histogram() const {
  const QRectF area = plot();
  return {area.left(), area.bottom() + kAxis, area.width(), kHistogram};
}

QPointF CurveView::at(double kelvin, double value) const {
  const QRectF area = plot();
  const double up = std::clamp((level(value) - m_low) / (m_high - m_low), -4.0, 5.0);
  return {area.left() + area.width() * (kelvin - m_first) / (m_last - m_first), area.bottom() - area.height() * up};
}

double CurveView::kelvinAt(double x) const {
  return m_first + (m_last - m_first) * (x - plot().left()) / plot().width();
}

double CurveView::valueAt(double y) const {
  return ofLevel(m_low + (m_high - m_low) * (plot().bottom() - y) / plot().height());
}

void CurveView::fit() {
  const auto [cold, hot] = m_target.range();
  const double margin = std::max(m_target.track() ? 0.0 : 10.0, 0.08 * (hot - cold));
  m_first = std::max(m_target.leastX(), cold - margin);
  m_last = hot + margin;
  double low = level(m_shown.at(m_first)), high = low;
  for (int i = 0; i <= 100; ++i) {
    const double now = level(m_shown.at(m_first + (m_last - m_first) * i / 100));
    low = std::min(low, now);
    high = std::max(high, now);
  }
  if (const auto most = m_target.delivered()) {
    low = std::min(low, level(*most));
    high = std::max(high, level(*most));
  }
  const double least = logarithmic() ? kLeastSpan : std::max(1e-12, 0.1 * std::abs(high));
  const double room = std::max(0.12 * (high - low), 0.5 * least);
  m_low = low - room;
  m_high = high + room;
  if (!logarithmic() && low >= 0) m_low = std::max(m_low, 0.0);
  showParticles();
}

/// Whether a point has come or moved out of sight, as one does whose value is typed.
bool CurveView::hasLeft(const Response& before) const {
  return std::any_of(m_shown.points.begin(), m_shown.points.end(), [&](const CurvePoint& p) {
    const double up = level(p.y);
    const bool inSight = p.x >= m_first && p.x <= m_last && up >= m_low && up <= m_high;
    return !inSight && std::find(before.points.begin(), before.points.end(), p) == before.points.end();
  });
}

/// While nothing runs nobody else tells of what it did not follow while it was hidden.
void CurveView::showEvent(QShowEvent*) { showParticles(); }

void CurveView::showParticles() {
  m_now = m_target.now(m_first, m_last);
  update();
}

void CurveView::setOverlays(std::vector<OverlayCurve> overlays) {
  m_overlays = std::move(overlays);
  update();
}

QString CurveView::summary() const {
  const api::ParameterDeclaration& declaration = m_target.declaration();
  const auto pair = [&](double kelvin, double value) {
    return formatValue(declaration, value) + QStringLiteral(" at ") + formatValue(m_target.axis(), kelvin);
  };
  if (const int chosen = m_target.point(); chosen >= 0 && static_cast<size_t>(chosen) < m_shown.points.size()) {
    const CurvePoint& p = m_shown.points[static_cast<size_t>(chosen)];
    return QStringLiteral("Point %1 of %2, ").arg(chosen + 1).arg(m_shown.points.size()) + pair(p.x, p.y);
  }
  const auto mark = m_target.mark(m_now);
  const double x = mark ? mark->x : m_target.track() ? m_shown.points.front().x : m_target.temperature(m_now);
  return pair(x, m_shown.at(x));
}

void CurveView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  paintBox(painter, plot(), theme[Token::Field], theme[Token::Line2], 0);
  painter.save();
  painter.setClipRect(plot());
  paintBands(painter);
  painter.restore();
  paintGrid(painter);
  painter.save();
  painter.setClipRect(plot());
  paintCurves(painter);
  paintHandles(painter);
  paintMarker(painter);
  painter.restore();
  if (!m_target.track()) paintHistogram(painter);
  if (hasFocus()) paintFocusRing(painter, plot().adjusted(-2, -2, 2, 2), 3);
}

void CurveView::paintGrid(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  const QRectF area = plot();
  const api::ParameterDeclaration& kelvin = m_target.axis();
  const Ticks along =
      niceTicks(toDisplay(kelvin, m_first), toDisplay(kelvin, m_last), std::max(2, int(area.width() / 90)));
  for (int i = 0; i < along.count; ++i) {
    const double x = at(fromDisplay(kelvin, along.at(i)), 1).x();
    paintVerticalLine(painter, x, area.top(), area.bottom(), theme[Token::Line]);
    QString text = tickText(along, i);
    if (i + 1 == along.count) text += QLatin1Char(' ') + displayUnit(kelvin);
    paintText(painter, QRectF(x - 44, area.bottom() + 3, 88, 16), Qt::AlignCenter, text, font, theme[Token::Muted]);
  }
  const auto across = [&](double height, const QString& text) {
    const double y = area.bottom() - area.height() * (height - m_low) / (m_high - m_low);
    paintHorizontalLine(painter, area.left(), area.right(), y, theme[Token::Line]);
    paintText(painter, QRectF(0, y - 8, area.left() - 7, 16), Qt::AlignRight | Qt::AlignVCenter, text, font,
              theme[Token::Muted]);
  };
  const int most = std::max(2, int(area.height() / 34));
  const Ticks up = niceTicks(m_low, m_high, most);
  for (int i = 0; i < up.count; ++i) {
    if (!logarithmic())
      across(up.at(i), tickText(up, i));
    else if (m_high - m_low < kWholeDecades)
      across(up.at(i), formatShort(std::pow(10.0, up.at(i)), 2));
    else if (up.at(i) == std::round(up.at(i)))
      across(up.at(i), power(static_cast<int>(up.at(i))));
  }
  paintText(painter, QRectF(area.left() + 6, area.top() + 3, 120, 16), Qt::AlignLeft | Qt::AlignVCenter,
            displayUnit(m_target.declaration()), font, theme[Token::Text2]);
}

void CurveView::paintBands(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  const QRectF area = plot();
  if (const auto most = m_target.delivered()) {
    const double y = std::max(area.top(), at(m_first, *most).y());
    hatch(painter, QRectF(area.topLeft(), QPointF(area.right(), y)), faint(theme[Token::Warning], 0.35));
    paintHorizontalLine(painter, area.left(), area.right(), y, theme[Token::Warning]);
    paintText(painter, QRectF(area.left(), y + 2, area.width() - 6, 16), Qt::AlignRight | Qt::AlignVCenter,
              QStringLiteral("The solver follows up to %1").arg(formatValue(m_target.declaration(), *most)), font,
              theme[Token::Warning]);
  }
  const auto melting = m_target.melting();
  if (!melting) return;
  const auto [solidus, liquidus] = *melting;
  const double left = at(solidus, 1).x(), right = at(liquidus, 1).x();
  painter.fillRect(QRectF(QPointF(left, area.top()), QPointF(std::max(right, left + 1), area.bottom())),
                   faint(theme[Token::Curve], 0.14));
  const auto edge = [&](double kelvin, const QString& name, int side) {
    const double x = at(kelvin, 1).x();
    painter.setPen(QPen(faint(theme[Token::Curve], 0.6), 1, Qt::DashLine));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    const QRectF place(side < 0 ? x - 204 : x + 4, area.bottom() - 18, 200, 16);
    paintText(painter, place, (side < 0 ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter,
              name + QLatin1Char(' ') + formatValue(temperatureDeclaration(), kelvin), font, theme[Token::Curve]);
  };
  if (solidus == liquidus) {
    edge(solidus, QStringLiteral("melts"), 1);
  } else {
    edge(solidus, QStringLiteral("solidus"), -1);
    edge(liquidus, QStringLiteral("liquidus"), 1);
  }
}

void CurveView::paintLine(QPainter& painter, const Response& response, const QColor& colour, double width,
                          bool dashed) const {
  QPainterPath path;
  const QRectF area = plot();
  for (double x = area.left(); x <= area.right() + 0.5; x += 1) {
    const double kelvin = kelvinAt(x);
    const QPointF next(x, at(kelvin, response.at(kelvin)).y());
    if (x == area.left())
      path.moveTo(next);
    else
      path.lineTo(next);
  }
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(colour, width, dashed ? Qt::DashLine : Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
}

void CurveView::paintCurves(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  const QRectF area = plot();
  if (const auto law = m_target.ghost()) paintLine(painter, *law, theme[Token::Muted], 1.2, true);
  for (size_t i = 0; i < m_overlays.size(); ++i) {
    const QColor colour = theme.series(static_cast<int>(i));
    paintLine(painter, m_overlays[i].response, colour, 1.4, theme.seriesDashed(static_cast<int>(i)));
    const double kelvin = kelvinAt(area.left() + 0.06 * area.width());
    const double y = at(kelvin, m_overlays[i].response.at(kelvin)).y();
    paintText(painter, QRectF(area.left() + 8, std::clamp(y - 18, area.top() + 18, area.bottom() - 18), 200, 16),
              Qt::AlignLeft | Qt::AlignVCenter, m_overlays[i].label, font, colour);
  }
  paintLine(painter, m_shown, theme[Token::Curve], 2.2, false);
  if (m_shown.kind != Response::Kind::Curve) return;
  for (size_t i = 0; i < m_shown.points.size(); ++i) {
    const bool chosen = static_cast<int>(i) == m_target.point();
    const QPointF centre = at(m_shown.points[i].x, m_shown.points[i].y);
    if (chosen) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(faint(theme[Token::Accent], 0.3));
      painter.drawEllipse(centre, kPoint + 4, kPoint + 4);
    }
    painter.setPen(QPen(theme[chosen ? Token::Accent : Token::Curve], 2));
    painter.setBrush(theme[chosen ? Token::Accent : Token::Field]);
    painter.drawEllipse(centre, kPoint, kPoint);
  }
}

void CurveView::paintMarker(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const auto mark = m_target.mark(m_now);
  if (!mark) return;
  const QColor colour = theme.series(1);  // heat's orange
  const double kelvin = mark->x, value = m_shown.at(kelvin);
  const QPointF centre = at(kelvin, value);
  const QRectF area = plot();
  painter.setPen(QPen(faint(colour, 0.8), 1, Qt::DotLine));
  painter.drawLine(QPointF(area.left(), centre.y()), centre);
  painter.drawLine(centre, QPointF(centre.x(), area.bottom()));
  painter.setPen(Qt::NoPen);
  paintDiamond(painter, centre, kMarker, colour, true);
  const QFont font = Theme::font(TextRole::Small);
  const QString who = mark->who;
  const QString what =
      formatValue(m_target.axis(), kelvin) + QStringLiteral(" · ") + formatValue(m_target.declaration(), value);
  const double width = std::max(textWidth(who, font), textWidth(what, Theme::font(TextRole::Medium))) + 16;
  QRectF box(centre.x() + 12, centre.y() - 44, width, 38);
  if (box.right() > area.right() - 2) box.moveRight(centre.x() - 12);
  if (box.top() < area.top() + 20) box.moveTop(centre.y() + 10);
  paintBox(painter, box, theme[Token::Panel], colour, 4);
  paintText(painter, box.adjusted(8, 2, -4, -19), Qt::AlignLeft | Qt::AlignVCenter, who, font, theme[Token::Text2]);
  paintText(painter, box.adjusted(8, 18, -4, -2), Qt::AlignLeft | Qt::AlignVCenter, what, Theme::font(TextRole::Medium),
            theme[Token::Text]);
}

void CurveView::paintHistogram(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QRectF area = histogram();
  const QFont font = Theme::font(TextRole::Small);
  paintBox(painter, area, theme[Token::Field], theme[Token::Line], 0);
  const size_t most = *std::max_element(m_now.bins.begin(), m_now.bins.end());
  const double step = area.width() / static_cast<double>(MaterialNow::kBins);
  for (size_t i = 0; i < MaterialNow::kBins && most > 0; ++i) {
    if (m_now.bins[i] == 0) continue;
    const double share = static_cast<double>(m_now.bins[i]) / static_cast<double>(most);
    const double height = std::max(1.0, share * (area.height() - 4));
    painter.fillRect(QRectF(area.left() + step * static_cast<double>(i), area.bottom() - 1 - height,
                            std::max(1.0, step - 1), height),
                     theme.series(1));
  }
  paintText(painter, area.adjusted(8, 2, -8, -area.height() + 18), Qt::AlignLeft | Qt::AlignVCenter,
            m_target.materialLabel() + QStringLiteral(" particles by temperature, now"), font, theme[Token::Text2]);
  paintText(
      painter, area.adjusted(8, 2, -8, -area.height() + 18), Qt::AlignRight | Qt::AlignVCenter,
      m_now.within == m_now.count
          ? QStringLiteral("%1 particles").arg(formatFixed(static_cast<double>(m_now.count)))
          : QStringLiteral("%1 of %2 particles")
                .arg(formatFixed(static_cast<double>(m_now.within)), formatFixed(static_cast<double>(m_now.count))),
      font, theme[Token::Text2]);
}

}  // namespace ps
