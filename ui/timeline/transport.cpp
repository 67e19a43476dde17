// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/transport.h"

#include "ui/document/document.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/icon.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/timeline/runlines.h"

#include <QtCore/QEvent>
#include <QtGui/QActionGroup>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kGap = 3;                              ///< between the bar and the lines of earlier runs
constexpr int kHandRow = 30, kHandLeastButton = 40;  ///< logical pixels

QToolButton* toolButton(const QString& iconName, const QString& tip) {
  auto* button = new QToolButton;
  button->setIcon(icon(iconName));
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setFocusPolicy(Qt::TabFocus);
  return button;
}

}  // namespace

/// Logical pixels.
struct Transport::Sizes {
  int height;
  int bar, reach;          ///< of the bar, and of what is taken as it
  int left, right, below;  ///< beside the buttons, and from them to the bar
  int mark;                ///< width of what says which frame is shown
};

/// On the board in a headset a row is 26 pixels high at least, and the bar is one.
const Transport::Sizes& Transport::sizesOf(PointedBy by) {
  static constexpr Sizes kMouse{40, 4, 10, 8, 12, 4, 2}, kHand{4 + 3 * kHandRow + 8 + 28, 20, 28, 8, 8, 28, 4};
  return by == PointedBy::Mouse ? kMouse : kHand;
}

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

Transport::Transport(Session& session, PointedBy by, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_sizes(sizesOf(by)),
      m_reset(toolButton(QStringLiteral("reset-to-start"), QStringLiteral("Back to the start (Home)"))),
      m_step(toolButton(QStringLiteral("step"), QStringLiteral("One frame (→)"))),
      m_back(toolButton(QStringLiteral("step-back"), QStringLiteral("One recorded frame back (←)"))),
      m_loop(toolButton(QStringLiteral("loop"), QStringLiteral("Loop: play what is recorded, again and again"))),
      m_speed(new QToolButton),
      m_play(new QPushButton),
      m_continue(new QPushButton(QStringLiteral("Continue from here"))),
      m_time(new QLabel),
      m_duration(new QLabel),
      m_thermal(new ThermalClock),
      m_runs(new RunLines(session, this)) {
  setFixedHeight(m_sizes.height);
  m_play->setObjectName(QStringLiteral("psPlay"));
  m_play->setProperty("primary", true);
  m_play->setFocusPolicy(Qt::TabFocus);
  m_time->setFont(Theme::font(TextRole::Time));
  m_duration->setProperty("role", "muted");
  layOut(by);
  m_continue->setFocusPolicy(Qt::TabFocus);
  m_continue->setToolTip(
      QStringLiteral("The run goes on from the frame that is shown.\nAs it was, it is kept: a line above the bar."));
  m_continue->hide();
  setMouseTracking(true);
  setAccessibleName(QStringLiteral("Transport"));
  m_loop->setCheckable(true);
  makeSpeeds();
  connectParts();
  styleButtons();
  setReady(session.isReady());
  setStateTime(session.document().project().state ? session.document().project().state->time : 0);
  setDuration(session.document().project().duration);
  showTimeScale();
  setPlaying(session.playing());
  showRecorded();
}

/// In one row; for hands in three, of which the first has the buttons.
void Transport::layOut(PointedBy by) {
  const std::initializer_list<QWidget*> buttons{m_reset, m_back, m_play, m_step, m_loop, m_speed};
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  for (QWidget* widget : buttons) row->addWidget(widget);
  if (by == PointedBy::Mouse) {
    setLayout(row);
    m_play->setFixedWidth(34);
    row->addSpacing(10);
    row->addWidget(m_time);
    row->addWidget(m_duration);
    row->addSpacing(12);
    row->addWidget(m_continue);
    row->addSpacing(6);
    row->addWidget(m_thermal, 1);
  } else {
    auto* rows = new QVBoxLayout(this);
    rows->setSpacing(4);
    for (QWidget* widget : buttons) {
      widget->setFixedHeight(kHandRow);
      widget->setMinimumWidth(kHandLeastButton);
      widget->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    }
    m_thermal->setMinimumHeight(kHandRow);
    m_continue->setFixedHeight(kHandRow);
    auto *clocks = new QHBoxLayout, *rest = new QHBoxLayout;
    clocks->addWidget(m_time);
    clocks->addWidget(m_duration, 1);
    rest->addWidget(m_thermal, 1);
    rest->addWidget(m_continue);
    for (QHBoxLayout* line : {row, clocks, rest}) rows->addLayout(line, 1);
  }
  layout()->setContentsMargins(m_sizes.left, 0, m_sizes.right, m_sizes.below);
}

void Transport::connectParts() {
  connect(m_continue, &QPushButton::clicked, &m_session.recorded(), &RecordedView::continueFromHere);
  connect(&m_session.recorded(), &RecordedView::changed, this, &Transport::showRecorded);
  connect(&m_session.recorded(), &RecordedView::runsChanged, this, &Transport::refresh);
  connect(&m_session.recorded(), &RecordedView::paceChanged, this, &Transport::showPace);
  connect(m_loop, &QToolButton::toggled, &m_session.recorded(), &RecordedView::setLoop);
  connect(m_back, &QToolButton::clicked, &m_session.recorded(), [this] { m_session.recorded().step(-1); });
  connect(m_reset, &QToolButton::clicked, &m_session, &Session::reset);
  connect(m_step, &QToolButton::clicked, &m_session, &Session::step);
  connect(m_play, &QPushButton::clicked, &m_session, &Session::playPause);
  connect(&m_session, &Session::ready, this, [this] { setReady(true); });
  connect(&m_session, &Session::playingChanged, this, [this] { setPlaying(m_session.playing()); });
  connect(&m_session, &Session::valuesDue, this, [this] {
    setSnapshot(m_session.snapshot());
    if (!m_session.document().project().tracks.empty()) showTimeScale();
    if (m_session.playing() != m_playing) setPlaying(m_session.playing());
  });
  connect(&m_session.document(), &Document::changed, this, &Transport::onChanged);
}

void Transport::makeSpeeds() {
  m_speed->setFocusPolicy(Qt::TabFocus);
  m_speed->setPopupMode(QToolButton::InstantPopup);
  m_speed->setToolTip(QStringLiteral("Simulated seconds per second"));
  auto* menu = new QMenu(m_speed);
  auto* choice = new QActionGroup(menu);
  for (const double speed : {0.1, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    QAction* action = menu->addAction(formatShort(speed) + QStringLiteral("×"));
    action->setCheckable(true);
    choice->addAction(action);
    action->setData(speed);
    connect(action, &QAction::triggered, this, [this, speed] { m_session.setSpeed(speed); });
  }
  m_speed->setMenu(menu);
  m_speed->setMinimumWidth(48);
  showPace();
}

/// There may be several of these.
void Transport::showPace() {
  const RecordedView& recorded = m_session.recorded();
  m_loop->setChecked(recorded.loops());
  for (QAction* action : m_speed->menu()->actions())
    if (action->data().toDouble() == recorded.speed()) action->setChecked(true);
  m_speed->setText(formatShort(recorded.speed()) + QStringLiteral("×"));
  m_speed->setAccessibleName(QStringLiteral("Speed ") + m_speed->text());
}

void Transport::onChanged(const ChangeEvent& event) {
  const bool opened = std::holds_alternative<ProjectOpened>(event);
  const Project& project = m_session.document().project();
  if (opened || std::holds_alternative<AboutChanged>(event)) setDuration(project.duration);
  if (opened) setSnapshot(nullptr);
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
  for (QWidget* button : std::initializer_list<QWidget*>{m_reset, m_back, m_play, m_step, m_loop, m_speed})
    button->setEnabled(ready);
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
  if (m_session.recorded().isActive()) {
    const SnapshotPtr newest = m_session.newest();
    return QStringLiteral("Recorded, up to %1").arg(clockText(newest ? newest->stats.time : 0));
  }
  const bool end = !m_playing && m_seconds > m_total - 0.02;
  const RunRecord::Extent kept = m_session.recorded().extent();
  const bool waiting = !m_playing && kept.to <= kept.from;
  QString total = clockText(m_total);
  if (total.endsWith(QStringLiteral(".00"))) total.chop(3);
  return QStringLiteral("/ ") + total +
         (end       ? QStringLiteral("  The end: Space goes on, Home begins anew")
          : waiting ? QStringLiteral("  Press Space to run")
                    : QString());
}

ThermalTexts Transport::thermalTexts() const {
  if (m_scale == 1) return {};
  return {QStringLiteral("Heat ×%1 = ").arg(formatShort(m_scale)), spanText(m_thermalSeconds),
          QStringLiteral(" of real heating")};
}

void Transport::showRecorded() {
  m_continue->setVisible(m_session.recorded().isActive());
  setSnapshot(m_session.snapshot());
}

double Transport::span() const { return timeAxisEnd(m_session, m_total); }
double Transport::perSecond() const { return std::max(1, width() - m_axis.left - m_axis.right) / span(); }

QPoint Transport::placeOf(double seconds) const {
  return {static_cast<int>(std::lround(m_axis.left + perSecond() * seconds)), height() - m_sizes.bar / 2};
}

void Transport::setAxis(TimeAxis axis) {
  m_axis = axis;
  placeRuns();
  update();
}

void Transport::scrub(double x) {
  m_session.recorded().showAt(std::clamp((x - m_axis.left) / perSecond(), 0.0, span()));
}

void Transport::mousePressEvent(QMouseEvent* event) {
  m_scrubs = event->button() == Qt::LeftButton && event->position().y() >= height() - m_sizes.reach &&
             m_session.recorded().extent().frames > 0;
  if (m_scrubs)
    scrub(event->position().x());
  else
    event->ignore();
}

void Transport::mouseMoveEvent(QMouseEvent* event) {
  const bool bar = m_scrubs || event->position().y() >= height() - m_sizes.reach;
  setCursor(bar && m_session.recorded().extent().frames > 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
  if (m_scrubs) scrub(event->position().x());
}

void Transport::mouseReleaseEvent(QMouseEvent*) { m_scrubs = false; }

void Transport::fillMenu(QMenu& menu) {
  RecordedView& recorded = m_session.recorded();
  if (recorded.isActive()) {
    connect(menu.addAction(QStringLiteral("Continue from here")), &QAction::triggered, &recorded,
            &RecordedView::continueFromHere);
    connect(menu.addAction(QStringLiteral("Newest state")), &QAction::triggered, &recorded, &RecordedView::showNewest);
  }
  m_runs->addMenus(menu, false);
}

void Transport::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  fillMenu(menu);
  if (!menu.isEmpty()) menu.exec(event->globalPos());
}

void Transport::makeRoom() {
  m_runs->setSpan(span());
  const int lines = m_runs->wantedHeight();
  if (m_sizes.height + lines == minimumHeight()) return;
  setFixedHeight(m_sizes.height + lines);
  layout()->setContentsMargins(m_sizes.left, 0, m_sizes.right, m_sizes.below + lines);
  m_runs->setVisible(lines > 0);
  Q_EMIT heightChanged();
}

void Transport::resizeEvent(QResizeEvent*) { placeRuns(); }

void Transport::placeRuns() {
  const int lines = m_runs->wantedHeight();
  m_runs->setGeometry(m_axis.left, height() - m_sizes.bar - kGap - lines, width() - m_axis.left - m_axis.right, lines);
}

void Transport::refresh() {
  makeRoom();
  m_time->setText(timeText());
  m_duration->setText(durationText());
  m_thermal->setTexts(thermalTexts());
  update(0, height() - m_sizes.reach, width(), m_sizes.reach);
}

void Transport::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  const RunRecord::Extent kept = m_session.recorded().extent();
  const double top = height() - m_sizes.bar, scale = perSecond();
  const auto xOf = [&](double seconds) { return m_axis.left + scale * seconds; };
  painter.fillRect(QRectF(m_axis.left, top, scale * span(), m_sizes.bar), theme[Token::Field]);
  if (kept.frames > 0)
    painter.fillRect(QRectF(xOf(kept.from), top, (kept.to - kept.from) * scale, m_sizes.bar), theme[Token::SliderFill]);
  const auto mark = [&](double seconds, double rise, Token token) {
    const double width = m_sizes.mark;
    painter.fillRect(QRectF(std::floor(xOf(seconds)) - width / 2, top - rise, width, m_sizes.bar + rise), theme[token]);
  };
  if (m_stateSeconds > 0 && m_stateSeconds <= m_total) mark(m_stateSeconds, 1, Token::Text2);  // where it opens
  if (m_session.recorded().isActive()) mark(m_seconds, 4, Token::Accent);
}

void Transport::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) styleButtons();
}

}  // namespace ps
