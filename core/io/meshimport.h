// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/geometry/meshreduce.h"
#include "core/geometry/meshrepair.h"
#include "core/scene/project.h"

#include <memory>
#include <optional>
#include <string>

namespace ps {

/// m of "mm", "cm", "m" or "in"; nothing for other words.
std::optional<double> metresPer(const std::string& unit);

/// Triangles that are kept of a mesh, at most, where nobody says how many: a project with so many takes some MB, and
/// finer ones than these no spacing tells from each other.
inline constexpr size_t kKeptTriangles = 200'000;

struct ImportedMesh {
  std::shared_ptr<const SceneMesh> mesh;  ///< repaired, in m; its id and name follow from the file's name
  MeshFacts facts;
  MeshRepair repair;
  MeshReduction reduction;
  double metresPerUnit = 1;
  bool unitIsOfFile = false;  ///< it says so itself
};

/// Reads a mesh of any format that assimp knows (OBJ, STL, PLY, glTF, FBX, 3MF, ...), open or closed, in a process of
/// its own, the program phasesketch-import beside this one, which may take 4 GiB and `patience` s: whatever the file
/// holds, this process is safe. Without `metresPerUnit` the file's own unit holds, and where it says none, metres, or
/// millimetres where that would be beyond 10 km. What is broken is mended (see repair()), what has more than `most`
/// triangles reduced (see reduce()); both are said in the mesh's origin. Advances the thread's Progress
/// by stages that weigh 1 together: reading, mending, reducing. Throws Cancelled, and InputError "PATH: what is wrong,
/// and what to do".
ImportedMesh importMesh(const std::string& path, std::optional<double> metresPerUnit = std::nullopt,
                        double patience = 120, size_t most = kKeptTriangles);

/// A body of the mesh, standing at the origin of the scene: all but its material.
Body bodyOf(const ImportedMesh& imported);
/// As a wall of its shape: its surface alone, held in place, which lets no heat through.
Body wallOf(const ImportedMesh& imported);

}  // namespace ps
