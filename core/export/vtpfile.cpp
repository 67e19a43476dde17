// SPDX-License-Identifier: Apache-2.0
// VTK's XML file formats: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include "core/base/base64.h"
#include "core/base/progress.h"
#include "core/export/exporters.h"
#include "core/export/particlecolumns.h"
#include "core/io/outputfile.h"

#include <numeric>

namespace ps {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;  // XML has no others
    }
  }
  return out;
}

const char* typeName(float) { return "Float32"; }
const char* typeName(uint32_t) { return "UInt32"; }
const char* typeName(int64_t) { return "Int64"; }

/// Its bytes in base64 after their number, as one text.
template <class T>
void writeArray(OutputFile& file, const std::string& name, const std::vector<T>& values, int components = 1) {
  file.write("<DataArray type=\"" + std::string(typeName(T())) + "\" Name=\"" + escaped(name) +
             "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"binary\">");
  std::string bytes;
  bytes.reserve(sizeof(uint64_t) + values.size() * sizeof(T));
  appendBytes(bytes, uint64_t{values.size() * sizeof(T)});
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  file.write(toBase64(std::as_bytes(std::span(bytes))));
  file.write("</DataArray>\n");
  advance(0);
}

/// Texts as the codes of their characters, each ended by a zero.
void writeNames(OutputFile& file, const ParticleColumn& column) {
  if (column.names.empty()) return;
  std::string text = "<Array type=\"String\" Name=\"" + escaped(column.name) + "_names\" NumberOfTuples=\"" +
                     std::to_string(column.names.size()) + "\" format=\"ascii\">";
  for (const std::string& name : column.names) {
    for (const char c : name) text += std::to_string(static_cast<unsigned char>(c)) + ' ';
    text += "0 ";
  }
  file.write(text + "</Array>\n");
}

/// PolyData of one cell with all points, so that they show without a filter; and the collection of all frames with
/// their times.
class VtpFiles final : public FrameExporter {
 public:
  VtpFiles(const ExportFormat& format, ExportChoices choices) : m_format(format), m_choices(std::move(choices)) {}

  void add(const Snapshot& snapshot) override {
    const ParticleTable table = tableOf(snapshot, m_choices.fields);
    const std::string name = frameName(m_format, snapshot.stats.frame);
    OutputFile file(pathIn(m_choices.folder, name));
    std::string time;
    appendNumber(time, snapshot.stats.time);
    const auto count = static_cast<int64_t>(table.position.size());
    const int cells = count > 0 ? 1 : 0;
    file.write(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
        "NumberOfTuples=\"1\" format=\"ascii\">" +
        time + "</DataArray>\n");
    for (const ParticleColumn& column : table.columns) writeNames(file, column);
    file.write("</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(count) + "\" NumberOfVerts=\"" +
               std::to_string(cells) +
               "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n");
    for (const ParticleColumn& column : table.columns)
      std::visit([&](const auto& values) { writeArray(file, column.name, values); }, column.values);
    file.write("</PointData>\n<Points>\n");
    std::vector<float> places;
    places.reserve(3 * table.position.size());
    for (const api::Float4& p : table.position) places.insert(places.end(), {p.x, p.y, p.z});
    writeArray(file, "Points", places, 3);
    file.write("</Points>\n<Verts>\n");
    std::vector<int64_t> points(table.position.size());
    std::iota(points.begin(), points.end(), int64_t{0});
    writeArray(file, "connectivity", points);
    writeArray(file, "offsets", std::vector<int64_t>(static_cast<size_t>(cells), count));
    file.write("</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    file.finish();
    m_series += "<DataSet timestep=\"" + time + "\" part=\"0\" file=\"" + name + "\"/>\n";
  }

  void finish() override {
    writeFileAtomically(pathIn(m_choices.folder, std::string(m_format.first) + ".pvd"),
                        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                        "byte_order=\"LittleEndian\">\n<Collection>\n" +
                            m_series + "</Collection>\n</VTKFile>\n");
  }

 private:
  const ExportFormat& m_format;
  ExportChoices m_choices;
  std::string m_series;
};

}  // namespace

std::unique_ptr<FrameExporter> makeVtp(const ExportFormat& format, ExportChoices choices) {
  return std::make_unique<VtpFiles>(format, std::move(choices));
}

}  // namespace ps
