// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/commandpalette.h"

namespace ps {

class MainWindow;

/// What only menus by a right-click offer: those of graphs, of runs, of markers and of the strokes that are listed.
/// `show` brings the page of a title in sight.
void addContextMenus(std::vector<PaletteEntry>& entries, MainWindow& window,
                     const std::function<void(const QString& page)>& show);

}  // namespace ps
