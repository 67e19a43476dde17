// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/nearest.h"
#include "core/export/recordedframes.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/packedframe.h"
#include "ui/film/filmpainter.h"
#include "ui/film/projectlook.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--out", "FOLDER|FILE.mp4|FILE.png|FILE.jpg",
     "where the pictures go: PNG files in a folder, a film (needs ffmpeg), or one file for the end"},
    {"--size", "WxH", "in pixels; without it 1280x720"},
    {"--seconds", "S",
     "mechanical time to draw; without it what is left of the project's duration, or all of the recording"},
    {"--frames", "N", "frames to simulate, instead of --seconds"},
    {"--every", "N", "draws every Nth frame; without it 1 for films and recordings, 60 for pictures of a project"},
    {"--colour", "NAME",
     "material, or a field of particles, as 'plugins --fields' lists them; without it as the project says"},
    {"--section", "[-]AXIS=M|none",
     "cuts the scene open: x=0.1 leaves out what lies beyond 0.1 m along x, -x=0.1 what lies before it; without it as "
     "the project says"},
    kAtStart,
    kThreads,
    kIsa,
    kPatience,
    kSet,
    kQuiet,
};

PictureSize sizeOf(const Arguments& arguments) {
  PictureSize size;
  size.still = !isFilm(arguments.text("--out"));
  const std::string text = arguments.text("--size", "1280x720");
  char trailing = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &trailing) != 2 || size.width < 16 ||
      size.height < 16 || size.width > 16384 || size.height > 16384) {
    throw InputError("--size must be WIDTHxHEIGHT, 16 to 16384 each, not '" + text + "'");
  }
  return size;
}

/// A field of ours, of an installed plugin, or one that the last frame of a recording brings along.
std::string colourOf(const Project& project, const ParticleFields& fields, const Snapshot* last,
                     const Arguments& arguments) {
  const std::string colour = arguments.text("--colour", project.view.colour);
  const std::vector<std::string> names = colourNames(fields);
  const bool known = std::find(names.begin(), names.end(), colour) != names.end();
  if (!arguments.has("--colour") || (last && ShownField(*last, colour))) return colour;
  if (!known) throw InputError("--colour " + mustBeOneOf(colour, names));
  if (last && colour != kMatterColour)
    throw InputError("--colour " + colour + ": the recording has no such field; record it with --fields " + colour);
  return colour;
}

std::optional<ViewSection> sectionOf(const Arguments& arguments, const Project& project) {
  if (!arguments.has("--section")) return project.view.section;
  const std::string asked = arguments.text("--section");
  if (asked == "none") return std::nullopt;
  const bool flipped = asked.starts_with('-');
  const std::string text = asked.substr(flipped ? 1 : 0), axes = "xyz";
  const size_t axis = text.size() > 2 && text[1] == '=' ? axes.find(text[0]) : std::string::npos;
  double place = NAN;
  if (axis != std::string::npos) {
    const char* const end = text.data() + text.size();
    if (std::from_chars(text.data() + 2, end, place).ptr != end) place = NAN;
  }
  if (!(std::abs(place) <= 1e4))
    throw InputError("--section must be none, or an axis and where it is cut in m, as x=0.1 or -y=0.02, not '" + asked +
                     "'");
  return ViewSection{text.substr(0, 1), place * Vector3::Unit(static_cast<Eigen::Index>(axis)), flipped};
}

FilmChoices choicesOf(const Arguments& arguments, const Project& project, const PluginRegistry& plugins,
                      const std::string& colour, long every) {
  return {.out = arguments.text("--out"),
          .framesPerSecond = 1 / (frameLength(project) * static_cast<double>(every)),
          .size = sizeOf(arguments),
          .look = lookOf(project, plugins, colour),
          .camera = {},
          .section = sectionOf(arguments, project)};
}

/// Of one picture, the last, all before it are left out.
long everyFor(const Arguments& arguments, long usual, long frames) {
  if (isPicture(arguments.text("--out"))) return std::max(1L, frames);
  return arguments.integer("--every", 1, 1'000'000).value_or(usual);
}

int renderProject(const Arguments& arguments, const std::string& path) {
  PluginRegistry plugins;
  Project project = loadFor(arguments, path, plugins);
  if (arguments.has(kAtStart.name)) project.state = nullptr;
  Engine engine = makeEngine(arguments, project, plugins);
  tellRemarks(arguments, path, engine);
  const std::string colour = colourOf(project, engine.fields(), nullptr, arguments);
  engine.show({colour});
  const SnapshotPtr begin = engine.snapshot();
  const long frames = frameCount(arguments, project, begin->stats.time), first = static_cast<long>(begin->stats.frame);
  const long every = everyFor(arguments, isFilm(arguments.text("--out")) ? 1 : 60, frames);
  FilmPainter painter(project, plugins, choicesOf(arguments, project, plugins, colour, every));
  painter.draw(begin, first);
  StepFlags flags = 0;
  std::string message;
  {
    Progress progress(frames, arguments.has("--quiet"));
    for (long frame = 1; frame <= frames && !interrupted(); ++frame) {
      const StepReport step = engine.step();
      if (step.flags && !flags) message = step.message;
      flags |= step.flags;
      if (step.flags & kTakenBack) break;  // nothing moves any more
      if (frame % every == 0) painter.draw(engine.snapshot(), first + frame);
      progress.show(frame, engine.stats());
    }
  }
  const size_t pictures = painter.finish();
  if (!arguments.has("--quiet"))
    std::printf("%s in %s\n", counted(pictures, "picture").c_str(), arguments.text("--out").c_str());
  if (!flags) return interrupted() ? kFailed : kFine;
  throw Error(path + ": the run set flags: " + flagNames(flags).front() + (message.empty() ? "" : ": " + message));
}

int renderRecording(const Arguments& arguments, const std::string& path) {
  PluginRegistry plugins;
  const RecordingReader recording(path, plugins);
  if (recording.frameCount() == 0)
    throw InputError(recording.damage().empty() ? path + ": holds no frames" : recording.damage());
  Project project = parseFor(arguments, recording.projectText(), path, plugins);
  const KeptRun::Frames& kept = recording.content().present.frames;
  const auto length = static_cast<long>(kept.rbegin()->first - kept.begin()->first);
  project.duration = static_cast<double>(length + 1) * frameLength(project);
  const long frames = std::min(frameCount(arguments, project), length), every = everyFor(arguments, 1, frames);
  const std::string colour =
      colourOf(project, ParticleFields(plugins), recording.frame(recording.frameCount() - 1).get(), arguments);
  FilmPainter painter(project, plugins, choicesOf(arguments, project, plugins, colour, every));
  const uint64_t first = kept.begin()->first;
  const FrameUnpacker unpacker;
  for (const RangeFrame& frame : framesIn(
           recording.content().present, {first, first + static_cast<uint64_t>(frames), static_cast<uint64_t>(every)})) {
    if (interrupted()) break;
    painter.draw(unpacker.snapshot(*kept.at(frame.kept), 1), static_cast<long>(frame.wanted - first));
  }
  const size_t pictures = painter.finish();
  if (!arguments.has("--quiet"))
    std::printf("%s in %s\n", counted(pictures, "picture").c_str(), arguments.text("--out").c_str());
  if (!recording.damage().empty()) throw Error(recording.damage() + "; the frames before it were drawn");
  return kFine;
}

}  // namespace

std::string renderHelp() {
  return "phasesketch-cli render PROJECT|RECORDING --out FOLDER|FILE.mp4 [options]\n\nDraws without a display; a "
         "project from the state that it holds, else from its start.\n\n" +
         optionHelp(kOptions);
}

int renderCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const std::string path = onlyFile(arguments, "project or recording");
  if (arguments.text("--out").empty())
    throw InputError("--out is missing: a folder for PNG files, a FILE.mp4, or a FILE.png or .jpg");
  if (isFilm(arguments.text("--out")) || isPicture(arguments.text("--out")))
    requireOutputs(arguments, {path}, {"--out"});
  sizeOf(arguments);
  sectionOf(arguments, {});
  applyMachineOptions(arguments);
  return isRecording(path) ? renderRecording(arguments, path) : renderProject(arguments, path);
}

}  // namespace ps::cli
