// SPDX-License-Identifier: Apache-2.0
#include "ui/session/transitions.h"

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "ui/document/document.h"

#include <cmath>
#include <limits>

namespace ps {
namespace {
constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
}

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
  if (matters) compute();
}

void Transitions::compute() {
  m_melts = m_boils = kNever;
  try {
    const PluginRegistry* plugins = m_document.plugins();
    const std::vector<Material> materials =
        plugins ? compileMaterials(m_document.project(), *plugins) : std::vector<Material>{};
    if (!materials.empty()) {
      const Environment& environment = m_document.project().environment;
      const BakedMaterial baked(materials.front(),
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
