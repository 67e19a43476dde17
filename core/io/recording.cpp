// SPDX-License-Identifier: Apache-2.0
#include "core/io/recording.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/base/progress.h"
#include "core/base/storedfile.h"
#include "core/io/filestamp.h"
#include "core/io/projectfields.h"
#include "core/io/projectio.h"
#include "core/io/recordingblocks.h"
#include "core/io/runlog.h"
#include "core/io/schema.h"
#include "core/simulation/namedmatter.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

namespace ps {
namespace {

using nlohmann::json;
using namespace recording;

constexpr uint64_t kMaximumHead = uint64_t{16} << 20, kMaximumFrame = uint64_t{1} << 30;
constexpr uint64_t kMaximumState = uint64_t{16} << 30, kMaximumText = uint64_t{256} << 20;
constexpr size_t kMaximumRuns = 1000;

/// The project's text; `at` is then behind the header.
std::string readHeader(const StoredFile& file, const std::string& path, uint64_t& at) {
  const InputError damaged(path +
                           ": its header is damaged or cut off; take another copy, or simulate the project again");
  if (file.size() < kMark || file.read(0, kMark) != std::string(kFileMark, kMark))
    throw InputError(path + ": is no recording; simulate --record makes one");
  uint32_t length = 0;
  at = kMark + sizeof length;
  if (file.size() < at) throw damaged;
  std::memcpy(&length, file.read(kMark, sizeof length).data(), sizeof length);
  if (length > kMaximumHeader || length > file.size() - at) throw damaged;
  const std::string text = file.read(at, length);
  at += length;
  uint64_t checksum = 0;
  // Formats up to 3 have no checksum: their first frame stands here, or their end.
  const bool sealed = file.size() - at >= sizeof checksum && file.read(at, sizeof checksum) != "PSFRAME.";
  if (sealed) std::memcpy(&checksum, file.read(at, sizeof checksum).data(), sizeof checksum);
  at += sizeof checksum;
  if (sealed && checksum != hashOf(text)) throw damaged;
  json header;
  try {
    header = parseJson(text, path);
  } catch (const InputError&) {
    throw damaged;
  }
  const auto version = header.find("version");
  if (!header.is_object() || header.value("format", json()) != "phasesketch-recording" || version == header.end() ||
      !version->is_number_integer() || !header.contains("project")) {
    throw InputError(path + ": its header is no recording's; simulate --record makes one");
  }
  if (version->get<double>() > kRecordingVersion) {
    throw InputError(path + ": was made by a newer version (recording format " + version->dump() +
                     "); update PhaseSketch");
  }
  if (version->get<double>() < kRecordingVersion) {
    throw InputError(path + ": was made by an older version (recording format " + version->dump() +
                     "); simulate its project again");
  }
  if (!sealed) throw damaged;
  return header["project"].dump();
}

MatterIds namesIn(const std::string& bytes, const std::string& where) {
  ByteUnpacker unpacker(bytes, where);
  MatterIds named;
  for (auto count = unpacker.value<uint64_t>(); count > 0; --count) {
    const auto key = unpacker.value<uint64_t>();
    unpacker.array(named[keyHere(key)], unpacker.value<uint64_t>());
  }
  unpacker.finish();
  return named;
}

uint64_t mostOf(Kind kind) {
  if (kind == Kind::Run) return 0;
  if (kind == Kind::State) return kMaximumState;
  if (kind == Kind::Frame) return 0;
  return kind == Kind::Key || kind == Kind::Part ? kMaximumFrame : kMaximumText;
}

/// Reads block by block, and puts together what they are.
class Blocks {
 public:
  Blocks(const std::string& path, const PluginRegistry& plugins)
      : m_path(path), m_plugins(plugins), m_file(std::make_shared<const StoredFile>(path)) {}

  std::string header() { return readHeader(*m_file, m_path, m_at); }
  /// Returns "" or where it ends too early.
  std::string readAll() {
    const uint64_t size = m_file->size();
    if (t_progress) t_progress->expect(1);
    beginStage("Opening the recording", 1, static_cast<double>(size));
    while (m_at < size) {
      const uint64_t before = m_at;
      try {
        if (!readBlock()) throw InputError("");
      } catch (const InputError&) {
        return m_path + ": is cut off or damaged after frame " + std::to_string(content.present.frames.size());
      }
      ++m_number;
      advance(m_at - before);
    }
    return {};
  }
  const std::string& whyNoStates() const { return m_noStates; }

  RunContent content;

 private:
  bool readBlock();
  void take(Kind kind, const std::string& head, const PackedBytes::Place& place);
  void beginRun(const std::string& head);
  void takePart(const std::string& head, std::shared_ptr<const PackedBytes> data);
  void takeFrame(const std::string& head);
  void takeState(const std::string& head, std::shared_ptr<const PackedBytes> data);
  void add(const std::shared_ptr<const PackedFrame>& frame);
  void add(const KeptRun::State& state);
  void takeText(Kind kind, const PackedBytes& text);
  KeptRun& run() {
    if (m_runs == 0) throw InputError(m_where + "it is of no run");
    return m_runs == 1 ? content.present : content.earlier.back();
  }
  template <class T>
  std::shared_ptr<const T> known(const std::map<uint32_t, std::shared_ptr<const T>>& all, uint32_t number) const {
    const auto found = all.find(number);
    if (found == all.end()) throw InputError(m_where + "it needs block " + std::to_string(number));
    return found->second;
  }

  std::string m_path, m_where, m_noStates;
  const PluginRegistry& m_plugins;
  std::shared_ptr<const StoredFile> m_file;
  uint64_t m_at = 0;
  uint32_t m_number = 0;
  size_t m_runs = 0;
  std::map<uint32_t, std::shared_ptr<const FrameKey>> m_keys;
  std::map<uint32_t, std::shared_ptr<const FramePart>> m_parts;
  std::map<uint32_t, std::shared_ptr<const PackedFrame>> m_frames;
  std::map<uint32_t, std::shared_ptr<const KeptRun::State>> m_states;
  std::map<uint32_t, std::shared_ptr<const std::vector<Probe>>> m_probes;
  std::map<uint32_t, std::shared_ptr<const NamedMatter>> m_names;
  Documents m_documents;
};

bool Blocks::readBlock() {
  BlockHead block;
  const uint64_t left = m_file->size() - m_at;
  if (left < sizeof block) return false;
  std::memcpy(&block, m_file->read(m_at, sizeof block).data(), sizeof block);
  if (std::memcmp(block.mark, kBlockMark, kMark) != 0 || block.headBytes > kMaximumHead) return false;
  if (block.headBytes > left - sizeof block || block.packed > left - sizeof block - block.headBytes) return false;
  const std::string head = m_file->read(m_at + sizeof block, block.headBytes);
  const auto kind = static_cast<Kind>(block.kind);
  if (headSumOf(block, head) != block.headSum || block.raw > mostOf(kind)) return false;
  const uint64_t at = m_at + sizeof block + block.headBytes;
  m_where = m_path + ": block " + std::to_string(m_number) + ": ";
  take(kind, head, {m_file, at, block.packed, block.raw, block.packedSum});
  m_at = at + block.packed;
  return true;
}

/// What says how to go on may be of plugins that are not here: the frames can be looked at all the same.
void Blocks::take(Kind kind, const std::string& head, const PackedBytes::Place& place) {
  auto data = std::make_shared<const PackedBytes>(place);
  if (kind == Kind::Run) {
    beginRun(head);
  } else if (kind == Kind::Key) {
    auto key = std::make_shared<FrameKey>(readKey(head, m_where));
    key->data = std::move(data);
    m_keys[m_number] = std::move(key);
  } else if (kind == Kind::Frame) {
    takeFrame(head);
  } else if (kind == Kind::Part) {
    takePart(head, std::move(data));
  } else if (m_noStates.empty()) {
    try {
      if (kind == Kind::State)
        takeState(head, std::move(data));
      else
        takeText(kind, *data);
    } catch (const InputError& problem) {
      const std::string what = problem.what();
      m_noStates = what.starts_with(m_path) ? what : m_where + what;
    }
  }
}

void Blocks::beginRun(const std::string& head) {
  const RunHead begun = readRun(head, m_where);
  if (m_runs == kMaximumRuns) throw InputError(m_where + "there are too many runs");
  if (++m_runs > 1) content.earlier.emplace_back();
  run().number = begun.number;
  run().apart = begun.apart;
  run().name = begun.name;
  content.runs = std::max(content.runs, begun.number);
  for (const uint32_t number : begun.shared) {
    if (const auto state = m_states.find(number); state != m_states.end()) add(*state->second);
    if (const auto frame = m_frames.find(number); frame != m_frames.end()) add(frame->second);
  }
}

/// What a run shares with those before it comes first, and what they gave up may stand between.
void Blocks::add(const std::shared_ptr<const PackedFrame>& frame) {
  const FrameStats& stats = frame->stats;
  const KeptRun::Frames& all = run().frames;
  const auto next = all.lower_bound(stats.frame);
  if ((next != all.end() && (next->first == stats.frame || next->second->stats.time < stats.time)) ||
      (next != all.begin() && std::prev(next)->second->stats.time > stats.time))
    throw InputError(m_where + "frames are not in their order");
  run().addFrame(frame);
}

void Blocks::takePart(const std::string& head, std::shared_ptr<const PackedBytes> data) {
  const PartHead leansOn = readPart(head, m_where);
  auto part = std::make_shared<FramePart>();
  part->key = known(m_keys, leansOn.key);
  if (leansOn.left != kNone) part->left = known(m_parts, leansOn.left);
  if (leansOn.right != kNone) part->right = known(m_parts, leansOn.right);
  for (const auto& below : {part->left, part->right}) {
    if (!below) continue;
    part->depth = std::max(part->depth, below->depth + 1);
    if (below->key != part->key || part->depth > FramePart::kDeepest)
      throw InputError(m_where + "it leans on what it cannot");
  }
  // Differences take no more than what they differ from, and a byte for each array.
  if (data->rawSize() > part->key->data->rawSize() + part->key->fields.size() + sizeof(uint64_t))
    throw InputError(m_where + "it is more than its key");
  part->data = std::move(data);
  m_parts[m_number] = std::move(part);
}

void Blocks::takeFrame(const std::string& head) {
  FrameParts parts;
  auto frame = std::make_shared<PackedFrame>(readFrame(head, m_where, parts));
  frame->part = known(m_parts, parts.part);
  if (const auto probes = m_probes.find(parts.probes);
      probes != m_probes.end() && probes->second->size() == frame->stats.probes.size())
    frame->stats.measured = probes->second;
  else
    frame->stats.probes.clear();
  add(frame);
  m_frames[m_number] = std::move(frame);
}

void Blocks::add(const KeptRun::State& state) {
  std::vector<KeptRun::State>& all = run().states;
  const auto next = std::find_if(all.begin(), all.end(), [&](const auto& other) { return other.frame >= state.frame; });
  if ((next != all.end() && (next->frame == state.frame || next->edits < state.edits)) ||
      (next != all.begin() && std::prev(next)->edits > state.edits))
    throw InputError(m_where + "states are not in their order");
  all.insert(next, state);
}

void Blocks::takeState(const std::string& head, std::shared_ptr<const PackedBytes> data) {
  const StateHead said = readState(head, m_where);
  const auto document = m_documents.find(said.document);
  if (document == m_documents.end()) throw InputError(m_where + "it is of a document that is not there");
  KeptRun::State state{said.frame, said.edits, document->second, std::make_shared<const NamedMatter>(),
                       std::move(data)};
  if (said.names != kNone) state.names = known(m_names, said.names);
  add(state);
  m_states[m_number] = std::make_shared<const KeptRun::State>(std::move(state));
}

void Blocks::takeText(Kind kind, const PackedBytes& text) {
  if (kind == Kind::Names) {
    m_names[m_number] = std::make_shared<const NamedMatter>(namesIn(text.unpacked(), m_where));
  } else if (kind == Kind::Document) {
    m_documents[m_number] = std::make_shared<const Project>(readProject(text.unpacked(), m_path, m_plugins).project);
  } else if (kind == Kind::Edits) {
    std::vector<FrameEdit>& before = run().edits;
    for (FrameEdit& edit : readLog(parseJson(text.unpacked(), m_path), m_documents, before, m_plugins)) {
      if (!before.empty() && edit.frame < before.back().frame) throw InputError("edits are not in their order");
      run().addEdit(std::move(edit));
    }
  } else if (kind == Kind::Probes) {
    static const json schema{{"type", "array"}, {"items", fields::probeFields().schema()}};
    json list = parseJson(text.unpacked(), m_path);
    requireSchema(schema, list, m_path);
    auto probes = std::make_shared<std::vector<Probe>>(list.size());
    for (size_t k = 0; k < list.size(); ++k) fields::probeFields().read((*probes)[k], list[k], m_plugins);
    m_probes[m_number] = std::move(probes);
  }
}

}  // namespace

RecordingReader::RecordingReader(const std::string& path, const PluginRegistry& plugins)
    : m_path(path), m_unpacker(std::make_unique<FrameUnpacker>()) {
  Blocks blocks(path, plugins);
  m_project = blocks.header();
  m_damage = blocks.readAll();
  m_noStates = blocks.whyNoStates();
  m_content = std::move(blocks.content);
  std::erase_if(m_content.earlier, [](const KeptRun& run) { return run.frames.empty(); });
  for (const auto& [number, frame] : m_content.present.frames) m_frames.push_back(frame);
  if (m_noStates.empty() && m_content.present.states.empty()) m_noStates = path + ": holds no state";
}

RecordingReader::~RecordingReader() = default;

SnapshotPtr RecordingReader::frame(size_t index) const {
  try {
    return m_unpacker->snapshot(*m_frames.at(index), 0);
  } catch (const InputError& problem) {
    throw InputError(m_path + ": frame " + std::to_string(index) + ": " + problem.what());
  }
}

bool isRecording(const std::string& path) {
  char mark[kMark];
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) return false;
  std::ifstream file(path, std::ios::binary);
  return file.read(mark, kMark) && std::memcmp(mark, kFileMark, kMark) == 0;
}

bool sameScene(const Project& a, const Project& b) {
  const auto sceneOf = [](Project project) {
    project.state = nullptr;
    return sceneHash(project);
  };
  return sceneOf(a) == sceneOf(b);
}

}  // namespace ps
