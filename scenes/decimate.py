"""Fewer triangles for the same shape: edges collapse, the least missed first. Standard library only."""

import heapq
import math

from gltf_writer import cross


def decimated(positions, triangles, wanted):
    """Positions and exactly `wanted` triangles where the mesh allows it, else the next smaller count. The error of an
    edge is Garland and Heckbert's (Surface simplification using quadric error metrics, 1997), its vertex goes to the
    best of both ends and the middle."""
    mesh = CollapsingMesh(positions, triangles)
    while mesh.count > wanted and mesh.collapse_next(mesh.count - wanted):
        pass
    return mesh.result()


class CollapsingMesh:
    def __init__(self, positions, triangles):
        self.positions = list(positions)
        self.triangles = list(triangles)
        self.count = len(triangles)
        self.at = [set() for _ in positions]  # triangles at a vertex
        self.quadrics = [[0.0] * 10 for _ in positions]
        self.version = [0] * len(positions)
        for i, triangle in enumerate(triangles):
            quadric = self.plane_quadric(triangle)
            for vertex in triangle:
                self.at[vertex].add(i)
                self.quadrics[vertex] = [a + b for a, b in zip(self.quadrics[vertex], quadric)]
        edges = {(min(e), max(e)) for a, b, c in triangles for e in ((a, b), (b, c), (c, a))}
        self.heap = [self.candidate(*edge) for edge in sorted(edges)]
        heapq.heapify(self.heap)

    def plane_quadric(self, triangle):
        """Squared distance from the triangle's plane, times its area."""
        p, q, r = (self.positions[v] for v in triangle)
        normal = cross([b - a for a, b in zip(p, q)], [b - a for a, b in zip(p, r)])
        double_area = math.sqrt(sum(n * n for n in normal))
        if double_area == 0:
            return [0.0] * 10
        a, b, c = (n / double_area for n in normal)
        d = -(a * p[0] + b * p[1] + c * p[2])
        w = double_area / 2
        return [w * x for x in (a * a, a * b, a * c, a * d, b * b, b * c, b * d, c * c, c * d, d * d)]

    def candidate(self, a, b):
        q = [x + y for x, y in zip(self.quadrics[a], self.quadrics[b])]
        middle = tuple((x + y) / 2 for x, y in zip(self.positions[a], self.positions[b]))
        best = None
        for x, y, z in (middle, self.positions[a], self.positions[b]):
            error = (x * (q[0] * x + 2 * (q[1] * y + q[2] * z + q[3])) + y * (q[4] * y + 2 * (q[5] * z + q[6]))
                     + z * (q[7] * z + 2 * q[8]) + q[9])
            if best is None or error < best[0]:
                best = error, (x, y, z)
        # Where the error is the same, as on a plane, short edges go first.
        length = math.dist(self.positions[a], self.positions[b])
        return max(best[0], 0) + 1e-9 * length ** 4, a, b, self.version[a], self.version[b], best[1]

    def neighbours(self, vertex):
        return {v for i in self.at[vertex] for v in self.triangles[i]} - {vertex}

    def collapse_next(self, most):
        """Collapses the best edge that takes away at most `most` triangles; False when there is none."""
        put_back = []
        found = False
        while self.heap and not found:
            entry = heapq.heappop(self.heap)
            _, a, b, version_a, version_b, target = entry
            if (version_a, version_b) != (self.version[a], self.version[b]):
                continue
            shared = self.at[a] & self.at[b]
            if len(shared) > most:
                put_back.append(entry)
            elif self.is_simple(a, b, shared) and not self.flips(a, b, shared, target):
                self.collapse(a, b, shared, target)
                found = True
        for entry in put_back:
            heapq.heappush(self.heap, entry)
        return found

    def is_simple(self, a, b, shared):
        """Collapsing keeps the surface one that has two sides and does not touch itself."""
        return len(shared) <= 2 and len(self.neighbours(a) & self.neighbours(b)) == len(shared)

    def flips(self, a, b, shared, target):
        """A triangle would turn over, or lose its area."""
        for i in (self.at[a] | self.at[b]) - shared:
            before = [self.positions[v] for v in self.triangles[i]]
            after = [target if v in (a, b) else self.positions[v] for v in self.triangles[i]]
            n, m = (cross([y - x for x, y in zip(p, q)], [y - x for x, y in zip(p, r)]) for p, q, r in (before, after))
            if sum(x * y for x, y in zip(n, m)) <= 0.2 * math.sqrt(sum(x * x for x in n) * sum(x * x for x in m)):
                return True
        return False

    def collapse(self, a, b, shared, target):
        self.positions[a] = target
        self.quadrics[a] = [x + y for x, y in zip(self.quadrics[a], self.quadrics[b])]
        for i in shared:
            for vertex in self.triangles[i]:
                self.at[vertex].discard(i)
            self.triangles[i] = None
        self.count -= len(shared)
        for i in self.at[b]:
            self.triangles[i] = tuple(a if v == b else v for v in self.triangles[i])
        self.at[a] |= self.at[b]
        self.at[b] = set()
        self.version[a] += 1
        self.version[b] += 1
        for vertex in sorted(self.neighbours(a)):
            heapq.heappush(self.heap, self.candidate(min(a, vertex), max(a, vertex)))

    def result(self):
        kept = [t for t in self.triangles if t]
        used = sorted({v for t in kept for v in t})
        number = {v: i for i, v in enumerate(used)}
        return [self.positions[v] for v in used], [tuple(number[v] for v in t) for t in kept]
