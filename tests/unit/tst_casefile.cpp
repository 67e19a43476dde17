// SPDX-License-Identifier: Apache-2.0
// Files of cases as they are read: formulas instead of numbers, and what is said of those that are broken.
#include "core/base/error.h"
#include "core/experiments/caserun.h"
#include "core/experiments/formula.h"

#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <fstream>

using namespace ps;

class TestCaseFile : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void formulasHaveValues_data();
  void formulasHaveValues();
  void brokenFormulasSayWhere_data();
  void brokenFormulasSayWhere();
  void whatIsDeepIsRefused();
  void numbersOfACaseMayBeFormulas();
  void aNumberIsTakenOffAnother();
  void limitsConcernTheChecksThatNameThem_data();
  void limitsConcernTheChecksThatNameThem();
  void brokenFilesSayWhere_data();
  void brokenFilesSayWhere();

 private:
  std::vector<Case> read(const std::string& text) const {
    const std::string path = m_folder.filePath("cases.json").toStdString();
    std::ofstream(path) << text;
    return readCases(path);
  }
  QTemporaryDir m_folder;
};

namespace {

std::optional<double> gravity(const std::string& name) {
  return name == "g" ? std::optional<double>(9.81) : std::nullopt;
}

std::string problemOf(const std::string& formula) {
  try {
    return "is " + std::to_string(valueOfFormula(formula, gravity));
  } catch (const InputError& problem) {
    return problem.what();
  }
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int k = 0; k < times; ++k) all += text;
  return all;
}

/// A file with one case, which expects this of a column and has these values.
std::string fileWith(const std::string& expected, const std::string& values) {
  return R"({"cases": [{"id": "a", "values": )" + values +
         R"(, "checks": [{"what": "x", "column": "c", "measure": "last", "absolute": 1, "expected": )" + expected +
         "}]}]}";
}

}  // namespace

void TestCaseFile::formulasHaveValues_data() {
  QTest::addColumn<double>("expected");
  const auto row = [](const char* formula, double expected) { QTest::newRow(formula) << expected; };
  row("2", 2);
  row(" 1.5e-3 ", 0.0015);
  row("1 + 2*3 - 4/8", 6.5);
  row("8/4/2", 1);
  row("1 - 2 - 3", -4);
  row("(1 + 2)*3", 9);
  row("-2^2", -4);
  row("2^-1", 0.5);
  row("2^3^2", 512);
  row("--3", 3);
  row("sqrt(2*9.81*0.5)", std::sqrt(9.81));
  row("sqrt(2*g*0.5)", std::sqrt(9.81));
  row("sin(pi/6)", 0.5);
  row("cos(pi/3)", 0.5);
  row("tan(pi/4)", 1);
  row("exp(log(7))", 7);
  row("abs(min(3, -4, 5))", 4);
  row("max(1,2)", 2);
  row("pow(2, 10)", 1024);
}

void TestCaseFile::formulasHaveValues() {
  QFETCH(double, expected);
  const double value = valueOfFormula(QTest::currentDataTag(), gravity);
  QVERIFY2(std::abs(value - expected) < 1e-12 * std::abs(expected), qPrintable(QString::number(value)));  // rounding
}

void TestCaseFile::brokenFormulasSayWhere_data() {
  QTest::addColumn<QString>("problem");
  const auto row = [](const char* formula, const char* problem) { QTest::newRow(formula) << problem; };
  row("", "character 1: a number, a name or a ( is missing");
  row("1 +", "character 4: a number, a name or a ( is missing");
  row("1 + * 2", "character 5: a number, a name or a ( belongs here");
  row("2 x", "character 3: an operator or the end belongs here");
  row("(1 + 2", "character 7: a ) is missing");
  row("1)", "character 2: an operator or the end belongs here");
  row("2*h", "character 3: there is no value 'h'");
  row("sqr(2)", "character 1: there is no function 'sqr'");
  row("sqrt 2", "character 1: there is no value 'sqrt'");
  row("1 + pow(2)", "character 5: pow takes 2 arguments");
  row("sqrt()", "character 6: a number, a name or a ( belongs here");
  row("sqrt(-1)", "character 1: this is no finite number");
  row("1/(1 - 1)", "character 2: divides by 0");
  row("1e999", "character 1: this is no number, or one that is too large or too small");
  row(".", "character 1: this is no number, or one that is too large or too small");
  row("1e300*1e300", "character 1: this is no finite number");
  row("nan", "character 1: there is no value 'nan'");
  row("2·g", "character 2: an operator or the end belongs here");
}

void TestCaseFile::brokenFormulasSayWhere() {
  QFETCH(QString, problem);
  QCOMPARE(QString::fromStdString(problemOf(QTest::currentDataTag())), problem);
}

void TestCaseFile::whatIsDeepIsRefused() {
  for (const char* deep : {"(", "2^", "-(", "abs("}) {
    const std::string problem = problemOf(repeated(deep, 1000000));
    QVERIFY2(problem.ends_with("goes more than 40 levels deep"), problem.c_str());
  }
  QCOMPARE(valueOfFormula(repeated("-", 1000000) + "1", gravity), 1.0);
  QCOMPARE(valueOfFormula(repeated("1+", 100000) + "1", gravity), 100001.0);
}

void TestCaseFile::numbersOfACaseMayBeFormulas() {
  const std::vector<Case> cases = read(R"json({"cases": [{
    "id": "fall", "values": {"h": 0.5, "v": "sqrt(2*g*h)", "g": 9.81},
    "runs": [{"name": "once"}, {"name": "twice", "frames": "2*10"}],
    "checks": [{"what": "speed", "column": "ball.speed[m/s]", "measure": "at", "time": "v/g", "expected": ["v", "2*v"],
                "relative": 0.01, "at_least": "0.9*v", "at_most": "1.1*v", "times": "1/2", "plus": "-g"}]
}]
})json");
  const CaseCheck& check = cases.at(0).checks.at(0);
  const double v = std::sqrt(9.81);
  QCOMPARE(check.expected, (std::vector<double>{v, 2 * v}));
  QCOMPARE(check.atLeast.value(), 0.9 * v);
  QCOMPARE(check.atMost.value(), 1.1 * v);
  QCOMPARE(check.times, 0.5);
  QCOMPARE(check.plus, -9.81);
  QCOMPARE(check.number.options.at("time").get<double>(), v / 9.81);
  QCOMPARE(cases[0].runs[1].frames, 20L);
}

void TestCaseFile::aNumberIsTakenOffAnother() {
  const std::vector<Case> cases = read(R"({"cases": [{"id": "a", "checks": [
    {"what": "way", "column": "a.x[m]", "minus": "d.x[m]", "measure": "at", "time": 2, "less": {"measure": "at", "time": 1}, "at_least": 0},
    {"what": "late", "column": "a.x[m]", "clock": "thermal", "measure": "when", "value": 1,
     "less": {"column": "b.x[m]", "minus": "c.x[m]", "clock": "mechanical", "measure": "last"}, "at_least": 0}]}]})");
  const CaseCheck &way = cases[0].checks[0], &late = cases[0].checks[1];
  QVERIFY(way.less && way.less->column == "a.x[m]" && way.less->options.at("time") == 1);
  QCOMPARE(way.less->minus, std::string("d.x[m]"));
  QVERIFY(late.number.thermalClock && late.less && !late.less->thermalClock);
  QCOMPARE(late.less->column + late.less->minus + late.less->measure, std::string("b.x[m]c.x[m]last"));
  try {
    read(R"({"cases": [{"id": "a", "checks": [{"what": "x", "column": "c", "measure": "last", "at_most": 1,
      "less": {"measure": "first", "what": "y"}}]}]})");
    QFAIL("was taken");
  } catch (const InputError& error) {
    QVERIFY2(QByteArray(error.what()).endsWith("/cases/0/checks/0/less/what: is no key of a case"), error.what());
  }
}

void TestCaseFile::limitsConcernTheChecksThatNameThem_data() {
  QTest::addColumn<QString>("named");
  QTest::addColumn<bool>("concerns");
  QTest::newRow("any") << "" << true;
  QTest::newRow("name") << R"(, "limit": "steel.youngs_modulus")" << true;
  QTest::newRow("owner") << R"(, "limit": "steel")" << true;
  QTest::newRow("key") << R"(, "limit": "youngs_modulus")" << true;
  QTest::newRow("one of a list") << R"(, "limit": ["solver.substeps", "steel"])" << true;
  QTest::newRow("another owner") << R"(, "limit": "steel.youngs")" << false;
  QTest::newRow("another key") << R"(, "limit": ["steel.density_solid", "honey"])" << false;
}

void TestCaseFile::limitsConcernTheChecksThatNameThem() {
  QFETCH(QString, named);
  QFETCH(bool, concerns);
  const std::vector<Case> cases =
      read(R"({"cases": [{"id": "a", "checks": [{"what": "x", "function": "rayleigh_number", "at_most": 1)" +
           named.toStdString() + "}]}]}");
  QCOMPARE(ps::concerns(cases.at(0).checks.at(0), "steel.youngs_modulus"), concerns);
  QVERIFY_EXCEPTION_THROWN(
      read(R"({"cases": [{"id": "a", "checks": [{"what": "x", "function": "y", "at_most": 1, "limit": [1]}]}]})"),
      InputError);
}

void TestCaseFile::brokenFilesSayWhere_data() {
  QTest::addColumn<QString>("expected");
  QTest::addColumn<QString>("values");
  QTest::addColumn<QString>("problem");
  const auto row = [](const char* name, const char* expected, const char* values, const char* problem) {
    QTest::newRow(name) << expected << values << QStringLiteral("cases.json:/cases/0/") + problem;
  };
  row("formula", R"("2*(3")", "{}", "checks/0/expected: character 5: a ) is missing");
  row("one of a list", R"(["1", "2*"])", "{}", "checks/0/expected/1: character 3: a number, a name or a ( is missing");
  row("no number", "true", "{}", "checks/0/expected: must be a number or a formula");
  row("value", "1", R"({"a": "1 1"})", "values/a: character 3: an operator or the end belongs here");
  row("value of a value", "1", R"({"a": "2*b", "b": "q"})",
      "values/a: the value 'b': character 1: there is no value 'q'");
  row("circle", "1", R"({"a": "b", "b": "a + 1"})",
      "values/a: the value 'b': the value 'a': 'b' is made of itself, or of too many others");
  row("name", "1", R"({"2a": 1})", "values/2a: cannot be the name of a value");
  row("name of a function", "1", R"({"sqrt": 1})", "values/sqrt: cannot be the name of a value");
  row("list of values", "1", "[1]", "values: must be an object of names and numbers");
}

void TestCaseFile::brokenFilesSayWhere() {
  QFETCH(QString, expected);
  QFETCH(QString, values);
  QFETCH(QString, problem);
  try {
    read(fileWith(expected.toStdString(), values.toStdString()));
    QFAIL("was taken");
  } catch (const InputError& error) {
    QVERIFY2(QString::fromUtf8(error.what()).endsWith(problem), error.what());
  }
}

QTEST_GUILESS_MAIN(TestCaseFile)
#include "tst_casefile.moc"
