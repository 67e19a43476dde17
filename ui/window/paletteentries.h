// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/commandpalette.h"

namespace ps {

class Actions;
class MainWindow;

/// Everything that Ctrl+K finds now: actions, parameters with their values, things of the scene, materials and presets
/// that could be added, projects of late, rows of the brush, of the preferences and of what the project says of itself,
/// what buttons of pages do, and menus of graphs, runs, strokes and markers.
std::vector<PaletteEntry> paletteEntries(MainWindow& window, const Actions& actions);

}  // namespace ps
