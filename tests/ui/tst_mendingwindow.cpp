// SPDX-License-Identifier: Apache-2.0
// Values that cannot be, in the document and in the window: what is refused leaves the document, and a project of which
// no scene can be made opens to be mended.
#include "core/io/projectio.h"
#include "core/plugin_host/pluginscan.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "tests/shared/scenes.h"
#include "tests/ui/answered.h"
#include "tests/ui/samplewindow.h"
#include "ui/document/declared.h"
#include "ui/document/missingplugins.h"
#include "ui/panels/inspector.h"
#include "ui/panels/pluginpage.h"
#include "ui/rows/parameterpanel.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/scenelink.h"
#include "ui/session/wording.h"
#include "ui/session/worker.h"
#include "ui/window/dock.h"
#include "ui/window/noticebar.h"
#include "ui/window/statusline.h"

#include <QtCore/QDir>
#include <QtCore/QProcess>
#include <QtCore/QTemporaryDir>
#include <QtWidgets/QPushButton>

#include <algorithm>
#include <chrono>
#include <clocale>
#include <thread>

using namespace ps;

namespace {

Project scene() { return scenes::iceOnPlate(5, 370); }

}  // namespace

class TestMendingWindow : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    m_plugins = std::make_unique<PluginRegistry>();
    open();
  }
  void cleanupTestCase() { m_window.reset(); }

  /// The engine says that there is no scene when the document has one already.
  void whatIsMendedWhileItIsTriedIsTriedAgain() {
    Document document;
    document.setPlugins(m_plugins.get());
    EngineThread engine(*m_plugins, {});
    SceneLink link(document, engine);
    document.open(scene(), {});
    QTRY_VERIFY(engine.snapshot() && engine.playing());
    engine.ask([](const Engine&) { std::this_thread::sleep_for(std::chrono::milliseconds(200)); });
    Project project = scene();
    project.materials[0].properties.values["boiling_temperature"] = 200.0;
    document.open(project, {});
    QCOMPARE(document.setParameter({Owner::Material, "water", "boiling_temperature"}, 373.15), QString());
    QTRY_VERIFY(!engine.events(0).empty() && engine.events(0).back().kind == EngineEvent::Kind::NotOpened);
    QVERIFY(link.isBroken());
    link.hear(engine.events(0).back());
    QTRY_VERIFY(!link.isBroken());
    QCOMPARE(engine.snapshot()->id.size(), size_t{125});
  }

  /// What a drag passes over on the way to a value that a plugin's law fails at.
  void aRefusedValueLeavesTheDocument() {
    const QTemporaryDir folder;
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QStringLiteral("/fixture_material.so"),
                        folder.filePath(QStringLiteral("late.so"))));
    PluginRegistry::Options options;
    options.extraPaths = {folder.path().toStdString()};
    PluginRegistry plugins(options);
    Document document;
    document.setPlugins(&plugins);
    EngineThread engine(plugins, {});
    SceneLink link(document, engine);
    const Address density{Owner::Material, "lab", "density"};
    Project project = scene();
    SceneMaterial lab;
    lab.id = "lab";
    lab.base = "fixture.material";
    lab.parameters.values["density"] = 1400.0;
    project.materials.push_back(lab);
    document.open(project, {}, false, false);
    const auto hear = [&](uint64_t from) {
      for (const EngineEvent& event : engine.events(from)) link.hear(event);
    };
    document.beginGesture();
    QCOMPARE(document.setParameter(density, 1450.0), QString());
    tests::onEngine<int>(engine, [](Engine&) { return 0; });  // it has that one
    QCOMPARE(document.setParameter(density, 1800.0), QString());
    QTRY_VERIFY(!engine.events(0).empty());
    QVERIFY(engine.events(0).back().message.find("too dense") != std::string::npos);
    hear(0);
    document.endGesture();
    QCOMPARE(storedValue(document.project(), density), std::optional<Value>(1450.0));
    QCOMPARE(document.undoStack().count(), 1);
    const uint64_t told = engine.events(0).back().number + 1;
    document.undoStack().undo();
    QCOMPARE(storedValue(document.project(), density), std::optional<Value>(1400.0));
    document.undoStack().redo();
    QCOMPARE(storedValue(document.project(), density), std::optional<Value>(1450.0));
    hear(told);
  }

  /// A large scene says how far it is, may be given up, and is then told as such.
  void aSceneInTheMakingIsGivenUpByHand() {
    constexpr int kSide = 60;
    document().open(scenes::iceOnPlate(kSide, 300), {}, false, false);
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*m_window, QStringLiteral("Cancel")), kLong);
    giveUpTheMaking();
    if (QTest::currentTestFailed()) return;
    QVERIFY(!noticeButton(*m_window, QStringLiteral("Cancel")));
    QVERIFY(session().snapshot() && session().snapshot()->id.empty() && !session().engine()->making());
    document().open(scene(), {}, false, false);
    QTRY_VERIFY(session().snapshot() && session().snapshot()->id.size() == 125);
  }

  /// Back to the start with a spacing that makes many of few: it says how far it is, and who gives it up has the scene
  /// as it was.
  void theWayBackToTheStartIsGivenUp() {
    const auto particles = [this] { return session().newest() ? session().newest()->id.size() : 0; };
    document().open(scene(), {}, false, false);
    QTRY_VERIFY_WITH_TIMEOUT(particles() == 125 && !session().engine()->making(), kLong);
    session().pause();
    session().step();
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->stats.frame > 0 && !session().appliesAtOnce(), kLong);
    const Address spacing{Owner::Solver, "", "particle_spacing"};
    QCOMPARE(document().setParameter(spacing, std::get<double>(document().value(spacing)) / 12), QString());
    m_window->action(QStringLiteral("simulation.reset"))->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*m_window, QStringLiteral("Cancel")), kLong);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral(" %")), qPrintable(m_window->notice()->text()));
    giveUpTheMaking();
    if (QTest::currentTestFailed()) return;
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("It goes on as it was")),
             qPrintable(m_window->notice()->text()));
    QVERIFY(particles() == 125 && session().newest()->stats.frame > 0);
    document().open(scene(), {}, false, false);
    QTRY_VERIFY_WITH_TIMEOUT(particles() == 125 && !session().engine()->making(), kLong);
  }

  void theTimeThatIsLeftIsTold() {
    QCOMPARE(secondsLeft(2, 0.2), 8.0);
    QCOMPARE(secondsLeft(2, 0.01), -1.0);  // too early
    QCOMPARE(progressText(0.2, 8), QStringLiteral("20 %, 8 s left"));
    QCOMPARE(progressText(0.01, -1), QStringLiteral("1 %"));
  }

  /// Once it is told of, by Esc in the view as well, which its button says.
  void escGivesUpASceneInTheMaking() {
    constexpr int kSide = 60;
    const auto holds = [this](size_t particles) {  // a project that has just come has no snapshot yet
      const SnapshotPtr shown = session().snapshot();
      return shown && shown->id.size() == particles && !session().engine()->making();
    };
    document().open(scene(), {}, false, false);
    QTRY_VERIFY_WITH_TIMEOUT(holds(125), kLong);
    document().open(scenes::iceOnPlate(kSide, 300), {}, false, false);
    const QPushButton* cancel = nullptr;
    QTRY_VERIFY_WITH_TIMEOUT((cancel = noticeButton(*m_window, QStringLiteral("Cancel"))) != nullptr, kLong);
    QVERIFY(cancel->toolTip().contains(QStringLiteral("Esc")));
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("Giving up…")), qPrintable(m_window->notice()->text()));
    QTRY_VERIFY_WITH_TIMEOUT(holds(0), kLong);
    document().open(scene(), {}, false, false);
    QTRY_VERIFY_WITH_TIMEOUT(holds(125), kLong);
  }

  void aRequiredPluginIsAskedForOnceMoreWhenSaved() {
    const QTemporaryDir directory;
    const QString path = directory.filePath(QStringLiteral("needy.json"));
    Project project = scene();
    project.pluginsRequired = {"org.example.gone"};
    project.bodies[0].constraints = {{"org.example.gone", {}, {}}};
    saveProject(project, path.toStdString());
    Worker worker;
    Document document;
    document.setPlugins(m_plugins.get());
    DocumentFiles files(document, worker);
    QSignalSpy failed(&files, &DocumentFiles::openFailed), opened(&files, &DocumentFiles::opened);
    files.open(path);
    QVERIFY(failed.wait());
    const QString problem = failed.front()[1].toString();
    QVERIFY2(DocumentFiles::lacksRequired(problem) && problem.contains(QStringLiteral("org.example.gone")),
             qPrintable(problem));
    files.openAnyway();
    QVERIFY(opened.wait());
    QVERIFY(opened.front()[1].toStringList().isEmpty());  // the scene says itself what it misses
    QCOMPARE(missingPlugins(document.project(), *m_plugins).front().id, std::string("org.example.gone"));
    QCOMPARE(writeProject(document.project()), writeProject(project));  // it goes on needing the plugin
    const Engine engine(document.project(), *m_plugins);
    QCOMPARE(engine.solver().particles().size(), size_t{125});
  }

  void aFileOfWhichNoSceneCanBeMadeOpensToBeMended() {
    Project project = scenes::iceOnPlate(4, 370);
    project.title = "Too coarse";
    std::erase_if(project.environment.walls, [](const SceneWall& wall) { return wall.normal.x() != 0; });
    project.environment.periodic = {true, false, false};
    project.solver.parameters.values["particle_spacing"] = 1.0;
    const QString path = m_folder.filePath(QStringLiteral("coarse.json"));
    saveProject(project, path.toStdString());
    m_window->openFile(path);
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->text().contains(QStringLiteral("“Too coarse” cannot run")), kLong);
    QCOMPARE(document().path(), path);
    QVERIFY(session().isBroken() && !session().playing());
    const Address spacing{Owner::Solver, "", "particle_spacing"};
    ParameterRow* row = m_window->inspector().panelFor(spacing)->row(QString::fromStdString(spacing.text()));
    QVERIFY(row && row->has(RowState::Error));
    m_window->inspectorDock()->showPage(QStringLiteral("Material"));
    QPushButton* show = noticeButton(*m_window, QStringLiteral("Show it"));
    QVERIFY(show);
    show->click();
    QCOMPARE(m_window->inspectorDock()->currentPage(), QStringLiteral("Solver"));
    QVERIFY(!row->visibleRegion().isEmpty());
    m_window->inspector().rebuild();  // rows made anew say it again
    row = m_window->inspector().solverPanel()->row(QString::fromStdString(spacing.text()));
    QVERIFY(row->has(RowState::Error));
    QVERIFY(row->enter(QStringLiteral("20 mm")));
    QTRY_VERIFY_WITH_TIMEOUT(session().snapshot() && session().snapshot()->stats.frame > 1,
                             kLong);  // it runs, as it would have at once
    QTRY_VERIFY_WITH_TIMEOUT(m_window->notice()->topic() != QStringLiteral("step"), kLong);
    QVERIFY(!row->has(RowState::Error));
  }

  void withoutARequiredPluginItOpensAnyway() {
    Project project = scenes::iceOnPlate(4, 302);
    project.pluginsRequired = {"org.example.gone"};
    const QString path = m_folder.filePath(QStringLiteral("needy.json"));
    saveProject(project, path.toStdString());
    m_window->openFile(path);
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*m_window, QStringLiteral("Open anyway")), kLong);
    QVERIFY(floorTemperature() != 302.0);
    noticeButton(*m_window, QStringLiteral("Open anyway"))->click();
    QTRY_COMPARE_WITH_TIMEOUT(floorTemperature(), 302.0, kLong);
  }

  /// Beside the sentence about a plugin in quarantine: what still crashes stays there, what comes back is allowed.
  void aPluginIsTriedAgain() {
    const QTemporaryDir folder, home;
    const QString file = folder.filePath(QStringLiteral("aborting.so"));
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QStringLiteral("/fixture_material.so"), file));
    const QByteArray before = qgetenv("XDG_STATE_HOME");
    qputenv("XDG_STATE_HOME", home.path().toUtf8());
    const std::unique_ptr<MainWindow> window = sampleWindow({1280, 800}, {folder.path().toStdString()});
    QVERIFY(window);
    PluginPage& page = *window->pluginPage();
    const PluginRegistry& plugins = *window->session().plugins();
    const auto state = [&] {
      const auto& all = plugins.plugins();
      return std::find_if(all.begin(), all.end(), [](const auto& info) { return info.id == "fixture.material"; })
          ->state;
    };
    QCOMPARE(state(), PluginInfo::State::Quarantined);
    page.select("bonds");
    QPushButton* button = nullptr;
    for (QPushButton* one : page.findChildren<QPushButton*>())
      if (one->text() == QStringLiteral("Try again")) button = one;
    QVERIFY(button && button->isHidden());
    page.select("fixture.material");
    QVERIFY(!button->isHidden());
    const auto messages = [&] { return window->session().log().messages().size(); };
    size_t told = messages();
    button->click();
    QVERIFY(!button->isEnabled());
    QTRY_VERIFY_WITH_TIMEOUT(messages() > told && button->isEnabled(), kLong);
    QCOMPARE(state(), PluginInfo::State::Quarantined);
    qputenv("PS_LET_GO", "1");
    told = messages();
    button->click();
    QTRY_VERIFY_WITH_TIMEOUT(messages() > told, kLong);
    qunsetenv("PS_LET_GO");
    QCOMPARE(state(), PluginInfo::State::Refused);
    QVERIFY(button->isHidden());
    QCOMPARE(window->session().log().messages().back().level, MessageLevel::Ok);
    PluginRegistry::Options options;
    options.extraPaths = {folder.path().toStdString()};
    qputenv("PS_LET_GO", "1");
    const bool loaded = PluginRegistry(options).has("fixture.material");
    qunsetenv("PS_LET_GO");
    qputenv("XDG_STATE_HOME", before);
    QVERIFY(loaded);
  }

  /// Where a scene needs it, what is over the view tries it once more.
  void aPluginInQuarantineIsTriedFromItsNotice() {
    const QTemporaryDir folder, home;
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QStringLiteral("/fixture_material.so"),
                        folder.filePath(QStringLiteral("aborting.so"))));
    const QByteArray before = qgetenv("XDG_STATE_HOME");
    qputenv("XDG_STATE_HOME", home.path().toUtf8());
    const std::unique_ptr<MainWindow> window = sampleWindow({1280, 800}, {folder.path().toStdString()});
    qputenv("XDG_STATE_HOME", before);
    QVERIFY(window);
    Project project = scene();
    SceneMaterial lab;
    lab.id = "lab";
    lab.base = "fixture.material";
    project.materials.push_back(lab);
    const QString path = folder.filePath(QStringLiteral("lab.json"));
    saveProject(project, path.toStdString());
    window->openFile(path);
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*window, QStringLiteral("Try again")), kLong);
    QVERIFY(!noticeButton(*window, QStringLiteral("Find plugin…")));
    noticeButton(*window, QStringLiteral("Try again"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(window->notice()->text().contains(QStringLiteral("failed again")), kLong);
    qputenv("PS_LET_GO", "1");
    noticeButton(*window, QStringLiteral("Try again"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(window->notice()->text().contains(QStringLiteral("came back")), kLong);
    qunsetenv("PS_LET_GO");
    QVERIFY(noticeButton(*window, QStringLiteral("Close the program")));
  }

  void aPluginThatDoesNotComeBackIsNamed() {
    const QString words = pluginLabel(session().plugins(), "bonds") + QStringLiteral("” does not come back");
    const auto says = [&] { return m_window->statusLine()->parts().front().contains(words); };
    session().play();
    QVERIFY(!says());
    Q_EMIT session().happened({0, EngineEvent::Kind::Late, 0, "bonds"});
    QTRY_VERIFY_WITH_TIMEOUT(says(), kLong);
    QVERIFY2(m_window->notice()->text().contains(words), qPrintable(m_window->notice()->text()));
    QVERIFY(!m_window->notice()->text().contains(QStringLiteral("leaves the plugin out")));  // it is the program's own
    Q_EMIT session().happened({0, EngineEvent::Kind::Settled, 0, {}});
    QTRY_VERIFY_WITH_TIMEOUT(!says(), kLong);
    QVERIFY(m_window->notice()->topic() != QStringLiteral("step"));
  }

  /// It takes the ten seconds that a plugin has to come back once the window is closed.
  void quittingEndsWhatDoesNotComeBack() {
    const QTemporaryDir folder;
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + QStringLiteral("/fixture_constraint.so"),
                        folder.filePath(QStringLiteral("endless_step.so"))));
    Project project = scene();
    project.bodies[0].constraints = {{"fixture.constraint", {}, {}}};
    saveProject(project, folder.filePath(QStringLiteral("scene.json")).toStdString());
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("XDG_STATE_HOME"), folder.filePath(QStringLiteral("state")));
    environment.insert(QStringLiteral("PHASESKETCH_PLUGIN_PATH"), folder.path());
    QProcess program;
    program.setProcessEnvironment(environment);
    const QStringList arguments{folder.filePath(QStringLiteral("scene.json")), QStringLiteral("--screenshot"),
                                folder.filePath(QStringLiteral("picture.png")), QStringLiteral("--after"),
                                QStringLiteral("1")};
    program.start(QStringLiteral(PS_BINARY_DIR "/bin/phasesketch"), arguments);
    QVERIFY(program.waitForFinished(2 * kLong));
    const QByteArray said = program.readAllStandardError();
    QVERIFY2(program.exitStatus() == QProcess::NormalExit && program.exitCode() == 3, said.constData());
    QVERIFY2(said.contains("the plugin 'fixture.constraint' did not come back"), said.constData());
    program.start(QStringLiteral(PS_BINARY_DIR "/bin/phasesketch"), arguments);  // without it
    QVERIFY(program.waitForFinished(2 * kLong));
    QCOMPARE(program.exitCode(), 0);
  }

  /// As at a logout, while the scene runs, or before it does: an end like a kill, which accuses no plugin.
  void theLossOfTheDisplayIsNoCrash() {
    const QTemporaryDir folder;
    QProcess display;
    display.start(QStringLiteral("Xvfb"),
                  {QStringLiteral("-displayfd"), QStringLiteral("1"), QStringLiteral("-screen"), QStringLiteral("0"),
                   QStringLiteral("1280x800x24"), QStringLiteral("-nolisten"), QStringLiteral("tcp"),
                   QStringLiteral("-noreset"), QStringLiteral("+extension"), QStringLiteral("GLX")});
    QVERIFY(display.waitForStarted());
    QTRY_VERIFY_WITH_TIMEOUT(display.canReadLine(), kLong);
    saveProject(scene(), folder.filePath(QStringLiteral("scene.json")).toStdString());
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("DISPLAY"), QLatin1Char(':') + QString::fromLatin1(display.readLine().trimmed()));
    environment.insert(QStringLiteral("XDG_STATE_HOME"), folder.filePath(QStringLiteral("state")));
    environment.insert(QStringLiteral("XDG_DATA_HOME"), folder.filePath(QStringLiteral("data")));
    QProcess program;
    program.setProcessEnvironment(environment);
    program.start(QStringLiteral(PS_BINARY_DIR "/bin/phasesketch"), {folder.filePath(QStringLiteral("scene.json"))});
    QVERIFY(program.waitForStarted());
    QTest::qWait(6000);
    QVERIFY2(program.state() == QProcess::Running, program.readAllStandardError().constData());
    display.kill();
    QVERIFY(display.waitForFinished());
    QVERIFY(program.waitForFinished(kLong));
    const QByteArray said = program.readAllStandardError();
    QVERIFY2(program.exitStatus() == QProcess::NormalExit && program.exitCode() == 1, said.constData());
    QVERIFY(
        QDir(folder.filePath(QStringLiteral("state/phasesketch"))).entryList({QStringLiteral("*.crashed")}).isEmpty());
  }

 private:
  /// By the notice, which answers at once; the scene stays as it was.
  void giveUpTheMaking() {
    QElapsedTimer clock;
    clock.start();
    noticeButton(*m_window, QStringLiteral("Cancel"))->click();
    QVERIFY2(m_window->notice()->text().contains(QStringLiteral("Giving up…")), qPrintable(m_window->notice()->text()));
    QVERIFY2(clock.elapsed() < kAnswered, qPrintable(QString::number(clock.elapsed())));
    QTRY_VERIFY_WITH_TIMEOUT(noticeButton(*m_window, QStringLiteral("Try again")), kLong);
  }
  double floorTemperature() { return std::get<double>(document().value({Owner::Wall, "floor", "temperature"})); }
  QTemporaryDir m_folder;
  std::unique_ptr<PluginRegistry> m_plugins;
};

int main(int argc, char** argv) {
  servePluginScans(argc, argv);
  requestViewFormat();
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  TestMendingWindow test;
  return QTest::qExec(&test, argc, argv);
}
#include "tst_mendingwindow.moc"
