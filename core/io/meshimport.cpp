// SPDX-License-Identifier: Apache-2.0
#include "core/io/meshimport.h"

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/io/meshpipe.h"
#include "core/scene/solidform.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>

extern char** environ;

namespace ps {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "phasesketch-import";
constexpr double kReading = 0.7, kMending = 0.15, kReducing = 0.15;  ///< of the time that it takes
constexpr size_t kReadSteps = 1000;
constexpr int kLook = 50;                             ///< ms between two questions whether to go on
constexpr size_t kMostBytes = size_t{1} << 30;        ///< of what the process tells
constexpr double kLeastSize = 1e-6, kMostSize = 1e4;  ///< m, as solids may have

std::string importer() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& path : {folder / kProgram, folder / ".." / "bin" / kProgram}) {
    if (::access(path.c_str(), X_OK) == 0) return path;
  }
  throw Error(std::string(kProgram) + ", which reads meshes, does not lie beside this program; install it again");
}

/// The process that reads one mesh; it does not outlive this.
class MeshProcess {
 public:
  explicit MeshProcess(const std::string& path) {
    std::string program = importer(), file = path;
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(std::string("no pipe can be made: ") + ::strerror(errno));
    m_pipe = ends[0];
    char* arguments[] = {program.data(), file.data(), nullptr};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int problem = ::posix_spawn(&m_child, program.c_str(), &actions, nullptr, arguments, environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (problem != 0) throw Error(std::string("no process can be started: ") + ::strerror(problem));
  }
  ~MeshProcess() {
    ::close(m_pipe);
    if (m_child <= 0) return;
    ::kill(m_child, SIGKILL);
    ::waitpid(m_child, nullptr, 0);
  }
  MeshProcess(const MeshProcess&) = delete;
  MeshProcess& operator=(const MeshProcess&) = delete;

  /// All that it tells. Throws InputError where that takes too long or is too much, Cancelled.
  std::string read(double patience) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(std::lround(1000 * patience));
    std::string bytes;
    std::vector<char> part(1 << 16);
    size_t told = 0;
    for (;;) {
      advance(0);
      if (std::chrono::steady_clock::now() > end) throw InputError("was not read within the time that a mesh may take");
      pollfd waited{m_pipe, POLLIN, 0};
      if (::poll(&waited, 1, kLook) <= 0) continue;
      const ssize_t count = ::read(m_pipe, part.data(), part.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return bytes;
      if (bytes.size() + static_cast<size_t>(count) > kMostBytes) throw InputError("has more triangles than fit");
      bytes.append(part.data(), static_cast<size_t>(count));
      if (const auto share = takeShare(bytes)) {
        const auto steps = static_cast<size_t>(*share * kReadSteps);
        advance(steps - std::min(steps, told));
        told = std::max(told, steps);
      }
    }
  }
  /// Its exit status, as of waitpid().
  int wait() {
    int status = 0;
    while (::waitpid(m_child, &status, 0) < 0 && errno == EINTR) {
    }
    m_child = 0;
    return status;
  }

 private:
  pid_t m_child = 0;
  int m_pipe = -1;
};

MeshFile readFile(const std::string& path, double patience) {
  MeshProcess process(path);
  const std::string bytes = process.read(patience);
  const int status = process.wait();
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGKILL) throw InputError("takes more time or memory than a mesh may");
    throw InputError(std::string("is broken in such a way that its reader crashed (") + ::strsignal(signal) + ")");
  }
  return meshFrom(bytes);
}

void scale(SceneMesh& mesh, double factor) {
  for (auto& point : mesh.points) {
    for (float& c : point) c = static_cast<float>(c * factor);
  }
}

/// Of a file's name, what an id may hold.
std::string idOf(const std::string& stem) {
  std::string id;
  for (const char c : stem) {
    const bool fits = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fits || (!id.empty() && id.back() != '-')) id += fits ? c : '-';
  }
  while (id.ends_with('-')) id.pop_back();
  return id.empty() ? "mesh" : id.substr(0, 40);
}

Vector3 extentOf(const SceneMesh& mesh) {
  const MeshBounds bounds = boundsOf(mesh);
  return bounds.maximum - bounds.minimum;
}

void requireSize(const SceneMesh& mesh) {
  const Vector3 extent = extentOf(mesh);
  if (extent.maxCoeff() > kMostSize)
    throw InputError("would be " + numberText(extent.maxCoeff()) + " m large; give its unit, such as mm");
  if (extent.minCoeff() < kLeastSize) throw InputError("is flat: it encloses no volume that matter could fill");
}

/// "bunny.ply: 12 points joined, 70000 of 140000 triangles kept, at most 1e-05 m off"
std::string originOf(const std::string& file, const ImportedMesh& imported) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? ": " : ", ") + what; };
  const MeshRepair& mended = imported.repair;
  if (mended.joined > 0) add(std::to_string(mended.joined) + " points joined");
  if (mended.left > 0) add(std::to_string(mended.left) + " triangles without an area left out");
  if (mended.turned) add("turned right side out");
  if (const MeshReduction& reduction = imported.reduction; reduction.any())
    add(std::to_string(reduction.to) + " of " + std::to_string(reduction.from) + " triangles kept, at most " +
        numberText(reduction.error) + " m off");
  return file + text;
}

}  // namespace

std::optional<double> metresPer(const std::string& unit) {
  constexpr std::pair<const char*, double> kUnits[] = {{"mm", 0.001}, {"cm", 0.01}, {"m", 1}, {"in", 0.0254}};
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return metres;
  }
  return std::nullopt;
}

ImportedMesh importMesh(const std::string& path, std::optional<double> metresPerUnit, double patience, size_t most) {
  try {
    std::error_code problem;
    if (!fs::exists(path, problem)) throw InputError("there is no such file");
    if (!fs::is_regular_file(path, problem)) throw InputError("is no file");
    beginStage("Reading", kReading, kReadSteps);
    MeshFile file = readFile(path, patience);
    ImportedMesh imported;
    imported.unitIsOfFile = !metresPerUnit && file.metresPerUnit > 0;
    const double meant = extentOf(file.mesh).maxCoeff() > kMostSize ? 0.001 : 1;
    imported.metresPerUnit = metresPerUnit.value_or(imported.unitIsOfFile ? file.metresPerUnit : meant);
    scale(file.mesh, imported.metresPerUnit);
    beginStage("Mending", kMending, 1);
    imported.repair = repair(file.mesh);
    requireSize(file.mesh);
    beginStage("Reducing", kReducing, 1);
    advance(0);
    imported.reduction = reduce(file.mesh, most);
    file.mesh.name = fs::path(path).stem();
    file.mesh.id = idOf(file.mesh.name);
    imported.facts = factsOf(file.mesh);
    file.mesh.origin = originOf(fs::path(path).filename(), imported);
    imported.mesh = std::make_shared<const SceneMesh>(std::move(file.mesh));
    advance(1);
    return imported;
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

Body bodyOf(const ImportedMesh& imported) {
  const MeshBounds bounds = boundsOf(*imported.mesh);
  const Vector3 size = bounds.maximum - bounds.minimum;
  SolidShape solid;
  solid.mesh = imported.mesh;
  solid.meshId = imported.mesh->id;
  auto& values = solid.parameters.values;
  values["kind"] = std::string("mesh");
  values["size_x"] = size[0], values["size_y"] = size[1], values["size_z"] = size[2];
  values["position_y"] = size[1] / 2;
  Body body;
  body.id = imported.mesh->id;
  body.name = imported.mesh->name;
  body.shape = std::move(solid);
  return body;
}

Body wallOf(const ImportedMesh& imported) {
  Body wall = bodyOf(imported);
  std::get<SolidShape>(wall.shape).parameters.values["inside"] = std::string("hollow");
  wall.parameters.values["fixed"] = true;
  wall.parameters.values["heat"] = std::string("adiabatic");
  return wall;
}

}  // namespace ps
