// SPDX-License-Identifier: Apache-2.0
// Gestures around the brush in the window: its size, the matter that it takes, and the other end of a pen.
#include "core/plugin_host/registry.h"
#include "samplewindow.h"
#include "tests/ui/hands.h"
#include "ui/panels/brushpanel.h"
#include "ui/session/preferences.h"
#include "ui/session/selection.h"
#include "ui/theme/resources.h"
#include "ui/tools/tooltable.h"
#include "ui/window/dock.h"
#include "ui/window/favouritebrushes.h"
#include "ui/window/noticebar.h"

#include <QtCore/QDir>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QTemporaryDir>
#include <QtGui/QPointingDevice>
#include <QtGui/QTabletEvent>
#include <QtWidgets/QDialog>
#include <QtWidgets/QLabel>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QToolButton>

#include <algorithm>
#include <cmath>

using namespace ps;

class TestBrushWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    open();
    document().addMaterial("iron");
    document().undoStack().clear();
  }
  void init() {
    backToTheStart();
    m_window->activateWindow();  // a form may have been before it
    QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
    m_window->tools().activate(kBrushTool);
    QVERIFY(m_window->tools().tool().usesBrush());
  }
  void cleanup() { m_window->tools().setMouse(MousePreset::PhaseSketch); }
  void cleanupTestCase() { m_window.reset(); }

  /// What a notice says of a brush that is too large holds until the brush, the tool or the spacing is another one, or
  /// the scene runs.
  void whatStoodInTheWayGoesWithIt() {
    const BrushSettings usual = m_window->tools().brush();
    const auto said = [this] {
      return m_window->notice()->isVisible() && m_window->notice()->text().contains(QStringLiteral("One stamp of"));
    };
    const auto refuse = [&] {
      m_window->tools().takeBrush("cube");
      BrushSettings brush = m_window->tools().brush();
      brush.radius = kBrushMaximum;
      m_window->tools().setBrush(brush);
      stroke(view()->rect().center(), {20, 0}, true);
      QVERIFY2(said(), qPrintable(m_window->notice()->text()));
      QTest::qWait(1);
      QVERIFY(said());
    };
    refuse();
    m_window->tools().setBrush(usual);
    QVERIFY(!said());
    refuse();
    m_window->tools().activate("select");
    QVERIFY(!said());
    m_window->tools().activate(kBrushTool);
    refuse();
    session().play();
    QTRY_VERIFY(!said());
    session().pause();
    refuse();
    QCOMPARE(document().setParameter({Owner::Solver, "", "particle_spacing"}, 0.03), QString());
    QVERIFY(!said());
    m_window->tools().setBrush(usual);
    document().undoStack().undo();
    document().undoStack().clear();
  }

  void aDragMakesTheBrushLarger_data() {
    QTest::addColumn<int>("preset");
    QTest::addColumn<Qt::KeyboardModifiers>("keys");
    QTest::newRow("PhaseSketch") << static_cast<int>(MousePreset::PhaseSketch) << Qt::KeyboardModifiers(Qt::ALT);
    QTest::newRow("Blender") << static_cast<int>(MousePreset::Blender) << Qt::KeyboardModifiers(Qt::ALT);
    QTest::newRow("Maya, whose Alt with the right button is the view's")
        << static_cast<int>(MousePreset::Maya) << Qt::KeyboardModifiers(Qt::SHIFT);
    QTest::newRow("CAD") << static_cast<int>(MousePreset::Cad) << Qt::KeyboardModifiers(Qt::ALT);
  }
  void aDragMakesTheBrushLarger() {
    QFETCH(int, preset);
    QFETCH(Qt::KeyboardModifiers, keys);
    m_window->tools().setMouse(static_cast<MousePreset>(preset));
    const double before = m_window->tools().brush().radius;
    const Camera camera = view()->navigator().camera();
    press(Qt::RightButton, keys, kMiddle);
    move({60, 0}, Qt::RightButton, keys);
    const double larger = m_window->tools().brush().radius;
    QVERIFY2(std::abs(larger / before - std::sqrt(2)) < 1e-6, qPrintable(QString::number(larger / before)));
    move({-60, 0}, Qt::RightButton, keys);
    QVERIFY(m_window->tools().brush().radius < before);
    move({100000, 0}, Qt::RightButton, keys);
    QCOMPARE(m_window->tools().brush().radius, kBrushMaximum);
    QVERIFY(view()->cancelGesture());
    QCOMPARE(m_window->tools().brush().radius, before);
    release(Qt::RightButton, keys);
    QCOMPARE(document().undoStack().count(), 0);
    QCOMPARE(view()->navigator().camera().distance, camera.distance);
    QCOMPARE(view()->navigator().camera().azimuth, camera.azimuth);
  }

  void altAndAClickTakeTheMatterThatIsThere() {
    m_window->selection().pickMaterial("iron");
    QCOMPARE(m_window->tools().brush().material, std::string("iron"));
    QTest::mouseClick(view(), Qt::LeftButton, Qt::AltModifier, view()->rect().center());
    QCOMPARE(m_window->tools().brush().material, std::string("water"));
    QCOMPARE(document().undoStack().count(), 0);  // nothing was drawn
  }

  /// On the ice that the mouse is on, or across the view; strokes lie on it from then on.
  void aKeyLaysAPlaneToDrawOn() {
    QApplication::setActiveWindow(m_window.get());
    view()->setFocus();
    const QPoint middle = view()->rect().center();
    QTest::mouseMove(view(), middle);
    QCursor::setPos(view()->mapToGlobal(middle));
    QTest::keyClick(view(), Qt::Key_I);
    QCOMPARE(m_window->tools().brush().drawOn, DrawOn::Plane);
    const FreePlane onIce = m_window->tools().brush().plane;
    QVERIFY(onIce.point.y() > 0);
    QTest::keyClick(view(), Qt::Key_I, Qt::ShiftModifier);
    const FreePlane plane = m_window->tools().brush().plane;
    const Vector3 forward = frameOf(view()->navigator().camera()).forward;
    QVERIFY(!(plane == onIce) && (plane.normal() + forward).norm() < 1e-9);
    picture(QStringLiteral("plane across the view.png"));
    stroke(middle - QPoint(60, 0), {120, 0}, true);
    const auto& drawn = std::get<VoxelShape>(document().project().bodies.back().shape);
    for (const auto& s : drawn.strokes.back().samples)
      QVERIFY(std::abs((Vector3(s[0], s[1], s[2]) - plane.point).dot(forward)) < 1e-9);
    BrushSettings brush = m_window->tools().brush();
    brush.drawOn = DrawOn::Surface;
    m_window->tools().setBrush(brush);
  }

  /// A brush is kept as it is, for all windows, and taken again with all that it was; undo knows nothing of it.
  void favouritesComeBack() {
    preferences::setFavouriteBrushes({});
    FavouriteBrushes& favourites = m_window->favourites();
    BrushSettings brush = m_window->tools().brush();
    brush.shape = "sphere";
    brush.radius = 0.031;
    brush.material = "iron";
    brush.temperature = 400;
    brush.symmetry.mirror = "x";
    brush.parameters["sphere"].values["pressure_size"] = 0.25;
    m_window->tools().setBrush(brush);
    m_window->action(QStringLiteral("sketch.keepBrush"))->trigger();
    favourites.keep();  // once is enough
    QCOMPARE(favourites.all().size(), size_t{1});
    const FavouriteBrush kept = favourites.all()[0];
    QVERIFY2(kept.name.contains(lengthText(0.031)) && kept.name.contains(QStringLiteral("Iron")),
             qPrintable(kept.name));
    brush.radius = 0.05;
    brush.temperature = 293.15;
    brush.symmetry.mirror = "none";
    brush.material = "water";
    brush.shape = "cube";
    brush.parameters["sphere"].values.clear();
    m_window->tools().setBrush(brush);
    m_window->tools().activate(kSelectTool);
    const auto entries = m_window->paletteEntries();
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const PaletteEntry& entry) { return entry.title == kept.name; });
    QVERIFY(found != entries.end());
    found->run();
    const BrushSettings& inHand = m_window->tools().brush();
    QVERIFY(m_window->tools().tool().usesBrush());
    QCOMPARE(m_window->selection().material(), std::string("iron"));
    QCOMPARE(inHand.shape, std::string("sphere"));
    QVERIFY(inHand.radius == 0.031 && inHand.temperature == 400 && inHand.material == "iron");
    QCOMPARE(inHand.symmetry.mirror, std::string("x"));
    QCOMPARE(std::get<double>(inHand.shapeParameters().values.at("pressure_size")), 0.25);
    QCOMPARE(document().undoStack().index(), 0);
    // What is damaged, of another version, or beyond its range, is left out by itself.
    const QByteArray text = textOf({kept});
    const PluginRegistry& plugins = *session().plugins();
    QVERIFY(favouritesOf(text, plugins) == std::vector<FavouriteBrush>{kept});
    QVERIFY(favouritesOf("[{]", plugins).empty() && favouritesOf("[1, {\"name\": 3}]", plugins).empty());
    QByteArray wide = text;
    wide.replace("0.031", "31000").replace("0.25", "\"a\"");
    QCOMPARE(favouritesOf(wide, plugins)[0].brush.radius, BrushSettings{}.radius);
    QVERIFY(favouritesOf(wide, plugins)[0].brush.shapeParameters().values.empty());
    QByteArray gone = text;
    gone.replace("\"sphere\"", "\"gone\"");
    QVERIFY(textOf(favouritesOf(gone, plugins)).contains("0.25"));  // what is not known here is kept
    favourites.take(favouritesOf(gone, plugins)[0]);
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("not installed")));
    QCOMPARE(m_window->tools().brush().shape, std::string("sphere"));
    favourites.forget(kept);
    QVERIFY(favourites.all().empty());
    brush.shape = "cube";
    m_window->tools().setBrush(brush);
  }

  /// All that they say is declared, and within its bounds. One that is taken leaves guides and matter as they are,
  /// unless it says otherwise.
  void readyBrushesComeWithTheProgram() {
    const std::vector<ReadyBrush> ready = m_window->favourites().ready();
    const QJsonArray said = QJsonDocument::fromJson(themeResource(QStringLiteral("brushes/brushes.json"))).array();
    QVERIFY(ready.size() >= 12);
    QCOMPARE(static_cast<qsizetype>(ready.size()), said.size());
    for (size_t k = 0; k < ready.size(); ++k) {
      const QJsonObject one = said[static_cast<qsizetype>(k)].toObject();
      const auto count = [&](const char* key) { return one[QLatin1String(key)].toObject().size(); };
      QVERIFY2(static_cast<qsizetype>(ready[k].brush.values.size()) == count("brush"), qPrintable(ready[k].name));
      QVERIFY2(static_cast<qsizetype>(ready[k].parameters.values.size()) == count("parameters"),
               qPrintable(ready[k].name));
      QVERIFY(!ready[k].about.isEmpty());
    }
    BrushSettings brush = m_window->tools().brush();
    const BrushSettings before = brush;
    brush.material = "iron";
    brush.symmetry.mirror = "x";
    m_window->tools().setBrush(brush);
    m_window->tools().activate(kSelectTool);
    const auto run = [&](const char* title) {
      const auto entries = m_window->paletteEntries();
      const auto found = std::find_if(entries.begin(), entries.end(),
                                      [&](const PaletteEntry& entry) { return entry.title == QLatin1String(title); });
      QVERIFY(found != entries.end() && found->where == QStringLiteral("Ready brushes"));
      found->run();
    };
    const BrushSettings& inHand = m_window->tools().brush();
    run("Hot torch");
    QVERIFY(m_window->tools().tool().usesBrush());
    QVERIFY(inHand.shape == "heat" && inHand.radius == 0.02 && inHand.material == "iron");
    QCOMPARE(std::get<double>(inHand.shapeParameters().values.at("power")), 2000.0);
    QCOMPARE(inHand.symmetry.mirror, std::string("x"));
    run("Snow");
    QVERIFY(inHand.shape == "spray" && inHand.material == "water" && inHand.temperature == 263.15);
    QCOMPARE(inHand.becomes, std::string("loose"));
    QCOMPARE(m_window->selection().material(), std::string("water"));
    m_window->tools().setBrush(before);
  }

  /// Kept and named in the form, forgotten and brought back there; a file takes them to others.
  void favouritesAreNamedAndGoIntoFiles() {
    preferences::setFavouriteBrushes({});
    FavouriteBrushes& favourites = m_window->favourites();
    m_window->action(QStringLiteral("sketch.brushes"))->trigger();
    auto* form = m_window->findChild<QDialog*>(QStringLiteral("psBrushes"));
    QVERIFY(form);
    auto* list = form->findChild<QListWidget*>();
    QCOMPARE(said(*form), QString());
    click(*form, "Keep this brush");
    QCOMPARE(list->count(), 1);
    QVERIFY2(said(*form).contains(QStringLiteral("is kept")), qPrintable(said(*form)));
    auto* field = list->findChild<QLineEdit*>();
    QVERIFY(field);
    field->setText(QStringLiteral(" my <b>chalk</b> "));
    QTest::keyClick(field, Qt::Key_Return);
    const QString name = QStringLiteral("my <b>chalk</b>");
    QTRY_COMPARE(favourites.all().at(0).name, name);
    list->item(0)->setText(QStringLiteral("  "));
    QVERIFY(list->item(0)->text() == name && favourites.all()[0].name == name);
    const FavouriteBrush kept = favourites.all()[0];
    const QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("mine.json"));
    hands::answerDialog(path);
    QCOMPARE(list->selectedItems().size(), 1);
    click(*form, "Export all");
    QVERIFY(QFile::exists(path));
    QCOMPARE(said(*form), QStringLiteral("“%1” is in the file %2.").arg(name, QDir::toNativeSeparators(path)));
    click(*form, "Forget");
    QCOMPARE(said(*form), QString());
    QVERIFY(favourites.all().empty() && list->count() == 0);
    click(*form, "Bring back");
    QVERIFY(favourites.all() == std::vector<FavouriteBrush>{kept});
    favourites.forget(kept);
    hands::answerDialog(path);
    click(*form, "Import");
    QVERIFY(favourites.all() == std::vector<FavouriteBrush>{kept});
    QVERIFY2(said(*form).contains(QStringLiteral("from the file")), qPrintable(said(*form)));
    QCOMPARE(favourites.importFrom(path), QString());  // the same one again
    QCOMPARE(favourites.all().size(), size_t{1});
    QVERIFY(favourites.importFrom(kSample).contains(QStringLiteral("holds no brushes")));
    anotherIsCalledOtherwise(kept);
    form->close();
    whatIsChosenIsExported(folder.filePath(QStringLiteral("one.json")), name);
    preferences::setFavouriteBrushes({});
  }

  /// The pointer is elsewhere by the time that the menu of favourites closes.
  void theStarGoesOutWithItsMenu() {
    take("sphere");
    QMenu* menu = m_window->favourites().menu();
    const auto buttons = m_window->findChildren<QToolButton*>();
    const auto star =
        std::find_if(buttons.begin(), buttons.end(), [&](const QToolButton* one) { return one->menu() == menu; });
    QVERIFY(star != buttons.end());
    QTest::mouseMove(view(), view()->rect().center());
    (*star)->setAttribute(Qt::WA_UnderMouse, true);
    (*star)->setDown(true);
    menu->popup((*star)->mapToGlobal(QPoint(0, (*star)->height())));
    menu->close();
    QTRY_VERIFY(!(*star)->underMouse() && !(*star)->isDown());
  }

  /// Commands of rows that Ctrl+K has are for those of the brush, too; what these are not asked for is refused.
  void rowsOfTheBrushTakeCommands() {
    m_window->inspectorDock()->showPage(QStringLiteral("Brush"));
    const int steps = document().undoStack().index();
    const double before = m_window->tools().brush().temperature;
    BrushSettings brush = m_window->tools().brush();
    brush.temperature = before + 100;
    m_window->tools().setBrush(brush);
    auto* panel = m_window->findChild<BrushPanel*>();
    QVERIFY(panel && panel->reveal(QStringLiteral("temperature")));
    ParameterRow* row = panel->row(QStringLiteral("temperature"));
    const auto ask = [&](const char* command) {
      for (const int x : {20, 24}) QTest::mouseMove(row, QPoint(x, 12));
      QTRY_VERIFY(row->isHovered());
      m_window->action(QStringLiteral("edit.row.") + QLatin1String(command))->trigger();
    };
    ask("plot");
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("no value of the scene")));
    ask("reset");
    QCOMPARE(m_window->tools().brush().temperature, BrushSettings{}.temperature);
    brush.temperature = before;
    m_window->tools().setBrush(brush);
    QCOMPARE(document().undoStack().index(), steps);
  }

  /// Brackets with Shift, as keyboards send them; brushes without a flow stay as they are, and say so.
  void bracketsWithShiftChangeTheFlow() {
    Toolbox& tools = m_window->tools();
    const BrushSettings before = tools.brush();
    BrushSettings brush = before;
    brush.shape = "spray";
    tools.setBrush(brush);
    const auto flow = [&] { return tools.brush().parameters.at("spray").values.at("flow"); };
    view()->setFocus();
    QTest::keyClick(view(), Qt::Key_BraceRight, Qt::ShiftModifier);
    const double more = std::get<double>(flow());
    QTest::keyClick(view(), Qt::Key_BracketLeft, Qt::ShiftModifier);
    QTest::keyClick(view(), Qt::Key_BraceLeft, Qt::ShiftModifier);
    QVERIFY(std::get<double>(flow()) < more);
    for (int k = 0; k < 60; ++k) QTest::keyClick(view(), Qt::Key_BraceRight, Qt::ShiftModifier);
    QCOMPARE(std::get<double>(flow()), 1.0);
    QCOMPARE(tools.brush().radius, before.radius);
    brush.shape = "cube";
    tools.setBrush(brush);
    QSignalSpy refused(&tools, &Toolbox::refused);
    QTest::keyClick(view(), Qt::Key_BraceRight, Qt::ShiftModifier);
    QVERIFY(tools.brush() == brush);
    QCOMPARE(refused.count(), 1);
    tools.setBrush(before);
  }

  void theOtherEndOfAPenErases() {
    const size_t before = idsNow(session()).size();
    pen(QPointingDevice::PointerType::Eraser, 0.7);
    stroke(view()->rect().center() - QPoint(40, 0), {80, 0}, true);
    QTRY_VERIFY_WITH_TIMEOUT(idsNow(session()).size() < before, kLong);
    document().undoStack().undo();
    QCOMPARE(idsNow(session()).size(), before);
    // The mouse that is taken up afterwards draws, with full pressure.
    pen(QPointingDevice::PointerType::Eraser, 0);
    QTest::qWait(300);
    stroke(view()->rect().center() - QPoint(40, 0), {80, 0}, true);
    QTRY_VERIFY_WITH_TIMEOUT(idsNow(session()).size() > before, kLong);
    const Body& body = document().project().bodies.back();
    const auto& strokes = std::get<VoxelShape>(body.shape).strokes;
    QCOMPARE(strokes.back().samples.front()[3], 1.0);
  }

  /// How a pen leans on the view, and how its barrel is turned, is in the stroke, and turns a cube; so is how hard it
  /// presses, at each place.
  void tiltAndRotationReachTheStroke() {
    using Capability = QInputDevice::Capability;
    const auto all = Capability::Pressure | Capability::XTilt | Capability::YTilt | Capability::Rotation;
    take("cube");
    const auto upright = penStroke(all, {0.5, 0, 0, 0});
    QVERIFY(turnOf(upright).isZero(0));
    QCOMPARE(upright.samples.front()[3], 0.5);
    document().undoStack().undo();
    const auto rolled = penStroke(all, {0.5, 0, 0, 30});
    QVERIFY((turnOf(rolled) + M_PI / 6 * rolled.up.normalized()).norm() < 1e-6);  // clockwise, as one sees it
    document().undoStack().undo();
    const CameraFrame seen = frameOf(view()->navigator().camera());
    const auto leaning = penStroke(all, {0.5, 40, 0, 0});
    QVERIFY((turnOf(leaning) - 40 * M_PI / 180 * seen.up).norm() < 1e-6);
    document().undoStack().undo();
    const auto towards = penStroke(all, {0.5, 0, 40, 0});
    QVERIFY((turnOf(towards) - 40 * M_PI / 180 * seen.right).norm() < 1e-6);
    document().undoStack().undo();
    // The barrel turns the cube, in its cells too.
    const auto cells = [&](double degrees) {
      penStroke(all, {1, 0, 0, degrees});
      const auto runs = std::get<VoxelShape>(document().project().bodies.back().shape).runs;
      document().undoStack().undo();
      return runs;
    };
    QVERIFY(cells(0) == cells(0));
    QVERIFY(cells(0) != cells(45));
  }

  /// A pen that does not tell how hard it presses, or how it leans, is as a mouse in that, whatever its events hold.
  void whatAPenDoesNotTellIsAsWithAMouse() {
    take("cube");
    const auto stroke = penStroke(QInputDevice::Capability::Position, {0, 40, 20, 30});
    QVERIFY(stroke.samples.size() > 2);
    for (const auto& sample : stroke.samples) QCOMPARE(sample[3], 1.0);
    QVERIFY(turnOf(stroke).isZero(0));
    document().undoStack().undo();
  }

  /// Over the view, before it touches, the brush shows where it would draw, and the other end where it would erase.
  void aPenThatHoversShowsTheBrush() {
    take("cube");
    for (const auto end : {QPointingDevice::PointerType::Pen, QPointingDevice::PointerType::Eraser}) {
      const QPointingDevice device(QStringLiteral("pen"), 18, QInputDevice::DeviceType::Stylus, end,
                                   QInputDevice::Capability::Pressure | QInputDevice::Capability::Hover, 1, 1);
      m_window->tools().tool().leave();
      tell(device, QEvent::TabletMove, at(kMiddle), {0, 0, 0, 0});
      QMouseEvent move(QEvent::MouseMove, at(kMiddle), view()->mapToGlobal(at(kMiddle)), Qt::NoButton, Qt::NoButton,
                       Qt::NoModifier);
      QApplication::sendEvent(view(), &move);
      const auto cursor = m_window->tools().tool().picture().cursor;
      QVERIFY(cursor);
      QCOMPARE(cursor->erase, end == QPointingDevice::PointerType::Eraser);
      QCOMPARE(cursor->pressure, 1.0);  // as large as it can be
    }
  }

 private:
  struct PenState {
    double pressure, tiltX, tiltY, rotation;  ///< degrees
  };
  static Vector3 turnOf(const VoxelShape::Stroke& stroke) {
    if (stroke.samples.empty()) return Vector3::Constant(1);  // none that a test expects
    const auto& sample = stroke.samples.back();
    return {sample[5], sample[6], sample[7]};
  }
  /// The view shows what the last undo has left.
  void settle() {
    const size_t there = idsNow(session()).size();
    QTRY_VERIFY_WITH_TIMEOUT(
        session().snapshot()->position.size() == there && view()->snapshot() == session().snapshot(), kLong);
  }
  void take(const char* shape) {
    BrushSettings brush = m_window->tools().brush();
    brush.shape = shape;
    m_window->tools().setBrush(brush);
  }
  void tell(const QPointingDevice& device, QEvent::Type type, const QPointF& place, const PenState& pen) {
    const bool touches = type != QEvent::TabletMove || pen.pressure > 0;
    QTabletEvent event(type, &device, place, view()->mapToGlobal(place), pen.pressure, static_cast<float>(pen.tiltX),
                       static_cast<float>(pen.tiltY), 0, pen.rotation, 0, Qt::NoModifier, Qt::LeftButton,
                       touches ? Qt::LeftButton : Qt::NoButton);
    QApplication::sendEvent(view(), &event);
  }
  /// A pen's stroke, as Qt hands it on: its own event first, then the mouse's. What the document has of it.
  VoxelShape::Stroke penStroke(QInputDevice::Capabilities capabilities, const PenState& pen) {
    const QPointingDevice device(QStringLiteral("pen"), 19, QInputDevice::DeviceType::Stylus,
                                 QPointingDevice::PointerType::Pen, capabilities, 1, 1);
    const QPoint from = at({-40, 0});
    settle();
    const int steps = document().undoStack().index();
    tell(device, QEvent::TabletPress, from, pen);
    QTest::mousePress(view(), Qt::LeftButton, {}, from);
    for (int k = 1; k <= 4; ++k) {
      const QPoint to = from + QPoint(20 * k, 0);
      tell(device, QEvent::TabletMove, to, pen);
      QMouseEvent move(QEvent::MouseMove, to, view()->mapToGlobal(to), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
      QApplication::sendEvent(view(), &move);
    }
    tell(device, QEvent::TabletRelease, from + QPoint(80, 0), pen);
    QTest::mouseRelease(view(), Qt::LeftButton, {}, from + QPoint(80, 0));
    if (!QTest::qWaitFor([&] { return document().undoStack().index() > steps; }, kLong)) return {};
    const auto* voxels = std::get_if<VoxelShape>(&document().project().bodies.back().shape);
    return voxels && !voxels->strokes.empty() ? voxels->strokes.back() : VoxelShape::Stroke{};
  }
  static void click(const QDialog& form, const char* text) {
    const QList<QPushButton*> all = form.findChildren<QPushButton*>();
    const auto found = std::find_if(all.begin(), all.end(), [&](const QPushButton* one) {
      return one->text().startsWith(QString::fromUtf8(text));
    });
    QVERIFY2(found != all.end() && (*found)->isEnabled(), text);
    (*found)->click();
  }
  /// By a form, of what it has done.
  static QString said(const QDialog& form) {
    const auto* label = form.findChild<QLabel*>(QStringLiteral("psDone"));
    return label->isVisible() ? label->text() : QString();
  }
  /// Another brush of the same name comes under a name of its own, which nobody else may have.
  void anotherIsCalledOtherwise(const FavouriteBrush& kept) {
    FavouriteBrushes& favourites = m_window->favourites();
    BrushSettings brush = kept.brush;
    brush.radius *= 2;
    favourites.restore({kept.name, brush});
    QCOMPARE(favourites.all().at(1).name, kept.name + QStringLiteral(" (2)"));
    QVERIFY(!favourites.rename(favourites.all()[1], kept.name).isEmpty());
    QCOMPARE(favourites.rename(favourites.all()[1], QStringLiteral("wide")), QString());
    QCOMPARE(favourites.all()[1].name, QStringLiteral("wide"));
  }
  /// One of two, as the form begins, and its button counts it.
  void whatIsChosenIsExported(const QString& path, const QString& name) {
    m_window->action(QStringLiteral("sketch.brushes"))->trigger();
    QDialog* form = m_window->findChildren<QDialog*>(QStringLiteral("psBrushes")).back();
    const auto* list = form->findChild<QListWidget*>();
    QVERIFY(list->count() == 2 && list->item(0)->isSelected() && !list->item(1)->isSelected());
    hands::answerDialog(path);
    click(*form, "Export 1");
    QVERIFY2(said(*form).startsWith(QStringLiteral("“%1” is in").arg(name)), qPrintable(said(*form)));
    form->close();
  }
  static constexpr QPoint kMiddle{0, 0};  // of the view
  QPoint at(const QPoint& from) { return view()->rect().center() + from; }
  void press(Qt::MouseButton button, Qt::KeyboardModifiers keys, const QPoint& from) {
    QTest::mousePress(view(), button, keys, at(from));
  }
  void move(const QPoint& to, Qt::MouseButton button, Qt::KeyboardModifiers keys) {
    QMouseEvent event(QEvent::MouseMove, at(to), view()->mapToGlobal(at(to)), Qt::NoButton, button, keys);
    QApplication::sendEvent(view(), &event);
  }
  void release(Qt::MouseButton button, Qt::KeyboardModifiers keys) {
    QTest::mouseRelease(view(), button, keys, at(kMiddle));
  }
  /// What a pen says before the mouse's event that Qt makes of it.
  void pen(QPointingDevice::PointerType end, double pressure) {
    static const QPointingDevice eraser(QStringLiteral("eraser"), 17, QInputDevice::DeviceType::Stylus, end,
                                        QInputDevice::Capability::Pressure, 1, 1);
    const bool presses = pressure > 0;
    QTabletEvent event(presses ? QEvent::TabletPress : QEvent::TabletMove, &eraser, at(kMiddle),
                       view()->mapToGlobal(at(kMiddle)), pressure, 0, 0, 0, 0, 0, Qt::NoModifier,
                       presses ? Qt::LeftButton : Qt::NoButton, presses ? Qt::LeftButton : Qt::NoButton);
    QApplication::sendEvent(view(), &event);
  }
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestBrushWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_brushwindow.moc"
