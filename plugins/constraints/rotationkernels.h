// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rotation.h"

namespace ps::constraint {

/// rotationOf() for `count` matrices, one in each lane (Highway): q[k] becomes what rotationOf(a[k], q[k], exact)
/// gives, to the last bit.
void findRotations(const Matrix* a, Quaternion* q, size_t count, double exact);

}  // namespace ps::constraint
