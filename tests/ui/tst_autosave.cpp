// SPDX-License-Identifier: Apache-2.0
// Copies of unsaved work: when they are written, what they hold, and when they go.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "tests/shared/scenes.h"
#include "ui/document/document.h"
#include "ui/session/autosave.h"
#include "ui/session/documentfiles.h"
#include "ui/session/worker.h"

#include <QtCore/QDir>
#include <QtCore/QTemporaryDir>
#include <QtTest/QSignalSpy>
#include <QtTest/QTest>

#include <csignal>
#include <sys/resource.h>

using namespace ps;

namespace {

const Address kFloor{Owner::Wall, "floor", "temperature"};

/// A document with its files and its autosave, as a session has them.
struct Desk {
  Desk(PluginRegistry& plugins, const QString& directory)
      : files(document, worker), autosave(document, worker, directory) {
    document.setPlugins(&plugins);
    QObject::connect(&files, &DocumentFiles::reopened, &autosave, &Autosave::takeOver);
  }
  ~Desk() { worker.wait(); }
  void edit(double kelvin) { QCOMPARE(document.setParameter(kFloor, kelvin), QString()); }
  std::string text() const { return writeProject(document.project()); }

  Document document;
  Worker worker;
  DocumentFiles files;
  Autosave autosave;
};

}  // namespace

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
    own = QDir(m_copies).filePath(own.replace(QStringLiteral(".lock"), QStringLiteral(".json")));
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

  void aSavedProjectReopensAsItWasSeen() {
    const QString path = m_directory->filePath(QStringLiteral("scene.json"));
    Project project = scenes::iceOnPlate(5, 370);
    project.view.pinned = {"wall/floor/temperature"};
    saveProject(project, path.toStdString());
    ViewState seen;
    seen.camera = ViewCamera{{0.1, 0.25, -0.3}, 0.75, -120, 60};
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
