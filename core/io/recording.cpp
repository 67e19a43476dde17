// SPDX-License-Identifier: Apache-2.0
#include "core/io/recording.h"

#include "core/base/bytepacker.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/jsontext.h"
#include "core/io/projectio.h"
#include "core/simulation/particlefield.h"

#include <cmath>
#include <cstring>
#include <filesystem>

namespace ps {
namespace {

using nlohmann::json;

constexpr char kFileMark[] = "PSRECORD", kFrameMark[] = "PSFRAME.";
constexpr size_t kMark = 8;
constexpr uint64_t kMaximumHeader = uint64_t{64} << 20, kMaximumFrame = uint64_t{2} << 30;
constexpr int kLevel = 3;  // zstd: half the time of 6, 3 % larger on frames of water

std::string packFrame(const Snapshot& s) {
  BytePacker packer;
  const size_t n = s.position.size();
  packer.value(uint64_t{n});
  packer.value(uint64_t{s.materialLook.size()});
  packer.value(s.stats.frame);
  packer.value(s.stats.time);
  packer.value(s.stats.thermalTime);
  packer.value(s.revision);
  packer.array(s.materialLook, s.materialLook.size());
  packer.array(s.position, n);
  packer.array(s.temperature, n);
  packer.array(s.speed, n);
  packer.array(s.densityError, n);
  packer.array(s.gasFraction, n);
  packer.array(s.phase, n);
  packer.array(s.motion, n);
  packer.array(s.id, n);
  packer.array(s.body, n);
  packer.array(s.material, n);
  packer.value(static_cast<uint32_t>(s.fields.size()));
  for (const FieldValues& shown : s.fields) {
    const ParticleField& field = *shown.field;
    for (const std::string* words : {&field.name, &field.label, &field.unit}) packer.text(*words);
    packer.value(field.minimum);
    packer.value(field.maximum);
    packer.array(shown.values, n);
  }
  return packer.bytes();
}

FieldValues unpackField(ByteUnpacker& unpacker, size_t n) {
  ParticleField field;
  for (std::string* words : {&field.name, &field.label, &field.unit}) *words = unpacker.text();
  field.minimum = unpacker.value<double>();
  field.maximum = unpacker.value<double>();
  if (!std::isfinite(field.minimum) || !std::isfinite(field.maximum)) unpacker.fail();
  static const ParticleFields kOurs;
  FieldPtr own = kOurs.find(field.name);  // knows more of itself
  FieldValues shown{own ? std::move(own) : std::make_shared<const ParticleField>(std::move(field)), {}};
  unpacker.array(shown.values, n);
  return shown;
}

std::shared_ptr<Snapshot> unpackFrame(const std::string& bytes, const std::string& where) {
  ByteUnpacker unpacker(bytes, where);
  auto s = std::make_shared<Snapshot>();
  const auto n = unpacker.value<uint64_t>(), colours = unpacker.value<uint64_t>();
  s->stats.frame = unpacker.value<uint64_t>();
  s->stats.time = unpacker.value<double>();
  s->stats.thermalTime = unpacker.value<double>();
  s->revision = unpacker.value<uint64_t>();
  unpacker.array(s->materialLook, colours);
  unpacker.array(s->position, n);
  unpacker.array(s->temperature, n);
  unpacker.array(s->speed, n);
  unpacker.array(s->densityError, n);
  unpacker.array(s->gasFraction, n);
  unpacker.array(s->phase, n);
  unpacker.array(s->motion, n);
  unpacker.array(s->id, n);
  unpacker.array(s->body, n);
  unpacker.array(s->material, n);
  for (auto fields = unpacker.value<uint32_t>(); fields > 0; --fields) s->fields.push_back(unpackField(unpacker, n));
  unpacker.finish();
  // As far (m) and as large (m³) as single precision can square: no scene comes near, and pictures are made of them.
  constexpr float kFarthest = 1e15f, kLargest = 1e12f;
  const auto drawable = [](const api::Float4& p) {
    const bool here = std::abs(p.x) <= kFarthest && std::abs(p.y) <= kFarthest && std::abs(p.z) <= kFarthest;
    return here && p.w >= 0 && p.w <= kLargest;
  };
  for (size_t i = 0; i < n; ++i) {
    if (!drawable(s->position[i])) unpacker.fail();
    if (s->phase[i] > api::Phase::Gas || s->motion[i] > api::Motion::Static) unpacker.fail();
    if (s->material[i] >= colours) unpacker.fail();
  }
  return s;
}

template <class T>
std::string_view bytesOf(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace

RecordingWriter::RecordingWriter(const std::string& path, const Project& project) : m_file(path) {
  Project scene = project;
  scene.state = nullptr;  // the frames say where matter stands
  const json header{{"format", "phasesketch-recording"},
                    {"version", kRecordingVersion},
                    {"project", json::parse(writeProject(scene))}};
  const std::string text = header.dump();
  const auto length = static_cast<uint32_t>(text.size());
  m_file.write({kFileMark, kMark});
  m_file.write(bytesOf(length));
  m_file.write(text);
  m_file.write(bytesOf(hashOf(text)));
}

void RecordingWriter::add(const Snapshot& snapshot) {
  const std::string raw = packFrame(snapshot);
  const std::string packed = squeezed(raw, kLevel);
  const uint64_t head[] = {packed.size(), raw.size(), hashOf(packed)};
  m_file.write({kFrameMark, kMark});
  m_file.write(bytesOf(head));
  m_file.write(packed);
  m_file.flush();
  ++m_frames;
}

void RecordingWriter::finish() { m_file.finish(); }

RecordingReader::RecordingReader(const std::string& path) : m_path(path), m_file(path, std::ios::binary) {
  std::error_code problem;
  m_bytes = std::filesystem::file_size(path, problem);
  if (problem || !m_file) throw InputError(path + ": cannot be read" + (problem ? ": " + problem.message() : ""));
  readHeader();
  findFrames();
}

void RecordingReader::readHeader() {
  const InputError damaged(m_path +
                           ": its header is damaged or cut off; take another copy, or simulate the project again");
  char mark[kMark];
  uint32_t length = 0;
  m_file.read(mark, kMark);
  if (!m_file || std::memcmp(mark, kFileMark, kMark) != 0)
    throw InputError(m_path + ": is no recording; simulate --record makes one");
  m_file.read(reinterpret_cast<char*>(&length), sizeof length);
  if (!m_file || length > kMaximumHeader || length + kMark + sizeof length > m_bytes) throw damaged;
  std::string text(length, '\0');
  uint64_t checksum = 0;
  m_file.read(text.data(), length);
  m_file.read(reinterpret_cast<char*>(&checksum), sizeof checksum);
  // Formats up to 3 have no checksum: their first frame stands here, or their end.
  const bool sealed = m_file && std::memcmp(&checksum, kFrameMark, kMark) != 0;
  if (sealed && checksum != hashOf(text)) throw damaged;
  json header;
  try {
    header = parseJson(text, m_path);
  } catch (const InputError&) {
    throw damaged;
  }
  const auto version = header.find("version");
  if (!header.is_object() || header.value("format", json()) != "phasesketch-recording" || version == header.end() ||
      !version->is_number_integer() || !header.contains("project")) {
    throw InputError(m_path + ": its header is no recording's; simulate --record makes one");
  }
  if (version->get<double>() > kRecordingVersion) {
    throw InputError(m_path + ": was made by a newer version (recording format " + version->dump() +
                     "); update PhaseSketch");
  }
  if (version->get<double>() < kRecordingVersion) {
    throw InputError(m_path + ": was made by an older version (recording format " + version->dump() +
                     "); simulate its project again");
  }
  if (!sealed) throw damaged;
  m_project = header["project"].dump();
}

void RecordingReader::findFrames() {
  constexpr uint64_t kHead = kMark + 3 * sizeof(uint64_t);
  uint64_t at = static_cast<uint64_t>(m_file.tellg());
  while (at < m_bytes) {
    char mark[kMark];
    uint64_t head[3]{};
    m_file.seekg(static_cast<std::streamoff>(at));
    if (m_bytes - at >= kHead) {
      m_file.read(mark, kMark);
      m_file.read(reinterpret_cast<char*>(head), sizeof head);
    }
    const bool whole = m_bytes - at >= kHead && m_file && std::memcmp(mark, kFrameMark, kMark) == 0 &&
                       head[0] <= m_bytes - at - kHead && head[1] <= kMaximumFrame;
    if (!whole) {
      m_damage = m_path + ": is cut off or damaged after frame " + std::to_string(m_frames.size());
      m_file.clear();
      return;
    }
    m_frames.push_back({at + kHead, head[0], head[1], head[2]});
    at += kHead + head[0];
  }
}

SnapshotPtr RecordingReader::frame(size_t index) {
  const Block& block = m_frames.at(index);
  const std::string where = m_path + ": frame " + std::to_string(index) + ": ";
  std::string packed(block.packed, '\0');
  m_file.clear();
  m_file.seekg(static_cast<std::streamoff>(block.offset));
  m_file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
  if (!m_file) throw InputError(where + "cannot be read");
  if (hashOf(packed) != block.checksum) {
    throw InputError(where + "the bytes are not what was written; the file is damaged");
  }
  const std::optional<std::string> raw = unsqueezed(packed, block.size);
  if (!raw) throw InputError(where + "the frame's data are broken; record again");
  return unpackFrame(*raw, where);
}

bool isRecording(const std::string& path) {
  char mark[kMark];
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) return false;
  std::ifstream file(path, std::ios::binary);
  return file.read(mark, kMark) && std::memcmp(mark, kFileMark, kMark) == 0;
}

}  // namespace ps
