// SPDX-License-Identifier: Apache-2.0
// Keys under hands: chosen, dragged, copied, set and taken away.
#include "core/scene/track.h"
#include "core/simulation/tracks.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/plaintext.h"
#include "ui/theme/reach.h"
#include "ui/timeline/keyinplace.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/timeaxis.h"

#include <QtGui/QContextMenuEvent>
#include <QtGui/QKeyEvent>
#include <QtGui/QMouseEvent>
#include <QtWidgets/QMenu>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr int kMeet = 4;   ///< px to a key that stays
constexpr int kStill = 3;  ///< px that a hand moves which only clicks

/// "12.5" of "12.5 s".
QString withoutSeconds(const QString& text) {
  QString bare = text.trimmed();
  if (bare.endsWith(QLatin1Char('s'))) bare.chop(1);
  return bare.trimmed();
}

}  // namespace

std::optional<KeyRows::Chosen> KeyRows::keyUnder(const QPoint& at, double reach) const {
  const Row* row = rowAt(at);
  if (!row) return std::nullopt;
  std::optional<Chosen> nearest;
  double away = reach;
  for (size_t k = 0; k < keysOf(row->address).size(); ++k) {
    const double distance = std::abs(xOf(keysOf(row->address)[k].time) - at.x());
    if (distance > away) continue;
    away = distance;
    nearest = Chosen{row->address, k};
  }
  return nearest;
}

/// To whole frames: a key acts at one. What is dragged meets keys that stay, of any row.
double KeyRows::snapped(double seconds, bool free) const {
  const double frame = 2 * m_session.document().keySlack();
  for (const Row& row : m_rows) {
    if (free || !m_drag) break;
    const auto dragged = std::find_if(m_drag->before.begin(), m_drag->before.end(),
                                      [&](const auto& keys) { return keys.first == row.address; });
    const std::vector<TrackKey>& keys = dragged != m_drag->before.end() ? dragged->second : keysOf(row.address);
    for (size_t k = 0; k < keys.size(); ++k) {
      const bool stays =
          std::find(m_drag->keys.begin(), m_drag->keys.end(), Chosen{row.address, k}) == m_drag->keys.end();
      if (stays && std::abs(xOf(keys[k].time) - xOf(seconds)) <= kMeet) return keys[k].time;
    }
  }
  return free || !(frame > 0) ? seconds : std::round(seconds / frame) * frame;
}

std::vector<KeyRows::Chosen> KeyRows::chosen() const {
  std::vector<Chosen> keys;
  for (const Picked& picked : m_picked) keys.push_back(picked.key);
  return keys;
}

bool KeyRows::isChosen(const Chosen& key) const {
  return std::any_of(m_picked.begin(), m_picked.end(), [&](const Picked& picked) { return picked.key == key; });
}

void KeyRows::choose(std::vector<Chosen> keys) {
  m_picked.clear();
  for (Chosen& key : keys) {
    const std::vector<TrackKey>& of = keysOf(key.address);
    if (key.key < of.size()) m_picked.push_back({key, of[key.key].time, of.size()});
  }
  update();
}

/// Undo and other hands give keys other numbers: a chosen one is the one of its time, or, where none came or went, the
/// one of its number.
void KeyRows::followChosen() {
  std::vector<Chosen> still;
  for (const Picked& picked : m_picked) {
    const std::vector<TrackKey>& keys = keysOf(picked.key.address);
    const auto same =
        std::find_if(keys.begin(), keys.end(), [&](const TrackKey& key) { return key.time == picked.time; });
    if (same != keys.end())
      still.push_back({picked.key.address, static_cast<size_t>(same - keys.begin())});
    else if (keys.size() == picked.count)
      still.push_back(picked.key);
  }
  choose(std::move(still));
}

void KeyRows::chooseIn(const QRect& box) {
  std::vector<Chosen> inside;
  for (const Row& row : m_rows) {
    for (size_t k = 0; k < keysOf(row.address).size(); ++k) {
      if (box.contains(placeOf(row.address, k))) inside.push_back({row.address, k});
    }
  }
  choose(std::move(inside));
}

void KeyRows::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const QPoint at = event->position().toPoint();
  m_scrubs = at.y() < m_ruler && at.x() >= kLabel;
  if (m_scrubs) {
    m_session.recorded().showAt(secondsAt(event->position().x()));
    return hintAhead(secondsAt(event->position().x()));
  }
  const auto under = keyUnder(at, reachOf(*event, kGrip));
  if (!under) {
    choose({});
    if (at.x() >= kLabel) m_box = QRect(at, at);
    return;
  }
  std::vector<Chosen> keys = chosen();
  const bool had = isChosen(*under), adds = event->modifiers() & Qt::ShiftModifier;
  if (had || adds)
    std::erase(keys, *under);
  else
    keys.clear();
  if (!(had && adds)) keys.push_back(*under);
  choose(std::move(keys));
  if (!(had && adds)) beginDrag(*under, secondsAt(event->position().x()), event->modifiers() & Qt::ControlModifier);
}

void KeyRows::mouseMoveEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  if (m_scrubs) return m_session.recorded().showAt(secondsAt(event->position().x()));
  if (m_box) {
    m_box->setBottomRight(at);
    return chooseIn(m_box->normalized());
  }
  setCursor(m_drag || keyUnder(at, reachOf(*event, kGrip)) ? Qt::SizeHorCursor : Qt::ArrowCursor);
  if (!m_drag) return;
  if (!m_drag->moved && std::abs(xOf(m_drag->from + m_drag->grip) - at.x()) < kStill) return;
  dragTo(snapped(secondsAt(event->position().x()) - m_drag->grip, event->modifiers() & Qt::ShiftModifier));
  if (!m_picked.empty()) {
    const Chosen& key = m_picked.back().key;
    showTip(event->globalPosition().toPoint(), tipAt(placeOf(key.address, key.key)), this);
  }
}

void KeyRows::beginDrag(const Chosen& key, double pointer, bool copies) {
  const double time = keysOf(key.address)[key.key].time;
  m_drag = Drag{pointer - time, time, {}, chosen(), false, copies, {}};
  for (const Chosen& each : m_drag->keys) {
    const bool there = std::any_of(m_drag->before.begin(), m_drag->before.end(),
                                   [&](const auto& keys) { return keys.first == each.address; });
    if (!there) m_drag->before.push_back({each.address, keysOf(each.address)});
  }
}

/// As far as a key that is not dragged lets those beside it; none goes before the start.
double KeyRows::heldShift(double shift) const {
  double least = -std::numeric_limits<double>::infinity(), most = -least;
  const double gap = 2 * m_session.document().keySlack();
  for (const auto& [address, keys] : m_drag->before) {
    const auto held = [&, &of = address](size_t k) {
      return std::find(m_drag->keys.begin(), m_drag->keys.end(), Chosen{of, k}) == m_drag->keys.end();
    };
    for (size_t k = 0; k < keys.size(); ++k) {
      if (held(k)) continue;
      least = std::max(least, -keys[k].time);
      if (m_drag->copies) continue;  // a copy may pass, and takes the place of a key where it stays
      if (k > 0 && held(k - 1)) least = std::max(least, std::min(0.0, keys[k - 1].time + gap - keys[k].time));
      if (k + 1 < keys.size() && held(k + 1))
        most = std::min(most, std::max(0.0, keys[k + 1].time - gap - keys[k].time));
    }
  }
  return std::clamp(shift, least, most);
}

/// All from where they began, so that a way over other keys, or back, leaves nothing behind.
void KeyRows::dragTo(double time) {
  Document& document = m_session.document();
  const double shift = heldShift(time - m_drag->from);
  if (!m_drag->moved) document.beginGesture();
  m_drag->moved = true;
  auto after = m_drag->before;
  for (auto& [address, keys] : after) {
    const std::vector<TrackKey> old = keys;
    for (const Chosen& each : m_drag->keys) {
      if (!(each.address == address)) continue;
      TrackKey key = old[each.key];
      key.time = std::round((key.time + shift) * 1e6) / 1e6;
      if (m_drag->copies && std::abs(shift) > document.keySlack())
        putKey(keys, key, document.keySlack());
      else if (!m_drag->copies)
        keys[each.key] = key;
    }
  }
  const QString text = QStringLiteral("moving keys of %1").arg(document.trackTitle(m_drag->keys.back().address));
  const QString problem = document.setKeys(after, text);
  m_drag->problem = problem;  // of where it is now: one on the way is no more
  std::vector<Chosen> moved;
  for (const Chosen& each : m_drag->keys) {
    const auto old = std::find_if(m_drag->before.begin(), m_drag->before.end(),
                                  [&](const auto& keys) { return keys.first == each.address; });
    const auto now = keyAt(keysOf(each.address), old->second[each.key].time + shift, 1e-5);
    if (now) moved.push_back({each.address, *now});
  }
  choose(std::move(moved));
}

void KeyRows::mouseReleaseEvent(QMouseEvent*) {
  m_scrubs = false;
  m_box.reset();
  update();
  endDrag(true);
}

/// No release comes to what is hidden: the document's gesture would stay open.
void KeyRows::hideEvent(QHideEvent*) {
  m_box.reset();
  endDrag(true);
}

void KeyRows::endDrag(bool keep) {
  if (!m_drag) return;
  const Drag drag = *m_drag;
  m_drag.reset();
  if (!drag.moved) return;
  Document& document = m_session.document();
  if (!keep) {
    document.setKeys(drag.before, {});
    choose(drag.keys);
  }
  document.endGesture();
  if (keep) tell(drag.problem);
}

void KeyRows::tell(const QString& problem) {
  if (!problem.isEmpty()) Q_EMIT refused(QStringLiteral("The keys stay as they are."), problem);
}

void KeyRows::mouseDoubleClickEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  const Row* row = rowAt(at);
  if (event->button() != Qt::LeftButton || !row || keyUnder(at, reachOf(*event, kGrip))) return;
  if (at.x() < kLabel) {
    Q_EMIT curveWanted(Address(row->address));
  } else {
    setKeyAt(Row(*row), timeToSet(m_session, secondsAt(at.x()), event->modifiers()));
  }
}

/// Of what has not run yet there is nothing to show.
void KeyRows::hintAhead(double seconds) {
  const SnapshotPtr newest = m_session.newest();
  const double last = std::max(m_session.recorded().extent().to, newest ? newest->stats.time : 0);
  if (xOf(seconds) <= xOf(last) + kGrip) return;
  Q_EMIT hint(
      QStringLiteral("A click here shows what is recorded, and the scene has only run up to %1. Space plays on; a "
                     "double-click in a row below sets a key here, a right click a marker.")
          .arg(clockText(last)));
}

void KeyRows::typeKey(const Chosen& key) {
  const std::vector<TrackKey>& keys = keysOf(key.address);
  const api::ParameterDeclaration* declaration = m_session.document().keyDeclaration(key.address);
  if (key.key >= keys.size() || !declaration) return;
  const TrackKey& shown = keys[key.key];
  const bool toggle = declaration->kind == api::ParameterKind::Toggle;
  const QPoint at = placeOf(key.address, key.key);
  const KeyTexts texts{formatShort(shown.time, 6) + QStringLiteral(" s"),
                       toggle ? QString() : formatValue(*declaration, shown.value)};
  // Texts are shorter than numbers: what nobody typed stays as it is, to the last digit.
  const auto own = [](const QString& typed, const QString& before) { return typed == before ? QString() : typed; };
  keyInPlace(*this, {at.x() + static_cast<int>(kGrip), at.y() - m_row / 2 + 1, 0, m_row - 2}, texts,
             [this, address = key.address, time = shown.time, texts, own](const KeyTexts& typed) {
               takeTyped(address, time, own(typed.time, texts.time), own(typed.value, texts.value));
             });
}

/// The key of that time, which others may have moved or taken away meanwhile; with another time it takes the place of
/// one that is there. An empty text leaves what it is for.
void KeyRows::takeTyped(const Address& address, double time, const QString& newTime, const QString& newValue) {
  Document& document = m_session.document();
  const api::ParameterDeclaration* declaration = document.keyDeclaration(address);
  std::vector<TrackKey> keys = keysOf(address);
  const auto place = keyAt(keys, time, 1e-6);
  if (!declaration || !place) return;
  TrackKey key = keys[*place];
  if (!newTime.isEmpty()) {
    const auto seconds = parseNumber(withoutSeconds(newTime));
    if (!seconds || !(*seconds >= 0)) return tell(QStringLiteral("A time is a number of seconds from the start on."));
    key.time = std::round(*seconds * 1e6) / 1e6;
  }
  if (!newValue.isEmpty()) {
    const Typed typed = parseTyped(newValue, *declaration, key.value);
    if (!typed.problem.isEmpty()) return tell(typed.problem);
    key.value = typed.value;
  }
  size_t now = *place;
  if (newTime.isEmpty()) {
    keys[now] = key;
  } else {
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(*place));
    now = putKey(keys, key, document.keySlack());
  }
  const QString problem =
      document.setKeys({{address, keys}}, QStringLiteral("key of %1").arg(document.trackTitle(address)));
  tell(problem);
  if (problem.isEmpty()) choose({{address, now}});
}

/// Of the value that holds then.
void KeyRows::setKeyAt(const Row& row, double time) {
  Document& document = m_session.document();
  const api::ParameterDeclaration* declaration = document.keyDeclaration(row.address);
  if (!declaration) return;
  const bool isPoint = TrackTarget::parse(row.address.text()).value_or(TrackTarget{row.address}).point.has_value();
  const double own = isPoint ? keysOf(row.address).front().value : responseOf(document.value(row.address)).at(293.15);
  const double held = trackValue(keysOf(row.address), time).value_or(own);
  const QString problem = document.putKey(row.address, time, responseOf(valueOfKey(held, *declaration)).at(293.15));
  if (!problem.isEmpty()) return tell(problem);
  if (const auto key = keyAt(keysOf(row.address), time, document.keySlack())) choose({{row.address, *key}});
}

void KeyRows::removeChosen() {
  std::vector<std::pair<Address, std::vector<TrackKey>>> left;
  for (const Row& row : m_rows) {
    std::vector<TrackKey> keys;
    for (size_t k = 0; k < keysOf(row.address).size(); ++k) {
      if (!isChosen({row.address, k})) keys.push_back(keysOf(row.address)[k]);
    }
    if (keys.size() < keysOf(row.address).size()) left.push_back({row.address, std::move(keys)});
  }
  if (left.empty()) return;
  choose({});
  Document& document = m_session.document();
  tell(document.setKeys(left, QStringLiteral("removal of keys of %1").arg(document.trackTitle(left.front().first))));
}

void KeyRows::setWay(ToNext way) {
  std::vector<std::pair<Address, std::vector<TrackKey>>> after;
  for (const Chosen& each : chosen()) {
    auto own = std::find_if(after.begin(), after.end(), [&](const auto& keys) { return keys.first == each.address; });
    if (own == after.end()) own = after.insert(after.end(), {each.address, keysOf(each.address)});
    own->second[each.key].toNext = way;
  }
  if (after.empty()) return;
  Document& document = m_session.document();
  tell(document.setKeys(after, QStringLiteral("way between keys of %1").arg(document.trackTitle(after.front().first))));
}

void KeyRows::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Delete && !m_picked.empty() && !m_drag)
    removeChosen();
  else if (event->key() == Qt::Key_Escape && m_drag)
    endDrag(false);
  else
    QWidget::keyPressEvent(event);
}

/// Of what is chosen.
void KeyRows::fillKeyMenu(QMenu& menu) {
  const Chosen key = m_picked.back().key;
  const bool toggles = std::any_of(m_picked.begin(), m_picked.end(), [this](const Picked& picked) {
    const auto* declared = m_session.document().keyDeclaration(picked.key.address);
    return !declared || declared->kind == api::ParameterKind::Toggle;
  });
  if (m_picked.size() == 1) {
    connect(menu.addAction(toggles ? QStringLiteral("Set time…") : QStringLiteral("Set time and value…")),
            &QAction::triggered, this, [this, key] { typeKey(key); });
    menu.addSeparator();
  }
  for (const auto& [way, text] : {std::pair(ToNext::Step, "Hold its value"), std::pair(ToNext::Linear, "Straight line"),
                                  std::pair(ToNext::Smooth, "Smooth curve")}) {
    if (toggles) break;
    QAction* action = menu.addAction(QString::fromLatin1(text));
    action->setCheckable(true);
    action->setChecked(keysOf(key.address)[key.key].toNext == way);
    connect(action, &QAction::triggered, this, [this, way = way] { setWay(way); });
  }
  if (!toggles) menu.addSeparator();
  connect(menu.addAction(m_picked.size() > 1 ? QStringLiteral("Delete keys") : QStringLiteral("Delete key")),
          &QAction::triggered, this, [this] { removeChosen(); });
}

void KeyRows::contextMenuEvent(QContextMenuEvent* event) {
  const bool byMouse = event->reason() == QContextMenuEvent::Mouse;
  const auto under = keyUnder(event->pos());
  if (byMouse && (!under || !isChosen(*under))) choose(under ? std::vector{*under} : std::vector<Chosen>{});
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  if (!m_picked.empty()) fillKeyMenu(*menu);
  if (const Row* row = rowAt(event->pos())) {
    connect(menu->addAction(QStringLiteral("Edit as a curve")), &QAction::triggered, this,
            [this, address = row->address] { Q_EMIT curveWanted(address); });
  } else if (byMouse && event->pos().x() >= kLabel) {
    const double time = timeToSet(m_session, secondsAt(event->pos().x()), {});
    connect(menu->addAction(QStringLiteral("Add marker here")), &QAction::triggered, this,
            [this, time] { m_session.document().addMarker(time); });
  }
  if (menu->isEmpty()) {
    delete menu;
    return;
  }
  menu->popup(event->globalPos());
}

}  // namespace ps
