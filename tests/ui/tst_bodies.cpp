// SPDX-License-Identifier: Apache-2.0
// Solids and meshes come into the running scene by hands, are shaped by their rows, and go again.
#include "core/geometry/solidfill.h"
#include "core/io/projectio.h"
#include "core/scene/pose.h"
#include "core/scene/solidform.h"
#include "tests/ui/answered.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/rows/panelheader.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/selection.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/viewport/viewport.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"

#include <QtCore/QFile>
#include <QtCore/QMimeData>
#include <QtCore/QTemporaryDir>
#include <QtCore/QUrl>
#include <QtGui/QAction>
#include <QtGui/QDropEvent>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>

#include <algorithm>

using namespace ps;

class TestBodies : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanupTestCase() { m_window.reset(); }

  /// The row of a sheet names the edge that is held by where it is, also when it is turned meanwhile.
  void theRowSaysWhichEdgeIsHeld() {
    m_window->action(QStringLiteral("add.sheet"))->trigger();
    const std::string id = document().project().bodies.back().id;
    const Address held{Owner::Shape, id, "held"};
    QVERIFY(m_window->revealParameter(held, false));
    QCOMPARE(document().setParameter(held, std::string("start")), QString());
    const auto text = [&] {
      return m_window->inspector().panelFor(held)->row(QString::fromStdString(held.text()))->valueText();
    };
    QCOMPARE(text(), QStringLiteral("Edge at −z"));
    QCOMPARE(document().setParameter({Owner::Shape, id, "rotation_x"}, 90.0), QString());
    QCOMPARE(text(), QStringLiteral("Top edge, +y"));
  }

  void everySolidJoinsTheScene_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind :
         {"ellipsoid", "block", "cylinder", "cone", "capsule", "torus", "tube", "bowl", "sheet", "rope", "hot-plate"})
      QTest::newRow(kind) << QString::fromLatin1(kind);
  }
  void everySolidJoinsTheScene() {
    QFETCH(QString, kind);
    const std::string before = writeProject(document().project());
    const size_t matter = idsNow(session()).size();
    m_window->action(QStringLiteral("add.") + kind)->trigger();
    QCOMPARE(document().project().bodies.size(), size_t{2});
    const Body body = document().project().bodies.back();
    const auto& solid = std::get<SolidShape>(body.shape);
    QCOMPARE(session().document().undoStack().undoText(),
             QStringLiteral("adding ") + QString::fromStdString(body.name));
    const size_t particles =
        solidMatter(solid, 0.02, toggleOf(body.parameters, bodyParameters(), "fixed")).places.size();
    QTRY_COMPARE(idsNow(session()).size(), matter + particles);  // all of them: it came where nothing was
    // Told in the menu, to some hundredths.
    QVERIFY(std::abs(particleCount(body, 0.02) / static_cast<double>(particles) - 1) < 0.1);
    const QAction* action = m_window->action(QStringLiteral("add.") + kind);
    for (QObject* place : action->associatedObjects()) {
      if (auto* menu = qobject_cast<QMenu*>(place)) Q_EMIT menu->aboutToShow();
    }
    const QString count = formatShort(particleCount(body, 0.02), 3) + QStringLiteral(" particles");
    QVERIFY2(action->toolTip().contains(count), qPrintable(action->toolTip()));
    const std::string after = writeProject(document().project());
    document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    QTRY_COMPARE(idsNow(session()).size(), matter);
    document().undoStack().redo();
    QCOMPARE(writeProject(document().project()), after);
  }

  /// In one step: it lies on the floor, of what conducts best, and what comes next stands on it and is heated by
  /// nothing else.
  void aHotPlateHeatsWhatStandsOnIt() {
    const std::string before = writeProject(document().project());
    const SceneWall* floor = document().wall("floor");
    const double ground = floor->point.y();
    QCOMPARE(document().setParameter({Owner::Wall, "floor", "heat"}, Value(std::string("adiabatic"))), QString());
    QCOMPARE(document().removeBody("ice"), QString());
    toTheStart();
    const int steps = document().undoStack().count();
    m_window->action(QStringLiteral("add.hot-plate"))->trigger();
    QCOMPARE(document().undoStack().count(), steps + 1);
    const Body plate = document().project().bodies.back();
    QCOMPARE(plate.name, std::string("Hot plate"));
    QCOMPARE(plate.material, std::string("aluminium"));
    const BodyBounds box = boundsOf(plate);
    QVERIFY(std::abs(box.minimum.y() - ground) < 1e-9);
    QVERIFY(box.size().y() < 0.25 * box.size().x());
    QVERIFY(document().value({Owner::Body, plate.id, "fixed"}) == Value(true));
    QVERIFY(document().value({Owner::Body, plate.id, "held_temperature"}) == Value(423.15));
    const QString tip = m_window->action(QStringLiteral("add.hot-plate"))->toolTip();
    QVERIFY2(tip.contains(QStringLiteral("Keeps 150.0 °C")), qPrintable(tip));

    m_window->selection().setMaterial("water");
    m_window->action(QStringLiteral("add.block"))->trigger();
    const Body water = document().project().bodies.back();
    QCOMPARE(water.material, std::string("water"));
    QVERIFY(boundsOf(water).minimum.y() > box.maximum.y() - 1e-9);
    const auto kelvin = [&](const std::string& id) {
      const SnapshotPtr now = session().newest();
      if (!now || !now->bodyIds) return 0.0;  // of a scene without matter
      const auto& ids = *now->bodyIds;
      const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
      double sum = 0, count = 0;
      for (size_t i = 0; i < now->body.size(); ++i)
        if (now->body[i] == index) sum += double{now->temperature[i]}, count += 1;
      return count > 0 ? sum / count : 0.0;
    };
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(kelvin(water.id) - 293.15) < 0.01, kLong);
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(kelvin(water.id) > 293.15 + 5, kLong);
    QVERIFY(std::abs(kelvin(plate.id) - 423.15) < 0.01);
    session().pause();
    picture(QStringLiteral("hot-plate.png"));
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  void rowsShapeABody() {
    m_window->action(QStringLiteral("add.torus"))->trigger();
    const std::string id = document().project().bodies.back().id;
    const QString width = QStringLiteral("shape/%1/size_x").arg(QString::fromStdString(id));
    QTRY_VERIFY(m_window->inspector().bodyPanel()->row(width));
    // How many particles it would be is told before it is so.
    const auto* header = m_window->inspector().bodyPanel()->findChild<PanelHeader*>();
    const auto ahead = [&] { return particlesAhead(particleCount(*document().body(id), 0.02)); };
    const QString first = ahead();
    QVERIFY2(header->toolTip().endsWith(first), qPrintable(header->toolTip()));
    QCOMPARE(document().setParameter({Owner::Shape, id, "size_x"}, 0.2), QString());
    QVERIFY(ahead() != first);
    QTRY_VERIFY2(header->toolTip().endsWith(ahead()), qPrintable(header->toolTip()));
    QCOMPARE(document().setParameter({Owner::Shape, id, "rotation_x"}, 90.0), QString());
    QVERIFY(!document().setParameter({Owner::Shape, id, "size_y"}, 0.0).isEmpty());
    toTheStart();
    picture(QStringLiteral("solid.png"));
    const auto& solid = std::get<SolidShape>(document().body(id)->shape);
    QVERIFY(SolidForm(solid).extent().isApprox(Vector3(0.2, SolidForm(solid).size()[2], SolidForm(solid).size()[1])));
    QCOMPARE(idsNow(session()).size(), 6000 + fillSolid(solid, 0.02).cells.size());
  }

  /// Whole layers: of a block one knows how many particles it will be, and says no other number than there are.
  void aBlockIsCountedBeforeItIsThere() {
    m_window->action(QStringLiteral("add.block"))->trigger();
    const std::string id = document().project().bodies.back().id;
    for (const char* size : {"size_x", "size_y", "size_z"})
      QCOMPARE(document().setParameter({Owner::Shape, id, size}, 0.108), QString());  // 5.4 of 20 mm
    const auto* header = m_window->inspector().bodyPanel()->findChild<PanelHeader*>();
    QTRY_VERIFY2(header->toolTip().endsWith(QStringLiteral("125 particles")), qPrintable(header->toolTip()));
    QVERIFY2(!header->toolTip().contains(QStringLiteral("≈")), qPrintable(header->toolTip()));
    QCOMPARE(fillSolid(std::get<SolidShape>(document().body(id)->shape), 0.02).cells.size(), size_t{125});
  }

  /// A bowl of what would run away is made of what stands; undoing that chooses what was chosen before, not the first
  /// of all materials.
  void bowlsAreOfWhatStands() {
    const std::string tin = document().addMaterial("tin");
    m_window->selection().setMaterial(tin);
    m_window->selection().setMaterial("water");
    m_window->action(QStringLiteral("add.bowl"))->trigger();
    const std::string stands = document().project().bodies.back().material;
    QVERIFY(stands != "water" && stands != tin);
    QCOMPARE(m_window->selection().material(), stands);
    document().undoStack().undo();
    QCOMPARE(m_window->selection().material(), std::string("water"));
    m_window->selection().setMaterial(tin);
    m_window->action(QStringLiteral("add.rope"))->trigger();
    QVERIFY(m_window->selection().material() != tin);
    document().undoStack().undo();
    QCOMPARE(m_window->selection().material(), tin);
    m_window->action(QStringLiteral("add.bowl"))->trigger();
    QCOMPARE(document().project().bodies.back().material, tin);
  }

  void aDroppedMeshIsImported() {
    const std::string before = writeProject(document().project());
    drop(QStringLiteral(PS_SOURCE_DIR "/resources/models/rabbit.obj"));
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), size_t{2}, kLong);
    const std::string id = document().project().bodies.back().id;
    QCOMPARE(id, std::string("rabbit"));
    const Vector3 metres = SolidForm(std::get<SolidShape>(document().body(id)->shape)).size();
    QTRY_VERIFY(idsNow(session()).size() > 6000 + particlesOf(id) / 2);  // what has no room beside the ice is left out
    const size_t large = idsNow(session()).size();
    QPushButton* centimetres = noticeButton(*m_window, QStringLiteral("In cm"));
    QVERIFY(centimetres);
    QTRY_VERIFY(centimetres->isVisible());
    picture(QStringLiteral("mesh-unit.png"));
    Probe warmth;
    warmth.quantity = "temperature";
    warmth.body = id;
    const std::string probe = document().plotProbe({}, warmth);
    const Address power{Owner::Body, id, "heating_power"};
    QCOMPARE(document().putKey(power, 0, 5), QString());
    const auto plotted = [&] {
      const std::vector<Graph> graphs = document().graphs();
      return std::any_of(graphs.begin(), graphs.end(), [&](const Graph& graph) {
        return std::find(graph.series.begin(), graph.series.end(), "probe/" + probe) != graph.series.end();
      });
    };
    QVERIFY(plotted());
    centimetres->click();
    const std::string small = document().project().bodies.back().id;
    // What measures and animates it stays, with its curve.
    QVERIFY(document().probe(probe) && document().track({Owner::Body, small, "heating_power"}) && plotted());
    QCOMPARE(document().probe(probe)->body, small);
    QVERIFY(SolidForm(std::get<SolidShape>(document().body(small)->shape)).size().isApprox(metres / 100));
    QTRY_COMPARE(idsNow(session()).size(), 6000 + particlesOf(small));  // the matter follows
    document().undoStack().undo();
    QVERIFY(SolidForm(std::get<SolidShape>(document().body(id)->shape)).size().isApprox(metres));
    QTRY_COMPARE(idsNow(session()).size(), large);
    // Once more: the same triangles are one mesh.
    drop(QStringLiteral(PS_SOURCE_DIR "/resources/models/rabbit.obj"));
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), size_t{3}, kLong);
    QCOMPARE(std::get<SolidShape>(document().project().bodies[1].shape).mesh,
             std::get<SolidShape>(document().project().bodies[2].shape).mesh);
    QVERIFY(noticeButton(*m_window, QStringLiteral("In cm")));
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
    QVERIFY(!noticeButton(*m_window, QStringLiteral("In cm")));  // nobody asks for what is gone
  }

  /// By Esc in the view: nothing comes of it, and the next one is read.
  void escGivesUpAMesh() {
    const QString rabbit = QStringLiteral(PS_SOURCE_DIR "/resources/models/rabbit.obj");
    const std::string before = writeProject(document().project());
    drop(rabbit);
    QElapsedTimer clock;
    clock.start();
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY2(clock.elapsed() < kAnswered, qPrintable(QString::number(clock.elapsed())));
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("was given up")),
             qPrintable(m_window->notice()->text()));
    QCOMPARE(writeProject(document().project()), before);
    drop(rabbit);  // one thread reads them in their order
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), size_t{2}, kLong);
    QVERIFY(noticeButton(*m_window, QStringLiteral("In cm")));
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  void theStatusLineSaysHowFarAMeshIs() {
    StatusLine* line = m_window->statusLine();
    line->setWork(QStringLiteral("Mending"), 80);
    QVERIFY(line->parts().contains(QStringLiteral("80 % mending")));
    line->setWork({}, -1);
    QVERIFY(line->parts().filter(QStringLiteral("mending")).isEmpty());
  }

  /// A fixed body of the mesh's surface, whose temperature may be held: the row of that acts on the running scene.
  void aMeshMakesAWall() {
    const std::string before = writeProject(document().project());
    hands::answerDialog(QStringLiteral(PS_SOURCE_DIR "/resources/models/rabbit.obj"));
    m_window->action(QStringLiteral("sketch.wall.mesh"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), size_t{2}, kLong);
    const std::string id = document().project().bodies.back().id;
    const auto& solid = std::get<SolidShape>(document().body(id)->shape);
    QVERIFY(SolidForm(solid).isHollow());
    QCOMPARE(document().body(id)->material, std::string("iron"));  // what melts last
    QVERIFY(std::abs(particleCount(*document().body(id), 0.02) / static_cast<double>(particlesOf(id)) - 1) < 0.2);
    const auto kelvin = [&](double wanted) {
      const SnapshotPtr now = session().newest();
      const auto& ids = *now->bodyIds;
      const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
      size_t count = 0;
      for (size_t i = 0; i < now->body.size(); ++i)
        count += now->body[i] == index && std::abs(double{now->temperature[i]} - wanted) < 0.01 ? 1 : 0;
      return count;
    };
    QTRY_VERIFY_WITH_TIMEOUT(kelvin(293.15) > particlesOf(id) / 2, kLong);
    session().play();
    QCOMPARE(document().setParameter({Owner::Body, id, "heat"}, Value(std::string("fixed_temperature"))), QString());
    QCOMPARE(document().setParameter({Owner::Body, id, "held_temperature"}, 400.0), QString());
    QTRY_VERIFY_WITH_TIMEOUT(kelvin(400) > particlesOf(id) / 2, kLong);
    picture(QStringLiteral("mesh-wall.png"));
    while (document().undoStack().canUndo()) document().undoStack().undo();
    QCOMPARE(writeProject(document().project()), before);
  }

  /// What an edit makes solid without anything that holds it is told, and held by a click.
  void looseGrainsAreTold() {
    const QString hold = QStringLiteral("Hold it together");
    m_window->action(QStringLiteral("add.block"))->trigger();
    const std::string id = document().project().bodies.back().id;
    QVERIFY(document().body(id)->constraints.empty());
    QVERIFY(!noticeButton(*m_window, hold));
    const Address temperature{Owner::Body, id, "temperature"};
    QCOMPARE(document().setParameter(temperature, 263.15), QString());
    QVERIFY(noticeButton(*m_window, hold));
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("like sand")));
    QTest::qWait(100);
    picture(QStringLiteral("loose-grains.png"));
    QCOMPARE(document().setParameter(temperature, 293.15), QString());
    QTRY_VERIFY(!noticeButton(*m_window, hold));
    QCOMPARE(document().setParameter(temperature, 253.15), QString());
    noticeButton(*m_window, hold)->click();
    QCOMPARE(document().body(id)->constraints.size(), size_t{1});
    QTRY_VERIFY(!noticeButton(*m_window, hold));
    // What is held in place is no sand.
    document().undoStack().undo();
    QVERIFY(noticeButton(*m_window, hold));
    QCOMPARE(document().setParameter({Owner::Body, id, "fixed"}, true), QString());
    QTRY_VERIFY(!noticeButton(*m_window, hold));
  }

  void aBrokenMeshIsTold() {
    QTemporaryDir folder;
    QFile file(folder.filePath(QStringLiteral("broken.stl")));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write("solid") == 5);
    file.close();
    drop(file.fileName());
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*m_window, QStringLiteral("Import another…")), kLong);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("cannot be read as a mesh")),
             qPrintable(m_window->notice()->text()));
    picture(QStringLiteral("mesh-broken.png"));
    QCOMPARE(document().project().bodies.size(), size_t{1});
  }

  /// One after the other, each above the one before, whatever page was shown; what is wrong with one of them is said.
  void severalMeshesAreDroppedAtOnce() {
    QTemporaryDir folder;
    QStringList paths;
    for (const char* name : {"one.obj", "broken.stl", "two.obj"}) {
      paths << folder.filePath(QString::fromLatin1(name));
      QFile file(paths.back());
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(paths.back().endsWith(QStringLiteral("stl")) ? QByteArray("solid") : tetrahedron());
    }
    m_window->action(QStringLiteral("add.library"))->trigger();
    QVERIFY(!m_window->viewport()->isVisible());
    drop(paths);
    QVERIFY(m_window->viewport()->isVisible());
    QTRY_VERIFY2_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("2 of 3 meshes are in the scene")),
                              qPrintable(m_window->notice()->text()), kLong);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("“broken.stl”: ")),
             qPrintable(m_window->notice()->text()));
    picture(QStringLiteral("meshes-several.png"));
    QCOMPARE(document().project().bodies.size(), size_t{3});
    QCOMPARE(document().undoStack().count(), 2);
    const BodyBounds first = boundsOf(document().project().bodies[1]),
                     second = boundsOf(document().project().bodies[2]);
    QVERIFY(second.minimum.y() >= first.maximum.y());
  }

  /// A project takes the place of the scene, so that it is not taken with others, nor is a folder.
  void whatCannotBeTakenIsTold() {
    QTemporaryDir folder;
    const std::string before = writeProject(document().project());
    drop({folder.path(), QStringLiteral("/nowhere/a.json"), QStringLiteral("/nowhere/b.json")});
    const QString told = m_window->notice()->text();
    QVERIFY2(told.contains(QStringLiteral("No file was taken.")) && told.contains(QStringLiteral("is a folder")) &&
                 told.contains(QStringLiteral("“a.json” is no mesh")),
             qPrintable(told));
    QCOMPARE(writeProject(document().project()), before);
  }

  /// Cancelled, none of those that wait comes.
  void aQueueOfMeshesIsCancelled() {
    QTemporaryDir folder;
    QStringList paths;
    for (const char* name : {"one.obj", "two.obj", "three.obj"}) {
      paths << folder.filePath(QString::fromLatin1(name));
      QFile file(paths.back());
      QVERIFY(file.open(QIODevice::WriteOnly));
      file.write(tetrahedron());
    }
    drop(paths);
    QTest::keyClick(m_window.get(), Qt::Key_Escape);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("and 2 more was given up")),
             qPrintable(m_window->notice()->text()));
    QTest::qWait(500);
    QCOMPARE(document().project().bodies.size(), size_t{1});
  }

 private:
  static QByteArray tetrahedron() {
    return "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  }
  size_t particlesOf(const std::string& id) {
    return fillSolid(std::get<SolidShape>(document().body(id)->shape), 0.02).cells.size();
  }
  void drop(const QString& path) { drop(QStringList{path}); }
  void drop(const QStringList& paths) {
    QMimeData data;
    QList<QUrl> urls;
    for (const QString& path : paths) urls << QUrl::fromLocalFile(path);
    data.setUrls(urls);
    const QPoint place(400, 300);
    QDragEnterEvent enter(place, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(m_window.get(), &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent event(place, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(m_window.get(), &event);
  }
};

QTEST_MAIN(TestBodies)
#include "tst_bodies.moc"
