"""Renders the figures of the report and writes docs/gallery.md. Started by `./dev gallery`, which builds candil."""

import argparse
import sys
import time
from pathlib import Path

from figures import FIGURES
from markdown import write_markdown
from program import Program
from table import QUALITIES

ROOT = Path(__file__).resolve().parent.parent.parent


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./dev gallery", description="Renders the figures of the report and writes "
                                     "docs/gallery.md, its pictures and plots.")
    for quality, text in (("quick", "under ten minutes on two processors (default)"), ("good", "about two hours"),
                          ("overnight", "a night, or several")):
        parser.add_argument(f"--{quality}", dest="quality", action="store_const", const=quality, help=text)
    parser.add_argument("--output", type=Path, default=ROOT / "docs", metavar="FOLDER",
                        help="where gallery.md and gallery/ go (default: docs)")
    parser.add_argument("--candil", type=Path, default=ROOT / "build/release/candil", metavar="PROGRAM")
    parser.add_argument("--tile-schedule", type=Path, metavar="PROGRAM", help="bench/tile_schedule, for figure 18")
    parser.add_argument("--scenes", type=Path, default=ROOT / "scenes/report", metavar="FOLDER")
    parser.add_argument("--factor", type=float, default=1, metavar="X", help="of the width and height of the pictures")
    parser.add_argument("figures", nargs="*", metavar="FIGURE",
                        help="numbers of figures, or `comparison` (default: all); the others keep what they have")
    arguments = parser.parse_args()
    known = [str(figure.number) for figure in FIGURES] + ["comparison"]
    for name in arguments.figures:
        if name not in known:
            parser.error(f"no figure {name}; there are {' '.join(known)}")
    return arguments


def main():
    arguments = parse_arguments()
    try:
        from make import Gallery
    except ModuleNotFoundError as error:
        sys.exit(f"{error}: install the package python3-matplotlib")
    begin = time.monotonic()

    def say(text):
        print(f"gallery: {time.monotonic() - begin:5.0f} s  {text}", file=sys.stderr, flush=True)

    quality = QUALITIES[arguments.quality or "quick"]
    gallery = Gallery(arguments.output / "gallery", Program(arguments.candil.resolve(), arguments.scenes.resolve()),
                      quality, arguments.tile_schedule, arguments.factor, say)
    for figure in FIGURES:
        if not arguments.figures or str(figure.number) in arguments.figures:
            gallery.make(figure)
    if not arguments.figures or "comparison" in arguments.figures:
        gallery.compare()
    document = arguments.output / "gallery.md"
    write_markdown(document, gallery.results)
    say("done")
    print(document)


if __name__ == "__main__":
    main()
