// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/jsontext.h"
#include "core/experiments/probetable.h"
#include "core/experiments/runreport.h"
#include "core/experiments/settlingmeasure.h"
#include "core/io/recording.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"

#include <cstdio>
#include <optional>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--seconds", "S", "mechanical time to simulate; without it the project's duration"},
    {"--frames", "N", "frames to simulate, instead of --seconds"},
    kThreads,
    kIsa,
    {"--report", "FILE.json", "writes speed, accuracy, energy, phases and the state hash"},
    {"--probes", "FILE.csv", "writes the probes, the mass in each phase and the mean temperature of every frame"},
    {"--record", "FILE", "writes every frame, for render"},
    kSet,
    kQuiet,
};

void summarise(const RunReport& report, Engine& engine, double wall) {
  const FrameStats stats = engine.stats();
  const double factor = wall > 0 ? stats.time / wall : 0;
  std::printf("%zu frames, %.6g s simulated in %.3g s (%.3g times real time), %.3g ms per frame\n", report.frames(),
              stats.time, wall, factor, report.total().median);
  std::printf("%s, state hash %s\n", counted(engine.solver().particles().size(), "particle").c_str(),
              hashText(engine.solver().stateHash()).c_str());
}

}  // namespace

std::string simulateHelp() {
  return "phasesketch-cli simulate PROJECT [options]\n\nRuns a project without a window.\n\n" + optionHelp(kOptions) +
         "\nThe report is in SI units but for milliseconds, where a key says ms. Thermal energy counts from the solid "
         "at its\nmelting point, so that matter colder than that has less than none; what a run means is the "
         "difference.\n";
}

int simulateCommand(CommandArguments given) {
  const Arguments arguments(given, kOptions);
  const std::string path = onlyFile(arguments, "project");
  const bool quiet = arguments.has("--quiet");
  applyMachineOptions(arguments);
  PluginRegistry plugins;
  std::vector<std::string> warnings;
  const Project project = loadFor(arguments, path, plugins, &warnings);
  const long frames = frameCount(arguments, project);
  if (arguments.has("--report")) requireWritable(arguments.text("--report"));
  Engine engine(project, plugins);
  std::optional<ProbeTable> probes;
  std::optional<RecordingWriter> recording;
  if (arguments.has("--probes")) probes.emplace(arguments.text("--probes"), engine.probeNames());
  if (arguments.has("--record")) recording.emplace(arguments.text("--record"), project);
  RunReport report(engine.stats());
  SettlingMeasure settling(frames);
  const double start = now();
  if (recording) recording->add(*engine.snapshot());
  bool whole = false;
  {
    Progress progress(frames, quiet);
    whole = runFrames(engine, frames, [&](const StepReport& step, const FrameStats& stats) {
      report.add(step, stats);
      settling.add(engine, stats);
      if (probes) probes->add(stats);
      if (recording) recording->add(*engine.snapshot());
      progress.show(static_cast<long>(report.frames()), stats);
    });
  }
  const double wall = now() - start;
  if (probes) probes->finish();
  if (recording) recording->finish();
  if (arguments.has("--report")) {
    nlohmann::json content = report.json(engine, wall);
    content["rest"] = settling.json(engine);
    content["program"] = "phasesketch " PS_VERSION;
    content["project"] = {{"file", path}, {"title", project.title}};
    content["warnings"] = warnings;
    writeFileAtomically(arguments.text("--report"), writeJson(content));
  }
  if (!quiet) summarise(report, engine, wall);
  if (report.flags()) {
    std::string names;
    for (const std::string& name : flagNames(report.flags())) names += (names.empty() ? "" : ", ") + name;
    throw Error(path + ": the run set flags: " + names + (report.message().empty() ? "" : ": " + report.message()));
  }
  if (!whole)
    throw Error("stopped after " + std::to_string(report.frames()) + " of " + std::to_string(frames) + " frames");
  return kFine;
}

}  // namespace ps::cli
