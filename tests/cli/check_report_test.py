#!/usr/bin/env python3
"""Looks at the pages of `candil check --html` in a browser: check_report_test.py CANDIL.

Exit code 77 (skipped) without Chromium."""

import json
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import chromium

CANDIL = sys.argv[1]

SUITE = """[defaults]
args = ["--size", "48x32", "--spp", "4"]
[[test]]
name = "changed"
scene = "changed.json"
[[test]]
name = "kept"
scene = "kept.json"
[[test]]
name = "new"
scene = "kept.json"
"""


def scene(radiance):
    """A wall that fills the picture, as bright everywhere, without noise."""
    return json.dumps({
        "camera": {"look_from": [0, 0, 3], "look_at": [0, 0, 0], "fov": 20},
        "materials": {"wall": {"type": "lambertian", "kd": 0, "emission": radiance}},
        "objects": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 0, 1], "material": "wall"}],
        "environment": {"color": 0},
    })


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        (cls.path / "suite.toml").write_text(SUITE)
        for name in ("changed", "kept"):
            (cls.path / f"{name}.json").write_text(scene(0.25))
        assert cls.check("--update", "changed", "kept") == 0
        (cls.path / "changed.json").write_text(scene(0.5))
        assert cls.check("--html", "report") == 1
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    @classmethod
    def check(cls, *words):
        return subprocess.run([CANDIL, "check", "suite.toml", "-q", *words], cwd=cls.path,
                              stdout=subprocess.DEVNULL).returncode

    def setUp(self):
        self.browser.events.clear()
        self.browser.open(self.path / "report" / "index.html")

    def text(self, element):
        return self.browser.evaluate(f"document.getElementById('{element}').textContent")

    def color(self, x):
        """Of the middle row of the view, at this share of its width."""
        return self.browser.evaluate(
            "(() => { const view = document.getElementById('view'); return view.getContext('2d').getImageData("
            f"Math.floor(view.width * {x}), Math.floor(view.height / 2), 1, 1).data[0]; }})()")

    def look_closer(self):
        self.browser.evaluate("document.querySelector('article#changed a').click()")
        self.browser.wait_until("document.body?.dataset.ready === 'yes'")

    def test_lists_failures_with_pictures_and_what_to_do(self):
        self.assertEqual(self.browser.evaluate("Array.from(document.querySelectorAll('article'), (a) => a.id).sort()"),
                         ["changed", "new"])
        self.assertIn("2 of 3 tests failed", self.browser.evaluate("document.body.textContent"))
        self.assertEqual(self.browser.evaluate("Array.from(document.querySelectorAll('article#changed img'), "
                                               "(image) => image.naturalWidth)"), [48] * 4)
        self.assertIn("--update changed", self.browser.evaluate("document.querySelector('#changed').textContent"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('article#new a').length"), 0)
        self.assertEqual(self.browser.complaints(), [])

    def test_looks_closer_at_a_failure(self):
        self.look_closer()
        self.assertIn("changed", self.browser.evaluate("document.title"))
        self.assertEqual(self.browser.complaints(), [])
        dark, bright = 137, 188  # sRGB of 0.25 and of 0.5
        self.assertEqual((self.color(0.4), self.color(0.6)), (dark, bright))  # the slider is in the middle
        for _ in range(10):
            self.browser.press("ArrowRight")
        self.assertEqual(self.color(0.6), dark)
        self.browser.press("1")
        self.assertEqual(self.text("shown"), "A")
        self.browser.press("]")
        self.browser.press("]")
        self.assertEqual((self.text("exposure-value"), self.color(0.4)), ("+1", bright))
        self.browser.press("\\")
        self.browser.press("f")
        seen = set()
        end = time.monotonic() + 10
        while len(seen) < 2 and time.monotonic() < end:
            seen.add(self.color(0.4))
            time.sleep(0.05)
        self.assertEqual(seen, {dark, bright})
        self.browser.press("9")
        self.assertEqual(self.text("zoom"), "100 %")

    def test_pages_of_what_passes_go(self):
        page = self.path / "report" / "compare" / "changed.html"
        self.assertTrue(page.exists())
        (self.path / "changed.json").write_text(scene(0.25))
        try:
            self.assertEqual(self.check("--html", "report", "--filter", "changed"), 0)
            self.assertFalse(page.exists())
        finally:
            (self.path / "changed.json").write_text(scene(0.5))
            self.assertEqual(self.check("--html", "report"), 1)


if __name__ == "__main__":
    if not chromium.find():
        print("no Chromium: skipped")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
