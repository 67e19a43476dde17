// SPDX-License-Identifier: Apache-2.0
#include "thesisdiffusionmodel.h"

#include <algorithm>
#include <cmath>

namespace ps::thermal {
namespace {

constexpr double kPi = 3.14159265358979323846;

constexpr api::ParameterDeclaration kParameters[] = {
    {"diffusivity", "Diffusivity of everything", "ϕ", "m²/s", api::ParameterKind::Number, api::Scale::Logarithmic, 1e-6,
     1e-8, 3e-4, 0, 1, "mm²/s", 1e6, 0, "", "Heat",
     "How fast differences of temperature even out, the same in all matter whatever its conductivity. A difference "
     "crosses a length L in about L²/ϕ.",
     "water 0.14, ice 1.1, iron 23, copper 117 mm²/s", "Thesis 2020, table 4.3; Brookshaw 1985"},
};

/// -2 (1/r) dW/dr of the cubic spline with support R, 1/m5.
double slope(double square, double support) {
  const double r = std::sqrt(square), q = r / support;
  if (!(q < 1) || !(r > 0)) return 0;
  const double scale = 8 / (kPi * support * support * support * support * r);
  return 2 * scale * (q <= 0.5 ? 12 * q - 18 * q * q : 6 * (1 - q) * (1 - q));
}

struct Matter {
  double volume, capacity, least;  ///< m3; J/(m3 K), J/K of the phase that warms most easily
};

Matter matterOf(const api::ThermalContext& context, const api::ParticleView& p, size_t i) {
  const api::Caloric& c = context.materials[p.material[i]]->caloric();
  const double s = p.solidFraction[i], l = p.liquidFraction[i], g = p.gasFraction[i];
  const double mass = p.mass[i], volume = p.position[i].w;
  double least = 1e30;
  if (s > 0) least = c.heatCapacitySolid;
  if (l > 0) least = std::min(least, c.heatCapacityLiquid);
  if (g > 0) least = std::min(least, c.heatCapacityGas);
  const double capacity = s * c.heatCapacitySolid + l * c.heatCapacityLiquid + g * c.heatCapacityGas;
  return {volume, volume > 0 ? mass * capacity / volume : 0, mass * least};
}

/// W/K between two particles; the same bits from either side.
double conductance(const Matter& a, const Matter& b, double square, double support) {
  const double sum = a.capacity + b.capacity;
  if (!(sum > 0)) return 0;
  return (2 * (a.capacity * b.capacity) / sum) * (a.volume * b.volume) * slope(square, support);
}

double squareOf(const api::ParticleView& p, size_t i, size_t j) {
  const api::Float4 d = api::separation(p, i, j);
  return double{d.x} * d.x + double{d.y} * d.y + double{d.z} * d.z;
}

}  // namespace

ThesisDiffusionModel::ThesisDiffusionModel()
    : EnthalpyModel(
          {"Thesis diffusion",
           "The explicit heat model of the thesis: temperatures even out with one diffusivity for all matter, and the "
           "conductivities of materials play no part inside it. What flows between two particles is the same for both, "
           "so no energy is lost; melting and boiling are those of the enthalpy model. For comparison: iron and wax "
           "warm through equally fast. Walls and air still go by the material's conductivity.",
           api::listOf(kParameters)}) {}

bool ThesisDiffusionModel::pairFlux(const api::ThermalContext& context, const api::ParticleView& particles,
                                    const api::NeighbourView& neighbours, size_t first, size_t last,
                                    double* watts) const {
  const double phi = context.parameters.size > 0 ? context.parameters[0] : kParameters[0].defaultValue;
  for (size_t i = first; i < last; ++i) {
    const Matter here = matterOf(context, particles, i);
    for (uint32_t k = neighbours.begin[i]; k < neighbours.last[i]; ++k) {
      const size_t j = neighbours.index[k];
      const double square = squareOf(particles, i, j);
      watts[k] = phi * conductance(here, matterOf(context, particles, j), square, context.supportRadius) *
                 (particles.temperature[j] - particles.temperature[i]);
    }
  }
  return true;
}

double ThesisDiffusionModel::fastestPairRate(const api::ThermalContext& context, const api::ParticleView& particles,
                                             const api::NeighbourView& neighbours, size_t first, size_t last) const {
  const double phi = context.parameters.size > 0 ? context.parameters[0] : kParameters[0].defaultValue;
  double fastest = 0;
  for (size_t i = first; i < last; ++i) {
    const Matter here = matterOf(context, particles, i);
    double sum = 0;
    for (uint32_t k = neighbours.begin[i]; k < neighbours.last[i]; ++k) {
      const size_t j = neighbours.index[k];
      sum += conductance(here, matterOf(context, particles, j), squareOf(particles, i, j), context.supportRadius);
    }
    if (here.least > 0) fastest = std::max(fastest, phi * sum / here.least);
  }
  return fastest;
}

}  // namespace ps::thermal
