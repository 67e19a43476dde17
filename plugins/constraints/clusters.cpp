// SPDX-License-Identifier: Apache-2.0
#include "clusters.h"
