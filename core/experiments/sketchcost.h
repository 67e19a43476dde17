// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace ps {

struct Project;
class PluginRegistry;

/// What one kind of edit costs the engine's thread.
struct EditTimes {
  std::string what;
  double limit = 0;                  ///< ms that it should take at most
  std::vector<double> milliseconds;  ///< of each sample
};

/// What hands cost a scene that goes on living.
struct SketchCost {
  size_t particles = 0;  ///< before the first stroke
  std::vector<EditTimes> edits;
};

/// Draws, erases, paints and tints by a ball four particles in radius, which goes on by one at each sample, in and
/// above the matter of a scene; then a hand heats, pushes, holds, cuts and welds what is in such balls, of four places
/// a frame. `samples` of each kind, a frame between two. The scene needs a material "water" and matter about its
/// middle. Throws InputError where no scene can be made of it, or a plugin is missing that this needs.
SketchCost measureSketch(const Project& project, PluginRegistry& plugins, long samples);

}  // namespace ps
