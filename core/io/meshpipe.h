// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"
#include "core/scene/project.h"

#include <string>

// What the process that reads meshes tells the one that asked it.
namespace ps {

struct MeshFile {
  SceneMesh mesh;            ///< in units of the file
  double metresPerUnit = 0;  ///< as the file has it; 0: it does not say
};

/// Writes a mesh, or where `problem` is not "", that sentence. False when nobody reads.
bool writeMesh(int descriptor, const MeshFile& file, const std::string& problem);
/// What writeMesh() wrote. Throws InputError with its sentence, in one line, and Error for what it never writes.
MeshFile meshFrom(const std::string& bytes);

}  // namespace ps
