#!/usr/bin/env python3
"""Writes stand-ins for the Stanford models into a folder: a rabbit and a dragon of our own, with as many triangles.

usage: make_stand_ins.py FOLDER [NAME...]       names: bunny_948 bunny_3851 bunny_16301 bunny dragon (default: all)

Closed surfaces, +Y up, facing -X like the originals, standing on y = 0. The rabbit is 1 high, the dragon 1 long.
"""

import sys
from pathlib import Path

from decimate import decimated
from isosurface import Body, is_closed, surface_net
from placing import placed
from ply import write_ply
from shapes import smooth_curve


def rabbit():
    body = Body(blend=0.06, ripple=0.0035, waves=46)
    body.add((0.16, 0.29, 0, 0.26), (-0.1, 0.33, 0, 0.21), (-0.26, 0.4, 0, 0.14))  # trunk, chest
    body.add((-0.3, 0.58, 0, 0.15), (-0.43, 0.53, 0, 0.095))  # head, muzzle
    body.add((-0.515, 0.545, 0, 0.02))  # nose
    body.add_pair((-0.4, 0.53, 0.075, 0.065))  # cheeks
    body.add_pair((-0.405, 0.625, 0.085, 0.03))  # eyes
    body.add_pair((-0.26, 0.69, 0.055, 0.035), (-0.19, 0.82, 0.085, 0.06), (-0.08, 0.97, 0.11, 0.022))  # ears
    body.add_pair((0.18, 0.2, 0.15, 0.16))  # haunches
    body.add_pair((0.16, 0.055, 0.2, 0.055), (-0.06, 0.05, 0.22, 0.05))  # hind feet
    body.add_pair((-0.22, 0.26, 0.1, 0.08), (-0.3, 0.08, 0.1, 0.05), (-0.36, 0.045, 0.1, 0.045))  # forelegs
    body.add((0.43, 0.26, 0, 0.085))  # tail
    return body, (0, 0.3, 0)


STAND_IN = "stand-in"  # in the comment of their files
COARSE = 0.03  # cell of the first net

SPINE = [  # x, y, z, radius from the tip of the tail to the snout
    (0.4, 0.42, 0.16, 0.006), (0.47, 0.3, 0.17, 0.018), (0.44, 0.16, 0.13, 0.03), (0.33, 0.1, 0.05, 0.045),
    (0.19, 0.16, -0.04, 0.07), (0.05, 0.22, -0.05, 0.095), (-0.1, 0.2, 0, 0.1), (-0.22, 0.24, 0.04, 0.085),
    (-0.3, 0.36, 0.04, 0.06), (-0.26, 0.5, 0, 0.048), (-0.23, 0.6, -0.02, 0.045), (-0.29, 0.67, -0.02, 0.055),
    (-0.38, 0.66, -0.02, 0.042), (-0.46, 0.635, -0.02, 0.026)]
LEGS = [((-0.17, 0.2, 0.12), (-0.24, 0.1, 0.18)), ((-0.15, 0.2, -0.09), (-0.2, 0.1, -0.17)),
        ((0.15, 0.17, 0.05), (0.22, 0.09, 0.16)), ((0.13, 0.17, -0.12), (0.19, 0.1, -0.2))]


def dragon():
    body = Body(blend=0.022, ripple=0.0022, waves=110)
    spine = smooth_curve(SPINE, 4)
    body.add(*spine)
    for x, y, z, r in spine[6:44:2]:  # a crest
        lean = 0.35 * r
        body.add((x, y, z, 0.5 * r), (x + lean, y + 1.15 * r, z, 0.3 * r), (x + 2 * lean, y + 1.75 * r, z, 0.004))
    for (hx, hy, hz), (kx, ky, kz) in LEGS:
        out = 0.03 if hz > 0 else -0.03
        body.add((hx, hy, hz, 0.06), (kx, ky, kz, 0.038), (kx + 0.02, 0.035, kz + out, 0.026))
        for toe in (-0.03, 0, 0.03):
            body.add((kx + 0.02, 0.03, kz + out, 0.022), (kx - 0.06, 0.02, kz + out + toe, 0.013))
    body.add((-0.31, 0.63, -0.02, 0.035), (-0.4, 0.59, -0.02, 0.022), (-0.45, 0.575, -0.02, 0.014))  # lower jaw
    for side in (-1, 1):
        z = -0.02 + 0.035 * side
        body.add((-0.29, 0.7, z, 0.022), (-0.21, 0.76, z + 0.03 * side, 0.014), (-0.15, 0.77, z + 0.04 * side, 0.005))
        body.add((-0.37, 0.7, z, 0.014))  # eyes
        for reach in (0, 0.2, 0.4, 0.6, 0.8, 1):  # wings: fingers side by side, which run into each other
            tip = (-0.02 + 0.24 * reach, 0.52 - 0.12 * reach, (0.24 + 0.04 * reach) * side)
            body.add((-0.07, 0.24, 0.07 * side, 0.04), ((tip[0] - 0.07) / 2, 0.34, 0.16 * side, 0.03), (*tip, 0.018))
    return body, (-0.1, 0.2, 0)


def meshed(creature, wanted):
    """As many triangles as wanted: a net of some more, which a coarse one tells the cell for, then decimated. A net
    that touches itself is done again a little finer. An odd number leaves a closed surface open by one triangle, out of
    sight at the bottom."""
    body, inside = creature
    even = wanted + wanted % 2
    cell = COARSE
    cell *= (len(surface_net(body, inside, cell)[1]) / (1.015 * max(even, 6000))) ** 0.5
    for _ in range(20):
        positions, triangles = surface_net(body, inside, cell)
        if len(triangles) >= even and is_closed(triangles):
            break
        cell *= 0.995
    else:
        raise RuntimeError("no net is closed")
    positions, triangles = decimated(positions, triangles, even)
    if wanted % 2:
        triangles.remove(min(triangles, key=lambda t: sum(positions[v][1] for v in t)))
    return positions, triangles


MODELS = {"bunny_948": (rabbit, 948), "bunny_3851": (rabbit, 3851), "bunny_16301": (rabbit, 16301),
          "bunny": (rabbit, 69451), "dragon": (dragon, 47794)}


def write_stand_in(folder, name):
    creature, count = MODELS[name]
    positions, triangles = meshed(creature(), count)
    if len(triangles) != count:
        raise RuntimeError(f"{name}: {len(triangles)} triangles instead of {count}")
    write_ply(folder / f"{name}.ply", placed(name, positions), triangles, None, STAND_IN)


def main():
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= MODELS.keys():
        sys.exit(__doc__)
    for name in sys.argv[2:] or MODELS:
        write_stand_in(Path(sys.argv[1]), name)


if __name__ == "__main__":
    main()
