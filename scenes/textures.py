"""Procedural textures, written as small PNG files with the standard library alone."""

import math
import random
import struct
import zlib


def encode_png(width, height, rows, palette=None):
    """`rows`: bytes per row, 1 channel (grey, or indices of `palette`) or 3 (RGB), told by their length."""
    channels = len(rows[0]) // width
    color_type = 3 if palette else {1: 0, 3: 2}[channels]
    previous = bytes(width * channels)
    data = bytearray()
    for row in rows:
        if palette:  # neighbours in a palette are not neighbours in value for zlib: filters still help smooth ramps
            candidates = [(0, row), (2, bytes((a - b) & 255 for a, b in zip(row, previous)))]
        else:
            left = bytes(channels) + row[:-channels]
            candidates = [(0, row), (1, bytes((a - b) & 255 for a, b in zip(row, left))),
                          (2, bytes((a - b) & 255 for a, b in zip(row, previous)))]
        kind, best = min(candidates, key=lambda c: sum(min(x, 256 - x) for x in c[1]))
        data.append(kind)
        data += best
        previous = row

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0))
    if palette:
        png += chunk(b"PLTE", b"".join(bytes(color) for color in palette))
    return png + chunk(b"IDAT", zlib.compress(bytes(data), 9)) + chunk(b"IEND", b"")


class Noise:
    """Tileable value noise with period `period` in both directions."""

    def __init__(self, period, seed):
        generator = random.Random(seed)
        self.period = period
        self.lattice = [[generator.random() for _ in range(period)] for _ in range(period)]

    def __call__(self, x, y):
        """In [0, 1]; quintic interpolation."""
        column, row = math.floor(x), math.floor(y)
        u, v = x - column, y - row
        u, v = u * u * u * (u * (u * 6 - 15) + 10), v * v * v * (v * (v * 6 - 15) + 10)
        top, bottom = self.lattice[row % self.period], self.lattice[(row + 1) % self.period]
        c0, c1 = column % self.period, (column + 1) % self.period
        a, b = top[c0] + u * (top[c1] - top[c0]), bottom[c0] + u * (bottom[c1] - bottom[c0])
        return a + v * (b - a)


class Turbulence:
    """Sum of octaves of noise over the unit square, in about [0, 1], tileable."""

    def __init__(self, period, octaves, seed):
        self.octaves = [(Noise(period << i, seed + i), period << i, 0.5 ** (i + 1)) for i in range(octaves)]

    def __call__(self, u, v):
        return sum(weight * noise(u * period, v * period) for noise, period, weight in self.octaves)


def gradient(stops, size=128):
    """Palette between (position, (r, g, b)) stops, 8-bit sRGB."""
    palette = []
    for i in range(size):
        t = i / (size - 1)
        for (t0, c0), (t1, c1) in zip(stops, stops[1:]):
            if t <= t1:
                f = (t - t0) / (t1 - t0)
                palette.append(tuple(round(a + f * (b - a)) for a, b in zip(c0, c1)))
                break
    return palette


def gray_rows(width, height, value, levels=256):
    """Rows of round(value(u, v) * (levels - 1)), value clamped to [0, 1]; (u, v) at pixel centres."""
    return [bytes(round(min(1.0, max(0.0, value((x + 0.5) / width, (y + 0.5) / height))) * (levels - 1))
                  for x in range(width)) for y in range(height)]


def normal_map(width, height, bump, strength):
    """PNG of a tangent-space normal map (green up) from a tileable height over the unit square. `strength` scales the
    slope: height units per unit of u."""
    heights = [[bump((x + 0.5) / width, (y + 0.5) / height) for x in range(width)] for y in range(height)]
    rows = []
    for y in range(height):
        row = bytearray()
        for x in range(width):
            du = (heights[y][(x + 1) % width] - heights[y][x - 1]) * width / 2
            dv = (heights[(y + 1) % height][x] - heights[y - 1][x]) * height / 2  # v grows downwards
            normal = (-strength * du, strength * dv, 1.0)
            length = math.sqrt(sum(n * n for n in normal))
            row += bytes(round((n / length * 0.5 + 0.5) * 255) for n in normal)
        rows.append(bytes(row))
    return encode_png(width, height, rows)
