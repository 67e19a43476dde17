// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/experiments/sharing.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"

#include <cstdio>

namespace ps::cli {
namespace {

constexpr const char* kThisProgram = "phasesketch " PS_VERSION;

constexpr OptionSpec kOptions[] = {
    {"--out", "FILE.json", "where the copy goes"},
    {"--check", "", "runs a copy of somebody's to its end, and says whether it comes to the same here"},
    {"--seconds", "S",
     "mechanical time until the end that is noted; without it what is left of the project's duration"},
    {"--frames", "N", "the same in frames"},
    kThreads,
    kIsa,
    kPatience,
    kSet,
    kQuiet,
};

/// Ends with Ctrl+C.
RunEnd run(const Project& project, PluginRegistry& plugins, uint64_t frame) {
  class Interruptible final : public ps::Progress {
    void advanced(size_t) override {
      if (interrupted()) cancel();
    }
  } progress;
  const ProgressScope scope(&progress);
  return runToEnd(project, plugins, frame, kThisProgram);
}

int check(const Arguments& arguments, const std::string& path) {
  PluginRegistry plugins;
  const Project project = loadFor(arguments, path, plugins);
  if (!project.end) throw InputError(path + ":/end: is missing: it is no copy for others, see share --help");
  const std::string differs = differences(*project.end, run(project, plugins, project.end->frame));
  if (!differs.empty()) throw Error(path + ": not reproduced: " + differs);
  if (!arguments.has("--quiet"))
    std::printf("%s: reproduced: after %llu frames the state is the same, hash %s\n", path.c_str(),
                static_cast<unsigned long long>(project.end->frame), project.end->hash.c_str());
  return kFine;
}

int write(const Arguments& arguments, const std::string& path) {
  requireOutputs(arguments, {path}, {"--out"});
  PluginRegistry plugins;
  const Project project = loadFor(arguments, path, plugins);
  SharedCopy copy = copyForSharing(project, plugins);
  const uint64_t begun = project.state ? project.state->frame : 0;
  const long frames = frameCount(arguments, project, project.state ? project.state->time : 0);
  // What is read back is what is run: a number may have lost its last bit on the way through the file.
  const Project written = parseProject(writeProject(copy.project), path, plugins).project;
  copy.project.end = run(written, plugins, begun + static_cast<uint64_t>(frames));
  saveProject(copy.project, arguments.text("--out"));
  if (arguments.has("--quiet")) return kFine;
  for (const std::string& id : copy.written) std::printf("the material '%s' is written out\n", id.c_str());
  for (const std::string& id : copy.needed)
    std::fprintf(stderr, "warning: the plugin '%s' does not come with the program: others have to install it\n",
                 id.c_str());
  std::printf("%s: its run ends at frame %llu, state hash %s\n", arguments.text("--out").c_str(),
              static_cast<unsigned long long>(copy.project.end->frame), copy.project.end->hash.c_str());
  return kFine;
}

}  // namespace

std::string shareHelp() {
  return "phasesketch-cli share PROJECT --out FILE.json [options]\nphasesketch-cli share --check FILE.json "
         "[options]\n\n"
         "Writes a copy for others: one file, with materials that do not come with the program written out, and with "
         "what\nits run comes to. Whoever has it can see whether it comes to the same elsewhere. Exit code 1 when it "
         "does not.\n\n" +
         optionHelp(kOptions);
}

int shareCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "project");
  if (arguments.has("--check") == arguments.has("--out"))
    throw InputError("give --out FILE.json for the copy, or --check to check one");
  if (arguments.has("--check") && (arguments.has("--seconds") || arguments.has("--frames")))
    throw InputError("--check runs to the end that the copy notes: leave out --seconds and --frames");
  applyMachineOptions(arguments);
  return arguments.has("--check") ? check(arguments, path) : write(arguments, path);
}

}  // namespace ps::cli
