// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ with colours behind the places of points, as ZBrush, MeshLab and Blender have them, and the materials'
// colours in a file beside.
#include "core/base/askat.h"
#include "core/export/exporters.h"
#include "core/export/scenesurface.h"
#include "core/io/outputfile.h"

#include <array>
#include <map>

namespace ps {
namespace {

void appendLine(std::string& text, const char* what, const std::array<float, 3>& values) {
  text += what;
  for (const float value : values) appendNumber(text += ' ', value);
}

class ObjFiles final : public FrameExporter {
 public:
  ObjFiles(const ExportFormat& format, ExportChoices choices)
      : m_format(format), m_choices(std::move(choices)), m_library(std::string(format.first) + ".mtl") {}

  void add(const Snapshot& snapshot) override {
    const std::vector<MaterialSurface> surfaces = surfacesOf(snapshot);
    OutputFile file(pathIn(m_choices.folder, frameName(m_format, snapshot.stats.frame)));
    std::string text = "# time ";
    appendNumber(text, snapshot.stats.time);
    file.write(text + " s; unit m, y is up\nmtllib " + m_library + '\n');
    size_t first = 1;  // OBJ counts from one
    for (const MaterialSurface& part : surfaces) {
      const std::string name = oneWord(snapshot.materialIds[part.material]);
      m_looks[name] = snapshot.materialLook[part.material];
      file.write("o " + name + "\nusemtl " + name + '\n');
      write(file, part.surface, first);
      first += part.surface.points.size();
    }
    file.finish();
  }

  void finish() override {
    std::string text;
    for (const auto& [name, look] : m_looks) {
      appendLine(text += "newmtl " + name + '\n', "Kd", {look[0], look[1], look[2]});
      text += "\n\n";
    }
    writeFileAtomically(pathIn(m_choices.folder, m_library), text);
  }

 private:
  void write(OutputFile& file, const ParticleSurface& surface, size_t first) const {
    std::string line;
    for (size_t i = 0; i < surface.points.size(); ++i) {
      askAt(i);
      line.clear();
      appendLine(line, "v", surface.points[i]);
      for (const uint8_t channel : m_choices.colour(surface.values[i]))
        appendNumber(line += ' ', static_cast<float>(channel) / 255);
      appendLine(line, "\nvn", surface.normals[i]);
      file.write(line += '\n');
    }
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
      askAt(t);
      line = "f";
      for (const uint32_t corner : surface.triangles[t]) {
        const std::string number = std::to_string(first + corner);
        line.append(" ").append(number).append("//").append(number);
      }
      file.write(line += '\n');
    }
  }
  const ExportFormat& m_format;
  ExportChoices m_choices;
  std::string m_library;
  std::map<std::string, std::array<float, 4>> m_looks;
};

}  // namespace

std::unique_ptr<FrameExporter> makeSurfaceObj(const ExportFormat& format, ExportChoices choices) {
  return std::make_unique<ObjFiles>(format, std::move(choices));
}

}  // namespace ps
