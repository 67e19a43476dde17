// SPDX-License-Identifier: Apache-2.0
// How a sketched body stands by now, found from places of its matter against where that was made.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/simulation/bodypieces.h"
#include "core/simulation/restplaces.h"
#include "core/simulation/standing.h"

#include <QTest>

#include <cmath>
#include <functional>
#include <random>

using namespace ps;

namespace {

constexpr double kSpacing = 0.02;

/// In [-1, 1), the same on every machine.
double next(std::mt19937& numbers) { return static_cast<double>(numbers()) / 2147483648.0 - 1; }

RigidMove knownMove() {
  return {Quaternion(Eigen::AngleAxisd(2.2, Vector3(1, -2, 0.5).normalized())), {0.3, -0.7, 1.1}};
}

double between(const RigidMove& a, const RigidMove& b, const Vector3& place) {
  return (a.of(place) - b.of(place)).norm();
}

/// A body of cells that has gone where a function says, with the same of its matter solid.
struct Scene {
  Scene(int x, int y, int z, const std::function<Vector3(const Vector3&)>& now) {
    auto known = std::make_shared<RestPlaces>();
    std::vector<uint32_t> ids;
    std::vector<RestPlaces::Place> places;
    for (int k = 0; k < x * y * z; ++k) {
      const Vector3 rest = kSpacing * Vector3(k % x, k / x % y, k / x / y);
      ids.push_back(static_cast<uint32_t>(k) + 7);
      places.push_back({static_cast<float>(rest.x()), static_cast<float>(rest.y()), static_cast<float>(rest.z())});
      snapshot.position.push_back(float4Of(now(rest), static_cast<float>(kSpacing / 2)));
      snapshot.motion.push_back(api::Motion::Solid);
      snapshot.body.push_back(1);
      snapshot.id.push_back(ids.back());
    }
    known->add(ids, places);
    snapshot.rest = known;
    snapshot.spacing = kSpacing;
  }
  Snapshot snapshot;
};

}  // namespace

class TestStanding : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aKnownTurnIsFound_data() {
    QTest::addColumn<Vector3>("size");
    QTest::newRow("a cloud") << Vector3(1, 1, 1);
    QTest::newRow("a sheet") << Vector3(1, 0, 1);
  }
  /// To rounding; with noise, to as much as the mean of so many leaves of it.
  void aKnownTurnIsFound() {
    QFETCH(Vector3, size);
    std::mt19937 numbers(11);
    std::vector<RestPair> pairs, noisy;
    const RigidMove known = knownMove();
    for (int k = 0; k < 400; ++k) {
      const Vector3 rest = Vector3(next(numbers), next(numbers), next(numbers)).cwiseProduct(size);
      pairs.push_back({rest, known.of(rest)});
      noisy.push_back(pairs.back());
      noisy.back().place += 0.01 * Vector3(next(numbers), next(numbers), next(numbers));
    }
    const RigidMove found = bestMove(pairs, Quaternion::Identity()), near = bestMove(noisy, Quaternion::Identity());
    for (const Vector3& corner : {Vector3(1, 1, 1), Vector3(-1, 1, -1), Vector3(0, 0, 0)}) {
      QVERIFY2(between(found, known, corner) < 1e-7, qPrintable(QString::number(between(found, known, corner))));
      // 0.01/sqrt(3) each way, over sqrt(400), times the arms: 4 of those.
      QVERIFY2(between(near, known, corner) < 0.0024, qPrintable(QString::number(between(near, known, corner))));
    }
  }

  /// About a line, and of one place, nobody knows the turn: it stays.
  void whatIsNotKnownOfTheTurnStays() {
    const Quaternion before(Eigen::AngleAxisd(0.4, Vector3(0, 0, 1)));
    const RigidMove one = bestMove(std::vector<RestPair>{{{1, 2, 3}, {2, 2, 2}}}, before);
    QVERIFY(one.turn.angularDistance(before) < 1e-9);
    QVERIFY((one.of({1, 2, 3}) - Vector3(2, 2, 2)).norm() < 1e-12);
    const Quaternion about(Eigen::AngleAxisd(0.7, Vector3(0, 1, 0)));
    std::vector<RestPair> line;
    for (int k = -3; k <= 3; ++k) line.push_back({{0.0, 0.1 * k, 0.0}, {0.0, 0.1 * k, 0.0}});
    const RigidMove found = bestMove(line, about);  // along the line nothing is turned, whatever is about it
    QVERIFY2(found.turn.angularDistance(about) < 1e-5, qPrintable(QString::number(found.turn.angularDistance(about))));
  }

  void aBodyIsFoundWhereItWent() {
    const RigidMove known = knownMove();
    const Scene scene(12, 8, 6, [&](const Vector3& rest) { return known.of(rest); });
    const Vector3 hand = known.of(kSpacing * Vector3(11, 7, 5));
    const auto found = standingNear(scene.snapshot, 1, {}, hand, 3 * kSpacing);
    QVERIFY(found);
    for (const Vector3& corner : {Vector3(0, 0, 0), Vector3(0.22, 0, 0.1), Vector3(-0.2, 0.5, 0.3)})
      QVERIFY2(between(*found, known, corner) < 1e-5, qPrintable(QString::number(between(*found, known, corner))));
    QVERIFY(!standingNear(scene.snapshot, 0, {}, hand, 3 * kSpacing));  // there is no such body
  }

  /// The lower half flows, a fifth of the rest has set again where it had run to: the frame is that of what is left.
  void aBodyIsFoundThoughHalfOfItHasMelted() {
    const RigidMove known = knownMove();
    std::mt19937 numbers(5);
    Scene scene(12, 8, 6, [&](const Vector3& rest) { return known.of(rest); });
    Snapshot& now = scene.snapshot;
    for (size_t k = 0; k < now.position.size(); ++k) {
      const bool low = k / 12 % 8 < 4, sets = numbers() % 5 == 0;
      if (!low && !sets) continue;
      const Vector3 run = 3 * kSpacing * Vector3(next(numbers), next(numbers), next(numbers));
      now.position[k] = float4Of(vectorOf(now.position[k]) + run, now.position[k].w);
      if (low && !sets) now.motion[k] = api::Motion::Liquid;
    }
    for (const Vector3& hand : {Vector3(0, 7, 0), Vector3(11, 7, 5), Vector3(6, 4, 3)}) {
      const auto found = standingNear(now, 1, {}, known.of(kSpacing * hand), 4 * kSpacing);
      QVERIFY(found);
      QVERIFY2(between(*found, known, kSpacing * hand) < 0.1 * kSpacing,
               qPrintable(QString::number(between(*found, known, kSpacing * hand) / kSpacing)));
    }
  }

  /// A bar that is bent to a half circle: each end has a frame of its own, which fits what is there.
  void aBentBodyStandsAsItDoesThere() {
    const double radius = 60 * kSpacing / std::numbers::pi;
    const auto bent = [&](const Vector3& rest) {
      const double angle = rest.x() / radius;
      return Vector3((radius + rest.y()) * std::sin(angle), (radius + rest.y()) * std::cos(angle), rest.z());
    };
    const Scene scene(60, 4, 4, bent);
    for (const int end : {1, 30, 58}) {
      const Vector3 rest = kSpacing * Vector3(end, 2, 2);
      const auto found = standingNear(scene.snapshot, 1, {}, bent(rest), 3 * kSpacing);
      QVERIFY(found);
      for (const Vector3& beside : {rest, Vector3(rest + kSpacing * Vector3(1, 1, 0))})
        QVERIFY2((found->of(beside) - bent(beside)).norm() < 0.5 * kSpacing,
                 qPrintable(QString::number((found->of(beside) - bent(beside)).norm() / kSpacing)));
    }
  }

  void whatIsAllInPiecesStandsNowhere() {
    std::mt19937 numbers(3);
    const Scene scene(
        8, 8, 8, [&](const Vector3&) -> Vector3 { return 0.2 * Vector3(next(numbers), next(numbers), next(numbers)); });
    QVERIFY(!standingNear(scene.snapshot, 1, {}, {0, 0, 0}, 4 * kSpacing));
    Snapshot unknown = scene.snapshot;
    unknown.rest = nullptr;
    QVERIFY(!standingNear(unknown, 1, {}, {0, 0, 0}, 4 * kSpacing));
  }

  /// Copies stay as they were; a state brings all of it back, and says what is wrong with one that is damaged.
  void placesOfRestAreKept() {
    RestPlaces rest;
    QVERIFY(rest.empty() && !rest.of(0));
    rest.add(std::vector<uint32_t>{4, 5, 9}, std::vector<RestPlaces::Place>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
    const RestPlaces before = rest;
    rest.add(std::vector<uint32_t>{6, 7}, std::vector<RestPlaces::Place>{{-1, 0, 1}, {0, 0, 2}});
    QVERIFY(rest.of(4) == Vector3(1, 2, 3) && rest.of(5) == Vector3(4, 5, 6) && rest.of(6) == Vector3(-1, 0, 1) &&
            rest.of(7) == Vector3(0, 0, 2) && rest.of(9) == Vector3(7, 8, 9));
    QVERIFY(!rest.of(3) && !rest.of(8) && !rest.of(10) && !before.of(6) && before.of(5));
    RestPlaces shifted = rest;
    shifted.shift(std::vector<uint32_t>{3, 5, 6, 9}, {1, 0, -2});
    QVERIFY(shifted.of(4) == Vector3(1, 2, 3) && shifted.of(5) == Vector3(5, 5, 4) &&
            shifted.of(6) == Vector3(0, 0, -1) && shifted.of(9) == Vector3(8, 8, 7));
    QVERIFY(rest.of(5) == Vector3(4, 5, 6) && !shifted.of(3));
    StateBuffer buffer;
    saveTo(buffer, rest);
    const RestPlaces back = RestPlaces::read(StateReader(buffer.bytes()));
    for (uint32_t id = 0; id < 12; ++id) QVERIFY(back.of(id) == rest.of(id));
    StateBuffer none;
    saveTo(none, RestPlaces());
    QVERIFY(RestPlaces::read(StateReader(none.bytes())).empty());
    StateBuffer damaged;
    StateWriter writer(damaged);
    writer.array("scene/rest_runs", std::vector<uint32_t>{4, 3});
    writer.array("scene/rest_places", std::vector<float>{0, 0, 0});
    writer.finish();
    QVERIFY_THROWS_EXCEPTION(InputError, RestPlaces::read(StateReader(damaged.bytes())));
  }

  /// Of a body in two pieces one has come to three: two came off, and one of them is a crumb. What was apart before has
  /// not come off anything, nor has what nobody knew.
  void piecesThatComeOff() {
    const auto row = [](int from, int count) {
      CellIndices cells;
      for (int x = from; x < from + count; ++x) cells.push_back({x, 0, 0});
      return cells;
    };
    const std::vector<CellIndices> before = {row(0, 40), row(50, 20)};
    const std::vector<CellIndices> after = {row(50, 19), row(0, 18), row(20, 12), row(34, 3), row(90, 9)};
    QCOMPARE(cutOff(before, after, 8), (std::vector<CellIndices>{row(20, 12)}));
    QCOMPARE(cutOff(before, after, 3), (std::vector<CellIndices>{row(20, 12), row(34, 3)}));
    QVERIFY(cutOff(before, before, 8).empty());
    QVERIFY(cutOff({}, after, 8).empty());
  }
};

QTEST_GUILESS_MAIN(TestStanding)
#include "tst_standing.moc"
