// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

namespace ps {

struct Ray {
  Vector3 origin{0, 0, 0};      ///< m
  Vector3 direction{0, 0, -1};  ///< any length but zero
};

}  // namespace ps
