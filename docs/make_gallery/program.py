"""Runs the candil program."""

import json
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path


class Unusable(Exception):
    """A scene that candil cannot render, with its one-line error: a file is missing, or wrong."""


@dataclass(frozen=True)
class Program:
    """The candil program, and the folder of the scenes that it is given."""
    binary: Path
    scenes: Path

    def _run(self, *arguments):
        result = subprocess.run([str(self.binary), *map(str, arguments)], text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)
        if result.returncode == 3:
            raise Unusable(result.stderr.strip().splitlines()[-1].removeprefix("error: "))
        if result.returncode:
            command = " ".join(map(str, arguments))
            raise RuntimeError(f"candil {command}: exit code {result.returncode}\n{result.stderr}")
        return result.stdout

    def render(self, scene, outputs, size, spp, options=()):
        """Renders a file of the folder of scenes; returns what --stats tells. Raises Unusable."""
        path = self.scenes / scene
        if not path.exists():
            raise Unusable(f"{scene} does not exist")
        with tempfile.TemporaryDirectory() as folder:
            stats = Path(folder) / "stats.json"
            targets = [argument for output in outputs for argument in ("-o", output)]
            try:
                self._run("render", path, *targets, "--size", f"{size[0]}x{size[1]}", "--spp", spp, "--stats", stats,
                          "--quiet", *options)
            except Unusable as error:
                raise Unusable(str(error).replace(f"{self.scenes}{os.sep}", "")) from None
            return json.loads(stats.read_text())

    def has_stand_in(self, scene):
        """Whether `./dev models` had to make up a model of the scene: the comment of its file says so."""
        models = re.findall(r'"(models/[^"]+)"', (self.scenes / scene).read_text())
        return any(b"stand-in" in (self.scenes / model).read_bytes()[:200] for model in models)

    def tonemap(self, image, output, operator):
        self._run("tonemap", image, "-o", output, "--operator", operator, "--quiet")

    def version(self):
        return self._run("--version").strip()


def processor():
    """The processor's own name, without the noise of a server's."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        return "unknown processor"
    name = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    return " ".join(name.group(1).split()) if name else "unknown processor"


def processor_count():
    return len(os.sched_getaffinity(0))
