// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// What the handles turn and scale about: the middle of all that is selected, each thing about its own, all about the
/// one that was selected last, or about the origin of the scene.
enum class Pivot { Middle, Each, Last, Origin };

/// By which steps the handles go.
struct Snapping {
  bool on = false;   ///< all the time; the keys that do so for one drag then let it go freely
  double move = 0;   ///< m; 0: the particles' spacing
  double turn = 15;  ///< degrees
  double scale = 0.1;
  bool surfaces = false;  ///< what is moved by steps comes to stand on what is below it
  bool operator==(const Snapping&) const = default;
};

/// How the handles work, in all projects.
struct HandleSettings {
  Pivot pivot = Pivot::Middle;
  Snapping snap{};
  bool operator==(const HandleSettings&) const = default;
};

}  // namespace ps
