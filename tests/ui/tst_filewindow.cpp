// SPDX-License-Identifier: Apache-2.0
// What the window says of a file that is not its alone, with the ways out; earlier versions; and how the program ends.
#include "core/io/filelock.h"
#include "core/io/outputfile.h"
#include "tests/shared/scenes.h"
#include "tests/ui/answered.h"
#include "tests/ui/desk.h"
#include "tests/ui/windowtesting.h"
#include "ui/session/savejob.h"
#include "ui/theme/theme.h"
#include "ui/viewport/viewport.h"
#include "ui/window/statusline.h"

#include <QtCore/QProcess>
#include <QtCore/QSemaphore>
#include <QtGui/QAction>
#include <QtTest/QSignalSpy>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMenu>
#include <QtWidgets/QPushButton>

#include <clocale>
#include <csignal>
#include <memory>

using namespace ps;

class TestFileWindow : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() {
    m_directory = std::make_unique<QTemporaryDir>();
    m_path = m_directory->filePath(QStringLiteral("mine.json"));
    saveProject(scenes::iceOnPlate(4, 300), m_path.toStdString());
  }
  void cleanup() { m_window.reset(); }

  void anotherProgramsChangeHasThreeWaysOut() {
    open();
    edit(310);
    writeFileAtomically(m_path.toStdString(), writeProject(scenes::iceOnPlate(4, 320)));
    saveIsRefused(QStringLiteral("another program has written it"));
    QVERIFY(noticeButton(*m_window, QStringLiteral("Save anyway")) &&
            noticeButton(*m_window, QStringLiteral("Save elsewhere…")));
    noticeButton(*m_window, QStringLiteral("Open what is on disk"))->click();
    QTRY_COMPARE_WITH_TIMEOUT(floor(), 320.0, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("replaced"), kLong);
    noticeButton(*m_window, QStringLiteral("Back to it"))->click();
    QCOMPARE(floor(), 310.0);
    saveIsRefused(QStringLiteral("another program has written it"));
    noticeButton(*m_window, QStringLiteral("Save anyway"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(!document().isDirty(), kLong);
    QVERIFY(!m_window->notice()->isVisible());
  }

  /// While it is open, without a save.
  void anotherProgramsChangeIsToldWithTwoWays() {
    open();
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QString(), kLong);  // a slow machine says what it makes
    writeFileAtomically(m_path.toStdString(), writeProject(scenes::iceOnPlate(4, 320)));
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("outside"), kLong);
    const QString text = m_window->notice()->text();
    QVERIFY2(text.contains(QStringLiteral("Another program has changed “mine.json”.")), qPrintable(text));
    QCOMPARE(floor(), 300.0);
    noticeButton(*m_window, QStringLiteral("Keep mine"))->click();
    QVERIFY(!m_window->notice()->isVisible() && document().isDirty());
    m_window->action(QStringLiteral("file.save"))->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!document().isDirty(), kLong);
    QVERIFY(!m_window->notice()->isVisible());
    writeFileAtomically(m_path.toStdString(), writeProject(scenes::iceOnPlate(4, 321)));
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("outside"), kLong);
    noticeButton(*m_window, QStringLiteral("Open what is on disk"))->click();
    QTRY_COMPARE_WITH_TIMEOUT(floor(), 321.0, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(!m_window->notice()->isVisible(), kLong);
    QVERIFY(!document().isDirty());
    QVERIFY(QFile::remove(m_path));
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("outside"), kLong);
    noticeButton(*m_window, QStringLiteral("Save it again"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(!document().isDirty(), kLong);
    QVERIFY(QFile::exists(m_path) && !m_window->notice()->isVisible());
  }

  /// What is read at once is not told; the rest is, and Esc gives it up with the scene as it was.
  void aLongOpeningIsToldAndCanBeGivenUp() {
    open();
    const QString other = m_directory->filePath(QStringLiteral("other.json"));
    saveProject(scenes::iceOnPlate(4, 320), other.toStdString());
    const auto told = [this] { return m_window->statusLine()->state().note.contains(QStringLiteral("“other.json”")); };
    {
      const Held held(m_window->session().worker());
      m_window->openFile(other);
      QVERIFY(!told() && !QGuiApplication::overrideCursor());
      QTRY_VERIFY(told());
      QVERIFY(QGuiApplication::overrideCursor());
      QCOMPARE(QGuiApplication::overrideCursor()->shape(), Qt::BusyCursor);
      QElapsedTimer clock;
      clock.start();
      QTest::keyClick(m_window.get(), Qt::Key_Escape);
      QVERIFY2(clock.elapsed() < kAnswered, qPrintable(QString::number(clock.elapsed())));
      QVERIFY(!told() && !QGuiApplication::overrideCursor());
      QCOMPARE(m_window->notice()->topic(), QStringLiteral("open"));
      const Message& said = m_window->session().log().messages().back();  // a note, and no error
      QCOMPARE(said.level, MessageLevel::Info);
      QCOMPARE(
          said.text,
          QStringLiteral("Opening “other.json” was given up. “%1” is still open, as it was.").arg(document().title()));
      QVERIFY(!noticeButton(*m_window, QStringLiteral("Open another…")));
    }
    m_window->session().worker().wait();
    QCoreApplication::processEvents();
    QCOMPARE(document().path(), m_path);
    QCOMPARE(floor(), 300.0);
    {
      const Held held(m_window->session().worker());
      m_window->openFile(other);
      QTRY_VERIFY(told());
    }
    QTRY_COMPARE_WITH_TIMEOUT(floor(), 320.0, kLong);
    QVERIFY(!told() && !QGuiApplication::overrideCursor());
  }

  void aProjectThatIsOpenElsewhereSaysSo() {
    const FileLock other(lockPath(m_path).toStdString(), "Ada on elsewhere");
    open();
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("lock"), kLong);
    const QString text = m_window->notice()->text();
    QVERIFY2(text.contains(QStringLiteral("“mine.json” is open in another window, of Ada on elsewhere.")),
             qPrintable(text));
    edit(310);
    saveIsRefused(QStringLiteral("another window has it open"));
    noticeButton(*m_window, QStringLiteral("Take over and save"))->click();
    QTRY_VERIFY_WITH_TIMEOUT(!document().isDirty(), kLong);
    QVERIFY(!m_window->notice()->isVisible());
    QVERIFY(!other.held());
  }

  void earlierVersionsAreInTheMenu() {
    open();
    for (const double kelvin : {310.0, 311.0}) {
      edit(kelvin);
      m_window->action(QStringLiteral("file.save"))->trigger();
      QTRY_VERIFY_WITH_TIMEOUT(!document().isDirty(), kLong);
    }
    QMenu* menu = nullptr;
    for (QMenu* each : m_window->findChildren<QMenu*>()) {
      if (each->title() == QStringLiteral("Earlier versions")) menu = each;
    }
    QVERIFY(menu);
    Q_EMIT menu->aboutToShow();
    QCOMPARE(menu->actions().size(), 2);
    QVERIFY2(menu->actions()[0]->text().contains(QStringLiteral("kB")), qPrintable(menu->actions()[0]->text()));
    menu->actions()[0]->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(floor(), 310.0, kLong);
    QVERIFY(document().isDirty());
    QCOMPARE(document().path(), m_path);
  }

  void signalsCloseTheProgramInOrder_data() {
    QTest::addColumn<int>("number");
    QTest::addColumn<bool>("ignored");
    QTest::newRow("SIGTERM") << SIGTERM << false;
    QTest::newRow("SIGHUP") << SIGHUP << false;
    QTest::newRow("SIGHUP under nohup") << SIGHUP << true;
  }
  void signalsCloseTheProgramInOrder() {
    QFETCH(int, number);
    QFETCH(bool, ignored);
    const QString copies = m_directory->filePath(QStringLiteral("phasesketch/autosave"));
    leaveUnsaved(copies, 312);
    QProcess program;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("XDG_STATE_HOME"), m_directory->path());
    program.setProcessEnvironment(environment);
    if (ignored) program.setChildProcessModifier([] { std::signal(SIGHUP, SIG_IGN); });
    program.start(QStringLiteral(PS_BINARY_DIR "/bin/phasesketch"), QStringList());
    QVERIFY(program.waitForStarted());
    // It has opened that work again once it has a copy of its own.
    const QString own = QStringLiteral("*-%1-0.*.json").arg(program.processId());
    QTRY_COMPARE_WITH_TIMEOUT(QDir(copies).entryList({own}).size(), 1, kLong);
    QTRY_COMPARE_WITH_TIMEOUT(QDir(copies).entryList({QStringLiteral("*.json")}).size(), 1, kLong);
    ::kill(static_cast<pid_t>(program.processId()), number);
    if (ignored) {
      QVERIFY(!program.waitForFinished(1000));
      ::kill(static_cast<pid_t>(program.processId()), SIGTERM);
    }
    QVERIFY(program.waitForFinished(kLong));
    QCOMPARE(program.exitStatus(), QProcess::NormalExit);
    QCOMPARE(program.exitCode(), 0);
    Document document;
    Worker worker;
    const Autosave next(document, worker, copies);
    const auto sessions = next.leftBehind();
    worker.wait();
    QCOMPARE(sessions.size(), size_t{1});
    QCOMPARE(sessions[0].end, SessionEnd::Closed);
    QVERIFY(!sessions[0].copy.isEmpty());
  }

 private:
  /// What is asked of a worker waits for as long as this lives.
  class Held {
   public:
    explicit Held(Worker& worker) {
      worker.run([gate = m_gate] { gate->acquire(); });
    }
    ~Held() { m_gate->release(); }

   private:
    std::shared_ptr<QSemaphore> m_gate = std::make_shared<QSemaphore>();
  };
  Document& document() { return m_window->session().document(); }
  double floor() { return std::get<double>(document().value(kFloor)); }
  void edit(double kelvin) { QCOMPARE(document().setParameter(kFloor, kelvin), QString()); }
  void saveIsRefused(const QString& why) {
    m_window->action(QStringLiteral("file.save"))->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(m_window->notice()->topic(), QStringLiteral("save"), kLong);
    const QString text = m_window->notice()->text();
    QVERIFY2(text.contains(why, Qt::CaseInsensitive), qPrintable(text));
  }
  void leaveUnsaved(const QString& copies, double kelvin) {
    PluginRegistry plugins;
    Desk desk(plugins, copies);
    desk.document.open(scenes::iceOnPlate(4, 300), {});
    desk.edit(kelvin);
    QCOMPARE(desk.autosave.close(), QString());
  }
  void open() {
    MainWindow::Options options;
    options.project = m_path;
    options.session.autosaveDirectory = m_directory->filePath(QStringLiteral("copies"));
    m_window = std::make_unique<MainWindow>(options);
    m_window->resize(1280, 800);
    m_window->show();
    QVERIFY(QTest::qWaitForWindowExposed(m_window.get()));
    QSignalSpy shown(m_window.get(), &MainWindow::projectShown);
    m_window->start();
    QVERIFY(shown.wait(kLong));
  }

  std::unique_ptr<QTemporaryDir> m_directory;
  std::unique_ptr<MainWindow> m_window;
  QString m_path;
};

int main(int argc, char** argv) {
  requestViewFormat();
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("tst_filewindow"));
  QApplication::setOrganizationName(QStringLiteral("phasesketch"));
  QApplication::setQuitOnLastWindowClosed(false);
  std::setlocale(LC_NUMERIC, "C");
  Theme::apply(application, true);
  TestFileWindow test;
  return QTest::qExec(&test, argc, argv);
}

#include "tst_filewindow.moc"
