// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/caseprofile.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ps {

/// One number of a column of a run's table.
struct ColumnNumber {
  std::string column, minus;  ///< titles; `minus` is taken off it frame by frame, "" for none
  std::string measure;        ///< see measureNames()
  nlohmann::json options;     ///< of the measure
  bool thermalClock = false;  ///< times are those of heat, thermal_time_scale as many
};

/// One number that a case must show.
struct CaseCheck {
  std::string what;  ///< "period", for people
  std::string run;   ///< CaseRun::name, of the only run to judge; "" for each
  ColumnNumber number;
  std::optional<ColumnNumber> less;          ///< taken off the number
  double times = 1, plus = 0;                ///< what is judged: the measured number times one, plus the other
  std::string function;                      ///< instead of a run: see valueOfFunction()
  std::vector<double> arguments;             ///< of the function
  ProfileCheck profile;                      ///< instead of a column: temperatures of all particles at the end
  std::string material, property;            ///< instead of a column: a property of a material of the scene, or else
                                             ///< of an installed one
  std::string equilibrium;                   ///< likewise, of its phase diagram: see equilibriumNames()
  double temperature = 293.15;               ///< K, of both
  double pressure = 101325;                  ///< Pa, of both
  bool spread = false;                       ///< across all runs: largest over smallest, less 1
  std::vector<double> expected;              ///< one for all runs, or one for each; none for a bound alone
  std::optional<double> relative, absolute;  ///< tolerances
  std::optional<double> atLeast, atMost;     ///< bounds
  /// Limits of the run that have to do with a miss, by name, owner or key: "steel.youngs_modulus", "steel",
  /// "youngs_modulus". None: all of them.
  std::vector<std::string> limits;
};

/// Changes of a project, as --set takes them.
using ProjectEdits = std::vector<std::string>;

struct CaseRun {
  std::string name;  ///< "5 iterations"; "" for the only one
  ProjectEdits edits;
  long frames = 0;
};

/// An experiment: a project, numbers for it, and what theory says about the outcome.
struct Case {
  std::string id, why, project;  ///< `project`: path; "" where no run is needed
  ProjectEdits edits;
  std::vector<CaseRun> runs;  ///< at least one
  std::vector<CaseCheck> checks;
};

/// Reads {"cases": [...]}; paths of projects are relative to the file's folder. Throws InputError with
/// "file:/json/pointer: what is wrong".
std::vector<Case> readCases(const std::string& path);

}  // namespace ps
