// SPDX-License-Identifier: Apache-2.0
// What a project says about the start of an experiment, and what its probes read.
#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/measure.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

using namespace ps;

class TstExperiments : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aProbeOfEveryQuantity();
  void aProbeSeesItsRegionAndItsWave();
  void aBodyStartsAsItsFieldsSay();
  void disorderHangsOnTheSeedAlone();
  void bodiesAreHeatedByTheirPower();
  void coolingEndsAboveZero();

 private:
  PluginRegistry m_plugins;
};

/// Five particles with numbers that floats hold exactly, so that nothing is lost to rounding.
void TstExperiments::aProbeOfEveryQuantity() {
  Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(scenes::water());
  Body row = scenes::block("row", 1, 0.03, {0, 0, 0}, 300);
  std::get<BoxShape>(row.shape).size = {0.15, 0.03, 0.03};
  project.bodies.push_back(row);
  project.solver.parameters.values["particle_spacing"] = 0.03;
  Engine engine(project, m_plugins);
  ParticleStore& store = tests::solverOf(engine).particles();
  QCOMPARE(store.size(), size_t{5});
  const float mass[] = {1, 2, 3, 4, 6}, height[] = {0.5f, 0.25f, 1, 0.125f, 2};
  const float velocity[][2] = {{3, 4}, {0, 0}, {1, 0}, {0, 2}, {6, 8}};
  const float excess[] = {0.5f, -0.25f, 0.25f, 0, 0.125f};
  const double temperature[] = {280, 300, 320, 350, 400};
  const float solid[] = {1, 0.5f, 0, 0, 0}, liquid[] = {0, 0.5f, 1, 0.25f, 0}, gas[] = {0, 0, 0, 0.75f, 1};
  for (size_t i = 0; i < 5; ++i) {
    store.mass()[i] = mass[i];
    store.position()[i] = {static_cast<float>(i), height[i], 0.25f, store.position()[i].w};
    store.densityError()[i] = excess[i];
    store.velocity()[i] = {velocity[i][0], velocity[i][1], 0, store.velocity()[i].w};
    store.temperature()[i] = temperature[i];
    store.phase()[i] = static_cast<api::Phase>(i);
    store.solidFraction()[i] = solid[i], store.liquidFraction()[i] = liquid[i], store.gasFraction()[i] = gas[i];
  }
  const double energy = engine.solver().thermalEnergy();
  QVERIFY(energy != 0);
  const double volume = double{store.position()[0].w};
  const std::map<std::string, double> expected = {
      {"temperature", 352.5},  // (280 + 2 300 + 3 320 + 4 350 + 6 400) / 16
      {"temperature_min", 280},
      {"temperature_max", 400},
      {"mass", 16},
      {"count", 5},
      {"pieces", 0},  // nothing is tied
      {"solid_mass", 1},
      {"melting_mass", 2},
      {"liquid_mass", 3},
      {"boiling_mass", 4},
      {"gas_mass", 6},
      {"solid_fraction", 0.125},    // (1 + 2 0.5) / 16
      {"liquid_fraction", 0.3125},  // (2 0.5 + 3 + 4 0.25) / 16
      {"gas_fraction", 0.5625},     // (4 0.75 + 6) / 16
      {"speed", 4.75},              // (5 + 0 + 3 1 + 4 2 + 6 10) / 16
      {"speed_min", 0},
      {"speed_max", 10},
      {"solid_fraction_min", 0},
      {"solid_fraction_max", 1},
      {"liquid_fraction_min", 0},
      {"liquid_fraction_max", 1},
      {"gas_fraction_min", 0},
      {"gas_fraction_max", 1},
      {"density_error", 0.09375},  // (0.5 - 2 0.25 + 3 0.25 + 6 0.125) / 16
      {"density_error_min", -0.25},
      {"density_error_max", 0.5},
      {"density", 4.515625 / volume},  // (1.5 + 4 0.75 + 9 1.25 + 16 + 36 1.125) / 16
      {"density_min", 1.5 / volume},
      {"density_max", 6.75 / volume},
      {"pressure", 0},  // no frame has passed
      {"pressure_min", 0},
      {"pressure_max", 0},
      {"force_x", NAN},
      {"force_y", NAN},
      {"force_z", NAN},
      {"torque_x", NAN},
      {"torque_y", NAN},
      {"torque_z", NAN},
      {"height", 1.03125},  // (0.5 + 2 0.25 + 3 1 + 4 0.125 + 6 2) / 16
      {"height_max", 2},
      {"thermal_energy", energy},
      {"kinetic_energy", 322},  // (25 + 3 1 + 4 4 + 6 100) / 2
      {"compression", 0.125},   // (0.5 + 3 0.25 + 6 0.125) / 16: what is thin does not count
      {"compression_max", 0.5},
      {"gap", std::numeric_limits<double>::quiet_NaN()},  // there is no other body
      {"outside", 2},                                     // below 0.3
      {"position_x", 2.75},                               // (2 1 + 3 2 + 4 3 + 6 4) / 16
      {"position_x_min", 0},
      {"position_x_max", 4},
      {"extent_x", 4},
      {"front_x", 2.25},      // of the third, and half a spacing
      {"velocity_x", 2.625},  // (3 + 3 1 + 6 6) / 16
      {"velocity_x_min", 0},
      {"velocity_x_max", 6},
      {"momentum_x", 42},
      {"angular_momentum_x", -15},  // sum m (y vz - z vy): all at z = 0.25, none moves along z
      {"spin_x", 0},
      {"position_y", 1.03125},
      {"position_y_min", 0.125},
      {"position_y_max", 2},
      {"extent_y", 1.875},
      {"front_y", 0.75},
      {"velocity_y", 3.75},  // (4 + 4 2 + 6 8) / 16
      {"velocity_y_min", 0},
      {"velocity_y_max", 8},
      {"momentum_y", 60},
      {"angular_momentum_y", 10.5},  // sum m (z vx - x vz)
      {"spin_y", 0},
      {"position_z", 0.25},
      {"position_z_min", 0.25},
      {"position_z_max", 0.25},
      {"extent_z", 0},
      {"front_z", 0.5},
      {"velocity_z", 0},
      {"velocity_z_min", 0},
      {"velocity_z_max", 0},
      {"momentum_z", 0},
      {"angular_momentum_z", 139.5},    // 17.8125 about the centre, and 16 (2.75 3.75 - 1.03125 2.625) of the centre
      {"spin_z", 17.8125 / 35.421875},  // sum m (rx vy - ry vx) over sum m (rx^2 + ry^2)
  };
  ps::Wall wall;
  wall.offset = 0.3;
  const ParticleFields ours;
  const ProbeView view{engine.solver(), engine.bodyIds(), ours, {wall}, 0.5};
  for (const std::string& quantity : ours.quantityNames()) {
    QVERIFY2(expected.contains(quantity), quantity.c_str());
    Probe probe;
    probe.quantity = quantity;
    probe.body = "row";
    const double value = measureProbe(view, probe);
    if (std::isnan(expected.at(quantity))) {
      QVERIFY2(std::isnan(value), quantity.c_str());
      continue;
    }
    // All sums are exact but the energy's, which may be added up in another order, and what is over a volume.
    const bool exact = quantity != "thermal_energy" && !quantity.starts_with("density");
    QVERIFY2(std::abs(value - expected.at(quantity)) <= (exact ? 0 : 1e-12 * std::abs(expected.at(quantity))),
             (quantity + ": " + std::to_string(value)).c_str());
  }
}

void TstExperiments::aProbeSeesItsRegionAndItsWave() {
  Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(scenes::water());
  project.environment.gravity = {0, 0, 0};
  Body row = scenes::block("row", 1, 0.05, {0.4, 0, 0}, 300);
  std::get<BoxShape>(row.shape).size = {0.8, 0.05, 0.05};
  row.velocity = {0.3, 0, 0};
  row.velocityWave = Wave{0, 0.8, 0.5, {0, 0.25, 0}, {}};
  project.bodies.push_back(row);
  project.solver.parameters.values["particle_spacing"] = 0.05;
  Probe probe;
  probe.id = probe.name = "p";
  probe.quantity = "velocity_y";
  probe.wave = Wave{0, 0.8, 0.5, {}, {}};
  project.probes.push_back(probe);
  probe.wave->phase += 3.14159265358979 / 2;
  project.probes.push_back(probe);
  probe.wave.reset();
  probe.quantity = "count";
  probe.region = Region{{0.1, -1, -1}, {0.2, 1, 1}, {}};
  project.probes.push_back(probe);
  probe.region = Region{{0, -1, -1}, {0.4, 1, 1}, {}};
  probe.regionWhen = Probe::kNow;
  project.probes.push_back(probe);
  probe.regionWhen = Probe::kAtStart;
  Body other = scenes::block("other", 1, 0.05, {0.825, 0.3, 0.4}, 300);  // beside the last, at 0.775
  other.parameters.values["fixed"] = true;
  project.bodies.push_back(other);
  probe.region.reset();
  probe.quantity = "gap";
  probe.body = "row";
  project.probes.push_back(probe);
  Engine engine(project, m_plugins);
  const std::vector<double> values = engine.stats().probes;
  QCOMPARE(values[3], 8.0);
  QVERIFY2(std::abs(values[4] - std::sqrt(0.05 * 0.05 + 0.3 * 0.3 + 0.4 * 0.4)) < 1e-6,
           qPrintable(QString::number(values[4])));
  QVERIFY2(std::abs(values[0] - 0.25) < 1e-6, qPrintable(QString::number(values[0])));
  QVERIFY(std::abs(values[1]) < 1e-6);  // a quarter of a wave off
  QCOMPARE(values[2], 2.0);
  for (int i = 0; i < 60; ++i) engine.step();
  QCOMPARE(engine.stats().probes[2], 2.0);  // they have left, and are still the same
  QCOMPARE(engine.stats().probes[3], 2.0);  // what is in it now: at 0.325 and 0.375 m
  probe.quantity = "mass";
  probe.body = "other";
  const ProbeView view{engine.solver(), engine.bodyIds(), engine.fields()};
  const double held = measureProbe(view, probe);  // of a body that is fixed
  QVERIFY(held > 0);
  probe.body.clear();
  const double moving = measureProbe(view, probe);
  probe.fixed = true;  // then it sees what is held in place as well
  QVERIFY(std::abs(measureProbe(view, probe) - moving - held) < 1e-6 * held);
}

void TstExperiments::aBodyStartsAsItsFieldsSay() {
  Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(scenes::water());
  project.environment.gravity = {0, 0, 0};
  Body block = scenes::block("block", 4, 0.05, {0.5, 0.5, 0}, 270);
  block.velocity = {1, 0, 0};
  block.spin = {0, 0, 2};
  block.temperatureGradient = {0, 100, 0};
  block.pins.push_back({{-1, 0.55, -1}, {1, 1, 1}, {}});
  project.bodies.push_back(block);
  project.solver.parameters.values["particle_spacing"] = 0.05;
  Engine engine(project, m_plugins);
  const ParticleStore& store = engine.solver().particles();
  QCOMPARE(store.size(), size_t{64});
  size_t held = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    const double x = double{store.position()[i].x} - 0.5, y = double{store.position()[i].y} - 0.5;
    QVERIFY(std::abs(store.temperature()[i] - (270 + 100 * y)) < 1e-4);
    QCOMPARE(store.phase()[i] == api::Phase::Solid, y < 0.03);  // melts at 273.15
    const bool pinned = y > 0.05;
    held += pinned;
    QCOMPARE(store.motion()[i] == api::Motion::Static, pinned);
    if (pinned) continue;
    QVERIFY(std::abs(store.velocity()[i].x - (1 - 2 * y)) < 1e-6 && std::abs(store.velocity()[i].y - 2 * x) < 1e-6);
  }
  QCOMPARE(held, size_t{16});
  block.temperatureGradient = {0, -1e5, 0};
  project.bodies[0] = block;
  QVERIFY_THROWS_EXCEPTION(InputError, Engine(project, m_plugins));  // below absolute zero
}

void TstExperiments::disorderHangsOnTheSeedAlone() {
  const auto places = [&](double jitter, double seed) {
    Project project;
    project.solver.thermalModel = "enthalpy";
    project.materials.push_back(scenes::water());
    project.bodies.push_back(scenes::block("block", 6, 0.05, {0, 0, 0}, 300));
    project.bodies[0].parameters.values = {{"jitter", jitter}, {"seed", seed}};
    project.solver.parameters.values["particle_spacing"] = 0.05;
    Engine engine(project, m_plugins);
    return engine.snapshot()->position;
  };
  const auto still = places(0, 1), one = places(0.2, 1), again = places(0.2, 1), two = places(0.2, 2);
  double sum = 0, most = 0, other = 0;
  for (size_t i = 0; i < still.size(); ++i) {
    QCOMPARE(one[i].x, again[i].x);
    const double off = (double{one[i].x} - still[i].x) / 0.05;
    sum += off / static_cast<double>(still.size());
    most = std::max(most, std::abs(off));
    other = std::max(other, std::abs(double{one[i].y} - two[i].y));
  }
  QVERIFY(most < 0.2001 && most > 0.18);
  QVERIFY2(std::abs(sum) < 0.03, qPrintable(QString::number(sum)));  // 0.2/sqrt(3)/sqrt(216) is 0.008
  QVERIFY(other > 0.005);
}

namespace {

/// Two blocks of water far apart, held in place, of which the first is heated with 100 W and the second cooled with
/// 40 W; heat runs ten times as fast as motion, 0.1 s a frame.
Project twoHeated() {
  Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(scenes::water());
  for (const char* id : {"one", "two"}) {
    Body block = scenes::block(id, 3, 0.02, {id[0] == 'o' ? 0.0 : 0.5, 0, 0}, 293.15);
    block.parameters.values = {
        {"fixed", true}, {"temperature", 293.15}, {"heating_power", id[0] == 'o' ? 100.0 : -40.0}};
    project.bodies.push_back(block);
    Probe probe;
    probe.id = probe.name = probe.body = id;
    probe.quantity = "thermal_energy";
    probe.fixed = true;
    project.probes.push_back(probe);
  }
  project.environment.parameters.values["air_convection"] = 0.0;
  project.solver.parameters.values = {{"particle_spacing", 0.02}, {"thermal_time_scale", 10.0}, {"dt", 0.01}};
  return project;
}

}  // namespace

void TstExperiments::bodiesAreHeatedByTheirPower() {
  Engine engine(twoHeated(), m_plugins);
  std::vector<double> before = engine.stats().probes;
  const auto gained = [&](int frames) {
    for (int k = 0; k < frames; ++k) engine.step();
    const std::vector<double> after = engine.stats().probes;
    const QList<double> change{after[0] - before[0], after[1] - before[1]};
    before = after;
    return change;
  };
  const auto near = [](double a, double b) { return std::abs(a - b) < 1e-6; };  // J of 7e4: rounding is 1e-11
  QList<double> change = gained(5);
  QVERIFY2(near(change[0], 50) && near(change[1], -20), qPrintable(QString::number(change[0])));
  QVERIFY(near(engine.solver().heatLedger().heaters, 30) && near(engine.solver().heatLedger().exchanged, 70));
  const ParticleStore& store = engine.solver().particles();
  for (size_t i = 1; i < store.size(); ++i) {  // evenly
    if (store.body()[i] == store.body()[0]) QVERIFY(std::abs(store.temperature()[i] - store.temperature()[0]) < 1e-9);
  }
  QVERIFY(engine.setParameter({Owner::Body, "one", "heating_power"}, 500.0));  // at once
  change = gained(1);
  QVERIFY(near(change[0], 50) && near(change[1], -4));
  // What is left takes it all.
  std::vector<uint32_t> some;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] == 0 && some.size() < 20) some.push_back(store.id()[i]);
  }
  engine.extractParticles(some);
  before = engine.stats().probes;
  change = gained(1);
  QVERIFY2(near(change[0], 50), qPrintable(QString::number(change[0])));
  Project without = engine.project();
  without.bodies.erase(without.bodies.begin());  // has left the document: matter that lingers is not heated
  engine.update(without);
  change = gained(1);
  QVERIFY(near(change[0], 0) && near(change[1], -4));
}

void TstExperiments::coolingEndsAboveZero() {
  Project project = twoHeated();
  project.bodies[1].parameters.values["heating_power"] = -1e7;
  Engine engine(project, m_plugins);
  for (int k = 0; k < 60; ++k) QCOMPARE(engine.step().flags, StepFlags{0});
  const ParticleStore& store = engine.solver().particles();
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] == 1)
      QVERIFY2(store.temperature()[i] >= 1 - 1e-9 && store.temperature()[i] < 2,
               qPrintable(QString::number(store.temperature()[i])));
  }
}

QTEST_GUILESS_MAIN(TstExperiments)
#include "tst_experiments.moc"
