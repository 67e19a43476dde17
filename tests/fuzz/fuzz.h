// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"

#include <cstddef>
#include <cstdint>
#include <string>

// What the targets share. Each is one function over any bytes: it may refuse them with an InputError that names them,
// and must hold what it promises of those that it takes. A broken promise ends the program, as a crash does.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace ps::fuzz {

/// What messages call the input.
inline constexpr const char* kName = "input";

/// The plugins of the build tree, loaded once.
PluginRegistry& plugins();

/// Ends the program with these words where something does not hold.
void require(bool holds, const std::string& otherwise);
/// A message is UTF-8, and begins with whose it is: `name`, and ':' or what stands after it.
void requireMessage(const std::string& message, const std::string& name = kName);
/// Written and read again, a project is the same to the byte.
void requireReadsBack(const Project& project);

inline std::string textOf(const uint8_t* data, size_t size) {
  return size == 0 ? std::string() : std::string(reinterpret_cast<const char*>(data), size);
}

}  // namespace ps::fuzz
