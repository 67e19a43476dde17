// SPDX-License-Identifier: Apache-2.0
#include "app/editor/displayproblem.h"

#include <X11/Xlib.h>
#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace ps {
namespace {

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

bool isReached() {
  Display* display = XOpenDisplay(nullptr);
  if (display) XCloseDisplay(display);
  return display;
}

}  // namespace

std::string displayProblem(int argc, char** argv) {
  const bool isAsked = std::any_of(argv + 1, argv + argc, [](std::string_view argument) {
    return argument == "-platform" || argument == "--platform" || argument == "-display" || argument == "--display";
  });
  if (isAsked || isSet("QT_QPA_PLATFORM") || isSet("WAYLAND_DISPLAY")) return {};
  constexpr const char* kInstead = "start it in a desktop session; phasesketch-cli needs no display";
  if (!isSet("DISPLAY")) return std::string("there is no display (DISPLAY is not set): ") + kInstead;
  if (isReached()) return {};
  return std::string("the display ") + std::getenv("DISPLAY") + " cannot be reached: " + kInstead;
}

}  // namespace ps
