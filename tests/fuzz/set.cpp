// SPDX-License-Identifier: Apache-2.0
// --set: each line changes a sound project before it is checked.
#include "tests/fuzz/fuzz.h"
#include "tests/shared/scenes.h"

#include <sstream>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ps;
  static const std::string sound = writeProject(scenes::iceOnPlate(2, 400));
  std::vector<std::string> edits;
  std::istringstream lines(fuzz::textOf(data, size));
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
