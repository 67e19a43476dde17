// SPDX-License-Identifier: Apache-2.0
#include "app/cli/plugintrial.h"

#include "app/cli/commands.h"
#include "core/base/error.h"
#include "core/experiments/plugincheck.h"
#include "core/parameters/parameterset.h"

#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>

// A plugin that is tried may abort, or never come back: so a child process does it, and says through a pipe what it is
// about to do. The parent reads until the pipe ends or time is up.
namespace ps::cli {
namespace {

constexpr int kWrongInput = 7;

/// A folder of its own, gone afterwards.
class Scratch {
 public:
  Scratch() : m_path((std::filesystem::temp_directory_path() / "phasesketch-check-XXXXXX").string()) {
    if (!::mkdtemp(m_path.data())) throw Error("no folder " + m_path + " can be made; is the disk full?");
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::string& path() const { return m_path; }

 private:
  std::string m_path;
};

/// In the child: every line through the pipe is what comes next, the last one what came out.
int childOf(const std::string& path, const std::string& scratch, int pipe) {
  const auto send = [pipe](std::string line) {
    std::replace(line.begin(), line.end(), '\n', ' ');  // in what the plugin said
    line += '\n';
    return ::write(pipe, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  };
  try {
    const PluginCheck check = checkPlugin(path, scratch, [&](const std::string& stage) { send(stage); });
    if (!check.problem.empty()) return send(check.problem) ? kFailed : kWrongInput;
    const PluginInfo& info = check.info;
    return send(path + ": fine: " + pluginKindName(info.kind) + " '" + info.id + "' " + info.version + ", " +
                info.label)
               ? kFine
               : kWrongInput;
  } catch (const InputError& error) {
    send(error.what());
    return kWrongInput;
  } catch (const std::exception& error) {
    send(path + ": " + error.what());
    return kFailed;
  }
}

/// All that the child tells; false when it has not ended in time.
bool readAll(int pipe, std::string& text, double patience) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long>(1000 * patience));
  char bytes[4096];
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()).count();
    pollfd waited{pipe, POLLIN, 0};
    if (left <= 0 || ::poll(&waited, 1, static_cast<int>(left)) == 0) return false;
    const ssize_t count = ::read(pipe, bytes, sizeof bytes);
    if (count <= 0) return true;
    text.append(bytes, static_cast<size_t>(count));
  }
}

}  // namespace

int tryPlugin(const std::string& path, double patience) {
  const Scratch scratch;
  int ends[2];
  if (::pipe(ends) != 0) throw Error(std::string("no pipe can be made: ") + std::strerror(errno));
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child < 0) throw Error(std::string("no process can be started: ") + std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    ::_exit(childOf(path, scratch.path(), ends[1]));
  }
  ::close(ends[1]);
  std::string output;
  const bool ended = readAll(ends[0], output, patience);
  ::close(ends[0]);
  if (!ended) ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  while (output.ends_with('\n')) output.pop_back();
  const std::string last = output.substr(output.rfind('\n') + 1);
  if (!ended) {
    std::fprintf(stderr, "phasesketch-cli: %s: it did not come back within %s s when it %s\n", path.c_str(),
                 numberText(patience).c_str(), last.c_str());
    return kNoReturn;
  }
  if (WIFSIGNALED(status)) throw Error(path + ": it crashed (" + strsignal(WTERMSIG(status)) + ") when it " + last);
  if (WEXITSTATUS(status) == kWrongInput) throw InputError(last);
  if (WEXITSTATUS(status) != kFine) throw Error(last);
  std::printf("%s\n", last.c_str());
  return kFine;
}

}  // namespace ps::cli
