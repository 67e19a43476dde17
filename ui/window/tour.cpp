// SPDX-License-Identifier: Apache-2.0
#include "ui/window/tour.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QHBoxLayout>
#include <QtWidgets/QLabel>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QVBoxLayout>

#include <algorithm>

namespace ps {
namespace {

constexpr int kWidth = 300, kGap = 12;
constexpr int kDown = 9 * kGap;  // from the upper edge of the view, whose axes stand there
constexpr int kUp = 5 * kGap;    // from its lower edge, where hints stand

class TourCard : public QWidget {
 public:
  using QWidget::QWidget;

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const Theme& theme = Theme::current();
    painter.fillRect(rect(), theme[Token::Window]);
    paintBox(painter, QRectF(rect()), theme[Token::Panel], theme[Token::Accent], 7);
  }
};

}  // namespace

Tour::Tour(QWidget& window)
    : QWidget(&window),
      m_card(new TourCard(&window)),
      m_title(new QLabel),
      m_text(new QLabel),
      m_count(new QLabel),
      m_next(new QPushButton),
      m_skip(new QPushButton(QStringLiteral("Skip the tour"))) {
  setObjectName(QStringLiteral("psTour"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  m_card->setObjectName(QStringLiteral("psTourCard"));
  m_card->setFixedWidth(kWidth);
  auto* column = new QVBoxLayout(m_card);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(6);
  m_title->setFont(Theme::font(TextRole::Heading));
  m_text->setWordWrap(true);
  m_count->setProperty("role", "muted");
  m_next->setProperty("primary", true);
  m_skip->setProperty("flat", true);
  auto* row = new QHBoxLayout;
  row->addWidget(m_count);
  row->addStretch(1);
  row->addWidget(m_skip);
  row->addWidget(m_next);
  column->addWidget(m_title);
  column->addWidget(m_text);
  column->addLayout(row);
  connect(m_next, &QPushButton::clicked, this, &Tour::next);
  connect(m_skip, &QPushButton::clicked, this, &Tour::end);
  // A button of a window that is no dialog does nothing at Return by itself.
  for (QPushButton* button : {m_next, m_skip}) button->setAutoDefault(true);
  window.installEventFilter(this);
  m_laidOut.setSingleShot(true);
  connect(&m_laidOut, &QTimer::timeout, this, [this] {
    if (!running()) return;
    place();
    update();
  });
  hide();
  m_card->hide();
}

void Tour::start(std::vector<TourStep> steps) {
  m_steps = std::move(steps);
  m_step = 0;
  showStep();
}

void Tour::next() {
  ++m_step;
  if (m_step >= static_cast<int>(m_steps.size())) return end();
  showStep();
}

void Tour::end() {
  if (!running()) return;
  m_steps.clear();
  hide();
  m_card->hide();
  Q_EMIT ended();
}

void Tour::showStep() {
  const TourStep& step = m_steps[static_cast<size_t>(m_step)];
  const int count = static_cast<int>(m_steps.size());
  m_title->setText(step.title);
  m_text->setText(step.text);
  m_count->setText(QStringLiteral("%1 of %2").arg(m_step + 1).arg(count));
  m_next->setText(m_step + 1 < count ? QStringLiteral("Next") : QStringLiteral("Done"));
  m_skip->setVisible(m_step + 1 < count);
  m_card->setAccessibleName(step.title + QStringLiteral(". ") + step.text);
  follow();
  place();
  for (QWidget* part : {static_cast<QWidget*>(this), m_card}) {
    part->show();
    part->raise();
  }
  update();
}

void Tour::follow() {
  for (QWidget* first : {m_steps.front().at.data(), m_steps[static_cast<size_t>(m_step)].at.data()}) {
    for (QWidget* part = first; part && part != parentWidget(); part = part->parentWidget())
      part->installEventFilter(this);
  }
}

QRect Tour::target(size_t step) const {
  const QWidget* at = m_steps[step].at;
  return at && at->isVisible() ? QRect(at->mapTo(parentWidget(), QPoint()), at->size()) : parentWidget()->rect();
}

QRect Tour::target() const { return target(static_cast<size_t>(m_step)); }

/// At the right edge of what the first step speaks of, whichever it is: an eye that reads on need not look for the
/// card. Where it would cover there what another one speaks of: beside that.
void Tour::place() {
  setGeometry(parentWidget()->rect());
  m_card->setFixedHeight(m_card->layout()->heightForWidth(kWidth));
  const QRect of = target(), first = target(0), all = rect().adjusted(kGap, kGap, -kGap, -kGap);
  const QSize size = m_card->size();
  const QPoint home(first.right() - kGap - size.width() + 1,
                    std::max(first.top() + kGap, std::min(first.top() + kDown, first.bottom() - kUp - size.height())));
  const QPoint places[] = {home,
                           {of.left() - size.width() - kGap, of.top() + kGap},
                           {of.right() + kGap, of.top() + kGap},
                           {of.left() + kGap, of.bottom() + kGap},
                           {of.left() + kGap, of.top() - size.height() - kGap}};
  const auto* fits = std::find_if(std::begin(places), std::end(places), [&](const QPoint& corner) {
    return all.contains(QRect(corner, size)) && (m_step == 0 || !of.intersects(QRect(corner, size)));
  });
  m_card->move(fits != std::end(places) ? *fits : of.topLeft() + QPoint(2 * kGap, 5 * kGap));
}

bool Tour::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  const bool moves = type == QEvent::Resize || type == QEvent::Move || type == QEvent::Show || type == QEvent::Hide;
  if (moves && running()) m_laidOut.start(0);
  return QWidget::eventFilter(watched, event);
}

void Tour::paintEvent(QPaintEvent*) {
  if (!running()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  paintFocusRing(painter, QRectF(target()), 5);
}

}  // namespace ps
