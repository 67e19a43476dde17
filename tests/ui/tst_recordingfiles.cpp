// SPDX-License-Identifier: Apache-2.0
// Recordings in files, in the real window: saved beside the project, opened with it, gone on from; and those that are
// not what they should be.
#include "core/io/projectio.h"
#include "core/simulation/engine.h"
#include "core/simulation/runrecord.h"
#include "tests/shared/scenes.h"
#include "tests/ui/samplewindow.h"
#include "ui/session/documentfiles.h"
#include "ui/session/messagelog.h"
#include "ui/session/recordedview.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/session.h"
#include "ui/timeline/transport.h"
#include "ui/window/noticebar.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QTemporaryDir>
#include <QtCore/QTimer>
#include <QtGui/QAction>
#include <QtWidgets/QFileDialog>

#include <map>
#include <memory>

using namespace ps;

namespace {
constexpr uint64_t kFrames = 12;
const Address kFloor{Owner::Wall, "floor", "temperature"};
}  // namespace

class TestRecordingFiles : public SampleWindowTest {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
    open();
    QVERIFY(m_window && m_folder.isValid());
  }
  /// A project of its own, a dozen frames with an edit between them, and the recording beside it.
  void init() {
    m_project = m_folder.filePath(QStringLiteral("scene.json"));
    m_recording = m_folder.filePath(QStringLiteral("scene.psrec"));
    QFile::remove(m_recording);
    saveProject(scenes::iceOnPlate(5, 370), m_project.toStdString());
    QCOMPARE(RecordingFiles::beside(m_project), m_recording);
    load(m_project);
    session().pause();
    toTheStart();
    m_hashes.clear();
    for (uint64_t frame = 1; frame <= kFrames; ++frame) {
      if (frame == 5) document().setParameter(kFloor, 420.0);
      step();
    }
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, kFrames, kLong);
    QSignalSpy saved(&session().recordings(), &RecordingFiles::saved);
    session().recordings().save(m_recording);
    QVERIFY(saved.wait(kLong));
    QCOMPARE(saved.front().at(1).toULongLong(), static_cast<qulonglong>(kFrames + 1));
  }

  /// As it was in the session that made it: looked through, gone on from, to the same bits.
  void whatLiesBesideIsOpenedWithTheProject() {
    saveDocument();
    loadWithRecording(m_project);
    QCOMPARE(m_remark, QString());
    QVERIFY(!session().playing());
    QCOMPARE(session().newest()->stats.frame, kFrames);
    QCOMPARE(hash(), m_hashes[kFrames]);
    QCOMPARE(session().recorded().extent().frames, static_cast<size_t>(kFrames + 1));
    QCOMPARE(session().engine()->history(0).size(), static_cast<size_t>(kFrames + 1));
    session().recorded().showAt(4.0 / 60);
    QTRY_COMPARE_WITH_TIMEOUT(session().snapshot()->stats.frame, uint64_t{4}, kLong);
    picture(QStringLiteral("tst_recordingfiles_opened.png"));
    const uint64_t revision = session().newest()->revision;
    session().engine()->continueFrom(7, false);
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->revision != revision, kLong);
    QCOMPARE(hash(), m_hashes[7]);
    const std::map<uint64_t, uint64_t> first = m_hashes;
    for (int frame = 0; frame < 5; ++frame) step();
    QVERIFY(m_hashes == first);
    QCOMPARE(session().recorded().earlier().size(), size_t{1});
  }

  /// The project was changed since: the run is there, and what goes on goes by the project.
  void anotherVersionOfTheProjectIsSaid() {
    document().setParameter(kFloor, 390.0);
    saveDocument();
    loadWithRecording(m_project);
    QVERIFY2(m_remark.startsWith(QStringLiteral("It is of another version of this project")), qPrintable(m_remark));
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("another version")));
    picture(QStringLiteral("tst_recordingfiles_other.png"));
    QCOMPARE(session().recorded().extent().last, kFrames);
    const uint64_t revision = session().newest()->revision;
    session().engine()->continueFrom(7, false);
    QTRY_VERIFY_WITH_TIMEOUT(session().newest()->revision != revision, kLong);
    const auto floor = [](Engine& engine) {
      return numberOf(engine.document().environment.walls.front().parameters, wallParameters(), "temperature");
    };
    QCOMPARE(onEngine<double>(session(), floor), 390.0);
  }

  /// Without its project: the recording has one.
  void aRecordingAloneOpensItsOwnProject() {
    const QString alone = m_folder.filePath(QStringLiteral("alone.psrec"));
    QFile::remove(alone);
    QVERIFY(QFile::copy(m_recording, alone));
    document().setParameter(kFloor, 350.0);
    QSignalSpy opened(&session().recordings(), &RecordingFiles::opened);
    m_window->openFile(alone);
    QVERIFY(opened.wait(kLong));
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, kFrames, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().newest(), kLong);
    QCOMPARE(document().path(), QString());
    QVERIFY(!document().isDirty());  // it is kept where it came from
    QCOMPARE(hash(), m_hashes[kFrames]);
    QCOMPARE(std::get<double>(document().value(kFloor)), 420.0);
  }

  /// Beside a project of one's own, but not among the samples.
  void recordingsAreLookedForAmongOnesOwn() {
    const auto lookedIn = [this] {
      QString folder;
      QTimer::singleShot(0, qApp, [&folder] {
        auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        QVERIFY(dialog);
        folder = dialog->directory().canonicalPath();
        dialog->reject();
      });
      m_window->action(QStringLiteral("file.openRecording"))->trigger();
      return folder;
    };
    QCOMPARE(lookedIn(), QDir(m_folder.path()).canonicalPath());
    load(kSample);
    QVERIFY(session().files().isSample(document().path()));
    const QString folder = lookedIn();
    QVERIFY(!folder.isEmpty() && folder != QFileInfo(kSample).dir().canonicalPath());
  }

  void whatIsBrokenLeavesTheSceneAlone_data() {
    QTest::addColumn<int>("kept");
    QTest::addColumn<QString>("problem");
    QTest::newRow("header") << 300 << "header is damaged or cut off";
    QTest::newRow("no state") << -1 << "holds no state";
  }
  void whatIsBrokenLeavesTheSceneAlone() {
    QFETCH(int, kept);
    QFETCH(QString, problem);
    QFile file(m_recording);
    QVERIFY(file.open(QIODevice::ReadWrite));
    const QByteArray bytes = file.readAll();
    QVERIFY(file.resize(kept > 0 ? kept : bytes.indexOf("PSBLOCK.") + 20));
    file.close();
    QSignalSpy failed(&session().recordings(), &RecordingFiles::openFailed);
    load(m_project);
    QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, kLong);
    const QString said = failed.front().at(1).toString();
    QVERIFY2(said.contains(m_recording) && said.contains(problem), qPrintable(said));
    QCOMPARE(session().newest()->stats.frame, uint64_t{0});
    step();
    QCOMPARE(session().newest()->stats.frame, uint64_t{1});
  }

  /// The frames before are good: all but the last, from the state of the first.
  void whatIsCutOffOpensUpToThere() {
    QFile file(m_recording);
    QVERIFY(file.resize(file.size() - 10));
    saveDocument();
    loadWithRecording(m_project, kFrames - 1);
    QVERIFY2(m_remark.contains(QStringLiteral("is cut off or damaged after frame 12")), qPrintable(m_remark));
    QCOMPARE(hash(), m_hashes[kFrames - 1]);
  }

  /// Files stay as they were, and so does the run.
  void savingIsGivenUp() {
    const QString path = m_folder.filePath(QStringLiteral("given-up.psrec"));
    QSignalSpy saved(&session().recordings(), &RecordingFiles::saved);
    session().recordings().save(path);
    session().recordings().cancel();
    hash();
    session().recordings().save(m_recording);  // behind it
    QTRY_COMPARE_WITH_TIMEOUT(saved.count(), 1, kLong);
    QCOMPARE(saved.front().front().toString(), m_recording);
    QCOMPARE(QDir(m_folder.path()).entryList({QStringLiteral("given-up*")}), QStringList());
  }

  /// At once, where the notice says how far it is: what is at work ends a little later.
  void givingUpIsTold() {
    RecordingFiles& files = session().recordings();
    const auto text = [this] { return m_window->notice()->text(); };
    Q_EMIT files.working(QStringLiteral("Saving the recording"), 0.1, 9);
    QVERIFY2(text().contains(QStringLiteral("10 %")), qPrintable(text()));
    Q_EMIT files.givingUp();
    QVERIFY2(text().contains(QStringLiteral("Giving up…")), qPrintable(text()));
    Q_EMIT files.ended();
    QVERIFY(!noticeButton(*m_window, QStringLiteral("Cancel")));
  }

  void whatCannotBeWrittenIsSaid() {
    QSignalSpy failed(&session().recordings(), &RecordingFiles::saveFailed);
    session().recordings().save(m_folder.filePath(QStringLiteral("no/such/folder/run.psrec")));
    QVERIFY(failed.wait(kLong));
    QVERIFY(failed.front().at(1).toString().contains(QStringLiteral("the folder does not exist")));
    QVERIFY(m_window->notice()->text().contains(QStringLiteral("folder does not exist")));
  }

  /// A byte of the last state is another: all that is in the file can be read but that.
  void whatCannotBeGoneOnFromIsNotOpened() {
    constexpr qsizetype kHead = 48, kKind = 8, kState = 7;
    QFile file(m_recording);
    QVERIFY(file.open(QIODevice::ReadWrite));
    const QByteArray bytes = file.readAll();
    qsizetype at = bytes.lastIndexOf("PSBLOCK.");
    while (at > 0 && bytes[at + kKind] != kState) at = bytes.lastIndexOf("PSBLOCK.", at - 1);
    const qsizetype place = at + kHead + 200;
    QVERIFY(at > 0 && file.seek(place) && file.putChar(static_cast<char>(~bytes[place])));
    file.close();
    saveDocument();
    QSignalSpy opened(&session().recordings(), &RecordingFiles::opened);
    QStringList said;
    const QObject here;
    connect(&session(), &Session::happened, &here,
            [&said](const EngineEvent& event) { said << QString::fromStdString(event.message); });
    load(m_project);
    const auto refused = [&said] { return !said.filter(QStringLiteral("the recording is not opened")).isEmpty(); };
    QTRY_VERIFY_WITH_TIMEOUT(refused(), kLong);
    hash();
    QCoreApplication::processEvents();
    QCOMPARE(opened.count(), 0);
    QCOMPARE(session().newest()->stats.frame, uint64_t{0});
  }

  /// Closing right after saving: the file is there, and whole.
  void closingWaitsForWhatIsSaved() {
    const QString path = m_folder.filePath(QStringLiteral("closed.psrec"));
    auto other =
        std::make_unique<Session>(Session::Options{.autosave = false, .pluginPaths = {}, .autosaveDirectory = {}});
    QSignalSpy ready(other.get(), &Session::ready);
    other->start();
    QVERIFY(ready.wait(kLong));
    QSignalSpy shown(other.get(), &Session::projectShown);
    QFile::remove(m_recording);
    other->files().open(m_project);
    QVERIFY(shown.wait(kLong));
    other->recordings().save(path);
    other.reset();
    QVERIFY(QFile::exists(path));
  }

  /// The scene is gone before the engine is asked.
  void whatIsNotAnsweredIsSaid() {
    Project none = document().project();
    none.materials[0].properties.values["boiling_temperature"] = 200.0;  // below the melting point
    QSignalSpy failed(&session().recordings(), &RecordingFiles::saveFailed);
    session().engine()->ask([](const Engine&) { QTest::qSleep(200); });  // the session does not know of it yet
    session().engine()->open(none, false);
    session().recordings().save(m_recording);
    QCOMPARE(failed.count(), 0);
    QTRY_COMPARE(failed.count(), 1);
    QCOMPARE(failed.front().at(1).toString(), QStringLiteral("there is no scene that runs"));
    QVERIFY(!failed.front().at(2).toBool());
  }

  /// Its engine has answered, but another project is open before anything is written.
  void whatAnotherRunTookThePlaceOfIsNotSaved() {
    const QString path = m_folder.filePath(QStringLiteral("other.psrec"));
    QSignalSpy failed(&session().recordings(), &RecordingFiles::saveFailed);
    session().recordings().save(path);
    session().engine()->open(scenes::iceOnPlate(4, 400), false);
    hash();  // nothing of that has come here
    QCOMPARE(failed.count(), 0);
    QTRY_COMPARE_WITH_TIMEOUT(failed.count(), 1, kLong);
    QVERIFY2(failed.front().at(1).toString().startsWith(QStringLiteral("another run took the place")),
             qPrintable(failed.front().at(1).toString()));
    QVERIFY(!QFile::exists(path));
    QVERIFY(!m_window->notice()->text().contains(QStringLiteral("It is kept")));
    QVERIFY(!noticeButton(*m_window, QStringLiteral("Save elsewhere…")));
  }

 private:
  uint64_t hash() {
    return onEngine<uint64_t>(session(), [](Engine& engine) { return engine.stateHash(); });
  }
  void step() {
    session().engine()->stepOnce();
    const uint64_t now = hash();
    session().engine()->recording().settle();
    m_hashes[session().newest()->stats.frame] = now;
  }
  void load(const QString& path) {
    QSignalSpy shown(&session(), &Session::projectShown);
    session().files().open(path);
    QVERIFY(shown.wait(kLong));
  }
  void loadWithRecording(const QString& path, uint64_t last = kFrames) {
    QSignalSpy opened(&session().recordings(), &RecordingFiles::opened);
    load(path);
    QTRY_COMPARE_WITH_TIMEOUT(opened.count(), 1, kLong);
    m_remark = opened.front().at(3).toString();
    QTRY_COMPARE_WITH_TIMEOUT(session().newest()->stats.frame, last, kLong);
    QTRY_VERIFY_WITH_TIMEOUT(view()->snapshot() == session().newest(), kLong);
  }
  void saveDocument() {
    QSignalSpy saved(&session().files(), &DocumentFiles::saved);
    session().files().save(m_project);
    QVERIFY(saved.wait(kLong));
  }

  QTemporaryDir m_folder;
  QString m_project, m_recording, m_remark;
  std::map<uint64_t, uint64_t> m_hashes;
};

QTEST_MAIN(TestRecordingFiles)
#include "tst_recordingfiles.moc"
