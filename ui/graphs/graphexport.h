// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/graphsource.h"
#include "core/simulation/snapshot.h"

#include <QtCore/QByteArray>

#include <string>
#include <vector>

class QWidget;

namespace ps {

/// A widget as it stands, as a PNG of twice its size.
QByteArray pngOf(QWidget& widget);
/// The same as lines and text.
QByteArray svgOf(QWidget& widget);

/// Cells of a table: the shortest text that reads back as the number, nothing where there is none; text in quotation
/// marks where it needs them.
QByteArray numberCell(double value);
QByteArray quotedCell(const std::string& text);

/// All frames as CSV: "time_s,thermal_time_s,mean.temperature[K],…" one row per frame, with every probe.
QByteArray historyCsv(const std::vector<FrameStats>& history, const std::vector<Probe>& probes,
                      const ParticleFields& fields);
/// What a graph is of in one run: its frames, and where the columns are read.
struct GraphRun {
  std::vector<FrameStats> frames;
  std::vector<GraphSource> sources;
};
/// The sources of what a graph of curves, of masses by phase or of energy shows.
std::vector<std::string> exportedSources(const Graph& graph);
/// Curves over time, in SI units: "time_s,Ice core [K]", one row per frame. With frames of another run, beside each
/// column "Ice core [K] in Run 1" and "Ice core [K] less Run 1"; frames that one of them lacks have empty cells.
QByteArray graphCsv(const GraphRun& run, const GraphRun& other, const std::string& otherName);

}  // namespace ps
