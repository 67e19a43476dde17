// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/curvefit.h"

#include <string>

namespace ps {

/// A wanted curve from a CSV file (RFC 4180): a row with the titles time_s and one of columnTitles(), and a row for
/// each point, ascending in time; rows with an empty value are left out. What `simulate --probes` wrote can be cut down
/// to it. Throws InputError "file:line: what is wrong".
FitTask readWanted(const std::string& path);

}  // namespace ps
