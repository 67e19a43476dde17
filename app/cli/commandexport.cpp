// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/export/exportformat.h"
#include "core/export/recordedframes.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/particlefield.h"
#include "ui/film/projectlook.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--format", "NAME", "what to write; below"},
    {"--out", "FOLDER", "where the files go, one for each frame; made where there is none"},
    {"--seconds", "S",
     "mechanical time to export; without it what is left of the project's duration, or all of the recording"},
    {"--frames", "N", "frames of the run, instead of --seconds"},
    {"--every", "N", "exports every Nth frame; without it 1 for recordings, 6 for a project"},
    {"--fields", "NAMES", "of particles, with commas between; without it all that a frame has"},
    kAtStart,
    kThreads,
    kIsa,
    kPatience,
    kSet,
    kQuiet,
};

/// Writes frames of one run, and says at the end how many.
class Export {
 public:
  Export(const Arguments& arguments, const Project& project, const PluginRegistry& plugins)
      : m_format(exportFormat(arguments.text("--format"))), m_out(arguments.text("--out")) {
    m_choices = {m_out, fieldNames(arguments), temperatureColours(lookOf(project, plugins, "temperature"))};
  }
  const std::vector<std::string>& fields() const { return m_choices.fields; }
  /// `like`: has the fields that all frames have.
  void begin(const Snapshot& like) {
    try {
      requireFields(fields(), like);
    } catch (const InputError& problem) {
      throw InputError("--fields: " + std::string(problem.what()));
    }
    m_exporter = makeExporter(m_format, std::move(m_choices));
  }
  void add(const Snapshot& snapshot) {
    m_exporter->add(snapshot);
    ++m_files;
  }
  /// What was written until a run or a file failed is a series too.
  ~Export() {
    try {
      if (m_exporter) m_exporter->finish();
    } catch (const std::exception&) {
      // What stopped it is being said.
    }
  }
  Export(const Export&) = delete;
  Export& operator=(const Export&) = delete;
  void finish(bool quiet) {
    const auto exporter = std::move(m_exporter);
    exporter->finish();
    if (!quiet)
      std::printf("%s in %s\n", counted(m_files, std::string(m_format.ending) + " file").c_str(), m_out.c_str());
  }

 private:
  const ExportFormat& m_format;
  std::string m_out;
  ExportChoices m_choices;
  std::unique_ptr<FrameExporter> m_exporter;
  size_t m_files = 0;
};

int exportProject(const Arguments& arguments, const std::string& path) {
  constexpr long kUsualEvery = 6;  // ten frames a second
  PluginRegistry plugins;
  Project project = loadFor(arguments, path, plugins);
  if (arguments.has(kAtStart.name)) project.state = nullptr;
  const long every = arguments.integer("--every", 1, 1'000'000).value_or(kUsualEvery);
  Export out(arguments, project, plugins);
  Engine engine = makeEngine(arguments, project, plugins);
  tellRemarks(arguments, path, engine);
  engine.show(engine.fields().names());
  const long frames = frameCount(arguments, project, engine.stats().time);
  out.begin(*engine.snapshot());
  out.add(*engine.snapshot());
  StepReport failed;
  {
    Progress progress(frames, arguments.has("--quiet"));
    for (long frame = 1; frame <= frames && !interrupted(); ++frame) {
      StepReport step = engine.step();
      const bool stands = step.flags & kTakenBack;  // nothing moves any more
      if (step.flags && !failed.flags) failed = std::move(step);
      if (stands) break;
      if (frame % every == 0) out.add(*engine.snapshot());
      progress.show(frame, engine.stats());
    }
  }
  out.finish(arguments.has("--quiet"));
  if (!failed.flags) return interrupted() ? kFailed : kFine;
  throw Error(path + ": the run set flags: " + flagNames(failed.flags).front() +
              (failed.message.empty() ? "" : ": " + failed.message));
}

int exportRecording(const Arguments& arguments, const std::string& path) {
  PluginRegistry plugins;
  const RecordingReader recording(path, plugins);
  if (recording.frameCount() == 0)
    throw InputError(recording.damage().empty() ? path + ": holds no frames" : recording.damage());
  Project project = parseFor(arguments, recording.projectText(), path, plugins);
  Export out(arguments, project, plugins);
  const KeptRun& run = recording.content().present;
  FrameRange range{run.frames.begin()->first, run.frames.rbegin()->first,
                   static_cast<uint64_t>(arguments.integer("--every", 1, 1'000'000).value_or(1))};
  project.duration = static_cast<double>(range.last - range.first + 1) * frameLength(project);
  range.last = std::min(range.last, range.first + static_cast<uint64_t>(frameCount(arguments, project)));
  out.begin(*recording.frame(0));
  const FrameUnpacker unpacker;
  for (const uint64_t number : keptIn(run, range)) {
    if (interrupted()) break;
    out.add(*unpacker.snapshot(*run.frames.at(number), 1));
  }
  out.finish(arguments.has("--quiet"));
  if (!recording.damage().empty()) throw Error(recording.damage() + "; the frames before it were exported");
  return interrupted() ? kFailed : kFine;
}

}  // namespace

std::string exportHelp() {
  std::string formats;
  for (const ExportFormat& format : exportFormats()) {
    std::string key = std::string("  ") + format.key;
    key.resize(16, ' ');
    formats += key + format.label + ": " + format.help + '\n';
  }
  return "phasesketch-cli export PROJECT|RECORDING --format NAME --out FOLDER [options]\n\nWrites frames as files that "
         "other programs read: m, y up, SI and kelvin; a project's run from the\nstate that it holds, else from its "
         "start.\n\n" +
         optionHelp(kOptions) + "\nFormats:\n" + formats;
}

int exportCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "project or recording");
  try {
    exportFormat(arguments.text("--format"));
  } catch (const InputError& problem) {
    throw InputError("--format " + std::string(problem.what()));
  }
  if (arguments.text("--out").empty()) throw InputError("--out is missing: a folder for the files");
  applyMachineOptions(arguments);
  return isRecording(path) ? exportRecording(arguments, path) : exportProject(arguments, path);
}

}  // namespace ps::cli
