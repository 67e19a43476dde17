// SPDX-License-Identifier: Apache-2.0
// Keys over time in the inspector: rows set and remove them, and show what they give.
#include "core/scene/track.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/rows/rowcommands.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/session.h"

#include <algorithm>
#include <utility>

namespace ps {

double Inspector::now() const { return m_session.now(); }

ParameterRow* Inspector::rowAtHand() const { return ps::rowAtHand(panels()); }

void Inspector::onKey(const QString& key, const Value& shown) {
  const auto address = Address::parse(key.toStdString());
  const api::ParameterDeclaration* declaration = address ? m_document.declaration(*address) : nullptr;
  if (!declaration) return;
  const Track* track = m_document.track(*address);
  const auto here = track ? keyAt(track->keys, now(), m_document.keySlack()) : std::nullopt;
  if (here) {
    m_document.removeKey(*address, *here);
    return;
  }
  const QString problem = m_document.putKey(*address, now(), numberOfValue(*declaration, shown, 293.15));
  if (!problem.isEmpty()) Q_EMIT keyRefused(QStringLiteral("No key was set."), problem);
}

/// What has keys over time gets one at the time that is shown, or where a drag began: its own value would be hidden by
/// the next frame.
QString Inspector::setOne(const Address& address, const Value& value) {
  const api::ParameterDeclaration* declaration = m_document.track(address) ? m_document.declaration(address) : nullptr;
  if (!declaration) return m_document.setParameter(address, value);
  return m_document.putKey(address, m_editedAt.value_or(now()), numberOfValue(*declaration, value, 293.15));
}

void Inspector::onWay(const QString& key, ToNext way) {
  const auto address = Address::parse(key.toStdString());
  const Track* track = address ? m_document.track(*address) : nullptr;
  if (track) m_document.setWay(*address, keyBehind(track->keys, now(), m_document.keySlack()), way);
}

void Inspector::showTracks() {
  m_shownAt = now();
  std::set<std::string> tracked;
  for (const Track& track : m_document.project().tracks) {
    const auto target = TrackTarget::parse(track.parameter);
    if (!target || track.keys.empty() || !m_document.declaration(target->address)) continue;
    // A curve's row stands on a key where one of its points does.
    const bool first = tracked.insert(target->address.text()).second;
    const double slack = m_document.keySlack();
    const bool onKey = keyAt(track.keys, m_shownAt, slack).has_value();
    if (first || onKey)
      showTrack(target->address, onKey ? KeyMark::OnKey : KeyMark::Between,
                track.keys[keyBehind(track.keys, m_shownAt, slack)].toNext);
  }
  for (const std::string& gone : std::exchange(m_tracked, tracked)) {
    const auto address = Address::parse(gone);
    if (!tracked.contains(gone) && address) showTrack(*address, KeyMark::None, ToNext::Linear);
  }
}

void Inspector::showTrack(const Address& address, KeyMark mark, ToNext way) {
  const QString key = QString::fromStdString(address.text());
  const Value value = m_session.valueNow(address);
  for (ParameterPanel* panel : panels()) {
    panel->setKeyMark(key, mark, way);
    panel->setValue(key, value);
  }
}

}  // namespace ps
