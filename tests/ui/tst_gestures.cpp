// SPDX-License-Identifier: Apache-2.0
// Gestures in the real window: of rows, outliner, view, timeline, curves and graphs. What edits the document is one
// step, taken back and done again by the keys to the same bytes; what does not edit leaves the document and its steps
// alone. No kind of edit is left out.
#include "core/io/projectio.h"
#include "tests/ui/curvewindow.h"
#include "tests/ui/gizmohands.h"
#include "tests/ui/hands.h"
#include "tests/ui/recordhands.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outlinerdelegate.h"
#include "ui/rows/parameterpanel.h"
#include "ui/rows/parameterrow.h"
#include "ui/session/carriedmaterial.h"
#include "ui/session/wording.h"
#include "ui/timeline/keyrows.h"
#include "ui/timeline/markerrow.h"
#include "ui/timeline/runlines.h"
#include "ui/window/libraryactions.h"
#include "ui/window/projectwindow.h"

#include <QtCore/QFile>
#include <QtCore/QRegularExpression>
#include <QtCore/QTemporaryDir>
#include <QtCore/QXmlStreamReader>
#include <QtGui/QImage>
#include <QtWidgets/QToolButton>

#include <cmath>
#include <set>
#include <typeinfo>
#include <utility>

using namespace ps;

namespace {

constexpr uint64_t kFrames = 12;
const Address kFloor{Owner::Wall, "floor", "temperature"};

}  // namespace

class TestGestures : public CurveWindowTest {
  Q_OBJECT
  /// What a hand does, and what is there before it.
  struct Gesture {
    const char* name;
    void (TestGestures::*before)();
    void (TestGestures::*act)();
  };
  static std::vector<Gesture> edits();
  static std::vector<Gesture> others();

 private Q_SLOTS:
  void initTestCase() {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    openTune();
    QVERIFY(m_folder.isValid());
  }
  void init() {
    backToTheStart();
    document().undoStack().clear();
    m_window->showWorkspace(MainWindow::kSceneTab);
    m_window->activateWindow();
  }
  void cleanupTestCase() { m_window.reset(); }

  void anEditIsOneStepThereAndBack_data() { rows(edits()); }
  void anEditIsOneStepThereAndBack() {
    QFETCH(int, number);
    m_rows.insert(number);
    const Gesture gesture = edits()[static_cast<size_t>(number)];
    if (gesture.before) (this->*gesture.before)();
    if (QTest::currentTestFailed()) return;
    const std::string before = text();
    const int steps = document().undoStack().index();
    (this->*gesture.act)();
    if (QTest::currentTestFailed()) return;
    const std::string after = text();
    QVERIFY(after != before);
    QCOMPARE(document().undoStack().index(), steps + 1);
    note(*document().undoStack().command(steps));
    for (int time = 0; time < 2; ++time) {
      undo();
      QCOMPARE(text(), before);
      QCOMPARE(document().undoStack().index(), steps);
      redo();
      QCOMPARE(text(), after);
    }
    picture(QStringLiteral("tst_gestures_%1.png").arg(QLatin1String(gesture.name)));
  }

  /// Those that ui/document declares were all met in the rows above. Only some of these say nothing about it.
  void everyKindOfEditHasItsGesture() {
    if (m_rows.size() < edits().size()) return;
    QFile file(QStringLiteral(PS_SOURCE_DIR "/ui/document/commands.h"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QString header = QString::fromUtf8(file.readAll());
    static const QRegularExpression kKind(QStringLiteral("class (\\w+Command) : public"));
    int kinds = 0;
    QStringList missing;
    for (auto found = kKind.globalMatch(header); found.hasNext(); ++kinds) {
      const QString kind = found.next().captured(1);
      const auto is = [&](const std::string& met) { return met.ends_with(kind.toStdString() + "E"); };  // ps::kind
      if (std::none_of(m_met.begin(), m_met.end(), is)) missing << kind;
    }
    QVERIFY(kinds > 10);
    QVERIFY2(missing.isEmpty(), qPrintable(missing.join(QStringLiteral(", "))));
  }

  /// What was edited before it can be taken back and done again after it, which rewinds no time.
  void whatIsNoEditLeavesTheDocumentAlone_data() { rows(others()); }
  void whatIsNoEditLeavesTheDocumentAlone() {
    QFETCH(int, number);
    const Gesture gesture = others()[static_cast<size_t>(number)];
    const std::string start = text();
    QCOMPARE(document().setParameter(kFloor, 450.0), QString());
    const std::string edited = text();
    for (uint64_t frame = 1; frame <= kFrames; ++frame) hands::stepKept(session());
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), kFrames, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(graph().sampleCount(0), static_cast<size_t>(kFrames + 1), kLong);
    transport().setDuration(0.4);  // a frame is then some fifty pixels wide
    if (gesture.before) (this->*gesture.before)();
    if (QTest::currentTestFailed()) return;
    (this->*gesture.act)();
    if (QTest::currentTestFailed()) return;
    QCOMPARE(text(), edited);
    QCOMPARE(document().undoStack().count(), 1);
    const uint64_t newest = session().newest()->stats.frame;
    const size_t runs = session().recorded().earlier().size();
    undo();
    QCOMPARE(text(), start);
    redo();
    QCOMPARE(text(), edited);
    hands::hashNow(session());  // the engine has done what was asked of it
    QCOMPARE(session().newest()->stats.frame, newest);
    QCOMPARE(session().recorded().earlier().size(), runs);
    picture(QStringLiteral("tst_gestures_%1.png").arg(QLatin1String(gesture.name)));
  }

 private:
  static void rows(const std::vector<Gesture>& gestures) {
    QTest::addColumn<int>("number");
    for (size_t k = 0; k < gestures.size(); ++k) QTest::newRow(gestures[k].name) << static_cast<int>(k);
  }
  std::string text() { return writeProject(document().project()); }
  void undo() { QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier); }
  void redo() { QTest::keyClick(m_window.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier); }
  uint64_t shownFrame() { return session().snapshot()->stats.frame; }
  Transport& transport() { return *m_window->transport(); }
  /// Of what kind it is, or what it is put together from.
  void note(const QUndoCommand& command) {
    m_met.insert(typeid(command).name());
    for (int k = 0; k < command.childCount(); ++k) note(*command.child(k));
  }

  // Rows.
  void dragARow() {
    ParameterRow* row = floorRow();
    QVERIFY(row);
    hands::pull(*row, row->sliderRect().center(), {30, 0});
  }
  void unpinARow() {
    ParameterRow* row = floorRow();
    QVERIFY(row);
    hands::chooseAt(*row, row->labelRect().center(), {QStringLiteral("Remove from “Try these”")});
  }
  void nameTheProject() {
    openProjectProperties(*m_window, QStringLiteral("Title"));
    auto* dialog = m_window->findChild<QDialog*>(QStringLiteral("psProject"));
    auto* title = dialog ? dialog->findChild<QLineEdit*>() : nullptr;
    QVERIFY(title);
    title->setText(QStringLiteral("Puddle"));
    dialog->close();
    m_window->activateWindow();
  }

  // Outliner.
  QTreeView& tree() { return *m_window->outliner()->findChild<QTreeView*>(); }
  void selectTheIce() { m_window->selection().selectBody("ice"); }
  void trigger(const char* action) { m_window->action(QString::fromLatin1(action))->trigger(); }
  void clickInItsRow(QRect (*part)(const QRect&)) {
    const QRect row = tree().visualRect(hands::outlined(*m_window, OutlineKind::Body, "ice"));
    QTest::mouseClick(tree().viewport(), Qt::LeftButton, {}, part(row).center());
  }
  void hideTheIce() { clickInItsRow(OutlinerDelegate::eyeRect); }
  void lockTheIce() { clickInItsRow(OutlinerDelegate::lockRect); }
  void renameTheIce() {
    trigger("edit.rename");
    auto* name = tree().viewport()->findChild<QLineEdit*>();
    QVERIFY(name);
    name->setText(QStringLiteral("Berg"));
    QTest::keyClick(name, Qt::Key_Return);
    QTRY_VERIFY(!tree().viewport()->findChild<QLineEdit*>());
    QTRY_VERIFY(text().find("Berg") != std::string::npos);  // the field closes first
  }
  void groupTheIce() { trigger("edit.group"); }
  void deleteIt() { trigger("edit.delete"); }
  void duplicateTheIce() { trigger("edit.duplicate"); }
  void addAProbe() { trigger("edit.probe"); }
  void selectTheLid() { m_window->selection().select(OutlineKind::Wall, "lid"); }
  void loseTheLid() {
    selectTheLid();
    deleteIt();
    QVERIFY(!document().wall("lid"));
  }
  void addTheLid() { trigger("sketch.wall.lid"); }
  void addAMaterial() {
    LibraryPage& page = *m_window->library().page();
    QTRY_VERIFY_WITH_TIMEOUT(page.shown().contains(QStringLiteral("Iron")), kLong);
    page.choose(QStringLiteral("Iron"));
    const auto buttons = page.findChildren<QPushButton*>();
    const auto add = std::find_if(buttons.begin(), buttons.end(), [](const QPushButton* button) {
      return button->text() == QStringLiteral("Add to the scene");
    });
    QVERIFY(add != buttons.end());
    (*add)->click();
  }
  void keepTheState() {
    QSignalSpy kept(&session(), &Session::stateKept);
    session().keepState();
    QVERIFY(kept.wait(kLong));
  }
  void removeTheState() { trigger("file.removeState"); }

  // View.
  void dropMatter() {
    QMimeData iron;
    iron.setData(QLatin1String(kInstalledMime), "iron");
    QVERIFY(hands::drop(*view(), iron));
  }
  void draw(const char* with) {
    trigger(with);
    QTRY_VERIFY_WITH_TIMEOUT(view()->isVisible() && view()->snapshot() == session().snapshot(), kLong);
    stroke(view()->rect().center() - QPoint(30, 0), {60, 0}, true);
    QTRY_VERIFY_WITH_TIMEOUT(document().undoStack().canUndo(), kLong);
  }
  void drawMatter() { draw("sketch.brush"); }
  void eraseMatter() { draw("sketch.erase"); }
  /// Two lumps of ice, apart, in the air.
  void sketchTwoLumps() {
    Body lumps;
    lumps.id = lumps.name = "lumps";
    lumps.material = document().project().materials[0].id;
    lumps.parameters.values["temperature"] = 260.0;
    lumps.parameters.values["held"] = true;
    lumps.constraints.push_back({"bonds", {}, {}});
    VoxelShape shape;
    shape.spacing = m_window->tools().spacing();
    shape.origin = {0, 0.6, 0};
    shape.palette.push_back({lumps.material, 260, {}});
    for (int row = 0; row < 9; ++row)
      for (const int x : {0, 8}) shape.runs.push_back({x, row % 3, row / 3, 3, 0});
    lumps.shape = std::move(shape);
    document().addBody(lumps);
    m_window->selection().selectBody("lumps");
  }
  void separateThem() {
    // With what goes along with its body it is one step, whose parts the history keeps to itself: what it does tells
    // it.
    bool parted = false;
    QObject watching;
    connect(&document(), &Document::changed, &watching,
            [&](const ChangeEvent& event) { parted = parted || std::holds_alternative<BodyParted>(event); });
    const size_t before = document().project().bodies.size();
    trigger("sketch.separate");
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), before + 1, kLong);
    if (parted) m_met.insert("PartingCommandE");
  }
  void takeTheHandles() {
    selectTheIce();
    m_window->tools().activate("move");
    view()->setFocus();
  }
  void moveByAHandle() {
    const QPoint from = hands::middleOf(*m_window, {GizmoPart::Kind::Arm, 0});
    hands::pull(*view(), from, {40, 0});
  }
  void placeATap() {
    trigger("sketch.tap");
    QTest::mouseClick(view(), Qt::LeftButton, {}, view()->rect().center());
    QCOMPARE(document().project().emitters.size(), size_t{1});
  }

  // Keys.
  KeyRows& keyRows() { return *m_window->findChild<KeyRows*>(); }
  const std::vector<TrackKey>& keys() { return document().track(kFloor)->keys; }
  ParameterRow* floorRow() {
    if (!m_window->revealParameter(kFloor, false)) return nullptr;
    return m_window->inspector().scenePanel()->row(QString::fromStdString(kFloor.text()));
  }
  void twoKeys() {
    QCOMPARE(document().putKey(kFloor, 10, 400), QString());
    QCOMPARE(document().putKey(kFloor, 20, 300), QString());
    QTRY_VERIFY(keyRows().isVisible() && keyRows().width() > 400);
  }
  void keyByK() {
    ParameterRow* row = floorRow();
    QVERIFY(row);
    for (const int x : {20, 24}) QTest::mouseMove(row, QPoint(x, 12));
    QTRY_VERIFY(row->isHovered());
    QTest::keyClick(m_window.get(), Qt::Key_K);
    QCOMPARE(keys().size(), size_t{1});
  }
  void keyByDiamond() {
    ParameterRow* row = floorRow();
    QVERIFY(row);
    QTest::mouseClick(row, Qt::LeftButton, {}, row->keyRect().center());
    QCOMPARE(keys().size(), size_t{1});
  }
  void dragAKey() {
    hands::pull(keyRows(), keyRows().placeOf(kFloor, 1), {60, 0});
    QVERIFY(keys()[1].time > 21 && keys()[0].time == 10);
  }
  void deleteAKey() {
    QTest::mouseClick(&keyRows(), Qt::LeftButton, {}, keyRows().placeOf(kFloor, 0));
    keyRows().setFocus();
    QTest::keyClick(&keyRows(), Qt::Key_Delete);
    QCOMPARE(keys().size(), size_t{1});
  }

  // Curves.
  void tune() {
    m_window->showWorkspace(MainWindow::kTuneTab);
    curves().choose(kViscosity);
    QTRY_VERIFY(curve().width() > 300);
    curve().fit();
  }
  void pointsToTune() {
    tune();
    threePoints();
  }
  void addAPoint() {
    QTest::mouseDClick(&curve(), Qt::LeftButton, {}, curve().at(330, response().at(330)).toPoint());
    QCOMPARE(response().points.size(), size_t{4});
  }
  void dragAPoint() {
    drag(1, {20, -30});
    QVERIFY(response().points[1].x > 310 && response().points[1].y > 0.001);
  }
  void deleteAPoint() {
    QTest::mouseClick(&curve(), Qt::LeftButton, {}, place(1));
    curve().setFocus();
    QTest::keyClick(&curve(), Qt::Key_Delete);
    QCOMPARE(response().points.size(), size_t{2});
  }
  void turnAHandle() {
    QTest::mouseClick(&curve(), Qt::LeftButton, {}, place(1));
    QVERIFY(curve().handleAt(true).has_value());
    pull(curve().handleAt(true)->toPoint(), {0, 20}, {});
    QVERIFY(response().points[1].slopeAfter.has_value());
  }
  void press(const QString& words) {
    for (QPushButton* button : pages().findChildren<QPushButton*>()) {
      if (button->text() != words) continue;
      QVERIFY(button->isEnabled() && button->isVisible());
      QTest::mouseClick(button, Qt::LeftButton);
      return;
    }
    QFAIL(qPrintable(words));
  }
  void fitALaw() {
    press(QStringLiteral("Fit law to points"));
    QVERIFY(response().kind == Response::Kind::Law);
  }
  void sampleTheLaw() {
    const Response law = response();
    QVERIFY(law.kind == Response::Kind::Law);
    press(QStringLiteral("Sample law as points"));
    QVERIFY(response().kind == Response::Kind::Curve && response().points.size() > 3);
    const double kelvin = response().points[2].x;
    QVERIFY(std::abs(response().at(kelvin) / law.at(kelvin) - 1) < 1e-9);
  }

  // Graphs.
  GraphView& graph() { return *m_window->graphs()->valuesIn("K"); }
  void dropAProbe() {
    const QModelIndex row = hands::outlined(*m_window, OutlineKind::Probe, "ice_mass");
    QVERIFY(row.isValid() && (row.flags() & Qt::ItemIsDragEnabled));
    const int lines = graph().seriesCount();
    QVERIFY(hands::drop(graph(), *hands::dragged(row)));
    QCOMPARE(graph().seriesCount(), lines + 1);
  }
  void setCursors() {
    graph().setFocus();
    QTRY_VERIFY(graph().hasFocus());
    const QRectF plot = graph().plotRect();
    const auto at = [&](double share) { return (plot.topLeft() + QPointF(share * plot.width(), 30)).toPoint(); };
    for (const auto& [share, key] : {std::pair(0.02, Qt::Key_1), std::pair(0.1, Qt::Key_2)}) {
      QTest::mouseMove(&graph(), at(share));
      QTest::keyClick(&graph(), key);
    }
    QVERIFY(graph().reading(0) && graph().reading(1));
    const double apart = *graph().reading(1) - *graph().reading(0);
    const auto [first, last] = graph().range();
    QVERIFY(std::abs(apart - 0.08 * (last - first)) < 2 * (last - first) / plot.width());
    QVERIFY(!graph().measured().empty());
    QTest::keyClick(&graph(), Qt::Key_Escape);
    QVERIFY(!graph().reading(0) && !graph().reading(1));
  }
  QByteArray exported(const char* ending) {
    const QString path = m_folder.filePath(QStringLiteral("graph.") + QLatin1String(ending));
    hands::chooseAt(graph(), graph().rect().center(),
                    {QStringLiteral("Export as %1…").arg(QString::fromLatin1(ending).toUpper())},
                    [path] { hands::answerDialog(path); });
    QFile file(path);
    [&] { QTRY_VERIFY_WITH_TIMEOUT(file.exists() && file.size() > 0, kLong); }();
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }
  void exportPng() {
    const QImage image = QImage::fromData(exported("png"), "PNG");
    QVERIFY(image.width() > 100 && image.height() > 50);
    std::set<QRgb> colours;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) colours.insert(image.pixel(x, y));
    }
    QVERIFY(colours.size() > 3);  // ground, axes, curves
  }
  void exportSvg() {
    QXmlStreamReader reader(exported("svg"));
    int lines = 0;
    while (!reader.atEnd()) {
      if (reader.readNext() == QXmlStreamReader::StartElement &&
          (reader.name() == QStringLiteral("polyline") || reader.name() == QStringLiteral("path")))
        ++lines;
    }
    QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
    QVERIFY(lines >= graph().seriesCount());
  }
  void exportCsv() {
    const QList<QByteArray> lines = exported("csv").trimmed().split('\n');
    QCOMPARE(lines.size(), qsizetype{kFrames + 2});
    for (qsizetype k = 1; k < lines.size(); ++k) {
      const QList<QByteArray> cells = lines[k].trimmed().split(',');
      QCOMPARE(cells.size(), lines[0].split(',').size());
      for (const QByteArray& cell : cells) {
        bool number = false;
        cell.toDouble(&number);
        QVERIFY2(number, cell.constData());
      }
      QVERIFY(std::abs(cells[0].toDouble() - static_cast<double>(k - 1) / 60) < 1e-6);
    }
  }

  // Markers.
  MarkerRow& markers() { return *m_window->findChild<MarkerRow*>(); }
  const std::vector<Marker>& marked() { return document().project().markers; }
  void aMarker() {
    QCOMPARE(document().addMarker(20), size_t{0});
    QTRY_VERIFY(markers().isVisible() && markers().width() > 400);
  }
  void addAMarker() {
    QTest::keyClick(m_window.get(), Qt::Key_M, Qt::ShiftModifier);
    QCOMPARE(marked().size(), size_t{1});
  }
  void addAMarkerInTheRow() {
    QTest::mouseDClick(&markers(), Qt::LeftButton, {}, markers().placeOf(0) + QPoint(-120, 0));
    QCOMPARE(marked().size(), size_t{2});
  }
  void dragAMarker() {
    hands::pull(markers(), markers().placeOf(0), {60, 0});
    QVERIFY(marked()[0].time > 21);
  }
  void renameAMarker() {
    QTest::mouseDClick(&markers(), Qt::LeftButton, {}, markers().placeOf(0));
    auto* line = markers().findChild<QLineEdit*>();
    QVERIFY(line);
    QTest::keyClicks(line, QStringLiteral("half gone"));
    QTest::keyClick(line, Qt::Key_Return);
    QCOMPARE(marked()[0].name, std::string("half gone"));
    QTRY_VERIFY_WITH_TIMEOUT(!markers().findChild<QLineEdit*>(), kLong);
  }
  void deleteAMarker() {
    QTest::mouseClick(&markers(), Qt::LeftButton, {}, markers().placeOf(0));
    markers().setFocus();
    QTest::keyClick(&markers(), Qt::Key_Delete);
    QVERIFY(marked().empty());
  }

  // Runs.
  void scrub() {
    hands::scrubTo(transport(), 4);
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{4}, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().snapshot(), kLong);
    QVERIFY(session().recorded().isActive());
    QTRY_COMPARE_WITH_TIMEOUT(transport().timeText(), clockText(4.0 / 60), kLong);
    QCOMPARE(session().newest()->stats.frame, kFrames);
  }
  void branch() {
    hands::branchAt(*m_window, 5, kFrames);
    QCOMPARE(session().recorded().earlier().front().apart, 5.0 / 60);
    QVERIFY(session().newest()->stats.frame >= kFrames);
  }
  void showAndHideAGhost() {
    hands::scrubTo(transport(), 8);  // that both runs have
    QTRY_COMPARE_WITH_TIMEOUT(shownFrame(), uint64_t{8}, kLong);
    RunLines& lines = *transport().runs();
    const auto toggle = [&] { hands::chooseAt(lines, lines.rowOf(1).center(), {QStringLiteral("Show as a ghost")}); };
    toggle();
    QVERIFY(session().recorded().hasGhost());
    QTRY_VERIFY_WITH_TIMEOUT(session().recorded().ghost() != nullptr, kLong);
    QCOMPARE(session().recorded().ghost()->stats.frame, uint64_t{8});
    toggle();
    QVERIFY(!session().recorded().hasGhost() && !session().recorded().ghost());
  }
  void deleteARun() {
    RunLines& lines = *transport().runs();
    hands::chooseAt(lines, lines.rowOf(1).center(), {QStringLiteral("Delete")});
    QVERIFY(session().recorded().earlier().empty());
    QTRY_VERIFY_WITH_TIMEOUT(!lines.isVisible(), kLong);
  }
  void loop() {
    QTest::mouseClick(transport().loopButton(), Qt::LeftButton);
    QVERIFY(session().recorded().loops());
    int begun = 0;
    uint64_t last = kFrames;
    const QObject here;
    connect(&session().recorded(), &RecordedView::changed, &here, [&] {
      if (shownFrame() < last) ++begun;
      last = shownFrame();
    });
    QTest::keyClick(m_window.get(), Qt::Key_Space);
    QTRY_VERIFY_WITH_TIMEOUT(begun > 2, kLong);
    QCOMPARE(session().newest()->stats.frame, kFrames);
    QTest::keyClick(m_window.get(), Qt::Key_Space);
    QVERIFY(!session().playing());
    QTest::mouseClick(transport().loopButton(), Qt::LeftButton);
    QVERIFY(!session().recorded().loops());
  }

  QTemporaryDir m_folder;
  std::set<int> m_rows;         ///< of edits() that were begun
  std::set<std::string> m_met;  ///< kinds of edits
};

std::vector<TestGestures::Gesture> TestGestures::edits() {
  using T = TestGestures;
  return {{"row dragged", nullptr, &T::dragARow},
          {"row unpinned", nullptr, &T::unpinARow},
          {"project named", nullptr, &T::nameTheProject},
          {"eye", nullptr, &T::hideTheIce},
          {"lock", nullptr, &T::lockTheIce},
          {"body renamed", &T::selectTheIce, &T::renameTheIce},
          {"body grouped", &T::selectTheIce, &T::groupTheIce},
          {"body deleted", &T::selectTheIce, &T::deleteIt},
          {"body duplicated", &T::selectTheIce, &T::duplicateTheIce},
          {"probe added", nullptr, &T::addAProbe},
          {"wall added", &T::loseTheLid, &T::addTheLid},
          {"wall deleted", &T::selectTheLid, &T::deleteIt},
          {"material added", nullptr, &T::addAMaterial},
          {"state removed", &T::keepTheState, &T::removeTheState},
          {"material dropped", nullptr, &T::dropMatter},
          {"stroke", nullptr, &T::drawMatter},
          {"stroke erased", nullptr, &T::eraseMatter},
          {"pieces separated", &T::sketchTwoLumps, &T::separateThem},
          {"handle dragged", &T::takeTheHandles, &T::moveByAHandle},
          {"tap placed", nullptr, &T::placeATap},
          {"key by K", nullptr, &T::keyByK},
          {"key by its diamond", nullptr, &T::keyByDiamond},
          {"key dragged", &T::twoKeys, &T::dragAKey},
          {"key deleted", &T::twoKeys, &T::deleteAKey},
          {"point added", &T::pointsToTune, &T::addAPoint},
          {"point dragged", &T::pointsToTune, &T::dragAPoint},
          {"point deleted", &T::pointsToTune, &T::deleteAPoint},
          {"handle turned", &T::pointsToTune, &T::turnAHandle},
          {"law fitted", &T::pointsToTune, &T::fitALaw},
          {"law sampled", &T::tune, &T::sampleTheLaw},
          {"probe dropped", nullptr, &T::dropAProbe},
          {"marker added", nullptr, &T::addAMarker},
          {"marker added in its row", &T::aMarker, &T::addAMarkerInTheRow},
          {"marker dragged", &T::aMarker, &T::dragAMarker},
          {"marker renamed", &T::aMarker, &T::renameAMarker},
          {"marker deleted", &T::aMarker, &T::deleteAMarker}};
}

std::vector<TestGestures::Gesture> TestGestures::others() {
  using T = TestGestures;
  return {{"scrub", nullptr, &T::scrub},
          {"branch", nullptr, &T::branch},
          {"ghost", &T::branch, &T::showAndHideAGhost},
          {"run deleted", &T::branch, &T::deleteARun},
          {"loop", nullptr, &T::loop},
          {"cursors", nullptr, &T::setCursors},
          {"export png", nullptr, &T::exportPng},
          {"export svg", nullptr, &T::exportSvg},
          {"export csv", nullptr, &T::exportCsv}};
}

QTEST_MAIN(TestGestures)
#include "tst_gestures.moc"
