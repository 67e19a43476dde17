// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/shorttext.h"
#include "core/experiments/caserun.h"
#include "core/plugin_host/registry.h"

#include <algorithm>
#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--only", "ID", "runs this case alone; may repeat, and the beginning of an id will do"},
    {"--list", "", "names the cases and runs none"},
    {kSet.name, kSet.value, "changes every project before it is checked; may repeat"},
    kThreads,
    kIsa,
    kPatience,
};

/// Columns as wide as people see them: a sign like ≥ has three bytes and one place.
std::string padded(const std::string& text, size_t width) {
  const auto places = static_cast<size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
  return text + std::string(places < width ? width - places : 0, ' ');
}

void printRow(const std::string& id, const std::string& what, const std::string& expected, const std::string& got,
              const std::string& tolerance, const std::string& fine) {
  std::printf("%s  %s  %s  %s  %s  %s\n", padded(id, 28).c_str(), padded(what, 44).c_str(),
              padded(expected, 11).c_str(), padded(got, 11).c_str(), padded(tolerance, 16).c_str(), fine.c_str());
  std::fflush(stdout);
}

void print(const CaseVerdict& verdict) {
  const auto cell = [](const std::optional<double>& value) { return value ? sixDigits(*value) : std::string(); };
  printRow(verdict.id, verdict.what, cell(verdict.expected), cell(verdict.measured), verdict.tolerance,
           verdict.holds          ? "yes"
           : verdict.told.empty() ? "NO"
                                  : "limit: " + verdict.told);
}

bool chosen(const Case& what, const std::vector<std::string>& only) {
  return only.empty() ||
         std::any_of(only.begin(), only.end(), [&](const std::string& id) { return what.id.starts_with(id); });
}

}  // namespace

std::string casesHelp() {
  return "phasesketch-cli cases FILE... [options]\n\nRuns the experiments of files: projects, from their start, with "
         "the numbers of each case, and what theory expects. Prints\nthe table \"case, what, expected, got, tolerance, "
         "ok\"; under ok \"yes\", \"NO\", or, where a number misses in a run whose\nsolver says that it could not "
         "deliver "
         "something, \"limit\" and what that is. Exit code 1 when a number misses its tolerance.\n\n" +
         optionHelp(kOptions);
}

int casesCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  if (arguments.positional().empty()) throw InputError("which file of cases? --help says more");
  applyMachineOptions(arguments);
  std::vector<Case> cases;
  for (const std::string& path : arguments.positional()) {
    for (Case& what : readCases(path)) cases.push_back(std::move(what));
  }
  const std::vector<std::string>& only = arguments.all("--only");
  std::erase_if(cases, [&](const Case& what) { return !chosen(what, only); });
  if (cases.empty()) throw InputError("there is no case '" + only.front() + "'; --list names them");
  if (arguments.has("--list")) {
    for (const Case& what : cases) std::puts(what.id.c_str());
    return kFine;
  }
  PluginRegistry plugins;
  int failed = 0;
  printRow("case", "what", "expected", "got", "tolerance", "ok");
  for (const Case& what : cases) {
    runCase(what, arguments.all(kSet.name), plugins, interrupted, [&](const CaseVerdict& verdict) {
      print(verdict);
      failed += verdict.holds ? 0 : 1;
    });
  }
  if (failed == 0) return kFine;
  const bool one = failed == 1;
  throw Error(std::to_string(failed) + (one ? " number misses its tolerance" : " numbers miss their tolerance"));
}

}  // namespace ps::cli
