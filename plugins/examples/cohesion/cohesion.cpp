// SPDX-License-Identifier: MIT
#include "cohesion.h"

namespace {

using namespace ps::api;

constexpr double kStrength = 0.5;  // m3/(kg s2)

constexpr ParameterDeclaration kParameters[] = {
    {"strength", "Cohesion", "κ", "m³/(kg·s²)", ParameterKind::Number, Scale::Linear, kStrength, 0, 2.5, 0, 100, "", 1,
     0, "", "Surface", "How strongly liquid pulls itself together; drops round themselves at larger values.",
     "0 wets everything, 0.5 beads, 2.5 rolls like mercury",
     "after Becker & Teschner 2007, equation 7, made symmetric in the two masses"}};

/// The kernel's shape (1 - q^2)^3, scaled so that its integral over space is 1; in 1/m3.
double kernel(double squaredDistance, double support) {
  constexpr double kScale = 315.0 / (64.0 * 3.14159265358979323846);
  const double t = 1 - squaredDistance / (support * support);
  return kScale / (support * support * support) * t * t * t;
}

}  // namespace

Cohesion::Cohesion()
    : Described({"Cohesion",
                 "Liquid particles pull at each other within the support radius with the force κ m_i m_j W(x_ij) x_ij, "
                 "which gives drops and skins at the scale of a few particles (after Becker & Teschner 2007). It is "
                 "equal and opposite for every pair, whatever their masses: momentum is kept to rounding. The strength "
                 "is no surface tension in N/m: it changes with the particle spacing.",
                 listOf(kParameters)}) {}

bool Cohesion::traits(NeighbourTraits* out) const noexcept { return fill(out, {}); }

void Cohesion::gather(const ConstraintContext& context, const ParticleView& particles, const NeighbourView& neighbours,
                      Span<const uint32_t> members, Float4* correction) const {
  if (context.iteration > 0) return;  // an acceleration, once per substep; corrections start at zero
  const double h = context.supportRadius;
  for (size_t k = 0; k < members.size; ++k) {
    const uint32_t i = members[k];
    if (particles.motion[i] != Motion::Liquid) continue;
    double x = 0, y = 0, z = 0;
    for (uint32_t q = neighbours.begin[i]; q < neighbours.last[i]; ++q) {
      const uint32_t j = neighbours.index[q];
      if (particles.motion[j] != Motion::Liquid) continue;
      const Float4 line = separation(particles, i, j);
      const double dx = line.x, dy = line.y, dz = line.z;
      const double squared = dx * dx + dy * dy + dz * dz;
      if (squared >= h * h) continue;  // the lists reach farther than the support
      const double weight = double{particles.mass[j]} * kernel(squared, h);
      x -= weight * dx;
      y -= weight * dy;
      z -= weight * dz;
    }
    const Span<const double> parameters = context.parametersOf(particles.body[i]);
    const double strength = parameters.size > 0 ? parameters[0] : kStrength;
    const double scale = strength * context.dt * context.dt;  // force / m_i, times dt squared
    correction[k] = {static_cast<float>(scale * x), static_cast<float>(scale * y), static_cast<float>(scale * z), 0};
  }
}
