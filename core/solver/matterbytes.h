// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/matter.h"

#include <cstddef>

namespace ps {

// Bytes that matter takes where undo keeps it, within a tenth.
size_t bytesOf(const ExtractedMatter& matter);
size_t bytesOf(const TieChange& change);
size_t bytesOf(const PaintedMatter& matter);

}  // namespace ps
