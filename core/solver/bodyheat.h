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
  double flux = 0;         ///< W/m2 that its fixed particles, insulated then, give to what touches their surface
  double area = 0;         ///< m2 of that surface; 0: as they show it
  bool oneLayer = false;   ///< they are a surface of one particle's thickness; `area` is that of one side
};

}  // namespace ps
