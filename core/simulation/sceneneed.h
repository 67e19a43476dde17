// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/memory.h"
#include "core/scene/project.h"

#include <optional>
#include <string>

namespace ps {

class PluginRegistry;

/// What a scene takes once it runs, estimated from its project: too little by no more than a twentieth, and too much by
/// the stages that it leaves idle: 1.8 times where heat flows, 3.5 times where nothing does.
struct SceneNeed {
  double particles = 0, bytes = 0;  ///< of the bodies at the start
  /// Of what its emitters may add, as far as their `most` and the times at which they are open go.
  double pouredParticles = 0, pouredBytes = 0;
};

/// Values of the solver that decide about it, in place of the project's.
struct SceneScale {
  double spacing = 0, reach = 0;  ///< m; spacings
};
SceneScale scaleOf(const Project& project);

/// Found from shapes and numbers alone, without making anything. `plugins`: nullptr counts no structure.
SceneNeed needOf(const Project& project, const PluginRegistry* plugins);
SceneNeed needOf(const Project& project, const PluginRegistry* plugins, const SceneScale& scale);
/// Bytes that a particle of a body takes.
double particleBytes(const Project& project, const PluginRegistry* plugins, const Body& body, const SceneScale& scale);
/// Of all bodies, in the mean.
double meanParticleBytes(const Project& project, const PluginRegistry* plugins, const SceneScale& scale);
/// The most that a particle of an emitter takes.
double pouredParticleBytes(const Project& project, const PluginRegistry* plugins, const SceneScale& scale);

/// Bytes that a scene may take where there is this much memory: a seventh is left to everything else.
double roomFor(const Memory& memory);
/// Bytes by which a scene that stands already may grow.
double roomToGrow(const Memory& memory);

/// "" or why the scene of a project does not fit: "the scene needs about 55 GB of memory for 20.1 million particles,
/// and this machine has 20 GB for it; a particle spacing of 3.1 mm or more would fit".
std::string memoryProblem(const Project& project, const PluginRegistry* plugins, const SceneScale& scale,
                          const Memory& memory);
/// "20.1 million particles", "6,000 particles".
std::string particlesText(double count);

}  // namespace ps
