// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include "core/math/kernels.h"
#include "core/math/wallface.h"

#include <array>
#include <string>
#include <vector>

namespace ps {

enum class DensitySolver { Jacobi, Chebyshev };

/// Which stage delivers viscosity: the implicit one for what the filter cannot reach or a wall drags along, the filter
/// alone, the implicit one for all liquids.
enum class ViscosityModel { Automatic, Xsph, Implicit };

/// How vapour moves: by physical densities, or by the thesis's laws of latent heat.
enum class GasModel { Parcel, Thesis };

struct SolverSettings {
  double spacing = 0.02;      ///< m, rest distance of neighbouring particles
  double supportRatio = 2.0;  ///< support radius / spacing
  KernelShape kernel = KernelShape::CubicSpline;
  double dt = 1.0 / 60;  ///< s, one frame
  int substeps = 4, iterations = 4;
  DensitySolver densitySolver = DensitySolver::Chebyshev;
  double relaxation =
      0.5;  ///< omega of the Jacobi density step; 0.5 with Chebyshev, 0.6 without: with 1 resting liquid boils
  double chebyshevRadius = 0.8;  ///< assumed spectral radius
  double xsphMinimum = 0.05;     ///< least XSPH coefficient of a substep of 1/240 s or more; of shorter ones its share
  ViscosityModel viscosityModel = ViscosityModel::Automatic;
  double viscosityMax = 1e4;         ///< Pa s, of mush whose crystals touch
  double viscosityTolerance = 0.01;  ///< of the implicit solve, relative residual
  int viscosityIterations = 100;     ///< at most, of the implicit solve per substep
  double damping = 0;                ///< 1/s, of velocities, before gravity
  api::Double3 gravity{0, -9.81, 0};
  GasModel gasModel = GasModel::Parcel;
  double gasDrag = 0.2;        ///< m, gas_parcel_diameter of the drag law
  double addedMass = 0.5;      ///< added mass coefficient of a parcel; 0.5 for a sphere
  double airDrag = 0;          ///< drag coefficient of single particles of liquids and solids; 0: no air for them
  api::Double3 wind{0, 0, 0};  ///< m/s, velocity of the ambient air
};

/// Which steps carry heat: explicit ones as long as a frame affords them, or explicit ones however many it takes.
enum class HeatSteps { Automatic, Explicit };

/// Heat at a wall: none, a temperature held on its surface, heat per area, or a fluid that flows behind it.
enum class WallHeat { Adiabatic, FixedTemperature, FixedFlux, Convective };

/// A boundary: of a plane particles stay where normal . x >= offset, of a cylinder or sphere inside of it, or outside.
struct Wall {
  std::string id;
  WallForm form = WallForm::Plane;
  api::Double3 normal{0, 1, 0};  ///< unit vector: of a plane into the scene, of a cylinder along its axis
  double offset = 0;             ///< m, of a plane
  api::Double3 centre{0, 0, 0};  ///< m, of a sphere; of a cylinder a point on its axis
  double radius = 1;             ///< m, of cylinder and sphere
  bool inside = true;            ///< whether particles are inside of cylinder or sphere
  double friction = 0.3;
  bool noSlip = true;  ///< implicit viscosity: liquid sticks to it
  WallHeat heat = WallHeat::Adiabatic;
  double temperature = 293.15;   ///< K, of the surface, or of the fluid behind a convective wall
  double flux = 0;               ///< W/m2 into the matter that touches it, of FixedFlux
  double convection = 100;       ///< W/(m2 K), of Convective
  double emissivity = 0.9;       ///< of FixedTemperature and Convective, where heat is radiated
  double filmCoefficient = 500;  ///< W/(m2 K), condensation on walls below the boiling point
};

/// The face of a wall, or the one `inset` m before it.
WallFace faceOf(const Wall& wall, double inset = 0);
/// m from a place (Float4, Double3) to the face of a wall; negative behind it.
template <class Place>
double heightOver(const Wall& wall, const Place& place) {
  if (wall.form != WallForm::Plane) return faceOf(wall).heightOf(vectorOf(place));
  const api::Double3& n = wall.normal;
  return n.x * double{place.x} + n.y * double{place.y} + n.z * double{place.z} - wall.offset;
}

struct Bounds {
  api::Double3 minimum{-1, 0, -1}, maximum{1, 2, 1};  ///< m; a particle that leaves by more than its size is lost
  /// Axes along which the box repeats itself: what leaves by one face comes in by the other.
  std::array<bool, 3> periodic{};
};

/// Extra reach of the neighbour lists, in spacings: they hold until a particle has moved half of it.
inline constexpr double kSkinSpacings = 0.2;
/// m, the shortest edge along which a box may repeat itself: three times the reach of the neighbour lists.
double leastPeriod(const SolverSettings& settings);

struct ThermalSettings {
  double timeScale = 1;  ///< thermal_time_scale: all heat fluxes times this; final states unchanged
  double cfl = 0.5;      ///< thermal_cfl: fraction of the Gershgorin limit per explicit step
  HeatSteps steps = HeatSteps::Automatic;
  bool momentCorrection = true;
  double ambientPressure = 101325;     ///< Pa
  double ambientTemperature = 293.15;  ///< K
  double airConvection = 5;            ///< W/(m2 K), of still air on free surfaces
  double airHeatCapacity = 0;          ///< J/K of the air around; 0: as much air as it takes
  double contactConductance = 0;       ///< W/(m2 K) between different bodies, one of them solid; 0: perfect contact
  bool radiation = false;
  double surroundingsTemperature = 293.15;  ///< K, of what surrounds the scene
  std::vector<double> surfaceArea{};        ///< m2 by index of body; 0, or none: as its particles show
  double nucleation = 0.3;                  ///< share of latent heat that boiling neighbours pass on
};

}  // namespace ps
