// SPDX-License-Identifier: Apache-2.0
// Soft bodies that strike something.
#include "onehash.h"
#include "softscene.h"

#include "core/base/statestream.h"

#include <QTest>

#include <array>
#include <memory>

using namespace soft;
using ps::Solver;
using ps::SolverSettings;
using ps::constraint::BondModel;
using ps::constraint::ClusterModel;

namespace {

const BondModel kBonds;
const ClusterModel kClusters;

ps::Material bouncing(double restitution, double modulus, double friction = 0.3) {
  ps::Material m = matter(1100, modulus);
  m.properties["restitution"] = restitution;
  m.properties["friction_static"] = m.properties["friction_kinetic"] = friction;
  return m;
}

uint32_t addSet(Solver& solver, bool clusters) {
  if (clusters) return solver.addConstraintSet(&kClusters, "clusters", parametersOf(kClusters));
  return solver.addConstraintSet(&kBonds, "bonds", parametersOf(kBonds));
}

struct Drop {
  double restitution = 0.7, height = 0.5, modulus = 1e6, spacing = 0.02;
  std::array<int, 3> particles{5, 5, 5};
  bool clusters = true, onParticles = false;
  int substeps = 4, iterations = 4;
};

/// m, how high the centre comes back after the first impact, above its place when it touches.
double reboundOf(const Drop& d) {
  Solver solver;
  SolverSettings settings = settingsOf(d.spacing);
  settings.substeps = d.substeps;
  settings.iterations = d.iterations;
  prepare(solver, settings, bouncing(d.restitution, d.modulus));
  solver.setBounds({{-10, -10, -10}, {10, 10, 10}, {}});
  if (d.onParticles) {
    ps::Spawn floor = fixedPoints(lattice(16, 2, 16, d.spacing, -2 * d.spacing));
    floor.body = 1;
    solver.spawn(floor);
  } else {
    solver.setWalls({tray(1)[0]});
  }
  const auto [nx, ny, nz] = d.particles;
  solver.spawn(solid(lattice(nx, ny, nz, d.spacing, d.height), addSet(solver, d.clusters)));
  const double touch = 0.5 * ny * d.spacing, fall = std::sqrt(2 * d.height / 9.81);
  const int struck = static_cast<int>(60 * fall),
            end = struck + static_cast<int>(60 * (1.3 * d.restitution * fall + 0.07));
  double top = -1, low = 1e30;
  for (int f = 0; f < end; ++f) {
    if (solver.step().flags != 0) return -1;
    if (f < struck) continue;
    const double y = sumsOf(solver, 0).centre.y() - touch;
    if (y < low) low = top = y;  // still on its way down
    top = std::max(top, y);
    if (y < top - 0.002) break;  // on its way to the next impact
  }
  return top;
}

/// A cube of bonds that strikes another one, aslant and off its middle, above a floor.
void prepareStrike(Solver& solver, bool matter = true) {
  prepare(solver, settingsOf(0.02), bouncing(0.7, 3e5));
  solver.setBounds({{-10, -10, -10}, {10, 10, 10}, {}});
  solver.setWalls({tray(1)[0]});
  for (const bool upper : {false, true}) {
    ps::Spawn spawn = solid(lattice(4, 4, 4, 0.02, upper ? 0.11 : 0.005), addSet(solver, false));
    if (!matter) continue;
    for (ps::api::Double3& p : spawn.position) p.x += upper ? 0.025 : 0;
    if (upper) spawn.velocity.assign(spawn.position.size(), {0.5, -2, 0});
    spawn.body = upper ? 1 : 0;
    solver.spawn(spawn);
  }
}

uint64_t hashOfStrike() {
  Solver solver;
  prepareStrike(solver);
  for (int f = 0; f < 12; ++f) {
    if (solver.step().flags != 0) return 0;
  }
  return solver.stateHash();
}

}  // namespace

Q_DECLARE_METATYPE(Drop)

class TestRebound : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }
  void cleanup() { ps::setInstructionSet(""); }

  void everyMachineGivesOneHash_data() { onehash::addRows(); }
  void everyMachineGivesOneHash() { onehash::verify(hashOfStrike); }

  /// Stopped in each frame of the impact and gone on with by another solver: the same bits.
  void impactsGoOnFromTheirState() {
    Solver whole;
    prepareStrike(whole);
    auto part = std::make_unique<Solver>();
    prepareStrike(*part);
    int during = 0;
    for (int f = 0; f < 12; ++f) {
      part->step();
      whole.step();
      QCOMPARE(part->stateHash(), whole.stateHash());
      ps::StateBuffer buffer;
      ps::StateWriter writer(buffer);
      part->save(writer);
      writer.finish();
      during += ps::StateReader(buffer.bytes()).has("rebound/encounters") ? 1 : 0;
      part = std::make_unique<Solver>();
      prepareStrike(*part, false);
      part->restore(ps::StateReader(buffer.bytes()));
    }
    QVERIFY2(during > 2, qPrintable(QString::number(during)));
  }

  void dropsComeBackAsHighAsAsked_data() {
    QTest::addColumn<Drop>("drop");
    for (const double e : {0.0, 0.3, 0.7, 1.0}) {
      QTest::addRow("clusters, e = %g", e) << Drop{.restitution = e};
      QTest::addRow("bonds, e = %g", e) << Drop{.restitution = e, .clusters = false};
      QTest::addRow("bonds on particles, e = %g", e) << Drop{.restitution = e, .clusters = false, .onParticles = true};
    }
    QTest::newRow("half the spacing") << Drop{.spacing = 0.01, .particles = {10, 10, 10}};
    QTest::newRow("from 0.1 m") << Drop{.height = 0.1};
    QTest::newRow("from 2 m") << Drop{.height = 2};
    QTest::newRow("upright") << Drop{.particles = {3, 12, 3}};
    QTest::newRow("a slab") << Drop{.particles = {12, 3, 12}};
    QTest::newRow("soft") << Drop{.modulus = 2e4};
    QTest::newRow("stiff bonds") << Drop{.modulus = 1e8, .clusters = false};
    QTest::newRow("1 substep") << Drop{.substeps = 1};
    QTest::newRow("16 substeps") << Drop{.substeps = 16};
    QTest::newRow("soft bonds, 16 substeps, e = 0.3")
        << Drop{.restitution = 0.3, .modulus = 1e5, .clusters = false, .substeps = 16};
  }
  /// The centre comes back to e2 h. It begins to rise up to one substep late, and from where its shape is at that time:
  /// a tenth of the height and 3 mm are allowed for it (with a substep of a whole frame, four times that); never more
  /// than what was asked, but for a hundredth of the height that its shape rises when it comes back.
  void dropsComeBackAsHighAsAsked() {
    QFETCH(Drop, drop);
    const double asked = drop.restitution * drop.restitution * drop.height, top = reboundOf(drop);
    qInfo("back to %.4f of %.4f m", top, asked);
    const double late = drop.substeps == 1 ? 0.2 : 0.1;
    QVERIFY2(top > (1 - late) * asked - 0.003, qPrintable(QString::number(top)));
    QVERIFY2(top < asked + 0.01 * drop.height, qPrintable(QString::number(top)));
    QVERIFY(top <= drop.height);
  }

  void moreBounceIsMoreHeight() {
    for (const bool clusters : {false, true}) {
      double before = -0.001;
      for (const double e : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
        const double top = reboundOf({.restitution = e, .modulus = 3e5, .clusters = clusters, .substeps = 8});
        QVERIFY2(top > before, qPrintable(QString("e = %1: %2 after %3 m").arg(e).arg(top).arg(before)));
        before = top;
      }
    }
  }

  void comesToRest_data() {
    QTest::addColumn<bool>("clusters");
    QTest::newRow("bonds") << false;
    QTest::newRow("clusters") << true;
  }
  /// Each bounce is lower by e2; what is left of 0.2 m with e = 0.5 after ten is below what gravity gives in a substep.
  void comesToRest() {
    QFETCH(bool, clusters);
    Solver solver;
    prepare(solver, settingsOf(0.02), bouncing(0.5, 1e6));
    solver.setWalls({tray(1)[0]});
    const uint32_t set = addSet(solver, clusters);
    solver.spawn(solid(lattice(5, 5, 5, 0.02, 0.2), set));
    solver.spawn(solid(lattice(5, 5, 5, 0.02, 0.4), set, 1));  // onto the first
    QVERIFY(run(solver, 240));
    for (const uint32_t body : {0u, 1u}) {
      const Sums s = sumsOf(solver, body);
      const double speed = s.momentum.norm() / s.mass;
      QVERIFY2(speed < 0.01, qPrintable(QString::number(speed)));
      QVERIFY(std::abs(s.centre.y() - (body == 0 ? 0.05 : 0.15)) < 0.01);
    }
  }

  void twoBodiesMeet_data() {
    QTest::addColumn<bool>("clusters");
    QTest::addColumn<double>("restitution");
    QTest::addColumn<double>("aside");  // in spacings
    for (const bool clusters : {false, true}) {
      for (const double e : {0.0, 0.5, 1.0}) {
        for (const double aside : {0.0, 2.3})
          QTest::addRow("%s, e = %g, %g aside", clusters ? "clusters" : "bonds", e, aside) << clusters << e << aside;
      }
    }
  }
  /// Nothing else is there: both keep what momentum they have, up to the rounding of places in single precision, and
  /// their energy never grows (their elastic energy is zero before). Head on they part at e times the speed at which
  /// they met; aside they turn, and it is the places of touch that part so.
  void twoBodiesMeet() {
    QFETCH(bool, clusters);
    QFETCH(double, restitution);
    QFETCH(double, aside);
    Solver solver;
    SolverSettings settings = settingsOf(0.02);
    settings.gravity = {0, 0, 0};
    prepare(solver, settings, bouncing(restitution, 1e6));
    const uint32_t set = addSet(solver, clusters);
    const std::array<ps::api::Double3, 2> velocity{{{1, 0, 0}, {-0.5, 0, 0}}};
    for (uint32_t body : {0u, 1u}) {
      std::vector<ps::api::Double3> points = lattice(5, body == 0 ? 5 : 4, 5, 0.02, 0);
      for (ps::api::Double3& p : points) p.x += body == 0 ? -0.1 : 0.1, p.z += body == 0 ? 0 : aside * 0.02;
      ps::Spawn spawn = solid(points, set, body);
      spawn.velocity.assign(spawn.position.size(), velocity[body]);
      solver.spawn(spawn);
    }
    const auto totalOf = [&] {
      const Sums a = sumsOf(solver, 0), b = sumsOf(solver, 1);
      return std::pair(Vector3(a.momentum + b.momentum),
                       Vector3(a.angular + b.angular + a.centre.cross(a.momentum) + b.centre.cross(b.momentum)));
    };
    const Sums before = sumsOf(solver);
    const auto [momentum, angular] = totalOf();
    for (int f = 0; f < 60; ++f) {
      QCOMPARE(solver.step().flags, 0u);
      const double energy = sumsOf(solver).energy;
      QVERIFY2(energy < (1 + 1e-5) * before.energy, qPrintable(QString::number(energy / before.energy)));
    }
    const auto [momentumAfter, angularAfter] = totalOf();
    const Sums a = sumsOf(solver, 0), b = sumsOf(solver, 1);
    const double parted = (b.momentum / b.mass - a.momentum / a.mass).x() / 1.5;
    qInfo("parted at %.3f, momentum open by %.1e, angular momentum by %.1e", parted,
          (momentumAfter - momentum).norm() / (before.mass * 0.5),
          (angularAfter - angular).norm() / (before.mass * 0.05));
    QVERIFY((momentumAfter - momentum).norm() < 1e-4 * before.mass);
    QVERIFY((angularAfter - angular).norm() < 0.01 * before.mass * 0.05);
    // Aside it is the centres that are compared, of which turning takes its share: between a rigid block that is struck
    // in the middle of the overlap, 1.15 spacings off its centre with a gyration radius of 2 (s = 3/4 in (1 + e) s -
    // 1), and one that is struck flat.
    if (aside == 0)
      QVERIFY2(std::abs(parted - restitution) < 0.05, qPrintable(QString::number(parted)));
    else
      QVERIFY2(parted > 0.75 * (1 + restitution) - 1.05 && parted < restitution + 0.02,
               qPrintable(QString::number(parted)));
  }
};

QTEST_APPLESS_MAIN(TestRebound)
#include "tst_rebound.moc"
