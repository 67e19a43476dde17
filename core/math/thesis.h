// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

// Two curves of the 2020 thesis (its equations 4.9 and 4.10) over the share of the latent heat of boiling that matter
// holds, kept for comparison. Both count latent heat in kJ/kg of water, whatever the matter: L = 2257.

/// Share of the liquid's density, from 0.9975 of boiling liquid to 0.0025 of vapour:
/// 1 - 1/(1 + (1 + 12/L)^(L/2 - f L)). Within 6e-4 it is the logistic curve 1/(1 + exp(-6 (1 - 2 f))).
double thesisDensityScale(double gasFraction);
/// Acceleration upwards in m/s²: 10.8/ln((L + 0.02)/0.02) ln((L + 0.02)/(L + 0.02 - f L)) - 9.8, from -9.8 of the
/// liquid to +1 of vapour; it changes its sign at f = 0.99998.
double thesisGravity(double gasFraction);

}  // namespace ps
