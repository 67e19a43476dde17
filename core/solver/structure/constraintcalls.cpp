// SPDX-License-Identifier: Apache-2.0
// The part of ConstraintSystem that calls plugins of structure and of neighbours, batch by batch.
#include "core/base/error.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

namespace ps {
namespace {

constexpr size_t kLongestName = 200, kMostLimits = 100;  // of a body
/// Constraints that a thread projects at a time: the colours of a scene of 80,000 particles have some ten thousand.
constexpr size_t kProjected = 256;

/// J that a plugin says.
double finite(double joules) {
  if (!std::isfinite(joules)) throw Error("its energy is not a finite number");
  return joules;
}

/// A run of constraints with pointers to its values; lives while a plugin is called.
struct BatchView {
  std::array<float*, GroupLists::kMostValues> values{};
  api::ConstraintBatch batch{};
};

}  // namespace

template <class Call>
void ConstraintSystem::forRuns(const Set& set, size_t first, size_t last, Call&& call) {
  auto run =
      std::upper_bound(set.runs.begin(), set.runs.end(), first, [](size_t k, const Run& r) { return k < r.first; });
  for (--run; first < last; ++run) {
    const size_t end = run + 1 == set.runs.end() ? last : std::min(last, (run + 1)->first);
    call(run->body, first, end);
    first = end;
  }
}

template <class Call>
void ConstraintSystem::forBatches(Set& set, uint32_t substep, uint32_t iteration, Call&& call, size_t chunk) {
  const auto run = [&](size_t first, size_t last) {
    const CalleeScope callee(set.name.c_str());
    forRuns(set, first, last, [&](uint32_t body, size_t from, size_t to) {
      BatchView view;
      for (size_t v = 0; v < set.valueCount; ++v) view.values[v] = set.values[v].data() + from;
      view.batch = {to - from, set.particles.data() + from * set.arity, view.values.data()};
      call(context(set, substepTime(), substep, iteration, body), view.batch);
    });
  };
  for (size_t colour = 0; colour + 1 < set.colourStart.size(); ++colour) {
    const size_t begin = set.colourStart[colour], count = set.colourStart[colour + 1] - begin;
    if (count == 0) continue;
    if (count <= chunk)
      run(begin, begin + count);
    else
      forChunks(
          count, chunk, [&](size_t first, size_t last) { run(begin + first, begin + last); }, set.cost);
  }
}

void ConstraintSystem::predict(ParticleStore& store, uint32_t substep) {
  const api::ParticleView view = store.view();
  for (Set& set : m_sets) {
    guarded(set, [&] {
      forBatches(set, substep, 0, [&](const auto& c, const auto& b) { set.structural->predict(c, view, b); });
    });
  }
  predictGroups(store, substep);
}

void ConstraintSystem::linearise(Set& set, const api::ParticleView& view, uint32_t substep) {
  set.pull.resize(set.count);
  set.stiffness.resize(set.count);
  const bool done = guarded(set, [&] {
    forBatches(set, substep, 0, [&](const auto& c, const api::ConstraintBatch& b) {
      const size_t first = static_cast<size_t>(b.particles - set.particles.data()) / 2;
      set.springs->linearise(c, view, b, set.pull.data() + first, set.stiffness.data() + first);
    });
  });
  if (!done || substep != 0) return;
  m_carried.add({set.colourStart, set.particles.data(), set.pull.data(), set.stiffness.data(),
                 set.values[set.springs->multiplier()].data()});
}

void ConstraintSystem::findHeld(const ParticleStore& store) {
  m_held.clear();
  if (std::none_of(m_sets.begin(), m_sets.end(), [](const Set& set) { return set.springs && set.count > 0; })) return;
  const StructureGraph& ties = graph(store.size());
  findIndices(store.size(), m_openHeld,
              [&](size_t i) { return store.velocity()[i].w == 0 && ties.begin[i + 1] > ties.begin[i]; });
  if (m_openHeld.empty()) return;
  m_held.assign(store.size(), 0);
  for (const uint32_t i : m_openHeld) m_held[i] = 1;
  while (!m_openHeld.empty()) {
    const uint32_t i = m_openHeld.back();
    m_openHeld.pop_back();
    for (uint32_t k = ties.begin[i]; k < ties.begin[i + 1]; ++k) {
      const uint32_t j = ties.partner[k];
      if (m_held[j] != 0) continue;
      m_held[j] = 1;
      m_openHeld.push_back(j);
    }
  }
}

void ConstraintSystem::carry(ParticleStore& store, uint32_t substep) {
  if (substep == 0) m_carried.clear();
  if (substep == 0 ? m_held.empty() : !m_carried.any()) return;
  const api::ParticleView view = store.view();
  for (Set& set : m_sets) {
    if (set.springs && !set.disabled && set.count > 0) linearise(set, view, substep);
  }
  if (substep == 0) m_carried.number(store);
  if (m_carried.any()) m_carried.solve(store, substepTime(), m_settings.spacing);
}

void ConstraintSystem::projectStructure(ParticleStore& store, uint32_t substep, uint32_t iteration) {
  const api::ParticleView view = store.view();
  const api::MovableParticles particles = movable(store, view);
  for (Set& set : m_sets) {
    moving(set, store, [&] {
      forBatches(
          set, substep, iteration, [&](const auto& c, const auto& b) { set.structural->project(c, particles, b); },
          kProjected);
    });
  }
}

/// Every correction comes from the places that all had before; then each particle takes its own.
void ConstraintSystem::projectNeighbours(ParticleStore& store, const Neighbours& neighbours, uint32_t substep,
                                         uint32_t iteration) {
  const api::ParticleView view = store.view();
  const api::NeighbourView lists = neighbours.view();
  for (Set& set : m_sets) {
    if (!set.neighbour || set.disabled) continue;
    findMembers(set, store);
    m_correction.assign(set.members.size(), api::Float4{0, 0, 0, 0});
    const api::ConstraintContext c = context(set, substepTime(), substep, iteration);
    const bool done = guarded(set, [&] {
      forChunks(set.members.size(), grain::kNeighbours, [&](size_t first, size_t last) {
        const CalleeScope callee(set.name.c_str());
        set.neighbour->gather(c, view, lists, {set.members.data() + first, last - first}, m_correction.data() + first);
      });
    });
    if (!done) continue;
    moving(set, store, [&] { applyCorrections(set, store); });
  }
}

void ConstraintSystem::applyCorrections(const Set& set, ParticleStore& store) const {
  forChunks(set.members.size(), grain::kConstraints, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = set.members[k];
      if (store.velocity()[i].w == 0) continue;
      api::Float4& position = store.position()[i];
      position.x += m_correction[k].x;
      position.y += m_correction[k].y;
      position.z += m_correction[k].z;
    }
  });
}

void ConstraintSystem::watch(double metres) {
  m_watched = metres;
  m_culprit.clear();
}

bool ConstraintSystem::leapt(const ParticleStore& store) const {
  const auto most = static_cast<float>(m_watched * m_watched);
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Float4 &now = store.position()[i], &then = m_before[i];
    const float x = now.x - then.x, y = now.y - then.y, z = now.z - then.z;
    if (!(x * x + y * y + z * z <= most)) return true;
  }
  return false;
}

void ConstraintSystem::findMembers(Set& set, const ParticleStore& store) const {
  if (set.membersOf == store.size()) return;
  findIndices(store.size(), set.members, [&](size_t i) {
    const uint32_t body = store.body()[i];
    return body < set.used.size() && set.used[body] != 0;
  });
  set.membersOf = store.size();
}

void ConstraintSystem::forgetMembers() {
  for (Set& set : m_sets) set.membersOf = ~size_t{0};
}

void ConstraintSystem::deriveVelocities(ParticleStore& store, uint32_t substep) {
  const api::ParticleView view = store.view();
  const api::MovableParticles particles = movable(store, view);
  for (Set& set : m_sets) {
    guarded(set, [&] {
      forBatches(set, substep, 0,
                 [&](const auto& c, const auto& b) { set.structural->deriveVelocities(c, particles, b); });
    });
  }
  deriveGroupVelocities(store, substep);
}

double ConstraintSystem::energy(const ParticleStore& store) {
  double sum = 0;
  for (Set& set : m_sets) {
    if (set.groups) sum += groupEnergy(set, store);
    if (set.count == 0) continue;
    guarded(set, [&] {
      forRuns(set, 0, set.count, [&](uint32_t body, size_t first, size_t last) {
        BatchView view;
        for (size_t v = 0; v < set.valueCount; ++v) view.values[v] = set.values[v].data() + first;
        view.batch = {last - first, set.particles.data() + first * set.arity, view.values.data()};
        sum += finite(set.structural->energy(context(set, substepTime(), 0, 0, body), store.view(), view.batch));
      });
    });
  }
  return sum;
}

void ConstraintSystem::limits(const ParticleStore& store, std::vector<Limit>& out) {
  /// Bodies of one material meet the same limit: the one that is missed by most is reported. A parameter of the plugin
  /// is each body's own.
  class Collect final : public api::LimitSink {
   public:
    explicit Collect(std::vector<Limit>& limits) : m_limits(limits) {}
    void limit(const char* what, double asked, double delivered, const char* unit) override {
      if (!what || !unit) throw Error("reported a limit without a name or unit");
      if (!std::isfinite(asked) || !std::isfinite(delivered))
        throw Error("reported a limit that is not a finite number");
      if (std::strlen(what) > kLongestName || std::strlen(unit) > kLongestName || ++reported > kMostLimits)
        throw Error("reported more limits, or longer ones, than anybody could read");
      const int body = std::string_view(what).starts_with(plugin + ".") ? asking : -1;
      const auto found = std::find_if(m_limits.begin(), m_limits.end(),
                                      [&](const Limit& l) { return l.what == what && l.body == body; });
      if (found == m_limits.end()) {
        m_limits.push_back({what, asked, delivered, unit, body});
      } else if (asked * found->delivered > found->asked * delivered) {
        found->asked = asked, found->delivered = delivered;
      }
    }
    std::string plugin;
    int asking = -1;
    size_t reported = 0;

   private:
    std::vector<Limit>& m_limits;
  } sink(out);
  if (m_held.size() != store.size()) findHeld(store);  // as of particles that have come since the last frame
  for (Set& set : m_sets) {
    sink.plugin = set.name;
    for (uint32_t body = 0; body < set.used.size(); ++body) {
      if (set.used[body] == 0) continue;
      sink.asking = static_cast<int>(body);
      sink.reported = 0;
      api::ConstraintContext c = context(set, substepTime(), 0, 0, body);
      if (!m_carried.done() || m_held.size() != store.size()) c.held = nullptr;
      guarded(set, [&] { set.plugin->limits(c, store.view(), sink); });
    }
  }
}

}  // namespace ps
