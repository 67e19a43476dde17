// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/keyrows.h"

#include "core/scene/track.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"
#include "ui/timeline/timeaxis.h"

#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QPainter>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kDiamond = 5;    ///< half its width
constexpr double kTickRoom = 70;  ///< px that a number of the ruler has at least

/// 1, 2 or 5 times a power of ten, at least `least`.
double roundStep(double least) {
  const double unit = std::pow(10.0, std::floor(std::log10(least)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (times * unit >= least) return times * unit;
  }
  return 10 * unit;
}

/// "Hot plate temperature", "Viscosity, liquid · 2" of a curve's point.
QString titleOf(const Document& document, const Address& address, const QString& label) {
  const auto target = TrackTarget::parse(address.text());
  const QString away = awayLabel(document.project(), target ? target->address : address, label);
  return target && target->point ? QStringLiteral("%1 · %2").arg(away).arg(*target->point) : away;
}

QString secondsText(double seconds) { return formatShort(seconds, 6) + QStringLiteral(" s"); }

}  // namespace

KeyRows::KeyRows(Session& session, int least, QWidget* parent)
    : QWidget(parent), m_session(session), m_ruler(std::max(kRuler, least)), m_row(std::max(kRow, least)) {
  setAccessibleName(QStringLiteral("Keys over time"));
  connect(&session.document(), &Document::changed, this, &KeyRows::onChanged);
  connect(&session, &Session::valuesDue, this, qOverload<>(&QWidget::update));
  rebuild();
}

void KeyRows::onChanged(const ChangeEvent& event) {
  if (std::holds_alternative<FileChanged>(event) || std::holds_alternative<ParameterChanged>(event)) return;
  rebuild();
}

void KeyRows::rebuild() {
  const Document& document = m_session.document();
  const size_t before = m_rows.size();
  m_rows.clear();
  for (const Track& track : document.project().tracks) {
    const auto address = Address::parse(track.parameter);
    const api::ParameterDeclaration* declaration = address ? document.keyDeclaration(*address) : nullptr;
    if (declaration && !track.keys.empty())
      m_rows.push_back({*address, titleOf(document, *address, QString::fromUtf8(declaration->label))});
  }
  followChosen();
  fit();
  if (m_rows.size() != before) Q_EMIT rowsChanged();
}

void KeyRows::fit() {
  setFixedHeight(wantedHeight());
  // Keys do nothing on the ruler alone.
  setFocusPolicy(m_rows.empty() || !m_rowsShown ? Qt::NoFocus : Qt::StrongFocus);
  update();
}

void KeyRows::setRowsShown(bool shown) {
  m_rowsShown = shown;
  fit();
}

const std::vector<TrackKey>& KeyRows::keysOf(const Address& address) const {
  static const std::vector<TrackKey> kNone;
  const Track* track = m_session.document().track(address);
  return track ? track->keys : kNone;
}

double KeyRows::span() const { return timeAxisEnd(m_session, m_session.document().project().duration); }

double KeyRows::xOf(double seconds) const { return kLabel + (width() - kLabel - kEnd) * seconds / span(); }

double KeyRows::secondsAt(double x) const {
  return std::max(0.0, (x - kLabel) / std::max(1, width() - kLabel - kEnd) * span());
}

QPoint KeyRows::placeOf(const Address& address, size_t key) const {
  for (size_t r = 0; r < m_rows.size(); ++r) {
    if (!(m_rows[r].address == address) || key >= keysOf(m_rows[r].address).size()) continue;
    return {static_cast<int>(std::lround(xOf(keysOf(m_rows[r].address)[key].time))),
            m_ruler + static_cast<int>(r) * m_row + m_row / 2};
  }
  return {-1, -1};
}

const KeyRows::Row* KeyRows::rowAt(const QPoint& at) const {
  const int row = at.y() < m_ruler ? -1 : (at.y() - m_ruler) / m_row;
  return row < 0 || row >= rowCount() ? nullptr : &m_rows[static_cast<size_t>(row)];
}

QString KeyRows::tipAt(const QPoint& at) const {
  const auto key = keyUnder(at);
  const Row* row = rowAt(at);
  if (!row) return {};
  const api::ParameterDeclaration* declaration = m_session.document().keyDeclaration(row->address);
  if (!key || !declaration)
    return row->title +
           QStringLiteral(
               "\nDouble-click sets a key, and on this name opens them as a curve; Delete removes chosen ones");
  const TrackKey& shown = keysOf(row->address)[key->key];
  const bool toggle = declaration->kind == api::ParameterKind::Toggle;
  return QStringLiteral("%1: %2 at %3")
      .arg(row->title,
           toggle ? (shown.value > 0.5 ? QStringLiteral("on") : QStringLiteral("off"))
                  : formatValue(*declaration, shown.value),
           secondsText(shown.time));
}

bool KeyRows::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    showTip(help->globalPos(), tipAt(help->pos()), this);
    return true;
  }
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && m_drag) {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

void KeyRows::paintRuler(QPainter& painter) const {
  const Theme& theme = Theme::current();
  const double perSecond = (width() - kLabel - kEnd) / span();
  const double step = roundStep(kTickRoom / std::max(perSecond, 1e-9));
  for (int tick = 0; tick * step <= span() * (1 + 1e-9); ++tick) {
    const double x = xOf(tick * step);
    paintVerticalLine(painter, x - 0.5, m_ruler - 5, m_ruler, theme[Token::Muted]);
    const QString text = secondsText(tick * step);
    const QFont font = Theme::font(TextRole::Small);
    const bool fits = x + 3 + textWidth(text, font) < width();
    const QRectF room(fits ? x + 3 : x - 3 - kTickRoom, 0, kTickRoom, m_ruler - 3);
    paintText(painter, room, (fits ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter, text, font,
              theme[Token::Muted]);
  }
}

void KeyRows::paintRow(QPainter& painter, const Row& row, int top) const {
  const Theme& theme = Theme::current();
  const double middle = top + m_row / 2.0;
  paintHorizontalLine(painter, 0, width(), top, theme[Token::Line]);
  paintText(painter, QRectF(12, top, kLabel - 24, m_row), Qt::AlignLeft | Qt::AlignVCenter, row.title,
            Theme::font(TextRole::Normal), theme[Token::Text2]);
  const std::vector<TrackKey>& keys = keysOf(row.address);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (size_t k = 0; k + 1 < keys.size(); ++k) {
    QPen pen(theme[Token::Keyframe], 1.35);
    if (keys[k].toNext == ToNext::Step) pen.setStyle(Qt::DotLine);
    painter.setPen(pen);
    painter.setOpacity(0.55);
    painter.drawLine(QPointF(xOf(keys[k].time) + kDiamond, middle), QPointF(xOf(keys[k + 1].time) - kDiamond, middle));
  }
  painter.restore();
  for (size_t k = 0; k < keys.size(); ++k) {
    const QPointF centre(xOf(keys[k].time), middle);
    if (isChosen({row.address, k})) paintDiamond(painter, centre, kDiamond + 3, theme[Token::Accent], false);
    paintDiamond(painter, centre, kDiamond, theme[Token::Keyframe], true);
  }
}

void KeyRows::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  paintRuler(painter);
  for (size_t r = 0; r < m_rows.size(); ++r) paintRow(painter, m_rows[r], m_ruler + static_cast<int>(r) * m_row);
  paintVerticalLine(painter, xOf(std::min(m_session.now(), span())) - 0.5, m_ruler - 5, height(),
                    theme[Token::SliderFill]);
  if (m_box) paintBox(painter, QRectF(*m_box), QColor(), theme[Token::Accent], 0);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 2);
}

}  // namespace ps
