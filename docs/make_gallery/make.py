"""Renders pictures and takes measurements, and keeps what was found in docs/gallery/results.json."""

import json
import os
import tempfile
import time
from pathlib import Path

import measure
import plots
from figures import DRAWINGS
from program import Unusable, processor, processor_count


class Gallery:
    """The pictures and results in `folder`. A result that was made before stays until it is made again."""

    def __init__(self, folder, program, quality, tile_program, size_factor, say):
        self.folder, self.program, self.quality = folder, program, quality
        self.tile_program, self.size_factor, self.say = tile_program, size_factor, say
        folder.mkdir(parents=True, exist_ok=True)
        self.file = folder / "results.json"
        self.results = json.loads(self.file.read_text()) if self.file.exists() else {}
        self.run = {"quality": quality.name, "processor": processor(), "threads": processor_count(),
                    "candil": program.version(), "load": round(os.getloadavg()[0], 1)}
        self.done = set()
        self.scratch = tempfile.TemporaryDirectory()
        self.linear = {}  # scenes of high dynamic range that are rendered already: their file, what --stats tells

    def keep(self, name, result):
        self.results[name] = {**result, "run": self.run}
        self.done.add(name)
        lines = (f"{json.dumps(key)}: {json.dumps(value)}" for key, value in sorted(self.results.items()))
        self.file.write_text("{\n" + ",\n".join(lines) + "\n}\n")

    def attempt(self, name, work):
        """Keeps what work() returns, or why it could not be done."""
        if name in self.done:
            return
        begin = time.monotonic()
        try:
            self.keep(name, work())
        except Unusable as error:
            self.keep(name, {"missing": str(error)})
            (self.folder / f"{name}.jpg").unlink(missing_ok=True)
        self.say(f"{name}: {time.monotonic() - begin:.1f} s")

    def make(self, figure):
        for panel in figure.panels:
            self.attempt(panel.name, lambda: self.picture(panel))
        if figure.drawing:
            name = DRAWINGS[figure.drawing]
            self.attempt(name, lambda: self.measurement(name))
            if "missing" not in self.results[name]:
                for drawing in (drawing for drawing, shown in DRAWINGS.items() if shown == name):
                    plots.DRAW[drawing](self.results[name], self.folder / drawing)

    def measurement(self, name):
        if name == "timing":
            return measure.timing(self.program, self.quality, self.say)
        return measure.schedule(self.tile_program, self.program.scenes / measure.BOX["area"])

    def compare(self):
        self.attempt("comparison", lambda: measure.comparison(self.program, self.quality, self.say))

    def picture(self, panel):
        factor = self.size_factor * (self.quality.fixed_size if panel.keeps_spp else self.quality.size)
        size = [max(1, round(side * factor)) for side in panel.size]
        spp = panel.spp if panel.keeps_spp else max(1, round(panel.spp * self.quality.samples))
        png = Path(self.scratch.name) / "picture.png"
        if panel.operator:
            if panel.scene not in self.linear:
                image = Path(self.scratch.name) / f"{len(self.linear)}.exr"
                self.linear[panel.scene] = image, self.program.render(panel.scene, [image], size, spp, panel.options)
            image, stats = self.linear[panel.scene]
            self.program.tonemap(image, png, panel.operator)
        else:
            stats = self.program.render(panel.scene, [png], size, spp, panel.options)
        plots.write_jpeg(png, self.folder / f"{panel.name}.jpg")
        return {"size": size, "spp": spp, "seconds": stats["render_seconds"], "paths": stats["samples"],
                "has_stand_in": self.program.has_stand_in(panel.scene)}
