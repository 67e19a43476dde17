// SPDX-License-Identifier: Apache-2.0
// A recording: the file as it stands where it begins with its mark. Checksums would hide all that lies behind them, so
// anything else is its header and its frames as they are before they are packed, each behind the mark of a frame.
#include "core/io/recording.h"
#include "core/io/filestamp.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/fuzz.h"
#include "ui/render/prepared.h"

#include <zstd.h>

namespace {

using namespace ps;

constexpr std::string_view kFile = "PSRECORD", kFrame = "PSFRAME.";

template <class T>
void append(std::string& file, const T& value) {
  file.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string sealed(std::string_view bytes) {
  std::string file(kFile);
  const std::string_view header = bytes.substr(0, bytes.find(kFrame));
  append(file, static_cast<uint32_t>(header.size()));
  file += header;
  append(file, hashOf(header));
  for (bytes.remove_prefix(header.size()); !bytes.empty();) {
    bytes.remove_prefix(kFrame.size());
    const std::string_view raw = bytes.substr(0, bytes.find(kFrame));
    bytes.remove_prefix(raw.size());
    std::string packed(ZSTD_compressBound(raw.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), 1));
    file += kFrame;
    for (const uint64_t number : {packed.size(), raw.size(), hashOf(packed)}) append(file, number);
    file += packed;
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
    RecordingReader reader(file.path());
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
