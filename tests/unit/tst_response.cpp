// SPDX-License-Identifier: Apache-2.0
#include "core/math/response.h"

#include <QTest>

#include <cmath>

using ps::Response;
using ps::ResponseTable;
using ps::ToNext;

namespace {
Response curve(std::vector<ps::CurvePoint> points) {
  Response response;
  response.kind = Response::Kind::Curve;
  response.points = std::move(points);
  return response;
}
Response law(const char* name, std::vector<double> coefficients) {
  Response response;
  response.kind = Response::Kind::Law;
  response.law = name;
  response.coefficients = std::move(coefficients);
  return response;
}
}  // namespace

class TestResponse : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void lawsGiveTheirPublishedValues_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QList<double>>("coefficients");
    QTest::addColumn<double>("kelvin");
    QTest::addColumn<double>("expected");
    // Water: mu = 2.414e-5 10^(247.8/(T - 140)) Pa s.
    const QList<double> water{-4.61726, 247.8, 140};
    QTest::newRow("water 20 C") << "vogel" << water << 293.15 << 0.00100175;
    QTest::newRow("water 80 C") << "vogel" << water << 353.15 << 0.000350993;
    // Soda-lime glass DGG-1: log10 mu = -2.601 + 4330.9/(T_C - 246.1).
    const QList<double> glass{-2.601, 4330.9, 519.25};
    QTest::newRow("glass 600 C") << "vogel" << glass << 873.15 << 4331490000.0;
    QTest::newRow("glass 1000 C") << "vogel" << glass << 1273.15 << 1392.07;
    QTest::newRow("honey 40 C") << "arrhenius" << QList<double>{10, 95e3, 293.15} << 313.15 << 0.829681;
    QTest::newRow("wax softens") << "exponential" << QList<double>{1e8, 293.15, 10} << 303.15 << 1e8 / std::exp(1.0);
    QTest::newRow("linear") << "linear" << QList<double>{2, 0.5, 300} << 310.0 << 7.0;
    // The thesis's stiffness: E(+1 K) = 0.537883 E0, E(-5 K) = 1.98661 E0, equal to E0 at T_ref.
    QTest::newRow("thesis +1 K") << "thesis_sigmoid" << QList<double>{1, 300, 1} << 301.0 << 0.537883;
    QTest::newRow("thesis -5 K") << "thesis_sigmoid" << QList<double>{1, 300, 1} << 295.0 << 1.98661;
  }
  void lawsGiveTheirPublishedValues() {
    QFETCH(QString, name);
    QFETCH(QList<double>, coefficients);
    QFETCH(double, kelvin);
    QFETCH(double, expected);
    const Response response = law(name.toUtf8().constData(), {coefficients.begin(), coefficients.end()});
    QCOMPARE(QString::fromStdString(response.problem()), QString());
    // 1e-4: the references have six digits, honey's and glass's three in their coefficients.
    QVERIFY2(std::abs(response.at(kelvin) / expected - 1) < 1e-4,
             qPrintable(QString::number(response.at(kelvin), 'g', 9)));
  }

  void scaledIsTimesTheFactorEverywhere() {
    Response curve;
    curve.kind = Response::Kind::Curve;
    curve.points = {{250, 2}, {300, 5}, {350, 3}};
    for (const Response& response :
         {Response(4.0), curve, law("linear", {3, 0.01, 293}), law("exponential", {1e8, 293, 12}),
          law("arrhenius", {10, 95e3, 293}), law("vogel", {-4.6, 247.8, 140}), law("thesis_sigmoid", {2, 300, 5})}) {
      for (const double t : {260.0, 293.0, 340.0}) {
        const double asked = 2.5 * response.at(t);
        QVERIFY2(std::abs(response.scaled(2.5).at(t) - asked) <= 1e-12 * asked, response.law.c_str());
      }
    }
  }

  void lawsStayFiniteEverywhere() {
    for (const Response& response :
         {law("vogel", {-4.6, 247.8, 140}), law("arrhenius", {10, 95e3, 293}), law("exponential", {1e8, 293, 0.01})}) {
      for (double t = 0.5; t < 5000; t *= 1.3) {
        QVERIFY2(std::isfinite(response.at(t)), response.law.c_str());
        QVERIFY(response.at(t) >= 0);
      }
    }
  }

  void curvesPassThroughTheirPointsAndNeverOvershoot_data() {
    QTest::addColumn<QList<double>>("values");
    QTest::newRow("steps") << QList<double>{0, 0, 0, 1, 1, 1};
    QTest::newRow("rising") << QList<double>{0, 0.1, 5, 5.1, 30, 31};
    QTest::newRow("peak") << QList<double>{999.84, 999.97, 999.7, 998.2, 992.2, 958.4};
    QTest::newRow("zigzag") << QList<double>{1, -1, 1, -1, 1, -1};
  }
  void curvesPassThroughTheirPointsAndNeverOvershoot() {
    QFETCH(QList<double>, values);
    std::vector<ps::CurvePoint> points;
    for (qsizetype i = 0; i < values.size(); ++i) points.push_back({273.0 + 7.0 * double(i * i + 1), values[i]});
    const Response response = curve(points);
    for (size_t k = 0; k + 1 < points.size(); ++k) {
      QCOMPARE(response.at(points[k].x), points[k].y);
      const double low = std::min(points[k].y, points[k + 1].y), high = std::max(points[k].y, points[k + 1].y);
      double before = points[k].y;
      for (int s = 1; s <= 50; ++s) {
        const double y = response.at(points[k].x + (points[k + 1].x - points[k].x) * s / 50);
        QVERIFY(y >= low - 1e-12 && y <= high + 1e-12);  // rounding only
        QVERIFY((y - before) * (points[k + 1].y - points[k].y) >= -1e-12);
        before = y;
      }
    }
    QCOMPARE(response.at(0), points.front().y);
    QCOMPARE(response.at(1e5), points.back().y);
  }

  void smoothCurvesAreFollowed() {
    std::vector<ps::CurvePoint> points;
    for (int i = 0; i <= 10; ++i) points.push_back({300.0 + 10 * i, std::pow(1.02, 10 * i)});
    const Response response = curve(points);
    // Third-order interpolation at h = 10 K of exp(0.0198 t): well under 0.1 %.
    for (double t = 300; t <= 400; t += 1) QVERIFY(std::abs(response.at(t) / std::pow(1.02, t - 300) - 1) < 1e-3);
  }

  void piecesGoAsTheirPointsSay() {
    const Response mixed = curve({{200, 10, ToNext::Step}, {220, 20, ToNext::Linear}, {240, 40}, {260, 10}});
    QCOMPARE(mixed.at(219.999), 10.0);
    QCOMPARE(mixed.at(220), 20.0);
    QCOMPARE(mixed.at(230), 30.0);
    QCOMPARE(mixed.at(240), 40.0);
    QVERIFY(mixed.at(250) > 10 && mixed.at(250) < 40);
    QVERIFY(mixed.turns().empty());
    QVERIFY(!(mixed == curve({{200, 10}, {220, 20}, {240, 40}, {260, 10}})));
    const Response scaled = mixed.scaled(3);
    for (double t = 190; t < 270; t += 1) QVERIFY(std::abs(scaled.at(t) - 3 * mixed.at(t)) < 1e-12 * scaled.at(t));
  }

  /// Of y = 4 t (1 - t), which no monotone curve through its ends shows: it turns half way, at 1.
  void statedSlopesAreTakenAndTurnWhereTheyLead() {
    const auto bow = [](double k) {
      Response bowed = curve({{300, 0}, {310, 0}});
      bowed.points[0].slopeAfter = 0.4 * k;
      bowed.points[1].slopeBefore = -0.4 * k;
      return bowed;
    };
    for (double t = 0; t <= 1; t += 0.125) QVERIFY(std::abs(bow(1).at(300 + 10 * t) - 4 * t * (1 - t)) < 1e-12);
    const auto turns = bow(1).turns();
    QCOMPARE(turns.size(), size_t{1});
    QVERIFY(std::abs(turns[0].x - 305) < 1e-9 && std::abs(turns[0].y - 1) < 1e-12);
    QVERIFY(bow(1).scaled(2) == bow(2));
    Response wave = curve({{300, 0}, {301, 0}});  // t (2t - 1) (t - 1): twice, at 1/2 -+ sqrt(1/12)
    wave.points[0].slopeAfter = wave.points[1].slopeBefore = 1;
    QCOMPARE(wave.turns().size(), size_t{2});
    for (const auto& turn : wave.turns()) QVERIFY(std::abs(std::abs(turn.x - 300.5) - std::sqrt(1.0 / 12)) < 1e-12);
    wave.points[0].slopeAfter = 1e300;  // beside it the other is nothing: t (t - 1)^2, which turns at a third
    QCOMPARE(wave.turns().size(), size_t{1});
    QVERIFY(std::abs(wave.turns()[0].x - 300 - 1.0 / 3) < 1e-9);
    QVERIFY(wave.turns()[0].y > 1e299);
    wave.points[1].x = 1e300;  // no number, but no infinity either
    QVERIFY(std::isfinite(wave.at(1e200)));
  }

  void problemsAreNamed_data() {
    QTest::addColumn<Response>("response");
    QTest::addColumn<QString>("part");
    QTest::newRow("not a number") << Response(std::nan("")) << "not a finite number";
    QTest::newRow("empty curve") << curve({}) << "at least one point";
    QTest::newRow("descending") << curve({{300, 1}, {290, 2}}) << "ascend";
    QTest::newRow("twice the same") << curve({{300, 1}, {300, 2}}) << "ascend";
    QTest::newRow("infinite point") << curve({{300, INFINITY}}) << "point 0";
    QTest::newRow("infinite slope") << curve({{300, 1}, {310, 1, ToNext::Smooth, {}, INFINITY}}) << "point 1";
    QTest::newRow("unknown law") << law("vogle", {1, 2, 3}) << "unknown law 'vogle'";
    QTest::newRow("count") << law("vogel", {1, 2}) << "takes 3 coefficients, not 2";
    QTest::newRow("nan coefficient") << law("linear", {1, std::nan(""), 3}) << "coefficient";
    QTest::newRow("zero width") << law("exponential", {1, 300, 0}) << "must not be zero";
  }
  void problemsAreNamed() {
    QFETCH(Response, response);
    QFETCH(QString, part);
    QVERIFY2(QString::fromStdString(response.problem()).contains(part), response.problem().c_str());
  }

  void everyLawSaysItsCoefficients() {
    for (const std::string& name : ps::lawNames()) {
      QVERIFY(ps::lawCoefficientCount(name) > 0);
      QVERIFY(!ps::lawHelp(name).empty());
    }
    QCOMPARE(ps::lawCoefficientCount("none such"), size_t{0});
  }

  void tablesIntegrateTheirInterpolantExactly() {
    const ResponseTable table(law("linear", {2, 0.01, 300}), 100, 500, 64);
    // The integral of a line is a parabola; trapezia are exact for it.
    const auto exact = [](double t) { return (2 - 3) * (t - 100) + 0.005 * (t * t - 100 * 100); };
    for (double t = 100; t <= 500; t += 13) {
      QVERIFY(std::abs(table.at(t) - (2 + 0.01 * (t - 300))) < 1e-12);
      QVERIFY(std::abs(table.integral(t) - exact(t)) < 1e-9);
    }
    // Beyond the ends the end values hold.
    QVERIFY(std::abs(table.integral(600) - exact(500) - 100 * table.at(500)) < 1e-9);
    QVERIFY(std::abs(table.integral(50) + 50 * table.at(100)) < 1e-9);
  }

  /// A step is baked as wide as the grid is, and its integral, which is heat, is off by half of that at most.
  void aStepIsAsWideAsTheGrid() {
    const Response stepped = curve({{300, 2, ToNext::Step}, {350, 5, ToNext::Step}, {400, 5}});
    const ResponseTable table(stepped, 300, 400, 201);  // half a kelvin
    QCOMPARE(table.at(349.4), 2.0);
    QCOMPARE(table.at(350.1), 5.0);
    QVERIFY(std::abs(table.integral(400) - (2 * 50 + 5 * 50)) <= 0.5 * 0.5 * 3 + 1e-9);
  }

  void tablesFollowTheirResponse() {
    const Response response = law("vogel", {-4.61726, 247.8, 140});
    const ResponseTable table(response, 1, 3000, 2048);
    // Grid of 1.5 K: linear interpolation of water's viscosity errs by (h^2/8) f''/f, under 0.1 % from 0 to 100 °C.
    for (double t = 273.15; t < 373.15; t += 0.7) QVERIFY(std::abs(table.at(t) / response.at(t) - 1) < 1e-3);
  }

  void equalResponsesCompareEqual() {
    QVERIFY(Response(1.0) == Response(1.0));
    QVERIFY(!(Response(1.0) == Response(2.0)));
    QVERIFY(curve({{1, 2}}) == curve({{1, 2}}));
    QVERIFY(!(curve({{1, 2}}) == curve({{1, 3}})));
    QVERIFY(!(law("linear", {1, 2, 3}) == law("vogel", {1, 2, 3})));
  }
};

QTEST_APPLESS_MAIN(TestResponse)
#include "tst_response.moc"
