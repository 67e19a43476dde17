// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/declared.h"

#include "core/base/error.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/declare.h"
#include "core/scene/shownname.h"
#include "core/simulation/probeparameters.h"
#include "core/simulation/rules.h"
#include "core/simulation/sceneproblem.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>

namespace ps {
namespace {

template <class Items>
auto itemById(Items& items, const std::string& id) {
  return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

const SceneMaterial* materialById(const Project& project, const std::string& id) {
  const auto found = itemById(project.materials, id);
  return found == project.materials.end() ? nullptr : &*found;
}

/// The installed material with the scene's own plugin parameters; nullopt when it is not installed or its law fails.
std::optional<Material> baseMaterial(const SceneMaterial& source, const PluginRegistry* plugins) {
  if (!plugins) return std::nullopt;
  if (plugins->materialPlugin(source.base)) {
    try {
      return plugins->evaluated(source.base, numbersOf(source.parameters, plugins->parameters(source.base)));
    } catch (const Error&) {
      return std::nullopt;  // the registry has noted the plugin's fault
    }
  }
  const Material* installed = plugins->material(source.base);
  return installed ? std::optional<Material>(*installed) : std::nullopt;
}

bool contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

Response responseFrom(const Value& value) {
  if (const auto* response = std::get_if<Response>(&value)) return *response;
  if (const auto* number = std::get_if<double>(&value)) return Response(*number);
  if (const auto* toggle = std::get_if<bool>(&value)) return Response(*toggle ? 1.0 : 0.0);
  return Response(0.0);
}

/// Guards the lists below, which are made when they are first asked for.
std::mutex g_lists;

/// Installed plugins, and those that the scene uses and lacks.
template <class Used>
std::vector<std::string> usable(std::vector<std::string> installed, const std::vector<Used>& used) {
  for (const Used& item : used) {
    if (!contains(installed, item.plugin)) installed.push_back(item.plugin);
  }
  return installed;
}

api::ParameterDeclaration pluginToggle(const char* prefix, const std::string& id, const char* group,
                                       const PluginRegistry* plugins, api::ActsAt when) {
  std::string label = id, help = "A plugin that is not installed.";
  for (const PluginInfo& info : plugins ? plugins->plugins() : std::vector<PluginInfo>{}) {
    if (info.id == id) label = info.label, help = info.help;
  }
  api::ParameterDeclaration d = declare::toggle({declare::kept(prefix + id), declare::kept(label), "", ""}, false,
                                                {group, declare::kept(help), "", ""});
  d.actsAt = when;
  return d;
}

/// What is installed decides on the choices, and so does a model that is not: each list made stays for good.
api::ParameterList sceneDeclarations(const Project& project, const PluginRegistry& plugins) {
  using Choices = std::array<std::vector<std::string>, 3>;
  static std::map<Choices, std::vector<api::ParameterDeclaration>> lists;
  std::vector<std::string> models = plugins.ids(PluginKind::Thermal);
  const std::string standard = plugins.standard(PluginKind::Thermal);
  const std::string& present = project.solver.thermalModel;
  if (!present.empty() && std::find(models.begin(), models.end(), present) == models.end()) models.push_back(present);
  const std::vector<std::string> sources = usable(plugins.ids(PluginKind::HeatSource), project.solver.heatSources);
  const std::lock_guard lock(g_lists);
  auto& list = lists[Choices{models, sources, {standard}}];
  if (list.empty()) {
    list = sceneParameters(models, standard);
    for (const std::string& id : sources)
      list.push_back(pluginToggle(kHeatSourceKey, id, "Heat", &plugins, api::ActsAt::NextFrame));
  }
  return {list.data(), list.size()};
}

api::ParameterDeclaration bodyMaterialParameter(const std::vector<std::string>& materials) {
  std::string choices;
  for (const std::string& id : materials) choices += (choices.empty() ? "" : "|") + id;
  return declare::atReset(declare::choice(
      {kBodyMaterialKey, "Made of", "", ""}, declare::kept(choices), 0,
      {"Matter", "The material of the body, one of the scene's.", "tin for a spoon that melts in soup", ""}));
}

/// As sceneDeclarations(), for one body.
api::ParameterList bodyDeclarations(const Project& project, const PluginRegistry* plugins, const std::string& id) {
  static std::map<std::array<std::vector<std::string>, 3>, std::vector<api::ParameterDeclaration>> lists;
  std::vector<std::string> choices, materials, neighbours;
  for (const SceneMaterial& material : project.materials) materials.push_back(material.id);
  if (plugins) {
    for (const std::string& plugin : plugins->ids(PluginKind::Constraint)) {
      (holdsTogether(plugin, plugins) ? choices : neighbours).push_back(plugin);
    }
  }
  const auto body = itemById(project.bodies, id);
  if (body != project.bodies.end()) {
    const std::string present = structureOf(*body, plugins);
    if (present != kNoStructure && std::find(choices.begin(), choices.end(), present) == choices.end())
      choices.push_back(present);
    for (const BodyConstraint& constraint : body->constraints) {  // one more that is not installed
      const std::string& plugin = constraint.plugin;
      if (plugins && plugin != present && !contains(neighbours, plugin) &&
          !contains(plugins->ids(PluginKind::Constraint), plugin))
        neighbours.push_back(plugin);
    }
  }
  const std::lock_guard lock(g_lists);
  auto& list = lists[{choices, materials, neighbours}];
  if (list.empty()) {
    for (const api::ParameterList& part : {bodyParameters(), bodyMotionParameters()}) {
      for (size_t i = 0; i < part.count; ++i) list.push_back(part[i]);
    }
    list.push_back(structureParameter(choices));
    if (!materials.empty()) list.push_back(bodyMaterialParameter(materials));
    for (const std::string& plugin : neighbours)
      list.push_back(pluginToggle(kNeighbourKey, plugin, "Structure", plugins, api::ActsAt::NextReset));
  }
  return {list.data(), list.size()};
}

/// As sceneDeclarations(): toggles of one material for all others.
api::ParameterList adhesionDeclarations(const Project& project, const std::string& id) {
  static std::map<std::vector<std::array<std::string, 2>>, std::vector<api::ParameterDeclaration>> lists;
  std::vector<std::array<std::string, 2>> others;
  if (!materialById(project, id)) return {};
  for (const SceneMaterial& other : project.materials) {
    if (other.id != id) others.push_back({other.id, shownName(other)});
  }
  const std::lock_guard lock(g_lists);
  auto& list = lists[others];
  for (size_t k = list.size(); k < others.size(); ++k) {
    list.push_back(declare::toggle(
        {declare::kept(kAdheresKey + others[k][0]), declare::kept("Holds on to " + others[k][1]), "", ""}, false,
        {"Phase change",
         "Whether the two grow together where one of them freezes beside the other as a solid. It is enough that one "
         "of the two says so. What is dry on both sides is never joined by it.",
         "wax in a glass: yes; iron poured on sand: no", ""}));
  }
  return {list.data(), list.size()};
}

/// As sceneDeclarations(), for probes: what they may see, and where.
api::ParameterList probeDeclarations(const Project& project, const PluginRegistry* plugins) {
  static std::map<std::vector<std::string>, std::vector<api::ParameterDeclaration>> lists;
  const ParticleFields fields = plugins ? ParticleFields(*plugins) : ParticleFields();
  const std::lock_guard lock(g_lists);
  std::vector<api::ParameterDeclaration> made = probeParameters(project, fields);
  std::vector<std::string> key;
  for (const api::ParameterDeclaration& d : made)
    key.push_back(d.choices + std::to_string(d.minimum) + '|' + std::to_string(d.maximum));
  const auto& list = lists.emplace(std::move(key), std::move(made)).first->second;
  return {list.data(), list.size()};
}

const Probe* probeById(const Project& project, const Address& address) {
  const auto probe = itemById(project.probes, address.id);
  return address.owner == Owner::Probe && probe != project.probes.end() ? &*probe : nullptr;
}

}  // namespace

std::string adhesionPartner(const Address& address) {
  return address.owner == Owner::Material && address.key.starts_with(kAdheresKey)
             ? address.key.substr(std::string_view(kAdheresKey).size())
             : std::string();
}

std::vector<std::string> namedInScene(const Project& project, const std::vector<std::string>& named) {
  std::vector<std::string> ids;
  for (const SceneMaterial& m : project.materials) {
    const bool byBase = contains(named, m.base) && !materialById(project, m.base);
    if (contains(named, m.id) || byBase) ids.push_back(m.id);
  }
  return ids;
}

std::vector<std::string> namedByInstalled(const Project& project, const std::vector<std::string>& named) {
  std::vector<std::string> ids;
  for (const SceneMaterial& m : project.materials) {
    if (contains(named, m.id) || contains(named, m.base)) ids.push_back(m.id);
  }
  return ids;
}

bool holdsTogether(const std::string& id, const PluginRegistry* plugins) {
  const auto plugin = plugins ? plugins->constraintForm(id) : std::nullopt;
  return !plugin || !std::holds_alternative<const api::NeighbourPlugin*>(*plugin);
}

std::string frozenStructure(const PluginRegistry& plugins) {
  for (const std::string& id : plugins.ids(PluginKind::Constraint)) {
    const api::ConstraintPlugin* plugin = plugins.constraint(id);
    if (plugin && plugin->extension(api::kHoldsFrozen)) return id;
  }
  return {};
}

bool uses(const Body& body, const std::string& plugin) {
  return std::any_of(body.constraints.begin(), body.constraints.end(),
                     [&](const BodyConstraint& constraint) { return constraint.plugin == plugin; });
}

std::string structureOf(const Body& body, const PluginRegistry* plugins) {
  for (const BodyConstraint& constraint : body.constraints) {
    if (holdsTogether(constraint.plugin, plugins)) return constraint.plugin;
  }
  return kNoStructure;
}

api::ParameterList declarationsOf(const Project& project, const PluginRegistry* plugins, const Address& address) {
  const auto of = [&](const std::string& id) { return plugins ? plugins->parameters(id) : api::ParameterList{}; };
  switch (address.owner) {
    case Owner::Environment:
      return environmentParameters();
    case Owner::Solver:
      return solverParameters();
    case Owner::Wall:
      return wallParameters();
    case Owner::Emitter:
      return emitterParameters();
    case Owner::Sink:
      return sinkParameters();
    case Owner::Shape:
      return solidParameters();
    case Owner::Body:
      return bodyDeclarations(project, plugins, address.id);
    case Owner::Scene:
      return plugins ? sceneDeclarations(project, *plugins) : api::ParameterList{};
    case Owner::Thermal:
      return of(project.solver.thermalModel);
    case Owner::Constraint:
      return of(address.plugin);
    case Owner::HeatSource:
      return of(address.id);
    case Owner::Probe:
      return probeDeclarations(project, plugins);
    case Owner::Material:
      break;
  }
  if (propertyIndex(address.key) >= 0) return propertyCatalogue();
  if (!adhesionPartner(address).empty()) return adhesionDeclarations(project, address.id);
  const SceneMaterial* material = materialById(project, address.id);
  return material ? of(material->base) : api::ParameterList{};
}

const api::ParameterDeclaration* declarationOf(const Project& project, const PluginRegistry* plugins,
                                               const Address& address) {
  if (address.owner == Owner::Body) {  // what all bodies have says nothing of what is installed
    for (const api::ParameterList& list : {bodyParameters(), bodyMotionParameters()}) {
      if (const api::ParameterDeclaration* found = findDeclaration(list, address.key)) return found;
    }
  }
  return findDeclaration(declarationsOf(project, plugins, address), address.key);
}

Value conformed(Value value, const api::ParameterDeclaration& declaration) {
  if (declaration.kind == api::ParameterKind::Response) return responseFrom(value);
  if (const auto* response = std::get_if<Response>(&value)) value = response->at(293.15);
  if (declaration.kind == api::ParameterKind::Toggle) {
    if (const auto* number = std::get_if<double>(&value)) return *number > 0.5;
  }
  return value;
}

Value defaultOf(const Project& project, const PluginRegistry* plugins, const Address& address) {
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (!declaration) return 0.0;
  if (address.owner == Owner::Body && address.key == kBodyMaterialKey) return valueAt(project, plugins, address);
  if (const std::string other = adhesionPartner(address); !other.empty()) {
    const SceneMaterial* source = materialById(project, address.id);
    const Material* installed = source && plugins ? plugins->material(source->base) : nullptr;
    return installed && contains(namedByInstalled(project, installed->adheresTo), other);
  }
  if (address.owner == Owner::Material && propertyIndex(address.key) >= 0) {
    if (const SceneMaterial* material = materialById(project, address.id)) {
      if (const auto base = baseMaterial(*material, plugins)) {
        const auto found = base->properties.find(address.key);
        if (found != base->properties.end()) return conformed(found->second, *declaration);
      }
    }
  }
  return conformed(valueOf({}, *declaration), *declaration);
}

Value valueAt(const Project& project, const PluginRegistry* plugins, const Address& address) {
  if (const std::optional<Value> outside = outsideValue(project, address)) return *outside;
  if (const Probe* probe = probeById(project, address))
    return probeValue(*probe, address.key, project.environment).value_or(0.0);
  if (address.owner == Owner::Body && address.key == kStructureKey) {
    const auto body = itemById(project.bodies, address.id);
    return body == project.bodies.end() ? std::string(kNoStructure) : structureOf(*body, plugins);
  }
  if (const std::string plugin = pluginBehind(address.key, kNeighbourKey);
      address.owner == Owner::Body && !plugin.empty()) {
    const auto body = itemById(project.bodies, address.id);
    return body != project.bodies.end() && uses(*body, plugin);
  }
  if (address.owner == Owner::Body && address.key == kBodyMaterialKey) {
    const auto body = itemById(project.bodies, address.id);
    return body == project.bodies.end() ? std::string() : body->material;
  }
  const SceneMaterial* material = address.owner == Owner::Material ? materialById(project, address.id) : nullptr;
  if (const std::string other = adhesionPartner(address); material && material->adheresTo && !other.empty())
    return contains(namedInScene(project, *material->adheresTo), other);
  const ParameterSet* set = findSet(project, address);
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (set && declaration) {
    const auto found = set->values.find(address.key);
    if (found != set->values.end()) return conformed(found->second, *declaration);
  }
  return defaultOf(project, plugins, address);
}

ParameterSet materialDefaults(const Project& project, const PluginRegistry* plugins, const std::string& id) {
  ParameterSet defaults;
  const SceneMaterial* material = materialById(project, id);
  if (!material) return defaults;
  const auto base = baseMaterial(*material, plugins);
  if (!base) return defaults;
  for (const auto& [key, response] : base->properties) {
    if (const auto* declaration = findDeclaration(propertyCatalogue(), key)) {
      defaults.values[key] = conformed(response, *declaration);
    }
  }
  return defaults;
}

std::string problemWith(const Project& project, const PluginRegistry* plugins, const Address& address,
                        const Value& value) {
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, address);
  if (!declaration) return "Nothing declares this value; its plugin may be missing.";
  if (const std::string problem = problemOf(value, *declaration); !problem.empty()) {
    return std::string(declaration->label) + " " + problem + ".";
  }
  if (const std::string problem = problemOfSceneWith(project, plugins, address, value); !problem.empty())
    return problem + ".";
  if (address.owner != Owner::Material || propertyIndex(address.key) < 0)
    return problemOfRelations(project, plugins, address, value);
  const SceneMaterial* source = materialById(project, address.id);
  auto material = source ? baseMaterial(*source, plugins) : std::nullopt;
  if (!material) return {};
  for (const auto& [key, changed] : source->properties.values) material->properties[key] = responseFrom(changed);
  const std::string wrongBefore = problemOf(*material);
  material->properties[address.key] = responseFrom(value);
  const std::string problem = problemOf(*material), key = problem.substr(0, problem.find(':'));
  const int index = propertyIndex(key);
  if (index < 0) return problem;
  // What was wrong before, of a project that came so, is mended value by value.
  if (key != address.key && !wrongBefore.empty()) return {};
  return propertyCatalogue()[static_cast<size_t>(index)].label + problem.substr(key.size()) + ".";
}

std::vector<Address> parameterLists(const Project& project) {
  std::vector<Address> lists;
  const std::string property = propertyCatalogue().count > 0 ? propertyCatalogue()[0].key : "";
  for (const Body& body : project.bodies) {
    lists.push_back({Owner::Body, body.id, ""});
    if (std::holds_alternative<SolidShape>(body.shape)) lists.push_back({Owner::Shape, body.id, ""});
    for (const BodyConstraint& constraint : body.constraints)
      lists.push_back({Owner::Constraint, body.id, "", constraint.plugin});
  }
  for (const SceneMaterial& material : project.materials) {
    lists.push_back({Owner::Material, material.id, property});
    lists.push_back({Owner::Material, material.id, ""});
    if (project.materials.size() > 1) lists.push_back({Owner::Material, material.id, kAdheresKey + material.id});
  }
  for (const Emitter& emitter : project.emitters) lists.push_back({Owner::Emitter, emitter.id, ""});
  for (const Sink& sink : project.sinks) lists.push_back({Owner::Sink, sink.id, ""});
  for (const SceneWall& wall : project.environment.walls) lists.push_back({Owner::Wall, wall.id, ""});
  for (const Owner owner : {Owner::Scene, Owner::Environment, Owner::Solver, Owner::Thermal})
    lists.push_back({owner, "", ""});
  for (const UsedHeatSource& source : project.solver.heatSources)
    lists.push_back({Owner::HeatSource, source.plugin, ""});
  return lists;
}

std::vector<Address> allAddresses(const Project& project, const PluginRegistry* plugins) {
  std::vector<Address> addresses;
  for (const Address& any : parameterLists(project)) {
    const api::ParameterList list = declarationsOf(project, plugins, any);
    for (size_t i = 0; i < list.count; ++i) addresses.push_back({any.owner, any.id, list[i].key, any.plugin});
  }
  return addresses;
}

}  // namespace ps
