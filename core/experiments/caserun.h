// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/casefile.h"
#include "core/experiments/run.h"

#include <functional>
#include <optional>
#include <string>

namespace ps {

class PluginRegistry;

/// One number of a case beside what theory says about it.
struct CaseVerdict {
  std::string id;                            ///< of the case
  std::string what;                          ///< the number, and the run where a case has several
  std::optional<double> expected, measured;  ///< neither where the run failed
  std::string tolerance;                     ///< "±2 %, ≤ 0.5"; why the run failed
  bool holds = false;
  /// Where it does not hold: what the solver said by itself that this run asked of it and did not get, by those of its
  /// limits that concern the check.
  std::string told{};
};
using VerdictVisitor = std::function<void(const CaseVerdict&)>;

/// How a measured number stands to what its check asks. What is not finite never holds.
CaseVerdict verdictOf(const Case& what, const std::string& name, const CaseCheck& check, std::optional<double> expected,
                      double measured);
/// Whether a limit of that name may be why a check was missed: what it names, or any where it names none.
bool concerns(const CaseCheck& check, const std::string& limit);
/// Runs a case with all its runs and hands over a verdict for each of its numbers, or a single one that says why it
/// could not be run. `more`: changes of the project after the case's own.
void runCase(const Case& what, const ProjectEdits& more, PluginRegistry& plugins, const StopTest& stop,
             const VerdictVisitor& each);

}  // namespace ps
