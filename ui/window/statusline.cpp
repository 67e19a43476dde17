// SPDX-License-Identifier: Apache-2.0
#include "ui/window/statusline.h"

#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {
constexpr int kHeight = 24;
constexpr double kSmooth = 0.08;  // share of a new frame in the shown mean, so that digits can be read
}  // namespace

StatusLine::StatusLine(QWidget* parent) : QWidget(parent) {
  setFixedHeight(kHeight);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(QStringLiteral("Status"));
}

void StatusLine::setState(const State& state) {
  m_state = state;
  if (state.snapshot) {
    const FrameStats& stats = state.snapshot->stats;
    const bool fresh = state.snapshot->revision != m_revision || m_milliseconds == 0;
    if (state.snapshot->revision != m_revision) {
      m_revision = state.snapshot->revision;
      m_started = false;
    }
    // Matter drawn before the first step belongs to the start.
    if (!m_started) m_startEnergy = stats.thermalEnergy - stats.heat.net();
    m_started = stats.frame > 0;
    const double share = fresh ? 1 : kSmooth;
    m_milliseconds += share * (stats.totalMilliseconds - m_milliseconds);
    for (size_t i = 0; i < m_stages.size(); ++i) m_stages[i] += share * (stats.milliseconds[i] - m_stages[i]);
  }
  setAccessibleDescription(parts().join(QStringLiteral(", ")));
  update();
}

double StatusLine::drift() const {
  if (!m_state.snapshot) return 0;
  const FrameStats& stats = m_state.snapshot->stats;
  const double exchanged = std::max(stats.heat.exchanged, 1e-9);
  return stats.heat.exchanged <= 0 ? 0 : (stats.thermalEnergy - m_startEnergy - stats.heat.net()) / exchanged;
}

std::vector<StatusLine::Part> StatusLine::leftParts() const {
  std::vector<Part> parts;
  if (!m_state.ready) return {{QStringLiteral("Loading plugins"), {}}};
  const QString state = m_state.failed    ? QStringLiteral("Paused, see above")
                        : m_state.playing ? QStringLiteral("Running")
                                          : QStringLiteral("Paused");
  parts.push_back({state, {}});
  if (!m_state.snapshot) return parts;
  const FrameStats& stats = m_state.snapshot->stats;
  parts.push_back({formatFixed(static_cast<double>(m_state.snapshot->id.size())),
                   m_state.snapshot->id.size() == 1 ? QStringLiteral("particle") : QStringLiteral("particles")});
  const auto slowest = std::max_element(m_stages.begin(), m_stages.end());
  QString detail = QStringLiteral("/frame");
  if (*slowest > 0) {
    detail += QStringLiteral(" · %1 %2")
                  .arg(QString::fromLatin1(stageName(static_cast<Stage>(slowest - m_stages.begin()))),
                       formatFixed(*slowest, 1));
  }
  if (m_state.drawMilliseconds > 0)
    detail += QStringLiteral(" · draw %1").arg(formatFixed(m_state.drawMilliseconds, 1));
  parts.push_back({formatFixed(m_milliseconds, 1) + QStringLiteral(" ms"), detail});
  parts.push_back({formatFixed(m_state.realTime, 2) + QStringLiteral("×"), QStringLiteral("real time")});
  if (!m_state.graphics.isEmpty()) parts.push_back({{}, m_state.graphics});
  parts.push_back(
      {formatFixed(stats.densityErrorMean * 100, 1) + QStringLiteral(" %"), QStringLiteral("density error")});
  parts.push_back({formatError(drift()), QStringLiteral("energy drift")});
  return parts;
}

QStringList StatusLine::parts() const {
  QStringList list;
  for (const Part& part : leftParts()) list << (part.strong + QLatin1Char(' ') + part.weak).trimmed();
  if (!m_state.note.isEmpty()) list << m_state.note;
  if (!m_state.file.isEmpty()) list << m_state.file;
  return list;
}

void StatusLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& theme = Theme::current();
  const QFont font = Theme::font(TextRole::Small);
  painter.fillRect(rect(), theme[Token::Window]);
  double right = width() - 12;
  const auto fromRight = [&](const QString& text, Token token) {
    const double w = textWidth(text, font) + 1;
    right -= w;
    paintText(painter, QRectF(right, 0, w + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, text, font, theme[token]);
  };
  if (!m_state.file.isEmpty()) {
    fromRight(m_state.file, Token::Text2);
    right -= 12;
  }
  m_noteRect = {};
  if (!m_state.note.isEmpty()) {
    const double edge = right;
    fromRight(m_state.note, Token::Warning);
    right -= 20;
    paintIcon(painter, QRectF(right, 5, 14, 14), QStringLiteral("warning"), theme[Token::Warning]);
    m_noteRect = QRectF(right, 0, edge - right, height());
    right -= 12;
  }
  const Token dot = m_state.failed ? Token::Error : m_state.playing ? Token::Ok : Token::Warning;
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme[m_state.ready ? dot : Token::Muted]);
  painter.drawEllipse(QPointF(16, height() / 2.0), 4, 4);
  double x = 26;
  bool first = true;
  for (const Part& part : leftParts()) {
    const double strong = part.strong.isEmpty() ? 0 : textWidth(part.strong, font) + 4;
    const double w = strong + textWidth(part.weak, font) + 2;
    if (x + w + 12 > right) break;  // no half words: what does not fit is left out
    if (!first) paintVerticalLine(painter, x - 8, 6, height() - 6, theme[Token::Line2]);
    first = false;
    paintText(painter, QRectF(x, 0, strong + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, part.strong, font,
              theme[Token::Text]);
    paintText(painter, QRectF(x + strong, 0, w - strong + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, part.weak,
              font, theme[Token::Text2]);
    x += w + 16;
  }
}

void StatusLine::mouseReleaseEvent(QMouseEvent* event) {
  if (m_noteRect.contains(event->position())) Q_EMIT noteClicked();
}

}  // namespace ps
