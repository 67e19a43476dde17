#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes projects/thesis: the scenes of chapter 4 of the thesis that PhaseSketch follows, with about as many particles
as its table 4.2 gives. Materials and numbers are ours. Run by hand; every run gives the same bytes.

    make_thesis.py [NAME ...]
"""
import sys

from scenewriter import (PHASES, ROOT, box, cells_as_runs, figure, make_figure, material, probe, project, sketched, tray,
                         view, write)

WATER = material("water", "Water")


def solver(spacing, scale, substeps=4, iterations=4, **more):
    return dict({"particle_spacing": spacing, "substeps": substeps, "iterations": iterations,
                 "thermal_time_scale": scale}, **more)


def heat_transfer():
    d, side, half = 0.02, 0.6, 0.2
    bodies = [box("cold", "Cold water", "water", (0, half / 2, 0), (side, half, side), 283.15),
              box("hot", "Hot water", "water", (0, 1.5 * half, 0), (side, half, side), 363.15)]
    return project(
        "Heat transfer between two liquids",
        "Water of 90 °C lies on water of 10 °C in a box that lets no heat through. Nothing stirs it, since the lighter "
        "water is above: heat creeps across the boundary until all is equally warm. Heat runs 20,000 times faster than "
        "it really would; a second is five and a half hours. Thesis, figure 4.3: 18,000 particles.",
        [WATER], bodies, tray(side / 2, side / 2), ((-0.4, -0.1, -0.4), (0.4, 0.8, 0.4)), solver(d, 20000),
        [probe("Cold water", "temperature", "cold", body="cold"), probe("Hot water", "temperature", "hot", body="hot"),
         probe("Cold water, highest", "temperature_max", "cold_max", body="cold"),
         probe("All water", "thermal_energy", "energy")],
        20, view((0, 0.2, 0), 1.5, pinned=["body/hot/temperature", "solver/thermal_time_scale",
                                           "material/water/conductivity_liquid"]),
        environment={"air_convection": 0})


def vaporisation(count_x, layers, count_z, words):
    d = 0.02
    x, depth, z = count_x * d, layers * d, count_z * d
    bodies = [box("water", "Water", "water", (0, depth / 2, 0), (x, depth, z), 353.15)]
    return project(
        "Vaporisation", "Water of 80 °C stands on a plate of 135 °C. It warms, stays at its boiling point whatever it is "
        "given, and leaves as steam. " + words + " Heat runs 20,000 times faster than it really would.",
        [WATER], bodies, tray(x / 2, z / 2, 408.15, None, "Hot plate", "Hood", 4 * depth + 0.4),
        ((-x / 2 - 0.1, -0.1, -z / 2 - 0.1), (x / 2 + 0.1, 4 * depth + 0.6, z / 2 + 0.1)), solver(d, 20000),
        [probe("All water", "temperature", "mean"),
         probe("Boiling water", "temperature_max", "boiling", phase="boiling"),
         probe("Liquid, highest", "temperature_max", "liquid", phase="liquid")] + PHASES[2:],
        30, view((0, 1.5 * depth, 0), 3.2 * max(x, z), colour="phase",
                 pinned=["wall/floor/temperature", "environment/ambient_pressure", "solver/thermal_time_scale"]),
        environment={"ambient_temperature": 363.15})


def condensation(count_x, layers, count_z, words, environment, lid):
    d = 0.02
    x, high, z = count_x * d, layers * d, count_z * d
    top = 3.4 * high
    bodies = [box("steam", "Steam", "water", (0, top - high / 2 - d, 0), (x, high, z), 378.15, phase="gas")]
    return project(
        "Condensation", "Steam of 105 °C hangs in the upper part of a closed box. " + words, [WATER], bodies,
        tray(x / 2, z / 2, None, lid, "Floor", "Cold lid", top),
        ((-x / 2 - 0.1, -0.1, -z / 2 - 0.1), (x / 2 + 0.1, top + 0.1, z / 2 + 0.1)), solver(d, 1000),
        [probe("All matter", "temperature", "mean"), probe("All matter", "height", "height"),
         probe("All matter", "count", "count")] + PHASES[2:],
        30, view((0, top / 2, 0), 2.6 * top, colour="phase",
                 pinned=["wall/lid/temperature", "environment/air_convection", "solver/thermal_time_scale"]),
        environment=environment)


def rabbit_under_water(title, words, ice, water, scale, pours):
    """Figures 4.5 and 4.6: the same scene at other temperatures, the shower on for `pours` s. A shallow pool and a shower, not a block of water that
    drops: that one squirts metres high where it is caught between rabbit and tray."""
    d, height = 0.02, 1.0
    x, z, layers = 0.61, 0.43, 4
    rabbit = set(make_figure.cells(d / height))
    reach_x, reach_z = round(x / d - 0.5), round(z / d - 0.5)
    pool = cells_as_runs(lambda i, j, k: (i, j, k) not in rabbit, (-reach_x, 0, -reach_z), (reach_x, layers - 1, reach_z))
    bodies = [figure("rabbit", "Ice rabbit", "water", height, d, ice, phase="solid", holds="rigid"),
              sketched("water", "Water in the tray", "water", pool, (0, 0.5 * d, 0), d, water)]
    shower = {"id": "shower", "name": "Shower", "material": "water", "point": [0, 1.2, 0], "direction": [0, -1, 0],
              "speed": 1.5, "diameter": 0.26, "temperature": water, "stop": pours, "most": 20000}
    return project(
        title, words, [WATER], bodies, tray(x, z, friction=0.3), ((-x - 0.1, -0.1, -z - 0.1), (x + 0.1, 2.6, z + 0.1)),
        solver(d, scale),
        [probe("Rabbit", "temperature", "rabbit", body="rabbit"),
         probe("Water", "temperature_max", "water"),
         probe("Water in the tray", "temperature", "tray", body="water"),
         probe("Rabbit, solid", "solid_mass", "rabbit_solid", body="rabbit"),
         probe("New ice", "solid_mass", "new_ice", body="shower"),
         probe("Rabbit", "height_max", "top", body="rabbit")] + PHASES[:3],
        30, view((0, 0.5, 0), 2.9, pinned=["emitter/shower/temperature", "emitter/shower/speed",
                                           "solver/thermal_time_scale"]),
        environment={"air_convection": 0}, emitters=[shower])


def melting():
    return rabbit_under_water(
        "Melting", "Water of 95 °C falls over a rabbit of ice and stands around it: the rabbit melts, thin ears and feet "
        "first, and the water cools. Heat runs 6,000 times faster than it really would. Thesis, figure 4.5: 34,600 "
        "particles.", 268.15, 368.15, 6000, 1.11)


def solidification():
    return rabbit_under_water(
        "Solidification", "Water of 2 °C falls over a rabbit of ice from a deep freezer, of −90 °C. It has not enough heat "
        "to melt it; the rabbit grows a coat of new ice instead. Heat runs 4,000 times faster than it really would. "
        "Thesis, figure 4.6: 33,500 particles.", 183.15, 275.15, 4000, 1)


def full_simulation():
    d, height = 0.016, 1.0
    x, z = 0.56, 0.40
    bodies = [figure("rabbit", "Ice rabbit", "water", height, d, 268.15, phase="solid", holds="rigid")]
    return project(
        "Full simulation",
        "A rabbit of ice sits on a plate of 160 °C. It melts from its feet up, the water boils, steam rises to a cold lid "
        "and falls back as drops: three states and four changes in one scene. Heat runs 4,000 times faster than it "
        "really would. Thesis, figure 4.11: 27,100 particles.",
        [WATER], bodies, tray(x, z, 433.15, 283.15, "Hot plate", "Cold lid", 1.5),
        ((-x - 0.1, -0.1, -z - 0.1), (x + 0.1, 1.6, z + 0.1)), solver(d, 4000),
        [probe("All matter", "temperature", "mean"), probe("Rabbit", "height_max", "top", body="rabbit"),
         probe("Boiling water", "temperature_max", "plateau", phase="boiling")] + PHASES,
        40, view((0, 0.6, 0), 3.2, pinned=["wall/floor/temperature", "wall/lid/temperature",
                                           "solver/thermal_time_scale"]))


def dilation():
    d, height = 0.02, 0.8
    foot = {"minimum": [-0.15, 0, 0.13], "maximum": [-0.08, d, 0.17]}
    bodies = [figure("rabbit", "Iron rabbit", "iron", height, d, 293.15, holds="bonds", pins=[foot])]
    return project(
        "Dilation",
        "A rabbit of iron sits on a plate of 1,200 °C. It grows with its temperature, its feet before its ears, and melts "
        "nowhere. Iron grows by 1.18e-5 of its length per kelvin; here it is ten times as much, so that the eye sees it. "
        "There is no gravity, so that nothing else changes its shape, and a foot is held to the plate. Heat runs 2,000 times "
        "faster than it really would. Thesis, figure 4.9.",
        [material("iron", "Iron, swelling tenfold", expansion_linear=1.18e-4, youngs_modulus=1e9)], bodies,
        tray(0.6, 0.5, 1473.15, None, "Hot plate"), ((-0.7, -0.1, -0.6), (0.7, 1.4, 0.6)), solver(d, 2000, damping=2),
        [probe("Rabbit", "temperature", "mean"), probe("Rabbit, coldest", "temperature_min", "coldest"),
         probe("Length", "extent_x", "length"), probe("Height", "extent_y", "height"),
         probe("Width", "extent_z", "width"), probe("Rabbit", "solid_mass", "solid")],
        20, view((0, 0.42, 0), 2.2, pinned=["wall/floor/temperature", "material/iron/expansion_linear",
                                            "solver/thermal_time_scale"]),
        environment={"gravity": [0, 0, 0], "air_convection": 0})


def convection():
    d = 0.02
    x, depth, z = 0.84, 0.36, 0.40
    walls = tray(x / 2, z / 2)
    for side, name, temperature in (("left", "Hot side", 368.15), ("right", "Cold side", 278.15)):
        next(w for w in walls if w["id"] == side).update(name=name, heat="fixed_temperature", temperature=temperature)
    region = lambda low, high: {"minimum": [low, -1, -1], "maximum": [high, 1, 1]}
    return project(
        "Convection",
        "Water of 10 °C stands between a side of 95 °C and one of 5 °C. What touches the hot side becomes light and rises, "
        "spreads over the colder water, cools and sinks at the other end; it stays below its boiling point. Water swells by "
        "4 % on the way; here it is ten times as much, so that it moves in seconds against the model's own friction. Heat "
        "runs 5,000 times faster than it really would. Thesis, figure 4.10 (there the floor is hot).",
        [dict(material("water", "Water, swelling tenfold", expansion_volumetric=5e-3),
              parameters={"density_maximum": False})],
        [box("water", "Water", "water", (0, depth / 2, 0), (x, depth, z), 283.15, jitter=0.1)], walls,
        ((-0.6, -0.1, -0.4), (0.6, 0.8, 0.4)), solver(d, 5000, xsph_minimum=0.02),
        [probe("Water", "temperature", "mean"),
         probe("From the hot side", "height", "hot", region=region(-1, 0.06 - x / 2)),
         probe("From the cold side", "height", "cold", region=region(x / 2 - 0.06, 1)),
         probe("Water", "kinetic_energy", "kinetic"), probe("Water", "temperature_max", "hottest")],
        30, view((0, 0.18, 0), 1.7, pinned=["wall/left/temperature", "wall/right/temperature",
                                            "material/water/expansion_volumetric", "solver/thermal_time_scale"]),
        environment={"air_convection": 0})


SCENES = {
    "heat-transfer": heat_transfer,
    "vaporisation": lambda: vaporisation(36, 14, 36, "Thesis, table 4.2: 18,000 particles."),
    "vaporisation-50k": lambda: vaporisation(50, 20, 50, "Thesis, figure 4.7: 50,000 particles."),
    "condensation": lambda: condensation(
        34, 18, 34, "Its lid is cold: steam that comes near gives up its latent heat, becomes drops and falls. Heat runs "
        "1,000 times faster than it really would. Thesis, table 4.2: 20,400 particles.",
        {"ambient_temperature": 373.15, "air_convection": 0}, 278.15),
    "condensation-26k": lambda: condensation(
        38, 18, 38, "The air among it is cold, and so is the lid: a cloud forms in mid-air, and it rains. Heat runs 1,000 "
        "times faster than it really would. Thesis, figure 4.8: 26,000 particles.",
        {"ambient_temperature": 278.15, "air_convection": 20}, 278.15),
    "melting": melting,
    "solidification": solidification,
    "full-simulation": full_simulation,
    "dilation": dilation,
    "convection": convection,
}

if __name__ == "__main__":
    for name in sys.argv[1:] or SCENES:
        write(ROOT / "projects" / "thesis" / (name + ".json"), SCENES[name]())
