// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/particles/cellgrid.h"
#include "core/particles/neighbours.h"
#include "tests/shared/random.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

using ps::Neighbours;
using ps::ParticleStore;
using ps::testing::Random;

namespace {

constexpr double kSupport = 0.04, kSkin = 0.004;

void place(ParticleStore& store, size_t i, double x, double y, double z) {
  store.position()[i] = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 8e-6f};
}

void fill(ParticleStore& store, const QString& kind) {
  Random random(7);
  const auto anywhere = [&](size_t i, double size) {
    place(store, i, size * random.next() - 1, size * random.next(), size * random.next() + 3);
  };
  if (kind == "lattice") {
    size_t i = store.add(11 * 9 * 8);
    for (int z = 0; z < 8; ++z) {
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 11; ++x) place(store, i++, 0.02 * x, 0.02 * y, 0.02 * z);
      }
    }
  } else if (kind == "clusters") {
    size_t i = store.add(600);
    for (int c = 0; c < 6; ++c) {
      const double at[3] = {5 * random.next(), 5 * random.next(), 5 * random.next()};
      for (int k = 0; k < 100; ++k) {
        place(store, i++, at[0] + 0.08 * random.next(), at[1] + 0.08 * random.next(), at[2] + 0.08 * random.next());
      }
    }
  } else if (kind == "one far away") {
    store.add(300);
    for (size_t i = 0; i < 299; ++i) anywhere(i, 0.2);
    place(store, 299, 4000, -300, 90);
  } else if (kind == "alone") {
    store.add(1);
  } else {
    store.add(800);
    for (size_t i = 0; i < 800; ++i) anywhere(i, 0.25);
  }
}

/// Empty when the lists are right, else what is wrong. Particles before `from` that these do not name
/// may have none.
QString problemOf(const ParticleStore& store, const Neighbours& neighbours, uint32_t from = 0) {
  const ps::api::NeighbourView view = neighbours.view();
  const float radius2 = static_cast<float>((kSupport + kSkin) * (kSupport + kSkin));
  const ps::api::Float4* p = store.position();
  std::vector<uint8_t> isNamed(store.size(), 0);
  for (uint32_t i = from; i < store.size(); ++i)
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) isNamed[view.index[q]] = 1;
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (i < from && isNamed[i] == 0) continue;
    std::vector<uint32_t> expected;
    for (uint32_t j = 0; j < store.size(); ++j) {
      const float x = p[i].x - p[j].x, y = p[i].y - p[j].y, z = p[i].z - p[j].z;
      if (j != i && x * x + (y * y + z * z) < radius2) expected.push_back(j);
    }
    std::vector<uint32_t> found(view.index + view.begin[i], view.index + view.last[i]);
    std::sort(found.begin(), found.end());  // the order is the search's own
    if (found != expected) {
      return QString("particle %1: %2 neighbours found, %3 expected").arg(i).arg(found.size()).arg(expected.size());
    }
    if ((view.end[i] - view.begin[i]) % Neighbours::kListPad != 0) return QString("particle %1: not padded").arg(i);
    for (uint32_t q = view.last[i]; q < view.end[i]; ++q) {
      if (view.index[q] != store.size()) return QString("particle %1: padded with something else").arg(i);
    }
  }
  return {};
}

/// Of all fields, particles in order of id.
uint64_t hashOf(const ParticleStore& store) {
  std::vector<uint32_t> order(store.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return store.id()[a] < store.id()[b]; });
  ps::Hash hash;
  for (const auto& [name, bytes] : store.copy(order).fields) hash.add(bytes.data(), bytes.size());
  return hash.value();
}

}  // namespace

class TestParticles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void listsEqualBruteForce_data() {
    QTest::addColumn<int>("threads");
    for (const char* kind : {"random", "lattice", "clusters", "one far away", "alone"}) {
      for (const int threads : {1, 4}) QTest::addRow("%s, %d threads", kind, threads) << threads;
    }
  }
  void listsEqualBruteForce() {
    QFETCH(int, threads);
    ps::setThreadCount(threads);
    const QString kind = QString(QTest::currentDataTag()).section(',', 0, 0);
    ParticleStore store;
    fill(store, kind);
    Neighbours neighbours;
    neighbours.configure(kSupport, kSkin);
    QVERIFY(neighbours.stale(store));
    neighbours.build(store);
    QCOMPARE(problemOf(store, neighbours), QString());
    QVERIFY(!neighbours.stale(store));

    const uint64_t before = hashOf(store);
    neighbours.sortAndBuild(store);
    QCOMPARE(problemOf(store, neighbours), QString());
    QCOMPARE(hashOf(store), before);  // sorting changes places, not particles

    Random random(3);
    for (size_t i = 0; i < store.size(); ++i) store.position()[i].x += static_cast<float>(0.1 * random.next());
    QVERIFY(neighbours.stale(store));
    neighbours.build(store);
    QCOMPARE(problemOf(store, neighbours), QString());

    const size_t first = store.add(20);
    for (size_t i = first; i < store.size(); ++i) place(store, i, 0.1 * random.next() - 1, 0.1 * random.next(), 3);
    QVERIFY(neighbours.stale(store));
    neighbours.buildOf(store, first);
    QCOMPARE(problemOf(store, neighbours, first > 20 ? static_cast<uint32_t>(first) : 0), QString());
    QCOMPARE(neighbours.stale(store), first > 20);  // of a few, else they are made of all
    neighbours.build(store);
    QCOMPARE(problemOf(store, neighbours), QString());
    const std::vector<uint32_t> gone{0, 5, 6, 20};
    store.remove(gone);
    neighbours.sortAndBuild(store);
    QCOMPARE(problemOf(store, neighbours), QString());
    ps::setThreadCount(0);
  }

  /// Lists that are kept where nobody has moved are those that would be made, in the same order, while others fly about
  /// and the box around all of them grows and shrinks, at its lower faces too, where cells begin.
  void keptListsAreThoseThatWouldBeMade() {
    for (const int threads : {1, 4}) {
      ps::setThreadCount(threads);
      Random random(9);
      ParticleStore store;
      constexpr size_t kStanding = 4000, kAll = 4600;
      store.add(kAll);
      for (size_t i = 0; i < kStanding; ++i)
        place(store, i, 0.02 * static_cast<double>(i % 40), 0.02 * static_cast<double>(i / 40 % 10),
              0.02 * static_cast<double>(i / 400));
      const auto fly = [&](size_t i) {
        place(store, i, 1.4 * random.next(), 0.5 * random.next(), 0.4 * random.next());
      };
      for (size_t i = kStanding; i < kAll; ++i) fly(i);
      Neighbours kept;
      kept.configure(kSupport, kSkin);
      kept.sortAndBuild(store);
      std::vector<size_t> flying;
      for (size_t i = 0; i < kAll; ++i) {
        if (store.id()[i] >= kStanding) flying.push_back(i);
      }
      for (int round = 0; round < 30; ++round) {
        const size_t some = round % 3 == 0 ? flying.size() : 5;
        for (size_t k = 0; k < some; ++k) fly(flying[(k * 7 + static_cast<size_t>(round)) % flying.size()]);
        if (round == 20) store.position()[7].x += 0.001f;  // and what stood has moved once
        if (round == 10) store.position()[flying[0]].x = -0.3f;
        kept.build(store);
        Neighbours fresh;
        fresh.configure(kSupport, kSkin);
        fresh.build(store);
        const ps::api::NeighbourView a = kept.view(), b = fresh.view();
        for (size_t i = 0; i < kAll; ++i) {
          QVERIFY(std::equal(a.index + a.begin[i], a.index + a.last[i], b.index + b.begin[i], b.index + b.last[i]));
          QCOMPARE(a.end[i] - a.begin[i], b.end[i] - b.begin[i]);
          QVERIFY(a.end[i] <= a.slots);
        }
        QVERIFY2(a.slots < 2 * b.slots, "rooms that were left are given back");
      }
    }
    ps::setThreadCount(0);
  }

  /// Every image within the radius counts once. Pairs that lie on the radius to rounding may be in or out.
  void listsEqualBruteForceAcrossFaces_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("z");
    const double least = Neighbours::leastPeriod(kSupport + kSkin);
    QTest::newRow("along x") << 0.25 << 0.0 << 0.0;
    QTest::newRow("along y and z") << 0.0 << 0.26 << 0.3;
    QTest::newRow("three cells") << least << least << least;
    QTest::newRow("wider than its particles") << 900.0 << 0.3 << 0.0;
  }
  void listsEqualBruteForceAcrossFaces() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, z);
    const double length[3] = {x, y, z};
    const ps::Period period({-1, 0, 3}, {-1 + x, y, 3 + z}, {x > 0, y > 0, z > 0});
    ParticleStore store;
    fill(store, "random");
    store.setPeriod(period);
    Random random(5);
    for (size_t i = 0; i < store.size(); i += 3) {  // some lie in other images
      store.position()[i].x += static_cast<float>(x * std::floor(6 * random.next() - 3));
      store.position()[i].y += static_cast<float>(y * std::floor(6 * random.next() - 3));
      store.position()[i].z -= static_cast<float>(z * std::floor(6 * random.next() - 3));
    }
    Neighbours neighbours;
    neighbours.configure(kSupport, kSkin);
    for (int pass = 0; pass < 2; ++pass) {
      if (pass == 0)
        neighbours.build(store);
      else
        neighbours.sortAndBuild(store);
      const ps::api::NeighbourView view = neighbours.view();
      size_t pairs = 0;
      for (uint32_t i = 0; i < store.size(); ++i) {
        std::vector<uint32_t> found(view.index + view.begin[i], view.index + view.last[i]);
        if (pass == 1) QVERIFY(std::is_sorted(found.begin(), found.end()));
        std::sort(found.begin(), found.end());
        QVERIFY(std::adjacent_find(found.begin(), found.end()) == found.end());
        for (uint32_t j = 0; j < store.size(); ++j) {
          if (j == i) continue;
          double square = 0;
          const ps::api::Float4 &a = store.position()[i], &b = store.position()[j];
          const double d[3] = {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
          for (size_t axis = 0; axis < 3; ++axis) {
            const double image = length[axis] > 0 ? std::remainder(d[axis], length[axis]) : d[axis];
            square += image * image;
          }
          const double gap = std::sqrt(square) - (kSupport + kSkin);
          const bool listed = std::binary_search(found.begin(), found.end(), j);
          // A coordinate of 900 m is known to 6e-5 m.
          const double rounding = x > 100 ? 4e-4 : 1e-6;
          if (std::abs(gap) > rounding) QCOMPARE(listed, gap < 0);
          const ps::api::Float4 there = store.separation(i, j), back = ps::api::separation(store.view(), j, i);
          QVERIFY(std::abs(std::sqrt(there.x * there.x + there.y * there.y + there.z * there.z) -
                           std::sqrt(back.x * back.x + back.y * back.y + back.z * back.z)) < 1e-5f);
          if (listed) QVERIFY(there.x == -store.separation(j, i).x && there.y == -store.separation(j, i).y);
          pairs += listed ? 1 : 0;
        }
      }
      QVERIFY(pairs > 1000);
    }
  }

  void cellsAroundAPlaceHoldWhatIsNear_data() {
    QTest::addColumn<bool>("repeats");
    QTest::newRow("open") << false;
    QTest::newRow("across the faces of a period along x and z") << true;
  }
  /// Against all pairs; a place beyond the box, or that is no number, must not lead out of the grid.
  void cellsAroundAPlaceHoldWhatIsNear() {
    QFETCH(bool, repeats);
    constexpr double kEdge = 0.09;
    const ps::Period period = repeats ? ps::Period({-0.5, 0, 0}, {0.5, 1, 0.4}, {true, false, true}) : ps::Period();
    Random random(3);
    std::vector<ps::api::Double3> places(400);
    for (ps::api::Double3& p : places) p = period.wrapped({random.next() - 0.5, random.next(), 0.4 * random.next()});
    places[7].y = std::nan("");
    ps::CellGrid grid;
    grid.sort(places.size(), kEdge, period, [&](size_t i) { return places[i]; });
    QVERIFY(grid.cells(0) > 3 && grid.cells(1) > 3 && grid.cells(2) > 3);
    const auto near = [&](const ps::api::Double3& a, const ps::api::Double3& b) {
      auto x = static_cast<float>(a.x - b.x), y = static_cast<float>(a.y - b.y), z = static_cast<float>(a.z - b.z);
      period.shorten(x, y, z);
      return double{x} * double{x} + double{y} * double{y} + double{z} * double{z} < 0.999 * kEdge * kEdge;
    };
    std::vector<ps::api::Double3> asked = places;
    asked.push_back({0, -20, 0.2});
    for (const ps::api::Double3& place : asked) {
      std::vector<uint32_t> found, wanted;
      grid.around(place, [&](uint32_t first, uint32_t last) {
        for (uint32_t slot = first; slot < last; ++slot) {
          const uint32_t i = grid.order()[slot];
          if (near(places[i], place)) found.push_back(i);
        }
      });
      for (uint32_t i = 0; i < places.size(); ++i) {
        if (near(places[i], place)) wanted.push_back(i);
      }
      std::sort(found.begin(), found.end());
      QCOMPARE(found, wanted);  // each of them once
    }
  }

  /// A crowd takes much room for itself, not for all others; and what comes together, or apart, finds its lists.
  void crowdsHaveTheirLists() {
    constexpr size_t kAll = 20000, kCrowd = 1500;
    ParticleStore store;
    store.add(kAll);
    Random random(9);
    for (size_t i = 0; i < kAll; ++i)
      store.position()[i] = {static_cast<float>(4 * random.next()), static_cast<float>(4 * random.next()),
                             static_cast<float>(4 * random.next()), 0};
    std::vector<ps::api::Float4> apart(store.position(), store.position() + kAll);
    ps::Neighbours neighbours;
    neighbours.configure(0.1, 0.01);
    for (const size_t crowd : {size_t{0}, kCrowd, size_t{0}}) {
      for (size_t i = 0; i < kAll; ++i) {
        store.position()[i] = apart[i];
        if (i < crowd) store.position()[i].x = 2 + 0.01f * store.position()[i].x / 4;
        if (i < crowd) store.position()[i].y = 2 + 0.01f * store.position()[i].y / 4;
        if (i < crowd) store.position()[i].z = 2 + 0.01f * store.position()[i].z / 4;
      }
      neighbours.build(store);
      neighbours.build(store);  // the room of the first one is what was needed before
      const ps::api::NeighbourView view = neighbours.view();
      size_t sum = 0;
      std::vector<std::pair<uint32_t, uint32_t>> ranges;
      for (size_t i = 0; i < kAll; ++i) {
        QVERIFY(view.begin[i] <= view.last[i] && view.last[i] <= view.end[i]);
        ranges.emplace_back(view.begin[i], view.end[i]);
        if (i < crowd) QVERIFY(view.last[i] - view.begin[i] >= crowd - 1);
        sum += view.end[i] - view.begin[i];
      }
      // Each entry is of one list, and few are of none.
      std::sort(ranges.begin(), ranges.end());
      for (size_t k = 1; k < kAll; ++k) QVERIFY(ranges[k - 1].second <= ranges[k].first);
      QVERIFY(ranges.back().second <= view.slots);
      QVERIFY2(view.slots < 1.05 * sum + kAll / 4, qPrintable(QString::number(view.slots)));
      for (size_t i = 0; i < kAll; i += 997) {
        size_t near = 0;
        for (size_t j = 0; j < kAll; ++j) {
          const ps::api::Float4 d = store.separation(i, j);
          near += j != i && d.x * d.x + d.y * d.y + d.z * d.z < 0.11f * 0.11f ? 1 : 0;
        }
        QCOMPARE(size_t{view.last[i] - view.begin[i]}, near);
      }
    }
  }

  /// So many that several threads sort them: as one alone does, and each cell's in their order.
  void threadsSortCellsAlike() {
    Random random(5);
    std::vector<ps::api::Double3> places(100000);
    for (ps::api::Double3& p : places) p = {random.next(), random.next(), random.next()};
    const int threads = ps::threadCount();
    std::array<ps::CellGrid, 2> grids;
    for (size_t k = 0; k < grids.size(); ++k) {
      ps::setThreadCount(k == 0 ? 1 : 4);
      grids[k].sort(places.size(), 0.05, {}, [&](size_t i) { return places[i]; });
    }
    const auto same = [](std::span<const uint32_t> a, std::span<const uint32_t> b) {
      return std::equal(a.begin(), a.end(), b.begin(), b.end());
    };
    QVERIFY(same(grids[0].order(), grids[1].order()) && same(grids[0].starts(), grids[1].starts()));
    QVERIFY(!grids[0].sorted() && !grids[1].sorted());
    const std::span<const uint32_t> starts = grids[1].starts(), order = grids[1].order();
    for (size_t c = 0; c + 1 < starts.size(); ++c) {
      QVERIFY(std::is_sorted(order.begin() + starts[c], order.begin() + starts[c + 1]));
      for (uint32_t slot = starts[c]; slot < starts[c + 1]; ++slot) QCOMPARE(grids[1].cellOfEach()[order[slot]], c);
    }
    for (ps::CellGrid& grid : grids) {
      std::vector<ps::api::Double3> sorted;
      for (const uint32_t i : grid.order()) sorted.push_back(places[i]);
      grid.reorder();
      QVERIFY(grid.sorted() && grid.order().size() == places.size() && grid.order()[77777] == 77777);
      ps::CellGrid again;
      again.sort(sorted.size(), 0.05, {}, [&](size_t i) { return sorted[i]; });
      QVERIFY(again.sorted() && same(again.cellOfEach(), grid.cellOfEach()));
    }
    ps::setThreadCount(threads);
  }

  void idsFindTheirParticle() {
    ParticleStore store;
    store.declare("depth", ps::api::FieldType::Float64, "m", "a plugin's own field");
    store.add(100);
    auto depth = [&] { return static_cast<double*>(store.find("depth", ps::api::FieldType::Float64)); };
    for (size_t i = 0; i < 100; ++i) depth()[i] = 2.5 * store.id()[i];
    std::vector<uint32_t> order(100);
    for (uint32_t i = 0; i < 100; ++i) order[i] = (i * 37 + 11) % 100;
    const std::vector<uint32_t> oldIds(store.id(), store.id() + 100);
    store.permute(order);
    for (uint32_t i = 0; i < 100; ++i) QCOMPARE(store.id()[i], oldIds[order[i]]);
    const std::vector<uint32_t> gone{3, 4, 99};
    const uint32_t lost = store.id()[4];
    store.remove(gone);
    store.add(5);
    QCOMPARE(store.size(), size_t{102});
    QCOMPARE(store.indexOf(lost), store.size());
    QCOMPARE(store.id()[101], 104u);  // ids are never used again
    for (size_t i = 0; i < store.size(); ++i) {
      QCOMPARE(store.indexOf(store.id()[i]), i);
      QCOMPARE(depth()[i], i < 97 ? 2.5 * store.id()[i] : 0.0);
    }
    QCOMPARE(store.position()[store.size()].w, 0.0f);  // the dummy weighs nothing and is far away
    QVERIFY(store.position()[store.size()].x > 1e6f);
  }

  void arraysAreAligned() {
    ParticleStore store;
    store.add(1000);
    for (const ParticleStore::FieldInfo& f : store.fields()) {
      QCOMPARE(reinterpret_cast<uintptr_t>(store.find(f.name.c_str(), f.type)) % 64, uintptr_t{0});
    }
  }

  void aFieldHasOneType() {
    ParticleStore store;
    store.declare("rust", ps::api::FieldType::Float32);
    store.declare("rust", ps::api::FieldType::Float32);
    QVERIFY_THROWS_EXCEPTION(ps::Error, store.declare("rust", ps::api::FieldType::Float64));
    QCOMPARE(store.find("rust", ps::api::FieldType::UInt8), static_cast<void*>(nullptr));
  }
};

QTEST_APPLESS_MAIN(TestParticles)
#include "tst_particles.moc"
