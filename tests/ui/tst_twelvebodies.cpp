// SPDX-License-Identifier: Apache-2.0
// A scene of twelve bodies, built in the real window by mouse and keyboard alone, in one go: saved, shared, undone to
// nothing and redone, opened again, and run on two spacings.
#include "core/io/projectio.h"
#include "core/io/textfile.h"
#include "core/scene/group.h"
#include "core/scene/pose.h"
#include "core/scene/solidform.h"
#include "tests/ui/gizmohands.h"
#include "tests/ui/hands.h"
#include "tests/ui/samplewindow.h"
#include "ui/panels/inspector.h"
#include "ui/panels/materialspanel.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/documentfiles.h"
#include "ui/session/runwork.h"
#include "ui/tools/gizmo.h"

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtGui/QAction>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMenuBar>

#include <cmath>
#include <map>

using namespace ps;

namespace {

const QString kMesh = QStringLiteral(PS_SOURCE_DIR "/resources/models/rabbit.obj");
constexpr int kFrames = 40;

struct RowText {
  const char *key, *text;
};

}  // namespace

class TestTwelveBodies : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    m_window = sampleWindow({1600, 1000});
    QVERIFY(m_window && m_folder.isValid());
    session().pause();
    QTest::keyClick(m_window.get(), Qt::Key_N, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot() && session().snapshot()->position.empty(), kLong);
    QVERIFY(document().project().bodies.empty());
    m_empty = text();
  }
  void cleanupTestCase() { m_window.reset(); }

  /// A top, and a leg that is doubled twice; held in place, and one thing from then on.
  void aTableStandsOnThreeLegs() {
    choose("wood");
    const std::string top = add("block");
    type(Owner::Shape, top,
         {{"size_x", "240 mm"},
          {"size_y", "40 mm"},
          {"size_z", "180 mm"},
          {"position_x", "-0.1"},
          {"position_y", "0.16"}});
    const std::string leg = add("cylinder");
    type(Owner::Shape, leg,
         {{"size_x", "40 mm"},
          {"size_z", "40 mm"},
          {"size_y", "0.14"},
          {"position_x", "-0.19"},
          {"position_y", "70 mm"},
          {"position_z", "0.06"}});
    std::vector<std::string> table{top, leg};
    for (const QString& way : {QStringLiteral("180 mm"), QStringLiteral("90 mm")}) {
      click(leg);
      key(Qt::Key_D, Qt::ControlModifier);
      table.push_back(newest());
      type(Owner::Shape, newest(), {{"position_x", "-0.19"}, {"position_y", "70 mm"}, {"position_z", "0.06"}});
      key(Qt::Key_W);
      drag({GizmoPart::Kind::Arm, 0}, way);
    }
    key(Qt::Key_W);
    drag({GizmoPart::Kind::Arm, 2}, QStringLiteral("-120 mm"));
    QVERIFY((pivotOf(*document().body(newest())) - Vector3(-0.1, 0.07, -0.06)).norm() < 1e-9);
    key(Qt::Key_Escape);
    click(table);
    toggle("fixed");
    for (const std::string& id : table) QVERIFY2(isFixed(id), id.c_str());
    key(Qt::Key_G, Qt::ControlModifier);
    QCOMPARE(livingGroups(document().project()).at(0).members.size(), size_t{4});
  }

  void aBowlStandsOnTheTable() {
    choose("aluminium");
    const std::string bowl = add("bowl");
    type(Owner::Shape, bowl,
         {{"size_x", "0.12"},
          {"size_z", "0.12"},
          {"size_y", "60 mm"},
          {"wall", "20 mm"},
          {"position_x", "-0.1"},
          {"position_y", "0.22"}});
  }

  void aRampIsTurned() {
    choose("wood");
    m_ramp = add("block");
    type(Owner::Shape, m_ramp,
         {{"size_x", "0.2"},
          {"size_y", "40 mm"},
          {"size_z", "0.1"},
          {"position_x", "0.17"},
          {"position_y", "0.1"},
          {"position_z", "0.1"}});
    key(Qt::Key_R);
    drag({GizmoPart::Kind::Ring, 2}, QStringLiteral("25"));
    key(Qt::Key_Escape);
    toggle("fixed");
    QCOMPARE(document().value({Owner::Shape, m_ramp, "rotation_z"}), Value(25.0));
  }

  void aTorusOfIceLies() {
    choose("water");
    const std::string ice = add("torus");
    type(Owner::Shape, ice,
         {{"size_x", "0.12"},
          {"size_z", "0.12"},
          {"position_x", "0.18"},
          {"position_y", "0.26"},
          {"position_z", "0.1"}});
    type(Owner::Body, ice, {{"temperature", "-10 °C"}});
    ParameterRow* holds = row(Owner::Body, ice, kStructureKey);  // it came as water, which nothing holds together
    QVERIFY(holds);
    holds->setFocus();
    for (int k = 0; k < 9 && document().body(ice)->constraints.empty(); ++k) QTest::keyClick(holds, Qt::Key_Up);
    QVERIFY(!document().body(ice)->constraints.empty());
  }

  /// Upright, and held by a pin along its upper edge.
  void aSheetHangs() {
    const std::string sheet = add("sheet");
    type(Owner::Shape, sheet,
         {{"size_x", "0.16"},
          {"size_z", "0.16"},
          {"position_x", "-0.1"},
          {"position_y", "0.5"},
          {"position_z", "-0.2"}});
    key(Qt::Key_R);
    drag({GizmoPart::Kind::Ring, 0}, QStringLiteral("90"));
    key(Qt::Key_Escape);
    menu(QStringLiteral("Edit"), "edit.pin");
    QCOMPARE(document().body(sheet)->pins.size(), size_t{1});
    key(Qt::Key_W);  // higher, and back again: a pin has handles too
    const Region pin = document().body(sheet)->pins[0];
    drag({GizmoPart::Kind::Arm, 1}, QStringLiteral("10 mm"));
    QVERIFY(std::abs(document().body(sheet)->pins[0].maximum.y() - pin.maximum.y() - 0.01) < 1e-9);
    key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(document().body(sheet)->pins[0] == pin);
    key(Qt::Key_Escape);
    click(sheet);
  }

  void aRopeHangsBetweenTwoPosts() {
    choose("wood");
    const std::string left = add("cylinder");
    type(Owner::Shape, left,
         {{"size_x", "40 mm"},
          {"size_z", "40 mm"},
          {"size_y", "0.4"},
          {"position_x", "0.04"},
          {"position_y", "0.2"},
          {"position_z", "-0.2"}});
    toggle("fixed");
    key(Qt::Key_D, Qt::ControlModifier);
    const std::string right = newest();
    type(Owner::Shape, right, {{"position_x", "0.26"}, {"position_y", "0.2"}, {"position_z", "-0.2"}});
    QVERIFY(isFixed(right));
    const std::string rope = add("rope");
    type(Owner::Shape, rope, {{"points", "3"}});
    type(Owner::Shape, rope,
         {{"point_1_x", "-0.08"},
          {"point_2_x", "0"},
          {"point_2_y", "-60 mm"},
          {"point_3_x", "80 mm"},
          {"point_3_y", "0"},
          {"position_x", "0.15"},
          {"position_y", "0.36"},
          {"position_z", "-0.2"}});
    ParameterRow* held = row(Owner::Shape, rope, "held");
    QVERIFY(held);
    held->setFocus();
    QTest::keyClick(held, Qt::Key_Down);
    QTest::keyClick(held, Qt::Key_Down);
    QCOMPARE(document().value({Owner::Shape, rope, "held"}), Value(std::string("ends")));
  }

  /// It does not say its unit, and comes as small as that of the scene's room allows.
  void aMeshIsImported() {
    choose("wax");
    menu(QStringLiteral("Add"), "add.mesh", [] { hands::answerDialog(kMesh); });
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), size_t{12}, kLong);
    const std::string mesh = newest();
    const Vector3 size = SolidForm(std::get<SolidShape>(document().body(mesh)->shape)).size();
    QVERIFY2(size.y() < 0.1, qPrintable(QString::number(size.y())));
    key(Qt::Key_S);
    drag({GizmoPart::Kind::Middle, 0}, QStringLiteral("14"));
    key(Qt::Key_Escape);
    type(Owner::Shape, mesh, {{"position_x", "0.0"}, {"position_y", "80 mm"}, {"position_z", "0.2"}});
    QVERIFY((SolidForm(std::get<SolidShape>(document().body(mesh)->shape)).size() - 14 * size).norm() < 1e-9);
    QTest::qWait(300);
    picture(QStringLiteral("tst_twelvebodies_built.png"));
  }

  void itRuns() { run(); }

  void itIsSavedAndShared() {
    shorten();
    m_built = text();
    m_file = m_folder.filePath(QStringLiteral("twelve.json"));
    const QString copy = m_folder.filePath(QStringLiteral("twelve-shared.json"));
    menu(QStringLiteral("File"), "file.saveAs", [this] { hands::answerDialog(m_file); });
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(m_file) && !document().isDirty(), kLong);
    QCOMPARE(text(), m_built);
    QCOMPARE(readFile(m_file.toStdString(), 1 << 26), m_built);
    QSignalSpy done(&session().work(), &RunWork::done);
    menu(QStringLiteral("File"), "file.share", [copy] { hands::answerDialog(copy); });
    QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, 2 * kLong);
    const Project shared = loadProject(copy.toStdString(), *session().plugins()).project;
    QVERIFY(shared.end && shared.end->frame > 0 && std::isfinite(shared.end->temperature));
    QCOMPARE(shared.bodies.size(), size_t{12});
    QCOMPARE(text(), m_built);
  }

  void itIsUndoneToNothingAndRedone() {
    const int steps = document().undoStack().count();
    QCOMPARE(document().undoStack().index(), steps);
    for (int k = 0; k < steps; ++k) key(Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(!document().undoStack().canUndo());
    QCOMPARE(text(), m_empty);
    QTRY_VERIFY_WITH_TIMEOUT(idsNow(session()).empty(), kLong);
    for (int k = 0; k < steps; ++k) key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QVERIFY(!document().undoStack().canRedo());
    QCOMPARE(text(), m_built);
    QVERIFY(!document().isDirty());
  }

  /// On finer particles: all of it is there, and stays where it may be.
  void itIsOpenedAgainOnAnotherSpacing() {
    QTest::keyClick(m_window.get(), Qt::Key_N, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(document().project().bodies.empty(), kLong);
    menu(QStringLiteral("File"), "file.open", [this] { hands::answerDialog(m_file); });
    QTRY_COMPARE_WITH_TIMEOUT(document().path(), m_file, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(!session().snapshot()->position.empty(), kLong);
    session().pause();
    QCOMPARE(text(), m_built);
    const size_t coarse = run();
    type(Owner::Solver, "", {{"particle_spacing", "17 mm"}});
    const size_t fine = run();
    QVERIFY(fine > coarse * 1.2);
    picture(QStringLiteral("tst_twelvebodies_fine.png"));
    key(Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(text(), m_built);
  }

 private:
  std::string text() { return writeProject(document().project()); }
  std::string newest() { return document().project().bodies.back().id; }
  bool isFixed(const std::string& id) { return document().value({Owner::Body, id, "fixed"}) == Value(true); }
  void key(Qt::Key which, Qt::KeyboardModifiers modifiers = {}) {
    view()->setFocus();
    QTest::keyClick(view(), which, modifiers);
  }
  /// A click on a menu's title, and one on its entry. `first` is done just before that.
  void menu(const QString& title, const char* entry, const std::function<void()>& first = {}) {
    auto* bar = m_window->findChild<QMenuBar*>();
    QMenu* open = nullptr;
    for (QAction* each : bar->actions()) {
      if (each->text().remove(QLatin1Char('&')) != title) continue;
      QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(each).center());
      open = each->menu();
    }
    QAction* action = m_window->action(QString::fromLatin1(entry));
    QVERIFY(open && action && action->isEnabled() && open->actions().contains(action));
    QTRY_VERIFY(open->isVisible());
    if (first) first();
    QTest::mouseClick(open, Qt::LeftButton, {}, open->actionGeometry(action).center());
  }
  /// From the grid of materials.
  void choose(const char* material) {
    auto* panel = m_window->findChild<MaterialsPanel*>();
    const QRect tile = panel->tileOf(material);
    QVERIFY2(!tile.isEmpty(), material);
    QTest::mouseClick(panel, Qt::LeftButton, {}, tile.center());
    QCOMPARE(m_window->selection().material(), std::string(material));
  }
  std::string add(const char* kind) {
    const size_t before = document().project().bodies.size();
    menu(QStringLiteral("Add"), (std::string("add.") + kind).c_str());
    [&] { QCOMPARE(document().project().bodies.size(), before + 1); }();
    const std::string id = newest();
    [&] { QTRY_VERIFY_WITH_TIMEOUT(!placesOf(id).empty(), kLong); }();
    [&] { QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong); }();
    return id;
  }
  ParameterRow* row(Owner owner, const std::string& id, const char* parameter) {
    const Address address{owner, id, parameter};
    QApplication::processEvents();  // rows of what has just been selected find their places
    if (!m_window->revealParameter(address, false)) return nullptr;
    QApplication::processEvents();
    return m_window->inspector().panelFor(address)->row(QString::fromStdString(address.text()));
  }
  void type(Owner owner, const std::string& id, const std::vector<RowText>& rows) {
    for (const auto& [parameter, text] : rows) {
      ParameterRow* field = row(owner, id, parameter);
      QVERIFY2(field, parameter);
      QTest::mouseClick(field, Qt::LeftButton, {}, field->fieldRect().center());
      auto* line = field->findChild<QLineEdit*>();
      QVERIFY2(line, parameter);
      line->selectAll();
      QTest::keyClicks(line, QString::fromUtf8(text));
      QTest::keyClick(line, Qt::Key_Return);
      QVERIFY2(!field->has(RowState::Error), parameter);
    }
  }
  /// Of all bodies that are selected.
  void toggle(const char* parameter) {
    QApplication::processEvents();
    ParameterPanel* panel = m_window->inspector().bodyPanel();
    const Address address{Owner::Body, m_window->selection().body(), parameter};
    QVERIFY(panel->reveal(QString::fromStdString(address.text()), false));
    QApplication::processEvents();
    ParameterRow* switched = panel->row(QString::fromStdString(address.text()));
    QTest::mouseClick(switched, Qt::LeftButton, {},
                      {switched->fieldRect().right() - 18, switched->fieldRect().center().y()});
  }
  /// Rows of the outliner.
  void click(const std::vector<std::string>& ids) {
    auto* tree = m_window->findChild<Outliner*>()->view();
    for (size_t k = 0; k < ids.size(); ++k) {
      const QModelIndex index = hands::outlined(*m_window, OutlineKind::Body, ids[k]);
      QVERIFY(index.isValid());
      tree->scrollTo(index);
      QTest::mouseClick(tree->viewport(), Qt::LeftButton, k > 0 ? Qt::ControlModifier : Qt::NoModifier,
                        QPoint(tree->visualRect(index).left() + 40, tree->visualRect(index).center().y()));
    }
    QCOMPARE(m_window->selection().bodies().size(), ids.size());
  }
  void click(const std::string& id) { click(std::vector<std::string>{id}); }
  void shorten() {
    menu(QStringLiteral("Edit"), "edit.project");
    auto* dialog = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
    QVERIFY(dialog && QTest::qWaitForWindowActive(dialog));
    for (QLineEdit* line : dialog->findChildren<QLineEdit*>()) {
      if (line->accessibleName() != QStringLiteral("Duration")) continue;
      line->setFocus();
      line->selectAll();
      QTest::keyClicks(line, QStringLiteral("0.2 s"));
    }
    QTest::keyClick(dialog, Qt::Key_Escape);
    QCOMPARE(document().project().duration, 0.2);
    QApplication::setActiveWindow(m_window.get());
  }
  /// Of each particle of a body, or of all.
  std::vector<Vector3> placesOf(const std::string& id) {
    return onEngine<std::vector<Vector3>>(session(), [id](Engine& engine) {
      std::vector<Vector3> places;
      const ParticleStore& store = engine.particles();
      for (size_t i = 0; i < store.size(); ++i) {
        if (id.empty() || engine.bodyIds()[store.body()[i]] == id) places.push_back(vectorOf(store.position()[i]));
      }
      return places;
    });
  }
  /// From the start, frame by frame: no body loses matter, none leaves the scene, none is torn apart. Returns how much
  /// matter there is.
  size_t run() {
    const uint64_t revision = session().snapshot()->revision;
    key(Qt::Key_Home);
    [&] {
      QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision && session().snapshot()->stats.frame == 0,
                               kLong);
    }();
    std::map<std::string, size_t> counts;
    for (const Body& body : document().project().bodies) counts[body.id] = placesOf(body.id).size();
    for (uint64_t frame = 1; frame <= kFrames; ++frame) {
      key(Qt::Key_Right);
      [&] { QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame >= frame, kLong); }();
      if (QTest::currentTestFailed()) return 0;
    }
    const Environment& scene = document().project().environment;
    for (const auto& [id, count] : counts) {
      const std::vector<Vector3> places = placesOf(id);
      const auto within = [&](const Vector3& p) {
        return p.allFinite() && (p.array() >= scene.boundsMinimum.array()).all() &&
               (p.array() <= scene.boundsMaximum.array()).all();
      };
      [&] {
        QVERIFY2(count > 0 && places.size() == count, id.c_str());
        QVERIFY2(std::all_of(places.begin(), places.end(), within), id.c_str());
      }();
    }
    return placesOf({}).size();
  }
  /// A handle is taken, and just so far is typed.
  void drag(const GizmoPart& part, const QString& amount) {
    const QPoint at = hands::middleOf(*m_window, part), way(20, 0);
    hands::press(*view(), at, way, {}, {});
    QVERIFY(m_window->tools().tool().picture().gizmo->active == part);
    QTest::keyClicks(view(), amount);
    QTest::keyClick(view(), Qt::Key_Return);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, at + way);
  }

  QTemporaryDir m_folder;
  QString m_file;
  std::string m_empty, m_built, m_ramp;
};

QTEST_MAIN(TestTwelveBodies)
#include "tst_twelvebodies.moc"
