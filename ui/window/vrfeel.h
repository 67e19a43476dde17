// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/vr/headsetlink.h"

namespace ps {

/// What a hand feels of a body that it leads: the strongest of the force on it, of how much warmer or colder what
/// touches it is, and of what melting and boiling take up there. Each has a frequency of its own, by which it is told
/// apart.
vr::Feeling feelingOf(const ToolContact& contact);

/// What a hand feels that carries, pushes or stirs matter so hard, N.
vr::Feeling feelingOfEffort(double effort);

vr::Feeling stronger(const vr::Feeling& a, const vr::Feeling& b);

/// What a hand that heats or cools feels of the matter within `radius` m of a place: how steeply its temperature
/// changes from place to place, or how much of it takes up latent heat, or gives it, whichever is stronger.
///
/// It cannot do: feel matter across a face of a periodic box; tell how fast latent heat goes.
vr::Feeling feelingOf(const Snapshot& scene, const Vector3& place, double radius);

/// K/m, of the plane that fits best to the temperatures there, by volume; 0 where there is too little matter to say.
double steepnessAt(const Snapshot& scene, const Vector3& place, double radius);
/// 0..1, by volume: of the matter there what melts, freezes, boils or condenses.
double changingAt(const Snapshot& scene, const Vector3& place, double radius);

}  // namespace ps
