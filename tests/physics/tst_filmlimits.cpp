// SPDX-License-Identifier: Apache-2.0
// What particles cannot show of liquid that flows along a wall is told, and nothing else is.
#include "viscosityscene.h"

#include <QTest>

using namespace viscous;
using ps::Solver;
using ps::SolverSettings;
using ps::ViscosityModel;

class TestFilmLimits : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void filmsTellWhatTheyCannot_data() {
    QTest::addColumn<double>("nu");  // m2/s
    QTest::addColumn<double>("degrees");
    QTest::addColumn<int>("layers");
    QTest::addColumn<bool>("filter");
    QTest::addColumn<bool>("noSlip");
    QTest::addColumn<int>("substeps");
    QTest::addColumn<double>("seconds");
    QTest::addColumn<QString>("told");  // "": nothing
    QTest::addColumn<QString>("use");
    const auto row = [](const char* name, double nu, double degrees, int layers, double seconds, const char* told,
                        const char* use, bool filter = false, bool noSlip = true, int substeps = 4) {
      QTest::newRow(name) << nu << degrees << layers << filter << noSlip << substeps << seconds << QString(told)
                          << QString(use);
    };
    row("two layers", 0.01, 10, 2, 0.5, "syrup.viscosity", "solver/particle_spacing=0.01");
    row("three layers", 0.01, 10, 3, 0.5, "", "");
    row("six layers", 0.01, 10, 6, 0.5, "", "");
    row("two layers that rest", 0.01, 0, 2, 1, "", "");
    row("two layers on a slippery wall", 0.01, 10, 2, 0.5, "", "", false, false);
    row("0.3 degrees", 0.01, 0.3, 6, 1, "syrup.viscosity", "");
    row("2 degrees", 0.01, 2, 6, 0.5, "", "");
    row("1.2 degrees, six layers", 0.01, 1.2, 6, 1, "", "");
    row("1.2 degrees, ten layers", 0.01, 1.2, 10, 1, "syrup.viscosity", "");
    row("3 degrees, ten layers", 0.01, 3, 10, 0.5, "", "");
    row("3 degrees, sixteen layers", 0.01, 3, 16, 0.5, "syrup.viscosity", "", false, true, 8);
    row("filter, though the wall holds it", 3e-4, 5, 3, 1, "syrup.viscosity", "solver/viscosity_model=implicit", true);
    row("filter, before the wall could", 1e-6, 5, 3, 1, "", "", true);
    row("filter on a slippery wall", 3e-4, 5, 3, 1, "", "", true, false);
    row("thinner than calming", 3e-4, 5, 6, 0.5, "syrup.viscosity", "solver/xsph_minimum=0");
    row("one substep, twelve layers", 0.01, 10, 12, 1.5, "solver.substeps", "solver/substeps=", false, true, 1);
    row("one substep, four layers", 0.01, 10, 4, 1.5, "", "", false, true, 1);
  }
  void filmsTellWhatTheyCannot() {
    QFETCH(double, nu);
    QFETCH(double, degrees);
    QFETCH(int, layers);
    QFETCH(bool, filter);
    QFETCH(bool, noSlip);
    QFETCH(int, substeps);
    QFETCH(double, seconds);
    QFETCH(QString, told);
    QFETCH(QString, use);
    constexpr double kSpacing = 0.02, kHalf = 4 * kSpacing;
    Solver solver;
    SolverSettings settings = settingsOf(kSpacing);
    const double lean = degrees * kPi / 180;
    settings.gravity = {9.81 * std::sin(lean), -9.81 * std::cos(lean), 0};
    settings.substeps = substeps;
    if (filter) settings.viscosityModel = ViscosityModel::Xsph;
    prepare(solver, settings, syrup(1000 * nu));
    ps::Bounds bounds;
    bounds.minimum = {-kHalf, -0.1, -kHalf};
    bounds.maximum = {kHalf, 1, kHalf};
    bounds.periodic = {true, false, true};
    solver.setBounds(bounds);
    ps::Wall floor;
    floor.noSlip = noSlip;
    solver.setWalls({floor});
    solver.spawn(liquid(lattice(8, layers, 8, kSpacing, 0)));
    QVERIFY(run(solver, static_cast<int>(std::lround(60 * seconds))));
    const std::vector<ps::Limit> limits = solver.limits();
    if (told.isEmpty()) {
      QVERIFY2(limits.empty(), limits.empty() ? "" : (limits[0].what + ": " + limits[0].why).c_str());
      return;
    }
    QCOMPARE(limits.size(), size_t{1});
    QCOMPARE(QString::fromStdString(limits[0].what), told);
    QVERIFY(!limits[0].why.empty() && std::abs(limits[0].delivered / limits[0].asked - 1) > 0.1);
    QVERIFY2(QString::fromStdString(limits[0].use).startsWith(use), limits[0].use.c_str());
  }

  /// On a bed of fixed particles as on a plane; in a channel of them neither slopes nor thin films are.
  void filmsOnFixedParticlesTellLikewise_data() {
    QTest::addColumn<double>("degrees");
    QTest::addColumn<int>("layers");
    QTest::addColumn<bool>("channel");
    QTest::addColumn<QString>("why");  // "": nothing is told
    QTest::newRow("three layers") << 10.0 << 3 << false << "few particles thick";
    QTest::newRow("six layers") << 10.0 << 6 << false << "";
    QTest::newRow("0.5 degrees") << 0.5 << 6 << false << "gentle a slope";
    QTest::newRow("1.2 degrees, ten layers") << 1.2 << 10 << false << "gentle a slope";
    QTest::newRow("at rest") << 0.0 << 3 << false << "";
    QTest::newRow("a channel of three layers") << 10.0 << 3 << true << "";
  }
  void filmsOnFixedParticlesTellLikewise() {
    QFETCH(double, degrees);
    QFETCH(int, layers);
    QFETCH(bool, channel);
    QFETCH(QString, why);
    constexpr double kSpacing = 0.02, kHalf = 4 * kSpacing;
    Solver solver;
    SolverSettings settings = settingsOf(kSpacing);
    const double lean = degrees * kPi / 180;
    settings.gravity = {9.81 * std::sin(lean), -9.81 * std::cos(lean), 0};
    prepare(solver, settings, syrup(10));
    ps::Bounds bounds;
    bounds.minimum = {-kHalf, -0.1, -kHalf};
    bounds.maximum = {kHalf, 1, kHalf};
    bounds.periodic = {true, false, true};
    solver.setBounds(bounds);
    solver.spawn(fixedPoints(lattice(8, 3, 8, kSpacing, -3 * kSpacing)));
    if (channel) solver.spawn(fixedPoints(lattice(8, 3, 8, kSpacing, layers * kSpacing)));
    solver.spawn(liquid(lattice(8, layers, 8, kSpacing, 0)));
    QVERIFY(run(solver, 60));
    const std::vector<ps::Limit> limits = solver.limits();
    QCOMPARE(limits.size(), why.isEmpty() ? size_t{0} : size_t{1});
    if (why.isEmpty()) return;
    QCOMPARE(limits[0].what, std::string("syrup.viscosity"));
    QVERIFY2(limits[0].why.find(why.toStdString()) != std::string::npos, limits[0].why.c_str());
    QVERIFY(std::abs(limits[0].delivered / limits[0].asked - 1) > 0.1);
  }

  /// Between two planes that it fills, a liquid driven weakly moves as one (0.65 of Poiseuille's flow at 0.3 m/s2, with
  /// 16 substeps 0.36 at 1 m/s2); driven harder, its layers pass each other. The limit says how much is left, roughly.
  void gapsThatAreFullTell_data() {
    QTest::addColumn<double>("drive");  // m/s2
    QTest::addColumn<int>("substeps");
    QTest::addColumn<double>("gap");  // m; the liquid has eight layers of 20 mm
    QTest::addColumn<bool>("told");
    QTest::newRow("weakly") << 0.3 << 4 << 0.16 << true;
    QTest::newRow("harder") << 3.0 << 4 << 0.16 << false;
    QTest::newRow("16 substeps") << 1.0 << 16 << 0.16 << true;
    QTest::newRow("1 substep") << 1.0 << 1 << 0.16 << false;
    QTest::newRow("not full") << 0.3 << 4 << 0.32 << false;
    QTest::newRow("at rest") << 0.0 << 4 << 0.16 << false;
  }
  void gapsThatAreFullTell() {
    QFETCH(double, drive);
    QFETCH(int, substeps);
    QFETCH(double, gap);
    QFETCH(bool, told);
    constexpr double kSpacing = 0.02, kHalf = 4 * kSpacing, kNu = 0.02;
    Solver solver;
    SolverSettings settings = settingsOf(kSpacing);
    settings.gravity = {drive, 0, 0};
    settings.substeps = substeps;
    prepare(solver, settings, syrup(1000 * kNu));
    ps::Bounds bounds;
    bounds.minimum = {-kHalf, -0.1, -kHalf};
    bounds.maximum = {kHalf, 1, kHalf};
    bounds.periodic = {true, false, true};
    solver.setBounds(bounds);
    ps::Wall floor, lid;
    lid.normal = {0, -1, 0};
    lid.offset = -gap;
    solver.setWalls({floor, lid});
    solver.spawn(liquid(lattice(8, 8, 8, kSpacing, 0)));
    QVERIFY(run(solver, 60));
    const std::vector<ps::Limit> limits = solver.limits();
    QCOMPARE(limits.size(), told ? size_t{1} : size_t{0});
    if (!told) return;
    QVERIFY2(limits[0].why.find("no room to pass") != std::string::npos, limits[0].why.c_str());
    double sum = 0;
    const ps::ParticleStore& p = solver.particles();
    for (size_t i = 0; i < p.size(); ++i) sum += double{p.velocity()[i].x};
    const double delivered = sum / static_cast<double>(p.size()) / (drive * gap * gap / (12 * kNu));
    const double said = limits[0].asked / limits[0].delivered;
    QVERIFY2(std::abs(said - delivered) < 0.2, qPrintable(QString("%1 said, %2").arg(said).arg(delivered)));
  }

  /// Where a wall is that liquid sticks to, Automatic takes the solver that knows walls: what a wall drags along by a
  /// spacing in some seconds, but no water.
  void automaticKnowsWalls_data() {
    QTest::addColumn<double>("nu");
    QTest::addColumn<bool>("noSlip");
    QTest::addColumn<bool>("implicit");
    QTest::newRow("oil on a wall") << 1e-4 << true << true;
    QTest::newRow("oil on a slippery wall") << 1e-4 << false << false;
    QTest::newRow("water on a wall") << 1e-6 << true << false;
  }
  void automaticKnowsWalls() {
    QFETCH(double, nu);
    QFETCH(bool, noSlip);
    QFETCH(bool, implicit);
    Solver solver;
    prepare(solver, settingsOf(0.02), syrup(1000 * nu));
    ps::Wall floor;
    floor.noSlip = noSlip;
    solver.setWalls({floor});
    solver.spawn(liquid(lattice(4, 4, 4, 0.02, 0)));
    QVERIFY(run(solver, 2));
    QCOMPARE(solver.particles().find("viscous_change", ps::api::FieldType::Float4) != nullptr, implicit);
  }
};

QTEST_APPLESS_MAIN(TestFilmLimits)
#include "tst_filmlimits.moc"
