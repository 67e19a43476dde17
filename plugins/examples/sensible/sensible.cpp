// SPDX-License-Identifier: MIT
#include "sensible.h"

#include <stdexcept>

namespace {

using namespace ps::api;

constexpr FieldDeclaration kFields[] = {
    {"org.example.sensible.temperature", "K", "Temperature, from which all else follows", FieldType::Float64}};

double* stateOf(const ParticleView& particles) {
  auto* field = static_cast<double*>(particles.fields->write(kFields[0].name, kFields[0].type));
  if (!field) throw std::runtime_error("the particles lack the field 'org.example.sensible.temperature'");
  return field;
}

const Caloric& caloricOf(const ThermalContext& context, const ParticleView& particles, size_t i) {
  return context.materials[particles.material[i]]->caloric();
}

}  // namespace

Sensible::Sensible()
    : Described({"Sensible heat only",
                 "Heat changes the temperature and nothing else: one heat capacity per material (the liquid's) and no "
                 "latent heat, so matter melts and boils the moment it reaches the point. Energy is kept to rounding. "
                 "For seeing what latent heat does, by its absence.",
                 {}}) {}

List<FieldDeclaration> Sensible::fields() const noexcept { return listOf(kFields); }

void Sensible::initialise(const ThermalContext&, const ParticleView& particles, size_t first, size_t last,
                          const double* temperature, const Phase*) const {
  double* state = stateOf(particles);
  for (size_t i = first; i < last; ++i) state[i] = temperature[i];
}

void Sensible::addHeat(const ThermalContext& context, const ParticleView& particles, size_t first, size_t last,
                       const double* joules, double) const {
  double* state = stateOf(particles);
  for (size_t i = first; i < last; ++i) {
    const double capacity = caloricOf(context, particles, i).heatCapacityLiquid * double{particles.mass[i]};
    if (capacity > 0) state[i] += joules[i] / capacity;
  }
}

void Sensible::derive(const ThermalContext& context, const ParticleView& particles, size_t first, size_t last,
                      const ThermalOutput& output) const {
  const double* state = stateOf(particles);
  for (size_t i = first; i < last; ++i) {
    const Caloric& c = caloricOf(context, particles, i);
    const bool solid = (c.melts || c.sublimes) && state[i] < c.meltingPoint;
    const bool gas = !solid && state[i] >= (c.sublimes ? c.meltingPoint : c.boilingPoint);
    output.temperature[i] = state[i];
    output.solidFraction[i] = solid ? 1.0f : 0.0f;
    output.gasFraction[i] = gas ? 1.0f : 0.0f;
    output.liquidFraction[i] = solid || gas ? 0.0f : 1.0f;
  }
}

void Sensible::energy(const ThermalContext& context, const ParticleView& particles, size_t first, size_t last,
                      double* joules) const {
  const double* state = stateOf(particles);
  for (size_t i = first; i < last; ++i) {
    const Caloric& c = caloricOf(context, particles, i);
    joules[i] = c.heatCapacityLiquid * double{particles.mass[i]} * (state[i] - c.meltingPoint0);
  }
}
