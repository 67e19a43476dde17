// SPDX-License-Identifier: Apache-2.0
#include "core/base/jsontext.h"
#include "core/io/parameterjson.h"
#include "core/io/projectio.h"
#include "core/io/schema.h"
#include "core/io/textfile.h"

#include <cmath>
#include <set>

namespace ps {
namespace {

using nlohmann::json;

void putText(json& object, const char* key, const std::string& text) {
  if (!text.empty()) object[key] = text;
}

void putSet(json& object, const char* key, const ParameterSet& set) {
  if (set.values.empty()) return;
  object[key] = json::object();
  putParameters(object[key], set);
}

json writeMaterial(const SceneMaterial& material) {
  json out{{"id", material.id}, {"base", material.base}};
  putText(out, "label", material.label);
  putSet(out, "properties", material.properties);
  putSet(out, "parameters", material.parameters);
  if (material.adheresTo) out["adheres_to"] = *material.adheresTo;
  putUnknown(out, material.unknown);
  return out;
}

json writeStroke(const VoxelShape::Stroke& stroke) {
  json samples = json::array();
  for (const auto& s : stroke.samples) {
    json sample = json::array();
    for (const double value : s) sample.push_back(jsonNumber(value));
    samples.push_back(std::move(sample));
  }
  json out{{"brush", stroke.brush},
           {"radius", jsonNumber(stroke.radius)},
           {"palette", stroke.palette},
           {"samples", samples}};
  if (stroke.erase) out["erase"] = true;
  putSet(out, "parameters", stroke.parameters);
  putUnknown(out, stroke.unknown);
  return out;
}

json writeVoxels(const VoxelShape& shape) {
  json out{{"origin", jsonFromVector(shape.origin)},
           {"spacing", jsonNumber(shape.spacing)},
           {"palette", json::array()},
           {"runs", json::array()}};
  for (const VoxelShape::Paint& paint : shape.palette) {
    json entry{{"material", paint.material}, {"temperature", jsonNumber(paint.temperature)}};
    putUnknown(entry, paint.unknown);
    out["palette"].push_back(std::move(entry));
  }
  for (const VoxelShape::Run& r : shape.runs) out["runs"].push_back({r.x, r.y, r.z, r.length, r.palette});
  for (const VoxelShape::Stroke& stroke : shape.strokes) out["strokes"].push_back(writeStroke(stroke));
  putUnknown(out, shape.unknown);
  return out;
}

json writeShape(const std::variant<BoxShape, VoxelShape>& shape) {
  if (const auto* voxels = std::get_if<VoxelShape>(&shape)) return {{"voxels", writeVoxels(*voxels)}};
  const auto& box = std::get<BoxShape>(shape);
  json out{{"center", jsonFromVector(box.center)}, {"size", jsonFromVector(box.size)}};
  putUnknown(out, box.unknown);
  return {{"box", std::move(out)}};
}

json writeRegion(const Region& region) {
  json out{{"minimum", jsonFromVector(region.minimum)}, {"maximum", jsonFromVector(region.maximum)}};
  putUnknown(out, region.unknown);
  return out;
}

void putVector(json& object, const char* key, const Vector3& vector) {
  if (vector != Vector3::Zero()) object[key] = jsonFromVector(vector);
}

json writeWave(const Wave& wave) {
  json out{{"axis", std::string(1, static_cast<char>('x' + wave.axis))}, {"wavelength", jsonNumber(wave.wavelength)}};
  if (wave.phase != 0) out["phase"] = jsonNumber(wave.phase);
  putVector(out, "velocity", wave.velocity);
  putUnknown(out, wave.unknown);
  return out;
}

json writeBody(const Body& body) {
  json out{{"id", body.id}, {"material", body.material}, {"shape", writeShape(body.shape)}};
  putText(out, "name", body.name);
  putParameters(out, body.parameters);
  putVector(out, "velocity", body.velocity);
  putVector(out, "spin", body.spin);
  if (body.velocityWave) out["velocity_wave"] = writeWave(*body.velocityWave);
  putVector(out, "temperature_gradient", body.temperatureGradient);
  for (const Region& pin : body.pins) out["pins"].push_back(writeRegion(pin));
  for (const BodyConstraint& constraint : body.constraints) {
    json entry{{"plugin", constraint.plugin}};
    putSet(entry, "parameters", constraint.parameters);
    putUnknown(entry, constraint.unknown);
    out["constraints"].push_back(std::move(entry));
  }
  if (!body.visible) out["visible"] = false;
  if (body.locked) out["locked"] = true;
  putUnknown(out, body.unknown);
  return out;
}

json writeEmitter(const Emitter& emitter) {
  json out{{"id", emitter.id},
           {"material", emitter.material},
           {"point", jsonFromVector(emitter.point)},
           {"direction", jsonFromVector(emitter.direction)}};
  putText(out, "name", emitter.name);
  putParameters(out, emitter.parameters);
  putUnknown(out, emitter.unknown);
  return out;
}

json writeSink(const Sink& sink) {
  json out{{"id", sink.id}, {"minimum", jsonFromVector(sink.minimum)}, {"maximum", jsonFromVector(sink.maximum)}};
  putText(out, "name", sink.name);
  putParameters(out, sink.parameters);
  putUnknown(out, sink.unknown);
  return out;
}

json writeEnvironment(const Environment& environment) {
  json out{{"gravity", jsonFromVector(environment.gravity)},
           {"bounds",
            {{"minimum", jsonFromVector(environment.boundsMinimum)},
             {"maximum", jsonFromVector(environment.boundsMaximum)}}},
           {"walls", json::array()}};
  if (environment.periodic != std::array<bool, 3>{}) out["periodic"] = environment.periodic;
  putParameters(out, environment.parameters);
  for (const SceneWall& wall : environment.walls) {
    json entry{{"id", wall.id}, {"point", jsonFromVector(wall.point)}, {"normal", jsonFromVector(wall.normal)}};
    putText(entry, "name", wall.name);
    putParameters(entry, wall.parameters);
    putUnknown(entry, wall.unknown);
    out["walls"].push_back(std::move(entry));
  }
  putUnknown(out, environment.unknown);
  return out;
}

json writeSolver(const SolverOptions& solver) {
  json out{{"thermal", {{"model", solver.thermalModel}}}};
  putSet(out["thermal"], "parameters", solver.thermalParameters);
  putParameters(out, solver.parameters);
  putUnknown(out, solver.unknown);
  return out;
}

json writeProbe(const Probe& probe) {
  json out{{"id", probe.id}, {"quantity", probe.quantity}};
  putText(out, "name", probe.name);
  putText(out, "body", probe.body);
  putText(out, "phase", probe.phase);
  if (probe.fixed) out["fixed"] = true;
  if (probe.region) out["region"] = writeRegion(*probe.region);
  if (probe.wave) out["wave"] = writeWave(*probe.wave);
  putUnknown(out, probe.unknown);
  return out;
}

json writeView(const ViewState& view) {
  json out{{"colour", view.colour}};
  if (view.camera) {
    out["target"] = jsonFromVector(view.camera->target);
    out["distance"] = jsonNumber(view.camera->distance);
    out["azimuth"] = jsonNumber(view.camera->azimuth);
    out["elevation"] = jsonNumber(view.camera->elevation);
  }
  if (!view.pinned.empty()) out["pinned"] = view.pinned;
  putUnknown(out, view.unknown);
  return out;
}

/// What the file names itself, and what the scene refers to.
std::set<std::string> pluginsOf(const Project& project) {
  std::set<std::string> used(project.pluginsUsed.begin(), project.pluginsUsed.end());
  for (const SceneMaterial& material : project.materials) used.insert(material.base);
  for (const Body& body : project.bodies) {
    for (const BodyConstraint& constraint : body.constraints) used.insert(constraint.plugin);
    if (const auto* voxels = std::get_if<VoxelShape>(&body.shape)) {
      for (const VoxelShape::Stroke& stroke : voxels->strokes) used.insert(stroke.brush);
    }
  }
  used.insert(project.solver.thermalModel);
  used.erase("");
  return used;
}

/// JSON has no NaN or infinity: a file with one could not be opened again.
void requireFinite(const json& value, const std::string& pointer) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    throw Error("not saved: " + pointer + " is not a finite number; undo the last change");
  }
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) requireFinite(member, pointer + "/" + pointerPart(key));
  } else if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) {
      if (!value[i].is_number_integer()) requireFinite(value[i], pointer + "/" + std::to_string(i));
    }
  }
}

template <class List, class Write>
json writeList(const List& list, Write write) {
  json out = json::array();
  for (const auto& item : list) out.push_back(write(item));
  return out;
}

}  // namespace

std::string writeProject(const Project& project) {
  json out{{"format", "phasesketch"},
           {"version", project.version},
           {"generator", "phasesketch " PS_VERSION},
           {"pluginsUsed", pluginsOf(project)},
           {"materials", writeList(project.materials, writeMaterial)},
           {"bodies", writeList(project.bodies, writeBody)},
           {"environment", writeEnvironment(project.environment)},
           {"solver", writeSolver(project.solver)},
           {"duration", jsonNumber(project.duration)},
           {"view", writeView(project.view)}};
  if (project.minVersion != project.version) out["minVersion"] = project.minVersion;
  putText(out, "title", project.title);
  putText(out, "description", project.description);
  if (!project.pluginsRequired.empty()) out["pluginsRequired"] = project.pluginsRequired;
  if (!project.emitters.empty()) out["emitters"] = writeList(project.emitters, writeEmitter);
  if (!project.sinks.empty()) out["sinks"] = writeList(project.sinks, writeSink);
  if (!project.probes.empty()) out["probes"] = writeList(project.probes, writeProbe);
  putUnknown(out, project.unknown);
  requireFinite(out, "");
  return writeJson(out);
}

void saveProject(const Project& project, const std::string& path) { writeFileAtomically(path, writeProject(project)); }

}  // namespace ps
