// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/experiments/casefile.h"
#include "core/experiments/casefunctions.h"
#include "core/experiments/casemeasure.h"
#include "core/experiments/probetable.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    {"--only", "ID", "runs this case alone; may repeat, and the beginning of an id will do"},
    {"--list", "", "names the cases and runs none"},
    {kSet.name, kSet.value, "changes every project before it is checked; may repeat"},
    kThreads,
    kIsa,
};

/// What one run left behind.
struct Outcome {
  std::vector<std::string> titles;
  std::vector<std::vector<double>> rows;  ///< the probes' table and the heat balance, by frame
  std::vector<Material> materials;        ///< of the scene
  TemperatureField field;                 ///< at the end

  Series series(const std::string& title, bool thermalClock) const {
    const auto found = std::find(titles.begin(), titles.end(), title);
    if (found == titles.end()) throw InputError("the project has no probe that gives the column '" + title + "'");
    const auto column = static_cast<size_t>(found - titles.begin());
    Series result;
    for (const std::vector<double>& row : rows) {
      result.time.push_back(row[thermalClock ? 1 : 0]);
      result.value.push_back(row[column]);
    }
    return result;
  }
};

/// What every run gives beside its probes: thermal energy; what came in by walls, air, radiation, heaters and with
/// matter since the start, and the amounts of it; what of the change of energy none of these explains, and that as a
/// share of the sum of |m h|.
constexpr const char* kHeatTitles[] = {"heat.energy[J]",    "heat.walls[J]",   "heat.air[J]",
                                       "heat.radiation[J]", "heat.heaters[J]", "heat.sources[J]",
                                       "heat.exchanged[J]", "heat.open[J]",    "heat.open_share[1]"};

void addHeat(Engine& engine, const FrameStats& start, const FrameStats& now, std::vector<double>& row) {
  double sum = 0;
  for (const double energy : engine.solver().thermalEnergies()) sum += std::abs(energy);
  const HeatLedger &before = start.heat, &heat = now.heat;
  const double open = now.thermalEnergy - start.thermalEnergy - (heat.net() - before.net());
  for (const double value :
       {now.thermalEnergy, heat.walls - before.walls, heat.air - before.air, heat.radiation - before.radiation,
        heat.heaters - before.heaters, heat.sources - before.sources, heat.exchanged - before.exchanged, open,
        sum > 0 ? std::abs(open) / sum : 0.0}) {
    row.push_back(value);
  }
}

Outcome run(const Case& what, const CaseRun& configuration, const Edits& more, PluginRegistry& plugins) {
  Edits edits = what.edits;
  edits.insert(edits.end(), configuration.edits.begin(), configuration.edits.end());
  edits.insert(edits.end(), more.begin(), more.end());
  const Project project = loadProject(what.project, plugins, edits).project;
  Engine engine(project, plugins);
  Outcome outcome{columnTitles(engine.probeNames()), {}, compileMaterials(project, plugins), {}};
  outcome.titles.insert(outcome.titles.end(), std::begin(kHeatTitles), std::end(kHeatTitles));
  std::string problem;
  const FrameStats start = engine.stats();
  const bool whole = runFrames(engine, configuration.frames, [&](const StepReport& step, const FrameStats& stats) {
    if (problem.empty()) problem = step.message;
    outcome.rows.push_back(columnValues(stats));
    addHeat(engine, start, stats, outcome.rows.back());
  });
  if (!problem.empty()) throw Error("the run set flags: " + problem);
  if (!whole) throw Error("stopped early");
  outcome.field = temperatureField(engine);
  return outcome;
}

std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// One line of the printed table.
class Verdicts {
 public:
  Verdicts() { print("case", "what", "expected", "got", "tolerance", "ok"); }

  void add(const Case& what, const std::string& name, const CaseCheck& check, std::optional<double> expected,
           double got) {
    bool fine = std::isfinite(got);
    std::string tolerance;
    const auto limit = [&](const char* sign, double value, bool holds) {
      tolerance += (tolerance.empty() ? "" : ", ") + std::string(sign) + shown(value);
      fine = fine && holds;
    };
    if (check.relative) {
      const double off = std::abs(got / *expected - 1);
      tolerance = "±" + shown(100 * *check.relative) + " %";
      fine = fine && off <= *check.relative;
    }
    if (check.absolute) limit("±", *check.absolute, std::abs(got - *expected) <= *check.absolute);
    if (check.atLeast) limit("≥ ", *check.atLeast, got >= *check.atLeast);
    if (check.atMost) limit("≤ ", *check.atMost, got <= *check.atMost);
    print(what.id, name, expected ? shown(*expected) : "", shown(got), tolerance, fine ? "yes" : "NO");
    m_failed += fine ? 0 : 1;
  }
  void fail(const Case& what, const std::string& name, const std::string& why) {
    print(what.id, name, "", "", why, "NO");
    ++m_failed;
  }
  int failed() const { return m_failed; }

 private:
  /// Columns as wide as people see them: a sign like ≥ has three bytes and one place.
  static std::string padded(const std::string& text, size_t width) {
    const auto places = static_cast<size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
    return text + std::string(places < width ? width - places : 0, ' ');
  }
  static void print(const std::string& id, const std::string& what, const std::string& expected, const std::string& got,
                    const std::string& tolerance, const std::string& fine) {
    std::printf("%s  %s  %s  %s  %s  %s\n", padded(id, 28).c_str(), padded(what, 44).c_str(),
                padded(expected, 11).c_str(), padded(got, 11).c_str(), padded(tolerance, 16).c_str(), fine.c_str());
    std::fflush(stdout);
  }

  int m_failed = 0;
};

std::optional<double> expectedOf(const CaseCheck& check, size_t run) {
  if (check.expected.empty()) return std::nullopt;
  return check.expected[check.expected.size() > 1 ? run : 0];
}

/// The scene's material of that name, or the installed one.
const Material& materialOf(const CaseCheck& check, const Outcome* outcome, const PluginRegistry& plugins) {
  if (outcome) {
    for (const Material& material : outcome->materials) {
      if (material.id == check.material) return material;
    }
  }
  const Material* material = plugins.material(check.material);
  if (!material) throw InputError("there is no material '" + check.material + "'");
  return *material;
}

double ofMaterial(const CaseCheck& check, const Outcome* outcome, const PluginRegistry& plugins) {
  const Material& material = materialOf(check, outcome, plugins);
  if (!check.equilibrium.empty()) {
    return equilibriumOf(material, check.equilibrium, check.pressure, check.temperature);
  }
  if (propertyIndex(check.property) < 0) throw InputError("there is no property '" + check.property + "'");
  return BakedMaterial(material, check.pressure).property(check.property.c_str(), check.temperature);
}

double measured(const CaseCheck& check, const Outcome& outcome) {
  if (!check.profile.law.empty()) return profileValue(outcome.field, check.profile);
  Series series = outcome.series(check.column, check.thermalClock);
  if (!check.minus.empty()) {
    const Series other = outcome.series(check.minus, check.thermalClock);
    for (size_t k = 0; k < series.value.size(); ++k) series.value[k] -= other.value[k];
  }
  return check.times * measureOf(series, check.measure, check.options) + check.plus;
}

void judge(const Case& what, const CaseCheck& check, const std::vector<Outcome>& outcomes,
           const PluginRegistry& plugins, Verdicts& verdicts) {
  if (!check.function.empty()) {
    verdicts.add(what, check.what, check, expectedOf(check, 0), valueOfFunction(check.function, check.arguments));
    return;
  }
  const bool fromMaterial = !check.property.empty() || !check.equilibrium.empty();
  if (fromMaterial && outcomes.empty()) {
    verdicts.add(what, check.what, check, expectedOf(check, 0), ofMaterial(check, nullptr, plugins));
    return;
  }
  std::vector<double> got;
  got.reserve(outcomes.size());
  for (const Outcome& outcome : outcomes) {
    got.push_back(fromMaterial ? ofMaterial(check, &outcome, plugins) : measured(check, outcome));
  }
  if (check.spread) {
    const auto [least, most] = std::minmax_element(got.begin(), got.end());
    verdicts.add(what, check.what, check, std::nullopt, *most / *least - 1);
    return;
  }
  for (size_t k = 0; k < got.size(); ++k) {
    const std::string& name = what.runs[k].name;
    if (!check.run.empty() && check.run != name) continue;
    verdicts.add(what, check.what + (name.empty() ? "" : ", " + name), check, expectedOf(check, k), got[k]);
  }
}

void runCase(const Case& what, const Edits& more, PluginRegistry& plugins, Verdicts& verdicts) {
  std::string current;
  try {
    std::vector<Outcome> outcomes;
    for (const CaseRun& configuration : what.runs) {
      current = configuration.name;
      if (!what.project.empty()) outcomes.push_back(run(what, configuration, more, plugins));
    }
    current.clear();
    for (const CaseCheck& check : what.checks) judge(what, check, outcomes, plugins, verdicts);
  } catch (const Error& error) {
    verdicts.fail(what, current, error.what());
  }
}

bool chosen(const Case& what, const std::vector<std::string>& only) {
  return only.empty() ||
         std::any_of(only.begin(), only.end(), [&](const std::string& id) { return what.id.starts_with(id); });
}

}  // namespace

std::string casesHelp() {
  return "phasesketch-cli cases FILE... [options]\n\nRuns the experiments of files: projects with the numbers of each "
         "case, and what theory expects. Prints the\ntable \"case, what, expected, got, tolerance, ok\". Exit code 1 "
         "when a case misses its tolerance.\n\n" +
         optionHelp(kOptions);
}

int casesCommand(CommandArguments given) {
  const Arguments arguments(given, kOptions);
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
  Verdicts verdicts;
  for (const Case& what : cases) runCase(what, arguments.all(kSet.name), plugins, verdicts);
  if (verdicts.failed() == 0) return kFine;
  const bool one = verdicts.failed() == 1;
  throw Error(std::to_string(verdicts.failed()) +
              (one ? " number misses its tolerance" : " numbers miss their tolerance"));
}

}  // namespace ps::cli
