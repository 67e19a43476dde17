# SPDX-License-Identifier: Apache-2.0
"""What make_thesis.py and make_samples.py share: the parts of a project, and its file as the editor would save it."""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "resources" / "models"))
import make_figure  # noqa: E402

WIDTH = 120


def material(base, label, key=None, **properties):
    result = {"base": base, "id": key or base, "label": label}
    return dict(result, properties=properties) if properties else result


def box(key, name, of, centre, size, temperature, **more):
    """A block; `holds` names what holds it together, everything else goes into the body as it stands."""
    holds = more.pop("holds", None)
    return dict({"id": key, "name": name, "material": of, "temperature": temperature,
                 "constraints": [{"plugin": holds}] if holds else [],
                 "shape": {"box": {"center": list(centre), "size": list(size)}}}, **more)


def sketched(key, name, of, runs, origin, spacing, temperature, **more):
    """A sketched body from the runs of its cells."""
    result = box(key, name, of, (0, 0, 0), (0, 0, 0), temperature, **more)
    result["shape"] = {"voxels": {"origin": list(origin), "spacing": spacing, "runs": runs,
                                  "palette": [{"material": of, "temperature": temperature}]}}
    return result


def cells_as_runs(inside, low, high, palette=0):
    """Runs along x of the cells (i, j, k) for which inside(i, j, k) holds; both bounds included."""
    runs = []
    for k in range(low[2], high[2] + 1):
        for j in range(low[1], high[1] + 1):
            for i in range(low[0], high[0] + 1):
                if not inside(i, j, k):
                    continue
                last = runs[-1] if runs else None
                if last and (last[1], last[2]) == (j, k) and last[0] + last[3] == i:
                    last[3] += 1
                else:
                    runs.append([i, j, k, 1, palette])
    return runs


def figure(key, name, of, height, spacing, temperature, at=(0, 0, 0), **more):
    """The rabbit of resources/models, `height` m high; `at` is the middle of what it stands on."""
    origin = (at[0], at[1] + 0.5 * spacing, at[2])
    return sketched(key, name, of, make_figure.runs(spacing / height), origin, spacing, temperature, **more)


def wall(key, name, point, normal, temperature=None, **more):
    result = {"id": key, "name": name, "point": list(point), "normal": list(normal)}
    if temperature is not None:
        result.update(heat="fixed_temperature", temperature=temperature)
    return dict(result, **more)


def tray(x, z, floor=None, lid=None, floor_name="Floor", lid_name="Lid", lid_height=None, friction=0.05):
    """Floor, four sides at ±x and ±z that let no heat through, and a lid if `lid_height` says where; temperatures in
    K, None for a wall that lets no heat through."""
    walls = [wall("floor", floor_name, (0, 0, 0), (0, 1, 0), floor, friction=0.3)]
    for key, name, point, normal in (("left", "Left side", (-x, 0, 0), (1, 0, 0)),
                                     ("right", "Right side", (x, 0, 0), (-1, 0, 0)),
                                     ("back", "Back", (0, 0, -z), (0, 0, 1)),
                                     ("front", "Front", (0, 0, z), (0, 0, -1))):
        walls.append(wall(key, name, point, normal, friction=friction))
    if lid_height is not None:
        walls.append(wall("lid", lid_name, (0, lid_height, 0), (0, -1, 0), lid, friction=friction))
    return walls


def probe(name, quantity, key=None, **more):
    return dict({"id": key or quantity, "name": name, "quantity": quantity}, **more)


PHASES = [probe("Ice", "solid_mass"), probe("Melting", "melting_mass"), probe("Water", "liquid_mass"),
          probe("Boiling", "boiling_mass"), probe("Steam", "gas_mass")]


def view(target, distance, azimuth=30, elevation=15, colour="temperature", pinned=()):
    return {"target": list(target), "distance": distance, "azimuth": azimuth, "elevation": elevation, "colour": colour,
            "pinned": list(pinned)}


def project(title, description, materials, bodies, walls, bounds, solver, probes, duration, seen, **more):
    environment = {"gravity": [0, -9.81, 0], "bounds": {"minimum": list(bounds[0]), "maximum": list(bounds[1])},
                   "walls": walls}
    environment.update(more.pop("environment", {}))
    plugins = sorted({m["base"] for m in materials} | {"enthalpy"}
                     | {c["plugin"] for b in bodies for c in b["constraints"]})
    return dict({"format": "phasesketch", "generator": "phasesketch 0.1.0", "version": 1, "title": title,
                 "description": description, "materials": materials, "bodies": bodies, "environment": environment,
                 "solver": dict(solver, thermal={"model": "enthalpy"}), "probes": probes, "duration": duration,
                 "view": seen, "pluginsUsed": plugins, "pluginsRequired": plugins}, **more)


def _text(value, indent, column):
    line = json.dumps(value, ensure_ascii=False)
    if not isinstance(value, (dict, list)) or not value:
        return line
    if isinstance(value, list) and '{' not in line and column + len(line) <= WIDTH - 2:
        return line
    margin = " " * (indent + 2)
    if isinstance(value, dict):
        parts = []
        for key in sorted(value):
            head = json.dumps(key) + ": "
            parts.append(margin + head + _text(value[key], indent + 2, indent + 2 + len(head)))
        return "{\n" + ",\n".join(parts) + "\n" + " " * indent + "}"
    if all(isinstance(item, list) for item in value):  # runs of cells: as many on a line as fit
        lines = [margin]
        for item in value:
            word = json.dumps(item) + ", "
            if len(lines[-1]) + len(word) > WIDTH and lines[-1] != margin:
                lines.append(margin)
            lines[-1] += word
        return "[\n" + "\n".join(text.rstrip() for text in lines).rstrip(",") + "\n" + " " * indent + "]"
    return "[\n" + ",\n".join(margin + _text(item, indent + 2, indent + 2) for item in value) + "\n" + " " * indent + "]"


def rounded(value):
    """Numbers to 12 digits, so that 0.1 + 0.2 is written 0.3; whole ones without a point."""
    if isinstance(value, float):
        value = float("%.12g" % value)
        return int(value) if value == int(value) and abs(value) < 1e15 else value
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return [rounded(item) for item in value] if isinstance(value, (list, tuple)) else value


def write(path, what):
    path.write_text(_text(rounded(what), 0, 0) + "\n", encoding="utf-8")
