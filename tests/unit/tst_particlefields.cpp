// SPDX-License-Identifier: Apache-2.0
// The table of what particles show, and what follows from it without a window: snapshots, probes, checks.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/scene/quantitygroup.h"
#include "core/simulation/engine.h"
#include "core/simulation/particlefield.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <memory>
#include <set>
#include <string_view>
#include <type_traits>

using namespace ps;

namespace {

constexpr const char* kMark = "fixture.source.mark";

// What an engine hands out cannot be changed through it.
using Seen = decltype(std::declval<Engine&>().particles());
static_assert(std::is_same_v<Seen, const ParticleStore&>);
static_assert(std::is_same_v<decltype(std::declval<Engine&>().solver()), const Solver&>);
static_assert(std::is_same_v<decltype(std::declval<Seen>().position()), const api::Float4*>);
static_assert(std::is_same_v<decltype(std::declval<Seen>().temperature()), const double*>);

/// Ice on a plate with the fixture's source of heat, and probes of its field.
Project scene(bool withSource = true) {
  Project project = scenes::iceOnPlate(3, 370);
  if (withSource) project.solver.heatSources.push_back({"fixture.source", {}, {}});
  project.probes.clear();
  for (const char* end : {"", "_min", "_max"}) {
    Probe probe;
    probe.id = probe.name = std::string("mark") + end;
    probe.quantity = std::string(kMark) + end;
    project.probes.push_back(probe);
  }
  return project;
}

}  // namespace

class TestParticleFields : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// Each heading has some; what is of no heading is a plugin's.
  void quantitiesHaveHeadings() {
    std::set<std::string_view> used{quantityGroups().back()};
    const ParticleFields fields;
    for (const Quantity& quantity : fields.quantities()) {
      used.insert(quantityGroup(quantity.key));
      QVERIFY2(quantityGroup(quantity.key) != quantityGroups().back(), quantity.key.c_str());
    }
    QCOMPARE(used.size(), quantityGroups().size());
    QVERIFY(quantityGroup("org.example.rust.depth_max") == quantityGroups().back());
  }

  void initTestCase() {
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/fixture_source.so",
                        m_fixtures.filePath("showing_source.so")));
    PluginRegistry::Options options;
    options.userDirectory = options.environment = false;
    options.extraPaths = {m_fixtures.path().toStdString()};
    m_plugins = std::make_unique<PluginRegistry>(options);
    QVERIFY(m_plugins->has("fixture.source"));
  }

  void everyFieldAndQuantityHasUnitAndLabel() {
    const ParticleFields fields(*m_plugins);
    std::set<std::string> names;
    for (const FieldPtr& field : fields.all()) {
      QVERIFY2(!field->label.empty() && !field->unit.empty(), field->name.c_str());
      QVERIFY2(names.insert(field->name).second, field->name.c_str());
      QVERIFY2(field->minimum <= field->maximum, field->name.c_str());
    }
    for (const Quantity& quantity : fields.quantities()) {
      QVERIFY2(!quantity.label.empty() && !quantity.unit.empty(), quantity.key.c_str());
      QCOMPARE(fields.quantity(quantity.key), &quantity);  // no key stands twice
    }
    QCOMPARE(fields.unitOf("temperature_max"), std::string("K"));
    QCOMPARE(fields.unitOf("happiness"), std::string());
    QCOMPARE(colourNames(fields).front(), std::string("material"));
  }

  /// Beside ours stands what plugins declare with a label: the thermal model's and the fixture's, nobody's bookkeeping.
  void pluginsFieldsStandBesideOurs() {
    const ParticleFields ours, all(*m_plugins);
    QVERIFY(!ours.find(kMark) && !all.find("fixture.source.own") && !all.find("joining.keeper"));
    const FieldPtr mark = all.find(kMark);
    QVERIFY(mark && all.find("specific_enthalpy"));
    QCOMPARE(mark->label, std::string("Mark of the fixture"));
    QCOMPARE(mark->unit, std::string("J/kg"));
    QVERIFY(!mark->hasScale());
    QCOMPARE(all.quantity(kMark)->label, std::string("Mean mark of the fixture"));
    QVERIFY(all.quantity(kMark)->mean && !all.quantity("fixture.source.mark_min")->mean);
    QCOMPARE(all.quantity("fixture.source.mark_max")->label, std::string("Highest mark of the fixture"));
    QVERIFY(!all.quantity("phase"));  // names have no mean
  }

  /// A snapshot carries what was asked for, as long as it is asked for; what all of them have is not there twice.
  void snapshotsCarryWhatIsAskedFor() {
    Project project = scene();
    project.view.colour = kMark;
    Engine engine(project, *m_plugins);
    engine.step();
    const auto check = [](const Snapshot& snapshot) {
      const ShownField mark(snapshot, kMark);
      QVERIFY(mark && !snapshot.id.empty());
      for (size_t i = 0; i < snapshot.id.size(); ++i) QCOMPARE(mark[i], 1e3f * static_cast<float>(snapshot.id[i]));
    };
    check(*engine.snapshot());
    QCOMPARE(engine.snapshot()->fields.size(), size_t{1});
    engine.apply(ShowFields{{"temperature", kMark, "density", "no.such.field", "thesis_latent.melting"}});
    const SnapshotPtr more = engine.snapshot();
    check(*more);
    QCOMPARE(more->fields.size(), size_t{2});  // and not of a model that the scene does not use
    QVERIFY(ShownField(*more, "temperature") && !ShownField(*more, "thesis_latent.melting"));
    QVERIFY(std::abs(ShownField(*more, "density")[0] - 917) < 10);  // of ice
    engine.reset();
    engine.step();
    check(*engine.snapshot());
    engine.show({});
    QVERIFY(engine.snapshot()->fields.empty());
  }

  void statesGoOnWithWhatIsShown() {
    Engine engine(scene(), *m_plugins);
    engine.show({kMark});
    engine.step();
    StateBuffer buffer;
    saveTo(buffer, engine);
    engine.restore(StateReader(buffer.bytes()));
    QVERIFY(ShownField(*engine.snapshot(), kMark));
  }

  /// All 27 particles weigh the same: ids 0 to 26, 1 kJ/kg each.
  void probesMeasureAPluginsField() {
    Engine engine(scene(), *m_plugins);
    QCOMPARE(engine.probeNames()[2], std::string("mark_max.fixture.source.mark_max[J/kg]"));
    engine.step();
    const std::vector<double> values = engine.stats().probes;
    QVERIFY2(std::abs(values[0] - 13e3) < 1e-6 * 13e3, qPrintable(QString::number(values[0])));
    QCOMPARE(values[1], 0.0);
    QCOMPARE(values[2], 26e3);
    Engine without(scene(false), *m_plugins);
    without.step();
    for (const double value : without.stats().probes) QVERIFY(std::isnan(value));  // nothing keeps it
  }

  /// The mean of the thermal model's own field is the energy over the mass.
  void enthalpyIsWhatTheModelKeeps() {
    Project project = scenes::iceOnPlate(3, 370);
    for (const char* quantity : {"specific_enthalpy", "thermal_energy", "mass"}) {
      Probe probe;
      probe.id = probe.name = probe.quantity = quantity;
      project.probes.push_back(probe);
    }
    Engine engine(project, *m_plugins);
    for (int frame = 0; frame < 10; ++frame) engine.step();
    const std::vector<double> p = engine.stats().probes;
    QVERIFY(std::abs(p[1] - p[2] / p[3]) <= 1e-9 * std::abs(p[1]));
  }

  void slipsAreRefused_data() {
    QTest::addColumn<QString>("colour");
    QTest::addColumn<QString>("quantity");
    QTest::addColumn<bool>("refused");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, const char* colour, const char* quantity, bool refused, const char* says) {
      QTest::newRow(name) << colour << quantity << refused << says;
    };
    row("ours", "gas_fraction", "density_max", false, "");
    row("a plugin's", kMark, "fixture.source.mark_min", false, "");
    row("a slip", "temperatur", "mass", true, "/view/colour: must be one of material, temperature, ");
    row("its word", "temperatur", "mass", true, "not 'temperatur' (did you mean 'temperature'?)");
    row("a probe's slip", "speed", "sped_max", true, "not 'sped_max' (did you mean 'speed_max'?)");
    row("of a plugin that is not here", "org.example.rust.depth", "mass", false,
        "/view/colour: no installed plugin has a field for 'org.example.rust.depth'");
    row("probe of one", "speed", "org.example.rust.depth_max", false, "the probe measures nothing");
    row("nearly one that is", "fixture.source.marc", "mass", false, "(did you mean 'fixture.source.mark'?)");
  }
  void slipsAreRefused() {
    QFETCH(QString, colour);
    QFETCH(QString, quantity);
    QFETCH(bool, refused);
    QFETCH(QString, says);
    Project project = scene();
    project.view.colour = colour.toStdString();
    project.probes.resize(1);
    project.probes[0].quantity = quantity.toStdString();
    QString told;
    try {
      const LoadedProject loaded = parseProject(writeProject(project), "scene.json", *m_plugins);
      QVERIFY(!refused);
      QCOMPARE(loaded.project.view.colour, colour.toStdString());
      for (const ProjectMessage& warning : loaded.warnings) told += QString::fromStdString(warning.text);
      QCOMPARE(told.isEmpty(), says.isEmpty());
    } catch (const InputError& error) {
      told = error.what();
      QVERIFY2(refused, error.what());
    }
    QVERIFY2(told.contains(says), qPrintable(told));
  }

 private:
  QTemporaryDir m_fixtures;
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_APPLESS_MAIN(TestParticleFields)
#include "tst_particlefields.moc"
