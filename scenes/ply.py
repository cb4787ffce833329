"""Reads and writes triangle meshes as Stanford PLY files. Standard library only."""

import os
import struct
import sys
from array import array

TYPES = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
         "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f",
         "float64": "d"}


def write_ply(path, positions, triangles, normals=None, comment=None):
    """Binary, little endian. `normals`: one for each position, or None."""
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals else [])
    header = ["ply", "format binary_little_endian 1.0"] + ([f"comment {comment}"] if comment else [])
    header += [f"element vertex {len(positions)}", *(f"property float {name}" for name in names)]
    header += [f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header", ""]
    rows = zip(positions, normals) if normals else ((position,) for position in positions)
    vertices = array("f", (x for row in rows for vector in row for x in vector))
    if sys.byteorder == "big":
        vertices.byteswap()
    pack = struct.Struct("<B3i").pack
    path.parent.mkdir(parents=True, exist_ok=True)
    # The whole file or none: what is there is taken for good.
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        beside.write_bytes("\n".join(header).encode() + vertices.tobytes() + b"".join(pack(3, *t) for t in triangles))
        os.replace(beside, path)
    finally:
        beside.unlink(missing_ok=True)


def read_ply(path):
    """Positions and triangles (polygons as fans); everything else in the file is skipped. Throws ValueError."""
    try:
        return parse_ply(path.read_bytes())
    except (ValueError, LookupError, StopIteration, struct.error) as error:
        raise ValueError(f"{path}: cannot be read as PLY: {error!r}") from error


def parse_ply(data):
    end = data.index(b"end_header")
    body = data.index(b"\n", end) + 1
    lines = [line.split() for line in data[:end].decode("latin-1").splitlines()]
    if lines[0] != ["ply"]:
        raise ValueError("no PLY header")
    encoding = next(line[1] for line in lines if line[:1] == ["format"])
    elements = []
    for line in lines:
        if line[:1] == ["element"]:
            elements.append((line[1], int(line[2]), []))
        elif line[:1] == ["property"]:
            elements[-1][2].append(line[1:])
    if encoding == "ascii":
        next_values = ascii_reader(data[body:])
    else:
        next_values = binary_reader(data, body, "<" if encoding == "binary_little_endian" else ">")
    positions, triangles = [], []
    for name, count, properties in elements:
        for _ in range(count):
            row = {}
            for kind, *rest in properties:
                if kind == "list":
                    (length,) = next_values(TYPES[rest[0]], 1)
                    row[rest[2]] = next_values(TYPES[rest[1]], int(length))
                else:
                    (row[rest[0]],) = next_values(TYPES[kind], 1)
            if name == "vertex":
                positions.append((row["x"], row["y"], row["z"]))
            elif name == "face":
                corners = row["vertex_indices"] if "vertex_indices" in row else row["vertex_index"]
                triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
    return positions, triangles


def ascii_reader(text):
    words = iter(text.split())

    def next_values(code, count):
        convert = float if code in "fd" else int
        return tuple(convert(next(words)) for _ in range(count))
    return next_values


def binary_reader(data, offset, order):
    def next_values(code, count):
        nonlocal offset
        values = struct.unpack_from(f"{order}{count}{code}", data, offset)
        offset += struct.calcsize(f"{order}{count}{code}")
        return values
    return next_values
