#!/usr/bin/env python3
"""Writes a ball of hair as a .glb, for benchmarks: about TRIANGLES slivers that lie across each other in all directions,
some eighty times as long as wide. Boxes around them are nearly empty.

    scenes/bench/make_hairball.py 600000 hairball.glb
"""

import argparse
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from gltf_writer import GltfScene, cross, normalized  # noqa: E402
from shapes import Mesh  # noqa: E402

SEGMENTS = 24  # of a hair
LENGTH, WIDTH = 0.08, 0.001  # of a segment, metres
CORE = 0.25  # radius where hairs begin
CURL = 0.35  # how much the direction changes from one segment to the next
PULL = 0.5  # towards the core; the ball stays a ball


def unit_vector(generator):
    z = generator.uniform(-1, 1)
    angle = generator.uniform(0, 2 * math.pi)
    ring = math.sqrt(1 - z * z)
    return (ring * math.cos(angle), ring * math.sin(angle), z)


def add_hair(mesh, generator):
    direction = unit_vector(generator)
    position = [CORE * x for x in direction]
    side = normalized(cross(direction, unit_vector(generator)))
    first = len(mesh.positions) // 3
    for i in range(SEGMENTS + 1):
        for sign in (-0.5, 0.5):
            mesh.positions.extend(p + sign * WIDTH * s for p, s in zip(position, side))
        if i == SEGMENTS:
            break
        position = [p + LENGTH * d for p, d in zip(position, direction)]
        noise = unit_vector(generator)
        out = math.dist(position, (0, 0, 0)) - CORE
        direction = normalized([d + CURL * n - PULL * out * LENGTH / CORE * p
                                for d, n, p in zip(direction, noise, position)])
        # The ribbon turns with its direction as little as it can.
        along = sum(s * d for s, d in zip(side, direction))
        side = normalized([s - along * d for s, d in zip(side, direction)])
    for i in range(SEGMENTS):
        a = first + 2 * i
        mesh.indices.extend((a, a + 1, a + 3, a, a + 3, a + 2))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triangles", type=int)
    parser.add_argument("output", type=Path)
    arguments = parser.parse_args()
    generator = random.Random(1)
    mesh = Mesh()
    for _ in range(max(1, round(arguments.triangles / (2 * SEGMENTS)))):
        add_hair(mesh, generator)
    scene = GltfScene()
    material = scene.add_material("hair", (0.35, 0.22, 0.12), roughness=0.6, doubleSided=True)
    scene.add_node("hairball", mesh=scene.add_mesh("hairball", mesh, material))
    scene.add_camera("camera", (0, 0.8, 5.2), (0, 0, 0), math.radians(40), 1)
    scene.save(arguments.output)
    print(f"{arguments.output}: {len(mesh.indices) // 3:,} triangles")


main()
