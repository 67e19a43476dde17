// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/period.h"
#include "core/scene/project.h"
#include "core/solver/report.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ps {

struct PhaseAmount {
  uint64_t count = 0;
  double mass = 0;  ///< kg
};

struct FlowAmount {
  uint64_t count = 0;
  double mass = 0, energy = 0;  ///< kg, J
};
/// Matter that crossed into the scene by the mouths of emitters, and out of it by sinks, since the start, with the heat
/// that mouths let through; and what is held behind mouths now. Poured + held - drained is what the heat ledger calls
/// sources, less what was sketched and erased.
struct FlowTotal {
  FlowAmount poured, drained, held;
};

/// What one frame amounts to; small, kept for graphs and reports.
struct FrameStats {
  uint64_t frame = 0;
  double time = 0, thermalTime = 0;                                    ///< s
  std::array<PhaseAmount, 5> phases;                                   ///< by api::Phase; not of what is fixed or held
  double temperatureMin = 0, temperatureMean = 0, temperatureMax = 0;  ///< K, mean by mass
  double densityErrorMean = 0, densityErrorMax = 0;
  double thermalEnergy = 0, kineticEnergy = 0;  ///< J
  HeatLedger heat;
  FlowTotal flow;
  MomentumRecord momentum;  ///< of the last frame
  std::array<double, static_cast<size_t>(Stage::Count)> milliseconds{};
  double totalMilliseconds = 0;
  std::vector<double> probes;                          ///< in the order of `measured`
  std::shared_ptr<const std::vector<Probe>> measured;  ///< as they were then
};

/// What a tool feels that a hand leads through matter (MoveBody::led), over the last frame.
struct ToolContact {
  std::string body;        ///< Body::id
  Vector3 force{0, 0, 0};  ///< N, of all that presses on it or pulls, without its weight
  double heat = 0;         ///< W of the thermal clock that it takes up; below 0: that it gives
  double latent = 0;       ///< W that melting and boiling take up of the matter that touches it; below 0: give
  double gradient = 0;     ///< K/m, by which that is warmer than its surface, on the average
  uint32_t touching = 0;   ///< particles of other bodies within 1.5 spacings
  double behind = 0;       ///< m that it still has to go
};

struct ParticleField;
class RestPlaces;
/// What one field is of each particle, in its unit.
struct FieldValues {
  std::shared_ptr<const ParticleField> field;
  std::vector<float> values;
};

/// Bytes by keys of commands that name matter.
using MatterBytes = std::map<uint64_t, uint64_t>;

/// One published frame: immutable, read by viewport, graphs and recorder without a lock. Static particles included.
struct Snapshot {
  FrameStats stats;
  uint64_t revision = 0;  ///< rises with every reset: indices and ids of another revision do not compare
  double spacing = 0;     ///< m, of the particles; the project's may be another until the next reset
  StepFlags flags = 0;
  bool knowsStart = true;  ///< where particles stood at the start; noted only if a probe asks for it when they are made
  std::vector<Limit> limits;
  std::vector<ToolContact> tools;         ///< bodies that hands have led in this run, the last one first
  std::vector<uint64_t> erasedOrPainted;  ///< keys of commands that did so after the start, and were not undone
  std::shared_ptr<const MatterBytes> keptForUndo;  ///< what that keeps; nullptr: nothing
  Period period;                      ///< positions lie within its box: one that jumps by it has crossed a face
  std::vector<api::Float4> position;  ///< m; w: radius of a sphere of the rest volume, m
  std::vector<float> temperature;     ///< K
  std::vector<float> speed;           ///< m/s
  std::vector<float> densityError;
  std::vector<float> gasFraction;
  std::vector<api::Phase> phase;
  std::vector<api::Motion> motion;
  std::vector<uint32_t> id, body, material;
  std::vector<uint32_t> colour;     ///< of their own, see colourNumber(); empty: none has one
  std::vector<FieldValues> fields;  ///< those that were asked for beside what stands above, where particles have them
  std::shared_ptr<const std::vector<std::string>> bodyIds;  ///< Body::id by the index in `body`
  std::shared_ptr<const RestPlaces> rest;  ///< where particles of sketches were made; nullptr: nobody knows
  std::vector<uint8_t> heldBodies;         ///< 1 for those whose matter is held until it is let go, by the same index
  std::vector<std::string> materialIds;    ///< SceneMaterial::id by the index in `material`
  std::vector<std::array<float, 4>> materialLook;  ///< sRGB and clearness, 0..1, by material index
};
using SnapshotPtr = std::shared_ptr<const Snapshot>;

/// Builds are counted over the whole process, so that snapshots of two engines never pass for the same run.
uint64_t nextRevision();

}  // namespace ps
