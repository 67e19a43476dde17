// SPDX-License-Identifier: Apache-2.0
// Conditions and relations of declarations: their grammar, what they hold for, and how people read them.
#include "core/base/error.h"
#include "core/parameters/wording.h"

#include <QTest>

#include <cmath>

using namespace ps;
using api::ParameterKind;
using api::Scale;

namespace {

api::ParameterDeclaration declared(const char* key, const char* label, ParameterKind kind) {
  return {key, label, "", "", kind, Scale::Linear, 0, 0, 10, 0, 100, "", 1, 0, "", "", "", "", ""};
}

/// A list with one declaration of each kind, and a temperature that is shown in °C and may be none.
api::ParameterList list() {
  static const std::vector<api::ParameterDeclaration> all = [] {
    std::vector<api::ParameterDeclaration> made{
        declared("low", "Low end", ParameterKind::Number),   declared("high", "High end", ParameterKind::Number),
        declared("on", "Switch", ParameterKind::Toggle),     declared("mode", "Mode", ParameterKind::Choice),
        declared("curve", "Curve", ParameterKind::Response), declared("melts", "Melting point", ParameterKind::Number)};
    made[3].choices = "none|fixed_flux|convective";
    made[5].unit = "K", made[5].displayUnit = "°C", made[5].displayOffset = -273.15, made[5].hardMaximum = 1e4;
    return made;
  }();
  return api::listOf(all.data(), all.size());
}

const api::ParameterDeclaration* find(std::string_view key) { return findDeclaration(list(), key); }

ValueOfKey valuesOf(std::map<std::string, Value> set) {
  return [values = ParameterSet{std::move(set)}](std::string_view key) -> std::optional<Value> {
    const api::ParameterDeclaration* declaration = find(key);
    return declaration ? std::optional(valueOf(values, *declaration)) : std::nullopt;
  };
}

Response falling() {
  Response curve;
  curve.kind = Response::Kind::Curve;
  curve.points = {{100, 9}, {400, 1}};
  return curve;
}

const std::map<std::string, Value> kValues{{"low", 2.0},         {"high", 3.0},
                                           {"on", true},         {"mode", std::string("fixed_flux")},
                                           {"curve", falling()}, {"melts", 273.15}};

}  // namespace

class TestParameters : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void conditionsHold_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("expected");
    const auto row = [](const char* text, bool expected) { QTest::newRow(text) << text << expected; };
    row("", true);
    row("on = on", true);
    row("on = off", false);
    row("on != off", true);
    row("mode = fixed_flux|convective", true);
    row("mode != fixed_flux|convective", false);
    row("low < high", true);
    row("low >= high", false);
    row("low <= 2", true);
    row("low > 2", false);
    row("low != 2", false);
    row("curve > 3", true);  // at 20 °C
    row("curve = constant", false);
    row("melts = 273.15 & on = on", true);
    row("melts > 0 & on = off", false);
    row("gone > 5", true);  // of a plugin that is not installed
  }
  void conditionsHold() {
    QFETCH(QString, text);
    QFETCH(bool, expected);
    QCOMPARE(holds(parseCondition(qPrintable(text)), valuesOf(kValues)), expected);
  }

  void relationsHold_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("breach");
    const auto row = [](const char* text, const char* breach) { QTest::newRow(text) << text << breach; };
    row("must be < high", "");
    row("must be > high", "must be above “High end” (3), not 2");
    row("must be > high when on = off", "");
    row("must be > high when on = on unless mode = fixed_flux", "");
    row("must be < 5; must be at", "?");
    row("must be < 5; must be >= high", "must be at least “High end” (3), not 2");
    row("plus high must be <= 5", "");
    row("plus high must be > 5", "and “High end” together must be above 5, not 5");
    row("must be = 7", "must be 7, not 2");
    row("should be > high", "");  // no must
  }
  void relationsHold() {
    QFETCH(QString, text);
    QFETCH(QString, breach);
    const QByteArray relations = text.toUtf8();
    api::ParameterDeclaration low = *find("low");
    low.relations = relations.constData();
    if (breach == "?") {
      QVERIFY_THROWS_EXCEPTION(InputError, parseRelations(low));
      return;
    }
    const auto found = firstBreach(api::listOf(&low, 1), valuesOf(kValues), find, true);
    QCOMPARE(found ? QString::fromStdString(found->sentence) : QString(), breach);
    const auto ofAnother = firstBreach(api::listOf(&low, 1), valuesOf(kValues), find, true, "melts");
    QVERIFY(!ofAnother);
  }

  void problemsAreTold_data() {
    QTest::addColumn<QString>("condition");
    QTest::addColumn<QString>("problem");
    const auto row = [](const char* condition, const char* problem) {
      QTest::newRow(condition) << condition << problem;
    };
    row("low", "\"low\" ends where a comparison is due");
    row("low >", "\"low >\" ends where a value is due");
    row("low is 3", "\"low is 3\" has no comparison in 'is'");
    row("low > 3 and on = on", "\"low > 3 and on = on\" goes on with 'and'");
    row("lower > 3", "its enabledWhen: there is no parameter 'lower'");
    row("low < higher", "its enabledWhen: there is no parameter 'higher'");
    row("mode = fixed", "its enabledWhen: 'mode' is never 'fixed'");
    row("on = yes", "its enabledWhen: 'on' is never 'yes'");
    row("mode > 1", "its enabledWhen: 'mode' or what it is compared with is no number");
    row("low = high", "its enabledWhen: 'low' is never 'high'");
  }
  void problemsAreTold() {
    QFETCH(QString, condition);
    QFETCH(QString, problem);
    const QByteArray text = condition.toUtf8();
    api::ParameterDeclaration low = *find("low");
    low.enabledWhen = text.constData();
    QCOMPARE(QString::fromStdString(problemOfRules(low, find)), problem);
  }

  void sentencesAreRead() {
    api::ParameterDeclaration d = *find("low");
    d.enabledWhen = "mode = fixed_flux|convective & melts > 0 & on != off & there/key = on";
    d.relations = "must be <= high unless on = on; plus high should be < 4 when melts >= 250";
    d.actsAt = api::ActsAt::NextReset;
    const std::vector<std::string> expected{
        "Must be at most “High end”, unless “Switch” is on.",
        "“Low end” and “High end” together should be below 4, when “Melting point” is at least −23.15 °C.",
        "Acts when “Mode” is fixed flux or convective and “Melting point” is not none and “Switch” is not off and "
        "“there/key” is on.",
        "Acts once back at the start."};
    QCOMPARE(ruleTexts(d, find), expected);
  }

  void valuesAreShownAsPeopleSeeThem() {
    const auto shown = [](double kelvin) { return QString::fromStdString(shownText(*find("melts"), kelvin)); };
    QCOMPARE(shown(273.15), QStringLiteral("0 °C"));
    QCOMPARE(shown(0), QStringLiteral("none"));
    QCOMPARE(shown(1e4 / 3), QStringLiteral("3060.18 °C"));
    QCOMPARE(QString::fromStdString(shownText(*find("low"), 1.0 / 3)), QStringLiteral("0.333333"));
    QCOMPARE(QString::fromStdString(shownText(*find("low"), 12345678)), QStringLiteral("12345678"));
  }
};

QTEST_APPLESS_MAIN(TestParameters)
#include "tst_parameters.moc"
