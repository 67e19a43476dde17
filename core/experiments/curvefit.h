// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/casemeasure.h"
#include "core/experiments/run.h"
#include "core/scene/track.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// Draw the result: how a quantity shall go is given, and what parameters make it go so is found by runs.
namespace ps {

class PluginRegistry;

/// A number that may be changed: a parameter, a point of its curve, or the value of one of the keys of either.
struct FitTarget : TrackTarget {
  FitTarget(Address of, std::optional<size_t> itsPoint = {}, std::optional<size_t> itsKey = {})
      : TrackTarget{std::move(of), itsPoint}, key(itsKey) {}
  std::optional<size_t> key;  ///< its place in the track, counted from 0
  bool operator==(const FitTarget& other) const {
    return address == other.address && point == other.point && key == other.key;
  }
  std::string trackText() const;  ///< without the key: Track::parameter
  std::string text() const;       ///< "wall/floor/temperature", "material/wax/viscosity[2]", "wall/floor/temperature@1"
};

struct FitParameter {
  FitTarget target;
  double minimum = 0, maximum = 0;  ///< its unit; between these it is looked for

  std::string text() const { return target.text(); }
  /// "wall/floor/temperature=300..900", or without a range: that of its slider. Throws InputError.
  static FitParameter parse(const std::string& text, const Project& project, const PluginRegistry* plugins);
};

struct FitTask {
  std::string column;  ///< one of columnTitles()
  Series wanted;       ///< at s since the scene's start, ascending; each point counts as much as another
  std::vector<FitParameter> parameters;
  int mostRuns = 60;
};

/// One run that was tried.
struct FitTrial {
  int run = 0;                 ///< from 1 on; the first is the project as it is
  std::vector<double> values;  ///< in the order of the parameters
  /// In the column's unit, root mean square over the wanted points. One at which a run has no value (it broke off, was
  /// refused, the probe saw nothing) counts as missed by all that the wanted curve spans.
  double error = 0;
  size_t missing = 0;   ///< of those points
  bool isBest = false;  ///< so far: none has fewer points missing, and of those none a smaller error
  Series course;        ///< the column, frame by frame
};
using FitVisitor = std::function<void(const FitTrial&)>;

struct FitResult {
  FitTrial before, after;  ///< the first run and the best one
  int runs = 0;            ///< 0: stopped in the first one
  bool stopped =
      false;  ///< before it was done: by the caller, or at the most runs; a run that it cut short is no trial
};

/// "" or why a parameter's number cannot be looked for, as a sentence.
std::string whyNotFitted(const Project& project, const PluginRegistry* plugins, const FitTarget& target);
/// What the parameter's whole value is with this number: of a point its curve with the point there. Not of a key.
Value valueWithNumber(const Project& project, const PluginRegistry* plugins, const FitTarget& target, double number);
/// The number that a project has now.
double numberAt(const Project& project, const PluginRegistry* plugins, const FitTarget& target);

/// The project with the values of one trial.
Project withValues(Project project, const PluginRegistry& plugins, const FitTask& task,
                   const std::vector<double>& values);

/// Looks for the values with which a project's run comes closest to the wanted points, from its start or from the state
/// that it holds, each run as long as they reach. First the range is looked over, coarsely and evenly; from the best of
/// what was found a quadratic model is followed down (BOBYQA, Powell, Cambridge NA2009/06, as NLopt has it), until
/// values move by less than 1/3000 of their range. The same task takes the same way. It finds a minimum, not surely the
/// least of all. `stop` is asked after each frame, and from several threads while a scene is made. Throws InputError
/// for a task that means nothing here.
FitResult fitToCurve(const Project& project, PluginRegistry& plugins, const FitTask& task, const StopTest& stop,
                     const FitVisitor& each);

}  // namespace ps
