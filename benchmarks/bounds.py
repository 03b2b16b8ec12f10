"""Limits of the speed: ratios measured in one run beside their limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from benchmarks.processes import LOADED, Command
from benchmarks.rivals import Rival
from planmethod.bench.measurements import ReadSpeed
from planmethod.bench.report import Table, number, table


@dataclass(frozen=True, slots=True)
class Bound:
    """A number beside its limit.

    Attributes
    ----------
    what : str
    found : float
    limit : float
    least : bool
        Whether it must not be less, or not be more.
    """

    what: str
    found: float
    limit: float
    least: bool = False

    @property
    def holds(self) -> bool:
        """True if the number is within its limit."""
        return self.found >= self.limit if self.least else self.found <= self.limit


def bounds_table(bounds: Sequence[Bound]) -> Table:
    """Return bounds as a table with its introduction; an empty list if there are no bounds."""
    if not bounds:
        return []
    rows = [
        (
            one.what,
            number(one.found) if one.limit < 1e-3 else f"{one.found:.3g}",
            f"{'at least' if one.least else 'at most'} {one.limit:g}",
            "yes" if one.holds else "no",
        )
        for one in bounds
    ]
    return ["", "What shall hold:", "", *table(("what", "found", "limit", "holds"), rows)]


def of_sweeps(readings: Sequence[ReadSpeed]) -> list[Bound]:
    """Return the bounds of machine code beside NumPy's sweep and bare stores."""
    found = []
    for problem in dict.fromkeys(one.problem for one in readings):
        own = [one for one in readings if one.problem == problem]
        if not any(one.name == "sweep, bound call" for one in own):
            continue
        seconds = {(one.name, one.positions): one.seconds for one in own}
        times = {
            n: seconds["sweep, float64", n] / seconds["sweep, bound call", n]
            for n in (10_000, 1_000_000)
            if ("sweep, bound call", n) in seconds
        }
        told = f"{problem}, machine code"
        if 10_000 in times:
            found.append(Bound(f"{told}: times NumPy's sweep, 10⁴", times[10_000], 4.0, True))
        if 1_000_000 in times:
            stores = "its results stored, nothing computed"
            share = seconds[stores, 1_000_000] / seconds["sweep, bound call", 1_000_000]
            limits = f"{share:.2g} of the stores, {times[1_000_000]:.2g} times NumPy's sweep"
            best = max(share / 0.5, times[1_000_000] / 3.0)
            found.append(Bound(f"{told}, 10⁶: {limits}; of 0.5 or 3", best, 1.0, True))
        worst = max(one.error for one in own if one.name == "sweep, machine code")
        found.append(Bound(f"{told}: largest error", worst, 4e-15))
    return found


def of_rivals(compared: Sequence[Rival]) -> list[Bound]:
    """Return the bounds of machine code beside its peers, as far as they ran."""
    seconds: Mapping[str, Mapping[int, float]] = {
        one.name: {n: timing.median for n, timing in one.seconds.items()} for one in compared
    }
    own, c = seconds.get("planmethod, bound call"), seconds.get("C, table")
    stepping = seconds.get("pylinkage, numba")
    found = []
    if own and c and 10_000 in own:
        found.append(Bound("speed of that of C, table, 10⁴", c[10_000] / own[10_000], 0.6, True))
    if own and c and 12 in own:
        found.append(Bound("bound call: time over that of C, table, 12", own[12] / c[12], 2.0))
    if own and stepping and 12 in own:
        found.append(Bound("bound call: times pylinkage, 12", stepping[12] / own[12], 3.0, True))
    return found


DRAWING = "import numpy, shapely, svgwrite, click"

STARTS = (
    ("--help", "import click", 1.5),
    ("solve", "import numpy, click", 1.15),
    ("sheet --format svg", DRAWING, 1.5),
    ("sheet --format pdf", DRAWING, 1.5),
    ("sheet --format svg --phi 0:360:30", DRAWING, 3.0),
)
"""Commands, and by how much they may take longer than the imports of libraries alone."""


def of_commands(commands: Sequence[Command]) -> list[Bound]:
    """Return the bounds of whole commands."""
    seconds = {one.name: one.cold.median for one in commands if one.cold is not None}
    found = [
        Bound(
            f"planmethod {name}: time over that of {alone}",
            seconds[f"planmethod {name}"] / seconds[alone],
            limit,
        )
        for name, alone, limit in STARTS
        if alone in seconds and f"planmethod {name}" in seconds
    ]
    found += [
        Bound(f"planmethod {name}: s", seconds[f"planmethod {name}"], limit)
        for name, limit, *_ in LOADED
        if f"planmethod {name}" in seconds
    ]
    return found
