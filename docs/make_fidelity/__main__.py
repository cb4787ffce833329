"""Renders the sample models beside reference pictures and writes docs/gltf-fidelity.md. Started by `./dev fidelity`,
which builds candil."""

import argparse
import json
import sys
import time
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def parse_arguments():
    parser = argparse.ArgumentParser(prog="./dev fidelity", description="Renders models beside reference pictures into "
                                     "build/fidelity and writes docs/gltf-fidelity.md.")
    parser.add_argument("--assets", type=Path, default=ROOT.parent / "shared/assets", metavar="FOLDER",
                        help="with gltf/, reference/ and env/ (default: ../shared/assets)")
    parser.add_argument("--cycles", metavar="PYTHON", help="a Python that has bpy, for the comparison with Blender Cycles")
    parser.add_argument("--only-cycles", action="store_true", help="leave the reference pictures aside")
    parser.add_argument("--candil", type=Path, default=ROOT / "build/release/candil", metavar="PROGRAM")
    parser.add_argument("--pictures", type=Path, default=ROOT / "build/fidelity", metavar="FOLDER",
                        help="where the pictures and the scores go (default: build/fidelity)")
    parser.add_argument("--output", type=Path, default=ROOT / "docs/gltf-fidelity.md", metavar="FILE")
    parser.add_argument("--draft", action="store_true", help="half the width and height and samples, to look at cameras")
    parser.add_argument("models", nargs="*", metavar="MODEL",
                        help="names or beginnings of names (default: all); the others keep the scores that they have")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    try:
        import beside as cycles_table
        from pairs import make_pair
        from program import Program
        from views import BESIDE, VIEWS
    except ModuleNotFoundError as error:
        sys.exit(f"{error}: install the package python3-pil")
    if not (arguments.assets / "gltf").is_dir():
        sys.exit(f"fidelity: no folder {arguments.assets / 'gltf'}; --assets FOLDER")
    begin = time.monotonic()

    def say(text):
        print(f"fidelity: {time.monotonic() - begin:5.0f} s  {text}", file=sys.stderr, flush=True)

    def is_wanted(name):
        return not arguments.models or any(name.startswith(model) for model in arguments.models)

    program, assets = Program(arguments.candil.resolve()), arguments.assets.resolve()
    arguments.pictures.mkdir(parents=True, exist_ok=True)
    # Scores live beside the pictures, so that a part can be made anew; the order is that of the tables.
    store = arguments.pictures / "scores.json"
    results = json.loads(store.read_text()) if store.exists() else {}
    views, beside = results.get("views", {}), results.get("cycles", {})
    for view in VIEWS:
        if is_wanted(view.name) and not arguments.only_cycles:
            views[view.name] = make_pair(view, program, assets, arguments.pictures, 0.5 if arguments.draft else 1)
            say(f"{view.name}: {views[view.name]}")
    for view in BESIDE:
        name = Path(view.model).parent.name
        if arguments.cycles and is_wanted(name):
            beside[name] = cycles_table.make_beside(view, program, assets, arguments.pictures, arguments.cycles)
            say(f"{name} (Cycles): {beside[name]}")
    names = [Path(view.model).parent.name for view in BESIDE]
    results = {"views": {view.name: views[view.name] for view in VIEWS if view.name in views},
               "cycles": {name: beside[name] for name in names if name in beside}}
    store.write_text(json.dumps(results, indent=1))

    from markdown import write_markdown
    remarks = tomllib.loads(Path(__file__).with_name("remarks.toml").read_text())
    write_markdown(arguments.output, results, remarks, program.version(),
                   {"environment": cycles_table.ENVIRONMENT, "spp": cycles_table.SPP, "size": cycles_table.SIZE,
                    "is_draft": arguments.draft})
    print(arguments.output)


if __name__ == "__main__":
    main()
