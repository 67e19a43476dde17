// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/fields.h"

// The tables of the project file; private to this room.
namespace ps::fields {

const FieldTable<Project>& projectFields();
const FieldTable<SceneMaterial>& materialFields();
const FieldTable<SceneMesh>& meshFields();
const FieldTable<Body>& bodyFields();
const FieldTable<VoxelShape>& voxelFields();
const FieldTable<Emitter>& emitterFields();
const FieldTable<Sink>& sinkFields();
const FieldTable<Environment>& environmentFields();
const FieldTable<SolverOptions>& solverFields();
const FieldTable<Probe>& probeFields();
const FieldTable<Graph>& graphFields();
const FieldTable<Track>& trackFields();
const FieldTable<Marker>& markerFields();
const FieldTable<SceneGroup>& groupFields();
const FieldTable<ViewState>& viewFields();
const FieldTable<ProjectState>& stateFields();
const FieldTable<RunEnd>& endFields();

/// With its own help, since a box is one thing among a body's pins and another in a probe.
FieldTable<Region> regionFields(const char* help);
/// The keys that every wave has.
FieldTable<Wave> waveFields(const char* help);

/// Sorted, each once: those that the file names itself, and those that the scene refers to.
std::vector<std::string> pluginsOf(const Project& project);

}  // namespace ps::fields
