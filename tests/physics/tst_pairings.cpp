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
    static const ps::PluginRegistry registry{ps::PluginRegistry::Options{}};
    Solver solver;
    prepare(solver, settingsOf(kSpacing));
    solver.setMaterials({ps::BakedMaterial(water(), 101325), ps::BakedMaterial(jelly(), 101325),
                         ps::BakedMaterial(water(), 101325), ps::BakedMaterial(syrup(50), 101325)});
    solver.setWalls(room());
    uint32_t body = 0;
    for (const int which : {lower, upper}) {
      const Kind& kind = kKinds[which];
      ps::Spawn spawn = liquid(pointsOf(kind.shape, body == 0 ? 0.02 : 0.14), kind.phase == Phase::Solid ? 263.15
                                                                              : kind.phase == Phase::Gas ? 400
                                                                                                         : 293.15);
      spawn.phase = kind.phase;
      spawn.material = kind.matter;
      spawn.fixed = kind.fixed;
      spawn.body = body++;
      if (*kind.constraint) {
        const auto plugin = registry.constraintForm(kind.constraint);
        QVERIFY2(plugin, kind.constraint);
        spawn.constraintSets = {
            solver.addConstraintSet(*plugin, kind.constraint, ps::numbersOf({}, registry.parameters(kind.constraint)))};
      }
      solver.spawn(spawn);
    }
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
};

QTEST_APPLESS_MAIN(TestPairings)
#include "tst_pairings.moc"
