// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/commandpalette.h"

namespace ps {

class Actions;
class Session;
class Selection;
struct Address;

/// Everything that Ctrl+K finds now: actions, parameters with their values, materials that could be added. `reveal`
/// jumps to a parameter's row.
std::vector<PaletteEntry> paletteEntries(Session& session, Selection& selection, const Actions& actions,
                                         const std::function<void(const Address&)>& reveal);

}  // namespace ps
