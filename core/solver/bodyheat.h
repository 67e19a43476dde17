// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// Heat that a body is given, and what those of its particles do that are held in place.
struct BodyHeat {
  double watts = 0;  ///< W of thermal time that come up inside it
  double held = 0;   ///< K that its fixed particles keep, whatever touches them; 0: they warm and cool
  /// W/(m2 K), of a fluid behind the surface of its fixed particles that has the temperature `held`; 0: they have it
  /// themselves.
  double convection = 0;
  bool insulated = false;  ///< its fixed particles conduct nothing, and give nothing to walls and air; they do radiate
};

}  // namespace ps
