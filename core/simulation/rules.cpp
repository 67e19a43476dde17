// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/rules.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/sceneproblem.h"

namespace ps {
namespace {

bool isSceneWide(std::string_view key) { return key.find('/') != std::string_view::npos; }

Address sibling(const Address& address, std::string_view key) {
  return {address.owner, address.id, std::string(key), address.plugin};
}

DeclarationOfKey declarationsAround(const Project& project, const PluginRegistry* plugins, const Address& address) {
  return [&project, plugins, address](std::string_view key) {
    return isSceneWide(key) ? sceneWideDeclaration(key) : declarationOf(project, plugins, sibling(address, key));
  };
}

ValueOfKey valuesAround(const Project& project, const PluginRegistry* plugins, const Address& address) {
  return [&project, plugins, address](std::string_view key) -> std::optional<Value> {
    if (isSceneWide(key)) return sceneWideValue(project, key);
    const Address other = sibling(address, key);
    if (!declarationOf(project, plugins, other)) return std::nullopt;
    return valueAt(project, plugins, other);
  };
}

}  // namespace

std::string idleReason(const Project& project, const PluginRegistry* plugins, const Address& address) {
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (!declaration || !declaration->enabledWhen) return {};
  if (holds(parseCondition(declaration->enabledWhen), valuesAround(project, plugins, address))) return {};
  return actsWhenText(*declaration, declarationsAround(project, plugins, address));
}

bool mayEnable(const api::ParameterDeclaration& declaration, const Address& own, const Address& changed) {
  if (!declaration.enabledWhen) return false;
  const std::string sceneWide = changed.text();
  for (const Clause& clause : parseCondition(declaration.enabledWhen).clauses)
    if (isSceneWide(clause.key) ? clause.key == sceneWide : sibling(own, clause.key) == changed) return true;
  return false;
}

std::vector<std::string> rulesOf(const Project& project, const PluginRegistry* plugins, const Address& address) {
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (!declaration) return {};
  return ruleTexts(*declaration, declarationsAround(project, plugins, address));
}

std::string adviceOf(const Project& project, const PluginRegistry* plugins, const Address& address) {
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (!declaration || !declaration->relations) return {};
  const std::optional<Breach> breach = firstBreach(api::listOf(declaration, 1), valuesAround(project, plugins, address),
                                                   declarationsAround(project, plugins, address), false);
  if (!breach) return {};
  std::string sentence = breach->sentence + ".";
  if (sentence.front() == 's') sentence.front() = 'S';
  return sentence;
}

std::string problemOfRelations(const Project& project, const PluginRegistry* plugins, const Address& address,
                               const Value& value) {
  const ValueOfKey others = valuesAround(project, plugins, address);
  const ValueOfKey values = [&](std::string_view key) { return key == address.key ? value : others(key); };
  const DeclarationOfKey find = declarationsAround(project, plugins, address);
  const std::optional<Breach> breach =
      firstBreach(declarationsOf(project, plugins, address), values, find, true, address.key);
  return breach ? std::string(find(breach->key)->label) + ": " + breach->sentence + "." : std::string();
}

void requireRelations(const Project& project, const PluginRegistry& plugins) {
  for (const Address& owner : parameterLists(project)) {
    const api::ParameterList list = declarationsOf(project, &plugins, owner);
    if (list.first == propertyCatalogue().first) continue;
    const DeclarationOfKey find = declarationsAround(project, &plugins, owner);
    const std::optional<Breach> breach = firstBreach(list, valuesAround(project, &plugins, owner), find, true);
    if (!breach) continue;
    const std::string whose = owner.id.empty() ? std::string() : " of '" + owner.id + "'";
    throw SceneError(find(breach->key)->label + whose + ": " + breach->sentence, sibling(owner, breach->key));
  }
}

}  // namespace ps
