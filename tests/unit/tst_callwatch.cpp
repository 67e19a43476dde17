// SPDX-License-Identifier: Apache-2.0
// Who does not come back is told of once, who only works much is not.
#include "core/base/callee.h"
#include "core/base/callwatch.h"

#include <QTest>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

using namespace ps;
using namespace std::chrono_literals;

class TestCallWatch : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void callsAreSeenFromOtherThreads() {
    QVERIFY(ongoingCalls().empty());
    std::atomic<int> stage{0};
    std::thread other([&] {
      const CalleeScope outer("org.example.outer");
      {
        const std::string name(200, 'n');  // gone before it is looked at again
        const CalleeScope inner(name.c_str());
        stage = 1;
        while (stage == 1) std::this_thread::sleep_for(1ms);
      }
      stage = 3;
      while (stage == 3) std::this_thread::sleep_for(1ms);
    });
    while (stage != 1) std::this_thread::sleep_for(1ms);
    const auto inner = ongoingCalls();
    stage = 2;
    while (stage != 3) std::this_thread::sleep_for(1ms);
    const auto outer = ongoingCalls();
    stage = 4;
    other.join();
    QCOMPARE(inner.size(), size_t{1});
    QCOMPARE(inner[0].id, std::string(127, 'n'));
    QCOMPARE(outer.size(), size_t{1});
    QCOMPARE(outer[0].id, std::string("org.example.outer"));
    QCOMPARE(outer[0].thread, inner[0].thread);
    QVERIFY(outer[0].number != inner[0].number);
    QVERIFY(ongoingCalls().empty());
  }

  void whoDoesNotComeBackIsToldOfOnce() {
    std::mutex mutex;
    std::vector<std::string> told;
    const auto note = [&](const char* what) {
      return [&, what](const std::string& id) {
        const std::lock_guard lock(mutex);
        told.push_back(what + id);
      };
    };
    const CallWatch watch(1, note("late "), note("back "));
    const auto is = [&](const std::vector<std::string>& wanted) {
      const std::lock_guard lock(mutex);
      return told == wanted;
    };
    std::thread busy([] {
      for (int k = 0; k < 1000; ++k) {  // 2 s in all
        const CalleeScope scope("busy");
        std::this_thread::sleep_for(2ms);
      }
    });
    {
      const CalleeScope scope("slow");
      QTRY_VERIFY(is({"late slow"}));
    }
    busy.join();
    QTRY_VERIFY(is({"late slow", "back slow"}));
  }

  /// A batch runs on several threads: the plugin is back when the last of them is.
  void whoIsStuckOnTwoThreadsIsBackOnce() {
    std::atomic<int> late{0}, back{0};
    const CallWatch watch(
        0.2, [&](const std::string&) { ++late; }, [&](const std::string&) { ++back; });
    std::atomic<bool> go{false};
    std::thread other([&] {
      const CalleeScope scope("slow");
      while (!go) std::this_thread::sleep_for(1ms);
    });
    {
      const CalleeScope scope("slow");
      QTRY_COMPARE(late.load(), 2);
    }
    QTest::qWait(500);  // five looks
    const int before = back;
    go = true;
    other.join();
    QCOMPARE(before, 0);
    QTRY_COMPARE(back.load(), 1);
  }
};

QTEST_GUILESS_MAIN(TestCallWatch)
#include "tst_callwatch.moc"
