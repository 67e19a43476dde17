// SPDX-License-Identifier: Apache-2.0
// Every row of the tables in tests/cases, through the program that people run; see tests/cases/README.md.
#include <QFile>
#include <QProcess>
#include <QSet>
#include <QTest>

#include <nlohmann/json.hpp>

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

}  // namespace

class TestCases : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void agreesWithTheory_data() {
    QTest::addColumn<QString>("table");
    QTest::addColumn<QString>("id");
    for (const QString& table : kTables) {
      for (const auto& row : casesOf(table)) {
        const std::string id = row.at("id").get<std::string>();
        QTest::newRow(id.c_str()) << table << QString::fromStdString(id);
      }
    }
  }
  void agreesWithTheory() {
    QFETCH(QString, table);
    QFETCH(QString, id);
    const Answer answer = answerOf({"cases", table, "--only", id});
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
};

QTEST_APPLESS_MAIN(TestCases)
#include "tst_cases.moc"
