// SPDX-License-Identifier: Apache-2.0
// Matter that melts and freezes, boils and condenses again and again while the scene runs, and a closed box in which it
// moves, breaks, boils and freezes at once: nothing is lost and nothing wears out.
#include "core/base/parallel.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace {

constexpr double kSpacing = 0.02;

using ps::Engine;
using ps::api::Float4;

/// A sanitizer makes a frame many times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kCycles = 5;
#else
constexpr int kCycles = 100;
#endif

/// A tray of water or ice whose walls all take part.
ps::Project trayOf(const std::array<int, 3>& particles, double height, double temperature, double timeScale) {
  ps::Project project;
  project.solver.thermalModel = "enthalpy";
  project.materials.push_back(ps::scenes::water());
  project.environment = ps::scenes::tray(0.5 * particles[0] * kSpacing, height);
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  project.solver.parameters.values["thermal_time_scale"] = timeScale;
  ps::Body body = ps::scenes::block("water", 1, kSpacing, {0, 0.5 * particles[1] * kSpacing, 0}, temperature);
  body.shape = ps::BoxShape{{0, 0.5 * particles[1] * kSpacing, 0},
                            {particles[0] * kSpacing, particles[1] * kSpacing, particles[2] * kSpacing}};
  if (body.constraints.empty()) body.constraints.push_back({"bonds", {}, {}});
  project.bodies.push_back(body);
  return project;
}

void setWall(Engine& engine, const char* wall, const char* key, const ps::Value& value) {
  QVERIFY(engine.setParameter({ps::Owner::Wall, wall, key}, value));
}
void setWalls(Engine& engine, const std::vector<const char*>& walls, double temperature) {
  for (const char* wall : walls) {
    setWall(engine, wall, "heat", std::string("fixed_temperature"));
    setWall(engine, wall, "temperature", temperature);
  }
}

struct Books {
  size_t count = 0;
  double mass = 0, energy = 0;
  ps::HeatLedger ledger;
};
Books booksOf(Engine& engine) {
  Books books;
  const ps::ParticleStore& p = engine.solver().particles();
  books.count = p.size();
  for (size_t i = 0; i < p.size(); ++i) books.mass += double{p.mass()[i]};
  books.energy = engine.solver().thermalEnergy();
  books.ledger = engine.solver().heatLedger();
  return books;
}
/// What the books miss since `before`, over what was exchanged.
double openShare(const Books& before, const Books& now) {
  const double open = (now.energy - before.energy) - (now.ledger.net() - before.ledger.net());
  return std::abs(open) / now.ledger.exchanged;
}

double shareOf(Engine& engine, ps::api::Phase phase) {
  const ps::FrameStats stats = engine.stats();
  double mass = 0;
  for (const ps::PhaseAmount& amount : stats.phases) mass += amount.mass;
  return stats.phases[static_cast<size_t>(phase)].mass / mass;
}
double solidShare(Engine& engine) { return shareOf(engine, ps::api::Phase::Solid); }

/// Runs until `done`, at most `most` frames; false when something was flagged or it took too long.
template <class Done>
bool runUntil(Engine& engine, int most, Done&& done) {
  for (int f = 0; f < most; ++f) {
    const ps::StepReport report = engine.step();
    if (report.flags != 0) {
      qWarning("frame %d: flags %u: %s", f, report.flags, report.message.c_str());
      return false;
    }
    if (done(f)) return true;
  }
  return false;
}

size_t outside(Engine& engine, double halfWidth, double height) {
  size_t count = 0;
  const ps::ParticleStore& p = engine.solver().particles();
  for (size_t i = 0; i < p.size(); ++i) {
    const Float4& x = p.position()[i];
    count += std::abs(x.x) > halfWidth || std::abs(x.z) > halfWidth || x.y < 0 || x.y > height ? 1 : 0;
  }
  return count;
}

/// How a solid answers to a small uniform strain along an axis: J/m³ over half the strain's square, Pa. From the energy
/// of its bonds when all particles are moved apart and together by `kStrain`; nothing is left moved.
std::array<double, 3> stiffnessOf(Engine& engine) {
  constexpr double kStrain = 1e-3;
  ps::ParticleStore& p = ps::tests::solverOf(engine).particles();
  const std::vector<Float4> places(p.position(), p.position() + p.size());
  double volume = 0;
  for (const Float4& x : places) volume += double{x.w};
  const double rest = engine.solver().elasticEnergy();
  std::array<double, 3> result{};
  for (size_t axis = 0; axis < 3; ++axis) {
    double energy = -2 * rest;
    for (const double strain : {kStrain, -kStrain}) {
      for (size_t i = 0; i < p.size(); ++i) {
        Float4& x = p.position()[i];
        float* const c[3] = {&x.x, &x.y, &x.z};
        *c[axis] = static_cast<float>(double{*c[axis]} * (1 + strain));
      }
      energy += engine.solver().elasticEnergy();
      std::copy(places.begin(), places.end(), p.position());
    }
    result[axis] = energy / (volume * kStrain * kStrain);
  }
  return result;
}

/// Mean distance from the centre along each axis, in m: the outermost particle would tell of one bump alone.
std::array<double, 3> lengthsOf(Engine& engine) {
  const ps::ParticleStore& p = engine.solver().particles();
  const auto part = [&](size_t i, size_t axis) {
    const Float4& x = p.position()[i];
    return double{axis == 0 ? x.x : axis == 1 ? x.y : x.z};
  };
  const auto n = static_cast<double>(p.size());
  std::array<double, 3> result{};
  for (size_t axis = 0; axis < 3; ++axis) {
    double mean = 0;
    for (size_t i = 0; i < p.size(); ++i) mean += part(i, axis) / n;
    for (size_t i = 0; i < p.size(); ++i) result[axis] += std::abs(part(i, axis) - mean) / n;
  }
  return result;
}

}  // namespace

class TestCycles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(1); }

  void meltingAndFreezing() {
    ps::PluginRegistry registry;
    const double half = 0.5 * 10 * kSpacing, height = 0.4;
    Engine engine(trayOf({10, 6, 10}, height, 263.15, 40000), registry);
    const std::vector<const char*> walls{"floor", "left", "right", "back", "front"};
    const Books start = booksOf(engine);
    std::array<double, 3> firstStiffness{}, firstLength{}, stiffness{}, length{};
    int frames = 0;
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      setWalls(engine, walls, 353.15);
      QVERIFY2(runUntil(engine, 600,
                        [&](int f) { return ++frames, f > 30 && shareOf(engine, ps::api::Phase::Liquid) == 1; }),
               qPrintable(QString("cycle %1 melts to %2").arg(cycle).arg(shareOf(engine, ps::api::Phase::Liquid))));
      setWalls(engine, walls, 243.15);
      QVERIFY2(runUntil(engine, 600, [&](int f) { return ++frames, f > 30 && solidShare(engine) == 1; }),
               qPrintable(QString("cycle %1 freezes to %2").arg(cycle).arg(solidShare(engine))));
      QVERIFY(runUntil(engine, 31, [&](int f) { return ++frames, f == 30; }));
      stiffness = stiffnessOf(engine), length = lengthsOf(engine);
      if (cycle == 0) firstStiffness = stiffness, firstLength = length;
    }
    const Books end = booksOf(engine);
    qInfo("%d cycles in %d frames: stiffness %.3f %.3f %.3f and length %.4f %.4f %.4f of the first; books open by %.2g",
          kCycles, frames, stiffness[0] / firstStiffness[0], stiffness[1] / firstStiffness[1],
          stiffness[2] / firstStiffness[2], length[0] / firstLength[0], length[1] / firstLength[1],
          length[2] / firstLength[2], openShare(start, end));
    QCOMPARE(end.count, size_t{600});
    QCOMPARE(end.mass, start.mass);
    QVERIFY2(openShare(start, end) < 1e-12, qPrintable(QString::number(openShare(start, end))));
    QCOMPARE(outside(engine, half, height), size_t{0});
    for (size_t axis = 0; axis < 3; ++axis) {
      // What froze first stands elsewhere in each cycle: a solid of 600 is some percent stiffer or softer for it.
      QVERIFY(std::abs(stiffness[axis] / firstStiffness[axis] - 1) < 0.1);
      QVERIFY(std::abs(length[axis] / firstLength[axis] - 1) < 0.1);
    }
  }

  void boilingAndCondensing() {
    ps::PluginRegistry registry;
    const double half = 0.5 * 10 * kSpacing, height = 0.5;
    ps::Project project = trayOf({10, 5, 10}, height, 363.15, 100000);
    Engine engine(project, registry);
    const std::vector<const char*> walls{"floor", "lid", "left", "right", "back", "front"};
    const Books start = booksOf(engine);
    int frames = 0;
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      setWalls(engine, walls, 473.15);
      const auto gas = [&] { return shareOf(engine, ps::api::Phase::Gas); };
      QVERIFY2(runUntil(engine, 900, [&](int) { return ++frames, gas() > 0.9; }),
               qPrintable(QString("cycle %1 boils to %2").arg(cycle).arg(gas())));
      setWalls(engine, walls, 293.15);
      QVERIFY2(runUntil(engine, 900, [&](int) { return ++frames, shareOf(engine, ps::api::Phase::Liquid) > 0.98; }),
               qPrintable(QString("cycle %1 condenses to %2").arg(cycle).arg(shareOf(engine, ps::api::Phase::Liquid))));
      QCOMPARE(outside(engine, half, height), size_t{0});
    }
    const Books end = booksOf(engine);
    qInfo("%d cycles in %d frames; books open by %.2g", kCycles, frames, openShare(start, end));
    QCOMPARE(end.count, size_t{500});
    QCOMPARE(end.mass, start.mass);
    QVERIFY2(openShare(start, end) < 1e-12, qPrintable(QString::number(openShare(start, end))));
  }

  /// Deep-frozen ice and glowing iron fall into warm water between walls that let no heat through.
  void aClosedBoxKeepsItsHeat() {
    ps::PluginRegistry registry;
    ps::Project project = trayOf({10, 4, 10}, 0.5, 293.15, 20000);
    ps::SceneMaterial iron;
    iron.id = iron.base = "iron";
    project.materials.push_back(iron);
    ps::Body ice = ps::scenes::block("ice", 5, kSpacing, {-0.045, 0.14, 0}, 100);
    ps::Body ball = ps::scenes::block("iron", 3, kSpacing, {0.055, 0.14, 0}, 1500);
    ball.material = "iron";
    ball.constraints = {{"rigid", {}, {}}};
    project.environment.parameters.values["air_convection"] = 0.0;
    project.bodies.push_back(ice);
    project.bodies.push_back(ball);
    Engine engine(project, registry);
    const Books start = booksOf(engine);
    const ps::ParticleStore& p = engine.solver().particles();
    size_t boiled = 0;
    bool moved = false, froze = false, broke = false;
    double exchanged = 0;  // J, between particles: at least what each frame moved from one to another
    std::map<uint32_t, double> energies;
    QVERIFY(runUntil(engine, 300, [&](int f) {
      const std::span<const double> energy = engine.solver().thermalEnergies();
      for (size_t i = 0; i < p.size(); ++i) {
        const ps::api::Motion motion = p.motion()[i];
        froze = froze || (p.body()[i] == 0 && motion == ps::api::Motion::Solid);
        broke = broke || (p.body()[i] == 1 && motion == ps::api::Motion::Liquid);
        boiled += motion == ps::api::Motion::Gas ? 1 : 0;
        const auto known = energies.insert({p.id()[i], energy[i]}).first;
        exchanged += 0.5 * std::abs(energy[i] - std::exchange(known->second, energy[i]));
      }
      moved = moved || engine.stats().kineticEnergy > 0.1;  // J; the iron weighs 1.7 kg
      return f == 299;
    }));
    const Books end = booksOf(engine);
    const double open = std::abs(end.energy - start.energy) / exchanged;
    qInfo("books open by %.2g of %.3g J exchanged", open, exchanged);
    QVERIFY(moved);
    QVERIFY(broke);
    QVERIFY(froze);
    QVERIFY(boiled > 100);
    QCOMPARE(end.ledger.net(), 0.0);
    QCOMPARE(end.count, start.count);
    QCOMPARE(end.mass, start.mass);
    QCOMPARE(outside(engine, 0.1, 0.5), size_t{0});
    QVERIFY2(open < 1e-12, qPrintable(QString::number(open)));
  }
};

QTEST_APPLESS_MAIN(TestCycles)
#include "tst_cycles.moc"
