// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/edits.h"

#include "core/simulation/declared.h"

#include <algorithm>

namespace ps {
namespace {

/// What a project says outside of its parameter sets.
bool writeOutside(Project& project, const SetParameter& edit, const Value& old, std::vector<UndoEdit>& undo) {
  const Address& address = edit.address;
  const Vector3 gravity = project.environment.gravity;  // its direction is lost where it is 0
  if (!setOutsideValue(project, address, edit.value)) return false;
  undo.push_back([address, old, gravity](Project& p) {
    setOutsideValue(p, address, old);
    p.environment.gravity = gravity;
  });
  return true;
}

bool write(Project& project, const SetParameter& edit, std::vector<UndoEdit>& undo) {
  const Address& address = edit.address;
  if (const std::optional<Value> old = outsideValue(project, address)) return writeOutside(project, edit, *old, undo);
  ParameterSet* set = findSet(project, address);
  if (!set) return false;
  undo.push_back([address, before = *set](Project& p) { *findSet(p, address) = before; });
  set->values[address.key] = edit.value;
  return true;
}

auto byId(const std::vector<SceneMaterial>& materials, const std::string& id) {
  return std::find_if(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id; });
}

}  // namespace

void touch(const Address& address, Touched& touched) {
  const bool gravity = address.owner == Owner::Scene && address.key == "gravity";
  touched.owners.insert(gravity ? Owner::Solver : address.owner == Owner::Scene ? Owner::Thermal : address.owner);
  if (address.owner == Owner::Material) touched.materials.insert(address.id);
  if (address.key == "ambient_pressure") touched.allMaterials = true;  // it moves melting and boiling points
}

std::optional<api::ActsAt> writeValue(Project& project, const PluginRegistry& plugins, const SetParameter& edit,
                                      Touched& touched, std::vector<UndoEdit>& undo) {
  if (!write(project, edit, undo)) return std::nullopt;
  const api::ParameterDeclaration* declaration = declarationOf(project, &plugins, edit.address);
  const api::ActsAt when = declaration ? declaration->actsAt : api::ActsAt::NextFrame;
  if (when != api::ActsAt::NextReset) touch(edit.address, touched);
  return when;
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
