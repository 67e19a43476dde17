// SPDX-License-Identifier: Apache-2.0
// A run is recorded while it runs: any frame can be looked at, and be made again to the bit.
#include "core/base/parallel.h"
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/simulation/engine.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/runrecord.h"
#include "core/solver/solver.h"
#include "tests/shared/enginehands.h"
#include "tests/shared/plainframe.h"

#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <map>
#include <random>

using namespace ps;

namespace {

const QString kProjects = PS_SOURCE_DIR "/projects";
constexpr size_t kPlenty = size_t{1} << 30;
constexpr uint64_t kFrames = 24;

/// As fine as the sample is, in less of it: a few thousand particles are enough to show whether bits agree.
Project open(const QString& name, PluginRegistry& plugins) {
  Project project = loadProject((kProjects + "/" + name + ".json").toStdString(), plugins).project;
  project.solver.parameters.values["particle_spacing"] =
      1.4 * numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  return project;
}

/// The first body a little further, turned where it is a solid.
Command further(const Project& project) {
  Body body = project.bodies.front();
  const RigidMove turn = RigidMove::about(pivotOf(body), Quaternion(Eigen::AngleAxisd(0.3, Vector3(1, 2, 2) / 3)));
  RigidMove move = std::holds_alternative<SolidShape>(body.shape) ? turn : RigidMove{};
  move.shift += Vector3(0.01, 0.02, 0);
  move = possibleMove(body, move);
  body = moved(std::move(body), move);
  return MoveBody{std::make_shared<const Body>(std::move(body)), move};
}

/// A slider in frame 3 and 11, the first body moved before that, taken at frame 5 and put back at 14, the document as a
/// whole at 17.
std::vector<RecordedEdit> editsAfter(uint64_t frame, const Project& project) {
  constexpr MatterKey kKey = 77;
  const Address gravity{Owner::Scene, "", "gravity"};
  const std::string& body = project.bodies.front().id;
  if (frame == 3) return {further(project), std::vector{SetParameter{gravity, 7.5}}};
  if (frame == 5) return {Command{TakeBody{body, kKey}}};
  if (frame == 11) return {std::vector{SetParameter{gravity, 12.0}}, std::vector{SetParameter{gravity, 9.0}}};
  if (frame == 14) return {Command{PutBack{kKey}}};
  if (frame == 17) return {Command{UpdateProject{std::make_shared<const Project>(project)}}};
  return {};
}

void make(Engine& engine, const RecordedEdit& edit) {
  if (const auto* together = std::get_if<std::vector<SetParameter>>(&edit))
    engine.setParameters(*together);
  else
    engine.apply(std::get<Command>(edit));
}

float widest(const std::vector<float>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0 : *high - *low;
}

/// Half of a step whose width grows with the root of what it tells, up to what is more than the most by the power of
/// two that comes after a fourth of one.
float halfRootStep(float most, float value) {
  const float root = std::sqrt(std::abs(value)), step = std::sqrt(2.4F * most) / 255;
  return step * root + step * step;
}

void compare(const Snapshot& is, const Snapshot& was, float fastest) {
  QCOMPARE(is.revision, uint64_t{9});
  QCOMPARE(is.stats.time, was.stats.time);
  QCOMPARE(is.stats.thermalEnergy, was.stats.thermalEnergy);
  QCOMPARE(is.stats.probes.size(), was.stats.probes.size());  // some measure nothing yet, which equals nothing
  QVERIFY(is.bodyIds == was.bodyIds && is.flags == was.flags);
  QVERIFY(is.materialLook == was.materialLook && is.limits.size() == was.limits.size());
  QCOMPARE(is.id.size(), was.id.size());
  QCOMPARE(is.fields.size(), was.fields.size());
  std::map<uint32_t, size_t> rows;
  for (size_t i = 0; i < was.id.size(); ++i) rows[was.id[i]] = i;
  // A float's own steps come on top.
  const float place = 0.00501F * static_cast<float>(was.spacing) + 1e-6F, warmth = 0.0251F;
  float radius = 0;
  for (const api::Float4& p : was.position) radius = std::max(radius, p.w);
  std::vector<float> steps;
  for (size_t f = 0; f < is.fields.size(); ++f) {
    QCOMPARE(is.fields[f].field, was.fields[f].field);
    float most = 0;
    for (const float value : was.fields[f].values) most = std::max(most, std::abs(value));
    const float range = std::max(widest(was.fields[f].values), 0.01F * most);
    steps.push_back(was.fields[f].field->classes ? 0 : 8.5F * range / 4096);
  }
  for (size_t k = 0; k < is.id.size(); ++k) {
    const size_t i = rows.at(is.id[k]);
    QVERIFY(std::abs(is.position[k].x - was.position[i].x) <= place);
    QVERIFY(std::abs(is.position[k].y - was.position[i].y) <= place);
    QVERIFY(std::abs(is.position[k].z - was.position[i].z) <= place);
    QVERIFY(std::abs(is.position[k].w - was.position[i].w) <= radius / 256);
    QVERIFY(std::abs(is.temperature[k] - was.temperature[i]) <= warmth);
    QVERIFY(std::abs(is.speed[k] - was.speed[i]) <= halfRootStep(fastest, was.speed[i]));
    QVERIFY(std::abs(is.densityError[k] - was.densityError[i]) <= halfRootStep(1, was.densityError[i]));
    QVERIFY(std::abs(is.gasFraction[k] - was.gasFraction[i]) <= halfRootStep(1, was.gasFraction[i]));
    QVERIFY(is.phase[k] == was.phase[i] && is.motion[k] == was.motion[i]);
    for (size_t f = 0; f < steps.size(); ++f)
      QVERIFY(std::abs(is.fields[f].values[k] - was.fields[f].values[i]) <= steps[f]);
    QVERIFY(is.body[k] == was.body[i] && is.material[k] == was.material[i]);
  }
}

}  // namespace

class TestRunRecord : public QObject {
  Q_OBJECT
 private Q_SLOTS:
  void cleanup() { setThreadCount(0); }

  void smallFramesShowWhatWas_data() { samples(); }
  void smallFramesShowWhatWas();
  void anyFrameIsMadeAgain_data() { samples(); }
  void anyFrameIsMadeAgain();
  void savedAndOpenedItGoesOn_data() { samples(); }
  void savedAndOpenedItGoesOn();
  void whatComesTooFastIsLeftOutAndCounted();
  void aFrameIsFoundByItsTime();
  void goingBackKeepsTheRunAsItWas();
  void theThreadRecordsAndGoesOn_data() { samples(); }
  void theThreadRecordsAndGoesOn();

 private:
  static void samples() {
    QTest::addColumn<QString>("name");
    for (const char* name : {"dam-break", "river", "wet-cloth", "kettle-with-lid", "ice-on-hot-plate"})
      QTest::newRow(name) << name;
  }
  std::map<uint64_t, uint64_t> recordRun(const Project& project, RunRecord& record);
  PluginRegistry m_plugins;
};

/// With states at every eighth frame; returns the hash of each.
std::map<uint64_t, uint64_t> TestRunRecord::recordRun(const Project& project, RunRecord& record) {
  std::map<uint64_t, uint64_t> hashes;
  setThreadCount(2);
  Engine engine(project, m_plugins);
  record.begin(engine.revision());
  record.keepState(engine);
  for (;;) {
    const uint64_t frame = engine.solver().frame();
    for (RecordedEdit& edit : editsAfter(frame, project)) {
      make(engine, edit);
      record.add({frame, std::move(edit)});
    }
    record.add(engine.snapshot());
    hashes[frame] = engine.stateHash();
    if (frame == kFrames) break;
    engine.step();
    if (engine.solver().frame() % 8 == 0) record.keepState(engine);
    record.settle();
  }
  record.settle();
  return hashes;
}

/// To half of the steps that FramePacker names, whether a frame still leans on its key or on its neighbours.
void TestRunRecord::smallFramesShowWhatWas() {
  QFETCH(QString, name);
  Engine engine(open(name, m_plugins), m_plugins);
  engine.show({"density", "body"});
  const ByteCount count = std::make_shared<KeptBytes>();
  FramePacker packer(count);
  std::map<uint64_t, SnapshotPtr> seen;
  std::map<uint64_t, PackedFrame> kept;
  size_t leaning = 0, before = 0, after = 0;
  float fastest = 0;
  for (int frame = 0; frame < 20; ++frame) {
    const SnapshotPtr was = engine.snapshot();
    seen[was->stats.frame] = was;
    for (const float speed : was->speed) fastest = std::max(fastest, speed);
    FramePacker::Packed packed = packer.pack(*was);
    compare(*FrameUnpacker().snapshot(packed.frame, 9), *was, fastest);
    kept[frame] = std::move(packed.frame);
    for (PackedFrame& one : packed.anew) {
      QVERIFY(one.part->left && one.part->right);
      ++leaning;
      before += kept.at(one.stats.frame).part->data->size();
      after += one.part->data->size();
      kept[one.stats.frame] = std::move(one);
    }
    engine.step();
  }
  QCOMPARE(kept.size(), size_t{20});
  // Where particles come and go each frame stands by itself.
  QVERIFY(name == "river" || (leaning >= 8 && after < before));
  const FrameUnpacker unpacker;
  for (const auto& [number, frame] : kept) compare(*unpacker.snapshot(frame, 9), *seen.at(number), fastest);
  QVERIFY(count->memory > 0);
  kept.clear();
  packer = FramePacker(count);
  QCOMPARE(count->memory.load(), size_t{0});
}

void TestRunRecord::anyFrameIsMadeAgain() {
  QFETCH(QString, name);
  const Project project = open(name, m_plugins);
  RunRecord record(kPlenty);
  const std::map<uint64_t, uint64_t> hashes = recordRun(project, record);
  QCOMPARE(record.extent().frames, size_t{kFrames + 1});
  std::mt19937 random(5);
  for (const int threads : {1, 2}) {
    setThreadCount(threads);
    std::vector<uint64_t> frames{0, 14, kFrames};  // between the state of 8 and the edit that puts back
    for (int more = 0; more < 3; ++more) frames.push_back(random() % kFrames);
    for (const uint64_t frame : frames) {
      const std::optional<RestorePoint> point = record.restorePoint(frame);
      QVERIFY(point);
      QCOMPARE(point->from, frame - frame % 8);
      const std::unique_ptr<Engine> again = replayed(*point, m_plugins);
      QCOMPARE(again->solver().frame(), frame);
      QCOMPARE(again->stateHash(), hashes.at(frame));
    }
  }
}

/// Written, read back, gone on from any frame, by any number of threads.
void TestRunRecord::savedAndOpenedItGoesOn() {
  QFETCH(QString, name);
  const Project project = open(name, m_plugins);
  const QTemporaryDir folder;
  const std::string path = folder.filePath("run.psrec").toStdString();
  std::map<uint64_t, uint64_t> hashes;
  SnapshotPtr seen;
  {
    RunRecord record(kPlenty);
    hashes = recordRun(project, record);
    record.cutAfter(20, 99);  // what came after is an earlier run
    RecordingWriter writer(path, project);
    writer.add(record.content());
    writer.finish();
    seen = record.frame(13);
  }
  const RecordingReader reader(path, m_plugins);
  QCOMPARE(QString::fromStdString(reader.damage() + reader.whyNoStates()), QString());
  QVERIFY(sameScene(parseProject(reader.projectText(), "", m_plugins).project, project));
  QCOMPARE(reader.content().earlier.size(), size_t{1});
  QCOMPARE(reader.content().earlier.front().frames.size(), size_t{kFrames + 1});
  QCOMPARE(reader.content().runs, uint64_t{2});
  RunRecord record(kPlenty);
  record.adopt(reader.content(), 5);
  QCOMPARE(record.extent().last, uint64_t{20});
  const SnapshotPtr again = record.frame(13);
  QCOMPARE(again->revision, uint64_t{5});
  QVERIFY(again->id == seen->id && again->temperature == seen->temperature && again->speed == seen->speed);
  QCOMPARE(again->stats.thermalEnergy, seen->stats.thermalEnergy);
  QVERIFY(!seen->stats.measured == !again->stats.measured && seen->stats.probes.size() == again->stats.probes.size());
  std::mt19937 random(7);
  for (const int threads : {1, 3}) {
    setThreadCount(threads);
    for (const uint64_t frame : {uint64_t{6}, uint64_t{13}, uint64_t{random() % 20}}) {
      const std::optional<RestorePoint> point = record.restorePoint(frame);
      QVERIFY(point);
      // At 8 a body was out of the scene that came back at 14: that state is not of the file.
      QCOMPARE(point->from, frame / 16 * 16);
      const std::unique_ptr<Engine> engine = replayed(*point, m_plugins);
      QCOMPARE(engine->stateHash(), hashes.at(frame));
      if (frame < 14 && frame >= 5) continue;  // what comes back by its key is known to the log alone
      for (uint64_t next = frame + 1; next <= kFrames; ++next) {
        engine->step();
        for (const RecordedEdit& edit : editsAfter(next, project)) make(*engine, edit);
        QCOMPARE(engine->stateHash(), hashes.at(next));
      }
    }
  }
  QVERIFY(record.exchange(1));
  QCOMPARE(replayed(record.restorePoint(kFrames).value(), m_plugins)->stateHash(), hashes.at(kFrames));
}

void TestRunRecord::whatComesTooFastIsLeftOutAndCounted() {
  RunRecord record(kPlenty);
  record.begin(1);
  std::vector<SnapshotPtr> frames;
  for (uint64_t n = 0; n < 60; ++n) frames.push_back(tests::plainFrame(n, 20000));
  for (const SnapshotPtr& frame : frames) record.add(frame);
  record.settle();
  QVERIFY(record.cost().leftOut > 0);
  QCOMPARE(record.extent().frames + record.cost().leftOut, size_t{60});
  QCOMPARE(record.extent().last, uint64_t{59});
  QCOMPARE(record.extent().first, uint64_t{0});
}

void TestRunRecord::aFrameIsFoundByItsTime() {
  RunRecord record(kPlenty);
  QVERIFY(!record.frameAt(1));
  record.begin(1);
  for (const uint64_t n : {3, 4, 5, 9, 20}) {
    record.add(tests::plainFrame(n));
    record.settle();
  }
  const auto at = [&](double frame) { return record.frameAt(frame / 60).value(); };
  QCOMPARE(at(0), uint64_t{3});
  QCOMPARE(at(4.4), uint64_t{4});
  QCOMPARE(at(4.6), uint64_t{5});
  QCOMPARE(at(6.9), uint64_t{5});
  QCOMPARE(at(7.1), uint64_t{9});
  QCOMPARE(at(14.4), uint64_t{9});
  QCOMPARE(at(15), uint64_t{20});
  QCOMPARE(at(99), uint64_t{20});
  QCOMPARE(record.neighbour(5, 1).value(), uint64_t{9});
  QCOMPARE(record.neighbour(5, -2).value(), uint64_t{3});
  QVERIFY(!record.neighbour(20, 1) && !record.neighbour(3, -1));
  QVERIFY(record.frame(9) && !record.frame(10));
}

void TestRunRecord::goingBackKeepsTheRunAsItWas() {
  RunRecord record(kPlenty);
  record.begin(1);
  for (uint64_t n = 0; n < 10; ++n) {
    record.add(tests::plainFrame(n));
    record.settle();
    record.add(FrameEdit{n, std::vector{SetParameter{{Owner::Scene, "", "gravity"}, 1.0}}});
  }
  QVERIFY(record.documentEditedAfter(8) && !record.documentEditedAfter(9));
  record.cutAfter(6, 2);
  QCOMPARE(record.extent().last, uint64_t{6});
  QVERIFY(!record.documentEditedAfter(6));
  QCOMPARE(record.frame(2)->revision, uint64_t{2});  // one run, whatever came between
  record.add(tests::plainFrame(7));                  // of the run before
  record.settle();
  QCOMPARE(record.extent().last, uint64_t{6});
  QCOMPARE(record.earlier().size(), size_t{1});
  QCOMPARE(record.earlier().front().number, uint64_t{1});
  QCOMPARE(record.earlier().front().apart, 6.0 / 60);
  QCOMPARE(record.earlier().front().to, 9.0 / 60);
  QCOMPARE(record.present(), uint64_t{2});
  QVERIFY(!record.exchange(7));
  QVERIFY(record.exchange(1));
  QCOMPARE(record.extent().last, uint64_t{9});
  QVERIFY(record.documentEditedAfter(8));
  QCOMPARE(record.earlier().front().number, uint64_t{2});
  record.forgetRun(2);
  QVERIFY(record.earlier().empty());
  record.cutAfter(9, 2);  // nothing came after
  QVERIFY(record.earlier().empty());
  record.begin(3);
  QCOMPARE(record.extent().frames, size_t{0});
}

void TestRunRecord::theThreadRecordsAndGoesOn() {
  EngineThread engine(m_plugins, nullptr);
  const Address gravity{Owner::Scene, "", "gravity"};
  std::map<uint64_t, uint64_t> hashes;
  const auto hash = [&] { return tests::onEngine<uint64_t>(engine, [](Engine& e) { return e.stateHash(); }); };
  const auto step = [&] {
    engine.stepOnce();
    const uint64_t value = hash();
    hashes[engine.snapshot()->stats.frame] = value;
  };
  QFETCH(QString, name);
  engine.open(open(name, m_plugins), false);
  for (int frame = 0; frame < 10; ++frame) step();
  setThreadCount(1);  // whatever it was recorded with
  engine.continueFrom(4, false);
  QCOMPARE(hash(), hashes[4]);
  QCOMPARE(engine.snapshot()->stats.frame, uint64_t{4});
  QCOMPARE(engine.history(0).back().frame, uint64_t{4});
  QCOMPARE(engine.history(0).size(), size_t{5});
  engine.recording().settle();
  QCOMPARE(engine.recording().extent().last, uint64_t{4});
  QCOMPARE(engine.recording().cost().states, size_t{2});
  const std::map<uint64_t, uint64_t> first = hashes;
  for (int frame = 0; frame < 6; ++frame) step();
  QVERIFY(hashes == first);  // nothing else happened: the same run

  // What was edited after the frame stays in force.
  engine.setParameter(gravity, 3.0);
  const auto strength = [](Engine& e) { return e.project().environment.gravity.norm(); };
  step();
  QCOMPARE(tests::onEngine<double>(engine, strength), 3.0);
  QVERIFY(engine.recording().documentEditedAfter(7));
  const std::unique_ptr<Engine> again = replayed(engine.recording().restorePoint(7).value(), m_plugins);
  QCOMPARE(again->stateHash(), hashes[7]);
  again->update(tests::onEngine<Project>(engine, [](Engine& e) { return e.document(); }));
  engine.continueFrom(7, false);
  QCOMPARE(tests::onEngine<double>(engine, strength), 3.0);
  QCOMPARE(hash(), again->stateHash());
  step();
  QVERIFY(hashes[8] != first.at(8));

  // A reset begins another record.
  const uint64_t now = hash();
  engine.reset();
  QVERIFY(hash() != now);
  engine.recording().settle();
  QCOMPARE(engine.recording().extent().frames, size_t{1});
}

QTEST_GUILESS_MAIN(TestRunRecord)
#include "tst_runrecord.moc"
