// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/jsontext.h"
#include "core/base/nearest.h"
#include "core/base/statestream.h"
#include "core/experiments/probetable.h"
#include "core/experiments/runreport.h"
#include "core/experiments/settlingmeasure.h"
#include "core/io/outputfile.h"
#include "core/io/recording.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/projectstate.h"
#include "core/simulation/scenestate.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <span>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--seconds", "S", "mechanical time to simulate; without it what is left of the project's duration"},
    {"--frames", "N", "frames to simulate, instead of --seconds"},
    kAtStart,
    {"--from", "FILE", "goes on from a state that --save-state has written; frames count on from there"},
    {"--save-state", "FILE", "writes the state at the end, all that goes on into the next frame"},
    {"--save-project", "FILE.json", "writes the project with that state in it, so that it opens there"},
    kThreads,
    kIsa,
    kPatience,
    {"--report", "FILE.json", "writes speed, accuracy, energy, phases and the state hash"},
    {"--probes", "FILE.csv", "writes probes, heat balance, mass in each phase and mean temperature of every frame"},
    {"--record", "FILE", "writes every frame small, and states to go on from, for render and the editor"},
    {"--fields", "A,B",
     "what --record keeps of particles beside place, temperature, speed, density error and phase: fields as 'plugins "
     "--fields' lists them, or none; without it all"},
    kSet,
    kQuiet,
};

constexpr double kStateInterval = 2;                  ///< s of the run between states of a recording
constexpr size_t kMostStateBytes = size_t{16} << 30;  ///< 800 for each particle that a scene may have

void restoreFrom(const std::string& path, Engine& engine) {
  const std::string bytes = readFile(path, kMostStateBytes);
  try {
    const StateReader reader(std::as_bytes(std::span(bytes)));
    requireOfProject(reader, engine.project());
    engine.restore(reader);
  } catch (const InputError& problem) {
    throw InputError(path + ": " + problem.what());
  }
}

void saveResults(const Arguments& arguments, Project project, const Engine& engine) {
  if (!arguments.has("--save-state") && !arguments.has("--save-project")) return;
  StateBuffer buffer;
  saveTo(buffer, engine);
  const std::span<const std::byte> bytes = buffer.bytes();
  if (arguments.has("--save-state"))
    writeFileAtomically(arguments.text("--save-state"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  if (!arguments.has("--save-project")) return;
  project.state = projectState(bytes, project.bodies);
  saveProject(project, arguments.text("--save-project"));
}

void writeReport(const Arguments& arguments, nlohmann::json content, const Project& project, const FrameStats& begin) {
  content["program"] = "phasesketch " PS_VERSION;
  content["project"] = {{"file", arguments.positional()[0]},
                        {"title", project.title},
                        {"begun", {{"frame", begin.frame}, {"time_s", begin.time}}}};
  writeFileAtomically(arguments.text("--report"), writeJson(content));
}

std::vector<std::string> recordedFields(const Arguments& arguments, const Engine& engine) {
  const std::vector<std::string> all = engine.fields().names();
  if (!arguments.has("--fields")) return all;
  if (!arguments.has("--record")) throw InputError("--fields says what --record keeps, which is not there");
  std::vector<std::string> names = fieldNames(arguments);
  for (const std::string& name : names) {
    if (std::find(all.begin(), all.end(), name) == all.end()) throw InputError("--fields " + mustBeOneOf(name, all));
  }
  return names;
}

/// Every frame, and a state now and then and at both ends.
class FramesAndStates {
 public:
  FramesAndStates(const std::string& path, const Project& project, Engine& engine)
      : m_engine(engine), m_writer(path, project) {}
  void begin() {
    addState();
    m_writer.add(*m_engine.snapshot());
  }
  void add(const FrameStats& stats) {
    if (stats.time >= m_due) addState();
    m_writer.add(*m_engine.snapshot());
  }
  void finish() {
    if (m_engine.solver().frame() > m_last) addState();
    m_writer.finish();
  }
  std::string keepPart() { return m_writer.keepPart(); }

 private:
  void addState() {
    m_writer.add(m_engine);
    m_due = m_engine.stats().time + kStateInterval;
    m_last = m_engine.solver().frame();
  }
  Engine& m_engine;
  RecordingWriter m_writer;
  double m_due = 0;     ///< s, of the next state
  uint64_t m_last = 0;  ///< the frame of the last one
};

/// Does the run. Where it fails, what was written until then stays, and the message says where: hours may lie in it.
template <class Run>
void keepingParts(std::optional<ProbeTable>& probes, std::optional<FramesAndStates>& recording, const Run& run) {
  try {
    run();
  } catch (const std::exception& problem) {
    const std::string rows = probes ? probes->keepPart() : "", frames = recording ? recording->keepPart() : "";
    throw Error(problem.what() + (rows.empty() ? "" : "; the rows until now are in " + rows) +
                (frames.empty() ? "" : "; the frames until now are in " + frames));
  }
}

void requireNoFlags(const std::string& path, const RunReport& report) {
  if (!report.flags()) return;
  std::string names;
  for (const std::string& name : flagNames(report.flags())) names += (names.empty() ? "" : ", ") + name;
  throw Error(path + ": the run set flags: " + names + (report.message().empty() ? "" : ": " + report.message()));
}

void summarise(const RunReport& report, const FrameStats& begin, Engine& engine, double wall) {
  const FrameStats stats = engine.stats();
  if (begin.frame > 0) {
    std::printf("begun at %.6g s, from the state of frame %llu\n", begin.time,
                static_cast<unsigned long long>(begin.frame));
  }
  const double simulated = stats.time - begin.time, factor = wall > 0 ? simulated / wall : 0;
  std::printf("%zu frames, %.6g s simulated in %.3g s (%.3g times real time), %.3g ms per frame\n", report.frames(),
              simulated, wall, factor, report.total().median);
  std::printf("%s, state hash %s\n", counted(engine.particles().size(), "particle").c_str(),
              hashText(engine.stateHash()).c_str());
  for (const auto& [words, flow] :
       {std::pair{"poured by emitters", stats.flow.poured}, std::pair{"drained by sinks", stats.flow.drained}}) {
    if (flow.count > 0) std::printf("%s: %.6g kg, %s\n", words, flow.mass, counted(flow.count, "particle").c_str());
  }
}

}  // namespace

std::string simulateHelp() {
  return "phasesketch-cli simulate PROJECT [options]\n\nRuns a project without a window, from the state that it holds, "
         "else from its start.\n\n" +
         optionHelp(kOptions) +
         "\nThe report is in SI units but for milliseconds, where a key says ms. Thermal energy counts from the solid "
         "at its\nmelting point, so that matter colder than that has less than none; what a run means is the "
         "difference.\nenergy.mechanical is kinetic energy and that of weight (-m g x) of what moves; `given` names "
         "who "
         "gave or took it,\nstructure with what it stores, and adds up to end less start. momentum.angular is about "
         "the "
         "origin.\n";
}

int simulateCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "project");
  const bool quiet = arguments.has("--quiet");
  applyMachineOptions(arguments);
  PluginRegistry plugins;
  std::vector<std::string> warnings;
  Project project = loadFor(arguments, path, plugins, &warnings);
  if (arguments.has(kAtStart.name)) project.state = nullptr;
  std::vector<std::string> inputs{path};
  if (arguments.has("--from")) inputs.push_back(arguments.text("--from"));
  requireOutputs(arguments, inputs, {"--report", "--probes", "--record", "--save-state", "--save-project"});
  Engine engine = makeEngine(arguments, project, plugins);
  tellRemarks(arguments, path, engine, &warnings);
  if (arguments.has("--from")) restoreFrom(arguments.text("--from"), engine);
  const FrameStats begin = engine.stats();
  const long frames = frameCount(arguments, project, begin.time);
  interrupted();  // from here on a signal leaves whole files
  engine.show(recordedFields(arguments, engine));
  std::optional<ProbeTable> probes;
  std::optional<FramesAndStates> recording;
  if (arguments.has("--probes")) probes.emplace(arguments.text("--probes"), engine);
  if (arguments.has("--record")) recording.emplace(arguments.text("--record"), project, engine);
  RunReport report(begin);
  engine.measureBalance(arguments.has("--report"));
  SettlingMeasure settling(frames);
  const double start = now();
  double wall = 0;
  bool whole = false;
  keepingParts(probes, recording, [&] {
    if (recording) recording->begin();
    {
      Progress progress(frames, quiet);
      whole = runFrames(engine, frames, [&](const StepReport& step, const FrameStats& stats) {
        report.add(step, stats);
        settling.add(engine, stats);
        if (probes) probes->add(engine, stats);
        if (recording) recording->add(stats);
        progress.show(static_cast<long>(report.frames()), stats);
      });
    }
    report.add(engine.lateFaults());
    wall = now() - start;
    if (probes) probes->finish();
    if (recording) recording->finish();
  });
  saveResults(arguments, project, engine);
  if (arguments.has("--report")) {
    nlohmann::json content = report.json(engine, wall);
    content["rest"] = settling.json(engine);
    content["warnings"] = warnings;
    writeReport(arguments, std::move(content), project, begin);
  }
  if (!quiet) summarise(report, begin, engine, wall);
  requireNoFlags(path, report);
  if (!whole)
    throw Error("stopped after " + std::to_string(report.frames()) + " of " + std::to_string(frames) + " frames");
  return kFine;
}

}  // namespace ps::cli
