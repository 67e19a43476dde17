// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ps::cli {

struct OptionSpec {
  const char* name;   ///< "--seconds"
  const char* value;  ///< what follows it: "S"; "" for a switch
  const char* help;
};

/// A command's arguments: options may stand anywhere, as "--name value" or "--name=value"; "--" ends them.
class Arguments {
 public:
  /// Throws InputError for unknown options, missing values, and switches or single options given twice
  /// ("--set", "--only" and "--vary" may repeat).
  Arguments(std::span<const std::string> arguments, std::span<const OptionSpec> options);

  const std::vector<std::string>& positional() const { return m_positional; }
  bool has(const std::string& name) const { return m_values.contains(name); }
  std::string text(const std::string& name, const std::string& fallback = "") const;
  const std::vector<std::string>& all(const std::string& name) const;
  /// Throw InputError when the text is no number of the range.
  std::optional<double> number(const std::string& name, double minimum, double maximum) const;
  std::optional<long> integer(const std::string& name, long minimum, long maximum) const;

 private:
  std::vector<std::string> m_positional;
  std::map<std::string, std::vector<std::string>> m_values;
};

/// One line per option for a command's help.
std::string optionHelp(std::span<const OptionSpec> options);

}  // namespace ps::cli
