// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/hand.h"

#include "core/base/error.h"
#include "core/simulation/compile.h"
#include "core/simulation/engine.h"
#include "core/simulation/touch.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace ps {
namespace {

constexpr size_t kMostTouches = 100'000;
/// Share of the way to its place that held matter is to go in a frame: all of it would make what is tied to it swing.
constexpr double kFollows = 0.5;
constexpr double kFastest = 20;  // m/s, at which held matter follows a hand that leaps
constexpr size_t kMarks = 3;     // moves of a hand over which the velocity is taken of what it lets go
constexpr double kThrown = 0.1;  // s of simulated time after the last one in which it throws
constexpr double kFelt = 0.1;    // s over which its effort is smoothed: what is held shakes from frame to frame

bool heats(const api::Touch& touch) { return touch.kind == api::TouchKind::Heat; }

/// How firmly a hand holds each particle when it begins, 0 .. 1: those within the ball, and less and less what is tied
/// to them beyond it, falling by e with each radius. Why those too: a block that hangs by a few particles alone would
/// tear at them faster than ties can follow in a step.
std::vector<double> gripOf(const Engine& engine, const api::Touch& touch, const std::vector<uint8_t>& isSpared) {
  constexpr double kLoose = 0.01;  // not worth holding
  const ParticleStore& store = engine.particles();
  const Reached reached = reach(engine, touch, reachable(engine, {&touch, 1}, isSpared));
  std::vector<double> grip(store.size());
  for (size_t k = 0; k < reached.rows.size(); ++k)
    grip[reached.rows[k]] = reached.weights[k] / store.mass()[reached.rows[k]];
  const std::vector<uint32_t> pieces = engine.solver().pieces();
  std::set<uint32_t> held;
  for (const uint32_t row : reached.rows) held.insert(pieces[row]);
  held.erase(Solver::kNoPiece);
  for (size_t row = 0; row < store.size(); ++row) {
    const bool goes = held.contains(pieces[row]) && store.velocity()[row].w > 0;
    if (!goes || (store.body()[row] < isSpared.size() && isSpared[store.body()[row]])) continue;
    const double beyond = offsetOf(store, row, touch.centre).norm() / touch.radius - 1;
    const double tied = std::exp(-std::max(0.0, beyond));
    if (tied > kLoose) grip[row] = std::max(grip[row], tied);
  }
  return grip;
}

HeatById given(Engine& engine, std::vector<double> joules) {
  HeatById heat;
  if (!engine.addHeat(joules)) return heat;
  const uint32_t* id = engine.particles().id();
  for (size_t i = 0; i < joules.size(); ++i) {
    if (joules[i] != 0) heat.emplace_back(id[i], joules[i]);
  }
  std::sort(heat.begin(), heat.end());
  return heat;
}

}  // namespace

void Hand::require(const TouchMatter& command, const Engine& engine) {
  if (command.key == 0 || command.samples < 1) throw InputError("A hand without a name, or without a place");
  if (command.path.size() + command.still.size() > kMostTouches)
    throw InputError("A hand is in more than " + std::to_string(kMostTouches) + " places at a time");
  for (const auto* touches : {&command.path, &command.still}) {
    if (!std::all_of(touches->begin(), touches->end(), canBe))
      throw InputError(
          "A hand needs finite numbers, a radius above 0, a falloff of 0 to 1, a limit of 1 to 10000 K, "
          "no more than 100 m/s, and a blade's normal of length 1");
    if (std::any_of(touches->begin(), touches->end(), heats) && engine.project().solver.thermalModel.empty())
      throw InputError("The scene has no thermal model, so nothing can be heated or cooled: choose one under Solver");
  }
}

void Hand::move(const TouchMatter& command) {
  if (!command.path.empty()) m_path.push_back({command.path, 1.0 / command.samples});
  if (command.still.empty()) {
    for (std::optional<Grip>& grip : m_held) {
      if (grip) m_letGo.push_back(std::move(*grip));
    }
    m_held.clear();
    m_effort.pull = Vector3(0, 0, 0);
  }
  m_moved = true;
  m_still = command.still;
  if (m_first.size() != m_still.size()) m_first = m_still;
  m_spared = command.spared;
  m_held.resize(m_still.size());
}

template <class Visit>
void Hand::forEach(Visit&& visit) const {
  for (const Path& path : m_path) {
    const double share = path.share / static_cast<double>(m_path.size());
    for (const api::Touch& touch : path.touches) visit(touch, share);
  }
  if (!m_path.empty()) return;
  for (const api::Touch& touch : m_still) visit(touch, 1.0);
}

HandDeeds Hand::act(Engine& engine) {
  const std::vector<uint8_t> isSpared = flagged(engine, m_spared);
  HandDeeds done;
  done.ties = changeTies(engine, isSpared);  // first: it may sort the particles
  done.heat = heat(engine, isSpared);
  push(engine, isSpared);
  m_path.clear();
  return done;
}

std::vector<TieChange> Hand::changeTies(Engine& engine, const std::vector<uint8_t>& isSpared) const {
  std::vector<Blade> blades, balls;
  forEach([&](const api::Touch& touch, double) {
    if (touch.kind == api::TouchKind::Cut)
      blades.push_back({vectorOf(touch.centre), touch.radius, vectorOf(touch.normal)});
    if (touch.kind == api::TouchKind::Weld) balls.push_back({vectorOf(touch.centre), touch.radius, {}});
  });
  std::vector<TieChange> changes;
  if (!blades.empty()) changes.push_back(engine.cut(blades, isSpared));
  if (!balls.empty()) changes.push_back(engine.weld(balls, isSpared));
  std::erase_if(changes, [](const TieChange& change) { return change.empty(); });
  return changes;
}

Reachable Hand::reachableBy(api::TouchKind kind, const Engine& engine, const std::vector<uint8_t>& isSpared) const {
  std::vector<api::Touch> touches;
  forEach([&](const api::Touch& touch, double) {
    if (touch.kind == kind) touches.push_back(touch);
  });
  return reachable(engine, touches, isSpared);
}

HeatById Hand::heat(Engine& engine, const std::vector<uint8_t>& isSpared) const {
  const Reachable among = reachableBy(api::TouchKind::Heat, engine, isSpared);
  if (among.rows.empty()) return {};
  const double seconds = compileSettings(engine.project()).dt * compileThermal(engine.project()).timeScale;
  std::vector<double> joules(engine.particles().size());
  forEach([&](const api::Touch& touch, double share) {
    if (heats(touch)) addHeat(engine, touch, seconds * share, among, joules);
  });
  const auto isWarmed = [&](uint32_t row) { return joules[row] != 0; };
  if (std::none_of(among.rows.begin(), among.rows.end(), isWarmed)) return {};
  return given(engine, std::move(joules));
}

void Hand::push(Engine& engine, const std::vector<uint8_t>& isSpared) {
  const Reachable among = reachableBy(api::TouchKind::Push, engine, isSpared);
  const auto holds = [](const api::Touch& touch) { return touch.kind == api::TouchKind::Hold; };
  const bool moved = std::exchange(m_moved, false);
  const double dt = compileSettings(engine.project()).dt;
  if (among.rows.empty() && m_letGo.empty() && std::none_of(m_still.begin(), m_still.end(), holds)) return feel({}, dt);
  std::vector<Vector3> change(engine.particles().size(), Vector3(0, 0, 0));
  forEach([&](const api::Touch& touch, double share) {
    if (touch.kind == api::TouchKind::Push) addPush(engine, touch, dt * share, among, change);
  });
  Effort effort;
  for (const uint32_t row : among.rows) effort.push += double{engine.particles().mass()[row]} * change[row].norm() / dt;
  for (size_t k = 0; k < m_still.size(); ++k) {
    if (!holds(m_still[k])) continue;
    if (!m_held[k]) m_held[k] = take(engine, m_first[k], isSpared);
    if (moved) note(engine, vectorOf(m_still[k].centre), *m_held[k]);
    m_held[k]->force = m_still[k].force;
    effort.pull += hold(engine, m_still[k], *m_held[k], change) / dt;
  }
  feel(effort, dt);
  for (const Grip& grip : std::exchange(m_letGo, {})) throwOn(engine, grip, change);
  engine.addVelocities(change);
}

void Hand::feel(const Effort& now, double seconds) {
  const double share = 1 - std::exp(-seconds / kFelt);
  m_effort.pull += share * (now.pull - m_effort.pull);
  m_effort.push += share * (now.push - m_effort.push);
}

Hand::Grip Hand::take(const Engine& engine, const api::Touch& touch, const std::vector<uint8_t>& isSpared) {
  const ParticleStore& store = engine.particles();
  Grip taken;
  const std::vector<double> grip = gripOf(engine, touch, isSpared);
  for (size_t row = 0; row < grip.size(); ++row) {
    if (grip[row] > 0) taken.held.push_back({store.id()[row], offsetOf(store, row, touch.centre), grip[row]});
  }
  return taken;
}

/// Brings what is held to where it was about the hand, without its weight, as far as the force reaches. kg m/s that it
/// gives beyond that weight.
Vector3 Hand::hold(const Engine& engine, const api::Touch& touch, const Grip& grip, std::vector<Vector3>& change) {
  const ParticleStore& store = engine.particles();
  double total = 0;
  for (const Held& one : grip.held) {
    if (const size_t row = store.indexOf(one.id); row < store.size()) total += one.weight * store.mass()[row];
  }
  const SolverSettings settings = compileSettings(engine.project());
  const Vector3 weight = settings.dt * vectorOf(settings.gravity);
  Vector3 pulled(0, 0, 0);
  for (const Held& one : grip.held) {
    const size_t row = store.indexOf(one.id);
    if (row >= store.size()) continue;
    const Vector3 speed = atMost(kFollows / settings.dt * (one.offset - offsetOf(store, row, touch.centre)), kFastest);
    const Vector3 wanted = speed - weight - vectorOf(store.velocity()[row]) - change[row];
    const Vector3 given = atMost(wanted, touch.force * settings.dt * one.weight / total);
    change[row] += given;
    pulled += double{store.mass()[row]} * (given + weight);
  }
  return pulled;
}

Hand::Mean Hand::meanOf(const Engine& engine, const Grip& grip, const Vector3& near) {
  const ParticleStore& store = engine.particles();
  Mean mean{0, {0, 0, 0}, {0, 0, 0}};
  for (const Held& one : grip.held) {
    const size_t row = store.indexOf(one.id);
    if (row >= store.size()) continue;
    const double mass = store.mass()[row];
    mean.mass += mass;
    mean.place += mass * offsetOf(store, row, double3Of(near));
    mean.velocity += mass * vectorOf(store.velocity()[row]);
  }
  if (mean.mass > 0) mean.place = near + mean.place / mean.mass, mean.velocity /= mean.mass;
  return mean;
}

void Hand::note(const Engine& engine, const Vector3& centre, Grip& grip) {
  const double now = engine.solver().time();
  const Mean mean = meanOf(engine, grip, grip.marks.empty() ? centre : grip.marks.back().place);
  if (mean.mass == 0 || (!grip.marks.empty() && grip.marks.back().time == now)) return;
  if (grip.marks.size() == kMarks) grip.marks.erase(grip.marks.begin());
  grip.marks.push_back({now, mean.place});
}

/// It flies on at the mean velocity that it had from one move of the hand to a later one, as far as the force reaches:
/// a hand may be seen once in several frames, or have moved twice before one, and what it holds leaps and waits then.
void Hand::throwOn(const Engine& engine, const Grip& grip, std::vector<Vector3>& change) {
  if (grip.marks.size() < 2) return;
  const Mark &last = grip.marks.back(), &first = grip.marks.front();
  if (last.time < engine.solver().time() - kThrown) return;  // it has come to rest
  const Mean mean = meanOf(engine, grip, last.place);
  if (mean.mass == 0) return;
  const ParticleStore& store = engine.particles();
  const Vector3 speed = atMost((last.place - first.place) / (last.time - first.time), kFastest);
  const Vector3 more = atMost(speed - mean.velocity, grip.force * compileSettings(engine.project()).dt / mean.mass);
  for (const Held& one : grip.held) {
    if (const size_t row = store.indexOf(one.id); row < store.size()) change[row] += more;
  }
}

HeatById giveHeat(Engine& engine, const HeatById& heat) {
  const ParticleStore& store = engine.particles();
  std::vector<double> joules(store.size());
  for (const auto& [id, one] : heat) {
    if (const size_t row = store.indexOf(id); row < store.size()) joules[row] = one;
  }
  return given(engine, std::move(joules));
}

void addTo(HeatById& sum, const HeatById& more) {
  HeatById all;
  all.reserve(sum.size() + more.size());
  std::merge(sum.begin(), sum.end(), more.begin(), more.end(), std::back_inserter(all),
             [](const auto& a, const auto& b) { return a.first < b.first; });
  size_t last = 0;
  for (size_t k = 1; k < all.size(); ++k) {
    if (all[k].first == all[last].first)
      all[last].second += all[k].second;
    else
      all[++last] = all[k];
  }
  if (!all.empty()) all.resize(last + 1);
  sum = std::move(all);
}

HeatById negated(HeatById heat) {
  for (auto& [id, joules] : heat) joules = -joules;
  return heat;
}

}  // namespace ps
