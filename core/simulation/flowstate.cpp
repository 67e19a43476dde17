// SPDX-License-Identifier: Apache-2.0
// What emitters hold in their pipes, and what has flowed.
#include "core/base/statestream.h"
#include "core/simulation/compile.h"
#include "core/simulation/matterflow.h"

#include <algorithm>

namespace ps {
namespace {

/// Visits what a pipe measures.
template <class APipe, class Visit>
void eachNumber(APipe& pipe, Visit&& visit) {
  visit(pipe.travelled), visit(pipe.diameter);
  for (auto* v : {&pipe.point, &pipe.direction}) {
    for (auto& c : *v) visit(c);
  }
}

}  // namespace

void MatterFlow::save(StateWriter& writer) const {
  std::vector<std::string> emitters;
  std::vector<double> numbers, joules;
  std::vector<uint32_t> layers, sizes, ids;
  const auto add = [&](const Layer& layer) {
    sizes.push_back(static_cast<uint32_t>(layer.size()));
    ids.insert(ids.end(), layer.begin(), layer.end());
  };
  for (const auto& [emitter, pipe] : m_pipes) {
    emitters.push_back(emitter);
    eachNumber(pipe, [&](double number) { numbers.push_back(number); });
    layers.push_back(static_cast<uint32_t>(pipe.layers.size()));
    add(pipe.last);
    for (const Layer& layer : pipe.layers) add(layer);
  }
  writer.texts("flow/emitters", emitters);
  writer.array("flow/numbers", numbers);
  writer.array("flow/layers", layers);
  writer.array("flow/sizes", sizes);
  writer.array("flow/ids", ids);
  std::vector<uint64_t> counts;
  for (const FlowAmount* amount : {&m_born, &m_total.poured, &m_total.drained, &m_total.held}) {
    counts.push_back(amount->count);
    joules.insert(joules.end(), {amount->mass, amount->energy});
  }
  writer.array("flow/counts", counts);
  writer.array("flow/amounts", joules);
}

void MatterFlow::restore(const StateReader& reader, const ParticleStore& store) {
  const std::vector<std::string> emitters = reader.texts("flow/emitters");
  const std::vector<uint32_t> layers = reader.array<uint32_t>("flow/layers", emitters.size(), 1);
  StateRuns<double> numbers(reader, "flow/numbers");
  StateRuns<uint32_t> sizes(reader, "flow/sizes"), ids(reader, "flow/ids");
  const auto next = [&](bool held) {
    const std::span<const uint32_t> run = ids.next(sizes.next(1)[0]);
    const auto gone = [&](uint32_t id) { return id != kNone && store.indexOf(id) == store.size(); };
    if (held && std::any_of(run.begin(), run.end(), gone))
      StateReader::fail("flow/ids", "holds a particle that there is not");
    return Layer(run.begin(), run.end());
  };
  m_pipes.clear();
  for (size_t k = 0; k < emitters.size(); ++k) {
    Pipe& pipe = m_pipes[emitters[k]];
    eachNumber(pipe, [&](double& number) { number = numbers.next(1)[0]; });
    pipe.last = next(false);
    for (uint32_t layer = 0; layer < layers[k]; ++layer) pipe.layers.push_back(next(true));
  }
  numbers.done(), sizes.done(), ids.done();
  const std::vector<uint64_t> counts = reader.array<uint64_t>("flow/counts", 4, 1);
  const std::vector<double> amounts = reader.array<double>("flow/amounts", 8, 1);
  size_t k = 0;
  for (FlowAmount* amount : {&m_born, &m_total.poured, &m_total.drained, &m_total.held}) {
    *amount = {counts[k], amounts[2 * k], amounts[2 * k + 1]};
    ++k;
  }
}

void MatterFlow::requireLayers(const Project& project, std::span<const BakedMaterial> materials, double spacing) const {
  for (const auto& [id, pipe] : m_pipes) {
    const auto emitter = std::find_if(project.emitters.begin(), project.emitters.end(),
                                      [&, wanted = id](const Emitter& e) { return e.id == wanted; });
    if (emitter == project.emitters.end()) continue;  // steer() takes back what it held
    const auto diameter = numberOf(emitter->parameters, emitterParameters(), "diameter");
    if (pipe.point != emitter->point || pipe.direction != emitter->direction || pipe.diameter != diameter) continue;
    const size_t places = compileLayer(project, materials, *emitter, spacing, 0).position.size();
    const auto fits = [&](const Layer& layer) { return layer.size() == places; };
    if ((!pipe.last.empty() && !fits(pipe.last)) || !std::all_of(pipe.layers.begin(), pipe.layers.end(), fits))
      StateReader::fail("flow/sizes", "are not those of the mouth of '" + id + "'");
  }
}

}  // namespace ps
