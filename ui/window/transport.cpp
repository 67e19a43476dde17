// SPDX-License-Identifier: Apache-2.0
#include "ui/window/transport.h"

#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/window/wording.h"

#include <QtCore/QEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

#include <algorithm>

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

Transport::Transport(QWidget* parent)
    : QWidget(parent),
      m_reset(toolButton(QStringLiteral("reset-to-start"), QStringLiteral("Back to the start (Home)"))),
      m_step(toolButton(QStringLiteral("step"), QStringLiteral("One frame (→)"))),
      m_play(new QPushButton),
      m_time(new QLabel),
      m_duration(new QLabel),
      m_thermal(new QLabel),
      m_thermalIcon(new QLabel) {
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
  m_thermal->setProperty("role", "text2");
  row->addWidget(m_reset);
  row->addWidget(m_play);
  row->addWidget(m_step);
  row->addSpacing(14);
  row->addWidget(m_time);
  row->addWidget(m_duration);
  row->addSpacing(18);
  row->addWidget(m_thermalIcon);
  row->addWidget(m_thermal);
  row->addStretch(1);
  connect(m_reset, &QToolButton::clicked, this, &Transport::resetRequested);
  connect(m_step, &QToolButton::clicked, this, &Transport::stepRequested);
  connect(m_play, &QPushButton::clicked, this, &Transport::playRequested);
  styleButtons();
  setPlaying(false);
  setReady(false);
  refresh();
}

void Transport::styleButtons() {
  const Theme& theme = Theme::current();
  m_play->setIcon(QIcon(iconPixmap(m_playing ? QStringLiteral("pause") : QStringLiteral("play"), theme[Token::OnAccent],
                                   16, devicePixelRatioF())));
  m_thermalIcon->setPixmap(iconPixmap(QStringLiteral("clock"), theme[Token::Muted], 16, devicePixelRatioF()));
}

void Transport::setPlaying(bool playing) {
  m_playing = playing;
  const QString tip = playing ? QStringLiteral("Pause (Space)") : QStringLiteral("Play (Space)");
  m_play->setToolTip(tip);
  m_play->setAccessibleName(tip);
  styleButtons();
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

QString Transport::thermalText() const {
  if (m_scale == 1) return {};
  return QStringLiteral("Heat ×%1 = <span style='font-weight:500; color:%3'>%2</span> of real heating")
      .arg(formatShort(m_scale), spanText(m_thermalSeconds), Theme::current()[Token::Text].name());
}

void Transport::refresh() {
  m_time->setText(timeText());
  m_duration->setText(QStringLiteral("/ ") + clockText(m_total).left(5));
  m_thermal->setText(thermalText());
  m_thermal->setVisible(m_scale != 1);
  m_thermalIcon->setVisible(m_scale != 1);
  update(0, height() - 5, width(), 5);
}

void Transport::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  const double share = m_total > 0 ? std::clamp(m_seconds / m_total, 0.0, 1.0) : 0;
  painter.fillRect(QRectF(0, height() - 4, width(), 4), theme[Token::Field]);
  painter.fillRect(QRectF(0, height() - 4, width() * share, 4), theme[Token::SliderFill]);
}

void Transport::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) styleButtons();
}

}  // namespace ps
