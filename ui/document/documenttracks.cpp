// SPDX-License-Identifier: Apache-2.0
// Tracks of a document: keys come, move, change and go; each edit is a command.
#include "core/scene/track.h"
#include "core/simulation/tracks.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/theme/numbers.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// "must be at least −272.2 °C, not −280 °C": in the units in which people see it; "" where it is in range.
std::string outOfRange(double value, const api::ParameterDeclaration& declaration) {
  const std::string problem = rangeProblem(value, declaration.hardMinimum, declaration.hardMaximum, declaration.unit);
  if (problem.empty() || !std::isfinite(value)) return problem;
  const bool low = value < declaration.hardMinimum;
  return QStringLiteral("must be at %1 %2, not %3")
      .arg(low ? QStringLiteral("least") : QStringLiteral("most"),
           formatBound(declaration, low ? declaration.hardMinimum : declaration.hardMaximum),
           formatBound(declaration, value))
      .toStdString();
}

/// "" or what people read of a key that cannot be. What was there before is nobody's fault who edits another key.
QString problemWithKeys(const std::vector<TrackKey>& keys, const Track* old,
                        const api::ParameterDeclaration& declaration) {
  if (const auto problem = problemOfKeys(keys))
    return QStringLiteral("A key %1.").arg(QString::fromStdString(problem->what));
  for (const TrackKey& key : keys) {
    if (old && std::find(old->keys.begin(), old->keys.end(), key) != old->keys.end()) continue;
    const std::string outside = outOfRange(key.value, declaration);
    const std::string problem = outside.empty() ? problemOfKey(key, declaration) : outside;
    if (!problem.empty())
      return QStringLiteral("%1 at %2 s %3.")
          .arg(QString::fromUtf8(declaration.label), QString::fromStdString(numberText(key.time)),
               QString::fromStdString(problem));
  }
  const std::vector<CurvePoint> before = old ? turnsOf(old->keys) : std::vector<CurvePoint>{};
  for (const CurvePoint& turn : turnsOf(keys)) {
    if (std::find(before.begin(), before.end(), turn) != before.end()) continue;
    const std::string problem = outOfRange(turn.y, declaration);
    if (!problem.empty())
      return QStringLiteral("%1 at %2 s, where the slopes of its keys lead, %3.")
          .arg(QString::fromUtf8(declaration.label), QString::fromStdString(numberText(turn.x)),
               QString::fromStdString(problem));
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
  return setKeys({{address, std::move(keys)}}, QStringLiteral("key of %1").arg(trackTitle(address)));
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
  return setKeys({{address, std::move(keys)}}, QStringLiteral("moving a key of %1").arg(trackTitle(address)));
}

void Document::removeKey(const Address& address, size_t index) {
  const Track* old = track(address);
  if (!old || index >= old->keys.size()) return;
  std::vector<TrackKey> keys = old->keys;
  keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(index));
  setKeys({{address, std::move(keys)}}, QStringLiteral("removal of a key of %1").arg(trackTitle(address)));
}

QString Document::setWay(const Address& address, size_t index, ToNext way) {
  const Track* old = track(address);
  if (!old || index >= old->keys.size()) return {};
  const api::ParameterDeclaration* declared = keyDeclaration(address);
  if (declared && declared->kind == api::ParameterKind::Toggle && way != ToNext::Step)
    return QStringLiteral("A switch has no values between on and off.");
  std::vector<TrackKey> keys = old->keys;
  keys[index].toNext = way;
  return setKeys({{address, std::move(keys)}}, QStringLiteral("way between keys of %1").arg(trackTitle(address)));
}

void Document::removeTrack(const Address& address) {
  const QString text = QStringLiteral("removal of the keys of %1").arg(trackTitle(address));
  if (track(address)) {
    setKeys({{address, {}}}, text);
    return;
  }
  std::vector<Address> points;
  for (const Track& each : m_project.tracks) {
    const auto target = TrackTarget::parse(each.parameter);
    if (target && target->point && target->address == address) points.push_back(*Address::parse(each.parameter));
  }
  std::vector<Keys> none;
  none.reserve(points.size());
  for (const Address& point : points) none.push_back({point, {}});
  setKeys(none, text);
}

QString Document::trackTitle(const Address& address) const {
  const api::ParameterDeclaration* declared = keyDeclaration(address);
  const QString label = declared ? QString::fromUtf8(declared->label) : QString::fromStdString(address.key);
  const auto target = TrackTarget::parse(address.text());
  const QString point = target && target->point ? QStringLiteral(", point %1").arg(*target->point) : QString();
  return QStringLiteral("%1 of %2%3").arg(label, ownerLabel(m_project, address), point);
}

/// Without keys there is no track.
QString Document::setKeys(const std::vector<Keys>& wanted, const QString& text) {
  std::vector<Track> tracks = m_project.tracks;
  std::vector<TrackEdit> edits;
  for (const auto& [address, keys] : wanted) {
    const Track* old = findTrack(tracks, address.text());
    TrackEdit edit;
    edit.index = old ? static_cast<size_t>(old - tracks.data()) : tracks.size();
    if (old) edit.before = *old;
    if (!keys.empty()) {
      if (const api::ParameterDeclaration* declared = keyDeclaration(address)) {
        if (const QString problem = problemWithKeys(keys, old, *declared); !problem.isEmpty()) return problem;
      }
      edit.after = old ? *old : Track{address.text(), {}, {}};
      edit.after->keys = keys;
    }
    if (edit.before == edit.after && (m_gestureDepth == 0 || !edit.before)) continue;
    const auto place = tracks.begin() + static_cast<std::ptrdiff_t>(edit.index);
    if (edit.before && edit.after)
      *place = *edit.after;
    else if (edit.after)
      tracks.push_back(*edit.after);
    else if (edit.before)
      tracks.erase(place);
    edits.push_back(std::move(edit));
  }
  if (edits.empty()) return {};
  if (m_gestureDepth == 0) ++m_gesture;
  m_undo.push(new TrackCommand(*this, std::move(edits), m_gesture, text));
  return {};
}

/// The tracks of a curve's points follow them to their new numbers, where points come or go; those of points that have
/// gone go with them.
std::vector<TrackEdit> Document::tracksAfter(const Address& curve, const Value& after) const {
  const Response from = responseOf(value(curve)), to = responseOf(after);
  const bool curves = from.kind == Response::Kind::Curve && to.kind == Response::Kind::Curve;
  std::vector<TrackEdit> edits;
  if (!curves || from.points.size() == to.points.size()) return edits;
  size_t gone = 0;
  for (size_t t = 0; t < m_project.tracks.size(); ++t) {
    const Track& track = m_project.tracks[t];
    const auto target = TrackTarget::parse(track.parameter);
    if (!target || !target->point || !(target->address == curve) || *target->point >= from.points.size()) continue;
    const auto there = std::find_if(to.points.begin(), to.points.end(),
                                    [&](const CurvePoint& p) { return p.x == from.points[*target->point].x; });
    TrackEdit edit{t - gone, track, std::nullopt};
    if (there != to.points.end()) {
      edit.after = track;
      edit.after->parameter = curve.text() + '[' + std::to_string(there - to.points.begin()) + ']';
    } else {
      ++gone;
    }
    if (!(edit.before == edit.after)) edits.push_back(std::move(edit));
  }
  return edits;
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
  if (from && to && from->parameter != to->parameter) notify(TracksChanged{from->parameter});
  notify(TracksChanged{(to ? to : from).value_or(Track{}).parameter});
}

}  // namespace ps
