# SPDX-License-Identifier: BSD-3-Clause
"""How figures look: colours, type, and the SVG that becomes part of a page or a file of its own."""

from __future__ import annotations

import io
import math
import re
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import wraps
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from lrrt.report.formatting import plain_number

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

P = ParamSpec("P")
T = TypeVar("T")

INK = "#24292f"  #: text, axes, the baseline; on a page it becomes the page's own colour of text
#: Distinct to colour-blind eyes (Okabe and Ito 2008, without black and yellow).
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00")
LINES = ("-", "--", ":", "-.")
MARKERS = ("o", "s", "^", "D")
GRID = "#80808050"
MOST_LINES = 12  #: curves in one panel; more are spread over several

_SETTINGS: dict[Any, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Helvetica", "Arial", "sans-serif"],
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.0,
    "axes.edgecolor": INK,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.facecolor": "none",
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "lines.linewidth": 1.7,
    "svg.fonttype": "none",
    "text.color": INK,
    "text.parse_math": False,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
}


@dataclass(frozen=True)
class Look:
    """How one planner is drawn in every figure."""

    colour: str
    line: str
    marker: str


@dataclass(frozen=True)
class Picture:
    """A figure with its words."""

    name: str  #: of its file, without extension
    title: str
    caption: str
    figure: Figure

    @property
    def label(self) -> str:
        """Title and caption, for readers that cannot see it."""
        return f"{self.title}. {self.caption}"


def styled(function: Callable[P, T]) -> Callable[P, T]:
    """Has matplotlib draw in this style while a function runs; the user's settings come back after it."""

    @wraps(function)
    def inside(*args: P.args, **kwargs: P.kwargs) -> T:
        import matplotlib

        with matplotlib.rc_context(_SETTINGS), warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Glyph")  # text stays text; the reader's fonts have it
            return function(*args, **kwargs)

    return inside


def looks(names: Iterable[str], baseline: str) -> dict[str, Look]:
    """A look for every planner: the baseline in the colour of text, the others in colours, then in other lines."""
    others = [name for name in dict.fromkeys(names) if name != baseline]
    result = {baseline: Look(INK, "-", "o")}
    for i, name in enumerate(others):
        turn = i // len(COLOURS)
        result[name] = Look(COLOURS[i % len(COLOURS)], LINES[turn % len(LINES)], MARKERS[(turn + 1) % len(MARKERS)])
    return result


def new_figure(width: float, height: float) -> Figure:
    """An empty figure, inches, that needs no window."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def plain_axis(axis: Axis, log: bool = False, room: float = 0.09, high: float = math.inf) -> None:
    """Marks at round numbers, written out; on a logarithmic axis as ``log_marks``, up to a number."""
    from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullLocator

    if log:
        left, right = axis.get_view_interval()
        marks = [mark for mark in log_marks(left, right, room) if mark <= high]
        axis.set_major_locator(FixedLocator(marks))
        axis.set_minor_locator(NullLocator())
    else:
        axis.set_major_locator(MaxNLocator(4))
    axis.set_major_formatter(FuncFormatter(lambda value, _: plain_number(value)))


def log_marks(low: float, high: float, room: float) -> list[float]:
    """1, 2 and 5 times powers of ten, or fewer, so that neighbours are at least such a share of the axis apart."""
    exponents = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    marks = [digit * 10.0**e for e in exponents for digit in (1, 2, 5)]
    span = math.log10(high / low)
    steps = ((1, math.log10(2)), (3, 1), (6, 2))  # every so many marks; decades between those
    every = next((every for every, decades in steps if decades / span >= room), 9)
    return [mark for mark in marks[::every] if low <= mark <= high]  # the first of all marks is a power of ten


def panels(names: list[str]) -> list[list[str]]:
    """Names spread evenly over as few panels as hold them."""
    count = -(-len(names) // MOST_LINES)
    size = -(-len(names) // count)
    return [names[i : i + size] for i in range(0, len(names), size)]


def side_legend(axes: Axes) -> None:
    """A legend right of the axes."""
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles, labels, loc="upper left", bbox_to_anchor=(1.02, 1.02), borderaxespad=0.0, handlelength=2.6)


def shown(name: str, most: int = 40) -> str:
    """A name as a figure shows it: not too long, and never hidden (matplotlib hides what begins with a bar)."""
    name = "".join(c if c.isprintable() else " " for c in name)
    short = name if len(name) <= most else name[: most - 1] + "…"
    return f" {short}" if short.startswith("_") else short


@styled
def svg_file(picture: Picture) -> str:
    """A figure as an SVG file on white ground."""
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": picture.name}):  # same figure, same file
        picture.figure.savefig(text, format="svg", facecolor="white", metadata={"Date": None})
    return _without_far_digits(text.getvalue())


@styled
def svg_element(picture: Picture, prefix: str) -> str:
    """A figure as an element of a page: no ground of its own, ink in the page's colour, names of its own."""
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": prefix}):
        picture.figure.savefig(text, format="svg", facecolor="none", metadata={"Date": None})
    svg = _without_far_digits(text.getvalue())
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r' xmlns(:\w+)?="[^"]*"', "", svg)
    svg = re.sub(r'\bid="', f'id="{prefix}-', svg)
    svg = re.sub(r'(url\(#|href="#)', rf"\g<1>{prefix}-", svg)
    return svg.replace(INK, "currentColor").strip()


def _without_far_digits(svg: str) -> str:
    """Lines to a hundredth of a point: a third of the file is digits that no screen shows."""
    return re.sub(r'\bd="[^"]*"', lambda path: re.sub(r"(\.\d\d)\d+", r"\1", path[0]), svg)
