// SPDX-License-Identifier: Apache-2.0
// What bench measures and what it makes of the figures.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/experiments/benchscenes.h"
#include "core/experiments/benchtables.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"

#include <QTest>

#include <chrono>
#include <thread>

using namespace ps;
using nlohmann::json;

class TstBench : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void scenesHoldWhatTheirNamesSay_data();
  void scenesHoldWhatTheirNamesSay();
  void filesHoldWhatTheirNamesSay_data();
  void filesHoldWhatTheirNamesSay();
  void theDamBreakStandsWhereOthersHaveIt();
  void scenesAreScaled();
  void loopsOfOneChunkAreNotShared();
  void threadsFollowTheWork();
  void runsAreCompared();
  void growthIsTabledAndDrawn();

 private:
  PluginRegistry m_plugins;
};

namespace {

json row(const std::string& name, int particles, int threads, double milliseconds, double density) {
  const json cost{{"median", milliseconds}}, stage{{"median", density}}, nothing{{"median", 0.0}};
  return {{"name", name},
          {"particles", particles},
          {"threads", threads},
          {"ms", cost},
          {"stages", {{"density", stage}, {"heat", nothing}}},
          {"ns_per_particle_iteration", 50.5},
          {"serial_share", 0.25},
          {"memory_per_particle", 512}};
}

json file(const char* cpu, const json& scenes) { return {{"machine", {{"cpu", cpu}}}, {"scenes", scenes}}; }

}  // namespace

void TstBench::scenesHoldWhatTheirNamesSay_data() {
  QTest::addColumn<size_t>("particles");
  QTest::newRow("tank") << size_t{34 * 17 * 34};
  QTest::newRow("dambreak-20k") << size_t{25 * 32 * 25};
  QTest::newRow("dambreak-100k") << size_t{43 * 54 * 43};
  QTest::newRow("dambreak-1m") << size_t{93 * 116 * 93};
}

void TstBench::scenesHoldWhatTheirNamesSay() {
  QFETCH(size_t, particles);
  const std::string name = QTest::currentDataTag();
  const auto names = benchSceneNames();
  QVERIFY(std::find(names.begin(), names.end(), name) != names.end());
  const std::optional<Project> project = benchProject(name, std::nullopt);
  QVERIFY(project);
  QCOMPARE(static_cast<size_t>(particleCount(*project)), particles);
  const std::optional<Project> small = benchProject(name, 300);
  Engine engine(*small, m_plugins);
  QVERIFY2(engine.particles().size() > 150 && engine.particles().size() < 600,
           qPrintable(QString::number(engine.particles().size())));
  for (int frame = 0; frame < 3; ++frame) QCOMPARE(engine.step().flags, StepFlags{0});
}

void TstBench::filesHoldWhatTheirNamesSay_data() {
  QTest::addColumn<size_t>("particles");
  QTest::newRow("jelly-20k") << size_t{27 * 27 * 27};
  QTest::newRow("cloth-20k") << size_t{141 * 141};
  QTest::newRow("bar-49795") << size_t{61 * 26 * 11};
  QTest::newRow("melt-freeze-100k") << size_t{47 * 47 * 2 * 23};
}

void TstBench::filesHoldWhatTheirNamesSay() {
  QFETCH(size_t, particles);
  const std::string path = std::string(PS_SOURCE_DIR "/projects/bench/") + QTest::currentDataTag() + ".json";
  const Project project = loadProject(path, m_plugins).project;
  QCOMPARE(static_cast<size_t>(particleCount(project)), particles);
  QVERIFY(!project.bodies.front().constraints.empty());
  for (const long wanted : {5000L, 500'000L}) {
    Project scaled = project;
    scaleTo(scaled, wanted, particles);
    const double count = particleCount(scaled);
    QVERIFY2(std::abs(count / static_cast<double>(wanted) - 1) < 0.1,
             qPrintable(QString::number(count)));  // whole layers
    const auto layersOf = [](const Project& p) {
      return layersAlong(std::get<BoxShape>(p.bodies.front().shape).size.y(),
                         numberOf(p.solver.parameters, solverParameters(), "particle_spacing"));
    };
    if (layersOf(project) == 1) QCOMPARE(layersOf(scaled), 1.0);
  }
}

/// Where figures are compared, blocks and boxes must be those of the others: particles from a spacing off the side on,
/// in a box whose faces lie half a spacing before the layers of particles that line it elsewhere.
void TstBench::theDamBreakStandsWhereOthersHaveIt() {
  const Project project = *benchProject("dambreak-20k", std::nullopt);
  Engine engine(project, m_plugins);
  const ParticleStore& store = engine.particles();
  float low = 1, high = -10, back = 1, front = -1;
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Float4& p = store.position()[i];
    low = std::min(low, p.x), high = std::max(high, p.x), back = std::min(back, p.z), front = std::max(front, p.z);
  }
  QCOMPARE(low, -3.2f);
  QCOMPARE(high, -3.2f + 24 * 0.05f);
  QCOMPARE(back, -0.6f);
  QCOMPARE(front, 0.6f);
  for (const SceneWall& wall : project.environment.walls) {
    if (wall.id == "right") QCOMPARE(wall.point.x(), 6.5 / 2 - 0.025);
    if (wall.id == "front") QCOMPARE(wall.point.z(), 1.3 / 2 - 0.025);
  }
}

void TstBench::scenesAreScaled() {
  QVERIFY(!benchProject("no such scene", std::nullopt));
  for (const long wanted : {5000L, 50'000L, 500'000L}) {
    for (const std::string& name : benchSceneNames()) {
      const double particles = particleCount(*benchProject(name, wanted));
      QVERIFY2(std::abs(particles / static_cast<double>(wanted) - 1) < 0.1,  // whole layers
               qPrintable(QString("%1: %2 of %3").arg(name.c_str()).arg(particles).arg(wanted)));
    }
  }
}

void TstBench::loopsOfOneChunkAreNotShared() {
  const auto nap = [](size_t, size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  const double start = secondsShared();
  parallelFor(10, 10, nap);
  QCOMPARE(secondsShared(), start);
  const auto before = std::chrono::steady_clock::now();
  parallelFor(2, 1, [&](size_t first, size_t last) {
    nap(first, last);
    parallelFor(2, 1, nap);  // is within, and not counted again
  });
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count(),
               shared = secondsShared() - start;
  // At least its own nap and the one within, where others take both of the rest.
  QVERIFY2(shared >= 0.004 && shared <= passed, qPrintable(QString("%1 of %2").arg(shared).arg(passed)));
}

void TstBench::threadsFollowTheWork() {
  setThreadCount(8);
  for (const auto& [microseconds, threads] : {std::pair{0.0, 1}, {4.9, 1}, {5.1, 5}, {9.0, 6}, {1e6, 8}})
    QCOMPARE(threadsWorth(microseconds), threads);
  // As many chunks of something quick get fewer than those of something that takes long, and the least stay with the
  // one who calls.
  constexpr size_t kChunks = 3;
  const auto work = [](size_t grain) { return grain::microseconds(grain) * static_cast<double>(kChunks * grain); };
  QVERIFY(threadsWorth(work(grain::kParticles)) < threadsWorth(work(grain::kRays)));
#if !defined(__SANITIZE_THREAD__)
  const auto caller = std::this_thread::get_id();
  bool others = false;
  constexpr double kQuick = 1;
  parallelFor(
      kChunks, 1, [&](size_t, size_t) { others = others || std::this_thread::get_id() != caller; }, kQuick);
  QVERIFY(!others);
#endif
  setThreadCount(0);
}

void TstBench::runsAreCompared() {
  const json old = file("A", {row("tank", 1000, 1, 20, 10), row("tank", 1000, 2, 12, 6), row("river", 500, 1, 3, 1)});
  const json now = file("B", {row("tank", 1000, 1, 10, 2.5), row("tank", 2000, 2, 12, 6), row("jelly", 10, 1, 1, 0)});
  const json compared = compareBench(old, now, "old.json");
  QCOMPARE(compared.size(), size_t{1});
  QCOMPARE(compared[0]["name"].get<std::string>(), std::string("tank"));
  QCOMPARE(compared[0]["ratio"].get<double>(), 0.5);
  QCOMPARE(compared[0]["stages"].dump(), std::string(R"({"density":0.25})"));
  QCOMPARE(machineDifference(old, now), std::string("cpu: \"A\", now \"B\""));
  QCOMPARE(machineDifference(old, old), std::string());
  QVERIFY_THROWS_EXCEPTION(InputError, compareBench({{"scenes", {{{"stages", 1}}}}}, now, "old.json"));
}

void TstBench::growthIsTabledAndDrawn() {
  const json rows{row("a<b", 1000, 1, 2, 1), row("a<b", 10'000, 1, 20, 10), row("tank", 1000, 2, 1, 1)};
  const QStringList lines = QString::fromStdString(growthTable(rows)).split('\n');
  QCOMPARE(lines.size(), 5);  // with what follows the last line's end
  QCOMPARE(lines[0], QString("name,particles,threads,ms,ns_per_particle_iteration,serial_share,memory_per_particle"));
  QCOMPARE(lines[2], QString("a<b,10000,1,20,50.5,0.25,512"));
  const QString plot = QString::fromStdString(growthPlot(rows));
  QCOMPARE(plot.count("<polyline"), 2);
  QVERIFY(plot.contains(">a&lt;b, 1 threads<") && plot.contains(">10000<") && plot.contains(">tank, 2 threads<"));
  QVERIFY(!QString::fromStdString(growthPlot(json::array())).contains("<polyline"));
}

QTEST_APPLESS_MAIN(TstBench)
#include "tst_bench.moc"
