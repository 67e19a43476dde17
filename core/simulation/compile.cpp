// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/compile.h"

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/geometry/solidfill.h"
#include "core/math/vector.h"
#include "core/matter/material.h"
#include "core/matter/stablephase.h"
#include "core/plugin_host/registry.h"
#include "core/scene/coat.h"
#include "core/scene/pose.h"
#include "core/scene/scenewall.h"
#include "core/scene/shownname.h"
#include "core/scene/solidform.h"
#include "core/simulation/declared.h"
#include "core/simulation/lattice.h"
#include "core/simulation/mouth.h"
#include "core/simulation/sceneproblem.h"
#include "core/simulation/truesurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ps {
namespace {

constexpr double kLeastAirHeatCapacity = 1e-6;  ///< J/K: by a denormal one what it takes would be 0/0

/// Phase at birth: as asked, or what is stable at the temperature.
api::Phase birthPhase(const std::string& asked, const api::Caloric& caloric, double temperature) {
  if (asked == "solid") return api::Phase::Solid;
  if (asked == "liquid") return api::Phase::Liquid;
  if (asked == "gas") return api::Phase::Gas;
  return stablePhase(caloric, temperature);
}

/// Everything but positions, material, temperature and the index of the body, which the engine gives.
ColouredSpawn spawnOf(const Project& project, const PluginRegistry& plugins, const Body& body) {
  ColouredSpawn spawn;
  spawn.fixed = toggleOf(body.parameters, bodyParameters(), "fixed") || isPlaceholder(project, body, plugins);
  spawn.held = isHeld(body);
  return spawn;
}

/// What it is given, and what it does where it is `fixed`, held in place.
BodyHeat heatOf(const Body& body, bool fixed) {
  const api::ParameterList list = bodyParameters();
  BodyHeat heat;
  heat.watts = numberOf(body.parameters, list, "heating_power");
  if (!fixed) return heat;
  const std::string kind = choiceOf(body.parameters, list, "heat");
  const bool convects = kind == "convective";
  if (convects || kind == "fixed_temperature") heat.held = numberOf(body.parameters, list, "held_temperature");
  if (convects) heat.convection = numberOf(body.parameters, list, "convection");
  heat.insulated = kind == "adiabatic" || kind == "fixed_flux" || (convects && heat.convection == 0);
  if (kind == "fixed_flux") heat.flux = numberOf(body.parameters, list, "heat_flux");
  return heat;
}

void setMatter(Spawn& spawn, std::span<const BakedMaterial> materials, uint32_t material, double temperature,
               const std::string& phase) {
  spawn.material = material;
  spawn.temperature = temperature;
  spawn.phase = birthPhase(phase, materials[material].caloric(), temperature);
}

void setMatter(Spawn& spawn, const Project& project, std::span<const BakedMaterial> materials,
               const std::string& material, double temperature, const Body& body) {
  const double held = heatOf(body, toggleOf(body.parameters, bodyParameters(), "fixed")).held;
  setMatter(spawn, materials, materialIndex(project, material, shownName(body)), held > 0 ? held : temperature,
            choiceOf(body.parameters, bodyParameters(), "phase"));
}

/// Mean of the places of all particles; of a solid its own centre.
Vector3 centreOf(const Body& body, double spacing) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) return box->center;
  if (std::holds_alternative<SolidShape>(body.shape)) return centroidOf(body);
  Vector3 sum;
  size_t count = 0;
  const auto& voxels = std::get<VoxelShape>(body.shape);
  for (size_t palette = 0; palette < voxels.palette.size(); ++palette) {
    for (const api::Double3& p : cellCentres(voxels, spacing, cellsOf(voxels, static_cast<int>(palette)))) {
      sum += vectorOf(p);
      ++count;
    }
  }
  return sum / static_cast<double>(std::max<size_t>(count, 1));
}

double sineAt(const Wave& wave, const Vector3& p) {
  return std::sin(2 * std::numbers::pi * p[static_cast<size_t>(wave.axis)] / wave.wavelength + wave.phase);
}

/// What changes over a body at the start. What is fixed has no velocity of its own, see compileMotion(), and what is
/// held stands.
void setFields(Spawn& spawn, const Body& body, const Vector3& centre, const api::Caloric& caloric) {
  const std::string asked = choiceOf(body.parameters, bodyParameters(), "phase");
  const Vector3 &w = body.spin, &gradient = body.temperatureGradient;
  const bool warped = gradient != Vector3::Zero();
  inSlices(0, spawn.position.size(), [&](size_t first, size_t last) {
    for (const api::Double3& place : std::span(spawn.position).subspan(first, last - first)) {
      const Vector3 p = vectorOf(place), r = p - centre;
      Vector3 v = body.velocity + w.cross(r);
      if (body.velocityWave) v += body.velocityWave->velocity * sineAt(*body.velocityWave, p);
      spawn.velocity.push_back(spawn.fixed || spawn.held ? api::Double3{0, 0, 0} : double3Of(v));
      if (!warped) continue;
      const double t = spawn.temperature + gradient.dot(r);
      if (!(t >= 1)) {
        throw SceneError("body '" + shownName(body) + "': its temperature gradient would cool it to " + numberText(t) +
                             " K; raise its temperature or lower the gradient",
                         {Owner::Body, body.id, "temperature"});
      }
      spawn.temperatures.push_back(t);
      spawn.phases.push_back(birthPhase(asked, caloric, t));
    }
  });
}

/// Takes the particles that stand in one of the body's pins, or are held by its shape, out of `spawn`: a batch of fixed
/// ones.
ColouredSpawn takePinned(ColouredSpawn& spawn, const Body& body, double spacing) {
  std::optional<SolidForm> form;
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) form.emplace(*solid);
  ColouredSpawn pinned = spawn;
  pinned.position.clear();
  pinned.fixed = true;
  std::erase_if(spawn.position, [&](const api::Double3& p) {
    const bool held =
        (form && form->isHeld(form->toOwn(vectorOf(p)), spacing)) ||
        std::any_of(body.pins.begin(), body.pins.end(), [&](const Region& pin) { return pin.contains(vectorOf(p)); });
    if (held) pinned.position.push_back(p);
    return held;
  });
  return pinned;
}

const EvaluatedMaterial* lastOf(const SceneMaterial& source, const EvaluatedMaterials& evaluated) {
  const auto found = evaluated.find(source.id);
  return found != evaluated.end() && found->second.base == source.base ? &found->second : nullptr;
}

}  // namespace

SolverSettings compileSettings(const Project& project) {
  const api::ParameterList list = solverParameters();
  const auto number = [&](const char* key) { return numberOf(project.solver.parameters, list, key); };
  SolverSettings s;
  s.spacing = number("particle_spacing");
  s.supportRatio = number("support_ratio");
  s.kernel = choiceOf(project.solver.parameters, list, "kernel") == "wendland_c2" ? KernelShape::WendlandC2
                                                                                  : KernelShape::CubicSpline;
  s.dt = number("dt");
  s.substeps = static_cast<int>(number("substeps"));
  s.iterations = static_cast<int>(number("iterations"));
  s.densitySolver = choiceOf(project.solver.parameters, list, "density_solver") == "jacobi" ? DensitySolver::Jacobi
                                                                                            : DensitySolver::Chebyshev;
  s.relaxation = number("relaxation");
  s.chebyshevRadius = number("chebyshev_radius");
  s.xsphMinimum = number("xsph_minimum");
  const std::string viscosity = choiceOf(project.solver.parameters, list, "viscosity_model");
  s.viscosityModel = viscosity == "xsph"       ? ViscosityModel::Xsph
                     : viscosity == "implicit" ? ViscosityModel::Implicit
                                               : ViscosityModel::Automatic;
  s.viscosityMax = number("viscosity_max");
  s.viscosityTolerance = number("viscosity_tolerance");
  s.viscosityIterations = static_cast<int>(number("viscosity_iterations"));
  s.damping = number("damping");
  s.gasModel = choiceOf(project.solver.parameters, list, "gas_model") == "thesis" ? GasModel::Thesis : GasModel::Parcel;
  s.gasDrag = number("gas_parcel_diameter");
  s.addedMass = number("added_mass");
  const auto air = [&](const char* key) {
    return numberOf(project.environment.parameters, environmentParameters(), key);
  };
  s.airDrag = air("air_drag");
  const double heading = air("wind_direction") * std::numbers::pi / 180;
  s.wind = {air("wind_speed") * std::cos(heading), 0, air("wind_speed") * std::sin(heading)};
  s.gravity = double3Of(project.environment.gravity);
  return s;
}

ThermalSettings compileThermal(const Project& project) {
  const auto solver = [&](const char* key) { return numberOf(project.solver.parameters, solverParameters(), key); };
  const auto ambient = [&](const char* key) {
    return numberOf(project.environment.parameters, environmentParameters(), key);
  };
  ThermalSettings t;
  t.timeScale = solver("thermal_time_scale");
  t.cfl = solver("thermal_cfl");
  t.steps = choiceOf(project.solver.parameters, solverParameters(), "heat_steps") == "explicit" ? HeatSteps::Explicit
                                                                                                : HeatSteps::Automatic;
  t.momentCorrection = toggleOf(project.solver.parameters, solverParameters(), "moment_correction");
  t.nucleation = solver("nucleation");
  t.ambientPressure = ambient("ambient_pressure");
  t.ambientTemperature = ambient("ambient_temperature");
  t.airConvection = ambient("air_convection");
  t.airHeatCapacity = ambient("air_heat_capacity");
  if (t.airHeatCapacity > 0) t.airHeatCapacity = std::max(t.airHeatCapacity, kLeastAirHeatCapacity);
  t.contactConductance = ambient("contact_conductance");
  t.radiation = toggleOf(project.environment.parameters, environmentParameters(), "radiation");
  t.surroundingsTemperature = ambient("surroundings_temperature");
  return t;
}

std::vector<Wall> compileWalls(const Project& project) {
  std::vector<Wall> walls;
  for (const SceneWall& source : project.environment.walls) {
    const double length = source.normal.norm();
    if (!(length > 0)) throw InputError("wall '" + source.name + "': its normal must not be zero");
    const api::ParameterList list = wallParameters();
    Wall wall;
    wall.id = source.id;
    const Vector3 normal = source.normal / length;
    wall.normal = double3Of(normal);
    wall.offset = normal.dot(source.point);
    const WallFace face = faceOf(source);
    wall.form = face.form();
    wall.centre = double3Of(source.point);
    wall.radius = face.radius();
    wall.inside = face.isInside();
    wall.friction = numberOf(source.parameters, list, "friction");
    wall.noSlip = toggleOf(source.parameters, list, "no_slip");
    const std::string heat = choiceOf(source.parameters, list, "heat");
    wall.heat = heat == "fixed_temperature" ? WallHeat::FixedTemperature
                : heat == "fixed_flux"      ? WallHeat::FixedFlux
                : heat == "convective"      ? WallHeat::Convective
                                            : WallHeat::Adiabatic;
    wall.temperature = numberOf(source.parameters, list, "temperature");
    wall.flux = numberOf(source.parameters, list, "heat_flux");
    wall.convection = numberOf(source.parameters, list, "convection");
    wall.emissivity = numberOf(source.parameters, list, "emissivity");
    wall.filmCoefficient = numberOf(source.parameters, list, "film_coefficient");
    walls.push_back(wall);
  }
  return walls;
}

Bounds compileBounds(const Project& project) {
  const Environment& environment = project.environment;
  return {double3Of(environment.boundsMinimum), double3Of(environment.boundsMaximum), environment.periodic};
}

Material compileMaterial(const Project& project, const SceneMaterial& source, const PluginRegistry& plugins,
                         EvaluatedMaterials& evaluated) {
  Material material;
  if (plugins.materialPlugin(source.base)) {
    material = plugins.evaluated(source.base, numbersOf(source.parameters, plugins.parameters(source.base)));
    evaluated[source.id] = {source.base, source.parameters, material};
  } else if (const Material* installed = plugins.material(source.base)) {
    material = *installed;
  } else if (const EvaluatedMaterial* last = lastOf(source, evaluated)) {
    if (last->parameters != source.parameters) {
      throw PluginError("the material '" + shownName(source) + "': '" + source.base +
                        "' failed while it ran, so its parameters stay as they were; start the program again");
    }
    material = last->material;
  }
  material.id = source.id;
  if (!source.label.empty()) material.label = source.label;
  material.adheresTo =
      source.adheresTo ? namedInScene(project, *source.adheresTo) : namedByInstalled(project, material.adheresTo);
  for (const auto& [key, value] : source.properties.values) material.properties[key] = responseOf(value);
  if (const std::string problem = problemOf(material); !problem.empty()) {
    const std::string key = problem.substr(0, problem.find_first_of(" :"));
    throw SceneError("the material '" + shownName(source) + "': " + problem, {Owner::Material, source.id, key});
  }
  return material;
}

std::vector<Material> compileMaterials(const Project& project, const PluginRegistry& plugins) {
  std::vector<Material> materials;
  EvaluatedMaterials evaluated;
  for (const SceneMaterial& source : project.materials) {
    materials.push_back(compileMaterial(project, source, plugins, evaluated));
  }
  return materials;
}

uint32_t materialIndex(const Project& project, const std::string& material, const std::string& body) {
  for (size_t i = 0; i < project.materials.size(); ++i) {
    if (project.materials[i].id == material) return static_cast<uint32_t>(i);
  }
  throw InputError("body '" + body + "': the scene has no material '" + material + "'");
}

bool isPlaceholder(const Project& project, const Body& body, const PluginRegistry& plugins) {
  for (const SceneMaterial& material : project.materials) {
    if (material.id == body.material && !plugins.material(material.base)) return true;
  }
  return std::any_of(body.constraints.begin(), body.constraints.end(),
                     [&](const BodyConstraint& c) { return !plugins.constraint(c.plugin); });
}

bool isHeld(const Body& body) { return toggleOf(body.parameters, bodyParameters(), "held"); }

std::vector<ColouredSpawn> compileBody(const Project& project, const PluginRegistry& plugins,
                                       std::span<const BakedMaterial> materials, const Body& body) {
  const double spacing = compileSettings(project).spacing;
  std::vector<ColouredSpawn> spawns;
  if (!std::holds_alternative<VoxelShape>(body.shape)) {
    ColouredSpawn spawn = spawnOf(project, plugins, body);
    if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
      SolidMatter matter = solidMatter(*solid, spacing, toggleOf(body.parameters, bodyParameters(), "fixed"));
      spawn.position = std::move(matter.places);
      spawn.volume = matter.volume;
      spawn.packed = matter.packed;
    } else {
      spawn.position = boxLattice(std::get<BoxShape>(body.shape), spacing);
    }
    const double temperature = numberOf(body.parameters, bodyParameters(), "temperature");
    setMatter(spawn, project, materials, body.material, temperature, body);
    spawns.push_back(std::move(spawn));
  } else {
    const auto& voxels = std::get<VoxelShape>(body.shape);
    for (size_t palette = 0; palette < voxels.palette.size(); ++palette) {
      std::vector<std::array<int, 3>> cells = cellsOf(voxels, static_cast<int>(palette));
      if (!cells.empty()) {
        spawns.push_back(compileCells(project, plugins, materials, body, static_cast<int>(palette), cells, spacing));
      }
    }
  }
  const double jitter = numberOf(body.parameters, bodyParameters(), "jitter");
  const double seed = numberOf(body.parameters, bodyParameters(), "seed");
  const Vector3 centre = centreOf(body, spacing);
  std::vector<ColouredSpawn> all;
  for (ColouredSpawn& spawn : spawns) {
    // By place in the lattice: disorder does not decide who is pinned.
    ColouredSpawn pinned = takePinned(spawn, body, spacing);
    for (ColouredSpawn* part : {&pinned, &spawn}) {
      setFields(*part, body, centre, materials[part->material].caloric());
      disturb(part->position, spacing, jitter, static_cast<uint32_t>(seed));
    }
    if (!pinned.position.empty()) all.push_back(std::move(pinned));
    all.push_back(std::move(spawn));
  }
  // What is held is there before what hangs on it, whatever it is made of.
  std::stable_sort(all.begin(), all.end(), [](const Spawn& a, const Spawn& b) { return a.fixed && !b.fixed; });
  return all;
}

BodyMotion compileMotion(const Body& body, double spacing) {
  const auto number = [&](const char* key) { return numberOf(body.parameters, bodyParameters(), key); };
  BodyMotion motion{{}, double3Of(body.velocity), double3Of(body.spin), number("motion_start")};
  if (const double stop = number("motion_stop"); stop > 0) motion.stop = stop;
  if (body.velocity != Vector3::Zero() || body.spin != Vector3::Zero())
    motion.centre = double3Of(centreOf(body, spacing));
  return motion;
}

std::vector<BodyHeat> compileHeating(const Project& project, const std::vector<std::string>& bodyIds,
                                     std::span<const uint8_t> fixed, ShapeSurfaces& surfaces) {
  std::vector<BodyHeat> heat(bodyIds.size());
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  for (const Body& body : project.bodies) {
    const auto index = static_cast<size_t>(std::find(bodyIds.begin(), bodyIds.end(), body.id) - bodyIds.begin());
    if (index >= heat.size()) continue;
    heat[index] = heatOf(body, index < fixed.size() && fixed[index]);
    if (heat[index].flux == 0) continue;
    const auto* solid = std::get_if<SolidShape>(&body.shape);
    heat[index].oneLayer = solid && SolidForm(*solid).isOneLayer();
    heat[index].area = surfaces.areaOf(body, spacing);
  }
  return heat;
}

ColouredSpawn compileCells(const Project& project, const PluginRegistry& plugins,
                           std::span<const BakedMaterial> materials, const Body& body, int palette,
                           const std::vector<std::array<int, 3>>& cells, double spacing) {
  const auto& voxels = std::get<VoxelShape>(body.shape);
  const VoxelShape::Paint& paint = voxels.palette.at(static_cast<size_t>(palette));
  ColouredSpawn spawn = spawnOf(project, plugins, body);
  spawn.position = cellCentres(voxels, spacing, cells);
  setMatter(spawn, project, materials, paint.material, paint.temperature, body);
  spawn.colour = colourNumber(paint.colour);
  return spawn;
}

Spawn compileLayer(const Project& project, std::span<const BakedMaterial> materials, const Emitter& emitter,
                   double spacing, double offset) {
  const auto number = [&](const char* key) { return numberOf(emitter.parameters, emitterParameters(), key); };
  const Vector3 direction = emitter.direction.normalized();
  // Across the jet: level where it is not upright.
  const Vector3 across = std::abs(direction.y()) < 0.9 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
  const Vector3 side = direction.cross(across).normalized(), up = direction.cross(side);
  const Vector3 centre = emitter.point + offset * direction;
  const api::Double3 velocity = double3Of(number("speed") * direction);
  Spawn spawn;
  setMatter(spawn, materials, materialIndex(project, emitter.material, shownName(emitter)), number("temperature"),
            "automatic");
  for (const auto& [row, column] : mouthOf(number("diameter"), spacing).places) {
    spawn.position.push_back(double3Of(centre + row * side + column * up));
    spawn.velocity.push_back(velocity);
  }
  return spawn;
}

}  // namespace ps
