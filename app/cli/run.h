// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "app/cli/arguments.h"
#include "core/experiments/run.h"
#include "core/io/projectio.h"
#include "core/simulation/engine.h"

#include <chrono>
#include <initializer_list>
#include <string>
#include <vector>

namespace ps::cli {

/// Options of every command that runs the solver.
inline constexpr OptionSpec kThreads{"--threads", "N", "number of threads; without it one per core"};
inline constexpr OptionSpec kIsa{"--isa", "NAME", "pins an instruction set: AVX3, AVX2, SSE4, SSSE3, NEON"};
inline constexpr OptionSpec kPatience{"--patience", "S",
                                      "ends the program when a plugin takes longer for one call; 60"};
inline constexpr OptionSpec kSet{"--set", "JSON/POINTER=VALUE", "changes the project before it is checked; may repeat"};
/// Of commands that run a project from the state that it holds.
inline constexpr OptionSpec kAtStart{"--at-start", "", "begins at the project's start, whatever state it holds"};
inline constexpr OptionSpec kQuiet{"--quiet", "", "says nothing but errors"};

/// Applies --threads and --isa, throws InputError for what this machine does not have; and watchPlugins().
void applyMachineOptions(const Arguments& arguments);
/// --patience, s.
double patienceOf(const Arguments& arguments);
/// From now on the program ends, with kNoReturn and the plugin's name, when one does not come back within --patience.
/// It is then in quarantine.
void watchPlugins(const Arguments& arguments);
/// The one positional argument; throws InputError when there is none or more.
std::string onlyFile(const Arguments& arguments, const char* what);
/// Loads with --set, warnings on standard error, and in `warnings` where it is given.
Project loadFor(const Arguments& arguments, const std::string& path, const PluginRegistry& plugins,
                std::vector<std::string>* warnings = nullptr);
/// The same for text that stands for a file.
Project parseFor(const Arguments& arguments, const std::string& text, const std::string& name,
                 const PluginRegistry& plugins);
/// Tells what an engine has to say of the state that its project holds, as loadFor() tells its warnings.
void tellRemarks(const Arguments& arguments, const std::string& path, const Engine& engine,
                 std::vector<std::string>* warnings = nullptr);
/// An engine of a project. On a terminal a line says how far it is where that takes long.
Engine makeEngine(const Arguments& arguments, const Project& project, PluginRegistry& plugins);
/// Frames of a run that begins `begun` s after the start: --frames, --seconds (mechanical time), or what is left of the
/// project's duration.
long frameCount(const Arguments& arguments, const Project& project, double begun = 0);
/// What --fields names, with commas between; nothing for "none".
std::vector<std::string> fieldNames(const Arguments& arguments);
/// "1 picture", "2 pictures".
std::string counted(size_t count, const std::string& noun);
/// s since a fixed point.
double now();
/// Throws InputError where one of the files that `options` name is read as well, or named twice, and Error where one
/// cannot be written: known before long work.
void requireOutputs(const Arguments& arguments, const std::vector<std::string>& inputs,
                    std::initializer_list<const char*> options);
/// True once the user has pressed Ctrl+C, or the program was asked to end (SIGTERM, SIGHUP); the first call starts
/// listening.
bool interrupted();

/// Runs frames and hands each one over; false when a signal or a broken state ended them early.
inline bool runFrames(Engine& engine, long frames, const FrameVisitor& each) {
  return ps::runFrames(engine, frames, each, interrupted);
}

/// One line on a terminal's standard error that says how far a run is; nothing where there is no terminal.
class Progress {
 public:
  Progress(long frames, bool quiet);
  ~Progress();
  void show(long frame, const FrameStats& stats);

 private:
  void clear();
  long m_frames;
  bool m_on, m_shown = false;
  double m_start, m_last;
};

}  // namespace ps::cli
