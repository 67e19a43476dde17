#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the samples of projects/ whose bodies are made by formula: kettle-with-lid, candle, bronze-casting,
lava-over-ice, freezing-pond, dry-ice, pressure-cooker and foundry. Run by hand; every run gives the same bytes.

    make_samples.py [NAME ...]
"""
import math
import sys

from scenewriter import (PHASES, ROOT, box, cells_as_runs, make_figure, material, probe, project, sketched, tray, view,
                         wall, write)

ROOM = 293.15


def solver(spacing, scale, substeps=4, iterations=4, **more):
    return dict({"particle_spacing": spacing, "substeps": substeps, "iterations": iterations,
                 "thermal_time_scale": scale}, **more)


def sink(key, name, low, high):
    return {"id": key, "name": name, "minimum": list(low), "maximum": list(high)}


def tap(key, name, of, point, temperature, speed, diameter, **more):
    return dict({"id": key, "name": name, "material": of, "point": list(point), "direction": [0, -1, 0], "speed": speed,
                 "diameter": diameter, "temperature": temperature}, **more)


def disc(i, k, radius):
    """Whether the column (i, k) of cells lies in a circle of `radius` cells about the axis."""
    return i * i + k * k < radius * radius


def kettle_with_lid():
    d, inner, outer, high = 0.01, 9.6, 11.6, 18
    spout = lambda i, j, k: i > 0 and abs(k) <= 2 and 12 <= j <= 15
    shell = cells_as_runs(lambda i, j, k: disc(i, k, outer) and (j < 1 or not disc(i, k, inner)) and not spout(i, j, k),
                          (-12, 0, -12), (12, high - 1, 12))
    beak = cells_as_runs(  # open above, like a jug's
        lambda i, j, k: i * i + k * k >= outer * outer and abs(k) <= 4 and 10 <= j - (i - 11) // 2 <= 15
        and (abs(k) > 2 or j - (i - 11) // 2 < 12), (10, 10, -4), (15, 17, 4))
    water = cells_as_runs(lambda i, j, k: disc(i, k, inner), (-12, 1, -12), (12, 9, 12))
    lid = cells_as_runs(lambda i, j, k: disc(i, k, outer) if j < high + 2 else disc(i, k, 2.5),
                        (-12, high, -12), (12, high + 3, 12))
    at = (0, 0.5 * d, 0)
    bodies = [sketched("kettle", "Kettle", "iron", shell + beak, at, d, 353.15, fixed=True),
              sketched("lid", "Lid", "steel", lid, at, d, ROOM, holds="rigid"),
              sketched("water", "Water", "water", water, at, d, 353.15)]
    return project(
        "Kettle with a lid",
        "Hot water in an iron kettle on a plate of 180 °C. It comes to the boil under its lid, and its steam leaves by the "
        "spout. Heat runs 500 times faster than it really would.",
        [material("water", "Water"), material("iron", "Iron"), material("iron", "Lid", "steel", density_solid=2700)],
        bodies, tray(0.25, 0.25, 453.15, None, "Hot plate"), ((-0.45, -0.1, -0.45), (0.45, 0.75, 0.45)), solver(d, 500),
        [probe("Water", "temperature", "water", body="water"),
         probe("Lid", "temperature", "lid", body="lid"), probe("Lid", "height", "lid_height", body="lid")] + PHASES[2:],
        60, view((0.03, 0.13, 0), 0.9, 25, 22, "material",
                 ["wall/floor/temperature", "solver/thermal_time_scale", "environment/ambient_pressure"]),
        sinks=[sink("room", "The room takes the steam", (-0.45, 0.45, -0.45), (0.45, 0.75, 0.45))])


def candle():
    d, radius, high = 0.01, 4.6, 18
    wicked = lambda i, j, k: abs(i) + abs(k) <= (1 if j < high + 1 else 0) and j >= high - 5
    wick = cells_as_runs(wicked, (-1, high - 5, -1), (1, high + 2, 1))
    dip = lambda i, j, k: j >= high - 5 and math.hypot(i, k) < min(3.3, 5.4 + j - high)  # a hollow about the wick
    wax = cells_as_runs(lambda i, j, k: disc(i, k, radius) and not dip(i, j, k) and not wicked(i, j, k), (-6, 0, -6), (6, high - 1, 6))
    pool = cells_as_runs(lambda i, j, k: dip(i, j, k) and not wicked(i, j, k), (-6, high - 5, -6), (6, high - 1, 6))
    at = (0, 0.5 * d, 0)
    core = [{"minimum": [-1, -1, -1], "maximum": [1, d, 1]},
            {"minimum": [-1.6 * d, -1, -1.6 * d], "maximum": [1.6 * d, 9 * d, 1.6 * d]}]
    bodies = [sketched("wick", "Burning wick", "wick", wick, at, d, 450.0, fixed=True, heating_power=15),
              sketched("candle", "Candle", "wax", wax, at, d, ROOM, holds="bonds", pins=core),
              sketched("pool", "Pool of wax", "wax", pool, at, d, 350.0)]
    return project(
        "Candle",
        "A thick candle of paraffin. Of its flame there is only the heat, 15 W in the wick: the pool about it grows and overflows "
        "until air and radiation take as much as the flame gives; with 16 W it breaks its rim, runs out and freezes on the table. Its "
        "core is held in place, as a spike would. Heat runs 3,000 times faster than it really would.",
        [material("wax", "Paraffin wax"),
         material("wood", "Wick, soaked with wax", "wick", conductivity_solid=20,
                  melting_temperature=1500, solidus=1490, liquidus=1500)],
        bodies, tray(0.16, 0.16, ROOM, None, "Table"), ((-0.2, -0.05, -0.2), (0.2, 0.4, 0.2)),
        solver(d, 3000, substeps=6),
        [probe("Wax", "temperature", "wax", body="candle"), probe("Solid wax", "solid_mass"),
         probe("Soft wax", "melting_mass"), probe("Molten wax", "liquid_mass"),
         probe("Candle", "height_max", "height", body="candle")],
        60, view((0, 0.085, 0), 0.62, 30, 22, "temperature",
                 ["solver/thermal_time_scale", "material/wax/viscosity", "body/wick/heating_power"]),
        environment={"radiation": True})


def bronze_casting():
    d, height = 0.0125, 0.5
    unit = d / height
    distance = lambda i, j, k: make_figure.distance(i * unit, (j - 2 + 0.5) * unit, k * unit)
    top = 2 + round(1 / unit) + 2
    sprue = lambda i, j, k: j > 12 and math.hypot(i + 8, k) < 3.2  # into the back
    vents = lambda i, j, k: j > top - 6 and math.hypot(i - 0.5, abs(k) - 6) < 2.6  # above the ears
    hollow = lambda i, j, k: distance(i, j, k) < 0 or sprue(i, j, k) or vents(i, j, k)
    solid = lambda i, j, k: not hollow(i, j, k) and (
        distance(i, j, k) < 3.2 * unit or j > 12 and math.hypot(i + 8, k) < 5.6
        or math.hypot(i - 0.5, abs(k) - 6) < 4.6 and j > top - 6)
    mould = cells_as_runs(solid, (-24, 0, -16), (24, top + 2, 0))
    at = (0, 0.5 * d, -0.5 * d)
    return project(
        "Casting a bronze rabbit",
        "Molten bronze of 1,150 °C runs through the sprue into a mould of sand, cut open along its middle so that one sees "
        "it fill, freeze from the mould inwards and keep the rabbit's shape. Heat runs 100 times faster than it really "
        "would.",
        [material("bronze", "Bronze"),
         material("lava", "Foundry sand", "sand", density_solid=1600, conductivity_solid=0.9, heat_capacity_solid=1100,
                  solidus=1980, liquidus=1990, melting_temperature=1990, color_red=0.62, color_green=0.5,
                  color_blue=0.36)],
        [sketched("mould", "Mould", "sand", mould, at, d, ROOM, fixed=True)],
        [wall("floor", "Floor", (0, 0, 0), (0, 1, 0)), wall("cut", "Cut through the mould", (0, 0, 0), (0, 0, -1)),
         wall("left", "Left of the pit", (-0.36, 0, 0), (1, 0, 0)), wall("right", "Right of the pit", (0.36, 0, 0), (-1, 0, 0)),
         wall("back", "Back of the pit", (0, 0, -0.26), (0, 0, 1))],
        ((-0.4, -0.1, -0.35), (0.4, 3, 0.05)), solver(d, 100, substeps=6),
        [probe("Bronze", "temperature", "bronze", body="ladle"), probe("Bronze", "height_max", "level", body="ladle"),
         probe("Poured", "mass", "poured", body="ladle"), probe("Frozen", "solid_mass", "frozen", body="ladle"),
         probe("Freezing", "melting_mass", "freezing", body="ladle"), probe("Molten", "liquid_mass", "molten", body="ladle")],
        60, view((0, 0.28, -0.05), 1.1, 12, 14, "material",
                 ["emitter/ladle/temperature", "emitter/ladle/speed", "solver/thermal_time_scale"]),
        environment={"radiation": True},
        emitters=[tap("ladle", "Ladle", "bronze", (-8 * d, 0.66, -0.02), 1423.15, 0.8, 0.0423, most=4450)])


def lava_over_ice():
    d = 0.02
    ground = lambda i: 9 - (i + 22) // 5  # stairs of single cells down along +x
    rock = cells_as_runs(lambda i, j, k: ground(i) - 2 <= j < ground(i), (-22, 0, -9), (22, 9, 9))
    ice = cells_as_runs(lambda i, j, k: i >= -6 and ground(i) <= j < ground(i) + 4, (-6, 0, -9), (22, 14, 9))
    at = (0, 0.5 * d, 0)
    return project(
        "Lava over ice",
        "Basalt lava of 1,200 °C comes down a slope onto ice. The ice melts and boils where the lava touches it, and the "
        "lava gets a crust and stops. Heat runs 500 times faster than it really would.",
        [material("lava", "Lava"), material("lava", "Rock", "rock", color_red=0.28, color_green=0.26, color_blue=0.25),
         material("water", "Water")],
        [sketched("rock", "Slope", "rock", rock, at, d, 268.15, fixed=True),
         sketched("ice", "Ice", "water", ice, at, d, 263.15, holds="bonds", phase="solid")],
        tray(0.45, 0.19), ((-0.55, -0.1, -0.3), (0.55, 1.2, 0.3)), solver(d, 500),
        [probe("Lava", "temperature", "lava", body="vent"), probe("Crust", "solid_mass", "crust", body="vent"),
         probe("Lava", "melting_mass", "mush", body="vent"), probe("Ice", "solid_mass", "ice", body="ice"),
         probe("Water", "liquid_mass", "water", body="ice"), probe("Steam", "gas_mass", "steam", body="ice")],
        40, view((0, 0.15, 0), 1.4, 30, 24, "material",
                 ["emitter/vent/temperature", "material/lava/viscosity", "solver/thermal_time_scale"]),
        environment={"radiation": True},
        emitters=[tap("vent", "Vent", "lava", (-0.36, 0.42, 0), 1473.15, 0.35, 0.12, most=3000)],
        sinks=[sink("sky", "The sky takes the steam", (-0.55, 0.9, -0.3), (0.55, 1.2, 0.3))])


def freezing_pond():
    d = 0.025
    bed = lambda i, k: max(1, min(10, round(1 + 9 * ((i / 19) ** 2 + (k / 13) ** 2) ** 2)))
    earth = cells_as_runs(lambda i, j, k: j < bed(i, k), (-19, 0, -13), (19, 9, 0))
    water = cells_as_runs(lambda i, j, k: bed(i, k) <= j, (-19, 0, -13), (19, 8, 0))
    at = (0, 0.5 * d, 0)
    walls = [wall("floor", "Below", (0, 0, 0), (0, 1, 0)), wall("left", "Left side", (-19.5 * d, 0, 0), (1, 0, 0)),
             wall("right", "Right side", (19.5 * d, 0, 0), (-1, 0, 0)),
             wall("back", "Back", (0, 0, -13.5 * d), (0, 0, 1)),
             wall("cut", "Cut through the pond", (0, 0, 0.5 * d), (0, 0, -1), friction=0)]
    return project(
        "Freezing pond",
        "Half a pond of 6 °C under wind of −20 °C. Water is densest at 4 °C: the coldest "
        "stays above, a sheet of ice grows downwards, and what lives at the bottom has its 4 °C for longest. Heat runs 3,000 "
        "times faster than it really would.",
        [material("water", "Water"),
         material("lava", "Earth", "earth", color_red=0.36, color_green=0.28, color_blue=0.2)],
        [sketched("earth", "Bed", "earth", earth, at, d, 279.15, fixed=True),
         sketched("water", "Water", "water", water, at, d, 279.15, holds="bonds")],
        walls, ((-0.6, -0.1, -0.45), (0.6, 0.5, 0.1)), solver(d, 3000),
        [probe("Pond", "temperature", "mean", body="water"),
         probe("At the bottom", "temperature", "bottom", body="water",
               region={"minimum": [-0.2, 0, -0.2], "maximum": [0.2, 3 * d, 0.2]}),
         probe("Ice", "solid_mass", body="water"), probe("Freezing", "melting_mass", body="water"),
         probe("Water", "liquid_mass", body="water")],
        40, view((0, 0.1, -0.1), 1.6, 14, 20, "temperature",
                 ["environment/ambient_temperature", "environment/wind_speed", "solver/thermal_time_scale"]),
        environment={"ambient_temperature": 253.15, "air_convection": 10, "wind_speed": 8})


def dry_ice():
    d = 0.015
    bodies = [box("water", "Warm water", "water", (0, 0.075, 0), (0.36, 0.15, 0.36), 313.15)]
    for n, (x, z) in enumerate(((-0.08, 0.03), (0.07, -0.06), (0.04, 0.09)), 1):
        bodies.append(box("lump%d" % n, "Lump %d" % n, "co2", (x, 0.24, z), (0.075, 0.06, 0.075), 190.0, holds="rigid",
                          phase="solid"))
    return project(
        "Dry ice in warm water",
        "Lumps of frozen carbon dioxide, −83 °C, fall into warm water. They never melt: at the air's pressure they turn "
        "straight to gas, which bubbles up and throws the water about. The water cools. Heat runs 50 times faster than it really would.",
        [material("water", "Water"), material("co2", "Dry ice")], bodies, tray(0.18, 0.18), ((-0.4, -0.1, -0.4), (0.4, 3, 0.4)),
        solver(d, 50),
        [probe("Dry ice", "temperature_min", "co2"), probe("Water", "temperature", "water", body="water")] +
        [probe("Dry ice, lump %d" % n, "solid_mass", "solid%d" % n, body="lump%d" % n) for n in (1, 2, 3)] +
        [probe("Gas", "gas_mass", "gas")],
        40, view((0, 0.14, 0), 1.0, 30, 18, "material",
                 ["body/water/temperature", "environment/ambient_pressure", "solver/thermal_time_scale"]),
        sinks=[sink("room", "The room takes what rises", (-0.4, 0.7, -0.4), (0.4, 3, 0.4))])


def pressure_cooker():
    d = 0.012
    bodies = [box("water", "Water", "water", (0, 0.06, 0), (0.3, 0.12, 0.3), 368.15),
              box("potato1", "Potato", "potato", (-0.06, 0.05, 0.03), (0.07, 0.05, 0.06), ROOM, holds="rigid"),
              box("potato2", "Potato", "potato", (0.07, 0.05, -0.05), (0.06, 0.06, 0.07), ROOM, holds="rigid")]
    bodies = bodies[1:] + bodies[:1]  # the water fills what the potatoes leave
    return project(
        "Pressure cooker",
        "Water under 2 bar boils at 120 °C instead of 100 °C: the potatoes get hotter, and are done sooner. Move the pressure "
        "and the water starts or stops boiling at once. Heat runs 2,000 times faster than it really would.",
        [material("water", "Water"),
         material("wood", "Potato", "potato", density_solid=1080, conductivity_solid=0.55, heat_capacity_solid=3600,
                  color_red=0.85, color_green=0.72, color_blue=0.42)],
        bodies, tray(0.15, 0.15, 423.15, 383.15, "Hot plate", "Lid", 0.34), ((-0.25, -0.1, -0.25), (0.25, 0.5, 0.25)),
        solver(d, 2000),
        [probe("Water", "temperature", "water", body="water"),
         probe("Boiling water", "temperature_max", "boiling", phase="boiling"),
         probe("Potato", "temperature", "potato", body="potato1")] + PHASES[2:],
        40, view((0, 0.14, 0), 0.85, 30, 16, "temperature",
                 ["environment/ambient_pressure", "wall/floor/temperature", "solver/thermal_time_scale"]),
        environment={"ambient_pressure": 200000, "ambient_temperature": 393.15})


def foundry():
    d = 0.02
    inner, outer, deep = 6.5, 8.5, 12
    centre = (-18, 34)  # of the ladle's axis, in cells
    around = lambda i, k: math.hypot(i - centre[0], k)
    ladle = cells_as_runs(lambda i, j, k: around(i, k) < outer and (j < centre[1] - deep // 2 + 2 or around(i, k) >= inner),
                          (-30, centre[1] - deep // 2, -9), (-6, centre[1] + deep // 2 - 1, 9))
    melt = cells_as_runs(lambda i, j, k: around(i, k) < inner,
                         (-30, centre[1] - deep // 2 + 2, -9), (-6, centre[1] + deep // 2 - 3, 9))
    mould = cells_as_runs(lambda i, j, k: j < 2 or abs(k) >= 7 or i < -14 or i > 14 or i in (-5, -4, 4, 5) and j < 7,
                          (-16, 0, -9), (16, 9, 9))
    at = (0, 0.5 * d, 0)
    return project(
        "Foundry",
        "A ladle tips and pours iron of 1,650 °C into three ingot moulds of sand, where it glows and freezes. Heat runs 10 "
        "times faster than it really would.",
        [material("iron", "Iron"),
         material("lava", "Foundry sand", "sand", density_solid=1600, conductivity_solid=0.9, heat_capacity_solid=1100,
                  solidus=2180, liquidus=2190, melting_temperature=2190, color_red=0.62, color_green=0.5,
                  color_blue=0.36)],
        [sketched("ladle", "Ladle", "sand", ladle, at, d, 1500.0, fixed=True, spin=[0, 0, -0.22], motion_start=1,
                  motion_stop=9),
         sketched("mould", "Moulds", "sand", mould, at, d, ROOM, fixed=True),
         sketched("iron", "Iron", "iron", melt, at, d, 1923.15)],
        tray(0.7, 0.3), ((-0.8, -0.1, -0.4), (0.8, 1.2, 0.4)), solver(d, 10),
        [probe("Iron", "temperature", "iron", body="iron"), probe("Iron", "height", "height", body="iron"),
         probe("Frozen", "solid_mass", "frozen", body="iron"), probe("Molten", "liquid_mass", "molten", body="iron")],
        40, view((-0.1, 0.38, 0), 2.2, 35, 22, "temperature",
                 ["body/ladle/spin_z", "material/iron/viscosity", "solver/thermal_time_scale"]),
        environment={"radiation": True})


SAMPLES = {
    "kettle-with-lid": kettle_with_lid,
    "candle": candle,
    "bronze-casting": bronze_casting,
    "lava-over-ice": lava_over_ice,
    "freezing-pond": freezing_pond,
    "dry-ice": dry_ice,
    "pressure-cooker": pressure_cooker,
    "foundry": foundry,
}

if __name__ == "__main__":
    for name in sys.argv[1:] or SAMPLES:
        write(ROOT / "projects" / (name + ".json"), SAMPLES[name]())
