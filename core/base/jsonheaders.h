// SPDX-License-Identifier: Apache-2.0
#pragma once

// Precompiled for the rooms that read and write JSON; a unit still names what it includes.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>
