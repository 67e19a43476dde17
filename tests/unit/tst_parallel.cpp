// SPDX-License-Identifier: Apache-2.0
// Loops that threads share: each chunk once and no other, whoever shares at the same time, also after a throw and after
// the threads have gone to sleep. What they gain is measured by tests/bench and `phasesketch-cli bench`.
#include "core/base/parallelarrays.h"
#include "core/base/room.h"
#include "core/base/workers.h"

#include <QTest>

#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

using namespace ps;

namespace {

/// How often each element of a loop was covered; neighbours are there to show what reaches too far.
class Cover {
 public:
  explicit Cover(size_t count) : m_times(count + 1) {}
  void add(size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) ++m_times[i];
  }
  bool once() const {
    for (size_t i = 0; i + 1 < m_times.size(); ++i) {
      if (m_times[i] != 1) return false;
    }
    return m_times.back() == 0;
  }

 private:
  std::vector<std::atomic<int>> m_times;
};

constexpr double kLong = 1e6;  // microseconds: worth every thread
}  // namespace

class TestParallel : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { setThreadCount(4); }
  void cleanup() { setThreadCount(0); }

  void wholeArrays_data() {
    QTest::addColumn<int>("count");
    for (const int count : {0, 1, int(grain::kNumbers), 3 * int(grain::kNumbers) + 5})
      QTest::newRow(qPrintable(QString::number(count))) << count;
  }
  /// As the standard library does it, also into memory that held something longer, and with no more room than asked.
  void wholeArrays() {
    QFETCH(int, count);
    std::vector<uint32_t> numbers(static_cast<size_t>(count));
    std::iota(numbers.begin(), numbers.end(), 1u);
    std::vector<uint32_t> sums(numbers), found(7, 3);
    assignAll<uint32_t>(found, numbers);
    QVERIFY(found == numbers);
    const std::vector<uint32_t> some{8, 9};
    assignBoth<uint32_t>(found, some, numbers);
    std::vector<uint32_t> both(some);
    both.insert(both.end(), numbers.begin(), numbers.end());
    QVERIFY(found == both);
    std::partial_sum(sums.begin(), sums.end(), sums.begin());
    assignAll<uint32_t>(found, numbers);
    sumUp(found);
    QVERIFY(found == sums);
    assignAll(found, numbers.size(), 5u);
    QVERIFY(found == std::vector<uint32_t>(numbers.size(), 5));
    std::vector<float> fresh;
    for (const size_t size : {numbers.size(), numbers.size() + 1}) assignAll(fresh, size, 1.0f);
    QCOMPARE(fresh.capacity(), numbers.size() + 1);
  }

  /// Zeros, and a thirty-second part more; it never gets smaller.
  void roomIsZeroed() {
    RoomVector<uint32_t> room;
    makeRoomFor(room, 200000);
    QCOMPARE(room.size(), size_t{200000 + 200000 / 32});
    QVERIFY(std::all_of(room.begin(), room.end(), [](uint32_t number) { return number == 0; }));
    const uint32_t* const before = room.data();
    makeRoomFor(room, 1000);
    QVERIFY(room.data() == before);
  }

  void everyChunkRunsOnce_data() {
    QTest::addColumn<int>("threads");
    QTest::addColumn<int>("count");
    for (const int threads : {1, 2, 7}) {
      for (const int count : {0, 1, 9, 10, 11, 1003}) {
        QTest::addRow("%d threads, %d elements", threads, count) << threads << count;
      }
    }
  }
  void everyChunkRunsOnce() {
    QFETCH(int, threads);
    QFETCH(int, count);
    setThreadCount(threads);
    const auto n = static_cast<size_t>(count);
    for (int round = 0; round < 200; ++round) {
      Cover cover(n);
      parallelFor(
          n, 10, [&](size_t first, size_t last) { cover.add(first, last); }, kLong);
      QVERIFY(cover.once());
    }
  }

  void severalThreadsMayShareAtOnce() {
    std::atomic<int> wrong = 0;
    {
      std::vector<std::jthread> callers;
      for (int k = 0; k < 6; ++k) {  // more than loops that can be shared at once
        callers.emplace_back([&wrong, k] {
          for (int round = 0; round < 300; ++round) {
            const size_t count = 100 + static_cast<size_t>(k);
            Cover cover(count);
            parallelFor(
                count, 7, [&](size_t first, size_t last) { cover.add(first, last); }, kLong);
            if (!cover.once()) ++wrong;
          }
        });
      }
    }
    QCOMPARE(wrong.load(), 0);
  }

  void aChunkMayShareALoop() {
    for (int round = 0; round < 100; ++round) {
      Cover cover(20 * 50);
      const auto outer = [&](size_t begin, size_t) {
        parallelFor(
            50, 5, [&](size_t first, size_t last) { cover.add(begin * 50 + first, begin * 50 + last); }, kLong);
      };
      parallelFor(20, 1, outer, kLong);
      QVERIFY(cover.once());
    }
  }

  void whatABodyThrowsReachesTheCaller() {
    for (int round = 0; round < 200; ++round) {
      const auto body = [&](size_t first, size_t) {
        if (first == 50) throw std::runtime_error("chunk 50");
      };
      QVERIFY_THROWS_EXCEPTION(std::runtime_error, parallelFor(100, 1, body, kLong));
      Cover cover(100);  // and the next loop is whole
      parallelFor(
          100, 1, [&](size_t first, size_t last) { cover.add(first, last); }, kLong);
      QVERIFY(cover.once());
    }
  }

  /// Loops with more and with fewer helpers, of more chunks and of fewer than these, one right after the other: who
  /// comes late to one takes nothing of the next.
  void loopsMayFollowEachOther() {
    constexpr int kHelpers = 6;
    Workers workers(kHelpers);
    for (int round = 0; round < 3000; ++round) {
      const auto chunks = static_cast<size_t>(2 + 7 * round % 41);
      Cover cover(chunks);
      workers.share(1 + round % kHelpers, chunks, [&](size_t chunk) { cover.add(chunk, chunk + 1); });
      QVERIFY(cover.once());
    }
  }

  /// A chunk that waits for the others ends only when helpers come: of those that slept, all that were asked.
  void sleepersAreWoken() {
    constexpr int kHelpers = 5;
    Workers workers(kHelpers);
    for (int round = 0; round < 20; ++round) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const int threads = 2 + round % kHelpers;
      std::atomic<int> here = 0;
      const auto body = [&](size_t) {
        ++here;
        while (here < threads) std::this_thread::yield();
      };
      workers.share(threads - 1, static_cast<size_t>(threads), body);
      QCOMPARE(here.load(), threads);
    }
  }

  /// A loop that was seen to be long gets help, however short it was taken for; one that was held up once does not.
  void whatALoopTakesIsLearned() {
    LoopCost cost(0.001);
    const auto caller = std::this_thread::get_id();
    std::atomic<bool> helped = false;
    bool waits = false;
    const auto body = [&](size_t, size_t) {
      if (std::this_thread::get_id() != caller) helped = true;
      const auto start = std::chrono::steady_clock::now();
      do {
        std::this_thread::sleep_for(std::chrono::microseconds(200));
      } while (waits && !helped && std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
    };
#if !defined(__SANITIZE_THREAD__)
    parallelFor(8, 1, body, cost);
    QVERIFY(!helped);
    for (int run = 0; cost.microseconds(1, 1) < 100 && run < 100; ++run) parallelFor(8, 1, body, cost);
    QVERIFY(cost.microseconds(1, 1) >= 100);
#endif
    waits = true;
    parallelFor(8, 1, body, cost);
    QVERIFY(helped);
    LoopCost once(1.0);
    once.learn(1e6, 1);
    QVERIFY(once.microseconds(1, 1) < 2);
    LoopCost fresh;
    QCOMPARE(fresh.microseconds(1000, grain::kNumbers), 1000 * grain::microseconds(grain::kNumbers));
    fresh.learn(50, 100);
    QCOMPARE(fresh.microseconds(1000, grain::kNumbers), 500.0);
  }

  void aSumIsTheSameForAnyNumberOfThreads() {
    const auto part = [](size_t first, size_t last) {
      double sum = 0;
      for (size_t i = first; i < last; ++i) sum += 1.0 / static_cast<double>(i + 1);
      return sum;
    };
    setThreadCount(1);
    const double alone = parallelSum(100003, 512, part);
    for (const int threads : {2, 5}) {
      setThreadCount(threads);
      for (int round = 0; round < 20; ++round) QCOMPARE(parallelSum(100003, 512, part), alone);
    }
  }
};

QTEST_APPLESS_MAIN(TestParallel)
#include "tst_parallel.moc"
