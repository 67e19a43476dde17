// SPDX-License-Identifier: Apache-2.0
#include "app/cli/run.h"

#include "app/cli/commands.h"
#include "core/base/callwatch.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "core/io/outputfile.h"
#include "core/plugin_host/crashwatch.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>
#include <thread>
#include <unistd.h>

namespace ps::cli {
namespace {

constexpr long kMostFrames = 100'000'000;
volatile std::sig_atomic_t g_interrupted = 0;

void warn(const Arguments& arguments, const std::string& text, std::vector<std::string>* warnings) {
  if (!arguments.has("--quiet")) std::fprintf(stderr, "warning: %s\n", text.c_str());
  if (warnings) warnings->push_back(text);
}

Project warned(const Arguments& arguments, LoadedProject&& loaded, std::vector<std::string>* warnings = nullptr) {
  for (const ProjectMessage& warning : loaded.warnings) warn(arguments, warning.text, warnings);
  return std::move(loaded.project);
}

}  // namespace

void applyMachineOptions(const Arguments& arguments) {
  if (const auto threads = arguments.integer("--threads", 1, 1024)) setThreadCount(static_cast<int>(*threads));
  if (arguments.has("--isa")) setInstructionSet(arguments.text("--isa"));
  watchPlugins(arguments);
}

double patienceOf(const Arguments& arguments) {
  constexpr double kUsual = 60, kLeast = 0.1, kMost = 1e6;
  return arguments.number(kPatience.name, kLeast, kMost).value_or(kUsual);
}

void watchPlugins(const Arguments& arguments) {
  const double patience = patienceOf(arguments);
  static const CallWatch watch(patience, [patience](const std::string& id) {
    const std::string follows = putInQuarantine(id)
                                    ? "; it is in quarantine from now on. To allow it again: phasesketch-cli plugins "
                                      "--allow " +
                                          id
                                    : "; --patience lets it take longer";
    std::fprintf(stderr, "phasesketch-cli: the plugin '%s' did not come back within %s s%s\n", id.c_str(),
                 numberText(patience).c_str(), follows.c_str());
    std::_Exit(kNoReturn);
  });
}

std::string onlyFile(const Arguments& arguments, const char* what) {
  if (arguments.positional().empty()) throw InputError(std::string("which ") + what + "? --help says more");
  if (arguments.positional().size() > 1) {
    throw InputError("one " + std::string(what) + " at a time; '" + arguments.positional()[1] + "' is one too many");
  }
  return arguments.positional()[0];
}

Project loadFor(const Arguments& arguments, const std::string& path, const PluginRegistry& plugins,
                std::vector<std::string>* warnings) {
  return warned(arguments, loadProject(path, plugins, arguments.all("--set")), warnings);
}

Project parseFor(const Arguments& arguments, const std::string& text, const std::string& name,
                 const PluginRegistry& plugins) {
  return warned(arguments, parseProject(text, name, plugins, arguments.all("--set")));
}

std::vector<std::string> fieldNames(const Arguments& arguments) {
  std::vector<std::string> names;
  if (arguments.text("--fields") == "none") return names;
  std::istringstream words(arguments.text("--fields"));
  for (std::string name; std::getline(words, name, ',');) names.push_back(std::move(name));
  return names;
}

std::string counted(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void tellRemarks(const Arguments& arguments, const std::string& path, const Engine& engine,
                 std::vector<std::string>* warnings) {
  for (const std::string& remark : engine.remarks()) warn(arguments, path + ":" + remark, warnings);
}

long frameCount(const Arguments& arguments, const Project& project, double begun) {
  if (arguments.has("--frames") && arguments.has("--seconds")) throw InputError("give --frames or --seconds, not both");
  if (const auto frames = arguments.integer("--frames", 0, kMostFrames)) return *frames;
  const double seconds = arguments.number("--seconds", 0, 1e12).value_or(std::max(0.0, project.duration - begun));
  const double frames = std::round(seconds / frameLength(project));
  if (frames > kMostFrames) throw InputError("--seconds: more than " + std::to_string(kMostFrames) + " frames");
  return static_cast<long>(frames);
}

Engine makeEngine(const Arguments& arguments, const Project& project, PluginRegistry& plugins) {
  static constexpr auto kPatient = std::chrono::milliseconds(500), kPause = std::chrono::milliseconds(100);
  if (arguments.has("--quiet") || ::isatty(STDERR_FILENO) != 1) return Engine(project, plugins);
  ps::Progress progress;
  const ProgressScope scope(&progress);
  const std::jthread teller([&progress](const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any ended;
    std::unique_lock lock(mutex);
    bool shown = false;
    ended.wait_for(lock, stop, kPatient, [] { return false; });
    for (; !stop.stop_requested(); ended.wait_for(lock, stop, kPause, [] { return false; })) {
      const ps::Progress::State state = progress.state();
      if (!state.stage) continue;
      std::fprintf(stderr, "\r\033[K%s, %.0f %%", state.stage, 100 * state.done);
      std::fflush(stderr);
      shown = true;
    }
    if (shown) std::fputs("\r\033[K", stderr);
  });
  return Engine(project, plugins);
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool interrupted() {
  static const bool listening = [] {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
      const auto before = std::signal(number, [](int which) {
        g_interrupted = 1;
        std::signal(which, SIG_DFL);  // a second Ctrl+C ends at once
      });
      if (before == SIG_IGN) std::signal(number, SIG_IGN);  // nohup
    }
    return true;
  }();
  return listening && g_interrupted != 0;
}

void requireOutputs(const Arguments& arguments, const std::vector<std::string>& inputs,
                    std::initializer_list<const char*> options) {
  std::map<std::string, std::string> names;  // by identity
  for (const std::string& input : inputs) names.emplace(fileIdentity(input), "the file that is read");
  names.erase("");
  for (const char* option : options) {
    if (!arguments.has(option)) continue;
    const std::string path = arguments.text(option), identity = fileIdentity(path);
    const auto [known, fresh] = names.emplace(identity, std::string("that of ") + option);
    if (!fresh && !identity.empty())
      throw InputError(std::string(option) + " " + path + ": is " + known->second + " as well; choose another name");
    requireWritable(path);
  }
}

Progress::Progress(long frames, bool quiet)
    : m_frames(frames), m_on(!quiet && ::isatty(STDERR_FILENO) == 1), m_start(now()), m_last(m_start) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (m_shown) std::fputs("\r\033[K", stderr);
  m_shown = false;
}

void Progress::show(long frame, const FrameStats& stats) {
  constexpr double kPause = 0.2;  // s between two lines
  const double time = now();
  if (!m_on || frame == 0 || time - m_last < kPause) return;
  m_last = time;
  m_shown = true;
  const double left = (time - m_start) / static_cast<double>(frame) * static_cast<double>(m_frames - frame);
  std::fprintf(stderr, "\r\033[Kframe %ld of %ld, %.1f s simulated, %.1f ms per frame, %.0f s left", frame, m_frames,
               stats.time, stats.totalMilliseconds, left);
  std::fflush(stderr);
}

}  // namespace ps::cli
