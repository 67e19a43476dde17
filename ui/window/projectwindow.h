// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

class MainWindow;

/// Opens what the project says of itself, its title and its description, to be edited; or brings it to the front. An
/// entry acts when it is left, as one step of undo.
void openProjectProperties(MainWindow& window);

}  // namespace ps
