// SPDX-License-Identifier: Apache-2.0
#include "core/math/kernels.h"

#include <numbers>

namespace ps {

double slopeOverQ(KernelShape shape, double q) {
  if (q >= 1) return 0;
  const double a = 1 - q;
  if (shape == KernelShape::WendlandC2) return -20 * a * a * a;
  return q <= 0.5 ? 18 * q - 12 : -6 * a * a / q;
}

Kernel::Kernel(KernelShape shape, double supportRadius) : m_shape(shape), m_radius(supportRadius) {
  const double volume = std::numbers::pi * supportRadius * supportRadius * supportRadius;
  m_scale = (shape == KernelShape::CubicSpline ? 8.0 : 10.5) / volume;
}

double Kernel::value(double r) const {
  const double q = r / m_radius;
  if (q >= 1) return 0;
  const double a = 1 - q;
  if (m_shape == KernelShape::WendlandC2) return m_scale * a * a * a * a * (1 + 4 * q);
  if (q <= 0.5) return m_scale * (6 * q * q * (q - 1) + 1);
  return m_scale * 2 * a * a * a;
}

double Kernel::gradient(double r) const { return m_scale / (m_radius * m_radius) * slopeOverQ(m_shape, r / m_radius); }

}  // namespace ps
