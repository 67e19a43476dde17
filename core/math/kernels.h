// SPDX-License-Identifier: Apache-2.0
#pragma once

// SPH kernels in support form, 3D, normalised to 1; W(r) = 0 for r >= R (Monaghan 2005; Dehnen & Aly 2012).
namespace ps {

enum class KernelShape { CubicSpline, WendlandC2 };

/// w'(q)/q <= 0 of the kernel without its norm, q = r/R: W = 8/(pi R^3) w for the cubic spline, 21/(2 pi R^3) w for
/// Wendland's. Finite at q = 0; 0 from q = 1 on.
double slopeOverQ(KernelShape shape, double q);

/// W(r) in 1/m3 and F(r) = (1/r) dW/dr <= 0 in 1/m5, so that grad_i W_ij = F_ij x_ij. Finite at r = 0 except that
/// F of the cubic spline tends to a constant times -1/R^5 as r -> 0.
class Kernel {
 public:
  Kernel(KernelShape shape, double supportRadius);
  double value(double r) const;     ///< W, 1/m3
  double gradient(double r) const;  ///< F, 1/m5
  double supportRadius() const { return m_radius; }
  KernelShape shape() const { return m_shape; }

 private:
  KernelShape m_shape;
  double m_radius, m_scale;
};

}  // namespace ps
