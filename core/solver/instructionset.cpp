// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/solver/fluid/pairkernels.h"
#include "core/solver/solver.h"

#include <hwy/targets.h>

namespace ps {
namespace {

/// Targets that this machine runs and this binary holds; lower bits are better ones.
int64_t usable() {
  hwy::SetSupportedTargetsForTest(0);  // 0 lifts the restriction
  return hwy::SupportedTargets() & targets::compiled();
}

std::string& pinned() {
  static std::string name;
  return name;
}

int64_t bitOf(const std::string& name) {
  for (int64_t remaining = usable(); remaining != 0; remaining &= remaining - 1) {
    const int64_t bit = remaining & ~(remaining - 1);
    if (name == hwy::TargetName(bit)) return bit;
  }
  return 0;
}

void apply(const std::string& name) {
  hwy::SetSupportedTargetsForTest(name.empty() ? 0 : bitOf(name));
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> availableInstructionSets() {
  std::vector<std::string> names;
  for (int64_t remaining = usable(); remaining != 0; remaining &= remaining - 1)
    names.emplace_back(hwy::TargetName(remaining & ~(remaining - 1)));
  apply(pinned());
  return names;
}

void setInstructionSet(const std::string& name) {
  if (!name.empty() && bitOf(name) == 0) {
    std::string choices;
    for (const std::string& choice : availableInstructionSets()) choices += (choices.empty() ? "" : ", ") + choice;
    throw InputError("instruction set '" + name + "' is not available here; choose one of " + choices);
  }
  pinned() = name;
  apply(name);
}

std::string instructionSet() { return pinned().empty() ? availableInstructionSets().front() : pinned(); }

}  // namespace ps
