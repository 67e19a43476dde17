// SPDX-License-Identifier: Apache-2.0
#include "core/matter/material.h"
#include "core/scene/project.h"

#include <algorithm>

namespace ps {
namespace {

/// Number of parts between owner and key, or -1 for an unknown owner.
int idParts(std::string_view owner) {
  if (owner == "environment" || owner == "solver" || owner == "thermal" || owner == "scene") return 0;
  if (owner == "material" || owner == "wall" || owner == "body" || owner == "emitter" || owner == "sink") {
    return 1;
  }
  return owner == "constraint" ? 2 : -1;
}

template <class List>
auto* byId(List& list, std::string_view id) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& item) { return item.id == id; });
  return found == list.end() ? nullptr : &*found;
}

template <class P, class Set>
Set* setOf(P& project, const Address& address) {
  if (address.owner == "environment") return &project.environment.parameters;
  if (address.owner == "solver") return &project.solver.parameters;
  if (address.owner == "thermal") return &project.solver.thermalParameters;
  if (address.owner == "material") {
    auto* material = byId(project.materials, address.id);
    if (!material) return nullptr;
    return propertyIndex(address.key) >= 0 ? &material->properties : &material->parameters;
  }
  if (address.owner == "wall") {
    auto* wall = byId(project.environment.walls, address.id);
    return wall ? &wall->parameters : nullptr;
  }
  if (address.owner == "body") {
    auto* body = byId(project.bodies, address.id);
    return body ? &body->parameters : nullptr;
  }
  if (address.owner == "emitter") {
    auto* emitter = byId(project.emitters, address.id);
    return emitter ? &emitter->parameters : nullptr;
  }
  if (address.owner == "sink") {
    auto* sink = byId(project.sinks, address.id);
    return sink ? &sink->parameters : nullptr;
  }
  if (address.owner != "constraint") return nullptr;
  const size_t slash = address.id.find('/');
  auto* body = byId(project.bodies, std::string_view(address.id).substr(0, slash));
  if (!body || slash == std::string::npos) return nullptr;
  const std::string_view plugin = std::string_view(address.id).substr(slash + 1);
  for (auto& constraint : body->constraints) {
    if (constraint.plugin == plugin) return &constraint.parameters;
  }
  return nullptr;
}

}  // namespace

std::string Address::text() const { return id.empty() ? owner + "/" + key : owner + "/" + id + "/" + key; }

std::optional<Address> Address::parse(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  const int ids = idParts(parts[0]);
  if (ids < 0 || parts.size() != static_cast<size_t>(ids) + 2) return std::nullopt;
  if (std::any_of(parts.begin(), parts.end(), [](const std::string& p) { return p.empty(); })) return std::nullopt;
  Address address{parts[0], "", parts.back()};
  if (ids > 0) address.id = parts[1];
  if (ids > 1) address.id += "/" + parts[2];
  return address;
}

ParameterSet* findSet(Project& project, const Address& address) {
  return setOf<Project, ParameterSet>(project, address);
}

const ParameterSet* findSet(const Project& project, const Address& address) {
  return setOf<const Project, const ParameterSet>(project, address);
}

}  // namespace ps
