// SPDX-License-Identifier: Apache-2.0
// The whole window on a real scene: the road from a slider to the simulation and back.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/stackview.h"
#include "ui/panels/inspector.h"
#include "ui/panels/messagespage.h"
#include "ui/panels/outliner.h"
#include "ui/panels/pluginpage.h"
#include "ui/render/camera.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/selection.h"
#include "ui/theme/plaintext.h"
#include "ui/timeline/transport.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"
#include "ui/window/actions.h"
#include "ui/window/dock.h"
#include "ui/window/noticebar.h"
#include "ui/window/screenshot.h"
#include "ui/window/statusline.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QTemporaryDir>
#include <QtGui/QAccessible>
#include <QtGui/QAction>
#include <QtGui/QClipboard>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QToolTip>

#include <algorithm>
#include <chrono>
#include <clocale>
#include <cmath>
#include <future>
#include <memory>
#include <set>
#include <tuple>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};

double floorInEngine(Session& session) {
  return onEngine<double>(session, [](Engine& e) {
    for (const SceneWall& wall : e.project().environment.walls) {
      if (wall.id == "floor") return numberOf(wall.parameters, wallParameters(), "temperature");
    }
    return 0.0;
  });
}

int colourCount(const QImage& image, const QRect& area) {
  std::set<QRgb> colours;
  for (int y = area.top(); y <= area.bottom(); y += 3) {
    for (int x = area.left(); x <= area.right(); x += 3) colours.insert(image.pixel(x, y));
  }
  return static_cast<int>(colours.size());
}

}  // namespace

class TestWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QFile broken(m_plugins.filePath(QStringLiteral("broken.so")));
    QVERIFY(broken.open(QIODevice::WriteOnly));
    broken.write("not a library");
    broken.close();
    m_window = sampleWindow({1280, 800}, {m_plugins.path().toStdString()});
    QVERIFY(m_window);
  }

  void init() {
    session().pause();
    idsNow(session());  // whatever the test before asked of the engine is done
    QTest::qWait(50);   // and seen
  }

  void cleanupTestCase() { m_window.reset(); }

  void opensTheSampleRunning() {
    QCOMPARE(document().title(), QStringLiteral("Ice on a hot plate"));
    QVERIFY(session().snapshot()->id.size() > 5000);
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > 5, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->graphs()->valuesIn("K")->sampleCount(0) > 3, kLong);
    QTRY_VERIFY(m_window->statusLine()->parts().join(QLatin1Char(' ')).contains(QStringLiteral("particles")));
  }

  void aSliderMovesTheSimulation() {
    ParameterPanel* panel = m_window->inspector().materialPanel();
    m_window->inspectorDock()->showPage(QStringLiteral("Material"));
    ParameterRow* row = panel->row(QStringLiteral("wall/floor/temperature"));
    QVERIFY(row);  // pinned
    QVERIFY(row->model().pinned);
    const double before = std::get<double>(document().value(kFloor));
    const int steps = document().undoStack().count();
    QCOMPARE(floorInEngine(session()), before);
    const QRect track = row->sliderRect();
    QTest::mousePress(row, Qt::LeftButton, {}, QPoint(track.left() + track.width() / 2, track.center().y()));
    for (int k = 1; k <= 8; ++k)
      QTest::mouseMove(row, QPoint(track.left() + track.width() / 2 + k, track.center().y()));
    QTest::mouseRelease(row, Qt::LeftButton, {}, QPoint(track.left() + track.width() / 2 + 8, track.center().y()));
    const double after = std::get<double>(document().value(kFloor));
    QVERIFY(after != before);
    QCOMPARE(document().undoStack().count(), steps + 1);
    QCOMPARE(floorInEngine(session()), after);
    m_window->action(QStringLiteral("edit.undo"))->trigger();
    QCOMPARE(std::get<double>(document().value(kFloor)), before);
    QCOMPARE(floorInEngine(session()), before);
    QTRY_COMPARE(row->number(), before);  // a gesture ends a moment after its last click
  }

  /// One of each owner that has any, while the run goes on; the sample's model of heat has none.
  void aSliderActsWhileItRuns() {
    const int step = document().undoStack().index();
    Emitter tap;
    tap.material = document().project().materials.front().id;
    document().addEmitter(tap);
    document().addSink({});
    session().play();
    std::set<Owner> moved;
    for (const Address& address : allAddresses(document().project(), session().plugins())) {
      if (moved.count(address.owner) || document().actsAtReset(address)) continue;
      if (!m_window->revealParameter(address, false)) continue;
      ParameterRow* row = m_window->inspector().panelFor(address)->row(QString::fromStdString(address.text()));
      if (!row || row->model().declaration.kind != api::ParameterKind::Number || row->has(RowState::Disabled)) continue;
      const QString wrong = slideWhileHeld(*row, address);
      QVERIFY2(wrong.isEmpty(), (address.text() + ": " + wrong.toStdString()).c_str());
      moved.insert(address.owner);
    }
    for (const Owner owner : {Owner::Material, Owner::Wall, Owner::Environment, Owner::Solver, Owner::Body,
                              Owner::Emitter, Owner::Sink, Owner::Constraint, Owner::Scene})
      QVERIFY2(moved.count(owner), std::string(ownerName(owner)).c_str());
    session().pause();
    while (document().undoStack().index() > step) document().undoStack().undo();
    session().reset();
  }

  void aHotterFloorHeatsFaster() {
    const auto heatIn = [&](double kelvin) {
      document().setParameter(kFloor, kelvin);
      session().reset();
      return onEngine<double>(session(), [](Engine& e) {
        for (int k = 0; k < 10; ++k) e.step();
        return e.stats().heat.walls;
      });
    };
    const double cool = heatIn(300), hot = heatIn(600);
    // Conduction from a held wall is proportional to the difference to −10 °C: 37 K and 337 K.
    QVERIFY2(hot > 4 * cool, qPrintable(QStringLiteral("%1 %2").arg(cool).arg(hot)));
    document().undoStack().undo();
    document().undoStack().undo();
    session().reset();
  }

  void savesAndReadsBack() {
    QTemporaryDir directory;
    const QString path = directory.filePath(QStringLiteral("saved.json"));
    document().setParameter(kFloor, 401.5);
    DocumentFiles& files = session().files();
    QSignalSpy saved(&files, &DocumentFiles::saved), opened(&files, &DocumentFiles::opened);
    m_window->saveTo(path);
    QVERIFY(saved.wait(kLong));
    const std::string text = writeProject(document().project());
    m_window->openFile(path);
    QVERIFY(opened.wait(kLong));
    QCOMPARE(writeProject(document().project()), text);
    QCOMPARE(std::get<double>(document().value(kFloor)), 401.5);
    openSample();
  }

  void aBrokenProjectKeepsTheScene_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::newRow("truncated") << QByteArray("{\"format\": \"phasesketch\",");
    QTest::newRow("not a number") << QByteArray("{\"format\": \"phasesketch\", \"version\": \"one\"}");
  }
  void aBrokenProjectKeepsTheScene() {
    QFETCH(QByteArray, content);
    QTemporaryDir directory;
    const QString path = directory.filePath(QStringLiteral("broken.json"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
    file.close();
    const std::string before = writeProject(document().project());
    const uint64_t revision = session().snapshot()->revision;
    QSignalSpy failed(&session().files(), &DocumentFiles::openFailed);
    m_window->openFile(path);
    QVERIFY(failed.wait(kLong));
    QVERIFY(m_window->notice()->isVisible());
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("broken.json")));
    QCOMPARE(writeProject(document().project()), before);
    QCOMPARE(session().snapshot()->revision, revision);
  }

  void aStrokeAddsAndUndoRemovesExactly() {
    Viewport* view = m_window->viewport();
    QVERIFY2(view && view->problem().isEmpty(), view ? qPrintable(view->problem()) : "no viewport");
    const uint64_t revision = session().snapshot()->revision;
    session().reset();
    // The brush stands on what the view shows: it must show the scene after the reset.
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision && view->snapshot() == session().snapshot(),
                             kLong);
    const std::set<uint32_t> before = idsNow(session());
    m_window->action(QStringLiteral("sketch.brush"))->trigger();
    QCOMPARE(m_window->tools().active(), std::string("brush"));
    BrushSettings brush = m_window->tools().brush();
    brush.radius = 0.05;
    m_window->tools().setBrush(brush);
    const int steps = document().undoStack().count();
    const QPoint start(view->width() / 2 - 60, view->height() / 2);
    QTest::mousePress(view, Qt::LeftButton, {}, start);
    for (int k = 1; k <= 6; ++k) QTest::mouseMove(view, start + QPoint(12 * k, 0));
    QTest::mouseRelease(view, Qt::LeftButton, {}, start + QPoint(72, 0));
    const std::set<uint32_t> with = idsNow(session());
    QVERIFY2(with.size() > before.size(), qPrintable(m_window->notice()->text()));
    QCOMPARE(document().undoStack().count(), steps + 1);
    QCOMPARE(document().project().bodies.size(), size_t{2});
    document().undoStack().undo();
    QVERIFY(idsNow(session()) == before);
    QCOMPARE(document().project().bodies.size(), size_t{1});
    m_window->action(QStringLiteral("sketch.select"))->trigger();
  }

  void escGivesUpAStroke() {
    Viewport* view = m_window->viewport();
    const std::set<uint32_t> before = idsNow(session());
    const int steps = document().undoStack().count();
    m_window->action(QStringLiteral("sketch.brush"))->trigger();
    const QPoint start(view->width() / 2, view->height() / 2);
    QTest::mousePress(view, Qt::LeftButton, {}, start);
    QTest::mouseMove(view, start + QPoint(20, 0));
    QVERIFY(view->cancelGesture());
    QTest::mouseRelease(view, Qt::LeftButton, {}, start + QPoint(20, 0));
    QVERIFY(idsNow(session()) == before);
    QCOMPARE(document().undoStack().count(), steps);
    m_window->action(QStringLiteral("sketch.select"))->trigger();
  }

  void mouseMovesTheCamera() {
    Viewport* view = m_window->viewport();
    view->show(StandardView::Scene);
    const Camera before = view->navigator().camera();
    const QPoint c(view->width() / 2, 40 + view->height() / 2);
    const auto drag = [&](Qt::MouseButton button, Qt::KeyboardModifiers keys, QPoint way) {
      QTest::mousePress(view, button, keys, c);
      QTest::mouseMove(view, c + way / 2);
      QTest::mouseMove(view, c + way);
      QTest::mouseRelease(view, button, keys, c + way);
    };
    drag(Qt::LeftButton, {}, {50, 0});
    QVERIFY(view->navigator().camera().azimuth < before.azimuth - 10);
    QCOMPARE(view->navigator().camera().target, before.target);
    drag(Qt::LeftButton, Qt::ShiftModifier, {50, 0});
    QVERIFY(view->navigator().camera().target != before.target);
    drag(Qt::RightButton, {}, {0, 60});
    QVERIFY(view->navigator().camera().distance < before.distance);
  }

  void aClickSelectsABody() {
    Viewport* view = m_window->viewport();
    m_window->selection().selectBody("ice");
    view->frameSelection();
    m_window->selection().clear();
    QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(view->width() / 2, view->height() / 2));
    QCOMPARE(m_window->selection().body(), std::string("ice"));
    QCOMPARE(m_window->outliner()->selected().second, std::string("ice"));
  }

  void keys_data() {
    QTest::addColumn<int>("key");
    QTest::addColumn<int>("modifiers");
    QTest::addColumn<QString>("expected");
    QTest::newRow("3 looks from the top") << int(Qt::Key_3) << 0 << "elevation 90";
    QTest::newRow("1 looks from the front") << int(Qt::Key_1) << 0 << "elevation 0";
    QTest::newRow("Alt+3 looks from the top while one draws")
        << int(Qt::Key_3) << int(Qt::AltModifier) << "elevation 90";
    QTest::newRow("B draws") << int(Qt::Key_B) << 0 << "tool brush";
    QTest::newRow("E erases") << int(Qt::Key_E) << 0 << "tool erase";
    QTest::newRow("Q selects") << int(Qt::Key_Q) << 0 << "tool select";
    QTest::newRow("Ctrl+3 colours by phase") << int(Qt::Key_3) << int(Qt::ControlModifier) << "colour phase";
    QTest::newRow("Ctrl+2 colours by temperature")
        << int(Qt::Key_2) << int(Qt::ControlModifier) << "colour temperature";
    QTest::newRow("Space plays") << int(Qt::Key_Space) << 0 << "playing 1";
    QTest::newRow("Ctrl+K searches") << int(Qt::Key_K) << int(Qt::ControlModifier) << "palette 1";
  }
  void keys() {
    QFETCH(int, key);
    QFETCH(int, modifiers);
    QFETCH(QString, expected);
    Viewport* view = m_window->viewport();
    QApplication::setActiveWindow(m_window.get());
    view->setFocus();
    // Each row begins where its key has something to change.
    view->show(StandardView::Scene);
    const bool views = (key == Qt::Key_1 || key == Qt::Key_3) && modifiers == 0;  // digits take materials in Sketch
    m_window->tools().activate(views ? "select" : key == Qt::Key_B ? "erase" : "brush");
    document().setColour("speed");
    QTest::keyClick(view, static_cast<Qt::Key>(key), Qt::KeyboardModifiers(modifiers));
    const QStringList state{QStringLiteral("elevation %1").arg(view->navigator().camera().elevation),
                            QStringLiteral("tool %1").arg(QString::fromStdString(m_window->tools().active())),
                            QStringLiteral("colour %1").arg(QString::fromStdString(document().project().view.colour)),
                            QStringLiteral("playing %1").arg(session().playing() ? 1 : 0),
                            QStringLiteral("palette %1").arg(m_window->palette()->isVisible() ? 1 : 0)};
    QVERIFY2(state.contains(expected), qPrintable(state.join(QStringLiteral(", "))));
    m_window->palette()->hide();
    m_window->tools().activate("select");
  }

  void stepAndResetMoveTheClock() {
    session().reset();
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, uint64_t{0}, kLong);
    m_window->action(QStringLiteral("simulation.step"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, uint64_t{1}, kLong);
    QVERIFY(!session().playing());
    QTRY_COMPARE(m_window->transport()->timeText(), QStringLiteral("00:00.01"));
    m_window->action(QStringLiteral("simulation.reset"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, uint64_t{0}, kLong);
  }

  void theEndSaysWhatFollows() {
    Session::Options options;
    options.autosave = false;
    Session idle(options);
    Transport transport(idle);
    transport.setDuration(60);
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->stats.time = 60;
    transport.setSnapshot(snapshot);
    QVERIFY(transport.durationText().contains(QStringLiteral("end")));
    transport.setPlaying(true);
    QCOMPARE(transport.durationText(), QStringLiteral("/ 01:00"));
    transport.setPlaying(false);
    transport.setSnapshot(std::make_shared<Snapshot>());  // nothing was run
    QCOMPARE(transport.durationText(), QStringLiteral("/ 01:00  Press Space to run"));
  }

  /// A pinned row of another material than the panel's has its name.
  void pinnedRowsNameTheirMaterial() {
    document().addMaterial("wax");
    const std::string address = "material/wax/viscosity";
    document().setPinned(address, true);
    const auto label = [&](const char* shown) {
      m_window->inspector().setMaterial(shown);
      const auto rows = m_window->inspector().materialPanel()->rows();
      const auto pin = std::find_if(rows.begin(), rows.end(), [&](const ParameterRow* row) {
        return row->model().pinned && row->key() == QString::fromStdString(address);
      });
      return pin == rows.end() ? QString() : QString::fromUtf8((*pin)->model().declaration.label);
    };
    QCOMPARE(label("wax"), QStringLiteral("Viscosity, liquid"));
    QCOMPARE(label("water"), QStringLiteral("Viscosity, liquid · Paraffin wax"));
    document().undoStack().undo();
    document().undoStack().undo();
  }

  /// What the menu of a row may not do is refused by Ctrl+K too, and said.
  void rowCommandsSayWhyNot() {
    m_window->showWorkspace(MainWindow::kSceneTab);
    m_window->activateWindow();
    const int steps = document().undoStack().index();
    Inspector& inspector = m_window->inspector();
    const auto tried = [&](const Address& address, const char* command) {
      const QString key = QString::fromStdString(address.text());
      if (!m_window->revealParameter(address)) return QStringLiteral("no such row");
      ParameterPanel* panel = address.owner == Owner::Material ? inspector.materialPanel() : inspector.scenePanel();
      for (const int x : {20, 24}) QTest::mouseMove(panel->row(key), QPoint(x, 12));
      if (!QTest::qWaitFor([&] { return inspector.rowAtHand() && inspector.rowAtHand()->key() == key; }))
        return QStringLiteral("not at hand");
      m_window->action(QStringLiteral("edit.row.") + QLatin1String(command))->trigger();
      const QString said = m_window->notice()->isVisible() ? m_window->notice()->text() : QString();
      return said.startsWith(QStringLiteral("Nothing was done.")) ? said : QString();
    };
    QGuiApplication::clipboard()->setText(QStringLiteral("1"));
    const Address curve{Owner::Material, "water", "viscosity"}, choice{Owner::Wall, "floor", "shape"};
    for (const auto& [address, command, why] : {std::tuple(kFloor, "constant", "It is no curve"),
                                                {kFloor, "keys", "It has no keys"},
                                                {choice, "paste", "Only numbers are pasted"},
                                                {choice, "plot", "Only numbers and switches are plotted"},
                                                {curve, "plot", "Tune shows its curve"}}) {
      const QString said = tried(address, command);
      QVERIFY2(said.contains(QLatin1String(why)), qPrintable(QLatin1String(command) + QStringLiteral(": ") + said));
    }
    QCOMPARE(document().undoStack().index(), steps);
    QCOMPARE(tried(kFloor, "explain"), QString());
    QTRY_VERIFY(QToolTip::isVisible());
    QToolTip::hideText();
    QCOMPARE(tried(kFloor, "plot"), QString());
    QCOMPARE(document().undoStack().index(), steps + 1);
    document().undoStack().undo();
  }

  /// What a menu adds has the name that its row of the panel says, and brushes stand in the order of their names.
  void everythingHasOneName() {
    const api::ParameterDeclaration* kinds = findDeclaration(solidParameters(), "kind");
    int solids = 0;
    for (const QString& kind : QString::fromUtf8(kinds->choices).split(QLatin1Char('|'))) {
      const QAction* action = m_window->action(QStringLiteral("add.") + kind);
      if (!action || kind == QLatin1String("mesh")) continue;
      QCOMPARE(cleanText(*action), QStringLiteral("Add body: ") + kind);
      ++solids;
    }
    QCOMPARE(solids, 10);
    QStringList brushes;
    for (QMenu* menu : m_window->findChildren<QMenu*>()) {
      if (menu->title() != QStringLiteral("Brush shape")) continue;
      for (const QAction* action : menu->actions()) brushes << cleanText(*action);
    }
    QVERIFY(brushes.size() > 10);
    QStringList sorted = brushes;
    std::sort(sorted.begin(), sorted.end(),
              [](const QString& a, const QString& b) { return a.compare(b, Qt::CaseInsensitive) < 0; });
    QCOMPARE(brushes, sorted);
  }

  /// Beside the bodies: what a scene is made of comes from one menu.
  void wallsAreUnderAdd() {
    for (QMenu* menu : m_window->findChildren<QMenu*>()) {
      if (menu->title() == QStringLiteral("Add")) {
        QStringList names;
        for (const QAction* action : menu->actions()) names << action->text();
        QVERIFY2(names.contains(QStringLiteral("Wall")), qPrintable(names.join(QLatin1Char(','))));
      } else if (menu->title() == QStringLiteral("Sketch")) {
        for (const QAction* action : menu->actions()) QVERIFY(!action->text().contains(QStringLiteral("wall")));
      }
    }
    const auto entries = m_window->paletteEntries();
    const auto found = paletteMatches(entries, QStringLiteral("add wall"));
    QVERIFY(!found.empty() && entries[found.front()].title.startsWith(QStringLiteral("Add wall")));
  }

  /// Bodies, walls, taps, drains, probes: all from one menu, which opens from the outliner's header as well.
  void theOutlinersHeaderAdds() {
    const Dock* dock = m_window->layoutOfDocks().dock(QStringLiteral("dock.outliner"));
    QToolButton* add = nullptr;
    for (QToolButton* button : dock->titleBarWidget()->findChildren<QToolButton*>()) {
      if (button->accessibleName() == QStringLiteral("Add to the scene")) add = button;
    }
    QVERIFY(add && add->isVisible());
    QTest::mouseClick(add, Qt::LeftButton);
    QTRY_VERIFY(QApplication::activePopupWidget());
    const auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    QVERIFY(menu);
    QCOMPARE(menu->title(), QStringLiteral("Add"));
    QStringList names;
    for (const QAction* action : menu->actions()) names << action->text();
    QApplication::activePopupWidget()->close();
    QCOMPARE(names.front(), QStringLiteral("Ellipsoid"));  // what Ctrl+K calls "Add body: ellipsoid"
    QList<QMenu*> menus = menu->findChildren<QMenu*>();
    menus << const_cast<QMenu*>(menu);
    for (const QMenu* each : std::as_const(menus))
      for (const QAction* action : each->actions())
        QVERIFY2(!action->text().contains(QLatin1Char(':')), qPrintable(action->text()));
    for (const char* name : {"Wall", "Tool", "Place a tap", "Place a drain", "Add probe"})
      QVERIFY2(names.contains(QString::fromLatin1(name)), qPrintable(names.join(QStringLiteral(", "))));
  }

  /// A notice lies over the view: the picture of the scene stays where it is.
  void aNoticeMovesNothing() {
    QWidget* view = m_window->viewport();
    if (!view) QSKIP("no OpenGL");
    NoticeBar* notice = m_window->notice();
    const QRect before(view->mapTo(m_window.get(), QPoint(0, 0)), view->size());
    // What stands over the picture begins below whichever notice there is.
    const auto below = [&] {
      const auto& axes = m_window->viewport()->overlayHits().axes;
      const int covered = notice->isVisible() ? notice->height() : 0;
      return axes.empty() ? -1 : axes.front().rect.top() - covered;
    };
    QTRY_VERIFY_WITH_TIMEOUT(below() > 0, kLong);
    const double place = below();
    notice->show(QStringLiteral("test"), MessageLevel::Info, QStringLiteral("Something was said."),
                 QStringLiteral("And what to do."), {{QStringLiteral("Do it"), [] {}}});
    QCoreApplication::processEvents();
    QVERIFY(notice->isVisible());
    QCOMPARE(QRect(view->mapTo(m_window.get(), QPoint(0, 0)), view->size()), before);
    QCOMPARE(notice->mapTo(m_window.get(), QPoint(0, 0)), before.topLeft());
    QCOMPARE(notice->width(), before.width());
    QVERIFY(notice->height() >= notice->sizeHint().height() / 2 && notice->height() < before.height() / 2);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(below() - place) < 1, kLong);
    notice->close(QStringLiteral("test"));
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(below() - place) < 1, kLong);
  }

  /// As a screen reader meets each row of all panels: name, value and state, of one thing and of two that differ.
  void everyRowIsAccessible() {
    unsigned met = 0;
    const auto look = [&] {
      for (ParameterRow* row : m_window->findChildren<ParameterRow*>()) {
        const QAccessibleInterface* face = QAccessible::queryAccessibleInterface(row);
        QVERIFY2(face, qPrintable(row->key()));
        QVERIFY2(!face->text(QAccessible::Name).isEmpty(), qPrintable(row->key()));
        QVERIFY2(!row->valueText().isEmpty(), qPrintable(row->key()));
        QCOMPARE(face->text(QAccessible::Value), row->valueText());
        QCOMPARE(bool(face->state().disabled), row->has(RowState::Disabled));
        met |= row->states();
      }
    };
    m_window->selection().selectBody("ice");
    look();
    if (QTest::currentTestFailed()) return;
    m_window->action(QStringLiteral("edit.duplicate"))->trigger();
    const std::string copy = document().project().bodies.back().id;
    QCOMPARE(document().setParameter({Owner::Body, copy, "temperature"}, 250.0), QString());
    m_window->selection().selectAll({{OutlineKind::Body, "ice"}, {OutlineKind::Body, copy}});
    m_window->inspectorDock()->showPage(QStringLiteral("Body"));
    QTest::qWait(50);
    look();
    document().undoStack().undo();
    document().undoStack().undo();
    m_window->selection().clear();
    for (const RowState state : {RowState::Mixed, RowState::Curve, RowState::Disabled, RowState::Changed})
      QVERIFY2(met & static_cast<unsigned>(state), std::to_string(static_cast<unsigned>(state)).c_str());
  }

  /// Of the panels, the outliner, the library and the plugins, wherever they stand.
  void everySearchSaysThatNothingIsFound() {
    QSet<QString> said;
    for (QLineEdit* field : m_window->findChildren<QLineEdit*>(QStringLiteral("psFilter"))) {
      QWidget* page = field->parentWidget();
      while (!QByteArray(page->metaObject()->className()).startsWith("ps::")) page = page->parentWidget();
      if (!field->isVisibleTo(page)) continue;  // a panel without rows
      const QByteArray where =
          (page->metaObject()->className() + QStringLiteral(": ") + field->accessibleName()).toUtf8();
      field->setText(QStringLiteral(" x<y "));
      const auto labels = page->findChildren<QLabel*>();
      const auto nothing = std::find_if(labels.begin(), labels.end(), [&](const QLabel* label) {
        return label->isVisibleTo(page) && label->text().startsWith(QStringLiteral("Nothing called “x&lt;y”."));
      });
      QVERIFY2(nothing != labels.end(), where.constData());
      Q_EMIT(*nothing)->linkActivated(QStringLiteral("clear"));
      QVERIFY2(field->text().isEmpty() && !(*nothing)->isVisibleTo(page), where.constData());
      said.insert(QString::fromLatin1(page->metaObject()->className()));
    }
    for (const char* page : {"ps::Outliner", "ps::LibraryPage", "ps::PluginPage"})
      QVERIFY2(said.contains(QString::fromLatin1(page)), page);
    QVERIFY(said.size() > 3);  // panels of rows
  }

  /// Where there is nothing to see it is said what to do. Outliner, panels, run and searches have tests of their own.
  void emptyPlacesHaveTheirSentences() {
    Session idle({.autosave = false, .pluginPaths = {}, .autosaveDirectory = {}});
    MessageLog& log = idle.log();
    MessagesPage page(idle);
    page.show();
    const auto says = [](const QWidget& widget, const QString& text) {
      const auto labels = widget.findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(),
                         [&](const QLabel* label) { return label->isVisibleTo(&widget) && label->text() == text; });
    };
    QVERIFY(says(page, QStringLiteral("All quiet")));
    log.add(MessageLevel::Info, QStringLiteral("Test"), QStringLiteral("Something to read"));
    QVERIFY(!says(page, QStringLiteral("All quiet")));
    const std::string graph = document().addGraph({}, 0, QStringLiteral("a graph of nothing"));
    const Plot* plot = m_window->graphs()->plot(graph);
    QVERIFY(plot);
    QCOMPARE(plot->summary(), QStringLiteral("Drag a probe here to plot it"));
    document().undoStack().undo();
  }

  /// What the solver reaches, and what the note's link asks for, change with the substeps.
  void aNoteOfALimitFollowsTheSubsteps() {
    const Address substeps{Owner::Solver, "", "substeps"};
    const double before = std::get<double>(document().value(substeps));
    m_window->inspector().setMaterial("water");
    Snapshot snapshot;
    const auto noteWith = [&](double delivered) {
      snapshot.limits = {{"water.youngs_modulus", 9.3e9, delivered, "Pa"}};
      m_window->inspector().setSnapshot(snapshot);
      ParameterRow* row = m_window->inspector().materialPanel()->row(QStringLiteral("material/water/youngs_modulus"));
      const auto* note = row ? row->findChild<QLabel*>(QStringLiteral("psLimit")) : nullptr;
      return note ? note->text() : QString();
    };
    document().setParameter(substeps, 4.0);
    const QString coarse = noteWith(5e6);
    QVERIFY2(coarse.contains(QStringLiteral("5.00 MPa")) && coarse.contains(QStringLiteral("substeps=8")),
             qPrintable(coarse));
    document().setParameter(substeps, 8.0);
    const QString fine = noteWith(2e7);
    QVERIFY2(fine.contains(QStringLiteral("20.0 MPa")) && fine.contains(QStringLiteral("substeps=16")),
             qPrintable(fine));
    m_window->inspector().rebuild();  // rows made anew say it again
    QCOMPARE(noteWith(2e7), fine);
    snapshot.limits.clear();
    m_window->inspector().setSnapshot(snapshot);
    document().setParameter(substeps, before);
  }

  /// Heat takes steps of its own: finer ones of motion would cost much and mend nothing.
  void aNoteOfHeatOffersNoSubsteps() {
    Snapshot snapshot;
    snapshot.limits = {{"solver.thermal_time_scale", 500, 120, ""}};
    m_window->inspector().setSnapshot(snapshot);
    QVERIFY(m_window->revealParameter({Owner::Solver, "", "thermal_time_scale"}));
    const auto rows = m_window->findChildren<ParameterRow*>();
    const auto row = std::find_if(rows.begin(), rows.end(), [](const ParameterRow* one) {
      return one->key() == QStringLiteral("solver/thermal_time_scale");
    });
    QVERIFY(row != rows.end());
    const auto* note = (*row)->findChild<QLabel*>(QStringLiteral("psLimit"));
    QVERIFY(note);
    QVERIFY2(note->text().contains(QStringLiteral("120")) && !note->text().contains(QStringLiteral("substeps")),
             qPrintable(note->text()));
    snapshot.limits.clear();
    m_window->inspector().setSnapshot(snapshot);
  }

  /// Where no substeps help, the note says why, and its link does what does: a number, or one of several choices.
  void aNoteOfALimitSaysWhatToUse() {
    m_window->inspector().setMaterial("water");
    ParameterPanel* panel = m_window->inspector().materialPanel();
    Snapshot snapshot;
    const auto noteWith = [&](const char* use) {
      Limit limit{"water.density_solid", 917, 789, "kg/m³"};
      limit.why = "it should sink";
      limit.use = use;
      snapshot.limits = {limit};
      m_window->inspector().setSnapshot(snapshot);
      ParameterRow* row = panel->row(QStringLiteral("material/water/density_solid"));
      const auto* note = row ? row->findChild<QLabel*>(QStringLiteral("psLimit")) : nullptr;
      return note ? note->text() : QString();
    };
    const QString spacing = noteWith("solver/particle_spacing=0.01");
    QVERIFY2(spacing.contains(QStringLiteral("it should sink")) && spacing.contains(QStringLiteral("Use 10.0 mm")) &&
                 spacing.contains(QStringLiteral("solver/particle_spacing=0.01")),
             qPrintable(spacing));
    QVERIFY2(!noteWith("").contains(QStringLiteral("substeps")), qPrintable(noteWith("")));
    const QString model = noteWith("solver/viscosity_model=implicit");
    QVERIFY2(model.contains(QStringLiteral("Use implicit")), qPrintable(model));
    const Address viscosity{Owner::Solver, "", "viscosity_model"};
    const Value before = document().value(viscosity);
    Q_EMIT panel->linkActivated(QString(), QStringLiteral("solver/viscosity_model=implicit"));
    QCOMPARE(std::get<std::string>(document().value(viscosity)), std::string("implicit"));
    document().setParameter(viscosity, before);
    snapshot.limits.clear();
    m_window->inspector().setSnapshot(snapshot);
  }

  /// Of a plugin's own parameter, under the row of the body that it is of.
  void aLimitOfAPluginStandsAtItsBody() {
    const Body& body = document().project().bodies.front();
    QVERIFY(!body.constraints.empty());
    const std::string plugin = body.constraints.front().plugin;
    QCOMPARE(plugin, std::string("bonds"));
    m_window->inspector().setBody(body.id);
    Snapshot snapshot;
    snapshot.bodyIds = std::make_shared<const std::vector<std::string>>(std::vector<std::string>{"other", body.id});
    const auto noteOf = [&](int index) {
      snapshot.limits = {{"bonds.spring_stiffness", 5e5, 2e4, "N/m", index}};
      m_window->inspector().setSnapshot(snapshot);
      const QString key = QStringLiteral("constraint/%1/bonds/spring_stiffness").arg(QString::fromStdString(body.id));
      ParameterRow* row = m_window->inspector().bodyPanel()->row(key);
      const auto* note = row ? row->findChild<QLabel*>(QStringLiteral("psLimit")) : nullptr;
      return note ? note->text() : QString();
    };
    const QString own = noteOf(1);
    QVERIFY2(own.contains(QStringLiteral("the solver reaches")) && !own.contains(QStringLiteral("bonds.")),
             qPrintable(own));
    QCOMPARE(noteOf(0), QString());
    QCOMPARE(noteOf(1), own);
    m_window->inspector().setBody(body.id);  // rows made anew while nothing runs
    QCOMPARE(m_window->inspector()
                 .bodyPanel()
                 ->row(QStringLiteral("constraint/%1/bonds/spring_stiffness").arg(QString::fromStdString(body.id)))
                 ->findChild<QLabel*>(QStringLiteral("psLimit"))
                 ->text(),
             own);
    snapshot.limits.clear();
    m_window->inspector().setSnapshot(snapshot);
  }

  /// A curve is read at the temperature of its own material, not of what else is in the scene.
  void curvesAreReadAtTheirMatter() {
    m_window->inspector().setMaterial("water");
    ParameterPanel* panel = m_window->inspector().materialPanel();
    const ParameterRow* row = panel->row(QStringLiteral("material/water/viscosity"));
    QVERIFY(row);
    Snapshot snapshot;
    snapshot.stats.temperatureMean = 900;
    m_window->inspector().setSnapshot(snapshot);
    QCOMPARE(row->model().temperature, 900.0);  // it has no matter
    snapshot.materialIds = {"lost", "water"};   // the document has lost one; the engine keeps its place until a reset
    snapshot.material = {1, 1, 0};
    snapshot.temperature = {280, 300, 1400};
    m_window->inspector().setSnapshot(snapshot);
    QCOMPARE(row->model().temperature, 290.0);
    m_window->inspector().rebuild();  // rows made anew begin there
    QCOMPARE(panel->row(QStringLiteral("material/water/viscosity"))->model().temperature, 290.0);
  }

  /// Matter drawn and erased while the clock stands shows in the graphs at once.
  void graphsFollowEditsWhileItStands() {
    const uint64_t revision = session().snapshot()->revision;
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision, kLong);
    QTest::qWait(100);  // the graphs are cleared when the window hears of it
    const PhaseStackView* graph = m_window->graphs()->phases();
    QTRY_COMPARE_WITH_TIMEOUT(graph->sampleCount(), size_t{1}, kLong);
    const QString before = graph->summary();
    constexpr MatterKey kKey = 1000000;  // far from those of the document's
    session().engine()->apply(TakeBody{document().project().bodies.front().id, kKey});
    QTRY_VERIFY_WITH_TIMEOUT(graph->summary() != before, kLong);
    QCOMPARE(graph->sampleCount(), size_t{1});
    session().engine()->apply(PutBack{kKey, {}});
    QTRY_COMPARE_WITH_TIMEOUT(graph->summary(), before, kLong);
  }

  void thePluginPageShowsABrokenOne() {
    m_window->action(QStringLiteral("help.plugins"))->trigger();
    QVERIFY(m_window->showsPlugins());
    const QString all = m_window->pluginPage()->lines().join(QLatin1Char('\n'));
    QVERIFY2(all.contains(QStringLiteral("Not loaded")) && all.contains(QStringLiteral("broken.so")), qPrintable(all));
    QVERIFY(all.contains(QStringLiteral("Loaded")));
    QTest::keyClick(m_window->pluginPage(), Qt::Key_Escape);
    QVERIFY(!m_window->showsPlugins());
  }

  void picturesAreNotBlank_data() {
    QTest::addColumn<bool>("dark");
    QTest::newRow("dark") << true;
    QTest::newRow("light") << false;
  }
  void picturesAreNotBlank() {
    QFETCH(bool, dark);
    m_window->action(dark ? QStringLiteral("view.dark") : QStringLiteral("view.light"))->trigger();
    QCOMPARE(Theme::current().dark(), dark);
    QTest::qWait(300);
    const QImage image = windowImage(*m_window);
    QCOMPARE(image.size(), m_window->size() * m_window->devicePixelRatioF());
    const Viewport* view = m_window->viewport();
    const QRect scene(view->mapTo(m_window.get(), QPoint(0, 0)), view->size());
    // A shaded block has hundreds of colours, an empty ground a handful.
    QVERIFY2(colourCount(image, scene.adjusted(scene.width() / 3, scene.height() / 3, -scene.width() / 3,
                                               -scene.height() / 3)) > 100,
             "scene");
    QVERIFY2(colourCount(image, QRect(image.width() - 300, 100, 280, 400)) > 10, "inspector");
    const QColor corner = image.pixelColor(image.width() - 2, image.height() / 2);
    QCOMPARE(corner.lightness() < 128, dark);
  }

  void aRefusalStaysUntilAnEditWorks() {
    session().reset();
    session().play();
    // Past the document, which would not take it: hundreds of millions of particles.
    session().engine()->setParameter({Owner::Solver, "", "particle_spacing"}, 0.0005);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("a scene may have")), kLong);
    const QString said = m_window->notice()->text();
    QTest::qWait(300);  // several looks at newer frames
    QVERIFY(session().playing() && m_window->notice()->isVisible());
    QCOMPARE(m_window->notice()->text(), said);
    const auto& log = session().log().messages();
    QCOMPARE(std::count_if(log.begin(), log.end(), [&](const Message& m) { return m.text == said && m.count == 1; }),
             1);
    document().setParameter(kFloor, 351.0);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->topic() != QStringLiteral("step"), kLong);
    document().undoStack().undo();
  }

  void hidingABodyEmptiesTheView() {
    document().setBodiesVisible({"ice"}, false);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->viewport()->snapshot()->id.empty(), kLong);
    m_window->selection().selectBody("ice");
    QTest::mouseClick(m_window->viewport(), Qt::LeftButton, {},
                      QPoint(m_window->viewport()->width() / 2, m_window->viewport()->height() / 2));
    QVERIFY(m_window->selection().empty());
    document().undoStack().undo();
  }

  // Last: a plugin that has failed stays out of service.
  void aPluginThatFailsIsShown() {
    session().play();
    session().engine()->ask([plugins = session().plugins()](const Engine&) {
      plugins->fault("cube", "no cells");
      throw PluginError("'cube': no cells");
    });
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("no cells")), kLong);
    QVERIFY(m_window->notice()->isVisible());
    QTRY_VERIFY_WITH_TIMEOUT(!session().playing(), kLong);
    const QStringList lines = m_window->pluginPage()->lines().filter(QStringLiteral("no cells"));
    QCOMPARE(lines.size(), 1);
    QVERIFY2(lines.front().contains(QStringLiteral("Not loaded")), qPrintable(lines.front()));
  }

 private:
  Session& session() { return m_window->session(); }
  Document& document() { return session().document(); }
  /// The engine stands between two frames meanwhile, as long as a move takes: one that waited for it would not come
  /// back in time. What it says is there before the next frame. Returns what is wrong.
  QString slideWhileHeld(ParameterRow& row, const Address& address) {
    const QPoint from = row.sliderRect().center();
    QTest::mousePress(&row, Qt::LeftButton, {}, from);
    for (int k = 1; k <= 3; ++k) {
      const auto moved = std::make_shared<std::promise<void>>();
      const auto held = std::make_shared<std::promise<uint64_t>>(), then = std::make_shared<std::promise<uint64_t>>();
      const auto waited = std::make_shared<std::promise<bool>>();
      const auto value = std::make_shared<Value>();
      session().engine()->ask([=, done = moved->get_future().share()](const Engine& engine) {
        held->set_value(engine.solver().frame());
        waited->set_value(done.wait_for(std::chrono::milliseconds(kLong)) == std::future_status::ready);
      });
      const uint64_t frame = held->get_future().get();
      const Value before = document().value(address);
      QTest::mouseMove(&row, from + QPoint(4 * k, 0));
      session().engine()->ask([=, plugins = session().plugins()](const Engine& engine) {
        *value = valueAt(engine.project(), plugins, address);
        then->set_value(engine.solver().frame());
      });
      moved->set_value();
      if (!waited->get_future().get()) return QStringLiteral("the move waited for the engine");
      if (then->get_future().get() > frame + 1) return QStringLiteral("it came later than to the next frame");
      if (document().value(address) == before) return QStringLiteral("the move changed nothing");
      if (document().value(address) != *value) return QStringLiteral("the engine has another value");
    }
    QTest::mouseRelease(&row, Qt::LeftButton, {}, from + QPoint(12, 0));
    return {};
  }
  void openSample() {
    QSignalSpy opened(&session().files(), &DocumentFiles::opened);
    m_window->openFile(kSample);
    QVERIFY(opened.wait(kLong));
    session().pause();
  }

  QTemporaryDir m_plugins;
  std::unique_ptr<MainWindow> m_window;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  TestWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_window.moc"
