// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/scene/pose.h"
#include "core/sketch/cellset.h"
#include "core/sketch/drawingplane.h"
#include "core/sketch/flooding.h"
#include "core/sketch/redraw.h"
#include "core/sketch/smoothing.h"
#include "core/sketch/stroke.h"
#include "core/sketch/strokemaker.h"
#include "core/sketch/symmetry.h"

#include <Eigen/Geometry>

#include <QTest>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

using namespace ps;
using api::Cell;
using api::EditKind;
using api::StrokeSample;

namespace {

/// Fills a ball; asks for the opposite of each edit first, so that the order of edits shows.
class BallBrush : public api::BrushPlugin {
 public:
  const char* label() const override { return "Ball"; }
  const char* help() const override { return ""; }
  api::ParameterList parameters() const override { return {}; }
  void stroke(const api::StrokeContext& c, EditKind kind, const api::List<StrokeSample>& samples,
              api::EditSink& sink) const override {
    const int reach = static_cast<int>(std::ceil(c.radius / c.spacing));
    const SketchGrid grid{{c.origin.x, c.origin.y, c.origin.z}, c.spacing};
    for (size_t k = 0; k < samples.count; ++k) {
      const StrokeSample s = samples.at(k);
      std::vector<Cell> cells;
      const Cell middle = grid.cellAt({s.position.x, s.position.y, s.position.z});
      for (int z = -reach; z <= reach; ++z)
        for (int y = -reach; y <= reach; ++y)
          for (int x = -reach; x <= reach; ++x) {
            const Cell cell{middle.x + x, middle.y + y, middle.z + z};
            const Vector3 at = grid.centreOf(cell);
            if (std::hypot(at[0] - s.position.x, at[1] - s.position.y, at[2] - s.position.z) <= c.radius)
              cells.push_back(cell);
          }
      if (contrary) sink.submit(kind == EditKind::Add ? EditKind::Remove : EditKind::Add, {cells.data(), cells.size()});
      sink.submit(kind, {cells.data(), cells.size()});
    }
    if (fails) throw std::runtime_error("brush failed");
  }
  api::Double3 extent(const api::StrokeContext& c) const noexcept override { return {c.radius, c.radius, c.radius}; }
  bool contrary = false, fails = false;
};

/// Asks for more cells than there is memory for.
class GreedyBrush final : public api::BrushPlugin {
 public:
  const char* label() const override { return "Greedy"; }
  const char* help() const override { return ""; }
  api::ParameterList parameters() const override { return {}; }
  void stroke(const api::StrokeContext&, EditKind kind, const api::List<StrokeSample>&,
              api::EditSink& sink) const override {
    std::vector<Cell> row(1 << 16);
    for (int y = 0; y < 1000; ++y) {
      for (int x = 0; x < (1 << 16); ++x) row[static_cast<size_t>(x)] = {x, y, 0};
      sink.submit(kind, {row.data(), row.size()});
    }
  }
  api::Double3 extent(const api::StrokeContext&) const noexcept override { return {}; }
};

/// Lets a hollow run full from each sample.
class SeedBrush final : public api::BrushPlugin {
 public:
  const char* label() const override { return "Seed"; }
  const char* help() const override { return ""; }
  api::ParameterList parameters() const override { return {}; }
  void stroke(const api::StrokeContext& c, EditKind, const api::List<StrokeSample>& samples,
              api::EditSink& sink) const override {
    const SketchGrid grid{{c.origin.x, c.origin.y, c.origin.z}, c.spacing};
    for (size_t k = 0; k < samples.count; ++k) {
      const api::Double3 place = samples.at(k).position;
      const Cell cell = grid.cellAt({place.x, place.y, place.z});
      sink.submit(EditKind::Fill, {&cell, 1});
    }
  }
  api::Double3 extent(const api::StrokeContext&) const noexcept override { return {}; }
  const void* extension(const char* name) const noexcept override {
    return std::string_view(name) == api::kFillsHollows ? this : nullptr;
  }
};

StrokeSample at(double x, double y, double z, double pressure = 1, double time = 0) {
  return {{x, y, z}, pressure, time, {}};
}

double distance(const StrokeSample& a, const StrokeSample& b) {
  return std::hypot(b.position.x - a.position.x, b.position.y - a.position.y, b.position.z - a.position.z);
}

CellSet cellsOf(std::vector<Cell> cells) { return CellSet(cells); }

/// Of two arms that stand open, each two cells wide and joined at the bottom.
bool isWall(const Cell& c) {
  if (c.y > 4) return false;
  const bool outside = c.x < -1 || c.x > 5 || c.y < -1;
  const bool shell = c.x == -1 || c.x == 5 || c.y == -1, middle = c.x == 2 && c.y > 0;
  return !outside && (shell || middle);
}

}  // namespace

class TestSketch : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void pointsFallIntoCells_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<int>("cell");
    // Spacing 0.25, origin 1: binary fractions, so that faces are exact.
    QTest::newRow("origin") << 1.0 << 0;
    QTest::newRow("just inside") << 1.1249 << 0;
    QTest::newRow("face belongs to the next") << 1.125 << 1;
    QTest::newRow("lower face") << 0.875 << 0;
    QTest::newRow("below the lower face") << 0.8749 << -1;
    QTest::newRow("far") << -24.0 << -100;
    QTest::newRow("out of reach") << 1e300 << (1 << 30);
    QTest::newRow("out of reach below") << -1e300 << -(1 << 30);
    QTest::newRow("not a number") << std::nan("") << (1 << 30);
  }
  void pointsFallIntoCells() {
    QFETCH(double, x);
    QFETCH(int, cell);
    const SketchGrid grid{{1, 1, 1}, 0.25};
    QCOMPARE(grid.cellAt({x, 1, 1}).x, cell);
    QCOMPARE(grid.cellAt({1, x, 1}).y, cell);
    QCOMPARE(grid.cellAt({1, 1, x}).z, cell);
  }

  void centresFallIntoTheirCells() {
    const SketchGrid grid{{0.0137, -2.3, 17.1}, 0.02};
    for (int i = -2000; i < 2000; i += 7) {
      const Cell cell{i, -3 * i, i / 2};
      QVERIFY(sameCell(grid.cellAt(grid.centreOf(cell)), cell));
    }
  }

  void interpolationLeavesNoGap_data() {
    QTest::addColumn<double>("length");
    QTest::addColumn<int>("count");
    QTest::newRow("no way") << 0.0 << 0;
    QTest::newRow("less than a cell") << 0.3 << 1;
    QTest::newRow("one cell") << 1.0 << 1;
    QTest::newRow("a little more") << 1.001 << 2;
    QTest::newRow("many") << 7.5 << 8;
  }
  void interpolationLeavesNoGap() {
    QFETCH(double, length);
    QFETCH(int, count);
    const StrokeSample from = at(0, 0, 0, 0, 10), to = at(length, 0, 0, 1, 12);
    const auto samples = interpolateStroke(from, to, 1.0);
    QCOMPARE(int(samples.size()), count);
    StrokeSample last = from;
    for (const StrokeSample& s : samples) {
      QVERIFY(distance(last, s) <= 1 + 1e-12);
      last = s;
    }
    if (count == 0) return;
    QCOMPARE(samples.back().position.x, length);
    QCOMPARE(samples.back().time, 12.0);
    if (count == 2) QVERIFY(std::abs(samples[0].pressure - 0.5) < 1e-12 && std::abs(samples[0].time - 11) < 1e-12);
  }

  void strokeIsIndependentOfTheFrameRate() {
    // The same straight stroke of 10.37 spacings, seen 3 times and 1000 times: the same dense points to rounding (a
    // thousand additions of about 1e-16 each).
    const double dx = 0.02;
    const auto stroke = [&](int pieces) {
      std::vector<StrokeSample> raw;
      for (int i = 0; i <= pieces; ++i) {
        const double t = static_cast<double>(i) / pieces;
        raw.push_back(at(0.1 + 10.37 * dx * 0.6 * t, 0.3 - 10.37 * dx * 0.8 * t, 0.05, t, t));
      }
      return resampleStroke(raw, dx);
    };
    const auto slow = stroke(2), fast = stroke(999);
    QCOMPARE(slow.size(), size_t(12));  // arc lengths 0, 1 .. 10 and the end
    QCOMPARE(fast.size(), slow.size());
    for (size_t i = 0; i < slow.size(); ++i) {
      QVERIFY(distance(slow[i], fast[i]) < 1e-10 * dx * 1e3);
      QVERIFY(std::abs(slow[i].pressure - fast[i].pressure) < 1e-9);
      if (i > 0) QVERIFY(distance(slow[i - 1], slow[i]) <= dx * (1 + 1e-9));
    }
    const BallBrush brush;
    const StrokeSetup setup{{{0, 0, 0}, dx}, 0.0519, {0, 1, 0}, {}};
    QVERIFY(applyBrush(brush, setup, EditKind::Add, slow).added == applyBrush(brush, setup, EditKind::Add, fast).added);
  }

  /// As a window, a headset or a script feeds it: 1.5 m in 0.15 s, 10 m/s, seen 6 times and 1000 times.
  void aStrokeInTheMakingGivesEachCellOnce() {
    const double dx = 0.02;
    const BallBrush brush;
    const StrokeSetup setup{{{0, 0, 0}, dx}, 0.03, {0, 1, 0}, {}};
    Environment environment;
    environment.walls.clear();
    environment.boundsMinimum = {-1, -1, -1};
    environment.boundsMaximum = {1, 1, 1};
    const auto draw = [&](int pieces, bool lifts) {
      StrokeMaker maker("ball", brush, setup, false, {environment, {}});
      std::vector<Cell> all;
      const auto take = [&](std::span<const Cell> fresh) { all.insert(all.end(), fresh.begin(), fresh.end()); };
      for (int i = 0; i <= pieces; ++i) {
        const double t = static_cast<double>(i) / pieces;
        const StrokeSample place = at(-0.3 + 1.5 * t, 0.1, 0.05, 1, 0.15 * t);
        take(maker.add({&place, 1}));
        if (lifts && 2 * i == pieces) take(maker.lift());
      }
      take(maker.lift());
      return all;
    };
    const std::vector<Cell> seldom = draw(6, false), often = draw(1000, false);
    const CellSet cells(seldom);
    QCOMPARE(cells.cells().size(), seldom.size());  // none twice
    QVERIFY(cells == CellSet(often) && often.size() == seldom.size());
    const SketchGrid grid{{0, 0, 0}, dx};
    double end = 0;
    for (double x = -0.3; x < 1 - dx; x += dx / 2) QVERIFY(cells.contains(grid.cellAt({x, 0.1, 0.05})));  // no gap
    for (const Cell& cell : cells.cells()) end = std::max(end, grid.centreOf(cell).x());
    QVERIFY2(end <= 1, qPrintable(QString::number(end)));  // where the scene ends
    // Lifted in the middle, where it had a place, it leaves no gap either; from there to the next one it does.
    QVERIFY(CellSet(draw(6, true)).contains(grid.cellAt({0.45, 0.1, 0.05})));
    QVERIFY(!CellSet(draw(6, true)).contains(grid.cellAt({0.58, 0.1, 0.05})));
  }

  void whatFailsIsThrownByTheStroke() {
    BallBrush brush;
    StrokeMaker maker("ball", brush, {{{0, 0, 0}, 0.02}, 0.03, {0, 1, 0}, {}}, true, {});
    QCOMPARE(maker.kind(), EditKind::Remove);
    const std::vector<StrokeSample> way{at(0, 0, 0), at(0, 0, 0), at(0.5, 0, 0)};
    QVERIFY(!maker.add(std::span(way).first(1)).empty());
    QVERIFY(maker.add(std::span(way).subspan(1, 1)).empty());
    brush.fails = true;
    QVERIFY_EXCEPTION_THROWN(maker.add(std::span(way).last(1)), BrushFault);
    QVERIFY(!maker.asksBrush());
  }

  void resamplerStreamsLikeTheWhole() {
    const std::vector<StrokeSample> raw{at(0, 0, 0), at(0.7, 0, 0), at(0.7, 0.7, 0), at(0.7, 0.7, 0), at(5, 0.7, 0)};
    StrokeResampler resampler(1.0);
    std::vector<StrokeSample> dense;
    for (const StrokeSample& s : raw)
      for (const StrokeSample& d : resampler.add(s)) dense.push_back(d);
    QCOMPARE(dense.size(), size_t(6));  // 0 and every spacing of 5.7
    for (const StrokeSample& d : resampler.finish()) dense.push_back(d);
    QCOMPARE(dense.size(), size_t(7));
    QCOMPARE(dense.back().position.x, 5.0);
    QCOMPARE(dense.size(), resampleStroke(raw, 1.0).size());
    QVERIFY(resampler.finish().empty());
    QVERIFY(resampler.add(at(std::nan(""), 0, 0)).empty());
    QCOMPARE(resampler.add(at(3, 3, 3)).size(), size_t(1));  // a new stroke begins with its first point
    QVERIFY_EXCEPTION_THROWN(StrokeResampler(0.0), InputError);
    QVERIFY_EXCEPTION_THROWN(StrokeResampler(std::nan("")), InputError);
  }

  void cellSetIsSortedAndUnique() {
    CellSet set = cellsOf({{1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {5, -1, 0}});
    const std::vector<std::array<int, 3>> expected{{5, -1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    QVERIFY(set.indices() == expected);
    const std::vector<Cell> gone{{0, 0, 0}, {9, 9, 9}};
    set.remove(gone);
    QCOMPARE(set.size(), size_t(3));
    QVERIFY(!set.contains({0, 0, 0}) && set.contains({0, 0, 1}));
    QVERIFY(set == cellsOf({{0, 0, 1}, {5, -1, 0}, {1, 0, 0}}));
  }

  void runsAreCanonicalAndReadBack() {
    VoxelCanvas canvas;
    canvas.paint(cellsOf({{3, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 1}}), 0);
    canvas.paint(cellsOf({{4, 0, 0}, {5, 0, 0}, {2, 0, 0}}), 1);  // (2, 0, 0) is taken and stays
    const std::vector<VoxelShape::Run> expected{{1, 0, 0, 3, 0}, {4, 0, 0, 2, 1}, {2, 0, 1, 1, 0}};
    QVERIFY(canvas.runs() == expected);
    QVERIFY(VoxelCanvas(canvas.runs()).runs() == expected);
    const std::vector<VoxelShape::Run> shuffled{{2, 0, 1, 1, 0}, {5, 0, 0, 1, 1}, {4, 0, 0, 1, 1}, {1, 0, 0, 3, 0}};
    QVERIFY(VoxelCanvas(shuffled).runs() == expected);
    QVERIFY(encodeRuns(canvas.cells(), 7).front() == (VoxelShape::Run{1, 0, 0, 5, 7}));
    QVERIFY(VoxelCanvas().runs().empty());
  }

  void brokenRunsAreRefused_data() {
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("length");
    QTest::addColumn<QString>("expected");
    QTest::newRow("empty run") << 10 << 0 << "run 1: its length must be at least 1, not 0";
    QTest::newRow("negative run") << 10 << -5 << "run 1: its length must be at least 1, not -5";
    QTest::newRow("too far") << std::numeric_limits<int>::max() << 2 << "run 1: it ends past the largest cell index";
    QTest::newRow("overlap") << 2 << 2 << "run 1 covers cell (2, 0, 0), which run 0 holds already";
  }
  void brokenRunsAreRefused() {
    QFETCH(int, x);
    QFETCH(int, length);
    QFETCH(QString, expected);
    const std::vector<VoxelShape::Run> runs{{0, 0, 0, 3, 0}, {x, 0, 0, length, 1}};
    try {
      const VoxelCanvas canvas(runs);
      QFAIL("the runs were taken");
    } catch (const InputError& error) {
      QCOMPARE(QString::fromUtf8(error.what()), expected);
    }
  }

  void paintAndEraseCanBeUndone() {
    VoxelCanvas canvas;
    canvas.paint(cellsOf({{0, 0, 0}, {1, 0, 0}}), 0);
    const auto before = canvas.runs();
    const CellSet filled = canvas.paint(cellsOf({{1, 0, 0}, {2, 0, 0}}), 1);
    QVERIFY(filled == cellsOf({{2, 0, 0}}));
    const auto painted = canvas.runs();
    const VoxelCanvas erased = canvas.erase(cellsOf({{1, 0, 0}, {2, 0, 0}, {8, 8, 8}}));
    QCOMPARE(erased.size(), size_t(2));
    QCOMPARE(canvas.size(), size_t(1));
    canvas.restore(erased);
    QVERIFY(canvas.runs() == painted);
    canvas.erase(filled);
    QVERIFY(canvas.runs() == before);
  }

  void laterEditOfACellWins() {
    BallBrush brush;
    brush.contrary = true;
    const StrokeSetup setup{{{0, 0, 0}, 1.0}, 2.5, {0, 1, 0}, {}};
    const std::vector<StrokeSample> samples{at(0, 0, 0)};
    const StrokeEdits edits = applyBrush(brush, setup, EditKind::Add, samples);
    QVERIFY(edits.removed.empty() && edits.added.contains({2, 0, 0}) && !edits.added.contains({3, 0, 0}));
    CellSet cells = cellsOf({{2, 0, 0}, {9, 9, 9}});
    applyBrush(brush, setup, EditKind::Remove, samples, cells);
    QVERIFY(cells == cellsOf({{9, 9, 9}}));
    applyBrush(brush, setup, EditKind::Add, samples, cells);
    QCOMPARE(cells.size(), edits.added.size() + 1);
  }

  void aFailingBrushChangesNothing() {
    BallBrush brush;
    brush.fails = true;
    const StrokeSetup setup{{{0, 0, 0}, 1.0}, 2.5, {0, 1, 0}, {}};
    const std::vector<StrokeSample> samples{at(0, 0, 0)};
    CellSet cells = cellsOf({{7, 7, 7}});
    QVERIFY_EXCEPTION_THROWN(applyBrush(brush, setup, EditKind::Add, samples, cells), std::runtime_error);
    QVERIFY(cells == cellsOf({{7, 7, 7}}));
    QVERIFY_EXCEPTION_THROWN(applyBrush(GreedyBrush(), setup, EditKind::Add, samples, cells), Error);
    QVERIFY(cells == cellsOf({{7, 7, 7}}));
  }

  void denseSamplesKnowTheWay() {
    const std::vector<StrokeSample> raw{at(0, 0, 0), at(2.5, 0, 0), at(2.5, 3, 0)};
    const std::vector<StrokeSample> dense = resampleStroke(raw, 1.0);
    QCOMPARE(dense.size(), size_t(7));  // 0 .. 5 and the end at 5.5
    const auto direction = [&](size_t k) { return vectorOf(dense[k].direction); };
    QCOMPARE(direction(0), Vector3(0, 0, 0));  // it has not moved yet
    for (const size_t k : {1u, 2u}) QCOMPARE(direction(k), Vector3(1, 0, 0));
    for (const size_t k : {3u, 4u, 5u, 6u}) QCOMPARE(direction(k), Vector3(0, 1, 0));
    // A hand that stands still goes on as it went.
    StrokeResampler resampler(1.0);
    for (const StrokeSample& s : {at(0, 0, 0), at(0.5, 0, 0), at(0.5, 0, 0)}) resampler.add(s);
    const std::vector<StrokeSample> end = resampler.finish();
    QCOMPARE(end.size(), size_t(1));
    QCOMPARE(vectorOf(end[0].direction), Vector3(1, 0, 0));
  }

  /// By the times of the raw samples: 2 m/s for long enough, and then at rest.
  void denseSamplesKnowHowFastTheHandIs() {
    StrokeResampler resampler(0.1);
    std::vector<StrokeSample> dense;
    for (int k = 0; k <= 60; ++k) {
      StrokeSample raw = at(2 * k / 60.0, 0, 0, 1, k / 60.0);
      raw.velocity = {7, 7, 7};  // nobody asks for it
      const std::vector<StrokeSample> more = resampler.add(raw);
      dense.insert(dense.end(), more.begin(), more.end());
    }
    QCOMPARE(vectorOf(dense.front().velocity), Vector3(0, 0, 0));
    QVERIFY((vectorOf(dense.back().velocity) - Vector3(2, 0, 0)).norm() < 1e-6);  // exp(-1 s / 0.05 s)
    for (size_t k = 1; k < dense.size(); ++k) QVERIFY(dense[k].velocity.x >= dense[k - 1].velocity.x);
    resampler.add(at(2, 0, 0, 1, 2));
    resampler.add(at(2.05, 0, 0, 1, 2));  // no time has passed: as fast as before
    QVERIFY(vectorOf(resampler.finish().at(0).velocity).norm() < 1e-6);
  }

  /// Within reach of the samples, in the directions of a turned sketch, at each of the copies.
  void aBrushSeesTheMatterWithinItsReach() {
    class Seeing final : public BallBrush, public api::SeeingBrush {
     public:
      double reach(const api::StrokeContext& c) const noexcept override { return c.matter ? 100 : far; }
      const void* extension(const char* name) const noexcept override {
        return std::string_view(name) == api::kSeesMatter ? static_cast<const api::SeeingBrush*>(this) : nullptr;
      }
      void stroke(const api::StrokeContext& c, EditKind, const api::List<StrokeSample>&,
                  api::EditSink&) const override {
        knows = c.matter != nullptr;
        for (size_t i = 0; knows && i < c.matter->count; ++i)
          seen.emplace_back(vectorOf(c.matter->position[i]), c.matter->temperature[i]);
      }
      double far = 1.5;
      mutable bool knows = false;
      mutable std::vector<std::pair<Vector3, float>> seen;
    } brush;
    StrokeSetup setup{{{0, 0, 0}, 1.0}, 0.5, {0, 1, 0}, {}};
    const std::vector<StrokeSample> samples{at(0, 0, 0), at(4, 0, 0)};
    applyBrush(brush, setup, EditKind::Add, samples);
    QVERIFY(!brush.knows);
    setup.matterWithin = [](const Vector3& centre, double radius) {
      SeenMatter all;
      for (const Vector3& place : {Vector3(0, 1, 0), Vector3(2, 0, 0), Vector3(5, 0, 0), Vector3(-4, 0, 0)}) {
        if ((place - centre).norm() > radius) continue;
        all.position.push_back(float4Of(place, 0));
        all.temperature.push_back(static_cast<float>(300 + place.x()));
        all.speed.push_back(0), all.phase.push_back(api::Phase::Solid), all.motion.push_back(api::Motion::Solid);
        all.body.push_back(0), all.material.push_back(0);
      }
      return all;
    };
    applyBrush(brush, setup, EditKind::Add, samples);
    const auto places = [&] { return std::exchange(brush.seen, {}); };
    QVERIFY((places() == std::vector<std::pair<Vector3, float>>{{{0, 1, 0}, 300.0F}, {{5, 0, 0}, 305.0F}}));
    setup.symmetry = VoxelShape::Symmetry{"x", 1, Vector3(0, 0, 0)};
    applyBrush(brush, setup, EditKind::Add, samples);
    QCOMPARE(places().size(), size_t{4});  // in the mirror what is at 0 again, and what is at -4
    setup.symmetry.reset();
    setup.grid.pose = {Quaternion(Eigen::AngleAxisd(M_PI / 2, Vector3(0, 0, 1))), {0, 1, 0}};
    applyBrush(brush, setup, EditKind::Add, std::vector{at(0, 0, 0)});  // stands at (0, 1, 0)
    const auto turned = places();
    QCOMPARE(turned.size(), size_t{1});
    QVERIFY(turned[0].first.norm() < 1e-6 && turned[0].second == 300.0F);
    brush.far = 11;
    QVERIFY_EXCEPTION_THROWN(applyBrush(brush, setup, EditKind::Add, samples), BrushFault);
  }

  void copiesLieInTheMirrorAndAboutTheAxis() {
    VoxelShape::Symmetry symmetry;
    QCOMPARE(imagesOf(symmetry).size(), size_t(1));
    symmetry.centre = Vector3(1, 0, 0);
    symmetry.turns = 4;
    const Vector3 place(3, 5, 0);
    const std::vector<SketchImage> turned = imagesOf(symmetry);
    QCOMPARE(turned.size(), size_t(4));
    const Vector3 about[] = {{3, 5, 0}, {1, 5, -2}, {-1, 5, 0}, {1, 5, 2}};
    for (size_t k = 0; k < 4; ++k) QVERIFY((turned[k].of(place) - about[k]).norm() < 1e-12);
    symmetry.mirror = "y";
    const std::vector<SketchImage> both = imagesOf(symmetry);
    QCOMPARE(both.size(), size_t(8));
    for (size_t k = 0; k < 4; ++k)
      QVERIFY((both[4 + k].of(place) - about[k].cwiseProduct(Vector3(1, -1, 1))).norm() < 1e-12);
    // Directions turn, but do not move.
    const std::vector<StrokeSample> image = imageOf({{{3, 5, 0}, 1, 0, {1, 0, 0}}}, turned[1]);
    QVERIFY((vectorOf(image[0].direction) - Vector3(0, 0, -1)).norm() < 1e-12);
  }

  void aStrokeIsDrawnWithItsCopies() {
    StrokeSetup setup{{{0.5, 0.5, 0.5}, 1.0}, 2, {0, 1, 0}, {}};
    setup.symmetry = VoxelShape::Symmetry{"x", 1, Vector3(0, 0, 0)};
    const std::vector<StrokeSample> samples{at(5.3, 0.2, 0.7)};
    const CellSet cells = applyBrush(BallBrush(), setup, EditKind::Add, samples).added;
    setup.symmetry.reset();
    const CellSet alone = applyBrush(BallBrush(), setup, EditKind::Add, samples).added;
    QCOMPARE(cells.size(), 2 * alone.size());
    for (const Cell& cell : alone.cells())
      QVERIFY(cells.contains(cell) && cells.contains({-1 - cell.x, cell.y, cell.z}));
  }

  void savedStrokeIsDrawnAgain() {
    VoxelShape::Stroke stroke;
    stroke.radius = 2;
    stroke.samples = {{0, 0, 0, 1, 0}, {10, 0, 0, 1, 0.5}};
    const SketchGrid grid{{0, 0, 0}, 1.0};
    const StrokeEdits edits = replayStroke(BallBrush(), stroke, grid);
    for (int x = -2; x <= 12; ++x) QVERIFY(edits.added.contains({x, 0, 0}));  // no gap over ten cells
    QVERIFY(!edits.added.contains({13, 0, 0}));
    stroke.erase = true;
    QVERIFY(replayStroke(BallBrush(), stroke, grid).removed == edits.added);
  }

  void aSketchIsDrawnAgainFromItsStrokes() {
    const BallBrush ball;
    const BrushOf brushOf = [&](const std::string& id) { return id == "ball" ? &ball : nullptr; };
    VoxelShape::Stroke stroke;
    stroke.brush = "ball";
    stroke.radius = 3;
    stroke.palette = 1;
    stroke.samples = {{0, 0, 0, 1, 0}, {8, 0, 0, 1, 1}};
    VoxelShape::Stroke eraser = stroke;
    eraser.erase = true;
    eraser.radius = 1;
    eraser.samples = {{4, 3, 0, 1, 0}};
    VoxelShape shape;
    shape.spacing = 1;
    shape.strokes = {stroke, eraser};
    shape.runs = {{40, 40, 40, 1, 0}};  // of no stroke
    const SketchGrid grid{{0, 0, 0}, 1.0};
    const FreeOf all = [](const SketchGrid&, const CellSet& some) { return some; };
    const VoxelShape again = redrawn(shape, 1, all, brushOf);
    CellSet cells = replayStroke(ball, stroke, grid).added;
    QVERIFY(cells.contains({4, 3, 0}));
    cells.remove(replayStroke(ball, eraser, grid).removed.cells());
    QVERIFY(VoxelCanvas(again.runs).cells() == cells);
    for (const VoxelShape::Run& run : again.runs) QCOMPARE(run.palette, 1);
    // A hidden stroke draws nothing, and its brush may be missing.
    shape.strokes[1].hidden = true;
    shape.strokes[1].brush = "gone";
    QVERIFY(VoxelCanvas(redrawn(shape, 1, all, brushOf).runs).cells() == replayStroke(ball, stroke, grid).added);
    shape.strokes[1] = eraser;
    // What others hold stays free; the order of strokes counts; half the spacing has eight times the cells, nearly.
    const FreeOf butTwo = [](const SketchGrid&, CellSet some) {
      some.remove(cellsOf({{0, 0, 0}, {1, 0, 0}}).cells());
      return some;
    };
    QCOMPARE(VoxelCanvas(redrawn(shape, 1, butTwo, brushOf).runs).size(), cells.size() - 2);
    std::swap(shape.strokes[0], shape.strokes[1]);
    QCOMPARE(VoxelCanvas(redrawn(shape, 1, all, brushOf).runs).size(), replayStroke(ball, stroke, grid).added.size());
    shape.strokes.pop_back();
    shape.strokes[0] = stroke;
    const double coarse = static_cast<double>(VoxelCanvas(redrawn(shape, 0.5, all, brushOf).runs).size());
    const double fine = static_cast<double>(VoxelCanvas(redrawn(shape, 0.25, all, brushOf).runs).size());
    QVERIFY2(std::abs(fine / coarse - 8) < 0.8, qPrintable(QString::number(fine / coarse)));  // the rim's cells: 1 / 12
    shape.strokes[0].brush = "gone";
    QVERIFY_EXCEPTION_THROWN(redrawn(shape, 1, all, brushOf), InputError);
  }

  void whatIsTooMuchToFillSaysWhatToDo() {
    const FreeOf endless = [](const SketchGrid&, const CellSet& cells) { return cells; };
    try {
      flooded({{0.5, 0.5, 0.5}, 0.1}, cellsOf({{0, 3, 0}}), {}, Vector3(0, -9.81, 0), endless);
      QFAIL("it has no end");
    } catch (const InputError& error) {
      const QString said = QString::fromUtf8(error.what());
      for (const char* way : {"32,768 particles", "Close the gap", "another stroke", "spacing larger"})
        QVERIFY2(said.contains(QString::fromLatin1(way)), qPrintable(said));
    }
  }

  /// Two arms joined at the bottom, 4 cells high, one cell thick all around, between panes: they run full to one level,
  /// whichever arm one points into, as by pieces of a stroke that rises; what is above the rim runs out.
  void hollowsRunFull() {
    const FreeOf open = [](const SketchGrid&, const CellSet& cells) {
      std::vector<Cell> free;
      for (const Cell& c : cells.cells()) {
        if (!isWall(c) && std::abs(c.z) < 2 && std::abs(c.x) < 60 && std::abs(c.y) < 60) free.push_back(c);
      }
      return CellSet(free);
    };
    const SketchGrid grid{{0.5, 0.5, 0.5}, 0.1};
    const Vector3 gravity(0, -9.81, 0);
    const CellSet left = flooded(grid, cellsOf({{0, 3, 0}}), {}, gravity, open);
    QCOMPARE(left.size(), size_t{3 * (4 * 4 + 1)});  // two arms, each two cells wide, and what joins them
    for (const Cell& c : left.cells()) QVERIFY(c.y >= 0 && c.y <= 3 && !isWall(c));
    QVERIFY(flooded(grid, cellsOf({{4, 3, 1}}), {}, gravity, open) == left);
    CellSet pieces;
    for (int y = 0; y <= 3; ++y) {
      const CellSet more = flooded(grid, cellsOf({{3, y, 0}, {3, 0, 0}}), pieces, gravity, open);
      for (const Cell& c : more.cells()) QVERIFY(c.y == y && !pieces.contains(c));
      pieces.add(more.cells());
    }
    QVERIFY(pieces == left);
    // In matter it is what lies above that runs full; with nothing free there it is nothing.
    QVERIFY(flooded(grid, cellsOf({{0, -1, 0}}), {}, gravity, open) ==
            flooded(grid, cellsOf({{0, 0, 0}}), {}, gravity, open));
    QVERIFY(flooded(grid, cellsOf({{2, 3, 0}}), {}, gravity, open).empty());
    QVERIFY_EXCEPTION_THROWN(flooded(grid, cellsOf({{0, 3, 0}}), {}, gravity, open, 10), InputError);
    // What the stroke has filled by then counts as well.
    QCOMPARE(flooded(grid, cellsOf({{0, 3, 0}}), {}, gravity, open, left.size()).size(), left.size());
    QVERIFY_EXCEPTION_THROWN(flooded(grid, cellsOf({{0, 3, 0}}), cellsOf({{90, 0, 0}}), gravity, open, left.size()),
                             InputError);
    Progress progress;
    progress.cancel();
    {
      const ProgressScope scope(&progress);
      QVERIFY_EXCEPTION_THROWN(flooded(grid, cellsOf({{0, 3, 0}}), {}, gravity, open), Cancelled);
    }
    // Over the rim everything outside fills as well, down to the bottom of the scene.
    QVERIFY(flooded(grid, cellsOf({{0, 5, 0}}), {}, gravity, open).size() > 10000);
    const FreeOf endless = [](const SketchGrid&, const CellSet& cells) { return cells; };
    QVERIFY_EXCEPTION_THROWN(flooded(grid, cellsOf({{0, 5, 0}}), {}, gravity, endless), InputError);
    // Where down is along x it stands against the other side.
    const CellSet aside = flooded(grid, cellsOf({{0, 2, 0}}), {}, {9.81, 0, 0}, open);
    QVERIFY(std::all_of(aside.cells().begin(), aside.cells().end(), [](const Cell& c) { return c.x >= 0; }));
    QVERIFY(aside.size() > 3 * 4);
    // Without gravity it stands upright; in a turned sketch it is level all the same.
    QVERIFY(flooded(grid, cellsOf({{0, 3, 0}}), {}, {0, 0, 0}, open) == left);
    const SketchGrid turned{
        grid.origin, grid.spacing, {Quaternion(Eigen::AngleAxisd(0.5, Vector3(0, 0, 1))), {0.3, 0, 0}}};
    const CellSet oblique = flooded(turned, cellsOf({{0, 2, 0}}), {}, gravity, open);
    const double level = turned.centreOf({0, 2, 0}).y();
    QVERIFY(oblique.size() > 10);
    for (const Cell& c : oblique.cells()) QVERIFY(!isWall(c) && turned.centreOf(c).y() < level + 1e-3);
    for (const Cell& c : left.cells()) {  // of its own arm all that lies as low
      if (c.x < 2 && turned.centreOf(c).y() < level) QVERIFY(oblique.contains(c));
    }
  }

  /// A cup of 5 x 5 cells and 6 high, in a scene that ends openly beyond its floor or at walls. It fills as high as its
  /// rim and no higher, with a hole as high as that: what would run out is refused. A box fills, and so does a tray.
  void whatIsOpenIsRefused_data() {
    QTest::addColumn<QString>("vessel");
    QTest::addColumn<bool>("room");  // walls around it
    QTest::addColumn<int>("seed");   // as high, in cells
    QTest::addColumn<int>("full");   // cells; -1: refused
    for (const bool room : {false, true}) {
      const auto row = [&](const char* vessel, int seed, int full) {
        QTest::addRow("%s, from %d%s", vessel, seed, room ? ", in a room" : "")
            << QString(vessel) << room << seed << full;
      };
      row("cup", 3, 25 * 3);
      row("cup", 6, 25 * 6);
      row("cup", 7, -1);
      row("holed", 2, 25 * 2);
      row("holed", 3, -1);
      row("holed", 6, -1);
      row("ring", 3, 25 * 4);  // on the floor, without a bottom
      row("box", 5, 25 * 5);
      row("box", 6, 25 * 6);
      row("floor", 0, room ? 20 * 20 : -1);
      row("floor", 4, room ? 20 * 20 * 5 : -1);
      row("cup, drowned", 16, room ? 20 * 20 * 17 - (7 * 7 * 7 - 25 * 6) : -1);
    }
  }
  void whatIsOpenIsRefused() {
    QFETCH(QString, vessel);
    QFETCH(bool, room);
    QFETCH(int, seed);
    QFETCH(int, full);
    Environment scene;
    scene.boundsMinimum = {-10, 0, -10}, scene.boundsMaximum = {10, 30, 10};
    const auto wall = [&](const Vector3& point, const Vector3& normal) {
      SceneWall& one = scene.walls.emplace_back();
      one.point = point, one.normal = normal;
    };
    wall({0, 0, 0}, {0, 1, 0});
    if (room) wall({-10, 0, 0}, {1, 0, 0}), wall({10, 0, 0}, {-1, 0, 0});
    if (room) wall({0, 0, -10}, {0, 0, 1}), wall({0, 0, 10}, {0, 0, -1});
    const auto isMatter = [&](const Cell& c) {
      const bool lid = c.y == 7 && vessel == "box", hole = vessel == "holed" && c.x == 3 && c.y == 3 && c.z == 0;
      if (vessel == "floor" || c.y > (lid ? 7 : 6) || std::max(std::abs(c.x), std::abs(c.z)) > 3 || hole) return false;
      return (c.y == 0 && vessel != "ring") || lid || std::max(std::abs(c.x), std::abs(c.z)) == 3;
    };
    const FreeOf freeOf = [&](const SketchGrid& grid, const CellSet& cells) {
      std::vector<Cell> free;
      for (const Cell& c : cells.cells()) {
        if (isInScene(scene, grid, c) && !isMatter(c)) free.push_back(c);
      }
      return CellSet(free);
    };
    const BarrierOf barrierOf = [&](const SketchGrid& grid, const Cell& cell) { return barrierIn(scene, grid, cell); };
    const SketchGrid grid{{0.5, 0.5, 0.5}, 1};
    const auto fill = [&](const Cell& from) {
      return flooded(grid, cellsOf({from}), {}, scene.gravity, freeOf, kMostFlooded, barrierOf);
    };
    for (const Cell& from : {Cell{0, seed, 0}, Cell{-2, seed, 2}}) {
      if (full < 0) {
        QVERIFY_EXCEPTION_THROWN(fill(from), InputError);
        if (vessel == "cup") QVERIFY_EXCEPTION_THROWN(fill({3, seed, 0}), InputError);  // on its rim
      } else {
        const CellSet wet = fill(from);
        QCOMPARE(static_cast<int>(wet.size()), full);
        for (const Cell& c : wet.cells()) QVERIFY(c.y <= seed);
      }
    }
    // So it is when it is drawn again.
    const SeedBrush brush;
    const BrushOf brushOf = [&](const std::string&) { return &brush; };
    VoxelShape sketch;
    sketch.origin = grid.origin, sketch.spacing = grid.spacing;
    VoxelShape::Stroke stroke;
    stroke.samples = {{0.5, seed + 0.5, 0.5, 1, 0, 0, 0, 0}};
    sketch.strokes = {stroke};
    const auto again = [&] { return redrawn(sketch, 1, freeOf, brushOf, scene.gravity, {}, barrierOf); };
    if (full < 0)
      QVERIFY_EXCEPTION_THROWN(again(), InputError);
    else
      QCOMPARE(static_cast<int>(VoxelCanvas(again().runs).size()), full);
  }

  /// What is filled becomes of the material, each cell as warm as it is; what is free stays free.
  void cellsArePainted() {
    VoxelShape shape;
    shape.palette = {{"ice", 260, {}}, {"ice", 250, {}}, {"tin", 250, {}}};
    shape.runs = {{0, 0, 0, 4, 0}, {0, 1, 0, 2, 1}, {2, 1, 0, 1, 2}};
    const Repainted painted = repainted(shape, cellsOf({{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 1, 0}, {9, 9, 9}}), "tin");
    QVERIFY(painted.added == (std::vector<VoxelShape::Paint>{{"tin", 260, {}}}));
    QVERIFY(painted.before == (std::vector<VoxelShape::Run>{{1, 0, 0, 2, 0}, {1, 1, 0, 1, 1}}));
    QVERIFY(painted.after == (std::vector<VoxelShape::Run>{{1, 0, 0, 2, 3}, {1, 1, 0, 1, 2}}));
    const std::vector<VoxelShape::Run> before = shape.runs;
    replaceRuns(shape, painted.after);
    QVERIFY(shape.runs == (std::vector<VoxelShape::Run>{
                              {0, 0, 0, 1, 0}, {1, 0, 0, 2, 3}, {3, 0, 0, 1, 0}, {0, 1, 0, 1, 1}, {1, 1, 0, 2, 2}}));
    replaceRuns(shape, painted.before);
    QVERIFY(shape.runs == before);
  }

  /// Edges and corners of a block go, faces stay, and a hollow is filled with what is around it.
  void blocksAreRounded() {
    VoxelShape shape;
    shape.palette = {{"ice", 260, {}}, {"tin", 250, {}}};
    for (int z = 0; z < 8; ++z) {
      for (int y = 0; y < 8; ++y) shape.runs.push_back({0, y, z, 8, y < 4 ? 0 : 1});
    }
    VoxelCanvas canvas(shape.runs);
    canvas.erase(cellsOf({{4, 7, 4}, {4, 0, 4}}));
    const CellSet before = canvas.cells();
    const Smoothed change =
        smoothed(canvas, cellsOf({{0, 0, 0}, {0, 0, 4}, {4, 7, 4}, {4, 0, 4}, {4, 4, 0}, {4, 8, 4}}));
    QVERIFY(change.emptied == cellsOf({{0, 0, 0}, {0, 0, 4}}));
    QVERIFY(change.filled.at(0) == cellsOf({{4, 0, 4}}) && change.filled.at(1) == cellsOf({{4, 7, 4}}));
    // All of it at once comes to the same as piece by piece, and keeps most of its matter.
    std::vector<Cell> all;
    for (int z = -2; z < 10; ++z) {
      for (int y = -2; y < 10; ++y) {
        for (int x = -2; x < 10; ++x) all.push_back({x, y, z});
      }
    }
    const Smoothed whole = smoothed(canvas, CellSet(all));
    CellSet emptied;
    for (size_t k = 0; k < all.size(); k += 100)
      emptied.add(
          smoothed(canvas, CellSet(std::span(all).subspan(k, std::min<size_t>(100, all.size() - k)))).emptied.cells());
    QVERIFY(emptied == whole.emptied);
    QVERIFY(emptied.size() > 60 && emptied.size() < before.size() / 4);
    QVERIFY(smoothed(canvas, {}).empty());
  }
  /// A sheet and a wall that stands on a block stay; a grain on a face goes.
  void whatIsThinStays() {
    VoxelShape shape;
    shape.palette = {{"ice", 260, {}}};
    for (int z = 0; z < 9; ++z) {
      for (int y = 0; y < 4; ++y) shape.runs.push_back({0, y, z, 9, 0});
    }
    for (int y = 4; y < 8; ++y) shape.runs.push_back({1, y, 4, 7, 0});
    shape.runs.push_back({6, 4, 7, 1, 0});
    for (int z = 0; z < 9; ++z) shape.runs.push_back({20, 5, z, 9, 0});
    const VoxelCanvas canvas(shape.runs);
    std::vector<Cell> upper;
    for (const Cell& cell : canvas.cells().cells()) {
      if (cell.y > 3) upper.push_back(cell);
    }
    // Of the wall the two lowest corners go, which lie on the block.
    QVERIFY(smoothed(canvas, CellSet(upper)).emptied == cellsOf({{6, 4, 7}, {1, 4, 4}, {7, 4, 4}}));
  }
  void smoothingIsDrawnAgain() {
    class Smoother final : public BallBrush {
     public:
      const void* extension(const char* name) const noexcept override {
        return std::string_view(name) == api::kSmoothsMatter ? this : nullptr;
      }
    };
    const BallBrush ball;
    const Smoother smoother;
    VoxelShape shape;
    shape.spacing = 1;
    shape.palette = {{"ice", 260, {}}};
    VoxelShape::Stroke drawn, smoothing;
    drawn.brush = "ball";
    drawn.radius = 3;
    drawn.samples = {{0, 0, 0, 1, 0}, {6, 0, 0, 1, 1}, {6, 6, 0, 1, 2}};
    smoothing = drawn;
    smoothing.brush = "smoother";
    shape.strokes = {drawn, smoothing};
    const SketchGrid grid{shape.origin, 1};
    VoxelCanvas canvas;
    canvas.paint(replayStroke(ball, drawn, grid).added, 0);
    const Smoothed change = smoothed(canvas, replayStroke(smoother, smoothing, grid).smoothed);
    QVERIFY(!change.empty());
    canvas.erase(change.emptied);
    for (const auto& [palette, cells] : change.filled) canvas.paint(cells, palette);
    const auto brushOf = [&](const std::string& id) -> const api::BrushPlugin* {
      return id == "ball" ? static_cast<const api::BrushPlugin*>(&ball) : &smoother;
    };
    const auto all = [](const SketchGrid&, const CellSet& cells) { return cells; };
    QVERIFY(redrawn(shape, 1, all, brushOf).runs == canvas.runs());
  }

  void theLaterEditOfACellWins() {
    class Painter final : public api::BrushPlugin {
     public:
      const char* label() const override { return "Painter"; }
      const char* help() const override { return ""; }
      api::ParameterList parameters() const override { return {}; }
      void stroke(const api::StrokeContext&, EditKind kind, const api::List<StrokeSample>&,
                  api::EditSink& sink) const override {
        const Cell cells[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
        sink.submit(EditKind::Add, {cells, 3});
        sink.submit(kind, {cells + 1, 2});
        sink.submit(EditKind::Remove, {cells + 2, 1});
      }
      api::Double3 extent(const api::StrokeContext&) const noexcept override { return {0, 0, 0}; }
      const void* extension(const char* name) const noexcept override {
        return std::string_view(name) == api::kPaintsMatter ? this : nullptr;
      }
    };
    const Painter painter;
    VoxelShape::Stroke stroke;
    stroke.samples = {{0, 0, 0, 1, 0}};
    StrokeEdits edits = replayStroke(painter, stroke, {{0, 0, 0}, 1.0});
    QVERIFY(edits.added == cellsOf({{0, 0, 0}}));
    QVERIFY(edits.painted == cellsOf({{1, 0, 0}}));
    QVERIFY(edits.of(EditKind::Remove) == cellsOf({{2, 0, 0}}));
    QVERIFY(kindOf(painter, true) == EditKind::Remove && kindOf(BallBrush(), false) == EditKind::Add);
  }

  void rayMeetsThePlane_data() {
    QTest::addColumn<double>("dx");
    QTest::addColumn<double>("dy");
    QTest::addColumn<bool>("meets");
    QTest::addColumn<double>("x");
    QTest::newRow("straight down") << 0.0 << -3.0 << true << 0.0;
    QTest::newRow("slanting") << 1.0 << -2.0 << true << 1.0;
    QTest::newRow("away") << 1.0 << 2.0 << false << 0.0;
    QTest::newRow("along") << 1.0 << 0.0 << false << 0.0;
    QTest::newRow("grazing") << 1.0 << -1e-5 << false << 0.0;
    QTest::newRow("no direction") << 0.0 << 0.0 << false << 0.0;
    QTest::newRow("not a number") << std::nan("") << -1.0 << false << 0.0;
  }
  void rayMeetsThePlane() {
    QFETCH(double, dx);
    QFETCH(double, dy);
    QFETCH(bool, meets);
    QFETCH(double, x);
    const auto hit = meet({{0, 2.5, 0}, {dx, dy, 0}}, {{7, 0.5, -3}, {0, 4, 0}});
    QCOMPARE(hit.has_value(), meets);
    if (!hit) return;
    QVERIFY(std::abs((*hit)[0] - x) < 1e-12 && std::abs((*hit)[1] - 0.5) < 1e-12);
    QVERIFY(!meet({{0, 2.5, 0}, {dx, dy, 0}}, {{7, 0.5, -3}, {0, 4, 0}}, 1.0));  // farther than the reach
  }

  /// A sketch that is moved takes along what its strokes were mirrored at.
  void strokesMoveWithTheirMirrors() {
    VoxelShape shape;
    shape.spacing = 0.02;
    shape.palette.resize(1);
    shape.runs = {{0, 0, 0, 3, 0}};
    VoxelShape::Stroke stroke;
    stroke.samples = {{0.1, 0.2, 0.3, 1, 0}};
    stroke.symmetry = VoxelShape::Symmetry{"x", 3, Vector3(0.5, 0, 0.25)};
    shape.strokes = {stroke};
    Body body;
    body.shape = shape;
    const Body after = moved(body, {Quaternion::Identity(), {0.04, 0.06, -0.02}});
    const auto& there = std::get<VoxelShape>(after.shape);
    QVERIFY((there.strokes[0].symmetry->centre - Vector3(0.54, 0.06, 0.23)).norm() < 1e-12);
    QVERIFY(std::abs(there.strokes[0].samples[0][0] - 0.14) < 1e-12);
  }

  /// To the bit: a plane may lie on faces of cells, and the pointer must not draw now above, now below it.
  void aPlaneAcrossAnAxisIsMetExactly() {
    for (int k = 1; k < 200; ++k) {
      const double level = 0.02 * k;
      const auto hit = meet({{0.1 * k, 7.3, 0.7}, {0.37, -1.0 - 0.01 * k, 0.013 * k}}, {{0, level, 0}, {0, 1, 0}});
      QVERIFY(hit);
      QCOMPARE((*hit)[1], level);
    }
  }

  /// What has no room before a wall or within the bounds is no cell to fill.
  void cellsHaveRoomInTheScene() {
    Environment environment;
    environment.boundsMinimum = {-1, -1, -1}, environment.boundsMaximum = {1, 1, 1};
    SceneWall floor;
    floor.point = {0, 0, 0}, floor.normal = {0, 2, 0};
    environment.walls = {floor};
    const SketchGrid grid{{0.05, 0.05, 0.05}, 0.1};
    QVERIFY(isInScene(environment, grid, {0, 0, 0}) && isInScene(environment, grid, {9, 9, 9}));
    QVERIFY(!isInScene(environment, grid, {0, -1, 0}) && !isInScene(environment, grid, {10, 0, 0}));
  }

  void drawingPlaneFacesTheViewer_data() {
    QTest::addColumn<QVector<double>>("view");
    QTest::addColumn<int>("axis");
    QTest::newRow("from above") << QVector<double>{0, -1, 0} << 1;
    QTest::newRow("20 degrees down") << QVector<double>{0, -0.342, -0.94} << 1;
    QTest::newRow("10 degrees down, along z") << QVector<double>{0.1, -0.174, -0.98} << 2;
    QTest::newRow("level, along x") << QVector<double>{-5, 0, 1} << 0;
  }
  void drawingPlaneFacesTheViewer() {
    QFETCH(QVector<double>, view);
    QFETCH(int, axis);
    const DrawingPlane plane = drawingPlaneFor({1, 2, 3}, {view[0], view[1], view[2]});
    QCOMPARE(plane.normal[size_t(axis)], view[size_t(axis)] > 0 ? -1.0 : 1.0);  // towards the viewer
    QCOMPARE(plane.point[2], 3.0);
  }
};

QTEST_APPLESS_MAIN(TestSketch)
#include "tst_sketch.moc"
