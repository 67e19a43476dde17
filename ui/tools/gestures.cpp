// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/gestures.h"

namespace ps {
namespace {

Gesture gesture(const char* keys, const char* does, const char* hint = "") {
  return {QString::fromUtf8(keys), QString::fromUtf8(does), QString::fromUtf8(hint)};
}

}  // namespace

std::vector<Gesture> gesturesOf(ViewTool tool) {
  std::vector<Gesture> list;
  if (tool == ViewTool::Select) {
    list = {gesture("Drag", "Turn the view", "orbit"),
            gesture("Shift+Drag", "Move the view sideways; the middle button does too", "pan"),
            gesture("Wheel", "Nearer to what is under the pointer, or farther", "zoom"),
            gesture("Click", "Select the body, tap or drain, and tell the temperature"),
            gesture("Drag a tap or drain", "Move it; with Shift up and down; its knobs turn or stretch it"),
            gesture("Right button", "The view's menu")};
  } else if (places(tool)) {
    const bool tap = tool == ViewTool::Tap;
    list = {tap ? gesture("Click", "A tap that pours away from the surface, or down from the air", "tap on the surface")
                : gesture("Click", "A drain that stands on the surface", "drain on the surface"),
            tap ? gesture("Drag up", "A tap above the surface that pours down", "above it")
                : gesture("Drag", "A wider drain", "wider"),
            gesture("Alt+Drag", "Turn the view; the middle button does too", "orbit"),
            gesture("Shift+Middle button", "Move the view sideways"),
            gesture("Wheel", "Nearer to what is under the pointer, or farther")};
  } else {
    const bool draws = tool == ViewTool::Brush;
    list = {draws ? gesture("Drag", "Draw", "draws") : gesture("Drag", "Erase", "erases"),
            draws ? gesture("Ctrl+Drag", "Erase", "erases") : gesture("Ctrl+Drag", "Draw", "draws"),
            gesture("Alt+Drag", "Turn the view; the middle button does too", "orbit"),
            gesture("Shift+Middle button", "Move the view sideways"),
            gesture("Wheel", "Nearer to what is under the pointer, or farther")};
  }
  list.push_back(gesture("Right-drag", "Nearer or farther"));
  list.push_back(gesture("Drag an end of the legend", "Set the range of colours; a double click fits it again"));
  list.push_back(gesture("Esc", tool == ViewTool::Select ? "Take back what is being dragged"
                                                         : "Give up the drag or stroke, then back to selecting"));
  list.push_back(gesture("Tab", "To sketching and back; Shift+Tab leaves the view"));
  return list;
}

}  // namespace ps
