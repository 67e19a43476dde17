// SPDX-License-Identifier: Apache-2.0
// A user's sessions: what is opened first, what is kept at close and offered again, files, keys, and pictures by
// command.
#include "core/io/projectio.h"
#include "core/simulation/enginethread.h"
#include "tests/shared/scenes.h"
#include "tests/ui/windowtesting.h"
#include "ui/document/document.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/panels/inspector.h"
#include "ui/panels/outliner.h"
#include "ui/render/camera.h"
#include "ui/rows/panelheader.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/worker.h"
#include "ui/theme/icon.h"
#include "ui/theme/theme.h"
#include "ui/timeline/transport.h"
#include "ui/tools/toolbox.h"
#include "ui/viewport/viewport.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QMimeData>
#include <QtCore/QProcess>
#include <QtCore/QStandardPaths>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtGui/QDropEvent>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>
#include <QtWidgets/QApplication>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QLineEdit>
#include <QtWidgets/QMessageBox>
#include <QtWidgets/QPushButton>
#include <QtWidgets/QTabBar>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QTreeView>

#include <clocale>
#include <functional>
#include <future>
#include <optional>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};

double floorOf(MainWindow& window) { return std::get<double>(window.session().document().value(kFloor)); }

void press(MainWindow& window, Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
  window.viewport()->setFocus();
  QTest::keyClick(window.viewport(), key, modifiers);
}

}  // namespace

class TestSession : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    preferences::setWelcomeAtStart(false);  // what is opened is looked at
    preferences::setTourDone();
    m_directory = std::make_unique<QTemporaryDir>();
    m_sample = file(QStringLiteral("sample.json"));
    saveProject(scenes::iceOnPlate(4, 370), m_sample.toStdString());
  }
  void cleanup() { m_window.reset(); }

  void closingAndReopeningKeepsUnsavedWork() {
    open();
    edit(351);
    QVERIFY(m_window->close());
    open();
    QCOMPARE(floorOf(*m_window), 351.0);
    QVERIFY(document().isDirty());
    QVERIFY(!m_window->notice()->isVisible());
    // The first session's copy went when this one had its own.
    QTRY_COMPARE(QDir(copies()).entryList({QStringLiteral("*.note")}).size(), 1);
  }

  void closingAndReopeningKeepsTheView() {
    const QString path = file(QStringLiteral("mine.json"));
    saveProject(scenes::iceOnPlate(4, 370), path.toStdString());
    open(path);
    m_window->viewport()->show(StandardView::Top);
    m_window->action(QStringLiteral("view.colour3"))->trigger();
    const Camera seen = m_window->viewport()->navigator().camera();
    QVERIFY(m_window->close());
    open();
    QCOMPARE(document().path(), path);
    QVERIFY(!document().isDirty());
    QCOMPARE(m_window->viewport()->navigator().camera().elevation, seen.elevation);
    QCOMPARE(m_window->viewport()->navigator().camera().distance, seen.distance);
    QCOMPARE(m_window->viewport()->colour(), std::string("phase"));
  }

  void aProjectWithoutACameraIsShownWhole() {
    open();
    const auto shownWhole = [this] {
      const Viewport* view = m_window->viewport();
      const Camera camera = view->navigator().camera();
      for (const api::Float4& p : view->snapshot()->position) {
        const auto pixel = project(camera, view->width(), view->height(), vectorOf(p));
        if (!pixel || pixel->x() < 0 || pixel->x() > view->width() || pixel->y() < 0 || pixel->y() > view->height())
          return false;
      }
      return !view->snapshot()->position.empty();
    };
    QTRY_VERIFY_WITH_TIMEOUT(m_window->viewport()->navigator().camera().distance < 1, kLong);  // a cup of ice
    QVERIFY(shownWhole());
    // Another one, 10 m aside, is not framed by what stood in the view before.
    Project far = scenes::iceOnPlate(4, 370);
    for (Body& body : far.bodies)
      if (auto* box = std::get_if<BoxShape>(&body.shape)) box->center.x() += 10;
    for (SceneWall& wall : far.environment.walls) wall.point.x() += 10;
    far.environment.boundsMinimum.x() += 10;
    far.environment.boundsMaximum.x() += 10;
    const QString path = file(QStringLiteral("far.json"));
    saveProject(far, path.toStdString());
    m_window->session().files().open(path);
    QTRY_COMPARE_WITH_TIMEOUT(document().path(), path, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->viewport()->navigator().camera().target.x() > 9, kLong);
    QVERIFY(shownWhole());
    QVERIFY(!document().isDirty() && !document().project().view.camera);  // nobody has looked elsewhere yet
  }

  /// A theme that is asked for on the command line holds for that once; one chosen in the menu stays.
  void theThemeOfTheCommandLineIsNotKept() {
    const auto darkAtStart = [this](std::optional<bool> asked) {
      make({}, asked);
      return m_window->isDark();
    };
    m_window.reset();
    make();
    m_window->setDark(true);
    QVERIFY(m_window->close());
    QCOMPARE(darkAtStart(false), false);
    QVERIFY(m_window->close());
    QCOMPARE(darkAtStart({}), true);
    QCOMPARE(darkAtStart(false), false);
    m_window->setDark(true);
    m_window->setDark(false);  // by hand
    QCOMPARE(darkAtStart({}), false);
    m_window->setDark(true);
  }

  void aNamedProjectLeavesOtherWorkOnOffer() {
    open();
    edit(352);
    QVERIFY(m_window->close());
    const QString other = file(QStringLiteral("other.json"));
    saveProject(scenes::iceOnPlate(4, 300), other.toStdString());
    open(other);
    QCOMPARE(floorOf(*m_window), 300.0);
    QVERIFY(m_window->notice()->isVisible());
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("was closed with unsaved changes")),
             qPrintable(m_window->notice()->text()));
    QPushButton* restore = noticeButton(*m_window, QStringLiteral("Restore"));
    QVERIFY(restore);
    QSignalSpy opened(&m_window->session().files(), &DocumentFiles::opened);
    restore->click();
    QVERIFY(opened.wait(kLong));
    QCOMPARE(floorOf(*m_window), 352.0);
    QTRY_VERIFY_WITH_TIMEOUT(!m_window->notice()->isVisible(), kLong);  // a slow machine says that the scene is made
  }

  /// Two windows were closed with unsaved work: one is open again, the other must not be lost by that.
  void bothOfTwoUnsavedSessionsAreKept() {
    for (const double kelvin : {353.0, 354.0}) {
      open(m_sample);
      edit(kelvin);
      QVERIFY(m_window->close());
    }
    open();
    QCOMPARE(floorOf(*m_window), 354.0);
    QVERIFY(m_window->notice()->isVisible());
    QPushButton* discard = noticeButton(*m_window, QStringLiteral("Discard"));
    QVERIFY(discard);
    QTRY_COMPARE(QDir(copies()).entryList({QStringLiteral("*.note")}).size(), 2);
    discard->click();
    QVERIFY(!m_window->notice()->isVisible());
    QCOMPARE(QDir(copies()).entryList({QStringLiteral("*.note")}).size(), 1);
  }

  /// Three windows were closed with unsaved work: one is open again, the others are offered one after the other, and
  /// again by the menu when they were kept for later.
  void allUnsavedWorkIsOffered() {
    for (const double kelvin : {353.0, 354.0, 355.0}) {
      open(m_sample);
      edit(kelvin);
      QVERIFY(m_window->close());
    }
    open();
    QCOMPARE(floorOf(*m_window), 355.0);
    QTRY_COMPARE(QDir(copies()).entryList({QStringLiteral("*.note")}).size(), 3);
    const auto press = [this](const QString& text) {
      QPushButton* button = noticeButton(*m_window, text);
      QVERIFY2(button, qPrintable(text));
      button->click();
    };
    QCOMPARE(m_window->notice()->topic(), QStringLiteral("restore"));
    press(QStringLiteral("Keep for later"));
    QCOMPARE(m_window->notice()->topic(), QStringLiteral("restore"));
    press(QStringLiteral("Keep for later"));
    QVERIFY(!m_window->notice()->isVisible());
    QAction* again = m_window->action(QStringLiteral("file.restore"));
    m_window->paletteEntries();  // looks what waits, as the menu does before it shows
    QVERIFY(again->isEnabled());
    again->trigger();
    QSignalSpy opened(&m_window->session().files(), &DocumentFiles::opened);
    press(QStringLiteral("Restore"));
    QVERIFY(opened.wait(kLong));
    QCOMPARE(floorOf(*m_window), 354.0);
    QTRY_COMPARE(m_window->notice()->topic(), QStringLiteral("replaced"));  // 355 K
    m_window->notice()->close(QStringLiteral("replaced"));
    QCOMPARE(m_window->notice()->topic(), QStringLiteral("restore"));
    press(QStringLiteral("Restore"));
    QVERIFY(opened.wait(kLong));
    QCOMPARE(floorOf(*m_window), 353.0);
  }

  void withoutUnsavedWorkThereIsNothingToRestore() {
    open();
    m_window->paletteEntries();
    QVERIFY(!m_window->action(QStringLiteral("file.restore"))->isEnabled());
  }

  /// What waits for a decision waits below other notices, and comes back when they go.
  void theWayBackSurvivesOtherNotices() {
    open();
    edit(355);
    press(*m_window, Qt::Key_N, Qt::ControlModifier);
    QTRY_COMPARE(m_window->notice()->topic(), QStringLiteral("replaced"));
    const QString broken = file(QStringLiteral("broken.json"));
    QFile out(broken);
    QVERIFY(out.open(QIODevice::WriteOnly) && out.write("{") == 1);
    out.close();
    m_window->openFile(broken);
    QTRY_COMPARE(m_window->notice()->topic(), QStringLiteral("open"));
    m_window->notice()->show(QStringLiteral("stroke"), MessageLevel::Warning, QStringLiteral("Nothing was drawn."), {});
    m_window->notice()->show(QStringLiteral("stroke"), MessageLevel::Warning, QStringLiteral("Nothing again."), {});
    QCOMPARE(m_window->notice()->text().trimmed(), QStringLiteral("Nothing again."));
    m_window->notice()->findChild<QToolButton*>()->click();  // dismiss
    QCOMPARE(m_window->notice()->topic(), QStringLiteral("open"));
    m_window->notice()->findChild<QToolButton*>()->click();
    QCOMPARE(m_window->notice()->topic(), QStringLiteral("replaced"));
    noticeButton(*m_window, QStringLiteral("Back to it"))->click();
    QCOMPARE(floorOf(*m_window), 355.0);
    QVERIFY(!m_window->notice()->isVisible());
    QCOMPARE(m_window->notice()->topic(), QString());
  }

  /// A notice without buttons is news: the next one takes its place.
  void newsGiveWay() {
    NoticeBar bar;
    bar.show(QStringLiteral("a"), MessageLevel::Info, QStringLiteral("Decide."), {}, {{QStringLiteral("Yes"), [] {}}});
    bar.show(QStringLiteral("b"), MessageLevel::Info, QStringLiteral("News."), {});
    bar.show(QStringLiteral("c"), MessageLevel::Info, QStringLiteral("Other news."), {});
    QCOMPARE(bar.topic(), QStringLiteral("c"));
    bar.close(QStringLiteral("nothing"));
    bar.close(QStringLiteral("c"));
    QCOMPARE(bar.topic(), QStringLiteral("a"));
    bar.close(QStringLiteral("a"));
    QVERIFY(bar.isHidden());
  }

  /// What went well leaves by itself; what asks or warns stays.
  void goodNewsLeave() {
    QWidget hidden;  // nobody's pointer is over it
    auto& bar = *new NoticeBar(&hidden);
    auto* leaves = bar.findChild<QTimer*>();
    QVERIFY(leaves);
    bar.show(QStringLiteral("a"), MessageLevel::Warning, QStringLiteral("Look."), {});
    QVERIFY(!leaves->isActive());
    bar.show(QStringLiteral("b"), MessageLevel::Ok, QStringLiteral("Written."), {}, {{QStringLiteral("Show"), [] {}}});
    QVERIFY(!leaves->isActive());
    bar.show(QStringLiteral("c"), MessageLevel::Ok, QStringLiteral("Written."), {});
    QVERIFY(leaves->isActive());
    leaves->start(1);
    QTRY_COMPARE(bar.topic(), QStringLiteral("b"));
    QVERIFY(!leaves->isActive());
  }

  void newSceneOverUnsavedWorkLeavesAWayBack() {
    open();
    edit(355);
    press(*m_window, Qt::Key_N, Qt::ControlModifier);
    QCOMPARE(document().title(), QStringLiteral("New scene"));
    QTRY_VERIFY(m_window->notice()->isVisible());
    QPushButton* back = noticeButton(*m_window, QStringLiteral("Back to it"));
    QVERIFY(back);
    back->click();
    QCOMPARE(floorOf(*m_window), 355.0);
    QVERIFY(document().isDirty());
    QVERIFY(!m_window->notice()->isVisible());
  }

  void theTitleNamesTheFile() {
    open(file(QStringLiteral("sample.json")));
    QCOMPARE(m_window->windowTitle(), QStringLiteral("sample.json[*] – Ice on a plate – PhaseSketch"));
    QVERIFY(!m_window->isWindowModified());
    edit(350);
    QVERIFY(m_window->isWindowModified());
    m_window->saveTo(file(QStringLiteral("mine [*].json")));
    QTRY_VERIFY(!m_window->isWindowModified());
    QCOMPARE(m_window->windowTitle(), QStringLiteral("mine [*][*].json[*] – Ice on a plate – PhaseSketch"));
    press(*m_window, Qt::Key_N, Qt::ControlModifier);
    QCOMPARE(m_window->windowTitle(), QStringLiteral("New scene[*] – PhaseSketch"));
    // One without a title of its own is called as its file, in its panel too.
    const auto* header = m_window->inspector().scenePanel()->findChild<PanelHeader*>();
    QVERIFY(header->accessibleName().contains(QStringLiteral("New scene")));
    m_window->saveTo(file(QStringLiteral("another.json")));
    QTRY_VERIFY(header->accessibleName().contains(QStringLiteral("another")));
  }

  /// Nothing runs, a sentence says how to begin, and graphs have no axes of nothing.
  void aNewSceneInvites() {
    open();
    QCOMPARE(m_window->viewport()->invitation(), QString());
    const uint64_t revision = session().snapshot()->revision;
    press(*m_window, Qt::Key_N, Qt::ControlModifier);
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->revision != revision && session().snapshot()->id.empty(), kLong);
    settle();
    QTRY_VERIFY(m_window->viewport()->invitation().startsWith(QStringLiteral("Press B and draw")));
    QVERIFY(!session().playing());
    QCOMPARE(session().snapshot()->stats.frame, uint64_t{0});
    QTRY_COMPARE(m_window->graphs()->valuesIn("K")->summary(), QStringLiteral("No matter yet"));
    QCOMPARE(m_window->inspector().scenePanel()->findChild<PanelHeader*>()->accessibleDescription(),
             QStringLiteral("0 bodies, 5 walls"));
    press(*m_window, Qt::Key_B);
    QCOMPARE(m_window->viewport()->invitation(), QStringLiteral("Draw with the left button"));
  }

  void aCloseThatCanKeepNothingWarnsOnce() {
    open();
    edit(356);
    QVERIFY(QDir(copies()).removeRecursively());
    QVERIFY(!m_window->close());
    QVERIFY(m_window->isVisible());
    QVERIFY2(m_window->notice()->text().startsWith(QStringLiteral("Not saved.")),
             qPrintable(m_window->notice()->text()));
    QVERIFY(noticeButton(*m_window, QStringLiteral("Save elsewhere…")));
    edit(357);  // of this nobody was warned
    QVERIFY(!m_window->close());
    QVERIFY(m_window->close());
  }

  void aSaveThatFailsSaysSo() {
    open();
    QSignalSpy failed(&m_window->session().files(), &DocumentFiles::saveFailed);
    m_window->saveTo(file(QStringLiteral("missing/scene.json")));
    QVERIFY(failed.wait(kLong));
    QVERIFY(m_window->notice()->isVisible());
    QVERIFY(m_window->notice()->text().startsWith(QStringLiteral("Not saved.")));
    QVERIFY(noticeButton(*m_window, QStringLiteral("Save elsewhere…")));
  }

  void theSampleIsSavedUnderAnotherName() {
    open();
    edit(358);
    const QByteArray before = read(m_sample);
    QString suggested;
    whenOpen<QFileDialog>([&](QFileDialog& dialog) {
      suggested = dialog.selectedFiles().value(0);
      dialog.reject();
    });
    press(*m_window, Qt::Key_S, Qt::ControlModifier);
    QVERIFY(suggested.endsWith(QStringLiteral("Ice on a plate.json")));
    m_window->session().worker().wait();
    QCOMPARE(read(m_sample), before);
  }

  /// Files to read begin where people keep theirs, not among the samples; Qt's own list shows whole names, and its
  /// folders have the theme's icon.
  void filesAreChosenWherePeopleKeepThem() {
    open();
    const QString home = QDir::homePath(),
                  documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    for (const char* name : {"file.open", "file.openRecording", "add.mesh"}) {
      bool asked = false;
      whenOpen<QFileDialog>([&](QFileDialog& dialog) {
        asked = true;
        const QString at = dialog.directory().absolutePath();
        const auto* list = dialog.findChild<QTreeView*>(QStringLiteral("treeView"));
        dialog.reject();
        QCOMPARE(at, QDir(documents).exists() ? documents : home);
        QVERIFY(list);
        QCOMPARE(list->header()->sectionResizeMode(0), QHeaderView::Stretch);
      });
      m_window->action(QString::fromLatin1(name))->trigger();
      QVERIFY2(asked, name);
    }
    const QPixmap folder = qApp->style()->standardIcon(QStyle::SP_DirIcon).pixmap(16);
    QCOMPARE(folder.toImage(), icon(QStringLiteral("folder"), false).pixmap(16).toImage());
  }

  /// "foo" becomes "foo.json" before the question whether that file may be replaced.
  void aNameWithoutAnEndingAsksAboutTheRightFile() {
    open();
    const QString path = file(QStringLiteral("foo.json"));
    QVERIFY(QFile::copy(m_sample, path));
    edit(359);
    QString question;
    whenOpen<QFileDialog>([&](QFileDialog& dialog) {
      dialog.findChild<QLineEdit*>()->setText(file(QStringLiteral("foo")));
      whenOpen<QMessageBox>([&](QMessageBox& box) {
        question = box.text();
        box.reject();
        dialog.reject();
      });
      QMetaObject::invokeMethod(&dialog, "accept");
    });
    m_window->action(QStringLiteral("file.saveAs"))->trigger();
    QVERIFY2(question.contains(QStringLiteral("foo.json")), qPrintable(question));
    m_window->session().worker().wait();
    QCOMPARE(read(path), read(m_sample));
  }

  void nothingOpensBeforePluginsAreThere() {
    make();
    m_window->show();
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    for (const char* name : {"file.new", "file.open", "file.save", "file.saveAs"})
      QVERIFY2(!m_window->action(QString::fromLatin1(name))->isEnabled(), name);
    press(*m_window, Qt::Key_N, Qt::ControlModifier);
    QVERIFY(document().project().bodies.empty() && document().changeCount() == 0);
    const QString dropped = file(QStringLiteral("dropped.json"));
    saveProject(scenes::iceOnPlate(4, 301), dropped.toStdString());
    drop(dropped);
    start();
    QCOMPARE(floorOf(*m_window), 301.0);
    QVERIFY(m_window->action(QStringLiteral("file.new"))->isEnabled());
  }

  /// It waits for the first scene, and comes into that.
  void aMeshThatIsDroppedEarlyWaits() {
    make();
    m_window->show();
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    const QString mesh = file(QStringLiteral("early.obj"));
    QFile out(mesh);
    QVERIFY(out.open(QIODevice::WriteOnly));
    out.write("v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    out.close();
    drop(mesh);
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("“early.obj” waits")));
    start();
    QTRY_COMPARE_WITH_TIMEOUT(document().project().bodies.size(), size_t{2}, kLong);
    QCOMPARE(document().project().bodies.back().name, std::string("early"));
  }

  void aDroppedFileOpens() {
    open();
    const QString dropped = file(QStringLiteral("dropped.json"));
    saveProject(scenes::iceOnPlate(4, 302), dropped.toStdString());
    QSignalSpy opened(&m_window->session().files(), &DocumentFiles::opened);
    drop(dropped);
    QVERIFY(opened.wait(kLong));
    QCOMPARE(floorOf(*m_window), 302.0);
  }

  void aSceneThatCannotBeBuiltSaysWhyAndIsMended() {
    open();
    Project project = scenes::iceOnPlate(4, 370);
    project.title = "Odd water";
    project.materials[0].properties.values["boiling_temperature"] = 200.0;  // below the melting point
    document().open(project, {});
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->isVisible(), kLong);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("“Odd water” cannot run as it is")),
             qPrintable(m_window->notice()->text()));
    QVERIFY(!session().playing() && session().snapshot()->id.empty());
    session().reset();  // Home tries again, and says the same
    QTRY_VERIFY(session().isBroken() && m_window->notice()->isVisible());
    QCOMPARE(document().setParameter({Owner::Material, "water", "boiling_temperature"}, 373.15), QString());
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->id.size(), size_t{64}, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(!m_window->notice()->isVisible(), kLong);
    session().play();
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot()->stats.frame > 1, kLong);
  }

  void keysMoveTheClockAndTheHistory() {
    open();
    session().pause();
    press(*m_window, Qt::Key_Home);
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, uint64_t{0}, kLong);
    press(*m_window, Qt::Key_Right);
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, uint64_t{1}, kLong);
    edit(360);
    press(*m_window, Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(floorOf(*m_window), 370.0);
    press(*m_window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QCOMPARE(floorOf(*m_window), 360.0);
    m_window->saveTo(file(QStringLiteral("keys.json")));
    QTRY_VERIFY(!document().isDirty());
    edit(361);
    press(*m_window, Qt::Key_S, Qt::ControlModifier);
    QTRY_VERIFY(!document().isDirty());
    m_window->graphs()->valuesIn("K")->setRange(0, 0.1);
    press(*m_window, Qt::Key_End);
    QVERIFY(m_window->graphs()->valuesIn("K")->isFitted());
    press(*m_window, Qt::Key_Tab);
    QCOMPARE(m_window->tools().active(), std::string("brush"));
    press(*m_window, Qt::Key_Tab);
    QCOMPARE(m_window->tools().active(), std::string("select"));
  }

  /// Widgets that walk by arrows keep them; the simulation stays where it is.
  void arrowsBelongToTheWidgetInFocus() {
    open();
    session().pause();
    settle();
    const uint64_t frame = session().snapshot()->stats.frame, revision = session().snapshot()->revision;
    auto* tabs = m_window->findChild<QTabBar*>(QStringLiteral("psWorkspaces"));
    QTest::keyClick(tabs, Qt::Key_Right);
    QCOMPARE(tabs->currentIndex(), 1);
    m_window->showWorkspace(MainWindow::kSceneTab);
    QTreeView* outliner = m_window->outliner()->view();
    outliner->setFocus();
    outliner->setCurrentIndex(outliner->model()->index(0, 0));
    QTest::keyClick(outliner, Qt::Key_End, Qt::ControlModifier);
    const QModelIndex last = outliner->currentIndex();
    QVERIFY(last != outliner->model()->index(0, 0));
    QTest::keyClick(outliner, Qt::Key_Home, Qt::ControlModifier);
    QVERIFY(outliner->currentIndex() != last);
    QTest::keyClick(outliner, Qt::Key_Right);
    settle();
    QCOMPARE(session().snapshot()->stats.frame, frame);
    QCOMPARE(session().snapshot()->revision, revision);
    QTest::keyClick(outliner, Qt::Key_Home);  // of the run
    QTRY_VERIFY(session().snapshot()->revision != revision);
  }

  void picturesByCommand_data() {
    QTest::addColumn<QString>("project");
    QTest::addColumn<QString>("picture");
    QTest::addColumn<QString>("theme");
    QTest::addColumn<int>("code");
    QTest::newRow("dark") << "good.json"
                          << "dark.png"
                          << "dark" << 0;
    QTest::newRow("light") << "good.json"
                           << "light.png"
                           << "light" << 0;
    QTest::newRow("no such folder") << "good.json"
                                    << "missing/picture.png"
                                    << "dark" << 1;
    QTest::newRow("no such project") << "nowhere.json"
                                     << "picture.png"
                                     << "dark" << 2;
    QTest::newRow("a project that cannot be built") << "odd.json"
                                                    << "picture.png"
                                                    << "dark" << 2;
  }
  void picturesByCommand() {
    QFETCH(QString, project);
    QFETCH(QString, picture);
    QFETCH(QString, theme);
    QFETCH(int, code);
    saveProject(scenes::iceOnPlate(4, 370), file(QStringLiteral("good.json")).toStdString());
    Project odd = scenes::iceOnPlate(4, 370);
    odd.solver.thermalModel = "bonds";  // another kind of plugin
    saveProject(odd, file(QStringLiteral("odd.json")).toStdString());
    QProcess program;
    program.start(
        QStringLiteral(PS_BINARY_DIR "/bin/phasesketch"),
        {file(project), QStringLiteral("--screenshot"), file(picture), QStringLiteral("--after"), QStringLiteral("0"),
         QStringLiteral("--size"), QStringLiteral("640x480"), QStringLiteral("--theme"), theme});
    QVERIFY(program.waitForFinished(2 * kLong));
    const QByteArray said = program.readAllStandardError();
    QVERIFY2(program.exitStatus() == QProcess::NormalExit && program.exitCode() == code, said.constData());
    QVERIFY(code == 0 || said.contains("phasesketch: "));
    if (code != 0) return;
    const QImage image(file(picture));
    QVERIFY(!image.isNull());
    QCOMPARE(image.pixelColor(image.width() - 2, image.height() / 2).lightness() < 128,
             theme == QStringLiteral("dark"));
  }

  void withoutADisplayThatIsSaid_data() {
    QTest::addColumn<QString>("display");
    QTest::addColumn<QByteArray>("said");
    QTest::newRow("none") << "" << QByteArray("there is no display (DISPLAY is not set): ");
    QTest::newRow("gone") << ":98765" << QByteArray("the display :98765 cannot be reached: ");
  }
  void withoutADisplayThatIsSaid() {
    QFETCH(QString, display);
    QFETCH(QByteArray, said);
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    for (const char* name : {"QT_QPA_PLATFORM", "WAYLAND_DISPLAY"}) environment.remove(QLatin1String(name));
    environment.insert(QStringLiteral("DISPLAY"), display);
    QProcess program;
    program.setProcessEnvironment(environment);
    program.start(QStringLiteral(PS_BINARY_DIR "/bin/phasesketch"), QStringList());
    QVERIFY(program.waitForFinished(kLong));
    QCOMPARE(program.exitStatus(), QProcess::NormalExit);
    QCOMPARE(program.exitCode(), 1);
    QCOMPARE(program.readAllStandardError(), "phasesketch: " + said +
                                                 "start it in a desktop session; "
                                                 "phasesketch-cli needs no display\n");
  }

 private:
  Session& session() { return m_window->session(); }
  Document& document() { return session().document(); }
  QString file(const QString& name) const { return m_directory->filePath(name); }
  QString copies() const { return file(QStringLiteral("copies")); }
  static QByteArray read(const QString& path) {
    QFile in(path);
    return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
  }

  void make(const QString& project = {}, std::optional<bool> dark = {}) {
    m_window.reset();
    MainWindow::Options options;
    options.dark = dark.value_or(true);
    options.themeAsked = dark.has_value();
    options.project = project;
    options.sample = m_sample;
    options.session.autosaveDirectory = copies();
    m_window = std::make_unique<MainWindow>(options);
    m_window->resize(1280, 800);
  }
  void start() {
    QSignalSpy shown(m_window.get(), &MainWindow::projectShown);
    m_window->start();
    QVERIFY(shown.wait(kLong));
  }
  /// A new window, as after the program's start, on its first project.
  void open(const QString& project = {}) {
    make(project);
    m_window->show();
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    QApplication::setActiveWindow(m_window.get());
    start();
  }
  /// Does something with the modal window that the next call opens, as soon as it is there.
  template <class Dialog>
  void whenOpen(const std::function<void(Dialog&)>& act) {
    auto* timer = new QTimer(m_window.get());
    connect(timer, &QTimer::timeout, timer, [timer, act] {
      auto* dialog = qobject_cast<Dialog*>(QApplication::activeModalWidget());
      if (!dialog) return;
      timer->deleteLater();
      act(*dialog);
    });
    timer->start(20);
  }
  /// What the engine was asked for is done, and seen.
  void settle() {
    std::promise<void> done;
    session().engine()->ask([&done](const Engine&) { done.set_value(); });
    done.get_future().wait();
    QTest::qWait(20);
  }
  void edit(double kelvin) { QCOMPARE(document().setParameter(kFloor, kelvin), QString()); }
  void drop(const QString& path) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(m_window.get(), &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent event(QPointF(50, 50), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(m_window.get(), &event);
  }

  std::unique_ptr<QTemporaryDir> m_directory;
  std::unique_ptr<MainWindow> m_window;
  QString m_sample;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("tst_session"));
  QApplication::setOrganizationName(QStringLiteral("phasesketch"));
  QApplication::setQuitOnLastWindowClosed(false);
  std::setlocale(LC_NUMERIC, "C");
  Theme::apply(application, true);
  TestSession test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_session.moc"
