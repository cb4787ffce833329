"""Writes docs/gallery.md from the table of figures and the results."""

import textwrap

from figures import DRAWINGS, FIGURES, REPORT_TABLE_1

INTRODUCTION = """# Gallery

The figures of the report that the project began from (*Path Tracing*, 2021), made again by `./dev gallery`, which also
writes this page. `./dev gallery --quick` takes under ten minutes on two processors; `--good` and `--overnight` make
larger pictures with less noise; `./dev gallery 5 7 comparison` makes some figures again. To add a figure, add a row to
[make_gallery/figures.py](make_gallery/figures.py).

Times are those of rendering alone, without loading. A path is one sample of one pixel; ppp is paths per pixel. The
report does not tell the size of its pictures, its processor, or (but for its table 1) its number of threads. So its
speed is known in ppp per second, not in paths per second: [below](#ours-beside-the-reports) are both. A load average
well above 0 before the run means that other programs were at work, and times are too long.
"""

DIFFERENCES = """What differs: the processor and how many of its threads, the size of the pictures, the models and the
arrangement of the scenes, the estimator (`path` samples area lights directly), the library that finds hits (Embree
here, a hierarchy of their own there), five years of compilers. The last column is the side in pixels that the report's
square pictures would need for both to be equally fast: if theirs were smaller, candil is the faster one."""

COMPARISON = """`--integrator classic` is the estimator of the report: a roulette chooses a lobe or absorbs, point
lights are sampled at each hit, area lights are found by chance. `path` samples a light of any kind at each hit and
weighs that against finding it by chance. Both get the same scene ({size} pixels) and as many paths as fit into the
same time, which is measured first. The error is the relative MSE, the mean of (x - r)^2 / (r^2 + 0.01) over all
pixels and channels, nothing trimmed, against r rendered by `path` with {reference_spp} paths per pixel and another
seed; median of {seeds} seeds, which take turns. The ratio says how many times larger the error of `classic` is at
equal time (what is left of a difference in time is made up for in proportion)."""

MISSING_HELP = "`./dev models` fetches or makes the models that are not in the repository"
WIDTH = 120


def _paragraph(text):
    return textwrap.fill(text, WIDTH, break_long_words=False, break_on_hyphens=False) + "\n"


def _table(header, rows, alignment=None):
    lines = ["| " + " | ".join(header) + " |", "| " + " | ".join(alignment or ["---"] * len(header)) + " |"]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


def _right(first, count):
    """One column to the left, `count` to the right."""
    return ["---"] * first + ["---:"] * count


def _time(seconds):
    if seconds < 100:
        return f"{seconds:.3g} s"
    return f"{seconds:.0f} s" if seconds < 600 else f"{seconds / 60:.0f} min"


def _size(size):
    return f"{size[0]} x {size[1]}"


def _threads(count):
    return "1 thread" if count == 1 else f"{count} threads"


def _report_time(report):
    if not report:
        return ""
    return f"{_time(report.seconds)}, {f'{report.spp} ppp' if report.spp else 'ppp not told'}"


def _pictures(figure, results):
    made = [panel for panel in figure.panels if "seconds" in results.get(panel.name, {})]
    if not made:
        return ""
    titles = [": ".join(filter(None, (figure.title, panel.label))) for panel in made]
    images = [f"![{title}](gallery/{panel.name}.jpg)" for title, panel in zip(titles, made)]
    return _table(images, [[panel.label for panel in made]], [":---:"] * len(made)) + "\n"


def _times(figure, results):
    rows, missing = [], {}
    has_report = any(panel.report for panel in figure.panels)
    for panel in figure.panels:
        result = results.get(panel.name, {"missing": f"`./dev gallery {figure.number}` renders it"})
        if "missing" in result:
            reason = result["missing"] + (f"; {MISSING_HELP}" if "run" in result else "")
            missing.setdefault(reason, []).append(f"`{panel.name}`")
            continue
        name = ", ".join(filter(None, (f"`{panel.scene}`", panel.label, "stand-in model" * result["has_stand_in"])))
        row = [name, result["spp"], _size(result["size"]), _time(result["seconds"]),
               f"{result['paths'] / result['seconds'] / 1e6:.2f}"]
        rows.append(row + [_report_time(panel.report)] * has_report)
    header = ["Scene", "Paths per pixel", "Size", "Time", "Million paths/s"] + ["Report"] * has_report
    table = _table(header, rows, _right(1, len(header) - 1)) if rows else ""
    notes = [_paragraph(f"Not rendered: {', '.join(names)}: {reason}.") for reason, names in missing.items()]
    return table + ("\n" if table and notes else "") + "\n".join(notes)


def _drawing(figure, results):
    result = results.get(DRAWINGS[figure.drawing], {"missing": f"`./dev gallery {figure.number}` measures it"})
    if "missing" in result:
        return _paragraph(f"Not drawn: {result['missing']}.")
    text = f"![{figure.title}](gallery/{figure.drawing})\n"
    if figure.drawing == "fig02_time.svg":
        text += "\n" + _table_1(result)
    return text


def _table_1(timing):
    """The report's table 1 beside ours."""
    by_threads = {case["threads"]: dict(case["seconds"]) for case in timing["cases"]
                  if case["integrator"] == "path" and case["light"] == "area"}
    counts = sorted(by_threads, reverse=True)
    rows = []
    for spp, parallel, sequential in REPORT_TABLE_1:
        ours = [f"{by_threads[threads][spp]:.3g} s" for threads in counts]
        gain = [f"{by_threads[1][spp] / by_threads[counts[0]][spp]:.2f}"] if len(counts) > 1 else []
        rows.append([spp, *ours, *gain, f"{parallel} s", f"{sequential} s", f"{sequential / parallel:.2f}"])
    header = (["Paths per pixel"] + [_threads(threads) for threads in counts] + ["gain"] * (len(counts) > 1) +
              ["report, 8 threads", "report, sequential", "gain"])
    caption = f"Table 1: {_size(timing['size'])} pixels, median of {timing['rounds']} rounds; all cases take turns."
    return (caption + "\n\n" + _table(header, rows, _right(0, len(header))))


def _beside_the_report(results):
    """Speed of ours and of the report wherever it gives a time."""
    rows = []

    def add(name, theirs, report_spp, report_seconds, paths_per_second, threads):
        rate = report_spp / report_seconds
        rows.append([name, theirs, f"{rate:.3f}", f"{paths_per_second / 1e6:.2f}", threads,
                     f"{(paths_per_second / rate) ** 0.5:.0f}"])

    timing = results.get("timing", {})
    for case in timing.get("cases", ()):
        if case["light"] == "area" and case["integrator"] == "path":
            spp, parallel, sequential = REPORT_TABLE_1[-1]
            seconds = dict(case["seconds"])[spp]
            paths = spp * timing["size"][0] * timing["size"][1]
            theirs, report_seconds = ("1 thread", sequential) if case["threads"] == 1 else ("8 threads", parallel)
            add("table 1, 1024 ppp", theirs, spp, report_seconds, paths / seconds, case["threads"])
    for figure in FIGURES:
        for panel in figure.panels:
            result = results.get(panel.name, {})
            if panel.report and panel.report.spp and "seconds" in result:
                add(f"figure {figure.number} {panel.label}", "not told", panel.report.spp, panel.report.seconds,
                    result["paths"] / result["seconds"], result["run"]["threads"])
    if not rows:
        return ""
    header = ["Picture", "Report: threads", "Report: ppp/s", "candil: million paths/s", "candil: threads",
              "Equal at side"]
    return ("## Ours beside the report's\n\n" + _paragraph(DIFFERENCES) + "\n" + _table(header, rows, _right(2, 4)))


def _comparison(results):
    found = results.get("comparison")
    if not found or "missing" in found:
        return ""
    text = _paragraph(COMPARISON.format_map({**found, "size": _size(found["size"])}))
    rows = []
    for light, measured in found["lights"].items():
        for row in measured:
            cells = [f"{row[name]['spp']} ppp, {row[name]['seconds']:.2f} s, {row[name]['relative_mse']:.2g}"
                     for name in ("path", "classic")]
            rows.append([f"{light} light", *cells, f"**{row['ratio']:.3g}**"])
    header = ["Box of figure 1", "`path`: error", "`classic`: error", "Ratio"]
    return "## `path` against the report's estimator\n\n" + text + "\n" + _table(header, rows, _right(1, 3))


def _runs(results):
    """What made the results: one line for each machine, version and quality."""
    made = {}
    for name, result in results.items():
        run = result.get("run")
        if run:
            line = (f"`--{run['quality']}` on {run['processor']}, {_threads(run['threads'])}, load average before "
                    f"{run['load']}; {run['candil']}")
            made.setdefault(line, []).append(name)
    if len(made) == 1:
        return _paragraph(f"This page: {next(iter(made))}.")
    return "".join(f"- {line}: {', '.join(sorted(names))}\n" for line, names in sorted(made.items()))


def write_markdown(path, results):
    parts = [INTRODUCTION, _runs(results)]
    for figure in FIGURES:
        heading = f"## Figure {figure.number}: {figure.title}\n\n{_paragraph(figure.text)}\n"
        shown = _drawing(figure, results) if figure.drawing else _pictures(figure, results) + _times(figure, results)
        parts.append(heading + shown)
    parts += [_beside_the_report(results), _comparison(results)]
    path.write_text("\n".join(part for part in parts if part))
