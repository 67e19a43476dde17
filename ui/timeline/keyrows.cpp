// SPDX-License-Identifier: Apache-2.0
#include "ui/timeline/keyrows.h"

#include "core/scene/track.h"
#include "core/simulation/tracks.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/theme/numbers.h"
#include "ui/theme/paint.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/theme.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QHelpEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr int kEnd = 16;          ///< right of the last second
constexpr double kDiamond = 5;    ///< half its width
constexpr int kGrip = 8;          ///< px around a key's centre
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

KeyRows::KeyRows(Session& session, QWidget* parent) : QWidget(parent), m_session(session) {
  setFocusPolicy(Qt::StrongFocus);
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
  if (m_chosen) {
    const Track* track = document.track(m_chosen->address);
    if (!track || m_chosen->key >= track->keys.size()) m_chosen.reset();
  }
  setFixedHeight(wantedHeight());
  update();
  if (m_rows.size() != before) Q_EMIT rowsChanged();
}

const std::vector<TrackKey>& KeyRows::keysOf(const Row& row) const {
  static const std::vector<TrackKey> kNone;
  const Track* track = m_session.document().track(row.address);
  return track ? track->keys : kNone;
}

double KeyRows::span() const {
  double last = m_session.document().project().duration;
  for (const Row& row : m_rows) last = std::max(last, keysOf(row).empty() ? 0 : keysOf(row).back().time);
  return last > 0 ? last : 1;
}

double KeyRows::xOf(double seconds) const { return kLabel + (width() - kLabel - kEnd) * seconds / span(); }

double KeyRows::secondsAt(double x) const {
  return std::max(0.0, (x - kLabel) / std::max(1, width() - kLabel - kEnd) * span());
}

QPoint KeyRows::placeOf(const Address& address, size_t key) const {
  for (size_t r = 0; r < m_rows.size(); ++r) {
    if (!(m_rows[r].address == address) || key >= keysOf(m_rows[r]).size()) continue;
    return {static_cast<int>(std::lround(xOf(keysOf(m_rows[r])[key].time))),
            kRuler + static_cast<int>(r) * kRow + kRow / 2};
  }
  return {-1, -1};
}

const KeyRows::Row* KeyRows::rowAt(const QPoint& at) const {
  const int row = at.y() < kRuler ? -1 : (at.y() - kRuler) / kRow;
  return row < 0 || row >= rowCount() ? nullptr : &m_rows[static_cast<size_t>(row)];
}

std::optional<KeyRows::Chosen> KeyRows::keyUnder(const QPoint& at) const {
  const Row* row = rowAt(at);
  if (!row) return std::nullopt;
  std::optional<Chosen> nearest;
  double away = kGrip;
  for (size_t k = 0; k < keysOf(*row).size(); ++k) {
    const double distance = std::abs(xOf(keysOf(*row)[k].time) - at.x());
    if (distance > away) continue;
    away = distance;
    nearest = Chosen{row->address, k};
  }
  return nearest;
}

/// To whole frames: a key acts at one.
double KeyRows::snapped(double seconds, bool free) const {
  const double frame = 2 * m_session.document().keySlack();
  return free || !(frame > 0) ? seconds : std::round(seconds / frame) * frame;
}

void KeyRows::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  m_scrubs = event->position().y() < kRuler && event->position().x() >= kLabel;
  if (m_scrubs) {
    m_session.recorded().showAt(secondsAt(event->position().x()));
    return;
  }
  m_chosen = keyUnder(event->position().toPoint());
  update();
  if (!m_chosen) return;
  const TrackKey key = m_session.document().track(m_chosen->address)->keys[m_chosen->key];
  m_drag =
      Drag{secondsAt(event->position().x()) - key.time, key, false, event->modifiers().testFlag(Qt::ControlModifier)};
}

void KeyRows::mouseMoveEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  if (m_scrubs) {
    m_session.recorded().showAt(secondsAt(event->position().x()));
    return;
  }
  setCursor(m_drag || keyUnder(at) ? Qt::SizeHorCursor : Qt::ArrowCursor);
  if (!m_drag || !m_chosen) return;
  const double time = snapped(secondsAt(event->position().x()) - m_drag->grip, event->modifiers() & Qt::ShiftModifier);
  if (!m_drag->moved && !beginDrag(time, at)) return;
  m_session.document().moveKey(m_chosen->address, m_chosen->key, time, m_drag->from.value);
  showTip(event->globalPosition().toPoint(), tipAt(placeOf(m_chosen->address, m_chosen->key)), this);
}

/// Not before the hand has moved a little; a copy comes where its time is another one.
bool KeyRows::beginDrag(double time, const QPoint& at) {
  Document& document = m_session.document();
  if (std::abs(secondsAt(at.x()) - m_drag->grip - m_drag->from.time) < 3 * span() / std::max(1, width())) return false;
  if (m_drag->copies && std::abs(time - m_drag->from.time) <= 2 * document.keySlack()) return false;
  m_drag->moved = true;
  document.beginGesture();
  if (!m_drag->copies) return true;
  document.putKey(m_chosen->address, time, m_drag->from.value);
  const auto copy = keyAt(document.track(m_chosen->address)->keys, time, document.keySlack());
  if (!copy) return true;
  m_chosen->key = *copy;
  document.setWay(m_chosen->address, *copy, m_drag->from.toNext);
  return true;
}

void KeyRows::mouseReleaseEvent(QMouseEvent*) {
  m_scrubs = false;
  endDrag(true);
}

void KeyRows::endDrag(bool keep) {
  if (!m_drag) return;
  const Drag drag = *m_drag;
  m_drag.reset();
  if (!drag.moved) return;
  Document& document = m_session.document();
  if (!keep && m_chosen && drag.copies)
    document.removeKey(m_chosen->address, m_chosen->key);
  else if (!keep && m_chosen)
    document.moveKey(m_chosen->address, m_chosen->key, drag.from.time, drag.from.value);
  document.endGesture();
}

void KeyRows::mouseDoubleClickEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  const Row* row = rowAt(at);
  if (event->button() != Qt::LeftButton || !row || at.x() < kLabel || keyUnder(at)) return;
  Document& document = m_session.document();
  const Address address = row->address;
  const double time = snapped(secondsAt(at.x()), event->modifiers() & Qt::ShiftModifier);
  const api::ParameterDeclaration* declaration = document.keyDeclaration(address);
  if (!declaration) return;
  const bool isPoint = TrackTarget::parse(address.text()).value_or(TrackTarget{address}).point.has_value();
  const double own = isPoint ? keysOf(*row).front().value : responseOf(document.value(address)).at(293.15);
  const double held = trackValue(keysOf(*row), time).value_or(own);
  const QString problem = document.putKey(address, time, responseOf(valueOfKey(held, *declaration)).at(293.15));
  if (!problem.isEmpty()) {
    Q_EMIT refused(problem);
  } else if (const auto key = keyAt(document.track(address)->keys, time, document.keySlack())) {
    m_chosen = Chosen{address, *key};
  }
}

void KeyRows::removeChosen() {
  if (!m_chosen) return;
  const Chosen gone = *m_chosen;
  m_chosen.reset();
  m_session.document().removeKey(gone.address, gone.key);
}

void KeyRows::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Delete && m_chosen && !m_drag)
    removeChosen();
  else if (event->key() == Qt::Key_Escape && m_drag)
    endDrag(false);
  else
    QWidget::keyPressEvent(event);
}

void KeyRows::contextMenuEvent(QContextMenuEvent* event) {
  if (event->reason() == QContextMenuEvent::Mouse) m_chosen = keyUnder(event->pos());
  update();
  const Track* track = m_chosen ? m_session.document().track(m_chosen->address) : nullptr;
  const api::ParameterDeclaration* declaration =
      track ? m_session.document().keyDeclaration(m_chosen->address) : nullptr;
  if (!declaration) return;
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  if (declaration->kind != api::ParameterKind::Toggle) {
    for (const auto& [way, text] :
         {std::pair(ToNext::Step, "Hold its value"), std::pair(ToNext::Linear, "Straight line"),
          std::pair(ToNext::Smooth, "Smooth curve")}) {
      QAction* action = menu->addAction(QString::fromLatin1(text));
      action->setCheckable(true);
      action->setChecked(track->keys[m_chosen->key].toNext == way);
      connect(action, &QAction::triggered, this,
              [this, way = way, at = *m_chosen] { m_session.document().setWay(at.address, at.key, way); });
    }
    menu->addSeparator();
  }
  connect(menu->addAction(QStringLiteral("Delete key")), &QAction::triggered, this, [this] { removeChosen(); });
  menu->popup(event->globalPos());
}

QString KeyRows::tipAt(const QPoint& at) const {
  const auto key = keyUnder(at);
  const Row* row = rowAt(at);
  if (!row) return {};
  const api::ParameterDeclaration* declaration = m_session.document().keyDeclaration(row->address);
  if (!key || !declaration)
    return row->title + QStringLiteral("\nDouble-click sets a key, Delete removes the chosen one");
  const TrackKey& shown = keysOf(*row)[key->key];
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
    paintVerticalLine(painter, x - 0.5, kRuler - 5, kRuler, theme[Token::Muted]);
    const QString text = secondsText(tick * step);
    const QFont font = Theme::font(TextRole::Small);
    const bool fits = x + 3 + textWidth(text, font) < width();
    const QRectF room(fits ? x + 3 : x - 3 - kTickRoom, 0, kTickRoom, kRuler - 3);
    paintText(painter, room, (fits ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter, text, font,
              theme[Token::Muted]);
  }
}

void KeyRows::paintRow(QPainter& painter, const Row& row, int top) const {
  const Theme& theme = Theme::current();
  const double middle = top + kRow / 2.0;
  paintHorizontalLine(painter, 0, width(), top, theme[Token::Line]);
  paintText(painter, QRectF(12, top, kLabel - 24, kRow), Qt::AlignLeft | Qt::AlignVCenter, row.title,
            Theme::font(TextRole::Normal), theme[Token::Text2]);
  const std::vector<TrackKey>& keys = keysOf(row);
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
    if (m_chosen == Chosen{row.address, k}) paintDiamond(painter, centre, kDiamond + 3, theme[Token::Accent], false);
    paintDiamond(painter, centre, kDiamond, theme[Token::Keyframe], true);
  }
}

void KeyRows::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const Theme& theme = Theme::current();
  painter.fillRect(rect(), theme[Token::Panel]);
  if (m_rows.empty()) return;
  paintRuler(painter);
  for (size_t r = 0; r < m_rows.size(); ++r) paintRow(painter, m_rows[r], kRuler + static_cast<int>(r) * kRow);
  paintVerticalLine(painter, xOf(std::min(m_session.now(), span())) - 0.5, kRuler - 5, height(),
                    theme[Token::SliderFill]);
  if (hasFocus()) paintFocusRing(painter, QRectF(rect()).adjusted(1, 1, -1, -1), 2);
}

}  // namespace ps
