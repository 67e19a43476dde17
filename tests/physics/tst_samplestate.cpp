// SPDX-License-Identifier: Apache-2.0
// Every sample and scene of the thesis is saved, restored by another engine on other threads and another instruction
// set, and comes to the hash of the run that was not interrupted.
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/scenestate.h"
#include "core/solver/solver.h"

#include <QDir>
#include <QTest>

using ps::Engine;
using ps::InputError;
using ps::Project;

namespace {

constexpr int kBefore = 6, kAfter = 6;
const QString kProjects = PS_SOURCE_DIR "/projects";

using Bytes = std::vector<std::byte>;

Bytes saved(const Engine& engine) {
  ps::StateBuffer buffer;
  ps::saveTo(buffer, engine);
  return {buffer.bytes().begin(), buffer.bytes().end()};
}

void run(Engine& engine, int frames) {
  for (int frame = 0; frame < frames; ++frame) engine.step();
}

std::string refusalOf(Engine& engine, const Bytes& state) {
  try {
    engine.restore(ps::StateReader(state));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return {};
}

}  // namespace

class TestSampleState : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() {
    ps::setThreadCount(0);
    ps::setInstructionSet("");
  }

  void goesOnAsIfNothingHadHappened_data() {
    QTest::addColumn<QString>("file");
    for (const QString& folder : {kProjects, kProjects + "/thesis"}) {
      for (const QString& name : QDir(folder).entryList({"*.json"}, QDir::Files, QDir::Name))
        QTest::newRow(qPrintable(name)) << folder + "/" + name;
    }
  }
  void goesOnAsIfNothingHadHappened() {
    QFETCH(QString, file);
    const Project project = ps::loadProject(file.toStdString(), m_plugins).project;
    ps::setThreadCount(2);
    Engine whole(project, m_plugins);
    run(whole, kBefore);
    const Bytes state = saved(whole);
    run(whole, kAfter);
    ps::setThreadCount(1);
    ps::setInstructionSet(ps::availableInstructionSets().back());
    // By way of a file: the project opens at its state.
    Project kept = project;
    kept.state = ps::projectState(state, project.bodies);
    Engine other(ps::parseProject(ps::writeProject(kept), "kept.json", m_plugins).project, m_plugins);
    QVERIFY2(other.remarks().empty(), other.remarks().empty() ? "" : other.remarks()[0].c_str());
    QVERIFY(saved(other) == state);
    run(other, kAfter);
    QCOMPARE(other.stateHash(), whole.stateHash());
    QCOMPARE(other.solver().frame(), uint64_t{kBefore + kAfter});
  }

  void theStateOfAnotherSceneIsRefused() {
    const auto open = [&](const char* name) {
      return ps::loadProject((kProjects + "/" + name + ".json").toStdString(), m_plugins).project;
    };
    Project project = open("ice-on-hot-plate");
    Engine engine(project, m_plugins);
    const Bytes state = saved(engine);
    const ps::StateReader reader(state);
    ps::requireOfProject(reader, project);
    QVERIFY_THROWS_EXCEPTION(InputError, ps::requireOfProject(reader, open("river")));
    project.materials[0].id = "other";
    for (ps::Body& body : project.bodies) body.material = "other";
    Engine renamed(project, m_plugins);
    const uint64_t before = renamed.stateHash();
    QVERIFY(refusalOf(renamed, state).find("which the project has not") != std::string::npos);
    QCOMPARE(renamed.stateHash(), before);  // and has changed nothing
    Project cold = open("ice-on-hot-plate");
    cold.solver.thermalModel.clear();
    Engine still(cold, m_plugins);
    QVERIFY(refusalOf(still, state).find("thermal model") != std::string::npos);
  }

 private:
  ps::PluginRegistry m_plugins;
};

QTEST_GUILESS_MAIN(TestSampleState)
#include "tst_samplestate.moc"
