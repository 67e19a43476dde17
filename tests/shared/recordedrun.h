// SPDX-License-Identifier: Apache-2.0
#pragma once
// Runs with edits that are recorded frame by frame, and read back from a file.
#include "core/io/recording.h"
#include "core/simulation/engine.h"
#include "core/simulation/runrecord.h"
#include "core/solver/solver.h"

#include <QTemporaryDir>
#include <QTest>

#include <map>

namespace recordedrun {

/// Frames 0 to `last`, with the commands that `after(frame)` gives and a state in every fourth. Returns what the engine
/// hashed to in each.
template <class After>
std::map<uint64_t, uint64_t> recordInto(ps::RunRecord& record, const ps::Project& project, ps::PluginRegistry& plugins,
                                        uint64_t last, After&& after) {
  ps::Engine engine(project, plugins);
  record.begin(engine.revision());
  record.keepState(engine);
  std::map<uint64_t, uint64_t> hashes;
  for (uint64_t frame = 0; frame <= last; ++frame) {
    for (const ps::Command& command : after(frame)) {
      engine.apply(command);
      record.add({frame, command});
    }
    record.add(engine.snapshot());
    hashes[frame] = engine.stateHash();
    engine.step();
    if (engine.solver().frame() % 4 == 0) record.keepState(engine);
    record.settle();
  }
  return hashes;
}

/// Into a file and from there into another record; fails the test where something of it is lost.
inline void throughFile(const ps::RunRecord& record, const ps::Project& project, ps::PluginRegistry& plugins,
                        ps::RunRecord& again) {
  const QTemporaryDir folder;
  const std::string path = folder.filePath("run.psrec").toStdString();
  ps::RecordingWriter writer(path, project);
  writer.add(record.content());
  writer.finish();
  const ps::RecordingReader reader(path, plugins);
  QCOMPARE(QString::fromStdString(reader.damage() + reader.whyNoStates()), QString());
  again.adopt(reader.content(), 3);
}

}  // namespace recordedrun
