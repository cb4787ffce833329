"""Triangle meshes of simple solids: outward normals, counter-clockwise fronts, uvs that grow to the right and down."""

import math
from array import array

from gltf_writer import cross, normalized


class Mesh:
    """Flat arrays as glTF stores them; normals and uvs may stay empty."""

    def __init__(self):
        self.positions, self.normals, self.uvs = array("f"), array("f"), array("f")
        self.indices = array("I")

    def add_vertex(self, position, normal=None, uv=None):
        self.positions.extend(position)
        if normal:
            self.normals.extend(normal)
        if uv:
            self.uvs.extend(uv)
        return len(self.positions) // 3 - 1

    def add_grid(self, rows, columns, vertex):
        """vertex(row, column) -> (position, normal, uv). Rows go up, columns to the right, seen from the front."""
        first = len(self.positions) // 3
        for row in range(rows):
            for column in range(columns):
                self.add_vertex(*vertex(row, column))
        for row in range(rows - 1):
            for column in range(columns - 1):
                a = first + row * columns + column
                b, c, d = a + 1, a + columns + 1, a + columns
                for triangle in ((a, b, c), (a, c, d)):
                    if not self.is_degenerate(triangle):
                        self.indices.extend(triangle)

    def is_degenerate(self, triangle):
        a, b, c = (tuple(self.positions[3 * i:3 * i + 3]) for i in triangle)
        return a == b or b == c or c == a


def quad(corner, edge_u, edge_v, tiles=(1, 1)):
    """Front towards edge_u x edge_v; the texture repeats `tiles` times and stands upright along edge_v."""
    mesh = Mesh()
    normal = normalized(cross(edge_u, edge_v))

    def vertex(row, column):
        position = tuple(c + column * u + row * v for c, u, v in zip(corner, edge_u, edge_v))
        return position, normal, (column * tiles[0], (1 - row) * tiles[1])

    mesh.add_grid(2, 2, vertex)
    return mesh


def merged(meshes):
    result = Mesh()
    for mesh in meshes:
        first = len(result.positions) // 3
        result.positions.extend(mesh.positions)
        result.normals.extend(mesh.normals)
        result.uvs.extend(mesh.uvs)
        result.indices.extend(first + i for i in mesh.indices)
    return result


def rounded_box(size, radius=0.0, segments=4):
    """Centred on x and z, standing on y = 0. Each side carries the whole texture once."""
    half = [s / 2 for s in size]
    steps = [radius * i / segments for i in range(segments + 1)] if radius else [0.0]
    mesh = Mesh()
    for axis in range(3):
        for sign in (-1, 1):
            u_axis, v_axis = ((1, 2), (2, 0), (0, 1))[axis]
            if axis == 0 or (axis == 1 and sign < 0):
                u_axis, v_axis = v_axis, u_axis  # keeps v vertical on the upright sides
            # u x v must point along sign * axis: mirror u where it does not.
            mirror = sign if (u_axis, v_axis) in ((1, 2), (2, 0), (0, 1)) else -sign
            us = [-half[u_axis] + s for s in steps] + [half[u_axis] - s for s in reversed(steps)]
            vs = [-half[v_axis] + s for s in steps] + [half[v_axis] - s for s in reversed(steps)]

            def vertex(row, column):
                p = [0.0] * 3
                p[axis], p[u_axis], p[v_axis] = sign * half[axis], mirror * us[column], vs[row]
                normal = [0.0] * 3
                normal[axis] = sign
                if radius:
                    core = [max(radius - h, min(h - radius, x)) for x, h in zip(p, half)]
                    normal = normalized([x - c for x, c in zip(p, core)])
                    p = [c + radius * n for c, n in zip(core, normal)]
                p[1] += half[1]
                uv = (us[column] / size[u_axis] + 0.5, 0.5 - vs[row] / size[v_axis])
                return p, normal, uv

            mesh.add_grid(len(vs), len(us), vertex)
    return mesh


def sphere(radius, columns=96, rows=48):
    """Centred on the origin."""
    mesh = Mesh()

    def vertex(row, column):
        polar = math.pi * (1 - row / rows)  # from the south pole up
        around = 2 * math.pi * column / columns
        ring = math.sin(polar) if 0 < row < rows else 0.0
        normal = (ring * math.sin(around), math.cos(polar), ring * math.cos(around))
        return tuple(radius * n for n in normal), normal, (column / columns, 1 - row / rows)

    mesh.add_grid(rows + 1, columns + 1, vertex)
    return mesh


def smooth_curve(points, steps):
    """Uniform Catmull-Rom spline through 2D points, `steps` pieces between two of them."""
    padded = [points[0], *points, points[-1]]
    curve = []
    for p0, p1, p2, p3 in zip(padded, padded[1:], padded[2:], padded[3:]):
        for i in range(steps):
            t = i / steps
            curve.append(tuple(
                0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3)
                for a, b, c, d in zip(p0, p1, p2, p3)))
    return [*curve, points[-1]]


def lathe(profile, columns=96):
    """Turns (radius, y) points about the Y axis; the outside is on the right of the profile's direction, so a vessel
    goes up on its outer wall and down on its inner one. A point given twice makes a crease."""
    tangents = []
    for i in range(len(profile)):
        before, after = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        tangents.append((after[0] - before[0], after[1] - before[1]))
    lengths = [0.0]
    for a, b in zip(profile, profile[1:]):
        lengths.append(lengths[-1] + math.dist(a, b))
    mesh = Mesh()

    def vertex(row, column):
        radius, y = profile[row]
        dr, dy = tangents[row]
        out, up = normalized((dy, -dr))
        if radius == 0:
            out, up = 0.0, math.copysign(1, up)
        angle = 2 * math.pi * (column % columns) / columns
        sine, cosine = math.sin(angle), math.cos(angle)
        position = (radius * sine, y, radius * cosine)
        return position, (out * sine, up, out * cosine), (column / columns, 1 - lengths[row] / lengths[-1])

    mesh.add_grid(len(profile), columns + 1, vertex)
    return mesh


def torus_knot(turns, windings, radius, tube, rings=256, sides=24):
    """A (turns, windings) torus knot about the Z axis, about 2.8 `radius` high and wide, centred on the origin."""

    def center(t):
        around = turns * t
        r = radius * (1 + 0.4 * math.cos(windings * t))
        return (r * math.cos(around), r * math.sin(around), 0.4 * radius * math.sin(windings * t))

    mesh = Mesh()

    def frame(row):
        t = 2 * math.pi * (row % rings) / rings
        step = 1e-3
        here, ahead, behind = center(t), center(t + step), center(t - step)
        along = normalized([a - b for a, b in zip(ahead, behind)])
        side = normalized(cross(along, here))
        return here, cross(side, along), side

    frames = [frame(row) for row in range(rings + 1)]

    def vertex(row, column):
        here, x, y = frames[row]
        angle = 2 * math.pi * (column % sides) / sides
        c, s = math.cos(angle), math.sin(angle)
        normal = tuple(c * a + s * b for a, b in zip(x, y))
        return tuple(h + tube * n for h, n in zip(here, normal)), normal, (column / sides, 1 - row / rings)

    mesh.add_grid(rings + 1, sides + 1, vertex)
    return mesh
