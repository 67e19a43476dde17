#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes projects/sketched: scenes that are drawn by strokes of the brushes, after figures 5.9 to 5.12 of the thesis
that the program descends from, and a river. Run by hand; needs a built program, which draws the strokes.

    make_sketched.py [NAME ...]
"""
import subprocess
import sys

from scenewriter import ROOT, box, material, probe, project, sketched, tray, view, wall, write

PROGRAM = ROOT / "build" / "release" / "bin" / "phasesketch-cli"
ROOM = 293.15


def stroke(brush, radius, *path, palette=0, up=None, erase=False, turns=1, mirror=None, centre=(0, 0, 0), **parameters):
    """Along `path`: places (x, y, z) in m or, with a pen's pressure, (x, y, z, pressure); a second for each metre."""
    samples, time, last = [], 0.0, None
    for point in path:
        place = point[:3]
        if last:
            time += sum((a - b) ** 2 for a, b in zip(place, last)) ** 0.5
        last = place
        samples.append([*place, point[3] if len(point) > 3 else 1, time])
    result = {"brush": brush, "radius": radius, "palette": palette, "samples": samples}
    if parameters:
        result["parameters"] = parameters
    if up:
        result["up"] = list(up)
    if erase:
        result["erase"] = True
    if turns > 1 or mirror:
        result["symmetry"] = {"mirror": mirror or "none", "turns": turns, "centre": list(centre)}
    return result


def drawn(key, name, of, strokes, spacing, temperature=ROOM, also=(), **more):
    """A body of strokes; `also`: materials of the palette after the first."""
    half = 0.5 * spacing
    result = sketched(key, name, of, [], (half, half, half), spacing, temperature, **more)
    shape = result["shape"]["voxels"]
    shape["palette"] += [{"material": other, "temperature": temperature} for other in also]
    shape["strokes"] = strokes
    return result


def zigzag(x, z, y, step):
    """There and back over a rectangle of half sizes x and z."""
    path, side, at = [], 1, -x
    while at <= x + 1e-9:
        path += [(at, y, -side * z), (at, y, side * z)]
        side, at = -side, at + step
    return path


def solver(spacing, substeps=4, iterations=4, **more):
    return dict({"particle_spacing": spacing, "substeps": substeps, "iterations": iterations}, **more)


OAK = material("wood", "Wood", "oak")
WATER = material("water", "Water")


def table_and_water():
    d = 0.02
    table = [stroke("cube", 0.03, (0.23, 0.03, 0.23), (0.23, 0.37, 0.23), turns=4),
             stroke("cube", 0.03, *zigzag(0.27, 0.27, 0.41, 0.05)),
             stroke("plane", 0.32, (0, 0.43, 0), erase=True)]  # made flat
    bowl = [stroke("disc", 0.15, (0, 0.43, 0), (0, 0.45, 0)),
            stroke("tube", 0.15, (0, 0.47, 0), (0, 0.63, 0), wall=2)]
    water = [stroke("disc", 0.105, (0, 0.47, 0), (0, 0.57, 0))]
    return project(
        "Table and water",
        "A table is drawn with four legs at once, its top with a thick brush and then made flat by the eraser. On it stands "
        "a tube with a bottom, and in it water. Move the table, and see what becomes of the water.",
        [OAK, material("tin", "Tin"), WATER],
        [drawn("table", "Table", "oak", table, d, holds="rigid"), drawn("bowl", "Bowl", "tin", bowl, d, holds="rigid"),
         drawn("water", "Water", "water", water, d)],
        tray(0.5, 0.5), ((-0.6, -0.1, -0.6), (0.6, 1.2, 0.6)), solver(d, 8),
        [probe("Water", "position_y_min", "lowest", body="water"), probe("Table", "height", "table", body="table"),
         probe("Bowl", "height", "bowl", body="bowl")],
        20, view((0, 0.33, 0), 1.9, 30, 18, "material", ["scene/gravity", "material/water/viscosity"]))


def tree():
    d = 0.02
    low = [(0, 0.4, 0), (0.1, 0.5, 0.01), (0.2, 0.6, 0)]
    high = [(0, 0.5, 0), (0.07, 0.64, 0.03), (0.1, 0.74, 0.06)]
    strokes = [stroke("sphere", 0.07, (0, 0.01, 0), (0, 0.2, 0, 0.5), (0.01, 0.6, 0, 0.1), pressure_size=0.8),
               stroke("sphere", 0.025, (0, 0.03, 0), (0.12, 0.01, 0.02), turns=5),
               stroke("sphere", 0.025, *low, turns=5), stroke("sphere", 0.022, *high, turns=3),
               stroke("sphere", 0.075, (0.2, 0.66, 0), (0.23, 0.64, 0.03), palette=1, turns=5),
               stroke("sphere", 0.085, (0, 0.8, 0), palette=1),
               stroke("sphere", 0.07, (0.12, 0.78, 0.06), palette=1, turns=3)]
    rain = [stroke("spray", 0.3, (-0.1, 1.15, 0), (0.1, 1.15, 0), flow=0.006)]
    wood = drawn("tree", "Tree", "oak", strokes, d, also=["leaves"], fixed=True)
    return project(
        "Tree in the rain",
        "Trunk, roots and boughs are drawn with a pen that presses less and less, five boughs at once, and leaves of another "
        "matter on them: one body of two materials. Rain falls on it, drawn with the spray.",
        [OAK, material("jelly", "Leaves", "leaves", color_red=0.25, color_green=0.52, color_blue=0.18), WATER],
        [wood, drawn("rain", "Rain", "water", rain, d)],
        tray(0.45, 0.45), ((-0.55, -0.1, -0.55), (0.55, 1.5, 0.55)), solver(d, 8),
        [probe("Tree", "height_max", "top", body="tree"), probe("Rain", "position_y_min", "rain", body="rain")],
        20, view((0, 0.5, 0), 2.2, 25, 12, "material", ["material/water/viscosity", "scene/gravity"]))


def pail_and_pulley():
    d = 0.02
    at = lambda i, j, k: ((i + 0.5) * d, (j + 0.5) * d, (k + 0.5) * d)
    line = lambda *cells, **more: stroke("particle", d, *[at(*cell) for cell in cells], **more)
    across = {"up": (0, 0, 1)}
    pulley = [stroke("disc", 6.1 * d, at(0, 36, -1), at(0, 36, 1), **across),
              stroke("disc", 8.1 * d, at(0, 36, -1), **across), stroke("disc", 8.1 * d, at(0, 36, 1), **across)]
    rope = [line((-7, 23, 0), (-7, 43, 0), (7, 43, 0), (7, 7, 0)),
            stroke("plane", 1.5 * d, at(-7, 23, 0)), stroke("plane", 1.5 * d, at(7, 7, 0))]  # the knots
    pail = [stroke("plane", 4.5 * d, at(-7, 15, 0)),
            stroke("line", 4.5 * d, at(-7, 16, 4), at(-7, 22, 4), turns=4, centre=at(-7, 0, 0)),
            line((-8, 22, 4), (-8, 24, 4), (-8, 24, -4), (-8, 22, -4)),
            line((-6, 22, 4), (-6, 24, 4), (-6, 24, -4), (-6, 22, -4)),
            line((-7, 22, 4), (-7, 24, 4), (-7, 24, 1)), line((-7, 22, -4), (-7, 24, -4), (-7, 24, -1))]
    weight = [stroke("cube", 2.5 * d, at(7, 8, 0)), stroke("plane", 1.5 * d, at(7, 6, 0), at(7, 7, 0), erase=True),
              line((7, 8, 0), (7, 10, 0), erase=True)]
    walls = [wall("floor", "Floor", (0, 0, 0), (0, 1, 0), friction=0.5)]
    for key, name, point, normal in (("left", "Left side", (-0.44, 0, 0), (1, 0, 0)),
                                     ("right", "Right side", (0.44, 0, 0), (-1, 0, 0)),
                                     ("back", "Back", (0, 0, -0.26), (0, 0, 1)),
                                     ("front", "Front", (0, 0, 0.26), (0, 0, -1))):
        walls.append(wall(key, name, point, normal, friction=0.5))
    rope = drawn("rope", "Rope", "hemp", rope, d)
    rope["constraints"] = [{"plugin": "rope",
                            "parameters": {"bend_stiffness": 5, "damping": 0.002, "stretch_stiffness": 30000}}]
    return project(
        "Pail and pulley, sketched",
        "A pulley of three discs, a rope that is one line with two knots, a pail whose four sides are one stroke, and a "
        "stone that was hollowed by the eraser. A tap fills the pail until it outweighs the stone.",
        [WATER, OAK, material("iron", "Greased iron", friction_kinetic=0.02, friction_static=0.02),
         material("iron", "Stone", "stone", density_solid=2700, color_red=0.45, color_green=0.44, color_blue=0.42),
         material("hemp", "Hemp", density_solid=3000, friction_kinetic=0.05, friction_static=0.05)],
        [drawn("pulley", "Pulley", "iron", pulley, d, fixed=True),
         box("stand", "Stand", "oak", (0, 0.37, -0.14), (0.04, 0.74, 0.04), ROOM, fixed=True),
         box("axle", "Axle", "oak", (0, 0.72, -0.07), (0.04, 0.04, 0.1), ROOM, fixed=True),
         rope, drawn("pail", "Pail", "oak", pail, d, holds="rigid"),
         drawn("weight", "Stone", "stone", weight, d, holds="rigid")],
        walls, ((-0.5, -0.05, -0.32), (0.5, 1.2, 0.32)), solver(d, 16, 8, damping=0.3),
        [probe("Pail", "height", "pail", body="pail"), probe("Stone", "height", "stone", body="weight"),
         probe("Water", "mass", "water", body="tap")],
        20, view((0, 0.45, 0), 1.75, 25, 10, "material", ["emitter/tap/speed", "material/stone/density_solid",
                                                         "scene/gravity"]),
        emitters=[{"id": "tap", "name": "Tap", "material": "water", "point": [-0.18, 0.64, 0.01],
                   "direction": [0, -1, 0], "speed": 0.9, "diameter": 0.02257, "temperature": ROOM, "most": 330,
                   "start": 1, "stop": 30}])


def leaking_container():
    d = 0.02
    stand = [stroke("disc", 0.11, (0, 0.01, 0), (0, 0.25, 0))]
    vessel = [stroke("disc", 0.17, (0, 0.27, 0), (0, 0.29, 0)),
              stroke("tube", 0.17, (0, 0.31, 0), (0, 0.67, 0), wall=2),
              stroke("sphere", 0.03, (0.2, 0.35, 0.01), (0.11, 0.35, 0.01), erase=True),
              stroke("sphere", 0.03, (0.01, 0.45, 0.2), (0.01, 0.45, 0.11), erase=True)]
    water = [stroke("disc", 0.125, (0, 0.31, 0), (0, 0.61, 0))]
    return project(
        "Leaking container",
        "A container is drawn and filled, and the eraser makes two holes in its wall. The lower jet goes farther, as long "
        "as there is water above it: the speed follows the square root of the depth (Torricelli).",
        [OAK, material("tin", "Tin"), WATER],
        [drawn("stand", "Stand", "oak", stand, d, fixed=True), drawn("vessel", "Container", "tin", vessel, d, fixed=True),
         drawn("water", "Water", "water", water, d)],
        tray(0.6, 0.6), ((-0.7, -0.1, -0.7), (0.7, 1.2, 0.7)), solver(d),
        [probe("Water", "position_y_max", "level", body="water"), probe("Water", "height", "height", body="water")],
        20, view((0, 0.3, 0), 2.1, 40, 18, "material", ["material/water/viscosity", "scene/gravity"]))


def river():
    d, wide = 0.03, 0.36
    layers = [stroke("line", wide, (-0.885, d * (k + 0.5), 0), (0.885 if k < 5 else 0.165, d * (k + 0.5), 0),
                     rotation=1.5707963267949) for k in range(12)]
    bends = lambda x: 0.14 * (1 if int(x // 0.18) % 2 else -1)
    upper = [(0.18 * k - 0.89, 0.38 - 0.012 * k, 0.5 * bends(0.18 * k)) for k in range(7)]
    lower = [(0.18, 0.17, upper[-1][2]), (0.4, 0.16, 0.12), (0.62, 0.15, -0.1), (0.89, 0.14, 0)]
    carved = [stroke("sphere", 0.11, *upper, erase=True), stroke("sphere", 0.1, *lower, erase=True)]
    return project(
        "River, sketched",
        "Ground is heaped up in sheets, each drawn with a line, and the eraser digs a bed that winds. A spring feeds the "
        "river, which falls over the edge. Dig it another bed while it flows.",
        [material("lava", "Ground", "ground", color_red=0.42, color_green=0.36, color_blue=0.28), WATER],
        [drawn("ground", "Ground", "ground", layers + carved, d, fixed=True)],
        tray(1.2, 0.4), ((-1.25, -0.1, -0.45), (1.25, 1.2, 0.45)), solver(d),
        [probe("Water", "liquid_mass", "water"), probe("Spring", "mass", "spring", body="spring")],
        30, view((0, 0.2, 0), 3, 20, 28, "material", ["emitter/spring/speed", "material/water/viscosity"]),
        emitters=[{"id": "spring", "name": "Spring", "material": "water", "point": [-0.8, 0.44, -0.07],
                   "direction": [1, -0.6, 0], "speed": 0.7, "diameter": 0.12, "temperature": 283.15, "most": 9000}],
        sinks=[{"id": "mouth", "name": "River mouth", "minimum": [0.95, -0.1, -0.45], "maximum": [1.25, 1.2, 0.45]}])


SKETCHES = {
    "table-and-water": table_and_water,
    "tree-in-the-rain": tree,
    "pail-and-pulley-sketched": pail_and_pulley,
    "leaking-container": leaking_container,
    "river-sketched": river,
}

if __name__ == "__main__":
    for name in sys.argv[1:] or SKETCHES:
        path = ROOT / "projects" / "sketched" / (name + ".json")
        path.parent.mkdir(exist_ok=True)
        undrawn = path.with_suffix(".undrawn.json")
        write(undrawn, SKETCHES[name]())
        try:
            subprocess.run([PROGRAM, "redraw", undrawn, "--out", path], check=True)
        finally:
            undrawn.unlink()
