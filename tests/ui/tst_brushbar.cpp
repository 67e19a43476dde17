// SPDX-License-Identifier: Apache-2.0
// The brush bar beside the view, and the list of strokes on the page Brush.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "samplewindow.h"
#include "tests/ui/gizmohands.h"
#include "tests/ui/hands.h"
#include "ui/document/redrawing.h"
#include "ui/library/librarypage.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/strokelistedits.h"
#include "ui/panels/strokeslist.h"
#include "ui/rows/colourpicker.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/selection.h"
#include "ui/tools/tooltable.h"
#include "ui/window/brushbar.h"
#include "ui/window/dock.h"
#include "ui/window/libraryactions.h"
#include "ui/window/statusline.h"
#include "ui/window/windowlayout.h"

#include <QtGui/QAction>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>

#include <algorithm>
#include <climits>

using namespace ps;

namespace {

VoxelShape::Stroke strokeOf(const char* brush, bool erase, double length) {
  VoxelShape::Stroke stroke;
  stroke.brush = brush;
  stroke.erase = erase;
  stroke.samples = {{0, 0, 0, 1, 0, 0, 0, 0}, {length, 0, 0, 1, 1, 0, 0, 0}};
  return stroke;
}

Body sketchOf(const char* id, const std::vector<VoxelShape::Stroke>& strokes) {
  Body body;
  body.id = id;
  body.name = id;
  body.material = "water";
  VoxelShape shape;
  shape.origin = {0, 0.3, 0};
  shape.palette.push_back({"water", 262});
  shape.runs = {{0, 0, 0, 4, 0}};
  shape.strokes = strokes;
  body.shape = shape;
  return body;
}

}  // namespace

class TestBrushBar : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { beginInTheView(); }
  void cleanupTestCase() { m_window.reset(); }

  /// The view has its new size at once: what is in hand stands under the pointer.
  void itStandsBesideTheViewWhileSomethingIsDrawnWith() {
    QVERIFY(!bar()->isVisible());
    m_window->tools().activate(kBrushTool);
    const int wide = view()->width();
    QVERIFY(bar()->isVisible());
    QCOMPARE(bar()->width(), 98);
    QTRY_COMPARE(bar()->findChild<QScrollArea*>()->verticalScrollBar()->maximum(), 0);  // there is room for all
    QTest::qWait(50);
    QCOMPARE(view()->width(), wide);
    m_window->tools().activate(kSelectTool);
    QVERIFY(!bar()->isVisible());
  }

  /// The same digits look from somewhere in the other workspaces; with Alt they do in all.
  void digitsTakeMaterials() {
    for (const char* base : {"iron", "wood", "honey"}) document().addMaterial(base);
    const std::vector<SceneMaterial>& materials = document().project().materials;
    QVERIFY(materials.size() >= 4 && materials.size() < 9);
    m_window->selection().setMaterial(materials[0].id);
    press(Qt::Key_3);
    QVERIFY(view()->navigator().viewName().startsWith(QStringLiteral("Top")));
    QCOMPARE(m_window->selection().material(), materials[0].id);
    m_window->tools().activate(kBrushTool);
    view()->show(StandardView::Scene);
    QTRY_COMPARE(of("material", materials[2].id.c_str())->toolTip().right(3), QStringLiteral("(3)"));
    press(Qt::Key_3);
    QCOMPARE(m_window->tools().brush().material, materials[2].id);
    QVERIFY(!view()->navigator().viewName().startsWith(QStringLiteral("Top")));
    press(Qt::Key_9);  // there are fewer
    QCOMPARE(m_window->tools().brush().material, materials[2].id);
    press(Qt::Key_3, Qt::AltModifier);
    QVERIFY(view()->navigator().viewName().startsWith(QStringLiteral("Top")));
    QAction* second = m_window->action(QStringLiteral("sketch.material2"));
    QVERIFY(second->text().startsWith(QStringLiteral("Draw with ")));
    m_window->tools().activate(kSelectTool);
    second->trigger();
    QCOMPARE(m_window->tools().active(), std::string(kBrushTool));
    QCOMPARE(m_window->tools().brush().material, materials[1].id);
    while (materials.size() < 10) document().addMaterial(idleBase());
    press(Qt::Key_0);
    QCOMPARE(m_window->tools().brush().material, materials[9].id);
  }

  void itsButtonsStandInTwoColumns() {
    m_window->tools().activate(kBrushTool);
    std::set<int> columns;
    for (const QAbstractButton* button : buttons()) {
      QCOMPARE(button->size(), QSize(40, 40));
      columns.insert(button->mapTo(bar(), QPoint()).x());
    }
    QCOMPARE(columns.size(), size_t{2});
    QVERIFY(*columns.rbegin() + 40 <= 98 && *columns.rbegin() - *columns.begin() >= 40);
    const auto brushes = session().plugins()->ids(PluginKind::Brush);
    QCOMPARE(static_cast<size_t>(buttons().size()),
             brushes.size() + 3 + std::min<size_t>(10, document().project().materials.size()));
  }

  void whatDrawsComesBeforeWhatChangesAndWhatTouches() {
    m_window->tools().activate(kBrushTool);
    const auto top = [this](const char* shape) { return of("shape", shape)->mapTo(bar(), QPoint()).y(); };
    QVERIFY(top("sphere") < top("smooth"));
    QVERIFY(top("smooth") < top("heat"));
    QVERIFY(top("tint") < top("grab"));
  }

  void itsButtonsTakeBrushEraserMirrorAndMaterial() {
    Toolbox& tools = m_window->tools();
    tools.activate(kBrushTool);
    of("shape", "cube")->click();
    QCOMPARE(tools.brush().shape, std::string("cube"));
    QVERIFY(of("shape", "cube")->isChecked() && !of("shape", "sphere")->isChecked());
    QAbstractButton* erase = named("Erase matter (E)");
    QVERIFY(erase);
    erase->click();
    QCOMPARE(tools.active(), std::string(kEraseTool));
    QVERIFY(erase->isChecked());
    erase->click();
    QCOMPARE(tools.active(), std::string(kBrushTool));
    QAbstractButton* mirror = named("Mirror what is drawn (M)");
    QVERIFY(mirror);
    mirror->click();
    QCOMPARE(tools.brush().symmetry.mirror, std::string("x"));
    QVERIFY(mirror->isChecked());
    mirror->click();
    QCOMPARE(tools.brush().symmetry.mirror, std::string("none"));
    document().addMaterial("iron");
    QAbstractButton* iron = of("material", "iron");
    QVERIFY(iron);
    iron->click();
    QCOMPARE(tools.brush().material, std::string("iron"));
    QVERIFY(iron->isChecked());
    document().undoStack().undo();
    QVERIFY(!of("material", "iron"));
  }

  /// One that the scene has not comes from the library; a tip says what a brush does, whose name is its name alone.
  void itLeadsToTheLibrary() {
    m_window->tools().activate(kBrushTool);
    QAbstractButton* more = named("Material from the library");
    QVERIFY(more);
    const LibraryPage* page = m_window->library().page();
    QVERIFY(!page->isVisible());
    more->click();
    QTRY_VERIFY(page->isVisible());
    press(Qt::Key_Escape);
    QTRY_VERIFY(!page->isVisible());
    const QAbstractButton* sphere = of("shape", "sphere");
    QVERIFY(sphere->toolTip().contains(QStringLiteral("\nDraws a round strand")));
    QVERIFY(!sphere->accessibleName().contains(QLatin1Char('\n')));
    m_window->tools().activate(kSelectTool);
  }

  /// Also where somebody looks at a body while the brush is in hand already: Ctrl+K triggers the same action.
  void aBrushThatIsChosenByItsNameShowsItsPage() {
    m_window->tools().activate(kBrushTool);
    Dock* inspector = m_window->layoutOfDocks().dock(QStringLiteral("dock.inspector"));
    inspector->showPage(QStringLiteral("Body"));
    m_window->action(QStringLiteral("sketch.shape.stamp"))->trigger();
    QCOMPARE(inspector->currentPage(), QStringLiteral("Brush"));
  }

  void strokesOfTheSelectedSketchAreListed() {
    const std::string cup =
        document().addBody(sketchOf("cup", {strokeOf("sphere", false, 0.25), strokeOf("tube", true, 0.1)}));
    const std::string bare = document().addBody(sketchOf("bare", {}));
    m_window->selection().selectBody(cup);
    QCOMPARE(list()->body(), cup);
    QCOMPARE(list()->lines().size(), size_t{2});
    const auto& [first, second] = std::tie(list()->lines()[0], list()->lines()[1]);
    QCOMPARE(first.name, QStringLiteral("Sphere"));
    QCOMPARE(first.icon, QStringLiteral("sphere"));
    QCOMPARE(first.length, QStringLiteral("250 mm"));
    QVERIFY(first.colour.isValid());
    QCOMPARE(second.name, QStringLiteral("Tube, erased"));
    QCOMPARE(second.icon, QStringLiteral("erase"));
    QVERIFY(!second.colour.isValid());
    m_window->selection().selectBody(bare);
    QVERIFY(list()->lines().empty());
    m_window->selection().clear();
    QVERIFY(list()->body().empty());
  }

  void whatIsDrawnIsListedAndGoesWithUndo() {
    m_window->tools().activate(kBrushTool);
    of("shape", "sphere")->click();
    m_window->selection().clear();
    stroke(QPoint(view()->width() / 2 - 40, view()->height() / 2), {80, 0}, true);
    QTRY_COMPARE(list()->lines().size(), size_t{1});
    QCOMPARE(list()->lines().front().name, QStringLiteral("Sphere"));
    document().undoStack().undo();
    QVERIFY(list()->lines().empty());
  }

  void strokesAreRemovedMovedAndOfAnotherMaterial() {
    const std::string cup = document().addBody(threeStrokes());
    const VoxelShape before = shapeOf(cup);
    m_window->selection().selectBody(cup);
    QCOMPARE(list()->lines().size(), size_t{3});
    auto* rows = list()->findChild<QScrollArea*>()->widget();
    rows->setFocus();
    list()->setCurrent(1);  // the one that erases
    QTest::keyClick(rows, Qt::Key_Delete);
    QVERIFY(list()->edits().busy());
    QTRY_COMPARE(list()->lines().size(), size_t{2});
    QVERIFY(!list()->edits().busy());
    const size_t whole = cellCount(shapeOf(cup));
    QVERIFY2(whole > cellCount(before), qPrintable(QString::number(whole)));
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("removal of a stroke of cup"));
    document().undoStack().undo();
    QCOMPARE(shapeOf(cup), before);
    // Before there is anything it erases nothing.
    list()->setCurrent(1);
    QTest::keyClick(rows, Qt::Key_Up, Qt::AltModifier);
    QTRY_COMPARE(cellCount(shapeOf(cup)), whole);
    QCOMPARE(list()->current(), 0);
    QVERIFY(shapeOf(cup).strokes[0].erase && !shapeOf(cup).strokes[1].erase);
    QTest::keyClick(rows, Qt::Key_Down, Qt::AltModifier);
    QTRY_COMPARE(shapeOf(cup), before);
    QCOMPARE(list()->current(), 1);
    // The last one in iron, by the menu.
    const std::string iron = document().addMaterial("iron");
    const std::unique_ptr<QMenu> menu(list()->menuOf(2));
    QVERIFY(!menu->actions()[2]->isEnabled());  // there is none behind it
    QMenu* materials = menu->actions().last()->menu();
    const QList<QAction*> names = materials->actions();
    const auto wanted = std::find_if(names.begin(), names.end(), [](QAction* a) { return a->text() == "Iron"; });
    QVERIFY(wanted != names.end());
    (*wanted)->trigger();
    QTRY_COMPARE(shapeOf(cup).palette.back().material, iron);
    const std::vector<VoxelShape::Run> runs = shapeOf(cup).runs;
    QVERIFY(std::any_of(runs.begin(), runs.end(), [](const VoxelShape::Run& run) { return run.palette == 1; }));
    QCOMPARE(cellCount(shapeOf(cup)), cellCount(before));
  }

  /// Ctrl+K chooses one, and does with it what its menu offers.
  void strokesAreFoundByThePalette() {
    const std::string cup = document().addBody(threeStrokes());
    m_window->selection().selectBody(cup);
    const auto run = [this](const QString& title) {
      for (const PaletteEntry& entry : m_window->paletteEntries()) {
        if (entry.title != title || !entry.whyNot.isEmpty()) continue;
        entry.run();
        return true;
      }
      return false;
    };
    QVERIFY(run(QStringLiteral("Stroke 2: ") + list()->lines()[1].name));
    QCOMPARE(list()->current(), 1);
    QTRY_VERIFY(list()->isVisible());
    QVERIFY(!run(QStringLiteral("Stroke 3: Hide")));  // another one is chosen
    QVERIFY(run(QStringLiteral("Stroke 2: Hide")));
    QTRY_VERIFY(list()->lines()[1].hidden);
    const auto entries = m_window->paletteEntries();
    const auto earlier = std::find_if(entries.begin(), entries.end(), [](const PaletteEntry& entry) {
      return entry.title == QStringLiteral("Stroke 2: Draw earlier");
    });
    QVERIFY(earlier != entries.end());
    QCOMPARE(earlier->keys, QStringLiteral("Alt+Up"));
  }

  /// By its eye and by the menu: the sketch is as without it, and it stays in the list, in the file too.
  void aStrokeIsHiddenAndShown() {
    const std::string cup = document().addBody(threeStrokes());
    m_window->selection().selectBody(cup);
    showList();
    const VoxelShape before = shapeOf(cup);
    auto* rows = list()->findChild<QScrollArea*>()->widget();
    const auto eye = [&](int line) { return StrokesList::eyeOf(line, rows->width()).center().toPoint(); };
    QTest::mouseClick(rows, Qt::LeftButton, {}, eye(1));  // of the one that erases
    QTRY_VERIFY(list()->lines()[1].hidden);
    QCOMPARE(list()->lines().size(), size_t{3});
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("hiding a stroke of cup"));
    QVERIFY(cellCount(shapeOf(cup)) > cellCount(before));
    QTRY_COMPARE_WITH_TIMEOUT(countOf(cup), cellCount(shapeOf(cup)), kLong);
    QVERIFY(rows->accessibleDescription().endsWith(QStringLiteral(", hidden")));
    picture(QStringLiteral("a hidden stroke.png"));
    const Project file = readProject(writeProject(document().project()), "cup.json", *session().plugins()).project;
    const auto& saved = std::get<VoxelShape>(file.bodies.back().shape).strokes;
    QVERIFY(saved[1].hidden && !saved[0].hidden && !saved[2].hidden);
    document().undoStack().undo();
    QCOMPARE(shapeOf(cup), before);
    document().undoStack().redo();
    const std::unique_ptr<QMenu> menu(list()->menuOf(1));
    const QList<QAction*> entries = menu->actions();
    const auto show = std::find_if(entries.begin(), entries.end(), [](QAction* a) { return a->text() == "Show"; });
    QVERIFY(show != entries.end());
    (*show)->trigger();
    QTRY_COMPARE(shapeOf(cup), before);
    // Something of it has to be left.
    QSignalSpy told(&list()->edits(), &StrokeListEdits::told);
    for (const size_t line : {1u, 2u}) {
      list()->edits().setHidden(cup, line, true);
      QTRY_VERIFY(list()->lines()[line].hidden);
    }
    list()->edits().setHidden(cup, 0, true);
    QCOMPARE(told.count(), 1);
    QVERIFY2(told[0][1].toString().contains(QStringLiteral("outliner")), qPrintable(told[0][1].toString()));
    QVERIFY(!list()->lines()[0].hidden);
  }

  /// By the handle of the tool Move, while the list has it.
  void aStrokeIsMovedInTheView() {
    const std::string cup = document().addBody(threeStrokes());
    m_window->selection().selectBody(cup);
    view()->frameAll();
    const VoxelShape before = shapeOf(cup);
    showList();
    list()->setCurrent(2);
    const auto wire = m_window->tools().strokeWire();
    QVERIFY(wire && wire->lines.size() == 3);  // a dab: a cross
    QTest::keyClick(list()->findChild<QScrollArea*>()->widget(), Qt::Key_W);
    QCOMPARE(m_window->tools().active(), std::string("move"));
    const Gizmo handles = hands::handles(*m_window);
    QVERIFY2((handles.centre - Vector3(0.2, 0.6, 0)).norm() < 1e-9, qPrintable(QString::number(handles.centre[0])));
    hands::pull(*view(), hands::middleOf(*m_window, {GizmoPart::Kind::Arm, 0}), {30, 0});
    QTRY_VERIFY(shapeOf(cup) != before);
    const VoxelShape& after = shapeOf(cup);
    const double moved = after.strokes[2].samples[0][0] - 0.2;
    QVERIFY2(moved > 0.01, qPrintable(QString::number(moved)));
    QCOMPARE(after.strokes[0], before.strokes[0]);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("moving a stroke of cup"));
    const double farther = farEnd(after) - farEnd(before);
    QVERIFY2(std::abs(farther - moved) <= after.spacing,
             qPrintable(QStringLiteral("%1 m, the end %2 m").arg(moved).arg(farther)));
    QCOMPARE(list()->current(), 2);
    // The body is taken again where it is clicked.
    m_window->selection().selectBody(cup);
    QVERIFY(!m_window->tools().stroke());
    document().undoStack().undo();
    QCOMPARE(shapeOf(cup), before);
  }

  /// In one step, whichever body the hand begins on.
  void aStrokeIsDrawnAnew() {
    const std::string cup = document().addBody(threeStrokes());
    m_window->selection().selectBody(cup);
    const VoxelShape before = shapeOf(cup);
    const int steps = document().undoStack().index();
    showList();
    list()->drawAnew(2);
    QCOMPARE(m_window->tools().active(), std::string(kBrushTool));
    QCOMPARE(m_window->tools().brush().radius, before.strokes[2].radius);
    stroke(QPoint(view()->width() / 2 - 40, view()->height() / 2), {80, 0}, true);
    QTRY_COMPARE_WITH_TIMEOUT(document().undoStack().undoText(), QStringLiteral("drawing a stroke of cup anew"), kLong);
    QCOMPARE(document().undoStack().index(), steps + 1);
    const VoxelShape& after = shapeOf(cup);
    QCOMPARE(after.strokes.size(), size_t{3});
    QVERIFY(after.strokes[2].samples.size() > 1);
    QCOMPARE(after.strokes[1], before.strokes[1]);
    QVERIFY(after.runs != before.runs);
    document().undoStack().undo();
    QCOMPARE(shapeOf(cup), before);
  }

  /// The list shows what was drawn last, and goes on showing it.
  void theStrokeOfWhatWasDrawnLastIsDrawnAnew() {
    m_window->tools().activate(kBrushTool);
    of("shape", "sphere")->click();
    m_window->selection().clear();
    stroke(QPoint(view()->width() / 2 - 40, view()->height() / 2), {80, 0}, true);
    QTRY_COMPARE(list()->lines().size(), size_t{1});
    const std::string body = list()->body();
    const auto first = shapeOf(body).strokes[0].samples;
    showList();
    list()->drawAnew(0);
    stroke(QPoint(view()->width() / 2, view()->height() / 2 - 60), {0, 60}, true);
    QTRY_VERIFY_WITH_TIMEOUT(document().undoStack().undoText().startsWith(QStringLiteral("drawing a stroke")), kLong);
    QCOMPARE(list()->body(), body);
    QCOMPARE(list()->lines().size(), size_t{1});
    QVERIFY(shapeOf(body).strokes[0].samples != first);
  }

  void linesAreDraggedToAnotherPlace() {
    const std::string cup = document().addBody(threeStrokes());
    m_window->selection().selectBody(cup);
    const VoxelShape before = shapeOf(cup);
    showList();
    auto* rows = list()->findChild<QScrollArea*>()->widget();
    hands::pull(*rows, {40, StrokesList::kRow / 2}, {0, 2 * StrokesList::kRow});
    QTRY_VERIFY(shapeOf(cup) != before);
    QCOMPARE(shapeOf(cup).strokes[2], before.strokes[0]);
    QCOMPARE(list()->current(), 2);
    document().undoStack().undo();
    QCOMPARE(shapeOf(cup), before);
  }

  /// At the start at once; later it waits for the start, and that is told.
  void theMatterFollowsTheStrokes() {
    const std::string cup = document().addBody(threeStrokes());
    m_window->selection().selectBody(cup);
    QTRY_COMPARE_WITH_TIMEOUT(countOf(cup), cellCount(shapeOf(cup)), kLong);
    const size_t before = countOf(cup);
    list()->edits().remove(cup, 1);  // the one that erases
    QTRY_COMPARE(shapeOf(cup).strokes.size(), size_t{2});
    QVERIFY(cellCount(shapeOf(cup)) > before);
    QTRY_COMPARE_WITH_TIMEOUT(countOf(cup), cellCount(shapeOf(cup)), kLong);
    document().undoStack().undo();
    QTRY_COMPARE_WITH_TIMEOUT(countOf(cup), before, kLong);
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(!session().appliesAtOnce(), kLong);
    QSignalSpy told(&list()->edits(), &StrokeListEdits::told);
    list()->edits().remove(cup, 1);
    QTRY_COMPARE(told.count(), 1);
    QVERIFY2(told[0][1].toString().contains(QStringLiteral("press Home")), qPrintable(told[0][1].toString()));
    QCOMPARE(countOf(cup), before);
    toTheStart();
    QTRY_COMPARE_WITH_TIMEOUT(countOf(cup), cellCount(shapeOf(cup)), kLong);
  }

  /// Of what no stroke has drawn, of a body that is locked, and of the only stroke.
  void whatRedrawingLosesIsTold() {
    Body body = threeStrokes();
    std::get<VoxelShape>(body.shape).runs.push_back({0, 60, 0, 5, 0});
    const std::string cup = document().addBody(body);
    m_window->selection().selectBody(cup);
    QSignalSpy told(&list()->edits(), &StrokeListEdits::told);
    list()->edits().remove(cup, 1);
    QTRY_COMPARE(told.count(), 1);
    QVERIFY2(told[0][1].toString().startsWith(QStringLiteral("5 particles")), qPrintable(told[0][1].toString()));
    document().setLocked({{Owner::Body, cup, ""}}, true);
    list()->edits().remove(cup, 0);
    QCOMPARE(told.count(), 2);
    QCOMPARE(shapeOf(cup).strokes.size(), size_t{2});
    document().setLocked({{Owner::Body, cup, ""}}, false);
    list()->edits().remove(cup, 0);
    QTRY_COMPARE(shapeOf(cup).strokes.size(), size_t{1});
    list()->edits().remove(cup, 0);
    QVERIFY(!document().body(cup));
    document().undoStack().undo();
    QCOMPARE(shapeOf(cup).strokes.size(), size_t{1});
  }

  /// At its row, with the way to that of the spacing, and in the status line: there once, until they stand otherwise.
  void whatIsTooCoarseIsSaid() {
    Toolbox& tools = m_window->tools();
    tools.activate(kBrushTool);
    of("shape", "sphere")->click();
    const BrushSettings before = tools.brush();
    auto* panel = m_window->findChild<BrushPanel*>();
    const auto noteOf = [&](const char* key) {
      const ParameterRow* row = panel->row(QString::fromLatin1(key));
      const auto* label = row ? row->findChild<QLabel*>(QStringLiteral("psLimit")) : nullptr;
      return label ? label->text() : QString();
    };
    const auto isSaid = [&] { return m_window->statusLine()->state().note.contains(QStringLiteral("particles wide")); };
    const auto draw = [&](int across) {
      const int steps = document().undoStack().index();
      stroke(QPoint(view()->width() / 2 + across, view()->height() / 2), {30, 0}, true);
      QTRY_COMPARE_WITH_TIMEOUT(document().undoStack().index(), steps + 1, kLong);
    };
    BrushSettings brush = before;
    brush.radius = 1.5 * tools.spacing();
    tools.setBrush(brush);
    QCOMPARE(noteOf("radius"), QString());
    brush.radius = 1.2 * tools.spacing();
    tools.setBrush(brush);
    QVERIFY2(noteOf("radius").contains(QStringLiteral("2.4 particles wide")), qPrintable(noteOf("radius")));
    QVERIFY2(noteOf("radius").contains(lengthText(tools.spacing())), qPrintable(noteOf("radius")));
    QVERIFY(!isSaid());
    draw(-60);
    QVERIFY2(isSaid(), qPrintable(m_window->statusLine()->state().note));
    m_window->statusLine()->say({});
    draw(40);
    QVERIFY(!isSaid());
    Q_EMIT panel->linkActivated(QStringLiteral("radius"), QString::fromLatin1(BrushPanel::kSpacing));
    const auto rows = m_window->findChildren<ParameterRow*>();
    QTRY_VERIFY(std::any_of(rows.begin(), rows.end(), [](const ParameterRow* row) {
      return row->key() == QLatin1String(BrushPanel::kSpacing) && row->isVisible();
    }));
    of("shape", "tube")->click();
    brush = tools.brush();
    brush.parameters["tube"].values["wall"] = 1.0;
    tools.setBrush(brush);
    QVERIFY2(noteOf("brush/wall").contains(QStringLiteral("one particle thick")), qPrintable(noteOf("brush/wall")));
    brush.parameters["tube"].values["wall"] = 2.0;
    brush.radius = 4 * tools.spacing();
    tools.setBrush(brush);
    QCOMPARE(noteOf("brush/wall"), QString());
    QCOMPARE(noteOf("radius"), QString());
    tools.takeBrush(before.shape);
    tools.setBrush(before);
    m_window->layoutOfDocks().showPage(QStringLiteral("Brush"));
  }

  /// By hand, by keys and as text; the brush's own rows follow, and the swatch follows them.
  void aColourIsPicked() {
    m_window->tools().activate(kBrushTool);
    auto* row = m_window->findChild<ColourRow*>();
    of("shape", "sphere")->click();
    QVERIFY(row && !row->isVisible());
    of("shape", "tint")->click();
    QVERIFY(row->isVisible() && row->isEnabled());
    QCOMPARE(row->colour(), colourOfBrush());
    row->click();
    ColourPicker* picker = row->picker();
    QTRY_VERIFY(picker->isVisible());
    QTest::mouseClick(picker->hueBar(), Qt::LeftButton, {}, {picker->hueBar()->width() / 3, 8});
    QTest::mouseClick(picker->plane(), Qt::LeftButton, {}, {picker->plane()->width() - 1, 0});
    QVERIFY2(colourOfBrush().greenF() > 0.98F && colourOfBrush().redF() < 0.05F, qPrintable(colourOfBrush().name()));
    QCOMPARE(row->colour().rgb(), colourOfBrush().rgb());
    const double hue = picker->hue();
    picker->choose(hue, 0, 0.5);  // grey has no hue, and keeps the one that it had
    QTest::keyClick(picker->plane(), Qt::Key_Right);
    QCOMPARE(picker->hue(), hue);
    QVERIFY(picker->saturation() > 0.01);
    picker->text()->setFocus();
    picker->text()->selectAll();
    QTest::keyClicks(picker->text(), QStringLiteral("#3366cc"));
    QCOMPARE(colourOfBrush().name(), QStringLiteral("#3366cc"));
    const ParameterRow* red = m_window->findChild<BrushPanel*>()->row(QStringLiteral("brush/red"));
    QVERIFY(red && std::abs(red->number() - 0.2) < 1e-4);
    QTest::keyClick(picker->plane(), Qt::Key_Escape);
    QTRY_VERIFY(!picker->isVisible());
    setOfTint("blue", 0.0);
    QCOMPARE(row->colour().name(), QStringLiteral("#336600"));
    setOfTint("bare", true);
    QVERIFY(!row->isEnabled());
    setOfTint("bare", false);
  }

 private:
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    view()->setFocus();
    QTest::keyClick(view(), key, modifiers);
  }
  /// A material that is installed and not in the scene.
  std::string idleBase() {
    const auto& materials = document().project().materials;
    for (const std::string& base : session().plugins()->ids(PluginKind::Material)) {
      if (std::none_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.base == base; }))
        return base;
    }
    return {};
  }
  void showList() {
    m_window->layoutOfDocks().showPage(QStringLiteral("Brush"));
    QTRY_VERIFY(list()->isVisible());
  }
  /// m, along x.
  static double farEnd(const VoxelShape& shape) {
    int last = INT_MIN;
    for (const VoxelShape::Run& run : shape.runs) last = std::max(last, run.x + run.length - 1);
    return shape.origin.x() + shape.spacing * last;
  }
  const VoxelShape& shapeOf(const std::string& id) { return std::get<VoxelShape>(document().body(id)->shape); }
  size_t countOf(const std::string& id) {
    return onEngine<size_t>(session(), [id](Engine& engine) {
      const ParticleStore& store = engine.particles();
      return static_cast<size_t>(std::count_if(store.body(), store.body() + store.size(),
                                               [&](uint32_t body) { return engine.bodyIds()[body] == id; }));
    });
  }
  /// High above the sample: a ball, another one that takes a part of it, and a third one beside them.
  Body threeStrokes() {
    Body body = sketchOf("cup", {});
    auto& shape = std::get<VoxelShape>(body.shape);
    shape.spacing = m_window->tools().spacing();
    shape.origin = Vector3::Constant(shape.spacing / 2);
    for (const auto& [x, erase] : {std::pair{0.0, false}, {0.04, true}, {0.2, false}}) {
      VoxelShape::Stroke stroke = strokeOf("sphere", erase, 0);
      stroke.samples = {{x, 0.6, 0, 1, 0, 0, 0, 0}};
      shape.strokes.push_back(stroke);
    }
    shape = redrawnIn(document().project(), body.id, shape, shape.spacing, *session().plugins());
    return body;
  }
  QColor colourOfBrush() {
    const ParameterSet own = m_window->tools().brush().shapeParameters();
    const api::ParameterList list = session().plugins()->parameters("tint");
    const auto part = [&](const char* key) {
      return static_cast<float>(std::get<double>(valueOf(own, *findDeclaration(list, key))));
    };
    return QColor::fromRgbF(part("red"), part("green"), part("blue"));
  }
  void setOfTint(const char* key, const Value& value) {
    BrushSettings brush = m_window->tools().brush();
    brush.parameters["tint"].values[key] = value;
    m_window->tools().setBrush(brush);
  }
  BrushBar* bar() const { return m_window->findChild<BrushBar*>(); }
  StrokesList* list() const { return m_window->findChild<StrokesList*>(); }
  QList<QAbstractButton*> buttons() const {
    QList<QAbstractButton*> all;
    for (QAbstractButton* button : bar()->findChildren<QAbstractButton*>(QStringLiteral("psBarButton"))) {
      if (button->isVisibleTo(bar())) all << button;
    }
    return all;
  }
  QAbstractButton* of(const char* property, const char* id) const {
    for (QAbstractButton* button : buttons())
      if (button->property(property).toString() == QLatin1String(id)) return button;
    return nullptr;
  }
  QAbstractButton* named(const char* tip) const {
    for (QAbstractButton* button : buttons())
      if (button->toolTip() == QLatin1String(tip)) return button;
    return nullptr;
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestBrushBar test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_brushbar.moc"
