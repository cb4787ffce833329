"""Measures accelerators and writes docs/benchmarks.md. Started by `./dev bench`, which builds candil."""

import argparse
import sys
import time
from pathlib import Path

import growth
from measure import QUALITIES, Benchmarks
from scenes import ROOT, SCENES, SceneFolder

KNOWN = [scene.name for scene in SCENES] + ["growth"]


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./dev bench", description="Measures accelerators on the rays of renders and "
                                     "writes docs/benchmarks.md and its plots.")
    parser.add_argument("--quick", action="store_true", help="a few minutes; smaller pictures, less growth")
    parser.add_argument("--output", type=Path, default=ROOT / "docs", metavar="FOLDER",
                        help="where benchmarks.md and benchmarks/ go (default: docs)")
    parser.add_argument("--candil", type=Path, default=ROOT / "build/release/candil", metavar="PROGRAM")
    parser.add_argument("--scenes", type=Path, default=ROOT / "build/bench", metavar="FOLDER",
                        help="where scenes are kept that scripts make (default: build/bench)")
    parser.add_argument("--assets", type=Path, default=ROOT.parent / "shared/assets", metavar="FOLDER",
                        help="sample models, if there are any (default: ../shared/assets)")
    parser.add_argument("parts", nargs="*", metavar="PART",
                        help=f"{', '.join(KNOWN)} (default: all); the others keep what they have")
    arguments = parser.parse_args()
    for name in arguments.parts:
        if name not in KNOWN:
            parser.error(f"no part {name}; there are {' '.join(KNOWN)}")
    return arguments


def main():
    arguments = parse_arguments()
    try:
        import plots
        from markdown import write_markdown
    except ModuleNotFoundError as error:
        sys.exit(f"{error}: install the package python3-matplotlib")
    begin = time.monotonic()

    def say(text):
        print(f"bench: {time.monotonic() - begin:5.0f} s  {text}", file=sys.stderr, flush=True)

    quality = QUALITIES["quick" if arguments.quick else "full"]
    folder = arguments.output / "benchmarks"
    scenes = SceneFolder(arguments.scenes.resolve(), arguments.assets.resolve(), say)
    benchmarks = Benchmarks(folder, arguments.candil.resolve(), quality, say)
    document = arguments.output / "benchmarks.md"
    wanted = arguments.parts or KNOWN

    def write():
        plots.draw_growth(benchmarks.results, folder)
        write_markdown(document, benchmarks.results)

    for scene in SCENES:
        if scene.name in wanted:
            # Those beside the Cornell box are too large for brute force, or have no triangles to count.
            primitives = 30 if scene.name == "cornell" else 10 ** 9
            benchmarks.measure(scene.name, scenes.path(scene), primitives, folder / f"{scene.name}.svg")
            write()
    if "growth" in wanted:
        for triangles in growth.sizes(quality.most_triangles):
            benchmarks.measure_growth(growth.key_of(triangles), scenes.terrain(triangles), triangles)
        write()
    say("done")
    print(document)


if __name__ == "__main__":
    main()
