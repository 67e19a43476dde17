// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphexport.h"

#include "core/simulation/graphsource.h"

#include <QtCore/QBuffer>
#include <QtGui/QImage>
#include <QtGui/QPainter>
#include <QtSvg/QSvgGenerator>
#include <QtWidgets/QWidget>

#include <charconv>
#include <cmath>
#include <limits>

namespace ps {

QByteArray pngOf(QWidget& widget) {
  constexpr int kScale = 2;
  QImage image(widget.size() * kScale, QImage::Format_ARGB32_Premultiplied);
  image.setDevicePixelRatio(kScale);
  widget.render(&image);
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  return bytes;
}

QByteArray svgOf(QWidget& widget) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QSvgGenerator svg;
  svg.setOutputDevice(&buffer);
  svg.setSize(widget.size());
  svg.setViewBox(widget.rect());
  svg.setTitle(widget.accessibleName());
  QPainter painter(&svg);
  widget.render(&painter);
  painter.end();
  return bytes;
}

QByteArray numberCell(double value) {
  if (!std::isfinite(value)) return {};
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, static_cast<qsizetype>(end.ptr - buffer)};
}

QByteArray quotedCell(const std::string& text) {
  QByteArray cell = QByteArray::fromStdString(text);
  if (!cell.contains(',') && !cell.contains('"')) return cell;
  return '"' + cell.replace("\"", "\"\"") + '"';
}

QByteArray historyCsv(const std::vector<FrameStats>& history, const std::vector<Probe>& probes,
                      const ParticleFields& fields) {
  QByteArray csv =
      "time_s,thermal_time_s,mean.temperature[K],solid.mass[kg],melting.mass[kg],liquid.mass[kg],boiling.mass[kg],gas."
      "mass[kg]";
  Project project;  // by which their sources are looked up
  project.probes = probes;
  std::vector<GraphSource> sources;
  for (const Probe& probe : probes) {
    csv += ',' + quotedCell(probe.name + "." + probe.quantity + "[" + fields.unitOf(probe.quantity) + "]");
    sources.emplace_back(probeSource(probe.id), project, fields);
  }
  csv += '\n';
  for (const FrameStats& stats : history) {
    csv += numberCell(stats.time) + ',' + numberCell(stats.thermalTime) + ',' + numberCell(stats.temperatureMean);
    for (const PhaseAmount& phase : stats.phases) csv += ',' + numberCell(phase.mass);
    for (const GraphSource& source : sources) csv += ',' + numberCell(source(stats));
    csv += '\n';
  }
  return csv;
}

std::vector<std::string> exportedSources(const Graph& graph) {
  std::vector<std::string> sources;
  if (graph.kind == Graph::Kind::Phases) {
    for (const char* key : {"solid_mass", "melting_mass", "liquid_mass", "boiling_mass", "gas_mass"})
      sources.push_back(frameSource(key));
    return sources;
  }
  if (graph.kind != Graph::Kind::Energy) return graph.series;
  for (const char* key : {"thermal_energy", "heat_walls", "heat_air", "heat_radiation", "heat_heaters", "heat_matter"})
    sources.push_back(frameSource(key));
  return sources;
}

QByteArray graphCsv(const GraphRun& run, const GraphRun& other, const std::string& otherName) {
  QByteArray csv = "time_s";
  const bool both = !other.frames.empty();
  for (const GraphSource& source : run.sources) {
    const std::string title = source.label() + " [" + source.unit() + "]";
    csv += ',' + quotedCell(title);
    if (both) csv += ',' + quotedCell(title + " in " + otherName) + ',' + quotedCell(title + " less " + otherName);
  }
  csv += '\n';
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  auto own = run.frames.begin(), there = other.frames.begin();
  while (own != run.frames.end() || there != other.frames.end()) {
    const bool hasOwn = own != run.frames.end() && (there == other.frames.end() || own->frame <= there->frame);
    const bool hasOther = there != other.frames.end() && (own == run.frames.end() || there->frame <= own->frame);
    csv += numberCell(hasOwn ? own->time : there->time);
    for (size_t k = 0; k < run.sources.size(); ++k) {
      const double value = hasOwn ? run.sources[k](*own) : kNone;
      const double otherValue = hasOther ? other.sources[k](*there) : kNone;
      csv += ',' + numberCell(value);
      if (both) csv += ',' + numberCell(otherValue) + ',' + numberCell(value - otherValue);
    }
    csv += '\n';
    if (hasOwn) ++own;
    if (hasOther) ++there;
  }
  return csv;
}

}  // namespace ps
