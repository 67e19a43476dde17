// SPDX-License-Identifier: Apache-2.0
#include "ui/session/transitions.h"

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "ui/document/document.h"

#include <cmath>
#include <limits>
#include <set>

namespace ps {
namespace {
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

/// The index of the first material of which something is there, or pours in; of the first where nothing is.
size_t firstThere(const Project& project) {
  std::set<std::string> there;
  for (const Body& body : project.bodies) {
    there.insert(body.material);
    const auto* voxels = std::get_if<VoxelShape>(&body.shape);
    if (!voxels) continue;
    for (const VoxelShape::Paint& paint : voxels->palette) there.insert(paint.material);
  }
  for (const Emitter& tap : project.emitters) there.insert(tap.material);
  for (size_t k = 0; k < project.materials.size(); ++k) {
    if (there.contains(project.materials[k].id)) return k;
  }
  return 0;
}

}  // namespace

Transitions::Transitions(Document& document, QObject* parent)
    : QObject(parent), m_document(document), m_melts(kNever), m_boils(kNever) {
  connect(&document, &Document::changed, this, &Transitions::onChanged);
}

double Transitions::meltsOr(double fallback) const { return std::isfinite(m_melts) ? m_melts : fallback; }

void Transitions::onChanged(const ChangeEvent& event) {
  const auto* parameter = std::get_if<ParameterChanged>(&event);
  const bool matters =
      std::holds_alternative<ProjectOpened>(event) || std::holds_alternative<MaterialsChanged>(event) ||
      (parameter && (parameter->address.owner == Owner::Material || parameter->address.owner == Owner::Environment));
  // What is drawn, taken or poured may be the first of its material, or have been the last.
  const bool moves = std::holds_alternative<BodyChanged>(event) || std::holds_alternative<PortChanged>(event) ||
                     std::holds_alternative<StrokeChanged>(event);
  if (matters || (moves && firstThere(m_document.project()) != m_material)) compute();
}

void Transitions::compute() {
  m_melts = m_boils = kNever;
  m_material = firstThere(m_document.project());
  try {
    const PluginRegistry* plugins = m_document.plugins();
    const std::vector<Material> materials =
        plugins ? compileMaterials(m_document.project(), *plugins) : std::vector<Material>{};
    if (m_material < materials.size()) {
      const Environment& environment = m_document.project().environment;
      const BakedMaterial baked(materials[m_material],
                                numberOf(environment.parameters, environmentParameters(), "ambient_pressure"));
      if (baked.caloric().melts) m_melts = baked.caloric().meltingPoint;
      m_boils = baked.caloric().boilingPoint;
    }
  } catch (const Error&) {
    // Contradicting values: the engine says so; there are no marks.
  }
  Q_EMIT changed();
}

}  // namespace ps
