// SPDX-License-Identifier: Apache-2.0
#include "core/io/parameterjson.h"
#include "core/io/projectcheck.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"

namespace ps {
namespace {

using nlohmann::json;

/// Reads every element of a list member with `read(json&)`.
template <class Read>
auto readList(JsonTaker& taker, const char* key, Read read) {
  std::vector<decltype(read(std::declval<json&>()))> out;
  if (!taker.has(key)) return out;
  json list = taker.take(key);
  out.reserve(list.size());
  for (json& item : list) out.push_back(read(item));
  return out;
}

SceneMaterial readMaterial(json& value, const PluginRegistry& plugins) {
  JsonTaker taker(value);
  SceneMaterial material;
  material.id = taker.text("id");
  material.label = taker.text("label");
  material.base = taker.text("base");
  if (taker.has("adheres_to")) material.adheresTo = taker.names("adheres_to");
  taker.parameters("properties", material.properties, propertyCatalogue());
  taker.parameters("parameters", material.parameters, plugins.parameters(material.base));
  material.unknown = taker.rest();
  return material;
}

VoxelShape::Paint readPaint(json& value) {
  JsonTaker taker(value);
  VoxelShape::Paint paint;
  paint.material = taker.text("material");
  paint.temperature = taker.number("temperature", paint.temperature);
  paint.unknown = taker.rest();
  return paint;
}

VoxelShape::Stroke readStroke(json& value, const PluginRegistry& plugins) {
  JsonTaker taker(value);
  VoxelShape::Stroke stroke;
  stroke.brush = taker.text("brush");
  stroke.erase = taker.toggle("erase", false);
  stroke.radius = taker.number("radius", stroke.radius);
  stroke.palette = static_cast<int>(taker.number("palette", 0));
  taker.parameters("parameters", stroke.parameters, plugins.parameters(stroke.brush));
  stroke.samples = readList(taker, "samples", [](json& sample) { return sample.get<std::array<double, 5>>(); });
  stroke.unknown = taker.rest();
  return stroke;
}

VoxelShape readVoxels(json& value, const PluginRegistry& plugins) {
  JsonTaker taker(value);
  VoxelShape shape;
  shape.origin = taker.vector("origin", shape.origin);
  shape.spacing = taker.number("spacing", 0);
  shape.palette = readList(taker, "palette", readPaint);
  shape.runs = readList(taker, "runs", [](json& run) {
    const auto whole = [&](size_t i) { return static_cast<int>(run[i].get<double>()); };
    return VoxelShape::Run{whole(0), whole(1), whole(2), whole(3), whole(4)};
  });
  shape.strokes = readList(taker, "strokes", [&](json& stroke) { return readStroke(stroke, plugins); });
  shape.unknown = taker.rest();
  return shape;
}

BoxShape readBox(json& value) {
  JsonTaker taker(value);
  BoxShape box;
  box.center = taker.vector("center", box.center);
  box.size = taker.vector("size", box.size);
  box.unknown = taker.rest();
  return box;
}

Region readRegion(json& value) {
  JsonTaker taker(value);
  Region region;
  region.minimum = taker.vector("minimum", region.minimum);
  region.maximum = taker.vector("maximum", region.maximum);
  region.unknown = taker.rest();
  return region;
}

Wave readWave(json& value) {
  JsonTaker taker(value);
  Wave wave;
  wave.axis = taker.text("axis")[0] - 'x';
  wave.wavelength = taker.number("wavelength", wave.wavelength);
  wave.phase = taker.number("phase", wave.phase);
  wave.velocity = taker.vector("velocity", wave.velocity);
  wave.unknown = taker.rest();
  return wave;
}

/// Reads a member that need not be there with `read(json&)`.
template <class Read>
auto readOptional(JsonTaker& taker, const char* key, Read read) {
  std::optional<decltype(read(std::declval<json&>()))> out;
  if (!taker.has(key)) return out;
  json value = taker.take(key);
  out = read(value);
  return out;
}

BodyConstraint readConstraint(json& value, const PluginRegistry& plugins) {
  JsonTaker taker(value);
  BodyConstraint constraint;
  constraint.plugin = taker.text("plugin");
  taker.parameters("parameters", constraint.parameters, plugins.parameters(constraint.plugin));
  constraint.unknown = taker.rest();
  return constraint;
}

Body readBody(json& value, const PluginRegistry& plugins) {
  JsonTaker taker(value);
  Body body;
  body.id = taker.text("id");
  body.name = taker.text("name");
  body.material = taker.text("material");
  json shape = taker.take("shape");
  JsonTaker shapeTaker(shape);
  if (shapeTaker.has("box")) {
    json box = shapeTaker.take("box");
    body.shape = readBox(box);
  } else {
    json voxels = shapeTaker.take("voxels");
    body.shape = readVoxels(voxels, plugins);
  }
  taker.keep("shape", std::move(shape));
  body.velocity = taker.vector("velocity", body.velocity);
  body.spin = taker.vector("spin", body.spin);
  body.velocityWave = readOptional(taker, "velocity_wave", readWave);
  body.temperatureGradient = taker.vector("temperature_gradient", body.temperatureGradient);
  body.pins = readList(taker, "pins", readRegion);
  body.constraints = readList(taker, "constraints", [&](json& item) { return readConstraint(item, plugins); });
  body.visible = taker.toggle("visible", true);
  body.locked = taker.toggle("locked", false);
  taker.parameters(body.parameters, bodyParameters());
  body.unknown = taker.rest();
  return body;
}

Emitter readEmitter(json& value) {
  JsonTaker taker(value);
  Emitter emitter;
  emitter.id = taker.text("id");
  emitter.name = taker.text("name");
  emitter.material = taker.text("material");
  emitter.point = taker.vector("point", emitter.point);
  emitter.direction = taker.vector("direction", emitter.direction);
  taker.parameters(emitter.parameters, emitterParameters());
  emitter.unknown = taker.rest();
  return emitter;
}

Sink readSink(json& value) {
  JsonTaker taker(value);
  Sink sink;
  sink.id = taker.text("id");
  sink.name = taker.text("name");
  sink.minimum = taker.vector("minimum", sink.minimum);
  sink.maximum = taker.vector("maximum", sink.maximum);
  taker.parameters(sink.parameters, sinkParameters());
  sink.unknown = taker.rest();
  return sink;
}

SceneWall readWall(json& value) {
  JsonTaker taker(value);
  SceneWall wall;
  wall.id = taker.text("id");
  wall.name = taker.text("name");
  wall.point = taker.vector("point", wall.point);
  wall.normal = taker.vector("normal", wall.normal);
  taker.parameters(wall.parameters, wallParameters());
  wall.unknown = taker.rest();
  return wall;
}

Environment readEnvironment(json& value) {
  JsonTaker taker(value);
  Environment environment;
  environment.gravity = taker.vector("gravity", environment.gravity);
  if (taker.has("bounds")) {
    json bounds = taker.take("bounds");
    JsonTaker inner(bounds);
    environment.boundsMinimum = inner.vector("minimum", environment.boundsMinimum);
    environment.boundsMaximum = inner.vector("maximum", environment.boundsMaximum);
    taker.keep("bounds", std::move(bounds));
  }
  if (taker.has("periodic")) environment.periodic = taker.take("periodic").get<std::array<bool, 3>>();
  environment.walls = readList(taker, "walls", readWall);
  taker.parameters(environment.parameters, environmentParameters());
  environment.unknown = taker.rest();
  return environment;
}

SolverOptions readSolver(json& value, const PluginRegistry& plugins) {
  JsonTaker taker(value);
  SolverOptions solver;
  solver.thermalModel = plugins.standard(PluginKind::Thermal);  // files always meant it where they name none
  if (taker.has("thermal")) {
    json thermal = taker.take("thermal");
    JsonTaker inner(thermal);
    solver.thermalModel = inner.text("model");
    inner.parameters("parameters", solver.thermalParameters, plugins.parameters(solver.thermalModel));
    taker.keep("thermal", std::move(thermal));
  }
  taker.parameters(solver.parameters, solverParameters());
  solver.unknown = taker.rest();
  return solver;
}

Probe readProbe(json& value) {
  JsonTaker taker(value);
  Probe probe;
  probe.id = taker.text("id");
  probe.name = taker.text("name", probe.id);
  probe.quantity = taker.text("quantity");
  probe.body = taker.text("body");
  probe.phase = taker.text("phase");
  probe.fixed = taker.toggle("fixed", false);
  probe.region = readOptional(taker, "region", readRegion);
  probe.wave = readOptional(taker, "wave", readWave);
  probe.unknown = taker.rest();
  return probe;
}

ViewState readView(json& value) {
  JsonTaker taker(value);
  ViewState view;
  if (taker.has("target") || taker.has("distance") || taker.has("azimuth") || taker.has("elevation")) {
    ViewCamera& camera = view.camera.emplace();
    camera.target = taker.vector("target", camera.target);
    camera.distance = taker.number("distance", camera.distance);
    camera.azimuth = taker.number("azimuth", camera.azimuth);
    camera.elevation = taker.number("elevation", camera.elevation);
  }
  view.colour = taker.text("colour", view.colour);
  view.pinned = taker.names("pinned");
  view.unknown = taker.rest();
  return view;
}

}  // namespace

Project readDocument(json& document, const PluginRegistry& plugins) {
  JsonTaker taker(document);
  Project project;
  taker.take("format");
  project.version = static_cast<int>(taker.number("version", project.version));
  project.minVersion = static_cast<int>(taker.number("minVersion", project.version));
  project.generator = taker.text("generator");
  project.title = taker.text("title");
  project.description = taker.text("description");
  project.pluginsUsed = taker.names("pluginsUsed");
  project.pluginsRequired = taker.names("pluginsRequired");
  project.materials = readList(taker, "materials", [&](json& item) { return readMaterial(item, plugins); });
  project.bodies = readList(taker, "bodies", [&](json& item) { return readBody(item, plugins); });
  project.emitters = readList(taker, "emitters", readEmitter);
  project.sinks = readList(taker, "sinks", readSink);
  json environment = taker.has("environment") ? taker.take("environment") : json::object();
  project.environment = readEnvironment(environment);
  json solver = taker.has("solver") ? taker.take("solver") : json::object();
  project.solver = readSolver(solver, plugins);
  for (Body& body : project.bodies) {
    // Earlier files do not say it: their sketches have the scene's.
    auto* voxels = std::get_if<VoxelShape>(&body.shape);
    if (voxels && voxels->spacing == 0)
      voxels->spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  }
  project.probes = readList(taker, "probes", readProbe);
  project.duration = taker.number("duration", project.duration);
  json view = taker.has("view") ? taker.take("view") : json::object();
  project.view = readView(view);
  project.unknown = taker.rest();
  return project;
}

}  // namespace ps
