// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

class Session;

/// Whether the scene is made of an installed material, or a frame of its run or of an earlier one that is kept: those
/// can be made again, to the bit, only as long as that material stays as it is.
bool runIsMadeOf(Session& session, const std::string& base);

}  // namespace ps
