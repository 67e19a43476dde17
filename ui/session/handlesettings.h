// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// What the handles turn and scale about: the middle of all that is selected, each thing about its own, all about the
/// one that was selected last, or about the origin of the scene.
enum class Pivot { Middle, Each, Last, Origin };

/// How the handles work, in all projects.
struct HandleSettings {
  Pivot pivot = Pivot::Middle;
  bool operator==(const HandleSettings&) const = default;
};

}  // namespace ps
