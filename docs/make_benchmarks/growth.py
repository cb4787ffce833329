"""What grows with the number of triangles: figures out of the measurements of terrains."""

import math

PREFIX = "growth_"


def sizes(most):
    return [10 ** power for power in range(3, 8) if 10 ** power <= most]


def key_of(triangles):
    return f"{PREFIX}{triangles}"


def nanoseconds(contestant):
    """Of a ray of the first bounce, one thread: scattered rays, which find nothing in the caches by luck."""
    return 1e9 / contestant["rates"][0]["first_bounce"]["rays_per_second"]["median"]


def build_seconds(contestant):
    """With all threads."""
    return contestant["build"][-1]["seconds"]["median"]


def memory_bytes(contestant):
    return contestant["memory_bytes"]


def curves(results, value):
    """{name: [(triangles, value)]} of every contestant, by rising number of triangles."""
    measured = sorted((result["scene"]["triangles"], result) for key, result in results.items()
                      if key.startswith(PREFIX))
    found = {}
    for triangles, result in measured:
        for contestant in result["contestants"]:
            found.setdefault(contestant["name"], []).append((triangles, value(contestant)))
    return found


def exponent(points):
    """k of the power law n^k that fits the points best (least squares of the logarithms); None for a single one."""
    if len(points) < 2:
        return None
    logs = [(math.log(n), math.log(value)) for n, value in points]
    mean_x, mean_y = (sum(column) / len(logs) for column in zip(*logs))
    return (sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs))
