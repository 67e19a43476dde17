// SPDX-License-Identifier: Apache-2.0
#include "core/base/askat.h"
#include "core/export/exporters.h"
#include "core/export/particlecolumns.h"
#include "core/io/outputfile.h"

namespace ps {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// A table of each frame, with the time in its second column; bodies, materials and phases by their names.
class CsvFiles final : public FrameExporter {
 public:
  CsvFiles(const ExportFormat& format, ExportChoices choices) : m_format(format), m_choices(std::move(choices)) {}
  void add(const Snapshot& snapshot) override {
    const ParticleTable table = tableOf(snapshot, m_choices.fields);
    OutputFile file(pathIn(m_choices.folder, frameName(m_format, snapshot.stats.frame)));
    std::string text = "time[s],x[m],y[m],z[m]";
    for (const ParticleColumn& column : table.columns)
      text += ',' + quoted(column.unit == "1" ? column.name : column.name + '[' + column.unit + ']');
    std::string time = "\r\n";
    appendNumber(time, snapshot.stats.time);
    for (size_t i = 0; i < table.position.size(); ++i) {
      askAt(i);
      text += time;
      const api::Float4& p = table.position[i];
      for (const float value : {p.x, p.y, p.z}) appendNumber(text += ',', value);
      for (const ParticleColumn& column : table.columns) appendCell(text += ',', column, i);
      if (text.size() < kPiece) continue;
      file.write(text);
      text.clear();
    }
    file.write(text + "\r\n");
    file.finish();
  }

 private:
  static constexpr size_t kPiece = size_t{1} << 18;
  static void appendCell(std::string& text, const ParticleColumn& column, size_t i) {
    if (const auto* numbers = std::get_if<std::vector<float>>(&column.values)) {
      appendNumber(text, (*numbers)[i]);
      return;
    }
    const uint32_t value = std::get<std::vector<uint32_t>>(column.values)[i];
    text += value < column.names.size() ? quoted(column.names[value]) : std::to_string(value);
  }
  const ExportFormat& m_format;
  ExportChoices m_choices;
};

}  // namespace

std::unique_ptr<FrameExporter> makeCsv(const ExportFormat& format, ExportChoices choices) {
  return std::make_unique<CsvFiles>(format, std::move(choices));
}

}  // namespace ps
