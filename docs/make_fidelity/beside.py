"""The same model by candil and by Blender Cycles: same camera, same environment, linear values."""

import json
import math
import subprocess
from pathlib import Path

from PIL import Image

from pairs import side_by_side
from program import Refused

SIZE = 256
SPP = 64
FOV = 40  # degrees
ENVIRONMENT = "blender_interior.exr"


def _camera(view, bounds):
    """Eye and the point it looks at."""
    low, high = bounds["low"], bounds["high"]
    center = [(a + b) / 2 for a, b in zip(low, high)]
    radius = math.dist(low, high) / 2
    distance = radius / math.sin(math.radians(FOV) / 2) / view.zoom
    azimuth, elevation = math.radians(view.azimuth), math.radians(view.elevation)
    towards = (math.cos(elevation) * math.sin(azimuth), math.sin(elevation), math.cos(elevation) * math.cos(azimuth))
    return [c + distance * t for c, t in zip(center, towards)], center


def _list(values):
    return ",".join(repr(float(value)) for value in values)


def _render_by_cycles(python, job, picture):
    """What went wrong, if anything. A picture of the same job is kept: Cycles does not change while candil does."""
    note = picture.with_suffix(".json")
    if picture.exists() and note.exists() and note.read_text() == job:
        return None
    picture.unlink(missing_ok=True)
    worker = Path(__file__).with_name("cycles_worker.py")
    # -P: modules of this folder must not stand in for Blender's.
    result = subprocess.run([python, "-P", str(worker), job], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if result.returncode or not picture.exists():
        lines = result.stdout.strip().splitlines()
        return lines[-1] if lines else "no picture"
    note.write_text(job)
    return None


def make_beside(view, program, assets, folder, python):
    """Writes FOLDER/cycles-NAME.png (Cycles to the left); returns scores, or why there are none."""
    model, environment = assets / "gltf" / view.model, assets / "env" / ENVIRONMENT
    stem = f"cycles-{Path(view.model).parent.name}"
    ours, theirs = folder / f"{stem}-candil.exr", folder / f"{stem}-cycles.exr"
    try:
        eye, center = _camera(view, program.info(model)["bounds"])
        # Blender shows the middle of an environment along +X, candil along -Z.
        options = ["--look-from=" + _list(eye), "--look-at=" + _list(center), "--fov", FOV, "--env", environment,
                   "--env-rotate", "-90", "--filter", "box"]
        warnings = program.render(model, [ours], (SIZE, SIZE), SPP, options)
    except Refused as error:
        return {"refused": str(error).replace(f"{assets}/", "")}
    job = {"model": str(model.resolve()), "environment": str(environment.resolve()), "eye": eye, "center": center,
           "fov": FOV, "size": SIZE, "spp": SPP, "output": str(theirs.resolve())}
    error = _render_by_cycles(python, json.dumps(job), theirs)
    if error:
        return {"refused": f"Cycles: {error}"}
    pictures = []
    for image in (theirs, ours):
        picture = image.with_suffix(".png")
        program.tonemap(image, picture)
        with Image.open(picture) as opened:
            pictures.append(opened.convert("RGB"))
    side_by_side(folder / f"{stem}.png", *pictures)
    metrics = program.compare(theirs, ours)
    # The displays' FLIP: what is seen; that for high dynamic range counts fireflies of either renderer.
    display = program.compare(theirs.with_suffix(".png"), ours.with_suffix(".png"))
    return {"flip": display["flip"], "ssim": display["ssim"], "relmse": metrics["relmse"], "bias": metrics["bias"],
            "warnings": [warning.replace(f"{assets}/", "") for warning in warnings]}
