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

/// Strokes go by a ball four particles in radius, which goes on by one at each sample, and hands have such balls, at
/// four places a frame. In this order: strokes draw liquid above the matter of a scene and held ice above that, a hand
/// cuts and welds the ice, strokes erase, paint and tint in the matter, and a hand heats, pushes and holds there; last
/// of all the ice is let go, and strokes draw on it where it has fallen to. `samples`, at least 1, of each kind, a
/// frame between two. The scene needs a material "water", matter about its middle, and above it room of 24 particle
/// spacings. Throws InputError where no scene can be made of it, a plugin is missing that this needs, or what is to be
/// cut is not tied.
SketchCost measureSketch(const Project& project, PluginRegistry& plugins, long samples);

}  // namespace ps
