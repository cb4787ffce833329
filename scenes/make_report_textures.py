#!/usr/bin/env python3
"""Writes report/textures/*.png: the small images of the figures 26 to 30. Standard library only."""

import math
from pathlib import Path

from textures import Turbulence, encode_png, gradient

FOLDER = Path(__file__).parent / "report" / "textures"


def save(name, width, height, pixel):
    """`pixel(x, y)` is a grey value or three values, each from 0 to 255."""
    rows = []
    for y in range(height):
        values = [pixel(x, y) for x in range(width)]
        flat = [c for v in values for c in v] if isinstance(values[0], tuple) else values
        rows.append(bytes(max(0, min(255, round(c))) for c in flat))
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / name).write_bytes(encode_png(width, height, rows))


def parametrisation(size=128):
    """Figure 26: black at (0, 0) in the upper left corner, red grows with u, green with v, a line every eighth."""
    def pixel(x, y):
        step = size // 8
        if x % step in (0, step - 1) or y % step in (0, step - 1):
            return 235, 235, 235
        cell = x // step, y // step
        return 255 * (cell[0] + 0.5) / 8, 255 * (cell[1] + 0.5) / 8, 60
    save("uv.png", size, size, pixel)


def planks(size=128):
    """Four boards with grain along u."""
    grain = Turbulence(4, 4, 7)
    def pixel(x, y):
        board, across = divmod(y, size // 4)
        if across == 0:
            return 38, 24, 16
        value = grain((x / size * 0.5 + 0.31 * board) % 1, (y / size * 6) % 1)
        rings = 0.5 + 0.5 * math.sin(22 * value + 3 * board)
        shade = 0.78 + 0.12 * rings + 0.05 * board % 0.1
        return 184 * shade, 122 * shade, 74 * shade
    save("planks.png", size, size, pixel)


BRICK_WIDTH, BRICK_HEIGHT, JOINT = 32, 16, 2


def brick_distance(x, y):
    """Pixels from the nearest joint, and which brick."""
    row = y // BRICK_HEIGHT
    shifted = x + (BRICK_WIDTH // 2) * (row % 2)
    left, top = shifted % BRICK_WIDTH, y % BRICK_HEIGHT
    edge = min(left, BRICK_WIDTH - 1 - left, top, BRICK_HEIGHT - 1 - top)
    return edge - JOINT + 1, (shifted // BRICK_WIDTH % 4, row)


def bricks(size=128):
    rough = Turbulence(8, 3, 3)
    def color(x, y):
        edge, brick = brick_distance(x, y)
        if edge < 1:
            return 170, 164, 154
        tone = 0.8 + 0.35 * rough(x / size, y / size) + 0.06 * ((brick[0] * 7 + brick[1] * 3) % 4 - 1.5)
        return 158 * tone, 74 * tone, 54 * tone
    def height(x, y):
        edge, _ = brick_distance(x, y)
        return 255 * min(1, max(0, edge / 3)) * (0.8 + 0.2 * rough(x / size, y / size))
    save("bricks.png", size, size, color)
    save("bricks_height.png", size, size, height)


def globe(width=256, height=128):
    """Continents in an ocean, ice at the poles: latitude-longitude."""
    land = Turbulence(4, 5, 11)
    colors = gradient([(0, (20, 44, 96)), (0.49, (46, 104, 160)), (0.5, (196, 184, 128)), (0.56, (74, 124, 56)),
                       (0.72, (122, 98, 66)), (1, (235, 235, 240))], 64)
    def pixel(x, y):
        # Around the axis of a cylinder in the noise: the seam and the poles close.
        latitude = math.pi * (0.5 - (y + 0.5) / height)
        value = land(x / width, (y / height) % 1)
        value = 0.5 + (value - 0.5) * math.cos(latitude) ** 0.5 * 1.7
        if abs(latitude) > 1.25 + 0.3 * (value - 0.5):
            return 238, 242, 246
        return tuple(colors[max(0, min(63, int(64 * value)))])
    save("globe.png", width, height, pixel)


parametrisation()
planks()
bricks()
globe()
