// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/toolmeter.h"

#include "core/math/vector.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr double kTouch = 1.5;  // spacings between centres

}  // namespace

void ToolMeter::add(uint32_t body) {
  auto known = std::find_if(m_tools.begin(), m_tools.end(), [&](const Tool& tool) { return tool.body == body; });
  if (known == m_tools.end()) {
    if (m_tools.size() == kHands) m_tools.pop_back();
    known = m_tools.insert(m_tools.end(), Tool{body, {}, {}, {}});
  }
  std::rotate(m_tools.begin(), known, known + 1);
}

std::vector<uint32_t> ToolMeter::bodies() const {
  std::vector<uint32_t> list;
  for (const Tool& tool : m_tools) list.push_back(tool.body);
  return list;
}

std::vector<ToolContact> ToolMeter::contacts(const std::vector<std::string>& bodyIds) const {
  std::vector<ToolContact> list;
  for (const Tool& tool : m_tools) {
    if (tool.body >= bodyIds.size()) continue;
    list.push_back(tool.contact);
    list.back().body = bodyIds[tool.body];
  }
  return list;
}

void ToolMeter::measure(const Solver& solver, double spacing) {
  if (m_tools.empty()) return;
  const double seconds = solver.thermalTime() - m_thermalTime;
  m_thermalTime = solver.thermalTime();
  for (Tool& tool : m_tools) measure(solver, spacing, seconds, tool);
}

/// Each particle of others that is within reach of one of the tool's, with the nearest of these.
void ToolMeter::findTouching(const Solver& solver, double reach, uint32_t body) {
  const ParticleStore& store = solver.particles();
  m_touching.clear();
  m_surface.clear();
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Vector3 low = Vector3::Constant(kNone), high = -low;
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] != body || store.motion()[i] != api::Motion::Static) continue;
    m_surface.push_back(i);
    const Vector3 place = vectorOf(store.position()[i]);
    low = low.cwiseMin(place), high = high.cwiseMax(place);
  }
  if (m_surface.empty()) return;
  low.array() -= reach, high.array() += reach;
  const auto placeOf = [&](uint32_t i) { return double3Of(vectorOf(store.position()[i])); };
  m_grid.sort(m_surface.size(), reach, {}, [&](size_t k) { return placeOf(m_surface[k]); });
  for (uint32_t i = 0; i < store.size(); ++i) {
    const api::Float4& p = store.position()[i];
    if (!(p.x > low.x() && p.x < high.x() && p.y > low.y() && p.y < high.y() && p.z > low.z() && p.z < high.z()))
      continue;
    if (store.body()[i] == body) continue;
    double nearest2 = reach * reach;
    uint32_t nearest = i;
    m_grid.around(placeOf(i), [&](uint32_t first, uint32_t last) {
      for (uint32_t slot = first; slot < last; ++slot) {
        const uint32_t j = m_surface[m_grid.order()[slot]];
        const double square = (vectorOf(p) - vectorOf(store.position()[j])).squaredNorm();
        if (square < nearest2) nearest2 = square, nearest = j;
      }
    });
    if (nearest != i && nearest2 > 0) m_touching.push_back({i, nearest, std::sqrt(nearest2)});
  }
}

void ToolMeter::measure(const Solver& solver, double spacing, double seconds, Tool& tool) {
  const ParticleStore& store = solver.particles();
  findTouching(solver, kTouch * spacing, tool.body);
  ToolContact& contact = tool.contact = {};
  const std::optional<Wrench> wrench = solver.forceOnBody(tool.body);
  if (wrench) contact.force = wrench->force;
  contact.behind = solver.leadLeft(tool.body);
  contact.touching = static_cast<uint32_t>(m_touching.size());
  LatentById latent;
  double taken = 0;
  for (const Touching& one : m_touching) {
    contact.gradient += (store.temperature()[one.particle] - store.temperature()[one.of]) / one.distance;
    const uint32_t id = store.id()[one.particle];
    const double joules = solver.latentHeat(one.particle);
    latent.emplace_back(id, joules);
    const auto before = std::lower_bound(tool.latent.begin(), tool.latent.end(), id,
                                         [](const auto& known, uint32_t wanted) { return known.first < wanted; });
    if (before != tool.latent.end() && before->first == id) taken += joules - before->second;
  }
  if (!m_touching.empty()) contact.gradient /= static_cast<double>(m_touching.size());
  std::sort(latent.begin(), latent.end());
  const double joules = solver.heatOfFixed(tool.body);
  if (tool.joules && seconds > 0) {
    contact.heat = (joules - *tool.joules) / seconds;
    contact.latent = taken / seconds;
  }
  tool.joules = joules;
  tool.latent = std::move(latent);
}

}  // namespace ps
