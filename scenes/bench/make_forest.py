#!/usr/bin/env python3
"""Writes a forest into FOLDER, for benchmarks: two kinds of trees (.glb), and forest.json, in which they stand TREES
times. Every leaf is a pair of triangles: 25000 trees are more than 100 million.

    scenes/bench/make_forest.py 25000 FOLDER
"""

import argparse
import json
import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from gltf_writer import GltfScene, cross, normalized  # noqa: E402
from shapes import Mesh  # noqa: E402

SPACING = 2.2  # metres between trees, about
LEAVES = {"oak": 2600, "fir": 2200}


def add_leaf(mesh, generator, center, outward, length):
    """A rhombus that looks outwards, more or less."""
    normal = normalized([o + generator.gauss(0, 0.5) for o in outward])
    along = normalized(cross(normal, [generator.gauss(0, 1) for _ in range(3)]))
    across = cross(normal, along)
    first = len(mesh.positions) // 3
    for a, b in ((-0.5, 0), (0, -0.25), (0.5, 0), (0, 0.25)):
        mesh.positions.extend(c + length * (a * u + b * v) for c, u, v in zip(center, along, across))
    mesh.indices.extend((first, first + 1, first + 2, first, first + 2, first + 3))


def oak_leaves(mesh, generator):
    for _ in range(LEAVES["oak"]):
        direction = normalized([generator.gauss(0, 1) for _ in range(3)])
        radius = 1.3 * generator.random() ** 0.25  # most are outside
        center = [radius * x for x in direction]
        center[1] = 2.9 + 1.1 * center[1]
        add_leaf(mesh, generator, center, direction, 0.16)


def fir_needles(mesh, generator):
    for _ in range(LEAVES["fir"]):
        height = generator.random() ** 1.6
        angle = generator.uniform(0, 2 * math.pi)
        radius = 1.1 * (1 - height) * generator.random() ** 0.5
        center = (radius * math.cos(angle), 0.5 + 4 * height - 0.35 * radius, radius * math.sin(angle))
        add_leaf(mesh, generator, center, (math.cos(angle), 0.8, math.sin(angle)), 0.2)


def trunk(height, radius, sides=10):
    mesh = Mesh()
    for i in range(sides):
        angle = 2 * math.pi * i / sides
        x, z = math.cos(angle), math.sin(angle)
        mesh.positions.extend((radius * x, 0, radius * z, 0.3 * radius * x, height, 0.3 * radius * z))
    for i in range(sides):
        a, b = 2 * i, 2 * ((i + 1) % sides)
        mesh.indices.extend((a, a + 1, b + 1, a, b + 1, b))
    return mesh


def write_tree(path, leaves, height, color, seed):
    mesh = Mesh()
    leaves(mesh, random.Random(seed))
    scene = GltfScene()
    foliage = scene.add_material("leaves", color, roughness=0.7, doubleSided=True)
    wood = scene.add_material("wood", (0.12, 0.08, 0.05), roughness=0.9)
    stem = trunk(height, 0.14)
    # One mesh, so that a tree is one instance.
    tree = {"name": path.stem, "primitives": [{**scene.add_geometry(mesh), "material": foliage},
                                              {**scene.add_geometry(stem), "material": wood}]}
    scene.add_node(path.stem, mesh=scene.append("meshes", tree))
    scene.save(path)
    return (len(mesh.indices) + len(stem.indices)) // 3


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trees", type=int)
    parser.add_argument("folder", type=Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    triangles = {"oak": write_tree(arguments.folder / "oak.glb", oak_leaves, 3.2, (0.10, 0.22, 0.05), 1),
                 "fir": write_tree(arguments.folder / "fir.glb", fir_needles, 4.2, (0.04, 0.14, 0.06), 2)}
    generator = random.Random(3)
    side = math.ceil(math.sqrt(arguments.trees))
    places = {"oak": [], "fir": []}
    for i in range(arguments.trees):
        x = SPACING * (i % side - side / 2 + generator.uniform(-0.4, 0.4))
        z = SPACING * (i // side - side / 2 + generator.uniform(-0.4, 0.4))
        kind = "oak" if generator.random() < 0.6 else "fir"
        places[kind].append([{"rotate_y": round(generator.uniform(0, 360), 2)},
                             {"scale": round(generator.uniform(0.7, 1.3), 3)},
                             {"translate": [round(x, 3), 0, round(z, 3)]}])
    half = SPACING * side / 2
    scene = {
        "camera": {"look_from": [0, 9, half], "look_at": [0, 0, half - 40], "fov": 50},
        "materials": {"ground": {"type": "lambertian", "kd": [0.2, 0.15, 0.08]}},
        "objects": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "material": "ground"}]
        + [{"type": "gltf", "file": f"{kind}.glb", "instances": instances} for kind, instances in places.items()],
        "lights": [{"type": "directional", "direction": [-1, -1.2, -0.6], "irradiance": 3}],
        "environment": {"color": [0.35, 0.45, 0.6]},
    }
    output = arguments.folder / "forest.json"
    output.write_text(json.dumps(scene) + "\n")
    total = sum(triangles[kind] * len(instances) for kind, instances in places.items())
    print(f"{output}: {arguments.trees:,} trees, {total:,} triangles")


main()
