"""Writes glTF 2.0 scenes with nothing but Python's standard library.

Used by the make_*.py scripts beside it. Conventions are glTF's: right-handed, +Y up, metres, linear colours.
"""

import base64
import json
import struct
from array import array
from pathlib import Path

FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5121, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


class GltfScene:
    """Collects meshes, materials, textures and nodes; save() writes .gltf (buffer embedded as a data URI) or .glb."""

    def __init__(self):
        self.document = {"asset": {"version": "2.0", "generator": "candil scene scripts"}, "scene": 0,
                         "scenes": [{"nodes": []}], "nodes": []}
        self.binary = bytearray()
        self.extensions = set()

    def append(self, kind, item):
        """Adds an object to a top-level array and returns its index."""
        items = self.document.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def add_view(self, data, target=None):
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data
        return self.append("bufferViews", view)

    def add_floats(self, values, components, with_bounds=False):
        kind = {2: "VEC2", 3: "VEC3", 4: "VEC4"}[components]
        accessor = {"bufferView": self.add_view(values.tobytes(), ARRAY_BUFFER), "componentType": FLOAT,
                    "count": len(values) // components, "type": kind}
        if with_bounds:
            accessor["min"] = [min(values[i::components]) for i in range(components)]
            accessor["max"] = [max(values[i::components]) for i in range(components)]
        return self.append("accessors", accessor)

    def add_geometry(self, mesh):
        """Stores a shapes.Mesh and returns a glTF primitive without material, so that several meshes can share it."""
        vertex_count = len(mesh.positions) // 3
        attributes = {"POSITION": self.add_floats(mesh.positions, 3, with_bounds=True)}
        if mesh.normals:
            attributes["NORMAL"] = self.add_floats(mesh.normals, 3)
        if mesh.uvs:
            attributes["TEXCOORD_0"] = self.add_floats(mesh.uvs, 2)
        short = vertex_count < 65535
        indices = array("H" if short else "I", mesh.indices)
        accessor = self.append("accessors", {
            "bufferView": self.add_view(indices.tobytes(), ELEMENT_ARRAY_BUFFER),
            "componentType": UNSIGNED_SHORT if short else UNSIGNED_INT, "count": len(indices), "type": "SCALAR"})
        return {"attributes": attributes, "indices": accessor}

    def add_mesh(self, name, geometry, material):
        """A glTF mesh of one primitive from a shapes.Mesh or from what add_geometry() returned."""
        primitive = geometry if isinstance(geometry, dict) else self.add_geometry(geometry)
        return self.append("meshes", {"name": name, "primitives": [{**primitive, "material": material}]})

    def add_texture(self, name, png, sampler=None):
        """A texture from the bytes of a PNG file; repeats and filters linearly unless a sampler says otherwise."""
        image = self.append("images", {"name": name, "bufferView": self.add_view(png), "mimeType": "image/png"})
        texture = {"source": image, "name": name}
        if sampler is not None:
            texture["sampler"] = self.append("samplers", sampler)
        return self.append("textures", texture)

    def add_material(self, name, base_color=(1, 1, 1), metallic=0.0, roughness=1.0, extensions=None, **more):
        """`more` are further glTF properties of the material; textures of the base go in `pbr`."""
        pbr = {"baseColorFactor": [*base_color, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
        pbr |= more.pop("pbr", {})
        material = {"name": name, "pbrMetallicRoughness": pbr, **more}
        if extensions:
            material["extensions"] = extensions
            self.extensions |= set(extensions)
        return self.append("materials", material)

    def add_light_material(self, name, color, strength):
        """Black surface that emits `color` times `strength` W/(sr m2) from its front side."""
        return self.add_material(name, (0, 0, 0), emissiveFactor=list(color),
                                 extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength},
                                             "KHR_materials_specular": {"specularFactor": 0}})

    def add_node(self, name, **properties):
        """A node at the root of the scene; `properties` are glTF's: mesh, camera, translation, rotation, scale."""
        index = self.append("nodes", {"name": name, **properties})
        self.document["scenes"][0]["nodes"].append(index)
        return index

    def add_camera(self, name, position, target, yfov, aspect):
        perspective = {"type": "perspective", "name": name,
                       "perspective": {"yfov": yfov, "aspectRatio": aspect, "znear": 0.01}}
        camera = self.append("cameras", perspective)
        self.add_node(name, camera=camera, matrix=look_at_matrix(position, target))

    def save(self, path):
        path = Path(path)
        if self.extensions:
            self.document["extensionsUsed"] = sorted(self.extensions)
        self.binary += b"\0" * (-len(self.binary) % 4)
        buffer = {"byteLength": len(self.binary)}
        self.document["buffers"] = [buffer]
        if path.suffix == ".glb":
            text = json.dumps(self.document, separators=(",", ":")).encode()
            text += b" " * (-len(text) % 4)
            size = 12 + 8 + len(text) + 8 + len(self.binary)
            with open(path, "wb") as file:
                file.write(struct.pack("<4sII", b"glTF", 2, size))
                file.write(struct.pack("<I4s", len(text), b"JSON") + text)
                file.write(struct.pack("<I4s", len(self.binary), b"BIN\0") + self.binary)
        else:
            data = base64.b64encode(self.binary).decode()
            buffer["uri"] = "data:application/octet-stream;base64," + data
            path.write_text(json.dumps(self.document, indent=1) + "\n")


def normalized(v):
    length = sum(x * x for x in v) ** 0.5
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def look_at_matrix(position, target):
    """Column-major camera-to-world matrix: looks along -Z, +Y up."""
    back = normalized(tuple(p - t for p, t in zip(position, target)))
    right = normalized(cross((0, 1, 0), back))
    up = cross(back, right)
    return [*right, 0, *up, 0, *back, 0, *position, 1]
