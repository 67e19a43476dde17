// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/constraintsystem.h"

#include "core/base/error.h"
#include "core/solver/matter.h"
#include "core/solver/structure/constraintsink.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace ps {
namespace {

constexpr size_t kMostValues = GroupLists::kMostValues;
constexpr uint32_t kGone = ~0u;
/// Ties of a particle where the plugin does not tell.
constexpr double kUsualTies = 6;
constexpr double kMostTies = 32;  ///< that room is made for before they come

}  // namespace

void ConstraintSystem::configure(const SolverSettings& settings, std::span<const BakedMaterial> materials) {
  m_settings = settings;
  m_materials.clear();
  for (const BakedMaterial& m : materials) m_materials.push_back(&m);
}

namespace {

/// What a plugin says of itself; what it leaves unsaid has the defaults.
template <class Traits, class Plugin>
Traits traitsOf(const Plugin& plugin, const std::string& name) {
  Traits traits;
  if (!plugin.traits(&traits)) throw Error("constraint plugin '" + name + "' does not say what it is");
  const auto requireFew = [&](const api::List<api::FieldDeclaration>& values, const char* whose) {
    if (values.count > kMostValues)
      throw Error("constraint plugin '" + name + "' declares more than 16 values" + whose);
  };
  if constexpr (requires { traits.values; }) requireFew(traits.values, "");
  if constexpr (requires { traits.memberValues; }) requireFew(traits.memberValues, " of a member");
  return traits;
}

}  // namespace

uint32_t ConstraintSystem::addSet(const AnyConstraint& plugin, std::string name, std::vector<double> parameters,
                                  ParticleStore& store) {
  Set set;
  set.plugin = &commonOf(plugin);
  set.name = std::move(name);
  set.parameters = std::move(parameters);
  set.colourStart.assign(1, 0);
  if (const auto* structural = std::get_if<const api::StructuralPlugin*>(&plugin)) {
    set.structural = *structural;
    const auto traits = traitsOf<api::StructuralTraits>(*set.structural, set.name);
    if (traits.arity < 2 || traits.arity > 4) {
      throw Error("constraint plugin '" + set.name + "' declares an arity outside 2 to 4");
    }
    set.arity = traits.arity;
    set.valueCount = traits.values.count;
    set.values.resize(set.valueCount);
    set.thin = traits.thin != 0;
    if (set.arity == 2) set.springs = static_cast<const api::SpringTies*>(set.structural->extension(api::kSpringTies));
    if (set.springs && set.springs->multiplier() >= set.valueCount)
      throw Error("constraint plugin '" + set.name + "' does not declare the multiplier of its springs");
    declareFields(set, traits.fields, store);
  } else if (const auto* group = std::get_if<const api::GroupPlugin*>(&plugin)) {
    set.group = *group;
    const auto traits = traitsOf<api::GroupTraits>(*set.group, set.name);
    set.groups = std::make_unique<GroupLists>(traits.values.count, traits.memberValues.count);
    set.rigid = traits.rigid != 0;
    set.thin = traits.thin != 0;
    declareFields(set, traits.fields, store);
  } else {
    set.neighbour = std::get<const api::NeighbourPlugin*>(plugin);
    declareFields(set, traitsOf<api::NeighbourTraits>(*set.neighbour, set.name).fields, store);
  }
  m_sets.push_back(std::move(set));
  return static_cast<uint32_t>(m_sets.size() - 1);
}

void ConstraintSystem::declareFields(Set& set, api::List<api::FieldDeclaration> fields, ParticleStore& store) {
  try {
    for (size_t k = 0; k < fields.count; ++k) {
      const api::FieldDeclaration f = fields.at(k);
      store.declare(f.name, f.type, f.unit, f.help);
    }
  } catch (const Error& clash) {  // what was there first goes on
    putAside(set, clash.what());
  }
}

void ConstraintSystem::setParameters(uint32_t index, uint32_t body, std::vector<double> parameters) {
  Set& set = m_sets.at(index);
  if (body >= set.bodyParameters.size()) set.bodyParameters.resize(body + size_t{1});
  set.bodyParameters[body] = std::move(parameters);
  refreshParameters(set);
}

void ConstraintSystem::refreshParameters(Set& set) {
  set.parametersOf.clear();
  for (const std::vector<double>& own : set.bodyParameters) {
    const std::vector<double>& values = own.empty() ? set.parameters : own;
    set.parametersOf.push_back({values.data(), values.size()});
  }
}

api::ConstraintContext ConstraintSystem::context(const Set& set, double dt, uint32_t substep, uint32_t iteration,
                                                 uint32_t body) const {
  api::ConstraintContext c{
      dt,
      m_settings.spacing,
      m_settings.spacing * m_settings.supportRatio,
      m_settings.gravity,
      substep,
      iteration,
      {set.parameters.data(), set.parameters.size()},
      {m_materials.data(), m_materials.size()},
      body,
      m_passes > 0 ? m_passes : static_cast<uint32_t>(std::max(m_settings.iterations, leastPasses())),
      {set.parametersOf.data(), set.parametersOf.size()},
      m_time,
      m_held.empty() ? nullptr : m_held.data(),
      m_cutView,
      m_healedView};
  c.parameters = c.parametersOf(body);
  return c;
}

void ConstraintSystem::putAside(Set& set, std::string problem) {
  set.disabled = true;
  dropAll(set);
  m_carried.clear();  // its lists are gone
  m_graphValid = false;
  m_faults.push_back({set.name, std::move(problem)});
}

void ConstraintSystem::dropAll(Set& set) {
  set.count = 0;
  set.particles.clear();
  for (auto& v : set.values) v.clear();
  set.colourStart.assign(1, 0);
  set.runs.clear();
  if (set.groups) set.groups->clear();
}

TieKey ConstraintSystem::keyOf(const Set& set, const ParticleStore& store, const uint32_t* particles) const {
  std::array<uint32_t, 4> ids{kGone, kGone, kGone, kGone};
  for (size_t a = 0; a < set.arity; ++a) ids[a] = store.id()[particles[a]];
  std::sort(ids.begin(), ids.end());  // unused places sort to the end
  return {uint64_t{ids[0]} << 32 | ids[1], uint64_t{ids[2]} << 32 | ids[3]};
}

size_t ConstraintSystem::takeColour(Set& set, const ParticleStore& store, const uint32_t* particles) const {
  for (size_t word = 0;; ++word) {
    if (word == set.coloursInUse.size()) set.coloursInUse.emplace_back();
    std::vector<uint64_t>& used = set.coloursInUse[word];
    uint64_t inUse = 0;
    for (size_t a = 0; a < set.arity; ++a) {
      const uint32_t id = store.id()[particles[a]];
      if (id >= used.size()) used.resize(id + 1 + used.size() / 2, 0);
      inUse |= used[id];
    }
    if (inUse == ~uint64_t{0}) continue;
    const int bit = std::countr_one(inUse);
    for (size_t a = 0; a < set.arity; ++a) used[store.id()[particles[a]]] |= uint64_t{1} << bit;
    return 64 * word + static_cast<size_t>(bit);
  }
}

void ConstraintSystem::apply(Set& set, const ParticleStore& store, const Edits& edits) {
  if (edits.empty()) return;
  m_graphValid = false;
  const size_t arity = set.arity, added = edits.particles.size() / arity;
  const auto colourOf = [&](size_t k) {
    return static_cast<size_t>(std::upper_bound(set.colourStart.begin(), set.colourStart.end(), k) -
                               set.colourStart.begin() - 1);
  };
  // Colours that removed constraints give back are free for new ones.
  for (const size_t k : edits.removedAt) {
    const size_t colour = colourOf(k);
    for (size_t a = 0; a < arity; ++a) {
      const uint32_t particle = set.particles[k * arity + a];
      if (particle != kGone) set.coloursInUse[colour / 64][store.id()[particle]] &= ~(uint64_t{1} << (colour % 64));
    }
  }
  if (added == 0) return closeGaps(set, edits.removedAt);
  std::vector<std::vector<uint32_t>> newOfColour(set.colourStart.size() - 1);
  inSlices(0, added, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const size_t colour = takeColour(set, store, edits.particles.data() + k * arity);
      if (colour >= newOfColour.size()) newOfColour.resize(colour + 1);
      newOfColour[colour].push_back(static_cast<uint32_t>(k));
    }
  });
  const size_t colours = newOfColour.size();
  std::vector<size_t> starts(colours + 1, 0);
  for (size_t colour = 0; colour < colours; ++colour) {
    const bool old = colour + 1 < set.colourStart.size();
    starts[colour + 1] = newOfColour[colour].size() + (old ? set.colourStart[colour + 1] - set.colourStart[colour] : 0);
  }
  for (const size_t k : edits.removedAt) --starts[colourOf(k) + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  const size_t count = starts.back();
  m_keptParticles.resize(count * arity);
  m_keptValues.resize(std::max(m_keptValues.size(), set.valueCount));
  for (size_t v = 0; v < set.valueCount; ++v) m_keptValues[v].resize(count);
  std::vector<std::vector<Run>> runs(colours);
  const auto merge = [&](size_t colour) {
    runs[colour] = mergeColour(set, store, edits, newOfColour[colour], colour, starts[colour]);
  };
  if (t_progress) {  // who watches sees it go on, and that is this thread's
    for (size_t colour = 0; colour < colours; ++colour) merge(colour);
  } else {
    constexpr double kMicrosecondsEach = 0.02;
    forChunks(
        colours, 1, [&](size_t first, size_t) { merge(first); }, kMicrosecondsEach * static_cast<double>(count));
  }
  set.particles.swap(m_keptParticles);
  for (size_t v = 0; v < set.valueCount; ++v) set.values[v].swap(m_keptValues[v]);
  set.colourStart = std::move(starts);
  set.count = count;
  set.runs.clear();
  for (const std::vector<Run>& own : runs) set.runs.insert(set.runs.end(), own.begin(), own.end());
}

/// Puts what stays and what is new of a colour in order of bodies, from `first` on among what is kept; returns its
/// runs. Colours may be merged on several threads.
std::vector<ConstraintSystem::Run> ConstraintSystem::mergeColour(const Set& set, const ParticleStore& store,
                                                                 const Edits& edits, std::span<const uint32_t> added,
                                                                 size_t colour, size_t first) {
  struct Place {
    uint32_t body;
    bool isNew;
    size_t k;
  };
  const size_t arity = set.arity;
  std::vector<Place> places;
  const bool old = colour + 1 < set.colourStart.size();
  for (size_t k = old ? set.colourStart[colour] : 0; old && k < set.colourStart[colour + 1]; ++k) {
    if (!edits.removed.empty() && edits.removed[k] != 0) continue;
    places.push_back({store.body()[set.particles[k * arity]], false, k});
  }
  for (const uint32_t k : added) places.push_back({store.body()[edits.particles[k * arity]], true, k});
  const auto byBody = [](const Place& a, const Place& b) { return a.body < b.body; };
  if (!std::is_sorted(places.begin(), places.end(), byBody)) std::stable_sort(places.begin(), places.end(), byBody);
  std::vector<Run> runs;
  inSlices(0, places.size(), [&](size_t from, size_t to) {
    for (size_t q = from; q < to; ++q) {
      const auto [body, isNew, k] = places[q];
      if (q == 0 || body != places[q - 1].body) runs.push_back({first + q, body});
      std::copy_n((isNew ? edits.particles : set.particles).data() + k * arity, arity,
                  m_keptParticles.data() + (first + q) * arity);
      for (size_t v = 0; v < set.valueCount; ++v)
        m_keptValues[v][first + q] = isNew ? edits.values[k * set.valueCount + v] : set.values[v][k];
    }
  });
  return runs;
}

/// Ties of `members`, or places in groups: each is found, coloured and put in order, three steps of the stage that
/// begins. How many are expected; 0 where nobody watches.
size_t ConstraintSystem::beginTying(const Set& set, size_t members) {
  if (!t_progress) return 0;
  const auto* count = static_cast<const api::StructureCount*>(set.plugin->extension(api::kStructureCount));
  const double usual = set.groups ? 1 : kUsualTies;
  const double each = count ? count->perParticle({set.parameters.data(), set.parameters.size()}) : usual;
  const double expected = std::min(each, kMostTies) * static_cast<double>(members);
  beginStage("Tying structure", kTyingWeight * static_cast<double>(members), 3 * expected);
  return static_cast<size_t>(expected);
}

/// From within a call of a plugin, which then counts as a new one: it has come back to us.
void ConstraintSystem::tellProgress(const Set& set, size_t steps) {
  if (!t_progress) return;
  const CalleeScope renewed(set.name.c_str());
  advance(steps);
}

void ConstraintSystem::build(uint32_t index, const ParticleStore& store, const Neighbours& neighbours,
                             std::span<const uint32_t> members) {
  Set& set = m_sets.at(index);
  if (members.empty()) return;
  m_held.clear();  // of fewer particles
  const uint32_t body = store.body()[members[0]];
  if (body >= set.used.size()) set.used.resize(body + size_t{1}, 0);
  set.used[body] = 1;
  if (body >= m_thin.size()) m_thin.resize(body + size_t{1}, 0);
  if (set.thin) m_thin[body] = 1;
  if (body >= set.bodyParameters.size()) set.bodyParameters.resize(body + size_t{1});
  refreshParameters(set);
  set.membersOf = ~size_t{0};
  if (set.groups) buildGroups(set, store, neighbours, members);
  if (!set.structural) return;
  Edits edits;
  const size_t expected = beginTying(set, members.size());
  edits.particles.reserve(expected * set.arity);  // to move millions of them takes its time
  edits.values.reserve(expected * set.valueCount);
  Sink sink(*this, set, store, edits);
  if (guarded(set, [&] {
        set.structural->build(context(set, m_settings.dt, 0, 0, body), store.view(), neighbours.view(),
                              {members.data(), members.size()}, sink);
      })) {
    apply(set, store, edits);
  }
}

void ConstraintSystem::remap(std::span<const uint32_t> order) {
  m_held.clear();
  m_newIndex.resize(order.size());
  for (size_t k = 0; k < order.size(); ++k) m_newIndex[order[k]] = static_cast<uint32_t>(k);
  for (Set& set : m_sets) {
    for (uint32_t& i : set.particles) i = m_newIndex[i];
    if (set.groups) set.groups->renumber(m_newIndex);
    sortByParticle(set, order.size());
  }
  forgetMembers();
  m_graphValid = false;
}

void ConstraintSystem::removeParticles(const ParticleStore& store, std::span<const uint32_t> ascending) {
  m_held.clear();
  m_newIndex.assign(store.size(), 0);
  for (const uint32_t i : ascending) m_newIndex[i] = kGone;
  uint32_t next = 0;
  for (uint32_t& i : m_newIndex) i = i == kGone ? kGone : next++;
  for (Set& set : m_sets) {
    Edits edits;
    Sink sink(*this, set, store, edits);
    for (size_t k = 0; k < set.count; ++k) {
      for (size_t a = 0; a < set.arity; ++a) {
        if (m_newIndex[set.particles[k * set.arity + a]] == kGone) sink.remove(k);
      }
    }
    apply(set, store, edits);
    for (uint32_t& i : set.particles) i = m_newIndex[i];
    if (set.groups) set.groups->renumber(m_newIndex);
  }
  forgetMembers();
  m_graphValid = false;
}

CopiedConstraints ConstraintSystem::copy(const ParticleStore& store, std::span<const uint32_t> ascending) const {
  CopiedConstraints copies;
  copies.cuts = m_cuts.of(store, ascending);
  for (const Set& set : m_sets) {
    CopiedConstraints::Set& copied = copies.sets.emplace_back();
    copied.name = set.name;
    if (set.groups) copied.groups = set.groups->copy(store, ascending);
    for (size_t k = 0; k < set.count; ++k) {
      const uint32_t* particles = set.particles.data() + k * set.arity;
      if (std::any_of(particles, particles + set.arity,
                      [&](uint32_t i) { return std::binary_search(ascending.begin(), ascending.end(), i); })) {
        copyTie(set, store, k, copied);
      }
    }
  }
  return copies;
}

void ConstraintSystem::copyTie(const Set& set, const ParticleStore& store, size_t k, CopiedConstraints::Set& copied) {
  for (size_t a = 0; a < set.arity; ++a) copied.id.push_back(store.id()[set.particles[k * set.arity + a]]);
  for (size_t v = 0; v < set.valueCount; ++v) copied.values.push_back(set.values[v][k]);
}

void ConstraintSystem::putBack(ParticleStore& store, const CopiedConstraints& copies) {
  forgetMembers();
  m_cuts.add(copies.cuts);
  for (const CopiedConstraints::Set& copied : copies.sets) {
    const auto found = std::find_if(m_sets.begin(), m_sets.end(), [&](const Set& s) { return s.name == copied.name; });
    if (found == m_sets.end() || found->disabled) continue;
    Set& set = *found;
    if (set.groups) putGroupsBack(set, store, copied.groups);
    if (!set.structural) continue;
    Edits edits;
    Sink sink(*this, set, store, edits);
    std::vector<uint32_t> particles(set.arity);
    for (size_t k = 0; (k + 1) * set.arity <= copied.id.size(); ++k) {
      for (size_t a = 0; a < set.arity; ++a) {
        particles[a] = static_cast<uint32_t>(store.indexOf(copied.id[k * set.arity + a]));
      }
      if (std::any_of(particles.begin(), particles.end(), [&](uint32_t i) { return i >= store.size(); })) continue;
      sink.add(particles.data(), copied.values.data() + k * set.valueCount);
    }
    apply(set, store, edits);
  }
}

bool ConstraintSystem::topology(const ParticleStore& store, const Neighbours& neighbours) {
  bool changed = false;
  m_cuts.dropLoose(store);
  const CutsShown shown(*this, store);
  // What freezes beside a group may join it; who is left joins by springs.
  for (Set& set : m_sets) {
    if (set.groups) changed = groupTopology(set, store, neighbours) || changed;
  }
  for (Set& set : m_sets) {
    if (!set.structural || set.disabled) continue;
    std::array<float*, kMostValues> values{};
    for (size_t v = 0; v < set.valueCount; ++v) values[v] = set.values[v].data();
    const api::ConstraintBatch all{set.count, set.particles.data(), values.data()};
    Edits edits;
    Sink sink(*this, set, store, edits);
    if (!guarded(set, [&] {
          set.structural->topology(context(set, m_settings.dt, 0, 0), store.view(), neighbours.view(), all, sink);
        })) {
      changed = true;
      continue;
    }
    changed = changed || !edits.empty();
    apply(set, store, edits);
  }
  return changed;
}

size_t ConstraintSystem::count() const {
  size_t sum = 0;
  for (const Set& set : m_sets) sum += set.count + (set.groups ? set.groups->count() : 0);
  return sum;
}

bool ConstraintSystem::shareParticles() const {
  return std::any_of(m_sets.begin(), m_sets.end(), [](const Set& set) { return set.colourStart.size() > 2; });
}

std::vector<PluginFault> ConstraintSystem::drainFaults() { return std::exchange(m_faults, {}); }

}  // namespace ps
