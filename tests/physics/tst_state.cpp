// SPDX-License-Identifier: Apache-2.0
// What a solver carries from frame to frame is saved whole: one that is restored goes on to the same bits, on any
// number of threads and any instruction set, and a frame that fails leaves nothing behind.
#include "core/base/error.h"
#include "core/base/statestream.h"
#include "onehash.h"
#include "rigidscene.h"

#include <QTest>

#include <cmath>

using namespace mechanics;
using ps::Solver;

namespace {

/// The enthalpy model, whose temperatures are no numbers once it is armed.
class PlantingModel final : public ps::thermal::EnthalpyModel {
 public:
  mutable std::atomic<bool> armed{false};
  void derive(const ps::api::ThermalContext& c, const ps::api::ParticleView& p, size_t first, size_t last,
              const ps::api::ThermalOutput& out) const override {
    EnthalpyModel::derive(c, p, first, last, out);
    if (armed) out.temperature[first] = std::nan("");
  }
};

/// Ice that melts on a hot floor into water that cools in the air, two rigid boxes on top of each other, and a fixed
/// bar that is led through them.
class Scene {
 public:
  explicit Scene(bool withMatter) {
    prepare(solver, settingsOf(0.02));
    std::vector<ps::Wall> walls = tray(0.32);
    walls[0].heat = ps::WallHeat::FixedTemperature;
    walls[0].temperature = 350;
    solver.setWalls(walls);
    ps::ThermalSettings thermal;
    thermal.timeScale = 1500;
    thermal.airConvection = 50;
    thermal.radiation = true;
    solver.setThermal(thermal, &model, "model", {});
    const uint32_t bonded = solver.addConstraintSet(&m_bonds, "bonds", bondParameters());
    const uint32_t stiff = solver.addConstraintSet(&m_rigid, "rigid", rigid::rigidParameters());
    if (!withMatter) return;
    const auto moved = [](std::vector<ps::api::Double3> points, double x) {
      for (auto& p : points) p.x += x;
      return points;
    };
    solver.setMotion(4, {{0, 0.3, 0}, {0.05, -0.1, 0}, {0, 2, 0}, 0, 1e9});
    ps::Spawn bar = fixedPoints(lattice(8, 1, 2, 0.02, 0.3));
    bar.body = 4;
    solver.spawn(bar);
    solver.spawn(ice(moved(lattice(5, 4, 6, 0.02, 0), -0.08), bonded, 272));
    ps::Spawn pond = liquid(lattice(3, 4, 15, 0.02, 0), 300);
    pond.body = 1;
    solver.spawn(pond);
    for (const uint32_t k : {2u, 3u}) {
      ps::Spawn box = ice(moved(lattice(4, 3, 4, 0.02, k == 2 ? 0.001 : 0.063), 0.09), stiff, 250);
      box.body = k;
      solver.spawn(box);
    }
  }
  PlantingModel model;
  Solver solver;

 private:
  ps::constraint::BondModel m_bonds;
  ps::constraint::RigidModel m_rigid;
};

std::vector<std::byte> saved(const Solver& solver) {
  ps::StateBuffer buffer;
  ps::saveTo(buffer, solver);
  return {buffer.bytes().begin(), buffer.bytes().end()};
}

constexpr int kBefore = 37, kAfter = 40;

/// Saved in a frame in which lists are some frames old, ice has melted and boxes have met.
const std::vector<std::byte>& sampleState() {
  static const std::vector<std::byte> state = [] {
    ps::setThreadCount(2);
    Scene scene(true);
    return run(scene.solver, kBefore) ? saved(scene.solver) : std::vector<std::byte>{};
  }();
  return state;
}

}  // namespace

class TestState : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet("");
  }

  void theSceneHasWhatStateIsMadeOf() {
    const ps::StateReader reader(sampleState());
    QVERIFY(reader.count("neighbours/built") > 0);
    QVERIFY(reader.count("constraints.0/particles") > 0);
    QVERIFY(reader.count("constraints.1/member_values") > 0);
    QVERIFY(reader.count("motion/exists") == 5);
    QVERIFY(reader.count("heat/open_directions") > 0);
    const std::vector<uint8_t> marks = reader.array<uint8_t>("rigid/marks");
    QVERIFY(std::count_if(marks.begin(), marks.end(), [](uint8_t m) { return (m & 1) != 0; }) > 4);
    const std::vector<uint8_t> motion = reader.array<uint8_t>("field/motion");
    QVERIFY(std::count(motion.begin(), motion.end(), uint8_t{1}) > 180);  // more liquid than the pond
  }

  void aRestoredRunGoesOnToTheSameBits_data() { onehash::addRows(); }
  void aRestoredRunGoesOnToTheSameBits() {
    QFETCH(int, threads);
    QFETCH(QString, instructions);
    static const uint64_t uninterrupted = [] {
      Scene scene(true);
      return run(scene.solver, kBefore + kAfter) ? scene.solver.stateHash() : 0;
    }();
    QVERIFY(uninterrupted != 0);
    ps::setThreadCount(threads);
    ps::setInstructionSet(instructions.toStdString());
    Scene scene(false);
    scene.solver.restore(ps::StateReader(sampleState()));
    QVERIFY(saved(scene.solver) == sampleState());
    QCOMPARE(scene.solver.frame(), uint64_t{kBefore});
    QVERIFY(run(scene.solver, kAfter));
    QCOMPARE(scene.solver.stateHash(), uninterrupted);
  }

  /// A solver is stopped and restored after every frame; in some of them lists are new, in some old.
  void everyFrameIsAPlaceToStop() {
    ps::setThreadCount(2);
    Scene whole(true);
    auto part = std::make_unique<Scene>(true);
    for (int frame = 0; frame < 90; ++frame) {
      QVERIFY(run(whole.solver, 1) && run(part->solver, 1));
      const std::vector<std::byte> state = saved(part->solver);
      part = std::make_unique<Scene>(false);
      part->solver.restore(ps::StateReader(state));
      QVERIFY2(part->solver.stateHash() == whole.solver.stateHash(), qPrintable(QString("frame %1").arg(frame)));
    }
  }

  void aFailedFrameLeavesNothingBehind() {
    Scene scene(true);
    QVERIFY(run(scene.solver, kBefore));
    const std::vector<std::byte> before = saved(scene.solver);
    const uint64_t hash = scene.solver.stateHash();
    scene.model.armed = true;
    QCOMPARE(scene.solver.step().flags, static_cast<ps::StepFlags>(ps::StepFlag::NotFinite));
    QCOMPARE(scene.solver.stateHash(), hash);
    QVERIFY(saved(scene.solver) == before);
    scene.model.armed = false;
    QVERIFY(run(scene.solver, kAfter));
    Scene untouched(true);
    QVERIFY(run(untouched.solver, kBefore + kAfter));
    QCOMPARE(scene.solver.stateHash(), untouched.solver.stateHash());
  }

  /// Every block in turn is left out, cut short, or has its bytes overwritten: all is told, or goes on as other matter.
  void aDamagedStateIsToldOrHarmless() {
    const ps::StateReader whole(sampleState());
    int told = 0;
    for (const ps::StateReader::Block& victim : whole.blocks()) {
      for (const int kind : {0, 1, 2, 3}) {
        ps::StateBuffer buffer;
        ps::StateWriter writer(buffer);
        for (const ps::StateReader::Block& block : whole.blocks()) {
          const bool isVictim = &block == &victim;
          if (isVictim && kind == 0) continue;
          std::vector<std::byte> bytes(block.bytes.begin(), block.bytes.end());
          uint64_t count = block.count;
          if (isVictim && kind == 1 && count > 0 && block.type != ps::StateType::Text)
            bytes.resize(--count * ps::sizeOf(block.type));
          if (isVictim && kind >= 2 && block.type != ps::StateType::Text)
            std::fill(bytes.begin(), bytes.end(), static_cast<std::byte>(kind == 2 ? 0xff : 0x03));
          writer.block({block.name, block.type, block.version, count, bytes});
        }
        writer.finish();
        Scene scene(false);
        try {
          scene.solver.restore(ps::StateReader(buffer.bytes()));
        } catch (const ps::InputError& problem) {
          ++told;
          if (kind == 0) QVERIFY2(std::string(problem.what()).find("state") != std::string::npos, problem.what());
          continue;
        }
        QVERIFY2(kind != 0 || victim.name.starts_with("field/"), victim.name.c_str());
        if (victim.name.starts_with("field/") || victim.name.ends_with("values")) scene.solver.step();
      }
    }
    QVERIFY(told > 80);
  }
};

QTEST_APPLESS_MAIN(TestState)
#include "tst_state.moc"
