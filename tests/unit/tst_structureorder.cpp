// SPDX-License-Identifier: Apache-2.0
// Who is tied to whom as constraints come, go and are put in another order, beside the plainest way to keep it.
#include "core/base/parallel.h"
#include "core/solver/structure/constraintsystem.h"
#include "core/solver/structure/piecelists.h"
#include "tests/shared/random.h"

#include <QTest>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace {

using Pair = std::pair<uint32_t, uint32_t>;  // ids, the lower one first

/// Ties the pairs that it is told, each with its number as a value, and lets go of those that it is told.
class Ties final : public ps::api::Described<ps::api::StructuralPlugin> {
 public:
  Ties() : Described({"Ties", "Ties pairs.", {}}) {}
  bool traits(ps::api::StructuralTraits* out) const override {
    static constexpr ps::api::FieldDeclaration kValues[] = {
        {"number", "", "Which pair it is", ps::api::FieldType::Float32}};
    return ps::api::fill(out, {.arity = 2, .values = ps::api::listOf(kValues)});
  }
  void build(const ps::api::ConstraintContext&, const ps::api::ParticleView& p, const ps::api::NeighbourView&,
             ps::api::Span<const uint32_t>, ps::api::ConstraintSink& sink) const override {
    addNew(p, sink);
  }
  void project(const ps::api::ConstraintContext&, const ps::api::MovableParticles&,
               const ps::api::ConstraintBatch&) const override {}
  void topology(const ps::api::ConstraintContext&, const ps::api::ParticleView& p, const ps::api::NeighbourView&,
                const ps::api::ConstraintBatch& all, ps::api::ConstraintSink& sink) const override {
    for (size_t k = 0; k < all.count; ++k) {
      if (goes.contains(static_cast<size_t>(all.values[0][k]))) sink.remove(k);
    }
    addNew(p, sink);
  }
  /// Notes all that there are.
  double energy(const ps::api::ConstraintContext&, const ps::api::ParticleView& p,
                const ps::api::ConstraintBatch& batch) const override {
    for (size_t k = 0; k < batch.count; ++k) {
      const uint32_t a = p.id[batch.particles[2 * k]], b = p.id[batch.particles[2 * k + 1]];
      seen.push_back({{std::min(a, b), std::max(a, b)}, static_cast<size_t>(batch.values[0][k])});
      firsts.push_back(batch.particles[2 * k]);
    }
    return 0;
  }
  mutable std::vector<std::pair<Pair, size_t>> fresh;  // to be tied
  mutable std::vector<std::pair<Pair, size_t>> seen;
  mutable std::vector<uint32_t> firsts;
  std::set<size_t> goes;

 private:
  void addNew(const ps::api::ParticleView& p, ps::api::ConstraintSink& sink) const {
    std::vector<uint32_t> indexOf(p.count);
    for (uint32_t i = 0; i < p.count; ++i) indexOf.at(p.id[i]) = i;
    for (const auto& [pair, number] : fresh) {
      const uint32_t particles[] = {indexOf[pair.first], indexOf[pair.second]};
      const float value = static_cast<float>(number);
      sink.add(particles, &value);
    }
    fresh.clear();
  }
};

/// Particles of three bodies, and ties between near ones: a few large pieces, many small ones, and single particles.
struct Scene {
  static constexpr uint32_t kCount = 6000;
  Scene() {
    store.add(kCount);
    for (uint32_t i = 0; i < kCount; ++i) {
      store.position()[i] = {0.01f * static_cast<float>(i), 0, 0, 1e-6f};
      store.body()[i] = i / 2000;
    }
    neighbours.configure(0.015, 0.001);
    neighbours.build(store);
    system.configure({}, {});
    set = system.addSet(static_cast<const ps::api::StructuralPlugin*>(&ties), "ties", {}, store);
    addPairs(9000);
    members.resize(kCount);
    std::iota(members.begin(), members.end(), 0u);
    system.build(set, store, neighbours, members);
  }
  /// What is tied from now on.
  void addPairs(size_t count) {
    for (size_t k = 0; k < count; ++k) {
      const auto low = static_cast<uint32_t>(random.next(0, kCount - 9));
      const auto high = low + 1 + static_cast<uint32_t>(random.next(0, low % 1000 < 700 ? 7.99 : 0.01));
      if (low % 50 > 46 || !model.try_emplace({low, high}, next).second) continue;
      ties.fresh.push_back({{low, high}, next++});
    }
  }
  /// A topology in which about one of `every` lets go, and `count` come.
  void edit(size_t every, size_t count) {
    ties.goes.clear();
    for (auto at = model.begin(); at != model.end();) {
      const bool goes = random.next(0, static_cast<double>(every)) < 1;
      if (goes) ties.goes.insert(at->second);
      at = goes ? model.erase(at) : std::next(at);
    }
    addPairs(count);
    system.topology(store, neighbours);
  }
  void shuffle() {
    std::vector<uint32_t> order(kCount);
    std::iota(order.begin(), order.end(), 0u);
    for (uint32_t i = kCount - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<uint32_t>(random.next(0, i + 0.999))]);
    store.permute(order);
    neighbours.build(store);
    system.remap(order);
  }
  /// All that are tied, and their numbers.
  std::map<Pair, size_t> tied() {
    ties.seen.clear();
    ties.firsts.clear();
    system.energy(store);
    return {ties.seen.begin(), ties.seen.end()};
  }
  /// By index, the lowest index of its piece, each tie followed.
  std::vector<uint32_t> plainPieces() const {
    std::vector<std::vector<uint32_t>> partners(kCount);
    for (const auto& [pair, number] : model) {
      const auto a = static_cast<uint32_t>(store.indexOf(pair.first)),
                 b = static_cast<uint32_t>(store.indexOf(pair.second));
      partners[a].push_back(b);
      partners[b].push_back(a);
    }
    std::vector<uint32_t> piece(kCount, ps::ConstraintSystem::kNoPiece), open;
    for (uint32_t first = 0; first < kCount; ++first) {
      if (piece[first] != ps::ConstraintSystem::kNoPiece || partners[first].empty()) continue;
      piece[first] = first;
      for (open = {first}; !open.empty();) {
        const uint32_t i = open.back();
        open.pop_back();
        for (const uint32_t j : partners[i]) {
          if (piece[j] == ps::ConstraintSystem::kNoPiece) piece[j] = first, open.push_back(j);
        }
      }
    }
    return piece;
  }

  ps::testing::Random random{5};
  ps::ParticleStore store;
  ps::Neighbours neighbours;
  Ties ties;
  ps::ConstraintSystem system;
  std::map<Pair, size_t> model;
  std::vector<uint32_t> members;
  size_t next = 0;
  uint32_t set = 0;
};

/// Of GroupLists, each with a number of its own as its value.
struct Group {
  std::vector<uint32_t> particles;
  float number;
  uint32_t body;
};

/// Each in the first colour that none of its particles has; in order of bodies.
std::vector<std::vector<Group>> colouredPlainly(std::vector<Group> groups) {
  std::vector<std::set<uint32_t>> taken;
  std::vector<std::vector<Group>> colours;
  for (Group& group : groups) {
    size_t colour = 0;
    const auto isTaken = [&](uint32_t i) { return taken[colour].contains(i); };
    while (colour < taken.size() && std::any_of(group.particles.begin(), group.particles.end(), isTaken)) ++colour;
    if (colour == taken.size()) taken.emplace_back(), colours.emplace_back();
    taken[colour].insert(group.particles.begin(), group.particles.end());
    colours[colour].push_back(std::move(group));
  }
  for (std::vector<Group>& colour : colours)
    std::stable_sort(colour.begin(), colour.end(), [](const Group& a, const Group& b) { return a.body < b.body; });
  return colours;
}

class TestStructureOrder : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() { ps::setThreadCount(0); }

  /// Ties come, go, come and go at once, while particles are put in another order; nobody is lost, each keeps its
  /// value.
  void tiesStayWhatTheyAre() {
    for (const int threads : {1, 2, 5}) {
      ps::setThreadCount(threads);
      Scene scene;
      QVERIFY(scene.model.size() > 4000);
      QVERIFY(scene.tied() == scene.model);
      for (int round = 0; round < 4; ++round) {
        scene.edit(10, 0);
        QVERIFY(scene.tied() == scene.model);
        scene.edit(20, 800);
        QVERIFY(scene.tied() == scene.model);
        scene.edit(1000000, 500);
        scene.shuffle();
        QVERIFY(scene.tied() == scene.model);
        QCOMPARE(scene.ties.seen.size(), scene.model.size());
      }
    }
  }

  void piecesAreThoseOfTheTies() {
    for (const int threads : {1, 2, 5}) {
      ps::setThreadCount(threads);
      Scene scene;
      for (int round = 0; round < 4; ++round) {
        const std::vector<uint32_t> pieces = scene.system.pieces(Scene::kCount), plain = scene.plainPieces();
        QVERIFY(pieces == plain);
        const std::set<uint32_t> all(plain.begin(), plain.end());
        QVERIFY2(all.size() > 20, "several, or one could be everybody's");
        scene.edit(5, 200);
        scene.shuffle();
      }
    }
  }

  /// The graph has each tie at both ends, for any number of threads in the same order.
  void graphIsTheSameForAnyNumberOfThreads() {
    std::vector<uint32_t> partners;
    for (const int threads : {1, 2, 5}) {
      ps::setThreadCount(threads);
      Scene scene;
      scene.edit(8, 300);
      const ps::StructureGraph& graph = scene.system.graph(Scene::kCount);
      QCOMPARE(graph.partner.size(), 2 * scene.model.size());
      for (const auto& [pair, number] : scene.model)
        QVERIFY(graph.tied(static_cast<uint32_t>(scene.store.indexOf(pair.first)),
                           static_cast<uint32_t>(scene.store.indexOf(pair.second))));
      if (partners.empty()) partners = graph.partner;
      QVERIFY(graph.partner == partners);
    }
  }

  /// Pieces that lie in runs, between each other and what belongs to none.
  void piecesListTheirMembersInOrder() {
    constexpr size_t kParticles = 9000;
    ps::testing::Random random(3);
    std::vector<uint32_t> pieceOf(kParticles, ps::ConstraintSystem::kNoPiece);
    std::map<int, uint32_t> firstOf;
    std::map<uint32_t, std::vector<uint32_t>> members;
    for (uint32_t i = 0, piece = 0; i < kParticles; ++i) {
      if (random.next() < 0.1) piece = static_cast<uint32_t>(random.next(0, 40));
      if (piece < 5) continue;
      pieceOf[i] = firstOf.try_emplace(static_cast<int>(piece), i).first->second;
      members[pieceOf[i]].push_back(i);
    }
    ps::PieceLists lists;
    for (const int threads : {1, 5}) {
      ps::setThreadCount(threads);
      lists.refresh(pieceOf);
      QCOMPARE(lists.count(), members.size());
      std::vector<uint32_t> all;
      for (size_t piece = 0; const auto& [first, own] : members) {
        QCOMPARE(lists.pieceOf(first), piece);
        const std::span<const uint32_t> listed = lists.members(piece++);
        QVERIFY(std::equal(listed.begin(), listed.end(), own.begin(), own.end()));
        all.insert(all.end(), own.begin(), own.end());
      }
      std::vector<uint32_t> parts;
      lists.eachPart(100, all.size() - 7, [&](size_t piece, std::span<const uint32_t> part) {
        for (const uint32_t i : part) QCOMPARE(lists.pieceOf(pieceOf[i]), piece);
        parts.insert(parts.end(), part.begin(), part.end());
      });
      QVERIFY(std::equal(parts.begin(), parts.end(), all.begin() + 100, all.end() - 7));
    }
    lists.refresh(std::vector<uint32_t>(5000, ps::ConstraintSystem::kNoPiece));
    QCOMPARE(lists.count(), size_t{0});
    QVERIFY(lists.members().empty());
  }

  void groupsLieInOrderOfColourAndBody_data() {
    QTest::addColumn<bool>("overlap");
    QTest::newRow("apart") << false;
    QTest::newRow("overlapping") << true;
  }
  /// With their values and those of their members, as groups come and go.
  void groupsLieInOrderOfColourAndBody() {
    QFETCH(bool, overlap);
    constexpr uint32_t kParticles = 20000;
    ps::testing::Random random(11);
    std::vector<uint32_t> body(kParticles);
    for (uint32_t i = 0; i < kParticles; ++i) body[i] = i / 1000 % 3;
    ps::GroupLists lists(1, 2);
    std::vector<Group> model;
    float number = 0;
    uint32_t from = 0;
    for (const int threads : {1, 2, 5}) {
      ps::setThreadCount(threads);
      ps::GroupLists::Edits edits;
      edits.removed.assign(lists.count(), 0);
      for (uint8_t& removed : edits.removed) removed = random.next() < 0.3 ? 1 : 0;
      std::vector<Group> groups;
      for (size_t g = 0; g < model.size(); ++g) {
        if (edits.removed[g] == 0) groups.push_back(model[g]);
      }
      for (int k = 0; k < 12; ++k) {
        Group group{{}, ++number, body[from]};
        const auto count = static_cast<uint32_t>(random.next(1, 500));
        for (uint32_t i = from; i < from + count; ++i) group.particles.push_back(i);
        from += overlap ? count / 2 : count;
        edits.particles.insert(edits.particles.end(), group.particles.begin(), group.particles.end());
        edits.ends.push_back(edits.particles.size());
        edits.values.push_back(group.number);
        for (const uint32_t i : group.particles) {
          edits.memberValues.push_back(static_cast<float>(i));
          edits.memberValues.push_back(group.number);
        }
        groups.push_back(std::move(group));
      }
      lists.apply(edits, body);
      const std::vector<std::vector<Group>> colours = colouredPlainly(std::move(groups));
      QCOMPARE(lists.colours(), colours.size());
      QCOMPARE(colours.size() > 1, overlap);
      model.clear();
      for (size_t colour = 0; colour < colours.size(); ++colour) {
        QCOMPARE(lists.colourStart(colour), model.size());
        model.insert(model.end(), colours[colour].begin(), colours[colour].end());
      }
      QCOMPARE(lists.count(), model.size());
      ps::GroupLists::Batch batch;
      lists.fill(batch, 0, lists.count());
      for (size_t g = 0; g < model.size(); ++g) {
        const std::span<const uint32_t> members = lists.members(g);
        QVERIFY(std::equal(members.begin(), members.end(), model[g].particles.begin(), model[g].particles.end()));
        QCOMPARE(lists.body(g), model[g].body);
        QCOMPARE(batch.values[0][g], model[g].number);
        for (size_t k = batch.view.begin[g]; k < batch.view.begin[g + 1]; ++k) {
          QCOMPARE(batch.memberValues[0][k], static_cast<float>(batch.view.particles[k]));
          QCOMPARE(batch.memberValues[1][k], model[g].number);
        }
      }
    }
  }

  /// Behind particles that lie in another order, ties are put in that order again within their body and colour.
  void tiesFollowTheOrderOfParticles() {
    Scene scene;
    scene.shuffle();
    scene.tied();
    size_t behind = 0;
    for (size_t k = 1; k < scene.ties.firsts.size(); ++k)
      behind += scene.ties.firsts[k] < scene.ties.firsts[k - 1] ? 1 : 0;
    QVERIFY2(behind < 100, "runs begin anew, and nothing else does");
  }
};

}  // namespace

QTEST_APPLESS_MAIN(TestStructureOrder)
#include "tst_structureorder.moc"
