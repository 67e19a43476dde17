// SPDX-License-Identifier: Apache-2.0
#include "core/io/projectcheck.h"

#include "core/base/nearest.h"
#include "core/io/projectfields.h"
#include "core/io/trackcheck.h"
#include "core/io/wallcheck.h"
#include "core/matter/material.h"
#include "core/matter/tags.h"
#include "core/parameters/wording.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/graphsource.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/probeparameters.h"
#include "core/simulation/sceneproblem.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

namespace ps {
namespace {

/// To four digits.
std::string shortText(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.4g", value);
  return numberText(std::strtod(digits, nullptr));
}

/// References, relations between keys, and sizes: what the schema of one key cannot say.
class ProjectChecker : public FieldVisitor {
 public:
  ProjectChecker(const Project& project, const std::string& name, const PluginRegistry& plugins,
                 std::vector<ProjectMessage>& warnings, std::vector<ProjectMessage>& problems)
      : m_project(project),
        m_name(name),
        m_plugins(plugins),
        m_fields(plugins),
        m_warnings(warnings),
        m_problems(problems) {}

  void run() { fields::projectFields().visit(m_project, "", *this); }

  /// Refuses a plugin of another kind; warns once per plugin that is not there.
  void plugin(std::optional<PluginKind> kind, const std::string& id, const std::string& pointer,
              const char* withoutIt) override {
    if (!m_plugins.has(id)) return warnMissing(id, pointer, withoutIt, kind);
    if (!kind) return;
    for (const PluginInfo& info : m_plugins.plugins()) {
      if (info.id != id || info.state != PluginInfo::State::Loaded || info.kind == *kind) continue;
      const auto words = [](PluginKind k) {
        return std::string(pluginKindName(k)) + (k == PluginKind::Thermal ? " model" : "");
      };
      fail(pointer, "'" + id + "' is a " + words(info.kind) + ", not a " + words(*kind));
    }
  }

  void material(const std::string& id, const std::string& pointer) override {
    if (!contains(m_project.materials, id)) fail(pointer, "the scene has no material '" + id + "'");
  }

  void address(const std::string& text, const std::string& pointer) override {
    const auto address = Address::parse(text);
    if (address && (findSet(m_project, *address) || outsideValue(m_project, *address))) return;
    if (address && address->owner == Owner::Probe && contains(m_project.probes, address->id)) return;
    warn(pointer, "the scene has no parameter '" + text + "'");
  }

  void colour(const std::string& name, const std::string& pointer) override {
    requireShown(name, colourNames(m_fields), pointer, "matter is shown in its own colours");
  }

  void quantity(const std::string& name, const std::string& pointer) override {
    requireShown(name, m_fields.quantityNames(), pointer, "the probe measures nothing");
  }

  void direction(const Vector3& v, const std::string& pointer) override {
    if (!(std::hypot(v[0], v[1], v[2]) > 1e-6)) {
      fail(pointer, "must have a direction: at least one part away from zero");
    }
  }

  void repeatedId(const std::string& id, const std::string& pointer) override {
    fail(pointer, "'" + id + "' is taken already");
  }

  void parameters(const ParameterSet& set, api::ParameterList list, const std::string& pointer) override {
    for (const auto& [key, value] : set.values) {
      const api::ParameterDeclaration* declaration = findDeclaration(list, key);
      const std::string problem = declaration ? problemOf(value, *declaration) : "";
      if (!problem.empty()) fail(pointer + "/" + key, problem);
    }
    if (list.first == propertyCatalogue().first) return;  // of the whole material, with what is installed: object()
    checkRules(set, list, pointer, [&](std::string_view key) -> std::optional<Value> {
      const api::ParameterDeclaration* declaration = findDeclaration(list, key);
      return declaration ? std::optional(valueOf(set, *declaration)) : std::nullopt;
    });
  }

  void pluginParameters(const std::string& id, const ParameterSet& set, const std::string& pointer) override {
    parameters(set, m_plugins.parameters(id), pointer);
  }

  void object(const SceneMaterial& source, const std::string& pointer) override {
    if (const auto wrong = problemOfTags(source.tags)) fail(at(pointer + "/tags", wrong->index), wrong->what);
    if (!m_plugins.material(source.base)) return;
    std::optional<Material> base = baseOf(source, pointer);
    if (!base) return;
    Material& material = *base;
    for (const auto& [key, value] : source.properties.values) material.properties[key] = responseOf(value);
    if (const std::string problem = problemOf(material); !problem.empty()) {
      const std::string key = problem.substr(0, problem.find_first_of(" :"));
      return tell(pointer + "/properties" + (propertyIndex(key) >= 0 ? "/" + key : ""), problem);
    }
    checkLaws(material, pointer);
    // A mixture states all that its parts do: nobody has set what does nothing as the scene is.
    const ParameterSet none, &set = source.mixture ? none : source.properties;
    checkRules(set, propertyCatalogue(), pointer + "/properties", [&](std::string_view key) -> std::optional<Value> {
      const auto found = material.properties.find(std::string(key));
      if (found != material.properties.end()) return found->second;
      const api::ParameterDeclaration* declaration = findDeclaration(propertyCatalogue(), key);
      return declaration ? std::optional(valueOf({}, *declaration)) : std::nullopt;
    });
  }

  void object(const VoxelShape& shape, const std::string& pointer) override {
    const int colours = static_cast<int>(shape.palette.size());
    for (size_t i = 0; i < shape.runs.size(); ++i) {
      if (shape.runs[i].palette >= colours) fail(at(pointer + "/runs", i) + "/4", "the palette has no such entry");
    }
    checkOverlaps(shape.runs, pointer + "/runs");
    for (size_t i = 0; i < shape.strokes.size(); ++i) {
      if (shape.strokes[i].stamp)
        checkOverlaps(shape.strokes[i].stamp->cells, at(pointer + "/strokes", i) + "/stamp/cells");
      if (shape.strokes[i].palette < colours) continue;
      fail(at(pointer + "/strokes", i) + "/palette", "the palette has no such entry");
    }
  }

  void object(const SceneMesh& mesh, const std::string& pointer) override {
    if (!m_meshes.insert(mesh.id).second) fail(pointer + "/id", "'" + mesh.id + "' is taken already");
    if (mesh.points.empty()) fail(pointer + "/points", "are none, or damaged; import the mesh again");
    if (mesh.triangles.empty()) fail(pointer + "/triangles", "are none, or damaged; import the mesh again");
    if (const std::string problem = problemOf(mesh); !problem.empty()) fail(pointer, problem);
  }

  void object(const SolidShape& solid, const std::string& pointer) override {
    const bool isMesh = choiceOf(solid.parameters, solidParameters(), "kind") == "mesh";
    if (isMesh && !solid.mesh) fail(pointer + "/mesh", "the scene has no mesh '" + solid.meshId + "'");
  }

  void object(const Region& region, const std::string& pointer) override {
    for (size_t a = 0; a < 3; ++a) {
      if (region.minimum[a] > region.maximum[a]) {
        fail(at(pointer + "/maximum", a), "must not be below the minimum, " + numberText(region.minimum[a]) + " m");
      }
    }
  }

  void object(const Body& body, const std::string& pointer) override {
    checkMotion(body, pointer);
    constexpr const char* kSizes[] = {"/shape/box/size", "/shape/voxels/runs", "/shape/solid"};
    addParticles(body, pointer + kSizes[body.shape.index()]);
    checkWarmth(body, pointer);
  }

  void object(const Emitter& emitter, const std::string& pointer) override {
    if (contains(m_project.bodies, emitter.id)) {
      fail(pointer + "/id", "'" + emitter.id + "' is a body's already; its particles could not be told apart");
    }
    const Environment& environment = m_project.environment;
    for (size_t a = 0; a < 3; ++a) {
      if (emitter.point[a] < environment.boundsMinimum[a] || emitter.point[a] > environment.boundsMaximum[a]) {
        fail(at(pointer + "/point", a), "lies outside of the scene's bounds");
      }
    }
  }

  void object(const Sink& sink, const std::string& pointer) override {
    requireBox(sink.minimum, sink.maximum, pointer);
  }

  void object(const Environment& environment, const std::string& pointer) override {
    requireBox(environment.boundsMinimum, environment.boundsMaximum, pointer + "/bounds");
    for (size_t i = 0; i < environment.walls.size(); ++i) {
      for (const WallFinding& finding : findingsOf(m_project, environment.walls[i])) {
        const std::string place = at(pointer + "/walls", i) + finding.pointer;
        finding.refused ? fail(place, finding.what) : warn(place, finding.what);
      }
    }
    checkPeriods();
  }

  void object(const Probe& probe, const std::string& pointer) override {
    const std::string& body = probe.body;
    if (!body.empty() && !contains(m_project.bodies, body) && !contains(m_project.emitters, body)) {
      warn(pointer + "/body", "there is no body or emitter '" + body + "'; the probe measures nothing");
    }
    if (!probe.wall.empty() && !contains(m_project.environment.walls, probe.wall))
      warn(pointer + "/wall", "there is no wall '" + probe.wall + "'; the probe measures nothing");
    if (!probe.material.empty() && !contains(m_project.materials, probe.material))
      warn(pointer + "/material", "the scene has no material '" + probe.material + "'; the probe measures nothing");
    for (const auto& [key, what] : probeProblems(probe, m_fields)) fail(pointer + "/" + key, what);
  }

  void object(const Graph& graph, const std::string& pointer) override {
    for (size_t i = 0; i < graph.series.size(); ++i) {
      if (!GraphSource(graph.series[i], m_project, m_fields, &m_plugins))
        warn(at(pointer + "/series", i), "there is no '" + graph.series[i] + "' to plot; it is left out");
    }
    const bool ofField = graph.kind == Graph::Kind::Histogram || graph.kind == Graph::Kind::Profile;
    if (ofField) requireShown(graph.field, m_fields.names(), pointer + "/field", "the graph is empty");
    if (!graph.body.empty() && !contains(m_project.bodies, graph.body) && !contains(m_project.emitters, graph.body))
      warn(pointer + "/body", "there is no body or emitter '" + graph.body + "'; the graph is empty");
  }

  void object(const Track& track, const std::string& pointer) override {
    if (!m_tracked.insert(track.parameter).second)
      fail(pointer + "/parameter", "'" + track.parameter + "' has a track already; put all its keys into one");
    for (const TrackFinding& finding : findingsOf(m_project, track, m_plugins)) {
      const std::string place = pointer + finding.pointer;
      if (finding.weight == TrackFinding::Weight::Refused) fail(place, finding.what);
      if (finding.weight == TrackFinding::Weight::Mended) tell(place, finding.what);
      if (finding.weight == TrackFinding::Weight::Told) warn(place, finding.what);
    }
  }

  /// Each is unpacked and forgotten: what all of them may take together is known before any memory is.
  void object(const PackedBlock& block, const std::string& pointer) override {
    if (block.name.empty()) fail(pointer + "/name", "must not be empty");
    if (!m_blocks.insert(block.name).second) fail(pointer + "/name", "'" + block.name + "' is taken already");
    try {
      m_stateBytes += unpackBlock(block, kMostPackedBytes - m_stateBytes).size();
    } catch (const InputError& problem) {
      fail(pointer + "/data", "the block '" + block.name + "' " + problem.what());
    }
  }

 private:
  static std::string at(const std::string& list, size_t index) { return list + "/" + std::to_string(index); }

  [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
    throw InputError(m_name + ":" + pointer + ": " + what);
  }

  /// Of what keeps a scene from being made, and can be mended value by value.
  void tell(const std::string& pointer, const std::string& what) {
    m_problems.push_back({true, m_name + ":" + pointer + ": " + what});
  }

  void warn(const std::string& pointer, const std::string& what) {
    m_warnings.push_back({false, m_name + ":" + pointer + ": " + what});
  }

  void warnMissing(const std::string& id, const std::string& pointer, const std::string& withoutIt,
                   std::optional<PluginKind> kind) {
    if (!m_missing.insert(id).second) return;
    std::vector<std::string> installed;
    for (const PluginInfo& info : m_plugins.plugins()) {
      if (info.state == PluginInfo::State::Loaded && (!kind || info.kind == *kind)) installed.push_back(info.id);
    }
    std::string reason = "is not installed" + didYouMean(id, installed);
    for (const PluginInfo& info : m_plugins.plugins()) {
      if (info.id == id && !info.problem.empty()) reason = "cannot be used (" + info.problem + ")";
    }
    warn(pointer, "the plugin '" + id + "' " + reason + "; " + withoutIt);
    m_warnings.back().plugin = id;
  }

  /// A slip is refused; what may be a field of a plugin that is not there is kept.
  void requireShown(const std::string& name, const std::vector<std::string>& known, const std::string& pointer,
                    const char* withoutIt) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    if (name.find('.') == std::string::npos && m_missing.empty()) {
      fail(pointer, mustBeOneOf(name, known));
    }
    warn(pointer, "no installed plugin has a field for '" + name + "'" + didYouMean(name, known) + "; " + withoutIt);
  }

  template <class List>
  static bool contains(const List& list, const std::string& id) {
    return std::any_of(list.begin(), list.end(), [&](const auto& item) { return item.id == id; });
  }

  /// The installed material with its plugin's laws at the scene's own parameters, as the engine will take it.
  /// Nothing, and that is told, where its law fails.
  std::optional<Material> baseOf(const SceneMaterial& source, const std::string& pointer) {
    if (!m_plugins.materialPlugin(source.base)) return *m_plugins.material(source.base);
    try {
      return m_plugins.evaluated(source.base, numbersOf(source.parameters, m_plugins.parameters(source.base)));
    } catch (const Error& error) {
      tell(pointer + "/parameters", error.what());
      return std::nullopt;
    }
  }

  /// Laws that leave their property's range at a temperature that the scene has, where their phase exists.
  void checkLaws(const Material& material, const std::string& pointer) {
    const double pressure = numberOf(m_project.environment.parameters, environmentParameters(), "ambient_pressure");
    const BakedMaterial baked(material, pressure);
    for (const HeldRange& held : baked.heldRanges()) {
      const api::ParameterDeclaration& property = propertyCatalogue()[static_cast<size_t>(held.property)];
      std::optional<double> farthest;
      for (const double t : temperatures()) {
        if (!held.contains(t) || !existsAt(material, property.key, t)) continue;
        farthest = farthest ? held.farther(*farthest, t) : t;
      }
      if (!farthest) continue;
      warn(pointer + "/properties/" + property.key,
           "its law gives " + shortText(valueOf(material, property.key, *farthest)) + " " + property.unit + " at " +
               shortText(*farthest) + " K, which this scene has; " + numberText(held.used) +
               " is used there. Change the law, or draw a curve");
    }
  }

  /// K, that matter has at the start or is heated or cooled to.
  std::vector<double> temperatures() const {
    std::vector<double> list;
    for (const Body& body : m_project.bodies) {
      if (const auto* voxels = std::get_if<VoxelShape>(&body.shape)) {
        for (const auto& paint : voxels->palette) list.push_back(paint.temperature);
      } else {
        list.push_back(numberOf(body.parameters, bodyParameters(), "temperature"));
      }
    }
    for (const Emitter& emitter : m_project.emitters)
      list.push_back(numberOf(emitter.parameters, emitterParameters(), "temperature"));
    for (const SceneWall& wall : m_project.environment.walls) {
      const std::string heat = choiceOf(wall.parameters, wallParameters(), "heat");
      if (heat == "fixed_temperature" || heat == "convective")
        list.push_back(numberOf(wall.parameters, wallParameters(), "temperature"));
    }
    return list;
  }

  /// What declarations say of each other's values; `own` of those of the list.
  void checkRules(const ParameterSet& set, api::ParameterList list, const std::string& pointer, const ValueOfKey& own) {
    const ValueOfKey values = [&](std::string_view key) {
      return key.find('/') == std::string_view::npos ? own(key) : sceneWideValue(m_project, key);
    };
    const DeclarationOfKey find = [&](std::string_view key) {
      return key.find('/') == std::string_view::npos ? findDeclaration(list, key) : sceneWideDeclaration(key);
    };
    if (const auto breach = firstBreach(list, values, find, true)) tell(pointer + "/" + breach->key, breach->sentence);
    if (const auto breach = firstBreach(list, values, find, false)) warn(pointer + "/" + breach->key, breach->sentence);
    for (const auto& [key, value] : set.values) {
      const api::ParameterDeclaration* declaration = findDeclaration(list, key);
      if (declaration && !holds(parseCondition(declaration->enabledWhen), values))
        warn(pointer + "/" + key, "does nothing as the scene is. " + actsWhenText(*declaration, find));
    }
  }

  void addParticles(const Body& body, const std::string& pointer) {
    const double spacing = numberOf(m_project.solver.parameters, solverParameters(), "particle_spacing");
    const double count = particleCount(body, spacing);
    const bool room = m_particles <= kMaximumParticles;
    m_particles += count;
    if (!room || m_particles <= kMaximumParticles) return;
    tell(pointer, "takes " + numberText(std::round(count)) + " particles, which makes more than the " +
                      numberText(kMaximumParticles) +
                      " that a scene may have; make it smaller or raise /solver/particle_spacing");
  }

  /// Two runs over one cell would make two particles in one place, which no force can part.
  void checkOverlaps(const std::vector<VoxelShape::Run>& runs, const std::string& pointer) const {
    std::vector<size_t> order(runs.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      return std::tie(runs[a].z, runs[a].y, runs[a].x, a) < std::tie(runs[b].z, runs[b].y, runs[b].x, b);
    });
    for (size_t i = 1; i < order.size(); ++i) {
      const VoxelShape::Run &left = runs[order[i - 1]], &right = runs[order[i]];
      if (left.z != right.z || left.y != right.y || right.x >= left.x + left.length) continue;
      const auto [earlier, later] = std::minmax(order[i - 1], order[i]);
      fail(at(pointer, later), "covers the cell " + std::to_string(right.x) + ", " + std::to_string(right.y) + ", " +
                                   std::to_string(right.z) + ", which run " + std::to_string(earlier) +
                                   " holds already; take it out of one of the two");
    }
  }

  void checkMotion(const Body& body, const std::string& pointer) {
    if (!toggleOf(body.parameters, bodyParameters(), "fixed")) return;
    if (body.velocityWave) {
      warn(pointer + "/velocity_wave", "a fixed body keeps its shape, the wave is left out; use velocity and spin");
    }
  }

  void requireBox(const Vector3& minimum, const Vector3& maximum, const std::string& pointer) const {
    for (size_t a = 0; a < 3; ++a) {
      if (minimum[a] >= maximum[a]) {
        fail(at(pointer + "/maximum", a), "must be above the minimum, " + numberText(minimum[a]) + " m");
      }
    }
  }

  void checkPeriods() {
    const auto solver = [&](const char* key) { return numberOf(m_project.solver.parameters, solverParameters(), key); };
    for (const auto& [axis, what] : periodProblems(m_project, solver("particle_spacing"), solver("support_ratio")))
      tell(at("/environment/bounds/maximum", axis), what);
  }

  void checkWarmth(const Body& body, const std::string& pointer) {
    const double spacing = numberOf(m_project.solver.parameters, solverParameters(), "particle_spacing");
    const double temperature = numberOf(body.parameters, bodyParameters(), "temperature");
    const std::string problem = m_particles > kMaximumParticles ? "" : coldProblem(body, temperature, spacing);
    if (!problem.empty()) tell(pointer + "/temperature_gradient", problem);
  }

  const Project& m_project;
  const std::string& m_name;
  const PluginRegistry& m_plugins;
  const ParticleFields m_fields;
  std::vector<ProjectMessage>&m_warnings, &m_problems;
  std::set<std::string> m_missing, m_blocks, m_meshes, m_tracked;
  double m_particles = 0;
  size_t m_stateBytes = 0;
};

}  // namespace

void checkProject(const Project& project, const std::string& name, const PluginRegistry& plugins,
                  std::vector<ProjectMessage>& warnings, std::vector<ProjectMessage>& problems) {
  ProjectChecker(project, name, plugins, warnings, problems).run();
}

}  // namespace ps
