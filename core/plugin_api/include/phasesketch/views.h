// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/types.h>

namespace ps::api {

/// Named fields of the particle store.
class FieldAccess {
 public:
  /// Base of the field, or nullptr when there is none of that name and type. Index it like every other array here.
  virtual const void* read(const char* name, FieldType type) const noexcept = 0;
  /// The same to write to, of a field that a plugin has declared; nullptr for the program's own.
  virtual void* write(const char* name, FieldType type) const noexcept = 0;

 protected:
  ~FieldAccess() = default;
};

/// The particle store as structure of arrays; all arrays have `count` entries (one dummy more where lists are padded).
/// Order is the host's and changes between calls: keep `id`, never an index.
struct ParticleView {
  size_t count;
  const Float4* position;  ///< x, y, z in m; w: rest volume in m3
  const Float4* previous;  ///< x, y, z in m at the start of the substep
  const Float4* velocity;  ///< x, y, z in m/s; w: inverse mass in 1/kg, 0 for what nothing can push, moving or not
  const float* mass;       ///< kg
  const uint32_t* id;      ///< stable for life
  const uint32_t* material;
  const uint32_t* body;
  const Phase* phase;
  const Motion* motion;
  const double* temperature;  ///< K
  const float* solidFraction;
  const float* liquidFraction;
  const float* gasFraction;
  const FieldAccess* fields;
  /// Edge lengths in m by which space repeats itself, 0 along an open axis. Positions may lie in any image of the box;
  /// measure between particles with separation(), unless they are tied, and so at home in one image.
  Double3 period;
};

/// Particles where a plugin may move them: those of its batch, and x, y, z alone. What it reads comes through the view
/// of the same particles, which shows at once what has been written.
struct MovableParticles {
  const ParticleView* view;
  Float4* position;  ///< x, y, z in m
  Float4* velocity;  ///< x, y, z in m/s
  operator const ParticleView&() const { return *view; }
};

/// From particle j to particle i, x, y, z in m, of the nearest images of the two; seen from the other side it is the
/// same to the last bit. Where space is open: position[i] - position[j].
inline Float4 separation(const ParticleView& particles, size_t i, size_t j) {
  const Float4 &a = particles.position[i], &b = particles.position[j];
  Float4 d{a.x - b.x, a.y - b.y, a.z - b.z, 0};
  const auto shorten = [](float& c, double period) {
    if (!(period > 0)) return;
    const float length = static_cast<float>(period);
    const float images = c / length;
    c -= length * static_cast<float>(static_cast<int64_t>(images + (images < 0 ? -0.5f : 0.5f)));
  };
  shorten(d.x, particles.period.x);
  shorten(d.y, particles.period.y);
  shorten(d.z, particles.period.z);
  return d;
}

/// Neighbours of particle i: index[begin[i]] .. index[last[i] - 1], without i itself, in an order that depends on
/// positions alone. Lists are padded to 16 entries, up to end[i], with the index `count` of a dummy far away.
/// Pairs, or their nearest images, lie within `searchRadius`, which exceeds the support: kernels must cut off
/// themselves.
struct NeighbourView {
  const uint32_t* begin;
  const uint32_t* last;
  const uint32_t* end;
  const uint32_t* index;
  float searchRadius;  ///< m
  size_t slots;        ///< entries of `index`, and of an array that has something to each
};

/// Caloric data of one material at the scene's pressure. Enthalpy is 0 for the solid at `meltingPoint0`
/// (Voller & Cross 1981; Kirchhoff latent heats, so that a change of pressure keeps the energy).
struct Caloric {
  double heatCapacitySolid, heatCapacityLiquid, heatCapacityGas;  ///< J/(kg K)
  double meltingPoint0;                                           ///< K at 101325 Pa
  double boilingPoint0;                                           ///< K at 101325 Pa
  double latentHeatFusion, latentHeatVaporization;                ///< J/kg at those points
  double solidus, liquidus;                                       ///< K; equal: a sharp melting point
  double meltingPoint;  ///< K at the scene's pressure; sublimation point where `sublimes`
  double boilingPoint;  ///< K at the scene's pressure; +infinity for what never boils
  uint8_t sublimes;     ///< 1: no liquid at this pressure
  uint8_t melts;        ///< 0: no melting point (glass, honey)
};

/// One material as hot loops see it: numbers and baked tables.
class MaterialView {
 public:
  virtual const char* id() const noexcept = 0;
  virtual const Caloric& caloric() const noexcept = 0;
  /// Value of a property of the catalogue at a temperature in K; NaN for an unknown key. Not for inner loops: bake.
  virtual double property(const char* key, double temperature) const noexcept = 0;
  /// Whether it names the other one in its `adheres_to`: where either does, matter that freezes holds on to solid
  /// matter of the other material as it does to its own.
  virtual bool adheresTo(const MaterialView& /*other*/) const noexcept { return false; }

 protected:
  ~MaterialView() = default;
};

}  // namespace ps::api
