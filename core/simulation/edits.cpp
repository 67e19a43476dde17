// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/edits.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace ps {
namespace {

/// What a project says outside of its parameter sets.
When writeOutside(Project& project, const SetParameter& edit, const Value& old, Touched& touched,
                  std::vector<UndoEdit>& undo) {
  const Address& address = edit.address;
  const Vector3 gravity = project.environment.gravity;  // its direction is lost where it is 0
  if (!setOutsideValue(project, address, edit.value)) return When::Never;
  undo.push_back([address, old, gravity](Project& p) {
    setOutsideValue(p, address, old);
    p.environment.gravity = gravity;
  });
  if (address.owner == Owner::Body) {
    touched.owners.insert(Owner::Body);
    return When::IfFixed;
  }
  touched.owners.insert(address.key == "gravity" ? Owner::Solver : Owner::Thermal);
  return When::NextFrame;
}

auto byId(const std::vector<SceneMaterial>& materials, const std::string& id) {
  return std::find_if(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id; });
}

}  // namespace

When writeValue(Project& project, const SetParameter& edit, Touched& touched, std::vector<UndoEdit>& undo) {
  const Address& address = edit.address;
  if (const std::optional<Value> old = outsideValue(project, address)) {
    return writeOutside(project, edit, *old, touched, undo);
  }
  ParameterSet* set = findSet(project, address);
  if (!set) return When::Never;
  undo.push_back([address, before = *set](Project& p) { *findSet(p, address) = before; });
  set->values[address.key] = edit.value;
  constexpr std::string_view kLive[] = {"motion_start", "motion_stop", "heating_power", "surface_area"};  // of a body
  const bool live = std::find(std::begin(kLive), std::end(kLive), address.key) != std::end(kLive);
  if ((address.owner == Owner::Body && !live) || address.key == "particle_spacing") {
    touched.room = true;
    return When::NextReset;
  }
  touched.owners.insert(address.owner);
  if (address.owner == Owner::Material) touched.materials.insert(address.id);
  if (address.key == "ambient_pressure") touched.allMaterials = true;  // it moves melting and boiling points
  return When::NextFrame;
}

std::vector<SceneMaterial> inTheirPlaces(const std::vector<SceneMaterial>& living,
                                         const std::vector<SceneMaterial>& wanted) {
  std::vector<SceneMaterial> placed;
  for (const SceneMaterial& old : living) {
    const auto now = byId(wanted, old.id);
    placed.push_back(now == wanted.end() ? old : *now);
  }
  for (const SceneMaterial& material : wanted) {
    if (byId(living, material.id) == living.end()) placed.push_back(material);
  }
  return placed;
}

}  // namespace ps
