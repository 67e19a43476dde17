// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/exportformat.h"

// What the formats share; private to this room.
namespace ps {

std::unique_ptr<FrameExporter> makeCsv(const ExportFormat& format, ExportChoices choices);
std::unique_ptr<FrameExporter> makeVtp(const ExportFormat& format, ExportChoices choices);
std::unique_ptr<FrameExporter> makePly(const ExportFormat& format, ExportChoices choices);
std::unique_ptr<FrameExporter> makeSurfacePly(const ExportFormat& format, ExportChoices choices);
std::unique_ptr<FrameExporter> makeSurfaceObj(const ExportFormat& format, ExportChoices choices);

/// "particles-000017.vtp".
std::string frameName(const ExportFormat& format, uint64_t frame);
/// A path in the folder.
std::string pathIn(const std::string& folder, const std::string& name);

/// The shortest text that reads as the same number; "nan" for what is none.
void appendNumber(std::string& text, float value);
void appendNumber(std::string& text, double value);
/// As they lie in memory: little-endian (core/base refuses others).
template <class T>
void appendBytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
/// A name of somebody's where a format ends names at a blank: without blanks and control characters.
std::string oneWord(const std::string& name);

}  // namespace ps
