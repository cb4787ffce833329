"""Where models stand, so that scenes fit the real ones and their stand-ins alike."""


def placed(name, positions):
    """On y = 0, in the middle of x and z; a bunny 1 high, everything else 1 long."""
    low = [min(axis) for axis in zip(*positions)]
    high = [max(axis) for axis in zip(*positions)]
    scale = 1 / (high[1] - low[1] if name.startswith("bunny") else max(h - l for l, h in zip(low, high)))
    origin = ((low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2)
    return [tuple(scale * (x - o) for x, o in zip(position, origin)) for position in positions]
