// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

// Why another process: a plugin may crash or hang as soon as it is loaded, and a program that was merely killed at that
// moment leaves the same traces. How a child ended is known: a crash is seen by its signal, one that was killed from
// outside accuses nobody. The child is this program anew, for a fork alone would inherit the locks of threads that it
// does not have.
namespace ps {

/// First in main(): does the work of a child that scanPlugins() has started, and ends it. Programs that do not call it
/// load their plugins untried.
void servePluginScans(int argc, char** argv);

/// What came of loading one plugin in a process of its own.
struct ScanVerdict {
  enum class Kind {
    CameBack,  ///< what it says may still be refused
    Failed,
    Inconclusive  ///< no child could be started, or somebody else ended it
  };
  Kind kind = Kind::Inconclusive;
  std::string why;  ///< of Failed: "it crashed (Aborted) while it was loaded"
};

/// Loads these libraries in a child process, one after another; verdicts in their order. One that crashes is tried
/// twice. `patience`: s that each may take.
std::vector<ScanVerdict> scanPlugins(const std::vector<std::string>& paths, double patience);

}  // namespace ps
