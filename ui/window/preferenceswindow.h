// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

class MainWindow;

/// Opens what people prefer in all their projects, or brings it to the front. Each choice acts at once and stays.
void openPreferences(MainWindow& window);

}  // namespace ps
