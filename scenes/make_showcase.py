#!/usr/bin/env python3
"""Writes gallery/showcase.glb: a still life of gold, glass, glaze, wood and marble under two soft boxes.

A table 1.8 m wide stands before a wall; objects are 5 to 25 cm high. A warm key light comes from the left front,
a cool rim light from the right rear; weak large panels in front and above fill the shadows, and a strip below the
table's edge washes the wall. All lights are large, so that the picture is clean at some hundred samples.
"""

import math
import random
from pathlib import Path

from gltf_writer import GltfScene, cross, normalized
from shapes import lathe, quad, rounded_box, smooth_curve, sphere, torus_knot
from textures import Turbulence, encode_png, gradient, gray_rows, normal_map

TILE = 0.18  # edge of a marble tile, metres; the texture holds 4 x 4 of them
TEXTURE_TILES = 4


def turned(degrees):
    """Rotation about +Y as a glTF quaternion."""
    half = math.radians(degrees) / 2
    return [0, math.sin(half), 0, math.cos(half)]


def aimed_quad(center, target, width, height):
    """A rectangle around `center` that faces `target`."""
    toward = normalized([t - c for t, c in zip(target, center)])
    right = normalized(cross((0, 1, 0), toward))
    up = cross(toward, right)
    edge_u, edge_v = [width * x for x in right], [height * x for x in up]
    return quad([c - (u + v) / 2 for c, u, v in zip(center, edge_u, edge_v)], edge_u, edge_v)


def marble_textures():
    """Colour and roughness of a floor of pale and dark marble tiles with fine joints."""
    size, shades = 1024, 48
    warp, veins, cloud = Turbulence(4, 4, 11), Turbulence(4, 5, 23), Turbulence(8, 4, 37)
    generator = random.Random(5)
    shift = {(i, j): (generator.random(), generator.random())
             for i in range(TEXTURE_TILES) for j in range(TEXTURE_TILES)}
    pale = gradient([(0, (96, 98, 104)), (0.45, (186, 184, 182)), (1, (232, 229, 223))], shades)
    dark = gradient([(0, (14, 26, 25)), (0.6, (27, 50, 46)), (1, (150, 168, 156))], shades)
    joint = [(58, 56, 52)]

    def cell(u, v):
        i, j = int(u * TEXTURE_TILES), int(v * TEXTURE_TILES)
        edge = min(min(x * TEXTURE_TILES % 1, 1 - x * TEXTURE_TILES % 1) for x in (u, v))
        du, dv = shift[i, j]  # every tile is cut from another place of the block
        return (i + j) % 2, edge * TILE < 0.0008, u + du, v + dv

    def vein(u, v):
        """1 on a vein, falling to 0 beside it."""
        ridge = abs(2 * veins(u + 0.35 * warp(u, v), v + 0.35 * warp(v, u)) - 0.97)
        return max(0.0, 1 - 7 * ridge) ** 1.5

    color_rows, roughness_rows = [], []
    for y in range(size):
        color_row, roughness_row = bytearray(), bytearray()
        for x in range(size):
            is_dark, is_joint, u, v = cell((x + 0.5) / size, (y + 0.5) / size)
            soft = cloud(u, v)
            if is_joint:
                color_row.append(2 * shades)
                roughness_row.append(200)
                continue
            if is_dark:
                shade = 0.15 + 0.55 * soft + 0.6 * vein(u, v)
            else:
                shade = 1.0 - 0.25 * (1 - soft) - 0.75 * vein(u, v)
            color_row.append(is_dark * shades + round(min(1, max(0, shade)) * (shades - 1)))
            roughness_row.append(8 * round((20 + 50 * soft) / 8))
        color_rows.append(bytes(color_row))
        roughness_rows.append(bytes(roughness_row))
    return encode_png(size, size, color_rows, pale + dark + joint), encode_png(size, size, roughness_rows)


def wood_texture():
    fibre, rings = Turbulence(4, 4, 3), Turbulence(2, 3, 9)
    palette = gradient([(0, (62, 34, 20)), (0.5, (118, 70, 38)), (1, (160, 104, 60))], 48)

    def shade(u, v):
        wave = math.sin(2 * math.pi * (6 * v + 2.2 * rings(u, v)))
        return 0.5 + 0.3 * wave + 0.7 * (fibre(u, 8 * v) - 0.5)

    return encode_png(512, 256, gray_rows(512, 256, shade, len(palette)), palette)


def glaze_texture():
    """Bands of cobalt, cream and rust around the vase, dark where glaze ran together."""
    run = Turbulence(8, 4, 41)
    palette = gradient([(0, (14, 30, 66)), (0.33, (28, 74, 120)), (0.4, (225, 214, 190)), (0.6, (232, 222, 202)),
                        (0.66, (150, 62, 30)), (1, (96, 36, 20))], 96)

    def shade(u, v):
        v += 0.02 * (run(u, v) - 0.5)
        bands = ((0.10, 0.56), (0.16, 0.9), (0.20, 0.5), (0.34, 0.2), (0.62, 0.28), (0.70, 0.5), (0.76, 0.9),
                 (0.80, 0.5))
        for end, value in bands:
            if v < end:
                return value + 0.12 * (run(u, v) - 0.5)
        return 0.15 + 0.2 * (run(u, v) - 0.5)

    return encode_png(512, 512, gray_rows(512, 512, shade, len(palette)), palette)


def dimple_normals():
    """Rows of shallow round dimples, pressed into the clay."""

    def height(u, v):
        x, y = 8 * u + (0.5 if int(8 * v) % 2 else 0), 8 * v
        distance = math.hypot(x % 1 - 0.5, y % 1 - 0.5) / 0.44
        return -((1 - distance * distance) ** 2 if distance < 1 else 0)

    return normal_map(128, 128, height, 0.035)


def glass(scene, name, tint, distance, ior=1.5, roughness=0.0):
    """Glass that lets `tint` of white light through after `distance` metres."""
    return scene.add_material(name, (1, 1, 1), roughness=roughness, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_ior": {"ior": ior},
        "KHR_materials_volume": {"thicknessFactor": 0.05, "attenuationColor": list(tint),
                                 "attenuationDistance": distance}})


def vase_profile():
    outer = smooth_curve([(0.036, 0.0), (0.05, 0.03), (0.068, 0.085), (0.062, 0.14), (0.034, 0.185), (0.024, 0.215),
                          (0.032, 0.24)], 10)
    lip = [(0.0325, 0.2425), (0.031, 0.244), (0.029, 0.2425)]
    inner = smooth_curve([(0.0285, 0.24), (0.0205, 0.215), (0.029, 0.185), (0.052, 0.14), (0.05, 0.095), (0.0, 0.08)], 5)
    return [(0.0, 0.0), (0.033, 0.0), (0.036, 0.0), *outer[1:], *lip, *inner]


def tumbler_profile():
    """A heavy glass: walls of 3 mm on a base of 16 mm."""
    base = [(0.0, 0.0), (0.028, 0.0), (0.031, 0.001), (0.0325, 0.004)]
    rim = [(0.0385, 0.084), (0.0382, 0.0855), (0.0370, 0.086), (0.0358, 0.0855), (0.0355, 0.084)]
    return [*base, *rim, (0.0305, 0.022), (0.0295, 0.0185), (0.0265, 0.0165), (0.0, 0.016)]


def add_stage(scene):
    color, roughness = marble_textures()
    askew = {"extensions": {"KHR_texture_transform": {"rotation": 0.6}}}
    scene.extensions.add("KHR_texture_transform")
    marble = scene.add_material("marble", pbr={
        "baseColorTexture": {"index": scene.add_texture("marble color", color), **askew},
        "metallicRoughnessTexture": {"index": scene.add_texture("marble roughness", roughness), **askew}})
    plaster = scene.add_material("plaster", (0.13, 0.20, 0.25), roughness=0.9)
    width, depth, back = 1.8, 1.44, -0.62
    tiles = (width / TILE / TEXTURE_TILES, depth / TILE / TEXTURE_TILES)
    parts = [
        ("table", quad((-width / 2, 0, back + depth), (width, 0, 0), (0, 0, -depth), tiles), marble),
        ("back wall", quad((-2.0, -0.8, -1.35), (4.0, 0, 0), (0, 2.6, 0)), plaster),
    ]
    for name, mesh, material in parts:
        scene.add_node(name, mesh=scene.add_mesh(name, mesh, material))


def add_lights(scene):
    for name, center, target, size, color, strength in [
            ("key light", (-0.95, 0.95, 0.85), (0, 0.08, 0), (0.8, 0.8), (1.0, 0.86, 0.68), 14.0),
            ("rim light", (1.05, 0.75, -0.55), (0, 0.10, 0), (0.7, 0.9), (0.58, 0.78, 1.0), 10.0),
            ("front fill", (0.9, 0.9, 2.2), (0, 0.1, 0), (2.6, 1.6), (0.9, 0.95, 1.0), 0.45),
            ("canopy", (0, 1.7, 0), (0, 0, -0.01), (2.6, 2.2), (1.0, 0.96, 0.9), 0.40),
            ("wall glow", (0, -0.24, -1.10), (0, 0.10, -1.35), (0.9, 0.16), (1.0, 0.55, 0.28), 9.0)]:
        material = scene.add_light_material(name, color, strength)
        scene.add_node(name, mesh=scene.add_mesh(name, aimed_quad(center, target, *size), material))


def add_objects(scene):
    wood = scene.add_material("walnut", roughness=0.38, pbr={
        "baseColorTexture": {"index": scene.add_texture("walnut color", wood_texture())}})
    glaze = scene.add_material(
        "glaze", roughness=0.16,
        pbr={"baseColorTexture": {"index": scene.add_texture("glaze color", glaze_texture())}},
        normalTexture={"index": scene.add_texture("dimples", dimple_normals()), "scale": 1.0,
                       "extensions": {"KHR_texture_transform": {"scale": [7, 6]}}})
    gold = scene.add_material("gold", (1.0, 0.766, 0.336), metallic=1, roughness=0.24)
    copper = scene.add_material("copper", (0.955, 0.638, 0.538), metallic=1, roughness=0.12)
    steel = scene.add_material("steel", (0.62, 0.61, 0.6), metallic=1, roughness=0.05)
    lacquer = scene.add_material("red lacquer", (0.45, 0.02, 0.015), roughness=0.08)
    clear = glass(scene, "clear glass", (0.82, 0.95, 0.90), 0.09, ior=1.52)
    amber = glass(scene, "amber glass", (0.97, 0.66, 0.24), 0.02)

    unit_sphere = scene.add_geometry(sphere(1, 96, 48))

    def ball(name, material, x, z, radius):
        mesh = scene.add_mesh(name, unit_sphere, material)
        scene.add_node(name, mesh=mesh, translation=[x, radius, z], scale=[radius] * 3)

    def put(name, mesh, material, x, y, z, degrees=0):
        scene.add_node(name, mesh=scene.add_mesh(name, mesh, material), translation=[x, y, z],
                       rotation=turned(degrees))

    put("plinth", rounded_box((0.20, 0.045, 0.15), 0.005), wood, -0.135, 0, -0.10, 14)
    put("torus knot", torus_knot(2, 3, 0.062, 0.0185), gold, -0.135, 0.045 + 0.1045, -0.10, 24)
    put("vase", lathe(vase_profile(), 72), glaze, 0.135, 0, -0.13, 40)
    put("tumbler", lathe(tumbler_profile(), 72), amber, 0.225, 0, 0.06)
    ball("crystal ball", clear, 0.035, 0.075, 0.05)
    ball("steel ball", steel, -0.265, 0.055, 0.037)
    ball("copper ball", copper, -0.075, 0.115, 0.026)
    ball("lacquer ball", lacquer, 0.135, 0.135, 0.021)


def main():
    scene = GltfScene()
    add_stage(scene)
    add_lights(scene)
    add_objects(scene)
    scene.add_camera("camera", (0.0, 0.34, 1.06), (0.0, 0.092, 0.0), math.radians(24), 1.5)
    scene.save(Path(__file__).parent / "gallery" / "showcase.glb")


main()
