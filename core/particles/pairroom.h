// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/room.h"

#include <cstdint>

namespace ps {

/// Arrays by slot of the neighbour lists, for a copy of them that keeps some of their entries and a number with each.
/// They are the largest there are, and stages that need them do so one after the other: these are lent.
struct PairRoom {
  RoomVector<uint32_t> partner;
  RoomVector<float> value;
};

}  // namespace ps
