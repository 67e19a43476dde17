// SPDX-License-Identifier: Apache-2.0
// Bodies and materials come and go by hands in the real window; rows that follow.
#include "tests/ui/samplewindow.h"
#include "ui/document/document.h"
#include "ui/graphs/energypanel.h"
#include "ui/panels/brushpanel.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/selection.h"
#include "ui/session/wording.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"
#include "ui/window/noticebar.h"

#include <QtGui/QAction>
#include <QtGui/QContextMenuEvent>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTreeView>

#include <set>

using namespace ps;

class TestContentWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() { backToTheStart(); }
  void cleanupTestCase() { m_window.reset(); }

  void anInstalledMaterialIsAddedAndDrawn() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
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

  /// Enter adds what the arrows have walked to; walking alone adds nothing.
  void materialsAreAddedWithoutAMouse() {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    QTest::keyClick(panel, Qt::Key_Down);
    QCOMPARE(document().project().materials.size(), size_t{1});
    QTest::keyClick(panel, Qt::Key_Return);
    QCOMPARE(document().project().materials.size(), size_t{2});
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
    QVERIFY(row && row->model().rules.contains(QStringLiteral("Acts at the next reset.")));
    const auto waits = [&] { return row->has(RowState::Limited); };
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

  /// It is in no phase's mass, but has heat all the same.
  void heldMatterHasItsLedger() {
    QTRY_VERIFY(session().snapshot() && !session().snapshot()->id.empty());
    EnergyPanel panel(session());
    FrameStats held;
    held.thermalEnergy = 5;
    panel.append(held);
    QVERIFY2(panel.findChild<QLabel*>()->text().contains(QStringLiteral("Heat in matter")),
             qPrintable(panel.findChild<QLabel*>()->text()));
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

  void theBrushIsNoPartOfTheScene() {
    auto* panel = m_window->findChild<BrushPanel*>();
    QVERIFY(panel && panel->row(QStringLiteral("radius")));
    const int steps = document().undoStack().count();
    QVERIFY(panel->row(QStringLiteral("radius"))->enterNumber(0.123));
    QCOMPARE(m_window->tools().brush().radius, 0.123);
    QCOMPARE(document().undoStack().count(), steps);
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestContentWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_contentwindow.moc"
