// SPDX-License-Identifier: Apache-2.0
#include "core/scene/track.h"

#include "core/math/monotone.h"
#include "core/parameters/parameterset.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

namespace ps {
namespace {

double length(const std::vector<TrackKey>& keys, size_t piece) { return keys[piece + 1].time - keys[piece].time; }

double secant(const std::vector<TrackKey>& keys, size_t piece) {
  return (keys[piece + 1].value - keys[piece].value) / length(keys, piece);
}

bool steps(const std::vector<TrackKey>& keys, size_t piece) { return keys[piece].toNext == ToNext::Step; }

/// Of a monotone cubic, at one end of a piece. `beyond`: whether the end is the piece's later one.
double monotoneSlope(const std::vector<TrackKey>& keys, size_t piece, bool beyond) {
  const size_t pieces = keys.size() - 1;
  const bool hasBefore = piece > 0 && !steps(keys, piece - 1);
  const bool hasAfter = piece + 1 < pieces && !steps(keys, piece + 1);
  const double h = length(keys, piece), d = secant(keys, piece);
  if (beyond ? hasAfter : hasBefore) {
    const size_t other = beyond ? piece + 1 : piece - 1, first = std::min(piece, other);
    return innerSlope(length(keys, first), length(keys, first + 1), secant(keys, first), secant(keys, first + 1));
  }
  if (beyond ? hasBefore : hasAfter) {
    const size_t inner = beyond ? piece - 1 : piece + 1;
    return endSlope(h, length(keys, inner), d, secant(keys, inner));
  }
  return d;
}

}  // namespace

double slopeAfter(const std::vector<TrackKey>& keys, size_t key) {
  if (keys[key].slopeAfter) return *keys[key].slopeAfter;
  return key + 1 < keys.size() ? monotoneSlope(keys, key, false) : 0;
}

double slopeBefore(const std::vector<TrackKey>& keys, size_t key) {
  if (keys[key].slopeBefore) return *keys[key].slopeBefore;
  return key > 0 ? monotoneSlope(keys, key - 1, true) : 0;
}

std::optional<double> trackValue(const std::vector<TrackKey>& keys, double time, double slack) {
  const auto after = std::upper_bound(keys.begin(), keys.end(), time + slack,
                                      [](double t, const TrackKey& key) { return t < key.time; });
  if (after == keys.begin()) return std::nullopt;
  const auto k = static_cast<size_t>(after - keys.begin()) - 1;
  const TrackKey& from = keys[k];
  if (after == keys.end() || from.toNext == ToNext::Step || time - from.time <= slack) return from.value;
  const TrackKey& to = *after;
  const double h = to.time - from.time, t = (time - from.time) / h;
  if (from.toNext == ToNext::Linear) return from.value + t * (to.value - from.value);
  // From the key on, so that a piece between equal values has just these. Slopes of any file may be too steep to count.
  const double way = hermite(t, 0, slopeAfter(keys, k) * h, to.value - from.value, slopeBefore(keys, k + 1) * h);
  return std::isfinite(way) ? from.value + way : from.value;
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

const std::vector<std::string>& toNextNames() {
  static const std::vector<std::string> names{"step", "linear", "smooth"};
  return names;
}

}  // namespace ps
