// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QElapsedTimer>

namespace ps {

inline constexpr int kAnswered = 200;  // ms, in which who gives up long work is answered

}  // namespace ps
