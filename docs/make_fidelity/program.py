"""Runs the candil program."""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path


class Refused(Exception):
    """What candil says of a file that it does not render."""


@dataclass(frozen=True)
class Program:
    binary: Path

    def _run(self, *arguments, allowed=(0,)):
        result = subprocess.run([str(self.binary), *map(str, arguments)], text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)
        if result.returncode == 3:
            raise Refused(result.stderr.strip().splitlines()[-1].removeprefix("error: "))
        if result.returncode not in allowed:
            raise RuntimeError(f"candil {' '.join(map(str, arguments))}: exit code {result.returncode}\n{result.stderr}")
        return result

    def render(self, model, outputs, size, spp, options):
        """Returns the warnings. Raises Refused."""
        targets = [argument for output in outputs for argument in ("-o", output)]
        result = self._run("render", model, *targets, "--size", f"{size[0]}x{size[1]}", "--spp", spp, "--quiet", *options)
        return [line.removeprefix("warning: ") for line in result.stderr.splitlines() if line.startswith("warning: ")]

    def info(self, model):
        return json.loads(self._run("info", model, "--json").stdout)

    def compare(self, reference, image):
        """The metrics of the two pictures, by name."""
        text = self._run("compare", reference, image, "--json", "--quiet", allowed=(0, 1)).stdout
        return json.loads(text)["layers"][0]["metrics"]

    def tonemap(self, image, output):
        self._run("tonemap", image, "-o", output, "--quiet")

    def version(self):
        return self._run("--version").stdout.strip()
