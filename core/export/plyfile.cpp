// SPDX-License-Identifier: Apache-2.0
// Polygon File Format, binary: https://paulbourke.net/dataformats/ply/
#include "core/base/askat.h"
#include "core/export/exporters.h"
#include "core/export/particlecolumns.h"
#include "core/export/scenesurface.h"
#include "core/io/outputfile.h"

namespace ps {
namespace {

std::string headOf(const Snapshot& snapshot) {
  std::string head = "ply\nformat binary_little_endian 1.0\ncomment time ";
  appendNumber(head, snapshot.stats.time);
  return head + " s\ncomment unit m, y is up\n";
}

std::string namesOf(const std::string& what, const std::vector<std::string>& names) {
  std::string lines;
  for (size_t k = 0; k < names.size(); ++k)
    lines += "comment " + oneWord(what) + ' ' + std::to_string(k) + ' ' + oneWord(names[k]) + '\n';
  return lines;
}

class PlyFiles final : public FrameExporter {
 public:
  PlyFiles(const ExportFormat& format, ExportChoices choices) : m_format(format), m_choices(std::move(choices)) {}
  void add(const Snapshot& snapshot) override {
    const ParticleTable table = tableOf(snapshot, m_choices.fields);
    std::string head = headOf(snapshot);
    for (const ParticleColumn& column : table.columns) head += namesOf(column.name, column.names);
    head += "element vertex " + std::to_string(table.position.size()) +
            "\nproperty float x\nproperty float y\nproperty float z\n";
    for (const ParticleColumn& column : table.columns) {
      const bool number = std::holds_alternative<std::vector<float>>(column.values);
      head += std::string("property ") + (number ? "float " : "uint ") + oneWord(column.name) + '\n';
    }
    OutputFile file(pathIn(m_choices.folder, frameName(m_format, snapshot.stats.frame)));
    file.write(head + "end_header\n");
    std::string row;
    for (size_t i = 0; i < table.position.size(); ++i) {
      askAt(i);
      const api::Float4& p = table.position[i];
      row.clear();
      for (const float value : {p.x, p.y, p.z}) appendBytes(row, value);
      for (const ParticleColumn& column : table.columns)
        std::visit([&](const auto& values) { appendBytes(row, values[i]); }, column.values);
      file.write(row);
    }
    file.finish();
  }

 private:
  const ExportFormat& m_format;
  ExportChoices m_choices;
};

class SurfacePlyFiles final : public FrameExporter {
 public:
  SurfacePlyFiles(const ExportFormat& format, ExportChoices choices)
      : m_format(format), m_choices(std::move(choices)) {}
  void add(const Snapshot& snapshot) override {
    const std::vector<MaterialSurface> surfaces = surfacesOf(snapshot);
    size_t points = 0, triangles = 0;
    for (const MaterialSurface& part : surfaces)
      points += part.surface.points.size(), triangles += part.surface.triangles.size();
    OutputFile file(pathIn(m_choices.folder, frameName(m_format, snapshot.stats.frame)));
    std::string head = headOf(snapshot) + namesOf("material", snapshot.materialIds);
    head += "element vertex " + std::to_string(points) + '\n';
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) head += std::string("property float ") + name + '\n';
    for (const char* name : {"red", "green", "blue"}) head += std::string("property uchar ") + name + '\n';
    head += "property float temperature\nproperty uint material\nelement face " + std::to_string(triangles) +
            "\nproperty list uchar int vertex_indices\nend_header\n";
    file.write(head);
    for (const MaterialSurface& part : surfaces) writePoints(file, part);
    uint32_t first = 0;
    for (const MaterialSurface& part : surfaces) {
      std::string row;
      for (size_t t = 0; t < part.surface.triangles.size(); ++t) {
        askAt(t);
        row.assign(1, 3);
        for (const uint32_t corner : part.surface.triangles[t]) appendBytes(row, first + corner);
        file.write(row);
      }
      first += static_cast<uint32_t>(part.surface.points.size());
    }
    file.finish();
  }

 private:
  void writePoints(OutputFile& file, const MaterialSurface& part) const {
    const ParticleSurface& surface = part.surface;
    std::string row;
    for (size_t i = 0; i < surface.points.size(); ++i) {
      askAt(i);
      row.clear();
      appendBytes(row, surface.points[i]);
      appendBytes(row, surface.normals[i]);
      appendBytes(row, m_choices.colour(surface.values[i]));
      appendBytes(row, surface.values[i]);
      appendBytes(row, part.material);
      file.write(row);
    }
  }
  const ExportFormat& m_format;
  ExportChoices m_choices;
};

}  // namespace

std::unique_ptr<FrameExporter> makePly(const ExportFormat& format, ExportChoices choices) {
  return std::make_unique<PlyFiles>(format, std::move(choices));
}

std::unique_ptr<FrameExporter> makeSurfacePly(const ExportFormat& format, ExportChoices choices) {
  return std::make_unique<SurfacePlyFiles>(format, std::move(choices));
}

}  // namespace ps
