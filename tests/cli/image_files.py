"""Writes and reads small images with nothing but the standard library."""

import array
import struct
import sys
import zlib


def write_png(path, width, height, rows):
    """8 bits, RGB; rows of (r, g, b)."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    pixels = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(pixels)) + chunk(b"IEND", b""))


def write_pfm(path, width, height, rows):
    """Linear floats; rows of (r, g, b), from top to bottom."""
    values = array.array("f", (value for row in reversed(rows) for pixel in row for value in pixel))
    if sys.byteorder == "big":
        values.byteswap()
    path.write_bytes(b"PF\n%d %d\n-1.0\n" % (width, height) + values.tobytes())


def read_pfm(path):
    """Rows of (r, g, b), from top to bottom."""
    kind, size, scale, data = path.read_bytes().split(b"\n", 3)
    assert kind == b"PF" and float(scale) < 0
    width, height = map(int, size.split())
    values = array.array("f", data)
    if sys.byteorder == "big":
        values.byteswap()
    rows = [[tuple(values[3 * (y * width + x):][:3]) for x in range(width)] for y in range(height)]
    return rows[::-1]
