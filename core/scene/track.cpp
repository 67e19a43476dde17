// SPDX-License-Identifier: Apache-2.0
#include "core/scene/track.h"

#include "core/parameters/parameterset.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

namespace ps {

std::optional<double> trackValue(const std::vector<TrackKey>& keys, double time, double slack) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time + slack,
                                      [](double t, const TrackKey& key) { return t < key.time; });
  if (after == keys.begin()) return std::nullopt;
  const auto k = static_cast<size_t>(after - keys.begin()) - 1;
  const TrackKey& from = keys[k];
  if (after == keys.end() || from.toNext == ToNext::Step || time - from.time <= slack) return from.value;
  return valueOn(keys, k, time);
}

std::optional<KeyProblem> problemOfKeys(const std::vector<TrackKey>& keys) {
  for (size_t k = 0; k < keys.size(); ++k) {
    const TrackKey& key = keys[k];
    for (const double number : {key.time, key.value, key.slopeBefore.value_or(0), key.slopeAfter.value_or(0)}) {
      if (!std::isfinite(number)) return KeyProblem{k, "is not a finite number"};
    }
    if (k == 0 || key.time > keys[k - 1].time) continue;
    const std::string before = numberText(keys[k - 1].time) + " s";
    if (key.time == keys[k - 1].time) return KeyProblem{k, "is of the same time as the key before it, " + before};
    return KeyProblem{k, "must come after the key before it, at " + before + ": keys stand in order of time"};
  }
  return std::nullopt;
}

std::vector<CurvePoint> turnsOf(const std::vector<TrackKey>& keys) {
  std::vector<CurvePoint> turns;
  for (size_t piece = 0; piece + 1 < keys.size(); ++piece) {
    for (const double time : turnsOn(keys, piece)) turns.push_back({time, valueOn(keys, piece, time)});
  }
  return turns;
}

std::optional<TrackTarget> TrackTarget::parse(std::string_view parameter) {
  TrackTarget target;
  if (parameter.ends_with(']')) {
    const size_t open = parameter.rfind('[');
    const std::string_view digits = open == std::string_view::npos ? "" : parameter.substr(open + 1);
    size_t point = 0;
    const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), point);
    if (problem != std::errc() || end + 1 != digits.data() + digits.size()) return std::nullopt;
    target.point = point;
    parameter = parameter.substr(0, open);
  }
  const std::optional<Address> address = Address::parse(parameter);
  if (!address) return std::nullopt;
  target.address = *address;
  return target;
}

bool hasOwner(const Project& project, const Address& address) {
  return findSet(project, address) || outsideValue(project, address);
}

std::vector<Track> ownedTracks(const Project& project) {
  std::vector<Track> owned;
  std::copy_if(project.tracks.begin(), project.tracks.end(), std::back_inserter(owned), [&](const Track& track) {
    const std::optional<TrackTarget> target = TrackTarget::parse(track.parameter);
    return target && hasOwner(project, target->address);
  });
  return owned;
}

const Track* findTrack(const std::vector<Track>& tracks, std::string_view parameter) {
  const auto found =
      std::find_if(tracks.begin(), tracks.end(), [&](const Track& track) { return track.parameter == parameter; });
  return found == tracks.end() ? nullptr : &*found;
}

std::optional<size_t> keyAt(const std::vector<TrackKey>& keys, double time, double slack) {
  std::optional<size_t> nearest;
  for (size_t k = 0; k < keys.size(); ++k) {
    const double away = std::abs(keys[k].time - time);
    if (away <= slack && (!nearest || away < std::abs(keys[*nearest].time - time))) nearest = k;
  }
  return nearest;
}

size_t keyBehind(const std::vector<TrackKey>& keys, double time, double slack) {
  size_t behind = 0;
  while (behind + 1 < keys.size() && keys[behind + 1].time <= time + slack) ++behind;
  return behind;
}

size_t putKey(std::vector<TrackKey>& keys, const TrackKey& key, double slack) {
  if (const std::optional<size_t> old = keyAt(keys, key.time, slack))
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(*old));
  const auto place = std::upper_bound(keys.begin(), keys.end(), key.time,
                                      [](double t, const TrackKey& other) { return t < other.time; });
  const auto put = keys.insert(place, key);
  return static_cast<size_t>(put - keys.begin());
}

}  // namespace ps
