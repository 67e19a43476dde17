// SPDX-License-Identifier: Apache-2.0
// A file that is not this window's alone: another window has it open, another program has written it; and what it was
// saved as before.
#include "core/io/filelock.h"
#include "core/io/outputfile.h"
#include "tests/shared/scenes.h"
#include "tests/ui/desk.h"
#include "ui/session/filewatch.h"
#include "ui/session/savejob.h"
#include "ui/session/versions.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QLockFile>
#include <QtCore/QSettings>
#include <QtTest/QSignalSpy>

using namespace ps;

namespace {

constexpr int kLong = 30000;  // ms
constexpr int kSigns = 1200;  // ms in which a sign of the file would have led to a look

}  // namespace

class TestFiles : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    qRegisterMetaType<ps::SaveRefusal>();
    qRegisterMetaType<ps::OutsideChange>();
    m_plugins = std::make_unique<PluginRegistry>();
  }
  void init() {
    m_directory = std::make_unique<QTemporaryDir>();
    m_path = m_directory->filePath(QStringLiteral("scene.json"));
    saveProject(scenes::iceOnPlate(4, 300), m_path.toStdString());
  }

  /// A file that stands there says nothing; a lock that is held does, until its holder ends or it is taken over.
  void locks() {
    const std::string path = m_directory->filePath(QStringLiteral("lock")).toStdString();
    writeFileAtomically(path, "1\nphasesketch\nanother-host\n\n");
    {
      FileLock mine(path, "me");
      QVERIFY(mine.held() && !mine.busy() && FileLock::isHeld(path));
      FileLock other(path, "you");
      QVERIFY(!other.held() && other.busy());
      QCOMPARE(other.holder(), std::string("me"));
      other.takeOver();
      QVERIFY(other.held() && !mine.held());
      QVERIFY(FileLock(path).busy());
    }
    QVERIFY(!QFile::exists(QString::fromStdString(path)));
    const FileLock nowhere(m_directory->filePath(QStringLiteral("missing/lock")).toStdString());
    QVERIFY(!nowhere.held() && !nowhere.busy());
  }

  void aSecondWindowLooksOnAndTakesOver() {
    Desk first(*m_plugins, copies(1)), second(*m_plugins, copies(2));
    open(first);
    QSignalSpy elsewhere(&second.files, &DocumentFiles::openElsewhere);
    open(second);
    QCOMPARE(elsewhere.count(), 1);
    QCOMPARE(elsewhere[0].at(1).toString(), QString());  // the same user here
    second.edit(310);
    QCOMPARE(save(second), SaveRefusal::Elsewhere);
    first.edit(305);
    QCOMPARE(save(first), SaveRefusal::None);
    QSignalSpy took(&second.files, &DocumentFiles::tookOver);
    second.files.takeOver();
    QVERIFY(took.wait() && took[0].at(1).toBool());
    QCOMPARE(save(second), SaveRefusal::Changed);  // by the first, meanwhile
    QCOMPARE(save(second, true), SaveRefusal::None);
    first.edit(306);
    QCOMPARE(save(first), SaveRefusal::Elsewhere);
    QCOMPARE(floorOnDisk(), 310.0);
  }

  void aWindowThatWasClosedOrShowsAnotherSceneLetsGo() {
    Desk second(*m_plugins, copies(2));
    {
      Desk first(*m_plugins, copies(1));
      open(first);
      first.files.newProject();
      first.worker.wait();  // the job that made the lock may have it a moment longer
      QSignalSpy elsewhere(&second.files, &DocumentFiles::openElsewhere);
      open(second);
      QCOMPARE(elsewhere.count(), 0);
      open(second);  // its own once more
      QCOMPARE(elsewhere.count(), 0);
      second.files.newProject();
      second.worker.wait();
      open(first);
    }
    second.worker.wait();
    open(second);
    second.edit(311);
    QCOMPARE(save(second), SaveRefusal::None);
    QCOMPARE(QDir(m_directory->path()).entryList(QDir::Files | QDir::Hidden).size(), 2);  // scene and lock
  }

  void theSampleIsEverybodys() {
    Desk first(*m_plugins, copies(1)), second(*m_plugins, copies(2));
    first.files.setSamples(m_directory->path() + QStringLiteral("/./scene.json"));  // whatever way leads to it
    open(first);
    QSignalSpy elsewhere(&second.files, &DocumentFiles::openElsewhere);
    open(second);
    QCOMPARE(elsewhere.count(), 0);
  }

  /// No lock can be made for a name of this length: no reason not to open.
  void whereNoLockCanBeMadeTheProjectOpens() {
    m_path = m_directory->filePath(QString(240, QLatin1Char('x')) + QStringLiteral(".json"));
    saveUnder(m_directory->filePath(QStringLiteral("scene.json")), m_path);
    Desk desk(*m_plugins, copies(1));
    QSignalSpy elsewhere(&desk.files, &DocumentFiles::openElsewhere);
    open(desk);
    QCOMPARE(elsewhere.count(), 0);
    QCOMPARE(desk.document.path(), m_path);
  }

  void anotherProgramsChangeIsNotReplacedSilently() {
    Desk desk(*m_plugins, copies(1));
    open(desk);
    desk.edit(310);
    writeFileAtomically(m_path.toStdString(), writeProject(scenes::iceOnPlate(4, 320)));
    QCOMPARE(save(desk), SaveRefusal::Changed);
    QCOMPARE(floorOnDisk(), 320.0);
    QVERIFY(desk.document.isDirty());
    QCOMPARE(save(desk, true), SaveRefusal::None);
    QCOMPARE(floorOnDisk(), 310.0);
    // What the other program wrote is kept.
    QCOMPARE(floorOf(versions::of(m_path).at(0).file), 320.0);
    desk.edit(311);
    QCOMPARE(save(desk), SaveRefusal::None);
  }

  /// Another time, and the same bytes: nobody has changed anything.
  void aFileThatWasOnlyTouchedIsNoChange() {
    Desk desk(*m_plugins, copies(1));
    open(desk);
    desk.edit(310);
    const std::string bytes = readFile();
    writeFileAtomically(m_path.toStdString(), bytes);
    QCOMPARE(save(desk), SaveRefusal::None);
  }

  /// Without a save, once for everything that is written, however it is written.
  void anotherProgramsChangeIsNoticed_data() {
    QTest::addColumn<bool>("inPlace");
    QTest::newRow("another file in its place") << false;
    QTest::newRow("the same file") << true;
  }
  void anotherProgramsChangeIsNoticed() {
    QFETCH(bool, inPlace);
    Desk desk(*m_plugins, copies(1));
    const FileWatch watch(desk.document, desk.files);
    QSignalSpy outside(&desk.files, &DocumentFiles::changedOutside);
    open(desk);
    const std::string before = readFile();
    int told = 0;
    for (const double kelvin : {320.0, 321.0}) {
      writeOutside(writeProject(scenes::iceOnPlate(4, kelvin)), inPlace);
      ++told;  // which the comparison would do again and again
      QTRY_COMPARE_WITH_TIMEOUT(outside.count(), told, kLong);
      QCOMPARE(outside.last().at(0).toString(), m_path);
      QCOMPARE(outside.last().at(1).value<OutsideChange>(), OutsideChange::Written);
    }
    writeOutside(readFile(), inPlace);  // nothing new
    QTest::qWait(kSigns);
    QCOMPARE(outside.count(), told);
    writeOutside(before, inPlace);
    QTRY_COMPARE_WITH_TIMEOUT(outside.count(), told + 1, kLong);
    QCOMPARE(outside.last().at(1).value<OutsideChange>(), OutsideChange::None);
    QVERIFY(!desk.document.isDirty());
  }

  void aFileThatIsTakenAwayIsNoticed() {
    Desk desk(*m_plugins, copies(1));
    const FileWatch watch(desk.document, desk.files);
    QSignalSpy outside(&desk.files, &DocumentFiles::changedOutside);
    open(desk);
    QVERIFY(QFile::remove(m_path));
    QTRY_COMPARE_WITH_TIMEOUT(outside.count(), 1, kLong);
    QCOMPARE(outside[0].at(1).value<OutsideChange>(), OutsideChange::Gone);
    QVERIFY(desk.document.isDirty());  // no file holds it
    QCOMPARE(save(desk), SaveRefusal::None);
    QCOMPARE(floorOnDisk(), 300.0);
    QVERIFY(!desk.document.isDirty());
  }

  /// Saves, copies of unsaved work and locks are ours, and a file that was only touched holds what it held.
  void nothingIsNoticedWhereNothingIsWrong() {
    Desk desk(*m_plugins, copies(1));
    const FileWatch watch(desk.document, desk.files);
    QSignalSpy outside(&desk.files, &DocumentFiles::changedOutside);
    open(desk);
    for (const double kelvin : {310.0, 311.0}) {
      desk.edit(kelvin);
      desk.autosave.saveNow();
      QSignalSpy saved(&desk.files, &DocumentFiles::saved);
      for (int k = 0; k < 2; ++k) {
        desk.files.save(m_path);
        desk.files.look();
      }
      QTRY_COMPARE_WITH_TIMEOUT(saved.count(), 2, kLong);
      QTest::qWait(kSigns);
    }
    writeOutside(readFile(), false);
    writeOutside("{}", false, m_directory->filePath(QStringLiteral("neighbour.json")));
    QTest::qWait(kSigns);
    const QString other = m_directory->filePath(QStringLiteral("other.json"));
    desk.files.save(other);
    QTRY_COMPARE(desk.document.path(), other);
    writeOutside(writeProject(scenes::iceOnPlate(4, 320)), false);  // which is not ours any more
    QTest::qWait(kSigns);
    QCOMPARE(outside.count(), 0);
  }

  /// What was seen and given up is replaced without asking; what comes after it is not.
  void whatIsKeptReplacesWhatWasSeen() {
    Desk desk(*m_plugins, copies(1));
    QSignalSpy outside(&desk.files, &DocumentFiles::changedOutside);
    open(desk);
    for (const double kelvin : {320.0, 321.0}) {
      writeOutside(writeProject(scenes::iceOnPlate(4, kelvin)), false);
      outside.clear();
      desk.files.look();
      QVERIFY(outside.wait());
      desk.files.keepOurs();
      QVERIFY(desk.document.isDirty());
      QCOMPARE(save(desk), SaveRefusal::None);
      QVERIFY(!desk.document.isDirty());
      QCOMPARE(floorOnDisk(), 300.0);
      QCOMPARE(floorOf(versions::of(m_path).at(0).file), kelvin);
      QTest::qSleep(2);  // their names are times
    }
    writeOutside(writeProject(scenes::iceOnPlate(4, 322)), false);
    outside.clear();
    desk.files.look();
    QVERIFY(outside.wait());
    desk.files.keepOurs();
    writeOutside(writeProject(scenes::iceOnPlate(4, 323)), false);
    QCOMPARE(save(desk), SaveRefusal::Changed);
    QCOMPARE(floorOnDisk(), 323.0);
  }

  /// The second is asked for before the first has been heard of.
  void savesInARowAreNobodyElses() {
    Desk desk(*m_plugins, copies(1));
    open(desk);
    QSignalSpy saved(&desk.files, &DocumentFiles::saved), refused(&desk.files, &DocumentFiles::saveRefused);
    for (const double kelvin : {310.0, 311.0, 312.0}) {
      desk.edit(kelvin);
      desk.files.save(m_path);
    }
    const QString other = m_directory->filePath(QStringLiteral("other.json"));
    desk.files.save(other);
    desk.files.save(other);
    QTRY_COMPARE(saved.count(), 5);
    QCOMPARE(refused.count(), 0);
    QCOMPARE(desk.document.path(), other);
  }

  /// What is restored is of the file as the session knew it, not as it is by now.
  void restoredWorkDoesNotReplaceWhatCameSince() {
    {
      Desk desk(*m_plugins, copies(1));
      open(desk);
      desk.edit(310);
      QCOMPARE(desk.autosave.close(), QString());
    }
    writeFileAtomically(m_path.toStdString(), writeProject(scenes::iceOnPlate(4, 320)));
    Desk desk(*m_plugins, copies(1));
    QSignalSpy opened(&desk.files, &DocumentFiles::opened);
    desk.files.reopen(desk.autosave.leftBehind().at(0));
    QVERIFY(opened.wait());
    QCOMPARE(save(desk), SaveRefusal::Changed);
    QCOMPARE(floorOnDisk(), 320.0);
  }

  /// Left by a program that was killed while it noted a recent file: nobody waits for it, half a minute long.
  void aLeftLockOfTheSettingsHoldsNobodyUp() {
    const QString lock = QSettings().fileName() + QStringLiteral(".lock");
    QSettings().setValue(QStringLiteral("made"), true);
    {
      QLockFile held(lock);
      QVERIFY(held.tryLock());
      const Desk desk(*m_plugins, copies(1));
      QVERIFY(QFile::exists(lock));
    }
    QFile left(lock);
    QVERIFY(left.open(QIODevice::WriteOnly));
    left.close();
    QElapsedTimer clock;
    clock.start();
    Desk desk(*m_plugins, copies(1));
    open(desk);
    QVERIFY2(clock.elapsed() < 10000, qPrintable(QString::number(clock.elapsed())));
  }

  void theLastFiveVersionsAreKept() {
    Desk desk(*m_plugins, copies(1));
    open(desk);
    for (int k = 1; k <= 7; ++k) {
      QTest::qSleep(2);  // their names are times
      desk.edit(300 + k);
      QCOMPARE(save(desk), SaveRefusal::None);
    }
    const auto kept = versions::of(m_path);
    QCOMPARE(kept.size(), size_t{versions::kKept});
    for (size_t k = 0; k < kept.size(); ++k) {
      QCOMPARE(floorOf(kept[k].file), 306.0 - static_cast<double>(k));
      QVERIFY(kept[k].time.isValid() && kept[k].size > 100);
    }
    QSignalSpy opened(&desk.files, &DocumentFiles::opened);
    desk.files.openVersion(kept[2].file);
    QVERIFY(opened.wait());
    QCOMPARE(std::get<double>(desk.document.value(kFloor)), 304.0);
    QCOMPARE(desk.document.path(), m_path);
    QVERIFY(desk.document.isDirty());
    QCOMPARE(floorOnDisk(), 307.0);
    QCOMPARE(save(desk), SaveRefusal::None);
    QCOMPARE(floorOnDisk(), 304.0);
    QCOMPARE(floorOf(versions::of(m_path).at(0).file), 307.0);
  }

 private:
  QString copies(int n) const { return m_directory->filePath(QStringLiteral("copies-%1").arg(n)); }
  std::string readFile() const {
    QFile file(m_path);
    return file.open(QIODevice::ReadOnly) ? file.readAll().toStdString() : std::string();
  }
  double floorOf(const QString& path) {
    Document document;
    document.setPlugins(m_plugins.get());
    document.open(loadProject(path.toStdString(), *m_plugins).project, {});
    return std::get<double>(document.value(kFloor));
  }
  double floorOnDisk() { return floorOf(m_path); }
  void writeOutside(const std::string& bytes, bool inPlace, const QString& path = {}) const {
    const QString to = path.isEmpty() ? m_path : path;
    if (!inPlace) {
      writeFileAtomically(to.toStdString(), bytes);
      return;
    }
    QFile file(to);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(QByteArray::fromStdString(bytes)), static_cast<qint64>(bytes.size()));
  }
  static void saveUnder(const QString& from, const QString& to) { QVERIFY(QFile::copy(from, to)); }
  void open(Desk& desk) {
    QSignalSpy opened(&desk.files, &DocumentFiles::opened);
    desk.files.open(m_path);
    QVERIFY(opened.wait());
  }
  SaveRefusal save(Desk& desk, bool anyway = false) {
    QSignalSpy saved(&desk.files, &DocumentFiles::saved), refused(&desk.files, &DocumentFiles::saveRefused);
    desk.files.save(m_path, anyway);
    desk.worker.wait();
    QCoreApplication::processEvents();
    if (refused.count() + saved.count() != 1) qFatal("neither saved nor refused");
    return refused.isEmpty() ? SaveRefusal::None : refused[0].at(1).value<SaveRefusal>();
  }

  std::unique_ptr<PluginRegistry> m_plugins;
  std::unique_ptr<QTemporaryDir> m_directory;
  QString m_path;
};

QTEST_GUILESS_MAIN(TestFiles)
#include "tst_files.moc"
