// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/materialtables.h"

#include "core/solver/solver.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace ps {
namespace {

/// Whether the same table comes of both.
bool alike(const Material& a, const Material& b) {
  return a.id == b.id && a.properties == b.properties && a.adheresTo == b.adheresTo;
}

const float* shareOf(std::string_view key, const ParticleStore& store) {
  if (key.ends_with("_solid") || key == "youngs_modulus") return store.solidFraction();
  return key.ends_with("_gas") ? store.gasFraction() : store.liquidFraction();
}

/// K, of the matter that is farthest in a range; nothing where no matter of that phase is in it.
std::optional<double> farthestIn(const HeldRange& held, std::string_view key, size_t material,
                                 const ParticleStore& store) {
  const float* share = shareOf(key, store);
  std::optional<double> farthest;
  for (size_t i = 0; i < store.size(); ++i) {
    const double t = store.temperature()[i];
    if (store.material()[i] != material || !(share[i] > 0) || !held.contains(t)) continue;
    farthest = farthest ? held.farther(*farthest, t) : t;
  }
  return farthest;
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

std::vector<Limit> MaterialTables::limits(const ParticleStore& store) const {
  std::vector<Limit> limits;
  for (size_t k = 0; k < m_tables.size(); ++k) {
    for (const HeldRange& held : m_tables[k].heldRanges()) {
      const api::ParameterDeclaration& property = propertyCatalogue()[static_cast<size_t>(held.property)];
      const std::optional<double> t = farthestIn(held, property.key, k, store);
      if (!t) continue;
      const double asked = valueOf(m_sources[k], property.key, *t);
      limits.push_back(
          {m_sources[k].id + "." + property.key, asked, held.used, property.unit, -1, std::array{held.from, held.to}});
    }
  }
  return limits;
}

bool MaterialTables::anyMelts() const {
  return std::any_of(m_tables.begin(), m_tables.end(),
                     [](const BakedMaterial& table) { return table.caloric().melts != 0; });
}

}  // namespace ps
