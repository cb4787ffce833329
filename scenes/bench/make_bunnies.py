#!/usr/bin/env python3
"""Writes three bunnies on a floor under a lamp into FOLDER, for benchmarks: bunny.ply out of a PLY file, such as
Stanford's bun_zipper.ply or what ./dev models finds, and three_bunnies.json.

    scenes/bench/make_bunnies.py bun_zipper.ply FOLDER
"""

import argparse
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from placing import placed  # noqa: E402
from ply import read_ply, write_ply  # noqa: E402

SCENE = {
    "camera": {"look_from": [0, 1.1, 3.2], "look_at": [0, 0.42, 0], "fov": 35},
    "materials": {
        "floor": {"type": "lambertian", "kd": 0.6},
        "lamp": {"type": "emitter", "emission": 18, "double_sided": False},
        "red": {"type": "lambertian", "kd": [0.6, 0.2, 0.1]},
        "white": {"type": "lambertian", "kd": 0.7},
        "blue": {"type": "plastic", "kd": [0.15, 0.35, 0.65], "ks": 0.15},
    },
    "objects": [
        {"type": "quad", "name": "floor", "corners": [[-4, 0, -3], [4, 0, -3], [-4, 0, 3]], "material": "floor"},
        {"type": "quad", "name": "lamp", "corners": [[-0.6, 2.5, 0.6], [0.6, 2.5, 0.6], [-0.6, 2.5, -0.6]],
         "material": "lamp"},
    ],
    "environment": {"color": [0.1, 0.12, 0.15]},
}
BUNNIES = [("red", -25, (-0.66, 0, -0.3)), ("white", 20, (0.05, 0, 0.35)), ("blue", 160, (0.66, 0, -0.3))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bunny", type=Path)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    positions, triangles = read_ply(arguments.bunny)
    write_ply(arguments.folder / "bunny.ply", placed("bunny", positions), triangles)
    # Three objects rather than three instances: as many triangles as there seem to be.
    for material, angle, place in BUNNIES:
        SCENE["objects"].append({"type": "ply", "name": material, "file": "bunny.ply", "normals": "smooth",
                                 "material": material,
                                 "transform": [{"scale": 0.75}, {"rotate_y": angle}, {"translate": list(place)}]})
    output = arguments.folder / "three_bunnies.json"
    output.write_text(json.dumps(SCENE, indent=2) + "\n")
    print(f"{output}: {3 * len(triangles) + 4:,} triangles")


main()
