// SPDX-License-Identifier: Apache-2.0
// When a mixture melts and boils, and with what heat. Private to this room.
#pragma once
#include "core/matter/material.h"

#include <map>
#include <string>
#include <utility>

namespace ps {

/// The second part's share of the moles; that of the mass where a molar mass is unknown.
double moleShare(const Material& first, const Material& second, double massShare);

/// K, in which both have anything to say: from half the lowest melting point to past the highest boiling point.
std::pair<double, double> temperaturesOf(const Material& first, const Material& second);

/// Properties about changes of phase, by key, for a share by mass between 0 and 1.
///
///   solidus   Σ x_i exp(-λ_i) = 1,  liquidus  Σ x_i exp(λ_i) = 1,  λ_i = (L_i M_i / R) (1/T - 1/T_i)
///   boiling   Σ x_i p_i(T) = 101325 Pa, with the parts' boiling lines p_i (see PhaseDiagram)
///   latent    L = Σ w_i (L_i + Δc_i (T - T_i)),  Δc the heat capacity after the change less that before
///
/// (Seltz 1934, J. Am. Chem. Soc. 56, 307; Raoult's and Kirchhoff's laws.) The mixture melts and boils at what is left
/// of the one part where the other never does; with so little of what boils that this lay beyond its critical point, or
/// beyond 3/2 of its boiling point where none is known (Guldberg 1890), it never boils.
std::map<std::string, double> mixedPhases(const Material& first, const Material& second, double massShare);

}  // namespace ps
