// SPDX-License-Identifier: MIT
#include "lamp.h"

#include <cmath>

namespace {

using namespace ps::api;

constexpr double kIntensity = 1000;  // W/m2
constexpr double kRadius = 0.1;      // m

constexpr ParameterDeclaration kParameters[] = {
    {"intensity", "Intensity", "I", "W/m²", ParameterKind::Number, Scale::Linear, kIntensity, 0, 1e5, 0, 1e9, "kW/m²",
     1e-3, 0, "", "Lamp", "Power that the beam brings to each square metre, all of it absorbed.",
     "sun 1 kW/m², grill 20 kW/m², cutting laser 10⁷ kW/m²", ""},
    actingWhen("intensity > 0", {"radius", "Radius of the beam", "r", "m", ParameterKind::Number, Scale::Linear,
                                 kRadius, 0.01, 1, 0, 100, "cm", 100, 0, "", "Lamp",
                                 "The beam is round and stands over the origin.", "torch 2 cm, grill 20 cm", ""})};

// What the host keeps for each particle and shows: choose it under Colour, or probe its mean.
constexpr FieldDeclaration kFields[] = {
    {"org.example.lamp.light", "W", "Light that the particle takes up", FieldType::Float32, "Light taken up"}};

double parameter(const ThermalContext& context, size_t index, double fallback) {
  return index < context.parameters.size ? context.parameters[index] : fallback;
}

}  // namespace

Lamp::Lamp()
    : Described({"Lamp",
                 "A round beam that shines straight down over the origin. Particles that nothing above shades take up "
                 "what falls on their share of the surface. It knows no reflection, and light that a clear liquid lets "
                 "through is absorbed at its surface.",
                 listOf(kParameters)}) {}

List<FieldDeclaration> Lamp::fields() const { return listOf(kFields); }

void Lamp::addWatts(const ThermalContext& context, const ParticleView& particles, size_t first, size_t last,
                    double* watts) const {
  const double intensity = parameter(context, 0, kIntensity), radius = parameter(context, 1, kRadius);
  auto* light = static_cast<float*>(particles.fields->write(kFields[0].name, kFields[0].type));
  for (size_t i = first; i < last; ++i) {
    if (light) light[i] = 0;
    const Float4& x = particles.position[i];
    const double dx = x.x, dz = x.z, edge = std::cbrt(double{x.w});  // of the particle's cell, m
    if (dx * dx + dz * dz > radius * radius) continue;
    bool lit = true;  // an example: every particle asks every other
    for (size_t j = 0; j < particles.count && lit; ++j) {
      const Float4& y = particles.position[j];
      const double sideX = double{y.x} - dx, sideZ = double{y.z} - dz;
      lit = !(double{y.y} > double{x.y} + 0.5 * edge && sideX * sideX + sideZ * sideZ < 0.25 * edge * edge);
    }
    if (!lit) continue;
    watts[i] += intensity * edge * edge;
    if (light) light[i] = static_cast<float>(intensity * edge * edge);
  }
}
