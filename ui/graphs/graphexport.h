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
/// The curves of a graph over time, in SI units: "time_s,Ice core [K]", one row per frame. Of masses by phase and of
/// energy what they show.
QByteArray graphCsv(const std::vector<FrameStats>& history, const Graph& graph, const Project& project,
                    const ParticleFields& fields);

}  // namespace ps
