// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/plugincheck.h"

#include "core/base/shorttext.h"
#include "core/io/projectio.h"
#include "core/simulation/engine.h"
#include "core/sketch/matterbrush.h"

#include <nlohmann/json.hpp>

#include <stdlib.h>

#include <algorithm>
#include <filesystem>

namespace ps {
namespace {

using nlohmann::json;

std::string firstOf(const PluginRegistry& plugins, PluginKind kind) {
  const std::vector<std::string> ids = plugins.ids(kind);
  return ids.empty() ? std::string() : ids.front();
}

/// K at which a material is solid, or at room temperature what never melts is.
double coldFor(const Material& material) {
  const auto melting = material.properties.find("melting_temperature");
  const double at = melting == material.properties.end() ? 0 : melting->second.at(293.15);
  return at > 50 ? at - 10 : 293.15;
}

/// A block that falls onto a warm floor.
json sceneFor(const PluginInfo& info, const PluginRegistry& plugins) {
  const std::string base = info.kind == PluginKind::Material ? info.id : firstOf(plugins, PluginKind::Material);
  const std::string model = info.kind == PluginKind::Thermal ? info.id : firstOf(plugins, PluginKind::Thermal);
  const Material* material = plugins.material(base);
  if (!material) throw Error("no material is installed to try it on");
  json body{{"id", "block"},
            {"material", "matter"},
            {"temperature", coldFor(*material)},
            {"shape", {{"box", {{"center", {0, 0.07, 0}}, {"size", {0.1, 0.1, 0.1}}}}}}};
  if (info.kind == PluginKind::Constraint) body["constraints"] = {{{"plugin", info.id}}};
  json thermal{{"model", model}};
  if (info.kind == PluginKind::HeatSource) thermal["sources"] = {{{"plugin", info.id}}};
  return {{"format", "phasesketch"},
          {"version", 1},
          {"materials", {{{"id", "matter"}, {"base", base}}}},
          {"bodies", {body}},
          {"environment",
           {{"bounds", {{"minimum", {-0.5, 0, -0.5}}, {"maximum", {0.5, 1, 0.5}}}},
            {"walls", {{{"id", "floor"}, {"point", {0, 0, 0}}, {"normal", {0, 1, 0}}, {"temperature", 350}}}}}},
          {"solver", {{"particle_spacing", 0.02}, {"thermal", thermal}}}};
}

std::string runScene(const PluginInfo& info, PluginRegistry& plugins) {
  const LoadedProject loaded = parseProject(sceneFor(info, plugins).dump(), "the scene it is tried in", plugins);
  Engine engine(loaded.project, plugins);
  constexpr int kFrames = 10;
  for (int frame = 0; frame < kFrames; ++frame) {
    const StepReport report = engine.step();
    if (report.flags) return "frame " + std::to_string(frame + 1) + ": " + report.message;
    engine.stats();
  }
  for (const PluginFault& fault : engine.lateFaults()) return "after the last frame: " + fault.what;
  return {};
}

/// A solid particle where the stroke begins.
SeenMatter oneParticle(const Vector3&, double) {
  return {{{0, -0.01F, 0, 0.01F}}, {263.15F}, {0}, {api::Phase::Solid}, {api::Motion::Solid}, {0}, {0}};
}

std::string drawStroke(const PluginInfo& info, const PluginRegistry& plugins) {
  StrokeSetup setup;
  setup.grid = {{0, 0, 0}, 0.02};
  const api::ParameterList list = plugins.parameters(info.id);
  for (size_t i = 0; i < list.count; ++i) setup.parameters.push_back(list[i].defaultValue);
  const std::vector<api::StrokeSample> samples{{{0, 0, 0}, 1, 0, {}}, {{0.02, 0, 0}, 0.5, 0.01, {1, 0, 0}, {1, 0, 0}}};
  VoxelShape::Stamp block;
  block.cells = {{0, 0, 0, 2, 0}, {0, 1, 0, 2, 0}, {0, 0, 1, 2, 0}};
  setup.stamp = stampCells(block);
  const api::BrushPlugin& brush = *plugins.brush(info.id);
  const bool touches = plugins.needs(info.id, api::kTouchesMatter);
  const api::EditKind kind = touches ? api::EditKind::Add : kindOf(brush, false);
  const auto acts = [&] {
    return touches ? !touchesOf(brush, setup, kind, samples).empty()
                   : !applyBrush(brush, setup, kind, samples).of(kind).empty();
  };
  // One that sees matter may act where there is none, where there is some, or in both cases.
  const bool actsAlone = acts();
  setup.matterWithin = oneParticle;
  if (acts() || actsAlone) return {};
  if (touches) return "a hand of 5 cm radius that goes through matter does nothing";
  return std::string("a stroke of two samples and 5 cm radius ") + (kind == api::EditKind::Add ? "draws" : "changes") +
         " nothing";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

PluginCheck checkPlugin(const std::string& path, const std::string& scratch,
                        const std::function<void(const std::string&)>& stage) {
  namespace fs = std::filesystem;
  if (!fs::is_regular_file(path)) throw InputError(path + ": there is no such file");
  const fs::path folder = fs::canonical(scratch) / "plugin", alias = folder / fs::path(path).filename();
  fs::create_directory(folder);
  fs::create_symlink(fs::absolute(path), alias);
  ::setenv("XDG_STATE_HOME", (fs::canonical(scratch) / "state").c_str(), 1);
  PluginRegistry::Options options;
  options.extraPaths = {folder.string()};
  options.userDirectory = options.environment = options.scans = false;  // this is a process of its own
  stage("was loaded");
  PluginRegistry plugins(options);
  const auto& found = plugins.plugins();
  const auto it =
      std::find_if(found.begin(), found.end(), [&](const PluginInfo& info) { return info.path == alias.string(); });
  if (it == found.end()) throw InputError(path + ": plugins are files that end in .so or .json");
  PluginCheck check{*it, replaced(it->problem, alias.string(), path)};
  check.info.path = path;
  if (it->state != PluginInfo::State::Loaded) return check;
  try {
    const bool brush = check.info.kind == PluginKind::Brush;
    stage(brush ? "drew a stroke" : "ran in a scene of ten frames");
    check.problem = brush ? drawStroke(check.info, plugins) : runScene(check.info, plugins);
  } catch (const std::exception& error) {
    check.problem = shortText(error.what());
  }
  if (!check.problem.empty()) check.problem = path + ": " + replaced(check.problem, alias.string(), path);
  return check;
}

}  // namespace ps
