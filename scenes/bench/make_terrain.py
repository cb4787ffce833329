#!/usr/bin/env python3
"""Writes a terrain of about TRIANGLES triangles as a .glb, to time loading and BVH building. Not a picture to keep.

    scenes/bench/make_terrain.py 1000000 terrain.glb
"""

import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from gltf_writer import GltfScene, normalized  # noqa: E402
from shapes import Mesh  # noqa: E402

EXTENT = 10.0  # edge of the square, metres
WAVES = [(0.55, 0.9, 0.4, 0.0), (0.30, -0.7, 1.6, 1.0), (0.14, 2.3, 2.9, 2.0), (0.06, -5.1, 4.3, 0.5),
         (0.02, 11.0, -13.0, 1.7)]  # height, wave vector x and z (1/m), phase


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triangles", type=int)
    parser.add_argument("output", type=Path)
    arguments = parser.parse_args()
    if arguments.triangles < 2:
        parser.error("at least 2 triangles")
    cells = math.ceil(math.sqrt(arguments.triangles / 2))

    mesh = Mesh()

    def vertex(row, column):
        x, z = EXTENT * (column / cells - 0.5), EXTENT * (0.5 - row / cells)
        height, slope_x, slope_z = 0.0, 0.0, 0.0
        for amplitude, kx, kz, phase in WAVES:
            angle = kx * x + kz * z + phase
            height += amplitude * math.sin(angle)
            slope_x += amplitude * kx * math.cos(angle)
            slope_z += amplitude * kz * math.cos(angle)
        return (x, height, z), normalized((-slope_x, 1, -slope_z)), (column / cells, 1 - row / cells)

    mesh.add_grid(cells + 1, cells + 1, vertex)
    scene = GltfScene()
    material = scene.add_material("ground", (0.45, 0.40, 0.32), roughness=0.8)
    scene.add_node("terrain", mesh=scene.add_mesh("terrain", mesh, material))
    scene.add_camera("camera", (0, 4, 9), (0, 0, 0), math.radians(45), 1)
    scene.save(arguments.output)
    print(f"{arguments.output}: {len(mesh.indices) // 3:,} triangles")


main()
