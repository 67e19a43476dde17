// SPDX-License-Identifier: Apache-2.0
// What experiments make of runs: measures of series, verdicts of cases, soaked sliders. The library itself, without the
// command line.
#include "core/base/error.h"
#include "core/experiments/casemeasure.h"
#include "core/experiments/caserun.h"
#include "core/experiments/probetable.h"
#include "core/experiments/settlingmeasure.h"
#include "core/experiments/soak.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "tests/shared/scenes.h"

#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <set>

using namespace ps;

class TestMeasures : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void oneNumberOfASeries_data();
  void oneNumberOfASeries();
  void verdictsKeepToTheirTolerances_data();
  void verdictsKeepToTheirTolerances();
  void noTwoColumnsAreAlike();
  void aCaseTakesTheDifferenceOfTwoTimes();
  void aCaseThatCannotRunSaysWhy();
  void runsEndWhereTheyAreStopped();
  void whatFallsHasNotSettled();
  void slidersHaveTwoEnds();
  void aSliderThatAltersNothingIsNotUsed();

 private:
  PluginRegistry m_plugins;
};

namespace {

/// Eight particles of water in free fall.
Project fallingBlock() {
  Project project;
  project.materials.push_back(scenes::water());
  project.bodies.push_back(scenes::block("drop", 2, 0.02, {0, 0.5, 0}, 300));
  project.solver.parameters.values["particle_spacing"] = 0.02;
  return project;
}

Case caseOf(const CaseCheck& check) {
  Case what;
  what.id = "case";
  what.runs.push_back({});
  what.checks.push_back(check);
  return what;
}

}  // namespace

void TestMeasures::oneNumberOfASeries_data() {
  QTest::addColumn<QString>("measure");
  QTest::addColumn<QString>("options");
  QTest::addColumn<double>("expected");
  const auto row = [](const char* measure, const char* options, double expected) {
    QTest::newRow(measure) << measure << options << expected;
  };
  // v = t² at t = 0, 1, 2, 3, 4
  row("first", "{}", 0);
  row("last", "{}", 16);
  row("minimum", "{}", 0);
  row("maximum", "{}", 16);
  row("change", "{}", 16);
  row("at", R"({"time": 2.5})", 6.5);     // between 4 and 9
  row("when", R"({"value": 6.5})", 2.5);  // the same line
  row("slope", R"({"from": 1, "to": 9})", 4);
  row("fastest", R"({"frames": 2})", 6);  // from 4 to 16 in 2 s
  row("mean", R"({"from": 1, "to": 3})", 14.0 / 3);
}

void TestMeasures::oneNumberOfASeries() {
  QFETCH(QString, measure);
  QFETCH(QString, options);
  QFETCH(double, expected);
  const Series series{{0, 1, 2, 3, 4}, {0, 1, 4, 9, 16}};
  const double value = measureOf(series, measure.toStdString(), nlohmann::json::parse(options.toStdString()));
  QVERIFY2(std::abs(value - expected) < 1e-12, qPrintable(QString::number(value, 'g', 17)));  // rounding alone
  QVERIFY(std::isnan(measureOf(series, "when", {{"value", 20}})));
}

void TestMeasures::verdictsKeepToTheirTolerances_data() {
  QTest::addColumn<double>("relative");
  QTest::addColumn<double>("atMost");
  QTest::addColumn<double>("measured");
  QTest::addColumn<bool>("holds");
  QTest::addColumn<QString>("words");
  const double nan = std::nan("");
  QTest::newRow("within") << 0.02 << nan << 10.1 << true << QStringLiteral("±2 %");
  QTest::newRow("beyond") << 0.02 << nan << 10.3 << false << QStringLiteral("±2 %");
  QTest::newRow("bound") << 0.5 << 10.2 << 10.3 << false << QStringLiteral("±50 %, ≤ 10.2");
  QTest::newRow("not finite") << 0.5 << nan << nan << false << QStringLiteral("±50 %");
}

void TestMeasures::verdictsKeepToTheirTolerances() {
  QFETCH(double, relative);
  QFETCH(double, atMost);
  QFETCH(double, measured);
  CaseCheck check;
  check.relative = relative;
  if (!std::isnan(atMost)) check.atMost = atMost;
  const CaseVerdict verdict = verdictOf(caseOf(check), "period", check, 10, measured);
  QTEST(verdict.holds, "holds");
  QTEST(QString::fromStdString(verdict.tolerance), "words");
}

void TestMeasures::noTwoColumnsAreAlike() {
  const std::string all = "all.temperature[K]", solid = "solid.mass[kg]", ice = "ice.height[m]";
  const std::vector<std::string> probes{all + " (2)", ice, solid + " (2)", ice + " (2)", ice + " (3)"};
  const std::vector<std::string> titles = columnTitles({all, ice, solid, ice, ice});
  QVERIFY(std::equal(probes.begin(), probes.end(), titles.begin() + 2));
  QCOMPARE(titles.back(), all);
  QCOMPARE(std::set(titles.begin(), titles.end()).size(), titles.size());
}

void TestMeasures::aCaseTakesTheDifferenceOfTwoTimes() {
  // The drop of free fall, once by its column at two times, once by the times at which it passes two heights.
  QTemporaryDir folder;
  Project project = fallingBlock();
  project.environment.boundsMinimum = {-1, -10, -1};
  Probe& probe = project.probes.emplace_back();
  probe.id = probe.name = "drop";
  probe.quantity = "position_y";
  Case fall = caseOf({});
  fall.project = folder.filePath("drop.json").toStdString();
  saveProject(project, fall.project);
  fall.runs[0].frames = 60;
  const std::string y = "drop.position_y[m]";
  CaseCheck& way = fall.checks[0];
  way.number = {y, "", "at", {{"time", 0.8}}};
  way.less = {y, "", "at", {{"time", 0.4}}};
  way.times = -1;
  way.expected = {0.5 * 9.81 * (0.8 * 0.8 - 0.4 * 0.4)};
  way.relative = 0.01;  // symplectic Euler: dt/4 to 1.2 s
  CaseCheck time = way;
  const double start = 0.52;  // of the centre
  time.number = {y, "", "when", {{"value", start - 0.5 * 9.81 * 0.8 * 0.8}}};
  time.less = {y, "", "when", {{"value", start - 0.5 * 9.81 * 0.4 * 0.4}}};
  time.times = 1;
  time.expected = {0.4};
  fall.checks.push_back(time);
  std::vector<CaseVerdict> verdicts;
  runCase(fall, {}, m_plugins, {}, [&](const CaseVerdict& v) { verdicts.push_back(v); });
  QVERIFY2(verdicts.size() == 2, verdicts.front().tolerance.c_str());
  for (const CaseVerdict& v : verdicts)
    QVERIFY2(v.holds, qPrintable(QString::number(v.measured.value_or(0)) + QString::fromStdString(v.tolerance)));
}

void TestMeasures::aCaseThatCannotRunSaysWhy() {
  CaseCheck check;
  check.function = "thesis_gravity";
  check.arguments = {1, 2};
  std::vector<CaseVerdict> verdicts;
  runCase(caseOf(check), {}, m_plugins, {}, [&](const CaseVerdict& v) { verdicts.push_back(v); });
  QCOMPARE(verdicts.size(), size_t{1});
  QVERIFY(!verdicts[0].holds && !verdicts[0].measured);
  QCOMPARE(verdicts[0].tolerance, std::string("the function 'thesis_gravity' takes 1 arguments"));
}

void TestMeasures::runsEndWhereTheyAreStopped() {
  Engine engine(fallingBlock(), m_plugins);
  long frames = 0;
  const auto count = [&](const StepReport&, const FrameStats&) { ++frames; };
  QVERIFY(runFrames(engine, 3, count, {}));
  QCOMPARE(frames, 3L);
  QVERIFY(!runFrames(engine, 3, count, [&] { return frames == 5; }));
  QCOMPARE(frames, 5L);
}

void TestMeasures::whatFallsHasNotSettled() {
  Engine engine(fallingBlock(), m_plugins);
  SettlingMeasure settling(8);
  runFrames(engine, 8, [&](const StepReport&, const FrameStats& stats) { settling.add(engine, stats); }, {});
  const nlohmann::json measured = settling.json(engine);
  // From frame 4 to frame 8 of 1/60 s: g (8² − 4²) / (2 · 60²) = 6.5 cm; symplectic Euler adds under 2 %.
  const double fallen = 9.81 * (64 - 16) / (2 * 3600.0), moved = measured["moved"]["body"].get<double>();
  QVERIFY2(std::abs(moved / fallen - 1) < 0.04, qPrintable(QString::number(moved)));
  QVERIFY(measured["speed_rms"]["highest"].get<double>() > measured["speed_rms"]["mean"].get<double>());
}

void TestMeasures::slidersHaveTwoEnds() {
  const std::vector<SliderChange> changes = sliderChanges(fallingBlock(), m_plugins, {"solver/substeps"});
  QCOMPARE(changes.size(), size_t{2});
  QVERIFY(changes[0].text().starts_with("solver/substeps = "));
  QVERIFY(!(changes[0].value == changes[1].value));
  QVERIFY(sliderChanges(fallingBlock(), m_plugins, {"no/such"}).empty());
}

void TestMeasures::aSliderThatAltersNothingIsNotUsed() {
  auto plugins = std::make_unique<PluginRegistry>();
  Project project = fallingBlock();
  project.solver.thermalModel.clear();
  std::vector<SliderChange> changes = sliderChanges(project, *plugins, {"solver/thermal_cfl"});
  const std::vector<SliderChange> refused{{changes.at(0).address, Value(1e9)}};
  changes.push_back(refused[0]);
  std::vector<std::string> words;
  bool failed = false;
  soakProject(project, plugins, changes, 0.2, {}, [&](const SoakVerdict& verdict) {
    words.push_back(verdict.words);
    failed = failed || verdict.failed;
  });
  QCOMPARE(words.size(), changes.size() + 1);
  QCOMPARE(words[0], std::string("fine"));
  QCOMPARE(words[1], std::string("not used here"));
  QVERIFY2(words.back().starts_with("refused: Heat step must be at most 5"), words.back().c_str());
  QVERIFY(!failed);
}

QTEST_GUILESS_MAIN(TestMeasures)
#include "tst_measures.moc"
