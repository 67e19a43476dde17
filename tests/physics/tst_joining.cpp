// SPDX-License-Identifier: Apache-2.0
// How solids fall into pieces by melting and become one by freezing and sintering: bonds and rigid bodies alike.
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"
#include "onehash.h"
#include "softscene.h"
#include "tests/shared/scenes.h"

#include <QTest>

#include <map>

using namespace soft;
using ps::Solver;

namespace {

constexpr double kSpacing = 0.02;
/// J/kg: well frozen and well molten, above the solid at its melting point; 333.6e3 melt it.
constexpr double kFrozen = -20e3, kMolten = 340e3;

/// Frozen at 263 K and molten at 293 K as water does, whatever it is called.
ps::Material matterOf(const char* id, double melting = 273.15, bool sinters = false,
                      std::vector<std::string> adheresTo = {}) {
  ps::Material m = water();
  m.id = id;
  m.properties["melting_temperature"] = melting;
  m.properties["boiling_temperature"] = 5000.0;
  m.properties["sinters"] = sinters ? 1.0 : 0.0;
  m.properties["restitution"] = 0.0;
  m.adheresTo = std::move(adheresTo);
  return m;
}

/// Pieces of at least four particles, and how many the largest has.
struct Pieces {
  size_t count = 0, largest = 0;
};
Pieces piecesOf(const Solver& solver) {
  std::map<uint32_t, size_t> sizes;
  for (const uint32_t piece : solver.pieces()) {
    if (piece != Solver::kNoPiece) ++sizes[piece];
  }
  Pieces result;
  for (const auto& [piece, size] : sizes) {
    result.count += size >= 4 ? 1 : 0;
    result.largest = std::max(result.largest, size);
  }
  return result;
}

/// Gives the chosen particles an enthalpy, as a laser or liquid nitrogen would: the books miss this heat, and say so.
template <class Chosen>
std::vector<uint32_t> setEnthalpy(Solver& solver, double joules, Chosen&& chosen) {
  ps::ParticleStore& p = solver.particles();
  auto* h = static_cast<double*>(p.find("specific_enthalpy", ps::api::FieldType::Float64));
  std::vector<uint32_t> ids;
  for (size_t i = 0; i < p.size(); ++i) {
    if (!chosen(i)) continue;
    h[i] = joules;
    ids.push_back(p.id()[i]);
  }
  return ids;
}

/// Runs on; false when something but the open books was flagged.
bool runOn(Solver& solver, int frames) {
  for (int f = 0; f < frames; ++f) {
    const ps::StepReport report = solver.step();
    if ((report.flags & ~static_cast<unsigned>(ps::StepFlag::EnergyOpen)) == 0) continue;
    qWarning("frame %d: flags %u: %s", f, report.flags, report.message.c_str());
    return false;
  }
  return true;
}

/// A pond that freezes to rigid pieces beside a bonded block on another, and wax on wood. 0 when something failed or
/// nothing grew together.
uint64_t hashOfEverything(int frames) {
  static const ps::thermal::EnthalpyModel enthalpy;
  static const ps::constraint::BondModel bonds;
  static const ps::constraint::RigidModel rigid;
  Solver solver;
  prepare(solver, settingsOf(kSpacing));
  solver.setMaterials({ps::BakedMaterial(matterOf("ice", 273.15, true), 101325),
                       ps::BakedMaterial(matterOf("wood", 2000, false, {"wax"}), 101325),
                       ps::BakedMaterial(matterOf("wax", 330), 101325)});
  std::vector<ps::Wall> walls = tray(0.24);
  walls[0].heat = walls[1].heat = ps::WallHeat::FixedTemperature;
  walls[0].temperature = walls[1].temperature = 233;
  solver.setWalls(walls);
  ps::ThermalSettings thermal;
  thermal.timeScale = 20000;
  solver.setThermal(thermal, &enthalpy, "enthalpy", {});
  const uint32_t bonded = solver.addConstraintSet(&bonds, "bonds", bondParameters());
  const uint32_t set = solver.addConstraintSet(&rigid, "rigid", rigidParameters());
  uint32_t body = 0;
  const auto add = [&](ps::Spawn spawn, uint32_t material) {
    spawn.body = body++;
    spawn.material = material;
    solver.spawn(spawn);
  };
  ps::Spawn pond = liquid(lattice(12, 2, 12, kSpacing, 0), 274);
  pond.constraintSets = {set};
  add(pond, 0);
  add(ice(lattice(4, 3, 4, kSpacing, 0.08), bonded, 250), 0);
  add(ice(lattice(4, 3, 4, kSpacing, 0.14), bonded, 250), 0);
  add(ice(lattice(3, 2, 3, kSpacing, 0.22), set, 300), 1);
  add(liquid(lattice(3, 2, 3, kSpacing, 0.26), 331), 2);
  if (!run(solver, frames)) return 0;
  return piecesOf(solver).largest >= 96 ? solver.stateHash() : 0;
}

}  // namespace

class TestJoining : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void init() { ps::setThreadCount(2); }
  void cleanup() { ps::setInstructionSet(""); }

  void everyMachineGivesOneHash_data() { onehash::addRows(); }
  void everyMachineGivesOneHash() {
    onehash::verify([] { return hashOfEverything(80); });
  }

  /// A block stands on a table, or is poured onto it and freezes.
  void whatJoins_data() {
    QTest::addColumn<bool>("rigid");
    QTest::addColumn<bool>("poured");
    QTest::addColumn<double>("temperature");  // K, at the start
    QTest::addColumn<int>("materials");       // see below
    QTest::addColumn<int>("pieces");
    for (const bool rigid : {false, true}) {
      const char* name = rigid ? "rigid" : "bonds";
      QTest::addRow("%s: hot iron on iron", name) << rigid << false << 1700.0 << 0 << 2;
      QTest::addRow("%s: molten iron on iron", name) << rigid << true << 1700.0 << 0 << 1;
      QTest::addRow("%s: ice on ice", name) << rigid << false << 263.15 << 1 << 1;
      QTest::addRow("%s: ice on ice as it melts", name) << rigid << false << 273.15 << 1 << 2;
      QTest::addRow("%s: molten tin on iron", name) << rigid << true << 500.0 << 2 << 2;
      QTest::addRow("%s: dry wax on wood", name) << rigid << false << 300.0 << 3 << 2;
      QTest::addRow("%s: molten wax on wood, named by the wax", name) << rigid << true << 320.0 << 3 << 1;
      QTest::addRow("%s: molten wax on wood, named by the wood", name) << rigid << true << 320.0 << 4 << 1;
    }
  }
  void whatJoins() {
    QFETCH(bool, rigid);
    QFETCH(bool, poured);
    QFETCH(double, temperature);
    QFETCH(int, materials);
    QFETCH(int, pieces);
    const std::vector<std::vector<ps::Material>> table{{matterOf("iron", 1811), matterOf("iron", 1811)},
                                                       {matterOf("ice", 273.15, true), matterOf("ice", 273.15, true)},
                                                       {matterOf("iron", 1811), matterOf("tin", 505)},
                                                       {matterOf("wood", 2000), matterOf("wax", 330, false, {"wood"})},
                                                       {matterOf("wood", 2000, false, {"wax"}), matterOf("wax", 330)}};
    Solver solver;
    prepare(solver, settingsOf(kSpacing));
    const std::vector<ps::Material>& two = table[static_cast<size_t>(materials)];
    const bool same = two[0].id == two[1].id;
    solver.setMaterials({ps::BakedMaterial(two[0], 101325), ps::BakedMaterial(two[1], 101325)});
    solver.setWalls(tray(0.16));
    solver.setThermal({}, &m_enthalpy, "enthalpy", {});
    const uint32_t set = addSet(solver, rigid);
    solver.spawn(ice(lattice(6, 2, 6, kSpacing, 0), set, temperature));
    ps::Spawn block = ice(lattice(4, 3, 4, kSpacing, 2 * kSpacing), set, temperature);
    block.body = 1;
    block.material = same ? 0 : 1;
    if (poured) {
      block.phase = ps::api::Phase::Liquid;
      block.temperature = ps::valueOf(two[1], "melting_temperature", 293.15) + 1;
    }
    solver.spawn(block);
    QVERIFY(runOn(solver, 1));
    if (poured) setEnthalpy(solver, kFrozen, [&](size_t i) { return solver.particles().body()[i] == 1; });
    QVERIFY(runOn(solver, 60));
    QCOMPARE(piecesOf(solver).count, static_cast<size_t>(pieces));
    QCOMPARE(piecesOf(solver).largest, size_t{pieces == 1 ? 120u : 72u});
  }

  /// What is fixed holds what freezes onto it, where they are of a kind.
  void freezesOntoFixedMatter() {
    for (const bool akin : {true, false}) {
      Solver solver;
      prepare(solver, settingsOf(kSpacing));
      solver.setMaterials(
          {ps::BakedMaterial(matterOf("wood", 2000), 101325),
           ps::BakedMaterial(
               matterOf("ice", 273.15, true, akin ? std::vector<std::string>{"wood"} : std::vector<std::string>{}),
               101325)});
      solver.setThermal({}, &m_enthalpy, "enthalpy", {});
      const uint32_t set = addSet(solver, false);
      solver.spawn(fixedPoints(lattice(8, 1, 8, kSpacing, 0.1)));
      ps::Spawn drop = liquid(lattice(4, 3, 4, kSpacing, 0.1 - 3 * kSpacing), 273.2);  // below it
      drop.body = drop.material = 1;
      drop.constraintSets = {set};
      solver.spawn(drop);
      QVERIFY(runOn(solver, 1));
      setEnthalpy(solver, kFrozen, [&](size_t i) { return solver.particles().body()[i] == 1; });
      QVERIFY(runOn(solver, 5));
      const double start = sumsOf(solver, 1).centre.y();
      QVERIFY(runOn(solver, 30));
      const double fallen = start - sumsOf(solver, 1).centre.y();
      if (akin)
        QVERIFY2(std::abs(fallen) < 0.01 * kSpacing, qPrintable(QString::number(fallen)));
      else
        QVERIFY2(fallen > 1.2,
                 qPrintable(QString::number(fallen)));  // half a second of free fall, and what went before
    }
  }

  /// Liquid lies in the hollows of what it rests on, deeper than solids come: what freezes there is not thrown up. It
  /// rises to where solids lie, as slowly as its overlap is taken back, which costs it a tenth of a second.
  void freezesWhereItLies_data() {
    QTest::addColumn<bool>("grain");
    QTest::addColumn<int>("structure");
    QTest::newRow("a grain") << true << 2;
    QTest::newRow("a puddle that bonds") << false << 0;
    QTest::newRow("a puddle that turns rigid") << false << 1;
    QTest::newRow("a puddle in a scene with bonds") << false << 2;
  }
  void freezesWhereItLies() {
    QFETCH(bool, grain);
    QFETCH(int, structure);
    Solver solver;
    prepare(solver, settingsOf(kSpacing));
    solver.setMaterials(
        {ps::BakedMaterial(matterOf("wood", 2000), 101325), ps::BakedMaterial(matterOf("ice", 273.15, true), 101325)});
    solver.setWalls(tray(0.2));
    solver.setThermal({}, &m_enthalpy, "enthalpy", {});
    const uint32_t set = addSet(solver, structure == 1);
    solver.spawn(fixedPoints(lattice(10, 2, 10, kSpacing, 0)));
    ps::Spawn lying =
        liquid(grain ? lattice(1, 1, 1, kSpacing, 2 * kSpacing) : lattice(6, 2, 6, kSpacing, 2 * kSpacing), 273.2);
    lying.body = lying.material = 1;
    if (structure != 2) lying.constraintSets = {set};
    solver.spawn(lying);
    QVERIFY(runOn(solver, 120));
    const ps::ParticleStore& p = solver.particles();
    const auto largest = [&](auto&& of) {
      double most = -1;
      for (size_t i = 0; i < p.size(); ++i) {
        if (p.body()[i] == 1) most = std::max(most, double(of(i)));
      }
      return most;
    };
    const auto height = [&](size_t i) { return p.position()[i].y; };
    const auto speed = [&](size_t i) { return std::abs(p.velocity()[i].y); };
    const double lay = largest(height);
    setEnthalpy(solver, kFrozen, [&](size_t i) { return p.body()[i] == 1; });
    double fastest = 0, highest = 0;
    for (int f = 0; f < 60; ++f) {
      QVERIFY(runOn(solver, 1));
      fastest = std::max(fastest, largest(speed)), highest = std::max(highest, largest(height));
    }
    // Half a spacing in the time that the overlap takes, and twice that for what is taken back first.
    const double allowed = 2 * 0.5 * kSpacing / 0.1;
    QVERIFY2(fastest < allowed, qPrintable(QString::number(fastest)));
    QVERIFY2(highest < lay + kSpacing, qPrintable(QString::number((highest - lay) / kSpacing)));
    QVERIFY2(motionOf(solver, 1).rms < 0.002, qPrintable(QString::number(motionOf(solver, 1).rms)));
    for (size_t i = 0; i < p.size(); ++i) QVERIFY(p.compression()[i] >= 0 && p.compression()[i] < 0.01);
  }

  /// Painted as it freezes, it is handed nothing that is meant for the other: a liquid no overlap, a solid no
  /// compression; and what becomes solid by paint lies as still as what freezes.
  void paintHandsOverNothingElse() {
    Solver solver;
    prepare(solver, settingsOf(kSpacing));
    solver.setMaterials({ps::BakedMaterial(matterOf("wood", 2000), 101325), ps::BakedMaterial(matterOf("ice"), 101325),
                         ps::BakedMaterial(matterOf("oil", 100), 101325)});
    solver.setWalls(tray(0.2));
    solver.setThermal({}, &m_enthalpy, "enthalpy", {});
    solver.spawn(fixedPoints(lattice(10, 2, 10, kSpacing, 0)));
    ps::Spawn grain = liquid(lattice(1, 1, 1, kSpacing, 2 * kSpacing), 273.2);
    grain.body = grain.material = 1;
    const std::vector<uint32_t> ids = solver.spawn(grain);
    QVERIFY(runOn(solver, 120));
    const ps::ParticleStore& p = solver.particles();
    const auto i = [&] { return p.indexOf(ids[0]); };
    const auto speed = [&] { return vectorOf(p.velocity()[i()]).norm(); };
    setEnthalpy(solver, kFrozen, [&](size_t k) { return p.body()[k] == 1; });
    QVERIFY(runOn(solver, 1));
    QVERIFY(p.motion()[i()] == ps::api::Motion::Solid);
    solver.paint(ids, 2);
    QVERIFY(p.motion()[i()] == ps::api::Motion::Liquid);
    QCOMPARE(p.compression()[i()], 0.0f);
    QVERIFY(runOn(solver, 60));
    QVERIFY2(speed() < 0.1, qPrintable(QString::number(speed())));
    solver.paint(ids, 1);
    QVERIFY(p.motion()[i()] == ps::api::Motion::Solid);
    double fastest = 0;
    for (int f = 0; f < 30; ++f) {
      QVERIFY(runOn(solver, 1));
      fastest = std::max(fastest, speed());
    }
    QVERIFY2(fastest < 0.2, qPrintable(QString::number(fastest)));
    QVERIFY(p.compression()[i()] >= 0);
  }

  void meltedThroughIsTwoAndPressedTogetherIsOne_data() {
    QTest::addColumn<bool>("rigid");
    QTest::newRow("bonds") << false;
    QTest::newRow("rigid") << true;
  }
  void meltedThroughIsTwoAndPressedTogetherIsOne() {
    QFETCH(bool, rigid);
    Solver solver;
    prepareFree(solver, matterOf("ice", 273.15, true));
    solver.spawn(ice(lattice(8, 4, 4, kSpacing, 0), addSet(solver, rigid)));
    QVERIFY(runOn(solver, 2));
    QCOMPARE(piecesOf(solver).count, size_t{1});
    ps::ParticleStore& p = solver.particles();
    const std::vector<uint32_t> melted =
        setEnthalpy(solver, kMolten, [&](size_t i) { return std::abs(p.position()[i].x) < kSpacing; });
    QCOMPARE(melted.size(), size_t{32});
    QVERIFY(runOn(solver, 2));
    QCOMPARE(piecesOf(solver).count, size_t{2});
    QCOMPARE(piecesOf(solver).largest, size_t{48});
    // The water goes, the halves fly towards each other, and a little past.
    solver.remove(melted);
    for (size_t i = 0; i < p.size(); ++i) {
      p.velocity()[i] = {p.position()[i].x < 0 ? 0.2f : -0.1f, p.position()[i].x < 0 ? 0.01f : 0.0f, 0,
                         p.velocity()[i].w};
    }
    const Sums before = sumsOf(solver);
    QVERIFY(runOn(solver, 5));
    QCOMPARE(piecesOf(solver).count, size_t{2});
    QVERIFY(runOn(solver, 60));
    QCOMPARE(piecesOf(solver).count, size_t{1});
    QCOMPARE(piecesOf(solver).largest, size_t{96});
    const Sums after = sumsOf(solver);
    // Float32 positions of 0.1 m over substeps of 4 ms round velocities to 2e-6 m/s of 0.1 m/s, a few hundred times.
    const double scale = 0.1 * before.mass;
    QVERIFY2((after.momentum - before.momentum).norm() < 1e-3 * scale,
             qPrintable(QString::number((after.momentum - before.momentum).norm() / scale)));
    // Bonds lose some spin in a bump: velocities from places see a push where it ends, not where it begins.
    QVERIFY2((after.angular - before.angular).norm() < (rigid ? 0.01 : 0.05) * before.angular.norm(),
             qPrintable(QString::number((after.angular - before.angular).norm() / before.angular.norm())));
  }

  /// Pieces that only touch in passing stay two: a rigid body takes half a second.
  void brushingPastDoesNotJoin() {
    Solver solver;
    prepareFree(solver, matterOf("ice", 273.15, true));
    const uint32_t set = addSet(solver, true);
    solver.spawn(ice(lattice(4, 4, 4, kSpacing, 0), set));
    ps::Spawn other = ice(lattice(4, 4, 4, kSpacing, 4 * kSpacing), set);
    other.body = 1;
    other.velocity.assign(64, {0.5, 0, 0});
    solver.spawn(other);
    QVERIFY(runOn(solver, 45));
    QCOMPARE(piecesOf(solver).count, size_t{2});
  }

  /// A spinning rigid block whose wet coat freezes, of its own body or of nobody's.
  void freezingOntoARigidBodyKeepsMomentum_data() {
    QTest::addColumn<bool>("own");
    QTest::newRow("its own melt") << true;
    QTest::newRow("anybody's") << false;
  }
  void freezingOntoARigidBodyKeepsMomentum() {
    QFETCH(bool, own);
    Solver solver;
    prepareFree(solver, matterOf("ice"));
    const uint32_t set = addSet(solver, true);
    addSet(solver, false);
    const std::vector<Point> points = lattice(6, 5, 4, kSpacing, 0);
    const std::vector<Point> velocities = turning(points, {0.3, 0, 0}, {1, 2, 3});
    ps::Spawn block = ice({points.begin(), points.begin() + 96}, set),
              coat = liquid({points.begin() + 96, points.end()}, 273.2);
    block.velocity = {velocities.begin(), velocities.begin() + 96};
    coat.velocity = {velocities.begin() + 96, velocities.end()};
    if (own) coat.constraintSets = {set};
    coat.body = own ? 0 : 1;
    solver.spawn(block);
    solver.spawn(coat);
    QVERIFY(runOn(solver, 1));
    setEnthalpy(solver, kFrozen, [&](size_t i) { return solver.particles().liquidFraction()[i] > 0; });
    QVERIFY(runOn(solver, 1));
    QCOMPARE(solver.constraintCount(), size_t{1});  // one rigid body, and no bonds
    QCOMPARE(piecesOf(solver).largest, size_t{120});
    const Sums before = sumsOf(solver);
    QVERIFY(runOn(solver, 10));  // ice takes more room than water, and takes it within a few frames
    std::vector<std::vector<double>> shape{distances(solver, 0), distances(solver, 1)};
    QVERIFY(runOn(solver, 60));
    const Sums after = sumsOf(solver);
    QVERIFY((after.momentum - before.momentum).norm() < 1e-6 * before.momentum.norm());
    QVERIFY2((after.angular - before.angular).norm() < 1e-5 * before.angular.norm(),
             qPrintable(QString::number((after.angular - before.angular).norm() / before.angular.norm())));
    QVERIFY(greatestChange(shape[0], distances(solver, 0)) < 2e-6);
    if (!own) QVERIFY(greatestChange(shape[1], distances(solver, 1)) < 2e-6);
  }

  /// Water that freezes from floor and sides, by itself: one piece of all of it, held as its body says.
  void pondFreezesToOnePiece_data() {
    QTest::addColumn<int>("structure");
    QTest::addColumn<double>("temperature");
    QTest::newRow("bonds") << 0 << 276.0;
    // Ice takes more room than its tray has: jammed between the sides, it must not climb.
    for (const double start : {274.9, 275.0, 275.6, 276.0})
      QTest::newRow(qPrintable(QStringLiteral("rigid from %1 K").arg(start))) << 1 << start;
    QTest::newRow("none, in a scene with bonds") << 2 << 276.0;
  }
  void pondFreezesToOnePiece() {
    QFETCH(int, structure);
    QFETCH(double, temperature);
    Solver solver;
    prepare(solver, settingsOf(kSpacing), matterOf("ice", 273.15, true));
    std::vector<ps::Wall> walls = tray(0.16);
    for (ps::Wall& wall : walls) {
      wall.heat = ps::WallHeat::FixedTemperature;
      wall.temperature = 233;
    }
    solver.setWalls(walls);
    ps::ThermalSettings thermal;
    thermal.timeScale = 6000;
    solver.setThermal(thermal, &m_enthalpy, "enthalpy", {});
    const uint32_t set = addSet(solver, structure == 1);
    ps::Spawn pond = liquid(lattice(8, 4, 8, kSpacing, 0), temperature);
    if (structure != 2) pond.constraintSets = {set};
    const std::vector<uint32_t> ids = solver.spawn(pond);
    QCOMPARE(piecesOf(solver).count, size_t{0});
    QVERIFY(run(solver, 360));
    const Pieces pieces = piecesOf(solver);
    QCOMPARE(pieces.count, size_t{1});
    // Single splashes on the sides may freeze where they hang.
    QVERIFY2(pieces.largest >= 250, qPrintable(QString::number(pieces.largest)));
    if (structure == 1) QCOMPARE(solver.constraintCount(), size_t{1});
    QVERIFY2(motionOf(solver, 0).rms < 0.002, qPrintable(QString::number(motionOf(solver, 0).rms)));
  }

  /// What is soft melts too: half of it leaves, the other half holds; then all of it; frozen again, bonds hold it.
  void softMatterMelts_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<int>("least");  // particles of the largest piece in the end
    QTest::newRow("clusters") << 0 << 110;
    QTest::newRow("cloth") << 1 << 55;
    QTest::newRow("rope") << 2 << 4;
  }
  void softMatterMelts() {
    QFETCH(int, kind);
    QFETCH(int, least);
    const ps::constraint::ClusterModel clusters;
    const ps::constraint::ClothModel cloth;
    const ps::constraint::RopeModel rope;
    const ps::AnyConstraint plugins[] = {&clusters, &cloth, &rope};
    const std::vector<Point> shapes[] = {lattice(5, 5, 5, kSpacing, 0), lattice(8, 1, 8, kSpacing, 0),
                                         lattice(12, 1, 1, kSpacing, 0)};
    ps::Material wax = matterOf("wax", 330);
    wax.properties["youngs_modulus"] = 1e4;
    Solver solver;
    prepare(solver, settingsOf(kSpacing), wax);
    solver.setWalls(tray(0.24));
    solver.setThermal({}, &m_enthalpy, "enthalpy", {});
    std::vector<double> parameters = parametersOf(ps::commonOf(plugins[kind]));
    if (kind == 2) parameters[ps::constraint::RopeModel::kStretchStiffness] = 10;  // N, what the step resolves
    const uint32_t set = solver.addConstraintSet(plugins[kind], "soft", parameters);
    addSet(solver, false);
    const std::vector<Point>& points = shapes[kind];
    solver.spawn(solid(points, set));
    const Sums before = sumsOf(solver);
    const ps::ParticleStore& p = solver.particles();
    const auto heatAll = [&](double joules) { setEnthalpy(solver, joules, [](size_t) { return true; }); };
    QVERIFY(runOn(solver, 5));
    const size_t ties = solver.constraintCount();
    const std::vector<uint32_t> half =
        setEnthalpy(solver, kMolten, [&](size_t i) { return points[p.id()[i]].x < -0.001; });
    QVERIFY(runOn(solver, 60));
    QVERIFY(solver.constraintCount() > 0);
    if (kind != 0) QVERIFY(solver.constraintCount() < ties);  // clusters shrink instead
    const std::vector<uint32_t> piece = solver.pieces();
    for (const uint32_t id : half) QCOMPARE(piece[p.indexOf(id)], Solver::kNoPiece);
    QCOMPARE(piecesOf(solver).largest, points.size() - half.size());
    heatAll(kMolten);
    QVERIFY(runOn(solver, 60));
    QCOMPARE(solver.constraintCount(), size_t{0});
    heatAll(kFrozen);
    QVERIFY(runOn(solver, 60));
    QVERIFY2(piecesOf(solver).largest >= static_cast<size_t>(least),
             qPrintable(QString::number(piecesOf(solver).largest)));
    QVERIFY(solver.limits().empty());
    QCOMPARE(sumsOf(solver).count, points.size());
    QCOMPARE(sumsOf(solver).mass, before.mass);
  }

  /// Lists of installed materials may name what the scene calls otherwise; the scene's own list takes their place.
  void namesAreThoseOfTheScene() {
    const ps::PluginRegistry registry;
    ps::Project project;
    project.solver.thermalModel = "enthalpy";
    for (const auto& [id, base] :
         {std::pair{"brine", "water"}, std::pair{"plank", "wood"}, std::pair{"ball", "iron"}}) {
      ps::SceneMaterial material;
      material.id = id;
      material.base = base;
      project.materials.push_back(material);
    }
    const auto listOf = [&](size_t k) { return ps::compileMaterials(project, registry).at(k).adheresTo; };
    const auto adheres = [&](size_t a, size_t b) {
      const std::vector<ps::Material> all = ps::compileMaterials(project, registry);
      return ps::BakedMaterial(all[a], 101325).adheresTo(ps::BakedMaterial(all[b], 101325));
    };
    QCOMPARE(listOf(1), std::vector<std::string>{"brine"});
    QVERIFY(adheres(1, 0) && !adheres(0, 1) && !adheres(1, 2));
    project.materials[1].adheresTo = std::vector<std::string>{};
    QVERIFY(!adheres(1, 0));
    project.materials[1].adheresTo = std::vector<std::string>{"ball"};
    QVERIFY(adheres(1, 2));
  }

  /// In the engine, as the probe counts: two blocks grow together and are two again after a reset; a block cut through
  /// is one again after undo.

 private:
  using Point = ps::api::Double3;
  void prepareFree(Solver& solver, const ps::Material& material) {
    ps::SolverSettings settings = settingsOf(kSpacing);
    settings.gravity = {0, 0, 0};
    settings.xsphMinimum = 0;
    prepare(solver, settings, material);
    solver.setThermal({}, &m_enthalpy, "enthalpy", {});
  }
  uint32_t addSet(Solver& solver, bool rigid) {
    if (rigid) return solver.addConstraintSet(&m_rigid, "rigid", rigidParameters());
    return solver.addConstraintSet(&m_bonds, "bonds", bondParameters());
  }

  const ps::thermal::EnthalpyModel m_enthalpy{};
  const ps::constraint::BondModel m_bonds{};
  const ps::constraint::RigidModel m_rigid{};
};

QTEST_APPLESS_MAIN(TestJoining)
#include "tst_joining.moc"
