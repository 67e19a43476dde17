// SPDX-License-Identifier: Apache-2.0
// Bodies and materials come and go by hands in the real window; rows that follow.
#include "core/plugin_host/registry.h"
#include "tests/ui/paintedtexts.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/graphs/energypanel.h"
#include "ui/panels/bodykind.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/panels/outlinerdelegate.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/selection.h"
#include "ui/session/wording.h"
#include "ui/theme/icon.h"
#include "ui/theme/paint.h"
#include "ui/theme/theme.h"
#include "ui/timeline/transport.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/overlays.h"
#include "ui/viewport/viewport.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"
#include "ui/window/windowlayout.h"

#include <QtCore/QMimeData>
#include <QtCore/QRegularExpression>
#include <QtGui/QAction>
#include <QtGui/QClipboard>
#include <QtGui/QContextMenuEvent>
#include <QtGui/QGuiApplication>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QScrollArea>
#include <QtWidgets/QScrollBar>
#include <QtWidgets/QTreeView>

#include <map>
#include <set>
#include <vector>

using namespace ps;

class TestContentWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanupTestCase() { m_window.reset(); }

  void anInstalledMaterialIsAddedAndDrawn() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    m_window->layoutOfDocks().showPage(QStringLiteral("Materials"));
    const QRect tile = panel->tileOf("wax");
    QVERIFY(!tile.isEmpty() && panel->rect().contains(tile));
    QTest::mouseClick(panel, Qt::LeftButton, {}, tile.center());
    QCOMPARE(document().project().materials.size(), size_t{2});
    QCOMPARE(document().project().materials[1].base, std::string("wax"));
    QCOMPARE(panel->currentLabel(), QStringLiteral("Paraffin wax"));
    QCOMPARE(m_window->tools().brush().material, std::string("wax"));
    QCOMPARE(m_window->inspector().material(), std::string("wax"));
    QVERIFY(m_window->inspector().materialPanel()->row(QStringLiteral("material/wax/viscosity")));
    m_window->action(QStringLiteral("sketch.brush"))->trigger();
    const size_t before = idsNow(session()).size();
    stroke(QPoint(view()->width() / 2 - 60, view()->height() / 2), {72, 0}, true);
    QVERIFY(idsNow(session()).size() > before);
    QCOMPARE(document().project().bodies.back().material, std::string("wax"));
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), size_t{1});
    QCOMPARE(panel->currentLabel(), QStringLiteral("Water"));
    QCOMPARE(m_window->tools().brush().material, std::string("water"));
    QCOMPARE(m_window->inspector().material(), std::string("water"));
  }

  void thePaletteAddsAMaterial() {
    document().undoStack().clear();  // what can be done again has the word too
    m_window->action(QStringLiteral("edit.search"))->trigger();
    CommandPalette* palette = m_window->palette();
    palette->field()->setText(QStringLiteral("wax"));
    QCOMPARE(palette->currentTitle(), QStringLiteral("Add material Paraffin wax"));
    QTest::keyClick(palette->field(), Qt::Key_Return);
    QCOMPARE(document().project().materials.back().base, std::string("wax"));
  }

  /// One that joins the scene by being dropped on a body, say, may stand far below what the panel shows.
  void aMaterialThatJoinsIsInSight() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    m_window->layoutOfDocks().showPage(QStringLiteral("Materials"));
    QScrollArea* scroll = nullptr;
    for (QWidget* at = panel; at && !scroll; at = at->parentWidget()) scroll = qobject_cast<QScrollArea*>(at);
    QVERIFY(scroll);
    const auto inSight = [&](const std::string& id) {
      const QRect tile = panel->tileOf(id);
      return !tile.isEmpty() && scroll->viewport()->rect().contains(panel->mapTo(scroll->viewport(), tile.center()));
    };
    std::vector<std::string> bases = document().plugins()->ids(PluginKind::Material);
    std::erase(bases, std::string("water"));
    QVERIFY(bases.size() > 8);
    const std::string last = bases.back();
    bases.pop_back();
    for (const std::string& base : bases) document().addMaterial(base);
    QTRY_VERIFY(scroll->verticalScrollBar()->maximum() > 0);
    m_window->selection().setMaterial("water");
    QTRY_VERIFY(inSight("water"));
    QMimeData dragged;
    dragged.setData(QLatin1String(kInstalledMime), QByteArray::fromStdString(last));
    QVERIFY(giveMaterial(document(), {"ice"}, dragged));
    QTRY_VERIFY(inSight(document().body("ice")->material));
    QVERIFY(!inSight("water"));
    m_window->selection().setMaterial(bases.front());  // by a body that is selected, or a row that is looked for
    m_window->selection().setMaterial("water");
    QTRY_VERIFY(inSight("water"));
  }

  void anUnusedMaterialIsRemovedByItsMenu() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    panel->addInstalled("wax");
    const auto menuAt = [&](const std::string& id) {
      const QPoint at = panel->tileOf(id).center();
      QContextMenuEvent ask(QContextMenuEvent::Mouse, at, panel->mapToGlobal(at));
      QApplication::sendEvent(panel, &ask);
      return panel->findChild<QMenu*>();
    };
    QMenu* menu = menuAt("water");
    QVERIFY(menu && !menu->actions().front()->isEnabled());
    QVERIFY2(menu->actions().front()->text().contains(QStringLiteral("“Ice block” is of it")),
             qPrintable(menu->actions().front()->text()));
    delete menu;
    menu = menuAt("wax");
    QVERIFY(menu && menu->actions().front()->isEnabled());
    menu->actions().front()->trigger();
    delete menu;
    QCOMPARE(document().project().materials.size(), size_t{1});
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), size_t{2});
  }

  /// So that one that is dragged elsewhere is not picked on the way.
  void aMaterialIsPickedWhereTheButtonGoesUp() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    panel->addInstalled("wax");
    m_window->selection().setMaterial("water");
    const QPoint wax = panel->tileOf("wax").center(), water = panel->tileOf("water").center();
    QTest::mousePress(panel, Qt::LeftButton, {}, wax);
    QCOMPARE(m_window->selection().material(), std::string("water"));
    QTest::mouseRelease(panel, Qt::LeftButton, {}, water);
    QCOMPARE(m_window->selection().material(), std::string("water"));
    QTest::mouseClick(panel, Qt::LeftButton, {}, wax);
    QCOMPARE(m_window->selection().material(), std::string("wax"));
  }

  /// Enter adds what the arrows have walked to; walking alone adds nothing.
  void materialsAreAddedWithoutAMouse() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    view()->setFocus();
    panel->setFocus(Qt::TabFocusReason);
    QTest::keyClick(panel, Qt::Key_Down);
    QCOMPARE(document().project().materials.size(), size_t{1});
    QTest::keyClick(panel, Qt::Key_Return);
    QCOMPARE(document().project().materials.size(), size_t{2});
  }

  /// A click among the materials says that they are meant; single keys stay the view's, in which one draws with them.
  void aClickOnAMaterialIsFollowedByItsCommands() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    panel->addInstalled("wax");
    m_window->selection().select(OutlineKind::Body, "ice");
    m_window->activateWindow();
    view()->setFocus();
    QTRY_VERIFY(view()->hasFocus());
    QTest::mouseClick(panel, Qt::LeftButton, {}, panel->tileOf("wax").center());
    QVERIFY(panel->hasFocus());
    QGuiApplication::clipboard()->clear();
    QTest::keyClick(panel, Qt::Key_X, Qt::ControlModifier);
    QVERIFY(document().body("ice"));
    QCOMPARE(document().project().materials.size(), size_t{1});
    QVERIFY(QGuiApplication::clipboard()->text().contains(QStringLiteral("wax")));
    QTest::keyClick(panel, Qt::Key_V, Qt::ControlModifier);
    QCOMPARE(document().project().materials.size(), size_t{2});
    const size_t bodies = document().project().bodies.size();
    QTest::keyClick(panel, Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(document().project().bodies.size(), bodies);
    QTest::mouseClick(panel, Qt::LeftButton, {}, panel->tileOf("wax").center());
    QTest::keyClick(panel, Qt::Key_Delete);
    QCOMPARE(document().project().materials.size(), size_t{1});
    QVERIFY(document().body("ice"));

    QTest::mouseClick(panel, Qt::LeftButton, {}, panel->tileOf("water").center());
    QTest::keyClick(panel, Qt::Key_W);
    QCOMPARE(m_window->tools().active(), std::string("move"));
    session().pause();
    QTest::keyClick(panel, Qt::Key_Space);
    QVERIFY(session().playing());
    QTest::keyClick(panel, Qt::Key_Space);
    const double before = session().now();
    QTest::keyClick(panel, Qt::Key_Right);
    QTRY_VERIFY_WITH_TIMEOUT(session().now() > before, kLong);
    QCOMPARE(m_window->selection().material(), std::string("water"));
    QTest::keyClick(panel, Qt::Key_Tab);
    QVERIFY(m_window->tools().tool().usesBrush());
    QTest::keyClick(panel, Qt::Key_Tab);
    // By keys it walks.
    view()->setFocus();
    panel->setFocus(Qt::TabFocusReason);
    QVERIFY(panel->walks());
    QTest::mouseClick(view(), Qt::LeftButton, {}, QPoint(view()->width() / 2, 60));
    QVERIFY(view()->hasFocus());
    m_window->selection().select(OutlineKind::Body, "ice");
    QTest::keyClick(view(), Qt::Key_C, Qt::ControlModifier);
    QVERIFY(QGuiApplication::clipboard()->text().contains(QStringLiteral("bodies")));
  }

  void aWallIsDeletedAndAdded() {
    const size_t walls = document().project().environment.walls.size();
    m_window->selection().select(OutlineKind::Wall, "left");
    m_window->action(QStringLiteral("edit.delete"))->trigger();
    QCOMPARE(document().project().environment.walls.size(), walls - 1);
    QVERIFY(!document().wall("left"));
    m_window->action(QStringLiteral("sketch.wall.left"))->trigger();
    QVERIFY(document().wall("left"));
    QCOMPARE(m_window->outliner()->selected(), std::pair(OutlineKind::Wall, std::string("left")));
    QVERIFY(m_window->inspector().scenePanel()->row(QStringLiteral("wall/left/heat")));
    m_window->action(QStringLiteral("sketch.wall.left"))->trigger();
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("already")), qPrintable(m_window->notice()->text()));
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(document().project().environment.walls.size(), walls);
  }

  /// A cylinder and a sphere come as one step each, selected, with their rows.
  void curvedWallsAreAdded() {
    const size_t walls = document().project().environment.walls.size();
    for (const char* shape : {"cylinder", "sphere"}) {
      m_window->action(QStringLiteral("sketch.wall.") + QString::fromLatin1(shape))->trigger();
      const SceneWall* wall = document().wall(shape);
      QVERIFY(wall);
      QCOMPARE(std::get<std::string>(wall->parameters.values.at("shape")), std::string(shape));
      QCOMPARE(m_window->outliner()->selected(), std::pair(OutlineKind::Wall, std::string(shape)));
      for (const char* row : {"shape", "matter", "radius"}) {
        const QString path = QStringLiteral("wall/%1/%2").arg(QLatin1String(shape), QLatin1String(row));
        QVERIFY2(m_window->inspector().scenePanel()->row(path), qPrintable(path));
      }
    }
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(document().project().environment.walls.size(), walls);
  }

  /// What has nothing to do with the last edit does not offer to undo it.
  void lostMatterOffersSides() {
    document().setParameter({Owner::Wall, "floor", "temperature"}, 350.0);
    document().removeWall("left");
    onEngine<int>(session(), [](Engine& engine) {
      ParticleStore& store = tests::solverOf(engine).particles();
      for (size_t i = 0; i < store.size(); ++i) store.position()[i].x -= 5;
      return 0;
    });
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("Matter left the scene")), kLong);
    QStringList buttons;
    QPushButton* sides = nullptr;
    for (QPushButton* button : m_window->notice()->findChildren<QPushButton*>()) {
      buttons << button->text();
      if (button->text() == QStringLiteral("Add sides")) sides = button;
    }
    QVERIFY2(!buttons.contains(QStringLiteral("Undo")), qPrintable(buttons.join(QLatin1Char(','))));
    QVERIFY2(sides, qPrintable(buttons.join(QLatin1Char(','))));
    sides->click();
    QVERIFY(document().wall("left"));
  }

  void deleteTakesTheSelectedBody_data() {
    QTest::addColumn<QString>("where");
    for (const char* where : {"outliner", "view", "menu"}) QTest::newRow(where) << QString::fromLatin1(where);
  }
  void deleteTakesTheSelectedBody() {
    QFETCH(QString, where);
    const size_t before = idsNow(session()).size();
    QVERIFY(before > 0);
    m_window->selection().select(OutlineKind::Body, "ice");
    QWidget* target = where == QLatin1String("view") ? static_cast<QWidget*>(view()) : m_window->outliner()->view();
    target->setFocus();
    if (where == QLatin1String("menu")) {
      auto* outliner = m_window->outliner()->view();
      const QPoint at = outliner->visualRect(outliner->currentIndex()).center();
      Q_EMIT outliner->customContextMenuRequested(at);
      QMenu* menu = nullptr;
      QTRY_VERIFY((menu = qobject_cast<QMenu*>(QApplication::activePopupWidget())));
      QStringList names;
      for (QAction* action : menu->actions()) names << action->objectName();
      menu->close();
      for (const char* name : {"edit.rename", "edit.visible", "edit.locked", "view.frame", "edit.delete"})
        QVERIFY2(names.contains(QString::fromLatin1(name)), name);
      m_window->action(QStringLiteral("edit.delete"))->trigger();
    } else {
      QTest::keyClick(target, Qt::Key_Delete);
    }
    QVERIFY(!document().body("ice"));
    QVERIFY(idsNow(session()).empty());
    QCOMPARE(m_window->selection().body(), std::string());
    document().undoStack().undo();
    QVERIFY(document().body("ice"));
    QCOMPARE(idsNow(session()).size(), before);
  }

  void deleteElsewhereTakesNothing() {
    m_window->selection().select(OutlineKind::Body, "ice");
    QWidget* panel = m_window->findChild<MaterialsPanel*>();
    panel->setFocus();
    QTest::keyClick(panel, Qt::Key_Delete);
    QVERIFY(document().body("ice"));
    // A click beside everything selects nothing, so that Delete has nothing to take.
    QTest::mouseClick(view(), Qt::LeftButton, {}, QPoint(view()->width() / 2, 60));
    QTest::keyClick(view(), Qt::Key_Delete);
    QVERIFY(document().body("ice"));
  }

  void aLockedBodyIsNotDeleted() {
    m_window->selection().select(OutlineKind::Body, "ice");
    m_window->action(QStringLiteral("edit.locked"))->trigger();
    m_window->action(QStringLiteral("edit.delete"))->trigger();
    QVERIFY(document().body("ice"));
    QVERIFY(m_window->notice()->isVisible());
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("is locked")), qPrintable(m_window->notice()->text()));
    m_window->action(QStringLiteral("edit.locked"))->trigger();
    m_window->action(QStringLiteral("edit.delete"))->trigger();
    QVERIFY(!document().body("ice") && !m_window->notice()->isVisible());
  }

  void structureIsARow() {
    m_window->inspector().setBody("ice");
    ParameterPanel* panel = m_window->inspector().bodyPanel();
    const QString key = QStringLiteral("body/ice/structure");
    QVERIFY(panel->row(key));
    QCOMPARE(panel->row(key)->valueText(), QStringLiteral("Bonds"));
    panel->row(key)->reset();  // to none
    QVERIFY(document().body("ice")->constraints.empty());
    QCOMPARE(panel->row(key)->valueText(), QStringLiteral("None"));
    QCOMPARE(document().undoStack().count(), 1);
    document().undoStack().undo();
    QCOMPARE(panel->row(key)->valueText(), QStringLiteral("Bonds"));
  }

  void wallsWithoutHeatGreyItsRows() {
    ParameterPanel* panel = m_window->inspector().scenePanel();
    const auto idle = [&](const char* key) {
      return panel->row(QStringLiteral("wall/floor/") + QLatin1String(key))->has(RowState::Disabled);
    };
    ParameterRow* pinned = m_window->inspector().materialPanel()->row(QStringLiteral("wall/floor/temperature"));
    QVERIFY(pinned && !pinned->has(RowState::Disabled) && !idle("temperature") && !idle("film_coefficient"));
    document().setParameter({Owner::Wall, "floor", "heat"}, std::string("adiabatic"));
    QVERIFY(pinned->has(RowState::Disabled) && idle("temperature") && idle("film_coefficient"));
    QVERIFY(!idle("friction") && !idle("heat"));
    QVERIFY(pinned->model().disabledReason.contains(QStringLiteral("“Heat” is fixed temperature")));
    document().undoStack().undo();
    QVERIFY(!pinned->has(RowState::Disabled) && !idle("temperature"));
    document().setParameter({Owner::Wall, "floor", "heat"}, std::string("adiabatic"));
    m_window->inspector().rebuild();  // new rows stand still too
    QVERIFY(idle("temperature") && idle("film_coefficient"));
  }

  void whatWaitsForTheResetSaysSo() {
    m_window->inspector().setBody("ice");
    ParameterRow* row = m_window->inspector().bodyPanel()->row(QStringLiteral("body/ice/temperature"));
    QVERIFY(row && row->model().rules.contains(QStringLiteral("Acts once back at the start.")));
    const auto waits = [&] { return row->has(RowState::Limited); };
    leaveTheStart();
    QVERIFY(!waits());
    document().setParameter({Owner::Body, "ice", "temperature"}, 250.0);
    QVERIFY(waits());
    document().undoStack().undo();
    QVERIFY(!waits());
    document().undoStack().redo();
    m_window->inspector().rebuild();  // new rows say it too
    row = m_window->inspector().bodyPanel()->row(QStringLiteral("body/ice/temperature"));
    QVERIFY(waits());
    Q_EMIT row->linkActivated(row->key(), QStringLiteral("reset"));
    QTRY_VERIFY(!waits());
    document().setParameter({Owner::Body, "ice", "heating_power"}, 10.0);
    QVERIFY(!m_window->inspector().bodyPanel()->row(QStringLiteral("body/ice/heating_power"))->has(RowState::Limited));
  }

  /// A spacing counts particles by its third power, and what that costs is said before it is paid.
  void aWaitingSpacingSaysWhatItCosts() {
    const Address kSpacing{Owner::Solver, "", "particle_spacing"};
    const double before = std::get<double>(*storedValue(document().project(), kSpacing));
    const auto note = [&] {
      const auto* row = m_window->inspector().panelFor(kSpacing)->row(QString::fromStdString(kSpacing.text()));
      const auto* label = row->findChild<QLabel*>(QStringLiteral("psLimit"));
      return label ? label->text() : QString();
    };
    leaveTheStart();
    QCOMPARE(note(), QString());
    QCOMPARE(document().setParameter(kSpacing, before / 2), QString());
    QVERIFY2(note().startsWith(QStringLiteral("Acts once back at the start: ")), qPrintable(note()));
    for (const char* part : {" particles, about ", " MB, 8.0× today’s. ", "Back to the start"})
      QVERIFY2(note().contains(QString::fromUtf8(part)), qPrintable(note()));
    document().undoStack().undo();
    QCOMPARE(note(), QString());
  }

  /// What a value should be it may also not be: its row says so, beside what else there is to say.
  void aRowSaysWhatItsValueShouldBe() {
    Emitter tap;
    tap.material = "water";
    tap.point = {0, 0.6, 0};
    const std::string id = document().addEmitter(tap).id;
    const auto note = [&] {
      const auto* row = m_window->inspector().scenePanel()->row(QString::fromStdString("emitter/" + id + "/stop"));
      const auto* label = row->findChild<QLabel*>(QStringLiteral("psLimit"));
      return label ? label->text() : QString();
    };
    QCOMPARE(note(), QString());
    QCOMPARE(document().setParameter({Owner::Emitter, id, "start"}, 5.0), QString());
    QCOMPARE(document().setParameter({Owner::Emitter, id, "stop"}, 2.0), QString());
    QCOMPARE(note(), QStringLiteral("Should be above “Opens at” (5 s), not 2 s."));
    m_window->inspector().rebuild();
    QVERIFY(!note().isEmpty());
    document().setPinned("emitter/" + id + "/stop", true);  // it stands twice now, and is told once
    QCOMPARE(note(), QStringLiteral("Should be above “Opens at” (5 s), not 2 s."));
    QCOMPARE(document().setParameter({Owner::Emitter, id, "start"}, 1.0), QString());
    QCOMPARE(note(), QString());

    // One of a value that waits as well.
    QCOMPARE(document().setParameter({Owner::Body, "ice", "fixed"}, true), QString());
    QCOMPARE(document().setParameter({Owner::Body, "ice", "motion_start"}, 4.0), QString());
    QCOMPARE(document().setParameter({Owner::Body, "ice", "motion_stop"}, 3.0), QString());
    const auto* row = m_window->inspector().bodyPanel()->row(QStringLiteral("body/ice/motion_stop"));
    const auto* label = row->findChild<QLabel*>(QStringLiteral("psLimit"));
    QVERIFY(label);
    QVERIFY2(label->text().startsWith(QStringLiteral("Should be above “Sets off at” (4 s), not 3 s.")),
             qPrintable(label->text()));
  }

  /// It is in no phase's mass, but has heat all the same.
  void heldMatterHasItsLedger() {
    QTRY_VERIFY(session().snapshot() && !session().snapshot()->id.empty());
    EnergyPanel panel(session());
    FrameStats held;
    held.thermalEnergy = 5;
    panel.append(held);
    QVERIFY2(panel.findChild<QLabel*>()->text().contains(QStringLiteral("Heat in matter")),
             qPrintable(panel.findChild<QLabel*>()->text()));
    panel.clear();  // as another scene comes, which may be empty
    QCOMPARE(panel.findChild<QLabel*>()->text(), QString());
  }

  /// However fast they came, the last frame's values are those that stay.
  void aPausedSceneShowsItsLastValues() {
    for (uint64_t frame = 1; frame <= 4; ++frame) {
      session().step();
      QTRY_COMPARE(session().snapshot()->stats.frame, frame);
    }
    const double mean = session().snapshot()->stats.temperatureMean;
    const ParameterRow* row =
        m_window->inspector().materialPanel()->row(QStringLiteral("material/water/density_solid"));
    QTRY_VERIFY2(std::abs(row->model().temperature - mean) < 1e-3,  // of floats
                 qPrintable(QString::number(row->model().temperature - mean)));
  }

  /// What was reached for another time lapse says nothing of the one that was typed.
  void aTimeLapseTypedWhilePausedIsNoLimit() {
    const auto limited = [this] {
      return onEngine<bool>(session(), [](Engine& engine) {
        const std::vector<Limit> limits = engine.snapshot()->limits;
        return std::any_of(limits.begin(), limits.end(),
                           [](const Limit& limit) { return limit.what == "solver.thermal_time_scale"; });
      });
    };
    const Address lapse{Owner::Solver, "", "thermal_time_scale"};
    QCOMPARE(document().setParameter(lapse, 1.0), QString());
    onEngine<int>(session(), [](Engine& engine) { return engine.step(), 0; });
    QVERIFY(!limited());
    QCOMPARE(document().setParameter(lapse, 500.0), QString());
    QVERIFY(!limited());
  }

  /// A 0 would say that there is none of it.
  void whatIsHeldIsNotCountedAsNothing() {
    QCOMPARE(document().setParameter({Owner::Body, "ice", "fixed"}, true), QString());
    toTheStart();
    QTRY_COMPARE(probeDetail(QStringLiteral("Ice")), QStringLiteral("—"));
    QTRY_COMPARE(probeDetail(QStringLiteral("Ice core")), QStringLiteral("−10.0 °C"));
  }

  /// Each number of it says what it is.
  void theStatusLineExplainsItself() {
    auto* line = m_window->findChild<StatusLine*>();
    QTRY_VERIFY(line->parts().size() > 4);
    QSet<QString> tips;
    for (const PaintedText& text : paintedBy(*line)) {
      const QString tip = line->tipAt(text.place.center());
      QVERIFY2(tip.endsWith(QLatin1Char('.')) || line->noteRect().contains(text.place.center()), qPrintable(text.text));
      tips << tip;
    }
    QVERIFY(tips.size() > 4);
    QVERIFY(line->tipAt({1, 1}).isEmpty());
  }

  /// A digit less moves nothing that stands beside it.
  void theStatusLineStandsStill() {
    auto* line = m_window->findChild<StatusLine*>();
    StatusLine::State state = line->state();
    const auto shown = [&](double realTime) {
      state.realTime = realTime;
      line->setState(state);
      return line->grab().toImage().convertToFormat(QImage::Format_RGB32);
    };
    const QImage wide = shown(10), narrow = shown(9.99);
    QVERIFY(wide != narrow && shown(10) == wide);
    int first = wide.width(), last = 0;
    for (int x = 0; x < wide.width(); ++x) {
      for (int y = 0; y < wide.height(); ++y) {
        if (wide.pixel(x, y) != narrow.pixel(x, y)) first = std::min(first, x), last = std::max(last, x);
      }
    }
    const double number = textWidth(QStringLiteral("10.00×"), Theme::font(TextRole::Small)) * line->devicePixelRatioF();
    QVERIFY2(last - first <= number + 2, qPrintable(QString::number(last - first)));
  }

  /// Nor does another stage that is named as the slowest: what stands to the right of its name stays.
  void anotherStageMovesNothing() {
    auto* line = m_window->findChild<StatusLine*>();
    StatusLine::State state = line->state();
    const auto shown = [&](Stage slowest) {
      auto snapshot = std::make_shared<Snapshot>(*state.snapshot);
      snapshot->revision += 1000 + static_cast<uint64_t>(slowest);  // of a run of its own: nothing is known of before
      snapshot->stats.milliseconds = {};
      snapshot->stats.milliseconds[static_cast<size_t>(slowest)] = 5000;
      state.snapshot = snapshot;
      for (int frame = 0; frame < 200; ++frame) line->setState(state);
      return line->grab().toImage().convertToFormat(QImage::Format_RGB32);
    };
    const QImage narrow = shown(Stage::Heat), wide = shown(Stage::Neighbours);
    QVERIFY(line->parts().join(QLatin1Char(' ')).contains(QStringLiteral("neighbours")));
    // Columns that differ are those of the name and of what is measured beside it.
    int last = 0;
    for (int x = 0; x < wide.width(); ++x) {
      for (int y = 0; y < wide.height(); ++y) {
        if (wide.pixel(x, y) != narrow.pixel(x, y)) last = x;
      }
    }
    const double most =
        textWidth(line->parts().mid(0, 3).join(QString(8, QLatin1Char('0'))), Theme::font(TextRole::Small)) *
        line->devicePixelRatioF();
    QVERIFY2(last < most, qPrintable(QStringLiteral("%1 of %2").arg(last).arg(most)));
  }

  void tipsOfTheFileMenuSayMoreThanTheEntry() {
    QList<QAction*> entries;
    for (const QObject* place : m_window->action(QStringLiteral("file.new"))->associatedObjects()) {
      if (const auto* menu = qobject_cast<const QMenu*>(place)) entries = menu->actions();
    }
    int tips = 0;
    for (const QAction* entry : entries) {
      if (entry->isSeparator()) continue;
      QVERIFY2(entry->toolTip().endsWith(QLatin1Char('.')), qPrintable(entry->text()));
      ++tips;
    }
    QCOMPARE(tips, 20);
  }

  void matterOfTapsAndDrainsIsInTheLedger() {
    EnergyPanel panel(session());
    FrameStats stats;
    stats.thermalEnergy = 5;
    stats.phases[2] = {10, 1};
    panel.append(stats);
    QVERIFY(!panel.ledgerText().contains(QStringLiteral("Matter ")));  // there are none
    stats.flow.poured = {30, 1.5, 0};
    stats.flow.drained = {5, 0.25, 0};
    panel.append(stats);
    const QString text = panel.findChild<QLabel*>()->text();
    QVERIFY2(text.contains(QRegularExpression(QStringLiteral("Matter from taps.*1\\.5\\d* kg"))), qPrintable(text));
    QVERIFY2(text.contains(QRegularExpression(QStringLiteral("Matter into drains.*250(\\.\\d*)? g"))),
             qPrintable(text));
  }

  void whatRunsKeepsItsDigits() {
    Limit limit;
    limit.what = "stiffness";
    limit.unit = "MPa";
    limit.asked = 60;
    const auto text = [&](double delivered) {
      limit.delivered = delivered;
      return limitText(limit, nullptr);
    };
    QVERIFY2(text(42).contains(QStringLiteral("reaches 42.0 MPa of 60 MPa")), qPrintable(text(42)));
    QCOMPARE(text(42.04).size(), text(41.96).size());
    QCOMPARE(text(42).size(), text(41.9).size());
  }

  void bodiesShowOfWhichKindTheyAre_data() {
    QTest::addColumn<QString>("structure");
    QTest::addColumn<QString>("phase");
    QTest::addColumn<double>("temperature");  // K
    QTest::addColumn<QString>("icon");
    const auto row = [](const char* name, const char* structure, const char* phase, double temperature,
                        const char* icon) {
      QTest::newRow(name) << QString::fromLatin1(structure) << QString::fromLatin1(phase) << temperature
                          << QString::fromLatin1(icon);
    };
    row("rigid", "rigid", "automatic", 260, "body");
    row("bonded", "bonds", "automatic", 260, "bonded");
    row("soft", "clusters", "automatic", 260, "soft");
    row("cloth", "cloth", "automatic", 260, "cloth");
    row("rope", "rope", "automatic", 260, "rope");
    row("held by what is not installed", "nobodys-plugin", "automatic", 260, "body");
    row("snow", "", "automatic", 260, "grains");
    row("water", "", "automatic", 300, "liquid");
    row("steam", "", "automatic", 400, "gas");
    row("slush", "", "liquid", 260, "liquid");
    row("steam by its row", "", "gas", 300, "gas");
  }
  void bodiesShowOfWhichKindTheyAre() {
    QFETCH(QString, structure);
    QFETCH(QString, phase);
    QFETCH(double, temperature);
    QFETCH(QString, icon);
    Body body = *document().body("ice");
    body.constraints.clear();
    if (!structure.isEmpty()) body.constraints.push_back({structure.toStdString(), {}, {}});
    body.parameters.values["phase"] = phase.toStdString();
    body.parameters.values["temperature"] = temperature;
    const auto kind = [&] { return kindOf(body, document().project(), session().plugins()); };
    QCOMPARE(kind().icon, icon);
    QVERIFY(iconNames().contains(icon));
    body.parameters.values["fixed"] = true;
    QCOMPARE(kind().icon, QStringLiteral("plate"));
  }

  /// At once, by whatever row it is changed; in words in its tip.
  void theOutlinerFollowsTheKindOfABody() {
    const auto icon = [this] { return rowOf(QStringLiteral("Ice block")).data(outline::kIcon).toString(); };
    const auto tip = [this] { return rowOf(QStringLiteral("Ice block")).data(Qt::ToolTipRole).toString(); };
    const QString before = icon();
    QVERIFY(before == QStringLiteral("bonded") || before == QStringLiteral("body"));
    QCOMPARE(tip().section(QLatin1Char('\n'), 0, 0), QStringLiteral("Ice block"));
    document().setParameter({Owner::Body, "ice", "fixed"}, true);
    QCOMPARE(icon(), QStringLiteral("plate"));
    QCOMPARE(tip(), QStringLiteral("Ice block\nHeld in place"));
    document().undoStack().undo();
    QCOMPARE(icon(), before);
    document().setStructure("ice", kNoStructure);
    QCOMPARE(icon(), QStringLiteral("grains"));
    document().setParameter({Owner::Body, "ice", "phase"}, std::string("automatic"));
    document().setParameter({Owner::Body, "ice", "temperature"}, 300.0);
    QCOMPARE(icon(), QStringLiteral("liquid"));
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
    QCOMPARE(icon(), before);
  }

  /// While values run, whatever has as many digits as before stands where it stood: clocks, outliner, ledger, status
  /// line, and over the scene the tag and the ends of the legend.
  void runningDigitsStandStill() {
    m_window->layoutOfDocks().showPage(QStringLiteral("Energy"));
    // In each of these digits run; a graph moves with what it shows. What the outliner says may stay the same.
    const std::vector<QWidgetList> places{{m_window->findChild<StatusLine*>()},
                                          m_window->findChild<Transport*>()->findChildren<QWidget*>(),
                                          {m_window->findChild<EnergyPanel*>()->findChild<QLabel*>()}};
    QWidget* outliner = m_window->outliner()->view()->viewport();
    session().play();
    const auto changedEnough = [&] {
      int all = 0;
      bool each = true;
      standsStill(*outliner, paintedBy(*outliner));
      for (const QWidgetList& place : places) {
        int changed = 0;
        for (QWidget* widget : place) {
          if (!widget->visibleRegion().isEmpty()) standsStill(*widget, paintedBy(*widget));
          changed += m_changedInPlace[widget];
        }
        all += changed;
        each = each && changed > 0;
      }
      return each && all > 20;
    };
    QTRY_VERIFY_WITH_TIMEOUT(changedEnough(), kLong);
    session().pause();
    OverlayState state;
    state.size = view()->size();
    state.field = session().fields().find("temperature");
    state.tag = SceneTag{{0, 0.2, 0}, QStringLiteral("Ice core"), {}};
    for (const auto& [value, ends] : {std::pair("11.1 °C", std::pair(261.1, 431.1)), {"88.8 °C", {258.8, 458.8}}}) {
      state.tag->value = QString::fromUtf8(value);
      state.range = ends;
      TextDevice device(view()->size());
      QPainter painter(&device);
      const OverlayHits hits = paintOverlays(painter, state);
      // What lies along the scale moves with what it says.
      device.texts.removeIf([&](const PaintedText& painted) {
        return painted.place.top() > hits.legendBar.top() + 10 && hits.legend.contains(painted.place.center());
      });
      standsStill(*view(), device.texts);
    }
  }

  /// A low view has a legend too, whose bar is shorter; in one without room for it there is none.
  void aLowViewHasALegend() {
    OverlayState state;
    state.field = session().fields().find("temperature");
    state.range = {260, 390};
    const auto bar = [&](int height) {
      state.size = QSizeF(480, height);
      TextDevice device(QSize(480, height));
      QPainter painter(&device);
      return paintOverlays(painter, state).legendBar;
    };
    const double whole = bar(600).height();
    QVERIFY(bar(300).height() > 60 && bar(300).height() < whole && bar(300).bottom() < 300);
    QVERIFY(bar(150).isEmpty());
  }

  /// A row may be told of another quantity than its own, whose unit is then said.
  void limitsHaveTheirOwnUnits() {
    const Address address{Owner::Solver, "", "particle_spacing"};
    const Limit limit{"solver.particle_spacing", 0.25, 0.3, "m³"};
    const QString text = limitText(limit, document().declaration(address));
    QVERIFY2(text.startsWith(QStringLiteral("Particle spacing: the solver reaches 0.300 m³ of 0.25 m³ ")),
             qPrintable(text));
  }

  /// Of a law no step comes closer: it says where, what is asked and what is used.
  void lawsThatAreHeldSayWhere() {
    Limit limit{"water.conductivity_solid", -0.4, 0, "W/(m·K)", -1, std::array{0.0, 120.0}};
    const api::ParameterDeclaration* declaration =
        document().declaration({Owner::Material, "water", "conductivity_solid"});
    QVERIFY(declaration);
    const QString text = limitText(limit, declaration);
    QVERIFY2(text.startsWith(QStringLiteral("Conductivity, solid: leaves its range below −153 °C, where matter is; ")),
             qPrintable(text));
    QVERIFY2(text.contains(QStringLiteral("−0.4")), qPrintable(text));
    QCOMPARE(limitNote(limit, declaration), QStringLiteral("Conductivity, solid leaves its range below −153 °C"));
  }

  void theBrushIsNoPartOfTheScene() {
    auto* panel = m_window->findChild<BrushPanel*>();
    QVERIFY(panel && panel->row(QStringLiteral("radius")));
    const int steps = document().undoStack().count();
    QVERIFY(panel->row(QStringLiteral("radius"))->enterNumber(0.123));
    QCOMPARE(m_window->tools().brush().radius, 0.123);
    QCOMPARE(document().undoStack().count(), steps);
  }

  /// What a brush paints of itself lies where its volume is: cross and outline at its centre, a dotted line down to
  /// what lies below, its ring there, and its measures beside it.
  void theBrushShowsItsTrueVolume_data() {
    QTest::addColumn<double>("radius");
    QTest::addColumn<bool>("erase");
    QTest::newRow("small") << 0.04 << false;
    QTest::newRow("large") << 0.09 << false;
    QTest::newRow("erases") << 0.04 << true;
  }
  void theBrushShowsItsTrueVolume() {
    QFETCH(double, radius);
    QFETCH(bool, erase);
    OverlayState state;
    state.size = QSizeF(800, 600);
    state.camera.target = {0, 0.15, 0};
    state.camera.distance = 1;
    state.camera.elevation = 25;
    state.shown = {false, false, false, false, false, false, false};
    BrushCursor cursor{{0.1, 0.3, 0}, Vector3::Constant(radius), 0, 0.62, false, erase};
    state.cursor = cursor;
    QImage image(state.size.toSize(), QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    paintOverlays(painter, state);
    painter.end();
    const auto at = [&](const Vector3& place) {
      const auto pixel = project(state.camera, image.width(), image.height(), place);
      return pixel ? QPointF((*pixel)[0], (*pixel)[1]) : QPointF();
    };
    const QColor line = Theme::current()[erase ? Token::Error : Token::Accent], cross = Theme::current()[Token::Text];
    const auto shows = [&](const QPointF& point, const QColor& colour) { return isNear(image, point, colour); };
    const QPointF centre = at(cursor.centre);
    const CameraFrame frame = frameOf(state.camera);
    const double reach =
        radius / pixelSize(state.camera, image.height(), (cursor.centre - frame.eye).dot(frame.forward));
    QVERIFY(reach > 20);
    for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
      QVERIFY(shows(centre + reach * way, line));
      QVERIFY(way.y() > 0 || !(shows(centre + (reach - 6) * way, line) || shows(centre + (reach + 6) * way, line)));
      QVERIFY(shows(centre + 4 * way, cross));
    }
    const Vector3 foot{cursor.centre[0], cursor.floor, cursor.centre[2]};
    for (const Vector3& way : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 0, 1), Vector3(0, 0, -1)})
      QVERIFY(shows(at(foot + radius * way), line));
    const int dots = dotsBelow(image, QPoint(qRound(at(foot).x()), qRound(centre.y() + reach + 6)), at(foot).y() - 2);
    QVERIFY2(dots >= 6, qPrintable(QString::number(dots)));
    TextDevice device(image.size());
    painter.begin(&device);
    paintOverlays(painter, state);
    painter.end();
    QCOMPARE(device.texts.size(), qsizetype{1});
    QCOMPARE(device.texts.front().text, QStringLiteral("r %1   height 300 mm   pressure 62 %").arg(lengthText(radius)));
  }

 private:
  /// Within a pixel: lines are 1 to 1.5 wide, and their edges smooth.
  static bool isNear(const QImage& image, const QPointF& point, const QColor& colour) {
    int nearest = 255;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const QColor pixel = image.pixelColor(point.toPoint() + QPoint(dx, dy));
        nearest =
            std::min(nearest, std::max({std::abs(pixel.red() - colour.red()), std::abs(pixel.green() - colour.green()),
                                        std::abs(pixel.blue() - colour.blue())}));
      }
    }
    return nearest < 90;
  }
  /// Of a dotted line that goes down from a pixel.
  static int dotsBelow(const QImage& image, const QPoint& from, double bottom) {
    int dots = 0;
    bool on = false;
    for (int y = from.y(); y < bottom; ++y) {
      const bool now = image.pixelColor(from.x(), y).lightness() + image.pixelColor(from.x() - 1, y).lightness() > 20;
      dots += now && !on ? 1 : 0;
      on = now;
    }
    return dots;
  }
  /// Paused there, nothing waits for a reset.
  void leaveTheStart() {
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > 0, kLong);
    QTRY_VERIFY(!session().appliesAtOnce());
  }
  /// As before, where all texts of a widget have the same shape as then: the same but for which digits.
  void standsStill(const QWidget& widget, const QList<PaintedText>& texts) {
    static const QRegularExpression digit(QStringLiteral("\\d"));
    QString key = QString::number(reinterpret_cast<quintptr>(&widget)) + QStringLiteral(" %1 ").arg(widget.width());
    for (const PaintedText& painted : texts) key += QString(painted.text).replace(digit, QStringLiteral("0")) + '|';
    const auto [before, isNew] = m_texts.try_emplace(key, texts);
    if (isNew) return;
    for (qsizetype k = 0; k < texts.size(); ++k) {
      const PaintedText &now = texts[k], &then = before->second[k];
      m_changedInPlace[&widget] += now.text == then.text ? 0 : 1;
      const QRectF a = now.place, b = then.place;
      // Glyphs are measured in 1/64 px.
      QVERIFY2(std::abs(a.left() - b.left()) < 0.5 && std::abs(a.right() - b.right()) < 0.5,
               qPrintable(then.text + QStringLiteral(" → ") + now.text));
    }
  }
  std::map<QString, QList<PaintedText>> m_texts;
  std::map<const QWidget*, int> m_changedInPlace;
  QModelIndex rowOf(const QString& name) const {
    const QAbstractItemModel* model = m_window->outliner()->view()->model();
    const QModelIndexList found =
        model->match(model->index(0, 0), Qt::DisplayRole, name, 1, Qt::MatchExactly | Qt::MatchRecursive);
    return found.isEmpty() ? QModelIndex() : found.front();
  }
  /// What stands beside a name in the outliner.
  QString probeDetail(const QString& name) const { return rowOf(name).data(outline::kDetail).toString(); }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestContentWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_contentwindow.moc"
