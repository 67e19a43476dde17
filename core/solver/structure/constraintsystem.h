// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/callee.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/base/shorttext.h"
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/anyconstraint.h"
#include "core/solver/report.h"
#include "core/solver/settings.h"
#include "core/solver/structure/cuts.h"
#include "core/solver/structure/grouplists.h"
#include "core/solver/structure/implicitties.h"
#include "core/solver/structure/keyset.h"

#include <memory>
#include <string>
#include <vector>

// Why colours: constraints that share a particle must not run at the same time, and their order decides the result. A
// greedy colouring puts each into the first colour that none of its particles uses; within a colour any order gives the
// same bits, and the colours run one after the other. It is kept up to date as bonds break and form, so that it depends
// on the history of the scene alone, never on threads.
namespace ps {

class StateReader;
class StateWriter;
struct Blade;
struct TieChange;

/// Who is tied to whom, by structural constraints or as members of one group.
struct StructureGraph {
  std::vector<uint32_t> begin, partner;
  std::vector<uint32_t> groupBegin, group;  ///< groups of each particle, ascending
  bool isFree(uint32_t i) const { return begin[i + 1] == begin[i] && groupBegin[i + 1] == groupBegin[i]; }
  size_t ties(uint32_t i) const { return i + size_t{1} < begin.size() ? begin[i + 1] - begin[i] : 0; }
  bool tied(uint32_t i, uint32_t j) const {
    if (i + size_t{1} >= begin.size()) return false;
    const uint32_t *first = partner.data() + begin[i], *last = partner.data() + begin[i + 1];
    unsigned among = 0;  // without a branch in the loop compilers make vectors of it
    for (; first != last; ++first) among |= *first == j ? 1u : 0u;
    if (among != 0) return true;
    for (uint32_t a = groupBegin[i], b = groupBegin[j]; a < groupBegin[i + 1] && b < groupBegin[j + 1];) {
      if (group[a] == group[b]) return true;
      ++(group[a] < group[b] ? a : b);
    }
    return false;
  }
};

/// Constraints by the ids of their particles: what undo keeps of a structure that was taken apart.
struct CopiedConstraints {
  struct Set {
    std::string name;
    std::vector<uint32_t> id;   ///< arity per constraint
    std::vector<float> values;  ///< as many per constraint as the plugin declares
    std::vector<CopiedGroup> groups;
    SplitGroups split;  ///< by a cut
  };
  std::vector<Set> sets;
  std::vector<Cuts::Pair> cuts{};
};

/// Host of constraint plugins: owns their index lists and values, keeps them valid when particles are sorted, removed
/// and added, and calls each plugin once per batch. A plugin that throws is switched off; the others go on.
class ConstraintSystem {
 public:
  void configure(const SolverSettings& settings, std::span<const BakedMaterial> materials);
  uint32_t addSet(const AnyConstraint& plugin, std::string name, std::vector<double> parameters, ParticleStore& store);
  /// A body's own, in place of the set's.
  void setParameters(uint32_t set, uint32_t body, std::vector<double> parameters);

  /// Builds the constraints of newly created particles (ascending indices).
  void build(uint32_t set, const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> members);
  /// After ParticleStore::permute.
  void remap(std::span<const uint32_t> order);
  /// Before ParticleStore::remove of these ascending indices: drops what refers to them, renumbers the others.
  void removeParticles(const ParticleStore& store, std::span<const uint32_t> ascending);

  /// Constraints that touch one of these ascending indices.
  CopiedConstraints copy(const ParticleStore& store, std::span<const uint32_t> ascending) const;
  /// Adds copied constraints again wherever all their particles live; puts members of groups back into them.
  void putBack(ParticleStore& store, const CopiedConstraints& copies);

  /// Breaks ties of bodies that are not spared, by their index, and parts their groups: see Solver::cut().
  TieChange cut(const ParticleStore& store, const Neighbours& neighbours, std::span<const Blade> blades,
                std::span<const uint8_t> isSpared);
  /// Ties what touches within the balls of blades, where a plugin offers that.
  TieChange weld(const ParticleStore& store, const Neighbours& neighbours, std::span<const Blade> balls,
                 std::span<const uint8_t> isSpared);
  /// Makes the ties of a change, where all their particles live; then nothing is parted any more that it parted.
  void tie(ParticleStore& store, const Neighbours& neighbours, const TieChange& change);
  /// Breaks them, and parts what it parts.
  void sever(const ParticleStore& store, const Neighbours& neighbours, const TieChange& change);

  /// Marks what ties and groups hold to those that go and can move, but for what is fixed.
  void takeAlong(const ParticleStore& store, std::vector<uint8_t>& goes);
  /// What groups say of their places and velocities, when those that go have been carried.
  void carry(ParticleStore& store, std::span<const uint8_t> goes, const api::Carrying& carrying);

  void predict(ParticleStore& store, uint32_t substep);
  /// After a new order or a new structure: finds what is tied to something fixed.
  void findHeld(const ParticleStore& store);
  /// Carries pulls through what is held where passes alone would not, before the first of them.
  void carry(ParticleStore& store, uint32_t substep);
  void projectStructure(ParticleStore& store, uint32_t substep, uint32_t iteration);
  void projectNeighbours(ParticleStore& store, const Neighbours& neighbours, uint32_t substep, uint32_t iteration);
  void projectGroups(ParticleStore& store, uint32_t substep, uint32_t iteration);
  void deriveVelocities(ParticleStore& store, uint32_t substep);
  /// Once per frame. True when the structure has changed.
  bool topology(const ParticleStore& store, const Neighbours& neighbours);
  double energy(const ParticleStore& store);  ///< J
  void setTime(double seconds) { m_time = seconds; }
  void limits(const ParticleStore& store, std::vector<Limit>& out);

  /// 1 for each particle that is a member of a group.
  void findGroupMembers(const ParticleStore& store, std::vector<uint8_t>& marks) const;
  /// visit(members) for each group that moves as one body; valid until the structure or the order changes.
  template <class Visit>
  void eachRigidGroup(Visit&& visit) const {
    for (const Set& set : m_sets) {
      for (size_t g = 0; set.rigid && set.groups && g < set.groups->count(); ++g) visit(set.groups->members(g));
    }
  }

  /// 1 for bodies that use a plugin of sheets or lines, by their index.
  std::span<const uint8_t> thinBodies() const { return m_thin; }

  /// Particles of one body are another one's by now, which is tied by the same plugins, with the same parameters.
  void passed(const ParticleStore& store, uint32_t from, uint32_t to);

  size_t count() const;  ///< structural constraints and groups
  /// Everything but what plugins are: lists, colours, values, who was put aside, and parameters of single bodies.
  void save(StateWriter& writer) const;
  /// After the store; the same sets must have been added, in the same order. Parameters that bodies have here already
  /// win over those that were saved, and who was put aside here stays so.
  void restore(const StateReader& reader, const ParticleStore& store);
  /// Ties between pairs of particles, for contact; renewed when the structure or the order has changed.
  const StructureGraph& graph(size_t particles);
  /// For each particle a number that all share whom ties hold together; kNoPiece for what is tied to nothing.
  std::vector<uint32_t> pieces(size_t particles);
  /// The same into memory that is used again.
  void findPieces(size_t particles, std::vector<uint32_t>& piece);
  static constexpr uint32_t kNoPiece = ~0u;
  /// What moves and may be pulled by something fixed, in ascending order: the particles of each plugin that ties fixed
  /// ones or shares particles with one that does; all of them where a plugin gathers over neighbours.
  /// None where nothing is fixed.
  void findHanging(const ParticleStore& store, std::vector<uint32_t>& hanging);
  /// Whether a plugin holds groups together.
  bool groups() const;
  /// Whether a plugin gathers over neighbours.
  bool gathers() const;
  /// Over structural constraints in a substep. One pass over those that share particles leaves stiff springs an error
  /// that the next substep answers with a push: cloth whips and blocks explode.
  int leastPasses() const { return shareParticles() ? 2 : 1; }
  /// How many passes over structure a substep has, for plugins; before it is known, the iterations.
  void setPasses(uint32_t passes) { m_passes = passes; }
  /// Those that threw since the last call.
  std::vector<PluginFault> drainFaults();
  /// From now on it is noted whose call first moves a particle farther than `metres`, or to no number; 0: no longer.
  /// Costs a copy of all positions at each call: for a frame that has gone wrong.
  void watch(double metres);
  /// "" or the plugin that did.
  const std::string& culprit() const { return m_culprit; }

 private:
  void addGroupsTo(StructureGraph& graph, size_t particles);
  /// Constraints from here on, up to the next run, belong to one body and one colour.
  struct Run {
    size_t first;
    uint32_t body;
  };
  struct Set {
    const api::ConstraintPlugin* plugin = nullptr;
    const api::StructuralPlugin* structural = nullptr;  ///< one of the three is the plugin
    const api::GroupPlugin* group = nullptr;
    const api::NeighbourPlugin* neighbour = nullptr;
    const api::SpringTies* springs = nullptr;  ///< of a structural one that has them
    std::vector<float> pull, stiffness;        ///< of springs, by constraint, in this substep
    std::string name;
    std::vector<double> parameters;                     ///< of bodies without their own
    std::vector<std::vector<double>> bodyParameters;    ///< by body; empty: the set's
    std::vector<api::Span<const double>> parametersOf;  ///< both, as plugins see them
    std::vector<uint8_t> used;                          ///< 1 for bodies that use the plugin
    LoopCost cost;                                      ///< of a constraint
    bool disabled = false;
    size_t arity = 0, valueCount = 0, count = 0;
    std::vector<uint32_t> particles;         ///< arity per constraint, in order of colour
    std::vector<std::vector<float>> values;  ///< [value][constraint]
    std::vector<size_t> colourStart;         ///< first constraint of each colour; one entry more than there are colours
    std::vector<Run> runs;                   ///< within a colour in order of bodies
    std::vector<std::vector<uint64_t>> coloursInUse;  ///< [word of 64 colours][particle id]
    KeySet keys;                                      ///< particle ids of each constraint
    bool lookedUp = true;                ///< coloursInUse and keys agree with the lists; not after restore()
    std::unique_ptr<GroupLists> groups;  ///< of a plugin of groups, which uses none of the lists above
    bool rigid = false, thin = false;
    std::vector<uint32_t> members;  ///< of a plugin of neighbours: particles of the bodies that use it, ascending
    size_t membersOf = ~size_t{0};  ///< how many particles there were when they were found; ~0: find them
  };
  struct Edits;
  class Sink;
  class Groups;  ///< collects the edits of groups
  struct GroupRoom {
    GroupLists::Edits edits;
    std::vector<uint32_t> lastUse;  ///< by particle: the last group that named it
    uint32_t serial = 0;            ///< of that group
  };
  class CutsShown;  ///< while it lives, plugins see who is parted

  static size_t beginTying(const Set& set, size_t members);
  static void tellProgress(const Set& set, size_t steps);
  api::ConstraintContext context(const Set& set, double dt, uint32_t substep, uint32_t iteration,
                                 uint32_t body = api::ConstraintContext::kNoBody) const;
  double substepTime() const { return m_settings.dt / m_settings.substeps; }
  static void refreshParameters(Set& set);
  bool shareParticles() const;
  /// Runs a call into a plugin; what throws is put aside, its constraints dropped.
  template <class Call>
  bool guarded(Set& set, Call&& call) {
    if (set.disabled) return false;
    const CalleeScope callee(set.name.c_str());
    std::string problem;
    try {
      call();
      return true;
    } catch (const Cancelled&) {  // by who watches, through the plugin
      throw;
    } catch (const std::exception& e) {
      problem = shortText(e.what());
    } catch (...) {
      problem = "threw something that is no std::exception";
    }
    putAside(set, std::move(problem));
    return false;
  }
  void putAside(Set& set, std::string problem);
  static void dropAll(Set& set);
  /// guarded(), watched.
  template <class Call>
  bool moving(Set& set, const ParticleStore& store, Call&& call) {
    if (!(m_watched > 0) || set.disabled) return guarded(set, call);
    m_before.assign(store.position(), store.position() + store.size());
    const bool done = guarded(set, call);
    if (m_culprit.empty() && leapt(store)) m_culprit = set.name;
    return done;
  }
  bool leapt(const ParticleStore& store) const;
  TieKey keyOf(const Set& set, const ParticleStore& store, const uint32_t* particles) const;
  // In constraintstate.cpp.
  static void saveParameters(StateWriter& writer, std::string_view room, const Set& set);
  static void restoreParameters(const StateReader& reader, std::string_view room, Set& set);
  static void restoreLists(const StateReader& reader, std::string_view room, Set& set, const ParticleStore& store);
  void restoreThin();
  /// Makes coloursInUse and keys again where they are needed: it takes longer than all the rest of restoring.
  void lookUp(Set& set, const ParticleStore& store) const;
  size_t takeColour(Set& set, const ParticleStore& store, const uint32_t* particles) const;
  void apply(Set& set, const ParticleStore& store, const Edits& edits);
  static void copyTie(const Set& set, const ParticleStore& store, size_t k, CopiedConstraints::Set& copied);
  // In cutting.cpp.
  template <class Goes>
  void breakTies(Set& set, const ParticleStore& store, CopiedConstraints::Set& copied, const Goes& goes);
  void weldSet(Set& set, const ParticleStore& store, const Neighbours& neighbours, std::span<const uint32_t> within,
               CopiedConstraints::Set& copied);
  Set* find(const CopiedConstraints::Set& copied);
  void reshapeGroups(const ParticleStore& store, const Neighbours& neighbours, std::span<const Cuts::Pair> pairs,
                     CopiedConstraints* noted = nullptr);
  void heal(const ParticleStore& store, const Neighbours& neighbours, std::span<const Cuts::Pair> pairs);
  // In passing.cpp.
  void sortByBody(Set& set, const ParticleStore& store);
  // In constraintgaps.cpp.
  std::vector<Run> mergeColour(const Set& set, const ParticleStore& store, const Edits& edits,
                               std::span<const uint32_t> added, size_t colour, size_t first);
  void sortByParticle(Set& set, size_t particles);
  static void closeGaps(Set& set, std::vector<size_t> gaps);
  // In constraintcalls.cpp.
  template <class Call>
  void forBatches(Set& set, uint32_t substep, uint32_t iteration, Call&& call, size_t chunk = grain::kConstraints);
  template <class Call>
  static void forRuns(const Set& set, size_t first, size_t last, Call&& call);
  void findMembers(Set& set, const ParticleStore& store) const;
  void applyCorrections(const Set& set, ParticleStore& store) const;
  void linearise(Set& set, const api::ParticleView& view, uint32_t substep);
  // In constraintgroups.cpp.
  template <class Call>
  void forGroups(Set& set, const ParticleStore& store, uint32_t substep, uint32_t iteration, Call&& call);
  void predictGroups(ParticleStore& store, uint32_t substep);
  void deriveGroupVelocities(ParticleStore& store, uint32_t substep);
  void buildGroups(Set& set, const ParticleStore& store, const Neighbours& neighbours,
                   std::span<const uint32_t> members);
  bool groupTopology(Set& set, const ParticleStore& store, const Neighbours& neighbours, SplitGroups* split = nullptr);
  double groupEnergy(Set& set, const ParticleStore& store);
  void putGroupsBack(Set& set, ParticleStore& store, std::span<const CopiedGroup> copies);

  void declareFields(Set& set, api::List<api::FieldDeclaration> fields, ParticleStore& store);
  void forgetMembers();
  /// A view that what is called may move.
  static api::MovableParticles movable(ParticleStore& store, const api::ParticleView& view) {
    return {&view, store.position(), store.velocity()};
  }

  SolverSettings m_settings;
  double m_time = 0;  ///< s, of the scene
  std::vector<const api::MaterialView*> m_materials;
  std::vector<Set> m_sets;
  std::vector<uint32_t> m_newIndex, m_keptParticles;
  std::vector<std::vector<float>> m_keptValues;
  /// Room of sortByParticle(): by particle, in order of particles, and by constraint, run and new place.
  struct Sorting {
    std::vector<uint32_t> end, ofParticle, runOf, from, next;
  } m_sorting;
  GroupRoom m_groupRoom;                     ///< of groupTopology()
  std::vector<uint32_t> m_groupFirst;        ///< of findPieces(): a member of each, by its serial
  std::vector<uint32_t> m_open;              ///< of takeAlong(), still to be followed
  std::vector<uint8_t> m_hangs, m_setHangs;  ///< of findHanging(): by particle, by set
  std::vector<api::Float4> m_correction;
  std::vector<uint8_t> m_thin;
  ImplicitTies m_carried;
  Cuts m_cuts;
  const api::CutView *m_cutView = nullptr, *m_healedView = nullptr;
  uint32_t m_passes = 0;
  std::vector<uint8_t> m_held;       ///< by particle; empty: nothing is
  std::vector<uint32_t> m_openHeld;  ///< of findHeld(), still to be followed
  StructureGraph m_graph;
  bool m_graphValid = false;
  std::vector<PluginFault> m_faults;
  double m_watched = 0;  ///< m
  std::string m_culprit;
  std::vector<api::Float4> m_before;  ///< positions, while watched
};

}  // namespace ps
