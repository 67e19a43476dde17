// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/caserun.h"

#include "core/base/error.h"
#include "core/base/shorttext.h"
#include "core/experiments/casefunctions.h"
#include "core/experiments/casemeasure.h"
#include "core/experiments/probetable.h"
#include "core/io/projectio.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// What one run left behind.
struct CaseOutcome {
  std::vector<std::string> titles;
  std::vector<std::vector<double>> rows;  ///< the probes' table: how it begins, then by frame
  std::vector<Material> materials;        ///< of the scene
  TemperatureField field;                 ///< at the end
  std::vector<Limit> limits;              ///< likewise

  Series series(const std::string& title, bool thermalClock) const {
    const auto found = std::find(titles.begin(), titles.end(), title);
    if (found == titles.end()) throw InputError("the project has no probe that gives the column '" + title + "'");
    const auto column = static_cast<size_t>(found - titles.begin());
    Series result;
    for (const std::vector<double>& row : rows) {
      const bool unknown = &row == rows.data() && !std::isfinite(row[column]);
      if (unknown) continue;  // what only a frame has, or matter that is yet to come
      result.time.push_back(row[thermalClock ? 1 : 0]);
      result.value.push_back(row[column]);
    }
    return result;
  }
};

CaseOutcome run(const Case& what, const CaseRun& configuration, const ProjectEdits& more, PluginRegistry& plugins,
                const StopTest& stop) {
  ProjectEdits edits = what.edits;
  edits.insert(edits.end(), configuration.edits.begin(), configuration.edits.end());
  edits.insert(edits.end(), more.begin(), more.end());
  Project project = loadProject(what.project, plugins, edits).project;
  project.state = nullptr;  // what is expected is counted from the start
  Engine engine(project, plugins);
  const ProbeColumns columns(engine);
  CaseOutcome outcome{
      columns.titles(), {columns.values(engine, engine.stats())}, compileMaterials(project, plugins), {}, {}};
  std::string problem;
  const bool whole = runFrames(
      engine, configuration.frames,
      [&](const StepReport& step, const FrameStats& stats) {
        if (problem.empty()) problem = step.message;
        outcome.rows.push_back(columns.values(engine, stats));
      },
      stop);
  if (!problem.empty()) throw Error("the run set flags: " + problem);
  if (!whole) throw Error("stopped early");
  outcome.field = temperatureField(engine);
  outcome.limits = engine.limits();
  return outcome;
}

std::optional<double> expectedOf(const CaseCheck& check, size_t run) {
  if (check.expected.empty()) return std::nullopt;
  return check.expected[check.expected.size() > 1 ? run : 0];
}

/// The scene's material of that name, or the installed one.
const Material& materialOf(const CaseCheck& check, const CaseOutcome* outcome, const PluginRegistry& plugins) {
  if (outcome) {
    for (const Material& material : outcome->materials) {
      if (material.id == check.material) return material;
    }
  }
  const Material* material = plugins.material(check.material);
  if (!material) throw InputError("there is no material '" + check.material + "'");
  return *material;
}

double ofMaterial(const CaseCheck& check, const CaseOutcome* outcome, const PluginRegistry& plugins) {
  const Material& material = materialOf(check, outcome, plugins);
  if (!check.equilibrium.empty()) {
    return equilibriumOf(material, check.equilibrium, check.pressure, check.temperature);
  }
  if (propertyIndex(check.property) < 0) throw InputError("there is no property '" + check.property + "'");
  return BakedMaterial(material, check.pressure).property(check.property.c_str(), check.temperature);
}

double numberOf(const ColumnNumber& number, const CaseOutcome& outcome) {
  Series series = outcome.series(number.column, number.thermalClock);
  if (!number.minus.empty()) {
    const Series other = outcome.series(number.minus, number.thermalClock);
    const size_t rows = std::min(series.value.size(), other.value.size());  // only their first may be missing
    const auto drop = [&](std::vector<double>& list) {
      list.erase(list.begin(), list.end() - static_cast<std::ptrdiff_t>(rows));
    };
    drop(series.time);
    drop(series.value);
    for (size_t k = 0; k < rows; ++k) series.value[k] -= other.value[other.value.size() - rows + k];
  }
  return measureOf(series, number.measure, number.options);
}

double measured(const CaseCheck& check, const CaseOutcome& outcome) {
  if (!check.profile.law.empty()) return profileValue(outcome.field, check.profile);
  const double less = check.less ? numberOf(*check.less, outcome) : 0;
  return check.times * (numberOf(check.number, outcome) - less) + check.plus;
}

/// "steel.youngs_modulus 2.1e+11 Pa asked, 4e+08 delivered".
std::string toldBy(const CaseOutcome& outcome, const CaseCheck& check) {
  std::string text;
  for (const Limit& limit : outcome.limits) {
    if (!concerns(check, limit.what)) continue;
    text += (text.empty() ? "" : "; ") + limit.what + " " + sixDigits(limit.asked) +
            (limit.unit.empty() ? "" : " " + limit.unit) + " asked, " + sixDigits(limit.delivered) + " delivered";
    if (!limit.why.empty()) text += " (" + limit.why + ")";
  }
  return text;
}

void judge(const Case& what, const CaseCheck& check, const std::vector<CaseOutcome>& outcomes,
           const PluginRegistry& plugins, const VerdictVisitor& each) {
  if (!check.function.empty()) {
    each(verdictOf(what, check.what, check, expectedOf(check, 0), valueOfFunction(check.function, check.arguments)));
    return;
  }
  const bool fromMaterial = !check.property.empty() || !check.equilibrium.empty();
  if (fromMaterial && outcomes.empty()) {
    each(verdictOf(what, check.what, check, expectedOf(check, 0), ofMaterial(check, nullptr, plugins)));
    return;
  }
  std::vector<double> measuredValues;
  measuredValues.reserve(outcomes.size());
  for (const CaseOutcome& outcome : outcomes) {
    measuredValues.push_back(fromMaterial ? ofMaterial(check, &outcome, plugins) : measured(check, outcome));
  }
  if (check.spread) {
    const auto [least, most] = std::minmax_element(measuredValues.begin(), measuredValues.end());
    CaseVerdict verdict = verdictOf(what, check.what, check, std::nullopt, *most / *least - 1);
    for (const CaseOutcome& outcome : outcomes)
      if (!verdict.holds && verdict.told.empty()) verdict.told = toldBy(outcome, check);
    each(verdict);
    return;
  }
  for (size_t k = 0; k < measuredValues.size(); ++k) {
    const std::string& name = what.runs[k].name;
    if (!check.run.empty() && check.run != name) continue;
    CaseVerdict verdict =
        verdictOf(what, check.what + (name.empty() ? "" : ", " + name), check, expectedOf(check, k), measuredValues[k]);
    if (!verdict.holds && std::isfinite(measuredValues[k])) verdict.told = toldBy(outcomes[k], check);
    each(verdict);
  }
}

}  // namespace

bool concerns(const CaseCheck& check, const std::string& limit) {
  const auto names = [&](const std::string& name) {
    return limit == name || limit.starts_with(name + ".") || limit.ends_with("." + name);
  };
  return check.limits.empty() || std::any_of(check.limits.begin(), check.limits.end(), names);
}

CaseVerdict verdictOf(const Case& what, const std::string& name, const CaseCheck& check, std::optional<double> expected,
                      double measured) {
  CaseVerdict verdict{what.id, name, expected, measured, "", std::isfinite(measured), ""};
  const auto limit = [&](const char* sign, double value, bool holds) {
    verdict.tolerance += (verdict.tolerance.empty() ? "" : ", ") + std::string(sign) + sixDigits(value);
    verdict.holds = verdict.holds && holds;
  };
  if (check.relative) {
    verdict.tolerance = "±" + sixDigits(100 * *check.relative) + " %";
    verdict.holds = verdict.holds && std::abs(measured / *expected - 1) <= *check.relative;
  }
  if (check.absolute) limit("±", *check.absolute, std::abs(measured - *expected) <= *check.absolute);
  if (check.atLeast) limit("≥ ", *check.atLeast, measured >= *check.atLeast);
  if (check.atMost) limit("≤ ", *check.atMost, measured <= *check.atMost);
  return verdict;
}

void runCase(const Case& what, const ProjectEdits& more, PluginRegistry& plugins, const StopTest& stop,
             const VerdictVisitor& each) {
  std::string current;
  try {
    std::vector<CaseOutcome> outcomes;
    for (const CaseRun& configuration : what.runs) {
      current = configuration.name;
      if (!what.project.empty()) outcomes.push_back(run(what, configuration, more, plugins, stop));
    }
    current.clear();
    for (const CaseCheck& check : what.checks) judge(what, check, outcomes, plugins, each);
  } catch (const Error& error) {
    each({what.id, current, std::nullopt, std::nullopt, error.what(), false, ""});
  }
}

}  // namespace ps
