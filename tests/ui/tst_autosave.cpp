// SPDX-License-Identifier: Apache-2.0
// Copies of unsaved work: when they are written, what they hold, and when they go.
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "tests/shared/scenes.h"
#include "tests/ui/desk.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <csignal>
#include <sys/resource.h>

using namespace ps;

class TestAutosave : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }

  void init() {
    m_directory = std::make_unique<QTemporaryDir>();
    m_copies = m_directory->filePath(QStringLiteral("copies"));
  }

  void unsavedWorkIsKept() {
    std::string text;
    {
      Desk desk(*m_plugins, m_copies);
      desk.document.open(scenes::iceOnPlate(5, 370), QStringLiteral("/nowhere/scene.json"));
      desk.edit(351);
      QSignalSpy written(&desk.autosave, &Autosave::autosaved);
      desk.autosave.saveNow();
      QVERIFY(written.wait());
      Desk other(*m_plugins, m_copies);
      QVERIFY(other.autosave.leftBehind().empty());  // still running
      QCOMPARE(desk.autosave.close(), QString());
      text = desk.text();
    }
    const Desk desk(*m_plugins, m_copies);
    const auto sessions = desk.autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QCOMPARE(sessions[0].end, SessionEnd::Closed);
    QCOMPARE(sessions[0].path, QStringLiteral("/nowhere/scene.json"));
    QCOMPARE(writeProject(loadProject(sessions[0].copy.toStdString(), *m_plugins).project), text);
    Autosave::discard(sessions[0]);
    QVERIFY(desk.autosave.leftBehind().empty());
  }

  /// What a note says fits the buffers of any writer, which is where a full disk went unnoticed.
  void aFullDiskIsNoticedByTheNoteAlone() {
    Desk desk(*m_plugins, m_copies);
    desk.document.open(scenes::iceOnPlate(5, 370), QStringLiteral("/nowhere/scene.json"));
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit old{};
    QCOMPARE(::getrlimit(RLIMIT_FSIZE, &old), 0);
    const rlimit tight{20, old.rlim_max};
    QCOMPARE(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    const QString problem = desk.autosave.close();
    ::setrlimit(RLIMIT_FSIZE, &old);
    QVERIFY2(problem.contains(QStringLiteral("not saved")), qPrintable(problem));
    QVERIFY(QDir(m_copies).entryList({QStringLiteral("*.note*")}).isEmpty());
    QCOMPARE(desk.autosave.close(), QString());
  }

  /// After "Save as" a copy that stayed behind would be restored into the file before, and overwrite it.
  void savingTakesTheCopyAway() {
    Desk desk(*m_plugins, m_copies);
    desk.autosave.start();
    desk.document.open(scenes::iceOnPlate(5, 370), QStringLiteral("/nowhere/scene.json"));
    desk.edit(351);
    QSignalSpy written(&desk.autosave, &Autosave::autosaved);
    desk.autosave.saveNow();
    QVERIFY(written.wait());
    const QString path = m_directory->filePath(QStringLiteral("copy.json"));
    QSignalSpy saved(&desk.files, &DocumentFiles::saved);
    desk.files.save(path);
    QVERIFY(saved.wait());
    const auto verifyNote = [&](const QString& file) {
      desk.worker.wait();  // the note went its way when the document heard of the file
      const QDir copies(m_copies);
      QCOMPARE(copies.entryList({QStringLiteral("*.json")}), QStringList());
      QFile note(copies.filePath(copies.entryList({QStringLiteral("*.note")}).value(0)));
      QVERIFY(note.open(QIODevice::ReadOnly));
      const QByteArray text = note.readAll();
      QVERIFY2(text.contains(file.toUtf8()), text.constData());
      QVERIFY2(text.contains("\"unsaved\": false"), text.constData());
    };
    verifyNote(path);
    desk.edit(355);  // saved elsewhere before a copy of it was made
    QCoreApplication::processEvents();
    const QString other = m_directory->filePath(QStringLiteral("other.json"));
    desk.files.save(other);
    QVERIFY(saved.wait());
    verifyNote(other);
  }

  /// Closed while it was still starting: what the session before it had open is still the newest.
  void aSessionThatOpenedNothingLeavesNothing() {
    {
      Desk desk(*m_plugins, m_copies);
      QCOMPARE(desk.autosave.close(), QString());
    }
    QVERIFY(Desk(*m_plugins, m_copies).autosave.leftBehind().empty());
  }

  void replacedWorkIsKeptAndComesBack() {
    Desk desk(*m_plugins, m_copies);
    desk.document.open(scenes::iceOnPlate(5, 370), QStringLiteral("/nowhere/scene.json"));
    desk.edit(352);
    const std::string text = desk.text();
    std::shared_ptr<const ReplacedWork> replaced;
    connect(&desk.autosave, &Autosave::workReplaced, this, [&](const auto& work) { replaced = work; });
    desk.files.newProject();
    QVERIFY(!desk.document.isDirty());
    QVERIFY(replaced);
    desk.worker.wait();
    auto sessions = desk.autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QCOMPARE(sessions[0].end, SessionEnd::Replaced);
    QCOMPARE(sessions[0].path, QStringLiteral("/nowhere/scene.json"));
    QCOMPARE(writeProject(loadProject(sessions[0].copy.toStdString(), *m_plugins).project), text);

    QSignalSpy written(&desk.autosave, &Autosave::autosaved);
    desk.files.bringBack(*replaced);
    QCOMPARE(desk.text(), text);
    QCOMPARE(desk.document.path(), QStringLiteral("/nowhere/scene.json"));
    QVERIFY(desk.document.isDirty());
    QVERIFY(written.wait());
    QVERIFY(!QFile::exists(sessions[0].copy));  // this session has a copy of its own by now
  }

  void savedWorkIsReplacedWithoutACopy() {
    Desk desk(*m_plugins, m_copies);
    desk.document.open(scenes::iceOnPlate(5, 370), {});
    desk.files.newProject();
    desk.worker.wait();
    QVERIFY(desk.autosave.leftBehind().empty());
  }

  void aFailedCopyIsToldOnceAndTriedAgain() {
    Desk desk(*m_plugins, m_copies);
    desk.document.open(scenes::iceOnPlate(5, 370), {});
    desk.edit(353);
    QVERIFY(QDir(m_copies).removeRecursively());
    QSignalSpy failed(&desk.autosave, &Autosave::failed), written(&desk.autosave, &Autosave::autosaved);
    desk.autosave.saveNow();
    QVERIFY(failed.wait());
    desk.autosave.saveNow();  // as the timer does
    desk.worker.wait();
    QCoreApplication::processEvents();
    QCOMPARE(failed.count(), 1);
    QVERIFY(QDir().mkpath(m_copies));
    desk.autosave.saveNow();
    QVERIFY(written.wait());
  }

  void closeSaysWhatCouldNotBeKept() {
    {
      Desk desk(*m_plugins, m_copies);
      desk.document.open(scenes::iceOnPlate(5, 370), {});
      desk.edit(354);
      QVERIFY(QDir(m_copies).removeRecursively());
      QVERIFY(!desk.autosave.close().isEmpty());
      QVERIFY(QDir().mkpath(m_copies));
      QCOMPARE(desk.autosave.close(), QString());
    }
    QCOMPARE(Desk(*m_plugins, m_copies).autosave.leftBehind().size(), size_t{1});
  }

  void aCopyTakenOverGoesOnlyWhenThereIsAnother() {
    const AutosavedSession left = leave(355);
    Desk desk(*m_plugins, m_copies);
    // A folder where this session's own copy would go: it cannot be written.
    QString own = QDir(m_copies).entryList({QStringLiteral("*.lock")}).constFirst();
    own = QDir(m_copies).filePath(own.replace(QStringLiteral(".lock"), QStringLiteral(".1.json")));
    QVERIFY(QDir().mkpath(own + QStringLiteral("/full")));
    QSignalSpy failed(&desk.autosave, &Autosave::failed), written(&desk.autosave, &Autosave::autosaved);
    desk.files.reopen(left);
    QVERIFY(failed.wait());
    QCOMPARE(std::get<double>(desk.document.value(kFloor)), 355.0);
    QVERIFY(QFile::exists(left.copy));
    QVERIFY(desk.autosave.leftBehind().empty());  // not on offer: it is open
    QVERIFY(QDir(own).removeRecursively());
    desk.autosave.saveNow();
    QVERIFY(written.wait());
    QVERIFY(!QFile::exists(left.copy));
    QVERIFY(QFile::exists(own));
  }

  void aDamagedCopyStays() {
    const AutosavedSession left = leave(356);
    QFile copy(left.copy);
    QVERIFY(copy.open(QIODevice::WriteOnly));
    copy.write("{");
    copy.close();
    Desk desk(*m_plugins, m_copies);
    QSignalSpy failed(&desk.files, &DocumentFiles::openFailed), opened(&desk.files, &DocumentFiles::opened);
    desk.files.reopen(left);
    QVERIFY(failed.wait());
    desk.files.newProject();
    QCOMPARE(opened.count(), 1);
    desk.worker.wait();
    QVERIFY(QFile::exists(left.copy));
    QCOMPARE(desk.autosave.leftBehind().size(), size_t{1});
  }

  /// A full disk, or a kill at the wrong time: the copy is what counts.
  void aCopyIsOfferedWhateverBecameOfItsNote_data() {
    QTest::addColumn<QString>("damaged");
    QTest::addColumn<QByteArray>("bytes");
    QTest::newRow("empty note") << QStringLiteral(".note") << QByteArray();
    QTest::newRow("half a note") << QStringLiteral(".note") << QByteArray("{\"path\": \"/now");
    QTest::newRow("no note") << QStringLiteral(".note") << QByteArray("gone");
    QTest::newRow("empty lock") << QStringLiteral(".lock") << QByteArray();
    QTest::newRow("lock of another host") << QStringLiteral(".lock") << QByteArray("1\nphasesketch\nelsewhere\n\n");
  }
  void aCopyIsOfferedWhateverBecameOfItsNote() {
    QFETCH(QString, damaged);
    QFETCH(QByteArray, bytes);
    const AutosavedSession left = leave(357);
    QFile file(left.stem + damaged);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
    file.close();
    if (bytes == "gone") QVERIFY(file.remove());
    Desk desk(*m_plugins, m_copies);
    const auto sessions = desk.autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QCOMPARE(sessions[0].copy, left.copy);
    QVERIFY(!sessions[0].title.isEmpty() && sessions[0].time.isValid());
    QSignalSpy opened(&desk.files, &DocumentFiles::opened);
    desk.files.reopen(sessions[0]);
    QVERIFY(opened.wait());
    QCOMPARE(std::get<double>(desk.document.value(kFloor)), 357.0);
  }

  /// The copy was written, and the program killed before its note was.
  void aCopyThatIsNewerThanItsNoteIsOffered() {
    Desk desk(*m_plugins, m_copies);
    desk.document.open(scenes::iceOnPlate(5, 370), {});
    desk.autosave.saveNow();
    desk.worker.wait();
    const QString stem = Crashed::stemIn(m_copies);
    desk.edit(358);
    saveProject(desk.document.project(), (stem + QStringLiteral(".9.json")).toStdString());
    const Crashed crashed(m_copies);
    const auto sessions = Desk(*m_plugins, crashed.copies()).autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QVERIFY(sessions[0].copy.endsWith(QStringLiteral(".9.json")));
  }

  /// What a killed program was writing goes at the next start, beside projects too; what one is writing stays.
  void temporariesOfKilledProgramsGo() {
    const QString path = m_directory->filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(5, 370), path.toStdString());
    {
      Desk desk(*m_plugins, m_copies);
      QSignalSpy opened(&desk.files, &DocumentFiles::opened);
      desk.files.open(path);
      QVERIFY(opened.wait());
      desk.edit(359);
      QCOMPARE(desk.autosave.close(), QString());
    }
    const auto parts = [this] {
      return QDir(m_copies).entryList({QStringLiteral("*.part-*")}) +
             QDir(m_directory->path()).entryList({QStringLiteral("*.part-*")});
    };
    OutputFile written(path.toStdString());
    written.write("{");
    written.flush();
    const QStringList live = parts();
    QCOMPARE(live.size(), 1);
    for (const QString& left : {path, m_copies + QStringLiteral("/1.2.json"), m_copies + QStringLiteral("/1.note")}) {
      QFile part(left + QStringLiteral(".part-aB3dEf"));
      QVERIFY(part.open(QIODevice::WriteOnly) && part.write("{") == 1);
    }
    Desk desk(*m_plugins, m_copies);
    desk.worker.wait();
    QCOMPARE(parts(), live);
    written.finish();
  }

  /// Edited right after Ctrl+S, then a crash: the copy is of before, the file of after.
  void nothingOlderThanTheFileIsOffered_data() {
    QTest::addColumn<bool>("replaced");   // by the save, before the crash
    QTest::addColumn<bool>("otherwise");  // another program wrote the file since
    QTest::addColumn<size_t>("offered");
    QTest::newRow("saved") << true << false << size_t{0};
    QTest::newRow("not yet replaced") << false << false << size_t{1};
    QTest::newRow("changed elsewhere since") << true << true << size_t{1};
  }
  void nothingOlderThanTheFileIsOffered() {
    QFETCH(bool, replaced);
    QFETCH(bool, otherwise);
    QFETCH(size_t, offered);
    const QString path = m_directory->filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(5, 370), path.toStdString());
    Desk desk(*m_plugins, m_copies);
    QSignalSpy opened(&desk.files, &DocumentFiles::opened), copied(&desk.autosave, &Autosave::autosaved);
    desk.files.open(path);
    QVERIFY(opened.wait());
    desk.edit(351);
    desk.autosave.saveNow();
    QVERIFY(copied.wait());
    desk.edit(352);
    // As the worker does it, as far as the crash lets it.
    const std::string bytes = desk.text();
    desk.autosave.aroundSave().before(path, {true, bytes.size(), 0, 0, hashOf(bytes)});
    if (replaced) writeFileAtomically(path.toStdString(), bytes);
    if (otherwise) writeFileAtomically(path.toStdString(), bytes + ' ');
    desk.edit(353);
    const Crashed crashed(m_copies);
    Desk next(*m_plugins, crashed.copies());
    QVERIFY(offered > 0 || next.autosave.leftBehind().empty() || next.autosave.leftBehind()[0].copy.isEmpty());
    next.worker.wait();
    QCOMPARE(QDir(crashed.copies()).entryList({QStringLiteral("*.json")}).size(), static_cast<qsizetype>(offered));
    if (offered == 0) return;
    const auto sessions = next.autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QVERIFY(!sessions[0].copy.isEmpty());
  }

  /// Saved, then edited: the copy of the edit is newer than the file, and is offered.
  void workAfterASaveIsOffered() {
    const QString path = m_directory->filePath(QStringLiteral("scene.json"));
    Desk desk(*m_plugins, m_copies);
    desk.document.open(scenes::iceOnPlate(5, 370), {});
    desk.edit(351);
    QSignalSpy saved(&desk.files, &DocumentFiles::saved), copied(&desk.autosave, &Autosave::autosaved);
    desk.files.save(path);
    desk.edit(352);  // before the save was heard of
    QVERIFY(saved.wait());
    QVERIFY(desk.document.isDirty());
    QVERIFY(Desk(*m_plugins, Crashed(m_copies).copies()).autosave.leftBehind().empty());  // nothing but the file yet
    desk.autosave.saveNow();
    QVERIFY(copied.wait());
    const Crashed crashed(m_copies);
    const auto sessions = Desk(*m_plugins, crashed.copies()).autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QCOMPARE(sessions[0].path, path);
    const Project copy = loadProject(sessions[0].copy.toStdString(), *m_plugins).project;
    QCOMPARE(writeProject(copy), desk.text());
  }

  void aSavedProjectReopensAsItWasSeen() {
    const QString path = m_directory->filePath(QStringLiteral("scene.json"));
    Project project = scenes::iceOnPlate(5, 370);
    project.view.pinned = {"wall/floor/temperature"};
    saveProject(project, path.toStdString());
    ViewState seen;
    seen.camera = ViewCamera{{0.1, 0.25, -0.3}, 0.75, -120, 60};
    seen.section = ViewSection{"z", {0.01, 0.2, -0.05}, true};
    {
      Desk desk(*m_plugins, m_copies);
      QSignalSpy opened(&desk.files, &DocumentFiles::opened);
      desk.files.open(path);
      QVERIFY(opened.wait());
      desk.document.setView(seen);
      desk.document.setColour("phase");
      QVERIFY(!desk.document.isDirty());
      QCOMPARE(desk.autosave.close(), QString());
    }
    Desk desk(*m_plugins, m_copies);
    const auto sessions = desk.autosave.leftBehind();
    QCOMPARE(sessions.size(), size_t{1});
    QCOMPARE(sessions[0].copy, QString());
    QSignalSpy opened(&desk.files, &DocumentFiles::opened);
    desk.files.reopen(sessions[0]);
    QVERIFY(opened.wait());
    const ViewState& view = desk.document.project().view;
    QVERIFY(view.camera == seen.camera);
    QVERIFY(view.section == seen.section);
    QCOMPARE(view.colour, std::string("phase"));
    QCOMPARE(view.pinned, project.view.pinned);
    QVERIFY(!desk.document.isDirty());
    QCOMPARE(desk.document.path(), path);
  }

 private:
  /// A session that was closed with the floor at this temperature, K, unsaved.
  AutosavedSession leave(double kelvin) {
    {
      Desk desk(*m_plugins, m_copies);
      desk.document.open(scenes::iceOnPlate(5, 370), {});
      desk.edit(kelvin);
      desk.autosave.close();
    }
    const Desk desk(*m_plugins, m_copies);
    return desk.autosave.leftBehind().at(0);
  }

  std::unique_ptr<PluginRegistry> m_plugins;
  std::unique_ptr<QTemporaryDir> m_directory;
  QString m_copies;
};

QTEST_GUILESS_MAIN(TestAutosave)
#include "tst_autosave.moc"
