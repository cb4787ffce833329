"""Pairs of small images made by formulas, for comparing candil's FLIP with its authors' flip-evaluator.

    python3 flip_pairs.py         prints flip_reference_values.h, made with flip-evaluator (pip install flip-evaluator numpy)

flip_pairs.cpp makes the same pairs; both write them down the same way, operation by operation."""

import numpy

WIDTH, HEIGHT = 48, 40


def mix(value):
    """32-bit integer hash (two rounds of multiply and shift); numpy arrays of uint64 in and out."""
    mask = numpy.uint64(0xFFFFFFFF)
    for factor in (0x7FEB352D, 0x846CA68B):
        value = (value ^ (value >> numpy.uint64(16))) * numpy.uint64(factor) & mask
    return value ^ (value >> numpy.uint64(15))


Y, X = numpy.mgrid[0:HEIGHT, 0:WIDTH].astype(numpy.float64)


def noise(seed, channel=0):
    """Numbers in [0, 1), one for each pixel."""
    index = (Y * WIDTH + X).astype(numpy.uint64) * numpy.uint64(3) + numpy.uint64(channel)
    return (mix(index + numpy.uint64(seed * 1000003)) >> numpy.uint64(8)).astype(numpy.float64) / 2 ** 24


def stack(*channels):
    return numpy.stack([numpy.broadcast_to(channel, (HEIGHT, WIDTH)) for channel in channels], axis=2)


def color_noise(seed):
    return stack(*(noise(seed, channel) for channel in range(3)))


def disc(x, y, radius):
    return ((X - x) ** 2 + (Y - y) ** 2 < radius ** 2).astype(numpy.float64)


def gradient(shift):
    return stack((X + shift) / (WIDTH + 1), Y / HEIGHT, (X + Y + shift) / (WIDTH + HEIGHT + 1))


def lines(period):
    return stack(*[(X % period < 1) * 0.75 + 0.125] * 3)


def spike(base, value):
    image = numpy.full((HEIGHT, WIDTH, 3), base)
    image[HEIGHT // 2, WIDTH // 2] = value
    return image


DISPLAY = {
    "noise": (color_noise(1), color_noise(2)),
    "faint noise": (stack(0.5, 0.5, 0.5), 0.45 + 0.1 * color_noise(3)),
    "gradient": (gradient(0), gradient(1)),
    "disc": (stack(0.2, 0.3 + 0.5 * disc(20, 18, 9), 0.7), stack(0.2, 0.3 + 0.5 * disc(22, 19, 9), 0.7)),
    "colour": (stack(0.2, 0.6, 0.4), stack(0.28, 0.55, 0.4)),
    "lines": (lines(3), lines(4)),
    "dark noise": (0.06 * color_noise(4), 0.06 * color_noise(5)),
    "spike": (spike(0.3, 0.3), spike(0.3, 1.0)),
    "green and blue": (stack(0, 1, 0), stack(0, 0, 1)),
}

LINEAR = {
    "range": (2 ** (8 * color_noise(6) - 4), 2 ** (8 * color_noise(6) - 4) * (0.9 + 0.2 * color_noise(7))),
    "slope": (stack(2 ** (X / 4 - 5), 2 ** (X / 5 - 4), 2 ** (Y / 4 - 5)),
              1.1 * stack(2 ** (X / 4 - 5), 2 ** (X / 5 - 4), 2 ** (Y / 4 - 5))),
    "lamp": (stack(0.1, 0.2, 0.15 + 0.01 * Y) + 100 * stack(disc(20, 18, 6), disc(20, 18, 6), 0),
             stack(0.1, 0.2, 0.15 + 0.01 * Y) + 100 * stack(disc(21, 18, 6), disc(21, 18, 6), 0)),
    "firefly": (0.25 + 0.1 * color_noise(8), 0.25 + 0.1 * color_noise(8) + spike(0.0, 50.0)),
    "mostly black": (color_noise(9) * (Y > 24)[:, :, None], color_noise(10) * (Y > 24)[:, :, None]),
    "constant": (stack(1, 1, 1), stack(2, 2, 2)),
    "dim": (0.001 * (0.5 + color_noise(11)), 0.001 * (0.5 + color_noise(12))),
    "negative": (color_noise(13) - 0.1, color_noise(14) - 0.1),
}


def pairs():
    """Yields name, whether linear, A, B as float32; display values are those of 8 bits."""
    for name, (a, b) in DISPLAY.items():
        yield name, False, *(numpy.float32(numpy.floor(image * 255 + 0.5) / 255) for image in (a, b))
    for name, (a, b) in LINEAR.items():
        yield name, True, numpy.float32(a), numpy.float32(b)


def reference(a, b, is_linear):
    """The map of flip-evaluator. Negative values are not for it: they become 0."""
    import flip_evaluator
    a, b = (numpy.ascontiguousarray(numpy.maximum(image, 0)) for image in (a, b))
    return flip_evaluator.evaluate(a, b, "HDR" if is_linear else "LDR", applyMagma=False)[0][:, :, 0]


PLACES = ((0, 0), (20, 18), (24, 20), (47, 39))  # x, y


def main():
    print("/// Made by tests/metrics/flip_pairs.py with flip-evaluator 1.7; do not edit.")
    print("#pragma once\n\n#include <array>\n\nnamespace candil::test {\n")
    print("/// The FLIP of a pair: its mean, its largest value, and that of the pixels (0, 0), (20, 18), (24, 20), (47, 39).")
    print("struct FlipReference {\n  const char* name;\n  bool is_linear;\n  double mean, largest;")
    print("  std::array<double, 4> at;\n};\n")
    print("inline constexpr std::array flip_references = {")
    for name, is_linear, a, b in pairs():
        flip = reference(a, b, is_linear)
        at = ", ".join(f"{flip[y, x]:.6f}" for x, y in PLACES)
        print(f'    FlipReference{{"{name}", {str(is_linear).lower()}, {flip.astype(numpy.float64).mean():.6f}, '
              f"{flip.max():.6f}, {{{at}}}}},")
    print("};\n\n}  // namespace candil::test")


if __name__ == "__main__":
    main()
