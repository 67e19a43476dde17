// SPDX-License-Identifier: Apache-2.0
// Every kind of matter meets every other one: one generated test per pair.
#include "core/parameters/parameterset.h"
#include "core/plugin_host/registry.h"
#include "viscosityscene.h"

#include <QTest>

using namespace viscous;
using ps::Solver;
using ps::api::Double3;
using ps::api::Phase;

namespace {

constexpr double kSpacing = 0.02, kRoom = 0.16, kHeight = 0.6;

enum class Shape { Block, Sheet, Row };
enum Matter : uint32_t { kIce, kJelly, kWater, kSyrup };

struct Kind {
  const char* name;
  const char* constraint;  ///< plugin that holds it together; "" for none
  Shape shape;
  Phase phase;
  Matter matter;
  bool fixed = false;
};

/// A new kind is one line here.
constexpr Kind kKinds[] = {
    {"rigid", "rigid", Shape::Block, Phase::Solid, kIce},   {"soft", "bonds", Shape::Block, Phase::Solid, kJelly},
    {"grains", "", Shape::Block, Phase::Solid, kIce},       {"liquid", "", Shape::Block, Phase::Liquid, kWater},
    {"viscous", "", Shape::Block, Phase::Liquid, kSyrup},   {"gas", "", Shape::Block, Phase::Gas, kWater},
    {"cloth", "cloth", Shape::Sheet, Phase::Solid, kIce},   {"rope", "rope", Shape::Row, Phase::Solid, kIce},
    {"ground", "", Shape::Sheet, Phase::Solid, kIce, true},
};

std::vector<Double3> pointsOf(Shape shape, double bottom) {
  switch (shape) {
    case Shape::Sheet:
      return lattice(8, 1, 8, kSpacing, bottom);
    case Shape::Row:
      return lattice(8, 1, 1, kSpacing, bottom);
    case Shape::Block:
      break;
  }
  return lattice(4, 3, 4, kSpacing, bottom);
}

ps::Material jelly() {
  ps::Material m = water();
  m.id = "jelly";
  m.properties["youngs_modulus"] = 1e5;
  return m;
}

/// A closed room, so that gas has a lid.
std::vector<ps::Wall> room() {
  std::vector<ps::Wall> walls = tray(kRoom);
  walls.push_back(walls[0]);
  walls.back().normal = {0, -1, 0};
  walls.back().offset = -kHeight;
  return walls;
}

double norm(const Double3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
Double3 less(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

void setUp(Solver& solver, const ps::SolverSettings& settings) {
  prepare(solver, settings);
  solver.setMaterials({ps::BakedMaterial(water(), 101325), ps::BakedMaterial(jelly(), 101325),
                       ps::BakedMaterial(water(), 101325), ps::BakedMaterial(syrup(50), 101325)});
}

void emptySpace(Solver& solver, const Double3& gravity = {0, 0, 0}) {
  ps::SolverSettings settings = settingsOf(kSpacing);
  settings.gravity = gravity;
  setUp(solver, settings);
  ps::Bounds bounds;
  bounds.minimum = {-30, -30, -30};
  bounds.maximum = {30, 30, 30};
  solver.setBounds(bounds);
}

void add(Solver& solver, const Kind& kind, std::vector<Double3> points, uint32_t body,
         const Double3& velocity = {0, 0, 0}) {
  static const ps::PluginRegistry registry{ps::PluginRegistry::Options{}};
  ps::Spawn spawn = liquid(std::move(points), kind.phase == Phase::Solid ? 263.15
                                              : kind.phase == Phase::Gas ? 400
                                                                         : 293.15);
  spawn.velocity.assign(spawn.position.size(), velocity);
  spawn.phase = kind.phase;
  spawn.material = kind.matter;
  spawn.fixed = kind.fixed;
  spawn.body = body;
  if (*kind.constraint) {
    const auto plugin = registry.constraintForm(kind.constraint);
    if (!plugin) qFatal("no constraint '%s'", kind.constraint);
    spawn.constraintSets = {
        solver.addConstraintSet(*plugin, kind.constraint, ps::numbersOf({}, registry.parameters(kind.constraint)))};
  }
  solver.spawn(spawn);
}

}  // namespace

class TestPairings : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }

  void theyMeet_data() {
    QTest::addColumn<int>("lower");
    QTest::addColumn<int>("upper");
    for (size_t a = 0; a < std::size(kKinds); ++a) {
      for (size_t b = a; b < std::size(kKinds); ++b) {
        if (kKinds[a].fixed && kKinds[b].fixed) continue;
        const bool below = kKinds[b].fixed;  // what is fixed lies below
        QTest::addRow("%s and %s", kKinds[a].name, kKinds[b].name)
            << static_cast<int>(below ? b : a) << static_cast<int>(below ? a : b);
      }
    }
  }
  /// The upper one falls on the lower one and comes to rest. No NaN and no loss; solid matter lies no deeper in other
  /// matter or in walls than half a radius; and every change of momentum is one that came from outside.
  void theyMeet() {
    QFETCH(int, lower);
    QFETCH(int, upper);
    Solver solver;
    setUp(solver, settingsOf(kSpacing));
    solver.setWalls(room());
    add(solver, kKinds[lower], pointsOf(kKinds[lower].shape, 0.02), 0);
    add(solver, kKinds[upper], pointsOf(kKinds[upper].shape, 0.14), 1);
    double open = 0, given = 0;
    Double3 end{0, 0, 0};
    for (int f = 0; f < 150; ++f) {
      const ps::StepReport report = solver.step();
      QVERIFY2(report.flags == 0, report.message.c_str());
      const ps::MomentumRecord& m = report.momentum;
      QVERIFY(norm({m.start.x - end.x, m.start.y - end.y, m.start.z - end.z}) < 1e-12 + 1e-6 * norm(end));
      end = m.end;
      open = std::max(open, norm({m.end.x - m.start.x - m.external.x, m.end.y - m.start.y - m.external.y,
                                  m.end.z - m.start.z - m.external.z}));
      given = std::max(given, norm(m.external));
    }
    const ps::ParticleStore& p = solver.particles();
    double mass = 0, nearest = 1, lowest = 1, fastest = 0;
    for (size_t i = 0; i < p.size(); ++i) {
      if (p.motion()[i] == ps::api::Motion::Static) continue;
      const ps::api::Float4 x = p.position()[i], v = p.velocity()[i];
      QVERIFY(std::isfinite(x.x + x.y + x.z + v.x + v.y + v.z));
      mass += double{p.mass()[i]};
      fastest = std::max(fastest, std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z));
      for (const ps::Wall& wall : room()) {
        const double depth = wall.normal.x * x.x + wall.normal.y * x.y + wall.normal.z * x.z - wall.offset;
        lowest = std::min(lowest, depth / kSpacing);
      }
      // Two fluids mix; what is solid takes up room.
      const auto isHard = [&](size_t k) {
        return p.motion()[k] == ps::api::Motion::Solid || p.motion()[k] == ps::api::Motion::Static;
      };
      for (size_t j = 0; j < p.size(); ++j) {
        if (p.body()[j] == p.body()[i] || !(isHard(i) || isHard(j))) continue;
        const ps::api::Float4 d = p.separation(i, j);
        nearest = std::min(nearest, std::sqrt(double{d.x} * d.x + double{d.y} * d.y + double{d.z} * d.z) / kSpacing);
      }
    }
    // A frame's weight is what a force that came from nowhere would be compared with.
    const double weight = mass * 9.81 / 60;
    qInfo(
        "nearest %.2f d, wall at %.2f d, fastest %.3f m/s; momentum open by %.1e of a frame's weight, %.1e of what was "
        "given",
        nearest, lowest, fastest, open / weight, open / given);
    QVERIFY(lowest > 0.25);    // a centre belongs half a spacing inside
    QVERIFY(nearest > 0.749);  // spheres of one spacing; liquid lies on fixed matter at 0.75, to rounding
    QVERIFY(open < 1e-3 * weight);
  }

  void theyKeepWhatTheyHave_data() {
    QTest::addColumn<int>("one");
    QTest::addColumn<int>("other");
    const auto stays = [](const Kind& kind) {
      return !kind.fixed && kind.phase != Phase::Gas;
    };  // gas spreads for ever
    for (size_t a = 0; a < std::size(kKinds); ++a) {
      for (size_t b = a; b < std::size(kKinds); ++b) {
        if (stays(kKinds[a]) && stays(kKinds[b]))
          QTest::addRow("%s and %s", kKinds[a].name, kKinds[b].name) << static_cast<int>(a) << static_cast<int>(b);
      }
    }
  }
  /// In empty space one strikes the other off its middle, at 1 m/s, and they are left alone for ten seconds, their
  /// common centre hardly moving. Momentum is that of the start, but for the rounding of places: a metre
  /// away it is 1e-5 m/s in every substep, which adds up to 5e-4 of what each had, and ten times as much for light
  /// sheets and rows, which fly farther. Angular momentum is kept by bodies within 4 %; within 10 % where grains,
  /// liquid, sheets or rows take part: friction acts at the centres of single particles, which have no spin to take it
  /// up. Kinetic energy never exceeds that of the start, and whoever took it is named: all parts add up.
  void theyKeepWhatTheyHave() {
    QFETCH(int, one);
    QFETCH(int, other);
    Solver solver;
    emptySpace(solver);
    solver.measureBalance(true);
    const std::vector<Double3> lower = pointsOf(kKinds[one].shape, 0.02);
    std::vector<Double3> upper = pointsOf(kKinds[other].shape, 0.1);
    for (Double3& p : upper) p.x += 0.03;
    const double share = double(lower.size()) / double(lower.size() + upper.size());
    add(solver, kKinds[one], lower, 0, {0, 1 - share, 0});
    add(solver, kKinds[other], upper, 1, {0, -share, 0});
    double mass = 0;
    for (size_t i = 0; i < solver.particles().size(); ++i) mass += double{solver.particles().mass()[i]};
    ps::MechanicalRecord first, last;
    Double3 momentum{0, 0, 0}, start{0, 0, 0};
    double highest = 0, given = 0, external = 0;
    for (int f = 0; f < 600; ++f) {
      const ps::StepReport report = solver.step();
      QVERIFY2(report.flags == 0, report.message.c_str());
      last = report.mechanical;
      QVERIFY(last.measured);
      if (f == 0) first = last, start = report.momentum.start;
      momentum = report.momentum.end;
      highest = std::max(highest, last.kineticEnd);
      for (const double part : last.given) given += part;
      external = std::max(external, norm(last.angularExternal));
    }
    const double angular = norm(less(last.angularEnd, first.angularStart)) / norm(first.angularStart);
    const double gained = last.kineticEnd - first.kineticStart;
    qInfo("angular momentum off by %.2f %%, highest energy %.5f, at the end %.3f of the start's", 100 * angular,
          highest / first.kineticStart, last.kineticEnd / first.kineticStart);
    const double each = std::sqrt(2 * first.kineticStart * mass * share * (1 - share));  // of two that meet, kg m/s
    const bool thin = kKinds[one].shape != Shape::Block || kKinds[other].shape != Shape::Block;
    qInfo("momentum off by %.1e of what each had", norm(less(momentum, start)) / each);
    QVERIFY(norm(less(momentum, start)) < (thin ? 5e-3 : 5e-4) * each);
    const bool loose = !*kKinds[one].constraint || !*kKinds[other].constraint;
    QVERIFY(angular < (thin || loose ? 0.1 : 0.04));
    QVERIFY(external < 1e-5 * norm(first.angularStart));
    QVERIFY(highest < 1.0001 * first.kineticStart);
    QVERIFY(std::abs(given - gained) < 1e-9 * first.kineticStart);
  }

  /// What floor and walls turn is known: rigid and soft blocks that fall and slide. 5 %: within a substep the places
  /// at which they push move by 3 mm of the block's 80.
  void whatWallsTurnIsKnown_data() {
    QTest::addColumn<int>("kind");
    for (const int kind : {0, 1}) QTest::newRow(kKinds[kind].name) << kind;
  }
  void whatWallsTurnIsKnown() {
    QFETCH(int, kind);
    Solver solver;
    emptySpace(solver, {0, -9.81, 0});
    solver.setWalls(room());
    solver.measureBalance(true);
    add(solver, kKinds[kind], pointsOf(kKinds[kind].shape, 0.05), 0, {0.8, 0, 0.3});
    double open = 0, external = 0;
    for (int f = 0; f < 120; ++f) {
      const ps::MechanicalRecord m = solver.step().mechanical;
      open = std::max(open, norm(less(less(m.angularEnd, m.angularStart), m.angularExternal)));
      external = std::max(external, norm(m.angularExternal));
    }
    qInfo("open %g of %g", open, external);
    QVERIFY(external > 0);
    QVERIFY(open < 0.05 * external);
  }

  void measuringMovesNothing() {
    const auto hashAfter = [](bool measured) {
      Solver solver;
      emptySpace(solver, {0, -9.81, 0});
      solver.setWalls(room());
      solver.measureBalance(measured);
      add(solver, kKinds[0], pointsOf(kKinds[0].shape, 0.02), 0);
      add(solver, kKinds[3], pointsOf(kKinds[3].shape, 0.14), 1);
      for (int f = 0; f < 60; ++f) solver.step();
      return solver.stateHash();
    };
    QCOMPARE(hashAfter(true), hashAfter(false));
  }
};

QTEST_APPLESS_MAIN(TestPairings)
#include "tst_pairings.moc"
