// SPDX-License-Identifier: Apache-2.0
// Every row of the tables in tests/cases, through the program that people run; see tests/cases/README.md.
#include <QFile>
#include <QMap>
#include <QProcess>
#include <QSet>
#include <QTest>
#include <QThread>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace {

const QString kFolder = QStringLiteral(PS_SOURCE_DIR "/tests/cases/");
const QString kFile = kFolder + "cases.json";
const QStringList kTables{kFile, kFolder + "thesis.json"};

struct Answer {
  int code = -1;
  QString table, problem;
};

Answer answerOf(const QStringList& arguments) {
  QProcess process;
  process.start(PS_BINARY_DIR "/bin/phasesketch-cli", arguments);
  if (!process.waitForFinished(-1)) return {};
  return {process.exitCode(), QString::fromUtf8(process.readAllStandardOutput()),
          QString::fromUtf8(process.readAllStandardError())};
}

nlohmann::json casesOf(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return nlohmann::json::array();
  return nlohmann::json::parse(file.readAll().toStdString()).at("cases");
}

/// Runs rows side by side, one core each: that is faster than one after the other on all of them.
class Rows {
 public:
  void add(const QString& table, const QString& id) { m_rows.push_back({table, id, nullptr}); }
  Answer answerOf(const QString& id) {
    const auto row = std::find_if(m_rows.begin(), m_rows.end(), [&](const Row& r) { return r.id == id; });
    if (row == m_rows.end()) return {};
    start(*row);
    while (row->process->state() != QProcess::NotRunning) {
      startMore();
      row->process->waitForFinished(50);
    }
    return {row->process->exitCode(), QString::fromUtf8(row->process->readAllStandardOutput()),
            QString::fromUtf8(row->process->readAllStandardError())};
  }

 private:
  struct Row {
    QString table, id;
    std::unique_ptr<QProcess> process;
  };
  static void start(Row& row) {
    if (row.process) return;
    row.process = std::make_unique<QProcess>();
    row.process->start(PS_BINARY_DIR "/bin/phasesketch-cli", {"cases", row.table, "--only", row.id, "--threads", "1"});
  }
  void startMore() {
    int running = 0;
    for (Row& row : m_rows) {
      if (row.process && row.process->state() != QProcess::NotRunning) row.process->waitForFinished(1);
      running += row.process && row.process->state() != QProcess::NotRunning ? 1 : 0;
    }
    for (Row& row : m_rows) {
      if (running >= QThread::idealThreadCount()) return;
      if (row.process) continue;
      start(row);
      ++running;
    }
  }

  std::vector<Row> m_rows;
};

}  // namespace

class TestCases : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void agreesWithTheory_data() {
    QTest::addColumn<QString>("id");
    for (const QString& table : kTables) {
      for (const auto& row : casesOf(table)) {
        const std::string id = row.at("id").get<std::string>();
        QTest::newRow(id.c_str()) << QString::fromStdString(id);
        m_rows.add(table, QString::fromStdString(id));
      }
    }
  }
  void agreesWithTheory() {
    QFETCH(QString, id);
    const Answer answer = m_rows.answerOf(id);
    qInfo("%s", qPrintable(answer.table));
    QVERIFY2(answer.code == 0, qPrintable(answer.table + answer.problem));
    QVERIFY(answer.table.contains(id));
  }

  /// The projects of the tables, as they stand: the editor opens them too.
  void projectsAreFine() {
    QSet<QString> projects;
    for (const QString& table : kTables) {
      const qsizetype before = projects.size();
      for (const auto& row : casesOf(table)) {
        if (row.contains("project")) projects << QString::fromStdString(row["project"].get<std::string>());
      }
      QVERIFY(projects.size() > before + 5);
    }
    for (const QString& project : projects) {
      const Answer answer = answerOf({"validate", kFolder + project});
      QVERIFY2(answer.code == 0 && answer.problem.isEmpty(), qPrintable(answer.problem));
    }
  }

  /// A table that cannot fail proves nothing.
  void otherNumbersMissTheTolerance() {
    const Answer answer =
        answerOf({"cases", kFile, "--only", "l2_projectile", "--set", "environment/gravity=[0, -1.62, 0]"});
    QCOMPARE(answer.code, 1);
    const QStringList lines = answer.table.trimmed().split('\n');
    QCOMPARE(lines.size(), 3);
    QVERIFY2(lines[1].contains(" 1.5 ") && lines[1].endsWith("yes"), qPrintable(lines[1]));
    QVERIFY2(lines[2].contains(" 0.749225 ") && lines[2].endsWith("NO"), qPrintable(lines[2]));  // 1.7934 m on the Moon
    QVERIFY(answer.problem.contains("1 number misses its tolerance"));
  }

  /// What the solver tells by itself that it could not deliver is not passed over, nor taken for an agreement.
  void whatTheSolverCouldNotDeliverIsALimit() {
    const Answer answer = answerOf({"cases", kFile, "--only", "b1_hanging_chain", "--set",
                                    "bodies/chain/constraints/0/parameters/spring_stiffness=1e9"});
    QCOMPARE(answer.code, 1);
    const QStringList lines = answer.table.trimmed().split('\n');
    QCOMPARE(lines.size(), 5);
    for (const QString& line : lines.mid(1))
      QVERIFY2(line.contains("  limit: bonds.spring_stiffness 1e+09 N/m asked, "), qPrintable(line));
  }

  /// Profiles, plateaus and phase diagrams too: what others put into the projects reaches the numbers.
  void thermalNumbersFollowTheProject() {
    const auto verdicts = [](const QStringList& more) {
      const Answer answer = answerOf(QStringList{"cases", kFile} + more);
      QMap<QString, bool> fine;
      for (const QString& line : answer.table.trimmed().split('\n')) {
        fine[line.mid(30, 44).trimmed()] = line.endsWith("yes");
      }
      return fine;
    };
    auto fine = verdicts({"--only", "d5_wall", "--set", "materials/matter/properties/conductivity_liquid=1.1"});
    QVERIFY(!fine["flux, W/m2, lattice"] && fine["L2 of the straight profile, lattice"]);
    fine = verdicts({"--only", "d5_wall", "--set", "environment/walls/right/temperature=383.15"});
    QVERIFY(!fine["L2 of the straight profile, lattice"]);
    fine = verdicts({"--only", "g3_boiling", "--set", "bodies/body/heating_power=480"});
    QVERIFY(fine["plateau, K"] && !fine["boiling begins, s"] && !fine["boiling lasts, s"]);
    fine = verdicts({"--only", "g3_boiling", "--set", "materials/water/properties/latent_heat_vaporization=2200000"});
    QVERIFY(!fine["latent heat there, J/kg"] && !fine["boiling lasts, s"]);
    fine = verdicts({"--only", "e2_stefan", "--set", "environment/walls/wall/temperature=333.15"});
    QVERIFY(!fine["front after 1500 s, m, lattice"]);
  }

  void wrongRowsNameThePlace_data() {
    QTest::addColumn<QString>("row");
    QTest::addColumn<QString>("problem");
    QTest::newRow("no id") << R"({"checks": []})"
                           << "/cases/0/id: is missing";
    QTest::newRow("no checks") << R"({"id": "a", "checks": []})"
                               << "/cases/0: checks nothing";
    QTest::newRow("unknown key")
        << R"({"id": "a", "tolerance": 1, "checks": [{"what": "x", "column": "c", "measure": "last", "at_most": 1}]})"
        << "/cases/0/tolerance: is no key of a case";
    QTest::newRow("unknown measure") << R"({"id": "a", "checks": [{"what": "x", "column": "c", "measure": "median"}]})"
                                     << "/cases/0/checks/0: 'median' is no measure";
    QTest::newRow("unknown profile")
        << R"({"id": "a", "checks": [{"what": "x", "profile": "parabola", "measure": "l2", "at_most": 1}]})"
        << "/cases/0/checks/0: 'parabola' is no profile";
    QTest::newRow("unknown measure of a profile")
        << R"({"id": "a", "checks": [{"what": "x", "profile": "line", "measure": "last", "at_most": 1}]})"
        << "/cases/0/checks/0: 'last' is no measure of a profile";
    QTest::newRow("unknown equilibrium")
        << R"({"id": "a", "checks": [{"what": "x", "equilibrium": "dew", "material": "water", "at_most": 1}]})"
        << "/cases/0/checks/0: 'dew' is no equilibrium";
    QTest::newRow("unknown clock")
        << R"({"id": "a", "checks": [{"what": "x", "column": "c", "measure": "last", "clock": "sun", "at_most": 1}]})"
        << "/cases/0/checks/0: 'sun' is no clock";
    QTest::newRow("no tolerance")
        << R"({"id": "a", "checks": [{"what": "x", "column": "c", "measure": "last", "expected": 1}]})"
        << "/cases/0/checks/0: needs an expected value and its tolerance, or a bound";
    QTest::newRow("two for one run")
        << R"({"id": "a", "checks": [{"what": "x", "column": "c", "measure": "last", "expected": [1, 2], "relative": 1}]})"
        << "/cases/0/checks/0: expects 2 values for 1 run";
  }
  void wrongRowsNameThePlace() {
    QFETCH(QString, row);
    QFETCH(QString, problem);
    QFile file("broken.json");
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{\"cases\": [" + row.toUtf8() + "]}");
    file.close();
    const Answer answer = answerOf({"cases", file.fileName()});
    QCOMPARE(answer.code, 2);
    QVERIFY2(answer.problem.contains("broken.json:" + problem), qPrintable(answer.problem));
  }

 private:
  Rows m_rows;
};

QTEST_APPLESS_MAIN(TestCases)
#include "tst_cases.moc"
