// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kSolver[] = {
    atReset(
        number({"particle_spacing", "Particle spacing", "d", "m"}, {0.02, 0.001, 0.05, 0.0005, 10},
               {"Resolution",
                "Distance between neighbouring particles. Half of it makes eight times as many. A liquid at rest is so "
                "regular that things which are up to a fifth denser and a few spacings large may hang in it rather "
                "than sink.",
                "a block of 10 cm has 125 particles at 20 mm, 8,000 at 5 mm", ""},
               {"mm", 1000, 0}, api::Scale::Logarithmic)),
    number({"support_ratio", "Reach of a particle", "κ", ""}, {2, 2, 3, 1.8, 4},
           {"Resolution", "How far a particle feels others, in spacings. More is smoother and slower.",
            "2 for 26 neighbours, 3 for 92", "Monaghan 2005"}),
    choice({"kernel", "Kernel", "W", ""}, "cubic_spline|wendland_c2", 0,
           {"Resolution", "Shape of the weight with which a particle counts its neighbours.",
            "cubic spline conducts heat most exactly at a reach of 2", "Monaghan 2005; Dehnen & Aly 2012"}),
    number({"dt", "Frame", "Δt", "s"}, {1.0 / 60, 1.0 / 240, 1.0 / 30, 1e-6, 1e6},
           {"Time", "Time that one frame advances. Heat-only scenes whose particles are all fixed may take any length.",
            "16.67 ms for 60 frames per second", ""},
           {"ms", 1000, 0}, api::Scale::Logarithmic),
    integer(
        {"substeps", "Substeps", "", ""}, {4, 1, 16, 1, 64},
        {"Time", "Steps per frame. The first thing to raise when matter squeezes, sinks in or springs.",
         "4 for water, 8 or more for stiff or deep scenes", "Macklin et al. 2019, Small steps in physics simulation"}),
    integer({"iterations", "Iterations", "", ""}, {4, 1, 16, 1, 64},
            {"Time", "Passes over all constraints in each substep. Stiff bonds need at least two.",
             "4 for water, 2 for solids alone", "Macklin et al. 2016, XPBD"}),
    choice({"density_solver", "Density solver", "", ""}, "jacobi|chebyshev", 1,
           {"Density", "How pressure is solved: plain under-relaxed passes, or passes that build on the last two.",
            "Chebyshev pays from 4 iterations", "Macklin & Müller 2013; Wang 2015, Chebyshev semi-iterative approach"}),
    number({"relaxation", "Relaxation", "ω", ""}, {0.5, 0.2, 1, 0.01, 1.5},
           {"Density", "Share of each density correction that is taken. Too much makes resting water boil.",
            "0.5 with Chebyshev, 0.6 without, 0.4 with one iteration", "Macklin et al. 2014"}),
    actingWhen("density_solver = chebyshev",
               number({"chebyshev_radius", "Spectral radius", "ρ", ""}, {0.8, 0, 0.95, 0, 0.99},
                      {"Density", "How boldly Chebyshev passes extrapolate; 0 makes them plain.",
                       "0.8 with 4 iterations, 0.9 with 8", "Wang 2015, Chebyshev semi-iterative approach"})),
    number({"xsph_minimum", "Calming", "c", ""}, {0.05, 0, 0.3, 0, 1},
           {"Motion",
            "Least share of the neighbours' mean velocity that a particle takes over in 1/240 s, a substep of the "
            "defaults, and less in shorter ones; it keeps water quiet where its real viscosity asks less.",
            "0.05 for water, 0.2 for oil-like calm, 0 for none", "Schechter & Bridson 2012"}),
    choice(
        {"viscosity_model", "Viscosity", "", ""}, "automatic|xsph|implicit", 0,
        {"Viscosity",
         "How liquids resist shear. A filter of velocities is cheap and reaches oil; the implicit solver reaches "
         "honey, lava and glass, and knows what walls hold. Automatic takes the filter where it suffices: where a wall "
         "drags along less than a spacing of liquid in eight seconds.",
         "automatic: water by the filter, honey implicit", "Monaghan 1992; Weiler et al. 2018"}),
    number({"viscosity_max", "Thickest mush", "µ_max", "Pa·s"}, {1e4, 10, 1e6, 1e-3, 1e12},
           {"Viscosity",
            "Bound on the viscosity of matter within its melting range, which grows without end as its crystals begin "
            "to touch; from there on bonds hold it.",
            "10000 Pa·s: cold butter", "Krieger & Dougherty 1959"},
           kAsStored, api::Scale::Logarithmic),
    actingWhen("viscosity_model != xsph",
               number({"viscosity_tolerance", "Tolerance", "", ""}, {0.01, 1e-4, 0.1, 1e-6, 0.5},
                      {"Viscosity", "Relative residual at which the implicit solver stops.",
                       "0.01: a column of honey slumps as with 0.001, in half the time", "Weiler et al. 2018"},
                      kAsStored, api::Scale::Logarithmic)),
    actingWhen(
        "viscosity_model != xsph",
        integer({"viscosity_iterations", "Most iterations", "", ""}, {100, 10, 300, 1, 10000},
                {"Viscosity",
                 "Where the implicit solver stops even if the tolerance is not met; what was reached is then reported.",
                 "15 suffice for honey at 10 mm, thicker matter needs more", "Weiler et al. 2018"})),
    number(
        {"damping", "Damping", "", "1/s"}, {0, 0, 5, 0, 100},
        {"Motion", "Takes speed from everything, as thick air would.", "0 for none, 0.5 to 1 for hanging ropes", ""}),
    choice(
        {"gas_model", "Model of vapour", "", ""}, "parcel|thesis", 0,
        {"Motion",
         "How vapour rises and swells. Parcels follow the densities of vapour and air, feel drag and wind, and swell "
         "by the material's size of a parcel. The thesis's laws depend on latent heat alone: vapour rises with 1 m/s² "
         "at the end and swells to 1.43, without drag.",
         "parcel: steam rises, carbon dioxide sinks", "Thesis 2020, eq. 4.9 and 4.10, for the second"}),
    actingWhen(
        "gas_model = parcel",
        number({"added_mass", "Added mass of a steam parcel", "C_a", ""}, {0.5, 0, 1, 0, 10},
               {"Motion", "Air that a parcel must push aside as it speeds up, as a share of the air it displaces.",
                "sphere 0.5, 0 for none: steam then starts twice as fast", "Batchelor 1967, ch. 6"})),
    actingWhen("gas_model = parcel",
               number({"gas_parcel_diameter", "Size of a steam parcel", "D", "m"}, {0.2, 0.02, 1, 1e-3, 100},
                      {"Motion", "Diameter with which a parcel of vapour drags through air. Larger rises faster.",
                       "0.2 m rises about 1 m/s", ""})),
    actingWhen(
        "scene/thermal_model != none",
        number({"thermal_time_scale", "Time lapse of heat", "S", ""}, {1, 1, 20000, 0, 1e7},
               {"Heat",
                "Makes all heat flow this much faster than motion. Material data stay real; the thermal clock runs "
                "faster.",
                "1 real, 1000: an hour of heating in 3.6 s", ""},
               {"×", 1, 0}, api::Scale::Logarithmic)),
    actingWhen(
        "scene/thermal_model != none",
        number(
            {"thermal_cfl", "Heat step", "", ""},
            {0.5, 0.1, 1, 0.01, 5},
            {"Heat",
             "Length of a heat step as a share of the longest one that keeps temperatures in bounds. Above 1 they may "
             "overshoot, from 1.5 to 2 on they explode: for experiments.",
             "0.5 is monotone and safe", "Cleary & Monaghan 1999"})),
    actingWhen("scene/thermal_model != none",
               choice({"heat_steps", "Heat steps by", "", ""}, "automatic|explicit", 0,
                      {"Heat",
                       "Automatic takes up to 40 short steps a frame and, where these are too few, sweeps that are "
                       "stable but let a "
                       "freezing front lag by a tenth and more. Explicit takes as many short steps as it needs, "
                       "however long that "
                       "lasts.",
                       "automatic to play, explicit to measure", "Cleary & Monaghan 1999"})),
    actingWhen(
        "scene/thermal_model != none",
        toggle({"moment_correction", "Exact conduction in disorder", "", ""}, true,
               {"Heat", "Corrects each pair's conduction for the disorder of its neighbours; keeps energy exactly.",
                "on: 0.36 % error in shaken matter, off: 0.44 %", "Cleary & Monaghan 1999"})),
    actingWhen(
        "scene/thermal_model != none",
        number({"nucleation", "Bubble growth", "q", ""}, {0.3, 0, 0.5, 0, 1},
               {"Heat",
                "Share of latent heat that boiling neighbours hand to the one ahead, so that bubbles form instead "
                "of everything half boiling.",
                "0.3 bubbles, 0 boils evenly", ""})),
};

}  // namespace

api::ParameterList solverParameters() { return api::listOf(kSolver); }

}  // namespace ps
