// SPDX-License-Identifier: Apache-2.0
// A project file: refused with a sentence, or read; and what was read is saved and opens again as it was.
#include "tests/fuzz/fuzz.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ps;
  try {
    const LoadedProject loaded = readProject(fuzz::textOf(data, size), fuzz::kName, fuzz::plugins());
    for (const auto* messages : {&loaded.warnings, &loaded.problems})
      for (const ProjectMessage& message : *messages) fuzz::requireMessage(message.text);
    fuzz::requireReadsBack(loaded.project);
  } catch (const InputError& problem) {
    fuzz::requireMessage(problem.what());
  }
  return 0;
}
