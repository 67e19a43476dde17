// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/transport.h"

#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kHeight = 40;

QToolButton* toolButton(const QString& iconName, const QString& tip) {
  auto* button = new QToolButton;
  button->setIcon(icon(iconName));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setFocusPolicy(Qt::TabFocus);
  return button;
}

}  // namespace

/// The clock of accelerated heat. It takes the room that is left and lays nothing else out anew as its digits change;
/// where the room is short, the words around the span of time go first.
class ThermalClock : public QWidget {
 public:
  ThermalClock() { setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred); }
  void setTexts(const ThermalTexts& texts) {
    m_texts = texts;
    setAccessibleName(texts.whole());
    update();
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    if (m_texts.span.isEmpty()) return;
    QPainter painter(this);
    const Theme& theme = Theme::current();
    paintIcon(painter, QRectF(0, (height() - kIcon) / 2.0, kIcon, kIcon), QStringLiteral("clock"), theme[Token::Muted]);
    const ThermalTexts shown = m_texts.fitting(width() - kIcon - kGap);
    double x = kIcon + kGap;
    const auto write = [&](const QString& text, TextRole role, Token token) {
      const double w = textWidth(text, Theme::font(role));
      paintText(painter, QRectF(x, 0, w + 1, height()), Qt::AlignLeft | Qt::AlignVCenter, text, Theme::font(role),
                theme[token]);
      x += w;
    };
    write(shown.before, TextRole::Normal, Token::Text2);
    write(shown.span, TextRole::Medium, Token::Text);
    write(shown.after, TextRole::Normal, Token::Text2);
  }

 private:
  static constexpr int kIcon = 16, kGap = 4;
  ThermalTexts m_texts;
};

double ThermalTexts::width() const {
  return textWidth(before, Theme::font(TextRole::Normal)) + textWidth(span, Theme::font(TextRole::Medium)) +
         textWidth(after, Theme::font(TextRole::Normal));
}

ThermalTexts ThermalTexts::fitting(double room) const {
  ThermalTexts shown = *this;
  if (shown.width() > room) shown.after.clear();
  if (shown.width() > room) shown.before.clear();
  return shown;
}

Transport::Transport(Session& session, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_reset(toolButton(QStringLiteral("reset-to-start"), QStringLiteral("Back to the start (Home)"))),
      m_step(toolButton(QStringLiteral("step"), QStringLiteral("One frame (→)"))),
      m_play(new QPushButton),
      m_time(new QLabel),
      m_duration(new QLabel),
      m_thermal(new ThermalClock) {
  setFixedHeight(kHeight);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(8, 0, 12, 4);
  row->setSpacing(4);
  m_play->setObjectName(QStringLiteral("psPlay"));
  m_play->setProperty("primary", true);
  m_play->setFixedWidth(34);
  m_play->setFocusPolicy(Qt::TabFocus);
  m_time->setFont(Theme::font(TextRole::Time));
  m_duration->setProperty("role", "muted");
  row->addWidget(m_reset);
  row->addWidget(m_play);
  row->addWidget(m_step);
  row->addSpacing(14);
  row->addWidget(m_time);
  row->addWidget(m_duration);
  row->addSpacing(18);
  row->addWidget(m_thermal, 1);
  connect(m_reset, &QToolButton::clicked, &session, &Session::reset);
  connect(m_step, &QToolButton::clicked, &session, &Session::step);
  connect(m_play, &QPushButton::clicked, &session, &Session::playPause);
  connect(&session, &Session::ready, this, [this] { setReady(true); });
  connect(&session, &Session::playingChanged, this, [this] { setPlaying(m_session.playing()); });
  connect(&session, &Session::valuesDue, this, [this] {
    setSnapshot(m_session.snapshot());
    if (!m_session.document().project().tracks.empty()) showTimeScale();
    if (m_session.playing() != m_playing) setPlaying(m_session.playing());
  });
  connect(&session.document(), &Document::changed, this, &Transport::onChanged);
  styleButtons();
  setPlaying(false);
  setReady(false);
  refresh();
}

void Transport::onChanged(const ChangeEvent& event) {
  const bool opened = std::holds_alternative<ProjectOpened>(event);
  const Project& project = m_session.document().project();
  if (opened) {
    setDuration(project.duration);
    setSnapshot(nullptr);
  }
  if (opened || std::holds_alternative<StateChanged>(event)) setStateTime(project.state ? project.state->time : 0);
  if (opened || std::holds_alternative<ParameterChanged>(event) || std::holds_alternative<TracksChanged>(event))
    showTimeScale();
}

void Transport::showTimeScale() {
  setTimeScale(std::get<double>(m_session.valueNow({Owner::Solver, "", "thermal_time_scale"})));
}

void Transport::styleButtons() {
  const Theme& theme = Theme::current();
  m_play->setIcon(QIcon(iconPixmap(m_playing ? QStringLiteral("pause") : QStringLiteral("play"), theme[Token::OnAccent],
                                   16, devicePixelRatioF())));
}

void Transport::setPlaying(bool playing) {
  m_playing = playing;
  const QString tip = playing ? QStringLiteral("Pause (Space)") : QStringLiteral("Play (Space)");
  m_play->setToolTip(tip);
  m_play->setAccessibleName(tip);
  styleButtons();
  refresh();
}

void Transport::setReady(bool ready) {
  for (QWidget* button :
       {static_cast<QWidget*>(m_reset), static_cast<QWidget*>(m_step), static_cast<QWidget*>(m_play)}) {
    button->setEnabled(ready);
  }
}

void Transport::setDuration(double seconds) {
  m_total = seconds;
  refresh();
}

void Transport::setStateTime(double seconds) {
  m_stateSeconds = seconds;
  const QString tip =
      QStringLiteral("Back to the start (Home)") +
      (seconds > 0 ? QStringLiteral("\nThe project opens at its saved state, %1 (Shift+Home)").arg(clockText(seconds))
                   : QString());
  m_reset->setToolTip(tip);
  refresh();
}

void Transport::setTimeScale(double scale) {
  m_scale = scale;
  refresh();
}

void Transport::setSnapshot(const SnapshotPtr& snapshot) {
  m_seconds = snapshot ? snapshot->stats.time : 0;
  m_thermalSeconds = snapshot ? snapshot->stats.thermalTime : 0;
  refresh();
}

QString Transport::timeText() const { return clockText(m_seconds); }

QString Transport::durationText() const {
  const bool end = !m_playing && m_seconds > m_total - 0.02;
  return QStringLiteral("/ ") + clockText(m_total).left(5) +
         (end ? QStringLiteral("  The end: Space goes on, Home begins anew") : QString());
}

ThermalTexts Transport::thermalTexts() const {
  if (m_scale == 1) return {};
  return {QStringLiteral("Heat ×%1 = ").arg(formatShort(m_scale)), spanText(m_thermalSeconds),
          QStringLiteral(" of real heating")};
}

void Transport::refresh() {
  m_time->setText(timeText());
  m_duration->setText(durationText());
  m_thermal->setTexts(thermalTexts());
  update(0, height() - 5, width(), 5);
}

void Transport::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  const double share = m_total > 0 ? std::clamp(m_seconds / m_total, 0.0, 1.0) : 0;
  painter.fillRect(QRectF(0, height() - 4, width(), 4), theme[Token::Field]);
  painter.fillRect(QRectF(0, height() - 4, width() * share, 4), theme[Token::SliderFill]);
  if (m_stateSeconds > 0 && m_stateSeconds <= m_total) {  // where the project opens
    painter.fillRect(QRectF(std::floor(width() * m_stateSeconds / m_total) - 1, height() - 5, 2, 5),
                     theme[Token::Text2]);
  }
}

void Transport::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) styleButtons();
}

}  // namespace ps
