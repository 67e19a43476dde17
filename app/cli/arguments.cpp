// SPDX-License-Identifier: Apache-2.0
#include "app/cli/arguments.h"

#include "core/base/error.h"
#include "core/parameters/parameterset.h"

#include <algorithm>
#include <charconv>

namespace ps::cli {
namespace {

const OptionSpec* find(std::span<const OptionSpec> options, const std::string& name) {
  const auto found = std::find_if(options.begin(), options.end(), [&](const OptionSpec& o) { return name == o.name; });
  return found == options.end() ? nullptr : &*found;
}

template <class T>
std::optional<T> parsed(const std::string& text) {
  T value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

Arguments::Arguments(std::span<const std::string> arguments, std::span<const OptionSpec> options) {
  bool open = true;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (open && argument == "--") {
      open = false;
      continue;
    }
    if (!open || !argument.starts_with("-") || argument == "-") {
      m_positional.push_back(argument);
      continue;
    }
    const size_t equals = argument.find('=');
    const std::string name = argument.substr(0, equals);
    const OptionSpec* spec = find(options, name);
    if (!spec) throw InputError("unknown option " + name + "; --help lists them");
    std::string value;
    if (*spec->value) {
      if (equals != std::string::npos) {
        value = argument.substr(equals + 1);
      } else if (i + 1 < arguments.size()) {
        value = arguments[++i];
      } else {
        throw InputError(name + " needs a value: " + spec->value);
      }
    } else if (equals != std::string::npos) {
      throw InputError(name + " takes no value");
    }
    if (has(name) && name != "--set" && name != "--only" && name != "--vary")
      throw InputError(name + " is given twice");
    m_values[name].push_back(value);
  }
}

std::string Arguments::text(const std::string& name, const std::string& fallback) const {
  const auto found = m_values.find(name);
  return found == m_values.end() ? fallback : found->second.back();
}

const std::vector<std::string>& Arguments::all(const std::string& name) const {
  static const std::vector<std::string> none;
  const auto found = m_values.find(name);
  return found == m_values.end() ? none : found->second;
}

std::optional<double> Arguments::number(const std::string& name, double minimum, double maximum) const {
  if (!has(name)) return std::nullopt;
  const auto value = parsed<double>(text(name));
  if (!value || !(*value >= minimum && *value <= maximum)) {
    throw InputError(name + " must be a number from " + numberText(minimum) + " to " + numberText(maximum) + ", not '" +
                     text(name) + "'");
  }
  return value;
}

std::optional<long> Arguments::integer(const std::string& name, long minimum, long maximum) const {
  if (!has(name)) return std::nullopt;
  const auto value = parsed<long>(text(name));
  if (!value || *value < minimum || *value > maximum) {
    throw InputError(name + " must be a whole number from " + std::to_string(minimum) + " to " +
                     std::to_string(maximum) + ", not '" + text(name) + "'");
  }
  return value;
}

std::string optionHelp(std::span<const OptionSpec> options) {
  std::string help;
  for (const OptionSpec& option : options) {
    std::string left = std::string("  ") + option.name + (*option.value ? std::string(" ") + option.value : "");
    left.resize(std::max<size_t>(left.size() + 2, 24), ' ');
    help += left + option.help + "\n";
  }
  return help;
}

}  // namespace ps::cli
