// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/snapshot.h"
#include "ui/graphs/timeplot.h"
#include "ui/session/historyreader.h"

#include <QtCore/QByteArray>
#include <QtWidgets/QWidget>

#include <string>
#include <vector>

namespace ps {

class GraphView;
class PhaseStackView;
class Session;

/// Live graphs: mean temperature and temperature probes, probes of other fields by their units, and the mass in each
/// phase.
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
  /// Of probes of fields in this unit; nullptr where there are none.
  GraphView* valuesIn(const std::string& unit) const;
  PhaseStackView* phases() const { return m_phases; }
  QSize sizeHint() const override { return {700, 150}; }

 private:
  /// Probes of fields of one unit.
  struct Values {
    std::string unit;  ///< SI
    FieldPtr field;    ///< of the first probe; the title is the unit's where others measure another
    std::vector<size_t> probes;
    GraphView* view = nullptr;
  };
  void readHistory();
  void adopt(TimePlot* plot);
  void plotValues(const Project& project);
  Session& m_session;
  HistoryReader m_history;
  bool m_anyParticles = false;  ///< held ones too, which no amount counts
  GraphView* m_temperatures;
  PhaseStackView* m_phases;
  std::vector<size_t> m_probes;  ///< indices into Project::probes of the series after the first
  std::vector<Values> m_values;
  std::vector<TimePlot*> m_plots;  ///< all: they share their time axis
};

/// All frames as CSV: "time_s,thermal_time_s,mean.temperature[K],…" one row per frame, with every probe.
QByteArray historyCsv(const std::vector<FrameStats>& history, const std::vector<Probe>& probes,
                      const ParticleFields& fields);

}  // namespace ps
