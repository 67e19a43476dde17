// SPDX-License-Identifier: Apache-2.0
// A project that holds a state: it opens there, goes on to the same bits, and whatever else stands there is told.
#include "core/base/base64.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/experiments/caserun.h"
#include "core/experiments/soak.h"
#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/projectstate.h"
#include "core/solver/solver.h"
#include "tests/shared/scenes.h"

#include <QTemporaryDir>
#include <QTest>

#include <nlohmann/json.hpp>
#include <zstd.h>

using namespace ps;
using nlohmann::json;

namespace {

constexpr int kBefore = 60, kAfter = 60;

using Bytes = std::vector<std::byte>;

Bytes saved(const Engine& engine) {
  StateBuffer buffer;
  saveTo(buffer, engine);
  return {buffer.bytes().begin(), buffer.bytes().end()};
}

void run(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) engine.step();
}

/// Ice on a plate under a tap, which holds layers in its pipe, warmed by a plugin's source.
Project scene() {
  Project project = scenes::iceOnPlate(4, 370);
  Emitter tap;
  tap.id = tap.name = "tap";
  tap.material = "water";
  tap.point = {0, 0.5, 0};
  tap.parameters.values["diameter"] = 0.09;
  project.emitters.push_back(tap);
  project.solver.heatSources.push_back({"fixture.source", {}, {}});
  return project;
}

std::string zstdText(const std::vector<std::byte>& bytes) {
  std::vector<std::byte> small(ZSTD_compressBound(bytes.size()));
  const size_t size = ZSTD_compress(small.data(), small.size(), bytes.data(), bytes.size(), 3);
  return toBase64(std::span(small).first(size));
}

}  // namespace

class TestProjectState : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void initTestCase() {
    const QString file = QStringLiteral("fixture_source.so");
    QVERIFY(QFile::copy(qEnvironmentVariable("PS_FIXTURE_DIR") + "/" + file, m_fixtures.filePath(file)));
    PluginRegistry::Options options;
    options.userDirectory = options.environment = false;
    options.extraPaths = {m_fixtures.path().toStdString()};
    m_plugins = std::make_unique<PluginRegistry>(options);
    QVERIFY(m_plugins->has("fixture.source"));
    Engine engine(scene(), *m_plugins);
    m_start = engine.stateHash();
    run(engine, kBefore);
    QVERIFY(engine.stats().flow.held.count > 0 && engine.stats().heat.sources != 0);
    m_state = saved(engine);
    m_project = scene();
    m_project.state = projectState(m_state, m_project.bodies);
    m_text = writeProject(m_project);
    run(engine, kAfter);
    m_end = engine.stateHash();
  }
  void cleanup() {
    setThreadCount(0);
    setInstructionSet("");
  }

  void everyBlockComesBack() {
    const LoadedProject loaded = parseProject(m_text, "scene.json", *m_plugins);
    QVERIFY2(loaded.warnings.empty(), loaded.warnings.empty() ? "" : loaded.warnings[0].text.c_str());
    const StateBuffer buffer = unpackState(loaded.project.state->blocks);
    QVERIFY(std::equal(buffer.bytes().begin(), buffer.bytes().end(), m_state.begin(), m_state.end()));
    QCOMPARE(writeProject(loaded.project), m_text);
    QCOMPARE(loaded.project.state->frame, uint64_t{kBefore});
    QVERIFY(std::abs(loaded.project.state->time - kBefore / 60.0) < 1e-9);
  }

  void opensThereAndGoesOnToTheSameBits() {
    const Project project = parseProject(m_text, "scene.json", *m_plugins).project;
    for (const int threads : {1, 2}) {
      setThreadCount(threads);
      if (threads == 2) setInstructionSet(availableInstructionSets().back());
      Engine engine(project, *m_plugins);
      QVERIFY2(engine.remarks().empty(), engine.remarks().empty() ? "" : engine.remarks()[0].c_str());
      QCOMPARE(engine.solver().frame(), uint64_t{kBefore});
      QVERIFY(saved(engine) == m_state);
      run(engine, kAfter);
      QCOMPARE(engine.stateHash(), m_end);
    }
  }

  void homeIsTheStartAndTheWayBackIsAnEdit() {
    Engine engine(m_project, *m_plugins);
    engine.apply(Reset{});
    QCOMPARE(engine.stateHash(), m_start);
    run(engine, 3);
    engine.apply(ReturnToState{m_project.state});
    QVERIFY(saved(engine) == m_state);
    Project other = m_project;
    std::get<BoxShape>(other.bodies[0].shape).size.y() *= 2;
    engine.update(other);
    run(engine, 1);
    const uint64_t before = engine.stateHash();
    QVERIFY_THROWS_EXCEPTION(InputError, engine.apply(ReturnToState{m_project.state}));
    QCOMPARE(engine.stateHash(), before);
  }

  /// Edits that a scene takes while it runs are no reason to begin anew; another shape is.
  void aStateThatNoLongerFitsIsToldAndKept_data() {
    QTest::addColumn<QString>("edit");
    QTest::addColumn<QString>("says");
    QTest::newRow("hotter floor") << "environment/walls/floor/temperature=400"
                                  << "";
    QTest::newRow("another title") << R"(title="Renamed")"
                                   << "";
    QTest::newRow("finer next time") << "solver/particle_spacing=0.02"
                                     << "";
    QTest::newRow("larger ice")
        << "bodies/ice/shape/box/size=[0.3, 0.12, 0.12]"
        << "/state: the state is of another scene: the body 'ice' has another shape by now; the scene "
           "opens at its start";
    QTest::newRow("no ice") << "bodies=[]"
                            << "/state: the state is of another scene: the body 'ice' has gone;";
    QTest::newRow("more") << R"(bodies/ice/id="snow")"
                          << "/state: the state is of another scene: the body 'ice' came later;";
    QTest::newRow("no tap") << "emitters=[]"
                            << "/state: the state has matter of 'tap', which has gone; the scene opens at its start";
    QTest::newRow("cold") << R"(solver/thermal={"model": ""})"
                          << "/state: the state is of the thermal model";
    QTest::newRow("a block is missing") << R"(state/blocks/0/name="clock/none")"
                                        << "/state: state block 'clock/frames': is missing;";
    QTest::newRow("a block more")
        << R"(state/blocks/0={"name": "later/thing", "type": "uint8", "count": 0, "data": ""})"
        << "/state: state block 'clock/frames': is missing;";
    QTest::newRow("another frame") << "state/frame=59"
                                   << "says frame 59, and its blocks are of frame 60;";
  }
  void aStateThatNoLongerFitsIsToldAndKept() {
    QFETCH(QString, edit);
    QFETCH(QString, says);
    const Project project = parseProject(m_text, "scene.json", *m_plugins, {edit.toStdString()}).project;
    Engine engine(project, *m_plugins);
    const QString told = engine.remarks().empty() ? QString() : QString::fromStdString(engine.remarks()[0]);
    QVERIFY2(says.isEmpty() ? told.isEmpty() : told.contains(says), qPrintable(told));
    QCOMPARE(engine.solver().frame(), uint64_t(says.isEmpty() ? kBefore : 0));
    QVERIFY(json::parse(writeProject(project))["state"]["blocks"].size() == m_project.state->blocks.size());
  }

  /// What is judged, or compared with other runs, is counted from the start, whatever state the project holds.
  void experimentsBeginAtTheStart() {
    const auto topSpeed = [&](const Project& project) {
      double speed = -1;
      soakProject(project, m_plugins, {}, 0.1, {}, [&](const SoakVerdict& verdict) { speed = verdict.topSpeed; });
      return speed;
    };
    const double fromStart = topSpeed(scene());
    QVERIFY(fromStart > 0);
    QCOMPARE(topSpeed(m_project), fromStart);

    const auto lastFrame = [&](const std::string& text) {
      writeFileAtomically(m_fixtures.filePath("case.json").toStdString(), text);
      Case what;
      what.id = "state";
      what.project = m_fixtures.filePath("case.json").toStdString();
      what.runs = {{"", {}, 3}};
      CaseCheck check;
      check.number.column = "ice core.temperature[K]";
      check.number.measure = "last";
      what.checks = {check};
      std::optional<double> measured;
      runCase(what, {}, *m_plugins, {}, [&](const CaseVerdict& verdict) { measured = verdict.measured; });
      return measured;
    };
    QVERIFY(lastFrame(m_text));
    QCOMPARE(*lastFrame(m_text), *lastFrame(writeProject(scene())));
  }

  void whatIsNotKnownIsKeptAndTold() {
    json document = json::parse(m_text);
    document["state"]["later"] = 1;
    document["state"]["blocks"][3]["later"] = 2;
    document["state"]["bodies"][0]["later"] = 3;
    document["state"]["blocks"].push_back({{"name", "later/thing"}, {"type", "uint8"}, {"count", 0}, {"data", ""}});
    const LoadedProject loaded = parseProject(document.dump(), "scene.json", *m_plugins);
    QCOMPARE(loaded.warnings.size(), size_t{3});
    QVERIFY(json::parse(writeProject(loaded.project))["state"] == document["state"]);
    Engine engine(loaded.project, *m_plugins);
    QCOMPARE(engine.remarks(), std::vector<std::string>{"/state/blocks: nothing here knows the block 'later/thing'; it "
                                                        "is kept and has no effect"});
    QVERIFY(saved(engine) == m_state);
  }

  void whatIsBrokenIsRefusedByItsPlace_data() {
    QTest::addColumn<QString>("edit");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, const std::string& edit, const char* says) {  // ' stands for "
      QTest::newRow(name) << QString::fromStdString(edit).replace('\'', '"') << QString("scene.json:/state") + says;
    };
    const std::string some = zstdText(Bytes(16)), bomb = zstdText(Bytes(size_t{1} << 26));
    row("no object", "state=12", ": must be an object");
    row("nothing in it", "state={}", "/frame: is missing");
    row("time", "state/time='soon'", "/time: must be a number");
    row("frame", "state/frame=-1", "/frame: ");
    row("no blocks", "state/blocks=7", "/blocks: must be a list");
    row("no data", "state/blocks/0={'name': 'a', 'type': 'uint8', 'count': 1}", "/blocks/0/data: is missing");
    row("type", "state/blocks/0/type='int7'", "/blocks/0/type: must be one of uint8, uint32");
    row("name", "state/blocks/1/name=''", "/blocks/1/name: must not be empty");
    row("twice", "state/blocks/1/name='clock/frames'", "/blocks/1/name: 'clock/frames' is taken already");
    row("count", "state/blocks/0/count=3",
        "/blocks/0/data: the block 'clock/frames' holds 16 bytes, which are not 3 elements of uint64");
    row("nothing for something", "state/blocks/0/data=''", "/blocks/0/data: the block 'clock/frames' holds 0 bytes");
    row("no base64", "state/blocks/0/data='AAA*'", "/blocks/0/data: the block 'clock/frames' is no base64");
    row("cut base64", "state/blocks/0/data='" + some.substr(0, some.size() - 3) + "'",
        "/blocks/0/data: the block 'clock/frames' is no base64, or is cut off");
    row("cut zstd", "state/blocks/0/data='" + some.substr(0, some.size() - 8) + "'",
        "/blocks/0/data: the block 'clock/frames' is damaged, or is cut off");
    row("no zstd", "state/blocks/0/data='AAAAAAAA'", "/blocks/0/data: the block 'clock/frames' is no zstd frame");
    row("bomb", "state/blocks/0={'name': 'a', 'type': 'uint8', 'count': 4294967296, 'data': '" + bomb + "'}",
        "/blocks/0/data: the block 'a' holds 67108864 bytes, which are not 4294967296 elements of uint8");
    row("body twice", "state/bodies=[{'id': 'a', 'stamp': '1'}, {'id': 'a', 'stamp': '2'}]",
        "/bodies/1/id: 'a' is taken already");
  }
  void whatIsBrokenIsRefusedByItsPlace() {
    QFETCH(QString, edit);
    QFETCH(QString, says);
    std::string problem;
    try {
      parseProject(m_text, "scene.json", *m_plugins, {edit.toStdString()});
    } catch (const InputError& error) {
      problem = error.what();
    }
    QVERIFY2(QString::fromStdString(problem).startsWith(says), problem.c_str());
  }

  /// A bomb that says its size truly: what all blocks may take together ends it before memory is had.
  void bombsAreBounded() {
    const Bytes zeros(size_t{1} << 26);
    json blocks = json::array();
    for (int k = 0; k < 17; ++k) {
      blocks.push_back({{"name", "bomb/" + std::to_string(k)},
                        {"type", "uint8"},
                        {"count", zeros.size()},
                        {"data", zstdText(zeros)}});
    }
    std::string problem;
    try {
      parseProject(m_text, "scene.json", *m_plugins, {"state/blocks=" + blocks.dump()});
    } catch (const InputError& error) {
      problem = error.what();
    }
    QVERIFY2(
        problem.starts_with("scene.json:/state/blocks/16/data: the block 'bomb/16' would take 67108864 bytes, more"),
        problem.c_str());
  }

  /// Every block in turn has its bytes overwritten, or fewer of them, and is packed well: the scene opens at its start
  /// and says so, or goes on as other matter.
  void damageBeneathThePackingIsToldOrHarmless() {
    const StateReader whole(m_state);
    int told = 0;
    for (size_t victim = 0; victim < whole.blocks().size(); ++victim) {
      for (const uint8_t fill : {0xff, 0x03, 0x00}) {
        StateBuffer buffer;
        StateWriter writer(buffer);
        for (size_t k = 0; k < whole.blocks().size(); ++k) {
          StateBlock block = whole.blocks()[k];
          Bytes bytes(block.bytes.begin(), block.bytes.end());
          if (k == victim) {
            if (fill == 0 && block.type != StateType::Text && block.count > 0)
              bytes.resize(--block.count * sizeOf(block.type));
            else
              std::fill(bytes.begin(), bytes.end(), static_cast<std::byte>(fill));
          }
          block.bytes = bytes;
          writer.block(block);
        }
        writer.finish();
        auto state = std::make_shared<ProjectState>(*m_project.state);
        state->blocks = packState(StateReader(buffer.bytes()));
        Project project = m_project;
        project.state = state;
        Engine engine(project, *m_plugins);
        if (!engine.remarks().empty() && engine.remarks()[0].ends_with("at its start")) {
          ++told;
          QCOMPARE(engine.stateHash(), Engine(scene(), *m_plugins).stateHash());  // a plugin may have failed by now
        }
        engine.step();
      }
    }
    QVERIFY2(told > 60, qPrintable(QString::number(told)));
  }

  void base64() {
    Bytes bytes;
    for (int n = 0; n < 40; ++n) {
      const std::string text = toBase64(bytes);
      QCOMPARE(QByteArray::fromStdString(text),
               QByteArray(reinterpret_cast<const char*>(bytes.data()), qsizetype(bytes.size())).toBase64());
      QVERIFY(fromBase64(text) == bytes);
      bytes.push_back(static_cast<std::byte>(n * 37 + 251));
    }
    for (const char* bad : {"A", "AB", "ABC", "A===", "====", "AB=C", "A=BC", "AA\n=", "AB==AAAA", "AB==", "AAB="})
      QVERIFY2(!fromBase64(bad), bad);
  }

 private:
  QTemporaryDir m_fixtures;
  std::unique_ptr<PluginRegistry> m_plugins;
  Project m_project;  // with its state
  std::string m_text;
  Bytes m_state;
  uint64_t m_start = 0, m_end = 0;
};

QTEST_GUILESS_MAIN(TestProjectState)
#include "tst_projectstate.moc"
