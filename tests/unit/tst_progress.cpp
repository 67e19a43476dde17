// SPDX-License-Identifier: Apache-2.0
// Scenes in the making: how far they are, that they ask often whether to go on, and what becomes of one that is given
// up. Counted is work between two questions, not time.
#include "core/base/progress.h"
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/projectstate.h"
#include "core/solver/solver.h"
#include "core/solver/structure/keyset.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <map>
#include <random>
#include <set>
#include <string>

using namespace ps;

namespace {

constexpr int kSide = 20;
constexpr double kParticles = kSide * kSide * kSide;

/// Counts what is told, and cancels at the `last`-th question.
class Counter : public Progress {
 public:
  explicit Counter(uint64_t last = ~uint64_t{0}) : m_last(last) {}
  std::atomic<uint64_t> asked{0}, most{0};
  std::map<std::string, uint64_t> steps;
  double done = 0;
  bool backwards = false;

 protected:
  void advanced(size_t count) override {
    const std::lock_guard lock(m_mutex);  // neighbours are found by several threads
    most = std::max<uint64_t>(most, count);
    const State now = state();
    steps[now.stage ? now.stage : ""] += count;
    backwards = backwards || now.done < done - 1e-9;
    done = now.done;
    if (++asked == m_last) cancel();
  }

 private:
  uint64_t m_last;
  std::mutex m_mutex;
};

Project held(const char* constraint) {
  Project project = scenes::iceOnPlate(kSide, 300);
  project.bodies[0].parameters.values["jitter"] = 0.01;
  project.bodies[0].constraints.clear();
  if (*constraint) project.bodies[0].constraints = {{constraint, {}, {}}};
  return project;
}

/// What is told while a scene is made.
template <class Use>
void whileMaking(Counter& counter, PluginRegistry& plugins, const Project& project, Use&& use) {
  const ProgressScope scope(&counter);
  const Engine engine(project, plugins);
  use(engine);
}

}  // namespace

class TestProgress : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }

  void everyStageTellsHowFarItIs_data() { kinds(); }
  void everyStageTellsHowFarItIs() {
    QFETCH(QByteArray, constraint);
    Counter counter;
    whileMaking(counter, *m_plugins, held(constraint), [](const Engine& engine) {
      QCOMPARE(engine.solver().particles().size(), static_cast<size_t>(kParticles));
    });
    QVERIFY(counter.most <= kProgressSlice);
    QVERIFY(!counter.backwards);
    QVERIFY2(counter.done > 0.7, qPrintable(QString::number(counter.done)));
    QVERIFY(static_cast<double>(counter.steps["Placing particles"]) >= 3 * kParticles);
    QVERIFY(static_cast<double>(counter.steps["Making matter"]) >= 4 * kParticles);
    if (constraint.isEmpty()) return;
    QVERIFY(static_cast<double>(counter.steps["Finding neighbours"]) >= 2 * kParticles);
    QVERIFY(static_cast<double>(counter.steps["Tying structure"]) >= 3 * kParticles);
  }

  /// A plugin that searches for long before it adds anything asks meanwhile. What it adds comes in slices as well, and
  /// what the host does with it afterwards are at least two steps for each place in a group.
  void aSearchForGroupsAsksToo_data() {
    QTest::addColumn<QByteArray>("constraint");
    QTest::addColumn<double>("places");
    QTest::newRow("rigid") << QByteArray("rigid") << kParticles;
    QTest::newRow("clusters") << QByteArray("clusters") << 8 * kParticles;
  }
  void aSearchForGroupsAsksToo() {
    QFETCH(QByteArray, constraint);
    QFETCH(double, places);
    Counter counter;
    size_t added = 0;
    whileMaking(counter, *m_plugins, held(constraint), [&](const Engine& engine) {
      QCOMPARE(engine.solver().particles().size(), static_cast<size_t>(kParticles));
      added = counter.steps["Tying structure"];
    });
    QVERIFY2(static_cast<double>(added) >= 3 * places + 0.5 * kParticles, qPrintable(QString::number(added)));
  }

  void whoIsCancelledLeavesNothing_data() { kinds(); }
  void whoIsCancelledLeavesNothing() {
    QFETCH(QByteArray, constraint);
    const Project project = held(constraint);
    Counter whole;
    whileMaking(whole, *m_plugins, project, [](const Engine&) {});
    constexpr uint64_t kTries = 8;
    for (uint64_t k = 1; k <= kTries; ++k) {
      Counter counter(std::max<uint64_t>(1, whole.asked * k / kTries));
      try {
        whileMaking(counter, *m_plugins, project, [](const Engine&) { QFAIL("it was made"); });
        QFAIL("it was made");
      } catch (const Cancelled&) {
      }
    }
    if (!constraint.isEmpty()) QVERIFY(m_plugins->constraint(constraint.toStdString()));  // nobody blamed it
    QVERIFY(m_plugins->thermal(scenes::kThermalModel));
  }

  void aStateIsGivenUpToo() {
    Project project = held("bonds");
    StateBuffer stream;
    {
      Engine engine(project, *m_plugins);
      engine.step();
      saveTo(stream, engine);
    }
    project.state = projectState(stream.bytes(), project.bodies);
    Counter whole;
    whileMaking(whole, *m_plugins, project, [](const Engine& engine) { QVERIFY(engine.remarks().empty()); });
    QVERIFY(whole.steps["Reading the state"] > 0);
    Counter half(whole.asked / 2);
    QVERIFY_EXCEPTION_THROWN(whileMaking(half, *m_plugins, project, [](const Engine&) {}), Cancelled);
  }

  void whatIsCancelledIsNoScene() {
    EngineThread* engine = nullptr;
    std::atomic<bool> cancels{true};
    const auto thread = std::make_unique<EngineThread>(*m_plugins, [&] {
      if (cancels && engine->making()) engine->cancelMaking();
    });
    engine = thread.get();
    thread->open(held("bonds"), true);
    QTRY_VERIFY(!thread->events(0).empty());
    QVERIFY(thread->events(0).back().kind == EngineEvent::Kind::Cancelled);
    QVERIFY(thread->snapshot() && !thread->snapshot()->bodyIds);
    QVERIFY(!thread->making() && !thread->playing());
    cancels = false;
    thread->open(held("bonds"), false);
    const auto shown = [&] {
      const SnapshotPtr now = thread->snapshot();  // none for a moment, when the scene is there and not yet shown
      return now && now->bodyIds;
    };
    QTRY_VERIFY(shown());
    QCOMPARE(thread->snapshot()->id.size(), static_cast<size_t>(kParticles));
  }

  void aResetThatIsCancelledKeepsTheScene() {
    EngineThread* engine = nullptr;
    std::atomic<bool> cancels{false};
    const auto thread = std::make_unique<EngineThread>(*m_plugins, [&] {
      if (cancels && engine->making()) engine->cancelMaking();
    });
    engine = thread.get();
    thread->open(scenes::iceOnPlate(4, 300), false);
    QTRY_VERIFY(thread->snapshot());
    thread->stepOnce();
    QTRY_COMPARE(thread->snapshot()->stats.frame, uint64_t{1});
    cancels = true;
    thread->reset();
    QTRY_VERIFY(!thread->events(0).empty());
    QVERIFY(thread->events(0).back().kind == EngineEvent::Kind::Cancelled);
    QCOMPARE(thread->snapshot()->stats.frame, uint64_t{1});
    cancels = false;
    thread->stepOnce();
    QTRY_COMPARE(thread->snapshot()->stats.frame, uint64_t{2});
    thread->reset();
    QTRY_COMPARE(thread->snapshot()->stats.frame, uint64_t{0});
  }

  /// Whoever opens another project meanwhile gets that one, and hears nothing of the first.
  void anotherProjectTakesThePlaceOfOneInTheMaking() {
    EngineThread* engine = nullptr;
    std::atomic<bool> another{true};
    const Project second = scenes::iceOnPlate(5, 300);
    const auto thread = std::make_unique<EngineThread>(*m_plugins, [&] {
      if (engine->making() && another.exchange(false)) engine->open(second, false);
    });
    engine = thread.get();
    thread->open(held("bonds"), true);
    QTRY_VERIFY(thread->snapshot() && thread->snapshot()->bodyIds);
    QCOMPARE(thread->snapshot()->id.size(), size_t{125});
    QVERIFY(thread->events(0).empty());
  }

  /// Against the library's set, over keys that collide, come and go.
  void keysAreFound() {
    std::mt19937_64 random(7);
    KeySet keys;
    std::set<std::pair<uint64_t, uint64_t>> known;
    for (int k = 0; k < 200'000; ++k) {
      const TieKey key{random() % 5000, random() % 4};
      if (random() % 3 == 0) {
        keys.erase(key);
        known.erase({key.a, key.b});
      } else {
        QCOMPARE(keys.insert(key), known.insert({key.a, key.b}).second);
      }
      QCOMPARE(keys.size(), known.size());
    }
    for (const auto& [a, b] : known) QVERIFY(!keys.insert({a, b}));
  }

 private:
  static void kinds() {
    QTest::addColumn<QByteArray>("constraint");
    for (const char* constraint : {"", "bonds", "rigid", "clusters", "cloth"})
      QTest::newRow(*constraint ? constraint : "none") << QByteArray(constraint);
  }
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_APPLESS_MAIN(TestProgress)
#include "tst_progress.moc"
