// SPDX-License-Identifier: Apache-2.0
// Draw the result: values are found with which a run goes through wanted points. The scene is one whose course is known
// by heart: a block that is held and heated takes its power times the time, so that what must be found is known too.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/experiments/curvefit.h"
#include "core/experiments/wantedfile.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/projectstate.h"
#include "tests/shared/scenes.h"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>

using namespace ps;

namespace {

constexpr const char* kPower = "body/block/heating_power";
constexpr const char* kTemperature = "body/block/temperature";
constexpr double kFrame = 0.1;  // s of heat

/// Water that is held in place and heated with 100 W, 0.1 s a frame.
Project heatedBlock() {
  Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(scenes::water());
  Body block = scenes::block("block", 3, 0.02, {0, 0, 0}, 293.15);
  block.parameters.values = {{"fixed", true}, {"temperature", 293.15}, {"heating_power", 100.0}};
  project.bodies.push_back(block);
  Probe probe;
  probe.id = probe.name = probe.body = "block";
  probe.quantity = "thermal_energy";
  probe.fixed = true;
  project.probes.push_back(probe);
  project.environment.parameters.values["air_convection"] = 0.0;
  project.solver.parameters.values = {{"particle_spacing", 0.02}, {"thermal_time_scale", 1.0}, {"dt", kFrame}};
  return project;
}

}  // namespace

class TestCurveFit : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aPowerIsFoundFromAnyStart_data() {
    QTest::addColumn<double>("start");
    QTest::addRow("cold") << 0.0;
    QTest::addRow("near") << 180.0;
    QTest::addRow("out of the range") << 900.0;
  }
  /// Within the step that the search ends at, a 3000th of the range.
  void aPowerIsFoundFromAnyStart() {
    QFETCH(double, start);
    Project project = heatedBlock();
    project.bodies[0].parameters.values["heating_power"] = start;
    FitTask task = wantedWith(project, 217, 293.15, {1.0});
    task.parameters = {FitParameter::parse(std::string(kPower) + "=0..600", project, &m_plugins)};
    int runs = 0, best = 0;
    const FitResult result = fitToCurve(project, m_plugins, task, nullptr, [&](const FitTrial& trial) {
      QCOMPARE(trial.run, ++runs);
      best = trial.isBest ? trial.run : best;
    });
    QVERIFY(!result.stopped);
    QCOMPARE(result.runs, runs);
    QCOMPARE(result.after.run, best);
    QCOMPARE(result.before.values[0], start);
    QVERIFY(std::abs(result.before.error - std::abs(start - 217) * 1.0) < 1e-3);  // J
    QVERIFY2(std::abs(result.after.values[0] - 217) < 600.0 / 3000,
             qPrintable(QString::number(result.after.values[0])));
    QVERIFY(result.after.error < 600.0 / 3000);
    const Project changed = withValues(project, m_plugins, task, result.after.values);
    QCOMPARE(numberAt(changed, &m_plugins, task.parameters[0].target), result.after.values[0]);
  }

  /// Energy at two times tells where it begins and how it rises.
  void twoParametersAreFoundTogether() {
    const Project project = heatedBlock();
    FitTask task = wantedWith(project, 5200, 301, {0.5, 1.0, 2.0});
    task.parameters = {FitParameter::parse(std::string(kPower) + "=0..10000", project, &m_plugins),
                       FitParameter::parse(std::string(kTemperature) + "=280..320", project, &m_plugins)};
    task.mostRuns = 200;
    const FitResult result = fitToCurve(project, m_plugins, task, nullptr, nullptr);
    QVERIFY2(std::abs(result.after.values[0] - 5200) < 50 && std::abs(result.after.values[1] - 301) < 0.05,
             qPrintable(QStringLiteral("%1 W, %2 K").arg(result.after.values[0]).arg(result.after.values[1])));
    QVERIFY(result.after.error < 0.01 * result.before.error);
  }

  void aRunThatHasNoValueCountsAsMissed() {
    Project project = heatedBlock();
    project.probes[0].body = "nobody";
    FitTask task{"block.thermal_energy[J]", {{0.5, 1.0}, {10, 30}}, {}, 1};
    task.parameters = {FitParameter::parse(kPower, project, &m_plugins)};
    project.probes[0].quantity = "temperature";
    task.column = "block.temperature[K]";
    const FitResult result = fitToCurve(project, m_plugins, task, nullptr, nullptr);
    QCOMPARE(result.before.error, 20.0);
    QCOMPARE(result.before.missing, size_t{2});
    QVERIFY(result.stopped);
  }

  /// Where all is frozen nothing is liquid: such a run misses a curve that is nearly level by nearly nothing, and is
  /// never the best all the same.
  void aRunWithoutValuesIsNeverTheBest() {
    Project project = heatedBlock();
    project.probes[0].quantity = "temperature";
    project.probes[0].phase = "liquid";
    FitTask task{"block.temperature[K]", {{0.5, 1.0}, {300, 300.1}}, {}, 60};
    task.parameters = {FitParameter::parse(std::string(kTemperature) + "=200..320", project, &m_plugins)};
    int missing = 0;
    const FitResult result = fitToCurve(project, m_plugins, task, nullptr,
                                        [&](const FitTrial& trial) { missing += trial.missing > 0 ? 1 : 0; });
    QVERIFY(missing > 0);
    QCOMPARE(result.after.missing, size_t{0});
    QVERIFY2(std::abs(result.after.values[0] - 300) < 0.2, qPrintable(QString::number(result.after.values[0])));
  }

  void whatFollowsKeysIsRefused() {
    Project project = heatedBlock();
    project.tracks.push_back({kPower, {{0, 100, ToNext::Linear, {}, {}}, {1, 200, ToNext::Linear, {}, {}}}});
    QVERIFY_THROWS_EXCEPTION(InputError, FitParameter::parse(kPower, project, &m_plugins));
  }

  /// The power until a key at two seconds; what the keys say behind that stays.
  void aKeysValueIsFound() {
    Project project = heatedBlock();
    project.tracks.push_back({kPower, {{0, 100, ToNext::Step, {}, {}}, {2, 50, ToNext::Step, {}, {}}}});
    FitTask task = wantedWith(heatedBlock(), 217, 293.15, {1.0});
    task.parameters = {FitParameter::parse(std::string(kPower) + "@0=0..600", project, &m_plugins)};
    QCOMPARE(task.parameters[0].text(), std::string(kPower) + "@0");
    const FitResult result = fitToCurve(project, m_plugins, task, nullptr, nullptr);
    QCOMPARE(result.before.values[0], 100.0);
    QVERIFY2(std::abs(result.after.values[0] - 217) < 600.0 / 3000,
             qPrintable(QString::number(result.after.values[0])));
    const Project changed = withValues(project, m_plugins, task, result.after.values);
    QCOMPARE(changed.tracks[0].keys[0].value, result.after.values[0]);
    QCOMPARE(changed.tracks[0].keys[1].value, 50.0);
    for (const char* none : {"@2", "@x", "@"})
      QVERIFY_THROWS_EXCEPTION(InputError, FitParameter::parse(std::string(kPower) + none, project, &m_plugins));
    QVERIFY_THROWS_EXCEPTION(InputError, FitParameter::parse(std::string(kPower) + "@0", heatedBlock(), &m_plugins));
  }

  void itEndsWhenToldTo() {
    const Project project = heatedBlock();
    FitTask task = wantedWith(project, 300, 293.15, {1.0});
    task.parameters = {FitParameter::parse(kPower, project, &m_plugins)};
    int runs = 0;
    const FitResult result = fitToCurve(
        project, m_plugins, task, [&] { return runs >= 3; }, [&](const FitTrial&) { ++runs; });
    QVERIFY(result.stopped);
    QVERIFY(runs >= 3 && runs <= 4);
    task.mostRuns = 7;
    const FitResult most = fitToCurve(project, m_plugins, task, nullptr, nullptr);
    QVERIFY(most.stopped);
    QCOMPARE(most.runs, 7);
  }

  /// Before anything else is looked at, even what is wrong with the task.
  void whileASceneIsMadeItIsStopped() {
    const Project project = heatedBlock();
    FitTask task = wantedWith(project, 300, 293.15, {1.0});
    task.parameters = {FitParameter::parse(kPower, project, &m_plugins)};
    task.column = "none of this name";
    QVERIFY_EXCEPTION_THROWN(fitToCurve(project, m_plugins, task, nullptr, nullptr), InputError);
    const FitResult result = fitToCurve(
        project, m_plugins, task, [] { return true; }, nullptr);
    QVERIFY(result.stopped);
    QCOMPARE(result.runs, 0);
  }

  /// From a state runs begin there; points before it are passed over, and what acts at the start alone is refused.
  void runsBeginAtTheProjectsState() {
    Project project = heatedBlock();
    FitTask task = wantedWith(project, 250, 293.15, {1.0});
    Engine engine(project, m_plugins);
    for (int k = 0; k < 5; ++k) engine.step();
    const double gained = engine.stats().probes[0];
    StateBuffer buffer;
    saveTo(buffer, engine);
    project.state = projectState(buffer.bytes(), project.bodies);
    task.wanted = {{0.2, 1.0}, {-1e9, gained + 170.0 * 0.5}};
    task.parameters = {FitParameter::parse(std::string(kPower) + "=0..600", project, &m_plugins)};
    const FitResult result = fitToCurve(project, m_plugins, task, nullptr, nullptr);
    QVERIFY2(std::abs(result.after.values[0] - 170) < 0.2, qPrintable(QString::number(result.after.values[0])));
    QVERIFY(result.after.course.time.front() > 0.45);
    QVERIFY_THROWS_EXCEPTION(InputError, FitParameter::parse(kTemperature, project, &m_plugins));
    task.wanted = {{0.4}, {gained}};
    QVERIFY_THROWS_EXCEPTION(InputError, fitToCurve(project, m_plugins, task, nullptr, nullptr));
  }

  void whatMeansNothingIsRefused_data() {
    QTest::addColumn<QString>("parameter");
    QTest::addColumn<QString>("words");
    QTest::addRow("unknown") << "body/block/power"
                             << "no parameter 'body/block/power'";
    QTest::addRow("no body") << "body/other/heating_power"
                             << "no parameter";
    QTest::addRow("a switch") << "body/block/fixed"
                              << "is no number";
    QTest::addRow("no range") << "body/block/heating_power=5"
                              << "LEAST..MOST";
    QTest::addRow("no number") << "body/block/heating_power=5..much"
                               << "'much' is no number";
    QTest::addRow("empty range") << "body/block/heating_power=5..5"
                                 << "range is empty";
    QTest::addRow("below zero") << "body/block/temperature=-5..300"
                                << "must be";
    QTest::addRow("a whole curve") << "material/water/density_liquid"
                                   << "one of its points";
    QTest::addRow("no such point") << "material/water/density_liquid[99]"
                                   << "has no point 99";
  }
  void whatMeansNothingIsRefused() {
    QFETCH(QString, parameter);
    QFETCH(QString, words);
    Project project = heatedBlock();
    Response density;
    density.kind = Response::Kind::Curve;
    density.points = {{270, 1000}, {370, 960}};
    project.materials[0].properties.values["density_liquid"] = density;
    QString said;
    try {
      FitParameter::parse(parameter.toStdString(), project, &m_plugins);
    } catch (const InputError& error) {
      said = QString::fromUtf8(error.what());
    }
    QVERIFY2(said.contains(words), qPrintable(said));
    const FitParameter point = FitParameter::parse("material/water/density_liquid[1]=900..1000", project, &m_plugins);
    QCOMPARE(numberAt(project, &m_plugins, point.target), 960.0);
    const Value moved = valueWithNumber(project, &m_plugins, point.target, 950);
    QCOMPARE(std::get<Response>(moved).points[1].y, 950.0f);
    QCOMPARE(std::get<Response>(moved).points[0].y, 1000.0f);
  }

  void aWantedCurveComesFromATable_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("words");
    QTest::addRow("fine") << QByteArray("time_s,\"Ice, all.mass[kg]\"\r\n0,4\r\n1,\r\n2,1e-3\r\n") << "";
    QTest::addRow("empty") << QByteArray() << "holds no point";
    QTest::addRow("titles alone") << QByteArray("time_s,a\n") << "holds no point";
    QTest::addRow("no titles") << QByteArray("0,1\n1,2\n") << ":1: must be the titles";
    QTest::addRow("three columns") << QByteArray("time_s,a,b\n0,1,2\n") << ":1: must have two cells";
    QTest::addRow("open quotes") << QByteArray("time_s,\"a\n0,1\n") << ":1: must have two cells";
    QTest::addRow("words") << QByteArray("time_s,a\n0,1\n1,much\n") << ":3: 'much' is no number";
    QTest::addRow("back in time") << QByteArray("time_s,a\n1,1\n1,2\n") << ":3: must come after";
  }
  void aWantedCurveComesFromATable() {
    QFETCH(QByteArray, text);
    QFETCH(QString, words);
    const QTemporaryDir folder;
    const QString path = folder.filePath("wanted.csv");
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text) == text.size());
    file.close();
    try {
      const FitTask task = readWanted(path.toStdString());
      QVERIFY(words.isEmpty());
      QCOMPARE(task.column, std::string("Ice, all.mass[kg]"));
      QCOMPARE(task.wanted.time, (std::vector<double>{0, 2}));
      QCOMPARE(task.wanted.value, (std::vector<double>{4, 1e-3}));
    } catch (const InputError& error) {
      QVERIFY2(!words.isEmpty() && QString::fromUtf8(error.what()).contains(words), error.what());
    }
  }

 private:
  /// Points that a run with this power in W and start in K goes through.
  FitTask wantedWith(Project project, double power, double kelvin, const std::vector<double>& times) {
    project.bodies[0].parameters.values["heating_power"] = power;
    project.bodies[0].parameters.values["temperature"] = kelvin;
    FitTask task{"block.thermal_energy[J]", {}, {}, 60};
    Engine engine(project, m_plugins);
    double now = 0;
    for (const double time : times) {
      for (; now < time - 1e-9; now += kFrame) engine.step();
      task.wanted.time.push_back(time);
      task.wanted.value.push_back(engine.stats().probes[0]);
    }
    return task;
  }
  PluginRegistry m_plugins;
};

QTEST_APPLESS_MAIN(TestCurveFit)
#include "tst_curvefit.moc"
