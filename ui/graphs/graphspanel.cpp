// SPDX-License-Identifier: Apache-2.0
#include "ui/graphs/graphspanel.h"

#include "ui/document/document.h"
#include "ui/graphs/graphview.h"
#include "ui/graphs/phasestackview.h"
#include "ui/session/session.h"
#include "ui/session/transitions.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"

#include <QtWidgets/QHBoxLayout>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ps {
namespace {

constexpr double kZero = 273.15;
constexpr size_t kMostSeries = 5, kMostUnits = 2;
const QString kNotRun = QStringLiteral("Press Space to run");
const QString kNoMatter = QStringLiteral("No matter yet");
const QString kAllHeld = QStringLiteral("All matter is held in place; what is held is not measured");

QByteArray numberCell(double value) {
  if (!std::isfinite(value)) return {};
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, static_cast<qsizetype>(end.ptr - buffer)};
}

QByteArray quoted(const std::string& text) {
  QByteArray cell = QByteArray::fromStdString(text);
  if (!cell.contains(',') && !cell.contains('"')) return cell;
  return '"' + cell.replace("\"", "\"\"") + '"';
}

/// A unit that takes prefixes stands at the axis.
QString titled(const QString& name, const QString& unit) {
  return unit.isEmpty() || prefixFor(1000, unit).factor > 1 ? name : name + QStringLiteral(", ") + unit;
}

}  // namespace

GraphsPanel::GraphsPanel(Session& session, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_history(session),
      m_temperatures(new GraphView),
      m_phases(new PhaseStackView) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 4, 6, 4);
  row->setSpacing(8);
  m_temperatures->setTitle(QStringLiteral("Temperature, °C"));
  m_temperatures->setUnit(QStringLiteral("°C"));
  m_temperatures->setEmptyText(kNotRun);
  m_phases->setEmptyText(kNotRun);
  row->addWidget(m_temperatures, 1);
  row->addWidget(m_phases, 1);
  adopt(m_temperatures);
  adopt(m_phases);
  connect(&session, &Session::valuesDue, this, &GraphsPanel::readHistory);
  connect(&session.transitions(), &Transitions::changed, this,
          [this, &session] { setTransitions(session.transitions().melts(), session.transitions().boils()); });
  connect(&session.document(), &Document::changed, this, [this, &session](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) setProject(session.document().project());
  });
}

/// What is done to the time axis of one is done to all.
void GraphsPanel::adopt(TimePlot* plot) {
  m_plots.push_back(plot);
  connect(plot, &TimePlot::timeRangeChanged, this, [this](double first, double last) {
    for (TimePlot* other : m_plots) other->setTimeRange(first, last);
  });
  connect(plot, &TimePlot::fitted, this, [this] {
    for (TimePlot* other : m_plots) other->fit();
  });
}

/// A graph for each unit of fields that probes measure, besides temperatures; as many as there is room for.
void GraphsPanel::plotValues(const Project& project) {
  for (const Values& old : m_values) {
    std::erase(m_plots, old.view);
    delete old.view;
  }
  m_values.clear();
  for (size_t i = 0; i < project.probes.size(); ++i) {
    const Quantity* quantity = m_session.fields().quantity(project.probes[i].quantity);
    if (!quantity || !quantity->field || quantity->unit == "K") continue;
    const QString unit = QString::fromStdString(quantity->unit == "1" ? "" : quantity->unit);
    auto known =
        std::find_if(m_values.begin(), m_values.end(), [&](const Values& v) { return v.unit == quantity->unit; });
    if (known == m_values.end()) {
      if (m_values.size() == kMostUnits) continue;
      known = m_values.insert(known, {quantity->unit, quantity->field, {}, new GraphView});
      const bool prefixed = prefixFor(1000, unit).factor > 1;
      known->view->setTitle(titled(QString::fromStdString(quantity->field->label), unit));
      if (prefixed)
        known->view->setPrefixedUnit(unit);
      else
        known->view->setUnit(unit);
      adopt(known->view);
      static_cast<QHBoxLayout*>(layout())->insertWidget(static_cast<int>(m_values.size()), known->view, 1);
    }
    if (known->probes.size() == kMostSeries) continue;
    if (quantity->field != known->field) known->view->setTitle(titled(QStringLiteral("Probes"), unit));
    known->probes.push_back(i);
    known->view->addSeries(QString::fromStdString(project.probes[i].name));
  }
}

GraphView* GraphsPanel::valuesIn(const std::string& unit) const {
  for (const Values& values : m_values) {
    if (values.unit == unit) return values.view;
  }
  return nullptr;
}

void GraphsPanel::readHistory() {
  const HistoryReader::Piece piece = m_history.read();
  if (piece.begins) clear();
  const SnapshotPtr snapshot = m_session.snapshot();
  m_anyParticles = snapshot && !snapshot->id.empty();
  for (const FrameStats& stats : piece.frames) append(stats);
}

void GraphsPanel::setProject(const Project& project) {
  m_temperatures->removeAllSeries();
  m_phases->clear();
  m_probes.clear();
  std::vector<size_t> probes;
  for (size_t i = 0; i < project.probes.size() && probes.size() + 1 < kMostSeries; ++i) {
    const Probe& probe = project.probes[i];
    const bool mean = probe.quantity == "temperature" && probe.body.empty() && probe.phase.empty();
    if (m_session.fields().unitOf(probe.quantity) == "K" && !mean) probes.push_back(i);
  }
  m_temperatures->addSeries(QStringLiteral("Mean"), QStringLiteral("°C"));
  for (const size_t i : probes)
    m_temperatures->addSeries(QString::fromStdString(project.probes[i].name), QStringLiteral("°C"));
  m_probes = std::move(probes);
  plotValues(project);
  for (TimePlot* plot : m_plots) {
    plot->setDuration(project.duration);
    plot->setPresentTime(0);
    plot->fit();
  }
}

void GraphsPanel::setTransitions(double meltingPoint, double boilingPoint) {
  std::vector<ReferenceLine> lines;
  if (std::isfinite(meltingPoint) && meltingPoint > 0) lines.push_back({meltingPoint - kZero, QStringLiteral("melts")});
  if (std::isfinite(boilingPoint)) lines.push_back({boilingPoint - kZero, QStringLiteral("boils")});
  m_temperatures->setReferenceLines(std::move(lines));
}

void GraphsPanel::append(const FrameStats& stats) {
  m_temperatures->append(0, stats.time, stats.temperatureMean > 0 ? stats.temperatureMean - kZero : std::nan(""));
  for (size_t s = 0; s < m_probes.size(); ++s) {
    if (m_probes[s] < stats.probes.size())
      m_temperatures->append(static_cast<int>(s) + 1, stats.time, stats.probes[m_probes[s]] - kZero);
  }
  for (const Values& values : m_values) {
    for (size_t s = 0; s < values.probes.size(); ++s) {
      if (values.probes[s] < stats.probes.size())
        values.view->append(static_cast<int>(s), stats.time, stats.probes[values.probes[s]]);
    }
  }
  std::array<double, 5> kilograms{};
  for (size_t i = 0; i < kilograms.size(); ++i) kilograms[i] = stats.phases[i].mass;
  const QString empty = hasMatter(stats) ? kNotRun : m_anyParticles ? kAllHeld : kNoMatter;
  m_phases->append(stats.time, kilograms);
  for (TimePlot* plot : m_plots) {
    plot->setEmptyText(empty);
    plot->setPresentTime(stats.time);
  }
}

void GraphsPanel::clear() {
  m_temperatures->clear();
  for (const Values& values : m_values) values.view->clear();
  m_phases->clear();
}

QByteArray historyCsv(const std::vector<FrameStats>& history, const std::vector<Probe>& probes,
                      const ParticleFields& fields) {
  QByteArray csv =
      "time_s,thermal_time_s,mean.temperature[K],solid.mass[kg],melting.mass[kg],liquid.mass[kg],boiling.mass[kg],gas."
      "mass[kg]";
  for (const Probe& probe : probes)
    csv += ',' + quoted(probe.name + "." + probe.quantity + "[" + fields.unitOf(probe.quantity) + "]");
  csv += '\n';
  for (const FrameStats& stats : history) {
    csv += numberCell(stats.time) + ',' + numberCell(stats.thermalTime) + ',' + numberCell(stats.temperatureMean);
    for (const PhaseAmount& phase : stats.phases) csv += ',' + numberCell(phase.mass);
    for (size_t i = 0; i < probes.size(); ++i)
      csv += ',' + (i < stats.probes.size() ? numberCell(stats.probes[i]) : QByteArray());
    csv += '\n';
  }
  return csv;
}

}  // namespace ps
