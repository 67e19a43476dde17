// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <vector>

class QScrollArea;

namespace ps {

class ParameterRow;

/// Makes a change by which rows may grow or shrink, as a note does that comes or goes. The row under the pointer stays
/// where it is, as far as there is something to scroll.
void changeSteadily(QScrollArea& area, const std::vector<ParameterRow*>& rows, const std::function<void()>& change);

}  // namespace ps
