#!/usr/bin/env python3
"""Tests of docs/make_gallery: gallery_test.py CANDIL PROJECT. Exit code 77 (skipped) without matplotlib."""

import array
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CANDIL, PROJECT = (Path(argument) for argument in sys.argv[1:3])
SCRIPTS = PROJECT / "docs/make_gallery"
sys.path.insert(0, str(SCRIPTS))

import errors  # noqa: E402
import figures  # noqa: E402
import markdown  # noqa: E402
import program  # noqa: E402


def gallery(folder, *arguments):
    return subprocess.run([sys.executable, "-B", str(SCRIPTS), "--candil", str(CANDIL), "--output", str(folder),
                           *arguments], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


class TableOfFigures(unittest.TestCase):
    def test_has_every_figure_of_the_report_but_the_borrowed_one(self):
        # Figure 19 of the report shows a bounding volume hierarchy from an encyclopedia.
        self.assertEqual([figure.number for figure in figures.FIGURES], [n for n in range(1, 32) if n != 19])

    def test_every_row_shows_something_of_its_own(self):
        names = [panel.name for figure in figures.FIGURES for panel in figure.panels]
        self.assertEqual(len(names), len(set(names)))
        for figure in figures.FIGURES:
            self.assertTrue(figure.panels or figure.drawing in figures.DRAWINGS, figure.number)


class Errors(unittest.TestCase):
    def write(self, folder, data):
        path = Path(folder) / "picture.pfm"
        path.write_bytes(data)
        return path

    def test_reads_both_byte_orders(self):
        values = array.array("f", [0, 0.5, 1, 2, 4, 1e7])
        swapped = array.array("f", values)
        swapped.byteswap()
        little, big = (values, swapped) if sys.byteorder == "little" else (swapped, values)
        with tempfile.TemporaryDirectory() as folder:
            for scale, stored in ((b"-1.0", little), (b"1.0", big)):
                path = self.write(folder, b"PF\n2 1\n" + scale + b"\n" + stored.tobytes())
                self.assertEqual(errors.read_pfm(path), (2, 1, values))

    def test_refuses_what_is_cut_off(self):
        with tempfile.TemporaryDirectory() as folder:
            path = self.write(folder, b"PF\n2 1\n-1.0\n" + bytes(20))
            self.assertRaises(ValueError, errors.read_pfm, path)

    def test_relative_mse(self):
        # (1.1 - 1)^2 / (1 + 0.01) = 0.00990099 and (0.1 - 0)^2 / 0.01 = 1; their mean.
        self.assertAlmostEqual(errors.relative_mse([1.1, 0.1], [1, 0]), (0.01 / 1.01 + 1) / 2)
        self.assertEqual(errors.relative_mse([3, 0], [3, 0]), 0)


class StandIns(unittest.TestCase):
    def test_are_told_by_the_comment_of_their_file(self):
        with tempfile.TemporaryDirectory() as folder:
            scenes = Path(folder)
            (scenes / "models").mkdir()
            (scenes / "fig.json").write_text('{"objects": [{"type": "ply", "file": "models/bunny.ply"}]}')
            for comment, expected in (("comment a stand-in\n", True), ("", False)):
                (scenes / "models/bunny.ply").write_text(f"ply\nformat ascii 1.0\n{comment}element vertex 0\n")
                self.assertEqual(program.Program(CANDIL, scenes).has_stand_in("fig.json"), expected)


class Run(unittest.TestCase):
    def test_renders_figures_and_tells_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            scenes = folder / "scenes"
            scenes.mkdir()
            (scenes / "fig12_color_bleeding.json").write_text(
                '{"objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]}')
            (scenes / "fig25_glass_dragon.json").write_text('{"objects": [{"type": "ply", "file": "dragon.ply"}]}')
            result = gallery(folder, "--scenes", str(scenes), "--factor", "0.05", "12", "20", "25")
            self.assertEqual(result.returncode, 0, result.stderr)
            text = (folder / "gallery.md").read_text()
            for figure in figures.FIGURES:
                self.assertIn(f"## Figure {figure.number}: ", text)
            self.assertIn("](gallery/fig12.jpg)", text)
            self.assertEqual((folder / "gallery/fig12.jpg").read_bytes()[:2], b"\xff\xd8")
            text = " ".join(text.split())
            self.assertIn("`fig20`: fig20_three_bunnies.json does not exist; `./dev models`", text)
            self.assertIn("`fig25`: fig25_glass_dragon.json: ", text)
            self.assertFalse((folder / "gallery/fig25.jpg").exists())

    def test_refuses_an_unknown_figure(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(gallery(folder, "99").returncode, 2)


class Page(unittest.TestCase):
    def test_shows_measurements(self):
        run = {"quality": "quick", "processor": "a processor", "threads": 2, "load": 0.1, "candil": "candil 1"}
        seconds = [[16, 1.0], [64, 4.0], [256, 16.0], [1024, 64.0]]
        cases = [{"integrator": "path", "light": "area", "threads": threads, "seconds": seconds} for threads in (1, 2)]
        row = {"path": {"spp": 16, "seconds": 1, "relative_mse": 0.01},
               "classic": {"spp": 40, "seconds": 1, "relative_mse": 0.25}, "ratio": 25}
        results = {"timing": {"size": [64, 64], "rounds": 3, "threads": 2, "cases": cases, "run": run},
                   "comparison": {"size": [64, 64], "seeds": 5, "reference_spp": 8192, "run": run,
                                  "lights": {"area": [row]}}}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "gallery.md"
            markdown.write_markdown(path, results)
            text = path.read_text()
        self.assertIn("| **25** |", text)
        # 1024 paths for each of 64 x 64 pixels in 64 s are 65,536 paths per second; the report's 1024 ppp in 506.235 s
        # are 2.023 ppp/s: equal for sqrt(65536 / 2.023) = 180 pixels squared.
        self.assertIn("| table 1, 1024 ppp | 8 threads | 2.023 | 0.07 | 2 | 180 |", text)
        self.assertNotIn("None", text)


if __name__ == "__main__":
    try:
        import matplotlib  # noqa: F401
    except ModuleNotFoundError:
        print("skipped: no matplotlib")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
