// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/sharedrows.h"

#include "core/simulation/declared.h"
#include "ui/document/document.h"
#include "ui/panels/rowmodels.h"

#include <algorithm>
#include <unordered_map>

namespace ps {
namespace {

Address withId(Address address, const std::string& id) {
  address.id = id;
  return address;
}

bool moveAlike(const Body& a, const Body& b) {
  return a.velocity == b.velocity && a.spin == b.spin && a.temperatureGradient == b.temperatureGradient;
}

}  // namespace

bool SharedRows::isOf(const Address& address, const Address& thing) {
  const bool ofBody = address.owner == Owner::Shape || address.owner == Owner::Constraint;
  return address.id == thing.id && (ofBody ? Owner::Body : address.owner) == thing.owner;
}

SharedRows::SharedRows(const Document& document, const std::vector<Address>& things)
    : m_document(document), m_things(things) {
  if (things.empty() || things.front().owner != Owner::Body) return;
  std::unordered_map<std::string, const Body*> byId;
  for (const Body& body : document.project().bodies) byId.emplace(body.id, &body);
  for (const Address& thing : things) {
    const auto body = byId.find(thing.id);
    m_bodies.push_back(body == byId.end() ? nullptr : body->second);
  }
  m_movesAlike = std::all_of(m_bodies.begin(), m_bodies.end(), [this](const Body* body) {
    return body && m_bodies.back() && moveAlike(*body, *m_bodies.back());
  });
}

/// Nothing where its values lie elsewhere too, or what is declared differs from thing to thing.
const SharedRows::Sets* SharedRows::setsOf(const Address& row) {
  const Owner owner = row.owner;
  const bool plain = owner == Owner::Shape || owner == Owner::Constraint || owner == Owner::Wall ||
                     owner == Owner::Emitter || owner == Owner::Sink ||
                     (owner == Owner::Body && findDeclaration(bodyParameters(), row.key));
  if (!plain) return nullptr;
  const auto [known, isNew] = m_sets.try_emplace({owner, row.plugin});
  if (isNew) {
    for (size_t k = 0; k < m_things.size(); ++k) known->second.push_back(setOf(row, k));
  }
  return &known->second;
}

const ParameterSet* SharedRows::setOf(const Address& row, size_t thing) {
  if (m_bodies.empty()) {
    ++m_searches;
    return findSet(m_document.project(), withId(row, m_things[thing].id));
  }
  const Body* body = m_bodies[thing];
  if (!body) return nullptr;
  if (row.owner == Owner::Body) return &body->parameters;
  if (row.owner == Owner::Shape) {
    const auto* solid = std::get_if<SolidShape>(&body->shape);
    return solid ? &solid->parameters : nullptr;
  }
  for (const BodyConstraint& constraint : body->constraints) {
    if (constraint.plugin == row.plugin) return &constraint.parameters;
  }
  return nullptr;
}

bool SharedRows::allHave(const Address& row) {
  if (!hasRow(m_document, row)) return false;
  if (const Sets* sets = setsOf(row))
    return std::all_of(sets->begin(), sets->end(), [](const ParameterSet* set) { return set != nullptr; });
  // All bodies declare the same, but for choices, and for what acts between neighbours and is not installed.
  if (row.owner == Owner::Body && pluginBehind(row.key, kNeighbourKey).empty())
    return std::all_of(m_bodies.begin(), m_bodies.end(), [](const Body* body) { return body != nullptr; });
  return std::all_of(m_things.begin(), m_things.end(), [&](const Address& thing) {
    ++m_searches;
    return hasRow(m_document, withId(row, thing.id));
  });
}

template <class Same>
std::string SharedRows::find(const Same& same) {
  for (size_t k = 0; k + 1 < m_things.size(); ++k) {
    ++m_compared;
    if (!same(k)) return m_things[k].id;
  }
  return {};
}

/// Of what lies in no set of a body; nothing where there is no short way.
std::optional<std::string> SharedRows::differingBody(const Address& row) {
  const Body* own = m_bodies.back();
  if (!own || std::find(m_bodies.begin(), m_bodies.end(), nullptr) != m_bodies.end()) return std::nullopt;
  const PluginRegistry* plugins = m_document.plugins();
  if (row.key == kBodyMaterialKey) return find([&](size_t k) { return m_bodies[k]->material == own->material; });
  if (row.key == kStructureKey) {
    const std::string structure = structureOf(*own, plugins);
    return find([&](size_t k) { return structureOf(*m_bodies[k], plugins) == structure; });
  }
  if (const std::string plugin = pluginBehind(row.key, kNeighbourKey); !plugin.empty())
    return find([&](size_t k) { return uses(*m_bodies[k], plugin) == uses(*own, plugin); });
  return m_movesAlike ? std::optional(std::string()) : std::nullopt;
}

std::string SharedRows::differing(const Address& row) {
  const Value own = m_document.value(row);
  if (const Sets* sets = setsOf(row)) {
    const api::ParameterDeclaration* declaration = m_document.declaration(row);
    const Value standard = m_document.defaultValue(row);
    return find([&](size_t k) {
      const ParameterSet* set = (*sets)[k];
      if (!set || !declaration) return standard == own;
      const auto found = set->values.find(row.key);
      if (found == set->values.end()) return standard == own;
      return conformed(found->second, *declaration) == own;
    });
  }
  if (row.owner == Owner::Body) {
    if (const std::optional<std::string> found = differingBody(row)) return *found;
  }
  return find([&](size_t k) {
    ++m_searches;
    return m_document.value(withId(row, m_things[k].id)) == own;
  });
}

}  // namespace ps
