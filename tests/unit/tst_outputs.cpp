// SPDX-License-Identifier: Apache-2.0
// What the command line writes: whole files or none, and never in the place of what it reads.
#include "clirun.h"
#include "core/base/jsontext.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

class TestOutputs : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void noOutputReplacesAnInput_data();
  void noOutputReplacesAnInput();
  void pipesAndLinksStay();
  void signalsLeaveWholeFiles_data();
  void signalsLeaveWholeFiles();
  void aSignalWhileTheSceneIsMadeEndsAtOnce();
  void aFullDiskEndsTheRunAndSaysWhereItsRowsAre();
  void twoRunsMayRecordToOneName();
};

namespace {

Ran run(const QStringList& arguments, const std::function<void()>& before) {
  QProcess process;
  process.setChildProcessModifier(before);
  process.start(kProgram, arguments);
  return ended(process);
}

QByteArray bytesOf(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void write(const QString& path, const QByteArray& bytes) {
  QFile file(path);
  QVERIFY(file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size());
}

QStringList filesIn(const QTemporaryDir& folder) { return QDir(folder.path()).entryList(QDir::Files | QDir::System); }

}  // namespace

void TestOutputs::noOutputReplacesAnInput_data() {
  QTest::addColumn<QStringList>("options");
  for (const char* option : {"--record", "--report", "--probes", "--save-state", "--save-project"})
    QTest::newRow(option) << QStringList{option, "mine.json"};
  QTest::newRow("by another way") << QStringList{"--report", "sub/../mine.json"};
  QTest::newRow("by a link") << QStringList{"--report", "link.json"};
  QTest::newRow("by a hard link") << QStringList{"--report", "twin.json"};
  QTest::newRow("twice") << QStringList{"--report", "out", "--probes", "./out"};
}

void TestOutputs::noOutputReplacesAnInput() {
  QFETCH(const QStringList, options);
  QTemporaryDir folder;
  const QString project = folder.filePath("mine.json");
  QVERIFY(QFile::copy(kSample, project) && QDir(folder.path()).mkdir("sub"));
  QVERIFY(QFile::link(project, folder.filePath("link.json")));
  QCOMPARE(::link(qPrintable(project), qPrintable(folder.filePath("twin.json"))), 0);
  QProcess process;
  process.setWorkingDirectory(folder.path());
  process.start(kProgram, smallScene(QStringList{"--frames", "1"} + options, project));
  const Ran ran = ended(process);
  QCOMPARE(ran.code, 2);
  QVERIFY2(ran.err.contains("as well; choose another name"), ran.err.constData());
  QCOMPARE(bytesOf(project), bytesOf(kSample));
  QCOMPARE(filesIn(folder).size(), 3);
}

void TestOutputs::pipesAndLinksStay() {
  QTemporaryDir folder;
  const QString pipe = folder.filePath("pipe"), target = folder.filePath("target"), link = folder.filePath("link");
  QCOMPARE(::mkfifo(qPrintable(pipe), 0600), 0);
  QProcess reader;
  reader.start("cat", {pipe});
  QCOMPARE(cli(smallScene({"--frames", "2", "--record", pipe})).code, 0);
  QVERIFY(reader.waitForFinished() && reader.readAllStandardOutput().startsWith("PSRECORD"));
  struct stat info {};
  QCOMPARE(::lstat(qPrintable(pipe), &info), 0);
  QVERIFY(S_ISFIFO(info.st_mode));

  write(target, "old");
  QVERIFY(QFile::link(target, link));
  for (const char* option : {"--record", "--report", "--probes"}) {
    QCOMPARE(cli(smallScene({"--frames", "2", option, link})).code, 0);
    QCOMPARE(QFileInfo(link).symLinkTarget(), target);
    QVERIFY(bytesOf(target).size() > 100);
  }
}

void TestOutputs::signalsLeaveWholeFiles_data() {
  QTest::addColumn<int>("number");
  QTest::newRow("Ctrl+C") << SIGINT;
  QTest::newRow("end") << SIGTERM;
  QTest::newRow("terminal gone") << SIGHUP;
}

void TestOutputs::signalsLeaveWholeFiles() {
  QFETCH(const int, number);
  QTemporaryDir folder;
  const QString probes = folder.filePath("p.csv"), report = folder.filePath("r.json"),
                record = folder.filePath("r.rec");
  write(probes, "an older table");
  QProcess process;
  process.start(kProgram,
                smallScene({"--frames", "1000000", "--probes", probes, "--report", report, "--record", record}));
  // It runs as soon as its recording grows; until it ends the old table stands.
  const auto growing = [&] {
    for (const QString& name : filesIn(folder))
      if (name.startsWith("r.rec.part") && QFileInfo(folder.filePath(name)).size() > 20000) return true;
    return false;
  };
  QTRY_VERIFY_WITH_TIMEOUT(growing(), 60000);
  QCOMPARE(bytesOf(probes), QByteArray("an older table"));
  QCOMPARE(::kill(static_cast<pid_t>(process.processId()), number), 0);
  const Ran ran = ended(process);
  QCOMPARE(ran.code, 1);
  QVERIFY2(ran.err.contains("stopped after"), ran.err.constData());
  const QList<QByteArray> rows = bytesOf(probes).trimmed().split('\n');
  QVERIFY(rows.size() > 2);
  for (const QByteArray& row : rows) QCOMPARE(row.count(','), rows[0].count(','));
  const auto content = ps::parseJson(bytesOf(report).toStdString(), "report");
  QCOMPARE(content["frames"].get<qsizetype>(), rows.size() - 2);  // titles and the start
  QVERIFY(bytesOf(record).startsWith("PSRECORD"));
  QCOMPARE(filesIn(folder).size(), 3);
}

/// Nothing is written yet, so that nothing has to be kept: the process is ended as any other.
void TestOutputs::aSignalWhileTheSceneIsMadeEndsAtOnce() {
  QTemporaryDir folder;
  const QString probes = folder.filePath("p.csv");
  write(probes, "an older table");
  QProcess process;
  process.start(kProgram, {"simulate", kSample, "--set", "/solver/particle_spacing=0.004", "--frames", "0", "--probes",
                           probes, "--record", folder.filePath("r.rec")});
  // What it has in memory tells how far it is: this many pages come with the particles.
  const auto pages = [&] {
    QFile file(QString("/proc/%1/statm").arg(process.processId()));
    return file.open(QIODevice::ReadOnly) ? file.readAll().split(' ').value(1).toLongLong() : 0;
  };
  QTRY_VERIFY_WITH_TIMEOUT(pages() * ::sysconf(_SC_PAGESIZE) > 150e6, 60000);
  QCOMPARE(::kill(static_cast<pid_t>(process.processId()), SIGINT), 0);
  QVERIFY(process.waitForFinished(60000));
  QCOMPARE(process.exitStatus(), QProcess::CrashExit);
  QCOMPARE(process.exitCode(), SIGINT);
  QCOMPARE(bytesOf(probes), QByteArray("an older table"));
  QCOMPARE(filesIn(folder).size(), 1);
}

/// Whichever of the two the disk has no room for: what was written of both stays.
void TestOutputs::aFullDiskEndsTheRunAndSaysWhereItsRowsAre() {
  QTemporaryDir folder;
  const QString table = folder.filePath("table"), recording = folder.filePath("recording");
  write(table, "an older one");
  write(recording, "an older one");
  // A limit on the size of files stands for the full disk; the run would take minutes.
  const Ran ran = run(smallScene({"--frames", "1000000", "--probes", table, "--record", recording}), [] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit tight{400000, 400000};
    ::setrlimit(RLIMIT_FSIZE, &tight);
  });
  QCOMPARE(ran.code, 1);
  QVERIFY2(ran.err.contains("recording: not saved: "), ran.err.constData());
  const auto kept = [&](const char* words) {
    const QByteArray rest = ran.err.mid(ran.err.indexOf(words) + qstrlen(words));
    return ran.err.contains(words) ? bytesOf(QString::fromUtf8(rest.split(';').first().trimmed())) : QByteArray();
  };
  const QByteArray rows = kept("; the rows until now are in "), frames = kept("; the frames until now are in ");
  QVERIFY2(rows.startsWith("time_s,") && rows.count('\n') > 3, ran.err.constData());
  QVERIFY2(frames.startsWith("PSRECORD") && frames.count("PSBLOCK.") > 5, ran.err.constData());
  QCOMPARE(bytesOf(table), QByteArray("an older one"));
  QCOMPARE(bytesOf(recording), QByteArray("an older one"));
}

void TestOutputs::twoRunsMayRecordToOneName() {
  QTemporaryDir folder;
  const QString path = folder.filePath("two.rec");
  QProcess first, second;
  for (QProcess* process : {&first, &second})
    process->start(kProgram, smallScene({"--frames", "20", "--record", path}));
  QCOMPARE(ended(first).code, 0);
  QCOMPARE(ended(second).code, 0);
  QCOMPARE(filesIn(folder), QStringList{"two.rec"});
  const Ran checked = cli({"validate", path});
  QVERIFY2(checked.out.contains(": a recording of 21 frames, 0 to "), checked.out.constData());
}

QTEST_GUILESS_MAIN(TestOutputs)
#include "tst_outputs.moc"
