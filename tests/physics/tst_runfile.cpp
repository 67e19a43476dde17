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
  void strokesOnWhatMovedAndPartingsAreInTheFile();
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

/// A stroke goes on with a bar that has fallen and been turned, and half of it becomes a body of its own.
void TestRunFile::strokesOnWhatMovedAndPartingsAreInTheFile() {
  Project project = scenes::iceOnPlate(4, 400);
  Body bar;
  bar.id = bar.name = "bar", bar.material = "water";
  bar.constraints.push_back({"bonds", {}, {}});
  VoxelShape shape;
  shape.origin = Vector3::Constant(0.015);
  shape.spacing = 0.03;
  shape.palette.push_back({"water", 260, {}});
  shape.runs = {{-1, 20, 0, 6, 0}};
  bar.shape = shape;
  project.bodies.push_back(bar);
  Engine engine(project, m_plugins);
  RunRecord record(kPlenty);
  record.begin(engine.revision());
  record.keepState(engine);
  const auto edit = [&](uint64_t frame, const Command& command) {
    engine.apply(command);
    record.add({frame, command});
  };
  const size_t before = engine.snapshot()->id.size();
  for (uint64_t frame = 0; frame <= 8; ++frame) {
    if (frame == 3) {
      const RigidMove way{Quaternion(Eigen::AngleAxisd(0.5, Vector3(0, 1, 0))), {0, 0.1, 0}};
      edit(frame, AddCells{std::make_shared<const Body>(bar), {{5, 20, 0}, {6, 20, 0}}, 0, 7, way});
    } else if (frame == 5) {
      Body half = bar;
      half.id = half.name = "half";
      project.bodies.push_back(half);
      edit(frame, UpdateProject{std::make_shared<const Project>(project)});
      edit(frame, PassMatter{"bar", "half", shape, {{3, 20, 0}, {4, 20, 0}, {5, 20, 0}}, false});
    }
    record.add(engine.snapshot());
    record.settle();
    if (frame < 8) engine.step();
  }
  const SnapshotPtr now = engine.snapshot();
  QCOMPARE(now->id.size(), before + 2);
  const auto half = std::find(now->bodyIds->begin(), now->bodyIds->end(), "half") - now->bodyIds->begin();
  QCOMPARE(std::count(now->body.begin(), now->body.end(), static_cast<uint32_t>(half)), std::ptrdiff_t{3});
  RunRecord again(kPlenty);
  again.adopt(throughAFile(record.content(), project, m_plugins), 1);
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
