// SPDX-License-Identifier: Apache-2.0
// Fixed bodies that move as their velocity and spin say, and what they do to others.
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "onehash.h"
#include "rigidscene.h"
#include "tests/shared/enginehands.h"

#include <Eigen/Geometry>

#include <QTest>

#include <limits>
#include <nlohmann/json.hpp>

using namespace mechanics;
using namespace rigid;
using nlohmann::json;
using ps::BodyMotion;
using ps::Solver;
using ps::SolverSettings;

namespace {

constexpr double kStep = 1.0 / 60;

SolverSettings weightless(double spacing) {
  SolverSettings settings = settingsOf(spacing);
  settings.gravity = {0, 0, 0};
  return settings;
}

BodyMotion turn(const Vector3& spin, const Vector3& velocity = {}) {
  return {{0, 0, 0}, ps::double3Of(velocity), ps::double3Of(spin)};
}

Vector3 turned(const Vector3& r, const Vector3& spin, double seconds) {
  return Eigen::AngleAxisd(spin.norm() * seconds, spin.normalized()) * r;
}

/// Places by id.
std::vector<Vector3> placesOf(const Solver& solver) {
  const ps::ParticleStore& p = solver.particles();
  std::vector<Vector3> places(p.size());
  for (size_t i = 0; i < p.size(); ++i) places[p.id()[i]] = vectorOf(p.position()[i]);
  return places;
}

/// Farthest that a particle stands from where the motion would have brought it after so many seconds, in m; in a box of
/// `period` m along x.
double greatestError(const Solver& solver, const std::vector<Vector3>& start, const Vector3& spin,
                     const Vector3& velocity, double seconds, double period = 0) {
  const std::vector<Vector3> now = placesOf(solver);
  double most = 0;
  for (size_t k = 0; k < now.size(); ++k) {
    Vector3 d = now[k] - (turned(start[k], spin, seconds) + seconds * velocity);
    if (period > 0) d.x() -= period * std::round(d.x() / period);
    most = std::max(most, d.norm());
  }
  return most;
}

ps::Material rough(double friction) {
  ps::Material m = water();
  m.properties["friction_static"] = m.properties["friction_kinetic"] = friction;
  m.properties["restitution"] = 0.0;
  return m;
}

/// A paddle one particle thick that turns about z in a tray of water.
uint64_t hashOfStirredTray() {
  Solver solver;
  prepare(solver, settingsOf(0.05));
  solver.setWalls(tray(0.5));
  ps::Spawn paddle = fixedPoints(lattice(7, 6, 1, 0.05, 0.05));
  paddle.body = 1;
  solver.setMotion(1, {{0, 0.2, 0}, {0, 0, 0}, {0, 4, 0}, 0.1, 1e9});
  solver.spawn(paddle);
  std::vector<ps::api::Double3> places = lattice(10, 5, 10, 0.05, 0);
  std::erase_if(places, [](const ps::api::Double3& p) { return std::abs(p.z) < 0.06; });
  solver.spawn(liquid(places));
  return run(solver, 40) ? solver.stateHash() : 0;
}

json wheelScene() {
  return json::parse(R"({
    "format": "phasesketch", "version": 1, "materials": [{"id": "water", "base": "water"}],
    "bodies": [{"id": "wheel", "material": "water", "fixed": true, "temperature": 263.15,
                "spin": [0, 0, 3], "velocity": [0.1, 0, 0],
                "shape": {"box": {"center": [0.3, 0.5, 0], "size": [0.2, 0.1, 0.1]}}}],
    "environment": {"gravity": [0, 0, 0], "bounds": {"minimum": [-5, -5, -5], "maximum": [5, 5, 5]}},
    "solver": {"particle_spacing": 0.05, "thermal": {"model": "none"}}, "duration": 10
  })");
}

}  // namespace

class TestPrescribedMotion : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet("");
  }

  void keepsShapeAndAngle_data() {
    QTest::addColumn<Vector3>("spin");
    QTest::addColumn<Vector3>("velocity");
    QTest::addColumn<double>("period");
    QTest::newRow("upright") << Vector3{0, 2, 0} << Vector3{} << 0.0;
    QTest::newRow("about a tilted axis") << Vector3{1, -2, 0.5} << Vector3{} << 0.0;
    QTest::newRow("fast") << Vector3{0, 0, 90} << Vector3{} << 0.0;
    QTest::newRow("rolling on") << Vector3{0, 0, -3} << Vector3{0.02, 0.01, 0} << 0.0;
    QTest::newRow("around a periodic box") << Vector3{0, 1, 2} << Vector3{0.3, 0, 0} << 1.0;
  }
  void keepsShapeAndAngle() {
    QFETCH(Vector3, spin);
    QFETCH(Vector3, velocity);
    QFETCH(double, period);
    Solver solver;
    prepare(solver, weightless(0.05));
    if (period > 0) solver.setBounds({{-period / 2, -3, -3}, {period / 2, 3, 3}, {true, false, false}});
    solver.setMotion(0, turn(spin, velocity));
    solver.spawn(fixedPoints(lattice(8, 3, 2, 0.05, -0.075)));
    const std::vector<Vector3> start = placesOf(solver);
    QVERIFY(run(solver, 3600));
    // A minute of 14400 substeps. Single precision holds 1.2 m to 6e-8 m, each of the three coordinates and the place.
    const double error = greatestError(solver, start, spin, velocity, 3600 * kStep, period);
    QVERIFY2(error < 3e-7, qPrintable(QString::number(error)));
    // v + w x r at the end of the last substep, to the rounding of a velocity.
    const ps::ParticleStore& p = solver.particles();
    for (size_t i = 0; i < p.size(); ++i) {
      const Vector3 arm = turned(start[p.id()[i]], spin, 3600 * kStep), v = velocity + spin.cross(arm);
      QVERIFY((vectorOf(p.velocity()[i]) - v).norm() < 1e-6 * (1 + v.norm()));
    }
  }

  void beginsAndEndsWithinASubstep() {
    const Vector3 spin{0, 2, 1}, velocity{0.1, 0, 0};
    BodyMotion motion = turn(spin, velocity);
    motion.start = 0.503, motion.stop = 1.377;  // neither is a multiple of a substep, 1/240 s
    Solver solver;
    prepare(solver, weightless(0.05));
    solver.setMotion(0, motion);
    solver.spawn(fixedPoints(lattice(6, 2, 2, 0.05, -0.05)));
    const std::vector<Vector3> start = placesOf(solver);
    QVERIFY(run(solver, 30));  // 0.5 s
    QVERIFY(greatestError(solver, start, spin, velocity, 0) < 1e-7);
    QVERIFY(motionOf(solver, 1).fastest == 0);
    QVERIFY(run(solver, 30));
    QVERIFY(greatestError(solver, start, spin, velocity, 1 - motion.start) < 3e-7);
    QVERIFY(run(solver, 60));
    QVERIFY(greatestError(solver, start, spin, velocity, motion.stop - motion.start) < 3e-7);
    for (size_t i = 0; i < solver.particles().size(); ++i)
      QVERIFY(vectorOf(solver.particles().velocity()[i]).norm() == 0);
  }

  /// A piston that leaves water no room is told; one that stands over it is not.
  void squeezedWaterIsTold() {
    Solver solver;
    prepare(solver, settingsOf(0.02));
    solver.setWalls(tray(0.2));
    solver.spawn(liquid(lattice(10, 5, 10, 0.02, 0)));
    ps::Spawn piston = fixedPoints(lattice(10, 2, 10, 0.02, 0.12));
    piston.body = 1;
    solver.setMotion(1, {{0, 0.14, 0}, {0, -0.2, 0}, {0, 0, 0}, 0.2, 0.6});
    solver.spawn(piston);
    const auto told = [&] {
      const std::vector<ps::Limit> limits = solver.limits();
      return std::any_of(limits.begin(), limits.end(), [](const ps::Limit& limit) {
        return limit.what == ps::kSqueezeLimit && limit.delivered > 0.1;
      });
    };
    QVERIFY(run(solver, 12));  // 0.2 s: it stands
    QVERIFY(!told());
    bool ever = false;
    for (int f = 0; f < 24; ++f) {
      solver.step();
      ever = ever || told();
    }
    QVERIFY(ever);
  }

  /// Friction holds a block at r as long as w² r < mu g: 2.45 m/s² at 0.25.
  void turntable_data() {
    QTest::addColumn<double>("spin");
    QTest::addColumn<bool>("stays");
    QTest::newRow("holds at 85 %") << std::sqrt(0.85 * 0.25 * 9.81 / 0.5) << true;
    QTest::newRow("slides at 115 %") << std::sqrt(1.15 * 0.25 * 9.81 / 0.5) << false;
  }
  void turntable() {
    QFETCH(double, spin);
    QFETCH(bool, stays);
    SolverSettings settings = settingsOf(0.05);
    settings.substeps = 10;
    Solver solver;
    prepare(solver, settings, rough(0.25));
    ps::Spawn table = fixedPoints(lattice(40, 1, 40, 0.05, -0.05));
    table.body = 1;
    solver.setMotion(1, turn({0, spin, 0}));
    solver.spawn(table);
    std::vector<ps::api::Double3> places = lattice(4, 2, 4, 0.05, 0);
    for (ps::api::Double3& p : places) p.x += 0.5;
    ps::Spawn block = ice(places, solver.addConstraintSet(&m_rigid, "rigid", rigidParameters()));
    for (const ps::api::Double3& p : places) block.velocity.push_back({spin * p.z, 0, -spin * p.x});  // it goes with it
    solver.spawn(block);
    QVERIFY(run(solver, 120));
    const Sums s = sumsOf(solver, 0);
    const Vector3 back = turned(s.centre, {0, -spin, 0}, solver.time());
    const double slipped = (back - Vector3{0.5, s.centre.y(), 0}).norm();
    QVERIFY2(stays ? slipped < 0.01 : slipped > 0.1, qPrintable(QString::number(slipped)));
  }

  /// What the turntable gives to the block, and the paddle to the water, is booked as impulse from outside.
  void momentumIsBooked() {
    Solver solver;
    prepare(solver, settingsOf(0.05), rough(0.4));
    solver.setWalls(tray(1));
    ps::Spawn paddle = fixedPoints(lattice(10, 4, 1, 0.05, 0));
    paddle.body = 1;
    solver.setMotion(1, turn({0, 5, 0}));
    solver.spawn(paddle);
    std::vector<ps::api::Double3> grains = lattice(12, 3, 12, 0.05, 0);
    std::erase_if(grains, [](const ps::api::Double3& p) { return std::abs(p.z) < 0.06; });
    ps::Spawn sand = ice(grains, 0);
    sand.constraintSets.clear();
    solver.spawn(sand);
    double gained = 0;
    for (int frame = 0; frame < 120; ++frame) {
      const ps::MomentumRecord m = solver.step().momentum;
      const Vector3 change = vectorOf(m.end) - vectorOf(m.start), external{m.external.x, m.external.y, m.external.z};
      gained = std::max(gained, change.norm());
      // 360 grains of 0.11 kg at some m/s in single precision.
      QVERIFY2((change - external).norm() < 1e-3, qPrintable(QString::number((change - external).norm())));
    }
    QVERIFY2(gained > 0.5, qPrintable(QString::number(gained)));
  }

  /// The blade's tip goes 1.5 spacings per substep: whatever stands in its way is swept along, not passed.
  void nothingPassesAFastBlade_data() {
    QTest::addColumn<bool>("wet");
    QTest::newRow("drops") << true;
    QTest::newRow("grains") << false;
  }
  void nothingPassesAFastBlade() {
    QFETCH(bool, wet);
    SolverSettings settings = weightless(0.05);
    Solver solver;
    prepare(solver, settings, rough(0));
    ps::Spawn blade = fixedPoints(lattice(20, 6, 1, 0.05, -0.15));
    blade.body = 1;
    BodyMotion motion = turn({0, 36, 0});
    motion.start = 0.001;  // it still stands when the first frame begins
    solver.setMotion(1, motion);
    solver.spawn(blade);
    std::vector<ps::api::Double3> places;
    for (const double r : {0.2, 0.3, 0.4}) {
      for (const double degrees : {20.0, 90.0, 130.0}) {
        places.push_back({r * std::cos(degrees * 0.01745), 0, -r * std::sin(degrees * 0.01745)});
      }
    }
    ps::Spawn loose = liquid(places);
    if (!wet) loose.phase = ps::api::Phase::Solid;
    solver.spawn(loose);
    // Somewhat less than half a turn. What it has met is ahead of it, or has been flung past its tip.
    int met = 0;
    for (int frame = 0; frame < 5; ++frame) {
      QVERIFY(run(solver, 1));
      const ps::ParticleStore& p = solver.particles();
      met = 0;
      for (size_t i = 0; i < p.size(); ++i) {
        if (p.body()[i] == 1) continue;
        const Vector3 x = turned(vectorOf(p.position()[i]), {0, -36, 0}, solver.time() - motion.start);
        QVERIFY2(x.z() < 0 || x.x() > 0.5, qPrintable(QString("%1 %2 %3").arg(x.x()).arg(x.y()).arg(x.z())));
        met += vectorOf(p.velocity()[i]).norm() > 5 ? 1 : 0;
      }
    }
    QCOMPARE(met, 9);
  }

  /// A bonded block that rests is pushed at contact's distance, 0.955 spacings, from the first touch on; less 1 % for
  /// what a plate at 0.3 m/s goes in a substep.
  void aSlowPlateFindsWhatRests() {
    Solver solver;
    prepare(solver, weightless(0.05), rough(0));
    ps::Spawn plate = fixedPoints(lattice(4, 1, 4, 0.05, -0.225));
    plate.body = 1;
    solver.setMotion(1, turn({}, {0, 0.3, 0}));
    solver.spawn(plate);
    solver.spawn(ice(lattice(2, 2, 2, 0.05, 0), solver.addConstraintSet(&m_bonds, "bonds", bondParameters())));
    double nearest = 1e30;
    for (int frame = 0; frame < 60; ++frame) {
      QVERIFY(run(solver, 1));
      double top = -1e30, bottom = 1e30;
      for (size_t i = 0; i < solver.particles().size(); ++i) {
        const double y = solver.particles().position()[i].y;
        if (solver.particles().body()[i] == 1)
          top = std::max(top, y);
        else
          bottom = std::min(bottom, y);
      }
      nearest = std::min(nearest, bottom - top);
    }
    QVERIFY2(nearest > 0.945 * 0.05 && nearest < 0.06, qPrintable(QString::number(nearest / 0.05)));
  }

  /// What was taken away stands in its body again, where that is by now.
  void comesBackIntoItsPlace() {
    const Vector3 spin{0, 0, 2};
    Solver solver;
    prepare(solver, weightless(0.05));
    solver.setMotion(0, turn(spin));
    const std::vector<uint32_t> ids = solver.spawn(fixedPoints(lattice(6, 4, 2, 0.05, -0.1)));
    const std::vector<Vector3> start = placesOf(solver);
    QVERIFY(run(solver, 30));
    const ps::ExtractedMatter taken = solver.extract(std::span(ids).first(10));
    QVERIFY(run(solver, 30));
    solver.putBack(taken);
    QVERIFY(greatestError(solver, start, spin, {}, 1) < 3e-7);
    QVERIFY(run(solver, 30));
    QVERIFY(greatestError(solver, start, spin, {}, 1.5) < 3e-7);
  }

  /// What was taken from a body that stood has missed its way all the same.
  void comesBackIntoABodyThatHasSetOffSince() {
    const Vector3 spin{0, 0, 2};
    Solver solver;
    prepare(solver, weightless(0.05));
    const std::vector<uint32_t> ids = solver.spawn(fixedPoints(lattice(6, 4, 2, 0.05, -0.1)));
    const std::vector<Vector3> start = placesOf(solver);
    const ps::ExtractedMatter taken = solver.extract(std::span(ids).first(10));
    solver.setMotion(0, turn(spin));
    QVERIFY(run(solver, 60));
    solver.putBack(taken);
    QVERIFY(greatestError(solver, start, spin, {}, 1) < 3e-7);
    QVERIFY(run(solver, 30));
    QVERIFY(greatestError(solver, start, spin, {}, 1.5) < 3e-7);
  }

  /// The scene pauses at its last good frame, and goes on from there.
  void aFrameTakenBackTakesBackTheTurn() {
    const Vector3 spin{0, 0, 2};
    Solver solver;
    prepare(solver, weightless(0.05));
    solver.setMotion(0, turn(spin));
    solver.spawn(fixedPoints(lattice(6, 4, 2, 0.05, -0.1)));
    const std::vector<Vector3> start = placesOf(solver);
    QVERIFY(run(solver, 30));
    ps::Spawn grain = ice({{1, 1, 1}}, 0);
    grain.constraintSets.clear();
    const uint32_t id = solver.spawn(grain).front();
    QVERIFY(run(solver, 30));
    SolverSettings broken = weightless(0.05);
    broken.gravity.x = std::numeric_limits<double>::quiet_NaN();
    solver.setSettings(broken);
    QVERIFY(solver.step().flags & static_cast<ps::StepFlags>(ps::StepFlag::NotFinite));
    solver.setSettings(weightless(0.05));
    const uint32_t grains[] = {id};
    solver.remove(grains);
    QVERIFY(run(solver, 30));
    QVERIFY(greatestError(solver, start, spin, {}, 1.5) < 3e-7);
  }

  void oneHash_data() { onehash::addRows(); }
  void oneHash() { onehash::verify(hashOfStirredTray); }

  /// The way from a project file, with changes while it runs.
  void aProjectsWheel() {
    ps::Project project = load(wheelScene());
    ps::Engine engine(project, m_plugins);
    Solver& solver = ps::tests::solverOf(engine);
    const std::vector<Vector3> start = placesOf(solver);
    const Vector3 centre{0.3, 0.5, 0}, velocity{0.1, 0, 0};
    const auto error = [&](double seconds, double angle) {
      const std::vector<Vector3> now = placesOf(solver);
      double most = 0;
      for (size_t k = 0; k < now.size(); ++k) {
        const Vector3 there = centre + seconds * velocity + turned(start[k] - centre, {0, 0, 1}, angle);
        most = std::max(most, (now[k] - there).norm());
      }
      return most;
    };
    QVERIFY(std::abs(solver.particles().velocity()[0].x) > 0.1f);  // it moves from the start
    for (int frame = 0; frame < 60; ++frame) QCOMPARE(engine.step().flags, 0u);
    QVERIFY2(error(1, 3) < 1e-6, qPrintable(QString::number(error(1, 3))));
    // The next two act at once, from where the wheel is.
    QVERIFY(engine.setParameter({ps::Owner::Body, "wheel", "motion_stop"}, 1.5));
    for (int frame = 0; frame < 60; ++frame) engine.step();
    QVERIFY2(error(1.5, 4.5) < 1e-6, qPrintable(QString::number(error(1.5, 4.5))));
    QVERIFY(engine.setParameter({ps::Owner::Body, "wheel", "motion_stop"}, 0.0));
    project = engine.project();
    project.bodies[0].spin = {0, 0, -1};
    engine.update(project);
    for (int frame = 0; frame < 60; ++frame) engine.step();
    QVERIFY2(error(2.5, 3.5) < 1e-6, qPrintable(QString::number(error(2.5, 3.5))));
    QVERIFY(!engine.setParameter({ps::Owner::Body, "wheel", "fixed"},
                                 false));  // at the next reset, whatever else is edited
    QVERIFY(engine.setParameter({ps::Owner::Scene, "", "gravity"}, 0.0));
    for (int frame = 0; frame < 60; ++frame) engine.step();
    QVERIFY2(error(3.5, 2.5) < 1e-6, qPrintable(QString::number(error(3.5, 2.5))));
    engine.reset();
    QCOMPARE(engine.solver().time(), 0.0);
    QVERIFY(engine.solver().particles().velocity()[0].w > 0);
  }

  void aSketchedWheelTurnsAboutItsMiddle() {
    json scene = wheelScene();
    json& body = scene["bodies"][0];
    body["velocity"] = {0, 0, 0};
    body["shape"] = json::parse(R"({"voxels": {"origin": [0.1, 0.2, 0], "spacing": 0.05,
      "palette": [{"material": "water", "temperature": 263.15}],
      "runs": [[0, 0, 0, 4, 0], [0, 1, 0, 1, 0]]}})");  // an L; its middle is (1.2, 0.2) cells from the origin
    ps::Engine engine(load(scene), m_plugins);
    const std::vector<Vector3> start = placesOf(engine.solver());
    for (int frame = 0; frame < 60; ++frame) engine.step();
    const std::vector<Vector3> now = placesOf(engine.solver());
    const Vector3 centre{0.1 + 1.2 * 0.05, 0.2 + 0.2 * 0.05, 0};
    for (size_t k = 0; k < now.size(); ++k)
      QVERIFY((now[k] - centre - turned(start[k] - centre, {0, 0, 3}, 1)).norm() < 1e-6);
  }

 private:
  ps::Project load(const json& scene) { return ps::parseProject(scene.dump(), "scene.json", m_plugins).project; }

  ps::constraint::RigidModel m_rigid;
  ps::constraint::BondModel m_bonds;
  ps::PluginRegistry m_plugins;
};

QTEST_APPLESS_MAIN(TestPrescribedMotion)
#include "tst_prescribedmotion.moc"
