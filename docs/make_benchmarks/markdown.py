"""Writes docs/benchmarks.md from the results."""

import textwrap

import growth
from plots import GROWTH
from scenes import SCENES

WIDTH = 120
KINDS = {"primary": "primary", "first_bounce": "first bounce", "deeper_bounces": "deeper bounces", "shadow": "shadow"}

INTRODUCTION = """# Benchmarks

Accelerators side by side, on the rays of real renders. `./dev bench` makes the scenes, measures, and writes this page;
`./dev bench --quick` takes a few minutes and measures less; `./dev bench forest` measures one scene again. Each table
is a run of `candil bench`: every answer is compared with Embree's before anything is timed, contestants take turns, and
rates are medians of all repetitions, with the lowest and the highest. The factor is that to Embree in the same
repetition. "bare Embree" is `rtcIntersect1` and `rtcOccluded1` in a loop. [architecture.md](architecture.md) tells how
it is measured.

| Contestant | |
| --- | --- |
| `embree` | Intel's library as the renderer uses it: robust, default quality |
| `sah` | binary hierarchy by binned surface area heuristic, nearer child first |
| `wide` | eight children in a node, tested at once: the fastest of our own |
| `report` | the hierarchy of the report that the project began from: median splits, no order, no pruning |
| `brute` | a plain loop over all primitives in double precision, up to 100,000 of them |
"""

GROWTH_TEXT = """The same hills in more and more triangles, seen from the same place. The exponent k is that of the power
law n^k that fits a curve best: 1 for a loop over all triangles, 0.09 for a pure logarithm from a thousand to ten million.
What the hierarchies have above that may come from caches that no longer hold them; that was not measured."""

RENDERER_TEXT = """How much of a render is spent in its rays: the time of their bare replay, by `embree`, over that of the
render. 1 would be a renderer that costs nothing. Depths come from renders that end after no, one, and any number of
bounces."""


def paragraph(text):
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False) + "\n"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "| " + " | ".join(["---"] + ["---:"] * (len(header) - 1)) + " |"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


def digits(value):
    """Two or three digits that count."""
    if value >= 0.1:
        return f"{value:.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"
    return f"{value:.2g}"


def in_seconds(seconds):
    for unit, factor in (("s", 1), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= factor or unit == "us":
            return f"{digits(seconds / factor)} {unit}"


def in_bytes(count):
    for unit, factor in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3), ("B", 1)):
        if count >= factor or unit == "B":
            return f"{digits(count / factor)} {unit}" if factor > 1 else f"{count:.0f} B"


def threads_text(count):
    return "1 thread" if count == 1 else f"{count} threads"


def rate_cell(rate, all_rays):
    if not rate["rays"]:
        return "-"
    spread = rate["rays_per_second"]
    part = "\\*" if rate["rays"] < all_rays else ""
    return (f"**{digits(spread['median'] / 1e6)}**{part} ({digits(spread['min'] / 1e6)} to "
            f"{digits(spread['max'] / 1e6)}) x{rate['ratio']['median']:.2f}")


def rate_table(result, index):
    header = [f"Mrays/s, {threads_text(result['contestants'][0]['rates'][index]['threads'])}", *KINDS.values()]
    entries = [(f"`{c['name']}`", c["rates"][index]) for c in result["contestants"]]
    if result["bare_embree"]:
        entries.append(("bare Embree", result["bare_embree"][index]))
    rows = [[name, *(rate_cell(rates[kind], result["rays"][kind]) for kind in KINDS)] for name, rates in entries]
    return table(header, rows)


def build_table(result):
    contestants = result["contestants"]
    has_instances = contestants[0]["bytes_per_instance"] is not None
    triangles = result["scene"]["triangles"]
    header = (["Build"] + [threads_text(build["threads"]) for build in contestants[0]["build"]] +
              ["million primitives/s", "memory", "per primitive"] + ["per instance"] * has_instances)
    rows = []
    for c in contestants:
        seconds = [build["seconds"]["median"] for build in c["build"]]
        primitives = c["memory_bytes"] / c["bytes_per_primitive"] if c["bytes_per_primitive"] else triangles
        row = [f"`{c['name']}`", *map(in_seconds, seconds), digits(primitives / seconds[-1] / 1e6),
               in_bytes(c["memory_bytes"]), in_bytes(c["bytes_per_primitive"])]
        rows.append(row + ([in_bytes(c["bytes_per_instance"])] if has_instances else []))
    return table(header, rows)


def agreement_text(result):
    parts = []
    for c in result["contestants"][1:]:
        counts = [sum(a[what] for a in c["agreement"].values()) for what in ("rays", "ties", "mismatches")]
        parts.append("`{}` {:,} answers, {:,} ties, {:,} wrong".format(c["name"], *counts))
    return paragraph("Compared with `embree`: " + "; ".join(parts) + ".") if parts else ""


def has_parts(result):
    return any(c["rates"][0][kind]["rays"] < result["rays"][kind] for c in result["contestants"] for kind in KINDS)


def scene_text(scene, result):
    counts = result["scene"]
    facts = [f"{counts['triangles']:,} triangles" if counts["triangles"] else "",
             f"{counts['instanced_triangles']:,} with instances"
             if counts["instanced_triangles"] != counts["triangles"] else "",
             f"{counts['shapes']:,} shape{'s' * (counts['shapes'] != 1)}" if counts["shapes"] else ""]
    settings = result["run"]["settings"]
    rays = sum(result["rays"].values())
    text = paragraph(f"{scene.text} {', '.join(filter(None, facts))}. {rays:,} rays of {settings['width']} x "
                     f"{settings['height']} pixels, {settings['spp']} samples each.")
    parts = [f"## {scene.title}\n", text, f"![Rates: {scene.title}](benchmarks/{scene.name}.svg)\n",
             build_table(result)]
    parts += [rate_table(result, i) for i in range(len(result["contestants"][0]["rates"]))]
    if has_parts(result):
        parts.append("\\* of a part of the rays, evenly chosen: all of them would take too long.\n")
    return "\n".join(parts + [agreement_text(result)])


def growth_text(results):
    if not growth.curves(results, growth.nanoseconds):
        return ""
    parts = ["## Growth\n", paragraph(GROWTH_TEXT)]
    formats = {"growth_ray.svg": lambda v: f"{digits(v)} ns", "growth_build.svg": in_seconds,
               "growth_memory.svg": in_bytes}
    for name, (value, label) in GROWTH.items():
        found = growth.curves(results, value)
        counts = sorted({n for points in found.values() for n, _ in points})
        rows = []
        for contestant, points in found.items():
            by_count, k = dict(points), growth.exponent(points)
            rows.append([f"`{contestant}`", *(formats[name](by_count[n]) if n in by_count else "-" for n in counts),
                         "-" if k is None else f"{k:.2f}"])
        parts += [f"![{label} by number of triangles](benchmarks/{name})\n",
                  table([label, *(f"{n:,}" for n in counts), "k"], rows)]
    return "\n".join(parts)


def threads_section(results):
    """How much faster rays are with more threads, where there are more."""
    result = results.get("three_bunnies")
    if not result or len(result["contestants"][0]["rates"]) < 2:
        return ""
    counts = [rates["threads"] for rates in result["contestants"][0]["rates"]]
    rows = []
    for c in result["contestants"]:
        for kind, title in KINDS.items():
            base = c["rates"][0][kind]["rays_per_second"]["median"]
            if base:
                rows.append([f"`{c['name']}`, {title}"] +
                            [f"{rates[kind]['rays_per_second']['median'] / base:.2f}" for rates in c["rates"]])
    return "\n".join(["## Threads\n", paragraph("Rates of the three bunnies with more threads, beside those of one."),
                      table(["Rays", *map(threads_text, counts)], rows)])


def renderer_section(results):
    rows = []
    for scene in SCENES:
        for renderer in results.get(scene.name, {}).get("renderer", ()):
            shares = [renderer["share"]["median"], renderer["primary_share"]["median"], renderer["first_bounce_share"],
                      renderer["deeper_share"], renderer["share_of_bare_embree"]["median"]]
            rows.append([f"{scene.title}, {threads_text(renderer['threads'])}",
                         digits(renderer["rays_per_second"]["median"] / 1e6),
                         digits(renderer["samples_per_second"]["median"] / 1e6),
                         *(f"{share:.2f}" if share else "-" for share in shares)])
    if not rows:
        return ""
    header = ["Scene", "Mrays/s in the render", "Msamples/s", "share of its rays", "primary",
              "first bounce, its shadows", "deeper", "beside bare Embree"]
    return "\n".join(["## The renderer\n", paragraph(RENDERER_TEXT), table(header, rows)])


def runs(results):
    """What made the results: one line for each machine, version and quality."""
    made = {}
    for key, result in results.items():
        run = result["run"]
        machine, versions = run["machine"], run["versions"]
        line = (f"`--{run['quality']}` on {machine['processor']}, {machine['hardware_threads']} processors; candil "
                f"{versions['candil']}, Embree {versions['embree']}, {machine['compiler']}; "
                f"{run['settings']['repetitions']} repetitions")
        made.setdefault(line, []).append((key, machine["load"]))
    lines = []
    for line, keys in sorted(made.items()):
        loads = [load for _, load in keys]
        which = "" if len(made) == 1 else ": " + ", ".join(sorted(key for key, _ in keys))
        lines.append(f"{line}; load average before the runs {min(loads):.1f} to {max(loads):.1f}{which}")
    return paragraph(f"This page: {lines[0]}.") if len(lines) == 1 else "".join(f"- {line}\n" for line in lines)


def write_markdown(path, results):
    parts = [INTRODUCTION, runs(results)]
    parts += [scene_text(scene, results[scene.name]) for scene in SCENES if scene.name in results]
    parts += [growth_text(results), threads_section(results), renderer_section(results)]
    path.write_text("\n".join(part.rstrip("\n") + "\n" for part in parts if part))
