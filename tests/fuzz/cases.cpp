// SPDX-License-Identifier: Apache-2.0
// A file of cases, with its formulas.
#include "core/base/error.h"
#include "core/experiments/casefile.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <cmath>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ps;
  static const fuzz::File file("cases.json");
  file.write(fuzz::textOf(data, size));
  try {
    for (const Case& one : readCases(file.path())) {
      for (const CaseCheck& check : one.checks) {
        const bool finite = std::all_of(check.expected.begin(), check.expected.end(),
                                        [](double expected) { return std::isfinite(expected); });
        fuzz::require(finite, "what is expected is a number");
      }
    }
  } catch (const InputError& problem) {
    fuzz::requireMessage(problem.what(), file.path());
  }
  return 0;
}
