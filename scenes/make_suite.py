#!/usr/bin/env python3
"""Writes suite/closures.glb, scattering.glb and geometry.glb, scenes of suite.toml that only glTF can describe.

closures.glb is a ball before a wall under two soft boxes; its material is a variant for every closure of glTF's
extensions, chosen by --variant. scattering.glb is the same with an experimental one. geometry.glb has instances of
EXT_mesh_gpu_instancing, points, lines, a strip that a skin bends and a plate that morph targets lift, both moved by
one animation of two seconds.
"""

from array import array
from pathlib import Path

from gltf_writer import FLOAT, UNSIGNED_BYTE, GltfScene
from shapes import Mesh, quad, rounded_box, sphere

POINTS, LINE_STRIP = 0, 3


def closures():
    """Name of the variant and what add_material() takes for it."""
    volume = {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1}}
    film = {"iridescenceFactor": 1, "iridescenceIor": 1.4, "iridescenceThicknessMaximum": 420}
    return {
        "clearcoat": {"base_color": (0.5, 0.02, 0.02), "roughness": 0.6,
                      "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1,
                                                                 "clearcoatRoughnessFactor": 0.1}}},
        "sheen": {"base_color": (0.05, 0.08, 0.2),
                  "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.8, 0.6],
                                                         "sheenRoughnessFactor": 0.4}}},
        "anisotropy": {"base_color": (0.9, 0.7, 0.4), "metallic": 1, "roughness": 0.3,
                       "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.8,
                                                                   "anisotropyRotation": 0.5}}},
        "anisotropic glass": {"roughness": 0.3,
                              "extensions": {**volume, "KHR_materials_anisotropy": {"anisotropyStrength": 0.7}}},
        "film on metal": {"base_color": (0.7, 0.7, 0.7), "metallic": 1, "roughness": 0.2,
                          "extensions": {"KHR_materials_iridescence": film}},
        "film on plastic": {"base_color": (0.02, 0.02, 0.02), "roughness": 0.2,
                            "extensions": {"KHR_materials_iridescence": film}},
        "film on glass": {"roughness": 0.25, "extensions": {**volume, "KHR_materials_iridescence": film}},
        "dispersion": {"roughness": 0, "extensions": {**volume, "KHR_materials_dispersion": {"dispersion": 5}}},
        "diffuse transmission": {"base_color": (0.7, 0.7, 0.7), "doubleSided": True,
                                 "extensions": {"KHR_materials_diffuse_transmission": {
                                     "diffuseTransmissionFactor": 0.6,
                                     "diffuseTransmissionColorFactor": [0.3, 0.9, 0.3]}}},
        "specular": {"base_color": (0.1, 0.1, 0.1), "roughness": 0.3,
                     "extensions": {"KHR_materials_specular": {"specularFactor": 0.8,
                                                               "specularColorFactor": [1, 0.4, 0.1]},
                                    "KHR_materials_ior": {"ior": 2}}},
        "specular glossiness": {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.1, 0.3, 0.1, 1], "specularFactor": [0.4, 0.3, 0.1], "glossinessFactor": 0.7}}},
        "all layers": {"base_color": (0.2, 0.3, 0.6), "roughness": 0.4,
                       "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.8},
                                      "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.4, 0.3],
                                                              "sheenRoughnessFactor": 0.5},
                                      "KHR_materials_anisotropy": {"anisotropyStrength": 0.6},
                                      "KHR_materials_iridescence": film}},
    }


def scattering():
    return {"roughness": 0.1, "extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1},
        "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 0.3,
                                 "attenuationColor": [0.9, 0.6, 0.4]},
        "KHR_materials_volume_scatter": {"multiscatterColor": [0.8, 0.5, 0.3]}}}


def add_stage(scene):
    floor = scene.add_material("floor", (0.6, 0.6, 0.6), roughness=0.8)
    wall = scene.add_material("wall", (0.5, 0.2, 0.1), roughness=0.8)
    for name, mesh, material in [("floor", quad((-1.5, 0, 1.5), (3, 0, 0), (0, 0, -3)), floor),
                                 ("wall", quad((-1.5, 0, -1.0), (3, 0, 0), (0, 2.2, 0)), wall)]:
        scene.add_node(name, mesh=scene.add_mesh(name, mesh, material))
    for name, corner, u, v, strength in [("key", (-1.2, 2.0, 0.2), (0, 0, 0.9), (0.7, 0.3, 0), 12),
                                         ("rim", (1.4, 0.6, -0.6), (0, 0, 0.5), (0, 0.9, 0), 6)]:
        material = scene.add_light_material(name, (1, 0.95, 0.9), strength)
        scene.document["materials"][material]["doubleSided"] = True
        scene.add_node(name, mesh=scene.add_mesh(name, quad(corner, u, v), material))
    scene.add_camera("camera", (0.5, 1.0, 2.4), (0, 0.5, 0), 0.6, 1)


def make_closures(path, variants):
    scene = GltfScene()
    add_stage(scene)
    materials = [scene.add_material(name, **properties) for name, properties in variants.items()]
    mesh = scene.add_mesh("ball", sphere(0.5, 48, 24), materials[0])
    scene.document["meshes"][mesh]["primitives"][0]["extensions"] = {"KHR_materials_variants": {
        "mappings": [{"material": material, "variants": [i]} for i, material in enumerate(materials)]}}
    scene.add_node("ball", mesh=mesh, translation=[0, 0.52, 0])
    scene.document["extensions"] = {"KHR_materials_variants": {"variants": [{"name": name} for name in variants]}}
    scene.extensions.add("KHR_materials_variants")
    scene.save(path)


def add_scalars(scene, values):
    view = scene.add_view(array("f", values).tobytes())
    return scene.append("accessors", {"bufferView": view, "componentType": FLOAT, "count": len(values),
                                      "type": "SCALAR", "min": [min(values)], "max": [max(values)]})


def add_instances(scene, material):
    mesh = scene.add_mesh("brick", rounded_box((0.12, 0.08, 0.12), 0.01), material)
    places = [(-0.9 + 0.2 * column, 0.1 * row, -0.6) for row in range(4) for column in range(10)]
    translations = scene.add_floats(array("f", [x for place in places for x in place]), 3)
    scales = scene.add_floats(array("f", [s for i in range(len(places)) for s in (1, 0.6 + 0.4 * (i % 3) / 2, 1)]), 3)
    scene.add_node("bricks", mesh=mesh, extensions={"EXT_mesh_gpu_instancing": {
        "attributes": {"TRANSLATION": translations, "SCALE": scales}}})
    scene.extensions.add("EXT_mesh_gpu_instancing")


def add_points_and_lines(scene, material):
    for name, mode, height in [("points", POINTS, 0.75), ("lines", LINE_STRIP, 1.0)]:
        corners = array("f", [x for i in range(9) for x in (-0.8 + 0.2 * i, height + 0.12 * (i % 2), -0.2)])
        primitive = {"attributes": {"POSITION": scene.add_floats(corners, 3, with_bounds=True)}, "mode": mode}
        scene.add_node(name, mesh=scene.add_mesh(name, primitive, material))


def add_skinned_strip(scene, material):
    """Rungs of two vertices up to 0.6 m; the lower joint holds, the upper one takes over along the way."""
    rungs = 13
    mesh = Mesh()
    mesh.add_grid(rungs, 2, lambda row, column: ((-0.1 + 0.2 * column, 0.05 * row, 0), (0, 0, 1), (column, row)))
    primitive = scene.add_geometry(mesh)
    shares = [min(1.0, max(0.0, (row - 3) / 6)) for row in range(rungs) for _ in range(2)]
    joints = b"".join(bytes((0, 1, 0, 0)) for _ in shares)
    primitive["attributes"] |= {
        "WEIGHTS_0": scene.add_floats(array("f", [x for s in shares for x in (1 - s, s, 0, 0)]), 4),
        "JOINTS_0": scene.append("accessors", {"bufferView": scene.add_view(joints), "componentType": UNSIGNED_BYTE,
                                               "count": len(shares), "type": "VEC4"})}
    upper = scene.append("nodes", {"name": "upper", "translation": [0, 0.3, 0]})
    lower = scene.add_node("lower", children=[upper], translation=[0.45, 0.02, 0.4])
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    raised = [*identity[:13], -0.3, *identity[14:]]
    inverse = scene.append("accessors", {"bufferView": scene.add_view(array("f", identity + raised).tobytes()),
                                         "componentType": FLOAT, "count": 2, "type": "MAT4"})
    skin = scene.append("skins", {"joints": [lower, upper], "inverseBindMatrices": inverse})
    scene.add_node("strip", mesh=scene.add_mesh("strip", primitive, material), skin=skin)
    return upper


def add_morphed_plate(scene, material):
    mesh = quad((-0.7, 0.02, 0.7), (0.6, 0, 0), (0, 0, -0.6))
    primitive = scene.add_geometry(mesh)
    lift = array("f", [0, 0, 0, 0, 0, 0, 0, 0.5, 0, 0, 0.5, 0])
    primitive["targets"] = [{"POSITION": scene.add_floats(lift, 3, with_bounds=True)}]
    index = scene.add_mesh("plate", primitive, material)
    scene.document["meshes"][index]["weights"] = [0]
    return scene.add_node("plate", mesh=index)


def make_geometry(path):
    scene = GltfScene()
    add_stage(scene)
    red = scene.add_material("red", (0.7, 0.1, 0.05), roughness=0.5, doubleSided=True)
    blue = scene.add_material("blue", (0.1, 0.2, 0.7), roughness=0.5, doubleSided=True)
    add_instances(scene, red)
    add_points_and_lines(scene, blue)
    upper, plate = add_skinned_strip(scene, red), add_morphed_plate(scene, blue)
    times = add_scalars(scene, [0.0, 2.0])
    turns = scene.add_floats(array("f", [0, 0, 0, 1, 0, 0, 0.70710678, 0.70710678]), 4)
    weights = add_scalars(scene, [0.0, 1.0])
    scene.append("animations", {"name": "move", "samplers": [{"input": times, "output": turns},
                                                            {"input": times, "output": weights}],
                                "channels": [{"sampler": 0, "target": {"node": upper, "path": "rotation"}},
                                             {"sampler": 1, "target": {"node": plate, "path": "weights"}}]})
    scene.save(path)


if __name__ == "__main__":
    folder = Path(__file__).parent / "suite"
    make_closures(folder / "closures.glb", closures())
    make_closures(folder / "scattering.glb", {"scattering": scattering()})
    make_geometry(folder / "geometry.glb")
