// SPDX-License-Identifier: Apache-2.0
#include "core/export/exportformat.h"

#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/export/exporters.h"
#include "core/export/particlecolumns.h"
#include "core/io/outputfile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace ps {
namespace {

constexpr ExportFormat kFormats[] = {
    {"vtp", "Particles, VTK", "for ParaView and VTK: open particles.pvd, which knows the times", "particles", "vtp",
     false, makeVtp},
    {"ply", "Particles, PLY", "binary, for Blender, Houdini, MeshLab, CloudCompare", "particles", "ply", false,
     makePly},
    {"csv", "Particles, CSV", "a table of each frame, for spreadsheets and scripts", "particles", "csv", false,
     makeCsv},
    {"obj", "Surface, OBJ", "triangles by material with colours of temperature, for Blender and most others", "surface",
     "obj", true, makeSurfaceObj},
    {"surface-ply", "Surface, PLY", "the same, binary, with temperature as a number too", "surface", "ply", true,
     makeSurfacePly},
};

template <class T>
void append(std::string& text, T value) {
  if (!std::isfinite(value)) {
    text += "nan";
    return;
  }
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

std::span<const ExportFormat> exportFormats() { return kFormats; }

const ExportFormat& exportFormat(const std::string& key) {
  const auto* const found =
      std::find_if(std::begin(kFormats), std::end(kFormats), [&](const ExportFormat& f) { return key == f.key; });
  if (found != std::end(kFormats)) return *found;
  std::vector<std::string> keys;
  for (const ExportFormat& format : kFormats) keys.emplace_back(format.key);
  throw InputError(mustBeOneOf(key, keys));
}

std::unique_ptr<FrameExporter> makeExporter(const ExportFormat& format, ExportChoices choices) {
  makeFolder(choices.folder);
  requireWritable(pathIn(choices.folder, frameName(format, 0)));
  return format.make(format, std::move(choices));
}

std::vector<std::string> exportableFields(const Snapshot& snapshot) { return columnNames(snapshot); }

void requireFields(const std::vector<std::string>& fields, const Snapshot& snapshot) {
  const std::vector<std::string> names = columnNames(snapshot);
  for (const std::string& field : fields)
    if (std::find(names.begin(), names.end(), field) == names.end()) throw InputError(mustBeOneOf(field, names));
}

std::string frameName(const ExportFormat& format, uint64_t frame) {
  char number[32];
  std::snprintf(number, sizeof number, "-%06llu.", static_cast<unsigned long long>(frame));
  return format.first + std::string(number) + format.ending;
}

std::string pathIn(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

void appendNumber(std::string& text, float value) { append(text, value); }
void appendNumber(std::string& text, double value) { append(text, value); }

std::string oneWord(const std::string& name) {
  std::string word = name;
  for (char& c : word)
    if (static_cast<unsigned char>(c) <= ' ' || c == 0x7F) c = '_';
  return word;
}

}  // namespace ps
