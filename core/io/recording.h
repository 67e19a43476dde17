// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/keptrun.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// A recording is a run as it was seen and may go on: the project, small frames to look at, whole states now and then,
// and the log of what was edited between them. File, little-endian:
//   "PSRECORD", u32 length, header JSON {"format": "phasesketch-recording", "version": 6, "project": {...}},
//   u64 hash of the header
//   blocks: BlockHead of recordingblocks.h, its head, and bytes by zstd
// A run's blocks follow the one that begins it, the present run's first; they name others by their number in the file,
// which always come before them. So a recording that was cut off is good up to there. A field of particles stands in
// each key with its label, unit and scale, so that it is shown where its plugin is not installed. What is packed is
// checked when it is used: a file of any length opens at once and takes little memory.
// Whatever else changes, the header stays where it is, so that every version can say of a file which one made it.
namespace ps {

class Engine;
class FrameUnpacker;
class PluginRegistry;

inline constexpr int kRecordingVersion = 6;
/// What stands behind the name of a project in that of its recording.
inline constexpr const char* kRecordingEnding = ".psrec";

class RecordingWriter {
 public:
  /// Throws Error when the file cannot be made.
  RecordingWriter(const std::string& path, const Project& project);
  ~RecordingWriter();
  // Each throws Error when the disk is full, and Cancelled.

  /// A frame of a run that goes on.
  void add(const Snapshot& snapshot);
  /// A state of it, to go on from.
  void add(const Engine& engine);
  /// All of a record, instead of those.
  void add(const RunContent& content);
  /// Flushes, and gives the file its name: see OutputFile.
  void finish();
  /// Of a run that failed: leaves the frames until now in a file of their own and says which, see OutputFile.
  std::string keepPart();

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

class RecordingReader {
 public:
  /// Reads the header and where everything is. Throws InputError "path: what is wrong; what to do": no recording, a
  /// newer or older version, a header that is not what was written. Advances the thread's progress.
  RecordingReader(const std::string& path, const PluginRegistry& plugins);
  ~RecordingReader();
  /// The project as JSON text, for parseProject().
  const std::string& projectText() const { return m_project; }
  /// "" or where it ends too early: "path: is cut off or damaged after frame 17".
  const std::string& damage() const { return m_damage; }
  /// "" or why no frame can be gone on from: "path: what".
  const std::string& whyNoStates() const { return m_noStates; }
  const RunContent& content() const { return m_content; }
  size_t frameCount() const { return m_content.present.frames.size(); }
  /// Of the present run, in order. Throws InputError when the frame's bytes are not what was written.
  SnapshotPtr frame(size_t index) const;

 private:
  std::string m_path, m_project, m_damage, m_noStates;
  RunContent m_content;
  std::vector<std::shared_ptr<const PackedFrame>> m_frames;
  std::unique_ptr<FrameUnpacker> m_unpacker;
};

/// Whether a file begins like a recording; false for whatever cannot be read.
bool isRecording(const std::string& path);
/// Whether a run of one project is one of the other: all is equal but what people look at.
bool sameScene(const Project& a, const Project& b);

}  // namespace ps
