// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/projectstate.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/statestream.h"
#include "core/scene/pose.h"
#include "core/scene/shownname.h"
#include "core/simulation/scenestate.h"

#include <algorithm>
#include <iterator>
#include <variant>

namespace ps {
namespace {

void add(Hash& hash, const Vector3& v) {
  for (const double c : v) hash.add(c);
}

void add(Hash& hash, const BoxShape& box) {
  add(hash, box.center);
  add(hash, box.size);
}

void add(Hash& hash, const VoxelShape& voxels) {
  add(hash, voxels.origin);
  hash.add(voxels.spacing);
  if (!poseOf(voxels).isNothing()) add(hash, voxels.rotation), add(hash, voxels.shift);
  for (const VoxelShape::Run& run : voxels.runs) {
    for (const int number : {run.x, run.y, run.z, run.length, run.palette}) hash.add(int64_t{number});
  }
}

void add(Hash& hash, const SolidShape& solid) {
  const api::ParameterList list = solidParameters();
  for (size_t k = 0; k < list.count; ++k) {
    const Value value = valueOf(solid.parameters, list[k]);
    if (const auto* number = std::get_if<double>(&value)) hash.add(*number);
    if (const auto* name = std::get_if<std::string>(&value)) hash.add(name->data(), name->size());
  }
  if (!solid.mesh) return;
  hash.add(solid.mesh->points.data(), std::span(solid.mesh->points).size_bytes());
  hash.add(solid.mesh->triangles.data(), std::span(solid.mesh->triangles).size_bytes());
}

std::string stampOf(const Body& body) {
  Hash hash;
  hash.add(uint64_t{body.shape.index()});
  std::visit([&](const auto& shape) { add(hash, shape); }, body.shape);
  return hashText(hash.value());
}

std::string whyOfOtherBodies(const ProjectState& state, const std::vector<Body>& bodies) {
  for (const Body& body : bodies) {
    const auto known = std::find_if(state.bodies.begin(), state.bodies.end(),
                                    [&](const ProjectState::Shape& shape) { return shape.id == body.id; });
    if (known == state.bodies.end()) return "the body '" + shownName(body) + "' came later";
    if (known->stamp != stampOf(body)) return "the body '" + shownName(body) + "' has another shape by now";
  }
  for (const ProjectState::Shape& shape : state.bodies) {
    if (std::none_of(bodies.begin(), bodies.end(), [&](const Body& body) { return body.id == shape.id; }))
      return "the body '" + shape.id + "' has gone";
  }
  return {};
}

/// Those that say what the state needs: few bytes beside all others.
std::vector<PackedBlock> sceneBlocks(const ProjectState& state) {
  std::vector<PackedBlock> blocks;
  std::copy_if(state.blocks.begin(), state.blocks.end(), std::back_inserter(blocks), [](const PackedBlock& block) {
    return block.name.starts_with("scene/") || block.name == "field/body" || block.name == "field/material";
  });
  return blocks;
}

}  // namespace

std::shared_ptr<const ProjectState> projectState(std::span<const std::byte> stream, const std::vector<Body>& bodies) {
  const StateReader reader(stream);
  auto state = std::make_shared<ProjectState>();
  state->frame = reader.array<uint64_t>("clock/frames").at(0);
  state->time = reader.array<double>("clock/seconds").at(0);
  for (const Body& body : bodies) state->bodies.push_back({body.id, stampOf(body)});
  state->blocks = packState(reader);
  return state;
}

std::string whyStateDoesNotFit(const ProjectState& state, const Project& project, const PluginRegistry& plugins) {
  if (const std::string why = whyOfOtherBodies(state, project.bodies); !why.empty())
    return "the state is of another scene: " + why;
  try {
    const StateBuffer buffer = unpackState(sceneBlocks(state));
    const StateReader reader(buffer.bytes());
    const SceneState scene = SceneState::read(reader);
    requireGoesOn(scene, project, plugins);
    requireOwners(scene, reader, project);
    (void)materialsInOrder(scene, reader, project);
  } catch (const InputError& problem) {
    return problem.what();
  }
  return {};
}

}  // namespace ps
