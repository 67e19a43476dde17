// SPDX-License-Identifier: Apache-2.0
// Tracks of a document: keys come, move, change and go; each edit is a command.
#include "core/scene/track.h"
#include "core/simulation/tracks.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// "" or what people read of a key that cannot be.
QString problemWithKeys(const std::vector<TrackKey>& keys, const api::ParameterDeclaration& declaration) {
  if (const auto problem = problemOfKeys(keys))
    return QStringLiteral("A key %1.").arg(QString::fromStdString(problem->what));
  for (const TrackKey& key : keys) {
    const std::string problem = problemOfKey(key, declaration);
    if (!problem.empty())
      return QString::fromUtf8(declaration.label) + QLatin1Char(' ') + QString::fromStdString(problem) +
             QLatin1Char('.');
  }
  return {};
}

}  // namespace

const Track* Document::track(const Address& address) const { return findTrack(m_project.tracks, address.text()); }

double Document::keySlack() const { return 0.5 * numberOf(m_project.solver.parameters, solverParameters(), "dt"); }

const api::ParameterDeclaration* Document::keyDeclaration(const Address& address) const {
  const auto target = TrackTarget::parse(address.text());
  return target ? declaration(target->address) : nullptr;
}

QString Document::whyNoKeys(const Address& address) const {
  const auto target = TrackTarget::parse(address.text());
  const std::string why = ps::whyNoKeys(m_project, m_plugins, target.value_or(TrackTarget{address}));
  return why.empty() ? QString() : QString::fromStdString(why) + QLatin1Char('.');
}

QString Document::putKey(const Address& address, double time, double value) {
  if (const QString why = whyNoKeys(address); !why.isEmpty()) return why;
  const Track* old = track(address);
  std::vector<TrackKey> keys = old ? old->keys : std::vector<TrackKey>{};
  TrackKey key{std::max(0.0, std::round(time * 1e6) / 1e6),
               value};  // a clock that adds up frames is never quite on a round number
  const auto before = std::find_if(keys.rbegin(), keys.rend(), [&](const TrackKey& k) { return k.time <= key.time; });
  if (keyDeclaration(address)->kind == api::ParameterKind::Toggle)
    key.toNext = ToNext::Step;
  else if (before != keys.rend())
    key.toNext = before->toNext;
  if (const auto here = keyAt(keys, key.time, keySlack())) {
    const TrackKey present = keys[*here];
    key = present;
    key.value = value;
  }
  ps::putKey(keys, key, keySlack());
  return setKeys(address, std::move(keys), QStringLiteral("key of %1").arg(trackTitle(address)));
}

QString Document::moveKey(const Address& address, size_t index, double time, double value) {
  const Track* old = track(address);
  if (!old || index >= old->keys.size()) return {};
  std::vector<TrackKey> keys = old->keys;
  // It stays between its neighbours.
  const double least = index > 0 ? keys[index - 1].time + 2 * keySlack() : 0;
  const double most = index + 1 < keys.size() ? keys[index + 1].time - 2 * keySlack() : 1e9;
  keys[index].time =
      std::round(std::clamp(time, std::min(least, keys[index].time), std::max(most, keys[index].time)) * 1e6) / 1e6;
  keys[index].value = value;
  return setKeys(address, std::move(keys), QStringLiteral("moving a key of %1").arg(trackTitle(address)));
}

void Document::removeKey(const Address& address, size_t index) {
  const Track* old = track(address);
  if (!old || index >= old->keys.size()) return;
  std::vector<TrackKey> keys = old->keys;
  keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(index));
  setKeys(address, std::move(keys), QStringLiteral("removal of a key of %1").arg(trackTitle(address)));
}

QString Document::setWay(const Address& address, size_t index, ToNext way) {
  const Track* old = track(address);
  if (!old || index >= old->keys.size()) return {};
  const api::ParameterDeclaration* declared = keyDeclaration(address);
  if (declared && declared->kind == api::ParameterKind::Toggle && way != ToNext::Step)
    return QStringLiteral("A switch has no values between on and off.");
  std::vector<TrackKey> keys = old->keys;
  keys[index].toNext = way;
  return setKeys(address, std::move(keys), QStringLiteral("way between keys of %1").arg(trackTitle(address)));
}

void Document::removeTrack(const Address& address) {
  const QString text = QStringLiteral("removal of the keys of %1").arg(trackTitle(address));
  if (track(address)) {
    setKeys(address, {}, text);
    return;
  }
  std::vector<Address> points;
  for (const Track& each : m_project.tracks) {
    const auto target = TrackTarget::parse(each.parameter);
    if (target && target->point && target->address == address) points.push_back(*Address::parse(each.parameter));
  }
  if (points.empty()) return;
  m_undo.beginMacro(text);
  for (const Address& point : points) setKeys(point, {}, text);
  m_undo.endMacro();
}

QString Document::trackTitle(const Address& address) const {
  const api::ParameterDeclaration* declared = keyDeclaration(address);
  const QString label = declared ? QString::fromUtf8(declared->label) : QString::fromStdString(address.key);
  const auto target = TrackTarget::parse(address.text());
  const QString point = target && target->point ? QStringLiteral(", point %1").arg(*target->point) : QString();
  return QStringLiteral("%1 of %2%3").arg(label, ownerLabel(m_project, address), point);
}

/// Without keys there is no track.
QString Document::setKeys(const Address& address, std::vector<TrackKey> keys, const QString& text) {
  const std::vector<Track>& tracks = m_project.tracks;
  const Track* old = track(address);
  TrackEdit edit;
  edit.index = old ? static_cast<size_t>(old - tracks.data()) : tracks.size();
  if (old) edit.before = *old;
  if (!keys.empty()) {
    if (const api::ParameterDeclaration* declared = keyDeclaration(address)) {
      if (const QString problem = problemWithKeys(keys, *declared); !problem.isEmpty()) return problem;
    }
    edit.after = old ? *old : Track{address.text(), {}, {}};
    edit.after->keys = std::move(keys);
  }
  if (edit.before == edit.after && m_gestureDepth == 0) return {};
  if (m_gestureDepth == 0) ++m_gesture;
  m_undo.push(new TrackCommand(*this, std::move(edit), m_gesture, text));
  return {};
}

void Document::applyTrack(const TrackEdit& edit, bool forward) {
  const std::optional<Track>&from = forward ? edit.before : edit.after, &to = forward ? edit.after : edit.before;
  std::vector<Track>& tracks = m_project.tracks;
  const auto place = tracks.begin() + static_cast<std::ptrdiff_t>(edit.index);
  if (from && to)
    *place = *to;
  else if (to)
    tracks.insert(place, *to);
  else if (from)
    tracks.erase(place);
  ++m_changes;
  notify(TracksChanged{(to ? to : from).value_or(Track{}).parameter});
}

}  // namespace ps
