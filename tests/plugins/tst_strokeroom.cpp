// SPDX-License-Identifier: Apache-2.0
// A stroke in the making allocates nothing from sample to sample: our brushes and what runs them keep their room. Only
// what has been drawn takes more of it, which doubles as it grows.
#include "core/parameters/parameterset.h"
#include "core/plugin_host/registry.h"
#include "core/sketch/strokemaker.h"
#include "tests/shared/allocations.h"

#include <QtTest/QTest>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

constexpr double kCell = 0.02;

StrokeSetup setupOf(const char* brush) {
  StrokeSetup setup{{{0, 0, 0}, kCell}, 0.05, {0, 1, 0}, {}};
  setup.symmetry = VoxelShape::Symmetry{"x", 3, {0, 0, 0}};
  if (std::string(brush) == "stamp") {
    VoxelShape::Stamp stamp;
    stamp.spacing = kCell;
    stamp.cells = {{0, 0, 0, 3, 0}, {0, 1, 0, 2, 0}};
    setup.stamp = stampCells(stamp);
  }
  return setup;
}

/// A hand that goes round, a centimetre or so from sample to sample, and at last rises.
api::StrokeSample placeAt(int sample, int rises) {
  const double angle = 0.05 * sample, rise = 0.002 * std::max(0, sample - rises);
  return {{0.3 * std::cos(angle), 0.3 + rise, 0.3 * std::sin(angle)}, 0.8, 0.01 * sample, {}};
}

constexpr int kTurn = 126;  // samples

}  // namespace

class TestStrokeRoom : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aSampleAllocatesNothing_data() {
    QTest::addColumn<bool>("erases");
    for (const char* brush :
         {"particle", "line", "plane", "disc", "cube", "sphere", "tube", "ribbon", "spray", "stamp", "paint", "tint"})
      QTest::newRow(brush) << false;
    QTest::newRow("sphere ") << true;
  }
  void aSampleAllocatesNothing() {
#if !defined(PS_COUNTS_ALLOCATIONS)
    QSKIP("a sanitizer has these functions");
#endif
    QFETCH(bool, erases);
    const std::string name = QString::fromLatin1(QTest::currentDataTag()).trimmed().toStdString();
    const api::BrushPlugin* brush = m_plugins.brush(name);
    QVERIFY(brush);
    Environment environment;
    environment.boundsMinimum = {-10, -10, -10};
    environment.boundsMaximum = {10, 10, 10};
    StrokeSetup setup = setupOf(name.c_str());
    setup.parameters = numbersOf({}, brush->parameters());
    StrokeMaker maker(name, *brush, setup, erases, {environment, {}});
    size_t cells = 0;
    const auto draw = [&](int first, int samples) {
      for (int k = first; k < first + samples; ++k) {
        const api::StrokeSample place = placeAt(k, 6 * kTurn);
        cells += maker.add({&place, 1}).size();
      }
    };
    draw(0, 4 * kTurn);
    QVERIFY(cells > 0);
    // Over the same ground: a sample may still be the one that asks for most so far, and a spray finds places to fill.
    const uint64_t again = allocations::during([&] { draw(4 * kTurn, 2 * kTurn); });
    QVERIFY2(again <= 2, qPrintable(QString::number(again) + QStringLiteral(" by") + allocations::whoAsked()));
    // On new ground the set of all that is drawn grows by doubling, and so do the few lists of what came at once.
    cells = 0;
    const uint64_t further = allocations::during([&] { draw(6 * kTurn, 4 * kTurn); });
    QVERIFY(cells > 0);
    QVERIFY2(further <= 16, qPrintable(QString::number(further) + QStringLiteral(" by") + allocations::whoAsked()));
  }

 private:
  const PluginRegistry m_plugins{PluginRegistry::Options{}};
};

QTEST_APPLESS_MAIN(TestStrokeRoom)
#include "tst_strokeroom.moc"
