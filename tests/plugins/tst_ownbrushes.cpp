// SPDX-License-Identifier: Apache-2.0
// Our brushes that stamp shapes, follow how a pen or a hand is turned, and give matter colours.
#include "core/plugin_host/registry.h"
#include "core/scene/coat.h"
#include "core/scene/pose.h"
#include "core/sketch/redraw.h"
#include "core/sketch/stroke.h"
#include "core/sketch/symmetry.h"

#include <QtTest/QTest>

#include <algorithm>
#include <cmath>

using namespace ps;

namespace {

constexpr double kCell = 0.02;

/// A letter of 3 by 4 by 2 cells that looks like none of its turns or mirror images.
VoxelShape::Stamp letter() {
  VoxelShape::Stamp stamp;
  stamp.spacing = kCell;
  stamp.cells = {{4, 0, 7, 3, 0}, {4, 1, 7, 1, 0}, {4, 2, 7, 2, 0}, {4, 3, 7, 1, 0}, {4, 0, 8, 1, 0}};
  return stamp;
}
constexpr size_t kLetter = 8;

/// The cells from their lowest corner on.
CellSet fromCorner(const CellSet& cells) {
  api::Cell low{1 << 30, 1 << 30, 1 << 30};
  for (const api::Cell& c : cells.cells()) low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
  std::vector<api::Cell> moved;
  for (const api::Cell& c : cells.cells()) moved.push_back({c.x - low.x, c.y - low.y, c.z - low.z});
  return CellSet(moved);
}

api::StrokeSample sampleAt(const Vector3& place, const Vector3& turn = {0, 0, 0}) {
  return {double3Of(place), 1, 0, {}, {}, double3Of(turn)};
}

}  // namespace

class TestOwnBrushes : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  /// As it is: of as many cells in the same places to each other, wherever one clicks; its middle is there.
  void aCopyIsLikeTheBody() {
    const CellSet own = fromCorner(VoxelCanvas(letter().cells).cells());
    for (const Vector3& place : {Vector3(0, 0, 0), Vector3(0.01, 0.01, 0.01), Vector3(0.123, 0.456, -0.789)}) {
      const CellSet copy = drawn("stamp", setup("stamp"), {sampleAt(place)});
      QCOMPARE(copy.size(), kLetter);
      QVERIFY(fromCorner(copy) == own);
      Vector3 low = Vector3::Constant(HUGE_VAL), high = -low;
      for (const api::Cell& c : copy.cells()) {
        low = low.cwiseMin(setup("stamp").grid.centreOf(c));
        high = high.cwiseMax(setup("stamp").grid.centreOf(c));
      }
      QVERIFY(((0.5 * (low + high) - place).cwiseAbs().array() <= 0.5001 * kCell).all());
    }
    StrokeSetup none = setup("stamp");
    none.stamp = nullptr;
    QVERIFY(drawn("stamp", none, {sampleAt({0, 0, 0})}).empty());
    QVERIFY(m_plugins.needs("stamp", api::kStampsShape) && !m_plugins.needs("cube", api::kStampsShape));
  }

  /// By its own rotation, by that of the body, and by that of a pen it comes to the same; tipped it lies on its side.
  void aCopyIsTurned() {
    const Vector3 place(0.113, 0.217, 0.091);
    StrokeSetup turned = setup("stamp", {{"rotation", M_PI / 2}});
    const CellSet quarter = fromCorner(drawn("stamp", turned, {sampleAt(place)}));
    QCOMPARE(quarter.size(), kLetter);
    QVERIFY(!(quarter == fromCorner(VoxelCanvas(letter().cells).cells())));
    VoxelShape::Stamp stood = letter();
    stood.rotation = {0, -90, 0};  // from side to front, as brushes turn
    StrokeSetup body = setup("stamp");
    body.stamp = stampCells(stood);
    QVERIFY(fromCorner(drawn("stamp", body, {sampleAt(place)})) == quarter);
    const Vector3 twist(0, -M_PI / 2, 0);
    QVERIFY(fromCorner(drawn("stamp", setup("stamp"), {sampleAt(place, twist)})) == quarter);
    // What it does not follow turns nothing; tilt does only where the pose is followed.
    const CellSet upright = drawn("stamp", setup("stamp"), {sampleAt(place)});
    QVERIFY(drawn("stamp", setup("stamp", {{"follows", 0}}), {sampleAt(place, twist)}) == upright);
    const Vector3 tilt(M_PI / 2, 0, 0);
    QVERIFY(drawn("stamp", setup("stamp"), {sampleAt(place, tilt)}) == upright);
    const CellSet lying = fromCorner(drawn("stamp", setup("stamp", {{"follows", 2}}), {sampleAt(place, tilt)}));
    QVERIFY(fromCorner(drawn("stamp", setup("stamp", {{"tip", M_PI / 2}}), {sampleAt(place)})) == lying);
    QCOMPARE(highest(lying), 1);  // two cells thick, it lies
  }

  /// Twice as long is eight times as much; a hollow cube at half its size has closed walls still.
  void aCopyHasAnySize() {
    const CellSet large = drawn("stamp", setup("stamp", {{"scale", 2}}), {sampleAt({0, 0, 0})});
    QCOMPARE(large.size(), 8 * kLetter);
    StrokeSetup fits = setup("stamp", {{"fits", 1}});
    fits.radius = 4 * kCell;  // the letter is 4 cells high
    QCOMPARE(drawn("stamp", fits, {sampleAt({0, 0, 0})}).size(), 8 * kLetter);
    std::vector<api::Cell> shell;
    for (int k = 0; k < 1000; ++k) {
      const int x = k % 10, y = k / 10 % 10, z = k / 100;
      if (x % 9 == 0 || y % 9 == 0 || z % 9 == 0) shell.push_back({x, y, z});
    }
    StrokeSetup half = setup("stamp", {{"scale", 0.5}});
    VoxelShape::Stamp hollow;
    hollow.spacing = kCell;
    hollow.cells = encodeRuns(CellSet(shell), 0);
    half.stamp = stampCells(hollow);
    const CellSet small = fromCorner(drawn("stamp", half, {sampleAt({0.0123, 0.0234, 0.0345})}));
    const int last = highest(small);
    QVERIFY(last == 4 || last == 5);
    QVERIFY(!small.contains({2, 2, 2}));
    QVERIFY(isClosed(small, {2, 2, 2}, 8));
  }

  /// Side by side along the way of the hand, however that comes cut into calls, and in the mirror.
  void copiesStandSideBySide() {
    const std::vector<api::StrokeSample> raw{sampleAt({0.211, 0.012, 0.013}), sampleAt({0.211 + 0.25, 0.012, 0.013})};
    const std::vector<api::StrokeSample> dense = resampleStroke(raw, kCell);
    StrokeSetup row = setup("stamp");
    const CellSet whole = drawn("stamp", row, dense);
    QCOMPARE(whole.size(), 4 * kLetter);  // at 0, 80, 160 and 240 mm
    CellSet pieces;
    for (size_t k = 0; k < dense.size(); ++k) {
      const size_t first = k > 0 ? k - 1 : 0;
      applyBrush(*m_plugins.brush("stamp"), row, api::EditKind::Add, {dense.data() + first, k + 1 - first}, pieces);
    }
    QVERIFY(pieces == whole);
    row.symmetry = VoxelShape::Symmetry{"x", 1, Vector3(0, 0, 0)};
    const CellSet both = drawn("stamp", row, dense);
    QCOMPARE(both.size(), 8 * kLetter);
    for (const api::Cell& c : whole.cells()) QVERIFY(both.contains(c) && both.contains({-1 - c.x, c.y, c.z}));
    QCOMPARE(drawn("stamp", setup("stamp", {{"distance", 2}}), dense).size(), 2 * kLetter);
  }

  /// From the stroke alone, without the body; with half the spacing it is as large, of eight times the cells.
  void aStampIsDrawnAgainFromItsStroke() {
    VoxelShape::Stroke stroke;
    stroke.brush = "stamp";
    stroke.stamp = letter();
    stroke.stamp->rotation = {0, 30, 0};
    stroke.samples = {{0.3, 0.2, 0.1, 1, 0, 0, 0.4, 0}};
    VoxelShape sketch;
    sketch.spacing = kCell;
    sketch.palette = {{"water", 290}};
    sketch.strokes = {stroke};
    const FreeOf all = [](const SketchGrid&, const CellSet& some) { return some; };
    const BrushOf brushOf = [this](const std::string& id) { return m_plugins.brush(id); };
    const size_t coarse = VoxelCanvas(redrawn(sketch, kCell, all, brushOf).runs).size();
    QVERIFY2(coarse >= 5 && coarse <= 13, qPrintable(QString::number(coarse)));  // askew, of a few cells
    const size_t fine = VoxelCanvas(redrawn(sketch, kCell / 4, all, brushOf).runs).size();
    QVERIFY2(std::abs(static_cast<double>(fine) / (64 * kLetter) - 1) < 0.05, qPrintable(QString::number(fine)));
  }

  /// The pose of the pen reaches samples between those that were told, by the shorter way, and mirrored the other way.
  void turnsReachTheSamples() {
    const double angle = 170 * M_PI / 180;
    const std::vector<api::StrokeSample> raw{sampleAt({0, 0, 0}, {0, angle, 0}),
                                             sampleAt({4 * kCell, 0, 0}, {0, -angle, 0})};
    const std::vector<api::StrokeSample> dense = resampleStroke(raw, kCell);
    QCOMPARE(dense.size(), size_t{5});
    QVERIFY(std::abs(std::abs(dense[2].turn.y) - M_PI) < 1e-9);
    QVERIFY(std::abs(dense[1].turn.y - (angle + 5 * M_PI / 180)) < 1e-9);
    for (size_t k = 0; k < dense.size(); ++k) QVERIFY(std::abs(dense[k].way - static_cast<double>(k) * kCell) < 1e-12);
    const SketchImage mirror = imagesOf({"x", 1, {0, 0, 0}})[1];
    QVERIFY((vectorOf(imageOf(dense, mirror)[0].turn) - Vector3(0, -angle, 0)).norm() < 1e-12);
    QVERIFY((vectorOf(imageOf({sampleAt({0, 0, 0}, {angle, 0, 0})}, mirror)[0].turn) - Vector3(angle, 0, 0)).norm() <
            1e-12);
  }

  void sheetsAndCubesFollowThePen_data() {
    QTest::addColumn<QString>("brush");
    for (const char* brush : {"plane", "disc", "cube"}) QTest::newRow(brush) << brush;
  }
  /// A pen that leans by a quarter turn stands a level sheet up, where all of its pose is followed.
  void sheetsAndCubesFollowThePen() {
    QFETCH(QString, brush);
    const std::string id = brush.toStdString();
    const Vector3 lean(0, 0, M_PI / 4);
    StrokeSetup follows = setup(id.c_str(), {{"follows", 2}});
    follows.radius = 0.1;
    StrokeSetup keeps = setup(id.c_str());
    keeps.radius = 0.1;
    const CellSet level = drawn(id.c_str(), keeps, {sampleAt({0, 0, 0})});
    QVERIFY(drawn(id.c_str(), keeps, {sampleAt({0, 0, 0}, lean)}) == level);
    const CellSet leaning = drawn(id.c_str(), follows, {sampleAt({0, 0, 0}, lean)});
    const int height = highest(fromCorner(leaning));
    const int most = static_cast<int>(std::ceil((brush == "cube" ? 2 : 1) * 0.1 * 1.5 / kCell)) + 1;
    QVERIFY2(height > highest(fromCorner(level)) && height <= most, qPrintable(QString::number(height)));
  }

  /// It says which colour, as it is declared, or that matter is to have none.
  void coloursAreDeclared() {
    const api::BrushPlugin& tint = *m_plugins.brush("tint");
    QVERIFY(m_plugins.needs("tint", api::kColoursMatter));
    QVERIFY(kindOf(tint, false) == api::EditKind::Colour && kindOf(tint, true) == api::EditKind::Remove);
    const StrokeSetup red = setup("tint", {{"red", 1}, {"green", 0}, {"blue", 0.2}});
    QCOMPARE(colourOf(tint, red), std::string("#ff0033"));
    QCOMPARE(colourOf(tint, setup("tint", {{"bare", 1}})), std::string(kNoColour));
    QCOMPARE(colourOf(*m_plugins.brush("paint"), setup("paint")), std::string(kNoColour));
    const StrokeEdits edits = applyBrush(tint, red, kindOf(tint, false), std::vector{sampleAt({0, 0, 0})});
    QVERIFY(edits.coloured.size() > 10 && edits.painted.empty() && edits.added.empty());
    for (const char* coat : {"#ff0033", "#000000", "#", "#ffffff"})
      QCOMPARE(coatOf(colourNumber(coat)), std::string(coat));
    QCOMPARE(colourNumber("water"), 0U);
    QCOMPARE(colourNumber("#12345g"), 0U);
  }

  /// Of a sketch: the same materials and temperatures in other colours, given by a stroke and taken off by another.
  void aSketchIsColouredByItsStrokes() {
    VoxelShape::Stroke drawing, colouring, wiping;
    drawing.brush = "sphere", drawing.radius = 0.1, drawing.samples = {{0, 0, 0, 1, 0}};
    colouring.brush = "tint", colouring.radius = 0.08, colouring.samples = {{0.1, 0, 0, 1, 1}};
    colouring.parameters.values = {{"red", 0.0}, {"green", 1.0}, {"blue", 0.0}};
    wiping = colouring;
    wiping.parameters.values["bare"] = true;
    VoxelShape sketch;
    sketch.spacing = kCell;
    sketch.palette = {{"water", 260}};
    sketch.strokes = {drawing, colouring};
    const FreeOf all = [](const SketchGrid&, const CellSet& some) { return some; };
    const BrushOf brushOf = [this](const std::string& id) { return m_plugins.brush(id); };
    const VoxelShape green = redrawn(sketch, kCell, all, brushOf);
    QCOMPARE(green.palette.size(), size_t{2});
    QCOMPARE(green.palette[1].colour, std::string("#00ff00"));
    QVERIFY(green.palette[1].material == "water" && green.palette[1].temperature == 260);
    const auto inColour = [](const VoxelShape& shape, int palette) {
      size_t cells = 0;
      for (const VoxelShape::Run& run : shape.runs)
        cells += run.palette == palette ? static_cast<size_t>(run.length) : 0;
      return cells;
    };
    QVERIFY(inColour(green, 0) > 20 && inColour(green, 1) > 20);
    sketch.strokes.push_back(wiping);
    const VoxelShape bare = redrawn(sketch, kCell, all, brushOf);
    QCOMPARE(inColour(bare, 1), size_t{0});
    QCOMPARE(inColour(bare, 0), inColour(green, 0) + inColour(green, 1));
  }

 private:
  StrokeSetup setup(const char* brush, const std::map<std::string, double>& values = {}) const {
    StrokeSetup setup;
    setup.grid = {Vector3::Constant(kCell / 2), kCell};
    const api::ParameterList list = m_plugins.parameters(brush);
    for (size_t k = 0; k < list.count; ++k) {
      const auto found = values.find(list[k].key);
      setup.parameters.push_back(found == values.end() ? list[k].defaultValue : found->second);
    }
    setup.stamp = stampCells(letter());
    return setup;
  }
  CellSet drawn(const char* brush, const StrokeSetup& setup, const std::vector<api::StrokeSample>& samples) const {
    return applyBrush(*m_plugins.brush(brush), setup, api::EditKind::Add, samples).added;
  }
  /// Whether nothing leads from a cell beyond `far` cells, from face to face.
  static bool isClosed(const CellSet& walls, const api::Cell& from, int far) {
    CellSet seen(std::vector{from});
    std::vector<api::Cell> ahead{from};
    while (!ahead.empty()) {
      const api::Cell c = ahead.back();
      ahead.pop_back();
      if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) > far) return false;
      for (const api::Cell& next : {api::Cell{c.x + 1, c.y, c.z},
                                    {c.x - 1, c.y, c.z},
                                    {c.x, c.y + 1, c.z},
                                    {c.x, c.y - 1, c.z},
                                    {c.x, c.y, c.z + 1},
                                    {c.x, c.y, c.z - 1}}) {
        if (walls.contains(next) || seen.contains(next)) continue;
        seen.add(std::vector{next});
        ahead.push_back(next);
      }
    }
    return true;
  }
  static int highest(const CellSet& cells) {
    int most = 0;
    for (const api::Cell& c : cells.cells()) most = std::max(most, c.y);
    return most;
  }

  const PluginRegistry m_plugins{PluginRegistry::Options{}};
};

QTEST_GUILESS_MAIN(TestOwnBrushes)
#include "tst_ownbrushes.moc"
