// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"
#include "core/simulation/touch.h"
#include "core/solver/matter.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Engine;

/// J by the particles' ids, ascending.
using HeatById = std::vector<std::pair<uint32_t, double>>;

/// What a hand has done that undo takes back.
struct HandDeeds {
  HeatById heat;                ///< that each particle got
  std::vector<TieChange> ties;  ///< one after the other
};

/// A hand that is in matter: where it has been since the last frame, what it does where it is, and what it holds.
class Hand {
 public:
  /// Throws InputError for what cannot be done.
  static void require(const TouchMatter& command, const Engine& engine);
  void move(const TouchMatter& command);
  /// What it does in one frame, at its start. Matter within several balls gets heat from each, as far as their limits
  /// go.
  HandDeeds act(Engine& engine);
  /// There is something that it does, or is yet to do.
  bool isAtWork() const { return !m_path.empty() || !m_still.empty() || !m_letGo.empty(); }
  /// It has let go, all that it did is done, and it feels that no longer. A hand that pushes as it goes is at work in
  /// some frames only.
  bool isGone() const { return !isAtWork() && effort() < kUnfelt; }
  bool hasLetGo() const { return m_still.empty(); }
  /// N, how hard it works, over the last tenth of a second: what pulls at what it holds, without its weight, and how it
  /// pushes and stirs, whichever way.
  double effort() const { return m_effort.pull.norm() + m_effort.push; }

 private:
  static constexpr double kUnfelt = 0.1;  ///< N, below which it feels nothing
  struct Path {
    std::vector<api::Touch> touches;
    double share;  ///< of the time of all paths, for each touch
  };
  struct Held {
    uint32_t id;
    Vector3 offset;  ///< m, from the hand
    double weight;   ///< of its mass
  };
  /// Where what is held was when a frame began into which the hand had moved.
  struct Mark {
    double time;    ///< s, mechanical
    Vector3 place;  ///< m, of the mean
  };
  struct Grip {
    std::vector<Held> held;
    double force = 0;         ///< N, of the last pull
    std::vector<Mark> marks;  ///< the last ones, of a fixed number
  };
  /// Calls something with each touch that acts in a frame, and its share of the frame.
  template <class Visit>
  void forEach(Visit&& visit) const;
  /// All cuts, then all welds.
  std::vector<TieChange> changeTies(Engine& engine, const std::vector<uint8_t>& isSpared) const;
  Reachable reachableBy(api::TouchKind kind, const Engine& engine, const std::vector<uint8_t>& isSpared) const;
  HeatById heat(Engine& engine, const std::vector<uint8_t>& isSpared) const;
  void push(Engine& engine, const std::vector<uint8_t>& isSpared);
  static Grip take(const Engine& engine, const api::Touch& touch, const std::vector<uint8_t>& isSpared);
  static Vector3 hold(const Engine& engine, const api::Touch& touch, const Grip& grip, std::vector<Vector3>& change);
  /// What of it is still there. Its mean place, m, in the image nearest to `near`; its mean velocity, m/s.
  struct Mean {
    double mass = 0;  ///< kg; 0: nothing
    Vector3 place, velocity;
  };
  static Mean meanOf(const Engine& engine, const Grip& grip, const Vector3& near);
  static void note(const Engine& engine, const Vector3& centre, Grip& grip);
  static void throwOn(const Engine& engine, const Grip& grip, std::vector<Vector3>& change);
  struct Effort {
    Vector3 pull{0, 0, 0};  ///< N
    double push = 0;        ///< N
  };
  void feel(const Effort& now, double seconds);

  std::vector<Path> m_path;  ///< one after the other, of about as long
  std::vector<api::Touch> m_still;
  std::vector<api::Touch> m_first;  ///< where it was when it began: there it takes, however far it goes in a frame
  std::vector<std::string> m_spared;
  std::vector<std::optional<Grip>> m_held;  ///< by the touches of m_still; nothing: not yet
  std::vector<Grip> m_letGo;                ///< since the last frame
  bool m_moved = false;                     ///< since then
  Effort m_effort;
};

/// Gives particles heat by their ids, or takes it; those that are gone are left out. What each got.
HeatById giveHeat(Engine& engine, const HeatById& heat);
/// Adds up what particles got.
void addTo(HeatById& sum, const HeatById& more);
/// The same heat the other way round.
HeatById negated(HeatById heat);

}  // namespace ps
