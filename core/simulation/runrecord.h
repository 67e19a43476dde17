// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/statestream.h"
#include "core/simulation/command.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

// A run as it goes, in memory: small frames to look at, whole states now and then to go on from, and between them the
// edits with their frames, which bring a state to any frame after it, to the bit. Why a thread of its own: packing a
// frame takes as long as a part of its step. Who runs hands over what is there anyway, and never waits; what the thread
// does not get to is left out and counted. Why nothing is left out of the edits: without one of them no later frame
// could be made again.
namespace ps {

class Engine;
class NamedMatter;
class PackedBytes;
class PluginRegistry;
struct KeptBytes;
struct RunContent;

/// What an engine took: values that were set together, or a command.
using RecordedEdit = std::variant<std::vector<SetParameter>, Command>;
struct FrameEdit {
  uint64_t frame = 0;  ///< after which it acted
  RecordedEdit edit;
};
/// That it names: mostly what is large in it.
size_t cellsOf(const FrameEdit& edit);

/// What the document of a run was: at its first state, and the edits of it since.
struct RunEdits {
  std::shared_ptr<const Project> document;  ///< nullptr: nothing is kept yet
  std::vector<FrameEdit> edits;
};

/// All that is needed to make a frame again.
struct RestorePoint {
  uint64_t from = 0, frame = 0;             ///< number of the state's frame, and of the one that is asked for
  std::shared_ptr<const Project> document;  ///< at the state
  std::shared_ptr<const NamedMatter> names;
  std::shared_ptr<const PackedBytes> stream;  ///< what Engine::save() wrote, as packedState() packs it
  std::vector<FrameEdit> edits;  ///< since, up to and with those that acted after the frame that is asked for
};

/// All that an engine goes on from, packed.
std::shared_ptr<const PackedBytes> packedState(std::span<const std::byte> stream, std::shared_ptr<KeptBytes> count);
/// An engine at the frame of a point. Progress advances with its frames; throws Cancelled, and Error where a frame
/// fails.
std::unique_ptr<Engine> replayed(const RestorePoint& point, PluginRegistry& plugins);

/// What a record may take, in bytes. What is on the disk lies in a file without a name, which goes with the program.
struct RecordBudget {
  size_t memory = 0, disk = 0;
  std::string folder{};  ///< of that file; made where there is none
};

class RunRecord {
 public:
  /// What is kept stays below the budget, but for the newest frame. When the memory is full, what is oldest goes to the
  /// disk, states first. When that is full, every second one of the older half of the frames goes, one by one, then
  /// every second one of the rest; of the states those that stand closest. Earlier runs go before that, the oldest
  /// first.
  explicit RunRecord(RecordBudget budget);
  explicit RunRecord(size_t memory) : RunRecord(RecordBudget{memory}) {}
  ~RunRecord();

  /// A quarter of the memory that the machine has for this program now; at least 64 MiB, at most 16 GiB.
  static size_t usualBudget();

  /// From now on; another folder counts from the next file on.
  void setBudget(RecordBudget budget);

  /// Frames and states on the disk go, but for the first of each and the newest frame of each run; soon, not at once.
  void forgetDisk();

  // By who runs. None of these waits for packing.

  /// Another run: what was kept is forgotten. Snapshots of other revisions are not taken.
  void begin(uint64_t revision);
  uint64_t revision() const;
  uint64_t begun() const;  ///< how often what was kept has been forgotten for another run
  /// Frames ascend; the number of the last one again replaces it.
  void add(SnapshotPtr snapshot);
  void add(FrameEdit edit);
  /// Whether a state is due: two simulated seconds after the last one, as long as keeping them takes no more than a
  /// fiftieth of the time.
  bool wantsState(double time) const;
  /// Of an engine as it stands, after the edits that were added.
  void keepState(const Engine& engine);
  /// The run went back to a frame and goes on from there under another revision. As it was, it is kept as an earlier
  /// run, if anything came after.
  void cutAfter(uint64_t frame, uint64_t revision);
  /// An earlier run is the present one, and that an earlier one. False: it is not kept.
  bool exchange(uint64_t number);
  /// What was kept of a run elsewhere is that of this one, which goes on from its last frame; what was kept here is
  /// forgotten.
  void adopt(RunContent content, uint64_t revision);
  /// Parameters, tracks or the project as a whole; what became of matter alone does not count.
  bool documentEditedAfter(uint64_t frame) const;

  // By anybody.

  struct Extent {
    uint64_t first = 0, last = 0;  ///< numbers of frames
    double from = 0, to = 0;       ///< s
    size_t frames = 0;             ///< that are kept; 0: there are none
  };
  Extent extent() const;
  /// The kept frame next to a time, or so many kept frames before or after another; nothing where there is none.
  std::optional<uint64_t> frameAt(double time) const;
  std::optional<uint64_t> neighbour(uint64_t frame, int steps) const;
  /// Unpacks one that is kept; nullptr where it is not.
  SnapshotPtr frame(uint64_t number) const;
  /// Whether one that is kept has values of a field, ParticleField::name; nothing is unpacked for that.
  bool keepsField(uint64_t frame, std::string_view name) const;
  /// How a frame can be made again, from the nearest state; nothing where no state before it is kept.
  std::optional<RestorePoint> restorePoint(uint64_t frame) const;
  struct EarlierRun {
    uint64_t number = 0;       ///< runs count from 1
    std::string name;          ///< "": nobody gave it one
    double apart = 0, to = 0;  ///< s: where it left the present run, and its end
  };
  std::vector<EarlierRun> earlier() const;  ///< the oldest first
  uint64_t present() const;                 ///< number of the present run
  void forgetRun(uint64_t number);          ///< an earlier one
  void rename(uint64_t number, const std::string& name);
  /// Of an earlier run the kept frame next to a time, unpacked; nullptr where it has none then that the present run has
  /// not too: before they part, after its end, or when it is not kept.
  SnapshotPtr earlierFrame(uint64_t run, double time) const;
  /// Of the frames that are kept.
  std::vector<FrameStats> stats() const;
  /// The same of an earlier run; none where it is not kept.
  std::vector<FrameStats> stats(uint64_t run) const;
  /// Of the present run, or of an earlier one.
  RunEdits documentEdits(std::optional<uint64_t> run = std::nullopt) const;
  /// All that is kept. It shares the packed bytes, which go when the last who has them lets go.
  RunContent content() const;
  /// Waits until all that was handed over until now is packed.
  void settle() const;

  struct Cost {
    size_t bytes = 0, disk = 0, states = 0;  ///< bytes in memory and on the disk
    uint64_t leftOut = 0;                    ///< frames that came faster than they were packed, in this run
    double stateSeconds = 0, packSeconds = 0;
  };
  Cost cost() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

}  // namespace ps
