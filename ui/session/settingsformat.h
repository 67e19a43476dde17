// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// From now on QSettings are kept in a file of our own format, with what stood in the system's one until then. That one
/// ends empty, with nobody told, where the disk has no room for it; of ours the old file stays. Call it once, when the
/// application has its name.
void keepSettingsWhole();

}  // namespace ps
