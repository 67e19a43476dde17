// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace ps {

/// A quantity over time, as a run's probes gave it.
struct Series {
  std::vector<double> time, value;  ///< s, unit of the quantity
};

/// Names of the ways to make one number of a series, with what each of them needs:
/// last, first, minimum, maximum   of all frames
/// change                          last less first
/// mean {from, to}                 over a span of time; without them over all
/// at {time}                       between two frames on a straight line, as all that follow
/// when {value}                    time in s at which it first passes a value
/// slope {from, to}                between the times at which it first passes two values
/// fastest {frames}                largest change per second over that many frames
/// begins, ends, lasts {from, to}  a plateau on which the series first goes evenly from one value to the other (0 and
///                         1 without them, either way): the time at which the line through its first two frames, or
///                         its last two, meets that value; the time between. Frames at the two values do not count.
/// period {level, periods}         mean time between downward crossings, of the first few or of all
std::vector<std::string> measureNames();
/// One number. NaN where the series does not have it: a value that is never passed, a probe without particles.
double measureOf(const Series& series, const std::string& measure, const nlohmann::json& options);

}  // namespace ps
