// SPDX-License-Identifier: Apache-2.0
#include "ui/curves/matterdiagram.h"

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/matter/phaselines.h"
#include "core/simulation/compile.h"
#include "ui/document/document.h"
#include "ui/graphs/timeplot.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr double kLeft = 56, kTop = 24, kRight = 20, kBottom = 22;
constexpr double kAround = 60;     // K beyond the last change of phase
constexpr double kDecades = 2;     // of pressure around the scene's and the triple point's
constexpr double kUnboiled = 300;  // K above what is known, where nothing boils

double celsius(double kelvin) { return toDisplay(temperatureDeclaration(), kelvin); }

}  // namespace

MatterDiagram::MatterDiagram(Kind kind, Session& session, CurveTarget& target, QWidget* parent)
    : QWidget(parent), m_kind(kind), m_session(session), m_target(target) {
  setAccessibleName(kind == Kind::Heating ? QStringLiteral("Heating curve") : QStringLiteral("Phase diagram"));
  const auto follow = [this] {
    if (isVisible()) rebuild();
  };
  connect(&target, &CurveTarget::responseChanged, this, follow);
  connect(&session.document(), &Document::changed, this, [follow](const ChangeEvent& event) {
    const auto* parameter = std::get_if<ParameterChanged>(&event);
    if (parameter && parameter->address.owner == Owner::Environment) follow();
  });
  connect(&session, &Session::projectShown, this, follow);
  connect(&session, &Session::totalsDue, this, [this] {
    if (isVisible()) showParticles();
  });
}

void MatterDiagram::showEvent(QShowEvent*) { rebuild(); }

void MatterDiagram::showParticles() {
  m_now = m_target.now(0, 1);
  setAccessibleDescription(summary());
  setToolTip(caption());  // it is cut where the panel is narrow
  update();
}

/// Bakes the material once more: its data may be other ones.
void MatterDiagram::rebuild() {
  m_corners.clear();
  m_problem.clear();
  const Project& project = m_session.document().project();
  const auto source = std::find_if(project.materials.begin(), project.materials.end(),
                                   [&](const SceneMaterial& m) { return m.id == m_target.material(); });
  if (source == project.materials.end() || !m_session.document().plugins()) return showParticles();
  m_pressure = std::get<double>(m_session.document().value({Owner::Environment, "", "ambient_pressure"}));
  try {
    EvaluatedMaterials evaluated;
    const Material material = compileMaterial(project, *source, *m_session.document().plugins(), evaluated);
    const api::Caloric caloric = BakedMaterial(material, m_pressure).caloric();
    m_diagram = phaseDiagramOf(material);
    const bool boils = std::isfinite(caloric.boilingPoint), melts = caloric.melts || caloric.sublimes;
    const double here = m_target.temperature();
    const double cold = std::min(melts ? caloric.solidus : here, here) - kAround;
    const double hot = std::max(boils   ? caloric.boilingPoint
                                : melts ? caloric.liquidus + kUnboiled
                                        : here,
                                here) +
                       kAround;
    m_corners = heatingCurve(caloric, std::max(1.0, cold), hot);
    const Axis kelvin{celsius(std::max(1.0, cold)), celsius(hot)};
    if (m_kind == Kind::Heating) {
      m_x = {m_corners.front().enthalpy / 1000, m_corners.back().enthalpy / 1000};
      m_y = kelvin;
    } else {
      const double scene = std::log10(std::max(m_pressure, 1.0));
      const double triple = m_diagram.triplePressure > 0 ? std::log10(m_diagram.triplePressure) : scene;
      m_x = kelvin;
      m_y = {std::min(scene, triple) - kDecades, std::max(scene, triple) + kDecades};
    }
  } catch (const Error& error) {
    m_problem = QString::fromUtf8(error.what());
  }
  showParticles();
}

QString MatterDiagram::caption() const {
  return m_target.materialLabel() + QStringLiteral(" at ") + formatPrefixed(m_pressure, QStringLiteral("Pa")) +
         QStringLiteral(" · now ") + summary();
}

QString MatterDiagram::summary() const {
  if (!m_problem.isEmpty()) return m_problem;
  QStringList parts;
  for (size_t k = 0; k < m_now.phases.size(); ++k) {
    if (m_now.phases[k] > 0)
      parts << phaseName(static_cast<api::Phase>(k)) + QLatin1Char(' ') +
                   formatShort(100.0 * static_cast<double>(m_now.phases[k]) / static_cast<double>(m_now.count), 3) +
                   QStringLiteral(" %");
  }
  return parts.isEmpty() ? QStringLiteral("No particles of this material") : parts.join(QStringLiteral(" · "));
}

QRectF MatterDiagram::plot() const {
  return {kLeft, kTop, std::max(40.0, width() - kLeft - kRight), std::max(30.0, height() - kTop - kBottom)};
}

QPointF MatterDiagram::at(double x, double y) const {
  const QRectF area = plot();
  return {area.left() + area.width() * (x - m_x.first) / (m_x.last - m_x.first),
          area.bottom() - area.height() * (y - m_y.first) / (m_y.last - m_y.first)};
}

void MatterDiagram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  paintText(painter, QRectF(kLeft, 4, width() - kLeft - kRight, 16), Qt::AlignLeft | Qt::AlignVCenter, caption(),
            Theme::font(TextRole::Small), theme[Token::Text2]);
  if (m_corners.empty()) return;
  paintBox(painter, plot(), theme[Token::Field], theme[Token::Line2], 0);
  paintAxes(painter);
  painter.setClipRect(plot());
  if (m_kind == Kind::Heating)
    paintHeating(painter);
  else
    paintPhases(painter);
}

void MatterDiagram::paintAxes(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  const QRectF area = plot();
  const bool heating = m_kind == Kind::Heating;
  const Ticks along = niceTicks(m_x.first, m_x.last, std::max(2, static_cast<int>(area.width() / 80)));
  for (int i = 0; i < along.count; ++i) {
    const double x = at(along.at(i), m_y.first).x();
    paintVerticalLine(painter, x, area.top(), area.bottom(), theme[Token::Line]);
    const QString unit = heating ? QStringLiteral(" kJ/kg") : QLatin1Char(' ') + displayUnit(temperatureDeclaration());
    const QRectF label(std::min(x - 40, width() - 82.0), area.bottom() + 3, 80, 16);
    paintText(painter, label, Qt::AlignCenter, tickText(along, i) + (i + 1 == along.count ? unit : QString()), font,
              theme[Token::Muted]);
  }
  const Ticks up = niceTicks(m_y.first, m_y.last, std::max(2, static_cast<int>(area.height() / 26)));
  for (int i = 0; i < up.count; ++i) {
    const double y = at(m_x.first, up.at(i)).y();
    paintHorizontalLine(painter, area.left(), area.right(), y, theme[Token::Line]);
    const QString text = heating ? tickText(up, i) : formatPrefixed(std::pow(10.0, up.at(i)), QStringLiteral("Pa"), 2);
    paintText(painter, QRectF(0, y - 8, area.left() - 6, 16), Qt::AlignRight | Qt::AlignVCenter, text, font,
              theme[Token::Muted]);
  }
}

/// A dot of the scene's state: particles of one phase, the larger the more.
void MatterDiagram::paintDot(QPainter& painter, const QPointF& centre, size_t phase) const {
  const double share = static_cast<double>(m_now.phases[phase]) / static_cast<double>(std::max<size_t>(1, m_now.count));
  const double radius = 3.5 + 5 * std::sqrt(share);
  painter.setPen(QPen(Theme::current()[Token::Field], 1.5));
  painter.setBrush(Theme::current().series(1));
  painter.drawEllipse(centre, radius, radius);
  paintText(painter, QRectF(centre.x() - 6, centre.y() - radius - 15, 12, 14), Qt::AlignCenter,
            phaseLetter(static_cast<api::Phase>(phase)), Theme::font(TextRole::Small), Theme::current()[Token::Text]);
}

void MatterDiagram::paintHeating(QPainter& painter) const {
  const Theme& theme = Theme::current();
  QPolygonF line;
  for (const HeatingCorner& corner : m_corners) line << at(corner.enthalpy / 1000, celsius(corner.temperature));
  painter.setPen(QPen(theme[Token::Curve], 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(line);
  for (size_t k = 0; k + 1 < m_corners.size(); ++k) {
    const auto phase = static_cast<size_t>(m_corners[k].phase);
    const double span = m_corners[k + 1].enthalpy - m_corners[k].enthalpy;
    const bool melting = m_corners[k].phase == api::Phase::Melting, boiling = m_corners[k].phase == api::Phase::Boiling;
    if (melting || boiling) {
      const QPointF middle = (line[static_cast<int>(k)] + line[static_cast<int>(k) + 1]) / 2;
      paintText(painter, QRectF(middle.x() - 110, middle.y() + 4, 220, 16), Qt::AlignCenter,
                (melting ? QStringLiteral("melting ") : QStringLiteral("boiling ")) + formatShort(span / 1000) +
                    QStringLiteral(" kJ/kg"),
                Theme::font(TextRole::Small), theme[Token::Curve]);
    }
    if (m_now.phases[phase] == 0) continue;
    if (melting) {  // how far each has melted is not in what is published: the whole piece stands for them
      painter.setPen(QPen(theme.series(1), 5, Qt::SolidLine, Qt::RoundCap));
      painter.drawLine(line[static_cast<int>(k)], line[static_cast<int>(k) + 1]);
      continue;
    }
    const double length = m_corners[k + 1].temperature - m_corners[k].temperature;
    const double share = boiling ? m_now.boiled : (m_now.phaseMean[phase] - m_corners[k].temperature) / length;
    const double kelvin = m_corners[k].temperature + share * length;
    paintDot(painter, at((m_corners[k].enthalpy + share * span) / 1000, celsius(kelvin)), phase);
  }
}

void MatterDiagram::paintPhases(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const PhaseLines lines = phaseLines(m_diagram, std::pow(10.0, m_y.first), std::pow(10.0, m_y.last));
  const auto placeOf = [this](const PhasePoint& point) {
    return at(celsius(point.temperature), std::log10(point.pressure));
  };
  for (const auto& [line, name] :
       {std::pair(&lines.melting, QStringLiteral("melting")), std::pair(&lines.boiling, QStringLiteral("boiling")),
        std::pair(&lines.sublimation, QStringLiteral("sublimation"))}) {
    if (line->size() < 2) continue;
    QPolygonF points;
    for (const PhasePoint& point : *line) points << placeOf(point);
    painter.setPen(QPen(theme[Token::Curve], 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawPolyline(points);
    paintText(painter, QRectF(points[points.size() / 2] + QPointF(8, 2), QSizeF(90, 16)),
              Qt::AlignLeft | Qt::AlignVCenter, name, Theme::font(TextRole::Small), theme[Token::Curve]);
  }
  painter.setBrush(theme[Token::Curve]);
  for (const auto& point : {lines.triple, lines.critical}) {
    if (point) painter.drawEllipse(placeOf(*point), 2, 2);
  }
  const double here = std::log10(std::max(m_pressure, 1.0)), y = at(m_x.first, here).y();
  painter.setPen(QPen(theme[Token::Muted], 1, Qt::DashLine));
  painter.drawLine(QPointF(plot().left(), y), QPointF(plot().right(), y));
  for (size_t k = 0; k < m_now.phases.size(); ++k) {
    if (m_now.phases[k] > 0) paintDot(painter, at(celsius(m_now.phaseMean[k]), here), k);
  }
}

}  // namespace ps
