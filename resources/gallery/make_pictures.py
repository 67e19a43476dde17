#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of the samples and templates that the gallery shows, here. Run by hand after a sample
has changed; needs a built program, and some minutes.

    make_pictures.py [NAME ...]
"""
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PROGRAM = ROOT / "build" / "release" / "bin" / "phasesketch-cli"
SIZE = "480x384"  # twice what a card shows

# The frame at which each is most itself, and the colour where it is not the scene's own.
FRAMES = {
    "bronze-casting": 260, "box-tower": 30, "candle": 700, "dam-break": (40, "material"), "dry-ice": 240,
    "foundry": 420, "freezing-pond": 600, "gears-in-water": 120, "honey-coil": 240, "honey-column": 180,
    "ice-on-hot-plate": 400, "jelly-drop": 45, "kettle-with-lid": 500, "lava-over-ice": 300, "pail-and-pulley": 200,
    "pressure-cooker": 300, "river": 360, "rope-bridge": 70, "thaw-and-frost": 500, "wet-cloth": 150,
    "templates/tank-of-water": 20, "templates/cloth-on-a-line": 40, "templates/hot-plate": 1,
    "templates/tap-and-bowl": 240,
    "sketched/table-and-water": 60, "sketched/tree-in-the-rain": 30, "sketched/pail-and-pulley-sketched": 200,
    "sketched/leaking-container": 45, "sketched/river-sketched": 300,
}


def draw(name):
    frames, colour = FRAMES[name] if isinstance(FRAMES[name], tuple) else (FRAMES[name], None)
    picture = HERE / (pathlib.PurePath(name).name + ".jpg")
    subprocess.run([PROGRAM, "render", ROOT / "projects" / (name + ".json"), "--out", picture, "--size", SIZE,
                    "--frames", str(frames), "--quiet"] + (["--colour", colour] if colour else []), check=True)


if __name__ == "__main__":
    for each in sys.argv[1:] or FRAMES:
        draw(each)
