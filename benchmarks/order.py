"""Order on sheets (порядок на листе): thirty sheets that no layout was tuned for, as drawn.

Run ``python -m benchmarks.order [PROBLEM]...``; it prints a part of benchmarks/reports/paper.md.
Everything is measured on the items and views of the drawn sheets.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean, median
from tempfile import TemporaryDirectory
from time import perf_counter

import click
import numpy as np

from benchmarks.generator import random_problem
from benchmarks.sheets import positions_of, white_share
from planmethod.commands.command import guarded
from planmethod.errors import PlanMethodError
from planmethod.kinds import LINKAGES, kind_of
from planmethod.options import PlanRequest
from planmethod.render.control.order import list_first_titles, table_offset
from planmethod.render.control.sheet import area_percentage, inspect as find_faults, largest_empty
from planmethod.render.control.texts import measure_name_distances, writings_of
from planmethod.render.frame import FRAME_LEFT, FRAME_OTHER
from planmethod.render.ink.drawing import Bounds, Drawing, Span
from planmethod.render.sheets.controlled import paper_of

SEEDS = range(81_001, 81_007)
"""Random mechanisms, each in one, three and twelve positions."""

SHORT = 10.0
"""Vectors below this length are counted, mm."""

LAYOUTS = (
    *(("forces", f"levers/task-{number}") for number in (8, 22, 38, 51, 61)),
    ("coursework", "levers/task-41"),
    ("flywheel", "machines/compressor"),
    ("synthesis", "press/press"),
    ("", "gears/tasks/gears-2-2-011"),
    ("compact", "levers/task-56"),
)
"""Layouts, and textbook tasks that are drawn in them; ``compact`` is the option."""

CAM = """[cam]
follower = "translating"
stroke = 0.027
rise = 100
upper_dwell = 35
return = 105
law = { rise = "sine", return = "cosine" }
pressure = 27
offset = 0.009
n = 190
"""

MESHING = "[meshing]\nz = [14, 37]\nm = 4\nx = [0.3, 0.1]\n"

HEAD = (
    "| sheet | format | sheets | white, % | hole, % | titles, mm | tables, mm | vectors, mm "
    "| under 10 mm, % | letters | findings | s |\n"
    "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
)

INTRODUCTION = """
## Order

Thirty sheets that no layout was tuned for: random mechanisms in one, three and twelve positions,
textbook tasks in the layouts of forces and others, a cam, a train, a meshing. Measured by
`python -m benchmarks.order` on what is drawn.

- **White**, and **hole**, the largest empty rectangle: on the emptiest sheet.
- **Titles**: distance between the highest and the lowest base line of the titles of the first row,
  that is of views with nothing above them. **Tables**: distance of the right edge of the table
  above the title block from its edge.
- **Vectors**: median length. **Letters**: number of the names of vectors that are nearer to another
  vector of the plan than to their own, or whose leader lines cross another one or end at it.
  **Findings**: those of `lint`.
"""


@dataclass(frozen=True, slots=True)
class Ordered:
    """Order on the sheets of one problem; lengths in mm, shares in per cent."""

    name: str
    positions: int
    drawings: Sequence[Drawing]
    seconds: float

    @property
    def whole(self) -> list[Drawing]:
        """Sheets that do not only continue texts."""
        return [one for one in self.drawings if not one.is_continuation]

    @property
    def white(self) -> float:
        """White of the emptiest sheet."""
        return max(white_share(one)[0] for one in self.whole)

    @property
    def hole(self) -> float:
        """Largest rectangle without ink."""
        return max(
            area_percentage(largest_empty(one.items, _inner(one)), _inner(one))
            for one in self.whole
        )

    @property
    def titles(self) -> float:
        """Spread of the base lines of the titles of the first row, of the worst sheet."""
        lines = [[title.at.imag for _, title in list_first_titles(one)] for one in self.whole]
        return max((max(some) - min(some) for some in lines if some), default=0.0)

    @property
    def tables(self) -> float:
        """Distance of the lowest table from the edge of the title block; 0 without tables."""
        return max((table_offset(one) for one in self.whole), default=0.0)

    @property
    def spans(self) -> list[Span]:
        """Measured segments of the plans."""
        return [span for one in self.whole for view in one.views for span in view.spans]

    @property
    def strangers(self) -> tuple[int, int]:
        """Numbers of the names that mislead to another vector, and of all."""
        found = [count_strangers(one) for one in self.whole]
        return sum(strange for strange, _ in found), sum(every for _, every in found)

    def row(self) -> str:
        """Return the row of the table."""
        lengths = [span.length for span in self.spans]
        shown = ("—", "—")
        if lengths:
            short = 100.0 * fmean(length < SHORT for length in lengths)
            shown = f"{median(lengths):.0f}", f"{short:.0f}"
        strange, every = self.strangers
        findings = sum(len(find_faults(one)) for one in self.drawings)
        return (
            f"| {self.name} | {paper_of(self.drawings[0])} | {len(self.drawings)} "
            f"| {self.white:.0f} | {self.hole:.0f} | {self.titles:.1f} | {self.tables:.1f} "
            f"| {shown[0]} | {shown[1]} | {strange} of {every} | {findings} | {self.seconds:.2f} |"
        )


def _inner(drawing: Drawing) -> Bounds:
    return (FRAME_LEFT, FRAME_OTHER, drawing.width - FRAME_OTHER, drawing.height - FRAME_OTHER)


def count_strangers(drawing: Drawing) -> tuple[int, int]:
    """Return the numbers of the names that mislead to another vector, and of all."""
    found = measure_name_distances(drawing.items, writings_of(drawing.items), drawing.views)
    misleading = [one.is_misleading(0.05) for one in found]
    return sum(misleading), len(misleading)


def drawn(path: Path, count: int = 1, layout: str = "") -> Ordered:
    """Draw a problem file in ``count`` positions and a layout, both of the file by default."""
    kind = kind_of(path)
    problem = kind.load(path, None)
    request = PlanRequest()
    if kind is LINKAGES and count > 1:
        request = PlanRequest(phi=np.array(positions_of(problem, count)))
    elif layout:
        request = PlanRequest(layout=layout, compact=layout == "compact")
    name = " ".join(filter(None, (path.stem, layout, f"× {count}" if count > 1 else "")))
    kind.drawings(problem, request)  # what is computed once is not measured
    problem = kind.load(path, None)
    start = perf_counter()
    drawings = kind.drawings(problem, request)
    return Ordered(name, count, drawings, perf_counter() - start)


def thirty(folder: Path) -> Iterator[tuple[Path, int, str]]:
    """Yield the sheets: files, of which some are written into a folder; positions; layouts."""
    texts = {f"random-{seed}": random_problem(seed)[0] for seed in SEEDS}
    for name, text in {**texts, "cam": CAM, "meshing": MESHING}.items():
        path = folder / f"{name}.toml"
        path.write_text(text)
        for count in (1, 3, 12) if name in texts else (1,):
            yield path, count, ""
    for layout, name in LAYOUTS:
        yield Path("problems") / f"{name}.toml", 1, layout


def summary(rows: Iterable[Ordered]) -> str:
    """Return the line below a table."""
    every = list(rows)
    strange, named = map(sum, zip(*(row.strangers for row in every), strict=True))
    white = [row.white for row in every]
    lines = [
        f"Of {len(every)}: white {fmean(white):.0f} %, {max(white):.0f} % at most; largest hole "
        f"{median(row.hole for row in every):.0f} %, {max(row.hole for row in every):.0f} % at "
        f"most; titles of the first row on one line within 1 mm on "
        f"{sum(row.titles <= 1.0 for row in every)}; tables flush with the title block on "
        f"{sum(row.tables <= 0.5 for row in every)}; {strange} of {named} names at another "
        f"vector; {sum(len(row.drawings) for row in every)} sheets; "
        f"{fmean(row.seconds for row in every):.2f} s."
    ]
    for count in dict.fromkeys(row.positions for row in every):
        lengths = [span.length for row in every if row.positions == count for span in row.spans]
        if lengths:
            lines.append(
                f"Of {count}: vectors {median(lengths):.0f} mm, "
                f"{100.0 * fmean(length < SHORT for length in lengths):.0f} % under 10 mm."
            )
    return "\n".join(lines)


@click.command()
@click.argument("problems", nargs=-1, metavar="[PROBLEM]...", type=click.Path(path_type=Path))
@guarded
def main(problems: tuple[Path, ...]) -> None:
    """Measure the order on the thirty sheets, or on the sheets of problems; print a table."""
    click.echo(f"{INTRODUCTION}\n{HEAD}")
    rows = []
    with TemporaryDirectory() as folder:
        sheets = [(path, count, "") for path in problems for count in (1, 3, 12)]
        for path, count, layout in sheets or thirty(Path(folder)):
            try:
                rows.append(drawn(path, count, layout))
            except PlanMethodError as error:
                click.echo(f"{path.stem}, {count}: {error}", err=True)
                continue
            click.echo(rows[-1].row())
    click.echo(f"\n{summary(rows)}")


if __name__ == "__main__":
    main()
