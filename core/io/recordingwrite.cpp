// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/jsontext.h"
#include "core/base/progress.h"
#include "core/base/statestream.h"
#include "core/io/outputfile.h"
#include "core/io/projectfields.h"
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/io/recordingblocks.h"
#include "core/io/runlog.h"
#include "core/simulation/engine.h"
#include "core/simulation/namedmatter.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace ps {
namespace {

using nlohmann::json;
using namespace recording;

constexpr int kLevel = 3;                     // zstd, of what is no frame and no state
constexpr size_t kEditsTogether = 200;        // in a block: few enough that any reader takes their JSON
constexpr size_t kCellsTogether = 1'000'000;  // likewise

template <class T>
std::string_view bytesOf(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string textOf(const Project& project) {
  Project scene = project;
  scene.state = nullptr;  // the recording says where matter stands
  return writeProject(scene);
}

std::string bytesOf(const MatterIds& named) {
  BytePacker packer;
  packer.value(static_cast<uint64_t>(named.size()));
  for (const auto& [key, ids] : named) {
    packer.value(uint64_t{key});
    packer.value(static_cast<uint64_t>(ids.size()));
    packer.array(ids, ids.size());
  }
  return packer.bytes();
}

/// Matter that is out of the scene is in no state: one that an edit brings back later is made from a state before it.
bool canBeGoneOnFrom(const KeptRun& run, const KeptRun::State& state) {
  if (!state.names->hands().empty()) return false;
  const std::vector<MatterKey> outside = state.names->outside();
  const std::set<MatterKey> keys(outside.begin(), outside.end());
  const auto first = run.edits.begin() + static_cast<std::ptrdiff_t>(std::min(state.edits, run.edits.size()));
  return keys.empty() ||
         std::none_of(first, run.edits.end(), [&](const FrameEdit& edit) { return keys.contains(keyOf(edit.edit)); });
}

}  // namespace

struct RecordingWriter::Impl {
  explicit Impl(const std::string& path) : file(path) {}
  uint32_t block(Kind kind, const std::string& head, const PackedBytes* packed);
  uint32_t block(Kind kind, const std::string& head, const std::string& packed, uint64_t raw, uint64_t checksum);
  uint32_t block(Kind kind, const std::string& raw);
  uint32_t once(Kind kind, const std::string& raw);
  uint32_t part(const std::shared_ptr<const FramePart>& part);
  void add(const PackedFrame& frame);
  void addHeld();
  void add(const KeptRun::State& state);
  void addEdits(const std::vector<FrameEdit>& edits);
  void addRun(const KeptRun& run);
  uint32_t document(const std::shared_ptr<const Project>& project);

  OutputFile file;
  FramePacker packer{std::make_shared<KeptBytes>()};
  std::map<uint64_t, PackedFrame> held;     ///< until nothing about them changes any more
  std::optional<uint64_t> lastFrame;        ///< number of a frame
  std::shared_ptr<const FrameKey> lastKey;  ///< that of the last frame
  uint32_t blocks = 0;
  std::map<std::pair<Kind, std::string>, uint32_t> texts;  ///< of what is written once
  std::map<std::shared_ptr<const void>, uint32_t> known;   ///< what is packed, documents, probes
  std::map<std::shared_ptr<const FramePart>, uint32_t> frames;
};

RecordingWriter::RecordingWriter(const std::string& path, const Project& project) : m(std::make_unique<Impl>(path)) {
  const json header{
      {"format", "phasesketch-recording"}, {"version", kRecordingVersion}, {"project", json::parse(textOf(project))}};
  const std::string text = header.dump();
  if (text.size() > kMaximumHeader) {
    throw InputError(path + ": the project takes " + std::to_string(text.size() >> 20) +
                     " MiB, and a recording holds one of at most " + std::to_string(kMaximumHeader >> 20) +
                     "; make its meshes coarser");
  }
  const auto length = static_cast<uint32_t>(text.size());
  m->file.write({kFileMark, kMark});
  m->file.write(bytesOf(length));
  m->file.write(text);
  m->file.write(bytesOf(hashOf(text)));
}
RecordingWriter::~RecordingWriter() = default;

uint32_t RecordingWriter::Impl::block(Kind kind, const std::string& head, const std::string& packed, uint64_t raw,
                                      uint64_t checksum) {
  BlockHead block;
  std::copy_n(kBlockMark, kMark, block.mark);
  block.kind = static_cast<uint32_t>(kind);
  block.headBytes = static_cast<uint32_t>(head.size());
  block.packed = packed.size();
  block.raw = raw;
  block.packedSum = checksum;
  block.headSum = headSumOf(block, head);
  file.write(bytesOf(block));
  file.write(head);
  file.write(packed);
  return blocks++;
}

uint32_t RecordingWriter::Impl::block(Kind kind, const std::string& head, const PackedBytes* packed) {
  if (!packed) return block(kind, head, {}, 0, hashOf({}));
  return block(kind, head, packed->packed(), packed->rawSize(), packed->checksum());
}

uint32_t RecordingWriter::Impl::block(Kind kind, const std::string& raw) {
  const std::string packed = squeezed(raw, kLevel);
  return block(kind, {}, packed, raw.size(), hashOf(packed));
}

uint32_t RecordingWriter::Impl::once(Kind kind, const std::string& raw) {
  const std::pair key{kind, raw};
  if (!texts.contains(key)) texts[key] = block(kind, raw);
  return texts.at(key);
}

/// Documents that are one are written once; of those that are equal, each time they come as another.
uint32_t RecordingWriter::Impl::document(const std::shared_ptr<const Project>& project) {
  if (!known.contains(project)) known[project] = once(Kind::Document, textOf(*project));
  return known.at(project);
}

/// What it leans on comes first.
uint32_t RecordingWriter::Impl::part(const std::shared_ptr<const FramePart>& part) {
  if (!part) return kNone;
  if (const auto found = known.find(part); found != known.end()) return found->second;
  PartHead head;
  if (!known.contains(part->key)) known[part->key] = block(Kind::Key, headOf(*part->key), part->key->data.get());
  head.key = known.at(part->key);
  head.left = this->part(part->left);
  head.right = this->part(part->right);
  return known[part] = block(Kind::Part, headOf(head), part->data.get());
}

void RecordingWriter::Impl::add(const PackedFrame& frame) {
  FrameParts parts;
  parts.part = part(frame.part);
  if (frame.stats.measured) {
    if (!known.contains(frame.stats.measured)) {
      json list = json::array();
      for (const Probe& probe : *frame.stats.measured) list.push_back(fields::probeFields().write(probe));
      known[frame.stats.measured] = once(Kind::Probes, list.dump());
    }
    parts.probes = known.at(frame.stats.measured);
  }
  frames[frame.part] = block(Kind::Frame, headOf(frame, parts), nullptr);
}

void RecordingWriter::Impl::add(const KeptRun::State& state) {
  StateHead head{state.frame, state.edits, document(state.document), kNone};
  if (const MatterIds named = state.names->present(); !named.empty()) head.names = once(Kind::Names, bytesOf(named));
  known[state.stream] = block(Kind::State, headOf(head), state.stream.get());
}

void RecordingWriter::Impl::addEdits(const std::vector<FrameEdit>& edits) {
  for (size_t first = 0, last = 0; first < edits.size(); first = last) {
    for (size_t cells = 0; last < edits.size() && last < first + kEditsTogether && cells < kCellsTogether; ++last)
      cells += cellsOf(edits[last]);
    const json list = logOf(edits.data() + first, edits.data() + last,
                            [this](const std::shared_ptr<const Project>& project) { return document(project); });
    block(Kind::Edits, list.dump());
  }
}

/// States stand before what was seen after them.
void RecordingWriter::Impl::addRun(const KeptRun& run) {
  RunHead head{run.number, run.apart, run.name, {}};
  const auto isShared = [&](const auto& among, const auto& packed) {
    const auto found = among.find(packed);
    if (found != among.end()) head.shared.push_back(found->second);
  };
  for (const KeptRun::State& state : run.states) {
    if (canBeGoneOnFrom(run, state)) isShared(known, state.stream);
  }
  for (const auto& [number, frame] : run.frames) isShared(frames, frame->part);
  std::sort(head.shared.begin(), head.shared.end());
  block(Kind::Run, headOf(head), nullptr);
  addEdits(run.edits);
  auto state = run.states.begin();
  const auto addStates = [&](uint64_t until) {
    for (; state != run.states.end() && state->frame <= until; ++state) {
      if (!known.contains(state->stream) && canBeGoneOnFrom(run, *state)) add(*state);
      advance(1);
    }
  };
  for (const auto& [number, frame] : run.frames) {
    addStates(number);
    if (!frames.contains(frame->part)) add(*frame);
    advance(1);
  }
  addStates(UINT64_MAX);
}

void RecordingWriter::add(const Snapshot& snapshot) {
  if (m->blocks == 0) m->block(Kind::Run, headOf(RunHead{}), nullptr);
  if (m->lastFrame && snapshot.stats.frame <= *m->lastFrame) return;  // a frame that was taken back
  m->lastFrame = snapshot.stats.frame;
  FramePacker::Packed packed = m->packer.pack(snapshot);
  for (PackedFrame& frame : packed.anew) m->held.insert_or_assign(frame.stats.frame, std::move(frame));
  if (const auto& key = packed.frame.part->key; key != m->lastKey) {
    m->addHeld();
    m->lastKey = key;
    m->known.clear();  // nothing that is over is kept
    m->frames.clear();
  }
  m->held.insert_or_assign(snapshot.stats.frame, std::move(packed.frame));
  if (!m->packer.open()) m->addHeld();
}

void RecordingWriter::Impl::addHeld() {
  for (; !held.empty(); held.erase(held.begin())) add(held.begin()->second);
  file.flush();
}

void RecordingWriter::add(const Engine& engine) {
  if (m->blocks == 0) m->block(Kind::Run, headOf(RunHead{}), nullptr);
  StateBuffer stream;
  saveTo(stream, engine);
  const KeptRun::State state{engine.solver().frame(), 0, std::make_shared<const Project>(engine.document()),
                             engine.names(), packedState(stream.bytes(), std::make_shared<KeptBytes>())};
  m->add(state);
  m->known.erase(state.document);
  m->known.erase(state.stream);
}

void RecordingWriter::add(const RunContent& content) {
  const auto steps = [](const KeptRun& run) { return static_cast<double>(run.frames.size() + run.states.size()); };
  double whole = steps(content.present);
  for (const KeptRun& run : content.earlier) whole += steps(run);
  if (t_progress) t_progress->expect(1);
  beginStage("Saving the recording", 1, whole);
  m->addRun(content.present);
  for (const KeptRun& run : content.earlier) m->addRun(run);
}

void RecordingWriter::finish() {
  m->addHeld();
  m->file.finish();
}

std::string RecordingWriter::keepPart() {
  try {
    m->addHeld();
  } catch (const Error&) {
    // The disk is full still: what was written stays.
  }
  return m->file.keepPart();
}

}  // namespace ps
