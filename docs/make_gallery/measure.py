"""The measurements: times of figures 2 and 3 and table 1, the comparison with `classic`, and the tiles of figure 18."""

import json
import statistics
import subprocess
import tempfile
from pathlib import Path

from errors import read_pfm, relative_mse
from program import Unusable, processor_count

BOX = {"area": "fig01_box.json", "point": "fig04_box_point.json"}
PATH_COUNTS = (16, 64, 256, 1024)
REFERENCE_SEED = 1_000_003


def timing(program, quality, say):
    """Seconds to render the box, without loading it: the median of rounds in which all cases take turns."""
    all_threads = processor_count()
    cases = [("path", light, threads) for light in BOX for threads in sorted({1, all_threads})]
    cases += [("classic", light, all_threads) for light in BOX]
    size = (quality.timing_size, quality.timing_size)
    seconds = {}
    with tempfile.TemporaryDirectory() as folder:
        for spp in PATH_COUNTS:
            for turn in range(quality.timing_rounds):
                say(f"timing: {spp} paths per pixel, round {turn + 1} of {quality.timing_rounds}")
                for case in cases:
                    integrator, light, threads = case
                    stats = program.render(BOX[light], [Path(folder) / "timed.pfm"], size, spp,
                                           ("--integrator", integrator, "--threads", threads))
                    seconds.setdefault((case, spp), []).append(stats["render_seconds"])
    return {
        "size": size,
        "rounds": quality.timing_rounds,
        "threads": all_threads,
        "cases": [{"integrator": integrator, "light": light, "threads": threads,
                   "seconds": [[spp, statistics.median(seconds[(integrator, light, threads), spp])]
                               for spp in PATH_COUNTS]}
                  for integrator, light, threads in cases],
    }


class Comparison:
    """`path` against `classic` on one scene: relative error at equal time."""

    def __init__(self, program, scene, quality, folder):
        self.program, self.scene, self.folder = program, scene, Path(folder)
        self.size = (quality.comparison_size, quality.comparison_size)
        self.reference = self.image("path", quality.reference_spp, REFERENCE_SEED)[1]

    def image(self, integrator, spp, seed):
        """Seconds to render it, and its values."""
        picture = self.folder / "compared.pfm"
        stats = self.program.render(self.scene, [picture], self.size, spp, ("--integrator", integrator, "--seed", seed))
        return stats["render_seconds"], read_pfm(picture)[2]

    def rows(self, path_spp, seeds):
        """As many paths of `classic` as take as long as `path_spp` of `path`; then both in turns, seed by seed."""
        spp = {"path": path_spp}
        rate = {name: statistics.median(path_spp / self.image(name, path_spp, seed)[0] for seed in range(3))
                for name in ("path", "classic")}
        spp["classic"] = max(1, round(path_spp * rate["classic"] / rate["path"]))
        runs = {"path": [], "classic": []}
        for seed in range(1, seeds + 1):
            for name, results in runs.items():
                seconds, values = self.image(name, spp[name], seed)
                results.append((seconds, relative_mse(values, self.reference)))
        row = {}
        for name, results in runs.items():
            seconds = statistics.median(result[0] for result in results)
            error = statistics.median(result[1] for result in results)
            row[name] = {"spp": spp[name], "seconds": seconds, "relative_mse": error}
        # Times are never quite equal; an error that falls like 1 / time makes up for the rest.
        row["ratio"] = (row["classic"]["relative_mse"] * row["classic"]["seconds"] /
                        (row["path"]["relative_mse"] * row["path"]["seconds"]))
        return row


def comparison(program, quality, say):
    result = {"size": (quality.comparison_size,) * 2, "reference_spp": quality.reference_spp,
              "seeds": quality.comparison_seeds, "lights": {}}
    with tempfile.TemporaryDirectory() as folder:
        for light, scene in BOX.items():
            say(f"comparison: converged image, {light} light")
            compared = Comparison(program, scene, quality, folder)
            result["lights"][light] = []
            for spp in quality.comparison_spp:
                say(f"comparison: {spp} paths per pixel, {light} light")
                result["lights"][light].append(compared.rows(spp, quality.comparison_seeds))
    return result


def schedule(tile_program, scene):
    """Which thread rendered which tile, from the program of bench/tile_schedule.cpp."""
    if tile_program is None:
        raise Unusable("bench/tile_schedule was not built")
    output = subprocess.run([str(tile_program), str(scene)], check=True, text=True, stdout=subprocess.PIPE).stdout
    return json.loads(output)
