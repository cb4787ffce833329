"""Drawings with matplotlib. The same measurements give the same bytes."""

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "candil"
matplotlib.rcParams["svg.fonttype"] = "none"  # text stays text: small files
matplotlib.rcParams["font.family"] = "sans-serif"
import matplotlib.pyplot  # noqa: E402

import growth  # noqa: E402

COLORS = {"embree": "#0072b2", "sah": "#e69f00", "wide": "#009e73", "report": "#cc79a7", "brute": "#999999"}
GROWTH = {"growth_ray.svg": (growth.nanoseconds, "Nanoseconds per ray of the first bounce, 1 thread"),
          "growth_build.svg": (growth.build_seconds, "Seconds to build, all threads"),
          "growth_memory.svg": (growth.memory_bytes, "Bytes of the hierarchy")}


def draw_growth(results, folder):
    """One drawing for each figure that grows, logarithmic both ways."""
    for name, (value, label) in GROWTH.items():
        found = growth.curves(results, value)
        if not found:
            continue
        plot, axes = matplotlib.pyplot.subplots(figsize=(6.4, 4.2))
        axes.set(xscale="log", yscale="log", xlabel="triangles")
        axes.set_title(label, loc="left", fontsize=10)
        axes.grid(True, which="major", color="#dddddd")
        for contestant, points in found.items():
            axes.plot(*zip(*points), "o-", color=COLORS.get(contestant, "#000000"), label=contestant)
        axes.legend()
        plot.savefig(folder / name, metadata={"Date": None, "Creator": None}, bbox_inches="tight")
        matplotlib.pyplot.close(plot)
