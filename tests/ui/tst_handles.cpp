// SPDX-License-Identifier: Apache-2.0
// Bodies and whatever has a place are moved, turned and stretched by their handles in the real window; their matter
// goes along while it runs.
#include "core/scene/pose.h"
#include "core/scene/solidform.h"
#include "tests/ui/gizmohands.h"
#include "tests/ui/hands.h"
#include "tests/ui/paintedtexts.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/tools/gizmo.h"
#include "ui/tools/picking.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/gizmopainter.h"
#include "ui/viewport/viewport.h"
#include "ui/window/statusline.h"

#include <QtGui/QAction>
#include <QtGui/QMouseEvent>
#include <QtGui/QPainter>
#include <QtWidgets/QTreeView>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace ps;

namespace {

constexpr const char* kIce = "ice";

Vector3 matterOf(const Engine& engine, const std::string& body) {
  const ParticleStore& store = engine.particles();
  Vector3 sum;
  double count = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    if (engine.bodyIds()[store.body()[i]] == body) sum += vectorOf(store.position()[i]), ++count;
  }
  return sum / count;
}

}  // namespace

class TestHandles : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    backToTheStart();
    m_window->tools().setHandles({});
  }
  void cleanupTestCase() { m_window.reset(); }

  void keysTakeTheHandles() {
    for (const auto& [key, tool] : {std::pair(Qt::Key_W, "move"), {Qt::Key_R, "rotate"}, {Qt::Key_S, "scale"}}) {
      QTest::keyClick(view(), key);
      QCOMPARE(m_window->tools().active(), std::string(tool));
      QTest::keyClick(view(), Qt::Key_Escape);
      QCOMPARE(m_window->tools().active(), std::string("select"));
    }
  }

  /// A notice of the window lies over the top of the view.
  void whatIsSaidStandsBelowANotice_data() {
    QTest::addColumn<double>("covered");
    QTest::newRow("nothing lies there") << 0.0;
    QTest::newRow("a notice lies there") << 44.0;
  }
  void whatIsSaidStandsBelowANotice() {
    QFETCH(double, covered);
    GizmoPicture picture;
    picture.note = QStringLiteral("It is locked");
    TextDevice device(view()->size());
    {
      QPainter painter(&device);
      paintGizmo(painter, picture, view()->navigator().camera(), view()->size(), covered);
      paintNote(painter, picture.note, view()->size(), covered);
    }
    QCOMPARE(device.texts.size(), qsizetype{2});
    for (const PaintedText& text : device.texts)
      QVERIFY(text.place.top() > covered && text.place.bottom() < covered + 40);
    selectIce("move");
    picture.gizmo = handles();
    picture.active = GizmoPart{GizmoPart::Kind::Arm, 0};
    const double field = gizmoField(picture, view()->navigator().camera(), view()->size(), covered).top();
    QVERIFY(field > covered);
    const double low = field + 20;  // where it would stand is covered
    QVERIFY(gizmoField(picture, view()->navigator().camera(), view()->size(), low).top() > low);
  }

  void anArmMovesABodyWithItsMatter() {
    selectIce("move");
    const Vector3 before = pivotOf(ice()), matter = iceMatter();
    QVERIFY((handles().centre - matter).norm() < 1e-4);
    const int steps = document().undoStack().index();
    viewPicture(QStringLiteral("handles-move.png"));
    dragPart({GizmoPart::Kind::Arm, 0}, {40, 0});
    const Vector3 way = pivotOf(ice()) - before;
    QVERIFY(std::abs(way.x()) > 0.01 && way.y() == 0 && way.z() == 0);
    QVERIFY((iceMatter() - matter - way).norm() < 1e-5);
    QCOMPARE(document().undoStack().index(), steps + 1);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("moving Ice block"));
    document().undoStack().undo();
    QVERIFY((iceMatter() - matter).norm() < 1e-5);
    QCOMPARE(pivotOf(ice()), before);
    document().undoStack().redo();
    QVERIFY((iceMatter() - matter - way).norm() < 1e-5);
  }

  /// While it falls: matter and document go by as much, wherever each is.
  void itIsMovedWhileItRuns() {
    selectIce("move");
    const Vector3 before = pivotOf(ice());
    dragPart({GizmoPart::Kind::Arm, 1}, {0, -60});
    QVERIFY(pivotOf(ice()).y() > before.y() + 0.02);
    for (int frame = 0; frame < 4; ++frame) session().step();
    const double speed = onEngine<double>(session(), [](Engine& engine) { return engine.stats().kineticEnergy; });
    const Vector3 matter = iceMatter(), body = pivotOf(ice());
    view()->update();
    QTRY_VERIFY_WITH_TIMEOUT((handles().centre - matter).norm() < 1e-4, kLong);
    dragPart({GizmoPart::Kind::Arm, 2}, {-40, 20});
    const Vector3 way = pivotOf(ice()) - body;
    QVERIFY(way.norm() > 0.01);
    QVERIFY((iceMatter() - matter - way).norm() < 1e-5);
    const double after = onEngine<double>(session(), [](Engine& engine) { return engine.stats().kineticEnergy; });
    QVERIFY(std::abs(after - speed) <= 1e-6 * speed);
  }

  void numbersAreTypedWhileDragging() {
    selectIce("move");
    const Vector3 before = pivotOf(ice());
    const QPoint at = middleOf({GizmoPart::Kind::Arm, 0});
    const std::string colour = document().project().view.colour;
    dragPart({GizmoPart::Kind::Arm, 0}, {20, 0}, {}, false);
    const Vector3 dragged = pivotOf(ice());
    QTest::keyClicks(view(), QStringLiteral("25 mm"));
    QCOMPARE(m_window->tools().tool().picture().gizmo->value, QStringLiteral("25 mm"));
    QTest::mouseMove(view(), at + QPoint(60, 0));  // the pointer leads no more
    QCOMPARE(pivotOf(ice()), dragged);
    viewPicture(QStringLiteral("handles-typing.png"));
    for (int k = 0; k < 5; ++k) QTest::keyClick(view(), Qt::Key_Backspace);
    QTest::keyClicks(view(), QStringLiteral("-1/20"));
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY((pivotOf(ice()) - before + Vector3(0.05, 0, 0)).norm() < 1e-12);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, at + QPoint(60, 0));
    QVERIFY((pivotOf(ice()) - before + Vector3(0.05, 0, 0)).norm() < 1e-12);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("moving Ice block"));
    QCOMPARE(document().project().view.colour, colour);
    document().undoStack().undo();
    QCOMPARE(pivotOf(ice()), before);
  }

  void escapeTakesItBack() {
    selectIce("move");
    const Vector3 before = pivotOf(ice()), matter = iceMatter();
    const int steps = document().undoStack().index();
    dragPart({GizmoPart::Kind::Plane, 1}, {50, 10}, {}, false);
    QVERIFY(pivotOf(ice()) != before);
    QTest::keyClick(view(), Qt::Key_Escape);
    QCOMPARE(pivotOf(ice()), before);
    QVERIFY((iceMatter() - matter).norm() < 1e-5);
    QCOMPARE(document().undoStack().index(), steps);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, {5, 5});
    QCOMPARE(m_window->tools().active(), std::string("move"));
  }

  /// It edits neither the project that it began in, nor the one that comes.
  void aDragEndsWithItsProject() {
    const Project begun = document().project();
    const QString path = document().path();
    selectIce("move");
    dragPart({GizmoPart::Kind::Plane, 1}, {50, 10});
    const Project other = document().project();
    const Vector3 there = pivotOf(ice());
    document().undoStack().undo();
    QVERIFY(pivotOf(ice()) != there);
    selectIce("move");
    dragPart({GizmoPart::Kind::Arm, 0}, {40, 0}, {}, false);
    document().open(other, path, false, false);
    QCOMPARE(pivotOf(ice()), there);
    QVERIFY(!document().isDirty());
    QVERIFY(!m_window->tools().tool().picture().gizmo->active);
    hands::move(*view(), {60, 60});
    QTest::mouseRelease(view(), Qt::LeftButton, {}, {60, 60});
    QCOMPARE(pivotOf(ice()), there);
    QVERIFY(!document().isDirty());
    document().open(begun, path, false, false);
    m_window->tools().activate("select");
  }

  void stepsAreTheSpacing() {
    selectIce("move");
    for (const Qt::KeyboardModifier key : {Qt::ControlModifier, Qt::AltModifier}) {
      const Vector3 before = pivotOf(ice());
      dragPart({GizmoPart::Kind::Arm, 0}, {43, 0}, key);
      const double steps = (pivotOf(ice()) - before).x() / m_window->tools().spacing();
      QVERIFY(std::abs(steps) > 0.5 && std::abs(steps - std::round(steps)) < 1e-6);
    }
  }

  void aRingTurnsASolid() {
    const std::string id = addedSolid("cone");
    m_window->tools().activate("rotate");
    const Vector3 matter = matterIn(id);
    const Body before = *document().body(id);
    dragPart({GizmoPart::Kind::Ring, 2}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("90"));
    viewPicture(QStringLiteral("handles-ring.png"));
    QTest::keyClick(view(), Qt::Key_Return);
    viewPicture(QStringLiteral("handles-rotate.png"));
    const SolidForm form(std::get<SolidShape>(document().body(id)->shape));
    QVERIFY((form.toScene({0, 1, 0}) - form.middle() - Vector3(-1, 0, 0)).norm() < 1e-9);
    QVERIFY((centroidOf(*document().body(id)) - centroidOf(before)).norm() < 1e-6);
    QVERIFY((matterIn(id) - matter).norm() < 1e-5);
    const QString row = QStringLiteral("shape/%1/rotation_z").arg(QString::fromStdString(id));
    QCOMPARE(m_window->inspector().bodyPanel()->row(row)->valueText(), QStringLiteral("90.0 °"));
    // What stands is what a reset makes.
    const std::vector<Vector3> live = placesOf(id);
    toTheStart();
    const std::vector<Vector3> made = placesOf(id);
    QCOMPARE(made.size(), live.size());
    for (size_t k = 0; k < made.size(); ++k) QVERIFY((made[k] - live[k]).norm() < 0.2 * m_window->tools().spacing());
    document().undoStack().undo();
    QCOMPARE(pivotOf(*document().body(id)), pivotOf(before));
  }

  /// By its menu: it is kept, the handles follow it, and so does what they do.
  void aPivotIsChosen() {
    const std::string first = addedSolid("block"), second = addedSolid("ellipsoid");
    m_window->selection().selectAll({{OutlineKind::Body, first}, {OutlineKind::Body, second}});
    m_window->tools().activate("rotate");
    const Vector3 a = pivotOf(*document().body(first)), b = pivotOf(*document().body(second));
    QVERIFY((handles().centre - 0.5 * (a + b)).norm() < 1e-4);
    m_window->action(QStringLiteral("edit.pivot.last"))->trigger();
    QVERIFY((handles().centre - b).norm() < 1e-4);
    QVERIFY(m_window->tools().tool().words().contains(QStringLiteral("the one selected last")));
    m_window->action(QStringLiteral("edit.pivot.each"))->trigger();
    QVERIFY(m_window->action(QStringLiteral("edit.pivot.each"))->isChecked());
    QCOMPARE(preferences::handles(), m_window->tools().handles());
    const int steps = document().undoStack().index();
    view()->repaint();
    dragPart({GizmoPart::Kind::Ring, 2}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("30"));
    QTest::keyClick(view(), Qt::Key_Return);
    QCOMPARE(document().undoStack().index(), steps + 1);
    for (const auto& [id, place] : {std::pair(first, a), {second, b}}) {
      const SolidForm form(std::get<SolidShape>(document().body(id)->shape));
      QVERIFY(form.isTurned() && (form.middle() - place).norm() < 1e-6);
    }
    document().undoStack().undo();
    preferences::setHandles({});
  }

  /// Who takes handles that find nothing to turn or scale is told why, in the status line too, until they find some.
  void whatCannotBeTurnedSaysWhy() {
    const std::string ids[] = {probeIn("box", Region{{-0.1, 0, -0.1}, {0.1, 0.1, 0.1}}), probeIn("all", {})};
    m_window->selection().selectBody(kIce);
    m_window->action(QStringLiteral("edit.pin"))->trigger();
    struct Row {
      SelectedItem item;
      const char *cannot, *why, *can;
    };
    const Row rows[] = {
        {{OutlineKind::Probe, ids[0]}, "rotate", "“box”: the box of a probe stands along the axes", "scale"},
        {{OutlineKind::Probe, ids[1]}, "rotate", "“all”: it measures wherever its matter is", ""},
        {{OutlineKind::Pin, "ice/0"}, "rotate", "a pin stands along the axes and cannot be turned", "move"},
        {{OutlineKind::Wall, "floor"}, "scale", "“Hot plate”: a plane has no end", "rotate"}};
    const auto says = [&](const Row& row) {
      return m_window->statusLine()->state().note.contains(QString::fromUtf8(row.why));
    };
    for (const Row& row : rows) {
      m_window->tools().activate("select");
      m_window->selection().selectAll({row.item});
      QVERIFY(!says(row));
      m_window->tools().activate(row.cannot);
      QVERIFY2(says(row), row.why);
      QVERIFY(!m_window->tools().tool().picture().gizmo->gizmo);
      if (*row.can) {
        m_window->tools().activate(row.can);
        QVERIFY2(!says(row), row.why);
        m_window->tools().activate(row.cannot);
        QVERIFY(says(row));
      }
      m_window->selection().selectBody(kIce);
      QVERIFY2(!says(row), row.why);
    }
    m_window->selection().selectAll({rows[0].item});
    m_window->tools().activate("rotate");
    viewPicture(QStringLiteral("handles-not-turned.png"));
  }

  /// A sketch is scaled as a whole, with its strokes, and turned; each is a step.
  void sketchesAreScaledAndTurned() {
    Body sketched = ice();
    sketched.name = "Sketched";
    sketched.shape = VoxelShape{};
    auto& voxels = std::get<VoxelShape>(sketched.shape);
    voxels.spacing = m_window->tools().spacing();
    voxels.origin = {0, 0.6, 0};
    voxels.palette.push_back({sketched.material});
    for (int k = 0; k < 8; ++k) voxels.runs.push_back({0, k % 2, k / 2, 4, 0});
    const std::string id = document().addBody(sketched);
    const Body before = *document().body(id);
    m_window->selection().selectBody(id);
    m_window->tools().activate("scale");
    QVERIFY(m_window->tools().tool().picture().gizmo->gizmo);
    view()->frameAll();
    const size_t count = placesOf(id.c_str()).size();
    QCOMPARE(count, size_t{32});
    const int first = document().undoStack().index();
    dragPart({GizmoPart::Kind::Arm, 1}, {0, -10}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("2"));
    viewPicture(QStringLiteral("handles-sketch.png"));
    QTest::keyClick(view(), Qt::Key_Return);
    QCOMPARE(document().undoStack().index(), first + 1);
    const BodyBounds small = boundsOf(before), large = boundsOf(*document().body(id));
    QVERIFY((large.size() - 2 * small.size()).norm() < 1e-9 && (large.middle() - small.middle()).norm() < 1e-9);
    QCOMPARE(std::get<VoxelShape>(document().body(id)->shape).runs, voxels.runs);
    toTheStart();
    QCOMPARE(placesOf(id.c_str()).size(), 8 * count);
    document().undoStack().undo();
    QVERIFY(std::get<VoxelShape>(document().body(id)->shape) == std::get<VoxelShape>(before.shape));
    toTheStart();
    QCOMPARE(placesOf(id.c_str()).size(), count);
    m_window->tools().activate("rotate");
    view()->frameAll();
    const int steps = document().undoStack().index();
    dragPart({GizmoPart::Kind::Ring, 2}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("90"));
    QTest::keyClick(view(), Qt::Key_Return);
    QCOMPARE(document().undoStack().index(), steps + 1);
    const auto& turned = std::get<VoxelShape>(document().body(id)->shape);
    QVERIFY(turned.rotation == Vector3(0, 0, 90) || turned.rotation == Vector3(0, 0, -90));
    QCOMPARE(turned.runs, std::get<VoxelShape>(before.shape).runs);
    const BodyBounds stands = boundsOf(*document().body(id)), lay = boundsOf(before);
    QVERIFY((stands.middle() - lay.middle()).norm() < 1e-6);
    QVERIFY((stands.size() - Vector3(lay.size()[1], lay.size()[0], lay.size()[2])).norm() < 1e-6);
    document().undoStack().undo();
    QVERIFY(std::get<VoxelShape>(document().body(id)->shape) == std::get<VoxelShape>(before.shape));
  }

  /// A block of layers becomes a solid one of its size and place, with rows of its own: a step there and back.
  void aBlockOfLayersIsTurned() {
    selectIce("move");
    dragPart({GizmoPart::Kind::Arm, 1}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("0.2"));
    QTest::keyClick(view(), Qt::Key_Return);
    const Vector3 matter = iceMatter();
    const size_t count = placesOf(kIce).size();
    const BoxShape before = std::get<BoxShape>(ice().shape);
    view()->update();
    QTRY_VERIFY_WITH_TIMEOUT((handles().centre - matter).norm() < 1e-4, kLong);
    view()->frameAll();
    selectIce("rotate");
    const int steps = document().undoStack().index();
    dragPart({GizmoPart::Kind::Ring, 2}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("90"));
    QTest::keyClick(view(), Qt::Key_Return);
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY(std::holds_alternative<SolidShape>(ice().shape));
    const SolidForm form(std::get<SolidShape>(ice().shape));
    QVERIFY(form.kind() == SolidForm::Kind::Block && (form.size() - before.size).norm() < 1e-12);
    QVERIFY((form.middle() - before.center).norm() < 1e-6);
    QVERIFY((iceMatter() - matter).norm() < 1e-5);
    ParameterRow* row = m_window->inspector().bodyPanel()->row(QStringLiteral("shape/ice/rotation_z"));
    QVERIFY(row);
    QCOMPARE(row->valueText(), QStringLiteral("90.0 °"));
    toTheStart();
    QCOMPARE(placesOf(kIce).size(), count);
    document().undoStack().undo();
    QVERIFY(ice().shape == decltype(ice().shape)(before));
    QVERIFY((iceMatter() - matter).norm() < 1e-5);
  }

  void sizesWaitForTheReset() {
    const std::string id = addedSolid("ellipsoid");
    m_window->tools().activate("scale");
    const size_t count = placesOf(id).size();
    viewPicture(QStringLiteral("handles-scale.png"));
    const Vector3 size = SolidForm(std::get<SolidShape>(document().body(id)->shape)).size();
    dragPart({GizmoPart::Kind::Middle, 0}, {10, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("1.5"));
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY((SolidForm(std::get<SolidShape>(document().body(id)->shape)).size() - 1.5 * size).norm() < 1e-9);
    QCOMPARE(placesOf(id).size(), count);
    toTheStart();
    QVERIFY(placesOf(id).size() > 2.5 * static_cast<double>(count));
    const int steps = document().undoStack().index();
    document().undoStack().undo();
    QCOMPARE(document().undoStack().index(), steps - 1);
    QVERIFY((SolidForm(std::get<SolidShape>(document().body(id)->shape)).size() - size).norm() < 1e-12);
  }

  void aRowCarriesMatterToo() {
    const std::string id = addedSolid("ellipsoid");
    const Vector3 matter = matterIn(id);
    const double from = pivotOf(*document().body(id)).y();
    QCOMPARE(document().setParameter({Owner::Shape, id, "position_y"}, from + 0.1), QString());
    QVERIFY((matterIn(id) - matter - Vector3(0, 0.1, 0)).norm() < 1e-5);
    document().undoStack().undo();
    QVERIFY((matterIn(id) - matter).norm() < 1e-5);
  }

  void wallsTapsAndDrainsHaveHandles() {
    Emitter tap;
    tap.material = document().project().materials.front().id;
    tap.point = {0.1, 0.3, 0};
    const Port placed = document().addEmitter(tap);
    m_window->selection().selectAll({{OutlineKind::Emitter, placed.id}, {OutlineKind::Wall, "floor"}});
    m_window->tools().activate("move");
    const Vector3 wall = document().wall("floor")->point;
    dragPart({GizmoPart::Kind::Arm, 1}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("-0.01"));
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY((document().wall("floor")->point - wall + Vector3(0, 0.01, 0)).norm() < 1e-12);
    QVERIFY((document().emitter(placed.id)->point - Vector3(0.1, 0.29, 0)).norm() < 1e-12);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("moving 2 things"));
    const double lives =
        onEngine<double>(session(), [](Engine& engine) { return engine.project().environment.walls[0].point.y(); });
    QCOMPARE(lives, document().project().environment.walls[0].point.y());
    m_window->selection().select(placed);
    m_window->tools().activate("rotate");
    dragPart({GizmoPart::Kind::Ring, 2}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("90"));
    QTest::keyClick(view(), Qt::Key_Return);
    QVERIFY((document().emitter(placed.id)->direction - Vector3(1, 0, 0)).norm() < 1e-9);
    // Its mouth becomes twice as wide, its row says so, and the engine has it; a drain is turned likewise.
    m_window->tools().activate("scale");
    const int steps = document().undoStack().count();
    dragPart({GizmoPart::Kind::Middle, 0}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("2"));
    QTest::keyClick(view(), Qt::Key_Return);
    const Address width{Owner::Emitter, placed.id, "diameter"};
    QCOMPARE(std::get<double>(document().value(width)), 0.12);
    QCOMPARE(document().undoStack().count(), steps + 1);
    QCOMPARE(
        std::get<double>(m_window->inspector().scenePanel()->row(QString::fromStdString(width.text()))->model().value),
        0.12);
    QCOMPARE(onEngine<double>(session(),
                              [](Engine& engine) {
                                return numberOf(engine.project().emitters.back().parameters, emitterParameters(),
                                                "diameter");
                              }),
             0.12);
    document().undoStack().undo();
    QCOMPARE(std::get<double>(document().value(width)), 0.06);
    Sink drain;
    drain.minimum = {-0.1, 0.1, -0.05}, drain.maximum = {0.1, 0.14, 0.05};
    const Port sink = document().addSink(drain);
    m_window->selection().select(sink);
    m_window->tools().activate("rotate");
    dragPart({GizmoPart::Kind::Ring, 2}, {0, 0}, {}, false);
    QTest::keyClicks(view(), QStringLiteral("30"));
    QTest::keyClick(view(), Qt::Key_Return);
    const Address turn{Owner::Sink, sink.id, "rotation_z"};
    QVERIFY(std::abs(std::get<double>(document().value(turn)) - 30) < 1e-9);
    view()->update();
    QTest::qWait(100);
    viewPicture(QStringLiteral("handles-drain.png"));
    document().undoStack().undo();
    QCOMPARE(std::get<double>(document().value(turn)), 0.0);
  }

  void shiftAndFrameSelectMore() {
    const std::string id = addedSolid("ellipsoid");
    m_window->tools().activate("select");
    m_window->selection().clear();
    QTest::mouseClick(view(), Qt::LeftButton, {}, pixelOf(matterIn(id)));
    QCOMPARE(m_window->selection().bodies(), std::vector<std::string>{id});
    QTest::mouseClick(view(), Qt::LeftButton, Qt::ShiftModifier, pixelOf(iceMatter()));
    QCOMPARE(m_window->selection().bodies(), (std::vector<std::string>{id, kIce}));
    QTest::mouseClick(view(), Qt::LeftButton, Qt::ShiftModifier, pixelOf(matterIn(id)));
    QCOMPARE(m_window->selection().bodies(), std::vector<std::string>{kIce});
    m_window->selection().clear();
    drag({4, 60}, QPoint(view()->width() - 80, view()->height() - 130), true, Qt::ControlModifier);
    QCOMPARE(m_window->selection().bodies().size(), size_t{2});
    // Walls and taps that lie in the frame as a whole are in it too.
    QCOMPARE(m_window->findChild<Outliner*>()->view()->selectionModel()->selectedIndexes().size(),
             static_cast<int>(m_window->selection().items().size()));
    m_window->selection().selectAll({{OutlineKind::Body, id}, {OutlineKind::Body, kIce}});
    m_window->tools().activate("move");
    view()->update();
    QTest::qWait(100);
    viewPicture(QStringLiteral("handles-two.png"));
    const Vector3 first = pivotOf(ice()), second = pivotOf(*document().body(id));
    dragPart({GizmoPart::Kind::Middle, 0}, {30, -30});
    const Vector3 way = pivotOf(ice()) - first;
    QVERIFY(way.norm() > 0.01);
    QVERIFY((pivotOf(*document().body(id)) - second - way).norm() < 1e-9);
    document().undoStack().undo();
    QCOMPARE(pivotOf(ice()), first);
    QCOMPARE(pivotOf(*document().body(id)), second);
  }

  /// In the view, along its edges, and no longer than it is selected.
  void aSelectedWallIsOutlined() {
    const Lines edges = wallLines(document().project().environment, 0);
    const auto outlined = [&] {
      view()->repaint();
      const QImage shown = view()->grabFramebuffer();
      const QColor accent = Theme::current()[Token::Accent];
      const auto isAccent = [&](const QPoint& at) {
        for (int y = -2; y <= 2; ++y) {
          for (int x = -2; x <= 2; ++x) {
            const QColor seen = shown.pixelColor(std::clamp(at.x() + x, 0, shown.width() - 1),
                                                 std::clamp(at.y() + y, 0, shown.height() - 1));
            if (std::abs(seen.red() - accent.red()) + std::abs(seen.green() - accent.green()) +
                    std::abs(seen.blue() - accent.blue()) <
                60)
              return true;
          }
        }
        return false;
      };
      return std::count_if(edges.begin(), edges.end(),
                           [&](const auto& edge) { return isAccent(pixelOf(0.5 * (edge.first + edge.second))); });
    };
    QCOMPARE(edges.size(), size_t{4});
    m_window->tools().activate("select");
    m_window->selection().clear();
    const auto without = outlined();
    m_window->selection().select(OutlineKind::Wall, document().project().environment.walls[0].id);
    QTRY_VERIFY_WITH_TIMEOUT(outlined() >= without + 3, kLong);
    m_window->selection().clear();
    QTRY_COMPARE_WITH_TIMEOUT(outlined(), without, kLong);
  }

 private:
  /// Of the view with what is painted over it, where PS_TEST_PICTURES names a folder.
  void viewPicture(const QString& name) {
    const QString folder = qEnvironmentVariable("PS_TEST_PICTURES");
    if (!folder.isEmpty()) view()->grabFramebuffer().save(folder + QLatin1Char('/') + name);
  }
  const Body& ice() { return *document().body(kIce); }
  Vector3 matterIn(const std::string& id) {
    return onEngine<Vector3>(session(), [id](Engine& engine) { return matterOf(engine, id); });
  }
  Vector3 iceMatter() { return matterIn(kIce); }
  std::vector<Vector3> placesOf(const std::string& id) {
    return onEngine<std::vector<Vector3>>(session(), [id](Engine& engine) {
      std::map<uint32_t, Vector3> places;
      const ParticleStore& store = engine.particles();
      for (size_t i = 0; i < store.size(); ++i) {
        if (engine.bodyIds()[store.body()[i]] == id) places[store.id()[i]] = vectorOf(store.position()[i]);
      }
      std::vector<Vector3> list;
      for (const auto& [particle, place] : places) list.push_back(place);
      return list;
    });
  }
  std::string probeIn(const char* name, const std::optional<Region>& region) {
    Probe probe;
    probe.id = probe.name = name;
    probe.quantity = "temperature";
    probe.region = region;
    return document().addProbe(std::move(probe));
  }
  void selectIce(const char* tool) {
    m_window->selection().selectBody(kIce);
    m_window->tools().activate(tool);
    view()->setFocus();
  }
  std::string addedSolid(const char* kind) {
    m_window->action(QStringLiteral("add.") + QString::fromLatin1(kind))->trigger();
    const std::string id = document().project().bodies.back().id;
    const auto there = [&] { return !placesOf(id).empty(); };
    [&] { QTRY_VERIFY_WITH_TIMEOUT(there(), kLong); }();
    [&] { QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong); }();
    view()->frameAll();
    view()->setFocus();
    return id;
  }
  Gizmo handles() { return hands::handles(*m_window); }
  QPoint pixelOf(const Vector3& p) { return hands::pixelOf(*view(), p); }
  QPoint middleOf(const GizmoPart& part) { return hands::middleOf(*m_window, part); }
  void dragPart(const GizmoPart& part, const QPoint& way, Qt::KeyboardModifiers modifiers = {}, bool release = true) {
    drag(middleOf(part), way, release, modifiers);
    if (!release) QVERIFY(m_window->tools().tool().picture().gizmo->active == part);
  }
  void drag(const QPoint& from, const QPoint& way, bool release, Qt::KeyboardModifiers modifiers) {
    hands::press(*view(), from, way, modifiers, modifiers);
    if (release) QTest::mouseRelease(view(), Qt::LeftButton, modifiers, from + way);
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestHandles test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_handles.moc"
