// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <limits>
#include <string>

namespace ps {

/// What there is of memory for this program, in bytes. What cannot be found out is endless.
struct Memory {
  double free = std::numeric_limits<double>::infinity();  ///< that it may still take without harm to others
  double own = 0;                                         ///< that it has taken
};

/// Reads what Linux tells of itself: what is available without swapping, the limits of the program's control groups
/// (both versions) less what they use and could not give back, and the limit of the program's address space. Some tens
/// of microseconds. `root` stands before the paths of the files that are read.
Memory memoryNow(const std::string& root = {});

/// "55 GB", "870 MB": two digits of a number of bytes.
std::string memoryText(double bytes);

}  // namespace ps
