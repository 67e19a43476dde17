// SPDX-License-Identifier: Apache-2.0
// Which bonds break and form, once per frame.
#include "bondmodel.h"
#include "joining.h"
#include "sharedloops.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintBatch;
using api::ConstraintContext;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;
using api::Phase;

/// Two dry pieces touch when their particles are closer than this, in spacings.
constexpr float kDryRadius = 1.05f;
/// Of the thesis: how far what is freezing reaches, in spacings, and how many bonds it makes.
constexpr float kThesisRadius = 1.1f;
constexpr uint32_t kThesisMost = 4;
/// Particles and bonds that threads take at a time, and what one thread takes for each, microseconds.
constexpr size_t kSharedParticles = 256, kSharedBonds = 4096;
constexpr double kMicrosecondsPerList = 0.03, kMicrosecondsPerBond = 0.002;

/// visit(k) for each particle or bond.
template <class Visit>
void forEach(const api::Threads* threads, size_t count, const Visit& visit) {
  forShared(threads, count, kMicrosecondsPerBond, visit, kSharedBonds);
}

float distanceSquared(const ParticleView& p, uint32_t i, uint32_t j) {
  const api::Float4 d = api::separation(p, i, j);
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

struct Candidate {
  float distanceSquared;
  uint32_t lowId, highId, i, j;
};

bool nearer(const Candidate& a, const Candidate& b) {
  if (a.distanceSquared != b.distanceSquared) return a.distanceSquared < b.distanceSquared;
  return a.lowId != b.lowId ? a.lowId < b.lowId : a.highId < b.highId;
}

bool byThesis(const ConstraintContext& context, const ParticleView& p, uint32_t i) {
  return context.parametersOf(p.body[i])[BondModel::kBondRule] > 0.5;
}

uint32_t mostBonds(const ConstraintContext& context, const ParticleView& p, uint32_t i) {
  return static_cast<uint32_t>(context.parametersOf(p.body[i])[BondModel::kBondMax]);
}

/// Whether bonds let go: asked of each particle once, since each has some eighteen of them. The thesis asks that both
/// ends are in the change of phase; here one that is past it counts too, or a bond whose ends melt within one frame
/// would stay for good. Its rule is that of a bond's first particle.
class LettingGo {
 public:
  LettingGo(const ConstraintContext& context, const ParticleView& p, const api::Threads* threads)
      : m_state(std::make_unique_for_overwrite<uint8_t[]>(p.count)) {
    forEach(threads, p.count, [&](size_t k) {
      const auto i = static_cast<uint32_t>(k);
      const unsigned loose = holds(p.motion[i]) ? 0 : kLoose, melting = p.solidFraction[i] < 1 ? kMelting : 0;
      m_state[i] = static_cast<uint8_t>(loose | melting | (byThesis(context, p, i) ? kThesis : 0));
    });
  }
  bool operator()(uint32_t i, uint32_t j) const {
    const unsigned a = m_state[i], b = m_state[j];
    return ((a & kThesis) != 0 ? a & b & kMelting : (a | b) & kLoose) != 0;
  }

 private:
  static constexpr unsigned kLoose = 1, kMelting = 2, kThesis = 4;
  std::unique_ptr<uint8_t[]> m_state;
};

/// How many bonds a particle has, and to whom, in no order, where it may take more.
class BondGraph {
 public:
  template <class Open>
  BondGraph(std::vector<uint32_t> degree, const ConstraintBatch& all, const uint8_t* gone, const api::Threads* threads,
            const Open& open)
      : m_degree(std::move(degree)), m_begin(m_degree.size() + 1) {
    forEach(threads, m_degree.size(),
            [&](size_t i) { m_begin[i + 1] = open(static_cast<uint32_t>(i), m_degree[i]) ? m_degree[i] : 0; });
    sumUpShared(threads, m_begin, kMicrosecondsPerBond);
    m_partner.resize(m_begin.back());
    std::vector<uint32_t> next(m_begin.begin(), m_begin.end());
    forEach(threads, all.count, [&](size_t k) {
      if (gone[k] != 0) return;
      const uint32_t i = all.particles[2 * k], j = all.particles[2 * k + 1];
      if (m_begin[i] != m_begin[i + 1]) m_partner[addOne(next[i])] = j;
      if (m_begin[j] != m_begin[j + 1]) m_partner[addOne(next[j])] = i;
    });
  }
  uint32_t degree(uint32_t i) const { return m_degree[i]; }
  const std::vector<uint32_t>& degrees() const { return m_degree; }
  bool tied(uint32_t i, uint32_t j) const {
    return std::find(m_partner.begin() + m_begin[i], m_partner.begin() + m_begin[i + 1], j) !=
           m_partner.begin() + m_begin[i + 1];
  }

 private:
  std::vector<uint32_t> m_degree, m_begin, m_partner;
};

/// Finds the pairs that may join.
class Search {
 public:
  Search(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists, const Joining& joining,
         const BondGraph& bonds)
      : m_context(context), m_p(p), m_lists(lists), m_joining(joining), m_bonds(bonds) {}

  std::vector<Candidate> candidates(const api::Threads* threads) const {
    const bool looseDry = anyShared(threads, m_p.count, kMicrosecondsPerBond, [&](size_t k) {
      const auto i = static_cast<uint32_t>(k);
      return holds(m_p.motion[i]) && m_joining.dryJoiner(i) && !m_joining.isRigid(i);
    });
    std::vector<std::vector<Candidate>> found((m_p.count + kSharedParticles - 1) / kSharedParticles);
    api::shareAmong(threads, m_p.count, kSharedParticles, kMicrosecondsPerList * static_cast<double>(m_p.count),
                    [&](size_t first, size_t last) {
                      std::vector<Candidate> own;
                      for (size_t i = first; i < last; ++i) look(static_cast<uint32_t>(i), looseDry, own);
                      found[first / kSharedParticles] = std::move(own);
                    });
    std::vector<Candidate> all;
    for (const std::vector<Candidate>& some : found) all.insert(all.end(), some.begin(), some.end());
    std::sort(all.begin(), all.end(), nearer);
    return all;
  }

 private:
  void look(uint32_t i, bool looseDry, std::vector<Candidate>& found) const {
    if (byThesis(m_context, m_p, i)) return freezeByThesis(i, found);
    if (m_p.motion[i] != Motion::Solid) return;
    // A dry member of a rigid body joins what is none: most bodies need not look for it.
    const bool dry = m_joining.dryJoiner(i) && (looseDry || !m_joining.isRigid(i));
    if (m_joining.fresh(i) || dry) join(i, found);
  }
  template <class Takes>
  void collect(uint32_t i, float reach, std::vector<Candidate>& found, Takes&& takes) const {
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t j = m_lists.index[q];
      const float d2 = distanceSquared(m_p, i, j);
      if (!(d2 < reach * reach) || !takes(j) || m_bonds.tied(i, j)) continue;
      found.push_back({d2, std::min(m_p.id[i], m_p.id[j]), std::max(m_p.id[i], m_p.id[j]), i, j});
    }
  }
  void join(uint32_t i, std::vector<Candidate>& found) const {
    if (m_bonds.degree(i) >= mostBonds(m_context, m_p, i)) return;  // as deep inside a block
    const bool fresh = m_joining.fresh(i);
    const float reach = fresh ? m_joining.reach(i) : kDryRadius * static_cast<float>(m_context.spacing);
    collect(i, reach, found, [&](uint32_t j) {
      if (!holds(m_p.motion[j]) || (m_joining.isRigid(i) && m_joining.isRigid(j))) return false;
      // Each pair once: by the fresh one, or by the lower of two alike.
      const bool alike = m_joining.fresh(j) == fresh && m_p.motion[j] == Motion::Solid;
      if (alike && j < i) return false;
      return fresh ? m_joining.mayFreeze(i, j) : maySinter(i, j);
    });
  }
  /// Within a body its pieces grow together, but not its loose grains.
  bool maySinter(uint32_t i, uint32_t j) const {
    const bool pieces = m_p.body[i] != m_p.body[j] || (m_bonds.degree(i) > 0 && m_bonds.degree(j) > 0);
    return pieces && m_joining.maySinter(i, j);
  }
  void freezeByThesis(uint32_t i, std::vector<Candidate>& found) const {
    if (m_p.phase[i] != Phase::Melting || !m_joining.fresh(i)) return;
    collect(i, kThesisRadius * static_cast<float>(m_context.spacing), found,
            [&](uint32_t j) { return holds(m_p.motion[j]) && m_p.phase[j] == Phase::Solid; });
  }

  const ConstraintContext& m_context;
  const ParticleView& m_p;
  const NeighbourView& m_lists;
  const Joining& m_joining;
  const BondGraph& m_bonds;
};

}  // namespace

void BondModel::topology(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                         const ConstraintBatch& all, api::ConstraintSink& sink) const {
  const Joining joining(context, p);
  joining.noteFluid(m_threads);
  const auto gone = std::make_unique_for_overwrite<uint8_t[]>(all.count);  // each is set by who asks its bond
  std::vector<uint32_t> degree(p.count, 0);
  auto* ties = static_cast<uint8_t*>(p.fields->write(kTiesField, api::FieldType::UInt8));
  if (all.count > 0) {
    const LettingGo letsGo(context, p, m_threads);
    forEach(m_threads, all.count, [&](size_t k) {
      const uint32_t i = all.particles[2 * k], j = all.particles[2 * k + 1];
      gone[k] = letsGo(i, j) ? 1 : 0;
      if (gone[k] == 0) addOne(degree[i]), addOne(degree[j]);
    });
    const uint8_t *const first = gone.get(), *const last = first + all.count;
    for (const uint8_t* at = first; (at = std::find(at, last, 1)) != last; ++at)
      sink.remove(static_cast<size_t>(at - first));
  }
  forEach(m_threads, p.count, [&](size_t i) { ties[i] = static_cast<uint8_t>(degree[i]); });
  const auto thesisRules = [](api::Span<const double> parameters) {
    return parameters.size > BondModel::kBondRule && parameters[BondModel::kBondRule] > 0.5;
  };
  const bool thesis = std::any_of(context.bodyParameters.begin(), context.bodyParameters.end(), thesisRules) ||
                      thesisRules(context.parameters);
  if (!thesis && !joining.anybody(m_threads)) return;
  const BondGraph bonds(std::move(degree), all, gone.get(), m_threads, [&](uint32_t i, uint32_t count) {
    return byThesis(context, p, i) || count < mostBonds(context, p, i);
  });
  const std::vector<Candidate> candidates = Search(context, p, lists, joining, bonds).candidates(m_threads);
  if (candidates.empty()) return;
  degree = bonds.degrees();
  for (const Candidate& c : candidates) {
    const auto full = [&](uint32_t i) { return degree[i] >= mostBonds(context, p, i); };
    if (byThesis(context, p, c.i) ? degree[c.i] >= kThesisMost : full(c.i) || full(c.j)) continue;
    addBond(p, c.i, c.j, {1, p.position[c.i].w + p.position[c.j].w, 0}, sink);
    ++degree[c.i], ++degree[c.j];
    ++ties[c.i], ++ties[c.j];
  }
  for (const Candidate& c : candidates) {
    if (degree[c.i] > 0) joining.freshness(c.i) = 0;
    if (degree[c.j] > 0) joining.freshness(c.j) = 0;
  }
}

}  // namespace ps::constraint
