// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/markerrow.h"

#include "ui/document/document.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/nameinplace.h"
#include "ui/timeline/timeaxis.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtGui/QPainterPath>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr double kFlag = 5;   ///< px, half the width of what a hand takes
constexpr double kMoved = 3;  ///< px, before a press is a drag

QString nameOf(const Marker& marker) { return QString::fromStdString(marker.name); }

}  // namespace

MarkerRow::MarkerRow(Session& session, const KeyRows& scale, QWidget* parent)
    : QWidget(parent), m_session(session), m_scale(scale), m_known(session.document().project().markers) {
  setFixedHeight(std::max(kHeight, scale.rowHeight()));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setAccessibleName(QStringLiteral("Markers"));
  connect(&session.document(), &Document::changed, this, &MarkerRow::onChanged);
  connect(&session, &Session::valuesDue, this, qOverload<>(&QWidget::update));
}

void MarkerRow::onChanged(const ChangeEvent& event) {
  update();
  if (!std::holds_alternative<MarkersChanged>(event) && !std::holds_alternative<ProjectOpened>(event)) return;
  if (std::holds_alternative<ProjectOpened>(event)) m_chosen.reset();
  followChosen();
  Q_EMIT wanted(!m_known.empty());
}

/// It stays the one that it is where others come and go: the nearest that is alike. Changes leave each in its place.
void MarkerRow::followChosen() {
  const std::vector<Marker> before = std::exchange(m_known, m_session.document().project().markers);
  if (!m_chosen || m_known.size() == before.size()) return;
  std::optional<size_t> same;
  const auto away = [this](size_t k) { return k > *m_chosen ? k - *m_chosen : *m_chosen - k; };
  for (size_t k = 0; k < m_known.size(); ++k) {
    if (m_known[k] == before[*m_chosen] && (!same || away(k) < away(*same))) same = k;
  }
  m_chosen = same;
}

/// The name stands after its flag; where the row ends, before it.
QRectF MarkerRow::flagOf(size_t marker) const {
  const Marker& shown = m_session.document().project().markers[marker];
  const double x = m_scale.xOf(shown.time), wide = textWidth(nameOf(shown), Theme::font(TextRole::Small)) + 2;
  const bool fits = x + kFlag + 3 + wide < width();
  return fits ? QRectF(x - kFlag, 0, 2 * kFlag + 3 + wide, height())
              : QRectF(x - kFlag - 3 - wide, 0, 2 * kFlag + 3 + wide, height());
}

QPoint MarkerRow::placeOf(size_t marker) const {
  const auto& markers = m_session.document().project().markers;
  return marker < markers.size()
             ? QPoint(static_cast<int>(std::lround(m_scale.xOf(markers[marker].time))), height() / 2)
             : QPoint(-1, -1);
}

/// Its flag before any name that lies over it.
std::optional<size_t> MarkerRow::markerAt(const QPoint& at) const {
  const size_t count = m_session.document().project().markers.size();
  for (size_t k = count; k-- > 0;) {
    if (std::abs(placeOf(k).x() - at.x()) <= kFlag) return k;
  }
  for (size_t k = count; k-- > 0;) {
    if (flagOf(k).contains(at)) return k;
  }
  return std::nullopt;
}

double MarkerRow::snapped(double seconds, bool free) const {
  const double frame = 2 * m_session.document().keySlack();
  return free || !(frame > 0) ? seconds : std::round(seconds / frame) * frame;
}

void MarkerRow::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  m_chosen = markerAt(event->position().toPoint());
  update();
  if (!m_chosen) return;
  const double time = m_session.document().project().markers[*m_chosen].time;
  m_drag = Drag{m_scale.secondsAt(event->position().x()) - time, time, false};
}

void MarkerRow::mouseMoveEvent(QMouseEvent* event) {
  setCursor(m_drag || markerAt(event->position().toPoint()) ? Qt::SizeHorCursor : Qt::ArrowCursor);
  if (!m_drag || !m_chosen) return;
  const double time = m_scale.secondsAt(event->position().x()) - m_drag->grip;
  if (!m_drag->moved && std::abs(m_scale.xOf(time) - m_scale.xOf(m_drag->from)) < kMoved) return;
  if (!m_drag->moved) m_session.document().beginGesture();
  m_drag->moved = true;
  m_session.document().editMarker(*m_chosen, snapped(time, event->modifiers().testFlag(Qt::ShiftModifier)), {});
  showTip(event->globalPosition().toPoint(), clockText(m_session.document().project().markers[*m_chosen].time), this);
}

void MarkerRow::mouseReleaseEvent(QMouseEvent*) {
  if (m_drag && !m_drag->moved) m_session.recorded().showAt(m_drag->from);
  endDrag(true);
}

/// No release comes to what is hidden: the document's gesture would stay open.
void MarkerRow::hideEvent(QHideEvent*) { endDrag(false); }

void MarkerRow::endDrag(bool keep) {
  if (!m_drag) return;
  const Drag drag = *m_drag;
  m_drag.reset();
  if (!drag.moved) return;
  if (!keep && m_chosen) m_session.document().editMarker(*m_chosen, drag.from, {});
  m_session.document().endGesture();
}

void MarkerRow::mouseDoubleClickEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  if (event->button() != Qt::LeftButton || at.x() < KeyRows::kLabel) return;
  if (const auto marker = markerAt(at)) {
    editName(*marker);
    return;
  }
  m_chosen = m_session.document().addMarker(timeToSet(m_session, m_scale.secondsAt(at.x()), event->modifiers()));
  update();
}

void MarkerRow::editName(size_t marker) {
  const auto& markers = m_session.document().project().markers;
  if (marker >= markers.size()) return;
  const QRect place(static_cast<int>(flagOf(marker).left()), 2, 0, height() - 4);
  nameInPlace(*this, place, nameOf(markers[marker]), QStringLiteral("Name of the marker"),
              [this, marker](const QString& name) {
                const auto& now = m_session.document().project().markers;
                if (marker < now.size()) m_session.document().editMarker(marker, now[marker].time, name);
              });
}

void MarkerRow::removeChosen() {
  if (m_chosen) m_session.document().removeMarker(*m_chosen);
  m_chosen.reset();
  update();
}

void MarkerRow::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Delete && m_chosen && !m_drag)
    removeChosen();
  else if (event->key() == Qt::Key_F2 && m_chosen)
    editName(*m_chosen);
  else if (event->key() == Qt::Key_Escape && m_drag)
    endDrag(false);
  else
    QWidget::keyPressEvent(event);
}

void MarkerRow::fillMenu(QMenu& menu, size_t marker) {
  const auto& markers = m_session.document().project().markers;
  if (marker >= markers.size()) return;
  const auto add = [&](const char* text, auto act) {
    connect(menu.addAction(QString::fromLatin1(text)), &QAction::triggered, this, act);
  };
  add("Show", [this, time = markers[marker].time] { m_session.recorded().showAt(time); });
  add("Rename", [this, marker] { editName(marker); });
  add("Delete marker", [this, marker] {
    m_chosen = marker;
    removeChosen();
  });
}

void MarkerRow::contextMenuEvent(QContextMenuEvent* event) {
  if (event->reason() == QContextMenuEvent::Mouse) m_chosen = markerAt(event->pos());
  update();
  if (!m_chosen) return;
  QMenu menu(this);
  fillMenu(menu, *m_chosen);
  menu.exec(event->globalPos());
}

/// The window has shortcuts of the same keys.
bool MarkerRow::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if ((key == Qt::Key_Escape && m_drag) || (m_chosen && (key == Qt::Key_F2 || key == Qt::Key_Delete))) {
      event->accept();
      return true;
    }
  }
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const auto marker = markerAt(help->pos());
    const auto& markers = m_session.document().project().markers;
    showTip(help->globalPos(),
            marker ? QStringLiteral("%1 at %2").arg(nameOf(markers[*marker]), clockText(markers[*marker].time))
                   : QStringLiteral("Double-click sets a marker, or names one; Delete removes the chosen one"),
            this);
    return true;
  }
  return QWidget::event(event);
}

void MarkerRow::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  paintHorizontalLine(painter, 0, width(), 0, theme[Token::Line]);
  paintText(painter, QRectF(12, 0, KeyRows::kLabel - 24, height()), Qt::AlignLeft | Qt::AlignVCenter,
            QStringLiteral("Markers"), Theme::font(TextRole::Normal), theme[Token::Text2]);
  const auto& markers = m_session.document().project().markers;
  painter.setRenderHint(QPainter::Antialiasing);
  for (size_t k = 0; k < markers.size(); ++k) {
    const QRectF flag = flagOf(k);
    const double x = m_scale.xOf(markers[k].time), middle = height() / 2.0;
    const bool chosen = m_chosen == k;
    if (chosen) paintBox(painter, flag.adjusted(-1, 3, 2, -3), theme[Token::Selection], QColor(), 3);
    QPainterPath shape(QPointF(x - kFlag + 1, middle - 5));  // a tag that points at its time
    shape.lineTo(x + kFlag - 1, middle - 5);
    shape.lineTo(x + kFlag - 1, middle + 1);
    shape.lineTo(x, middle + 6);
    shape.lineTo(x - kFlag + 1, middle + 1);
    shape.closeSubpath();
    painter.fillPath(shape, theme[chosen ? Token::Accent : Token::Text2]);
    const bool after = flag.left() >= x - kFlag - 0.5;
    paintText(painter, after ? flag.adjusted(2 * kFlag + 1, 0, 0, 0) : flag.adjusted(0, 0, -2 * kFlag - 1, 0),
              Qt::AlignLeft | Qt::AlignVCenter, nameOf(markers[k]), Theme::font(TextRole::Small), theme[Token::Text]);
  }
  paintVerticalLine(painter, m_scale.xOf(m_session.now()) - 0.5, 0, height(), theme[Token::SliderFill]);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 2);
}

}  // namespace ps
