// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/pluginscan.h"

#include "core/plugin_host/hostservices.h"
#include "core/plugin_host/pluginloader.h"
#include "core/plugin_host/pluginmetadata.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace ps {
namespace {

constexpr const char* kProgram = "/proc/self/exe";
constexpr const char* kArgument = "--scan-plugins";  // then the number of the pipe, and files
constexpr char kBegins = 'b', kBack = 'e';           // what the child says of each
constexpr int kLook = 100;                           // ms

bool g_served = false;

void tell(int pipe, char what) {
  if (::write(pipe, &what, 1) != 1) ::_exit(1);  // nobody listens
}

[[noreturn]] void loadAll(int pipe, char** first, char** last) {
  const auto materials = std::make_shared<InstalledMaterials>();
  for (char** path = first; path != last; ++path) {
    tell(pipe, kBegins);
    PluginInfo info = readLibraryMetadata(*path);
    if (info.problem.empty()) loadLibrary(info, materials);
    tell(pipe, kBack);
  }
  ::_exit(0);  // what plugins do at a program's end is not asked
}

/// Between fork and exec: nothing but what may be called in a signal handler.
[[noreturn]] void becomeChild(char** arguments, int pipe, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit noDump{0, 0};
  ::setrlimit(RLIMIT_CORE, &noDump);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);  // a plugin's words must not stand among the program's
  ::fcntl(pipe, F_SETFD, 0);
  ::execv(kProgram, arguments);
  ::_exit(1);
}

/// How one child ended.
struct Ending {
  size_t begun = 0, back = 0;  ///< plugins
  bool late = false;
  int status = -1;  ///< as of waitpid(); -1: unknown
};

/// All that waits in the pipe; true when there was something.
bool readOn(int pipe, Ending& ending) {
  std::array<char, 256> bytes;
  bool any = false;
  for (ssize_t count; (count = ::read(pipe, bytes.data(), bytes.size())) > 0; any = true) {
    for (const char what : std::string_view(bytes.data(), static_cast<size_t>(count)))
      ++(what == kBegins ? ending.begun : ending.back);
  }
  return any;
}

/// Time is counted in looks, so that a program that was stopped accuses nobody.
Ending watchChild(pid_t child, int pipe, double patience) {
  Ending ending;
  const int most = static_cast<int>(1000 * patience / kLook) + 1;
  for (int looks = 0;;) {
    pollfd waited{pipe, POLLIN, 0};
    const bool quiet = ::poll(&waited, 1, kLook) == 0;
    if (readOn(pipe, ending)) looks = 0;
    looks += quiet;
    ending.late = looks >= most;
    if (ending.late) ::kill(child, SIGKILL);
    // A pipe that has ended may still have a child that is about to.
    const bool over = ending.late || (waited.revents & POLLHUP) != 0;
    const pid_t ended = ::waitpid(child, &ending.status, over ? 0 : WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR)) continue;
    if (ended < 0) ending.status = -1;
    readOn(pipe, ending);
    return ending;
  }
}

Ending runChild(const std::vector<std::string>& paths, double patience) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return {};
  std::string number = std::to_string(ends[1]);
  std::vector<std::string> texts{kProgram, kArgument, number};
  texts.insert(texts.end(), paths.begin(), paths.end());
  std::vector<char*> arguments;
  arguments.reserve(texts.size() + 1);
  for (std::string& text : texts) arguments.push_back(text.data());
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) becomeChild(arguments.data(), ends[1], parent);
  ::close(ends[1]);
  const Ending ending = child < 0 ? Ending() : watchChild(child, ends[0], patience);
  ::close(ends[0]);
  return ending;
}

/// Of the plugin at which a child stopped.
ScanVerdict verdictOf(const Ending& ending, double patience) {
  using Kind = ScanVerdict::Kind;
  if (ending.begun == ending.back || ending.status == -1) return {};
  if (ending.late) {
    const std::string seconds = std::to_string(static_cast<int>(patience));
    return {Kind::Failed, "it did not come back within " + seconds + " s when it was loaded"};
  }
  if (!WIFSIGNALED(ending.status)) return {Kind::Failed, "it ended the program while it was loaded"};
  const int signal = WTERMSIG(ending.status);
  for (const int other : {SIGKILL, SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    if (signal == other) return {};
  return {Kind::Failed, std::string("it crashed (") + ::strsignal(signal) + ") while it was loaded"};
}

}  // namespace

void servePluginScans(int argc, char** argv) {
  g_served = true;
  if (argc < 3 || std::strcmp(argv[1], kArgument) != 0) return;
  loadAll(std::atoi(argv[2]), argv + 3, argv + argc);
}

std::vector<ScanVerdict> scanPlugins(const std::vector<std::string>& paths, double patience) {
  std::vector<ScanVerdict> verdicts(paths.size());
  size_t done = 0;
  bool again = false;
  while (g_served && done < paths.size()) {
    const auto rest = paths.begin() + static_cast<ptrdiff_t>(done);
    const Ending ending = runChild({rest, paths.end()}, patience);
    for (size_t k = 0; k < ending.back; ++k) verdicts[done++] = {ScanVerdict::Kind::CameBack, {}};
    if (done == paths.size()) break;
    const ScanVerdict verdict = verdictOf(ending, patience);
    if (verdict.kind == ScanVerdict::Kind::Inconclusive) break;
    again = !ending.late && (ending.back > 0 || !again);
    if (!again) verdicts[done++] = verdict;
  }
  return verdicts;
}

}  // namespace ps
