// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

/// "" where there is a display to open a window on, else what is missing and what to do, one line: Qt would end the
/// program without a word of use. What was asked for by QT_QPA_PLATFORM, `-platform` or `-display` is Qt's to
/// judge.
std::string displayProblem(int argc, char** argv);

}  // namespace ps
