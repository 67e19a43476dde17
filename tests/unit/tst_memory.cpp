// SPDX-License-Identifier: Apache-2.0
// What a scene needs against what the machine has: found before anything is made, and told with numbers and a spacing
// that fits. What a machine says of itself stands in files that the tests write.
#include "core/base/memory.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/simulation/sceneneed.h"
#include "core/simulation/sceneproblem.h"
#include "core/solver/footprint.h"
#include "tests/shared/scenes.h"
#include "tests/unit/clirun.h"

#include <QDir>
#include <QTest>

#include <cmath>

using namespace ps;

namespace {

constexpr double kGiga = 1e9, kKilobyte = 1024;
const Address kSpacing{Owner::Solver, "", "particle_spacing"};

/// A machine as its files tell of it.
class Machine {
 public:
  void write(const QString& name, const QByteArray& text) const {
    const QString path = m_folder.path() + name;
    QVERIFY(QDir().mkpath(path.section('/', 0, -2)));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
  }
  Memory memory() const { return memoryNow(m_folder.path().toStdString()); }

 private:
  QTemporaryDir m_folder;
};

void describe(const Machine& machine) {
  machine.write("/proc/meminfo", "MemTotal: 24684084 kB\nMemFree: 100 kB\nMemAvailable:   16000000 kB\n");
  machine.write("/proc/self/status", "Name:\tx\nVmSize:\t  200000 kB\nVmRSS:\t   50000 kB\n");
}

Memory having(double bytes) { return {bytes, 0}; }

/// A block of ice, `side` m wide.
Project ice(double side, double spacing) {
  Project project = scenes::iceOnPlate(4, 300);
  std::get<BoxShape>(project.bodies[0].shape).size = {side, side, side};
  project.solver.parameters.values["particle_spacing"] = spacing;
  return project;
}

}  // namespace

class TestMemory : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }

  void theMachineTellsWhatIsAvailable() {
    const Machine machine;
    QVERIFY(std::isinf(machine.memory().free));
    describe(machine);
    QCOMPARE(machine.memory().free, 16e6 * kKilobyte);
    QCOMPARE(machine.memory().own, 5e4 * kKilobyte);
  }

  void controlGroupsLeaveLess_data() {
    QTest::addColumn<QByteArray>("groups");
    QTest::addColumn<QString>("folder");
    QTest::addColumn<QByteArray>("limit");
    QTest::addColumn<double>("free");
    const QByteArray second = "0::/user/job\n",
                     first = "9:name=systemd:/\n4:memory:/docker/ab\n1:cpu:/docker/ab\n0::/\n";
    // Of 3 GB used one could be given back at once.
    QTest::newRow("version 2") << second << "/sys/fs/cgroup/user/job" << QByteArray("5000000000\n") << 3 * kGiga;
    QTest::newRow("around it") << second << "/sys/fs/cgroup/user" << QByteArray("5000000000\n") << 3 * kGiga;
    QTest::newRow("in a container") << second << "/sys/fs/cgroup" << QByteArray("5000000000\n") << 3 * kGiga;
    QTest::newRow("no limit") << second << "/sys/fs/cgroup/user/job" << QByteArray("max\n") << 16e6 * kKilobyte;
    QTest::newRow("overdrawn") << second << "/sys/fs/cgroup/user/job" << QByteArray("1000\n") << 0.0;
    QTest::newRow("version 1") << first << "/sys/fs/cgroup/memory/docker/ab" << QByteArray("5000000000\n") << 3 * kGiga;
    QTest::newRow("none of version 1") << first << "/sys/fs/cgroup/memory/docker/ab"
                                       << QByteArray("9223372036854771712\n") << 16e6 * kKilobyte;
  }
  void controlGroupsLeaveLess() {
    QFETCH(QByteArray, groups);
    QFETCH(QString, folder);
    QFETCH(QByteArray, limit);
    QFETCH(double, free);
    const Machine machine;
    describe(machine);
    machine.write("/proc/self/cgroup", groups);
    const bool first = folder.contains("/memory/");
    machine.write(folder + (first ? "/memory.limit_in_bytes" : "/memory.max"), limit);
    machine.write(folder + (first ? "/memory.usage_in_bytes" : "/memory.current"), "3000000000\n");
    machine.write(folder + "/memory.stat",
                  first ? "inactive_file 5\ntotal_inactive_file 1000000000\n" : "anon 1\ninactive_file 1000000000\n");
    QCOMPARE(machine.memory().free, free);
  }

  void amountsHaveTwoDigits_data() {
    QTest::addColumn<double>("bytes");
    QTest::addColumn<QString>("text");
    QTest::newRow("nothing") << 0.0 << "1.0 MB";
    QTest::newRow("small") << 2.34e6 << "2.3 MB";
    QTest::newRow("hundreds") << 872e6 << "870 MB";
    QTest::newRow("nearly one") << 996e6 << "1.0 GB";
    QTest::newRow("some") << 5.47e9 << "5.5 GB";
    QTest::newRow("tens") << 54.6e9 << "55 GB";
    QTest::newRow("thousands") << 1.24e12 << "1200 GB";
  }
  void amountsHaveTwoDigits() {
    QFETCH(double, bytes);
    QFETCH(QString, text);
    QCOMPARE(QString::fromStdString(memoryText(bytes)), text);
  }

  void neighboursOfALattice_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::addColumn<double>("z");
    QTest::addColumn<double>("neighbours");
    QTest::newRow("one particle") << 1.0 << 1.0 << 1.0 << 0.0;
    QTest::newRow("two") << 2.0 << 1.0 << 1.0 << 1.0;
    QTest::newRow("a line, two to each side") << 1e9 << 1.0 << 1.0 << 4.0;
    QTest::newRow("a sheet") << 1e9 << 1e9 << 1.0 << 12.0;
    QTest::newRow("a block") << 1e9 << 1e9 << 1e9 << 32.0;
  }
  void neighboursOfALattice() {
    QFETCH(double, x);
    QFETCH(double, y);
    QFETCH(double, z);
    QFETCH(double, neighbours);
    QVERIFY(std::abs(latticeNeighbours({x, y, z}, 2.2) - neighbours) < 1e-6);
  }

  void halfTheSpacingTakesEightTimesAsMuch() {
    const SceneNeed coarse = needOf(ice(0.4, 0.004), m_plugins.get()), fine = needOf(ice(0.4, 0.002), m_plugins.get());
    QCOMPARE(coarse.particles, 1e6);
    QCOMPARE(fine.particles, 8e6);
    QVERIFY(std::abs(fine.bytes / coarse.bytes - 8) < 0.02);
  }

  /// What a few numbers of a file ask for beyond the count of particles.
  void structureWallsAndTapsCount() {
    Project project = ice(0.4, 0.01);
    const double plain = needOf(project, m_plugins.get()).bytes;
    project.bodies[0].constraints = {{"clusters", {}, {}}};
    const double soft = needOf(project, m_plugins.get()).bytes;
    project.bodies[0].constraints[0].parameters.values["radius"] = 20.0;
    project.bodies[0].constraints[0].parameters.values["spacing"] = 0.5;
    QVERIFY(needOf(project, m_plugins.get()).bytes > 1000 * soft);
    project = ice(0.4, 0.01);
    project.environment.walls.resize(1000, project.environment.walls[0]);
    QVERIFY(needOf(project, m_plugins.get()).bytes > 2 * plain);
    project = ice(0.4, 0.01);
    project.bodies[0].constraints[0].parameters.values["neighbours"] = std::string("six");
    QVERIFY(needOf(project, m_plugins.get()).bytes < plain);
    Emitter tap;
    tap.material = "water";
    tap.parameters.values["most"] = 5000.0;
    project.emitters = {tap};
    QCOMPARE(needOf(project, m_plugins.get()).pouredParticles, 5000.0);
    project.emitters[0].parameters.values["stop"] = 0.01;
    QVERIFY(needOf(project, m_plugins.get()).pouredParticles < 50);
  }

  /// A sketch keeps its place at another spacing.
  void sketchesCountAsTheyAreFilled() {
    Project project = ice(0.4, 0.01);
    VoxelShape cells;
    cells.spacing = 0.02;
    cells.palette = {{"water", 260}};
    cells.runs = {{0, 0, 0, 100, 0}, {0, 1, 0, 100, 0}};
    project.bodies[0].shape = cells;
    QCOMPARE(needOf(project, m_plugins.get()).particles, 1600.0);
  }

  void whatDoesNotFitIsToldWithASpacingThatDoes_data() {
    QTest::addColumn<double>("gigabytes");
    for (const double gigabytes : {0.5, 4.0, 20.0}) QTest::addRow("%g GB", gigabytes) << gigabytes;
  }
  void whatDoesNotFitIsToldWithASpacingThatDoes() {
    QFETCH(double, gigabytes);
    const Memory memory = having(gigabytes * kGiga);
    Project project = ice(0.4, 0.0015);
    const std::string problem = memoryProblem(project, m_plugins.get(), scaleOf(project), memory);
    const QString text = QString::fromStdString(problem);
    QVERIFY2(text.startsWith("the scene needs about ") && text.contains(" GB of memory for 19 million particles, and "),
             problem.c_str());
    const QString said = text.section("a particle spacing of ", 1).section(" mm or more would fit", 0, 0);
    bool isNumber = false;
    const double spacing = said.toDouble(&isNumber) / 1000;
    QVERIFY2(isNumber, problem.c_str());
    const auto fits = [&](double s) {
      project.solver.parameters.values["particle_spacing"] = s;
      return memoryProblem(project, m_plugins.get(), scaleOf(project), memory).empty();
    };
    QVERIFY(fits(spacing));
    QVERIFY(!fits(0.9 * spacing));
  }

  void whatNoSpacingMakesFitIsTold() {
    const Project project = ice(0.4, 0.01);
    const std::string problem = memoryProblem(project, m_plugins.get(), scaleOf(project), having(1000));
    QVERIFY2(problem.find("make its bodies smaller") != problem.npos, problem.c_str());
  }

  void aSceneThatDoesNotFitNamesItsSpacing() {
    const Project project = ice(0.4, 0.002);
    try {
      requireRoom(project, *m_plugins, having(4 * kGiga));
      QFAIL("it was taken");
    } catch (const SceneError& error) {
      QCOMPARE(error.culprit.text(), kSpacing.text());
    }
    requireRoom(project, *m_plugins, having(100 * kGiga));
    // What stands can grow into what is left.
    requireRoomFor(1000, 1e6, 3000, {8 * kGiga, 2 * kGiga});
    QVERIFY_EXCEPTION_THROWN(requireRoomFor(1000, 1e6, 3000, {3 * kGiga, 2 * kGiga}), SceneError);
    QVERIFY_EXCEPTION_THROWN(requireRoomFor(19e6, 2e6, 1, having(1000 * kGiga)), SceneError);
  }

  /// By a program whose addresses are limited to 3 GB: what the machine has does not matter then.
  void theCommandLineSaysSoAtOnce() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    QSKIP("a sanitizer needs more addresses than any limit leaves");
#endif
    const auto limited = [](const QStringList& arguments) {
      QProcess process;
      process.start("/bin/sh", QStringList{"-c", "ulimit -v 3000000; exec \"$@\"", "sh", kProgram} + arguments);
      return ended(process);
    };
    const Ran run = limited({"simulate", kSample, "--frames", "1", "--set", "/solver/particle_spacing=0.0014"});
    QCOMPARE(run.code, 2);
    QVERIFY2(run.err.contains("GB of memory for 17.5 million particles") && run.err.contains(" mm or more would fit"),
             run.err);
    const QTemporaryDir folder;
    QFile sample(kSample);
    QVERIFY(sample.open(QIODevice::ReadOnly));
    QByteArray text = sample.readAll();
    text.replace("\"particle_spacing\": 0.02", "\"particle_spacing\": 0.0014");
    QFile fine(folder.filePath("fine.json"));
    QVERIFY(fine.open(QIODevice::WriteOnly));
    fine.write(text);
    fine.close();
    const Ran checked = limited({"validate", fine.fileName()});
    QCOMPARE(checked.code, 0);
    QVERIFY2(checked.err.contains("fine.json:/solver/particle_spacing: the scene needs about "), checked.err);
  }

 private:
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_GUILESS_MAIN(TestMemory)
#include "tst_memory.moc"
