#!/usr/bin/env python3
"""Looks at reports of `candil compare --html` in a browser: compare_report_test.py CANDIL SCENE.

Exit code 77 (skipped) without Chromium."""

import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import chromium
import image_files

CANDIL, SCENE = sys.argv[1:3]

# A dark left half and a bright right half of one colour each; B has another green. 0.25 at +1 stop is 0.5.
WIDTH, HEIGHT = 60, 40
LINEAR_A = [[(0.25, 0.125, 0.0) if x < 30 else (2.0, 4.0, 0.5) for x in range(WIDTH)] for _ in range(HEIGHT)]
LINEAR_B = [[(r, g * 2, b) for r, g, b in row] for row in LINEAR_A]
DISPLAY_A = [[(200, 100, 50) if x < 30 else (10, 20, 30) for x in range(WIDTH)] for _ in range(HEIGHT)]
DISPLAY_B = [[(r, g + 60, b) for r, g, b in row] for row in DISPLAY_A]


def srgb(linear):
    linear = min(max(linear, 0), 1)
    return round(255 * (12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055))


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = Path(cls.folder.name)
        image_files.write_pfm(cls.path / "a.pfm", WIDTH, HEIGHT, LINEAR_A)
        image_files.write_pfm(cls.path / "b.pfm", WIDTH, HEIGHT, LINEAR_B)
        image_files.write_png(cls.path / "a.png", WIDTH, HEIGHT, DISPLAY_A)
        image_files.write_png(cls.path / "<b>&.png", WIDTH, HEIGHT, DISPLAY_B)
        cls.compare("a.pfm", "b.pfm", "linear.html")
        cls.compare("a.png", "<b>&.png", "display.html")
        for seed in ("0", "1"):
            subprocess.run([CANDIL, SCENE, "-q", "-o", f"{seed}.exr", "--size", "24x16", "--spp", "2", "--seed", seed,
                            "--aov", "depth"], cwd=cls.path, check=True)
        cls.compare("0.exr", "1.exr", "layers.html", "--layer", "all")
        cls.browser = chromium.Browser(chromium.find())

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.folder.cleanup()

    @classmethod
    def compare(cls, a, b, report, *more):
        result = subprocess.run([CANDIL, "compare", a, b, "--html", report, "-q", *more], cwd=cls.path)
        assert result.returncode == 1, result

    def open(self, report):
        self.browser.events.clear()
        self.browser.open(self.path / report)
        self.browser.wait_until("document.body?.dataset.ready === 'yes'")
        box = self.browser.evaluate("(() => { const box = document.getElementById('view').getBoundingClientRect();"
                                    "return [box.left, box.top, box.width, box.height]; })()")
        self.left, self.top, self.width, self.height = box

    def text(self, element):
        return self.browser.evaluate(f"document.getElementById('{element}').textContent")

    def color(self, x, y=None):
        """What the canvas shows at this share of its width and height."""
        return tuple(self.browser.evaluate(
            "(() => { const view = document.getElementById('view');"
            f"return Array.from(view.getContext('2d').getImageData(Math.floor(view.width * {x}),"
            f"Math.floor(view.height * {y or 0.5}), 1, 1).data.slice(0, 3)); }})()"))

    def at_pixel(self, x, y):
        """The middle of an image's pixel on the screen, as long as the picture fits and lies in the middle."""
        zoom = float(self.text("zoom").split()[0]) / 100
        left, top = (round((size - zoom * pixels) / 2)
                     for size, pixels in ((self.width, WIDTH), (self.height, HEIGHT)))
        return self.left + left + zoom * (x + 0.5), self.top + top + zoom * (y + 0.5)

    def test_asks_for_nothing_and_complains_of_nothing(self):
        for report in ("linear.html", "display.html", "layers.html"):
            self.open(report)
            for key in "123sf[]\\+-09l?":
                self.browser.press(key)
            addresses = [url for url in self.browser.requests() if not url.startswith("data:")]
            self.assertEqual(addresses, [(self.path / report).resolve().as_uri()])
            self.assertEqual(self.browser.complaints(), [])

    def test_shows_a_and_b(self):
        self.open("display.html")
        self.browser.press("1")
        self.assertEqual(self.text("shown"), "A")
        self.assertEqual((self.color(0.4), self.color(0.6)), ((200, 100, 50), (10, 20, 30)))
        self.browser.press("2")
        self.assertEqual(self.text("shown"), "B")
        self.assertEqual((self.color(0.4), self.color(0.6)), ((200, 160, 50), (10, 80, 30)))
        self.browser.evaluate("document.querySelector('[data-mode=a]').click()")
        self.assertEqual(self.text("shown"), "A")
        self.assertIn("<b>&.png", self.browser.evaluate("document.querySelector('header').textContent"))

    def test_slider_divides_the_picture(self):
        self.open("display.html")
        self.assertEqual(self.text("shown"), "A | B")
        self.assertEqual((self.color(0.4), self.color(0.6)), ((200, 100, 50), (10, 80, 30)))
        for _ in range(20):  # by 0.02 of the picture each
            self.browser.press("ArrowRight")
        self.assertEqual(self.color(0.6), (10, 20, 30))
        x, y = self.at_pixel(10, 20)
        self.browser.mouse("Pressed", x, y, button="left", buttons=1, clickCount=1)
        self.assertEqual(self.color(0.4), (200, 160, 50))
        x, y = self.at_pixel(58, 20)
        self.browser.mouse("Moved", x, y, button="left", buttons=1)
        self.browser.mouse("Released", x, y, button="left", clickCount=1)
        self.assertEqual((self.color(0.4), self.color(0.6)), ((200, 100, 50), (10, 20, 30)))
        x, y = self.at_pixel(5, 20)
        self.browser.mouse("Moved", x, y)  # no button is down
        self.assertEqual(self.color(0.4), (200, 100, 50))

    def test_flicker_alternates(self):
        self.open("display.html")
        self.browser.press("f")
        seen = set()
        end = time.monotonic() + 10
        while len(seen) < 2 and time.monotonic() < end:
            seen.add((self.text("shown"), self.color(0.4)))
            time.sleep(0.05)
        # The two answers may fall on either side of a change; the colours are what counts.
        self.assertEqual({color for _, color in seen}, {(200, 100, 50), (200, 160, 50)})
        self.browser.press("1")
        time.sleep(1.2)
        self.assertEqual((self.text("shown"), self.color(0.4)), ("A", (200, 100, 50)))

    def test_heat_map_has_the_colours_of_the_picture(self):
        self.open("display.html")
        self.browser.press("3")
        self.assertEqual(self.text("shown"), "FLIP")
        colors = self.browser.evaluate("JSON.parse(document.getElementById('data').textContent).colors")
        self.assertIn(list(self.color(0.4)), colors[20:])

    def test_zooms_to_the_pointer_and_tells_pixels(self):
        self.open("display.html")
        zoom = float(self.text("zoom").split()[0])
        x, y = self.at_pixel(29, 20)
        self.browser.mouse("Moved", x, y)
        self.assertIn("29,20  A 200 100  50   B 200 160  50   FLIP ", self.text("pixel"))
        for _ in range(8):
            self.browser.mouse("Wheel", x, y, deltaX=0, deltaY=-100)
        self.assertAlmostEqual(float(self.text("zoom").split()[0]) / (zoom * 1.25 ** 8), 1, delta=0.01)
        self.browser.mouse("Moved", x + 1, y)
        self.assertIn("29,20 ", self.text("pixel"))  # still under the pointer
        self.browser.press("-")
        self.assertAlmostEqual(float(self.text("zoom").split()[0]) / (zoom * 1.25 ** 8 / 2), 1, delta=0.01)
        self.browser.press("0")
        self.assertEqual(float(self.text("zoom").split()[0]), zoom)
        self.browser.press("9")
        self.assertEqual(self.text("zoom"), "100 %")
        self.browser.mouse("Moved", self.left + 2, self.top + 2)
        self.assertEqual(self.text("pixel").strip(), "")

    def test_exposure_changes_what_is_seen_and_not_what_is_told(self):
        self.open("linear.html")
        self.browser.press("1")
        expected = {0: (0.25, 0.125, 0.0), 1: (0.5, 0.25, 0.0), -3: (0.03125, 0.015625, 0.0)}
        self.assertEqual(self.color(0.4), tuple(map(srgb, expected[0])))
        self.assertEqual(self.color(0.6), (255, 255, srgb(0.5)))
        for _ in range(2):
            self.browser.press("]")
        self.assertEqual(self.text("exposure-value"), "+1")
        self.assertEqual(self.color(0.4), tuple(map(srgb, expected[1])))
        for _ in range(8):
            self.browser.press("[")
        self.assertEqual(self.color(0.4), tuple(map(srgb, expected[-3])))
        self.assertEqual(self.color(0.6), tuple(map(srgb, (0.25, 0.5, 0.0625))))
        x, y = self.at_pixel(50, 10)
        self.browser.mouse("Moved", x, y)
        self.assertEqual(self.text("pixel").split()[:8], ["50,10", "A", "2.000", "4.000", "0.5000", "B", "2.000", "8.000"])
        self.browser.press("\\")
        self.assertEqual(self.color(0.4), tuple(map(srgb, expected[0])))
        self.browser.evaluate("(() => { const slider = document.getElementById('exposure'); slider.value = 1;"
                              "slider.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.color(0.4), tuple(map(srgb, expected[1])))

    def test_display_values_have_no_exposure(self):
        self.open("display.html")
        self.assertTrue(self.browser.evaluate("document.getElementById('exposure-group').hidden"))
        before = self.color(0.4)
        self.browser.press("]")
        self.assertEqual(self.color(0.4), before)

    def test_layers_take_turns(self):
        self.open("layers.html")
        names = self.browser.evaluate("Array.from(document.querySelectorAll('#layer option'), (o) => o.textContent)")
        self.assertEqual(names, ["picture", "depth"])
        visible = ("Array.from(document.querySelectorAll('.layer')).filter((s) => !s.hidden)"
                   ".map((s) => s.querySelector('h2').textContent).join()")
        self.assertEqual(self.browser.evaluate(visible), "picture")
        self.browser.press("l")
        self.assertEqual(self.browser.evaluate(visible), "depth")
        self.browser.press("3")
        self.assertEqual(self.text("shown"), "error")
        self.browser.press("l")
        self.assertEqual(self.browser.evaluate(visible), "picture")

    def test_help_lists_the_keys(self):
        self.open("display.html")
        self.assertTrue(self.browser.evaluate("document.getElementById('keys').hidden"))
        self.browser.press("?")
        self.assertFalse(self.browser.evaluate("document.getElementById('keys').hidden"))

    def test_pictures_and_numbers_are_there_without_scripts(self):
        self.browser.send("Emulation.setScriptExecutionDisabled", value=True)
        try:
            self.browser.open(self.path / "linear.html")
            sizes = self.browser.evaluate("Array.from(document.images, (image) => image.naturalWidth * "
                                          "(image.getBoundingClientRect().width > 0))")
            self.assertEqual(sizes, [WIDTH] * 3)
            self.assertTrue(self.browser.evaluate("document.getElementById('viewer').hidden"))
            self.assertTrue(self.browser.evaluate("document.querySelectorAll('.histogram rect').length > 10"))
            self.assertIn("relmse", self.browser.evaluate("document.querySelector('table').textContent"))
        finally:
            self.browser.send("Emulation.setScriptExecutionDisabled", value=False)


if __name__ == "__main__":
    if not chromium.find():
        print("no Chromium: skipped")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
