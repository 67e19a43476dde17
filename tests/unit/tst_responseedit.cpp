// SPDX-License-Identifier: Apache-2.0
#include "core/math/responseedit.h"

#include <QTest>

#include <cmath>

using namespace ps;

namespace {

Response law(const QString& name, const QList<double>& coefficients) {
  Response response;
  response.kind = Response::Kind::Law;
  response.law = name.toStdString();
  response.coefficients.assign(coefficients.begin(), coefficients.end());
  return response;
}

}  // namespace

class TestResponseEdit : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void pointsOfALawGiveItsCoefficientsBack_data() {
    QTest::addColumn<QList<double>>("coefficients");
    QTest::addColumn<double>("from");
    QTest::addColumn<double>("to");
    QTest::addColumn<double>("reference");
    QTest::newRow("linear") << QList<double>{1000, -0.4, 300} << 280.0 << 370.0 << 300.0;
    QTest::newRow("exponential") << QList<double>{1e8, 293.15, 10} << 290.0 << 340.0 << 293.15;
    QTest::newRow("arrhenius") << QList<double>{10, 95e3, 293.15} << 280.0 << 340.0 << 293.15;
    QTest::newRow("vogel") << QList<double>{-4.61726, 247.8, 140} << 275.0 << 370.0 << 0.0;           // water
    QTest::newRow("vogel glass") << QList<double>{-2.601, 4330.9, 519.25} << 800.0 << 1700.0 << 0.0;  // soda-lime
    QTest::newRow("thesis_sigmoid") << QList<double>{5e9, 273.15, 1.5} << 265.0 << 280.0 << 0.0;
    QTest::newRow("thesis_sigmoid rising") << QList<double>{0.6, 900, -40} << 700.0 << 1100.0 << 0.0;
  }
  void pointsOfALawGiveItsCoefficientsBack() {
    QFETCH(QList<double>, coefficients);
    QFETCH(double, from);
    QFETCH(double, to);
    QFETCH(double, reference);
    const QString name = QString::fromLatin1(QTest::currentDataTag()).section(QLatin1Char(' '), 0, 0);
    const LawFit fit = fitLaw(name.toStdString(), sampled(law(name, coefficients), from, to, 8), reference);
    QCOMPARE(QString::fromStdString(fit.problem), QString());
    // 1e-6: values are rounded to 40 bits (1e-12), and the least certain coefficient, a Vogel law's A or B, takes
    // that up some thousand times; the rest is what the solver's numerical slopes leave.
    for (qsizetype i = 0; i < coefficients.size(); ++i) {
      const double got = fit.law.coefficients[static_cast<size_t>(i)];
      QVERIFY2(std::abs(got / coefficients[i] - 1) < 1e-6, qPrintable(QString::number(got, 'g', 12)));
    }
    QVERIFY(fit.error < 1e-8 * std::max(1.0, std::abs(coefficients[0])));
  }

  void aFitLeavesTheErrorOfWhatNoLawGives() {
    // Of y = x^2 at -1, 0, 1 around 300 K the nearest line is y = 2/3; what is left are 1/3, -2/3, 1/3.
    const std::vector<CurvePoint> points{{299, 1}, {300, 0}, {301, 1}};
    const LawFit fit = fitLaw("linear", points, 300);
    QVERIFY(std::abs(fit.law.coefficients[0] - 2.0 / 3) < 1e-12);
    QVERIFY(std::abs(fit.law.coefficients[1]) < 1e-12);
    QVERIFY(std::abs(fit.error - std::sqrt(2.0 / 9)) < 1e-12);
  }

  void whatCannotBeFittedIsSaid() {
    const std::vector<CurvePoint> two{{300, 1}, {310, 2}}, zero{{300, 1}, {310, 0}, {320, 0}};
    QVERIFY(QString::fromStdString(fitLaw("vogel", two, 300).problem).contains(QLatin1String("3 points")));
    QVERIFY(QString::fromStdString(fitLaw("arrhenius", zero, 300).problem).contains(QLatin1String("above 0")));
    QVERIFY(!fitLaw("vogle", two, 300).problem.empty());
    const std::vector<CurvePoint> rising{{300, 1}, {310, 2}, {320, 4}};  // B would be below 0
    QVERIFY(!fitLaw("vogel", rising, 300).problem.empty());
  }

  void pointsComeMoveAndGo() {
    Response curve = curveThrough({{300, 1}, {400, 3}});
    QVERIFY(addPoint(curve, {350, 2}));
    QVERIFY(!addPoint(curve, {350.001, 9}));
    QCOMPARE(curve.points.size(), size_t{3});
    QCOMPARE(curve.at(350), 2.0);
    movePoint(curve, 1, {500, 5});
    QCOMPARE(curve.points[1].x, 400 - kPointGap);
    QCOMPARE(curve.points[1].y, 5.0);
    QCOMPARE(QString::fromStdString(curve.problem()), QString());
    removePoint(curve, 1);
    QVERIFY(curve == curveThrough({{300, 1}, {400, 3}}));
    removePoint(curve, 0);
    removePoint(curve, 0);
    QVERIFY(curve == curveThrough({{400, 3}}));
  }

  void allPointsMoveTogether() {
    const Response curve = curveThrough({{300, 1}, {400, 3}});
    QVERIFY(shifted(curve, 10, 0.5, 1) == curveThrough({{310, 1.5}, {410, 3.5}}));
    QVERIFY(shifted(curve, -10, 0, 2) == curveThrough({{290, 2}, {390, 6}}));
  }

  void waysBetweenPointsAreChosen() {
    Response curve = curveThrough({{300, 1}, {310, 3}, {330, 4}});
    const Response monotone = curve;
    QVERIFY(betweenOf(curve, 0) == Between::Monotone && hasSlope(curve, 1, false) && hasSlope(curve, 1, true));
    QVERIFY(!hasSlope(curve, 0, false) && !hasSlope(curve, 2, true));
    setBetween(curve, 0, Between::Stated);  // as it was, but for rounding, and no other piece knows of it
    QVERIFY(betweenOf(curve, 0) == Between::Stated && betweenOf(curve, 1) == Between::Monotone);
    for (double t = 300; t < 330; t += 1) QVERIFY(std::abs(curve.at(t) - monotone.at(t)) < 1e-12);
    setBetween(curve, 0, Between::Monotone);
    QVERIFY(curve == monotone);
    setBetween(curve, 1, Between::Step);
    QVERIFY(betweenOf(curve, 1) == Between::Step && !hasSlope(curve, 1, true) && hasSlope(curve, 1, false));
    stateSlope(curve, 1, 0.5);  // of the smooth piece alone
    QCOMPARE(curve.points[1].slopeBefore, std::optional(0.5));
    QVERIFY(!curve.points[1].slopeAfter);
    QVERIFY(addPoint(curve, {320, 3}));  // divides a step into two
    QVERIFY(curve.points[1].toNext == ToNext::Step && curve.points[2].toNext == ToNext::Step);
    movePoint(curve, 1, {311, 2});
    QCOMPARE(curve.points[1].slopeBefore, std::optional(0.5));
    const Response doubled = shifted(curve, 5, 0, 2);
    QCOMPARE(doubled.points[1].slopeBefore, std::optional(1.0));
    QVERIFY(doubled.points[1].toNext == ToNext::Step);
  }

  /// Of a straight line only the ends are needed, of two with a kink that point too, of a step its sides.
  void asFewPointsAsNeededAreLeft() {
    std::vector<CurvePoint> line, kinked, steps;
    for (int k = 0; k <= 20; ++k) {
      line.push_back({300.0 + k, 2.0 + k, ToNext::Linear});
      kinked.push_back({300.0 + k, 10.0 + (k < 8 ? k : 8 + 3 * (k - 8)), ToNext::Linear});
      steps.push_back({300.0 + k, k < 8 ? 1.0 : 2.0, ToNext::Step});
    }
    QCOMPARE(thinned(curveThrough(line), 1e-6, false).curve.points.size(), size_t{2});
    const Thinned bent = thinned(curveThrough(kinked), 1e-6, true);
    QCOMPARE(bent.curve.points.size(), size_t{3});
    QCOMPARE(bent.curve.points[1].x, 308.0);
    QVERIFY(bent.error < 1e-12);
    const Thinned stepped = thinned(curveThrough(steps), 1e-6, false);
    QCOMPARE(stepped.curve.points.size(), size_t{3});
    QCOMPARE(stepped.curve.points[1].x, 308.0);
    // What law and constant become stays on them: over seven decades of a liquid's viscosity, and by two points.
    const Response vogel = law(QStringLiteral("vogel"), {-4.61726, 247.8, 140});
    const Response points = asPoints(vogel, 173.15, 363.15, true);
    QVERIFY(points.points.size() < 30);
    for (double t = 173.15; t < 363.15; t += 0.1)
      QVERIFY(std::abs(std::log(points.at(t) / vogel.at(t))) < 1.01 * kLawTolerance);
    QVERIFY(asPoints(Response(4), 200, 300, true) == curveThrough({{200, 4}, {300, 4}}));
    // A curve that nothing less shows stays; what is left is never farther off than was asked for.
    std::vector<CurvePoint> noisy;
    for (int k = 0; k <= 60; ++k) noisy.push_back({300.0 + k, 5 + std::sin(0.9 * k) + 0.3 * std::sin(7.0 * k)});
    for (const double tolerance : {1e-9, 0.01, 0.1}) {
      const Thinned thin = thinned(curveThrough(noisy), tolerance, false);
      QVERIFY(thin.error <= tolerance);
      if (tolerance < 1e-6) QCOMPARE(thin.curve.points.size(), noisy.size());
    }
  }

  void aLawIsSampledAtEvenDistances() {
    const Response line = law(QStringLiteral("linear"), {10, 2, 300});
    QVERIFY(curveThrough(sampled(line, 300, 320, 3)) == curveThrough({{300, 10}, {310, 30}, {320, 50}}));
  }
};

QTEST_APPLESS_MAIN(TestResponseEdit)
#include "tst_responseedit.moc"
