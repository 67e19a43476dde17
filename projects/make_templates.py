#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes projects/templates: scenes to begin with, as plain as can be. Run by hand; every run gives the same bytes.

    make_templates.py [NAME ...]
"""
import math
import sys

from make_samples import ROOM, solver, tap
from scenewriter import PHASES, ROOT, box, cells_as_runs, material, probe, project, sketched, tray, view, wall, write


def tank_of_water():
    d = 0.02
    return project(
        "Tank of water", "A tank of 70 × 40 cm with water of 20 °C in it.",
        [material("water", "Water")],
        [box("water", "Water", "water", (0, 0.1, 0), (0.68, 0.2, 0.38), ROOM)],
        tray(0.35, 0.2), ((-0.5, -0.1, -0.4), (0.5, 1, 0.4)), solver(d, 100),
        [probe("Water", "temperature", body="water"), probe("Water", "height_max", "height", body="water")], 60,
        view((0, 0.16, 0), 1.5, 30, 18, "material", ["material/water/viscosity", "scene/gravity"]))


def cloth_on_a_line():
    d = 0.02
    top = 0.78
    cloth = box("cloth", "Cloth", "cotton", (0, 0.55, 0), (0.5, 0.5, 0.02), ROOM, phase="solid",
                velocity=[0, 0, 2], pins=[{"minimum": [-1, top, -1], "maximum": [1, 2, 1]}])
    cloth["constraints"] = [{"plugin": "cloth", "parameters": {"bend_stiffness": 10, "damping": 0.002}}]
    return project(
        "Cloth on a line",
        "A cotton cloth of 50 × 50 cm hangs from a line that nobody sees, and swings.",
        [material("cotton", "Cotton")], [cloth],
        [wall("floor", "Floor", (0, 0, 0), (0, 1, 0), friction=0.3)], ((-0.8, -0.1, -0.8), (0.8, 1.4, 0.8)),
        solver(d, 1, 8, 2), [probe("Cloth", "position_z", "cloth", body="cloth")], 30,
        view((0, 0.45, 0), 1.9, 50, 12, "material", ["constraint/cloth/cloth/stretch_stiffness", "scene/gravity"]))


def hot_plate():
    return project(
        "Hot plate and cold lid",
        "A tray with a floor of 147 °C and a lid of 5 °C over it, and nothing in between yet. Press B and draw.",
        [material("water", "Water"), material("wax", "Wax")], [],
        tray(0.3, 0.3, 420, 278.15, "Hot plate", "Cold lid", 0.5), ((-0.4, -0.1, -0.4), (0.4, 0.6, 0.4)),
        solver(0.02, 1000), [probe("All", "temperature")] + PHASES, 60,
        view((0, 0.2, 0), 1.6, 30, 20, "temperature", ["wall/floor/temperature", "wall/lid/temperature",
                                                       "solver/thermal_time_scale"]))


def tap_and_bowl():
    d = 0.015
    inner, outer = 9.5, 11.5
    def in_bowl(i, j, k):
        distance = math.sqrt(i * i + (j - 12) * (j - 12) + k * k)
        return inner <= distance < outer and j <= 12
    bowl = cells_as_runs(in_bowl, (-12, 0, -12), (12, 12, 12))
    return project(
        "Tap and bowl",
        "Water of 60 °C from a tap falls into a bowl of wood, which fills and runs over.",
        [material("water", "Water"), material("wood", "Wood")],
        [sketched("bowl", "Bowl", "wood", bowl, (0, 0.5 * d, 0), d, ROOM, fixed=True, phase="solid")],
        [wall("floor", "Floor", (0, 0, 0), (0, 1, 0), friction=0.3)], ((-0.5, -0.1, -0.5), (0.5, 0.7, 0.5)),
        solver(d, 10), [probe("Water", "temperature", "temperature", material="water"),
                        probe("Water", "mass", "mass", material="water")], 60,
        view((0, 0.15, 0), 1.2, 30, 22, "material", ["emitter/tap/speed", "emitter/tap/temperature"]),
        emitters=[tap("tap", "Tap", "water", (0, 0.45, 0), 333.15, 0.6, 0.06, most=12000)])


TEMPLATES = {"tank-of-water": tank_of_water, "cloth-on-a-line": cloth_on_a_line, "hot-plate": hot_plate,
             "tap-and-bowl": tap_and_bowl}

if __name__ == "__main__":
    for name in sys.argv[1:] or TEMPLATES:
        write(ROOT / "projects" / "templates" / (name + ".json"), TEMPLATES[name]())
