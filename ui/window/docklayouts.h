// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// A column of the layout table: pixels of docks in windows of at least a width.
struct DockColumn {
  int from;
  bool joined;  ///< outliner and materials are pages of one dock
  int left, right, outliner, materials, graphs, curve, curveGraphs, points;
};
const DockColumn& dockColumn(int width);  ///< of a window so wide, in pixels

}  // namespace ps
