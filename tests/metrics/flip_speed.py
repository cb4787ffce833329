#!/usr/bin/env python3
"""`candil compare` and flip-evaluator in turn on two pictures: flip_speed.py CANDIL A B [RUNS]

Both are whole programs: start, read, measure. candil measures all of its metrics, the other one FLIP alone. Needs
flip-evaluator (PyPI). EXR files are compared as high dynamic range."""

import os
import statistics
import sys
import time

REFERENCE = """
import sys
import flip_evaluator
kind, a, b = sys.argv[1:]
print(flip_evaluator.evaluate(a, b, kind, applyMagma=False)[1])
"""


def run(command):
    """Wall and processor seconds, and the most memory in MB."""
    started = time.perf_counter()
    child = os.posix_spawnp(command[0], command, os.environ,
                            file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)])
    _, status, usage = os.wait4(child, 0)
    wall = time.perf_counter() - started
    if os.waitstatus_to_exitcode(status) not in (0, 1):  # 1: candil found a difference
        sys.exit(f"failed: {' '.join(command)}")
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    candil, a, b = sys.argv[1:4]
    runs = int(sys.argv[4]) if len(sys.argv) > 4 else 5
    kind = "HDR" if a.lower().endswith(".exr") else "LDR"
    commands = {"candil": [candil, "compare", a, b], "flip-evaluator": [sys.executable, "-c", REFERENCE, kind, a, b]}
    results = {name: [] for name in commands}
    for _ in range(runs):
        for name, command in commands.items():
            results[name].append(run(command))
    medians = {name: [statistics.median(column) for column in zip(*rows)] for name, rows in results.items()}
    for name, (wall, cpu, memory) in medians.items():
        print(f"{name:16} {wall:7.2f} s {cpu:7.2f} s of processor {memory:7.0f} MB   median of {runs}, {kind}")
    ratios = [theirs[0] / ours[0] for ours, theirs in zip(results["candil"], results["flip-evaluator"])]
    cpu_ratios = [theirs[1] / ours[1] for ours, theirs in zip(results["candil"], results["flip-evaluator"])]
    print(f"candil is faster by {statistics.median(ratios):.1f} (processor: {statistics.median(cpu_ratios):.1f}), "
          f"pair by pair from {min(ratios):.1f} to {max(ratios):.1f}")


if __name__ == "__main__":
    main()
