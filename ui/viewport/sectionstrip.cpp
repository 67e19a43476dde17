// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/sectionstrip.h"

#include "ui/theme/paint.h"
#include "ui/theme/theme.h"

#include <QtGui/QPainter>

#include <algorithm>

namespace ps {
namespace {

constexpr double kPadding = 8, kRow = 24, kButton = 20, kGap = 4;
constexpr double kTrack = 120, kPlace = 64;  // px, of the slider and of what it says

struct WayRow {
  const char *across, *label;
};
constexpr WayRow kWays[] = {{"view", "Facing"}, {"x", "X"}, {"y", "Y"}, {"z", "Z"}};

class StripPainter {
 public:
  StripPainter(QPainter& painter, const SectionNote& note) : m_painter(painter), m_note(note) {}

  SectionHits paint(const QPointF& corner) {
    // Measured by being painted nowhere: the ground has to come first.
    m_painter.save();
    m_painter.setClipRect(QRectF());
    const double width = std::max(row(corner, true), row(corner, false));
    m_painter.restore();
    m_hits = {};
    m_hits.strip = QRectF(corner.x(), corner.y(), width, 2 * kRow + kGap);
    paintBox(m_painter, m_hits.strip, m_theme[Token::Overlay], m_theme[Token::Line], 4);
    row(corner, true);
    row(corner + QPointF(0, kRow), false);
    return m_hits;
  }

 private:
  /// Returns its width.
  double row(const QPointF& corner, bool upper) {
    m_top = corner.y() + 2;
    m_x = corner.x() + kPadding;
    if (upper) {
      text(QStringLiteral("Section"), Token::Text2);
      for (const WayRow& way : kWays)
        m_hits.ways.emplace_back(way.across, button(QString::fromLatin1(way.label), m_note.across == way.across));
      m_x += kGap;
      m_hits.flip = button(QStringLiteral("Flip"), m_note.flipped);
      m_hits.end = button(QStringLiteral("End"), false);
    } else {
      slider();
      text(m_note.place, Token::Text, kPlace);
      for (const char* name : {",", "."}) key(QString::fromLatin1(name));
      text(QStringLiteral("move"), Token::Text2);
      key(QStringLiteral("X"));
      text(QStringLiteral("end"), Token::Text2);
    }
    return m_x - corner.x() + kPadding - kGap;
  }
  void text(const QString& text, Token colour, double least = 0) {
    const double width = std::max(least, textWidth(text, m_font) + 2);
    paintText(m_painter, QRectF(m_x, m_top, width, kRow), Qt::AlignLeft | Qt::AlignVCenter, text, m_font,
              m_theme[colour]);
    m_x += width + kPadding;
  }
  void key(const QString& name) {
    constexpr double kHigh = 18;
    const QRectF rect(m_x, m_top + (kRow - kHigh) / 2, textWidth(name, m_font) + 10, kHigh);
    paintBox(m_painter, rect, m_theme[Token::Raised], m_theme[Token::Line2], 3);
    paintText(m_painter, rect, Qt::AlignCenter, name, m_font, m_theme[Token::Text]);
    m_x = rect.right() + kGap;
  }
  QRectF button(const QString& label, bool on) {
    const QRectF rect(m_x, m_top + (kRow - kButton) / 2, std::max(22.0, textWidth(label, m_font) + 12), kButton);
    paintBox(m_painter, rect, m_theme[on ? Token::Selection : Token::Raised],
             m_theme[on ? Token::Accent : Token::Line2], 3);
    paintText(m_painter, rect, Qt::AlignCenter, label, m_font, m_theme[Token::Text]);
    m_x = rect.right() + kGap;
    return rect;
  }
  void slider() {
    constexpr double kThick = 4, kHandleWidth = 8, kHandleHeight = 12;
    m_hits.slider = QRectF(m_x, m_top, kTrack, kRow);
    const double middle = m_hits.slider.center().y();
    const QRectF track(m_x, middle - kThick / 2, kTrack, kThick);
    paintBox(m_painter, track, m_theme[Token::Field], m_theme[Token::ControlEdge], kThick / 2);
    QRectF filled = track;
    filled.setWidth(m_note.share * kTrack);
    paintBox(m_painter, filled, m_theme[Token::SliderFill], m_theme[Token::SliderFill], kThick / 2);
    QRectF handle(0, 0, kHandleWidth, kHandleHeight);
    handle.moveCenter({filled.right(), middle});
    paintBox(m_painter, handle, m_theme[Token::Text], m_theme[Token::Window], 3);
    m_x += kTrack + kPadding;
  }

  QPainter& m_painter;
  const SectionNote& m_note;
  const Theme& m_theme = Theme::current();
  const QFont m_font = Theme::font(TextRole::Small);
  SectionHits m_hits;
  double m_x = 0, m_top = 0;
};

}  // namespace

QString SectionNote::words() const {
  const QString way = across == "view" ? QStringLiteral("Section that faces you")
                                       : QStringLiteral("Section across %1").arg(QString::fromStdString(across));
  return QStringLiteral("%1 at %2").arg(way, place);
}

SectionHits paintSection(QPainter& painter, const SectionNote& note, const QPointF& corner) {
  return StripPainter(painter, note).paint(corner);
}

}  // namespace ps
