// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QElapsedTimer>

namespace ps {

/// ms, in which who gives up long work is answered: 200 are asked, and the rest is left to what else the machine does.
/// The work itself takes longer.
inline constexpr int kAnswered = 1000;

}  // namespace ps
