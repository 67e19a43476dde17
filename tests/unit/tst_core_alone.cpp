// SPDX-License-Identifier: Apache-2.0
// The solver with nothing but core behind it: no plugin, no registry, no thermal model. This program links ps::solver
// alone, so it stops linking when core needs more.
#include "core/matter/material.h"
#include "core/particles/particlestore.h"
#include "core/solver/solver.h"

#include <QTest>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

constexpr double kSpacing = 0.02;  // m
constexpr int kSide = 6;
constexpr double kGravity = 9.81;  // m/s2

Material plainLiquid() {
  Material material;
  material.id = material.label = "plain";
  material.properties["density_liquid"] = Response(1000.0);
  material.properties["density_solid"] = Response(1000.0);
  material.properties["melting_temperature"] = Response(0.0);
  return material;
}

// A cube of liquid particles whose lowest layer lies at `bottom` (m).
Spawn cube(double bottom) {
  Spawn spawn;
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        spawn.position.push_back({(i - 0.5 * kSide) * kSpacing, bottom + j * kSpacing, (k - 0.5 * kSide) * kSpacing});
  return spawn;
}

Wall wall(const char* id, api::Double3 normal, double offset) {
  Wall w;
  w.id = id;
  w.normal = normal;
  w.offset = offset;
  return w;
}

void configure(Solver& solver, std::vector<Wall> walls) {
  SolverSettings settings;
  settings.spacing = kSpacing;
  solver.setSettings(settings);
  solver.setThermal({}, nullptr, {}, {});
  solver.setMaterials({BakedMaterial(plainLiquid(), 101325)});
  solver.setWalls(std::move(walls));
  solver.setBounds({{-2, -20, -2}, {2, 5, 2}});
}

}  // namespace

class CoreAloneTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void freeFallIsFree();
  void liquidComesToRestInATray();
};

void CoreAloneTest::freeFallIsFree() {
  Solver solver;
  configure(solver, {});
  QCOMPARE(solver.spawn(cube(1)).size(), size_t{kSide * kSide * kSide});
  constexpr int kFrames = 30;
  for (int frame = 0; frame < kFrames; ++frame) {
    const StepReport report = solver.step();
    QVERIFY2(report.flags == 0, report.message.c_str());
  }
  const ParticleStore& particles = solver.particles();
  double mean = 0;
  for (size_t i = 0; i < particles.size(); ++i) mean += double{particles.velocity()[i].y} / double(particles.size());
  // Inner forces sum to zero, so the mean follows gravity; float32 positions of about 1 m leave 1e-7 m per substep of
  // 1/240 s, that is some 1e-5 m/s per particle.
  const double expected = -kGravity * kFrames / 60.0;
  QVERIFY2(std::abs(mean - expected) < 1e-3 * std::abs(expected), qPrintable(QString::number(mean)));
  QCOMPARE(solver.frame(), uint64_t{kFrames});
}

void CoreAloneTest::liquidComesToRestInATray() {
  Solver solver;
  constexpr double kHalf = 0.1;
  configure(solver, {wall("floor", {0, 1, 0}, 0), wall("left", {1, 0, 0}, -kHalf), wall("right", {-1, 0, 0}, -kHalf),
                     wall("back", {0, 0, 1}, -kHalf), wall("front", {0, 0, -1}, -kHalf)});
  solver.spawn(cube(0.5 * kSpacing));
  for (int frame = 0; frame < 240; ++frame) {
    const StepReport report = solver.step();
    QVERIFY2(report.flags == 0, report.message.c_str());
  }
  const ParticleStore& particles = solver.particles();
  QCOMPARE(particles.size(), size_t{kSide * kSide * kSide});
  double speed = 0, top = 0;
  for (size_t i = 0; i < particles.size(); ++i) {
    const api::Float4 p = particles.position()[i], v = particles.velocity()[i];
    speed += std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z) / double(particles.size());
    top = std::max(top, double{p.y});
    QVERIFY(p.y > -0.5 * kSpacing && std::abs(p.x) < kHalf + 0.5 * kSpacing && std::abs(p.z) < kHalf + 0.5 * kSpacing);
  }
  // 216 particles on a floor of 10 x 10 fill two layers and a bit; four are generous. What still moves after 4 s is
  // slower than a tenth of the fall from one spacing, sqrt(2 g spacing) = 0.63 m/s.
  QVERIFY2(top < 4 * kSpacing, qPrintable(QString::number(top)));
  QVERIFY2(speed < 0.063, qPrintable(QString::number(speed)));
}

QTEST_GUILESS_MAIN(CoreAloneTest)
#include "tst_core_alone.moc"
