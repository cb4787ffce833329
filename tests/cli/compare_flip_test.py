#!/usr/bin/env python3
"""FLIP of `candil compare` beside that of its authors' flip-evaluator, pixel by pixel: compare_flip_test.py CANDIL [FOLDER]

The pairs are those of tests/metrics/flip_pairs.py; with a FOLDER of pictures, each of its PNG files is compared with a
blurred copy of itself too. Exit code 77 (skipped) where Python has no flip-evaluator and numpy."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import flip_evaluator
    import numpy
except ImportError:
    print("no flip-evaluator: skipped (pip install flip-evaluator numpy)")
    sys.exit(77)

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "metrics"))
import flip_pairs  # noqa: E402
import image_files  # noqa: E402

CANDIL = sys.argv[1]
PICTURES = sorted(Path(sys.argv[2]).rglob("*.png")) if len(sys.argv) > 2 else []
TOLERANCE = 1e-3


def candil_flip(folder, a, b, is_linear):
    height, width, _ = a.shape
    for name, image in (("a", a), ("b", b)):
        if is_linear:
            image_files.write_pfm(folder / name, width, height, image)
        else:
            image_files.write_png(folder / name, width, height, numpy.rint(image * 255).astype(int).tolist())
    result = subprocess.run([CANDIL, "compare", "a", "b", "-q", "--diff", "flip.pfm"], cwd=folder)
    assert result.returncode in (0, 1), result
    return numpy.array(image_files.read_pfm(folder / "flip.pfm"))[:, :, 0]


def blurred(image):
    """The mean of 3 x 3 pixels, in steps of 1/255."""
    padded = numpy.pad(image, ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width, _ = image.shape
    total = sum(padded[y:y + height, x:x + width] for y in range(3) for x in range(3))
    return numpy.float32(numpy.rint(total / 9 * 255) / 255)


class Flip(unittest.TestCase):
    def check(self, name, a, b, is_linear):
        with self.subTest(name), tempfile.TemporaryDirectory() as folder:
            ours, theirs = candil_flip(Path(folder), a, b, is_linear), flip_pairs.reference(a, b, is_linear)
            difference = numpy.abs(ours - theirs)
            print(f"{name:32} mean {theirs.astype(float).mean():.5f}, ours {ours.mean():.5f}, "
                  f"largest difference of a pixel {difference.max():.1e}")
            self.assertLess(difference.max(), TOLERANCE)

    def test_pairs(self):
        for name, is_linear, a, b in flip_pairs.pairs():
            self.check(name, a, b, is_linear)

    def test_pictures(self):
        for path in PICTURES:
            a = numpy.ascontiguousarray(flip_evaluator.load(str(path))[:, :, :3])
            self.check(path.name, a, blurred(a), False)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
