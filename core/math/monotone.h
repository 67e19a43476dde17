// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

// A monotone cubic through points, piece by piece: slopes that lie in the region of monotonicity of Fritsch & Carlson
// 1980, and the Hermite polynomial between two points. Plain arithmetic, so that all machines agree on every bit.
namespace ps {

/// Slope at an inner point between pieces of lengths h0, h1 with secants d0, d1: zero at a local extremum, else the
/// weighted harmonic mean of the two (Fritsch & Butland 1984).
inline double innerSlope(double h0, double h1, double d0, double d1) {
  if (d0 * d1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / d0 + w1 / d1);
}

/// One-sided slope at the end of a curve from its two outer secants, h0 and d0 of the outermost, kept monotone
/// (three-point formula of Fritsch & Butland 1984).
inline double endSlope(double h0, double h1, double d0, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}

/// The cubic from y0 to y1 at a share t of the piece; m0 and m1 are the slopes times the piece's length.
inline double hermite(double t, double y0, double m0, double y1, double m1) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * y0 + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * y1 + (t3 - t2) * m1;
}

}  // namespace ps
