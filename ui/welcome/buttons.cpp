// SPDX-License-Identifier: Apache-2.0
#include "ui/welcome/buttons.h"

#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtCore/QDir>
#include <QtCore/QEvent>
#include <QtCore/QFileInfo>
#include <QtGui/QAction>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtGui/QTextLayout>

#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr int kInset = 12;                   // px left and right of words
constexpr double kRadius = 7, kShape = 0.8;  // of a picture: height over width
constexpr int kWords = 38, kLine = 16;       // px below it: the title with what is around it, a line of its summary
constexpr int kTryGap = 4, kTryLine = 14, kTryLines = 4;  // px above what to try and of a line of it; how many at most

/// Fills the rectangle with the middle of the picture; `scaled` keeps it for the next time.
void paintPicture(QPainter& painter, const QRectF& rect, const QImage& picture, QPixmap& scaled) {
  const double ratio = painter.device()->devicePixelRatioF();
  const QSize size(static_cast<int>(std::ceil(rect.width() * ratio)),
                   static_cast<int>(std::ceil(rect.height() * ratio)));
  if (scaled.size() != size) {
    const QImage filled = picture.scaled(size, Qt::KeepAspectRatioByExpanding, Qt::SmoothTransformation);
    const QPoint corner((filled.width() - size.width()) / 2, (filled.height() - size.height()) / 2);
    scaled = QPixmap::fromImage(filled.copy(QRect(corner, size)));
  }
  painter.drawPixmap(rect, scaled, QRectF(scaled.rect()));
}

QString tryText(const QString& toTry) { return toTry.isEmpty() ? QString() : QStringLiteral("Try it: ") + toTry; }

/// The text in lines of this width, no more than `most`: the last one is elided where there is more.
QStringList wrapped(const QString& text, const QFont& font, double width, int most) {
  QStringList lines;
  if (text.isEmpty()) return lines;
  QTextLayout layout(text, font);
  QTextOption wraps;
  wraps.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
  layout.setTextOption(wraps);
  layout.beginLayout();
  for (QTextLine line = layout.createLine(); line.isValid() && lines.size() < most; line = layout.createLine()) {
    line.setLineWidth(width);
    const bool last = lines.size() + 1 == most;
    lines << (last ? QFontMetricsF(font).elidedText(text.mid(line.textStart()), Qt::ElideRight, width)
                   : text.mid(line.textStart(), line.textLength()).trimmed());
  }
  layout.endLayout();
  return lines;
}

/// Its file, from the user's own folder on where it is in there.
QString placeText(const QString& path) {
  const QString home = QDir::homePath() + QLatin1Char('/');
  return path.startsWith(home) ? QStringLiteral("~/") + path.mid(home.size()) : path;
}

}  // namespace

PageButton::PageButton(QWidget* parent) : QAbstractButton(parent) {
  setAttribute(Qt::WA_Hover);
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::PointingHandCursor);
}

bool PageButton::event(QEvent* event) {
  if (event->type() == QEvent::HoverEnter || event->type() == QEvent::HoverLeave) update();
  return QAbstractButton::event(event);
}

QColor PageButton::ground() const {
  const Theme& theme = Theme::current();
  if (isDown()) return theme[Token::Selection];
  return underMouse() ? theme[Token::Hover] : QColor();
}

Card::Card(Sample sample, QWidget* parent) : PageButton(parent), m_sample(std::move(sample)) {
  setAccessibleName(m_sample.title);
  setAccessibleDescription(m_sample.summary);
  setToolTip(m_sample.toTry.isEmpty() ? m_sample.summary : tryText(m_sample.toTry));
}

void Card::setBadge(const QString& text) {
  m_badge = text;
  update();
}

QSize Card::sizeHint() const { return {232, heightForWidth(232)}; }
int Card::heightForWidth(int width) const { return heightFor(width, m_lines); }
int Card::heightFor(int width, const Lines& lines) {
  const int toTry = lines.toTry > 0 ? kTryGap + lines.toTry * kTryLine : 0;
  return static_cast<int>(std::lround(width * kShape)) + kWords + lines.summary * kLine + toTry;
}

int Card::linesIn(int width) const {
  const QRectF room(0, 0, width - 2 * kInset, 1000);
  const QFontMetricsF metrics(Theme::font(TextRole::Normal));
  const QRectF taken = metrics.boundingRect(room, Qt::AlignLeft | Qt::TextWordWrap, m_sample.summary);
  return std::max(1, static_cast<int>(std::lround(taken.height() / metrics.lineSpacing())));
}

Card::Lines Card::wanted(int width) const {
  const QString text = tryText(m_sample.toTry);
  const QFont font = Theme::font(TextRole::Small);
  return {linesIn(width), static_cast<int>(wrapped(text, font, width - 2 * kInset, kTryLines).size())};
}

void Card::setLines(const Lines& lines) {
  m_lines = lines;
  update();
}

void Card::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  const QRectF card(rect());
  const QColor under = ground();
  paintBox(painter, card, under.isValid() ? under : theme[Token::Header], {}, kRadius);
  const QRectF picture(0, 0, card.width(), card.height() - heightFor(0, m_lines));
  QPainterPath round;
  round.addRoundedRect(card, kRadius, kRadius);
  painter.save();
  painter.setClipPath(round);
  if (m_sample.picture.isNull()) {
    painter.fillRect(picture, theme[Token::Field]);
    paintIcon(painter, QRectF(picture.center() - QPointF(12, 12), QSizeF(24, 24)), QStringLiteral("body"),
              theme[Token::Muted]);
  } else {
    paintPicture(painter, picture, m_sample.picture, m_scaled);
  }
  painter.restore();
  if (!m_badge.isEmpty()) {
    const QFont font = Theme::font(TextRole::Small);
    const QRectF badge(8, 8, textWidth(m_badge, font) + 16, 20);
    paintBox(painter, badge, theme[Token::Accent], {}, 10);
    paintText(painter, badge, Qt::AlignCenter, m_badge, font, theme[Token::OnAccent]);
  }
  paintWords(painter, picture.bottom() + 8);
  if (hasFocus()) paintFocusRing(painter, card, kRadius);
}

/// Title, summary and what to try, in a smaller type.
void Card::paintWords(QPainter& painter, double top) const {
  const Theme& theme = Theme::current();
  QFont bold = Theme::font(TextRole::Normal);
  bold.setWeight(QFont::DemiBold);
  const QRectF words(kInset, top, width() - 2 * kInset, 18);
  paintText(painter, words, Qt::AlignLeft | Qt::AlignVCenter, m_sample.title, bold, theme[Token::Text]);
  painter.setFont(Theme::font(TextRole::Normal));
  painter.setPen(theme[Token::Text2]);
  painter.drawText(QRectF(words.left(), words.bottom() + 1, words.width(), m_lines.summary * kLine + 2),
                   Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, m_sample.summary);
  const QFont small = Theme::font(TextRole::Small);
  QRectF line(words.left(), words.bottom() + 1 + m_lines.summary * kLine + kTryGap, words.width(), kTryLine);
  for (const QString& text : wrapped(tryText(m_sample.toTry), small, words.width(), m_lines.toTry)) {
    paintText(painter, line, Qt::AlignLeft | Qt::AlignVCenter, text, small, theme[Token::Text2]);
    line.translate(0, kTryLine);
  }
}

RecentRow::RecentRow(RecentProject project, QWidget* parent) : PageButton(parent), m_project(std::move(project)) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(m_project.title);
  setAccessibleDescription(m_project.path);
  const QString toTry = m_project.toTry.isEmpty() ? QString() : QLatin1Char('\n') + tryText(m_project.toTry);
  const QString place = QDir::toNativeSeparators(m_project.path);
  if (m_project.gone) {
    m_where = QStringLiteral("Not found · Locate…");
    setToolTip(QStringLiteral("It is not at %1 any more.\nA click asks where it is now.").arg(place));
    setAccessibleDescription(m_project.path + QStringLiteral(", not found"));
    return;
  }
  m_where = placeText(m_project.path) + QStringLiteral(" · ") + dayText(m_project.time, QDateTime::currentDateTime());
  setToolTip(m_where + QLatin1Char('\n') + place + toTry);
}

void RecentRow::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
  if (const QColor under = ground(); under.isValid()) paintBox(painter, QRectF(rect()), under, {}, 5);
  const QRectF picture(6, 5, 56, 40);
  paintBox(painter, picture, theme[Token::Field], {}, 4);
  if (m_project.picture.isNull()) {
    paintIcon(painter, QRectF(picture.center() - QPointF(8, 8), QSizeF(16, 16)), QStringLiteral("folder"),
              theme[Token::Muted]);
  } else {
    QPainterPath round;
    round.addRoundedRect(picture, 4, 4);
    painter.save();
    painter.setClipPath(round);
    QPixmap scaled;
    paintPicture(painter, picture, m_project.picture, scaled);
    painter.restore();
  }
  const QRectF words(picture.right() + 10, 7, width() - picture.right() - 16, 18);
  paintText(painter, words, Qt::AlignLeft | Qt::AlignVCenter, m_project.title, Theme::font(TextRole::Medium),
            theme[m_project.gone ? Token::Text2 : Token::Text]);
  paintText(painter, words.translated(0, 18), Qt::AlignLeft | Qt::AlignVCenter, m_where, Theme::font(TextRole::Small),
            theme[underMouse() ? Token::Text2 : Token::Muted]);
  if (!m_project.toTry.isEmpty())
    paintText(painter, words.translated(0, 36), Qt::AlignLeft | Qt::AlignVCenter, tryText(m_project.toTry),
              Theme::font(TextRole::Small), theme[Token::Text2]);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()), 5);
}

NavigationButton::NavigationButton(const QString& icon, const QString& text, QAction* action, QWidget* parent)
    : PageButton(parent), m_icon(icon) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setText(text);
  setAccessibleName(text);
  if (!action) return;
  m_keys = action->shortcut().toString(QKeySequence::NativeText);
  connect(this, &QAbstractButton::clicked, action, &QAction::trigger);
  const auto follow = [this, action] { setEnabled(action->isEnabled()); };
  connect(action, &QAction::changed, this, follow);
  follow();
}

void NavigationButton::setCurrent(bool on) {
  m_current = on;
  update();
}

void NavigationButton::paintEvent(QPaintEvent*) {
  const Theme& theme = Theme::current();
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor under = m_current ? theme[Token::Selection] : ground();
  if (under.isValid()) paintBox(painter, QRectF(rect()), under, {}, 5);
  const Token words = !isEnabled() ? Token::Disabled : under.isValid() ? Token::Text : Token::Text2;
  paintIcon(painter, QRectF(12, (height() - 16) / 2.0, 16, 16), m_icon, theme[words]);
  const QFont small = Theme::font(TextRole::Small);
  const double keys = m_keys.isEmpty() ? 0 : textWidth(m_keys, small) + 12;
  paintText(painter, QRectF(38, 0, width() - 50 - keys, height()), Qt::AlignLeft | Qt::AlignVCenter, text(),
            Theme::font(TextRole::Normal), theme[words]);
  if (keys > 0) {
    const QRectF box(width() - keys - 10, (height() - 18) / 2.0, keys, 18);
    paintBox(painter, box, {}, theme[Token::Line2], 3);
    paintText(painter, box, Qt::AlignCenter, m_keys, small, theme[isEnabled() ? Token::Text2 : Token::Disabled]);
  }
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()), 5);
}

}  // namespace ps
