#!/usr/bin/env python3
"""Writes a terrain of about TRIANGLES triangles as a .glb, for benchmarks: the same hills, whatever their resolution.

    scenes/bench/make_terrain.py 1000000 terrain.glb
"""

import argparse
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from gltf_writer import GltfScene  # noqa: E402
from shapes import Mesh  # noqa: E402

EXTENT = 10.0  # edge of the square, metres
WAVES = [(0.55, 0.9, 0.4, 0.0), (0.30, -0.7, 1.6, 1.0), (0.14, 2.3, 2.9, 2.0), (0.06, -5.1, 4.3, 0.5),
         (0.02, 11.0, -13.0, 1.7)]  # height, wave vector x and z (1/m), phase


def add_row(mesh, z, v, columns):
    """Vertices of one z. sin(a + b) is taken apart, so that a vertex costs no sines of its own."""
    rows = [(amplitude, kx, kz, math.sin(kz * z + phase), math.cos(kz * z + phase))
            for amplitude, kx, kz, phase in WAVES]
    for x, u, angles in columns:
        height = slope_x = slope_z = 0.0
        for (amplitude, kx, kz, sin_z, cos_z), (sin_x, cos_x) in zip(rows, angles):
            height += amplitude * (sin_x * cos_z + cos_x * sin_z)
            slope = amplitude * (cos_x * cos_z - sin_x * sin_z)
            slope_x += kx * slope
            slope_z += kz * slope
        scale = 1 / math.sqrt(slope_x * slope_x + 1 + slope_z * slope_z)
        mesh.positions.extend((x, height, z))
        mesh.normals.extend((-slope_x * scale, scale, -slope_z * scale))
        mesh.uvs.extend((u, v))


def terrain(triangles):
    cells = math.ceil(math.sqrt(triangles / 2))
    mesh = Mesh()
    columns = []
    for column in range(cells + 1):
        x = EXTENT * (column / cells - 0.5)
        columns.append((x, column / cells, [(math.sin(kx * x), math.cos(kx * x)) for _, kx, _, _ in WAVES]))
    for row in range(cells + 1):
        add_row(mesh, EXTENT * (0.5 - row / cells), 1 - row / cells, columns)
    for row in range(cells):
        first, above = row * (cells + 1), (row + 1) * (cells + 1)
        for column in range(cells):
            a, d = first + column, above + column
            mesh.indices.extend((a, a + 1, d + 1, a, d + 1, d))
    return mesh


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triangles", type=int)
    parser.add_argument("output", type=Path)
    arguments = parser.parse_args()
    if arguments.triangles < 2:
        parser.error("at least 2 triangles")
    mesh = terrain(arguments.triangles)
    scene = GltfScene()
    material = scene.add_material("ground", (0.45, 0.40, 0.32), roughness=0.8)
    scene.add_node("terrain", mesh=scene.add_mesh("terrain", mesh, material))
    scene.add_camera("camera", (0, 4, 9), (0, 0, 0), math.radians(45), 1)
    scene.save(arguments.output)
    print(f"{arguments.output}: {len(mesh.indices) // 3:,} triangles")


main()
