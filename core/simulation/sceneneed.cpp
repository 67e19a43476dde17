// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/sceneneed.h"

#include "core/matter/material.h"
#include "core/parameters/wording.h"
#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/restplaces.h"
#include "core/solver/footprint.h"
#include "core/solver/settings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <vector>

namespace ps {
namespace {

constexpr double kShare = 6.0 / 7;
constexpr const char* kSpacing = "particle_spacing";
/// Pa s, ten times water's: the implicit viscosity may be asked at fine spacings.
constexpr double kThick = 0.01;
/// Ties of a lattice reach its axial and face-diagonal neighbours.
constexpr double kTieReach = 1.5;

using Layers = std::array<double, 3>;
/// Of what has been poured.
constexpr Layers kDeep{16, 16, 16};

Layers layersOf(const Body& body, double spacing) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return {layersAlong(box->size[0], spacing), layersAlong(box->size[1], spacing), layersAlong(box->size[2], spacing)};
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const Vector3 size = SolidForm(*solid).size();
    return {layersAlong(size[0], spacing), layersAlong(size[1], spacing), layersAlong(size[2], spacing)};
  }
  const auto& voxels = std::get<VoxelShape>(body.shape);
  if (voxels.runs.empty()) return {1, 1, 1};
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Layers low{kNone, kNone, kNone}, high{-kNone, -kNone, -kNone};
  for (const VoxelShape::Run& run : voxels.runs) {
    const Layers first{double(run.x), double(run.y), double(run.z)};
    const Layers last{double(run.x) + run.length, double(run.y) + 1, double(run.z) + 1};
    for (size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], first[a]), high[a] = std::max(high[a], last[a]);
  }
  Layers layers;
  for (size_t a = 0; a < 3; ++a) layers[a] = layersAlong((high[a] - low[a]) * voxels.spacing, spacing);
  return layers;
}

bool isThick(const Project& project, const PluginRegistry& plugins, const std::string& id) {
  const auto source =
      std::find_if(project.materials.begin(), project.materials.end(), [&](const auto& m) { return m.id == id; });
  const Material* installed = source == project.materials.end() ? nullptr : plugins.material(source->base);
  if (!installed) return false;
  Material material{{}, {}, installed->properties, {}};
  for (const auto& [key, value] : source->properties.values) material.properties[key] = responseOf(value);
  const auto at = [&](const char* key, double temperature) { return valueOf(material, key, temperature); };
  const double melting = at("melting_temperature", 293.15);
  return at("viscosity", std::max(melting, 1.0)) > kThick || at("yield_stress", std::max(melting, 1.0)) > 0 ||
         at("solidus", 293.15) < at("liquidus", 293.15);
}

/// Ties of matter that is tied to all neighbours of its lattice; what is thin is tied over each particle, too.
double tiesOf(const Layers& layers, bool thin) {
  double ties = latticeNeighbours(layers, kTieReach) / 2;
  for (const double along : layers) ties += thin && along > 2 ? 1 : 0;
  return ties;
}

std::optional<double> toldCount(const api::ConstraintPlugin& plugin, std::span<const double> parameters) {
  const auto* count = static_cast<const api::StructureCount*>(plugin.extension(api::kStructureCount));
  if (!count) return std::nullopt;
  return std::max(0.0, count->perParticle({parameters.data(), parameters.size()}));
}

struct Held {
  StructureFootprint footprint;
  bool thin = false;
};

std::optional<Held> heldBy(const AnyConstraint& form, const Layers& layers, std::span<const double> parameters) {
  Held held;
  const std::optional<double> told = toldCount(commonOf(form), parameters);
  if (const auto* structural = std::get_if<const api::StructuralPlugin*>(&form)) {
    api::StructuralTraits traits;
    (*structural)->traits(&traits);
    held.thin = traits.thin != 0;
    held.footprint = {told.value_or(tiesOf(layers, held.thin)), traits.arity, traits.values.count, 0, 0};
    return held;
  }
  const auto* group = std::get_if<const api::GroupPlugin*>(&form);
  if (!group) return std::nullopt;
  api::GroupTraits traits;
  (*group)->traits(&traits);
  held.thin = traits.thin != 0;
  constexpr double kFewMembers = 4;
  held.footprint = {told.value_or(1), 0, traits.memberValues.count, 1 / kFewMembers, traits.values.count};
  return held;
}

double fieldBytesOf(const PluginRegistry& plugins) {
  double bytes = 0;
  for (const api::FieldDeclaration& field : plugins.fields()) {
    bytes += field.type == api::FieldType::Float4    ? 16
             : field.type == api::FieldType::Float64 ? 8
             : field.type == api::FieldType::UInt8   ? 1
                                                     : 4;
  }
  return bytes;
}

/// What a scene has in common for all its matter.
struct Common {
  Common(const Project& p, const PluginRegistry* registry, const SceneScale& s)
      : project(p), plugins(registry), scale(s) {
    matter.fieldBytes = plugins ? fieldBytesOf(*plugins) : 0;
    matter.walls = static_cast<double>(project.environment.walls.size());
    matter.heat = !project.solver.thermalModel.empty();
    const api::ThermalPlugin* model = plugins ? plugins->thermal(project.solver.thermalModel) : nullptr;
    matter.pairLaw = !model || model->extension(api::kPairRates);
    matter.radiation = toggleOf(project.environment.parameters, environmentParameters(), "radiation");
    nothingFlows = project.emitters.empty() &&
                   std::all_of(project.bodies.begin(), project.bodies.end(),
                               [](const Body& b) { return toggleOf(b.parameters, bodyParameters(), "fixed"); });
    implicit = choiceOf(project.solver.parameters, solverParameters(), "viscosity_model") != "xsph";
  }
  double bytesOf(const Body& body) const {
    MatterFootprint own = matter;
    own.dry = nothingFlows;
    const double rest = std::holds_alternative<VoxelShape>(body.shape) ? sizeof(RestPlaces::Place) : 0;
    return rest + bytesOf(own, body.material, layersOf(body, scale.spacing), body.constraints);
  }
  /// Of what is poured.
  double bytesOf(const std::string& material) const { return bytesOf(matter, material, kDeep, {}); }

  const Project& project;
  const PluginRegistry* plugins;
  SceneScale scale;
  MatterFootprint matter;
  bool implicit = true, nothingFlows = false;

 private:
  double bytesOf(MatterFootprint own, const std::string& material, const Layers& layers,
                 std::span<const BodyConstraint> constraints) const {
    std::vector<StructureFootprint> structures;
    bool thin = false;
    for (const BodyConstraint& c : constraints) {
      const auto form = plugins ? plugins->constraintForm(c.plugin) : std::nullopt;
      if (!form) continue;
      const auto held = heldBy(*form, layers, numbersOf(c.parameters, plugins->parameters(c.plugin)));
      if (!held) continue;
      structures.push_back(held->footprint);
      thin = thin || held->thin;
    }
    own.structures = structures;
    own.neighbours = listedNeighbours(layers, scale.reach + kSkinSpacings, thin);
    own.thick = implicit && plugins && isThick(project, *plugins, material);
    return bytesPerParticle(own);
  }
};

double pouredBy(const Emitter& emitter, double spacing) {
  const auto number = [&](const char* key) { return numberOf(emitter.parameters, emitterParameters(), key); };
  const double across = number("diameter") / spacing, layer = std::max(1.0, std::numbers::pi / 4 * across * across);
  const double layers = number("speed") * std::max(0.0, number("stop") - number("start")) / spacing;
  return std::min(number("most"), layer * layers);
}

/// The least spacing, of two digits, with which a scene fits; nothing where that is beyond the largest there may be.
std::optional<double> fittingSpacing(const Project& project, const PluginRegistry* plugins, SceneScale scale,
                                     double room) {
  const double largest = findDeclaration(solverParameters(), kSpacing)->hardMaximum;
  const double excess = needOf(project, plugins, scale).bytes / std::max(room, 1.0);
  scale.spacing *= std::max(1.0, 0.8 * std::cbrt(excess));  // with the cube of the spacing it falls at most
  while (scale.spacing < largest) {
    const double digit = std::pow(10, std::floor(std::log10(scale.spacing)) - 1);
    scale.spacing = std::round(std::floor(scale.spacing / digit + 1e-6) + 1) * digit;
    const SceneNeed need = needOf(project, plugins, scale);
    if (need.bytes <= room && need.particles <= kMaximumParticles) return scale.spacing;
  }
  return std::nullopt;
}

}  // namespace

SceneScale scaleOf(const Project& project) {
  const auto number = [&](const char* key) { return numberOf(project.solver.parameters, solverParameters(), key); };
  return {number(kSpacing), number("support_ratio")};
}

double particleBytes(const Project& project, const PluginRegistry* plugins, const Body& body, const SceneScale& scale) {
  return Common(project, plugins, scale).bytesOf(body);
}

double pouredParticleBytes(const Project& project, const PluginRegistry* plugins, const SceneScale& scale) {
  const Common common(project, plugins, scale);
  double most = 0;
  for (const Emitter& emitter : project.emitters) most = std::max(most, common.bytesOf(emitter.material));
  return most;
}

double meanParticleBytes(const Project& project, const PluginRegistry* plugins, const SceneScale& scale) {
  const SceneNeed need = needOf(project, plugins, scale);
  return need.particles > 0 ? need.bytes / need.particles : Common(project, plugins, scale).bytesOf(std::string());
}

SceneNeed needOf(const Project& project, const PluginRegistry* plugins) {
  return needOf(project, plugins, scaleOf(project));
}

SceneNeed needOf(const Project& project, const PluginRegistry* plugins, const SceneScale& scale) {
  const Common common(project, plugins, scale);
  SceneNeed need;
  need.bytes = bytesPerScene(project.materials.size(), common.matter.radiation);
  for (const Body& body : project.bodies) {
    const double count = particleCount(body, scale.spacing);
    need.particles += count;
    need.bytes += count * common.bytesOf(body);
  }
  for (const Emitter& emitter : project.emitters) {
    const double count = pouredBy(emitter, scale.spacing);
    need.pouredParticles += count;
    need.pouredBytes += count * common.bytesOf(emitter.material);
  }
  return need;
}

double roomFor(const Memory& memory) { return kShare * (memory.free + memory.own); }
double roomToGrow(const Memory& memory) { return roomFor(memory) - memory.own; }

std::string memoryProblem(const Project& project, const PluginRegistry* plugins, const SceneScale& scale,
                          const Memory& memory) {
  const SceneNeed need = needOf(project, plugins, scale);
  const double room = roomFor(memory);
  if (need.bytes <= room) return {};
  const std::optional<double> spacing = fittingSpacing(project, plugins, scale, room);
  return "the scene needs about " + memoryText(need.bytes) + " of memory for " + particlesText(need.particles) +
         ", and this machine has " + memoryText(room) + " for it; " +
         (spacing ? "a particle spacing of " + shownText(*findDeclaration(solverParameters(), kSpacing), *spacing) +
                        " or more would fit"
                  : std::string("make its bodies smaller"));
}

std::string particlesText(double count) {
  const double rounded = std::round(count);
  if (rounded >= 999'950) {
    const double millions = std::round(rounded / 1e5) / 10;
    return numberText(millions) + " million particles";
  }
  std::string digits = numberText(rounded);
  if (digits.size() > 3) digits.insert(digits.size() - 3, ",");
  return digits + (rounded == 1 ? " particle" : " particles");
}

}  // namespace ps
