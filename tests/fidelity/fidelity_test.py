#!/usr/bin/env python3
"""Tests of docs/make_fidelity: fidelity_test.py CANDIL PROJECT. Exit code 77 (skipped) without Pillow."""

import base64
import json
import struct
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

CANDIL, PROJECT = (Path(argument) for argument in sys.argv[1:3])
SCRIPTS = PROJECT / "docs/make_fidelity"
sys.path.insert(0, str(SCRIPTS))

try:
    from PIL import Image
except ModuleNotFoundError:
    sys.exit(77)

import views  # noqa: E402


def run(*command):
    return subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def triangle():
    positions = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    uri = "data:application/octet-stream;base64," + base64.b64encode(positions).decode()
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                           "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": uri}]}


class Page(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.assets = Path(self.folder.name)
        for name in ("Triangle", "TriangleWithoutIndices"):
            (self.assets / "gltf" / name).mkdir(parents=True)
            (self.assets / f"gltf/{name}/{name}.gltf").write_text(json.dumps(triangle()))
        self.references = self.assets / "reference/khronos-screenshots"
        self.references.mkdir(parents=True)

    def tearDown(self):
        self.folder.cleanup()

    def make(self, *arguments):
        page = self.assets / "page.md"
        result = run(sys.executable, "-B", SCRIPTS, "--assets", self.assets, "--candil", CANDIL, "--pictures",
                     self.assets / "pictures", "--output", page, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return page.read_text()

    def test_scores_are_those_of_the_pictures(self):
        """One reference is our own picture over red, one is white: FLIP 0 and SSIM 1, and others."""
        view = next(view for view in views.VIEWS if view.name == "Triangle")
        ours = self.assets / "ours.png"
        run(CANDIL, self.assets / "gltf" / view.model, "-o", ours, "--size", "200x200", "--spp", view.spp, "--transparent",
            "--quiet", *view.options)
        with Image.open(ours) as opened:
            Image.alpha_composite(Image.new("RGBA", (200, 200), "#ff0000"), opened).convert("RGB").save(
                self.references / "Triangle.png")
        Image.new("RGB", (64, 64), "#ffffff").save(self.references / "TriangleWithoutIndices.png")
        page = self.make("Triangle")
        self.assertIn("| Triangle | smallest file | 0.000 | 1.000 |", page)
        line = next(line for line in page.splitlines() if line.startswith("| TriangleWithoutIndices |"))
        self.assertNotIn("| 0.000 | 1.000 |", line)
        with Image.open(self.assets / "pictures/Triangle.png") as pair:
            self.assertEqual(pair.size, (2 * 200 + 4, 200))
        (self.assets / "gltf/Triangle/Triangle.gltf").write_text("{}")
        page = self.make("Triangle")
        self.assertIn("*Not rendered: ", page)

    def test_every_remark_has_a_row(self):
        names = {view.name for view in views.VIEWS}
        names |= {f"{Path(view.model).parent.name} (Cycles)" for view in views.BESIDE}
        self.assertEqual(set(tomllib.loads((SCRIPTS / "remarks.toml").read_text())) - names, set())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
