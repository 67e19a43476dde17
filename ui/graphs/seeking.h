// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

class RecordedView;
class TimePlot;

/// A click in a plot shows the recorded frame of that time. A double-click fits, so one is waited for.
void seekByClicks(TimePlot& plot, RecordedView& recorded);

}  // namespace ps
