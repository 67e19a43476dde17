// SPDX-License-Identifier: Apache-2.0
// What structure is computed by, beside the plainest way to compute the same.
#include "core/base/parallel.h"
#include "core/solver/contact/nearneighbours.h"
#include "core/solver/solver.h"
#include "plugins/constraints/pairprojection.h"
#include "plugins/constraints/rigidpieces.h"
#include "tests/shared/random.h"

#include <QTest>

using ps::constraint::piecesOf;
using ps::constraint::Vector;

namespace {

/// Each pair asked.
std::vector<std::vector<size_t>> plainPieces(const std::vector<Vector>& points, double radius) {
  ps::constraint::DisjointSets sets(points.size());
  for (size_t a = 0; a < points.size(); ++a) {
    for (size_t b = a + 1; b < points.size(); ++b) {
      const Vector d = points[a] - points[b];
      if (dot(d, d) < radius * radius) sets.unite(a, b);
    }
  }
  return sets.sets();
}

/// The program's own, as its plugins have them.
class HostThreads final : public ps::api::Threads {
 public:
  void share(size_t count, size_t grain, double microseconds, void (*body)(void* data, size_t first, size_t last),
             void* data) const override {
    ps::parallelFor(
        count, grain, [&](size_t first, size_t last) { body(data, first, last); }, microseconds);
  }
};

/// Every instruction set that this machine has, by name; the best one again at the end.
template <class Call>
void onEachInstructionSet(Call&& call) {
  for (const std::string& name : ps::availableInstructionSets()) {
    ps::setInstructionSet(name);
    call(name);
  }
  ps::setInstructionSet("");
}

/// Particles in disorder, some of them fixed, and pairs of which none share one: as a colour of a lattice.
struct PairScene {
  PairScene(size_t pairs, double every) : period(every) {
    ps::testing::Random engine(11);
    const size_t count = 2 * pairs;
    for (size_t i = 0; i < count; ++i) {
      const auto at = [&] { return static_cast<float>(engine.next(-0.5, 1)); };
      const float x = at(), y = at(), z = at();
      position.push_back({x, y, z, 8e-6f});
      previous.push_back({x + 0.01f * at(), y + 0.01f * at(), z + 0.01f * at(), 0});
      velocity.push_back({0, 0, 0, i % 5 == 0 ? 0.0f : 100 + 50 * at()});
    }
    for (size_t i = 0; i < count; ++i) particles.push_back(static_cast<uint32_t>(i * 7 % count));  // 7: no divisor
    position[particles[7]] = position[particles[6]];                                               // no direction
    velocity[particles[10]].w = velocity[particles[11]].w = 0;
    for (size_t k = 0; k < pairs; ++k) {
      length.push_back(static_cast<float>(engine.next(0.1, 0.5)));
      multiplier.push_back(static_cast<float>(engine.next(-1e-5, 2e-5)));
      compliance.push_back(static_cast<float>(engine.next(0, 1e-5)));
      kind.push_back(static_cast<float>(k % 3));
    }
  }
  template <class Call>
  void with(double damping, Call&& call) {
    ps::api::ParticleView view{};
    view.count = position.size();
    view.position = position.data(), view.previous = previous.data(), view.velocity = velocity.data();
    view.period = {period, 0, period};
    const ps::api::MovableParticles movable{&view, position.data(), velocity.data()};
    call(movable, ps::constraint::Pairs{length.size(), particles.data(), length.data(), multiplier.data(),
                                        static_cast<float>(damping)});
  }
  std::string bytes() const {
    const auto of = [](const auto& list) {
      return std::string(reinterpret_cast<const char*>(list.data()), sizeof(list[0]) * list.size());
    };
    return of(position) + of(multiplier);
  }
  double period;
  std::vector<ps::api::Float4> position, previous, velocity;
  std::vector<uint32_t> particles;
  std::vector<float> length, multiplier, compliance, kind;
};

class TstStructureKernels : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void piecesAreThoseOfEachPairAsked_data() {
    QTest::addColumn<int>("count");
    QTest::addColumn<double>("size");
    QTest::addColumn<double>("radius");
    QTest::newRow("none") << 0 << 1.0 << 0.1;
    QTest::newRow("one") << 1 << 1.0 << 0.1;
    QTest::newRow("few far apart") << 40 << 1e6 << 0.1;
    QTest::newRow("many pieces") << 500 << 1.0 << 0.1;
    QTest::newRow("some pieces") << 500 << 1.0 << 0.15;
    QTest::newRow("thousands in some pieces") << 4000 << 1.0 << 0.06;
    QTest::newRow("thousands in one") << 4000 << 1.0 << 0.2;
    QTest::newRow("all within one cell") << 60 << 0.01 << 0.5;
  }
  void piecesAreThoseOfEachPairAsked() {
    QFETCH(int, count);
    QFETCH(double, size);
    QFETCH(double, radius);
    ps::testing::Random engine(7);
    std::vector<Vector> points;
    for (int k = 0; k < count; ++k) {
      const double x = engine.next(-0.3, size), y = engine.next(2, size), z = engine.next(0, size);
      points.push_back({x, y, z});
    }
    const auto plain = plainPieces(points, radius);
    QCOMPARE(piecesOf(points, radius), plain);
    ps::setThreadCount(5);
    const HostThreads threads;
    for (int time = 0; time < 5; ++time) QCOMPARE(piecesOf(points, radius, {}, &threads), plain);
    ps::setThreadCount(0);
  }
  void pairsMoveAsOneAfterTheOther_data() {
    QTest::addColumn<double>("damping");
    QTest::addColumn<double>("period");
    QTest::newRow("without friction") << 0.0 << 0.0;
    QTest::newRow("with friction") << 0.7 << 0.0;
    QTest::newRow("periodic") << 0.7 << 0.6;
  }
  /// Bit for bit, with a rest that no vector fills.
  void pairsMoveAsOneAfterTheOther() {
    QFETCH(double, damping);
    QFETCH(double, period);
    const auto passes = [&](bool springs, bool plain) {
      PairScene scene(101, period);
      const ps::constraint::BondSoftness bonds{scene.compliance.data(), 1e4f};
      const ps::constraint::SpringSoftness ofKinds{scene.kind.data(), {0.002f, -1, 0.01f}, 0.005f};
      for (int pass = 0; pass < 3; ++pass) {
        scene.with(damping, [&](const auto& particles, const auto& pairs) {
          if (springs)
            plain ? projectPairsPlainly(particles, pairs, ofKinds) : projectPairs(particles, pairs, ofKinds);
          else
            plain ? projectPairsPlainly(particles, pairs, bonds) : projectPairs(particles, pairs, bonds);
        });
      }
      return scene.bytes();
    };
    for (const bool springs : {false, true}) {
      const std::string expected = passes(springs, true);
      QVERIFY(expected != PairScene(101, period).bytes());
      onEachInstructionSet(
          [&](const std::string& name) { QVERIFY2(passes(springs, false) == expected, name.c_str()); });
    }
  }
  void nearNeighboursAreThoseOfOneAfterTheOther() {
    ps::testing::Random engine(13);
    ps::ParticleStore store;
    store.add(700);
    for (size_t i = 0; i < store.size(); ++i) {
      const auto at = [&] { return static_cast<float>(engine.next(-0.1, 0.2)); };
      const float x = at(), y = at(), z = at();
      store.position()[i] = {x, y, z, 8e-6f};
    }
    ps::Neighbours neighbours;
    neighbours.configure(0.04, 0.004);
    neighbours.build(store);
    const ps::NearNeighbours near(store, neighbours);
    const float square = 0.03f * 0.03f;
    size_t all = 0, found = 0;
    std::vector<uint32_t> room, plain(1000);
    for (uint32_t i = 0; i < store.size(); ++i) {
      plain.resize(plain.capacity());
      plain.resize(near.findPlainly(i, square, plain.data()));
      onEachInstructionSet([&](const std::string&) {
        const std::span<const uint32_t> list = near.of(i, square, room);
        QVERIFY(std::equal(list.begin(), list.end(), plain.begin(), plain.end()));
      });
      found += plain.size();
      all += neighbours.view().last[i] - neighbours.view().begin[i];
    }
    QVERIFY(found > store.size() && all > 2 * found);
  }
  void aLatticeWithAGapFallsApart() {
    // Steps of 1 and 1.414 hang together below 1.5, those of 1.732 and more do not.
    std::vector<Vector> points;
    for (int x = 0; x < 12; ++x) {
      for (int y = 0; y < 5; ++y) {
        for (int z = 0; z < 5; ++z) {
          if (x != 6) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
        }
      }
    }
    const auto pieces = piecesOf(points, 1.5);
    QCOMPARE(pieces.size(), size_t{2});
    QCOMPARE(pieces[0].size(), size_t{150});
    QCOMPARE(pieces[1].size(), size_t{125});
  }
};

}  // namespace

QTEST_GUILESS_MAIN(TstStructureKernels)
#include "tst_structurekernels.moc"
