// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/snapshot.h"
#include "ui/graphs/timeplot.h"
#include "ui/session/historyreader.h"

#include <QtCore/QByteArray>
#include <QtWidgets/QWidget>

#include <vector>

namespace ps {

class GraphView;
class PhaseStackView;
class Session;

/// Live graphs: mean temperature and temperature probes, and the mass in each phase.
class GraphsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit GraphsPanel(Session& session, QWidget* parent = nullptr);
  void setProject(const Project& project);  ///< series of its probes
  /// Melting and boiling points as reference lines, K (not finite: none).
  void setTransitions(double meltingPoint, double boilingPoint);
  void append(const FrameStats& stats);
  void clear();
  GraphView* temperatures() const { return m_temperatures; }
  PhaseStackView* phases() const { return m_phases; }
  QSize sizeHint() const override { return {700, 150}; }

 private:
  void readHistory();
  Session& m_session;
  HistoryReader m_history;
  bool m_anyParticles = false;  ///< held ones too, which no amount counts
  GraphView* m_temperatures;
  PhaseStackView* m_phases;
  std::vector<size_t> m_probes;  ///< indices into Project::probes of the series after the first
};

/// All frames as CSV: "time_s,thermal_time_s,mean.temperature[K],…" one row per frame, with every probe.
QByteArray historyCsv(const std::vector<FrameStats>& history, const std::vector<Probe>& probes);

}  // namespace ps
