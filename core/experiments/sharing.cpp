// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/sharing.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/progress.h"
#include "core/base/shorttext.h"
#include "core/experiments/run.h"
#include "core/io/mixing.h"
#include "core/io/projectio.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/simulation/declared.h"
#include "core/simulation/engine.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

const PluginInfo* infoOf(const PluginRegistry& plugins, const std::string& id) {
  const auto found = std::find_if(plugins.plugins().begin(), plugins.plugins().end(),
                                  [&](const PluginInfo& info) { return info.id == id; });
  return found == plugins.plugins().end() ? nullptr : &*found;
}

/// Whether everybody has it.
bool comesAlong(const PluginRegistry& plugins, const std::string& id) {
  const PluginInfo* info = infoOf(plugins, id);
  return info && info->own;
}

/// A parameter of its plugin goes by a track, which would have nothing to act on.
bool hasOwnTrack(const Project& project, const std::string& material) {
  const std::string owner = "material/" + material + "/";
  return std::any_of(project.tracks.begin(), project.tracks.end(), [&](const Track& track) {
    if (!track.parameter.starts_with(owner)) return false;
    const std::string key = track.parameter.substr(owner.size(), track.parameter.find('[') - owner.size());
    return propertyIndex(key) < 0;
  });
}

/// Without materials that others need not have any more.
void dropMaterials(std::vector<std::string>& ids, const PluginRegistry& plugins) {
  std::erase_if(ids, [&](const std::string& id) {
    const PluginInfo* info = infoOf(plugins, id);
    return info && !info->own && info->kind == PluginKind::Material;
  });
}

/// Tells one who is asked to stop to another who counts otherwise.
class Listening final : public Progress {
 public:
  explicit Listening(const Progress* outer) : m_outer(outer) {}

 private:
  void advanced(size_t) override {
    if (m_outer && m_outer->cancelled()) cancel();
  }
  const Progress* m_outer;
};

Engine made(const Project& project, PluginRegistry& plugins) {
  Listening making(t_progress);
  const ProgressScope scope(&making);
  return Engine(project, plugins);
}

}  // namespace

SharedCopy copyForSharing(Project project, const PluginRegistry& plugins) {
  SharedCopy copy;
  const std::vector<Material> whole = compileMaterials(project, plugins);
  for (size_t k = 0; k < project.materials.size(); ++k) {
    SceneMaterial& material = project.materials[k];
    if (comesAlong(plugins, material.base) || !plugins.material(material.base) || hasOwnTrack(project, material.id))
      continue;
    SceneMaterial out = writtenOut(whole[k], plugins);
    out.id = material.id;
    out.mixture = material.mixture;
    out.unknown = material.unknown;
    out.tags = material.tags;
    material = std::move(out);
    copy.written.push_back(material.id);
  }
  if (!copy.written.empty()) {
    // Lists that named an installed one mean nothing elsewhere.
    for (size_t k = 0; k < project.materials.size(); ++k)
      if (project.materials[k].adheresTo) project.materials[k].adheresTo = whole[k].adheresTo;
    dropMaterials(project.pluginsUsed, plugins);
    dropMaterials(project.pluginsRequired, plugins);
  }
  project.end.reset();
  for (const std::string& id : usedPlugins(project))
    if (!comesAlong(plugins, id)) copy.needed.push_back(id);
  copy.project = std::move(project);
  return copy;
}

uint64_t lastFrameOf(const Project& project) {
  constexpr double kMost = 1e9;
  return static_cast<uint64_t>(std::clamp(std::round(project.duration / frameLength(project)), 0.0, kMost));
}

RunEnd runToEnd(const Project& project, PluginRegistry& plugins, uint64_t frame, const std::string& program) {
  Engine engine = made(project, plugins);
  const uint64_t begun = engine.stats().frame;
  if (t_progress) t_progress->expect(1);
  beginStage("Running to the end, by which machines are compared", 1,
             static_cast<double>(frame > begun ? frame - begun : 0));
  for (uint64_t at = begun; at < frame; ++at) {
    const StepReport step = engine.step();
    if (step.flags & kTakenBack)
      throw Error("the run ends at frame " + std::to_string(at) + (step.message.empty() ? "" : ": " + step.message));
    advance(1);
  }
  const FrameStats stats = engine.stats();
  return {.frame = stats.frame,
          .time = stats.time,
          .hash = hashText(engine.stateHash()),
          .scene = sceneHash(project),
          .program = program,
          .particles = engine.particles().size(),
          .temperature = stats.temperatureMean,
          .thermalEnergy = stats.thermalEnergy,
          .kineticEnergy = stats.kineticEnergy};
}

std::string differences(const RunEnd& noted, const RunEnd& found) {
  if (noted.hash == found.hash && noted.frame == found.frame) return {};
  std::string text;
  const auto add = [&](const std::string& sentence) { text += (text.empty() ? "" : "; ") + sentence; };
  if (noted.scene != found.scene) add("the project has been changed since its end was noted");
  if (noted.program != found.program && !noted.program.empty()) add("it was run by " + noted.program);
  if (noted.frame != found.frame) add("it begins after the frame of its end, " + std::to_string(noted.frame));
  const auto compare = [&](const char* what, double was, double is, const char* unit) {
    if (sixDigits(was) != sixDigits(is))
      add(what + (" " + sixDigits(is)) + unit + " instead of " + sixDigits(was) + unit);
  };
  const size_t before = text.size();
  compare("particles:", static_cast<double>(noted.particles), static_cast<double>(found.particles), "");
  compare("mean temperature", noted.temperature, found.temperature, " K");
  compare("thermal energy", noted.thermalEnergy, found.thermalEnergy, " J");
  compare("kinetic energy", noted.kineticEnergy, found.kineticEnergy, " J");
  if (text.size() == before)
    add("particles, heat and motion are the same to six digits, and the state differs in digits beyond");
  return text + " (state hash " + found.hash + " instead of " + noted.hash + ")";
}

}  // namespace ps
