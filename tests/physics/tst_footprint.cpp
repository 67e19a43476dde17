// SPDX-License-Identifier: Apache-2.0
// What scenes take in memory, against what is estimated before they are made. Counted are the live bytes of malloc and
// its kin, at their most, from the engine's making on: they do not depend on the machine. The three snapshots that an
// editor keeps are kept here too.
#include "core/base/parallel.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/sceneneed.h"
#include "core/solver/footprint.h"
#include "tests/shared/scenes.h"

#include <QDir>
#include <QTest>

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PS_COUNTS_BYTES 1
#endif

namespace {

std::atomic<int64_t> g_live{0}, g_most{0};

[[maybe_unused]] void* counted(void* block) {
  if (!block) return block;
  const int64_t live = g_live += static_cast<int64_t>(malloc_usable_size(block));
  int64_t most = g_most;
  while (live > most && !g_most.compare_exchange_weak(most, live)) {
  }
  return block;
}

[[maybe_unused]] void forget(void* block) {
  if (block) g_live -= static_cast<int64_t>(malloc_usable_size(block));
}

}  // namespace

#if defined(PS_COUNTS_BYTES)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* block);

void* malloc(size_t size) { return counted(__libc_malloc(size)); }
void* calloc(size_t items, size_t size) { return counted(__libc_calloc(items, size)); }
void* realloc(void* old, size_t size) {
  forget(old);
  return counted(__libc_realloc(old, size));
}
void* aligned_alloc(size_t alignment, size_t size) { return counted(__libc_memalign(alignment, size)); }
int posix_memalign(void** out, size_t alignment, size_t size) {
  *out = counted(__libc_memalign(alignment, size));
  return *out ? 0 : ENOMEM;
}
void free(void* block) {
  forget(block);
  __libc_free(block);
}
}
#endif

using namespace ps;

namespace {

/// The estimate is no lower than this share of what is counted, whatever the scene.
constexpr double kLeast = 0.95;
/// Nor higher, where all stages that a scene may need are at work; and where some idle, since no heat flows, in what
/// hangs on the particles.
constexpr double kMostAtWork = 1.8, kMostIdle = 3.5;

/// Bytes that a project takes within some frames of its start.
double taken(const Project& project, PluginRegistry& plugins, int frames) {
  const int64_t before = g_live;
  g_most = before;
  Engine engine(project, plugins);
  SnapshotPtr previous, newest = engine.snapshot();
  for (int frame = 0; frame < frames; ++frame) {
    engine.step();
    SnapshotPtr next = engine.snapshot();
    previous = std::exchange(newest, std::move(next));
  }
  return static_cast<double>(g_most - before);
}

/// A block of `side`^3 particles on a hot floor, as what its row says; a sheet or a line of as many.
Project matter(const QString& kind, int side) {
  Project project = scenes::iceOnPlate(side, 600, 500);
  const double spacing = scaleOf(project).spacing;
  Body& body = project.bodies[0];
  body.constraints.clear();
  if (kind == "liquid") body.parameters.values["temperature"] = 330.0;
  if (kind == "gas") body.parameters.values["temperature"] = 420.0;
  if (kind == "fixed") body.parameters.values["fixed"] = true;
  if (kind == "thick") {
    body.parameters.values["temperature"] = 330.0;
    project.materials[0].properties.values["viscosity"] = 100.0;
  }
  for (const char* plugin : {"bonds", "rigid", "clusters", "cloth", "rope"}) {
    if (kind == plugin) body.constraints = {{plugin, {}, {}}};
  }
  const double along = side * side * side, across = std::round(std::sqrt(along));
  Vector3 layers{double(side), double(side), double(side)};
  if (kind == "cloth") layers = {across, 1, across};
  if (kind == "rope") layers = {along, 1, 1};
  std::get<BoxShape>(body.shape) = {{0, spacing * layers[1] / 2, 0}, spacing * layers, {}};
  if (kind == "cloth" || kind == "rope") {
    const Vector3 half = spacing * layers;
    project.environment.boundsMinimum = -half - Vector3{1, 1, 1},
    project.environment.boundsMaximum = half + Vector3{1, 1, 1};
    project.environment.walls.resize(1);
  }
  return project;
}

}  // namespace

class TestFootprint : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
#if !defined(PS_COUNTS_BYTES)
    QSKIP("a sanitizer has these functions");
#endif
    m_plugins = std::make_unique<PluginRegistry>();
    setThreadCount(1);
  }
  void cleanupTestCase() { setThreadCount(0); }

  void theCounterCounts() {
    const int64_t before = g_live;
    g_most = before;
    {
      const std::vector<char> some(1 << 20);
      const std::vector<char> more(some);
    }
    QCOMPARE(g_live, before);
    QVERIFY(g_most - before >= 2 << 20);
  }

  void kindsOfMatter_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"liquid", "gas", "fixed", "thick", "loose", "bonds", "rigid", "clusters", "cloth", "rope"})
      QTest::newRow(kind) << QString(kind);
  }
  void kindsOfMatter() {
    QFETCH(QString, kind);
    const Project project = matter(kind, 16);
    const double estimated = needOf(project, m_plugins.get()).bytes, counted = taken(project, *m_plugins, 12);
    const QByteArray said = QString("%1 MB estimated, %2 MB counted").arg(estimated / 1e6).arg(counted / 1e6).toUtf8();
    QVERIFY2(estimated > kLeast * counted && estimated < kMostAtWork * counted, said);
  }

  void samples_data() {
    QTest::addColumn<QString>("file");
    for (const QString folder : {PS_SOURCE_DIR "/projects", PS_SOURCE_DIR "/projects/thesis"}) {
      for (const QString& name : QDir(folder).entryList({"*.json"}, QDir::Files, QDir::Name))
        QTest::newRow(qPrintable(name)) << folder + "/" + name;
    }
  }
  /// As they are, and with twice the particles.
  void samples() {
    QFETCH(QString, file);
    Project project = loadProject(file.toStdString(), *m_plugins).project;
    project.state = nullptr;
    const double spacing = scaleOf(project).spacing;
    for (const double finer : {1.0, 0.8}) {
      project.solver.parameters.values["particle_spacing"] = finer * spacing;
      const SceneNeed need = needOf(project, m_plugins.get());
      const double counted = taken(project, *m_plugins, 2), tables = bytesPerScene(project.materials.size(), true);
      const QByteArray said = QString("%1 particles: %2 MB estimated, %3 MB counted")
                                  .arg(need.particles)
                                  .arg(need.bytes / 1e6)
                                  .arg(counted / 1e6)
                                  .toUtf8();
      QVERIFY2(need.bytes > kLeast * counted, said);
      QVERIFY2(need.bytes - tables < kMostIdle * counted, said);
    }
  }

 private:
  std::unique_ptr<PluginRegistry> m_plugins;
};

QTEST_APPLESS_MAIN(TestFootprint)
#include "tst_footprint.moc"
