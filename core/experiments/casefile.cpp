// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/casefile.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/base/utf8.h"
#include "core/experiments/casefunctions.h"
#include "core/experiments/casemeasure.h"
#include "core/experiments/formula.h"
#include "core/io/textfile.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace ps {
namespace {

using nlohmann::json;

constexpr size_t kMostNestedValues = 20;

/// A number as it stands, or what a formula makes of it.
double numberOf(const json& value, const std::string& place, const FormulaNames& named) {
  if (value.is_number()) return value.get<double>();
  if (!value.is_string()) throw InputError(place + ": must be a number or a formula");
  try {
    return valueOfFormula(value.get_ref<const std::string&>(), named);
  } catch (const InputError& problem) {
    throw InputError(place + ": " + problem.what());
  }
}

/// The named numbers of a case: each a number, or a formula that may use the others.
class CaseValues {
 public:
  /// Complains about those that have no value.
  CaseValues(const json* values, const std::string& place) : m_values(values) {
    if (!values) return;
    if (!values->is_object()) throw InputError(place + ": must be an object of names and numbers");
    for (const auto& [name, value] : values->items()) {
      if (!mayNameAValue(name)) throw InputError(place + "/" + shownText(name, 40) + ": cannot be the name of a value");
    }
    for (const auto& [name, value] : values->items()) m_known[name] = numberOf(value, place + "/" + name, names());
  }

  std::optional<double> find(const std::string& name) {
    if (const auto known = m_known.find(name); known != m_known.end()) return known->second;
    if (!m_values || !m_values->contains(name)) return std::nullopt;
    if (std::find(m_open.begin(), m_open.end(), name) != m_open.end() || m_open.size() == kMostNestedValues)
      throw InputError("'" + name + "' is made of itself, or of too many others");
    m_open.push_back(name);
    const double value = numberOf((*m_values)[name], "the value '" + name + "'", names());
    m_open.pop_back();
    return m_known[name] = value;
  }
  FormulaNames names() {
    return [this](const std::string& name) { return find(name); };
  }

 private:
  const json* m_values;
  std::map<std::string, double> m_known;
  std::vector<std::string> m_open;  ///< values that are being made
};

/// One object of the file; complains about what is missing, of another type, or not known.
class Entry {
 public:
  /// `values`: of the case that it is part of.
  Entry(const json& object, std::string place, std::shared_ptr<CaseValues> values = nullptr)
      : m_object(object), m_place(std::move(place)), m_values(std::move(values)) {
    if (!object.is_object()) fail("must be an object in { }");
  }

  /// The file's own object has its colon: "cases.json:".
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(m_place + (m_place.ends_with(':') ? " " : ": ") + what);
  }

  const json* find(const char* key) {
    m_known.insert(key);
    const auto found = m_object.find(key);
    return found == m_object.end() ? nullptr : &*found;
  }
  std::string text(const char* key) {
    const json* value = find(key);
    if (!value) return "";
    if (!value->is_string()) throw InputError(m_place + "/" + key + ": must be a text");
    return value->get<std::string>();
  }
  std::string neededText(const char* key) {
    const std::string value = text(key);
    if (value.empty()) throw InputError(m_place + "/" + key + ": is missing");
    return value;
  }
  std::optional<double> number(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    return numberOf(*value, m_place + "/" + key, names());
  }
  std::vector<double> numbers(const char* key) {
    const json* value = find(key);
    if (!value) return {};
    const std::string place = m_place + "/" + key;
    if (!value->is_array()) return {numberOf(*value, place, names())};
    if (value->empty()) throw InputError(place + ": must be a number or a list of numbers");
    std::vector<double> all;
    for (const json& one : *value) all.push_back(numberOf(one, place + "/" + std::to_string(all.size()), names()));
    return all;
  }
  std::vector<std::string> texts(const char* key) {
    const json* value = find(key);
    if (!value) return {};
    if (!value->is_array()) return {neededText(key)};
    std::vector<std::string> all;
    for (const json& one : *value) {
      if (!one.is_string()) throw InputError(m_place + "/" + key + ": must be a text or a list of texts");
      all.push_back(one.get<std::string>());
    }
    return all;
  }
  ProjectEdits edits(const char* key) {
    ProjectEdits all;
    const json* value = find(key);
    if (!value) return all;
    if (!value->is_object()) throw InputError(m_place + "/" + key + ": must be an object of JSON pointers and values");
    for (const auto& [pointer, changed] : value->items()) all.push_back(pointer + "=" + changed.dump());
    return all;
  }
  /// From here on formulas know them.
  void readValues(const char* key) { m_values = std::make_shared<CaseValues>(find(key), m_place + "/" + key); }
  std::optional<Entry> object(const char* key) {
    const json* value = find(key);
    return value ? std::optional<Entry>(std::in_place, *value, m_place + "/" + key, m_values) : std::nullopt;
  }
  std::vector<Entry> list(const char* key) {
    std::vector<Entry> all;
    const json* value = find(key);
    if (!value) return all;
    if (!value->is_array()) throw InputError(m_place + "/" + key + ": must be a list");
    for (size_t i = 0; i < value->size(); ++i) {
      all.emplace_back((*value)[i], m_place + "/" + key + "/" + std::to_string(i), m_values);
    }
    return all;
  }
  void refuseOthers() const {
    for (const auto& [key, value] : m_object.items()) {
      if (!m_known.contains(key)) throw InputError(m_place + "/" + key + ": is no key of a case");
    }
  }

 private:
  FormulaNames names() const {
    return m_values ? m_values->names() : [](const std::string&) { return std::optional<double>(); };
  }

  const json& m_object;
  std::string m_place;
  std::shared_ptr<CaseValues> m_values;
  std::set<std::string> m_known;
};

void oneOf(const Entry& entry, const std::vector<std::string>& names, const std::string& name, const char* noun) {
  if (std::find(names.begin(), names.end(), name) == names.end()) entry.fail("'" + name + "' is no " + noun);
}

/// What is not said is as in `general`; another column has nothing taken off it.
ColumnNumber readNumber(Entry& entry, const ColumnNumber& general) {
  ColumnNumber number;
  number.column = entry.text("column");
  const bool same = number.column.empty();
  if (same) number.column = general.column;
  if (number.column.empty()) number.column = entry.neededText("column");
  number.minus = entry.text("minus");
  if (number.minus.empty() && same) number.minus = general.minus;
  number.measure = entry.neededText("measure");
  oneOf(entry, measureNames(), number.measure, "measure");
  for (const char* key : {"from", "to", "time", "value", "level", "periods", "frames"}) {
    if (const auto value = entry.number(key)) number.options[key] = *value;
  }
  number.thermalClock = general.thermalClock;
  if (const std::string clock = entry.text("clock"); !clock.empty()) {
    oneOf(entry, {"thermal", "mechanical"}, clock, "clock");
    number.thermalClock = clock == "thermal";
  }
  return number;
}

void readColumn(Entry& entry, CaseCheck& check) {
  check.number = readNumber(entry, {});
  if (std::optional<Entry> less = entry.object("less")) {
    check.less = readNumber(*less, check.number);
    less->refuseOthers();
  }
  check.times = entry.number("times").value_or(check.times);
  check.plus = entry.number("plus").value_or(check.plus);
}

void readProfile(Entry& entry, CaseCheck& check) {
  oneOf(entry, profileLaws(), check.profile.law, "profile");
  check.profile.measure = entry.neededText("measure");
  oneOf(entry, profileMeasures(), check.profile.measure, "measure of a profile");
  check.profile.arguments = check.arguments;
  const std::string axis = entry.text("axis");
  oneOf(entry, {"", "x", "y", "z"}, axis, "axis");
  check.profile.axis = axis.empty() ? 0 : static_cast<size_t>(axis[0] - 'x');
  check.profile.from = entry.number("from").value_or(check.profile.from);
  check.profile.to = entry.number("to").value_or(check.profile.to);
}

/// Where the number comes from: a column, a profile, a function, or a material.
void readSource(Entry& entry, CaseCheck& check) {
  check.property = entry.text("property");
  check.equilibrium = entry.text("equilibrium");
  check.function = entry.text("function");
  check.profile.law = entry.text("profile");
  check.arguments = entry.numbers("arguments");
  if (!check.function.empty()) return;
  if (!check.profile.law.empty()) return readProfile(entry, check);
  if (check.property.empty() && check.equilibrium.empty()) return readColumn(entry, check);
  if (!check.equilibrium.empty()) oneOf(entry, equilibriumNames(), check.equilibrium, "equilibrium");
  check.material = entry.neededText("material");
  check.temperature = entry.number("temperature").value_or(check.temperature);
  check.pressure = entry.number("pressure").value_or(check.pressure);
}

CaseCheck readCheck(Entry& entry, const std::vector<CaseRun>& configurations) {
  const size_t runs = configurations.size();
  CaseCheck check;
  check.what = entry.neededText("what");
  check.run = entry.text("run");
  const auto named = [&](const CaseRun& run) { return run.name == check.run; };
  if (!check.run.empty() && std::none_of(configurations.begin(), configurations.end(), named)) {
    entry.fail("there is no run '" + check.run + "'");
  }
  readSource(entry, check);
  if (const json* spread = entry.find("spread")) check.spread = spread->is_boolean() && spread->get<bool>();
  check.expected = entry.numbers("expected");
  check.relative = entry.number("relative");
  check.absolute = entry.number("absolute");
  check.atLeast = entry.number("at_least");
  check.atMost = entry.number("at_most");
  check.limits = entry.texts("limit");
  if (check.expected.size() > 1 && check.expected.size() != runs) {
    entry.fail("expects " + std::to_string(check.expected.size()) + " values for " + std::to_string(runs) +
               (runs == 1 ? " run" : " runs"));
  }
  const bool toleranced = check.relative || check.absolute;
  if (check.expected.empty() == toleranced) entry.fail("needs an expected value and its tolerance, or a bound");
  if (!toleranced && !check.atLeast && !check.atMost) entry.fail("needs a tolerance or a bound");
  entry.refuseOthers();
  return check;
}

long framesOf(Entry& entry, long otherwise) {
  const double frames = entry.number("frames").value_or(static_cast<double>(otherwise));
  if (!(frames >= 0 && frames <= 1e9)) entry.fail("frames must be between 0 and 1e9");
  return static_cast<long>(frames);
}

Case readCase(Entry& entry, const std::filesystem::path& folder) {
  Case result;
  result.id = entry.neededText("id");
  result.why = entry.text("why");
  if (const std::string project = entry.text("project"); !project.empty()) result.project = (folder / project).string();
  result.edits = entry.edits("set");
  entry.readValues("values");
  const long frames = framesOf(entry, 0);
  for (Entry& run : entry.list("runs")) {
    result.runs.push_back({run.neededText("name"), run.edits("set"), framesOf(run, frames)});
    run.refuseOthers();
  }
  if (result.runs.empty()) result.runs.push_back({"", {}, frames});
  for (Entry& check : entry.list("checks")) result.checks.push_back(readCheck(check, result.runs));
  if (result.checks.empty()) entry.fail("checks nothing");
  entry.refuseOthers();
  return result;
}

}  // namespace

std::vector<Case> readCases(const std::string& path) {
  const json document = parseJson(readFile(path, kMaximumProjectBytes), path);
  Entry root(document, path + ":");
  std::vector<Case> cases;
  std::set<std::string> ids;
  for (Entry& entry : root.list("cases")) {
    cases.push_back(readCase(entry, std::filesystem::path(path).parent_path()));
    if (!ids.insert(cases.back().id).second) entry.fail("'" + cases.back().id + "' is there already");
  }
  if (cases.empty()) root.fail("has no cases");
  return cases;
}

}  // namespace ps
