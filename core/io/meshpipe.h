// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"
#include "core/scene/project.h"

#include <optional>
#include <string>

// What the process that reads meshes tells the one that asked it.
namespace ps {

struct MeshFile {
  SceneMesh mesh;            ///< in units of the file
  double metresPerUnit = 0;  ///< as the file has it; 0: it does not say
};

/// Tells, before the mesh, how much of the file has been read, 0..1. False when nobody reads.
bool writeShare(int descriptor, float share);
/// Takes what that wrote off the front of what has come so far, and returns the last of it; nothing where there is
/// none.
std::optional<double> takeShare(std::string& bytes);
/// Writes a mesh, or where `problem` is not "", that sentence. False when nobody reads.
bool writeMesh(int descriptor, const MeshFile& file, const std::string& problem);
/// What writeMesh() wrote. Throws InputError with its sentence, in one line, and Error for what it never writes.
MeshFile meshFrom(const std::string& bytes);

}  // namespace ps
