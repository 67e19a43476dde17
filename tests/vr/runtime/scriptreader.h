// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/script.h"

#include <string>

namespace ps::scripted {

/// Reads a script file. Throws InputError with file and JSON pointer for whatever it does not know, so that a slip in a
/// test's script is no silent pass.
class ScriptReader {
 public:
  explicit ScriptReader(std::string path) : m_path(std::move(path)) {}
  void read(Script& script);

 private:
  using json = nlohmann::json;
  [[noreturn]] void refuse(const std::string& pointer, const std::string& what) const;
  double number(const json& value, const std::string& pointer, double minimum, double maximum) const;
  bool boolean(const json& value, const std::string& pointer) const;
  std::string text(const json& value, const std::string& pointer) const;
  XrPosef pose(const json& value, const std::string& pointer) const;
  const json& list(const json& value, const std::string& pointer) const;

  void readTop(Script& script, const std::string& key, const json& value) const;
  void readView(Script& script, const json& value) const;
  void readExtensions(Script& script, const json& value) const;
  void readFormats(Script& script, const json& value) const;
  void readKey(Script& script, const json& value, const std::string& pointer) const;
  void readHand(Script& script, size_t hand, double frame, const json& value, const std::string& pointer) const;
  void readEvent(Script& script, const json& value, const std::string& pointer) const;
  void checkEvent(const std::string& kind, const json& value, const std::string& pointer) const;

  std::string m_path;
};

/// Of a list that was read as a pose: x, y, z in metres, and perhaps a quaternion's x, y, z, w.
XrPosef poseOf(const nlohmann::json& numbers);
/// Those that swapchains can have, the preferred one first.
std::vector<int64_t> swapchainFormats();

}  // namespace ps::scripted
