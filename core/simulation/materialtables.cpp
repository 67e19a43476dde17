// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/materialtables.h"

#include "core/solver/solver.h"

#include <algorithm>
#include <utility>

namespace ps {
namespace {

/// Whether the same table comes of both.
bool alike(const Material& a, const Material& b) {
  return a.id == b.id && a.properties == b.properties && a.adheresTo == b.adheresTo;
}

std::array<float, 4> lookOf(const BakedMaterial& material) {
  constexpr const char* kKeys[] = {"color_red", "color_green", "color_blue", "clearness"};
  std::array<float, 4> look{};
  for (size_t c = 0; c < look.size(); ++c) look[c] = static_cast<float>(material.property(kKeys[c], 293.15));
  return look;
}

}  // namespace

bool MaterialTables::update(const Project& project, const PluginRegistry& plugins, Solver& solver,
                            const std::string& only) {
  const double pressure = compileThermal(project).ambientPressure;
  const size_t count = project.materials.size();
  const bool whole = only.empty() || pressure != m_pressure || m_tables.size() != count;
  EvaluatedMaterials evaluated = m_evaluated;
  std::vector<std::pair<size_t, Material>> sources;
  std::vector<BakedMaterial> baked;
  for (size_t k = 0; k < count; ++k) {
    if (!whole && project.materials[k].id != only) continue;
    Material source = compileMaterial(project, project.materials[k], plugins, evaluated);
    if (k < m_tables.size() && pressure == m_pressure && alike(source, m_sources[k])) continue;
    baked.emplace_back(source, pressure);
    sources.emplace_back(k, std::move(source));
  }
  // From here on nothing throws but a lack of memory.
  m_evaluated = std::move(evaluated);
  m_pressure = pressure;
  m_baked += baked.size();
  for (size_t b = 0; b < baked.size(); ++b) {
    const size_t k = sources[b].first;
    if (k >= m_tables.size()) {
      m_sources.push_back(std::move(sources[b].second));
      m_looks.push_back(lookOf(baked[b]));
      m_tables.push_back(std::move(baked[b]));
    } else {
      m_sources[k] = std::move(sources[b].second);
      m_looks[k] = lookOf(baked[b]);
      m_tables[k] = std::move(baked[b]);
    }
  }
  const size_t known = solver.materials().size();
  if (m_tables.size() > count) m_tables.erase(m_tables.begin() + static_cast<std::ptrdiff_t>(count), m_tables.end());
  m_sources.resize(count);
  m_looks.resize(count);
  if (known != count) {
    solver.setMaterials(m_tables);
  } else {
    for (const auto& [k, source] : sources) solver.setMaterial(k, m_tables[k]);
  }
  return known != count || !sources.empty();
}

bool MaterialTables::anyMelts() const {
  return std::any_of(m_tables.begin(), m_tables.end(),
                     [](const BakedMaterial& table) { return table.caloric().melts != 0; });
}

}  // namespace ps
