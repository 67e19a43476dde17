// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"

#include <string>
#include <vector>

namespace ps {

/// Pure functions of the engine that a case may ask:
/// thesis_density_scale(f), thesis_gravity(f), thesis_stiffness(dT): see core/math
/// rayleigh_number(g, beta, dT, H, nu, alpha)
/// Throws InputError for an unknown name, or another number of arguments.
double valueOfFunction(const std::string& name, const std::vector<double>& arguments);

/// What the phase diagram of a material says at a pressure in Pa:
/// boiling_point, melting_point, sublimation_point  K
/// latent_heat_boiling                              J/kg at the boiling point of this pressure
/// phase                                            at a temperature in K: 0 solid, 1 liquid, 2 vapour; a half between
///                                                  two within a melting range and on a line between them
std::vector<std::string> equilibriumNames();
double equilibriumOf(const Material& material, const std::string& name, double pressure, double temperature);

}  // namespace ps
