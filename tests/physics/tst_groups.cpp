// SPDX-License-Identifier: Apache-2.0
// The host of group constraints: overlapping groups stay right whatever happens to the particles.
#include "core/solver/structure/grouplists.h"
#include "mechanicsscene.h"

#include <QTest>

#include <set>
#include <stdexcept>

using namespace mechanics;
using ps::Solver;
using ps::StepReport;
using namespace ps::api;

namespace {

/// Groups that overlap: every third particle with its neighbours. Each group knows the sum of its members' ids, each
/// member its id. Throws where it is told to.
class GroupWatch final : public TestConstraint<GroupPlugin> {
 public:
  enum Where { Nowhere, Build, Predict, Project, Derive, Topology, Restore, Energy };
  explicit GroupWatch(Where where = Nowhere) : m_where(where) {}
  mutable std::atomic<int> wrong{0}, seen{0}, returned{0};
  mutable bool armed = true;

  bool traits(GroupTraits* out) const noexcept override {
    static constexpr FieldDeclaration kGroup[] = {{"sum_of_ids", "", "", FieldType::Float32}};
    static constexpr FieldDeclaration kMember[] = {{"member_id", "", "", FieldType::Float32}};
    return fill(out, {.values = listOf(kGroup), .memberValues = listOf(kMember)});
  }
  void build(const ConstraintContext&, const ParticleView& p, const NeighbourView& lists, Span<const uint32_t> members,
             const GroupBatch&, GroupSink& sink) const override {
    for (size_t k = 0; k < members.size; k += 3) addAround(p, lists, members[k], sink);
    maybe(Build);
  }
  void predict(const ConstraintContext&, const MovableParticles&, const GroupBatch&) const override { maybe(Predict); }
  void project(const ConstraintContext&, const MovableParticles& particles, const GroupBatch& b) const override {
    const ParticleView& p = particles;
    maybe(Project);
    for (size_t g = 0; g < b.count; ++g) {
      float sum = 0;
      for (size_t k = b.begin[g]; k < b.begin[g + 1]; ++k) {
        const uint32_t i = b.particles[k];
        if (b.memberValues[0][k] != static_cast<float>(p.id[i])) ++wrong;
        sum += static_cast<float>(p.id[i]);
      }
      if (b.changed[g] == 0 && sum != b.values[0][g]) ++wrong;
    }
    seen += static_cast<int>(b.count);
  }
  void deriveVelocities(const ConstraintContext&, const MovableParticles&, const GroupBatch&) const override {
    maybe(Derive);
  }
  void topology(const ConstraintContext&, const ParticleView& p, const NeighbourView& lists, const GroupBatch& all,
                GroupSink& sink) const override {
    maybe(Topology);
    for (size_t g = 0; g < all.count; ++g) {
      if (all.changed[g] != 0) all.values[0][g] = sumOf(p, all, g);
      if (g % 7 == 0) sink.remove(g);
    }
    for (uint32_t i = 0; i < p.count; i += 20) addAround(p, lists, i, sink);
  }
  void restoreMembers(const ConstraintContext&, const MovableParticles&, const GroupBatch& all,
                      const uint8_t* back) const override {
    maybe(Restore);
    for (size_t k = 0; k < all.begin[all.count]; ++k) returned += back[k];
  }
  double energy(const ConstraintContext&, const ParticleView&, const GroupBatch& all) const override {
    maybe(Energy);
    return static_cast<double>(all.count);
  }

 private:
  void maybe(Where where) const {
    if (armed && where == m_where) throw std::runtime_error("no shape");
  }
  static float sumOf(const ParticleView& p, const GroupBatch& b, size_t g) {
    float sum = 0;
    for (size_t k = b.begin[g]; k < b.begin[g + 1]; ++k) sum += static_cast<float>(p.id[b.particles[k]]);
    return sum;
  }
  static void addAround(const ParticleView& p, const NeighbourView& lists, uint32_t i, GroupSink& sink) {
    std::vector<uint32_t> particles{i};
    for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) particles.push_back(lists.index[q]);
    std::vector<float> ids;
    float sum = 0;
    for (const uint32_t k : particles) ids.push_back(static_cast<float>(p.id[k])), sum += ids.back();
    sink.add(particles.data(), particles.size(), &sum, ids.data());
  }
  Where m_where;
};

std::vector<uint32_t> spawnWatched(Solver& solver, const GroupWatch& watch) {
  prepare(solver, settingsOf(0.02));
  solver.setWalls(tray(0.2));
  ps::Spawn spawn = liquid(lattice(8, 8, 8, 0.02, 0.05));
  spawn.constraintSets = {solver.addConstraintSet(&watch, "org.example.watch", {})};
  return solver.spawn(spawn);
}

}  // namespace

class TestGroups : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }

  void coloursNeverShareAParticle() {
    constexpr size_t kParticles = 300;
    ps::GroupLists groups(0, 0);
    std::vector<uint32_t> newIndex(kParticles);
    uint32_t random = 1;
    for (int round = 0; round < 5; ++round) {
      ps::GroupLists::Edits edits;
      edits.removed.assign(groups.count(), 0);
      for (size_t g = 0; g < groups.count(); g += 3) edits.removed[g] = 1;
      for (int k = 0; k < 150; ++k) {  // so many on so few that there are more than 64 colours
        std::set<uint32_t> members;
        while (members.size() < 100) members.insert((random = random * 1664525u + 1013904223u) >> 8 & 255);
        edits.particles.insert(edits.particles.end(), members.begin(), members.end());
        edits.ends.push_back(edits.particles.size());
      }
      groups.apply(edits, std::vector<uint32_t>(kParticles, 0));
      for (uint32_t i = 0; i < kParticles; ++i) newIndex[i] = kParticles - 1 - i;
      if (round == 3) newIndex[7] = ps::GroupLists::kGone;
      groups.renumber(newIndex);
      size_t seen = 0;
      for (size_t c = 0; c < groups.colours(); ++c) {
        std::set<uint32_t> used;
        for (size_t g = groups.colourStart(c); g < groups.colourStart(c + 1); ++g, ++seen) {
          for (const uint32_t i : groups.members(g)) QVERIFY(used.insert(i).second);
        }
      }
      QCOMPARE(seen, groups.count());
    }
    QVERIFY(groups.colours() > 64);
  }

  void groupsFollowTheirParticles() {
    const GroupWatch watch;
    Solver solver;
    const std::vector<uint32_t> ids = spawnWatched(solver, watch);
    QVERIFY(solver.constraintCount() > 150);
    QCOMPARE(solver.elasticEnergy(), static_cast<double>(solver.constraintCount()));
    QVERIFY(run(solver, 70));  // sorted more than once
    const ps::ExtractedMatter taken = solver.extract(std::vector<uint32_t>(ids.begin() + 100, ids.begin() + 200));
    const size_t left = solver.constraintCount();
    const uint64_t hash = solver.stateHash();
    solver.putBack(taken);
    QVERIFY(watch.returned > 100);  // overlapping groups: some came back to several
    QVERIFY(solver.constraintCount() >= left);
    QVERIFY(solver.stateHash() != hash);
    QVERIFY(run(solver, 30));
    solver.remove(std::vector<uint32_t>(ids.begin() + 300, ids.end()));
    QVERIFY(run(solver, 30));
    QVERIFY(watch.seen > 10000);
    QCOMPARE(watch.wrong.load(), 0);
  }

  void throwingGroupsArePutAside_data() {
    QTest::addColumn<int>("where");
    QTest::newRow("build") << static_cast<int>(GroupWatch::Build);
    QTest::newRow("predict") << static_cast<int>(GroupWatch::Predict);
    QTest::newRow("project") << static_cast<int>(GroupWatch::Project);
    QTest::newRow("derive velocities") << static_cast<int>(GroupWatch::Derive);
    QTest::newRow("topology") << static_cast<int>(GroupWatch::Topology);
    QTest::newRow("restore") << static_cast<int>(GroupWatch::Restore);
    QTest::newRow("energy") << static_cast<int>(GroupWatch::Energy);
  }
  void throwingGroupsArePutAside() {
    QFETCH(int, where);
    const GroupWatch watch(static_cast<GroupWatch::Where>(where));
    Solver solver;
    const std::vector<uint32_t> ids = spawnWatched(solver, watch);
    solver.elasticEnergy();
    solver.putBack(solver.extract(std::vector<uint32_t>(ids.begin(), ids.begin() + 5)));
    const StepReport report = solver.step();
    QCOMPARE(report.flags, static_cast<ps::StepFlags>(ps::StepFlag::PluginFault));
    QCOMPARE(QString::fromStdString(report.message), QString("plugin 'org.example.watch': no shape"));
    QCOMPARE(solver.constraintCount(), size_t{0});
    QVERIFY(run(solver, 30));  // said once, and the rest goes on
  }
};

QTEST_APPLESS_MAIN(TestGroups)
#include "tst_groups.moc"
