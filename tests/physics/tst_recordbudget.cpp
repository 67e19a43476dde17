// SPDX-License-Identifier: Apache-2.0
// What the record of a run may take, in memory and on the disk, and what it gives up for that.
#include "core/base/storedfile.h"
#include "core/simulation/keptrun.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/runrecord.h"
#include "tests/shared/plainframe.h"

#include <QDir>
#include <QTemporaryDir>
#include <QTest>

#include <time.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace ps;

class TestRecordBudget : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void staysWithinItsBudget();
  void whatIsOldGoesToTheDisk();
  void anEarlierRunMakesRoom();
  void whatFreesNothingStays();
  void theDiskIsEmptied();
  void whoAsksForAnEmptyDiskWaitsForNoFrame();
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

/// While somebody else holds all that is kept, and what came from elsewhere: giving it up would free nothing.
void TestRecordBudget::whatFreesNothingStays() {
  constexpr size_t kPlenty = size_t{1} << 30, kLittle = 700000, kMore = 1500000;
  RunRecord record(kPlenty);
  record.begin(1);
  const auto add = [](RunRecord& to, uint64_t first, uint64_t last) {
    for (uint64_t n = first; n <= last; ++n) {
      to.add(tests::plainFrame(n, 500));
      to.settle();
    }
  };
  add(record, 0, 200);
  record.cutAfter(150, 1);
  RunRecord other(kMore);
  {
    const RunContent content = record.content();
    other.adopt(content, 1);
    record.setBudget(RecordBudget{kLittle});
    add(record, 151, 155);
    QCOMPARE(record.extent().frames, size_t{156});
    QCOMPARE(record.earlier().size(), size_t{1});
  }
  add(record, 156, 160);
  QVERIFY(record.earlier().empty());
  QVERIFY(record.cost().bytes <= kLittle);

  add(other, 151, 900);
  QVERIFY(other.cost().bytes <= kMore);
  QCOMPARE(other.earlier().size(), size_t{1});
  for (uint64_t n = 1; n <= 150; ++n) QCOMPARE(other.neighbour(n - 1, 1), std::optional(n));
  QVERIFY(other.extent().frames < 700);
}

/// What is in memory stays, of earlier runs too, and so do the ends.
void TestRecordBudget::theDiskIsEmptied() {
  const QTemporaryDir folder;
  RunRecord record(RecordBudget{400000, size_t{1} << 30, folder.path().toStdString()});
  record.begin(1);
  const auto run = [&](uint64_t first, uint64_t last) {
    for (uint64_t n = first; n <= last; ++n) {
      record.add(tests::plainFrame(n, 200));
      record.settle();
    }
  };
  run(0, 200);
  record.cutAfter(190, 1);
  run(191, 300);
  const size_t before = record.cost().disk;
  QVERIFY(before > 0 && record.extent().frames == 301);
  record.forgetDisk();
  record.settle();
  constexpr size_t kEnds = 6 * 4096;
  QVERIFY2(record.cost().disk <= kEnds, qPrintable(QString::number(record.cost().disk)));
  QCOMPARE(record.earlier().size(), size_t{1});
  QVERIFY(record.earlierFrame(1, 200.0 / 60));
  QCOMPARE(record.extent().first, uint64_t{0});
  QCOMPARE(record.extent().last, uint64_t{300});
  QVERIFY(record.extent().frames > 10 && record.extent().frames < 200);
}

/// An hour of frames that lie on the disk: one that is packed, under all their numbers.
void TestRecordBudget::whoAsksForAnEmptyDiskWaitsForNoFrame() {
  constexpr uint64_t kFrames = 60 * 60 * 60;
  const QTemporaryDir folder;
  const auto count = std::make_shared<KeptBytes>();
  const auto packed = std::make_shared<const PackedFrame>(FramePacker(count).pack(*tests::plainFrame(0, 20)).frame);
  packed->part->data->moveTo(StoredFile::nameless(folder.path().toStdString()));
  RunContent content;
  for (uint64_t n = 0; n < kFrames; ++n) content.present.frames.emplace_hint(content.present.frames.end(), n, packed);
  content.present.frameBytes = kFrames * packed->bytes();
  RunRecord record(size_t{1} << 40);
  record.adopt(std::move(content), 1);
  record.settle();
  QCOMPARE(record.extent().frames, size_t{kFrames});
  const auto spent = [] {  // s, by this thread
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  const double start = spent();
  record.forgetDisk();
  const double asked = spent() - start;
  QVERIFY2(asked < 1e-3, qPrintable(QString::number(asked)));  // to walk over them takes tens of ms
  record.settle();
  QCOMPARE(record.extent().frames, size_t{2});
  QCOMPARE(record.extent().last, kFrames - 1);
}

QTEST_GUILESS_MAIN(TestRecordBudget)
#include "tst_recordbudget.moc"
