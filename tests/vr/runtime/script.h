// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/pose.h"

#include <nlohmann/json.hpp>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ps::scripted {

/// Applies from the first frame on that is not before `frame`; before any frame is waited for, the frame is -1.
struct ScriptEvent {
  double frame = -1;
  nlohmann::json what;  ///< one of the kinds that the README beside this file lists
};

/// Controller or hand at a time. Inputs by component: "/input/trigger/value".
struct HandState {
  bool active = true;   ///< switched on and awake
  bool tracked = true;  ///< false: where it is, is a guess
  std::map<std::string, float, std::less<>> inputs;
  std::string shape;  ///< of a bare hand, among kHandShapes; "": none is seen
};

/// What happens in a run of the runtime: what is on offer, how head and hands move, and what goes wrong. The README
/// beside this file describes the JSON. Times are frames of the virtual clock, whole or not.
class Script {
 public:
  /// Throws InputError "FILE:/events/0/fail: ..." where something is amiss. An empty path is an empty script.
  explicit Script(const std::string& path);
  /// Goes on with what another one does from its frame 0, as if that were the frame `begin` here. What is on offer is
  /// not changed by it.
  void goOn(Script&& later, int64_t begin);

  XrPosef head(double frame) const;  ///< in the stage, whose origin is on the floor
  XrPosef grip(size_t hand, double frame) const;
  XrPosef aim(size_t hand, double frame) const;  ///< the grip's where the script says none
  HandState hand(size_t hand, double frame) const;
  bool wantsPicture(int64_t frame) const { return m_pictures.count(frame) > 0; }

  std::array<std::string, 2> profile;  ///< of the left and the right hand at first
  int width = 512, height = 512;       ///< recommended pixels of an eye
  float fieldOfView = 1.5707963f;      ///< rad, of each eye, upright and across
  float eyeDistance = 0.063f;          ///< m
  double period = 1.0 / 90;            ///< s, of a frame
  bool realTime = false;               ///< frames last as long as they say
  std::vector<std::string> extensions;
  std::vector<float> refreshRates = {72, 90, 120};  ///< Hz, that can be asked for
  float hiddenCorners = 0.3f;                       ///< of half a window's side, that the mask hides at each corner
  bool seesHands = true;                            ///< joints of bare hands can be located
  bool stage = true;                                ///< there is a space of the floor
  std::vector<int64_t> formats;                     ///< of OpenGL, the preferred one first
  std::vector<ScriptEvent> events;                  ///< by frame

 private:
  struct Key {
    double frame;
    XrPosef pose;
  };
  struct HandKey {
    double frame;
    std::optional<bool> active, tracked;
    std::map<std::string, float> inputs;
    std::optional<std::string> shape;
  };
  using Track = std::vector<Key>;
  friend class ScriptReader;

  static XrPosef at(const Track& track, double frame, const XrPosef& otherwise);

  int64_t m_begin = 0;  ///< the frame from which those of the keys count
  Track m_head;
  std::array<Track, 2> m_grip, m_aim;
  std::array<std::vector<HandKey>, 2> m_hands;
  std::set<int64_t> m_pictures;
};

/// All extensions that this runtime can offer.
const std::vector<std::string>& knownExtensions();

}  // namespace ps::scripted
