"""The figure of the benchmark: time for a position against error, and cost against size."""

from __future__ import annotations

import io
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from benchmarks.growth import Chain
from benchmarks.rivals import Rival
from planmethod.bench.measurements import ReadSpeed

MARKS = (
    ("sweep, float64", "o", "#1f5aa6"),
    ("sweep, machine code", "P", "#d2691e"),
    ("sweep, bound call", "*", "#d2691e"),
    ("sweep, float32", "s", "#5aa61f"),
    ("step by step", "D", "#7b3fa0"),
    ("solve()", "D", "#b58cc9"),
    ("referee", "^", "#b3261e"),
    ("the hand", "v", "#8a6d00"),
)


def draw(
    readings: Sequence[ReadSpeed],
    rivals: Sequence[Rival],
    positions: Sequence[tuple[int, float]],
    links: Sequence[Chain],
) -> bytes:
    """Return the figure as PNG: two log-log plots side by side."""
    figure = Figure(figsize=(11, 5.2), layout="constrained")
    FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2)
    _errors(left, readings, rivals)
    _growth(right, positions, links)
    target = io.BytesIO()
    figure.savefig(target, format="png", dpi=110, metadata={"Software": None})
    return target.getvalue()


def _errors(axes: Axes, readings: Sequence[ReadSpeed], rivals: Sequence[Rival]) -> None:
    for start, mark, colour in MARKS:
        mine = [r for r in readings if r.name.startswith(start) and r.error == r.error]
        if not mine:
            continue
        axes.loglog(
            [r.per_position for r in mine],
            [max(r.error, 1e-60) for r in mine],
            mark,
            color=colour,
            label=start,
            markersize=6,
            markerfacecolor="none" if start == "solve()" else colour,
        )
    for rival in rivals:
        if rival.error and not rival.name.startswith("planmethod"):
            axes.loglog(
                [rival.seconds[n].median / n for n in rival.error],
                list(rival.error.values()),
                "x",
                label=rival.name,
                markersize=7,
            )
    stored = [r.per_position for r in readings if r.name.startswith("its results stored")]
    if stored:  # nothing that keeps its results is to the left of it
        limit = min(stored)
        axes.axvline(limit, color="0.4", linestyle=":", label="results stored, nothing computed")
    axes.set_xlabel("time for a position, s")
    axes.set_ylabel("largest error, parts of the largest value")
    axes.set_ylim(1e-55, 1)
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.legend(fontsize=8, loc="lower left")
    axes.set_title("Speed against error", fontsize=11)


def _growth(
    axes: Axes,
    positions: Sequence[tuple[int, float]],
    links: Sequence[Chain],
) -> None:
    axes.loglog(
        [n for n, _ in positions],
        [seconds / n for n, seconds in positions],
        "o-",
        color="#1f5aa6",
        label="slotted link, by positions in a call",
    )
    axes.loglog(
        [one.links for one in links],
        [one.many / one.count for one in links],
        "s-",
        color="#5aa61f",
        label="chain of dyads, by links, 10⁴ positions",
    )
    axes.loglog(
        [one.links for one in links],
        [one.ready for one in links],
        "^--",
        color="#b3261e",
        label="chain of dyads, by links: to prepare, once",
    )
    axes.set_xlabel("positions in a call; links")
    axes.set_ylabel("time for a position (to prepare), s")
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.legend(fontsize=8)
    axes.set_title("Cost against size", fontsize=11)
