"""Writes docs/gltf-fidelity.md from the scores and the remarks."""

import textwrap

WIDTH = 120

INTRODUCTION = """\
Pictures of candil beside pictures by others, for every model of the sample assets that has a reference. `./dev
fidelity --assets FOLDER` renders them and writes this page; the pictures themselves, of which most models are
other people's, stay in `build/fidelity`, reference to the left. FOLDER has `gltf/`, `reference/` and `env/`; the names
are those of the Khronos sample assets, their screenshots, the Khronos 3D Commerce certification renders (3DC) and the
test images of SwiftGLTF."""

SCORES = """\
The references are rasterised, under lights that are mostly not told and with other tone mapping, and cameras
are matched by eye. So FLIP (0: the same, mean over the picture at 67 pixels per degree) and SSIM (1: the same) say how far
two looks are apart, not which is right; the remarks are the result. They were written by looking at each pair."""

CYCLES = """\
Same camera, same environment (`{environment}`, seen in the background too), {spp} paths per pixel, {size} x {size} pixels,
Blender's glTF importer with light units SPEC; its lamps are then multiplied by 683 lm/W, as candil has one unit for
candela and for the environment's radiance. FLIP and SSIM of the pictures as shown, relative MSE ((a - b)^2 / (b^2 + 0.01))
and bias (mean difference, of the channel where it is largest) of linear values, b being Cycles. `./dev fidelity --cycles
PYTHON` makes this table with a PYTHON that has `bpy`."""


def _paragraph(text):
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False) + "\n"


def _table(header, rows, alignment):
    lines = ["| " + " | ".join(header) + " |", "| " + " | ".join(alignment) + " |"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def _remark(result, remarks, name):
    note = remarks.get(name, {}).get("remark", "")
    # What this version lacks says itself: remarks outlive it.
    lacking = [warning for warning in result.get("warnings", []) if "not supported" in warning]
    note = " ".join(filter(None, [note] + [f"*{text[0].upper()}{text[1:]}.*" for text in lacking]))
    if "refused" in result:
        return " ".join(filter(None, [f"*Not rendered: {result['refused']}.*", note]))
    return note


def _scores(result, *keys):
    return ["" if "refused" in result else f"{result[key]:.3f}" for key in keys]


def write_markdown(path, results, remarks, version, settings):
    parts = ["# glTF: our pictures beside those of others\n", _paragraph(INTRODUCTION), _paragraph(SCORES),
             f"Made by {version}{', with --draft' * settings['is_draft']}.\n", "## Beside reference pictures\n"]
    rows = [[name, remarks.get(name, {}).get("tests", ""), *_scores(result, "flip", "ssim"), _remark(result, remarks, name)]
            for name, result in results.get("views", {}).items()]
    parts.append(_table(["Model", "What it tests", "FLIP", "SSIM", "Remark"], rows,
                        ["---", "---", "---:", "---:", "---"]))
    beside = results.get("cycles", {})
    if beside:
        parts += ["## Beside Blender Cycles\n", _paragraph(CYCLES.format(**settings))]
        rows = [[name, *_scores(result, "flip", "ssim", "relmse", "bias"), _remark(result, remarks, f"{name} (Cycles)")]
                for name, result in beside.items()]
        parts.append(_table(["Model", "FLIP", "SSIM", "Relative MSE", "Bias", "Remark"], rows,
                            ["---", "---:", "---:", "---:", "---:", "---"]))
    path.write_text("\n".join(parts))
