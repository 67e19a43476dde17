// SPDX-License-Identifier: Apache-2.0
// A few sliders of a few samples at both ends of their ranges, through the program that people run. `./dev soak` takes
// all of them, for hours.
#include <QFile>
#include <QProcess>
#include <QTest>

namespace {

struct Answer {
  int code = -1;
  QString table, problem;
};

/// s of each run; a sanitizer makes a frame fifty times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
const QString kSeconds = QStringLiteral("0.07");
#else
const QString kSeconds = QStringLiteral("0.5");
#endif

Answer soak(const QStringList& arguments) {
  QProcess process;
  process.start(PS_BINARY_DIR "/bin/phasesketch-cli", QStringList{"soak"} + arguments);
  if (!process.waitForFinished(-1)) return {};
  return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()),
          QString::fromUtf8(process.readAllStandardError())};
}

QString sample(const QString& name) { return QStringLiteral(PS_SOURCE_DIR "/projects/%1.json").arg(name); }

/// One block of iron, thrown at 60 m/s along x in a scene of 1 m; walls stop it or not.
QString thrownBlock(const char* walls) {
  QFile file("thrown.json");
  if (!file.open(QIODevice::WriteOnly)) return {};
  file.write(QByteArray(R"({"format": "phasesketch", "version": 1,
    "materials": [{"id": "iron", "base": "iron"}],
    "bodies": [{"id": "block", "name": "Block", "material": "iron", "velocity": [60, 0, 0],
                "shape": {"box": {"center": [0, 0.5, 0], "size": [0.04, 0.04, 0.04]}}}],
    "environment": {"bounds": {"minimum": [-0.5, -0.1, -0.5], "maximum": [0.5, 1, 0.5]}, "walls": [)") +
             walls + R"(]}, "solver": {"thermal": {"model": ""}}})");
  return file.fileName();
}

}  // namespace

class TestSoak : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void endsOfSlidersHold_data() {
    QTest::addColumn<QString>("slider");
    QTest::addColumn<int>("runs");
    QTest::newRow("dam-break") << "solver/substeps" << 2;
    QTest::newRow("jelly-drop") << "material/jelly/youngs_modulus" << 2;
    QTest::newRow("wet-cloth") << "constraint/cloth/cloth/stretch_stiffness" << 2;
    QTest::newRow("rope-bridge") << "scene/gravity" << 2;
    QTest::newRow("box-tower") << "wall/floor/friction" << 2;
    QTest::newRow("honey-coil") << "emitter/spout/speed" << 2;
    QTest::newRow("river") << "environment/wind_speed" << 1;  // it stands at the lower end
    QTest::newRow("ice-on-hot-plate") << "solver/thermal_time_scale" << 2;
  }
  void endsOfSlidersHold() {
    QFETCH(QString, slider);
    QFETCH(int, runs);
    const QString name = QTest::currentDataTag();
    const Answer answer = soak({sample(name), "--only", slider, "--seconds", kSeconds});
    qInfo("%s", qPrintable(answer.table));
    QVERIFY2(answer.code == 0, qPrintable(answer.table + answer.problem));
    const QStringList lines = answer.table.trimmed().split('\n');
    QCOMPARE(lines.size(), runs + 1);
    QVERIFY2(lines[0].startsWith(name) && lines[0].contains("as it is"), qPrintable(lines[0]));
    for (const QString& line : lines.mid(1)) QVERIFY2(line.contains(slider), qPrintable(line));
  }

  /// A soak that cannot fail proves nothing.
  void flagsWithoutReasonFail() {
    const Answer answer = soak({thrownBlock(""), "--only", "scene/gravity", "--seconds", "0.1"});
    QCOMPARE(answer.code, 1);
    QVERIFY2(answer.table.contains("as it is") && answer.table.contains("FAILED: lost_particle"),
             qPrintable(answer.table));
    QVERIFY2(answer.problem.contains("1 run failed"), qPrintable(answer.problem));
  }
  /// The same flag is what a slider asks for that throws things out of an open scene.
  void flagsWithReasonSayIt() {
    const Answer answer = soak({thrownBlock(""), "--only", "scene/gravity", "--seconds", "0.1"});
    QVERIFY2(answer.table.contains("asked for: lost_particle: the scene is open"), qPrintable(answer.table));
  }

  void runsAreListed() {
    const Answer answer = soak({sample("dam-break"), "--only", "solver/", "--list"});
    QCOMPARE(answer.code, 0);
    QVERIFY2(answer.table.contains("solver/iterations = 16\n"), qPrintable(answer.table));
    QVERIFY(!answer.table.contains("wall/"));
  }

  void unknownSlidersAreNamed() {
    const Answer answer = soak({sample("dam-break"), "--only", "solver/substep_count"});
    QCOMPARE(answer.code, 2);
    QVERIFY2(answer.problem.contains("no slider begins with 'solver/substep_count'"), qPrintable(answer.problem));
  }
};

QTEST_APPLESS_MAIN(TestSoak)
#include "tst_soak.moc"
