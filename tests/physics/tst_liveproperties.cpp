// SPDX-License-Identifier: Apache-2.0
// Properties of materials that change while matter of them is there: it keeps its temperature and what of it has melted
// or boiled, the energy is booked, and no value that a slider has, or that may be typed, makes what cannot be.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <optional>
#include <vector>

using namespace ps;

namespace {

constexpr double kSpacing = 0.02;

/// A sanitizer makes a frame many times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kFrames = 1;
#else
constexpr int kFrames = 4;
#endif

Body cube(const char* id, const std::string& material, Vector3 center, double temperature) {
  Body body;
  body.id = body.name = id;
  body.material = material;
  body.shape = BoxShape{center, {3 * kSpacing, 3 * kSpacing, 3 * kSpacing}};
  body.parameters.values["temperature"] = temperature;
  return body;
}

/// Matter far below where it melts, where it does, and far above, between walls that heat and that cool at the ends of
/// their ranges.
Project between(const std::string& material, double timeScale = 1000) {
  Project project;
  project.solver.thermalModel = scenes::kThermalModel;
  project.environment = scenes::tray(0.2, 0.4);
  project.environment.parameters.values["radiation"] = true;
  project.environment.parameters.values["air_convection"] = 10.0;
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  project.solver.parameters.values["thermal_time_scale"] = timeScale;
  const auto wall = [&](size_t k, const char* heat, const char* key, double value) {
    project.environment.walls[k].parameters.values["heat"] = std::string(heat);
    project.environment.walls[k].parameters.values[key] = value;
  };
  wall(0, "fixed_temperature", "temperature", 700);
  wall(2, "fixed_flux", "heat_flux", -60000);
  wall(3, "fixed_temperature", "temperature", 150);
  SceneMaterial used;
  used.id = used.base = used.label = material;
  project.materials.push_back(used);
  project.bodies.push_back(cube("cold", material, {-0.16, 0.03, 0}, 180));
  project.bodies.push_back(cube("mild", material, {-0.09, 0.03, 0}, 290));
  project.bodies.push_back(cube("warm", material, {0.08, 0.03, 0}, 420));
  project.bodies.push_back(cube("hot", material, {0.16, 0.03, 0}, 1200));
  project.bodies[1].parameters.values["heating_power"] = -500.0;
  return project;
}

std::shared_ptr<const SceneMesh> cubeMesh() {
  SceneMesh mesh;
  mesh.id = mesh.name = "cube";
  for (int k = 0; k < 8; ++k) {
    const auto side = [&](int axis) { return (k >> axis & 1) != 0 ? 0.5f : -0.5f; };
    mesh.points.push_back({side(0), side(1), side(2)});
  }
  for (const std::array<uint32_t, 4>& face : std::initializer_list<std::array<uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({face[0], face[1], face[2]});
    mesh.triangles.push_back({face[0], face[2], face[3]});
  }
  return std::make_shared<const SceneMesh>(std::move(mesh));
}

/// Properties that the heat of a material depends on.
std::vector<const api::ParameterDeclaration*> thermalProperties() {
  std::vector<const api::ParameterDeclaration*> list;
  const api::ParameterList catalogue = propertyCatalogue();
  for (size_t k = 0; k < catalogue.count; ++k) {
    const std::string_view group = catalogue[k].group, key = catalogue[k].key;
    if (group == "Heat" || group == "Phase change" || key == "emissivity" || key.starts_with("density_"))
      list.push_back(&catalogue[k]);
  }
  return list;
}

/// "" or the first thing that cannot be.
QString impossible(const Engine& engine) {
  const ParticleStore& p = engine.particles();
  for (size_t i = 0; i < p.size(); ++i) {
    const double t = p.temperature()[i];
    const double shares[] = {p.solidFraction()[i], p.liquidFraction()[i], p.gasFraction()[i]};
    const bool sound = std::all_of(std::begin(shares), std::end(shares), [](double s) { return s >= 0 && s <= 1; });
    if (t >= 0.999 && t < 1e5 && sound) continue;
    return QStringLiteral("%1 K, shares %2 %3 %4").arg(t).arg(shares[0]).arg(shares[1]).arg(shares[2]);
  }
  return {};
}

QString runFor(Engine& engine, int frames) {
  for (int f = 0; f < frames; ++f) {
    const StepReport report = engine.step();
    if ((report.flags & ~static_cast<StepFlags>(StepFlag::Diverged)) != 0)
      return QString::fromStdString(report.message);
    if (const QString found = impossible(engine); !found.isEmpty()) return found;
  }
  return {};
}

/// J that the books miss.
double openEnergy(const Engine& engine, double before) {
  return std::abs(engine.solver().thermalEnergy() - engine.solver().heatLedger().net() - before);
}

}  // namespace

class TestLiveProperties : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void init() { m_plugins = std::make_unique<PluginRegistry>(); }  // one that fails in a test is there in the next

  void whatSlidersPermitIsSafe_data() {
    QTest::addColumn<QString>("material");
    QTest::addColumn<QString>("model");
    for (const std::string& id : PluginRegistry().ids(PluginKind::Material))
      QTest::addRow("%s", id.c_str()) << QString::fromStdString(id) << "enthalpy";
    for (const char* model : {"thesis_latent", "thesis_diffusion"}) QTest::addRow("%s", model) << "water" << model;
  }
  void whatSlidersPermitIsSafe() {
    QFETCH(QString, material);
    QFETCH(QString, model);
    const std::string id = material.toStdString();
    Project project = between(id);
    project.solver.thermalModel = model.toStdString();
    Engine engine(project, *m_plugins);
    QCOMPARE(runFor(engine, 2), QString());
    int changes = 0;
    for (const api::ParameterDeclaration* property : thermalProperties()) {
      const Address address{Owner::Material, id, property->key};
      const Value before = valueAt(project, m_plugins.get(), address);
      for (const double end : {property->minimum, property->maximum, property->hardMinimum, 42.0}) {
        const Value value = property->kind == api::ParameterKind::Toggle ? Value(end > 0) : Value(end);
        if (!problemWith(project, m_plugins.get(), address, value).empty()) continue;
        try {
          engine.setParameter(address, value);
        } catch (const InputError&) {
          continue;
        }
        ++changes;
        const QString what = runFor(engine, kFrames);
        QVERIFY2(what.isEmpty(), qPrintable(QStringLiteral("%1 = %2: %3").arg(property->key).arg(end).arg(what)));
      }
      engine.setParameter(address, before);
      const QString what = runFor(engine, 1);
      QVERIFY2(what.isEmpty(), qPrintable(QStringLiteral("%1 back: %2").arg(property->key, what)));
    }
    QVERIFY2(changes > 20, qPrintable(QString::number(changes)));
  }

  /// Heat capacities and latent heats, which move no point of balance: all matter is as warm as before, and as molten.
  void matterStaysAsWarmAsItWas_data() {
    QTest::addColumn<QString>("key");
    QTest::addColumn<double>("value");
    QTest::newRow("solid") << "heat_capacity_solid" << 100.0;
    QTest::newRow("solid, typed") << "heat_capacity_solid" << 42.0;
    QTest::newRow("liquid") << "heat_capacity_liquid" << 5000.0;
    QTest::newRow("vapour") << "heat_capacity_gas" << 100.0;
    QTest::newRow("melting") << "latent_heat_fusion" << 1e6;
    QTest::newRow("boiling") << "latent_heat_vaporization" << 1e7;
  }
  void matterStaysAsWarmAsItWas() {
    QFETCH(QString, key);
    QFETCH(double, value);
    Engine engine(slushAndSteam(), *m_plugins);
    QCOMPARE(runFor(engine, 5), QString());
    const Shares before = sharesOf(engine);
    const double books = openEnergy(engine, 0), sources = engine.solver().heatLedger().sources;
    const Address address{Owner::Material, "water", key.toStdString()};
    const Value back = valueAt(engine.project(), m_plugins.get(), address);
    QVERIFY(engine.setParameter(address, value));
    compare(sharesOf(engine), before);
    QVERIFY(openEnergy(engine, books) < 1e-9 * std::abs(engine.solver().thermalEnergy()) + 1e-6);
    QVERIFY(engine.solver().heatLedger().sources != sources);
    engine.setParameter(address, back);
    compare(sharesOf(engine), before);
    QCOMPARE(runFor(engine, 5), QString());
  }

  /// "Held in place" acts at the next reset, and so does all that hangs on it: until then matter that was made held
  /// keeps its temperature when the switch is off, and what was made free warms when it is on.
  void whatIsHeldStaysHeldUntilTheReset_data() {
    QTest::addColumn<bool>("held");
    QTest::newRow("switched off") << true;
    QTest::newRow("switched on") << false;
  }
  void whatIsHeldStaysHeldUntilTheReset() {
    QFETCH(bool, held);
    Project project = between("iron");
    ParameterSet& mild = project.bodies[1].parameters;
    mild.values["heating_power"] = 0.0;
    mild.values["fixed"] = held;
    mild.values["heat"] = std::string("fixed_temperature");
    mild.values["held_temperature"] = 290.0;
    Engine engine(project, *m_plugins);
    const auto isBath = [&] {
      const ParticleStore& store = engine.particles();
      for (size_t i = 0; i < store.size(); ++i) {
        const bool fixed = store.motion()[i] == api::Motion::Static;
        if (store.body()[i] == 1 && (!fixed || std::abs(double{store.temperature()[i]} - 290) > 1e-3)) return false;
      }
      return true;
    };
    QCOMPARE(runFor(engine, 3), QString());
    QCOMPARE(isBath(), held);
    QVERIFY(!engine.setParameter({Owner::Body, "mild", "fixed"}, !held));  // not yet
    QCOMPARE(runFor(engine, 3), QString());
    QCOMPARE(isBath(), held);
    engine.reset();
    QCOMPARE(runFor(engine, 3), QString());
    QCOMPARE(isBath(), !held);
  }

  /// A fluid behind a fixed body: how fast it is, and how warm, acts at the next frame. Without one nothing gets
  /// through.
  void aFluidBehindABodyActsAtOnce() {
    Project project = between("iron", 1);
    project.environment = scenes::tray(0.2, 0.4);
    project.environment.parameters.values["air_convection"] = 0.0;
    project.bodies.resize(2);
    project.bodies[0] = cube("cold", "iron", {-0.09 - 3 * kSpacing, 0.03, 0}, 180);  // beside the other
    for (Body& body : project.bodies) body.parameters.values["fixed"] = true;
    ParameterSet& jacket = project.bodies[1].parameters;
    jacket.values["heating_power"] = 0.0;
    jacket.values["heat"] = std::string("convective");
    jacket.values["held_temperature"] = 290.0;
    jacket.values["convection"] = 0.0;
    Engine engine(project, *m_plugins);
    auto given = [&, last = 0.0]() mutable {
      const double now = engine.solver().heatLedger().heaters;
      return now - std::exchange(last, now);
    };
    QCOMPARE(runFor(engine, 3), QString());
    QVERIFY(std::abs(given()) < 1e-9);
    QVERIFY(engine.setParameter({Owner::Body, "mild", "convection"}, 100.0));
    QCOMPARE(runFor(engine, 1), QString());
    const double slow = given();
    QVERIFY(slow > 0);
    QVERIFY(engine.setParameter({Owner::Body, "mild", "convection"}, 200.0));
    QCOMPARE(runFor(engine, 1), QString());
    const double fast = given();
    qInfo("%.4f times as much", fast / slow);
    QVERIFY(fast > 1.5 * slow && fast < 2 * slow);  // the half spacing of iron resists too
    QVERIFY(engine.setParameter({Owner::Body, "mild", "held_temperature"}, 100.0));
    QCOMPARE(runFor(engine, 1), QString());
    given();  // the body itself has become as cold
    QCOMPARE(runFor(engine, 1), QString());
    QVERIFY(given() < 0);
  }

  /// A wall of a mesh's surface around a block that fills it gives flux x area of the mesh x time, whichever way it
  /// stands: 1 %, of which its corners are most. What the row says acts at the next frame.
  void aMeshGivesItsFlux_data() {
    QTest::addColumn<double>("turned");
    QTest::newRow("along the lattice") << 0.0;
    QTest::newRow("turned") << 30.0;
  }
  void aMeshGivesItsFlux() {
    QFETCH(double, turned);
    constexpr double kEdge = 0.24, kFlux = 3000;
    Project project = between("iron", 1);
    project.environment = scenes::tray(0.5, 0.6);
    project.environment.parameters.values["air_convection"] = 0.0;
    project.bodies.resize(1);
    Body& block = project.bodies[0];
    SolidShape filled;
    filled.parameters.values = {
        {"kind", std::string("block")}, {"size_x", kEdge}, {"size_y", kEdge}, {"size_z", kEdge}, {"position_y", 0.3},
        {"rotation_z", turned}};
    block.shape = filled;
    block.parameters.values["fixed"] = true;
    project.meshes = {cubeMesh()};
    Body tank = block;
    tank.id = tank.name = "tank";
    SolidShape surface = filled;
    surface.meshId = project.meshes[0]->id, surface.mesh = project.meshes[0];
    surface.parameters.values["kind"] = std::string("mesh");
    surface.parameters.values["inside"] = std::string("hollow");
    tank.shape = surface;
    tank.parameters.values["heat"] = std::string("fixed_flux");
    tank.parameters.values["heat_flux"] = kFlux;
    project.bodies.push_back(tank);
    Engine engine(project, *m_plugins);
    auto given = [&, last = 0.0]() mutable {
      const double now = engine.solver().heatLedger().heaters;
      return now - std::exchange(last, now);
    };
    const double energy = engine.solver().thermalEnergy();
    QCOMPARE(runFor(engine, 6), QString());
    const double seconds = engine.solver().thermalTime(), heat = given();
    const double share = heat / (kFlux * 6 * kEdge * kEdge * seconds);
    qInfo("%.4f of the heat", share);
    QVERIFY(std::abs(share - 1) < 0.01);
    QVERIFY(std::abs(engine.solver().thermalEnergy() - energy - heat) < 1e-9 * std::abs(energy));
    QVERIFY(engine.setParameter({Owner::Body, "tank", "heat_flux"}, -2 * kFlux));
    QCOMPARE(runFor(engine, 6), QString());
    // As a difference of what all of the block holds, a million times as much: to the rounding of that.
    QVERIFY(std::abs(given() + 2 * heat) < 1e-8 * heat);
  }

  /// What is not of the edited material is not touched, to the bit.
  void otherMatterIsLeftAlone() {
    Project project = slushAndSteam();
    SceneMaterial iron;
    iron.id = iron.base = iron.label = "iron";
    project.materials.push_back(iron);
    Engine engine(project, *m_plugins);
    QCOMPARE(runFor(engine, 5), QString());
    const auto enthalpies = [&] {
      (void)engine.limits();
      const auto* h = static_cast<const double*>(engine.particles().read("specific_enthalpy", api::FieldType::Float64));
      return std::vector(h, h + engine.particles().size());
    };
    const std::vector<double> before = enthalpies();
    QVERIFY(engine.setParameter({Owner::Material, "iron", "heat_capacity_solid"}, 42.0));
    QCOMPARE(enthalpies(), before);
  }

  /// Pressure moves the points of balance alone: matter keeps its energy, and boils by its own heat.
  void pressureKeepsTheEnergy() {
    Engine engine(slushAndSteam(), *m_plugins);
    QCOMPARE(runFor(engine, 5), QString());
    const double energy = engine.solver().thermalEnergy();
    QVERIFY(engine.setParameter({Owner::Environment, "", "ambient_pressure"}, 20000.0));
    QCOMPARE(engine.solver().thermalEnergy(), energy);
  }

  /// A state that was saved before the edit is restored after it: it is of the temperatures that it was.
  void savedStatesAreCountedAnew() {
    Engine engine(slushAndSteam(), *m_plugins);
    QCOMPARE(runFor(engine, 5), QString());
    StateBuffer saved;
    saveTo(saved, engine);
    const Shares before = sharesOf(engine);
    const Address address{Owner::Material, "water", "heat_capacity_solid"};
    QVERIFY(engine.setParameter(address, 42.0));
    engine.restore(StateReader(saved.bytes()));
    compare(sharesOf(engine), before);
    QCOMPARE(runFor(engine, 5), QString());
  }

  /// The other model takes over matter as molten as it is, not half molten.
  void modelsHandOverWhatHasMelted() {
    Engine engine(slushAndSteam(), *m_plugins);
    QCOMPARE(runFor(engine, 5), QString());
    const Shares before = sharesOf(engine);
    Project project = engine.project();
    for (const char* model : {"thesis_latent", "enthalpy"}) {
      project.solver.thermalModel = model;
      engine.update(project);
      compare(sharesOf(engine), before);
    }
  }

  /// Walls and bodies that cool stop at 1 K, together too.
  void nothingCoolsBelowOneKelvin() {
    Project project = between("iron", 1e5);
    for (SceneWall& wall : project.environment.walls) {
      wall.parameters.values["heat"] = std::string("fixed_flux");
      wall.parameters.values["heat_flux"] = -60000.0;
    }
    for (Body& body : project.bodies) body.parameters.values["heating_power"] = -1e5;
    Engine engine(project, *m_plugins);
    QCOMPARE(runFor(engine, 30), QString());
    const ParticleStore& p = engine.particles();
    const double warmest = *std::max_element(p.temperature(), p.temperature() + p.size());
    QVERIFY2(warmest < 20, qPrintable(QString::number(warmest)));
  }

  /// Steps of five times the stable one are an experiment that may be asked for: what comes of it is told, not stopped.
  void overshootingTemperaturesAreTold() {
    Project project = between("iron", 1e4);
    project.solver.parameters.values["thermal_cfl"] = 5.0;
    project.solver.parameters.values["heat_steps"] = std::string("explicit");
    Engine engine(project, *m_plugins);
    for (int f = 0; f < 20 && impossible(engine).isEmpty(); ++f) engine.step();
    QVERIFY(!impossible(engine).isEmpty());
    const std::vector<Limit> limits = engine.limits();
    QVERIFY(std::any_of(limits.begin(), limits.end(),
                        [](const Limit& limit) { return limit.what == "solver.thermal_cfl" && limit.asked == 5; }));
  }

  /// A law that turns negative where there is matter: told with what it gives and what is used, and only there.
  void lawsThatAreHeldAreTold() {
    Project project = slushAndSteam();
    Response law;
    law.kind = Response::Kind::Law;
    law.law = "linear";
    law.coefficients = {2.2, 0.02, 230};  // 0 at 120 K
    project.materials[0].properties.values["conductivity_solid"] = law;
    const auto told = [&](double temperature) {
      project.bodies[0].parameters.values["temperature"] = temperature;
      const std::vector<Limit> limits = Engine(project, *m_plugins).limits();
      const auto found = std::find_if(limits.begin(), limits.end(),
                                      [](const Limit& limit) { return limit.what == "water.conductivity_solid"; });
      return found == limits.end() ? std::optional<Limit>() : *found;
    };
    QVERIFY(!told(200));
    const std::optional<Limit> limit = told(100);
    QVERIFY(limit && limit->kelvin);
    QVERIFY(std::abs(limit->asked + 0.4) < 1e-9);
    QCOMPARE(limit->delivered, 0.0);
    QCOMPARE(limit->kelvin->front(), 0.0);
    QVERIFY(limit->kelvin->back() > 116 && limit->kelvin->back() <= 120);
  }

  /// Matter that is born far from the balance of its phase, between heat capacities at the ends of their ranges.
  void undercooledMatterIsBornWarm() {
    Project project = slushAndSteam();
    project.materials[0].properties.values["heat_capacity_solid"] = Response(100.0);
    project.materials[0].properties.values["heat_capacity_liquid"] = Response(5000.0);
    for (Body& body : project.bodies) {
      body.parameters.values["temperature"] = 80.0;
      body.parameters.values["phase"] = std::string("liquid");
    }
    Engine engine(project, *m_plugins);
    QCOMPARE(impossible(engine), QString());
    QCOMPARE(runFor(engine, 5), QString());
  }

 private:
  struct Shares {
    std::vector<double> temperature;
    std::vector<float> solid, gas;
  };
  static Shares sharesOf(Engine& engine) {
    engine.limits();  // what was edited acts on what is asked
    const ParticleStore& p = engine.particles();
    const auto list = [&](const auto* values) { return std::vector(values, values + p.size()); };
    return {list(p.temperature()), list(p.solidFraction()), list(p.gasFraction())};
  }
  static void compare(const Shares& now, const Shares& before) {
    for (size_t i = 0; i < before.temperature.size(); ++i) {
      QVERIFY2(std::abs(now.temperature[i] - before.temperature[i]) < 1e-6,
               qPrintable(QStringLiteral("%1 K, was %2 K").arg(now.temperature[i]).arg(before.temperature[i])));
      QVERIFY(std::abs(now.solid[i] - before.solid[i]) < 1e-5f);
      QVERIFY(std::abs(now.gas[i] - before.gas[i]) < 1e-5f);
    }
  }
  std::unique_ptr<PluginRegistry> m_plugins;

  /// Ice, slush, water that boils, and steam.
  static Project slushAndSteam() {
    Project project = between("water", 1);
    const double temperatures[] = {260, 273.15, 373.1, 400};
    for (size_t k = 0; k < 4; ++k) {
      project.bodies[k].parameters.values["temperature"] = temperatures[k];
      project.bodies[k].parameters.values["heating_power"] = k == 1 || k == 2 ? 5000.0 : 0.0;
    }
    project.bodies[1].parameters.values["phase"] = std::string("solid");
    return project;
  }
};

QTEST_APPLESS_MAIN(TestLiveProperties)
#include "tst_liveproperties.moc"
