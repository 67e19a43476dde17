// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ps {

/// The value that keys give at a time in s; nothing before the first key, from the last one on that one's value.
/// `slack` s before a key its time has come: a clock that adds up frames is never quite on it. Keys must ascend in
/// time; what lies between them is in core/math/pieces.h.
std::optional<double> trackValue(const std::vector<TrackKey>& keys, double time, double slack = 0);

/// "" or what is wrong with the keys by themselves, and with which: "must come after the key before it, at 2 s".
struct KeyProblem {
  size_t key = 0;
  std::string what;
};
std::optional<KeyProblem> problemOfKeys(const std::vector<TrackKey>& keys);
/// Where stated slopes lead the values between keys to a least or greatest one, in s, and to which.
std::vector<CurvePoint> turnsOf(const std::vector<TrackKey>& keys);

/// What a track animates: a parameter, or one point of a curve over temperature, whose address has the point's number
/// in brackets behind it, counted from 0: "material/wax/viscosity[2]".
struct TrackTarget {
  Address address;  ///< without the point
  std::optional<size_t> point{};
  static std::optional<TrackTarget> parse(std::string_view parameter);
};

/// Whether the project has what an address is a parameter of, whatever declares it.
bool hasOwner(const Project& project, const Address& address);
/// Tracks of what the project has: those of a body that has gone wait for its return, and are not saved.
std::vector<Track> ownedTracks(const Project& project);
/// The track of an address, or nullptr.
const Track* findTrack(const std::vector<Track>& tracks, std::string_view parameter);
/// The key within `slack` s of a time; nothing where there is none.
std::optional<size_t> keyAt(const std::vector<TrackKey>& keys, double time, double slack);
/// The last key that a time has come to, within `slack` s; the first where it has come to none. There must be one.
size_t keyBehind(const std::vector<TrackKey>& keys, double time, double slack);
/// Puts a key in its place in time, instead of one within `slack` s of it. Returns where it is.
size_t putKey(std::vector<TrackKey>& keys, const TrackKey& key, double slack);

}  // namespace ps
