// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/particlefield.h"
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
/// What a graph is of: the frames of the run, and of one that it is compared with.
struct GraphRuns {
  std::vector<FrameStats> frames, other;
  std::string otherName;
};
/// The curves of a graph over time, in SI units: "time_s,Ice core [K]", one row per frame. Of masses by phase and of
/// energy what they show. With another run, beside each column "Ice core [K] in Run 1" and "Ice core [K] less Run 1";
/// frames that one of them lacks have empty cells.
QByteArray graphCsv(const GraphRuns& runs, const Graph& graph, const Project& project, const ParticleFields& fields);

}  // namespace ps
