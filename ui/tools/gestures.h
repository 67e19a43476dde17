// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/viewtool.h"

#include <vector>

namespace ps {

/// Something that mouse and keys do in the view itself, beside the window's actions.
struct Gesture {
  QString keys;  ///< "Shift+Drag"
  QString does;  ///< "Move the view sideways"
  QString hint;  ///< a word or two for the strip of hints; "": not there
};
/// Of a tool, the most used first.
std::vector<Gesture> gesturesOf(ViewTool tool);

}  // namespace ps
