"""Closed triangle meshes of smooth bodies: blended round cones, meshed by surface nets. Standard library only."""

import math


class Body:
    """The blended union of round cones: signed distance, about; negative inside."""

    def __init__(self, blend, ripple=0.0, waves=0.0):
        """`blend`: width of the seams. The surface is moved by up to `ripple`, `waves` radians per unit of length."""
        self.blend, self.ripple, self.waves = blend, ripple, waves
        self.cones, self.block = [], 4 * blend
        self.near = {}

    def add(self, *points):
        """A chain of (x, y, z, radius)."""
        for a, b in zip(points, points[1:] or points):
            edge = tuple(q - p for p, q in zip(a, b))
            square = sum(e * e for e in edge[:3])
            self.cones.append((*a, *edge, 1 / square if square else 0.0))

    def add_pair(self, *points):
        """A chain and its mirror image in z."""
        self.add(*points)
        self.add(*((x, y, -z, r) for x, y, z, r in points))

    @staticmethod
    def distance(cone, x, y, z):
        ax, ay, az, ar, ex, ey, ez, er, inverse = cone
        px, py, pz = x - ax, y - ay, z - az
        t = min(1.0, max(0.0, (px * ex + py * ey + pz * ez) * inverse))
        return math.sqrt((px - t * ex) ** 2 + (py - t * ey) ** 2 + (pz - t * ez) ** 2) - ar - t * er

    def __call__(self, x, y, z):
        size = self.block
        key = math.floor(x / size), math.floor(y / size), math.floor(z / size)
        cones = self.near.get(key)
        if cones is None:  # those that matter to a surface in this block
            center = [(k + 0.5) * size for k in key]
            cones = self.near[key] = [c for c in self.cones if self.distance(c, *center) < 2 * size]
        result, blend = size, self.blend
        for cone in cones:
            distance = self.distance(cone, x, y, z)
            seam = blend - abs(result - distance)
            result = min(result, distance)
            if seam > 0:
                result -= seam * seam / (4 * blend)
        if self.ripple:
            w = self.waves
            result += self.ripple * math.sin(w * x) * math.sin(w * y + 0.5) * math.sin(w * z + 1)
        return result


CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]
EDGES = [(a, b) for a in range(8) for b in range(a + 1, 8)
         if sum(p != q for p, q in zip(CORNERS[a], CORNERS[b])) == 1]
FACES = [[i for i in range(8) if CORNERS[i][axis] == side] for axis in range(3) for side in (0, 1)]


def surface_net(field, inside, cell):
    """Positions and triangles of the zero surface around the point `inside`. Cells of edge `cell` are found by following
    the surface; each has one vertex for each sheet of it that passes."""
    values = {}

    def value(corner):
        if corner not in values:
            values[corner] = field(*(cell * c for c in corner))
        return values[corner]

    start = tuple(math.floor(c / cell) for c in inside)
    while value((start[0], start[1] + 1, start[2])) < 0:
        start = (start[0], start[1] + 1, start[2])
    positions, vertex_at, waiting, seen = [], {}, [start], {start}
    for cube in waiting:  # grows while it is walked
        corners = [tuple(c + d for c, d in zip(cube, corner)) for corner in CORNERS]
        signed = [value(c) for c in corners]
        for sheet in sheets(signed):
            for a, b in sheet:
                vertex_at[cube, corners[a], corners[b]] = len(positions)
            positions.append(settled(field, cell, crossing_point(corners, signed, sheet, cell)))
        for face, corners_of_face in enumerate(FACES):
            is_inside = [signed[i] < 0 for i in corners_of_face]
            neighbour = tuple(c + (2 * (face % 2) - 1) * (a == face // 2) for a, c in enumerate(cube))
            if any(is_inside) and not all(is_inside) and neighbour not in seen:
                seen.add(neighbour)
                waiting.append(neighbour)
    return positions, net_triangles(waiting, vertex_at, value, positions)


def sheets(signed):
    """The cut edges of a cell by connected piece of surface. Both cells at a face that is cut four times take its
    inside corners for separate."""
    cut = [edge for edge in EDGES if (signed[edge[0]] < 0) != (signed[edge[1]] < 0)]
    piece = {edge: i for i, edge in enumerate(cut)}
    for face in FACES:
        around = [edge for edge in cut if edge[0] in face and edge[1] in face]
        groups = [around] if len(around) == 2 else [[e for e in around if i in e] for i in face if signed[i] < 0]
        for group in groups:
            if len(group) == 2:
                old, new = piece[group[0]], piece[group[1]]
                piece = {edge: new if p == old else p for edge, p in piece.items()}
    return [[edge for edge in cut if piece[edge] == p] for p in sorted(set(piece.values()))]


def crossing_point(corners, signed, sheet, cell):
    """The mean of where the surface cuts these edges of a cell."""
    crossings = []
    for a, b in sheet:
        t = signed[a] / (signed[a] - signed[b])
        crossings.append([cell * (p + t * (q - p)) for p, q in zip(corners[a], corners[b])])
    return [sum(axis) / len(crossings) for axis in zip(*crossings)]


def settled(field, cell, point):
    """One step of Newton's method onto the surface."""
    here, step = field(*point), 0.05 * cell
    slope = [(field(*(p + step * (a == axis) for a, p in enumerate(point))) - here) / step for axis in range(3)]
    square = max(sum(s * s for s in slope), 0.25)
    return tuple(p - here * s / square for p, s in zip(point, slope))


def net_triangles(cubes, vertex_at, value, positions):
    """Two triangles for each edge of the grid that the surface cuts, between the four cells around it; cut along the
    shorter diagonal."""
    triangles = []
    for cube in cubes:
        for axis in range(3):
            end = tuple(c + (a == axis) for a, c in enumerate(cube))
            first = value(cube) < 0
            if first == (value(end) < 0):
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            around = [tuple(c - du * (a == u) - dv * (a == v) for a, c in enumerate(cube))
                      for du, dv in ((1, 1), (0, 1), (0, 0), (1, 0))]
            a, b, c, d = (vertex_at[near, cube, end] for near in (around if first else around[::-1]))
            if math.dist(positions[a], positions[c]) > math.dist(positions[b], positions[d]):
                a, b, c, d = b, c, d, a
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def is_closed(triangles):
    """Each edge has two triangles, which agree about the front."""
    edges = [edge for a, b, c in triangles for edge in ((a, b), (b, c), (c, a))]
    once = set(edges)
    return len(once) == len(edges) and all((b, a) in once for a, b in once)
