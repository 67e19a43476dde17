// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/outputfile.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

// A recording is a run as it was seen: the project, then every frame's snapshot arrays. File, little-endian:
//   "PSRECORD", u32 length, header JSON {"format": "phasesketch-recording", "version": 4, "project": {...}},
//   u64 FNV-1a of the header
//   per frame: "PSFRAME.", u64 packed bytes, u64 bytes, u64 FNV-1a of the packed bytes, zstd data
// Behind the arrays that every snapshot has, a frame holds the fields that this one was asked for, each with its name,
// label, unit and scale, so that it is shown where its plugin is not installed.
// A frame's arrays are cut into byte planes first (all lowest bytes, all second ones, ...), which packs floats better.
// Frames follow each other, so that a recording that was cut off is good up to there. Whatever else changes, the header
// stays where it is, so that every version can say of a file which one made it.
namespace ps {

inline constexpr int kRecordingVersion = 4;

class RecordingWriter {
 public:
  /// Throws Error when the file cannot be made.
  RecordingWriter(const std::string& path, const Project& project);
  /// Throws Error when the disk is full.
  void add(const Snapshot& snapshot);
  /// Flushes, and gives the file its name: see OutputFile.
  void finish();
  /// Of a run that failed: leaves the frames until now in a file of their own and says which, see OutputFile.
  std::string keepPart() { return m_file.keepPart(); }
  size_t frameCount() const { return m_frames; }

 private:
  OutputFile m_file;
  size_t m_frames = 0;
};

class RecordingReader {
 public:
  /// Reads the header and where the frames are. Throws InputError "path: what is wrong; what to do": no recording, a
  /// newer or older version, a header that is not what was written.
  explicit RecordingReader(const std::string& path);
  /// The project as JSON text, for parseProject().
  const std::string& projectText() const { return m_project; }
  size_t frameCount() const { return m_frames.size(); }
  /// "" or where the frames end too early: "path: is cut off or damaged after frame 17".
  const std::string& damage() const { return m_damage; }
  /// Throws InputError when the frame's bytes are not what was written.
  SnapshotPtr frame(size_t index);

 private:
  struct Block {
    uint64_t offset, packed, size, checksum;
  };
  void readHeader();
  void findFrames();

  std::string m_path, m_project, m_damage;
  std::ifstream m_file;
  uint64_t m_bytes = 0;
  std::vector<Block> m_frames;
};

/// Whether a file begins like a recording; false for whatever cannot be read.
bool isRecording(const std::string& path);

}  // namespace ps
