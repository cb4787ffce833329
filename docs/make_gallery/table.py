"""What a row of the table of figures is made of."""

from dataclasses import dataclass
from typing import Optional, Tuple


@dataclass(frozen=True)
class ReportTime:
    """What the report says of one of its pictures. None: not said."""
    seconds: float
    spp: Optional[int]
    threads: Optional[int] = None


@dataclass(frozen=True)
class Panel:
    """One picture of a figure: docs/gallery/NAME.jpg."""
    name: str
    label: str
    scene: str                            # file of scenes/report
    size: Tuple[int, int] = (512, 512)    # width and height in pixels, times the quality's factor
    spp: int = 256                        # paths per pixel, times the quality's factor
    keeps_spp: bool = False               # the same at every quality: the figure is about them
    options: Tuple[str, ...] = ()         # of `candil render`
    operator: Optional[str] = None        # of `candil tonemap`; panels of one scene share one render
    report: Optional[ReportTime] = None


@dataclass(frozen=True)
class Figure:
    """One figure of the report: `panels`, or a `drawing` of what is measured."""
    number: int
    title: str
    text: str
    panels: Tuple[Panel, ...] = ()
    drawing: Optional[str] = None         # file in docs/gallery; DRAWINGS in figures.py tells how it is made


@dataclass(frozen=True)
class Quality:
    """How much work a gallery is."""
    name: str
    size: float                # factor of a panel's width and height
    samples: float             # factor of its paths per pixel
    fixed_size: float          # factor of width and height where the paths per pixel are fixed
    timing_size: int           # width and height in pixels of the timed pictures of figures 2 and 3
    timing_rounds: int
    comparison_size: int       # width and height in pixels of the comparison with `classic`
    comparison_spp: Tuple[int, ...]
    comparison_seeds: int
    reference_spp: int


QUALITIES = {
    "quick": Quality("quick", 0.5, 1 / 8, 0.3125, 48, 3, 64, (16, 64), 5, 4096),
    "good": Quality("good", 1, 1, 1, 128, 5, 128, (16, 64, 256), 9, 16384),
    "overnight": Quality("overnight", 1.5, 4, 1.5, 256, 9, 256, (16, 64, 256, 1024), 9, 65536),
}
