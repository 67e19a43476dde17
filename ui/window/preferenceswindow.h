// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/dialogrow.h"

#include <vector>

namespace ps {

class MainWindow;

/// Opens what people prefer in all their projects, or brings it to the front. Each choice acts at once and stays.
/// `row`: the one that gets the focus.
void openPreferences(MainWindow& window, const QString& row = {});
std::vector<DialogRow> preferenceRows();

}  // namespace ps
