#!/usr/bin/env python3
"""Writes report/models/teapot.ply: the Utah teapot, 6320 triangles with exact normals. Standard library only.

32 bicubic Bezier patches, Martin Newell's control points of 1975 with the usual bottom and height (3.15, width 6.43).
Each is cut into 10 x 10 squares, two triangles each: 6400, less 10 of no area for each of the 8 patches that meet in
the top of the knob or in the middle of the bottom. +Y up, the spout towards +X, standing on y = 0.
"""

from pathlib import Path

from gltf_writer import cross, normalized
from ply import write_ply

CUTS = 10  # of a patch's edge

# Bodies of revolution: radius and height of the four control points of a quarter's upright curves, from
# the top down. A quarter circle of radius 1 has the control points (1, 0), (1, ROUND), (ROUND, 1), (0, 1).
ROUND, KNOB_ROUND = 0.56, 0.5625
REVOLVED = [
    ((0, 3.15), (0.8, 3.15), (0, 2.85), (0.2, 2.7)),  # knob
    ((0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)),  # lid
    ((1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)),  # rim
    ((1.5, 2.4), (1.75, 1.875), (2, 1.35), (2, 0.9)),  # body
    ((2, 0.9), (2, 0.45), (1.5, 0.225), (1.5, 0.15)),
    ((1.5, 0.15), (1.5, 0.075), (1.425, 0), (0, 0)),  # bottom
]

# Handle and spout: rows along the tube, of one half of its circumference as (x, height, distance from the middle).
HANDLE = [
    ((-1.6, 2.025, 0), (-1.6, 2.025, 0.3), (-1.5, 2.25, 0.3), (-1.5, 2.25, 0)),
    ((-2.3, 2.025, 0), (-2.3, 2.025, 0.3), (-2.5, 2.25, 0.3), (-2.5, 2.25, 0)),
    ((-2.7, 2.025, 0), (-2.7, 2.025, 0.3), (-3, 2.25, 0.3), (-3, 2.25, 0)),
    ((-2.7, 1.8, 0), (-2.7, 1.8, 0.3), (-3, 1.8, 0.3), (-3, 1.8, 0)),
    ((-2.7, 1.575, 0), (-2.7, 1.575, 0.3), (-3, 1.35, 0.3), (-3, 1.35, 0)),
    ((-2.5, 1.125, 0), (-2.5, 1.125, 0.3), (-2.65, 0.9375, 0.3), (-2.65, 0.9375, 0)),
    ((-2, 0.9, 0), (-2, 0.9, 0.3), (-1.9, 0.6, 0.3), (-1.9, 0.6, 0)),
]
SPOUT = [
    ((1.7, 1.425, 0), (1.7, 1.425, 0.66), (1.7, 0.6, 0.66), (1.7, 0.6, 0)),
    ((2.6, 1.425, 0), (2.6, 1.425, 0.66), (3.1, 0.825, 0.66), (3.1, 0.825, 0)),
    ((2.3, 2.1, 0), (2.3, 2.1, 0.25), (2.4, 2.025, 0.25), (2.4, 2.025, 0)),
    ((2.7, 2.4, 0), (2.7, 2.4, 0.25), (3.3, 2.4, 0.25), (3.3, 2.4, 0)),
    ((2.8, 2.475, 0), (2.8, 2.475, 0.25), (3.525, 2.49375, 0.25), (3.525, 2.49375, 0)),
    ((2.9, 2.475, 0), (2.9, 2.475, 0.15), (3.45, 2.5125, 0.15), (3.45, 2.5125, 0)),
    ((2.8, 2.4, 0), (2.8, 2.4, 0.15), (3.2, 2.4, 0.15), (3.2, 2.4, 0)),
]


def patches():
    """4 rows of 4 control points each; the front is that of (along a row) x (across the rows)."""
    for profile in REVOLVED:
        roundness = KNOB_ROUND if profile[0][0] == 0 else ROUND
        circle = ((1, 0), (1, roundness), (roundness, 1), (0, 1))
        for cosine, sine in ((1, 0), (0, 1), (-1, 0), (0, -1)):
            yield [[(r * (x * cosine - z * sine), y, r * (x * sine + z * cosine)) for x, z in circle]
                   for r, y in profile]
    for tube in (HANDLE, SPOUT):
        for rows in (tube[:4], tube[3:]):
            yield rows
            yield [[(x, y, -z) for x, y, z in row[::-1]] for row in rows]


def basis(t):
    """Bernstein's cubic polynomials and their derivatives."""
    s = 1 - t
    values = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
    return values, (-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t)


def blend(patch, across, along):
    return tuple(sum(a * b * patch[row][column][axis] for row, a in enumerate(across) for column, b in enumerate(along))
                 for axis in range(3))


def vertex(patch, row, column):
    """Position and normal. Where a whole row is one point, the derivative along it is replaced by what it tends to,
    up to its length: its own derivative across the rows."""
    value_v, slope_v = basis(row / CUTS)
    value_u, slope_u = basis(column / CUTS)
    along = blend(patch, value_v, slope_u)
    if max(map(abs, along)) < 1e-9:
        along = blend(patch, slope_v, slope_u)
        if row == CUTS:
            along = [-a for a in along]
    normal = normalized(cross(along, blend(patch, slope_v, value_u)))
    # + 0.0 makes -0.0 positive, so that equal vertices are found.
    return tuple(tuple(round(x, 6) + 0.0 for x in vector) for vector in (blend(patch, value_v, value_u), normal))


def main():
    vertices, triangles = {}, []
    for patch in patches():
        grid = [[vertices.setdefault(vertex(patch, row, column), len(vertices)) for column in range(CUTS + 1)]
                for row in range(CUTS + 1)]
        for upper, lower in zip(grid, grid[1:]):
            for column in range(CUTS):
                a, b, c, d = upper[column], upper[column + 1], lower[column + 1], lower[column]
                triangles += [t for t in ((a, b, c), (a, c, d)) if len(set(t)) == 3]
    positions, normals = zip(*vertices)
    path = Path(__file__).parent / "report" / "models" / "teapot.ply"
    write_ply(path, positions, triangles, normals, "The Utah teapot, by make_teapot.py")
    print(f"{path}: {len(positions)} vertices, {len(triangles)} triangles")


main()
