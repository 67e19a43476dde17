// SPDX-License-Identifier: Apache-2.0
// What the record of a run may take, in memory and on the disk, and what it gives up for that.
#include "core/simulation/runrecord.h"
#include "tests/shared/plainframe.h"

#include <QDir>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <cmath>

using namespace ps;

class TestRecordBudget : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void staysWithinItsBudget();
  void whatIsOldGoesToTheDisk();
  void anEarlierRunMakesRoom();
};

/// What is old is evenly spread, and the newest frames are all there.
void TestRecordBudget::staysWithinItsBudget() {
  constexpr size_t kBudget = 300000;
  constexpr uint64_t kLast = 3000;
  RunRecord record(kBudget);
  record.begin(1);
  for (uint64_t n = 0; n <= kLast; ++n) {
    record.add(tests::plainFrame(n, 50));
    record.settle();
    QVERIFY2(record.cost().bytes <= kBudget, qPrintable(QString::number(record.cost().bytes)));
  }
  QCOMPARE(record.cost().leftOut, uint64_t{0});
  const RunRecord::Extent extent = record.extent();
  QVERIFY(extent.frames > 60);
  QCOMPARE(extent.last, kLast);
  QVERIFY(extent.first == 0);
  uint64_t gap = 0, newest = 0;
  size_t row = 0;
  for (uint64_t at = 0; at != kLast; ++row) {
    const auto next = record.neighbour(at, 1);
    QVERIFY(next);
    if (row < extent.frames / 2) gap = std::max(gap, *next - at);
    if (row > extent.frames - extent.frames / 4) newest = std::max(newest, *next - at);
    at = *next;
  }
  QCOMPARE(newest, uint64_t{1});
  // Half of the frames, evenly over nearly the whole run, are so far apart; powers of two may be twice, and what was
  // taken last is coarser by one more.
  QVERIFY2(gap <= 4 * kLast / (extent.frames / 2), qPrintable(QString::number(gap)));
}

/// Memory stays within its budget, the disk within its own, and each frame that is kept can be looked at.
void TestRecordBudget::whatIsOldGoesToTheDisk() {
  constexpr size_t kMemory = 400000, kDisk = 3000000;
  constexpr uint64_t kLast = 2000;
  const QTemporaryDir folder;
  RunRecord record(RecordBudget{kMemory, kDisk, folder.filePath("cache").toStdString()});
  record.begin(1);
  size_t most = 0;
  for (uint64_t n = 0; n <= kLast; ++n) {
    record.add(tests::plainFrame(n, 200));
    record.settle();
    QVERIFY2(record.cost().bytes <= kMemory, qPrintable(QString::number(record.cost().bytes)));
    QVERIFY2(record.cost().disk <= kDisk, qPrintable(QString::number(record.cost().disk)));
    most = std::max(most, record.cost().disk);
    if (n == 300) QCOMPARE(record.extent().frames, size_t{301});  // more than the memory holds
  }
  QVERIFY(most > kDisk / 2);
  QVERIFY(QDir(folder.filePath("cache")).isEmpty());  // the system takes it away, however this ends
  const RunRecord::Extent extent = record.extent();
  QVERIFY(extent.frames < kLast);
  for (uint64_t at = extent.first; at != extent.last; at = record.neighbour(at, 1).value()) {
    const SnapshotPtr was = tests::plainFrame(at, 200), is = record.frame(at);
    QCOMPARE(is->stats.frame, at);
    QVERIFY(std::abs(is->position.back().x - was->position.front().x) < 1e-3F);  // ids count down there
  }
  record.setBudget({kMemory, 0, {}});
  record.settle();
  constexpr size_t kEnds = 4 * 4096;  // the oldest frame and the newest stay where they are, with their keys
  QVERIFY2(record.cost().disk <= kEnds, qPrintable(QString::number(record.cost().disk)));
  // A folder in which nothing can be made: it stays in memory, and is thinned there.
  record.setBudget({kMemory / 2, kDisk, "/proc/nowhere"});
  record.settle();
  for (uint64_t n = kLast + 1; n <= kLast + 100; ++n) {
    record.add(tests::plainFrame(n, 200));
    record.settle();
    QVERIFY(record.cost().bytes <= kMemory / 2);
  }
  QVERIFY(record.cost().disk <= kEnds);
}

/// What both share is held once, and an earlier run goes before frames of the present one.
void TestRecordBudget::anEarlierRunMakesRoom() {
  RunRecord record(200000);
  record.begin(1);
  uint64_t frame = 0;
  const auto run = [&](uint64_t to) {
    for (; frame <= to; ++frame) {
      record.add(tests::plainFrame(frame, 50));
      record.settle();
    }
  };
  run(100);
  const size_t bytes = record.cost().bytes;
  record.cutAfter(frame = 50, 1);
  QVERIFY(record.cost().bytes < 2 * bytes);
  QCOMPARE(record.earlier().size(), size_t{1});
  for (++frame; !record.earlier().empty();) run(frame);
  QCOMPARE(record.extent().frames, size_t{frame});
}

QTEST_GUILESS_MAIN(TestRecordBudget)
#include "tst_recordbudget.moc"
