// SPDX-License-Identifier: Apache-2.0
// A steady frame allocates nothing: what stages need from frame to frame they keep. Counted is the thread that steps.
// One thread runs every loop: which chunks one of several gets, and so how much memory it has had for them before, is
// left to chance. What a plugin's call takes is the plugin's, which has no memory of its own from call to call: it is
// told apart by the stack, and not judged. Steady is a frame in which no list outgrows what it has been: so frames are
// counted after a warm-up.
#include "softscene.h"
#include "tests/shared/allocations.h"

#include <QTest>

#include <cstdlib>
#include <dlfcn.h>
#include <functional>
#include <memory>
#include <string_view>

namespace {

/// Whether a function of a plugin's model is among those that are being called; the program exports their names.
bool isPlugins(void* const* stack, int depth) {
  for (int k = 0; k < depth; ++k) {
    Dl_info info{};
    if (!dladdr(stack[k], &info) || !info.dli_sname) continue;
    const std::string_view name = info.dli_sname;
    if (name.find("2ps10constraint") != name.npos || name.find("2ps7thermal") != name.npos) return true;
  }
  return false;
}

}  // namespace

using namespace soft;
using ps::Solver;

namespace {

/// A solver with what it needs to live.
struct Scene {
  ps::thermal::EnthalpyModel model;
  ps::constraint::BondModel bonds;
  ps::constraint::ClothModel cloth;
  ps::constraint::RigidModel stiff;
  Solver solver;

  void warm() {
    ps::ThermalSettings thermal;
    thermal.timeScale = 20;
    thermal.airConvection = 20;
    thermal.radiation = true;
    solver.setThermal(thermal, &model, "model", {});
  }
};

std::unique_ptr<Scene> pond() {
  auto s = std::make_unique<Scene>();
  prepare(s->solver, settingsOf(0.02));
  s->solver.setWalls(tray(0.2));
  s->solver.spawn(liquid(lattice(10, 8, 10, 0.02, 0)));
  return s;
}

/// A sheet held by two edges, with water on it.
std::unique_ptr<Scene> wetCloth() {
  auto s = std::make_unique<Scene>();
  prepare(s->solver, settingsOf(0.02), matter(300));
  s->solver.setMaterials({ps::BakedMaterial(matter(300), 101325), ps::BakedMaterial(water(), 101325)});
  s->solver.setWalls(tray(0.6));
  const uint32_t set = s->solver.addConstraintSet(&s->cloth, "cloth", parametersOf(s->cloth));
  s->solver.spawn(solid(grid(16, 1, 16, 0.02, {-0.15, 0.2, -0.15}), set));
  pin(s->solver, [](const ps::Vector3& p) { return std::abs(p[0]) > 0.14; });
  ps::Spawn drops = liquid(lattice(4, 3, 4, 0.02, 0.23));
  drops.material = 1;
  drops.body = 1;
  s->solver.spawn(drops);
  return s;
}

std::unique_ptr<Scene> boxes() {
  auto s = std::make_unique<Scene>();
  prepare(s->solver, settingsOf(0.02));
  s->solver.setWalls(tray(0.4));
  const uint32_t set = s->solver.addConstraintSet(&s->stiff, "rigid", rigidParameters());
  for (uint32_t k = 0; k < 4; ++k) {
    ps::Spawn box = ice(lattice(4, 3, 4, 0.02, 0.001 + 0.062 * k), set);
    box.body = k;
    s->solver.spawn(box);
  }
  return s;
}

/// Ice in the air on a floor, water beside it: heat flows in all ways, and nothing melts yet.
std::unique_ptr<Scene> heated() {
  auto s = std::make_unique<Scene>();
  prepare(s->solver, settingsOf(0.02));
  std::vector<ps::Wall> walls = tray(0.3);
  walls[0].heat = ps::WallHeat::FixedTemperature;
  walls[0].temperature = 265;
  s->solver.setWalls(walls);
  s->warm();
  const uint32_t set = s->solver.addConstraintSet(&s->bonds, "bonds", bondParameters());
  s->solver.spawn(ice(lattice(6, 4, 14, 0.02, 0), set, 200));
  return s;
}

}  // namespace

class TestAllocation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    allocations::spares = isPlugins;
    ps::setThreadCount(1);
  }
  void cleanup() { ps::setThreadCount(0); }

  void theCounterCounts() {
#if defined(PS_COUNTS_ALLOCATIONS)
    void* raw = nullptr;
    std::unique_ptr<std::vector<int>> some;  // one that is seen here alone compilers leave out
    const uint64_t count = allocations::during([&] {
      some = std::make_unique<std::vector<int>>(100);
      raw = std::malloc(10);
    });
    std::free(raw);
    QCOMPARE(count, uint64_t{3});
#endif
  }

  void aSteadyFrameAllocatesNothing_data() {
    QTest::addColumn<int>("scene");
    for (const char* name : {"liquid", "cloth and liquid", "rigid", "heat"}) {
      static int index = 0;
      QTest::newRow(name) << index++;
    }
  }
  void aSteadyFrameAllocatesNothing() {
#if !defined(PS_COUNTS_ALLOCATIONS)
    QSKIP("a sanitizer has these functions");
#endif
    QFETCH(int, scene);
    std::unique_ptr<Scene> (*const kScenes[])() = {pond, wetCloth, boxes, heated};
    const std::unique_ptr<Scene> s = kScenes[scene]();
    QVERIFY(run(s->solver, 150));
    uint64_t all = 0, frames = 0;
    for (int frame = 0; frame < 40; ++frame) {
      ps::StepReport report;
      const uint64_t count = allocations::during([&] { report = s->solver.step(); });
      QCOMPARE(report.flags, ps::StepFlags{0});
      all += count;
      frames += count > 0 ? 1 : 0;
    }
    QVERIFY2(all == 0, qPrintable(QStringLiteral("%1 allocations in %2 frames; the last by%3")
                                      .arg(all)
                                      .arg(frames)
                                      .arg(allocations::whoAsked())));
  }
};

QTEST_APPLESS_MAIN(TestAllocation)
#include "tst_allocation.moc"
