// SPDX-License-Identifier: Apache-2.0
// Graphs of a document: they come, go, move and change; each edit is a command.
#include "core/simulation/graphsource.h"
#include "ui/document/commands.h"
#include "ui/document/document.h"

#include <algorithm>

namespace ps {
namespace {

auto at(std::vector<Graph>& graphs, const std::string& id) {
  return std::find_if(graphs.begin(), graphs.end(), [&](const Graph& graph) { return graph.id == id; });
}

/// Returns the id that it got.
std::string insert(std::vector<Graph>& graphs, Graph graph, size_t place) {
  const std::string stem = graph.id.empty() ? "graph" : graph.id;
  graph.id = stem;
  for (int n = 1; at(graphs, graph.id) != graphs.end(); ++n) graph.id = stem + "-" + std::to_string(n);
  const std::string id = graph.id;
  graphs.insert(graphs.begin() + static_cast<std::ptrdiff_t>(std::min(place, graphs.size())), std::move(graph));
  return id;
}

std::vector<Graph> withCurve(std::vector<Graph> graphs, const std::string& id, const std::string& source) {
  const auto graph = at(graphs, id);
  if (graph != graphs.end() && graph->kind == Graph::Kind::Time) {
    if (std::find(graph->series.begin(), graph->series.end(), source) == graph->series.end())
      graph->series.push_back(source);
    return graphs;
  }
  Graph own;
  own.series = {source};
  const auto place = graph == graphs.end() ? graphs.size() : static_cast<size_t>(graph - graphs.begin()) + 1;
  insert(graphs, std::move(own), place);
  return graphs;
}

ParticleFields fieldsOf(const PluginRegistry* plugins) { return plugins ? ParticleFields(*plugins) : ParticleFields(); }

}  // namespace

std::vector<Graph> Document::graphs() const {
  return m_project.graphs ? *m_project.graphs : graphsFor(m_project, fieldsOf(m_plugins));
}

std::string Document::addGraph(Graph graph, size_t place, const QString& title) {
  std::vector<Graph> all = graphs();
  const std::string id = insert(all, std::move(graph), place);
  setGraphs(std::move(all), title);
  return id;
}

void Document::removeGraph(const std::string& id) {
  std::vector<Graph> all = graphs();
  std::erase_if(all, [&](const Graph& graph) { return graph.id == id; });
  setGraphs(std::move(all), QStringLiteral("removal of a graph"));
}

void Document::moveGraph(const std::string& id, int places) {
  std::vector<Graph> all = graphs();
  const auto from = at(all, id);
  if (from == all.end()) return;
  const auto old = from - all.begin();
  const auto now = std::clamp<std::ptrdiff_t>(old + places, 0, static_cast<std::ptrdiff_t>(all.size()) - 1);
  Graph graph = std::move(*from);
  all.erase(all.begin() + old);
  all.insert(all.begin() + now, std::move(graph));
  setGraphs(std::move(all), QStringLiteral("moving a graph"));
}

void Document::editGraph(const std::string& id, const QString& title, const std::function<void(Graph&)>& change) {
  std::vector<Graph> all = graphs();
  const auto graph = at(all, id);
  if (graph == all.end()) return;
  change(*graph);
  setGraphs(std::move(all), title);
}

void Document::plot(const std::string& id, const std::string& source) {
  setGraphs(withCurve(graphs(), id, source), QStringLiteral("plotting a curve"));
}

/// Into the graphs as they are without it: where they are chosen by the probes, it would be in one of them already.
std::string Document::plotProbe(const std::string& id, Probe probe) {
  const std::vector<Graph> before = graphs();
  const QString title = QStringLiteral("plotting %1").arg(QString::fromStdString(probe.name));
  m_undo.beginMacro(title);
  const std::string made = addProbe(std::move(probe));
  setGraphs(withCurve(before, id, probeSource(made)), title);
  m_undo.endMacro();
  return made;
}

void Document::removeSeries(const std::string& id, const std::string& source) {
  editGraph(id, QStringLiteral("removal of a curve"), [&](Graph& graph) { std::erase(graph.series, source); });
}

/// What was chosen for the probes stays so while nothing is edited.
void Document::setGraphs(std::vector<Graph> graphs, const QString& title) {
  if (graphs != this->graphs()) m_undo.push(new GraphsCommand(*this, m_project.graphs, std::move(graphs), title));
}

void Document::applyGraphs(const std::optional<std::vector<Graph>>& graphs) {
  m_project.graphs = graphs;
  ++m_changes;
  notify(GraphsChanged{});
}

}  // namespace ps
