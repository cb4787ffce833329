"""Pictures of linear values as PFM files, and how far one is from another."""

import array
import sys

# Keeps pixels that are black in the reference from dominating: radiance squared.
RELATIVE_FLOOR = 0.01


def read_pfm(path):
    """Width, height and the values, three for a pixel (or one in a `Pf` file), the lowest row first."""
    data = path.read_bytes()
    fields, offset = [], 0
    while len(fields) < 4:
        end = min(i for i in (data.find(space, offset) for space in (b" ", b"\n")) if i >= 0)
        fields.append(data[offset:end])
        offset = end + 1
    kind, width, height, scale = fields[0], int(fields[1]), int(fields[2]), float(fields[3])
    if kind not in (b"PF", b"Pf"):
        raise ValueError(f"{path}: not a PFM file")
    count = width * height * (3 if kind == b"PF" else 1)
    values = array.array("f", data[offset:offset + 4 * count])
    if len(values) != count:
        raise ValueError(f"{path}: is cut off")
    if (scale < 0) != (sys.byteorder == "little"):
        values.byteswap()
    return width, height, values


def relative_mse(values, reference):
    """Mean over all channels of (x - r)^2 / (r^2 + 0.01). Nothing is trimmed."""
    if len(values) != len(reference):
        raise ValueError("pictures of different sizes")
    return sum((x - r) ** 2 / (r * r + RELATIVE_FLOOR) for x, r in zip(values, reference)) / len(values)
