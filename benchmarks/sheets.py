"""Filling of sheets (заполнение листа): white, empty corners, views, vectors, seconds.

Run ``python -m benchmarks.sheets [PROBLEM]...``; it prints the table of docs/paper.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import ceil, hypot
from pathlib import Path
from statistics import fmean, median
from time import perf_counter
from typing import TypeAlias

import click
import numpy as np
import numpy.typing as npt
from shapely import MultiPoint, contains_xy

from planmethod.commands.problems import guarded
from planmethod.errors import PlanMethodError
from planmethod.paper import paper_format
from planmethod.problem import load
from planmethod.problem.model import Problem
from planmethod.render.control.sheet import (
    FRAME,
    area_percentage,
    ink_points,
    inked_percentage,
    inspect,
    largest_empty,
)
from planmethod.render.frame import MARGIN_NOTE
from planmethod.render.ink.drawing import Bounds, Drawing
from planmethod.render.ink.typeset import ink_bounds, overlap
from planmethod.render.sheets.controlled import paper_of
from planmethod.render.sheets.kinematics import kinematics_sheets

Squares: TypeAlias = npt.NDArray[np.bool_]

FAR = 10.0
"""Paper so far from all ink is white, mm: half of it belongs to the drawing as its margin."""

SEEN = 1 / 30
"""The same as a part of the shorter side of the paper: a sheet is viewed as
a whole."""

CELL = 2.5
"""Side of the squares into which the paper is divided, mm."""

TOGETHER = 8.0
"""Ink that is nearer to one another belongs to one block, mm."""

COUNTS = (1, 3, 12)
"""Numbers of positions."""

SHIPPED = ("linkages/ex1", "linkages/ex2", "linkages/ex3", "levers/six-link", "levers/task12")
BANK = (
    *(f"levers/task-{number}" for number in (1, 5, 11, 15, 20, 29, 33, 37, 43, 49, 57, 65)),
    *(f"linkages/2.1.{number}" for number in (2, 7, 19, 24, 30, 45, 114, 137)),
)
"""Tasks of the textbooks that no sheet was tuned for, and the worked examples."""

HEAD = (
    "| task | positions | format | sheets | white (in views), % | as seen, % | inked, % | empty, % "
    "| aligned, % | scheme, mm | least plan, mm | vectors, median and least, mm "
    "| labels that collide | s |\n"
    "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: "
    "| ---: |"
)


@dataclass(frozen=True, slots=True)
class Filled:
    """Filling of the sheets of one problem.

    Attributes
    ----------
    task : str
    positions : int
    paper : str
        Format of the first sheet.
    sheets : int
    white, within : float
        Share of the field within the frame that is further than `FAR` from all ink, on all sheets
        but continuation sheets of texts, per cent; and its part within the outlines of views,
        where no other block fits.
    seen : float
        The same further than `SEEN` of the shorter side of the paper, per cent.
    empty : float
        Share of the field covered by the largest rectangle without ink on the emptiest sheet,
        per cent: it is seen as an empty corner (PM-D10).
    inked : float
        Share of the squares of 5 mm of the field that have ink, of the emptiest sheet, per cent
        (PM-D19).
    aligned : float
        Share of the blocks that have their left edge or their upper line in common with another
        block of the sheet, or with the title block, per cent.
    scheme : tuple of float, mm
        Width and height of the view of the scheme with its letters.
    plan : float, mm
        Larger side of the smallest plan in a position.
    vectors : tuple of float, mm
        Median and least length of the vectors of the plans.
    collisions : int
        Inscriptions on one another or on lines (PM-D01, PM-D02).
    seconds : float
    """

    task: str
    positions: int
    paper: str
    sheets: int
    white: float
    within: float
    seen: float
    inked: float
    empty: float
    aligned: float
    scheme: tuple[float, float]
    plan: float
    vectors: tuple[float, float]
    collisions: int
    seconds: float

    def row(self) -> str:
        """Return the row of the table."""
        wide, high = self.scheme
        middle, least = self.vectors
        return (
            f"| {self.task} | {self.positions} | {self.paper} | {self.sheets} "
            f"| {self.white:.0f} ({self.within:.0f}) | {self.seen:.0f} | {self.inked:.0f} "
            f"| {self.empty:.0f} | {self.aligned:.0f} | {wide:.0f} × {high:.0f} "
            f"| {self.plan:.0f} | {middle:.0f}; {least:.1f} "
            f"| {self.collisions} | {self.seconds:.2f} |"
        )


def white_share(drawing: Drawing, far: float = FAR) -> tuple[float, float]:
    """Return the share of a sheet within its frame that is further than ``far`` from all ink, %.

    The frame itself is ink. The second number is its part within the outlines of views:
    within the convex hulls of their ink.
    """
    left, low, right, top = paper_format(paper_of(drawing)).inner
    wide, high = right - left, top - low
    across, along = ceil(wide / CELL), ceil(high / CELL)
    taken = np.zeros((across, along), dtype=bool)
    points = np.array([p for one in drawing.items if one.tag != "edge" for p in ink_points(one)])
    places = (points - complex(left, low)) / CELL
    k, j = np.floor(places.real).astype(int), np.floor(places.imag).astype(int)
    on = (k >= 0) & (k < across) & (j >= 0) & (j < along)
    taken[k[on], j[on]] = True
    reach = far / CELL
    near = np.zeros_like(taken)
    for i in range(-int(reach), int(reach) + 1):
        for m in range(-int(reach), int(reach) + 1):
            if hypot(i, m) <= reach:
                near |= _moved(taken, i, m)
    x = left + CELL * (np.arange(across) + 0.5)
    y = low + CELL * (np.arange(along) + 0.5)
    within = np.zeros_like(taken)
    for x0, y0, x1, y1 in (view.box for view in drawing.views):
        inside = (points.real >= x0) & (points.real <= x1)
        inside &= (points.imag >= y0) & (points.imag <= y1)
        pairs = np.column_stack((points.real[inside], points.imag[inside]))
        within |= contains_xy(MultiPoint(pairs).convex_hull, *np.meshgrid(x, y, indexing="ij"))
    return 100.0 * float(1.0 - near.mean()), 100.0 * float((~near & within).mean())


def _empty(drawing: Drawing) -> float:
    inner = paper_format(paper_of(drawing)).inner
    return area_percentage(largest_empty(drawing.items, inner), inner)


def _inked(drawing: Drawing) -> float:
    return inked_percentage(drawing.items, paper_format(paper_of(drawing)).inner)


def aligned_share(drawing: Drawing, near: float = 0.6) -> float:
    """Return the share of blocks with a left edge or upper line in common with another, %.

    Blocks are found by their ink: parts nearer than 8 mm to one another form one block.
    """
    boxes = _blocks(drawing)
    common = 0
    for k, one in enumerate(boxes):
        others = [other for j, other in enumerate(boxes) if j != k]
        common += any(min(abs(one[0] - o[0]), abs(one[3] - o[3])) <= near for o in others)
    return 100.0 * common / len(boxes) if boxes else 100.0


def _blocks(drawing: Drawing) -> list[Bounds]:
    """Return the boxes of the blocks of a sheet: views and groups of neighbouring items."""
    groups: list[Bounds] = []
    for item in drawing.items:
        if item.tag in FRAME or MARGIN_NOTE in item.tag.split():
            continue
        box = ink_bounds([item])
        while True:
            touched = [other for other in groups if overlap(box, other, TOGETHER)]
            if not touched:
                break
            groups = [other for other in groups if other not in touched]
            lows, highs = zip(*((b[:2], b[2:]) for b in (box, *touched)), strict=True)
            box = (*map(min, *lows), *map(max, *highs))
        groups.append(box)
    return groups


def _moved(taken: Squares, across: int, along: int) -> Squares:
    moved = np.zeros_like(taken)
    (a, b), (c, d) = _overlap(taken.shape[0], across), _overlap(taken.shape[1], along)
    moved[a, c] = taken[b, d]
    return moved


def _overlap(size: int, by: int) -> tuple[slice, slice]:
    return slice(max(by, 0), size + min(by, 0)), slice(max(-by, 0), size - max(by, 0))


def filled(problem: Problem, count: int) -> Filled:
    """Draw the default sheets of a problem in ``count`` positions and measure them.

    One position is the first of the file; several divide its range, or a turn, evenly.
    """
    positions = positions_of(problem, count)
    start = perf_counter()
    drawings = kinematics_sheets(problem, positions=positions)
    seconds = perf_counter() - start
    whole = [drawing for drawing in drawings if not drawing.is_continuation]
    shares = [white_share(drawing) for drawing in whole]
    scheme = next(v.box for one in whole for v in one.views if v.kind == "position")
    plans = list(_plans(whole))
    lengths = [length for plan in plans for length in plan[1]]
    return Filled(
        problem.name,
        count,
        paper_of(drawings[0]),
        len(drawings),
        fmean(white for white, _ in shares),
        fmean(within for _, within in shares),
        fmean(white_share(one, SEEN * min(one.width, one.height))[0] for one in whole),
        min(map(_inked, whole)),
        max(map(_empty, whole)),
        fmean(map(aligned_share, whole)),
        (scheme[2] - scheme[0], scheme[3] - scheme[1]),
        min((side for side, _ in plans), default=0.0),
        (median(lengths), min(lengths)) if lengths else (0.0, 0.0),
        sum(found.code in ("PM-D01", "PM-D02") for one in drawings for found in inspect(one)),
        seconds,
    )


def positions_of(problem: Problem, count: int) -> list[float]:
    """Return positions of a driver to draw: its own one, or even parts of where it comes."""
    first = problem.drive.positions[0]
    if count == 1:
        return [first]
    if problem.drive.is_crank:
        reached = _reached(problem, [first + 360.0 * k / 72 for k in range(72)])
        return [reached[len(reached) * k // count] for k in range(count)]
    return [first * (1.0 + 0.02 * k) for k in range(count)]


def _reached(problem: Problem, tried: Sequence[float]) -> list[float]:
    """Return the positions in which a mechanism assembles."""
    from planmethod.solved.solution import Solution

    try:
        Solution(problem, positions=tuple(tried)).si  # noqa: B018 - computed on access
    except PlanMethodError:
        found = []
        for phi in tried:
            try:
                Solution(problem, positions=(phi,)).si  # noqa: B018
            except PlanMethodError:
                continue
            found.append(phi)
        return found
    return list(tried)


def _plans(drawings: Iterable[Drawing]) -> Iterator[tuple[float, list[float]]]:
    """Yield of every plan in a position its larger side and the lengths of its vectors, mm."""
    for drawing in drawings:
        for view in drawing.views:
            for position in dict.fromkeys(span.position for span in view.spans):
                own = [span for span in view.spans if span.position == position]
                ends = [end for span in own for end in (span.start, span.end)]
                sides = (np.ptp([p.real for p in ends]), np.ptp([p.imag for p in ends]))
                yield float(max(sides)), [span.length for span in own]


@click.command()
@click.argument("problems", nargs=-1, metavar="[PROBLEM]...", type=click.Path(path_type=Path))
@click.option(
    "--positions",
    "counts",
    type=click.IntRange(1, 120),
    multiple=True,
    default=COUNTS,
    show_default=True,
    help="Numbers of positions.",
)
@guarded
def main(problems: tuple[Path, ...], counts: tuple[int, ...]) -> None:
    """Measure how the default sheets of problems fill their paper; print a table in Markdown."""
    paths = problems or [Path("problems") / f"{name}.toml" for name in (*SHIPPED, *BANK)]
    rows: list[Filled] = []
    click.echo(HEAD)
    for path in paths:
        for count in counts:
            try:
                rows.append(filled(load(path), count))
            except PlanMethodError as error:
                click.echo(f"{path.stem}, {count}: {error}", err=True)
                continue
            click.echo(rows[-1].row())
    for count in counts:
        some = [row for row in rows if row.positions == count]
        if not some:
            continue
        white = [row.white for row in some]
        click.echo(
            f"\nOf {count}: white {fmean(white):.0f} % on average "
            f"({fmean(row.within for row in some):.0f} % within views), "
            f"{max(white):.0f} % at most; "
            f"{sum(row.white > 25 for row in some)} of {len(some)} above 25 %; "
            f"as seen {fmean(row.seen for row in some):.0f} %, "
            f"{max(row.seen for row in some):.0f} % at most, "
            f"{sum(row.seen > 25 for row in some)} above 25 %; "
            f"inked {fmean(row.inked for row in some):.0f} %, "
            f"{min(row.inked for row in some):.0f} % at least; "
            f"blocks on common lines {fmean(row.aligned for row in some):.0f} %; "
            f"largest empty rectangle {median(row.empty for row in some):.0f} %, "
            f"{max(row.empty for row in some):.0f} % at most; "
            f"vectors {median(row.vectors[0] for row in some):.0f} mm; "
            f"{sum(row.collisions for row in some)} labels collide; "
            f"{sum(row.sheets for row in some)} sheets; {fmean(row.seconds for row in some):.2f} s."
        )


if __name__ == "__main__":
    main()
