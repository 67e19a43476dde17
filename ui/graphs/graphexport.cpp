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
#include <utility>

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

QByteArray graphCsv(const GraphRuns& runs, const Graph& graph, const Project& project, const ParticleFields& fields) {
  std::vector<std::string> names = graph.series;
  if (graph.kind == Graph::Kind::Phases) {
    names.clear();
    for (const char* key : {"solid_mass", "melting_mass", "liquid_mass", "boiling_mass", "gas_mass"})
      names.push_back(frameSource(key));
  }
  if (graph.kind == Graph::Kind::Energy) {
    names.clear();
    for (const char* key :
         {"thermal_energy", "heat_walls", "heat_air", "heat_radiation", "heat_heaters", "heat_matter"})
      names.push_back(frameSource(key));
  }
  QByteArray csv = "time_s";
  std::vector<std::pair<GraphSource, GraphSource>> sources;  // one for each run: they remember where they looked
  for (const std::string& name : names) {
    const GraphSource source(name, project, fields);
    if (!source) continue;
    const std::string title = source.label() + " [" + source.unit() + "]";
    csv += ',' + quotedCell(title);
    if (!runs.other.empty())
      csv += ',' + quotedCell(title + " in " + runs.otherName) + ',' + quotedCell(title + " less " + runs.otherName);
    sources.emplace_back(source, source);
  }
  csv += '\n';
  for (auto own = runs.frames.begin(), other = runs.other.begin();
       own != runs.frames.end() || other != runs.other.end();) {
    const bool hasOwn = own != runs.frames.end() && (other == runs.other.end() || own->frame <= other->frame);
    const bool hasOther = other != runs.other.end() && (own == runs.frames.end() || other->frame <= own->frame);
    csv += numberCell(hasOwn ? own->time : other->time);
    for (const auto& [ofOwn, ofOther] : sources) {
      const double value = hasOwn ? ofOwn(*own) : std::nan(""), there = hasOther ? ofOther(*other) : std::nan("");
      csv += ',' + numberCell(value);
      if (!runs.other.empty()) csv += ',' + numberCell(there) + ',' + numberCell(value - there);
    }
    csv += '\n';
    if (hasOwn) ++own;
    if (hasOther) ++other;
  }
  return csv;
}

}  // namespace ps
