// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/experiments/soak.h"
#include "core/plugin_host/registry.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--seconds", "S", "mechanical time of each run; without it 10"},
    {"--only", "ADDRESS", "soaks this parameter alone; may repeat, and the beginning of an address will do"},
    {"--list", "", "names the runs and does none"},
    kSet,
    kThreads,
    kIsa,
    kPatience,
};

std::string nameOf(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  return file.substr(0, file.rfind('.'));
}

void print(const std::string& project, const SoakVerdict& verdict) {
  char numbers[64] = "";
  if (verdict.ran) {
    std::snprintf(numbers, sizeof numbers, "%8.3g m/s  %6.1f ms", verdict.topSpeed, verdict.milliseconds);
  }
  const std::string what = verdict.change ? verdict.change->text() : "as it is";
  std::printf("%-20s  %-52s  %22s  %s\n", project.c_str(), what.c_str(), numbers, verdict.words.c_str());
  std::fflush(stdout);
}

int soakFile(const std::string& path, const Arguments& arguments) {
  auto plugins = std::make_unique<PluginRegistry>();
  const Project project = loadFor(arguments, path, *plugins);
  const double seconds = arguments.number("--seconds", 1e-3, 1e6).value_or(10);
  const std::vector<SliderChange> changes = sliderChanges(project, *plugins, arguments.all("--only"));
  for (const std::string& start : arguments.all("--only")) {
    const bool any = std::any_of(changes.begin(), changes.end(),
                                 [&](const SliderChange& change) { return change.address.text().starts_with(start); });
    if (!any) throw InputError(path + ": no slider begins with '" + start + "'; --list names them");
  }
  if (arguments.has("--list")) {
    for (const SliderChange& change : changes) {
      std::printf("%s  %s\n", nameOf(path).c_str(), change.text().c_str());
    }
    return 0;
  }
  int failed = 0;
  soakProject(project, plugins, changes, seconds, interrupted, [&](const SoakVerdict& verdict) {
    print(nameOf(path), verdict);
    failed += verdict.failed ? 1 : 0;
  });
  return failed;
}

}  // namespace

std::string soakHelp() {
  return "phasesketch-cli soak PROJECT... [options]\n\nRuns each project from its start as it is, and again with each "
         "of its sliders "
         "moved to either end of its range while it runs,\none at a time. Prints one line per run: what was moved, the "
         "highest speed of a particle, the mean length of a\nframe, and whether flags were raised. A slider that has "
         "changed nothing in a quarter of the run is not used "
         "by the scene\nand ends there. Exit code 1 when a run set a flag that its slider does not explain.\n\n" +
         optionHelp(kOptions);
}

int soakCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  if (arguments.positional().empty()) throw InputError("which project? --help says more");
  applyMachineOptions(arguments);
  int failed = 0;
  for (const std::string& path : arguments.positional()) failed += soakFile(path, arguments);
  if (failed == 0) return kFine;
  throw Error(counted(static_cast<size_t>(failed), "run") + " failed");
}

}  // namespace ps::cli
