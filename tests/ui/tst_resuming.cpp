// SPDX-License-Identifier: Apache-2.0
// A window that is closed and opened again shows what it showed: selection, run, moment, and whether it goes on; the
// workspace with its docks and their pages, graphs, legend, tool and brush, and what is folded.
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/scene/group.h"
#include "samplewindow.h"
#include "tests/shared/scenes.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/plot.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/recordedview.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/selection.h"
#include "ui/tools/favouritebrush.h"
#include "ui/window/dock.h"

#include <QtCore/QDir>
#include <QtCore/QSettings>
#include <QtCore/QTemporaryDir>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QTreeView>

using namespace ps;

namespace {

constexpr uint64_t kLeft = 24;  // frames

uint64_t frameOf(Session& session) {
  return onEngine<uint64_t>(session, [](Engine& engine) { return engine.solver().frame(); });
}

uint64_t hashAfter(Session& session, uint64_t frames) {
  return onEngine<uint64_t>(session, [frames](Engine& engine) {
    for (uint64_t frame = 0; frame < frames; ++frame) engine.step();
    return engine.stateHash();
  });
}

}  // namespace

class TestResuming : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    QSettings().clear();
    preferences::setWelcomeAtStart(false);
    preferences::setTourDone();
    m_directory = std::make_unique<QTemporaryDir>();
    m_path = m_directory->filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(4, 370), m_path.toStdString());
    open(m_path);
    session().pause();
    toTheStart();
  }
  void cleanup() { m_window.reset(); }
  void cleanupTestCase() { QSettings().clear(); }

  void aPausedRunStandsWhereItWasLeft() {
    run(kLeft);
    const uint64_t expected = hashAfter(session(), 0);
    session().engine()->recording().settle();
    const RunRecord::Extent before = session().recorded().extent();
    reopen();
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, kLeft, kLong);
    QVERIFY(!session().playing());
    QVERIFY(!document().isDirty());
    QCOMPARE(hashAfter(session(), 0), expected);
    session().engine()->recording().settle();
    const RunRecord::Extent now = session().recorded().extent();
    QCOMPARE(now.first, before.first);
    QCOMPARE(now.last, before.last);
    QCOMPARE(now.frames, before.frames);
    QTRY_COMPARE_WITH_TIMEOUT(QDir(copies()).entryList({QStringLiteral("*.psrec")}), QStringList(), kLong);
    QCOMPARE(session().recorded().earlier().size(), size_t{0});
  }

  /// Unsaved work too, which the run has gone through.
  void anEditedRunStandsWhereItWasLeft() {
    run(kLeft / 2);
    QCOMPARE(document().setParameter({Owner::Wall, "floor", "temperature"}, 420.0), QString());
    run(kLeft / 2);
    const uint64_t expected = hashAfter(session(), 0);
    reopen();
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, kLeft, kLong);
    QVERIFY(document().isDirty());
    QCOMPARE(hashAfter(session(), 0), expected);
  }

  /// Closed again at once, most often before it has been read.
  void aRunOutlastsAWindowThatIsHardlyOpen() {
    run(kLeft);
    const uint64_t expected = hashAfter(session(), 0);
    for (int k = 0; k < 3; ++k) reopen();
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, kLeft, kLong);
    QCOMPARE(hashAfter(session(), 0), expected);
  }

  /// From where it was, not from the start.
  void aRunThatPlayedGoesOn() {
    run(kLeft);
    session().play();
    QVERIFY(m_window->close());
    m_window.reset();
    open();
    // Its file goes once it is back.
    QTRY_COMPARE_WITH_TIMEOUT(QDir(copies()).entryList({QStringLiteral("*.psrec")}), QStringList(), kLong);
    QVERIFY(session().newest()->stats.frame >= kLeft);
    QTRY_VERIFY_WITH_TIMEOUT(session().playing() && session().newest()->stats.frame > kLeft, kLong);
  }

  void theRecordedMomentIsShownAgain() {
    run(kLeft);
    session().engine()->recording().settle();
    session().recorded().showAt(10.0 / 60);
    QTRY_VERIFY_WITH_TIMEOUT(session().recorded().isActive(), kLong);
    const double moment = session().now();  // of the frame next to that: some may be left out
    reopen();
    QTRY_VERIFY_WITH_TIMEOUT(session().recorded().isActive(), kLong);
    QCOMPARE(session().now(), moment);
    QCOMPARE(session().newest()->stats.frame, kLeft);
    QVERIFY(!session().playing());
  }

  void cursorsOfGraphsComeBack() {
    Plot* plot = m_window->findChild<GraphsPanel*>()->plots().front();
    plot->setReading(0, 0.125);
    plot->setReading(1, 0.25);
    m_window->findChild<GraphsPanel*>()->plots().back()->setReading(1, 0.5);
    reopen();
    const std::vector<Plot*> plots = m_window->findChild<GraphsPanel*>()->plots();
    QVERIFY(plots.size() > 1);
    QVERIFY(plots.front()->reading(0) == 0.125 && plots.front()->reading(1) == 0.25);
    QVERIFY(!plots.back()->reading(0) && plots.back()->reading(1) == 0.5);
  }

  /// Each with what was selected, which turns the inspector to the body's page as it is selected.
  void theWorkspaceAndPagesComeBack_data() {
    QTest::addColumn<int>("tab");
    for (const int tab : {MainWindow::kSceneTab, MainWindow::kTuneTab, MainWindow::kSketchTab, MainWindow::kFilmTab})
      QTest::newRow(MainWindow::kWorkspaces[static_cast<size_t>(tab)]) << tab;
  }
  void theWorkspaceAndPagesComeBack() {
    QFETCH(int, tab);
    m_window->showWorkspace(static_cast<MainWindow::WorkspaceTab>(tab));
    m_window->selection().select(OutlineKind::Body, "ice");
    const QString pages[] = {QStringLiteral("Solver"), QStringLiteral("Energy")};
    m_window->inspectorDock()->choosePage(pages[0]);
    m_window->layoutOfDocks().dockOf(pages[1])->choosePage(pages[1]);
    m_window->inspector().solverPanel()->setGroupFolded(QStringLiteral("Resolution"), true);
    const QStringList docks = shownDocks();
    const QSize size = m_window->viewport()->size();
    const std::string before = textWithoutView();
    reopen();
    QCOMPARE(m_window->workspaceTab(), static_cast<MainWindow::WorkspaceTab>(tab));
    QCOMPARE(shownDocks(), docks);
    QVERIFY(m_window->selection().has(OutlineKind::Body, "ice"));
    for (const QString& page : pages) QCOMPARE(m_window->layoutOfDocks().dockOf(page)->currentPage(), page);
    QCOMPARE(m_window->inspector().solverPanel()->foldedGroups(), QStringList{QStringLiteral("Resolution")});
    QVERIFY(m_window->inspector().materialPanel()->foldedGroups().isEmpty());
    QCOMPARE(m_window->tools().tool().usesBrush(), tab == MainWindow::kSketchTab);
    QTRY_COMPARE(m_window->viewport()->size(), size);
    QVERIFY(!document().isDirty());
    QCOMPARE(textWithoutView(), before);
  }

  void theZoomOfGraphsComesBack() {
    const std::vector<Plot*> before = m_window->findChild<GraphsPanel*>()->plots();
    before.front()->setRange(0.125, 0.25);
    before.front()->setValueRange(0, std::pair(10.0, 20.0));
    reopen();
    const std::vector<Plot*> plots = m_window->findChild<GraphsPanel*>()->plots();
    QCOMPARE(plots.front()->range(), (std::pair(0.125, 0.25)));
    QCOMPARE(plots.front()->axes().front().zoom, std::optional(std::pair(10.0, 20.0)));
    QVERIFY(plots.back()->isFitted() && !plots.back()->axes().front().zoom);
  }

  void theRangeOfTheLegendComesBack() {
    document().setColour("temperature");
    const auto view = [this] { return m_window->viewport(); };
    QTRY_VERIFY_WITH_TIMEOUT(!view()->overlayHits().legendBar.isEmpty(), kLong);
    const QRectF bar = view()->overlayHits().legendBar;
    const QPoint end(static_cast<int>(bar.center().x()), static_cast<int>(bar.top()));
    const double automatic = view()->legendRange().second;
    QTest::mousePress(view(), Qt::LeftButton, {}, end);
    QTest::mouseMove(view(), end + QPoint(0, 20));
    QTest::mouseRelease(view(), Qt::LeftButton, {}, end + QPoint(0, 20));
    QTRY_VERIFY(view()->legendRange().second < automatic);
    const auto range = view()->legendRange();
    reopen();
    QTRY_VERIFY_WITH_TIMEOUT(!view()->overlayHits().legendBar.isEmpty(), kLong);
    QCOMPARE(view()->legendRange(), range);
  }

  void theBrushComesBack() {
    BrushSettings brush = m_window->tools().brush();
    brush.shape = "cube";
    brush.radius = 0.08;
    brush.temperature = 300;
    brush.held = true;
    m_window->tools().setBrush(brush);
    reopen();
    QCOMPARE(QString::fromStdString(textOf(m_window->tools().brush())), QString::fromStdString(textOf(brush)));
  }

  void theToolComesBack_data() {
    QTest::addColumn<QString>("tool");
    for (const char* tool : {"select", "rotate", "hand", "brush", "erase", "tap", "ruler"})
      QTest::newRow(tool) << QString::fromLatin1(tool);
  }
  void theToolComesBack() {
    QFETCH(QString, tool);
    m_window->tools().activate(tool.toStdString());
    const MainWindow::WorkspaceTab tab = m_window->workspaceTab();
    reopen();
    QCOMPARE(QString::fromStdString(m_window->tools().active()), tool);
    QCOMPARE(m_window->workspaceTab(), tab);
  }

  /// Rows of the outliner are folded in the project in which they were, and no search is begun.
  void whatIsFoldedAndLeftOutComesBack() {
    document().addGroup({memberOf(Owner::Body, "ice"), memberOf(Owner::Wall, "floor")});  // of unsaved work, too
    const auto rowOfGroup = [this] {
      const auto* view = m_window->outliner()->view();
      return view->model()->index(0, 0, view->model()->index(0, 0));
    };
    QTreeView* view = m_window->outliner()->view();
    QVERIFY(view->model()->rowCount(rowOfGroup()) == 2 && view->isExpanded(rowOfGroup()));
    view->collapse(rowOfGroup());
    m_window->inspector().solverPanel()->setChangedOnly(true);
    reopen();
    view = m_window->outliner()->view();
    QVERIFY(view->model()->rowCount(rowOfGroup()) == 2 && !view->isExpanded(rowOfGroup()));
    QVERIFY(view->isExpanded(view->model()->index(0, 0)));
    const auto changed = [](const ParameterPanel* panel) {
      return panel->findChild<QAbstractButton*>(QStringLiteral("psChanged"))->isChecked();
    };
    QVERIFY(changed(m_window->inspector().solverPanel()) && !changed(m_window->inspector().bodyPanel()));
    // In another project nothing is folded.
    m_window->session().files().newProject();
    QTRY_VERIFY_WITH_TIMEOUT(document().path().isEmpty(), kLong);
    QVERIFY(m_window->outliner()->folded() == QStringList{QString()});
  }

  void theSelectionComesBack() {
    const std::vector<SelectedItem> items{{OutlineKind::Wall, "floor"}, {OutlineKind::Body, "ice"}};
    m_window->selection().selectAll(items);
    reopen();
    QVERIFY(m_window->selection().items() == items);
    QCOMPARE(m_window->selection().material(), std::string("water"));
    QVERIFY(!session().playing());
    QCOMPARE(frameOf(session()), uint64_t{0});
  }

  void whatIsNotThereAnyMoreIsNotSelected() {
    m_window->selection().selectAll({{OutlineKind::Wall, "floor"}, {OutlineKind::Body, "ice"}});
    QVERIFY(m_window->close());
    Project other = scenes::iceOnPlate(4, 370);
    other.bodies.clear();
    saveProject(other, m_path.toStdString());
    m_window.reset();
    open();
    QVERIFY(m_window->selection().items() == std::vector<SelectedItem>({{OutlineKind::Wall, "floor"}}));
  }

  /// Somebody else wrote the file meanwhile: its run is another one.
  void theRunOfAnotherProjectDoesNotComeBack() {
    run(kLeft);
    session().play();
    QVERIFY(m_window->close());
    saveProject(scenes::iceOnPlate(4, 300), m_path.toStdString());
    m_window.reset();
    open();
    QTRY_VERIFY_WITH_TIMEOUT(session().playing(), kLong);
    session().pause();
    session().engine()->recording().settle();
    const auto point = session().engine()->recording().restorePoint(0);
    QVERIFY(point && point->from == 0);
    QCOMPARE(session().recorded().extent().first, uint64_t{0});
    QCOMPARE(std::get<double>(document().value({Owner::Wall, "floor", "temperature"})), 300.0);
  }

  /// What comes from a closed window is no work of another one that is opened with a project of its own.
  void aProjectThatIsAskedForStartsAsItDoes() {
    run(kLeft);
    m_window->selection().select(OutlineKind::Wall, "floor");
    QVERIFY(m_window->close());
    m_window.reset();
    QFile stray(QDir(copies()).filePath(QStringLiteral("20200101-000000-1-0.psrec")));  // that no note tells of
    QVERIFY(stray.open(QIODevice::WriteOnly) && stray.write("PSRECORD") == 8);
    stray.close();
    open(m_path);
    QVERIFY(session().playing());
    QVERIFY(!m_window->selection().has(OutlineKind::Wall, "floor"));
    QTRY_COMPARE(QDir(copies()).entryList({QStringLiteral("*.psrec")}), QStringList());  // nobody can ask for them
  }

  /// Of a long run its end alone, which can be gone on from.
  void ofALongRunItsEndIsKept() {
    run(kLeft);
    const uint64_t expected = hashAfter(session(), 0);
    const QString path = m_directory->filePath(QStringLiteral("end.psrec"));
    QVERIFY(session().recordings().keep(path, 1));
    const RecordingReader reader(path.toStdString(), *session().plugins());
    QCOMPARE(reader.content().present.states.size(), size_t{1});
    QCOMPARE(reader.content().present.states.front().frame, kLeft);
    QVERIFY(reader.frameCount() <= 2);
    const auto point = reader.content().present.restorePoint(kLeft);
    QVERIFY(point);
    QCOMPARE(replayed(*point, *session().plugins())->stateHash(), expected);
  }

 private:
  QString copies() const { return m_directory->filePath(QStringLiteral("copies")); }
  Session& session() { return m_window->session(); }
  Document& document() { return session().document(); }
  /// `project`: "": what was open last.
  void open(const QString& project = {}) {
    Theme::apply(*qApp, true);
    MainWindow::Options options;
    options.project = project;
    options.sample = m_path;
    options.session.autosaveDirectory = copies();
    m_window = shownWindow(options, {1280, 800});
    QVERIFY(m_window);
  }
  void reopen() {
    QVERIFY(m_window->close());
    m_window.reset();
    open();
  }
  std::string textWithoutView() {
    Project project = document().project();
    project.view = {};
    return writeProject(project);
  }
  QStringList shownDocks() {
    QStringList names;
    for (const Dock* dock : m_window->layoutOfDocks().docks()) {
      if (dock->isVisible()) names << dock->objectName();
    }
    return names;
  }
  void toTheStart() {
    const uint64_t revision = session().snapshot()->revision;
    session().reset();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision, kLong);
  }
  /// Frame by frame, as the step button does.
  void run(uint64_t frames) {
    const uint64_t last = frameOf(session()) + frames;
    for (uint64_t frame = 0; frame < frames; ++frame) session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame == last, kLong);
  }

  std::unique_ptr<QTemporaryDir> m_directory;
  QString m_path;
  std::unique_ptr<MainWindow> m_window;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  TestResuming test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_resuming.moc"
