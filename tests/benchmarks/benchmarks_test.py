#!/usr/bin/env python3
"""Tests of docs/make_benchmarks and scenes/bench: benchmarks_test.py CANDIL PROJECT. Exit code 77 (skipped) without
matplotlib."""

import json
import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CANDIL, PROJECT = (Path(argument) for argument in sys.argv[1:3])
SCRIPTS = PROJECT / "docs/make_benchmarks"
sys.path.insert(0, str(SCRIPTS))

import growth  # noqa: E402
import measure  # noqa: E402


def run(*command):
    return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def info(scene):
    return json.loads(run(CANDIL, "info", "--json", scene).stdout)


def script(name, *arguments):
    result = run(sys.executable, "-B", PROJECT / "scenes/bench" / name, *arguments)
    if result.returncode:
        raise AssertionError(result.stderr)


class Growth(unittest.TestCase):
    def test_exponent_of_a_power_law(self):
        self.assertAlmostEqual(growth.exponent([(n, 3 * n ** 0.5) for n in (10, 100, 1000)]), 0.5)
        self.assertAlmostEqual(growth.exponent([(n, 7) for n in (10, 100)]), 0)
        self.assertIsNone(growth.exponent([(10, 1)]))

    def test_exponent_of_a_logarithm_is_small(self):
        # Over 10^3 to 10^7 the logarithm grows by 7 / 3: as much as the power 0.09 of 10^4.
        points = [(10 ** k, math.log(10 ** k)) for k in range(3, 8)]
        self.assertAlmostEqual(growth.exponent(points), 0.09, delta=0.01)


class Rounding(unittest.TestCase):
    def test_keeps_five_digits_of_numbers_that_were_measured(self):
        self.assertEqual(measure.rounded({"a": [1.23456789, 7], "b": "x"}), {"a": [1.2346, 7], "b": "x"})


class Scenes(unittest.TestCase):
    def test_have_the_primitives_that_they_say(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            script("make_terrain.py", 1000, folder / "terrain.glb")
            self.assertEqual(info(folder / "terrain.glb")["triangles"], 2 * 23 ** 2)  # 22 x 22 x 2 would be less
            script("make_hairball.py", 960, folder / "hair.glb")
            self.assertEqual(info(folder / "hair.glb")["triangles"], 960)
            script("make_sphere_flake.py", 2, folder / "flake.json")
            self.assertEqual(info(folder / "flake.json")["shapes"]["sphere"], 1 + 9 + 81)
            script("make_forest.py", 50, folder)
            forest = info(folder / "forest.json")
            self.assertEqual(forest["instances"], 50)
            self.assertGreater(forest["instanced_triangles"], 50 * 4000)
            self.assertLess(forest["triangles"], 10000)
            script("make_bunnies.py", PROJECT / "scenes/report/models/teapot.ply", folder)
            self.assertEqual(info(folder / "three_bunnies.json")["triangles"], 3 * 6320 + 4)

    def test_of_a_terrain_lie_on_the_same_hills(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            bounds = []
            for triangles in (2000, 8000):
                script("make_terrain.py", triangles, folder / "terrain.glb")
                bounds.append(info(folder / "terrain.glb")["bounds"])
            for end in ("low", "high"):
                for coarse, fine in zip(bounds[0][end], bounds[1][end]):
                    # A summit may lie half a cell (0.16 m) away from the next vertex of the coarse one.
                    self.assertAlmostEqual(coarse, fine, delta=0.1)


class Page(unittest.TestCase):
    def test_tells_what_was_measured(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            command = (sys.executable, "-B", SCRIPTS, "--quick", "--candil", CANDIL, "--output", folder, "--scenes",
                       folder / "scenes", "--assets", folder)
            result = run(*command, "cornell")
            self.assertEqual(result.returncode, 0, result.stderr)
            page = (folder / "benchmarks.md").read_text()
            for part in ("## Cornell box", "| Mrays/s, 1 thread |", "| `embree` |", "Compared with `embree`: ", " 0 wrong",
                         "## The renderer", "Embree ", "load average"):
                self.assertIn(part, page)
            self.assertNotIn("## Terrain", page)
            self.assertIn("</svg>", (folder / "benchmarks/cornell.svg").read_text())
            results = json.loads((folder / "benchmarks/results.json").read_text())
            self.assertEqual(list(results), ["cornell"])
            self.assertEqual(results["cornell"]["file"], "cornell.gltf")  # no folder of this machine

    def test_refuses_parts_that_are_not_there(self):
        result = run(sys.executable, "-B", SCRIPTS, "--candil", CANDIL, "desert")
        self.assertEqual(result.returncode, 2)
        self.assertIn("no part desert", result.stderr)


if __name__ == "__main__":
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        print("skipped: no matplotlib")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
