// SPDX-License-Identifier: Apache-2.0
// Probes of a document: they come, go and measure something else; each edit is a command.
#include "core/simulation/graphsource.h"
#include "core/simulation/probeparameters.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"

#include <algorithm>

namespace ps {
namespace {

auto at(const std::vector<Probe>& probes, const std::string& id) {
  return std::find_if(probes.begin(), probes.end(), [&](const Probe& probe) { return probe.id == id; });
}

}  // namespace

const Probe* Document::probe(const std::string& id) const {
  const auto found = at(m_project.probes, id);
  return found == m_project.probes.end() ? nullptr : &*found;
}

std::string Document::addProbe(Probe probe) {
  const std::string stem = probe.id.empty() ? "probe" : probe.id;
  probe.id = stem;
  for (int n = 2; this->probe(probe.id); ++n) probe.id = stem + "-" + std::to_string(n);
  if (probe.name.empty()) probe.name = probe.id;
  const std::string id = probe.id;
  const QString title = QStringLiteral("new probe %1").arg(nameOf(probe));
  pushProbe({m_project.probes.size(), std::nullopt, std::move(probe)}, title);
  return id;
}

void Document::editProbe(Probe after, const QString& title) {
  const auto before = at(m_project.probes, after.id);
  if (before == m_project.probes.end()) return;
  const auto index = static_cast<size_t>(before - m_project.probes.begin());
  if (*before == after && m_gestureDepth == 0) return;
  pushProbe({index, *before, std::move(after)}, title);
}

void Document::renameProbe(const std::string& id, const QString& name) {
  const Probe* old = probe(id);
  const std::string wanted = name.trimmed().toStdString();
  if (!old || wanted.empty() || wanted == old->name) return;
  Probe after = *old;
  after.name = wanted;
  editProbe(std::move(after), QStringLiteral("rename of %1").arg(nameOf(*old)));
}

void Document::removeProbe(const std::string& id) {
  const auto old = at(m_project.probes, id);
  if (old == m_project.probes.end()) return;
  const QString title = QStringLiteral("deletion of %1").arg(nameOf(*old));
  m_undo.beginMacro(title);
  if (m_project.graphs) {
    for (const Graph& graph : std::vector<Graph>(*m_project.graphs)) removeSeries(graph.id, probeSource(id));
  }
  pushProbe({static_cast<size_t>(old - m_project.probes.begin()), *old, std::nullopt}, title);
  m_undo.endMacro();
}

std::optional<Probe> Document::probeWith(const Address& address, const Value& value, QString& problem) const {
  const Probe* old = probe(address.id);
  const api::ParameterDeclaration* declared = declaration(address);
  if (!old || !declared) {
    problem = QStringLiteral("%1 is no longer part of the scene.").arg(QString::fromStdString(address.text()));
    return std::nullopt;
  }
  problem = QString::fromStdString(problemWith(m_project, m_plugins, address, value));
  Probe after = *old;
  if (!problem.isEmpty() || !setProbeValue(after, address.key, conformed(value, *declared), m_project.environment))
    return std::nullopt;
  followChoice(after, address.key, m_project);
  const auto problems = probeProblems(after, m_plugins ? ParticleFields(*m_plugins) : ParticleFields());
  if (problems.empty()) return after;
  const QString what = QString::fromStdString(problems.front().second);
  problem = what.left(1).toUpper() + what.mid(1) + QLatin1Char('.');
  return std::nullopt;
}

QString Document::setProbeParameter(const Address& address, const Value& value) {
  QString problem;
  std::optional<Probe> after = probeWith(address, value, problem);
  if (!after) return problem;
  const QString title =
      QStringLiteral("%1 of %2").arg(QString::fromUtf8(declaration(address)->label), nameOf(*probe(address.id)));
  editProbe(std::move(*after), title);
  return {};
}

QString Document::setProbeParameters(const std::vector<std::pair<Address, Value>>& values, const QString& text) {
  Placement all;
  for (const auto& [address, value] : values) {
    QString problem;
    std::optional<Probe> after = probeWith(address, value, problem);
    if (!problem.isEmpty()) return problem;
    if (after) all.probes.push_back(std::move(*after));
  }
  place(std::move(all), text);
  return {};
}

void Document::pushProbe(ProbeEdit edit, const QString& title) {
  if (m_gestureDepth == 0) ++m_gesture;
  m_undo.push(new ProbeCommand(*this, std::move(edit), m_gesture, title));
}

void Document::applyProbe(const ProbeEdit& edit, bool forward) {
  const std::optional<Probe>&from = forward ? edit.before : edit.after, &to = forward ? edit.after : edit.before;
  const auto place = m_project.probes.begin() + static_cast<std::ptrdiff_t>(edit.index);
  const std::string id = (to ? to : from)->id;
  if (from && to)
    *place = *to;
  else if (to)
    m_project.probes.insert(place, *to);
  else
    m_project.probes.erase(place);
  ++m_changes;
  notify(ProbesChanged{id});
}

}  // namespace ps
