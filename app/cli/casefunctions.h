// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace ps::cli {

/// Pure functions of the engine that a case may ask:
/// thesis_density_scale(f), thesis_gravity(f), thesis_stiffness(dT): see core/math
/// rayleigh_number(g, beta, dT, H, nu, alpha)
/// Throws InputError for an unknown name, or another number of arguments.
double valueOfFunction(const std::string& name, const std::vector<double>& arguments);

}  // namespace ps::cli
