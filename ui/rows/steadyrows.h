// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>

class QScrollArea;

namespace ps {

/// Makes a change by which rows may grow or shrink, as a note does that comes or goes. The row under the pointer stays
/// where it is, as far as there is something to scroll.
void changeSteadily(QScrollArea& area, const std::function<void()>& change);

}  // namespace ps
