"""Runs `candil bench`, and keeps what it found in docs/benchmarks/results.json."""

import json
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

CONTESTANTS = ("embree", "sah", "wide", "report", "brute")
# A plain loop over all triangles needs some milliseconds for a ray of the largest scenes.
MOST_FOR_BRUTE = 100_000


@dataclass(frozen=True)
class Quality:
    name: str
    options: tuple  # of candil bench
    growth_options: tuple
    most_triangles: int  # of the growth


QUALITIES = {
    "quick": Quality("quick", ("--size", "128x128", "--spp", 2, "--repeat", 3, "--limit", 0.25),
                     ("--size", "128x128", "--spp", 1, "--repeat", 1, "--limit", 0.1), 100_000),
    "full": Quality("full", ("--size", "384x384", "--spp", 4, "--repeat", 5, "--limit", 0.4),
                    ("--size", "192x192", "--spp", 2, "--repeat", 3, "--limit", 0.25), 10_000_000),
}


def thread_counts():
    """1, 2, 4, ... and all there are; at most eight numbers."""
    most = len(os.sched_getaffinity(0))
    counts = [1 << i for i in range(most.bit_length()) if 1 << i < most][-7:] + [most]
    return counts if counts[0] == 1 else [1] + counts[1:]


class Benchmarks:
    """The measurements in `folder`. One that was made before stays until it is made again."""

    def __init__(self, folder, program, quality, say):
        self.folder, self.program, self.quality, self.say = folder, program, quality, say
        folder.mkdir(parents=True, exist_ok=True)
        self.file = folder / "results.json"
        self.results = json.loads(self.file.read_text()) if self.file.exists() else {}

    def measure_growth(self, key, scene, triangles):
        self._measure(key, scene, triangles, self.quality.growth_options)

    def measure(self, key, scene, primitives, plot):
        self._measure(key, scene, primitives, (*self.quality.options, "--plot", plot))

    def _measure(self, key, scene, primitives, options):
        """Runs all contestants on a scene; `primitives` tells whether brute force takes part."""
        names = [name for name in CONTESTANTS if name != "brute" or primitives <= MOST_FOR_BRUTE]
        self.say(f"{key}: {', '.join(names)}")
        with tempfile.TemporaryDirectory() as scratch:
            output = Path(scratch) / "bench.json"
            command = [self.program, "bench", scene, "--json", output, "--quiet", *options, "--threads",
                       ",".join(map(str, thread_counts()))]
            for name in names:
                command += ["--accel", name]
            result = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                    text=True)
            # 1: answers differ, which the page tells.
            if result.returncode not in (0, 1):
                raise RuntimeError(f"candil bench {scene}: exit code {result.returncode}\n{result.stderr}")
            found = json.loads(output.read_text())
        (measured,) = found.pop("scenes")
        measured["file"] = Path(measured["file"]).name
        self.results[key] = {**measured, "run": {**found, "quality": self.quality.name}}
        self._save()

    def _save(self):
        lines = (f"{json.dumps(key)}: {json.dumps(rounded(value))}" for key, value in sorted(self.results.items()))
        self.file.write_text("{\n" + ",\n".join(lines) + "\n}\n")


def rounded(value):
    """Five digits are more than any measurement has."""
    if isinstance(value, float):
        return float(f"{value:.5g}")
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return [rounded(item) for item in value] if isinstance(value, list) else value
