// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/curvefit.h"

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/experiments/probetable.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "core/simulation/edits.h"
#include "core/simulation/tracks.h"
#include "core/solver/solver.h"

#include <nlopt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace ps {
namespace {

/// Parts of a parameter's range: the first step of the descent, and what it ends at.
constexpr double kFirstStep = 0.1, kLastStep = 1.0 / 3000;
/// Runs that look the range over, for one parameter and for each further one.
constexpr int kLooks = 5, kMoreLooks = 3;

double spanOf(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most > *least ? *most - *least : std::max(std::abs(*most), 1e-30);
}

/// Of the points of a set that fills the unit cube evenly (Kronecker's sequence, with the root of x^(d+1) = x + 1).
std::vector<double> evenPoint(int index, size_t dimensions) {
  double root = 2;
  for (int k = 0; k < 60; ++k) root = std::pow(1 + root, 1.0 / static_cast<double>(dimensions + 1));
  std::vector<double> point(dimensions);
  for (size_t d = 0; d < dimensions; ++d) {
    point[d] = std::fmod(0.5 + index * std::pow(1 / root, static_cast<double>(d + 1)), 1.0);
  }
  return point;
}

double parsedNumber(const std::string& text, const std::string& whole) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  throw InputError("'" + whole + "': '" + text + "' is no number; write ADDRESS=LEAST..MOST");
}

/// Asks while a scene is made, too: a large one takes seconds.
class Making final : public Progress {
 public:
  explicit Making(const StopTest& stop) : m_stop(stop) {}

 private:
  void advanced(size_t) override {
    if (m_stop && m_stop()) cancel();
  }
  const StopTest& m_stop;
};

/// One search.
class Fit {
 public:
  Fit(const Project& project, PluginRegistry& plugins, const FitTask& task, const StopTest& stop,
      const FitVisitor& each)
      : m_project(project), m_plugins(plugins), m_task(task), m_stop(stop), m_each(each) {}

  FitResult run() {
    try {
      checkTask();
    } catch (const Cancelled&) {
      m_result.stopped = true;
      return m_result;
    }
    std::vector<double> start;
    for (const FitParameter& p : m_task.parameters) {
      start.push_back(partOf(p, numberAt(m_project, &m_plugins, p.target)));
    }
    if (goesOn()) tryOut(start);
    if (m_result.runs == 0) return m_result;
    const size_t count = start.size();
    const int looks = kLooks + kMoreLooks * (static_cast<int>(count) - 1);
    for (int k = 0; k < looks && goesOn(); ++k) tryOut(evenPoint(k, count));
    descend();
    return m_result;
  }

 private:
  bool goesOn() {
    if (m_result.runs < m_task.mostRuns && !(m_stop && m_stop())) return true;
    m_result.stopped = true;
    return false;
  }
  static double partOf(const FitParameter& p, double number) {
    return std::clamp((number - p.minimum) / (p.maximum - p.minimum), 0.0, 1.0);
  }

  void checkTask() {
    if (m_task.parameters.empty()) throw InputError("there is no parameter that may change");
    for (const FitParameter& p : m_task.parameters) {
      if (const std::string why = whyNotFitted(m_project, &m_plugins, p.target); !why.empty()) throw InputError(why);
      if (!(p.minimum < p.maximum)) throw InputError(p.target.address.text() + ": its range is empty");
    }
    if (m_task.wanted.time.empty() || m_task.wanted.time.size() != m_task.wanted.value.size())
      throw InputError("the wanted curve has no points");
    if (!std::is_sorted(m_task.wanted.time.begin(), m_task.wanted.time.end()))
      throw InputError("the wanted curve's points must ascend in time");
    const Engine engine = made(m_project);
    const std::vector<std::string> titles = ProbeColumns(engine).titles();
    const auto found = std::find(titles.begin(), titles.end(), m_task.column);
    if (found == titles.end())
      throw InputError("there is no column '" + m_task.column + "'; the table of probes names them");
    m_column = static_cast<size_t>(found - titles.begin());
    if (m_task.wanted.time.back() <= engine.solver().time())
      throw InputError("the wanted curve ends before the run begins");
  }

  /// Runs the project with values at these parts of their ranges. Returns the mean square of what is missed; of a run
  /// without values more than of any that has them.
  double tryOut(const std::vector<double>& parts) {
    const auto known = m_known.find(parts);
    if (known != m_known.end()) return known->second;
    FitTrial trial{m_result.runs + 1, {}, 0, 0, false, {}};
    bool asPartsSay = true;
    for (size_t k = 0; k < parts.size(); ++k) {
      const FitParameter& p = m_task.parameters[k];
      const double number = p.minimum + parts[k] * (p.maximum - p.minimum);
      const double present = numberAt(m_project, &m_plugins, p.target);  // may lie outside of the range
      asPartsSay = asPartsSay && (trial.run > 1 || (present >= p.minimum && present <= p.maximum));
      trial.values.push_back(trial.run == 1 ? present : number);
    }
    trial.course = courseWith(trial.run == 1 ? std::vector<double>() : trial.values);
    if (m_stop && m_stop()) {
      m_result.stopped = true;
      return std::numeric_limits<double>::max();
    }
    double square = missedBy(trial);
    trial.error = std::sqrt(square);
    const FitTrial& best = m_result.after;
    trial.isBest =
        trial.run == 1 || trial.missing < best.missing || (trial.missing == best.missing && trial.error < best.error);
    if (trial.missing > 0)
      square = 2 * std::max(square, m_worst);
    else
      m_worst = std::max(m_worst, square);
    m_result.runs = trial.run;
    if (trial.run == 1) m_result.before = trial;
    if (trial.isBest) {
      m_result.after = trial;
      m_best = parts;
    }
    if (asPartsSay) m_known[parts] = square;
    if (m_each) m_each(trial);
    return square;
  }

  /// Throws Cancelled.
  Engine made(Project project) const {
    Making making(m_stop);
    const ProgressScope scope(&making);
    return Engine(std::move(project), m_plugins);
  }

  /// Without values: of the project as it is.
  Series courseWith(const std::vector<double>& values) {
    Series course;
    try {
      Engine engine = made(withValues(m_project, m_plugins, m_task, values));
      const ProbeColumns columns(engine);
      const auto add = [&](const FrameStats& stats) {
        course.time.push_back(stats.time);
        course.value.push_back(columns.values(engine, stats)[m_column]);
      };
      add(engine.stats());
      const double left = m_task.wanted.time.back() - engine.solver().time();
      const double frames = std::ceil(left / frameLength(m_project) + 1e-6);
      runFrames(
          engine, static_cast<long>(frames), [&](const StepReport&, const FrameStats& stats) { add(stats); }, m_stop);
    } catch (const InputError&) {  // these values cannot be: the run has no course
    } catch (const Cancelled&) {   // who stops it is asked again
    }
    return course;
  }

  /// Counts what is missing, too.
  double missedBy(FitTrial& trial) const {
    const Series& course = trial.course;
    const double span = spanOf(m_task.wanted.value);
    double sum = 0;
    size_t count = 0;
    for (size_t k = 0; k < m_task.wanted.time.size(); ++k) {
      const double time = m_task.wanted.time[k];
      if (!course.time.empty() && time < course.time.front()) continue;  // before the state that runs begin at
      const double value =
          course.time.empty() || time > course.time.back() ? std::nan("") : measureOf(course, "at", {{"time", time}});
      const double missed = std::isfinite(value) ? value - m_task.wanted.value[k] : span;
      trial.missing += std::isfinite(value) ? 0 : 1;
      sum += missed * missed;
      ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : span * span;
  }

  void descend() {
    if (!goesOn()) return;
    const auto count = static_cast<unsigned>(m_best.size());
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> search(nlopt_create(NLOPT_LN_BOBYQA, count), nlopt_destroy);
    if (!search) throw std::bad_alloc();
    m_search = search.get();
    nlopt_set_lower_bounds1(search.get(), 0);
    nlopt_set_upper_bounds1(search.get(), 1);
    nlopt_set_initial_step1(search.get(), kFirstStep);
    nlopt_set_xtol_abs1(search.get(), kLastStep);
    nlopt_set_min_objective(search.get(), &Fit::objective, this);
    std::vector<double> parts = m_best;
    double least = 0;
    nlopt_optimize(search.get(), parts.data(), &least);  // what it found is kept as it goes; it ends as it must
    if (m_thrown) std::rethrow_exception(m_thrown);
  }

  /// Nothing is thrown through the library.
  static double objective(unsigned count, const double* x, double*, void* self) {
    auto& fit = *static_cast<Fit*>(self);
    double square = std::numeric_limits<double>::max();
    try {
      if (fit.goesOn()) square = fit.tryOut(std::vector<double>(x, x + count));
      if (fit.m_result.stopped) nlopt_force_stop(fit.m_search);
    } catch (...) {
      fit.m_thrown = std::current_exception();
      nlopt_force_stop(fit.m_search);
    }
    return square;
  }

  const Project& m_project;
  PluginRegistry& m_plugins;
  const FitTask& m_task;
  const StopTest& m_stop;
  const FitVisitor& m_each;
  size_t m_column = 0;
  std::vector<double> m_best;  // parts of the ranges
  std::map<std::vector<double>, double> m_known;
  double m_worst = 0;  // mean square, of runs that have all values
  nlopt_opt m_search = nullptr;
  std::exception_ptr m_thrown;
  FitResult m_result;
};

}  // namespace

std::string FitTarget::trackText() const {
  return address.text() + (point ? "[" + std::to_string(*point) + "]" : std::string());
}

std::string FitTarget::text() const { return trackText() + (key ? "@" + std::to_string(*key) : std::string()); }

FitParameter FitParameter::parse(const std::string& text, const Project& project, const PluginRegistry* plugins) {
  const size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const size_t at = name.rfind('@');
  const std::optional<TrackTarget> parsed = TrackTarget::parse(name.substr(0, at));
  std::optional<size_t> key;
  if (at != std::string::npos) {
    size_t number = 0;
    const char* const end = name.data() + name.size();
    const auto [stop, problem] = std::from_chars(name.data() + at + 1, end, number);
    if (problem != std::errc() || stop != end)
      throw InputError("'" + name + "': behind @ stands the number of a key, counted from 0");
    key = number;
  }
  if (!parsed) throw InputError("The scene has no parameter '" + name + "'");
  const FitTarget target(parsed->address, parsed->point, key);
  const std::string why = whyNotFitted(project, plugins, target);
  if (!why.empty()) throw InputError(why);
  const api::ParameterDeclaration& declaration = *declarationOf(project, plugins, target.address);
  FitParameter parameter{target, declaration.minimum, declaration.maximum};
  if (equals == std::string::npos) return parameter;
  const std::string range = text.substr(equals + 1);
  const size_t dots = range.find("..");
  if (dots == std::string::npos) throw InputError("'" + text + "': write ADDRESS=LEAST..MOST");
  parameter.minimum = parsedNumber(range.substr(0, dots), text);
  parameter.maximum = parsedNumber(range.substr(dots + 2), text);
  if (!(parameter.minimum < parameter.maximum)) throw InputError("'" + text + "': the range is empty");
  for (const double end : {parameter.minimum, parameter.maximum}) {
    const std::string problem = problemOf(Value(end), declaration);
    if (!problem.empty()) throw InputError("'" + text + "': " + declaration.label + " " + problem);
  }
  return parameter;
}

std::string whyNotFitted(const Project& project, const PluginRegistry* plugins, const FitTarget& target) {
  const api::ParameterDeclaration* declaration = declarationOf(project, plugins, target.address);
  if (!declaration || !hasOwner(project, target.address))
    return "The scene has no parameter '" + target.address.text() + "'";
  const std::string label = declaration->label;
  const Track* track = findTrack(project.tracks, target.trackText());
  if (target.key && !(track && *target.key < track->keys.size()))
    return label + " has no key " + std::to_string(*target.key);
  if (!target.key && (track || findTrack(project.tracks, target.address.text())))
    return label + " follows its keys; choose one of them, as in '" + target.trackText() + "@0'";
  if (declaration->kind == api::ParameterKind::Choice || declaration->kind == api::ParameterKind::Toggle)
    return label + " is no number";
  if (project.state && declaration->actsAt != api::ActsAt::NextFrame)
    return label + " acts at the start, and the runs would begin at the scene's state";
  if (target.key) return {};
  const Value value = valueAt(project, plugins, target.address);
  const auto* response = std::get_if<Response>(&value);
  const bool isCurve = response && response->kind == Response::Kind::Curve;
  if (target.point && (!isCurve || *target.point >= response->points.size()))
    return label + " has no point " + std::to_string(*target.point);
  if (!target.point && response && response->kind != Response::Kind::Constant)
    return label + " is a curve; choose one of its points, as in '" + target.address.text() + "[0]'";
  return {};
}

Value valueWithNumber(const Project& project, const PluginRegistry* plugins, const FitTarget& target, double number) {
  const Value value = valueOfKey(number, *declarationOf(project, plugins, target.address));
  if (!target.point) return value;
  auto curve = std::get<Response>(valueAt(project, plugins, target.address));
  curve.points[*target.point].y = responseOf(value).constant;
  return curve;
}

double numberAt(const Project& project, const PluginRegistry* plugins, const FitTarget& target) {
  if (target.key) return findTrack(project.tracks, target.trackText())->keys[*target.key].value;
  const Value value = valueAt(project, plugins, target.address);
  return target.point ? std::get<Response>(value).points[*target.point].y : responseOf(value).constant;
}

Project withValues(Project project, const PluginRegistry& plugins, const FitTask& task,
                   const std::vector<double>& values) {
  Touched touched;
  std::vector<UndoEdit> undo;
  for (size_t k = 0; k < values.size(); ++k) {
    const FitTarget& target = task.parameters[k].target;
    if (target.key) {
      const auto of = [&](const Track& track) { return track.parameter == target.trackText(); };
      std::find_if(project.tracks.begin(), project.tracks.end(), of)->keys[*target.key].value = values[k];
      continue;
    }
    writeValue(project, plugins, {target.address, valueWithNumber(project, &plugins, target, values[k])}, touched,
               undo);
  }
  return project;
}

FitResult fitToCurve(const Project& project, PluginRegistry& plugins, const FitTask& task, const StopTest& stop,
                     const FitVisitor& each) {
  return Fit(project, plugins, task, stop, each).run();
}

}  // namespace ps
