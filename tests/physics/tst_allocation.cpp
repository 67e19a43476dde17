// SPDX-License-Identifier: Apache-2.0
// A steady frame allocates nothing: what stages need from frame to frame they keep. Counted is every call of malloc and
// its kin (operator new among them) on the thread that steps. One thread runs every loop: which chunks one of several
// gets, and so how much memory it has had for them before, is left to chance. What a plugin's call takes is the
// plugin's, which has no memory of its own from call to call: it is told apart by the stack, and not judged. Steady is
// a frame in which no list outgrows what it has been: so frames are counted after a warm-up.
#include "softscene.h"

#include <QTest>

#include <cerrno>
#include <cstdlib>
#include <dlfcn.h>
#include <execinfo.h>
#include <functional>
#include <memory>
#include <string_view>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PS_COUNTS_ALLOCATIONS 1
#endif

namespace {

constexpr int kDeepest = 48;

thread_local bool t_counting = false;
thread_local uint64_t t_count = 0, t_plugins = 0;
thread_local void* t_first[kDeepest];  // who asked first, for the message
thread_local int t_depth = 0;

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

[[maybe_unused]] void count() {
  if (!t_counting) return;
  t_counting = false;  // backtrace() may allocate
  void* stack[kDeepest];
  const int depth = backtrace(stack, kDeepest);
  if (isPlugins(stack, depth)) {
    ++t_plugins;
  } else if (t_count++ == 0) {
    std::copy(stack, stack + depth, t_first);
    t_depth = depth;
  }
  t_counting = true;
}

}  // namespace

#if defined(PS_COUNTS_ALLOCATIONS)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(size_t items, size_t size) {
  count();
  return __libc_calloc(items, size);
}
void* realloc(void* old, size_t size) {
  count();
  return __libc_realloc(old, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, size_t alignment, size_t size) {
  count();
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}
}
#endif

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

/// Names of the functions that asked first, as far as the program tells them.
QString whoAsked() {
  QString names;
  char** lines = backtrace_symbols(t_first, t_depth);
  for (int k = 2; lines && k < t_depth; ++k) names += QStringLiteral("\n  ") + QString::fromLocal8Bit(lines[k]);
  std::free(lines);
  return names;
}

}  // namespace

class TestAllocation : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(1); }
  void cleanup() { ps::setThreadCount(0); }

  void theCounterCounts() {
#if defined(PS_COUNTS_ALLOCATIONS)
    t_count = 0;
    t_counting = true;
    auto some = std::make_unique<std::vector<int>>(100);
    void* raw = std::malloc(10);
    t_counting = false;
    std::free(raw);
    QCOMPARE(t_count, uint64_t{3});
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
    void* unused[2];
    backtrace(unused, 2);  // loads what it needs
    t_count = 0;
    uint64_t frames = 0;
    for (int frame = 0; frame < 40; ++frame) {
      const uint64_t before = t_count;
      t_counting = true;
      const ps::StepReport report = s->solver.step();
      t_counting = false;
      QCOMPARE(report.flags, ps::StepFlags{0});
      frames += t_count > before ? 1 : 0;
    }
    QVERIFY2(
        t_count == 0,
        qPrintable(
            QStringLiteral("%1 allocations in %2 frames; the first by%3").arg(t_count).arg(frames).arg(whoAsked())));
  }
};

QTEST_APPLESS_MAIN(TestAllocation)
#include "tst_allocation.moc"
