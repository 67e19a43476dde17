// SPDX-License-Identifier: Apache-2.0
#include "core/scene/track.h"

#include <QTest>

#include <cmath>
#include <limits>

using namespace ps;

class TestTrack : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void nothingHoldsBeforeTheFirstKeyAndTheLastOneForEver();
  void piecesGoAsTheirKeysSay();
  void smoothPiecesStayBetweenTheirKeys();
  void smoothPiecesJoinWithoutAKink();
  void aStepHasNoSlope();
  void statedSlopesAreTaken();
  void aKeyIsReachedWithinTheSlack();
  void keysOutOfOrderAreFound();
  void keysArePutInTheirPlaces();
  void namesAreThoseOfTheFile();
  void whatHasGoneIsNotSaved();
};

namespace {

using Keys = std::vector<TrackKey>;

double at(const Keys& keys, double time) { return trackValue(keys, time).value(); }
/// By central difference; the cubic's third derivative makes an error of the order of h².
double slopeAt(const Keys& keys, double time) {
  constexpr double kStep = 1e-5;
  return (at(keys, time + kStep) - at(keys, time - kStep)) / (2 * kStep);
}

}  // namespace

void TestTrack::nothingHoldsBeforeTheFirstKeyAndTheLastOneForEver() {
  const Keys keys{{1, 5, ToNext::Linear}, {2, 7, ToNext::Linear}};
  QVERIFY(!trackValue(keys, 0.999));
  QVERIFY(!trackValue({}, 3));
  QCOMPARE(at(keys, 1), 5.0);
  QCOMPARE(at(keys, 2), 7.0);
  QCOMPARE(at(keys, 1e9), 7.0);
}

void TestTrack::piecesGoAsTheirKeysSay() {
  const Keys keys{{0, 10, ToNext::Step}, {2, 20, ToNext::Linear}, {4, 40, ToNext::Smooth}, {6, 10}};
  QCOMPARE(at(keys, 1.999), 10.0);
  QCOMPARE(at(keys, 2), 20.0);
  QCOMPARE(at(keys, 3), 30.0);
  QCOMPARE(at(keys, 4), 40.0);
  // From a peak, where the slope is 0, with the secant of -15 per s and the end slope of the three-point formula,
  // (3 * -15 - 10) / 2 = -27.5: half of both, and an eighth of 2 s times the slopes' difference, 0 + 27.5.
  QVERIFY(std::abs(at(keys, 5) - (25 + 2 * 27.5 / 8)) < 1e-12);
}

/// The defining property of Fritsch & Carlson 1980.
void TestTrack::smoothPiecesStayBetweenTheirKeys() {
  const double values[] = {0, 0, 1, 8, 8.5, 8.5, -3, -2, 100, 99};
  Keys keys;
  double time = 0;
  for (const double value : values) keys.push_back({time += 0.3 + 0.2 * std::abs(value - 4), value, ToNext::Smooth});
  for (size_t k = 0; k + 1 < keys.size(); ++k) {
    const auto [low, high] = std::minmax(keys[k].value, keys[k + 1].value);
    double last = keys[k].value;
    for (int i = 0; i <= 100; ++i) {
      const double v = at(keys, keys[k].time + (keys[k + 1].time - keys[k].time) * i / 100);
      QVERIFY(v >= low - 1e-12 && v <= high + 1e-12);  // rounding
      QVERIFY(keys[k + 1].value >= keys[k].value ? v >= last - 1e-12 : v <= last + 1e-12);
      last = v;
    }
  }
}

void TestTrack::smoothPiecesJoinWithoutAKink() {
  const Keys keys{{0, 0, ToNext::Smooth}, {1, 1, ToNext::Smooth}, {3, 4, ToNext::Smooth}, {4, 9, ToNext::Smooth}};
  for (const size_t k : {size_t{1}, size_t{2}}) {
    QCOMPARE(slopeBefore(keys, k), slopeAfter(keys, k));
    QVERIFY(slopeAfter(keys, k) > 0);
    QVERIFY(std::abs(slopeAt(keys, keys[k].time) - slopeAfter(keys, k)) < 1e-3);
  }
}

void TestTrack::aStepHasNoSlope() {
  const Keys alone{{1, 0, ToNext::Smooth}, {2, 3, ToNext::Linear}};
  const Keys between{{0, 50, ToNext::Step}, {1, 0, ToNext::Smooth}, {2, 3, ToNext::Step}, {3, -90, ToNext::Step}};
  for (const double time : {1.1, 1.5, 1.9}) QCOMPARE(at(between, time), at(alone, time));
}

void TestTrack::statedSlopesAreTaken() {
  const Keys keys{{0, 0, ToNext::Smooth, {}, 4.0}, {2, 0, ToNext::Smooth, -4.0, {}}};
  QCOMPARE(at(keys, 1), 2.0);                                      // an eighth of 2 s times the slopes' difference
  QVERIFY(std::abs(slopeAt(keys, 0.01) - 4 * (1 - 0.01)) < 1e-6);  // it is the parabola 4 t (1 - t / 2)
  Keys straight = keys;
  straight[0].toNext = ToNext::Linear;
  QCOMPARE(at(straight, 1), 0.0);
  QCOMPARE(at({{0, 3, ToNext::Smooth, {}, 1e300}, {1e9, 4}}, 5e8), 3.0);
}

/// Ten frames of a tenth of a second are not quite one.
void TestTrack::aKeyIsReachedWithinTheSlack() {
  const Keys keys{{1, 5, ToNext::Linear}, {2, 7, ToNext::Step}, {3, 9}};
  double clock = 0;
  for (int frame = 0; frame < 10; ++frame) clock += 0.1;
  QVERIFY(clock < 1);
  QVERIFY(!trackValue(keys, clock));
  QCOMPARE(trackValue(keys, clock, 1e-6).value(), 5.0);
  QCOMPARE(trackValue(keys, 2 - 1e-9, 1e-6).value(), 7.0);
  QCOMPARE(trackValue(keys, 1 + 1e-9, 1e-6).value(), 5.0);  // not a bit more
  QVERIFY(!trackValue(keys, 1 - 1e-5, 1e-6));
}

void TestTrack::keysOutOfOrderAreFound() {
  const auto problem = [](const Keys& keys) {
    const auto found = problemOfKeys(keys);
    return found ? std::to_string(found->key) + " " + found->what : std::string();
  };
  QCOMPARE(problem({{0, 1}, {1, 2}}), std::string());
  QCOMPARE(problem({{0, 1}, {2, 2}, {1, 3}}),
           std::string("2 must come after the key before it, at 2 s: keys stand in order of time"));
  QCOMPARE(problem({{0, 1}, {0, 2}}), std::string("1 is of the same time as the key before it, 0 s"));
  QCOMPARE(problem({{0, 1}, {1, std::numeric_limits<double>::quiet_NaN()}}), std::string("1 is not a finite number"));
}

void TestTrack::keysArePutInTheirPlaces() {
  Keys keys;
  QCOMPARE(putKey(keys, {2, 20}, 0.01), size_t{0});
  QCOMPARE(putKey(keys, {1, 10}, 0.01), size_t{0});
  QCOMPARE(putKey(keys, {3, 30}, 0.01), size_t{2});
  QCOMPARE(putKey(keys, {2.005, 25}, 0.01), size_t{1});  // instead of the one at 2 s
  QCOMPARE(keys, (Keys{{1, 10}, {2.005, 25}, {3, 30}}));
  QCOMPARE(keyAt(keys, 2, 0.01), std::optional<size_t>(1));
  QVERIFY(!keyAt(keys, 2.5, 0.01));
}

void TestTrack::namesAreThoseOfTheFile() {
  QCOMPARE(toNextNames()[static_cast<size_t>(ToNext::Step)], std::string("step"));
  QCOMPARE(toNextNames()[static_cast<size_t>(ToNext::Linear)], std::string("linear"));
  QCOMPARE(toNextNames()[static_cast<size_t>(ToNext::Smooth)], std::string("smooth"));
}

void TestTrack::whatHasGoneIsNotSaved() {
  Project project;
  project.tracks = {{"wall/floor/friction", {{0, 1}}, {}}, {"scene/gravity", {{0, 1}}, {}}, {"nonsense", {{0, 1}}, {}}};
  QCOMPARE(ownedTracks(project).size(), size_t{1});
  project.environment.walls.push_back({"floor", "", {}, {0, 1, 0}, {}, true, false, {}});
  QCOMPARE(ownedTracks(project).size(), size_t{2});
}

QTEST_APPLESS_MAIN(TestTrack)
#include "tst_track.moc"
