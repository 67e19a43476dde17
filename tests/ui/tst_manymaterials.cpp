// SPDX-License-Identifier: Apache-2.0
// Several materials at once in the real window: chosen by hands, edited together, as bodies are.
#include "core/matter/material.h"
#include "core/simulation/engine.h"
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/rows/panelheader.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/rowvalue.h"
#include "ui/session/selection.h"
#include "ui/window/dock.h"
#include "ui/window/windowlayout.h"

#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>

#include <cmath>
#include <string>

using namespace ps;

namespace {

const std::string kIron = "iron", kWater = "water", kWax = "wax";

}  // namespace

class TestManyMaterials : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { open(); }
  void init() {
    backToTheStart();
    for (const std::string& base : {kIron, kWax}) document().addMaterial(base);
    m_window->layoutOfDocks().showPage(QStringLiteral("Materials"));
    m_window->layoutOfDocks().showPage(QStringLiteral("Material"));
    selection().setMaterial(kWater);
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    QTRY_VERIFY(!tiles()->tileOf(kWax).isEmpty());
  }
  void cleanupTestCase() { m_window.reset(); }

  /// A click chooses one, Shift and Ctrl one more or one less, but for the last.
  void clicksChooseSeveral() {
    click(kIron, Qt::ShiftModifier);
    QCOMPARE(selection().materials(), (std::vector<std::string>{kWater, kIron}));
    QCOMPARE(selection().material(), kIron);
    click(kWax, Qt::ControlModifier);
    QCOMPARE(selection().materials(), (std::vector<std::string>{kWater, kIron, kWax}));
    click(kIron, Qt::ShiftModifier);
    QCOMPARE(selection().materials(), (std::vector<std::string>{kWater, kWax}));
    m_window->viewport()->setFocus();
    tiles()->setFocus(Qt::TabFocusReason);
    QTest::keyClick(tiles(), Qt::Key_Left, Qt::ShiftModifier);
    QCOMPARE(selection().materials(), (std::vector<std::string>{kWater, kWax, kIron}));
    click(kWax, {});
    QCOMPARE(selection().materials(), std::vector<std::string>{kWax});
    click(kWax, Qt::ShiftModifier);
    QCOMPARE(selection().materials(), std::vector<std::string>{kWax});
    // One that leaves the scene is chosen no more.
    choose({kWater, kIron, kWax});
    document().undoStack().undo();
    QCOMPARE(selection().materials(), (std::vector<std::string>{kWater, kIron}));
  }

  /// While their panel has the focus, Cut means the chosen ones, and no body; what something is of stays.
  void cutTakesThemAlone() {
    choose({kWater, kIron, kWax});
    m_window->selection().select(OutlineKind::Body, "ice");
    choose({kWater, kIron, kWax});
    tiles()->setFocus();
    QTRY_VERIFY(tiles()->hasFocus());
    const size_t bodies = document().project().bodies.size(), before = document().project().materials.size();
    const int steps = document().undoStack().index();
    m_window->action(QStringLiteral("edit.cut"))->trigger();
    QCOMPARE(document().project().bodies.size(), bodies);
    QCOMPARE(document().project().materials.size(), before - 2);
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("is of it")), qPrintable(m_window->notice()->text()));
    m_window->action(QStringLiteral("edit.paste"))->trigger();
    QCOMPARE(document().project().materials.size(), before);
    document().undoStack().undo();
    document().undoStack().undo();
    QCOMPARE(document().project().materials.size(), before);
  }

  /// Rows that they share, "—" where values differ; a number is set for all, *2 and +10 act on each: one step each.
  void rowsOfManyEditAll() {
    choose({kWater, kIron});
    QVERIFY(row("density_solid") && row("density_solid")->has(RowState::Mixed));
    QCOMPARE(row("density_solid")->valueText(), QStringLiteral("—"));
    picture(QStringLiteral("materials-mixed.png"));
    const double water = at(kWater, "density_solid"), iron = at(kIron, "density_solid");
    const int steps = document().undoStack().index();
    QVERIFY(type("density_solid", QStringLiteral("*2")));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QCOMPARE(document().undoStack().undoText(), QStringLiteral("Density, solid of 2 materials"));
    QVERIFY(near(at(kWater, "density_solid"), 2 * water) && near(at(kIron, "density_solid"), 2 * iron));
    QVERIFY(row("density_solid")->has(RowState::Mixed));
    QVERIFY(type("density_solid", QStringLiteral("+10")));
    QCOMPARE(document().undoStack().index(), steps + 2);
    QVERIFY(near(at(kWater, "density_solid"), 2 * water + 10) && near(at(kIron, "density_solid"), 2 * iron + 10));
    QVERIFY(type("density_solid", QStringLiteral("3000")));
    QCOMPARE(document().undoStack().index(), steps + 3);
    QVERIFY(near(at(kWater, "density_solid"), 3000) && near(at(kIron, "density_solid"), 3000));
    QVERIFY(!row("density_solid")->has(RowState::Mixed));
    // Each has a default of its own.
    row("density_solid")->reset();
    QCOMPARE(document().undoStack().index(), steps + 4);
    QVERIFY(near(at(kWater, "density_solid"), water) && near(at(kIron, "density_solid"), iron));
    QVERIFY(row("density_solid")->has(RowState::Mixed));
    for (int k = 0; k < 3; ++k) document().undoStack().undo();
    QVERIFY(near(at(kWater, "density_solid"), 2 * water) && near(at(kIron, "density_solid"), 2 * iron));
    // One that may not have a value keeps all from it, and is named.
    QVERIFY(type("density_solid", QStringLiteral("*1e9")));
    QVERIFY(row("density_solid")->has(RowState::Error));
    QVERIFY(near(at(kWater, "density_solid"), 2 * water) && near(at(kIron, "density_solid"), 2 * iron));
    QVERIFY2(noteOf("density_solid").contains(QStringLiteral(": ")), qPrintable(noteOf("density_solid")));
  }

  /// The mouse on the slider: all follow, as one step; Esc gives each back what it had, a double-click its default.
  void aDragSetsAll() {
    choose({kWax, kIron});
    ParameterRow* slider = shown("heat_capacity_solid");
    QVERIFY(slider->has(RowState::Mixed));
    const double wax = at(kWax, "heat_capacity_solid"), iron = at(kIron, "heat_capacity_solid");
    const int steps = document().undoStack().index();
    const QRect track = slider->sliderRect();
    const auto place = [&](double share) {
      return QPoint(track.left() + static_cast<int>(share * track.width()), track.center().y());
    };
    QTest::mousePress(slider, Qt::LeftButton, {}, place(0.2));
    for (const double share : {0.3, 0.4, 0.5}) move(*slider, place(share));
    QVERIFY(at(kWax, "heat_capacity_solid") == at(kIron, "heat_capacity_solid") &&
            at(kIron, "heat_capacity_solid") != iron);
    QTest::keyClick(slider, Qt::Key_Escape);
    QTest::mouseRelease(slider, Qt::LeftButton, {}, place(0.5));
    QVERIFY(near(at(kWax, "heat_capacity_solid"), wax) && near(at(kIron, "heat_capacity_solid"), iron));
    QVERIFY(slider->has(RowState::Mixed));
    QCOMPARE(document().undoStack().index(), steps);
    QTest::mousePress(slider, Qt::LeftButton, {}, place(0.2));
    for (const double share : {0.3, 0.4, 0.6}) move(*slider, place(share));
    QTest::mouseRelease(slider, Qt::LeftButton, {}, place(0.6));
    slider->finishEditing();
    QVERIFY(at(kWax, "heat_capacity_solid") == at(kIron, "heat_capacity_solid"));
    QVERIFY(std::abs(sliderPosition(slider->model().declaration, at(kIron, "heat_capacity_solid")) - 0.6) < 0.05);
    QVERIFY(!slider->has(RowState::Mixed));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QTest::mouseDClick(slider, Qt::LeftButton, {}, slider->labelRect().center());
    QVERIFY(near(at(kWax, "heat_capacity_solid"), wax) && near(at(kIron, "heat_capacity_solid"), iron));
    QCOMPARE(document().undoStack().index(), steps + 2);
    document().undoStack().undo();
    document().undoStack().undo();
    QVERIFY(near(at(kWax, "heat_capacity_solid"), wax) && near(at(kIron, "heat_capacity_solid"), iron));
  }

  /// Curves and laws keep their shapes: *2 doubles all of each, by the keyboard or as the small curve is dragged. What
  /// a law cannot do, the row says, and then nothing is changed.
  void curvesAndLawsAreScaled() {
    choose({kIron, kWax});
    const Response iron = response(kIron, "youngs_modulus"), wax = response(kWax, "youngs_modulus");
    QVERIFY(iron.kind == Response::Kind::Curve && wax.kind == Response::Kind::Law);
    const int steps = document().undoStack().index();
    QVERIFY(type("youngs_modulus", QStringLiteral("/2")));
    QCOMPARE(document().undoStack().index(), steps + 1);
    QVERIFY(response(kIron, "youngs_modulus") == iron.scaled(0.5));
    QVERIFY(response(kWax, "youngs_modulus") == wax.scaled(0.5));
    document().undoStack().undo();
    QVERIFY(type("youngs_modulus", QStringLiteral("+10")));
    QVERIFY(row("youngs_modulus")->has(RowState::Error));
    QVERIFY2(noteOf("youngs_modulus").contains(QStringLiteral("law “exponential”")),
             qPrintable(noteOf("youngs_modulus")));
    QVERIFY(response(kIron, "youngs_modulus") == iron && response(kWax, "youngs_modulus") == wax);
    ParameterRow* modulus = shown("youngs_modulus");
    const QPoint from = modulus->sliderRect().center();
    QTest::mousePress(modulus, Qt::LeftButton, {}, from);
    for (int k = 1; k <= 4; ++k) move(*modulus, from - QPoint(3 * k, 0));
    QTest::mouseRelease(modulus, Qt::LeftButton, {}, from - QPoint(12, 0));
    modulus->finishEditing();
    QCOMPARE(document().undoStack().index(), steps + 1);
    const double factor = response(kIron, "youngs_modulus").points[0].y / iron.points[0].y;
    QVERIFY(factor < 1 && factor > 0.1);
    QVERIFY(near(response(kWax, "youngs_modulus").coefficients[0] / wax.coefficients[0], factor));
    QVERIFY(modulus->has(RowState::Mixed));
    document().undoStack().undo();
    QVERIFY(response(kIron, "youngs_modulus") == iron && response(kWax, "youngs_modulus") == wax);
  }

  /// Whether they hold on to a third one, too; and what they do not share has no row.
  void otherRows() {
    choose({kWater, kIron});
    QVERIFY(row("adheres_to.wax"));
    QVERIFY(!row("adheres_to.water") && !row("adheres_to.iron"));
    const int steps = document().undoStack().index();
    for (const Edit edit : {Edit::Begin, Edit::Live, Edit::End})
      Q_EMIT panel()->edited(keyOf("adheres_to.wax"), Value{true}, edit);
    QCOMPARE(document().undoStack().index(), steps + 1);
    for (const std::string& id : {kWater, kIron})
      QVERIFY(std::get<bool>(document().value({Owner::Material, id, "adheres_to.wax"})));
    document().undoStack().undo();
    QVERIFY(!std::get<bool>(document().value({Owner::Material, kIron, "adheres_to.wax"})));
  }

  /// Matter that runs has it at its next frame.
  void runningMatterAnswers() {
    choose({kIron, kWater});
    session().play();
    const double before = at(kWater, "viscosity");
    QVERIFY(type("viscosity", QStringLiteral("*2")));
    QTRY_VERIFY_WITH_TIMEOUT(
        onEngine<bool>(session(),
                       [&](Engine& engine) {
                         const ParameterSet* water = findSet(engine.project(), {Owner::Material, kWater, "viscosity"});
                         const auto found = water->values.find("viscosity");
                         return found != water->values.end() && near(responseOf(found->second).at(293.15), 2 * before);
                       }),
        kLong);
    session().pause();
  }

 private:
  static void move(ParameterRow& row, const QPointF& at) {
    QMouseEvent event(QEvent::MouseMove, at, row.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&row, &event);
  }
  static bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }
  Selection& selection() { return m_window->selection(); }
  MaterialsPanel* tiles() { return m_window->findChild<MaterialsPanel*>(); }
  ParameterPanel* panel() { return m_window->inspector().materialPanel(); }
  void click(const std::string& id, Qt::KeyboardModifiers keys) {
    QTest::mouseClick(tiles(), Qt::LeftButton, keys, tiles()->tileOf(id).center());
  }
  void choose(const std::vector<std::string>& ids) {
    for (const std::string& id : ids) click(id, id == ids.front() ? Qt::NoModifier : Qt::ShiftModifier);
    QCOMPARE(selection().materials(), ids);
  }
  QString keyOf(const char* property) {
    return QString::fromStdString(Address{Owner::Material, selection().material(), property}.text());
  }
  ParameterRow* row(const char* property) { return panel()->row(keyOf(property)); }
  ParameterRow* shown(const char* property) {
    panel()->reveal(keyOf(property));
    return row(property);
  }
  /// By the keyboard, in the row's field.
  bool type(const char* property, const QString& text) {
    ParameterRow* typed = shown(property);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);  // the last one's field
    QTest::mouseClick(typed, Qt::LeftButton, {}, typed->fieldRect().center());
    auto* edit = typed->findChild<QLineEdit*>();
    if (!edit) return false;
    edit->selectAll();
    QTest::keyClicks(edit, text);
    QTest::keyClick(edit, Qt::Key_Return);
    return !typed->has(RowState::Editing);
  }
  QString noteOf(const char* property) {
    const auto* note = row(property)->findChild<QLabel*>(QStringLiteral("psError"));
    return note ? note->text() : QString();
  }
  Response response(const std::string& id, const char* property) {
    return responseOf(document().value({Owner::Material, id, property}));
  }
  double at(const std::string& id, const char* property) { return response(id, property).at(293.15); }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestManyMaterials test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_manymaterials.moc"
