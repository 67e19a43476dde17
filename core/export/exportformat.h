// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Frames of a run as files that other programs read, a file for each frame. Another format is a class in a file of its
// own, as its neighbours are, and a row in exportformat.cpp: command line, dialog, help and tests follow. Lengths are
// in m with y up, numbers in SI and kelvin. There is no Alembic and no USD: Debian 12 has neither library; Blender
// reads the series of PLY and OBJ, ParaView that of VTK.
namespace ps {

using ByteColour = std::array<uint8_t, 3>;  ///< sRGB

struct ExportChoices {
  std::string folder;                              ///< made where there is none
  std::vector<std::string> fields;                 ///< of particles; none: all that a frame has
  std::function<ByteColour(float kelvin)> colour;  ///< of a surface at a temperature
};

/// Writes frame after frame of one run. Files take their names when they are whole: what is there of a run that was
/// given up can be read. Each function throws Error "path: what happened; what to do", and Cancelled.
class FrameExporter {
 public:
  virtual ~FrameExporter() = default;
  /// Named by the frame's number. Frames ascend.
  virtual void add(const Snapshot& snapshot) = 0;
  /// Writes what is of the series as a whole.
  virtual void finish() {}
};

struct ExportFormat {
  const char *key, *label, *help;  ///< "vtp"; "Particles, VTK"; who reads it
  const char* first;               ///< what its files' names begin with: "particles"
  const char* ending;              ///< "vtp"
  bool surface = false;            ///< of matter, not its particles: fields mean nothing
  std::unique_ptr<FrameExporter> (*make)(const ExportFormat&, ExportChoices) = nullptr;
};

std::span<const ExportFormat> exportFormats();
/// Throws InputError "… must be one of …".
const ExportFormat& exportFormat(const std::string& key);

/// An exporter that writes there. Throws Error where there can be no such folder.
std::unique_ptr<FrameExporter> makeExporter(const ExportFormat& format, ExportChoices choices);

/// Names of what exporters can write of a frame's particles.
std::vector<std::string> exportableFields(const Snapshot& snapshot);
/// Throws InputError for a name that is none of them.
void requireFields(const std::vector<std::string>& fields, const Snapshot& snapshot);

}  // namespace ps
