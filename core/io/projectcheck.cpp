// SPDX-License-Identifier: Apache-2.0
#include "core/io/projectcheck.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ps {
namespace {

constexpr double kMaximumParticles = 20e6;

class ProjectChecker {
 public:
  ProjectChecker(const Project& project, const std::string& name, const PluginRegistry& plugins,
                 std::vector<ProjectMessage>& warnings)
      : m_project(project), m_name(name), m_plugins(plugins), m_warnings(warnings) {}

  void run() {
    checkIds(m_project.materials, "/materials");
    checkIds(m_project.bodies, "/bodies");
    checkIds(m_project.environment.walls, "/environment/walls");
    checkIds(m_project.probes, "/probes");
    for (size_t i = 0; i < m_project.materials.size(); ++i) checkMaterial(m_project.materials[i], at("/materials", i));
    for (size_t i = 0; i < m_project.bodies.size(); ++i) checkBody(m_project.bodies[i], at("/bodies", i));
    checkEnvironment(m_project.environment);
    checkSolver(m_project.solver);
    for (size_t i = 0; i < m_project.probes.size(); ++i) {
      const std::string& body = m_project.probes[i].body;
      if (!body.empty() && !contains(m_project.bodies, body)) {
        fail(at("/probes", i) + "/body", "there is no body '" + body + "'");
      }
    }
    checkPinned();
    for (size_t i = 0; i < m_project.pluginsUsed.size(); ++i) {
      missing(m_project.pluginsUsed[i], at("/pluginsUsed", i), "what it does is left out");
    }
  }

 private:
  static std::string at(const std::string& list, size_t index) { return list + "/" + std::to_string(index); }

  [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
    throw InputError(m_name + ":" + pointer + ": " + what);
  }

  [[noreturn]] void failAt(const std::string& owner, const std::string& key, const std::string& what) const {
    fail(owner + "/" + key, what);
  }

  void warn(const std::string& pointer, const std::string& what) {
    m_warnings.push_back({false, m_name + ":" + pointer + ": " + what});
  }

  /// Warns once per plugin that is not there.
  void missing(const std::string& id, const std::string& pointer, const std::string& consequence) {
    if (m_plugins.has(id) || !m_missing.insert(id).second) return;
    std::string reason = "is not installed";
    for (const PluginInfo& info : m_plugins.plugins()) {
      if (info.id == id && !info.problem.empty()) reason = "cannot be used (" + info.problem + ")";
    }
    warn(pointer, "the plugin '" + id + "' " + reason + "; " + consequence);
  }

  template <class List>
  static bool contains(const List& list, const std::string& id) {
    return std::any_of(list.begin(), list.end(), [&](const auto& item) { return item.id == id; });
  }

  template <class List>
  void checkIds(const List& list, const std::string& pointer) const {
    std::set<std::string> seen;
    for (size_t i = 0; i < list.size(); ++i) {
      if (!seen.insert(list[i].id).second) fail(at(pointer, i) + "/id", "'" + list[i].id + "' is taken already");
    }
  }

  void checkSet(const ParameterSet& set, api::ParameterList list, const std::string& pointer) const {
    for (const auto& [key, value] : set.values) {
      const api::ParameterDeclaration* declaration = findDeclaration(list, key);
      const std::string problem = declaration ? problemOf(value, *declaration) : "";
      if (!problem.empty()) failAt(pointer, key, problem);
    }
  }

  void checkMaterial(const SceneMaterial& source, const std::string& pointer) {
    checkSet(source.properties, propertyCatalogue(), pointer + "/properties");
    if (const auto* plugin = m_plugins.materialPlugin(source.base)) {
      checkSet(source.parameters, plugin->parameters(), pointer + "/parameters");
    }
    const Material* installed = m_plugins.material(source.base);
    if (!installed) return missing(source.base, pointer + "/base", "bodies made of it stand still");
    Material material = *installed;
    for (const auto& [key, value] : source.properties.values) {
      const auto* response = std::get_if<Response>(&value);
      const auto* number = std::get_if<double>(&value);
      const auto* toggle = std::get_if<bool>(&value);
      material.properties[key] = response ? *response : Response(number ? *number : (toggle && *toggle) ? 1 : 0);
    }
    if (const std::string problem = problemOf(material); !problem.empty()) {
      const std::string key = problem.substr(0, problem.find_first_of(" :"));
      fail(pointer + "/properties" + (propertyIndex(key) >= 0 ? "/" + key : ""), problem);
    }
  }

  void checkMaterialExists(const std::string& id, const std::string& pointer) const {
    if (!contains(m_project.materials, id)) fail(pointer, "the scene has no material '" + id + "'");
  }

  void addParticles(double count, const std::string& pointer) {
    m_particles += count;
    if (m_particles <= kMaximumParticles) return;
    fail(pointer, "takes " + numberText(std::round(count)) + " particles, which makes more than the " +
                      numberText(kMaximumParticles) +
                      " that a scene may have; make it smaller or raise /solver/particle_spacing");
  }

  void checkBox(const BoxShape& box, const std::string& pointer) {
    const double spacing = numberOf(m_project.solver.parameters, solverParameters(), "particle_spacing");
    double count = 1;
    for (const double edge : box.size) count *= std::max(1.0, std::round(edge / spacing));
    addParticles(count, pointer + "/size");
  }

  void checkVoxels(const VoxelShape& shape, const std::string& pointer) {
    const int colours = static_cast<int>(shape.palette.size());
    for (size_t i = 0; i < shape.palette.size(); ++i) {
      checkMaterialExists(shape.palette[i].material, at(pointer + "/palette", i) + "/material");
    }
    const double spacing = numberOf(m_project.solver.parameters, solverParameters(), "particle_spacing");
    const double perCell = std::pow(shape.spacing / spacing, 3);
    double cells = 0;
    for (size_t i = 0; i < shape.runs.size(); ++i) {
      cells += perCell * shape.runs[i].length;
      if (shape.runs[i].palette >= colours) fail(at(pointer + "/runs", i) + "/4", "the palette has no such entry");
    }
    addParticles(cells, pointer + "/runs");
    for (size_t i = 0; i < shape.strokes.size(); ++i) {
      const std::string stroke = at(pointer + "/strokes", i);
      if (shape.strokes[i].palette >= colours) fail(stroke + "/palette", "the palette has no such entry");
      if (const auto* brush = m_plugins.brush(shape.strokes[i].brush)) {
        checkSet(shape.strokes[i].parameters, brush->parameters(), stroke + "/parameters");
      }
      missing(shape.strokes[i].brush, stroke + "/brush", "the stroke's cells are there, but it cannot be drawn again");
    }
  }

  void checkBody(const Body& body, const std::string& pointer) {
    checkMaterialExists(body.material, pointer + "/material");
    checkSet(body.parameters, bodyParameters(), pointer);
    if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
      checkBox(*box, pointer + "/shape/box");
    } else {
      checkVoxels(std::get<VoxelShape>(body.shape), pointer + "/shape/voxels");
    }
    for (size_t i = 0; i < body.constraints.size(); ++i) {
      const BodyConstraint& constraint = body.constraints[i];
      const std::string place = at(pointer + "/constraints", i);
      missing(constraint.plugin, place + "/plugin", "the body stands still");
      if (const auto* plugin = m_plugins.constraint(constraint.plugin)) {
        checkSet(constraint.parameters, plugin->parameters(), place + "/parameters");
      }
    }
  }

  void checkEnvironment(const Environment& environment) const {
    for (size_t a = 0; a < 3; ++a) {
      if (environment.boundsMinimum[a] >= environment.boundsMaximum[a]) {
        fail(at("/environment/bounds/maximum", a),
             "must be above the minimum, " + numberText(environment.boundsMinimum[a]) + " m");
      }
    }
    for (size_t i = 0; i < environment.walls.size(); ++i) {
      const Vec3& n = environment.walls[i].normal;
      if (!(std::hypot(n[0], n[1], n[2]) > 1e-6)) {
        fail(at("/environment/walls", i) + "/normal", "must have a direction: at least one part away from zero");
      }
    }
  }

  void checkSolver(const SolverOptions& solver) {
    if (solver.thermalModel.empty()) return;
    missing(solver.thermalModel, "/solver/thermal/model", "no heat flows");
    if (const auto* model = m_plugins.thermal(solver.thermalModel)) {
      checkSet(solver.thermalParameters, model->parameters(), "/solver/thermal/parameters");
    }
  }

  void checkPinned() {
    for (size_t i = 0; i < m_project.view.pinned.size(); ++i) {
      const auto address = Address::parse(m_project.view.pinned[i]);
      if (!address || !findSet(m_project, *address)) {
        warn(at("/view/pinned", i), "the scene has no parameter '" + m_project.view.pinned[i] + "'");
      }
    }
  }

  const Project& m_project;
  const std::string& m_name;
  const PluginRegistry& m_plugins;
  std::vector<ProjectMessage>& m_warnings;
  std::set<std::string> m_missing;
  double m_particles = 0;
};

}  // namespace

void checkProject(const Project& project, const std::string& name, const PluginRegistry& plugins,
                  std::vector<ProjectMessage>& warnings) {
  ProjectChecker(project, name, plugins, warnings).run();
}

}  // namespace ps
