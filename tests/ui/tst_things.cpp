// SPDX-License-Identifier: Apache-2.0
// Several things at once in the real window: edited, copied, pasted, grouped, searched, put in order, arranged.
#include "core/io/projectio.h"
#include "core/scene/group.h"
#include "core/scene/pose.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/freename.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/filterfield.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/selection.h"
#include "ui/window/dock.h"
#include "ui/window/noticebar.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QMimeData>
#include <QtGui/QAction>
#include <QtGui/QClipboard>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QTreeView>

#include <cmath>
#include <set>
#include <string>

using namespace ps;

class TestThings : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    backToTheStart();
    m_window->selection().clear();
    search()->clear();
  }
  void cleanupTestCase() { m_window.reset(); }

  void whatComesBackIsSelected() {
    const std::vector<std::string> ids = threeBalls();
    const std::vector<SelectedItem> two{{OutlineKind::Body, ids[0]}, {OutlineKind::Body, ids[2]}};
    m_window->selection().selectAll(two);
    trigger("edit.delete");
    QVERIFY(m_window->selection().empty());
    document().undoStack().undo();
    std::vector<SelectedItem> back = m_window->selection().items();
    std::sort(back.begin(), back.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    QVERIFY(back == two);
    QCOMPARE(tree()->selectionModel()->selectedRows().size(), qsizetype{2});
    document().undoStack().redo();
    m_window->selection().select(OutlineKind::Wall, "floor");
    document().undoStack().undo();  // somebody is at something else by now
    QVERIFY(m_window->selection().items() == std::vector<SelectedItem>({{OutlineKind::Wall, "floor"}}));
  }

  /// "—" where they disagree; what is typed sets all, "*2" scales each; one step.
  void rowsOfManyEditAll() {
    const std::vector<std::string> ids = threeBalls();
    QCOMPARE(document().setParameter({Owner::Shape, ids[0], "size_y"}, 0.06), QString());
    m_window->selection().selectAll({{OutlineKind::Body, ids[0]}, {OutlineKind::Body, ids[1]}});
    const QString key = QStringLiteral("shape/%1/size_y").arg(QString::fromStdString(ids[1]));
    QCOMPARE(row(key)->valueText(), QStringLiteral("—"));
    QVERIFY(row(key)->has(RowState::Mixed));
    QVERIFY(!row(QStringLiteral("shape/%1/size_x").arg(QString::fromStdString(ids[1])))->has(RowState::Mixed));
    picture(QStringLiteral("things-mixed.png"));
    const double other = sizeOf(ids[1]);
    const int steps = document().undoStack().index();
    QVERIFY(row(key)->enter(QStringLiteral("*2")));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY(std::abs(sizeOf(ids[0]) - 0.12) < 1e-12 && std::abs(sizeOf(ids[1]) - 2 * other) < 1e-12);
    QVERIFY(row(key)->has(RowState::Mixed));
    QVERIFY(row(key)->enter(QStringLiteral("70 mm")));
    QCOMPARE(document().undoStack().index(), steps + 2);
    QVERIFY(std::abs(sizeOf(ids[0]) - 0.07) < 1e-12 && std::abs(sizeOf(ids[1]) - 0.07) < 1e-12);
    QVERIFY(!row(key)->has(RowState::Mixed));
    document().undoStack().undo();
    document().undoStack().undo();
    QVERIFY(std::abs(sizeOf(ids[0]) - 0.06) < 1e-12 && std::abs(sizeOf(ids[1]) - other) < 1e-12);
    QVERIFY(row(key)->has(RowState::Mixed));
  }

  /// Walls and probes likewise, on the first page; a wall's row on the page of the scene is its own alone.
  void rowsOfManyWallsEditAll() {
    m_window->selection().selectAll({{OutlineKind::Wall, "floor"}, {OutlineKind::Wall, "left"}});
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Body"));
    const QString key = QStringLiteral("wall/left/friction");
    const auto friction = [&](const char* id) {
      return std::get<double>(document().value({Owner::Wall, id, "friction"}));
    };
    QVERIFY(row(key) && row(key)->has(RowState::Mixed));
    QCOMPARE(row(key)->valueText(), QStringLiteral("—"));
    picture(QStringLiteral("things-walls.png"));
    const int steps = document().undoStack().index();
    QVERIFY(row(key)->enter(QStringLiteral("*2")));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("Friction of 2 walls"));
    QVERIFY(std::abs(friction("floor") - 0.6) < 1e-12 && std::abs(friction("left") - 0.1) < 1e-12);
    QVERIFY(row(key)->enter(QStringLiteral("0.2")));
    QCOMPARE(document().undoStack().index(), steps + 2);
    QVERIFY(friction("floor") == 0.2 && friction("left") == 0.2 && !row(key)->has(RowState::Mixed));
    QVERIFY(m_window->inspector().scenePanel()->row(key)->enter(QStringLiteral("0.4")));
    QVERIFY(friction("floor") == 0.2 && friction("left") == 0.4 && row(key)->has(RowState::Mixed));
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
    QVERIFY(friction("floor") == 0.3 && friction("left") == 0.05);
    m_window->selection().select(OutlineKind::Wall, "left");
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Scene"));
    QVERIFY(!row(key));
  }

  void rowsOfManyProbesEditAll() {
    m_window->selection().selectAll({{OutlineKind::Probe, "coldest"}, {OutlineKind::Probe, "mean"}});
    QVERIFY(row(QStringLiteral("probe/mean/quantity"))->has(RowState::Mixed));
    const QString key = QStringLiteral("probe/mean/in_box"), side = QStringLiteral("probe/mean/box_min_x");
    const auto region = [&](const char* id) { return document().probe(id)->region; };
    QVERIFY(!row(key)->has(RowState::Mixed));
    const int steps = document().undoStack().index();
    for (const Edit edit : {Edit::Begin, Edit::Live, Edit::End})
      Q_EMIT m_window->inspector().bodyPanel()->edited(key, Value{true}, edit);
    QVERIFY(region("coldest") && region("mean"));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY(row(side)->enter(QStringLiteral("-0.1 m")));
    QCOMPARE(region("coldest")->minimum.x(), -0.1);
    QCOMPARE(region("mean")->minimum.x(), -0.1);
    QVERIFY(!row(side)->has(RowState::Mixed));
    // One that may not have a value keeps all from it.
    Probe other = *document().probe("coldest");
    other.region->minimum.x() = 0.1;
    document().editProbe(other, QStringLiteral("edit"));
    QVERIFY(row(side)->has(RowState::Mixed));
    const double most = region("mean")->maximum.x();
    const Address first{Owner::Probe, "mean", "box_max_x"}, second{Owner::Probe, "coldest", "box_max_x"};
    const QString problem = document().setParameters({{first, 0.05}, {second, 0.05}}, QStringLiteral("edit"));
    QVERIFY2(problem.contains(QStringLiteral("must be")), qPrintable(problem));
    QCOMPARE(region("mean")->maximum.x(), most);
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
    QVERIFY(!region("coldest") && !region("mean"));
    QCOMPARE(document().undoStack().index(), steps);
  }

  /// Taps and drains likewise; a switch has no knob where some are open.
  void rowsOfManyPortsEditAll() {
    Emitter pours;
    pours.material = "water";
    pours.point = {0, 0.6, 0};
    const std::string tap = document().addEmitter(pours).id, other = document().addEmitter(pours).id;
    const std::string drain = document().addSink({}).id, closed = document().addSink({}).id;
    const auto number = [&](const std::string& id) {
      return std::get<double>(document().value({Owner::Emitter, id, "speed"}));
    };
    const auto open = [&](const std::string& id) {
      return std::get<bool>(document().value({Owner::Sink, id, "open"}));
    };
    QCOMPARE(document().setParameter({Owner::Emitter, other, "speed"}, 2.0), QString());
    QCOMPARE(document().setParameter({Owner::Sink, closed, "open"}, false), QString());
    m_window->selection().selectAll({{OutlineKind::Emitter, tap}, {OutlineKind::Emitter, other}});
    const QString speed = QString::fromStdString("emitter/" + other + "/speed");
    QVERIFY(row(speed) && row(speed)->has(RowState::Mixed));
    const int steps = document().undoStack().index();
    QVERIFY(row(speed)->enter(QStringLiteral("*2")));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY(number(tap) == 2 && number(other) == 4);
    m_window->selection().selectAll({{OutlineKind::Sink, drain}, {OutlineKind::Sink, closed}});
    const QString switched = QString::fromStdString("sink/" + closed + "/open");
    QVERIFY(row(switched) && row(switched)->has(RowState::Mixed));
    QCOMPARE(row(switched)->valueText(), QStringLiteral("—"));
    QTest::mouseClick(row(switched), Qt::LeftButton, {}, QPoint(row(switched)->fieldRect().right() - 15, 13));
    QCOMPARE(document().undoStack().index(), steps + 2);
    QVERIFY(open(drain) && open(closed) && !row(switched)->has(RowState::Mixed));
    document().undoStack().undo();
    QVERIFY(open(drain) && !open(closed) && row(switched)->has(RowState::Mixed));
  }

  /// A row that is found by its name is of one body: that one is selected alone, and the row edits no other.
  void aRowThatIsRevealedIsOfOneBody() {
    const std::vector<std::string> ids = threeBalls();
    selectBodies(ids);
    const Address address{Owner::Shape, ids[1], "size_y"};
    const double other = sizeOf(ids[0]);
    QVERIFY(m_window->revealParameter(address));
    QCOMPARE(m_window->selection().bodies(), std::vector<std::string>{ids[1]});
    ParameterRow* revealed = row(QString::fromStdString(address.text()));
    QVERIFY(revealed && revealed->enter(QStringLiteral("50 mm")));
    QCOMPARE(sizeOf(ids[1]), 0.05);
    QCOMPARE(sizeOf(ids[0]), other);
    // Of another body than the one that is selected, too.
    QVERIFY(m_window->revealParameter({Owner::Body, ids[2], "temperature"}));
    QCOMPARE(m_window->selection().bodies(), std::vector<std::string>{ids[2]});
    QVERIFY(m_window->revealParameter({Owner::Wall, "floor", "temperature"}));  // shown with all others
    QCOMPARE(m_window->selection().bodies(), std::vector<std::string>{ids[2]});
  }

  void anEditOfManyComparesEachOnce_data() {
    QTest::addColumn<int>("bodies");
    QTest::newRow("10") << 10;
    QTest::newRow("100") << 100;
  }
  /// Each body's change asks the row again: a value or two for each, and all once at the end, for an edit and for undo.
  void anEditOfManyComparesEachOnce() {
    QFETCH(int, bodies);
    std::vector<std::string> ids;
    Body small = project().bodies.front();
    for (int k = 0; k < bodies; ++k) {
      small.shape = BoxShape{{0.04 * (k % 10) - 0.2, 0.3 + 0.04 * (k / 10), 0}, {0.02, 0.02, 0.02}};
      ids.push_back(document().addBody(small));
    }
    selectBodies(ids);
    const Inspector& inspector = m_window->inspector();
    const QString key = QStringLiteral("body/%1/temperature").arg(QString::fromStdString(ids.back()));
    QVERIFY(row(key));
    const auto most = static_cast<size_t>(4 * bodies);
    size_t before = inspector.comparedValues();
    QVERIFY(row(key)->enter(QStringLiteral("250 K")));
    QVERIFY(!row(key)->has(RowState::Mixed));
    qInfo("%d bodies, an edit compares %zu values", bodies, inspector.comparedValues() - before);
    QVERIFY(inspector.comparedValues() - before <= most);
    before = inspector.comparedValues();
    document().undoStack().undo();
    QVERIFY(!row(key)->has(RowState::Mixed));
    qInfo("undo %zu", inspector.comparedValues() - before);
    QVERIFY(inspector.comparedValues() - before <= most);
  }

  /// Rows of 400 bodies come without a search for each value of each of them.
  void rowsOfManyAreFoundAtOnce() {
    constexpr size_t kBodies = 400;
    const Project before = project();
    Project scene = before;
    std::vector<std::string> ids;
    Body small = scene.bodies.front();
    for (size_t k = 0; k < kBodies; ++k) {
      small.id = ids.emplace_back("many-" + std::to_string(k));
      SolidShape box;
      for (const char* key : {"size_x", "size_y", "size_z"}) box.parameters.values[key] = 0.02;
      box.parameters.values["kind"] = std::string("box");
      box.parameters.values["position_x"] = 0.02 * static_cast<double>(k % 20) - 0.2;
      box.parameters.values["position_y"] = 0.3 + 0.02 * static_cast<double>(k / 20);
      small.shape = box;
      small.parameters.values["temperature"] = 260 + static_cast<double>(k % 2);
      scene.bodies.push_back(small);
    }
    document().open(scene, {}, false, false);
    selectBodies({ids[0]});
    const Inspector& inspector = m_window->inspector();
    size_t searched = inspector.searchedThings(), compared = inspector.comparedValues();
    QElapsedTimer timer;
    timer.start();
    selectBodies(ids);
    const auto took = timer.elapsed();
    searched = inspector.searchedThings() - searched;
    compared = inspector.comparedValues() - compared;
    const size_t rows = inspector.bodyPanel()->rows().size();
    qInfo("%zu rows of %zu bodies: %zu searches, %zu comparisons, %lld ms", rows, kBodies, searched, compared, took);
    QVERIFY(rows > 20 && compared <= rows * kBodies);
    QVERIFY(searched <= 4 * kBodies);
    document().open(before, {}, false, false);
  }

  void copiesStandBesideAndAreSelected() {
    const std::vector<std::string> ids = threeBalls();
    selectBodies({ids[0], ids[1]});
    const size_t bodies = project().bodies.size();
    const int steps = document().undoStack().index();
    trigger("edit.duplicate");
    QCOMPARE(project().bodies.size(), bodies + 2);
    QCOMPARE(document().undoStack().index(), steps + 1);
    const std::vector<std::string> copies = m_window->selection().bodies();
    QCOMPARE(copies.size(), size_t{2});
    for (const std::string& copy : copies) {
      const BodyBounds own = boundsOf(*document().body(copy));
      for (const Body& other : project().bodies) {
        if (other.id == copy) continue;
        const BodyBounds box = boundsOf(other);
        const bool apart = (own.minimum.array() >= box.maximum.array() - 1e-6).any() ||
                           (own.maximum.array() <= box.minimum.array() + 1e-6).any();
        QVERIFY2(apart, other.id.c_str());
      }
    }
    trigger("edit.delete");
    QCOMPARE(project().bodies.size(), bodies);
    QCOMPARE(document().undoStack().index(), steps + 2);
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(project().bodies.size(), bodies);
  }

  /// A copy that was put elsewhere and turned is copied on in the same way, as long as it stays selected.
  void copiesGoOnInTheSameWay() {
    trigger("add.ellipsoid");
    const std::string first = project().bodies.back().id;
    trigger("edit.duplicate");
    const std::string second = m_window->selection().body();
    QVERIFY(second != first);
    const Vector3 from = middle(first), step(0.07, 0.01, 0);
    const auto set = [this](const std::string& id, const char* key, double value) {
      QCOMPARE(document().setParameter({Owner::Shape, id, key}, value), QString());
    };
    const auto turnOf = [this](const std::string& id) {
      return std::get<double>(document().value({Owner::Shape, id, "rotation_z"}));
    };
    set(second, "position_x", from.x() + step.x());
    set(second, "position_y", from.y() + step.y());
    set(second, "position_z", from.z());
    set(second, "rotation_z", 30);
    const int steps = document().undoStack().index();
    std::string last = second;
    Vector3 way = step;
    for (const double turn : {60.0, 90.0}) {  // each goes on from the one before
      const Vector3 before = middle(last);
      trigger("edit.duplicate");
      last = m_window->selection().body();
      const double sine = 0.5, cosine = std::sqrt(0.75);  // of 30 degrees
      way = Vector3(cosine * way.x() - sine * way.y(), sine * way.x() + cosine * way.y(), 0);
      QVERIFY((middle(last) - before - way).norm() < 1e-9);
      QVERIFY(std::abs(turnOf(last) - turn) < 1e-6);
    }
    QCOMPARE(document().undoStack().index(), steps + 2);
    // Selected anew, it is copied to where there is room, as it stands.
    m_window->selection().clear();
    m_window->selection().selectBody(last);
    trigger("edit.duplicate");
    QVERIFY(m_window->selection().body() != last);
    QVERIFY(std::abs(turnOf(m_window->selection().body()) - 90) < 1e-6);
  }

  /// "Ball" twice is "Ball" and "Ball 2", however it comes.
  void noTwoAreCalledTheSame() {
    const auto names = [this] {
      std::multiset<std::string> all;
      for (const Body& body : project().bodies) all.insert(nameOf(body).toStdString());
      return all;
    };
    trigger("add.ellipsoid");
    const std::string first = nameOf(project().bodies.back()).toStdString();
    trigger("add.ellipsoid");
    QCOMPARE(nameOf(project().bodies.back()).toStdString(), first + " 2");
    trigger("edit.duplicate");
    QCOMPARE(nameOf(project().bodies.back()).toStdString(), first + " 3");
    trigger("edit.copy");
    trigger("edit.paste");
    QCOMPARE(nameOf(project().bodies.back()).toStdString(), first + " 4");
    trigger("edit.cut");
    trigger("edit.paste");
    QCOMPARE(nameOf(project().bodies.back()).toStdString(), first + " 4");  // it is alone by now
    const auto all = names();
    QCOMPARE(all.size(), std::set<std::string>(all.begin(), all.end()).size());
    QCOMPARE(freeName("Ball", {"Cube"}), std::string("Ball"));
    QCOMPARE(freeName("Ball 2", {"Ball", "Ball 2"}), std::string("Ball 3"));
    QCOMPARE(freeName("H2", {"H2"}), std::string("H2 2"));
    QCOMPARE(freeName("2", {"2"}), std::string("2 2"));
  }

  /// That there is no room is said until something is edited.
  void noRoomIsSaidWhileItHolds() {
    const std::vector<std::string> ids = threeBalls();
    selectBodies({ids[0]});
    const auto said = [this] {
      return m_window->notice()->isVisible() && m_window->notice()->text().contains(QStringLiteral("no room"));
    };
    for (int k = 0; k < 400 && !said(); ++k) trigger("edit.duplicate");
    QVERIFY(said());
    session().reset();
    QVERIFY(said());
    document().undoStack().undo();
    QVERIFY(!said());
  }

  /// As a project file on the clipboard, with its materials; what is none is refused in a sentence.
  void copiesGoThroughTheClipboard() {
    selectBodies({"ice"});
    trigger("edit.copy");
    const QString text = QGuiApplication::clipboard()->text();
    const Project copied = parseProject(text.toStdString(), "clipboard", *session().plugins()).project;
    QCOMPARE(copied.bodies.size(), size_t{1});
    QCOMPARE(copied.materials.size(), size_t{1});
    const size_t bodies = project().bodies.size(), materials = project().materials.size();
    trigger("edit.paste");
    QCOMPARE(project().bodies.size(), bodies + 1);
    QCOMPARE(project().materials.size(), materials);  // the same is not had twice
    const std::string pasted = m_window->selection().body();
    QVERIFY(pasted != "ice" && document().body(pasted));
    QCOMPARE(document().body(pasted)->material, document().body("ice")->material);
    trigger("edit.cut");
    QCOMPARE(project().bodies.size(), bodies);
    // Of another scene: its material comes along, under a name of its own.
    Project foreign = copied;
    foreign.materials[0].properties.values["density_solid"] = 700.0;
    QGuiApplication::clipboard()->setText(QString::fromStdString(writeProject(foreign)));
    trigger("edit.paste");
    QCOMPARE(project().materials.size(), materials + 1);
    QCOMPARE(document().body(m_window->selection().body())->material, project().materials.back().id);
    document().undoStack().undo();
    QCOMPARE(project().materials.size(), materials);
    QCOMPARE(project().bodies.size(), bodies);
    for (const QString& wrong : {QStringLiteral("nothing"), QStringLiteral("{\"format\": 7}"), QStringLiteral("{}")}) {
      QGuiApplication::clipboard()->setText(wrong);
      trigger("edit.paste");
      QCOMPARE(project().bodies.size(), bodies);
      const auto labels = m_window->notice()->findChildren<QLabel*>();
      QVERIFY(std::any_of(labels.begin(), labels.end(),
                          [](const QLabel* label) { return label->text().contains(QStringLiteral("clipboard")); }));
    }
  }

  void wallsAndProbesAreCopiedToo() {
    m_window->selection().selectAll({{OutlineKind::Wall, "floor"}, {OutlineKind::Probe, project().probes[0].id}});
    trigger("edit.copy");
    const size_t walls = project().environment.walls.size(), probes = project().probes.size();
    trigger("edit.paste");
    QCOMPARE(project().environment.walls.size(), walls + 1);
    QCOMPARE(project().probes.size(), probes + 1);
    QCOMPARE(m_window->selection().items().size(), size_t{2});
    document().undoStack().undo();
    QCOMPARE(project().environment.walls.size(), walls);
  }

  /// As a body is, also with other things: a step each, kept by the file; what is locked stays, and its copy is free.
  void wallsAreRenamedHiddenAndLocked() {
    m_window->selection().select(OutlineKind::Wall, "floor");
    tree()->setFocus();
    trigger("edit.rename");
    auto* field = tree()->findChild<QLineEdit*>();
    QVERIFY(field);
    field->setText(QStringLiteral("Stove"));
    QTest::keyClick(field, Qt::Key_Return);
    QTRY_COMPARE(document().wall("floor")->name, std::string("Stove"));
    const std::string probe = project().probes[0].id;
    m_window->selection().selectAll({{OutlineKind::Probe, probe}, {OutlineKind::Wall, "floor"}});
    const int steps = document().undoStack().index();
    trigger("edit.visible");
    trigger("edit.locked");
    QCOMPARE(document().undoStack().index(), steps + 2);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("locking 2 things"));
    const auto marked = [](const auto& thing) { return !thing.visible && thing.locked; };
    QVERIFY(marked(*document().wall("floor")) && marked(*document().probe(probe)));
    const QModelIndex row = rowOf(OutlineKind::Wall, "floor");
    QVERIFY(!row.data(outline::kVisible).toBool() && row.data(outline::kLocked).toBool());
    QVERIFY(row.data(Qt::ToolTipRole).toString().contains(QStringLiteral("acts all the same")));
    const LoadedProject again = parseProject(writeProject(project()), "again", *session().plugins());
    QVERIFY(marked(again.project.environment.walls[0]) && marked(again.project.probes[0]));
    trigger("edit.delete");
    QCOMPARE(document().undoStack().index(), steps + 2);
    trigger("edit.copy");
    trigger("edit.paste");
    QVERIFY(!project().environment.walls.back().locked && !project().probes.back().locked);
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
    QVERIFY(document().wall("floor")->visible && !document().wall("floor")->locked);
    QVERIFY(document().probe(probe)->visible && !document().probe(probe)->locked);
  }

  void groupsAreMadeRenamedHiddenAndSaved() {
    const std::vector<std::string> ids = threeBalls();
    selectBodies({ids[0], ids[1]});
    trigger("edit.group");
    QCOMPARE(project().groups.size(), size_t{1});
    const QModelIndex group = rowOf(OutlineKind::Group, project().groups[0].id);
    QVERIFY(group.isValid());
    QCOMPARE(tree()->model()->rowCount(group), 2);
    document().renameGroup(project().groups[0].id, QStringLiteral("Table"));
    const LoadedProject again = parseProject(writeProject(project()), "again", *session().plugins());
    QVERIFY(again.project.groups == project().groups);
    // A click on it selects all that is in it.
    m_window->selection().clear();
    const QRect place = tree()->visualRect(rowOf(OutlineKind::Group, project().groups[0].id));
    QTest::mouseClick(tree()->viewport(), Qt::LeftButton, {}, place.center());
    QCOMPARE(m_window->selection().bodies().size(), size_t{2});
    picture(QStringLiteral("things-group.png"));
    trigger("edit.visible");
    QVERIFY(!document().body(ids[0])->visible && !document().body(ids[1])->visible);
    document().undoStack().undo();
    QVERIFY(document().body(ids[0])->visible && document().body(ids[1])->visible);
    // Alone is alone: walls, taps, drains and probes are hidden with the bodies, as one step.
    const int steps = document().undoStack().index();
    trigger("edit.isolate");
    QVERIFY(!document().body("ice")->visible && !document().body(ids[2])->visible && document().body(ids[0])->visible);
    for (const SceneWall& wall : project().environment.walls) QVERIFY(!wall.visible);
    for (const Probe& probe : project().probes) QVERIFY(!probe.visible);
    QCOMPARE(document().undoStack().index(), steps + 1);
    trigger("edit.isolate");
    QVERIFY(document().body("ice")->visible);
    for (const SceneWall& wall : project().environment.walls) QVERIFY(wall.visible);
    for (const Probe& probe : project().probes) QVERIFY(probe.visible);
    // Of a wall likewise.
    m_window->selection().select(OutlineKind::Wall, project().environment.walls[0].id);
    trigger("edit.isolate");
    QVERIFY(project().environment.walls[0].visible && !document().body("ice")->visible);
    trigger("edit.isolate");
    QVERIFY(document().body("ice")->visible);
    // What is deleted leaves it, and comes back into it.
    m_window->selection().select(OutlineKind::Body, ids[0]);
    trigger("edit.delete");
    QCOMPARE(livingGroups(project())[0].members.size(), size_t{1});
    document().undoStack().undo();
    QCOMPARE(livingGroups(project())[0].members.size(), size_t{2});
    selectBodies({ids[0]});
    trigger("edit.ungroup");
    QVERIFY(project().groups.empty());
  }

  /// Rows are made anew at each edit; what is folded stays so, but for a search that finds something in it.
  void whatIsFoldedStaysFolded() {
    const std::vector<std::string> ids = threeBalls();
    selectBodies({ids[0], ids[1]});
    trigger("edit.group");
    QCOMPARE(project().groups.size(), size_t{1});
    const SceneGroup group = project().groups[0];
    const auto isOpen = [&] { return tree()->isExpanded(rowOf(OutlineKind::Group, group.id)); };
    QVERIFY(isOpen());
    tree()->collapse(rowOf(OutlineKind::Group, group.id));
    document().renameGroup(group.id, QStringLiteral("Table"));
    QVERIFY(!isOpen());
    auto* search = m_window->findChild<Outliner*>()->findChild<QLineEdit*>();
    QVERIFY(search);
    search->setText(QString::fromStdString(document().body(ids[1])->name));
    QTRY_VERIFY(isOpen());
    search->clear();
    QTRY_VERIFY(!isOpen());
    tree()->expand(rowOf(OutlineKind::Group, group.id));
    document().renameGroup(group.id, QStringLiteral("Chair"));
    QVERIFY(isOpen());
  }

  /// Probes are members like walls: hidden and locked together, copied and saved with the group, back by undo.
  void probesAreMembersOfGroups() {
    const std::string first = project().probes[0].id, second = project().probes[1].id;
    const auto rowIn = [&](OutlineKind kind, const std::string& id) {
      return static_cast<OutlineKind>(rowOf(kind, id).parent().data(outline::kKind).toInt());
    };
    QCOMPARE(rowIn(OutlineKind::Probe, first), OutlineKind::Probes);
    m_window->selection().selectAll({{OutlineKind::Probe, first}, {OutlineKind::Wall, "floor"}});
    const int steps = document().undoStack().index();
    trigger("edit.group");
    QCOMPARE(document().undoStack().index(), steps + 1);
    QCOMPARE(project().groups.size(), size_t{1});
    const std::string id = project().groups[0].id;
    const std::vector<std::string> members{memberOf(Owner::Probe, first), memberOf(Owner::Wall, "floor")};
    QCOMPARE(project().groups[0].members, members);
    QCOMPARE(rowIn(OutlineKind::Probe, first), OutlineKind::Group);
    QCOMPARE(rowIn(OutlineKind::Probe, second), OutlineKind::Probes);
    QCOMPARE(tree()->model()->rowCount(rowOf(OutlineKind::Group, id)), 2);
    const LoadedProject again = parseProject(writeProject(project()), "again", *session().plugins());
    QVERIFY(again.project.groups == project().groups);
    m_window->selection().clear();
    QTest::mouseClick(tree()->viewport(), Qt::LeftButton, {},
                      tree()->visualRect(rowOf(OutlineKind::Group, id)).center());
    QVERIFY(m_window->selection().has(OutlineKind::Probe, first) &&
            m_window->selection().has(OutlineKind::Wall, "floor"));
    trigger("edit.visible");
    trigger("edit.locked");
    const auto marked = [](const auto& thing) { return !thing.visible && thing.locked; };
    QVERIFY(marked(*document().wall("floor")) && marked(*document().probe(first)));
    const QModelIndex row = rowOf(OutlineKind::Group, id);
    QVERIFY(!row.data(outline::kVisible).toBool() && row.data(outline::kLocked).toBool());
    document().undoStack().undo();
    document().undoStack().undo();
    QVERIFY(document().probe(first)->visible && !document().probe(first)->locked);
    // A copy of it has a probe of its own.
    trigger("edit.copy");
    trigger("edit.paste");
    QCOMPARE(project().groups.size(), size_t{2});
    QCOMPARE(project().groups[1].members.size(), size_t{2});
    QVERIFY(project().groups[1].members != members);
    document().undoStack().undo();
    // What is deleted leaves it, and comes back into it.
    m_window->selection().select(OutlineKind::Probe, first);
    trigger("edit.delete");
    QCOMPARE(livingGroups(project())[0].members, std::vector<std::string>{memberOf(Owner::Wall, "floor")});
    document().undoStack().undo();
    QCOMPARE(livingGroups(project())[0].members, members);
    // By hand: out of it, and another one into it.
    drop({rowOf(OutlineKind::Probe, first)}, rowOf(OutlineKind::Probes, ""), -1);
    QCOMPARE(rowIn(OutlineKind::Probe, first), OutlineKind::Probes);
    drop({rowOf(OutlineKind::Probe, second)}, rowOf(OutlineKind::Group, id), -1);
    QCOMPARE(rowIn(OutlineKind::Probe, second), OutlineKind::Group);
    m_window->selection().select(OutlineKind::Probe, second);
    trigger("edit.ungroup");
    QVERIFY(project().groups.empty());
    while (document().undoStack().index() > steps) document().undoStack().undo();
    QVERIFY(project().groups.empty());
    QCOMPARE(rowIn(OutlineKind::Probe, first), OutlineKind::Probes);
  }

  void rowsAreDraggedIntoOrderAndGroups() {
    const std::vector<std::string> ids = threeBalls();
    selectBodies({ids[0]});
    trigger("edit.group");
    drop({rowOf(OutlineKind::Body, ids[2])}, rowOf(OutlineKind::Group, project().groups[0].id), -1);
    QCOMPARE(project().groups[0].members.size(), size_t{2});
    const auto scene = [&] { return tree()->model()->index(0, 0); };  // rows are made anew by each edit
    drop({rowOf(OutlineKind::Body, ids[0])}, scene(), -1);
    QCOMPARE(project().groups[0].members, std::vector<std::string>{memberOf(Owner::Body, ids[2])});
    // Before the ice.
    drop({rowOf(OutlineKind::Body, ids[1])}, scene(), rowOf(OutlineKind::Body, "ice").row());
    QCOMPARE(project().bodies.front().id, ids[1]);
    document().undoStack().undo();
    QCOMPARE(project().bodies.front().id, std::string("ice"));
  }

  void theSearchFindsByName() {
    threeBalls();
    QTest::keyClicks(search(), QStringLiteral("PLATE"));
    QVERIFY(!hidden(OutlineKind::Wall, "floor"));
    QVERIFY(hidden(OutlineKind::Body, "ice"));
    search()->setText(QStringLiteral("x<y"));
    QVERIFY(hidden(OutlineKind::Wall, "floor"));
    const auto labels = m_window->findChild<Outliner*>()->findChildren<QLabel*>();
    QVERIFY(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
      return label->isVisible() && label->text().contains(QStringLiteral("Nothing called “x&lt;y”"));
    }));
    picture(QStringLiteral("things-search.png"));
    search()->clear();
    QVERIFY(!hidden(OutlineKind::Body, "ice"));
  }

  void withoutMatterTheOutlinerSaysWhatToDo() {
    const auto says = [&] {
      const auto labels = m_window->findChild<Outliner*>()->findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
        return label->isVisible() && label->text() == QStringLiteral("Add a body or press B to sketch");
      });
    };
    QVERIFY(!says());
    QCOMPARE(document().removeBody("ice"), QString());
    QVERIFY(says());
    document().undoStack().undo();
    QVERIFY(!says());
  }

  void thingsAreAlignedSpreadAndDropped() {
    const std::vector<std::string> ids = threeBalls();
    for (size_t k = 0; k < 3; ++k) {
      QCOMPARE(document().setParameter({Owner::Shape, ids[k], "position_y"}, 0.5 + 0.03 * static_cast<double>(k)),
               QString());
      QCOMPARE(document().setParameter({Owner::Shape, ids[k], "position_x"},
                                       k == 1 ? -0.05 : 0.2 * (static_cast<double>(k) - 1)),
               QString());
    }
    awaitMatter();
    selectBodies(ids);
    const int steps = document().undoStack().index();
    trigger("arrange.align.middle_y");
    QCOMPARE(document().undoStack().index(), steps + 1);
    for (const std::string& id : ids) QVERIFY(std::abs(middle(id).y() - middle(ids[0]).y()) < 0.25 * spacing());
    awaitMatter();
    trigger("arrange.distribute.x");
    QVERIFY(std::abs(middle(ids[1]).x() - 0.5 * (middle(ids[0]).x() + middle(ids[2]).x())) < 0.25 * spacing());
    awaitMatter();
    trigger("arrange.drop");
    const double floor = document().wall("floor")->point.y();
    for (const std::string& id : ids) {
      const double low = boundsOf(*document().body(id)).minimum.y() - floor;
      QVERIFY2(low > -0.6 * spacing() && low < 0.4, qPrintable(QString::number(low)));
    }
    document().undoStack().undo();
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(document().undoStack().index(), steps);
  }

  /// Pins are boxes too, and walls a place; what has neither is told of.
  void pinsAndWallsAreArrangedToo() {
    m_window->selection().selectBody("ice");
    trigger("edit.pin");
    m_window->selection().selectBody("ice");
    trigger("edit.pin");
    const std::vector<Region> pins = document().body("ice")->pins;
    QCOMPARE(pins.size(), size_t{2});
    QVERIFY(pins[1].minimum.x() > pins[0].minimum.x() + spacing());
    m_window->selection().selectAll({{OutlineKind::Pin, "ice/0"}, {OutlineKind::Pin, "ice/1"}});
    const int steps = document().undoStack().index();
    trigger("arrange.align.left");
    QCOMPARE(document().undoStack().index(), steps + 1);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("aligning 2 pins"));
    const std::vector<Region>& now = document().body("ice")->pins;
    QVERIFY((now[1].minimum - pins[0].minimum).cwiseAbs().x() < 1e-12 && now[0] == pins[0]);
    QVERIFY(std::abs(now[1].maximum.x() - now[1].minimum.x() - pins[1].maximum.x() + pins[1].minimum.x()) < 1e-12);
    document().undoStack().undo();
    QVERIFY(document().body("ice")->pins == pins);

    m_window->selection().selectAll(
        {{OutlineKind::Body, "ice"}, {OutlineKind::Wall, "floor"}, {OutlineKind::Probe, project().probes[0].id}});
    trigger("arrange.align.left");
    QVERIFY(std::abs(document().wall("floor")->point.x() - boundsOf(*document().body("ice")).minimum.x()) <
            2 * spacing());
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("measures wherever its matter is")),
             qPrintable(m_window->notice()->text()));
    document().undoStack().undo();
    m_window->selection().select(OutlineKind::Wall, "floor");
    const int before = document().undoStack().index();
    trigger("arrange.drop");
    QCOMPARE(document().undoStack().index(), before);
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("a wall stays where it is put")));
  }

 private:
  const Project& project() { return document().project(); }
  QTreeView* tree() { return m_window->findChild<Outliner*>()->view(); }
  FilterField* search() { return m_window->findChild<Outliner*>()->findChild<FilterField*>(); }
  ParameterRow* row(const QString& key) { return m_window->inspector().bodyPanel()->row(key); }
  double spacing() { return m_window->tools().spacing(); }
  double sizeOf(const std::string& id) { return std::get<double>(document().value({Owner::Shape, id, "size_y"})); }
  Vector3 middle(const std::string& id) { return boundsOf(*document().body(id)).middle(); }
  void trigger(const char* action) { m_window->action(QString::fromLatin1(action))->trigger(); }
  void selectBodies(const std::vector<std::string>& ids) {
    std::vector<SelectedItem> items;
    for (const std::string& id : ids) items.push_back({OutlineKind::Body, id});
    m_window->selection().selectAll(std::move(items));
  }
  /// The view has seen all edits.
  void awaitMatter() {
    const size_t count = idsNow(session()).size();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->id.size() == count, kLong);
  }
  std::vector<std::string> threeBalls() {
    std::vector<std::string> ids;
    for (int k = 0; k < 3; ++k) {
      trigger("add.ellipsoid");
      ids.push_back(project().bodies.back().id);
      [&] { awaitMatter(); }();
    }
    return ids;
  }
  QModelIndex rowOf(OutlineKind kind, const std::string& id) {
    const QModelIndexList found =
        tree()->model()->match(tree()->model()->index(0, 0), outline::kId, QString::fromStdString(id), -1,
                               Qt::MatchExactly | Qt::MatchRecursive);
    for (const QModelIndex& index : found) {
      if (index.data(outline::kKind).toInt() == static_cast<int>(kind)) return index;
    }
    return {};
  }
  bool hidden(OutlineKind kind, const std::string& id) {
    const QModelIndex index = rowOf(kind, id);
    return tree()->isRowHidden(index.row(), index.parent());
  }
  void drop(const QModelIndexList& rows, const QModelIndex& parent, int row) {
    const std::unique_ptr<QMimeData> data(tree()->model()->mimeData(rows));
    QVERIFY(tree()->model()->canDropMimeData(data.get(), Qt::MoveAction, row, 0, parent));
    tree()->model()->dropMimeData(data.get(), Qt::MoveAction, row, 0, parent);
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestThings test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_things.moc"
