// SPDX-License-Identifier: Apache-2.0
// Copies of bodies stamped into a scene, and matter that gets colours of its own, by tools without a widget.
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/scene/coat.h"
#include "core/simulation/projectstate.h"
#include "core/sketch/redraw.h"
#include "core/sketch/stampform.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/scenes.h"
#include "tests/ui/tooltesting.h"
#include "ui/document/stampof.h"
#include "ui/tools/handbrush.h"

#include <QtCore/QTemporaryDir>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

using namespace ps;

namespace {

constexpr double kSpacing = 0.03;

/// m3, of what its faces enclose: by the divergence of the place.
double volumeOf(const StampForm& form) {
  double volume = 0;
  for (const StampForm::Face& face : form.faces)
    volume += form.middle(face).dot(form.normal(face)) * form.spacing * form.spacing / 3;
  return volume;
}

}  // namespace

class TestStampAndTint : public ToolTest {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    Project project = scenes::iceOnPlate(5, 300, 100);
    project.environment = scenes::tray(0.9, 1.2);
    open(project);
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot() != nullptr; }));
  }
  void cleanup() { close(); }

  /// A straight way of the pointer is one of the brush, from where it was pressed on: on the floor, and in the air.
  void aStraightDragIsStraight_data() {
    QTest::addColumn<Vector3>("from");
    QTest::newRow("on the floor") << Vector3(-0.2, 0, 0.1);
    QTest::newRow("in the air") << Vector3(-0.2, 0.4, -0.3);
    QTest::newRow("far up") << Vector3(-0.4, 0.8, -0.3);
  }
  void aStraightDragIsStraight() {
    QFETCH(Vector3, from);
    take("tube", 0.04);
    Tool& tool = m_tools->tool();
    tool.hover(at(from));
    const Vector3 first = tool.picture().cursor->centre;
    tool.press(at(from));
    for (int k = 1; k <= 6; ++k) tool.drag(at(from + Vector3(0.06 * k, 0, 0)));
    tool.release(at(from + Vector3(0.36, 0, 0)));
    const auto& samples = std::get<VoxelShape>(m_document->project().bodies.back().shape).strokes.back().samples;
    QVERIFY(samples.size() > 5);
    for (const auto& sample : samples) {
      const Vector3 off = Vector3(sample[0], sample[1], sample[2]) - first;
      QVERIFY2(std::hypot(off.y(), off.z()) < 1e-9, qPrintable(QString::number(std::hypot(off.y(), off.z()))));
    }
  }

  /// The one that is selected, beside it; with undo, redo, its file, and drawn again without the body.
  void theSelectedBodyIsStamped() {
    take("stamp");
    QSignalSpy refused(m_tools.get(), &Toolbox::refused);
    m_selection->clear();
    press(kBeside);
    QCOMPARE(refused.count(), 1);
    QVERIFY(refused[0][1].toString().contains(QStringLiteral("Alt")));
    m_selection->selectBody("ice");
    QCOMPARE(m_tools->shapeName(), m_document->body("ice")->name);
    const size_t before = count();
    m_tools->tool().hover(at(kBeside));
    const auto cursor = m_tools->tool().picture().cursor;
    QVERIFY(cursor && cursor->box);
    QVERIFY((cursor->extent - Vector3::Constant(2.5 * kSpacing)).norm() < 1e-9);
    QVERIFY(m_tools->tool().words().contains(QStringLiteral("copies of")));
    press(kBeside);
    QCOMPARE(count(), before + 125);
    const std::string text = writeProject(m_document->project());
    QCOMPARE(writeProject(parseProject(text, "what was written", *m_plugins).project), text);
    const auto voxels = std::get<VoxelShape>(m_document->project().bodies.back().shape);
    QCOMPARE(voxels.strokes.size(), size_t{1});
    QVERIFY(voxels.strokes[0].stamp == std::optional(stampOf(*m_document->body("ice"), kSpacing)));
    m_document->undoStack().undo();
    QCOMPARE(count(), before);
    m_document->undoStack().redo();
    QCOMPARE(count(), before + 125);
    QCOMPARE(writeProject(m_document->project()), text);
    m_document->removeBody("ice");
    const FreeOf all = [](const SketchGrid&, const CellSet& some) { return some; };
    const BrushOf brushOf = [this](const std::string& id) { return m_plugins->brush(id); };
    QVERIFY(redrawn(voxels, kSpacing, all, brushOf).runs == voxels.runs);
  }

  /// It is filled beside the window, which may take a moment.
  void aMeshIsStamped() {
    Body cube = scenes::meshCube();
    cube.material = m_document->project().materials[0].id;
    const std::string id = m_document->addBody(cube);
    take("stamp");
    m_selection->selectBody(id);
    QTRY_VERIFY(m_tools->shape());
    QVERIFY(!m_tools->fillsShape());
    QVERIFY(m_tools->shape() == std::optional(stampOf(*m_document->body(id), kSpacing)));
    const size_t before = count();
    press(kBeside);
    QCOMPARE(count(), before + 64);  // 120 mm at 30 mm
  }

  /// Its surface holds as much as is drawn, and is closed; a box shows its edges, a ball its circle.
  void theCursorIsWhatIsStamped() {
    Body corner;
    corner.id = "corner", corner.material = m_document->project().materials[0].id;
    VoxelShape shape;
    shape.origin = {-0.4, 0.5, 0};
    shape.spacing = kSpacing;
    shape.palette.push_back({corner.material, 262});
    shape.runs = {{0, 0, 0, 4, 0}, {0, 1, 0, 1, 0}, {0, 2, 0, 1, 0}};
    corner.shape = shape;
    m_document->addBody(corner);
    take("stamp");
    m_selection->selectBody("ice");
    QVERIFY(!m_tools->form());
    m_selection->selectBody("corner");
    const auto form = m_tools->form();
    QVERIFY(form);
    QVERIFY2(std::abs(volumeOf(*form) / std::pow(kSpacing, 3) - 6) < 1e-9,
             qPrintable(QString::number(volumeOf(*form))));
    QCOMPARE(form->faces.size(), size_t{26});
    for (const StampForm::Edge& edge : form->edges) QCOMPARE(edge.faces.size() % 2, size_t{0});
    m_tools->tool().hover(at(kBeside));
    QVERIFY(m_tools->tool().picture().cursor->form == form);
    const size_t before = count();
    press(kBeside);
    QCOMPARE(count(), before + 6);
    // From the front it is an L: as long around as 14 edges of cells.
    QCOMPARE(form->outline({-1.5 * kSpacing, -kSpacing, 100}).size(), size_t{14});
  }

  void otherBrushesHaveTheirForms() {
    const auto formOf = [this](const char* brush, const char* key, const Value& value) {
      take(brush, 0.1);
      BrushSettings settings = m_tools->brush();
      if (key) settings.parameters[brush].values[key] = value;
      m_tools->setBrush(settings);
      return m_tools->form();
    };
    for (const char* round : {"sphere", "heat", "smooth"}) QVERIFY2(!formOf(round, nullptr, {}), round);
    QVERIFY(!formOf("cube", nullptr, {}));
    const auto disc = formOf("disc", nullptr, {});
    QVERIFY(disc);  // flat, where it was drawn as a ball
    for (const StampForm::Face& face : disc->faces) QVERIFY(std::abs(disc->middle(face).y()) < 0.51 * kSpacing);
    const auto turned = formOf("plane", "rotation", 0.785398);
    QVERIFY(turned);
    QVERIFY(std::abs(volumeOf(*turned) / (0.2 * 0.2 * kSpacing) - 1) < 0.2);
    take("disc", 0.5);
    QVERIFY(m_tools->form()->faces.size() <= 4000);
  }

  /// Alt with a click takes the shape of what is there, and its material.
  void altTakesTheShape() {
    take("stamp");
    m_selection->clear();
    Pointer pointer = at(kTop);
    pointer.alt = true;
    QVERIFY(!m_tools->tool().press(pointer));
    m_tools->tool().click(pointer);
    QCOMPARE(m_tools->shapeName(), m_document->body("ice")->name);
    QVERIFY(m_tools->shape() && !m_tools->shape()->cells.empty());
  }

  /// A solid of any kind is what it is filled with, at its own turn.
  void solidsAreStamped() {
    Body solid;
    solid.id = "ring", solid.material = m_document->project().materials[0].id;
    SolidShape shape;
    shape.parameters.values = {
        {"kind", std::string("block")}, {"size_x", 0.3},     {"size_y", 0.06},    {"size_z", 0.12},
        {"position_x", -0.4},           {"position_y", 0.5}, {"rotation_y", 90.0}};
    solid.shape = shape;
    m_document->addBody(solid);
    const VoxelShape::Stamp stamp = stampOf(*m_document->body("ring"), kSpacing);
    QCOMPARE(stamp.rotation, Vector3(0, 90, 0));
    size_t cells = 0;
    for (const VoxelShape::Run& run : stamp.cells) cells += static_cast<size_t>(run.length);
    QCOMPARE(cells, size_t{10 * 2 * 4});
    take("stamp");
    m_selection->selectBody("ring");
    const Vector3 half = m_tools->stamp().first;  // turned: along z now
    QVERIFY2((half - Vector3(0.06, 0.03, 0.15)).norm() < 1e-9, qPrintable(QString::number(half.z())));
  }

  /// B is the brush that draws; an eraser keeps the stamp, to take copies away.
  void theBrushPutsTheStampAside() {
    take("cube");
    m_tools->takeBrush("stamp");
    QVERIFY(m_tools->stampsShape());
    m_tools->activate(kEraseTool);
    QVERIFY(m_tools->stampsShape());
    m_tools->activate(kBrushTool);
    QCOMPARE(m_tools->brush().shape, std::string("cube"));
  }

  /// What makes the brush larger makes the copies so; where these go by the brush's radius, that.
  void theStampIsMadeLarger() {
    take("stamp");
    m_selection->selectBody("ice");
    const double half = m_tools->stamp().first.x(), radius = m_tools->brush().radius;
    m_tools->stepBrush(1);
    QVERIFY(std::abs(m_tools->stamp().first.x() / half - kBrushStep) < 1e-9);
    QCOMPARE(m_tools->brush().radius, radius);
    QVERIFY(m_tools->brushSizeText().startsWith(QStringLiteral("112")));
    QVERIFY(m_tools->tool().words().contains(QStringLiteral("scale 112")));
    m_tools->stepBrush(-1);
    QVERIFY(std::abs(m_tools->stamp().first.x() / half - 1) < 1e-9);
    BrushSettings brush = m_tools->brush();
    brush.parameters["stamp"].values["fits"] = true;
    m_tools->setBrush(brush);
    m_tools->stepBrush(1);
    QVERIFY(std::abs(m_tools->brush().radius / radius - kBrushStep) < 1e-9);
    QCOMPARE(m_tools->brushSizeName(), QStringLiteral("Radius"));
  }

  /// A hand in VR that is turned puts it so, by the same code; the stroke keeps how it was held.
  void aTurnedHandStampsTurned() {
    take("stamp");
    m_selection->selectBody("ice");
    HandBrush hand(*m_tools);
    const double angle = M_PI / 6;
    const Vector3 forward(-std::sin(angle), 0, -std::cos(angle));
    hand.follow({Vector3(0.3, 0.3, 0.2), {0, 1, 0}, forward, 1, false, 0}, m_engine->snapshot());
    hand.follow({Vector3(0.3, 0.3, 0.2), {0, 1, 0}, forward, 0, false, 0.1}, m_engine->snapshot());
    const auto& voxels = std::get<VoxelShape>(m_document->project().bodies.back().shape);
    QCOMPARE(voxels.strokes.size(), size_t{1});
    const auto& sample = voxels.strokes[0].samples.front();
    QVERIFY((Vector3(sample[5], sample[6], sample[7]) - Vector3(0, angle, 0)).norm() < 1e-9);
    int widest = 0;  // a square on its corner is wider than its side
    for (const VoxelShape::Run& run : voxels.runs) widest = std::max(widest, run.length);
    QVERIFY2(widest >= 6, qPrintable(QString::number(widest)));
  }

  /// Before the first step the body has the colour, which a reset, undo and the file keep to.
  void atTheStartBodiesAreColoured() {
    const uint64_t before = hash();
    const std::string text = writeProject(m_document->project());
    takeTint();
    press(kTop);
    const size_t some = coloured();
    QVERIFY(some > 4);
    QVERIFY(hash() != before);
    const std::string after = writeProject(m_document->project());
    QVERIFY(after.find("\"#ff8000\"") != std::string::npos);
    QCOMPARE(writeProject(parseProject(after, "what was written", *m_plugins).project), after);
    m_document->undoStack().undo();
    QCOMPARE(coloured(), size_t{0});
    QCOMPARE(hash(), before);
    QVERIFY(m_document->project().bodies[0].shape == parseProject(text, "before", *m_plugins).project.bodies[0].shape);
    m_document->undoStack().redo();
    QCOMPARE(coloured(), some);
    m_link->reset();
    QCOMPARE(coloured(), some);
    QCOMPARE(writeProject(m_document->project()), after);
    m_engine->stepOnce();
    m_document->undoStack().undo();
    QCOMPARE(coloured(), size_t{0});
    m_document->undoStack().redo();
    QCOMPARE(coloured(), some);
  }

  /// In the run it is matter alone, which keeps its colour in a state, as in what is recorded; a second coat goes over
  /// the first, and each undo takes its own.
  void inARunMatterIsColoured() {
    m_engine->stepOnce();
    QVERIFY(QTest::qWaitFor([&] { return m_engine->snapshot()->stats.frame == 1; }));
    const std::string text = writeProject(m_document->project());
    const uint64_t before = hash();
    takeTint();
    press(kTop);
    const size_t some = coloured();
    QVERIFY(some > 4);
    QCOMPARE(writeProject(m_document->project()), text);
    const uint64_t first = hash();
    BrushSettings brush = m_tools->brush();
    brush.parameters["tint"].values["blue"] = 1.0;
    m_tools->setBrush(brush);
    press(kTop + Vector3(0.03, 0, 0));
    QVERIFY(hash() != first);
    Project saved = m_document->project();
    saved.state = tests::onEngine<std::shared_ptr<const ProjectState>>(*m_engine, [](Engine& engine) {
      StateBuffer stream;
      saveTo(stream, engine);
      return projectState(stream.bytes(), engine.project().bodies);
    });
    const Project again = parseProject(writeProject(saved), "with its state", *m_plugins).project;
    Engine reopened(again, *m_plugins);
    QCOMPARE(reopened.stateHash(), hash());
    QVERIFY(reopened.snapshot()->colour == m_engine->snapshot()->colour);
    m_document->undoStack().undo();
    QCOMPARE(hash(), first);
    QCOMPARE(coloured(), some);
    m_document->undoStack().undo();
    QCOMPARE(coloured(), size_t{0});
    QCOMPARE(hash(), before);
    m_document->undoStack().redo();
    QCOMPARE(hash(), first);
  }

  /// Frames of a file show it, before it was coloured, in one colour and in two, as the run did.
  void recordedFramesHaveTheColours() {
    QTemporaryDir folder;
    const std::string file = folder.filePath(QStringLiteral("run.psrec")).toStdString();
    std::vector<std::map<uint32_t, uint32_t>> shown;
    RecordingWriter writer(file, m_document->project());
    const auto look = [&] {
      m_engine->stepOnce();
      const auto colours = tests::onEngine<std::map<uint32_t, uint32_t>>(*m_engine, [&writer](Engine& engine) {
        const SnapshotPtr now = engine.snapshot();
        writer.add(*now);
        return byId(*now);
      });
      shown.push_back(colours);
    };
    look();
    takeTint();
    press(kTop);
    look();
    BrushSettings brush = m_tools->brush();
    brush.parameters["tint"].values["blue"] = 1.0;
    m_tools->setBrush(brush);
    press(kTop + Vector3(0.06, 0, 0));
    for (int k = 0; k < 10; ++k) look();
    writer.finish();
    const RecordingReader reader(file, *m_plugins);
    QCOMPARE(reader.frameCount(), shown.size());
    for (size_t k = 0; k < shown.size(); ++k) QVERIFY(byId(*reader.frame(k)) == shown[k]);
    std::set<uint32_t> all;
    for (const auto& [id, colour] : shown.back()) all.insert(colour);
    QCOMPARE(all, std::set<uint32_t>({0, 0xffff8000, 0xffff80ff}));
    for (const auto& [id, colour] : shown.front()) QCOMPARE(colour, 0U);
  }

  /// Matter that is drawn on a coloured body has no colour itself, and what takes colours off leaves all else.
  void coloursComeOffAgain() {
    const uint64_t before = hash();
    takeTint();
    press(kTop);
    QVERIFY(coloured() > 0);
    BrushSettings brush = m_tools->brush();
    brush.parameters["tint"].values["bare"] = true;
    m_tools->setBrush(brush);
    press(kTop);
    QCOMPARE(coloured(), size_t{0});
    QCOMPARE(hash(), before);
    m_document->undoStack().undo();
    QVERIFY(coloured() > 0);
  }

 private:
  static const Vector3 kTop, kBeside;

  static std::map<uint32_t, uint32_t> byId(const Snapshot& snapshot) {
    std::map<uint32_t, uint32_t> colours;
    for (size_t i = 0; i < snapshot.id.size(); ++i)
      colours[snapshot.id[i]] = snapshot.colour.empty() ? 0 : snapshot.colour[i];
    return colours;
  }

  void takeTint() {
    take("tint");
    BrushSettings brush = m_tools->brush();
    brush.parameters["tint"].values = {{"red", 1.0}, {"green", 0.5}, {"blue", 0.0}};
    m_tools->setBrush(brush);
  }
  void press(const Vector3& place) {
    m_tools->tool().press(at(place));
    m_tools->tool().release(at(place));
  }
  size_t count() {
    return tests::onEngine<size_t>(*m_engine, [](Engine& engine) { return engine.particles().size(); });
  }
  size_t coloured() {
    return tests::onEngine<size_t>(*m_engine, [](Engine& engine) {
      const std::vector<uint32_t> colours = engine.snapshot()->colour;
      return colours.size() - static_cast<size_t>(std::count(colours.begin(), colours.end(), 0U));
    });
  }
  uint64_t hash() {
    return tests::onEngine<uint64_t>(*m_engine, [](Engine& engine) { return engine.stateHash(); });
  }
};

const Vector3 TestStampAndTint::kTop{0, 0.15, 0};
const Vector3 TestStampAndTint::kBeside{0.25, 0, 0.2};

QTEST_GUILESS_MAIN(TestStampAndTint)
#include "tst_stampandtint.moc"
