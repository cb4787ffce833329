"""Drawings with matplotlib. The same measurements give the same bytes."""

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.hashsalt"] = "candil"
matplotlib.rcParams["svg.fonttype"] = "none"  # text stays text: small files
matplotlib.rcParams["font.family"] = "sans-serif"
import matplotlib.image  # noqa: E402
import matplotlib.pyplot  # noqa: E402
import matplotlib.ticker  # noqa: E402

from figures import REPORT_TABLE_1  # noqa: E402

COLORS = {"area": "#d08000", "point": "#2060b0"}
JPEG_QUALITY = 85


def write_jpeg(png, jpeg):
    """A PNG as a JPEG small enough to keep in the repository."""
    pixels = matplotlib.image.imread(png)[..., :3]
    matplotlib.image.imsave(jpeg, pixels.copy(order="C"),
                            pil_kwargs={"quality": JPEG_QUALITY, "optimize": True, "subsampling": 0})


def _save(plot, path):
    plot.savefig(path, metadata={"Date": None, "Creator": None}, bbox_inches="tight")
    matplotlib.pyplot.close(plot)


def _time_axes(measured):
    plot, axes = matplotlib.pyplot.subplots(figsize=(6.4, 4.2))
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xlabel("paths per pixel")
    axes.set_ylabel("seconds")
    axes.set_xticks([spp for spp, _ in measured["cases"][0]["seconds"]])
    axes.get_xaxis().set_major_formatter(matplotlib.ticker.ScalarFormatter())
    axes.grid(True, which="major", color="#dddddd")
    return plot, axes


def _threads(count):
    return "1 thread" if count == 1 else f"{count} threads"


def _draw_case(axes, case, label, style):
    axes.plot(*zip(*case["seconds"]), style, color=COLORS[case["light"]], label=label)


def draw_time_by_paths(measured, path):
    """Figure 2: area light, one thread and all, and the report's table 1."""
    plot, axes = _time_axes(measured)
    width, height = measured["size"]
    for case in measured["cases"]:
        if case["integrator"] == "path" and case["light"] == "area":
            style = "o-" if case["threads"] > 1 else "s-"
            _draw_case(axes, case, f"candil, {_threads(case['threads'])}, {width} x {height}", style)
    counts, parallel, sequential = zip(*REPORT_TABLE_1)
    axes.plot(counts, parallel, "o--", color="#888888", label="report, 8 threads, size not told")
    axes.plot(counts, sequential, "s--", color="#888888", label="report, sequential, size not told")
    axes.legend()
    _save(plot, path)


def draw_time_by_light(measured, path):
    """Figure 3: both lights with all threads, `path` and the report's estimator."""
    plot, axes = _time_axes(measured)
    for case in measured["cases"]:
        if case["threads"] == measured["threads"]:
            style = "o-" if case["integrator"] == "path" else "^--"
            _draw_case(axes, case, f"{case['light']} light, {case['integrator']}", style)
    axes.legend(title=f"{measured['size'][0]} x {measured['size'][1]}, {_threads(measured['threads'])}")
    _save(plot, path)


def draw_tile_schedule(schedule, path):
    """Figure 18: the tiles in the colours of their threads, numbered as each thread took them, and when."""
    colors = matplotlib.pyplot.get_cmap("tab10").colors
    plot, (image, time) = matplotlib.pyplot.subplots(1, 2, figsize=(11, 5.2))
    side = schedule["tile_size"]
    count = schedule["size"] // side
    pixels = [[(1, 1, 1)] * count for _ in range(count)]
    bars = {}
    for tile in sorted(schedule["tiles"], key=lambda tile: tile["begin_ms"]):
        column, row, thread = tile["x"] // side, tile["y"] // side, tile["thread"]
        pixels[row][column] = colors[thread % len(colors)]
        bars.setdefault(thread, []).append((tile["begin_ms"], tile["end_ms"] - tile["begin_ms"]))
        image.text(column, row, str(len(bars[thread])), ha="center", va="center", fontsize=6, color="white")
    image.imshow(pixels, interpolation="nearest")
    image.set(xticks=[], yticks=[], title="The tiles of each thread, numbered in its order")
    for thread, spans in sorted(bars.items()):
        time.broken_barh(spans, (thread - 0.35, 0.7), color=colors[thread % len(colors)], edgecolor="white",
                         linewidth=0.4)
    time.set(xlim=(0, None), xlabel="milliseconds", yticks=sorted(bars), title="When: one bar for each tile",
             yticklabels=[f"thread {thread + 1}" for thread in sorted(bars)])
    _save(plot, path)


DRAW = {"fig02_time.svg": draw_time_by_paths, "fig03_time.svg": draw_time_by_light,
        "fig18_tiles.svg": draw_tile_schedule}
