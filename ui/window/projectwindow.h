// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/window/dialogrow.h"

#include <vector>

namespace ps {

class MainWindow;

/// Opens what the project says of itself, its title and its description, to be edited; or brings it to the front. An
/// entry acts when it is left, as one step of undo.
/// `row`: the one that gets the focus.
void openProjectProperties(MainWindow& window, const QString& row = {});
std::vector<DialogRow> projectRows();

}  // namespace ps
