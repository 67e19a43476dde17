// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "core/base/error.h"
#include "core/plugin_host/pluginscan.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <vector>

namespace ps::cli {
namespace {

struct Command {
  const char *name, *summary;
  int (*run)(CommandArguments);
  std::string (*help)();
};

constexpr Command kCommands[] = {
    {"simulate", "runs a project and writes a report, probes, a recording", simulateCommand, simulateHelp},
    {"render", "draws a project or a recording as pictures or a film", renderCommand, renderHelp},
    {"export", "writes particles or surfaces of a run for other programs", exportCommand, exportHelp},
    {"bench", "measures the solver's speed on this machine", benchCommand, benchHelp},
    {"validate", "checks projects", validateCommand, validateHelp},
    {"cases", "runs experiments and compares them with what theory expects", casesCommand, casesHelp},
    {"fit", "finds values of parameters with which a quantity goes as wanted", fitCommand, fitHelp},
    {"import", "makes a project of a mesh", importCommand, importHelp},
    {"mix", "makes a material of two others, and says by which rules", mixCommand, mixHelp},
    {"redraw", "draws sketched bodies again from their strokes", redrawCommand, redrawHelp},
    {"share", "writes a copy for others with what its run comes to, or checks one", shareCommand, shareHelp},
    {"soak", "runs projects with every slider at both ends of its range", soakCommand, soakHelp},
    {"plugins", "lists plugins, and what is wrong with broken ones", pluginsCommand, pluginsHelp},
    {"schema", "prints the JSON Schema of projects", schemaCommand, schemaHelp},
};

std::string overview() {
  std::string text = "phasesketch-cli COMMAND ...\n\n";
  for (const Command& command : kCommands) {
    std::string name = std::string("  ") + command.name;
    name.resize(12, ' ');
    text += name + command.summary + "\n";
  }
  return text +
         "\nphasesketch-cli COMMAND --help says more.\n"
         "Exit codes: 0 fine, 1 the run failed or set flags, 2 bad input, 3 a plugin did not come back.\n";
}

std::string commandNames() {
  std::string names;
  for (const Command& command : kCommands) names += (names.empty() ? "" : ", ") + std::string(command.name);
  return names;
}

/// Messages are one line, whatever a file's name or text holds.
int complain(const std::string& message, int code) {
  std::string line;
  for (const char c : message) line += c == '\n' || c == '\r' ? ' ' : c;
  std::fprintf(stderr, "phasesketch-cli: %s\n", line.c_str());
  return code;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return complain("which command? " + commandNames() + "; --help says more", kBadInput);
  if (arguments[0] == "--help" || arguments[0] == "-h" || arguments[0] == "help") {
    std::fputs(overview().c_str(), stdout);
    return kFine;
  }
  if (arguments[0] == "--version") {
    std::puts("phasesketch-cli " PS_VERSION);
    return kFine;
  }
  for (const Command& command : kCommands) {
    if (arguments[0] != command.name) continue;
    for (const std::string& argument : arguments) {
      if (argument == "--") break;
      if (argument == "--help" || argument == "-h") {
        std::fputs(command.help().c_str(), stdout);
        return kFine;
      }
    }
    return command.run(CommandArguments(arguments).subspan(1));
  }
  return complain("unknown command '" + arguments[0] + "'; --help lists them", kBadInput);
}

}  // namespace
}  // namespace ps::cli

int main(int argc, char** argv) {
  ps::servePluginScans(argc, argv);
  using namespace ps::cli;
  std::signal(SIGPIPE, SIG_IGN);  // a film program that ends early is an error to report, not the end of this one
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const ps::InputError& error) {
    return complain(error.what(), kBadInput);
  } catch (const std::bad_alloc&) {
    return complain("not enough memory; make the scene smaller", kFailed);
  } catch (const std::exception& error) {
    return complain(error.what(), kFailed);
  }
}
