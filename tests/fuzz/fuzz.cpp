// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/fuzz.h"

#include "core/base/jsontext.h"

#include <cstdio>
#include <cstdlib>

namespace ps::fuzz {
namespace {

bool isUtf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

}  // namespace

PluginRegistry& plugins() {
  static PluginRegistry registry({.extraPaths = {}, .builtIn = true, .userDirectory = false, .environment = false});
  return registry;
}

void require(bool holds, const std::string& otherwise) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", otherwise.c_str());
  std::abort();
}

void requireMessage(const std::string& message, const std::string& name) {
  require(message.starts_with(name) && message.size() > name.size(), "a message says whose it is: " + message);
  require(isUtf8(message), "a message is UTF-8: " + message);
}

void requireReadsBack(const Project& project) {
  const std::string written = writeProject(project);
  std::string again;
  try {
    again = writeProject(readProject(written, kName, plugins()).project);
  } catch (const InputError& problem) {
    require(false, std::string("what is saved opens: ") + problem.what() + "\n" + written);
  }
  require(again == written, "a project that is saved, opened and saved is the same:\n" + written + again);
}

}  // namespace ps::fuzz
