// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/framehistory.h"

#include <QTest>

using namespace ps;

class TestFrameHistory : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void aRunOfAnyLengthFits();
  void editsReplaceTheLastFrame();
  void goingBackCutsIt();
};

namespace {

FrameStats frame(uint64_t number) {
  FrameStats stats;
  stats.frame = number;
  stats.time = static_cast<double>(number) / 60;
  return stats;
}

}  // namespace

/// Five hours at 60 frames a second, begun at the state of frame 1000.
void TestFrameHistory::aRunOfAnyLengthFits() {
  constexpr uint64_t kFirst = 1000, kLast = kFirst + 5 * 3600 * 60;
  FrameHistory history;
  for (uint64_t n = kFirst; n <= kLast; ++n) {
    history.add(frame(n));
    if (history.size() > FrameHistory::kMost) QFAIL("more than there is room for");
  }
  const std::vector<FrameStats> all = history.since(0);
  QCOMPARE(all.size(), history.size());
  QVERIFY(all.size() >= FrameHistory::kMost / 2);
  QCOMPARE(all.back().frame, kLast);
  // What is old is evenly spread, and the newest frames are all there.
  const size_t old = all.size() - FrameHistory::kNewest;
  uint64_t widest = 0;
  for (size_t k = 1; k < all.size(); ++k) {
    const uint64_t gap = all[k].frame - all[k - 1].frame;
    QVERIFY(gap > 0 && (k <= old || gap == 1));
    widest = std::max(widest, gap);
  }
  QVERIFY2(widest <= 64 && all.front().frame < kFirst + 64, qPrintable(QString::number(widest)));
  QCOMPARE(history.since(kLast - 10).size(), size_t{11});
  QVERIFY(history.since(kLast + 1).empty());
  const std::vector<FrameStats> piece = history.since(kLast - 10, 4);
  QVERIFY(piece.size() == 4 && piece.front().frame == kLast - 10);
  history.clear();
  QVERIFY(history.since(0).empty());
}

void TestFrameHistory::editsReplaceTheLastFrame() {
  FrameHistory history;
  history.add(frame(0));
  FrameStats edited = frame(0);
  edited.temperatureMean = 300;
  history.add(edited);
  history.add(frame(1));
  QCOMPARE(history.size(), size_t{2});
  QCOMPARE(history.since(0).front().temperatureMean, 300.0);
}

void TestFrameHistory::goingBackCutsIt() {
  FrameHistory history;
  for (uint64_t n = 0; n < 9; ++n) history.add(frame(n));
  history.cutAfter(4);
  QCOMPARE(history.size(), size_t{5});
  QCOMPARE(history.since(0).back().frame, uint64_t{4});
  history.add(frame(5));
  QCOMPARE(history.size(), size_t{6});
}

QTEST_APPLESS_MAIN(TestFrameHistory)
#include "tst_framehistory.moc"
