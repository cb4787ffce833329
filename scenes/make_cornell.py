#!/usr/bin/env python3
"""Writes report/cornell.gltf: the box every renderer starts with.

A 2 m room with known diffuse reflectances, open towards the camera, with a light of 0.5 x 0.5 m in the ceiling
that emits (18, 14, 9) W/(sr m2) downwards. Surfaces are ideal diffuse: KHR_materials_specular takes the coat away.
"""

import math
from pathlib import Path

from gltf_writer import GltfScene
from shapes import merged, quad, rounded_box

DIFFUSE = {"KHR_materials_specular": {"specularFactor": 0}}
LIGHT = 0.25  # half edge of the light, metres


def main():
    scene = GltfScene()
    white = scene.add_material("white", (0.73, 0.73, 0.73), extensions=DIFFUSE)
    red = scene.add_material("red", (0.63, 0.065, 0.05), extensions=DIFFUSE)
    green = scene.add_material("green", (0.14, 0.45, 0.091), extensions=DIFFUSE)
    light = scene.add_light_material("light", (1, 14 / 18, 9 / 18), 18)

    floor = quad((-1, 0, 1), (2, 0, 0), (0, 0, -2))
    back = quad((-1, 0, -1), (2, 0, 0), (0, 2, 0))
    ceiling = [  # a frame around the light
        quad((-1, 2, -1), (2, 0, 0), (0, 0, 1 - LIGHT)),
        quad((-1, 2, LIGHT), (2, 0, 0), (0, 0, 1 - LIGHT)),
        quad((-1, 2, -LIGHT), (1 - LIGHT, 0, 0), (0, 0, 2 * LIGHT)),
        quad((LIGHT, 2, -LIGHT), (1 - LIGHT, 0, 0), (0, 0, 2 * LIGHT)),
    ]
    parts = [
        ("room", merged([floor, back, *ceiling]), white),
        ("left wall", quad((-1, 0, 1), (0, 0, -2), (0, 2, 0)), red),
        ("right wall", quad((1, 0, -1), (0, 0, 2), (0, 2, 0)), green),
        ("ceiling light", quad((-LIGHT, 2, -LIGHT), (2 * LIGHT, 0, 0), (0, 0, 2 * LIGHT)), light),
    ]
    for name, mesh, material in parts:
        scene.add_node(name, mesh=scene.add_mesh(name, mesh, material))

    box = scene.add_mesh("box", rounded_box((0.6, 0.6, 0.6)), white)
    boxes = [("short box", (0.33, 0, 0.38), -17, 1), ("tall box", (-0.33, 0, -0.3), 18, 2)]
    for name, position, degrees, height in boxes:
        half_angle = math.radians(degrees) / 2
        scene.add_node(name, mesh=box, translation=list(position), scale=[1, height, 1],
                       rotation=[0, math.sin(half_angle), 0, math.cos(half_angle)])
    scene.add_camera("camera", (0, 1, 4.6), (0, 1, 0), math.radians(35), 1)
    scene.save(Path(__file__).parent / "report" / "cornell.gltf")


main()
