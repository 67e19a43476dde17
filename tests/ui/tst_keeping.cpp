// SPDX-License-Identifier: Apache-2.0
// No work is lost: through kills while it is edited and saved, and through every single call that can fail.
#include "core/io/projectio.h"
#include "tests/shared/scenes.h"
#include "tests/ui/desk.h"
#include "tests/ui/keeping/edits.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QProcess>
#include <QtTest/QSignalSpy>

#include <algorithm>
#include <cerrno>
#include <random>

using namespace ps;

namespace {

const QString kKeeper = QStringLiteral(PS_BINARY_DIR "/test-bin/keeper");
const QString kWindowKeeper = QStringLiteral(PS_BINARY_DIR "/test-bin/windowkeeper");
const QString kFailing = QStringLiteral(PS_BINARY_DIR "/test-bin/failing.so");
const QString kCli = QStringLiteral(PS_BINARY_DIR "/bin/phasesketch-cli");

constexpr int kLong = 120000;  // ms; on a busy machine

QByteArray read(const QString& path) {
  QFile in(path);
  return in.open(QIODevice::ReadOnly) ? in.readAll() : QByteArray();
}

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

/// The highest K of lines "WORD K"; -1 where there is none.
int lastOf(const QByteArray& said, const QByteArray& word) {
  int last = -1;
  for (const QByteArray& line : said.split('\n')) {
    if (line.startsWith(word + ' ')) last = std::max(last, line.mid(word.size() + 1).toInt());
  }
  return last;
}

QProcessEnvironment failingAt(int call, int code, const QString& under, const QString& mark) {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("LD_PRELOAD"), kFailing);
  environment.insert(QStringLiteral("PS_FAIL_AT"), QString::number(call));
  environment.insert(QStringLiteral("PS_FAIL_CODE"), QString::number(code));
  environment.insert(QStringLiteral("PS_FAIL_UNDER"), under);
  environment.insert(QStringLiteral("PS_FAIL_MARK"), mark);
  environment.insert(QStringLiteral("ASAN_OPTIONS"), QStringLiteral("verify_asan_link_order=0:detect_leaks=0"));
  return environment;
}

}  // namespace

class TestKeeping : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() { m_plugins = std::make_unique<PluginRegistry>(); }
  void init() {
    m_directory = std::make_unique<QTemporaryDir>();
    reset();
  }

  /// PS_KILLS: how many rounds, 30 without it; in every fourth the program is still starting.
  void killsLoseNothingThatWasAcknowledged_data() {
    QTest::addColumn<QString>("program");
    QTest::newRow("files") << kKeeper;
    QTest::newRow("window") << kWindowKeeper;
  }
  void killsLoseNothingThatWasAcknowledged() {
    QFETCH(QString, program);
    const int rounds = qEnvironmentVariableIsSet("PS_KILLS") ? qEnvironmentVariableIntValue("PS_KILLS") : 30;
    std::mt19937 random(20260815);
    int saves = 0, offers = 0, parts = 0, early = 0;
    for (int round = 0; round < rounds; ++round) {
      QProcess keeper;
      keeper.setProcessEnvironment(atHomeInTheFolder());
      keeper.start(program, {m_directory->path(), QStringLiteral("loop")});
      QByteArray said;
      if (round % 4 == 3) {
        ++early;  // while it starts
      } else {
        while (!said.contains("saved ") && keeper.waitForReadyRead(kLong)) said += keeper.readAllStandardOutput();
        QVERIFY2(said.contains("saved "), (said + keeper.readAllStandardError()).constData());
      }
      QTest::qSleep(static_cast<int>(random() % 200));
      keeper.kill();
      QVERIFY(keeper.waitForFinished());
      said += keeper.readAllStandardOutput();
      QVERIFY2(!said.contains("failed"), said.constData());
      saves += static_cast<int>(said.count("saved "));
      parts += static_cast<int>(temporaries().size());
      Found found;
      recover(found);
      if (QTest::currentTestFailed()) return;
      offers += found.offered > 0 ? 1 : 0;
      verify(found, lastOf(said, "saved"), lastOf(said, "saved"), said);
      if (QTest::currentTestFailed()) return;
    }
    QVERIFY(saves >= rounds - early);
    // A kill is no crash of what was being loaded.
    const QDir state(m_directory->filePath(QStringLiteral("state/phasesketch")));
    QVERIFY(!state.entryList({QStringLiteral("*.sound")}).isEmpty());
    QCOMPARE(state.entryList({QStringLiteral("*.crashed")}), QStringList());
    QTest::qSleep(3000);  // a temporary without a byte might have been somebody's for two seconds
    Found found;
    recover(found);
    QCOMPARE(temporaries(), QStringList());
    qInfo("%d kills, %d saves acknowledged, newer work offered after %d, %d temporaries left and removed", rounds,
          saves, offers, parts);
  }

  void everyCallMayFail_data() {
    QTest::addColumn<int>("code");
    QTest::newRow("full disk") << ENOSPC;
    QTest::newRow("broken disk") << EIO;
    QTest::newRow("folder read-only") << EACCES;
  }
  void everyCallMayFail() {
    QFETCH(int, code);
    int calls = 0;
    for (bool failed = true; failed; ++calls) {
      reset();
      QFile::remove(mark());
      QProcess keeper;
      keeper.setProcessEnvironment(failingAt(calls + 1, code, m_directory->path(), mark()));
      keeper.start(kKeeper, {m_directory->path(), QStringLiteral("once")});
      QVERIFY(keeper.waitForFinished(20000));
      const QByteArray said = keeper.readAllStandardOutput() + "at call " + QByteArray::number(calls + 1);
      failed = QFile::exists(mark());
      const int saved = lastOf(said, "saved"), kept = lastOf(said, "kept");
      QVERIFY2(said.startsWith("open\n"), said.constData());
      QVERIFY2((keeper.exitCode() != 0) == said.contains("failed: "), said.constData());
      QVERIFY2(failed || keeper.exitCode() == 0, said.constData());
      Found found;
      recover(found);
      verify(found, saved, std::max(saved, kept), said);
      if (QTest::currentTestFailed()) return;
    }
    QVERIFY2(calls > 15, qPrintable(QString::number(calls)));
  }

  /// Nothing can be written where the project lies, and that stays so: it is said what is the matter and what to do,
  /// the file stays as it was to the byte, and the work is kept as a copy.
  void aPlaceThatTakesNothing_data() {
    QTest::addColumn<int>("code");
    QTest::addColumn<QByteArray>("says");
    QTest::newRow("full disk") << ENOSPC << QByteArray("the disk is full; free some space or save elsewhere");
    QTest::newRow("folder read-only") << EACCES
                                      << QByteArray(
                                             "no permission to write here; save elsewhere or change the permissions");
    QTest::newRow("disk read-only") << EROFS << QByteArray("the disk is read-only; save elsewhere");
  }
  void aPlaceThatTakesNothing() {
    QFETCH(int, code);
    QFETCH(QByteArray, says);
    reset();
    QFile::remove(mark());
    const QByteArray before = read(scene());
    QProcess keeper;
    QProcessEnvironment environment = failingAt(1, code, scene(), mark());
    environment.insert(QStringLiteral("PS_FAIL_ON"), QStringLiteral("1"));
    keeper.setProcessEnvironment(environment);
    keeper.start(kKeeper, {m_directory->path(), QStringLiteral("once")});
    QVERIFY(keeper.waitForFinished(20000));
    const QByteArray said = keeper.readAllStandardOutput();
    QVERIFY2(QFile::exists(mark()) && keeper.exitCode() != 0, said.constData());
    QCOMPARE(said, "open\nkept 1\nfailed: " + scene().toUtf8() + ": not saved: " + says + "\nkept 3\n");
    QCOMPARE(read(scene()), before);
    Found found;
    recover(found);
    QCOMPARE(found.file, 0);
    QCOMPARE(found.offered, 3);
  }

  /// The command line, whatever it writes: the old file, or the new one whole; and exit code 0 only for the latter.
  /// What else is left is named in the message.
  void everyCallOfTheCommandLineMayFail_data() {
    QTest::addColumn<QString>("output");
    QTest::addColumn<int>("code");
    for (const char* output : {"--save-project", "--save-state", "--report", "--probes", "--record", "pictures"}) {
      QTest::addRow("%s, full disk", output) << output << ENOSPC;
      QTest::addRow("%s, broken disk", output) << output << EIO;
      QTest::addRow("%s, folder read-only", output) << output << EACCES;
    }
  }
  void everyCallOfTheCommandLineMayFail() {
    QFETCH(QString, output);
    QFETCH(int, code);
    const bool pictures = output == QLatin1String("pictures");
    const QDir folder(m_directory->filePath(QStringLiteral("out")));
    QVERIFY(folder.mkpath(QStringLiteral(".")));
    const QString out = folder.filePath(pictures ? QStringLiteral("frame-000000.png") : QStringLiteral("result"));
    const QStringList arguments =
        QStringList{pictures ? QStringLiteral("render") : QStringLiteral("simulate"), scene()} +
        (pictures
             ? QStringList{QStringLiteral("--out"), folder.path(), QStringLiteral("--size"), QStringLiteral("64x48")}
             : QStringList{output, out}) +
        QStringList{QStringLiteral("--frames"), QStringLiteral("1"), QStringLiteral("--quiet")};
    QCOMPARE(QProcess::execute(kCli, arguments), 0);
    const QByteArray whole = read(out), before = "what stood there";
    int calls = 0;
    for (bool failed = true; failed; ++calls) {
      QFile::remove(mark());
      write(out, before);
      QProcess program;
      program.setProcessEnvironment(failingAt(calls + 1, code, folder.path(), mark()));
      program.start(kCli, arguments);
      QVERIFY(program.waitForFinished(60000));
      const QByteArray said = program.readAllStandardError();
      failed = QFile::exists(mark());
      if (program.exitCode() == 0) {
        // A report tells how long the run took, and a recording how long its frames did.
        QVERIFY(output == QLatin1String("--report")   ? QJsonDocument::fromJson(read(out)).isObject()
                : output == QLatin1String("--record") ? QProcess::execute(kCli, {QStringLiteral("validate"), out}) == 0
                                                      : read(out) == whole);
      } else {
        QVERIFY2(failed, said.constData());
        QCOMPARE(read(out), before);
        QVERIFY2(said.contains("not saved"), said.constData());
      }
      for (const QString& left : folder.entryList({QStringLiteral("*.part-*")}, QDir::Files)) {
        QVERIFY2(said.contains(left.toUtf8()), qPrintable(left + QStringLiteral(": ") + QString::fromUtf8(said)));
        QVERIFY(QFile::remove(folder.filePath(left)));
      }
    }
    QVERIFY2(calls > 4, qPrintable(QString::number(calls)));
  }

  void everyCallOfTheSettingsMayFail_data() { everyCallMayFail_data(); }
  void everyCallOfTheSettingsMayFail() {
    QFETCH(int, code);
    const QString config = m_directory->filePath(QStringLiteral("config")),
                  file = config + QStringLiteral("/phasesketch/phasesketch.settings");
    const auto run = [&](int call) {
      QProcess keeper;
      QProcessEnvironment environment = failingAt(call, code, config, mark());
      environment.insert(QStringLiteral("XDG_CONFIG_HOME"), config);
      keeper.setProcessEnvironment(environment);
      keeper.start(kKeeper, {m_directory->path(), QStringLiteral("settings")});
      keeper.waitForFinished(20000);
      return keeper.exitCode();
    };
    constexpr int kNever = 1000000;
    QCOMPARE(run(kNever), 0);
    const QByteArray before = read(file);
    QCOMPARE(run(kNever), 0);
    const QByteArray whole = read(file);
    QVERIFY(!before.isEmpty() && whole != before);
    int calls = 0;
    for (bool failed = true; failed; ++calls) {
      QFile::remove(mark());
      write(file, before);
      const int status = run(calls + 1);
      failed = QFile::exists(mark());
      QVERIFY2(failed || status == 0, qPrintable(QString::number(status)));
      QCOMPARE(read(file), status == 0 ? whole : before);
    }
    QVERIFY2(calls > 3, qPrintable(QString::number(calls)));
  }

 private:
  struct Found {
    int file = -1, offered = -1;  ///< edits that they hold
  };
  QString scene() const { return m_directory->filePath(QStringLiteral("scene.json")); }
  /// What a program remembers of itself lies there as well.
  QProcessEnvironment atHomeInTheFolder() const {
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
    environment.insert(QStringLiteral("XDG_STATE_HOME"), m_directory->filePath(QStringLiteral("state")));
    environment.insert(QStringLiteral("XDG_CONFIG_HOME"), m_directory->filePath(QStringLiteral("config")));
    return environment;
  }
  QString copies() const { return m_directory->filePath(QStringLiteral("copies")); }
  QString mark() const { return m_mark.filePath(QStringLiteral("failed")); }
  QStringList temporaries() const {
    return QDir(m_directory->path()).entryList({QStringLiteral("*.part-*")}, QDir::Files) +
           QDir(copies()).entryList({QStringLiteral("*.part-*")}, QDir::Files);
  }
  void reset() {
    QDir(copies()).removeRecursively();
    Project project = scenes::iceOnPlate(4, 300);
    saveProject(project, scene().toStdString());
    QCOMPARE(editOf(loadProject(scene().toStdString(), *m_plugins).project), 0);
  }

  /// What the next start finds, and offers.
  void recover(Found& found) {
    Desk desk(*m_plugins, copies());
    QSignalSpy opened(&desk.files, &DocumentFiles::opened), elsewhere(&desk.files, &DocumentFiles::openElsewhere);
    desk.files.open(scene());
    QVERIFY(opened.wait());
    QCOMPARE(elsewhere.count(), 0);
    found.file = editOf(desk.document.project());
    for (const AutosavedSession& session : desk.autosave.leftBehind()) {
      if (!session.copy.isEmpty()) {
        const int edit = editOf(loadProject(session.copy.toStdString(), *m_plugins).project);
        QVERIFY2(edit >= found.file, qPrintable(QStringLiteral("%1 offered, %2 saved").arg(edit).arg(found.file)));
        found.offered = std::max(found.offered, edit);
      }
      Autosave::discard(session);
    }
  }
  void verify(const Found& found, int saved, int acknowledged, const QByteArray& said) {
    const QByteArray all = said + QByteArray("; file ") + QByteArray::number(found.file) + ", offered " +
                           QByteArray::number(found.offered);
    QVERIFY2(found.file >= std::max(saved, 0), all.constData());
    QVERIFY2(std::max(found.file, found.offered) >= acknowledged, all.constData());
    for (const QString& part : temporaries()) {
      const QFileInfo info(QFile::exists(m_directory->filePath(part)) ? m_directory->filePath(part)
                                                                      : copies() + QLatin1Char('/') + part);
      QVERIFY2(info.size() == 0, qPrintable(part));  // the last start sees those
    }
  }

  std::unique_ptr<PluginRegistry> m_plugins;
  std::unique_ptr<QTemporaryDir> m_directory;
  QTemporaryDir m_mark;
};

QTEST_GUILESS_MAIN(TestKeeping)
#include "tst_keeping.moc"
