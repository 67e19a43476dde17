// SPDX-License-Identifier: Apache-2.0
// --set: each line changes a sound project before it is checked.
#include "tests/fuzz/fuzz.h"
#include "tests/shared/scenes.h"

#include <sstream>

namespace {

/// With a material of its own, whose tables are made each time it is read, only where something is said of materials:
/// that takes ten times as long as all the rest.
const std::string& soundFor(const std::string& edits) {
  static const auto written = [](bool own) {
    ps::Project project = ps::scenes::iceOnPlate(2, 400);
    if (!own) project.materials.clear();
    return ps::writeProject(project);
  };
  static const std::string own = written(true), installed = written(false);
  return edits.find("materials") == std::string::npos ? installed : own;
}

}  // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ps;
  const std::string text = fuzz::textOf(data, size);
  const std::string& sound = soundFor(text);
  std::vector<std::string> edits;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) edits.push_back(line);
  try {
    const LoadedProject loaded = readProject(sound, fuzz::kName, fuzz::plugins(), edits);
    fuzz::requireReadsBack(loaded.project);
  } catch (const InputError& problem) {
    const std::string message = problem.what();
    fuzz::requireMessage(message, message.starts_with("--set ") ? "--set " : fuzz::kName);
  }
  return 0;
}
