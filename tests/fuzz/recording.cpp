// SPDX-License-Identifier: Apache-2.0
// A recording: the file as it stands where it begins with its mark. Checksums would hide all that lies behind them, so
// anything else is its header and its blocks as they are before they are packed: the mark of a block, a byte that says
// its kind, two that count its head, the head, and what is packed.
#include "core/io/recording.h"
#include "core/io/filestamp.h"
#include "core/io/recordingblocks.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/fuzz.h"
#include "ui/render/prepared.h"

#include <algorithm>
#include <cstring>

namespace {

using namespace ps;

constexpr std::string_view kFile = "PSRECORD", kBlock = "PSBLOCK.";

template <class T>
void append(std::string& file, const T& value) {
  file.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string sealed(std::string_view bytes) {
  std::string file(kFile);
  const std::string_view header = bytes.substr(0, bytes.find(kBlock));
  append(file, static_cast<uint32_t>(header.size()));
  file += header;
  append(file, hashOf(header));
  for (bytes.remove_prefix(header.size()); !bytes.empty();) {
    bytes.remove_prefix(kBlock.size());
    std::string_view rest = bytes.substr(0, bytes.find(kBlock));
    bytes.remove_prefix(rest.size());
    if (rest.size() < 3) continue;
    recording::BlockHead block;
    std::copy(kBlock.begin(), kBlock.end(), block.mark);
    block.kind = static_cast<uint8_t>(rest[0]);
    uint16_t length = 0;
    std::memcpy(&length, rest.data() + 1, sizeof length);
    rest.remove_prefix(3);
    const std::string head(rest.substr(0, length));
    rest.remove_prefix(head.size());
    const std::string packed = rest.empty() ? std::string() : squeezed(rest, 1);
    block.headBytes = static_cast<uint32_t>(head.size());
    block.packed = packed.size();
    block.raw = rest.size();
    block.packedSum = hashOf(packed);
    block.headSum = recording::headSumOf(block, head);
    append(file, block);
    file += head + packed;
  }
  return file;
}

void requireSound(const Snapshot& s) {
  const size_t n = s.position.size();
  for (const size_t count : {s.temperature.size(), s.speed.size(), s.densityError.size(), s.gasFraction.size(),
                             s.phase.size(), s.motion.size(), s.id.size(), s.body.size(), s.material.size()})
    fuzz::require(count == n, "every particle has every field");
  for (const FieldValues& field : s.fields) fuzz::require(field.values.size() == n, "every particle has every field");
}

}  // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fuzz::File file("recording");
  const std::string bytes = fuzz::textOf(data, size);
  file.write(bytes.starts_with(kFile) ? bytes : sealed(bytes));
  try {
    const RecordingReader reader(file.path(), fuzz::plugins());
    SnapshotPtr before;
    render::Prepared picture;
    for (size_t i = 0; i < reader.frameCount(); ++i) {
      SnapshotPtr now;
      try {
        now = reader.frame(i);
      } catch (const InputError& problem) {
        fuzz::requireMessage(problem.what(), file.path() + ": frame ");
        continue;
      }
      requireSound(*now);
      std::vector<std::string> colours{kMatterColour};
      for (const FieldValues& field : now->fields) colours.push_back(field.field->name);
      for (const std::string& colour : colours) {
        Look look;
        look.colour = colour;
        picture.fill(*now, before.get(), 0.5, {}, look);
      }
      before = now;
    }
  } catch (const InputError& problem) {
    fuzz::requireMessage(problem.what(), file.path());
  }
  return 0;
}
