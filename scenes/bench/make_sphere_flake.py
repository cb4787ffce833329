#!/usr/bin/env python3
"""Writes Eric Haines' sphere flake (1987, "A Proposal for Standard Graphics Environments") as a JSON scene, for
benchmarks: real spheres, each with nine smaller ones on it, DEPTH times.

    scenes/bench/make_sphere_flake.py 5 sphere_flake.json       66,430 spheres
"""

import argparse
import json
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from gltf_writer import cross, normalized  # noqa: E402


def child_directions(axis):
    """Six around the equator of `axis` and three above it."""
    helper = (1, 0, 0) if abs(axis[0]) < 0.7 else (0, 1, 0)
    u = normalized(cross(axis, helper))
    v = cross(axis, u)
    for count, elevation, turn in ((6, 0, 0), (3, math.radians(50), math.radians(30))):
        for i in range(count):
            angle = 2 * math.pi * i / count + turn
            ring, height = math.cos(elevation), math.sin(elevation)
            yield normalized([ring * (math.cos(angle) * a + math.sin(angle) * b) + height * c
                              for a, b, c in zip(u, v, axis)])


def add_spheres(objects, center, radius, axis, depth):
    objects.append({"type": "sphere", "center": [round(x, 7) for x in center], "radius": round(radius, 8),
                    "material": f"level {depth % 2}"})
    if depth == 0:
        return
    for direction in child_directions(axis):
        distance = radius * 4 / 3
        add_spheres(objects, [c + distance * d for c, d in zip(center, direction)], radius / 3, direction, depth - 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("depth", type=int)
    parser.add_argument("output", type=Path)
    arguments = parser.parse_args()
    objects = [{"type": "plane", "point": [0, -1, 0], "normal": [0, 1, 0], "material": "floor"}]
    add_spheres(objects, (0, 0, 0), 1, (0, 1, 0), arguments.depth)
    scene = {
        "camera": {"look_from": [2, 2, 5.4], "look_at": [0, 0.25, 0], "fov": 40},
        "materials": {
            "floor": {"type": "lambertian", "kd": 0.5},
            "level 0": {"type": "plastic", "kd": [0.5, 0.15, 0.1], "ks": 0.2},
            "level 1": {"type": "conductor", "metal": "silver", "roughness": 0.1},
        },
        "objects": objects,
        "lights": [{"type": "directional", "direction": [-1, -2, -1], "irradiance": 2}],
        "environment": {"color": [0.5, 0.6, 0.8]},
    }
    arguments.output.write_text(json.dumps(scene) + "\n")
    print(f"{arguments.output}: {len(objects) - 1:,} spheres")


main()
