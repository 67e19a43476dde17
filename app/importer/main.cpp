// SPDX-License-Identifier: Apache-2.0
// Reads one mesh of any format that assimp knows and writes its triangles to standard output: a process of its own,
// since parsers of files that come from anywhere keep having faults. What it may take of the machine is limited, it
// writes no file, and it reads none but those beside the mesh.
#include "core/io/meshpipe.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ps {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostTriangles = 10'000'000;
constexpr rlim_t kMostMemory = rlim_t{4} << 30, kMostSeconds = 300;

/// Opens what lies in the mesh's own folder or below it, and nothing that is no file.
class Beside : public Assimp::DefaultIOSystem {
 public:
  explicit Beside(const std::string& mesh) : m_folder(fs::canonical(mesh).parent_path()) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code problem;
    const fs::path path = fs::canonical(file, problem);
    if (problem || std::strpbrk(mode, "wa+") || !fs::is_regular_file(path, problem)) return nullptr;
    const fs::path within = path.lexically_relative(m_folder);
    if (within.empty() || *within.begin() == "..") return nullptr;
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  fs::path m_folder;
};

/// Tells the one who asked for the mesh how far it is.
class Telling : public Assimp::ProgressHandler {
 public:
  bool Update(float share) override {
    constexpr float kStep = 0.01f;
    if (share > 1 || share < m_told + kStep) return true;  // some readers say -1, or per cent
    m_told = share;
    return writeShare(STDOUT_FILENO, share);
  }

 private:
  float m_told = 0;
};

void limit(int what, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(what, &both);
}

void limitSelf() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#ifndef __SANITIZE_ADDRESS__  // which lays claim to terabytes of addresses
  limit(RLIMIT_AS, kMostMemory);
#endif
  limit(RLIMIT_CPU, kMostSeconds);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
}

/// m of a unit of the file, by its format or by what it says; 0: it does not say.
double metresPerUnit(const aiScene& scene, std::string extension) {
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  double centimetres = 0;
  float single = 0;
  if (scene.mMetaData && scene.mMetaData->Get("UnitScaleFactor", centimetres)) return centimetres / 100;
  if (scene.mMetaData && scene.mMetaData->Get("UnitScaleFactor", single)) return double{single} / 100;
  if (extension == ".gltf" || extension == ".glb" || extension == ".dae") return 1;
  return extension == ".3mf" ? 0.001 : 0;
}

void addPart(SceneMesh& mesh, const aiMesh& part, const aiMatrix4x4& pose) {
  const auto first = static_cast<uint32_t>(mesh.points.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D p = pose * part.mVertices[i];
    mesh.points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  const bool mirrored = pose.Determinant() < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    std::array<uint32_t, 3> corners{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
    if (mirrored) std::swap(corners[1], corners[2]);  // its outside would face inwards
    mesh.triangles.push_back(corners);
  }
  if (mesh.triangles.size() > kMostTriangles)
    throw InputError("has more than 10 million triangles; reduce it in the program that made it");
}

/// All parts of the file where its nodes place them. Not by assimp's own step for that: it leaves mirrored parts inside
/// out, and takes minutes for some files.
SceneMesh trianglesOf(const aiScene& scene) {
  SceneMesh mesh;
  std::vector<std::pair<const aiNode*, aiMatrix4x4>> left;
  if (scene.mRootNode) left.emplace_back(scene.mRootNode, scene.mRootNode->mTransformation);
  while (!left.empty()) {
    const auto [node, pose] = left.back();
    left.pop_back();
    for (unsigned m = 0; m < node->mNumMeshes; ++m) addPart(mesh, *scene.mMeshes[node->mMeshes[m]], pose);
    for (unsigned c = node->mNumChildren; c-- > 0;)
      left.emplace_back(node->mChildren[c], pose * node->mChildren[c]->mTransformation);
  }
  return mesh;
}

MeshFile readMesh(const std::string& path) {
  Assimp::Importer importer;
  importer.SetIOHandler(new Beside(path));     // which it deletes
  importer.SetProgressHandler(new Telling());  // likewise
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      static_cast<int>(aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                       aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                       aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS));
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_RemoveComponent);
  if (!scene) throw InputError(std::string("cannot be read as a mesh: ") + importer.GetErrorString());
  return {trianglesOf(*scene), metresPerUnit(*scene, fs::path(path).extension())};
}

int serve(const std::string& path) {
  MeshFile file;
  std::string problem;
  try {
    file = readMesh(path);
  } catch (const std::bad_alloc&) {
    problem = "takes more memory than a mesh may";
  } catch (const std::exception& error) {
    problem = error.what();
  }
  return writeMesh(STDOUT_FILENO, file, problem) ? 0 : 1;
}

}  // namespace
}  // namespace ps

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  ps::limitSelf();
  return ps::serve(argv[1]);
}
