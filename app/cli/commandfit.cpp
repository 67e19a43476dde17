// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/experiments/curvefit.h"
#include "core/experiments/wantedfile.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/edits.h"

#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--want", "FILE",
     "CSV with the titles time_s and that of one column of simulate's --probes, and the wanted points"},
    {"--vary", "ADDRESS=LEAST..MOST",
     "may change, in SI units; may repeat; without a range: that of its slider; ADDRESS@0: its first key"},
    {"--runs", "N", "ends after so many runs; 60"},
    {"--save", "FILE", "writes the project with what was found"},
    kSet,
    kAtStart,
    kThreads,
    kIsa,
    kPatience,
};

std::string valuesOf(const FitTrial& trial, const FitTask& task) {
  std::string text;
  for (size_t k = 0; k < trial.values.size(); ++k) {
    text += "  " + task.parameters[k].text() + " = " + numberText(trial.values[k]);
  }
  return text;
}

void print(const FitTrial& trial, const FitTask& task) {
  std::printf("run %3d  missed by %10.4g%s%s\n", trial.run, trial.error, valuesOf(trial, task).c_str(),
              trial.isBest ? "  best" : "");
  std::fflush(stdout);
}

}  // namespace

std::string fitHelp() {
  return "phasesketch-cli fit PROJECT --want FILE --vary ADDRESS... [options]\n\nLooks for values of parameters with "
         "which a quantity goes as wanted: runs the project again and again, as long as the\nwanted points reach, and "
         "prints for each run by how much it missed them (root mean square, in the column's unit). It\nfinds a "
         "minimum, not surely the least of all. Exit code 1 when no run came closer than the project as it is.\n\n" +
         optionHelp(kOptions);
}

int fitCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "project");
  if (!arguments.has("--want")) throw InputError("which curve? give --want FILE");
  requireOutputs(arguments, {path, arguments.text("--want")}, {"--save"});
  applyMachineOptions(arguments);
  PluginRegistry plugins;
  Project project = loadFor(arguments, path, plugins);
  if (arguments.has(kAtStart.name)) project.state = nullptr;
  FitTask task = readWanted(arguments.text("--want"));
  for (const std::string& text : arguments.all("--vary")) {
    task.parameters.push_back(FitParameter::parse(text, project, &plugins));
  }
  task.mostRuns = static_cast<int>(arguments.integer("--runs", 1, 100000).value_or(task.mostRuns));
  const FitResult result =
      fitToCurve(project, plugins, task, interrupted, [&](const FitTrial& trial) { print(trial, task); });
  if (result.runs == 0) throw Error("stopped in the first run");
  std::printf("%s in %d runs%s: missed by %.4g as it is, by %.4g with%s\n", task.column.c_str(), result.runs,
              result.stopped ? ", not done" : "", result.before.error, result.after.error,
              valuesOf(result.after, task).c_str());
  if (result.after.run == 1) throw Error("no run came closer than the project as it is");
  if (arguments.has("--save"))
    saveProject(withValues(project, plugins, task, result.after.values), arguments.text("--save"));
  return kFine;
}

}  // namespace ps::cli
