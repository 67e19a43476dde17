// SPDX-License-Identifier: Apache-2.0
// What a record holds beside plain frames comes back from a file.
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/runrecord.h"
#include "tests/shared/scenes.h"

#include <QTemporaryDir>
#include <QTest>

using namespace ps;

namespace {

constexpr size_t kPlenty = size_t{1} << 30;

RunContent throughAFile(const RunContent& content, const Project& project, const PluginRegistry& plugins) {
  const QTemporaryDir folder;
  const std::string path = folder.filePath("run.psrec").toStdString();
  RecordingWriter writer(path, project);
  writer.add(content);
  writer.finish();
  const RecordingReader reader(path, plugins);
  const std::string problem = reader.damage() + reader.whyNoStates();
  if (!problem.empty()) qWarning("%s", problem.c_str());
  return reader.content();
}

}  // namespace

class TestRunFile : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void aBodyThatCameIsOfItsMesh();
  void statesThatOneRunGaveUpAreInTheFile();

 private:
  PluginRegistry m_plugins;
};

void TestRunFile::aBodyThatCameIsOfItsMesh() {
  Project project = scenes::iceOnPlate(4, 400);
  Engine engine(project, m_plugins);
  RunRecord record(kPlenty);
  record.begin(engine.revision());
  record.keepState(engine);
  const size_t before = engine.snapshot()->id.size();
  for (uint64_t frame = 0; frame <= 8; ++frame) {
    if (frame == 3) {
      const Body cube = scenes::meshCube();
      project.bodies.push_back(cube);
      for (const Command& command : {Command{UpdateProject{std::make_shared<const Project>(project)}},
                                     Command{ReturnBody{std::make_shared<const Body>(cube), 9}}}) {
        engine.apply(command);
        record.add({frame, command});
      }
    }
    record.add(engine.snapshot());
    record.settle();
    if (frame < 8) engine.step();
  }
  QVERIFY(engine.snapshot()->id.size() > before);
  RunRecord again(kPlenty);
  again.adopt(throughAFile(record.content(), project, m_plugins), 1);
  QCOMPARE(again.extent().last, uint64_t{8});
  QCOMPARE(replayed(again.restorePoint(8).value(), m_plugins)->stateHash(), engine.stateHash());
}

/// An earlier run has kept one that the present run has not, between those that both have.
void TestRunFile::statesThatOneRunGaveUpAreInTheFile() {
  const Project project = scenes::iceOnPlate(4, 400);
  Engine engine(project, m_plugins);
  RunRecord record(kPlenty);
  record.begin(engine.revision());
  for (uint64_t frame = 0; frame <= 8; ++frame) {
    if (frame % 2 == 0) record.keepState(engine);
    record.add(engine.snapshot());
    record.settle();
    if (frame < 8) engine.step();
  }
  record.cutAfter(6, 1);
  RunContent content = record.content();
  content.present.states.erase(content.present.states.begin() + 1);
  content.present.eraseFrame(content.present.frames.find(3));
  const RunContent read = throughAFile(content, project, m_plugins);
  const auto framesOf = [](const KeptRun& run) {
    std::vector<uint64_t> frames;
    for (const KeptRun::State& state : run.states) frames.push_back(state.frame);
    return frames;
  };
  QCOMPARE(framesOf(read.present), (std::vector<uint64_t>{0, 4, 6}));
  QCOMPARE(read.earlier.size(), size_t{1});
  QCOMPARE(framesOf(read.earlier.front()), (std::vector<uint64_t>{0, 2, 4, 6, 8}));
  QCOMPARE(read.present.frames.size(), size_t{6});
  QCOMPARE(read.earlier.front().frames.size(), size_t{9});
}

QTEST_GUILESS_MAIN(TestRunFile)
#include "tst_runfile.moc"
