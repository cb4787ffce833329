"""The scenes of the benchmarks, and how they come to be: most are written by scripts, once, into a folder of build/."""

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SCRIPTS = ROOT / "scenes/bench"
BUNNY = "meshes/stanford/bun_zipper.ply"  # below a folder of assets
MODELS = ROOT / "scenes/report/models"  # where ./dev models puts its bunny


@dataclass(frozen=True)
class BenchScene:
    name: str
    title: str
    text: str
    file: str  # below the folder of scenes; absolute: it is there


SCENES = [
    BenchScene("three_bunnies", "Three bunnies", "The scene of the report's comparisons: three scanned bunnies of some "
               "69,000 triangles each, on a floor under a lamp.", "three_bunnies/three_bunnies.json"),
    BenchScene("terrain", "Terrain", "One mesh of a million small triangles of about one size.", "terrain_1000000.glb"),
    BenchScene("hairball", "Hairball", "600,000 slivers, eighty times as long as wide, across each other: boxes around "
               "them are mostly empty.", "hairball_600000.glb"),
    BenchScene("sphere_flake", "Sphere flake", "66,430 real spheres and a plane; no triangle.", "sphere_flake.json"),
    BenchScene("forest", "Forest", "25,000 instances of two trees, 122 million triangles: two levels.",
               "forest/forest.json"),
    BenchScene("cornell", "Cornell box", "30 triangles: what a ray costs before there is anything to search.",
               str(ROOT / "scenes/report/cornell.gltf")),
]


class SceneFolder:
    def __init__(self, folder, assets, say):
        self.folder, self.assets, self.say = folder, assets, say
        folder.mkdir(parents=True, exist_ok=True)

    def bunny(self):
        """A real one, or one of our own."""
        for path in (self.assets / BUNNY, MODELS / "bunny.ply"):
            if path.is_file():
                return path
        stand_in = self.folder / "stand_in/bunny.ply"
        if not stand_in.is_file():
            self._run(ROOT / "scenes/make_stand_ins.py", stand_in.parent, "bunny")
        return stand_in

    def terrain(self, triangles):
        path = self.folder / f"terrain_{triangles}.glb"
        if not path.is_file():
            self._run(SCRIPTS / "make_terrain.py", triangles, path)
        return path

    def path(self, scene):
        """Of the scene's file, which is made if it is not there."""
        path = self.folder / scene.file
        if path.is_file():
            return path
        path.parent.mkdir(parents=True, exist_ok=True)
        if scene.name == "terrain":
            return self.terrain(1_000_000)
        arguments = {"three_bunnies": ("make_bunnies.py", self.bunny, path.parent),
                     "hairball": ("make_hairball.py", 600_000, path),
                     "sphere_flake": ("make_sphere_flake.py", 5, path),
                     "forest": ("make_forest.py", 25_000, path.parent)}[scene.name]
        script, *values = arguments
        self._run(SCRIPTS / script, *(value() if callable(value) else value for value in values))
        return path

    def _run(self, script, *arguments):
        self.say(f"{script.name} {' '.join(map(str, arguments))}")
        subprocess.run([sys.executable, "-B", str(script), *map(str, arguments)], check=True,
                       stdout=subprocess.DEVNULL)
