// SPDX-License-Identifier: Apache-2.0
#include "core/scene/address.h"

#include "core/matter/material.h"
#include "core/scene/project.h"

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

struct OwnerRow {
  Owner owner;
  std::string_view name;
  int idParts;  ///< between owner and key
};
constexpr OwnerRow kRows[] = {
    {Owner::Material, "material", 1},
    {Owner::Wall, "wall", 1},
    {Owner::Environment, "environment", 0},
    {Owner::Solver, "solver", 0},
    {Owner::Thermal, "thermal", 0},
    {Owner::Body, "body", 1},
    {Owner::Emitter, "emitter", 1},
    {Owner::Sink, "sink", 1},
    {Owner::Constraint, "constraint", 2},
    {Owner::Scene, "scene", 0},
    {Owner::HeatSource, "heat_source", 1},
    {Owner::Probe, "probe", 1},
    {Owner::Shape, "shape", 1},
};
static_assert(std::size(kRows) == std::size(kOwners));

template <class List>
auto* byId(List& list, std::string_view id) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.id == id; });
  return found == list.end() ? nullptr : &*found;
}

template <class P, class Set>
Set* setOf(P& project, const Address& address) {
  const auto parametersOf = [](auto* item) { return item ? &item->parameters : nullptr; };
  switch (address.owner) {
    case Owner::Environment:
      return &project.environment.parameters;
    case Owner::Solver:
      return &project.solver.parameters;
    case Owner::Thermal:
      return &project.solver.thermalParameters;
    case Owner::Material: {
      auto* material = byId(project.materials, address.id);
      if (!material) return nullptr;
      return propertyIndex(address.key) >= 0 ? &material->properties : &material->parameters;
    }
    case Owner::Wall:
      return parametersOf(byId(project.environment.walls, address.id));
    case Owner::Body:
      return parametersOf(byId(project.bodies, address.id));
    case Owner::Emitter:
      return parametersOf(byId(project.emitters, address.id));
    case Owner::Sink:
      return parametersOf(byId(project.sinks, address.id));
    case Owner::Constraint: {
      auto* body = byId(project.bodies, address.id);
      if (!body) return nullptr;
      for (auto& constraint : body->constraints) {
        if (constraint.plugin == address.plugin) return &constraint.parameters;
      }
      return nullptr;
    }
    case Owner::HeatSource: {
      for (auto& source : project.solver.heatSources) {
        if (source.plugin == address.id) return &source.parameters;
      }
      return nullptr;
    }
    case Owner::Shape: {
      auto* body = byId(project.bodies, address.id);
      auto* solid = body ? std::get_if<SolidShape>(&body->shape) : nullptr;
      return solid ? &solid->parameters : nullptr;
    }
    case Owner::Probe:  // what it measures is no parameter set
    case Owner::Scene:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

std::string_view ownerName(Owner owner) {
  return std::find_if(std::begin(kRows), std::end(kRows), [&](const OwnerRow& row) { return row.owner == owner; })
      ->name;
}

std::string Address::prefix() const {
  std::string text(ownerName(owner));
  for (const std::string* part : {&id, &plugin}) {
    if (!part->empty()) text += "/" + *part;
  }
  return text + "/";
}

std::string Address::text() const { return prefix() + key; }

std::optional<Address> Address::parse(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  const auto row =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const OwnerRow& r) { return r.name == parts[0]; });
  if (row == std::end(kRows) || parts.size() != static_cast<size_t>(row->idParts) + 2) return std::nullopt;
  if (std::any_of(parts.begin(), parts.end(), [](const std::string& p) { return p.empty(); })) return std::nullopt;
  Address address{row->owner, "", parts.back()};
  if (row->idParts > 0) address.id = parts[1];
  if (row->idParts > 1) address.plugin = parts[2];
  return address;
}

ParameterSet* findSet(Project& project, const Address& address) {
  return setOf<Project, ParameterSet>(project, address);
}

const ParameterSet* findSet(const Project& project, const Address& address) {
  return setOf<const Project, const ParameterSet>(project, address);
}

}  // namespace ps
