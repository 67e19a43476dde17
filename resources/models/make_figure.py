#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A sitting rabbit as a signed distance, and what is made of it: the mesh rabbit.obj and the cells of sketched bodies.

The figure is ours: ellipsoids and capsules joined by a smooth union, of height 1, looking along +x, its feet on y = 0,
symmetric about z = 0. Run by hand when the figure changes, never by the build; every run gives the same bytes.

    make_figure.py [--out FILE] [--step STEP]

Scripts that make projects import it: `runs(spacing)` are the runs of a body's `voxels`. Needs only Python 3.9.
"""
import argparse
import math
import pathlib

HEIGHT = 1.0
LOW, HIGH = (-0.50, 0.0, -0.32), (0.50, 1.01, 0.32)  # a box around it


def ellipsoid(p, centre, radii, tilt=0.0):
    """Distance to an ellipsoid turned by `tilt` degrees about z, exact at its surface to first order."""
    x, y, z = p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]
    c, s = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    q = ((c * x + s * y) / radii[0], (c * y - s * x) / radii[1], z / radii[2])
    near = math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2])
    steep = math.sqrt(sum((q[a] / radii[a]) ** 2 for a in range(3)))
    return -min(radii) if steep == 0 else near * (near - 1) / steep


def capsule(p, a, b, radius_a, radius_b):
    """Distance to the line from a to b with a radius that changes along it."""
    ab = [b[k] - a[k] for k in range(3)]
    ap = [p[k] - a[k] for k in range(3)]
    t = max(0.0, min(1.0, sum(ap[k] * ab[k] for k in range(3)) / sum(k * k for k in ab)))
    return math.sqrt(sum((ap[k] - t * ab[k]) ** 2 for k in range(3))) - radius_a - t * (radius_b - radius_a)


def joined(a, b, width):
    """Union of two distances with a fillet of about `width`: a polynomial in their difference."""
    h = max(width - abs(a - b), 0.0) / width
    return min(a, b) - h * h * width * 0.25


def distance(x, y, z):
    """Signed distance to the rabbit, negative inside; exact at the surface up to the fillets."""
    z = abs(z)  # both sides alike
    p = (x, y, z)
    body = ellipsoid(p, (-0.09, 0.275, 0), (0.285, 0.235, 0.19), -20)
    body = joined(body, ellipsoid(p, (-0.20, 0.22, 0.095), (0.195, 0.205, 0.135), 10), 0.08)  # haunches
    body = joined(body, ellipsoid(p, (0.13, 0.31, 0), (0.13, 0.21, 0.14), 12), 0.10)  # chest
    body = joined(body, capsule(p, (-0.20, 0.05, 0.17), (0.07, 0.042, 0.19), 0.062, 0.045), 0.05)  # hind feet
    body = joined(body, capsule(p, (0.14, 0.26, 0.085), (0.20, 0.05, 0.085), 0.070, 0.042), 0.06)  # fore legs
    body = joined(body, ellipsoid(p, (0.24, 0.038, 0.085), (0.080, 0.045, 0.050)), 0.04)  # paws
    body = joined(body, ellipsoid(p, (-0.40, 0.19, 0), (0.085, 0.085, 0.080)), 0.03)  # tail
    head = ellipsoid(p, (0.22, 0.575, 0), (0.160, 0.130, 0.120), -18)
    head = joined(head, ellipsoid(p, (0.335, 0.535, 0), (0.080, 0.070, 0.068), -18), 0.06)  # muzzle
    head = joined(head, ellipsoid(p, (0.27, 0.520, 0.065), (0.080, 0.065, 0.058)), 0.05)  # cheeks
    head = joined(head, ellipsoid(p, (0.265, 0.625, 0.098), (0.030, 0.030, 0.026)), 0.012)  # eyes
    head = joined(head, ear(p), 0.045)
    whole = joined(body, head, 0.07)
    return max(whole, -y)  # stands flat


def ear(p):
    """A long leaf, bent outwards and back, hollowed along its front."""
    leaf = ellipsoid((p[0], p[1], p[2] - 0.055 - 0.16 * (p[1] - 0.66)), (0.095, 0.825, 0), (0.052, 0.190, 0.068), 24)
    hollow = ellipsoid((p[0], p[1], p[2] - 0.060 - 0.16 * (p[1] - 0.66)), (0.152, 0.840, 0), (0.028, 0.120, 0.032), 24)
    return -joined(-leaf, hollow, 0.02)


def cells(spacing):
    """Cells (i, j, k) of a lattice of `spacing` heights whose centres lie inside, cell (0, 0, 0) centred at
    (0, spacing/2, 0); sorted by z, y, x."""
    low = [math.floor(LOW[a] / spacing) for a in range(3)]
    high = [math.ceil(HIGH[a] / spacing) for a in range(3)]
    return [(i, j, k)
            for k in range(low[2], high[2] + 1) for j in range(0, high[1] + 1) for i in range(low[0], high[0] + 1)
            if distance(i * spacing, (j + 0.5) * spacing, k * spacing) < 0]


def runs(spacing, palette=0):
    """The same cells as the runs [x, y, z, length, palette] of a sketched body."""
    result = []
    for i, j, k in cells(spacing):
        last = result[-1] if result else None
        if last and (last[1], last[2]) == (j, k) and last[0] + last[3] == i:
            last[3] += 1
        else:
            result.append([i, j, k, 1, palette])
    return result


CORNERS = [(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8) if bin(a ^ b).count("1") == 1]


def mesh(step):
    """Surface nets (Gibson 1998): one vertex in each cell of a grid that the surface passes, four of them around every
    crossed edge of the grid, split along the shorter diagonal. Returns points and triangles, anticlockwise from
    outside."""
    count = [math.ceil((HIGH[a] - LOW[a]) / step) + 4 for a in range(3)]
    origin = [LOW[0] - 1.5 * step, -1.63 * step, LOW[2] - 1.41 * step]  # no grid point on the plane of symmetry
    at = lambda n: tuple(origin[a] + n[a] * step for a in range(3))
    value = {}
    for k in range(count[2]):
        for j in range(count[1]):
            for i in range(count[0]):
                value[i, j, k] = distance(*at((i, j, k)))
    points, index = [], {}
    for cell in sorted(value, key=lambda n: (n[2], n[1], n[0])):
        corners = [tuple(cell[a] + c[a] for a in range(3)) for c in CORNERS]
        if any(c not in value for c in corners):
            continue
        inside = [value[c] < 0 for c in corners]
        if all(inside) or not any(inside):
            continue
        crossings = []
        for a, b in EDGES:
            if inside[a] != inside[b]:
                t = value[corners[a]] / (value[corners[a]] - value[corners[b]])
                pa, pb = at(corners[a]), at(corners[b])
                crossings.append([pa[x] + t * (pb[x] - pa[x]) for x in range(3)])
        index[cell] = len(points)
        points.append([sum(c[x] for c in crossings) / len(crossings) for x in range(3)])
    triangles = []
    for n in sorted(value, key=lambda n: (n[2], n[1], n[0])):
        for axis in range(3):
            other = tuple(n[a] + (a == axis) for a in range(3))
            if other not in value or (value[n] < 0) == (value[other] < 0):
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            around = [index[tuple(n[a] - (a == u) * du - (a == v) * dv for a in range(3))]
                      for du, dv in ((1, 1), (0, 1), (0, 0), (1, 0))]
            if value[n] >= 0:
                around.reverse()
            far = lambda a, b: sum((points[around[a]][x] - points[around[b]][x]) ** 2 for x in range(3))
            first = 0 if far(0, 2) <= far(1, 3) else 1
            q = [around[(first + m) % 4] for m in range(4)]
            triangles += [(q[0], q[1], q[2]), (q[0], q[2], q[3])]
    return points, triangles


def check(triangles):
    """A closed surface passes each edge once in either direction."""
    edges = set()
    for t in triangles:
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            assert (a, b) not in edges, "an edge has more than two triangles; take another step"
            edges.add((a, b))
    assert all((b, a) in edges for a, b in edges), "the surface is open"


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=here / "rabbit.obj")
    parser.add_argument("--step", type=float, default=0.027, help="edge of the grid, in heights of the figure")
    arguments = parser.parse_args()
    points, triangles = mesh(arguments.step)
    check(triangles)
    lines = ["# A sitting rabbit, made by make_figure.py; height 1, looking along +x, feet on y = 0",
             "# SPDX-License-Identifier: Apache-2.0", "o rabbit"]
    lines += ["v %.5f %.5f %.5f" % tuple(p) for p in points]
    lines += ["f %d %d %d" % tuple(a + 1 for a in t) for t in triangles]
    arguments.out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{arguments.out}: {len(points)} points, {len(triangles)} triangles")


if __name__ == "__main__":
    main()
