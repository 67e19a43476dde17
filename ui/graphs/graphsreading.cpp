// SPDX-License-Identifier: Apache-2.0
// What the graphs read: frames of the run, piece by piece, of one that it is compared with, and what parameters were.
#include "core/simulation/enginethread.h"
#include "core/simulation/parametercourse.h"
#include "ui/document/document.h"
#include "ui/graphs/distributionview.h"
#include "ui/graphs/graphexport.h"
#include "ui/graphs/graphspanel.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/seriesunit.h"
#include "ui/graphs/stackview.h"
#include "ui/session/recordedview.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"

#include <algorithm>
#include <memory>

namespace ps {

/// Those that there are.
std::vector<GraphSource> GraphsPanel::sourcesOf(const std::vector<std::string>& series) const {
  std::vector<GraphSource> sources;
  for (const std::string& one : series) {
    GraphSource source(one, m_session.document().project(), m_session.fields(), m_session.document().plugins());
    if (source) sources.push_back(std::move(source));
  }
  return sources;
}

/// What parameters were in this run, or in an earlier one.
void GraphsPanel::follow(std::vector<GraphSource>& sources, std::optional<uint64_t> run) const {
  std::optional<RunEdits> edits;
  for (GraphSource& source : sources) {
    if (!source.parameter() || !m_session.engine()) continue;
    if (!edits) edits = m_session.engine()->recording().documentEdits(run);
    source.setCourse(
        std::make_shared<const ParameterCourse>(*edits, m_session.document().plugins(), *source.parameter()));
  }
}

/// Curves of the run that this one is compared with.
void GraphsPanel::showCompared(Shown& shown) {
  auto* view = qobject_cast<GraphView*>(shown.plot);
  if (!view) return;
  const RecordedView& recorded = m_session.recorded();
  view->beginOther(recorded.compared() ? recorded.runName(*recorded.compared()) : QString());
  shown.otherRead = 0;
  if (readOther(shown)) m_catchUp.start();
}

/// The next piece of them; whether there are more.
bool GraphsPanel::readOther(Shown& shown) {
  auto* view = qobject_cast<GraphView*>(shown.plot);
  const std::vector<FrameStats>& frames = m_session.recorded().comparedStats();
  if (!view || shown.otherRead >= frames.size()) return false;
  std::vector<GraphSource> sources = shown.sources;
  follow(sources, m_session.recorded().compared());
  const size_t end = std::min(frames.size(), shown.otherRead + HistoryReader::kMost);
  for (; shown.otherRead < end; ++shown.otherRead) {
    const FrameStats& stats = frames[shown.otherRead];
    for (size_t s = 0; s < sources.size(); ++s)
      view->appendOther(static_cast<int>(s), stats.time, SeriesUnit(sources[s].unit()).of(sources[s](stats)));
  }
  return shown.otherRead < frames.size();
}

/// One piece of one graph in a turn of the event loop, however long the run was: nobody waits for a curve.
void GraphsPanel::catchUp() {
  for (size_t k = 0; k < m_shown.size(); ++k) {
    Shown& shown = m_shown[k];
    if (shown.unread && m_session.engine()) {
      const std::vector<FrameStats> frames = m_session.engine()->history(*shown.unread, HistoryReader::kMost);
      feed(frames, {k});
      shown.unread = frames.size() < HistoryReader::kMost ? std::nullopt : std::optional(frames.back().frame + 1);
    } else if (!readOther(shown)) {
      continue;
    }
    m_catchUp.start();
    return;
  }
}

void GraphsPanel::readHistory() {
  const HistoryReader::Piece piece = m_history.read();
  if (piece.begins) clear();
  std::vector<size_t> live;  // what still reads older frames comes to these by itself
  for (size_t k = 0; k < m_shown.size(); ++k) {
    if (!m_shown[k].unread) live.push_back(k);
  }
  feed(piece.frames, live);
  if (piece.more) QTimer::singleShot(0, this, &GraphsPanel::readHistory);
  for (const Shown& shown : m_shown) {
    if (shown.overTime) shown.overTime->setPresentTime(m_session.now());
  }
  setEmptyTexts();
}

/// Edits are read after the frames: none that acted is missing.
void GraphsPanel::feed(const std::vector<FrameStats>& frames, const std::vector<size_t>& graphs) {
  for (const size_t index : graphs) follow(m_shown[index].sources, std::nullopt);
  for (const FrameStats& stats : frames) {
    m_started = true;
    m_matter = hasMatter(stats);
    for (const size_t index : graphs) {
      const Shown& shown = m_shown[index];
      if (auto* view = qobject_cast<GraphView*>(shown.plot)) {
        for (size_t s = 0; s < shown.sources.size(); ++s)
          view->append(static_cast<int>(s), stats.time,
                       SeriesUnit(shown.sources[s].unit()).of(shown.sources[s](stats)));
      } else if (auto* phases = qobject_cast<PhaseStackView*>(shown.plot)) {
        std::array<double, 5> kilograms{};
        for (size_t i = 0; i < kilograms.size(); ++i) kilograms[i] = stats.phases[i].mass;
        phases->append(stats.time, kilograms);
      } else if (auto* energy = qobject_cast<EnergyStackView*>(shown.plot)) {
        if (stats.frame == 0 || energy->sampleCount() == 0) m_startEnergy = stats.thermalEnergy - stats.heat.net();
        const HeatLedger& heat = stats.heat;
        energy->append(stats.time, {heat.walls, heat.air, heat.radiation, heat.heaters, heat.sources},
                       stats.thermalEnergy - m_startEnergy);
      }
    }
  }
}

void GraphsPanel::showDistributions() {
  const SnapshotPtr snapshot = m_session.snapshot();
  if (!snapshot) return;
  for (const Shown& shown : m_shown) {
    auto* view = qobject_cast<DistributionView*>(shown.plot);
    if (view && !view->visibleRegion().isEmpty())
      view->show(*snapshot, shown.graph, m_session.fields().find(shown.graph.field).get());
  }
}

void GraphsPanel::clear() {
  m_started = false;
  for (Shown& shown : m_shown) {
    shown.unread.reset();
    if (shown.overTime) shown.overTime->clear();
  }
}

QByteArray GraphsPanel::exported(const std::string& id, const QString& ending) const {
  const Shown* shown = find(id);
  if (!shown) return {};
  if (ending == QStringLiteral("png")) return pngOf(*shown->plot);
  if (ending == QStringLiteral("svg")) return svgOf(*shown->plot);
  if (auto* view = qobject_cast<DistributionView*>(shown->plot)) return view->csv();
  const RecordedView& recorded = m_session.recorded();
  GraphRun run{m_session.engine() ? m_session.engine()->history(0) : std::vector<FrameStats>(),
               sourcesOf(exportedSources(shown->graph))};
  GraphRun other{recorded.comparedStats(), run.sources};
  follow(run.sources, std::nullopt);
  if (!recorded.compared()) return graphCsv(run, {}, {});
  follow(other.sources, recorded.compared());
  return graphCsv(run, other, recorded.runName(*recorded.compared()).toStdString());
}

}  // namespace ps
